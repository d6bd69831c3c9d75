"""reports/performance.md from the measurements."""

import math
import statistics

import growth
from agreement import disagreements
from contest import median, ratio
from goals import Goals, seconds
from waits import middle

# A machine is taken as busy where a tool on one thread waits for more than this share of its time.
BUSY = 1.1

TEXT = {
    "W1": "inclined plane with spurious motion, nine inputs, one output (Prato et al. 2020, eq (8))",
    "W2": "sum of four rectangular quantities (JCGM 101, 9.2.3)",
    "W3": "campaign: 384 conditions, three outputs each (eqs (8) to (10))",
    "W4": "gauge block, nine inputs, four of them t (JCGM 101, 9.5, non-linear)",
    "W5": "the law of propagation alone: budgets of W1 at different references",
}


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"


def waiting(results):
    """Wall time over CPU time of gumption on one thread, the median over the workloads."""
    shares = []
    for lines in results["workloads"].values():
        line = lines["gumption"]
        shares += [wall / cpu for wall, cpu in zip(line["wall_s"], line["cpu_s"])]
    return statistics.median(shares)


def opening(results):
    machine, versions = results["machine"], results["versions"]
    tools = ", ".join(f"{name} {version}" for name, version in versions.items())
    lines = [
        "# Performance",
        "",
        "Written by `benches/compare.sh`; how it measures is in `benches/README.md`. All tools ran "
        "in turn in one run, each end to end: draw, evaluate, mean, standard uncertainty, "
        "symmetric and shortest 95 % interval; gumption besides the law of propagation, median, "
        "skewness, kurtosis, all numerical standard errors and clause 8. Compare ratios; times "
        "are of one machine on one day.",
        "",
        f"Machine: {machine['processor']}, {machine['architecture']}, {machine['threads']} "
        f"threads, vectors: {machine['vectors']}, {machine['system']}. Tools: {tools}.",
        "",
    ]
    if results["quick"]:
        lines += ["**Quick form**: few trials and few repeats; only shows that everything runs.", ""]
    if not results["quick"] and results["most_rounds"] < 5:
        lines += [f"Medians of {results['most_rounds']} repeats only (`--rounds`).", ""]
    share = waiting(results)
    if share > BUSY:
        lines += [
            f"The machine was busy with other work: a single thread waited {share - 1:.0%} of its "
            "computing time. CPU times are hardly touched by that, wall times are; what rests on "
            "wall time is marked `*` and is to be measured again on a quiet machine.",
            "",
        ]
    return "\n".join(lines)


def goals(results):
    mark = "*" if waiting(results) > BUSY else ""
    rows = []
    for goal in Goals(results).found:
        cells = goal.cells()
        if goal.wall:
            cells[-1] += mark
        rows.append(cells)
    text = "Ratios are times as fast, medians over the rounds, in CPU time of one thread unless "
    text += "something else is said.\n\n"
    return "## Goals\n\n" + text + table(["", "goal", "measured", ""], rows)


def workloads(results):
    parts = ["## Workloads\n"]
    for key, lines in results["workloads"].items():
        workload, trials = key.split()
        parts.append(f"### {workload}, {trials} {'budgets' if workload == 'W5' else 'trials'}\n")
        parts.append(TEXT[workload] + "\n")
        rows = []
        for name, line in lines.items():
            cpu, wall = median(line), median(line, "wall_s")
            rows.append(
                [
                    name,
                    seconds(statistics.median(line["cpu_s"])),
                    seconds(statistics.median(line["wall_s"])),
                    f"{cpu * 1e9:.4g}",
                    f"{1e-6 / cpu:.3g}",
                    f"{ratio(line, lines['gumption']):.3g}",
                    f"{ratio(line, lines['gumption'], 'wall_s'):.3g}",
                    f"{line['before_mb']:.0f}",
                    f"{line['peak_mb']:.0f}",
                ]
            )
        unit = "budget" if workload == "W5" else "trial"
        head = ["tool", "CPU", "wall", f"CPU ns a {unit}", f"million {unit}s/CPU s"]
        head += ["CPU times gumption's", "wall", "MB before", "MB peak"]
        parts.append(table(head, rows))
    if "W5 1e5" in results["workloads"]:
        parts.append("GTC evaluated 1,000 of the budgets of W5.\n")
    return "\n".join(parts)


def agreement(results):
    wrong = disagreements(results["workloads"])
    if wrong:
        return "## Agreement\n\n" + "\n".join(f"- **{line}**" for line in wrong) + "\n"
    return (
        "## Agreement\n\nAll tools gave the same figures within sampling error (six standard errors "
        "of the difference; budgets to 1e-6), and gumption the same bits on every code path and on "
        "two threads.\n"
    )


def large(results):
    rows = []
    for what, pair in results["large"].items():
        cpu = [statistics.median(line["cpu_s"]) for line in pair]
        size = [f"`{line['workload']}`, {line['trials']} trials" for line in pair]
        rows.append([what, size[0], seconds(cpu[0]), size[1], seconds(cpu[1]), f"{cpu[1] / cpu[0]:.2f}"])
    text = "What doubles, and what that does to the CPU time of an evaluation on one thread: 2 is "
    text += "linear, 4 quadratic (models: `benches/measure/generated.rs`). Finding the joint draw "
    text += "of correlated inputs, once for a task, is not in.\n\n"
    head = ["twice as many", "", "CPU", "", "CPU", "ratio"]
    return "## Large models\n\n" + text + table(head, rows)


def waits(results):
    """What users wait for, of the earlier version as well where it was measured."""
    found = results.get("waits")
    if not found:
        return ""
    with_before = any("before" in wait["runs"] for wait in found)
    rows = []
    for wait in found:
        cells, figures = [wait["what"]], {}
        for name in ("before", "after") if with_before else ("after",):
            runs = wait["runs"].get(name)
            if runs:
                figures[name] = middle(runs, "cpu_s"), middle(runs, "mb")
                cells.append("{}, {:.0f} MB".format(seconds(figures[name][0]), figures[name][1]))
            else:
                cells.append("refused" if runs == [] else "")
        if with_before:
            both = len(figures) == 2
            cells.append(f"{figures['before'][0] / figures['after'][0]:.3g} x" if both else "")
        goals = [(wait["goal"], seconds), (wait["goal_mb"], lambda mb: f"{mb:g} MB")]
        after = figures.get("after", (math.inf, math.inf))
        stated = [
            f"<= {show(goal)}: {'met' if value <= goal else 'not met'}"
            for (goal, show), value in zip(goals, after)
            if goal
        ]
        rows.append([*cells, "; ".join(stated)])
    head = ["", *(["before", "after", "times as fast"] if with_before else ["CPU, memory"]), "goal"]
    text = "Whole commands, from process start to exit, and tasks in Python, from the call to the "
    text += "result: processor time of all threads and most memory."
    text += " Goals of seconds are for a processor with AVX-512."
    text += " Before: an earlier version, measured in turn.\n\n" if with_before else "\n\n"
    return "## What users wait for\n\n" + text + table(head, rows)


def with_capped(results):
    """The curve of trials with the capped run at its end."""
    curve = {name: list(points) for name, points in results["trials"].items()}
    for trials, lines in results["memory"].items():
        curve["gumption"].append([int(float(trials)), lines["capped"]["cpu_s"][0]])
    return curve


def curves(results):
    by_trials = with_capped(results)
    counts = sorted({point[0] for points in by_trials.values() for point in points})
    rows = []
    for count in counts:
        row = [f"1e{len(str(count)) - 1}"]
        for points in by_trials.values():
            found = dict(map(tuple, points)).get(count)
            row.append(f"{seconds(found)}, {found / count * 1e9:.3g} ns" if found else "")
        rows.append(row)
    text = "![Time against trials, inputs and threads](performance.svg)\n\n"
    text += "CPU time of W1, in all and for a trial:\n\n"
    text += table(["trials", *by_trials], rows) + "\nSums of rectangular quantities, 1e5 "
    text += "trials, CPU time:\n\n"
    rows = []
    for place, (count, _) in enumerate(results["inputs"]["gumption"]):
        row = [count]
        row += [seconds(points[place][1]) for points in results["inputs"].values()]
        rows.append(row)
    text += table(["inputs", *results["inputs"]], rows) + "\nThreads:\n\n"
    rows = []
    for workload, lines in results["threads"].items():
        for count, line in lines.items():
            gain = lines["1"]["wall_s"] / line["wall_s"]
            rows.append([workload, count, seconds(line["cpu_s"]), seconds(line["wall_s"]), f"{gain:.2f}"])
    text += table(["workload", "threads", "CPU", "wall", "times as fast"], rows)
    return "## Trials, inputs, threads\n\n" + text


def grown(results):
    """What grows, with its points: those of the trials are in the curves."""
    return {"trials": with_capped(results)["gumption"], **results["growth"]}


def growing(results):
    """CPU time as work grows, and the power that it grows with."""
    if "growth" not in results:
        return ""
    rows = []
    for what, points in grown(results).items():
        power, must = growth.exponent(points), growth.MUST[what]
        cells = [f"{count:,}: {seconds(found)}" for count, found in points]
        rows.append([growth.WHAT[what], "; ".join(cells), f"{power:.2f}", must])
    text = "![CPU time as work grows](growth.svg)\n\nOne thread for trials, inputs and outputs, whole "
    text += "commands for rows and candidates. The exponent is that between the last two points; the "
    text += "greatest that it may be is 2 where every pair counts: of outputs, whose correlation "
    text += "coefficients are found, and of candidates, which are hypotheses.\n\n"
    return "## Cost as work grows\n\n" + text + table(["", "CPU time", "exponent", "at most"], rows)


def generator(text):
    return "## Generator\n\n" + (text or "Not tested: `benches/generator.sh` does it.\n")


def write(results, generator_text):
    parts = [opening(results), goals(results), workloads(results), agreement(results)]
    parts += [curves(results), large(results), growing(results), waits(results)]
    parts.append(generator(generator_text))
    return "\n".join(part for part in parts if part)
