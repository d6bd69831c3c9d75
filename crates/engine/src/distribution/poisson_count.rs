//! The expected number of events, given a count (JCGM 101, 6.4.11).

use super::gamma::Gamma;
use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use crate::number::Column;

/// The largest count.
const MOST: u64 = 999_999_999_999_999;

/// The expected number of events of a Poisson process, given the number of counted events: the
/// gamma distribution with shape count + 1 and rate 1. Estimate and variance are count + 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoissonCount {
    count: u64,
    gamma: Gamma,
}

impl PoissonCount {
    /// The posterior after `count` events were counted (below 1e15), without prior knowledge.
    ///
    /// # Errors
    /// A count out of range.
    pub fn new(count: u64) -> Result<Self, Invalid> {
        if count > MOST {
            let value = count as f64;
            return Err(Invalid::OutOfRange { parameter: "count", value, range: "below 1e15" });
        }
        Ok(Self { count, gamma: Gamma::new(count as f64 + 1.0, 1.0)? })
    }

    /// The number of counted events.
    pub fn count(&self) -> u64 {
        self.count
    }
}

impl Shape for PoissonCount {
    const NAME: &'static str = "poisson-count";

    fn mean(&self) -> f64 {
        self.gamma.mean()
    }

    fn standard_uncertainty(&self) -> f64 {
        self.gamma.standard_uncertainty()
    }

    fn quantile(&self, p: f64) -> f64 {
        self.gamma.quantile(p)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.gamma.quantile_upper(q)
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        self.gamma.draw(stream, out);
    }

    /// The count with that estimate: one less.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let count = finite("estimate", estimate)? - 1.0;
        if count.fract() == 0.0 && (0.0..=MOST as f64).contains(&count) {
            Self::new(count as u64)
        } else {
            Err(Invalid::OutOfRange {
                parameter: "estimate",
                value: estimate,
                range: "a count of events plus one: a whole number from 1 to 1e15",
            })
        }
    }
}
