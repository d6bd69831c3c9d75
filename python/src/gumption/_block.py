"""A Python function as the engine calls it: with columns of values, for which it returns columns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum
from typing import TYPE_CHECKING, Any

import numpy as np

from gumption import _gumption
from gumption._agreement import Column, apart

if TYPE_CHECKING:
    from gumption._measurement import Measurement


#: Units that were parsed before.
_SCALES: dict[str, tuple[float, float]] = {}


def scale_of(unit: str) -> tuple[float, float]:
    """`_gumption.unit_scale`, which parses the unit, kept."""
    if unit not in _SCALES:
        _SCALES[unit] = _gumption.unit_scale(unit)
    return _SCALES[unit]


class NotTheSame(_gumption.ModelError):
    """A draw gives another value in a column than alone."""


class Way(Enum):
    """The kind of arguments in a call of a function."""

    #: All values of an argument at once, in an array that cannot be changed.
    COLUMNS = "columns of draws"
    #: A number for each argument.
    NUMBERS = "one draw at a time"
    #: An array of one entry for each argument, for functions that take nothing else.
    ENTRIES = "arrays of one draw each"
    #: Columns, or numbers where it does not take them: what nobody checked.
    UNCHECKED = "columns or numbers"


class BlockFunction:
    """A measurement's function over columns in the declared units.

    Parameters
    ----------
    measurement : Measurement
        Whose function.
    way : Way
        What it is called with.
    aliases : mapping of str to str
        Inputs that are the same quantity as another one.
    alone : Way, optional
        With columns, how the first draw of each is evaluated again for comparison.
    """

    def __init__(
        self,
        measurement: Measurement,
        way: Way,
        aliases: Mapping[str, str],
        alone: Way | None = None,
    ) -> None:
        self.measurement = measurement
        self.way = way
        self.aliases = dict(aliases)
        self.alone = alone

    def __reduce__(self) -> Any:
        return BlockFunction, (self.measurement, self.way, self.aliases, self.alone)

    def of(self, model: _gumption.Model) -> Callable[[list[Column]], list[Column]]:
        """The function over the columns of the variables of a model."""
        variables, units = model.variables, dict([*model.inputs, *model.conditions])
        scales = {name: scale_of(unit) for name, unit in units.items()}
        # components of an input are summed
        owner = [name.partition("/")[0] for name in variables] + [n for n, _ in model.conditions]
        outputs = [(name, scale_of(unit)) for name, unit in model.outputs]
        check = self.measurement.check_units

        def called(columns: list[Column]) -> list[Column]:
            sums: dict[str, Column] = {}
            for name, column in zip(owner, columns):
                sums[name] = sums[name] + column if name in sums else column
            if check:
                for name, (factor, offset) in scales.items():
                    sums[name] = sums[name] * factor + offset
            for alias, name in self.aliases.items():
                sums[alias] = sums[name]
            found = self._evaluate({name: sums[name] for name in self.measurement.arguments})
            given = []
            for name, (factor, offset) in outputs:
                values = found[name]
                given.append(np.ascontiguousarray((values - offset) / factor if check else values))
            return given

        return called

    def _evaluate(self, columns: Mapping[str, Column]) -> Mapping[str, Column]:
        # what is undefined is counted, and need not be said each time
        with np.errstate(all="ignore"):
            if self.way is Way.UNCHECKED:
                try:
                    return self._of_columns(columns)
                except (TypeError, ValueError):
                    # it takes numbers and no arrays
                    self.way = Way.NUMBERS
            if self.way is not Way.COLUMNS:
                return self._of_draws(columns, self.way)
            found = self._of_columns(columns)
            if self.alone is not None:
                self._check_first(columns, found, self.alone)
            return found

    def _check_first(
        self, columns: Mapping[str, Column], found: Mapping[str, Column], alone: Way
    ) -> None:
        """Compares the first draw of columns with its value alone."""
        first = {name: column[:1] for name, column in columns.items()}
        truth = self._of_draws(first, alone)
        for name, values in found.items():

            def moved(by: Callable[[int], float], name: str = name) -> Column:
                changed = {own: c * by(i) for i, (own, c) in enumerate(first.items())}
                return self._of_draws(changed, alone)[name]

            if apart(values[:1], truth[name], values, moved).any():
                at = ", ".join(f"{own} = {column[0]:.10g}" for own, column in first.items())
                raise NotTheSame(
                    f"called with columns of draws `{self.measurement.title}` gives {values[0]:.10g} for "
                    f"`{name}`, and one draw at a time {truth[name][0]:.10g}, at {at} (within the "
                    "function); what it gives for a draw hangs on the others"
                )

    def _of_columns(self, columns: Mapping[str, Column]) -> Mapping[str, Column]:
        given = {name: np.array(column) for name, column in columns.items()}
        count = len(next(iter(given.values())))
        for column in given.values():
            # a change in place would be a change of the next call's values
            column.flags.writeable = False
        found = self.measurement.called(given)
        made = {}
        for name in self.measurement.outputs:
            values = _numbers(found[name], name)
            if values.shape not in ((), (count,)):
                raise ValueError(f"`{name}` has the shape {values.shape} where {count} draws are given")
            made[name] = np.broadcast_to(values, count)
        return made

    def _of_draws(self, columns: Mapping[str, Column], way: Way) -> Mapping[str, Column]:
        made: dict[str, list[float]] = {name: [] for name in self.measurement.outputs}
        for values in zip(*(column.tolist() for column in columns.values())):
            given: dict[str, Any] = dict(zip(columns, values))
            if way is Way.ENTRIES:
                given = {name: np.array([value]) for name, value in given.items()}
            try:
                found = self.measurement.called(given)
            except ArithmeticError:
                found = dict.fromkeys(made, np.nan)
            for name, column in made.items():
                value = found[name]
                if not isinstance(value, float):
                    values_found = _numbers(value, name)
                    if values_found.size != 1:
                        raise ValueError(
                            f"the function gave {values_found.size} values for `{name}`, not one"
                        )
                    value = values_found.item()
                column.append(value)
        return {name: np.array(column) for name, column in made.items()}


def _numbers(value: Any, name: str) -> Column:
    """The results of the function as real numbers."""
    if isinstance(value, np.ma.MaskedArray):
        # a masked value is undefined
        value = np.ma.filled(value.astype(np.float64), np.nan)
    found = np.asarray(value)
    if found.dtype.kind == "c":
        raise TypeError(
            f"the function gave a complex number for `{name}`; let it give the real number that is "
            "meant, such as `.real`, `.imag` or `abs()`"
        )
    if found.dtype.kind not in "biufO" or value is None:
        raise TypeError(f"the function gave a {type(value).__name__} for `{name}`, not a number")
    return np.asarray(found, dtype=np.float64)
