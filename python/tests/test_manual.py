"""The chapter on Python of the manual: its blocks run in order, and print what stands below them.

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

CHAPTER = ROOT / "docs/python.md"

#: A block of code, and the printed text below it if there is one.
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", re.DOTALL)


def prompted(code: str, names: dict[str, Any]) -> str:
    """What Python's prompt prints for each statement; of an error its last line."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        for statement in ast.parse(code).body:
            try:
                exec(compile(ast.Interactive([statement]), "<chapter>", "single"), names)
            except Exception as error:  # noqa: BLE001 - the chapter shows errors
                print(f"{type(error).__name__}: {error}")
    return printed.getvalue()


def test_the_chapter_prints_what_it_shows() -> None:
    pytest.importorskip("pandas")
    chapter = CHAPTER.read_text(encoding="utf-8")
    names: dict[str, Any] = {"__name__": "__chapter__"}

    def shown(block: re.Match[str]) -> str:
        printed = prompted(block[1], names)
        return f"```python\n{block[1]}```\n" + (f"\n```text\n{printed}```\n" if printed else "")

    made = BLOCK.sub(shown, chapter)
    if "GUMPTION_UPDATE" in os.environ:
        CHAPTER.write_text(made, encoding="utf-8")
        return
    assert chapter.count("```python") >= 20
    assert made == chapter
