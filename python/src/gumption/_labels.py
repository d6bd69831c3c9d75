"""Labels of rows: an index of pandas, the dimensions and coordinates of xarray, the keys of groups."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from gumption import _gumption
from gumption._grouped_readings import GroupedReadings


def is_data_array(value: object) -> bool:
    """Whether it is a ``DataArray`` of ``xarray``."""
    return hasattr(value, "dims") and hasattr(value, "coords") and hasattr(value, "to_numpy")


def index_of(column: object) -> Any:
    """The index of a column of ``pandas``; `None` of any other one."""
    own = getattr(column, "index", None)
    # lists and tuples have a method of that name
    return None if own is None or callable(own) else own


class Labels:
    """What the rows of columns are called.

    Parameters
    ----------
    index : pandas.Index
        Their index.
    """

    def __init__(self, index: Any) -> None:
        self._index = index

    def index(self) -> Any:
        """The labels as a ``pandas.Index``."""
        return self._index

    def levels(self) -> dict[str, Any]:
        """The labels as columns, by their names; those of a count from 0 say nothing and are left out."""
        index = self.index()
        if is_count(index):
            return {}
        names = [f"level_{i}" if name is None else str(name) for i, name in enumerate(index.names)]
        if index.names == [None]:
            names = ["index"]
        return {name: index.get_level_values(i).to_numpy() for i, name in enumerate(names)}

    def axes(self) -> Axes:
        """The dimensions of an ``xarray.Dataset`` of the rows."""
        index = self.index()
        shape = (len(index),)
        if is_count(index):
            return Axes(("row",), shape, {})
        if index.nlevels > 1:
            import xarray

            return Axes(("row",), shape, xarray.Coordinates.from_pandas_multiindex(index, "row"))
        dimension = "row" if index.name is None else str(index.name)
        return Axes((dimension,), shape, {dimension: index.to_numpy()})


class Axes(NamedTuple):
    """Dimensions of an ``xarray.Dataset`` with their lengths, its coordinates and its attributes.

    Variables that the table of conditions had as well keep their attributes, by name.
    """

    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    coordinates: Any
    attributes: Mapping[Any, Any] = {}
    of_variables: Mapping[str, Mapping[Any, Any]] = {}


class AxisLabels(Labels):
    """Rows that are the entries of arrays with named dimensions, the last one fastest."""

    def __init__(self, axes: Axes) -> None:
        self._axes = axes

    def axes(self) -> Axes:
        return self._axes

    def with_attributes(self, table: Any) -> AxisLabels:
        """The same with the attributes of a ``Dataset``."""
        own = {str(name): dict(table[name].attrs) for name in table.data_vars}
        return AxisLabels(self._axes._replace(attributes=dict(table.attrs), of_variables=own))

    def index(self) -> Any:
        import pandas

        dimensions, shape, coordinates = self._axes[:3]
        each = [
            coordinates.get_index(name) if name in coordinates.dims else pandas.RangeIndex(length)
            for name, length in zip(dimensions, shape)
        ]
        if len(each) == 1:
            return each[0] if each[0].nlevels > 1 else each[0].rename(dimensions[0])
        return pandas.MultiIndex.from_product(each, names=dimensions)


class KeyLabels(Labels):
    """Rows that are groups, of which no index is known."""

    def __init__(self, grouped: GroupedReadings) -> None:
        self._names, self._keys = grouped.by, grouped.keys

    def levels(self) -> dict[str, Any]:
        if len(self._names) == 1:
            return {self._names[0]: self._keys}
        return {name: [key[i] for key in self._keys] for i, name in enumerate(self._names)}

    def index(self) -> Any:
        import pandas

        if len(self._names) == 1:
            return pandas.Index(self._keys, name=self._names[0])
        return pandas.MultiIndex.from_tuples(self._keys, names=self._names)


def is_count(index: Any) -> bool:
    """Whether an index only counts the rows from 0, and has no name."""
    step = getattr(index, "step", None)
    return step == 1 and index.start == 0 and index.name is None


def aligned(columns: Sequence[tuple[str, Any]]) -> tuple[list[Any], Labels | None]:
    """Columns by name whose rows belong together, and the labels of the rows if any column has labels.

    Columns of ``pandas`` need the same index. Arrays of ``xarray`` are broadcast by the names of their
    dimensions, and have one dimension then. Beside grouped readings other columns are put into the order
    of the groups, by their labels.

    Raises
    ------
    ModelError
        If labels differ, or if it is open which rows belong together.
    """
    values = [value for _, value in columns]
    if any(isinstance(value, GroupedReadings) for value in values):
        raise TypeError("grouped readings are an input of their own, without a pair around them")
    arrays = [(name, value) for name, value in columns if is_data_array(value)]
    if arrays:
        return _broadcast(columns, arrays)
    index: Any = None
    for name, value in columns:
        own = index_of(value)
        if own is None:
            continue
        if index is not None and own is not index and not index.equals(own):
            raise _gumption.ModelError(
                f"`{name}` has another index than the columns before it: rows can be meant by their "
                "place (give `.to_numpy()`) or by their label (give `.loc[index]` or `.reindex(index)`)"
            )
        index = own if index is None else index
    return values, None if index is None else Labels(index)


def _broadcast(
    columns: Sequence[tuple[str, Any]], arrays: Sequence[tuple[str, Any]]
) -> tuple[list[Any], Labels]:
    """Columns beside arrays of ``xarray``."""
    import xarray

    for i in range(1, len(arrays)):
        try:
            xarray.align(*(value for _, value in arrays[: i + 1]), join="exact")
        except ValueError as error:
            raise _gumption.ModelError(
                f"`{arrays[i][0]}` has other coordinates than the arrays before it; give "
                f'`xarray.align(..., join="inner")` of them, or say with `.sel` or `.reindex_like` which '
                f"are meant ({error})"
            ) from None
    broadcast = xarray.broadcast(*(value for _, value in arrays))
    template = broadcast[0]
    coordinates = xarray.merge(
        [value.coords.to_dataset() for _, value in arrays],
        compat="minimal", join="exact", combine_attrs="override",
    )  # fmt: skip
    made = iter(broadcast)
    found = []
    for name, value in columns:
        if is_data_array(value):
            found.append(next(made).to_numpy().ravel())
            continue
        if index_of(value) is not None:
            raise _gumption.ModelError(
                f"`{name}` has an index of pandas, and `{arrays[0][0]}` dimensions of xarray: give all of "
                f"them as DataArrays (`{name}.to_xarray()`)"
            )
        if np.ndim(value) and template.ndim != 1:
            raise _gumption.ModelError(
                f"`{name}` is an array without names of dimensions beside arrays of the dimensions "
                f"{', '.join(map(str, template.dims))}; give it as a DataArray with the dimensions meant"
            )
        found.append(value)
    dimensions = tuple(map(str, template.dims))
    return found, AxisLabels(Axes(dimensions, template.shape, coordinates))


def in_groups(columns: Sequence[tuple[str, Any]], grouped: tuple[str, GroupedReadings]) -> list[Any]:
    """Columns in the order of groups: by their index, or by the keys of a mapping."""
    first, groups = grouped
    by = ", ".join(groups.by)
    found = []
    for name, value in columns:
        if isinstance(value, Mapping):
            labels, values = list(value), np.array(list(value.values()), dtype=np.float64)
        elif (index := index_of(value)) is not None:
            labels, values = index.tolist(), value.to_numpy()
        elif is_data_array(value) or np.ndim(value):
            raise _gumption.ModelError(
                f"`{name}` has no labels, and the readings of `{first}` are grouped by {by}: give a pandas "
                f"Series with {by} as its index, or a mapping from {by} to numbers"
            )
        else:
            found.append(value)
            continue
        found.append(values[places(name, labels, groups)])
    return found


def places(name: str, labels: Sequence[Hashable], groups: GroupedReadings) -> list[int]:
    """The places at which labels are those of groups."""
    place: dict[Hashable, int] = {}
    for i, label in enumerate(labels):
        if place.setdefault(label, i) != i:
            raise _gumption.ModelError(f"`{name}` has the label {label!r} twice")
    for key in groups.keys:
        if key not in place:
            raise _gumption.ModelError(f"`{name}` has no label {key!r}, of which there are readings")
    return [place[key] for key in groups.keys]
