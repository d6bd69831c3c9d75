//! Sobol indices: the share of the output's variance that an input causes by itself (first-order),
//! and with all that it does together with others (total). By Jansen's estimators (M. J. W. Jansen,
//! Computer Physics Communications 117 (1999) 35; Saltelli et al., ibid. 181 (2010) 259, Table 2):
//! with samples A and B, and AB_i that is A with input i from B,
//!
//! S_i = 1 - mean((f(B) - f(AB_i))^2) / 2V,  ST_i = mean((f(A) - f(AB_i))^2) / 2V
//!
//! Quantities that are drawn together are taken from B together: they have one index as a set.

use rayon::prelude::*;

use super::sampler::{PreparedSet, Sampler};
use super::spread::{batches, standard_error, trials_in};
use gumption_engine::distribution::BLOCK;
use gumption_engine::propagate::Control;

/// The indices of one set of quantities for one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sobol {
    /// First-order index.
    pub first: f64,
    /// Total index.
    pub total: f64,
    /// Numerical standard errors of both.
    pub standard_error: [f64; 2],
}

/// Sums of one batch for one output.
#[derive(Clone, Debug, Default)]
struct Sums {
    count: f64,
    /// Of both samples about the reference, and their squares.
    sum: f64,
    squares: f64,
    /// For each set the squared differences to B and to A.
    differences: Vec<[f64; 2]>,
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.differences.resize(other.differences.len(), [0.0; 2]);
        for (mine, theirs) in self.differences.iter_mut().zip(&other.differences) {
            mine[0] += theirs[0];
            mine[1] += theirs[1];
        }
    }

    /// First-order and total index of a set; `None` without a variance.
    fn indices(&self, set: usize) -> Option<[f64; 2]> {
        let mean = self.sum / (2.0 * self.count);
        let variance = (self.squares - 2.0 * self.count * mean * mean) / (2.0 * self.count - 1.0);
        let [to_b, to_a] = *self.differences.get(set)?;
        let share = |squares: f64| squares / (2.0 * self.count * variance);
        (variance > 0.0 && to_a.is_finite() && to_b.is_finite())
            .then(|| [1.0 - share(to_b), share(to_a)])
    }
}

/// For each output the indices of each set of places; `None` for an output that does not vary or has
/// trials that are not finite. The whole is `None` if stopped.
pub(super) fn indices(
    sampler: &Sampler,
    sets: &[Vec<usize>],
    trials: u64,
    control: &Control<'_>,
) -> Option<Vec<Vec<Option<Sobol>>>> {
    // the outputs of a block for both samples and every set that is taken at a time
    let block = size_of::<[f64; BLOCK]>() * sampler.outputs() + sampler.prepared_bytes();
    let at_a_time = (control.memory / block.max(1)).saturating_sub(2).max(1);
    let mut all = vec![Vec::with_capacity(sets.len()); sampler.outputs()];
    for sets in sets.chunks(at_a_time) {
        let found = indices_of(sampler, sets, trials, control)?;
        all.iter_mut().zip(found).for_each(|(all, found)| all.extend(found));
    }
    Some(all)
}

/// The indices of some of the sets.
fn indices_of(
    sampler: &Sampler,
    sets: &[Vec<usize>],
    trials: u64,
    control: &Control<'_>,
) -> Option<Vec<Vec<Option<Sobol>>>> {
    let outputs = sampler.outputs();
    let sets: Vec<PreparedSet<'_>> = sets.iter().map(|set| sampler.prepared_set(set)).collect();
    // about a value of the output, so that a common large part costs no digits
    let mut first = sampler.blocks(2);
    sampler.mixed(control.path, 0, &[], &mut sampler.buffers(), &mut first);
    let references: Vec<f64> = first[0].iter().map(|values| values[0]).collect();
    let batch = |blocks: std::ops::Range<u64>| {
        let mut buffers = sampler.buffers();
        let mut out = sampler.blocks(2 + sets.len());
        let empty = Sums { differences: vec![[0.0; 2]; sets.len()], ..Sums::default() };
        let mut sums = vec![empty; outputs];
        for block in blocks {
            if control.is_stopped() {
                return None;
            }
            sampler.mixed(control.path, block, &sets, &mut buffers, &mut out);
            let count = trials_in(block, trials);
            for (output, (sums, reference)) in sums.iter_mut().zip(&references).enumerate() {
                // the first sample gives the sets: it is B
                let (b, a) = (&out[0][output][..count], &out[1][output][..count]);
                sums.count += count as f64;
                for value in a.iter().chain(b) {
                    let d = value - reference;
                    sums.sum += d;
                    sums.squares += d * d;
                }
                for (mixed, found) in out.iter().skip(2).zip(&mut sums.differences) {
                    let (mut to_b, mut to_a) = (0.0, 0.0);
                    for ((mixed, a), b) in mixed[output][..count].iter().zip(a).zip(b) {
                        to_b += (b - mixed) * (b - mixed);
                        to_a += (a - mixed) * (a - mixed);
                    }
                    found[0] += to_b;
                    found[1] += to_a;
                }
            }
            control.advance((count * (2 + sets.len())) as u64);
        }
        Some(sums)
    };
    let batches: Option<Vec<Vec<Sums>>> = batches(trials).into_par_iter().map(batch).collect();
    let batches = batches?;
    let of = |output: usize, set: usize| {
        let parts = || batches.iter().filter_map(|batch| batch.get(output));
        let mut all = Sums::default();
        parts().for_each(|part| all.add(part));
        let [first, total] = all.indices(set)?;
        let own: Option<Vec<[f64; 2]>> = parts().map(|part| part.indices(set)).collect();
        let errors = own.map_or([f64::NAN; 2], |own| {
            [0, 1].map(|which| {
                let values: Vec<f64> = own.iter().map(|indices| indices[which]).collect();
                standard_error(&values)
            })
        });
        Some(Sobol { first, total, standard_error: errors })
    };
    Some((0..outputs).map(|o| (0..sets.len()).map(|set| of(o, set)).collect()).collect())
}
