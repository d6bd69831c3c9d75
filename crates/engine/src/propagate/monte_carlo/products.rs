//! Sums of products of outputs: a number for each pair of them. Of many outputs they are added up in
//! waves of chunks, always in the order of the chunks, so that few sets of them are held at a time
//! and the size of the waves does not show in the figures.
#![allow(unsafe_code)] // instructions of a path that the machine has

use std::ops::Range;

use super::plan::{Chunks, LANES, Plan, Products, TOGETHER, pairwise};
use super::sums::Sums;
#[cfg(target_arch = "x86_64")]
use super::{avx2, avx512};
use crate::distribution::BLOCK;
use crate::number::CodePath;
#[cfg(target_arch = "x86_64")]
use crate::number::Instructions;

/// Bytes for sums of products at a time.
const MEMORY: usize = 256 << 20;

/// Outputs in a tile: the values of two tiles stay in the second-level cache while all pairs of them
/// are added up.
const TILE: usize = 32;

/// Adds the products of a block's values to the sums; `count` trials of the block count. Every pair
/// is added up by itself, so neither the tiles nor what runs side by side shows in the sums.
#[inline(always)]
pub(super) fn add<'s>(
    path: CodePath,
    values: &[[f64; BLOCK]],
    count: usize,
    plans: &[Plan],
    sums: impl Iterator<Item = &'s mut Sums>,
) {
    let outputs = values.len().min(plans.len());
    if outputs < 2 {
        return;
    }
    let mut products: Vec<&mut Vec<f64>> = sums.map(|sums| &mut sums.products).collect();
    for (output, products) in products.iter_mut().enumerate() {
        products.resize(outputs.saturating_sub(output + 1), 0.0);
    }
    let mut rows = vec![[0.0; BLOCK]; outputs.min(TILE)];
    let mut columns = vec![[0.0; BLOCK]; outputs.saturating_sub(TILE).min(TILE)];
    for first in (0..outputs).step_by(TILE) {
        let own = first..(first + TILE).min(outputs);
        standardize(&values[own.clone()], count, &plans[own.clone()], &mut rows);
        for second in (first..outputs).step_by(TILE) {
            let others = second..(second + TILE).min(outputs);
            if second > first {
                standardize(&values[others.clone()], count, &plans[others.clone()], &mut columns);
            }
            let columns = if second > first { &columns } else { &rows };
            for i in own.clone().step_by(TOGETHER) {
                for j in (second.max(i)..others.end).step_by(TOGETHER) {
                    // at an odd end the last output stands for the one that is missing
                    let a = std::array::from_fn(|k| &rows[(i + k).min(own.end - 1) - first]);
                    let b = std::array::from_fn(|k| &columns[(j + k).min(others.end - 1) - second]);
                    let found: [[f64; TOGETHER]; TOGETHER] = sums_of_products(path, a, b, count);
                    for (i, found) in (i..own.end).zip(found) {
                        for (j, found) in (j..others.end).zip(found).filter(|(j, _)| *j > i) {
                            products[i][j - i - 1] += found;
                        }
                    }
                }
            }
        }
    }
}

/// The first `count` values about their outputs' references, then zeros.
#[inline(always)]
fn standardize(values: &[[f64; BLOCK]], count: usize, plans: &[Plan], out: &mut [[f64; BLOCK]]) {
    for ((values, plan), out) in values.iter().zip(plans).zip(out) {
        let inverse = 1.0 / plan.reference.scale;
        let middle = plan.reference.middle;
        for (value, out) in values[..count].iter().zip(out.iter_mut()) {
            *out = (value - middle) * inverse;
        }
        out[count..].fill(0.0);
    }
}

/// The sums of products of the first `count` values of each a and b, in lanes, then lane by lane. What
/// stands behind them in the last chunk is zero.
#[inline(always)]
fn sums_of_products(
    path: CodePath,
    a: [&[f64; BLOCK]; TOGETHER],
    b: [&[f64; BLOCK]; TOGETHER],
    count: usize,
) -> [[f64; TOGETHER]; TOGETHER] {
    let chunks = count.div_ceil(LANES);
    let a = a.map(|a| &a.as_chunks::<LANES>().0[..chunks]);
    let b = b.map(|b| &b.as_chunks::<LANES>().0[..chunks]);
    lanes_of_products(path, a, b).map(|lanes| lanes.map(pairwise))
}

/// The same in lanes.
#[inline(always)]
fn lanes_of_products(path: CodePath, a: Chunks<'_>, b: Chunks<'_>) -> Products {
    #[cfg(target_arch = "x86_64")]
    match path.instructions() {
        // SAFETY: the machine has the instructions of a path.
        Instructions::Avx512 => return unsafe { avx512::products(a, b) },
        // SAFETY: as above.
        Instructions::Avx2 => return unsafe { avx2::products(a, b) },
        Instructions::Baseline => {}
    }
    let _ = path;
    let mut products = [[[0.0; LANES]; TOGETHER]; TOGETHER];
    for (products, a) in products.iter_mut().zip(a) {
        for (lanes, b) in products.iter_mut().zip(b) {
            for (a, b) in a.iter().zip(b) {
                for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
                    *lane += a * b;
                }
            }
        }
    }
    products
}

/// Some chunks in waves.
pub(super) fn waves(chunks: Range<u64>, outputs: usize) -> impl Iterator<Item = Range<usize>> {
    let bytes = size_of::<f64>() * outputs * outputs.saturating_sub(1) / 2;
    let wave = (MEMORY / bytes.max(1)).max(1);
    let (start, end) = (chunks.start as usize, chunks.end as usize);
    (start..end).step_by(wave).map(move |first| first..(first + wave).min(end))
}

#[cfg(test)]
mod tests {
    use super::super::plan::Reference;
    use super::super::totals::{ChunkSums, Totals};
    use super::super::windows::Windows;
    use super::*;

    /// Outputs that are lines of each other, more than a tile of them: coefficients 1 and -1 but for
    /// rounding.
    #[test]
    fn correlations_of_lines_are_one() {
        let outputs = 2 * TILE + 5;
        let slope =
            |output: usize| (if output % 3 == 1 { -1.0 } else { 1.0 }) * output as f64 - 0.5;
        let value = |output: usize, trial: usize| 5.0 + slope(output) * trial as f64;
        let values: Vec<[f64; BLOCK]> =
            (0..outputs).map(|o| std::array::from_fn(|trial| value(o, trial))).collect();
        let plan = |o: usize| Plan {
            reference: Reference {
                middle: value(o, 40),
                scale: 30.0 * slope(o).abs(),
                limits: [0.0, 0.0],
            },
            windows: Windows::ALL,
            kept: 1.0,
        };
        let plans: Vec<Plan> = (0..outputs).map(plan).collect();
        let mut sums = vec![Sums::default(); outputs];
        for _ in 0..2 {
            for ((sums, values), plan) in sums.iter_mut().zip(&values).zip(&plans) {
                sums.add(CodePath::BASELINE, &values[..100], plan.reference);
            }
            add(CodePath::BASELINE, &values, 100, &plans, sums.iter_mut());
        }
        let found = Totals::of(ChunkSums { trials: 200, outputs: sums }, Vec::new()).correlations();
        let pairs = (0..outputs).flat_map(|i| (i + 1..outputs).map(move |j| (i, j)));
        assert_eq!(found.len(), outputs * (outputs - 1) / 2);
        for ((i, j), r) in pairs.zip(found) {
            let sign = (slope(i) * slope(j)).signum();
            assert!((r - sign).abs() < 1e-13, "{i}, {j}: {r}");
        }
    }

    /// The same bits on every path.
    #[test]
    fn products_are_the_same_on_every_path() {
        let values: Vec<[f64; BLOCK]> = (0..2 * TOGETHER)
            .map(|o| std::array::from_fn(|trial| 1.0 / (trial as f64 + o as f64 - 13.7)))
            .collect();
        let (a, b) = values.split_at(TOGETHER);
        for count in [8, 16, 40, BLOCK] {
            let of = |path| {
                let [a, b] = [a, b].map(|some| std::array::from_fn(|k| &some[k]));
                sums_of_products(path, a, b, count).map(|sums| sums.map(f64::to_bits))
            };
            for path in CodePath::available() {
                assert_eq!(of(path), of(CodePath::BASELINE), "{count} values, {path:?}");
            }
        }
    }

    #[test]
    fn few_outputs_are_one_wave() {
        let only = |chunks, outputs| -> Option<Range<usize>> {
            let mut waves = waves(0..chunks, outputs);
            waves.next().filter(|_| waves.next().is_none())
        };
        assert_eq!(only(100_000, 3), Some(0..100_000));
        assert_eq!(only(5, 1), Some(0..5));
        // 36 MB a chunk
        assert_eq!(waves(0..10, 3000).collect::<Vec<_>>(), [0..7, 7..10]);
        assert_eq!(waves(0..2, 100_000).collect::<Vec<_>>(), [0..1, 1..2]);
    }
}
