//! The model file of a budget.

use serde_json::{Map, Value, json};

use super::rows::Row;
use super::widths::{HALF_WIDTHS, divisor_of, near};
use gumption_engine::decimal::to_15_digits;

/// What an input of the model file says of a row.
fn input(row: &Row) -> Value {
    let mut input = Map::new();
    if !row.unit.is_empty() {
        input.insert("unit".to_owned(), row.unit.as_str().into());
    }
    let mut put = |key: &str, value: Value| input.insert(key.to_owned(), value);
    let mean = row.estimate.unwrap_or(0.0);
    let uncertain = row.std.filter(|std| *std > 0.0).or(row.width.filter(|width| *width > 0.0));
    if uncertain.is_none() {
        put("distribution", "constant".into());
        put("value", json!(mean));
    } else if let (Some(width), divisor) = (row.width.filter(|width| *width > 0.0), row.divisor) {
        // a divisor of root 3, 6 or 2 stands for a shape where none is named
        let of_divisor = divisor.and_then(|divisor| {
            let shape = HALF_WIDTHS.iter().find(|(_, square)| near(divisor, square.sqrt()));
            shape.map(|(name, _)| *name)
        });
        let named = row.distribution.or(of_divisor).unwrap_or("normal");
        match divisor_of(named) {
            Some(usual) if divisor.is_none_or(|divisor| near(divisor, usual)) => {
                put("distribution", named.into());
                put("mean", json!(mean));
                put("half_width", json!(width));
            }
            _ => {
                put("distribution", "normal".into());
                put("mean", json!(mean));
                match divisor {
                    Some(_) if row.probability.is_some() => {
                        put("expanded", json!(width));
                        put("p", json!(row.probability));
                    }
                    Some(divisor) if divisor != 1.0 => {
                        put("expanded", json!(width));
                        put("k", json!(divisor));
                    }
                    _ => {
                        put("std", json!(width));
                    }
                }
            }
        }
    } else if let (Some(root), Some(std)) = (row.distribution.and_then(divisor_of), row.std) {
        // the half width that has this standard uncertainty
        put("distribution", json!(row.distribution));
        put("mean", json!(mean));
        put("half_width", json!(to_15_digits(std * root)));
    } else {
        put("distribution", "normal".into());
        put("mean", json!(mean));
        put("std", json!(row.std));
    }
    let shaped = input.get("distribution").and_then(Value::as_str).map(str::to_owned);
    if let Some(dof) = row.dof
        && matches!(shaped.as_deref(), Some("normal" | "rectangular" | "triangular"))
    {
        input.insert("dof".to_owned(), json!(dof));
    }
    if row.is_type_a {
        input.insert("type".to_owned(), "A".into());
    }
    if !row.about.is_empty() && row.about != row.name {
        input.insert("about".to_owned(), row.about.as_str().into());
    }
    Value::Object(input)
}

/// The model file as text, an input in each line; the last of the formulas is the result's.
pub(super) fn document(
    title: &str,
    rows: &[Row],
    formulas: &[(String, String)],
    unit: &str,
    checked: bool,
) -> String {
    let mut text = String::from("{\n");
    let mut line = |key: &str, value: &Value, last: bool| {
        text.push_str(&format!("  {}: {value}{}\n", json!(key), if last { "" } else { "," }));
    };
    line("format", &json!(2), false);
    line("title", &json!(title), false);
    if !checked {
        line("check_units", &json!(false), false);
    }
    text.push_str("  \"inputs\": {\n");
    for (place, row) in rows.iter().enumerate() {
        let comma = if place + 1 == rows.len() { "" } else { "," };
        text.push_str(&format!("    {}: {}{comma}\n", json!(row.name), input(row)));
    }
    text.push_str("  },\n");
    let output = if unit.is_empty() { json!({}) } else { json!({ "unit": unit }) };
    let equations = formulas.iter().map(|(name, formula)| (name.clone(), formula.as_str().into()));
    let equations: Map<String, Value> = equations.collect();
    let measurand = formulas.last().map(|(name, _)| name.clone()).unwrap_or_default();
    let outputs: Map<String, Value> = [(measurand, output)].into_iter().collect();
    text.push_str(&format!("  \"equations\": {},\n", Value::Object(equations)));
    text.push_str(&format!("  \"outputs\": {}\n}}\n", Value::Object(outputs)));
    text
}
