"""How the cost grows with the work: CPU time against trials, inputs, rows, outputs and the candidates of a
diagnosis, each over the range that people use."""

import math
import statistics
import tempfile
from pathlib import Path

import waits
from contest import contest

# What the time may grow with at most: each pair of outputs has a correlation coefficient, and each pair of
# candidates is a hypothesis.
MUST = {"trials": 1, "inputs": 1, "rows": 1, "outputs": 2, "candidates": 2}
WHAT = {
    "trials": "trials of W1",
    "inputs": "inputs of a sum, 1e5 trials",
    "rows": "rows of conditions, without trials",
    "outputs": "outputs, 1e5 trials",
    "candidates": "candidate effects in `gap`",
}


def measured(plan):
    """Seconds by the amount of work, by what grows. Trials are those of the curves."""
    counts = {
        "inputs": [10, 100, 1000, 10_000],
        "rows": [1, 100, 10_000, 1_000_000],
        "outputs": [1, 3, 10, 30, 100, 300],
        "candidates": [2, 5, 10, 20, 40],
    }
    if plan.quick:
        counts = {what: some[:3] for what, some in counts.items()}
    found = {}
    for what, some in counts.items():
        found[what] = []
        for count in some:
            plan.say(f"{count} {what}")
            found[what].append([count, seconds(plan, what, count)])
    return found


def seconds(plan, what, count):
    workload = {"inputs": "sum", "outputs": "outputs"}.get(what)
    if workload:
        name = f"{workload}:{count}"
        line = contest([plan.engine(name, name, "1e5")], plan.rounds(3))[name]
        return statistics.median(line["cpu_s"])
    write, arguments = {
        "rows": (waits.rows, ["run", "rows.json"]),
        "candidates": (waits.candidates, ["gap", "candidates.json"]),
    }[what]
    with tempfile.TemporaryDirectory() as name:
        write(Path(name), count)
        runs = [waits.used([plan.command, *arguments, "--quiet"], name) for _ in range(plan.rounds(3))]
    return waits.middle(runs, "cpu_s")


def exponent(points):
    """The power of the work that the time grows with, between the last two points."""
    (less, before), (more, after) = points[-2:]
    return math.log(after / before) / math.log(more / less)
