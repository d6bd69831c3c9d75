"""Changes a workbook's inputs and makes the model file that says the same.

usage: change.py PROGRAM MODEL.json WORKBOOK.xlsx CHANGED.xlsx CHANGED.json

Every estimate on the worksheet "Inputs" is moved by 3 % and every standard uncertainty multiplied
by 1.7; the model file gets normal (or, with degrees of freedom, t) inputs with those figures. The
changed workbook has no cached values at all: whoever reads them has computed them.
"""

import json
import sys

import openpyxl


def main(program, model_path, workbook_path, changed_path, changed_model_path):
    model = json.load(open(model_path, encoding="utf-8"))
    book = openpyxl.load_workbook(workbook_path)
    sheet = book["Inputs"]
    inputs = {}
    listed = False
    for row in sheet.iter_rows():
        name = row[0].value
        if name == "quantity":
            listed = True
            continue
        if not listed or name is None or row[4].value in (None, "condition", "correlation"):
            continue
        if "/" in name:
            raise SystemExit("components cannot be changed by this check")
        estimate, std, dof = row[1].value, row[2].value, row[5].value
        if std == 0:
            inputs[name] = {"distribution": "constant", "value": estimate, "unit": row[3].value or "1"}
            continue
        row[1].value = estimate * 1.03 if estimate else 0.01 * std
        row[2].value = std * 1.7
        inputs[name] = {
            "distribution": "normal",
            "mean": row[1].value,
            "std": row[2].value,
            "unit": row[3].value or "1",
        }
        if isinstance(dof, (int, float)):
            inputs[name]["dof"] = dof
    book.save(changed_path)
    model["inputs"] = inputs
    model.pop("$schema", None)
    json.dump(model, open(changed_model_path, "w", encoding="utf-8"), ensure_ascii=False)
    return 0


sys.exit(main(*sys.argv[1:]))
