//! The blind check of the diagnosis: truths are drawn, sealed, diagnosed from the data alone, and
//! only then compared.

mod drawn_noise;
mod score;
mod truth;

pub use drawn_noise::CheckedNoise;
pub use score::{
    BesideScores, BlindCheckScores, BlindDraw, Confusion, Reliability, SmallestEffect, score,
};
#[cfg(test)]
pub(crate) use truth::truth_with;
pub use truth::{Truth, TruthKind, truth};
