//! How a value is distributed about its estimate, whatever the estimate: what guard bands for a specific
//! risk are made of (JCGM 106, 8.3.2).

use super::smallest_band;
use crate::number::ascending;
use crate::propagate::gum::{Dof, Gum};
use crate::special::student;

/// A t distribution about an estimate, scaled: with infinitely many degrees of freedom a normal one.
#[derive(Clone, Copy, Debug)]
pub(in crate::propagate) struct StudentLaw {
    pub(super) scale: f64,
    pub(super) dof: f64,
}

impl StudentLaw {
    pub(super) fn normal(u: f64) -> Self {
        Self { scale: u, dof: f64::INFINITY }
    }

    /// That of the law of propagation: normal, or t with the effective degrees of freedom (JCGM 100,
    /// G.3).
    pub(super) fn of(gum: &Gum) -> Self {
        let dof = match gum.dof {
            Dof::Finite(dof) => dof,
            Dof::Infinite | Dof::Undefined => f64::INFINITY,
        };
        Self { scale: gum.standard_uncertainty, dof }
    }

    /// The probability of a distance below this one.
    pub(super) fn below(self, distance: f64) -> f64 {
        student::cdf(distance / self.scale, self.dof)
    }

    /// The probability of a distance above this one, from the near tail, so that small probabilities
    /// keep their digits.
    pub(super) fn above(self, distance: f64) -> f64 {
        self.below(-distance)
    }

    /// -2 times the logarithm of the density over the greatest one, at so many scales.
    pub(super) fn form(self, distance: f64) -> f64 {
        let square = distance * distance;
        match self.dof.is_finite() {
            true => (self.dof + 1.0) * libm::log1p(square / self.dof),
            false => square,
        }
    }
}

/// The distribution of a value's distance from its estimate.
#[derive(Debug)]
pub(in crate::propagate) enum ErrorLaw {
    Student(StudentLaw),
    /// That of trials: their distances from the estimate, in order.
    Trials(Vec<f64>),
}

impl ErrorLaw {
    pub(super) fn normal(u: f64) -> Self {
        Self::Student(StudentLaw::normal(u))
    }

    pub(super) fn of(gum: &Gum) -> Self {
        Self::Student(StudentLaw::of(gum))
    }

    pub(in crate::propagate) fn of_trials(mut values: Vec<f64>, estimate: f64) -> Self {
        values.iter_mut().for_each(|value| *value -= estimate);
        ascending(&mut values);
        Self::Trials(values)
    }

    /// The scale of a t distribution; of trials the largest distance.
    pub(super) fn scale(&self) -> f64 {
        match self {
            Self::Student(law) => law.scale,
            Self::Trials(distances) => {
                let ends = [distances.first(), distances.last()];
                ends.into_iter().flatten().fold(0.0, |most: f64, end| most.max(end.abs()))
            }
        }
    }

    /// The probability of a distance below this one.
    fn below(&self, distance: f64) -> f64 {
        match self {
            Self::Student(law) => law.below(distance),
            Self::Trials(distances) => {
                let count = distances.partition_point(|known| *known < distance);
                count as f64 / distances.len().max(1) as f64
            }
        }
    }

    /// The probability of a distance above this one.
    fn above(&self, distance: f64) -> f64 {
        match self {
            Self::Student(law) => law.above(distance),
            Self::Trials(distances) => {
                let count = distances.partition_point(|known| *known <= distance);
                (distances.len() - count) as f64 / distances.len().max(1) as f64
            }
        }
    }

    /// The probability of a distance within limits.
    pub(super) fn share(&self, [lower, upper]: [f64; 2]) -> f64 {
        1.0 - self.below(lower) - self.above(upper)
    }

    /// The guard band with which a value measured at either acceptance limit does not conform with at
    /// most this probability (JCGM 106, 8.3.2); `None` if the middle of the tolerance has a larger one.
    pub(in crate::propagate) fn guard_band(
        &self,
        risk: f64,
        [lower, upper]: [f64; 2],
    ) -> Option<f64> {
        // what lies beyond the near limit and, where there is one, beyond the far one
        let at_lower = |width: f64| self.below(-width) + self.above(upper - lower - width);
        let at_upper = |width: f64| self.above(width) + self.below(width - (upper - lower));
        let holds = |width: f64| {
            (lower.is_infinite() || at_lower(width) <= risk)
                && (upper.is_infinite() || at_upper(width) <= risk)
        };
        smallest_band(upper - lower, self.scale(), holds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against tables of t: 7.173 for 4 degrees of freedom and 0.999, 2.920 for 2 and 0.95, and the
    /// normal 1.645 and 2.326; to their last digit.
    #[test]
    fn guard_bands_of_t() {
        let cases = [(4.0, 0.001, 7.173), (2.0, 0.05, 2.920), (f64::INFINITY, 0.05, 1.645)];
        for (dof, risk, expected) in cases.into_iter().chain([(f64::INFINITY, 0.01, 2.326)]) {
            let law = ErrorLaw::Student(StudentLaw { scale: 0.002, dof });
            for limits in [[f64::NEG_INFINITY, 10.0], [10.0, f64::INFINITY], [0.0, 1e9]] {
                let width = law.guard_band(risk, limits).unwrap();
                assert!(
                    (width / 0.002 - expected).abs() < 6e-4,
                    "{dof} {risk} {limits:?}: {width}"
                );
            }
            assert_eq!(law.guard_band(risk, [0.0, 0.002]), None);
        }
    }

    /// Of a rectangular law of half-width a the guard band for one limit is (1 - 2 risk) a, and that of
    /// 1 - x^2 on (0, 1), exponential-like to one side, is another at either limit: the larger one counts.
    #[test]
    fn guard_bands_of_trials() {
        let even = |i: u32| (f64::from(i) + 0.5) / 1e4;
        let rectangular = (0..10_000).map(|i| 3.0 + 2.0 * even(i)).collect();
        let law = ErrorLaw::of_trials(rectangular, 4.0);
        for (risk, limits) in [(0.01, [f64::NEG_INFINITY, 9.0]), (0.2, [-9.0, f64::INFINITY])] {
            let width = law.guard_band(risk, limits).unwrap();
            // between two of the 10 000 values
            assert!((width - (1.0 - 2.0 * risk)).abs() < 2.1e-4, "{width}");
        }
        // P(D > w) = 1 - sqrt(w) up to 1, nothing below 0
        let law = ErrorLaw::of_trials((0..10_000).map(|i| even(i) * even(i)).collect(), 0.0);
        let width = law.guard_band(0.1, [f64::NEG_INFINITY, 0.0]).unwrap();
        assert!((width - 0.81).abs() < 4e-4, "{width}");
        assert_eq!(law.guard_band(0.1, [0.0, f64::INFINITY]), Some(0.0));
    }
}
