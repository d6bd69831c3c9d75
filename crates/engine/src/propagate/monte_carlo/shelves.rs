//! Values put on shelves by their size. A shelf is sorted only when one of its values is asked for:
//! a coverage interval looks at few of them.

use super::windows::Windows;
use crate::number::{CodePath, Kernel};

/// Values to a shelf, on average.
const PER_SHELF: usize = 24;

/// Shelves at most: their heads stay in the caches, also that of addresses, while values are put
/// there.
const MOST_SHELVES: usize = 1 << 11;

/// Values on shelves: every value of a shelf lies below every one of the next.
#[derive(Clone, Debug)]
pub(super) struct Shelves {
    values: Vec<f64>,
    /// Where each shelf begins, and the end.
    starts: Vec<usize>,
    /// The least and the greatest value of each; of an empty one the wrong way round.
    extremes: Vec<[f64; 2]>,
    sorted: Vec<bool>,
    /// Number of values in the low tail, about the median, in the high tail.
    regions: [usize; 3],
}

/// Equal shelves from one value on.
#[derive(Clone, Copy, Debug)]
struct Region {
    from: f64,
    inverse: f64,
    first: f64,
    /// How many there are after the first.
    more: f64,
}

/// Which shelf a value belongs on.
#[derive(Clone, Copy, Debug)]
struct Plan {
    low: f64,
    high: f64,
    regions: [Region; 3],
}

impl Plan {
    fn new(kept: &[&[f64]], windows: &Windows, shelves: usize) -> Self {
        let region = |from: f64, to: f64, first: usize, count: usize| {
            let inverse = count as f64 / (to - from);
            let inverse = if inverse.is_finite() && inverse > 0.0 { inverse } else { 0.0 };
            Region { from, inverse, first: first as f64, more: count as f64 - 1.0 }
        };
        if windows.keep_all() {
            let all = kept.iter().flat_map(|part| part.iter());
            let [least, greatest] = all
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], &value| {
                    [least.min(value), greatest.max(value)]
                });
            let all = region(least, greatest, 0, shelves);
            return Self { low: f64::INFINITY, high: f64::INFINITY, regions: [all; 3] };
        }
        // the tails have most of the values, and what is asked for lies there
        let about = (shelves / 8).max(1);
        let tail = ((shelves - about.min(shelves - 1)) / 2).max(1);
        let ends = windows.ends;
        Self {
            low: windows.low,
            high: windows.high,
            regions: [
                region(ends[0], windows.low, 0, tail),
                region(windows.median_low, windows.median_high, tail, about),
                region(windows.high, ends[1], tail + about, tail),
            ],
        }
    }

    /// The shelf of a value: greater values never have a lower one, and those beyond the ends are on
    /// the outermost ones.
    #[inline(always)]
    fn shelf(&self, value: f64) -> u16 {
        // adding 2^52 rounds and leaves the integer in the low bits
        const ROUND: f64 = 4_503_599_627_370_496.0;
        let [low, median, high] = self.regions;
        let or = |of: fn(&Region) -> f64| {
            let tail = if value <= self.low { of(&low) } else { of(&high) };
            if (value > self.low) & (value < self.high) { of(&median) } else { tail }
        };
        let place = (value - or(|r| r.from)) * or(|r| r.inverse);
        let place = if place > 0.0 { place } else { 0.0 };
        let more = or(|r| r.more);
        let place = if place < more { place } else { more };
        (place + or(|r| r.first) + ROUND).to_bits() as u16
    }

    /// Number of shelves, and where those of the three regions end.
    fn ends(&self) -> [usize; 3] {
        self.regions.map(|region| (region.first + region.more) as usize + 1)
    }
}

/// The shelves of some values.
struct ShelfKernel<'a> {
    plan: &'a Plan,
    values: &'a [f64],
    out: &'a mut [u16],
}

impl Kernel for ShelfKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (out, &value) in self.out.iter_mut().zip(self.values) {
            *out = self.plan.shelf(value);
        }
    }
}

impl Shelves {
    pub(super) fn new(path: CodePath, kept: &[&[f64]], windows: &Windows) -> Self {
        let count: usize = kept.iter().map(|part| part.len()).sum();
        let plan = Plan::new(kept, windows, (count / PER_SHELF).clamp(1, MOST_SHELVES));
        let ends = plan.ends();
        let shelves = ends[2];
        let mut shelf_of = vec![0u16; count];
        let mut counts = vec![0usize; shelves];
        let mut rest = &mut shelf_of[..];
        for values in kept {
            let (own, after) = rest.split_at_mut(values.len());
            path.run(ShelfKernel { plan: &plan, values, out: own });
            for &shelf in own.iter() {
                counts[usize::from(shelf)] += 1;
            }
            rest = after;
        }
        let mut starts = vec![0; shelves + 1];
        for shelf in 0..shelves {
            starts[shelf + 1] = starts[shelf] + counts[shelf];
        }
        let mut heads = starts.clone();
        let mut values = vec![0.0; count];
        let mut places = shelf_of.iter();
        for part in kept {
            for (&value, &shelf) in part.iter().zip(&mut places) {
                let head = &mut heads[usize::from(shelf)];
                values[*head] = value;
                *head += 1;
            }
        }
        let extremes = (0..shelves).map(|shelf| {
            let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
            for &v in &values[starts[shelf]..starts[shelf + 1]] {
                least = if v < least { v } else { least };
                greatest = if v > greatest { v } else { greatest };
            }
            [least, greatest]
        });
        let extremes = extremes.collect();
        let [low, median, high] = ends.map(|end| starts[end]);
        let regions = [low, median.saturating_sub(low), high.saturating_sub(median)];
        Self { values, starts, extremes, sorted: vec![false; shelves], regions }
    }

    /// Number of values in the low tail, about the median, in the high tail.
    pub(super) fn regions(&self) -> [usize; 3] {
        self.regions
    }

    fn shelf_of_place(&self, place: usize) -> usize {
        self.starts.partition_point(|&start| start <= place) - 1
    }

    fn sort(&mut self, shelf: usize) {
        if !self.sorted[shelf] {
            let values = &mut self.values[self.starts[shelf]..self.starts[shelf + 1]];
            values.sort_unstable_by(f64::total_cmp);
            self.sorted[shelf] = true;
        }
    }

    /// The value that has this place when all are in order.
    pub(super) fn at(&mut self, place: usize) -> f64 {
        self.sort(self.shelf_of_place(place));
        self.values[place]
    }

    /// The two values at `low` + i and `high` + i with the least difference, i below `count`; of
    /// equally near ones those with i nearest to `middle`.
    pub(super) fn closest(
        &mut self,
        low: usize,
        high: usize,
        count: usize,
        middle: usize,
    ) -> Option<[f64; 2]> {
        // stretches over which both places stay on one shelf, with the least difference there can be
        let mut stretches = Vec::new();
        let (mut a, mut b) = (self.shelf_of_place(low), self.shelf_of_place(high));
        let mut i = 0;
        while i < count {
            while self.starts[a + 1] <= low + i {
                a += 1;
            }
            while self.starts[b + 1] <= high + i {
                b += 1;
            }
            let end = (self.starts[a + 1] - low).min(self.starts[b + 1] - high).min(count);
            let least = self.extremes[b][0] - self.extremes[a][1];
            let most = self.extremes[b][1] - self.extremes[a][0];
            stretches.push(Stretch { from: i, to: end, shelves: [a, b], least, most });
            i = end;
        }
        let bound = stretches.iter().map(|s| s.most).fold(f64::INFINITY, f64::min);
        stretches.retain(|stretch| stretch.least <= bound);
        stretches.sort_by(|s, t| s.least.total_cmp(&t.least));
        let mut best: Option<(f64, usize, [f64; 2])> = None;
        for stretch in stretches {
            if best.is_some_and(|(length, ..)| stretch.least > length) {
                break;
            }
            for shelf in stretch.shelves {
                self.sort(shelf);
            }
            for i in stretch.from..stretch.to {
                let ends = [self.values[low + i], self.values[high + i]];
                let (length, distance) = (ends[1] - ends[0], i.abs_diff(middle));
                let better = best.is_none_or(|(least, nearest, _)| {
                    length < least || (length == least && distance < nearest)
                });
                if better {
                    best = Some((length, distance, ends));
                }
            }
        }
        best.map(|(.., ends)| ends)
    }
}

/// Places over which both ends stay on one shelf each.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: usize,
    to: usize,
    shelves: [usize; 2],
    /// No difference is less.
    least: f64,
    /// Some difference is no more.
    most: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Order statistics and the shortest interval against a full sort, for values that fill the
    /// shelves evenly, pile up on one, or are all equal.
    #[test]
    fn values_are_found_as_in_order() {
        let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..5000u64).map(|i| f((i * 2_654_435_761 % 5003) as f64 / 5003.0)).collect()
        };
        let cases = [
            of(&|u| u),
            of(&|u| (u + 1e-9).powf(-3.0)),
            of(&|u| (u * 7.0).floor()),
            of(&|_| 2.5),
            of(&|u| (u - 0.5).powi(3)),
            vec![-0.0, 0.0, -0.0, 1.0],
        ];
        for values in cases {
            let mut sorted = values.clone();
            sorted.sort_by(f64::total_cmp);
            let parts: Vec<&[f64]> = values.chunks(777).collect();
            let mut shelves = Shelves::new(CodePath::best(), &parts, &Windows::ALL);
            for place in (0..values.len()).step_by(97) {
                assert_eq!(shelves.at(place).to_bits(), sorted[place].to_bits());
            }
            let (count, q) = (values.len() / 4, values.len() - values.len() / 4);
            let lengths = (0..count).map(|i| sorted[q + i] - sorted[i]);
            let least = lengths.fold(f64::INFINITY, f64::min);
            let middle = count / 2;
            let wanted = (0..count)
                .filter(|&i| sorted[q + i] - sorted[i] == least)
                .min_by_key(|i| i.abs_diff(middle))
                .map(|i| [sorted[i], sorted[q + i]]);
            assert_eq!(shelves.closest(0, q, count, middle), wanted);
        }
    }
}
