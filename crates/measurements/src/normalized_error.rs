//! The comparison of two results of one quantity.

// The customary symbols: U is an expanded uncertainty, u a standard one.
#![allow(non_snake_case)]

use gumption_engine::measurement;
use gumption_engine::model::typed::Equations;
use gumption_engine::number::Number;

measurement! {
    /// Normalized error of two results with expanded uncertainties.
    ///
    /// The source's equation supposes the same coverage factor on both sides. Expanded
    /// uncertainties stated with other factors are brought to k = 2 first: U_i 2 / k_i. Where the
    /// two results share an influence (a common reference), its correlation coefficient r enters as
    /// -2 r U1 U2 under the root. Results are compatible where e_n <= 1.
    ///
    /// x1, U1, x2, U2, difference and U_difference have one unit, which may be any; k1, k2, r and
    /// e_n are numbers.
    pub NormalizedError as "normalized-error"
        from "Chiominto et al. (2024), equation (4); ISO/IEC 17043";
    inputs {
        /// First result.
        x1: "1",
        /// Expanded uncertainty of the first result.
        U1: "1",
        /// Coverage factor of the first result.
        k1: "1" or 2.0,
        /// Second result.
        x2: "1",
        /// Expanded uncertainty of the second result.
        U2: "1",
        /// Coverage factor of the second result.
        k2: "1" or 2.0,
        /// Correlation coefficient of the two results.
        r: "1" or 0.0,
    }
    outputs NormalizedErrorResult {
        /// Normalized error.
        e_n: "1" = "abs(x1 - x2)/U_difference",
        /// Difference of the results, signed.
        difference: "1" = "x1 - x2",
        /// Expanded uncertainty of the difference, k = 2.
        U_difference: "1" = "sqrt((2*U1/k1)^2 + (2*U2/k2)^2 - 2*r*(2*U1/k1)*(2*U2/k2))",
    }
}

impl<T: Number> Equations<T> for NormalizedError<T> {
    type Outputs = NormalizedErrorResult<T>;

    fn equations(self) -> Self::Outputs {
        let (U1, U2) = (self.U1 * 2.0 / self.k1, self.U2 * 2.0 / self.k2);
        let shared = self.r * U1 * U2 * 2.0;
        let U_difference = (U1.square() + U2.square() - shared).sqrt();
        let difference = self.x1 - self.x2;
        NormalizedErrorResult { e_n: difference.abs() / U_difference, difference, U_difference }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compare(x1: f64, U1: f64, x2: f64, U2: f64) -> NormalizedErrorResult<f64> {
        NormalizedError { x1, U1, k1: 2.0, x2, U2, k2: 2.0, r: 0.0 }.equations()
    }

    /// Table 1 of the source gives whole digits. Each normalized error of its Table 2 lies within
    /// what values and uncertainties that round to those digits allow (half of 0.01 of its own
    /// rounding added); the printed digits themselves give 0.00 to 0.11 off.
    #[test]
    fn table_2_of_the_source_is_within_the_rounding_of_table_1() {
        let table = [
            ([423.0, 13.0, 422.0, 13.0], 0.04),
            ([422.0, 11.0, 419.0, 12.0], 0.18),
            ([425.0, 11.0, 421.0, 11.0], 0.26),
            ([422.0, 9.0, 422.0, 13.0], 0.05),
            ([423.0, 12.0, 419.0, 11.0], 0.25),
            ([423.0, 9.0, 419.0, 10.0], 0.31),
            ([423.0, 10.0, 425.0, 22.0], 0.09),
            ([430.0, 11.0, 429.0, 23.0], 0.05),
            ([426.0, 7.0, 424.0, 17.0], 0.07),
        ];
        for ([x1, U1, x2, U2], printed) in table {
            let distance: f64 = x1 - x2;
            let least = compare((distance.abs() - 1.0).max(0.0), U1 + 0.5, 0.0, U2 + 0.5).e_n;
            let most = compare(distance.abs() + 1.0, U1 - 0.5, 0.0, U2 - 0.5).e_n;
            assert!((least - 0.005..=most + 0.005).contains(&printed), "{least} {printed} {most}");
            let e_n = compare(x1, U1, x2, U2).e_n;
            assert!((e_n - printed).abs() < 0.06, "{e_n} {printed}");
        }
    }

    #[test]
    fn other_coverage_factors_are_brought_to_two() {
        let stated =
            NormalizedError { x1: 7.0, U1: 3.0, k1: 3.0, x2: 5.0, U2: 1.5, k2: 1.0, r: 0.0 };
        let result = stated.equations();
        let same = compare(7.0, 2.0, 5.0, 3.0);
        assert_eq!([result.e_n, result.U_difference], [same.e_n, same.U_difference]);
        assert_eq!(result.difference, 2.0);
    }

    #[test]
    fn a_shared_reference_lessens_the_uncertainty_of_the_difference() {
        let apart = NormalizedError {
            r: 0.5,
            ..NormalizedError { x1: 7.0, U1: 3.0, k1: 2.0, x2: 5.0, U2: 4.0, k2: 2.0, r: 0.0 }
        };
        // 9 + 16 - 12
        assert!((apart.equations().U_difference - 13f64.sqrt()).abs() < 1e-15);
        assert_eq!(compare(7.0, 3.0, 5.0, 4.0).U_difference, 5.0);
    }
}
