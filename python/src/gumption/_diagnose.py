"""What a diagnosis of a simulator's gap is given: effects, and runs that were made before."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption._frames import columns, numbers
from gumption._quantities import as_input
from gumption._shapes import Input


class Effect:
    """What the sim leaves out: an ability of the simulator, or formulas that override outputs.

    Attributes
    ----------
    parameters : dict of str to Input
        The prior distributions of its parameters by their names.
    neutral : dict of str to float
        The values of parameters at which the effect is absent, each in the parameter's unit; empty for
        formulas.
    overrides : dict of str to str
        Formulas by the outputs that they override; empty for an ability of the simulator.
    about : str or None
        What it is, in words.
    """

    __slots__ = ("about", "neutral", "overrides", "parameters")

    def __init__(
        self,
        parameters: Mapping[str, Input],
        neutral: Mapping[str, float],
        overrides: Mapping[str, str],
        about: str | None = None,
    ) -> None:
        self.parameters = dict(parameters)
        self.neutral = dict(neutral)
        self.overrides = dict(overrides)
        self.about = about

    def to_dict(self) -> dict[str, Any]:
        """The effect as in a case file."""
        found: dict[str, Any] = {} if self.about is None else {"about": self.about}
        found["parameters"] = {name: known.to_dict() for name, known in self.parameters.items()}
        if self.overrides:
            found["overrides"] = dict(self.overrides)
        else:
            found["simulator"] = True
            # in the parameter's unit: a number alone
            found["neutral"] = dict(self.neutral)
        return found

    def __repr__(self) -> str:
        parts = [f"{self.parameters!r}"]
        if self.overrides:
            parts.append(f"overrides={self.overrides!r}")
        else:
            parts.append(f"neutral={self.neutral!r}")
        if self.about is not None:
            parts.append(f"about={self.about!r}")
        return f"gumption.effect({', '.join(parts)})"


def effect(
    parameters: Mapping[str, Any],
    *,
    neutral: Mapping[str, float] | None = None,
    overrides: Mapping[str, str] | None = None,
    about: str | None = None,
) -> Effect:
    """An effect that the sim leaves out.

    Parameters
    ----------
    parameters : mapping of str to object
        The prior distributions of its parameters, such as `rectangular` or `log_uniform`.
    neutral : mapping of str to float, optional
        The parameters that make the effect absent, with their values, each in the parameter's unit. By
        default 0 if there is one parameter. Parameters that are not named are at their medians where
        the effect is absent.
    overrides : mapping of str to str, optional
        Formulas by the outputs that they override, instead of an ability of the simulator.
    about : str, optional
        What it is, in words.

    Raises
    ------
    ValueError
        There is no parameter; several parameters and none that is neutral; a neutral value that is no
        finite number or belongs to no parameter; neutral values beside formulas.
    """
    known = {str(name): as_input(value, f"`{name}`") for name, value in parameters.items()}
    if overrides is not None:
        if neutral is not None:
            raise ValueError("an effect has `neutral` or `overrides`: formulas are absent without it")
        if not overrides:
            raise ValueError("`overrides` names no output")
        formulas = {str(name): str(formula) for name, formula in overrides.items()}
        return Effect(known, {}, formulas, about)
    if not known:
        raise ValueError("an effect of the simulator needs a parameter")
    if neutral is None:
        if len(known) > 1:
            first = next(iter(known))
            raise ValueError(
                f"the effect has the parameters {', '.join(known)}: say which of them make it absent, "
                f"and at which values, such as neutral={{{first!r}: 0}}"
            )
        neutral = dict.fromkeys(known, 0.0)
    if not neutral:
        raise ValueError("`neutral` names no parameter")
    absent = {}
    for name, value in neutral.items():
        if name not in known:
            raise ValueError(f"`neutral` names {name!r}, but the parameters are {', '.join(known)}")
        if isinstance(value, (bool, str)) or not math.isfinite(value):
            raise ValueError(f"the neutral value of {name!r} is {value!r}, but must be a finite number")
        absent[str(name)] = float(value)
    return Effect(known, absent, {}, about)


def as_effect(value: Any, name: str) -> Effect:
    """An effect as it is given to a diagnosis: an `Effect`, or a mapping of parameters of the simulator."""
    if isinstance(value, Effect):
        return value
    if not isinstance(value, Mapping):
        kind = type(value).__name__
        raise TypeError(
            f"the effect {name!r} is a {kind}, but must be a mapping of parameters or gumption.effect(...)"
        )
    try:
        return effect(value)
    except ValueError as error:
        raise ValueError(f"the effect {name!r}: {error}") from None


class Runs:
    """Runs of a simulator that were made before.

    Attributes
    ----------
    parameters : dict of str to array
        A value for each run, by parameter.
    outputs : dict of str to array
        The values of each output: a line for each run, a column for each row of the data.
    """

    __slots__ = ("outputs", "parameters")

    def __init__(
        self,
        parameters: Mapping[str, npt.NDArray[np.float64]],
        outputs: Mapping[str, npt.NDArray[np.float64]],
    ) -> None:
        self.parameters = dict(parameters)
        self.outputs = dict(outputs)

    def __len__(self) -> int:
        return len(next(iter(self.parameters.values())))

    @property
    def rows(self) -> int:
        """Number of rows of the data."""
        return next(iter(self.outputs.values())).shape[1]

    @property
    def failed(self) -> npt.NDArray[np.bool_]:
        """Which runs failed: an output is no finite number at some row."""
        finite = [np.isfinite(values).all(axis=1) for values in self.outputs.values()]
        failed: npt.NDArray[np.bool_] = ~np.logical_and.reduce(finite)
        return failed

    def __repr__(self) -> str:
        of = ", ".join(self.parameters)
        return f"<{len(self)} runs with {of}: {', '.join(self.outputs)} at {self.rows} rows>"


def runs(parameters: Any, outputs: Mapping[str, npt.ArrayLike]) -> Runs:
    """Runs of a simulator that were made before, in the place of a function.

    Parameters
    ----------
    parameters : DataFrame or mapping
        A column for each parameter, a row for each run.
    outputs : mapping of str to array_like
        A line for each run and a column for each row of the data. A run with a value that is no finite
        number has failed.

    Raises
    ------
    ValueError
        There is no run, parameter or output; a parameter that is no finite number; two runs with the
        same parameters; numbers of runs or rows that differ.
    """
    known = {name: numbers(column) for name, column in columns(parameters).items()}
    if not known or not len(next(iter(known.values()))):
        raise ValueError("the runs have no parameters")
    if not isinstance(outputs, Mapping) or not outputs:
        raise ValueError("the outputs are a mapping from names to arrays of runs by rows")
    found = {}
    count = len(next(iter(known.values())))
    for name, column in known.items():
        if column.shape != (count,):
            raise ValueError(f"the parameter {name!r} has the shape {column.shape}, not {(count,)}")
        bad = np.flatnonzero(~np.isfinite(column))
        if len(bad):
            raise ValueError(
                f"the parameter {name!r} of run {bad[0] + 1} is {column[bad[0]]}, but must be a finite number"
            )
    seen: dict[bytes, int] = {}
    for run, values in enumerate(np.column_stack(list(known.values()))):
        before = seen.setdefault(values.tobytes(), run)
        if before != run:
            raise ValueError(f"the runs {before + 1} and {run + 1} have the same parameters")
    rows = None
    for name, given in outputs.items():
        values = np.asarray(given, dtype=np.float64)
        if values.ndim != 2 or len(values) != count:
            raise ValueError(
                f"the output {name!r} has the shape {values.shape}, but must have {count} runs by rows"
            )
        if rows is not None and values.shape[1] != rows:
            raise ValueError(f"the output {name!r} has {values.shape[1]} rows, those before it {rows}")
        rows = values.shape[1]
        found[str(name)] = values
    if rows == 0:
        raise ValueError("the outputs have no rows")
    return Runs(known, found)
