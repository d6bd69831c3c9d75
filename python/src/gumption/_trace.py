"""Traces a Python function as formulas: it is called once with numbers that record operations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from contextvars import ContextVar
from typing import Any, NoReturn

import numpy as np

from gumption import _gumption
from gumption._formula import Term, Writer, angle_in, angle_of, binary, is_about, literal


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


class Tape:
    """The operations on the arguments of a function, in order.

    Attributes
    ----------
    has_units : bool
        Whether numbers are in coherent SI units, so that angles are in radians.
    names : set of str
        The names of the arguments.
    refused : NotTraceable or None
        The first operation that no formula can express.
    mistake : ModelError or None
        The first ambiguous operation.
    """

    def __init__(self, has_units: bool, names: Iterable[str]) -> None:
        self.has_units = has_units
        self.names = set(names)
        self.refused: NotTraceable | None = None
        self.mistake: _gumption.ModelError | None = None


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
        return Traced(tape, f"{float(value)!r} [{unit}]", angle=angle_in(unit))
    factor, offset = _gumption.unit_scale(unit)
    return float(value) * factor + offset


class Traced(Term):
    """A number that records operations on it.

    It represents a quantity in coherent SI units (radians for angles). Operators and the functions
    of NumPy work on it; operations that need its value (``if``, ``float()``, ``math.sin``) do not.
    """

    __slots__ = ("_angle", "tape")

    def __init__(
        self,
        tape: Tape,
        symbol: str,
        operands: tuple[Term, ...] = (),
        *,
        angle: float | None = None,
        literal: complex | None = None,
    ) -> None:
        super().__init__(symbol, operands, literal)
        self.tape = tape
        self._angle = (angle_of(symbol, operands) if operands else angle) if tape.has_units else None
        if operands and self._angle is not None and is_about(self._angle, math.pi / 180):
            self._refuse_conversion()

    def _made(self, symbol: str, operands: tuple[Term, ...]) -> Traced:
        if symbol in ("==", "!="):
            raise self._refuse("it compares with")
        for operand in operands:
            if not isinstance(operand, Traced):
                self._foreign(f"no formula of a function's arguments has a {type(operand).__name__} in it")
        return Traced(self.tape, symbol, operands)

    def _written(self, text: str, value: complex) -> Traced:
        if text in self.tape.names:
            self._foreign(f"`{text}` is a name of the function, and of the imaginary unit")
        return Traced(self.tape, text, literal=value)

    def _foreign(self, what: str) -> NoReturn:
        raise NotTraceable(what)

    @property
    def angle(self) -> float | None:
        return self._angle

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

    def __eq__(self, other: object) -> bool:
        raise self._refuse("it compares with", _compared(self, other))

    def __ne__(self, other: object) -> bool:
        raise self._refuse("it compares with", _compared(self, other))

    def __getattr__(self, name: str) -> Callable[..., Any]:
        try:
            return super().__getattr__(name)
        except AttributeError as missing:
            if hasattr(float, name) or isinstance(getattr(np, name, None), np.ufunc):
                raise NotTraceable(f"no formula does `{name}` of `{self._shown()}`") from missing
            raise


def _compared(first: Traced, second: object) -> Traced | None:
    """The comparison of two things, where there is one."""
    try:
        found = binary("<", first, second)
    except NotTraceable:
        return None
    return found if isinstance(found, Traced) else None


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
    tape = Tape(has_units, arguments)
    token = _TAPE.set(tape)
    try:
        traced = {name: Traced(tape, name, angle=angle_in(unit)) for name, unit in arguments.items()}
        found = names(function(traced))
        results: dict[str, Term] = {}
        nothing = Traced(tape, "0")
        for name in outputs:
            value = found[name]
            if isinstance(value, np.ndarray) and value.ndim == 0:
                value = value[()]
            results[name] = value if isinstance(value, Traced) else literal(nothing, value)
    except Exception as error:
        # what went wrong first is the reason of what went wrong then
        raise tape.mistake or tape.refused or error
    finally:
        _TAPE.reset(token)
    for name, result in results.items():
        if result.angle is not None and is_about(result.angle, 180 / math.pi):
            if tape.mistake is None and angle_in(outputs[name]) is not None:
                tape.mistake = _gumption.ModelError(
                    f"`{name}` is converted from radians to degrees, but what the function gives for a "
                    f"quantity in {outputs[name]} is taken in radians. Leave the conversion out; or, if "
                    "the function is to compute with the numbers of its declared units, say so with "
                    "`gumption.model(..., check_units=False)`"
                )
    if tape.mistake or tape.refused:
        raise tape.mistake or tape.refused  # type: ignore[misc]
    writer = Writer(results.values(), [*arguments, *outputs])
    formulas = {name: writer.whole(result) for name, result in results.items()}
    # an argument may be given out under its own name
    own = {name: text for name, text in formulas.items() if not (name in arguments and text == name)}
    return {**writer.equations, **own}


def decision_formulas(decision: Traced, name: str, taken: Iterable[str]) -> tuple[str, dict[str, str]]:
    """A comparison as text, and the formulas of its operands under an unused name."""
    if decision.symbol not in ("<", "<=", ">", ">="):
        decision = Traced(decision.tape, "<", (decision, decision))
    writer = Writer([decision], [*taken, name])
    return decision._shown(), {**writer.equations, name: writer.whole(decision)}
