//! Certificates with several tables of one kind. Which value is meant is told by what is chosen, and the
//! values between points by straight lines: half way between 0.072 and 0.089 it is 0.0805.

use super::*;

/// Errors of indication over reference values, with U (k = 2); `attributes` are those of the list.
fn table(attributes: &str, over: &str, errors: &str, expanded: &str) -> String {
    let list = |kind: &str, values: &str, u: &str| {
        format!(
            "<dcc:quantity refType=\"{kind}\"><si:realListXMLList><si:valueXMLList>{values}\
             </si:valueXMLList><si:unitXMLList>\\kelvin</si:unitXMLList>{u}</si:realListXMLList>\
             </dcc:quantity>"
        )
    };
    let u = format!(
        "<si:expandedUncXMLList><si:uncertaintyXMLList>{expanded}</si:uncertaintyXMLList>\
         <si:coverageFactorXMLList>2</si:coverageFactorXMLList>\
         <si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList></si:expandedUncXMLList>"
    );
    format!(
        "<dcc:list{attributes}>{}{}</dcc:list>",
        list("basic_referenceValue", over, ""),
        list("basic_measurementError", errors, &u)
    )
}

fn named(element: &str, attributes: &str, name: &str, more: &str, data: &str) -> String {
    format!(
        "<dcc:{element}{attributes}><dcc:name><dcc:content>{name}</dcc:content></dcc:name>{more}\
         <dcc:data>{data}</dcc:data></dcc:{element}>"
    )
}

/// A certificate of one measurement with these conditions and results.
fn measured(conditions: &str, results: &str) -> String {
    format!(
        "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" \
         xmlns:si=\"https://ptb.de/si\" schemaVersion=\"3.2.1\"><dcc:measurementResults>\
         <dcc:measurementResult><dcc:influenceConditions>{conditions}</dcc:influenceConditions>\
         <dcc:results>{results}</dcc:results></dcc:measurementResult></dcc:measurementResults>\
         </dcc:digitalCalibrationCertificate>"
    )
}

const KIND: &str = r#""ref_type": "basic_measurementError""#;

/// The value and U at a temperature.
fn at(xml: &str, keys: &str, temperature: f64) -> Result<[f64; 2], String> {
    let conditions =
        format!(r#", "conditions": {{"t": {{"unit": "K", "values": [{temperature}]}}}}"#);
    let input = format!(r#"{KIND}{keys}, "at": "t""#);
    let file = model_in("K", xml, &input, &conditions).map_err(|errors| errors.to_string())?;
    let [value, u, _] = known(&file, 0);
    Ok([value, 2.0 * u])
}

/// Within the last bits.
fn is(found: Result<[f64; 2], String>, expected: [f64; 2]) {
    let found = found.unwrap();
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}

const BEFORE: &str = "<dcc:status>beforeAdjustment</dcc:status>";

/// ISO/IEC 17025, 7.8.4.1 d: as found stands among the conditions in the good practice, and as left among
/// the results. The errors before it are 1 K larger here.
#[test]
fn before_and_after_an_adjustment() {
    let before = table("", "300 320 340", "1.072 1.090 1.110", "0.9");
    let after = table("", "301 321 341", "0.072 0.089 0.107", "0.06");
    let found = named("influenceCondition", "", "Adjustment", BEFORE, &before);
    let left = named("result", "", "Results", "", &after);
    let xml = measured(&found, &left);
    // half way between two points
    is(at(&xml, "", 311.0), [0.0805, 0.06]);
    is(at(&xml, r#", "within": "Results""#, 311.0), [0.0805, 0.06]);
    is(at(&xml, r#", "status": "beforeAdjustment""#, 310.0), [1.081, 0.9]);
    is(at(&xml, r#", "within": "Adjustment""#, 310.0), [1.081, 0.9]);
    let error = at(&xml, r#", "status": "afterRepair""#, 310.0).unwrap_err();
    assert!(error.contains("has the status `afterRepair`; there are beforeAdjustment"), "{error}");
    let error = at(&xml, r#", "status": "as found""#, 310.0).unwrap_err();
    assert!(error.contains("beforeAdjustment"), "{error}");
    // as found alone is taken, and said
    let alone = measured(&found, "");
    is(at(&alone, "", 310.0), [1.081, 0.9]);
    let has_said = |xml: &str| {
        let file = model_in("K", xml, &format!(r#"{KIND}, "index": 0"#), "").unwrap();
        has_note(&file, "certificate-before-adjustment")
    };
    assert!(has_said(&alone) && !has_said(&xml));
    // both among the results, by their status or their reference types
    for (first, second) in [
        (
            named("result", "", "A", BEFORE, &before),
            named("result", "", "B", "<dcc:status>afterAdjustment</dcc:status>", &after),
        ),
        (
            named("result", " refType=\"x_beforeAdjustment\"", "A", "", &before),
            named("result", " refType=\"x_afterAdjustment\"", "B", "", &after),
        ),
    ] {
        let xml = measured("", &(first + &second));
        let error = at(&xml, "", 310.0).unwrap_err();
        for part in [
            "there are 2 tables",
            "3 values of `A` (results, beforeAdjustment) by `\"status\": \"beforeAdjustment\"`",
            "3 values of `B` (results, afterAdjustment) by `\"status\": \"afterAdjustment\"`",
        ] {
            assert!(error.contains(part), "{error}");
        }
        is(at(&xml, r#", "status": "afterAdjustment""#, 311.0), [0.0805, 0.06]);
        let places = r#""quantity": [1, 3], "index": 0"#;
        let error = model_in("K", &xml, places, "").unwrap_err().to_string();
        assert!(error.contains("of `afterAdjustment` and `beforeAdjustment`"), "{error}");
    }
}

/// Two sensors of one certificate, in the ways that tables are apart.
#[test]
fn several_sensors() {
    let first = |attributes: &str| table(attributes, "300 320", "0.01 0.03", "0.1");
    let second = |attributes: &str| table(attributes, "310 330", "0.51 0.53", "0.2");
    let of =
        |sensor: usize, table: &str| named("result", "", &format!("Sensor {sensor}"), "", table);
    let results = of(1, &first("")) + &of(2, &second(""));
    let lists = of(1, &(first(" refType=\"gp_table1\"") + &second(" refType=\"gp_table2\"")));
    let ids = of(1, &(first(" id=\"a\"") + &second(" id=\"b\"")));
    for (results, keys) in [
        (results, ["Sensor 1", "Sensor 2"]),
        (lists, ["gp_table1", "gp_table2"]),
        (ids, ["a", "b"]),
    ] {
        let xml = measured("", &results);
        for keys in ["", r#", "status": "beforeAdjustment""#] {
            assert!(at(&xml, keys, 315.0).is_err());
        }
        let error = at(&xml, "", 315.0).unwrap_err();
        let expected = [(320.0, [0.03, 0.1]), (320.0, [0.52, 0.2])];
        for (key, (temperature, expected)) in keys.into_iter().zip(expected) {
            assert!(error.contains(&format!("by `\"within\": \"{key}\"`")), "{error}");
            is(at(&xml, &format!(r#", "within": "{key}""#), temperature), expected);
        }
        let error = at(&xml, r#", "within": "Sensor 3""#, 315.0).unwrap_err();
        assert!(error.contains("nothing around these quantities is called `Sensor 3`"), "{error}");
        // one value too
        let input = format!(r#"{KIND}, "index": 1"#);
        let error = model_in("K", &xml, &input, "").unwrap_err().to_string();
        assert!(error.contains("there are 2 tables"), "{error}");
    }
    // nothing tells them apart but their places
    let xml = measured("", &of(1, &(first("") + &second(""))));
    let error = at(&xml, "", 315.0).unwrap_err();
    assert!(error.contains("`\"quantity\": 1`; 2 values") && error.contains("`\"quantity\": 3`"));
    let file = model_in("K", &xml, r#""quantity": 3, "index": 1"#, "").unwrap();
    near(known(&file, 0), [0.53, 0.1]);
}

/// A value at a point, in a list of its own.
fn row(attributes: &str, x: &str, y: &str) -> String {
    format!(
        "<dcc:list{attributes}><dcc:quantity refType=\"basic_nominalValue\">{}</dcc:quantity>\
         <dcc:quantity refType=\"basic_measurementError\">{}</dcc:quantity></dcc:list>",
        real(x, r"\kelvin", ""),
        real(y, r"\kelvin", &expanded(["0.2", "2", "0.95", ""]))
    )
}

#[test]
fn quantities_of_one_value_are_joined() {
    let rows = row("", "300", "0.1") + &row("", "310", "0.2") + &row("", "320", "0.4");
    let of = |name: &str, data: &str| named("result", "", name, "", data);
    let in_list = format!("<dcc:list>{rows}</dcc:list>");
    for data in [&rows, &in_list] {
        let xml = measured("", &of("A", data));
        is(at(&xml, "", 315.0), [0.3, 0.2]);
        let input = format!(r#"{KIND}, "index": 2"#);
        near(known(&model_in("K", &xml, &input, "").unwrap(), 0), [0.4, 0.1]);
    }
    // values of a column in one list
    let column = |values: [&str; 2]| {
        let one = |y: &str| {
            let value = real(y, r"\kelvin", &expanded(["0.2", "2", "0.95", ""]));
            format!("<dcc:quantity refType=\"basic_measurementError\">{value}</dcc:quantity>")
        };
        format!("<dcc:list>{}</dcc:list>", values.map(one).concat())
    };
    let xml = measured("", &of("A", &column(["0.1", "0.2"])));
    let input = format!(r#"{KIND}, "index": 1"#);
    near(known(&model_in("K", &xml, &input, "").unwrap(), 0), [0.2, 0.1]);
    let error = at(&xml, "", 315.0).unwrap_err();
    assert!(error.contains("same abscissa") || error.contains("no quantity beside"), "{error}");
    // rows of two tables, of two results, of two kinds, and two columns
    for results in [
        of("A", &format!("{in_list}{in_list}")),
        of("A", &rows) + &of("B", &rows),
        of("A", &(row(" refType=\"a\"", "300", "0.1") + &row(" refType=\"b\"", "310", "0.2"))),
        of("A", &(column(["0.1", "0.2"]) + &column(["0.3", "0.4"]))),
        of("A", &row("", "300", "0.1"))
            + &of("B", &(row("", "310", "0.2") + &row("", "320", "0.4"))),
    ] {
        let xml = measured("", &results);
        let error = model_in("K", &xml, &input, "").unwrap_err().to_string();
        assert!(error.contains("there are 2 tables"), "{error}");
    }
    // results of one value each, and the same by their places
    let results = of("A", &row("", "300", "0.1")) + &of("B", &row("", "310", "0.2"));
    let xml = measured("", &results);
    let conditions = r#", "conditions": {"t": {"unit": "K", "values": [305]}}"#;
    for input in [&format!(r#"{KIND}, "at": "t""#), r#""quantity": [1, 3], "at": "t""#] {
        let file = model_in("K", &xml, input, conditions).unwrap();
        let [mean, u, _] = known(&file, 0);
        assert!((mean - 0.15).abs() < 1e-12 && (u - 0.1).abs() < 1e-12);
    }
    for (places, part) in [
        ("[1, 9]", "has 4 quantities, counted from 0"),
        ("[1, 1]", "named twice"),
        ("[]", "names no quantity"),
        (r#"["x"]"#, "has 4 quantities"),
    ] {
        let input = format!(r#""quantity": {places}, "index": 0"#);
        let error = model_in("K", &xml, &input, "").unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// What stands among the results goes before conditions, the equipment, and limits about a result.
#[test]
fn results_go_before_the_rest() {
    let one = |value: &str, more: &str| {
        let value = real(value, r"\kelvin", &expanded(["0.2", "2", "0.95", ""]));
        format!("<dcc:quantity refType=\"basic_measurementError\">{value}{more}</dcc:quantity>")
    };
    let about = format!(
        "<dcc:measurementMetaData><dcc:metaData><dcc:data>{}</dcc:data></dcc:metaData>\
         </dcc:measurementMetaData>",
        one("7", "")
    );
    let own = format!(
        "<dcc:influenceConditions>{}</dcc:influenceConditions>",
        named("influenceCondition", "", "air", "", &one("8", ""))
    );
    let result = named("result", "", "R", "", &one("3", &(own + &about)));
    let condition = named("influenceCondition", "", "C", "", &one("9", ""));
    let xml = measured(&condition, &result);
    let of = |keys: &str| {
        let file = model_in("K", &xml, &format!("{KIND}{keys}"), "");
        file.map(|file| known(&file, 0)[0]).map_err(|errors| errors.to_string())
    };
    assert_eq!(of(""), Ok(3.0));
    assert_eq!(of(r#", "within": "C""#), Ok(9.0));
    assert_eq!(of(r#", "within": "air""#), Ok(8.0));
    let listing = crate::certificate_listing_text("c.xml", &xml).unwrap();
    let places: Vec<&str> = listing.results.iter().filter_map(|of| of.place.as_deref()).collect();
    let expected = ["influenceConditions", "results", "influenceConditions", "measurementMetaData"];
    assert_eq!(places, expected);
}

/// A list is as long as the others of its quantity, or has one entry: `2 850` is two numbers of XML.
#[test]
fn lists_of_a_quantity_have_one_length() {
    let list = |values: &str, units: &str, more: &str| {
        quantity(&format!(
            "<si:realListXMLList>{more}<si:valueXMLList>{values}</si:valueXMLList>\
             <si:unitXMLList>{units}</si:unitXMLList></si:realListXMLList>"
        ))
    };
    let units = |count: usize| vec![r"\volt"; count].join(" ");
    let six = "0.00 2 850 5 700 8 550 11 433 14 300";
    let labels = |count: usize| {
        let labels = vec!["p"; count].join(" ");
        format!("<si:labelXMLList>{labels}</si:labelXMLList>")
    };
    for (values, units, more, found) in [
        (six, units(6), String::new(), "`unitXMLList` has 6 entries for 11 values"),
        ("1 2 3 4 5", units(2), String::new(), "`unitXMLList` has 2 entries for 5 values"),
        ("1 2 3 4 5", units(7), String::new(), "`unitXMLList` has 7 entries for 5 values"),
        ("1", units(2), String::new(), "`unitXMLList` has 2 entries for 1 value:"),
        (six, units(1), labels(6), "`labelXMLList` has 6 entries for 11 values"),
    ] {
        let error = refused(&list(values, &units, &more), r#", "index": 1"#);
        assert!(error.contains(found), "{error}");
    }
    let right = "0.00 2850 5700 8550 11433 14300";
    for (units, more) in [(units(6), labels(6)), (units(1), labels(1)), (units(1), String::new())] {
        let file = accepted(&list(right, &units, &more), r#", "index": 1"#);
        near(known(&file, 0), [2850.0, 0.0]);
    }
}

/// The good practice of the DKD with an adjustment, where `GUMPTION_CERTIFICATES` names a folder that has
/// it: between 0.072, 0.089 and 0.107 K at 306.248, 373.121 and 448.253 K by straight lines, U = 0.061 K.
#[test]
fn a_certificate_of_others_with_an_adjustment() {
    let Some(folder) = std::env::var_os("GUMPTION_CERTIFICATES") else { return };
    let path = std::path::Path::new(&folder).join("temperature-adjustment.xml");
    let Ok(xml) = std::fs::read_to_string(path) else { return };
    let [x, y] = [[306.248, 373.121, 448.253], [0.072, 0.089, 0.107]];
    let line = |t: f64, i: usize| y[i] + (t - x[i]) / (x[i + 1] - x[i]) * (y[i + 1] - y[i]);
    for t in [373.15, 393.15] {
        is(at(&xml, "", t), [line(t, 1), 0.061]);
    }
    let listing = crate::certificate_listing_text("c.xml", &xml).unwrap();
    let before = listing.results.iter().filter(|of| of.status.is_some());
    assert!(before.clone().count() > 3);
    assert!(before.into_iter().all(|of| of.place.as_deref() != Some("results")));
}

/// A fit takes a table of a certificate: f = 10, 20, 40 Hz, and 1, 3, 4 mV with U = 0.2, 0.4, 0.4 mV for k = 2. The
/// weighted straight line by hand, with weights 100, 25, 25 per (mV)^2: sums 150, 2500, 60000 of 1, f, f^2 and 275, 6500 of
/// y, f y.
#[test]
fn a_fit_over_a_table() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ref.xml"), certificate("3.2.1", TABLE)).unwrap();
    let dcc = r#"{"dcc": {"file": "ref.xml", "ref_type": "basic_measuredValue", "at": "f"}}"#;
    let model = |y: &str| {
        let text = format!(
            r#"{{"fits": {{"line": {{"x": {dcc}, "y": {y}}}}}, "equations": {{"v": "line(30 [Hz])"}},
            "outputs": {{"v": {{"unit": "mV"}}}}}}"#
        );
        std::fs::write(folder.path().join("m.json"), text).unwrap();
        read_model(&folder.path().join("m.json"), &[])
    };
    let file = model(dcc).unwrap();
    let fit = &file.task.curves[0].fit;
    let determinant = 150.0 * 60_000.0 - 2500.0 * 2500.0;
    let slope = (150.0 * 6500.0 - 2500.0 * 275.0) / determinant;
    let zero = (60_000.0 * 275.0 - 2500.0 * 6500.0) / determinant;
    // rounding of a few operations
    assert!((fit.estimate(1) - slope).abs() < 1e-12, "{} {slope}", fit.estimate(1));
    assert!((fit.estimate(0) - zero).abs() < 1e-12);
    let of_slope = (150.0_f64 / determinant).sqrt();
    assert!((fit.standard_uncertainty(1) - of_slope).abs() < 1e-12);
    assert_eq!((file.task.curves[0].x.text(), file.task.curves[0].y.text()), ("Hz", "mV"));
    let twice = r#"{"dcc": {"file": "ref.xml", "ref_type": "basic_measuredValue", "at": "f"}, "unit": "V"}"#;
    assert!(model(twice).unwrap_err().to_string().contains("leave out `unit`"));
    let without = r#"{"dcc": {"file": "ref.xml", "ref_type": "basic_measuredValue"}}"#;
    assert!(model(without).unwrap_err().to_string().contains("needs the key `at`"));
}
