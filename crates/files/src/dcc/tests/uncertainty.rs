//! What is stated of uncertainties, in all of the ways that certificates have, and what is not.

use super::*;

const U: [&str; 4] = ["0.2", "2", "0.95", ""];

fn list(values: &str, more: &str) -> String {
    format!(
        "<si:realListXMLList><si:valueXMLList>{values}</si:valueXMLList>\
         <si:unitXMLList>\\volt</si:unitXMLList>{more}</si:realListXMLList>"
    )
}

fn expanded_list([u, k, p, law]: [&str; 4]) -> String {
    format!(
        "<si:expandedUncXMLList><si:uncertaintyXMLList>{u}</si:uncertaintyXMLList>\
         <si:coverageFactorXMLList>{k}</si:coverageFactorXMLList>\
         <si:coverageProbabilityXMLList>{p}</si:coverageProbabilityXMLList>{}\
         </si:expandedUncXMLList>",
        match law {
            "" => String::new(),
            _ => format!("<si:distributionXMLList>{law}</si:distributionXMLList>"),
        }
    )
}

/// A table over t = 0, 10, 20.
fn table(values: &str) -> String {
    let over = "<dcc:quantity refType=\"basic_nominalValue\"><si:realListXMLList><si:valueXMLList>\
                0 10 20</si:valueXMLList><si:unitXMLList>\\kelvin</si:unitXMLList>\
                </si:realListXMLList></dcc:quantity>";
    format!("{over}{}", quantity(values))
}

fn tabulated(values: &str, at: &str) -> Result<ModelFile, Diagnostics> {
    let conditions = format!(r#", "conditions": {{"t": {{"unit": "K", "values": [{at}]}}}}"#);
    model(&certificate("3.2.1", &table(values)), r#""id": "v", "at": "t""#, &conditions)
}

/// A value that states none is exact, and that is told; a nominal value is exact by its nature.
#[test]
fn a_value_without_uncertainty_is_noted() {
    let alone = quantity(&real("10", r"\volt", ""));
    let file = accepted(&alone, "");
    near(known(&file, 0), [10.0, 0.0]);
    assert!(has_note(&file, "certificate-exact"));
    let nominal = alone.replace("id=", "refType=\"basic_nominalValue\" id=");
    assert!(!has_note(&accepted(&nominal, ""), "certificate-exact"));
    let with = quantity(&real("10", r"\volt", &expanded(U)));
    assert!(!has_note(&accepted(&with, ""), "certificate-exact"));
    assert!(has_note(&tabulated(&list("1 2 3", ""), "5").unwrap(), "certificate-exact"));
}

/// Where others of a list, or the same quantity of other rows, have an uncertainty, one without is asked.
#[test]
fn a_value_without_uncertainty_among_others_is_refused() {
    let [with, without] = [expanded(U), String::new()];
    let parts = |all: [&String; 3]| -> String {
        let parts = ["1", "2", "3"].iter().zip(all);
        parts.map(|(value, u)| real(value, r"\volt", u)).collect()
    };
    for (all, lacking) in [([&without, &with, &with], 0), ([&with, &without, &with], 1)] {
        let text = quantity(&format!("<si:list>{}</si:list>", parts(all)));
        for index in 0..3 {
            let more = format!(r#", "index": {index}"#);
            if index == lacking {
                let error = refused(&text, &more);
                assert!(error.contains(&format!("value {index} (from 0)")), "{error}");
                assert!(error.contains("has no uncertainty, while others of its list"), "{error}");
            } else {
                // U/k = 0.2/2
                near(known(&accepted(&text, &more), 0), [f64::from(index + 1), 0.1]);
            }
        }
        let error = tabulated(&format!("<si:list>{}</si:list>", parts(all)), "15").unwrap_err();
        assert!(error.to_string().contains("has no uncertainty"), "{error}");
    }
    let row = |id: &str, x: &str, u: &str| {
        format!(
            "<dcc:list><dcc:quantity refType=\"basic_nominalValue\">{}</dcc:quantity>\
             <dcc:quantity id=\"{id}\" refType=\"basic_measuredValue\">{}</dcc:quantity></dcc:list>",
            real(x, r"\kelvin", ""),
            real(x, r"\volt", u)
        )
    };
    let rows = [row("a", "0", &with), row("v", "10", ""), row("b", "20", &with)].concat();
    let error = refused(&rows, "");
    assert!(error.contains("this value has no uncertainty, while those of other rows have one"));
    let conditions = r#", "conditions": {"t": {"unit": "K", "values": [5]}}"#;
    let at = r#""ref_type": "basic_measuredValue", "at": "t""#;
    let error = model(&certificate("3.2.1", &rows), at, conditions).unwrap_err().to_string();
    assert!(error.contains("has no uncertainty"), "{error}");
    let whole = rows.replace(
        "10</si:value><si:unit>\\volt</si:unit>",
        &format!("10</si:value><si:unit>\\volt</si:unit>{with}"),
    );
    let file = model(&certificate("3.2.1", &whole), at, conditions).unwrap();
    near(known(&file, 0), [5.0, 0.1]);
}

/// Each value of a list has the distribution that it names, and that of no other one.
#[test]
fn distributions_of_a_list_are_of_each() {
    let parts = [
        real("1", r"\volt", &expanded(U)),
        real("2", r"\volt", &expanded(["0.2", "1.65", "0.95", "rectangular"])),
    ];
    let text = quantity(&format!("<si:list>{}</si:list>", parts.concat()));
    let [one, other] = [0, 1].map(|n| accepted(&text, &format!(r#", "index": {n}"#)));
    let names = [&one, &other].map(|file| file.task.rows[0].distributions[0].name());
    assert_eq!(names, ["normal", "rectangular"]);
    near(known(&other, 0), [2.0, 0.2 / 1.65]);
}

/// Beside an expanded uncertainty it is U over the value; alone it does not say what it is.
#[test]
fn relative_uncertainties() {
    let single = |share: &str, unit: &str| {
        format!(
            "<dcc:relativeUncertainty><dcc:relativeUncertaintySingle><si:value>{share}</si:value>\
             <si:unit>{unit}</si:unit></dcc:relativeUncertaintySingle></dcc:relativeUncertainty>"
        )
    };
    let value = real("10", r"\volt", &expanded(U));
    // 0.2/10, and with fewer digits
    for (share, unit) in
        [("0.02", r"\one"), ("0.0200", r"\one"), ("2", r"\percent"), ("2.0", r"\percent")]
    {
        let file = accepted(&quantity(&(value.clone() + &single(share, unit))), "");
        near(known(&file, 0), [10.0, 0.1]);
    }
    // half a digit of 0.2 leaves 0.015 to 0.025, not 0.05
    let error = refused(&quantity(&(value.clone() + &single("0.0500", r"\one"))), "");
    assert!(error.contains("relative uncertainty is 0.05 of the value 10 V"), "{error}");
    let error = refused(&quantity(&(value + &single("0.02", r"\volt"))), "");
    assert!(error.contains("no unit `V`"), "{error}");
    let alone = quantity(&(real("10", r"\volt", "") + &single("0.02", r"\one")));
    assert!(refused(&alone, "").contains("states a relative uncertainty alone"));
    let many = "<dcc:relativeUncertainty><dcc:relativeUncertaintyXmlList><si:valueXMLList>0.2 0.1</si:valueXMLList>\
                <si:unitXMLList>\\one</si:unitXMLList></dcc:relativeUncertaintyXmlList></dcc:relativeUncertainty>";
    let text = quantity(&(list("1 2", &expanded_list(["0.2", "2", "0.95", ""])) + many));
    near(known(&accepted(&text, r#", "index": 1"#), 0), [2.0, 0.1]);
    let alone = list("1 2", "") + many;
    assert!(refused(&quantity(&alone), r#", "index": 1"#).contains("relative uncertainty alone"));
    let error = tabulated(&(list("1 2 3", "") + &many.replace("0.2 0.1", "0.1")), "5").unwrap_err();
    assert!(error.to_string().contains("relative uncertainty alone"), "{error}");
}

/// What is stated of an uncertainty and is not read is no exact value.
#[test]
fn unknown_statements_of_uncertainty_are_refused() {
    for element in ["expandedUncertainty", "ellipsoidalRegion", "listUnivariateUnc"] {
        let text = quantity(&real("10", r"\volt", &format!("<si:{element}/>")));
        let error = refused(&text, "");
        assert!(error.contains(&format!("stated as `{element}` here")), "{error}");
    }
}

/// A point of a table has its own degrees of freedom and its own shape, also the last one; k = 2.87 at
/// 95.45 % is the t distribution of 4 (JCGM 100, table G.2).
#[test]
fn points_of_a_table_are_their_own() {
    let values = list("1 2 3", &expanded_list(["0.2", "2 2.87 2", "0.9545", ""]));
    let file = tabulated(&values, "0, 5, 10, 15, 20").unwrap();
    let dof = [0, 1, 2, 3, 4].map(|row| known(&file, row)[2]);
    assert_eq!(dof, [f64::INFINITY, 4.0, 4.0, 4.0, f64::INFINITY]);
    near(known(&file, 4), [3.0, 0.1]);
    let law = "rectangular normal rectangular";
    let values = list("1 2 3", &expanded_list(["0.2", "1.65 1.96 1.65", "0.95", law]));
    let file = tabulated(&values, "0, 5, 10, 20").unwrap();
    let names = [0, 1, 2, 3].map(|row| file.task.rows[row].distributions[0].name());
    assert_eq!(names, ["rectangular", "normal", "normal", "rectangular"]);
    let values =
        list("1 2 3", &expanded_list(["0.2", "1.65 1.65 1.96", "0.95", "uniform uniform normal"]));
    let file = tabulated(&values, "5, 15").unwrap();
    let names = [0, 1].map(|row| file.task.rows[row].distributions[0].name());
    assert_eq!(names, ["rectangular", "normal"]);
}

fn interval([u, low, high, p, law]: [&str; 5]) -> String {
    let law = match law {
        "" => String::new(),
        _ => format!("<si:distribution>{law}</si:distribution>"),
    };
    format!(
        "<si:coverageInterval><si:standardUnc>{u}</si:standardUnc><si:intervalMin>{low}</si:intervalMin>\
         <si:intervalMax>{high}</si:intervalMax><si:coverageProbability>{p}</si:coverageProbability>{law}\
         </si:coverageInterval>"
    )
}

#[test]
fn coverage_intervals_agree_with_their_values() {
    let of = |parts: [&str; 5]| quantity(&real("10.000", r"\volt", &interval(parts)));
    // 1.96 x 0.100
    for (ends, law) in [(["9.804", "10.196"], "normal"), (["9.80", "10.20"], "")] {
        let file = accepted(&of(["0.100", ends[0], ends[1], "0.95", law]), "");
        assert!(!has_note(&file, "certificate-asymmetric"));
        let [mean, u, dof] = known(&file, 0);
        assert_eq!([mean, u, dof], [10.0, 0.1, f64::INFINITY]);
    }
    // JCGM 100, table G.2: t of 3 degrees of freedom, 3.18 at 95 %
    for law in ["", "t"] {
        let file = accepted(&of(["0.1000", "9.6818", "10.3182", "0.950", law]), "");
        let [_, u, dof] = known(&file, 0);
        assert!((u, dof) == (0.1, 3.0), "{u} {dof}");
    }
    // 0.95 of a half-width of 0.1 x sqrt(3) is 0.1645
    let file = accepted(&of(["0.1000", "9.8355", "10.1645", "0.9500", "rectangular"]), "");
    assert_eq!(file.task.rows[0].distributions[0].name(), "rectangular");
    for parts in [
        ["0.100", "9.900", "10.100", "0.950", ""],
        ["0.100", "9.682", "10.318", "0.950", "normal"],
        ["0.100", "9.682", "10.318", "0.950", "rectangular"],
        ["0.000", "9.682", "10.318", "0.950", ""],
    ] {
        let error = refused(&of(parts), "");
        assert!(error.contains("which do not belong together"), "{error}");
    }
    let error = refused(&of(["0.100", "10.196", "9.804", "0.95", ""]), "");
    assert!(error.contains("in reverse order"), "{error}");
    let file = accepted(&of(["1", "9.5", "15", "0.95", ""]), "");
    near(known(&file, 0), [10.0, 1.0]);
    assert!(has_note(&file, "certificate-asymmetric"));
    // a value that is written without zeros is no coarser than the ends
    let text = quantity(&real("10", r"\volt", &interval(["0.1", "9.9", "10.5", "0.95", "normal"])));
    assert!(has_note(&accepted(&text, ""), "certificate-asymmetric"));
    let lists = "<si:coverageIntervalXMLList><si:standardUncXMLList>0.1</si:standardUncXMLList>\
                 <si:intervalMinXMLList>0.80 1.5 2.80</si:intervalMinXMLList>\
                 <si:intervalMaxXMLList>1.20 2.1 3.20</si:intervalMaxXMLList>\
                 <si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList>\
                 </si:coverageIntervalXMLList>";
    let text = quantity(&list("1.00 2.00 3.00", lists));
    for (index, is_noted) in [(0, false), (1, true), (2, false)] {
        let file = accepted(&text, &format!(r#", "index": {index}"#));
        assert_eq!(has_note(&file, "certificate-asymmetric"), is_noted, "{index}");
    }
    assert!(has_note(
        &tabulated(&list("1.00 2.00 3.00", lists), "5").unwrap(),
        "certificate-asymmetric"
    ));
}

/// The factor of a coverage probability is that of the shape.
#[test]
fn probabilities_without_a_factor() {
    let of = |law: &str| quantity(&real("10", r"\volt", &expanded(["0.1", "", "0.95", law])));
    for (law, name, u) in [
        // the factor 1.959963984540054
        ("", "normal", 0.1 / 1.959_963_984_540_054),
        ("normal", "normal", 0.1 / 1.959_963_984_540_054),
        // U = 0.95 a, u = a/sqrt(3)
        ("rectangular", "rectangular", 0.1 / 0.95 / 3.0_f64.sqrt()),
        // 0.95 = 1 - (1 - U/a)^2, u = a/sqrt(6)
        ("triangular", "triangular", 0.1 / (1.0 - 0.05_f64.sqrt()) / 6.0_f64.sqrt()),
        // 0.95 = 2/pi asin(U/a), u = a/sqrt(2)
        ("U-shaped", "arcsine", 0.1 / 85.5_f64.to_radians().sin() / 2.0_f64.sqrt()),
    ] {
        let file = accepted(&of(law), "");
        let [_, found, _] = known(&file, 0);
        assert!((found / u - 1.0).abs() < 1e-10, "{law} {found} {u}");
        assert_eq!(file.task.rows[0].distributions[0].name(), name, "{law}");
    }
    let error = refused(&of("t"), "");
    assert!(error.contains("t distribution without a coverage factor"), "{error}");
}

/// Factors of a normal distribution: 1.96 at 95 %, 2 at 95.45 %, 3 at 99.73 %; of a rectangular one 0.95
/// sqrt(3) = 1.645, and all of it lies within sqrt(3) = 1.73. No t distribution has less than a normal one.
#[test]
fn factors_and_probabilities_belong_together() {
    let of = |k: &str, p: &str, law: &str| {
        quantity(&real("10", r"\volt", &expanded(["0.1", k, p, law])))
    };
    for (k, p, law) in [
        ("1", "0.95", "normal"),
        ("3", "0.95", "normal"),
        ("2.5", "0.95", "normal"),
        ("2", "0.99", "normal"),
        ("2", "0.9973", ""),
        ("1", "0.95", ""),
        ("3", "0.95", ""),
        ("1.93", "0.95", ""),
        ("2", "0.95", "uniform"),
        ("3", "0.95", "uniform"),
        ("1.73", "0.95", "rectangular"),
        ("2", "0.95", "U-shaped"),
        ("1.5", "0.95", "t"),
    ] {
        let error = refused(&of(k, p, law), "");
        let said =
            format!("coverage factor of {k} and a coverage probability of {p}, which do not");
        assert!(error.contains(&said), "{law}: {error}");
    }
    let error = refused(&of("1.5", "0.95", "t"), "");
    assert!(error.contains("a t distribution is at least 1.96"), "{error}");
    let error = refused(&of("2", "0.95", "uniform"), "");
    assert!(error.contains("a rectangular distribution is 1.65"), "{error}");
    for (k, p, law) in [
        ("2", "0.95", "normal"),
        ("2.0", "0.950", "normal"),
        ("2.00", "0.9545", "normal"),
        ("2", "0.954", ""),
        ("1.96", "0.95", "normal"),
        ("1", "0.68", "normal"),
        ("2.58", "0.99", "normal"),
        ("3", "0.99", "normal"),
        ("3", "0.997", ""),
        ("3", "0.9973", "normal"),
        ("1.65", "0.90", ""),
        ("1.65", "0.95", "uniform"),
        ("1.9", "0.95", "triangular"),
        ("2", "0.95", "t"),
        ("1.2", "0.95", "other"),
    ] {
        let [_, u, _] = known(&accepted(&of(k, p, law), ""), 0);
        assert!((u * k.parse::<f64>().unwrap() / 0.1 - 1.0).abs() < 1e-12, "{k} {p} {law}");
    }
    // table G.2 of JCGM 100: 2.57 is of 5 degrees of freedom
    assert_eq!(known(&accepted(&of("2.57", "0.95", ""), ""), 0)[2], 5.0);
}

/// Without a name a factor is that of a normal or of a t distribution, or it is asked: 1.65 and 1.9 are those
/// of a rectangular (0.95 sqrt(3) = 1.645) and of a triangular distribution ((1 - sqrt(0.05)) sqrt(6) = 1.902)
/// at 95 %; 1.18 at 68 % is that of a rectangular one (1.178) and of t with 3 degrees of freedom (1.19).
#[test]
fn factors_of_no_normal_distribution_are_asked() {
    let of = |k: &str, p: &str, law: &str| {
        quantity(&real("10", r"\volt", &expanded(["1.1", k, p, law])))
    };
    for (k, p, names, law, shape) in [
        (
            "1.65",
            "0.95",
            "a distribution `rectangular`; a normal one has 1.96",
            "rectangular",
            "rectangular",
        ),
        (
            "1.9",
            "0.95",
            "a distribution `triangular`; a normal one has 1.96",
            "triangular",
            "triangular",
        ),
        ("1.41", "0.95", "a distribution `arcsine`; a normal one has 1.96", "arcsine", "arcsine"),
        ("1.18", "0.68", "a distribution `t` or `rectangular`", "t", "t"),
        ("1.6", "0.90", "a distribution `normal` or `rectangular`", "normal", "normal"),
    ] {
        let error = refused(&of(k, p, ""), "");
        let said = format!(
            "has a coverage factor of {k} and a coverage probability of {p} and names no distribution"
        )
        .replace("0.90", "0.9");
        assert!(error.contains(&said) && error.contains(names), "{error}");
        assert!(error.contains("`\"law\": \""), "{error}");
        let file = accepted(&of(k, p, ""), &format!(r#", "law": "{law}""#));
        let drawn = &file.task.rows[0].distributions[0];
        let shape = if shape == "t" { "normal" } else { shape };
        assert_eq!(drawn.name(), shape, "{k}");
        let [_, u, dof] = known(&file, 0);
        assert!((u * k.parse::<f64>().unwrap() / 1.1 - 1.0).abs() < 1e-12, "{k}");
        assert_eq!(dof.is_finite(), law == "t", "{k} {dof}");
    }
    // what is named otherwise, or by a name that is not known
    let error = refused(&of("2", "0.95", "normal"), r#", "law": "rectangular""#);
    assert!(error.contains("is called `normal` (normal)"), "{error}");
    let file = accepted(&of("1.65", "0.95", "of its own"), r#", "law": "rectangular""#);
    assert_eq!(file.task.rows[0].distributions[0].name(), "rectangular");
    assert!(!has_note(&file, "certificate-distribution"));
    let error = refused(&of("2", "0.95", ""), r#", "law": "lognormal""#);
    assert!(error.contains("rectangular"), "{error}");
    let error = refused(&of("1.9", "0.95", ""), r#", "law": "rectangular""#);
    assert!(error.contains("which do not belong together"), "{error}");
    let error = refused(&quantity(&real("10", r"\volt", "")), r#", "law": "normal""#);
    assert!(error.contains("states no uncertainty here"), "{error}");
}

/// All of a distribution with limits may lie within U, and of no other one.
#[test]
fn the_whole_of_a_distribution() {
    let of = |k: &str, law: &str| quantity(&real("10", r"\volt", &expanded(["0.1", k, "1", law])));
    near(known(&accepted(&of("1.73", "rectangular"), ""), 0), [10.0, 0.1 / 1.73]);
    // half-width 0.1
    for (law, root) in [("rectangular", 3.0_f64), ("triangular", 6.0), ("arcsine", 2.0)] {
        near(known(&accepted(&of("", law), ""), 0), [10.0, 0.1 / root.sqrt()]);
    }
    let error = refused(&of("1", "rectangular"), "");
    assert!(error.contains("reaches 1.7321 standard uncertainties"), "{error}");
    for law in ["", "normal", "t"] {
        let error = refused(&of("2", law), "");
        assert!(error.contains("coverage probability of 1, which must be between 0 and 1"));
    }
    let zero = real("10", r"\volt", &expanded(["0.1", "2", "0", "rectangular"]));
    assert!(refused(&quantity(&zero), "").contains("coverage probability of 0"));
}

/// D-SI says of a constant that its uncertainty is the standard deviation.
#[test]
fn uncertainties_of_constants() {
    let of = |law: &str| {
        quantity(&format!(
            "<si:constant><si:value>1.5</si:value><si:unit>\\volt</si:unit>\
             <si:uncertainty>0.1</si:uncertainty>{law}</si:constant>"
        ))
    };
    near(known(&accepted(&of(""), ""), 0), [1.5, 0.1]);
    let file = accepted(&of("<si:distribution>rectangular</si:distribution>"), "");
    near(known(&file, 0), [1.5, 0.1]);
    assert_eq!(file.task.rows[0].distributions[0].name(), "rectangular");
}

/// A certificate of our own states k without a probability in a text alone.
#[test]
fn results_whose_uncertainty_is_a_text_are_refused() {
    use base64::Engine as _;
    let answer =
        r#"{"gumption": "1", "rows": [{"output": "y", "unit": "V"}], "correlations": [[1]]}"#;
    let data = base64::engine::general_purpose::STANDARD.encode(answer);
    let attached = format!(
        "<dcc:byteData><dcc:fileName>result.json</dcc:fileName><dcc:dataBase64>{data}</dcc:dataBase64>\
         </dcc:byteData>"
    );
    let value = quantity(&list("10", "")).replace("id=", "refType=\"basic_measuredValue\" id=");
    let error = refused(&(value.clone() + &attached), "");
    assert!(error.contains("in the description of the certificate alone"), "{error}");
    let whole = list("10", &expanded_list(["0.2", "2", "0.95", "normal"]));
    let value = value.replace(&list("10", ""), &whole);
    near(known(&accepted(&(value + &attached), ""), 0), [10.0, 0.1]);
}
