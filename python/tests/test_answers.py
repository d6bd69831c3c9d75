"""What results and other answers give: columns, frames, samples, pages, figures, errors."""

from __future__ import annotations

import json
import math
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import MODELS, ROOT, run

import gumption as gu


@pytest.fixture(scope="module")
def plane() -> gu.Result:
    return gu.load(MODELS / "inclined_plane.json").run(trials=50_000)


@pytest.fixture(scope="module")
def campaign() -> gu.Result:
    return gu.load(MODELS / "inclined_plane_campaign.json").run(trials=5000)


def test_figures_are_those_of_the_answer(plane: gu.Result, campaign: gu.Result) -> None:
    answers = [plane.to_dict()], campaign.to_dict()["rows"]
    for result, rows in zip((plane, campaign), answers):
        for name, output in result.items():
            told = [row["outputs"][name] for row in rows]

            def column(side: str, key: str) -> Any:
                values = [np.nan if of[side][key] is None else of[side][key] for of in told]
                return np.array(values, dtype=float)

            for side in ("gum", "monte_carlo"):
                figures = getattr(output, side)
                for key in told[0][side]:
                    if hasattr(figures, key) and key != "dof":
                        own = np.reshape(getattr(figures, key), column(side, key).shape)
                        assert np.array_equal(own, column(side, key), equal_nan=True), (name, key)
            assert np.all(np.isinf(output.gum.dof))


def test_budget(plane: gu.Result) -> None:
    told = plane.to_dict()["outputs"]["a_x"]["gum"]["budget"]
    budget = plane["a_x"].budget
    for key in ("input", "estimate", "sensitivity", "contribution", "share", "distribution", "type"):
        assert list(budget[key]) == [line[key] for line in told], key
    assert "sensitivity" in repr(budget)
    assert budget.to_pandas().loc["tilt", "unit"] == "deg"


def test_correlations(plane: gu.Result) -> None:
    told = {(a, b): r for a, b, r in plane.to_dict()["output_correlations"]}
    matrix = plane.correlations()
    assert np.array_equal(matrix, matrix.T) and np.all(np.diag(matrix) == 1)
    names = list(plane)
    for (a, b), r in told.items():
        assert matrix[names.index(a), names.index(b)] == r


class TestSamples:
    def test_without_trials(self) -> None:
        result = gu.load(MODELS / "inclined_plane.json").run(trials=0)
        with pytest.raises(gu.ModelError, match="no trials"):
            result.samples("a_x")
        with pytest.raises(gu.ModelError, match="needs Monte Carlo trials"):
            result.saved()
        assert math.isnan(result["a_x"].monte_carlo.estimate)
        pytest.importorskip("matplotlib")
        assert len(result.plot("a_x").axes) == 1

    def test_moments(self, plane: gu.Result) -> None:
        values = plane.samples("a_x")
        assert isinstance(values, np.ndarray) and values.shape == (50_000,)
        trials = plane["a_x"].monte_carlo
        # sums in another order round differently
        assert math.isclose(values.mean(), trials.estimate, rel_tol=1e-13)
        assert math.isclose(values.std(ddof=1), trials.standard_uncertainty, rel_tol=1e-10)
        assert trials.symmetric_interval[0] in values

    def test_rows_of_a_sweep(self, campaign: gu.Result) -> None:
        values = campaign.samples("a_x", row=5)
        assert math.isclose(values.mean(), campaign["a_x"].monte_carlo.estimate[5], rel_tol=1e-12)
        with pytest.raises(IndexError):
            campaign.samples("a_x", row=12)

    def test_arrow_without_a_copy(self, plane: gu.Result) -> None:
        arrow = pytest.importorskip("pyarrow")
        values = plane.samples("a_x")
        schema, array = values.__arrow_c_array__()
        taken = arrow.Array._import_from_c_capsule(schema, array)
        assert taken.type == arrow.float64() and len(taken) == len(values)
        assert taken.buffers()[1].address == values.ctypes.data
        first = float(values[0])
        del values, schema, array
        assert taken[0].as_py() == first

    def test_tables(self, plane: gu.Result) -> None:
        table = plane.samples()
        assert table.to_numpy().shape == (50_000, 3)
        assert list(table.to_pandas().columns) == list(plane)
        arrow = pytest.importorskip("pyarrow")
        found = arrow.table(table)
        assert found.column_names == list(plane) and found.num_rows == 50_000
        assert np.array_equal(found["a_x"].to_numpy(), table["a_x"])
        polars = pytest.importorskip("polars")
        frame = polars.DataFrame(table)
        assert frame.columns == list(plane)
        assert np.array_equal(frame["a_z"].to_numpy(), table["a_z"])
        assert len(polars.Series(table["a_x"])) == 50_000

    def test_capsules_that_nobody_takes(self, plane: gu.Result) -> None:
        for _ in range(100):
            plane.samples("a_x").__arrow_c_array__()
            plane.samples().__arrow_c_stream__()


def test_pages(plane: gu.Result, tmp_path: Path) -> None:
    assert "Monte Carlo" in str(plane)
    for name in ("a.html", "a.xlsx", "a.md", "a.tex", "a.txt", "a.json", "a.csv", "a.npy"):
        plane.write(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 500
    assert np.load(tmp_path / "a.npy").shape == (50_000, 3)
    with pytest.raises(gu.ModelError, match="extension"):
        plane.write(tmp_path / "a.doc")


def test_plot(plane: gu.Result, campaign: gu.Result, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    for figure, panels in (
        (plane.plot(), 3),
        (plane.plot("a_x"), 1),
        (campaign.plot(), 3),
        (campaign.plot("a_z", row=2), 1),
    ):
        assert len(figure.axes) == panels
        figure.savefig(tmp_path / "a.png")
    assert "a_x in m/s^2" in plane.plot("a_x").axes[0].get_xlabel()


def test_to_pandas(plane: gu.Result) -> None:
    pytest.importorskip("pandas")
    frame = plane.to_pandas()
    assert frame.loc["a_x", "gum_estimate"] == plane["a_x"].gum.estimate
    assert frame.loc["a_x", "unit"] == "m/s^2"


def names_keywords(error: gu.ModelError, options: dict[str, Any]) -> None:
    """Whether a message names an option as an argument of Python, and not as one of the command line."""
    text = str(error)
    assert any(re.search(rf"`{name}[`=]", text) for name in options), text
    assert "--" not in text and "Usage" not in text and not text.startswith(("error", "gumption")), text


@gu.model(inputs={"mass": "g", "side": "mm"}, outputs={"rho": "kg/m^3"})
def cube(mass: Any, side: Any) -> Any:
    return mass / side**3


#: An argument of `cube` that is wrong, what the message says of it, and its path.
WRONG_ARGUMENTS = {
    "negative": ({"mass": gu.normal(1, -0.1)}, "argument `mass`: `std` is -0.1", "mass.std"),
    "incomplete": ({"mass": gu.normal(1)}, "argument `mass`: an input needs the key `std`", "mass"),
    "formula": ({"mass": gu.normal("x", 0.1)}, "argument `mass`, `mean`: `x` is not defined", "mass.mean"),
    "mapping": (
        {"side": {"distribution": "normal", "mean": 1, "sdt": 0.1}},
        "argument `side`: unknown key `sdt`.*`std`",
        "side.sdt",
    ),
    "component": (
        {"mass": gu.components(1, {"a": gu.normal(0, 0.1), "b": gu.normal(0, -0.1)})},
        "argument `mass`, `components.b.std`: `std` is -0.1",
        "mass.components.b.std",
    ),
    "trials": ({"trials": -1}, "argument `trials`: -1 is not", "trials"),
    "coverage": ({"coverage_probability": 2}, "argument `coverage_probability`: ", "coverage_probability"),
    "correlations": (
        {"correlations": [("mass", "side", 0.1), ("mass", "height", 0.5)]},
        r"argument `correlations\[1\]\[1\]`: there is no input `height`",
        "correlations[1][1]",
    ),
    "tolerance": (
        {"tolerance": {"rho": {"lower": 3, "upper": 1}}},
        "argument `tolerance`, `rho`: .* 3 is not below the upper limit 1",
        "tolerance.rho",
    ),
}


class TestArguments:
    """Errors of models that Python makes name what was given to Python."""

    @pytest.mark.parametrize("name", WRONG_ARGUMENTS)
    def test_of_functions(self, name: str) -> None:
        wrong, said, path = WRONG_ARGUMENTS[name]
        with pytest.raises(gu.ModelError, match=rf"^`cube`: {said}") as raised:
            cube(**{"mass": (1, 0.1), "side": (10, 0.1), **wrong})
        # no place in a text that nobody wrote
        assert "\n" not in str(raised.value) and "<cube>" not in str(raised.value)
        (error,) = raised.value.errors
        assert error["argument"] == path and error["file"] == "<cube>" and error["line"] > 1

    def test_of_several(self) -> None:
        with pytest.raises(gu.ModelError) as raised:
            cube(mass=gu.normal(1, -0.1), side=gu.normal(10, -0.1))
        assert [error["argument"] for error in raised.value.errors] == ["mass.std", "side.std"]
        first, second = str(raised.value).splitlines()
        assert first.startswith("`cube`: argument `mass`: ") and second.startswith("`cube`: argument `side`")
        again = pickle.loads(pickle.dumps(raised.value))
        assert str(again) == str(raised.value) and again.errors == raised.value.errors

    def test_of_replacements(self) -> None:
        model = cube(mass=(1, 0.1), side=10)
        with pytest.raises(gu.ModelError, match="^`cube`: argument `mass`: "):
            model.with_inputs(mass=gu.normal(1, -1))
        with pytest.raises(gu.ModelError, match="^`cube`: .*did you mean `mass`"):
            model.set(mas=3)

    def test_of_dictionaries(self) -> None:
        file = {"inputs": {"a": {"unit": "V", "distribution": "normal", "mean": 1, "sdt": 0.1}},
                "equations": {"y": "a*b"}, "outputs": {"y": {"unit": "V"}}}  # fmt: skip
        with pytest.raises(gu.ModelError, match="^`inputs.a.sdt`: unknown key `sdt`") as raised:
            gu.from_dict(file)
        assert [error["argument"] for error in raised.value.errors] == ["inputs.a.sdt", "equations.y"]
        with pytest.raises(gu.ModelError, match="^`gauge`: `inputs.a.sdt`: "):
            gu.from_dict(file, name="gauge")
        assert gu.check(file)["ok"] is False
        with pytest.raises(gu.ModelError, match="(?m)^`inputs.a.sdt`: ") as raised:
            gu.gap(file)
        assert "inputs.a.sdt" in [error["argument"] for error in raised.value.errors]

    def test_of_tables(self) -> None:
        by_row = gu.model(inputs={"a": "V"}, outputs={"y": "V*Hz"}, conditions={"f": "Hz"})(
            lambda a, f: a * f
        )
        said = "^`conditions`: row 2, column `f`: `nan` is not a finite number$"
        with pytest.raises(gu.ModelError, match=said) as raised:
            by_row(a=(1, 0.1), conditions={"f": [1.0, math.nan]})
        assert raised.value.errors[0]["argument"] == "conditions"
        model = by_row(a=gu.readings([1, 2, 3]), conditions={"f": [1.0]})
        with pytest.raises(gu.ModelError, match="^`readings`: there is no input `b`"):
            model.run(readings={"b": [1.0, 2.0]})
        with pytest.raises(gu.ModelError, match="^`table`, row 2: "):
            gu.compare({"label": ["A", "B"], "x1": [1, 1], "U1": [1, -1], "x2": [1, 1], "U2": [1, 1]})

    def test_of_a_file_that_was_changed(self) -> None:
        """What stands in the file has a place there; what replaces it has a name."""
        model = gu.load(MODELS / "inclined_plane.json")
        with pytest.raises(gu.ModelError, match=r"inclined_plane.json`: `inputs.tilt.std`: "):
            model.with_inputs(tilt=gu.normal(35, -1, "deg"))

    def test_of_texts(self) -> None:
        """A text that somebody wrote has lines."""
        with pytest.raises(gu.ModelError, match=r"(?m)^<json>:1:25: ") as raised:
            gu.from_json('{"format": 1, "inputs": 5, "outputs": {}}')
        assert "\n1 | " in str(raised.value) and raised.value.errors[0]["argument"] is None


class TestErrors:
    text = '{"format": 1,\n "inputs": {"a": {"unit": "mm", "distribution": "normal", "mean": 1}},\n'
    text += ' "equations": {"y": "a + b"},\n "outputs": {"y": {"unit": "mm"}}}\n'

    def test_text_and_places(self, program: str, tmp_path: Path) -> None:
        path = tmp_path / "wrong.json"
        path.write_text(self.text)
        said = run(program, "run", path).stderr.decode()
        checked = json.loads(run(program, "check", path, "--format", "json").stdout)
        with pytest.raises(gu.ModelError) as raised:
            gu.load(path)
        assert str(raised.value) == said.strip()
        # of a file there is no argument of Python
        assert raised.value.errors == [{**error, "argument": None} for error in checked["errors"]]
        assert {error["line"] for error in raised.value.errors} == {2, 3}
        again = pickle.loads(pickle.dumps(raised.value))
        assert str(again) == str(raised.value) and again.errors == raised.value.errors
        assert gu.check(path)["ok"] is False

    def test_of_a_text(self) -> None:
        with pytest.raises(gu.ModelError, match=r"^mine:2:"):
            gu.from_json(self.text, name="mine")
        with pytest.raises(ValueError):
            gu.from_json("{")

    def test_a_file_that_is_not_there(self, program: str, tmp_path: Path) -> None:
        path = tmp_path / "none.json"
        with pytest.raises(gu.ModelError) as raised:
            gu.load(path)
        assert str(raised.value) == run(program, "run", path).stderr.decode().strip()

    def test_of_the_evaluation(self) -> None:
        model = gu.from_dict(
            {
                "inputs": {"x": (0.1, 1.0)},
                "equations": {"y": "sqrt(x)"},
                "outputs": {"y": {"unit": "1"}},
            }
        )
        with pytest.raises(gu.ModelError, match="no finite result"):
            model.run(trials=1000)

    @pytest.mark.parametrize(
        "options",
        [
            {"trials": 1}, {"trials": 1.5}, {"trials": -1}, {"trials": "many"}, {"seed": -1},
            {"coverage": 1.0}, {"k": 0}, {"coverage": 0.9, "k": 2}, {"digits": 0}, {"threads": 0},
            {"memory": 10}, {"rule": "none"}, {"rule": "stein"}, {"validate": True, "trials": 5},
            {"max_trials": 10},
        ],
        ids=str,
    )  # fmt: skip
    def test_options(self, options: dict[str, Any]) -> None:
        with pytest.raises(gu.ModelError) as raised:
            gu.load(MODELS / "inclined_plane.json").run(**options)
        names_keywords(raised.value, options)

    @pytest.mark.parametrize(
        "options",
        [
            {"coverage": 1.0}, {"coverage": "no"}, {"k": 0}, {"k": -1}, {"coverage": 0.9, "k": 2},
        ],
        ids=str,
    )  # fmt: skip
    def test_options_of_budgets(self, options: dict[str, Any]) -> None:
        with pytest.raises(gu.ModelError) as raised:
            gu.budgets(gu.load(MODELS / "inclined_plane.json"), tilt=(35, 0.1), **options)
        names_keywords(raised.value, options)

    @pytest.mark.parametrize(
        ("command", "options"),
        [
            *(
                (command, options)
                for command in ("assumptions", "certificate")
                for options in (
                    {"trials": -1}, {"trials": 1.5}, {"trials": True}, {"trials": ""}, {"seed": -1},
                    {"coverage": 5}, {"k": 0}, {"k": -2}, {"coverage": 0.9, "k": 2}, {"threads": 0},
                )
            ),
            ("assumptions", {"allow": -1}), ("assumptions", {"allow": "x"}),
            ("certificate", {"statement": "both"}), ("certificate", {"statement": "-x"}),
            ("gap", {"seed": -1}), ("gap", {"seed": 2**64}), ("gap", {"threads": -1}),
            ("gap_check", {"draws": -1}), ("gap_check", {"seed": 0.5}), ("gap_check", {"threads": 0}),
            ("observe", {"seed": -1}), ("observe", {"seed": "x"}),
            ("compare", {"scheme": "x"}), ("compare", {"scheme": ""}),
            ("compare", {"scheme": "iso13528", "sigma": "nqr"}),
            ("compare", {"scheme": "iso13528", "assigned": "mean", "sigma": 1}),
        ],
        ids=str,
    )  # fmt: skip
    def test_options_of_commands(self, command: str, options: dict[str, Any], tmp_path: Path) -> None:
        """Options are checked before the file is read, whatever it contains."""
        columns = {"label": ["A", "B"], "x": [10.3, 9.2]}
        with pytest.raises(gu.ModelError) as raised:
            getattr(gu, command)(columns if command == "compare" else tmp_path / "none.json", **options)
        names_keywords(raised.value, options)

    def test_advice_names_keywords(self) -> None:
        alone = {"label": ["A"], "x": [10.3]}
        with pytest.raises(gu.ModelError, match="^`scheme` is needed as well$"):
            gu.compare(alone, sigma=5)
        with pytest.raises(gu.ModelError, match="`assigned=VALUE, sigma=VALUE`"):
            gu.compare(alone, scheme="iso13528")
        with pytest.raises(gu.ModelError, match=r"^`table`: the table has no column U;.*`scheme='iso13528'`"):
            gu.compare(alone)

    def test_the_command_line_has_its_options(self) -> None:
        with pytest.raises(gu.ModelError, match="--trials"):
            gu.call("run", "model.json", "--trials", "-1")

    def test_unknown_outputs(self, plane: gu.Result) -> None:
        with pytest.raises(KeyError, match="a_x, a_y, a_z"):
            plane["a_w"]


class TestCommands:
    def test_compare_of_columns(self) -> None:
        columns = {"label": ["S"], "x1": [10.3], "U1": [0.4], "x2": [10.0], "U2": [0.3]}
        answer = gu.compare(columns)
        assert math.isclose(answer["rows"][0]["en"], 0.6) and answer.yes
        pandas = pytest.importorskip("pandas")
        assert dict(gu.compare(pandas.DataFrame(columns))) == dict(answer)
        assert not gu.compare({**columns, "x1": [11.3]}).yes

    def test_proficiency_test(self) -> None:
        columns = {"label": ["A", "B"], "x": [10.3, 9.2]}
        answer = gu.compare(columns, scheme="iso13528", assigned=10, assigned_u=0.1, sigma=0.2)
        assert [round(row["z"], 12) for row in answer["rows"]] == [1.5, -4.0]
        assert not answer.yes
        with pytest.raises(gu.ModelError, match="niqr"):
            gu.compare(columns, scheme="iso13528", sigma="nqr")

    def test_statement(self) -> None:
        """Three readings 0, 1, 2 and nothing else: u = 1/sqrt(3), k = 4.53 (t, 2, 95.45 %)."""
        file = {"inputs": {"x": {"distribution": "readings", "values": [0, 1, 2]}},
                "equations": {"y": "x - 0.1*x"}, "outputs": {"y": {}}}  # fmt: skip
        model = gu.from_dict(file)
        assert model.run(trials=20_000, statement="gum")["y"].gum.coverage_factor > 4.5
        with pytest.raises(gu.ModelError, match="statement"):
            model.run(trials=0, statement="both")
        path = MODELS / "certificates" / "weights.json"
        rows = gu.certificate(path, statement="monte-carlo", trials=50_000)["rows"]
        assert {row["basis"] for row in rows} == {"monte-carlo"}

    def test_certificate(self, tmp_path: Path) -> None:
        path = MODELS / "certificates" / "three_axis_accelerometer.json"
        certificate = gu.certificate(path, trials=0)
        certificate.save(tmp_path / "c.xml")
        text = (tmp_path / "c.xml").read_text()
        assert text.startswith("<?xml") and "digitalCalibrationCertificate" in text
        certificate.save(tmp_path / "c.html")
        assert (tmp_path / "c.html").stat().st_size > 1000

    def test_assumptions_of_a_model(self) -> None:
        path = MODELS / "inclined_plane.json"
        of_file = gu.assumptions(path, trials=20_000)
        of_model = gu.assumptions(gu.load(path), trials=20_000)
        assert dict(of_file) == dict(of_model)
        assert dict(pickle.loads(pickle.dumps(of_model))) == dict(of_model)
        assert "Sobol" in str(of_model)

    @pytest.mark.slow
    def test_gap_check(self) -> None:
        answer = gu.gap_check(MODELS / "gap" / "sampling_rate" / "case.json", draws=2)
        assert isinstance(answer, dict) and answer

    def test_verify(self) -> None:
        assert gu.verify()["diff"] == 0

    def test_help_and_mistakes(self) -> None:
        assert b"Usage: gumption" in gu.call("--help")
        with pytest.raises(gu.ModelError, match="unexpected argument"):
            gu.call("run", "--no-such-option")


class TestBudgets:
    @staticmethod
    def product() -> gu.Measurement:
        return gu.model(inputs={"a": "V", "b": "A"}, outputs={"p": "W"})(lambda a, b: a * b)

    def test_columns(self) -> None:
        a, u = np.linspace(1, 2, 1000), np.full(1000, 0.01)
        found = gu.budgets(self.product(), a=(a, u), b=(3.0, 0.02, 5))
        assert np.allclose(found.estimate, 3 * a, rtol=1e-15)
        expected = np.hypot(3 * u, 0.02 * a)
        assert np.allclose(found["p"].standard_uncertainty, expected, rtol=1e-14)
        # Welch-Satterthwaite with one finite term
        assert np.allclose(found.dof, 5 * (expected / (0.02 * a)) ** 4, rtol=1e-12)
        assert np.allclose(found.contributions["b"], 0.02 * a)
        assert np.allclose(found.sensitivities["a"], 3.0)
        assert found["p"].to_pandas().shape == (1000, 7)

    def test_the_same_as_a_run(self) -> None:
        model = gu.load(MODELS / "inclined_plane.json")
        found = gu.budgets(model, tilt=([35.0, 40.0], 0.05))
        one = model.with_inputs(tilt=gu.normal(40.0, 0.05)).run(trials=0)["a_x"]
        assert found["a_x"].estimate[1] == one.gum.estimate
        assert math.isclose(
            found["a_x"].standard_uncertainty[1], one.gum.standard_uncertainty, rel_tol=1e-14
        )

    def test_unumpy(self) -> None:
        unumpy = pytest.importorskip("uncertainties.unumpy")
        x = unumpy.uarray([1.0, 2.0], [0.1, 0.2])
        found = gu.budgets(self.product(), a=x, b=2.0)
        assert np.allclose(found.standard_uncertainty, unumpy.std_devs(2 * x))

    def test_mistakes(self) -> None:
        with pytest.raises(TypeError, match="nothing is said about b"):
            gu.budgets(self.product(), a=([1.0], [0.1]))
        with pytest.raises(gu.ModelError, match="different lengths"):
            gu.budgets(self.product(), a=([1.0, 2.0], 0.1), b=([1.0], 0.1))
        with pytest.raises(gu.ModelError, match="`a`: the standard uncertainty in row 1"):
            gu.budgets(self.product(), a=([1.0, 2.0], [0.1, -0.1]), b=1.0)
        with pytest.raises(gu.ModelError, match="no input or condition `c`"):
            gu.budgets(self.product(), a=1.0, b=2.0, c=3.0)

    def test_the_index_of_a_frame_is_kept(self) -> None:
        """U stands on its own row after a join, whatever the order of the frame."""
        pandas = pytest.importorskip("pandas")
        frame = pandas.DataFrame({"a": [3.0, 1.0, 2.0, 5.0], "u": [0.3, 0.1, 0.2, 0.5]}, index=list("wxyz"))
        frame = frame[frame["a"] < 4].sort_values("a")
        table = gu.budgets(self.product(), a=(frame["a"], frame["u"]), b=2.0).to_pandas()
        assert list(table.index) == ["x", "y", "w"]
        joined = frame.join(table)
        assert np.allclose(joined["standard_uncertainty"], 2 * joined["u"], rtol=1e-12)
        with pytest.raises(gu.ModelError, match="by their label"):
            gu.budgets(self.product(), a=(frame["a"], 0.1), b=frame["a"].sort_index(ascending=False))


def test_published_examples_are_where_they_were() -> None:
    assert (ROOT / "tests" / "cases").is_dir()
