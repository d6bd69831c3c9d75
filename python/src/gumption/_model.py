"""Models: files, dictionaries and traced functions, ready to be evaluated."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np
import numpy.typing as npt

from gumption import _gumption, _notebook
from gumption._conditions import condition_file
from gumption._frames import readings_file
from gumption._joint import Joint, identity_of, listed
from gumption._quantity import Expression, formulas
from gumption._quantities import as_input, as_known, shared, unit_of
from gumption._result import Figure_co, Result
from gumption._shapes import Input

if TYPE_CHECKING:
    from gumption._block import BlockFunction
    from gumption._check import Held
    from gumption._labels import Labels


class Model(Generic[Figure_co]):
    """A measurement model with its inputs; it is immutable.

    `load`, `from_dict`, `from_json` and `Measurement` make models. They pickle. To type checkers
    ``Model[float]`` is a model without conditions, whose figures are numbers, and
    ``Model[NDArray[float64]]`` one with conditions, whose figures are arrays.
    """

    _rust: _gumption.Model
    #: What computes the outputs in place of formulas.
    _function: BlockFunction | None
    #: The distributions of the inputs, if no file stated them.
    _known: Mapping[str, Any] | None
    #: The function that the formulas are of, as it was when the model was made.
    _held: Held | None
    #: The labels of the rows of conditions, if their table had any.
    _labels: Labels | None

    def __init__(self) -> None:
        raise TypeError("models are made by gumption.load, from_dict, from_json or model")

    @classmethod
    def _of(
        cls,
        rust: _gumption.Model,
        function: BlockFunction | None = None,
        known: Mapping[str, Any] | None = None,
        held: Held | None = None,
        labels: Labels | None = None,
    ) -> Model[Any]:
        made = object.__new__(cls)
        made._rust, made._function, made._known, made._held = rust, function, known, held
        made._labels = labels
        return made

    @property
    def title(self) -> str:
        """The title."""
        return self._rust.title

    @property
    def inputs(self) -> dict[str, str]:
        """Names and units of the inputs."""
        return dict(self._rust.inputs)

    @property
    def outputs(self) -> dict[str, str]:
        """Names and units of the outputs."""
        return dict(self._rust.outputs)

    @property
    def conditions(self) -> dict[str, str]:
        """Names and units of the conditions."""
        return dict(self._rust.conditions)

    @property
    def rows(self) -> int:
        """The number of rows of conditions; 1 where nothing is swept."""
        return self._rust.rows

    @property
    def warnings(self) -> list[dict[str, str]]:
        """Notes on the file, each with ``code``, ``where`` and ``text``."""
        return [{"code": c, "where": w, "text": t} for c, w, t in self._rust.warnings]

    @property
    def text(self) -> str:
        """The model file."""
        return self._rust.source[1]

    def to_dict(self) -> dict[str, Any]:
        """The model file as a dictionary."""
        found = json.loads(self.text)
        assert isinstance(found, dict)
        return found

    def run(
        self,
        trials: int | float | str | None = None,
        seed: int | None = None,
        *,
        readings: Any = None,
        coverage: float | None = None,
        k: float | None = None,
        digits: int | None = None,
        real_dof: bool = False,
        statement: str | None = None,
        validate: bool = False,
        rule: str | None = None,
        method: str | None = None,
        max_trials: int | None = None,
        threads: int | None = None,
        memory: int | None = None,
        progress: bool | Callable[[int], object] = False,
        executor: Any = None,
        parts: int | None = None,
        resume: str | os.PathLike[str] | None = None,
        to_save: bool = False,
    ) -> Result[Figure_co]:
        """Evaluate by the law of propagation (JCGM 100) and by Monte Carlo (JCGM 101).

        Other Python threads continue meanwhile, and Ctrl-C ends the run at once. Settings that are
        not given are those of the model file. The result has the same bits on any number of threads,
        and those of ``gumption run``.

        Parameters
        ----------
        trials : int or "adaptive", optional
            Number of trials; 0 for only the law of propagation, ``"adaptive"`` for as many as the
            digits need (JCGM 101, 7.9).
        seed : int, optional
            Seed of the random streams.
        readings : path-like, DataFrame or mapping, optional
            Readings that replace those of the model, as for ``--readings``: columns by the names of
            inputs, ``"V"`` in the input's unit or ``"V [mV]"``, and a row for each reading. A column with
            the name of a condition says to which point a row belongs. Sequences of a mapping may have
            different lengths.
        coverage : float, optional
            Coverage probability.
        k : float, optional
            Coverage factor for infinite degrees of freedom instead of `coverage`.
        digits : int, optional
            Number of significant digits of the standard uncertainty that are regarded as meaningful
            (clause 8).
        real_dof : bool, default False
            Take the coverage factor at the real number of effective degrees of freedom.
        statement : {"auto", "gum", "monte-carlo"}, optional
            Method that gives the stated value and U: the law of propagation, the interval of the
            trials, or the law of propagation where the trials agree apart from few degrees of
            freedom.
        validate : bool, default False
            Make as many trials as the validation of the GUM interval needs (JCGM 101, 8.2).
        rule : {"7.9", "stein"}, optional
            When an adaptive run stops.
        method : {"auto", "monte-carlo", "exact", "quasi"}, optional
            Method for additional results without the noise of trials.
        max_trials : int, optional
            Largest number of trials of an adaptive run.
        threads : int, optional
            Number of threads; all of the machine's unless given.
        memory : int, optional
            Bytes for kept values of trials; 64 MiB unless given.
        progress : bool or callable, default False
            Show a bar of ``tqdm``, or call this from time to time with the number of completed trials.
        executor : concurrent.futures.Executor, distributed.Client or the module ray, optional
            Distributes the run: a process pool, loky's reusable executor, a Dask client, or the module
            `ray` for the cluster it is connected to. The workers make ranges of blocks of trials, on
            one thread each unless `threads` is given, which are merged here in any order; rows of
            conditions are distributed likewise. The result has the same bits as on this machine, and
            a part lost with its worker is repeated.
        parts : int, optional
            With `executor`, the number of parts of each pass over the trials; the default is 64, or
            8 for each worker, or enough that no part is longer than 134 million trials.
        resume : path-like, optional
            With `executor`, a folder in which the parts are kept: a stopped run continues from
            these parts. ``gumption run --resume`` and ``gumption merge`` accept it as well.
        to_save : bool, default False
            With `executor`, let the workers also compute the quantiles for `Result.save` and for
            inputs of other models, which takes another pass if the trials do not fit into `memory`;
            otherwise this machine computes them on demand.

        Returns
        -------
        Result

        Raises
        ------
        ModelError
            If the model cannot be evaluated, with its place in the file.
        KeyboardInterrupt
            Within 0.2 s of Ctrl-C.
        """
        options = {
            "trials": trials, "seed": seed, "coverage": coverage, "k": k, "digits": digits,
            "real_dof": real_dof or None, "statement": statement,
            "validate": validate or None, "rule": rule, "method": method, "max_trials": max_trials,
            "threads": threads, "memory": memory,
        }  # fmt: skip
        given = {name: value for name, value in options.items() if value is not None}
        model = self if readings is None else self._with_readings(readings)
        if executor is None:
            if parts is not None or resume is not None or to_save:
                raise _gumption.ModelError(
                    "`parts`, `resume` and `to_save` are about runs that an executor shares; give "
                    "`executor`"
                )
            return Result(model, given, model._evaluated(given, progress))
        if parts is not None and parts < 1:
            raise _gumption.ModelError(f"`parts={parts}`: a whole number from 1 is needed")
        from gumption._executors import run_on

        with model._bar(given, progress) as told:
            run = run_on(
                model, given, executor,
                parts=parts, resume=resume, with_quantiles=to_save, told=told,
            )  # fmt: skip
        return Result(model, given, run)

    def _with_readings(self, readings: Any) -> Model[Figure_co]:
        """The model with readings that replace its own."""
        self._refuse_function("readings")
        return self._derived(_gumption.Model(*self._rust.source[:7], readings_file(readings)), self._known)

    def _parts(self, options: dict[str, Any]) -> _gumption.Parts:
        """The run in parts."""
        return self._rust.parts(options, self._columns())

    def _columns(self) -> Callable[[list[Any]], list[Any]] | None:
        """The function over columns of a model that is not traced, checked to be unchanged."""
        if self._held is not None:
            self._held.check_unchanged()
        return None if self._function is None else self._function.of(self._rust)

    @contextmanager
    def _bar(
        self, options: Mapping[str, Any], progress: bool | Callable[[int], object]
    ) -> Iterator[Callable[[int], object] | None]:
        """The progress callback."""
        if progress is False:
            yield None
        elif callable(progress):
            yield progress
        else:
            from tqdm.auto import tqdm

            trials = options.get("trials")
            total = int(trials) * self.rows if isinstance(trials, (int, float)) and trials else None
            with tqdm(total=total, unit="trials", unit_scale=True) as bar:
                yield lambda done: bar.update(done - bar.n)

    def _evaluated(
        self, options: dict[str, Any], progress: bool | Callable[[int], object] = False
    ) -> _gumption.Run:
        """The run on this machine's threads."""
        with self._bar(options, progress) as told:
            return self._rust.run(options, told, self._columns())

    def set(self, *replacements: str, **values: Any) -> Model[Figure_co]:
        """The model with replaced estimates or fields of inputs, as for ``--set``.

        Limits move along with an estimate, and widths follow their specification.

        Parameters
        ----------
        *replacements : str
            ``"NAME=35 deg"`` or ``"NAME.half_width=0.2"``.
        **values
            An estimate for an input, in its unit or as a text with one. Two underscores replace the
            point before a field: ``tilt__half_width=0.2``.
        """
        self._refuse_function("set")
        named = [f"{name.replace('__', '.')}={value}" for name, value in values.items()]
        name, text, folder, held, allow, replaced, accept, readings = self._rust.source
        all_ = [*replaced, *replacements, *named]
        made = _gumption.Model(name, text, folder, held, allow, all_, accept, readings)
        return self._derived(made, self._known)

    def with_inputs(
        self,
        inputs: Mapping[str, Any] | None = None,
        *,
        correlations: Sequence[tuple[str, str, float]] | None = None,
        **named: Any,
    ) -> Model[Figure_co]:
        """The model with some inputs replaced.

        Parameters
        ----------
        inputs : mapping, optional
            The new inputs by name, in the forms that `Measurement` accepts.
        correlations : sequence of (str, str, float), optional
            Correlation coefficients instead of those of the model.
        **named
            The same as `inputs`.
        """
        self._refuse_function("with_inputs")
        units = self.inputs
        given = {**(inputs or {}), **named}
        for name in given:
            if name not in units:
                raise _gumption.ModelError(
                    f"the model has no input `{name}`; it has {', '.join(units)}"
                )
        file = self.to_dict()
        given = {name: as_known(value, name) for name, value in given.items()}
        if correlations is not None:
            file["correlations"] = [list(link) for link in correlations]
        kept = {name: value for name, value in (self._known or {}).items() if name not in given}
        held, known = take_inputs(file, given, units, kept)
        return self._with(file, {**dict(self._rust.source[3]), **held}, known)

    def with_conditions(
        self, table: Any, units: Mapping[str, str] | None = None
    ) -> Model[npt.NDArray[np.float64]]:
        """The model in every row of a table of conditions.

        Parameters
        ----------
        table : DataFrame, Dataset or mapping
            A column for each condition of the model. Arrays of ``xarray`` are broadcast by their
            dimensions.
        units : mapping of str to str, optional
            Units of the columns; by default those of the model's conditions, or those stored with
            the columns.
        """
        self._refuse_function("with_conditions")
        own = {**self.conditions, **(units or {})}
        if not own:
            raise _gumption.ModelError("the model has no conditions")
        file, held = self.to_dict(), dict(self._rust.source[3])
        file["conditions"], tables, labels = condition_file(table, own)
        held.update(tables)
        made = self._with(file, held, self._known)
        made._labels = labels
        return made

    def _with(
        self, file: Mapping[str, Any], held: Mapping[str, bytes], known: Mapping[str, Any] | None
    ) -> Model[Any]:
        name, _, folder, _, allow, replaced, accept, readings = self._rust.source
        text = written(file)
        files = list(held.items())
        made = _gumption.Model(_made(name), text, folder, files, allow, replaced, accept, readings)
        return self._derived(made, known)

    def _derived(self, rust: _gumption.Model, known: Mapping[str, Any] | None) -> Model[Any]:
        """A model with the same formulas, checked against their function."""
        held = self._held.of(rust) if self._held is not None else None
        return Model._of(rust, known=known, held=held, labels=self._labels)

    def _refuse_function(self, what: str) -> None:
        if self._function is not None:
            raise _gumption.ModelError(
                f"`{what}` needs a model of formulas, but the function of `{self.title}` could not be "
                "traced, or not rightly; call the function with other inputs"
            )

    def _equations(self) -> dict[str, str]:
        """The formulas; none of a typed model and of a function that is not traced."""
        found: dict[str, str] = {} if self._function is not None else self.to_dict().get("equations", {})
        return found

    def latex(self) -> str:
        """The equations in LaTeX.

        Raises
        ------
        ModelError
            If the model has no equations.
        """
        if not (equations := self._equations()):
            raise _gumption.ModelError(f"`{self.title}` has no equations")
        return _notebook.latex_equations(equations)

    def _repr_latex_(self) -> str | None:
        return self.latex() if self._equations() else None

    def _repr_html_(self) -> str:
        file = self.to_dict()
        shown = [_notebook.title(self.title)]
        if equations := self._equations():
            shown.append(_notebook.equations(equations))
        elif self._function is not None:
            shown.append("<div>computed by a Python function</div>")
        shown.append(_notebook.inputs(file.get("inputs", {})))
        shown.append(_notebook.table(["output", "unit"], self.outputs.items()))
        if self.conditions:
            shown.append(_notebook.table(["condition", "unit"], self.conditions.items()))
            shown.append(f"<div>{self.rows} rows of conditions</div>")
        return _notebook.whole(shown)

    def __repr__(self) -> str:
        inputs, outputs = ", ".join(self.inputs), ", ".join(self.outputs)
        return f"<gumption.Model {self.title!r}: {outputs} of {inputs}>"

    def __reduce__(self) -> Any:
        # formulas were held against their function when they were made, and need it no more
        held = self._held if self._function is not None else None
        return _model_from, (self._rust.source, self._function, self._known, held, self._labels)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return self._rust.source == other._rust.source and self._function is other._function

    def __hash__(self) -> int:
        return hash(self._rust.source[1])


def _model_from(
    source: tuple[Any, ...],
    function: BlockFunction | None,
    known: Mapping[str, Any] | None,
    held: Held | None,
    labels: Labels | None,
) -> Model:
    return Model._of(_gumption.Model(*source), function, known, held, labels)


def take_inputs(
    file: dict[str, Any],
    given: Mapping[str, Any],
    units: Mapping[str, str],
    kept: Mapping[str, Any],
    terms: Iterable[str] = (),
) -> tuple[dict[str, bytes], dict[str, Any]]:
    """Writes inputs into a model file.

    Results that share quantities with other inputs are inserted as the formulas of their models.

    Parameters
    ----------
    file : dict
        The file, whose ``inputs``, ``equations`` and ``correlations`` are added to.
    given, units : mapping
        Some of its inputs, and the units of inputs without a unit.
    kept : mapping
        Its other inputs.
    terms : iterable of str
        Which of `given` stand in expressions.

    Returns
    -------
    dict of str to bytes, dict of str to object
        The files that the inputs name, and all inputs.
    """
    held: dict[str, bytes] = {}
    given, units, inserted = _insert_expressions(file, given, units)
    taken = [name for key in ("inputs", "equations", "outputs", "conditions") for name in file.get(key, ())]
    check_units = file.get("check_units", True)
    joint = Joint.of({**kept, **given}, units, taken, check_units, [*terms, *inserted])
    known = {**kept, **given}
    links = list(file.get("correlations", []))
    if joint is not None:
        for name in joint.expanded:
            file["inputs"].pop(name, None)
            del known[name]
        file["inputs"].update(joint.inputs)
        file["equations"] = {**joint.equations, **file.get("equations", {})}
        held.update(joint.held)
        links += joint.links
        known.update(joint.known)
    first: dict[object, str] = {}
    for name, value in list(known.items()):
        twin = first.setdefault(identity_of(value), name)
        if twin == name:
            continue
        known[twin] = joined(known[twin], value)
        # one object for two inputs is one quantity
        if unit_of(value) is None and units.get(twin) != units.get(name):
            raise _gumption.ModelError(
                f"one quantity is given for `{twin}` and for `{name}`, which are in different units, and "
                "has no unit of its own; give it one"
            )
        file["inputs"].pop(name, None)
        file["equations"] = {name: twin, **file.get("equations", {})}
        del known[name]
    for name, value in given.items():
        if name in known:
            found = as_input(value, name)
            file["inputs"][name] = found.to_dict(units[name])
            held.update(found.held)
    # of what was there before the file tells already
    links += [link for link in shared(known) if not {*link[:2]} <= kept.keys()]
    if links:
        # what a model of a result says already is not said again
        once = {(*sorted(link[:2]), link[2]): list(link) for link in links}
        file["correlations"] = list(once.values())
    return held, known


def joined(first: Any, second: Any) -> Any:
    """One quantity that is given by two objects."""
    return first.linked_as(second) if isinstance(first, Input) and isinstance(second, Input) else first


def _insert_expressions(
    file: dict[str, Any], given: Mapping[str, Any], units: Mapping[str, str]
) -> tuple[Mapping[str, Any], Mapping[str, str], Iterable[str]]:
    """Writes inputs that are expressions as formulas; gives all inputs, their units, and the names of those
    that stand in expressions."""
    expressions = {name: value for name, value in given.items() if isinstance(value, Expression)}
    if not expressions:
        return given, units, ()
    if not file.get("check_units", True):
        raise _gumption.ModelError(
            f"{listed(expressions)}: an expression computes in coherent units, and the model with the numbers of its declared "
            "units; give an output of the expression's run"
        )
    taken = [name for key in ("inputs", "equations", "outputs", "conditions") for name in file.get(key, ())]
    equations, leaves = formulas(expressions, taken)
    for name in expressions:
        del file["inputs"][name]
    file["inputs"].update(dict.fromkeys(leaves))
    file["equations"] = {**equations, **file.get("equations", {})}
    own = {name: value for name, value in given.items() if name not in expressions}
    return {**own, **leaves}, {**units, **dict.fromkeys(leaves, "1")}, leaves


#: Made once, as making one takes longer than the text of a quantity.
_ENCODER = json.JSONEncoder(ensure_ascii=False, allow_nan=False)


def written(file: Mapping[str, Any]) -> str:
    """The text of a model file, of a line for each quantity."""

    text = _ENCODER.encode

    def member(key: str, value: Any) -> str:
        if not isinstance(value, Mapping) or not value:
            return f" {text(key)}: {text(value)}"
        lines = ",\n".join(f"  {text(name)}: {text(own)}" for name, own in value.items())
        return f" {text(key)}: {{\n{lines}\n }}"

    return "{\n" + ",\n".join(member(key, value) for key, value in file.items()) + "\n}"


def _made(name: str) -> str:
    """The name of a text that is made here, and has no places that anybody knows."""
    if name == "<json>":
        return "<dict>"
    return name if name.startswith("<") else f"<dict {name}>"


def load(
    path: str | os.PathLike[str],
    *,
    model: str | None = None,
    set: Mapping[str, Any] | Sequence[str] = (),  # noqa: A002 - the name that the command line has
    allow_path: Sequence[str | os.PathLike[str]] = (),
    accept_changed: bool = False,
) -> Model[Any]:
    """Read a model file, or the model that another file carries.

    A workbook of a run (``--format xlsx``) contains its model file, and a Digital Calibration
    Certificate of gumption contains those of its results; later changes of cells or values are
    ignored. For any other certificate (2.4 to 3.3) every stated value becomes an input and an
    output.

    Parameters
    ----------
    path : path-like
        The file. Its folder contains the files that it names.
    model : str, optional
        Which one of several models that a certificate carries.
    set : mapping or sequence of str, optional
        Replaced estimates or fields of inputs, as for ``--set``: ``{"tilt": "36 deg"}`` or
        ``["tilt.half_width=0.2"]``.
    allow_path : sequence of path-like, optional
        Other folders in which the file may name files.
    accept_changed : bool, default False
        Accept saved results that were changed after they were written.

    Returns
    -------
    Model

    Raises
    ------
    ModelError
        With all errors of the file and their positions.
    """
    items = [f"{name}={value}" for name, value in set.items()] if isinstance(set, Mapping) else set
    allowed = [os.fspath(folder) for folder in allow_path]
    if _carries(path):
        name, text, held = _carried(os.fspath(path), model)
        folder = os.path.dirname(os.fspath(path))
        of = (f"{os.fspath(path)} ({name})", text, folder, held)
        return Model._of(_gumption.Model(*of, allowed, list(items), accept_changed))
    if model is not None:
        raise _gumption.ModelError("`model` is about a certificate that carries several")
    return Model._of(_gumption.Model.load(os.fspath(path), allowed, list(items), accept_changed))


def _carries(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a workbook or XML."""
    try:
        with open(path, "rb") as file:
            start = file.read(64)
    except OSError:
        return False
    return start.startswith(b"PK") or start.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<")


def _carried(path: str, wanted: str | None) -> tuple[str, str, list[tuple[str, bytes]]]:
    """The model that a file carries."""
    found = _gumption.carried_models(path)
    if wanted is None and len(found) == 1:
        return found[0]
    for one in found:
        if wanted in (one[0], os.path.splitext(os.path.basename(one[0]))[0]):
            return one
    names = listed(name for name, _, _ in found)
    raise _gumption.ModelError(f"{path}: it carries {names}; say which with `model=`")


def from_json(text: str, *, name: str = "<json>", folder: str | os.PathLike[str] = "") -> Model[Any]:
    """Read the text of a model file.

    Parameters
    ----------
    text : str
        The text.
    name : str, optional
        Its name in messages.
    folder : path-like, optional
        The folder of the files that it names; default is the current folder.
    """
    return Model._of(_gumption.Model(name, text, os.fspath(folder)))


@overload
def from_dict(
    file: Mapping[str, Any],
    *,
    name: str = ...,
    folder: str | os.PathLike[str] = ...,
    conditions: None = None,
) -> Model[Any]: ...


@overload
def from_dict(
    file: Mapping[str, Any],
    *,
    name: str = ...,
    folder: str | os.PathLike[str] = ...,
    conditions: Any,
) -> Model[npt.NDArray[np.float64]]: ...


def from_dict(
    file: Mapping[str, Any],
    *,
    name: str = "<dict>",
    folder: str | os.PathLike[str] = "",
    conditions: Any = None,
) -> Model[Any]:
    """Make a model from a dictionary with the keys of a model file.

    Inputs may be whatever `Measurement` takes: `Input` objects, outputs of results, numbers of
    other libraries. ``format`` may be left out.

    Parameters
    ----------
    file : mapping
        The keys of a model file.
    name : str, optional
        Its name in messages.
    folder : path-like, optional
        The folder of the files that it names; default is the current folder.
    conditions : DataFrame or mapping, optional
        The rows of the conditions; ``file["conditions"]`` then has their units only, as
        ``{"f": "Hz"}`` or ``{"f": {"unit": "Hz"}}``.
    """
    made: dict[str, Any] = {"format": 1, **file}
    held: dict[str, bytes] = {}
    known: dict[str, Any] | None = None
    inputs = made.get("inputs")
    if isinstance(inputs, Mapping):
        # what the file says itself stays as it is
        stated = {key: value for key, value in inputs.items() if isinstance(value, (Mapping, str))}
        own = {key: as_input(value, key) for key, value in stated.items() if isinstance(value, Mapping)}
        given = {key: as_known(v, key) for key, v in inputs.items() if key not in stated}
        made["inputs"] = {key: stated.get(key) for key in inputs}
        held, known = take_inputs(made, given, dict.fromkeys(inputs, "1"), own)
    labels = None
    if conditions is not None:
        asked = made.get("conditions", {})
        units = {n: of if isinstance(of, str) else of.get("unit", "1") for n, of in asked.items()}
        made["conditions"], tables, labels = condition_file(conditions, units)
        held.update(tables)
    rust = _gumption.Model(_made(name), written(made), os.fspath(folder), list(held.items()))
    return Model._of(rust, known=known, labels=labels)
