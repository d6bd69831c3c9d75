#!/bin/sh
# A run in N parts at the same time on this machine: the loop that any batch system needs.
#
#   parts.sh N MODEL DIR ["ANSWER OPTIONS" [RUN OPTIONS]]
#   parts.sh 8 model.json work "--format json --output answer.json" --trials 1e10
#
# DIR takes the parts. One that fails is made again the next time the script is started: parts that are
# there are left as they are.
set -eu
if [ $# -lt 3 ]; then
    sed -n '2,8s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
gumption=${GUMPTION:-gumption}
count=$1 model=$2 dir=$3 answer=${4-}
shift 3
[ $# -eq 0 ] || shift
mkdir -p "$dir"
while :; do
    # parts are called after the pass that they are of
    pass= key=first
    if [ -e "$dir/next-pass" ]; then
        pass="--pass $dir/next-pass"
        key=$(cksum < "$dir/next-pass" | tr ' ' -)
    fi
    part=1
    jobs=
    while [ "$part" -le "$count" ]; do
        file=$dir/part-$key-$part
        if [ ! -e "$file" ]; then
            # shellcheck disable=SC2086 # words on purpose
            "$gumption" run "$model" "$@" --quiet --blocks "$part/$count" --partial "$file" $pass &
            jobs="$jobs $!"
        fi
        part=$((part + 1))
    done
    for job in $jobs; do wait "$job"; done
    code=0
    # shellcheck disable=SC2086 # words on purpose
    "$gumption" merge "$dir" $answer || code=$?
    case $code in
    0) exit 0 ;;
    75) rm -f "$dir/part-$key-"* ;; # merged: the next pass
    *) exit "$code" ;;
    esac
done
