"""The types that are told to checkers are those that there are."""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import gumption

HERE = Path(__file__).parent
needs_mypy = pytest.mark.skipif(not importlib.util.find_spec("mypy"), reason="mypy is not there")


def mypy(*arguments: str, cwd: Path) -> str:
    said = subprocess.run(
        [sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=cwd, check=False
    )
    return "" if said.returncode == 0 else said.stdout + said.stderr


@pytest.mark.slow
@needs_mypy
def test_strict(tmp_path: Path) -> None:
    (tmp_path / "use.py").write_text(
        "import numpy as np\nimport gumption as gu\n"
        "m: gu.Model = gu.load('a.json')\n"
        "r: gu.Result = m.run(trials=1000, seed=1)\n"
        "u: float | np.ndarray[tuple[int, ...], np.dtype[np.float64]] = r['y'].gum.expanded_uncertainty\n"
        "gu.certificate('c.json').save('c.xml')\n"
    )
    options = ["mypy", "--strict", "--ignore-missing-imports"]
    assert not mypy(*options, "use.py", cwd=tmp_path)
    assert not mypy(*options, "-p", "gumption", cwd=tmp_path)


#: Files that checkers read: one without errors, and one with an error in each line that has a mark.
TYPES = HERE / "typed"
MARKED = [
    number
    for number, line in enumerate((TYPES / "wrong.py").read_text().splitlines(), 1)
    if line.endswith("# error")
]


@pytest.mark.slow
@needs_mypy
def test_scalars_and_arrays_for_mypy(tmp_path: Path) -> None:
    options = ["mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path)]
    assert not mypy(*options, "right.py", cwd=TYPES)
    found = re.findall(r"^wrong\.py:(\d+): error", mypy(*options, "wrong.py", cwd=TYPES), re.MULTILINE)
    assert [int(line) for line in found] == MARKED


@pytest.mark.slow
def test_scalars_and_arrays_for_pyright(tmp_path: Path) -> None:
    pytest.importorskip("pyright")
    command = [sys.executable, "-m", "pyright"]
    if subprocess.run([*command, "--version"], capture_output=True, check=False).returncode:
        pytest.skip("pyright could not be fetched")
    for name in ("right.py", "wrong.py"):
        shutil.copy(TYPES / name, tmp_path)
    package = str(Path(str(gumption.__file__)).parents[1])
    settings = {"extraPaths": [package], "typeCheckingMode": "strict", "reportUnusedExpression": False}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    python = ["--pythonpath", sys.executable, "--outputjson", "--project", str(tmp_path)]
    said = subprocess.run([*command, *python], capture_output=True, text=True, check=False).stdout
    found = json.loads(said)["generalDiagnostics"]
    errors = [(Path(one["file"]).name, one["range"]["start"]["line"] + 1) for one in found]
    assert sorted(set(errors)) == [("wrong.py", line) for line in MARKED]


@pytest.mark.slow
@needs_mypy
def test_stubs(tmp_path: Path) -> None:
    config = tmp_path / "mypy.ini"
    config.write_text("[mypy]\nignore_missing_imports = True\n")
    assert not mypy("mypy.stubtest", "gumption", "--mypy-config-file", str(config), cwd=tmp_path)


def test_it_is_typed_and_complete() -> None:
    folder = Path(str(gumption.__file__)).parent
    assert (folder / "py.typed").exists() and (folder / "__init__.pyi").exists()
    for name in gumption.__all__:
        assert getattr(gumption, name).__doc__, name
