"""Tables of conditions as tables of model files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gumption import _gumption
from gumption._frames import columns, csv, numbers, unit_of
from gumption._labels import AxisLabels, Labels, aligned

#: What the table is called in messages and in the provenance.
NAME = "conditions.csv"


def condition_file(
    table: Any, units: Mapping[str, str]
) -> tuple[dict[str, Any], dict[str, bytes], Labels | None]:
    """The conditions of a model file with the rows of a table, the table as a file, and its labels."""
    found = columns(table)
    missing = [name for name in units if name not in found]
    if missing:
        raise _gumption.ModelError(f"the table of conditions has no column {', '.join(missing)}")
    own = {name: unit_of(found[name]) or unit for name, unit in units.items()}
    for name, unit in units.items():
        if not _gumption.units_fit(own[name], unit):
            raise _gumption.ModelError(f"the column `{name}` is in {own[name]}, but the model takes {unit}")
    rows, labels = aligned([(name, found[name]) for name in units])
    if isinstance(labels, AxisLabels) and hasattr(table, "data_vars"):
        labels = labels.with_attributes(table)
    values = {name: numbers(column, name) for name, column in zip(units, rows)}
    lengths = {len(column) for column in values.values()}
    if len(lengths) > 1:
        raise _gumption.ModelError("the columns of conditions have different lengths")
    return {"file": NAME, "units": own}, {NAME: csv(values)}, labels
