"""README is the page on an index: its first example prints what it shows, and its links lead there."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

PAGE = (ROOT / "python" / "README.md").read_text(encoding="utf-8")


def test_the_first_example(tmp_path: Path) -> None:
    (code,) = re.findall(r"^```python\n(.*?)^```\n\n```text\n", PAGE, re.DOTALL | re.MULTILINE)[:1]
    (shown,) = re.findall(r"^```text\n(.*?)^```\n", PAGE, re.DOTALL | re.MULTILINE)[:1]
    file = tmp_path / "example.py"
    file.write_text(code, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-X", "utf8", file], capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(shown)
    # by hand: V^2/R, and u of 4 readings in arithmetic progression of step 0.1: their deviations from
    # the mean are 0.15, 0.15, 0.05, 0.05, so that s/sqrt(4) = sqrt(0.05/3)/2
    power = 5.01**2 / 99.95 * 1e3
    u = power * ((2 * 0.01 / 5.01) ** 2 + (0.05 / 3 / 4) / 99.95**2) ** 0.5
    assert f"({power:.1f} ± {2 * u:.1f}) mW" in shown


@pytest.mark.parametrize("link", re.findall(r"\]\(([^)#]+)", PAGE))
def test_links_lead_there_from_an_index(link: str) -> None:
    """Absolute ones of this repository name files that there are; relative ones mean nothing there."""
    page = "https://github.com/gumption-metrology/gumption/blob/main/"
    assert link.startswith(page) and (ROOT / link.removeprefix(page)).is_file()
