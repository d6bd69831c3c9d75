//! Propagation: from what is known about the inputs to what is known about the outputs, by the law
//! of propagation of uncertainty ([`gum`], JCGM 100) and by the Monte Carlo method
//! ([`monte_carlo`], JCGM 101) at the same time, and the comparison of the two ([`validate`],
//! JCGM 101, clause 8).

mod control;
mod evaluation;
pub mod gum;
pub mod monte_carlo;
pub mod validate;
mod warnings;

pub use control::Control;
pub use evaluation::{
    Conformity, Evaluation, EvaluationError, OutputEvaluation, RowEvaluation, evaluate, trial_hash,
};
pub use warnings::warnings;
