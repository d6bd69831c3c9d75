#!/usr/bin/env python3
"""How long a newcomer waits: fresh clones of two revisions, built and tested one after the other.

    benches/build.py --before REV            writes reports/build.md
    benches/build.py --before REV --tests    also `cargo test` of both, from nothing (long)
    benches/build.py --before REV --dist     also the published profile (long)
    benches/build.py --render                the page again from reports/build.json

Registry downloads are made before the clock starts. Times are of the whole process tree: wall
time, and CPU time as user and system together. Leave the machine alone meanwhile. Needs Python
3.10 or later and nothing else.
"""

import argparse
import json
import os
import platform
import re
import resource
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FIRST = ["run", "models/inclined_plane.json"]
# workload, trials, repeats in turn
WORKLOADS = [("W1", "1e6"), ("W1", "1e7"), ("W2", "1e7"), ("W3", "1e4"), ("W4", "1e6")]
ROUNDS = 7


def run(command, folder):
    """Runs a command and returns wall and CPU seconds and what it printed; stops where it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    env = {**os.environ, "CARGO_TERM_COLOR": "never"}
    env.pop("CARGO_TARGET_DIR", None)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=env)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr[-2000:]}")
    return {"wall": wall, "cpu": cpu}, done.stdout + done.stderr


def lines_of_code(folder):
    """Lines of Rust that are neither blank nor comments, without tests, benches and examples."""
    count = 0
    for path in sorted(folder.rglob("*.rs")):
        parts = path.relative_to(folder).parts
        inner = parts[parts.index("src") :] if "src" in parts else ()
        if not inner or "target" in parts or "tests" in inner or parts[-1] == "tests.rs":
            continue
        text = path.read_text(encoding="utf-8")
        # what follows the test module of a file is tests
        text = re.split(r"^#\[cfg\(test\)\]\nmod \w+ \{", text, maxsplit=1, flags=re.M)[0]
        for line in text.splitlines():
            stripped = line.strip()
            if stripped and not stripped.startswith("//"):
                count += 1
    return count


def measured(revision, scratch, with_tests, with_edit, with_dist):
    folder = scratch / revision
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(folder)], check=True)
    subprocess.run(["git", "checkout", "--quiet", revision], cwd=folder, check=True)
    subprocess.run(["cargo", "fetch", "--quiet"], cwd=folder, check=True)
    result = {"revision": revision, "lines": lines_of_code(folder)}
    first, text = run(["cargo", "run", "--release", "--", *FIRST], folder)
    result["first"] = first
    result["packages"] = len(re.findall(r"^\s*Compiling ", text, flags=re.M))
    binary = folder / "target/release/gumption"
    result["binary"] = binary.stat().st_size
    result["second"], _ = run([str(binary), *FIRST, "--quiet"], folder)
    if with_edit:
        page = next(p for p in [folder / "crates/report/src/lib.rs", folder / "src/report/mod.rs"] if p.exists())
        page.write_text(page.read_text(encoding="utf-8") + "\n// changed\n", encoding="utf-8")
        result["edit"], _ = run(["cargo", "build", "--release"], folder)
    if with_dist:
        result["dist"], _ = run(["cargo", "build", "--profile", "dist"], folder)
        result["dist_binary"] = (folder / "target/dist/gumption").stat().st_size
        result["speed"] = speed(folder)
    if with_tests:
        shutil.rmtree(folder / "target")
        result["tests"], text = run(["cargo", "test"], folder)
        result["passed"] = sum(int(n) for n in re.findall(r"(\d+) passed", text))
    shutil.rmtree(folder)
    return result


def executable(folder, profile):
    command = ["cargo", "bench", "--bench", "workload", "--no-run", "--profile", profile]
    _, text = run([*command, "--message-format", "json"], folder)
    for line in text.splitlines():
        if line.startswith("{"):
            message = json.loads(line)
            if message.get("executable") and message["target"]["name"] == "workload":
                return message["executable"]
    raise SystemExit(f"no workload of profile {profile}")


def speed(folder):
    """CPU time of `release` over that of `dist`, workload by workload, measured in turn."""
    programs = {profile: executable(folder, profile) for profile in ["release", "dist"]}
    ratios = {}
    for workload, trials in WORKLOADS:
        found = []
        for turn in range(ROUNDS + 1):
            cpu = {}
            for profile, program in programs.items():
                command = [program, "--workload", workload, "--trials", trials, "--threads", "1"]
                _, text = run(command, folder)
                cpu[profile] = min(json.loads(text.splitlines()[0])["cpu_s"])
            if turn > 0:
                found.append(cpu["release"] / cpu["dist"])
        ratios[f"{workload} {trials}"] = statistics.median(found)
    return ratios


def processor():
    if Path("/proc/cpuinfo").exists():
        names = re.findall(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), flags=re.M)
        if names:
            return names[0]
    return platform.processor() or platform.machine()


def page(result):
    before, after = result["before"], result["after"]

    def seconds(value):
        return f"{value:.0f} s" if value >= 10 else f"{value:.2g} s"

    def mega(value):
        return f"{value / 1e6:.1f} MB"

    rows = [
        ("first command, wall", seconds(before["first"]["wall"]), seconds(after["first"]["wall"])),
        ("first command, CPU", seconds(before["first"]["cpu"]), seconds(after["first"]["cpu"])),
        ("packages built for it", str(before["packages"]), str(after["packages"])),
        ("binary of it", mega(before["binary"]), mega(after["binary"])),
        ("the command again", seconds(before["second"]["wall"]), seconds(after["second"]["wall"])),
    ]
    if "edit" in after:
        rows.append(("build after an edit of a page, wall", seconds(before["edit"]["wall"]), seconds(after["edit"]["wall"])))
    if "tests" in before or "tests" in after:
        for what in ["wall", "cpu"]:
            name = "`cargo test` from nothing, " + ("wall" if what == "wall" else "CPU")
            rows.append((name, *(seconds(r["tests"][what]) if "tests" in r else "not measured" for r in [before, after])))
        rows.append(("tests that passed", *(str(r.get("passed", "not measured")) for r in [before, after])))
    if "dist" in after:
        rows.append(("`dist` build, wall", "", seconds(after["dist"]["wall"])))
        rows.append(("`dist` binary, stripped", "", mega(after["dist_binary"])))
    rows.append(("lines of code without tests", f"{before['lines']:,}", f"{after['lines']:,}"))
    table = "\n".join(f"| {name} | {a} | {b} |" for name, a, b in rows)
    speeds = ""
    if "speed" in after:
        lines = "\n".join(f"| {name} | {ratio:.3f} |" for name, ratio in after["speed"].items())
        speeds = f"""
CPU time of the `release` profile over that of the `dist` profile (link-time optimization, one unit), one thread, median of {ROUNDS} ratios measured in turn:

| workload | release / dist |
|---|---:|
{lines}
"""
    return f"""# What a newcomer waits for

Written by `benches/build.py` on {result["processor"]}, {result["cores"]} cores, {result["rustc"]}. Both columns were measured on one machine, each in a fresh clone, registry downloads aside; CPU time is user and system of the whole process tree. The first command is `cargo run --release -- {" ".join(FIRST)}`.{result.get("how", "")}

| | before ({before["revision"][:10]}) | after |
|---|---:|---:|
{table}
{speeds}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", help="the revision to compare with")
    parser.add_argument("--tests", action="store_true", help="also the tests of both revisions")
    parser.add_argument("--tests-after", action="store_true", help="also the tests of this revision only")
    parser.add_argument("--dist", action="store_true", help="also the `dist` profile: size, and speed beside `release`")
    parser.add_argument("--edit", action="store_true", help="also the build after an edit of a page")
    parser.add_argument("--render", action="store_true", help="the page again from reports/build.json")
    arguments = parser.parse_args()
    kept = ROOT / "reports/build.json"
    if arguments.render:
        result = json.loads(kept.read_text(encoding="utf-8"))
    else:
        if not arguments.before:
            parser.error("--before REV is needed")
        full = lambda rev: subprocess.run(["git", "rev-parse", rev], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()
        revisions = [full(arguments.before), full("HEAD")]
        rustc = subprocess.run(["rustc", "--version"], check=True, capture_output=True, text=True).stdout.strip()
        result = {"processor": processor(), "cores": os.cpu_count(), "rustc": rustc}
        with tempfile.TemporaryDirectory() as scratch:
            scratch = Path(scratch)
            result["before"] = measured(revisions[0], scratch, arguments.tests, arguments.edit, False)
            result["after"] = measured(revisions[1], scratch, arguments.tests or arguments.tests_after, arguments.edit, arguments.dist)
        kept.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    (ROOT / "reports/build.md").write_text(page(result), encoding="utf-8")


if __name__ == "__main__":
    main()
