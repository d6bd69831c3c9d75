//! Bucket partition: order statistics of values in memory without sorting all of them.
//!
//! The ends of the symmetric interval, the median and their numerical errors are a dozen order
//! statistics, and the shortest interval needs those of the pairs of buckets whose distance can be
//! the least. So most values need not be sorted: they are distributed into buckets by size in one
//! pass, as in a bucket sort (Knuth, The Art of Computer Programming 3, 5.2.5), and a bucket is
//! sorted only when one of its values is asked for. Buckets follow the windows: most of them lie in
//! the two tails, where the ends of intervals are. What is found are exact order statistics; how the
//! buckets lie affects time alone.
#![allow(unsafe_code)] // instructions of a path that the machine has

#[cfg(target_arch = "x86_64")]
use super::avx512;
use super::sorting;
use super::windows::Windows;
#[cfg(target_arch = "x86_64")]
use crate::number::Instructions;
use crate::number::{CodePath, Kernel, ascending};

/// Values to a bucket, on average.
const PER_BUCKET: usize = 24;

/// Buckets at most: the addresses of their next free entries stay in the first caches, that of the
/// page table too, while values are distributed.
const MOST_BUCKETS: usize = 1 << 11;

/// Values in buckets: every value of a bucket lies below every one of the next.
#[derive(Clone, Debug)]
pub(super) struct BucketPartition {
    values: Vec<f64>,
    /// Where each bucket begins, and the end.
    starts: Vec<usize>,
    /// The least and the greatest value of each; of an empty one infinity and minus infinity.
    extremes: Vec<[f64; 2]>,
    sorted: Vec<bool>,
    /// The path that buckets are sorted on.
    path: CodePath,
    /// Number of values in the low tail, about the median, in the high tail.
    regions: [usize; 3],
}

/// Equal buckets from one value on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub(super) from: f64,
    pub(super) inverse: f64,
    pub(super) first: f64,
    /// How many there are after the first.
    pub(super) more: f64,
}

/// Which bucket a value belongs in.
#[derive(Clone, Copy, Debug)]
pub(super) struct BucketLayout {
    pub(super) low: f64,
    pub(super) high: f64,
    /// The low tail, about the median, the high tail.
    pub(super) regions: [Region; 3],
}

/// 2^52: adding it rounds and leaves the integer in the low bits.
pub(super) const ROUND: f64 = 4_503_599_627_370_496.0;

impl BucketLayout {
    fn new(kept: &[&[f64]], windows: &Windows, buckets: usize) -> Self {
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
            let all = region(least, greatest, 0, buckets);
            return Self { low: f64::INFINITY, high: f64::INFINITY, regions: [all; 3] };
        }
        // the tails have most of the values, and what is asked for lies there
        let about = (buckets / 8).max(1);
        let tail = ((buckets - about.min(buckets - 1)) / 2).max(1);
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

    /// The bucket of a value: greater values never have a lower one, and those beyond the ends are in
    /// the outermost ones.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(super) fn bucket(&self, value: f64) -> u16 {
        self.raised(value).to_bits() as u16
    }

    /// The bucket of a value plus [`ROUND`].
    #[inline(always)]
    fn raised(&self, value: f64) -> f64 {
        let [low, median, high] = self.regions;
        let (in_low, in_high) = (value <= self.low, value >= self.high);
        let or = |low: f64, median: f64, high: f64| {
            let upper = if in_high { high } else { median };
            if in_low { low } else { upper }
        };
        let from = or(low.from, median.from, high.from);
        let index = (value - from) * or(low.inverse, median.inverse, high.inverse);
        let index = if index > 0.0 { index } else { 0.0 };
        let more = or(low.more, median.more, high.more);
        let index = if index < more { index } else { more };
        index + or(low.first, median.first, high.first) + ROUND
    }

    /// Number of buckets, and where those of the three regions end.
    fn ends(&self) -> [usize; 3] {
        self.regions.map(|region| (region.first + region.more) as usize + 1)
    }
}

/// The buckets of some values, as many as there is room for.
fn buckets_of(path: CodePath, layout: &BucketLayout, values: &[f64], out: &mut [u16]) {
    #[cfg(target_arch = "x86_64")]
    if path.instructions() == Instructions::Avx512 {
        // SAFETY: the machine has the instructions of a path.
        unsafe { avx512::buckets(layout, values, out) };
        return;
    }
    path.run(BucketKernel { layout, values, out });
}

/// The same in plain loops.
struct BucketKernel<'a> {
    layout: &'a BucketLayout,
    values: &'a [f64],
    out: &'a mut [u16],
}

impl Kernel for BucketKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        // two loops, each of which runs in vectors
        let mut raised = [0.0; TOGETHER];
        for (out, values) in self.out.chunks_mut(TOGETHER).zip(self.values.chunks(TOGETHER)) {
            for (raised, &value) in raised.iter_mut().zip(values) {
                *raised = self.layout.raised(value);
            }
            for (out, raised) in out.iter_mut().zip(&raised) {
                *out = raised.to_bits() as u16;
            }
        }
    }
}

/// Values whose buckets are found together.
const TOGETHER: usize = 64;

/// A bucket of at most so many values is sorted by counting.
const COUNTED: usize = 64;

/// Sorts the values of a bucket by their total order. Of few, the place of each is the number of those
/// that belong before it: as many comparisons as there are pairs, but side by side and without a branch.
fn sort_bucket(path: CodePath, values: &mut [f64]) {
    if values.len() > COUNTED {
        ascending(values);
    } else if values.len() > 1 {
        path.run(CountingSort { values });
    }
}

struct CountingSort<'a> {
    values: &'a mut [f64],
}

impl Kernel for CountingSort<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut keys = [0; COUNTED];
        let count = self.values.len();
        for (key, value) in keys.iter_mut().zip(self.values.iter()) {
            *key = sorting::key(*value);
        }
        let mut sorted = [0.0; COUNTED];
        for (place, value) in self.values.iter().enumerate() {
            let own = keys[place];
            let (before, after) = keys[..count].split_at(place);
            let below: i64 = before.iter().map(|key| i64::from(*key <= own)).sum();
            let below: i64 = below + after.iter().map(|key| i64::from(*key < own)).sum::<i64>();
            sorted[below as usize % COUNTED] = *value;
        }
        self.values.copy_from_slice(&sorted[..count]);
    }
}

impl BucketPartition {
    pub(super) fn new(path: CodePath, kept: &[&[f64]], windows: &Windows) -> Self {
        let count: usize = kept.iter().map(|part| part.len()).sum();
        let layout = BucketLayout::new(kept, windows, (count / PER_BUCKET).clamp(1, MOST_BUCKETS));
        let ends = layout.ends();
        let buckets = ends[2];
        let mut bucket_of = vec![0u16; count];
        let mut counts = vec![0usize; buckets];
        let mut rest = &mut bucket_of[..];
        for values in kept {
            let (own, after) = rest.split_at_mut(values.len());
            buckets_of(path, &layout, values, own);
            for &bucket in own.iter() {
                counts[usize::from(bucket)] += 1;
            }
            rest = after;
        }
        let mut starts = vec![0; buckets + 1];
        for bucket in 0..buckets {
            starts[bucket + 1] = starts[bucket] + counts[bucket];
        }
        let mut heads = starts.clone();
        let mut values = vec![0.0; count];
        let mut indices = bucket_of.iter();
        for part in kept {
            for (&value, &bucket) in part.iter().zip(&mut indices) {
                let head = &mut heads[usize::from(bucket)];
                values[*head] = value;
                *head += 1;
            }
        }
        let extremes = (0..buckets).map(|bucket| {
            let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
            for &v in &values[starts[bucket]..starts[bucket + 1]] {
                least = if v < least { v } else { least };
                greatest = if v > greatest { v } else { greatest };
            }
            [least, greatest]
        });
        let extremes = extremes.collect();
        let [low, median, high] = ends.map(|end| starts[end]);
        let regions = [low, median.saturating_sub(low), high.saturating_sub(median)];
        Self { values, starts, extremes, sorted: vec![false; buckets], path, regions }
    }

    /// Number of values in the low tail, about the median, in the high tail.
    pub(super) fn regions(&self) -> [usize; 3] {
        self.regions
    }

    fn bucket_of_index(&self, index: usize) -> usize {
        self.starts.partition_point(|&start| start <= index) - 1
    }

    fn sort(&mut self, bucket: usize) {
        if !self.sorted[bucket] {
            let values = &mut self.values[self.starts[bucket]..self.starts[bucket + 1]];
            sort_bucket(self.path, values);
            self.sorted[bucket] = true;
        }
    }

    /// The value that has this index when all are in order.
    pub(super) fn at(&mut self, index: usize) -> f64 {
        self.sort(self.bucket_of_index(index));
        self.values[index]
    }

    /// The two values at `low` + i and `high` + i with the least difference, i below `count`; of
    /// equally near ones those with i nearest to `middle`.
    pub(super) fn closest(
        &mut self,
        low: usize,
        high: usize,
        count: usize,
        middle: usize,
    ) -> Option<([f64; 2], usize)> {
        // stretches over which both indices stay in one bucket, with the least difference there can be
        let mut stretches = Vec::new();
        let (mut a, mut b) = (self.bucket_of_index(low), self.bucket_of_index(high));
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
            stretches.push(Stretch { from: i, to: end, buckets: [a, b], least, most });
            i = end;
        }
        let mut best = None;
        // two that are likely to have short differences first, so that few others can have less
        for of in [|s: &Stretch| s.least, |s: &Stretch| s.most] {
            let by = |&s: &usize, &t: &usize| of(&stretches[s]).total_cmp(&of(&stretches[t]));
            if let Some(place) = (0..stretches.len()).min_by(by) {
                let stretch = stretches.swap_remove(place);
                self.look_at(stretch, low, high, middle, &mut best);
            }
        }
        let can_be_less =
            |s: &Stretch, best: &Option<Shortest>| best.is_none_or(|b| s.least <= b.length);
        stretches.retain(|stretch| can_be_less(stretch, &best));
        stretches.sort_unstable_by(|s, t| s.least.total_cmp(&t.least));
        for stretch in stretches {
            if !can_be_less(&stretch, &best) {
                break;
            }
            self.look_at(stretch, low, high, middle, &mut best);
        }
        best.map(|best| (best.ends, best.index))
    }

    /// Looks for a shorter difference in a stretch.
    fn look_at(
        &mut self,
        stretch: Stretch,
        low: usize,
        high: usize,
        middle: usize,
        best: &mut Option<Shortest>,
    ) {
        for bucket in stretch.buckets {
            self.sort(bucket);
        }
        for index in stretch.from..stretch.to {
            let ends = [self.values[low + index], self.values[high + index]];
            let (length, distance) = (ends[1] - ends[0], index.abs_diff(middle));
            let is_better = best.is_none_or(|best| {
                length < best.length || (length == best.length && distance < best.distance)
            });
            if is_better {
                *best = Some(Shortest { length, distance, ends, index });
            }
        }
    }
}

/// The least difference that was found.
#[derive(Clone, Copy, Debug)]
struct Shortest {
    length: f64,
    /// How far its index lies from the middle.
    distance: usize,
    ends: [f64; 2],
    index: usize,
}

/// Indices over which both ends stay in one bucket each.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: usize,
    to: usize,
    buckets: [usize; 2],
    /// No difference is less.
    least: f64,
    /// Some difference is no more.
    most: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values have the same buckets on every path of the machine, and greater ones never lower ones.
    #[test]
    fn buckets_are_the_same_on_every_path() {
        let windows = Windows {
            low: -1.6,
            median_low: -0.05,
            median_high: 0.04,
            high: 1.7,
            ends: [-3.5, 3.25],
        };
        // beyond the ends, on the edges of the windows, between them
        let mut values: Vec<f64> = (0..4001).map(|i| f64::from(i - 2000) * 0.002).collect();
        values.extend([-1.6, -0.05, 0.04, 1.7, -3.5, 3.25, -1e300, 1e300, 0.0, -0.0]);
        values.sort_unstable_by(f64::total_cmp);
        for windows in [windows, Windows::ALL] {
            let layout = BucketLayout::new(&[&values], &windows, 333);
            let of = |path: CodePath| {
                let mut out = vec![0; values.len()];
                buckets_of(path, &layout, &values, &mut out);
                out
            };
            let baseline = of(CodePath::BASELINE);
            assert!(baseline.is_sorted());
            assert!(baseline[0] == 0 && usize::from(baseline[values.len() - 1]) < layout.ends()[2]);
            for path in CodePath::available() {
                assert_eq!(of(path), baseline, "{}", path.name());
            }
        }
    }

    /// Order statistics and the shortest interval against a full sort, for values that fill the
    /// buckets evenly, pile up in one, or are all equal.
    #[test]
    #[cfg_attr(miri, ignore = "many numbers, and no unsafe code that the other test does not run")]
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
            sorted.sort_unstable_by(f64::total_cmp);
            let parts: Vec<&[f64]> = values.chunks(777).collect();
            let mut buckets = BucketPartition::new(CodePath::best(), &parts, &Windows::ALL);
            for index in (0..values.len()).step_by(97) {
                assert_eq!(buckets.at(index).to_bits(), sorted[index].to_bits());
            }
            let (count, q) = (values.len() / 4, values.len() - values.len() / 4);
            let lengths = (0..count).map(|i| sorted[q + i] - sorted[i]);
            let least = lengths.fold(f64::INFINITY, f64::min);
            let middle = count / 2;
            let wanted = (0..count)
                .filter(|&i| sorted[q + i] - sorted[i] == least)
                .min_by_key(|i| i.abs_diff(middle))
                .map(|i| ([sorted[i], sorted[q + i]], i));
            assert_eq!(buckets.closest(0, q, count, middle), wanted);
        }
    }
}
