//! Numbers that are a coverage factor and a coverage probability mistaken for each other.

/// What a coverage factor is, where `found` is rather a probability: 0.95, or 95 for 95 %.
///
/// A factor below 1 belongs to less than 68 % of a normal distribution, and 0.6745 (one half of it) is
/// still in use; factors from 90 to 100 need one degree of freedom and more than 99.2 %.
pub(super) fn of_factor(found: f64) -> Option<&'static str> {
    let is_probability = (0.9..1.0).contains(&found) || (90.0..100.0).contains(&found);
    is_probability
        .then_some("a coverage factor, such as 2: a coverage probability is `p`, such as 0.95")
}

/// As [`of_factor`], of the factor for the results of a file.
pub(super) fn of_factor_of_results(found: f64) -> Option<&'static str> {
    of_factor(found).map(|_| {
        "a coverage factor, such as 2: a coverage probability is `coverage_probability`, such as 0.95"
    })
}

/// What a coverage probability is, where `found` is rather what lies outside: 0.05.
pub(super) fn of_probability(found: f64) -> Option<&'static str> {
    let lies_outside = found > 0.0 && found <= 0.1;
    lies_outside.then_some(
        "the probability that the value lies in the interval, such as 0.95, not that it lies outside",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips() {
        assert!([0.95, 0.9545, 95.0, 99.73].into_iter().all(|k| of_factor(k).is_some()));
        // 0.6745: probable error; 63.66: t of one degree of freedom, 99 %
        assert!(
            [0.6745, 1.0, 1.96, 13.97, 63.66, 127.3].into_iter().all(|k| of_factor(k).is_none())
        );
        assert!([0.05, 0.0455, 0.01].into_iter().all(|p| of_probability(p).is_some()));
        assert!([0.5, 0.6827, 0.95, 0.0, 1.0].into_iter().all(|p| of_probability(p).is_none()));
    }
}
