//! The answer for programs, written row by row.

use serde::Serialize;

use crate::answer::pretty;
use crate::words::{Note, notes};
use gumption_analysis::compare::proficiency::{ParticipantScores, is_satisfactory};
use gumption_analysis::compare::{ProficiencyTest, Signal};
use gumption_engine::task::Warning;

#[derive(Serialize)]
struct Answer<'a> {
    gumption: &'static str,
    scheme: &'static str,
    unit: Option<&'a str>,
    assigned: Assigned,
    sigma_pt: f64,
    sigma_pt_method: &'static str,
    deciding_score: &'static str,
    rows: Vec<Row<'a>>,
    warnings: Vec<Note<'a>>,
}

#[derive(Serialize)]
struct Assigned {
    value: f64,
    standard_uncertainty: Option<f64>,
    method: &'static str,
}

#[derive(Serialize)]
struct Row<'a> {
    label: &'a str,
    value: f64,
    #[serde(rename = "U")]
    expanded: Option<f64>,
    k: Option<f64>,
    deviation: f64,
    z: Option<f64>,
    z_prime: Option<f64>,
    zeta: Option<f64>,
    en: Option<f64>,
    /// What the deciding score says.
    signal: Option<&'static str>,
    signals: Signals,
}

#[derive(Serialize)]
struct Signals {
    z: Option<&'static str>,
    z_prime: Option<&'static str>,
    zeta: Option<&'static str>,
    en: Option<&'static str>,
}

/// The scores as JSON, ending in a newline.
pub(in crate::compare) fn json(test: &ProficiencyTest, unit: &str, warnings: &[Warning]) -> String {
    let assigned = Assigned {
        value: test.assigned.value,
        standard_uncertainty: test.assigned.standard_uncertainty,
        method: test.assigned.by.name(),
    };
    pretty(&Answer {
        gumption: env!("CARGO_PKG_VERSION"),
        scheme: "iso13528",
        unit: (!unit.is_empty()).then_some(unit),
        assigned,
        sigma_pt: test.sigma,
        sigma_pt_method: test.sigma_by.name(),
        deciding_score: if test.is_by_z_prime() { "z_prime" } else { "z" },
        rows: test.rows.iter().map(|row| of_row(test, row)).collect(),
        warnings: notes(warnings),
    })
}

fn of_row<'a>(test: &ProficiencyTest, row: &'a ParticipantScores) -> Row<'a> {
    let name = |score: Option<f64>| score.map(|score| Signal::of(score).name());
    let stated = row.participant.uncertainty;
    Row {
        label: &row.participant.label,
        value: row.participant.value,
        expanded: stated.map(|stated| stated.expanded),
        k: stated.map(|stated| stated.factor),
        deviation: row.deviation,
        z: row.z,
        z_prime: row.z_prime,
        zeta: row.zeta,
        en: row.normalized_error,
        signal: test.signal(row).map(Signal::name),
        signals: Signals {
            z: name(row.z),
            z_prime: name(row.z_prime),
            zeta: name(row.zeta),
            en: row.normalized_error.map(|en| {
                if is_satisfactory(en) { Signal::Satisfactory.name() } else { UNSATISFACTORY }
            }),
        },
    }
}

/// The word for a normalized error above 1 (ISO/IEC 17043).
const UNSATISFACTORY: &str = "unsatisfactory";
