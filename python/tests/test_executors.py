"""Runs that executors share have the bytes of the command line."""

from __future__ import annotations

import itertools
import multiprocessing
import os
import pickle
import random
import signal
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from conftest import MODELS, check_errors_of_workers, run

import gumption as gu
from gumption import _executors

PLANE = MODELS / "inclined_plane.json"

#: Kept values of so many trials do not fit into a megabyte: three passes and more.
LONG: dict[str, Any] = {"trials": 3_000_000, "seed": 3, "memory": 1 << 20}


def of_the_command_line(program: str, path: Path, **options: Any) -> bytes:
    """The answer of one process."""
    given = [part for name, value in options.items() for part in (f"--{name}", value)]
    said = run(program, "run", path, "--format", "json", "--quiet", *given)
    assert said.returncode == 0, said.stderr.decode()
    return said.stdout


@pytest.fixture(scope="module")
def long_answer(program: str) -> bytes:
    return of_the_command_line(program, PLANE, trials=LONG["trials"], seed=3, memory="1M")


@pytest.fixture(scope="module")
def pool() -> Iterator[ProcessPoolExecutor]:
    with ProcessPoolExecutor(2) as executor:
        yield executor


@pytest.mark.slow
def test_the_process_pool(long_answer: bytes, pool: ProcessPoolExecutor) -> None:
    told: list[int] = []
    result = gu.load(PLANE).run(**LONG, executor=pool, progress=told.append)
    assert result.to_json().encode() == long_answer
    # over every pass
    assert told == sorted(told) and told[-1] > 2.9 * LONG["trials"]


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2, 3])
def test_threads(long_answer: bytes, workers: int) -> None:
    with ThreadPoolExecutor(workers) as executor:
        result = gu.load(PLANE).run(**LONG, executor=executor, parts=7)
    assert result.to_json().encode() == long_answer


def test_one_pass(program: str, pool: ProcessPoolExecutor) -> None:
    expected = of_the_command_line(program, PLANE, trials=200_000)
    assert gu.load(PLANE).run(trials=200_000, executor=pool).to_json().encode() == expected


@pytest.mark.slow
def test_other_formats_and_what_is_saved(pool: ProcessPoolExecutor, tmp_path: Path) -> None:
    model = gu.load(PLANE)
    here, there = model.run(**LONG), model.run(**LONG, executor=pool, to_save=True)
    assert there.to("csv") == here.to("csv")
    assert there.saved() == here.saved()
    assert there["a_x"].monte_carlo.median == here["a_x"].monte_carlo.median


@pytest.mark.parametrize("rows", [3, 40])
def test_rows_of_conditions(program: str, pool: ProcessPoolExecutor, tmp_path: Path, rows: int) -> None:
    """Few rows are cut, each of many is made whole by one part."""
    path = tmp_path / "m.json"
    path.write_text(
        '{"format": 1, "inputs": {"a": {"unit": "m", "distribution": "rectangular", "mean": 1,'
        f'"half_width": 0.1}}}}, "conditions": {{"f": {{"unit": "Hz", "values": {list(range(1, rows + 1))}}}}},'
        '"equations": {"y": "a*f"}, "outputs": {"y": {"unit": "m/s"}}}'
    )
    expected = of_the_command_line(program, path, trials=50_000)
    assert gu.load(path).run(trials=50_000, executor=pool).to_json().encode() == expected
    adaptive = of_the_command_line(program, path, trials="adaptive")
    assert gu.load(path).run(trials="adaptive", executor=pool).to_json().encode() == adaptive


def cube(x: float) -> float:
    return x**3 if np_all_finite(x) else 0.0


def np_all_finite(x: Any) -> bool:
    import numpy as np

    return bool(np.all(np.isfinite(np.asarray(x, dtype=float))))


untraced = gu.model(inputs={"x": "1"}, outputs={"y": "1"}, trace=False)(cube)


@pytest.mark.filterwarnings("ignore::gumption.NotTracedWarning")
def test_a_function_that_is_not_traced(pool: ProcessPoolExecutor) -> None:
    model = untraced(x=(1.0, 0.1))
    assert model.run(trials=50_000, executor=pool).to_json() == model.run(trials=50_000).to_json()
    with pytest.raises(gu.ModelError, match="resume"):
        model.run(trials=50_000, executor=pool, resume="nowhere")


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_pools_of_every_kind(method: str) -> None:
    """Also of children that were forked after this process had threads of its own, with formulas and
    with a function."""
    context = multiprocessing.get_context(method)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gu.NotTracedWarning)
        function = untraced(x=(1.0, 0.1))
    for model in (gu.load(PLANE), function):
        # both of the engine's pools have threads here: those of a number, and those of the machine
        here = model.run(trials=100_000, threads=1)
        assert model.run(trials=100_000).to_json() == here.to_json()
        with ProcessPoolExecutor(2, mp_context=context) as executor:
            assert model.run(trials=100_000, executor=executor).to_json() == here.to_json()


class Shuffled(Executor):
    """Makes everything at once, and hands it over in an order of chance."""

    def __init__(self) -> None:
        self._max_workers = 20
        self._random = random.Random(5)
        self._given: list[tuple[Future[Any], Any]] = []
        self._lock = threading.Lock()

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        with self._lock:
            self._given.append((future, fn(*args, **kwargs)))
        threading.Timer(0.001, self._give).start()
        return future

    def _give(self) -> None:
        with self._lock:
            future, found = self._given.pop(self._random.randrange(len(self._given)))
        if future.set_running_or_notify_cancel():
            future.set_result(found)


@pytest.mark.slow
def test_any_order(long_answer: bytes) -> None:
    assert gu.load(PLANE).run(**LONG, executor=Shuffled()).to_json().encode() == long_answer


def kill_some_worker(executor: ProcessPoolExecutor, killed: list[int]) -> None:
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not killed:
        for pid in list(executor._processes):
            os.kill(pid, signal.SIGKILL)
            killed.append(pid)
            break
        time.sleep(0.001)


@pytest.mark.slow
def test_a_killed_worker_of_the_pool(long_answer: bytes) -> None:
    killed: list[int] = []
    executor = ProcessPoolExecutor(2)
    model, parts = gu.load(PLANE), itertools.count()

    def kill(_: int) -> None:
        if next(parts) == 5:
            kill_some_worker(executor, killed)

    assert model.run(**LONG, executor=executor, progress=kill).to_json().encode() == long_answer
    assert killed


def dies(run_: bytes, pass_: bytes, start: int, end: int) -> bytes:
    os.kill(os.getpid(), signal.SIGKILL)
    return b""


def test_work_that_ends_every_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_executors, "_part", dies)
    with pytest.raises(RuntimeError, match="lost with its worker 6 times"):
        gu.load(PLANE).run(trials=100_000, executor=ProcessPoolExecutor(1))


class Interrupting(ThreadPoolExecutor):
    """Takes no more after so many parts."""

    def __init__(self, most: int) -> None:
        super().__init__(1)
        self._left = most

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self._left -= 1
        if self._left < 0:
            raise KeyboardInterrupt
        return super().submit(fn, *args, **kwargs)


@pytest.mark.slow
@pytest.mark.parametrize("most", [5, 40])
def test_resume(program: str, long_answer: bytes, tmp_path: Path, most: int) -> None:
    model, folder = gu.load(PLANE), tmp_path / "parts"
    stopped = Interrupting(most)
    with pytest.raises(KeyboardInterrupt):
        model.run(**LONG, executor=stopped, resume=folder, parts=16)
    assert list(folder.iterdir())
    counting = Interrupting(10**9)
    again = model.run(**LONG, executor=counting, resume=folder, parts=16)
    assert again.to_json().encode() == long_answer
    # what was there is not made again: three passes or more of sixteen parts, less those
    whole = Interrupting(10**9)
    model.run(**LONG, executor=whole, parts=16)
    assert 10**9 - counting._left <= 10**9 - whole._left - most + 4
    # the folder is one of the command line
    merged = run(program, "merge", folder, "--format", "json", "--quiet")
    assert merged.stdout == long_answer, merged.stderr.decode()


def test_a_folder_of_another_run_is_refused(tmp_path: Path) -> None:
    with ThreadPoolExecutor(1) as executor:
        model = gu.load(PLANE)
        model.run(trials=20_000, executor=executor, resume=tmp_path)
        with pytest.raises(gu.ModelError, match="has the seed 1, not 2"):
            model.run(trials=20_000, seed=2, executor=executor, resume=tmp_path)


def test_parts_of_other_runs_are_refused() -> None:
    model = gu.load(PLANE)
    ours, other = model._parts({"trials": 20_000}), model._parts({"trials": 20_000, "seed": 2})
    first, part = ours.first(), other.part(other.first(), 0, 5)
    with pytest.raises(gu.ModelError, match="has the seed 2, not 1"):
        ours.merge(first, iter([part]), False)
    damaged = bytearray(ours.part(first, 0, 5))
    damaged[-80] ^= 1
    with pytest.raises(gu.ModelError, match="damaged"):
        ours.merge(first, iter([bytes(damaged)]), False)
    right = ours.part(first, 0, 5)
    with pytest.raises(gu.ModelError, match="there twice"):
        ours.merge(first, iter([right, right]), False)
    with pytest.raises(gu.ModelError, match="0..20"):
        ours.merge(first, iter([]), False)
    with pytest.raises(gu.ModelError):
        ours.part(first, 5, 5)
    with pytest.raises(gu.ModelError):
        ours.part(first, 0, 21)


def test_how_long_parts_are() -> None:
    length = _executors._length
    # of 1e6, 1e9 and 1e12 trials
    assert length(977, None, 2) == 64
    assert length(976_563, None, 2) == 15_259
    assert length(976_562_500, None, 2) == 1 << 17
    assert length(977, 3, 2) == 326 and length(2, 5, 2) == 1


def test_what_cannot_be_shared(pool: ProcessPoolExecutor) -> None:
    model = gu.load(PLANE)
    with pytest.raises(gu.ModelError, match="no blocks to share"):
        model.run(trials=0, executor=pool)
    with pytest.raises(gu.ModelError, match="adaptive"):
        model.run(trials="adaptive", executor=pool)
    with pytest.raises(gu.ModelError, match="give `executor`"):
        model.run(trials=1000, resume="parts")
    with pytest.raises(gu.ModelError, match="`parts"):
        model.run(trials=1000, executor=pool, parts=0)
    with pytest.raises(TypeError, match="Dask client"):
        model.run(trials=1000, executor=3)


def test_errors_of_workers_are_those_of_the_model(pool: ProcessPoolExecutor) -> None:
    check_errors_of_workers(pool)


CASE = MODELS / "gap" / "sampling_rate" / "case.json"


@pytest.mark.slow
def test_draws_of_a_blind_check(program: str, pool: ProcessPoolExecutor) -> None:
    said = run(program, "gap-check", CASE, "--draws", 6, "--format", "json", "--quiet")
    assert said.returncode == 0, said.stderr.decode()
    answer = gu.gap_check(CASE, 6, executor=pool)
    assert answer.to("json") == said.stdout
    assert dict(answer) == gu.gap_check(CASE, 6)
    # other formats take the draws that are there, also elsewhere
    page = run(program, "gap-check", CASE, "--draws", 6, "--quiet").stdout
    assert pickle.loads(pickle.dumps(answer)).to("table") == page
    with pytest.raises(gu.ModelError, match="exclude"):
        gu.gap_check(CASE, 6, executor=pool, keep="x")


@pytest.mark.slow
def test_draws_in_files(program: str, tmp_path: Path) -> None:
    def check(*arguments: object) -> subprocess.CompletedProcess[bytes]:
        return run(program, "gap-check", CASE, "--draws", 4, "--quiet", *arguments)

    folder = tmp_path / "parts"
    folder.mkdir()
    (folder / "note.txt").write_text("mine")
    assert check("--share", "2/2", "--partial", folder / "b").returncode == 0
    lacking = check("--parts", folder)
    assert lacking.returncode == 2 and b"lacks draws of the check's 4: 0..2" in lacking.stderr
    assert check("--share", "0..2", "--partial", folder / "a").returncode == 0
    assert check("--parts", folder, "--format", "json").stdout == check("--format", "json").stdout
    other = check("--parts", folder, "--seed", 9)
    assert other.returncode == 2 and b"have the seed 1, not 9" in other.stderr
    text = (folder / "a").read_bytes()
    (folder / "a").write_bytes(text.replace(b"0.", b"1.", 1))
    damaged = check("--parts", folder)
    assert damaged.returncode == 2 and b"SHA-256" in damaged.stderr
    (folder / "a").write_bytes(text)
    (folder / "c").write_bytes(text)
    twice = check("--parts", folder)
    assert twice.returncode == 2 and b"the draws 0..2 are also in" in twice.stderr
    assert b"none from 4 on" in check("--share", "4..5", "--partial", folder / "d").stderr
