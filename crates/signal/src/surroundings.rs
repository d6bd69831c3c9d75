//! What a step may use beside its signal, and what it may find.

use super::{Ends, Harmonics, Measured, Signal};

/// What a step may use beside its signal.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The recipe's frequency, in hertz; the first where there are several, 0 where it is unknown.
    pub frequency: f64,
    /// How many frequencies there are.
    pub frequencies: usize,
    /// The highest multiple that is fitted.
    pub multiples: u32,
    /// The signal of the reference channel, after its own steps.
    pub reference: Option<&'a Signal>,
    /// The step that the values are rounded to, in their unit; 0 where it is not known.
    pub resolution: f64,
}

/// What a step found beside the signal that it hands on.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is: `sampling rate`.
    pub name: String,
    /// Its unit: `Hz`; empty where it is the channel's.
    pub unit: String,
    /// The value.
    pub value: f64,
    /// Its standard uncertainty, in its unit, and the degrees of freedom of that; none where none is
    /// known.
    pub uncertainty: Option<(f64, f64)>,
}

impl Finding {
    /// A value with its standard uncertainty.
    pub fn of(name: &str, unit: &str, of: Measured) -> Self {
        let uncertainty = Some((of.standard_uncertainty, of.degrees_of_freedom));
        Self { uncertainty, ..Self::number(name, unit, of.value) }
    }

    /// A value of which no standard uncertainty is known.
    pub fn number(name: &str, unit: &str, value: f64) -> Self {
        Self { name: name.to_owned(), unit: unit.to_owned(), value, uncertainty: None }
    }

    /// The value with its standard uncertainty, where one is known.
    pub fn measured(&self) -> Option<Measured> {
        let (standard_uncertainty, degrees_of_freedom) = self.uncertainty?;
        Some(Measured { value: self.value, standard_uncertainty, degrees_of_freedom })
    }
}

impl Surroundings<'_> {
    /// The oscillation and its multiples below half the rate, which are taken out of the signal
    /// before the transform and put back after it.
    pub(super) fn ends(&self, signal: &Signal) -> Result<Ends, String> {
        if self.frequencies > 1 {
            return Err("this step takes one frequency in each row".to_owned());
        }
        Ok(Ends::Periodic(self.harmonics(signal)))
    }

    pub(super) fn harmonics(&self, signal: &Signal) -> Harmonics {
        let below = (1..=self.multiples).rev().find(|multiple| {
            self.frequency * f64::from(*multiple) < 0.499 * signal.rate
                && signal.values.len() > 2 * *multiple as usize + 3
        });
        Harmonics { frequency: self.frequency, count: below.unwrap_or(1) as usize }
    }

    /// One multiple above the highest that is fitted.
    pub(super) fn highest(&self) -> f64 {
        self.frequency * f64::from(self.multiples + 1)
    }
}
