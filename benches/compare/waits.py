"""What users wait for beside runs: whole commands of the program, and of an earlier version if one is
given, in turn."""

import json
import math
import os
import random
import struct
import subprocess
import tempfile
import wave
from pathlib import Path

SAMPLING_RATE = 48_000
MINUTES = 60
LABORATORIES = 100
DRAWS = 20


def recording(folder, minutes):
    """A tone of 80 Hz in noise, 16 bits, and the recipe that reads it."""
    noise = random.Random(1)
    # ten seconds again and again: 80 Hz has whole periods in them
    samples = [
        round(9000 * math.sin(2 * math.pi * 80 * n / SAMPLING_RATE) + noise.gauss(0, 200))
        for n in range(10 * SAMPLING_RATE)
    ]
    data = struct.pack(f"<{len(samples)}h", *samples)
    with wave.open(str(folder / "long.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(SAMPLING_RATE)
        for _ in range(6 * minutes):
            file.writeframesraw(data)
    recipe = {
        "recordings": {"run": {"file": "long.wav"}},
        "channels": {"a": {"column": 1}},
        "frequency": 80,
    }
    (folder / "recipe.json").write_text(json.dumps(recipe))


def laboratories(folder):
    """Results of which about half contradict the others."""
    noise = random.Random(2)
    lines = ["label,x,U"]
    for number in range(LABORATORIES):
        shift = 0 if number % 2 else noise.uniform(-20, 20)
        lines.append(f"L{number},{10 + shift + noise.gauss(0, 1):.4f},{0.5 + noise.random():.3f}")
    (folder / "laboratories.csv").write_text("\n".join(lines) + "\n")


class Wait:
    """A command of the program, and the goal of its processor time in seconds, if there is one."""

    def __init__(self, what, arguments, goal=None):
        self.what, self.arguments, self.goal = what, arguments, goal


def waits(folder, quick):
    minutes = 1 if quick else MINUTES
    draws = 2 if quick else DRAWS
    recording(folder, minutes)
    laboratories(folder)
    models = Path("models").resolve()
    plane = str(models / "inclined_plane_spurious.json")
    return [
        Wait("`assumptions` of the inclined plane with spurious motion", ["assumptions", plane], 0.7),
        Wait("`run --save` of the same", ["run", plane, "--save", str(folder / "saved.json")]),
        Wait(f"`observe` of {minutes} min of WAV", ["observe", str(folder / "recipe.json")], 15),
        Wait(
            f"`compare` of {LABORATORIES} inconsistent laboratories",
            ["compare", str(folder / "laboratories.csv")],
            2,
        ),
        Wait(
            f"`gap-check`, {draws} draws of the plane with a resonance",
            ["gap-check", str(models / "gap/plane_resonance/case.json"), "--draws", str(draws)],
        ),
        Wait("`gap` of the lateral motion", ["gap", str(models / "gap/lateral_motion/case.json")]),
    ]


def processor_time(command, folder):
    """Seconds of a command on all its threads; `None` where it is refused."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=folder)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 3):
        return None
    return used.ru_utime + used.ru_stime


def measured(programs, rounds, quick, say):
    """For each wait the seconds of each program's runs; `programs` by name. A program that has not the
    command, or refuses it, has none."""
    done = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for wait in waits(folder, quick):
            say(wait.what)
            runs = {program: [] for program in programs}
            for _ in range(rounds):
                for program, path in programs.items():
                    command = [os.path.abspath(path), *wait.arguments, "--quiet"]
                    if found := processor_time(command, folder):
                        runs[program].append(found)
            done.append({"what": wait.what, "goal": wait.goal, "runs": runs})
    return done
