//! Choices from a seed: the same on every machine.

/// A sequence of choices (SplitMix64; Steele, Lea, Flood, OOPSLA 2014).
#[derive(Debug)]
pub(super) struct Random(u64);

impl Random {
    /// The choices of one case of a seed.
    pub(super) fn of(seed: u64, case: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ case);
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `bound`, which is above 0.
    pub(super) fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// A number from `least` to `most`.
    pub(super) fn between(&mut self, least: usize, most: usize) -> usize {
        least + self.below(most - least + 1)
    }

    /// True `percent` times in a hundred.
    pub(super) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    pub(super) fn pick<'p, T: ?Sized>(&mut self, list: &[&'p T]) -> &'p T {
        list[self.below(list.len())]
    }

    /// Mostly one of the right ones.
    pub(super) fn mostly<'p>(&mut self, right: &[&'p str], wrong: &[&'p str]) -> &'p str {
        if self.below(40) == 0 { self.pick(wrong) } else { self.pick(right) }
    }

    /// Any double, as text.
    fn bits(&mut self) -> String {
        let number = f64::from_bits(self.next());
        if number.is_finite() { format!("{number:e}") } else { "0".to_owned() }
    }

    /// A number as it may stand in a file: mostly plain, sometimes extreme.
    pub(super) fn number(&mut self) -> String {
        if self.below(500) == 0 {
            return self.pick(WRONG).to_owned();
        }
        match self.below(20) {
            0..=10 => format!("{}", (self.below(2001) as f64 - 1000.0) / 100.0),
            11..=13 => self.between(0, 12).to_string(),
            14 => format!("1e{}", self.between(0, 40) as i32 - 20),
            15 => self.bits(),
            16..=17 => self.pick(EXTREMES).to_owned(),
            _ => format!("{:.4e}", (self.below(20_001) as f64 - 10_000.0) / 7.0),
        }
    }

    /// A number above zero.
    pub(super) fn positive(&mut self) -> String {
        match self.below(12) {
            0..=7 => format!("{}", (1 + self.below(1000)) as f64 / 100.0),
            8 => format!("1e{}", self.between(0, 40) as i32 - 20),
            9 => self
                .pick(&["5e-324", "1e-300", "1e300", "1.7976931348623157e308", "1e16"])
                .to_owned(),
            _ => self.between(1, 30).to_string(),
        }
    }
}

/// Numbers at the edge of what a double holds.
const EXTREMES: &[&str] = &[
    "0",
    "-0",
    "-1",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "5e-324",
    "-5e-324",
    "1e-300",
    "0.9999999999999999",
    "1.0000000000000002",
    "9007199254740993",
    "1e16",
    "1e-16",
    "1E+5",
    "123456789012345678901234567890",
];

/// Numbers that are none in JSON.
const WRONG: &[&str] =
    &["1e999", "-1e999", "NaN", "-Infinity", "01", "1.", ".5", "+1", "1e", "0x10"];
