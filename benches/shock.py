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
CUT_OFFS = (10e3, 15e3, 20e3, 25e3)  # Hz, at which the filter of both channels takes half of the power
THIN = 20  # one sample of so many is a row
ROWS = range(3400, 7000, THIN)
DEVIATION = 0.008  # standard uncertainty, as a share of the largest value


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


def smoothed(samples, cut_off):
    """Samples through a Gaussian low-pass filter, at the rows."""
    deviation = math.sqrt(math.log(2))/(2*math.pi*cut_off*STEP)
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


def diagnosed(program, channels, cut_off, into):
    """The answer and how many runs were made."""
    inputs, outputs = (smoothed(channel, cut_off) for channel in channels)
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
    return json.loads(said), len((into / "runs" / "runs.jsonl").read_text().splitlines()) - 1


def row(cut_off, answer, runs):
    verdict, found = answer["verdict"], answer["hypotheses"][0]["parameters"]
    effects = " + ".join(verdict["effects"]) or verdict["kind"]
    cells = [f"{cut_off/1e3:.0f} kHz", effects, f"{verdict['probability']:.3f}", runs]
    for name in ("resonance/f0", "resonance/damping"):
        value = found.get(name)
        if value is None:
            cells += [""]*3
            continue
        low, high = value["interval"]
        cells += [f"{value['estimate']:.3g}", f"{value['standard_uncertainty']:.2g}", f"{low:.3g} to {high:.3g}"]
    cells.append(f"{answer['shrinks']['chi2_per_dof_after']:.2g}")
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


TEXT = """# The shock record of an accelerometer

Written by `python3 benches/shock.py PROGRAM FOLDER`. The record is that of PyDynamic's example of a shock calibration at PTB: input and output of a shock accelerometer. Both channels go through the same low-pass filter (Gaussian), and one sample in {thin} about the shock is a row: {rows} rows. The sim is a constant sensitivity, 0.2271(20), and a delay between the channels, 0(1) us. The standard uncertainty of {share} % of the peak is an assumption about the misfit of both channels. Effects: a resonance (20 kHz to 120 kHz), a low-pass filter, a nonlinear sensitivity.

| filter | verdict | probability | runs | f0 in kHz | u | 95 % interval | damping | u | 95 % interval | chi-square per value, left out |
|---|---|---|---|---|---|---|---|---|---|---|
{table}

The sinusoidal calibration of the same sensor, which the diagnosis did not see, gives f0 = 51.37(29) kHz and a damping of 0.083(3). Well below the resonance a second-order system gives 1 + (f/f0)^2, so that f0 follows from frequencies that the reference measures. With the filter of 10 kHz what is left of that is within a smooth departure of any form. The reference does not follow the ringing near the resonance: with a filter that lets it pass, no effect of the list fits, as the chi-square on rows that were left out says.
"""


def report(program, folder):
    channels = [read(folder / f"measured_{name}_accel.txt") for name in ("input", "output")]
    table = []
    for cut_off in CUT_OFFS:
        with tempfile.TemporaryDirectory() as into:
            table.append(row(cut_off, *diagnosed(program, channels, cut_off, pathlib.Path(into))))
    return TEXT.format(thin=THIN, rows=len(ROWS), share=100*DEVIATION, table="\n".join(table))


def main():
    if sys.argv[1:] == ["--simulate"]:
        for line in sys.stdin:
            request = json.loads(line)
            print(json.dumps(sensor(request["conditions"], **request["parameters"])), flush=True)
        return
    text = report(sys.argv[1], pathlib.Path(sys.argv[2]))
    (pathlib.Path(__file__).parent.parent / "reports" / "gap-shock.md").write_text(text)


if __name__ == "__main__":
    main()
