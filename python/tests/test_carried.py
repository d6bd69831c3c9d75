"""Models that workbooks and certificates carry, and contents in place of files."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest
from conftest import MODEL_FILES, MODELS, ROOT

import gumption as gu

CERTIFICATE = """<?xml version="1.0"?>
<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si"
  schemaVersion="3.2.1"><dcc:measurementResults><dcc:measurementResult><dcc:results><dcc:result>
<dcc:data><dcc:quantity><dcc:name><dcc:content lang="en">Indicated voltage</dcc:content></dcc:name>
<si:real><si:value>5.0112</si:value><si:unit>\\volt</si:unit><si:expandedUnc>
<si:uncertainty>0.0046</si:uncertainty><si:coverageFactor>2</si:coverageFactor>
<si:coverageProbability>0.95</si:coverageProbability></si:expandedUnc></si:real></dcc:quantity>
</dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>
</dcc:digitalCalibrationCertificate>"""


@pytest.mark.parametrize("path", MODEL_FILES[::5], ids=lambda path: path.stem)
def test_a_workbook_carries_its_model(path: Path, tmp_path: Path) -> None:
    model = gu.load(path)
    result = model.run(trials=20_000)
    result.write(tmp_path / "w.xlsx")
    if model._rust.source[3]:
        pytest.skip("it names files, which a workbook does not carry")
    again = gu.load(tmp_path / "w.xlsx")
    assert again.run(trials=20_000).to_json() == result.to_json()


def test_a_workbook_of_others_carries_none(tmp_path: Path) -> None:
    pytest.importorskip("openpyxl").Workbook().save(tmp_path / "w.xlsx")
    with pytest.raises(gu.ModelError, match="carries no model"):
        gu.load(tmp_path / "w.xlsx")


def test_our_certificate_carries_its_models(tmp_path: Path) -> None:
    file = MODELS / "certificates" / "three_axis_accelerometer.json"
    gu.certificate(file, trials=0).save(tmp_path / "c.xml")
    with pytest.raises(gu.ModelError, match="mean_of_repetitions.json.*say which"):
        gu.load(tmp_path / "c.xml")
    model = gu.load(tmp_path / "c.xml", model="three_axis_sensitivity")
    own = gu.load(MODELS / "three_axis_sensitivity.json")
    assert model.run(trials=5000).to_json() == own.run(trials=5000).to_json()


def test_the_values_of_a_certificate_are_a_model(tmp_path: Path) -> None:
    path = tmp_path / "ref.xml"
    path.write_text(CERTIFICATE)
    model = gu.load(path)
    voltage = model.run(trials=20_000)["Indicated_voltage"]
    assert voltage.unit == "V"
    assert voltage.gum.estimate == 5.0112
    assert voltage.gum.standard_uncertainty == pytest.approx(0.0023, rel=1e-12)
    # it goes along whole
    again = pickle.dumps(model)
    path.unlink()
    assert pickle.loads(again).run(trials=20_000).to_json() == model.run(trials=20_000).to_json()


def test_a_pickled_model_has_its_certificate(tmp_path: Path) -> None:
    (tmp_path / "ref.xml").write_text(CERTIFICATE)
    (tmp_path / "m.json").write_text(json.dumps({
        "inputs": {"v": {"distribution": "dcc", "file": "ref.xml"}},
        "equations": {"y": "2*v"},
        "outputs": {"y": {"unit": "V"}},
    }))
    model = gu.load(tmp_path / "m.json")
    expected, pickled = model.run(trials=20_000).to_json(), pickle.dumps(model)
    (tmp_path / "ref.xml").unlink()
    assert pickle.loads(pickled).run(trials=20_000).to_json() == expected


@pytest.mark.slow
def test_contents_in_place_of_files(monkeypatch: pytest.MonkeyPatch) -> None:
    case = "models/gap/sampling_rate/case.json"
    monkeypatch.chdir(ROOT / Path(case).parent)
    content = json.loads((ROOT / case).read_text())
    assert dict(gu.gap(content)) == dict(gu.gap(ROOT / case))
    assert dict(gu.gap_check(content, 2)) == dict(gu.gap_check(ROOT / case, 2))
    assert gu.check(content)["ok"]
    wrong = gu.check({"inputs": {}, "equation": {}})
    assert not wrong["ok"] and wrong["errors"]
