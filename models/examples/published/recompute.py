"""Values of the measurements in this folder, from their inputs, by other programs than gumption.

    pip install GTC numpy scipy
    python3 recompute.py > expected.json

GTC (MSL New Zealand) propagates uncertainties by automatic differentiation, with degrees of freedom;
numpy and scipy fit curves and draw trials. What a document prints stands in `PUBLISHED`, with half a
unit of its last digit as tolerance unless a reason is given; values and tolerances are in the unit of
the output. Nothing in this file knows gumption.
"""

import json
import math

import numpy as np
import scipy.optimize
from GTC import cos, exp, get_correlation, inf, log, log10, multiple_ureal, set_correlation, sin, sqrt
from GTC import type_a, type_b, ucomplex, ureal

HALF = "half a unit of the last printed digit"
rect, tri, arcsine = type_b.uniform, type_b.triangular, type_b.arcsine
found, sources = {}, {}


def published(name, source, *rows, notes=""):
    """What a document prints: (output, path, value, tolerance[, why])."""
    entry = found.setdefault(name, {"source": source, "published": [], "recomputed": [], "notes": ""})
    entry["notes"] = notes
    for output, path, value, tolerance, *why in rows:
        entry["published"].append(dict(
            output=output, path=path, value=value, tolerance=tolerance, why=why[0] if why else HALF))


def recomputed(name, source, output, y, by="GTC", scale=1.0, offset=0.0, dof=True, rounding=1e-9):
    """Estimate, standard uncertainty and degrees of freedom of an uncertain number."""
    entry = found.setdefault(name, {"source": source, "published": [], "recomputed": [], "notes": ""})
    x, u, nu = y.x * scale + offset, y.u * scale, y.df
    why = f"{by}, double precision"
    values = [("gum.estimate", x, rounding * u), ("gum.standard_uncertainty", u, rounding * u)]
    if dof:
        values.append(("gum.dof", None if math.isinf(nu) or nu > 1e9 else nu, 1e-7 * min(nu, 1e9)))
    for path, value, tolerance in values:
        if value is None:
            tolerance = 0.0
        entry["recomputed"].append(dict(
            output=output, path=path, value=value, tolerance=tolerance, why=why))


def number(name, output, path, value, tolerance, why):
    found[name]["recomputed"].append(
        dict(output=output, path=path, value=float(value), tolerance=float(tolerance), why=why))


# JCGM 100, H.1
NAME = "gum-h1-end-gauge"
published(NAME, "JCGM 100:2008, H.1",
          ("l", "gum.estimate", 50.000838, 5e-7), ("l", "gum.standard_uncertainty", 32e-6, 0.5e-6),
          ("l", "gum.dof", 16.7, 0.06, "printed 16.7, of rounded contributions; k is taken at 16"),
          ("l", "gum.coverage_factor", 2.92, 0.005), ("l", "gum.expanded_uncertainty", 93e-6, 0.6e-6, "printed is 2.92 times the rounded 32 nm"),
          notes="The GUM gives 34 nm with terms of second order (H.1.7), which the Monte Carlo evaluation has.")
l_S = ureal(50.000623, 25e-6, 18)
d = ureal(215e-6, 13e-6 / math.sqrt(5), 24) + ureal(0, 3.9e-6, 5) + ureal(0, 6.7e-6, 8)
alpha = ureal(11.5e-6, rect(2e-6))
theta = ureal(-0.1, 0.2) + ureal(0, arcsine(0.5))
dalpha, dtheta = ureal(0, rect(1e-6), 50), ureal(0, rect(0.05), 2)
recomputed(NAME, "", "l", l_S + d - l_S * (dalpha * theta + alpha * dtheta))

# JCGM 100, H.3
NAME = "gum-h3-thermometer-line"
published(NAME, "JCGM 100:2008, H.3",
          (None, "fits.line.coefficients.a.estimate", -0.1712, 5e-5),
          (None, "fits.line.coefficients.a.standard_uncertainty", 0.0029, 5e-5),
          (None, "fits.line.coefficients.b.estimate", 0.00218, 5e-6),
          (None, "fits.line.coefficients.b.standard_uncertainty", 0.00067, 5e-6),
          (None, "fits.line.residual_standard_deviation", 0.0035, 5e-5),
          ("b", "gum.estimate", -0.1494, 5e-5), ("b", "gum.standard_uncertainty", 0.0041, 5e-5),
          ("b", "gum.dof", 9, 1e-9))
t = np.array([21.521, 22.012, 22.512, 23.003, 23.507, 23.999, 24.513, 25.002, 25.503, 26.010, 26.511])
b = [-0.171, -0.169, -0.166, -0.159, -0.164, -0.165, -0.156, -0.157, -0.159, -0.161, -0.160]
line = type_a.line_fit(list(t - 20), b)
recomputed(NAME, "", "b", line.intercept + 10 * line.slope)

# JCGM 100, H.4
NAME = "gum-h4-radon"
published(NAME, "JCGM 100:2008, H.4",
          ("A_x", "gum.estimate", 0.4300, 1.1e-4, "printed 0.4300 with R = 3.170; from the means 0.4299"),
          ("A_x", "gum.standard_uncertainty", 0.0083, 5e-5))
cycles = np.array([[243.74, 15380, 305.56, 4054, 367.37, 41432], [984.53, 14978, 1046.10, 3922, 1107.66, 38706],
                   [1723.87, 14394, 1785.43, 4200, 1846.99, 35860], [2463.17, 13254, 2524.73, 3830, 2586.28, 32238],
                   [3217.56, 12516, 3279.12, 3956, 3340.68, 29640], [3956.83, 11058, 4018.38, 3980, 4079.94, 26356]])
t_S, C_S, t_B, C_B, t_x, C_x = cycles.T
R_x, R_S = type_a.multi_estimate_real(
    [(C_x - C_B) / 60 * np.exp(1.25894e-4 * t_x), (C_S - C_B) / 60 * np.exp(1.25894e-4 * t_S)])
recomputed(NAME, "", "A_x",
           ureal(0.1368, 0.0018) * ureal(5.0192, 0.005) / ureal(5.0571, 0.001) * R_x / R_S)

# JCGM 100, H.5: published are the mean and the standard deviation of each day
NAME = "gum-h5-zener"
published(NAME, "JCGM 100:2008, H.5",
          ("V", "gum.estimate", 10.000097, 5e-7), ("V", "gum.standard_uncertainty", 18e-6, 0.5e-6),
          ("V", "gum.dof", 9, 1e-9),
          notes="Of each day the document has mean and standard deviation; the five readings of the file have these.")
days = 10 + 1e-6 * np.array([172, 116, 13, 144, 106, 31, 60, 125, 163, 41])
recomputed(NAME, "", "V", type_a.estimate(list(days)), rounding=1e-6)  # the table has 12 decimals

# Eurachem/CITAC QUAM:2012, A2
NAME = "quam-a2-naoh"
published(NAME, "Eurachem/CITAC QUAM:2012, A2",
          ("c", "gum.estimate", 0.10214, 5e-6), ("c", "gum.standard_uncertainty", 0.00010, 5e-6))
m = 0.3888 + ureal(0, rect(0.15e-3)) - ureal(0, rect(0.15e-3))
M = 8 * ureal(12.0107, rect(0.0008)) + 5 * ureal(1.00794, rect(0.00007)) + 4 * ureal(15.9994, rect(0.0003)) + ureal(39.0983, rect(0.0001))
V = 18.64 + ureal(0, tri(0.03)) + ureal(0, 0.006)
recomputed(NAME, "", "c", ureal(1, 0.0005) * 1000 * m * ureal(1, rect(0.0005)) / (M * V))

# Eurachem/CITAC QUAM:2012, A4
NAME = "quam-a4-bread"
published(NAME, "Eurachem/CITAC QUAM:2012, A4",
          ("P_op", "gum.estimate", 1.11, 5e-3), ("P_op", "gum.standard_uncertainty", 0.38, 5e-3))
recomputed(NAME, "", "P_op", 1.11 * ureal(1, 0.27) * 0.9 / ureal(0.9, 0.043) * ureal(1, 0.2))

# Eurachem/CITAC QUAM:2012, A5
NAME = "quam-a5-ceramic-line"
published(NAME, "Eurachem/CITAC QUAM:2012, A5",
          (None, "fits.line.coefficients.a.estimate", 0.0087, 5e-5),
          (None, "fits.line.coefficients.a.standard_uncertainty", 0.0029, 5e-5),
          (None, "fits.line.coefficients.b.estimate", 0.2410, 5e-5),
          (None, "fits.line.coefficients.b.standard_uncertainty", 0.0050, 5e-5),
          ("c_0", "gum.estimate", 0.260, 5e-4), ("c_0", "gum.standard_uncertainty", 0.018, 5e-4),
          ("r", "gum.estimate", 0.015, 5e-5),
          ("r", "gum.standard_uncertainty", 0.0014, 5e-5, "QUAM prints 0.0015 because of a slip in u(a_V); 0.0014 as in GTC's manual"))
x = [0.1] * 3 + [0.3] * 3 + [0.5] * 3 + [0.7] * 3 + [0.9] * 3
y = [0.028, 0.029, 0.029, 0.084, 0.083, 0.081, 0.135, 0.131, 0.133, 0.180, 0.181, 0.183, 0.215, 0.230, 0.216]
c_0 = type_a.line_fit(x, y).x_from_y([0.0712, 0.0716])
recomputed(NAME, "", "c_0", c_0)
V_L = 332 * ureal(0.995, tri(0.005)) * ureal(1, tri(0.01)) + ureal(0, rect(0.13944)) + ureal(0, tri(2.5))
a_V = math.pi * (ureal(2.70, 0.01) / 2) ** 2 * ureal(1, 0.05 / 1.96)
recomputed(NAME, "", "r", c_0 * (V_L / 1000) / a_V * ureal(1, 0.0008) * ureal(1, rect(0.0015)) * ureal(1, rect(0.1)))

# NIST TN 1900, E2
NAME = "tn1900-e2-surface-temperature"
published(NAME, "NIST TN 1900, example E2",
          ("tau", "gum.estimate", 25.6, 0.05), ("tau", "gum.standard_uncertainty", 0.872, 5e-4),
          ("tau", "gum.interval[0]", 23.8, 0.05), ("tau", "gum.interval[1]", 27.4, 0.05))
days = [18.75, 28.25, 25.75, 28.00, 28.50, 20.75, 21.00, 22.75, 18.50, 27.25, 20.75, 26.50, 28.00, 23.25, 28.00,
        21.75, 26.00, 26.50, 28.00, 33.25, 32.00, 29.50]
recomputed(NAME, "", "tau", type_a.estimate(days))

# NIST TN 1900, E3
NAME = "tn1900-e3-viscometer"
eta = ureal(4.63, 0.0463) * (ureal(61, 6.1) / ureal(36.6, 5.49))
rho_B = ureal(2217, 0.5)
recomputed(NAME, "NIST TN 1900, example E3 (inputs)", "eta_M",
           eta * (rho_B - ureal(1180, 0.5)) / (rho_B - ureal(810, 0.5)))

# NIST TN 1900, E4
NAME = "tn1900-e4-pitot"
recomputed(NAME, "NIST TN 1900, example E4 (inputs; temperature in degC)", "v",
           sqrt(2 * ureal(1993, 12.5) * 287.058 * (ureal(19.65, 0.11) + 273.15) / ureal(101400, 2100)))

# NIST TN 1900, E7: a cubic by ordinary least squares
NAME = "tn1900-e7-thermistor"
tau = np.array([20.91, 25.42, 30.50, 34.96, 40.23, 34.93, 30.05, 25.03, 20.87, 16.41, 16.40, 39.34])
t = np.array([20.85, 25.52, 30.70, 35.22, 40.47, 35.18, 30.25, 25.10, 20.81, 16.23, 16.22, 39.56])
A = np.vander(t - 30, 4, increasing=True)  # about 30, so that the matrix keeps its digits
coefficients, squares, *_ = np.linalg.lstsq(A, tau, rcond=None)
covariance = np.linalg.inv(A.T @ A) * squares[0] / (len(t) - 4)
published(NAME, "data of Possolo and Iyer (2017), table II, as in NIST TN 1900, example E7")
number(NAME, "T", "gum.estimate", coefficients[0], 1e-8, "numpy least squares about 30; rounding of powers of x")
number(NAME, "T", "gum.standard_uncertainty", math.sqrt(covariance[0, 0]), 1e-8, "numpy")
number(NAME, "T", "gum.dof", 8, 1e-7, "n - p")

# NIST TN 1900, E8
NAME = "tn1900-e8-carbon-dioxide"
published(NAME, "NIST TN 1900, example E8",
          ("M", "gum.estimate", 44.0094, 5e-5), ("M", "gum.standard_uncertainty", 0.0007, 5e-5))
recomputed(NAME, "", "M", ureal(12.0106, rect(0.001)) + 2 * ureal(15.9994, rect(0.00037)))

# NIST TN 1900, E15
NAME = "tn1900-e15-reflection"
def polar(m, u_m, p, u_p):
    m, p = ureal(m, u_m), ureal(p, u_p)
    return m * cos(p) + 1j * m * sin(p)
G = polar(.24776, .00337, 4.88683, .01392) - polar(.49935, .00340, 4.78595, .00835) * polar(
    .24971, .00170, 4.85989, .00842) / polar(.49952, .00340, 4.79054, .00835)
published(NAME, "NIST TN 1900, example E15", ("Gamma.re", "gum.estimate", 0.0074, 6e-5, "printed; the inputs are rounded"),
          ("Gamma.im", "gum.estimate", 0.0031, 5e-5))
recomputed(NAME, "", "Gamma.re", G.real)
recomputed(NAME, "", "Gamma.im", G.imag)
number(NAME, None, "output_correlations[0][2]", get_correlation(G.real, G.imag), 1e-9, "GTC")

# A measurement as NIST TN 1900, E17: both coordinates uncertain (GTC's weighted total least squares)
NAME = "tn1900-e17-gas-mixture"
x, u_x = np.array([0.5012, 0.7508, 0.9995, 1.2521, 1.5006]), np.array([0.0012, 0.0014, 0.0011, 0.0018, 0.0016])
y, u_y = np.array([50.21, 75.08, 100.11, 125.03, 150.19]), np.array([0.05, 0.06, 0.08, 0.09, 0.12])
r = np.array([1.0021, 1.0034, 1.0012, 1.0027])

def distance(p):
    a, b, xi = p[0], p[1], p[2:]
    return np.concatenate([(x - xi) / u_x, (y - a - b * xi) / u_y])
fit = scipy.optimize.least_squares(distance, [0, 100, *x], xtol=1e-15, ftol=1e-15, gtol=1e-15)
covariance = np.linalg.inv(fit.jac.T @ fit.jac)[:2, :2]
a, b = fit.x[:2]
published(NAME, "a measurement as NIST TN 1900, example E17; numbers of this file")
u_r = r.std(ddof=1) / math.sqrt(len(r))
g = np.array([1, r.mean()])
variance = g @ covariance @ g + (b * u_r) ** 2
number(NAME, "c", "gum.estimate", a + b * r.mean(), 1e-6, "scipy least_squares over parameters and abscissae, to 1e-8")
number(NAME, "c", "gum.standard_uncertainty", math.sqrt(variance), 1e-6, "scipy, inverse of J'J")
number(NAME, "c", "gum.dof", variance**2 / ((b * u_r) ** 4 / 3), 1e-2, "Welch-Satterthwaite: three of the readings, none of the stated points")

# A measurement as NIST TN 1900, E32: NIST StRD Pontius, certified values
NAME = "tn1900-e32-load-cell"
published(NAME, "a measurement as NIST TN 1900, example E32; data and certified values of NIST StRD Pontius",
          (None, "fits.curve.coefficients.a.estimate", 0.673565789473684e-3, 1e-12, "nine digits of the certified value"),
          (None, "fits.curve.coefficients.a.standard_uncertainty", 0.107938612033077e-3, 1e-12, "the same"),
          (None, "fits.curve.coefficients.b.estimate", 0.732059160401003e-6, 1e-15, "the same"),
          (None, "fits.curve.coefficients.b.standard_uncertainty", 0.157817399981659e-9, 1e-18, "the same"),
          (None, "fits.curve.coefficients.c.estimate", -0.316081871345029e-14, 1e-23, "the same"),
          (None, "fits.curve.coefficients.c.standard_uncertainty", 0.486652849992036e-16, 1e-25, "the same"),
          (None, "fits.curve.residual_standard_deviation", 0.205177424076185e-3, 1e-12, "the same"))
y = np.array([.11019, .21956, .32949, .43899, .54803, .65694, .76562, .87487, .98292, 1.09146, 1.20001, 1.30822,
              1.41599, 1.52399, 1.63194, 1.73947, 1.84646, 1.95392, 2.06128, 2.16844, .11052, .22018, .32939, .43886,
              .54798, .65739, .76596, .87474, .98300, 1.09150, 1.20004, 1.30818, 1.41613, 1.52408, 1.63159, 1.73965,
              1.84696, 1.95445, 2.06177, 2.16829])
x = np.tile(np.arange(1, 21) * 0.15, 2)  # in units of 1e6
A = np.vander(x, 3, increasing=True)
p, squares, *_ = np.linalg.lstsq(A, y, rcond=None)
covariance = np.linalg.inv(A.T @ A) * squares[0] / 37
load = (-p[1] + math.sqrt(p[1] ** 2 - 4 * p[2] * (p[0] - 1.2))) / (2 * p[2])
slope, g = p[1] + 2 * p[2] * load, np.array([1, load, load**2])
u_fit = math.sqrt(g @ covariance @ g) / slope
u = math.hypot(u_fit, 1e-4 / slope)
number(NAME, "load", "gum.estimate", load * 1e6, 1e-2, "numpy, the root of the quadratic, to 1e-4 u")
number(NAME, "load", "gum.standard_uncertainty", u * 1e6, 1e-3, "numpy")
number(NAME, "load", "gum.dof", u**4 / (u_fit**4 / 37), 1e-3, "Welch-Satterthwaite, one term of the fit")

# NIST TN 1900, E21: eleven laboratories, by `gumption compare`
NAME = "tn1900-e21-gravitation"
published(NAME, "values known to CODATA, JILA-10 as revised, as NIST TN 1900, example E21")
x = np.array([6.67248, 6.6729, 6.67398, 6.674255, 6.67559, 6.67422, 6.67387, 6.67222, 6.67425, 6.67349, 6.67260])
u = np.array([43, 50, 70, 9.2, 27, 98, 27, 87, 12, 18, 25]) * 1e-5
w = u**-2.0
mean = (w * x).sum() / w.sum()
Q = (w * (x - mean) ** 2).sum()
tau = math.sqrt((Q - 10) / (w.sum() - (w**2).sum() / w.sum()))
v = 1 / (u**2 + tau**2)
for path, value, tolerance in (
        ("weighted_mean.value", mean, 1e-11), ("weighted_mean.chi_squared", Q, 1e-9),
        ("estimators[2].standard_uncertainty", math.sqrt(Q / 10 / w.sum()), 1e-12),
        ("estimators[3].value", (v * x).sum() / v.sum(), 1e-11),
        ("estimators[3].standard_uncertainty", v.sum() ** -0.5, 1e-12), ("estimators[3].tau", tau, 1e-12)):
    number(NAME, None, path, value, tolerance, "numpy, the formulas in sums (Birge, DerSimonian-Laird)")

# EA-4/02, S2
NAME = "ea402-s2-weight"
published(NAME, "EA-4/02, S2",
          ("m_X", "gum.estimate", 10000.025, 5e-4), ("m_X", "gum.standard_uncertainty", 0.0293, 5e-5),
          ("m_X", "gum.expanded_uncertainty", 0.059, 5e-4))
recomputed(NAME, "", "m_X", ureal(10000.005, 0.0225) + ureal(0, rect(0.015)) + ureal(0.02, 0.025 / math.sqrt(3))
           + ureal(0, rect(0.01)) + ureal(0, rect(0.01)), dof=False)

# EA-4/02, S4
NAME = "ea402-s4-gauge-block"
published(NAME, "EA-4/02, S4", ("l_X", "gum.estimate", 49.999926, 5e-7),
          ("l_X", "monte_carlo.standard_uncertainty", 36.4e-6, 0.1e-6,
           "printed with the term of second order, which the trials have; half a digit and 2 standard errors of 200 000 trials"),
          notes="The linear budget has 34 nm; the printed 36.4 nm includes the product of two quantities that are 0.")
L, nm = 50.0, 1e-6
products = [(15, 1), (30 / 3**.5, 1), (12 / 5**.5, 1), (32 / 3**.5, 1), (L * 11.5e-6 * 0.05 / 3**.5 / nm, 1), (6.7 / 3**.5, 1)]
u1 = math.sqrt(sum((u * c) ** 2 for u, c in products))
second = L * (2e-6 / 6**.5) * (0.5 / 3**.5) / nm
number(NAME, "l_X", "gum.standard_uncertainty", u1 * nm, 1e-12, "the sum of squares by hand, without the product")
number(NAME, "l_X", "monte_carlo.standard_uncertainty", math.hypot(u1, second) * nm, 0.2e-6,
       "with the product, exactly; 3 standard errors of 200 000 trials")

# A measurement as EA-4/02, S11
NAME = "ea402-s11-block-calibrator"
y = ureal(180.1, 0.015) + ureal(0, 0.01)
for half in (0.04, 0.05, 0.1, 0.25, 0.05, 0.03):
    y = y + ureal(0, rect(half))
recomputed(NAME, "a measurement as EA-4/02, S11; numbers of this file", "t_X", y)

# EURAMET cg-3: the quadratic solved
NAME = "cg3-pressure-balance"
W = ureal(50.0012, 60e-6) * ureal(9.812345, 1e-5) * (1 - ureal(1.19, 0.01) / ureal(7920, rect(40)))
A = ureal(196.1192e-6, 0.0022e-6, 40) * (1 + ureal(22e-6, rect(2e-6)) * (ureal(20.8, 0.1) - 20))
lam = ureal(4.5e-12, 0.45e-12)
p0 = W / A
recomputed(NAME, "equation of EURAMET cg-3; numbers of this file", "p", 2 * p0 / (1 + sqrt(1 + 4 * lam * p0)), scale=1e-6)

# ISO 8655-6
NAME = "iso8655-pipette"
m = type_a.estimate([996.32, 996.85, 996.11, 996.50, 996.74, 996.29, 996.58, 996.43, 996.90, 996.37]) + ureal(0, 0.05) + ureal(0, rect(0.1))
rho_w, rho_a = ureal(998.05, 0.03), ureal(1.19, 0.01)
V = m * (1 - rho_a / ureal(8000, rect(30))) / (rho_w - rho_a) * (1 - ureal(2.4e-4, rect(0.2e-4)) * (ureal(20.7, 0.1) - 20))
recomputed(NAME, "equation of ISO 8655-6; numbers of this file", "V", V, scale=1e3)

# Magnus equation
NAME = "humidity-dew-point"
t = ureal(23, 0.05) + ureal(0, rect(0.05))
td = ureal(12, 0.1) + ureal(0, rect(0.05))
recomputed(NAME, "Magnus equation, WMO-No. 8; numbers of this file", "rh",
           ureal(1, 0.0015) * exp(17.62 * td / (243.12 + td) - 17.62 * t / (243.12 + t)), scale=100)

# Steinhart-Hart
NAME = "thermistor-steinhart-hart"
a, b, c = multiple_ureal([1.129241e-3, 2.341077e-4, 8.775468e-8], [2.0e-7, 3.0e-8, 6.0e-11], inf)
set_correlation(-0.98, a, b), set_correlation(0.94, a, c), set_correlation(-0.97, b, c)
x = log(ureal(10012.3, 10012.3 * 50e-6 + 0.1))
recomputed(NAME, "Steinhart-Hart equation; numbers of this file", "t", 1 / (a + b * x + c * x**3), offset=-273.15)

# Callendar-Van Dusen
def inverse_prt(R, R0, C):
    """The root by bisection, the derivatives by the implicit function theorem."""
    A, B = 3.9083e-3, -5.775e-7
    w = lambda t: 1 + A * t + B * t * t + C * (t - 100) * t**3
    t = scipy.optimize.brentq(lambda t: R0.x * w(t) - R.x, -200, 850, xtol=1e-13, rtol=8.9e-16)
    slope = R0.x * (A + 2 * B * t + C * (4 * t**3 - 300 * t * t))
    return t + (R - R.x) / slope - (R0 - R0.x) * w(t) / slope
for NAME, R, t, C in (("prt-above-zero", 138.506, 100, 0), ("prt-below-zero", 60.256, -100, -4.183e-12)):
    published(NAME, "IEC 60751, table of resistances", ("t", "gum.estimate", t, 0.0014, "half a unit of the table's last digit over its slope"))
    recomputed(NAME, "", "t", inverse_prt(ureal(R, 0.004), ureal(100, 0.006), C), by="scipy and GTC", rounding=1e-8)

# ITS-90, type K
NAME = "thermocouple-k"
published(NAME, "NIST Monograph 175, table of type K", ("t", "gum.estimate", 300, 0.05, "the error of the inverse polynomial, up to 0.05 degC"))
E = ureal(12.209, 0.004)
t = 0
for k in (-1.052755e-8, 1.057734e-6, -4.413030e-5, 9.804036e-4, -1.228034e-2, 8.315270e-2, -2.503131e-1, 7.860106e-2, 25.08355):
    t = E * (k + t)
recomputed(NAME, "", "t", t + ureal(0, 0.05) + ureal(0, rect(1.1)))

# Budgets of a laboratory
OWN = "a laboratory's budget; numbers of this file"
NAME = "dmm-resistor"
R = type_a.estimate([9.99832, 9.99835, 9.99830, 9.99834, 9.99833])
half = 60e-6 * R.x + 10e-6 * 10
R = R + ureal(0, rect(half)) + ureal(0, rect(0.05e-3))
recomputed(NAME, OWN, "R_23", R * (1 - ureal(0, rect(5e-6)) * (ureal(23.4, 0.3) - 23)), dof=False)

NAME = "mismatch"
P1, P2 = ureal(1.0023, 1.0023 * 0.0015), ureal(99.41e-3, 99.41e-3 * 0.002)
recomputed(NAME, OWN, "L", 10 * log10(P1 / P2) + ureal(0, arcsine(0.0869)))

NAME = "brinell"
published(NAME, "ISO 6506-4, table of hardness values", ("H", "gum.estimate", 229, 0.5))
F, D, d = ureal(29420, rect(29420 * 0.005)), ureal(10, rect(0.005)), ureal(4.00, 0.008)
recomputed(NAME, "", "H", 0.102 * 2 * F / (math.pi * D * (D - sqrt(D**2 - d**2))))

NAME = "torque"
M = ureal(10.00021, 15e-6) * ureal(9.80947, 2e-5) * ureal(0.500013, 8e-6) * (1 - ureal(1.2, 0.02) / ureal(7900, rect(100)))
recomputed(NAME, OWN, "M", M * cos(ureal(0.1, rect(0.1)) * math.pi / 180))

NAME = "ph"
k = ureal(0.985, rect(0.01)) * 8.314462618 * (ureal(25, 0.2) + 273.15) * math.log(10) / 96485.33212
recomputed(NAME, "Nernst equation; numbers of this file", "pH_X", ureal(6.865, 0.005) + (ureal(7.2e-3, 0.2e-3) - ureal(-158.4e-3, 0.2e-3)) / k)

NAME = "ac-shunt"
V = ureal(0.80012, rect(0.80012 * 40e-6 + 5e-6))
I = V / (ureal(0.79998, 0.79998 * 10e-6) * (1 + ureal(12e-6, rect(25e-6))) * (1 + ureal(0, rect(8e-6))))
recomputed(NAME, OWN, "I", I)

NAME = "load-cell-table"
published(NAME, OWN)
for row, (F, *r) in enumerate([(2, 0.40012, 0.40019, 0.40007), (4, 0.80043, 0.80031, 0.80050), (6, 1.20061, 1.20077, 1.20066),
                               (8, 1.60095, 1.60102, 1.60081), (10, 2.00118, 2.00131, 2.00109)]):
    S = (type_a.estimate(r) + ureal(0, rect(5e-6))) / ureal(F, F * 1e-4) * ureal(1, rect(5e-5))
    for path, value, tolerance in (("estimate", S.x, 1e-9 * S.u), ("standard_uncertainty", S.u, 1e-9 * S.u), ("dof", S.df, 1e-7 * S.df)):
        number(NAME, None, f"rows[{row}].outputs.S.gum.{path}", value, tolerance, "GTC")

NAME = "reflection-saved"
z = ucomplex(0.08 - 0.05j, (0.003**2, 0.3 * 0.003 * 0.004, 0.3 * 0.003 * 0.004, 0.004**2))
rho = sqrt(z.real**2 + z.imag**2)
recomputed(NAME, OWN, "rho", rho, dof=False)
NAME = "standing-wave-ratio"
recomputed(NAME, OWN, "SWR", (1 + rho) / (1 - rho), dof=False, rounding=1e-6)
recomputed(NAME, OWN, "loss", -10 * log10(1 - rho**2), dof=False, rounding=1e-6)

print(json.dumps(found, indent=1))
