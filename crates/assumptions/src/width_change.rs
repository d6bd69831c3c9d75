//! How far a stated width may be wrong before the expanded uncertainty changes by more than the
//! allowed amount.

use super::sampler::{Buffers, Change, Outputs, Sampler, Taker, Widening};
use gumption_engine::distribution::BLOCK;
use gumption_engine::number::{COLUMN, CodePath, Column, ascending, at_rank};
use gumption_engine::propagate::Control;
use gumption_engine::propagate::monte_carlo::Ranks;

/// Largest factor of the width in the search.
const LARGEST: f64 = 1024.0;

/// Tolerance of the factor.
const TOLERANCE: f64 = 1e-4;

/// Maximum number of values of all quantities in memory.
const MOST_VALUES: usize = 16 << 20;

/// Minimum and maximum number of blocks in the search.
const BLOCKS: [u64; 2] = [16, 64];

/// The first trials, kept for repeated use.
#[derive(Debug)]
pub(super) struct WidthSearch<'a> {
    sampler: &'a Sampler,
    /// The values of all quantities, column by column.
    values: Vec<Column>,
    /// Half the lengths of the outputs' coverage intervals with the stated distributions.
    stated: Vec<f64>,
    probability: f64,
    allowed: f64,
}

/// The range of relative changes of a width, from -1 (no width); the upper end is infinite if no
/// factor up to 1024 exceeds the allowed change.
pub(super) type Allowed = [f64; 2];

impl<'a> WidthSearch<'a> {
    pub(super) fn new(
        sampler: &'a Sampler,
        trials: u64,
        probability: f64,
        allowed: f64,
        control: &Control<'_>,
    ) -> Self {
        // the outputs' values are collected by every thread
        let columns = sampler.variables.len() + 4 * sampler.outputs();
        let affordable = (MOST_VALUES / BLOCK / columns.max(1)) as u64;
        let blocks = (trials / BLOCK as u64).min(affordable).clamp(BLOCKS[0], BLOCKS[1]);
        let mut buffers = sampler.buffers();
        let drawn = (0..blocks).map(|block| sampler.drawn(control.path, block, &mut buffers));
        let values = drawn.flatten().collect();
        let mut stated = Collected(vec![Vec::new(); sampler.outputs()]);
        let none = sampler.prepared(&[Change::None]);
        for block in 0..blocks {
            sampler.changed(control.path, block, BLOCK, &none, &mut buffers, &mut stated);
        }
        let stated = stated.0.iter_mut().map(|values| half_length(values, probability)).collect();
        Self { sampler, values, stated, probability, allowed }
    }

    /// Half the length of an output's coverage interval if the width of a quantity is multiplied;
    /// NaN if a trial is not finite. `before` holds the columns that do not depend on it, or
    /// nothing.
    fn half_length(
        &self,
        widening: &Widening<'_>,
        before: &[Column],
        change: (f64, f64),
        buffers: &mut Buffers,
        control: &Control<'_>,
    ) -> f64 {
        let mut found = vec![0.0; self.columns().len() * COLUMN];
        let each = if before.is_empty() { 0 } else { widening.columns() };
        let columns = self.columns().zip(found.chunks_mut(COLUMN));
        for (column, (values, out)) in columns.enumerate() {
            let before = &before[column * each..(column + 1) * each];
            widening.widened(control.path, values, before, change, buffers, out);
        }
        half_length(&mut found, self.probability)
    }

    /// The values of all quantities in each column of trials.
    fn columns(&self) -> std::slice::Chunks<'_, Column> {
        self.values.chunks(self.sampler.variables.len().max(1))
    }

    /// The columns computed before the quantity matters; empty if they would take more memory than
    /// the values of all quantities may.
    fn before(
        &self,
        widening: &Widening<'_>,
        buffers: &mut Buffers,
        control: &Control<'_>,
    ) -> Vec<Column> {
        let mut before = Vec::new();
        if widening.columns() * self.columns().len() <= MOST_VALUES / COLUMN {
            before.reserve_exact(widening.columns() * self.columns().len());
            for values in self.columns() {
                widening.before(control.path, values, buffers, &mut before);
            }
        }
        before
    }

    /// For each output how far the width of the quantity at `place` may change; `None` for an
    /// output without spread.
    pub(super) fn allowed(
        &self,
        place: usize,
        mean: f64,
        control: &Control<'_>,
    ) -> Vec<Option<Allowed>> {
        let mut buffers = self.sampler.buffers();
        let outputs = 0..self.sampler.outputs();
        outputs.map(|output| self.of_output(place, mean, output, &mut buffers, control)).collect()
    }

    fn of_output(
        &self,
        place: usize,
        mean: f64,
        output: usize,
        buffers: &mut Buffers,
        control: &Control<'_>,
    ) -> Option<Allowed> {
        let stated = self.stated[output];
        if stated.is_nan() || stated <= 0.0 {
            return None;
        }
        let Some(widening) = self.sampler.widening(place, output) else {
            return Some([-1.0, f64::INFINITY]);
        };
        let before = self.before(&widening, buffers, control);
        let mut at =
            |factor: f64| self.half_length(&widening, &before, (mean, factor), buffers, control);
        // the square of the length is nearly linear in the square of the width
        let mut excess = |square: f64| {
            let change = at(square.sqrt()) / stated - 1.0;
            if change.is_nan() { f64::INFINITY } else { change.abs() - self.allowed }
        };
        let inside = [1.0, -self.allowed];
        let none = excess(0.0);
        let lower = if none <= 0.0 { 0.0 } else { crossing(inside, [0.0, none], &mut excess) };
        let mut inside = inside;
        let upper = loop {
            let square = 4.0 * inside[0];
            let found = [square, excess(square)];
            if found[1] > 0.0 {
                break crossing(inside, found, &mut excess).sqrt() - 1.0;
            }
            inside = found;
            if square >= LARGEST * LARGEST {
                break f64::INFINITY;
            }
        };
        Some([lower.sqrt() - 1.0, upper])
    }
}

/// The point between `inside` and `outside` at which the excess becomes positive, each with its
/// excess: false position with the weight of the retained end halved (Illinois rule). Returns the
/// last point inside.
fn crossing(
    [mut inside, mut low]: [f64; 2],
    [mut outside, mut high]: [f64; 2],
    excess: &mut impl FnMut(f64) -> f64,
) -> f64 {
    let mut last = 0;
    for _ in 0..60 {
        if (inside.sqrt() - outside.sqrt()).abs() <= TOLERANCE {
            break;
        }
        let share = if high.is_finite() && high > low { -low / (high - low) } else { 0.5 };
        // never so close to an end that nothing is gained
        let next = inside + share.clamp(0.01, 0.99) * (outside - inside);
        let found = excess(next);
        if found <= 0.0 {
            (inside, low) = (next, found);
            high *= if last == 1 { 0.5 } else { 1.0 };
            last = 1;
        } else {
            (outside, high) = (next, found);
            low *= if last == 2 { 0.5 } else { 1.0 };
            last = 2;
        }
    }
    inside
}

/// Half the length of the probabilistically symmetric interval.
fn half_length(values: &mut [f64], probability: f64) -> f64 {
    if values.iter().any(|value| !value.is_finite()) {
        return f64::NAN;
    }
    let ranks = Ranks::new(values.len() as u64, probability);
    let place = |rank: u64| (rank as usize).clamp(1, values.len()) - 1;
    let places = [place(ranks.r), place(ranks.r + ranks.q)];
    let [low, high] = in_tails(values, places).unwrap_or_else(|| {
        let low = at_rank(values, places[0]);
        // the upper endpoint is among the values above the lower one
        let high = match places[1].checked_sub(places[0] + 1) {
            Some(place) => at_rank(&mut values[places[0] + 1..], place),
            None => low,
        };
        [low, high]
    });
    0.5 * high - 0.5 * low
}

/// Number of first values that locate the tails.
const PILOT: usize = 2048;

/// How many standard deviations of a rank of the pilot the tails are wider than their ends.
const MARGIN: f64 = 6.0;

/// The values at two positions of the order, searched in the tails only; `None` if they are not
/// certainly there.
fn in_tails(values: &[f64], places: [usize; 2]) -> Option<[f64; 2]> {
    let mut pilot = values.get(..PILOT).filter(|pilot| values.len() >= 8 * pilot.len())?.to_vec();
    ascending(&mut pilot);
    let count = values.len() as f64;
    let limit = |place: usize, way: f64| {
        let share = place as f64 / count;
        let scatter = (share * (1.0 - share) / PILOT as f64).sqrt();
        let rank = (share + way * MARGIN * scatter) * PILOT as f64;
        (rank >= 1.0).then(|| pilot.get(rank as usize).copied()).flatten()
    };
    let [below, above] = [limit(places[0], 1.0)?, limit(places[1], -1.0)?];
    let mut low: Vec<f64> = Vec::with_capacity(values.len() / 8);
    let mut high = low.clone();
    for chunk in values.chunks(16) {
        // all are counted, so that several are compared at a time
        if chunk.iter().map(|&value| u64::from(value <= below)).sum::<u64>() > 0 {
            low.extend(chunk.iter().filter(|value| **value <= below));
        }
        if chunk.iter().map(|&value| u64::from(value >= above)).sum::<u64>() > 0 {
            high.extend(chunk.iter().filter(|value| **value >= above));
        }
    }
    let from_top = values.len() - places[1];
    let high_place = high.len().checked_sub(from_top)?;
    if places[0] >= low.len() {
        return None;
    }
    let low = at_rank(&mut low, places[0]);
    let high = at_rank(&mut high, high_place);
    Some([low, high])
}

/// The values of all outputs.
struct Collected(Vec<Vec<f64>>);

impl Taker for Collected {
    fn take(&mut self, _: CodePath, _number: usize, outputs: Outputs<'_>, count: usize) {
        for (values, column) in self.0.iter_mut().zip(outputs.columns()) {
            values.extend_from_slice(&column.0[..count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Endpoints found in the tails equal those of all values, even if many values are equal or the
    /// pilot has other values than the rest.
    #[test]
    fn ends_are_in_the_tails() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let random: Vec<f64> = (0..32_768).map(|_| next() * next() - 0.3).collect();
        let steps = random.iter().map(|x| (x * 20.0).round()).collect();
        let mut other = random.clone();
        other[..PILOT].iter_mut().for_each(|x| *x *= 0.01);
        for values in [random, steps, other] {
            let mut sorted = values.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            for places in [[0, 32_767], [800, 31_900], [5_000, 30_000], [9, 9]] {
                let expected = places.map(|place| sorted[place]);
                assert!(in_tails(&values, places).is_none_or(|found| found == expected));
            }
            let ranks = Ranks::new(values.len() as u64, 0.95);
            let ends = [ranks.r, ranks.r + ranks.q].map(|rank| sorted[rank as usize - 1]);
            assert_eq!(half_length(&mut values.clone(), 0.95), 0.5 * ends[1] - 0.5 * ends[0]);
        }
    }

    /// The square root of 1.3225 is 1.15: a length proportional to the width, 15 % allowed.
    #[test]
    fn the_crossing_is_found() {
        let mut excess = |square: f64| (square.sqrt() - 1.0).abs() - 0.15;
        let stated = [1.0, excess(1.0)];
        let up = crossing(stated, [4.0, excess(4.0)], &mut excess).sqrt();
        let down = crossing(stated, [0.0, excess(0.0)], &mut excess).sqrt();
        assert!((up - 1.15).abs() < TOLERANCE && up <= 1.15 + 1e-12, "{up}");
        assert!((down - 0.85).abs() < TOLERANCE && down >= 0.85 - 1e-12, "{down}");
        // not a number beyond
        let mut excess = |s: f64| if s > 2.0 { f64::INFINITY } else { -1.0 };
        let found = crossing([1.0, -1.0], [4.0, f64::INFINITY], &mut excess);
        assert!((found.sqrt() - 2f64.sqrt()).abs() < TOLERANCE);
    }
}
