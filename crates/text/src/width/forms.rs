//! The forms of widths, and what they count in.

use gumption_engine::number::elementary;

/// A width that may depend on the estimate: `relative` times its modulus, plus `absolute`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearWidth {
    /// Fraction of the estimate's modulus.
    pub relative: f64,
    /// Constant part, in the input's unit.
    pub absolute: f64,
}

impl LinearWidth {
    /// The width at an estimate, both in the input's unit.
    pub fn at(self, estimate: f64) -> f64 {
        self.relative * estimate.abs() + self.absolute
    }
}

/// A width as it is specified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Width {
    /// Terms that add linearly.
    Sum(LinearWidth),
    /// The square root of the sum of two squares, Q\[a; bL\].
    RootOfSquares([LinearWidth; 2]),
    /// The greater of two.
    Greater([LinearWidth; 2]),
}

/// The instrument that a specification belongs to, by the keys beside it, in the quantity's unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Instrument {
    /// The value of one count of the display.
    pub resolution: Option<f64>,
    /// The range of `% of range`.
    pub range: Option<f64>,
    /// The full scale of `% FS`.
    pub full_scale: Option<f64>,
}

impl Width {
    /// The width at an estimate, both in the input's unit.
    pub fn at(self, estimate: f64) -> f64 {
        match self {
            Self::Sum(width) => width.at(estimate),
            Self::RootOfSquares(widths) => {
                let [first, second] = widths.map(|width| width.at(estimate));
                elementary::hypot(first, second)
            }
            Self::Greater(widths) => {
                let [first, second] = widths.map(|width| width.at(estimate));
                first.max(second)
            }
        }
    }

    /// Whether the width has only a relative part, so that it may become 0 with the estimate.
    pub fn is_relative_only(self) -> bool {
        self.at(0.0) == 0.0 && self.at(1.0) > 0.0
    }

    /// The width, if it is a sum.
    pub fn sum(self) -> Option<LinearWidth> {
        match self {
            Self::Sum(width) => Some(width),
            Self::RootOfSquares(_) | Self::Greater(_) => None,
        }
    }
}
