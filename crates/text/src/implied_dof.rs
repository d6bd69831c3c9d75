//! The degrees of freedom of a t distribution that follow from a coverage factor and a coverage
//! probability on a certificate: `k = 3.31, p = 95.45 %` gives 3.

use super::value_text::power_of_last_digit;
use gumption_engine::decimal::Decimal;
use gumption_engine::special::student::two_sided_factor;

/// "Approximately 95 %" in accreditation practice, and the probability for which its factors are
/// computed (EA-4/02 M:2022, annex E).
const APPROXIMATELY: (f64, f64) = (0.95, 0.9545);

/// The largest number of degrees of freedom in the search for an integer, and the smallest number
/// that is accepted.
const MOST: f64 = 10_000.0;
const FEWEST: f64 = 0.5;

/// A coverage factor, known to half a unit of its last written digit.
#[derive(Clone, Copy, Debug)]
pub struct Factor {
    pub(crate) value: f64,
    pub(crate) half_digit: f64,
}

impl Factor {
    /// A factor as written; `last_digit` is one unit of its last digit.
    pub fn new(value: f64, last_digit: f64) -> Self {
        Self { value, half_digit: 0.5 * last_digit }
    }

    /// Whether a computed factor rounds to this one, apart from the last bits.
    fn is(self, computed: f64) -> bool {
        (computed - self.value).abs() <= self.half_digit + 1e-9 * self.value
    }

    /// Degrees of freedom of the t distribution that has this factor at a coverage probability. The
    /// result is the integer whose factor rounds to this one, and the nearest if there are several;
    /// otherwise the number that gives exactly this factor. It is infinite if the factor of a normal
    /// distribution is not smaller than this one.
    pub fn dof(self, probability: f64) -> f64 {
        let normal = two_sided_factor(probability, f64::INFINITY);
        if self.value <= normal || self.is(normal) {
            return f64::INFINITY;
        }
        let (said, meant) = APPROXIMATELY;
        let meant = || self.integer(meant).filter(|_| probability == said);
        self.integer(probability).or_else(meant).unwrap_or_else(|| self.between(probability))
    }

    /// As [`Self::dof`] if no distribution is named. The whole factors 2 and 3 are then
    /// conventional and belong to a normal distribution, whose probability is stated approximately,
    /// as 95 % or 99.7 %.
    pub fn dof_of_nothing_named(self, probability: f64, last_digit: f64) -> f64 {
        let is_whole = self.value.fract() == 0.0;
        let half = 0.5 * last_digit;
        let ends = [probability - half, probability + half].map(|p| p.clamp(1e-6, 1.0 - 1e-12));
        let [low, high] = ends.map(|p| two_sided_factor(p, f64::INFINITY));
        let near = self.value + self.half_digit >= low && self.value - self.half_digit <= high;
        if is_whole && near { f64::INFINITY } else { self.dof(probability) }
    }

    fn integer(self, probability: f64) -> Option<f64> {
        let of = |dof: f64| two_sided_factor(probability, dof);
        let real = self.between(probability);
        let near = [real.floor(), real.ceil()];
        let distance = |dof: f64| (of(dof) - self.value).abs();
        let candidates = near.into_iter().filter(|dof| (1.0..=MOST).contains(dof));
        let fits = candidates.filter(|dof| self.is(of(*dof)));
        fits.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
    }

    /// The degrees of freedom, not necessarily an integer, that give exactly this factor.
    fn between(self, probability: f64) -> f64 {
        let (mut low, mut high) = (FEWEST, 1e6_f64);
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            if two_sided_factor(probability, middle) > self.value {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low * high).sqrt()
    }
}

/// One unit in the last digit of a number, counting trailing zeros: 0.001 for `0.100`.
pub fn last_digit(number: &str) -> f64 {
    Decimal::new(1, power_of_last_digit(number)).value()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dof(k: &str, p: f64) -> f64 {
        Factor::new(k.parse().unwrap(), last_digit(k)).dof(p)
    }

    /// EA-4/02 M:2022, table E.1 (95.45 %), and JCGM 100, table G.2 (95 % and 99 %).
    #[test]
    fn factors_of_tables() {
        let of_ea = [
            ("13.97", 1.0),
            ("4.53", 2.0),
            ("3.31", 3.0),
            ("2.87", 4.0),
            ("2.65", 5.0),
            ("2.52", 6.0),
            ("2.43", 7.0),
            ("2.37", 8.0),
            ("2.28", 10.0),
            ("2.13", 20.0),
            ("2.00", f64::INFINITY),
            ("2", f64::INFINITY),
        ];
        for (k, expected) in of_ea {
            assert_eq!(dof(k, 0.9545), expected, "{k}");
            // "approximately 95 %"; if the table for 95 % contains the factor too, that one is
            // meant
            let of_95 = match k {
                "2.13" => 15.0,
                "2.00" => 60.0,
                _ => expected,
            };
            assert_eq!(dof(k, 0.95), of_95, "{k}");
        }
        for (k, p, expected) in [
            ("12.71", 0.95, 1.0),
            ("3.18", 0.95, 3.0),
            ("2.78", 0.95, 4.0),
            ("2.23", 0.95, 10.0),
            ("5.84", 0.99, 3.0),
            ("3.17", 0.99, 10.0),
            ("1.96", 0.95, f64::INFINITY),
            ("2.58", 0.99, f64::INFINITY),
        ] {
            assert_eq!(dof(k, p), expected, "{k} {p}");
        }
        // no integer gives this factor
        let between = dof("3.90", 0.9545);
        assert!((2.0..3.0).contains(&between) && between.fract() != 0.0, "{between}");
    }

    #[test]
    fn what_is_printed_is_read_back() {
        for p in [0.9, 0.95, 0.9545, 0.99, 0.9973] {
            for n in 1..40 {
                let n = f64::from(n);
                let k = gumption_engine::decimal::rounded(two_sided_factor(p, n), -2);
                let back = dof(&k, p);
                let again = gumption_engine::decimal::rounded(two_sided_factor(p, back), -2);
                assert_eq!(k, again, "{p} {n} {back}");
                // neighbouring factors differ by more than their last digit
                assert!(n > 12.0 || back == n, "{p} {n} {back}");
            }
        }
    }

    #[test]
    fn chosen_factors() {
        let of = |k: &str, p: &str| {
            let factor = Factor::new(k.parse().unwrap(), last_digit(k));
            factor.dof_of_nothing_named(p.parse().unwrap(), last_digit(p))
        };
        for (k, p) in [("2", "0.95"), ("2.00", "0.95"), ("2.0", "0.9545"), ("3.00", "0.997")] {
            assert_eq!(of(k, p), f64::INFINITY, "{k} {p}");
        }
        assert_eq!(of("3.31", "0.9545"), 3.0);
        assert_eq!(of("2.65", "0.95"), 5.0);
    }
}
