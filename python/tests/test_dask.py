"""Runs that Dask workers share have the bytes of the command line."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import pytest
from conftest import MODELS
from test_executors import LONG, PLANE, of_the_command_line

import gumption as gu

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def long_answer(program: str) -> bytes:
    return of_the_command_line(program, PLANE, trials=LONG["trials"], seed=3, memory="1M")


@contextmanager
def local(workers: int) -> Iterator[Any]:
    """A client of a cluster of worker processes on this machine."""
    with (
        distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=True, host="127.0.0.1",
            dashboard_address=None,
        ) as cluster,
        distributed.Client(cluster) as client,
    ):  # fmt: skip
        yield client


@pytest.mark.parametrize("workers", [1, 2])
def test_a_local_cluster(long_answer: bytes, workers: int) -> None:
    with local(workers) as client:
        assert gu.load(PLANE).run(**LONG, executor=client).to_json().encode() == long_answer
        # what is defined where the driver runs goes along
        factor = 2.0
        f = gu.model(inputs={"x": "1"}, outputs={"y": "1"}, trace=False)(lambda x: factor * x)
        with pytest.warns(gu.NotTracedWarning):
            model = f(x=(1.0, 0.1))
        there = model.run(trials=20_000, executor=client).to_json()
        assert there == model.run(trials=20_000).to_json()


def test_a_killed_worker(long_answer: bytes) -> None:
    killed: list[int] = []
    with local(2) as client:
        workers = list(client.run(os.getpid).values())

        def kill(_: int) -> None:
            if not killed:
                os.kill(workers[0], signal.SIGKILL)
                killed.append(workers[0])

        result = gu.load(PLANE).run(**LONG, executor=client, progress=kill)
        assert result.to_json().encode() == long_answer
    assert killed


@contextmanager
def process(*arguments: str) -> Iterator[subprocess.Popen[bytes]]:
    """A command of Dask in a process of its own."""
    with subprocess.Popen(
        [sys.executable, "-m", "dask", *arguments],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ) as started:  # fmt: skip
        try:
            yield started
        finally:
            started.kill()


def test_separate_workers_over_tcp(long_answer: bytes, tmp_path: Path) -> None:
    """A scheduler, two workers and a driver that know of each other by an address alone; one worker is
    killed, and nobody starts it again."""
    file = tmp_path / "scheduler.json"
    place = ["--scheduler-file", str(file)]
    with ExitStack() as stack:
        scheduler = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", *place]
        stack.enter_context(process(*scheduler))
        deadline = time.monotonic() + 60
        while not file.exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        worker = ["worker", *place, "--nthreads", "1", "--no-dashboard", "--no-nanny"]
        workers = [
            stack.enter_context(process(*worker, "--local-directory", str(tmp_path / name)))
            for name in ("one", "two")
        ]
        client = stack.enter_context(distributed.Client(scheduler_file=str(file), timeout=60))
        client.wait_for_workers(2, timeout=60)

        def kill(_: int) -> None:
            workers[0].kill()

        result = gu.load(PLANE).run(**LONG, executor=client, progress=kill)
        assert result.to_json().encode() == long_answer
        assert len(client.scheduler_info()["workers"]) == 1


def test_a_model_with_files(program: str) -> None:
    """What the model names is sent along."""
    path = MODELS / "three_axis_sensitivity.json"
    expected = of_the_command_line(program, path, trials=50_000)
    with local(1) as client:
        assert gu.load(path).run(trials=50_000, executor=client).to_json().encode() == expected
