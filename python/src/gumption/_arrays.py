"""Arrays of quantities, with their correlations."""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from gumption import _notebook
from gumption._formula import call
from gumption._quantities import as_input
from gumption._quantity import Quantity, covariance_of, evaluated, model_of
from gumption._shapes import Input

if TYPE_CHECKING:
    from gumption._model import Model
    from gumption._result import Result

Numbers = npt.NDArray[np.float64]


#: So many quantities of an array are evaluated at once.
_TOGETHER = 64


class Quantities(np.ndarray[Any, np.dtype[Any]]):
    """An array of quantities; `array` and `correlated` make it.

    Operators and functions of NumPy work element by element, and so do sums, products, ``@`` and the
    methods of arrays. Of ``numpy.linalg`` there are ``inv``, ``solve`` and ``det``.
    """

    @property
    def estimate(self) -> Any:
        """The estimates."""
        return self._each("estimate")[0]

    @property
    def u(self) -> Any:
        """The standard uncertainties."""
        return self._each("standard_uncertainty")[0]

    @property
    def U(self) -> Any:  # noqa: N802 - the symbol of the GUM
        """The expanded uncertainties for 95.45 %, as `Quantity.U`."""
        return self._each("expanded_uncertainty")[0]

    @property
    def dof(self) -> Any:
        """The effective degrees of freedom."""
        return self._each("dof")[0]

    @property
    def unit(self) -> Any:
        """The unit, if all have the same; else an array of units."""
        units = [of._unit for of in self._quantities()]
        if len(set(units)) == 1:
            return units[0]
        return np.array(units).reshape(self.shape)

    @property
    def correlation(self) -> Numbers:
        """The correlation matrix of the quantities in the order of ``ravel()``, by the law of propagation."""
        return evaluated(self._outputs(None), trials=0).correlations()

    @property
    def covariance(self) -> Numbers:
        """The covariance matrix of the quantities in the order of ``ravel()``, by the law of propagation."""
        return covariance_of(evaluated(self._outputs(None), trials=0))

    def model(self, names: Sequence[str] | None = None, *, title: str | None = None) -> Model:
        """One model of all quantities.

        Parameters
        ----------
        names : sequence of str, optional
            The names of the outputs in the order of ``ravel()``; ``y1``, ``y2`` and so on unless given.
        title : str, optional
            The title of its pages.
        """
        return model_of(self._outputs(names), title=title)

    def run(
        self,
        trials: int | float | str | None = None,
        seed: int | None = None,
        *,
        names: Sequence[str] | None = None,
        **options: Any,
    ) -> Result:
        """Evaluate all quantities together, as `Model.run` does.

        Parameters
        ----------
        trials, seed, **options
            As of `Model.run`.
        names : sequence of str, optional
            The names of the outputs, as of `model`.
        """
        return evaluated(self._outputs(names), trials, seed, **options)

    def _quantities(self) -> list[Quantity]:
        return [_quantity(of, "an entry") for of in np.asarray(self, dtype=object).ravel()]

    def _outputs(self, names: Sequence[str] | None) -> dict[str, Quantity]:
        """The quantities by the names of outputs."""
        quantities = self._quantities()
        if names is None:
            names = [f"y{place}" for place in range(1, len(quantities) + 1)]
        if len(names) != len(quantities):
            raise ValueError(f"`names`: {len(names)} are given for {len(quantities)} quantities")
        if len(set(names)) != len(names):
            raise ValueError("`names`: one name is given twice")
        return dict(zip(names, quantities))

    def _each(self, *names: str) -> list[Numbers]:
        """Figures by the law of propagation, an array for each."""
        outputs = list(self._outputs(None).items())
        figures: list[list[float]] = []
        # together they would have a coefficient for each input of any of them
        for start in range(0, len(outputs), _TOGETHER):
            result = evaluated(dict(outputs[start : start + _TOGETHER]), trials=0)
            figures += [[getattr(of.gum, name) for name in names] for of in result.values()]
        columns = np.array(figures, dtype=float).reshape(len(outputs), len(names)).T
        return [column.reshape(self.shape) for column in columns]

    def __repr__(self) -> str:
        return f"gumption.array({self._written_out(', ')})"

    def __str__(self) -> str:
        return self._written_out(" ")

    def _repr_html_(self) -> str:
        if self.ndim != 1 or any(of._is_complex for of in self._quantities()):
            return _notebook.text(str(self))
        figures = self._each("estimate", "standard_uncertainty", "expanded_uncertainty")
        units = np.broadcast_to(np.asarray(self.unit), self.shape)
        return _notebook.whole([_notebook.estimates({"unit": units}, *figures)])

    def _written_out(self, separator: str) -> str:
        plain = np.asarray(self, dtype=object)
        return np.array2string(plain, separator=separator, formatter={"object": str})

    def to(self, unit: str) -> Quantities:
        """The same quantities in another unit.

        Parameters
        ----------
        unit : str
            The unit.
        """
        return _shaped([of.to(unit) for of in self._quantities()], self.shape)

    # comparisons are quantities, of which numpy would ask the truth
    def __lt__(self, other: Any) -> Any:
        return _elementwise(operator.lt, self, other)

    def __le__(self, other: Any) -> Any:
        return _elementwise(operator.le, self, other)

    def __gt__(self, other: Any) -> Any:
        return _elementwise(operator.gt, self, other)

    def __ge__(self, other: Any) -> Any:
        return _elementwise(operator.ge, self, other)

    def __eq__(self, other: object) -> Any:
        return _elementwise(operator.eq, self, other)

    def __ne__(self, other: object) -> Any:
        return _elementwise(operator.ne, self, other)

    def __array_function__(self, function: Any, types: Any, arguments: Any, options: Any) -> Any:
        if function in _LINEAR and not options:
            found = _LINEAR[function](*arguments)
            return found.view(Quantities) if isinstance(found, np.ndarray) else found
        if function is np.where and len(arguments) == 3 and not options:
            return chosen(*arguments)
        made = super().__array_function__(function, types, arguments, options)
        return made.view(Quantities) if isinstance(made, np.ndarray) and made.dtype == object else made

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        # the sum of all is a quantity, and no array without axes
        found = np.asarray(array)
        return found.flat[0] if found.ndim == 0 else found.view(Quantities)


def _elementwise(function: Callable[..., Any], *values: Any) -> Any:
    """The results of a function of one element of each array, whatever it makes of these."""
    found = np.frompyfunc(function, len(values), 1)(*(np.asarray(value, dtype=object) for value in values))
    return found.view(Quantities) if isinstance(found, np.ndarray) else found


def chosen(condition: Any, first: Any, second: Any) -> Quantities:
    """``numpy.where`` element by element.

    Parameters
    ----------
    condition, first, second : array_like
        The conditions, and what is chosen where they hold and where they do not.
    """
    return np.asarray(_elementwise(_chosen, condition, first, second), dtype=object).view(Quantities)


def _chosen(condition: Any, first: Any, second: Any) -> Any:
    if isinstance(condition, Quantity):
        return call("if", [condition, first, second])
    return first if condition else second


def _quantity(value: Any, name: str) -> Quantity:
    return value if isinstance(value, Quantity) else as_input(value, name)


def array(
    values: npt.ArrayLike,
    u: npt.ArrayLike | None = None,
    unit: str | None = None,
    *,
    dof: npt.ArrayLike | None = None,
    correlation: npt.ArrayLike | None = None,
    covariance: npt.ArrayLike | None = None,
    names: Sequence[str] | None = None,
) -> Quantities:
    """An array of quantities.

    Parameters
    ----------
    values : array_like
        Estimates, in `unit`; or quantities, which stay what they are, if nothing else is given.
    u : array_like, optional
        Standard uncertainties in `unit`: one for each value, or one for all.
    unit : str, optional
        The unit of all.
    dof : array_like, optional
        Degrees of freedom, one for each value, or one for all.
    correlation : array_like, optional
        The correlation matrix of the values in the order of ``ravel()``.
    covariance : array_like, optional
        Their covariance matrix in ``unit^2``, in place of `u` and `correlation`.
    names : sequence of str, optional
        Names in formulas and budgets.

    Returns
    -------
    Quantities

    Examples
    --------
    >>> x = gumption.array([1.0, 2.0], 0.1, "V", correlation=[[1, 0.5], [0.5, 1]])
    >>> print(x.sum())
    3.00(17) V
    """
    found = np.asarray(values)
    if found.dtype == object:
        others = (u, unit, dof, correlation, covariance, names)
        if any(value is not None for value in others):
            raise TypeError("`values` are quantities, which have their uncertainties and units; give them alone")
        made = [_quantity(value, "`values`") for value in found.ravel()]
        return _shaped(made, found.shape)
    if np.iscomplexobj(found):
        raise TypeError("`values` are complex; gumption.complex_normal makes a complex quantity of each")
    estimates = np.asarray(found, dtype=float)
    count = estimates.size
    matrix = None
    if covariance is not None:
        if u is not None or correlation is not None:
            raise TypeError("`covariance` is given in place of `u` and `correlation`; give either")
        matrix = _square(covariance, count, "covariance")
        variances = np.diag(matrix)
        if (variances < 0).any():
            raise ValueError("`covariance`: a variance is below 0")
        widths = np.sqrt(variances)
        scale = np.where(widths > 0, widths, 1.0)
        matrix = matrix / np.outer(scale, scale)
    else:
        if u is None:
            raise TypeError("`u` or `covariance` is needed")
        widths = _for_each(u, estimates.shape, "u")
        if correlation is not None:
            matrix = _square(correlation, count, "correlation")
    if names is not None and len(names) != count:
        raise ValueError(f"`names`: {len(names)} are given for {count} values")
    freedom = np.full(count, np.inf) if dof is None else _for_each(dof, estimates.shape, "dof")
    inputs = []
    for place, (x, width) in enumerate(zip(estimates.ravel(), widths)):
        own = as_input((x, width, freedom[place]), "`values`")
        inputs.append(Input(own.spec, unit, name=names[place] if names is not None else ""))
    return _shaped(inputs if matrix is None else _linked(inputs, matrix), estimates.shape)


def correlated(inputs: Sequence[Input], correlation: npt.ArrayLike) -> Quantities:
    """Inputs with declared correlation coefficients.

    The objects that it returns are the same quantities as those that are given. Give the returned ones to
    whatever the correlation is to have an effect on: an expression of the given ones alone does not have it.

    Parameters
    ----------
    inputs : sequence of Input
        The inputs, of any distribution.
    correlation : array_like
        Their correlation matrix.

    Examples
    --------
    >>> a, b = gumption.correlated([gumption.normal(1, 0.1), gumption.normal(2, 0.1)], [[1, -1], [-1, 1]])
    >>> (a + b).u
    0.0
    """
    for value in inputs:
        if not isinstance(value, Input):
            raise TypeError(f"`inputs`: an input is needed, not a {type(value).__name__}")
    if len({value.identity for value in inputs}) < len(inputs):
        raise ValueError("`inputs`: one quantity is given twice, and is fully correlated with itself")
    return _shaped(_linked(inputs, _square(correlation, len(inputs), "correlation")), (len(inputs),))


def complex_normal(
    value: complex,
    u: Any = None,
    unit: str | None = None,
    *,
    correlation: float | None = None,
    covariance: npt.ArrayLike | None = None,
    dof: float | None = None,
    name: str = "",
) -> Any:
    """A complex quantity whose real and imaginary part have a normal distribution.

    Any complex expression is made by ``x + 1j*y`` or ``r*np.exp(1j*phi)`` of real quantities as well.

    Parameters
    ----------
    value : complex
        The estimate.
    u : float or pair of float, optional
        The standard uncertainties of the real and the imaginary part, or one for both.
    unit : str, optional
        The unit.
    correlation : float, optional
        The correlation coefficient of the two parts; 0 unless given.
    covariance : array_like, optional
        Their covariance matrix, in place of `u` and `correlation`.
    dof : float, optional
        The degrees of freedom.
    name : str, optional
        A name; the parts are called ``NAME_re`` and ``NAME_im``.

    Examples
    --------
    >>> z = gumption.complex_normal(3 + 4j, 0.1)
    >>> print(abs(z))
    5.00(10)
    """
    value = complex(value)
    matrix = None
    if correlation is not None:
        matrix = [[1.0, correlation], [correlation, 1.0]]
    names = [f"{name}_re", f"{name}_im"] if name else None
    parts = [value.real, value.imag]
    re, im = array(parts, u, unit, dof=dof, correlation=matrix, covariance=covariance, names=names)
    return re + 1j * im


def _shaped(quantities: Sequence[Quantity], shape: tuple[int, ...]) -> Quantities:
    made = np.empty(len(quantities), dtype=object)
    for place, quantity in enumerate(quantities):
        made[place] = quantity
    return made.reshape(shape).view(Quantities)


def _linked(inputs: Sequence[Input], matrix: Numbers) -> list[Input]:
    """The inputs with a correlation matrix."""
    if not np.allclose(np.diag(matrix)[[of.spec.get("distribution") != "constant" for of in inputs]], 1.0):
        raise ValueError("a correlation matrix has ones on its diagonal")
    if not np.allclose(matrix, matrix.T, rtol=1e-9, atol=1e-12):
        raise ValueError("a matrix of correlations or covariances is symmetric")
    if (abs(matrix) > 1 + 1e-12).any():
        raise ValueError("a correlation coefficient is outside -1 to 1")
    made = []
    for row, of in enumerate(inputs):
        links = dict(of.links)
        for column, other in enumerate(inputs):
            r = float(np.clip(matrix[min(row, column), max(row, column)], -1.0, 1.0))
            if row == column or r == 0.0:
                continue
            if links.setdefault(other.identity, r) != r:
                raise ValueError("two of the inputs have another correlation coefficient already")
        made.append(Input(of.spec, of.unit, of.held, of.identity, of.parts, of.name, links))
    return made


def _square(matrix: npt.ArrayLike, count: int, name: str) -> Numbers:
    found = np.asarray(matrix, dtype=float)
    if found.shape != (count, count):
        raise ValueError(f"`{name}`: a matrix of {count} rows and columns is needed, not of {found.shape}")
    if not np.isfinite(found).all():
        raise ValueError(f"`{name}`: a number is not finite")
    return found


def _for_each(values: npt.ArrayLike, shape: tuple[int, ...], name: str) -> Numbers:
    found = np.asarray(values, dtype=float)
    try:
        return np.broadcast_to(found, shape).ravel()
    except ValueError:
        raise ValueError(
            f"`{name}`: one number or an array of the shape {shape} is needed, not of {found.shape}"
        ) from None


# linear algebra


def _eliminated(matrix: Any, right: Any) -> tuple[Any, Any]:
    """The solution of linear equations and the determinant, by Gauss's elimination.

    Pivots are the largest estimates of a column. The result is an expression, so that its
    derivatives are exact.
    """
    a = np.array(matrix, dtype=object)
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise np.linalg.LinAlgError(f"a square matrix is needed, not one of {a.shape}")
    b = np.array(right, dtype=object)
    if b.shape[0] != a.shape[0]:
        raise np.linalg.LinAlgError(f"the right side has {b.shape[0]} rows, the matrix {a.shape[0]}")
    estimates = np.vectorize(lambda of: of.estimate if isinstance(of, Quantity) else of, otypes=[object])(a)
    estimates = estimates.astype(complex)
    determinant: Any = 1
    for step in range(len(a)):
        pivot = step + int(np.argmax(abs(estimates[step:, step])))
        if estimates[pivot, step] == 0:
            raise np.linalg.LinAlgError("the matrix of the estimates is singular")
        if pivot != step:
            for rows in (a, b, estimates):
                rows[[step, pivot]] = rows[[pivot, step]]
            determinant = -determinant
        determinant = determinant * a[step, step]
        for row in range(step + 1, len(a)):
            factor = a[row, step] / a[step, step]
            estimates[row] -= estimates[row, step] / estimates[step, step] * estimates[step]
            for column in range(step + 1, len(a)):
                a[row, column] = a[row, column] - factor * a[step, column]
            b[row] = b[row] - factor * b[step]
    for step in reversed(range(len(a))):
        for column in range(step + 1, len(a)):
            b[step] = b[step] - a[step, column] * b[column]
        b[step] = b[step] / a[step, step]
    return b, determinant


def _solved(matrix: Any, right: Any) -> Any:
    return _eliminated(matrix, right)[0]


def _inverse(matrix: Any) -> Any:
    # a sum with a quantity of another unit cannot begin with the number 0
    size = len(matrix)
    columns = []
    for column in range(size):
        unit = np.zeros(size)
        unit[column] = 1.0
        columns.append(_eliminated(matrix, unit)[0])
    return np.array(columns, dtype=object).T


def _determinant(matrix: Any) -> Any:
    return _eliminated(matrix, np.zeros(len(matrix)))[1]


_LINEAR: dict[Any, Callable[..., Any]] = {
    np.linalg.inv: _inverse, np.linalg.solve: _solved, np.linalg.det: _determinant,
}  # fmt: skip
