"""What objects show in a notebook: small, rounded as on the pages, and in the colours of the notebook."""

from __future__ import annotations

import pickle
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from conftest import MODELS

import gumption as gu
from gumption import _notebook

#: The greatest size of what an object shows, in bytes.
MOST = 30_000


@gu.model(inputs={"mass": "g", "V_0": "cm^3"}, outputs={"rho": "kg/m^3"})
def density(mass: Any, V_0: Any) -> Any:
    """Density"""
    return mass / V_0


@gu.model(inputs={"a": "1"}, outputs={"y": "Hz"}, conditions={"f": "Hz"})
def line(a: Any, f: Any) -> Any:
    return a * f


def branch(a: Any) -> Any:
    return a if a > 0 else -a


@pytest.fixture(scope="module")
def plane() -> gu.Result[Any]:
    return gu.load(MODELS / "inclined_plane.json").run(trials=50_000, seed=1)


@pytest.fixture(scope="module")
def swept() -> gu.Result[Any]:
    return line(a=gu.normal(2, 0.0123), conditions={"f": np.arange(1.0, 5001.0)}).run(trials=0)


def shown_objects(plane: gu.Result[Any], swept: gu.Result[Any]) -> Mapping[str, Any]:
    """An object of each kind, and large ones."""
    parts = {"cal": gu.normal(0, 0.01), "res": gu.rectangular(0, 0.005)}
    untraced = gu.model(inputs={"a": "1"}, outputs={"y": "1"})(branch)
    with pytest.warns(gu.NotTracedWarning):
        by_python = untraced(a=(1, 0.1))
    many = {f"x{i}": "1" for i in range(300)}
    wide = gu.from_dict(
        {
            "inputs": dict.fromkeys(many, (1.0, 0.1)),
            "equations": {f"y{i}": f"{name} + x0" for i, name in enumerate(many)},
            "outputs": {f"y{i}": {"unit": "1"} for i in range(300)},
        }
    )
    columns = {"mass": (np.linspace(1, 2, 100_000), 0.1), "V_0": (12, 0.1)}
    pairs = {"label": [f"S{i}" for i in range(2000)], "x1": [10.3] * 2000, "U1": [0.4] * 2000,
             "x2": [10.0] * 2000, "U2": [0.3] * 2000}  # fmt: skip
    return {
        "Input": gu.normal(1, 0.1, "g", about="scale"),
        "Input of components": gu.components(12, parts, "mm"),
        "Input of many readings": gu.readings(np.arange(100_000.0)),
        "Expression": 2 * gu.normal(1, 0.1, "g", name="m") / gu.readings(np.arange(1000.0) + 1, "cm^3"),
        "Expression of results": 2 * plane["a_x"],
        "Comparison": gu.normal(1, 0.1) > 2,
        "Quantities": gu.array(np.ones(1000), 0.1, "g"),
        "Quantities in a matrix": gu.array(np.ones((3, 3)), 0.1),
        "complex Expression": gu.complex_normal(3 + 4j, 0.1, "V"),
        "Measurement": density,
        "Measurement that is not traced": untraced,
        "Model": density(mass=gu.normal(1, 0.1, "g"), V_0=(2, 0.01)),
        "Model of a function": by_python,
        "Model with conditions": swept.model,
        "Model of many": wide,
        "Result": plane,
        "Result in rows": swept,
        "Result of many": wide.run(trials=0),
        "Output": plane["a_x"],
        "Output in rows": swept["y"],
        "Budget": plane["a_x"].budget,
        "OutputBudgets": gu.budgets(density, **columns)["rho"],
        "budgets": gu.budgets(density, **columns),
        "Answer": gu.assumptions(MODELS / "inclined_plane.json", trials=20_000),
        "Answer of many": gu.compare(pairs),
        "Answer without a page": gu.check(MODELS / "inclined_plane.json"),
        "Answer with figures": gu.gap(MODELS / "gap" / "sampling_rate" / "case.json"),
        "Certificate": gu.certificate(MODELS / "certificates" / "three_axis_accelerometer.json", trials=0),
        "Effect": gu.effect({"drag": gu.rectangular(lower=0, upper=0.2, unit="1/s")}),
        "Effect of formulas": gu.effect({"c": gu.normal(0, 1)}, overrides={"y": "y + c/2"}),
        "Runs": gu.runs({"a": [1.0, 2.0]}, {"y": [[1.0, 2.0], [3.0, np.nan]]}),
        "Samples": plane.samples("a_x"),
        "SampleTable": plane.samples(),
    }


@pytest.fixture(scope="module")
def shown(plane: gu.Result[Any], swept: gu.Result[Any]) -> dict[str, str]:
    return {name: of._repr_html_() for name, of in shown_objects(plane, swept).items()}


def test_every_object_is_small(shown: dict[str, str]) -> None:
    sizes = {name: len(text.encode()) for name, text in shown.items()}
    assert {name: size for name, size in sizes.items() if not 50 < size < MOST} == {}


def test_it_has_the_colours_of_the_notebook(shown: dict[str, str]) -> None:
    for name, text in shown.items():
        styles = set(re.findall(r' style="([^"]*)"', text))
        assert styles <= {"text-align:right", "text-align:left", _notebook._TITLE}, name
        # nothing of a page that would reach beyond the cell
        assert not re.search(r"<(style|script|svg|figure|iframe|h[1-6])\b", text), name


def test_tags_are_closed(shown: dict[str, str]) -> None:
    for name, text in shown.items():
        for tag in ("div", "table", "tr", "td", "th", "tbody"):
            assert len(re.findall(rf"<{tag}\b", text)) == text.count(f"</{tag}>"), (name, tag)


def cells(text: str) -> list[list[str]]:
    """The rows of the tables, without the spaces that align numbers."""
    rows = [re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row) for row in re.findall(r"<tr>(.*?)</tr>", text)]
    return [[cell.strip(" \u2007\u2008") for cell in row] for row in rows]


def test_numbers_are_those_of_the_page(plane: gu.Result[Any]) -> None:
    """10 sin(35 deg) cos(30 deg) = 4.967318, and u = 0.009172 from three contributions: see the example of
    the engine's documentation."""
    wanted = ["a_x", "4.9673", "0.0092", "m/s²", "combined", "∞", "", "0.0092", "100.0"]
    assert wanted in cells(plane["a_x"].budget._repr_html_())
    assert wanted in cells(plane["a_x"]._repr_html_()) and wanted in cells(plane._repr_html_())
    page = plane.page().html
    for row in cells(plane["a_x"].budget._repr_html_()):
        assert all(cell in page for cell in row)
    assert "a_x = (4.967 ± 0.018) m/s²" in plane._repr_html_()


def test_rows_are_rounded_to_their_uncertainty(swept: gu.Result[Any]) -> None:
    """y = 2 f with u = 0.0123 f, two digits of it; U = 2 u (k = 2), of which the page gives two digits."""
    rows = cells(swept["y"]._repr_html_())
    assert rows[0] == ["f in Hz", "estimate", "standard uncertainty", "expanded uncertainty"]
    assert rows[1] == ["1.0", "2.000", "0.012", "0.025"]
    # of 5000 rows the first and the last ones
    assert rows[-2] == ["…"] * 4 and rows[-1] == ["5000.0", "10000", "62", "120"] and len(rows) == 13


def test_budgets_in_columns_are_rounded(plane: gu.Result[Any]) -> None:
    """1 g in 2 cm^3 is 500 kg/m^3, u = 500 sqrt(0.1^2 + 0.01^2) = 50.2, U = 2 u."""
    found = gu.budgets(density, mass=(np.array([1.0, 2.0]), 0.1), V_0=(2.0, 0.02))
    for text in (found._repr_html_(), found["rho"]._repr_html_()):
        assert cells(text)[1] == ["0", "500", "50", "100"]


def test_samples_are_rounded(plane: gu.Result[Any]) -> None:
    """The scatter of 50,000 trials is 0.0092; their mean is within 5 of its standard errors of 4.96725."""
    row = cells(plane.samples("a_x")._repr_html_())[1]
    assert row[1] == "50000" and row[3] == "0.0092"
    # 0.0092 / sqrt(50,000) is 0.00004
    assert row[2] in ("4.9670", "4.9671", "4.9672", "4.9673", "4.9674", "4.9675")
    assert cells(plane.samples()._repr_html_())[1][2:] == row[2:]
    # a matrix or a single number is shown by NumPy
    assert plane.samples("a_x")[:4].reshape(2, 2)._repr_html_() is None


def test_what_is_stated_stays_as_it_is() -> None:
    model = density(mass=gu.normal(1.23456789, "0.02 % + 2 ug", "g"), V_0=2)
    assert ["mass", "g", "normal", "mean = 1.23456789, std = 0.02 % + 2 ug"] in cells(model._repr_html_())
    assert ["V_0", "cm^3", "constant", "value = 2"] in cells(model._repr_html_())


def test_texts_are_no_markup() -> None:
    known = gu.normal(1, 0.1, about="<script>alert(1)</script>")
    title = "<img src=x onerror=alert(1)>"
    model = density(mass=known, V_0=(2, 0.1), title=title)
    result = model.run(trials=0)
    answer = gu.assumptions(model, trials=20_000)
    for of in (known, model, result, result["rho"], result["rho"].budget, answer):
        assert not re.search(r"<(script|img)", of._repr_html_())


def test_what_is_left_out_is_said(shown: dict[str, str]) -> None:
    assert "page()" in shown["Result of many"] and "…" in shown["Answer of many"]
    assert "page()" not in shown["Result"]


def test_the_whole_page(plane: gu.Result[Any]) -> None:
    page = plane.page()
    assert page._repr_html_().startswith("<iframe srcdoc=") and "<svg" in page.html
    assert page.html == plane.to("html").decode()
    assert gu.compare({"label": ["S"], "x1": [1], "U1": [1], "x2": [1], "U2": [1]}).page().html
    with pytest.raises(gu.ModelError, match="html"):
        gu.check(MODELS / "inclined_plane.json").page()


def test_equations_in_latex() -> None:
    wanted = "$$\\begin{aligned}\n\\rho &= \\frac{\\mathit{mass}}{V_{0}}\n\\end{aligned}$$"
    model = density(mass=(1, 0.1), V_0=2)
    assert density.latex() == density._repr_latex_() == wanted
    assert model.latex() == model._repr_latex_() == wanted
    with pytest.warns(gu.NotTracedWarning):
        by_python = gu.model(inputs={"a": "1"}, outputs={"y": "1"})(branch)(a=(1, 0.1))
    assert by_python._repr_latex_() is None
    with pytest.raises(gu.ModelError, match="no equations"):
        by_python.latex()


def test_a_value_in_latex(plane: gu.Result[Any], swept: gu.Result[Any]) -> None:
    unit = "\\,\\text{m/s}^{2}"
    value = f"a_{{x}} = 4.9673{unit},\\quad u(a_{{x}}) = 0.0092{unit}"
    assert plane["a_x"].latex() == value and plane["a_x"]._repr_latex_() == f"$${value}$$"
    assert swept["y"].latex(1) == "y = 4.000\\,\\text{Hz},\\quad u(y) = 0.025\\,\\text{Hz}"
    # many values are no value
    assert swept["y"]._repr_latex_() is None


def test_a_budget_in_latex(plane: gu.Result[Any]) -> None:
    found = plane["a_x"].budget.latex()
    assert found.startswith("$$\\begin{array}{lrrrrrrrr}\n\\text{quantity} & \\text{estimate}")
    line = "10.000 & 0.010 & \\text{m/s}^{2} & \\text{normal} & \\infty & 0.4967 & 0.0050 & 29.3"
    assert f"\\text{{a\\_ref}} & {line} \\\\\n" in found
    again = pickle.loads(pickle.dumps(plane["a_x"].budget))
    assert again.latex() == found and again["share"][0] == plane["a_x"].budget["share"][0]


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("5\u202f×\u202f10⁻⁷", "5 \\times 10^{-7}"),
        ("1.2e-7", "1.2 \\times 10^{-7}"),
        ("−0.05005\u2007", "-0.05005"),
        ("1\u202f000", "1\\,000"),
        ("∞", "\\infty"),
        ("kg*m^-3", "\\text{kg*m}^{-3}"),
        ("Hz^(1/2)", "\\text{Hz}^{1/2}"),
        ("share in %", "\\text{share in \\%}"),
        ("2026-11-30", "\\text{2026-11-30}"),
        ("", ""),
    ],
)
def test_cells_in_latex(text: str, latex: str) -> None:
    assert _notebook.latex(text) == latex


def test_a_notebook_gets_html_and_latex(plane: gu.Result[Any]) -> None:
    """JupyterLab, Notebook and VS Code prefer HTML; LaTeX is what `nbconvert --to pdf` takes."""
    formatters = pytest.importorskip("IPython.core.formatters")
    found, _ = formatters.DisplayFormatter().format(plane["a_x"])
    assert {"text/plain", "text/html", "text/latex"} <= found.keys()
    # a class is no object of it
    assert "text/html" not in formatters.DisplayFormatter().format(gu.Result)[0]


class TestAxes:
    def test_given_axes(self, plane: gu.Result[Any], swept: gu.Result[Any]) -> None:
        figures = pytest.importorskip("matplotlib.figure")
        figure = figures.Figure()
        grid = figure.subplots(2, 2)
        assert plane.plot(["a_x", "a_y"], ax=grid[0]) is figure
        assert swept.plot(ax=grid[1, 0]) is figure
        assert [panel.get_xlabel() for panel in grid.flat] == ["a_x in m/s^2", "a_y in m/s^2", "f in Hz", ""]

    def test_another_number(self, plane: gu.Result[Any]) -> None:
        figures = pytest.importorskip("matplotlib.figure")
        panel = figures.Figure().subplots()
        with pytest.raises(ValueError, match="1 axes, but 3 are needed: one for each of a_x, a_y, a_z"):
            plane.plot(ax=panel)
        with pytest.raises(TypeError, match="`ax` has a str"):
            plane.plot("a_x", ax="no")
