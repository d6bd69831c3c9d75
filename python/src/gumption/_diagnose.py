"""The gap of a simulator that is a Python function, or a table of runs that were made before."""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._frames import columns, csv, numbers
from gumption._quantities import as_input
from gumption._notebook import Page
from gumption._result import format_of
from gumption._shapes import Input, plain
from gumption._simulate import Simulate

#: The file of the data in the case that a diagnosis is made of.
DATA = "data.csv"


class Effect:
    """What the sim leaves out: an ability of the simulator, or formulas that override outputs.

    Attributes
    ----------
    parameters : dict of str to Input
        The prior distributions of its parameters by their names.
    neutral : dict of str to object
        The values of parameters at which the effect is absent; empty where they are not given.
    overrides : dict of str to str
        Formulas by the outputs that they override; empty for an ability of the simulator.
    about : str or None
        What it is, in words.
    """

    __slots__ = ("about", "neutral", "overrides", "parameters")

    def __init__(
        self,
        parameters: Mapping[str, Input],
        neutral: Mapping[str, Any],
        overrides: Mapping[str, str],
        about: str | None = None,
    ) -> None:
        self.parameters = dict(parameters)
        self.neutral = dict(neutral)
        self.overrides = dict(overrides)
        self.about = about

    def to_dict(self) -> dict[str, Any]:
        """The effect as in a case file."""
        found: dict[str, Any] = {} if self.about is None else {"about": self.about}
        found["parameters"] = {name: known.to_dict() for name, known in self.parameters.items()}
        if self.overrides:
            found["overrides"] = dict(self.overrides)
        else:
            found["simulator"] = True
            if self.neutral:
                found["neutral"] = dict(self.neutral)
        return found

    def _repr_html_(self) -> str:
        shown = [_notebook.title(self.about or "effect")]
        shown.append(_notebook.inputs({name: known.to_dict() for name, known in self.parameters.items()}))
        if self.overrides:
            shown.append(_notebook.equations(self.overrides, "overrides"))
        elif self.neutral:
            shown.append(_notebook.table(["absent at", "value"], self.neutral.items()))
        return _notebook.whole(shown)

    def __repr__(self) -> str:
        parts = [f"{self.parameters!r}"]
        if self.overrides:
            parts.append(f"overrides={self.overrides!r}")
        else:
            parts.append(f"neutral={self.neutral!r}")
        if self.about is not None:
            parts.append(f"about={self.about!r}")
        return f"gumption.effect({', '.join(parts)})"


def effect(
    parameters: Mapping[str, Any],
    *,
    neutral: Mapping[str, Any] | None = None,
    overrides: Mapping[str, str] | None = None,
    about: str | None = None,
) -> Effect:
    """An effect that the sim leaves out.

    Parameters
    ----------
    parameters : mapping of str to object
        The prior distributions of its parameters, such as `rectangular` or `log_uniform`.
    neutral : mapping of str to float, optional
        The parameters that make the effect absent, with their values: numbers in the parameter's unit, or
        texts with a unit. By default 0 of the only parameter that can, which an angle of the whole turn
        cannot. Parameters that are not named are at their medians where the effect is absent.
    overrides : mapping of str to str, optional
        Formulas by the outputs that they override, instead of an ability of the simulator.
    about : str, optional
        What it is, in words.

    Raises
    ------
    ValueError
        Neutral values beside formulas, none in `neutral`, or one that is no finite number. What else is wrong with an effect, such as
        several parameters and none that is neutral, `diagnose` says.
    """
    known = {str(name): as_input(value, f"`{name}`") for name, value in parameters.items()}
    if overrides is not None:
        if neutral is not None:
            raise ValueError("an effect has `neutral` or `overrides`: formulas are absent without it")
        if not overrides:
            raise ValueError("`overrides` names no output")
        formulas = {str(name): str(formula) for name, formula in overrides.items()}
        return Effect(known, {}, formulas, about)
    absent = {str(name): plain(value) for name, value in (neutral or {}).items()}
    if neutral is not None and not absent:
        raise ValueError("`neutral` names no parameter")
    for name, value in absent.items():
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError(f"the neutral value of {name!r} is {value!r}, but must be a finite number")
    return Effect(known, absent, {}, about)


def as_effect(value: Any, name: str) -> Effect:
    """An effect as it is given to a diagnosis: an `Effect`, or a mapping of parameters of the simulator."""
    if isinstance(value, Effect):
        return value
    if not isinstance(value, Mapping):
        kind = type(value).__name__
        raise TypeError(
            f"the effect {name!r} is a {kind}, but must be a mapping of parameters or gumption.effect(...)"
        )
    return effect(value)


class Runs:
    """Runs of a simulator that were made before.

    Attributes
    ----------
    parameters : dict of str to array
        A value for each run, by parameter.
    outputs : dict of str to array
        The values of each output: a line for each run, a column for each row of the data.
    """

    __slots__ = ("outputs", "parameters")

    def __init__(
        self,
        parameters: Mapping[str, npt.NDArray[np.float64]],
        outputs: Mapping[str, npt.NDArray[np.float64]],
    ) -> None:
        self.parameters = dict(parameters)
        self.outputs = dict(outputs)

    def __len__(self) -> int:
        return len(next(iter(self.parameters.values())))

    @property
    def rows(self) -> int:
        """Number of rows of the data."""
        return int(next(iter(self.outputs.values())).shape[1])

    @property
    def failed(self) -> npt.NDArray[np.bool_]:
        """Which runs failed: an output is no finite number at some row."""
        finite = [np.isfinite(values).all(axis=1) for values in self.outputs.values()]
        failed: npt.NDArray[np.bool_] = ~np.logical_and.reduce(finite)
        return failed

    def arrays(
        self, parameters: Sequence[str], outputs: Sequence[str]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """A line of parameters for each run, and one of all outputs, output after output.

        Parameters
        ----------
        parameters, outputs : sequence of str
            Names in the order that is wanted.

        Raises
        ------
        ValueError
            A parameter or an output is missing, or there is another one.
        """
        for what, wanted, given in (
            ("parameters", parameters, self.parameters),
            ("outputs", outputs, self.outputs),
        ):
            if set(wanted) != set(given):
                raise ValueError(
                    f"the runs have the {what} {', '.join(given)}, and the case {', '.join(wanted)}"
                )
        values = [self.parameters[name] for name in parameters]
        return np.column_stack(values), np.hstack([self.outputs[name] for name in outputs])

    def _repr_html_(self) -> str:
        failed = int(self.failed.sum())
        said = f"{len(self)} runs, of which {failed} failed; {self.rows} rows of {', '.join(self.outputs)}"
        ranges = [
            [name, f"{values.min():.6g}", f"{values.max():.6g}"] for name, values in self.parameters.items()
        ]
        headings = ["parameter", "smallest", "largest"]
        return _notebook.whole([_notebook.title(said), _notebook.table(headings, ranges, headings[1:])])

    def __repr__(self) -> str:
        of = ", ".join(self.parameters)
        return f"<{len(self)} runs with {of}: {', '.join(self.outputs)} at {self.rows} rows>"


def runs(parameters: Any, outputs: Mapping[str, npt.ArrayLike]) -> Runs:
    """Runs of a simulator that were made before, in the place of a function.

    Parameters
    ----------
    parameters : DataFrame or mapping
        A column for each parameter, a row for each run.
    outputs : mapping of str to array_like
        A line for each run and a column for each row of the data. A run with a value that is no finite
        number has failed.

    Raises
    ------
    ValueError
        There is no run, parameter or output; a parameter that is no finite number; numbers of runs or
        rows that differ.
    """
    known = {name: numbers(column) for name, column in columns(parameters).items()}
    if not known or not len(next(iter(known.values()))):
        raise ValueError("the runs have no parameters")
    if not isinstance(outputs, Mapping) or not outputs:
        raise ValueError("the outputs are a mapping from names to arrays of runs by rows")
    found = {}
    count = len(next(iter(known.values())))
    for name, column in known.items():
        if column.shape != (count,):
            raise ValueError(f"the parameter {name!r} has the shape {column.shape}, not {(count,)}")
        bad = np.flatnonzero(~np.isfinite(column))
        if len(bad):
            raise ValueError(
                f"the parameter {name!r} of run {bad[0] + 1} is {column[bad[0]]}, but must be a finite number"
            )
    rows = None
    for name, given in outputs.items():
        values = np.asarray(given, dtype=np.float64)
        if values.ndim != 2 or len(values) != count:
            raise ValueError(
                f"the output {name!r} has the shape {values.shape}, but must have {count} runs by rows"
            )
        if rows is not None and values.shape[1] != rows:
            raise ValueError(f"the output {name!r} has {values.shape[1]} rows, those before it {rows}")
        rows = values.shape[1]
        found[str(name)] = values
    if rows == 0:
        raise ValueError("the outputs have no rows")
    return Runs(known, found)


class Diagnosis:
    """Where a simulator and its data depart, which effect is missing, and how far the gap then shrinks.

    In a notebook it shows the tables of the page of ``gumption gap``, and `page` all of it.
    """

    def __init__(
        self, rust: _gumption.SimulatorGap, case: _gumption.SimulatedGap, simulate: Simulate | None
    ) -> None:
        self._rust = rust
        self._case = case
        self._simulate = simulate
        self._answer: dict[str, Any] = json.loads(rust.json())

    @property
    def verdict(self) -> dict[str, Any]:
        """The most probable hypothesis: its ``kind`` ("none", "explained", "unexplained"), ``effects`` and
        ``probability``, and the ``group`` that the data cannot tell from it."""
        found: dict[str, Any] = self._answer["verdict"]
        return found

    @property
    def probability(self) -> float:
        """The probability of the verdict."""
        return float(self.verdict["probability"])

    @property
    def present(self) -> dict[str, Any]:
        """For each effect the ``probability`` that it is part of the truth, and its ``parameters``."""
        found: dict[str, Any] = self._answer["present"]
        return found

    @property
    def where(self) -> list[dict[str, Any]]:
        """The regions of conditions in which the data depart from the plain sim."""
        found: list[dict[str, Any]] = self._answer["where"]
        return found

    @property
    def parameters(self) -> dict[str, Any]:
        """The parameters of the verdict's effects and the inputs: ``unit``, ``estimate``,
        ``standard_uncertainty`` and ``interval`` by ``EFFECT/PARAMETER`` or input."""
        effects = None if self.verdict["kind"] == "unexplained" else self.verdict["effects"]
        for hypothesis in self._answer["hypotheses"]:
            if hypothesis["effects"] == effects:
                found: dict[str, Any] = hypothesis["parameters"]
                return found
        return {}

    @property
    def shrinks(self) -> dict[str, Any]:
        """How far the gap shrinks once the verdict's effects are added, on rows that were left out."""
        found: dict[str, Any] = self._answer["shrinks"]
        return found

    @property
    def next_measurement(self) -> list[dict[str, Any]]:
        """What to measure next."""
        found: list[dict[str, Any]] = self._answer["next_measurement"]
        return found

    @property
    def notes(self) -> list[str]:
        """What is to be said beside the answer."""
        return [*self._case.notes, *self._rust.notes]

    @property
    def runs(self) -> Any:
        """All runs as a ``pandas.DataFrame``: a column for each parameter, and ``failed`` with the reason
        where a run has no outputs."""
        import pandas

        parameters, results = self._rust.runs()
        frame = pandas.DataFrame(parameters, columns=self._case.parameters)
        frame["failed"] = [result if isinstance(result, str) else None for result in results]
        return frame

    @property
    def more_runs(self) -> Any:
        """The parameters of runs that would tell more than those that were made before, as a
        ``pandas.DataFrame``; none where `diagnose` made all that it asked for."""
        import pandas

        return pandas.DataFrame(self._rust.more(), columns=self._case.parameters)

    def predict(
        self,
        conditions: Any,
        *,
        runs: int | None = None,
        executor: Any = None,
    ) -> Any:
        """The corrected simulator at other conditions, with its uncertainty.

        The simulator is run there at draws of what the data say of its parameters; the answer is averaged
        over all hypotheses by their probabilities. All rows belong to one run, since history lives in the
        rows.

        Parameters
        ----------
        conditions : DataFrame or mapping
            The conditions of the case as columns, in their units.
        runs : int, optional
            About so many runs of the simulator; default 40.
        executor : optional
            As in `diagnose`.

        Returns
        -------
        DataFrame or dict
            For each output its values, and its standard uncertainties as ``u(OUTPUT)``, in its unit: a
            DataFrame of the library of `conditions`, or a dictionary of arrays.
        """
        if self._simulate is None:
            raise ValueError(
                "runs that were made before predict nothing at other conditions: that takes a simulator"
            )
        found = columns(conditions)
        named = {name: numbers(column) for name, column in found.items()}
        missing = [name for name in self._case.conditions if name not in named]
        if missing:
            raise ValueError(f"the conditions have no column {', '.join(missing)}")
        table = csv({name: named[name] for name in self._case.conditions})
        if runs is not None:
            _check_whole("runs", runs, 1, 1_000_000)
        at = self._simulate.on(executor)
        values, notes = self._rust.predict(at.at, table, runs, at.folder, at.name)
        for note in notes:
            warnings.warn(note, stacklevel=2)
        predicted: dict[str, npt.NDArray[np.float64]] = {}
        for name, (value, u) in values.items():
            predicted[name] = value
            predicted[f"u({name})"] = u
        return _as_given(conditions, predicted)

    def to(self, format: str) -> bytes:  # noqa: A002 - the name that the command line has
        """The answer in a format of ``gumption gap``: ``"html"``, ``"table"``, ``"markdown"``, ``"json"``
        or ``"csv"``.

        Parameters
        ----------
        format : str
            The name of the format.
        """
        return self._rust.to(format)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the answer in the format given by the extension: ``.html``, ``.md``, ``.txt``, ``.json`` or
        ``.csv``.

        Parameters
        ----------
        path : path-like
            The file.
        """
        answer = self.to(format_of(path))
        with open(path, "wb") as file:
            file.write(answer)

    def to_dict(self) -> dict[str, Any]:
        """The answer of ``gumption gap --format json``."""
        found: dict[str, Any] = json.loads(self._rust.json())
        return found

    def plot(self, *, ax: Any = None) -> Any:
        """Draw what the data depart by from the plain and from the corrected sim, over the rows or the
        only condition, and the probabilities of the effects.

        Parameters
        ----------
        ax : array of matplotlib.axes.Axes, optional
            Where to draw: one for each output, and one for the effects. A new figure has them unless
            given.

        Returns
        -------
        matplotlib.figure.Figure
            The figure of the axes.

        Raises
        ------
        ValueError
            If the number of axes is another one.
        """
        from gumption._plot import plot_gap

        return plot_gap(self._answer, ax)

    def page(self) -> Page:
        """The whole page with its figures, which a notebook shows in a frame."""
        return Page(self.to("html").decode())

    def _repr_html_(self) -> str:
        return _notebook.light_page(self.to("html").decode())

    def __str__(self) -> str:
        return self.to("table").decode()

    def __repr__(self) -> str:
        effects = " + ".join(self.verdict["effects"] or []) or self.verdict["kind"]
        return f"<gumption.Diagnosis: {effects}, probability {self.probability:.3f}>"


def _as_given(conditions: Any, table: dict[str, npt.NDArray[np.float64]]) -> Any:
    """A table in the library of another."""
    root = type(conditions).__module__.partition(".")[0]
    if root == "pandas":
        import pandas

        return pandas.DataFrame(table, index=conditions.index)
    if root == "polars":
        import polars

        return polars.DataFrame(table)
    return table


def diagnose(
    simulator: Callable[..., Any] | Runs,
    data: Any,
    *,
    conditions: Mapping[str, str],
    outputs: Mapping[str, str],
    uncertainties: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    effects: Mapping[str, Any] | None = None,
    catalogue: str | Sequence[str] | None = None,
    prior: Mapping[str, float] | None = None,
    runs: int = 300,
    noisy: bool = False,
    executor: Any = None,
    resume: str | os.PathLike[str] | None = None,
    seed: int | None = None,
    progress: bool | Callable[[float], object] = False,
    title: str | None = None,
) -> Diagnosis:
    """Diagnose where measured data depart from a simulator, and which effect is missing.

    Parameters
    ----------
    simulator : callable or Runs
        ``simulator(conditions, **parameters)`` gives a mapping from every output to an array with a value for
        each row. ``conditions`` maps names to arrays of all rows in their order. It gets all inputs and all
        parameters of its effects, always, in their units. Or `runs` that were made before.
    data : DataFrame or mapping
        The measured values: the conditions and the outputs as columns, in their units.
    conditions, outputs : mapping of str to str
        Their units. The outputs are in these units in the data and in the simulator's answers.
    uncertainties : mapping, optional
        The standard uncertainty of an output's values: a number, a column of the data by name, an array, or a
        specification such as ``"0.1 % of reading"``. Where it is left out the noise is estimated.
    inputs : mapping, optional
        What is known of the simulated system, such as ``normal(0.5, 0.001, "m")``.
    effects : mapping, optional
        What the plain sim leaves out: a mapping of parameters of the simulator (absent at 0), or an `effect`.
    catalogue : str or sequence of str, optional
        Effects that ship with gumption; "all" for those that fit.
    prior : mapping, optional
        Probabilities of ``none``, ``one``, ``two`` effects and ``unexplained``.
    runs : int, default 300
        The simulator is run so many times at most.
    noisy : bool, default False
        Whether answers to the same parameters scatter.
    executor : concurrent.futures.Executor, distributed.Client or the module ray, optional
        Makes the runs.
    resume : path-like, optional
        A folder in which each run is kept as soon as it ends, and from which those that are there are taken.
    seed : int, optional
        Seed of the random numbers.
    progress : bool or callable, default False
        Tell the share that is done: on standard error, or to a function.
    title : str, optional
        The title of the page.

    Raises
    ------
    ModelError
        A case that cannot be diagnosed: a name, a unit, a distribution.
    OSError
        No run of the plain simulator succeeded; runs that cannot be kept.

    Examples
    --------
    >>> import numpy as np
    >>> import gumption as gu
    >>> t = np.linspace(0, 10, 40)
    >>> def cooling(conditions, rate, gain):
    ...     return {"T": 50 * (1 + gain) * np.exp(-rate * conditions["t"])}
    >>> noise = np.random.default_rng(1).normal(0, 0.1, len(t))
    >>> data = {"t": t, "T": cooling({"t": t}, 0.2, 0.03)["T"] + noise}
    >>> found = gu.diagnose(cooling, data, conditions={"t": "min"}, outputs={"T": "K"},
    ...     uncertainties={"T": 0.1}, inputs={"rate": gu.normal(0.2, 0.001, "1/min")},
    ...     effects={"gain-error": {"gain": gu.normal(0, 0.05, "1")}}, runs=60, seed=1)
    >>> found.verdict["effects"]
    ['gain-error']
    """
    _check_whole("runs", runs, 1, 1_000_000)
    if seed is not None:
        _check_whole("seed", seed, 0, 2**64 - 1)
    table = {name: numbers(column) for name, column in columns(data).items()}
    case, held = _case(table, conditions, outputs, uncertainties, inputs, effects)
    if catalogue is not None:
        case["catalogue"] = catalogue if isinstance(catalogue, str) else list(catalogue)
    if prior is not None:
        case["prior"] = dict(prior)
    if title is not None:
        case["title"] = title
    if noisy:
        case["simulator"]["noisy"] = True
    text = json.dumps(case, ensure_ascii=False, allow_nan=False)
    read = _gumption.SimulatedGap(text, held)
    if isinstance(simulator, Runs):
        if executor is not None or resume is not None:
            raise ValueError("runs that were made before take no `executor` and no `resume`")
        made = simulator.arrays(read.parameters, read.outputs)
        with _bar(progress) as told:
            found = read.diagnose_made(*made, seed, told)
        return Diagnosis(found, read, None)
    if not callable(simulator):
        kind = type(simulator).__name__
        raise TypeError(f"the simulator is a {kind}, but must be a function or gumption.runs(...)")
    simulate = Simulate(simulator, read.parameters, read.outputs, resume).on(executor)
    at, folder = simulate.at(read.conditions), simulate.folder
    with _bar(progress) as told:
        found = read.diagnose(at, runs, seed, folder, simulate.name, progress=told)
    return Diagnosis(found, read, simulate)


def _check_whole(name: str, value: Any, least: int, most: int) -> None:
    """Checks an argument that is a whole number."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise ValueError(f"`{name}` is {value!r}, but must be a whole number from {least} to {most}")


def _case(
    table: dict[str, npt.NDArray[np.float64]],
    conditions: Mapping[str, str],
    outputs: Mapping[str, str],
    uncertainties: Mapping[str, Any] | None,
    inputs: Mapping[str, Any] | None,
    effects: Mapping[str, Any] | None,
) -> tuple[dict[str, Any], list[tuple[str, bytes]]]:
    """The case as a file has it, and the files that it names."""
    held: list[tuple[str, bytes]] = []
    lengths = {name: len(column) for name, column in table.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"the columns of the data have different lengths: {lengths}")
    for name in [*conditions, *outputs]:
        if name not in table:
            raise ValueError(f"the data have no column {name!r}; they have {', '.join(table)}")
    wanted = {name: table[name] for name in [*conditions, *outputs]}
    observed: dict[str, Any] = {name: {"value": name} for name in outputs}
    for name, u in (uncertainties or {}).items():
        if name not in outputs:
            raise ValueError(f"`uncertainties` names {name!r}, which is none of the outputs")
        if isinstance(u, str) and u not in table:
            observed[name]["standard_uncertainty"] = u
            continue
        values = table[u] if isinstance(u, str) else np.asarray(u, dtype=np.float64)
        if values.ndim == 0:
            observed[name]["standard_uncertainty"] = float(values)
            continue
        if values.shape != table[name].shape:
            raise ValueError(
                f"the uncertainties of {name!r} have the shape {values.shape}, the data {table[name].shape}"
            )
        column = f"u_{name}"
        while column in wanted:
            column += "_"
        wanted[column] = values
        observed[name]["standard_uncertainty"] = column
    known = {str(name): as_input(value, f"`{name}`") for name, value in (inputs or {}).items()}
    listed = {str(name): as_effect(value, str(name)) for name, value in (effects or {}).items()}
    for given in [*known.values(), *(i for of in listed.values() for i in of.parameters.values())]:
        held += given.held
    held.append((DATA, csv(wanted)))
    case: dict[str, Any] = {
        "format": 1,
        "inputs": {name: given.to_dict() for name, given in known.items()},
        "conditions": {name: {"unit": unit} for name, unit in conditions.items()},
        "simulator": {"outputs": dict(outputs)},
        "outputs": {name: {"unit": unit} for name, unit in outputs.items()},
        "observations": {"file": DATA, "columns": observed},
        "effects": {name: effect.to_dict() for name, effect in listed.items()},
    }
    return case, held


@contextmanager
def _bar(
    progress: bool | Callable[[float], object],
) -> Iterator[Callable[[int], object] | None]:
    """What is called with the thousandths that are done."""
    if progress is False:
        yield None
    elif callable(progress):
        tell = progress
        yield lambda done: tell(done / 1000)
    else:
        from tqdm.auto import tqdm

        with tqdm(total=100, unit="%") as bar:
            yield lambda done: bar.update(done / 10 - bar.n)
