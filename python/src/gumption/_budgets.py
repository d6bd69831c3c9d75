"""Budgets of many measurements of one model at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._check import check_rows
from gumption._measurement import Measurement
from gumption._model import Model
from gumption._quantities import is_pint, is_ufloat, pint_unit

Column = npt.NDArray[np.float64]


class OutputBudgets:
    """The budgets of one output: columns of one entry a row.

    Attributes
    ----------
    name, unit : str
        Name and unit of the output.
    estimate, standard_uncertainty, dof, coverage_factor : ndarray
        Estimates, combined standard uncertainties, effective degrees of freedom (infinite if those
        of every contribution are, NaN if undefined) and coverage factors.
    sensitivities, contributions : dict of str to ndarray
        For each input its sensitivity coefficients and its contributions.
    """

    def __init__(self, name: str, unit: str, columns: Mapping[str, Any], index: Any = None) -> None:
        self._index = index
        self.name = name
        self.unit = unit
        self.estimate: Column = columns["estimate"]
        self.standard_uncertainty: Column = columns["standard_uncertainty"]
        self.dof: Column = columns["dof"]
        self.coverage_factor: Column = columns["coverage_factor"]
        self.sensitivities: dict[str, Column] = columns["sensitivities"]
        self.contributions: dict[str, Column] = columns["contributions"]

    @property
    def expanded_uncertainty(self) -> Column:
        """Expanded uncertainties U = k u(y)."""
        return self.coverage_factor * self.standard_uncertainty

    def to_pandas(self) -> Any:
        """The columns as a ``pandas.DataFrame``, contributions as ``u(input)``.

        Its index is that of the ``pandas`` columns given as input.
        """
        import pandas

        own = {
            "estimate": self.estimate,
            "standard_uncertainty": self.standard_uncertainty,
            "dof": self.dof,
            "coverage_factor": self.coverage_factor,
            "expanded_uncertainty": self.expanded_uncertainty,
        }
        parts = {f"u({name})": values for name, values in self.contributions.items()}
        return pandas.DataFrame({**own, **parts}, index=self._index)

    def __len__(self) -> int:
        return len(self.estimate)

    def _table(self) -> str:
        shown = _notebook.estimates(
            {"row": range(len(self))}, self.estimate, self.standard_uncertainty, self.expanded_uncertainty
        )
        return _notebook.title(f"{self.name} in {self.unit}") + shown

    def _repr_html_(self) -> str:
        return _notebook.whole([self._table()])

    def __repr__(self) -> str:
        return f"<gumption.OutputBudgets: {len(self)} of {self.name} in {self.unit}>"


class _All(Mapping[str, OutputBudgets]):
    """The budgets of all outputs by name.

    Of a model of one output the columns are attributes as well.
    """

    def __init__(self, outputs: Mapping[str, OutputBudgets]) -> None:
        self._outputs = dict(outputs)

    def __getitem__(self, name: str) -> OutputBudgets:
        return self._outputs[name]

    if TYPE_CHECKING:
        name: str
        unit: str
        estimate: Column
        standard_uncertainty: Column
        expanded_uncertainty: Column
        dof: Column
        coverage_factor: Column
        sensitivities: dict[str, Column]
        contributions: dict[str, Column]
    else:

        def __getattr__(self, name: str) -> Any:
            # of a model of one output the columns are at hand at once
            if not name.startswith("_") and len(self._outputs) == 1:
                return getattr(next(iter(self._outputs.values())), name)
            raise AttributeError(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def _repr_html_(self) -> str:
        return _notebook.whole([of._table() for of in self._outputs.values()])

    def __repr__(self) -> str:
        return f"<gumption.budgets: {', '.join(map(repr, self._outputs.values()))}>"


def budgets(
    model: Measurement | Model,
    *,
    coverage: float | None = None,
    k: float | None = None,
    real_dof: bool = False,
    **columns: Any,
) -> _All:
    """Budgets of many measurements of one model: columns in, columns out.

    Parameters
    ----------
    model : Measurement or Model
        The model. For a `Measurement` every input must be given; for a `Model` missing inputs keep
        their values.
    coverage, k : float, optional
        Coverage probability or factor.
    real_dof : bool, default False
        Take coverage factors at the real numbers of degrees of freedom.
    **columns
        For each input its estimates and standard uncertainties, in the unit of the model, as
        ``(x, u)`` or ``(x, u, dof)``: arrays of one entry a row, or numbers for all rows. An array
        alone is exact. An array of ``uncertainties.unumpy`` has both; correlations between its
        numbers are ignored. For each condition its values. Columns of ``pandas`` have one index, which
        the result keeps.

    Returns
    -------
    mapping of str to OutputBudgets
        By the names of the outputs; for a model with one output its columns are also attributes.

    Notes
    -----
    Correlations are those that the model declares, the same in all rows.
    """
    measurement = model if isinstance(model, Measurement) else None
    if isinstance(model, Measurement):
        missing = [n for n in [*model.inputs, *model.conditions] if n not in columns]
        if missing:
            raise TypeError(f"nothing is said about {', '.join(missing)}")
        model = model.bulk_model()
    model._refuse_function("budgets")
    given: dict[str, tuple[Any, Any, Any]] = {}
    rows: set[int] = set()
    units = {**model.inputs, **model.conditions}
    index: Any = None
    for name, value in columns.items():
        found_parts = _parts(value, units.get(name), name)
        for part in found_parts:
            index = _common_index(index, part, name)
        parts = tuple(_column(part) for part in found_parts)
        _check(name, parts, name in model.conditions)
        rows |= {part.size for part in parts if isinstance(part, np.ndarray)}
        given[name] = (parts[0], parts[1], parts[2])
    if len(rows) > 1:
        raise _gumption.ModelError(
            f"the columns have different lengths: {', '.join(map(str, sorted(rows)))}"
        )
    found = _gumption.budgets(model._rust, given, coverage, k, real_dof)
    if measurement is not None and measurement.check:
        estimates = {name: parts[0] for name, parts in given.items()}
        check_rows(measurement, model._rust, estimates, [of["estimate"] for of in found])
    outputs = model.outputs.items()
    return _All({n: OutputBudgets(n, unit, of, index) for (n, unit), of in zip(outputs, found)})


def _common_index(index: Any, part: Any, name: str) -> Any:
    """The common index of the ``pandas`` columns."""
    own = getattr(part, "index", None)
    # lists and tuples have a method of that name
    if own is None or callable(own):
        return index
    if index is not None and not index.equals(own):
        raise _gumption.ModelError(
            f"`{name}` has another index than the columns before it: rows can be meant by their place "
            "(give `.to_numpy()`) or by their label (give `.loc[index]` or `.reindex(index)`)"
        )
    return own


def _check(name: str, parts: tuple[Any, ...], is_condition: bool) -> None:
    """Checks that widths and degrees of freedom are valid."""
    _, u, dof = parts
    for what, wrong in (
        ("standard uncertainty", ~(np.asarray(u) >= 0) | np.isinf(u)),
        ("number of degrees of freedom", ~(np.asarray(dof) > 0)),
    ):
        if np.any(wrong):
            row = int(np.argmax(np.ravel(wrong)))
            raise _gumption.ModelError(f"`{name}`: the {what} in row {row} (from 0) is not possible")
    if is_condition and np.any(np.asarray(u) != 0):
        raise _gumption.ModelError(f"`{name}` is a condition, which is known exactly")


def _parts(value: Any, unit: str | None, name: str) -> tuple[Any, Any, Any]:
    """Estimates, standard uncertainties and degrees of freedom."""
    if is_pint(value):
        if unit is not None and pint_unit(value) != unit:
            value = value.to(unit.replace("^", "**"))
        value = value.magnitude
    if isinstance(value, tuple):
        if not 1 <= len(value) <= 3:
            raise TypeError(f"{name}: (x, u) or (x, u, dof) is needed")
        x, u, dof = (*value, 0.0, np.inf)[:3] if len(value) != 1 else (value[0], 0.0, np.inf)
        if len(value) == 2:
            dof = np.inf
        return x, u, dof
    if is_ufloat(value):
        return value.nominal_value, value.std_dev, np.inf
    array = np.asarray(value)
    if array.dtype == object and array.size and is_ufloat(array.flat[0]):
        from uncertainties import unumpy

        return unumpy.nominal_values(array), unumpy.std_devs(array), np.inf
    return value, 0.0, np.inf


def _column(value: Any) -> Any:
    array = np.asarray(value, dtype=np.float64)
    return float(array) if array.ndim == 0 else np.ascontiguousarray(array.ravel())
