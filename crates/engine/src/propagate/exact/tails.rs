//! What lies beyond the places of a quadrature over probabilities: the ends of a heavy tail, which hold no
//! probability to speak of and much of a moment.
//!
//! The panels of the quadrature shrink towards an end by a quarter each. Where a moment is an integral
//! over p^-s near the end, what the panels contribute falls by 4^(s - 1) each time: what comes behind the
//! last one is the rest of a geometric series, and there is none where s is 1 or more.

/// Panels that are taken together, a ring.
pub(super) const PANELS: u32 = 3;

/// Rings at an end that are looked at, the innermost first.
pub(super) const RINGS: usize = 3;

/// Shares of a moment below this are lost in rounding.
const NEGLIGIBLE: f64 = 1e-15;

/// Ratios of neighbouring rings from here on are those of a moment that does not exist; what behaves like
/// 1/p has 1, up to what other powers of p = 1e-17 add to it. A moment that exists with a ratio that near
/// to 1 would not be found to any digits.
const DIVERGES: f64 = 1.0 - 1e-5;

/// Whether neighbouring rings, the inner one first, are those of a moment that does not exist.
pub(super) fn diverges(inner: f64, outer: f64) -> bool {
    inner.is_infinite() || inner / outer >= DIVERGES
}

/// What the places beyond an end add to an expectation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Beyond {
    /// What is added; infinite where the expectation does not exist.
    pub(super) value: f64,
    /// How far that may be off.
    pub(super) off: f64,
}

impl Beyond {
    /// From what the innermost rings contribute to an expectation whose terms, all positive, sum to
    /// `scale`.
    pub(super) fn of(rings: [f64; RINGS], scale: f64) -> Self {
        let [last, before, first] = rings;
        if last.abs() <= NEGLIGIBLE * scale {
            return Self::default();
        }
        let (ratio, earlier) = (last / before, before / first);
        if diverges(last, before) {
            return Self { value: f64::INFINITY.copysign(last), off: 0.0 };
        }
        let rest = |ratio: f64| last * ratio / (1.0 - ratio);
        let off = (rest(ratio) - rest(earlier)).abs();
        Self { value: rest(ratio), off: if off.is_nan() { f64::INFINITY } else { off } }
    }

    /// Whether there is nothing to add.
    pub(super) fn is_negligible(self) -> bool {
        self.value == 0.0 && self.off == 0.0
    }
}

impl std::ops::AddAssign for Beyond {
    fn add_assign(&mut self, other: Self) {
        self.value += other.value;
        self.off += other.off;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integrals over p^-s from 0 to the end of the innermost ring: p^(1-s)/(1-s).
    #[test]
    fn the_rest_of_powers() {
        let end = 1e-17;
        for s in [0.0, 0.8, 0.95] {
            let upto = |p: f64| p.powf(1.0 - s) / (1.0 - s);
            let outer = |n: i32| end * 64f64.powi(n);
            let ring = |n: i32| upto(outer(n + 1)) - upto(outer(n));
            let found = Beyond::of([ring(0), ring(1), ring(2)], 1.0);
            if s == 0.0 {
                assert!(found.is_negligible());
                continue;
            }
            assert!((found.value / upto(end) - 1.0).abs() < 1e-12, "{s}: {found:?}");
            assert!(found.off < 1e-12, "{s}: {found:?}");
        }
        // a logarithm
        assert_eq!(Beyond::of([1.0, 1.0, 1.0], 100.0).value, f64::INFINITY);
        assert_eq!(Beyond::of([-4.0, -2.0, -1.0], 10.0).value, f64::NEG_INFINITY);
    }
}
