"""What a diagnosis of a simulator's gap is given: effects and runs, and what is no effect and no runs."""

from __future__ import annotations

import math
from typing import Any

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
        "neutral": {"drag": 0.0},
    }
    assert as_effect({"drag": DRAG}, "air-drag").neutral == {"drag": 0.0}
    assert as_effect(found, "air-drag") is found


def test_an_effect_names_what_makes_it_absent() -> None:
    found = effect({"pivot": log_uniform(1e-4, 1e-1, "1"), "width": (1.0, 0.1)}, neutral={"pivot": 0})
    assert found.neutral == {"pivot": 0.0}
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
        ({}, {}, "an effect of the simulator needs a parameter"),
        (
            {"a": DRAG, "b": DRAG},
            {},
            "the effect has the parameters a, b: say which of them make it absent, and at which values, "
            "such as neutral={'a': 0}",
        ),
        ({"a": DRAG}, {"neutral": {}}, "`neutral` names no parameter"),
        ({"a": DRAG}, {"neutral": {"c": 0}}, "`neutral` names 'c', but the parameters are a"),
        (
            {"a": DRAG},
            {"neutral": {"a": math.nan}},
            "the neutral value of 'a' is nan, but must be a finite number",
        ),
        (
            {"a": DRAG},
            {"neutral": {"a": "0"}},
            "the neutral value of 'a' is '0', but must be a finite number",
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
    with pytest.raises(ValueError, match="^the effect 'friction': the effect has the parameters a, b"):
        as_effect({"a": DRAG, "b": DRAG}, "friction")
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
        ({"a": [1, 2, 1]}, {"y": [[1], [2], [3]]}, "the runs 1 and 3 have the same parameters"),
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
