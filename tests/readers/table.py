"""Compares a CSV answer as Python's csv module and as a spreadsheet reads it, and with the JSON.

usage: table.py ANSWER.csv READ-BY-A-SPREADSHEET.xlsx ANSWER.json
"""

import csv
import json
import sys

import openpyxl


def same(text, cell):
    """Whether a cell holds what the text says."""
    if text == "":
        return cell is None
    if isinstance(cell, bool):
        return text == str(cell).lower()
    if isinstance(cell, (int, float)):
        return abs(float(text) - cell) <= 1e-14 * abs(cell)
    return text == str(cell) or text.lower() == str(cell).lower()


def main(csv_path, sheet_path, json_path):
    with open(csv_path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file, strict=True))
    sheet = openpyxl.load_workbook(sheet_path, data_only=True).worksheets[0]
    cells = list(sheet.iter_rows(values_only=True))
    wrong = []
    if len(cells) != len(rows) or any(len(row) != len(rows[0]) for row in rows):
        wrong.append(f"{len(rows)} rows in the file, {len(cells)} in the spreadsheet")
    for line, (row, read) in enumerate(zip(rows, cells)):
        for text, cell in zip(row, read):
            if not same(text, cell):
                wrong.append(f"row {line}: {text!r} is read as {cell!r}")
    answer = json.load(open(json_path, encoding="utf-8"))
    header = rows[0]
    lines = iter(rows[1:])
    count = 0
    for row in answer.get("rows", [answer]):
        for name, output in row["outputs"].items():
            line = dict(zip(header, next(lines)))
            gum, trials = output["gum"], output["monte_carlo"]
            wanted = {"output": name}
            if gum:
                wanted |= {
                    "gum_estimate": gum["estimate"],
                    "gum_standard_uncertainty": gum["standard_uncertainty"],
                    "expanded_uncertainty": gum["expanded_uncertainty"],
                }
            if trials:
                wanted |= {
                    "mc_estimate": trials["estimate"],
                    "mc_symmetric_low": trials["symmetric_interval"][0],
                    "mc_shortest_high": trials["shortest_interval"][1],
                }
            for key, value in wanted.items():
                count += 1
                text = line[key]
                # the shortest text that reads back as the same number
                if not (text == value or (value is None and text == "") or float(text) == value):
                    wrong.append(f"{name} {key}: {text} for {value}")
    print(f"{len(rows)} rows, {count} numbers compared with the JSON")
    for line in wrong[:30]:
        print(line)
    return 1 if wrong or not count else 0


sys.exit(main(*sys.argv[1:]))
