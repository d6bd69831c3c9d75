//! A quantity that is taken as known exactly.

use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use crate::number::Column;

/// An exactly known value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    value: f64,
}

impl Constant {
    /// A constant of the given finite value.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn new(value: f64) -> Result<Self, Invalid> {
        Ok(Self { value: finite("value", value)? })
    }
}

impl Shape for Constant {
    const NAME: &'static str = "constant";

    fn mean(&self) -> f64 {
        self.value
    }

    fn standard_uncertainty(&self) -> f64 {
        0.0
    }

    fn quantile(&self, _p: f64) -> f64 {
        self.value
    }

    #[inline(always)]
    fn draw(&self, _stream: &mut Stream, out: &mut Column) {
        out.0.fill(self.value);
    }

    fn times(&self, factor: f64) -> Option<Self> {
        Self::new(self.value * factor).ok()
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        Ok(Self { value: finite("estimate", estimate)? })
    }
}
