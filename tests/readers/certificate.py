"""A certificate's tables read back: certificate.py ANSWER.json TABLE.csv WORKBOOK.xlsx

Python's csv module and LibreOffice find the stated figures of the JSON answer.
"""

import csv
import json
import sys

import openpyxl

answer = json.load(open(sys.argv[1]))
stated = [row["stated"] for row in answer["rows"]]
keys = ["value", "expanded_uncertainty", "coverage_factor"]

lines = list(csv.DictReader(open(sys.argv[2], newline="")))
assert len(lines) == len(stated)
for line, row in zip(lines, stated):
    assert [line[key] for key in keys] == [row[key] for key in keys], line
    assert [line["interval_low"], line["interval_high"]] == (row["interval"] or ["", ""]), line

sheet = openpyxl.load_workbook(sys.argv[3], data_only=True)["Certificate"]
rows = [[cell for cell in row if isinstance(cell, (int, float))] for row in sheet.iter_rows(values_only=True)]
for row in stated:
    wanted = [float(row[key]) for key in keys] + [float(end) for end in row["interval"] or []]
    assert any(all(number in cells for number in wanted) for cells in rows), wanted
print(len(stated), "rows")
