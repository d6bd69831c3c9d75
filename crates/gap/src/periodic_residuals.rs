//! A sine in what a verdict leaves: along a condition, or along the rows.
//!
//! Departures that change faster than from one setting to the next are noise to the smooth forms of
//! [`gumption_inference::discrepancy`], and a sine of a few rows a period is told from a larger noise by nothing else
//! than its line in the spectrum. The spectrum is that of least squares (N. R. Lomb, Astrophysics and
//! Space Science 39 (1976) 447), with a level of its own, at frequencies between those of smooth
//! departures and half of the mean sampling rate.

use super::diagnosis::RowGap;
use gumption_engine::number::{ascending, elementary};

/// A sine in some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PeriodicLine {
    /// Periods for each unit of the abscissa.
    pub(crate) frequency: f64,
    /// The amplitude, in the unit of the values.
    pub(crate) amplitude: f64,
    /// The share of the values' variance that it explains.
    pub(crate) share: f64,
}

/// Fewer values than this, or of fewer abscissas, have no spectrum.
const FEWEST: usize = 20;

/// More values than this are not looked at.
const MOST: usize = 2000;

/// What makes fewer periods than this over the values is a smooth departure.
const SLOWEST: f64 = 3.0;

/// Slower ones are looked at from this many periods on: what is stronger there is no line.
const TREND: f64 = 0.5;

/// Frequencies that are looked at for each one that is told apart.
const OVERSAMPLING: f64 = 4.0;

/// Among independent values a line is found by chance with this probability.
const CHANCE: f64 = 1e-6;

/// A line explains this share of the variance at least, and times as much as any other frequency: noise with
/// a memory has no single line.
const LEAST_SHARE: f64 = 0.25;
const TIMES_OTHERS: f64 = 4.0;

/// A line in what is left of an output.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PeriodicResiduals {
    /// The output, by its place among those with data.
    pub(crate) output: usize,
    /// The condition that it is periodic in; none: along the rows.
    pub(crate) condition: Option<usize>,
    pub(crate) line: PeriodicLine,
}

/// The strongest line in what a verdict leaves of an output.
pub(crate) fn found(rows: &[RowGap], conditions: usize) -> Option<PeriodicResiduals> {
    let outputs = rows.first()?.outputs.len();
    let looks = outputs * (conditions + 1);
    let along = (0..conditions).map(Some).chain([None]);
    let left = |output: usize| -> Option<Vec<f64>> {
        rows.iter().map(|row| row.outputs.get(output).map(|value| value.left)).collect()
    };
    let left: Vec<Option<Vec<f64>>> = (0..outputs).map(left).collect();
    let mut all: Vec<PeriodicResiduals> = Vec::new();
    for condition in along {
        let at = |(number, row): (usize, &RowGap)| match condition {
            Some(condition) => row.conditions.get(condition).copied().unwrap_or(f64::NAN),
            None => number as f64,
        };
        let abscissas: Vec<f64> = rows.iter().enumerate().map(at).collect();
        for (output, left) in left.iter().enumerate() {
            let line = left.as_ref().and_then(|left| line(&abscissas, left, looks));
            all.extend(line.map(|line| PeriodicResiduals { output, condition, line }));
        }
    }
    // the rows are named where no condition tells it as well
    let share = |residuals: &PeriodicResiduals| {
        residuals.line.share - if residuals.condition.is_none() { 0.05 } else { 0.0 }
    };
    all.into_iter().max_by(|a, b| share(a).total_cmp(&share(b)))
}

/// The line in values at some abscissas, if they have one; `looks` is in how many sets of values it is
/// looked for.
pub(crate) fn line(abscissas: &[f64], values: &[f64], looks: usize) -> Option<PeriodicLine> {
    let n = values.len();
    if !(FEWEST..=MOST).contains(&n) || abscissas.len() != n {
        return None;
    }
    let mut sorted = abscissas.to_vec();
    ascending(&mut sorted);
    sorted.dedup();
    let range = sorted.last()? - sorted.first()?;
    if sorted.len() < FEWEST || !(range > 0.0 && range.is_finite()) {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n as f64;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    if !(squares > 0.0 && squares.is_finite()) {
        return None;
    }
    let resolution = 1.0 / range;
    let highest = 0.5 * (sorted.len() - 1) as f64;
    let steps = ((highest - TREND) * OVERSAMPLING) as usize;
    let spectrum: Vec<(f64, Sine)> = (0..=steps)
        .map(|step| (TREND + step as f64 / OVERSAMPLING) * resolution)
        .filter_map(|frequency| Some((frequency, Sine::of(abscissas, values, mean, frequency)?)))
        .collect();
    let fast = spectrum.iter().filter(|(frequency, _)| *frequency >= SLOWEST * resolution);
    let &(frequency, best) = fast.max_by(|a, b| a.1.gain.total_cmp(&b.1.gain))?;
    let share = best.gain / squares;
    let one = elementary::exp(0.5 * (n as f64 - 3.0) * libm::log1p(-share.min(1.0 - 1e-12)));
    if share < LEAST_SHARE || one * (spectrum.len() * looks.max(1)) as f64 > CHANCE {
        return None;
    }
    // its own flanks, and those of its multiples
    let is_own = |other: f64| {
        let multiple = (other / frequency).round().max(1.0);
        (other - multiple * frequency).abs() < 1.5 * resolution
    };
    let others = spectrum.iter().filter(|(other, _)| !is_own(*other));
    let second = others.map(|(_, sine)| sine.gain).fold(0.0, f64::max);
    // what the line leaves is larger where the line is not removed: compared with it
    (second * TIMES_OTHERS < best.gain).then_some(PeriodicLine {
        frequency,
        amplitude: best.amplitude,
        share,
    })
}

/// A sine of least squares beside a level.
#[derive(Clone, Copy, Debug)]
struct Sine {
    /// By how much it makes the sum of squares smaller than the level alone.
    gain: f64,
    amplitude: f64,
}

impl Sine {
    /// `None` where a sine of that frequency is none at these abscissas.
    fn of(abscissas: &[f64], values: &[f64], mean: f64, frequency: f64) -> Option<Self> {
        let n = values.len() as f64;
        let (mut c, mut s, mut cc, mut cs) = (0.0, 0.0, 0.0, 0.0);
        let (mut yc, mut ys) = (0.0, 0.0);
        for (at, value) in abscissas.iter().zip(values) {
            let turns = frequency * at;
            let (sin, cos) = elementary::sin_cos_turn(turns - turns.floor());
            (c, s, cc, cs) = (c + cos, s + sin, cc + cos * cos, cs + cos * sin);
            (yc, ys) = (yc + (value - mean) * cos, ys + (value - mean) * sin);
        }
        // about the means; the values' is 0
        let (vc, vs) = (cc - c * c / n, n - cc - s * s / n);
        let covariance = cs - c * s / n;
        let determinant = vc * vs - covariance * covariance;
        if determinant <= 1e-3 * n * n / 4.0 {
            return None;
        }
        let a = (yc * vs - ys * covariance) / determinant;
        let b = (ys * vc - yc * covariance) / determinant;
        Some(Self { gain: a * yc + b * ys, amplitude: elementary::hypot(a, b) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::{BLOCK, StreamKey};
    use gumption_engine::special;

    /// Independent standard normal values.
    fn normals(seed: u64, count: usize) -> Vec<f64> {
        let mut uniform = [0.0; BLOCK];
        StreamKey::new(seed, "residuals").block(0).uniform(&mut uniform);
        uniform[..count].iter().map(|u| special::normal::quantile(*u)).collect()
    }

    /// A sine of twice the noise or more is found at its frequency whatever rows a period has, above two
    /// and a half; its amplitude scatters by sqrt(2/n).
    #[test]
    fn lines_are_found() {
        for (n, periods, amplitude) in [
            (60, 15.0, 2.0),
            (100, 20.0, 2.0),
            (100, 30.0, 6.0),
            (200, 80.0, 2.0),
            (200, 13.0, 3.0),
        ] {
            let at: Vec<f64> = (0..n).map(|i| 10.0 * i as f64 / (n - 1) as f64).collect();
            let noise = normals(n as u64, n);
            let of = |(t, z): (&f64, &f64)| {
                amplitude * (std::f64::consts::TAU * periods * t / 10.0 + 0.7).sin() + z
            };
            let values: Vec<f64> = at.iter().zip(&noise).map(of).collect();
            let found = line(&at, &values, 1).expect("a line");
            assert!((found.frequency * 10.0 / periods - 1.0).abs() < 0.03, "{periods}: {found:?}");
            // the grid is within an eighth of a period, which takes 3 % of the amplitude
            let error = (2.0 / n as f64).sqrt();
            assert!(
                (found.amplitude - amplitude).abs() < 4.0 * error + 0.1 * amplitude,
                "{found:?}"
            );
        }
    }

    /// No line in independent noise, whose chance is 1e-6 a set, or in a trend. Noise with a memory has one
    /// in fewer than a hundredth of its sets (where neighbours alternate, at half of the sampling rate).
    #[test]
    fn noise_has_none() {
        let mut of_memory = 0;
        for seed in 0..60 {
            for n in [20, 60, 200] {
                let at: Vec<f64> = (0..n).map(|i| i as f64).collect();
                let noise = normals(seed, n);
                assert_eq!(line(&at, &noise, 1), None, "{seed} {n}");
                for memory in [0.6, 0.95, -0.6] {
                    let mut before = 0.0;
                    let values: Vec<f64> = noise
                        .iter()
                        .map(|z| {
                            before = memory * before + z;
                            before
                        })
                        .collect();
                    of_memory += usize::from(line(&at, &values, 1).is_some());
                }
                let trend: Vec<f64> =
                    at.iter().zip(&noise).map(|(t, z)| (t / n as f64).powi(2) * 30.0 + z).collect();
                assert_eq!(line(&at, &trend, 1), None, "{seed} {n}");
            }
        }
        assert!(of_memory <= 5, "{of_memory} of 540");
    }
}
