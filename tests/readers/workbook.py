"""Compares a workbook that a spreadsheet has computed with the JSON answer.

usage: workbook.py ANSWER.json ORIGINAL.xlsx|- COMPUTED.xlsx

In every row of conditions and for every output y, u, dof, k, U and the interval must agree to 1e-9
(of u for y and the interval's ends); no cell may hold an error. Of the original every formula must
hold a cached value.
"""

import json
import sys

import openpyxl

TOLERANCE = 1e-9


def figures(book):
    """The figures of every output's blocks, in order: {output: [{label: value}]}."""
    labels = {
        "estimate y": "estimate",
        "combined standard uncertainty u": "standard_uncertainty",
        "effective degrees of freedom": "dof",
        "coverage factor k": "coverage_factor",
        "expanded uncertainty U": "expanded_uncertainty",
        "coverage interval, from": "low",
        "coverage interval, to": "high",
    }
    found = {}
    for sheet in book:
        if not sheet.title.startswith("Budget "):
            continue
        blocks = found.setdefault(sheet.title[len("Budget "):], [])
        for row in sheet.iter_rows(values_only=True):
            key = labels.get(row[0])
            if key == "estimate":
                blocks.append({})
            if key:
                blocks[-1][key] = row[1]
            if isinstance(row[0], str) and row[0].startswith("There is no budget"):
                blocks.append(None)
    return found


def main(answer_path, original_path, computed_path):
    answer = json.load(open(answer_path, encoding="utf-8"))
    computed = openpyxl.load_workbook(computed_path, data_only=True)
    wrong = []
    for sheet in computed:
        for row in sheet.iter_rows():
            for cell in row:
                if cell.data_type == "e":
                    wrong.append(f"{sheet.title}!{cell.coordinate}: {cell.value}")
    if original_path != "-":
        formulas = openpyxl.load_workbook(original_path)
        cached = openpyxl.load_workbook(original_path, data_only=True)
        for sheet in formulas:
            for row in sheet.iter_rows():
                for cell in row:
                    if cell.data_type == "f" and cached[sheet.title][cell.coordinate].value is None:
                        wrong.append(f"{sheet.title}!{cell.coordinate}: no cached value")
    found = figures(computed)
    rows = answer.get("rows", [answer])
    largest = 0.0
    count = 0
    for output in rows[0]["outputs"]:
        blocks = found.get(output, [])
        if len(blocks) != len(rows):
            wrong.append(f"{output}: {len(blocks)} budgets for {len(rows)} rows")
            continue
        for row, block in zip(rows, blocks):
            gum = row["outputs"][output]["gum"]
            if gum is None:
                if block is not None:
                    wrong.append(f"{output}: a budget without a GUM evaluation")
                continue
            gum = dict(gum)
            gum["low"], gum["high"] = gum["interval"] or (None, None)
            for key, value in block.items():
                wanted = gum[key]
                if wanted is None:
                    if isinstance(value, (int, float)):
                        wrong.append(f"{output} {key}: {value} for null")
                    continue
                if not isinstance(value, (int, float)):
                    wrong.append(f"{output} {key}: {value!r} for {wanted}")
                    continue
                scale = abs(wanted)
                if key in ("estimate", "low", "high"):
                    scale = max(scale, gum["standard_uncertainty"])
                error = abs(value - wanted) / scale if scale else abs(value)
                count += 1
                largest = max(largest, error)
                if error > TOLERANCE:
                    wrong.append(f"{output} {key}: {value!r} for {wanted!r} ({error:.1e})")
    print(f"{count} figures, largest relative difference {largest:.1e}")
    for line in wrong[:30]:
        print(line)
    return 1 if wrong or (count == 0 and any(o["gum"] for r in rows for o in r["outputs"].values())) else 0


sys.exit(main(*sys.argv[1:]))
