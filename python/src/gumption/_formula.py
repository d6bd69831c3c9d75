"""Numbers that write down what operators and functions of NumPy do to them, and the formulas of them.

`Term` is what the arguments of a traced function and the quantities of an expression have in common.
"""

from __future__ import annotations

import itertools
import json
import math
import numbers
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache
from typing import Any, NoReturn

import numpy as np

from gumption import _gumption

#: How tightly the outermost operation of a formula binds.
_COMPARISON, _SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(1, 7)

#: A formula of more letters than this is cut into several.
_LONGEST = 2000

#: Formulas nest no deeper than this.
_DEEPEST = 24

#: Functions of formulas by the names that NumPy has for them.
_FUNCTIONS = {
    "sin": "sin", "cos": "cos", "tan": "tan",
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2",
    "asin": "asin", "acos": "acos", "atan": "atan", "atan2": "atan2",
    "sinh": "sinh", "cosh": "cosh", "tanh": "tanh",
    "arcsinh": "asinh", "arccosh": "acosh", "arctanh": "atanh",
    "asinh": "asinh", "acosh": "acosh", "atanh": "atanh",
    "exp": "exp", "expm1": "expm1", "log": "ln", "log10": "log10", "log1p": "log1p",
    "sqrt": "sqrt", "cbrt": "cbrt", "absolute": "abs", "fabs": "abs",
    "minimum": "min", "maximum": "max", "fmin": "min", "fmax": "max", "hypot": "hypot",
    "floor": "floor", "ceil": "ceil", "mod": "mod", "remainder": "mod",
}  # fmt: skip

_OPERATORS = {
    "add": "+", "subtract": "-", "multiply": "*", "divide": "/", "true_divide": "/",
    "power": "^", "pow": "^", "float_power": "^",
    "less": "<", "less_equal": "<=", "greater": ">", "greater_equal": ">=",
    "equal": "==", "not_equal": "!=",
}  # fmt: skip

_UFUNCS = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power,
    "<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal,
    "==": np.equal, "!=": np.not_equal,
}  # fmt: skip

_BINDING = {"+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "^": _POWER}


@lru_cache(maxsize=None)
def _is_known(name: str, count: int) -> bool:
    """Whether formulas have a function of so many values: the engine's own word."""
    call = f"{name}({', '.join(['x'] * count)})"
    probe = {
        "format": 1,
        "check_units": False,
        "inputs": {"x": {"distribution": "constant", "value": 0.5}},
        "equations": {"y": call},
        "outputs": {"y": {"unit": "1"}},
    }
    try:
        _gumption.Model("probe", json.dumps(probe))
    except _gumption.ModelError:
        return False
    return True


_NUMBERS = itertools.count(1)


class Term:
    """A number of which operators and functions of NumPy make terms.

    Attributes
    ----------
    symbol : str
        An operator or the name of a function; for what has no operands its text; empty for an operand as
        it is.
    operands : tuple of Term
        What the operation is done to.
    number : int
        Its place in the order in which terms are made, so that operands come first.
    literal : float, complex or None
        The value of a number that is written out.
    """

    __slots__ = ("literal", "number", "operands", "symbol")
    # before arrays, so that they do not take it for an object of their own
    __array_priority__ = 1000.0

    def __init__(
        self, symbol: str, operands: tuple[Term, ...] = (), literal: complex | None = None
    ) -> None:
        self.symbol = symbol
        self.operands = operands
        self.number = next(_NUMBERS)
        self.literal = literal

    # what each kind says of itself

    def _made(self, symbol: str, operands: tuple[Term, ...]) -> Term:
        """The term of an operation of which this one is an operand."""
        raise NotImplementedError

    def _written(self, text: str, value: complex) -> Term:
        """A number that is written out."""
        raise NotImplementedError

    def _foreign(self, what: str) -> NoReturn:
        """Refuses an operation that no formula can express."""
        raise NotImplementedError

    def _array(self, found: Any) -> Any:
        """An array of terms of its kind."""
        return found

    @property
    def angle(self) -> float | None:
        """Of an angle in radians 1, of one that was multiplied by numbers their product; else `None`."""
        raise NotImplementedError

    def _shown(self) -> str:
        """Its formula, cut where it is long."""
        return cut(Writer([self], ()).whole(self))

    # operators

    def __add__(self, other: Any) -> Any:
        return binary("+", self, other)

    def __radd__(self, other: Any) -> Any:
        return binary("+", other, self)

    def __sub__(self, other: Any) -> Any:
        return binary("-", self, other)

    def __rsub__(self, other: Any) -> Any:
        return binary("-", other, self)

    def __mul__(self, other: Any) -> Any:
        return binary("*", self, other)

    def __rmul__(self, other: Any) -> Any:
        return binary("*", other, self)

    def __truediv__(self, other: Any) -> Any:
        return binary("/", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return binary("/", other, self)

    def __pow__(self, other: Any) -> Any:
        return binary("^", self, other)

    def __rpow__(self, other: Any) -> Any:
        return binary("^", other, self)

    def __mod__(self, other: Any) -> Any:
        return call("mod", [self, other])

    def __rmod__(self, other: Any) -> Any:
        return call("mod", [other, self])

    def __lt__(self, other: Any) -> Any:
        return binary("<", self, other)

    def __le__(self, other: Any) -> Any:
        return binary("<=", self, other)

    def __gt__(self, other: Any) -> Any:
        return binary(">", self, other)

    def __ge__(self, other: Any) -> Any:
        return binary(">=", self, other)

    def __neg__(self) -> Any:
        return self._made("-", (self,))

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return call("abs", [self])

    # functions of NumPy

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        out = options.pop("out", None)
        if out is not None:
            # what an operator in place does to an array
            found = self.__array_ufunc__(ufunc, method, *inputs, **options)
            out[0][...] = found
            return out[0]
        if method != "__call__" or any(value is not None for value in options.values()):
            self._foreign(f"no formula does numpy.{ufunc.__name__}.{method} with these options")
        if any(isinstance(value, np.ndarray) and value.ndim for value in inputs):
            each = np.frompyfunc(lambda *values: ufunc_of(ufunc, values), len(inputs), 1)
            return self._array(each(*(_boxed(value) for value in inputs)))
        return ufunc_of(ufunc, inputs)

    def __array_function__(
        self, function: Any, types: Any, arguments: tuple[Any, ...], options: dict[str, Any]
    ) -> Any:
        name = function.__name__
        if name == "where" and len(arguments) == 3 and not options:
            return call("if", list(arguments))
        if name == "clip" and len(arguments) == 3 and not options:
            value, low, high = arguments
            raised = value if low is None else call("max", [value, low])
            return raised if high is None else call("min", [raised, high])
        if name == "copy" and len(arguments) == 1:
            return arguments[0]
        if name in ("real", "imag", "angle") and len(arguments) == 1 and not options:
            return self._part({"real": "re", "imag": "im", "angle": "arg"}[name])
        self._foreign(f"no formula does numpy.{name}")

    def _part(self, name: str) -> Any:
        """A part of a complex number, or its conjugate."""
        return call(name, [self])

    @property
    def real(self) -> Any:
        """The real part."""
        return self._part("re")

    @property
    def imag(self) -> Any:
        """The imaginary part."""
        return self._part("im")

    def conjugate(self) -> Any:
        """The complex conjugate."""
        return self._part("conj")

    def __getattr__(self, name: str) -> Callable[..., Any]:
        # arrays of objects call the methods that functions of NumPy are named after
        if name in _FUNCTIONS or name in _COMPOSED:
            return lambda *others: ufunc_of(getattr(np, name), (self, *others))
        raise AttributeError(name)


#: What an angle or several of them give that is one, by the place of the first that can be one.
_KEEPING_ANGLES = {"+": 0, "-": 0, "abs": 0, "min": 0, "max": 0, "mod": 0, "if": 1}

_GIVING_ANGLES = ("asin", "acos", "atan", "atan2")


def angle_of(symbol: str, operands: tuple[Term, ...]) -> float | None:
    """The factor of an angle in radians, if the result of an operation is one."""
    if symbol in _GIVING_ANGLES:
        return 1.0
    if symbol in _KEEPING_ANGLES:
        for one in operands[_KEEPING_ANGLES[symbol] :]:
            if (angle := one.angle) is not None:
                return angle
        return None
    if symbol not in ("*", "/"):
        return None
    first, second = operands
    of_first, of_second = first.angle, second.angle
    if of_first is not None and of_second is None:
        by = _real(second.literal)
        if by == 0:
            return None
        return of_first * by if symbol == "*" else of_first / by
    if symbol == "*" and of_second is not None and of_first is None:
        return of_second * _real(first.literal)
    return None


def _real(literal: complex | None) -> float:
    """The factor of a number that is written out; 1 for what is none."""
    return literal if isinstance(literal, (int, float)) else 1.0


#: What formulas make of a value in a unit, as `_gumption.unit_within`.
unit_within = lru_cache(maxsize=4096)(_gumption.unit_within)


def angle_in(unit: str) -> float | None:
    """Of a unit of angle (or of angle times something, as ``deg/s``) 1."""
    return 1.0 if unit_within(unit)[2] else None


def is_about(value: float, factor: float) -> bool:
    """Whether a number is a factor, exactly or rounded to four digits."""
    return math.isclose(abs(value), factor, rel_tol=4e-4)



def _boxed(value: Any) -> Any:
    """A traced number as an array of objects, so that NumPy does not ask it again."""
    if isinstance(value, Term):
        boxed = np.empty((), dtype=object)
        boxed[()] = value
        return boxed
    return np.asarray(value, dtype=object)


def _number(value: Any, of: Term) -> complex:
    """A number without a unit."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, (numbers.Real, np.bool_)):
        return float(value)
    if isinstance(value, (complex, np.complexfloating)):
        return complex(value)
    of._foreign(f"no formula computes with a {type(value).__name__}")


def literal(of: Term, value: Any) -> Term:
    """A number as a term of the kind of another one."""
    value = _number(value, of)
    if isinstance(value, complex):
        real, imaginary = literal(of, value.real), literal(of, value.imag)
        unit = of._written("i", 1j)
        product = unit if value.imag == 1 else of._made("*", (imaginary, unit))
        return product if value.real == 0 else of._made("+", (real, product))
    if not math.isfinite(value):
        of._foreign(f"no formula has the number {value}")
    if abs(value) == math.tau:
        # by which formulas know a turn
        turn = of._made("*", (literal(of, math.copysign(2.0, value)), literal(of, math.pi)))
        turn.literal = value
        return turn
    if abs(value) == math.pi:
        text = "pi"
    elif value == int(value) and abs(value) < 1e15:
        text = repr(int(abs(value)))
    else:
        text = repr(abs(value))
    if math.copysign(1.0, value) > 0:
        return of._written(text, value)
    negative = of._made("-", (of._written(text, -value),))
    negative.literal = value
    return negative


def _operands(values: Iterable[Any]) -> tuple[Term, ...]:
    values = tuple(values)
    others = [value for value in values if not isinstance(value, Term)]
    if not others:
        return values
    of = next(value for value in values if isinstance(value, Term))
    return tuple([v if isinstance(v, Term) else literal(of, v) for v in values])


def binary(operator: str, first: Any, second: Any) -> Any:
    """An operation of two values, of which one is a term."""
    if isinstance(first, Term) and isinstance(second, Term):
        return first._made(operator, (first, second))
    for value in (first, second):
        if isinstance(value, np.ndarray) and value.ndim:
            other = next(v for v in (first, second) if isinstance(v, Term))
            return other.__array_ufunc__(_UFUNCS[operator], "__call__", first, second)
        if not isinstance(value, Term) and not np.isscalar(value) and not isinstance(value, np.ndarray):
            return NotImplemented
    operands = _operands([first, second])
    if operator == "^" and operands[1] is not second:
        operands = (operands[0], _exponent(operands[0], _number(second, operands[0])))
    return operands[0]._made(operator, operands)


def _exponent(of: Term, value: complex) -> Term:
    """An exponent; a ratio of small integers as a fraction, because units need exact exponents."""
    if isinstance(value, complex) or not math.isfinite(value):
        return literal(of, value)
    ratio = Fraction(value).limit_denominator(24)
    if ratio.denominator == 1 or float(ratio) != value:
        return literal(of, value)
    top, bottom = literal(of, ratio.numerator), literal(of, ratio.denominator)
    fraction = of._made("/", (top, bottom))
    fraction.literal = value
    return fraction


def call(name: str, values: list[Any]) -> Any:
    """A function of values, of which one is a term."""
    operands = _operands(values)
    if not _is_known(name, len(values)):
        operands[0]._foreign(f"formulas have no function `{name}`")
    return operands[0]._made(name, operands)


class Writer:
    """Formulas of terms: one that is used more than once gets a name.

    Parameters
    ----------
    results : iterable of Term
        What formulas are wanted of.
    taken : iterable of str
        Names that others have. Where there are none, no term gets one.
    name : callable, optional
        The text of a term without operands; its symbol unless given.
    """

    def __init__(
        self,
        results: Iterable[Term],
        taken: Iterable[str],
        name: Callable[[Term], str] = lambda leaf: leaf.symbol,
    ) -> None:
        self._name = name
        self._taken = set(taken)
        self._steps = 0
        self.equations: dict[str, str] = {}
        # text, how tightly its outermost operation binds, and how deep it is nested
        self._texts: dict[int, tuple[str, int, int]] = {}
        reached: dict[int, Term] = {}
        uses: dict[int, int] = {}
        left = list(results)
        for result in left:
            uses[result.number] = uses.get(result.number, 0) + 1
        while left:
            one = left.pop()
            if one.number in reached:
                continue
            reached[one.number] = one
            for operand in one.operands:
                uses[operand.number] = uses.get(operand.number, 0) + 1
            left.extend(one.operands)
        # everything comes after what it is made of
        for number in sorted(reached):
            text, binding, depth = self._written(reached[number])
            again = uses[number] > 1 or depth >= _DEEPEST or len(text) >= _LONGEST
            if depth > 0 and again and taken:
                text, binding, depth = self._named(text), _ATOM, 0
            elif not taken and len(text) > _LONGEST:
                # only its beginning is shown
                text = text[:_LONGEST]
            self._texts[number] = (text, binding, depth)

    def whole(self, result: Term) -> str:
        """The formula of a result."""
        return self._texts[result.number][0]

    def _named(self, text: str) -> str:
        while True:
            self._steps += 1
            name = f"step_{self._steps}"
            if name not in self._taken:
                self.equations[name] = text
                return name

    def _written(self, one: Term) -> tuple[str, int, int]:
        if one.operands and one.symbol == "":
            return self._texts[one.operands[0].number]
        if not one.operands:
            # a quantity with a unit is written with a blank, as `20 [mm]`
            text = self._name(one)
            return text, _PRODUCT if " " in text and text[0] != "(" else _ATOM, 0
        parts = [self._texts[operand.number] for operand in one.operands]
        depth = max([part[2] for part in parts]) + 1
        symbol = one.symbol
        if symbol == "-" and len(parts) == 1:
            # a sign before a number is part of it
            return "-" + _within(parts[0], _SIGN + 1), _SIGN, depth if one.operands[0].operands else 0
        if symbol not in _UFUNCS:
            return f"{symbol}({', '.join([part[0] for part in parts])})", _ATOM, depth
        # to the left operations of the same kind need no parentheses, and to the right they do;
        # powers go from right to left, and comparisons do not chain
        binding = _BINDING.get(symbol, _COMPARISON)
        left = _within(parts[0], binding if symbol in "+-*/" else binding + 1)
        right = _within(parts[1], binding if symbol == "^" else binding + 1)
        space = " " if binding <= _SUM else ""
        return f"{left}{space}{symbol}{space}{right}", binding, depth


def _within(part: tuple[str, int, int], binding: int) -> str:
    """A text within an operation that binds so tightly."""
    return part[0] if part[1] >= binding else f"({part[0]})"


def cut(formula: str) -> str:
    """The beginning of a formula, as messages and titles have it."""
    return formula if len(formula) <= 60 else f"{formula[:57]}..."


_COMPOSED: dict[str, Callable[..., Any]] = {
    "negative": lambda x: -x,
    "positive": lambda x: x,
    "square": lambda x: x**2,
    "reciprocal": lambda x: 1 / x,
    "log2": lambda x: np.log(x) / math.log(2),
    "exp2": lambda x: 2**x,
    "deg2rad": lambda x: x * math.pi / 180,
    "radians": lambda x: x * math.pi / 180,
    "rad2deg": lambda x: x * 180 / math.pi,
    "degrees": lambda x: x * 180 / math.pi,
    "conjugate": lambda x: x.conjugate(),
}


def ufunc_of(ufunc: Any, values: tuple[Any, ...]) -> Any:
    """The result of a NumPy function for numbers of which some are traced."""
    values = tuple(v[()] if isinstance(v, np.ndarray) and not v.ndim else v for v in values)
    if not any(isinstance(value, Term) for value in values):
        return ufunc(*values)
    name = ufunc.__name__
    if name in _OPERATORS and len(values) == 2:
        return binary(_OPERATORS[name], *values)
    if name in _FUNCTIONS:
        return call(_FUNCTIONS[name], list(values))
    if name in _COMPOSED:
        return _COMPOSED[name](*values)
    of = next(value for value in values if isinstance(value, Term))
    of._foreign(f"no formula does numpy.{name}")
