"""Answers are those of the command line, byte for byte."""

from __future__ import annotations

import json
import math
import struct
from pathlib import Path

import pytest
from conftest import MODEL_FILES, MODELS, ROOT, run

import gumption as gu


def bits(value: object) -> object:
    """A JSON value with its floats as their bits."""
    if isinstance(value, float):
        return struct.pack("<d", value)
    if isinstance(value, dict):
        return {key: bits(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [bits(inner) for inner in value]
    return value


def test_there_are_models() -> None:
    assert len(MODEL_FILES) > 20


@pytest.mark.parametrize("path", MODEL_FILES, ids=lambda path: path.stem)
def test_json_of_every_model_file(program: str, path: Path) -> None:
    # fewer trials than the files ask for, so that it takes seconds; the code is the same
    said = run(program, "run", path, "--format", "json", "--trials", 20_000, "--seed", 7, "--quiet")
    assert said.returncode == 0, said.stderr.decode()
    result = gu.load(path).run(trials=20_000, seed=7)
    assert result.to_json().encode() == said.stdout
    assert bits(result.to_dict()) == bits(json.loads(said.stdout))


def test_what_the_file_asks_for(program: str) -> None:
    path = MODELS / "inclined_plane.json"
    said = run(program, "run", path, "--format", "json", "--quiet")
    assert gu.load(path).run().to_json().encode() == said.stdout


@pytest.mark.parametrize(
    ("options", "arguments"),
    [
        ({"trials": "adaptive", "seed": 3}, ["--trials", "adaptive", "--seed", "3"]),
        ({"trials": "adaptive", "rule": "stein"}, ["--trials", "adaptive", "--rule", "stein"]),
        ({"trials": 0, "k": 3.0}, ["--trials", "0", "--k", "3"]),
        ({"trials": 30_000, "coverage": 0.99}, ["--trials", "30000", "--coverage", "0.99"]),
        ({"trials": 30_000, "digits": 1}, ["--trials", "30000", "--digits", "1"]),
        ({"trials": 30_000, "real_dof": True}, ["--trials", "30000", "--dof", "real"]),
        ({"trials": 30_000, "method": "quasi"}, ["--trials", "30000", "--method", "quasi"]),
        ({"trials": 30_000, "method": "exact"}, ["--trials", "30000", "--method", "exact"]),
        ({"trials": 300_000, "threads": 1}, ["--trials", "300000", "--threads", "2"]),
        ({"trials": 300_000, "memory": 1 << 20}, ["--trials", "300000", "--memory", "1M"]),
    ],
)
def test_options(program: str, options: dict[str, object], arguments: list[str]) -> None:
    path = MODELS / "inclined_plane.json"
    said = run(program, "run", path, "--format", "json", "--quiet", *arguments)
    assert said.returncode == 0, said.stderr.decode()
    assert gu.load(path).run(**options).to_json().encode() == said.stdout  # type: ignore[arg-type]


def test_replacements(program: str) -> None:
    path = MODELS / "inclined_plane.json"
    sets = ["tilt=36 deg", "rotation.half_width=0.2"]
    arguments = [part for text in sets for part in ("--set", text)]
    said = run(program, "run", path, "--format", "json", "--quiet", "--trials", 0, *arguments)
    model = gu.load(path)
    for same in (
        gu.load(path, set=sets),
        model.set(*sets),
        model.set(tilt="36 deg", rotation__half_width=0.2),
    ):
        assert same.run(trials=0).to_json().encode() == said.stdout


@pytest.mark.parametrize("form", ["table", "csv", "markdown", "latex", "html"])
def test_other_formats(program: str, form: str) -> None:
    path = MODELS / "inclined_plane.json"
    # Markdown and LaTeX in a file name figures beside it
    said = run(program, "run", path, "--format", form, "--trials", 20_000, "--quiet")
    assert said.returncode == 0, said.stderr.decode()
    assert gu.load(path).run(trials=20_000).to(form) == said.stdout


def test_saved_results_and_samples(program: str, tmp_path: Path) -> None:
    path = MODELS / "inclined_plane.json"
    saved, samples = tmp_path / "a.result.json", tmp_path / "a.npy"
    run(program, "run", path, "--trials", 20_000, "--save", saved, "--samples", samples, "--quiet")
    result = gu.load(path).run(trials=20_000)
    result.save(tmp_path / "b.result.json")
    result.write(tmp_path / "b.npy")
    assert (tmp_path / "b.result.json").read_bytes() == saved.read_bytes()
    assert (tmp_path / "b.npy").read_bytes() == samples.read_bytes()


@pytest.mark.parametrize(
    "arguments",
    [
        ["assumptions", "models/inclined_plane.json", "--trials", "20000"],
        pytest.param(
            ["observe", "models/recordings/rotating_table/recipe.json"],
            marks=pytest.mark.slow, id="observe",
        ),
        ["certificate", "models/certificates/three_axis_accelerometer.json", "--trials", "0"],
        ["diff", "models/inclined_plane.json", "models/inclined_plane_spurious.json"],
        pytest.param(
            ["gap", "models/gap/sampling_rate/case.json"], marks=pytest.mark.slow, id="gap"
        ),
    ],  # fmt: skip
    ids=lambda arguments: arguments[0],
)
def test_other_commands(program: str, arguments: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    said = run(program, *arguments, "--format", "json", "--quiet", cwd=ROOT)
    assert said.returncode == 0, said.stderr.decode()
    assert gu.call(*arguments, "--format", "json", "--quiet") == said.stdout
    command, path, *options = arguments
    given = dict(zip((o.removeprefix("--") for o in options[::2]), map(int, options[1::2])))
    if command == "diff":
        answer = gu.diff(path, options[0])
    else:
        answer = getattr(gu, command)(path, **given)
    assert bits(dict(answer)) == bits(json.loads(said.stdout))


def test_the_command_line_of_the_wheel(program: str, tmp_path: Path) -> None:
    assert run(program, "--version").stdout.decode().split() == ["gumption", gu.__version__]
    assert run(program, "run", tmp_path / "none.json").returncode == 2
    assert run(program, "no-command").returncode == 2


def test_numbers_of_the_readme() -> None:
    """The page of README.md: estimate, u and both intervals."""
    a_x = gu.load(MODELS / "inclined_plane.json").run(coverage=0.95)["a_x"]
    assert math.isclose(a_x.gum.estimate, 10 * math.sin(math.radians(35)) * math.cos(math.radians(30)))
    assert round(a_x.gum.standard_uncertainty, 4) == 0.0092
    assert [round(x, 4) for x in a_x.monte_carlo.symmetric_interval] == [4.9500, 4.9847]
    assert list(a_x.budget.input) == ["a_ref", "tilt", "rotation"]
    assert math.isclose(sum(a_x.budget.share), 1.0)
