//! Calibration certificates, one file for each format; all of them state the same rounded results.

mod administrative;
mod conformity;
mod csv;
mod dcc;
mod document;
mod functions;
mod json;
mod layout;
mod measurement;
mod regions;
mod sentences;
mod sheets;
mod stated;
mod trials_made;
mod words;
mod workbook;

pub use csv::csv;
#[cfg(test)]
pub(crate) use dcc::unit::unit as dcc_unit;
pub use dcc::{DccVersion, Needed, dcc, dcc_stylesheet, needed, with_stylesheet};
pub use json::json;
pub use workbook::xlsx;

use super::{document as look, plain};
use gumption_analysis::certificate::Issued;
use gumption_analysis::certificate::contents::Certificate;
use gumption_engine::task::Warning;

/// The contents of a certificate.
#[derive(Clone, Copy, Debug)]
pub struct CertificateReport<'a> {
    /// The request.
    pub certificate: &'a Certificate,
    /// The results.
    pub issued: &'a Issued,
    /// The model files, in the certificate's order.
    pub models: &'a [ModelSource<'a>],
    /// The text of the certificate file.
    pub text: &'a str,
    /// Its SHA-256, in hexadecimal.
    pub digest: &'a str,
    /// Warnings and notes, in order.
    pub warnings: &'a [Warning],
}

/// A model file of a certificate.
#[derive(Clone, Debug)]
pub struct ModelSource<'a> {
    /// The name in the certificate file.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
    /// Its SHA-256, in hexadecimal.
    pub digest: String,
    /// The contents of the tables that it reads, by name.
    pub tables: &'a [(String, Vec<u8>)],
    /// SHA-256 of every one of them, by name.
    pub files: Vec<(String, String)>,
}

/// The name of a file without its folders.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The names of the files that a digital calibration certificate has attached.
pub fn attached(report: &CertificateReport<'_>) -> Vec<String> {
    let models = report.models.iter().flat_map(|model| {
        std::iter::once(model.name).chain(model.tables.iter().map(|(name, _)| name.as_str()))
    });
    ["result.json", "certificate.json"].into_iter().chain(models).map(plain).collect()
}

/// The certificate as a page of at most 100 columns for a terminal.
pub fn table(report: &CertificateReport<'_>) -> String {
    look::text(|| document::of(report))
}

/// The certificate in GitHub Flavored Markdown.
pub fn markdown(report: &CertificateReport<'_>) -> String {
    look::markdown(|| document::of(report))
}

/// The certificate as a LaTeX file for `article` with `booktabs` and `siunitx`.
pub fn latex(report: &CertificateReport<'_>) -> String {
    look::latex(&document::of(report))
}

/// The certificate as one self-contained HTML file.
pub fn html(report: &CertificateReport<'_>) -> String {
    look::html(|| document::of(report))
}
