//! The phase of an oscillation at a sample, exact over any length.

use gumption_engine::number::elementary::sin_cos_turn;
use gumption_engine::number::{CodePath, Kernel};

/// Two to the powers by which turns are kept as whole numbers.
const TWO_64: f64 = (1u128 << 64) as f64;
const TWO_120: f64 = (1u128 << 120) as f64;

/// Turns, modulo one, as a fraction of 2^128. Sums and multiples of them are exact, so that the
/// phase at the last sample of an hour is as good as at the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turns(u128);

impl Turns {
    /// A number of turns from 0 to below 1, or none where it is not.
    pub(crate) fn new(turns: f64) -> Option<Self> {
        // exact for all that is not below 2^-68
        (0.0..1.0).contains(&turns).then_some(Self(((turns * TWO_120) as u128) << 8))
    }

    /// So many times as much.
    pub(crate) fn times(self, count: u64) -> Self {
        Self(self.0.wrapping_mul(u128::from(count)))
    }

    /// Half as much of what is below one turn.
    pub(crate) fn half(self) -> Self {
        Self(self.0 >> 1)
    }

    /// From the first of so many samples to the middle of them.
    pub(crate) fn to_middle(self, samples: u64) -> Self {
        self.half().times(samples.saturating_sub(1))
    }

    /// The sum, modulo one turn.
    pub(crate) fn plus(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }

    /// The difference of two, without its sign.
    pub(crate) fn apart(self, other: Self) -> Self {
        Self(self.0.abs_diff(other.0))
    }

    /// As a number from 0 to 1.
    pub(crate) fn value(self) -> f64 {
        (self.0 >> 64) as u64 as f64 / TWO_64
    }

    /// Sine and cosine of that many turns; small angles keep their relative accuracy.
    pub(crate) fn sin_cos(self) -> (f64, f64) {
        let signed = (self.0 >> 64) as u64 as i64 as f64 / TWO_64;
        if signed < 0.0 {
            let (sin, cos) = sin_cos_turn(-signed);
            (-sin, cos)
        } else {
            sin_cos_turn(signed)
        }
    }
}

/// Cosines and sines of an oscillation at the samples of a block that begins with sample `first`.
pub(crate) fn oscillation(step: Turns, first: u64, cos: &mut [f64], sin: &mut [f64]) {
    CodePath::best().run(Oscillation { step, first, cos, sin });
}

struct Oscillation<'a> {
    step: Turns,
    first: u64,
    cos: &'a mut [f64],
    sin: &'a mut [f64],
}

impl Kernel for Oscillation<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { step, first, cos, sin } = self;
        let start = (step.times(first).0 >> 64) as u64;
        // within a block the error of 64 bits stays below 2^-50 turns for 2^14 samples
        let by = (step.0 >> 64) as u64;
        for (i, (cos, sin)) in cos.iter_mut().zip(sin).enumerate() {
            let at = start.wrapping_add(by.wrapping_mul(i as u64));
            // 53 bits as a signed number: every processor with vectors converts that at once
            let turn = (at >> 11).cast_signed() as f64 / 9_007_199_254_740_992.0;
            (*sin, *cos) = sin_cos_turn(turn);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_phase_after_an_hour_is_exact() {
        // 1/1000 of a turn as the nearest double; after 1.8e8 samples the double's own rounding
        // (2e-20 turns a sample) has grown to 4e-12 turns, and nothing else may be added
        let step = Turns::new(0.001).unwrap();
        let (sin, cos) = step.times(180_000_000).sin_cos();
        assert!(sin.abs() < 1e-10 && (cos - 1.0).abs() < 1e-15, "{sin} {cos}");
        let (mut cos, mut sin) = ([0.0; 250], [0.0; 250]);
        oscillation(step, 180_000_000, &mut cos, &mut sin);
        // a quarter of a turn later, one sample before it
        let expected = (2.0 * std::f64::consts::PI * 0.249).sin();
        assert!((sin[249] - expected).abs() < 1e-10);
    }

    #[test]
    fn halves_and_differences() {
        let (a, b) = (Turns::new(0.75).unwrap(), Turns::new(0.5).unwrap());
        assert_eq!(a.half().value(), 0.375);
        assert_eq!((a.plus(b).value(), b.apart(a).value()), (0.25, 0.25));
        assert_eq!((Turns::new(1.0), Turns::new(-0.1), Turns::new(f64::NAN)), (None, None, None));
    }
}
