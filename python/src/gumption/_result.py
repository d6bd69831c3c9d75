"""The result of a run."""

from __future__ import annotations

import hashlib
import json
import os
import uuid
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._frames import table_of
from gumption._labels import Axes, Labels, is_count
from gumption._notebook import Page
from gumption._quantity import Quantity
from gumption._samples import Samples, SampleTable
from gumption._shapes import Input
from gumption._tables import Table

if TYPE_CHECKING:
    from typing_extensions import TypeVar as TypeVarWithDefault

    from gumption._model import Model

    #: A figure: a number, with conditions an array of one for each row, or either where the type of the
    #: model says neither.
    Figure_co = TypeVarWithDefault("Figure_co", default=Any, covariant=True)
else:
    Figure_co = TypeVar("Figure_co", covariant=True)

#: The columns of a table that are in the unit of the output.
QUANTITIES = [
    "gum_estimate", "gum_standard_uncertainty", "expanded_uncertainty", "gum_low", "gum_high", "mc_estimate",
    "mc_standard_uncertainty", "mc_median", "mc_symmetric_low", "mc_symmetric_high", "mc_shortest_low",
    "mc_shortest_high",
]  # fmt: skip

#: Formats of pages and answers, by the extensions of files.
FORMATS = {
    ".json": "json", ".csv": "csv", ".txt": "table", ".md": "markdown", ".tex": "latex",
    ".html": "html", ".htm": "html", ".xlsx": "xlsx", ".xml": "dcc",
}  # fmt: skip


def format_of(path: str | os.PathLike[str]) -> str:
    """The format for the extension of a file."""
    extension = os.path.splitext(os.fspath(path))[1].lower()
    if extension not in FORMATS:
        known = ", ".join(FORMATS)
        raise _gumption.ModelError(f"`{os.fspath(path)}`: the extension is none of {known}")
    return FORMATS[extension]


class _Figures(Generic[Figure_co]):
    """Results for one output by one method."""

    _method = ""

    def __init__(self, output: Output[Figure_co]) -> None:
        self._output = output

    def _figure(self, name: str) -> Figure_co:
        return self._output._column(f"{self._method}.{name}")

    def _pair(self, low: str, high: str) -> npt.NDArray[np.float64]:
        return np.stack([np.asarray(self._figure(low)), np.asarray(self._figure(high))], axis=-1)

    def __repr__(self) -> str:
        names = [name for name, of in vars(type(self)).items() if isinstance(of, property)]
        lines = [f"{name}: {getattr(self, name)}" for name in names]
        return "\n".join(lines)


class Gum(_Figures[Figure_co]):
    """One output by the law of propagation (JCGM 100).

    With conditions every value is an array with one entry per row. Undefined values are NaN.
    """

    _method = "gum"

    @property
    def estimate(self) -> Figure_co:
        """Estimate y."""
        return self._figure("estimate")

    @property
    def standard_uncertainty(self) -> Figure_co:
        """Combined standard uncertainty u(y)."""
        return self._figure("standard_uncertainty")

    @property
    def dof(self) -> Figure_co:
        """Effective degrees of freedom; infinite if those of every contribution are."""
        return self._figure("dof")

    @property
    def coverage_factor(self) -> Figure_co:
        """Coverage factor k."""
        return self._figure("coverage_factor")

    @property
    def expanded_uncertainty(self) -> Figure_co:
        """Expanded uncertainty U = k u(y)."""
        return self._figure("expanded_uncertainty")

    @property
    def interval(self) -> npt.NDArray[np.float64]:
        """The interval y - U to y + U, along the last axis."""
        return self._pair("low", "high")


class MonteCarlo(_Figures[Figure_co]):
    """One output by the Monte Carlo method (JCGM 101).

    With conditions every value is an array with one entry per row. Undefined values are NaN.
    """

    _method = "monte_carlo"

    @property
    def trials(self) -> Figure_co:
        """Number of trials."""
        return self._figure("trials")

    @property
    def estimate(self) -> Figure_co:
        """Mean of the trials."""
        return self._figure("estimate")

    @property
    def standard_uncertainty(self) -> Figure_co:
        """Standard deviation of the trials."""
        return self._figure("standard_uncertainty")

    @property
    def median(self) -> Figure_co:
        """Median of the trials."""
        return self._figure("median")

    @property
    def symmetric_interval(self) -> npt.NDArray[np.float64]:
        """Probabilistically symmetric coverage interval, along the last axis."""
        return self._pair("symmetric_low", "symmetric_high")

    @property
    def shortest_interval(self) -> npt.NDArray[np.float64]:
        """Shortest coverage interval, along the last axis."""
        return self._pair("shortest_low", "shortest_high")

    @property
    def skewness(self) -> Figure_co:
        """Skewness of the trials."""
        return self._figure("skewness")

    @property
    def excess_kurtosis(self) -> Figure_co:
        """Excess kurtosis of the trials."""
        return self._figure("excess_kurtosis")


class Budget(Mapping[str, Any]):
    """The budget of one output: columns by name, one entry a line.

    The lines are the inputs, then correlation coefficients, ``r(a, b)``, which have only a share.
    Columns are ``input``, ``unit``, ``estimate``, ``standard_uncertainty``, ``distribution``, ``type``,
    ``group``, ``dof``, ``sensitivity``, ``contribution`` and ``share``; they are attributes as well.
    """

    def __init__(self, columns: Mapping[str, Any], shown: str | Callable[[], str] = "") -> None:
        self._columns = dict(columns)
        # the table of the page, which is made when it is wanted
        self._shown = shown

    def _table(self) -> str:
        if not isinstance(self._shown, str):
            self._shown = self._shown()
        return self._shown

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._columns:
            return self._columns[name]
        raise AttributeError(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_pandas(self) -> Any:
        """The budget as a ``pandas.DataFrame`` with the inputs as its index."""
        import pandas

        return pandas.DataFrame(self._columns).set_index("input")

    def latex(self) -> str:
        """The budget as an array of LaTeX, rounded as on the pages."""
        return _notebook.latex_table(self._table())

    def _repr_html_(self) -> str:
        return _notebook.whole([_notebook.light(self._table())])

    def _repr_latex_(self) -> str:
        return self.latex()

    def __reduce__(self) -> Any:
        return Budget, (self._columns, self._table())

    def __repr__(self) -> str:
        shown = ("input", "estimate", "standard_uncertainty", "sensitivity", "contribution", "share")
        rows = [list(shown)]
        for line in zip(*(self._columns[name] for name in shown)):
            rows.append([f"{cell:.6g}" if isinstance(cell, float) else str(cell) for cell in line])
        widths = [max(map(len, column)) for column in zip(*rows)]
        return "\n".join("  ".join(c.rjust(w) for c, w in zip(row, widths)) for row in rows)


class Output(Quantity, Generic[Figure_co]):
    """One output of a result.

    It can be an input of another model, with its distribution and with its correlations with other
    outputs of the same result and with other results.
    """

    def __init__(self, result: Result[Figure_co], name: str) -> None:
        super().__init__(name)
        self._result = result
        self.name = name
        self.unit = dict(result._run.outputs)[name]

    @property
    def _unit(self) -> str:
        return self.unit

    def _evaluated(self) -> Output[Figure_co]:
        return self

    def _figure(self, name: str) -> Any:
        return getattr(self.gum, name)

    def __reduce__(self) -> Any:
        return Output, (self._result, self.name)

    def _column(self, name: str) -> Figure_co:
        column: npt.NDArray[np.float64] = self._result._run.column(self.name, name)
        return cast("Figure_co", column if self._result._run.swept else float(column[0]))

    @property
    def gum(self) -> Gum[Figure_co]:
        """By the law of propagation."""
        return Gum(self)

    @property
    def monte_carlo(self) -> MonteCarlo[Figure_co]:
        """By the Monte Carlo method."""
        return MonteCarlo(self)

    @property
    def budget(self) -> Budget:
        """The budget; with conditions, for the first row, and `budget_at` has the others."""
        return self.budget_at(0)

    def budget_at(self, row: int) -> Budget:
        """The budget in a row of conditions, counted from 0.

        Parameters
        ----------
        row : int
            The row, counted from 0.
        """
        columns = self._result._run.budget(self.name, row)
        if columns is None:
            raise _gumption.ModelError(
                f"`{self.name}` has no budget: a sensitivity coefficient is not finite"
            )
        return Budget(columns, lambda: self._page_parts(row)[2])

    def _page_parts(self, row: int = 0) -> tuple[str, str, str, str, str]:
        """Title, result, budget, conclusions and comparison of the methods, as on the page."""
        place = list(self._result).index(self.name)
        return self._result._run.page_parts(row)[place]

    @property
    def gum_valid(self) -> bool | None | npt.NDArray[np.float64]:
        """Whether the GUM interval is validated (JCGM 101, clause 8); `None` if undecided.

        With conditions an array of 1, 0 and NaN.
        """
        found: Any = self._column("validation.gum_valid")
        if isinstance(found, float):
            return None if np.isnan(found) else bool(found)
        return np.asarray(found)

    @property
    def conformance_probability(self) -> Figure_co:
        """The probability of conformance to the output's tolerance; NaN without a tolerance."""
        return self._column("conformity.probability")

    def samples(self, row: int = 0) -> Samples:
        """The trials in a row of conditions.

        Parameters
        ----------
        row : int, default 0
            The row of conditions, counted from 0.
        """
        found = self._result.samples(self.name, row)
        assert isinstance(found, Samples)
        return found

    def to_dict(self) -> dict[str, Any]:
        """The output as in the JSON answer; with conditions, for the first row."""
        answer = self._result.to_dict()
        found = answer["rows"][0] if "rows" in answer else answer
        output = found["outputs"][self.name]
        assert isinstance(output, dict)
        return output

    def latex(self, row: int = 0) -> str:
        """The estimate with its standard uncertainty in the mathematical mode of LaTeX.

        Parameters
        ----------
        row : int, default 0
            The row of conditions, counted from 0.
        """
        x, u = (
            float(np.atleast_1d(np.asarray(figure))[row])
            for figure in (self.gum.estimate, self.gum.standard_uncertainty)
        )
        return _notebook.latex_value(self.name, self.unit, x, u)

    def _sweep(self) -> str:
        """A table of the rows of conditions."""
        units = dict(self._result._run.conditions)
        before = {f"{name} in {units[name]}": values for name, values in self._result.conditions.items()}
        figures: Any = self.gum
        return _notebook.title(f"{self.name} in {self.unit}") + _notebook.estimates(
            before, figures.estimate, figures.standard_uncertainty, figures.expanded_uncertainty
        )

    def _repr_html_(self) -> str:
        if self._result._run.swept:
            return _notebook.whole([self._sweep()])
        name, *parts = self._page_parts()
        return _notebook.whole([_notebook.title(name), *map(_notebook.light, parts)])

    def _repr_latex_(self) -> str | None:
        # an array of estimates is no value
        return None if self._result._run.swept else f"$${self.latex()}$$"

    def _as_input(self) -> Input:
        text = self._result.saved()
        # results of different runs are told apart, and outputs of one run belong together
        name = f"{hashlib.sha256(text.encode()).hexdigest()[:16]}.result.json"
        spec = {"distribution": "result", "file": name, "output": self.name}
        return Input(spec, self.unit, [(name, text.encode())])

    def __repr__(self) -> str:
        if self._result._run.swept:
            return f"<gumption.Output {self.name} in {self.unit}: {self._result.rows} rows>"
        return f"<gumption.Output {self.name} = {self}>"


class Result(Table, Mapping[str, Output[Figure_co]]):
    """The result of a run: a mapping from the names of outputs to `Output` objects.

    A result is pickled as its model, seed and settings, and recomputed when it is needed, with the
    same bits.
    """

    def __init__(
        self,
        model: Model[Figure_co],
        options: Mapping[str, Any],
        run: _gumption.Run | None = None,
        identity: str | None = None,
    ) -> None:
        self.model = model
        #: What tells it from the results of other runs.
        self.identity = identity if identity is not None else uuid.uuid4().hex
        self._options = dict(options)
        self._done = run
        self._answer: dict[str, Any] | None = None
        self._saved: str | None = None

    @property
    def _run(self) -> _gumption.Run:
        if self._done is None:
            self._done = self.model._evaluated(self._options)
        return self._done

    def __getitem__(self, name: str) -> Output[Figure_co]:
        names = [output for output, _ in self._run.outputs]
        if name not in names:
            raise KeyError(f"there is no output {name!r}; there are {', '.join(names)}")
        return Output(self, name)

    def __getattr__(self, name: str) -> Output:
        # an output by its name, where nothing else has it
        if not name.startswith("_") and name in dict(self._run.outputs):
            return self[name]
        raise AttributeError(f"the result has no attribute and no output {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self if name.isidentifier())]

    def __iter__(self) -> Iterator[str]:
        return iter(name for name, _ in self._run.outputs)

    def __len__(self) -> int:
        return len(self._run.outputs)

    @property
    def rows(self) -> int:
        """The number of rows of conditions; 1 where nothing is swept."""
        return self._run.rows

    @property
    def conditions(self) -> dict[str, npt.NDArray[np.float64]]:
        """The conditions, one entry a row; empty where nothing is swept."""
        if not self._run.swept:
            return {}
        values = self._run.condition_rows()
        return {name: values[:, i] for i, (name, _) in enumerate(self._run.conditions)}

    @property
    def seed(self) -> int:
        """The seed of the random streams."""
        return self._run.seed

    @property
    def has_trials(self) -> bool:
        """Whether trials were made, and not the law of propagation alone."""
        first, _ = self._run.outputs[0]
        return bool(np.isfinite(self._run.column(first, "monte_carlo.trials")).any())

    @property
    def coverage_probability(self) -> float:
        """The coverage probability."""
        return self._run.coverage_probability

    @property
    def warnings(self) -> list[dict[str, str]]:
        """Notes and warnings, each with ``code``, ``where`` and ``text``."""
        return [{"code": c, "where": w, "text": t} for c, w, t in self._run.warnings]

    def correlations(self, row: int = 0) -> npt.NDArray[np.float64]:
        """The correlation matrix of the outputs in a row of conditions.

        Parameters
        ----------
        row : int, default 0
            The row of conditions, counted from 0.
        """
        count = len(self)
        matrix = np.eye(count)
        matrix[np.triu_indices(count, 1)] = self._run.correlations(row)
        return np.triu(matrix) + np.triu(matrix, 1).T

    def to_json(self) -> str:
        """The answer of ``gumption run --format json``, byte for byte."""
        return bytes(self._run.formatted("json")).decode()

    def to_dict(self) -> dict[str, Any]:
        """The answer of ``gumption run --format json`` as a dictionary."""
        if self._answer is None:
            self._answer = json.loads(self.to_json())
        assert self._answer is not None
        return self._answer

    def _columns(self) -> dict[str, Any]:
        return table_of(self.to("csv").decode())

    def _labels(self) -> Labels | None:
        labels = self.model._labels
        if labels is None or is_count(labels.index()):
            return None
        return Labels(labels.index().repeat(len(self)))

    def _units(self) -> dict[str, str]:
        units = {unit for _, unit in self._run.outputs}
        own = {name: units.copy().pop() for name in QUANTITIES if len(units) == 1}
        return {**own, **dict(self._run.conditions)}

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of one line for each output and row, as ``--format csv`` has them.

        Its index is that of the table of conditions, if this had one of its own or arrays of ``xarray``,
        or else the conditions; and the outputs.
        """
        frame = super().to_pandas()
        if self._labels() is not None:
            return frame.set_index("output", append=True)
        return frame.set_index([*(name for name, _ in self._run.conditions if self._run.swept), "output"])

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` with the dimensions and coordinates of the conditions, and ``output``.

        Units are in ``attrs["units"]`` of the conditions, and of the results if all outputs have one
        unit; the coordinate ``unit`` has those of the outputs.
        """
        columns, outputs = self._columns(), list(self)
        labels = self.model._labels if self._run.swept else None
        axes = Axes(("row",), (self.rows,), {}) if self._run.swept else Axes((), (), {})
        dimensions, shape, coordinates, attributes, kept = axes if labels is None else labels.axes()
        units = self._units()
        of_outputs = {name: columns.pop(name)[: len(outputs)] for name in ("unit", "equation")}
        own = {"output": outputs, **{name: ("output", texts) for name, texts in of_outputs.items()}}
        variables = {}
        for name, column in columns.items():
            values, about = np.asarray(column), dict(kept.get(name, {}))
            if name in units and "units" not in about:
                about["units"] = units[name]
            if name in dict(self._run.conditions):
                values, dims = values[:: len(outputs)].reshape(shape), dimensions
            else:
                values, dims = values.reshape(*shape, len(outputs)), (*dimensions, "output")
            if name not in (*coordinates, *own):
                variables[name] = (dims, values, about)
        import xarray

        return xarray.Dataset(variables, coordinates, attributes).assign_coords(own)

    def samples(self, name: str | None = None, row: int = 0) -> Any:
        """The trials, recomputed with the bits of the run.

        Parameters
        ----------
        name : str, optional
            An output; all of them unless given.
        row : int, default 0
            The row of conditions.

        Returns
        -------
        Samples or SampleTable
            For one output an array; for all of them a mapping of arrays. Both speak Arrow.
        """
        names = list(self) if name is None else [self[name].name]
        columns = [Samples.of(values) for values in self._run.samples(names, row)]
        return columns[0] if name is not None else SampleTable(dict(zip(names, columns)))

    def saved(self) -> str:
        """The result file of the run, as ``gumption run --save`` writes it."""
        if self._saved is None:
            self._saved = self._run.saved()
        return self._saved

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result file, which inputs of other models can use.

        Parameters
        ----------
        path : path-like
            The file.
        """
        _write(path, self.saved().encode())

    def to(self, format: str) -> bytes:  # noqa: A002 - the name that the command line has
        """The answer in a format of the command line.

        Parameters
        ----------
        format : {"table", "json", "csv", "markdown", "latex", "html", "xlsx"}
            The format.
        """
        if format == "xlsx" and self.model._function is not None:
            self.model._refuse_function("xlsx")
        return bytes(self._run.formatted(format))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a page or an answer in the format for the extension.

        Extensions are ``.html``, ``.xlsx``, ``.md``, ``.tex``, ``.txt``, ``.json`` and ``.csv``, and
        ``.npy`` for the trials.

        Parameters
        ----------
        path : path-like
            The file.
        """
        if os.fspath(path).lower().endswith(".npy"):
            _write(path, bytes(self._run.trials_file("npy")))
        else:
            _write(path, self.to(format_of(path)))

    def plot(
        self, outputs: str | list[str] | None = None, *, row: int | None = None, ax: Any = None
    ) -> Any:
        """Draw the distributions with the coverage intervals of both methods, or with conditions the
        estimates with their expanded uncertainties.

        Parameters
        ----------
        outputs : str or list of str, optional
            The outputs; all by default.
        row : int, optional
            With conditions, the row whose distributions are drawn.
        ax : matplotlib.axes.Axes or array of these, optional
            Where to draw: one for each output. A new figure has them unless given.

        Returns
        -------
        matplotlib.figure.Figure
            The figure of the axes.

        Raises
        ------
        ValueError
            If the number of axes is another than that of the outputs.
        """
        from gumption._plot import plot

        names = [outputs] if isinstance(outputs, str) else outputs
        return plot(self, names if names is not None else list(self), row, ax)

    def page(self) -> Page:
        """The whole page with its figures, which a notebook shows in a frame."""
        return Page(self.to("html").decode())

    def _repr_html_(self) -> str:
        run = self._run
        rest = "`page()` shows all, with its figures"
        if run.swept:
            return _notebook.whole([output._sweep() for output in self.values()], rest)
        parts = run.page_parts(0)
        shown = [[_notebook.title(name) + _notebook.light(said)] for name, said, *_ in parts]
        budgets = [_notebook.light(budget) for _, _, budget, *_ in parts]
        # of many outputs the results alone
        if sum(map(len, budgets)) + sum(len(own[0]) for own in shown) <= _notebook.MOST:
            shown = [[*own, budget] for own, budget in zip(shown, budgets)]
        return _notebook.whole([part for own in shown for part in own], rest)

    def __str__(self) -> str:
        return self.to("table").decode()

    def __repr__(self) -> str:
        if self._done is None:
            return f"<gumption.Result of {self.model!r}, not computed yet>"
        shown = "\n".join(f"  {output!r}" for output in list(self.values())[:20])
        return f"<gumption.Result {self.model.title!r}\n{shown}>"

    # two results are one if they are the same object; a mapping would compare its entries
    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return id(self)

    def __reduce__(self) -> Any:
        return Result, (self.model, {**self._options, "seed": self.seed}, None, self.identity)


def _write(path: str | os.PathLike[str], content: bytes) -> None:
    """Writes a file completely or not at all."""
    import tempfile

    folder = os.path.dirname(os.path.abspath(os.fspath(path)))
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=".gumption-")
    try:
        with os.fdopen(handle, "wb") as out:
            out.write(content)
        # as if it had been opened by its name
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
