//! The samples of an empirical distribution: a list in the model file, or a file with one number a
//! line.

use std::ops::Range;

use super::folder::Folder;
use super::json::Json;
use super::object::Object;
use super::source::{Place, SourceText};
use super::value_text::{ValueOf, with_point};
use super::{DiagnosticKind, bytes};
use gumption_engine::distribution::Samples;
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
            let values = from_file(object, object.text("file")?, folder, files)?;
            Some((values, &member.value.span))
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
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Vec<f64>> {
    let unreadable = |message: String| {
        let message = format!("`{file}`: {message}");
        object.log.report(place(object), DiagnosticKind::Unreadable { message });
    };
    let content = folder.content(file, bytes::MOST_OF_SAMPLES);
    let bytes = content.map_err(|kind| object.log.report(place(object), kind)).ok()?;
    let text = bytes::text(&bytes).map_err(&unreadable).ok()?;
    let source = SourceText::new(file, &text);
    drop(text);
    let numbers = match parse(&source.text) {
        Ok(numbers) => numbers,
        // it may be anything, and is not shown
        Err(_) if !has_numbers(&source.text) => {
            let is_readings = matches!(
                object.get("distribution").map(|member| &member.value.value),
                Some(Json::Text(shape)) if shape == "readings"
            );
            let instead = if is_readings { "; a table needs the name of its `column`" } else { "" };
            let message = "it is no file of numbers, one a line: no line is one";
            unreadable(format!("{message}{instead}"));
            return None;
        }
        Err(kinds) => {
            for (span, diagnostic) in kinds {
                object.log.report_at(Place { source: source.clone(), span }, diagnostic);
            }
            return None;
        }
    };
    if !files.iter().any(|(known, _)| known == file) {
        files.push((file.to_owned(), bytes));
    }
    Some(numbers)
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
fn parse(text: &str) -> Result<Vec<f64>, PlacedKinds> {
    let mut numbers = Vec::new();
    let mut kinds = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
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
    use crate::{Diagnostics, ModelFile, read as read_model};

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

    #[test]
    fn faults_name_the_file_and_the_line() {
        let diagnostics = model("1\n2\nvolt\n").unwrap_err().to_string();
        assert!(
            diagnostics.starts_with("s.txt:3:1: `volt` is not a finite number"),
            "{diagnostics}"
        );
        let diagnostics = model("1,5\n2,5\n").unwrap_err().to_string();
        assert!(
            diagnostics.starts_with(
                "s.txt:1:1: `1,5` is no number: a decimal fraction is written with a point, `1.5`"
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
        assert_eq!(parse("# volts\r\n1\r\n\r\n 2.5e-3 \n-7").unwrap(), vec![1.0, 2.5e-3, -7.0]);
        assert_eq!(parse("").unwrap(), Vec::<f64>::new());
    }

    #[test]
    fn faulty_lines_know_their_places() {
        let text = "1\n  1,5\nnan\n";
        let kinds = parse(text).unwrap_err();
        let places: Vec<&str> = kinds.iter().map(|(span, _)| &text[span.clone()]).collect();
        assert_eq!(places, vec!["1,5", "nan"]);
        assert_eq!(parse(&"x\n".repeat(1000)).unwrap_err().len(), MOST_FAULTS);
    }
}
