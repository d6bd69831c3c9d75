#!/usr/bin/env bash
# gumption and other tools side by side: writes reports/performance.md, .svg and .json.
#
#   benches/compare.sh             an hour or less; leave the machine alone meanwhile
#   benches/compare.sh --quick     some minutes, few trials: does everything run and agree?
#   benches/compare.sh --rounds 3  fewer repeats of each comparison
#   benches/compare.sh --before PROGRAM  what users wait for, beside an earlier version of the program
#   benches/compare.sh --python FOLDER --python-before FOLDER  and of the Python package
#   benches/compare.sh --resume    goes on where an interrupted run stopped
#   benches/compare.sh --render    the pages again from the kept measurements
#
# Writes to reports/, in the quick form to target/quick-reports/ unless --output DIR says otherwise.
# Needs Python 3.10 or later with venv. VENV: where the virtual environment is kept.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-target}
venv=${VENV:-$target/compare-venv}
output=reports
for argument; do
    if [ "$argument" = --quick ]; then output=$target/quick-reports; fi
done

if [ ! -x "$venv/bin/python" ]; then python3 -m venv "$venv"; fi
"$venv/bin/pip" install --quiet --requirement benches/requirements.txt

# the path of a binary that cargo has built, from its messages
executable() {
    "$venv/bin/python" -c '
import json, sys
for line in sys.stdin:
    message = json.loads(line)
    if message.get("executable") and message["target"]["name"] == sys.argv[1]:
        print(message["executable"])
' "$1"
}
cargo build --release --bin gumption
command=$(cargo build --release --bin gumption --quiet --message-format json | executable gumption)
workload=$(cargo bench --bench workload --no-run --message-format json | executable workload)
paths=$("$workload" --paths)

"$venv/bin/python" benches/compare/main.py \
    --workload-binary "$workload" --command-binary "$command" --paths "$paths" \
    --output "$output" "$@"
echo "written: $output/performance.md" >&2
