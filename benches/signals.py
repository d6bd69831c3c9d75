#!/usr/bin/env python3
"""Checks the identification of a sensor and the correction of signals on published and on synthetic records.

    python3 benches/signals.py PROGRAM HYDROPHONE SHOCK     writes reports/signals.md

HYDROPHONE holds signal.dat, noise.dat, calibration.csv and published.dat of Weber and Wilkens's tutorial on the
deconvolution of hydrophone signals (GPL-3): signal and noise M3_ON1704, calibration MW_ONDA1704, result M-Mode3MHz.
SHOCK holds sinusoidal_calibration_values.txt, measured_input_accel.txt and measured_output_accel.txt of PyDynamic's
example of a shock calibration (LGPL-3, in its wheel). The project carries neither. Needs Python 3.10 and numpy.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

REPORT = Path(__file__).resolve().parent.parent / "reports" / "signals.md"
ROWS = []


def check(what, found, expected, source):
    ROWS.append((what, found, expected, source))
    print(f"{what}: {found} ({expected})", flush=True)


def run(program, folder, recipe, *options):
    """The answer of `observe`."""
    path = folder / "recipe.json"
    path.write_text(json.dumps(recipe))
    done = subprocess.run([program, "observe", path, "--format", "json", *options], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def columns(path, **named):
    """A CSV file with these columns."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(named)
        writer.writerows(zip(*named.values()))


def arrays(waveform):
    return np.array(waveform["values"]), np.array(waveform["standard_uncertainties"])


# ---- the hydrophone ----

def samples(path):
    return np.array([float(line) for line in path.read_text().split()])[4:]


def hydrophone(program, data, folder):
    """The published pulse, and its standard uncertainty with and without the source's independence."""
    calibration = np.loadtxt(data / "calibration.csv", delimiter=",", skiprows=1)
    published = np.loadtxt(data / "published.dat", delimiter=";")
    hertz = 1e6*calibration[:, 0]
    used = (hertz >= 0.1e6) & (hertz <= 50e6 + 1)
    real, imaginary, of_real, of_imaginary, both = calibration[used, 1:6].T
    columns(folder / "calibration.csv", f=map(repr, hertz[used].tolist()), re=real, im=imaginary,
            u_re=np.sqrt(of_real), u_im=np.sqrt(of_imaginary), r=both/np.sqrt(of_real*of_imaginary))
    columns(folder / "signal.csv", v=samples(data / "signal.dat"))
    columns(folder / "noise.csv", v=samples(data / "noise.dat"))
    # the source takes off the slope of the phase up to 3 dB, by least squares over 1000 frequencies
    grid = np.linspace(0, 1e8, 1000)
    poles = 1/(1 + 1j*grid/155.5e6)**2
    last = np.argmin(abs(abs(poles) - math.sqrt(0.5)))
    delay = -np.angle(poles[:last]) @ grid[:last]/(grid[:last] @ grid[:last])/(2*math.pi)
    part = {"file": "calibration.csv", "unit": "V/Pa"}
    response = {
        "x": {"file": "calibration.csv", "column": "f", "unit": "Hz"},
        "y": {"complex": {"re": {**part, "column": "re", "standard_uncertainty": "u_re"},
                          "im": {**part, "column": "im", "standard_uncertainty": "u_im"},
                          "correlation": "r"}},
        "below": "hold", "above": "hold",
    }
    step = {
        "step": "waveform", "response": response, "unit": "Pa",
        "low_pass": {"cutoff": 155.5e6*math.sqrt(math.sqrt(2) - 1), "order": 2, "delay": delay},
        "truncation": {"bound": 87310.15711391429*math.sqrt(3)},
        "noise": {"channel": "quiet", "colour": "white"},
        "quantities": ["maximum", "minimum", "squared-integral"],
    }
    recipe = {
        "title": "Ultrasound pulse of a hydrophone",
        "recordings": {"signal": {"file": "signal.csv", "sampling_rate": 5e8},
                       "noise": {"file": "noise.csv", "sampling_rate": 5e8}},
        "channels": {"p": {"recording": "signal", "column": "v", "unit": "V", "steps": ["remove-mean", step]},
                     "quiet": {"recording": "noise", "column": "v", "unit": "V"}},
    }
    results = {}
    for shared in ("lines", "points"):
        response["shared"] = shared
        answer = run(program, folder, recipe)["rows"][0]["waveforms"]["p"]
        results[shared] = answer
        subprocess.run([program, "observe", folder / "recipe.json", "--format", "html", "--output",
                        folder / f"hydrophone-{shared}.html"], check=True, capture_output=True)
    x, u = arrays(results["lines"])
    peak = abs(published[:, 3]).max()
    check("hydrophone: corrected pulse, largest deviation from the published one, of its peak",
          f"{abs(x - published[:, 3]).max()/peak:.1e}", "rounding, 1e-15", "published.dat")
    check("hydrophone: u with independent lines, largest relative deviation from the published one",
          f"{abs(u/published[:, 4] - 1).max():.1e}",
          "1e-3: the truncation is taken as the published constant, 87.310 kPa", "published.dat")
    figures = results["lines"]["quantities"]
    for name, unit, expected in (("maximum", 1e6, "5.30(10) MPa"), ("minimum", -1e6, "2.57(10) MPa"),
                                 ("squared_integral", 1e6, "1.600(60) kPa^2 s; the source takes what is missing as independent at each instant")):
        of = figures[name]
        check(f"hydrophone: {name}", f"{of['value']/unit:.4f}({of['standard_uncertainty']/abs(unit):.4f})", expected,
              "table of the tutorial")
    for shared in ("lines", "points"):
        of = {source["source"]: source["root_mean_square"] for source in results[shared]["sources"]}
        _, u = arrays(results[shared])
        calibrated = np.sqrt(np.maximum(u**2 - of["noise"]**2 - of["truncation"]**2, 0))
        check(f"hydrophone: u by the calibration over the record, errors of {shared}",
              f"{calibrated.min()/1e3:.0f} to {calibrated.max()/1e3:.0f} kPa",
              "32 to 45 kPa" if shared == "lines" else "independent computation below", "numpy")
        trials = np.array(results[shared]["monte_carlo"]["standard_uncertainties"])
        check(f"hydrophone: standard deviation of {results[shared]['monte_carlo']['trials']} trials over u, errors of "
              f"{shared}, mean over the record", f"{np.sqrt((trials**2).mean()/(u**2).mean()):.3f}", "1",
              "JCGM 102, 7")
    # the points' errors by numpy: one inverse transform for each point and part
    n, lines = len(x), np.fft.rfftfreq(len(x), 2e-9)
    signal = samples(data / "signal.dat")
    spectrum = np.fft.rfft(signal - signal.mean())
    interpolated = np.interp(lines, hertz[used], real) + 1j*np.interp(lines, hertz[used], imaginary)
    interpolated[[0, -1]] = interpolated[[0, -1]].real
    corrected = spectrum/interpolated/(1 + 1j*lines/155.5e6)**2*np.exp(2j*math.pi*lines*delay)
    variance = np.zeros(n)
    for point in range(used.sum()):
        hat = np.interp(lines, hertz[used], np.eye(used.sum())[point])
        # at zero and half the rate the response is real, and so are its errors
        edge = np.ones(len(lines))
        edge[[0, -1]] = 0
        effect = [np.fft.irfft(-corrected*hat*part/interpolated, n) for part in (1, 1j*edge)]
        variance += (of_real[point]*effect[0]**2 + of_imaginary[point]*effect[1]**2
                     + 2*both[point]*effect[0]*effect[1])
    of = {source["source"]: source["root_mean_square"] for source in results["points"]["sources"]}
    _, u = arrays(results["points"])
    found = u**2 - of["noise"]**2 - of["truncation"]**2
    check("hydrophone: variance by errors of points, largest deviation from numpy's, of the largest",
          f"{abs(found - variance).max()/variance.max():.1e}", "rounding of u^2, 1e-12",
          f"numpy, {math.sqrt(variance.min())/1e3:.0f} to {math.sqrt(variance.max())/1e3:.0f} kPa")


# ---- the shock accelerometer ----

def identified(folder, data):
    values = np.loadtxt(data / "sinusoidal_calibration_values.txt")
    f = values[:, 0]
    # the relative standard uncertainties of the modulus and those of the phase, as the practice case states them
    relative = np.select([f < 5500, f < 10500, f < 15498], [0.005, 0.0015, 0.0025], 0.005)
    columns(folder / "sinusoidal.csv", f=f, s=values[:, 1], u_s=relative*values[:, 1], phi=values[:, 2],
            u_phi=np.where(f < 5500, 0.25, 0.5))
    part = {"file": "sinusoidal.csv"}
    model = {
        "title": "Shock accelerometer of PTB, sinusoidal calibration",
        "fits": {"sensor": {
            "form": "S0/(1 - (x/f0)^2 + 2*i*damping*x/f0)",
            "start": {"S0": "0.23", "f0": "50 kHz", "damping": "0.05"},
            "x": {**part, "column": "f", "unit": "Hz"},
            "y": {"complex": {
                "modulus": {**part, "column": "s", "unit": "1", "standard_uncertainty": "u_s"},
                "phase": {**part, "column": "phi", "unit": "deg", "standard_uncertainty": "u_phi"}}},
        }},
        "equations": {"S": "abs(sensor(10 [kHz]))"},
        "outputs": {"S": {"unit": "1"}},
    }
    (folder / "sensor.json").write_text(json.dumps(model))


def shock(program, data, folder):
    identified(folder, data)
    done = subprocess.run([program, "run", folder / "sensor.json", "--trials", "0", "--format", "json"],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    fit = json.loads(done.stdout)["fits"]["sensor"]
    value = lambda name: [fit["coefficients"][name][key] for key in ("estimate", "standard_uncertainty")]
    f0, damping, s0 = value("f0"), value("damping"), value("S0")
    check("shock accelerometer: f0", f"{f0[0]:.2f}({100*f0[1]:.0f}) kHz", "51.37(29) kHz", "scipy, least_squares")
    check("shock accelerometer: damping", f"{damping[0]:.4f}({1e4*damping[1]:.0f})", "0.0831(27)",
          "scipy, least_squares")
    check(f"shock accelerometer: chi-squared of {fit['dof']} degrees of freedom", f"{fit['chi2']:.1f}", "214.6",
          "scipy, least_squares")
    reference = np.loadtxt(data / "measured_input_accel.txt")
    output = np.loadtxt(data / "measured_output_accel.txt")
    columns(folder / "shock.csv", a=reference, y=output)
    common = {"step": "waveform", "low_pass": {"cutoff": 50e3, "order": 4}, "truncation": "none",
              "noise": {"from": 0, "to": 2.5e-4}}
    corrected = {**common, "response": {"model": "sensor.json", "fit": "sensor"}, "unit": "1",
                 "quantities": ["maximum", {"quantity": "ratio", "channel": "reference"}]}
    plain = {**common, "quantities": ["maximum"]}
    recipe = {
        "title": "Shock of an accelerometer: reference, output scaled, output corrected",
        "recordings": {"run": {"file": "shock.csv", "sampling_rate": 1e7}},
        "channels": {
            "reference": {"column": "a", "unit": "1", "steps": [plain]},
            "scaled": {"column": "y", "unit": "1", "sensitivity": {"value": s0[0], "unit": "1"}, "steps": [plain]},
            "x": {"column": "y", "unit": "1", "steps": [corrected]}},
        "trials": 200,
    }
    peak = abs(reference).max()
    # the same by numpy
    lines = np.fft.rfftfreq(len(output), 1e-7)
    passed = (1 + (lines/50e3)**2*(2**0.25 - 1))**-2.0
    turned = lambda values, factor: np.fft.irfft(np.fft.rfft(values)*passed*factor, len(values))
    model = s0[0]/(1 - (lines/1e3/f0[0])**2 + 2j*damping[0]*lines/1e3/f0[0])
    departs = lambda factor: (
        f"{100*math.sqrt(((turned(output, factor) - turned(reference, 1))**2).mean())/peak:.2f} %")
    first = True
    # (delay of the output in us, its u, u of the reference)
    for delay, of_delay, of_reference in ((0.0, 0.0, 0.0), (-0.88, 0.0, 0.0), (-0.88, 0.2, 0.005)):
        corrected["delay"] = {"value": delay, "unit": "us", "standard_uncertainty": of_delay}
        if of_reference:
            # what the reference does not see of the motion of the sensor, at any instant
            plain["additional"] = of_reference*peak
        answer = run(program, folder, recipe)["rows"][0]["waveforms"]
        (of, u_of), (scaled, _), (x, u) = (arrays(answer[name]) for name in ("reference", "scaled", "x"))
        share = lambda values: f"{100*math.sqrt(((values - of)**2).mean())/peak:.2f} %"
        if first:
            check("shock: scaled by S0, rms departure from the reference, of the peak", share(scaled), departs(1/s0[0]),
                  "numpy")
            first = False
        inside = (abs(x - of) <= 2*np.hypot(u, u_of)).mean()
        said = f"delay {delay:.2f} us" + (f", u {of_delay} us, reference u {100*of_reference} % of its peak" if of_delay else "")
        check(f"shock: corrected, {said}: rms departure, of the peak; samples within 2 u",
              f"{share(x)}; {100*inside:.0f} %",
              departs(np.exp(2e-6j*math.pi*delay*lines)/model) + ("; 95 %" if of_delay else ""), "numpy")
        parts = ", ".join(f"{s['source']} {100*s['root_mean_square']/peak:.3f} %" for s in answer["x"]["sources"])
        print("   ", parts, answer["x"]["quantities"]["ratio"]["value"])
    subprocess.run([program, "observe", folder / "recipe.json", "--format", "html", "--output",
                    folder / "shock.html"], check=True, capture_output=True)


# ---- synthetic ----

def coverage(program, folder):
    """Records whose truth is known: how often the bands hold it."""
    rate, samples, records = 2e5, 2000, 60
    generator = np.random.default_rng(20)
    t = np.arange(samples)/rate
    truth = np.where((t > 3e-3) & (t < 3.5e-3), np.sin(math.pi*(t - 3e-3)/5e-4)**2, 0.0)*1000
    lines = np.fft.rfftfreq(samples, 1/rate)
    of = lambda f0, damping, s0: s0/(1 - (lines/f0)**2 + 2j*damping*lines/f0)
    f = np.geomspace(500, 40e3, 40)
    u_relative, u_phase = 0.005, math.radians(0.3)
    inside, peaks, times = [], [], []
    for record in range(records):
        at = 2e-3/(1 - (f/3e4)**2 + 2j*0.05*f/3e4)
        modulus = abs(at)*(1 + u_relative*generator.standard_normal(len(f)))
        phase = np.angle(at) + u_phase*generator.standard_normal(len(f))
        columns(folder / "calibration.csv", f=f, modulus=modulus, phase=np.degrees(phase))
        through = np.fft.rfft(truth)*of(3e4, 0.05, 2e-3)
        through[-1] = through[-1].real
        columns(folder / "run.csv", y=np.fft.irfft(through, samples) + 2e-3*generator.standard_normal(samples))
        part = {"file": "calibration.csv"}
        recipe = {
            "recordings": {"run": {"file": "run.csv", "sampling_rate": rate}},
            "channels": {"x": {"column": "y", "unit": "V", "steps": [{
                "step": "waveform", "unit": "m/s^2", "noise": {"standard_uncertainty": 2e-3},
                "response": {
                    "x": {**part, "column": "f", "unit": "Hz"},
                    "y": {"complex": {
                        "modulus": {**part, "column": "modulus", "unit": "V/(m/s^2)",
                                    "standard_uncertainty": "0.5 % of reading"},
                        "phase": {**part, "column": "phase", "unit": "deg", "standard_uncertainty": 0.3}}},
                    "below": "hold", "above": "hold"},
                "low_pass": {"cutoff": 30e3, "order": 4},
                "truncation": {"from": 4e3, "decay": 3},
                "quantities": ["maximum", "maximum-time"]}]}},
            "trials": 0,
        }
        answer = run(program, folder, recipe)["rows"][0]["waveforms"]["x"]
        x, u = arrays(answer)
        inside.append((abs(x - truth) <= 1.96*u).mean())
        maximum = answer["quantities"]["maximum"]
        peaks.append((maximum["value"] - truth.max())/maximum["standard_uncertainty"])
        when = answer["quantities"]["maximum_time"]
        times.append((when["value"] - 3.25e-3)/when["standard_uncertainty"])
    check(f"synthetic shock, {records} records: instants whose band of 95 % holds the truth",
          f"{100*np.mean(inside):.1f} %", "95 % or more: the truncation is a bound", "truth")
    check(f"synthetic shock, {records} records: greatest values within 2 u", f"{100*np.mean(np.abs(peaks) <= 2):.0f} %",
          "95 %", "truth")
    check(f"synthetic shock, {records} records: times of these within 2 u",
          f"{100*np.mean(np.abs(times) <= 2):.0f} %", "95 %", "truth")


def speed(program, folder):
    """A million samples."""
    samples, rate = 1_000_000, 1e6
    generator = np.random.default_rng(1)
    t = np.arange(samples)/rate
    signal = np.where((t > 0.4) & (t < 0.401), np.sin(math.pi*(t - 0.4)*1e3)**2, 0.0)
    np.save(folder / "run.npy", signal + 1e-3*generator.standard_normal(samples))
    f = np.geomspace(20, 5e4, 49)
    columns(folder / "calibration.csv", f=f, modulus=np.full(49, 2.0), phase=-f/1e4)
    part = {"file": "calibration.csv"}
    recipe = {
        "recordings": {"run": {"file": "run.npy", "sampling_rate": rate}},
        "channels": {"x": {"column": 1, "unit": "V", "steps": [{
            "step": "waveform", "unit": "m/s^2", "noise": {"from": 0, "to": 0.3},
            "response": {"x": {**part, "column": "f", "unit": "Hz"},
                         "y": {"complex": {
                             "modulus": {**part, "column": "modulus", "unit": "V/(m/s^2)",
                                         "standard_uncertainty": "0.5 % of reading"},
                             "phase": {**part, "column": "phase", "unit": "deg", "standard_uncertainty": 0.3}}},
                         "below": "hold", "above": "hold"},
            "low_pass": {"cutoff": 30e3}, "truncation": {"from": 2e3, "decay": 3},
            "quantities": ["maximum", "duration"][:1]}]}},
    }
    (folder / "recipe.json").write_text(json.dumps(recipe))
    for options, said in (([], "with its trials"), (["--seed", "2"], "again")):
        begin = time.perf_counter()
        done = subprocess.run(["/usr/bin/time", "-f", "%M", program, "observe", folder / "recipe.json", *options],
                              capture_output=True, text=True)
        lasts = time.perf_counter() - begin
        if done.returncode:
            sys.exit(done.stderr)
        memory = int(done.stderr.split()[-1])/1024
        check(f"1,000,000 samples, response of 49 points, page of text, {said}", f"{lasts:.1f} s, {memory:.0f} MB",
              "10 s", "time")


def main():
    program, hydrophone_data, shock_data = (Path(argument).resolve() for argument in sys.argv[1:4])
    folder = Path(sys.argv[4]) if len(sys.argv) > 4 else Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    hydrophone(program, hydrophone_data, folder)
    shock(program, shock_data, folder)
    coverage(program, folder)
    speed(program, folder)
    processor = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "unknown")
    lines = [
        "# Sensors identified and signals corrected", "",
        "Written by `python3 benches/signals.py PROGRAM HYDROPHONE SHOCK`; the script says what the folders hold. "
        f"Times are of one run on {processor}.", "",
        "| check | found | expected | by |", "|---|---|---|---|",
        *(f"| {' | '.join(row)} |" for row in ROWS), "",
        "The shock: both records go through the same low-pass (50 kHz, 4 poles), so that nothing is missing of one alone. "
        "u of the delay (0.2 us) and of the reference are assumptions; the misfit of the second-order model follows from "
        "the residuals of its fit. What departs is mostly a vibration of 10 kHz to 50 kHz after the pulse, which the "
        "reference and the sensor do not share.",
        "", "Trials of the hydrophone have a smaller standard deviation than the law of propagation, because at the lowest "
        "frequencies the standard uncertainty of the response is larger than the response: there the division is not "
        "linear.",
    ]
    REPORT.write_text("\n".join(lines) + "\n")


main()
