"""Whether all tools computed the same."""

import math

# Numerical standard errors that two runs may lie apart, divided by sqrt(2): 6 happens once in 5e8
# comparisons of normally distributed figures. The shortest interval's ends are not normal and
# their errors are estimates themselves; 9 leaves room for that.
FACTORS = {"mean": 6, "u": 6, "symmetric": 6, "shortest": 9}

# Relative. The peers take central differences with a step of 1e-3 u, whose error is of the order
# of that step squared times u over y.
BUDGET = 1e-6


def pairs(value):
    return value if isinstance(value, list) else [value]


def outputs(line):
    return line["result"]


def worst(ours, other):
    """The largest distance of two tools' figures in units of what is allowed."""
    share = 0.0
    for mine, theirs in zip(outputs(ours), outputs(other), strict=True):
        for name, value in mine.items():
            if name == "errors" or theirs.get(name) is None:
                continue
            errors = pairs(mine["errors"][name]) if "errors" in mine else None
            for place, (a, b) in enumerate(zip(pairs(value), pairs(theirs[name]), strict=True)):
                if errors is not None and errors[place] is None:
                    continue  # too few trials to tell
                if errors is None:
                    allowed = BUDGET * abs(a)
                else:
                    # other trials than ours have the error of their own number
                    trials = math.sqrt(1 + ours["trials"] / other["trials"])
                    allowed = FACTORS[name] * errors[place] * trials
                share = max(share, abs(a - b) / allowed)
    return share


def disagreements(workloads):
    """Sentences about the tools whose figures do not agree with gumption's."""
    wrong = []
    for workload, lines in workloads.items():
        ours = lines["gumption"]
        for name, line in lines.items():
            if name.startswith("gumption"):
                if name != "gumption, formula" and line["result"] != ours["result"]:
                    wrong.append(f"{workload}: {name} gives other bits than gumption")
                continue
            if name == "gtc":
                # the last of its budgets is another one
                ours, line = dict(ours, result=ours["result"][:1]), dict(line, result=line["result"][:1])
            share = worst(ours, line)
            if share > 1:
                wrong.append(f"{workload}: {name} lies {share:.2g} times the allowed distance off")
    return wrong
