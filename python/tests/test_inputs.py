"""What is known about inputs: shapes, numbers of other libraries, results, tables."""

from __future__ import annotations

import inspect
import math
import pickle
import re
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gumption as gu
from gumption import _gumption, _shapes


@gu.model(inputs={"x": "V"}, outputs={"y": "V"})
def same(x: Any) -> Any:
    return x * 1


@gu.model(inputs={"a": "V", "b": "V"}, outputs={"y": "V"})
def difference(a: Any, b: Any) -> Any:
    return a - b


def figures(known: Any) -> tuple[float, float]:
    gum = same(known).run(trials=0)["y"].gum
    return gum.estimate, gum.standard_uncertainty


@pytest.mark.parametrize(
    ("known", "mean", "u"),
    [
        (gu.constant(2.0), 2.0, 0.0),
        (gu.normal(2.0, 0.1), 2.0, 0.1),
        (gu.normal(2.0, expanded=0.2, k=2), 2.0, 0.1),
        (gu.normal(2000, "1 % + 5 mV", "mV"), 2.0, 0.025),
        (gu.rectangular(2.0, 0.3), 2.0, 0.3 / math.sqrt(3)),
        (gu.rectangular(lower=1.7, upper=2.3), 2.0, 0.3 / math.sqrt(3)),
        (gu.triangular(2.0, 0.3), 2.0, 0.3 / math.sqrt(6)),
        (gu.trapezoidal(2.0, 0.3, beta=0.5), 2.0, 0.3 * math.sqrt(1.25 / 6)),
        (gu.arcsine(2.0, 0.3), 2.0, 0.3 / math.sqrt(2)),
        (gu.curvilinear_trapezoid(1.7, 2.3, 0.1), 2.0, math.sqrt(0.3**2 / 3 + 0.1**2 / 9)),
        (gu.student_t(2.0, 0.1, 9), 2.0, 0.1),
        (gu.readings([1.9, 2.0, 2.1]), 2.0, 0.1 / math.sqrt(3)),
        (gu.exponential(2.0), 2.0, 2.0),
        (gu.gamma(4.0, 2.0), 2.0, 1.0),
        (gu.lognormal(2.0, 0.1), 2.0, 0.1),
        (gu.beta(2, 2, lower=1, upper=3), 2.0, 2 * math.sqrt(0.05)),
        (gu.log_uniform(1.0, math.e), math.e - 1, math.sqrt((math.e**2 - 1) / 2 - (math.e - 1) ** 2)),
        (gu.poisson_count(3), 4.0, 2.0),
        (gu.samples([1.0, 3.0]), 2.0, 1.0),
        (gu.known(distribution="normal", mean=2.0, std=0.1), 2.0, 0.1),
        ({"unit": "mV", "distribution": "normal", "mean": 2000, "std": 100}, 2.0, 0.1),
        ((2.0, 0.1), 2.0, 0.1),
        ((2.0, 0.1, 7), 2.0, 0.1),
        (2, 2.0, 0.0),
        (np.float32(2), 2.0, 0.0),
    ],
    ids=str,
)
def test_shapes(known: Any, mean: float, u: float) -> None:
    """Expectation and standard uncertainty of JCGM 101, table 1, or in closed form."""
    found = figures(known)
    assert found == pytest.approx((mean, u), rel=1e-12)


def test_components() -> None:
    parts = {"calibration": gu.normal(0, 0.03), "resolution": gu.rectangular(0, 0.04 * math.sqrt(3))}
    result = same(gu.components(2.0, parts)).run(trials=0)["y"]
    assert math.isclose(result.gum.standard_uncertainty, 0.05)
    assert list(result.budget.input) == ["x/calibration", "x/resolution"]


@pytest.mark.parametrize("wrong", [None, True, "abc", [1.0, 2.0], object(), np.array([1.0, 2.0])])
def test_what_is_no_quantity(wrong: Any) -> None:
    with pytest.raises((TypeError, gu.ModelError)):
        same(wrong)


def test_arguments_are_checked() -> None:
    with pytest.raises(TypeError, match="no input `z`"):
        difference(a=1, z=2)
    with pytest.raises(TypeError, match="nothing is said about b"):
        difference(1)
    with pytest.raises(TypeError, match="given twice"):
        difference(1, 2, a=1)


def test_units_are_checked() -> None:
    slow = gu.model(inputs={"x": "V"}, outputs={"y": "V"}, trace=False)(lambda x: x)
    for measurement in (same, slow):
        with pytest.raises(gu.ModelError, match="given in m, but the model takes V"):
            measurement(gu.normal(1, 0.1, "m"))
    plain = gu.model(inputs={"x": "V"}, outputs={"y": "V"}, check_units=False)(lambda x: x * 1)
    assert plain(gu.normal(1, 0.1, "V")).run(trials=0)["y"].gum.estimate == 1
    with pytest.raises(gu.ModelError, match="give it in V"):
        plain(gu.normal(1, 0.1, "mV"))


class TestScipy:
    stats = pytest.importorskip("scipy.stats")

    @pytest.mark.parametrize(
        "frozen",
        [
            stats.norm(2, 0.1),
            stats.uniform(1.5, 1),
            stats.triang(0.3, loc=1, scale=2),
            stats.arcsine(loc=1, scale=2),
            stats.trapezoid(0.25, 0.75, loc=1, scale=2),
            stats.expon(scale=2),
            stats.gamma(4, scale=0.5),
            stats.lognorm(0.2, scale=2),
            stats.beta(2, 3, loc=1, scale=2),
            stats.loguniform(1, 3),
        ],
        ids=lambda frozen: frozen.dist.name,
    )
    def test_shapes(self, frozen: Any) -> None:
        assert figures(frozen) == pytest.approx((frozen.mean(), frozen.std()), rel=1e-9)

    def test_t(self) -> None:
        gum = same(self.stats.t(5, loc=2, scale=0.1)).run(trials=0)["y"].gum
        assert (gum.estimate, gum.standard_uncertainty) == pytest.approx((2, 0.1))
        assert math.isclose(gum.dof, 5)

    def test_any_other_one(self) -> None:
        """By 10000 quantiles: of a Weibull distribution u is right to 1e-3."""
        frozen = self.stats.weibull_min(2.0, scale=2)
        assert figures(frozen) == pytest.approx((frozen.mean(), frozen.std()), rel=1e-3)


class TestUncertainties:
    lib = pytest.importorskip("uncertainties")

    def test_values(self) -> None:
        assert figures(self.lib.ufloat(2, 0.1)) == pytest.approx((2, 0.1))

    def test_what_is_shared_stays_so(self) -> None:
        a = self.lib.ufloat(2, 0.1)
        b = a + self.lib.ufloat(1, 0.05)
        result = difference(a=a, b=b).run(trials=200_000)["y"]
        expected = (a - b).std_dev
        assert math.isclose(result.gum.standard_uncertainty, expected, rel_tol=1e-9)
        # of 2e5 trials u scatters by 0.16 %; five of that: false failures below 1e-6
        assert math.isclose(result.monte_carlo.standard_uncertainty, expected, rel_tol=0.008)

    def test_the_same_one_twice(self) -> None:
        a = self.lib.ufloat(2, 0.1)
        gum = difference(a=a, b=a).run(trials=0)["y"].gum
        assert gum.standard_uncertainty < 1e-9


class TestGTC:
    lib = pytest.importorskip("GTC")

    def test_values_with_degrees_of_freedom(self) -> None:
        gum = same(self.lib.ureal(2, 0.1, 5)).run(trials=0)["y"].gum
        assert (gum.estimate, gum.standard_uncertainty) == pytest.approx((2, 0.1))
        assert math.isclose(gum.dof, 5)

    def test_what_is_shared_stays_so(self) -> None:
        a = self.lib.ureal(2, 0.1)
        b = a + self.lib.ureal(1, 0.05)
        gum = difference(a=a, b=b).run(trials=0)["y"].gum
        assert math.isclose(gum.standard_uncertainty, self.lib.uncertainty(a - b), rel_tol=1e-9)


def test_pint() -> None:
    pint = pytest.importorskip("pint")
    registry = pint.UnitRegistry()
    assert figures(registry.Quantity(2000, "mV")) == pytest.approx((2, 0))
    ufloat = pytest.importorskip("uncertainties").ufloat
    assert figures(registry.Quantity(ufloat(2000, 100), "mV")) == pytest.approx((2, 0.1))
    acceleration = gu.model(inputs={"x": "m/s^2"}, outputs={"y": "m/s^2"})(lambda x: x * 1)
    gum = acceleration(registry.Quantity(200, "cm/s**2")).run(trials=0)["y"].gum
    assert math.isclose(gum.estimate, 2)
    with pytest.raises(gu.ModelError):
        same(registry.Quantity(2, "m"))


def test_astropy() -> None:
    units = pytest.importorskip("astropy.units")
    assert figures(2000 * units.mV) == pytest.approx((2, 0))
    assert figures(2 * units.kg * units.m**2 / units.s**3 / units.A) == pytest.approx((2, 0))


class TestResults:
    @staticmethod
    def sum_and_difference() -> gu.Result:
        both = gu.model(inputs={"a": "V", "b": "V"}, outputs={"s": "V", "d": "V"})(
            lambda a, b: (a + b, a - b)
        )
        return both(a=(2, 0.1), b=(1, 0.1)).run(trials=100_000)

    def test_outputs_are_inputs_with_their_correlation(self) -> None:
        result = self.sum_and_difference()
        # (s + d)/2 is a again
        again = gu.model(inputs={"s": "V", "d": "V"}, outputs={"a": "V"})(lambda s, d: (s + d) / 2)
        a = again(s=result["s"], d=result["d"]).run(trials=100_000)["a"]
        assert math.isclose(a.gum.estimate, 2)
        assert math.isclose(a.gum.standard_uncertainty, 0.1, rel_tol=1e-12)
        # both runs of 1e5 trials scatter by 0.22 %
        assert math.isclose(a.monte_carlo.standard_uncertainty, 0.1, rel_tol=0.016)

    def test_from_a_file(self, tmp_path: Path) -> None:
        result = self.sum_and_difference()
        result.save(tmp_path / "r.json")
        found = figures(gu.result(tmp_path / "r.json", "s"))
        assert found == pytest.approx((3, math.sqrt(0.02)))
        assert figures(result["s"]) == found

    def test_in_a_file_of_models(self) -> None:
        result = self.sum_and_difference()
        model = gu.from_dict(
            {
                "inputs": {"s": result["s"], "d": result["d"]},
                "equations": {"y": "s - d"},
                "outputs": {"y": {"unit": "V"}},
            }
        )
        # 2 b
        assert math.isclose(model.run(trials=0)["y"].gum.standard_uncertainty, 0.2)
        other = model.with_inputs(d=gu.constant(1, "V")).run(trials=0)["y"]
        assert math.isclose(other.gum.standard_uncertainty, math.sqrt(0.02))


def linear(factor: float, offset: float = 0.0) -> gu.Measurement:
    return gu.model(inputs={"x": "V"}, outputs={"y": "V"})(
        lambda x: factor * x + gu.quantity(offset, "V")
    )


@gu.model(inputs={"p": "V", "q": "V"}, outputs={"z": "V"})
def combined(p: Any, q: Any) -> Any:
    return 3 * p - 2 * q


class TestOneQuantity:
    """An `Input` is one quantity in all results that came from it; uncertainties and GTC give 0 too."""

    @staticmethod
    def zero(model: gu.Model) -> None:
        z = model.run(trials=5000)["z"]
        assert (z.gum.estimate, z.gum.standard_uncertainty) == (0, 0)
        assert (z.monte_carlo.estimate, z.monte_carlo.standard_uncertainty) == (0, 0)
        assert not z.samples().any()

    @pytest.mark.parametrize(
        "x", [gu.normal(1.0, 0.3), gu.rectangular(1.0, 0.3, "V"), gu.readings([1.0, 1.5, 1.25, 1.5])]
    )
    def test_two_models(self, x: gu.Input) -> None:
        p, q = linear(2)(x).run(trials=1000), linear(3)(x).run(trials=1000, seed=5)
        self.zero(combined(p["y"], q["y"]))

    @pytest.mark.parametrize("library, number", [("uncertainties", "ufloat"), ("GTC", "ureal")])
    def test_a_number_of_others(self, library: str, number: str) -> None:
        x = getattr(pytest.importorskip(library), number)(1.0, 0.3)
        self.zero(combined(linear(2)(x).run(trials=0)["y"], linear(3)(x).run(trials=0)["y"]))

    def test_a_result_and_its_input(self) -> None:
        x = gu.normal(1.0, 0.3, "V")
        self.zero(combined(p=linear(2)(x).run(trials=0)["y"], q=linear(3)(x).run(trials=0)["y"]))
        twice = gu.model(inputs={"p": "V", "x": "V"}, outputs={"z": "V"})(lambda p, x: p - 2 * x)
        self.zero(twice(p=linear(2)(x).run(trials=0)["y"], x=x))

    def test_a_chain_of_results(self) -> None:
        x = gu.normal(1.0, 0.25)
        p = linear(2)(linear(2)(x).run(trials=1000)["y"]).run(trials=1000)
        q = linear(6)(x).run(trials=1000)
        self.zero(combined(p["y"], q["y"]))

    def test_the_same_result_in_two_models(self) -> None:
        base = gu.from_dict({
            "inputs": {"x": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.25}},
            "equations": {"y": "x"}, "outputs": {"y": {"unit": "V"}},
        }).run(trials=1000)["y"]  # fmt: skip
        self.zero(combined(linear(2)(base).run(trials=0)["y"], linear(3)(base).run(trials=0)["y"]))

    def test_two_runs_of_one_model(self) -> None:
        model = linear(1)((1.0, 0.25))
        first, second = model.run(trials=1000), model.run(trials=1000, seed=2)
        difference_ = gu.model(inputs={"p": "V", "q": "V"}, outputs={"z": "V"})(lambda p, q: p - q)
        self.zero(difference_(first["y"], second["y"]))
        self.zero(difference_(first["y"], first["y"]))

    def test_after_pickling(self) -> None:
        """Each on its own, as workers give them back."""
        x = gu.normal(1.0, 0.3)
        p, q = (pickle.loads(pickle.dumps(linear(f)(x).run(trials=0))) for f in (2, 3))
        self.zero(combined(p["y"], q["y"]))

    def test_in_a_dictionary_and_in_place_of_others(self) -> None:
        x = gu.normal(1.0, 0.3, "V")
        p, q = linear(2)(x).run(trials=1000)["y"], linear(3)(x).run(trials=1000)["y"]
        file = {"equations": {"z": "3*p - 2*q"}, "outputs": {"z": {"unit": "V"}}}
        self.zero(gu.from_dict({"inputs": {"p": p, "q": q}, **file}))
        self.zero(combined(p=(1.0, 0.1), q=(1.0, 0.1)).with_inputs(p=p, q=q))
        self.zero(combined(p=p, q=(1.0, 0.1)).with_inputs(q=q))

    def test_twice_in_a_dictionary(self) -> None:
        x = gu.normal(1.0, 0.3, "V")
        file = {"equations": {"z": "p - q"}, "outputs": {"z": {"unit": "V"}}}
        self.zero(gu.from_dict({"inputs": {"p": x, "q": x}, **file}))
        other = {"p": gu.normal(2.0, 0.1, "V"), "q": gu.normal(2.0, 0.1, "V")}
        model = gu.from_dict({"inputs": other, **file})
        self.zero(model.with_inputs(p=x, q=x))
        assert model.run(trials=0)["z"].gum.standard_uncertainty == pytest.approx(math.sqrt(0.02))

    def test_part_of_the_variance(self) -> None:
        """p = x + a, q = x + b: u^2(p - q) = u^2(a) + u^2(b); p + q has 4 u^2(x) more."""
        add = gu.model(inputs={"x": "V", "e": "V"}, outputs={"y": "V"})(lambda x, e: x + e)
        x = gu.normal(1.0, 0.3)
        p, q = (add(x, (0.0, u)).run(trials=1000)["y"] for u in (0.1, 0.2))
        both = gu.model(inputs={"p": "V", "q": "V"}, outputs={"s": "V", "d": "V"})(
            lambda p, q: (p + q, p - q)
        )
        result = both(p, q).run(trials=100_000)
        for name, variance in (("d", 0.05), ("s", 0.05 + 4 * 0.09)):
            u = math.sqrt(variance)
            assert math.isclose(result[name].gum.standard_uncertainty, u, rel_tol=1e-12)
            # of 1e5 trials u scatters by 0.22 %; five of that: false failures below 1e-6
            assert math.isclose(result[name].monte_carlo.standard_uncertainty, u, rel_tol=0.011)

    def test_correlations_travel(self) -> None:
        """a and b of r = 0.5 in the first model, and a again in the second."""
        add = gu.model(inputs={"a": "V", "b": "V"}, outputs={"y": "V"})(lambda a, b: a + b)
        a, b = gu.normal(1.0, 0.3), gu.normal(1.0, 0.4)
        s = add(a, b, correlations=[("a", "b", 0.5)]).run(trials=0)["y"]
        p = linear(1)(a).run(trials=0)["y"]
        # s - p is b
        minus = gu.model(inputs={"p": "V", "q": "V"}, outputs={"z": "V"})(lambda p, q: p - q)
        assert math.isclose(minus(s, p).run(trials=0)["z"].gum.standard_uncertainty, 0.4, rel_tol=1e-12)

    def test_what_is_independent_stays_as_it_was(self) -> None:
        p, q = linear(2)(gu.normal(1, 0.3)).run(trials=1000), linear(3)(gu.normal(1, 0.3)).run(trials=1000)
        result = combined(p["y"], q["y"]).run(trials=0)["z"]
        assert list(result.budget.input) == ["p", "q"]
        assert math.isclose(result.gum.standard_uncertainty, math.hypot(1.8, 1.8), rel_tol=1e-12)

    def test_what_cannot_be_put_together(self) -> None:
        x = gu.normal(1.0, 0.3, "V")
        q = linear(3)(x).run(trials=0)["y"]
        slow = gu.model(inputs={"x": "V"}, outputs={"y": "V"}, trace=False)(lambda x: 2 * x)
        with pytest.warns(gu.NotTracedWarning):
            p = slow(x).run(trials=1000)["y"]
        with pytest.raises(gu.ModelError, match="`p`, `q` go back to the same quantity.*not be traced"):
            combined(p, q)
        changed = linear(2)(x).set(x=2).run(trials=0)["y"]
        with pytest.raises(gu.ModelError, match="replaced by `set`"):
            combined(changed, q)
        here = gu.normal(1.0, 0.3)
        milli = gu.model(inputs={"x": "mV"}, outputs={"y": "V"})(lambda x: 2 * x)
        with pytest.raises(gu.ModelError, match="in mV in one of them and in V|in V in one of them and in mV"):
            combined(milli(here).run(trials=0)["y"], linear(3)(here).run(trials=0)["y"])

    def test_components(self) -> None:
        common = gu.normal(0, 0.1)
        a, b = (gu.components(1.0, {"common": common, "own": gu.normal(0, 0.1)}) for _ in range(2))
        with pytest.raises(gu.ModelError, match="one quantity among their components"):
            difference(a, b)


class TestTables:
    model = {
        "inputs": {"a": {"unit": "m", "distribution": "normal", "mean": 1, "std": 0.1}},
        "conditions": {"f": {"unit": "Hz", "values": [1]}},
        "equations": {"y": "a*f"},
        "outputs": {"y": {"unit": "m/s"}},
    }

    def test_pandas(self) -> None:
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame({"f": [0.1, 1 / 3, 2e-7], "note": ["a", "b", "c"]})
        result = gu.from_dict(self.model).with_conditions(frame).run(trials=1000)
        assert np.array_equal(result["y"].gum.estimate, frame["f"].to_numpy())
        assert np.array_equal(result.conditions["f"], frame["f"].to_numpy())
        table = result.to_pandas()
        assert np.array_equal(table["gum_estimate"].to_numpy(), frame["f"].to_numpy())
        assert table.index.names == ["f", "output"]

    def test_polars_and_units(self) -> None:
        polars = pytest.importorskip("polars")
        frame = polars.DataFrame({"f": [1.0, 2.0]})
        result = gu.from_dict(self.model).with_conditions(frame, {"f": "kHz"}).run(trials=0)
        assert np.allclose(result["y"].gum.estimate, [1000, 2000])

    def test_rows_are_the_same_as_those_of_a_file(self, tmp_path: Path) -> None:
        (tmp_path / "c.csv").write_text("f\n0.5\n2.5\n")
        file = {**self.model, "conditions": {"file": "c.csv", "units": {"f": "Hz"}}}
        a = gu.from_dict(file, folder=tmp_path).run(trials=2000)
        b = gu.from_dict(self.model).with_conditions({"f": [0.5, 2.5]}).run(trials=2000)
        assert a.to_dict()["rows"] == b.to_dict()["rows"]

    def test_what_is_missing(self) -> None:
        with pytest.raises(gu.ModelError, match="no column f"):
            gu.from_dict(self.model).with_conditions({"g": [1.0]})


#: The constructors by their distributions; `None` stands for components.
CONSTRUCTORS = {
    "constant": gu.constant, "normal": gu.normal, "rectangular": gu.rectangular,
    "triangular": gu.triangular, "trapezoidal": gu.trapezoidal, "arcsine": gu.arcsine,
    "curvilinear-trapezoid": gu.curvilinear_trapezoid, "t": gu.student_t, "readings": gu.readings,
    "exponential": gu.exponential, "gamma": gu.gamma, "lognormal": gu.lognormal, "beta": gu.beta,
    "log-uniform": gu.log_uniform, "poisson-count": gu.poisson_count, "samples": gu.samples,
    "result": gu.result, None: gu.components,
}  # fmt: skip

#: Keys of the engine that cannot stand beside the arguments that a constructor needs.
ELSEWHERE = {
    "readings": {"mean", "s", "n", "file", "column", "groups"},
    "samples": {"file", "column"},
}

#: Arguments that have another name than the key.
RENAMED = {"parts": "components"}


class TestKeys:
    """A key that is misspelt is an error where it is written."""

    @pytest.mark.parametrize("distribution", CONSTRUCTORS)
    def test_they_are_those_of_the_engine(self, distribution: str | None) -> None:
        """What type checkers offer is what the engine reads: no more, and no less."""
        function = CONSTRUCTORS[distribution]
        own = inspect.signature(function).parameters
        arguments = {RENAMED.get(name, name) for name in own if name != "more"}
        kind = re.fullmatch(r"Unpack\[(\w+)\]", own["more"].annotation)
        assert kind
        further = getattr(_shapes, kind[1])
        keys = further.__required_keys__ | further.__optional_keys__
        assert not arguments & keys
        engine = {*(_gumption.input_keys(distribution) or ())} - {"distribution"} | {"name"}
        assert arguments | keys | ELSEWHERE.get(distribution or "", set()) == engine

    def test_every_constructor_is_held(self) -> None:
        made = {name for name in gu.__all__ if isinstance(f := getattr(gu, name), types.FunctionType)
                and f.__module__ == "gumption._shapes" and name != "known"}  # fmt: skip
        assert made == {function.__name__ for function in CONSTRUCTORS.values()}

    @pytest.mark.parametrize(
        ("make", "near"),
        [
            (lambda: gu.normal(1, sdt=0.1), "`sdt`; did you mean `std`"),
            (lambda: gu.normal(1, 0.1, abuot="scale"), "`abuot`; did you mean `about`"),
            (lambda: gu.normal(1, 0.1, groupe=None), "`groupe`; did you mean `group`"),
            (lambda: gu.rectangular(1, halfwidth=0.1), "`halfwidth`; did you mean `half_width`"),
            (lambda: gu.exponential(1, std=0.1), "`exponential` has no key `std`; there are mean, unit"),
            (lambda: gu.readings([1, 2], unti="V"), "`unti`; did you mean `unit`"),
            (lambda: gu.components(1, {}, evidence=[1]), "with components has no key `evidence`"),
            (lambda: gu.known(distribution="uniform", men=1), "`men`; did you mean `mean`"),
        ],
    )
    def test_a_misspelt_key(self, make: Callable[[], gu.Input], near: str) -> None:
        with pytest.raises(TypeError, match=near):
            make()

    def test_right_keys(self) -> None:
        known = gu.normal(5, "0.02 % FS", "V", full_scale=10, about="scale", type="B", group="g", per="row")
        assert known.spec["full_scale"] == 10 and known.spec["about"] == "scale"
        assert figures(known) == (5.0, 0.002)
        assert gu.known(distribution="uniform", mean=1, semi_range=0.1).spec["semi_range"] == 0.1

    @pytest.mark.parametrize(
        "number", [np.float32(2), np.int64(2), np.array(2.0), np.array(2), np.float64(2)]
    )
    def test_numbers_of_numpy(self, number: Any) -> None:
        """2 is exact in every kind of number; u = 2."""
        assert figures(number) == (2.0, 0.0)
        assert figures((number, number)) == figures(gu.normal(number, number)) == (2.0, 2.0)
        assert figures(gu.known(distribution="normal", mean=number, std=number)) == (2.0, 2.0)
