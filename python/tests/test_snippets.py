"""Snippets of the documentation of uncertainties, GTC and MetroloPy, as they are there and with gumption.

Both give the same estimates and standard uncertainties (and what else the snippet shows), and ours has at
most as many lines. All of it is the law of propagation of first order, so the tolerance is rounding, some
hundred times 2^-52; MetroloPy takes derivatives by differences of the size 1e-6, whose error is below 1e-5.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest

import gumption as gu

Snippet = Callable[[], Any]

_THEIRS: dict[str, Snippet] = {}
_OURS: dict[str, Snippet] = {}


def theirs(function: Snippet) -> Snippet:
    _THEIRS[function.__name__] = function
    return function


def ours(function: Snippet) -> Snippet:
    _OURS[function.__name__] = function
    return function


def figures(found: Any) -> list[float]:
    """The estimates and standard uncertainties in what a snippet gives."""
    if isinstance(found, complex):
        return [found.real, found.imag]
    if isinstance(found, (bool, int, float, np.number)):
        return [float(found)]
    if isinstance(found, np.ndarray) and found.dtype != object:
        return [float(value) for value in found.ravel()]
    if isinstance(found, gu.Quantity):
        return [*figures(found.estimate), *figures(found.u)]
    if isinstance(found, Iterable):
        return [figure for one in found for figure in figures(one)]
    root = type(found).__module__.partition(".")[0]
    if root == "uncertainties":
        return [found.nominal_value, found.std_dev]
    if root == "GTC":
        x, u = found.x, found.u
        return [*figures(x), *(figures([u.real, u.imag]) if isinstance(x, complex) else [u])]
    assert root == "metrolopy", type(found)
    return [float(found.x), float(found.u)]


def lines(function: Snippet) -> int:
    """The lines of the body of a function, imports and comments left out."""
    body = inspect.getsource(function).splitlines()[2:]
    kept = [line.strip() for line in body if line.strip() and not line.strip().startswith(("#", "from ", "import "))]
    return len(kept)


# uncertainties: README and user guide


@theirs
def square() -> Any:
    from uncertainties import ufloat

    x = ufloat(0.20, 0.01)
    return x**2


@ours
def square() -> Any:  # noqa: F811
    x = gu.normal(0.20, 0.01)
    return x**2


@theirs
def square_less_itself() -> Any:
    from uncertainties import ufloat

    x = ufloat(0.20, 0.01)
    y = x**2
    return y - x * x


@ours
def square_less_itself() -> Any:  # noqa: F811
    x = gu.normal(0.20, 0.01)
    y = x**2
    return y - x * x


@theirs
def sine_of_square() -> Any:
    from uncertainties import ufloat, umath

    x = ufloat(0.20, 0.01)
    return umath.sin(1 + x**2)


@ours
def sine_of_square() -> Any:  # noqa: F811
    x = gu.normal(0.20, 0.01)
    return np.sin(1 + x**2)


@theirs
def derivatives() -> Any:
    from uncertainties import ufloat

    u = ufloat(1, 0.1)
    v = ufloat(10, 0.1)
    total = 2 * u + v**2
    return [total.derivatives[u], total.derivatives[v]]


@ours
def derivatives() -> Any:  # noqa: F811
    u = gu.normal(1, 0.1)
    v = gu.normal(10, 0.1)
    total = 2 * u + v**2
    return total.budget.sensitivity


@theirs
def error_components() -> Any:
    from uncertainties import ufloat

    u = ufloat(1, 0.05, "u variable")
    v = ufloat(10, 0.1, "v variable")
    sum_value = u + 2 * v
    parts = sum_value.error_components()
    return [parts[u], parts[v]]


@ours
def error_components() -> Any:  # noqa: F811
    u = gu.normal(1, 0.05, name="u_variable")
    v = gu.normal(10, 0.1, name="v_variable")
    sum_value = u + 2 * v
    return sum_value.budget.contribution


@theirs
def correlated_values() -> Any:
    from uncertainties import correlated_values

    cov_matrix = [[0.01, 0.006], [0.006, 0.04]]
    u, v = correlated_values([1, 10], cov_matrix)
    return u + 2 * v


@ours
def correlated_values() -> Any:  # noqa: F811
    cov_matrix = [[0.01, 0.006], [0.006, 0.04]]
    u, v = gu.array([1, 10], covariance=cov_matrix)
    return u + 2 * v


@theirs
def covariance_matrix() -> Any:
    from uncertainties import covariance_matrix, ufloat

    u, v = ufloat(1, 0.1), ufloat(10, 0.1)
    sum_value = u + 2 * v
    return np.array(covariance_matrix([u, v, sum_value]))


@ours
def covariance_matrix() -> Any:  # noqa: F811
    u, v = gu.normal(1, 0.1), gu.normal(10, 0.1)
    sum_value = u + 2 * v
    return gu.array([u, v, sum_value]).covariance


@theirs
def correlation_matrix() -> Any:
    from uncertainties import correlation_matrix, ufloat

    u, v = ufloat(1, 0.1), ufloat(10, 0.1)
    sum_value = u + 2 * v
    return np.array(correlation_matrix([u, v, sum_value]))


@ours
def correlation_matrix() -> Any:  # noqa: F811
    u, v = gu.normal(1, 0.1), gu.normal(10, 0.1)
    sum_value = u + 2 * v
    return gu.array([u, v, sum_value]).correlation


@theirs
def array_times_two() -> Any:
    from uncertainties import unumpy

    arr = unumpy.uarray([1, 2], [0.01, 0.002])
    return 2 * arr


@ours
def array_times_two() -> Any:  # noqa: F811
    arr = gu.array([1, 2], [0.01, 0.002])
    return 2 * arr


@theirs
def cosine_of_array() -> Any:
    from uncertainties import unumpy

    arr = unumpy.uarray([1, 2], [0.01, 0.002])
    return [unumpy.cos(arr), arr.sum(), arr.mean()]


@ours
def cosine_of_array() -> Any:  # noqa: F811
    arr = gu.array([1, 2], [0.01, 0.002])
    return [np.cos(arr), arr.sum(), arr.mean()]


@theirs
def nominal_values() -> Any:
    from uncertainties import unumpy

    arr = unumpy.uarray([1, 2], [0.01, 0.002])
    return [unumpy.nominal_values(arr), unumpy.std_devs(arr)]


@ours
def nominal_values() -> Any:  # noqa: F811
    arr = gu.array([1, 2], [0.01, 0.002])
    return [arr.estimate, arr.u]


@theirs
def inverse_matrix() -> Any:
    from uncertainties import ufloat, unumpy

    mat = unumpy.matrix([[ufloat(1, 0.01), ufloat(2, 0.02)], [ufloat(3, 0.01), ufloat(4, 0.1)]])
    return np.asarray(unumpy.ulinalg.inv(mat))


@ours
def inverse_matrix() -> Any:  # noqa: F811
    mat = gu.array([[1, 2], [3, 4]], [[0.01, 0.02], [0.01, 0.1]])
    return np.linalg.inv(mat)


# GTC: tutorial and examples


@theirs
def resistance() -> Any:
    from GTC import ureal

    V = ureal(0.1, 1e-3)
    I = ureal(15e-3, 0.5e-3)
    return V / I


@ours
def resistance() -> Any:  # noqa: F811
    V = gu.normal(0.1, 1e-3, "V")
    I = gu.normal(15e-3, 0.5e-3, "A")
    return V / I


@theirs
def components() -> Any:
    from GTC import component, ureal

    V = ureal(0.1, 1e-3, label="V")
    I = ureal(15e-3, 0.5e-3, label="I")
    R = V / I
    return [component(R, V), component(R, I)]


@ours
def components() -> Any:  # noqa: F811
    V = gu.normal(0.1, 1e-3, name="V")
    I = gu.normal(15e-3, 0.5e-3, name="I")
    R = V / I
    return R.budget.contribution


@theirs
def flag_pole() -> Any:
    from GTC import tan, ureal

    B = ureal(15, 3e-2)
    Phi = ureal(math.radians(38), math.radians(2))
    return B * tan(Phi)


@ours
def flag_pole() -> Any:  # noqa: F811
    B = gu.normal(15, 3e-2, "m")
    Phi = gu.normal(38, 2, "deg")
    return B * np.tan(Phi)


@theirs
def degrees_of_freedom() -> Any:
    from GTC import dof, ureal

    x = ureal(1.1, 0.2, df=5)
    y = ureal(2.3, 0.3, df=9)
    z = x * y
    return [z, dof(z)]


@ours
def degrees_of_freedom() -> Any:  # noqa: F811
    x = gu.normal(1.1, 0.2, dof=5)
    y = gu.normal(2.3, 0.3, dof=9)
    z = x * y
    return [z, z.dof]


@theirs
def set_correlation() -> Any:
    from GTC import set_correlation, ureal

    x1 = ureal(2, 1, independent=False)
    x2 = ureal(5, 1, independent=False)
    set_correlation(0.3, x1, x2)
    return x1 * x2


@ours
def set_correlation() -> Any:  # noqa: F811
    x1 = gu.normal(2, 1)
    x2 = gu.normal(5, 1)
    x1, x2 = gu.correlated([x1, x2], [[1, 0.3], [0.3, 1]])
    return x1 * x2


@theirs
def get_correlation() -> Any:
    from GTC import get_correlation, ureal

    x = ureal(1, 0.1)
    y = ureal(2, 0.2)
    return get_correlation(x + y, x - y)


@ours
def get_correlation() -> Any:  # noqa: F811
    x = gu.normal(1, 0.1)
    y = gu.normal(2, 0.2)
    return gu.array([x + y, x - y]).correlation[0, 1]


@theirs
def type_a() -> Any:
    from GTC import type_a

    data = [5.007, 4.994, 5.005, 4.990, 4.999]
    x = type_a.estimate(data)
    return [x, x.df]


@ours
def type_a() -> Any:  # noqa: F811
    data = [5.007, 4.994, 5.005, 4.990, 4.999]
    x = gu.readings(data)
    return [x, x.dof]


@theirs
def type_b() -> Any:
    from GTC import type_b, ureal

    a = ureal(1, type_b.uniform(1))
    b = ureal(2, type_b.triangular(1))
    c = ureal(3, type_b.arcsine(1))
    return a * b * c


@ours
def type_b() -> Any:  # noqa: F811
    a = gu.rectangular(1, 1)
    b = gu.triangular(2, 1)
    c = gu.arcsine(3, 1)
    return a * b * c


@theirs
def gum_h2() -> Any:
    """JCGM 100, H.2: resistance, reactance and impedance of five sets of simultaneous readings."""
    from GTC import cos, sin, type_a

    V = [5.007, 4.994, 5.005, 4.990, 4.999]
    I = [19.663e-3, 19.639e-3, 19.640e-3, 19.685e-3, 19.678e-3]
    phi = [1.0456, 1.0438, 1.0468, 1.0428, 1.0433]
    v, i, p = type_a.multi_estimate_real((V, I, phi))
    return [v / i * cos(p), v / i * sin(p), v / i]


@ours
def gum_h2() -> Any:  # noqa: F811
    """JCGM 100, H.2: resistance, reactance and impedance of five sets of simultaneous readings."""
    V = [5.007, 4.994, 5.005, 4.990, 4.999]
    I = [19.663e-3, 19.639e-3, 19.640e-3, 19.685e-3, 19.678e-3]
    phi = [1.0456, 1.0438, 1.0468, 1.0428, 1.0433]
    v, i, p = gu.correlated([gu.readings(data) for data in (V, I, phi)], np.corrcoef([V, I, phi]))
    return [v / i * np.cos(p), v / i * np.sin(p), v / i]


@theirs
def complex_magnitude() -> Any:
    from GTC import magnitude, phase, ucomplex

    z = ucomplex(1 + 2j, (0.1, 0.2))
    return [magnitude(z), phase(z)]


@ours
def complex_magnitude() -> Any:  # noqa: F811
    z = gu.complex_normal(1 + 2j, (0.1, 0.2))
    return [abs(z), np.angle(z)]


@theirs
def complex_product() -> Any:
    from GTC import exp, ucomplex

    z = ucomplex(0.5 - 0.25j, (0.01, 0.01))
    w = ucomplex(-0.1 + 1j, (0.02, 0.03))
    return [z * w, z / w, exp(z)]


@ours
def complex_product() -> Any:  # noqa: F811
    z = gu.complex_normal(0.5 - 0.25j, (0.01, 0.01))
    w = gu.complex_normal(-0.1 + 1j, (0.02, 0.03))
    return [z * w, z / w, np.exp(z)]


@theirs
def linear_equations() -> Any:
    from GTC import la, ureal

    a = la.uarray([[ureal(2, 0.1), ureal(1, 0.1)], [ureal(1, 0.1), ureal(3, 0.1)]])
    b = la.uarray([ureal(1, 0.05), ureal(2, 0.05)])
    return list(la.solve(a, b))


@ours
def linear_equations() -> Any:  # noqa: F811
    a = gu.array([[2, 1], [1, 3]], 0.1)
    b = gu.array([1, 2], 0.05)
    return np.linalg.solve(a, b)


# MetroloPy: README and tutorial


@theirs
def metrolopy_pressure() -> Any:
    import metrolopy as uc

    a = uc.gummy(1.2345, u=0.0234, unit="cm")
    b = uc.gummy(3.034, u=0.174, unit="mm")
    f = uc.gummy(uc.UniformDist(center=0.9345, half_width=0.096), unit="N")
    p = f / (a * b)
    p.unit = "kPa"
    return p


@ours
def metrolopy_pressure() -> Any:  # noqa: F811
    a = gu.normal(1.2345, 0.0234, "cm")
    b = gu.normal(3.034, 0.174, "mm")
    f = gu.rectangular(0.9345, 0.096, "N")
    p = f / (a * b)
    return p.to("kPa")


@theirs
def metrolopy_coverage_factor() -> Any:
    import metrolopy as uc

    g = uc.gummy(10, u=0.4, k=2)
    return g * 3


@ours
def metrolopy_coverage_factor() -> Any:  # noqa: F811
    g = gu.normal(10, expanded=0.4, k=2)
    return g * 3


@theirs
def metrolopy_probability() -> Any:
    import metrolopy as uc

    g = uc.gummy(10, u=0.4, p=0.95)
    return g / 2


@ours
def metrolopy_probability() -> Any:  # noqa: F811
    g = gu.normal(10, expanded=0.4, p=0.95)
    return g / 2


@theirs
def metrolopy_conversion() -> Any:
    import metrolopy as uc

    g = uc.gummy(3.3, u=1.3, unit="m")
    return g.convert("cm")


@ours
def metrolopy_conversion() -> Any:  # noqa: F811
    g = gu.normal(3.3, 1.3, "m")
    return g.to("cm")


@theirs
def metrolopy_functions() -> Any:
    import metrolopy as uc

    x = uc.gummy(0.678, u=0.077)
    y = uc.gummy(2.5, u=0.02)
    return uc.sin(x) * y**2.5


@ours
def metrolopy_functions() -> Any:  # noqa: F811
    x = gu.normal(0.678, 0.077)
    y = gu.normal(2.5, 0.02)
    return np.sin(x) * y**2.5


@theirs
def metrolopy_correlation() -> Any:
    import metrolopy as uc

    a = uc.gummy(1.2, u=0.2)
    b = uc.gummy(3.2, u=0.5)
    return uc.gummy.correlation_matrix([a, b, a + b])[0][2]


@ours
def metrolopy_correlation() -> Any:  # noqa: F811
    a = gu.normal(1.2, 0.2)
    b = gu.normal(3.2, 0.5)
    return gu.array([a, b, a + b]).correlation[0, 2]


def test_there_are_thirty() -> None:
    assert len(_THEIRS) >= 30
    assert _THEIRS.keys() == _OURS.keys()


@pytest.mark.parametrize("name", sorted(_THEIRS))
def test_snippet(name: str) -> None:
    package = inspect.getsource(_THEIRS[name])
    pytest.importorskip(next(p for p in ("uncertainties", "GTC", "metrolopy") if p in package))
    known = figures(_THEIRS[name]())
    found = figures(_OURS[name]())
    assert found == pytest.approx(known, rel=1e-5 if "metrolopy" in name else 1e-13, abs=1e-13)
    assert lines(_OURS[name]) <= lines(_THEIRS[name])
