"""The arguments of a function, with its own names and order."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

_NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
_POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


class Arguments:
    """How to pass arguments to a function: by name, or by position if it has no names.

    Attributes
    ----------
    names : list of str
        The arguments in the order of the function.
    positional : list of str
        The arguments that may be passed by position.
    """

    def __init__(self, function: Callable[..., Any], names: Sequence[str]) -> None:
        try:
            parameters = list(inspect.signature(function).parameters.values())
        except (TypeError, ValueError):
            # a function of C that does not tell them
            parameters = [inspect.Parameter("arguments", inspect.Parameter.VAR_POSITIONAL)]
        own = {p.name: p for p in parameters if p.kind in _NAMED or p.kind in _POSITIONAL}
        kinds = {p.kind for p in parameters}
        takes_any = inspect.Parameter.VAR_KEYWORD in kinds
        if not own and not takes_any and inspect.Parameter.VAR_POSITIONAL in kinds:
            # it has no names
            self.names = self.positional = self._first = list(names)
            return
        unknown = [name for name in names if name not in own and not takes_any]
        called = getattr(function, "__name__", "the function")
        if unknown:
            raise TypeError(
                f"`{', '.join(unknown)}` is no argument of `{called}`; its arguments are {', '.join(own) or 'none'}"
            )
        empty = inspect.Parameter.empty
        missing = [n for n, p in own.items() if p.default is empty and n not in names]
        if missing:
            raise TypeError(
                f"`{called}` also takes {', '.join(missing)}; name it among `inputs` or `conditions`, or "
                "give it a default value"
            )
        ordered = [name for name in own if name in names]
        self.names = ordered + [name for name in names if name not in own]
        self.positional = [name for name in ordered if own[name].kind in _POSITIONAL]
        self._first = [n for n in ordered if own[n].kind is inspect.Parameter.POSITIONAL_ONLY]

    def call(self, function: Callable[..., Any], values: Mapping[str, Any]) -> Any:
        """Calls the function with a value for each argument."""
        if not self._first:
            return function(**values)
        first = [values[name] for name in self._first]
        return function(*first, **{n: v for n, v in values.items() if n not in self._first})
