#!/usr/bin/env python3
"""One workload of benches/README.md in another tool, in a process of its own.

    peers.py --tool numpy --workload W1 --trials 1e6 --threads 1 --repeats 5

Prints one line of JSON in the form of workload.rs: CPU time and wall time of each repeat after a
warm-up, the most memory held, and the figures of the first and the last row. With --on-demand it
makes one repeat for each line of standard input, as workload.rs does.

Every tool goes from drawing to mean, standard uncertainty, probabilistically symmetric and shortest
95 % coverage interval (JCGM 101, 7.6 and 7.7), in 64-bit floating point:

    numpy            whole arrays, one expression after another: the usual script
    numba            a compiled loop with numba's np.random, over all threads
    numba-tuned      blocks that stay in the cache, an own counter-based generator, the method of
                     Box and Muller, fast-math; numpy's vectorised sort
    numba-partition  the same, sorting only the two tails that the intervals need
    gtc              GTC's uncertain numbers, one budget after another (W5 only)
"""

import argparse
import json
import math
import os
import resource
import sys
import time

DEGREE = math.pi / 180
ROOT_3 = math.sqrt(3.0)

# W1: estimate and half-width (rectangular) or standard deviation (normal), in SI units.
INPUTS = [
    ("normal", 10.0, 0.01),
    ("rectangular", 35 * DEGREE, 0.1 * DEGREE),
    ("rectangular", 30 * DEGREE, 0.1 * DEGREE),
    ("rectangular", 0.30, 0.0025),
    ("rectangular", 0.20, 0.0025),
    ("rectangular", 0.15, 0.0025),
    ("normal", 40 * DEGREE, 2 * DEGREE),
    ("normal", -65 * DEGREE, 2 * DEGREE),
    ("normal", 3 * DEGREE, 2 * DEGREE),
]
CENTRES = [centre for _, centre, _ in INPUTS]
WIDTHS = [width for _, _, width in INPUTS]
STANDARD = [width if kind == "normal" else width / ROOT_3 for kind, _, width in INPUTS]
PHASES = (6, 7, 8)  # five readings each: four degrees of freedom (W5)
STEP = 1e-6  # between the reference accelerations of W5


def campaign():
    """W3: the centres of the nine inputs in each of its 384 conditions."""
    for tilt in (15, 35, 55, 75):
        for rotation in range(0, 360, 45):
            for k in range(12):
                grown = (1 + k) / 6
                yield [
                    10.0, tilt * DEGREE, rotation * DEGREE,
                    0.30 * grown, 0.20 * grown, 0.15 * grown,
                    (40 + 5 * k) * DEGREE, (-65 + 5 * k) * DEGREE, 3 * DEGREE,
                ]  # fmt: skip


def ranks(n):
    """Places, from 0, of the symmetric interval's ends, and how far apart ends lie (7.7)."""
    q = int(0.95 * n + 0.5)
    r = (n - q) // 2 if (n - q) % 2 == 0 else (n - q + 1) // 2
    return max(r, 1) - 1, q


def figures(mean, u, lower_tail, upper_tail, n):
    """`lower_tail` and `upper_tail`: the sorted n - q least and n - q greatest values."""
    r, q = ranks(n)
    lengths = upper_tail - lower_tail
    j = int(lengths.argmin())
    return {
        "mean": float(mean),
        "u": float(u),
        "symmetric": [float(lower_tail[r]), float(upper_tail[r])],
        "shortest": [float(lower_tail[j]), float(upper_tail[j])],
    }


def sorted_figures(y):
    mean, u = y.mean(), y.std(ddof=1)
    y.sort()
    _, q = ranks(y.size)
    return figures(mean, u, y[: y.size - q], y[q:], y.size)


def budget(estimate, u, dof):
    return {"mean": float(estimate), "u": float(u), "dof": float(dof)}


# ------------------------------------------------------------------------------------------ numpy


class Numpy:
    def __init__(self, threads):
        import numpy

        self.np = numpy
        self.generator = numpy.random.default_rng(1)

    def about(self, kind, centre, width, n):
        draw = self.generator
        if kind == "normal":
            return draw.normal(centre, width, n)
        return draw.uniform(centre - width, centre + width, n)

    def plane(self, centres, n):
        return [self.about(kind, c, w, n) for (kind, _, w), c in zip(INPUTS, centres)]

    def modulus(self, reference, x, y, z, p, q, r):
        np = self.np
        re = abs(reference) + abs(x) * np.cos(p) + abs(y) * np.cos(q) + abs(z) * np.cos(r)
        im = abs(x) * np.sin(p) + abs(y) * np.sin(q) + abs(z) * np.sin(r)
        return np.sqrt(re * re + im * im)

    def a_x(self, values):
        np = self.np
        a, tilt, rotation, x, y, z, p, q, r = values
        sin, cos, turned = np.sin(tilt), np.cos(tilt), np.cos(rotation)
        across = y * np.sin(rotation)
        return self.modulus(a * sin * turned, x * cos * turned, across, z * sin * turned, p, q, r)

    def axes(self, values):
        """All three outputs; what they share is computed once."""
        np = self.np
        a, tilt, rotation, x, y, z, p, q, r = values
        sin_t, cos_t, sin_r, cos_r = np.sin(tilt), np.cos(tilt), np.sin(rotation), np.cos(rotation)
        cosines, sines = [np.cos(v) for v in (p, q, r)], [np.sin(v) for v in (p, q, r)]

        def modulus(reference, *terms):
            terms = [(abs(t), c, s) for t, c, s in zip(terms, cosines, sines) if t is not None]
            re = abs(reference) + sum(t * c for t, c, _ in terms)
            im = sum(t * s for t, _, s in terms)
            return np.sqrt(re * re + im * im)

        yield modulus(a * sin_t * cos_r, x * cos_t * cos_r, y * sin_r, z * sin_t * cos_r)
        yield modulus(a * sin_t * sin_r, x * cos_t * sin_r, y * cos_r, z * sin_t * sin_r)
        yield modulus(a * cos_t, x * sin_t, None, z * cos_t)

    def trapezoid(self, lower, upper, inexactness, n):
        """JCGM 101, 6.4.3.4."""
        draw = self.generator
        a = draw.uniform(lower - inexactness, lower + inexactness, n)
        return a + (lower + upper - 2 * a) * draw.random(n)

    def block(self, n):
        np, draw = self.np, self.generator
        length = 50000623 + 25 * draw.standard_t(18, n)
        difference = 215 + 6 * draw.standard_t(24, n)
        difference += 4 * draw.standard_t(5, n)
        difference += 7 * draw.standard_t(8, n)
        standard = draw.uniform(9.5e-6, 13.5e-6, n)
        cycle = 0.5 * np.sin(draw.uniform(-math.pi, math.pi, n))
        temperature = draw.normal(-0.1, 0.2, n) + cycle
        expansion = self.trapezoid(-1e-6, 1e-6, 1e-7, n)
        apart = self.trapezoid(-0.05, 0.05, 0.025, n)
        measured = length * (1 + standard * (temperature - apart)) + difference
        return measured / (1 + (standard + expansion) * temperature) - 5e7

    def sum(self, count, half_width, centre, n):
        y = self.generator.uniform(centre - half_width, centre + half_width, n)
        for _ in range(count - 1):
            y += self.generator.uniform(centre - half_width, centre + half_width, n)
        return y

    def budgets(self, n):
        """All budgets at once: sensitivity coefficients by central differences."""
        np = self.np
        values = [np.full(n, centre) for centre in CENTRES]
        values[0] += STEP * np.arange(n)
        estimate = self.a_x(values)
        variance, fourth = np.zeros(n), np.zeros(n)
        for i, u in enumerate(STANDARD):
            at, h = values[i], 1e-3 * u
            values[i] = at + h
            above = self.a_x(values)
            values[i] = at - h
            contribution = (above - self.a_x(values)) * (u / (2 * h))
            values[i] = at
            variance += contribution**2
            if i in PHASES:
                fourth += contribution**4 / 4
        u, dof = np.sqrt(variance), variance**2 / fourth
        return [budget(estimate[i], u[i], dof[i]) for i in (0, -1)]

    def run(self, workload, n):
        if workload == "W1":
            return [sorted_figures(self.a_x(self.plane(CENTRES, n)))] * 2
        if workload == "W2":
            return [sorted_figures(self.sum(4, ROOT_3, 0.0, n))] * 2
        if workload == "W3":
            rows = []
            for centres in campaign():
                rows.append([sorted_figures(y) for y in self.axes(self.plane(centres, n))])
            return rows[0] + rows[-1]
        if workload == "W4":
            return [sorted_figures(self.block(n))] * 2
        if workload == "W5":
            return self.budgets(n)
        if workload.startswith("sum:"):
            return [sorted_figures(self.sum(int(workload[4:]), 0.1, 1.0, n))] * 2
        return None


# ------------------------------------------------------------------------------------------ numba


class Numba:
    """Compiled loops with numba's own random numbers, as its manual teaches them."""

    def __init__(self, threads):
        os.environ["NUMBA_NUM_THREADS"] = str(threads)
        import numba
        import numpy

        self.np, self.numba = numpy, numba
        self.compile()

    def compile(self):
        numba, np = self.numba, self.np
        sin, cos, sqrt, pi = math.sin, math.cos, math.sqrt, math.pi
        normal, uniform, student = np.random.normal, np.random.uniform, np.random.standard_t
        loop = numba.njit(parallel=True, fastmath=True)

        @numba.njit(fastmath=True, inline="always")
        def a_x(a, tilt, rotation, x, y, z, p, q, r):
            st, ct, sr, cr = sin(tilt), cos(tilt), sin(rotation), cos(rotation)
            x, y, z = abs(x * ct * cr), abs(y * sr), abs(z * st * cr)
            re = abs(a * st * cr) + x * cos(p) + y * cos(q) + z * cos(r)
            im = x * sin(p) + y * sin(q) + z * sin(r)
            return sqrt(re * re + im * im)

        @loop
        def plane(n, c, w):
            y = np.empty(n)
            for i in numba.prange(n):
                y[i] = a_x(
                    normal(c[0], w[0]),
                    uniform(c[1] - w[1], c[1] + w[1]),
                    uniform(c[2] - w[2], c[2] + w[2]),
                    uniform(c[3] - w[3], c[3] + w[3]),
                    uniform(c[4] - w[4], c[4] + w[4]),
                    uniform(c[5] - w[5], c[5] + w[5]),
                    normal(c[6], w[6]),
                    normal(c[7], w[7]),
                    normal(c[8], w[8]),
                )
            return y

        @loop
        def axes(n, c, w):
            out = np.empty((3, n))
            for i in numba.prange(n):
                a = normal(c[0], w[0])
                tilt = uniform(c[1] - w[1], c[1] + w[1])
                rotation = uniform(c[2] - w[2], c[2] + w[2])
                x = uniform(c[3] - w[3], c[3] + w[3])
                y = uniform(c[4] - w[4], c[4] + w[4])
                z = uniform(c[5] - w[5], c[5] + w[5])
                p, q, r = normal(c[6], w[6]), normal(c[7], w[7]), normal(c[8], w[8])
                st, ct, sr, cr = sin(tilt), cos(tilt), sin(rotation), cos(rotation)
                cp, cq, cz, sp, sq, sz = cos(p), cos(q), cos(r), sin(p), sin(q), sin(r)
                u, v, t = abs(x * ct * cr), abs(y * sr), abs(z * st * cr)
                re = abs(a * st * cr) + u * cp + v * cq + t * cz
                im = u * sp + v * sq + t * sz
                out[0, i] = sqrt(re * re + im * im)
                u, v, t = abs(x * ct * sr), abs(y * cr), abs(z * st * sr)
                re = abs(a * st * sr) + u * cp + v * cq + t * cz
                im = u * sp + v * sq + t * sz
                out[1, i] = sqrt(re * re + im * im)
                u, t = abs(x * st), abs(z * ct)
                re = abs(a * ct) + u * cp + t * cz
                im = u * sp + t * sz
                out[2, i] = sqrt(re * re + im * im)
            return out

        @loop
        def block(n):
            y = np.empty(n)
            for i in numba.prange(n):
                temperature = normal(-0.1, 0.2) + 0.5 * sin(uniform(-pi, pi))
                difference = 215 + 6 * student(24) + 4 * student(5) + 7 * student(8)
                standard = uniform(9.5e-6, 13.5e-6)
                a = uniform(-1.1e-6, -0.9e-6)
                expansion = a - 2 * a * uniform(0.0, 1.0)
                a = uniform(-0.075, -0.025)
                apart = a - 2 * a * uniform(0.0, 1.0)
                length = 50000623 + 25 * student(18)
                measured = length * (1 + standard * (temperature - apart)) + difference
                y[i] = measured / (1 + (standard + expansion) * temperature) - 5e7
            return y

        @loop
        def total(n, count, lower, upper):
            y = np.empty(n)
            for i in numba.prange(n):
                s = 0.0
                for _ in range(count):
                    s += uniform(lower, upper)
                y[i] = s
            return y

        @loop
        def budgets(n, centres, standard):
            out = np.empty((n, 3))
            for b in numba.prange(n):
                x = centres.copy()
                x[0] += STEP * b
                out[b, 0] = a_x(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8])
                variance, fourth = 0.0, 0.0
                for i in range(9):
                    at, h = x[i], 1e-3 * standard[i]
                    x[i] = at + h
                    above = a_x(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8])
                    x[i] = at - h
                    below = a_x(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8])
                    x[i] = at
                    contribution = (above - below) * standard[i] / (2 * h)
                    square = contribution * contribution
                    variance += square
                    if i >= 6:
                        fourth += square * square / 4
                out[b, 1], out[b, 2] = sqrt(variance), variance * variance / fourth
            return out

        self.plane, self.axes, self.block = plane, axes, block
        self.total, self.budgets = total, budgets

    figures = staticmethod(sorted_figures)

    def run(self, workload, n):
        np = self.np
        if workload == "W1":
            return [self.figures(self.plane(n, np.array(CENTRES), np.array(WIDTHS)))] * 2
        if workload == "W2":
            return [self.figures(self.total(n, 4, -ROOT_3, ROOT_3))] * 2
        if workload == "W3":
            rows = []
            for centres in campaign():
                axes = self.axes(n, np.array(centres), np.array(WIDTHS))
                rows.append([self.figures(y) for y in axes])
            return rows[0] + rows[-1]
        if workload == "W4":
            return [self.figures(self.block(n))] * 2
        if workload == "W5":
            rows = self.budgets(n, np.array(CENTRES), np.array(STANDARD))
            return [budget(*rows[i]) for i in (0, -1)]
        if workload.startswith("sum:"):
            return [self.figures(self.total(n, int(workload[4:]), 0.9, 1.1))] * 2
        return None


class NumbaTuned(Numba):
    """What somebody who knows the machine makes of numba: loops that the compiler can turn into
    vector code, over blocks that stay in the cache. W1, W2 and sums."""

    BLOCK = 2048

    def compile(self):
        numba, np, size = self.numba, self.np, self.BLOCK
        sin, cos, sqrt, log = math.sin, math.cos, math.sqrt, math.log
        turn = 2 * math.pi
        fast = numba.njit(fastmath=True, error_model="numpy")
        loop = numba.njit(parallel=True, fastmath=True, error_model="numpy")

        @fast
        def uniform(out, stream, first):
            # a counter through the finaliser of splitmix64, a stream for each input
            key = np.uint64(stream + 1) * np.uint64(0xD1342543DE82EF95)
            for i in range(size):
                z = np.uint64(first + i) * np.uint64(0x9E3779B97F4A7C15) + key
                z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
                z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
                z ^= z >> np.uint64(31)
                out[i] = (np.float64(np.int64(z >> np.uint64(12))) + 0.5) * 2.0**-52

        @fast
        def normal(one, two):
            # both of a pair are used
            for i in range(size):
                radius, angle = sqrt(-2 * log(one[i])), turn * two[i]
                one[i], two[i] = radius * cos(angle), radius * sin(angle)

        @fast
        def model(v, c, w, out):
            for i in range(size):
                tilt = c[1] + w[1] * (2 * v[4, i] - 1)
                rotation = c[2] + w[2] * (2 * v[5, i] - 1)
                st, ct, sr, cr = sin(tilt), cos(tilt), sin(rotation), cos(rotation)
                x = abs((c[3] + w[3] * (2 * v[6, i] - 1)) * ct * cr)
                y = abs((c[4] + w[4] * (2 * v[7, i] - 1)) * sr)
                z = abs((c[5] + w[5] * (2 * v[8, i] - 1)) * st * cr)
                p, q, r = c[6] + w[6] * v[1, i], c[7] + w[7] * v[2, i], c[8] + w[8] * v[3, i]
                re = abs((c[0] + w[0] * v[0, i]) * st * cr) + x * cos(p) + y * cos(q) + z * cos(r)
                im = x * sin(p) + y * sin(q) + z * sin(r)
                out[i] = sqrt(re * re + im * im)

        @loop
        def plane(n, c, w):
            blocks = (n + size - 1) // size
            y = np.empty(blocks * size)
            for b in numba.prange(blocks):
                v = np.empty((9, size))
                for k in range(9):
                    uniform(v[k], k, b * size)
                normal(v[0], v[1])
                normal(v[2], v[3])
                model(v, c, w, y[b * size : (b + 1) * size])
            return y[:n]

        @loop
        def total(n, count, lower, upper):
            blocks = (n + size - 1) // size
            y = np.empty(blocks * size)
            for b in numba.prange(blocks):
                v, s = np.empty(size), np.zeros(size)
                for k in range(count):
                    uniform(v, k, b * size)
                    for i in range(size):
                        s[i] += lower + (upper - lower) * v[i]
                y[b * size : (b + 1) * size] = s
            return y[:n]

        @loop
        def moments(y):
            s = 0.0
            for i in numba.prange(y.size):
                s += y[i]
            mean, squares = s / y.size, 0.0
            for i in numba.prange(y.size):
                squares += (y[i] - mean) ** 2
            return mean, sqrt(squares / (y.size - 1))

        self.plane, self.total, self.moments = plane, total, moments

    def figures(self, y):
        mean, u = self.moments(y)
        y.sort()
        _, q = ranks(y.size)
        return figures(mean, u, y[: y.size - q], y[q:], y.size)

    def run(self, workload, n):
        tuned = workload in ("W1", "W2") or workload.startswith("sum:")
        return super().run(workload, n) if tuned else None


class NumbaPartition(NumbaTuned):
    def figures(self, y):
        mean, u = self.moments(y)
        _, q = ranks(y.size)
        y.partition((y.size - q - 1, q))
        lower, upper = y[: y.size - q], y[q:]
        lower.sort()
        upper.sort()
        return figures(mean, u, lower, upper, y.size)


# -------------------------------------------------------------------------------------------- GTC


class Gtc:
    def __init__(self, threads):
        import GTC

        self.gtc = GTC

    def run(self, workload, n):
        if workload != "W5":
            return None
        gtc = self.gtc
        sin, cos, sqrt, modulus = gtc.sin, gtc.cos, gtc.sqrt, gtc.magnitude
        done = []
        for i in range(n):
            dof = [4 if j in PHASES else math.inf for j in range(9)]
            inputs = [gtc.ureal(c, u, d) for c, u, d in zip(CENTRES, STANDARD, dof)]
            inputs[0] = gtc.ureal(CENTRES[0] + STEP * i, STANDARD[0])
            a, tilt, rotation, x, y, z, p, q, r = inputs
            st, ct, sr, cr = sin(tilt), cos(tilt), sin(rotation), cos(rotation)
            x, y, z = modulus(x * ct * cr), modulus(y * sr), modulus(z * st * cr)
            re = modulus(a * st * cr) + x * cos(p) + y * cos(q) + z * cos(r)
            im = x * sin(p) + y * sin(q) + z * sin(r)
            result = sqrt(re * re + im * im)
            for value in inputs:
                gtc.component(result, value)
            if i in (0, n - 1):
                done.append(budget(result.x, result.u, result.df))
        return done


# ------------------------------------------------------------------------------------ measurement

TOOLS = {
    "numpy": Numpy,
    "numba": Numba,
    "numba-tuned": NumbaTuned,
    "numba-partition": NumbaPartition,
    "gtc": Gtc,
}


def peak():
    """The most memory held so far, in MB (1e6 bytes)."""
    try:
        with open("/proc/self/status", encoding="ascii") as status:
            for line in status:
                if line.startswith("VmHWM:"):
                    return int(line.split()[1]) * 1024 / 1e6
    except OSError:
        pass
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tool", choices=TOOLS, required=True)
    parser.add_argument("--workload", required=True)
    parser.add_argument("--trials", type=float, default=1e6)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--on-demand", action="store_true")
    arguments = parser.parse_args()
    for library in ("OMP", "OPENBLAS", "MKL"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    tool, workload = TOOLS[arguments.tool](arguments.threads), arguments.workload
    n = int(arguments.trials)
    warm_up = {"W3": 1000, "W5": 10}.get(workload, 20000)
    if tool.run(workload, min(warm_up, n)) is None:
        sys.exit(f"{arguments.tool} does not do {workload}")
    before = peak()
    cpu, wall, result = [], [], None

    def repeat():
        nonlocal result
        clock, start = time.process_time(), time.perf_counter()
        result = tool.run(workload, n)
        cpu.append(time.process_time() - clock)
        wall.append(time.perf_counter() - start)

    if arguments.on_demand:
        print("ready", flush=True)
        for _ in sys.stdin:
            repeat()
            print("done", flush=True)
    else:
        for _ in range(arguments.repeats):
            repeat()
    line = {
        "tool": arguments.tool,
        "workload": workload,
        "trials": n,
        "threads": arguments.threads,
        "cpu_s": cpu,
        "wall_s": wall,
        "before_mb": before,
        "peak_mb": peak(),
        "result": result,
    }
    print(json.dumps(line))


if __name__ == "__main__":
    main()
