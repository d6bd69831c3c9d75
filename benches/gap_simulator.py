"""Writes reports/gap-simulator.md: how the gap of simulators does on the practice benches.

    python3 benches/gap_simulator.py BENCHES ANSWERS

BENCHES is a folder of cases with truth, exact posterior, benches.py and score.py; ANSWERS holds what its run.py
found with the package installed, or the command line, one file a case. Needs numpy and what the benches need.
"""
import json
import pathlib
import re
import subprocess
import sys
import time

# what score.py calls each figure, what it is, and the goal
FIGURES = [
    ("verdict right, effect in list", "verdict right where the truth is on the list", "within 0.03 of exact"),
    ("mean log probability of truth", "mean log probability of the truth", "within 0.05 of exact"),
    ("alarm on gap-free data", "alarms on data without a gap", "at most one"),
    ("withheld effect refused", "withheld effects refused, of those that exact refuses", "at least 0.9"),
    ("falsely 'unexplained'", "falsely unexplained", "as exact"),
    ("0.95 intervals hold the truth", "0.95 intervals that hold the truth", "0.90 to 0.99"),
    ("error elsewhere, over exact", "error of predictions elsewhere, over exact (median)", "at most 1.10"),
    ("own processor time", "own processor time of gumption", "at most 30 s"),
    ("", "runs, largest", "at most 400"),
]

TEXT = """# The gap of simulators

Written by `python3 benches/gap_simulator.py BENCHES ANSWERS` from answers to {cases} practice cases on {benches} simulated benches: {names}. Their data are synthetic with {least} to {most} rows and known truth; {withheld} of them hold an effect that is not on their list. *Exact* is the posterior by the simulator itself, with as many runs as it takes, checked against nested sampling: what these data tell at best. Each case had 400 runs at most.

| | gumption | exact | goal |
|---|---|---|---|
{table}

score.py says: *{verdict}*

## Case by case

The time of gumption is processor time without the simulator, the time of the simulator that of one run times the number of runs. `beside` means that something without a name is left beside the effects.

| case | bench | rows | made with | withheld | verdict | probability | exact | runs | gumption | simulator |
|---|---|---|---|---|---|---|---|---|---|---|
{rows}

{summary}
"""


def scores(benches, answers):
    """What score.py prints, and its last line."""
    command = [sys.executable, "score.py", ".", str(answers.resolve())]
    said = subprocess.run(command, cwd=benches, capture_output=True, text=True, check=False)
    lines = said.stdout.splitlines()
    if not lines:
        sys.exit(f"score.py: {said.stderr}")
    return lines[:-1], lines[-1]


def table(lines):
    rows = []
    for label, name, goal in FIGURES:
        found = next((line[len(label):] for line in lines if label and line.startswith(label)), "")
        value, exact = found.strip(), ""
        if pair := re.fullmatch(r"program (.*?) +\(where the exact posterior refuses: (.*) of the withheld\)", value):
            value, exact = pair[1], f"refuses {pair[2]} of the withheld"
        elif pair := re.fullmatch(r"program (.*?) +exact (.*)", value):
            value, exact = pair.groups()
        elif pair := re.fullmatch(r"median (\S+) +\(exact: (.*)\)", value):
            value, exact = pair.groups()
        elif label == "own processor time":
            value = value.split(";")[0]
        elif not label:
            value = next((line.rsplit(" ", 1)[1] for line in lines if "runs: largest" in line), "")
        rows.append(f"| {name} | {value} | {exact} | {goal} |")
    return "\n".join(rows)


def named(effects):
    return "unexplained" if effects is None else " + ".join(effects) or "none"


def exact_verdict(oracle):
    best = max(oracle["hypotheses"], key=lambda hypothesis: hypothesis["probability"])
    return f"{named(best['effects'])} {best['probability']:.3f}"


def verdict(answer):
    found = answer["verdict"]
    effects = None if found["kind"] == "unexplained" else found["effects"]
    best = max(answer["hypotheses"], key=lambda hypothesis: hypothesis["probability"])
    return named(effects) + (", beside" if best.get("beside") else ""), best["probability"]


def seconds_of_a_run(bench, data, values):
    """Processor time of the second run: the first may compile."""
    inputs = {name: value for name, value in values.items() if "/" not in name}
    for _ in range(2):
        begin = time.process_time()
        bench.simulate(data, **inputs)
    return time.process_time() - begin


def report(folder, answers):
    sys.path.insert(0, str(folder.resolve()))
    from benches import BENCHES
    from score import read

    rows, names, own, runs, of_simulator = [], set(), [], [], []
    for case in sorted(folder.glob("[0-9]*")):
        truth, oracle = (json.loads((folder / kind / f"{case.name}.json").read_text()) for kind in ("truth", "oracle"))
        names.add(truth["bench"])
        data = read(case / "data.csv")
        start = [case.name, truth["bench"], len(next(iter(data.values()))), named(truth["effects"]),
                 "yes" if truth["kind"] == "withheld" else ""]
        path = answers / f"{case.name}.json"
        if not path.exists():
            rows.append([*start, "no answer", "", exact_verdict(oracle), "", "", ""])
            continue
        answer = json.loads(path.read_text())
        said, probability = verdict(answer)
        of_simulator.append(answer["runs"]*seconds_of_a_run(BENCHES[truth["bench"]], data, truth["values"]))
        own.append(answer["seconds"])
        runs.append(answer["runs"])
        rows.append([*start, said, f"{probability:.3f}", exact_verdict(oracle), answer["runs"],
                     f"{answer['seconds']:.1f} s", f"{of_simulator[-1]:.2g} s"])
    if not own:
        sys.exit(f"no answer in {answers}")
    lines, last = scores(folder, answers)
    middle = sorted(runs)[len(runs)//2]
    summary = (f"Runs: {sum(runs)} in all, {middle} in the middle, {max(runs)} at most. Processor time: gumption {sum(own):.0f} s "
               f"in all and {max(own):.1f} s at most, the simulators about {sum(of_simulator):.2g} s in all.")
    withheld = sum(row[4] == "yes" for row in rows)
    counts = [row[2] for row in rows]
    return TEXT.format(cases=len(rows), withheld=withheld, least=min(counts), most=max(counts), benches=len(names), names=", ".join(sorted(names)), table=table(lines), verdict=last,
                       rows="\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows), summary=summary)


if __name__ == "__main__":
    text = report(*(pathlib.Path(path) for path in sys.argv[1:3]))
    (pathlib.Path(__file__).parent.parent / "reports" / "gap-simulator.md").write_text(text)
