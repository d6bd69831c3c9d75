"""Columns of pandas, polars, pyarrow and xarray, and readings in long form: in, and out with their labels."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np
import pytest

import gumption as gu
from gumption._frames import udunits

#: The same operations in another order: some roundings apart.
ROUNDING = 1e-12


@gu.model(inputs={"mass": "g", "diameter": "mm", "height": "mm"}, outputs={"density": "kg/m^3"})
def cylinder(mass: Any, diameter: Any, height: Any) -> Any:
    return 4 * mass / (np.pi * diameter**2 * height)


MASSES = np.array([21.32, 20.5, 22.1, 19.8])
WIDTHS = np.array([0.01, 0.02, 0.03, 0.04])


def density(mass: Any, diameter: Any, height: Any) -> Any:
    """The density in kg/m^3 of a mass in g and lengths in mm."""
    return 4e6 * mass / (math.pi * diameter**2 * height)


def combined(estimate: Any, *relative: Any) -> Any:
    """u of a product of powers of independent factors (JCGM 100, 5.1.6)."""
    return estimate * np.sqrt(sum(np.asarray(part) ** 2 for part in relative))


def columns_of(library: str) -> Callable[[Any], Any]:
    """What makes a column of a library."""
    if library == "pyarrow.chunked":
        arrow = pytest.importorskip("pyarrow")
        return lambda values: arrow.chunked_array([values[:1], values[1:]])
    name = {"pandas": "Series", "polars": "Series", "pyarrow": "array"}[library]
    column: Callable[[Any], Any] = getattr(pytest.importorskip(library), name)
    return column


@pytest.mark.parametrize("library", ["pandas", "polars", "pyarrow", "pyarrow.chunked"])
def test_columns_are_arrays(library: str) -> None:
    column = columns_of(library)
    found = gu.budgets(cylinder, mass=(column(MASSES), column(WIDTHS)), diameter=(12.0, 0.005), height=24.0)
    expected = density(MASSES, 12.0, 24.0)
    assert np.allclose(found.estimate, expected, rtol=ROUNDING)
    u = combined(expected, WIDTHS / MASSES, 2 * 0.005 / 12)
    assert np.allclose(found.standard_uncertainty, u, rtol=ROUNDING)
    with_conditions = gu.model(inputs={"a": "m"}, outputs={"y": "m/s"}, conditions={"f": "Hz"})(
        lambda a, f: a * f
    )
    result = with_conditions(a=(2.0, 0.1), conditions={"f": column(MASSES)}).run(trials=0)
    assert np.allclose(result["y"].gum.estimate, 2 * MASSES, rtol=ROUNDING)


@pytest.mark.parametrize("library", ["pandas", "polars", "pyarrow"])
def test_what_is_missing_is_missing(library: str) -> None:
    column = columns_of(library)([1.0, None, 3.0])
    found = gu.budgets(cylinder, mass=(column, 0.1), diameter=12.0, height=24.0, trials=1000)
    assert np.isnan(found.estimate).tolist() == [False, True, False]
    assert np.isnan(found.monte_carlo.standard_uncertainty).tolist() == [False, True, False]


class TestXarray:
    def test_arrays_are_broadcast_by_their_dimensions(self) -> None:
        xarray = pytest.importorskip("xarray")
        masses = xarray.DataArray(
            MASSES / 1000, dims="piece", coords={"piece": list("abcd"), "bench": 7}, attrs={"units": "kg"}
        )
        masses.piece.attrs["long_name"] = "test piece"
        diameters = xarray.DataArray([1.2, 1.3], dims="day", coords={"day": [3, 5]}, attrs={"unit": "cm"})
        u = xarray.DataArray([5.0, 8.0], dims="day", coords={"day": [3, 5]}, attrs={"units": "um"})
        u_mass = xarray.DataArray(0.01, attrs={"units": "g"})
        found = gu.budgets(
            cylinder, mass=(masses, u_mass), diameter=(diameters, u), height=(24.0, 0.012)
        ).to_xarray()
        with pytest.raises(gu.ModelError, match="`mass`: .* can be in kg or in g"):
            gu.budgets(cylinder, mass=(masses, 0.01), diameter=12.0, height=24.0)
        assert found.estimate.dims == ("piece", "day")
        assert found.piece.values.tolist() == list("abcd") and found.day.values.tolist() == [3, 5]
        assert found.piece.attrs == {"long_name": "test piece"} and found.bench.item() == 7
        assert found.estimate.attrs["units"] == found["u(mass)"].attrs["units"] == "kg/m^3"
        assert "units" not in found.dof.attrs
        expected = density(MASSES[:, None], np.array([12.0, 13.0]), 24.0)
        assert np.allclose(found.estimate, expected, rtol=ROUNDING)
        relative = 0.01 / MASSES[:, None], 2 * np.array([5e-3, 8e-3]) / [12, 13], 0.012 / 24
        assert np.allclose(found.standard_uncertainty, combined(expected, *relative), rtol=ROUNDING)

    def test_other_tables_of_the_same(self) -> None:
        xarray = pytest.importorskip("xarray")
        masses = xarray.DataArray(MASSES[:2], dims="piece", coords={"piece": list("ab")})
        diameters = xarray.DataArray([12.0, 13.0], dims="day", coords={"day": [3, 5]})
        found = gu.budgets(cylinder, mass=masses, diameter=(diameters, 0.1), height=24.0)
        frame = found.to_pandas()
        assert frame.index.names == ["piece", "day"]
        assert frame.loc[("b", 3), "estimate"] == found.estimate[2]
        polars = pytest.importorskip("polars")
        assert found.to_polars().select("piece", "day").rows() == [("a", 3), ("a", 5), ("b", 3), ("b", 5)]
        assert found.to_polars()["estimate"].to_list() == found.estimate.tolist()
        assert isinstance(found.to_polars(), polars.DataFrame)

    def test_conditions(self) -> None:
        xarray = pytest.importorskip("xarray")
        weather = xarray.Dataset(
            {"p": (("station", "time"), [[1000.0, 1010.0, 990.0], [980.0, 985.0, 1001.0]], {"units": "hPa"})},
            {"station": ["north", "south"], "time": [10, 11, 12]},
            {"source": "archive"},
        )
        weather["T"] = ("time", [290.0, 291.0, 292.0], {"units": "K", "long_name": "air temperature"})

        @gu.model(inputs={"R": "J/(kg*K)"}, outputs={"rho": "kg/m^3"}, conditions={"p": "Pa", "T": "K"})
        def gas(R: Any, p: Any, T: Any) -> Any:
            return p / (R * T)

        result = gas(R=(287.05, 0.5), conditions=weather).run(trials=0)
        found = pickle.loads(pickle.dumps(result)).to_xarray()
        assert found.gum_estimate.dims == ("station", "time", "output")
        assert found.station.values.tolist() == ["north", "south"] and found.attrs == {"source": "archive"}
        expected = 100 * weather.p / (287.05 * weather["T"])
        assert np.allclose(found.gum_estimate.sel(output="rho"), expected, rtol=ROUNDING)
        assert np.allclose(
            found.gum_standard_uncertainty.sel(output="rho"), expected * 0.5 / 287.05, rtol=ROUNDING
        )
        assert found.gum_estimate.attrs == {"units": "kg/m^3"} and found.unit.item() == "kg/m^3"
        assert np.array_equal(found.p, weather.p) and found.p.attrs == {"units": "hPa"}
        assert found["T"].attrs["long_name"] == "air temperature"
        frame = result.to_pandas()
        assert frame.index.names == ["station", "time", "output"]
        assert math.isclose(frame.loc[("south", 11, "rho"), "gum_estimate"], expected[1, 1], rel_tol=ROUNDING)

    def test_without_conditions(self) -> None:
        pytest.importorskip("xarray")
        result = cylinder(21.0, (12.0, 0.1), 24.0).run(trials=0)
        found = result.to_xarray()
        assert found.gum_estimate.dims == ("output",)
        assert found.gum_estimate.sel(output="density").item() == result["density"].gum.estimate

    def test_mistakes(self) -> None:
        xarray = pytest.importorskip("xarray")
        pandas = pytest.importorskip("pandas")
        masses = xarray.DataArray(MASSES, dims="piece", coords={"piece": list("abcd")})
        others = masses.assign_coords(piece=list("abce"))
        days = xarray.DataArray([12.0, 13.0], dims="day")
        for mass, diameter, height, said in [
            ((masses, 0.1), others, 1.0, "`diameter` has other coordinates"),
            (masses, days, MASSES, "`height` is an array without names of dimensions"),
            (masses, pandas.Series(MASSES), 1.0, "`diameter` has an index of pandas"),
            (masses.assign_attrs(units="mm"), 1.0, 1.0, "the estimate of `mass` is in mm.* takes g"),
            (
                (masses, masses.assign_attrs(units="s")),
                1.0,
                1.0,
                "the standard uncertainty of `mass` is in s",
            ),
            (masses.assign_attrs(units="furlong"), 1.0, 1.0, "furlong"),
            (
                masses.assign_attrs(units="g", unit="kg"),
                1.0,
                1.0,
                r"attrs\[\"units\"\] and attrs\[\"unit\"\]",
            ),
            (masses.astype(str), 1.0, 1.0, "`mass` has values of the type <U"),
        ]:
            with pytest.raises(gu.ModelError, match=said):
                gu.budgets(cylinder, mass=mass, diameter=diameter, height=height)


class TestUnits:
    @pytest.mark.parametrize(
        ("text", "here"),
        [
            ("kg m-3", "kg*m^-3"),
            ("m.s-1", "m*s^-1"),
            ("m2", "m^2"),
            ("W m**-2", "W*m^-2"),
            ("degrees_celsius", "degC"),
            ("percent", "%"),
            ("1", "1"),
            ("m/s^2", "m/s^2"),
            ("hPa", "hPa"),
        ],
    )
    def test_of_the_climate_and_forecast_conventions(self, text: str, here: str) -> None:
        assert udunits(text) == here

    def test_with_another_zero(self) -> None:
        """Uncertainties have no zero: 293.15 K is 20 degC, and u = 1.8 degF is u = 1 degC."""
        pandas = pytest.importorskip("pandas")
        same = gu.model(inputs={"T": "degC"}, outputs={"y": "degC"})(lambda T: T)
        kelvin, fahrenheit = pandas.Series([293.15, 273.15]), pandas.Series([1.8, 3.6])
        kelvin.attrs["units"], fahrenheit.attrs["unit"] = "K", "degF"
        found = gu.budgets(same, T=(kelvin, fahrenheit))
        # 273.15 K is exact; 293.15 has a rounding of 3e-14 K
        assert np.allclose(found.estimate, [20.0, 0.0], atol=1e-12)
        assert np.allclose(found.standard_uncertainty, [1.0, 2.0], rtol=ROUNDING)

    def test_of_a_frame_by_column(self) -> None:
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame({"m": MASSES / 1000, "u": WIDTHS})
        frame.attrs["units"] = {"m": "kg", "u": "g"}
        found = gu.budgets(cylinder, mass=(frame["m"], frame["u"]), diameter=12.0, height=24.0)
        assert np.allclose(found.contributions["mass"], density(WIDTHS, 12.0, 24.0), rtol=ROUNDING)

    def test_of_pint(self) -> None:
        registry = pytest.importorskip("pint").UnitRegistry()
        mass = registry.Quantity(MASSES / 1000, "kg"), registry.Quantity(WIDTHS * 1000, "mg")
        found = gu.budgets(cylinder, mass=mass, diameter=12.0, height=24.0)
        assert np.allclose(found.estimate, density(MASSES, 12.0, 24.0), rtol=ROUNDING)
        assert np.allclose(found.standard_uncertainty, density(WIDTHS, 12.0, 24.0), rtol=ROUNDING)


class TestLabels:
    def test_an_index_of_several_levels(self) -> None:
        pandas = pytest.importorskip("pandas")
        index = pandas.MultiIndex.from_tuples([("x", 1), ("x", 3), ("y", 2), ("z", 9)], names=["lab", "run"])
        found = gu.budgets(cylinder, mass=pandas.Series(MASSES, index), diameter=(12.0, 0.1), height=24.0)
        assert found.to_pandas().index.equals(index)
        assert found.to_pandas()["estimate"].tolist() == found.estimate.tolist()
        polars = pytest.importorskip("polars")
        table = found.to_polars()
        assert table["lab"].to_list() == ["x", "x", "y", "z"] and table["run"].dtype == polars.Int64
        xarray = pytest.importorskip("xarray")
        data = found.to_xarray()
        assert isinstance(data, xarray.Dataset)
        assert data.estimate.sel(lab="y", run=2).item() == found.estimate[2]

    def test_arrow(self) -> None:
        pytest.importorskip("pyarrow")
        found = gu.budgets(cylinder, mass=MASSES, diameter=(12.0, 0.1), height=24.0)
        table = found.to_arrow()
        assert table.column_names[:2] == ["estimate", "standard_uncertainty"]
        assert table["u(diameter)"].to_pylist() == found.contributions["diameter"].tolist()

    def test_the_rows_of_conditions(self) -> None:
        """Results stand in their own rows after a join, also of a model that was changed and pickled."""
        pandas = pytest.importorskip("pandas")
        product = gu.model(inputs={"a": "m"}, outputs={"y": "m/s"}, conditions={"f": "Hz"})(
            lambda a, f: a * f
        )
        frame = pandas.DataFrame({"f": [3.0, 1.0, 2.0]}, index=pandas.Index(list("xyz"), name="point"))
        model = pickle.loads(pickle.dumps(product(a=(2.0, 0.1), conditions=frame.sort_values("f")).set(a=4)))
        table = model.run(trials=0).to_pandas()
        assert table.index.names == ["point", "output"]
        joined = frame.join(table.xs("y", level="output")["gum_estimate"])
        assert np.allclose(joined["gum_estimate"], 4 * joined["f"], rtol=ROUNDING)
        polars = pytest.importorskip("polars")
        found = model.run(trials=0).to_polars()
        assert isinstance(found, polars.DataFrame)
        assert found["point"].to_list() == ["y", "z", "x"] and found["f"].to_list() == [1, 2, 3]
        with pytest.raises(gu.ModelError, match="called `f`"):
            product(a=1.0, conditions=frame.rename_axis("f")).run(trials=0).to_polars()


class TestTrials:
    def test_rows_are_single_runs(self) -> None:
        """The trials of each row have the bits of a run of that row alone."""
        dof = np.array([4.0, 9.0, np.inf, 50.0])
        found = gu.budgets(
            cylinder, mass=(MASSES, WIDTHS, dof), diameter=(12.0, 0.005, 9), height=(24.0, 0.012),
            trials=2000, seed=5, coverage=0.99,
        )  # fmt: skip
        drawn = found.monte_carlo
        for row in range(len(MASSES)):
            of_row = cylinder((MASSES[row], WIDTHS[row], dof[row]), (12.0, 0.005, 9), (24.0, 0.012))
            alone = of_row.run(trials=2000, seed=5, coverage=0.99)["density"]
            figures = alone.monte_carlo
            assert drawn.estimate[row] == figures.estimate
            assert drawn.standard_uncertainty[row] == figures.standard_uncertainty
            assert drawn.shortest_interval[row].tolist() == figures.shortest_interval.tolist()
            assert drawn.symmetric_interval[row].tolist() == figures.symmetric_interval.tolist()
            assert math.isclose(found.expanded_uncertainty[row], alone.gum.expanded_uncertainty, rel_tol=1e-9)
        pandas = pytest.importorskip("pandas")
        frame = found.to_pandas()
        assert isinstance(frame, pandas.DataFrame)
        assert frame["mc_shortest_high"].tolist() == drawn.shortest_interval[:, 1].tolist()

    def test_of_a_sum(self) -> None:
        """Normal terms have a normal sum, u = 5 u_0; the standard deviation of 20,000 trials is uncertain by
        0.5 % (JCGM 100, E.4.3), of which 4 times are allowed."""
        total = gu.model(inputs={"a": "m", "b": "m"}, outputs={"y": "m"})(lambda a, b: a + b)
        u = np.array([1.0, 10.0])
        drawn = gu.budgets(total, a=(1.0, 3 * u), b=(2.0, 4 * u), trials=20_000).monte_carlo
        assert np.allclose(drawn.standard_uncertainty, 5 * u, rtol=0.02)
        half = np.diff(drawn.symmetric_interval, axis=1)[:, 0] / 2
        # k = 2 of the default coverage; its trials scatter by less than 1.5 %
        assert np.allclose(half, 10 * u, rtol=0.06)

    def test_other_inputs_keep_their_distributions(self) -> None:
        model = cylinder(mass=1.0, diameter=gu.rectangular(12.0, 0.1), height=24.0)
        found = gu.budgets(model, mass=MASSES, trials=1000, seed=2)
        alone = model.with_inputs(mass=MASSES[3]).run(trials=1000, seed=2)["density"].monte_carlo
        assert found.monte_carlo.estimate[3] == alone.estimate

    @pytest.mark.slow
    def test_processes_give_the_same(self) -> None:
        given: dict[str, Any] = {"mass": (MASSES, WIDTHS), "diameter": (12.0, 0.005, 9), "height": 24.0}
        here = gu.budgets(cylinder, **given, trials=20_000, seed=5).monte_carlo
        with ProcessPoolExecutor(2) as pool:
            there = gu.budgets(cylinder, **given, trials=20_000, seed=5, executor=pool).monte_carlo
        assert np.array_equal(here.shortest_interval, there.shortest_interval)
        assert np.array_equal(here.standard_uncertainty, there.standard_uncertainty)

    def test_mistakes(self) -> None:
        with pytest.raises(gu.ModelError, match="are about trials"):
            gu.budgets(cylinder, mass=MASSES, diameter=1.0, height=1.0, seed=1)
        with pytest.raises(gu.ModelError, match=r"`mass`: in row 1 \(from 0\) the dof is 0.1"):
            gu.budgets(cylinder, mass=(MASSES[:2], 0.1, [5, 0.1]), diameter=1.0, height=1.0, trials=100)

    def test_an_input_that_is_called_as_an_option(self) -> None:
        spring = gu.model(inputs={"k": "N/m", "x": "m"}, outputs={"F": "N"})(lambda k, x: k * x)
        assert gu.budgets(spring, {"k": (MASSES, 0.1)}, x=2.0).estimate.tolist() == (2 * MASSES).tolist()
        assert gu.budgets(spring, {"k": (MASSES, 0.1)}, x=2.0, k=3.0).coverage_factor.tolist() == [3.0] * 4
        with pytest.raises(TypeError, match="`k` is an option, and an input of the model"):
            gu.budgets(spring, k=3.0, x=2.0)
        with pytest.raises(TypeError, match="`x` is given twice"):
            gu.budgets(spring, {"k": 1.0, "x": 1.0}, x=2.0)


LONG_FORM: dict[str, list[Any]] = {
    "device": ["B", "A", "B", "A", "B", "A"],
    "reading": [21.4, 20.1, 21.2, 20.3, 21.9, None],
}


class TestGroupedReadings:
    #: Readings of each device: 20.1 and 20.3, and 21.4, 21.2 and 21.9.
    of_device = {"A": np.array([20.1, 20.3]), "B": np.array([21.4, 21.2, 21.9])}

    def check(self, found: Any, order: str) -> None:
        for row, device in enumerate(order):
            values = self.of_device[device]
            alone = (
                cylinder(gu.readings(values), {"A": 12.0, "B": 13.0}[device], 24.0)
                .run(trials=0)["density"]
                .gum
            )
            assert math.isclose(
                found.estimate[row], density(values.mean(), {"A": 12, "B": 13}[device], 24), rel_tol=ROUNDING
            )
            assert math.isclose(found.standard_uncertainty[row], alone.standard_uncertainty, rel_tol=ROUNDING)
            assert found.dof[row] == pytest.approx(len(values) - 1) == pytest.approx(alone.dof)
            assert math.isclose(found.expanded_uncertainty[row], alone.expanded_uncertainty, rel_tol=ROUNDING)

    def test_of_pandas(self) -> None:
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame(LONG_FORM)
        diameters = pandas.Series({"C": 1.0, "B": 13.0, "A": 12.0})
        found = gu.budgets(cylinder, mass=frame.groupby("device")["reading"], diameter=diameters, height=24.0)
        self.check(found, "AB")
        assert found.to_pandas().index.tolist() == ["A", "B"] and found.to_pandas().index.name == "device"
        again = gu.readings_by(frame, "device", "reading")
        self.check(gu.budgets(cylinder, mass=again, diameter=diameters, height=24.0), "AB")

    @pytest.mark.parametrize("library", ["polars", "pyarrow", None])
    def test_of_other_tables(self, library: str | None) -> None:
        table: Any = LONG_FORM
        if library is not None:
            module = pytest.importorskip(library)
            table = module.DataFrame(table) if library == "polars" else module.table(table)
        else:
            table = {**LONG_FORM, "reading": np.array(LONG_FORM["reading"], dtype=float)}
        readings = gu.readings_by(table, by="device", values="reading")
        assert len(readings) == 2 and readings.keys == ["B", "A"]
        found = gu.budgets(cylinder, mass=readings, diameter={"A": 12.0, "B": 13.0}, height=24.0)
        self.check(found, "BA")
        polars = pytest.importorskip("polars")
        assert isinstance(found.to_polars(), polars.DataFrame)
        assert found.to_polars()["device"].to_list() == ["B", "A"]

    def test_two_inputs_and_several_keys(self) -> None:
        table = {
            "lab": ["x", "x", "y", "y", "x", "x"], "day": [1, 1, 1, 1, 2, 2],
            "m": [1.0, 2.0, 3.0, 5.0, 7.0, 9.0], "d": [12.0, 12.2, 13.0, 13.2, 14.0, 14.2],
        }  # fmt: skip
        mass, diameter = (gu.readings_by(table, ["lab", "day"], name) for name in "md")
        # the same groups in another order
        turned = gu.readings_by(
            {name: column[::-1] for name, column in table.items()}, ["lab", "day"], "d", "mm"
        )
        assert turned.keys == [("x", 2), ("y", 1), ("x", 1)]
        one = gu.budgets(cylinder, mass=mass, diameter=diameter, height=24.0)
        two = gu.budgets(cylinder, mass=mass, diameter=turned, height=24.0)
        assert np.allclose(
            one.estimate,
            density(np.array([1.5, 4.0, 8.0]), np.array([12.1, 13.1, 14.1]), 24.0),
            rtol=ROUNDING,
        )
        assert np.allclose(one.standard_uncertainty, two.standard_uncertainty, rtol=ROUNDING)
        pandas = pytest.importorskip("pandas")
        index = pandas.MultiIndex.from_tuples([("x", 1), ("y", 1), ("x", 2)], names=["lab", "day"])
        assert one.to_pandas().index.equals(index)

    def test_mistakes(self) -> None:
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame(LONG_FORM)
        grouped = frame.groupby("device")["reading"]
        for mass, diameter, said in [
            (
                frame.iloc[:2].groupby("device")["reading"],
                1.0,
                "`mass`: the group 'A' of device has one reading",
            ),
            (grouped, pandas.Series({"A": 12.0}), "`diameter` has no label 'B'"),
            (grouped, pandas.Series([1.0, 2.0, 3.0], list("ABA")), "`diameter` has the label 'A' twice"),
            (grouped, np.array([1.0, 2.0]), "`diameter` has no labels"),
            (
                grouped,
                frame[:3].assign(device=["A", "A", "B"]).groupby("device")["reading"],
                "`diameter`: the group",
            ),
            (
                grouped,
                frame[frame["device"] == "B"].groupby("device")["reading"],
                "of the group 'A', and `diameter`",
            ),
        ]:
            with pytest.raises(gu.ModelError, match=said):
                gu.budgets(cylinder, mass=mass, diameter=diameter, height=24.0)
        with pytest.raises(TypeError, match="name the column"):
            gu.budgets(cylinder, mass=frame.groupby("device"), diameter=1.0, height=24.0)
        with pytest.raises(TypeError, match="without a pair"):
            gu.budgets(
                cylinder, mass=(gu.readings_by(frame, "device", "reading"), 1.0), diameter=1.0, height=24.0
            )
        with pytest.raises(gu.ModelError, match="no column `box`; it has device, reading"):
            gu.readings_by(LONG_FORM, "box", "reading")


def test_columns_where_one_quantity_is_meant() -> None:
    pandas = pytest.importorskip("pandas")
    for value in (pandas.Series(MASSES), MASSES, [1.0, 2.0], (MASSES, 0.1), (1.0, WIDTHS)):
        with pytest.raises(
            TypeError, match=r"mass: .*call gumption.budgets\(model, mass=...\).*gumption.readings"
        ):
            cylinder(value, 12.0, 24.0)
