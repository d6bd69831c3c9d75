//! The certificate as a workbook.

use std::io;

use super::layout::TitledSheet;
use super::sentences::{SentenceLanguage, SentencePlace};
use super::words::beside;
use super::{
    CertificateReport, administrative, conformity, document, functions, layout, sentences, sheets,
};
use crate::fits;
use crate::workbook::{Book, failed};

/// The certificate as a workbook: a sheet with the certificate, whose cells hold the stated
/// numbers, one with the numbers before rounding, and one with the correlation coefficients of the
/// rows.
///
/// # Errors
/// The format has limits, such as the number of rows.
pub fn xlsx(report: &CertificateReport<'_>) -> io::Result<Vec<u8>> {
    let languages = &report.certificate.languages;
    let title = administrative::title(report);
    let mut book = Book::new(&title).map_err(failed)?;
    let mut write = || {
        let mut leaf = book.leaf("Certificate")?;
        leaf.title(0, &title)?;
        let mut row = 2;
        for (name, text) in administrative::lines(report) {
            leaf.line(row, &format!("{name}: {text}"))?;
            row += 1;
        }
        row += 1;
        for TitledSheet { title, sheet } in layout::tables(report) {
            if !title.is_empty() {
                leaf.line(row, &title)?;
                row += 1;
            }
            row = leaf.table(row, &sheet)? + 1;
        }
        for of in SentenceLanguage::on_page(report) {
            for said in sentences::coverage(report, of, SentencePlace::Table) {
                leaf.line(row, &said)?;
                row += 1;
            }
            for said in conformity::on_page(report, of) {
                leaf.line(row, &said)?;
                row += 1;
            }
            row += 1;
        }
        let remarks = languages.iter().flat_map(|language| document::remarks(report, *language));
        let signature = document::signature(report).map(|below| format!("{below}: ____________"));
        let end = [beside(languages, |w| w.end)];
        let below = remarks
            .chain([String::new()])
            .chain(signature)
            .chain([String::new()])
            .chain(document::provenance(report))
            .chain(end);
        for line in below {
            leaf.line(row, &line)?;
            row += 1;
        }
        book.push(leaf)?;
        for (number, of) in report.certificate.functions.iter().enumerate() {
            let mut leaf = book.leaf(&format!("Function {}", number + 1))?;
            leaf.title(0, &functions::title(of, languages))?;
            let mut row = 2;
            for said in SentenceLanguage::on_page(report)
                .into_iter()
                .flat_map(|said| functions::sentences(of, said))
            {
                leaf.line(row, &said)?;
                row += 1;
            }
            row = leaf.table(row + 1, &functions::values(report, of))? + 1;
            row = leaf.table(row, &functions::parameters(report, of))? + 1;
            if let Some(sheet) = fits::correlations(&of.curve) {
                leaf.table(row, &sheet)?;
            }
            book.push(leaf)?;
        }
        let mut leaf = book.leaf("Unrounded")?;
        leaf.table(0, &sheets::unrounded(report))?;
        book.push(leaf)?;
        if sheets::are_correlated(report) {
            let mut leaf = book.leaf("Correlations")?;
            leaf.table(0, &sheets::correlations(report))?;
            book.push(leaf)?;
        }
        Ok(())
    };
    write().map_err(failed)?;
    book.bytes().map_err(failed)
}
