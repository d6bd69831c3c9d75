"""What the tests share: the models of the repository, and the program that pip installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import gumption as gu

ROOT = Path(__file__).parents[2]
MODELS = ROOT / "models"

#: Files directly in `models/` are model files that `run` accepts.
MODEL_FILES = sorted(p for p in MODELS.glob("*.json") if not p.name.endswith(".schema.json"))


@pytest.fixture(scope="session")
def program() -> str:
    """The command line: one that was built of the same sources if it is named, else the wheel's."""
    beside = Path(sys.executable).with_name("gumption")
    found = os.environ.get("GUMPTION") or (str(beside) if beside.exists() else None)
    found = found or shutil.which("gumption")
    assert found, "pip puts `gumption` on the path"
    return found


def run(program: str, *arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[bytes]:
    """Runs the command line."""
    return subprocess.run([program, *map(str, arguments)], capture_output=True, cwd=cwd, check=False)


def check_errors_of_workers(executor: Any) -> None:
    """That a run at an executor has the errors of a run here."""
    model = gu.from_dict({
        "inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1}},
        "equations": {"y": "sqrt(x)"},
        "outputs": {"y": {}},
    })
    with pytest.raises(gu.ModelError) as here:
        model.run(trials=20_000)
    with pytest.raises(gu.ModelError) as there:
        model.run(trials=20_000, executor=executor)
    assert str(there.value) == str(here.value)
    assert there.value.errors == here.value.errors
