"""One run shared by worker processes: the same bytes as the command line's, and how long it takes.

    python python/benches/machines.py [--trials 1e9] [--output reports/machines.md]

The inclined plane with spurious motion (nine inputs, one output), with its intervals, by the command
line on one thread and on all, by a process pool and by Dask's `LocalCluster` of 1, 2 and 4 workers of
one thread each. Workers are started before the clock. Ends with 1 where a byte differs. Leave the
machine alone meanwhile.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import gumption as gu

ROOT = Path(__file__).resolve().parents[2]
W1 = ROOT / "benches" / "models" / "plane_typed.json"


def timed(run: Callable[[], bytes]) -> tuple[float, bytes]:
    start = time.perf_counter()
    answer = run()
    return time.perf_counter() - start, answer


def command_line(trials: int, threads: int) -> bytes:
    program = Path(sys.executable).with_name("gumption")
    command = [program, "run", W1, "--trials", str(trials), "--threads", str(threads)]
    return subprocess.run(
        [*command, "--format", "json", "--quiet"], check=True, stdout=subprocess.PIPE
    ).stdout


def processor() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--trials", type=lambda text: int(float(text)), default=10**9)
    asked.add_argument("--output", type=Path)
    given = asked.parse_args()
    import distributed

    model = gu.load(W1)
    load = os.getloadavg()[0]
    found: list[tuple[str, float, bytes]] = []

    def add(name: str, run: Callable[[], bytes]) -> None:
        found.append((name, *timed(run)))
        seconds, answer = found[-1][1:]
        print(f"{name}: {seconds:.1f} s, {hashlib.sha256(answer).hexdigest()[:16]}", flush=True)

    cores = os.cpu_count() or 1
    for threads in sorted({1, cores}):
        add(f"command line, threads: {threads}", lambda n=threads: command_line(given.trials, n))
    for workers in (1, 2):
        with ProcessPoolExecutor(workers) as pool:
            list(pool.map(abs, range(workers)))
            add(
                f"process pool, workers: {workers}",
                lambda pool=pool: model.run(trials=given.trials, executor=pool).to_json().encode(),
            )
    for workers in (1, 2, 4):
        with (
            distributed.LocalCluster(
                n_workers=workers, threads_per_worker=1, processes=True, host="127.0.0.1",
                dashboard_address=None,
            ) as cluster,
            distributed.Client(cluster) as client,
        ):  # fmt: skip
            client.wait_for_workers(workers)
            add(
                f"Dask LocalCluster, workers: {workers}",
                lambda client=client: (
                    model.run(trials=given.trials, executor=client).to_json().encode()
                ),
            )
    same = len({answer for _, _, answer in found}) == 1
    times = {name: seconds for name, seconds, _ in found}
    shares = [
        (name, times[f"{name}, workers: 1"] / times[f"{name}, workers: 2"])
        for name in ("process pool", "Dask LocalCluster")
    ]
    lines = [
        "# One run on several processes",
        "",
        f"Made by `python/benches/machines.py`: the inclined plane with spurious motion, "
        f"{given.trials:,} trials with both intervals. {processor()}, {cores} processors, "
        f"load of the machine before {load:.1f}; gumption {gu.__version__}, Python "
        f"{platform.python_version()}, distributed {distributed.__version__}.",
        "",
        "| | time, s | bytes of the answer |",
        "|---|---:|---|",
        *(
            f"| {name} | {seconds:.1f} | `{hashlib.sha256(answer).hexdigest()[:16]}` |"
            for name, seconds, answer in found
        ),
        "",
        "The answers are the same to the byte." if same else "**The answers differ.**",
        "",
        *(f"Two workers of a {name} are {ratio:.2f} times as fast as one." for name, ratio in shares),
        "",
    ]
    if given.output:
        given.output.write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
