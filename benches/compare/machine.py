"""What kind of machine and which tools; never its name or the time."""

import importlib.metadata
import os
import platform
import subprocess

NAMES = {"baseline": "none beyond the baseline", "avx2": "AVX2", "avx512": "AVX-512"}


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.machine()


def kind(paths):
    return {
        "processor": processor(),
        "architecture": platform.machine(),
        "threads": os.cpu_count(),
        "vectors": NAMES[paths[-1]],
        "system": platform.system(),
    }


def versions():
    rustc = subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=True)
    found = {"rustc": rustc.stdout.split()[1], "Python": platform.python_version()}
    for package in ("numpy", "numba", "GTC"):
        found[package] = importlib.metadata.version(package)
    return found
