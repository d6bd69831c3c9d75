"""The goals of gumption's speed and what was measured."""

import statistics

from contest import median, ratio

MB = 1e6
CAP = 64 * 2**20 / MB


def times(value):
    return f"{value:.3g} x"


def seconds(value):
    for unit, factor in (("s", 1), ("ms", 1e3), ("us", 1e6)):
        if value * factor >= 1:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


class Goal:
    """`least`: whether the value is to be at least the goal. `wall`: whether wall time is in it."""

    def __init__(self, what, goal, value, show=times, least=True, wall=False, stretch=None):
        self.what, self.goal, self.value, self.show = what, goal, value, show
        self.least, self.wall, self.stretch = least, wall, stretch

    @property
    def met(self):
        return self.value >= self.goal if self.least else self.value <= self.goal

    def cells(self):
        sign = ">=" if self.least else "<="
        goal = f"{sign} {self.show(self.goal)}"
        if self.stretch:
            goal += f" (stretch {self.show(self.stretch)})"
        verdict = "met" if self.met else "not met"
        if self.stretch and self.value >= self.stretch:
            verdict = "met, stretch too"
        return [self.what, goal, self.show(self.value), verdict]


def against(lines, ours, peer, clock="cpu_s"):
    return ratio(lines[peer], lines[ours], clock)


class Goals:
    def __init__(self, results):
        self.results = results
        self.found = []
        self.best = results["paths"][-1]
        self.workload_goals()
        self.other_goals()

    def add(self, *arguments, **options):
        self.found.append(Goal(*arguments, **options))

    def by_path(self, key, what, peer, goals, stretch=None, clock="cpu_s"):
        """`goals`: by code path; a path that the machine has not is left out."""
        lines = self.results["workloads"].get(key)
        if not lines:
            return
        for path, goal in goals.items():
            ours = "gumption" if path == self.best else f"gumption, {path}"
            if ours in lines:
                value = against(lines, ours, peer, clock)
                further = stretch if path == "avx512" else None
                wall = clock == "wall_s"
                label = f"{what}, {path}"
                self.add(label, goal, value, wall=wall, stretch=further)

    def workload_goals(self):
        of = self.by_path
        first = {"avx512": 12, "avx2": 9, "baseline": 2.5}
        of("W1 1e6", "W1, 1e6 trials, against numpy", "numpy", first, 18)
        second = {"avx512": 18, "avx2": 11, "baseline": 2.5}
        of("W1 1e7", "W1, 1e7 trials, against numpy", "numpy", second, 28)
        tuned = {"avx512": 6, "avx2": 2.5}
        for trials in ("1e6", "1e7"):
            what = f"W1, {trials} trials, against tuned numba"
            of(f"W1 {trials}", f"{what}, one thread, CPU", "numba-tuned", tuned, 10)
            lines = self.results["workloads"].get(f"W1 {trials}")
            if lines:
                value = against(lines, "gumption, 2 threads", "numba-tuned, 2 threads", "wall_s")
                goal = tuned.get(self.best, 1)
                self.add(f"{what}, two threads, wall", goal, value, wall=True)
        of("W2 1e6", "W2, 1e6 trials, against numpy", "numpy", {"avx512": 5, "avx2": 5})
        of("W2 1e7", "W2, 1e7 trials, against numpy", "numpy", {"avx512": 6, "avx2": 6})
        of("W3 1e5", "W3 against numpy", "numpy", {"avx512": 10, "avx2": 4}, 15)
        of("W4 1e6", "W4, 1e6 trials, against numpy", "numpy", {"avx512": 10, "avx2": 4})
        of("W4 1e7", "W4, 1e7 trials, against numpy", "numpy", {"avx512": 14, "avx2": 4})

    def other_goals(self):
        workloads = self.results["workloads"]
        if lines := workloads.get("W5 1e5"):
            rate = 1 / median(lines["gumption"])
            show = lambda value: f"{value / 1e6:.3g} million/s"  # noqa: E731
            self.add("W5, budgets of one thread", 5e6, rate, show=show)
            self.add("W5 against numpy", 8, against(lines, "gumption", "numpy"))
            self.add("W5 against GTC", 1000, against(lines, "gumption", "gtc"))
        for key, lines in workloads.items():
            if "gumption, formula" in lines:
                value = ratio(lines["gumption, formula"], lines["gumption"])
                what = f"a formula against the typed model, {key.replace(' ', ', ')} trials"
                self.add(what, 1.3, value, least=False)
        for key, goal in (("W1 1e7", 1.7), ("W4 1e7", 1.7), ("W3 1e5", 1.9)):
            if lines := workloads.get(key):
                value = against(lines, "gumption, 2 threads", "gumption", "wall_s")
                self.add(f"two threads against one, {key.split()[0]}", goal, value, wall=True)
        half, whole = (statistics.median(line["cpu_s"]) for line in self.results["large"]["outputs"])
        self.add("twice as many outputs", 2.1, whole / half, least=False)
        show = lambda value: f"{value:.3g} MB"  # noqa: E731
        if lines := workloads.get("W1 1e7"):
            for threads, name in ((1, "gumption"), (2, "gumption, 2 threads")):
                what = f"peak memory, W1 at 1e7 trials, {threads} thread{'s' * (threads > 1)}"
                self.add(what, 32, lines[name]["peak_mb"], show=show, least=False)
        for trials, lines in self.results["memory"].items():
            capped = lines["capped"]
            what = f"peak memory of a capped run, W1 at {trials} trials (cap {CAP:.0f} MB)"
            self.add(what, CAP + 16, capped["peak_mb"], show=show, least=False)
            value = ratio(capped, lines["one pass"])
            self.add(f"time of the capped run against one pass, {trials}", 2, value, least=False)
        process = {k: statistics.median(v) for k, v in self.results["process"].items()}
        what = "`gumption run` on W1 at 1e6 trials, start to exit, all threads, wall"
        self.add(what, 0.040, process["wall_s"], show=seconds, least=False, wall=True)
        what = "the same, CPU time"
        self.add(what, 0.040, process["cpu_s"], show=seconds, least=False)
        adaptive = self.results["adaptive"]
        what = "adaptive run to three digits on W1 against as many trials"
        for suffix, clock in (("", "cpu_s"), (", 2 threads", "wall_s")):
            value = ratio(adaptive["adaptive" + suffix], adaptive["as many" + suffix], clock)
            label = what + (suffix and f"{suffix}, wall")
            self.add(label, 1.3, value, least=False, wall=clock == "wall_s")
