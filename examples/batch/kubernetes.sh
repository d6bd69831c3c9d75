#!/bin/sh
# A run as indexed Jobs of Kubernetes: one Job for each pass over the blocks, and a merge after it.
#
#   IMAGE=IMAGE CLAIM=CLAIM kubernetes.sh N MODEL DIR ["ANSWER OPTIONS" [RUN OPTIONS]]
#   IMAGE=... CLAIM=work kubernetes.sh 200 model.json parts "--format json --output answer.json" --trials 1e11
#
# Run it in a folder of the volume of CLAIM, a PersistentVolumeClaim that many nodes can write to. MODEL
# and DIR are in this folder. The script itself is a pod that may create Jobs, or runs on a machine that
# has the volume at the same path. Kubernetes repeats a pod that fails up to six times. The merge names
# parts that are missing in the end, and the script started again makes these parts.
# IMAGE has the program; GUMPTION is the program where that is not `gumption` of the path, CPUS the
# processors of a pod (8), MOUNT the path of the volume (/work), NAME the beginning of the Jobs' names
# (gumption), of which runs at the same time need different ones.
set -eu
if [ $# -lt 3 ] || [ -z "${IMAGE-}" ] || [ -z "${CLAIM-}" ]; then
    sed -n '2,14s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
count=$1 model=$2 dir=$3 answer=${4-}
shift 3
[ $# -eq 0 ] || shift
gumption=${GUMPTION:-gumption}
cpus=${CPUS:-8}
mount=${MOUNT:-/work}
case $PWD/ in
"$mount"/*) ;;
*)
    echo "$0: the folder $PWD is not in $mount, where pods find the volume; MOUNT= names another path" >&2
    exit 2
    ;;
esac
mkdir -p "$dir"

# Words as a shell reads them again, whatever stands in them.
quoted() {
    for word; do
        printf " '%s'" "$(printf '%s' "$word" | sed "s/'/'\\\\''/g")"
    done
}

# A text as YAML reads it.
text() {
    printf '"%s"' "$(printf '%s' "$1" | sed 's/[\\"]/\\&/g')"
}

while :; do
    # parts are called after the pass that they are of
    pass= key=first
    if [ -e "$dir/next-pass" ]; then
        pass=$(quoted --pass "$dir/next-pass")
        key=$(cksum < "$dir/next-pass" | tr ' ' -)
    fi
    cat > "$dir/part.sh" <<PART
#!/bin/sh
part=\$((JOB_COMPLETION_INDEX + 1))
set --$(quoted "$dir/part-$key-")
file=\$1\$part
[ -e "\$file" ] || exec$(quoted "$gumption" run "$model" "$@") --quiet --threads $cpus \\
    --blocks "\$part/$count" --partial "\$file"$pass
PART
    cat > "$dir/job.yaml" <<JOB
apiVersion: batch/v1
kind: Job
metadata:
  name: ${NAME:-gumption}-$key
spec:
  completionMode: Indexed
  completions: $count
  parallelism: $count
  backoffLimitPerIndex: 6
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: part
          image: $IMAGE
          command: [sh, $(text "$dir/part.sh")]
          workingDir: $(text "$PWD")
          resources:
            requests:
              cpu: $cpus
          volumeMounts:
            - name: work
              mountPath: $(text "$mount")
      volumes:
        - name: work
          persistentVolumeClaim:
            claimName: $CLAIM
JOB
    job=job/${NAME:-gumption}-$key
    # one that failed before
    kubectl delete "$job" --ignore-not-found
    kubectl apply --filename "$dir/job.yaml"
    while :; do
        ended=$(kubectl get "$job" --output 'jsonpath={.status.conditions[?(@.status=="True")].type}')
        # where a part has failed, the merge says what is missing
        case " $ended " in *" Complete "* | *" Failed "*) break ;; esac
        sleep 5
    done
    code=0
    # shellcheck disable=SC2086 # words on purpose
    "$gumption" merge "$dir" $answer || code=$?
    case $code in
    0) exit 0 ;;
    75) rm -f "$dir/part-$key-"* ;; # merged: the next pass
    *) exit "$code" ;;
    esac
done
