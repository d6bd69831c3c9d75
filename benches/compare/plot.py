"""The plots: time against trials, inputs and threads, and as work grows."""

import growth
import matplotlib
from report import grown, with_capped

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import ticker  # noqa: E402

COLOURS = {"gumption": "#0b6e4f", "numpy": "#b23a48", "numba-partition": "#3d5a99"}
LABELS = {"gumption": "gumption", "numpy": "numpy", "numba-partition": "numba, tuned by hand"}


def curves(axes, data, label):
    for name, points in data.items():
        points = [point for point in points if point[1] > 0]
        axes.loglog(*zip(*points), "o-", color=COLOURS[name], label=LABELS[name], markersize=4)
    axes.set_xlabel(label)
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


# the same file from the same numbers
plt.rcParams.update({"svg.hashsalt": "gumption", "font.size": 9, "svg.fonttype": "none"})


def draw(results, path):
    figure, (trials, inputs, threads) = plt.subplots(1, 3, figsize=(11, 3.6))
    curves(trials, with_capped(results), "trials (W1)")
    trials.set_ylabel("CPU time, s")
    trials.legend(frameon=False)
    curves(inputs, results["inputs"], "inputs (sum, 1e5 trials)")
    for (workload, lines), marker in zip(results["threads"].items(), "os^"):
        counts = [int(count) for count in lines]
        first = lines["1"]["wall_s"]
        gains = [first / lines[str(count)]["wall_s"] for count in counts]
        threads.plot(counts, gains, f"{marker}-", label=workload, markersize=4)
    most = max(counts)
    threads.plot([1, most], [1, most], ":", color="#888888", label="ideal")
    threads.set_xlabel("threads")
    threads.set_ylabel("times as fast (wall time)")
    threads.set_xticks(counts)
    threads.grid(True, color="#dddddd", linewidth=0.6)
    threads.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None, "Creator": None})


def draw_growth(results, path):
    found = grown(results)
    figure, panels = plt.subplots(1, len(found), figsize=(13, 3))
    for axes, (what, points) in zip(panels, found.items()):
        axes.loglog(*zip(*points), "o-", color=COLOURS["gumption"], markersize=4)
        axes.set_xlabel(growth.WHAT[what].replace("`", ""))
        axes.set_title(f"exponent {growth.exponent(points):.2f}", fontsize=9)
        for axis, values in zip((axes.xaxis, axes.yaxis), zip(*points)):
            axis.set_minor_formatter(ticker.NullFormatter())
            # whole powers of ten are too few
            if max(values) < 100 * min(values):
                axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
                axis.set_major_formatter("{x:g}")
        axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
    panels[0].set_ylabel("CPU time, s")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None, "Creator": None})
