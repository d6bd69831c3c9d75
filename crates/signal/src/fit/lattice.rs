//! Whether values are multiples of a step, as those of a converter or of a file with few decimals are.

use gumption_engine::number::{ascending, elementary};

/// Values that are looked at.
pub(crate) const LOOKED_AT: usize = 4096;

/// How far a gap between values may be from a whole number of steps, of that number; and, of the
/// largest value, what single precision and scaling round, or double precision: a step may be that of
/// single precision itself, beside a large constant.
const OFF: f64 = 1e-3;
const ROUNDED: [f64; 2] = [4e-7, 4e-15];

/// What reading a number, an offset and a scale round, as a share of the largest value.
const EXACT: f64 = 5e-16;

/// Different values that a lattice must have been seen at: by chance as many have a probability of
/// (2 [`OFF`])^n.
const LEAST: usize = 5;

/// Values for each different one from which on fewer than [`LEAST`] different ones do: a record whose
/// values are not rounded has hardly any twice.
const AGAIN: usize = 4;

/// The part of a step that the fit must leave of so few different values. What it explains to less, a
/// sine without noise at four samples in each period, is not rounded.
const LEFT: f64 = 1e-3;

/// Of fewer different values than [`LEAST`] the smallest gap must be so many steps: the few of a sine
/// without noise at three, four or six samples in each period may be multiples of each other.
const APART: f64 = 10.0;

/// What is found may come by chance with this probability.
const BY_CHANCE: f64 = 1e-6;

/// A step is known where rounding leaves less than this share of it open.
const KNOWN: f64 = 0.02;

/// Whole numbers have a divisor in common by chance with this probability, at most.
const COMMON_BY_CHANCE: f64 = 0.05;

/// Numbers are printed with so many decimals, at most.
const MOST_DECIMALS: i32 = 15;

/// So many numbers of steps in the smallest gap are tried, at most, on both sides of the most likely one.
const MOST_COUNTS: f64 = 1000.0;

/// A step of a converter is at least so many of the file's decimals: of a finer one the file says nothing.
const COARSER: f64 = 3.0;

/// The smallest gap is so many steps of a converter, at most.
const PARTS: u32 = 2000;

/// Values whose differences are compared with each other, and not with the smallest value alone.
const COMPARED: usize = 48;

/// The step that values are multiples of, but for a constant; none where there is none that counts
/// beside residuals of the standard deviation `left`. Where it is that of a file's decimals, and a
/// converter's coarser one stands behind it, it is the latter.
pub(crate) fn step(values: &[f64], left: f64) -> Option<f64> {
    let mut sorted = values.get(..LOOKED_AT.min(values.len()))?.to_vec();
    ascending(&mut sorted);
    let largest = sorted.first()?.abs().max(sorted.last()?.abs());
    let regular =
        ROUNDED.into_iter().find_map(|share| step_of(sorted.clone(), share * largest, left));
    let rounded = 2.0 * EXACT * largest;
    let are_enough = are_enough(&sorted, rounded);
    sorted.dedup_by(|next, kept| *next - *kept <= rounded);
    let fine = match regular {
        None if are_enough => decimals(&sorted).or_else(|| common_step(&sorted, EXACT * largest)),
        found => found,
    }?;
    let counts = |step: &f64| *step > left / 3.0;
    coarser(&sorted, fine).filter(counts).or(Some(fine).filter(counts))
}

/// Whether sorted values, of which those that are apart by no more than `rounded` are one, are many or come
/// again and again.
fn are_enough(sorted: &[f64], rounded: f64) -> bool {
    let levels = || sorted.chunk_by(|before, next| *next - *before <= rounded);
    let (different, met_again) =
        (levels().count(), levels().filter(|level| level.len() > 1).count());
    different >= LEAST || (met_again > 1 && sorted.len() >= AGAIN * different)
}

/// The last decimal of which sorted values are multiples, as long as nothing has scaled them since they were
/// printed.
fn decimals(sorted: &[f64]) -> Option<f64> {
    let is_last = |last: &f64| {
        let mut ln_chance = 0.0;
        for value in sorted.iter().filter(|value| **value != 0.0) {
            let (count, off) = (value / last, 4.0 * EXACT * value.abs() / last);
            if off > 0.1 || (count - count.round()).abs() > off {
                return false;
            }
            ln_chance += elementary::ln(2.0 * off);
        }
        ln_chance < elementary::ln(BY_CHANCE)
    };
    let last = (0..MOST_DECIMALS).map(|decimals| f64::powi(0.1, decimals)).find(is_last)?;
    let gaps = || sorted.windows(2).map(|pair| ((pair[1] - pair[0]) / last).round());
    // as many of them as all gaps have in common, if not by chance
    let common = gaps().fold(0.0, greatest_common_divisor);
    let others = sorted.len().saturating_sub(2);
    let is_chance = others as f64 * elementary::ln(common) < -elementary::ln(COMMON_BY_CHANCE);
    let steps = if is_chance { 1.0 } else { common };
    let smallest = gaps().min_by(f64::total_cmp)?;
    (sorted.len() >= LEAST || smallest > APART * steps).then_some(steps * last)
}

/// Of whole numbers.
fn greatest_common_divisor(mut a: f64, mut b: f64) -> f64 {
    while b != 0.0 {
        (a, b) = (b, a % b);
    }
    a
}

/// The largest step of which all gaps between sorted values, each known to `rounded`, are multiples, however
/// large: by Euclid's algorithm, with what rounding leaves open.
fn common_step(sorted: &[f64], rounded: f64) -> Option<f64> {
    let gaps: Vec<f64> = sorted.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let smallest = *gaps.iter().min_by(|a, b| a.total_cmp(b))?;
    let (mut step, mut open) = (smallest, 2.0 * rounded);
    for &gap in &gaps {
        let (mut above, mut above_open) = (gap, 2.0 * rounded);
        loop {
            let count = (above / step).round();
            let rest = (above - count * step).abs();
            let rest_open = above_open + count * open;
            if rest <= rest_open {
                break;
            }
            (above, above_open) = (step, open);
            (step, open) = (rest, rest_open);
            if open > KNOWN * step {
                return None;
            }
        }
    }
    // of how many steps the smallest gap is, and with that all others
    let around = (smallest / step).round();
    let open = (around * open / step).ceil();
    if open > MOST_COUNTS {
        return None;
    }
    let is_few = sorted.len() < LEAST;
    let counts = (0..=2 * open as usize)
        .map(|n| around + (n.div_ceil(2) as f64).copysign(n as f64 % 2.0 - 0.5));
    let is_known = |step: &f64| {
        // all steps down to this one might have been found, and the smallest gap has any of them
        let mut ln_chance = elementary::ln(smallest / step);
        for gap in gaps.iter().filter(|gap| **gap != smallest) {
            let off = 2.0 * rounded / step * (1.0 + gap / smallest);
            if off > 0.1 || (gap / step - (gap / step).round()).abs() > off {
                return false;
            }
            ln_chance += elementary::ln(2.0 * off);
        }
        ln_chance < elementary::ln(BY_CHANCE)
    };
    let counts = counts.filter(|count| *count >= if is_few { APART } else { 1.0 });
    let step = counts.map(|count| smallest / count).find(is_known)?;
    let whole = sorted.last()? - sorted.first()?;
    Some(whole / (whole / step).round())
}

/// The step of which sorted values are multiples that were rounded to those of a finer one.
fn coarser(sorted: &[f64], fine: f64) -> Option<f64> {
    let first = *sorted.first()?;
    let compared = &sorted[..COMPARED.min(sorted.len())];
    let pairs =
        compared.iter().enumerate().flat_map(|(n, a)| compared[..n].iter().map(move |b| a - b));
    let mut differences: Vec<f64> = pairs.collect();
    ascending(&mut differences);
    let smallest = *differences.first()?;
    differences.extend(sorted.iter().skip(COMPARED).map(|value| value - first));
    // both values of a difference are off by up to half of the finer step
    let ends =
        |difference: f64, steps: f64| [(difference - fine) / steps, (difference + fine) / steps];
    (1..=PARTS).find_map(|part| {
        let [mut low, mut high] = ends(smallest, f64::from(part));
        if low < COARSER * fine {
            return None;
        }
        for &difference in &differences {
            let least = ((difference - fine) / high).ceil().max(1.0);
            let most = ((difference + fine) / low).floor();
            if least > most {
                return None;
            }
            if least == most {
                let [from, to] = ends(difference, least);
                (low, high) = (low.max(from), high.min(to));
                if low > high {
                    return None;
                }
            }
        }
        let step = 0.5 * (low + high);
        let steps = (sorted.last()? - first) / step;
        let is_known = (high - low) * steps < 4.0 * fine;
        // beside the first value and the step
        let free = sorted.len().saturating_sub(2) as f64;
        let ln_chance = elementary::ln(2.0 * fine / step) * free + elementary::ln(f64::from(part));
        (is_known && ln_chance < elementary::ln(BY_CHANCE)).then_some(step)
    })
}

/// The same of sorted values, of which those that are apart by no more than `rounded` are one.
fn step_of(mut sorted: Vec<f64>, rounded: f64, left: f64) -> Option<f64> {
    // a step below a third of the noise adds less than a hundredth to its variance
    let least = left / 3.0;
    if !are_enough(&sorted, rounded) {
        return None;
    }
    sorted.dedup_by(|next, kept| *next - *kept <= rounded);
    let few = sorted.len() < LEAST;
    let gaps = || sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let smallest = gaps().min_by(f64::total_cmp)?;
    // the smallest gap is a step, or some steps where values are few
    (1..=3).map(|part| smallest / f64::from(part)).find(|step| {
        let off = OFF + 2.0 * rounded / step;
        *step > least
            && !(few && left < LEFT * step)
            && gaps().all(|gap| {
                let count = (gap / step).round();
                (gap / step - count).abs() < (off * count).min(0.1)
            })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_found_and_nothing_else() {
        let wave =
            |i: u32| 1.5 * (2.0 * std::f64::consts::PI * 0.00731 * f64::from(i)).sin() + 9.81;
        let rounded: Vec<f64> = (0..1000).map(|i| (wave(i) / 0.05).round() * 0.05).collect();
        assert!((step(&rounded, 0.03).unwrap() / 0.05 - 1.0).abs() < 1e-9);
        // scaled in single precision, with a constant
        let single: Vec<f64> =
            rounded.iter().map(|x| f64::from((x * 0.244e-3) as f32) + 0.123).collect();
        assert!((step(&single, 0.15 * 0.1e-3).unwrap() / (0.05 * 0.244e-3) - 1.0).abs() < 1e-3);
        let smooth: Vec<f64> = (0..1000).map(wave).collect();
        assert_eq!(step(&smooth, 0.03), None);
        // that of single precision, beside a constant: 2^-14 from 512 to 1024
        let offset: Vec<f64> =
            (0..1000).map(|i| f64::from((1e-3 * (wave(i) - 9.81) + 1000.0) as f32)).collect();
        assert_eq!(step(&offset, 2e-5), Some(f64::powi(2.0, -14)));
        // a step far below the noise is nobody's concern
        assert_eq!(step(&rounded, 0.3), None);
        assert_eq!(step(&[1.0, 2.0, 1.0], 0.3), None);
        assert_eq!(step(&[], 0.3), None);
    }

    /// Decimals of a file of which ten different values have few in common, and the steps of a converter that
    /// are no multiples of them, as dense as 200 and as sparse as ten values in a period.
    #[test]
    fn decimals_and_the_steps_behind_them() {
        let wave =
            |turns: f64| 0.49291 + 0.98822 * (2.0 * std::f64::consts::PI * turns + 0.1896).cos();
        let printed =
            |x: f64, decimals: usize| -> f64 { format!("{x:.decimals$}").parse().unwrap() };
        for (decimals, samples) in [(3, 10), (4, 10), (6, 10), (9, 10), (3, 3), (4, 4), (6, 100)] {
            let of = |i: usize| printed(wave((i % samples) as f64 / samples as f64), decimals);
            let values: Vec<f64> = (0..2000).map(of).collect();
            let wanted = f64::powi(10.0, -i32::try_from(decimals).unwrap());
            let found = step(&values, 1e-16).unwrap();
            assert!((found / wanted - 1.0).abs() < 1e-6, "{decimals} {samples} {found}");
            if decimals < 6 {
                // scaled after that
                let scaled: Vec<f64> = values.iter().map(|x| (x - 0.1) * 0.244e-3).collect();
                let found = step(&scaled, 1e-20).unwrap() / 0.244e-3;
                assert!((found / wanted - 1.0).abs() < 1e-6, "{decimals} {samples} {found}");
            }
        }
        for (lsb, decimals, samples) in [
            (5.0 / 256.0, 3, 20),
            (5.0 / 1024.0, 3, 199),
            (10.0 / 4096.0, 4, 10),
            (20.0 / 65536.0, 6, 199),
        ] {
            let of = |i: usize| {
                let x = wave((i % samples) as f64 / samples as f64);
                printed((x / lsb).round() * lsb, decimals)
            };
            let values: Vec<f64> = (0..2000).map(of).collect();
            let found = step(&values, 1e-16).unwrap();
            // a tenth of a per cent of a step changes nothing
            assert!((found / lsb - 1.0).abs() < 1e-3, "{decimals} {samples} {found}");
        }
        // nothing is rounded here but by floating point
        for samples in [5, 7, 10, 20, 199] {
            let values: Vec<f64> =
                (0..2000).map(|i| wave((i % samples) as f64 / samples as f64)).collect();
            assert_eq!(step(&values, 1e-16), None, "{samples}");
        }
    }

    /// Sines over two to four steps, and what has few different values without a step: constants, one
    /// far value, a sine without noise at three and at four samples in each period, levels that are no
    /// multiples.
    #[test]
    fn few_levels_are_a_lattice() {
        let wave = |turns: f64| (2.0 * std::f64::consts::PI * turns).sin();
        for (size, level, levels) in [(0.3, 0.4, 2), (1.2, 0.1, 3), (1.5, 0.45, 4)] {
            let rounded: Vec<f64> = (0..300)
                .map(|i| 0.2 * (size * wave(0.0173 * f64::from(i)) + level).round())
                .collect();
            let mut different = rounded.clone();
            different.sort_unstable_by(f64::total_cmp);
            different.dedup();
            assert_eq!(different.len(), levels);
            assert!((step(&rounded, 0.06).unwrap() / 0.2 - 1.0).abs() < 1e-9, "{levels}");
        }
        let mut values = vec![2.5; 300];
        assert_eq!(step(&values, 0.0), None);
        values[100] = 7.0;
        assert_eq!(step(&values, 0.26), None);
        for turns in [0.25, 1.0 / 3.0] {
            let exact: Vec<f64> = (0..300).map(|i| 9.8 + wave(turns * f64::from(i))).collect();
            assert_eq!(step(&exact, 1e-15), None);
        }
        let apart: Vec<f64> =
            (0..300).map(|i| [0.0, 1.0, 1.0 + std::f64::consts::PI][i % 3]).collect();
        assert_eq!(step(&apart, 1.0), None);
    }
}
