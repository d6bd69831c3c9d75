"""Input quantities: every distribution of a model file as a function.

Each function returns an `Input`. Keys of a model file's input without an argument of their own are
further keyword arguments: ``about`` (the source of uncertainty in words), ``type`` (``"A"`` or
``"B"``), ``group``, ``per`` (``"row"`` or the name of a condition), ``evidence`` and so on. A key
that the distribution does not have is a `TypeError`.

A width (``std``, ``half_width``, ``expanded``, ``scale``) is a number in the input's unit, or a
specification such as ``"0.02 % + 2 uV"``. An estimate may be a formula of conditions as text.
"""

from __future__ import annotations

import difflib
import os
import uuid
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

import numpy as np
import numpy.typing as npt

from gumption import _gumption

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: A number, or a text that a model file may have in its place.
Value = Union[float, str, "np.floating[Any]", "np.integer[Any]"]


class FurtherOfComponents(TypedDict, total=False):
    """Keys of an input of any kind."""

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


class Input:
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

    Notes
    -----
    An object is one quantity, wherever it is given: for two inputs of a model, which then always have
    the same value, or in models whose results are inputs of another one. Copies and unpickled
    objects are the same quantity.
    """

    __slots__ = ("held", "identity", "parts", "spec", "unit")

    def __init__(
        self,
        spec: Mapping[str, Any],
        unit: str | None = None,
        held: Iterable[tuple[str, bytes]] = (),
        identity: str | None = None,
        parts: Iterable[str] = (),
    ) -> None:
        self.spec: dict[str, Any] = dict(spec)
        self.unit = unit
        self.held: tuple[tuple[str, bytes], ...] = tuple(held)
        self.identity = identity if identity is not None else uuid.uuid4().hex
        self.parts: tuple[str, ...] = tuple(parts)

    def to_dict(self, unit: str = "1") -> dict[str, Any]:
        """The input as in a model file; `unit` is used if it has none of its own."""
        return {"unit": self.unit if self.unit is not None else unit, **self.spec}

    def _repr_html_(self) -> str:
        from gumption import _notebook

        spec = {key: value for key, value in self.spec.items() if key != "components"}
        lines = [*spec.items(), *([("unit", self.unit)] if self.unit is not None else [])]
        shown = [_notebook.table(["input", ""], [(key, _notebook.stated(value)) for key, value in lines])]
        if parts := self.spec.get("components"):
            shown.append(_notebook.inputs({part["name"]: part for part in parts}))
        return _notebook.whole(shown)

    def __repr__(self) -> str:
        return f"gumption.Input({self.spec!r}, unit={self.unit!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Input, (self.spec, self.unit, self.held, self.identity, self.parts)


def plain(value: Any) -> Any:
    """Numbers of NumPy as Python numbers; other values unchanged."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    return value


def _shape(
    distribution: str | None, unit: str | None, fields: Mapping[str, Any], more: Mapping[str, Any]
) -> Input:
    spec = {} if distribution is None else {"distribution": distribution}
    if more:
        _check_keys(distribution, more, fields)
    for key, value in {**fields, **more}.items():
        if value is not None:
            spec[key] = plain(value)
    return Input(spec, unit)


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
    """A quantity that is known exactly."""
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

    With `dof` the limits are not known exactly (JCGM 100, G.4.2; JCGM 101, 6.4.3).
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
    """A triangular distribution; with limits the `mode` need not be in the middle."""
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
    """A symmetric trapezoidal distribution; `beta` is the ratio of its top's width to its base's."""
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
    """An arcsine (U-shaped) distribution: a quantity that cycles sinusoidally."""
    fields = {"mean": mean, "half_width": half_width, "lower": lower, "upper": upper}
    return _shape("arcsine", unit, fields, more)


def curvilinear_trapezoid(
    lower: Value, upper: Value, inexactness: Value, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """A rectangular distribution whose limits are not known exactly (JCGM 101, 6.4.3)."""
    fields = {"lower": lower, "upper": upper, "inexactness": inexactness}
    return _shape("curvilinear-trapezoid", unit, fields, more)


def student_t(
    mean: Value, scale: Value, dof: float, unit: str | None = None, **more: Unpack[FurtherOfWidth]
) -> Input:
    """A scaled and shifted t distribution; by the GUM its standard uncertainty is `scale`."""
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
    """An exponential distribution (JCGM 101, 6.4.10)."""
    return _shape("exponential", unit, {"mean": mean}, more)


def gamma(shape: float, rate: float, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """A gamma distribution; `rate` is in 1/unit."""
    return _shape("gamma", unit, {"shape": shape, "rate": rate}, more)


def lognormal(mean: Value, std: Value, unit: str | None = None, **more: Unpack[FurtherOfWidth]) -> Input:
    """A log-normal distribution; `mean` and `std` are those of the quantity itself."""
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
    """A beta distribution between 0 and 1, or between limits."""
    fields = {"alpha": alpha, "beta": beta, "lower": lower, "upper": upper}
    return _shape("beta", unit, fields, more)


def log_uniform(
    lower: Value, upper: Value, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """A distribution whose logarithm is rectangular, between limits above 0."""
    return _shape("log-uniform", unit, {"lower": lower, "upper": upper}, more)


def poisson_count(count: int, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """The expected number of events for a count (JCGM 101, 6.4.11)."""
    return _shape("poisson-count", unit, {"count": count}, more)


def samples(values: npt.ArrayLike, unit: str | None = None, **more: Unpack[Further]) -> Input:
    """An empirical distribution: values that are drawn with replacement."""
    return _shape("samples", unit, {"values": np.asarray(values, dtype=float).tolist()}, more)


def result(
    file: str | os.PathLike[str], output: str, unit: str | None = None, **more: Unpack[Further]
) -> Input:
    """An output of a saved result (``Result.save``, ``gumption run --save``)."""
    import hashlib

    with open(file, "rb") as opened:
        content = opened.read()
    # two files of one name are told apart
    name = f"{hashlib.sha256(content).hexdigest()[:16]}.result.json"
    found = _shape("result", unit, {"file": name, "output": output}, more)
    return Input(found.spec, unit, [(name, content)])


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
    return Input(found.spec, unit, held, parts=[part.identity for part in parts.values()])


def known(unit: str | None = None, **keys: Any) -> Input:
    """An input by the keys that it has in a model file.

    Examples
    --------
    >>> gumption.known("V", distribution="normal", mean=5, std="0.02 % + 2 uV").spec
    {'distribution': 'normal', 'mean': 5, 'std': '0.02 % + 2 uV'}
    """
    if "distribution" in keys or "components" in keys:
        _check_keys(keys.get("distribution"), keys)
    return _shape(None, unit, keys, {})
