"""Tools measured in turn: each in a process of its own that makes one repeat when it is asked, so
that a change of the machine's speed meets all alike."""

import json
import statistics
import subprocess
import sys


class Contender:
    """A tool with its settings. `units`: trials (or budgets) of one repeat."""

    def __init__(self, name, command, units):
        self.name, self.command, self.units = name, command, units

    def start(self):
        self.process = subprocess.Popen(
            [*self.command, "--on-demand"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.expect("ready")

    def expect(self, word):
        line = self.process.stdout.readline().strip()
        if line != word:
            self.process.kill()
            sys.exit(f"{self.name}: found `{line}`, expected `{word}`: {' '.join(self.command)}")

    def repeat(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        self.expect("done")

    def finish(self):
        out, _ = self.process.communicate()
        line = json.loads(out)
        line.update(name=self.name, units=self.units)
        return line


def contest(contenders, rounds):
    """One line of measurements for each contender, by name."""
    for contender in contenders:
        contender.start()
    for _ in range(rounds):
        for contender in contenders:
            contender.repeat()
    return {contender.name: contender.finish() for contender in contenders}


def per_unit(line, clock):
    """Seconds of each repeat by trial or budget."""
    return [seconds / line["units"] for seconds in line[clock]]


def median(line, clock="cpu_s"):
    """Median seconds by trial or budget."""
    return statistics.median(per_unit(line, clock))


def ratio(slow, fast, clock="cpu_s"):
    """How many times as long the first takes: the median over the rounds."""
    pairs = zip(per_unit(slow, clock), per_unit(fast, clock))
    return statistics.median(a / b for a, b in pairs)
