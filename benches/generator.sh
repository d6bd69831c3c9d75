#!/usr/bin/env bash
# Feeds gumption's random numbers to the test battery dieharder (R. G. Brown; a Debian package) and
# writes reports/generator.md: what it said about numbers along trials, across neighbouring blocks,
# across inputs and across seeds (examples/random_bits.rs).
#
#   benches/generator.sh            some hours of one processor
#   benches/generator.sh --quick    some minutes: a quarter of the samples, writes to the terminal only
#
# A test that comes out weak (p below 0.005 or above 0.995) is given more samples until it is clear
# (dieharder -Y 1). Exit code 1 where a test fails: p below 1e-6 or above 1 - 1e-6.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v dieharder >/dev/null || {
    echo "dieharder is not there; on Debian: apt-get install dieharder" >&2
    exit 2
}
quick=
if [ "${1-}" = --quick ]; then quick=yes; fi

# All tests but 5 to 7 and 14, which dieharder itself calls suspect or not to be used, and but the
# lagged sums (203), which read hundreds of gigabytes. 200 to 202 with the lengths of tuples that
# dieharder's own complete run takes.
tests=(
    "-d 0" "-d 1" "-d 2" "-d 3" "-d 4" "-d 8" "-d 9" "-d 10" "-d 11" "-d 12" "-d 13" "-d 15" "-d 16"
    "-d 17" "-d 100" "-d 101" "-d 102" "-d 200 -n 1" "-d 200 -n 4" "-d 200 -n 8" "-d 200 -n 12"
    "-d 201 -n 2" "-d 201 -n 3" "-d 201 -n 4" "-d 201 -n 5" "-d 202 -n 3" "-d 202 -n 4" "-d 202 -n 5"
    "-d 204" "-d 205" "-d 206" "-d 207" "-d 208" "-d 209"
)
multiply=()
if [ "$quick" ]; then multiply=(-m 0.25); fi

cargo build --release --quiet --example random_bits
bits=${CARGO_TARGET_DIR:-target}/release/examples/random_bits
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# of a test that was given more samples only what it said in the end
final() {
    awk -F, '
        { line[NR] = $0; samples[NR] = $5; if ($5 > most) most = $5 }
        END { for (i = 1; i <= NR; i++) if (samples[i] == most) print line[i] }'
}

for order in trials blocks inputs seeds; do
    for test in "${tests[@]}"; do
        # word splitting wanted; the generator ends when dieharder has read enough
        # shellcheck disable=SC2086
        { "$bits" "$order" || true; } |
            dieharder -g 200 $test "${multiply[@]}" -Y 1 -k 2 -c , -D test_name -D ntuple -D tsamples \
                -D psamples -D pvalues -D assessment |
            sed "s/^ */$order,/; s/ *, */,/g; s/ *$//" | tee /dev/stderr | final >>"$log"
    done
done

summary() {
    echo "\`benches/generator.sh\` fed the draws of rectangular quantities (52 bits each) to" \
        "$(dieharder -h 2>&1 | grep -o 'dieharder version [0-9.]*' | head -1), every stream by each" \
        "test from its start${quick:+, with a quarter of the usual samples}:"
    echo
    echo "| stream | p-values | passed | weak | failed | least | greatest |"
    echo "| --- | --- | --- | --- | --- | --- | --- |"
    awk -F, '
        !($1 in n) { order[++orders] = $1; low[$1] = 1 }
        {
            n[$1]++; said[$1, $7]++
            if ($6 < low[$1]) low[$1] = $6
            if ($6 > high[$1]) high[$1] = $6
        }
        END {
            for (i = 1; i <= orders; i++) {
                o = order[i]
                printf "| %s | %d | %d | %d | %d | %s | %s |\n", o, n[o], said[o, "PASSED"],
                    said[o, "WEAK"], said[o, "FAILED"], low[o], high[o]
            }
        }' "$log"
    echo
    echo "\`trials\`: one quantity, trial after trial; \`blocks\`: the first numbers of 1024 neighbouring" \
        "blocks, then the second ones, and so on; \`inputs\`: 64 quantities in turn; \`seeds\`: 64 seeds" \
        "in turn."
}
if [ "$quick" ]; then summary; else summary >reports/generator.md; fi
! grep -q FAILED "$log"
