#!/usr/bin/env python3
"""Times of large fits, by the program itself, files included.

    python3 benches/fits.py PROGRAM [--points N] [--independent N]

Two files are made in a temporary folder: a straight line through 10,000 points whose y have a full
covariance matrix (a NumPy file of 800 MB), and one through 1,000,000 points with independent noise
(a CSV file). Each is evaluated by the law of propagation; wall time, processor time and the largest
resident memory are printed, with the line found, which is 2 + 3 x within five standard
uncertainties. Fails where it is not, or where a fit takes longer than 20 s or 2 s of wall time: run
it with a release binary on a machine that does nothing else.
"""

import argparse, array, json, math, os, random, resource, subprocess, sys, tempfile, time


def correlated(folder, count):
    """y = 2 + 3 x + e, with e an autoregressive process and what all have in common:
    V(i, j) = 0.01^2 0.9^|i - j| + 0.002^2, which is full to its corners."""
    choice, memory, size, shared = random.Random(1), 0.9, 0.01, 0.002
    powers = [size * size * memory ** k + shared * shared for k in range(count)]
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (%d, %d), }" % (count, count)
    header = header.ljust(127 - 10) + "\n"
    with open(os.path.join(folder, "v.npy"), "wb") as out:
        out.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode())
        both = array.array("d", powers[:0:-1] + powers)
        for row in range(count):
            first = count - 1 - row
            out.write(both[first:first + count].tobytes())
    noise, lines = size * choice.gauss(0, 1), ["x,y"]
    level = 2 + shared * choice.gauss(0, 1)
    for i in range(count):
        x = i / count
        lines.append("%r,%r" % (x, level + 3 * x + noise))
        noise = memory * noise + math.sqrt(1 - memory * memory) * size * choice.gauss(0, 1)
    with open(os.path.join(folder, "points.csv"), "w") as out:
        out.write("\n".join(lines) + "\n")
    return {"x": {"file": "points.csv", "column": "x"},
            "y": {"file": "points.csv", "column": "y", "covariance": {"file": "v.npy"}}}


def independent(folder, count):
    """y = 2 + 3 x + e, with u(y) = 0.01 of each."""
    choice = random.Random(2)
    with open(os.path.join(folder, "points.csv"), "w") as out:
        out.write("x,y\n")
        for i in range(count):
            x = i / count
            out.write("%r,%r\n" % (x, 2 + 3 * x + 0.01 * choice.gauss(0, 1)))
    return {"x": {"file": "points.csv", "column": "x"},
            "y": {"file": "points.csv", "column": "y", "standard_uncertainty": 0.01}}


def timed(program, what, make, count, most):
    with tempfile.TemporaryDirectory() as folder:
        model = {"fits": {"line": make(folder, count)},
                 "inputs": {"zero": {"distribution": "constant", "value": 0}},
                 "equations": {"a": "line.a + zero", "b": "line.b + zero"}, "outputs": {"a": {}, "b": {}}}
        with open(os.path.join(folder, "m.json"), "w") as out:
            json.dump(model, out)
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        told = subprocess.run([program, "run", "m.json", "--trials", "0", "--format", "json", "--quiet"],
                              cwd=folder, capture_output=True, text=True)
        wall, after = time.monotonic() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    if told.returncode != 0:
        print("%s: exit code %d\n%s" % (what, told.returncode, told.stderr[:2000]))
        return False
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    outputs = json.loads(told.stdout)["outputs"]
    right, shown = True, []
    for name, truth in [("a", 2), ("b", 3)]:
        gum = outputs[name]["gum"]
        estimate, u = gum["estimate"], gum["standard_uncertainty"]
        right = right and u > 0 and abs(estimate - truth) < 5 * u
        shown.append("%s = %.6f, u = %.2g" % (name, estimate, u))
    print("%s, %d points: %.2f s (%.2f s of processor time, %d MiB), at most %g s; %s"
          % (what, count, wall, cpu, after.ru_maxrss >> 10, most, ", ".join(shown)), flush=True)
    return right and wall <= most


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--points", type=int, default=10_000, help="with a full covariance matrix")
    parser.add_argument("--independent", type=int, default=1_000_000)
    told = parser.parse_args()
    program = os.path.abspath(told.program)
    passed = [timed(program, "full covariance matrix", correlated, told.points, 20),
              timed(program, "independent", independent, told.independent, 2)]
    sys.exit(0 if all(passed) else 1)


if __name__ == "__main__":
    main()
