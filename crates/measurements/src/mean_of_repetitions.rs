//! The mean of repeated results that share an uncertainty.

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::{Binary, Number};

measurement! {
    /// Mean of two to eight results of one quantity, with an uncertainty composed of the mean
    /// uncertainty of the single results and the standard deviation between them.
    ///
    /// mean = (sum of the x_k) / n + common u_mean + between s, where u_mean is the average of the
    /// standard uncertainties u_k and s the experimental standard deviation of the x_k (divisor
    /// n - 1). `common` and `between` are deviations without a unit, of expectation 0 and standard
    /// deviation 1, so that the budget shows u_mean and s as two contributions and the combined
    /// standard uncertainty is sqrt(u_mean^2 + s^2). That states two choices:
    ///
    /// - what the u_k stand for (bench, reference) is common to all results, so it does not average
    ///   out; results with independent errors are given with their own distributions instead, and
    ///   `common` is left out;
    /// - s is not divided by sqrt(n): the uncertainty is that of a result under conditions that
    ///   vary as they did between the x_k, as in the source, and not that of the average of n
    ///   random deviations. Give `between` a standard deviation of 1/sqrt(n) for the latter.
    ///
    /// In a file `between` is normal with std 1 and dof n - 1, because s comes from n results.
    /// A result that is left out is infinite and not counted. The x_k, the u_k and the outputs have
    /// one unit, which may be any.
    pub MeanOfRepetitions as "mean-of-repetitions"
        from "Chiominto et al. (2024), section 4.3: composition of the overall uncertainty of a \
            mean";
    inputs {
        /// Result 1.
        x_1: "1",
        /// Result 2.
        x_2: "1",
        /// Result 3.
        x_3: "1" or f64::INFINITY,
        /// Result 4.
        x_4: "1" or f64::INFINITY,
        /// Result 5.
        x_5: "1" or f64::INFINITY,
        /// Result 6.
        x_6: "1" or f64::INFINITY,
        /// Result 7.
        x_7: "1" or f64::INFINITY,
        /// Result 8.
        x_8: "1" or f64::INFINITY,
        /// Standard uncertainty of result 1.
        u_1: "1" or 0.0,
        /// Standard uncertainty of result 2.
        u_2: "1" or 0.0,
        /// Standard uncertainty of result 3.
        u_3: "1" or 0.0,
        /// Standard uncertainty of result 4.
        u_4: "1" or 0.0,
        /// Standard uncertainty of result 5.
        u_5: "1" or 0.0,
        /// Standard uncertainty of result 6.
        u_6: "1" or 0.0,
        /// Standard uncertainty of result 7.
        u_7: "1" or 0.0,
        /// Standard uncertainty of result 8.
        u_8: "1" or 0.0,
        /// Deviation common to all results, in units of their mean uncertainty: 0, std 1.
        common: "1" or 0.0,
        /// Deviation between the results, in units of their standard deviation: 0, std 1.
        between: "1",
    }
    outputs MeanOfRepetitionsResult {
        /// Mean of the results.
        mean: "1" = "(sum of x_k) / n + common u_mean + between s",
        /// Mean of the standard uncertainties of the single results.
        u_mean: "1" = "(sum of u_k) / n",
        /// Experimental standard deviation of the results.
        s: "1" = "sqrt((sum of (x_k - average)^2) / (n - 1))",
        /// Composition of both.
        u: "1" = "sqrt(u_mean^2 + s^2)",
    }
}

/// A finite number beyond any result, in the place of an infinite one, which times 0 is none.
const BEYOND: f64 = 1e300;

fn sum<T: Number>(terms: [T; 8]) -> T {
    terms.into_iter().fold(T::constant(0.0), |sum, term| sum + term)
}

impl<T: Number> Equations<T> for MeanOfRepetitions<T> {
    type Outputs = MeanOfRepetitionsResult<T>;

    fn equations(self) -> Self::Outputs {
        let results = [
            (self.x_1, self.u_1),
            (self.x_2, self.u_2),
            (self.x_3, self.u_3),
            (self.x_4, self.u_4),
            (self.x_5, self.u_5),
            (self.x_6, self.u_6),
            (self.x_7, self.u_7),
            (self.x_8, self.u_8),
        ]
        .map(|(x, u)| {
            let counted = x.binary(Binary::Less, T::constant(f64::INFINITY));
            (counted, x.min(T::constant(BEYOND)) * counted, u * counted)
        });
        let n = sum(results.map(|(counted, ..)| counted));
        let average = sum(results.map(|(_, x, _)| x)) / n;
        let u_mean = sum(results.map(|(.., u)| u)) / n;
        let squares = sum(results.map(|(counted, x, _)| (x - average).square() * counted));
        let s = (squares / (n - 1.0)).sqrt();
        MeanOfRepetitionsResult {
            mean: average + self.common * u_mean + self.between * s,
            u_mean,
            s,
            u: (u_mean.square() + s.square()).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::model::typed::{Measurement, Typed};

    fn inputs(x: &[f64], u: &[f64]) -> Vec<f64> {
        let mut inputs = vec![f64::INFINITY; 8];
        inputs.extend([0.0; 10]);
        inputs[..x.len()].copy_from_slice(x);
        inputs[8..8 + u.len()].copy_from_slice(u);
        inputs
    }

    #[test]
    fn any_number_of_results_from_two_to_eight() {
        let x = [421.0, 424.0, 419.0, 423.5, 420.5, 422.0, 425.0, 418.0];
        let u = [2.0, 2.2, 1.8, 2.4, 2.0, 2.1, 1.9, 2.3];
        for n in 2..=8 {
            let result = MeanOfRepetitions::<()>::compute(&inputs(&x[..n], &u[..n]));
            let mean = x[..n].iter().sum::<f64>() / n as f64;
            let u_mean = u[..n].iter().sum::<f64>() / n as f64;
            let squares: f64 = x[..n].iter().map(|x| (x - mean).powi(2)).sum();
            let s = (squares / (n as f64 - 1.0)).sqrt();
            for (found, expected) in result.into_iter().zip([mean, u_mean, s, u_mean.hypot(s)]) {
                assert!((found - expected).abs() < 1e-13, "{n}: {found} {expected}");
            }
        }
    }

    /// The sensitivities to `common` and `between` are the two contributions, so that the law of
    /// propagation gives the composition.
    #[test]
    fn the_two_contributions_compose() {
        let model = Typed::of::<MeanOfRepetitions<()>>().model().unwrap();
        let at = inputs(&[421.0, 424.0, 419.0], &[2.0, 2.5, 1.5]);
        let (values, gradients) = model.program.gradients(&at);
        let [_, u_mean, s, u] = values[..] else { panic!("four outputs") };
        assert_eq!(gradients[0][16], u_mean);
        assert_eq!(gradients[0][17], s);
        assert!((gradients[0][16].hypot(gradients[0][17]) - u).abs() < 1e-15);
        // results that are left out have no influence, and the rest is finite
        assert!(gradients.iter().flatten().all(|c| c.is_finite()));
        assert_eq!(gradients[0][5], 0.0);
    }

    #[test]
    fn equal_results_have_no_standard_deviation() {
        let model = Typed::of::<MeanOfRepetitions<()>>().model().unwrap();
        let (values, gradients) = model.program.gradients(&inputs(&[420.0; 4], &[2.0; 4]));
        assert_eq!(values[2], 0.0);
        assert!(gradients[0].iter().all(|c| c.is_finite()));
    }
}
