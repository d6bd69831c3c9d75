//! Attributes a change with several causes to each of them.

/// Up to this number of causes, every subset is evaluated.
const ALL_SUBSETS: usize = 10;

/// The approximate number of evaluations for more causes.
const EVALUATIONS: usize = 4000;

/// The Shapley values of `causes` causes: the part of `value(all) - value(none)` that each explains
/// when causes take effect one after the other, averaged over all orders. They sum to the change,
/// and do not depend on the numbering of the causes.
///
/// `value` gives the results with the marked causes in effect. For more than ten causes the orders
/// are sampled in pairs, one and its reverse, which is still exact if at most two causes interact.
pub(super) fn shapley(causes: usize, value: &dyn Fn(&[bool]) -> Vec<f64>) -> Vec<Vec<f64>> {
    if causes <= ALL_SUBSETS { by_subsets(causes, value) } else { by_orders(causes, value) }
}

fn by_subsets(causes: usize, value: &dyn Fn(&[bool]) -> Vec<f64>) -> Vec<Vec<f64>> {
    let marks = |subset: usize| (0..causes).map(|c| subset >> c & 1 == 1).collect::<Vec<_>>();
    let values: Vec<Vec<f64>> = (0..1usize << causes).map(|s| value(&marks(s))).collect();
    // |S|! (n - |S| - 1)! / n!: the share of orders in which S stands before the cause
    let mut weights = vec![1.0 / causes.max(1) as f64];
    for size in 1..causes {
        weights.push(weights[size - 1] * size as f64 / (causes - size) as f64);
    }
    let figures = values.first().map_or(0, Vec::len);
    let mut shares = vec![vec![0.0; figures]; causes];
    for (cause, share) in shares.iter_mut().enumerate() {
        let bit = 1 << cause;
        for (subset, before) in values.iter().enumerate().filter(|(s, _)| s & bit == 0) {
            let weight = weights[subset.count_ones() as usize];
            for ((share, before), after) in share.iter_mut().zip(before).zip(&values[subset | bit])
            {
                *share += weight * (after - before);
            }
        }
    }
    shares
}

/// Averages over rotations of the numbered order and over their reverses.
fn by_orders(causes: usize, value: &dyn Fn(&[bool]) -> Vec<f64>) -> Vec<Vec<f64>> {
    let turns = (EVALUATIONS / (2 * causes)).clamp(1, causes);
    let mut shares: Vec<Vec<f64>> = Vec::new();
    for turn in 0..turns {
        let first = turn * causes / turns;
        let forward: Vec<usize> = (0..causes).map(|index| (first + index) % causes).collect();
        let backward: Vec<usize> = forward.iter().rev().copied().collect();
        for order in [forward, backward] {
            let mut marks = vec![false; causes];
            let mut before = value(&marks);
            shares.resize(causes, vec![0.0; before.len()]);
            for cause in order {
                marks[cause] = true;
                let after = value(&marks);
                for ((share, before), after) in shares[cause].iter_mut().zip(&before).zip(&after) {
                    *share += (after - before) / (2 * turns) as f64;
                }
                before = after;
            }
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(marks: &[bool]) -> impl Iterator<Item = usize> + '_ {
        marks.iter().enumerate().filter(|(_, m)| **m).map(|(c, _)| c)
    }

    /// In x y each of two causes gets half of their joint effect; a third cause without effect gets
    /// nothing.
    #[test]
    fn what_two_do_together_is_halved() {
        let value = |m: &[bool]| {
            let (x, y) = (if m[0] { 3.0 } else { 1.0 }, if m[1] { 5.0 } else { 2.0 });
            vec![x * y, x + y]
        };
        // 2 * 3.5 and 3 * 2
        assert_eq!(shapley(3, &value), [[7.0, 2.0], [6.0, 3.0], [0.0, 0.0]]);
    }

    /// Three factors: from 1 to 2 each, every cause has a third of 8 - 1.
    #[test]
    fn equal_causes_have_equal_shares() {
        let value = |m: &[bool]| vec![2f64.powi(marked(m).count() as i32)];
        for share in shapley(3, &value) {
            assert!((share[0] - 7.0 / 3.0).abs() < 1e-14, "{share:?}");
        }
    }

    /// Both methods agree if causes act alone and in pairs: sum of i + 1, and of products of
    /// neighbours.
    #[test]
    fn pairs_of_orders_are_exact_for_pairs_of_causes() {
        let value = |m: &[bool]| {
            let own: f64 = marked(m).map(|c| c as f64 + 1.0).sum();
            let pairs = m.windows(2).enumerate().filter(|(_, w)| w[0] && w[1]);
            vec![own + pairs.map(|(c, _)| (c as f64 + 1.0).powi(2)).sum::<f64>()]
        };
        let (all, some) = (by_subsets(9, &value), by_orders(9, &value));
        for (all, some) in all.iter().zip(&some) {
            assert!((all[0] - some[0]).abs() < 1e-12 * all[0], "{all:?} {some:?}");
        }
        // many causes: the shares sum to the change
        let shares = shapley(300, &value);
        let total: f64 = shares.iter().map(|share| share[0]).sum();
        let change = value(&[true; 300])[0];
        assert!((total / change - 1.0).abs() < 1e-12, "{total} {change}");
    }

    #[test]
    fn nothing_changes_without_a_cause() {
        assert!(shapley(0, &|_| vec![1.0]).is_empty());
    }
}
