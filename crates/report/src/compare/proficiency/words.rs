//! The sentences about a proficiency test.

use crate::compare::sheets::in_unit;
use crate::number::{exact, significant, with_uncertainty};
use crate::plain;
use gumption_analysis::compare::{AssignedBy, ProficiencyTest, SigmaBy, Signal};

/// Maximum number of names in a sentence.
const MOST: usize = 10;

/// The result.
pub(in crate::compare) fn verdict(test: &ProficiencyTest, unit: &str) -> Vec<String> {
    vec![assigned(test, unit), sigma(test, unit), signals(test)]
}

fn assigned(test: &ProficiencyTest, unit: &str) -> String {
    let of = test.assigned;
    let count = test.rows.len();
    let by = match of.by {
        AssignedBy::AlgorithmA => format!("algorithm A of {count} results"),
        AssignedBy::Median => format!("median of {count} results"),
        AssignedBy::Stated { .. } => "as stated".to_owned(),
    };
    match of.standard_uncertainty {
        Some(u) if u > 0.0 => {
            let (value, u) = with_uncertainty(of.value, u, 2);
            let [value, u] = [value, u].map(|number| in_unit(&number, unit));
            format!("Assigned value {value} with u = {u} ({by}).")
        }
        _ => format!("Assigned value {} ({by}).", in_unit(&exact(of.value), unit)),
    }
}

fn sigma(test: &ProficiencyTest, unit: &str) -> String {
    let by = match test.sigma_by {
        SigmaBy::AlgorithmA => "algorithm A of the results".to_owned(),
        SigmaBy::NormalizedIqr => "normalized interquartile range of the results".to_owned(),
        SigmaBy::Stated(_) => "as stated".to_owned(),
        SigmaBy::ShareOfAssigned(share) => {
            format!("{} % of the assigned value, as stated", significant(100.0 * share, 3))
        }
    };
    let sigma = match test.sigma_by {
        SigmaBy::Stated(sigma) => exact(sigma),
        _ => significant(test.sigma, 3),
    };
    let sigma = in_unit(&sigma, unit);
    format!("Standard deviation for proficiency assessment {sigma} ({by}).")
}

fn signals(test: &ProficiencyTest) -> String {
    let all = test.rows.len();
    let name = if test.is_by_z_prime() { "z'" } else { "z" };
    let labels = |wanted: Option<Signal>| -> Vec<&str> {
        let rows = test.rows.iter().filter(|row| test.signal(row) == wanted);
        rows.map(|row| row.participant.label.as_str()).collect()
    };
    let without = labels(None).len();
    if without == all {
        return "No participant has a score.".to_owned();
    }
    let counted = |signal: Signal| {
        let found = labels(Some(signal));
        let names: Vec<String> = found.iter().take(MOST).map(|name| plain(name)).collect();
        let more = match found.len() - names.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let count = found.len();
        let plural = if count == 1 { "" } else { "s" };
        match count {
            0 => format!("no {}", signal.name()),
            _ => format!("{count} {}{plural} ({}{more})", signal.name(), names.join(", ")),
        }
    };
    let satisfactory = labels(Some(Signal::Satisfactory)).len();
    format!(
        "By the {name} scores, {satisfactory} of {all} results {} satisfactory, with {} and {}.",
        if satisfactory == 1 { "is" } else { "are" },
        counted(Signal::Warning),
        counted(Signal::Action)
    )
}

/// What the scores are.
pub(in crate::compare) fn explained(test: &ProficiencyTest) -> String {
    let mut said = "By ISO 13528:2022: z is the deviation from the assigned value divided by the \
        standard deviation for proficiency assessment. z' includes the uncertainty of the \
        assigned value, and decides if this uncertainty is above 0.3 of the standard deviation. A \
        modulus up to 2 is satisfactory, one between 2 and 3 gives a warning signal, and one from \
        3 an action signal. Zeta is the deviation divided by its standard uncertainty, En divided \
        by its expanded uncertainty (k = 2, satisfactory up to 1); both need the participant's \
        uncertainty."
        .to_owned();
    if !matches!(test.assigned.by, AssignedBy::Stated { .. }) {
        said.push_str(
            " The assigned value depends on the results; zeta and En do not include this \
             correlation.",
        );
    }
    if test.sigma_by == SigmaBy::NormalizedIqr || test.assigned.by == AssignedBy::Median {
        said.push_str(
            " Quartiles are interpolated linearly between the ordered results; the first and the \
             last are the quantiles for 0 and 1.",
        );
    }
    said
}
