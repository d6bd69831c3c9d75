//! The measurement behind the results: its equations and what their symbols mean.
//!
//! The certificate is for the customer. A model's descriptions of inputs may name internal files of
//! the laboratory; such words are left out, and so are estimates and uncertainties of inputs, which
//! belong to the budget.

use super::words::{Words, beside, stacked};
use super::{CertificateReport, file_name};
use crate::document::Document;
use crate::plain;
use crate::printed::{formula_text, unit_text};
use crate::sheet::{ColumnKind, Sheet};
use crate::statement;
use gumption_engine::task::Task;

/// Maximum number of explained symbols: a certificate is not a list of variables.
const MOST_SYMBOLS: usize = 40;

/// The replacement for words that are not for the customer.
const LEFT_OUT: &str = "…";

/// The equations of a model, as stated on the certificate.
#[derive(PartialEq, Eq)]
pub(super) struct StatedModel {
    /// Quantities with their equations, in the order in which they are computed.
    pub(super) equations: Vec<[String; 2]>,
    /// Symbols with their meaning, which may be empty, and unit. If there are very many, only those
    /// with a meaning, and none if these are too many as well.
    pub(super) symbols: Vec<[String; 3]>,
}

/// The statement about each model file, by its index in the certificate. Models with the same
/// statement appear once; models without equations, and models of columns of data, are left out.
pub(super) fn stated(report: &CertificateReport<'_>) -> Vec<(usize, StatedModel)> {
    let mut found: Vec<(usize, StatedModel)> = Vec::new();
    if !report.certificate.equations {
        return found;
    }
    for place in 0..report.models.len() {
        let mut asked = report.certificate.evaluations.iter();
        let Some(asked) = asked.find(|asked| asked.file == place) else { continue };
        let of = StatedModel::of(&asked.task);
        if !of.equations.is_empty() && !found.iter().any(|(_, other)| *other == of) {
            found.push((place, of));
        }
    }
    found
}

impl StatedModel {
    fn of(task: &Task) -> Self {
        let equations = statement::equations(task.into()).into_iter();
        let more = statement::left_out(task.into()).map(|_| [LEFT_OUT.to_owned(), String::new()]);
        let outputs = task.model.outputs.iter().map(|output| &output.quantity);
        let inputs = task.model.inputs.iter().map(|input| &input.quantity);
        let quantities = outputs.chain(inputs).chain(&task.model.conditions);
        let symbols: Vec<[String; 3]> = quantities
            .map(|of| [plain(&of.name), meaning(&of.about), plain(of.unit.text())])
            .collect();
        let many = symbols.len() > MOST_SYMBOLS;
        let symbols: Vec<[String; 3]> =
            symbols.into_iter().filter(|symbol| !many || has_meaning(symbol)).collect();
        Self {
            equations: equations
                .map(|(name, text)| [name, without_files(&text)])
                .chain(more)
                .collect(),
            symbols: if symbols.len() > MOST_SYMBOLS { Vec::new() } else { symbols },
        }
    }
}

/// A section about the measurement of every model file.
pub(super) fn sections(document: &mut Document, report: &CertificateReport<'_>) {
    let languages = report.certificate.languages.as_slice();
    let header = |word: fn(&Words) -> &'static str| stacked(languages, word);
    let models = stated(report);
    for (number, (place, of)) in models.iter().enumerate() {
        if number == 0 {
            document.section(beside(languages, |w| w.measurement));
        }
        if let (true, Some(model)) = (models.len() > 1, report.models.get(*place)) {
            let named =
                format!("{}: {}", beside(languages, |w| w.model_file), file_name(model.name));
            document.text(plain(&named));
        }
        let mut sheet = Sheet::default();
        sheet.text(&header(|w| w.quantity), of.equations.iter().map(|[name, _]| name.clone()));
        let texts = of.equations.iter().map(|[_, text]| formula_text(text));
        sheet.push(&header(|w| w.equation), texts, ColumnKind::Equations);
        document.table(sheet);
        let symbols: Vec<&[String; 3]> = of.symbols.iter().filter(|of| has_meaning(of)).collect();
        if symbols.is_empty() {
            continue;
        }
        let column = |place: usize| symbols.iter().map(move |of| of[place].clone());
        let mut sheet = Sheet::default();
        sheet.text(&header(|w| w.symbol), column(0));
        sheet.text(&header(|w| w.meaning), column(1));
        sheet.units(&header(|w| w.unit), column(2).map(|unit| unit_text(&unit)));
        document.table(sheet);
    }
}

/// Whether the model describes a symbol.
fn has_meaning([_, meaning, _]: &[String; 3]) -> bool {
    !meaning.is_empty()
}

/// The first sentence of the description of a quantity.
fn meaning(about: &str) -> String {
    let words: Vec<&str> = about.split_whitespace().collect();
    let whole = words.join(" ");
    let ends = |at: &usize| {
        let (before, after) = (&whole[..*at], &whole[at + 2..]);
        // "et al. (2024)" goes on
        before.matches('(').count() <= before.matches(')').count()
            && after.starts_with(char::is_uppercase)
    };
    let end = whole.match_indices(". ").map(|(at, _)| at).find(ends).unwrap_or(whole.len());
    plain(&before_files(whole[..end].trim_end_matches('.')))
}

/// The clauses of a sentence before the first one that names a file.
fn before_files(sentence: &str) -> String {
    let clauses = sentence.split_inclusive([',', ';', '(']);
    let kept: String = clauses.take_while(|clause| !name_file(clause)).collect();
    let whole = kept.len() == sentence.len();
    let cut = kept.trim_end_matches([',', ';', ':', '(', ' ']);
    if whole { sentence.to_owned() } else { cut.to_owned() }
}

/// A formula without the names of files in its quotes.
fn without_files(formula: &str) -> String {
    let parts: Vec<&str> = formula.split('"').collect();
    let part = |(number, part): (usize, &&str)| {
        let named = number % 2 == 1 && (part.contains('/') || name_file(part));
        if named { LEFT_OUT.to_owned() } else { (*part).to_owned() }
    };
    parts.iter().enumerate().map(part).collect::<Vec<_>>().join("\"")
}

/// Whether one of the words is the name of a file.
fn name_file(words: &str) -> bool {
    let apart = |of: char| of.is_whitespace() || "\"'`,;()[]<>".contains(of);
    words.split(apart).any(names_file)
}

/// Whether a word is the name or the path of a file: a folder, or an extension that is not a
/// number.
fn names_file(word: &str) -> bool {
    let word = word.trim_end_matches(['.', ':', '!', '?']);
    let folder = word.contains('\\')
        || (word.len() > 1 && (word.starts_with(['/', '~']) || word.starts_with("..")));
    let ending = word.rsplit_once('.').is_some_and(|(name, ending)| {
        ENDINGS.iter().any(|known| known.eq_ignore_ascii_case(ending)) && !name.is_empty()
    });
    folder || ending
}

/// Extensions of files with data and documents of laboratories.
const ENDINGS: [&str; 17] = [
    "csv", "dat", "doc", "docx", "json", "md", "ods", "odt", "pdf", "tsv", "tex", "txt", "xls",
    "xlsm", "xlsx", "xml", "yaml",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_left_out() {
        for text in
            ["R_t/(1 + alpha*(t - 23))", "x / y", "0.5*a.b", "table(t, \"c\", \"t\", \"y\")"]
        {
            assert_eq!(without_files(text), text);
        }
        let formula = r#"x + table(t, "secret/customer 7.csv", "t", "c", "linear")"#;
        assert_eq!(without_files(formula), r#"x + table(t, "…", "t", "c", "linear")"#);
        for text in ["in m/s^2 (ISO 16063-21)", "after F.2.2.1, e.g. rows", "A/B ratio"] {
            assert_eq!(before_files(text), text);
        }
        assert_eq!(before_files(r"drift, see C:\lab\b.doc, page 2"), "drift");
        assert_eq!(before_files("drift (from our own 7.XLSX)"), "drift");
        assert_eq!(before_files("from ../drift"), "");
    }

    #[test]
    fn a_meaning_is_one_sentence() {
        assert_eq!(
            meaning("Acceleration along\nx, at 23 °C. Not y."),
            "Acceleration along x, at 23 °C"
        );
        assert_eq!(meaning("standard resistor."), "standard resistor");
        let cited = "tolerance (Chiominto et al. (2024), table 2; A. B. Author)";
        assert_eq!(meaning(&format!("{cited}. Not more.")), cited);
        assert_eq!(meaning(""), "");
    }
}
