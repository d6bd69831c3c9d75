"""Runs of a simulator that is a Python function, here or with an executor."""

from __future__ import annotations

import functools
import os
import pickle
import traceback
from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import closing
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from gumption._executors import Work, Workers
from gumption._frames import columns, numbers

#: What a run gives: all outputs, output after output, or the reason why there are none.
Result: TypeAlias = npt.NDArray[np.float64] | str

#: A simulator and the conditions of all rows, with the names of its parameters and outputs.
Simulator: TypeAlias = tuple[
    Callable[..., Any], Mapping[str, npt.NDArray[np.float64]], list[str], list[str]
]


class Simulate:
    """A simulator with the names of what it takes and gives.

    Parameters
    ----------
    function : callable
        ``function(conditions, **parameters)`` gives a mapping of outputs.
    parameters, outputs : list of str
        Their names in the order of the case.
    resume : path-like, optional
        The folder in which runs are kept.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        parameters: list[str],
        outputs: list[str],
        resume: str | os.PathLike[str] | None,
    ) -> None:
        self.function, self.parameters, self.outputs = function, parameters, outputs
        self.folder = None if resume is None else os.fspath(resume)
        module = getattr(function, "__module__", None)
        named = getattr(function, "__qualname__", type(function).__qualname__)
        self.name = named if module is None else f"{module}.{named}"
        self._executor: Any = None

    def on(self, executor: Any) -> Simulate:
        """The same with the runs made by an executor; here, one after the other, if there is none."""
        found = Simulate(self.function, self.parameters, self.outputs, self.folder)
        found._executor = executor
        return found

    def at(
        self, conditions: Mapping[str, npt.NDArray[np.float64]]
    ) -> Callable[[npt.NDArray[np.float64]], Iterator[tuple[int, Result]]]:
        """The runs at some conditions: a generator function that takes a line of parameters for each run, and
        yields the place of each with its result as soon as it ends."""
        one = (self.function, dict(conditions), self.parameters, self.outputs)
        if self._executor is None:
            return functools.partial(_here, one)
        return functools.partial(_there, self._executor, one)


def _here(one: Simulator, lines: npt.NDArray[np.float64]) -> Iterator[tuple[int, Result]]:
    for place, values in enumerate(lines.tolist()):
        yield place, run(*one, values)


def _there(
    executor: Any, one: Simulator, lines: npt.NDArray[np.float64]
) -> Generator[tuple[int, Result], None, None]:
    with Workers.of(executor) as workers:
        simulator = workers.pickled(one)
        work: Iterator[Work] = (
            (_at_worker, (simulator, place, values)) for place, values in enumerate(lines.tolist())
        )
        with closing(workers.done(work)) as done:
            for (_, (_, place, _)), result in done:
                yield place, result


# the simulator that this process has read last
_OPENED: dict[bytes, Simulator] = {}


def _at_worker(simulator: bytes, place: int, values: list[float]) -> Result:
    """A run, as a worker makes it."""
    if simulator not in _OPENED:
        _OPENED.clear()
        _OPENED[simulator] = pickle.loads(simulator)
    return run(*_OPENED[simulator], values)


def run(
    function: Callable[..., Any],
    conditions: Mapping[str, npt.NDArray[np.float64]],
    parameters: list[str],
    outputs: list[str],
    values: list[float],
) -> Result:
    """A run: all outputs in their order, or the reason why there are none.

    The function gets copies of the conditions, which it may change.
    """
    rows = {name: column.copy() for name, column in conditions.items()}
    count = len(next(iter(rows.values()), []))
    try:
        given = columns(function(rows, **dict(zip(parameters, values))))
        for name in given:
            if name not in outputs:
                return f"the simulator gives `{name}`, but the outputs are {', '.join(outputs)}"
        found = []
        for name in outputs:
            if name not in given:
                return f"the simulator gives no `{name}`"
            column = numbers(given[name], name)
            if column.shape != (count,):
                return f"`{name}` has the shape {column.shape}, but the data have {count} rows"
            bad = np.flatnonzero(~np.isfinite(column))
            if len(bad):
                return f"value {bad[0] + 1} of `{name}` is {column[bad[0]]}, but must be a finite number"
            found.append(column)
        return np.concatenate(found)
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        at = f"{os.path.basename(frame.filename)}, line {frame.lineno}"
        return f"{type(error).__name__}: {error} ({at})"
