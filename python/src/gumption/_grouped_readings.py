"""Repeated readings in long form: a table with a row for each reading, and the group that it belongs to."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption
from gumption._frames import columns, numbers, unit_of

Column = npt.NDArray[np.float64]


class GroupedReadings:
    """Means of repeated readings, one for each group (JCGM 100, 4.2); `readings_by` makes them.

    Attributes
    ----------
    by : list of str
        The columns that say which readings belong together.
    keys : list
        The groups: a value of that column, or a tuple of values of several columns.
    mean, standard_uncertainty, dof : ndarray
        For each group the mean, s/sqrt(n), and the n - 1 degrees of freedom.
    unit : str or None
        The unit of the readings.
    """

    def __init__(
        self,
        by: Sequence[str],
        keys: Sequence[Any],
        figures: tuple[Column, Column, Column],
        unit: str | None,
        index: Any = None,
    ) -> None:
        self.by, self.keys = list(by), list(keys)
        self.unit = unit
        #: The ``pandas`` index of the groups, if the readings had one.
        self.index = index
        self.mean, s, n = figures
        few = np.flatnonzero(n < 2)
        if few.size:
            place = int(few[0])
            count = "one reading" if n[place] == 1 else "no reading"
            raise _gumption.ModelError(
                f"the group {self.keys[place]!r} of {', '.join(self.by)} has {count}; a standard deviation "
                "needs at least two"
            )
        self.standard_uncertainty = s / np.sqrt(n)
        self.dof = n - 1.0

    def in_order_of(self, other: GroupedReadings, name: str, of: str) -> tuple[Column, Column, Column]:
        """The means, standard uncertainties and degrees of freedom in the order of the groups of another input.

        Parameters
        ----------
        other : GroupedReadings
            Readings of the same groups.
        name, of : str
            The names of these inputs in messages.
        """
        figures = (self.mean, self.standard_uncertainty, self.dof)
        if self is other:
            return figures
        groups, others = dict.fromkeys(self.keys), dict.fromkeys(other.keys)
        for key in {**groups, **others}:
            if key in groups and key in others:
                continue
            has, lacks = (name, of) if key in groups else (of, name)
            raise _gumption.ModelError(f"`{has}` has readings of the group {key!r}, and `{lacks}` has none")
        place = {key: i for i, key in enumerate(self.keys)}
        order = [place[key] for key in other.keys]
        mean, u, dof = (figure[order] for figure in figures)
        return mean, u, dof

    def __len__(self) -> int:
        return len(self.keys)

    def __repr__(self) -> str:
        return f"<gumption.GroupedReadings: {len(self)} groups of {', '.join(self.by)}>"


def readings_by(table: Any, by: str | Sequence[str], values: str, unit: str | None = None) -> GroupedReadings:
    """Repeated readings of a table in long form, grouped for `budgets`.

    Parameters
    ----------
    table : DataFrame, Table or mapping
        A table of ``pandas``, ``polars``, ``pyarrow`` or columns by name, with a row for each reading.
        Rows without a reading (NaN, null) are left out.
    by : str or sequence of str
        The columns that say which readings belong together.
    values : str
        The column of the readings.
    unit : str, optional
        Their unit; by default the unit stored with the column, or that of the model.

    Returns
    -------
    GroupedReadings
        The means, in the order in which the groups first occur; of a table of ``pandas`` in that of its
        `groupby`.

    Raises
    ------
    ModelError
        If a column is missing, or if a group has fewer than two readings.
    """
    names = [by] if isinstance(by, str) else list(by)
    found = columns(table)
    for name in [*names, values]:
        if name not in found:
            raise _gumption.ModelError(f"the table has no column `{name}`; it has {', '.join(found)}")
    if hasattr(table, "iloc"):
        # of pandas
        return of_groupby(table.groupby(names[0] if len(names) == 1 else names)[values], unit)
    readings = numbers(found[values], values)
    lists = [_list(found[name]) for name in names]
    labels = lists[0] if len(lists) == 1 else list(zip(*lists))
    known = ~np.isnan(readings)
    numbered: dict[Hashable, int] = {}
    group = np.array([numbered.setdefault(label, len(numbered)) for label in labels], dtype=np.intp)[known]
    readings, count = readings[known], len(numbered)
    n = np.bincount(group, minlength=count).astype(np.float64)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(group, readings, minlength=count) / n
        s = np.sqrt(np.bincount(group, (readings - mean[group]) ** 2, minlength=count) / (n - 1))
    return GroupedReadings(names, list(numbered), (mean, s, n), unit or unit_of(found[values]))


def _list(column: Any) -> list[Hashable]:
    """The values of a column as objects of Python."""
    for name in ("to_pylist", "to_list", "tolist"):
        if hasattr(column, name):
            found: list[Hashable] = getattr(column, name)()
            return found
    return list(column)


def is_groupby(value: object) -> bool:
    """Whether it is a grouped column or table of ``pandas``."""
    return type(value).__name__ in ("SeriesGroupBy", "DataFrameGroupBy")


def of_groupby(grouped: Any, unit: str | None = None) -> GroupedReadings:
    """The readings of a grouped column of ``pandas``."""
    if type(grouped).__name__ == "DataFrameGroupBy":
        raise TypeError('name the column of the readings: frame.groupby(...)["reading"]')
    mean, s, n = (getattr(grouped, name)() for name in ("mean", "std", "count"))
    if not hasattr(mean, "index") or hasattr(mean, "columns"):
        raise TypeError("the groups are to be the index: leave `as_index=False` out of `groupby`")
    index = mean.index
    names = ["group" if name is None else str(name) for name in index.names]
    figures = tuple(column.to_numpy(dtype=np.float64) for column in (mean, s, n))
    return GroupedReadings(names, index.tolist(), figures, unit or unit_of(grouped.obj), index)
