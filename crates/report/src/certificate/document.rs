//! The certificate as a document.

use super::stated;
use super::words::{self, beside};
use super::{CertificateReport, administrative, functions, sentences, sheets};
use crate::document::{Block, Document};
use crate::plain;
use crate::sheet::Sheet;
use crate::table::comparison;
use gumption_engine::task::Trials;

/// The whole document.
pub(super) fn of(report: &CertificateReport<'_>) -> Document {
    let certificate = report.certificate;
    let languages = certificate.languages.as_slice();
    let mut document = Document {
        title: administrative::title(report),
        language: languages.first().map_or("en", |language| language.code()),
        ..Document::default()
    };
    let about = administrative::sheet(report);
    if about.rows() > 0 {
        document.table(about);
    }
    document.section(beside(languages, |w| w.results));
    document.table(sheets::results(report));
    document.section(beside(languages, |w| w.uncertainty));
    for language in languages {
        document.text(sentences::coverage(report, *language).join(" "));
    }
    functions::sections(&mut document, report);
    if sheets::are_correlated(report) {
        document.section(beside(languages, |w| w.correlation));
        if certificate.lines.len() <= sheets::MOST_CORRELATED {
            document.table(sheets::correlations(report));
            for language in languages {
                document.text(words::of(*language).correlated);
            }
        } else {
            for language in languages {
                let rows = certificate.lines.len().to_string();
                document.text(words::of(*language).many.replace("{rows}", &rows));
            }
        }
    }
    conformity(&mut document, report);
    let remarks = &certificate.administrative.remarks;
    if !remarks.is_empty() {
        document.section(beside(languages, |w| w.remarks));
        let texts = remarks.iter().flat_map(|remark| remark.all(languages));
        document.blocks.push(Block::List(texts.map(plain).collect()));
    }
    document.section(beside(languages, |w| w.provenance));
    document.table(provenance(report));
    document
}

/// What is decided about rows with a tolerance.
fn conformity(document: &mut Document, report: &CertificateReport<'_>) {
    let languages = &report.certificate.languages;
    let rows = stated::rows(report);
    let mut texts = Vec::new();
    for row in &rows {
        for said in
            row.found.conformity.iter().flat_map(|of| comparison::conformity(row.quantity, of))
        {
            texts.push(format!("{} {}: {said}", beside(languages, |w| w.row), row.number));
        }
    }
    if !texts.is_empty() {
        document.section(beside(languages, |w| w.conformity));
        document.blocks.push(Block::List(texts));
    }
}

/// Program, settings and digests.
fn provenance(report: &CertificateReport<'_>) -> Sheet {
    let languages = report.certificate.languages.as_slice();
    let mut lines = vec![
        (beside(languages, |w| w.program), format!("gumption {}", env!("CARGO_PKG_VERSION"))),
        (beside(languages, |w| w.certificate_file), report.digest.to_owned()),
    ];
    for (number, model) in report.models.iter().enumerate() {
        lines.push((format!("{}, SHA-256", plain(model.name)), model.digest.clone()));
        let files = model.files.iter();
        lines.extend(
            files.map(|(name, digest)| (format!("{}, SHA-256", plain(name)), digest.clone())),
        );
        let asked = report.certificate.evaluations.iter().find(|asked| asked.file == number);
        if let Some(settings) = asked.map(|asked| asked.task.settings) {
            let trials = match settings.trials {
                Trials::Fixed(trials) => trials.to_string(),
                Trials::Adaptive => beside(languages, |w| w.adaptive),
            };
            let of = |word: String| format!("{}: {word}", plain(model.name));
            lines.push((of(beside(languages, |w| w.trials)), trials));
            lines.push((of(beside(languages, |w| w.seed)), settings.seed.to_string()));
        }
    }
    let mut sheet = Sheet::default();
    sheet.text("", lines.iter().map(|(name, _)| name.clone()));
    sheet.text("", lines.into_iter().map(|(_, value)| value));
    sheet
}
