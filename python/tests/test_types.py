"""The types that are told to checkers are those that there are."""

from __future__ import annotations

import importlib.util
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
