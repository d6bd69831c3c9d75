//! One part of a filter, of first or second order, in the plane of the bilinear transform's
//! variable s = (z - 1) / (z + 1), which is i tan(pi f / rate) at a frequency.
//!
//! Source of the integrators' equations: V. Zavalishin, The Art of VA Filter Design (2012),
//! chapters 3 and 4 (trapezoidal integration without delay).

use super::Phasor;
use gumption_engine::number::elementary;

/// Which output of the part is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tap {
    Low,
    Band,
    High,
}

/// A part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FilterSection {
    /// w / (s + w) or s / (s + w).
    First { w: f64, tap: Tap },
    /// w^2, k w s or s^2 over s^2 + k w s + w^2.
    Second { w: f64, k: f64, tap: Tap },
}

impl FilterSection {
    /// The complex gain at s.
    pub(super) fn response(&self, s: Phasor) -> Phasor {
        match *self {
            Self::First { w, tap } => match tap {
                Tap::High => s / (s + w),
                _ => Phasor::new(w, 0.0) / (s + w),
            },
            Self::Second { w, k, tap } => {
                let below = s * s + s * (k * w) + w * w;
                match tap {
                    Tap::Low => Phasor::new(w * w, 0.0) / below,
                    Tap::Band => s * (k * w) / below,
                    Tap::High => s * s / below,
                }
            }
        }
    }

    /// The derivative of the gain's logarithm by s, which is not zero.
    pub(super) fn logarithmic_slope(&self, s: Phasor) -> Phasor {
        let (above, below) = match *self {
            Self::First { w, tap } => (f64::from(tap == Tap::High), (s + w).inv()),
            Self::Second { w, k, tap } => (
                match tap {
                    Tap::Low => 0.0,
                    Tap::Band => 1.0,
                    Tap::High => 2.0,
                },
                (s * 2.0 + k * w) / (s * s + s * (k * w) + w * w),
            ),
        };
        s.inv() * above - below
    }

    /// The greatest modulus of its poles in z: what a value later is left of its transient.
    pub(super) fn decay(&self) -> f64 {
        match *self {
            Self::First { w, .. } => ((1.0 - w) / (1.0 + w)).abs(),
            Self::Second { w, k, .. } => {
                let (damping, rest) = (k * w / 2.0, w * w * (1.0 - k * k / 4.0));
                if rest >= 0.0 {
                    // |1 + s|^2 / |1 - s|^2 of s = -damping +- i sqrt(rest)
                    let (plus, minus) = (1.0 - damping, 1.0 + damping);
                    ((plus * plus + rest) / (minus * minus + rest)).sqrt()
                } else {
                    let root = (-rest).sqrt();
                    let modulus = |s: f64| ((1.0 + s) / (1.0 - s)).abs();
                    modulus(root - damping).max(modulus(-root - damping))
                }
            }
        }
    }

    /// Runs over values that were `level` for ever before the first, and multiplies them by
    /// `scale`; gives the level of what comes out.
    pub(super) fn run(&self, values: &mut [f64], level: f64, scale: f64) -> f64 {
        let level = level * scale;
        match *self {
            Self::First { w, tap } => {
                let share = w / (1.0 + w);
                let mut state = level;
                for value in values {
                    let x = *value * scale;
                    let step = (x - state) * share;
                    let low = state + step;
                    state = low + step;
                    *value = if tap == Tap::High { x - low } else { low };
                }
                if tap == Tap::High { 0.0 } else { level }
            }
            Self::Second { w, k, tap } => {
                let a = 1.0 / (1.0 + w * (w + k));
                let (mut first, mut second) = (0.0, level);
                for value in values {
                    let x = *value * scale;
                    let band = a * (first + w * (x - second));
                    let low = second + w * band;
                    first = 2.0 * band - first;
                    second = 2.0 * low - second;
                    *value = match tap {
                        Tap::Low => low,
                        Tap::Band => k * band,
                        Tap::High => x - k * band - low,
                    };
                }
                if tap == Tap::Low { level } else { 0.0 }
            }
        }
    }

    /// The part with a pair of conjugate poles, or two real ones, whose sum is -`k_w` and whose
    /// product is `w_squared`.
    pub(super) fn of_poles(k_w: f64, w_squared: f64, tap: Tap) -> Self {
        let w = w_squared.sqrt();
        Self::Second { w, k: k_w / w, tap }
    }
}

/// cos(pi j / (2 n)) for the damping of the prototype's poles.
pub(super) fn cos_of(j: usize, n: usize) -> f64 {
    elementary::cos(std::f64::consts::FRAC_PI_2 * j as f64 / n as f64)
}
