//! Standard normal numbers of a stream, one after the other.

use gumption_engine::distribution::{BLOCK, StreamKey};
use gumption_engine::special::normal;

/// Standard normal numbers of a stream.
pub(super) struct Normals {
    key: StreamKey,
    block: u64,
    place: usize,
    uniforms: [f64; BLOCK],
}

impl Normals {
    pub(super) fn new(key: StreamKey) -> Self {
        Self { key, block: 0, place: BLOCK, uniforms: [0.0; BLOCK] }
    }

    /// The next.
    pub(super) fn next(&mut self) -> f64 {
        normal::quantile(self.next_uniform())
    }

    /// The next number between 0 and 1 in place of a normal one.
    pub(super) fn next_uniform(&mut self) -> f64 {
        if self.place == BLOCK {
            self.key.block(self.block).uniform(&mut self.uniforms);
            self.block += 1;
            self.place = 0;
        }
        self.place += 1;
        self.uniforms[self.place - 1]
    }
}
