"""Tables of other libraries as tables of model files."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Mapping
from csv import writer as csv_writer
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from gumption import _gumption
from gumption._quantities import astropy_unit, is_astropy, is_pint, pint_unit

#: What the tables are called in messages and in the provenance.
NAME = "conditions.csv"
READINGS = "readings.csv"


def columns(table: Any) -> dict[str, Any]:
    """The columns of a DataFrame (pandas, polars, pyarrow), a structured array or a mapping."""
    if isinstance(table, Mapping):
        return {str(name): np.atleast_1d(values) for name, values in table.items()}
    if isinstance(table, np.ndarray) and table.dtype.names:
        return {name: table[name] for name in table.dtype.names}
    names = getattr(table, "column_names", None) or getattr(table, "columns", None)
    if names is None:
        kind = type(table).__name__
        raise TypeError(f"a table of columns is needed, such as a DataFrame; this is a {kind}")
    return {str(name): table[name] for name in names}


def unit_of(column: Any) -> str | None:
    """The unit stored with a column."""
    if is_pint(column):
        return pint_unit(column)
    if is_astropy(column):
        return astropy_unit(column)[1]
    own = getattr(column, "attrs", {})
    unit = own.get("unit") if isinstance(own, Mapping) else None
    return unit if isinstance(unit, str) else None


def numbers(column: Any) -> Any:
    """The values of a column as doubles."""
    if is_pint(column):
        column = column.magnitude
    elif is_astropy(column):
        column = column.value * astropy_unit(column)[0]
    elif hasattr(column, "to_numpy"):
        column = column.to_numpy()
    return np.atleast_1d(np.asarray(column, dtype=np.float64))


def csv(table: Mapping[str, Any]) -> bytes:
    """A table as CSV text; numbers have the shortest text that reads back as the same number."""
    out = io.StringIO()
    out.write(",".join(table) + "\n")
    for row in zip(*(values.tolist() for values in table.values())):
        out.write(",".join(map(repr, row)) + "\n")
    return out.getvalue().encode()


def condition_file(table: Any, units: Mapping[str, str]) -> tuple[dict[str, Any], dict[str, bytes]]:
    """The conditions of a model file with the rows of a table, and the table as a file."""
    found = columns(table)
    missing = [name for name in units if name not in found]
    if missing:
        raise _gumption.ModelError(f"the table of conditions has no column {', '.join(missing)}")
    own = {name: unit_of(found[name]) or unit for name, unit in units.items()}
    for name, unit in units.items():
        if not _gumption.units_fit(own[name], unit):
            raise _gumption.ModelError(
                f"the column `{name}` is in {own[name]}, but the model takes {unit}"
            )
    values = {name: numbers(found[name]) for name in units}
    lengths = {len(column) for column in values.values()}
    if len(lengths) > 1:
        raise _gumption.ModelError("the columns of conditions have different lengths")
    return {"file": NAME, "units": own}, {NAME: csv(values)}


def readings_file(readings: Any) -> tuple[str, bytes]:
    """The name and the content of a file of readings.

    Parameters
    ----------
    readings : path-like, DataFrame or mapping
        A file, or a column for each input. Columns of different length end with missing values, or are
        sequences of different length.
    """
    if isinstance(readings, (str, os.PathLike)):
        path = Path(readings)
        try:
            return path.name, path.read_bytes()
        except OSError as error:
            raise _gumption.ModelError(f"`{path}`: {error.strerror}") from error
    found = columns(readings)
    if not found:
        raise _gumption.ModelError("the table of readings has no columns")
    headings = [
        f"{name} [{unit}]" if (unit := unit_of(column)) and not name.endswith("]") else name
        for name, column in found.items()
    ]
    lists = [numbers(column).tolist() for column in found.values()]
    cells = [["" if math.isnan(value) else repr(value) for value in values] for values in lists]
    out = io.StringIO()
    writer = csv_writer(out, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows(zip_longest(*cells, fillvalue=""))
    return READINGS, out.getvalue().encode()


def frame_of(text: str) -> Any:
    """A table of an answer as a ``pandas.DataFrame``: exact numbers, and missing values for empty cells."""
    import csv as reader

    import pandas

    lines = [line for line in text.splitlines() if not line.startswith("#")]
    header, *rows = reader.reader(lines)
    return pandas.DataFrame({name: _cells([row[i] for row in rows]) for i, name in enumerate(header)})


def _cells(cells: list[str]) -> Any:
    if set(cells) <= {"true", "false"}:
        return [cell == "true" for cell in cells]
    try:
        values = [float(cell) if cell else None for cell in cells]
    except ValueError:
        return [cell or None for cell in cells]
    if None not in values and all(cell.lstrip("-").isdigit() for cell in cells):
        return [int(cell) for cell in cells]
    return np.array(values, dtype=np.float64)
