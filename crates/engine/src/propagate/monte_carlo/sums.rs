//! Sums of powers of the trials, added up in a fixed order about a pilot value.
#![allow(unsafe_code)] // instructions of a path that the machine has

use super::plan::{LANES, Reference, pairwise};
#[cfg(target_arch = "x86_64")]
use super::{avx2, avx512};
use crate::number::CodePath;
#[cfg(target_arch = "x86_64")]
use crate::number::Instructions;

/// Sums over trials of the powers 1 to 4 of one output, and of its products with the outputs after
/// it ([`super::products`]), all about the reference.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// How many values lie within the output's tolerance limits.
    pub(crate) inside: u64,
    pub(crate) powers: [f64; 4],
    pub(crate) products: Vec<f64>,
}

impl Sums {
    /// Adds a block's values. Every lane adds its own trials, and the lanes are added in order, so
    /// the result does not depend on the width of the machine's vectors.
    #[inline(always)]
    pub(crate) fn add(&mut self, path: CodePath, values: &[f64], reference: Reference) {
        let [lower, upper] = reference.limits;
        self.inside += if lower == f64::NEG_INFINITY && upper == f64::INFINITY {
            values.len() as u64
        } else if lower > upper {
            values.iter().map(|&v| u64::from((v >= lower) | (v <= upper))).sum::<u64>()
        } else {
            values.iter().map(|&v| u64::from((v >= lower) & (v <= upper))).sum::<u64>()
        };
        for (sum, lane) in self.powers.iter_mut().zip(powers(path, values, reference)) {
            *sum += pairwise(lane);
        }
    }

    /// The sums of two sets of trials.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.inside += other.inside;
        for (sum, term) in self.powers.iter_mut().zip(other.powers) {
            *sum += term;
        }
        // a chunk without trials has no products
        if self.products.len() < other.products.len() {
            self.products.resize(other.products.len(), 0.0);
        }
        for (sum, term) in self.products.iter_mut().zip(&other.products) {
            *sum += term;
        }
    }
}

/// For the powers 1 to 4 of the values' distances from the reference the sum in each lane.
#[inline(always)]
fn powers(path: CodePath, values: &[f64], reference: Reference) -> [[f64; LANES]; 4] {
    let (chunks, rest) = values.as_chunks();
    let mut lanes = powers_of_chunks(path, chunks, reference);
    add_powers(&mut lanes, rest, reference);
    lanes
}

/// The same of values that fill all lanes.
#[inline(always)]
fn powers_of_chunks(
    path: CodePath,
    chunks: &[[f64; LANES]],
    reference: Reference,
) -> [[f64; LANES]; 4] {
    #[cfg(target_arch = "x86_64")]
    match path.instructions() {
        // SAFETY: the machine has the instructions of a path.
        Instructions::Avx512 => return unsafe { avx512::powers(chunks, reference) },
        // SAFETY: as above.
        Instructions::Avx2 => return unsafe { avx2::powers(chunks, reference) },
        Instructions::Baseline => {}
    }
    let _ = path;
    let mut lanes = [[0.0; LANES]; 4];
    for chunk in chunks {
        add_powers(&mut lanes, chunk, reference);
    }
    lanes
}

/// Adds a value to each lane, from the first on.
#[inline(always)]
fn add_powers(lanes: &mut [[f64; LANES]; 4], values: &[f64], reference: Reference) {
    let inverse = 1.0 / reference.scale;
    for (i, &value) in values.iter().enumerate() {
        let d = (value - reference.middle) * inverse;
        let d2 = d * d;
        lanes[0][i] += d;
        lanes[1][i] += d2;
        lanes[2][i] += d2 * d;
        lanes[3][i] += d2 * d2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same bits on every path, whatever part of a register the last values fill.
    #[test]
    fn powers_are_the_same_on_every_path() {
        let reference = Reference { middle: 0.01, scale: 0.3, limits: [0.0, 1.0] };
        for count in 0..=4 * LANES {
            let values: Vec<f64> = (0..count).map(|i| 1.0 / (i as f64 - 13.7)).collect();
            let of = |path| powers(path, &values, reference).map(|lanes| lanes.map(f64::to_bits));
            for path in CodePath::available() {
                assert_eq!(of(path), of(CodePath::BASELINE), "{count} values, {path:?}");
            }
        }
    }
}
