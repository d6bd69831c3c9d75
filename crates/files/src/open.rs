//! Files that are opened by their path, and texts whose root is a JSON object.

use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::keys;
use gumption_text::json::{self, Member, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText, bytes};

/// Opens a file of text and hands its name, its text and its folder to `read`.
///
/// # Errors
/// That the file cannot be read, or what `read` finds.
pub(super) fn open<T>(
    path: &Path,
    read: impl FnOnce(&str, &str, &Path) -> Result<T, Diagnostics>,
) -> Result<T, Diagnostics> {
    open_as(path, text, read)
}

/// As [`open`], with what makes a text of the file's bytes.
pub(super) fn open_as<T>(
    path: &Path,
    text_of: impl FnOnce(Vec<u8>) -> Result<String, String>,
    read: impl FnOnce(&str, &str, &Path) -> Result<T, Diagnostics>,
) -> Result<T, Diagnostics> {
    let name = path.display().to_string();
    match bytes::of_file(path, bytes::MOST).and_then(text_of) {
        Ok(text) => read(&name, &text, path.parent().unwrap_or_else(|| Path::new(""))),
        Err(message) => {
            let log = Collector::new(SourceText::new(name, ""));
            log.report(&(0..0), DiagnosticKind::Unreadable { message });
            Err(log.into_diagnostics())
        }
    }
}

/// The bytes as text, or why they are none.
pub(super) fn text(bytes: Vec<u8>) -> Result<String, String> {
    bytes::text(&bytes).map(Cow::into_owned)
}

/// Why a text that is named as a JSON file is none at all; a mistake within one is told where it is.
/// Nothing of such a text is quoted, since it may be anything.
pub(super) fn is_no_object(text: &str) -> Option<String> {
    let start = text.trim_start_matches('\u{feff}').trim_start();
    let is_object = start.is_empty() || start.starts_with('{');
    (!is_object).then(|| "it is no JSON object: it does not begin with `{`".to_owned())
}

/// Reads a text whose root is an object, which is called `what` in messages.
///
/// # Errors
/// That the text is not JSON, or all that `read` reports.
pub(super) fn read_root<T>(
    name: &str,
    text: &str,
    what: &'static str,
    read: impl FnOnce(Object<'_>) -> Option<T>,
) -> Result<T, Diagnostics> {
    read_changed_root(name, text, what, |_, _| (), read)
}

/// As [`read_root`]; the tree is changed before it is read.
pub(super) fn read_changed_root<T>(
    name: &str,
    text: &str,
    what: &'static str,
    change: impl FnOnce(&Collector, &mut Node),
    read: impl FnOnce(Object<'_>) -> Option<T>,
) -> Result<T, Diagnostics> {
    let source = SourceText::new(name, text);
    let log = Collector::new(source.clone());
    let found = match json::parse(&source) {
        Ok(mut node) => {
            change(&log, &mut node);
            // what is missing from the root is reported at the first line
            let whole = 0..source.text.find('\n').unwrap_or(source.text.len());
            Object::new(&log, what, &node, &whole).and_then(read)
        }
        Err((span, diagnostic)) => {
            let header = 0..source.text.find('\n').unwrap_or(source.text.len());
            match FileKind::of_text(&source.text) {
                Some(kind) => log.report(&header, kind.described()),
                None => log.report(&span, diagnostic),
            }
            None
        }
    };
    log.finish(found)
}

/// Refuses a version of the file format that this program does not know; whether it is known.
pub(super) fn check_format(root: &Object<'_>, newest: f64) -> bool {
    let is_known = |number: f64| number.fract() == 0.0 && (1.0..=newest).contains(&number);
    let known = |member: &&Member| member.value.number().is_some_and(is_known);
    let Some(member) = root.get("format").filter(|member| !known(member)) else {
        return true;
    };
    let value = &member.value.value;
    let found = value.written().unwrap_or_else(|| value.kind()).to_owned();
    root.log.report(&member.value.span, DiagnosticKind::UnknownFormat { found });
    false
}

/// A kind of file that commands read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A model file or a case of the gap diagnosis.
    Model,
    /// A certificate.
    Certificate,
    /// A recipe of recordings.
    Recipe,
    /// A result that `run --save` wrote.
    SavedResult,
    /// The JSON answer of a run.
    Answer,
    /// The JSON answer of a certificate.
    CertificateAnswer,
    /// A file of costs.
    Costs,
    /// A table of results to be compared.
    Results,
    /// A Digital Calibration Certificate.
    DigitalCertificate,
}

/// How quantities are taken from a certificate.
pub const FROM_CERTIFICATES: &str = "a model takes quantities from the digital certificate \
    (`gumption certificate --format dcc`), each by an input of the distribution `dcc`";

impl FileKind {
    /// The kind that the keys of a root show beyond doubt.
    fn of(root: &Object<'_>) -> Option<Self> {
        let has = |key: &str| root.get(key).is_some();
        if has("outputs") && has("result") && !has("equations") && !has("model") {
            Some(Self::SavedResult)
        } else if has("gumption") && has("rows") && has("correlations") {
            Some(Self::CertificateAnswer)
        } else if has("gumption") && (has("outputs") || has("rows")) && !has("result") {
            Some(Self::Answer)
        } else if has("outputs") && (has("equations") || has("model")) && !has("rows") {
            Some(Self::Model)
        } else if has(keys::RECIPE_KEY) && !has("inputs") && !has("outputs") {
            Some(Self::Recipe)
        } else if has(keys::COSTS_KEY) && !has("inputs") && !has("outputs") {
            Some(Self::Costs)
        } else if has("rows") && !has("inputs") && !has("outputs") {
            Some(Self::Certificate)
        } else {
            None
        }
    }

    /// The kind of a text that is no JSON.
    fn of_text(text: &str) -> Option<Self> {
        let is_xml = text.trim_start_matches('\u{feff}').trim_start().starts_with('<');
        if is_xml && text.contains("digitalCalibrationCertificate") {
            Some(Self::DigitalCertificate)
        } else if is_table_of_results(text) {
            Some(Self::Results)
        } else {
            None
        }
    }

    /// What it is, in words, and the command that reads it.
    pub fn described(self) -> DiagnosticKind {
        let (what, command) = match self {
            Self::CertificateAnswer => {
                let reason = format!(
                    "this is the JSON answer of a certificate, for programs; {FROM_CERTIFICATES}"
                );
                return DiagnosticKind::Table { reason };
            }
            Self::DigitalCertificate => {
                let reason = format!(
                    "this is a digital calibration certificate, whose quantities `gumption dcc` lists; \
                     {FROM_CERTIFICATES}"
                );
                return DiagnosticKind::Table { reason };
            }
            Self::Model => ("a model file", "gumption run"),
            Self::Certificate => ("the file of a certificate", "gumption certificate"),
            Self::Recipe => ("a recipe of recordings", "gumption observe"),
            Self::SavedResult => ("a saved result", "gumption diff"),
            Self::Answer => ("the answer of a run", "gumption compare --against"),
            Self::Costs => ("a file of costs", "gumption plan --cost"),
            Self::Results => ("a table of results", "gumption compare"),
        };
        DiagnosticKind::WrongFile { what, command }
    }
}

/// Reports a file that another command reads, instead of all of its keys; whether it is one.
pub(super) fn refuse_other_kind(root: &Object<'_>, expected: FileKind) -> bool {
    match FileKind::of(root) {
        Some(kind) if kind != expected => {
            root.report(kind.described());
            true
        }
        _ => false,
    }
}

/// What is wrong with a JSON file or a digital certificate where a table is read, and where; nothing of
/// any other text.
pub fn no_table(source: &Arc<SourceText>) -> Option<(Range<usize>, DiagnosticKind)> {
    let place = 0..source.text.find('\n').unwrap_or(source.text.len());
    if source.text.trim_start().starts_with('<') {
        return FileKind::of_text(&source.text).map(|kind| (place, kind.described()));
    }
    if !source.text.trim_start().starts_with('{') {
        return None;
    }
    let node = json::parse(source).ok()?;
    let log = Collector::new(source.clone());
    let root = Object::new(&log, "a file", &node, &place)?;
    let reason = "this is a JSON file, and a table is CSV or XLSX with a header row".to_owned();
    let kind = FileKind::of(&root).map_or(DiagnosticKind::Table { reason }, FileKind::described);
    Some((place, kind))
}

/// Whether a text is a table of results to be compared, by its header.
pub(super) fn is_table_of_results(text: &str) -> bool {
    let header = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let names =
        header.unwrap_or_default().split([',', ';']).map(|name| name.trim().trim_matches('"'));
    are_results(names)
}

/// Whether columns of these names are those of results to be compared.
pub fn are_results<'t>(names: impl Iterator<Item = &'t str>) -> bool {
    let names: Vec<&str> = names.collect();
    let has = |name: &str| names.contains(&name);
    has("label") && (has("x1") && has("U1") || has("x") && has("U"))
}
