//! Data that are a well-known multiple of the sim: a slip of the unit, and no effect.
//!
//! A prefix, a turn, a peak value for an effective one or a sign that was mistaken multiplies all values of
//! an output. Of effects a gain comes nearest, with a prior that excludes it, or a departure that no one
//! would think of.

use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::number::{elementary, median};
use gumption_inference::setup::Setup;

/// The median of the ratios is known for one of the factors within this share of it.
const NEAR: f64 = 0.02;

/// Half of the ratios are nearer to their median than this share of it.
const TOGETHER: f64 = 0.05;

/// Single ratios are those of a power of ten within this share of it.
const ALIKE: f64 = 0.3;

/// Rows of either kind where some rows have a factor and others have none.
const LEAST_ROWS: usize = 3;

/// Ratios that there must be.
const LEAST_RATIOS: usize = 4;

/// Values of the sim below this share of the largest one give no ratios.
const LEAST_SIM: f64 = 1e-3;

/// Powers of ten of prefixes, at most.
const MOST_POWER: i32 = 12;

/// An output whose values are all about the same multiple of the sim.
pub(crate) struct UnitSlip {
    /// The observed output.
    pub(crate) output: usize,
    /// The median of the ratios.
    pub(crate) ratio: f64,
    /// What makes such a factor.
    pub(crate) cause: Fact,
    /// The rows that have it, counted from 0, where others agree with the sim; none: all have it.
    pub(crate) rows: Option<Vec<usize>>,
}

/// The first output whose values are the sim times a factor that slips of units have.
pub(crate) fn found(setup: &Setup<'_>) -> Option<UnitSlip> {
    let data = &setup.data;
    (0..data.outputs.len()).filter(|&output| data.turns[output].is_none()).find_map(|output| {
        let sims: Vec<f64> =
            data.point_of.iter().map(|&point| data.points[point].nominal[output]).collect();
        let largest = sims.iter().fold(0.0_f64, |most, sim| most.max(sim.abs()));
        let pairs = data.values[output].iter().zip(&sims).enumerate();
        let by_row: Vec<(usize, f64)> = pairs
            .filter(|(_, (_, sim))| sim.abs() > LEAST_SIM * largest)
            .map(|(row, (value, sim))| (row, value / sim))
            .filter(|(_, ratio)| ratio.is_finite())
            .collect();
        if by_row.len() < LEAST_RATIOS {
            return None;
        }
        if let Some((rows, ratio)) = of_some_rows(&by_row) {
            let cause = fact!("slip-of.prefix");
            return Some(UnitSlip { output, ratio, cause, rows: Some(rows) });
        }
        let ratios: Vec<f64> = by_row.into_iter().map(|(_, ratio)| ratio).collect();
        let ratio = median(ratios.clone())?;
        let apart = median(ratios.iter().map(|other| (other - ratio).abs()).collect())?;
        let cause = cause(ratio).filter(|_| apart < TOGETHER * ratio.abs())?;
        Some(UnitSlip { output, ratio, cause, rows: None })
    })
}

/// The rows (from 0) whose values are one power of ten times the sim, and that power, where all others
/// agree with the sim: as where two files are joined of which one is in mV.
fn of_some_rows(ratios: &[(usize, f64)]) -> Option<(Vec<usize>, f64)> {
    let power = |ratio: f64| power_of_ten(ratio, ALIKE).filter(|_| ratio > 0.0);
    let powers: Option<Vec<f64>> = ratios.iter().map(|(_, ratio)| power(*ratio)).collect();
    let powers = powers?;
    let other = powers.iter().copied().find(|power| *power != 0.0)?;
    let count = powers.iter().filter(|power| **power == other).count();
    let agree = powers.iter().filter(|power| **power == 0.0).count();
    let is_it = count >= LEAST_ROWS && agree >= LEAST_ROWS && count + agree == powers.len();
    let rows = ratios.iter().zip(&powers).filter(|(_, power)| **power == other);
    is_it.then(|| (rows.map(|((row, _), _)| *row).collect(), elementary::pow(10.0, other)))
}

/// The exponent of the power of ten that a ratio is within this share of, whatever its sign.
fn power_of_ten(ratio: f64, near: f64) -> Option<f64> {
    let power = elementary::log10(ratio.abs()).round();
    let is_near = (ratio.abs() / elementary::pow(10.0, power) - 1.0).abs() < near;
    is_near.then_some(power)
}

/// What makes a factor of this size.
fn cause(ratio: f64) -> Option<Fact> {
    const TURN: f64 = std::f64::consts::TAU;
    const DEGREE: f64 = std::f64::consts::PI / 180.0;
    let known = [
        (1.0, fact!("slip-of.sign")),
        (TURN, fact!("slip-of.turn")),
        (60.0, fact!("slip-of.minute")),
        (3600.0, fact!("slip-of.hour")),
        (DEGREE, fact!("slip-of.degree")),
        (std::f64::consts::SQRT_2, fact!("slip-of.peak")),
    ];
    let is_near = |factor: f64| (ratio.abs() / factor - 1.0).abs() < NEAR;
    let is_prefix = |power: f64| power != 0.0 && power.abs() <= f64::from(MOST_POWER);
    if power_of_ten(ratio, NEAR).is_some_and(is_prefix) {
        return Some(fact!("slip-of.prefix"));
    }
    known.into_iter().find_map(|(factor, cause)| {
        let is_it = if factor == 1.0 {
            ratio < 0.0 && is_near(1.0)
        } else {
            is_near(factor) || is_near(factor.recip())
        };
        is_it.then_some(cause)
    })
}

#[cfg(test)]
mod tests {
    use super::{cause, of_some_rows};

    #[test]
    fn some_rows_in_another_unit() {
        let of = |ratios: &[f64]| {
            let ratios: Vec<(usize, f64)> = ratios.iter().copied().enumerate().collect();
            of_some_rows(&ratios)
        };
        let found = of(&[1.0, 0.98, 1.02, 1003.0, 990.0, 1010.0]).unwrap();
        assert_eq!(found.0, [3, 4, 5]);
        assert!((found.1 / 1000.0 - 1.0).abs() < 1e-12);
        // two mistakes, two powers, a gain, and what is far from any power
        assert_eq!(of(&[1.0, 1.0, 1.0, 1.0, 1000.0, 1000.0]), None);
        assert_eq!(of(&[1.0, 1.0, 1.0, 10.0, 100.0, 1000.0, 1000.0]), None);
        assert_eq!(of(&[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]), None);
        assert_eq!(of(&[0.9, 1.1, 1.0, 1.05]), None);
    }

    #[test]
    fn factors_of_slips() {
        for (ratio, key) in [
            (0.001, Some("slip-of.prefix")),
            (-998.0, Some("slip-of.prefix")),
            (-1.0, Some("slip-of.sign")),
            (6.3, Some("slip-of.turn")),
            (57.3, Some("slip-of.degree")),
            (0.71, Some("slip-of.peak")),
            (1.0, None),
            (1.02, None),
            (2.0, None),
            (0.9, None),
        ] {
            assert_eq!(cause(ratio).map(|cause| cause.key), key, "{ratio}");
        }
    }
}
