"""Trials as arrays for NumPy, and without a copy for libraries that support Arrow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook


class Samples(np.ndarray):
    """The trials of one output: an array of doubles that is an Arrow array as well.

    ``polars.Series``, ``pyarrow.array`` and others take it without a copy.
    """

    @staticmethod
    def of(values: npt.NDArray[np.float64]) -> Samples:
        """These values, not copied.

        Parameters
        ----------
        values : ndarray
            The values.
        """
        return values.view(Samples)

    def _repr_html_(self) -> str | None:
        # a part of another shape, or a number, is shown as NumPy does
        return _table({"": self}) if self.ndim == 1 and self.size > 1 else None

    def __arrow_c_array__(self, requested_schema: Any = None) -> tuple[Any, Any]:
        """Schema and array of the Arrow C data interface."""
        return _gumption.arrow_array(np.ascontiguousarray(self, dtype=np.float64))


class SampleTable(Mapping[str, Samples]):
    """The trials of all outputs by name; row *i* of every column is the same trial.

    ``pandas.DataFrame(table)`` and ``table.to_pandas()`` give a frame, ``polars.DataFrame(table)`` and
    ``pyarrow.table(table)`` as well, without a copy.
    """

    def __init__(self, columns: Mapping[str, Samples]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> Samples:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def _repr_html_(self) -> str:
        return _table(self._columns)

    def __repr__(self) -> str:
        count = len(next(iter(self._columns.values()), ()))
        return f"<gumption.SampleTable: {count} trials of {', '.join(self._columns)}>"

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        """A stream of one batch of the Arrow C data interface."""
        columns = [np.ascontiguousarray(v, dtype=np.float64) for v in self._columns.values()]
        return _gumption.arrow_stream(list(self._columns), columns)

    def to_pandas(self) -> Any:
        """The trials as a ``pandas.DataFrame``."""
        import pandas

        return pandas.DataFrame({name: np.asarray(v) for name, v in self._columns.items()})

    def to_numpy(self) -> npt.NDArray[np.float64]:
        """The trials as a matrix of trials x outputs."""
        return np.column_stack([np.asarray(values) for values in self._columns.values()])


def _table(columns: Mapping[str, npt.NDArray[np.float64]]) -> str:
    """A table of the trials of outputs by their names, rounded to their standard deviation."""
    lines = []
    for name, values in columns.items():
        own = np.asarray(values)
        deviation = float(own.std(ddof=1))
        mean, shown = _gumption.printed(float(own.mean()), deviation)
        ends = [_gumption.printed(float(end), deviation)[0] for end in (own.min(), own.max())]
        lines.append([name, own.size, mean, shown, *ends])
    headings = ["output", "trials", "mean", "standard deviation", "smallest", "largest"]
    return _notebook.whole([_notebook.table(headings, lines, headings[1:])])
