//! Posterior probabilities averaged over the Monte Carlo errors of the evidences.
//!
//! Each evidence is an estimate, and a probability is a ratio of them. An integral that rests on few
//! effective draws has an uncertain logarithm; taken as exact, it would make a hypothesis look as good
//! as certain, or impossible, by chance. The errors of the logarithms are therefore drawn, as t
//! distributions with the degrees of freedom of their effective sample sizes, the probabilities
//! computed for each draw, and averaged: poorly known evidences then give less extreme probabilities.

use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, elementary};
use gumption_engine::special;

/// An error of a logarithm below this changes no probability by more than about 0.0003.
const NEGLIGIBLE: f64 = 0.05;

/// A hypothesis with less than this probability changes the others by less than they are known.
const LEAST: f64 = 1e-3;

/// Draws of the errors.
const DRAWS: usize = 16 * COLUMN;

/// The logarithm of prior times evidence of a hypothesis, and how well it is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LnWeight {
    /// Prior times evidence, as a logarithm.
    pub(crate) ln: f64,
    /// Standard error of that logarithm.
    pub(crate) standard_error: f64,
    /// Effective number of draws that the standard error rests on.
    pub(crate) effective_sample_size: f64,
}

/// The posterior probabilities, averaged over the errors of the evidences. An error estimated from
/// n effective draws is distributed like t with n - 1 degrees of freedom, so that a probability
/// that rests on few draws comes out less sure. `share` is the probability of all of them together
/// beside what else may be true.
pub(crate) fn averaged(hypotheses: &[LnWeight], share: f64, seed: u64) -> Vec<f64> {
    let plain = shares(&hypotheses.iter().map(|known| known.ln).collect::<Vec<_>>());
    let uncertain: Vec<usize> = (0..hypotheses.len())
        .filter(|&h| plain[h] * share > LEAST && hypotheses[h].standard_error > NEGLIGIBLE)
        .collect();
    if uncertain.is_empty() {
        return plain;
    }
    let errors: Vec<Vec<f64>> = uncertain.iter().map(|&h| errors(hypotheses[h], seed, h)).collect();
    let mut sums = vec![0.0; hypotheses.len()];
    let mut ln: Vec<f64> = hypotheses.iter().map(|known| known.ln).collect();
    for draw in 0..DRAWS {
        for (&h, errors) in uncertain.iter().zip(&errors) {
            ln[h] = hypotheses[h].ln + errors[draw];
        }
        for (sum, share) in sums.iter_mut().zip(shares(&ln)) {
            *sum += share / DRAWS as f64;
        }
    }
    sums
}

fn errors(known: LnWeight, seed: u64, hypothesis: usize) -> Vec<f64> {
    let dof = (known.effective_sample_size - 1.0).max(1.0);
    let key = StreamKey::new(seed, "gap/doubt");
    let mut stream = key.block(hypothesis as u64);
    let mut errors = Vec::with_capacity(DRAWS);
    while errors.len() < DRAWS {
        let mut uniform = [0.0; COLUMN];
        stream.uniform(&mut uniform);
        errors.extend(uniform.map(|p| known.standard_error * special::student::quantile(p, dof)));
    }
    errors
}

/// The shares of numbers given by their logarithms.
fn shares(ln: &[f64]) -> Vec<f64> {
    let most = ln.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !most.is_finite() {
        return vec![0.0; ln.len()];
    }
    let own: Vec<f64> = ln.iter().map(|ln| elementary::exp(ln - most)).collect();
    let total: f64 = own.iter().sum();
    own.into_iter().map(|own| own / total).collect()
}

#[cfg(test)]
mod tests {
    use super::{LnWeight, averaged};

    fn known(ln: f64, standard_error: f64, effective_sample_size: f64) -> LnWeight {
        LnWeight { ln, standard_error, effective_sample_size }
    }

    #[test]
    fn well_known_evidences_keep_their_shares() {
        let got = averaged(&[known(3f64.ln(), 0.01, 4000.0), known(0.0, 0.0, 0.0)], 1.0, 1);
        assert!((got[0] - 0.75).abs() < 1e-12 && (got[1] - 0.25).abs() < 1e-12, "{got:?}");
    }

    #[test]
    fn a_poor_integral_is_less_sure() {
        // independent: E[1/(1 + exp(-(4 + 2 t)))] for t with 4 degrees of freedom is 0.90480 by
        // numerical integration, against 0.98201 without doubt; 2048 draws of a spread of 0.194
        // scatter by 0.0043, five times which is allowed
        let got = averaged(&[known(4.0, 2.0, 5.0), known(0.0, 0.0, 0.0)], 1.0, 1);
        assert!((got[0] - 0.90480).abs() < 0.0215, "{got:?}");
        assert!((got[0] + got[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_known_is_nothing_said() {
        assert_eq!(averaged(&[known(f64::NEG_INFINITY, 0.0, 0.0)], 1.0, 1), [0.0]);
    }
}
