#!/usr/bin/env python3
"""Make a model file of a project that suncal saves (YAML): python3 to_gumption.py pitot.yaml > pitot.json

The first calculation of an uncertainty is taken. What the script does not know is an error: units and
distributions that are not in its tables, equations that are to be solved, sweeps. Needs PyYAML.
"""
import json
import math
import re
import statistics
import sys

import yaml

UNITS = {
    "dimensionless": "1", "percent": "%", "ppm": "ppm", "degree_Celsius": "degC", "degC": "degC",
    "delta_degree_Celsius": "K", "delta_degC": "K", "degree": "deg", "minute": "min", "hour": "hour",
    "inch": "in", "foot": "ft", "decibel": "dB",
}
STEMS = {
    "meter": "m", "gram": "g", "second": "s", "ampere": "A", "kelvin": "K", "mole": "mol", "candela": "cd",
    "radian": "rad", "hertz": "Hz", "newton": "N", "pascal": "Pa", "joule": "J", "watt": "W", "coulomb": "C",
    "volt": "V", "farad": "F", "ohm": "ohm", "siemens": "S", "tesla": "T", "henry": "H", "liter": "L", "bar": "bar",
}
PREFIXES = {
    "": "", "tera": "T", "giga": "G", "mega": "M", "kilo": "k", "hecto": "h", "centi": "c", "milli": "m",
    "micro": "u", "nano": "n", "pico": "p", "femto": "f",
}
HALF_WIDTHS = {"uniform": ("rectangular", 3), "triangular": ("triangular", 6), "arcsine": ("arcsine", 2),
               "resolution": ("rectangular", 3)}
SYMBOLS = set(UNITS.values()) | {p + s for p in PREFIXES.values() for s in STEMS.values()}


def unit(text):
    """The symbols of a unit in the words of Pint, `joule / kelvin / kilogram`."""
    def symbol(match):
        word = match.group(0)
        if word in UNITS:
            return UNITS[word]
        for prefix, sign in PREFIXES.items():
            if word.startswith(prefix) and word[len(prefix):] in STEMS:
                return sign + STEMS[word[len(prefix):]]
        if word in SYMBOLS:
            return word
        sys.exit(f"the unit `{word}` of `{text}` is not known: write it into the tables of this script")
    return re.sub(r"[A-Za-z_]+", symbol, str(text or "1")).replace("**", "^").replace(" ", "")


def amount(value, estimate, own):
    """A number with its unit, or a share of the estimate."""
    text = str(value).strip()
    for sign, size in (("%", 1e-2), ("ppm", 1e-6)):
        if text.endswith(sign):
            return float(text[:-len(sign)]) * size * abs(estimate), None
    return float(text), own


def component(stated, estimate, of_input):
    """A component of a model file, its standard uncertainty as a number in the unit of the input and its dof."""
    kind = stated.get("dist", "normal")
    own = unit(stated["units"]) if stated.get("units") else of_input
    own = own if own != of_input else None
    made = {"name": stated.get("name") or "Type B"}
    if stated.get("desc"):
        made["about"] = stated["desc"]
    dof = float(stated.get("degf", stated.get("df", math.inf)))

    def width(key, divisor=1.0):
        value, in_unit = amount(stated[key], estimate, own)
        value /= divisor
        return (f"{value!r} {in_unit}" if in_unit else value), value

    if kind == "normal":
        if "unc" in stated and "k" in stated:
            made |= {"distribution": "normal", "std": width("unc", float(stated["k"]))[0]}
        elif "unc" in stated:
            # suncal takes the factor of a normal distribution, whatever the degrees of freedom
            factor = statistics.NormalDist().inv_cdf((1 + float(stated.get("conf", 0.95))) / 2)
            made |= {"distribution": "normal", "std": width("unc", factor)[0]}
        else:
            made |= {"distribution": "normal", "std": width("std")[0]}
    elif kind in HALF_WIDTHS:
        shape, _ = HALF_WIDTHS[kind]
        made |= {"distribution": shape, "half_width": width("a", 2.0 if kind == "resolution" else 1.0)[0]}
    else:
        sys.exit(f"`{made['name']}`: the distribution `{kind}` is not known to this script")
    if math.isfinite(dof):
        made["dof"] = dof
    return made


def std_of(made):
    """The standard uncertainty of a component in the unit of its input."""
    if made["distribution"] == "readings":
        return statistics.stdev(made["values"]) / math.sqrt(len(made["values"])), len(made["values"]) - 1
    squares = {"rectangular": 3, "triangular": 6, "arcsine": 2}
    key = "half_width" if "half_width" in made else "std"
    if isinstance(made[key], str):
        sys.exit(f"`{made['name']}`: a correlated input needs its components in its own unit")
    return made[key] / math.sqrt(squares.get(made["distribution"], 1)), made.get("dof", math.inf)


def combined(parts):
    """Components as one normal distribution, with the degrees of freedom of JCGM 100, G.4.1."""
    stds = [std_of(part) for part in parts]
    u = math.sqrt(sum(std * std for std, _ in stds))
    spread = sum(std**4 / dof for std, dof in stds)
    made = {"distribution": "normal", "std": u}
    if spread > 0:
        made["dof"] = u**4 / spread
    return made


def model(project):
    correlated = {name for entry in project.get("correlations") or [] for name in (entry["var1"], entry["var2"])}
    inputs, celsius = {}, []
    for stated in project["inputs"]:
        own = unit(stated.get("units"))
        readings = stated.get("typea")
        estimate = statistics.fmean(readings) if readings else float(stated["mean"])
        parts = []
        if readings:
            parts.append({"name": "Type A", "distribution": "readings", "values": readings})
        parts += [component(part, estimate, own) for part in stated.get("uncerts") or []]
        made = {"unit": own}
        if stated.get("desc"):
            made["about"] = stated["desc"]
        if not parts:
            made |= {"distribution": "constant", "value": estimate}
        elif stated["name"] in correlated and (len(parts) > 1 or readings):
            made |= {"mean": estimate} | combined(parts)
        elif len(parts) == 1 and not readings:
            made |= {"mean": estimate} | {key: of for key, of in parts[0].items() if key not in ("name", "about")}
        else:
            made |= {"components": parts} if readings else {"mean": estimate, "components": parts}
        inputs[stated["name"]] = made
        if own == "degC":
            celsius.append(stated["name"])

    def formula(text):
        text = re.sub(r"\blog\(", "ln(", text.replace("**", "^"))
        # suncal computes with thermodynamic temperatures
        for name in celsius:
            text = re.sub(rf"\b{re.escape(name)}\b", f"kelvin({name})", text)
        return text

    functions = project["functions"]
    made = {"format": 2, "title": project.get("description") or project.get("name", ""), "inputs": inputs}
    if correlated:
        made["correlations"] = [[of["var1"], of["var2"], float(of["cor"])] for of in project["correlations"]]
    made["equations"] = {of["name"]: formula(of["expr"]) for of in functions}
    made["outputs"] = {of["name"]: {"unit": unit(of["units"])} if of.get("units") else {} for of in functions}
    return made


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        projects = yaml.safe_load(file)
    projects = projects if isinstance(projects, list) else [projects]
    found = [of for of in projects if of.get("mode", "uncertainty") in ("uncertainty", "wizard") and of.get("functions")]
    if not found:
        sys.exit(f"{sys.argv[1]} has no calculation of an uncertainty")
    print(json.dumps(model(found[0]), indent=2, ensure_ascii=False))
