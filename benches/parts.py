#!/usr/bin/env python3
"""What merging the parts of a run costs, in time and in memory.

    python3 benches/parts.py PROGRAM [--trials 1e9] [--parts 100]

The inclined plane with spurious motion is run in parts, one after the other, and merged after each
pass, as on machines that share a folder. Printed are the passes, the processor time of the parts and
of the merges, and the largest resident memory of a merge. Fails where merging takes 2 % of the parts'
time or more, or a merge more than 100 MB.
"""

import argparse, os, subprocess, sys, tempfile

MODEL = os.path.join(os.path.dirname(__file__), "models", "plane_typed.json")


def timed(command, allowed):
    """Processor time, largest resident memory in bytes and exit code of a command."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = child.stderr.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = code = os.waitstatus_to_exitcode(status)
    if code not in allowed:
        sys.exit("%s: exit code %d\n%s" % (" ".join(command), code, said.decode()[:2000]))
    return used.ru_utime + used.ru_stime, used.ru_maxrss * 1024, code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--trials", default="1e9")
    parser.add_argument("--parts", type=int, default=100)
    told = parser.parse_args()
    program, computing, merging, largest, passes = os.path.abspath(told.program), 0.0, 0.0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        following = []
        while True:
            passes += 1
            for part in range(1, told.parts + 1):
                name = os.path.join(folder, "%d-%d.part" % (passes, part))
                own, _, _ = timed([program, "run", MODEL, "--trials", told.trials, "--quiet", "--blocks",
                                    "%d/%d" % (part, told.parts), "--partial", name] + following, (0,))
                computing += own
            size = max(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))
            own, memory, code = timed([program, "merge", folder, "--format", "json", "--quiet"], (0, 75))
            merging, largest = merging + own, max(largest, memory)
            print("pass %d: %.1f s for its parts and those before, the largest file %.1f MB; merged in %.2f s "
                  "with %.0f MB" % (passes, computing, size / 1e6, own, memory / 1e6), flush=True)
            if code == 0:
                break
            following = ["--pass", os.path.join(folder, "next-pass")]
    share = merging / computing
    print("%s trials in %d parts: merging takes %.2f s, %.2f %% of the %.1f s of the parts, and at most %.0f MB"
          % (told.trials, told.parts, merging, 100 * share, computing, largest / 1e6))
    sys.exit(0 if share < 0.02 and largest < 100e6 else 1)


if __name__ == "__main__":
    main()
