#!/usr/bin/env python3
"""Measures and reports: called by compare.sh, from the root of the repository."""

import argparse
import json
import sys
from pathlib import Path

# what stands beside this folder
sys.path.append(str(Path(__file__).resolve().parent.parent))

import machine
import plot
import report
from agreement import disagreements
from plan import Plan


def measured(arguments, kept):
    """Measures; an interrupted run goes on where it stopped if it is told to."""
    paths = arguments.paths.split(",")
    binaries = arguments.workload_binary, arguments.command_binary
    plan = Plan(*binaries, paths, arguments)
    if arguments.resume:
        results = json.loads(kept.read_text())
    else:
        results = {"quick": arguments.quick, "most_rounds": arguments.rounds, "paths": paths}
        results["machine"], results["versions"] = machine.kind(paths), machine.versions()
    arguments.output.mkdir(parents=True, exist_ok=True)

    def keep(results):
        kept.write_text(json.dumps(results, indent=1) + "\n")

    plan.fill(results, keep)
    return results


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--workload-binary", required=True)
    parser.add_argument("--command-binary", required=True)
    parser.add_argument("--before", help="the program in an earlier version, for what users wait for")
    parser.add_argument("--python", help="the folder of the Python package, for what users wait for")
    parser.add_argument("--python-before", help="that of an earlier version")
    parser.add_argument("--paths", required=True, help="code paths, slowest first")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rounds", type=int, default=9, help="of a comparison, at most")
    parser.add_argument("--render", action="store_true", help="from the kept measurements")
    parser.add_argument("--resume", action="store_true", help="an interrupted run")
    parser.add_argument("--output", type=Path, default=Path("reports"))
    arguments = parser.parse_args()
    kept = arguments.output / "performance.json"
    if arguments.render:
        results = json.loads(kept.read_text())
    else:
        results = measured(arguments, kept)
    tested = Path("reports/generator.md")
    text = tested.read_text() if tested.exists() else ""
    (arguments.output / "performance.md").write_text(report.write(results, text))
    plot.draw(results, arguments.output / "performance.svg")
    if "growth" in results:
        plot.draw_growth(results, arguments.output / "growth.svg")
    if wrong := disagreements(results["workloads"]):
        sys.exit("the tools do not agree:\n" + "\n".join(wrong))


if __name__ == "__main__":
    main()
