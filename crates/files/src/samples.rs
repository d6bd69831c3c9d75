//! The samples of an empirical distribution: a list in the model file, or a file with one number a
//! line, perhaps below a heading; a column of a table; a column of an array of NumPy. So the files that
//! `--samples` writes can be read.

use std::ops::Range;

use gumption_columns::recording::npy_columns;
use gumption_columns::separator::{Separator, is_skipped};
use gumption_engine::distribution::Samples;
use gumption_text::json::Json;
use gumption_text::object::{Object, whole_number};
use gumption_text::value_text::{ValueOf, with_point};
use gumption_text::{DiagnosticKind, Folder, Place, SourceText, bytes, column_heading, table};
use gumption_units::Unit;

/// At most so many faulty lines are reported; a file of something else has nothing but those.
const MOST_FAULTS: usize = 10;

/// Longer texts are cut in messages.
const LONGEST: usize = 40;

/// Reads the samples of the input or component `name`, in its unit, from `values`, or from `file` in
/// `folder`, whose content is added to `files`.
pub(super) fn read(
    object: &Object<'_>,
    name: &str,
    unit: (&Unit, ValueOf),
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Samples> {
    let (values, place) = numbers(object, name, unit, folder, files)?;
    let samples = Samples::new(values);
    let diagnostic = |error| DiagnosticKind::Distribution { name: name.to_owned(), error };
    object.log.value(place, samples.map_err(diagnostic))
}

/// The numbers of the object's `values` or of its `file` in `folder`, whose content is added to
/// `files`, and where they are named; `name` is what they belong to, whose unit texts are converted
/// to.
pub(crate) fn numbers<'a>(
    object: &Object<'a>,
    name: &str,
    (unit, of): (&Unit, ValueOf),
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<(Vec<f64>, &'a Range<usize>)> {
    match (object.get("file"), object.get("values")) {
        (Some(_), Some(second)) => {
            let diagnostic = DiagnosticKind::Exclusive { first: "file", second: "values" };
            object.log.report(&second.key_span, diagnostic);
            None
        }
        (Some(member), None) => {
            let values = from_file(object, object.text("file")?, (unit, of), folder, files)?;
            Some((values, &member.value.span))
        }
        (None, Some(_)) if object.get("column").is_some() => {
            let column = object.get("column").map_or(object.place(), |member| &member.key_span);
            object.log.report(column, DiagnosticKind::OnlyWith { key: "column", with: "file" });
            None
        }
        (None, Some(member)) => Some((object.values("values", unit, of)?, &member.value.span)),
        (None, None) => {
            object.report(DiagnosticKind::NoValues { name: name.to_owned() });
            None
        }
    }
}

fn from_file(
    object: &Object<'_>,
    file: &str,
    unit: (&Unit, ValueOf),
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Vec<f64>> {
    let unreadable = |message: String| {
        let message = format!("`{file}`: {message}");
        object.log.report(place(object), DiagnosticKind::Unreadable { message });
    };
    let content = folder.content(file, bytes::MOST_OF_SAMPLES);
    let bytes = content.map_err(|kind| object.log.report(place(object), kind)).ok()?;
    let numbers = if bytes.starts_with(NUMPY) {
        of_array(object, file, &bytes).map_err(&unreadable).ok()?
    } else {
        let text = bytes::text(&bytes).map_err(&unreadable).ok()?;
        of_text(object, file, &text, unit, folder)?
    };
    if !files.iter().any(|(known, _)| known == file) {
        files.push((file.to_owned(), bytes));
    }
    Some(numbers)
}

/// What an array of NumPy begins with.
const NUMPY: &[u8] = b"\x93NUMPY";

/// The numbers of an array, or of its column of that number.
fn of_array(object: &Object<'_>, file: &str, bytes: &[u8]) -> Result<Vec<f64>, String> {
    let (columns, numbers) = npy_columns(bytes)?;
    let column = match object.get("column").map(|member| &member.value.value) {
        None if columns == 1 => 1,
        None => {
            return Err(format!(
                "its array has {columns} columns; say which by its number, `\"column\": 1` to \
                 {columns}"
            ));
        }
        Some(Json::Number(text)) => whole_number(text)
            .and_then(|number| usize::try_from(number).ok())
            .filter(|number| (1..=columns).contains(number))
            .ok_or_else(|| format!("its array has {columns} columns, so no column {text}"))?,
        Some(_) => {
            return Err(format!(
                "columns of an array have no names; give the number of the `column`, from 1 to \
                 {columns} (of `{file}` as `--samples` writes it in the order of the outputs)"
            ));
        }
    };
    Ok(numbers.into_iter().skip(column - 1).step_by(columns).collect())
}

/// The numbers of a text: of its column, or one a line, perhaps below a heading.
fn of_text(
    object: &Object<'_>,
    file: &str,
    text: &str,
    unit: (&Unit, ValueOf),
    folder: Folder<'_>,
) -> Option<Vec<f64>> {
    let unreadable = |message: String| {
        let message = format!("`{file}`: {message}");
        object.log.report(place(object), DiagnosticKind::Unreadable { message });
    };
    if let Some(member) = object.get("column") {
        let name = object.text("column")?;
        let span = &member.value.span;
        let (table, _) = table::read(object.log, folder, file, place(object), Some(&[name]))?;
        let Some(column) = table.column(name) else {
            let reason = table.no_column(name);
            object.log.report(span, DiagnosticKind::Table { reason });
            return None;
        };
        let heading = table.columns[column].as_str();
        column_heading::check(object.log, span, heading, unit).then_some(())?;
        return Some(table.rows.iter().filter_map(|row| row.get(column)).copied().collect());
    }
    let source = SourceText::new(folder.shown(file), text);
    let heading = heading(&source.text);
    if let Some((heading, _)) = heading {
        let separator = Separator::of_header(heading);
        let names: Vec<&str> = heading.split(separator.sign()).map(unquoted).collect();
        match names.as_slice() {
            [only] => {
                // a unit stands on a line of its own, where it is no name in a table
                let own = format!("first line [{only}]");
                let is_unit = object.log.unit(only).is_ok_and(|of| of.is_compatible(unit.0));
                let column = if is_unit && !unit.0.dimension().is_none() { &own } else { *only };
                column_heading::check(object.log, place(object), column, unit).then_some(())?;
                let is_fraction = |word: &str| word.contains('.') && word.parse::<f64>().is_ok();
                if only.split_whitespace().any(is_fraction) {
                    unreadable(format!(
                        "its first line, `{only}`, holds a number and is no number: a line that is no \
                         reading begins with `#`"
                    ));
                    return None;
                }
            }
            // it may be anything, and is not shown
            _ if !has_numbers(&source.text.replace(separator.sign(), "\n")) => {}
            _ => {
                let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
                unreadable(format!(
                    "it has several columns, {}; name the one that is wanted with `column`",
                    names.join(", ")
                ));
                return None;
            }
        }
    }
    let from = heading.map_or(0, |(_, end)| end);
    match parse(&source.text, from) {
        Ok(numbers) => Some(numbers),
        // it may be anything, and is not shown
        Err(_) if !has_numbers(&source.text) => {
            let is_readings = matches!(
                object.get("distribution").map(|member| &member.value.value),
                Some(Json::Text(shape)) if shape == "readings"
            );
            let instead = if is_readings { "; a table needs the name of its `column`" } else { "" };
            let message = "it is no file of numbers, one a line: no line is one";
            unreadable(format!("{message}{instead}"));
            None
        }
        Err(kinds) => {
            for (span, diagnostic) in kinds {
                object.log.report_at(Place { source: source.clone(), span }, diagnostic);
            }
            None
        }
    }
}

/// The heading of a text and where its line ends: the first line, if it begins with a letter and is no
/// number.
fn heading(text: &str) -> Option<(&str, usize)> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        start += line.len();
        if is_skipped(line) {
            continue;
        }
        let content = line.trim();
        let begins = unquoted(content).starts_with(|c: char| c.is_alphabetic() || c == '_');
        return (begins && content.parse::<f64>().is_err()).then_some((content, start));
    }
    None
}

/// A name without spaces around it and without quotation marks.
fn unquoted(name: &str) -> &str {
    name.trim().trim_matches('"').trim()
}

/// A file that is not there is named where the model file names it.
fn place<'a>(object: &Object<'a>) -> &'a Range<usize> {
    object.get("file").map_or(object.place(), |member| &member.value.span)
}

/// Whether some line is a number, be it with a decimal comma.
fn has_numbers(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim);
    lines.any(|line| line.parse::<f64>().is_ok() || with_point(line).is_some())
}

type PlacedKinds = Vec<(Range<usize>, DiagnosticKind)>;

/// The numbers of a text, one a line; empty lines and those that begin with `#` are skipped.
/// `from` is where the first line behind a heading begins.
fn parse(text: &str, from: usize) -> Result<Vec<f64>, PlacedKinds> {
    let mut numbers = Vec::new();
    let mut kinds = Vec::new();
    let mut start = from;
    for line in text.get(from..).unwrap_or("").split_inclusive('\n') {
        let content = line.trim();
        let indent = line.len() - line.trim_start().len();
        if !content.is_empty() && !content.starts_with('#') {
            match content.parse::<f64>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                _ => {
                    let span = start + indent..start + indent + content.len();
                    let found = content.chars().take(LONGEST).collect();
                    kinds.push((span, DiagnosticKind::Sample { found }));
                }
            }
        }
        if kinds.len() == MOST_FAULTS {
            break;
        }
        start += line.len();
    }
    if kinds.is_empty() { Ok(numbers) } else { Err(kinds) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ModelFile, read as read_model};
    use gumption_text::Diagnostics;

    /// A model of two inputs and a component with samples from `s.txt` of that content.
    fn model(content: &str) -> Result<ModelFile, Diagnostics> {
        let folder = tempfile::tempdir().unwrap();
        let samples = r#""distribution": "samples", "file": "s.txt""#;
        let text = format!(
            r#"{{"inputs": {{"a": {{{samples}}}, "b": {{"mean": 0, "components":
            [{{"name": "c", {samples}}}]}}}},
            "equations": {{"y": "a + b"}}, "outputs": {{"y": {{}}}}}}"#
        );
        std::fs::write(folder.path().join("m.json"), text).unwrap();
        if !content.is_empty() {
            std::fs::write(folder.path().join("s.txt"), content).unwrap();
        }
        read_model(&folder.path().join("m.json"), &[])
    }

    #[test]
    fn a_file_is_read_from_the_folder_of_the_model_and_recorded_once() {
        let file = model("1\n3\n").unwrap();
        assert_eq!(file.files, vec![("s.txt".to_owned(), b"1\n3\n".to_vec())]);
        let distributions = &file.task.rows[0].distributions;
        let means: Vec<f64> = distributions.iter().map(|d| d.mean()).collect();
        assert_eq!(means, vec![2.0, 0.0, 2.0]);
    }

    /// A unit on the first line is that of the numbers below; what is derived from them is none of them.
    #[test]
    fn the_first_line_is_not_passed_by() {
        let read = |first: &str| {
            let folder = tempfile::tempdir().unwrap();
            let text = r#"{"inputs": {"a": {"unit": "V", "distribution": "readings", "file": "s.txt"}},
                "equations": {"y": "a"}, "outputs": {"y": {"unit": "V"}}}"#;
            std::fs::write(folder.path().join("m.json"), text).unwrap();
            let content = format!("{first}\n1.01\n1.02\n1.03\n");
            std::fs::write(folder.path().join("s.txt"), content).unwrap();
            read_model(&folder.path().join("m.json"), &[]).map_err(|found| found.to_string())
        };
        for first in ["V", "U", "DMM 34401", "voltage [V]", "mass"] {
            assert!(read(first).is_ok(), "{first}");
        }
        for (first, expected) in [
            ("mV", "says `mV`, but its values are read in `V`"),
            ("U [x1000 V]", "says `x1000 V`"),
            ("mean 1.02", "begins with `#`"),
        ] {
            let message = read(first).unwrap_err();
            assert!(message.contains(expected), "{first}: {message}");
        }
    }

    #[test]
    fn faults_name_the_file_and_the_line() {
        let diagnostics = model("1\n2\nvolt\n").unwrap_err().to_string();
        assert!(diagnostics.contains("/s.txt:3:1: `volt` is not a finite number"), "{diagnostics}");
        let diagnostics = model("1,5\n2,5\n").unwrap_err().to_string();
        assert!(
            diagnostics.contains(
                "/s.txt:1:1: `1,5` is not a number: write a decimal fraction with a point, `1.5`"
            ),
            "{diagnostics}"
        );
        let diagnostics = model("").unwrap_err().to_string();
        assert!(
            diagnostics.contains("m.json:1:") && diagnostics.contains("`s.txt`:"),
            "{diagnostics}"
        );
        let diagnostics = model("1\n1\n").unwrap_err().to_string();
        assert!(diagnostics.contains("all 2 samples are equal"), "{diagnostics}");
    }

    #[test]
    fn one_number_a_line() {
        assert_eq!(parse("# volts\r\n1\r\n\r\n 2.5e-3 \n-7", 0).unwrap(), vec![1.0, 2.5e-3, -7.0]);
        assert_eq!(parse("", 0).unwrap(), Vec::<f64>::new());
    }

    #[test]
    fn faulty_lines_know_their_places() {
        let text = "1\n  1,5\nnan\n";
        let kinds = parse(text, 0).unwrap_err();
        let places: Vec<&str> = kinds.iter().map(|(span, _)| &text[span.clone()]).collect();
        assert_eq!(places, vec!["1,5", "nan"]);
        assert_eq!(parse(&"x\n".repeat(1000), 0).unwrap_err().len(), MOST_FAULTS);
    }

    /// A model of one input in volts of a file of that name and content; `more` are further keys.
    fn of_file(name: &str, content: &[u8], more: &str) -> Result<[f64; 2], String> {
        let folder = tempfile::tempdir().unwrap();
        let text = format!(
            r#"{{"inputs": {{"a": {{"unit": "V", "distribution": "samples", "file": "{name}"{more}}}}},
            "equations": {{"y": "a"}}, "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        std::fs::write(folder.path().join(name), content).unwrap();
        std::fs::write(folder.path().join("m.json"), text).unwrap();
        let file = read_model(&folder.path().join("m.json"), &[]).map_err(|e| e.to_string())?;
        let of = &file.task.rows[0].distributions[0];
        Ok([of.mean(), of.standard_deviation()])
    }

    #[test]
    fn a_heading_and_a_column() {
        // of 1 and 3: mean 2, standard deviation 1 (divisor n)
        for content in ["p\n1\n3\n", "# of a run\n\"p [V]\"\n1\n3\n", "p (V)\r\n1\r\n3\r\n"] {
            assert_eq!(of_file("s.csv", content.as_bytes(), ""), Ok([2.0, 1.0]), "{content}");
        }
        let two = b"p [V],q\n1,10\n3,30\n";
        assert_eq!(of_file("s.csv", two, r#", "column": "p""#), Ok([2.0, 1.0]));
        assert_eq!(of_file("s.csv", two, r#", "column": "q""#), Ok([20.0, 10.0]));
        let several = of_file("s.csv", two, "").unwrap_err();
        let said = "`s.csv`: it has several columns, `p [V]`, `q`; name the one that is wanted with \
                    `column`";
        assert!(several.contains(said), "{several}");
        let none = of_file("s.csv", two, r#", "column": "r""#).unwrap_err();
        assert!(none.contains("s.csv` has no column `r`"), "{none}");
        for (content, more) in
            [(&b"p [mV]\n1\n3\n"[..], ""), (b"p [mV],q\n1,2\n3,4\n", r#", "column": "p""#)]
        {
            let other = of_file("s.csv", content, more).unwrap_err();
            assert!(other.contains("mV") && other.contains("`V`"), "{other}");
        }
    }

    /// What is no heading is a fault as before.
    #[test]
    fn what_is_no_heading_is_a_fault() {
        for content in ["1\np\n3\n", "1,5\n2,5\n", "nan\n1\n", "-\n1\n"] {
            assert!(of_file("s.csv", content.as_bytes(), "").is_err(), "{content}");
        }
        let words = of_file("s.csv", b"a text, of words\nwithout a number\n", "").unwrap_err();
        assert!(words.contains("it is no file of numbers"), "{words}");
        let lonely = of_file("s.csv", b"p\n", "").unwrap_err();
        assert!(!lonely.is_empty());
    }

    #[test]
    fn an_array_of_numpy() {
        let array = |shape: &str, values: &[f64]| {
            let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
            let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
            bytes.extend((text.len() as u16 + 1).to_le_bytes());
            bytes.extend(text.bytes().chain([b'\n']));
            bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            bytes
        };
        assert_eq!(of_file("s.npy", &array("(2, 1)", &[1.0, 3.0]), ""), Ok([2.0, 1.0]));
        assert_eq!(of_file("s.npy", &array("(2,)", &[1.0, 3.0]), ""), Ok([2.0, 1.0]));
        let two = array("(2, 2)", &[1.0, 10.0, 3.0, 30.0]);
        assert_eq!(of_file("s.npy", &two, r#", "column": 2"#), Ok([20.0, 10.0]));
        for (more, said) in [
            ("", "its array has 2 columns; say which by its number, `\"column\": 1` to 2"),
            (r#", "column": 3"#, "its array has 2 columns, so no column 3"),
            (r#", "column": "p""#, "columns of an array have no names"),
        ] {
            let found = of_file("s.npy", &two, more).unwrap_err();
            assert!(found.contains(said), "{found}");
        }
    }
}
