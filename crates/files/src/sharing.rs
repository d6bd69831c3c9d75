//! Inputs that are correlated have their values in common over the same rows.
//!
//! An input has one value for all rows of conditions, one for each row, or one for each value of a
//! condition (`per`). A coefficient between one value for all rows and one for each row would tie
//! the values of the rows to each other, although `per` says that they are independent.

use super::input_set::InputSet;
use gumption_engine::task::{Sharing, Variable};

/// In which rows a variable has the same value, in words.
fn describe(variable: &Variable, conditions: &[String]) -> String {
    let name = &variable.name;
    match &variable.sharing {
        Sharing::All => format!("`{name}` has one value for all rows"),
        Sharing::Row => format!("`{name}` has a value for each row"),
        Sharing::Condition(place) => {
            let condition = conditions.get(*place).map_or("", String::as_str);
            format!("`{name}` has a value for each `{condition}`")
        }
    }
}

/// Why two variables cannot depend on each other, which they do by a declared coefficient or by what
/// they come from (`linked`); `None` if they have their values in common over the same
/// rows, or if one does not vary. `rows` are the values of the conditions in every row.
pub(super) fn contradiction(
    inputs: &InputSet,
    (first, second): (usize, usize),
    linked: bool,
    conditions: &[String],
    rows: &[Vec<f64>],
) -> Option<String> {
    let (a, b) = (inputs.variables.get(first)?, inputs.variables.get(second)?);
    let varies = |place: usize| inputs.known.varies(place);
    if a.sharing.is_alike(&b.sharing, rows) || !varies(first) || !varies(second) {
        return None;
    }
    let both = format!("{}, {}", describe(a, conditions), describe(b, conditions));
    Some(if linked {
        format!(
            "{both}, but their saved results depend on each other, and so do their values in every \
             row; give both the same `per`"
        )
    } else {
        format!(
            "{both}, so they cannot be correlated: that would tie the rows to each other; give both \
             the same `per`, or make what they have in common an input of its own"
        )
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::read_text;
    use gumption_text::DiagnosticKind;

    /// A file with a coefficient between two inputs that have these `per` and distributions.
    fn kinds(conditions: &str, per: [&str; 2], second: &str) -> Vec<DiagnosticKind> {
        let [a, b] = per.map(|per| match per {
            "" => String::new(),
            per => format!(r#""per": "{per}","#),
        });
        let text = format!(
            r#"{{"inputs": {{"a": {{{a} "distribution": "normal", "mean": 1, "std": 1}},
            "b": {{{b} {second}}}}}, "correlations": [["a", "b", 0.5]],
            "conditions": {{{conditions}}}, "equations": {{"y": "a + b"}}, "outputs": {{"y": {{}}}}}}"#
        );
        match read_text("m.json", &text, Path::new(""), &[]) {
            Ok(_) => Vec::new(),
            Err(diagnostics) => {
                diagnostics.0.into_iter().map(|diagnostic| diagnostic.kind).collect()
            }
        }
    }

    const NORMAL: &str = r#""distribution": "normal", "mean": 1, "std": 1"#;
    const ONE: &str = r#""f": {"values": [1, 2]}"#;
    const TWO: &str = r#""f": {"values": [1, 2]}, "g": {"values": [1, 2, 3]}"#;

    #[test]
    fn what_is_shared_differently_is_refused() {
        for per in [["", "row"], ["row", ""], ["", "f"], ["row", "f"], ["f", "g"]] {
            let found = kinds(TWO, per, NORMAL);
            assert!(
                matches!(found.as_slice(), [DiagnosticKind::Correlation { .. }]),
                "{per:?}: {found:?}"
            );
        }
    }

    /// The same rows in other words: a value for each value of the only condition is one for each
    /// row, and where there is one row, all is the same. A constant is the same in all rows anyway.
    #[test]
    fn what_is_shared_alike_is_taken() {
        for (conditions, per) in [
            (TWO, ["row", "row"]),
            (TWO, ["g", "g"]),
            (ONE, ["row", "f"]),
            (r#""f": {"values": [1]}"#, ["", "row"]),
            (r#""f": {"values": [1, 2]}, "g": {"values": [5]}"#, ["row", "f"]),
        ] {
            assert_eq!(kinds(conditions, per, NORMAL), [], "{per:?}");
        }
        assert_eq!(kinds(TWO, ["", "row"], r#""distribution": "constant", "value": 1"#), []);
    }
}
