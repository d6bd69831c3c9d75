"""Tables of other libraries as tables of model files."""

from __future__ import annotations

import io
import math
import os
import re
from collections.abc import Mapping
from csv import writer as csv_writer
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from gumption import _gumption
from gumption._quantities import astropy_unit, is_astropy, is_pint, pint_unit

#: What the table is called in messages and in the provenance.
READINGS = "readings.csv"

#: Rows that are written at a time: the text of a million rows is not held twice.
ROWS = 1 << 14


def columns(table: Any) -> dict[str, Any]:
    """The columns of a DataFrame (pandas, polars, pyarrow), a Dataset of xarray, a structured array or a
    mapping."""
    if hasattr(table, "data_vars"):
        return {str(name): table[name] for name in table.variables}
    if isinstance(table, Mapping):
        return {str(name): v if hasattr(v, "__array__") else np.atleast_1d(v) for name, v in table.items()}
    if isinstance(table, np.ndarray) and table.dtype.names:
        return {name: table[name] for name in table.dtype.names}
    names = getattr(table, "column_names", None) or getattr(table, "columns", None)
    if names is None:
        kind = type(table).__name__
        raise TypeError(f"a table of columns is needed, such as a DataFrame; this is a {kind}")
    return {str(name): table[name] for name in names}


def unit_of(column: Any) -> str | None:
    """The unit stored with a column: of ``pint`` or ``astropy``, or ``attrs["units"]`` or ``attrs["unit"]``.

    As ``pandas`` hands on the attributes of a table and not those of a column, they may also be a mapping
    by column: ``frame.attrs["units"] = {"f": "Hz"}``.
    """
    if is_pint(column):
        return pint_unit(column)
    if is_astropy(column):
        return astropy_unit(column)[1]
    own = getattr(column, "attrs", {})
    found = []
    for key in ("units", "unit") if isinstance(own, Mapping) else ():
        unit = own.get(key)
        if isinstance(unit, Mapping):
            unit = unit.get(column.name)
        if isinstance(unit, str) and unit not in found:
            found.append(unit)
    if len(found) > 1:
        raise _gumption.ModelError(
            f"`{column.name}` has the units {found[0]} and {found[1]}, in attrs[\"units\"] and "
            "attrs[\"unit\"]; take one of them out"
        )
    return udunits(found[0]) if found else None


#: A unit of UDUNITS with its power, as in the conventions for files of climate and forecast: `m2`, `s-1`.
_POWER = re.compile(r"([^\W\d]+|%|°)(?:\^|\*\*)?(-?\d+)?")

#: Names of UDUNITS for units that have other names here.
_NAMES = {
    "degree": "deg", "degrees": "deg", "percent": "%", "degree_Celsius": "degC", "degrees_Celsius": "degC",
    "degree_celsius": "degC", "degrees_celsius": "degC", "celsius": "degC", "Celsius": "degC",
}  # fmt: skip


def udunits(text: str) -> str:
    """A unit of UDUNITS, such as ``kg m-3``, as it is written here; other texts as they are."""
    parts = [_POWER.fullmatch(part) for part in re.split(r"[ .]+", text.strip())]
    if not all(parts):
        return text
    names = [(_NAMES.get(part[1], part[1]), part[2]) for part in parts if part is not None]
    return "*".join(name if power is None else f"{name}^{power}" for name, power in names)


def numbers(column: Any, name: str = "a column") -> Any:
    """The values of a column as doubles; missing ones are NaN."""
    if is_pint(column):
        column = column.magnitude
    elif is_astropy(column):
        column = column.value * astropy_unit(column)[0]
    elif isinstance(column, np.ma.MaskedArray):
        column = np.ma.filled(column.astype(np.float64), np.nan)
    elif getattr(getattr(column, "dtype", None), "na_value", None) is not None:
        # of pandas, whose missing values are no numbers
        column = column.to_numpy(na_value=np.nan)
    values = np.asarray(column)
    if values.dtype.kind in "biuf":
        return np.atleast_1d(values.astype(np.float64, copy=False))
    try:
        if values.dtype.kind == "O":
            return np.atleast_1d(values.astype(np.float64))
    except (TypeError, ValueError):
        pass
    raise _gumption.ModelError(f"`{name}` has values of the type {values.dtype}, but numbers are needed")


def csv(table: Mapping[str, Any]) -> bytes:
    """A table as CSV text; numbers have the shortest text that reads back as the same number."""
    text = bytearray((",".join(table) + "\n").encode())
    count = max(map(len, table.values()), default=0)
    for start in range(0, count, ROWS):
        lists = [values[start : start + ROWS].tolist() for values in table.values()]
        lines = map(repr, lists[0]) if len(lists) == 1 else (",".join(map(repr, row)) for row in zip(*lists))
        text += ("\n".join(lines) + "\n").encode()
    return bytes(text)


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


def table_of(text: str) -> dict[str, Any]:
    """A table of an answer as columns: exact numbers, and missing values for empty cells."""
    import csv as reader

    lines = [line for line in text.splitlines() if not line.startswith("#")]
    header, *rows = reader.reader(lines)
    return {name: _cells([row[i] for row in rows]) for i, name in enumerate(header)}


def frame_of(text: str) -> Any:
    """A table of an answer as a ``pandas.DataFrame``."""
    import pandas

    return pandas.DataFrame(table_of(text))


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
