#!/usr/bin/env python3
"""The package beside others: writes reports/python.md.

    pip install './python' && pip install -r python/benches/requirements.txt
    python python/benches/report.py            # some minutes; leave the machine alone
    python python/benches/report.py --quick    # does everything run, do all agree?

Every tool does the whole of a task in its turn, again and again: a change of the machine's speed meets
all of them. A figure is the median of the rounds, a ratio the median of the rounds' ratios.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.metadata
import math
import os
import platform
import statistics
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import gumption as gu

ROOT = Path(__file__).parents[2]
DEGREE = math.pi / 180

#: Name, distribution, estimate and standard deviation or half-width in SI units, unit of the model.
PLANE = [
    ("a_ref", "normal", 10.0, 0.01),
    ("tilt", "uniform", 35 * DEGREE, 0.1 * DEGREE),
    ("rotation", "uniform", 30 * DEGREE, 0.1 * DEGREE),
    ("x", "uniform", 0.3, 0.0025),
    ("y", "uniform", 0.2, 0.0025),
    ("z", "uniform", 0.15, 0.0025),
    ("p", "normal", 40 * DEGREE, 2 * DEGREE),
    ("q", "normal", -65 * DEGREE, 2 * DEGREE),
    ("r", "normal", 3 * DEGREE, 2 * DEGREE),
]

CYLINDER = [
    ("mass", "normal", 21.32e-3, 0.01e-3),
    ("diameter", "normal", 12.006e-3, 0.005e-3),
    ("height", "uniform", 24e-3, 0.02e-3),
]


def cylinder_of(m: Any, mass: Any, diameter: Any, height: Any) -> Any:
    return 4 * mass / (math.pi * diameter**2 * height)


def plane_of(m: Any, a_ref: Any, tilt: Any, rotation: Any, x: Any, y: Any, z: Any, p: Any, q: Any, r: Any) -> Any:
    """Prato et al. (2020), eq (8) as printed; `m` is the library whose functions are taken."""
    # of an uncertain number of GTC `abs` is a plain one
    modulus = getattr(m, "magnitude", abs)
    re = modulus(a_ref * m.sin(tilt) * m.cos(rotation))
    im = 0.0
    for amplitude, phase in (
        (modulus(x * m.cos(tilt) * m.cos(rotation)), p),
        (modulus(y * m.sin(rotation)), q),
        (modulus(z * m.sin(tilt) * m.cos(rotation)), r),
    ):
        re = re + amplitude * m.cos(phase)
        im = im + amplitude * m.sin(phase)
    return m.sqrt(re * re + im * im)


WORKLOADS = {"cylinder": (CYLINDER, cylinder_of), "W1": (PLANE, plane_of)}

#: The same as text for those who read text.
TEXTS = {
    "cylinder": "4*mass/(pi*diameter^2*height)",
    "W1": "sqrt((abs(a_ref*sin(tilt)*cos(rotation)) + abs(x*cos(tilt)*cos(rotation))*cos(p)"
    " + abs(y*sin(rotation))*cos(q) + abs(z*sin(tilt)*cos(rotation))*cos(r))^2"
    " + (abs(x*cos(tilt)*cos(rotation))*sin(p) + abs(y*sin(rotation))*sin(q)"
    " + abs(z*sin(tilt)*cos(rotation))*sin(r))^2)",
}

Task = Callable[[], tuple[float, float]]


def spread(kind: str, width: float) -> float:
    return width if kind == "normal" else width / math.sqrt(3)


# each function prepares a task and gives it: estimate and standard uncertainty of one evaluation


def expression(workload: str) -> Any:
    inputs, function = WORKLOADS[workload]
    shapes = {"normal": gu.normal, "uniform": gu.rectangular}
    return function(np, *(shapes[kind](x, w) for _, kind, x, w in inputs))


def with_gumption(workload: str, trials: int) -> Task:
    return lambda: figures_of(expression(workload).run(trials=trials), trials)


def with_a_model(workload: str, trials: int) -> Task:
    """The same with a model that was made before."""
    model = expression(workload).model()
    return lambda: figures_of(model.run(trials=trials), trials)


def figures_of(result: gu.Result, trials: int) -> tuple[float, float]:
    method = result["y"].monte_carlo if trials else result["y"].gum
    return float(method.estimate), float(method.standard_uncertainty)


def with_numpy(workload: str, trials: int) -> Task:
    inputs, function = WORKLOADS[workload]
    draw = np.random.default_rng(1)

    def task() -> tuple[float, float]:
        values = [
            draw.normal(x, w, trials) if kind == "normal" else draw.uniform(x - w, x + w, trials)
            for _, kind, x, w in inputs
        ]
        y = function(np, *values)
        return summary(y)

    return task


def summary(y: Any) -> tuple[float, float]:
    """Mean and standard deviation of trials; both coverage intervals and the median are computed as well."""
    mean, u = y.mean(), y.std(ddof=1)
    y.sort()
    q = int(0.95 * y.size)
    (y[q:] - y[: y.size - q]).argmin(), y[y.size // 2]
    return float(mean), float(u)


def with_numba(workload: str, trials: int) -> Task:
    """A loop over trials that numba has compiled before, with the draws of its own generator."""
    import numba

    inputs, _ = WORKLOADS[workload]
    draws = "\n".join(
        f"        {name} = {f'np.random.normal({x!r}, {w!r})' if kind == 'normal' else f'np.random.uniform({x - w!r}, {x + w!r})'}"
        for name, kind, x, w in inputs
    )
    formula = TEXTS[workload].replace("^", "**")
    source = f"def trials_of(found):\n    for place in range(found.size):\n{draws}\n        found[place] = {formula}\n"
    known: dict[str, Any] = {"np": np, "pi": math.pi, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(source, known)
    compiled = numba.njit(known["trials_of"])

    def task() -> tuple[float, float]:
        y = np.empty(trials)
        compiled(y)
        return summary(y)

    return task


def with_uncertainties(workload: str, trials: int) -> Task:
    from uncertainties import ufloat, umath

    inputs, function = WORKLOADS[workload]

    def task() -> tuple[float, float]:
        y = function(umath, *(ufloat(x, spread(kind, w)) for _, kind, x, w in inputs))
        return y.nominal_value, y.std_dev

    return task


def with_gtc(workload: str, trials: int) -> Task:
    import GTC

    inputs, function = WORKLOADS[workload]

    def task() -> tuple[float, float]:
        y = function(GTC, *(GTC.ureal(x, spread(kind, w)) for _, kind, x, w in inputs))
        return GTC.value(y), GTC.uncertainty(y)

    return task


def with_metrolopy(workload: str, trials: int) -> Task:
    import metrolopy as uc

    inputs, function = WORKLOADS[workload]

    def task() -> tuple[float, float]:
        values = [
            uc.gummy(x, u=w) if kind == "normal" else uc.gummy(uc.UniformDist(center=x, half_width=w))
            for _, kind, x, w in inputs
        ]
        y = function(uc, *values)
        if not trials:
            return float(y.x), float(y.u)
        uc.gummy.simulate([y], n=trials)
        y.cisim
        return float(y.xsim), float(y.usim)

    return task


def with_suncal(workload: str, trials: int) -> Task:
    import suncal

    inputs, _ = WORKLOADS[workload]

    def task() -> tuple[float, float]:
        # it knows no `abs`; what stands in it is positive here
        model = suncal.Model(f"found = {TEXTS[workload].replace('abs(', '(')}")
        for name, kind, x, w in inputs:
            if kind == "normal":
                model.var(name).measure(x).typeb(dist="normal", unc=w, k=1)
            else:
                model.var(name).measure(x).typeb(dist="uniform", a=w)
        if not trials:
            found = model.calculate_gum()
            return float(found.expected["found"]), float(found.uncertainty["found"])
        found = model.monte_carlo(samples=trials)
        found.expand("found", conf=0.95)
        return float(found.expected["found"]), float(found.uncertainty["found"])

    return task


def with_openturns(workload: str, trials: int) -> Task:
    import openturns as ot

    inputs, _ = WORKLOADS[workload]
    names = [name for name, *_ in inputs]

    def task() -> tuple[float, float]:
        function = ot.SymbolicFunction(names, [TEXTS[workload].replace("pi", repr(math.pi))])
        marginals = [
            ot.Normal(x, w) if kind == "normal" else ot.Uniform(x - w, x + w) for _, kind, x, w in inputs
        ]
        vector = ot.CompositeRandomVector(function, ot.RandomVector(ot.JointDistribution(marginals)))
        y = vector.getSample(trials)
        for p in (0.025, 0.5, 0.975):
            y.computeQuantilePerComponent(p)
        return y.computeMean()[0], y.computeStandardDeviation()[0]

    return task


MONTE_CARLO = {
    "gumption": with_gumption,
    "gumption, model made before": with_a_model,
    "numpy": with_numpy,
    "numba, compiled before": with_numba,
    "metrolopy": with_metrolopy,
    "suncal": with_suncal,
    "openturns": with_openturns,
}
BUDGET = {
    "gumption": with_gumption,
    "gumption, model made before": with_a_model,
    "uncertainties": with_uncertainties,
    "GTC": with_gtc,
    "metrolopy": with_metrolopy,
    "suncal": with_suncal,
}


class Measured:
    """Times of several tools, taken in turn."""

    def __init__(self) -> None:
        self.times: dict[str, list[float]] = {}
        self.processor: dict[str, list[float]] = {}
        self.found: dict[str, tuple[float, float]] = {}
        self.missing: dict[str, str] = {}

    def round(self, tasks: dict[str, Callable[[], Any]], repeats: int = 1) -> None:
        for name, task in tasks.items():
            wall, processor = time.perf_counter(), time.process_time()
            for _ in range(repeats):
                found = task()
            self.processor.setdefault(name, []).append((time.process_time() - processor) / repeats)
            self.times.setdefault(name, []).append((time.perf_counter() - wall) / repeats)
            self.found[name] = found

    def ratio(self, name: str, times: dict[str, list[float]]) -> float:
        own = times["gumption"]
        return statistics.median(other / mine for other, mine in zip(times[name], own))


def side_by_side(tools: dict[str, Any], workload: str, trials: int, rounds: int) -> Measured:
    measured, tasks = Measured(), {}
    for name, prepare in tools.items():
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                task = prepare(workload, trials)
                # what is loaded and compiled once is not counted; what a task makes is
                task()
            tasks[name] = task
        except Exception as error:  # noqa: BLE001 - a tool that is not there, or has no such function
            measured.missing[name] = f"{type(error).__name__}: {error}"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(rounds):
            # a budget takes less than a clock tells
            measured.round(tasks, 1 if trials else 20)
    agree(measured, trials)
    return measured


def agree(measured: Measured, trials: int) -> None:
    """All tools have the same figures within what their trials let them scatter."""
    mean, u = measured.found["gumption"]
    for name, (other, other_u) in measured.found.items():
        # six standard errors of both; budgets to a few roundings of other orders of operations
        # and MetroloPy's derivatives by differences
        tolerance = 6 * math.sqrt(2 / trials) if trials else 1e-4 if name == "metrolopy" else 1e-6
        if abs(other - mean) > tolerance * u or abs(other_u / u - 1) > tolerance:
            raise SystemExit(f"{name} gives {other} and u = {other_u}, gumption {mean} and {u}")


def budgets(rows: int, rounds: int) -> Measured:
    """Budgets of the cylinder in columns; what takes long does fewer rows, and its time is scaled."""
    from GTC import ureal
    from GTC import value as gtc_value
    from uncertainties import unumpy

    draw = np.random.default_rng(1)
    mass, diameter = draw.uniform(20, 22, rows) * 1e-3, draw.uniform(11.9, 12.1, rows) * 1e-3
    few, fewer = max(rows // 50, 10), max(rows // 200, 10)
    function = gu.model(
        inputs={"mass": "1", "diameter": "1", "height": "1"}, outputs={"density": "1"}
    )(lambda mass, diameter, height: 4 * mass / (np.pi * diameter**2 * height))

    def own() -> Any:
        found = gu.budgets(function, mass=(mass, 1e-5), diameter=(diameter, 5e-6), height=(24e-3, 1e-5))
        return found.standard_uncertainty

    def with_unumpy() -> Any:
        m = unumpy.uarray(mass[:few], np.full(few, 1e-5))
        d = unumpy.uarray(diameter[:few], np.full(few, 5e-6))
        h = unumpy.uarray(np.full(few, 24e-3), np.full(few, 1e-5))
        return unumpy.std_devs(4 * m / (np.pi * d**2 * h))

    def with_gtc_rows() -> Any:
        return [
            (lambda y: (gtc_value(y), y.u))(
                4 * ureal(m, 1e-5) / (math.pi * ureal(d, 5e-6) ** 2 * ureal(24e-3, 1e-5))
            )[1]
            for m, d in zip(mass[:fewer].tolist(), diameter[:fewer].tolist())
        ]

    def with_whole_arrays() -> Any:
        y = 4 * mass / (np.pi * diameter**2 * 24e-3)
        parts = (y / mass * 1e-5) ** 2 + (2 * y / diameter * 5e-6) ** 2 + (y / 24e-3 * 1e-5) ** 2
        return np.sqrt(parts)

    tasks = {
        "gumption": own,
        "uncertainties.unumpy": with_unumpy,
        "GTC": with_gtc_rows,
        "numpy, derivatives by hand": with_whole_arrays,
    }
    measured = Measured()
    for task in tasks.values():
        task()
    for _ in range(rounds):
        measured.round(tasks)
    u = np.asarray(measured.found["gumption"])
    for name, other in measured.found.items():
        assert np.allclose(np.asarray(other), u[: len(other)], rtol=1e-10), name
    for name, done in (("uncertainties.unumpy", few), ("GTC", fewer)):
        for times in (measured.times, measured.processor):
            times[name] = [seconds * rows / done for seconds in times[name]]
    return measured


def call_of_1000() -> tuple[float, float]:
    """Median and least time of a call of 1,000 trials, in milliseconds."""
    model = gu.load(ROOT / "models" / "inclined_plane.json")
    times = []
    for seed in range(1500):
        began = time.perf_counter()
        model.run(trials=1000, seed=seed)
        times.append(1e3 * (time.perf_counter() - began))
    return statistics.median(times[100:]), min(times[100:])


INTERRUPTED = """
import os, signal, sys, threading, time
import gumption as gu
m = gu.load(sys.argv[1])
# a command in the background begins with it ignored
signal.signal(signal.SIGINT, signal.default_int_handler)
sent = []
def interrupt():
    time.sleep(0.3)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    m.run(trials=10**11)
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
"""


def interrupts(count: int) -> list[float]:
    """How long after the signal the exception is there, in seconds."""
    command = [sys.executable, "-c", INTERRUPTED, str(ROOT / "models" / "inclined_plane.json")]
    said = [subprocess.run(command, capture_output=True, text=True, check=True) for _ in range(count)]
    return sorted(float(one.stdout) for one in said)


def version(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "not there"


def table(measured: Measured, unit: str, scale: float) -> list[str]:
    lines = [
        f"| tool | time, {unit} | CPU time, {unit} | times gumption's | in CPU time |",
        "|---|---:|---:|---:|---:|",
    ]
    for name, times in measured.times.items():
        wall = f"{statistics.median(times) * scale:.3g}"
        processor = f"{statistics.median(measured.processor[name]) * scale:.3g}"
        ratio = measured.ratio(name, measured.times)
        of_processor = measured.ratio(name, measured.processor)
        lines.append(f"| {name} | {wall} | {processor} | {ratio:.3g} | {of_processor:.3g} |")
    lines += [f"| {name} | not measured: {why} | | | |" for name, why in measured.missing.items()]
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="few trials, to the terminal")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--build", default="release", help="the profile of the installed wheel")
    asked = parser.parse_args()
    trials = 10_000 if asked.quick else 1_000_000
    rows = 10_000 if asked.quick else 1_000_000
    rounds = 1 if asked.quick else asked.rounds
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else math.nan
    packages = ["numpy", "numba", "uncertainties", "GTC", "metrolopy", "suncal", "openturns"]
    lines = [
        "# The Python package beside others",
        "",
        "Made by `python/benches/report.py`. Every tool does the whole of a task in its turn; times are "
        f"medians of {rounds} rounds, ratios medians of the rounds' ratios. A task begins with its inputs: the "
        "expression or model is made in it, except where a line says `made before`. gumption computes on all "
        f"{os.cpu_count()} threads, the others on one unless they have their own; the last column "
        "compares CPU time. Standard deviation, median and both coverage intervals are part of a Monte "
        "Carlo run of gumption and numpy; the others give what they have.",
        "",
        f"gumption {gu.__version__} ({asked.build} build), Python {platform.python_version()}, "
        + ", ".join(f"{name} {version(name)}" for name in packages)
        + f"; {os.cpu_count()} processors, load of the machine before {load:.1f}.",
    ]
    if load > 0.5 * (os.cpu_count() or 1):
        lines += ["", "**The machine was busy with other work: read the ratios, not the times.**"]
    for name, what in (("cylinder", "the density of a cylinder, three inputs"), ("W1", "the inclined "
                       "plane with spurious motion (Prato et al. 2020, eq (8)), nine inputs")):  # fmt: skip
        found = side_by_side(MONTE_CARLO, name, trials, rounds)
        lines += ["", f"## {name}: {trials:,} trials", "", f"{what}.", "", *table(found, "ms", 1e3)]
        found = side_by_side(BUDGET, name, 0, 5 * rounds)
        lines += ["", f"One budget of {name} by the law of propagation:", "", *table(found, "us", 1e6)]
    found = budgets(rows, rounds)
    lines += ["", f"## Budgets of {rows:,} rows", ""]
    lines += ["`gu.budgets` of the cylinder. Tools that take long do a fiftieth (unumpy) or a two "
              "hundredth (GTC) of the rows, and their times are scaled.", ""]  # fmt: skip
    lines += table(found, "s", 1.0)
    median, least = call_of_1000()
    ends = interrupts(3 if asked.quick else 20)
    lines += [
        "",
        "## Calls",
        "",
        "| | measured | wanted |",
        "|---|---:|---:|",
        f"| a call of 1,000 trials of the inclined plane (three outputs), median | {median:.3f} ms | |",
        f"| the same, least | {least:.3f} ms | below 0.2 ms |",
        f"| from SIGINT to KeyboardInterrupt, median of {len(ends)} | {statistics.median(ends):.3f} s | |",
        f"| the same, longest | {ends[-1]:.3f} s | below 0.2 s |",
    ]
    text = "\n".join(lines) + "\n"
    if asked.quick:
        print(text)
    else:
        (ROOT / "reports" / "python.md").write_text(text)


if __name__ == "__main__":
    main()
