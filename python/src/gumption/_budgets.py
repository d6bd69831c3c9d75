"""Budgets of many measurements of one model at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._check import check_rows
from gumption._frames import numbers, unit_of
from gumption._grouped_readings import GroupedReadings, is_groupby, of_groupby
from gumption._labels import KeyLabels, Labels, aligned, in_groups
from gumption._measurement import Measurement
from gumption._model import Model
from gumption._quantities import is_pint, is_ufloat
from gumption._quantity import Quantity
from gumption._result import MonteCarlo
from gumption._tables import Table

Column = npt.NDArray[np.float64]

#: The parts of an input, as they are called in messages.
PARTS = ("estimate", "standard uncertainty", "number of degrees of freedom")


class OutputBudgets(Table):
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
    monte_carlo : MonteCarlo or None
        The figures of the trials, an entry a row; `None` without trials.
    """

    def __init__(
        self,
        name: str,
        unit: str,
        columns: Mapping[str, Any],
        labels: Labels | None = None,
        trials: _Trials | None = None,
    ) -> None:
        self._row_labels = labels
        self.name = name
        self.unit = unit
        self.estimate: Column = columns["estimate"]
        self.standard_uncertainty: Column = columns["standard_uncertainty"]
        self.dof: Column = columns["dof"]
        self.coverage_factor: Column = columns["coverage_factor"]
        self.sensitivities: dict[str, Column] = columns["sensitivities"]
        self.contributions: dict[str, Column] = columns["contributions"]
        self.monte_carlo = None if trials is None else MonteCarlo(trials)  # type: ignore[arg-type]

    @property
    def expanded_uncertainty(self) -> Column:
        """Expanded uncertainties U = k u(y)."""
        return self.coverage_factor * self.standard_uncertainty

    def _columns(self) -> dict[str, Any]:
        own = {
            "estimate": self.estimate,
            "standard_uncertainty": self.standard_uncertainty,
            "dof": self.dof,
            "coverage_factor": self.coverage_factor,
            "expanded_uncertainty": self.expanded_uncertainty,
        }
        parts = {f"u({name})": values for name, values in self.contributions.items()}
        drawn = self.monte_carlo
        if drawn is None:
            return {**own, **parts}
        symmetric, shortest = drawn.symmetric_interval, drawn.shortest_interval
        of_trials = {
            "mc_estimate": drawn.estimate,
            "mc_standard_uncertainty": drawn.standard_uncertainty,
            "mc_symmetric_low": symmetric[:, 0],
            "mc_symmetric_high": symmetric[:, 1],
            "mc_shortest_low": shortest[:, 0],
            "mc_shortest_high": shortest[:, 1],
        }
        return {**own, **of_trials, **parts}

    def _labels(self) -> Labels | None:
        return self._row_labels

    def _units(self) -> dict[str, str]:
        return {name: self.unit for name in self._columns() if name not in ("dof", "coverage_factor")}

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


class _Trials:
    """The figures of the trials of one output, in the rows of which all inputs are known."""

    def __init__(self, run: _gumption.Run, output: str, known: npt.NDArray[np.bool_]) -> None:
        self._run, self._output, self._known = run, output, known

    def _column(self, name: str) -> Column:
        column = np.full(len(self._known), np.nan)
        column[self._known] = self._run.column(self._output, name)
        return column


class _All(Table, Mapping[str, OutputBudgets]):
    """The budgets of all outputs by name.

    Of a model of one output the columns are attributes as well, and it is the table of these.
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
        monte_carlo: MonteCarlo[Column] | None
    else:

        def __getattr__(self, name: str) -> Any:
            # of a model of one output the columns are at hand at once
            if name.startswith("_"):
                raise AttributeError(name)
            return getattr(self._only(), name)

    def _only(self) -> OutputBudgets:
        """The budgets of the only output."""
        if len(self._outputs) != 1:
            raise AttributeError(f"there are several outputs, each with a table: {', '.join(self._outputs)}")
        return next(iter(self._outputs.values()))

    # the table of the only output

    def _columns(self) -> dict[str, Any]:
        return self._only()._columns()

    def _labels(self) -> Labels | None:
        return self._only()._labels()

    def _units(self) -> dict[str, str]:
        return self._only()._units()

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def _repr_html_(self) -> str:
        return _notebook.whole([of._table() for of in self._outputs.values()])

    def __repr__(self) -> str:
        return f"<gumption.budgets: {', '.join(map(repr, self._outputs.values()))}>"


#: Options of `budgets`, whose names may also be those of inputs.
OPTIONS = ("coverage", "k", "real_dof", "trials", "seed", "executor")


def budgets(
    model: Measurement | Model,
    inputs: Mapping[str, Any] | None = None,
    /,
    *,
    coverage: float | None = None,
    k: float | None = None,
    real_dof: bool = False,
    trials: int | None = None,
    seed: int | None = None,
    executor: Any = None,
    **columns: Any,
) -> _All:
    """Budgets of many measurements of one model: columns in, columns out.

    Parameters
    ----------
    model : Measurement or Model
        The model. For a `Measurement` every input must be given; for a `Model` missing inputs keep
        their values.
    inputs : mapping of str to object, optional
        The same as `columns`, for inputs that are called as an option.
    coverage, k : float, optional
        Coverage probability or factor.
    real_dof : bool, default False
        Take coverage factors at the real numbers of degrees of freedom.
    trials : int, optional
        Number of trials of the Monte Carlo method in each row; none unless given.
    seed : int, optional
        Seed of the random streams.
    executor : concurrent.futures.Executor or distributed.Client, optional
        With `trials`, distributes the rows as `Model.run` does.
    **columns
        For each input its estimates and standard uncertainties as ``(x, u)`` or ``(x, u, dof)``:
        columns of one entry a row, or numbers for all rows. A column alone is exact. For each condition
        its values. Columns are arrays, lists, or columns of ``pandas``, ``polars``, ``pyarrow`` and
        ``xarray``. They are converted to the unit of the model if they have one of their own (``pint``,
        ``astropy``, ``attrs["units"]`` as of ``xarray``). An array of ``uncertainties.unumpy`` has
        estimates and uncertainties; correlations between its numbers are ignored.
        Repeated readings in long form are an input as well: ``frame.groupby("device")["reading"]`` of
        ``pandas``, or `readings_by`; a row is a group then, and other columns are put into the order of
        the groups by their index, or by the keys of a mapping.

    Returns
    -------
    mapping of str to OutputBudgets
        By the names of the outputs; for a model with one output its columns are also attributes.

    Raises
    ------
    ModelError
        If columns have different lengths, labels or dimensions, or a unit of another dimension.

    Notes
    -----
    Correlations are those that the model declares, the same in all rows. Inputs given as columns are
    normal, or of a t distribution for finite degrees of freedom (JCGM 101, 6.4.9.7); the trials of a row
    are those of a single run with its values and the same seed. A row with a missing estimate (NaN) has
    missing results.

    Columns of ``pandas`` have one index, which the result keeps. ``DataArrays`` of ``xarray`` are
    broadcast by their named dimensions, and `OutputBudgets.to_xarray` has their coordinates.
    """
    if isinstance(model, Quantity):
        raise TypeError("`model`: an expression is given; `.model()` makes one of it")
    measurement = model if isinstance(model, Measurement) else None
    options = (coverage, k, real_dof or None, trials, seed, executor)
    columns = _by_name(model, inputs or {}, columns, options)
    if isinstance(model, Measurement):
        missing = [n for n in [*model.inputs, *model.conditions] if n not in columns]
        if missing:
            raise TypeError(f"nothing is said about {', '.join(missing)}")
        model = model.bulk_model()
    model._refuse_function("budgets")
    if trials is None and (seed is not None or executor is not None):
        raise _gumption.ModelError("`seed` and `executor` are about trials; give their number, `trials`")
    given, labels = _given(columns, {**model.inputs, **model.conditions})
    for name, parts in given.items():
        _check(name, parts, name in model.conditions)
    rows = {part.size for parts in given.values() for part in parts if isinstance(part, np.ndarray)}
    if len(rows) > 1:
        raise _gumption.ModelError(
            f"the columns have different lengths: {', '.join(map(str, sorted(rows)))}"
        )
    found = _gumption.budgets(model._rust, given, coverage, k, real_dof)
    if measurement is not None and measurement.check:
        estimates = {name: parts[0] for name, parts in given.items()}
        check_rows(measurement, model._rust, estimates, [of["estimate"] for of in found])
    drawn: dict[str, _Trials] = {}
    if trials is not None:
        asked = {name: value for name, value in zip(OPTIONS, options) if value is not None}
        asked.pop("executor", None)
        drawn = _drawn(model, given, asked, executor)
    return _All(
        {
            name: OutputBudgets(name, unit, of, labels, drawn.get(name))
            for (name, unit), of in zip(model.outputs.items(), found)
        }
    )


def _by_name(
    model: Measurement | Model,
    inputs: Mapping[str, Any],
    columns: Mapping[str, Any],
    options: Sequence[Any],
) -> dict[str, Any]:
    """The columns of the inputs and conditions."""
    names = {*model.inputs, *model.conditions}
    for name, value in zip(OPTIONS, options):
        if value is not None and name in names and name not in inputs:
            raise TypeError(
                f"`{name}` is an option, and an input of the model: give the input in a mapping, "
                f"`budgets(model, {{\"{name}\": ...}})`"
            )
    for name in columns:
        if name in inputs:
            raise TypeError(f"`{name}` is given twice")
    return {**inputs, **columns}


class _Part(NamedTuple):
    """A column of an input with the unit of its own, if it has any."""

    value: Any
    unit: str | None


def _given(
    columns: Mapping[str, Any], units: Mapping[str, str]
) -> tuple[dict[str, tuple[Any, Any, Any]], Labels | None]:
    """Numbers and arrays of one entry a row in the units of the model, and the labels of the rows."""
    readings = {}
    parts: dict[str, tuple[_Part, ...]] = {}
    for name, value in columns.items():
        if is_groupby(value):
            try:
                value = of_groupby(value)
            except _gumption.ModelError as error:
                raise _gumption.ModelError(f"`{name}`: {error}") from None
        if isinstance(value, GroupedReadings):
            readings[name] = value
        else:
            parts[name] = _parts(value, name, units.get(name))
    flat = [(name, part.value) for name, own in parts.items() for part in own]
    labels: Labels | None
    if readings:
        first = next(iter(readings))
        groups = readings[first]
        labels = KeyLabels(groups) if groups.index is None else Labels(groups.index)
        values = iter(in_groups(flat, (first, groups)))
        for name, grouped in readings.items():
            units_of = (grouped.unit, grouped.unit, None)
            figures = grouped.in_order_of(groups, name, first)
            parts[name] = tuple(map(_Part, figures, units_of))
    else:
        rows, labels = aligned(flat)
        values = iter(rows)
    given = {}
    for name, own in parts.items():
        if name not in readings:
            own = tuple(part._replace(value=next(values)) for part in own)
        x, u, dof = (_column(part, units.get(name), name, what) for what, part in zip(PARTS, own))
        given[name] = (x, u, dof)
    return given, labels


def _drawn(
    model: Model, given: Mapping[str, tuple[Any, Any, Any]], options: dict[str, Any], executor: Any
) -> dict[str, _Trials]:
    """The figures of the trials by output."""
    columns = [part for parts in given.values() for part in parts if isinstance(part, np.ndarray)]
    count = len(columns[0]) if columns else 1
    known = np.ones(count, dtype=np.bool_)
    for x, _, _ in given.values():
        known &= np.isfinite(x)
    if not known.any():
        return {}
    rows = given
    if not known.all():
        rows = {
            name: tuple(part[known] if isinstance(part, np.ndarray) else part for part in parts)  # type: ignore[misc]
            for name, parts in given.items()
        }
    sweep = _Sweep(model, rows)
    if executor is None:
        run = sweep.run(options)
    else:
        from gumption._executors import run_on

        run = run_on(sweep, options, executor)  # type: ignore[arg-type]
    return {name: _Trials(run, name, known) for name in model.outputs}


class _Sweep:
    """The trials of a model in the rows of columns, here or in a worker."""

    def __init__(self, model: Model, columns: Mapping[str, tuple[Any, Any, Any]]) -> None:
        self._model, self._columns = model, dict(columns)

    def run(self, options: dict[str, Any]) -> _gumption.Run:
        """The run on this machine's threads."""
        return _gumption.in_rows(self._model._rust, self._columns).run(options)

    def _parts(self, options: dict[str, Any]) -> _gumption.Parts:
        """The run in parts, as of a `Model`."""
        return _gumption.in_rows(self._model._rust, self._columns).parts(options)


def _check(name: str, parts: tuple[Any, ...], is_condition: bool) -> None:
    """Checks that widths and degrees of freedom are valid."""
    _, u, dof = parts
    if isinstance(u, float):
        wrong_u: Any = not 0 <= u < np.inf
    else:
        wrong_u = ~((u >= 0) & (u < np.inf))
    wrong_dof: Any = not dof > 0 if isinstance(dof, float) else ~(dof > 0)
    for what, wrong in ((PARTS[1], wrong_u), (PARTS[2], wrong_dof)):
        if wrong is True or (wrong is not False and wrong.any()):
            row = int(np.argmax(np.ravel(wrong)))
            raise _gumption.ModelError(f"`{name}`: the {what} in row {row} (from 0) is not possible")
    if is_condition and np.any(u != 0):
        raise _gumption.ModelError(f"`{name}` is a condition, which is known exactly")


def _parts(value: Any, name: str, unit: str | None) -> tuple[_Part, _Part, _Part]:
    """Estimates, standard uncertainties and degrees of freedom of an input whose unit is given."""
    if isinstance(value, Quantity):
        raise TypeError(
            f"`{name}` is a quantity: make a model with it, and give the columns of the other inputs, "
            f"`m = f({name}=..., ...)` and `gumption.budgets(m, ...)`"
        )
    if isinstance(value, tuple):
        if not 1 <= len(value) <= 3:
            raise TypeError(f"{name}: (x, u) or (x, u, dof) is needed")
        x, u, dof = (*value, 0.0, np.inf)[:3] if len(value) != 1 else (value[0], 0.0, np.inf)
        if len(value) == 2:
            dof = np.inf
        own = _unit(x)
        if own not in (None, unit) and _unit(u) is None and np.any(np.asarray(u, dtype=float) != 0):
            raise _gumption.ModelError(
                f"`{name}`: the estimates are in {own}, and the standard uncertainties can be in {own} or in {unit}, "
                "that of the model; give them a unit as well"
            )
        return _Part(x, own), _Part(u, _unit(u)), _Part(dof, None)
    unit = _unit(value)
    x, u = _with_uncertainty(value.magnitude if is_pint(value) else value)
    return _Part(x, unit), _Part(u, unit), _Part(np.inf, None)


def _unit(value: Any) -> str | None:
    """The unit stored with a column."""
    is_plain = isinstance(value, (int, float, list)) or type(value) is np.ndarray
    return None if is_plain else unit_of(value)


def _with_uncertainty(value: Any) -> tuple[Any, Any]:
    """Estimates and standard uncertainties of numbers that have both."""
    if is_ufloat(value):
        return value.nominal_value, value.std_dev
    if getattr(value, "dtype", None) == object or isinstance(value, list):
        array = np.asarray(value)
        if array.dtype == object and array.size and is_ufloat(array.flat[0]):
            from uncertainties import unumpy

            index = getattr(value, "index", None)
            both = unumpy.nominal_values(array), unumpy.std_devs(array)
            if index is None or callable(index):
                return both
            import pandas

            return pandas.Series(both[0], index), pandas.Series(both[1], index)
    return value, 0.0


def _column(part: _Part, unit: str | None, name: str, what: str) -> Any:
    """The numbers in the unit of the model: one for all rows, or one a row."""
    value, own = part
    if own is None and isinstance(value, (int, float)):
        return float(value)
    array = np.ascontiguousarray(numbers(value, name).ravel())
    if own is not None and unit is not None and own != unit:
        try:
            array = _gumption.convert(array, own, unit, what != PARTS[0])
        except _gumption.ModelError as error:
            said = str(error).removeprefix("gumption: ")
            raise _gumption.ModelError(
                f"the {what} of `{name}` is in {own}, but the model takes {unit}: {said}"
            ) from None
    return float(array[0]) if np.ndim(value) == 0 else array
