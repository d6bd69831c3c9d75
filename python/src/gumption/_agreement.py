"""Decides whether two evaluations of one function agree apart from rounding."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Column = npt.NDArray[np.float64]
Marks = npt.NDArray[np.bool_]

EPS = float(np.finfo(np.float64).eps)

#: Two evaluations of the same operations in double precision differ by the roundings of elementary
#: functions: a few units in the last place each, for some dozens of them.
ROUNDING = 64 * EPS

#: A difference of this part of the scatter of the draws is in no digit that anybody states.
OF_SCATTER = 1e-6

#: By so much arguments are moved to see what rounding makes of a function that nearly cancels, and so
#: many times what is seen is allowed.
MOVED, ALLOWED = 8 * EPS, 8


def apart(
    values: Column, truth: Column, draws: Column, moved: Callable[[Callable[[int], float]], Column]
) -> Marks:
    """The indices at which values differ from the true ones by more than rounding.

    Parameters
    ----------
    values, truth : ndarray
        The values to compare.
    draws : ndarray
        The values of all draws, whose standard deviation says what is in no digit that anybody states.
    moved : callable
        The true values if argument i is multiplied by a factor; called only to distinguish rounding
        from a difference.
    """
    allowed = ROUNDING * np.maximum(abs(values), abs(truth))
    wrong = differ(values, truth, allowed)
    if not wrong.any():
        return wrong
    allowed = allowed + OF_SCATTER * scatter_of(draws)
    wrong = differ(values, truth, allowed)
    if not wrong.any():
        return wrong
    noise = np.zeros_like(truth)
    for even, odd in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        change = abs(moved(lambda i, of=(even, odd): 1 + of[i % 2] * MOVED) - truth)  # type: ignore[misc]
        noise = np.fmax(noise, change)
    return differ(values, truth, allowed + ALLOWED * noise)


def differ(values: Column, truth: Column, allowed: Column | float) -> Marks:
    """The indices at which two columns differ by more than the tolerance; values undefined in both agree."""
    defined = np.isfinite(values), np.isfinite(truth)
    with np.errstate(invalid="ignore"):
        far = ~(abs(values - truth) <= allowed)
    found: Marks = (defined[0] != defined[1]) | (defined[0] & defined[1] & far)
    return found


def scatter_of(values: Column) -> float:
    """The standard deviation of the defined values."""
    known = values[np.isfinite(values)]
    return float(np.std(known)) if known.size else 0.0
