"""Pages on Python: their blocks run in order, and print what stands below them.

`GUMPTION_UPDATE=1 pytest python/tests/test_manual.py` writes the printed texts anew.
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import re
from typing import Any

import pytest
from conftest import ROOT

#: Pages, where the part of each that is run begins and ends, and the least number of its blocks.
PAGES = [
    ("docs/python.md", "# Python\n", "", 20),
    ("README.md", "## In Python\n", "\n## ", 1),
    ("python/README.md", "## Quantities as numbers\n", "\n## ", 2),
]

#: A block of code, and the printed text below it if there is one.
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", re.DOTALL)


def prompted(code: str, names: dict[str, Any]) -> str:
    """What Python's prompt prints for each statement; of an error its last line."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        for statement in ast.parse(code).body:
            try:
                exec(compile(ast.Interactive([statement]), "<page>", "single"), names)  # noqa: S102
            except Exception as error:  # noqa: BLE001 - pages show errors
                print(f"{type(error).__name__}: {error}")
    return printed.getvalue()


@pytest.mark.parametrize(("name", "begin", "end", "least"), PAGES, ids=[name for name, *_ in PAGES])
def test_a_page_prints_what_it_shows(name: str, begin: str, end: str, least: int) -> None:
    pytest.importorskip("pandas")
    page = ROOT / name
    before, _, rest = page.read_text(encoding="utf-8").partition(begin)
    part, mark, after = rest.partition(end) if end else (rest, "", "")
    names: dict[str, Any] = {"__name__": "__page__"}

    def shown(block: re.Match[str]) -> str:
        printed = prompted(block[1], names)
        return f"```python\n{block[1]}```\n" + (f"\n```text\n{printed}```\n" if printed else "")

    made = BLOCK.sub(shown, part)
    if "GUMPTION_UPDATE" in os.environ:
        page.write_text(before + begin + made + mark + after, encoding="utf-8")
    else:
        assert made == part
    assert part.count("```python") >= least
