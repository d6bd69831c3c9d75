//! Two results for one quantity: normalized error and zeta score (ISO 13528:2022, 9.5 and 9.7;
//! ISO/IEC 17043), and the range of the normalized error that the printed digits allow.

use super::{FACTOR, agree, probability};

/// A result as it is stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedResult {
    /// The value x.
    pub value: f64,
    /// Its expanded uncertainty U, at least 0, in the same unit.
    pub expanded: f64,
    /// Its coverage factor k, above 0.
    pub factor: f64,
    /// x and U as printed: with all their digits, unless a workbook displays fewer.
    pub printed: [f64; 2],
    /// The largest rounding error of each: half a unit of the last printed digit, or 0.
    pub rounding: [f64; 2],
}

impl StatedResult {
    /// A result that is printed with all its digits and is not rounded.
    pub fn new(value: f64, expanded: f64, factor: f64) -> Self {
        Self { value, expanded, factor, printed: [value, expanded], rounding: [0.0; 2] }
    }

    /// Whether it is valid: finite numbers, U and rounding at least 0, k above 0.
    pub fn is_possible(&self) -> bool {
        let [of_value, of_expanded] = self.rounding;
        let [printed_value, printed_expanded] = self.printed;
        let numbers = [
            self.value,
            self.expanded,
            self.factor,
            printed_value,
            printed_expanded,
            of_value,
            of_expanded,
        ];
        numbers.iter().all(|number| number.is_finite())
            && [self.expanded, printed_expanded, of_value, of_expanded]
                .iter()
                .all(|number| *number >= 0.0)
            && self.factor > 0.0
    }

    /// Standard uncertainty U/k.
    pub fn standard_uncertainty(&self) -> f64 {
        self.expanded / self.factor
    }
}

/// Two results of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultPair {
    /// The compared results.
    pub label: String,
    /// The two results.
    pub results: [StatedResult; 2],
    /// Their correlation coefficient, from -1 to 1.
    pub correlation: f64,
}

/// Two results compared.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedPair {
    /// The compared results.
    pub label: String,
    /// x1 - x2.
    pub difference: f64,
    /// Its expanded uncertainty U with k = 2; results with other factors are converted to k = 2.
    pub expanded: f64,
    /// Normalized error |d|/U.
    pub normalized_error: f64,
    /// Zeta score |d|/u(d).
    pub zeta: f64,
    /// The smallest and the largest normalized error that the printed digits allow; infinite if U
    /// may be 0.
    pub range: [f64; 2],
    /// Probability that two results for one value differ by at least this much.
    pub probability: f64,
    compatible: bool,
}

impl ComparedPair {
    /// Whether the results are compatible: the normalized error is at most 1, apart from rounding.
    pub fn is_compatible(&self) -> bool {
        self.compatible
    }
}

impl ResultPair {
    /// The comparison; `None` if the difference has no uncertainty, a result is invalid
    /// ([`StatedResult::is_possible`]), or the coefficient is not from -1 to 1.
    pub fn compare(&self) -> Option<ComparedPair> {
        let results = self.results.iter().all(StatedResult::is_possible);
        if !results || !(-1.0..=1.0).contains(&self.correlation) {
            return None;
        }
        let [a, b] = self.results;
        let [u1, u2] = self.results.map(|result| result.standard_uncertainty());
        let difference = a.value - b.value;
        let u = squared([u1, u2], self.correlation).max(0.0).sqrt();
        // u of fully correlated results may be pure rounding
        (u > 1e-12 * (u1 + u2)).then(|| ComparedPair {
            label: self.label.clone(),
            difference,
            expanded: FACTOR * u,
            normalized_error: difference.abs() / (FACTOR * u),
            zeta: difference.abs() / u,
            range: self.range(),
            probability: probability(difference, u),
            compatible: agree([a.value, b.value], FACTOR * u),
        })
    }

    /// The smallest and the largest normalized error over all values and uncertainties that print
    /// as these do.
    fn range(&self) -> [f64; 2] {
        let [a, b] = self.results;
        let (d, slack) = ((a.printed[0] - b.printed[0]).abs(), a.rounding[0] + b.rounding[0]);
        let ends = self.results.map(|result| {
            let [_, expanded] = result.printed;
            let [low, high] = [expanded - result.rounding[1], expanded + result.rounding[1]];
            [low.max(0.0) / result.factor, high / result.factor]
        });
        let (least, greatest) = extremes(ends, self.correlation);
        let at = |d: f64, u: f64| if d == 0.0 { 0.0 } else { d / (FACTOR * u) };
        [at((d - slack).max(0.0), greatest), at(d + slack, least)]
    }
}

/// u1^2 + u2^2 - 2 r u1 u2.
fn squared([u1, u2]: [f64; 2], r: f64) -> f64 {
    u1 * u1 + u2 * u2 - 2.0 * r * u1 * u2
}

/// The smallest and the largest standard uncertainty of a difference over a rectangle of standard
/// uncertainties. Its square is convex: the largest is at a corner, the smallest at a corner or on
/// an edge at a point with zero slope.
fn extremes([a, b]: [[f64; 2]; 2], r: f64) -> (f64, f64) {
    let corners = a.iter().flat_map(|&u1| b.map(|u2| [u1, u2]));
    let flat_on_a = a.map(|u1| [u1, (r * u1).clamp(b[0], b[1])]);
    let flat_on_b = b.map(|u2| [(r * u2).clamp(a[0], a[1]), u2]);
    let all: Vec<f64> = corners
        .chain(flat_on_a)
        .chain(flat_on_b)
        .map(|at| squared(at, r).max(0.0).sqrt())
        .collect();
    (all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stated(value: f64, expanded: f64, factor: f64) -> StatedResult {
        StatedResult { rounding: [0.5, 0.5], ..StatedResult::new(value, expanded, factor) }
    }

    /// By hand: d = 3, u = sqrt(1.5^2 + 2^2) = 2.5, U = 5.
    #[test]
    fn a_pair_by_hand() {
        let pair = |r: f64| ResultPair {
            label: "a".into(),
            results: [stated(10.0, 3.0, 2.0), stated(13.0, 6.0, 3.0)],
            correlation: r,
        };
        let found = pair(0.0).compare().unwrap();
        assert_eq!((found.difference, found.expanded, found.zeta), (-3.0, 5.0, 1.2));
        assert!((found.normalized_error - 0.6).abs() < 1e-15 && found.is_compatible());
        // 2 (1 - Phi(1.2)), tables
        assert!((found.probability - 0.230_139).abs() < 1e-6);
        // r = 0.5: u^2 = 2.25 + 4 - 3 = 3.25
        let found = pair(0.5).compare().unwrap();
        assert!((found.expanded - 2.0 * 3.25f64.sqrt()).abs() < 1e-14);
    }

    /// The range equals that of a fine grid over everything that prints alike.
    #[test]
    fn the_range_of_printed_digits() {
        for r in [-1.0, -0.4, 0.0, 0.3, 0.9, 1.0] {
            let pair = ResultPair {
                label: "a".into(),
                results: [stated(10.0, 3.0, 2.0), stated(13.0, 4.0, 2.0)],
                correlation: r,
            };
            let steps = |i: i32| f64::from(i) / 20.0 - 0.5;
            let (mut least, mut greatest) = (f64::INFINITY, 0.0f64);
            for (i, j) in (0..=20).flat_map(|i| (0..=20).map(move |j| (i, j))) {
                let u =
                    squared([(3.0 + steps(i)) / 2.0, (4.0 + steps(j)) / 2.0], r).max(0.0).sqrt();
                least = least.min(2.0 / (2.0 * u));
                greatest = greatest.max(4.0 / (2.0 * u));
            }
            let [from, to] = pair.compare().unwrap().range;
            assert!(from <= least + 1e-12 && to >= greatest - 1e-12, "{r} {from} {to}");
            // a grid of step 0.05 misses the ends by little
            assert!(least - from < 0.01 && (greatest - to).abs() < 0.02 * to || to.is_infinite());
        }
    }

    /// By hand: 10.0167 and 0.0396 printed as 10.02 and 0.04, beside 10.06 and 0.04: |d| is from 0.03 to
    /// 0.05, U of each from 0.035 to 0.045.
    #[test]
    fn the_range_is_about_what_is_printed() {
        let of = |value, expanded, printed| StatedResult {
            printed,
            rounding: [0.005; 2],
            ..StatedResult::new(value, expanded, 2.0)
        };
        let results = [of(10.0167, 0.0396, [10.02, 0.04]), of(10.06, 0.0433, [10.06, 0.04])];
        let pair = ResultPair { label: "a".into(), results, correlation: 0.0 };
        let found = pair.compare().unwrap();
        let [from, to] = found.range;
        assert!((from - 0.03 / (0.045 * 2f64.sqrt())).abs() < 1e-12, "{from}");
        assert!((to - 0.05 / (0.035 * 2f64.sqrt())).abs() < 1e-12, "{to}");
        assert!((found.normalized_error - 0.0433 / 0.0396f64.hypot(0.0433)).abs() < 1e-12);
    }

    /// By hand: 0.03 and 0.04 give U = 0.05, and values that are 0.05 apart have En = 1 wherever
    /// they lie, even if the binary difference exceeds 0.05 or, for large values, deviates by more
    /// than 1e-12 of it; 0.0500001 is too much. A difference of five U between frequencies with
    /// fifteen digits stays incompatible.
    #[test]
    fn a_normalized_error_of_one_is_compatible() {
        let is = |x1: f64, x2: f64, [u1, u2]: [f64; 2]| {
            let results = [stated(x1, u1, 2.0), stated(x2, u2, 2.0)];
            let pair = ResultPair { label: "a".into(), results, correlation: 0.0 };
            pair.compare().unwrap().is_compatible()
        };
        for (x1, x2) in [(1.0, 1.05), (1.05, 1.0), (1.37, 1.42), (-1.0, -1.05), (1e4, 10000.05)] {
            assert!(is(x1, x2, [0.03, 0.04]), "{x1} {x2}");
        }
        assert!(!is(1.0, 1.050_000_1, [0.03, 0.04]));
        assert!(!is(5_000_000.0, 5_000_000.000_000_5, [6e-8, 8e-8]));
    }

    #[test]
    fn what_is_no_result_is_not_compared() {
        let good = StatedResult { rounding: [0.0; 2], ..stated(10.0, 3.0, 2.0) };
        let compare = |result: StatedResult, correlation: f64| {
            let results = [result, good];
            ResultPair { label: "a".into(), results, correlation }.compare()
        };
        assert!(compare(good, 0.0).is_some());
        for wrong in [
            StatedResult { value: f64::NAN, ..good },
            StatedResult { expanded: -3.0, ..good },
            StatedResult { expanded: f64::INFINITY, ..good },
            StatedResult { factor: -2.0, ..good },
            StatedResult { factor: 0.0, ..good },
            StatedResult { rounding: [0.0, -0.5], ..good },
        ] {
            assert!(compare(wrong, 0.9).is_none(), "{wrong:?}");
        }
        assert!(compare(good, 2.0).is_none() && compare(good, f64::NAN).is_none());
    }

    #[test]
    fn no_uncertainty_is_no_comparison() {
        let pair = ResultPair {
            label: "a".into(),
            results: [stated(1.0, 2.0, 2.0), stated(2.0, 2.0, 2.0)],
            correlation: 1.0,
        };
        assert!(pair.compare().is_none());
    }
}
