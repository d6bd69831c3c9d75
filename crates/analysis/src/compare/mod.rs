//! Results of one quantity compared: two by two ([`pair`]), and those of many laboratories with a
//! reference value ([`laboratories`]; where they disagree [`consensus`]).

pub mod consensus;
mod definite;
pub mod laboratories;
pub mod pair;
mod subset;

pub use consensus::{ConsensusValue, Estimator, HartungKnapp};
pub use laboratories::{Comparison, DegreeOfEquivalence, Impossible, Laboratory};
pub use pair::{ComparedPair, ResultPair, StatedResult};
pub use subset::Ties;

use gumption_engine::special;

/// The coverage factor of expanded uncertainties in the answers.
pub const FACTOR: f64 = 2.0;

/// The probability that two values of one quantity differ by as much or more: 2 (1 - Phi(|d|/u)).
fn probability(difference: f64, u: f64) -> f64 {
    2.0 * special::normal::sf(difference.abs() / u)
}
