"""Models that are Python functions, traced or not."""

from __future__ import annotations

import math
import pickle
import warnings
from typing import Any

import numpy as np
import pytest

import gumption as gu


@gu.model(
    inputs={"mass": "g", "diameter": "mm", "height": "mm"}, outputs={"density": "kg/m^3"}
)
def cylinder(mass: Any, diameter: Any, height: Any) -> Any:
    """Density of a cylinder."""
    return 4 * mass / (np.pi * diameter**2 * height)


KNOWN = {
    "mass": gu.normal(21.32, 0.01, "g"),
    "diameter": gu.readings([12.01, 12.00, 12.02, 11.99, 12.01], "mm"),
    "height": gu.rectangular(24, 0.02, "mm"),
}

SAME = {
    "format": 1,
    "title": "Density of a cylinder.",
    "inputs": {name: known.to_dict() for name, known in KNOWN.items()},
    "equations": {"density": "4*mass/(pi*diameter^2*height)"},
    "outputs": {"density": {"unit": "kg/m^3"}},
}


def one(function: Any, **units: str) -> gu.Measurement:
    """A measurement of plain numbers."""
    inputs = units or {"x": "1", "y": "1"}
    return gu.model(inputs=inputs, outputs={"z": "1"})(function)


def test_the_example() -> None:
    assert cylinder.equations == SAME["equations"]
    traced, file = cylinder(**KNOWN).run(trials=20_000), gu.from_dict(SAME).run(trials=20_000)
    assert traced["density"].to_dict() == file["density"].to_dict()
    # 4 m/(pi d^2 h), and the squares of the relative uncertainties: s/sqrt(5) of the readings
    d = np.array([12.01, 12.00, 12.02, 11.99, 12.01])
    relative = math.sqrt(
        (0.01 / 21.32) ** 2 + (2 * d.std(ddof=1) / math.sqrt(5) / d.mean()) ** 2 + (0.02 / 24) ** 2 / 3
    )
    y = 4 * 21.32e-3 / (math.pi * (d.mean() * 1e-3) ** 2 * 24e-3)
    gum = traced["density"].gum
    assert math.isclose(gum.estimate, y, rel_tol=1e-12)
    assert math.isclose(gum.standard_uncertainty, y * relative, rel_tol=1e-12)


@pytest.mark.parametrize(
    ("function", "formula"),
    [
        (lambda x, y: (x + y) * (x - y), "(x + y)*(x - y)"),
        (lambda x, y: x - (y - 1), "x - (y - 1)"),
        (lambda x, y: x / (y * 2), "x/(y*2)"),
        (lambda x, y: -(x**2), "-x^2"),
        (lambda x, y: (-x) ** 2, "(-x)^2"),
        (lambda x, y: (x**y) ** 2, "(x^y)^2"),
        (lambda x, y: x ** (y**2), "x^y^2"),
        (lambda x, y: 2**x, "2^x"),
        (lambda x, y: x * -1.5, "x*-1.5"),
        (lambda x, y: x + -2, "x + -2"),
        (lambda x, y: np.sqrt(x) + np.arctan2(y, x), "sqrt(x) + atan2(y, x)"),
        (lambda x, y: np.float64(2.0) * np.log(x), "2*ln(x)"),
        (lambda x, y: np.hypot(x, y) + np.maximum(x, 0.25), "hypot(x, y) + max(x, 0.25)"),
        (lambda x, y: (x > y) + np.abs(y), "(x > y) + abs(y)"),
        (lambda x, y: np.square(x) + np.reciprocal(y), "x^2 + 1/y"),
        (lambda x, y: np.deg2rad(x), "x*pi/180"),
        (lambda x, y: x**-2, "x^(-2)"),
        (lambda x, y: x**0.5 + y ** (1 / 3), "x^(1/2) + y^(1/3)"),
        (lambda x, y: x**0.1234567, "x^0.1234567"),
    ],
)
def test_formulas(function: Any, formula: str) -> None:
    """The text of what was traced, and the same values from the engine and from Python."""
    traced = one(function)
    assert traced.equations == {"z": formula}
    gum = traced(x=(0.7, 0.01), y=(0.4, 0.01)).run(trials=0)["z"].gum
    assert math.isclose(gum.estimate, float(function(0.7, 0.4)), rel_tol=1e-14)


def test_arrays_within_a_function() -> None:
    """Matrices of traced numbers: sums, products, functions over elements."""

    def turned(x: Any, y: Any) -> Any:
        matrix = np.array([[0.6, -0.8], [0.8, 0.6]])
        both = matrix @ np.array([x, y])
        return np.sqrt(np.sum(both**2)) + np.exp(np.array([x, y])).sum() + sum([x, y])

    traced = one(turned)
    assert traced.equations is not None
    gum = traced(x=(0.3, 0.01), y=(0.4, 0.01)).run(trials=0)["z"].gum
    assert math.isclose(gum.estimate, float(turned(0.3, 0.4)), rel_tol=1e-14)


def test_what_is_used_again_is_computed_once() -> None:
    def repeated(x: Any, y: Any) -> Any:
        for _ in range(60):
            x = x * x - y * x
        return x

    traced = one(repeated)
    assert traced.equations is not None
    assert sum(map(len, traced.equations.values())) < 5000
    gum = traced(x=(0.5, 0.001), y=(0.1, 0.001)).run(trials=0)["z"].gum
    # the fixed point 0 attracts: the same roundings in the same order
    assert gum.estimate == repeated(0.5, 0.1)


def test_several_outputs_units_and_conditions() -> None:
    @gu.model(
        inputs={"a": "m/s^2", "tilt": "deg"},
        outputs={"a_x": "m/s^2", "a_z": "m/s^2"},
        conditions={"f": "Hz"},
    )
    def plane(a: Any, tilt: Any, f: Any) -> Any:
        rise = 1 + (f / gu.quantity(1, "kHz")) ** 2
        return {"a_z": a * np.cos(tilt) * rise, "a_x": a * np.sin(tilt) * rise}

    frequencies = np.array([0.0, 100.0, 200.0])
    result = plane((10, 0.01), (30, 0.1), conditions={"f": frequencies}).run(trials=20_000)
    expected = 10 * 0.5 * (1 + (frequencies / 1000) ** 2)
    assert np.allclose(result["a_x"].gum.estimate, expected, rtol=1e-14)
    assert result["a_x"].monte_carlo.symmetric_interval.shape == (3, 2)
    assert list(result.conditions["f"]) == list(frequencies)
    with pytest.raises(gu.ModelError, match="has conditions"):
        plane((10, 0.01), (30, 0.1))


def test_dimensions_are_checked() -> None:
    wrong = gu.model(inputs={"l": "mm", "t": "s"}, outputs={"z": "m"})(lambda l, t: l + t)
    with pytest.raises(gu.ModelError, match="they cannot be added"):
        wrong(l=1.0, t=2.0)


def test_exponents_of_quantities() -> None:
    side = gu.model(inputs={"v": "mm^3"}, outputs={"a": "mm", "b": "1/mm"})(
        lambda v: (v ** (1 / 3), np.power(v, -1 / 3))
    )
    result = side((8, 0.1)).run(trials=0)
    assert math.isclose(result["a"].gum.estimate, 2) and math.isclose(result["b"].gum.estimate, 0.5)


def test_an_object_given_twice_is_one_quantity() -> None:
    x = gu.normal(2.0, 0.1)
    twice = one(lambda x, y: x - y)(x=x, y=x).run(trials=1000)["z"]
    assert twice.gum.standard_uncertainty == 0
    assert twice.monte_carlo.standard_uncertainty == 0


def test_pickle() -> None:
    assert pickle.loads(pickle.dumps(cylinder)) is cylinder
    result = cylinder(**KNOWN).run(trials=20_000, seed=3)
    assert pickle.loads(pickle.dumps(result)).to_json() == result.to_json()


def branch(x: Any, y: Any) -> Any:
    """No formula decides like this."""
    return np.where(x > y, x, y) if isinstance(x, np.ndarray) else (x if x > y else y)


def loop(x: Any, y: Any) -> Any:
    """A loop whose end hangs on the value: numbers only."""
    total = 0.0
    while total < x:
        total += 0.25
    return total * math.exp(y)


untraced = gu.model(inputs={"x": "1", "y": "1"}, outputs={"z": "1"}, trace=False)(
    lambda x, y: 4 * x / (np.pi * y**2)
)


class TestUntraced:
    """Functions that Python evaluates, with the draws of the engine."""

    def test_it_is_said(self) -> None:
        slow = one(branch)
        assert slow.equations is None and "decides by" in str(slow.why_not_traced)
        with pytest.warns(gu.NotTracedWarning, match="slower"):
            slow(x=(1.0, 0.1), y=(1.0, 0.1))

    def test_the_trials_are_those_of_the_formula(self) -> None:
        traced = one(lambda x, y: 4 * x / (np.pi * y**2))
        known = {"x": gu.normal(3.0, 0.05), "y": gu.rectangular(2.0, 0.1)}
        with pytest.warns(gu.NotTracedWarning):
            slow = untraced(**known).run(trials=50_000)
        fast = traced(**known).run(trials=50_000)
        # the same draws; of the functions only divisions and products, which round alike
        assert np.array_equal(slow.samples("z"), fast.samples("z"))
        assert slow["z"].to_dict()["monte_carlo"] == fast["z"].to_dict()["monte_carlo"]
        a, b = slow["z"].gum, fast["z"].gum
        assert a.estimate == b.estimate
        # differences of fourth order over a quarter of u = 0.058: about (0.0144/2)^4 relative
        assert math.isclose(a.standard_uncertainty, b.standard_uncertainty, rel_tol=1e-7)
        assert np.allclose(slow["z"].budget.sensitivity, fast["z"].budget.sensitivity, rtol=1e-7)

    def test_units_are_converted(self) -> None:
        slow = gu.model(inputs={"l": "mm"}, outputs={"z": "cm"}, trace=False)(lambda l: l + 0.01)
        with pytest.warns(gu.NotTracedWarning):
            gum = slow(l=(5.0, 0.1)).run(trials=1000)["z"].gum
        # 5 mm + 0.01 m
        assert math.isclose(gum.estimate, 1.5, rel_tol=1e-14)
        assert math.isclose(gum.standard_uncertainty, 0.01, rel_tol=1e-9)

    def test_a_function_of_numbers(self) -> None:
        with pytest.warns(gu.NotTracedWarning):
            result = one(loop)(x=0.9, y=(0.5, 0.1)).run(trials=3000)
        assert math.isclose(result["z"].gum.estimate, math.exp(0.5), rel_tol=1e-14)
        # of exp the fourth-order error is h^4/480 with h = 0.05: 1e-8
        expected = 0.1 * math.exp(0.5)
        assert math.isclose(result["z"].gum.standard_uncertainty, expected, rel_tol=1e-7)

    def test_its_exception_is_raised(self) -> None:
        def broken(x: Any, y: Any) -> Any:
            raise KeyError("no table")

        with pytest.warns(gu.NotTracedWarning), pytest.raises(KeyError, match="no table"):
            one(broken)(x=(1.0, 0.1), y=1.0).run()

    def test_undefined_trials_are_counted(self) -> None:
        f = gu.model(inputs={"x": "1"}, outputs={"z": "1"}, trace=False)(np.sqrt)
        with pytest.warns(gu.NotTracedWarning), pytest.raises(gu.ModelError, match="no finite result"):
            f(x=(1.0, 0.5)).run(trials=20_000)

    def test_what_needs_formulas_says_so(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            model = untraced(x=(1.0, 0.1), y=(2.0, 0.1))
        for call in (
            lambda: gu.assumptions(model),
            lambda: model.set(x=2),
            lambda: gu.budgets(untraced, x=([1.0], [0.1]), y=2.0),
            lambda: model.run(trials=1000).to("xlsx"),
        ):
            with pytest.raises(gu.ModelError, match="traced"):
                call()
