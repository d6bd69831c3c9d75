//! What certificates are written in: units of their own, nested elements, blanks and marks.

use super::*;

const U: [&str; 4] = ["1", "2", "0.95", ""];

/// A value of 10 in a unit, with definitions in the quantity.
fn defined(unit: &str, definitions: &[(&str, &str)]) -> String {
    let about = |(definition, name): &(&str, &str)| {
        format!(
            "<dcc:metaData><dcc:nonSIDefinition>{definition}</dcc:nonSIDefinition>\
             <dcc:nonSIUnit>{name}</dcc:nonSIUnit></dcc:metaData>"
        )
    };
    let about: String = definitions.iter().map(about).collect();
    let value = real("10", unit, &expanded(U));
    quantity(&format!("{value}<dcc:measurementMetaData>{about}</dcc:measurementMetaData>"))
}

fn read(text: &str, unit: &str) -> Result<ModelFile, String> {
    let input = format!(r#""id": "v", "unit": "{unit}""#);
    model_in(unit, &certificate("3.2.1", text), &input, "").map_err(|errors| errors.to_string())
}

#[test]
fn definitions_of_units() {
    for (definitions, unit, value) in [
        (&[("foo = 3 m", "foo")][..], "m", 30.0),
        (&[("1 foo = 3 m", "foo")], "m", 30.0),
        // 10 foo of 0.03 m each
        (&[("100 foo = 3 m", "foo")], "m", 0.3),
        (&[("foo = 3 \\metre", "foo")], "m", 30.0),
        (&[("bar = 5 m", "bar"), ("foo = 3 m", "foo")], "m", 30.0),
        (&[("foo = 3 m", "foo"), ("foo = 0.003 km", "foo")], "m", 30.0),
    ] {
        let file = read(&defined("|foo", definitions), unit).unwrap();
        // u is half of U = 1
        near(known(&file, 0), [value, value / 20.0]);
    }
    for (definitions, part) in [
        (&[("bar = 5 m", "bar")][..], "does not define it: `foo = NUMBER UNIT` would"),
        (&[("m = 3 foo", "foo")], "does not define it"),
        (&[("foo = 3,5 m", "foo")], "is no definition of a unit that can be read"),
        (&[("foo = 3 m = 9.84 ft", "foo")], "is no definition of a unit that can be read"),
        (&[("0 foo = 3 m", "foo")], "is no definition of a unit that can be read"),
        (&[("foo = 3 m", "foo"), ("foo = 4 m", "foo")], "another definition of it says"),
    ] {
        let error = read(&defined("|foo", definitions), "m").unwrap_err();
        assert!(error.contains(part), "{part}: {error}");
    }
    // of the statements of the certificate
    let xml = certificate("3.2.1", &quantity(&real("10", "|foo", &expanded(U)))).replace(
        "<dcc:measurementResults>",
        "<dcc:administrativeData><dcc:statements><dcc:statement><dcc:nonSIDefinition>foo = 3 m\
         </dcc:nonSIDefinition></dcc:statement></dcc:statements></dcc:administrativeData>\
         <dcc:measurementResults>",
    );
    near(known(&model_in("m", &xml, r#""id": "v", "unit": "m""#, "").unwrap(), 0), [30.0, 1.5]);
}

/// A definition that says the same as what is known, to its digits, and one that does not.
#[test]
fn definitions_of_known_units() {
    for (unit, definition, si, size) in [
        // 1 psi is 6894.757293 Pa, 1 mmHg 133.322387 Pa
        ("psi", "psi = 6894.757 Pa", "Pa", 6_894.757_293_168_361),
        ("psi", "psi is a pressure", "Pa", 6_894.757_293_168_361),
        ("cal", "1 cal = 4.184 J", "J", 4.184),
        ("t", "t = 1000 kg", "kg", 1000.0),
    ] {
        let file = read(&defined(&format!("|{unit}"), &[(definition, unit)]), si);
        let [mean, ..] = known(&file.unwrap_or_else(|error| panic!("{definition}: {error}")), 0);
        assert!((mean / (10.0 * size) - 1.0).abs() < 1e-9, "{definition}: {mean}");
    }
    for (unit, definition, si) in [
        ("t", "t = 907.18474 kg", "kg"),
        ("psi", "psi = 7000 Pa", "Pa"),
        ("D", "D = 1 m^-1", "1/m"),
    ] {
        let error = read(&defined(&format!("|{unit}"), &[(definition, unit)]), si).unwrap_err();
        assert!(error.contains(definition) && error.contains("in two ways"), "{error}");
    }
}

/// A quantity may stand in another one, as an influence on it.
#[test]
fn the_id_of_a_quantity_is_its_own() {
    let inner = |id: &str| {
        let value = real("3", r"\volt", &expanded(U));
        format!(
            "<dcc:measurementMetaData><dcc:metaData><dcc:data><dcc:quantity id=\"{id}\">{value}\
             </dcc:quantity></dcc:data></dcc:metaData></dcc:measurementMetaData>"
        )
    };
    let both = format!(
        "<dcc:quantity id=\"a\"><si:real id=\"r\"><si:value>10</si:value><si:unit>\\volt</si:unit>{}\
         </si:real>{}</dcc:quantity>",
        expanded(U),
        inner("b")
    );
    for (id, value) in [("a", 10.0), ("b", 3.0), ("r", 10.0)] {
        let file = model(&certificate("3.2.1", &both), &format!(r#""id": "{id}""#), "").unwrap();
        near(known(&file, 0), [value, 0.5]);
    }
}

/// Spaces that do not break are no blanks of XML, and a single value is one word.
#[test]
fn numbers_are_words() {
    let list = |values: &str| {
        let u = "<si:expandedUncXMLList><si:uncertaintyXMLList>1</si:uncertaintyXMLList>\
                 <si:coverageFactorXMLList>2</si:coverageFactorXMLList></si:expandedUncXMLList>";
        quantity(&format!(
            "<si:realListXMLList><si:valueXMLList>{values}</si:valueXMLList>\
             <si:unitXMLList>\\volt</si:unitXMLList>{u}</si:realListXMLList>"
        ))
    };
    near(known(&accepted(&list("1\n\t2 \r3"), r#", "index": 1"#), 0), [2.0, 0.5]);
    for number in ["1\u{a0}000 2", "1\u{202f}000 2"] {
        let error = refused(&list(number), r#", "index": 1"#);
        assert!(error.contains("in `valueXMLList` is not a finite number"), "{error}");
    }
    let error = refused(&quantity(&real("1 000", r"\volt", &expanded(U))), r#", "index": 0"#);
    assert!(error.contains("`value` is `1 000`, which is more than one word"), "{error}");
    let error = refused(&quantity(&real("1\u{a0}000", r"\volt", &expanded(U))), "");
    assert!(error.contains("in `value` is not a finite number"), "{error}");
}

#[test]
fn lists_stand_in_each_other_to_a_depth() {
    let value = real("10", r"\volt", &expanded(U));
    for name in ["list", "hybrid"] {
        let nested = |depth: usize| {
            let [open, close] = ["<", "</"].map(|mark| format!("{mark}si:{name}>").repeat(depth));
            quantity(&format!("{open}{value}{close}"))
        };
        near(known(&accepted(&nested(60), ""), 0), [10.0, 0.5]);
        let error = refused(&nested(100), "");
        assert!(error.contains("in each other more than 64 deep"), "{error}");
        let error = refused(&nested(5000), "");
        assert!(error.contains("257 nested elements here"), "{error}");
    }
}

#[test]
fn a_byte_order_mark_is_no_text() {
    let xml = certificate("3.2.1", REAL);
    let marked = format!("\u{feff}{xml}");
    near(known(&model(&marked, r#""id": "v""#, "").unwrap(), 0), [5.0112, 0.0023]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.xml");
    std::fs::write(&path, marked).unwrap();
    assert_eq!(crate::carried_models(&path).unwrap().len(), 1);
}

/// D-SI 2.1: lists of reals with one unit and one uncertainty for all of them.
#[test]
fn lists_of_reals() {
    let list =
        |of_each: &str, inside: &str| format!("<si:realList>{of_each}{inside}</si:realList>");
    let bare =
        |value: &str, more: &str| format!("<si:real><si:value>{value}</si:value>{more}</si:real>");
    let unit = "<si:listUnit>\\volt</si:listUnit>";
    let shared = format!("<si:listUnivariateUnc>{}</si:listUnivariateUnc>", expanded(U));
    let own = expanded(["3", "3", "0.9973", "normal"]);
    let of_each = format!("{unit}{shared}");
    let inside = bare("1", "") + &bare("2", "") + &bare("3", &own);
    for outer in ["list", "hybrid"] {
        let text = quantity(&format!("<si:{outer}>{}</si:{outer}>", list(&of_each, &inside)));
        // U/k = 1/2 of the list, and 3/3 of the value's own
        for (index, expected) in [[1.0, 0.5], [2.0, 0.5], [3.0, 1.0]].into_iter().enumerate() {
            near(known(&accepted(&text, &format!(r#", "index": {index}"#)), 0), expected);
        }
    }
    let reals = real("1", r"\volt", &expanded(U)) + &real("2", r"\volt", &expanded(U));
    let text = quantity(&format!("<si:list>{}</si:list>", list("", &reals)));
    near(known(&accepted(&text, r#", "index": 1"#), 0), [2.0, 0.5]);
    let millis = real("1", r"\milli\volt", "");
    let error = refused(&quantity(&format!("<si:list>{}</si:list>", list(&of_each, &millis))), "");
    assert!(error.contains("the values of a list have different units"), "{error}");
    let error = refused(&quantity(&format!("<si:list>{}</si:list>", list("", &bare("1", "")))), "");
    assert!(error.contains("this has no unit"), "{error}");
    let region = format!("{}<si:ellipsoidalRegion/>", bare("1", ""));
    let error = refused(&quantity(&format!("<si:list>{}</si:list>", list(unit, &region))), "");
    assert!(error.contains("stated as `ellipsoidalRegion` here"), "{error}");
}

/// Parts of a hybrid in units that nobody knows are passed by, wherever they stand.
#[test]
fn unknown_units_of_a_hybrid() {
    let known_part = real("20", r"\volt", &expanded(U));
    for unit in ["|foo", r"\furlong", "|foot pound"] {
        let unknown = real("68", unit, &expanded(U));
        for parts in [[&known_part, &unknown], [&unknown, &known_part]] {
            let parts = format!("<si:hybrid>{}{}</si:hybrid>", parts[0], parts[1]);
            near(known(&accepted(&quantity(&parts), ""), 0), [20.0, 0.5]);
        }
        let alone = quantity(&format!("<si:hybrid>{unknown}</si:hybrid>"));
        assert!(!refused(&alone, "").is_empty());
    }
    let damaged = real("2o", r"\milli\volt", &expanded(U));
    for parts in [[&known_part, &damaged], [&damaged, &known_part]] {
        let parts = format!("<si:hybrid>{}{}</si:hybrid>", parts[0], parts[1]);
        assert!(refused(&quantity(&parts), "").contains("`2o` in `value`"));
    }
}
