"""The reference of the manual is that of the docstrings, and these say everything of every public name."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import inspect
import os
from typing import Any

import gumption
from conftest import ROOT

_LOADER = importlib.machinery.SourceFileLoader("reference", str(ROOT / "python/reference"))
_SPEC = importlib.util.spec_from_loader("reference", _LOADER)
assert _SPEC is not None
reference: Any = importlib.util.module_from_spec(_SPEC)
_LOADER.exec_module(reference)


def test_the_page_is_that_of_the_docstrings() -> None:
    made = reference.made()
    if "GUMPTION_UPDATE" in os.environ:
        reference.PAGE.write_text(made, encoding="utf-8")
    committed = reference.PAGE.read_text(encoding="utf-8")
    assert committed == made, "docs/reference/python.md is of other docstrings: python/reference writes it"


def test_every_public_name_is_on_the_page() -> None:
    page = reference.PAGE.read_text(encoding="utf-8")
    assert [name for name in gumption.__all__ if page.count(f"### `{name}`\n") != 1] == []


def test_every_name_and_every_parameter_is_documented() -> None:
    functions: dict[str, Any] = {}
    without: list[str] = []
    for name in gumption.__all__:
        value = getattr(gumption, name)
        if not inspect.getdoc(value):
            without.append(name)
        if not inspect.isclass(value):
            functions[name] = value
            continue
        for member, of in reference.members(value):
            if not inspect.getdoc(getattr(value, member)):
                without.append(f"{name}.{member}")
            if not isinstance(of, property):
                functions[f"{name}.{member}"] = of
    for name, function in functions.items():
        told = reference.documented(inspect.getdoc(function) or "")
        own = [of.name for of in reference.parameters(function)]
        without += [f"{name}({of})" for of in own if of not in told]
        without += [f"{name}({of}), which it does not have" for of in sorted(told - {*own})]
    assert len(functions) > 70
    assert without == []
