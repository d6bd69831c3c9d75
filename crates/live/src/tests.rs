//! The calls as the page makes them.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_engine::model::typed::Catalogue;
use serde_json::{Value, json};

use crate::{HeldFiles, Live, LiveError};

const POWER: &str = include_str!("../../../models/examples/power.json");

fn catalogue() -> &'static Catalogue {
    gumption_measurements::catalogue()
}

fn try_call(name: &str, request: &Value, files: &HeldFiles) -> Result<Value, LiveError> {
    let live = Live::new(catalogue(), [("power", POWER)]);
    let answer = live.call(name, &request.to_string(), files, &Arc::default())?;
    Ok(serde_json::from_str(&answer).unwrap())
}

fn call(name: &str, request: &Value) -> Value {
    try_call(name, request, &HeldFiles::default()).unwrap()
}

fn answer(text: &str) -> Value {
    call("answer", &json!({"text": text, "trials": 100_000}))
}

/// The page says what the command line says: its result is that of `gumption run` for this file
/// (`tests/pages` holds that page), at fewer trials with the GUM's figures unchanged.
#[test]
fn the_budget_of_a_resistor() {
    let found = answer(POWER);
    assert_eq!(found["diagnostics"], json!([]));
    let result = &found["results"][0];
    let gum = &result["gum"];
    // 5.01^2/99.95 W; u from 10 mV and the scatter of four readings by hand
    let power = 5.01_f64 * 5.01 / 99.95 * 1000.0;
    assert!((gum["estimate"].as_f64().unwrap() - power).abs() < 1e-9);
    let u_voltage = 2.0_f64 * 5.01 / 99.95 * 0.01 * 1000.0;
    let u_resistance = power / 99.95 * (0.05_f64 / 3.0).sqrt() / 2.0;
    let u = u_voltage.hypot(u_resistance);
    assert!((gum["standard_uncertainty"].as_f64().unwrap() - u).abs() < 1e-9, "{gum}");
    assert_eq!(result["statement"]["kind"], "expanded");
    assert_eq!(result["unit"], "mW");
    let budget = result["html"]["budget"].as_str().unwrap();
    assert!(budget.contains("<th scope=\"row\">voltage</th>"), "{budget}");
    let figure = result["html"]["distribution"].as_str().unwrap();
    assert!(figure.contains("<svg") && figure.contains("role=\"img\""), "{figure}");
    assert_eq!((&found["trials"], &found["whole"]), (&json!(100_000), &json!(false)));
}

#[test]
fn the_full_answer_is_that_of_the_file() {
    let small = POWER.replacen('{', "{\"monte_carlo\": {\"trials\": 20000, \"seed\": 3},", 1);
    let found = call("answer", &json!({"text": small, "full": true}));
    assert_eq!((&found["trials"], &found["whole"]), (&json!(20_000), &json!(true)));
    assert_eq!(found["seed"], 3);
    // no more than the page makes, whatever a file asks for
    let huge = POWER.replacen('{', "{\"monte_carlo\": {\"trials\": 1000000000000},", 1);
    let found = answer(&huge);
    assert_eq!((&found["trials"], &found["whole"]), (&json!(100_000), &json!(false)));
}

#[test]
fn cells_have_their_paths_and_are_as_written() {
    let found = answer(&POWER.replace("5.01,", "5.010,"));
    let row = &found["inputs"][0];
    assert_eq!((&row["name"], &row["type"]), (&json!("voltage"), &json!("B")));
    let mean = row["cells"].as_array().unwrap().iter().find(|cell| cell["key"] == "mean").unwrap();
    assert_eq!(mean["raw"], "5.010");
    assert_eq!(mean["path"], json!(["inputs", "voltage", "mean"]));
    assert!(row["picture"].as_str().unwrap().starts_with("<svg"));
    assert_eq!(found["equations"][0]["formula"], "voltage^2/resistance");
    assert_eq!(found["inputs"][1]["cells"][2]["kind"], "list");
}

/// Places are counted as scripts count: in UTF-16 units, within the file and within the formula.
#[test]
fn mistakes_have_their_places() {
    let text = "\u{feff}{\"title\": \"𝛼ß\", \"inputs\": {}, \"equations\": {\"y\": \"2 + Ω*x\"},\n \"outputs\": {\"y\": {\"unit\": \"1\"}}}";
    let found = answer(text);
    let all = found["diagnostics"].as_array().unwrap();
    let of = |name: &str| {
        let quoted = format!("`{name}`");
        all.iter().find(|one| one["message"].as_str().unwrap().contains(&quoted)).unwrap()
    };
    let units: Vec<u16> = text.encode_utf16().collect();
    for (name, within) in [("Ω", [4, 5]), ("x", [6, 7])] {
        let one = of(name);
        let [start, end] = ["start", "end"].map(|key| one[key].as_u64().unwrap() as usize);
        assert_eq!(String::from_utf16(&units[start..end]).unwrap(), name, "{one}");
        assert_eq!(one["within"], json!(within));
        assert_eq!(one["path"], json!(["equations", "y"]));
        assert_eq!(one["line"], 1);
    }
    assert_eq!(found["missing"], json!(["Ω", "x"]));
    assert_eq!(found.get("results"), None);
}

/// A page shows one output at a time, and need not wait for the figures of all others.
#[test]
fn the_parts_of_one_output_alone() {
    let text =
        POWER.replace("\"power\": {\"unit\"", "\"twice\": {\"unit\": \"W\"}, \"power\": {\"unit\"");
    let text = text.replace("/resistance\"}", "/resistance\", \"twice\": \"2*power\"}");
    for (asked, whole) in [(1, 1), (7, 0)] {
        let found = call("answer", &json!({"text": text, "trials": 1000, "output": asked}));
        for (place, result) in found["results"].as_array().unwrap().iter().enumerate() {
            let budget = result["html"]["budget"].as_str().unwrap();
            assert_eq!(!budget.is_empty(), place == whole, "{result}");
            assert!(result["statement"]["estimate"].is_string(), "{result}");
        }
        assert_eq!(found["results"].as_array().unwrap().len(), 2);
    }
}

#[test]
fn an_unfinished_text_has_a_mistake_and_nothing_else() {
    let found = answer("{\"inputs\": {\"a\": ");
    assert_eq!(found["kind"], "model");
    assert_eq!(found["diagnostics"].as_array().unwrap().len(), 1);
    assert_eq!(answer("")["kind"], "other");
}

/// What a file says is text, wherever it stands, and no part of a page has a style or a script of its
/// own, which the page's policy forbids.
#[test]
fn a_file_is_never_markup() {
    let evil = "<img src=x onerror=alert(1)>\\\" onload=\\\"x";
    let text = format!(
        "{{\"title\": \"{evil}\", \"inputs\": {{\"a\": {{\"unit\": \"m\", \"distribution\": \"normal\", \
         \"mean\": 1, \"std\": 0.1, \"about\": \"{evil}\", \"group\": \"{evil}\"}}}}, \
         \"equations\": {{\"y\": \"a*a\"}}, \"outputs\": {{\"y\": {{\"unit\": \"m^2\", \"about\": \"{evil}\"}}}}}}"
    );
    let found = answer(&text);
    assert_eq!(found["diagnostics"], json!([]), "{found}");
    let audit = call("audit", &json!({"text": text}));
    let parts = found["results"][0]["html"].as_object().unwrap().values();
    let parts = parts.chain([&found["together"], &found["inputs"][0]["picture"], &audit["html"]]);
    for part in parts {
        let html = part.as_str().unwrap();
        assert!(!html.contains("<img") && !html.contains("<script"), "{html}");
        assert!(!html.contains(" style=\""), "{html}");
        let mut rest = html;
        while let Some((_, tag)) = rest.split_once('<') {
            let (tag, behind) = tag.split_once('>').unwrap();
            // attributes are quoted, so that what stands outside of quotes is the markup's own
            let own: String = tag.split('"').step_by(2).collect();
            assert!(!own.contains("onload") && !own.contains("onerror"), "{tag}");
            rest = behind;
        }
    }
}

#[test]
fn files_come_from_the_folder_alone() {
    let text = "{\"inputs\": {\"a\": {\"unit\": \"m\", \"distribution\": \"samples\", \"file\": \"s.csv\"}}, \
                \"equations\": {\"y\": \"2*a\"}, \"outputs\": {\"y\": {\"unit\": \"m\"}}}";
    let mistake = answer(text)["diagnostics"][0]["message"].as_str().unwrap().to_owned();
    assert!(mistake.contains("drop it onto the page"), "{mistake}");
    let held = HeldFiles(vec![("s.csv".to_owned(), b"1\n2\n3\n".to_vec())]);
    let found = try_call("answer", &json!({"text": text}), &held).unwrap();
    assert_eq!(found["results"][0]["gum"]["estimate"], json!(4.0), "{found}");
}

#[test]
fn a_sweep_has_its_tables_together() {
    let text = POWER.replace(
        "\"equations\"",
        "\"conditions\": {\"f\": {\"unit\": \"1\", \"values\": [1, 2]}}, \"equations\"",
    );
    let found = answer(&text);
    assert_eq!(found["rows"], 2, "{found}");
    assert!(found["together"].as_str().unwrap().contains("<table>"));
    assert_eq!(found["conditions"]["count"], 2);
}

/// A row of a sweep has the headline, the budget and the distribution that it has alone.
#[test]
fn a_row_of_a_sweep_is_shown_as_if_it_stood_alone() {
    let swept = |conditions: &str| {
        format!(
            r#"{{"conditions": {{"f": {{"unit": "Hz", "values": {conditions}}}}},
                "inputs": {{"a": {{"unit": "m", "distribution": "normal", "mean": 2, "std": 0.1}}}},
                "equations": {{"v": "a*f"}}, "outputs": {{"v": {{"unit": "m/s"}}}}}}"#
        )
    };
    let asked = |text: &str, row: usize| {
        call("answer", &json!({"text": text, "trials": 100_000, "row": row}))
    };
    let (all, alone) = (swept("[10, 20, 30]"), swept("[20]"));
    let found = asked(&all, 1);
    assert_eq!(found["row_names"], json!(["f = 10 Hz", "f = 20 Hz", "f = 30 Hz"]));
    // y = a f: 40 m/s with u = 2 m/s, whatever the method
    let gum = &found["results"][0]["gum"];
    assert_eq!(
        (gum["estimate"].as_f64(), gum["standard_uncertainty"].as_f64()),
        (Some(40.0), Some(2.0))
    );
    let alone = asked(&alone, 0);
    assert_eq!(found["results"][0]["statement"], alone["results"][0]["statement"]);
    assert_eq!(found["results"][0]["html"]["budget"], alone["results"][0]["html"]["budget"]);
    let figure = found["results"][0]["html"]["distribution"].as_str().unwrap();
    assert!(figure.contains("<svg"), "{figure}");
    assert_eq!((&alone["row_names"], &asked(&all, 7)["row"]), (&json!([]), &json!(0)));
}

/// Errors of files that are no models stand at their places, and of a model that a certificate names
/// under its name.
#[test]
fn mistakes_of_certificates_recipes_cases_and_tables_have_places() {
    let places = |text: &str, files: &HeldFiles| {
        let found = try_call("answer", &json!({"text": text, "name": "c"}), files).unwrap();
        let all = found["diagnostics"].as_array().unwrap().clone();
        let marked = |of: &Value| {
            let [from, to] = ["start", "end"].map(|key| of[key].as_u64().unwrap() as usize);
            let units: Vec<u16> = text.encode_utf16().collect();
            (of["file"].as_str().map(str::to_owned), String::from_utf16_lossy(&units[from..to]))
        };
        all.iter().map(marked).collect::<Vec<_>>()
    };
    let none = HeldFiles::default();
    let marks = |found: &[(Option<String>, String)], wanted: &str| {
        assert!(found.iter().any(|(file, text)| file.is_none() && text == wanted), "{found:?}");
    };
    let certificate = include_str!("../../../models/examples/certificate.json");
    let model = include_str!("../../../models/examples/this_year.json");
    let named = |text: String| HeldFiles(vec![("this_year.json".to_owned(), text.into_bytes())]);
    let beside = named(model.to_owned());
    assert_eq!(places(certificate, &beside), []);
    marks(&places(certificate, &none), "\"this_year.json\"");
    marks(
        &places(&certificate.replace("\"output\": \"R\"", "\"output\": \"Q\""), &beside),
        "\"Q\"",
    );
    let found = places(certificate, &named(model.replacen("\"unit\"", "\"unti\"", 1)));
    assert!(found.iter().any(|(file, _)| file.as_deref() == Some("this_year.json")), "{found:?}");
    let recipe = r#"{"recordings": {"a": {"file": "a.csv", "sampling_rate": "-1 Hz"}}, "channels": {}, "rows": []}"#;
    marks(&places(recipe, &none), "\"-1 Hz\"");
    let case = POWER.replacen('{', "{\"observations\": 3,", 1);
    marks(&places(&case, &none), "3");
    let table = "label,x1,U1,x2,U2\na,1,0.1,b,0.2\n";
    marks(&places(table, &none), "b");
}

/// A file that was dropped has a name without folders, also where a text names it in one.
#[test]
fn dropped_files_are_found_by_their_names() {
    let held = HeldFiles(vec![("f.csv".to_owned(), b"f\n1\n".to_vec())]);
    let text = r#"{"conditions": {"file": "tables/f.csv"}}"#;
    let found = held.named_in(text);
    assert_eq!(found.0.len(), 2);
    assert_eq!(found.0[1], ("tables/f.csv".to_owned(), b"f\n1\n".to_vec()));
    assert_eq!(held.named_in("{\"file\": \"pdf.csv\"}").0.len(), 1);
}

#[test]
fn a_shape_keeps_the_numbers_that_were_typed() {
    let reshaped = |input: &str, shape: &str| {
        let text = format!("{{\"inputs\": {{\"a\": {input}}}}}");
        let asked = json!({"text": text, "path": ["inputs", "a"], "way": shape});
        let made = call("reshape", &asked)["text"].as_str().unwrap().to_owned();
        let inner = made.strip_prefix("{\"inputs\": {\"a\": ").unwrap();
        inner.strip_suffix("}}").unwrap().to_owned()
    };
    let normal = "{\"unit\": \"m\", \"distribution\": \"normal\", \"mean\": 5.010, \"std\": 1e-3}";
    assert_eq!(
        reshaped(normal, "rectangular"),
        "{\"unit\": \"m\", \"distribution\": \"rectangular\", \"mean\": 5.010, \"half_width\": 1e-3}"
    );
    assert_eq!(
        reshaped(normal, "split-normal"),
        "{\"unit\": \"m\", \"distribution\": \"split-normal\", \"mode\": 5.010, \"std_low\": 1e-3, \"std_high\": 0.001}"
    );
    let limits = "{\"distribution\": \"rectangular\", \"lower\": 1, \"upper\": 2}";
    assert_eq!(
        reshaped(limits, "triangular"),
        "{\"distribution\": \"triangular\", \"lower\": 1, \"upper\": 2}"
    );
    assert_eq!(
        reshaped(limits, "normal"),
        "{\"distribution\": \"normal\", \"mean\": 1.5, \"std\": 0.5}"
    );
    let expanded = "{\"distribution\": \"normal\", \"mean\": 1, \"expanded\": 0.2, \"k\": 2}";
    assert_eq!(
        reshaped(expanded, "arcsine"),
        "{\"distribution\": \"arcsine\", \"mean\": 1, \"half_width\": 0.2}"
    );
    assert_eq!(
        reshaped(normal, "readings"),
        "{\"unit\": \"m\", \"distribution\": \"readings\", \"values\": []}"
    );
    // the resolution of readings is a width, and that of others the value of a count
    let summary =
        "{\"distribution\": \"readings\", \"mean\": 5, \"s\": 0.1, \"n\": 9, \"resolution\": 0.1}";
    assert_eq!(
        reshaped(summary, "normal"),
        "{\"distribution\": \"normal\", \"mean\": 5, \"std\": null}"
    );
}

fn edited(input: &str, key: &str, typed: &str) -> String {
    let text = format!("{{\"inputs\": {{\"a\": {input}}}}}");
    let edit = json!({"path": ["inputs", "a", key], "typed": typed});
    let made =
        call("edit", &json!({"text": text, "edits": [edit]}))["text"].as_str().unwrap().to_owned();
    let inner = made.strip_prefix("{\"inputs\": {\"a\": ").unwrap();
    inner.strip_suffix("}}").unwrap().to_owned()
}

/// A quantity typed into any field of an input fills all of them; a unit that is decided already is
/// not replaced by one that goes with a value alone.
#[test]
fn a_typed_quantity_fills_the_fields_of_its_input() {
    let new = "{\"distribution\": \"normal\", \"mean\": null, \"std\": null}";
    let whole =
        "{\"distribution\": \"normal\", \"mean\": 5.0112, \"std\": 0.0023, \"unit\": \"V\"}";
    for key in ["mean", "std", "unit"] {
        assert_eq!(edited(new, key, "5.0112(23) V"), whole, "{key}");
    }
    let with_unit =
        "{\"distribution\": \"normal\", \"mean\": 100, \"std\": null, \"unit\": \"ohm\"}";
    assert_eq!(edited(new, "mean", "100 ohm"), with_unit);
    let volts =
        "{\"unit\": \"mV\", \"distribution\": \"rectangular\", \"mean\": 1, \"half_width\": 0.1}";
    assert_eq!(edited(volts, "mean", "5 V"), volts.replace("\"mean\": 1", "\"mean\": \"5 V\""));
    assert_eq!(
        edited(volts, "mean", "5.00 V ± 0.1 %"),
        volts.replace("\"mean\": 1", "\"mean\": \"5.00 V\"").replace("0.1}", "\"0.1 %\"}")
    );
    let made = edited(volts, "half_width", "5.02 V ± 0.04 V (k=2)");
    let keys =
        ["\"distribution\": \"normal\"", "\"expanded\": 0.04", "\"k\": 2", "\"unit\": \"V\""];
    assert!(keys.iter().all(|key| made.contains(key)) && !made.contains("half_width"), "{made}");
    // what is no quantity stays as it is typed
    assert_eq!(edited(new, "mean", "5 q"), new.replacen("null", "\"5 q\"", 1));
    assert_eq!(edited(new, "mean", "f + 1"), new.replacen("null", "\"f + 1\"", 1));
}

/// Changing the way in which an input is known there and back gives what was typed.
#[test]
fn a_way_keeps_what_was_typed() {
    let reshaped = |input: &str, way: &str, kept: &Value| {
        let text = format!("{{\"inputs\": {{\"a\": {input}}}}}");
        let asked = json!({"text": text, "path": ["inputs", "a"], "way": way, "kept": kept});
        let made = call("reshape", &asked)["text"].as_str().unwrap().to_owned();
        let inner = made.strip_prefix("{\"inputs\": {\"a\": ").unwrap().to_owned();
        inner.strip_suffix("}}").unwrap().to_owned()
    };
    let standard = "{\"unit\": \"V\", \"distribution\": \"normal\", \"mean\": 100, \"std\": 0.05}";
    let readings = reshaped(standard, "readings", &json!({}));
    assert_eq!(readings, "{\"unit\": \"V\", \"distribution\": \"readings\", \"values\": []}");
    let kept = json!({"mean": "100", "std": "0.05"});
    assert_eq!(
        reshaped(&readings, "limits", &kept),
        "{\"unit\": \"V\", \"distribution\": \"rectangular\", \"mean\": 100, \"half_width\": 0.05}"
    );
    assert_eq!(
        reshaped(standard, "expanded", &kept),
        "{\"unit\": \"V\", \"distribution\": \"normal\", \"mean\": 100, \"expanded\": 0.05, \"k\": 2}"
    );
    let expanded = "{\"distribution\": \"normal\", \"mean\": 100, \"expanded\": 0.05, \"k\": 2}";
    assert_eq!(
        reshaped(expanded, "standard", &json!({})),
        "{\"distribution\": \"normal\", \"mean\": 100, \"std\": 0.05}"
    );
    assert_eq!(
        reshaped(expanded, "bounds", &json!({})),
        "{\"distribution\": \"rectangular\", \"lower\": 99.95, \"upper\": 100.05}"
    );
    // what ± means is decided by the way
    let open = "{\"distribution\": \"normal\", \"mean\": \"100 ohm ± 0.1 %\", \"std\": null}";
    assert_eq!(
        reshaped(open, "limits", &json!({})),
        "{\"distribution\": \"rectangular\", \"mean\": 100, \"half_width\": \"0.1 %\", \"unit\": \"ohm\"}"
    );
}

/// A model that is being written lacks things, which is no error; a wrong name is one.
#[test]
fn what_is_still_open_is_no_error() {
    let open = |text: &str| {
        let found = answer(text);
        let errors =
            found["diagnostics"].as_array().unwrap().iter().filter(|of| of["open"] != true);
        (errors.count(), found["open"].clone(), found["missing"].clone())
    };
    let (errors, points, _) = open(r#"{"inputs": {}, "equations": {}, "outputs": {}}"#);
    assert_eq!((errors, points), (0, json!([{"path": ["equations"]}, {"path": ["outputs"]}])));
    let (errors, _, missing) =
        open(r#"{"inputs": {}, "equations": {"P": "V^2/R"}, "outputs": {}}"#);
    assert_eq!((errors, missing), (0, json!(["V", "R"])));
    let begun = r#"{"inputs": {"V": {"distribution": "normal", "mean": null, "std": 1},
        "R": {"unit": "ohm", "distribution": "normal", "mean": 100, "std": 1}},
        "equations": {"P": "V^2/R"}, "outputs": {"P": {"unit": "mW"}}}"#;
    let (errors, points, _) = open(begun);
    assert_eq!(errors, 0);
    assert_eq!(points[0], json!({"path": ["inputs", "V", "mean"]}));
    // a unit that is not chosen yet, of an input and of the result
    let (errors, points, _) = open(&begun.replace("null", "5"));
    assert_eq!((errors, points), (0, json!([{"path": ["inputs", "V", "unit"]}])));
    let whole = begun.replace("null", "5").replace("\"V\": {", "\"V\": {\"unit\": \"V\", ");
    let (errors, points, _) = open(&whole.replace("\"unit\": \"mW\"", ""));
    let unit = json!([{"path": ["outputs", "P", "unit"], "suggestion": "W"}]);
    assert_eq!((errors, points), (0, unit));
    assert_eq!(open(&whole).0, 0);
    assert_eq!(open(&whole.replace("mW", "mm")).0, 1);
    assert_eq!(open(&whole.replace("V^2/R", "V^2/Rr")).0, 1);
}

/// The columns of a table, the outputs of a saved result and the quantities of a certificate.
#[test]
fn a_file_that_an_input_can_name_says_what_it_holds() {
    let table = b"t [s];V [V]\n1;5,01\n2;5,02\n".to_vec();
    let files = HeldFiles(vec![("day.csv".to_owned(), table), ("no.csv".to_owned(), Vec::new())]);
    let found = try_call("contents", &json!({"file": "day.csv"}), &files).unwrap();
    assert_eq!(found, json!({"columns": ["t [s]", "V [V]"]}));
    for file in ["no.csv", "none.csv"] {
        let LiveError::Request(why) =
            try_call("contents", &json!({"file": file}), &files).unwrap_err()
        else {
            panic!("another error");
        };
        assert!(why.starts_with(&format!("`{file}`: ")), "{why}");
    }
}

/// Every distribution that files may name has keys to begin with, and a new input of it, filled in,
/// is one that can be read.
#[test]
fn every_distribution_can_be_begun() {
    for shape in gumption_files::schema::distributions() {
        let way = crate::ways::way(shape.name).unwrap();
        assert!(!way.needed.is_empty(), "{}", shape.name);
        for (key, _) in way.needed {
            assert!(shape.keys.contains(key), "{}: {key}", shape.name);
        }
    }
    let start = "{\"format\": 1, \"inputs\": {\"a\": {\"unit\": \"1\", \"distribution\": \"normal\", \
                 \"mean\": 5, \"std\": 0.1}}, \"equations\": {\"y\": \"a\"}, \"outputs\": {\"y\": {\"unit\": \"1\"}}}";
    for shape in gumption_files::schema::distributions() {
        if ["readings", "samples", "quantiles", "dcc", "result", "codata"].contains(&shape.name) {
            continue; // these need what nobody can guess
        }
        let asked = json!({"text": start, "path": ["inputs", "a"], "way": shape.name});
        let made = call("reshape", &asked)["text"].as_str().unwrap().to_owned();
        assert_eq!(answer(&made)["diagnostics"], json!([]), "{made}");
    }
}

#[test]
fn there_is_something_starting_points() {
    let list = call("examples", &json!({}));
    assert_eq!(list["large"][0]["title"], "Power in a resistor");
    // fields without entries are left out
    let entry = json!({
        "kind": "example", "name": "power", "title": "Power in a resistor", "source": null
    });
    assert_eq!(list["fields"], json!([{"field": "electricity", "entries": [entry]}]));
    assert_eq!(call("new", &json!({"example": "power"}))["text"], POWER);
    let wrong = try_call("new", &json!({"example": "powr"}), &HeldFiles::default()).unwrap_err();
    assert_eq!(wrong.to_string(), "there is no example `powr`; did you mean `power`?");
    let empty = call("new", &json!({}));
    assert!(empty["text"].as_str().unwrap().contains("\"inputs\": {}"));
    assert_eq!(call("kinds", &json!({}))["ways"][0]["needed"], json!(["mean", "std"]));
}

fn imported(name: &str, text: &str, options: &Value) -> Value {
    let base64 = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, text);
    call("import", &json!({"name": name, "base64": base64, "options": options}))
}

#[test]
fn a_budget_of_a_spreadsheet() {
    let csv = "R = U/I\nQuantity,Estimate,Unit,Standard uncertainty\nU,5.0,V,0.01\nI,0.1,A,0.001\n";
    let made = imported("../x/budget.csv", csv, &json!({}));
    assert!(made["text"].as_str().unwrap().contains("\"U\""), "{made}");
    assert_eq!(made["sheet"]["heading"], 2);
    assert_eq!(made["sheet"]["columns"][3]["name"], "standard-uncertainty");
    assert_eq!(made["sheet"]["rows"][2], json!(["U", "5.0", "V", "0.01"]));
    let wrong = imported("a.xlsx", "PK", &json!({}));
    assert_eq!((&wrong["sheet"], &wrong["mistakes"][0]["row"]), (&Value::Null, &Value::Null));
}

/// A question comes with its rows and with what answers it, and an answer is an option.
#[test]
fn questions_of_a_spreadsheet() {
    let tsv = "Quantity\tEstimate\tUnit\tU; expanded\na\t5,0\tV\t0,01\n";
    let asked = imported("pasted.tsv", tsv, &json!({"columns": [["U", "#4"]]}));
    let question = &asked["questions"][0];
    assert_eq!(question["rows"], json!([2, 2]), "{asked}");
    assert_eq!(question["controls"][0], json!({"option": "k", "name": null, "value": "2"}));
    assert_eq!(asked["sheet"]["columns"][3], json!({"name": "U", "has_unit": true}));
    let said = json!({"columns": [["U", "#4"]], "k": 2.0, "coefficients": "one"});
    let made = imported("pasted.tsv", tsv, &said);
    assert!(made["text"].as_str().unwrap().contains("\"expanded\""), "{made}");
    // what the page could not say is told as a mistake of its row
    let wrong = imported("pasted.tsv", tsv, &json!({"columns": [["no", "#4"]]}));
    assert_eq!(wrong["questions"], json!([]));
    assert_eq!(wrong["mistakes"][0]["row"], 1, "{wrong}");
}

#[test]
fn calls_that_do_not_go() {
    let none = HeldFiles::default();
    assert_eq!(try_call("nothing", &json!({}), &none), Err(LiveError::Unknown("nothing".into())));
    assert!(matches!(try_call("answer", &json!({}), &none), Err(LiveError::Request(_))));
    let large = json!({"text": " ".repeat(5_000_001)});
    assert!(matches!(try_call("answer", &large, &none), Err(LiveError::Request(_))));
}

#[test]
fn a_call_is_stopped_by_its_flag() {
    let live = Live::new(catalogue(), []);
    let stop = Arc::new(AtomicBool::new(true));
    let request = json!({"text": POWER, "full": true}).to_string();
    let answer = live.call("answer", &request, &HeldFiles::default(), &stop).unwrap();
    let answer: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(answer["stopped"], true);
}

/// A change and what follows from it are one call: the text as `edit` makes it, its answer as without.
#[test]
fn a_change_and_its_answer_are_one_call() {
    let edits = json!([{"path": ["inputs", "voltage", "mean"], "typed": "5.02"}]);
    let both = call("answer", &json!({"text": POWER, "edits": edits, "trials": 10_000}));
    let text = call("edit", &json!({"text": POWER, "edits": edits}))["text"].clone();
    assert_eq!(both["text"], text);
    let alone = call("answer", &json!({"text": text, "trials": 10_000}));
    assert_eq!(both["results"], alone["results"]);
    assert_eq!(alone["text"], Value::Null);
    let wrong = json!({"text": POWER, "edits": [{"path": ["no", "such"], "remove": true}]});
    assert!(try_call("answer", &wrong, &HeldFiles::default()).is_err());
}

/// The form of a certificate learns what the models of its rows hold, and what is still missing is no
/// error.
#[test]
fn a_certificate_tells_what_its_models_hold() {
    let held = HeldFiles(vec![("power.json".to_owned(), POWER.as_bytes().to_vec())]);
    let of = |text: &str| try_call("answer", &json!({ "text": text }), &held).unwrap();
    let empty = call("new", &json!({ "kind": "certificate" }));
    let found = of(empty["text"].as_str().unwrap());
    assert_eq!(
        [&found["kind"], &found["diagnostics"], &found["lacking"]],
        [&json!("certificate"), &json!([]), &json!([["rows"]])]
    );
    let found = of(
        r#"{"device": {}, "rows": [{"model": "power.json", "output": "q"}, {"model": "no.json", "output": "q"}]}"#,
    );
    assert_eq!(found["lacking"], json!([["device", "name"]]));
    assert_eq!(found["diagnostics"].as_array().unwrap().len(), 2, "{found}");
    let power = &found["models"]["power.json"];
    assert_eq!(
        power["outputs"],
        json!([{"name": "power", "unit": "mW", "about": "", "tolerance": false}])
    );
    assert_eq!(power["inputs"][1]["readings"], json!(true));
    assert_eq!([&power["sweep"], &power["rows"]], [&json!(false), &json!(1)]);
    let missing = found["models"]["no.json"]["error"].as_str().unwrap();
    assert!(missing.contains("it is not there"), "{missing}");
    let contents = try_call("model", &json!({ "model": "power.json" }), &held).unwrap();
    assert_eq!(&contents, power);
}

#[test]
fn elements_of_a_list_change_places() {
    let text = "{\"rows\": [{\"a\": 1}, // first\n  {\"b\": 2.0}, 3]}";
    let edits = json!([{"path": ["rows", 1], "exchange": 0}]);
    let found = call("edit", &json!({ "text": text, "edits": edits }));
    assert_eq!(found["text"], "{\"rows\": [{\"b\": 2.0}, // first\n  {\"a\": 1}, 3]}");
    let edits = json!([{"path": ["rows", 1], "exchange": 9}]);
    let request = json!({ "text": text, "edits": edits });
    assert!(try_call("edit", &request, &HeldFiles::default()).is_err());
}

/// Every place of a value, as paths.
fn places(value: &Value, path: &mut Vec<Value>, found: &mut Vec<Vec<Value>>) {
    found.push(path.clone());
    let mut into = |step: Value, inner: &Value| {
        path.push(step);
        places(inner, path, found);
        path.pop();
    };
    match value {
        Value::Object(members) => members.iter().for_each(|(key, inner)| into(json!(key), inner)),
        Value::Array(elements) => {
            elements.iter().enumerate().for_each(|(at, inner)| into(json!(at), inner));
        }
        _ => {}
    }
}

/// Whatever stands at a place of a file, there is an answer: errors, or what the form shows.
#[test]
fn any_value_at_any_place_has_an_answer() {
    let certificate = r#"{"format": 1, "number": "1", "device": {"name": "d"}, "language": ["en"],
        "letterhead": {"logo": "l.png"}, "layout": {"columns": ["label", {"quantity": "power"}]},
        "rows": [{"model": "power.json", "output": "power", "set": {"voltage": 5}}]}"#;
    let case = r#"{"format": 1, "inputs": {"a": {"unit": "1", "distribution": "normal", "mean": 1, "std": 0.1}},
        "conditions": {"f": {"unit": "Hz"}}, "equations": {"y": "a + 0*f/f"}, "outputs": {"y": {"unit": "1"}},
        "observations": {"values": {"f": [1, 2], "y": [1, 2]}, "columns": {"y": {"value": "y"}}},
        "effects": {"e": {"parameters": {"d": {"unit": "1", "distribution": "normal", "mean": 0, "std": 1}},
        "overrides": {"y": "y + d"}}}, "catalogue": ["offset"]}"#;
    let files = HeldFiles(vec![("power.json".to_owned(), POWER.as_bytes().to_vec())]);
    for text in [POWER, certificate, case] {
        let root: Value = serde_json::from_str(text).unwrap();
        let mut all = Vec::new();
        places(&root, &mut Vec::new(), &mut all);
        for path in all.iter().filter(|path| !path.is_empty()) {
            for value in [
                json!(null),
                json!(true),
                json!(-1),
                json!("x ± 1"),
                json!([]),
                json!([{}]),
                json!({"a": {}}),
            ] {
                let edit = json!({"path": path, "value": value});
                let asked = json!({"text": text, "edits": [edit], "trials": 1000});
                let found = try_call("answer", &asked, &files);
                assert!(found.is_ok(), "{path:?} {value}: {found:?}");
            }
        }
    }
}
