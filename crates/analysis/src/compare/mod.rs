//! Compares results for one quantity: in pairs ([`pair`]), and of many laboratories with a
//! reference value ([`laboratories`]; [`consensus`] if they are inconsistent) or with an assigned value
//! ([`proficiency`], from [`robust`] estimates); and the study of a gauge by parts and operators
//! ([`gauge`]).

pub mod consensus;
mod definite;
pub mod gauge;
pub mod laboratories;
pub mod pair;
pub mod proficiency;
pub mod robust;
mod subset;

pub use consensus::{ConsensusValue, Estimator, HartungKnapp};
pub use gauge::{GaugeStudy, Interaction, StudyReading};
pub use laboratories::{Comparison, DegreeOfEquivalence, Impossible, Laboratory};
pub use pair::{ComparedPair, ResultPair, StatedResult};
pub use proficiency::{AssignedBy, Participant, ProficiencyTest, SigmaBy, Signal};
pub use subset::Ties;

use gumption_engine::model::Tolerance;
use gumption_engine::special;

/// The coverage factor of expanded uncertainties in answers.
pub const FACTOR: f64 = 2.0;

/// The probability that two values of one quantity differ by at least this much: 2 (1 -
/// Phi(|d|/u)).
fn probability(difference: f64, u: f64) -> f64 {
    2.0 * special::normal::sf(difference.abs() / u)
}

/// Whether two values differ by at most the expanded uncertainty of their difference, apart from
/// rounding of the difference and of the distance to any limit ([`Tolerance::holds`]).
fn agree([a, b]: [f64; 2], expanded: f64) -> bool {
    let of_difference = f64::EPSILON * (a.abs() + b.abs());
    Tolerance { lower: None, upper: Some(expanded) }.holds((a - b).abs() - of_difference)
}
