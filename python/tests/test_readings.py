"""Readings of the day: a file, a mapping or a DataFrame in place of the readings of a model."""

from __future__ import annotations

import json
import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from conftest import run

import gumption as gu

VOLTAGES = [5.007, 4.994, 5.005, 4.99, 4.999]
CURRENTS = [0.019663, 0.019639, 0.01964]


def model(voltages: list[float], currents: list[float]) -> dict[str, Any]:
    def readings(unit: str, values: list[float]) -> dict[str, Any]:
        return {"unit": unit, "distribution": "readings", "values": values}

    return {
        "inputs": {"V": readings("V", voltages), "I": readings("A", currents)},
        "equations": {"R": "V/I"},
        "outputs": {"R": {"unit": "ohm"}},
        "monte_carlo": {"trials": 2000},
    }


def figures(result: gu.Result) -> Any:
    """The outputs of the answer."""
    return json.loads(result.to_json())["outputs"]


YESTERDAY = model([5.1, 5.2, 5.3], [0.1, 0.2, 0.3])


def test_a_mapping_is_an_edited_model() -> None:
    edited = gu.from_dict(model(VOLTAGES, CURRENTS)).run()
    own = gu.from_dict(YESTERDAY)
    today = own.run(readings={"V": VOLTAGES, "I [A]": CURRENTS})
    assert figures(today) == figures(edited)
    # the model keeps its own
    assert figures(own.run()) != figures(edited)
    assert figures(today.model.run()) == figures(edited)
    assert figures(pickle.loads(pickle.dumps(today.model)).run()) == figures(edited)
    with pytest.raises(gu.ModelError, match="readings"):
        gu.assumptions(today.model)


def test_a_file_has_the_bytes_of_the_command_line(program: str, tmp_path: Path) -> None:
    (tmp_path / "m.json").write_text(json.dumps(YESTERDAY))
    today = tmp_path / "today.csv"
    today.write_text("V [V],I [A]\n5.007,0.0197\n4.994,0.0196\n5.005,\n")
    result = gu.load(tmp_path / "m.json").run(readings=today)
    said = run(program, "run", "m.json", "--readings", today, "--format", "json", "--quiet", cwd=tmp_path)
    assert result.to_json() == said.stdout.decode()
    certificate = {"rows": [{"model": "m.json", "output": "R"}]}
    (tmp_path / "c.json").write_text(json.dumps(certificate))
    stated = gu.certificate(tmp_path / "c.json", readings=today)
    said = run(program, "certificate", "c.json", "--readings", today, "--format", "json", cwd=tmp_path)
    assert stated["rows"] == json.loads(said.stdout)["rows"]


def test_frames_of_pandas() -> None:
    edited = figures(gu.from_dict(model(VOLTAGES, CURRENTS)).run())
    own = gu.from_dict(YESTERDAY)
    pandas = pytest.importorskip("pandas")
    padded = [*CURRENTS, None, None]
    assert figures(own.run(readings=pandas.DataFrame({"V": VOLTAGES, "I": padded}))) == edited


@pytest.mark.slow
def test_frames_of_polars() -> None:
    edited = figures(gu.from_dict(model(VOLTAGES, CURRENTS)).run())
    own = gu.from_dict(YESTERDAY)
    padded = [*CURRENTS, None, None]
    polars = pytest.importorskip("polars")
    assert figures(own.run(readings=polars.DataFrame({"V": VOLTAGES, "I": padded}))) == edited


def test_rows_of_a_point() -> None:
    file = model([1.0, 2.0], [1.0, 2.0])
    file["conditions"] = {"p": {"values": [1, 2]}}
    own = gu.from_dict(file)
    readings = {"p": [1, 1, 2, 2], "V": [5.0, 7.0, 8.0, 10.0], "I": [1.0, 3.0, 1.0, 5.0]}
    rows = own.run(readings=readings).to_dict()["rows"]
    # means of the readings at each point: 6 V/2 A and 9 V/3 A
    assert [row["outputs"]["R"]["gum"]["estimate"] for row in rows] == [3.0, 3.0]


@pytest.mark.parametrize(
    ("readings", "said"),
    [
        ({"U": [1.0, 2.0]}, "there is no input `U`"),
        ({"V [kg]": [1.0, 2.0]}, "cannot be converted"),
        ({"V": [1.0, float("nan"), 2.0]}, "the cell is empty"),
        ({}, "no columns"),
        ("missing.csv", "missing.csv"),
    ],
)
def test_errors(readings: Any, said: str) -> None:
    with pytest.raises(gu.ModelError, match=said):
        gu.from_dict(YESTERDAY).run(readings=readings)


@pytest.mark.slow
def test_executors_carry_them() -> None:
    own = gu.from_dict(YESTERDAY)
    readings = {"V": VOLTAGES, "I": CURRENTS}
    alone = own.run(readings=readings)
    with ProcessPoolExecutor(2) as pool:
        shared = own.run(readings=readings, executor=pool, parts=2)
    assert shared.to_json() == alone.to_json()
