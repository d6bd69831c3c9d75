"""Makes the data of the simulators' cases with seeds that are fixed, into the folders of the cases or into those
of the same names below FOLDER: python3 models/simulators/make.py [FOLDER]"""
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).parent
sys.path[:0] = [str(HERE / name) for name in ("pendulum", "chain", "shaker")]
import chain as chains
import pendulum as pendulums
import shaker as shakers


def noisy(seed, deviation, values):
    noise = random.Random(seed)
    return [value + noise.gauss(0, deviation) for value in values]


def pendulum():
    """Loses energy by a Coulomb friction of 0.06 1/s^2."""
    times = [row/20 for row in range(401)]
    parameters = {"length": 0.5003, "g": 9.8066, "release": 0.351, "viscous": 0, "quadratic": 0, "coulomb": 0.06}
    angles = pendulums.swing(times, **parameters)["angle"]
    return {"t": times, "angle": noisy(1, 5, angles)}


def slide(time):
    """0.5 Hz and 1.5 Hz in m/s^2."""
    return 1.5*math.sin(math.pi*time) + 0.6*math.sin(3*math.pi*time)


def sweep(time, begin, end, duration):
    """A sine from one frequency to the other, with the amplitude 1."""
    return math.sin(2*math.pi*time*(begin + (end - begin)*time/duration/2))


def recordings():
    """The conditions of the chain's data: a slide, then a sweep."""
    times = [row/100 for row in range(300)]
    motions = [slide(time) for time in times], [2*sweep(time, 1, 8, 3) for time in times]
    return {
        "t": times + times,
        "acceleration": [float(f"{value:.7g}") for motion in motions for value in motion],
        "recording": [1]*300 + [2]*300,
    }


def voltages(coupling):
    return chains.chain(recordings(), sensitivity=10.17, sensor=64, zero=0.08, coupling=coupling)["voltage"]


def chain():
    """AC-coupled with 0.5 Hz."""
    return recordings() | {"voltage": noisy(2, 1, voltages(0.5))}


def compressed_chain():
    """DC-coupled, with an amplifier that gives 16 % less at 20 mV."""
    return recordings() | {"voltage": noisy(5, 1, [value*(1 - (value/50)**2) for value in voltages(0)])}


def shaker():
    """A lateral mode at 80 Hz."""
    times = [row/1000 for row in range(500)]
    currents = [float(f"{0.6*sweep(time, 30, 130, 0.5):.7g}") for time in times]
    conditions = {"t": times, "current": currents}
    parameters = {"mass": 0.752, "suspension": 12.1, "loss": 0.09, "force_factor": 12.52, "tilt": 35.03,
                  "lean": 0.03, "mode": 80, "q": 6, "cubic": 0, "offset": 0}
    found = shakers.shaker(conditions, **parameters)
    return conditions | {"a_x": noisy(3, 0.1, found["a_x"]), "a_z": noisy(4, 0.1, found["a_z"])}


def write(file, columns):
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w", newline="\n") as out:
        out.write("# synthetic, made by models/simulators/make.py\n" + ",".join(columns) + "\n")
        rows = zip(*columns.values())
        out.writelines(",".join(f"{value:.7g}" for value in row) + "\n" for row in rows)


if __name__ == "__main__":
    into = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    write(into / "pendulum/data.csv", pendulum())
    write(into / "chain/data.csv", chain())
    write(into / "chain/withheld.csv", compressed_chain())
    write(into / "shaker/data.csv", shaker())
