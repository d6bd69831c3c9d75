//! A certificate file: what is to be stated, of which models, in which form.

mod administrative;
mod layout;
mod letterhead;
mod rows;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::context::Context;
use super::keys;
use super::open::{FileKind, check_format, read_root, refuse_other_kind};
use super::settings::{self, named};
use gumption_analysis::certificate::contents::{Certificate, DecimalMark, Language, Rounding};
use gumption_engine::task::{Coverage, Settings, StatementMethod, Warning};
use gumption_text::json::{self, Json, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, Folder, SourceText};
use rows::CertificateRows;

/// The most significant digits of a stated uncertainty.
const MOST_DIGITS: u64 = 4;

/// A certificate file that was read and found right, with its model files.
#[derive(Debug)]
pub struct CertificateFile {
    /// The certificate.
    pub certificate: Certificate,
    /// The model files, as [`Asked::file`](gumption_analysis::certificate::contents::Asked) counts them.
    pub models: Vec<CertifiedModel>,
    /// Notes on what was read, each with the model file as its place.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<SourceText>,
    /// Where each row of the table stands in the file.
    pub places: Vec<Range<usize>>,
}

/// A model file of a certificate.
#[derive(Debug)]
pub struct CertifiedModel {
    /// The name, as the certificate file has it.
    pub name: String,
    /// Its text.
    pub source: Arc<SourceText>,
    /// The content of the tables that it reads, by name.
    pub files: Vec<(String, Vec<u8>)>,
}

impl CertificateFile {
    /// A mistake at a key of the file, or at its beginning if the key is not there. A dot goes into
    /// an object: `device.serial_number`.
    pub fn diagnostic_at(&self, key: &str, diagnostic: DiagnosticKind) -> Diagnostics {
        let log = Collector::new(self.source.clone());
        log.report(&self.place_of(key), diagnostic);
        log.into_diagnostics()
    }

    /// Mistakes at keys of the file that are not there: each is reported at the longest part of its
    /// name that is.
    pub fn missing(&self, keys: &[&'static str], what: &'static str) -> Diagnostics {
        let log = Collector::new(self.source.clone());
        for key in keys {
            log.report(&self.place_of(key), DiagnosticKind::MissingKey { key, what });
        }
        log.into_diagnostics()
    }

    fn place_of(&self, key: &str) -> Range<usize> {
        let whole = 0..self.source.text.find('\n').unwrap_or(self.source.text.len());
        let Ok(mut node) = json::parse(&self.source) else {
            return whole;
        };
        let mut place = whole;
        for part in key.split('.') {
            let Json::Object(members) = node.value else { break };
            let Some(member) = members.into_iter().find(|member| member.key == part) else { break };
            place = member.key_span;
            node = member.value;
        }
        place
    }
}

/// Reads and checks a certificate file's text and its model files.
pub(super) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
) -> Result<CertificateFile, Diagnostics> {
    read_root(name, text, "a certificate file", |root| {
        certificate(files, root, files.folder(folder))
    })
}

/// Whether a text is meant as a certificate file.
pub(super) fn is_meant(root: &Node) -> bool {
    let Json::Object(members) = &root.value else { return false };
    let has = |key: &str| members.iter().any(|member| member.key == key);
    keys::CERTIFICATE_KEYS.iter().any(|key| has(key)) && !has("outputs") && !has("result")
}

/// What is asked of every model.
#[derive(Clone, Copy, Debug)]
struct Asking {
    /// The coverage that the certificate states; a model's own where it states none.
    coverage: Option<Coverage>,
    /// The digits that it states, which decide whether a GUM interval is valid where neither it nor
    /// the model says another number.
    digits: u32,
    /// Settings of the trials that beat those of the model files.
    trials: Option<Settings>,
    /// Which method gives the stated uncertainties; that of each model file where none is given.
    statement: Option<StatementMethod>,
    /// The tolerance of the automatic choice; that of each model file where none is given.
    statement_tolerance: Option<f64>,
}

impl Asking {
    fn apply(self, settings: &mut Settings) {
        // no digit of a certificate is to depend on a seed, where such figures are asked for
        settings.quasi_otherwise = true;
        if let Some(own) = self.trials {
            settings.trials = own.trials;
            settings.decide_up_to = own.decide_up_to;
            settings.rule = own.rule;
            settings.max_trials = own.max_trials;
            settings.seed = own.seed;
            if own.own_digits {
                *settings = settings.with_digits(own.digits);
            }
        }
        if !settings.own_digits {
            settings.digits = self.digits;
        }
        settings.coverage = self.coverage.unwrap_or(settings.coverage);
        settings.statement_tolerance =
            self.statement_tolerance.unwrap_or(settings.statement_tolerance);
    }
}

fn certificate<'a>(
    files: Context<'a>,
    root: Object<'a>,
    folder: Folder<'a>,
) -> Option<CertificateFile> {
    if refuse_other_kind(&root, FileKind::Certificate) {
        return None;
    }
    keys::check(&root, keys::CERTIFICATE);
    check_format(&root, 1.0);
    let readings = files.readings.map(|new| new.file.name());
    let administrative = administrative::read(&root, readings);
    let languages = languages(&root);
    let rounding = named(&root, "rounding", Rounding::named, &Rounding::ALL.map(Rounding::name));
    let mark =
        named(&root, "decimal_mark", DecimalMark::named, &DecimalMark::ALL.map(DecimalMark::name));
    let digits = root.whole("digits", 1, MOST_DIGITS).unwrap_or(2);
    let coverage = settings::coverage(&root);
    let equations = root.truth("equations").unwrap_or(true);
    let trials = root.get("monte_carlo").map(|_| settings::read(&root));
    let tables = layout::tables(&root);
    let letterhead = letterhead::read(&root, folder);
    let correlations = root.truth("correlations").unwrap_or(false);
    let mut rows = CertificateRows::new(
        root.log,
        (files, folder),
        tables.iter().map(|table| table.name.clone()).collect(),
        Asking {
            coverage,
            digits: u32::try_from(digits).unwrap_or(2),
            trials,
            statement: settings::statement(&root),
            statement_tolerance: settings::statement_tolerance(&root),
        },
    );
    match root.required("rows").and_then(|_| root.list("rows")) {
        Some([]) => {
            let place = root.get("rows").map_or(root.place(), |member| &member.key_span);
            root.log.report(place, DiagnosticKind::NoValues { name: "rows".into() });
        }
        Some(list) => rows.read(list),
        None => {}
    }
    if root.get("functions").is_some() {
        root.list("functions").unwrap_or_default().iter().for_each(|node| rows.function(node));
    }
    let shown = texts(&root, "conditions");
    for (name, span) in &shown {
        rows.check_condition(name, span);
    }
    let (shared, separate) = (names(&root, "shared_inputs"), names(&root, "separate_inputs"));
    for (name, span) in shared.iter().chain(&separate) {
        rows.check_input(name, span);
    }
    if let Some((name, span)) = separate.iter().find(|(name, _)| shared.contains_key(*name)) {
        let reason =
            format!("`{name}` is in `shared_inputs` and in `separate_inputs`; take it out of one");
        root.log.report(span, DiagnosticKind::Certificate { reason });
    }
    let layout = rows.layout(tables);
    let rows::Read { evaluations, lines, functions, models, warnings, places } = rows.finish()?;
    let certificate = Certificate {
        administrative: administrative?,
        decimal_mark: mark.unwrap_or_else(|| {
            languages.first().map_or(DecimalMark::Point, |language| language.decimal_mark())
        }),
        languages,
        rounding: rounding.unwrap_or_default(),
        digits: u32::try_from(digits).unwrap_or(2),
        equations,
        evaluations,
        lines,
        layout,
        letterhead,
        correlations,
        functions,
        shown: shown.into_iter().map(|(name, _)| name).collect(),
        shared: shared.into_keys().collect(),
        separate: separate.into_keys().collect(),
    };
    Some(CertificateFile { certificate, models, warnings, source: root.log.source.clone(), places })
}

/// One language or several, each once; English unless given.
fn languages(root: &Object<'_>) -> Vec<Language> {
    let mut languages = Vec::new();
    for (code, span) in texts(root, "language") {
        match Language::of_code(&code) {
            Some(language) if !languages.contains(&language) => languages.push(language),
            Some(_) => {
                let reason = format!("the language `{code}` stands here a second time");
                root.log.report(&span, DiagnosticKind::Certificate { reason });
            }
            None => {
                let allowed = Language::ALL.map(|language| language.code().to_owned()).to_vec();
                let diagnostic =
                    DiagnosticKind::NotOneOf { key: "language".into(), found: code, allowed };
                root.log.report(&span, diagnostic);
            }
        }
    }
    if languages.is_empty() {
        languages.push(Language::English);
    }
    languages
}

/// A text or a list of texts, with their places.
fn texts(object: &Object<'_>, key: &'static str) -> Vec<(String, Range<usize>)> {
    let Some(member) = object.get(key) else { return Vec::new() };
    let nodes = match &member.value.value {
        Json::List(list) => list.as_slice(),
        _ => std::slice::from_ref(&member.value),
    };
    let text = |node: &Node| match &node.value {
        Json::Text(text) => Some((text.clone(), node.span.clone())),
        other => {
            let what = format!("`{key}`");
            let diagnostic =
                DiagnosticKind::WrongType { what, found: other.kind(), expected: "a text" };
            object.log.report(&node.span, diagnostic);
            None
        }
    };
    nodes.iter().filter_map(text).collect()
}

/// Names with their places.
fn names(root: &Object<'_>, key: &'static str) -> BTreeMap<String, Range<usize>> {
    texts(root, key).into_iter().collect()
}
