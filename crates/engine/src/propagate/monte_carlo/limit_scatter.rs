//! How far the end of the shortest interval scatters that lies at a limit of the distribution.
//!
//! Where the density falls from a limit on, the shortest interval begins at one of the trials nearest
//! to it. Which one that is, and where it lies, follows from two things: the value below which a share
//! of the trials lies grows as a power of that share, and beyond the other end each rank costs the
//! same length. Of a finite density at the limit the power is 1, so that the end comes as near to the
//! limit as one over the number of trials; of a density that is infinite there it is larger. Where
//! the density rises from the limit to a peak that lies very near, the power is below 1, and the end
//! is the place where the density of both ends agrees. All of these are one small random process, of
//! which many instances are made: the positions of the ranks next to the limit, and the lengths that
//! the same ranks cost beyond the other end.

use super::order::Order;
use crate::distribution::{BLOCK, StreamKey};
use crate::number::ascending;
use crate::number::elementary::{exp, ln};

/// Values next to the limit that are taken from each batch, and that are used of all batches
/// together.
const OF_A_BATCH: u64 = 64;
const OF_ALL: usize = 1024;

/// Of all trials so large a part at most: near the limit.
const NEAR: u64 = 32;

/// So many are looked at where the limit itself is not known.
const NEAREST: usize = 256;

/// So many of them are needed to tell the power.
const FEWEST: usize = 48;

/// Instances of the process: the standard deviation of an exponential distribution is then known to
/// 5 %. Of longer instances fewer are made.
const INSTANCES: usize = 1024;
const LEAST_INSTANCES: usize = 64;
const NUMBERS: usize = 1 << 15;

/// Ranks in an instance at most.
const LONGEST: usize = 1024;

/// Values of a batch next to a limit: distances that grow from it, `upper` for those from above.
pub(super) fn nearest(order: &mut Order, upper: bool, most: u64) -> Vec<f64> {
    let trials = order.trials;
    let ranks = 1..=OF_A_BATCH.min(most);
    let value = |rank| {
        if upper { order.get(trials + 1 - rank).map(|value| -value) } else { order.get(rank) }
    };
    ranks.map_while(value).collect()
}

/// The standard deviation of the end at the limit among all `total` trials; not a number where the
/// batches do not tell. `near` holds the values of each batch next to the limit, `sampled` is how many
/// trials the batches have together, and `step` by how much the other end moves from one rank of all
/// trials to the next.
pub(super) fn scatter(near: &[&[f64]], sampled: u64, total: u64, step: f64) -> f64 {
    let Some(values) = together(near, sampled) else { return f64::NAN };
    let Some(last) = values.last().filter(|last| **last > values[0]) else {
        // more trials than these lie exactly on the limit
        return 0.0;
    };
    let power = power_of(&values, *last);
    let share = sampled as f64 / total as f64;
    // the rank that the interval of the batches' trials would begin at
    let of_sampled = step / share;
    let costs = values.iter().enumerate().map(|(rank, value)| of_sampled * rank as f64 - value);
    let best = costs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(1, |(rank, _)| rank + 1);
    // from two ranks around it the length that the power multiplies
    let known = power == 1.0 || power == 2.0;
    let high = (4 * best).max(if known { FEWEST } else { 16 }).min(values.len());
    let low = if high <= FEWEST { 1 } else { high / 8 };
    let at = |rank: f64| exp(power * ln(rank));
    let length = (values[high - 1] - values[low - 1]) / (at(high as f64) - at(low as f64));
    if !(length.is_finite() && step.is_finite() && step > 0.0) {
        return f64::NAN;
    }
    let ranks = (8.0 * (best as f64 / share).ceil()) as usize + 16;
    Process { power, length, share, step, ranks: ranks.min(LONGEST) }.deviation()
}

/// The least values of all batches together, as far as all batches have them.
fn together(near: &[&[f64]], sampled: u64) -> Option<Vec<f64>> {
    let common = near.iter().filter_map(|values| values.last()).copied().fold(f64::NAN, f64::min);
    let mut values: Vec<f64> =
        near.iter().flat_map(|values| values.iter().copied()).filter(|v| *v <= common).collect();
    ascending(&mut values);
    values.truncate(OF_ALL.min((sampled / NEAR) as usize));
    (values.len() >= FEWEST).then_some(values)
}

/// The power of the share with which values grow from the limit: from three ranks, each four times
/// the one before; where it is about 1 or larger, and the least value as good as the limit, more
/// sharply from all values. Powers that may well be 1 (a finite density) or 2 (that of a square of what
/// passes zero) are.
fn power_of(values: &[f64], last: f64) -> f64 {
    let high = values.len().min(NEAREST);
    let (middle, low) = (high / 4, high / 16);
    let [a, b, c] = [high, middle, low].map(|rank| values[rank - 1]);
    let from_three = ln((a - b) / (b - c)) / ln(4.0);
    let apart = |more: usize, less: usize| 1.0 / (more - less) as f64;
    let error = (apart(middle, low) + apart(high, middle)).sqrt() / ln(4.0);
    if from_three < 1.0 - 2.0 * error {
        return from_three.max(0.1);
    }
    let least = values[0];
    let distances =
        values.iter().map(|value| value - least).filter(|d| *d > 0.0 && *d < last - least);
    let (count, sum) = distances.fold((0_u32, 0.0), |(count, sum), distance| {
        (count + 1, sum + ln((last - least) / distance))
    });
    let from_all = sum / f64::from(count.max(1));
    // whose relative standard deviation is one over the root of their number
    let may_be = |power: f64| (from_all / power - 1.0).abs() * (values.len() as f64).sqrt() < 2.0;
    [1.0, 2.0].into_iter().find(|power| may_be(*power)).unwrap_or(from_all)
}

/// The ranks next to the limit and what they cost at the other end.
struct Process {
    power: f64,
    /// What the power of a rank of the batches' trials is multiplied by.
    length: f64,
    /// The batches' part of all trials.
    share: f64,
    step: f64,
    ranks: usize,
}

impl Process {
    /// The standard deviation of the value at the rank that the interval begins at.
    fn deviation(&self) -> f64 {
        let instances = (NUMBERS / self.ranks).clamp(LEAST_INSTANCES, INSTANCES);
        let mut numbers = Exponential::new();
        let mut ends = Vec::with_capacity(instances);
        let mut cut_off = 0;
        for instance in 0..instances {
            // the first one in even steps of probability: it counts most
            let first = (instance as f64 + 0.5) / instances as f64;
            let mut position = -ln(1.0 - first);
            let mut cost = numbers.next();
            let mut best = (f64::INFINITY, 0.0, 0);
            for rank in 0..self.ranks {
                let value = self.length * exp(self.power * ln(position * self.share));
                let longer = self.step * cost - value;
                if longer < best.0 {
                    best = (longer, value, rank);
                }
                position += numbers.next();
                cost += numbers.next();
            }
            ends.push(best.1);
            cut_off += usize::from(best.2 + 1 == self.ranks);
        }
        // where many are still falling at the last rank, it is farther than was looked
        if 20 * cut_off > instances {
            return f64::NAN;
        }
        super::shortest_scatter::variance(&ends).sqrt()
    }
}

/// Numbers of the exponential distribution, always the same.
struct Exponential {
    key: StreamKey,
    block: u64,
    numbers: [f64; BLOCK],
    used: usize,
}

impl Exponential {
    fn new() -> Self {
        let key = StreamKey::new(0, "ends at a limit");
        Self { key, block: 0, numbers: [0.0; BLOCK], used: BLOCK }
    }

    fn next(&mut self) -> f64 {
        if self.used == BLOCK {
            self.key.block(self.block).uniform(&mut self.numbers);
            (self.block, self.used) = (self.block + 1, 0);
        }
        let number = -ln(self.numbers[self.used]);
        self.used += 1;
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thirty batches of 1000 values that are evenly spread as quantiles of F(x) = x^(1/power).
    fn evenly(power: f64) -> Vec<Vec<f64>> {
        let value = |k: u32, batch: u32| {
            // batches interleave, so that all together are evenly spread as well
            let rank = f64::from(k) + (f64::from(batch) + 0.5) / 30.0;
            exp(power * ln(rank / 1000.0))
        };
        (0..30).map(|batch| (0..64).map(|k| value(k, batch)).collect()).collect()
    }

    fn of(batches: &[Vec<f64>], total: u64, step: f64) -> f64 {
        let near: Vec<&[f64]> = batches.iter().map(Vec::as_slice).collect();
        scatter(&near, 30_000, total, step)
    }

    /// A finite density of 1 at the limit, and hardly any at the other end: the end is the least of
    /// all trials, whose standard deviation is 1/M. An infinite one, F = sqrt(x): that of the square
    /// of an exponential number, sqrt(20)/M^2. The instances know them to 5 % and 15 %.
    #[test]
    fn of_the_least_trial_by_hand() {
        for total in [30_000, 3_000_000] {
            let m = total as f64;
            assert!((of(&evenly(1.0), total, 1.0) * m - 1.0).abs() < 0.1);
            let root = of(&evenly(2.0), total, 1.0) * m * m / 20_f64.sqrt();
            assert!((root - 1.0).abs() < 0.35, "{root}");
        }
    }

    /// Half the density at the other end: then ranks further in are often chosen, and the end
    /// scatters more.
    #[test]
    fn a_less_steep_fall_scatters_more() {
        let steep = of(&evenly(1.0), 30_000, 20.0 / 30_000.0);
        let flat = of(&evenly(1.0), 30_000, 2.0 / 30_000.0);
        assert!(flat > 2.0 * steep && flat < 10.0 * steep, "{flat} {steep}");
    }

    #[test]
    fn values_on_the_limit_do_not_scatter() {
        assert_eq!(of(&vec![vec![0.0; 64]; 30], 30_000, 1e-4), 0.0);
        assert!(of(&vec![vec![0.0, 1.0]; 10], 30_000, 1e-4).is_nan());
    }
}
