#!/bin/sh
# A run as Slurm job arrays: one array for each pass over the blocks, and a merge after it.
#
#   slurm.sh N MODEL DIR ["ANSWER OPTIONS" [RUN OPTIONS]]
#   slurm.sh 200 model.json /scratch/me/work "--format json --output answer.json" --trials 1e11
#
# Run it on a login node (it waits), or as a job of its own. DIR and MODEL are on a file system that
# all nodes see. An array task that dies is put back into the queue by Slurm (--requeue); one that is
# missing in the end is named by the merge, and the script started again makes what is missing.
# GUMPTION is the program where that is not `gumption` of the path, CPUS the processors of a task (8).
set -eu
if [ $# -lt 3 ]; then
    sed -n '2,10s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
count=$1 model=$2 dir=$3 answer=${4-}
shift 3
[ $# -eq 0 ] || shift
gumption=${GUMPTION:-gumption}
mkdir -p "$dir"

# Words as a shell reads them again, whatever stands in them.
quoted() {
    for word; do
        printf " '%s'" "$(printf '%s' "$word" | sed "s/'/'\\\\''/g")"
    done
}

while :; do
    # parts are called after the pass that they are of
    pass= key=first
    if [ -e "$dir/next-pass" ]; then
        pass=$(quoted --pass "$dir/next-pass")
        key=$(cksum < "$dir/next-pass" | tr ' ' -)
    fi
    cat > "$dir/array.sh" <<JOB
#!/bin/sh
set --$(quoted "$dir/part-$key-")
file=\$1\$SLURM_ARRAY_TASK_ID
[ -e "\$file" ] || exec$(quoted "$gumption" run "$model" "$@") --quiet --threads "\$SLURM_CPUS_PER_TASK" \\
    --blocks "\$SLURM_ARRAY_TASK_ID/$count" --partial "\$file"$pass
JOB
    # where a task has failed, the merge says what is missing
    sbatch --wait --requeue --array="1-$count" --cpus-per-task="${CPUS:-8}" "$dir/array.sh" || :
    code=0
    # shellcheck disable=SC2086 # words on purpose
    "$gumption" merge "$dir" $answer || code=$?
    case $code in
    0) exit 0 ;;
    75) rm -f "$dir/part-$key-"* ;; # merged: the next pass
    *) exit "$code" ;;
    esac
done
