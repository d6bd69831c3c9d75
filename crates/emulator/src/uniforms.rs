//! Random numbers one by one.

use gumption_engine::distribution::{Stream, StreamKey};

/// Numbers made at once.
const TOGETHER: usize = 8;

/// Numbers that are uniform on (0, 1).
#[derive(Debug)]
pub(crate) struct Uniforms {
    stream: Stream,
    made: [f64; TOGETHER],
    used: usize,
}

impl Uniforms {
    /// Those of a block of a stream.
    pub(crate) fn new(key: StreamKey, block: u64) -> Self {
        Self { stream: key.block(block), made: [0.0; TOGETHER], used: TOGETHER }
    }

    /// The next number.
    pub(crate) fn next(&mut self) -> f64 {
        if self.used == TOGETHER {
            self.stream.uniform(&mut self.made);
            self.used = 0;
        }
        self.used += 1;
        self.made[self.used - 1]
    }

    /// A place with a probability proportional to its weight; `None` where no weight is above 0.
    pub(crate) fn place(&mut self, weights: &[f64]) -> Option<usize> {
        let mut left = self.next() * weights.iter().sum::<f64>();
        let passes = |weight: &f64| {
            left -= weight;
            left < 0.0
        };
        // rounding may leave a little behind the last
        let last = weights.iter().rposition(|weight| *weight > 0.0)?;
        Some(weights.iter().position(passes).map_or(last, |place| place.min(last)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 4000 places each is met as often as its weight says within four standard deviations, sqrt(n p q):
    /// a false failure rate of 1e-4 each, of one seed.
    #[test]
    fn places_are_as_frequent_as_their_weights() {
        let mut random = Uniforms::new(StreamKey::new(1, "places"), 0);
        let weights = [0.0, 3.0, 0.0, 1.0, 0.0];
        let mut met = [0; 5];
        for _ in 0..4000 {
            met[random.place(&weights).unwrap()] += 1;
        }
        assert_eq!((met[0], met[2], met[4]), (0, 0, 0));
        assert!((f64::from(met[1]) - 3000.0).abs() < 4.0 * 750f64.sqrt(), "{met:?}");
        assert_eq!(random.place(&[0.0, 0.0]), None);
    }
}
