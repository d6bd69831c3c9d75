"""Quantities as numbers: expressions of inputs and of outputs of results.

An operator or a function of NumPy on a quantity makes an `Expression`. It computes nothing: it is a
formula over its inputs, and its figures come from the model of this formula. So a quantity that occurs
twice is one quantity, and ``x - x`` is 0 with a standard uncertainty of 0.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, Union, cast

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._formula import Term, Writer, angle_in, angle_of, binary, cut, is_about, unit_within

if TYPE_CHECKING:
    from gumption._model import Model
    from gumption._result import Budget, Output, Result

#: What a function makes of the unit of its argument.
_OF_NUMBERS = {
    "exp": "1", "expm1": "1", "ln": "1", "log10": "1", "log1p": "1",
    "sinh": "1", "cosh": "1", "tanh": "1", "asinh": "1", "acosh": "1", "atanh": "1",
    "sin": "1", "cos": "1", "tan": "1", "asin": "rad", "acos": "rad", "atan": "rad",
    "floor": "1", "ceil": "1",
}  # fmt: skip

_ROOTS = {"sqrt": 2, "cbrt": 3}

#: Parts of a complex number, which are real.
_PARTS = {"abs", "arg", "re", "im"}

#: Comparisons, and how they compare numbers.
_COMPARED = {
    "<": float.__lt__, "<=": float.__le__, ">": float.__gt__, ">=": float.__ge__,
    "==": float.__eq__, "!=": float.__ne__,
}  # fmt: skip

_fit = lru_cache(maxsize=4096)(_gumption.units_fit)
_product_of = lru_cache(maxsize=4096)(lambda parts: _gumption.unit_product(list(parts)))


def _has_zero(unit: str) -> bool:
    return bool(unit_within(unit)[1])


def _product(*parts: tuple[str, int, int]) -> str:
    return str(_product_of(parts))


class ComplexUncertainty(NamedTuple):
    """The standard uncertainties of the parts of a complex quantity."""

    real: float
    imag: float


class Quantity(Term):
    """A quantity: an input, an output of a result, or an expression of such.

    Operators and functions of NumPy make an `Expression`. Numbers in it are exact and have the unit 1.
    Dimensions are checked at each operation, and angles are converted to radians.

    Figures by the law of propagation (JCGM 100) are attributes: `estimate`, `u`, `U`, `k`, `dof` and
    `budget`. `run` gives the Monte Carlo figures (JCGM 101) beside them.
    """

    __slots__ = ()

    @property
    def _unit(self) -> str:
        """Its unit, which is 1 where none was given."""
        raise NotImplementedError

    @property
    def _as_text(self) -> str | None:
        """What it is in a formula, if it has no name there."""
        return None

    @property
    def _is_complex(self) -> bool:
        return False

    @property
    def _is_exact(self) -> bool:
        """Whether no quantity in it is uncertain."""
        return False

    def _leaves(self) -> Iterator[Quantity]:
        """The inputs and outputs in it, in the order of their first use, some of them more than once."""
        yield self

    # terms

    def _made(self, symbol: str, operands: tuple[Term, ...]) -> Quantity:
        for operand in operands:
            if not isinstance(operand, Quantity):
                raise TypeError(
                    "a model function has its quantities as arguments; make the quantity from outside an argument"
                )
        given = cast("tuple[Quantity, ...]", operands)
        kind = Comparison if symbol in _COMPARED else Expression
        return kind(symbol, given, _unit_of(symbol, given))

    def _written(self, text: str, value: complex) -> Quantity:
        return Expression(text, (), "1", value)

    def _foreign(self, what: str) -> NoReturn:
        raise TypeError(what)

    def _array(self, found: Any) -> Any:
        from gumption._arrays import Quantities

        return found.view(Quantities)

    def __array_function__(self, function: Any, types: Any, arguments: Any, options: Any) -> Any:
        is_array = any(isinstance(value, (list, tuple, np.ndarray)) for value in arguments)
        if function is np.where and len(arguments) == 3 and is_array:
            from gumption._arrays import chosen

            return chosen(*arguments)
        return super().__array_function__(function, types, arguments, options)

    @property
    def angle(self) -> float | None:
        return angle_in(self._unit)

    def _shown(self) -> str:
        names, _ = _named([self], set())
        return cut(Writer([self], (), _name_by(names)).whole(self))

    def _part(self, name: str) -> Any:
        return self if name in ("re", "conj") and not self._is_complex else super()._part(name)

    # figures

    def model(self, name: str | None = None, *, title: str | None = None) -> Model:
        """The model of which this quantity is the output.

        Parameters
        ----------
        name : str, optional
            The name of the output; ``y``, or ``y_2`` where an input is called ``y``.
        title : str, optional
            The title of its pages; the formula unless given.
        """
        return model_of({name or self._own_name(): self}, title=title)

    def _own_name(self) -> str:
        from gumption._joint import is_output

        return _free("y", {leaf.symbol for leaf in self._leaves() if not is_output(leaf)}, {})

    def run(
        self, trials: int | float | str | None = None, seed: int | None = None, *, name: str | None = None, **options: Any
    ) -> Result:
        """Evaluate by the law of propagation and by Monte Carlo, as `Model.run` does.

        Parameters
        ----------
        trials, seed, **options
            As of `Model.run`.
        name : str, optional
            The name of the output; ``y``, or ``y_2`` where an input is called ``y``.
        """
        return evaluated({name or self._own_name(): self}, trials, seed, **options)

    def _propagated(self) -> Result:
        """The result by the law of propagation; of a complex quantity of its real and its imaginary part."""
        parts = {"re": self.real, "im": self.imag} if self._is_complex else {self._own_name(): self}
        return evaluated(parts, trials=0)

    def _evaluated(self) -> Output:
        return next(iter(self._propagated().values()))

    def _figure(self, name: str) -> float:
        return float(getattr(self._evaluated().gum, name))

    def _figures(self, name: str) -> list[float]:
        """A figure of the real and the imaginary part."""
        return [float(getattr(part.gum, name)) for part in self._propagated().values()]

    @property
    def estimate(self) -> Any:
        """The estimate; of a complex quantity a complex number."""
        return complex(*self._figures("estimate")) if self._is_complex else self._figure("estimate")

    @property
    def u(self) -> Any:
        """The standard uncertainty; of a complex quantity those of its parts."""
        if self._is_complex:
            return ComplexUncertainty(*self._figures("standard_uncertainty"))
        return self._figure("standard_uncertainty")

    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """Of a complex quantity the covariance matrix of its real and imaginary part; else its variance."""
        return covariance_of(self._propagated()) if self._is_complex else np.array([[self.u**2]])

    @property
    def dof(self) -> float:
        """The effective degrees of freedom (JCGM 100, G.4)."""
        self._refuse_complex("dof")
        return self._figure("dof")

    @property
    def k(self) -> float:
        """The coverage factor for 95.45 %, 2 for infinite degrees of freedom; `run` takes another one."""
        self._refuse_complex("k")
        return self._figure("coverage_factor")

    @property
    def U(self) -> float:  # noqa: N802 - the symbol of the GUM
        """The expanded uncertainty for 95.45 %, 2 u for infinite degrees of freedom; `run` takes another k or p."""
        self._refuse_complex("U")
        return self._figure("expanded_uncertainty")

    @property
    def budget(self) -> Budget:
        """The budget."""
        self._refuse_complex("budget")
        return self._evaluated().budget

    def _refuse_complex(self, what: str) -> None:
        if self._is_complex:
            raise TypeError(f"`{what}` is of a real quantity; take `.real`, `.imag`, `abs(...)` or `np.angle(...)`")

    def to(self, unit: str) -> Expression:
        """The same quantity in another unit.

        Parameters
        ----------
        unit : str
            The unit, such as ``"mm"`` or ``"kg/m^3"``.

        Raises
        ------
        ModelError
            If the unit has another dimension, or counts from another zero.
        """
        own = self._unit
        if not _fit(own, unit):
            _gumption.unit_scale(unit)
            raise _gumption.ModelError(f"a quantity in {own} is none in {unit}")
        if _has_zero(own) != _has_zero(unit):
            raise _gumption.ModelError(
                f"a quantity in {own} can be in {unit} a value from its zero or a difference: `gumption.kelvin(t)` and "
                "`gumption.celsius(T)` convert temperatures, and a difference comes of `t1 - t2`"
            )
        return Expression("", (self,), unit)

    # what Python asks of a number

    def _as_number(self, what: str) -> float:
        if not self._is_exact:
            raise TypeError(
                f"{what} of a quantity that has an uncertainty: `.estimate` is its estimate, `.u` its standard "
                "uncertainty; functions are those of numpy (`np.sin` in place of `math.sin`)"
            )
        self._refuse_complex(what)
        return float(self.estimate)

    def __float__(self) -> float:
        return self._as_number("float()")

    def __int__(self) -> int:
        return int(self._as_number("int()"))

    def __complex__(self) -> complex:
        if self._is_exact and self._is_complex:
            return complex(self.estimate)
        return complex(self._as_number("complex()"))

    def __round__(self, digits: int | None = None) -> float:
        return round(self._as_number("round()"), digits)

    def __bool__(self) -> bool:
        return self._as_number("whether something is 0,") != 0.0

    def __eq__(self, other: object) -> Any:
        return binary("==", self, other)

    def __ne__(self, other: object) -> Any:
        return binary("!=", self, other)

    # a quantity is a key by what it is, and not by its value
    def __hash__(self) -> int:
        return id(self)

    def __str__(self) -> str:
        unit = "" if self._unit == "1" else f" {self._unit}"
        if self._is_complex:
            re, im = map(_shorthand, self._figures("estimate"), self._figures("standard_uncertainty"))
            return f"({re}{'' if im.startswith('-') else '+'}{im}j){unit}"
        gum = self._evaluated().gum
        return f"{_shorthand(gum.estimate, gum.standard_uncertainty)}{unit}"

    def __format__(self, form: str) -> str:
        if form:
            raise TypeError(
                f"a quantity has no format `{form}`: `{{x.estimate:{form}}}` and `{{x.u:{form}}}` write out its figures"
            )
        return str(self)


class Expression(Quantity):
    """A formula of quantities, with its unit; operators and functions of NumPy make it.

    Its unit follows from those of its operands: that of a sum is the unit of the first summand with one,
    and those of products, powers and roots are combined. `to` gives it another one.
    """

    __slots__ = ("_angle", "_done", "_of_complex", "_of_exact", "unit")

    def __init__(
        self,
        symbol: str,
        operands: tuple[Quantity, ...],
        unit: str,
        literal: complex | None = None,
    ) -> None:
        super().__init__(symbol, operands, literal)
        self.unit = unit
        self._done: Result | None = None
        of_complex, of_exact = isinstance(literal, complex) and not operands, True
        for operand in operands:
            of_complex = of_complex or operand._is_complex
            of_exact = of_exact and operand._is_exact
        self._of_complex = of_complex and symbol not in _PARTS
        self._of_exact = of_exact
        self._angle = angle = angle_of(symbol, operands) if operands else None
        if angle is None:
            return
        for factor, what in ((math.pi / 180, "to"), (180 / math.pi, "from")):
            if is_about(angle, factor):
                raise _gumption.ModelError(
                    f"`{self._shown()}` converts an angle {what} radians, but expressions compute with angles in "
                    "radians already, whatever their unit; leave the conversion out, and choose the unit of the "
                    "result by `.to(...)`"
                )

    @property
    def angle(self) -> float | None:
        return self._angle

    @property
    def _unit(self) -> str:
        return self.unit

    @property
    def _is_complex(self) -> bool:
        return self._of_complex

    @property
    def _is_exact(self) -> bool:
        return self._of_exact

    def _leaves(self) -> Iterator[Quantity]:
        seen: set[int] = set()
        left: list[Term] = [self]
        found: list[Quantity] = []
        while left:
            one = left.pop()
            if one.number in seen:
                continue
            seen.add(one.number)
            if isinstance(one, Expression):
                left.extend(reversed(one.operands))
            else:
                assert isinstance(one, Quantity)
                found.append(one)
        yield from found

    def _propagated(self) -> Result:
        if self._done is None:
            self._done = super()._propagated()
        return self._done

    def __repr__(self) -> str:
        return f"<gumption.{type(self).__name__} {self._shown()} = {self}>"

    def latex(self) -> str:
        """The formula in the mathematical mode of LaTeX, and its estimate with the standard uncertainty."""
        value, _, unit = str(self).partition(" ")
        shown = f"{value}\\,{_notebook.latex(unit)}" if unit else value
        return f"{_gumption.equation_latex(self._shown())} = {shown}"

    def _repr_latex_(self) -> str:
        return f"$${self.latex()}$$"

    def _repr_html_(self) -> str:
        value = _notebook.table(["", "estimate and standard uncertainty"], [[_notebook.formula(self._shown()), self]])
        inputs = {name: leaf for name, leaf in formulas({"": self}, ())[1].items() if hasattr(leaf, "spec")}
        known = {name: leaf.to_dict() for name, leaf in inputs.items()}
        return _notebook.whole([value, *([_notebook.inputs(known)] if known else [])])

    def __reduce__(self) -> Any:
        return _rebuilt, (_flat(self),)


#: A term of an expression: a quantity, or an operation on terms before it.
_Flat = Union[Quantity, tuple[type[Expression], str, tuple[int, ...], str, "complex | None"]]


def _flat(expression: Expression) -> list[_Flat]:
    """The terms of an expression in their order, which is no deeper for a long one."""
    reached: dict[int, Quantity] = {}
    left: list[Term] = [expression]
    while left:
        one = left.pop()
        if one.number not in reached:
            assert isinstance(one, Quantity)
            reached[one.number] = one
            left.extend(one.operands)
    order = sorted(reached)
    place = {number: index for index, number in enumerate(order)}
    found: list[_Flat] = []
    for number in order:
        one = reached[number]
        if isinstance(one, Expression):
            operands = tuple(place[operand.number] for operand in one.operands)
            found.append((type(one), one.symbol, operands, one.unit, one.literal))
        else:
            found.append(one)
    return found


def _rebuilt(terms: list[_Flat]) -> Quantity:
    made: list[Quantity] = []
    for term in terms:
        if isinstance(term, Quantity):
            made.append(term)
        else:
            kind, symbol, operands, unit, literal = term
            made.append(kind(symbol, tuple(made[place] for place in operands), unit, literal))
    return made[-1]


class Comparison(Expression):
    """A comparison of quantities: 1 where it holds, else 0.

    It is no truth value, unless what is compared is known exactly or is one quantity. It has a
    probability, and ``np.where`` takes it as the condition of a choice.
    """

    __slots__ = ()

    def probability(self, trials: int | None = None, seed: int | None = None) -> float:
        """The probability that it holds, by Monte Carlo.

        Parameters
        ----------
        trials : int, optional
            Number of trials; the default of `Model.run` unless given.
        seed : int, optional
            Seed of the random streams.
        """
        found = next(iter(self.run(trials=trials, seed=seed).values()))
        # the share of the trials, which is one however rare it is
        return float(np.mean(found.samples()))

    def __and__(self, other: Any) -> Comparison:
        return self._with("*", other)

    def __or__(self, other: Any) -> Comparison:
        return self._with("max", other)

    def __invert__(self) -> Comparison:
        return Comparison("-", (self._written("1", 1.0), self), "1")

    def _with(self, symbol: str, other: Any) -> Comparison:
        if not isinstance(other, Comparison):
            raise TypeError(f"a comparison is combined with another one, not with a {type(other).__name__}")
        return Comparison(symbol, (self, other), "1")

    def __bool__(self) -> bool:
        if self.symbol not in _COMPARED:
            raise TypeError(f"`{self._shown()}` is neither true nor false; it has a `.probability()`")
        first, second = self.operands
        assert isinstance(first, Quantity) and isinstance(second, Quantity)
        difference = first - second
        if difference._is_complex:
            known = difference.u == (0.0, 0.0)
        else:
            known = difference._is_exact or difference.u == 0.0
        if known:
            value = difference.estimate
            if isinstance(value, complex):
                return (value == 0) == (self.symbol == "==")
            return bool(_COMPARED[self.symbol](value, 0.0))
        raise TypeError(
            f"`{self._shown()}` is neither true nor false, as quantities in it are uncertain: `.probability()` of the "
            "comparison is the probability that it holds, `.estimate` of both sides compares the estimates, and "
            "`np.where(...)` chooses in each trial"
        )

    def __repr__(self) -> str:
        return f"<gumption.Comparison {self._shown()}>"

    __str__ = __repr__

    def latex(self) -> str:
        """The comparison in the mathematical mode of LaTeX."""
        return _gumption.equation_latex(self._shown())

    def _repr_html_(self) -> str:
        return _notebook.whole([_notebook.formula(self._shown())])


def _shorthand(estimate: float, u: float) -> str:
    """An estimate with its standard uncertainty in parentheses (JCGM 100, 7.2.2)."""
    if not (u > 0 and math.isfinite(u) and math.isfinite(estimate)):
        return f"{estimate:.7g}"
    y, digits = _gumption.printed(estimate, u)
    if "e" in y:
        return f"({y} +/- {digits})"
    if u >= 1:
        # with a point in it the uncertainty is written as it is
        return f"{y}({digits})"
    decimals = len(y.partition(".")[2])
    return f"{y}({u * 10**decimals:.0f})"


def _unit_of(symbol: str, operands: tuple[Quantity, ...]) -> str:
    """The unit of the result of an operation, whose dimensions are checked."""
    units = [operand._unit for operand in operands]
    if symbol in _OF_NUMBERS:
        _check_number(symbol, units[0])
        return _OF_NUMBERS[symbol]
    if symbol == "atan2":
        _check_same(symbol, operands, units)
        return "rad"
    if symbol == "arg":
        return "rad"
    if symbol in _ROOTS:
        return _product((units[0], 1, _ROOTS[symbol]))
    if symbol == "*":
        return _product((units[0], 1, 1), (units[1], 1, 1))
    if symbol == "/":
        return _product((units[0], 1, 1), (units[1], -1, 1))
    if symbol == "^":
        return _power(units, operands[1])
    if symbol == "if":
        _check_same(symbol, operands[1:], units[1:])
        return _first(operands[1:], units[1:])
    if len(operands) == 1:
        return units[0]
    _check_same(symbol, operands, units)
    if symbol in _COMPARED:
        return "1"
    zeros = [unit for unit in units if _has_zero(unit)]
    if symbol == "-" and len(zeros) == 2:
        return _gumption.unit_of_differences(units[0])
    if symbol in "+-" and zeros:
        return zeros[0]
    return _first(operands, units)


def _first(operands: tuple[Quantity, ...], units: list[str]) -> str:
    """The unit of the first of several quantities of one dimension that is not a plain number."""
    return next((unit for of, unit in zip(operands, units) if of.literal is None), units[0])


def _power(units: list[str], exponent: Quantity) -> str:
    if units[0] == "1":
        return "1"
    if not isinstance(exponent.literal, float):
        if _fit(units[0], "1"):
            return "1"
        raise _gumption.ModelError(
            f"`{exponent._shown()}` is the exponent of a quantity in {units[0]}; it has to be a number that is known exactly"
        )
    numerator, denominator = exponent.literal.as_integer_ratio()
    if exponent.operands and exponent.symbol == "/":
        numerator, denominator = (int(part.literal) for part in exponent.operands)
    if max(abs(numerator), denominator) > 1000:
        raise _gumption.ModelError(
            f"a quantity in {units[0]} to the power {exponent.literal} has no unit; exponents are ratios of small integers"
        )
    return _product((units[0], numerator, denominator))


def _check_number(symbol: str, unit: str) -> None:
    if not _fit(unit, "1"):
        raise _gumption.ModelError(
            f"`{symbol}` takes a plain number{' or an angle' if symbol in ('sin', 'cos', 'tan') else ''}, and is given a "
            f"quantity in {unit}; divide it by one of its dimension, such as `gumption.constant(1, \"{unit}\")`"
        )


def _check_same(symbol: str, operands: Iterable[Quantity], units: list[str]) -> None:
    angle = next((unit for unit in units if angle_in(unit) and unit != "rad" and _fit(unit, "1")), None)
    for operand in operands:
        if angle is not None and operand.literal:
            raise _gumption.ModelError(
                f"the number {operand.literal:g} beside an angle in {angle} can be in {angle} or in rad; "
                f"`gumption.constant({operand.literal:g}, \"{angle}\")` says which"
            )
    for operand, unit in zip(operands, units):
        if not _fit(units[0], unit):
            number = next((of for of in operands if of.literal is not None), None)
            what = {"+": "added", "-": "subtracted", "if": "alternatives"}.get(symbol, "compared")
            hint = ""
            if number is not None:
                other = next(unit for of, unit in zip(operands, units) if of.literal is None)
                hint = f"; a number is in the unit 1, `gumption.constant({number.literal:g}, \"{other}\")` has one"
            raise _gumption.ModelError(f"quantities in {units[0]} and {unit} cannot be {what}{hint}")


def _named(
    quantities: Iterable[Quantity], used: set[str]
) -> tuple[dict[object, str], dict[str, Quantity]]:
    """Names of the inputs and outputs in quantities by their identities, and these by their names."""
    from gumption._joint import identity_of
    from gumption._model import joined

    names: dict[object, str] = {}
    leaves: dict[str, Quantity] = {}
    numbers: dict[str, Iterator[int]] = {}
    for quantity in quantities:
        for leaf in quantity._leaves():
            identity = identity_of(leaf)
            if leaf._as_text is not None:
                continue
            if identity not in names:
                names[identity] = name = _free(leaf.symbol, used, numbers)
                leaves[name] = leaf
            else:
                leaves[names[identity]] = joined(leaves[names[identity]], leaf)
    return names, leaves


def _free(wanted: str, used: set[str], numbers: dict[str, Iterator[int]]) -> str:
    """A name that nothing has: the one that is wanted, or a number behind it; `i` is the imaginary unit.

    `numbers` has the next number behind each name, so that many inputs of one name do not count anew.
    """
    own = numbers.setdefault(wanted, itertools.count(2 if wanted else 1))
    name = wanted
    while name in ("", "i") or name in used:
        name = f"{wanted}_{next(own)}" if wanted else f"x{next(own)}"
    used.add(name)
    return name


def _name_by(names: Mapping[object, str]) -> Callable[[Term], str]:
    from gumption._joint import identity_of

    def name(term: Term) -> str:
        if isinstance(term, Expression):
            return term.symbol
        text = term._as_text if isinstance(term, Quantity) else None
        return names[identity_of(term)] if text is None else text

    return name


def formulas(
    quantities: Mapping[str, Quantity], taken: Iterable[str]
) -> tuple[dict[str, str], dict[str, Quantity]]:
    """Quantities as formulas, and the inputs in these by names that nothing else has.

    Parameters
    ----------
    quantities : mapping of str to Quantity
        What is written out, by its names.
    taken : iterable of str
        Further names that others have.
    """
    used = {*taken, *quantities}
    names, leaves = _named(quantities.values(), used)
    writer = Writer(quantities.values(), used, _name_by(names))
    own = {name: writer.whole(quantity) for name, quantity in quantities.items()}
    return {**writer.equations, **own}, leaves


def kelvin(t: Quantity) -> Expression:
    """The thermodynamic temperature of a Celsius temperature.

    Parameters
    ----------
    t : Quantity
        A temperature in degC or degF.

    Returns
    -------
    Expression
        In K.
    """
    if not isinstance(t, Quantity) or not _has_zero(t._unit) or not _fit(t._unit, "K"):
        raise TypeError("`t`: a quantity in degC or degF is needed")
    return Expression("kelvin", (t,), "K")


def celsius(T: Quantity) -> Expression:  # noqa: N803 - the symbol of a thermodynamic temperature
    """The Celsius temperature of a thermodynamic one.

    Parameters
    ----------
    T : Quantity
        A temperature in K.

    Returns
    -------
    Expression
        In degC.
    """
    if not isinstance(T, Quantity) or _has_zero(T._unit) or not _fit(T._unit, "K"):
        raise TypeError("`T`: a quantity in K is needed")
    return Expression("celsius", (T,), "degC")


def model_of(
    quantities: Mapping[str, Any], *, title: str | None = None, trials: int | str | None = None
) -> Model:
    """One model of several quantities, so that they are evaluated together.

    Parameters
    ----------
    quantities : mapping of str to Quantity
        The outputs by name.
    title : str, optional
        The title of its pages.
    trials : int or "adaptive", optional
        The number of trials, as in a model file; 0 for only the law of propagation.

    Returns
    -------
    Model

    Examples
    --------
    >>> v, i = gumption.normal(5, 0.01, "V"), gumption.normal(0.02, 1e-5, "A")
    >>> r = gumption.model_of({"R": v/i, "P": v*i}).run(trials=0)
    >>> round(r.correlations()[0, 1], 2)
    0.88
    """
    from gumption._model import Model, take_inputs, written

    if not isinstance(quantities, Mapping):
        raise TypeError("`quantities`: a mapping of names to quantities is needed, `{\"y\": y}`")
    if not quantities:
        raise ValueError("`quantities` names no output")
    for name, quantity in quantities.items():
        if not isinstance(quantity, Quantity):
            raise TypeError(f"`{name}`: a quantity is needed, not a {type(quantity).__name__}")
    equations, leaves = formulas(quantities, ())
    if title is None:
        title = "Expression " + cut("; ".join(f"{name} = {equations[name]}" for name in quantities))
    outputs: dict[str, Any] = {}
    for name, quantity in quantities.items():
        outputs[name] = {"unit": quantity._unit, **({"complex": "re-im"} if quantity._is_complex else {})}
    file: dict[str, Any] = {
        "format": 1, "title": title, "inputs": dict.fromkeys(leaves), "equations": equations, "outputs": outputs,
    }  # fmt: skip
    if trials is not None:
        file["monte_carlo"] = {"trials": trials}
    held, known = take_inputs(file, leaves, dict.fromkeys(leaves, "1"), {}, leaves)
    rust = _gumption.Model("<expression>", written(file), "", list(held.items()))
    return Model._of(rust, known=known)


def evaluated(
    quantities: Mapping[str, Quantity],
    trials: int | float | str | None = None,
    seed: int | None = None,
    **options: Any,
) -> Result:
    """The result of several quantities. Without trials the model says so: some inputs are for this alone.

    Parameters
    ----------
    quantities : mapping of str to Quantity
        The outputs by name.
    trials, seed, **options
        As of `Model.run`.
    """
    return model_of(quantities, trials=0 if trials == 0 else None).run(trials, seed, **options)


def covariance_of(result: Result) -> npt.NDArray[np.float64]:
    """The covariance matrix of the outputs, by the law of propagation.

    Parameters
    ----------
    result : Result
        A result without conditions. An output that is known exactly has no correlation, and the covariance 0.
    """
    u = np.array([output.gum.standard_uncertainty for output in result.values()], dtype=float)
    products = np.outer(u, u)
    matrix: npt.NDArray[np.float64] = np.where(products == 0, 0.0, result.correlations() * products)
    return matrix
