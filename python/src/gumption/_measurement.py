"""Measurement models as Python functions."""

from __future__ import annotations

import inspect
import itertools
import json
import re
import types
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._arguments import Arguments
from gumption._block import BlockFunction, Way
from gumption._check import checked
from gumption._conditions import condition_file
from gumption._joint import identity_of
from gumption._labels import Labels
from gumption._model import Model, joined, take_inputs, written
from gumption._quantities import as_alone, as_known, unit_of
from gumption._shapes import Input
from gumption._trace import NotTraceable, Traced, decision_formulas, equations


class NotTracedWarning(UserWarning):
    """Python evaluates a function, which is slower, because it could not be traced."""


class Measurement:
    """A measurement model that is a Python function; `model` makes it.

    Called with its inputs it returns a `Model`.

    Attributes
    ----------
    function : callable
        The original function.
    inputs, outputs, conditions : dict of str to str
        Their names and units.
    equations : dict of str to str or None
        The traced formulas; `None` if tracing failed.
    why_not_traced : str or None
        Why tracing failed.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        inputs: Mapping[str, str],
        outputs: Mapping[str, str],
        *,
        conditions: Mapping[str, str] | None = None,
        title: str | None = None,
        check_units: bool = True,
        trace: bool = True,
        check: bool = True,
    ) -> None:
        self.function = function
        self.inputs = dict(inputs)
        self.outputs = dict(outputs)
        self.conditions = dict(conditions or {})
        first = (inspect.getdoc(function) or "").strip().partition("\n")[0]
        self.title = title if title is not None else first or getattr(function, "__name__", "model")
        self.check_units = check_units
        self.check = check
        self._is_traced = trace
        self.equations: dict[str, str] | None = None
        self.why_not_traced: str | None = None
        self._budgets: Model | None = None
        units = {**self.inputs, **self.conditions}
        self._arguments = Arguments(function, list(units))
        #: Names and units of the arguments, in the order of the function.
        self.arguments = {name: units[name] for name in self._arguments.names}
        for attribute in ("__name__", "__qualname__", "__module__", "__doc__"):
            if hasattr(function, attribute):
                setattr(self, attribute, getattr(function, attribute))
        self.__wrapped__ = function
        if trace:
            self._trace()
        else:
            self.why_not_traced = "it was not to be traced"

    def _trace(self) -> None:
        if not self.arguments:
            self.why_not_traced = "it has no arguments"
            return
        try:
            # comparisons of traced numbers with missing ones and the like are told by exceptions
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.equations = equations(
                    self._call, self.arguments, self.outputs, self._named, has_units=self.check_units
                )
        except NotTraceable as refused:
            self.why_not_traced = str(refused)
            if refused.decision is not None and self.check_units:
                self._check_decision(refused.decision)
        except _gumption.ModelError as error:
            raise _gumption.ModelError(f"`{self.title}`: {error}") from None
        except Exception as error:  # noqa: BLE001 - whatever a function of somebody else's says
            self.why_not_traced = f"{type(error).__name__}: {error}"

    def _check_decision(self, decision: Traced) -> None:
        """Raises an error for a comparison of quantities with different dimensions."""
        taken = [*self.arguments, *self.outputs]
        name = "decision"
        while name in taken:
            name += "_"
        shown, formulas = decision_formulas(decision, name, taken)
        known = {"distribution": "constant", "value": 1}
        file = {
            "format": 1,
            "inputs": {argument: {"unit": unit, **known} for argument, unit in self.arguments.items()},
            "equations": formulas,
            "outputs": {name: {"unit": "1"}},
        }
        try:
            _gumption.Model("decision", json.dumps(file))
        except _gumption.ModelError as error:
            said = error.errors[0]["message"] if error.errors else str(error)
            names = set(re.findall(r"\w+", " ".join(formulas.values())))
            units = [unit for n, unit in self.arguments.items() if n in names and unit != "1"]
            raise _gumption.ModelError(
                f"`{self.title}` decides by `{shown}`: {said}. {self._units_within()} A number may be meant "
                "in the declared unit or in the one within the function: say which with "
                f"`gumption.quantity(..., \"{units[0] if units else '1'}\")`, or let the function compute "
                "with the numbers of its declared units: `gumption.model(..., check_units=False)`"
            ) from None

    def _units_within(self) -> str:
        """The units in which the function computes, in words."""
        within = {name: _gumption.unit_within(unit)[0] for name, unit in self.arguments.items()}
        declared = self.arguments.items()
        units = [f"`{n}` is in {within[n]} (declared in {u})" for n, u in declared if within[n] != u]
        return f"Within the function {', '.join(units)}." if units else ""

    def called(self, values: Mapping[str, Any]) -> Mapping[str, Any]:
        """The results of the function for one value of each argument, by the names of the outputs.

        Parameters
        ----------
        values : mapping of str to object
            A value for each argument by its name.
        """
        return self._named(self._call(values))

    def _call(self, values: Mapping[str, Any]) -> Any:
        return self._arguments.call(self.function, values)

    def _named(self, found: Any) -> Mapping[str, Any]:
        """The results of the function by output."""
        names = list(self.outputs)
        # what is mostly given is asked first: each draw of a check comes along here
        if isinstance(found, float) and len(names) == 1:
            return {names[0]: found}
        if isinstance(found, Mapping):
            missing = [name for name in names if name not in found]
            if missing:
                raise KeyError(f"the function gave no {', '.join(missing)}")
            return found
        if len(names) == 1 and not isinstance(found, (tuple, list)):
            return {names[0]: found}
        found = list(found)
        if len(found) != len(names):
            raise ValueError(
                f"the function gave {len(found)} values, but the outputs are {', '.join(names)}"
            )
        return dict(zip(names, found))

    def latex(self) -> str:
        """The traced equations in LaTeX.

        Raises
        ------
        ModelError
            If the function could not be traced.
        """
        if self.equations is None:
            raise _gumption.ModelError(f"`{self.title}` could not be traced ({self.why_not_traced})")
        return _notebook.latex_equations(self.equations)

    def _repr_latex_(self) -> str | None:
        return None if self.equations is None else self.latex()

    def _repr_html_(self) -> str:
        shown = [_notebook.title(self.title)]
        if self.equations is not None:
            shown.append(_notebook.equations(self.equations))
        else:
            why = _notebook.table(["computed by Python, as it is not traced"], [[self.why_not_traced]])
            shown.append(why)
        for heading, units in (
            ("input", self.inputs), ("condition", self.conditions), ("output", self.outputs),
        ):  # fmt: skip
            if units:
                shown.append(_notebook.table([heading, "unit"], units.items()))
        return _notebook.whole(shown)

    def __repr__(self) -> str:
        how = "traced" if self.equations is not None else "not traced"
        return f"<gumption.Measurement {self.title!r}: {', '.join(self.outputs)} ({how})>"

    def __reduce__(self) -> Any:
        name = getattr(self, "__qualname__", "")
        module = inspect.getmodule(self.function)
        held: Any = module
        for part in name.split("."):
            held = getattr(held, part, None)
        if held is self:
            return name
        return _again, (
            self.function, self.inputs, self.outputs, self.conditions, self.title, self.check_units,
            self._is_traced, self.check,
        )  # fmt: skip

    @overload
    def __call__(
        self,
        *arguments: Any,
        conditions: None = None,
        correlations: Sequence[tuple[str, str, float]] = ...,
        title: str | None = ...,
        trials: int | str | None = ...,
        seed: int | None = ...,
        coverage_probability: float | None = ...,
        coverage_factor: float | None = ...,
        tolerance: Mapping[str, Mapping[str, float]] | None = ...,
        **named: Any,
    ) -> Model[float]: ...

    @overload
    def __call__(
        self,
        *arguments: Any,
        conditions: Any,
        correlations: Sequence[tuple[str, str, float]] = ...,
        title: str | None = ...,
        trials: int | str | None = ...,
        seed: int | None = ...,
        coverage_probability: float | None = ...,
        coverage_factor: float | None = ...,
        tolerance: Mapping[str, Mapping[str, float]] | None = ...,
        **named: Any,
    ) -> Model[npt.NDArray[np.float64]]: ...

    def __call__(
        self,
        *arguments: Any,
        conditions: Any = None,
        correlations: Sequence[tuple[str, str, float]] = (),
        title: str | None = None,
        trials: int | str | None = None,
        seed: int | None = None,
        coverage_probability: float | None = None,
        coverage_factor: float | None = None,
        tolerance: Mapping[str, Mapping[str, float]] | None = None,
        **named: Any,
    ) -> Model[Any]:
        """The model with its inputs.

        Parameters
        ----------
        *arguments, **named
            The inputs: `Input` objects, numbers (exactly known), pairs of
            estimate and standard uncertainty, outputs of results, or numbers of other libraries.
        conditions : DataFrame or mapping, optional
            A column for each condition of the model; the model is evaluated in every row. A mapping
            of numbers is one row.
        correlations : sequence of (str, str, float), optional
            Correlation coefficients of inputs.
        title : str, optional
            Title of the pages; that of the function unless given.
        trials, seed, coverage_probability, coverage_factor : optional
            As in a model file; `Model.run` may override them.
        tolerance : mapping, optional
            The limits of outputs with a tolerance, ``{"lower": ..., "upper": ...}``, in its unit.

        Returns
        -------
        Model
        """
        known = self._bound(arguments, named)
        aliases = self._aliases(known)
        file: dict[str, Any] = {"format": 1, "title": title if title is not None else self.title}
        if not self.check_units:
            file["check_units"] = False
        file["inputs"] = dict.fromkeys(known)
        if correlations:
            file["correlations"] = [list(link) for link in correlations]
        held: dict[str, bytes] = {}
        labels: Labels | None = None
        if self.conditions:
            if conditions is None:
                raise _gumption.ModelError(
                    f"the model has conditions ({', '.join(self.conditions)}); give their values with "
                    "`conditions=`"
                )
            file["conditions"], table, labels = condition_file(conditions, self.conditions)
            held.update(table)
        elif conditions is not None:
            raise _gumption.ModelError(
                "the model has no conditions; name them with `@gumption.model(conditions=...)`"
            )
        outputs: dict[str, Any] = {name: {"unit": unit} for name, unit in self.outputs.items()}
        for name, limits in (tolerance or {}).items():
            outputs.setdefault(name, {})["tolerance"] = dict(limits)
        settings: dict[str, Any] = {}
        if trials is not None:
            settings["trials"] = trials
        if seed is not None:
            settings["seed"] = seed
        if coverage_probability is not None:
            file["coverage_probability"] = coverage_probability
        if coverage_factor is not None:
            file["coverage_factor"] = coverage_factor
        if settings:
            file["monte_carlo"] = settings
        file["outputs"] = outputs
        made = self._model(file, known, held, aliases)
        made._labels = labels
        return made

    def _model(
        self,
        file: dict[str, Any],
        known: Mapping[str, Any],
        held: Mapping[str, bytes],
        aliases: Mapping[str, str],
    ) -> Model[Any]:
        """The model of a file that has no formulas yet, and nothing about its inputs."""
        formulas = {**aliases, **(self.equations or {})}
        file["equations"] = formulas
        files, all_known = take_inputs(file, known, self.inputs, {})
        files = {**held, **files}
        if all_known.keys() != known.keys() and self.equations is None:
            raise _gumption.ModelError(
                f"`{self.title}` could not be traced ({self.why_not_traced}), so it cannot be evaluated "
                "together with expressions, or with the models of results that go back to the same quantity; "
                "write one function of what they go back to"
            )
        # it says which quantities there are, where the function computes in its place
        whole = " + ".join([*known, *self.conditions])
        by_python = {**file, "check_units": False, "equations": dict.fromkeys(self.outputs, whole)}
        rust = self._read(file if self.equations is not None else by_python, files)
        if all_known.keys() == known.keys():
            alone = rust
        else:
            # the function has the results as its arguments, about which their figures are enough to know
            inputs = {name: as_alone(value, name).to_dict(self.inputs[name]) for name, value in known.items()}
            own = {key: value for key, value in file.items() if key != "correlations"}
            alone = self._read({**own, "inputs": inputs, "equations": formulas}, files)
        function = BlockFunction(self, Way.UNCHECKED, aliases) if self.equations is None else None
        if not self.check:
            self._warn(function, None)
            return Model._of(rust, function, all_known)
        found = checked(self, alone, aliases)
        self._warn(found.function, found.difference)
        if found.function is not None and self.equations is not None:
            if alone is not rust:
                raise _gumption.ModelError(f"`{self.title}`: {found.difference}")
            rust = self._read(by_python, files)
        return Model._of(rust, found.function, all_known, found.held)

    def _read(self, file: Mapping[str, Any], held: Mapping[str, bytes]) -> _gumption.Model:
        name = f"<{getattr(self, '__name__', 'model')}>"
        return _gumption.Model(name, written(file), "", list(held.items()))

    def _warn(self, function: BlockFunction | None, difference: str | None) -> None:
        """Warns that Python evaluates a function, with the reason."""
        if function is None:
            return
        if self.equations is not None:
            why = f"`{self.title}` is not evaluated by its formulas, as {difference};"
        else:
            why = f"`{self.title}` could not be traced ({self.why_not_traced});"
            if difference is not None:
                why = f"{why} {difference};"
        how = "in blocks of values" if function.way in (Way.COLUMNS, Way.UNCHECKED) else "one draw at a time"
        units = [*self.arguments.values(), *self.outputs.values()]
        has_units = self.check_units and {*units} != {"1"}
        unchecked = f" Dimensions are not checked. {self._units_within()}".rstrip() if has_units else ""
        if has_units and any(_gumption.unit_within(unit)[2] for unit in units):
            if named := sorted(_names(getattr(self.function, "__code__", None)) & _CONVERSIONS):
                unchecked += (
                    f" It uses `{'`, `'.join(named)}`, but its angles are in radians already, and it gives "
                    "them in radians: leave the conversion out, or say `check_units=False`, if that is of "
                    "one of them."
                )
        warnings.warn(
            f"{why} it is evaluated by Python {how}, which is slower, with sensitivities by central "
            f"differences.{unchecked}",
            NotTracedWarning,
            stacklevel=4,
        )

    def _aliases(self, known: dict[str, Any]) -> dict[str, str]:
        """Removes inputs that are the same quantity as a previous one."""
        aliases: dict[str, str] = {}
        first: dict[object, str] = {}
        for name, value in list(known.items()):
            found = known[name] = as_known(value, name)
            unit = unit_of(found)
            self._check_unit(name, unit)
            twin = first.setdefault(identity_of(found), name)
            if twin == name:
                continue
            if unit is None and self.inputs[twin] != self.inputs[name]:
                raise _gumption.ModelError(
                    f"one quantity is given for `{twin}` in {self.inputs[twin]} and for `{name}` in "
                    f"{self.inputs[name]}, and has no unit of its own; give it one"
                )
            aliases[name] = twin
            known[twin] = joined(known[twin], found)
            del known[name]
        return aliases

    def _check_unit(self, name: str, unit: str | None) -> None:
        """Whether an input may be given in that unit."""
        own = self.inputs[name]
        if unit is None or unit == own:
            return
        _gumption.unit_scale(unit)
        if not self.check_units:
            raise _gumption.ModelError(
                f"`{name}` is given in {unit}, but a function whose units are not checked computes with "
                f"the numbers of its declared units; give it in {own}"
            )
        if not _gumption.units_fit(unit, own):
            raise _gumption.ModelError(f"`{name}` is given in {unit}, but the model takes {own}")

    def _bound(self, arguments: Sequence[Any], named: Mapping[str, Any]) -> dict[str, Any]:
        names = [name for name in self.arguments if name in self.inputs]
        by_position = itertools.takewhile(self.inputs.__contains__, self._arguments.positional)
        positional = list(by_position)
        if len(arguments) > len(positional):
            raise TypeError(
                f"{len(arguments)} inputs are given by position, but the function begins with "
                f"{len(positional)} that can be ({', '.join(positional)}); give the others by name"
            )
        known = dict(zip(positional, arguments))
        for name, value in named.items():
            if name in known:
                raise TypeError(f"`{name}` is given twice")
            if name not in self.inputs:
                raise TypeError(f"the model has no input `{name}`; it has {', '.join(names)}")
            known[name] = value
        missing = [name for name in names if name not in known]
        if missing:
            raise TypeError(f"nothing is said about {', '.join(missing)}")
        return {name: known[name] for name in names}

    def bulk_model(self) -> Model:
        """The model for budgets in columns, in which all inputs are columns."""
        if self.equations is None:
            raise _gumption.ModelError(
                f"`{self.title}` could not be traced ({self.why_not_traced}); budgets in columns need "
                "formulas"
            )
        if self._budgets is None:
            known = {"distribution": "constant", "value": 1}
            anything: dict[str, Any] = {name: Input(known) for name in self.inputs}
            at = {name: [1.0] for name in self.conditions} or None
            # it is checked at the values that are given
            unchecked = Measurement(
                self.function, self.inputs, self.outputs, conditions=self.conditions, title=self.title,
                check_units=self.check_units, check=False,
            )  # fmt: skip
            self._budgets = unchecked(**anything, conditions=at)
        return self._budgets


#: Functions between degrees and radians, in `math` and in NumPy.
_CONVERSIONS = {"radians", "degrees", "deg2rad", "rad2deg"}


def _names(code: object) -> set[str]:
    """The names that the code of a function and of those within it uses."""
    if not isinstance(code, types.CodeType):
        return set()
    return set(code.co_names).union(*map(_names, code.co_consts))


def _again(
    function: Callable[..., Any],
    inputs: Mapping[str, str],
    outputs: Mapping[str, str],
    conditions: Mapping[str, str],
    title: str,
    *options: bool,
) -> Measurement:
    check_units, trace, check = options
    return Measurement(
        function, inputs, outputs, conditions=conditions, title=title,
        check_units=check_units, trace=trace, check=check,
    )  # fmt: skip


def model(
    *,
    inputs: Mapping[str, str],
    outputs: Mapping[str, str],
    conditions: Mapping[str, str] | None = None,
    title: str | None = None,
    check_units: bool = True,
    trace: bool = True,
    check: bool = True,
) -> Callable[[Callable[..., Any]], Measurement]:
    """Make a measurement model of a Python function.

    The function is called once with numbers that record operators and functions of NumPy. The
    engine evaluates the recorded formulas as fast as a model file. If the function does something
    that cannot be recorded (``if`` on a value, loops over data, calls of other
    libraries), Python evaluates it on blocks of the engine's draws instead, with central
    differences as sensitivity coefficients, and a `NotTracedWarning` is issued.

    Quantities within the function are in coherent SI units, angles in radians, and their dimensions
    are checked. A plain number is dimensionless; `quantity` gives it a unit.

    Parameters
    ----------
    inputs : mapping of str to str
        Names of the function's arguments and the units of these quantities.
    outputs : mapping of str to str
        Names and units of its results, in order: one value, a sequence, or a mapping by name.
    conditions : mapping of str to str, optional
        Further arguments for exactly known conditions, with their units.
    title : str, optional
        Title of pages; the first line of the docstring unless given.
    check_units : bool, default True
        Whether dimensions are checked. Without it the function computes with the numbers of the
        declared units, and nothing is converted.
    trace : bool, default True
        Whether to trace the function.
    check : bool, default True
        Whether to check it when a model is made: it is called with 32 draws of its inputs one at a
        time. If the traced formulas, or calls with whole columns of draws, give other results, the
        function is evaluated one draw at a time, and a `NotTracedWarning` shows the difference. A
        function that does not return the same value twice raises an error.

    Returns
    -------
    callable
        A decorator that gives a `Measurement`.

    Examples
    --------
    >>> import numpy as np
    >>> @gumption.model(inputs={"mass": "g", "diameter": "mm", "height": "mm"},
    ...                 outputs={"density": "kg/m^3"})
    ... def cylinder(mass, diameter, height):
    ...     return 4 * mass / (np.pi * diameter**2 * height)
    >>> cylinder.equations
    {'density': '4*mass/(pi*diameter^2*height)'}
    >>> m = cylinder(mass=gumption.normal(21.32, 0.01), diameter=(12.0, 0.005), height=24.0)
    >>> round(m.run(trials=0)["density"].gum.estimate, 1)
    7854.6
    """

    def decorate(function: Callable[..., Any]) -> Measurement:
        return Measurement(
            function,
            inputs,
            outputs,
            conditions=conditions,
            title=title,
            check_units=check_units,
            trace=trace,
            check=check,
        )

    return decorate
