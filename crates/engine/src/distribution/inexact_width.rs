//! A width that is itself inexact: the meaning of the degrees of freedom of a rectangular,
//! triangular or trapezoidal distribution (JCGM 100, G.4.2), and how trials are drawn for them.
//!
//! G.4.2 gives nu = (1/2) (Delta u/u)^-2 for a standard uncertainty that is known to a relative
//! Delta u/u. Conversely, nu degrees of freedom make the width uncertain by the fraction e =
//! 1/sqrt(2 nu) in both directions. JCGM 101, 6.4.3 draws a rectangular quantity of such a width by
//! drawing the width first; for nu = 2 and a half-width of 0.05 that is the d = 0.025 of its
//! 9.5.2.8. The other shapes are drawn in the same way: every trial has limits of its own.

use super::shape::{Invalid, degrees_of_freedom};
use crate::number::elementary;

/// A factor of a width, uniformly distributed from 1 - e to 1 + e.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InexactWidth {
    dof: f64,
    share: f64,
}

impl InexactWidth {
    /// A width that is known exactly.
    pub(super) const EXACT: Self = Self { dof: f64::INFINITY, share: 0.0 };

    /// The width for a standard uncertainty with degrees of freedom, at least 0.5: with fewer the
    /// width could be negative.
    pub(super) fn of_dof(dof: f64) -> Result<Self, Invalid> {
        let dof = degrees_of_freedom(dof)?;
        if dof >= 0.5 {
            Ok(Self { dof, share: (1.0 / (2.0 * dof).sqrt()).min(1.0) })
        } else {
            let range = "at least 0.5, or the width would be uncertain by more than itself";
            Err(Invalid::OutOfRange { parameter: "dof", value: dof, range })
        }
    }

    pub(super) fn dof(self) -> f64 {
        self.dof
    }

    /// The largest distance of the factor from 1; 0 for an exact width.
    pub(super) fn share(self) -> f64 {
        self.share
    }

    pub(super) fn is_exact(self) -> bool {
        self.share == 0.0
    }

    /// The factor for a uniform number between 0 and 1.
    #[inline(always)]
    pub(super) fn factor(self, uniform: f64) -> f64 {
        1.0 + self.share * (1.0 - 2.0 * uniform)
    }

    /// The expectation of the factor's square.
    pub(super) fn mean_square(self) -> f64 {
        1.0 + self.share * self.share / 3.0
    }

    /// The probability that a symmetric trapezoid of half-width 1 about 0, whose top is `beta`
    /// times its base, lies above `x` >= 0 after its width has been multiplied by the factor.
    fn tail(self, beta: f64, x: f64) -> f64 {
        let (least, most) = (1.0 - self.share, 1.0 + self.share);
        // widths for which x lies on a flank: the tail there is (1 - x/s)^2 / (2 (1 - beta^2))
        let (from, kink) = (least.max(x), if beta > 0.0 { x / beta } else { f64::INFINITY });
        let to = most.min(kink);
        let mut integral = 0.0;
        if to > from {
            let turn = 2.0 * x * libm::log1p((to - from) / from);
            let flank = (to - from) * (1.0 + x * x / (from * to)) - turn;
            integral += flank / (2.0 * (1.0 - beta * beta));
        }
        // and on the top: 1/2 - x/((1 + beta) s)
        let from = least.max(kink);
        if most > from {
            let turn = if x > 0.0 { x * elementary::ln(most / from) } else { 0.0 };
            integral += 0.5 * (most - from) - turn / (1.0 + beta);
        }
        integral / (2.0 * self.share)
    }

    /// The distance above which such a trapezoid lies with probability `q`, 0 < q <= 1/2.
    pub(super) fn distance(self, beta: f64, q: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0 + self.share);
        // bisection down to the last bit: the tail is monotone apart from its rounding
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.tail(beta, middle) > q {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}
