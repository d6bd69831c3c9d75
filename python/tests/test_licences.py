"""What is published has the licence texts of all that is linked into it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

pytestmark = pytest.mark.skipif(not shutil.which("cargo"), reason="cargo is not there")


def collect(
    package: str, folder: Path, *targets: str, workspace: Path = ROOT
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, ROOT / "python" / "licences", package, folder, *targets],
        cwd=workspace, capture_output=True, encoding="utf-8", check=False,
    )  # fmt: skip


@pytest.mark.parametrize("package", ["gumption", "gumption-python"])
def test_every_crate_has_its_texts(package: str, tmp_path: Path) -> None:
    done = collect(package, tmp_path, "x86_64-unknown-linux-musl")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "LICENSE-THIRD-PARTY.txt").read_text(encoding="utf-8")
    head, *sections = text.split(f"\n{'=' * 78}\n")
    of = {name for section in sections for name in section.split("\n")[0].split(", ")}
    # cargo's own list of what is linked for this target, down to packages of this workspace
    tree = subprocess.run(
        ["cargo", "tree", "--locked", "--package", package, "--edges", "normal,no-proc-macro",
         "--target", "x86_64-unknown-linux-musl", "--prefix", "none", "--format", "{p}"],
        cwd=ROOT, capture_output=True, encoding="utf-8", check=True,
    ).stdout  # fmt: skip
    crates = set(re.findall(r"^(?!gumption)(\S+) v(\S+)", tree, re.MULTILINE))
    assert len(crates) > 100
    for name, version in crates:
        assert f"\n- {name} {version}: " in head and f"{name} {version}" in of
    # each text once; those of the font in the figures, of the C library and of Unicode's tables among them
    assert len(set(sections)) == len(sections)
    for words in ("Bitstream Vera", "Rich Felker", "UNICODE LICENSE V3", "Apache License", "Ville Laurikari"):
        assert words in text
    # of the standard library, with a crate that it is made of
    library = (tmp_path / "LICENSE-RUST-LIBRARY.html").read_text(encoding="utf-8")
    assert "hashbrown" in library


def crate(folder: Path, name: str, licence: str, *dependencies: str) -> None:
    (folder / "src").mkdir(parents=True)
    (folder / "src" / "lib.rs").write_text("")
    lines = [f'{other} = {{ path = "../{other}" }}' for other in dependencies]
    (folder / "Cargo.toml").write_text(
        f'[package]\nname = "{name}"\nversion = "1.2.3"\nlicense = "{licence}"\nedition = "2021"\n'
        "[workspace]\n[dependencies]\n" + "\n".join(lines)
    )


def test_a_crate_without_a_text_is_an_error_that_names_it(tmp_path: Path) -> None:
    crate(tmp_path / "top", "top", "MIT", "bare", "either")
    crate(tmp_path / "either", "either", "MIT OR Apache-2.0")
    crate(tmp_path / "bare", "bare", "MIT AND Apache-2.0")
    lock = ["cargo", "generate-lockfile", "--offline"]
    subprocess.run(lock, cwd=tmp_path / "top", check=True, capture_output=True)
    done = collect("top", tmp_path, "x86_64-unknown-linux-gnu", workspace=tmp_path / "top")
    assert done.returncode == 1
    assert done.stderr == "bare 1.2.3: its sources have no licence text\n"
    assert not (tmp_path / "LICENSE-THIRD-PARTY.txt").exists()
    # a notice is no licence
    (tmp_path / "bare" / "COPYRIGHT").write_text("by me")
    again = collect("top", tmp_path, "x86_64-unknown-linux-gnu", workspace=tmp_path / "top")
    assert again.stderr == done.stderr
    # with its own text, and the other crate with the text of Apache-2.0
    (tmp_path / "bare" / "LICENCE").write_text("what bare allows")
    done = collect("top", tmp_path, "x86_64-unknown-linux-gnu", workspace=tmp_path / "top")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "LICENSE-THIRD-PARTY.txt").read_text(encoding="utf-8")
    assert "\nbare 1.2.3\n\nwhat bare allows\n" in text and "\nbare 1.2.3\n\nby me\n" in text
    assert re.search(r"\neither 1\.2\.3\n\n\s*Apache License\n", text)
