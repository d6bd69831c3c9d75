#!/usr/bin/env python3
"""How large the house is, and how well its names hold: one revision beside another.

    python3 benches/house.py                 writes reports/house.md
    python3 benches/house.py --before REV    beside another revision than the recorded one

Counts the Rust files that git knows, of `--before` as it was committed and of the folder as it is.
Comments are left out and texts are emptied before anything but lines is counted. Needs Python 3.10 or
later, git and nothing else.
"""

import argparse
import collections
import io
import re
import subprocess
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEFORE = "519e7696"
# the largest circles of files of that revision, counted as tests/all/circles.rs does, which it had not
CIRCLES_BEFORE = {"files": 53, "inference": 28, "signal": 16, "engine": 9}
LONG = 100

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|b?r(?P<hashes>\#*)".*?"(?P=hashes)"""
    r"""|b?"(?:\\.|[^"\\])*"|b?'(?:\\[^\n]+?|[^'\\\n])'""",
    re.DOTALL,
)
TYPE = re.compile(
    r"^(?:type|[ \t]*(?:pub(?:\([^)]*\))? )?(?:struct|enum|trait|union)|pub(?:\([^)]*\))? type)"
    r" ([A-Z]\w*)",
    re.M,
)


def skeleton(text):
    """The code with every line in its place, without comments and with a mark for a line of a text."""

    def emptied(match):
        mark = "" if match["comment"] is not None else '"'
        return re.sub(r"[^\n]+", mark, match.group())

    return TOKEN.sub(emptied, text)


def end_of_item(code, start):
    """Where the item that begins at `start` ends: behind its braces or its semicolon."""
    braces = others = 0
    for match in re.compile(r"[()\[\]{};]").finditer(code, start):
        match match.group():
            case "(" | "[":
                others += 1
            case ")" | "]":
                others -= 1
            case "{":
                braces += 1
            case "}":
                braces -= 1
                if braces == 0:
                    return match.end()
            case ";" if braces == 0 and others == 0:
                return match.end()
    return len(code)


def line_of(code, at):
    return code.count("\n", 0, at)


class File:
    """A file: which of its lines are code, and which of those are for tests."""

    def __init__(self, path, text):
        self.path, self.code = path, skeleton(text)
        lines = text.splitlines()
        self.docs = sum(line.lstrip().startswith(("///", "//!")) for line in lines)
        self.filled = {n for n, line in enumerate(self.code.splitlines()) if line.strip()}
        self.for_tests, self.modules_for_tests = set(), []
        for match in re.finditer(r"#\[cfg\(test\)\]", self.code):
            end = end_of_item(self.code, match.end())
            self.for_tests |= set(range(line_of(self.code, match.start()), line_of(self.code, end) + 1))
            declared = re.search(r"\bmod (\w+);$", self.code[match.end() : end])
            if declared:
                self.modules_for_tests.append(declared[1])

    def without_tests(self):
        """The code outside tests, with every line in its place."""
        lines = enumerate(self.code.split("\n"))
        return "\n".join("" if n in self.for_tests else line for n, line in lines)

    def crate(self):
        parts = self.path.parts
        return parts[1] if parts[0] == "crates" else "the root package, page and Python"

    def children(self, module):
        """Where the file of a module that this file declares may be."""
        own = self.path.stem in ("lib", "main", "mod")
        folder = self.path.parent if own else self.path.with_suffix("")
        return {folder / f"{module}.rs", folder / module / "mod.rs"}


def is_for_tests(path):
    folders = set(path.parts[:-1])
    return bool(folders & {"tests", "benches"}) or path.stem == "tests" or path.stem.endswith("_tests")


def counted(texts):
    """What is counted of a state, by crate; `None` is the whole."""
    files = [File(path, text) for path, text in sorted(texts.items())]
    declared = {child for file in files for m in file.modules_for_tests for child in file.children(m)}
    rows = collections.defaultdict(collections.Counter)
    types = collections.defaultdict(collections.Counter)
    for file in files:
        whole = is_for_tests(file.path) or file.path in declared
        tests = len(file.filled) if whole else len(file.filled & file.for_tests)
        here = collections.Counter(files=1, tests=tests, docs=file.docs)
        here["code"] = len(file.filled) - tests
        own = "" if whole else file.without_tests()
        here += names_of(own)
        for key in (file.crate(), None):
            rows[key] += here
            types[key].update(TYPE.findall(own))
    for key, names in types.items():
        shared = [count for count in names.values() if count > 1]
        rows[key]["shared_names"], rows[key]["shared_types"] = len(shared), sum(shared)
        rows[key]["over_three"] = sum(count > 3 for count in shared)
    return rows


def names_of(code):
    """How often code has what says little, and how many of its functions are long."""
    closures = re.findall(r"\|([^|\n;{}]*)\|", code)
    functions = list(functions_of(code))
    return collections.Counter(
        of_arguments=sum(bool(re.search(r"\bof\b", closure)) for closure in closures),
        of_functions=sum(name == "of" for name, _ in functions),
        found=len(re.findall(r"\blet (?:mut )?found\b", code)),
        place=len(re.findall(r"\bplace\b", code)),
        long=sum(lines > LONG for _, lines in functions),
    )


def functions_of(code):
    """Name and number of lines of every function with a body."""
    for match in re.finditer(r"\bfn (\w+)", code):
        end = end_of_item(code, match.end())
        if code[end - 1] == "}":
            yield match[1], code.count("\n", match.start(), end) + 1


def committed(revision):
    """The Rust files of a revision, and its short name with the day of the commit."""
    git = ["git", "-C", str(ROOT)]
    archive = subprocess.run([*git, "archive", revision], capture_output=True, check=True).stdout
    told = [*git, "log", "-1", "--format=%h, %cs", "--abbrev=8", revision]
    name = subprocess.run(told, capture_output=True, check=True, text=True).stdout.strip()
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        members = [m for m in tar.getmembers() if m.isfile() and m.name.endswith(".rs")]
        return {Path(m.name): tar.extractfile(m).read().decode("utf-8") for m in members}, name


def present():
    """The Rust files of the folder that git knows."""
    listed = ["git", "-C", str(ROOT), "ls-files", "*.rs"]
    names = subprocess.run(listed, capture_output=True, check=True, text=True).stdout.splitlines()
    return {Path(name): (ROOT / name).read_text(encoding="utf-8") for name in names if (ROOT / name).is_file()}


def circles(texts):
    """The numbers of the table LARGEST, which `cargo test` holds."""
    text = texts.get(Path("tests/all/circles.rs"), "")
    table = re.search(r"const LARGEST.*?\];", text, re.DOTALL)
    pairs = re.findall(r'\("(\w+)", (\d+)\)', table.group()) if table else []
    return {name: int(number) for name, number in pairs}


WHOLE = [
    ("lines of code outside tests", "code"),
    ("lines of tests and benches", "tests"),
    ("lines of documentation comments", "docs"),
    ("files", "files"),
    ("names that stand for more than one type", "shared_names"),
    ("types of these names", "shared_types"),
    ("names that stand for more than three types", "over_three"),
    ("closures with an argument `of`", "of_arguments"),
    ("functions `of`", "of_functions"),
    ("variables `found`", "found"),
    ("the word `place`", "place"),
    (f"functions of more than {LONG} lines", "long"),
]
BY_CRATE = [("code", "code"), ("tests", "tests"), ("docs", "documentation"), ("files", "files")]


def page(before, its_name, its_circles, now, circles_now):
    said = [
        "# The house in numbers",
        "",
        f"Written by `benches/house.py`; before is {its_name}. Lines of code are neither blank nor comments. "
        "Tests are the files of `tests/` and `benches/`, `tests.rs`, and what stands under `#[cfg(test)]`. "
        "All that is counted behind the number of files stands in code outside tests; the names of types "
        "are compared over all crates. The largest circle of files of a crate is that of "
        "`tests/all/circles.rs`, which holds it.",
        "",
        "| | before | now |",
        "|---|---:|---:|",
    ]
    said += [f"| {what} | {before[None][key]:,} | {now[None][key]:,} |" for what, key in WHOLE]
    heads = [f"{head}, {when}" for _, head in BY_CRATE for when in ("before", "now")]
    said += ["", f"| crate | {' | '.join(heads)} | circle, before | circle, now |"]
    said.append("|---|" + "---:|" * (len(heads) + 2))
    crates = sorted((before.keys() | now.keys()) - {None}, key=lambda name: (" " in name, name))
    for name in crates:
        row = [f"{state[name][key]:,}" for key, _ in BY_CRATE for state in (before, now)]
        row += [str(known.get(name, "")) for known in (its_circles, circles_now)]
        said.append(f"| {name} | {' | '.join(row)} |")
    return "\n".join(said) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--before", default=BEFORE, help=f"the revision to compare with ({BEFORE})")
    revision = parser.parse_args().before
    texts, name = committed(revision)
    own = circles(texts) or (CIRCLES_BEFORE if revision == BEFORE else {})
    now = present()
    report = page(counted(texts), name, own, counted(now), circles(now))
    (ROOT / "reports" / "house.md").write_text(report, encoding="utf-8")


if __name__ == "__main__":
    main()
