//! A stream as a generator of the crate `rand`.

use std::convert::Infallible;

use rand_core::{TryRng, utils};

use super::{LANES, Stream, StreamKey};

/// The random words of a stream one by one: a generator for `rand`, `rand_distr` and any other user
/// of [`rand_core::Rng`] (version 0.10).
///
/// The words are the same on every machine. Values computed by another crate may depend on its
/// version, and on the machine if it uses the standard library's functions.
///
/// ```
/// use gumption_engine::distribution::StreamRng;
/// use rand_distr::{Distribution, Weibull};
///
/// let mut random = StreamRng::new(1, "wind speed");
/// let speed: f64 = Weibull::new(8.0, 2.0)?.sample(&mut random);
/// assert!(speed > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct StreamRng {
    stream: Stream,
    words: [u64; LANES],
    /// Number of words already returned.
    used: usize,
}

impl StreamRng {
    /// The generator for a seed and a name. Other seeds and names give independent generators. It
    /// begins as the first block of the trials of an input with that name.
    pub fn new(seed: u64, name: &str) -> Self {
        Self::of(StreamKey::new(seed, name).block(0))
    }

    /// The words that come next in a stream.
    pub(crate) fn of(stream: Stream) -> Self {
        Self { stream, words: [0; LANES], used: LANES }
    }

    /// The stream after the words that were generated, whether they were returned or not.
    pub(crate) fn into_stream(self) -> Stream {
        self.stream
    }

    fn word(&mut self) -> u64 {
        if self.used == LANES {
            (self.words, self.used) = (self.stream.next(), 0);
        }
        self.used += 1;
        self.words[self.used - 1]
    }
}

impl TryRng for StreamRng {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.word() >> 32) as u32)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.word())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        utils::fill_bytes_via_next_word(bytes, || Ok(self.word()))
    }
}

#[cfg(test)]
mod tests {
    use rand_core::Rng;

    use super::*;

    /// The words are those from which the stream's uniform numbers are made.
    #[test]
    fn words_are_those_of_the_stream() {
        let mut uniform = [0.0; 128];
        StreamKey::new(3, "x").block(0).uniform(&mut uniform);
        let mut random = StreamRng::new(3, "x");
        for u in uniform {
            let word = random.next_u64();
            assert_eq!(u, ((word >> 12) as f64 + 0.5) / (1u64 << 52) as f64);
        }
    }

    #[test]
    fn bytes_and_halves_are_parts_of_the_words() {
        let word = StreamRng::new(3, "x").next_u64();
        assert_eq!(u64::from(StreamRng::new(3, "x").next_u32()), word >> 32);
        let mut bytes = [0; 11];
        StreamRng::new(3, "x").fill_bytes(&mut bytes);
        assert_eq!(bytes[..8], word.to_le_bytes());
        assert_ne!(StreamRng::new(4, "x").next_u64(), word);
        assert_ne!(StreamRng::new(3, "y").next_u64(), word);
    }
}
