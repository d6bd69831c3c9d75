#!/usr/bin/env python3
"""Stands in for a cluster's scheduler: ``sbatch`` or ``kubectl``, after the name that it is called by.

Each task of an array or an indexed Job is a process of its own, with the variables that the scheduler
sets. ``TASKS_LOST`` and ``TASKS_FAILING`` are lists of tasks, from 1 on: the first attempt of a lost
one and all attempts of a failing one cannot write a byte. ``TASKS_LOG`` is a file that takes a line
for each attempt, with the number of the task and its exit code.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any


def attempt(task: int, nth: int, command: list[str], folder: str | None = None, **variables: str) -> bool:
    """One process; whether it ended well."""
    failing = str(task) in os.environ.get("TASKS_FAILING", "").split()
    lost = nth == 0 and str(task) in os.environ.get("TASKS_LOST", "").split()

    def limit() -> None:
        if failing or lost:
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    code = subprocess.call(command, env={**os.environ, **variables}, cwd=folder, preexec_fn=limit)
    with open(os.environ["TASKS_LOG"], "a") as log:
        print(task, code, file=log)
    return code == 0


def sbatch(*arguments: str) -> int:
    """Puts a task back into the queue if its node died, not if it ended with an error by itself."""
    *options, script = arguments
    assert "--wait" in options and "--requeue" in options, options
    given = dict(option.partition("=")[::2] for option in options)
    first, last = map(int, given["--array"].split("-"))
    ended = True
    for task in range(first, last + 1):
        variables = {"SLURM_ARRAY_TASK_ID": str(task), "SLURM_CPUS_PER_TASK": given["--cpus-per-task"]}
        failing = str(task) in os.environ.get("TASKS_FAILING", "").split()
        attempts = 1 if failing else 2
        ended &= any(attempt(task, nth, ["sh", script], **variables) for nth in range(attempts))
    return 0 if ended else 1


def kubectl(verb: str, *arguments: str) -> int:
    """Keeps the conditions of Jobs in a file beside the log."""
    kept = Path(os.environ["TASKS_LOG"]).with_suffix(".jobs")
    jobs: dict[str, str] = json.loads(kept.read_text()) if kept.exists() else {}
    if verb == "delete":
        job, option = arguments
        assert option == "--ignore-not-found"
        jobs.pop(job, None)
    elif verb == "get":
        job, option, path = arguments
        assert (option, path) == ("--output", 'jsonpath={.status.conditions[?(@.status=="True")].type}')
        print(jobs[job], end="")
    else:
        option, file = arguments
        assert (verb, option) == ("apply", "--filename")
        import yaml

        manifest = yaml.safe_load(Path(file).read_text())
        job = f"job/{manifest['metadata']['name']}"
        assert job not in jobs, "a Job cannot be changed"
        jobs[job] = made(manifest)
    kept.write_text(json.dumps(jobs))
    return 0


def made(manifest: dict[str, Any]) -> str:
    """The conditions of an indexed Job that has ended."""
    spec = manifest["spec"]
    assert (manifest["apiVersion"], manifest["kind"]) == ("batch/v1", "Job")
    assert spec["completionMode"] == "Indexed"
    pod = spec["template"]["spec"]
    assert pod["restartPolicy"] == "Never"
    (container,) = pod["containers"]
    (mount,), (volume,) = container["volumeMounts"], pod["volumes"]
    assert mount["name"] == volume["name"] and volume["persistentVolumeClaim"]["claimName"]
    ended = True
    for index in range(spec["completions"]):
        variables = {"JOB_COMPLETION_INDEX": str(index)}
        ended &= any(
            attempt(index + 1, nth, container["command"], container["workingDir"], **variables)
            for nth in range(spec["backoffLimitPerIndex"] + 1)
        )
    return "SuccessCriteriaMet Complete" if ended else "FailureTarget Failed"


if __name__ == "__main__":
    sys.exit({"sbatch": sbatch, "kubectl": kubectl}[Path(sys.argv[0]).name](*sys.argv[1:]))
