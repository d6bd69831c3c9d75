//! What rounding to a resolution does to the amplitude of a sine, beyond noise.
//!
//! Rounding to steps q adds the sawtooth (q/pi) sum over k of (-1)^k/k sin(2 pi k x/q). Of a sine of
//! amplitude A about a level c its part at the n-th multiple of the frequency is
//! (2 q/pi) sum of (-1)^k/k J_n(2 pi k A/q) cos(2 pi k c/q + n pi/2), less by exp(-2 (pi k s/q)^2) for
//! noise of standard deviation s before rounding (Widrow and Kollár, Quantization Noise, 2008,
//! chapters on dither and on sines). Where the level within a step is not known, and with J^2 about
//! 1/(pi z) for large z, its variance is q^3/(pi^4 A) sum of k^-3 exp(-(2 pi k s/q)^2).

use std::f64::consts::PI;

use gumption_engine::number::elementary::exp;

/// The standard deviation of the error that rounding to steps of `resolution` makes in the
/// amplitude of a sine, for an unknown level within a step. `noise` is the standard deviation of
/// the noise before rounding; all in one unit. At most that of a value rounded once.
pub fn amplitude_error(resolution: f64, amplitude: f64, noise: f64) -> f64 {
    let (steps, spread) = (amplitude / resolution, noise / resolution);
    let term = |k: u32| {
        let k = f64::from(k);
        exp(-(2.0 * PI * k * spread) * (2.0 * PI * k * spread)) / (k * k * k)
    };
    let sum: f64 = (1..=20).map(term).sum();
    let largest = 1.0 / 12f64.sqrt();
    let error = (sum / (PI * PI * PI * PI * steps)).sqrt();
    resolution * if error < largest { error } else { largest }
}

/// The variance that rounding to whole steps adds: step^2 / 12 (JCGM 100, F.2.2.1), in the squared
/// unit of the step. White only where the noise or the signal moves over many steps.
pub fn quantization_variance(step: f64) -> f64 {
    step * step / 12.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of the amplitude of 1000 rounded sines against the formula: their rms scatters by
    /// 1/sqrt(2 x 1000) x 1.2 or so, 3 %; four times that is allowed (one false failure in 10^4).
    #[test]
    fn rounded_sines_have_that_error() {
        for (amplitude, noise) in [(20.0, 0.0), (127.3, 0.0), (20.0, 0.12)] {
            let mut squares = 0.0;
            for case in 0..1000 {
                let level = f64::from(case) * 0.618_033_988_749_894_9;
                let amplitude = amplitude + f64::from(case) * 0.001_234_5;
                let mut sum = 0.0;
                let points = 4000;
                for i in 0..points {
                    let turn = (f64::from(i) + 0.5) / f64::from(points);
                    let sin = (2.0 * PI * turn).sin();
                    // noise that sweeps its quantiles in a scrambled order
                    let p = (f64::from(i * 1597 % points) + 0.5) / f64::from(points);
                    let z = gumption_engine::special::normal::quantile(p);
                    sum += (level + amplitude * sin + noise * z).round() * sin;
                }
                let error = 2.0 * sum / f64::from(points) - amplitude;
                squares += error * error;
            }
            let rms = (squares / 1000.0).sqrt();
            let expected = amplitude_error(1.0, amplitude + 0.6, noise);
            assert!((rms / expected - 1.0).abs() < 0.12, "{amplitude} {noise}: {rms} {expected}");
        }
    }
}
