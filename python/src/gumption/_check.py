"""Checks functions against themselves: traced functions, and functions called with columns, are
evaluated again one draw at a time.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gumption import _gumption
from gumption._agreement import EPS, Column, apart, differ
from gumption._block import BlockFunction, NotTheSame, Way

if TYPE_CHECKING:
    from gumption._measurement import Measurement

#: How many draws are evaluated one at a time, beside the estimates.
DRAWS = 32

#: Every so many of them are evaluated twice.
TWICE = 4

#: Draws that the engine hands to a function at a time.
BLOCK = 1024


class Held:
    """A function with its results at the time when its model was made.

    Parameters
    ----------
    one : BlockFunction
        The function, one draw at a time.
    model : Model
        The model, with the variables of the function.
    variables, outputs : list of ndarray
        Sets of values, and the outputs at them.
    """

    def __init__(
        self, one: BlockFunction, model: _gumption.Model, variables: list[Column], outputs: list[Column]
    ) -> None:
        self._one, self._model, self._variables, self._outputs = one, model, variables, outputs

    def check_unchanged(self) -> None:
        """Raises an error if the function gives another result now."""
        found = self._one.of(self._model)(self._variables)
        known = (self._variables, self._outputs)
        _compare_twice(self._one.measurement, self._model, known, found)

    def of(self, model: _gumption.Model) -> Held:
        """The same for another model of its formulas.

        Raises
        ------
        ModelError
            If the formulas differ from the function there.
        """
        if self._model.variables != model.variables:
            # its inputs were put together with those of other models
            return self
        found = checked(self._one.measurement, model, self._one.aliases)
        if found.function is not None:
            raise _gumption.ModelError(f"`{self._one.measurement.title}`: {found.difference}")
        return found.held

    def __reduce__(self) -> Any:
        source = self._model.source
        return _held_from, (self._one, source, self._variables, self._outputs)


def _held_from(
    one: BlockFunction, source: tuple[Any, ...], variables: list[Column], outputs: list[Column]
) -> Held:
    return Held(one, _gumption.Model(*source), variables, outputs)


class Checked(NamedTuple):
    """How a function is evaluated.

    `function` is `None` if its formulas are used; `difference` says why its formulas, or columns,
    are not used.
    """

    function: BlockFunction | None
    difference: str | None
    held: Held


def checked(measurement: Measurement, model: _gumption.Model, aliases: Mapping[str, str]) -> Checked:
    """Finds a way to evaluate a function that agrees with its results for one draw at a time.

    Raises
    ------
    ModelError
        If the function does not give the same values for the same arguments.
    """
    # of columns a whole block, so that what hangs on any draw of it is noticed in the few that are looked at
    variables, formulas = model.draws(BLOCK if measurement.equations is None else DRAWS)
    rows = max(1, min(model.rows, DRAWS // 4, len(variables[0])))
    length = len(variables[0]) // rows
    # of each row the estimates and the first draws
    each = range(min(length, DRAWS // rows + 1))
    places = [row * length + place for row in range(rows) for place in each]
    draws = _Draws(measurement, model, aliases, variables, places)
    draws.check_that_it_repeats()
    # two sets are enough to notice that something else changed meanwhile
    held = Held(draws.one, model, [c[:2] for c in draws.variables], [c[:2] for c in draws.truth])
    if measurement.equations is not None:
        difference = draws.difference(formulas, "by the formulas that were traced")
        if difference is None:
            return Checked(None, None, held)
        draws.check_that_units_are_converted()
        return Checked(draws.one, difference, held)
    draws.check_that_units_are_converted()
    columns = BlockFunction(measurement, Way.COLUMNS, aliases, draws.one.way)
    try:
        found = columns.of(model)(variables)
    except NotTheSame as error:
        return Checked(draws.one, str(error), held)
    except Exception as error:  # noqa: BLE001 - whatever a function of somebody else's says
        return Checked(draws.one, f"with columns of draws: {type(error).__name__}: {error}", held)
    difference = draws.difference(found, "called with columns of draws")
    return Checked(columns if difference is None else draws.one, difference, held)


def check_rows(
    measurement: Measurement,
    model: _gumption.Model,
    estimates: Mapping[str, Column | float],
    outputs: Sequence[Column],
) -> None:
    """Raises an error if formulas differ from their function, in some rows of budgets."""
    count = len(outputs[0])
    if not count:
        return
    # each place once: of more rows the step is above 1
    rows = np.linspace(0, count - 1, DRAWS).astype(int) if count > DRAWS else np.arange(count)
    names = [*model.variables, *(name for name, _ in model.conditions)]
    variables = [np.broadcast_to(np.asarray(estimates[name]), count) for name in names]
    draws = _Draws(measurement, model, {}, variables, rows.tolist())
    draws.check_that_it_repeats()
    difference = draws.difference(outputs, "by the formulas that were traced")
    if difference is not None:
        raise _gumption.ModelError(f"`{measurement.title}`: {difference}; budgets in columns need formulas")


class _Draws:
    """A function at some draws, one at a time."""

    def __init__(
        self,
        measurement: Measurement,
        model: _gumption.Model,
        aliases: Mapping[str, str],
        variables: Sequence[Column],
        places: Sequence[int],
    ) -> None:
        self.measurement, self.model, self.places = measurement, model, list(places)
        self.variables = variables = [column[self.places] for column in variables]
        self.one = BlockFunction(measurement, Way.NUMBERS, aliases)
        self.evaluated = self.one.of(model)
        try:
            self.truth = self.evaluated(variables)
        except (TypeError, ValueError, AttributeError, IndexError) as error:
            # it may take arrays and nothing else
            self.one = BlockFunction(measurement, Way.ENTRIES, aliases)
            self.evaluated = self.one.of(model)
            try:
                self.truth = self.evaluated(variables)
            except Exception:  # noqa: BLE001 - the first one is about what everybody expects
                raise error from None

    def check_that_it_repeats(self) -> None:
        places = list(range(len(self.places) - 1, -1, -TWICE))
        at = ([column[places] for column in self.variables], [column[places] for column in self.truth])
        _compare_twice(self.measurement, self.model, at, self.evaluated(at[0]))

    def difference(self, found: Sequence[Column], how: str) -> str | None:
        """A description of where outputs differ from the function."""
        for number, (name, unit) in enumerate(self.model.outputs):
            values, truth = np.asarray(found[number]), self.truth[number]
            values, moved = values[self.places], functools.partial(self._moved, number)
            wrong = apart(values, truth, truth, moved)
            if not wrong.any():
                continue
            shifted = (apart(values - by, truth, truth, moved) for by in self._shifts(unit).values())
            if any(not differs.any() for differs in shifted):
                continue
            place = int(np.argmax(wrong))
            return (
                f"{how} `{name}` is {_with_unit(values[place], unit)}, and one draw at a time "
                f"{_with_unit(truth[place], unit)}, at {_at(self.model, self.variables, place)}"
            )
        return None

    def _shifts(self, output: str) -> dict[str, float]:
        """The shifts of levels between the zeros of their units and the zero of an output's unit."""
        found: dict[str, float] = {}
        for _, unit in self.model.inputs if _gumption.unit_within(output)[1] else []:
            if unit == output or not _gumption.unit_within(unit)[1]:
                continue
            x, y = {"unit": unit, "distribution": "constant", "value": 0}, {"unit": output}
            file = {"format": 1, "inputs": {"x": x}, "equations": {"y": "x"}, "outputs": {"y": y}}
            try:
                converted = _gumption.Model("shift", json.dumps(file)).draws(0)[1][0][0]
            except _gumption.ModelError:
                continue
            (_, own), (factor, offset) = _gumption.unit_scale(unit), _gumption.unit_scale(output)
            found[unit] = converted - (own - offset) / factor
        return {unit: shift for unit, shift in found.items() if abs(shift) > 1e-9}

    def check_that_units_are_converted(self) -> None:
        """Raises an error for levels with different references if no formula says which is converted."""
        for name, unit in self.model.outputs:
            for other in self._shifts(unit):
                raise _gumption.ModelError(
                    f"`{self.measurement.title}` is evaluated by Python, which does not convert between "
                    f"levels in {other} and `{name}` in {unit}; declare them in one unit"
                )

    def _moved(self, output: int, by: Callable[[int], float]) -> Column:
        """An output for arguments multiplied by a factor."""
        moved = [column * by(i) for i, column in enumerate(self.variables)]
        return self.evaluated(moved)[output]


def _with_unit(value: float, unit: str, digits: int = 10) -> str:
    return f"{value:.{digits}g} {unit}" if unit != "1" else f"{value:.{digits}g}"


def _at(model: _gumption.Model, variables: Sequence[Column], place: int) -> str:
    """A set of values in words."""
    names = [*model.variables, *(name for name, _ in model.conditions)]
    units = dict([*model.inputs, *model.conditions])
    shown = []
    for name, column in zip(names[:6], variables):
        shown.append(f"{name} = {_with_unit(column[place], units[name.partition('/')[0]])}")
    return ", ".join(shown) + (", ..." if len(names) > 6 else "")


def _compare_twice(
    measurement: Measurement,
    model: _gumption.Model,
    first: tuple[Sequence[Column], Sequence[Column]],
    again: Sequence[Column],
) -> None:
    """Raises an error for a function with two results for the same arguments."""
    variables, outputs = first
    for (name, unit), before, now in zip(model.outputs, outputs, again):
        # the same operations: as many roundings as a parallel sum may do in another order
        wrong = differ(before, now, 4 * EPS * np.maximum(abs(before), abs(now)))
        if wrong.any():
            place = int(np.argmax(wrong))
            raise _gumption.ModelError(
                f"`{measurement.title}` does not give the same value for the same arguments: `{name}` was "
                f"{_with_unit(before[place], unit, 17)} and then {_with_unit(now[place], unit, 17)}, at "
                f"{_at(model, variables, place)}. Random numbers, counters, the time, and global "
                "variables or arguments that are changed do this; what varies is to be an input"
            )
