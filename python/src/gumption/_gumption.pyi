"""The extension module: what is made in Rust."""

import os
from collections.abc import Callable, Iterable
from typing import Any, final

import numpy as np
import numpy.typing as npt

__all__ = [
    "Model",
    "ModelError",
    "Parts",
    "Run",
    "SimulatedGap",
    "SimulatorGap",
    "__version__",
    "arrow_array",
    "arrow_stream",
    "budgets",
    "call",
    "carried_models",
    "case_source",
    "equation_html",
    "equation_latex",
    "input_keys",
    "convert",
    "in_rows",
    "main",
    "unit_of_differences",
    "unit_product",
    "printed",
    "unit_scale",
    "unit_within",
    "units_fit",
]

__version__: str

_Source = tuple[
    str, str, str, list[tuple[str, bytes]], list[str], list[str], bool, tuple[str, bytes] | None
]

class ModelError(ValueError):
    """A mistake in a model, another file or an argument.

    The text is what the command line says on standard error, with the place in the file; about a model
    that Python made it names the argument.

    Attributes
    ----------
    errors : list of dict
        Every mistake with the keys ``file``, ``line``, ``column``, ``code``, ``message`` and
        ``suggestion``, as ``gumption check --format json`` lists them, and ``argument``, the argument
        of Python with the keys in it, such as ``mass.std``; `None` for a place in a file. Empty where
        an option of a command is at fault.
    """

    errors: list[dict[str, Any]]

@final
class SimulatedGap:
    def __new__(cls, text: str, held: list[tuple[str, bytes]]) -> SimulatedGap: ...
    @property
    def parameters(self) -> list[str]: ...
    @property
    def outputs(self) -> list[str]: ...
    @property
    def conditions(self) -> dict[str, npt.NDArray[np.float64]]: ...
    @property
    def notes(self) -> list[str]: ...
    def diagnose(
        self,
        simulate: Callable[[npt.NDArray[np.float64]], Iterable[tuple[int, Any]]],
        runs: int,
        seed: int | None = None,
        folder: str | None = None,
        name: str = "",
        progress: Callable[[int], object] | None = None,
    ) -> SimulatorGap: ...
    def diagnose_made(
        self,
        parameters: npt.NDArray[np.float64],
        outputs: npt.NDArray[np.float64],
        seed: int | None = None,
        progress: Callable[[int], object] | None = None,
    ) -> SimulatorGap: ...

@final
class SimulatorGap:
    @property
    def notes(self) -> list[str]: ...
    def json(self) -> str: ...
    def to(self, format: str) -> bytes: ...
    def more(self) -> npt.NDArray[np.float64]: ...
    def runs(self) -> tuple[npt.NDArray[np.float64], list[Any]]: ...
    def predict(
        self,
        simulate: Callable[[dict[str, npt.NDArray[np.float64]]], Any],
        table: bytes,
        runs: int | None = None,
        folder: str | None = None,
        name: str = "",
    ) -> tuple[dict[str, tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]], list[str]]: ...

@final
class Model:
    def __new__(
        cls,
        name: str,
        text: str,
        folder: str = "",
        held: list[tuple[str, bytes]] = ...,
        allow: list[str] = ...,
        replaced: list[str] = ...,
        accept_changed: bool = False,
        readings: tuple[str, bytes] | None = None,
    ) -> Model: ...
    @staticmethod
    def load(
        path: str | os.PathLike[str],
        allow: list[str] = ...,
        replaced: list[str] = ...,
        accept_changed: bool = False,
    ) -> Model: ...
    @property
    def source(self) -> _Source: ...
    @property
    def title(self) -> str: ...
    @property
    def inputs(self) -> list[tuple[str, str]]: ...
    @property
    def outputs(self) -> list[tuple[str, str]]: ...
    @property
    def conditions(self) -> list[tuple[str, str]]: ...
    @property
    def rows(self) -> int: ...
    @property
    def variables(self) -> list[str]: ...
    @property
    def warnings(self) -> list[tuple[str, str, str]]: ...
    def draws(
        self, count: int
    ) -> tuple[list[npt.NDArray[np.float64]], list[npt.NDArray[np.float64]]]: ...
    def run(
        self,
        options: dict[str, Any],
        progress: Callable[[int], object] | None = None,
        function: Callable[[list[npt.NDArray[np.float64]]], list[Any]] | None = None,
    ) -> Run: ...
    def parts(
        self,
        options: dict[str, Any],
        function: Callable[[list[npt.NDArray[np.float64]]], list[Any]] | None = None,
    ) -> Parts: ...

@final
class Parts:
    @property
    def blocks(self) -> int: ...
    @property
    def trials_of_block(self) -> float: ...
    def first(self) -> bytes: ...
    def part(self, current: bytes, start: int, end: int) -> bytes: ...
    def merge(
        self, current: bytes, parts: Iterable[bytes], with_quantiles: bool
    ) -> Run | bytes: ...
    def kept(self, folder: str) -> tuple[bytes, list[tuple[str, int, int]]]: ...
    def keep(self, folder: str, part: bytes) -> None: ...
    def go_on(self, folder: str, following: bytes) -> None: ...

@final
class Run:
    def formatted(self, format: str) -> bytes: ...
    def saved(self) -> str: ...
    def samples(self, outputs: list[str], row: int) -> list[npt.NDArray[np.float64]]: ...
    def histograms(
        self, row: int
    ) -> list[tuple[float, float, npt.NDArray[np.uint64]] | None]: ...
    def column(self, output: str, name: str) -> npt.NDArray[np.float64]: ...
    def condition_rows(self) -> npt.NDArray[np.float64]: ...
    def page_parts(self, row: int) -> list[tuple[str, str, str, str, str]]: ...
    def budget(self, output: str, row: int) -> dict[str, Any] | None: ...
    def correlations(self, row: int) -> list[float]: ...
    def trials_file(self, form: str) -> bytes: ...
    @property
    def warnings(self) -> list[tuple[str, str, str]]: ...
    @property
    def swept(self) -> bool: ...
    @property
    def rows(self) -> int: ...
    @property
    def coverage_probability(self) -> float: ...
    @property
    def seed(self) -> int: ...
    @property
    def outputs(self) -> list[tuple[str, str]]: ...
    @property
    def conditions(self) -> list[tuple[str, str]]: ...

def arrow_array(values: npt.NDArray[np.float64]) -> tuple[Any, Any]: ...
def arrow_stream(names: list[str], columns: list[npt.NDArray[np.float64]]) -> Any: ...
def budgets(
    model: Model,
    columns: dict[str, tuple[Any, Any, Any]],
    coverage: float | None = None,
    k: float | None = None,
    real_dof: bool = False,
) -> list[dict[str, Any]]: ...
def call(
    arguments: list[str],
    model: Model | None = None,
    text: str | None = None,
    held: list[tuple[str, bytes]] = ...,
) -> tuple[bytes, str, bool]: ...
def carried_models(path: str) -> list[tuple[str, str, list[tuple[str, bytes]]]]: ...
def case_source(path: str, text: str | None = None) -> tuple[str, list[tuple[str, bytes]]]: ...
def equation_html(formula: str) -> str: ...
def equation_latex(formula: str) -> str: ...
def input_keys(distribution: str | None = None) -> list[str] | None: ...
def convert(
    values: npt.NDArray[np.float64], unit: str, wanted: str, are_differences: bool
) -> npt.NDArray[np.float64]: ...
def in_rows(model: Model, columns: dict[str, tuple[Any, Any, Any]]) -> Model: ...
def main(arguments: list[str]) -> int: ...
def unit_of_differences(unit: str) -> str: ...
def unit_product(parts: list[tuple[str, int, int]]) -> str: ...
def printed(estimate: float, uncertainty: float) -> tuple[str, str]: ...
def unit_scale(unit: str) -> tuple[float, float]: ...
def unit_within(unit: str) -> tuple[str, bool, bool]: ...
def units_fit(first: str, second: str) -> bool: ...
