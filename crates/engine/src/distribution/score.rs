//! The position of a value in a distribution.

use super::Distribution;
use crate::special;

/// Larger scores leave less probability than the smallest doubles.
const FARTHEST: f64 = 37.0;

impl Distribution {
    /// The value at a standard normal score: the quantile at the score's probability, accurate deep
    /// in both tails.
    pub(crate) fn at_score(&self, score: f64) -> f64 {
        if score < 0.0 {
            self.quantile(special::normal::cdf(score))
        } else {
            self.quantile_upper(special::normal::sf(score))
        }
    }

    /// The standard normal score of a value: the probability below the value equals that below the
    /// score. By bisection, to 1e-13; from -37 to 37.
    pub fn score_of(&self, value: f64) -> f64 {
        let (mut low, mut high) = (-FARTHEST, FARTHEST);
        while high - low > 1e-13 {
            let middle = 0.5 * (low + high);
            if self.at_score(middle) < value {
                low = middle
            } else {
                high = middle
            }
            if middle == low && middle == high {
                break;
            }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Gamma, Rectangular};
    use super::*;

    #[test]
    fn scores_and_values_belong_together() {
        let gamma: Distribution = Gamma::new(4.0, 4.0).unwrap().into();
        for score in [-6.0, -1.5, 0.0, 0.3, 5.0] {
            assert!((gamma.score_of(gamma.at_score(score)) - score).abs() < 1e-9, "{score}");
        }
        let rectangle: Distribution = Rectangular::new(0.0, 1.0).unwrap().into();
        assert!((special::normal::cdf(rectangle.score_of(0.5)) - 0.75).abs() < 1e-12);
        assert!(rectangle.score_of(2.0) > 36.0 && rectangle.score_of(-2.0) < -36.0);
    }
}
