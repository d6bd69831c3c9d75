//! Certificates of the versions in use, as inputs.

mod difference;
mod reading;
mod tables;
mod uncertainty;

use super::*;
use crate::{ModelFile, read as read_model};
use gumption_text::Diagnostics;

/// A model of an input `x` from `ref.xml`.
fn model(xml: &str, input: &str, more: &str) -> Result<ModelFile, Diagnostics> {
    model_in("mV", xml, input, more)
}

/// A model whose result is in this unit.
fn model_in(unit: &str, xml: &str, input: &str, more: &str) -> Result<ModelFile, Diagnostics> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ref.xml"), xml).unwrap();
    let text = format!(
        r#"{{"inputs": {{"x": {{"distribution": "dcc", "file": "ref.xml", {input}}}}}{more},
        "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
    );
    std::fs::write(folder.path().join("m.json"), text).unwrap();
    read_model(&folder.path().join("m.json"), &[])
}

/// The one error of a model whose result is in volts, of the quantity `v`.
fn refused(quantities: &str, more: &str) -> String {
    let errors = model(&certificate("3.2.1", quantities), &format!(r#""id": "v"{more}"#), "");
    let errors = errors.unwrap_err();
    assert_eq!(errors.0.len(), 1, "{errors}");
    errors.to_string()
}

/// The model of the quantity `v`.
fn accepted(quantities: &str, more: &str) -> ModelFile {
    model(&certificate("3.2.1", quantities), &format!(r#""id": "v"{more}"#), "").unwrap()
}

fn quantity(inside: &str) -> String {
    format!("<dcc:quantity id=\"v\">{inside}</dcc:quantity>")
}

fn real(value: &str, unit: &str, more: &str) -> String {
    format!("<si:real><si:value>{value}</si:value><si:unit>{unit}</si:unit>{more}</si:real>")
}

/// An expanded uncertainty, of which an empty text is not stated.
fn expanded([u, k, p, law]: [&str; 4]) -> String {
    let element = |name: &str, text: &str| match text {
        "" => String::new(),
        _ => format!("<si:{name}>{text}</si:{name}>"),
    };
    format!(
        "<si:expandedUnc>{}{}{}{}</si:expandedUnc>",
        element("uncertainty", u),
        element("coverageFactor", k),
        element("coverageProbability", p),
        element("distribution", law)
    )
}

fn has_note(file: &ModelFile, code: &str) -> bool {
    file.warnings.iter().any(|note| note.code() == code)
}

fn certificate(version: &str, quantities: &str) -> String {
    format!(
        r#"<?xml version="1.0"?>
<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si"
  schemaVersion="{version}"><dcc:measurementResults><dcc:measurementResult><dcc:results><dcc:result>
<dcc:data><dcc:list>{quantities}</dcc:list></dcc:data></dcc:result></dcc:results>
</dcc:measurementResult></dcc:measurementResults></dcc:digitalCalibrationCertificate>"#
    )
}

const REAL: &str = r#"<dcc:quantity id="v"><si:real><si:value>5.0112</si:value>
<si:unit>\volt</si:unit><si:expandedUnc><si:uncertainty>0.0046</si:uncertainty>
<si:coverageFactor>2</si:coverageFactor><si:coverageProbability>0.95</si:coverageProbability>
<si:distribution>normal</si:distribution></si:expandedUnc></si:real></dcc:quantity>"#;

const NEWER: &str = r#"<dcc:quantity id="v"><si:real><si:value>5.0112</si:value>
<si:unit>\volt</si:unit><si:measurementUncertaintyUnivariate><si:expandedMU>
<si:valueExpandedMU>0.0046</si:valueExpandedMU><si:coverageFactor>2</si:coverageFactor>
<si:coverageProbability>0.95</si:coverageProbability></si:expandedMU>
</si:measurementUncertaintyUnivariate></si:real></dcc:quantity>"#;

const TABLE: &str = r#"<dcc:quantity><dcc:name><dcc:content lang="en">f</dcc:content></dcc:name>
<si:realListXMLList><si:valueXMLList>10 20 40</si:valueXMLList><si:unitXMLList>\hertz</si:unitXMLList>
</si:realListXMLList></dcc:quantity>
<dcc:quantity refType="basic_measuredValue"><si:realListXMLList>
<si:valueXMLList>1 3 4</si:valueXMLList><si:unitXMLList>\milli\volt</si:unitXMLList>
<si:expandedUncXMLList><si:uncertaintyXMLList>0.2 0.4 0.4</si:uncertaintyXMLList>
<si:coverageFactorXMLList>2</si:coverageFactorXMLList>
<si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList></si:expandedUncXMLList>
</si:realListXMLList></dcc:quantity>"#;

fn known(file: &ModelFile, row: usize) -> [f64; 3] {
    let of = &file.task.rows[row].distributions[0];
    [of.mean(), of.standard_uncertainty(), of.dof()]
}

fn near(found: [f64; 3], expected: [f64; 2]) {
    for (a, b) in found.into_iter().zip(expected) {
        assert!((a - b).abs() <= 1e-12 * b.abs(), "{found:?} {expected:?}");
    }
}

#[test]
fn values_of_all_versions() {
    for version in ["2.4.0", "3.0.0", "3.1.2", "3.2.1", "3.3.0"] {
        let file = model(&certificate(version, REAL), r#""id": "v""#, "").unwrap();
        near(known(&file, 0), [5.0112, 0.0023]);
        assert_eq!(file.files[0].0, "ref.xml");
    }
    let file = model(&certificate("3.3.0", NEWER), r#""id": "v", "unit": "mV""#, "").unwrap();
    near(known(&file, 0), [5011.2, 2.3]);
    // a t with 4 degrees of freedom has k = 2.87 at 95.45 % (JCGM 100, table G.2)
    let student = REAL
        .replace("normal<", "t<")
        .replace("Factor>2<", "Factor>2.869<")
        .replace("Probability>0.95<", "Probability>0.9545<");
    let file = model(&certificate("3.2.1", &student), r#""id": "v""#, "").unwrap();
    let [_, u, dof] = known(&file, 0);
    assert!((dof - 4.0).abs() < 0.02 && (u - 0.0046 / 2.869).abs() < 1e-9, "{dof}");
    // 0.95 sqrt(3)
    let rectangular = REAL.replace("normal<", "uniform<").replace("Factor>2<", "Factor>1.65<");
    let file = model(&certificate("3.2.1", &rectangular), r#""id": "v""#, "").unwrap();
    assert_eq!(file.task.rows[0].distributions[0].name(), "rectangular");
    assert!(file.warnings.iter().all(|note| note.code() != "certificate-distribution"));
    // sqrt(2) sin(0.475 pi) of the arcsine distribution is 1.41
    for (called, k, name, is_noted) in [
        ("Gaussian", 2.0, "normal", false),
        ("U-shaped", 1.41, "arcsine", false),
        ("of two humps", 2.0, "normal", true),
    ] {
        let text = REAL.replace("normal<", &format!("{called}<"));
        let text = text.replace("Factor>2<", &format!("Factor>{k}<"));
        let file = model(&certificate("3.2.1", &text), r#""id": "v""#, "").unwrap();
        near(known(&file, 0), [5.0112, 0.0046 / k]);
        assert_eq!(file.task.rows[0].distributions[0].name(), name, "{called}");
        let noted = file.warnings.iter().any(|note| note.code() == "certificate-distribution");
        assert_eq!(noted, is_noted, "{called}");
    }
}

#[test]
fn lists_and_tables() {
    let xml = certificate("3.2.1", TABLE);
    let kind = r#""ref_type": "basic_measuredValue""#;
    near(known(&model(&xml, &format!(r#"{kind}, "index": 1"#), "").unwrap(), 0), [3.0, 0.2]);
    let conditions = r#", "conditions": {"f": {"unit": "Hz", "values": [10, 15, "0.03 kHz"]}}"#;
    let file = model(&xml, &format!(r#"{kind}, "at": "f""#), conditions).unwrap();
    near(known(&file, 0), [1.0, 0.1]);
    near(known(&file, 1), [2.0, 0.15]);
    near(known(&file, 2), [3.5, 0.2]);
    let outside = conditions.replace("15", "50");
    let error = model(&xml, &format!(r#"{kind}, "at": "f""#), &outside).unwrap_err().to_string();
    assert!(error.contains("outside the certificate's range 10 to 40 Hz"), "{error}");
    let error = model(&xml, kind, "").unwrap_err().to_string();
    assert!(error.contains("has 3 values"), "{error}");
    let error = model(&xml, &format!(r#"{kind}, "index": 3"#), "").unwrap_err().to_string();
    assert!(error.contains("from 0 to 2"), "{error}");
}

/// One error each, at the element.
#[test]
fn damaged_certificates() {
    let id = r#""id": "v""#;
    let whole = certificate("3.2.1", REAL);
    for (xml, part) in [
        (whole.replace("</si:real>", ""), "ref.xml:"),
        (whole.replace("5.0112", "five"), "`five` in `value` is not a finite number"),
        (whole.replace("\\volt", "\\furlong"), "is no unit of D-SI"),
        (whole.replace("\"3.2.1\"", "\"1.0\""), "schema version"),
        (whole.replace("digitalCalibrationCertificate", "other"), "its root is `other`"),
        (whole.replace("Factor>2<", "Factor>-2<"), "above 0"),
        (whole.replace("0.95<", "95<"), "between 0 and 1"),
        (whole.replace("id=\"v\"", "id=\"w\""), "no quantity has the id `v`"),
        (String::new(), "no XML"),
        ("{}".to_owned(), "no XML"),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>".to_owned(), "DTD"),
    ] {
        let errors = model(&xml, id, "").unwrap_err();
        assert_eq!(errors.0.len(), 1, "{errors}");
        assert!(errors.to_string().contains(part), "{part}: {errors}");
    }
}

/// Comments stand in a text, and end no number.
#[test]
fn comments_are_no_part_of_numbers() {
    let id = r#""id": "v""#;
    for value in ["5.0<!-- c -->112", "<!-- c -->5.0112", "5.0112<?x y?>", "<![CDATA[5.0112]]>"] {
        let xml = certificate("3.2.1", &REAL.replace("5.0112", value));
        near(known(&model(&xml, id, "").unwrap(), 0), [5.0112, 0.0023]);
    }
    let xml = certificate("3.2.1", &REAL.replace("5.0112", "5.0<si:b/>112"));
    let error = model(&xml, id, "").unwrap_err().to_string();
    assert!(error.contains("`b` has no place in `value`"), "{error}");
}

/// What is stated twice is no matter of the order.
#[test]
fn contradictions_are_asked() {
    let id = r#""id": "v""#;
    let twice = |element: &str, again: &str| {
        let whole = format!("{element}{again}");
        assert!(REAL.contains(element), "{element}");
        model(&certificate("3.2.1", &REAL.replace(element, &whole)), id, "")
    };
    let value = "<si:value>5.0112</si:value>";
    near(known(&twice(value, "<si:value>5.01120</si:value>").unwrap(), 0), [5.0112, 0.0023]);
    let another = "<si:expandedUnc><si:uncertainty>0.4</si:uncertainty></si:expandedUnc></si:real>";
    let one = "<si:unit>\\volt</si:unit>";
    for (found, both) in [
        (twice(value, "<si:value>5.2</si:value>"), "`value` is `5.0112` and, here, `5.2`"),
        (twice(one, "<si:unit>\\milli\\volt</si:unit>"), "`\\volt` and, here, `\\milli\\volt`"),
        (
            model(&certificate("3.2.1", &REAL.replace("</si:real>", another)), id, ""),
            "`uncertainty` is `0.0046` and, here, `0.4`",
        ),
        (
            twice(value, "<si:standardUnc>0.0046</si:standardUnc>"),
            "two standard uncertainties for one value: 0.0046 as such, and U/k = 0.0046/2",
        ),
    ] {
        let errors = found.unwrap_err();
        assert_eq!(errors.0.len(), 1, "{errors}");
        assert!(errors.to_string().contains(both), "{both}: {errors}");
    }
}

/// A hybrid says one thing in several units.
#[test]
fn parts_of_a_hybrid_agree() {
    let real = |value: &str, unit: &str, more: &str| {
        format!("<si:real><si:value>{value}</si:value><si:unit>{unit}</si:unit>{more}</si:real>")
    };
    let expanded = |u: &str| {
        format!(
            "<si:expandedUnc><si:uncertainty>{u}</si:uncertainty>\
             <si:coverageFactor>2</si:coverageFactor></si:expandedUnc>"
        )
    };
    let hybrid = |parts: &[String]| {
        format!("<dcc:quantity id=\"v\"><si:hybrid>{}</si:hybrid></dcc:quantity>", parts.concat())
    };
    let read = |text: &str| {
        let xml = certificate("3.2.1", text);
        let document = parse(&xml).unwrap();
        let measured = document::measured(document::quantities(&document)[0]);
        measured.map(|_| ()).map_err(|(_, reason)| reason)
    };
    let [celsius, kelvin] = [r"\degreecelsius", r"\kelvin"];
    for (a, b) in [("20", "293.15"), ("20.00", "293.15"), ("20", "293"), ("0.10", "0.10")] {
        let text = hybrid(&[real(a, celsius, ""), real(b, kelvin, "")]);
        assert_eq!(read(&text), Ok(()), "{a} {b}");
    }
    let volts = [real("5.01", r"\volt", &expanded("0.02")), real("5010", r"\milli\volt", "")];
    let [with, without] = volts.clone();
    let xml = certificate("3.2.1", &hybrid(&[without, with]));
    near(known(&model(&xml, r#""id": "v""#, "").unwrap(), 0), [5.01, 0.01]);
    let list = [hybrid(&volts), hybrid(&volts).replace("5010", "5011")].concat();
    let list = list.replace("</dcc:quantity><dcc:quantity id=\"v\">", "");
    let list = list.replace("id=\"v\">", "id=\"v\"><si:list>");
    let list = list.replace("</dcc:quantity>", "</si:list></dcc:quantity>");
    let xml = certificate("3.2.1", &list);
    near(known(&model(&xml, r#""id": "v", "index": 1"#, "").unwrap(), 0), [5.01, 0.01]);
    // a unit that D-SI does not have
    let text = hybrid(&[real("5.01", r"\volt", ""), real("1", r"\furlong", "")]);
    assert_eq!(read(&text), Ok(()));
    for (parts, both) in [
        ([real("20", celsius, ""), real("300", kelvin, "")], "says 20 degC and 300 K"),
        ([real("20.00", celsius, ""), real("293.25", kelvin, "")], "says 20 degC and 293.25 K"),
        ([real("5.01", r"\volt", ""), real("5.01", r"\metre", "")], "says 5.01 V and 5.01 m"),
        (
            [
                real("5.01", r"\volt", &expanded("0.02")),
                real("5010", r"\milli\volt", &expanded("40")),
            ],
            "a standard uncertainty of 0.01 V and a standard uncertainty of 20 mV",
        ),
    ] {
        let error = read(&hybrid(&parts)).unwrap_err();
        assert!(error.contains(both), "{both}: {error}");
    }
}

/// Two lists that a table may be over: the same one, or a question.
#[test]
fn the_abscissa_is_one() {
    let list = |kind: &str, values: &str, unit: &str| {
        format!(
            "<dcc:quantity refType=\"{kind}\"><si:realListXMLList>\
             <si:valueXMLList>{values}</si:valueXMLList><si:unitXMLList>{unit}</si:unitXMLList>\
             </si:realListXMLList></dcc:quantity>"
        )
    };
    let reference = "basic_referenceValue";
    let measured = list("basic_measuredValue", "1 2 3", r"\milli\volt");
    let table = |lists: &[String]| {
        let conditions = r#", "conditions": {"f": {"unit": "Hz", "values": [10]}}"#;
        let xml = certificate("3.2.1", &[&lists.concat(), measured.as_str()].concat());
        let input = r#""ref_type": "basic_measuredValue", "at": "f""#;
        model(&xml, input, conditions).map_err(|errors| errors.to_string())
    };
    let [a, b] = ["0 10 20", "0 20 40"].map(|values| list(reference, values, r"\hertz"));
    for lists in [[a.clone(), b.clone()], [b, a.clone()]] {
        let error = table(&lists).unwrap_err();
        assert!(error.contains("10 Hz") && error.contains("20 Hz"), "{error}");
    }
    let same = [
        list(reference, "0 0.01 0.02", r"\kilo\hertz"),
        list(reference, "7", r"\hertz"),
        list("basic_nominalValue", "0 20 40", r"\hertz"),
    ];
    for other in same {
        let file = table(&[a.clone(), other]).unwrap();
        near(known(&file, 0), [2.0, 0.0]);
    }
}

/// Certificates of others, where `GUMPTION_CERTIFICATES` names a folder of them: most quantities are
/// read.
#[test]
fn certificates_of_others() {
    let Some(folder) = std::env::var_os("GUMPTION_CERTIFICATES") else { return };
    let folder = std::fs::read_dir(folder).unwrap();
    for file in folder.flatten().map(|entry| entry.path()) {
        if file.extension().is_none_or(|extension| extension != "xml") {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let document = parse(&text).unwrap();
        let all = document::quantities(&document);
        assert!(!all.is_empty(), "{}", file.display());
        let read = all.iter().filter(|node| document::measured(**node).is_ok()).count();
        // one of them is a template without numbers
        let template = text.contains('§');
        assert!(template || read > all.len() / 2, "{}: {read} of {}", file.display(), all.len());
    }
}

#[test]
fn a_quantity_is_named_by_its_place() {
    let xml = certificate("3.2.1", &TABLE.replace("refType=\"basic_measuredValue\"", ""));
    let file = model(&xml, r#""quantity": 1, "index": 2"#, "").unwrap();
    near(known(&file, 0), [4.0, 0.2]);
    let told = |input: &str| model(&xml, input, "").unwrap_err().to_string();
    assert!(told(r#""quantity": 2"#).contains("has 2 quantities, counted from 0"));
    assert!(told(r#""quantity": 1, "id": "v""#).contains("`quantity`"));
    assert!(told(r#""quantity": "one""#).contains("a number"));
}

/// What a certificate states is a model of its own.
#[test]
fn the_quantities_of_a_certificate_are_a_model() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ref.xml");
    std::fs::write(&path, certificate("3.2.1", &[REAL, TABLE].concat())).unwrap();
    let carried = crate::carried_models(&path).unwrap();
    let [one] = &carried[..] else { panic!("{carried:?}") };
    let reader = crate::FileReader::default().holding(&one.files);
    let file = reader.model_text("m", &one.text, std::path::Path::new(""), &[]).unwrap();
    let outputs: Vec<(&str, &str)> = file
        .task
        .model
        .outputs
        .iter()
        .map(|of| (of.quantity.name.as_str(), of.quantity.unit.text()))
        .collect();
    let expected = [("q", "V"), ("f_1", "Hz"), ("f_2", "Hz"), ("f_3", "Hz")];
    assert_eq!(outputs[..4], expected);
    assert_eq!(outputs[4..], [("q_1", "mV"), ("q_2", "mV"), ("q_3", "mV")]);
    near(known(&file, 0), [5.0112, 0.0023]);
    for (name, content) in [("n.xml", "<a/>"), ("n.xlsx", "PK"), ("n.xml", "{}")] {
        let other = folder.path().join(name);
        std::fs::write(&other, content).unwrap();
        assert!(crate::carried_models(&other).is_err(), "{content}");
    }
}

/// Attached files have no folders; each model finds its own, which follow it.
#[test]
fn attached_models_find_their_tables() {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    let attached = |name: &str, content: &str| {
        let data = STANDARD.encode(content);
        format!(
            "<dcc:byteData><dcc:fileName>{name}</dcc:fileName>\
             <dcc:dataBase64>{data}</dcc:dataBase64></dcc:byteData>"
        )
    };
    let model = r#"{"inputs": {}, "conditions": {"file": "rows/f.csv", "units": {"f": "m"}}, "equations": {"y": "2*f"},
        "outputs": {"y": {"unit": "m"}}}"#;
    let parts = [
        attached("a.json", model),
        attached("f.csv", "f\n1\n"),
        attached("b.json", model),
        attached("f.csv", "f\n1\n2\n"),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.xml");
    std::fs::write(&path, certificate("3.2.1", &parts.concat())).unwrap();
    let carried = crate::carried_models(&path).unwrap();
    let rows = |of: &crate::CarriedModel| {
        let reader = crate::FileReader::default().holding(&of.files);
        let file = reader.model_text("m", &of.text, std::path::Path::new(""), &[]).unwrap();
        file.task.rows.len()
    };
    let found: Vec<(&str, usize)> = carried.iter().map(|of| (of.name.as_str(), rows(of))).collect();
    assert_eq!(found, [("a.json", 1), ("b.json", 2)]);
}

/// A certificate of five rows, of which the first is not normal: its coverage interval stands in a
/// quantity of its own, and its standard uncertainty has the digits that U and k have lost.
const INTERVAL: &str = r#"<dcc:quantity><dcc:name><dcc:content lang="en">p</dcc:content></dcc:name>
<si:realListXMLList><si:valueXMLList>0 1 2</si:valueXMLList><si:unitXMLList>\hertz</si:unitXMLList>
</si:realListXMLList></dcc:quantity>
<dcc:quantity refType="basic_measuredValue"><si:realListXMLList>
<si:valueXMLList>0.11 0.12 0.17</si:valueXMLList><si:unitXMLList>\milli\volt</si:unitXMLList>
<si:expandedUncXMLList><si:uncertaintyXMLList>0.13 0.16 0.18</si:uncertaintyXMLList>
<si:coverageFactorXMLList>1.8 2.00 2.00</si:coverageFactorXMLList>
<si:coverageProbabilityXMLList>0.9545 0.9545 0.9545</si:coverageProbabilityXMLList>
<si:distributionXMLList>other normal normal</si:distributionXMLList></si:expandedUncXMLList>
</si:realListXMLList></dcc:quantity>
<dcc:quantity refType="basic_measuredValue"><si:realListXMLList>
<si:valueXMLList>0.11</si:valueXMLList><si:unitXMLList>\milli\volt</si:unitXMLList>
<si:coverageIntervalXMLList><si:standardUncXMLList>0.06749</si:standardUncXMLList>
<si:intervalMinXMLList>-0.01</si:intervalMinXMLList><si:intervalMaxXMLList>0.23</si:intervalMaxXMLList>
<si:coverageProbabilityXMLList>0.9545</si:coverageProbabilityXMLList>
<si:distributionXMLList>other</si:distributionXMLList></si:coverageIntervalXMLList>
</si:realListXMLList></dcc:quantity>"#;

#[test]
fn coverage_intervals_are_no_further_values() {
    let kind = r#""ref_type": "basic_measuredValue""#;
    let conditions = r#", "conditions": {"p": {"unit": "Hz", "values": [0, 1, 2]}}"#;
    let newer = INTERVAL.replacen("basic_measuredValue", "here", 1);
    let newer = newer.replace("basic_measuredValue", "gumption_coverageInterval");
    let newer = newer.replace("here", "basic_measuredValue");
    for (version, text) in [("3.1.2", INTERVAL), ("3.2.1", INTERVAL), ("3.2.1", &newer)] {
        let xml = certificate(version, text);
        let file = model(&xml, &format!(r#"{kind}, "at": "p""#), conditions).unwrap();
        // u of the interval, and U/k = 0.16/2 and 0.18/2
        for (row, expected) in [[0.11, 0.06749], [0.12, 0.08], [0.17, 0.09]].into_iter().enumerate()
        {
            near(known(&file, row), expected);
        }
        assert!(file.warnings.iter().any(|note| note.code() == "interval-uncertainty"));
        let file = model(&xml, &format!(r#"{kind}, "index": 0"#), "").unwrap();
        near(known(&file, 0), [0.11, 0.06749]);
        let file = model(&xml, &format!(r#"{kind}, "index": 2"#), "").unwrap();
        near(known(&file, 0), [0.17, 0.09]);
        assert!(file.warnings.iter().all(|note| note.code() != "interval-uncertainty"));
    }
    // one row: the value stands twice, and there is one
    let one = INTERVAL
        .replace("0.11 0.12 0.17", "0.11")
        .replace("0.13 0.16 0.18", "0.13")
        .replace("1.8 2.00 2.00", "1.8")
        .replace("0.9545 0.9545 0.9545", "0.9545")
        .replace("other normal normal", "other");
    near(known(&model(&certificate("3.2.1", &one), kind, "").unwrap(), 0), [0.11, 0.06749]);
    // 0.13/1.8 = 0.072 with all that rounding may have taken is below 0.09
    let wrong = certificate("3.2.1", &one.replace("0.06749", "0.09"));
    let error = model(&wrong, kind, "").unwrap_err().to_string();
    assert!(error.contains("two standard uncertainties for one value: 0.09"), "{error}");
    // 0.130 and 1.80 leave no more than half a digit: 1.8 x 0.0675 = 0.1215, and 0.100 is not 0.1
    for (expanded, factor) in [("0.130", "1.8"), ("0.13", "2.10"), ("0.100", "1.80"), ("0.11", "2")]
    {
        let text = one.replace(">0.13<", &format!(">{expanded}<"));
        let text = text.replace(">1.8<", &format!(">{factor}<"));
        assert_ne!(text, one);
        let found = model(&certificate("3.2.1", &text), kind, "");
        assert_eq!(found.is_err(), (expanded, factor) != ("0.11", "2"), "{expanded} {factor}");
    }
    // two rows of one value, either of which it may be: U over k
    let twice = INTERVAL.replace("0.11 0.12 0.17", "0.11 0.11 0.17");
    let twice = twice.replace("other normal normal", "other other normal");
    let file = model(&certificate("3.2.1", &twice), &format!(r#"{kind}, "index": 0"#), "").unwrap();
    near(known(&file, 0), [0.11, 0.13 / 1.8]);
}
