//! One line for each hypothesis, in full precision, for programs and spreadsheets.

use crate::csv::{number, text};
use gumption_gap::{Diagnosis, Hypothesis};

const COLUMNS: [&str; 7] =
    ["kind", "effects", "prior", "probability", "log_evidence", "standard_error", "ess"];

/// The hypotheses as comma-separated values, most probable first: a header, then for each its kind
/// (`none`, `explained` or `unexplained`), its effects with ` + ` between them, and the figures of
/// the JSON answer. An empty cell stands for what is not defined.
pub fn csv(diagnosis: &Diagnosis) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut written = writer.write_record(COLUMNS);
    for hypothesis in &diagnosis.hypotheses {
        written = written.and_then(|()| writer.write_record(record(hypothesis)));
    }
    // writing to memory cannot fail, and all records have as many cells
    debug_assert!(written.is_ok(), "{written:?}");
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
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
