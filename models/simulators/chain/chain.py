"""The measuring chain of an accelerometer as filters in time: its voltage at the times of the data.

A request on each line of standard input, an answer on each line of standard output; one request is a run.
"""
import json
import math
import sys


def delayed(times, values, delay):
    """Values a time later, straight between those of the rows, and at rest before the first."""
    found, place = [], 0
    for time in times:
        while place + 1 < len(times) and times[place + 1] <= time - delay:
            place += 1
        ahead = time - delay - times[place]
        if ahead <= 0 or place + 1 == len(times):
            found.append(values[place] if ahead >= 0 else 0.0)
            continue
        share = ahead/(times[place + 1] - times[place])
        found.append(values[place] + share*(values[place + 1] - values[place]))
    return found


def low_pass(times, values, tau):
    """A filter of first order that begins at rest, exact for values that are straight between the rows."""
    if tau == 0:
        return values
    found, state = [0.0], 0.0
    for place in range(1, len(times)):
        h, before, change = times[place] - times[place - 1], values[place - 1], values[place] - values[place - 1]
        kept = math.exp(-h/tau)
        state = kept*state + (1 - kept)*before + change*(1 - tau/h*(1 - kept))
        found.append(state)
    return found


def high_pass(times, values, cut_off):
    if cut_off == 0:
        return values
    slow = low_pass(times, values, 1/(2*math.pi*cut_off))
    return [value - part for value, part in zip(values, slow)]


def voltage(times, values, sensitivity, sensor, zero, coupling=0, lag=0, delay=0):
    """Of one recording in mV: cut-off frequencies in Hz, lag and delay in ms."""
    values = delayed(times, values, delay/1e3)
    values = low_pass(times, values, 1/(2*math.pi*sensor))
    values = high_pass(times, values, coupling)
    values = low_pass(times, values, lag/1e3)
    return [sensitivity*value + zero for value in values]


def chain(conditions, **parameters):
    """All recordings, each from rest."""
    voltages, begin = [], 0
    times, values, recordings = (conditions[name] for name in ("t", "acceleration", "recording"))
    for end in range(1, len(times) + 1):
        if end == len(times) or recordings[end] != recordings[begin]:
            voltages += voltage(times[begin:end], values[begin:end], **parameters)
            begin = end
    return {"voltage": voltages}


if __name__ == "__main__":
    for line in sys.stdin:
        request = json.loads(line)
        print(json.dumps(chain(request["conditions"], **request["parameters"])), flush=True)
