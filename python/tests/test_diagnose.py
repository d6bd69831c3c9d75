"""The gap of a simulator: what it is given, what comes out, and what a simulator can do wrong."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from concurrent import futures
from pathlib import Path
from typing import Any

import gumption as gu
import numpy as np
import pytest
from gumption._diagnose import Effect, as_effect, effect, runs
from gumption._shapes import log_uniform, normal, rectangular

DRAG = rectangular(lower=0, upper=0.2, unit="1/s")


def test_an_effect_with_one_parameter_is_absent_at_zero() -> None:
    found = effect({"drag": DRAG}, about="air")
    assert found.to_dict() == {
        "about": "air",
        "parameters": {
            "drag": {"unit": "1/s", "distribution": "rectangular", "lower": 0, "upper": 0.2}
        },
        "simulator": True,
    }
    assert as_effect({"drag": DRAG}, "air-drag").neutral == {}
    assert as_effect(found, "air-drag") is found


def test_an_effect_names_what_makes_it_absent() -> None:
    found = effect({"pivot": log_uniform(1e-4, 1e-1, "1"), "width": (1.0, 0.1)}, neutral={"pivot": 0})
    assert found.neutral == {"pivot": 0}
    assert found.to_dict()["parameters"]["width"]["std"] == 0.1


def test_formulas_override_outputs() -> None:
    found = effect({"k": normal(0, 0.01, "1")}, overrides={"angle": "angle*(1 + k)"})
    assert found.to_dict() == {
        "parameters": {"k": {"unit": "1", "distribution": "normal", "mean": 0, "std": 0.01}},
        "overrides": {"angle": "angle*(1 + k)"},
    }


@pytest.mark.parametrize(
    ("parameters", "more", "message"),
    [
        ({"a": DRAG}, {"neutral": {}}, "`neutral` names no parameter"),
        (
            {"a": DRAG},
            {"neutral": {"a": math.nan}},
            "the neutral value of 'a' is nan, but must be a finite number",
        ),
        (
            {"a": DRAG},
            {"neutral": {"a": 0}, "overrides": {"y": "y + a"}},
            "an effect has `neutral` or `overrides`: formulas are absent without it",
        ),
        ({"a": DRAG}, {"overrides": {}}, "`overrides` names no output"),
    ],
)
def test_what_is_no_effect(parameters: Any, more: Any, message: str) -> None:
    with pytest.raises(ValueError) as told:
        effect(parameters, **more)
    assert str(told.value) == message


def test_effects_are_named_in_errors() -> None:
    with pytest.raises(TypeError, match="^the effect 'friction' is a Input, but must be a mapping"):
        as_effect(DRAG, "friction")
    assert isinstance(as_effect({"a": 1.0}, "friction"), Effect)


def test_runs_are_tables_of_parameters_and_outputs() -> None:
    found = runs({"length": [0.5, 0.6, 0.7], "drag": [0, 0.1, 0.1]}, {"angle": [[1, 2], [3, math.inf], [5, 6]]})
    assert (len(found), found.rows) == (3, 2)
    assert found.failed.tolist() == [False, True, False]
    assert found.parameters["drag"].tolist() == [0.0, 0.1, 0.1]
    assert found.outputs["angle"][2].tolist() == [5.0, 6.0]
    assert repr(found) == "<3 runs with length, drag: angle at 2 rows>"


def test_runs_of_a_frame() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"length": [0.5, 0.6]})
    assert runs(frame, {"angle": np.ones((2, 4))}).parameters["length"].tolist() == [0.5, 0.6]


@pytest.mark.parametrize(
    ("parameters", "outputs", "message"),
    [
        ({}, {"y": [[1]]}, "the runs have no parameters"),
        ({"a": []}, {"y": []}, "the runs have no parameters"),
        ({"a": [1]}, {}, "the outputs are a mapping from names to arrays of runs by rows"),
        ({"a": [1]}, [[1]], "the outputs are a mapping from names to arrays of runs by rows"),
        ({"a": [1, 2], "b": [1]}, {"y": [[1], [2]]}, "the parameter 'b' has the shape (1,), not (2,)"),
        (
            {"a": [1, math.nan]},
            {"y": [[1], [2]]},
            "the parameter 'a' of run 2 is nan, but must be a finite number",
        ),
        (
            {"a": [1, 2]},
            {"y": [1, 2]},
            "the output 'y' has the shape (2,), but must have 2 runs by rows",
        ),
        (
            {"a": [1, 2]},
            {"y": [[1, 2], [1, 2]], "z": [[1], [2]]},
            "the output 'z' has 1 rows, those before it 2",
        ),
        ({"a": [1]}, {"y": [[]]}, "the outputs have no rows"),
    ],
)
def test_what_are_no_runs(parameters: Any, outputs: Any, message: str) -> None:
    with pytest.raises(ValueError) as told:
        runs(parameters, outputs)
    assert str(told.value) == message


T = np.linspace(0, 10, 40)


def cooling(conditions: Any, rate: float, gain: float, stray: float) -> dict[str, Any]:
    """A body that cools, in K; an amplifier with an error of its gain, and a stray field over time."""
    t = conditions["t"]
    return {"T": 50 * (1 + gain) * np.exp(-rate * t) + stray * t}


def measured(gain: float = 0.03) -> dict[str, Any]:
    noise = np.random.default_rng(1).normal(0, 0.1, len(T))
    return {"t": T, "T": cooling({"t": T}, 0.2003, gain, 0.0)["T"] + noise}


def given(**more: Any) -> dict[str, Any]:
    """What `diagnose` is given beside the simulator; `more` takes its place."""
    return {
        "data": measured(),
        "conditions": {"t": "min"},
        "outputs": {"T": "K"},
        "uncertainties": {"T": 0.1},
        "inputs": {"rate": normal(0.2, 0.001, "1/min")},
        "effects": {
            "gain-error": {"gain": normal(0, 0.05, "1")},
            "stray-field": {"stray": normal(0, 0.2, "K/min")},
        },
        "runs": 70,
        "seed": 1,
        **more,
    }


def test_the_effect_that_was_there_is_named() -> None:
    calls = []

    def counted(conditions: Any, **parameters: float) -> dict[str, Any]:
        calls.append(parameters)
        return cooling(conditions, **parameters)

    found = gu.diagnose(counted, **given())
    assert found.verdict["effects"] == ["gain-error"]
    assert found.probability > 0.9
    # 0.03 with 0.1 K of 50 K in each of 40 rows
    low, high = found.parameters["gain-error/gain"]["interval"]
    assert low < 0.03 < high and high - low < 0.01
    assert found.present["gain-error"]["probability"] > 0.9
    assert set(calls[0]) == {"rate", "gain", "stray"}
    frame = found.runs
    assert len(frame) == len(calls) <= 70
    assert list(frame.columns) == ["rate", "gain", "stray", "failed"]
    assert frame["failed"].isna().all()
    assert found.to_dict()["seed"] == 1
    assert "gain-error" in str(found) and "gain-error" in repr(found)
    # the tables of the page, without its figures and below 30 kB; the page on request
    assert "gain" in found._repr_html_() and "<svg" not in found._repr_html_()
    assert len(found._repr_html_()) < 30_000
    assert "<iframe" in found.page()._repr_html_() and "<svg" in found.page().html
    figure = pytest.importorskip("matplotlib.figure").Figure()
    panels = figure.subplots(3, 1)
    assert found.plot(ax=panels[:2]) is figure
    assert panels[0].get_ylabel() == "residual of T / u" and panels[1].get_xlim() == (0, 1)
    with pytest.raises(ValueError, match="3 axes, but 2 are needed: one for each of the residuals of T, the"):
        found.plot(ax=panels)
    # further on, where nothing was measured: a run for each draw, all rows at once
    before = len(calls)
    late = np.linspace(10, 20, 7)
    there = found.predict({"t": late}, runs=12)
    assert 0 < len(calls) - before <= 40
    truth = cooling({"t": late}, 0.2003, 0.03, 0.0)["T"]
    assert np.all(np.abs(there["T"] - truth) < 4 * there["u(T)"])
    assert np.all(there["u(T)"] < 0.3)


def test_an_executor_and_kept_runs_give_the_same(tmp_path: Path) -> None:
    here = gu.diagnose(cooling, **given())
    with futures.ThreadPoolExecutor(2) as pool:
        there = gu.diagnose(cooling, **given(executor=pool, resume=tmp_path))
    assert there.to_dict() == here.to_dict()

    def no_more(conditions: Any, **parameters: float) -> dict[str, Any]:
        raise AssertionError("all runs were made")

    again = gu.diagnose(no_more, **given(resume=tmp_path))
    assert again.to_dict() == here.to_dict()


def test_the_command_line_says_the_same(tmp_path: Path) -> None:
    program = tmp_path / "cooling.py"
    program.write_text(
        "import json, sys\n"
        "import numpy as np\n"
        "asked = json.load(sys.stdin)\n"
        "p, t = asked['parameters'], np.array(asked['conditions']['t'])\n"
        "T = 50 * (1 + p['gain']) * np.exp(-p['rate'] * t) + p['stray'] * t\n"
        "print(json.dumps({'T': T.tolist()}))\n"
    )
    data = measured()
    lines = [f"{t!r},{y!r}" for t, y in zip(data["t"].tolist(), data["T"].tolist())]
    (tmp_path / "data.csv").write_text("\n".join(["t,T", *lines]) + "\n")
    of = given()
    case = {
        "inputs": {"rate": of["inputs"]["rate"].to_dict()},
        "conditions": {"t": {"unit": "min"}},
        "simulator": {"outputs": {"T": "K"}},
        "outputs": {"T": {"unit": "K"}},
        "observations": {
            "file": "data.csv",
            "columns": {"T": {"value": "T", "standard_uncertainty": 0.1}},
        },
        "effects": {name: effect(one).to_dict() for name, one in of["effects"].items()},
    }
    (tmp_path / "case.json").write_text(json.dumps(case))
    gumption = [sys.executable, "-m", "gumption", "gap", "case.json", "--quiet", "--format", "json"]
    asked = ["--simulator", f'"{sys.executable}" cooling.py', "--runs", "70", "--seed", "1"]
    answer = subprocess.run([*gumption, *asked], cwd=tmp_path, check=True, capture_output=True).stdout
    found = gu.diagnose(cooling, **of).to_dict()
    told = json.loads(answer)
    for of_file in (told, found):
        of_file["sim"].pop("source"), of_file.pop("title")
    assert found == told


def test_runs_that_were_made_before() -> None:
    rng = np.random.default_rng(2)
    rate, gain = rng.normal(0.2, 0.001, 60), rng.normal(0, 0.05, 60)
    gain[:15] = 0
    made = [cooling({"t": T}, *of, 0.0)["T"] for of in zip(rate, gain)]
    table = runs({"rate": rate, "gain": gain}, {"T": made})
    only = {"gain-error": {"gain": normal(0, 0.05, "1")}}
    with pytest.raises(ValueError, match="take no `executor`"):
        gu.diagnose(table, **given(effects=only, executor=futures.ThreadPoolExecutor(1)))
    with pytest.raises(ValueError, match="the runs have the parameters rate, gain, and the case rate, gain, stray"):
        gu.diagnose(table, **given())
    found = gu.diagnose(table, **given(effects=only))
    assert found.verdict["effects"] == ["gain-error"]
    with pytest.raises(ValueError, match="that takes a simulator"):
        found.predict({"t": T})


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda T: 1 / 0, "ZeroDivisionError: division by zero"),
        (lambda T: {"T": T[:-1]}, r"`T` has the shape \(39,\), but the data have 40 rows"),
        (lambda T: {"T": T * np.nan}, "value 1 of `T` is nan, but must be a finite number"),
        (lambda T: {"S": T}, "the simulator gives `S`, but the outputs are T"),
        (lambda T: {}, "the simulator gives no `T`"),
        (lambda T: T, "a table of columns is needed"),
        (lambda T: {"T": ["warm"] * len(T)}, "ModelError: `T` has values of the type <U4, but numbers"),
    ],
)
def test_what_a_simulator_can_do_wrong(wrong: Any, said: str) -> None:
    def simulator(conditions: Any, **parameters: float) -> Any:
        return wrong(cooling(conditions, **parameters)["T"])

    with pytest.raises(OSError, match=f"no run of the plain simulator succeeded: rate = .*: {said}"):
        gu.diagnose(simulator, **given())


def test_a_simulator_that_does_not_repeat_is_asked_about() -> None:
    scatter = np.random.default_rng(5)

    def simulator(conditions: Any, **parameters: float) -> Any:
        found = cooling(conditions, **parameters)["T"]
        return {"T": found + scatter.normal(0, 0.05, len(found))}

    with pytest.raises(OSError, match="does not repeat: two runs with all inputs at their medians"):
        gu.diagnose(simulator, **given())
    found = gu.diagnose(simulator, **given(noisy=True, runs=120))
    assert found.verdict["effects"] == ["gain-error"]
    # half of u = 0.1 K
    assert any("scatter" in note for note in found.notes)
    twice = runs({"rate": [0.2, 0.2], "gain": [0, 0], "stray": [0, 0]}, {"T": [T, T + 1]})
    with pytest.raises(OSError, match="does not repeat: two runs at rate = 0.2 1/min, gain = 0.0"):
        gu.diagnose(twice, **given())


def test_some_runs_may_fail() -> None:
    def simulator(conditions: Any, **parameters: float) -> Any:
        if parameters["gain"] < -0.02:
            raise ArithmeticError("the amplifier saturates")
        return cooling(conditions, **parameters)

    found = gu.diagnose(simulator, **given())
    assert found.verdict["effects"] == ["gain-error"]
    assert any("the amplifier saturates" in note for note in found.notes)
    failed = found.runs["failed"].dropna()
    assert len(failed) and all("ArithmeticError: the amplifier saturates" in of for of in failed)


def test_an_interrupt_in_the_simulator_ends_the_diagnosis() -> None:
    def simulator(conditions: Any, **parameters: float) -> Any:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        gu.diagnose(simulator, **given())


def test_tables_of_other_libraries() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(measured())
    frame["u"] = 0.1
    found = gu.diagnose(cooling, **given(data=frame, uncertainties={"T": "u"}))
    same = gu.diagnose(cooling, **given(uncertainties={"T": np.full(len(T), 0.1)}))
    assert found.probability == same.probability
    there = found.predict(pandas.DataFrame({"t": [1.0, 2.0]}, index=[7, 8]), runs=5)
    assert list(there.columns) == ["T", "u(T)"] and list(there.index) == [7, 8]
    polars = pytest.importorskip("polars")
    found = gu.diagnose(cooling, **given(data=polars.DataFrame(measured())))
    assert found.probability == same.probability
    assert isinstance(found.predict(polars.DataFrame({"t": [1.0]}), runs=5), polars.DataFrame)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"outputs": {"S": "K"}}, "the data have no column 'S'; they have t, T"),
        ({"uncertainties": {"S": 1}}, "`uncertainties` names 'S', which is none of the outputs"),
        ({"uncertainties": {"T": [0.1]}}, r"the uncertainties of 'T' have the shape \(1,\), the data \(40,\)"),
        ({"data": {"t": T, "T": T[1:]}}, "the columns of the data have different lengths"),
        ({"inputs": {"rate": {"distribution": "normal", "mean": 0.2, "std": 0.001, "unit": "parsec/fortnightly"}}}, "fortnightly"),
        ({"effects": {"two": {"a": 1.0, "b": 1.0}}}, "has 2 parameters; say which of them make it absent"),
        ({"effects": {"none": {}}}, "has no parameter, and the simulator can only do what a parameter lets it"),
        ({"runs": -1}, "`runs` is -1, but must be a whole number from 1 to 1000000"),
        ({"runs": "many"}, "`runs` is 'many', but must be a whole number"),
        ({"seed": -1}, "`seed` is -1, but must be a whole number from 0"),
        ({"runs": 10}, "the simulator has to be run [0-9]+ times at least"),
    ],
)
def test_what_cannot_be_diagnosed(more: Any, said: str) -> None:
    with pytest.raises((ValueError, OSError), match=said):
        gu.diagnose(cooling, **given(**more))


def test_a_simulator_is_a_function() -> None:
    with pytest.raises(TypeError, match="the simulator is a int, but must be a function or gumption.runs"):
        gu.diagnose(3, **given())
