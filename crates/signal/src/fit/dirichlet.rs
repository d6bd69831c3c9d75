//! Sums of cosines over evenly spaced instants about their middle, in closed form.

use crate::turns::Turns;
use std::f64::consts::PI;

/// The sums over all samples of cos(2 pi c tau) and of tau sin(2 pi c tau), where tau counts samples
/// from the middle of the record; sums with an odd integrand are zero there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernel {
    /// The sum of cos(2 pi c tau): the Dirichlet kernel.
    pub(crate) cosines: f64,
    /// The sum of tau sin(2 pi c tau).
    pub(crate) moments: f64,
}

impl Kernel {
    /// Sums over `samples` of an oscillation of `cycles` in a sample interval, 0 to below 1.
    pub(crate) fn new(cycles: Turns, samples: u64) -> Self {
        let count = samples as f64;
        let (sin_n, cos_n) = cycles.half().times(samples).sin_cos();
        let (sin_1, cos_1) = cycles.half().sin_cos();
        let angle = PI * cycles.value() * count;
        if angle.abs() < 1e-3 {
            // the first terms of the series; the next are below 1e-12 of them
            let square = count * count - 1.0;
            let cosines = count - angle * angle / count * square / 6.0;
            return Self { cosines, moments: angle * square / 6.0 };
        }
        let cosines = sin_n / sin_1;
        Self { cosines, moments: -0.5 * (count * cos_n - cosines * cos_1) / sin_1 }
    }
}

/// The sum of cos(2 pi `cycles` tau) over `samples` instants tau one apart about zero, for `cycles`
/// above -1 and below 1.
pub(crate) fn sum_of_cosines(cycles: f64, samples: u64) -> f64 {
    Turns::new(cycles.abs()).map_or(samples as f64, |turns| Kernel::new(turns, samples).cosines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_are_the_sums() {
        for (cycles, samples) in [(0.0123, 400), (0.0123, 401), (0.31, 57), (1e-7, 1000), (0.9, 64)]
        {
            let kernel = Kernel::new(Turns::new(cycles).unwrap(), samples);
            let (mut cosines, mut moments) = (0.0, 0.0);
            for i in 0..samples {
                let tau = i as f64 - (samples as f64 - 1.0) / 2.0;
                let (sin, cos) = (2.0 * PI * cycles * tau).sin_cos();
                cosines += cos;
                moments += tau * sin;
            }
            // rounding of 1000 terms of the size of 1 and of 500
            assert!((kernel.cosines - cosines).abs() < 1e-10, "{cycles} {samples}");
            let scale = 1.0 + moments.abs() + samples as f64;
            assert!(
                (kernel.moments - moments).abs() < 1e-8 * scale,
                "{cycles} {samples} {moments}"
            );
        }
    }
}
