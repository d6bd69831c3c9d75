//! The tables of an audit.

use super::AuditReport;
use crate::number::{MISSING, justified, position, rounded, significant, to};
use crate::plain;
use crate::sheet::Sheet;
use gumption_assumptions::{EvidenceTest, InputAudit, Kept, OutputAudit, Sobol, VariantChange};

/// Decimal places of a percentage.
const TENTHS: i32 = -1;

/// Decimal places of a Sobol index, at most.
const INDEX: i32 = -3;

/// The order of the shapes' columns.
const SHAPES: [&str; 6] = ["normal", "rectangular", "triangular", "arcsine", "trapezoidal", "t"];

/// What each assumption does to one output: shares, Sobol indices, widths.
pub(super) fn widths(report: &AuditReport<'_>, output: &OutputAudit) -> Sheet {
    let mut sheet = Sheet::default();
    let inputs = || output.inputs.iter();
    sheet.text("input", inputs().map(|input| plain(report.name(input.variable))));
    sheet.text("distribution", inputs().map(|input| input.distribution.name().to_owned()));
    sheet.numbers("share\nin %", inputs().map(|input| share(input.share)));
    sheet.numbers("Sobol\nfirst", inputs().map(|input| index(input.sobol.as_ref(), 0)));
    sheet.numbers("Sobol\ntotal", inputs().map(|input| index(input.sobol.as_ref(), 1)));
    sheet.text("width\nhalved", inputs().map(|input| width(input.halved.as_ref())));
    sheet.text("width\ndoubled", inputs().map(|input| width(input.doubled.as_ref())));
    sheet.text("allowed change\nof the width", inputs().map(allowed));
    sheet
}

/// What other shapes do to one output; `None` without any.
pub(super) fn shapes(report: &AuditReport<'_>, output: &OutputAudit) -> Option<Sheet> {
    let rows: Vec<(&InputAudit, Kept)> = output
        .inputs
        .iter()
        .flat_map(|input| [Kept::StandardUncertainty, Kept::Limits].map(|kept| (input, kept)))
        .filter(|(input, kept)| input.alternatives.iter().any(|other| other.kept == *kept))
        .collect();
    let mut sheet = Sheet::default();
    sheet.text("input", rows.iter().map(|(input, _)| plain(report.name(input.variable))));
    sheet.text("stated", rows.iter().map(|(input, _)| input.distribution.name().to_owned()));
    let kept = |kept: Kept| match kept {
        Kept::StandardUncertainty => "u",
        Kept::Limits => "limits",
    };
    sheet.text("kept", rows.iter().map(|(_, of)| kept(*of).to_owned()));
    for shape in SHAPES {
        let cell = |(input, kept): &(&InputAudit, Kept)| {
            let found = input
                .alternatives
                .iter()
                .find(|other| other.kept == *kept && other.distribution.name() == shape);
            found.map_or_else(missing, |other| change(&other.moved))
        };
        let cells: Vec<String> = rows.iter().map(cell).collect();
        if cells.iter().any(|cell| cell != MISSING) {
            sheet.text(shape, cells);
        }
    }
    (!rows.is_empty()).then_some(sheet)
}

/// What the readings say; `None` without any.
pub(super) fn evidence(report: &AuditReport<'_>) -> Option<Sheet> {
    let all = &report.audit.evidence;
    let mut sheet = Sheet::default();
    sheet.text("input", all.iter().map(|of| plain(report.name(of.variable))));
    sheet.numbers("readings", all.iter().map(|of| of.readings.to_string()));
    sheet.text("width", all.iter().map(|of| width_name(of).to_owned()));
    let digits = |of: &EvidenceTest| position(of.supported.estimate, 3);
    sheet.numbers("stated", all.iter().map(|of| to(of.supported.stated, digits(of))));
    sheet.numbers("supported", all.iter().map(|of| to(of.supported.estimate, digits(of))));
    let ends =
        |of: &EvidenceTest| of.supported.interval.map(|end| to(end, digits(of))).join(" to ");
    sheet.text("95 % interval", all.iter().map(ends));
    let unit =
        |of: &EvidenceTest| report.task.variables.get(of.variable).map_or("", |v| v.unit.text());
    sheet.text("unit", all.iter().map(|of| unit(of).to_owned()));
    sheet.numbers("p-value", all.iter().map(|of| p_value(of.p_value)));
    sheet.text("verdict", all.iter().map(|of| of.verdict.words().to_owned()));
    (!all.is_empty()).then_some(sheet)
}

fn width_name(of: &EvidenceTest) -> &'static str {
    match of.supported.parameter {
        "half_width" => "half-width",
        "std" => "standard deviation",
        other => other,
    }
}

fn missing() -> String {
    MISSING.to_owned()
}

fn p_value(p: f64) -> String {
    if p < 0.001 { "<0.001".to_owned() } else { rounded(p, -3) }
}

fn share(share: Option<f64>) -> String {
    share.map_or_else(missing, |share| rounded(100.0 * share, TENTHS))
}

/// An index without the digits that its standard error does not justify.
fn index(sobol: Option<&Sobol>, which: usize) -> String {
    sobol.map_or_else(missing, |sobol| {
        let value = [sobol.first, sobol.total][which];
        justified(value, Some(INDEX), sobol.standard_error[which])
    })
}

/// A change in percent, or that there is none to be seen.
pub(super) fn change(moved: &VariantChange) -> String {
    match moved.change {
        None => missing(),
        Some(_) if !moved.is_seen() => "none".to_owned(),
        Some(change) => {
            let error = 100.0 * moved.error.unwrap_or(0.0);
            signed(100.0 * change, |value| justified(value, Some(TENTHS), error)) + " %"
        }
    }
}

fn signed(value: f64, text: impl Fn(f64) -> String) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    sign.to_owned() + &text(value)
}

fn width(moved: Option<&VariantChange>) -> String {
    moved.map_or_else(missing, change)
}

fn allowed(input: &InputAudit) -> String {
    let Some([low, high]) = input.allowed else {
        return missing();
    };
    let end = |end: f64| {
        if end.is_infinite() {
            "any".to_owned()
        } else if end.abs() < 0.1 {
            signed(100.0 * end, |value| rounded(value, TENTHS)) + " %"
        } else {
            signed(100.0 * end, |value| {
                if value.abs() < 1000.0 { rounded(value, 0) } else { significant(value, 3) }
            }) + " %"
        }
    };
    format!("{} to {}", end(low), end(high))
}
