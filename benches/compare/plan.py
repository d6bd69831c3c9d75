"""What is measured."""

import json
import os
import resource
import statistics
import subprocess
import sys
import time

import growth
import waits
from contest import Contender, contest

CONDITIONS = 384  # of W3
PEERS = os.path.join(os.path.dirname(__file__), "..", "peers.py")


class Plan:
    """`paths`: the machine's code paths, slowest first."""

    def __init__(self, workload_binary, command_binary, paths, options):
        self.binary, self.command = workload_binary, os.path.abspath(command_binary)
        self.paths, self.quick = paths, options.quick
        self.most_rounds = options.rounds
        self.options = options
        self.best = paths[-1]

    def engine(self, name, workload, trials, threads=1, path=None, memory=64):
        command = [self.binary, "--workload", workload, "--trials", str(trials)]
        command += ["--threads", str(threads), "--path", path or self.best]
        command += ["--memory", str(memory)]
        return Contender(name, command, self.units(workload, trials))

    def peer(self, name, tool, workload, trials, threads=1):
        command = [sys.executable, PEERS, "--tool", tool, "--workload", workload]
        command += ["--trials", str(trials), "--threads", str(threads)]
        return Contender(name, command, self.units(workload, trials))

    @staticmethod
    def units(workload, trials):
        if trials == "adaptive":
            return 1
        return int(float(trials)) * (CONDITIONS if workload == "W3" else 1)

    def say(self, what):
        print(what, file=sys.stderr, flush=True)

    def rounds(self, full):
        return min(3 if self.quick else full, self.most_rounds)

    # ------------------------------------------------------------------------------ the workloads

    def engines(self, workload, trials, formula=False):
        out = [self.engine("gumption", workload, trials)]
        for path in reversed(self.paths[:-1]):
            out.append(self.engine(f"gumption, {path}", workload, trials, path=path))
        if formula:
            out.append(self.engine("gumption, formula", f"{workload}-formula", trials))
        out.append(self.engine("gumption, 2 threads", workload, trials, threads=2))
        return out

    def workloads(self):
        sizes = ["1e5"] if self.quick else ["1e6", "1e7"]
        plans = [(w, trials) for w in ("W1", "W2") for trials in sizes]
        plans += [("W3", "1e3" if self.quick else "1e5")]
        plans += [("W4", trials) for trials in sizes]
        plans += [("W5", "1e4" if self.quick else "1e5")]
        done = self.kept.setdefault("workloads", {})
        for workload, trials in plans:
            if f"{workload} {trials}" in done:
                continue
            self.say(f"{workload}, {trials}")
            contenders = self.engines(workload, trials, formula=workload == "W1")
            peers = ["numpy", "numba"]
            if workload in ("W1", "W2"):
                peers += ["numba-tuned", "numba-partition"]
            contenders += [self.peer(tool, tool, workload, trials) for tool in peers]
            if workload == "W1":
                for tool in peers[1:]:
                    name = f"{tool}, 2 threads"
                    contenders.append(self.peer(name, tool, workload, trials, threads=2))
            if workload == "W5":
                contenders.append(self.engine("gumption, all inputs in columns", "W5-all", trials))
                contenders.append(self.engine("gumption, row by row", "W5-rows", trials))
                contenders.append(self.peer("gtc", "gtc", workload, "1e3"))
            long = trials == "1e7" or workload == "W3"
            done[f"{workload} {trials}"] = contest(contenders, self.rounds(5 if long else 9))
            self.keep()
        return done

    # ------------------------------------------------------------------------------------ memory

    def memory(self):
        """The cap on kept values against one pass, which needs about a byte for each trial."""
        trials = "1e8" if self.quick else "1e9"
        self.say(f"W1, {trials}, with and without the cap")
        contenders = [
            self.engine("capped", "W1", trials),
            self.engine("one pass", "W1", trials, memory=8192),
        ]
        return {trials: contest(contenders, 1)}

    # ---------------------------------------------------------------------------------- adaptive

    def adaptive(self):
        self.say("W1, adaptive to three digits")
        first = contest([self.engine("adaptive", "W1", "adaptive")], 1)["adaptive"]
        trials = first["trials"]
        contenders = [
            self.engine("adaptive", "W1", "adaptive"),
            self.engine("as many", "W1", trials),
            self.engine("adaptive, 2 threads", "W1", "adaptive", threads=2),
            self.engine("as many, 2 threads", "W1", trials, threads=2),
        ]
        lines = contest(contenders, self.rounds(9))
        for line in lines.values():
            line["units"] = trials
        return lines

    # ----------------------------------------------------------------------------- whole command

    def process(self):
        """Seconds of `gumption run` on W1 at 1e6 trials, from process start to exit."""
        self.say("gumption run")
        command = [self.command, "run", "benches/models/plane_typed.json", "--quiet"]
        wall, cpu = [], []
        for _ in range(self.rounds(31) + 1):
            start, before = time.perf_counter(), self.children()
            subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
            wall.append(time.perf_counter() - start)
            cpu.append(self.children() - before)
        # the first one reads the program from the disk
        return {"wall_s": wall[1:], "cpu_s": cpu[1:]}

    @staticmethod
    def children():
        """CPU seconds of the processes that have ended."""
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    # -------------------------------------------------------------------------------- the curves

    def trials(self):
        """Time against trials of W1."""
        most = 6 if self.quick else 8
        limits = {"gumption": 8, "numpy": 7, "numba-partition": 8}
        curves = {name: [] for name in limits}
        for power in range(4, most + 1):
            trials = f"1e{power}"
            self.say(f"W1, {trials}")
            contenders = []
            for name, limit in limits.items():
                if power <= limit:
                    maker = self.engine if name == "gumption" else self.named_peer
                    contenders.append(maker(name, "W1", trials))
            rounds = 1 if power >= 8 else self.rounds(5)
            for name, line in contest(contenders, rounds).items():
                curves[name].append([10**power, statistics.median(line["cpu_s"])])
        return curves

    def named_peer(self, name, workload, trials):
        return self.peer(name, name, workload, trials)

    def inputs(self):
        """Time against the number of inputs: sums of rectangular quantities, 1e5 trials."""
        counts = [1, 10, 100] if self.quick else [1, 3, 10, 30, 100, 300, 1000]
        curves = {"gumption": [], "numpy": [], "numba-partition": []}
        for count in counts:
            self.say(f"{count} inputs")
            workload = f"sum:{count}"
            contenders = [self.engine("gumption", workload, "1e5")]
            contenders += [self.named_peer(n, workload, "1e5") for n in list(curves)[1:]]
            for name, line in contest(contenders, self.rounds(5)).items():
                curves[name].append([count, statistics.median(line["cpu_s"])])
        return curves

    def threads(self):
        """Wall and CPU time against threads, up to those of the machine."""
        counts = [1]
        while 2 * counts[-1] <= (os.cpu_count() or 1):
            counts.append(2 * counts[-1])
        curves = {}
        for workload, trials in (("W1", "1e7"), ("W3", "1e5"), ("W4", "1e7")):
            trials = "1e5" if self.quick and workload != "W3" else trials
            trials = "1e3" if self.quick and workload == "W3" else trials
            self.say(f"{workload}, {trials}, threads {counts}")
            contenders = [self.engine(str(n), workload, trials, threads=n) for n in counts]
            lines = contest(contenders, self.rounds(7))
            curves[workload] = {
                n: {k: statistics.median(line[k]) for k in ("cpu_s", "wall_s")}
                for n, line in lines.items()
            }
        return curves

    # ------------------------------------------------------------------------------ large models

    def large(self):
        """Pairs of which the second is twice the first in one respect."""
        half, whole = ("500", "1000") if not self.quick else ("50", "100")
        operations = ("5000", "10000") if not self.quick else ("500", "1000")
        pairs = {
            "trials, 1,000 inputs": [(f"sum:{whole}", "5e4"), (f"sum:{whole}", "1e5")],
            "inputs": [(f"sum:{half}", "1e5"), (f"sum:{whole}", "1e5")],
            "operations of a formula": [(f"formula:{n}", "5e4") for n in operations],
            "correlated inputs": [(f"correlated:{half}", "1e4"), (f"correlated:{whole}", "1e4")],
            "trials, 1,000 correlated inputs": [
                (f"correlated:{whole}", "1e4"),
                (f"correlated:{whole}", "2e4"),
            ],
            "outputs": [("outputs:50", "1e5"), ("outputs:100", "1e5")],
        }
        done = {}
        for what, pair in pairs.items():
            self.say(f"large models: {what}")
            contenders = [self.engine(str(i), w, trials) for i, (w, trials) in enumerate(pair)]
            lines = contest(contenders, self.rounds(5))
            rows = [(w, trials, lines[str(i)]) for i, (w, trials) in enumerate(pair)]
            done[what] = [
                {
                    "workload": w,
                    "trials": trials,
                    "cpu_s": line["cpu_s"],
                    "peak_mb": line["peak_mb"],
                }
                for w, trials, line in rows
            ]
        return done

    # -------------------------------------------------------------------------- whole commands

    def waits(self):
        """What users wait for, and the same of an earlier version if there is one."""
        command = [sys.executable, waits.__file__, "--json", "--program", self.command]
        command += ["--rounds", str(self.rounds(3)), *(["--quick"] if self.quick else [])]
        for name in ("before", "python", "python_before"):
            if tool := getattr(self.options, name):
                command += [f"--{name.replace('_', '-')}", tool]
        return json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)

    def parts(self):
        """What is measured, by name."""
        return {
            "workloads": self.workloads,
            "adaptive": self.adaptive,
            "process": self.process,
            "waits": self.waits,
            "inputs": self.inputs,
            "threads": self.threads,
            "large": self.large,
            "trials": self.trials,
            "memory": self.memory,
            "growth": lambda: growth.measured(self),
        }

    def fill(self, results, keep):
        """Measures what the results have not yet; `keep` is called after each part."""
        self.kept, self.keep = results, lambda: keep(results)
        for name, part in self.parts().items():
            if name not in results or name == "workloads":
                results[name] = part()
                self.keep()
        results["complete"] = True
        self.keep()
