"""What notebooks show: small tables that have the colours of the notebook, and whole pages on request.

Texts and roundings are those of the engine's pages. What is longer than `MOST` is cut, and says so.
"""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Mapping, Sequence
from html.parser import HTMLParser
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption

#: Most characters of what an object shows.
MOST = 28_000

#: Most rows of a table, and how many are left where it has more.
ROWS = (40, 10)

_RIGHT, _LEFT = ' style="text-align:right"', ' style="text-align:left"'
_TITLE = "font-weight:bold;margin-top:0.8em"


class Page:
    """A whole page with its figures; last in a cell of a notebook it is shown in a frame.

    Attributes
    ----------
    html : str
        The page.
    """

    def __init__(self, page: str) -> None:
        self.html = page

    def _repr_html_(self) -> str:
        # in its own frame, so that its style and that of a notebook do not interfere
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:36em;border:0" '
            'title="gumption"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<gumption page of {len(self.html) / 1000:.0f} kB, which a notebook shows>"


def title(text: str) -> str:
    """A title within a cell; headings would be entries in the contents of the notebook."""
    return f'<div style="{_TITLE}">{html.escape(text)}</div>'


def table(headings: Sequence[str], lines: Iterable[Sequence[Any]], numbers: Sequence[str] = ()) -> str:
    """A table.

    Parameters
    ----------
    headings : sequence of str
        The headings of its columns.
    lines : iterable of sequence
        The cells: texts, or markup that is an object with `_repr_html_`.
    numbers : sequence of str
        The headings of the columns that are numbers.
    """
    styles = [_RIGHT if heading in numbers else _LEFT for heading in headings]
    head = "".join(f"<th{style}>{html.escape(of)}</th>" for style, of in zip(styles, headings))
    rows = ["".join(f"<td{style}>{_cell(cell)}</td>" for style, cell in zip(styles, line)) for line in lines]
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


class Markup(str):
    """A text that is HTML already."""

    __slots__ = ()


def _cell(cell: Any) -> str:
    return cell if isinstance(cell, Markup) else html.escape(str(cell))


def formula(text: str) -> Markup:
    """A formula, set as on the pages."""
    return Markup(_gumption.equation_html(text))


def equations(formulas: Mapping[str, str], heading: str = "equation") -> str:
    """A table of equations, set as on the pages."""
    lines = [[Markup(f"{formula(name)} = {formula(text)}")] for name, text in formulas.items()]
    return table([heading], lines)


def chosen(count: int) -> list[int | None]:
    """The rows of a long table that are shown; `None` stands for those in between."""
    most, left = ROWS
    if count <= most:
        return list(range(count))
    return [*range(left), None, count - 1]


def estimates(
    before: Mapping[str, Sequence[Any] | npt.NDArray[Any]],
    x: npt.NDArray[np.float64],
    u: npt.NDArray[np.float64],
    expanded: npt.NDArray[np.float64],
) -> str:
    """A table of results, one a line, rounded as on the pages.

    Parameters
    ----------
    before : mapping of str to sequence
        The columns before them, by their headings.
    x, u, expanded : ndarray
        Estimates, standard and expanded uncertainties.
    """
    headings = [*before, "estimate", "standard uncertainty", "expanded uncertainty"]
    lines: list[Sequence[str]] = []
    for row in chosen(len(x)):
        if row is None:
            lines.append(["…"] * len(headings))
            continue
        y, shown_u = _gumption.printed(x[row], u[row])
        shown = [str(column[row]) for column in before.values()]
        lines.append([*shown, y, shown_u, _gumption.printed(x[row], expanded[row])[1]])
    return table(headings, lines, headings)


def stated(value: Any) -> str:
    """A value as it is stated; of a long list its beginning."""
    if isinstance(value, (list, tuple)) and len(value) > 6:
        return f"{', '.join(map(stated, value[:5]))}, … ({len(value)} values)"
    if isinstance(value, (list, tuple)):
        return ", ".join(map(stated, value))
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {stated(inner)}" for key, inner in value.items())
    text = str(value)
    return text if len(text) <= 200 else f"{text[:200]}…"


def inputs(known: Mapping[str, Mapping[str, Any] | str]) -> str:
    """A table of inputs by their names, each with the keys that it has in a model file, or as a text
    such as ``"5 V +- 0.1 V"``."""
    lines = []
    for name, keys in known.items():
        if isinstance(keys, str):
            lines.append([name, "", "", keys])
            continue
        lines.append([name, keys.get("unit", ""), *_known(keys)])
        parts = keys.get("components", ())
        lines += [[f"{name}/{part.get('name', '')}", "", *_known(part)] for part in parts]
    return table(["input", "unit", "distribution", "known"], lines)


def _known(keys: Mapping[str, Any]) -> list[str]:
    """The distribution and what else is known, its numbers as they are stated."""
    elsewhere = ("name", "unit", "distribution", "components")
    known = [f"{key} = {stated(value)}" for key, value in keys.items() if key not in elsewhere]
    return [str(keys.get("distribution", "")), ", ".join(known)]


def whole(parts: Sequence[str], rest: str = "") -> str:
    """What an object shows: as many of the parts as there is room for.

    Parameters
    ----------
    parts : sequence of str
        HTML.
    rest : str
        Where everything is, in words.
    """
    shown: list[str] = []
    for part in parts:
        if sum(map(len, shown)) + len(part) > MOST:
            more = f"… {rest}" if rest else "…"
            shown.append(f"<div>{html.escape(more)}</div>")
            break
        shown.append(part)
    return f"<div>{''.join(shown)}</div>"


def text(content: str) -> str:
    """A text page."""
    cut = content if len(content) <= MOST // 2 else f"{content[: MOST // 2]}…"
    return f"<pre>{html.escape(cut)}</pre>"


def light(page: str) -> str:
    """A page of the engine, or a part of one, without figures and with the look of the notebook."""
    if "<main" in page:
        page = page[page.index("<main") : page.index("</main>")]
        page = page[page.index(">") + 1 :]
    page = re.sub(r"<(figure|nav|details)\b.*?</\1>", "", page, flags=re.DOTALL)
    page = re.sub(r"<tbody>(.*?)</tbody>", _shorter, page, flags=re.DOTALL)
    page = re.sub(r"<(t[hd])( scope=\"\w+\")?( class=\"number\")?>", _aligned, page)
    page = re.sub(r" (?:class|tabindex|id)=\"[^\"]*\"", "", page)
    return re.sub(r"<h[12]>(.*?)</h[12]>", rf'<div style="{_TITLE}">\1</div>', page)


def light_page(page: str, rest: str = "`page()` shows all, with its figures") -> str:
    """What an answer shows of its page."""
    sections = re.split(rf'(?=<div style="{_TITLE}">)', light(page))
    return whole(sections, rest)


def _aligned(found: re.Match[str]) -> str:
    return f"<{found[1]}{found[2] or ''}{_RIGHT if found[3] else _LEFT}>"


def _shorter(body: re.Match[str]) -> str:
    """The rows of a table, without those in the middle of a long one."""
    rows = re.findall(r"<tr\b.*?</tr>", body[1], flags=re.DOTALL)
    shown = ["<tr><td>…</td></tr>" if row is None else rows[row] for row in chosen(len(rows))]
    return f"<tbody>{''.join(shown)}</tbody>"


class _Cells(HTMLParser):
    """The cells of the tables of a part of a page."""

    def __init__(self, part: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self._is_in = False
        self.feed(part)

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
            self._is_in = True

    def handle_endtag(self, tag: str) -> None:
        if tag in ("td", "th"):
            self._is_in = False

    def handle_data(self, data: str) -> None:
        if self._is_in:
            self.rows[-1][-1] += data


def latex_table(part: str) -> str:
    """The table of a part of a page as an array, which notebooks typeset and LaTeX as well."""
    rows = [[latex(cell) for cell in row] for row in _Cells(part).rows]
    lines = [" & ".join(row) for row in rows]
    lines[1:2] = [rf"\hline {line}" for line in lines[1:2]]
    columns = "l" + "r" * (max(map(len, rows), default=1) - 1)
    body = " \\\\\n".join(lines)
    return f"$$\\begin{{array}}{{{columns}}}\n{body}\n\\end{{array}}$$"


#: Digits and signs that are raised on pages, and what they are.
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")

#: What LaTeX takes for something else in a text.
_ESCAPED = {**{c: f"\\{c}" for c in "#$%&_{}"}, "\\": r"$\backslash$", "^": r"$\wedge$", "~": r"$\sim$"}


def latex(text: str) -> str:
    """A number, a unit or words of a page in the mathematical mode of LaTeX."""
    text = re.sub(r"[\s\u2007\u2008]+", " ", text.replace("\u202f", " ")).strip()
    if text == "∞":
        return r"\infty"
    if number := re.fullmatch(r"([−-]?[0-9][0-9. ]*?)(?: ?× ?10([⁻⁰¹²³⁴-⁹]+)|e(-?[0-9]+))?", text):
        digits, raised, power = number.groups()
        power = raised.translate(_RAISED) if raised else power
        shown = digits.replace("−", "-").replace(" ", r"\,")
        return shown if power is None else rf"{shown} \times 10^{{{power}}}"
    parts = re.split(r"([⁻⁰¹²³⁴-⁹]+|\^\(?-?[0-9./]+\)?)", text)
    words = ["".join(_ESCAPED.get(c, c) for c in part) for part in parts[::2]]
    powers = [part.translate(_RAISED).strip("^()") for part in parts[1::2]]
    shown = [rf"\text{{{word}}}" if word else "" for word in words]
    return "".join(
        of if place == len(powers) else f"{of}^{{{powers[place]}}}" for place, of in enumerate(shown)
    )


def latex_name(name: str) -> str:
    """The name of a quantity in LaTeX."""
    return _gumption.equation_latex(name)


def latex_equations(equations: Mapping[str, str]) -> str:
    """Equations below each other."""
    lines = [
        f"{latex_name(name)} &= {_gumption.equation_latex(formula)}" for name, formula in equations.items()
    ]
    body = " \\\\\n".join(lines)
    return f"$$\\begin{{aligned}}\n{body}\n\\end{{aligned}}$$"


def latex_value(name: str, unit: str, x: float, u: float) -> str:
    """An estimate with its standard uncertainty, rounded as on the pages."""
    shown = [latex(number) for number in _gumption.printed(x, u)]
    own = "" if unit == "1" else rf"\,{latex(unit)}"
    symbol = latex_name(name)
    return rf"{symbol} = {shown[0]}{own},\quad u({symbol}) = {shown[1]}{own}"
