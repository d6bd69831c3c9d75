//! How many Monte Carlo trials the rows of a certificate rest on: a run goes on where clause 8 is
//! undecided, so that it may be more than were asked for.

use super::CertificateReport;

/// The fewest and the most trials of the rows of a model file, counted from 0; `None` without any.
pub(super) fn of_file(report: &CertificateReport<'_>, file: usize) -> Option<[u64; 2]> {
    let asked = report.certificate.evaluations.iter().zip(&report.issued.evaluations);
    let rows = asked.filter(|(asked, _)| asked.file == file).flat_map(|(_, found)| &found.rows);
    let outputs = rows.flat_map(|row| &row.outputs);
    let made = outputs.filter_map(|output| Some(output.monte_carlo.as_ref()?.trials));
    made.fold(None, |range, trials| {
        let [least, most] = range.unwrap_or([trials; 2]);
        Some([trials.min(least), trials.max(most)])
    })
}
