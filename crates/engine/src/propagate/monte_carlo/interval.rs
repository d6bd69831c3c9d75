//! Coverage intervals as order statistics of the trials (JCGM 101, 7.7).

use super::order::Order;

/// The ranks of JCGM 101, 7.7.2, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ranks {
    /// How many ranks the upper end lies above the lower end.
    pub q: u64,
    /// The rank of the symmetric interval's lower end.
    pub r: u64,
}

impl Ranks {
    /// For `trials` many trials and coverage probability `p`: q = pM if that is an integer, else
    /// the integer part of pM + 1/2; r = (M - q)/2 if that is an integer, else the integer part of
    /// (M - q + 1)/2. With so few trials that q reaches M, the ends are the extreme trials.
    pub fn new(trials: u64, p: f64) -> Self {
        let q =
            ((p * trials as f64 + 0.5).floor() as u64).clamp(1, trials.saturating_sub(1).max(1));
        let left = trials.saturating_sub(q);
        Self { q, r: left.div_ceil(2).max(1) }
    }
}

/// The probabilistically symmetric interval.
pub(crate) fn symmetric(order: &mut Order, p: f64) -> Option<[f64; 2]> {
    let Ranks { q, r } = Ranks::new(order.trials, p);
    Some([order.get(r)?, order.get((r + q).min(order.trials))?])
}

/// The shortest interval that holds as many trials: the least y(r + q) - y(r) over all r (7.7.4).
/// Of equally short ones that nearest to the symmetric one. With it comes the rank of its lower end.
pub(crate) fn shortest(order: &mut Order, p: f64) -> Option<([f64; 2], u64)> {
    let Ranks { q, r: symmetric } = Ranks::new(order.trials, p);
    if order.trials <= q {
        return Some(([order.get(1)?, order.get(order.trials)?], 1));
    }
    order.closest(q, order.trials - q, symmetric)
}

/// One standard deviation of the rank of a fixed value near the order statistic of rank `rank`:
/// sqrt(M p (1 - p)) with p = rank/M.
pub(crate) fn rank_spread(trials: u64, rank: u64) -> u64 {
    let m = trials as f64;
    let p = (rank as f64 - 0.5) / m;
    ((m * p * (1.0 - p)).sqrt().round() as u64).max(1)
}

/// Whether the order statistic of a rank is the least or the greatest of all: what lies beyond it, and
/// so how far it scatters, the trials do not tell.
pub(crate) fn is_extreme(trials: u64, rank: u64) -> bool {
    rank <= 1 || rank >= trials
}

/// The numerical standard error of the order statistic of rank `rank`: half the distance between
/// the order statistics one standard deviation of the rank below and above. It needs no density and
/// holds for any distribution. Not a number for the least and the greatest trial.
pub(crate) fn quantile_error(order: &mut Order, rank: u64) -> Option<f64> {
    if is_extreme(order.trials, rank) {
        return Some(f64::NAN);
    }
    let spread = rank_spread(order.trials, rank);
    let below = rank.saturating_sub(spread).max(1);
    let above = (rank + spread).min(order.trials);
    Some((order.get(above)? - order.get(below)?) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn order(values: Vec<f64>) -> Order {
        Order::of_all(values)
    }

    /// JCGM 101, 7.7.2 by hand: M = 1000, p = 0.95 gives q = 950 and r = 25; M = 999 gives
    /// q = 949 (949.05 + 0.5) and r = 25; M = 10, p = 0.5 gives q = 5 and r = 3 (5/2 is no integer).
    #[test]
    fn ranks_of_the_supplement() {
        assert_eq!(Ranks::new(1000, 0.95), Ranks { q: 950, r: 25 });
        assert_eq!(Ranks::new(999, 0.95), Ranks { q: 949, r: 25 });
        assert_eq!(Ranks::new(10, 0.5), Ranks { q: 5, r: 3 });
        assert_eq!(Ranks::new(1_000_000, 0.95), Ranks { q: 950_000, r: 25_000 });
    }

    #[test]
    fn symmetric_ends_are_order_statistics() {
        let mut order = order((1..=1000).rev().map(f64::from).collect());
        assert_eq!(symmetric(&mut order, 0.95), Some([25.0, 975.0]));
    }

    #[test]
    fn shortest_of_a_skew_set_starts_at_its_dense_end() {
        let mut order = order((1..=1000).map(|i| f64::from(i).powi(2)).collect());
        assert_eq!(shortest(&mut order, 0.95), Some(([1.0, 951.0 * 951.0], 1)));
    }

    #[test]
    fn of_equally_short_intervals_the_most_symmetric() {
        let mut order = order((1..=1000).map(f64::from).collect());
        let shortest = shortest(&mut order, 0.95).map(|(ends, _)| ends);
        assert_eq!(shortest, symmetric(&mut order, 0.95));
    }

    #[test]
    fn few_trials_give_the_extremes() {
        let mut order = order(vec![3.0, 1.0, 2.0]);
        assert_eq!(symmetric(&mut order, 0.95), Some([1.0, 3.0]));
        assert_eq!(shortest(&mut order, 0.95), Some(([1.0, 3.0], 1)));
    }

    /// Of 20 trials (q = 19, r = 1) the ends of the interval are the extremes, of 51 (q = 48, r = 2)
    /// they are not.
    #[test]
    fn extremes_have_no_error() {
        for (trials, r, known) in [(3, 1, false), (20, 1, false), (51, 2, true)] {
            let mut order = order((1..=trials).map(f64::from).collect());
            let ranks = Ranks::new(trials as u64, 0.95);
            assert_eq!(ranks.r, r);
            for rank in [ranks.r, ranks.r + ranks.q] {
                assert_eq!(
                    quantile_error(&mut order, rank).unwrap().is_finite(),
                    known,
                    "{trials}"
                );
            }
        }
    }
}
