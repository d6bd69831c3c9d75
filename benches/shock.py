"""Diagnoses the shock record of an accelerometer of PTB with the sensor as a simulator in time.

    python3 benches/shock.py PROGRAM FOLDER

FOLDER holds measured_input_accel.txt and measured_output_accel.txt of PyDynamic's example (LGPL-3, in its wheel),
which the project does not carry. Writes reports/gap-shock.md. With --simulate it is the simulator itself.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

STEP = 1e-7  # s, between two samples
CUT_OFF = 20e3  # Hz, at which the filter of both channels takes half of the power
THIN = 20  # one sample of so many is a row
ROWS = range(3400, 7000, THIN)
DEVIATION = 0.008  # standard uncertainty, as a share of the largest value

SINUSOIDAL = "51.37(29) kHz"


def sensor(conditions, S0, delay, f0=0, damping=0.1, lag=0, k=0):
    """The output of a seismic mass on a spring for an input that is straight between rows; delay, lag in us."""
    times, inputs = conditions["t"], conditions["a"]
    values, place = [], 0
    for time in times:
        while place + 2 < len(times) and times[place + 1] <= time - delay:
            place += 1
        share = (time - delay - times[place])/(times[place + 1] - times[place])
        values.append(inputs[place] + share*(inputs[place + 1] - inputs[place]))
    if f0:
        values = resonance(times, values, 2e-3*math.pi*f0, damping)
    if lag:
        values = low_pass(times, values, lag)
    return {"output": [S0*value*(1 + k*abs(value)) for value in values]}


def resonance(times, values, omega, damping):
    """y'' + 2 damping omega y' + omega^2 y = omega^2 x, exact for inputs that are straight between rows."""
    y, rate, found = values[0], 0.0, [values[0]]
    free, lost = omega*math.sqrt(1 - damping*damping), damping*omega
    for place in range(1, len(times)):
        h = times[place] - times[place - 1]
        ramp = (values[place] - values[place - 1])/h
        # with y = x - 2 damping ramp/omega + z the rest z swings freely
        lead = 2*damping*ramp/omega
        z, slope = y - values[place - 1] + lead, rate - ramp
        swing = (slope + lost*z)/free
        fall, cosine, sine = math.exp(-lost*h), math.cos(free*h), math.sin(free*h)
        z = fall*(z*cosine + swing*sine)
        rate = ramp - lost*z + fall*free*(swing*cosine - (y - values[place - 1] + lead)*sine)
        y = values[place] - lead + z
        found.append(y)
    return found


def low_pass(times, values, tau):
    state, found = values[0], [values[0]]
    for place in range(1, len(times)):
        h, before, change = times[place] - times[place - 1], values[place - 1], values[place] - values[place - 1]
        kept = math.exp(-h/tau)
        state = kept*state + (1 - kept)*before + change*(1 - tau/h*(1 - kept))
        found.append(state)
    return found


def smoothed(samples):
    """Samples through a Gaussian low-pass filter, at the rows."""
    deviation = math.sqrt(math.log(2))/(2*math.pi*CUT_OFF*STEP)
    reach = int(5*deviation)
    weights = [math.exp(-(i/deviation)**2/2) for i in range(-reach, reach + 1)]
    total = sum(weights)
    return [sum(w*samples[row + i] for w, i in zip(weights, range(-reach, reach + 1)))/total for row in ROWS]


CASE = {
    "format": 1,
    "title": "Shock of an accelerometer, reference and output",
    "inputs": {
        "S0": {"unit": "1", "distribution": "normal", "mean": 0.2271, "std": 0.002},
        "delay": {"unit": "us", "distribution": "normal", "mean": 0, "std": 1},
    },
    "conditions": {"t": {"unit": "us"}, "a": {"unit": "1"}},
    "simulator": {"outputs": {"output": "1"}},
    "outputs": {"output": {"unit": "1"}},
    "effects": {
        "resonance": {
            "about": "of the seismic mass on its spring",
            "parameters": {
                "f0": {"unit": "kHz", "distribution": "log-uniform", "lower": 20, "upper": 120},
                "damping": {"unit": "1", "distribution": "log-uniform", "lower": 0.01, "upper": 0.5},
            },
            "simulator": True,
            "neutral": {"f0": 0},
        },
        "low-pass": {
            "about": "of the amplifier",
            "parameters": {"lag": {"unit": "us", "distribution": "rectangular", "lower": 0, "upper": 10}},
            "simulator": True,
        },
        "nonlinearity": {
            "about": "a sensitivity that grows with the acceleration",
            "parameters": {"k": {"unit": "1", "distribution": "normal", "mean": 0, "std": 1}},
            "simulator": True,
        },
    },
}


def read(path):
    return [float(line) for line in path.read_text().split()]


def diagnosed(program, folder, into):
    """The answer, how many runs were made, and the number of rows."""
    inputs, outputs = (smoothed(read(folder / f"measured_{name}_accel.txt")) for name in ("input", "output"))
    rows = [(row*STEP*1e6, a, b) for row, a, b in zip(ROWS, inputs, outputs)]
    with open(into / "data.csv", "w") as out:
        out.write("t,a,output\n" + "".join(f"{t:.7g},{a!r},{b!r}\n" for t, a, b in rows))
    column = {"value": "output", "standard_uncertainty": DEVIATION*max(outputs)}
    observations = {"file": "data.csv", "columns": {"output": column}}
    (into / "case.json").write_text(json.dumps(CASE | {"observations": observations}))
    command = [program, "gap", into / "case.json", "--simulator-lines", "--runs", "300", "--keep", into / "runs",
               "--simulator", f"{sys.executable} {pathlib.Path(__file__).resolve()} --simulate",
               "--format", "json", "--quiet"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return json.loads(said), len((into / "runs" / "runs.jsonl").read_text().splitlines()) - 1, len(rows)


def report(answer, runs, rows):
    verdict, best = answer["verdict"], answer["hypotheses"][0]
    effects = " + ".join(verdict["effects"]) or verdict["kind"]
    lines = [
        "# The shock record of an accelerometer", "",
        "Written by `python3 benches/shock.py PROGRAM FOLDER`. The record is that of PyDynamic's example of a shock "
        "calibration at PTB: input and output of a shock accelerometer. Both channels go through the same low-pass "
        f"filter ({CUT_OFF/1e3:.0f} kHz, Gaussian), above which the reference does not follow, and one sample in "
        f"{THIN} about the shock is a row: {rows} rows. The sim is a constant sensitivity and a delay; the standard "
        f"uncertainty of {100*DEVIATION:.1f} % of the peak is an assumption about the misfit of both channels.", "",
        f"Verdict: **{effects}**, probability {verdict['probability']:.3f}, after {runs} runs.", "",
        "| parameter | unit | estimate | standard uncertainty | 95 % interval |", "|---|---|---|---|---|",
    ]
    for name, found in best["parameters"].items():
        low, high = found["interval"]
        lines.append(f"| {name} | {found['unit']} | {found['estimate']:.4g} | {found['standard_uncertainty']:.2g} | "
                     f"{low:.4g} to {high:.4g} |")
    lines += ["", f"The sinusoidal calibration, which the diagnosis did not see, gives f0 = {SINUSOIDAL} and a damping "
              "of 0.083(3).", "", "What the page notes:", ""]
    lines += [f"- {note['message']}" for note in answer["notes"]]
    return "\n".join(lines) + "\n"


def main():
    if sys.argv[1:] == ["--simulate"]:
        for line in sys.stdin:
            request = json.loads(line)
            print(json.dumps(sensor(request["conditions"], **request["parameters"])), flush=True)
        return
    with tempfile.TemporaryDirectory() as into:
        text = report(*diagnosed(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(into)))
    (pathlib.Path(__file__).parent.parent / "reports" / "gap-shock.md").write_text(text)


if __name__ == "__main__":
    main()
