//! One line for each hypothesis, in full precision, for programs and spreadsheets.

use crate::csv::{number, of_records, text};
use gumption_gap::{Diagnosis, Hypothesis};

const COLUMNS: [&str; 7] =
    ["kind", "effects", "prior", "probability", "log_evidence", "standard_error", "ess"];

/// The hypotheses as comma-separated values, most probable first: a header, then for each its kind
/// (`none`, `explained` or `unexplained`), its effects with ` + ` between them, and the figures of
/// the JSON answer. An empty cell stands for what is not defined.
pub fn csv(diagnosis: &Diagnosis) -> String {
    of_records(|writer| {
        writer.write_record(COLUMNS)?;
        diagnosis.hypotheses.iter().try_for_each(|of| writer.write_record(record(of)))
    })
}

fn record(hypothesis: &Hypothesis) -> [String; 7] {
    let kind = match hypothesis.effects.as_deref() {
        None => "unexplained",
        Some([]) => "none",
        Some(_) => "explained",
    };
    [
        kind.to_owned(),
        text(&hypothesis.effects.as_deref().unwrap_or_default().join(" + ")),
        number(Some(hypothesis.prior)),
        number(Some(hypothesis.probability)),
        number(Some(hypothesis.log_evidence)),
        number(Some(hypothesis.standard_error)),
        number(Some(hypothesis.effective_sample_size)),
    ]
}
