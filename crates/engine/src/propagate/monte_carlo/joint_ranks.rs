//! Joint ranks: a small sample of a run's trials that represents the dependence of its outputs.
//!
//! A result file keeps the quantile function of every output and, for their dependence, the ranks of
//! all outputs in some thousands of trials: an empirical copula. Correlation coefficients would not
//! do, as they do not determine a joint distribution. A random sample of M trials would give the
//! probability of a region with a standard deviation of sqrt(p (1 - p)/M). A stratified one scatters
//! less: all trials are cut recursively into cells of equally many trials, each time across the
//! direction in which the cell is spread out most (as a k-d tree is built), and one trial of each
//! cell is kept. Only cells that a region's boundary crosses then contribute to the scatter. The
//! directions are uncorrelated combinations of the outputs' normal scores, each in its own standard
//! deviation, so that cells are thin where outputs nearly cancel.

use super::block::RowTrials;
use super::quantiles::{are_held, of_all, quantiles};
use super::repeat::collected;
use crate::parallel;
use crate::propagate::Control;
use crate::special;

/// Values of all outputs together that are looked at, at most: 32 MiB, and about as much again for
/// their scores and for each thread that sorts.
const MOST_VALUES: usize = 1 << 22;

/// Trials that are looked at, at most.
const MOST_TRIALS: usize = 1 << 20;

/// Trials of a cell whose spread is looked at, about as many at most.
const LOOKED_AT: usize = 4096;

/// A direction with less than this share of an output's variance is left out.
const NEGLIGIBLE: f64 = 1e-6;

/// For each output its ranks, from 1, in at most `rows` of the first `count` trials: entry i of all
/// outputs is of the same trial. An output that does not vary has none. `None` if the run was
/// stopped.
pub(crate) fn joint_ranks(
    trials: &RowTrials,
    count: u64,
    rows: usize,
    control: &Control<'_>,
) -> Option<Vec<Vec<u32>>> {
    let values = collected(trials, count.min(most_trials(trials)), control)?;
    Some(ranks_of(&values, rows))
}

/// Trials that are looked at, at most.
fn most_trials(trials: &RowTrials) -> u64 {
    (MOST_VALUES / trials.outputs().max(1)).min(MOST_TRIALS) as u64
}

/// For each output its quantiles, and its joint ranks.
pub type QuantilesAndRanks = (Vec<Vec<f64>>, Vec<Vec<u32>>);

/// The quantiles at the probabilities Phi(score), and joint ranks in at most `rows` trials, of
/// trials that are made once for both where they are held and looked at as a whole.
pub(crate) fn quantiles_and_ranks(
    trials: &RowTrials,
    count: u64,
    scores: &[f64],
    rows: usize,
    control: &Control<'_>,
) -> Option<QuantilesAndRanks> {
    if are_held(count, trials.outputs(), control.memory) && count <= most_trials(trials) {
        let values = collected(trials, count, control)?;
        let ranks = ranks_of(&values, rows);
        return Some((of_all(values, scores)?, ranks));
    }
    let quantiles = quantiles(trials, count, scores, control)?;
    Some((quantiles, joint_ranks(trials, count, rows, control)?))
}

/// The ranks of at most `rows` trials that represent all.
fn ranks_of(values: &[Vec<f64>], rows: usize) -> Vec<Vec<u32>> {
    let varies = |values: &Vec<f64>| values.iter().any(|value| *value != values[0]);
    let varying: Vec<&Vec<f64>> = values.iter().filter(|values| varies(values)).collect();
    let count = values.first().map_or(0, Vec::len);
    let of_rank = scores_of_ranks(count);
    let scores = parallel::map(varying, |values| scores(values, &of_rank));
    let mut chosen = chosen(&independent(scores), count, rows);
    chosen.sort_unstable();
    parallel::map(values, |values| {
        if !varies(values) {
            return Vec::new();
        }
        let of_chosen: Vec<f64> = chosen.iter().map(|&index| values[index as usize]).collect();
        let mut ranks = vec![0; of_chosen.len()];
        for (rank, index) in (1..).zip(order(&of_chosen)) {
            ranks[index as usize] = rank;
        }
        ranks
    })
}

/// The indices of values in ascending order; of equal ones the first comes first.
fn order(values: &[f64]) -> Vec<u32> {
    let keys = values.iter().enumerate().map(|(index, value)| (ordered_bits(*value), index as u32));
    let mut keys: Vec<(u64, u32)> = keys.collect();
    sort_by_keys(&mut keys);
    keys.into_iter().map(|(_, index)| index).collect()
}

/// The same of the leading 32 bits of what the values range over: nearer neighbours stay in order.
fn order_nearly(values: &[f64]) -> Vec<u32> {
    let bits = values.iter().map(|value| ordered_bits(*value));
    let (least, most) =
        bits.fold((u64::MAX, 0), |(least, most), bits| (least.min(bits), most.max(bits)));
    let shift = (u64::BITS - most.saturating_sub(least).leading_zeros()).saturating_sub(u32::BITS);
    let key = |value: f64| ((ordered_bits(value) - least) >> shift) as u32;
    let keys = values.iter().enumerate().map(|(index, value)| (key(*value), index as u32));
    let mut keys: Vec<(u32, u32)> = keys.collect();
    sort_by_keys(&mut keys);
    keys.into_iter().map(|(_, index)| index).collect()
}

/// So many keys and more are sorted digit by digit, which takes as many passes whatever their order.
const RADIX: usize = 1 << 14;

/// Bits of a digit.
const DIGIT: u32 = 11;

/// Whole numbers in the order of the values (that of `f64::total_cmp`).
fn ordered_bits(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// Sorts by the keys; equal ones stay in order.
fn sort_by_keys<K: Copy + Ord + Default + Into<u64>>(keys: &mut Vec<(K, u32)>) {
    if keys.len() < RADIX {
        keys.sort_unstable();
        return;
    }
    // from the last digit to the first
    let mut sorted = vec![(K::default(), 0); keys.len()];
    for shift in (0..8 * size_of::<K>()).step_by(DIGIT as usize) {
        let digit = |key: K| (key.into() >> shift) as usize & ((1 << DIGIT) - 1);
        let mut next = [0; 1 << DIGIT];
        keys.iter().for_each(|&(key, _)| next[digit(key)] += 1);
        if next.contains(&keys.len()) {
            continue;
        }
        let mut before = 0;
        for next in &mut next {
            (*next, before) = (before, before + *next);
        }
        for &entry in keys.iter() {
            let place = &mut next[digit(entry.0)];
            sorted[*place] = entry;
            *place += 1;
        }
        std::mem::swap(keys, &mut sorted);
    }
}

/// Scores that one thread computes before it takes others.
const SCORES_AT_A_TIME: usize = 4096;

/// The standard normal score of each rank of so many values.
fn scores_of_ranks(count: usize) -> Vec<f32> {
    let score = |rank: usize| special::normal::quantile((rank as f64 + 0.5) / count as f64) as f32;
    let chunk = |first: usize| -> Vec<f32> {
        (first..count.min(first + SCORES_AT_A_TIME)).map(score).collect()
    };
    parallel::map((0..count).step_by(SCORES_AT_A_TIME), chunk).concat()
}

/// Standard normal scores of the ranks, all different ones. They only say where trials are looked
/// for, and values that hardly differ may change places.
fn scores(values: &[f64], of_rank: &[f32]) -> Vec<f32> {
    let mut scores = vec![0.0; values.len()];
    for (score, index) in of_rank.iter().zip(order_nearly(values)) {
        scores[index as usize] = *score;
    }
    scores
}

/// At most `rows` of the `count` trials, as many as there are of them, that represent all.
fn chosen(scores: &[Vec<f32>], count: usize, rows: usize) -> Vec<u32> {
    let mut chosen = vec![0; rows.min(count)];
    match scores {
        [] => {}
        // an odd one is filled up: every number of scores is compiled for itself
        [x] => choose_among([x, x], 1, count, &mut chosen),
        [x, y] => choose_among([x, y], 2, count, &mut chosen),
        [x, y, z] => choose_among([x, y, z, z], 3, count, &mut chosen),
        [x, y, z, w] => choose_among([x, y, z, w], 4, count, &mut chosen),
        _ => {
            let mut trials: Vec<u32> = (0..count as u32).collect();
            let along = |direction: usize, trial: &u32| whole(scores[direction][*trial as usize]);
            choose((scores.len(), &along, &|trial| *trial), &mut trials, &mut chosen);
        }
    }
    chosen
}

/// A score as a whole number that grows with it evenly, which is compared faster.
fn whole(score: f32) -> u32 {
    // scores of a million trials lie within 6, those of directions within some times that
    ((score + 64.0) * (1 << 25) as f32) as u32
}

/// The choice with the scores of a trial beside it: what is moved together is read together.
fn choose_among<const N: usize>(
    scores: [&Vec<f32>; N],
    directions: usize,
    count: usize,
    chosen: &mut [u32],
) {
    let trial = |index: u32| (scores.map(|scores| whole(scores[index as usize])), index);
    let mut trials: Vec<([u32; N], u32)> = (0..count as u32).map(trial).collect();
    let along = |direction: usize, trial: &([u32; N], u32)| trial.0[direction];
    let index = |trial: &([u32; N], u32)| trial.1;
    choose((directions, &along, &index), &mut trials, chosen);
}

/// Cuts the trials into as many cells as there is room in `chosen`, and puts the first trial of each
/// there. There are at least as many trials as cells. Given are the number of directions, a trial's
/// score along one, and its index.
fn choose<T: Send, A, I>(by: (usize, &A, &I), trials: &mut [T], chosen: &mut [u32])
where
    A: Fn(usize, &T) -> u32 + Sync,
    I: Fn(&T) -> u32 + Sync,
{
    let (directions, along, index) = by;
    if let [only] = chosen {
        *only = trials.iter().map(index).min().unwrap_or(0);
        return;
    }
    if chosen.is_empty() {
        return;
    }
    // of many trials some tell where they are spread out
    let step = (trials.len() / LOOKED_AT).max(1);
    let width = |direction: usize| {
        let scores = trials.iter().step_by(step).map(|trial| along(direction, trial));
        let extremes = |(least, most): (u32, u32), x: u32| (least.min(x), most.max(x));
        let (least, most) = scores.fold((u32::MAX, 0), extremes);
        most.saturating_sub(least)
    };
    let widest = (0..directions).rev().max_by_key(|&direction| width(direction)).unwrap_or(0);
    let cells = chosen.len() / 2;
    // as many trials for each cell, to one
    let cut = (trials.len() as u64 * cells as u64 / chosen.len() as u64) as usize;
    // by score, and of equal ones the first trial first: numbers that are compared at once
    trials.select_nth_unstable_by_key(cut, |trial| {
        (u64::from(along(widest, trial)) << 32) | u64::from(index(trial))
    });
    let (low, high) = trials.split_at_mut(cut);
    let (of_low, of_high) = chosen.split_at_mut(cells);
    rayon::join(|| choose(by, low, of_low), || choose(by, high, of_high));
}

/// Directions of the scores that are not correlated, each with variance 1: what is left of the score
/// with the largest variance, again and again (Gram and Schmidt with pivots). The scores have mean 0.
fn independent(mut scores: Vec<Vec<f32>>) -> Vec<Vec<f32>> {
    let mut found: Vec<Vec<f32>> = Vec::new();
    loop {
        let variances = parallel::map(&scores, |s| mean_product(s, s));
        let widest = variances.iter().enumerate().fold((0, 0.0), |best, (index, &variance)| {
            if variance > best.1 { (index, variance) } else { best }
        });
        if widest.1 < NEGLIGIBLE {
            return found;
        }
        let mut next = scores.swap_remove(widest.0);
        let scale = 1.0 / widest.1.sqrt();
        next.iter_mut().for_each(|x| *x = (f64::from(*x) * scale) as f32);
        parallel::map(&mut scores, |other| {
            let r = mean_product(other, &next) as f32;
            other.iter_mut().zip(&next).for_each(|(x, y)| *x -= r * y);
        });
        found.push(next);
    }
}

/// The mean of the products, in parts of a fixed size.
fn mean_product(a: &[f32], b: &[f32]) -> f64 {
    let parts = a.chunks(1024).zip(b.chunks(1024));
    let sums = parts
        .map(|(a, b)| a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum::<f64>());
    sums.sum::<f64>() / a.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::StreamKey;

    /// Columns of normals by their names.
    fn normals(name: &str, blocks: u64) -> Vec<f64> {
        let key = StreamKey::new(1, name);
        let mut out = Vec::new();
        for block in 0..blocks {
            let mut uniform = [0.0; crate::distribution::BLOCK];
            key.block(block).uniform(&mut uniform);
            out.extend(uniform.map(special::normal::quantile));
        }
        out
    }

    /// Ranks are permutations, of the same trials; an output that does not vary has none. With as
    /// many rows as trials they are those of all.
    #[test]
    fn ranks_are_of_the_same_trials() {
        let x = normals("x", 4);
        let twice: Vec<f64> = x.iter().map(|x| 2.0 * x).collect();
        let back: Vec<f64> = x.iter().map(|x| -x).collect();
        let fixed = vec![1.0; x.len()];
        for rows in [1, 2, 1000, 4096, 10_000] {
            let ranks = ranks_of(&[x.clone(), twice.clone(), fixed.clone(), back.clone()], rows);
            let count = rows.min(4096) as u32;
            let mut sorted = ranks[0].clone();
            sorted.sort_unstable();
            assert_eq!(sorted, (1..=count).collect::<Vec<u32>>());
            assert_eq!(ranks[0], ranks[1]);
            assert!(ranks[2].is_empty());
            assert!(ranks[0].iter().zip(&ranks[3]).all(|(a, b)| a + b == count + 1));
        }
    }

    /// The choice is the same whether scores stand beside the trials or are looked up.
    #[test]
    fn both_ways_to_choose_are_one() {
        let x = normals("x", 8);
        let y: Vec<f64> = normals("y", 8).iter().zip(&x).map(|(y, x)| y + 0.3 * x).collect();
        let of_rank = scores_of_ranks(x.len());
        let scores = [scores(&x, &of_rank), scores(&y, &of_rank)];
        let mut looked_up = vec![0; 777];
        let mut trials: Vec<u32> = (0..x.len() as u32).collect();
        let along = |direction: usize, trial: &u32| whole(scores[direction][*trial as usize]);
        choose((2, &along, &|trial| *trial), &mut trials, &mut looked_up);
        assert_eq!(chosen(&scores, x.len(), 777), looked_up);
    }

    /// Sorting by digits is sorting: values of both signs and all sizes, equal ones in order.
    #[test]
    fn digits_sort_as_values() {
        let mut values = normals("x", 32);
        values.iter_mut().step_by(3).for_each(|x| *x = (*x * 4.0).round() * 1e-300);
        values[5] = -0.0;
        assert!(values.len() >= RADIX);
        let mut expected: Vec<u32> = (0..values.len() as u32).collect();
        expected.sort_by(|&a, &b| values[a as usize].total_cmp(&values[b as usize]));
        assert_eq!(order(&values), expected);
        // of neighbouring places the values are those of the order to 2^-32 of the bits' range, which
        // spans all exponents here: 12 bits of sign and exponent leave 20 for the digits
        for (nearly, exactly) in order_nearly(&values).into_iter().zip(expected) {
            let (nearly, exactly) = (values[nearly as usize], values[exactly as usize]);
            assert!((nearly - exactly).abs() <= 1e-6 * exactly.abs(), "{nearly} {exactly}");
        }
        // all equal
        assert_eq!(order_nearly(&[2.0; 5]), [0, 1, 2, 3, 4]);
    }

    /// Equal values have ranks all the same.
    #[test]
    fn steps_have_ranks() {
        let x = normals("x", 8);
        let step: Vec<f64> = x.iter().map(|x| f64::from(u8::from(*x > 0.0))).collect();
        let ranks = ranks_of(&[x, step], 512);
        let above = ranks[1].iter().filter(|rank| **rank > 256).count();
        assert_eq!(above, 256);
        let same_half = ranks[0].iter().zip(&ranks[1]).filter(|(a, b)| (**a > 256) == (**b > 256));
        // half of all values are above 0 to 45 of 8192 (one standard deviation), which is 3 of 512;
        // to five of them, and as many ranks again for the choice
        assert!(same_half.count() >= 482);
    }

    /// The kept trials represent all: of two nearly cancelling outputs, the share of kept trials
    /// whose difference lies below a quantile of all differs from it by less than half of what a
    /// random choice of 1024 would leave (the standard deviation of a share p is then sqrt(p (1 - p)
    /// /1024); over 19 quantiles its root mean square in the units of that is 1 to 0.2).
    #[test]
    fn kept_trials_are_spread_out_as_all_are() {
        let (x, y) = (normals("x", 128), normals("y", 128));
        let sum: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x + 0.05 * y).collect();
        let values = [x, sum];
        let difference = |index: usize| values[1][index] - values[0][index];
        let mut all: Vec<f64> = (0..values[0].len()).map(difference).collect();
        all.sort_unstable_by(f64::total_cmp);
        let of_rank = scores_of_ranks(all.len());
        let scores = independent(values.iter().map(|v| scores(v, &of_rank)).collect());
        let chosen = chosen(&scores, all.len(), 1024);
        let squares = (1..20).map(|k| {
            let p = f64::from(k) / 20.0;
            let limit = all[(p * all.len() as f64) as usize];
            let below = chosen.iter().filter(|&&index| difference(index as usize) < limit).count();
            let random = (p * (1.0 - p) / 1024.0).sqrt();
            ((below as f64 / 1024.0 - p) / random).powi(2)
        });
        let scatter = (squares.sum::<f64>() / 19.0).sqrt();
        assert!(scatter < 0.5, "{scatter}");
    }

    /// Directions are not correlated, and outputs that depend on others linearly add none.
    #[test]
    fn directions_are_independent() {
        let (x, y) = (normals("x", 16), normals("y", 16));
        let of = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f32> {
            x.iter().zip(&y).map(|(x, y)| f(*x, *y) as f32).collect()
        };
        let found = independent(vec![
            of(&|x, _| x),
            of(&|x, y| 0.9 * x + 0.1 * y),
            of(&|x, y| 0.6 * x - 0.8 * y),
            of(&|_, y| y),
        ]);
        assert_eq!(found.len(), 2);
        // the rounding of f32 over 16384 terms
        assert!(mean_product(&found[0], &found[1]).abs() < 1e-5);
        assert!((mean_product(&found[1], &found[1]) - 1.0).abs() < 1e-5);
    }
}
