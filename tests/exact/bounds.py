#!/usr/bin/env python3
"""Whether the bounds of exact figures hold: reads the lines of `exact_models` and computes the
distribution function at each figure with 30 digits (mpmath), by Gauss-Legendre quadrature of the
inversion integral over panels that shrink towards 0.

    cargo run -p gumption-engine --example exact_models -- 200 | python3 tests/exact/bounds.py
"""
import json
import sys

import mpmath as mp

mp.mp.dps = 30


def characteristic(term):
    kind, *p = term
    p = [mp.mpf(x) for x in p]
    if kind == "normal":
        return lambda t: mp.exp(-(p[0] * t) ** 2 / 2)
    if kind == "rectangular":
        return lambda t: mp.sinc(p[0] * t)
    if kind == "t":
        nu = p[1]

        def student(t):
            x = mp.sqrt(nu) * p[0] * t
            return x ** (nu / 2) * mp.besselk(nu / 2, x) / (mp.gamma(nu / 2) * 2 ** (nu / 2 - 1))

        return student
    if kind == "arcsine":
        return lambda t: mp.besselj(0, p[0] * t)
    if kind == "trapezoid":
        w, beta = p
        return lambda t: mp.sinc(w * (1 + beta) / 2 * t) * mp.sinc(w * (1 - beta) / 2 * t)
    if kind == "triangle":
        w, mode = p
        rise, fall = mode + w, w - mode

        def triangle(t):
            def h(x):
                return (1 + 1j * x - mp.exp(1j * x)) / x**2 if abs(x) > mp.mpf("1e-8") else (
                    mp.mpf(1) / 2 + 1j * x / 6 - x**2 / 24 - 1j * x**3 / 120)

            about = 2 / (rise + fall) * (rise * h(-t * rise) + fall * h(t * fall))
            return about * mp.exp(1j * t * mode)

        return triangle
    if kind == "curvilinear":
        w, d = p
        return lambda t: (mp.si((w + d) * t) - mp.si((w - d) * t)) / (2 * d * t)
    if kind == "gamma":
        k, rate = p
        return lambda t: (1 - 1j * t / rate) ** (-k)
    raise ValueError(kind)


def envelope(term, t):
    """About how large the modulus is at t."""
    kind, *p = term
    p = [mp.mpf(x) for x in p]
    of = {
        "rectangular": lambda: min(1, 1 / (p[0] * t)),
        "arcsine": lambda: min(1, 1 / mp.sqrt(p[0] * t)),
        "trapezoid": lambda: min(1, 4 / ((p[0] * t) ** 2 * (1 - p[1] ** 2))),
        "triangle": lambda: min(1, 4 / ((p[0] + p[1]) * (p[0] - p[1]) * t**2)),
        "curvilinear": lambda: min(1, 1 / ((p[0] - p[1]) * p[1] * t**2)),
    }.get(kind)
    return of() if of else abs(characteristic(term)(t))


def main():
    checked = broken = refused = skipped = 0
    worst = 0
    x20 = mp.calculus.quadrature.GaussLegendre(mp.mp).calc_nodes(4, 110)
    for line in sys.stdin:
        model = json.loads(line)
        if "why" in model:
            refused += 1
            continue
        terms = model["terms"]
        phis = [characteristic(term) for term in terms]
        last = mp.mpf(1)
        size = lambda t: mp.fprod(envelope(term, t) for term in terms)
        while size(last) > mp.mpf("1e-18") and last < 40000:
            last *= 1.2
        figures = [(model["low"], mp.mpf("0.025")), (model["median"], mp.mpf("0.5")), (model["high"], mp.mpf("0.975"))]
        reach = sum(abs(mp.mpf(term[1])) if term[0] != "gamma" else (mp.mpf(term[1]) + 3) / mp.mpf(term[2]) for term in terms)
        reach += max(abs(mp.mpf(x)) for x, _ in figures)
        panel = 12 / reach
        if last / panel > 400:
            skipped += 1
            continue
        panels = [(panel * mp.mpf(4) ** -(k + 1), panel * mp.mpf(4) ** -k) for k in range(40)]
        at = panel
        while at < last:
            panels.append((at, at + panel))
            at += panel
        sums = [mp.mpf(0)] * 3
        densities = [mp.mpf(0)] * 3
        for a, b in panels:
            for x, w in x20:
                t = (a + b) / 2 + (b - a) / 2 * x
                weight = w * (b - a) / 2 / mp.pi
                phi = mp.fprod(f(t) for f in phis)
                for i, (y, _) in enumerate(figures):
                    value = phi * mp.exp(-1j * t * mp.mpf(y))
                    sums[i] += weight * mp.im(value) / t
                    densities[i] += weight * mp.re(value)
        checked += 1
        for (y, p), s, f in zip(figures, sums, densities):
            off = abs((mp.mpf(1) / 2 - s - p) / f)
            ratio = off / mp.mpf(model["bound"])
            worst = max(worst, ratio)
            if ratio > 1:
                broken += 1
                print("broken", mp.nstr(ratio, 4), y, line.strip())
        print(checked, mp.nstr(worst, 3), flush=True, file=sys.stderr)
    print(f"checked {checked}, broken {broken}, largest share of a bound {mp.nstr(worst, 3)}, refused {refused}, too long for this script {skipped}")
    return 1 if broken else 0


sys.exit(main())
