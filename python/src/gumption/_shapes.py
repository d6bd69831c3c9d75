"""Input quantities: every distribution of a model file as a function.

Each function returns an `Input`. Keys of a model file's input without an argument of their own are
further keyword arguments: ``name`` (what it is called in formulas and budgets), ``about`` (the source of
uncertainty in words), ``type`` (``"A"`` or ``"B"``), ``group``, ``per`` (``"row"`` or the name of a
condition), ``evidence`` and so on. A key that the distribution does not have is a `TypeError`.

A width (``std``, ``half_width``, ``expanded``, ``scale``) is a number in the input's unit, or a
specification such as ``"0.02 % + 2 uV"``. An estimate may be a formula of conditions as text.
"""

from __future__ import annotations

import difflib
import json
import math
import os
import uuid
from collections.abc import Iterable, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

import numpy as np
import numpy.typing as npt

from gumption import _gumption
from gumption._formula import unit_within
from gumption._quantity import Quantity

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: A number, or a text that a model file may have in its place.
Value = Union[float, str, "np.floating[Any]", "np.integer[Any]"]


class FurtherOfComponents(TypedDict, total=False):
    """Keys of an input of any kind."""

    name: str
    about: str | None
    type: Literal["A", "B"] | None
    group: str | None
    per: str | None


class Further(FurtherOfComponents, total=False):
    """Keys of an input of any distribution."""

    evidence: npt.ArrayLike | str | None
    limits: tuple[Value | None, Value | None] | list[Value | None] | None


class FurtherOfWidth(Further, total=False):
    """Keys of an input whose width may be a specification."""

    resolution: Value | None
    range: Value | None
    full_scale: Value | None


class FurtherOfLimits(FurtherOfWidth, total=False):
    """Keys of an input within limits."""

    semi_range: Value | None


class FurtherOfReadings(Further, total=False):
    """Keys of readings."""

    resolution: Value | None
    pooled: Mapping[str, Any] | None
    evaluation: Literal["frequentist", "bayesian"] | None


class Input(Quantity):
    """An input quantity, as in a model file.

    Parameters
    ----------
    spec : mapping
        The keys of the input in a model file, its unit left out.
    unit : str, optional
        The unit; by default that of the model.
    held : iterable of (str, bytes)
        Files that the keys name, by their names.
    identity : str, optional
        The identity of the quantity; by default a new one.
    parts : iterable of str
        The identities of its components.
    name : str, optional
        Its name in formulas and budgets, where no model gives it another one.
    links : mapping of str to float, optional
        Correlation coefficients with the inputs of these identities.

    Notes
    -----
    An object is one quantity, wherever it is given: for two inputs of a model, which then always have
    the same value, or in models whose results are inputs of another one. Copies and unpickled
    objects are the same quantity.
    """

    __slots__ = ("held", "identity", "links", "parts", "spec", "unit")

    def __init__(
        self,
        spec: Mapping[str, Any],
        unit: str | None = None,
        held: Iterable[tuple[str, bytes]] = (),
        identity: str | None = None,
        parts: Iterable[str] = (),
        name: str = "",
        links: Mapping[str, float] | None = None,
    ) -> None:
        super().__init__(name)
        self.spec: dict[str, Any] = dict(spec)
        _check_finite(self.spec)
        self.unit = unit
        self.held: tuple[tuple[str, bytes], ...] = tuple(held)
        self.identity = identity if identity is not None else uuid.uuid4().hex
        self.parts: tuple[str, ...] = tuple(parts)
        self.links: dict[str, float] = dict(links or {})

    def linked_as(self, other: Input) -> Input:
        """The same quantity with the correlations that are declared of another object that it is.

        Parameters
        ----------
        other : Input
            The other object.
        """
        if other.links.items() <= self.links.items():
            return self
        links = {**self.links, **other.links}
        return Input(self.spec, self.unit, self.held, self.identity, self.parts, self.name, links)

    @property
    def name(self) -> str:
        """Its name in formulas and budgets, where no model gives it another one; empty without one."""
        return self.symbol

    @property
    def _unit(self) -> str:
        return self.unit if self.unit is not None else "1"

    @property
    def _is_exact(self) -> bool:
        return self.spec.get("distribution") == "constant"

    @property
    def _as_text(self) -> str | None:
        value = self.spec.get("value")
        if self.name or not self._is_exact or len(self.spec) > 2 or not isinstance(value, (int, float)):
            return None
        text = f"{value!r} [{self.unit}]" if self._unit != "1" else repr(value)
        return f"({text})" if value < 0 else text

    def to_dict(self, unit: str = "1") -> dict[str, Any]:
        """The input as in a model file; `unit` is used if it has none of its own.

        Parameters
        ----------
        unit : str, default "1"
            The unit of an input that has none.
        """
        return {"unit": self.unit if self.unit is not None else unit, **self.spec}

    def _repr_html_(self) -> str:
        from gumption import _notebook

        spec = {key: value for key, value in self.spec.items() if key != "components"}
        lines = [*([("name", self.name)] if self.name else []), *spec.items()]
        lines += [("unit", self.unit)] if self.unit is not None else []
        shown = [_notebook.table(["input", ""], [(key, _notebook.stated(value)) for key, value in lines])]
        if parts := self.spec.get("components"):
            shown.append(_notebook.inputs({part["name"]: part for part in parts}))
        return _notebook.whole(shown)

    def __repr__(self) -> str:
        name = f", name={self.name!r}" if self.name else ""
        return f"gumption.Input({self.spec!r}, unit={self.unit!r}{name})"

    def __reduce__(self) -> tuple[Any, ...]:
        own = (self.spec, self.unit, self.held, self.identity, self.parts, self.symbol, self.links)
        return Input, own


def plain(value: Any) -> Any:
    """Numbers of NumPy and exact fractions as Python numbers; other values unchanged."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (Decimal, Fraction)):
        return float(value)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    return value


def _check_finite(spec: Mapping[str, Any]) -> None:
    """Whether the numbers of an input are finite."""
    for key, value in spec.items():
        several = value if isinstance(value, list) else [value]
        for place, one in enumerate(several):
            if isinstance(one, float) and not math.isfinite(one):
                which = f"value {place} (from 0) of `{key}`" if several is value else f"`{key}`"
                raise _gumption.ModelError(f"{which} is {one}, but a finite number is needed")


#: Keys whose values are lists.
_LISTS = {"values", "limits", "evidence", "components"}


def _shape(
    distribution: str | None, unit: str | None, fields: Mapping[str, Any], more: Mapping[str, Any]
) -> Input:
    spec = {} if distribution is None else {"distribution": distribution}
    more = dict(more)
    name = more.pop("name", "")
    if more:
        _check_keys(distribution, more, fields)
    if name:
        _check_name(name)
    if unit is not None:
        unit_within(unit)
    for key, value in {**fields, **more}.items():
        found = plain(value)
        if key == "dof" and found == math.inf:
            continue
        if isinstance(found, complex):
            raise TypeError(f"`{key}` is complex; gumption.complex_normal makes a complex quantity")
        if isinstance(found, list) and key not in _LISTS:
            raise TypeError(f"`{key}`: one value is needed; gumption.array makes an array of quantities")
        if found is not None:
            spec[key] = found
    return Input(spec, unit, name=name)


#: Names that formulas can have.
_NAMES: set[str] = set()


def _check_name(name: str) -> None:
    """Whether formulas can have a name, by the engine's own word."""
    if name in _NAMES:
        return
    exact = {"distribution": "constant", "value": 1}
    probe = {"format": 1, "inputs": {name: exact}, "equations": {f"{name}_": "1"}, "outputs": {f"{name}_": {"unit": "1"}}}
    try:
        _gumption.Model("<name>", json.dumps(probe))
    except _gumption.ModelError as error:
        raise _gumption.ModelError(f"`name`: {error.errors[0]['message']}") from None
    _NAMES.add(name)


def _check_keys(distribution: str | None, keys: Iterable[str], own: Iterable[str] = ()) -> None:
    """Checks that an input of a distribution, or of components, has these keys.

    Parameters
    ----------
    distribution : str or None
        The distribution; `None` for an input with components.
    keys : iterable of str
        The keys that are given.
    own : iterable of str
        Keys of the constructor.
    """
    accepted = _gumption.input_keys(distribution)
    if accepted is None:
        # the distribution itself is unknown, which is the error of the model
        return
    for key in keys:
        if key not in accepted:
            kind = "with components" if distribution is None else f"of the distribution `{distribution}`"
            offered = [*own, *(name for name in accepted if name not in {*own, "distribution"})]
            near = difflib.get_close_matches(key, offered, 1)
            right = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(offered)}"
            raise TypeError(f"an input {kind} has no key `{key}`; {right}")


def constant(value: Value, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """A quantity that is known exactly.

    Parameters
    ----------
    value : float or str
        The value.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("constant", unit, {"value": value}, more)


def normal(
    mean: Value,
    std: Value | None = None,
    unit: str | None = None,
    *,
    expanded: Value | None = None,
    k: float | None = None,
    p: float | None = None,
    dof: float | None = None,
    **more: Unpack[FurtherOfWidth],
) -> Input:
    """A normal distribution.

    Parameters
    ----------
    mean : float or str
        Estimate.
    std : float or str, optional
        Standard uncertainty.
    unit : str, optional
        Unit of estimate and width; by default that of the model.
    expanded : float or str, optional
        Expanded uncertainty instead of `std`, with `k` or `p`.
    k, p : float, optional
        Coverage factor, or coverage probability, of `expanded`.
    dof : float, optional
        Degrees of freedom of the standard uncertainty. With them the trials are drawn from the
        scaled and shifted t (JCGM 101, 6.4.9.7).
    **more
        Further keys of an input in a model file.
    """
    fields = {"mean": mean, "std": std, "expanded": expanded, "k": k, "p": p, "dof": dof}
    return _shape("normal", unit, fields, more)


def rectangular(
    mean: Value | None = None,
    half_width: Value | None = None,
    unit: str | None = None,
    *,
    lower: Value | None = None,
    upper: Value | None = None,
    dof: float | None = None,
    **more: Unpack[FurtherOfLimits],
) -> Input:
    """A rectangular (uniform) distribution, by estimate and half-width or by its limits.

    Parameters
    ----------
    mean, half_width : float or str, optional
        The estimate and half the width of the distribution.
    unit : str, optional
        Unit of the values; by default that of the model.
    lower, upper : float or str, optional
        The limits instead of `mean` and `half_width`.
    dof : float, optional
        Degrees of freedom, if the limits are not known exactly (JCGM 100, G.4.2; JCGM 101, 6.4.3).
    **more
        Further keys of an input in a model file.
    """
    fields = {"mean": mean, "half_width": half_width, "lower": lower, "upper": upper, "dof": dof}
    return _shape("rectangular", unit, fields, more)


def triangular(
    mean: Value | None = None,
    half_width: Value | None = None,
    unit: str | None = None,
    *,
    lower: Value | None = None,
    upper: Value | None = None,
    mode: Value | None = None,
    dof: float | None = None,
    **more: Unpack[FurtherOfLimits],
) -> Input:
    """A triangular distribution, by estimate and half-width or by its limits.

    Parameters
    ----------
    mean, half_width : float or str, optional
        The estimate and half the width of the distribution.
    unit : str, optional
        Unit of the values; by default that of the model.
    lower, upper : float or str, optional
        The limits instead of `mean` and `half_width`.
    mode : float or str, optional
        With limits, the most probable value; the middle unless given.
    dof : float, optional
        Degrees of freedom of the standard uncertainty.
    **more
        Further keys of an input in a model file.
    """
    fields = {
        "mean": mean, "half_width": half_width, "lower": lower, "upper": upper, "mode": mode, "dof": dof,
    }  # fmt: skip
    return _shape("triangular", unit, fields, more)


def trapezoidal(
    mean: Value | None = None,
    half_width: Value | None = None,
    unit: str | None = None,
    *,
    beta: float,
    lower: Value | None = None,
    upper: Value | None = None,
    dof: float | None = None,
    **more: Unpack[FurtherOfLimits],
) -> Input:
    """A symmetric trapezoidal distribution, by estimate and half-width or by its limits.

    Parameters
    ----------
    mean, half_width : float or str, optional
        The estimate and half the width of the distribution.
    unit : str, optional
        Unit of the values; by default that of the model.
    beta : float
        The ratio of the width of its top to the width of its base.
    lower, upper : float or str, optional
        The limits instead of `mean` and `half_width`.
    dof : float, optional
        Degrees of freedom of the standard uncertainty.
    **more
        Further keys of an input in a model file.
    """
    fields = {
        "mean": mean, "half_width": half_width, "lower": lower, "upper": upper, "beta": beta, "dof": dof,
    }  # fmt: skip
    return _shape("trapezoidal", unit, fields, more)


def arcsine(
    mean: Value | None = None,
    half_width: Value | None = None,
    unit: str | None = None,
    *,
    lower: Value | None = None,
    upper: Value | None = None,
    **more: Unpack[FurtherOfLimits],
) -> Input:
    """An arcsine (U-shaped) distribution: a quantity that cycles sinusoidally.

    Parameters
    ----------
    mean, half_width : float or str, optional
        The estimate and half the width of the distribution.
    unit : str, optional
        Unit of the values; by default that of the model.
    lower, upper : float or str, optional
        The limits instead of `mean` and `half_width`.
    **more
        Further keys of an input in a model file.
    """
    fields = {"mean": mean, "half_width": half_width, "lower": lower, "upper": upper}
    return _shape("arcsine", unit, fields, more)


def curvilinear_trapezoid(
    lower: Value, upper: Value, inexactness: Value, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """A rectangular distribution whose limits are not known exactly (JCGM 101, 6.4.3).

    Parameters
    ----------
    lower, upper : float or str
        The estimates of the limits.
    inexactness : float or str
        Half the width of the interval in which each limit lies.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    fields = {"lower": lower, "upper": upper, "inexactness": inexactness}
    return _shape("curvilinear-trapezoid", unit, fields, more)


def student_t(
    mean: Value, scale: Value, dof: float, unit: str | None = None, **more: Unpack[FurtherOfWidth]
) -> Input:
    """A scaled and shifted t distribution.

    Parameters
    ----------
    mean : float or str
        The estimate.
    scale : float or str
        The scale; by the GUM it is the standard uncertainty.
    dof : float
        The degrees of freedom.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("t", unit, {"mean": mean, "scale": scale, "dof": dof}, more)


def readings(
    values: npt.ArrayLike,
    unit: str | None = None,
    *,
    paired: bool | None = None,
    **more: Unpack[FurtherOfReadings],
) -> Input:
    """Repeated readings (Type A): their mean, s/sqrt(n), and n - 1 degrees of freedom.

    Parameters
    ----------
    values : array_like
        The readings.
    unit : str, optional
        Their unit.
    paired : bool, optional
        Whether they were taken together with those of other inputs.
    **more
        Further keys of an input in a model file.
    """
    fields = {"values": np.asarray(values).tolist(), "paired": paired}
    return _shape("readings", unit, fields, more)


def exponential(mean: Value, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """An exponential distribution (JCGM 101, 6.4.10).

    Parameters
    ----------
    mean : float or str
        The estimate, which is the standard uncertainty as well.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("exponential", unit, {"mean": mean}, more)


def gamma(shape: float, rate: float, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """A gamma distribution.

    Parameters
    ----------
    shape : float
        The shape parameter.
    rate : float
        The rate parameter in 1/unit; the estimate is ``shape/rate``.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("gamma", unit, {"shape": shape, "rate": rate}, more)


def lognormal(mean: Value, std: Value, unit: str | None = None, **more: Unpack[FurtherOfWidth]) -> Input:
    """A log-normal distribution.

    Parameters
    ----------
    mean, std : float or str
        Estimate and standard uncertainty of the quantity, not of its logarithm.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("lognormal", unit, {"mean": mean, "std": std}, more)


def beta(
    alpha: float,
    beta: float,
    unit: str | None = None,
    *,
    lower: Value | None = None,
    upper: Value | None = None,
    **more: Unpack[Further],
) -> Input:
    """A beta distribution between 0 and 1, or between limits.

    Parameters
    ----------
    alpha, beta : float
        The parameters of the shape.
    unit : str, optional
        Unit of the values; by default that of the model.
    lower, upper : float or str, optional
        The limits.
    **more
        Further keys of an input in a model file.
    """
    fields = {"alpha": alpha, "beta": beta, "lower": lower, "upper": upper}
    return _shape("beta", unit, fields, more)


def log_uniform(
    lower: Value, upper: Value, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """A distribution whose logarithm is rectangular.

    Parameters
    ----------
    lower, upper : float or str
        The limits, above 0.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("log-uniform", unit, {"lower": lower, "upper": upper}, more)


def poisson_count(count: int, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """The expected number of events for a count (JCGM 101, 6.4.11).

    Parameters
    ----------
    count : int
        The number of events that were counted.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("poisson-count", unit, {"count": count}, more)


def samples(values: npt.ArrayLike, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """An empirical distribution: values that are drawn with replacement.

    Parameters
    ----------
    values : array_like
        The values.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    return _shape("samples", unit, {"values": np.asarray(values, dtype=float).tolist()}, more)


def result(
    file: str | os.PathLike[str], output: str, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """An output of a saved result (``Result.save``, ``gumption run --save``).

    Parameters
    ----------
    file : path-like
        The file.
    output : str
        The name of the output.
    unit : str, optional
        Unit of the values; by default that of the model.
    **more
        Further keys of an input in a model file.
    """
    import hashlib

    with open(file, "rb") as opened:
        content = opened.read()
    # two files of one name are told apart
    name = f"{hashlib.sha256(content).hexdigest()[:16]}.result.json"
    found = _shape("result", unit, {"file": name, "output": output}, more)
    return Input(found.spec, unit, [(name, content)], name=found.name)


def components(
    mean: Value | None,
    parts: Mapping[str, Input],
    unit: str | None = None,
    **more: Unpack[FurtherOfComponents],
) -> Input:
    """Several contributions to one quantity, by their names: calibration, resolution, drift.

    Parameters
    ----------
    mean : float or str or None
        The estimate; `None` if readings among the components give it.
    parts : mapping of str to Input
        The contributions, in the unit of the quantity, each with the estimate 0.
    unit : str, optional
        The unit of all.
    **more
        Further keys of an input in a model file.
    """
    own = [{"name": name, **part.spec} for name, part in parts.items()]
    held = [file for part in parts.values() for file in part.held]
    found = _shape(None, unit, {"mean": mean, "components": own}, more)
    return Input(found.spec, unit, held, parts=[part.identity for part in parts.values()], name=found.name)


def known(unit: str | None = None, **keys: Any) -> Input:
    """An input by the keys that it has in a model file.

    Parameters
    ----------
    unit : str, optional
        Its unit; by default that of the model.
    **keys
        The keys, such as ``distribution``.

    Examples
    --------
    >>> gumption.known("V", distribution="normal", mean=5, std="0.02 % + 2 uV").spec
    {'distribution': 'normal', 'mean': 5, 'std': '0.02 % + 2 uV'}
    """
    if "distribution" in keys or "components" in keys:
        _check_keys(keys.get("distribution"), keys)
    return _shape(None, unit, keys, {})
