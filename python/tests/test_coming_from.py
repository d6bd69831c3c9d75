"""The tables of the manual for those who come from another package: both columns give the same."""

from __future__ import annotations

import ast
import re
from typing import Any

import gumption as gu
import numpy as np
import pytest
from conftest import ROOT

PAGE = (ROOT / "docs/coming-from.md").read_text(encoding="utf-8")


def lines(package: str) -> list[tuple[str, str]]:
    """The lines of the table of a package whose two first cells are code, or a cell of code and an empty one."""
    section = PAGE.split(f"\n## From {package}\n")[1].split("\n## ")[0]
    rows = [row for row in section.splitlines() if row.startswith("|")][2:]
    found = []
    for row in rows:
        theirs, here = (cell.strip() for cell in row.split("|")[1:3])
        codes = [re.fullmatch(r"`([^`]+)`|", cell) for cell in (theirs, here)]
        if codes[0] and codes[1] and "..." not in here:
            found.append((codes[0][1], codes[1][1] or ""))
    return found


def figures(value: Any) -> Any:
    """Estimates and standard uncertainties of the quantities of any of the packages, and other values."""
    if isinstance(value, (list, tuple, np.ndarray)):
        return [figures(one) for one in value]
    if isinstance(value, gu.Quantity):
        y, u = value.estimate, value.u
        return figures([y, *u] if isinstance(y, complex) else [y, u])
    if hasattr(value, "std_dev"):  # uncertainties
        return [value.nominal_value, value.std_dev]
    if hasattr(value, "x") and hasattr(value, "u"):  # GTC and MetroloPy
        return figures([value.x, *value.u] if isinstance(value.x, complex) else [value.x, value.u])
    if isinstance(value, complex):
        return [value.real, value.imag]
    return value if isinstance(value, (str, bool)) else float(value)


def flat(value: Any) -> list[Any]:
    return [one for part in value for one in flat(part)] if isinstance(value, list) else [value]


def executed(code: str, names: dict[str, Any]) -> list[Any]:
    """The value of the last expression, or of the names that the last statement assigns."""
    statements = ast.parse(code).body
    last = statements[-1] if statements else None
    if isinstance(last, ast.Expr):
        exec(compile(ast.Module(statements[:-1], []), code, "exec"), names)  # noqa: S102
        value = eval(compile(ast.Expression(last.value), code, "eval"), names)
        return [] if value is None else flat(figures(value))
    exec(code, names)  # noqa: S102
    assigned = ast.walk(last.targets[0]) if isinstance(last, ast.Assign) else ()
    return flat(figures([names[node.id] for node in assigned if isinstance(node, ast.Name)]))


@pytest.mark.parametrize(
    ("package", "module", "count"),
    [("uncertainties", "uncertainties", 20), ("GTC", "GTC", 21), ("MetroloPy", "metrolopy", 17)],
)
def test_both_columns_give_the_same(package: str, module: str, count: int) -> None:
    pytest.importorskip(module)
    own: dict[str, Any] = {}
    other: dict[str, Any] = {}
    compared = 0
    for theirs, here in lines(package):
        expected, found = executed(theirs, other), executed(here, own)
        if theirs.startswith(("set_correlation", "from ", "import ")):
            assert not expected, theirs
            continue
        assert expected and len(found) == len(expected), theirs
        compared += 1
        # the standard deviation of 1e6 draws that are nearly normal has a standard error of 0.07 %, and 1 % is
        # ten times that of the difference of two; all else is the same but for rounding
        is_drawn = ".sim(" in theirs
        for one, wanted in zip(found, expected):
            if isinstance(wanted, str):
                assert one == wanted, theirs
            else:
                assert one == pytest.approx(wanted, rel=0.01 if is_drawn else 1e-9, abs=1e-12), theirs
    assert compared == count
