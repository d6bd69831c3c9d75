"""Numbers of other libraries as inputs, with their correlations.

This module imports no library that the caller has not imported: it recognizes numbers by the module
of their type.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gumption import _gumption
from gumption._quantity import Expression, Quantity
from gumption._shapes import Input, plain


def _root(value: object) -> str:
    return type(value).__module__.partition(".")[0]


def is_ufloat(value: object) -> bool:
    """Whether it is a number of ``uncertainties``."""
    return _root(value) == "uncertainties" and hasattr(value, "std_dev")


def is_gtc(value: object) -> bool:
    """Whether it is an uncertain real number of ``GTC``."""
    return _root(value) == "GTC" and hasattr(value, "df")


def is_pint(value: object) -> bool:
    """Whether it is a quantity of ``pint``."""
    return hasattr(value, "magnitude") and hasattr(value, "_REGISTRY")


def is_astropy(value: object) -> bool:
    """Whether it is a quantity of ``astropy``."""
    return _root(value) == "astropy" and hasattr(value, "unit") and hasattr(value, "value")


def is_frozen(value: object) -> bool:
    """Whether it is a frozen distribution of ``scipy.stats``."""
    return hasattr(value, "dist") and hasattr(value, "ppf") and hasattr(value, "kwds")


def _product(powers: Mapping[str, Any]) -> str:
    """A unit text with these factors."""
    names = {"delta_degree_Celsius": "K", "Δ°C": "K", "°C": "degC", "°": "deg", "Ω": "ohm"}
    parts = []
    for name, power in powers.items():
        name = names.get(name, name)
        power = float(power)
        exponent = int(power) if power == int(power) else power
        parts.append(name if exponent == 1 else f"{name}^{exponent}")
    return "*".join(parts) or "1"


def pint_unit(value: Any) -> str:
    """The unit of a quantity of ``pint``."""
    registry = value._REGISTRY
    items = dict(value.unit_items())
    return _product({f"{registry.Unit(name):~P}": power for name, power in items.items()})


def astropy_unit(value: Any) -> tuple[float, str]:
    """A factor and the unit of a quantity of ``astropy``."""
    unit = value.unit
    powers = {base.name: power for base, power in zip(unit.bases, unit.powers)}
    return float(unit.scale), _product(powers)


def _frozen(value: Any) -> Input:
    """A frozen distribution of ``scipy.stats`` as a distribution of model files."""
    name = value.dist.name
    shapes, loc, scale = value.dist._parse_args(*value.args, **value.kwds)
    loc, scale = float(loc), float(scale)
    own = [float(shape) for shape in shapes]

    def shape(distribution: str, **fields: float) -> Input:
        return Input({"distribution": distribution, **fields})

    if name == "norm":
        return shape("normal", mean=loc, std=scale)
    if name == "uniform":
        return shape("rectangular", lower=loc, upper=loc + scale)
    if name == "triang":
        return shape("triangular", lower=loc, upper=loc + scale, mode=loc + own[0] * scale)
    if name == "arcsine":
        return shape("arcsine", lower=loc, upper=loc + scale)
    if name in ("trapezoid", "trapz") and math.isclose(own[0], 1 - own[1]):
        return shape("trapezoidal", lower=loc, upper=loc + scale, beta=own[1] - own[0])
    if name == "t":
        return shape("t", mean=loc, scale=scale, dof=own[0])
    if name == "expon" and loc == 0:
        return shape("exponential", mean=scale)
    if name == "gamma" and loc == 0:
        return shape("gamma", shape=own[0], rate=1 / scale)
    if name == "lognorm" and loc == 0:
        return shape("lognormal", mean=float(value.mean()), std=float(value.std()))
    if name == "beta":
        return shape("beta", alpha=own[0], beta=own[1], lower=loc, upper=loc + scale)
    if name in ("loguniform", "reciprocal"):
        a, b = (float(end) for end in value.support())
        return shape("log-uniform", lower=a, upper=b)
    # any other one by its quantiles, in the middle of equally probable cells
    count = 10_000
    values = np.asarray(value.ppf((np.arange(count) + 0.5) / count), dtype=float)
    about = f"{count} quantiles of scipy.stats.{name}"
    return Input({"distribution": "samples", "values": values.tolist(), "about": about})


def _normal(x: Any, u: Any, dof: Any = math.inf) -> Input:
    x, u, dof = float(x), float(u), float(dof)
    if u == 0:
        return Input({"distribution": "constant", "value": x})
    spec: dict[str, Any] = {"distribution": "normal", "mean": x, "std": u}
    if math.isfinite(dof):
        spec["dof"] = dof
    return Input(spec)


def as_input(value: Any, name: str = "the input") -> Input:
    """An input from a number of any library.

    Parameters
    ----------
    value : object
        An `Input`, an output of a result, a number, a pair of estimate and standard uncertainty (a
        third entry is their degrees of freedom), a mapping as in a model file, or a number of
        ``uncertainties``, ``GTC``, ``pint``, ``astropy`` or a frozen distribution of ``scipy.stats``.
    name : str
        What messages call it.
    """
    if isinstance(value, Input):
        return value
    if hasattr(value, "_as_input"):
        found = value._as_input()
        assert isinstance(found, Input)
        return found
    if is_ufloat(value):
        return _normal(value.nominal_value, value.std_dev)
    if is_gtc(value):
        return _normal(value.x, value.u, value.df)
    if is_frozen(value):
        return _frozen(value)
    if is_pint(value):
        # a measurement of pint is a quantity of a number of uncertainties
        inner = as_input(value.magnitude, name)
        return Input(inner.spec, pint_unit(value), inner.held)
    if is_astropy(value):
        if not hasattr(value, "distribution"):
            _refuse_columns(value.value, name)
        factor, unit = astropy_unit(value)
        distribution = getattr(value, "distribution", None)
        if distribution is not None:
            drawn = np.asarray(getattr(distribution, "value", distribution), dtype=float)
            return Input({"distribution": "samples", "values": (drawn * factor).tolist()}, unit)
        return Input({"distribution": "constant", "value": float(value.value) * factor}, unit)
    if isinstance(value, Expression):
        raise TypeError(f"{name}: an expression is no input here; give an output of its run, `.run()[\"y\"]`")
    if isinstance(value, Mapping):
        spec = dict(plain(value))
        return Input(spec, spec.pop("unit", None))
    if isinstance(value, str):
        return Input({"distribution": "constant", "value": value})
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return as_input(value.item(), name)
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: True and False are no values of a quantity")
    if isinstance(value, (int, float, np.integer, np.floating)):
        return Input({"distribution": "constant", "value": plain(value)})
    if isinstance(value, tuple) and len(value) in (2, 3):
        for part in value:
            _refuse_columns(part, name)
        if is_pint(value[0]):
            if not is_pint(value[1]):
                raise TypeError(f"`{name}`: the estimate has a unit and the standard uncertainty has none; give it one")
            x, u = value[0], value[1].to(value[0].units)
            return Input(_normal(x.magnitude, u.magnitude, *value[2:]).spec, pint_unit(x))
        return _normal(*value)
    _refuse_columns(value, name)
    raise TypeError(
        f"{name}: {type(value).__name__} says nothing about a quantity; a number, a pair (estimate, "
        "standard uncertainty), gumption.normal(...), gumption.readings([...]) or the like is needed"
    )


def _refuse_columns(value: Any, name: str) -> None:
    """Raises an error for an array where one quantity is meant."""
    value = _inner(value)
    if (isinstance(value, list) or hasattr(value, "__array__")) and np.ndim(value):
        raise TypeError(
            f"{name}: a {type(value).__name__} of numbers is not one quantity: for a budget of each of them "
            f"call gumption.budgets(model, {name}=...), and readings of one quantity are "
            "gumption.readings(...)"
        )


def is_linked(value: Any) -> bool:
    """Whether it tells its correlations with others: a number of ``uncertainties`` or ``GTC``, or an input of
    which some are declared."""
    if isinstance(value, Input):
        return bool(value.links)
    inner = _inner(value)
    return is_ufloat(inner) or is_gtc(inner)


def as_known(value: Any, name: str) -> Any:
    """A value that tracks its correlations: an `Input`, an output of a result, an expression, or a number of
    ``uncertainties`` or ``GTC``."""
    if isinstance(value, Quantity) and value._is_complex or is_gtc(value) and isinstance(value.x, complex):
        raise TypeError(f"`{name}` is complex, and an argument is a real quantity; give its parts, `.real` and `.imag`")
    if isinstance(value, Expression) or hasattr(value, "_as_input") or is_linked(value):
        return value
    return as_input(value, name)


def as_alone(value: Any, name: str) -> Input:
    """An input; for an output of a result from its estimate and standard uncertainty."""
    if not isinstance(value, Expression) and not hasattr(value, "_as_input"):
        return as_input(value, name)
    estimate, u = value.estimate, value.u
    found = _normal(estimate, u if math.isfinite(u) else 0.0)
    return Input(found.spec, value.unit)


def unit_of(value: Any) -> str | None:
    """The unit stored with a value."""
    if isinstance(value, Quantity) or hasattr(value, "_as_input"):
        unit = value.unit
        assert unit is None or isinstance(unit, str)
        return unit
    return pint_unit(value) if is_pint(value) else None


def _inner(value: Any) -> Any:
    return value.magnitude if is_pint(value) else value


def shared(values: Mapping[str, Any]) -> list[tuple[str, str, float]]:
    """Correlation coefficients of numbers that depend on the same variables, and of linked inputs."""
    found: list[tuple[str, str, float]] = []
    inputs = {value.identity: name for name, value in values.items() if isinstance(value, Input)}
    declared: dict[tuple[str, str], float] = {}
    for name, value in values.items():
        for other, r in value.links.items() if isinstance(value, Input) else ():
            if other not in inputs:
                continue
            first, second = sorted((name, inputs[other]))
            if declared.setdefault((first, second), r) != r:
                raise _gumption.ModelError(
                    f"two correlation coefficients are declared of `{first}` and `{second}`, "
                    f"{declared[first, second]:g} and {r:g}"
                )
    found += [(*pair, r) for pair, r in declared.items()]
    named = [(name, _inner(value)) for name, value in values.items() if not isinstance(value, Input)]
    floats = [(name, value) for name, value in named if is_ufloat(value) and value.std_dev > 0]
    if len(floats) > 1:
        from uncertainties import correlation_matrix

        matrix = correlation_matrix([value for _, value in floats])
        found += _pairs([name for name, _ in floats], matrix)
    reals = [(name, value) for name, value in named if is_gtc(value) and value.u > 0]
    if len(reals) > 1:
        import GTC

        rows = [[GTC.get_correlation(a, b) for _, b in reals] for _, a in reals]
        found += _pairs([name for name, _ in reals], rows)
    return found


def _pairs(names: Sequence[str], matrix: Any) -> list[tuple[str, str, float]]:
    found = []
    for i, first in enumerate(names):
        for j in range(i + 1, len(names)):
            # rounding leaves traces where nothing is shared
            r = float(np.clip(matrix[i][j], -1.0, 1.0))
            if abs(r) > 1e-12:
                found.append((first, names[j], r))
    return found
