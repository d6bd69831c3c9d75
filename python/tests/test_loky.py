"""Runs that the workers of loky share, joblib's and its own, have the bytes of the command line."""

from __future__ import annotations

import os
import signal
from typing import Any

import pytest
from test_executors import PLANE, of_the_command_line

import gumption as gu

TRIALS = 300_000


@pytest.fixture(scope="module")
def answer(program: str) -> bytes:
    return of_the_command_line(program, PLANE, trials=TRIALS)


@pytest.fixture(params=["joblib.externals.loky", "loky"])
def loky(request: pytest.FixtureRequest) -> Any:
    return pytest.importorskip(request.param)


def test_the_reusable_executor(answer: bytes, loky: Any) -> None:
    executor = loky.get_reusable_executor(2)
    assert gu.load(PLANE).run(trials=TRIALS, executor=executor).to_json().encode() == answer
    # what is defined where the driver runs goes along
    factor = 2.0
    f = gu.model(inputs={"x": "1"}, outputs={"y": "1"}, trace=False)(lambda x: factor * x)
    with pytest.warns(gu.NotTracedWarning):
        model = f(x=(1.0, 0.1))
    there = model.run(trials=20_000, executor=executor).to_json()
    assert there == model.run(trials=20_000).to_json()
    # the executor outlives the runs
    assert executor.submit(max, 1, 2).result() == 2


def test_a_killed_worker(answer: bytes, loky: Any) -> None:
    """Loky breaks an executor whose worker has died; the run goes on with a new one, which has the
    settings of the broken one."""
    executor = loky.get_reusable_executor(1, env={"GUMPTION_OF_WORKERS": "1"})
    killed: list[int] = []

    def kill(_: int) -> None:
        if not killed:
            killed.append(executor.submit(os.getpid).result())
            os.kill(killed[0], signal.SIGKILL)

    result = gu.load(PLANE).run(trials=TRIALS, executor=executor, progress=kill)
    assert result.to_json().encode() == answer
    new = loky.get_reusable_executor(1, reuse=True)
    assert new is not executor
    assert new.submit(os.getpid).result() not in killed
    assert new.submit(os.getenv, "GUMPTION_OF_WORKERS").result() == "1"
