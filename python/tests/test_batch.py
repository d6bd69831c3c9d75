"""The examples for schedulers of clusters, run by one that stands in for them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT, run

pytest.importorskip("yaml")
pytestmark = pytest.mark.skipif(os.name != "posix", reason="the examples are scripts of a shell")

MODEL = """{
  "inputs": {
    "a": {"unit": "V", "distribution": "normal", "mean": 1, "std": 0.5},
    "b": {"unit": "V", "distribution": "samples", "file": "samples.txt"}
  },
  "equations": {"y": "a*b"}, "outputs": {"y": {"unit": "V^2", "tolerance": {"upper": 4}}}
}"""

#: The trials do not fit into a megabyte, so that there are three passes.
OPTIONS = ["--trials", "2000000", "--memory", "1M", "--set", "a= 2"]


class Cluster:
    """A folder with a model, and a scheduler on the path."""

    def __init__(self, script: str, scheduler: str, program: str, folder: Path) -> None:
        self.script, self.program, self.folder = ROOT / "examples" / "batch" / script, program, folder
        (folder / "m.json").write_text(MODEL)
        (folder / "samples.txt").write_text("0.1\n0.2\n-0.1\n0.05\n")
        tools = folder / "tools"
        tools.mkdir()
        # by the interpreter of the tests, which has what the scheduler needs
        file = Path(__file__).with_name("scheduler.py")
        (tools / scheduler).write_text(f"#!{sys.executable}\n{file.read_text()}")
        (tools / scheduler).chmod(0o755)
        self.path = f"{tools}{os.pathsep}{os.environ['PATH']}"

    def ended(self, *arguments: str, **variables: str) -> subprocess.CompletedProcess[bytes]:
        given = {
            "PATH": self.path, "GUMPTION": self.program, "CPUS": "2", "IMAGE": "gumption", "CLAIM": "work",
            "MOUNT": str(self.folder), "TASKS_LOG": str(self.folder / "tasks.log"),
        }  # fmt: skip
        return subprocess.run(
            ["sh", str(self.script), *arguments],
            env={**os.environ, **given, **variables}, cwd=self.folder, capture_output=True, check=False,
        )  # fmt: skip

    def attempts(self) -> list[tuple[int, bool]]:
        """The task of each attempt so far, and whether it ended well."""
        lines = (self.folder / "tasks.log").read_text().splitlines()
        return [(int(task), code == "0") for task, code in map(str.split, lines)]

    def whole(self, *options: str) -> bytes:
        """The answer of one machine."""
        done = run(self.program, "run", "m.json", *options, cwd=self.folder)
        assert done.returncode == 0, done.stderr.decode()
        return done.stdout


@pytest.fixture(params=[("slurm.sh", "sbatch"), ("kubernetes.sh", "kubectl")], ids=["slurm", "kubernetes"])
def cluster(request: pytest.FixtureRequest, program: str, tmp_path: Path) -> Cluster:
    return Cluster(*request.param, program, tmp_path)


TO_FILE = "--format json --output answer.json"


def test_a_lost_task_is_repeated(cluster: Cluster) -> None:
    whole = cluster.whole("--format", "json", *OPTIONS)
    done = cluster.ended("3", "m.json", 'it\'s "work"', TO_FILE, *OPTIONS, TASKS_LOST="2")
    assert done.returncode == 0, done.stderr.decode()
    assert (cluster.folder / "answer.json").read_bytes() == whole
    passes = [(1, True), (2, False), (2, True), (3, True)]
    assert len(cluster.attempts()) >= 3 * len(passes)
    assert cluster.attempts() == passes * (len(cluster.attempts()) // len(passes))


def test_missing_parts_are_named_and_made_by_the_next_start(cluster: Cluster) -> None:
    arguments = ["4", "m.json", "work", TO_FILE, "--trials", "8192"]
    failed = cluster.ended(*arguments, TASKS_FAILING="3")
    # the third of four times two blocks
    assert failed.returncode == 2 and b"4..6" in failed.stderr, failed.stderr.decode()
    assert not (cluster.folder / "answer.json").exists()
    assert {task for task, ended in cluster.attempts() if not ended} == {3}
    there = {file: file.stat().st_mtime_ns for file in (cluster.folder / "work").glob("part-*")}
    assert len(there) == 3
    done = cluster.ended(*arguments)
    assert done.returncode == 0, done.stderr.decode()
    assert (cluster.folder / "answer.json").read_bytes() == cluster.whole(
        "--format", "json", "--trials", "8192"
    )
    # what was there is left as it was
    assert there == {file: file.stat().st_mtime_ns for file in there}


def test_without_options(cluster: Cluster) -> None:
    done = cluster.ended("2", "m.json", "usual")
    assert done.returncode == 0, done.stderr.decode()
    assert done.stdout.endswith(cluster.whole())


def test_how_it_is_called(cluster: Cluster) -> None:
    done = cluster.ended("2")
    assert done.returncode == 2 and f"{cluster.script.name} N MODEL DIR" in done.stderr.decode()
    if cluster.script.name == "kubernetes.sh":
        elsewhere = cluster.ended("2", "m.json", "work", MOUNT="/elsewhere")
        assert elsewhere.returncode == 2 and b"is not in /elsewhere" in elsewhere.stderr
