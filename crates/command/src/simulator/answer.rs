//! What a program writes: the outputs of all rows, `{"angle": [0.1, 0.2]}`.

use gumption_emulator::{RunResult, SimulatorCase};
use gumption_units::listed;
use serde_json::Value;

/// Bytes of a value with its indentation and separators, at most, in an answer that is not cut off.
const BYTES_OF_VALUE: usize = 64;

/// Bytes of an answer besides its values.
const OTHER_BYTES: usize = 64 * 1024;

/// The size of an answer at which a program is ended, in bytes.
pub(super) fn most_bytes(case: &SimulatorCase) -> usize {
    OTHER_BYTES + BYTES_OF_VALUE * case.rows * case.outputs.len()
}

/// The outputs in an answer, or what is wrong with it, as a sentence about `source`: "the standard output".
pub(super) fn outputs(bytes: &[u8], source: &str, case: &SimulatorCase) -> RunResult {
    let text = std::str::from_utf8(bytes).map_err(|_| format!("{source} is not UTF-8"))?;
    if text.trim().is_empty() {
        return Err(format!("{source} is empty"));
    }
    let parsed: Value = serde_json::from_str(text).map_err(|error| {
        not_finite(text, &error).unwrap_or_else(|| format!("{source} is not JSON: {error}"))
    })?;
    let Value::Object(columns) = parsed else {
        return Err(format!("{source} is not an object {}", form(case)));
    };
    let names = case.output_names();
    if let Some(unknown) = columns.keys().find(|name| !names.contains(name)) {
        return Err(format!(
            "{source} has `{unknown}`, but the case has only {}",
            listed(&names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>(), " and ")
        ));
    }
    let mut outputs = Vec::with_capacity(names.len() * case.rows);
    for name in &names {
        let column = columns.get(name).ok_or_else(|| format!("{source} has no `{name}`"))?;
        let Value::Array(column) = column else {
            return Err(format!("`{name}` is not a list of numbers"));
        };
        if column.len() != case.rows {
            return Err(length(name, column.len(), case.rows));
        }
        for (row, value) in column.iter().enumerate() {
            outputs
                .push(value.as_f64().ok_or_else(|| no_number(name, row + 1, &value.to_string()))?);
        }
    }
    Ok(outputs)
}

/// The message that an output has a wrong number of rows.
pub(super) fn length(name: &str, found: usize, rows: usize) -> String {
    format!("`{name}` has {found} values, but the data have {rows} rows")
}

/// The message that a value, whose row counts from 1, is no finite number.
pub(super) fn no_number(name: &str, row: usize, value: &str) -> String {
    let cut = value.char_indices().nth(40).map_or(value.len(), |(place, _)| place);
    format!("value {row} of `{name}` is {}, but must be a finite number", &value[..cut])
}

/// The form of an answer.
fn form(case: &SimulatorCase) -> String {
    let columns = case.outputs.iter().map(|output| format!("\"{}\": [...]", output.name));
    format!("{{{}}}", columns.collect::<Vec<String>>().join(", "))
}

/// The message about `NaN` or `Infinity`, which many programs write though JSON has neither.
fn not_finite(text: &str, error: &serde_json::Error) -> Option<String> {
    let line_start: usize =
        text.split_inclusive('\n').take(error.line().checked_sub(1)?).map(str::len).sum();
    let (before, after) = text.split_at_checked(line_start + error.column().checked_sub(1)?)?;
    let is_of_word = |c: char| c.is_ascii_alphabetic() || matches!(c, '-' | '+');
    let start = before.trim_end_matches(is_of_word).len();
    let end = before.len() + after.len() - after.trim_start_matches(is_of_word).len();
    let word = &text[start..end];
    let is_known = word.trim_start_matches(['-', '+']).to_ascii_lowercase();
    if !["nan", "inf", "infinity"].contains(&is_known.as_str()) {
        return None;
    }
    let (head, values) = text[..start].rsplit_once('[')?;
    let head = head.trim_end().strip_suffix(':')?.trim_end().strip_suffix('"')?;
    let (_, name) = head.rsplit_once('"')?;
    Some(no_number(name, values.matches(',').count() + 1, word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_emulator::SimulatorQuantity;

    fn case() -> SimulatorCase {
        let output = |name: &str| SimulatorQuantity { name: name.into(), unit: "1".into() };
        SimulatorCase {
            parameters: Vec::new(),
            conditions: Vec::new(),
            outputs: vec![output("a"), output("b")],
            rows: 2,
        }
    }

    #[test]
    fn outputs_follow_one_another_in_the_order_of_the_case() {
        let read = outputs(b" {\"b\": [3, -4e300],\n \"a\": [0.1, 2]}\r\n", "it", &case());
        assert_eq!(read, Ok(vec![0.1, 2.0, 3.0, -4e300]));
    }

    #[test]
    fn anything_else_is_an_error_with_its_place() {
        let error = |text: &str| outputs(text.as_bytes(), "the line", &case()).unwrap_err();
        assert_eq!(error(" \n"), "the line is empty");
        assert_eq!(error("hello"), "the line is not JSON: expected value at line 1 column 1");
        assert_eq!(error("[1]"), r#"the line is not an object {"a": [...], "b": [...]}"#);
        assert_eq!(error(r#"{"a": [1, 2]}"#), "the line has no `b`");
        let unknown = "the line has `c`, but the case has only `a` and `b`";
        assert_eq!(error(r#"{"a": [1, 2], "c": 1}"#), unknown);
        assert_eq!(error(r#"{"a": 1, "b": [1, 2]}"#), "`a` is not a list of numbers");
        let short = "`b` has 1 values, but the data have 2 rows";
        assert_eq!(error(r#"{"a": [1, 2], "b": [1]}"#), short);
        let null = "value 2 of `b` is null, but must be a finite number";
        assert_eq!(error(r#"{"a": [1, 2], "b": [1, null]}"#), null);
        for word in ["NaN", "-Infinity", "nan", "inf", "Infinity"] {
            let message = format!("value 2 of `a` is {word}, but must be a finite number");
            assert_eq!(error(&format!("{{\n \"a\" : [1, {word}], \"b\": [1, 2]}}")), message);
        }
        assert!(error(r#"{"a": [1, 1e999], "b": [1, 2]}"#).contains("number out of range"));
        assert_eq!(outputs(b"\xff", "the line", &case()), Err("the line is not UTF-8".to_owned()));
    }

    #[test]
    fn an_answer_with_wide_indentation_is_not_cut_off() {
        let case = SimulatorCase { rows: 100_000, ..case() };
        let column = vec![-1.234_567_890_123_456_7e-300; case.rows];
        let written = serde_json::json!({ "a": column, "b": column });
        assert!(serde_json::to_string_pretty(&written).unwrap().len() < most_bytes(&case));
    }
}
