#!/usr/bin/env python3
"""How long the manual is, and whether phrases that were replaced are still in use.

    python3 benches/words.py        writes reports/words.md

Counts the words of the chapters of `docs/` and of README.md, and searches the program, its pages, the
manual and the Python package for the phrases below. Exits with 1 if one is found. Needs Python 3.9 or
later, git and nothing else.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# words of all chapters that people read from beginning to end
BUDGET = 25_000
# lists that the tests write, and pages of the reference
LISTS = ("docs/reference/", "docs/published.md", "docs/notes.md", "docs/clauses.md", "docs/SUMMARY.md")
SEARCHED = ("crates", "docs", "page", "python", "src", "README.md")
TEXTS = (".rs", ".js", ".mjs", ".py", ".md", ".json", ".html", ".xsl", ".snap", ".sh")

# phrases that were replaced by plain words and must not come back
REPLACED = [
    "To repeat this",
    "What is known about the inputs",
    "How the Monte Carlo figures settle",
    "Before the mistake",
    "The result stands here as soon as",
    "as it has mistakes",
    "the file asks for more, which",
    "There is no file of this program",
    "Which one shall stay",
    "Typed measurements",
    "Row of conditions",
    "What the Type B assumptions decide",
    "the GUM interval is not valid",
    "What was measured, and what the sim says",
    "Which effects are there?",
    "Which together?",
    "How far does it shrink?",
    "Most is expected of this",
    "That is little",
    "upright line",
    "its ends lie",
    "what is drawn for them",
    "because standard uncertainties of inputs have few degrees of freedom",
    "the distance of the value from its farther end",
    "how the device will behave over time",
    "but up where that would take away",
    "is none seen",
    "Allowed is how far",
    "Kept is the standard uncertainty",
    "Shapes that matter, by more than",
    "a reading costs so much that",
    "where even without its uncertainty the target is missed",
    "are brought to that",
    "This U is not valid in both files",
    "nothing is stated of the uncertainty of y",
    "it stands for the uncertainty of y",
    "have something in common",
    "Tell how a command is called",
    "Check that diagnosis blindly",
    "Say what inputs would have to become",
    "standard output, which `-` is as well",
    "What is measured, in a line?",
    "which is reported (1 for a number)",
    "nor is any other name here",
    "in place of the braces",
    "is all that they need",
    "when the hand rests",
    "mend what matters",
    "is worth so many trials",
    "Words say whose",
    "because once would let one in three",
]


def tracked(*below):
    """The files that git knows and that exist, in order."""
    names = subprocess.run(
        ["git", "-C", str(ROOT), "ls-files", "--", *below], capture_output=True, check=True, text=True
    ).stdout.splitlines()
    return [name for name in names if (ROOT / name).is_file()]


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def paragraphs(text):
    """Paragraphs and items of lists, each on one line, without code, tables and headings."""
    outside = re.sub(r"^```.*?^```\s*?$", "", text, flags=re.DOTALL | re.MULTILINE)
    blocks = re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", outside)
    joined = (" ".join(block.split()) for block in blocks)
    return [block for block in joined if not block.startswith(("|", "#"))]


def row(name):
    text = text_of(name)
    longest = max(map(len, paragraphs(text)), default=0)
    return name, len(text.split()), longest


def still_used():
    """The replaced phrases that a file contains, each with its files."""
    found = {}
    for name in tracked(*SEARCHED):
        if not name.endswith(TEXTS):
            continue
        # texts of Rust go on after a backslash, and paragraphs and comments on the next line
        text = re.sub(r"\\\n\s*", "", text_of(name))
        text = re.sub(r"\s+(?:///?!? )?", " ", text)
        for phrase in REPLACED:
            if re.search(re.escape(phrase) + r"(?!\w)", text):
                found.setdefault(phrase, []).append(name)
    return found


def table(title, rows):
    said = [f"| {title} | words | longest paragraph, characters |", "|---|---:|---:|"]
    said += [f"| {name} | {words:,} | {longest:,} |" for name, words, longest in rows]
    longest = max((longest for _, _, longest in rows), default=0)
    return [*said, f"| sum | {sum(words for _, words, _ in rows):,} | {longest:,} |", ""]


def page(chapters, lists, readme, found):
    words = sum(words for _, words, _ in chapters)
    verdict = "within" if words <= BUDGET else "above"
    said = [
        "# The words of the manual",
        "",
        "Written by `benches/words.py`. Words are separated by white space. A paragraph is a paragraph or an item "
        "of a list, without tables, code and headings.",
        "",
        f"The chapters have {words:,} words, {verdict} the budget of {BUDGET:,}.",
        "",
        *table("chapter", chapters),
        *table("reference and lists", lists),
        *table("start page", [readme]),
    ]
    if not found:
        return "\n".join([*said, f"None of the {len(REPLACED)} replaced phrases is in use."]) + "\n"
    said += ["These replaced phrases are still in use:", ""]
    said += [f"- {phrase}: {', '.join(names)}" for phrase, names in found.items()]
    return "\n".join(said) + "\n"


def main():
    rows = [row(name) for name in tracked("docs") if name.endswith(".md")]
    chapters = [of for of in rows if not of[0].startswith(LISTS)]
    lists = [of for of in rows if of[0].startswith(LISTS)]
    found = still_used()
    report = page(chapters, lists, row("README.md"), found)
    (ROOT / "reports" / "words.md").write_text(report, encoding="utf-8")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
