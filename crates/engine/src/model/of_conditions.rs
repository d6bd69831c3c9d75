//! Limits and capabilities that follow the measuring point: formulas of the conditions.

use std::fmt;
use std::sync::Arc;

use super::COMPUTED_DIGITS;
use crate::decimal::to_digits;

/// A function of the conditions' values.
type ConditionsFunction = dyn Fn(&[f64]) -> f64 + Send + Sync;

/// A figure of an output that follows the conditions, in the output's unit.
#[derive(Clone)]
pub struct OfConditions(Arc<ConditionsFunction>);

impl OfConditions {
    /// The figure that this function gives of the conditions' values, each in its unit.
    pub fn new(of: impl Fn(&[f64]) -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(of))
    }

    /// The figure at these values of the conditions, without the last bits that binary sums leave.
    ///
    /// ```
    /// use gumption_engine::model::OfConditions;
    ///
    /// let limit = OfConditions::new(|conditions| 1e-4 * conditions[0] + 0.02);
    /// assert_eq!(limit.at(&[1000.0]), 0.12);
    /// ```
    pub fn at(&self, conditions: &[f64]) -> f64 {
        to_digits((self.0)(conditions), COMPUTED_DIGITS)
    }
}

impl fmt::Debug for OfConditions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("OfConditions")
    }
}

/// What of an output follows the conditions; the rest is that of the output.
#[derive(Clone, Debug, Default)]
pub struct FollowingConditions {
    /// The lower tolerance limit.
    pub lower: Option<OfConditions>,
    /// The upper tolerance limit.
    pub upper: Option<OfConditions>,
    /// What the laboratory's capability has beside its share of the estimate.
    pub capability: Option<OfConditions>,
}
