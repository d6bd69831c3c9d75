//! The number of Monte Carlo trials behind the rows of a certificate: a run continues while clause
//! 8 is undecided, so it may exceed the requested number.

use super::CertificateReport;

/// The smallest and the largest number of trials for the rows of a model file, counted from 0;
/// `None` without trials.
pub(super) fn of_file(report: &CertificateReport<'_>, file: usize) -> Option<[u64; 2]> {
    let asked = report.certificate.evaluations.iter().zip(&report.issued.evaluations);
    let rows = asked.filter(|(asked, _)| asked.file == file).flat_map(|(_, found)| &found.rows);
    let outputs = rows.flat_map(|row| &row.outputs);
    let made = outputs.filter_map(|output| Some(output.monte_carlo.as_deref()?.trials));
    made.fold(None, |range, trials| {
        let [least, most] = range.unwrap_or([trials; 2]);
        Some([trials.min(least), trials.max(most)])
    })
}
