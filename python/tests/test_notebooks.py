"""The notebooks of `examples/notebooks` run, and print what is stored in them."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))


def texts(cells: list[Any]) -> list[str]:
    """What each cell with an output prints and shows as text; a kernel may print it in several parts."""
    found = []
    for cell in cells:
        outputs = cell.get("outputs", ())
        shown = [of.get("text", of.get("data", {}).get("text/plain", "")) for of in outputs]
        if outputs:
            found.append("".join("".join(text) for text in shown))
    return found


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_what_is_stored_is_whole_and_small(path: Path) -> None:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == [*range(1, len(code) + 1)]
    kinds = {output["output_type"] for cell in code for output in cell["outputs"]}
    assert kinds <= {"stream", "execute_result", "display_data"}
    assert all(output.get("name") != "stderr" for cell in code for output in cell["outputs"])
    assert any("image/png" in output.get("data", {}) for cell in code for output in cell["outputs"])
    assert path.stat().st_size < 200_000


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_copy_prints_the_same(path: Path, tmp_path: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    for needed in ("ipykernel", "matplotlib", "pandas"):
        pytest.importorskip(needed)
    copy = tmp_path / path.name
    shutil.copy(path, copy)
    stored = nbformat.read(copy, as_version=4)
    expected = texts(stored.cells)
    nbclient.NotebookClient(stored, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert len(expected) >= 4
    assert texts(stored.cells) == expected


def test_the_notebooks_are_there() -> None:
    names = ["calibration_of_1000_instruments", "first_budget", "gap_of_a_simulator"]
    assert [path.stem for path in NOTEBOOKS] == names
