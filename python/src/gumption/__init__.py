"""Measurement uncertainty: the budget by the GUM and coverage intervals by Monte Carlo, side by side.

Models are files (`load`), dictionaries (`from_dict`), JSON texts (`from_json`) or Python functions
(`model`). Inputs are given by `normal`, `rectangular`, `readings` and the other distributions of a
model file, or by numbers of ``scipy.stats``, ``uncertainties``, ``GTC``, ``pint`` and
``astropy``. `Model.run` evaluates a model; its results have the same bits as those of the command line.
"""

from __future__ import annotations

import importlib
from typing import Any

# What is where. Nothing of it is imported before it is used: the command line is in this package as
# well, and starts without NumPy.
_HOME = {
    "_gumption": ["ModelError", "__version__"],
    "_commands": [
        "Answer", "Certificate", "assumptions", "call", "certificate", "check", "compare", "diff",
        "gap", "gap_check", "observe", "verify",
    ],
    "_diagnose": ["Diagnosis", "Effect", "Runs", "diagnose", "effect", "runs"],
    "_shapes": [
        "Input", "arcsine", "beta", "components", "constant", "curvilinear_trapezoid", "exponential",
        "gamma", "known", "log_uniform", "lognormal", "normal", "poisson_count", "readings",
        "rectangular", "result", "samples", "student_t", "trapezoidal", "triangular",
    ],
    "_model": ["Model", "from_dict", "from_json", "load"],
    "_measurement": ["Measurement", "NotTracedWarning", "model"],
    "_result": ["Budget", "Gum", "MonteCarlo", "Output", "Result"],
    "_samples": ["Samples", "SampleTable"],
    "_trace": ["quantity"],
    "_quantity": [
        "Comparison", "ComplexUncertainty", "Expression", "Quantity", "celsius", "kelvin", "model_of",
    ],
    "_arrays": ["Quantities", "array", "complex_normal", "correlated"],
    "_budgets": ["OutputBudgets", "budgets"],
    "_grouped_readings": ["GroupedReadings", "readings_by"],
}  # fmt: skip

_WHERE = {name: module for module, names in _HOME.items() for name in names}

__all__ = sorted(name for name in _WHERE if not name.startswith("_"))


def __getattr__(name: str) -> Any:
    module = _WHERE.get(name)
    if module is None:
        raise AttributeError(f"module 'gumption' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"gumption.{module}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(set(globals()) | set(_WHERE))
