"""Two hundred ways to write a function, each held against the function itself, one draw at a time.

The value of every trial is compared with what plain Python gives for that trial's draws. A function may
be evaluated by its formulas, by columns of draws, or one draw at a time, or be refused; what may not be
is that it is wrong and nothing is said.
"""

from __future__ import annotations

import bisect
import cmath
import collections
import dataclasses
import decimal
import fractions
import functools
import itertools
import math
import operator
import random
import statistics
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import gumption as gu

try:
    import scipy
    import scipy.integrate
    import scipy.interpolate
    import scipy.linalg
    import scipy.optimize
    import scipy.special
    import scipy.stats
except ImportError:
    scipy = None  # type: ignore[assignment]

Function = Callable[[Any, Any], Any]

KNOWN = {"a": gu.normal(0.7, 0.05), "b": gu.rectangular(1.3, 0.2)}
TRIALS = 1000
#: How many trials of each are compared.
COMPARED = 100

TABLE_X, TABLE_Y = np.linspace(0, 3, 13), np.linspace(0, 3, 13) ** 2 / 3
FACTOR = 1.5
FACTORS = {"a": 2.0, "b": 3.0}
MATRIX = np.array([[2.0, 0.5], [0.5, 1.0]])


def refined(start: Any, step: Callable[[Any], Any]) -> Any:
    for _ in range(5):
        start = step(start)
    return start


class Plate:
    """A quantity with methods."""

    def __init__(self, width: Any, height: Any) -> None:
        self.width, self.height = width, height

    @property
    def area(self) -> Any:
        return self.width * self.height

    def __add__(self, other: Plate) -> Any:
        return self.area + other.area


@dataclasses.dataclass
class Pair:
    first: Any
    second: Any


Point = collections.namedtuple("Point", "x y")


def scaled(factor: float) -> Function:
    def inner(a: Any, b: Any) -> Any:
        return factor * a + b

    return inner


def default(a: Any, b: Any, c: float = 2.0) -> Any:
    return a * c + b


def keywords(*, a: Any, b: Any) -> Any:
    return a - b


def positional(a: Any, b: Any, /) -> Any:
    return a / b


def horner(x: Any, *coefficients: float) -> Any:
    return functools.reduce(lambda total, c: total * x + c, coefficients)


def accumulated(a: Any, b: Any) -> Any:
    total = 0
    for k in range(1, 8):
        total += a**k / k
    return total + b


def generator(a: Any, b: Any) -> Any:
    return sum(a * k for k in range(4)) + b


def walrus(a: Any, b: Any) -> Any:
    return (s := a + b) * s


def local_import(a: Any, b: Any) -> Any:
    import numpy

    return numpy.sqrt(a * a + b * b)


def unpacked(a: Any, b: Any) -> Any:
    first, *rest = [a, b, a * b]
    return first + rest[-1]


def recursion(a: Any, b: Any, depth: int = 6) -> Any:
    return a if depth == 0 else a + b * recursion(a, b, depth - 1) / 10


def in_try(a: Any, b: Any) -> Any:
    try:
        return a / b
    finally:
        pass


def has_length(a: Any, b: Any) -> Any:
    return np.asarray(a).size * a + b


def shifted_in_place(a: Any, b: Any) -> Any:
    a = np.asarray(a)
    np.add(a, 1.0, out=a)
    return a + b


#: What formulas say.
FORMULAS: dict[str, Function] = {
    "np.abs of a complex number": lambda a, b: np.abs(a + 1j * b),
    "np.angle": lambda a, b: np.angle(a + 1j * b),
    "np.exp of a complex number": lambda a, b: np.exp(1j * a).real + b,
    "np.sqrt of a complex number": lambda a, b: np.sqrt(a - b + 0j).imag,
    "sum": lambda a, b: a + b,
    "powers": lambda a, b: a**2 + b**3 - a**-1,
    "root": lambda a, b: (a * b) ** 0.5,
    "signs": lambda a, b: -a + +b - (-b),
    "modulo": lambda a, b: (10 * a) % b,
    "abs": lambda a, b: abs(a - b),
    "exp and log": lambda a, b: np.exp(a) + np.log(b) + np.log10(b) + np.log2(b) + np.log1p(a),
    "trigonometry": lambda a, b: np.sin(a) + np.cos(b) + np.tan(a) + np.arctan2(a, b),
    "hyperbolic": lambda a, b: np.sinh(a) + np.cosh(b) + np.tanh(a) + np.arcsinh(b),
    "inverse trigonometry": lambda a, b: np.arcsin(a) + np.arccos(a) + np.arctan(b),
    "np.hypot": lambda a, b: np.hypot(a, b),
    "np.power": lambda a, b: np.power(a, b),
    "np.square": lambda a, b: np.square(a) + np.reciprocal(b) + np.negative(a) + np.positive(b),
    "np.add": lambda a, b: np.add(a, b) * np.subtract(a, b) / np.multiply(a, b),
    "np.maximum": lambda a, b: np.maximum(a, b) + np.minimum(a, 0.7) + np.fmax(b, 1.3),
    "np.where": lambda a, b: np.where(a > 0.7, a, b),
    "np.where nested": lambda a, b: np.where(a > 0.7, np.where(b > 1.3, 1.0, a), b),
    "comparison as number": lambda a, b: (a > 0.7) + b,
    "np.clip": lambda a, b: np.clip(a, 0.65, 0.75) + b,
    "np.floor": lambda a, b: np.floor(10 * a) + np.ceil(10 * b),
    "np.sqrt of an array": lambda a, b: np.sqrt(np.array([a, b])).sum(),
    "np.sum of a list": lambda a, b: np.sum([a, b, a * b]),
    "np.mean of a list": lambda a, b: np.mean([a, b]),
    "np.prod of a list": lambda a, b: np.prod([a, b]),
    "np.dot": lambda a, b: np.dot(np.array([a, b]), np.array([1.0, 2.0])),
    "np.cumsum": lambda a, b: np.cumsum([a, b])[1],
    "np.diff": lambda a, b: np.diff(np.array([a, b]))[0],
    "matrix product": lambda a, b: (MATRIX @ np.array([a, b])) @ np.array([a, b]),
    "np.outer": lambda a, b: np.outer([a, b], [a, b])[0, 1],
    "np.trace": lambda a, b: np.trace(np.array([[a, b], [b, a]])),
    "np.deg2rad of a number": lambda a, b: np.sin(np.deg2rad(90 * a)) + b,
    "np.cbrt": lambda a, b: np.cbrt(a) + np.exp2(b) + np.expm1(a),
    "np.float64": lambda a, b: np.float64(2.5) * a + b,
    "array constant": lambda a, b: np.asarray(3.0) * a + b,
    "builtin sum": lambda a, b: sum([a, b]),
    "math.prod": lambda a, b: math.prod([a, b]),
    "constants": lambda a, b: math.pi * a + math.e * b + 1e-3,
    "fraction of constants": lambda a, b: a * float(fractions.Fraction(1, 3)) + b,
    "loop": accumulated,
    "generator": generator,
    "comprehension": lambda a, b: sum([x**2 for x in (a, b)]),
    "zip": lambda a, b: sum(x * y for x, y in zip((a, b), (2, 3))),
    "enumerate": lambda a, b: sum(i * x for i, x in enumerate((a, b))),
    "map": lambda a, b: sum(map(lambda x: x * x, (a, b))),
    "reduce": lambda a, b: functools.reduce(operator.mul, [a, b, 2.0]),
    "accumulate": lambda a, b: list(itertools.accumulate([a, b, a]))[-1],
    "horner": lambda a, b: horner(a, 1.0, 2.0, 3.0) + b,
    "closure": scaled(3.0),
    "global": lambda a, b: FACTOR * a + b,
    "dictionary of constants": lambda a, b: FACTORS["a"] * a + FACTORS["b"] * b,
    "dictionary": lambda a, b: {"x": a, "y": b}["x"] * 2 + b,
    "list": lambda a, b: [a, b][1] - [a, b][0],
    "tuple": lambda a, b: (a, b)[0] ** 2 + b,
    "namedtuple": lambda a, b: Point(a, b).x + Point(a, b).y,
    "dataclass": lambda a, b: Pair(a, b).first * Pair(a, b).second,
    "class": lambda a, b: Plate(a, b).area,
    "operator of a class": lambda a, b: Plate(a, b) + Plate(b, 2.0),
    "unpacking": unpacked,
    "recursion": recursion,
    "refinement": lambda a, b: refined(b, lambda x: (x + a / x) / 2),
    "walrus": walrus,
    "default argument": default,
    "keyword arguments": keywords,
    "positional arguments": positional,
    "partial": functools.partial(default, c=4.0),
    "local import": local_import,
    "operator module": lambda a, b: operator.add(a, operator.mul(a, b)),
    "finally": in_try,
    "augmented assignment": lambda a, b: (lambda x: operator.iadd(x, b))(a),
    "one output as array": lambda a, b: np.array(a) * 2 + b,
    "np.real": lambda a, b: np.real(a) + np.conjugate(b),
    "real": lambda a, b: np.array([a, b]).real[0] + b,
    "conditional on a constant": lambda a, b: a if FACTOR > 1 else b,
    "string format of a constant": lambda a, b: a * float(f"{FACTOR:.3f}") + b,
    "unused": lambda a, b: 2 * a,
    "np.linalg.norm over an axis": lambda a, b: np.linalg.norm(np.array([a, b]), axis=0),
    "np.einsum": lambda a, b: np.einsum("i...,i...->...", np.array([a, b]), np.array([b, a])),
    "np.linalg.norm": lambda a, b: np.linalg.norm([a, b]),
    "np.size": has_length,
    "out": shifted_in_place,
    "np.std": lambda a, b: np.std([a, b]),
    "np.var": lambda a, b: np.var([a, b, 1.0], ddof=1),
    "getattr with a default": lambda a, b: a * 2 if getattr(a, "shape", ()) == () else b,
    "constant": lambda a, b: 4.25,
}


def masked(a: Any, b: Any) -> Any:
    out = np.array(a * 1.0)
    out[out > 0.7] = 0.7
    return out + b


def with_error_state(a: Any, b: Any) -> Any:
    with np.errstate(divide="ignore"):
        return np.sign(a - 0.7) * b


#: What columns of draws can be given to, though no formula says it.
COLUMNS: dict[str, Function] = {
    "np.stack": lambda a, b: np.stack([a, b])[1] * 2,
    "np.polyval": lambda a, b: np.polyval([1.0, 2.0, 3.0], a) + b,
    "equality": lambda a, b: (a == b) * 1.0 + a,
    "floor division": lambda a, b: 10 * a // b,
    "divmod": lambda a, b: divmod(10 * a, b)[1],
    "np.sign": lambda a, b: np.sign(a - 0.7) * b,
    "np.interp": lambda a, b: np.interp(a, TABLE_X, TABLE_Y) * b,
    "np.piecewise": lambda a, b: np.piecewise(np.asarray(a), [np.asarray(a) > 0.7], [1.0, 2.0]) + b,
    "np.select": lambda a, b: np.select([a < 0.65, a < 0.75], [a, b], 0.0),
    "np.round": lambda a, b: np.round(a, 2) + b,
    "np.rint": lambda a, b: np.rint(10 * a) + b,
    "np.trunc": lambda a, b: np.trunc(10 * a) + b,
    "np.searchsorted": lambda a, b: np.searchsorted(TABLE_X, a) + b,
    "np.digitize": lambda a, b: np.digitize(a, TABLE_X) + b,
    "np.floor_divide": lambda a, b: np.floor_divide(10 * a, b),
    "np.isnan": lambda a, b: np.where(np.isnan(a), 0.0, a) + b,
    "np.logical_and": lambda a, b: np.logical_and(a > 0.7, b > 1.3) * a,
    "np.heaviside": lambda a, b: np.heaviside(a - 0.7, 0.5) + b,
    "np.sinc": lambda a, b: np.sinc(a) + b,
    "np.copysign": lambda a, b: np.copysign(b, a - 0.7),
    "np.nan_to_num": lambda a, b: np.nan_to_num(a) + b,
    "np.vectorize": lambda a, b: np.vectorize(lambda x, y: x if x > 0.7 else y)(a, b),
    "np.frompyfunc": lambda a, b: np.asarray(np.frompyfunc(math.sin, 1, 1)(a), float) + b,
    "np.frexp": lambda a, b: np.frexp(a)[0] + b,
    "np.modf": lambda a, b: np.modf(10 * a)[0] + b,
    "np.divmod": lambda a, b: np.divmod(10 * a, b)[1],
    "np.logaddexp": lambda a, b: np.logaddexp(a, b),
    "mask of a copy": masked,
    "np.errstate": with_error_state,
    "np.max over an axis": lambda a, b: np.max([a, b], axis=0),
    "np.median over an axis": lambda a, b: np.median([a, b, a * b], axis=0),
    "np.sort over an axis": lambda a, b: np.sort(np.array([a, b]), axis=0)[0],
    "np.float_power of int": lambda a, b: np.asarray(a, dtype=np.float64) ** 2 + b,
    "np.bitwise": lambda a, b: ((a > 0.7) | (b > 1.3)) * 1.0,
    "np.arctan of a ratio": lambda a, b: np.arctan(np.divide(a, b)) + np.sign(b),
    "np.ma": lambda a, b: np.ma.masked_less(a, -1.0) * b,
    "np.nextafter": lambda a, b: np.nextafter(a, 2.0) + b,
}


def while_loop(a: Any, b: Any) -> Any:
    total = 0.0
    while total < a:
        total += 0.1
    return total + b


def bisected(a: Any, b: Any) -> Any:
    low, high = 0.0, 3.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if middle**2 < a * b else (low, middle)
    return low


def newton(a: Any, b: Any) -> Any:
    x = b
    while abs(x * x - a) > 1e-12:
        x = (x + a / x) / 2
    return x


def caught_type(a: Any, b: Any) -> Any:
    try:
        return math.sin(a) + b
    except TypeError:
        return 0.5 * a + b


def caught_all(a: Any, b: Any) -> Any:
    try:
        return a * b if a > 0.7 else a + b
    except Exception:
        return 100.0 * a


def caught_bare(a: Any, b: Any) -> Any:
    try:
        value = float(a)
    except:  # noqa: E722
        value = 0.0 * a
    return value + b


def caught_value(a: Any, b: Any) -> Any:
    try:
        return np.asarray(a, dtype=float)[()] * 2 + (1.0 if a > 0.7 else 0.0)
    except ValueError:
        return 7.0 * b


def caught_attribute(a: Any, b: Any) -> Any:
    try:
        return a.is_integer() + b
    except AttributeError:
        return 9.0 * a


def suppressed(a: Any, b: Any) -> Any:
    import contextlib

    found = 3.0 * a
    with contextlib.suppress(Exception):
        found = round(a, 1) + b
    return found


def by_type(a: Any, b: Any) -> Any:
    return a * 2 if type(a) in (int, float) else a * 3


def by_shape(a: Any, b: Any) -> Any:
    return a * 2 if np.shape(a) == () else a.mean() + b


def any_of_them(a: Any, b: Any) -> Any:
    return a * 2 if np.any(np.asarray(a > 0.7)) else a + b


def loop_over_it(a: Any, b: Any) -> Any:
    return sum(x for x in np.atleast_1d(a)) + b


def changed_in_place(a: Any, b: Any) -> Any:
    a *= 2
    return a + b + (1.0 if a > 1.4 else 0.0)


def assigned_in_place(a: Any, b: Any) -> Any:
    a[a > 0.7] = 0.7
    return a + b


def ode(a: Any, b: Any) -> Any:
    solved = scipy.integrate.solve_ivp(lambda t, y: -a * y, (0, 1), [1.0], rtol=1e-6)
    return solved.y[0, -1] * b


#: What needs one draw at a time: the first ones were wrong without a word when they were called with
#: columns, or when what was traced was believed.
DRAWS: dict[str, Function] = {
    "np.max": lambda a, b: np.max([a, b, 1.2]),
    "np.min of an array": lambda a, b: np.array([a, b]).min(),
    "np.array.max": lambda a, b: np.array([a, b]).max() + a,
    "np.median": lambda a, b: np.median([a, b, 1.0]),
    "np.ptp": lambda a, b: np.ptp([a, b]),
    "np.percentile": lambda a, b: np.percentile([a, b, 2.0], 30),
    "np.sort": lambda a, b: np.sort([a, b, 1.2])[0],
    "np.fft": lambda a, b: np.fft.fft([a, b, a, 2.0])[1].real,
    "np.unwrap": lambda a, b: np.unwrap(np.array([a, b + 6.0]))[1],
    "np.linspace": lambda a, b: np.sum(np.linspace(0, a, 11) ** 2) + b,
    "np.linalg.det": lambda a, b: np.linalg.det(np.array([[a, b], [b, 1.0]])),
    "np.linalg.inv": lambda a, b: np.linalg.inv(np.array([[a, 0.1], [0.1, b]]))[0, 1],
    "np.linalg.solve": lambda a, b: np.linalg.solve(np.array([[2.0, a], [a, 1.0]]), np.array([1.0, b]))[0],
    "np.linalg.eigvalsh": lambda a, b: np.linalg.eigvalsh(np.array([[a, 0.2], [0.2, b]]))[1],
    "np.linalg.lstsq": lambda a, b: np.linalg.lstsq(
        np.array([[1.0, 0], [1, 1], [1, 2]]), np.array([a, b, 2.0]), rcond=None
    )[0][1],
    "np.polyfit": lambda a, b: np.polyfit([0.0, 1.0, 2.0], [a, b, 2.0], 1)[0],
    "np.roots": lambda a, b: np.roots([1.0, -3.0, a])[0].real + b,
    "np.trapezoid": lambda a, b: (np.linspace(0, a, 21) ** 2)[1:].mean() * b,
    "np.arange": lambda a, b: np.arange(0, 5 * a, 0.5).sum() + b,
    "np.argmax": lambda a, b: float(np.argmax([a, b, 1.2])) + a,
    "np.unique": lambda a, b: np.unique([a, b, 1.0])[0],
    "np.histogram": lambda a, b: np.histogram([a, b], bins=[0, 0.7, 1.3, 5])[0][1] + a,
    "np.convolve": lambda a, b: np.convolve([a, b], [1.0, 2.0])[1].max() + np.sort([a, b])[1],
    "np.interp of a table of it": lambda a, b: np.interp(0.5, [0.0, 1.0], [a, b]),
    "np.average": lambda a, b: np.average([a, b], weights=[1.0, abs(a)]) + np.max([a, b]),
    "np.cov": lambda a, b: np.cov([a, b, 1.0], [1.0, 2.0, a])[0, 1],
    "np.corrcoef": lambda a, b: np.corrcoef([a, b, 1.0], [1.0, 2.0, 4.0])[0, 1],
    "np.gradient": lambda a, b: np.gradient(np.array([a, b, 2.0]))[0] + np.ptp([a, b]),
    "np.nanmax": lambda a, b: np.nanmax([a, np.nan, 0.7]) + b,
    "np.meshgrid": lambda a, b: np.meshgrid([0.0, a], [0.0, b])[0].max(),
    "np.any": any_of_them,
    "np.isscalar": lambda a, b: a * 2 if np.isscalar(a) else a * 3,
    "np.ndim": by_shape,
    "loop over an array": loop_over_it,
    "isinstance": lambda a, b: a * 2 if isinstance(a, float) else a * 3,
    "type": by_type,
    "type name": lambda a, b: a * 2 if type(a).__name__ == "float" else b,
    "hasattr": lambda a, b: a * 2 if hasattr(a, "hex") else b,
    "string": lambda a, b: a * 2 if "." in str(a) else b,
    "parsed": lambda a, b: float(str(a)) + b,
    "formatted": lambda a, b: float(f"{a:.2f}") + b,
    "except TypeError": caught_type,
    "except Exception": caught_all,
    "bare except": caught_bare,
    "except ValueError": caught_value,
    "except AttributeError": caught_attribute,
    "suppress": suppressed,
    "in place": changed_in_place,
    "if": lambda a, b: a if a > 0.7 else b,
    "and": lambda a, b: (a > 0.7 and b > 1.3) * 1.0 + a,
    "not": lambda a, b: (not a > 0.7) * 1.0 + b,
    "chained comparison": lambda a, b: (0.65 < a < 0.75) * b,
    "max": lambda a, b: max(a, b - 0.6),
    "min": lambda a, b: min(a, b, 0.7),
    "sorted": lambda a, b: sorted([a, b, 0.7])[1],
    "round": lambda a, b: round(a, 2) + b,
    "int": lambda a, b: int(10 * a) + b,
    "range": lambda a, b: sum(range(int(10 * a))) + b,
    "while": while_loop,
    "bisection": bisected,
    "newton": newton,
    "hash": lambda a, b: (hash(a) % 7) + b,
    "dictionary by value": lambda a, b: {True: a, False: b}[bool(a > 0.7)],
    "index by value": lambda a, b: [0.0, a, b][1 + (a > 0.7)],
    "set": lambda a, b: len({a, b}) + a,
    "match": lambda a, b: {0: a, 1: b}.get(int(a > 0.7)),
    "lru_cache": lambda a, b: functools.lru_cache(lambda x: x * 2)(a) + b,
    "math.sin": lambda a, b: math.sin(a) + b,
    "math.hypot": lambda a, b: math.hypot(a, b),
    "math.sqrt": lambda a, b: math.sqrt(a) * math.exp(b),
    "math.erf": lambda a, b: math.erf(a) + b,
    "math.gamma": lambda a, b: math.gamma(a) + math.lgamma(b),
    "math.fsum": lambda a, b: math.fsum([a, b, 0.1]),
    "math.dist": lambda a, b: math.dist((a, b), (0.0, 0.0)),
    "math.fmod": lambda a, b: math.fmod(10 * a, b),
    "math.floor": lambda a, b: math.floor(10 * a) + b,
    "math.isclose": lambda a, b: math.isclose(a, 0.7, rel_tol=0.05) + b,
    "math.copysign": lambda a, b: math.copysign(b, a - 0.7),
    "cmath": lambda a, b: abs(cmath.exp(1j * a)) * b,
    "complex": lambda a, b: abs(complex(a, b)),
    "complex phase": lambda a, b: cmath.phase(complex(a, b)),
    "complex divided": lambda a, b: (1 / complex(a, b)).real,
    "statistics": lambda a, b: statistics.mean([a, b]) + statistics.stdev([a, b]),
    "statistics.median": lambda a, b: statistics.median([a, b, 1.0]),
    "bisect": lambda a, b: bisect.bisect([0.6, 0.7, 0.8], a) + b,
    "decimal": lambda a, b: decimal.Decimal(a) * 2,
    "fraction": lambda a, b: fractions.Fraction(a) / 3,
    "seeded random": lambda a, b: random.Random(3).random() * float(a) + b,
    "seeded numpy random": lambda a, b: np.random.default_rng(3).normal(a, 0.1, np.shape(a)) + np.max([b]),
    "any": lambda a, b: any([a > 0.75, b > 1.4]) + a,
    "all": lambda a, b: all([a > 0.65, b > 1.2]) + a,
    "filter": lambda a, b: sum(filter(lambda x: x > 0.7, [a, b])),
    "list.sort": lambda a, b: (lambda x: x.sort() or x[0])([a, b, 0.7]),
    "list.index": lambda a, b: [a, b].index(b) + a,
    "heap": lambda a, b: __import__("heapq").nsmallest(1, [a, b, 0.7])[0],
    "struct": lambda a, b: __import__("struct").unpack("f", __import__("struct").pack("f", a))[0] + b,
    "float": lambda a, b: float(a) + float(b),
    "np.float32": lambda a, b: float(np.float32(a)) + b,
    "array of floats": lambda a, b: np.array([a, b], dtype=float).sum(),
    "assert": lambda a, b: (lambda: a + b)() if a > -5 else None,
}

if scipy is not None:
    COLUMNS |= {
        "scipy.special.erf": lambda a, b: scipy.special.erf(a) + b,
        "scipy.special.gamma": lambda a, b: scipy.special.gamma(a) + scipy.special.jv(0, b),
        "scipy.stats.norm.cdf": lambda a, b: scipy.stats.norm.cdf(a) + b,
        "scipy.interpolate": lambda a, b: scipy.interpolate.CubicSpline(TABLE_X, TABLE_Y)(a) + b,
    }
    DRAWS |= {
        "scipy.special.logsumexp": lambda a, b: scipy.special.logsumexp([a, b]),
        "scipy.integrate.solve_ivp": ode,
        "scipy.integrate.quad": lambda a, b: scipy.integrate.quad(lambda x: x**2, 0, a)[0] + b,
        "scipy.integrate.simpson": lambda a, b: scipy.integrate.simpson([0.0, a, b], dx=0.5)
        + np.max([a, b]),
        "scipy.optimize.brentq": lambda a, b: scipy.optimize.brentq(lambda x: x**3 - a, 0, 2) + b,
        "scipy.linalg.expm": lambda a, b: scipy.linalg.expm(np.array([[0, a], [-a, 0]]))[0, 0] + b,
    }

#: What takes arrays and nothing else.
ENTRIES: dict[str, Function] = {
    "mean of itself": lambda a, b: a.mean() + b,
    "maximum of itself": lambda a, b: a.max() - b,
    "mask of itself": lambda a, b: a[a > -5.0] + b.sum(),
    "length": lambda a, b: len(a) * a + b,
    "assigned in place": assigned_in_place,
}

_counter = itertools.count()
_seen: list[float] = []


def growing(a: Any, b: Any) -> Any:
    _seen.append(1.0)
    return a + b * len(_seen)


def remembering(a: Any, b: Any, last: list[Any] = [0.0]) -> Any:  # noqa: B006 - that is what it shows
    before, last[0] = last[0], float(np.mean(a)) if not hasattr(a, "tape") else 0.5
    return a + before


#: What cannot be a model: it gives no value, or not the same one twice.
REFUSED: dict[str, Function] = {
    "random": lambda a, b: a + random.random() * b,
    "np.random": lambda a, b: a + np.random.normal(0, 0.1) * b,
    "default_rng": lambda a, b: a + b * np.random.default_rng().uniform(),
    "time": lambda a, b: a + b * time.time(),
    "perf_counter": lambda a, b: a + b * time.perf_counter(),
    "counter": lambda a, b: a + b * next(_counter),
    "growing list": growing,
    "default that changes": remembering,
    "id": lambda a, b: a + b * (id(object.__new__(Plate)) % 1009 + next(_counter)),
    "a complex number": lambda a, b: a + 1j * b,
    "a complex number of NumPy": lambda a, b: np.exp(1j * a) * b,
    "nothing": lambda a, b: None,
    "a text": lambda a, b: str(float(a)),
    "several values": lambda a, b: np.array([float(a), 2.0]),
    "an exception": lambda a, b: {}["x"],
}


def plain(function: Function, a: float, b: float, *, arrays: bool) -> float:
    """What plain Python gives."""
    given = {"a": float(a), "b": float(b)}
    if arrays:
        given = {name: np.array([value]) for name, value in given.items()}  # type: ignore[misc]
    found = function(*given.values()) if function is positional else function(**given)
    return float(np.asarray(found).item())


@pytest.fixture(scope="module")
def draws() -> Any:
    """The draws of the inputs, which hang on their names and the seed."""
    both = gu.model(inputs={"a": "1", "b": "1"}, outputs={"x": "1", "y": "1"})(lambda a, b: (a * 1, b * 1))
    samples = both(**KNOWN).run(trials=TRIALS).samples()
    return samples["x"], samples["y"]


ALL = {"formulas": FORMULAS, "columns": COLUMNS, "draws": DRAWS, "entries": ENTRIES}


def test_how_many_there_are() -> None:
    assert sum(map(len, ALL.values())) + len(REFUSED) >= 200


@pytest.mark.parametrize(
    ("way", "name"), [(way, name) for way, group in ALL.items() for name in group]
)
def test_construct(way: str, name: str, draws: Any) -> None:
    """Every compared trial is that of the function; where it is not evaluated by formulas or columns,
    that is said."""
    function = ALL[way][name]
    a, b = draws
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        made = gu.model(inputs={"a": "1", "b": "1"}, outputs={"z": "1"})(function)
        result = made(**KNOWN).run(trials=TRIALS)
    z = result.samples("z")
    expected = [plain(function, *of, arrays=way == "entries") for of in zip(a[:COMPARED], b[:COMPARED])]
    # elementary functions of the engine and of the C library differ by some units in the last place
    assert np.allclose(z[:COMPARED], expected, rtol=1e-12, atol=1e-14)
    told = [str(w.message) for w in said if issubclass(w.category, gu.NotTracedWarning)]
    by_python = {"formulas": None, "columns": "in blocks of values"}.get(way, "one draw at a time")
    assert len(told) == (by_python is not None), told
    assert by_python is None or by_python in told[0]


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = gu.model(inputs={"a": "1", "b": "1"}, outputs={"z": "1"})(REFUSED[name])
        with pytest.raises((gu.ModelError, TypeError, ValueError, KeyError)):
            made(**KNOWN)
