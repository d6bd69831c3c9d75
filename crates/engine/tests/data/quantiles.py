#!/usr/bin/env python3
"""Writes quantiles.csv: reference values of distribution functions and quantiles.

Each row has the name of a function, its arguments (the shortest decimals that give the doubles)
and the value of the function at exactly these doubles, to 25 digits. Distribution functions are
sums of positive terms with at least 40 digits left after any subtraction; quantiles are bracketed
roots of these, checked by the signs on both sides of the last digit written.

Needs Python 3 with mpmath 1.3. Run: python3 quantiles.py > quantiles.csv
"""

import random
import sys

from mpmath import mp, mpf

DIGITS = 40


def series(ratio, first):
    """The sum of positive terms from `first` on, `ratio(k)` being that of terms k + 1 and k."""
    total = term = first
    k = 0
    while True:
        step = ratio(k)
        term *= step
        total += term
        k += 1
        if step < 1 and term < total * (1 - step) * mpf(10) ** -(mp.dps + 3):
            return total


def complement(direct, *args):
    """1 - direct(*args), with enough digits for the difference; 1e-1000 for less than that, which
    only the search for a bracket meets."""
    digits = mp.dps
    extra = 10
    while extra < 1500:
        with mp.workdps(digits + extra):
            rest = 1 - direct(*args)
            if rest > mpf(10) ** (8 - extra):
                return rest
        extra *= 2
    return mpf(10) ** -1000


def guarded(function):
    """`function` with digits in hand for shapes up to the largest argument."""

    def inner(*args):
        largest = max(abs(mpf(a)) for a in args if mp.isfinite(a))
        smallest = min(abs(mpf(a)) for a in args if a != 0)
        guard = int(mp.log10(largest + 1)) * 2 + max(0, int(-mp.log10(smallest)))
        digits = mp.dps
        with mp.workdps(digits + guard + 10):
            return function(*args)

    return inner


# Incomplete gamma.


@guarded
def gamma_series(x, a):
    weight = mp.exp(a * mp.log(x) - x - mp.loggamma(a + 1))
    return series(lambda k: x / (a + 1 + k), weight)


def gamma_cdf(x, a):
    if x < a + 10 * mp.sqrt(a) + 10:
        return gamma_series(x, a)
    return complement(gamma_sf, x, a)


@guarded
def gamma_fraction(x, a):
    """Q(a, x) by its continued fraction, backwards from a depth that is doubled until it holds."""
    weight = mp.exp(a * mp.log(x) - x - mp.loggamma(a))
    last, depth = None, 64
    while True:
        tail = mpf(0)
        for k in range(depth, 0, -1):
            tail = k * (k - a) / (x + 2 * k + 1 - a - tail)
        value = weight / (x + 1 - a - tail)
        if last is not None and abs(value - last) < abs(value) * mpf(10) ** -(mp.dps - 8):
            return value
        last, depth = value, depth * 2


def gamma_sf(x, a):
    if x > a + 10 * mp.sqrt(a) + 10:
        return gamma_fraction(x, a)
    return complement(gamma_series, x, a)


# Incomplete beta.


@guarded
def beta_series(x, y, a, b):
    log_beta = mp.loggamma(a) + mp.loggamma(b) - mp.loggamma(a + b)
    weight = mp.exp(a * mp.log(x) + b * mp.log(y) - log_beta) / a
    return series(lambda k: x * (a + b + k) / (a + 1 + k), weight)


def beta_mass(odds, a, b, upper):
    """I_x(a, b) or 1 - I_x(a, b) for x / (1 - x) = odds(), which is evaluated anew for every
    number of digits."""
    value = odds()
    if value > 1:
        return beta_mass(lambda: 1 / odds(), b, a, not upper)

    def direct():
        with mp.workdps(mp.dps + int(-mp.log10(value)) + 10):
            x, y = odds() / (1 + odds()), 1 / (1 + odds())
            return beta_series(x, y, a, b)

    return complement(direct) if upper else direct()


def beta_cdf(x, a, b):
    return beta_mass(lambda: x / (1 - x), a, b, False)


def beta_sf(x, a, b):
    return beta_mass(lambda: x / (1 - x), a, b, True)


# Student's t.


def student_two_sided(t, dof, outer):
    """P(|T| > t) or P(|T| <= t)."""
    if mp.isinf(dof):
        return mp.erfc(t / mp.sqrt(2)) if outer else mp.erf(t / mp.sqrt(2))
    return beta_mass(lambda: t * t / dof, mpf(1) / 2, dof / 2, outer)


def student_sf(t, dof):
    if t > 0:
        return student_two_sided(t, dof, True) / 2
    return mpf(1) / 2 + (student_two_sided(-t, dof, False) / 2 if t < 0 else 0)


def student_cdf(t, dof):
    return student_sf(-t, dof)


# Normal.


def normal_sf(x):
    return mp.erfc(x / mp.sqrt(2)) / 2


def normal_cdf(x):
    return normal_sf(-x)


# Inverses.


def root(function, target, start=1, step=1):
    """The x > 0 with function(x) = target for a monotone positive function: a bracket from `start`
    outwards with growing steps, bisection, then the secant method, all of ln f over ln x."""

    def f(w):
        return mp.log(function(mp.exp(w)) / target)

    with mp.workdps(mp.dps + 10):
        nudge = mp.exp(step * mpf("0.01"))
        rising = function(start * nudge) > function(start / nudge)

    def below(value):
        return (value < 0) == rising

    low = high = mp.log(start)
    outward = mpf(step)
    if below(f(low)):
        while below(f(high)):
            low, high, outward = high, high + outward, outward * 2
    else:
        while not below(f(low)):
            low, high, outward = low - outward, low, outward * 2
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (middle, high) if below(f(middle)) else (low, middle)
    a, b = low, high
    fa, fb = f(a), f(b)
    while abs(b - a) > mpf(10) ** -36 and fb != 0 and fa != fb:
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        fb = f(b)
    margin = mpf(10) ** -27
    assert below(f(b - margin)) and not below(f(b + margin)), (function, target)
    return mp.exp(b)


def normal_quantile_upper(q):
    if q == mpf(1) / 2:
        return mpf(0)
    if q > mpf(1) / 2:
        return -normal_quantile_upper(1 - q)
    with mp.workdps(60):
        if q > 0.25:
            return root(lambda x: mp.erf(x / mp.sqrt(2)), 1 - 2 * q)
        return root(normal_sf, q)


def normal_quantile(p):
    with mp.workdps(400):
        q = 1 - p
    return normal_quantile_upper(q)


def student_magnitude(inner, outer, dof):
    if inner <= outer:
        return root(lambda t: student_two_sided(t, dof, False), inner)
    return root(lambda t: student_two_sided(t, dof, True), outer)


def student_quantile(p, dof):
    with mp.workdps(400):
        q = 1 - p
        inner, outer = abs(p - q), 2 * min(p, q)
    if inner == 0:
        return mpf(0)
    return student_magnitude(inner, outer, dof) * (1 if p > q else -1)


def student_factor(p, dof):
    with mp.workdps(400):
        q = 1 - p
    return student_magnitude(p, q, dof)


def gamma_quantile(p, a):
    step = 1 / mp.sqrt(a)
    if p <= mpf(1) / 2:
        return root(lambda x: gamma_cdf(x, a), p, a, step)
    return root(lambda x: gamma_sf(x, a), 1 - p, a, step)


def beta_quantile(p, a, b):
    # The root in terms of the odds x / (1 - x), which have the whole of the positive numbers.
    upper = p > mpf(1) / 2
    target = 1 - p if upper else p
    step = mp.sqrt(1 / a + 1 / b)
    odds = root(lambda o: beta_mass(lambda: o, a, b, upper), target, a / b, step)
    return odds / (1 + odds)


FUNCTIONS = {
    "normal_cdf": normal_cdf,
    "normal_sf": normal_sf,
    "normal_quantile": normal_quantile,
    "normal_quantile_upper": normal_quantile_upper,
    "student_cdf": student_cdf,
    "student_sf": student_sf,
    "student_quantile": student_quantile,
    "student_factor": student_factor,
    "gamma_cdf": gamma_cdf,
    "gamma_sf": gamma_sf,
    "gamma_quantile": gamma_quantile,
    "beta_cdf": beta_cdf,
    "beta_sf": beta_sf,
    "beta_quantile": beta_quantile,
}


def write(name, *args):
    mp.dps = DIGITS
    value = FUNCTIONS[name](*(mpf(a) for a in args))
    fields = [repr(a) for a in args] + [""] * (3 - len(args))
    print(",".join([name] + fields + [mp.nstr(value, 25)]), flush=True)


def main():
    print("function,first,second,third,value")
    inf = float("inf")

    for x in (-38.4, -37.0, -20.5, -8.3, -3.0, -1.96, -0.7, -1e-9, 0.3, 1.0, 2.5, 8.0):
        write("normal_cdf", x)
    for x in (-2.5, -1e-300, 0.45, 1.0, 2.0, 3.9, 6.1, 12.7, 27.3, 37.5):
        write("normal_sf", x)
    for p in (1e-300, 1e-100, 2.3e-16, 1e-12, 1e-5, 0.0250, 0.0749, 0.0751, 0.2, 0.4999999999,
              0.5 + 2**-50, 0.6, 0.9249, 0.9251, 0.975, 0.99999, 1 - 2**-40, 1 - 2**-53):
        write("normal_quantile", p)
    for q in (5e-324, 1e-310, 3e-290, 1e-200, 1.4e-11, 1.3e-11, 1e-9, 0.0228, 0.3, 0.7, 0.999999):
        write("normal_quantile_upper", q)

    for dof in (0.1, 0.5, 1.0, 1.7, 2.0, 3.0, 5.5, 15.9, 16.1, 40.0, 1e3, 1e6, 1e9, 1e12):
        for t in (-1e-9, -0.8, -2.3, -6.5):
            write("student_cdf", t, dof)
    for t, dof in ((1e100, 0.1), (1e30, 0.5), (1e12, 1.0), (1e5, 3.3), (300.0, 7.0), (37.0, 60.0),
                   (30.0, 1e5), (0.5, 4.0), (1e-200, 2.5), (-1e4, 3.0), (2.0, 9.99e19)):
        write("student_sf", t, dof)
    for dof in (0.1, 0.5, 0.99, 1.0, 2.0, 2.7, 4.0, 16.5, 100.0, 1e4, 1e6, 1e9, 1e12, 1e19, inf):
        for p in (1e-12, 0.025, 0.4999, 1 - 1e-9):
            write("student_quantile", p, dof)
    for dof in (0.3, 1.0, 1.5, 2.0, 3.0, 8.0, 12.3, 50.0, 1e3, 1e7, 1e15, 1e300):
        for p in (1e-12, 0.5, 0.9545, 1 - 1e-12):
            write("student_factor", p, dof)

    for a in (1e-3, 0.05, 0.7, 1.0, 2.5, 7.9, 8.1, 30.0, 1e3, 1e5):
        for z in (-6.0, -0.5, 0.4, 5.0):
            # About z standard deviations from the mean, on the scale of Wilson and Hilferty.
            x = a * max(1 - 1 / (9 * a) + z / (3 * a**0.5), 0.01) ** 3
            write("gamma_cdf" if z < 0 else "gamma_sf", x, a)
    for x, a in ((0.9999, 0.5), (1.0001, 0.5), (1.0001, 1e-3), (1e-30, 1e-3), (5.0, 0.05),
                 (600.0, 2.0), (1e-20, 9.0), (10001234.5, 1e7), (9990000.0, 1e7)):
        write("gamma_sf", x, a)
        if x < 100:
            write("gamma_cdf", x, a)
    for a in (0.02, 0.5, 1.0, 3.3, 12.0, 250.0, 1e5):
        for p in (1e-9, 0.025, 0.6, 1 - 1e-10):
            write("gamma_quantile", p, a)
    for p, a in ((0.5, 1e-3), (0.999, 1e-3), (0.025, 1e7), (0.9, 1e7)):
        write("gamma_quantile", p, a)

    draw = random.Random(1)
    shapes = (0.05, 0.5, 0.9, 1.0, 2.0, 7.9, 8.1, 60.0, 1e4, 1e6)
    for a in shapes:
        for b in draw.sample(shapes, 4):
            spread = (a * b / (a + b + 1)) ** 0.5 / (a + b)
            x = min(max(a / (a + b) + draw.uniform(-3, 3) * spread, 1e-3 * a / (a + b)), 0.999)
            write("beta_cdf" if x < a / (a + b) else "beta_sf", x, a, b)
    for x, a, b in ((1e-250, 0.05, 3.0), (1e-7, 0.5, 1e6), (2e-5, 0.5, 1e6), (0.25, 0.05, 0.05),
                    (0.6, 20.0, 0.3), (0.99, 20.0, 0.3), (0.4995, 1e6, 1e6), (0.3, 50.0, 60.0)):
        write("beta_cdf", x, a, b)
        write("beta_sf", x, a, b)
    for a in (0.05, 0.5, 1.0, 3.7, 25.0, 1e3, 1e6):
        for b in draw.sample((0.3, 0.5, 1.0, 2.0, 9.0, 400.0, 1e6), 4):
            write("beta_quantile", draw.choice((1e-9, 0.025, 0.3, 0.8, 0.9999)), a, b)


if __name__ == "__main__":
    sys.exit(main())
