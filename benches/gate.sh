#!/usr/bin/env bash
# The gate before a release: is the engine still as many times faster than a plain loop as it was?
#
#   benches/gate.sh            exit code 1 where a workload falls below 80 % of its recorded ratio
#   benches/gate.sh --record   records this machine's ratios in benches/recorded.json
#   benches/gate.sh --proof    shows that the gate closes: slowed down on purpose, it must fail
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1-}" = --proof ]; then
    if cargo bench --bench gate -- --path baseline; then
        echo "the gate let a deliberate slow-down through" >&2
        exit 1
    fi
    echo "the gate stopped the deliberate slow-down"
else
    cargo bench --bench gate -- "$@"
fi
