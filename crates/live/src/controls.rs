//! What answers a question about a sheet: the options of `gumption import` as controls of the page.

use serde::Serialize;

/// A control of the page with what is to be said by it, as far as the question says that.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct SheetControl {
    /// The option, without its hyphens: `column`, `row`, `unit`, `k`, ...
    option: String,
    /// What the column or the row is.
    name: Option<String>,
    /// The letter of the column, the number of the row, or the value.
    value: Option<String>,
}

/// The options that a sentence names in backquotes.
pub(crate) fn of(sentence: &str) -> Vec<SheetControl> {
    let quoted = sentence.split('`').skip(1).step_by(2);
    quoted.filter_map(|text| control(text.strip_prefix("--")?)).collect()
}

fn control(text: &str) -> Option<SheetControl> {
    let (option, rest) = text.split_once(' ').unwrap_or((text, ""));
    let rest = rest.trim().trim_matches('"');
    // words in capitals stand for what the user knows; of columns `N` is one
    let known = |text: &str, open: &[&str]| {
        let is_open = text.is_empty() || text.contains("FORMULA") || open.contains(&text);
        (!is_open).then(|| text.to_owned())
    };
    let pair = || rest.split_once('=').unwrap_or((rest, ""));
    let (name, value) = match option {
        "keep-columns" => return None,
        "column" => (known(pair().0, &["NAME"]), known(pair().1, &["COLUMN", "..."])),
        "column-unit" => (known(pair().0, &["NAME"]), known(pair().1, &["UNIT"])),
        "row" => (known(pair().0, &[]), known(pair().1, &["N", "ROW"])),
        _ => (None, known(rest, &["NAME", "UNIT", "NUMBER", "KIND"])),
    };
    Some(SheetControl { option: option.to_owned(), name, value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_controls() {
        let control = |option: &str, name: Option<&str>, value: Option<&str>| SheetControl {
            option: option.into(),
            name: name.map(str::to_owned),
            value: value.map(str::to_owned),
        };
        for (sentence, wanted) in [
            (
                "`--k 2`, or `--column k=COLUMN`",
                vec![control("k", None, Some("2")), control("column", Some("k"), None)],
            ),
            (
                "`--column NAME=N` (NAME is one of unit, U), or `--column ignore=N`",
                vec![
                    control("column", None, Some("N")),
                    control("column", Some("ignore"), Some("N")),
                ],
            ),
            ("`--column U=C`, or the unit `mm`", vec![control("column", Some("U"), Some("C"))]),
            ("`--row result=12`", vec![control("row", Some("result"), Some("12"))]),
            ("`--equation \"y = FORMULA\"`", vec![control("equation", None, None)]),
            ("`--equation \"y = A-B\"`", vec![control("equation", None, Some("y = A-B"))]),
            ("`--numbers`", vec![control("numbers", None, None)]),
            ("no option", vec![]),
        ] {
            assert_eq!(of(sentence), wanted, "{sentence}");
        }
    }
}
