//! Whether values are multiples of a step, as those of a converter or of a file with few decimals are.

/// Values that are looked at.
pub(crate) const LOOKED_AT: usize = 4096;

/// How far a gap between values may be from a whole number of steps, of that number; and, of the
/// largest value, what single precision and scaling round.
const OFF: f64 = 1e-3;
const ROUNDED: f64 = 4e-7;

/// Different values that a lattice must have been seen at: by chance as many have a probability of
/// (2 [`OFF`])^n.
const LEAST: usize = 5;

/// The step that values are multiples of, but for a constant; none where there is none above `least`.
pub(crate) fn step(values: &[f64], least: f64) -> Option<f64> {
    let mut sorted = values.get(..LOOKED_AT.min(values.len()))?.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let (first, last) = (*sorted.first()?, *sorted.last()?);
    let rounded = ROUNDED * first.abs().max(last.abs());
    sorted.dedup_by(|next, kept| *next - *kept <= rounded);
    if sorted.len() < LEAST {
        return None;
    }
    let gaps = || sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let smallest = gaps().min_by(f64::total_cmp)?;
    // the smallest gap is a step, or some steps where values are few
    (1..=3).map(|part| smallest / f64::from(part)).find(|step| {
        let off = OFF + 2.0 * rounded / step;
        *step > least
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
        assert!((step(&rounded, 0.01).unwrap() / 0.05 - 1.0).abs() < 1e-9);
        // scaled in single precision, with a constant
        let single: Vec<f64> =
            rounded.iter().map(|x| f64::from((x * 0.244e-3) as f32) + 0.123).collect();
        assert!((step(&single, 0.05 * 0.1e-3).unwrap() / (0.05 * 0.244e-3) - 1.0).abs() < 1e-3);
        let smooth: Vec<f64> = (0..1000).map(wave).collect();
        assert_eq!(step(&smooth, 0.01), None);
        // a step far below the noise is nobody's concern
        assert_eq!(step(&rounded, 0.1), None);
        assert_eq!(step(&[1.0, 2.0, 1.0], 0.1), None);
        assert_eq!(step(&[], 0.1), None);
    }
}
