"""A shaker whose table carries an inclined plane that can move sideways: two masses, integrated in time.

A request on each line of standard input, an answer on each line of standard output; one request is a run.
The table (with all that it carries) moves upwards by z. The plane with the sensor is a part of it that moves by
y against the table on a spring, in a direction that is inclined to the horizontal by the angle `lean`.
"""
import json
import math
import sys

PLANE = 0.4  # of the table's mass
STEPS = 2  # between two rows


def shaker(conditions, mass, suspension, loss, force_factor, tilt, lean=0, mode=80, q=10, cubic=0, offset=0):
    omega, share = 2*math.pi*mode, PLANE*math.sin(lean)
    stiffness, damping = (2*math.pi*suspension)**2, loss*4*math.pi*suspension

    def accelerations(z, w, y, v, force):
        free = force/mass - damping*w - stiffness*z*(1 + cubic*1e6*z*z)
        spring = -omega*omega*y - omega/q*v
        # z'' + share y'' = free and y'' + sin(lean) z'' = spring
        up = (free - share*spring)/(1 - share*math.sin(lean))
        return up, spring - math.sin(lean)*up

    angle = math.radians(tilt + offset)
    times, currents = conditions["t"], conditions["current"]
    at, along, upright = (0.0, 0.0, 0.0, 0.0), [], []

    def slopes(state, force):
        up, sideways = accelerations(*state, force)
        return state[1], up, state[3], sideways

    def moved(state, slope, h):
        return tuple(x + h*s for x, s in zip(state, slope))

    for row, time in enumerate(times):
        before = max(row - 1, 0)
        h, change = (time - times[before])/STEPS, (currents[row] - currents[before])/STEPS
        for step in range(STEPS if h else 0):
            begin = force_factor*(currents[before] + step*change)
            end = begin + force_factor*change
            a = slopes(at, begin)
            b = slopes(moved(at, a, h/2), (begin + end)/2)
            c = slopes(moved(at, b, h/2), (begin + end)/2)
            d = slopes(moved(at, c, h), end)
            at = tuple(x + h/6*(k + 2*l + 2*m + n) for x, k, l, m, n in zip(at, a, b, c, d))
        up, sideways = accelerations(*at, force_factor*currents[row])
        up, sideways = up + sideways*math.sin(lean), sideways*math.cos(lean)
        along.append(up*math.sin(angle) + sideways*math.cos(angle))
        upright.append(up*math.cos(angle) - sideways*math.sin(angle))
    return {"a_x": along, "a_z": upright}


if __name__ == "__main__":
    for line in sys.stdin:
        request = json.loads(line)
        print(json.dumps(shaker(request["conditions"], **request["parameters"])), flush=True)
