"""Figures with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from gumption._result import Result


def _panels(ax: Any, wanted: list[str], height: float) -> list[Any]:
    """The axes that are given, or those of a new figure.

    Parameters
    ----------
    ax : matplotlib.axes.Axes or array of these or None
        The axes that are given.
    wanted : list of str
        What is drawn in each.
    height : float
        The height of each in a new figure, in inches.
    """
    if ax is None:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6.4, height * len(wanted)), layout="constrained")
        return list(figure.subplots(len(wanted), 1, squeeze=False)[:, 0])
    panels = list(np.ravel(np.asarray(ax, dtype=object)))
    for panel in panels:
        if not hasattr(panel, "errorbar"):
            raise TypeError(f"`ax` has a {type(panel).__name__}, but must be matplotlib axes")
    if len(panels) != len(wanted):
        raise ValueError(
            f"`ax` has {len(panels)} axes, but {len(wanted)} are needed: one for each of {', '.join(wanted)}"
        )
    return panels


def plot(result: Result, outputs: list[str], row: int | None, ax: Any) -> Any:
    """The figure that `Result.plot` gives."""
    drawn = [result[name] for name in outputs]
    panels = _panels(ax, outputs, 3.2)
    swept = result._run.swept and row is None
    bins = None if swept else dict(zip(result, result._run.histograms(row or 0)))
    for panel, output in zip(panels, drawn):
        if bins is None:
            _sweep(panel, result, output)
        else:
            _distribution(panel, output, bins.get(output.name), row or 0)
    return panels[0].figure


def _at(value: Any, row: int) -> Any:
    """A figure in a row of conditions."""
    return value if isinstance(value, float) or np.ndim(value) == 0 else value[row]


def _interval(values: Any, row: int) -> Any:
    return values[row] if values.ndim == 2 else values


def _distribution(panel: Any, output: Any, bins: Any, row: int) -> None:
    gum, trials = output.gum, output.monte_carlo
    y, u = _at(gum.estimate, row), _at(gum.standard_uncertainty, row)
    if bins is not None:
        low, width, counts = bins
        edges = low + width * np.arange(len(counts) + 1)
        density = counts / (_at(trials.trials, row) * width)
        panel.stairs(density, edges, fill=True, color="tab:blue", alpha=0.35, label="Monte Carlo")
        for name, of, style in (
            ("symmetric", trials.symmetric_interval, "-"),
            ("shortest", trials.shortest_interval, ":"),
        ):
            for number, end in enumerate(_interval(of, row)):
                label = f"{name} interval" if number == 0 else None
                panel.axvline(end, color="tab:blue", linestyle=style, label=label)
    if u > 0:
        x = np.linspace(y - 4 * u, y + 4 * u, 400)
        normal = np.exp(-0.5 * ((x - y) / u) ** 2) / (u * np.sqrt(2 * np.pi))
        panel.plot(x, normal, color="tab:orange", label="GUM, normal")
    interval = _interval(gum.interval, row)
    if np.all(np.isfinite(interval)):
        for number, end in enumerate(interval):
            label = "GUM interval" if number == 0 else None
            panel.axvline(end, color="tab:orange", linestyle="--", label=label)
    panel.set_xlabel(f"{output.name} in {output.unit}")
    panel.set_ylabel("density")
    panel.set_ylim(bottom=0)
    panel.legend(fontsize="small")


def _sweep(panel: Any, result: Result, output: Any) -> None:
    names = list(result.conditions)
    units = dict(result._run.conditions)
    rows = np.arange(result.rows)
    # over a condition of its own values, else over the rows
    x = result.conditions[names[0]] if len(names) == 1 else rows
    panel.errorbar(
        x, output.gum.estimate, yerr=output.gum.expanded_uncertainty, fmt="o", capsize=3, label="y, U"
    )
    panel.set_xlabel(f"{names[0]} in {units[names[0]]}" if len(names) == 1 else "row")
    panel.set_ylabel(f"{output.name} in {output.unit}")
    panel.legend(fontsize="small")


def plot_gap(answer: dict[str, Any], ax: Any) -> Any:
    """The figure of a diagnosis: residuals over their standard uncertainty before and after, by output, and
    the probabilities of the effects."""
    rows = answer["rows"]
    outputs = list(rows[0]["outputs"]) if rows else []
    names = list(rows[0]["conditions"]) if rows else []
    *panels, bars = _panels(ax, [*(f"the residuals of {name}" for name in outputs), "the effects"], 2.6)
    # over the first condition where it runs along with the rows, as time does; else over the rows
    x = np.array([row["conditions"][names[0]] for row in rows]) if names else np.arange(0)
    is_along = len(x) > 1 and bool(np.all(np.diff(x) > 0))
    if not is_along:
        x = np.arange(1, len(rows) + 1)
    for panel, output in zip(panels, outputs):
        found = [row["outputs"][output] for row in rows]
        for part, label, style in (("before", "plain sim", "x"), ("after", "corrected sim", ".")):
            z = [row[part] / row["standard_uncertainty"] for row in found]
            panel.plot(x, z, style, markersize=4, label=label)
        panel.axhspan(-2, 2, color="tab:gray", alpha=0.2, linewidth=0)
        panel.set_xlabel(names[0] if is_along else "row")
        panel.set_ylabel(f"residual of {output} / u")
        panel.legend(fontsize="small")
    present = answer["present"]
    bars.barh(list(present), [effect["probability"] for effect in present.values()])
    bars.set_xlim(0, 1)
    bars.invert_yaxis()
    bars.set_xlabel("probability that the effect is there")
    return bars.figure
