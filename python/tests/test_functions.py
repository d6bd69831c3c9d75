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


class TestAngles:
    """Within a function angles are in radians: what converts them again is asked about."""

    @pytest.mark.parametrize(
        "function",
        [
            lambda a: np.sin(np.deg2rad(a)),
            lambda a: np.sin(np.radians(a)),
            lambda a: np.sin(a * np.pi / 180),
            lambda a: np.sin(np.pi / 180 * a),
            lambda a: np.sin(a / 180 * math.pi),
            lambda a: np.sin(0.0174533 * (a + gu.quantity(1, "deg"))),
            lambda a: np.sin(a / 57.3),
            lambda a: np.cos(np.deg2rad(np.array([a, 2 * a]))).sum(),
        ],
    )
    def test_degrees_to_radians(self, function: Any) -> None:
        with pytest.raises(gu.ModelError, match="in radians already.*check_units=False"):
            gu.model(inputs={"a": "deg"}, outputs={"z": "1"})(function)

    @pytest.mark.parametrize(
        "function",
        [
            lambda y, x: np.rad2deg(np.arctan2(y, x)),
            lambda y, x: np.degrees(np.arctan2(y, x)) + 1,
            lambda y, x: np.arctan(y / x) * 180 / np.pi,
            lambda y, x: 57.29578 * np.arcsin(y / x),
        ],
    )
    def test_radians_to_degrees(self, function: Any) -> None:
        with pytest.raises(gu.ModelError, match="taken in radians.*check_units=False"):
            gu.model(inputs={"y": "mm", "x": "mm"}, outputs={"phi": "deg"})(function)

    def test_it_cannot_be_swallowed(self) -> None:
        def caught(a: Any) -> Any:
            try:
                return np.sin(np.deg2rad(a))
            except Exception:
                return a

        with pytest.raises(gu.ModelError, match="in radians already"):
            gu.model(inputs={"a": "deg"}, outputs={"z": "1"})(caught)

    def test_both_readings(self) -> None:
        """sin 0.5 of 30 deg: without the conversion, or with the numbers of the declared units."""
        in_radians = gu.model(inputs={"a": "deg"}, outputs={"z": "1"})(lambda a: np.sin(a))
        declared = gu.model(inputs={"a": "deg"}, outputs={"z": "1"}, check_units=False)(
            lambda a: np.sin(np.deg2rad(a))
        )
        for measurement in (in_radians, declared):
            gum = measurement(a=(30, 0.1)).run(trials=0)["z"].gum
            assert math.isclose(gum.estimate, 0.5, rel_tol=1e-14)
            u = math.cos(math.pi / 6) * math.radians(0.1)
            assert math.isclose(gum.standard_uncertainty, u, rel_tol=1e-12)

    def test_what_is_right(self) -> None:
        """Degrees as a number, of a number, and back."""
        right = gu.model(inputs={"a": "deg", "x": "1"}, outputs={"z": "1", "phi": "deg"})(
            lambda a, x: (
                np.rad2deg(a) + np.sin(np.deg2rad(x)),
                np.deg2rad(np.rad2deg(a) + x),
            )
        )
        result = right(a=(30, 0.1), x=(90, 0.1)).run(trials=0)
        assert math.isclose(result["z"].gum.estimate, 31, rel_tol=1e-14)
        assert math.isclose(result["phi"].gum.estimate, 120, rel_tol=1e-14)

    def test_other_libraries_are_told_the_units(self) -> None:
        """`math.radians` takes a number: what it gets is in the warning."""
        f = gu.model(inputs={"a": "deg"}, outputs={"z": "1"})(lambda a: math.sin(math.radians(a)))
        with pytest.warns(gu.NotTracedWarning) as said:
            f(a=(30, 0.1))
        text = str(said[0].message)
        assert "`a` is in rad (declared in deg)" in text and "It uses `radians`" in text


class TestDecisions:
    """An `if` is about numbers in coherent SI units."""

    @pytest.mark.parametrize(
        "function",
        [
            lambda d: d if d > 10 else 2 * d,
            lambda d: d if 10 < d else 2 * d,
            lambda d: max(d, 10),
            lambda d: d if d == 12 else 2 * d,
            lambda d: d if d - 10 > 0 else 2 * d,
        ],
    )
    def test_numbers_without_a_unit(self, function: Any) -> None:
        with pytest.raises(gu.ModelError) as raised:
            gu.model(inputs={"d": "mm"}, outputs={"z": "mm"})(function)
        # both readings, and how to say which
        for word in ("`d` is in m (declared in mm)", 'quantity(..., "mm")', "check_units=False"):
            assert word in str(raised.value)

    def test_it_cannot_be_swallowed(self) -> None:
        def caught(d: Any) -> Any:
            try:
                return d if d > 10 else 2 * d
            except TypeError:
                return 3 * d

        with pytest.raises(gu.ModelError, match="cannot be compared"):
            gu.model(inputs={"d": "mm"}, outputs={"z": "mm"})(caught)

    def test_both_readings(self) -> None:
        """12 mm is more than 10 mm."""
        with_unit = gu.model(inputs={"d": "mm"}, outputs={"z": "mm"})(
            lambda d: d if d > gu.quantity(10, "mm") else 2 * d
        )
        declared = gu.model(inputs={"d": "mm"}, outputs={"z": "mm"}, check_units=False)(
            lambda d: d if d > 10 else 2 * d
        )
        with pytest.warns(gu.NotTracedWarning, match="Dimensions are not checked"):
            assert with_unit(d=(12, 0.1)).run(trials=0)["z"].gum.estimate == pytest.approx(12)
        with pytest.warns(gu.NotTracedWarning):
            assert declared(d=(12, 0.1)).run(trials=0)["z"].gum.estimate == 12


def cyl(diameter: Any, h: Any) -> Any:
    return np.pi * diameter**2 * h / 4


class TestArguments:
    """Names and order are the function's own."""

    def test_names_that_are_no_arguments(self) -> None:
        with pytest.raises(TypeError, match="`d` is no argument of `cyl`; its arguments are diameter, h"):
            gu.model(inputs={"h": "mm", "d": "mm"}, outputs={"V": "mm^3"})(cyl)
        with pytest.raises(TypeError, match="`k` is no argument"):
            gu.model(inputs={"diameter": "mm", "h": "mm"}, conditions={"k": "1"}, outputs={"V": "mm^3"})(cyl)

    def test_arguments_without_a_name(self) -> None:
        with pytest.raises(TypeError, match="`cyl` also takes h"):
            gu.model(inputs={"diameter": "mm"}, outputs={"V": "mm^3"})(cyl)

    @pytest.mark.parametrize("trace", [True, False])
    def test_order(self, trace: bool) -> None:
        """10 mm wide and 24 mm high: pi 10^2 24/4 = 1885.0 mm^3, however the dictionary is written."""
        for inputs in ({"h": "mm", "diameter": "mm"}, {"diameter": "mm", "h": "mm"}):
            f = gu.model(inputs=inputs, outputs={"V": "mm^3"}, trace=trace)(cyl)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", gu.NotTracedWarning)
                models = f(10.0, 24.0), f(10.0, h=24.0), f(h=24.0, diameter=10.0)
            for model in models:
                assert round(model.run(trials=0)["V"].gum.estimate, 1) == 1885.0

    def test_functions_of_c(self) -> None:
        """`math.atan2(y, x, /)` and `numpy.arctan2(x1, x2, /)` have names, `math.hypot` has none."""
        for function, names in ((math.atan2, ("x", "y")), (np.arctan2, ("x2", "x1"))):
            f = gu.model(inputs=dict.fromkeys(names, "1"), outputs={"z": "1"}, trace=False)(function)
            with pytest.warns(gu.NotTracedWarning):
                gum = f(3.0, 4.0).run(trials=0)["z"].gum
            assert math.isclose(gum.estimate, math.atan2(3, 4), rel_tol=1e-15)
        with pytest.raises(TypeError, match="no argument of `atan2`; its arguments are y, x"):
            gu.model(inputs={"a": "1", "b": "1"}, outputs={"z": "1"})(math.atan2)
        hypot = gu.model(inputs={"a": "1", "b": "1"}, outputs={"z": "1"}, trace=False)(math.hypot)
        with pytest.warns(gu.NotTracedWarning):
            assert hypot(3.0, 4.0).run(trials=0)["z"].gum.estimate == 5

    def test_a_condition_among_the_inputs(self) -> None:
        f = gu.model(inputs={"a": "1", "b": "1"}, conditions={"t": "1"}, outputs={"z": "1"})(
            lambda a, t, b: a * t - b
        )
        with pytest.raises(TypeError, match="give the others by name"):
            f(1.0, 2.0, conditions={"t": [3.0]})
        assert f(1.0, b=2.0, conditions={"t": [3.0]}).run(trials=0)["z"].gum.estimate == [1.0]


SCALE = 2.0


class TestChecked:
    """What `test_constructs.py` does not show."""

    def test_the_difference_is_said(self) -> None:
        f = one(lambda x, y: 2 * x + y if isinstance(x, float) else 3 * x + y)
        with pytest.warns(gu.NotTracedWarning) as said:
            f(x=1.0, y=(2.0, 0.1))
        text = str(said[0].message)
        assert "`z` is 5, and one draw at a time 4, at x = 1, y = 2" in text

    def test_a_global_that_changes(self, monkeypatch: pytest.MonkeyPatch) -> None:
        f = one(lambda x, y: SCALE * x + y)
        model = f(x=(1.0, 0.1), y=1.0)
        assert model.run(trials=0)["z"].gum.estimate == 3
        monkeypatch.setitem(globals(), "SCALE", 5.0)
        # the model that was made is no longer that of the function
        with pytest.raises(gu.ModelError, match="same value"):
            model.run(trials=0)
        # and a new one is not evaluated by what was traced before
        with pytest.warns(gu.NotTracedWarning, match="not evaluated by its formulas"):
            assert f(x=(1.0, 0.1), y=1.0).run(trials=0)["z"].gum.estimate == 6

    def test_models_that_are_made_of_it(self) -> None:
        """Another estimate may be where the formulas do not hold."""

        def f(x: Any, y: Any) -> Any:
            return x + y if not isinstance(x, float) or x < 10 else 7 * x

        model = one(f)(x=(1.0, 0.1), y=1.0)
        assert model.set(x=5).run(trials=0)["z"].gum.estimate == 6
        for other in (lambda: model.set(x=20), lambda: model.with_inputs(x=(20, 0.1))):
            with pytest.raises(gu.ModelError, match="one draw at a time"):
                other()

    @pytest.mark.parametrize("limit", [3.0, 4.0])
    def test_what_hangs_on_rare_draws(self, limit: float) -> None:
        """Of 1024 draws one is beyond 3 standard uncertainties in 3 of 4 cases, and beyond 4 in 1 of 30:
        that is noticed when the model is made, or in the blocks of the run."""
        f = one(lambda x, y: y + (1 if np.any(np.asarray(x > limit)) else 0) + 0 * x)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            model = f(x=(0.0, 1.0), y=(1.0, 0.1))
        if "one draw at a time" not in str(said[0].message):
            with pytest.raises(gu.ModelError, match="hangs on the others"):
                model.run(trials=500_000)

    def test_rows_of_conditions(self) -> None:
        f = gu.model(inputs={"x": "1"}, conditions={"t": "1"}, outputs={"z": "1"})(
            lambda x, t: np.max([x * t, 2.0])
        )
        with pytest.warns(gu.NotTracedWarning, match="one draw at a time"):
            z = f(x=(1.0, 0.01), conditions={"t": [1.0, 3.0]}).run(trials=0)["z"]
        assert list(z.gum.estimate) == [2.0, 3.0]

    def test_without_the_check(self) -> None:
        calls = []

        def f(x: Any, y: Any) -> Any:
            calls.append(x)
            return x * y

        unchecked = gu.model(inputs={"x": "1", "y": "1"}, outputs={"z": "1"}, check=False)(f)
        model = unchecked(x=(1.0, 0.1), y=2.0)
        model.run(trials=0)
        # it was traced, and never called again
        assert len(calls) == 1

    def test_scales_with_zeros_of_their_own(self) -> None:
        """20 degC is 68 degF, and 20 dBm is -10 dBW: the engine converts, which is no difference."""
        units = {"inputs": {"t": "degC", "p": "dBm"}, "outputs": {"T": "degF", "q": "dBW"}}
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            f = gu.model(**units)(lambda t, p: (t, p))
            result = f(t=(20, 0.1), p=(20, 0.1)).run(trials=0)
        assert math.isclose(result["T"].gum.estimate, 68)
        assert result["q"].gum.estimate == -10
        # where Python computes nobody knows what is to be converted
        by_python = gu.model(**units, trace=False)(lambda t, p: (t, p))
        with pytest.raises(gu.ModelError, match="levels in dBm and `q` in dBW"):
            by_python(t=(20, 0.1), p=(20, 0.1))

    def test_what_nearly_cancels_is_no_difference(self) -> None:
        """(1 - cos x)/x^2 of x = 1e-6: rounding alone is of the order of 1e-4."""
        f = one(lambda x, y: (1 - np.cos(x)) / x**2 + y)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            f(x=(1e-6, 1e-8), y=1.0)

    def test_budgets_in_columns(self) -> None:
        f = one(lambda x, y: x + y if not isinstance(x, float) or x < 10 else 7 * x)
        assert list(gu.budgets(f, x=([1.0, 2.0], 0.1), y=1.0).estimate) == [2, 3]
        with pytest.raises(gu.ModelError, match="one draw at a time"):
            gu.budgets(f, x=([1.0, 20.0], 0.1), y=1.0)

    def test_what_is_pickled(self) -> None:
        again = pickle.loads(pickle.dumps(clipped))
        assert again is clipped
        with pytest.warns(gu.NotTracedWarning, match="one draw at a time"):
            model = clipped(x=(1.0, 0.1))
        there = pickle.loads(pickle.dumps(model))
        assert there.run(trials=2000).to_json() == model.run(trials=2000).to_json()


@gu.model(inputs={"x": "1"}, outputs={"z": "1"})
def clipped(x: Any) -> Any:
    return np.min([x, 1.0])


def test_exponents_of_quantities() -> None:
    side = gu.model(inputs={"v": "mm^3"}, outputs={"a": "mm", "b": "1/mm"})(
        lambda v: (v ** (1 / 3), np.power(v, -1 / 3))
    )
    result = side((8, 0.1)).run(trials=0)
    assert math.isclose(result["a"].gum.estimate, 2) and math.isclose(result["b"].gum.estimate, 0.5)


def test_an_object_given_twice_is_one_quantity() -> None:
    x = gu.normal(2.0, 0.1)
    for trace in (True, False):
        f = gu.model(inputs={"x": "1", "y": "1"}, outputs={"z": "1"}, trace=trace)(lambda x, y: x - y)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", gu.NotTracedWarning)
            twice = f(x=x, y=x).run(trials=1000)["z"]
        assert twice.gum.standard_uncertainty == 0
        assert twice.monte_carlo.standard_uncertainty == 0
    lengths = gu.model(inputs={"x": "mm", "y": "cm"}, outputs={"z": "mm"})(lambda x, y: x - y)
    with pytest.raises(gu.ModelError, match="no unit of its own"):
        lengths(x=x, y=x)
    same = gu.normal(2.0, 0.1, "mm")
    assert lengths(x=same, y=same).run(trials=0)["z"].gum.standard_uncertainty == 0


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

        with pytest.raises(KeyError, match="no table"):
            one(broken)(x=(1.0, 0.1), y=1.0)

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
