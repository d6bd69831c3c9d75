//! Differential-evolution Markov chains (DE-MC; ter Braak 2006, Statistics and Computing 16, 239).
//!
//! A posterior with a long narrow ridge is found by a mixture about its mode only where the mixture
//! draws. Chains that run side by side reach the ends of it: each moves by the difference of two
//! others, so that steps follow whatever shape the population has, without tuning. What they visit is
//! not used as a sample but to fit another component of the proposal.

use crate::integral::mixture::standard_normals;
use crate::latent::ln_prior;
use crate::likelihood::Likelihood;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, Column, elementary};

/// Every so many generations steps are whole differences, which leap from mode to mode.
const LEAP: usize = 8;

/// The chains' first block of a hypothesis' random numbers: the draws of its integral begin with
/// block 0, and those of the prior end with the last.
const FIRST_BLOCK: u64 = 1 << 32;

/// Generations between those that are handed back.
const THIN: usize = 4;

/// Walks a column of chains for some generations; gives their places in the second half.
pub(crate) fn sample(
    likelihood: &Likelihood<'_>,
    start: Vec<Column>,
    generations: usize,
    key: StreamKey,
) -> Vec<Vec<Column>> {
    let unknowns = start.len();
    let bounded = likelihood.bounded();
    let density = |scores: &[Column]| -> Vec<f64> {
        let mut ln = likelihood.log_likelihood(scores, COLUMN);
        for (column, bounded) in scores.iter().zip(&bounded) {
            for (ln, score) in ln.iter_mut().zip(&column.0) {
                *ln += ln_prior(*bounded, *score);
            }
        }
        ln
    };
    let mut here = start;
    let mut ln_here = density(&here);
    let mut visited = Vec::new();
    let usual = 2.38 / (2.0 * unknowns.max(1) as f64).sqrt();
    let mut jitter = Column::ZERO;
    for generation in 0..generations {
        let mut stream = key.block(FIRST_BLOCK + generation as u64);
        let mut choices = [0.0; 4 * COLUMN];
        stream.uniform(&mut choices);
        let mut there = here.clone();
        let leap = generation % LEAP == LEAP - 1;
        for (column, out) in here.iter().zip(&mut there) {
            standard_normals(&mut stream, &mut jitter);
            for lane in 0..COLUMN {
                let place = |share: f64| ((share * COLUMN as f64) as usize).min(COLUMN - 1);
                let (a, b) = (place(choices[lane]), place(choices[COLUMN + lane]));
                // the length varies, so that no step is of the chains' own spacing only
                let length = if leap { 1.0 } else { usual * (0.4 + choices[2 * COLUMN + lane]) };
                out.0[lane] += length * (column.0[a] - column.0[b]) + 1e-4 * jitter.0[lane];
            }
        }
        let ln_there = density(&there);
        for lane in 0..COLUMN {
            let accepted =
                elementary::ln(choices[3 * COLUMN + lane]) < ln_there[lane] - ln_here[lane];
            if accepted {
                ln_here[lane] = ln_there[lane];
                for (here, there) in here.iter_mut().zip(&there) {
                    here.0[lane] = there.0[lane];
                }
            }
        }
        if generation >= generations / 2 && generation % THIN == 0 {
            visited.push(here.clone());
        }
    }
    visited
}
