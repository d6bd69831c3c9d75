//! Notes on digits and rounding of the stated expanded uncertainties.

use gumption_analysis::certificate::Issued;
use gumption_analysis::certificate::rounding::takes_away_too_much;
use gumption_engine::decimal::significant;
use gumption_engine::task::Warning;
use gumption_files::CertificateFile;

/// Maximum number of digits of a stated expanded uncertainty (ILAC-P14:09/2020, 5.3).
const MOST_DIGITS: u32 = 2;

/// Notes about more digits than an accredited certificate may state, and about expanded
/// uncertainties that rounding reduces too much.
pub(super) fn notes(file: &CertificateFile, issued: &Issued) -> Vec<Warning> {
    let digits = file.certificate.digits;
    let mut notes = Vec::new();
    if digits > MOST_DIGITS {
        let text = format!(
            "U is stated to {digits} significant digits; an accredited certificate may have at most two \
             (ILAC-P14:09/2020, 5.3)"
        );
        notes.push(Warning::new("more-than-two-digits", "digits".to_owned(), text));
    }
    let rows = issued.statements.iter().zip(&file.certificate.lines).enumerate();
    for (number, (statement, line)) in rows {
        let expanded = statement.expanded_uncertainty;
        let lost = statement.rounded.filter(|to| takes_away_too_much(expanded, *to));
        let task = file.certificate.evaluations.get(line.evaluation).map(|asked| &asked.task);
        let output = task.and_then(|task| task.model.outputs.get(line.output));
        let Some((rounded, output)) = lost.zip(output) else { continue };
        let row = number + 1;
        let stated = output.quantity.unit.after(&rounded.to_string());
        let percent = significant(100.0 * (1.0 - rounded.value() / expanded), 2);
        let text = format!(
            "row {row}: U is stated as {stated}, {percent} % less than {}; EA-4/02 M:2022, 6.3, allows a \
             rounding that takes away at most 5 %: `\"rounding\": \"ea\"` rounds up there",
            output.quantity.unit.after(&significant(expanded, 3))
        );
        notes.push(Warning::new("rounded-away", format!("row {row}"), text));
    }
    notes
}
