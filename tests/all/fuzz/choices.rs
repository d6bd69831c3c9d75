//! Choices from a seed: the same on every machine.

use serde_json::{Number, Value, json};

use crate::recordings::program::generator::SplitMix64;

/// A sequence of choices.
pub(super) struct Choices(SplitMix64);

/// Numbers at the edge of what a double holds, and beside it.
const EXTREMES: &[f64] = &[
    0.0,
    -0.0,
    -1.0,
    1e308,
    -1e308,
    f64::MAX,
    5e-324,
    -5e-324,
    1e-300,
    0.999_999_999_999_999_9,
    1.000_000_000_000_000_2,
    9_007_199_254_740_992.0,
    1e16,
    1e-16,
    1.234_567_890_123_456_8e29,
];

/// Numbers in other spellings, and what looks like a number and is none in JSON.
const SPELLINGS: &[&str] = &[
    "1E+5",
    "-0",
    "123456789012345678901234567890",
    "1e999",
    "-1e999",
    "NaN",
    "-Infinity",
    "01",
    "1.",
    ".5",
    "+1",
    "1e",
    "0x10",
];

impl Choices {
    /// The choices of one case of a seed.
    pub(super) fn of(seed: u64, case: u64) -> Self {
        let mut bits = SplitMix64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ case);
        bits.next();
        Self(bits)
    }

    /// A number below `bound`, which is above 0.
    pub(super) fn below(&mut self, bound: usize) -> usize {
        (self.0.next() % bound as u64) as usize
    }

    /// A number from `least` to `most`.
    pub(super) fn between(&mut self, least: usize, most: usize) -> usize {
        least + self.below(most - least + 1)
    }

    /// True `percent` times in a hundred.
    pub(super) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    pub(super) fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }

    /// Mostly one of the right ones.
    pub(super) fn mostly<T: Clone>(&mut self, right: &[T], wrong: &[T]) -> T {
        if self.below(40) == 0 { self.pick(wrong) } else { self.pick(right) }
    }

    /// A number as it may stand in a file: mostly plain, sometimes extreme, sometimes any double.
    pub(super) fn number(&mut self) -> Value {
        match self.below(20) {
            0..=10 => json!((self.below(2001) as f64 - 1000.0) / 100.0),
            11..=13 => json!(self.between(0, 12)),
            14 => json!(10f64.powi(self.between(0, 40) as i32 - 20)),
            15 => Number::from_f64(f64::from_bits(self.0.next())).map_or(json!(0), Value::Number),
            16..=17 => json!(self.pick(EXTREMES)),
            _ => json!((self.below(20_001) as f64 - 10_000.0) / 7.0),
        }
    }

    /// A number above zero.
    pub(super) fn positive(&mut self) -> Value {
        match self.below(12) {
            0..=7 => json!((1 + self.below(1000)) as f64 / 100.0),
            8 => json!(10f64.powi(self.between(0, 40) as i32 - 20)),
            9 => json!(self.pick(&[5e-324, 1e-300, 1e300, f64::MAX, 1e16])),
            10 => {
                let any = f64::from_bits(self.0.next()).abs();
                json!(if any.is_finite() { any } else { 1.0 })
            }
            _ => json!(self.between(1, 30)),
        }
    }

    /// A number as text, right or not.
    pub(super) fn spelling(&mut self) -> String {
        if self.chance(15) { self.pick(SPELLINGS).to_owned() } else { self.number().to_string() }
    }

    /// Any text: letters of all scripts, or bytes that are none.
    pub(super) fn text(&mut self) -> String {
        let length = self.below(200);
        if self.chance(50) {
            let bytes: Vec<u8> = (0..length).map(|_| self.below(256) as u8).collect();
            return String::from_utf8_lossy(&bytes).into_owned();
        }
        let letter = |choices: &mut Self| char::from_u32(choices.below(0x11_0000) as u32);
        (0..length).filter_map(|_| letter(self)).collect()
    }
}
