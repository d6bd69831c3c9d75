//! Quantities from standard normal scores: the value at the score's probability. Two shapes with
//! the same scores share their random numbers, and those of a Gaussian copula keep their
//! dependence.

use std::sync::Arc;

use super::profile::{Profile, Table, at_normal};
use super::standard::{Standard, plain};
use crate::distribution::Distribution;
use crate::number::{CodePath, Column, Kernel};

/// How the values of a quantity follow from its scores.
#[derive(Clone, Debug)]
pub struct FromScore {
    location: f64,
    scale: f64,
    function: Function,
}

#[derive(Clone, Debug)]
enum Function {
    /// The score itself.
    Score,
    Tabulated(Arc<Table>),
    /// The quantile function of a quantity without a variance.
    Quantiles(Arc<Distribution>),
}

impl FromScore {
    /// Of a quantity with this distribution.
    pub fn of(distribution: &Arc<Distribution>) -> Self {
        let shape = Standard::of(distribution);
        let [location, scale] = shape.placed(distribution);
        match shape.distribution() {
            None => {
                let [location, scale] = plain(distribution);
                Self { location, scale, function: Function::Score }
            }
            Some(standard) if standard.standard_deviation().is_finite() => {
                let (_, table) = Profile::of(&standard);
                Self { location, scale, function: Function::Tabulated(Arc::new(table)) }
            }
            Some(standard) => Self { location, scale, function: Function::Quantiles(standard) },
        }
    }

    /// Whether both have the same shape, with another location or width.
    pub fn has_shape_of(&self, other: &Self) -> bool {
        match (&self.function, &other.function) {
            (Function::Score, Function::Score) => true,
            (Function::Tabulated(own), Function::Tabulated(other)) => own.is_of(other),
            _ => false,
        }
    }

    /// The values at some scores.
    pub fn values(&self, scores: &Column, out: &mut Column) {
        self.values_on(CodePath::BASELINE, scores, out);
    }

    /// The same on a path.
    pub fn values_on(&self, path: CodePath, scores: &Column, out: &mut Column) {
        self.standard_on(path, scores, out);
        for value in &mut out.0 {
            *value = self.at(*value);
        }
    }

    /// The values of the shape in its standard location and width; [`Self::placed`] converts them
    /// to the quantity's values. Compiled once for each code path.
    #[inline(never)]
    pub fn standard_on(&self, path: CodePath, scores: &Column, out: &mut Column) {
        match &self.function {
            Function::Score => out.0 = scores.0,
            Function::Tabulated(table) => path.run(Tabulated { table, scores, out }),
            Function::Quantiles(distribution) => quantiles(distribution, scores, out),
        }
    }

    /// The quantity's values from those of its standard shape.
    pub fn placed(&self, standard: &Column, out: &mut Column) {
        for (value, &standard) in out.0.iter_mut().zip(&standard.0) {
            *value = self.at(standard);
        }
    }

    fn at(&self, standard: f64) -> f64 {
        self.location + self.scale * standard
    }
}

struct Tabulated<'a> {
    table: &'a Table,
    scores: &'a Column,
    out: &'a mut Column,
}

impl Kernel for Tabulated<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.table.values(&self.scores.0, &mut self.out.0);
    }
}

#[inline(never)]
fn quantiles(distribution: &Distribution, scores: &Column, out: &mut Column) {
    for (z, out) in scores.0.iter().zip(&mut out.0) {
        *out = at_normal(distribution, *z);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Arcsine, Normal, StudentT, Triangular};
    use crate::special;

    /// Values are the quantiles at the scores' probabilities: the table's bound of 1e-9 of the
    /// standard deviation, and the quantile function itself for a t distribution without a
    /// variance.
    #[test]
    fn values_are_quantiles() {
        let shapes: [Distribution; 4] = [
            Normal::new(3.0, 2.0).unwrap().into(),
            Triangular::new(3.0, 2.0).unwrap().into(),
            Arcsine::new(3.0, 2.0).unwrap().into(),
            StudentT::new(3.0, 2.0, 1.5).unwrap().into(),
        ];
        let mut scores = Column::ZERO;
        for (i, z) in scores.0.iter_mut().enumerate() {
            *z = 6.0 * (i as f64 / 127.0 - 0.5);
        }
        for shape in shapes {
            let mut out = Column::ZERO;
            FromScore::of(&Arc::new(shape.clone())).values(&scores, &mut out);
            for (z, value) in scores.0.iter().zip(&out.0) {
                let expected = shape.quantile(special::normal::cdf(*z));
                assert!((value - expected).abs() < 1e-8 * expected.abs().max(1.0), "{z} {value}");
            }
        }
    }
}
