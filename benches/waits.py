#!/usr/bin/env python3
"""What users wait for beside runs: whole commands of the program and tasks of the Python package, and
of an earlier version where one is given, in turn.

    benches/waits.py --program target/release/gumption
    benches/waits.py --program NEW --before OLD --python NEW_FOLDER --python-before OLD_FOLDER

A Python folder is one that `import gumption` is found in. Times are processor times of all threads,
memory is the most that a process held. `benches/compare.sh` measures the same.
"""

import argparse
import json
import math
import os
import random
import statistics
import struct
import subprocess
import sys
import tempfile
import wave
from pathlib import Path

SAMPLING_RATE = 48_000
MINUTES = 60
LABORATORIES = 100
DRAWS = 20
ROWS = 1_000_000
CORRELATED = 2000


def recording(folder, minutes):
    """A tone of 80 Hz in noise, 16 bits, and the recipe that reads it."""
    noise = random.Random(1)
    # ten seconds again and again: 80 Hz has whole periods in them
    samples = [
        round(9000 * math.sin(2 * math.pi * 80 * n / SAMPLING_RATE) + noise.gauss(0, 200))
        for n in range(10 * SAMPLING_RATE)
    ]
    data = struct.pack(f"<{len(samples)}h", *samples)
    with wave.open(str(folder / "long.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(SAMPLING_RATE)
        for _ in range(6 * minutes):
            file.writeframesraw(data)
    recipe = {
        "recordings": {"run": {"file": "long.wav"}},
        "channels": {"a": {"column": 1}},
        "frequency": 80,
    }
    (folder / "recipe.json").write_text(json.dumps(recipe))


def laboratories(folder):
    """Results of which about half contradict the others."""
    noise = random.Random(2)
    lines = ["label,x,U"]
    for number in range(LABORATORIES):
        shift = 0 if number % 2 else noise.uniform(-20, 20)
        lines.append(f"L{number},{10 + shift + noise.gauss(0, 1):.4f},{0.5 + noise.random():.3f}")
    (folder / "laboratories.csv").write_text("\n".join(lines) + "\n")


def fits(folder):
    """Lines through ten points, one of them with uncertain abscissae: in each trial it is fitted anew.
    Clause 8 is undecided after a million trials."""
    noise = random.Random(3)

    def line(u_x):
        x = [1 + place for place in range(10)]
        y = [round(0.3 + 1.7 * value + noise.gauss(0, 0.02), 5) for value in x]
        of_x = {"unit": "V", "values": x}
        if u_x:
            of_x["standard_uncertainty"] = u_x
        return {"form": "straight-line", "x": of_x, "y": {"unit": "mm", "values": y, "standard_uncertainty": 0.02}}

    model = {
        "format": 2,
        "fits": {"a": line(0.02), "b": line(None), "c": line(None)},
        "inputs": {"v": {"unit": "V", "distribution": "normal", "mean": 5, "std": 0.02}},
        "equations": {"d": "a.a + a.b*v + (b.a + b.b*v)*(c.a + c.b*v)/1 [mm]"},
        "outputs": {"d": {"unit": "mm"}},
    }
    (folder / "fits.json").write_text(json.dumps(model))


def rows(folder, count):
    """A component of gravity at so many reference values and tilts, by the law of propagation."""
    lines = ["aref [m/s^2],alpha [deg]"]
    lines += [f"{9 + 2 * row / count:.7f},{10 + 60 * (row % 1000) / 1000:.3f}" for row in range(count)]
    (folder / "rows.csv").write_text("\n".join(lines) + "\n")
    (folder / "rows.json").write_text(json.dumps({**OF_ROWS, "conditions": {"file": "rows.csv"}}))


OF_ROWS = {
    "format": 1,
    "inputs": {
        "a_ref": {"unit": "m/s^2", "distribution": "normal", "mean": "aref", "std": 0.01},
        "tilt": {"unit": "deg", "distribution": "rectangular", "mean": "alpha", "half_width": 0.1},
    },
    "equations": {"a": "a_ref*sin(tilt)"},
    "outputs": {"a": {"unit": "m/s^2"}},
    "monte_carlo": {"trials": 0},
}


def candidates(folder, count):
    """Sixty rows of a constant sim whose data have a wave, and so many waves of other lengths as
    candidate effects, that one among them."""
    noise = random.Random(4)
    at = [1 + row for row in range(60)]
    data = [round(10 + 0.3 * math.cos(0.1 * x) + noise.gauss(0, 0.05), 5) for x in at]
    effects = {
        f"wave_{number}": {
            "parameters": {"d": {"unit": "V", "distribution": "normal", "mean": 0, "std": 0.2}},
            "overrides": {"y": f"y + d*cos({number / 10}*t)"},
        }
        for number in range(1, count + 1)
    }
    case = {
        "format": 1,
        "inputs": {"a": {"unit": "V", "distribution": "normal", "mean": 10, "std": 0.05}},
        "conditions": {"t": {"unit": "1"}},
        "equations": {"y": "a"},
        "outputs": {"y": {"unit": "V"}},
        "observations": {
            "values": {"t [1]": at, "y [V]": data, "u [V]": [0.05] * len(at)},
            "columns": {"y": {"value": "y", "standard_uncertainty": "u"}},
        },
        "effects": effects,
    }
    (folder / "candidates.json").write_text(json.dumps(case))


def correlated(folder, count):
    """The sum of so many normal quantities with the coefficient 1 between any two."""
    names = [f"x_{number}" for number in range(count)]
    model = {
        "format": 1,
        "inputs": {name: {"distribution": "normal", "mean": 1, "std": 0.1} for name in names},
        "correlation_matrix": {"names": names, "values": [[1] * count] * count},
        "equations": {"y": " + ".join(names)},
        "outputs": {"y": {}},
    }
    (folder / "correlated.json").write_text(json.dumps(model))


def budget_in_python():
    """CPU seconds of one budget of a decorated function of three inputs, made anew."""
    import time

    import numpy as np

    import gumption as gu

    @gu.model(inputs={"mass": "g", "diameter": "mm", "height": "mm"}, outputs={"rho": "kg/m^3"})
    def density(mass, diameter, height):
        return 4 * mass / (np.pi * diameter**2 * height)

    def once():
        inputs = gu.normal(21.32, 0.01), gu.normal(12.006, 0.005), gu.rectangular(24, 0.02)
        return density(*inputs).run(trials=0)["rho"].gum.standard_uncertainty

    times = 200
    for _ in range(times // 10):
        once()
    before = time.process_time()
    for _ in range(times):
        once()
    return (time.process_time() - before) / times


def rows_in_python(count):
    """CPU seconds of [`rows`] from a table in memory."""
    import time

    import numpy as np

    import gumption as gu

    conditions = {
        "aref": {"unit": "m/s^2", "values": [9]},
        "alpha": {"unit": "deg", "values": [10]},
    }
    number = np.arange(count)
    table = {"aref": 9 + 2 * number / count, "alpha": 10 + 60 * (number % 1000) / 1000}
    before = time.process_time()
    result = gu.from_dict({**OF_ROWS, "conditions": conditions}).with_conditions(table).run()
    assert math.isfinite(result["a"].gum.standard_uncertainty.sum())
    return time.process_time() - before


class Wait:
    """A command of the program, or a task of this file in Python, and the goals of its processor time in
    seconds and its memory in MB, if there are any."""

    def __init__(self, what, arguments=None, goal=None, goal_mb=None, task=None):
        self.what, self.arguments, self.task = what, arguments, task
        self.goal, self.goal_mb = goal, goal_mb

    def run(self, tool, folder):
        """Seconds and MB with a program, or with a folder of the package; `None` where it is refused."""
        if self.task is None:
            return used([os.path.abspath(tool), *self.arguments, "--quiet"], folder)
        command = [sys.executable, os.path.abspath(__file__), "--task", *self.task]
        return used(command, folder, {**os.environ, "PYTHONPATH": os.path.abspath(tool)})


def sizes(quick):
    """Minutes, draws, rows and correlated inputs."""
    return (1, 2, ROWS // 100, CORRELATED // 10) if quick else (MINUTES, DRAWS, ROWS, CORRELATED)


def prepare(folder, quick):
    """The files of all waits."""
    minutes, _, count, linked = sizes(quick)
    recording(folder, minutes)
    laboratories(folder)
    fits(folder)
    rows(folder, count)
    correlated(folder, linked)


def waits(folder, quick):
    minutes, draws, count, linked = sizes(quick)
    models = Path("models").resolve()
    plane = str(models / "inclined_plane_spurious.json")
    return [
        Wait("three fits, one with uncertain abscissae", ["run", str(folder / "fits.json")], 5),
        Wait("`assumptions` of the inclined plane with spurious motion", ["assumptions", plane], 0.7),
        Wait("`run --save` of the same", ["run", plane, "--save", str(folder / "saved.json")]),
        Wait("`gap` of the lateral motion", ["gap", str(models / "gap/lateral_motion/case.json")], 1.3),
        Wait(
            f"`gap-check`, {draws} draws of the plane with a resonance",
            ["gap-check", str(models / "gap/plane_resonance/case.json"), "--draws", str(draws)],
            11.5,
        ),
        Wait("one budget from Python, all told", goal=0.3e-3, task=["budget"]),
        Wait(f"{count:,} rows of conditions", ["run", str(folder / "rows.json")], 1.5, 500),
        Wait(f"{count:,} rows of conditions in Python", goal=1.5, goal_mb=500, task=["rows", str(count)]),
        Wait(f"{linked:,} fully correlated inputs", ["run", str(folder / "correlated.json")], 2, 200),
        Wait(f"`observe` of {minutes} min of WAV", ["observe", str(folder / "recipe.json")], 15),
        Wait(
            f"`compare` of {LABORATORIES} inconsistent laboratories",
            ["compare", str(folder / "laboratories.csv")],
            2,
        ),
    ]


def used(command, folder, env=None):
    """Seconds of a process on all its threads, or those that it prints, and the most MB that it held;
    `None` where it is refused."""
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL, cwd=folder, env=env)
        _, status, spent = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode not in (0, 3):
            return None
        seconds = spent.ru_utime + spent.ru_stime
        if env is not None:
            out.seek(0)
            seconds = float(out.read())
    return {"cpu_s": seconds, "mb": spent.ru_maxrss * 1024 / 1e6}


def measured(programs, packages, rounds, quick):
    """For each wait what each program or package used in each run; both by the version's name. A program
    that has not the command, or refuses it, has none."""
    done = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        # by another process: a command begins with the memory of the one that starts it
        command = [sys.executable, os.path.abspath(__file__), "--prepare", name]
        subprocess.run([*command, *(["--quick"] if quick else [])], check=True)
        for wait in waits(folder, quick):
            print(wait.what, file=sys.stderr, flush=True)
            tools = programs if wait.task is None else packages
            runs = {version: [] for version in tools}
            for _ in range(rounds):
                for version, tool in tools.items():
                    if found := wait.run(tool, folder):
                        runs[version].append(found)
            if tools:
                goals = {"goal": wait.goal, "goal_mb": wait.goal_mb}
                done.append({"what": wait.what, **goals, "runs": runs})
    return done


def versions(before, after):
    """The tools that are given, by the version's name."""
    return {name: tool for name, tool in (("before", before), ("after", after)) if tool}


def middle(runs, what):
    return statistics.median(run[what] for run in runs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="target/release/gumption")
    parser.add_argument("--before", help="an earlier version of the program")
    parser.add_argument("--python", help="the folder of the Python package")
    parser.add_argument("--python-before", help="that of an earlier version")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--json", action="store_true", help="all runs as JSON")
    parser.add_argument("--task", nargs="+", help=argparse.SUPPRESS)
    parser.add_argument("--prepare", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.task:
        name, *counts = arguments.task
        print({"budget": budget_in_python, "rows": rows_in_python}[name](*map(int, counts)))
        return
    if arguments.prepare:
        prepare(arguments.prepare, arguments.quick)
        return
    programs = versions(arguments.before, arguments.program)
    packages = versions(arguments.python_before, arguments.python)
    found = measured(programs, packages, arguments.rounds, arguments.quick)
    if arguments.json:
        print(json.dumps(found))
        return
    for wait in found:
        cells = [
            f"{name} {middle(runs, 'cpu_s'):.4g} s, {middle(runs, 'mb'):.0f} MB" if runs else f"{name} refused"
            for name, runs in wait["runs"].items()
        ]
        goal = f"goal {wait['goal']:g} s" if wait["goal"] else ""
        goal += f", {wait['goal_mb']} MB" if wait["goal_mb"] else ""
        print("; ".join([wait["what"], *cells, *([goal] if goal else [])]))


if __name__ == "__main__":
    main()
