//! Whether values are multiples of a step, as those of a converter or of a file with few decimals are.

/// Values that are looked at.
pub(crate) const LOOKED_AT: usize = 4096;

/// How far a gap between values may be from a whole number of steps, of that number; and, of the
/// largest value, what single precision and scaling round, or double precision: a step may be that of
/// single precision itself, beside a large constant.
const OFF: f64 = 1e-3;
const ROUNDED: [f64; 2] = [4e-7, 4e-15];

/// Different values that a lattice must have been seen at: by chance as many have a probability of
/// (2 [`OFF`])^n.
const LEAST: usize = 5;

/// Values for each different one from which on fewer than [`LEAST`] different ones do: a record whose
/// values are not rounded has hardly any twice.
const AGAIN: usize = 4;

/// The part of a step that the fit must leave of so few different values. What it explains to less, a
/// sine without noise at four samples in each period, is not rounded.
const LEFT: f64 = 1e-3;

/// The step that values are multiples of, but for a constant; none where there is none that counts
/// beside residuals of the standard deviation `left`.
pub(crate) fn step(values: &[f64], left: f64) -> Option<f64> {
    let mut sorted = values.get(..LOOKED_AT.min(values.len()))?.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let largest = sorted.first()?.abs().max(sorted.last()?.abs());
    ROUNDED.into_iter().find_map(|share| step_of(sorted.clone(), share * largest, left))
}

/// The same of sorted values, of which those that are apart by no more than `rounded` are one.
fn step_of(mut sorted: Vec<f64>, rounded: f64, left: f64) -> Option<f64> {
    // a step below a third of the noise adds less than a hundredth to its variance
    let least = left / 3.0;
    let levels = || sorted.chunk_by(|before, next| *next - *before <= rounded);
    let (different, met_again) = (levels().count(), levels().filter(|of| of.len() > 1).count());
    let few = different < LEAST;
    if few && (met_again < 2 || sorted.len() < AGAIN * different) {
        return None;
    }
    sorted.dedup_by(|next, kept| *next - *kept <= rounded);
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
        let apart: Vec<f64> = (0..300).map(|i| [0.0, 1.0, 4.137][i % 3]).collect();
        assert_eq!(step(&apart, 1.0), None);
    }
}
