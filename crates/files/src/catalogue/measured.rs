//! Numbers of a prior that follow the data: `{"times": 0.02, "lowest": "f"}`.

use super::super::effect_context::EffectContext;
use gumption_text::json::{Json, Member};

/// A multiple of something that was measured.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) times: f64,
    pub(super) of: Multiplied,
    /// The condition or output.
    pub(super) name: String,
}

/// What is multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Multiplied {
    /// The lowest value of a condition above zero, in SI units.
    Lowest,
    /// The highest value of a condition, in SI units.
    Highest,
    /// One over the highest value of a condition.
    OverHighest,
    /// The largest measured modulus of an output, in its unit.
    Largest,
    /// One over the largest measured modulus of an output.
    OverLargest,
}

const KEYS: [(&str, Multiplied, &str); 5] = [
    ("lowest", Multiplied::Lowest, "the lowest"),
    ("highest", Multiplied::Highest, "the highest"),
    ("over_highest", Multiplied::OverHighest, "one over the highest"),
    ("largest", Multiplied::Largest, "the largest measured"),
    ("over_largest", Multiplied::OverLargest, "one over the largest measured"),
];

impl Measured {
    /// What the members say, if they are those of such a number.
    pub(super) fn of(members: &[Member]) -> Option<Self> {
        let [times, measured] = members else { return None };
        let (_, of, _) = KEYS.iter().find(|(key, ..)| measured.key == *key)?;
        let Json::Text(name) = &measured.value.value else { return None };
        let times = (times.key == "times").then(|| times.value.number())??;
        Some(Self { times, of: *of, name: name.clone() })
    }

    /// Whether its name is that of a condition rather than of an output.
    pub(super) fn of_condition(&self) -> bool {
        !matches!(self.of, Multiplied::Largest | Multiplied::OverLargest)
    }

    /// In words.
    pub(super) fn words(&self) -> String {
        let of = KEYS
            .iter()
            .find(|(_, multiplied, _)| *multiplied == self.of)
            .map_or("", |(.., words)| words);
        format!("{} times {of} {}", self.times, self.name)
    }

    /// The number, with the name that the sim has for its quantity; `None` where it is not a finite
    /// number above zero.
    pub(super) fn value(&self, sim: &EffectContext<'_>, name: &str) -> Option<f64> {
        let measured = match self.of {
            Multiplied::Lowest => extreme(sim, name, f64::min),
            Multiplied::Highest | Multiplied::OverHighest => extreme(sim, name, f64::max),
            Multiplied::Largest | Multiplied::OverLargest => largest(sim, name),
        }?;
        let value = match self.of {
            Multiplied::Lowest | Multiplied::Highest | Multiplied::Largest => self.times * measured,
            Multiplied::OverHighest | Multiplied::OverLargest => self.times / measured,
        };
        (value.is_finite() && value > 0.0).then_some(value)
    }
}

/// The least or greatest modulus above zero of a condition, or of an input's estimates.
fn extreme(sim: &EffectContext<'_>, name: &str, better: fn(f64, f64) -> f64) -> Option<f64> {
    let rows = &sim.task.rows;
    let condition = sim.sim.conditions.iter().position(|condition| condition.name == name);
    let values: Vec<f64> = match condition {
        Some(place) => {
            let unit = &sim.sim.conditions.get(place)?.unit;
            let values = rows.iter().filter_map(|row| row.conditions.get(place));
            values.map(|&value| sim.sim.numbers.number(value, unit)).collect()
        }
        None => {
            let place = sim.task.variables.iter().position(|variable| variable.name == name)?;
            let unit = &sim.task.variables.get(place)?.unit;
            let distributions = rows.iter().filter_map(|row| row.distributions.get(place));
            distributions
                .map(|distribution| sim.sim.numbers.number(distribution.mean(), unit))
                .collect()
        }
    };
    let sizes = values.into_iter().map(f64::abs).filter(|size| *size > 0.0 && size.is_finite());
    sizes.reduce(better)
}

/// The largest measured modulus of an output.
fn largest(sim: &EffectContext<'_>, name: &str) -> Option<f64> {
    let place = sim.sim.outputs.iter().position(|output| output.quantity.name == name)?;
    let observed = sim.observed.get(place)?.as_ref()?;
    let largest = observed.values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    (largest > 0.0).then_some(largest)
}
