//! The width at widths: how far a stated width may be wrong before the expanded uncertainty moves by
//! more than is allowed.

use super::sampler::{Buffers, Sampler, Widening};
use gumption_engine::distribution::BLOCK;
use gumption_engine::number::{COLUMN, Column};
use gumption_engine::propagate::Control;
use gumption_engine::propagate::monte_carlo::Ranks;

/// Factors of the width above this are not looked at.
const LARGEST: f64 = 1024.0;

/// The factor is found to so much.
const TOLERANCE: f64 = 1e-4;

/// Values of all quantities that are held at a time.
const MOST_VALUES: usize = 16 << 20;

/// Blocks that the search uses, at least and at most.
const BLOCKS: [u64; 2] = [16, 64];

/// The first trials, kept to be used again and again.
#[derive(Debug)]
pub(super) struct WidthSearch<'a> {
    sampler: &'a Sampler,
    /// The values of all quantities, column by column.
    values: Vec<Column>,
    probability: f64,
    allowed: f64,
}

/// The range of relative changes of a width: from -1 (no width at all) on; the upper end is infinite
/// where no factor up to 1024 does too much.
pub(super) type Allowed = [f64; 2];

impl<'a> WidthSearch<'a> {
    pub(super) fn new(
        sampler: &'a Sampler,
        (trials, probability): (u64, f64),
        allowed: f64,
        control: &Control<'_>,
    ) -> Self {
        // the outputs' values are collected by every thread
        let columns = sampler.variables.len() + 4 * sampler.outputs();
        let affordable = (MOST_VALUES / BLOCK / columns.max(1)) as u64;
        let blocks = (trials / BLOCK as u64).min(affordable).clamp(BLOCKS[0], BLOCKS[1]);
        let mut buffers = sampler.buffers();
        let drawn = (0..blocks).map(|block| sampler.drawn(control.path, block, &mut buffers));
        Self { sampler, values: drawn.flatten().collect(), probability, allowed }
    }

    /// Half the lengths of the outputs' coverage intervals where the width of a quantity is
    /// multiplied; not a number where a trial is not finite. `before` is what does not depend on it,
    /// column by column, or nothing.
    fn half_lengths(
        &self,
        (widening, before): (&Widening<'_>, &[Column]),
        (mean, factor): (f64, f64),
        buffers: &mut Buffers,
        control: &Control<'_>,
    ) -> Vec<f64> {
        let mut found: Vec<Vec<f64>> = vec![Vec::new(); self.sampler.outputs()];
        let each = if before.is_empty() { 0 } else { widening.columns() };
        for (column, values) in self.columns().enumerate() {
            let before = &before[column * each..(column + 1) * each];
            widening.widened(
                control.path,
                (values, before),
                (mean, factor),
                buffers,
                |output, values: &[f64; COLUMN]| {
                    found[output].extend_from_slice(values);
                },
            );
        }
        found.iter_mut().map(|values| half_length(values, self.probability)).collect()
    }

    /// The values of all quantities in each column of trials.
    fn columns(&self) -> std::slice::Chunks<'_, Column> {
        self.values.chunks(self.sampler.variables.len().max(1))
    }

    /// What is computed before a quantity matters, column by column; nothing where that would take
    /// more memory than the values of all quantities may.
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

    /// For each output how far the width of the quantity at `place` may change; `None` for an output
    /// without a spread.
    pub(super) fn allowed(
        &self,
        place: usize,
        mean: f64,
        control: &Control<'_>,
    ) -> Vec<Option<Allowed>> {
        let mut buffers = self.sampler.buffers();
        let widening = self.sampler.widening(place);
        let before = self.before(&widening, &mut buffers, control);
        let mut known: Vec<(f64, Vec<f64>)> = Vec::new();
        let mut at = |factor: f64, output: usize| {
            let found = known
                .iter()
                .find(|(known, _)| *known == factor)
                .map(|(_, lengths)| lengths[output]);
            found.unwrap_or_else(|| {
                let (of, change) = ((&widening, &before[..]), (mean, factor));
                let lengths = self.half_lengths(of, change, &mut buffers, control);
                let length = lengths[output];
                known.push((factor, lengths));
                length
            })
        };
        (0..self.sampler.outputs())
            .map(|output| {
                let stated = at(1.0, output);
                if stated.is_nan() || stated <= 0.0 {
                    return None;
                }
                // the square of the length is nearly linear in that of the width
                let mut excess = |square: f64| {
                    let change = at(square.sqrt(), output) / stated - 1.0;
                    if change.is_nan() { f64::INFINITY } else { change.abs() - self.allowed }
                };
                let lower = if excess(0.0) <= 0.0 { 0.0 } else { crossing(1.0, 0.0, &mut excess) };
                let mut inside = 1.0;
                let upper = loop {
                    let factor = 4.0 * inside;
                    if excess(factor) > 0.0 {
                        break crossing(inside, factor, &mut excess).sqrt() - 1.0;
                    }
                    inside = factor;
                    if inside >= LARGEST * LARGEST {
                        break f64::INFINITY;
                    }
                };
                Some([lower.sqrt() - 1.0, upper])
            })
            .collect()
    }
}

/// Where the excess turns positive on the way from `inside` to `outside`: false position with the
/// retained end's weight halved (the Illinois rule), the last point inside.
fn crossing(mut inside: f64, mut outside: f64, excess: &mut impl FnMut(f64) -> f64) -> f64 {
    let (mut low, mut high) = (excess(inside), excess(outside));
    let mut last = 0;
    for _ in 0..60 {
        if (inside.sqrt() - outside.sqrt()).abs() <= TOLERANCE {
            break;
        }
        let share = if high.is_finite() && high > low { -low / (high - low) } else { 0.5 };
        // never so near an end that nothing is gained
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
    let (lower, upper) = (place(ranks.r), place(ranks.r + ranks.q));
    let (_, &mut low, above) = values.select_nth_unstable_by(lower, f64::total_cmp);
    // the upper end is among those above the lower one
    let high = match upper.checked_sub(lower + 1) {
        Some(place) => *above.select_nth_unstable_by(place, f64::total_cmp).1,
        None => low,
    };
    0.5 * high - 0.5 * low
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The square root of 1.3225 is 1.15: a length that grows as the width, 15 % allowed.
    #[test]
    fn the_crossing_is_found() {
        let mut excess = |square: f64| (square.sqrt() - 1.0).abs() - 0.15;
        let up = crossing(1.0, 4.0, &mut excess).sqrt();
        let down = crossing(1.0, 0.0, &mut excess).sqrt();
        assert!((up - 1.15).abs() < TOLERANCE && up <= 1.15 + 1e-12, "{up}");
        assert!((down - 0.85).abs() < TOLERANCE && down >= 0.85 - 1e-12, "{down}");
        // not a number beyond
        let mut excess = |s: f64| if s > 2.0 { f64::INFINITY } else { -1.0 };
        assert!((crossing(1.0, 4.0, &mut excess).sqrt() - 2f64.sqrt()).abs() < TOLERANCE);
    }
}
