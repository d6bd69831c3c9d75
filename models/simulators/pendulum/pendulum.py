"""A pendulum from its release on: angles at the times of the data, by Runge and Kutta's method of fourth order.

A request on each line of standard input, an answer on each line of standard output; one request is a run.
"""
import json
import math
import sys

STEP = 0.0125  # s, at most


def swing(times, length, g, release, viscous=0, quadratic=0, coulomb=0):
    def slopes(angle, rate):
        friction = viscous*rate + quadratic*rate*abs(rate) + coulomb*math.tanh(rate/0.005)
        return rate, -g/length*math.sin(angle) - friction

    angle, rate, time, angles = release, 0.0, 0.0, []
    for row in times:
        steps = math.ceil((row - time)/STEP - 1e-6)
        h = (row - time)/max(steps, 1)
        for _ in range(steps):
            a1, b1 = slopes(angle, rate)
            a2, b2 = slopes(angle + h/2*a1, rate + h/2*b1)
            a3, b3 = slopes(angle + h/2*a2, rate + h/2*b2)
            a4, b4 = slopes(angle + h*a3, rate + h*b3)
            angle += h/6*(a1 + 2*a2 + 2*a3 + a4)
            rate += h/6*(b1 + 2*b2 + 2*b3 + b4)
        time = row
        angles.append(1e3*angle)
    return {"angle": angles}


if __name__ == "__main__":
    for line in sys.stdin:
        request = json.loads(line)
        answer = swing(request["conditions"]["t"], **request["parameters"])
        print(json.dumps(answer), flush=True)
