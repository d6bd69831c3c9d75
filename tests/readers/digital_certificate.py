"""A digital calibration certificate read with pydcc: digital_certificate.py ANSWER.json CERTIFICATE.xml

The values, expanded uncertainties, coverage factors and intervals that it finds are those of the JSON
answer. Signatures and the schema are not pydcc's part here: the libraries for the first want another
OpenSSL than many systems have, and the schema it would download.
"""

import json
import sys
import types

try:
    import certvalidator  # noqa: F401
except Exception:
    validator = types.ModuleType("certvalidator")
    validator.CertificateValidator = validator.ValidationContext = object
    validator.errors = types.ModuleType("certvalidator.errors")
    sys.modules["certvalidator"] = validator
    sys.modules["certvalidator.errors"] = validator.errors

import dcc.dcc  # noqa: E402

dcc.dcc.DCCXMLValidator = object

def numbers(text):
    return [float(word) for word in text.split()]


def find(tree, name):
    """All texts of elements of that name in a tree of dictionaries and lists."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            if key == name:
                yield from (value if isinstance(value, list) else [value])
            else:
                yield from find(value, name)
    elif isinstance(tree, list):
        for value in tree:
            yield from find(value, name)


answer = json.load(open(sys.argv[1]))
certificate = dcc.dcc.DCC(sys.argv[2])
assert certificate.is_loaded() and certificate.version() == "3.2.1"
print("pydcc reads", certificate.uid(), "of", certificate.calibration_laboratory_name())

groups = {}
for row in answer["rows"]:
    groups.setdefault((row["output"], row["unit"]), []).append(row["stated"])

results = [tree for _, tree in certificate.get_calibration_results("name")]
measured = [tree for tree in results if list(find(tree, "uncertaintyXMLList"))]
assert len(measured) == len(groups), (len(measured), len(groups))
for tree, rows in zip(measured, groups.values()):
    for name, key in [
        ("valueXMLList", "value"),
        ("uncertaintyXMLList", "expanded_uncertainty"),
        ("coverageFactorXMLList", "coverage_factor"),
    ]:
        found = numbers(next(find(tree, name)))
        assert found == [float(row[key]) for row in rows], (name, found)

ends = [row["interval"] for rows in groups.values() for row in rows if row["interval"]]
for place, name in enumerate(["intervalMinXMLList", "intervalMaxXMLList"]):
    texts = [text for tree in results for text in find(tree, name)]
    found = [number for text in texts for number in numbers(text)]
    assert found == [float(end[place]) for end in ends], (name, found)
print(len(answer["rows"]), "rows,", len(ends), "intervals")
