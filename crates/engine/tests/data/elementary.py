"""Write elementary.csv, the reference table of src/number/elementary.rs.

Needs mpmath 1.3. Run without arguments; the table is written beside this file and does not change
from run to run.

Columns: function; argument and, for functions of two arguments, second argument, as the
hexadecimal bits of a double; the double nearest the exact result, likewise; and the exact result
less that double, in ulp. One ulp is the spacing of doubles from the power of two at or below the
exact result upwards, and 2^-1074 where the result is subnormal. An infinite or NaN result has the
residual 0.
"""

import math
import pathlib
import random
import struct

import mpmath

mpmath.mp.prec = 1400  # Enough for sin and cos of the largest double.

SEED = 20240229
random_source = random.Random(SEED)
uniform = random_source.uniform


def bits(x):
    return struct.unpack("<Q", struct.pack("<d", x))[0]


def double(b):
    return struct.unpack("<d", struct.pack("<Q", b))[0]


def scaled(low, high):
    """A positive number with a binary exponent drawn from low..=high."""
    return math.ldexp(uniform(1.0, 2.0), random_source.randint(low, high))


def draw(count, generator):
    return [generator() for _ in range(count)]


def neighbours(x):
    return [math.nextafter(x, -math.inf), x, math.nextafter(x, math.inf)]


def nearest(exact):
    """The double nearest an exact finite number, ties to even."""
    if exact == 0:
        return 0.0
    exponent = max(mpmath.frexp(exact)[1] - 53, -1074)
    count = int(mpmath.nint(mpmath.ldexp(exact, -exponent)))
    try:
        return math.ldexp(count, exponent)
    except OverflowError:
        return math.copysign(math.inf, count)


def residual(exact, reference):
    if exact == 0 or math.isinf(reference):
        return 0.0
    exponent = max(mpmath.frexp(exact)[1] - 53, -1074)
    return float(mpmath.ldexp(exact - mpmath.mpf(reference), -exponent))


def turn(function):
    return lambda u: function(2 * mpmath.pi * u)


def cube_root(x):
    return mpmath.sign(x) * mpmath.cbrt(abs(x))


FUNCTIONS = {
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "sin_turn": turn(mpmath.sin),
    "cos_turn": turn(mpmath.cos),
    "exp": mpmath.exp,
    "ln": mpmath.log,
    "tan": mpmath.tan,
    "asin": mpmath.asin,
    "acos": mpmath.acos,
    "atan": mpmath.atan,
    "atan2": mpmath.atan2,
    "sinh": mpmath.sinh,
    "cosh": mpmath.cosh,
    "tanh": mpmath.tanh,
    "log10": mpmath.log10,
    "cbrt": cube_root,
    "hypot": mpmath.hypot,
    "pow": mpmath.power,
}

HALF_PI_MULTIPLES = [1, 2, 3, 4, 11, 22, 355, 710, 12345, 42781, 63661]
ANGLES = (
    [1e-300, -1e-20, 5e-324, 1e-8, 0.5, 1.0, -2.0, 3.0, 1e5, -1e5, math.nextafter(1e5, 2e5)]
    + [1e6, -1e10, 1e22, 1.7976931348623157e308, math.pi / 4, 3 * math.pi / 4]
    + [float(mpmath.pi / 2 * k) for k in HALF_PI_MULTIPLES]
    + draw(12, lambda: uniform(-math.pi, math.pi))
    + draw(8, lambda: uniform(-100.0, 100.0))
    + draw(8, lambda: uniform(-1e5, 1e5))
)
TURNS = (
    [2.0**-54, 1e-10, 0.125, 0.375, 0.625, 0.875, 1.0 - 2.0**-53]
    + [x for quarter in (0.25, 0.5, 0.75) for x in neighbours(quarter) if x != quarter]
    + draw(17, lambda: uniform(0.0, 1.0))
)
EXPONENTS = (
    [1e-300, -1e-20, 1e-9, 1.0, -1.0, 0.34657, -0.34658, 709.0, 710.0, 800.0, -708.0, -720.5]
    + neighbours(709.782712893384)
    + [-708.3964185322641, -745.0, -745.13, -745.14, -746.5, -1000.0]
    + draw(15, lambda: uniform(-2.0, 2.0))
    + draw(8, lambda: uniform(-50.0, 50.0))
    + draw(8, lambda: uniform(-708.0, 709.0))
    + draw(6, lambda: uniform(-745.0, -708.0))
)
POSITIVE = (
    [5e-324, 1e-310, 2.2250738585072014e-308, 1.7976931348623157e308, 2.0, 0.5, 10.0, math.e]
    + neighbours(1.0)
    + neighbours(math.sqrt(0.5))
    + neighbours(math.sqrt(2.0))
    + [2.0**-54, 0.999, 1.001]
    + draw(12, lambda: uniform(0.9, 1.1))
    + draw(10, lambda: uniform(0.0, 3.0))
    + draw(8, lambda: scaled(-1022, 1023))
    + draw(4, lambda: double(random_source.randint(1, 2**52)))
)
ONE_ARGUMENT = {
    "sin": ANGLES,
    "cos": ANGLES,
    "sin_turn": TURNS,
    "cos_turn": TURNS,
    "exp": EXPONENTS,
    "ln": POSITIVE,
    "tan": [1e-300, 0.5, 1.5, 1e6] + draw(6, lambda: uniform(-10.0, 10.0)),
    "asin": [1e-300, 1.0, -1.0] + draw(7, lambda: uniform(-1.0, 1.0)),
    "acos": [1e-300, 1.0, -1.0] + draw(7, lambda: uniform(-1.0, 1.0)),
    "atan": [1e-300, 1.0, 1e300] + draw(7, lambda: uniform(-10.0, 10.0)),
    "sinh": [1e-300, 710.0, 800.0] + draw(7, lambda: uniform(-10.0, 10.0)),
    "cosh": [1e-300, 710.0, 800.0] + draw(7, lambda: uniform(-10.0, 10.0)),
    "tanh": [1e-300, 30.0, -0.23041536662615103] + draw(7, lambda: uniform(-3.0, 3.0)),
    "log10": [5e-324, 1.0, 1000.0] + draw(7, lambda: uniform(0.0, 10.0)),
    "cbrt": [5e-324, -27.0, 1e300] + draw(7, lambda: uniform(-10.0, 10.0)),
}
TWO_ARGUMENTS = {
    "atan2": [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (2.0, 1e-300)]
    + draw(8, lambda: (uniform(-5.0, 5.0), uniform(-5.0, 5.0))),
    "hypot": [(3.0, 4.0), (1e300, 1e300), (1e-300, 2e-300)]
    + draw(7, lambda: (uniform(-5.0, 5.0), uniform(-5.0, 5.0))),
    "pow": [(2.0, 10.0), (-2.0, 3.0), (10.0, -320.0), (2.0, 1024.0), (1.0000001, 1e9)]
    + draw(7, lambda: (uniform(0.0, 5.0), uniform(-20.0, 20.0))),
}


def row(function, arguments):
    exact = FUNCTIONS[function](*map(mpmath.mpf, arguments))
    reference = nearest(exact)
    fields = [f"{bits(x):016x}" for x in arguments] + [""] * (2 - len(arguments))
    rest = [f"{bits(reference):016x}", f"{residual(exact, reference):.9f}"]
    return ",".join([function, *fields, *rest])


def main():
    lines = ["function,x,y,reference,residual"]
    for function, points in ONE_ARGUMENT.items():
        lines += [row(function, (x,)) for x in points]
    for function, points in TWO_ARGUMENTS.items():
        lines += [row(function, point) for point in points]
    path = pathlib.Path(__file__).with_suffix(".csv")
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


if __name__ == "__main__":
    main()
