"""The other commands as functions: they return the answers of the command line."""

from __future__ import annotations

import io
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any

from gumption import _gumption, _notebook
from gumption._keywords import called
from gumption._notebook import Page
from gumption._result import format_of

#: Options without a value.
_FLAGS = ("fail", "rounding")


def call(*arguments: str | os.PathLike[str]) -> bytes:
    """Run the command line as a function and return its standard output.

    Parameters
    ----------
    *arguments : str or path-like
        The arguments after ``gumption``.

    Raises
    ------
    ModelError
        With the message of exit code 2.
    """
    return _gumption.call([os.fspath(argument) for argument in arguments])[0]


class Answer(dict[str, Any]):
    """The JSON answer of a command as a dictionary, with access to its other formats.

    Attributes
    ----------
    notes : list of str
        The command's messages on standard error.
    yes : bool
        Whether the result is "yes" for commands with ``--fail``.
    """

    def __init__(
        self,
        arguments: Sequence[str],
        model: _gumption.Model | None = None,
        text: str | None = None,
        held: Sequence[tuple[str, bytes]] = (),
    ) -> None:
        self._asked = (list(arguments), model, text)
        self._held = tuple(held)
        answer, notes, self.yes = self._call(["--format", "json"])
        self.notes = [line.removeprefix("note: ") for line in notes.splitlines()]
        super().__init__(json.loads(answer))

    def _call(self, more: Sequence[str]) -> tuple[bytes, str, bool]:
        arguments, model, text = self._asked
        return called([*arguments, *more], model, text, self._held)

    def to(self, format: str) -> bytes:  # noqa: A002 - the name that the command line has
        """The answer in another format of the command, such as ``"table"`` or ``"html"``.

        Parameters
        ----------
        format : str
            The name of the format.
        """
        return self._call(["--format", format, "--quiet"])[0]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the answer in the format given by the extension.

        ``.html``, ``.md``, ``.tex``, ``.xlsx``, ``.txt``, ``.json``, ``.csv`` and for certificates
        ``.xml`` (the Digital Calibration Certificate), if the command has the format.

        Parameters
        ----------
        path : path-like
            The file.
        """
        self._call(["--format", format_of(path), "--output", os.fspath(path), "--quiet"])

    def to_pandas(self) -> Any:
        """The answer of ``--format csv`` as a ``pandas.DataFrame``."""
        from gumption._frames import frame_of

        return frame_of(self.to("csv").decode())

    def page(self) -> Page:
        """The whole page with its figures, which a notebook shows in a frame.

        Raises
        ------
        ModelError
            If the command has no page.
        """
        return Page(self.to("html").decode())

    def _repr_html_(self) -> str:
        try:
            page = self.to("html").decode()
        except _gumption.ModelError:
            # a command without a page
            return _notebook.text(str(self))
        return _notebook.light_page(page)

    def __str__(self) -> str:
        return self.to("table").decode()

    def __reduce__(self) -> Any:
        arguments, model, text = self._asked
        source = None if model is None else model.source
        return _asked_again, (arguments, source, text, self._held)


def _asked_again(
    arguments: Sequence[str], source: Any, text: str | None, held: Sequence[tuple[str, bytes]]
) -> Answer:
    return Answer(arguments, None if source is None else _gumption.Model(*source), text, held)


class _Together(Answer):
    """An answer from parts that workers made."""

    def __init__(
        self,
        arguments: Sequence[str],
        text: str,
        held: Sequence[tuple[str, bytes]],
        parts: Sequence[bytes],
    ) -> None:
        self._made = (list(arguments), text, list(held), list(parts))
        self._folder = tempfile.TemporaryDirectory()
        for number, part in enumerate(parts):
            with open(os.path.join(self._folder.name, f"{number:06}"), "wb") as file:
                file.write(part)
        super().__init__([*arguments, "--parts", self._folder.name], None, text)

    def _call(self, more: Sequence[str]) -> tuple[bytes, str, bool]:
        arguments, model, text = self._asked
        return called([*arguments, *more], model, text, self._made[2])

    def __reduce__(self) -> Any:
        return _Together, self._made


class Certificate(Answer):
    """A calibration certificate; `Answer.save` writes it, as ``.xml`` a DCC."""


def _options(**options: Any) -> list[str]:
    """Options of the command line by the arguments of a function; `None` is left out."""
    found: list[str] = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is None:
            continue
        if name in _FLAGS:
            found += [option] if value else []
        else:
            # in one argument, as a value may begin with a minus sign
            values = value if isinstance(value, (list, tuple)) else [value]
            found += [f"{option}={os.fspath(v) if isinstance(v, os.PathLike) else v}" for v in values]
    return found


def _given(file: Any) -> tuple[str, str | None]:
    """A path, or ``-`` with its text."""
    if isinstance(file, Mapping):
        return "-", json.dumps(file, ensure_ascii=False, allow_nan=False)
    return os.fspath(file), None


def gap(
    case: str | os.PathLike[str] | Mapping[str, Any],
    *,
    predict: str | os.PathLike[str] | None = None,
    seed: int | None = None,
    threads: int | None = None,
    allow_path: Sequence[str | os.PathLike[str]] = (),
) -> Answer:
    """Diagnose where measured data depart from a model, and which effect is missing.

    Parameters
    ----------
    case : path-like or mapping
        The case: a model file with observations and candidate effects, or its content. The current
        folder contains the files that the content names.
    predict : path-like, optional
        A table of conditions at which to compute the corrected prediction as well.
    seed, threads, allow_path : optional
        As on the command line.
    """
    options = _options(predict=predict, seed=seed, threads=threads, allow_path=allow_path)
    path, text = _given(case)
    return Answer(["gap", path, *options], None, text)


def gap_check(
    case: str | os.PathLike[str] | Mapping[str, Any],
    draws: int | None = None,
    *,
    seed: int | None = None,
    threads: int | None = None,
    keep: str | os.PathLike[str] | None = None,
    executor: Any = None,
) -> Answer:
    """Test the diagnosis on simulated data of a case (blind).

    Parameters
    ----------
    case : path-like or mapping
        The case, a file or its content; its data are not used.
    draws : int, optional
        Number of truths to draw.
    seed, threads, keep : optional
        As on the command line.
    executor : concurrent.futures.Executor, distributed.Client or the module ray, optional
        Distributes the draws; the answer has the same bytes as on this machine.
    """
    options = _options(draws=draws, seed=seed, threads=threads, keep=keep)
    path, text = _given(case)
    if executor is not None:
        if keep is not None:
            raise _gumption.ModelError("`keep` and `executor` exclude each other")
        from gumption._executors import drawn_on

        text, held = _gumption.case_source(path, text)
        shared = _options(draws=draws, seed=seed)
        count = 200 if draws is None else draws
        parts = drawn_on(text, held, shared, count, threads or 1, executor)
        return _Together(["gap-check", "-", *options], text, held, parts)
    return Answer(["gap-check", path, *options], None, text)


def observe(
    recipe: str | os.PathLike[str] | Mapping[str, Any],
    recordings: Mapping[str, Any] | None = None,
    *,
    seed: int | None = None,
) -> Answer:
    """Determine amplitudes, phases and delays from raw recordings, or correct transient signals.

    Parameters
    ----------
    recipe : path-like or mapping
        The recipe, a file or its content.
    recordings : mapping of str to array, DataFrame or mapping, optional
        By the names of the recipe's recordings, values in place of their files; the recipe then is a mapping. Columns
        of an array are named by their numbers, from 1 on; those of a table by their names.
    seed : int, optional
        Seed of the random streams.

    Returns
    -------
    Answer
        For corrected signals ``answer["rows"][0]["waveforms"]["channel"]`` has ``values``,
        ``standard_uncertainties`` and ``quantities``; ``answer.to_pandas()`` is the table of the samples.

    Raises
    ------
    ModelError
        Where recipe or recordings are wrong.
    """
    options = _options(seed=seed)
    if recordings is None:
        path, text = _given(recipe)
        return Answer(["observe", path, *options], None, text)
    if not isinstance(recipe, Mapping):
        raise _gumption.ModelError("`recordings` has the values of recordings; give the recipe as a mapping, too")
    own = recipe.get("recordings")
    own = dict(own) if isinstance(own, Mapping) else {}
    held: list[tuple[str, bytes]] = []
    for name, values in recordings.items():
        if not isinstance(own.get(name), Mapping):
            known = ", ".join(f"`{other}`" for other in own) or "none"
            raise _gumption.ModelError(f"`recordings` names `{name}`; the recordings of the recipe are {known}")
        file, content = _recording(str(name), values)
        own[name] = {**own[name], "file": file}
        held.append((file, content))
    text = json.dumps({**recipe, "recordings": own})
    return Answer(["observe", "-", *options], None, text, held)


def _recording(name: str, values: Any) -> tuple[str, bytes]:
    """The name and the content of a file with the values of a recording."""
    import numpy as np

    from gumption._frames import columns, csv

    if isinstance(values, Mapping) or hasattr(values, "columns"):
        table = {key: np.asarray(column, dtype=np.float64) for key, column in columns(values).items()}
        lengths = {key: len(column) for key, column in table.items()}
        if len(set(lengths.values())) > 1:
            raise _gumption.ModelError(f"the columns of the recording `{name}` have different lengths: {lengths}")
        return f"{name}.csv", csv(table)
    array = np.asarray(values, dtype=np.float64)
    if array.ndim not in (1, 2):
        raise _gumption.ModelError(
            f"the recording `{name}` has the shape {array.shape}; it needs one or two dimensions (samples, channels)"
        )
    content = io.BytesIO()
    np.save(content, array)
    return f"{name}.npy", content.getvalue()


def compare(
    table: Any,
    *,
    against: str | os.PathLike[str] | None = None,
    correlations: str | os.PathLike[str] | None = None,
    rounding: bool = False,
    scheme: str | None = None,
    assigned: float | str | None = None,
    assigned_u: float | str | None = None,
    sigma: float | str | None = None,
) -> Answer:
    """Compare results in pairs (normalized errors) or of many laboratories, or score a proficiency test.

    Parameters
    ----------
    table : path-like or DataFrame or mapping
        Columns ``label, x1, U1, x2, U2`` and optionally ``k1, k2, r``; for laboratories ``label, x,
        U`` and optionally ``k``; for a proficiency test ``label, x`` and optionally ``U, k``. A file
        (CSV, XLSX), or the columns themselves.
    against : path-like, optional
        Take the second results from the JSON answer of a run.
    correlations : path-like, optional
        Correlation coefficients between laboratories.
    rounding : bool, default False
        Show the range of the normalized error that the printed digits allow.
    scheme : "iso13528", optional
        Score the results as those of a proficiency test by ISO 13528.
    assigned : "algorithm-a" or "median" or float or str, optional
        The assigned value; a number is in the unit of the results, a text such as ``"10.5 mg"`` has its
        own.
    assigned_u : float or str, optional
        The standard uncertainty of a stated assigned value.
    sigma : "algorithm-a" or "niqr" or float or str, optional
        The standard deviation for proficiency assessment; ``"5 %"`` is a percentage of the assigned value.

    Returns
    -------
    Answer
        Its `Answer.yes` says whether all are compatible, or no participant has an action signal.
    """
    text = None
    if isinstance(table, (str, os.PathLike)):
        path = os.fspath(table)
    else:
        path, text = "-", _comparison(table)
    options = _options(against=against, correlations=correlations, rounding=rounding, fail=True)
    options += _options(scheme=scheme, assigned=assigned, assigned_u=assigned_u, sigma=sigma)
    return Answer(["compare", path, *options], None, text)


def _comparison(table: Any) -> str:
    import csv

    from gumption._frames import columns

    found = columns(table)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(found)
    cells = [column.tolist() if hasattr(column, "tolist") else list(column) for column in found.values()]
    writer.writerows(zip(*cells))
    return out.getvalue()


def assumptions(
    model: Any,
    *,
    allow: float | None = None,
    trials: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    coverage: float | None = None,
    k: float | None = None,
) -> Answer:
    """Test the Type B assumptions: which ones matter, and which ones the readings contradict.

    Parameters
    ----------
    model : path-like, Model or mapping
        The model, a file or an object.
    allow : float, optional
        Allowed relative change of the expanded uncertainty; default 0.05.
    trials, seed, threads, coverage, k : optional
        As on the command line.
    """
    from gumption._model import Model, from_dict

    options = _options(
        allow=allow, trials=trials, seed=seed, threads=threads, coverage=coverage, k=k
    )
    if isinstance(model, Mapping):
        model = from_dict(model)
    if isinstance(model, Model):
        model._refuse_function("assumptions")
        if model._rust.source[7] is not None:
            raise _gumption.ModelError(
                "`assumptions` takes the readings of the model file, but this model has others; write them "
                "into the file"
            )
        replaced = [part for text in model._rust.source[5] for part in ("--set", text)]
        return Answer(["assumptions", "-", *options, *replaced], model._rust)
    return Answer(["assumptions", os.fspath(model), *options])


def certificate(
    file: str | os.PathLike[str] | Mapping[str, Any],
    *,
    readings: str | os.PathLike[str] | None = None,
    statement: str | None = None,
    trials: int | str | None = None,
    seed: int | None = None,
    coverage: float | None = None,
    k: float | None = None,
    threads: int | None = None,
    allow_path: Sequence[str | os.PathLike[str]] = (),
) -> Certificate:
    """Make a calibration certificate.

    Parameters
    ----------
    file : path-like or mapping
        The certificate file, or its content.
    readings : path-like, optional
        A file of readings that replace those of its model files.
    statement : {"auto", "gum", "monte-carlo"}, optional
        Which method gives the stated values and U.
    trials, seed, coverage, k, threads, allow_path : optional
        As on the command line.

    Examples
    --------
    ``gumption.certificate("certificate.json").save("certificate.xml")`` writes a DCC.
    """
    path, text = _given(file)
    options = _options(
        readings=readings, statement=statement, trials=trials, seed=seed, coverage=coverage, k=k,
        threads=threads, allow_path=allow_path,
    )  # fmt: skip
    return Certificate(["certificate", path, *options], None, text)


def diff(a: str | os.PathLike[str], b: str | os.PathLike[str]) -> Answer:
    """Show what changed between two model files or saved results, and how it changed U.

    Parameters
    ----------
    a, b : path-like
        The two files, the earlier one first.
    """
    return Answer(["diff", os.fspath(a), os.fspath(b)])


def verify() -> Answer:
    """Recompute the published examples on this machine (ISO/IEC 17025, 7.11)."""
    return Answer(["verify"])


def check(file: str | os.PathLike[str] | Mapping[str, Any]) -> Answer:
    """List all errors of a file, or of its content: ``{"ok": ..., "errors": [...]}``.

    Parameters
    ----------
    file : path-like or mapping
        The file, or its content.
    """
    path, text = _given(file)
    return Answer(["check", path], None, text)
