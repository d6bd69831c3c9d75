"""Messages about options of the command line as messages about arguments of Python."""

from __future__ import annotations

import re
from collections.abc import Sequence

from gumption import _gumption


def called(
    arguments: Sequence[str],
    model: _gumption.Model | None = None,
    text: str | None = None,
    held: Sequence[tuple[str, bytes]] = (),
) -> tuple[bytes, str, bool]:
    """Runs a command whose options are arguments of a function, which its errors then name."""
    try:
        return _gumption.call(list(arguments), model, text, list(held))
    except _gumption.ModelError as error:
        raised = _gumption.ModelError(in_keywords(str(error)))
        raised.errors = [{**one, "message": in_keywords(one["message"])} for one in error.errors]
    raise raised


def in_keywords(message: str) -> str:
    """A message that names arguments of Python instead of options of the command line."""
    message = message.removeprefix("-: ")
    if message.startswith("error: "):
        message = _of_parser(message.removeprefix("error: "))
    # options in sentences: `--scheme iso13528`, `--assigned VALUE --sigma VALUE`
    return re.sub(r"`(--[a-z][^`=]*)`", lambda found: f"`{_written(found[1])}`", message)


def _of_parser(message: str) -> str:
    """What the parser of the command line says of an option."""
    message = re.sub(r"( Usage: gumption .*?)?( For more information, try '--help'\.)?$", "", message)
    option = r"'--([a-z-]+)(?: <[^>]*>)?'"
    if found := re.match(rf"invalid value '(.*?)' for {option}:? (.*)", message):
        value, name, right = found.groups()
        right = re.sub(r"^\[possible values: (.*)\]$", r"one of \1 is needed", right)
        return f"`{_keyword(name)}={_value(value)}`: {right}"
    if found := re.match(rf"the argument {option} cannot be used with {option}", message):
        return f"`{_keyword(found[1])}` and `{_keyword(found[2])}` exclude each other; give one of them"
    if found := re.match(rf"a value is required for {option}", message):
        return f"`{_keyword(found[1])}=''`: a value is needed"
    if found := re.match(r"the following required arguments were not provided: --([a-z-]+)", message):
        return f"`{_keyword(found[1])}` is needed as well"
    return message


def _keyword(option: str) -> str:
    return option.replace("-", "_")


def _value(text: str) -> str:
    """A value as Python writes it, which the command line has as a text."""
    is_plain = re.fullmatch(r"[-+]?[0-9.]+(e[-+]?[0-9]+)?|True|False|[A-Z]+", text)
    return text if is_plain else repr(text)


def _written(options: str) -> str:
    """Options with their values as arguments."""
    parts = [part.partition(" ") for part in options.strip().removeprefix("--").split(" --")]
    return ", ".join(
        f"{_keyword(name)}={_value(value)}" if value else _keyword(name) for name, _, value in parts
    )
