"""Runs that Ray's workers share have the bytes of the command line."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from typing import Any

import pytest
from conftest import check_errors_of_workers
from test_executors import LONG, PLANE, of_the_command_line

import gumption as gu

ray: Any = pytest.importorskip("ray")
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module", autouse=True)
def cluster() -> Iterator[None]:
    """A cluster of this machine, with two workers."""
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


@pytest.fixture(scope="module")
def long_answer(program: str) -> bytes:
    return of_the_command_line(program, PLANE, trials=LONG["trials"], seed=3, memory="1M")


def test_a_local_cluster(long_answer: bytes) -> None:
    assert gu.load(PLANE).run(**LONG, executor=ray).to_json().encode() == long_answer
    # what is defined where the driver runs goes along
    factor = 2.0
    f = gu.model(inputs={"x": "1"}, outputs={"y": "1"}, trace=False)(lambda x: factor * x)
    with pytest.warns(gu.NotTracedWarning):
        model = f(x=(1.0, 0.1))
    assert model.run(trials=20_000, executor=ray).to_json() == model.run(trials=20_000).to_json()


def test_a_killed_worker(long_answer: bytes) -> None:
    killed: list[int] = []

    def kill(_: int) -> None:
        if not killed:
            killed.append(ray.get(ray.remote(lambda: os.getpid()).remote()))
            os.kill(killed[0], signal.SIGKILL)

    assert gu.load(PLANE).run(**LONG, executor=ray, progress=kill).to_json().encode() == long_answer
    assert killed


def test_work_that_ends_every_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    def dies(*_: object) -> bytes:
        os.kill(os.getpid(), signal.SIGKILL)
        return b""

    monkeypatch.setattr("gumption._executors._part", dies)
    with pytest.raises(RuntimeError, match="lost with its worker 6 times"):
        gu.load(PLANE).run(trials=20_000, executor=ray)


def test_errors_of_workers_are_those_of_the_model() -> None:
    check_errors_of_workers(ray)
