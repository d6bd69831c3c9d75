"""Quantities as numbers: formulas, identity, units, arrays, complex numbers."""

from __future__ import annotations

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

import gumption as gu

#: Rounding of some hundred operations.
ROUNDING = 1e-13


def close(found: Any, known: Any) -> None:
    np.testing.assert_allclose(found, known, rtol=ROUNDING, atol=ROUNDING)


class TestFigures:
    def test_operators(self) -> None:
        x, y = gu.normal(3, 0.1), gu.normal(2, 0.2)
        # u^2 = (c_x u_x)^2 + (c_y u_y)^2 with derivatives by hand
        for quantity, value, by_x, by_y in [
            (x + y, 5, 1, 1),
            (x - y, 1, 1, -1),
            (x * y, 6, 2, 3),
            (x / y, 1.5, 0.5, -0.75),
            (x**y, 9, 2 * 3, 9 * math.log(3)),
            (2 - x, -1, -1, 0),
            (1 / x, 1 / 3, -1 / 9, 0),
            (2**x, 8, 8 * math.log(2), 0),
            (-x, -3, -1, 0),
            (+x, 3, 1, 0),
            (abs(-x), 3, 1, 0),
            (7 % x, 1, -2, 0),
            (np.hypot(x, y), math.hypot(3, 2), 3 / math.hypot(3, 2), 2 / math.hypot(3, 2)),
            (np.arctan2(x, y), math.atan2(3, 2), 2 / 13, -3 / 13),
            (np.minimum(x, y), 2, 0, 1),
            (np.where(x > y, x, 2 * y), 3, 1, 0),
            (np.clip(x, 0, 2.5), 2.5, 0, 0),
            (np.float64(2) * x, 6, 2, 0),
        ]:
            close(quantity.estimate, value)
            close(quantity.u, math.hypot(by_x * 0.1, by_y * 0.2))

    @pytest.mark.parametrize(
        ("function", "at"),
        [
            (np.sin, 0.3), (np.cos, 0.3), (np.tan, 0.3), (np.arcsin, 0.3), (np.arccos, 0.3), (np.arctan, 0.3),
            (np.sinh, 0.3), (np.cosh, 0.3), (np.tanh, 0.3), (np.arcsinh, 0.3), (np.arccosh, 1.3),
            (np.arctanh, 0.3), (np.exp, 0.3), (np.expm1, 0.3), (np.log, 0.3), (np.log10, 0.3), (np.log1p, 0.3),
            (np.log2, 0.3), (np.exp2, 0.3), (np.sqrt, 0.3), (np.cbrt, 0.3), (np.square, 0.3), (np.abs, -0.3),
            (np.reciprocal, 0.3),
        ],
    )  # fmt: skip
    def test_functions(self, function: Any, at: float) -> None:
        found = function(gu.normal(at, 0.01))
        close(found.estimate, function(at))
        # a five-point derivative, whose error is below 1e-10 for steps of 1e-3
        h = 1e-3
        slope = (function(at - 2 * h) - 8 * function(at - h) + 8 * function(at + h) - function(at + 2 * h)) / 12 / h
        assert found.u == pytest.approx(abs(slope) * 0.01, rel=1e-8)

    def test_expanded_uncertainty_and_degrees_of_freedom(self) -> None:
        x, y = gu.normal(10, 0.3, dof=4), gu.normal(20, 0.4, dof=8)
        total = x + y
        # Welch and Satterthwaite; for 11 (the integer below) and 95.45 % JCGM 100, table G.2, has 2.25
        close(total.dof, 0.5**4 / (0.3**4 / 4 + 0.4**4 / 8))
        assert total.k == pytest.approx(2.25, abs=5e-3)
        close(total.U, total.k * 0.5)

    def test_trials_beside(self) -> None:
        x = gu.rectangular(0, 1)
        result = (x * x).run(trials=1_000_000, seed=1)
        # u by first order is 0; the square of a rectangular quantity has the standard deviation 2/sqrt(45)
        close(result.y.u, 0)
        # the relative standard error of a standard deviation of 1e6 trials is below 1e-3; six of them
        assert result.y.monte_carlo.standard_uncertainty == pytest.approx(2 / math.sqrt(45), rel=6e-3)

    def test_models_of_several_outputs(self) -> None:
        v, i = gu.normal(5, 0.01, "V", name="v"), gu.normal(0.02, 1e-5, "A", name="i")
        model = gu.model_of({"R": v / i, "P": v * i}, title="Resistor")
        assert list(model.outputs) == ["R", "P"]
        assert model.title == "Resistor"
        assert model.outputs == {"R": "V/A", "P": "V·A"}
        r_v, r_i = (0.01 / 5) ** 2, (1e-5 / 0.02) ** 2
        close(model.run(trials=0).correlations()[0, 1], (r_v - r_i) / (r_v + r_i))

    def test_text(self) -> None:
        assert str(gu.normal(1.2345, 0.0234, "cm")) == "1.235(23) cm"
        assert str(gu.normal(12.3, 1.26)) == "12.3(1.3)"
        assert str(gu.constant(5)) == "5"
        assert repr(gu.normal(5, 0.1, "V", name="V") - gu.constant(5, "V")).startswith("<gumption.Expression V - 5 [V] =")
        assert f"{2 * gu.normal(100, 20, 'g')}" == "200(40) g"
        assert str(gu.normal(0.0034112, 1.2e-6)) == "0.0034112(12)"
        assert repr(2 * gu.normal(1, 0.1, "V", name="v")) == "<gumption.Expression 2*v = 2.00(20) V>"
        assert str(gu.complex_normal(3 - 4j, 0.1)) == "(3.00(10)-4.00(10)j)"
        assert str(gu.array([1, 2], 0.1, "V")) == "[1.00(10) V 2.00(10) V]"


class TestIdentity:
    def test_a_quantity_is_one_quantity(self) -> None:
        x = gu.normal(1, 0.1)
        for nothing in (x - x, 2 * x - x - x, x / x - 1, x**2 - x * x):
            close([nothing.estimate, nothing.u], [0, 0])

    def test_results_of_results(self) -> None:
        x, y = gu.normal(1, 0.1, "m"), gu.normal(2, 0.2, "m")
        first = (x + y).run(trials=0).y
        second = (first - x).run(trials=0).y
        close([second.estimate, second.u], [2, 0.2])
        close((second - y).u, 0)
        close((2 * first - 2 * x - 2 * second).u, 0)

    def test_a_result_in_an_expression_is_its_formula(self) -> None:
        x = gu.normal(0, 0.1)
        square = (x * x).run(trials=1000, seed=1).y
        # by first order, as the result itself, whose trials have another mean
        close([square.estimate, (3 * square).estimate, (3 * square).u], [0, 0, 0])
        assert list((2 * gu.normal(1, 0.1, name="y")).run(trials=0)) == ["y_2"]
        assert list((2 * square).run(trials=0)) == ["y"]

    def test_results_of_functions(self) -> None:
        @gu.model(inputs={"a": "V", "b": "ohm"}, outputs={"i": "A", "p": "W"})
        def current(a: Any, b: Any) -> Any:
            return a / b, a**2 / b

        a, b = gu.normal(10, 0.1, "V"), gu.normal(5, 0.05, "ohm")
        result = current(a=a, b=b).run(trials=0)
        # p = a i
        close((result.p - a * result.i).u, 0)
        close((result["i"] * b - a).u, 0)

    def test_expressions_as_inputs(self) -> None:
        @gu.model(inputs={"mass": "g", "volume": "cm^3"}, outputs={"density": "kg/m^3"})
        def density(mass: Any, volume: Any) -> Any:
            return mass / volume

        tare, edge = gu.normal(5, 0.02, "g"), gu.normal(10, 0.01, "mm")
        result = density(mass=gu.normal(25, 0.02, "g") - tare, volume=edge**3).run(trials=0)
        close(result.density.estimate, 20000)
        close(result.density.u / 20000, math.sqrt(2 * (0.02 / 20) ** 2 + (3 * 0.01 / 10) ** 2))
        close((result.density * edge**3 + tare).to("g").u, 0.02)

        changed = density(mass=20.0, volume=(1.0, 0.1)).with_inputs(mass=gu.normal(25, 0.02, "g") - tare)
        close(changed.run(trials=0).density.estimate, 20000)

    def test_copies_are_the_same_quantity(self) -> None:
        x, y = gu.normal(1, 0.1, "V", name="x"), gu.normal(2, 0.1, "V")
        total = np.sqrt(x**2 + y**2)
        again, other = pickle.loads(pickle.dumps((total, x)))
        close((again - total).u, 0)
        assert (again - other).u == (total - x).u
        assert other.name == "x"

    def test_long_expressions_are_copied(self) -> None:
        total = sum(gu.normal(1, 0.1) for _ in range(2000))
        close((pickle.loads(pickle.dumps(total)) - total).u, 0)
        close((copy.deepcopy(total) - total).u, 0)

    def test_few_paired_readings(self) -> None:
        first, second = [1, 2, 3, 4.5], [2, 2.5, 3.5, 4]
        both = gu.array([gu.readings(first, paired=True), gu.readings(second, paired=True)])
        close(both.covariance, np.cov(first, second) / 4)
        close(both.u, np.sqrt(np.diag(np.cov(first, second)) / 4))
        total = both.sum()
        # s/sqrt(n) of the sums (JCGM 100, 5.2.3); with trials five readings at least are needed
        close(total.u, np.std(np.add(first, second), ddof=1) / 2)
        close(total.run(trials=0).y.u, total.u)

    def test_a_sum_of_many(self) -> None:
        x = gu.normal(1, 0.1)
        total: Any = 0
        for _ in range(5000):
            total = total + x
        close(total.u, 500)


class TestUnits:
    def test_units_follow(self) -> None:
        g, mm, s = gu.normal(10, 0.1, "g"), gu.normal(2, 0.1, "mm"), gu.normal(3, 0.1, "s")
        assert (g / mm**3).unit == "g/mm^3"
        assert (mm * mm / s).unit == "mm^2/s"
        assert np.sqrt(mm / s**2).unit == "mm^(1/2)/s"
        assert (mm / mm).unit == "1"
        assert (mm + gu.normal(1, 0.1, "m")).unit == "mm"
        assert (gu.constant(1, "m") + mm).unit == "m"
        assert np.arctan2(mm, mm).unit == "rad"
        close((mm + gu.normal(1, 0.1, "m")).estimate, 1002)
        close((g / mm**3).to("kg/m^3").estimate, 1250e3)

    def test_angles(self) -> None:
        angle = gu.normal(30, 0.1, "deg")
        close(np.sin(angle).estimate, 0.5)
        close(np.sin(angle).u, math.cos(math.pi / 6) * math.radians(0.1))
        close(np.arcsin(gu.normal(0.5, 0.01)).to("deg").estimate, 30)

    def test_temperatures(self) -> None:
        low, high = gu.normal(20, 0.03, "degC"), gu.normal(25, 0.04, "degC")
        assert (high - low).unit == "K"
        close([(high - low).estimate, (high - low).u], [5, 0.05])
        assert (low + gu.constant(1, "K")).unit == "degC"
        close((low + gu.constant(1, "K")).estimate, 21)
        close([(1 / gu.kelvin(low)).estimate, (1 / gu.kelvin(low)).u], [1 / 293.15, 0.03 / 293.15**2])
        assert str(gu.celsius(gu.normal(300, 1, "K"))) == "26.9(1.0) degC"
        frequency = gu.normal(50, 0.1, "Hz")
        close((2 * np.pi * frequency).to("rad/s").estimate, 100 * math.pi)

    def test_mistakes_are_told_at_the_operation(self) -> None:
        v, ohm, number = gu.normal(1, 0.1, "V"), gu.normal(2, 0.1, "ohm"), gu.normal(1, 0.1)
        for make, told in [
            (lambda: v + ohm, "quantities in V and ohm cannot be added"),
            (lambda: v - 1, "`gumption.constant(1, \"V\")`"),
            (lambda: v < ohm, "cannot be compared"),
            (lambda: np.exp(v), "`exp` takes a plain number"),
            (lambda: v**number, "`x1` is the exponent of a quantity in V"),
            (lambda: v.to("A"), "a quantity in V is none in A"),
            (lambda: np.sin(np.deg2rad(gu.normal(30, 1, "deg"))), "angles in radians already"),
            (lambda: np.degrees(np.arctan(number)), "angles in radians already"),
            (lambda: gu.normal(300, 1, "K").to("degC"), "`gumption.celsius(T)`"),
            (lambda: gu.normal(20, 1, "deg") + 1, "`gumption.constant(1, \"deg\")` says which"),
        ]:
            with pytest.raises(gu.ModelError) as error:
                make()
            assert told in str(error.value)


class TestNumbers:
    def test_only_exact_ones_are_numbers(self) -> None:
        x = gu.normal(1, 0.1)
        assert float(gu.constant(3) * 2) == 6.0
        assert int(gu.constant(3) * 2) == 6
        assert round(gu.constant(3.26) * 1, 1) == 3.3
        for make in (lambda: float(x), lambda: int(x), lambda: complex(x), lambda: round(x, 2), lambda: bool(x)):
            with pytest.raises(TypeError, match="`.estimate` is its estimate"):
                make()
        with pytest.raises(TypeError, match="np.sin"):
            math.sin(x)
        with pytest.raises(TypeError, match="x.u:.3f"):
            f"{x:.3f}"

    def test_comparisons(self) -> None:
        x, y = gu.normal(1, 0.1), gu.normal(1.1, 0.1)
        assert x == x
        assert not x != x
        assert x + y == y + x
        assert 2 * x - x >= x
        assert gu.constant(1) < gu.constant(2)
        with pytest.raises(TypeError, match="probability"):
            bool(x < y)
        with pytest.raises(TypeError, match="neither true nor false"):
            sorted([x, y])
        # Phi(0.1/0.141); the standard error of a share of 1e6 trials is below 5e-4; five of them
        probability = (x < y).probability(1_000_000, seed=1)
        assert probability == pytest.approx(0.5 * (1 + math.erf(0.1 / math.sqrt(0.02) / math.sqrt(2))), abs=2.5e-3)

    def test_rare_and_combined_comparisons(self) -> None:
        x = gu.normal(0, 1)
        # the standard error of a share of 0.01 of 1e5 trials is 3e-4; five of them
        assert (x > 2.326348).probability(100_000, seed=1) == pytest.approx(0.01, abs=1.6e-3)
        assert (x < 9).probability(1000, seed=1) == 1
        within = (x > -1) & (x < 1)
        # 0.6827, with a standard error of 1.5e-3; five of them
        assert within.probability(100_000, seed=1) == pytest.approx(math.erf(math.sqrt(0.5)), abs=7.4e-3)
        assert (within | ~within).probability(1000, seed=1) == 1
        with pytest.raises(TypeError, match="probability"):
            bool(within)

    def test_keys(self) -> None:
        x, y = gu.normal(1, 0.1), gu.normal(1, 0.1)
        assert {x: "x", y: "y"}[y] == "y"

    def test_what_no_formula_says(self) -> None:
        x = gu.normal(1, 0.1)
        for make in (lambda: np.fft.fft(x), lambda: np.interp(x, [0, 2], [0, 4]), lambda: x * "a", lambda: x * math.nan):
            with pytest.raises(TypeError):
                make()
        with pytest.raises(AttributeError):
            x.nothing  # noqa: B018


class TestArrays:
    def test_correlations(self) -> None:
        matrix = np.array([[1, 0.5, -0.2], [0.5, 1, 0.1], [-0.2, 0.1, 1]])
        u = np.array([0.1, 0.2, 0.3])
        x = gu.array([1, 2, 3], u, "m", correlation=matrix)
        weights = np.array([1.0, -2.0, 0.5])
        covariance = matrix * np.outer(u, u)
        close((weights @ x).u, math.sqrt(weights @ covariance @ weights))
        close(x.covariance, covariance)
        close(x.correlation, matrix)
        assert x.unit == "m"
        assert x.sum().unit == "m"
        # the same of the covariance matrix, and through results
        y = gu.array([1, 2, 3], covariance=covariance, unit="m")
        close((weights @ y).u, (weights @ x).u)
        result = x.run(trials=0)
        close((result.y1 - 2 * result.y2 + 0.5 * result.y3).u, (weights @ x).u)
        close((result.y1 - x[0]).u, 0)

    def test_trials_have_the_correlation(self) -> None:
        x = gu.array([0, 0], 1.0, correlation=[[1, 0.8], [0.8, 1]])
        found = (x[0] - x[1]).run(trials=1_000_000, seed=2).y.monte_carlo.standard_uncertainty
        # sqrt(0.4); the relative standard error is 7e-4; five of them
        assert found == pytest.approx(math.sqrt(0.4), rel=3.5e-3)

    def test_declared_correlations(self) -> None:
        x, y = gu.normal(1, 0.1), gu.normal(2, 0.2)
        a, b = gu.correlated([x, y], [[1, 0.5], [0.5, 1]])
        known = math.sqrt(0.01 + 0.04 + 2 * 0.5 * 0.1 * 0.2)
        # what it returns are the same quantities, and either of them has the coefficient
        close([(a + b).u, (x + b).u, (a + y).u, (a - x).u, (x + y).u], [known, known, known, 0, math.sqrt(0.05)])
        close((y + x + b - y).u, known)
        _, other = gu.correlated([x, y], [[1, 0.9], [0.9, 1]])
        with pytest.raises(gu.ModelError, match="two correlation coefficients"):
            (a + other).u  # noqa: B018

    def test_comparisons_and_places(self) -> None:
        x = gu.array([1, 2, 3], 0.1, "m")
        limit = gu.constant(2.5, "m")
        assert [of.symbol for of in x > limit] == [">"] * 3
        close(np.where(x > limit, x, 0 * limit).estimate, [0, 0, 3])
        close(np.where([True, False, True], x, 2 * x).estimate, [1, 4, 3])
        x += limit
        close(x.estimate, [3.5, 4.5, 5.5])
        close(x.to("mm").u, [100, 100, 100])

    def test_shapes(self) -> None:
        a = gu.array(np.arange(6.0).reshape(2, 3), 0.1)
        assert a.estimate.shape == (2, 3)
        close(a.sum(axis=0).u, np.full(3, 0.1 * math.sqrt(2)))
        close((a.T @ np.ones(2)).estimate, [3, 5, 7])
        close(np.vstack([a, a]).u, np.full((4, 3), 0.1))
        assert isinstance(np.arange(3) * a[0, 0], gu.Quantities)
        assert isinstance(a.mean(), gu.Expression)
        close(gu.array(np.ones(200), 0.1).u, np.full(200, 0.1))
        assert gu.array([], 0.1).u.shape == (0,)
        close(gu.array([1, 2], [0, 0.1]).u, [0, 0.1])

    def test_linear_algebra(self) -> None:
        matrix, right = gu.array([[2, 1], [1, 3]], 0.01), gu.array([1, 2], 0.01)
        estimates = matrix.estimate
        inverse = np.linalg.inv(estimates)
        close(np.linalg.inv(matrix).estimate, inverse)
        # d(A^-1) = -A^-1 dA A^-1, with the same u of all entries
        close(np.linalg.inv(matrix).u, 0.01 * np.sqrt((inverse**2).sum(1)[:, None] * (inverse**2).sum(0)[None]))
        close((np.linalg.inv(matrix) @ right - np.linalg.solve(matrix, right)).u, [0, 0])
        close(np.linalg.det(matrix).u, 0.01 * math.sqrt(9 + 4 + 1 + 1))
        with pytest.raises(np.linalg.LinAlgError, match="singular"):
            np.linalg.inv(gu.array([[1, 2], [2, 4]], 0.1))

    def test_mistakes(self) -> None:
        x = gu.normal(1, 0.1)
        for make, told in [
            (lambda: gu.array([1, 2]), "`u` or `covariance`"),
            (lambda: gu.array([1, 2], [1, 2, 3]), "`u`"),
            (lambda: gu.array([1, 2], 0.1, correlation=[[1]]), "`correlation`"),
            (lambda: gu.array([1, 2], 0.1, correlation=[[1, 2], [2, 1]]), "outside -1 to 1"),
            (lambda: gu.array([1, 2], 0.1, correlation=[[1, 0.1], [0.2, 1]]), "symmetric"),
            (lambda: gu.array([1, 2], 0.1, covariance=np.eye(2)), "in place of"),
            (lambda: gu.array([x, x], 0.1), "give them alone"),
            (lambda: gu.array([1, 2], 0.1, names=["a"]), "`names`"),
            (lambda: gu.correlated([x, 2 * x], np.eye(2)), "an input is needed"),
            (lambda: gu.correlated([x, x], np.eye(2)), "one quantity is given twice"),
            (lambda: gu.array([1 + 1j, 2], 0.1), "gumption.complex_normal"),
            (lambda: gu.array([1, math.nan], 0.1), "is nan"),
        ]:
            with pytest.raises((TypeError, ValueError)) as error:
                make()
            assert told in str(error.value)


class TestComplex:
    def test_parts(self) -> None:
        z = gu.complex_normal(3 + 4j, (0.1, 0.2), "V", correlation=0.5)
        assert z.estimate == 3 + 4j
        close(z.u, (0.1, 0.2))
        close(z.covariance, [[0.01, 0.01], [0.01, 0.04]])
        close(abs(z).estimate, 5)
        close(abs(z).u, math.sqrt(0.6**2 * 0.01 + 2 * 0.6 * 0.8 * 0.01 + 0.8**2 * 0.04))
        close(np.angle(z).u, math.sqrt(0.16**2 * 0.01 - 2 * 0.16 * 0.12 * 0.01 + 0.12**2 * 0.04))
        assert abs(z).unit == "V"
        assert np.angle(z).unit == "rad"
        close((z * np.conj(z) - abs(z) ** 2).u, (0, 0))
        close([z.real.estimate, z.imag.u], [3, 0.2])
        # what is exact has no covariance
        close((gu.normal(1, 0.1) + 1j).covariance, [[0.01, 0], [0, 0]])

    def test_forms(self) -> None:
        x, y = gu.normal(1, 0.1), gu.normal(2, 0.2)
        close((x + 1j * y).u, (0.1, 0.2))
        modulus, phase = gu.normal(2, 0.01), gu.normal(60, 0.5, "deg")
        z = modulus * np.exp(1j * phase)
        assert z.estimate == pytest.approx(1 + math.sqrt(3) * 1j, rel=ROUNDING)
        close(abs(z).u, 0.01)
        close(np.angle(z).to("deg").u, 0.5)
        assert str(gu.complex_normal(1, 0.1) * 1j) == "(0.00(10)+1.00(10)j)"

    def test_results(self) -> None:
        z = gu.complex_normal(3 + 4j, 0.1)
        result = (z * z).run(trials=1000, seed=1)
        assert list(result) == ["y.re", "y.im"]
        close(result["y.re"].u, math.hypot(6 * 0.1, 8 * 0.1))
        with pytest.raises(TypeError, match="`U` is of a real quantity"):
            (z * z).U  # noqa: B018


class TestResults:
    def test_outputs_are_attributes(self) -> None:
        result = gu.model_of({"a": gu.normal(1, 0.1), "rows": gu.normal(2, 0.1)}).run(trials=0)
        assert result.a.estimate == 1
        assert result.rows == 1
        assert result["rows"].estimate == 2
        assert "a" in dir(result)
        with pytest.raises(AttributeError, match="no output 'b'"):
            result.b  # noqa: B018
        assert not hasattr(result, "shape")

    def test_conditions_have_no_arithmetic(self) -> None:
        @gu.model(inputs={"a": "1"}, conditions={"f": "Hz"}, outputs={"y": "Hz"})
        def product(a: Any, f: Any) -> Any:
            return a * f

        result = product(a=(1, 0.1), conditions={"f": [1.0, 2.0]}).run(trials=0)
        close(result.y.estimate, [1, 2])
        with pytest.raises(gu.ModelError):
            (2 * result.y).u  # noqa: B018
