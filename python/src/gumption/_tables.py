"""Columns as tables of pandas, polars, pyarrow and xarray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gumption import _gumption
from gumption._labels import Axes, Labels


class Table:
    """What has columns of one entry a row."""

    def _columns(self) -> dict[str, Any]:
        """The columns by name, without labels."""
        raise NotImplementedError

    def _labels(self) -> Labels | None:
        """The labels of the rows."""
        raise NotImplementedError

    def _units(self) -> Mapping[str, str]:
        """The units of columns that have one."""
        raise NotImplementedError

    def to_pandas(self) -> Any:
        """The columns as a ``pandas.DataFrame``.

        Its index is that of the ``pandas`` columns given as input, or is made of the dimensions of
        arrays of ``xarray`` or of the keys of grouped readings.
        """
        import pandas

        labels = self._labels()
        return pandas.DataFrame(self._columns(), index=None if labels is None else labels.index())

    def _labelled(self) -> dict[str, Any]:
        """The columns behind columns of labels."""
        columns, labels = self._columns(), self._labels()
        levels = {} if labels is None else labels.levels()
        for name in levels:
            if name in columns:
                raise _gumption.ModelError(
                    f"the rows have labels that are called `{name}`, as a column of the table is; rename them"
                )
        return {**levels, **columns}

    def to_polars(self) -> Any:
        """The columns as a ``polars.DataFrame``; labels of the rows are its first columns."""
        import polars

        return polars.DataFrame(self._labelled(), nan_to_null=False)

    def to_arrow(self) -> Any:
        """The columns as a ``pyarrow.Table``; labels of the rows are its first columns."""
        import pyarrow

        return pyarrow.table({name: pyarrow.array(column) for name, column in self._labelled().items()})

    def to_xarray(self) -> Any:
        """The columns as an ``xarray.Dataset``, units in ``attrs["units"]``.

        Dimensions and coordinates are those of the ``DataArrays`` given as input. Rows of ``pandas`` are
        one dimension with the name of the index, ``row`` if it has none.
        """
        return dataset(self._columns(), self._labels(), self._units())


def dataset(columns: Mapping[str, Any], labels: Labels | None, units: Mapping[str, str]) -> Any:
    """Columns as an ``xarray.Dataset``."""
    import xarray

    count = len(next(iter(columns.values())))
    axes = Axes(("row",), (count,), {}) if labels is None else labels.axes()
    dimensions, shape, coordinates = axes[:3]
    variables = {
        name: (dimensions, np.asarray(column).reshape(shape), {"units": units[name]} if name in units else {})
        for name, column in columns.items()
        if name not in coordinates
    }
    return xarray.Dataset(variables, coordinates)
