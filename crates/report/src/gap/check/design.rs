//! The design that a check was done at.

use gumption_gap::Case;
use gumption_gap::NamedQuantity;
use gumption_gap::check::CheckedNoise;

/// What a page says of the case whose design was checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedDesign {
    /// The case's title.
    pub title: String,
    /// Number of rows of data.
    pub rows: usize,
    /// Names of the outputs that were measured.
    pub outputs: Vec<String>,
    /// The conditions, each with its least and greatest value.
    pub conditions: Vec<(NamedQuantity, [f64; 2])>,
    /// Number of candidate effects.
    pub effects: usize,
    /// What the noise of the draws was.
    pub noise: CheckedNoise,
}

impl CheckedDesign {
    /// The design of a case, at which data with this noise were drawn.
    pub fn of(case: &Case, noise: CheckedNoise) -> Self {
        let rows = &case.task.rows;
        let measured = case.model.outputs.iter().zip(&case.observed);
        let measured = measured.filter(|(_, observed)| observed.is_some());
        // the last ones are not conditions but what somebody else's simulation says
        let own = case.model.conditions.len().saturating_sub(case.simulated);
        let conditions = case.model.conditions.iter().take(own).enumerate();
        let conditions = conditions.map(|(place, condition)| {
            let values = rows.iter().filter_map(|row| row.conditions.get(place));
            let ends = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| {
                [a.min(*value), b.max(*value)]
            });
            let unit = condition.unit.text().to_owned();
            (NamedQuantity { name: condition.name.clone(), unit }, ends)
        });
        Self {
            title: case.task.title.clone(),
            rows: rows.len(),
            outputs: measured.map(|(output, _)| output.quantity.name.clone()).collect(),
            conditions: conditions.collect(),
            effects: case.candidates.len(),
            noise,
        }
    }
}
