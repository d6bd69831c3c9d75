"""Measurement models as Python functions."""

from __future__ import annotations

import inspect
import json
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption
from gumption._frames import condition_file
from gumption._model import Model
from gumption._quantities import as_input, shared
from gumption._shapes import Input
from gumption._trace import NotTraceable, Traced, equations


class NotTracedWarning(UserWarning):
    """A function is evaluated by Python, which is slower, since it could not be traced."""


def quantity(value: float, unit: str) -> Any:
    """A quantity with a unit within a model function, as its number in coherent SI units.

    Model functions compute with coherent SI units (radians for angles), so a number without a unit is
    a number. ``gumption.quantity(20, "mm")`` is a length.

    Parameters
    ----------
    value : float
        The value.
    unit : str
        Its unit.
    """
    if _TRACING:
        tape = _TRACING[-1].tape
        return Traced(tape, f"{float(value)!r} [{unit}]")
    factor, offset = _gumption.unit_scale(unit)
    return float(value) * factor + offset


# the traced arguments of the functions that are being traced now, innermost last
_TRACING: list[Traced] = []


def _takes(function: Callable[..., Any], names: Sequence[str]) -> bool:
    """Whether a function takes arguments of these names."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    named = {p.name for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)}
    return named.issuperset(names) or any(p.kind == p.VAR_KEYWORD for p in parameters)


class Measurement:
    """A measurement model that is a Python function; `model` makes it.

    Called with what is known about the inputs it gives a `Model`.

    Attributes
    ----------
    function : callable
        The function as it was written.
    inputs, outputs, conditions : dict of str to str
        Their names and units.
    equations : dict of str to str or None
        The formulas that were traced; `None` where the function could not be.
    why_not_traced : str or None
        Why it could not be.
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
    ) -> None:
        self.function = function
        self.inputs = dict(inputs)
        self.outputs = dict(outputs)
        self.conditions = dict(conditions or {})
        first = (inspect.getdoc(function) or "").strip().partition("\n")[0]
        self.title = title if title is not None else first or getattr(function, "__name__", "model")
        self.check_units = check_units
        self.equations: dict[str, str] | None = None
        self.why_not_traced: str | None = None
        self._budgets: Model | None = None
        self._by_name = _takes(function, [*self.inputs, *self.conditions])
        for attribute in ("__name__", "__qualname__", "__module__", "__doc__"):
            if hasattr(function, attribute):
                setattr(self, attribute, getattr(function, attribute))
        self.__wrapped__ = function
        if trace:
            self._trace()
        else:
            self.why_not_traced = "it was not to be traced"

    def _trace(self) -> None:
        arguments = [*self.inputs, *self.conditions]

        def called(**traced: Traced) -> Any:
            _TRACING.append(next(iter(traced.values())))
            try:
                return self._called(traced)
            finally:
                _TRACING.pop()

        if not arguments:
            self.why_not_traced = "it has no arguments"
            return
        try:
            # comparisons of traced numbers with missing ones and the like are told by exceptions
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.equations = equations(called, arguments, self.outputs, self._named)
        except NotTraceable as reason:
            self.why_not_traced = str(reason)
        except Exception as error:  # noqa: BLE001 - whatever a function of somebody else's says
            self.why_not_traced = f"{type(error).__name__}: {error}"

    def _called(self, values: Mapping[str, Any]) -> Any:
        """Calls the function, by names where it has them."""
        return self.function(**values) if self._by_name else self.function(*values.values())

    def _named(self, found: Any) -> Mapping[str, Any]:
        """Which of what the function gave is which output."""
        names = list(self.outputs)
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
        )  # fmt: skip

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
    ) -> Model:
        """The model with what is known about its inputs.

        Parameters
        ----------
        *arguments, **named
            What is known about each input: `Input` objects, numbers (known exactly), pairs of
            estimate and standard uncertainty, outputs of results, or numbers of other libraries.
        conditions : DataFrame or mapping, optional
            A column for each condition of the model; the model is evaluated in every row. A mapping
            of numbers is one row.
        correlations : sequence of (str, str, float), optional
            Correlation coefficients of inputs.
        title : str, optional
            Title of the pages; that of the function unless given.
        trials, seed, coverage_probability, coverage_factor : optional
            As in a model file; `Model.run` may say otherwise.
        tolerance : mapping, optional
            For each output that has one its limits ``{"lower": ..., "upper": ...}``, in its unit.

        Returns
        -------
        Model
        """
        known = self._bound(arguments, named)
        inputs: dict[str, dict[str, Any]] = {}
        held: dict[str, bytes] = {}
        aliases: dict[str, str] = {}
        first: dict[int, str] = {}
        twins: list[tuple[str, str, float]] = []
        for name, value in known.items():
            found = as_input(value, name)
            # one object for two arguments is one quantity
            twin = first.get(id(value)) if isinstance(value, Input) else None
            if twin is not None and self.equations is not None:
                if found.unit is not None or self.inputs[twin] == self.inputs[name]:
                    aliases[name] = twin
                    continue
            elif twin is not None:
                twins.append((twin, name, 1.0))
            self._check_unit(name, found.unit)
            first.setdefault(id(value), name)
            inputs[name] = found.to_dict(self.inputs[name])
            held.update(found.held)
        links = [*correlations, *shared({n: known[n] for n in inputs}), *twins]
        file: dict[str, Any] = {"format": 1, "title": title if title is not None else self.title}
        if not self.check_units:
            file["check_units"] = False
        file["inputs"] = inputs
        if links:
            file["correlations"] = [list(link) for link in links]
        if self.conditions:
            if conditions is None:
                raise _gumption.ModelError(
                    f"the model has conditions ({', '.join(self.conditions)}); give their values with "
                    "`conditions=`"
                )
            file["conditions"], table = condition_file(conditions, self.conditions)
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
        function = None
        if self.equations is not None:
            file["equations"] = {**aliases, **self.equations}
        else:
            warnings.warn(
                f"`{self.title}` could not be traced ({self.why_not_traced}); it is evaluated by Python "
                "in blocks of values, which is slower, with sensitivities by central differences",
                NotTracedWarning,
                stacklevel=2,
            )
            # it says which quantities there are; the function computes in its place
            file["check_units"] = False
            whole = " + ".join([*inputs, *self.conditions])
            file["equations"] = {name: whole for name in self.outputs}
            function = BlockFunction(self)
        file["outputs"] = outputs
        if settings:
            file["monte_carlo"] = settings
        name = f"<{getattr(self, '__name__', 'model')}>"
        text = json.dumps(file, indent=1, ensure_ascii=False, allow_nan=False)
        return Model._of(_gumption.Model(name, text, "", list(held.items())), function)

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
        names = list(self.inputs)
        if len(arguments) > len(names):
            raise TypeError(f"the model has {len(names)} inputs, but {len(arguments)} are given")
        known = dict(zip(names, arguments))
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
        """The model for budgets in columns, whose inputs are all given by these."""
        if self.equations is None:
            raise _gumption.ModelError(
                f"`{self.title}` could not be traced ({self.why_not_traced}); budgets in columns need "
                "formulas"
            )
        if self._budgets is None:
            anything = [Input({"distribution": "constant", "value": 1}) for _ in self.inputs]
            at = {name: [1.0] for name in self.conditions} or None
            self._budgets = self(*anything, conditions=at)
        return self._budgets


def _again(
    function: Callable[..., Any],
    inputs: Mapping[str, str],
    outputs: Mapping[str, str],
    conditions: Mapping[str, str],
    title: str,
    check_units: bool,
) -> Measurement:
    return Measurement(
        function, inputs, outputs, conditions=conditions, title=title, check_units=check_units
    )


class BlockFunction:
    """A function that is not traced, as the engine calls it: columns in the declared units."""

    def __init__(self, measurement: Measurement) -> None:
        self.measurement = measurement
        self._one_by_one = False

    def __reduce__(self) -> Any:
        return BlockFunction, (self.measurement,)

    def of(self, model: _gumption.Model) -> Callable[[list[npt.NDArray[np.float64]]], list[Any]]:
        """The function over the columns of the variables of a model."""
        variables, units = model.variables, dict([*model.inputs, *model.conditions])
        scales = {name: _gumption.unit_scale(unit) for name, unit in units.items()}
        # components of an input are summed
        owner = [name.partition("/")[0] for name in variables] + [n for n, _ in model.conditions]
        outputs = [(name, _gumption.unit_scale(unit)) for name, unit in model.outputs]
        check = self.measurement.check_units

        def called(columns: list[npt.NDArray[np.float64]]) -> list[Any]:
            sums: dict[str, Any] = {}
            for name, column in zip(owner, columns):
                sums[name] = sums[name] + column if name in sums else column
            if check:
                for name, (factor, offset) in scales.items():
                    sums[name] = sums[name] * factor + offset
            found = self._evaluate(sums, len(columns[0]))
            given = []
            for name, (factor, offset) in outputs:
                values = np.broadcast_to(np.asarray(found[name], dtype=np.float64), len(columns[0]))
                given.append(np.ascontiguousarray((values - offset) / factor if check else values))
            return given

        return called

    def _evaluate(self, sums: Mapping[str, Any], count: int) -> Mapping[str, Any]:
        called, named = self.measurement._called, self.measurement._named
        names = [*self.measurement.inputs, *self.measurement.conditions]
        sums = {name: sums[name] for name in names}
        # what is undefined is counted, and need not be said each time
        with np.errstate(all="ignore"):
            if not self._one_by_one:
                try:
                    found = named(called(sums))
                    if all(np.shape(value) in ((), (count,)) for value in found.values()):
                        return found
                except (TypeError, ValueError):
                    pass
                # it takes numbers and no arrays
                self._one_by_one = True
            rows = []
            for i in range(count):
                try:
                    rows.append(named(called({name: float(v[i]) for name, v in sums.items()})))
                except ArithmeticError:
                    rows.append({name: np.nan for name in self.measurement.outputs})
        return {name: [float(row[name]) for row in rows] for name in self.measurement.outputs}


def model(
    *,
    inputs: Mapping[str, str],
    outputs: Mapping[str, str],
    conditions: Mapping[str, str] | None = None,
    title: str | None = None,
    check_units: bool = True,
    trace: bool = True,
) -> Callable[[Callable[..., Any]], Measurement]:
    """Make a measurement model of a Python function.

    The function is called once with numbers that write down what is done to them by operators and
    functions of NumPy. What comes out is evaluated by the engine, as fast as a model file. Where the
    function does what cannot be written down (``if`` on a value, loops over data, calls of other
    libraries), it is evaluated by Python on blocks of the engine's draws instead, its sensitivities
    are central differences, and a `NotTracedWarning` says so.

    Quantities within the function are in coherent SI units, radians for angles, and their
    dimensions are checked. A number is a number; `quantity` makes a quantity of one.

    Parameters
    ----------
    inputs : mapping of str to str
        Names of the function's arguments and the units of these quantities.
    outputs : mapping of str to str
        Names and units of what it gives, in order: one value, a sequence, or a mapping by name.
    conditions : mapping of str to str, optional
        Further arguments that are set and known, with their units.
    title : str, optional
        Title of pages; the first line of the docstring unless given.
    check_units : bool, default True
        Whether dimensions are checked. Without it the function computes with the numbers of the
        declared units, and nothing is converted.
    trace : bool, default True
        Whether to trace the function.

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
    7854.7
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
        )

    return decorate
