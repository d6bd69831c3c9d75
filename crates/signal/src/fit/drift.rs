//! A drift of the level, smooth over the record: Legendre polynomials that are fitted together with
//! the oscillations.
//!
//! A level that moves steadily is no noise: what a fit of the oscillations alone takes of it has the
//! sign and the size that the phases give it, the same at each repetition. Polynomials of a few
//! degrees have any warming up, sagging or charging that is slow over the record.

use nalgebra::DMatrix;

use crate::passes::BLOCK;
use crate::sine_fit::{Waves, dot};
use crate::turns::Turns;

/// The highest degree that is fitted.
pub(crate) const MOST_DEGREES: usize = 6;

/// Coefficients over their standard deviations from which on a level drifts: of white noise one of
/// six in 2600 records has that.
pub(crate) const CLEAR: f64 = 4.0;

/// Sums over a record of products of polynomials with each other and with the waves of tones, with
/// instants tau counted from the middle. What is not here is zero: odd sums.
#[derive(Clone, Debug)]
pub(crate) struct DriftProducts {
    /// Of the polynomials of degrees 1, 2, ... themselves.
    pub(crate) level: Vec<f64>,
    /// Of each with each.
    pub(crate) own: DMatrix<f64>,
    /// For each tone and degree: with its cosine, where the degree is even, or its sine, where it is
    /// odd.
    pub(crate) waves: Vec<Vec<f64>>,
    /// The same with tau times its sine, where the degree is even, or its cosine.
    pub(crate) moments: Vec<Vec<f64>>,
}

/// The polynomials of degrees 1, 2, ... at the samples of a block that begins with sample `first`, one
/// column for each degree.
pub(crate) fn fill(columns: &mut [Vec<f64>], samples: u64, first: u64, length: usize) {
    if columns.is_empty() {
        return;
    }
    for column in columns.iter_mut() {
        column.resize(length, 0.0);
    }
    for i in 0..length {
        let each = legendre(place(samples, (first + i as u64) as f64));
        columns.iter_mut().zip(each).for_each(|(column, value)| column[i] = value);
    }
}

/// Where an instant, in sample intervals from the first of so many samples, is between -1 and 1.
fn place(samples: u64, instant: f64) -> f64 {
    let count = samples as f64;
    (2.0 * instant - (count - 1.0)) / count
}

/// The polynomials of degrees 1, 2, ... at a place.
fn legendre(place: f64) -> impl Iterator<Item = f64> {
    let next = move |(degree, before, now): &(f64, f64, f64)| {
        let next = ((2.0 * degree + 1.0) * place * now - degree * before) / (degree + 1.0);
        Some((degree + 1.0, *now, next))
    };
    std::iter::successors(Some((1.0, 1.0, place)), next).map(|(_, _, now)| now)
}

/// The sum of polynomials of degrees 1, 2, ... with their factors, at an instant.
pub(crate) fn at(factors: &[f64], samples: u64, instant: f64) -> f64 {
    factors
        .iter()
        .zip(legendre(place(samples, instant)))
        .map(|(factor, value)| factor * value)
        .sum()
}

/// The polynomials of degrees 1 to `degrees` at all of `samples` values.
pub(crate) fn columns(degrees: usize, samples: usize) -> Vec<Vec<f64>> {
    let mut columns = vec![Vec::new(); degrees];
    fill(&mut columns, samples as u64, 0, samples);
    columns
}

/// The largest ratio of a coefficient of a polynomial to its standard deviation in white noise, of
/// values whose mean is zero.
pub(crate) fn clearest(values: &[f64], deviation: f64) -> f64 {
    let ratio = |column: &Vec<f64>| {
        dot(values, column, 0.0).abs() / (dot(column, column, 0.0).sqrt() * deviation)
    };
    columns(MOST_DEGREES, values.len()).iter().map(ratio).fold(0.0, f64::max)
}

impl DriftProducts {
    /// Up to a degree, for tones of so many turns from each sample to the next.
    pub(crate) fn new(degrees: usize, steps: &[Turns], samples: u64) -> Self {
        let (mut level, mut own) = (vec![0.0; degrees], DMatrix::zeros(degrees, degrees));
        // with cosine and sine, as they are and times tau, counted from the first sample
        let mut sums = vec![vec![[0.0; 4]; degrees]; steps.len()];
        let mut waves = Waves::new(steps.len(), degrees);
        let half = (samples as f64 - 1.0) / 2.0;
        let blocks = if degrees == 0 { 0..0 } else { 0..samples };
        for first in blocks.step_by(BLOCK) {
            let length = (samples - first).min(BLOCK as u64) as usize;
            waves.fill(steps, samples, first, length);
            let Waves { cosines, sines, drift } = &waves;
            let instants = |column: &Vec<f64>| -> Vec<f64> {
                (first..).zip(column).map(|(at, value)| (at as f64 - half) * value).collect()
            };
            let turning: Vec<Vec<f64>> = drift.iter().map(instants).collect();
            for (sums, (cosine, sine)) in sums.iter_mut().zip(cosines.iter().zip(sines)) {
                for (sums, (plain, turning)) in sums.iter_mut().zip(drift.iter().zip(&turning)) {
                    let pairs =
                        [(plain, cosine), (plain, sine), (turning, cosine), (turning, sine)];
                    for (sum, (a, b)) in sums.iter_mut().zip(pairs) {
                        *sum += dot(a, b, 0.0);
                    }
                }
            }
            for (i, a) in drift.iter().enumerate() {
                level[i] += a.iter().sum::<f64>();
                // an even one times an odd one sums to zero
                for (j, b) in drift.iter().enumerate().filter(|(j, _)| (i + j) % 2 == 0) {
                    own[(i, j)] += dot(a, b, 0.0);
                }
            }
        }
        let turned = |moment: bool| -> Vec<Vec<f64>> {
            let of = |(sums, step): (&Vec<[f64; 4]>, &Turns)| {
                let (sin, cos) = step.to_middle(samples).sin_cos();
                let with = |(place, sums): (usize, &[f64; 4])| {
                    let [c, s, tau_c, tau_s] = *sums;
                    let (c, s) = if moment { (tau_c, tau_s) } else { (c, s) };
                    let is_even = place % 2 == 1;
                    if is_even == moment { s * cos - c * sin } else { c * cos + s * sin }
                };
                sums.iter().enumerate().map(with).collect()
            };
            sums.iter().zip(steps).map(of).collect()
        };
        Self { level, own, waves: turned(false), moments: turned(true) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_those_of_legendre() {
        let columns = columns(4, 1000);
        for i in [0, 137, 500, 999] {
            let x = (2.0 * i as f64 - 999.0) / 1000.0;
            let expected = [
                x,
                (3.0 * x * x - 1.0) / 2.0,
                (5.0 * x.powi(3) - 3.0 * x) / 2.0,
                (35.0 * x.powi(4) - 30.0 * x * x + 3.0) / 8.0,
            ];
            for (column, expected) in columns.iter().zip(expected) {
                // a few roundings of numbers below 10
                assert!((column[i] - expected).abs() < 1e-14);
            }
        }
    }
}
