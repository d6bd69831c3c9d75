"""Results of models that depend on the same quantities, evaluated together with them.

A result that is an input of another model is drawn from its own distribution. If two such results,
or a result and another input, depend on the same `Input`, this would lose their correlation. The
formulas of their models are then inserted into the new model, so that the quantity is drawn once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from gumption import _gumption
from gumption._quantities import as_input, is_linked, shared
from gumption._shapes import Input

if TYPE_CHECKING:
    from gumption._model import Model
    from gumption._result import Output, Result

#: Keys of a model file that its formulas and inputs do not depend on, or that are carried over.
_PLAIN = {
    "format", "title", "check_units", "inputs", "equations", "outputs", "conditions", "correlations",
    "monte_carlo", "coverage_probability", "coverage_factor",
}  # fmt: skip

#: Units and texts, which hold no names of quantities, and names.
_NAME = re.compile(r"\[[^\]]*\]|\"[^\"]*\"|(?<![\w.])[^\W\d]\w*")


def is_output(value: object) -> bool:
    """Whether it is an output of a result."""
    return not isinstance(value, Input) and hasattr(value, "_as_input")


def identity_of(value: Any) -> object:
    """The identity of a quantity, which is equal for two values of one quantity."""
    if isinstance(value, Input):
        return value.identity
    if is_output(value):
        return value._result.identity, value.name
    return id(value)


def _origins(value: Any) -> Iterator[tuple[object, Any]]:
    """The identities of all quantities on which a value depends, with the quantities."""
    if isinstance(value, Input):
        if value.spec.get("distribution") != "constant":
            yield value.identity, value
            yield from ((part, value) for part in value.parts)
    elif is_output(value):
        result = value._result
        yield result.identity, value
        for own in (result.model._known or {}).values():
            yield from _origins(own)
    else:
        yield id(value), value


class Joint:
    """Quantities of several models combined in one file.

    Attributes
    ----------
    expanded : list of str
        The results that became formulas.
    inputs, equations : dict
        The additions to the file.
    known : dict of str to object
        The added inputs.
    held : dict of str to bytes
        Files that they name.
    links : list of (str, str, float)
        Correlation coefficients of their models.
    """

    def __init__(self, taken: Iterable[str], check_units: bool) -> None:
        self.expanded: list[str] = []
        self.inputs: dict[str, dict[str, Any]] = {}
        self.equations: dict[str, str] = {}
        self.known: dict[str, Any] = {}
        self.held: dict[str, bytes] = {}
        self.links: list[tuple[str, str, float]] = []
        self._taken = set(taken)
        self._check_units = check_units
        self._names: dict[object, str] = {}
        self._entries: dict[str, dict[str, Any]] = {}
        self._models: dict[int, dict[str, str]] = {}
        self._reasons: dict[int, str | None] = {}

    @classmethod
    def of(
        cls,
        known: Mapping[str, Any],
        units: Mapping[str, str],
        taken: Iterable[str],
        check_units: bool,
        terms: Iterable[str] = (),
    ) -> Joint | None:
        """The combined models of values that share quantities with other values.

        `terms` are names of those that stand in expressions, whose models are combined where that can be.
        So are results of runs without trials, which have no distribution to draw from. ``equations`` then
        contains those values under their own names. `None` if there are none.

        Raises
        ------
        ModelError
            If quantities are shared but the models cannot be evaluated together.
        """
        sharing = _sharing(known)
        untried = [name for name, value in known.items() if is_output(value) and not value._result.has_trials]
        joint = cls([*known, *taken], check_units)
        of_results = [name for name in terms if is_output(known[name])]
        possible = [name for name in of_results if joint._why_not(known[name]._result) is None]
        together = list(dict.fromkeys([*sharing, *untried, *possible]))
        if not together:
            return None
        for name, value in known.items():
            if not is_output(value):
                own = as_input(value, name)
                joint._names[identity_of(value)] = name
                joint._entries[name] = own.to_dict(units[name])
        try:
            for name in together:
                value = known[name]
                if is_output(value):
                    if not check_units and value.unit != units[name]:
                        raise _NotTogether(f"`{name}` is in {value.unit}, not in {units[name]}")
                    joint.equations[name] = joint._output(value)
                    joint.expanded.append(name)
        except _NotTogether as reason:
            if untried and not sharing:
                raise _gumption.ModelError(
                    f"{listed(untried)}: a run without trials has no distribution, so its model has to be "
                    f"evaluated again, but {reason}; make the run with trials"
                ) from None
            raise _gumption.ModelError(
                f"{listed(sharing)} go back to the same quantity, so they have to be evaluated together, but "
                f"{reason}; write one function of what they go back to"
            ) from None
        return joint

    def _name(self, wanted: str) -> str:
        name, number = wanted, 1
        while name in self._taken:
            number += 1
            name = f"{wanted}_{number}"
        self._taken.add(name)
        return name

    def _output(self, output: Output) -> str:
        """The name of an output of a result; the quantities on which it depends are added."""
        result = output._result
        if result.model._known is None:
            return self._input(output, output.name, output.unit)
        return self._model(result)[output.name]

    def _input(self, value: Any, wanted: str, unit: str) -> str:
        found = as_input(value, wanted)
        entry = found.to_dict(unit)
        name = self._names.get(identity_of(value))
        if name is None:
            name = self._names[identity_of(value)] = self._name(wanted)
            self.inputs[name] = self._entries[name] = entry
            self.known[name] = value
            self.held.update(found.held)
        elif self._entries[name] != entry:
            raise _NotTogether(
                f"`{wanted}` is in {entry['unit']} in one of them and in {self._entries[name]['unit']} in "
                "another one and has no unit of its own"
                if entry["unit"] != self._entries[name]["unit"]
                else f"what is known about `{wanted}` was changed in between"
            )
        return name

    def _model(self, result: Result) -> dict[str, str]:
        """The names of the quantities of a result's model."""
        model = result.model
        if id(model) not in self._models:
            self._models[id(model)] = self._added(model, result)
        return self._models[id(model)]

    def _why_not(self, result: Result) -> str | None:
        """Why the formulas of a result's model cannot be inserted into another one; `None` if they can."""
        if id(result) not in self._reasons:
            self._reasons[id(result)] = self._reason(result)
        return self._reasons[id(result)]

    def _reason(self, result: Result) -> str | None:
        model = result.model
        file = model.to_dict()
        title = f"the model {model.title!r}"
        if model._function is not None:
            return f"{title} is a function that could not be traced"
        if model._rust.source[5]:
            return f"estimates of {title} were replaced by `set`"
        if model._rust.source[7] is not None:
            return f"readings of {title} were replaced"
        if others := sorted(set(file) - _PLAIN):
            return f"{title} has `{others[0]}`"
        if result.rows > 1:
            return f"{title} has {result.rows} rows of conditions"
        if file.get("check_units", True) != self._check_units:
            return "units are checked in one of their models and not in another one"
        for name in file["inputs"]:
            value = (model._known or {}).get(name)
            if value is None:
                return f"what `{name}` of {title} is stands in its file alone"
            if is_output(value) and (reason := self._why_not(value._result)):
                return reason
        return None

    def _added(self, model: Model, result: Result) -> dict[str, str]:
        if reason := self._why_not(result):
            raise _NotTogether(reason)
        file = model.to_dict()
        title = f"the model {model.title!r}"
        for name, content in model._rust.source[3]:
            if name not in file.get("conditions", {}).values() and self.held.setdefault(name, content) != content:
                raise _NotTogether(f"{title} names another file `{name}`")
        known, units = model._known or {}, model.inputs
        names: dict[str, str] = {}
        for name in file["inputs"]:
            value = known[name]
            of_output = is_output(value)
            names[name] = self._output(value) if of_output else self._input(value, name, units[name])
        row = result.conditions
        for name, unit in model.conditions.items():
            condition = Input({"distribution": "constant", "value": float(row[name][0])}, unit)
            names[name] = self._input(condition, name, unit)
        for name in file["equations"]:
            names.setdefault(name, self._name(name))
        for name, formula in file["equations"].items():
            self.equations[names[name]] = _NAME.sub(lambda of: names.get(of[0], of[0]), formula)
        for first, second, coefficient in file.get("correlations", []):
            self.links.append((names[first], names[second], coefficient))
        return names


def listed(names: Iterable[str]) -> str:
    """Names for a message."""
    return ", ".join(f"`{name}`" for name in names)


class _NotTogether(Exception):
    """Why models cannot be evaluated together."""


def _sharing(known: Mapping[str, Any]) -> list[str]:
    """The values that share a quantity with a value of another run."""
    owners: dict[object, dict[object, list[str]]] = {}
    numbers: dict[str, Any] = {}
    groups: dict[str, object] = {}
    for name, value in known.items():
        # outputs of one run have what they share in its result file
        groups[name] = group = value._result.identity if is_output(value) else name
        for identity, of in _origins(value):
            owners.setdefault(identity, {}).setdefault(group, []).append(name)
            if is_linked(of):
                numbers[f"{name}/{len(numbers)}"] = of
    found = {
        name
        for by_group in owners.values()
        if len(by_group) > 1
        for names in by_group.values()
        for name in names
    }
    for first, second, _ in shared(numbers):
        pair = first.partition("/")[0], second.partition("/")[0]
        if groups[pair[0]] != groups[pair[1]]:
            found.update(pair)
    together = [name for name in known if name in found]
    if together and not any(is_output(known[name]) for name in together):
        parts = [name for name in together if isinstance(known[name], Input) and known[name].parts]
        if parts:
            raise _gumption.ModelError(
                f"{listed(parts)} have one quantity among their components; make "
                "it an input of its own"
            )
        return []
    return together
