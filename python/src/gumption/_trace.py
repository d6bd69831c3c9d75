"""Traces a Python function as formulas: it is called once with numbers that record operations."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from contextvars import ContextVar
from fractions import Fraction
from typing import Any

import numpy as np

from gumption import _gumption


class NotTraceable(TypeError):
    """An operation of a function that no formula can express.

    The tape stores the first one, so that no ``except`` in the function hides it.
    """

    def __init__(self, what: str, decision: Traced | None = None) -> None:
        super().__init__(what)
        #: The traced number that decides.
        self.decision = decision
        tape = _TAPE.get()
        if tape is not None and tape.refused is None:
            tape.refused = self


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
}  # fmt: skip

_BINDING = {"+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "^": _POWER}


_KNOWN: dict[str, bool] = {}


def _is_known(call: str) -> bool:
    """Whether formulas have a function."""
    if call not in _KNOWN:
        _KNOWN[call] = _is_accepted(call)
    return _KNOWN[call]


def _is_accepted(call: str) -> bool:
    """The engine's own word."""
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


class Tape:
    """The operations on the arguments of a function, in order.

    Attributes
    ----------
    has_units : bool
        Whether numbers are in coherent SI units, so that angles are in radians.
    refused : NotTraceable or None
        The first operation that no formula can express.
    mistake : ModelError or None
        The first ambiguous operation.
    """

    def __init__(self, has_units: bool) -> None:
        self.has_units = has_units
        self.refused: NotTraceable | None = None
        self.mistake: _gumption.ModelError | None = None
        self._count = 0

    def next(self) -> int:
        """The number of the next operation."""
        self._count += 1
        return self._count


# the tape of the function that is being traced
_TAPE: ContextVar[Tape | None] = ContextVar("tape", default=None)


def quantity(value: float, unit: str) -> Any:
    """A quantity with a unit within a model function, as its number in coherent SI units.

    Model functions compute with coherent SI units (radians for angles), so a number without a unit
    is dimensionless. ``gumption.quantity(20, "mm")`` is a length.

    Parameters
    ----------
    value : float
        The value.
    unit : str
        Its unit.
    """
    tape = _TAPE.get()
    if tape is not None:
        return Traced(tape, f"{float(value)!r} [{unit}]", angle=_angle_in(unit))
    factor, offset = _gumption.unit_scale(unit)
    return float(value) * factor + offset


def _angle_in(unit: str) -> float | None:
    """Of a unit of angle (or of angle times something, as ``deg/s``) 1."""
    return 1.0 if _gumption.unit_within(unit)[2] else None


class Traced:
    """A number that records operations on it.

    It represents a quantity in coherent SI units (radians for angles). Operators and the functions
    of NumPy work on it; operations that need its value (``if``, ``float()``, ``math.sin``) do not.
    """

    __slots__ = ("angle", "literal", "number", "operands", "symbol", "tape")
    # before arrays, so that they do not take it for an object of their own
    __array_priority__ = 1000.0

    def __init__(
        self,
        tape: Tape,
        symbol: str,
        operands: tuple[Traced, ...] = (),
        *,
        angle: float | None = None,
        literal: float | None = None,
    ) -> None:
        self.tape = tape
        #: An operator, the name of a function, or for what has no operands its text.
        self.symbol = symbol
        self.operands = operands
        self.number = tape.next()
        #: The value of a number that is written out.
        self.literal = literal
        #: Of an angle in radians 1, of one that was multiplied by numbers their product; else `None`.
        self.angle = (_angle_of(symbol, operands) if operands else angle) if tape.has_units else None
        if operands and self.angle is not None and _is_about(self.angle, math.pi / 180):
            self._refuse_conversion()

    def _refuse_conversion(self) -> None:
        tape = self.tape
        if tape.mistake is None:
            tape.mistake = _gumption.ModelError(
                f"`{self._shown()}` converts an angle from degrees to radians, but within the function "
                "angles are in radians already, whatever their unit. Leave the conversion out; or, if "
                "the function is to compute with the numbers of its declared units, say so with "
                "`gumption.model(..., check_units=False)`"
            )
        raise tape.mistake

    def __repr__(self) -> str:
        return f"<traced {self._shown()}>"

    def _shown(self) -> str:
        text = _Writer([self], ()).whole(self)
        return text if len(text) <= 60 else f"{text[:57]}..."

    # what is not known yet

    def _refuse(self, what: str, decision: Traced | None = None) -> NotTraceable:
        reason = f"{what} the value of `{self._shown()}`, which no formula knows"
        return NotTraceable(reason, decision)

    def __bool__(self) -> bool:
        raise self._refuse("it decides by", self)

    def __float__(self) -> float:
        raise self._refuse("it takes")

    def __int__(self) -> int:
        raise self._refuse("it takes")

    def __index__(self) -> int:
        raise self._refuse("it counts by")

    def __complex__(self) -> complex:
        raise self._refuse("it takes")

    def __hash__(self) -> int:
        raise self._refuse("it looks up")

    def __round__(self, digits: int | None = None) -> Any:
        raise self._refuse("it rounds")

    def __floordiv__(self, other: Any) -> Any:
        raise self._refuse("it divides with a rest")

    __rfloordiv__ = __divmod__ = __rdivmod__ = __floordiv__

    def __format__(self, form: str) -> str:
        raise self._refuse("it writes out")

    # operators

    def __add__(self, other: Any) -> Any:
        return _binary("+", self, other)

    def __radd__(self, other: Any) -> Any:
        return _binary("+", other, self)

    def __sub__(self, other: Any) -> Any:
        return _binary("-", self, other)

    def __rsub__(self, other: Any) -> Any:
        return _binary("-", other, self)

    def __mul__(self, other: Any) -> Any:
        return _binary("*", self, other)

    def __rmul__(self, other: Any) -> Any:
        return _binary("*", other, self)

    def __truediv__(self, other: Any) -> Any:
        return _binary("/", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return _binary("/", other, self)

    def __pow__(self, other: Any) -> Any:
        return _binary("^", self, other)

    def __rpow__(self, other: Any) -> Any:
        return _binary("^", other, self)

    def __mod__(self, other: Any) -> Any:
        return _call("mod", [self, other])

    def __rmod__(self, other: Any) -> Any:
        return _call("mod", [other, self])

    def __lt__(self, other: Any) -> Any:
        return _binary("<", self, other)

    def __le__(self, other: Any) -> Any:
        return _binary("<=", self, other)

    def __gt__(self, other: Any) -> Any:
        return _binary(">", self, other)

    def __ge__(self, other: Any) -> Any:
        return _binary(">=", self, other)

    def __eq__(self, other: object) -> bool:
        raise self._refuse("it compares with", _compared(self, other))

    def __ne__(self, other: object) -> bool:
        raise self._refuse("it compares with", _compared(self, other))

    def __neg__(self) -> Traced:
        return Traced(self.tape, "-", (self,))

    def __pos__(self) -> Traced:
        return self

    def __abs__(self) -> Any:
        return _call("abs", [self])

    # functions of NumPy

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        if method != "__call__" or any(value is not None for value in options.values()):
            raise NotTraceable(f"no formula does numpy.{ufunc.__name__}.{method} with these options")
        if any(isinstance(value, np.ndarray) and value.ndim for value in inputs):
            each = np.frompyfunc(lambda *values: ufunc_of(ufunc, values), len(inputs), 1)
            return each(*(_boxed(value) for value in inputs))
        return ufunc_of(ufunc, inputs)

    def __array_function__(
        self, function: Any, types: Any, arguments: tuple[Any, ...], options: dict[str, Any]
    ) -> Any:
        name = function.__name__
        if name == "where" and len(arguments) == 3 and not options:
            return _call("if", list(arguments))
        if name == "clip" and len(arguments) == 3 and not options:
            value, low, high = arguments
            raised = value if low is None else _call("max", [value, low])
            return raised if high is None else _call("min", [raised, high])
        if name in ("real", "copy") and len(arguments) == 1:
            return arguments[0]
        raise NotTraceable(f"no formula does numpy.{name}")

    def __getattr__(self, name: str) -> Callable[..., Any]:
        # arrays of objects call the methods that functions of NumPy are named after
        if name in _FUNCTIONS or name in _COMPOSED:
            return lambda *others: ufunc_of(getattr(np, name), (self, *others))
        if hasattr(float, name) or isinstance(getattr(np, name, None), np.ufunc):
            raise NotTraceable(f"no formula does `{name}` of `{self._shown()}`") from AttributeError(name)
        raise AttributeError(name)


#: What an angle or several of them give that is one, by the place of the first that can be one.
_KEEPING_ANGLES = {"+": 0, "-": 0, "abs": 0, "min": 0, "max": 0, "mod": 0, "if": 1}

_GIVING_ANGLES = ("asin", "acos", "atan", "atan2")


def _angle_of(symbol: str, operands: tuple[Traced, ...]) -> float | None:
    """The factor of an angle in radians, if the result of an operation is one."""
    if symbol in _GIVING_ANGLES:
        return 1.0
    if symbol in _KEEPING_ANGLES:
        own = (one.angle for one in operands[_KEEPING_ANGLES[symbol] :])
        return next((angle for angle in own if angle is not None), None)
    if symbol not in ("*", "/"):
        return None
    first, second = operands
    if first.angle is not None and second.angle is None:
        by = second.literal if second.literal is not None else 1.0
        if by == 0:
            return None
        return first.angle * by if symbol == "*" else first.angle / by
    if symbol == "*" and second.angle is not None and first.angle is None:
        return second.angle * (first.literal if first.literal is not None else 1.0)
    return None


def _is_about(value: float, factor: float) -> bool:
    """Whether a number is a factor, exactly or rounded to four digits."""
    return math.isclose(abs(value), factor, rel_tol=4e-4)


def _compared(first: Traced, second: object) -> Traced | None:
    """The comparison of two things, where there is one."""
    try:
        found = _binary("<", first, second)
    except NotTraceable:
        return None
    return found if isinstance(found, Traced) else None


def _boxed(value: Any) -> Any:
    """A traced number as an array of objects, so that NumPy does not ask it again."""
    if isinstance(value, Traced):
        boxed = np.empty((), dtype=object)
        boxed[()] = value
        return boxed
    return np.asarray(value, dtype=object)


def _number(value: Any) -> float:
    """A number without a unit."""
    if isinstance(value, (bool, np.bool_)):
        return float(value)
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, (int, float, np.integer, np.floating)):
        return float(value)
    raise NotTraceable(f"no formula computes with a {type(value).__name__}")


def _literal(tape: Tape, value: float) -> Traced:
    if not math.isfinite(value):
        raise NotTraceable(f"no formula has the number {value}")
    if abs(value) == math.pi:
        text = "pi"
    elif value == int(value) and abs(value) < 1e15:
        text = repr(int(abs(value)))
    else:
        text = repr(abs(value))
    if math.copysign(1.0, value) > 0:
        return Traced(tape, text, literal=value)
    return Traced(tape, "-", (Traced(tape, text, literal=-value),), literal=value)


def _operands(values: Iterable[Any]) -> tuple[Traced, ...]:
    values = list(values)
    tape = next(value.tape for value in values if isinstance(value, Traced))
    return tuple(v if isinstance(v, Traced) else _literal(tape, _number(v)) for v in values)


def _binary(operator: str, first: Any, second: Any) -> Any:
    for value in (first, second):
        if isinstance(value, np.ndarray) and value.ndim:
            ufunc = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power}
            if operator not in ufunc:
                raise NotTraceable("no formula compares with an array")
            other = next(v for v in (first, second) if isinstance(v, Traced))
            return other.__array_ufunc__(ufunc[operator], "__call__", first, second)
        if not isinstance(value, Traced) and not np.isscalar(value) and not isinstance(value, np.ndarray):
            return NotImplemented
    operands = _operands([first, second])
    if operator == "^" and not isinstance(second, Traced):
        operands = (operands[0], _exponent(operands[0].tape, _number(second)))
    return Traced(operands[0].tape, operator, operands)


def _exponent(tape: Tape, value: float) -> Traced:
    """An exponent; a ratio of small integers as a fraction, because units need exact exponents."""
    ratio = Fraction(value).limit_denominator(24) if math.isfinite(value) else Fraction(0)
    if ratio.denominator == 1 or float(ratio) != value:
        return _literal(tape, value)
    top, bottom = _literal(tape, ratio.numerator), _literal(tape, ratio.denominator)
    return Traced(tape, "/", (top, bottom))


def _call(name: str, values: list[Any]) -> Traced:
    probe = f"{name}({', '.join(['x'] * len(values))})"
    if not _is_known(probe):
        raise NotTraceable(f"formulas have no function `{name}`")
    operands = _operands(values)
    return Traced(operands[0].tape, name, operands)


class _Writer:
    """Formulas of traced numbers: a term that is used more than once gets a name."""

    def __init__(self, results: Iterable[Traced], taken: Iterable[str]) -> None:
        self._taken = set(taken)
        self._steps = 0
        self.equations: dict[str, str] = {}
        # text, how tightly its outermost operation binds, and how deep it is nested
        self._texts: dict[int, tuple[str, int, int]] = {}
        reached: dict[int, Traced] = {}
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
                left.append(operand)
        # everything comes after what it is made of
        for number in sorted(reached):
            text, binding, depth = self._written(reached[number])
            again = uses[number] > 1 or depth >= _DEEPEST or len(text) >= _LONGEST
            if depth > 0 and again and taken:
                text, binding, depth = self._named(text), _ATOM, 0
            self._texts[number] = (text, binding, depth)

    def whole(self, result: Traced) -> str:
        """The formula of a result."""
        return self._texts[result.number][0]

    def _named(self, text: str) -> str:
        while True:
            self._steps += 1
            name = f"step_{self._steps}"
            if name not in self._taken:
                self.equations[name] = text
                return name

    def _written(self, one: Traced) -> tuple[str, int, int]:
        if not one.operands:
            # a quantity with a unit is written with a blank, as `20 [mm]`
            return one.symbol, _PRODUCT if " " in one.symbol else _ATOM, 0
        parts = [self._texts[operand.number] for operand in one.operands]
        depth = max(depth for *_, depth in parts) + 1
        symbol = one.symbol

        def within(part: tuple[str, int, int], binding: int) -> str:
            return part[0] if part[1] >= binding else f"({part[0]})"

        if symbol == "-" and len(parts) == 1:
            # a sign before a number is part of it
            return "-" + within(parts[0], _SIGN + 1), _SIGN, depth if one.operands[0].operands else 0
        if symbol not in _OPERATORS.values():
            return f"{symbol}({', '.join(text for text, *_ in parts)})", _ATOM, depth
        # to the left operations of the same kind need no parentheses, and to the right they do;
        # powers go from right to left, and comparisons do not chain
        binding = _BINDING.get(symbol, _COMPARISON)
        left = within(parts[0], binding if symbol in "+-*/" else binding + 1)
        right = within(parts[1], binding if symbol == "^" else binding + 1)
        space = " " if binding <= _SUM else ""
        return f"{left}{space}{symbol}{space}{right}", binding, depth


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
    "conjugate": lambda x: x,
}


def ufunc_of(ufunc: Any, values: tuple[Any, ...]) -> Any:
    """The result of a NumPy function for numbers of which some are traced."""
    values = tuple(v[()] if isinstance(v, np.ndarray) and not v.ndim else v for v in values)
    if not any(isinstance(value, Traced) for value in values):
        return ufunc(*values)
    name = ufunc.__name__
    if name in _OPERATORS and len(values) == 2:
        return _binary(_OPERATORS[name], *values)
    if name in _FUNCTIONS:
        return _call(_FUNCTIONS[name], list(values))
    if name in _COMPOSED:
        return _COMPOSED[name](*values)
    raise NotTraceable(f"no formula does numpy.{name}")


def equations(
    function: Callable[..., Any],
    arguments: Mapping[str, str],
    outputs: Mapping[str, str],
    names: Callable[[Any], Mapping[str, Any]],
    *,
    has_units: bool = True,
) -> dict[str, str]:
    """The formulas of a function.

    Parameters
    ----------
    function : callable
        Called once, with a traced number for each argument.
    arguments, outputs : mapping of str to str
        Names and units of its arguments and results.
    names : callable
        Assigns its results to outputs.
    has_units : bool, default True
        Whether its numbers are in coherent SI units, and not in the declared ones.

    Raises
    ------
    NotTraceable
        If it does something that no formula can express, even if the function hides it.
    ModelError
        If an operation is ambiguous.
    """
    tape = Tape(has_units)
    token = _TAPE.set(tape)
    try:
        traced = {name: Traced(tape, name, angle=_angle_in(unit)) for name, unit in arguments.items()}
        found = names(function(traced))
        results: dict[str, Traced] = {}
        for name in outputs:
            value = found[name]
            if isinstance(value, np.ndarray) and value.ndim == 0:
                value = value[()]
            results[name] = value if isinstance(value, Traced) else _literal(tape, _number(value))
    except Exception as error:
        # what went wrong first is the reason of what went wrong then
        raise tape.mistake or tape.refused or error
    finally:
        _TAPE.reset(token)
    for name, result in results.items():
        if result.angle is not None and _is_about(result.angle, 180 / math.pi):
            if tape.mistake is None and _angle_in(outputs[name]) is not None:
                tape.mistake = _gumption.ModelError(
                    f"`{name}` is converted from radians to degrees, but what the function gives for a "
                    f"quantity in {outputs[name]} is taken in radians. Leave the conversion out; or, if "
                    "the function is to compute with the numbers of its declared units, say so with "
                    "`gumption.model(..., check_units=False)`"
                )
    if tape.mistake or tape.refused:
        raise tape.mistake or tape.refused  # type: ignore[misc]
    writer = _Writer(results.values(), [*arguments, *outputs])
    formulas = {name: writer.whole(result) for name, result in results.items()}
    # an argument may be given out under its own name
    own = {name: text for name, text in formulas.items() if not (name in arguments and text == name)}
    return {**writer.equations, **own}


def decision_formulas(decision: Traced, name: str, taken: Iterable[str]) -> tuple[str, dict[str, str]]:
    """A comparison as text, and the formulas of its operands under an unused name."""
    if decision.symbol not in ("<", "<=", ">", ">="):
        decision = Traced(decision.tape, "<", (decision, decision))
    writer = _Writer([decision], [*taken, name])
    return decision._shown(), {**writer.equations, name: writer.whole(decision)}
