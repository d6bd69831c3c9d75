//! The least value of a function by golden sections.

/// The smaller part of the golden section.
const SMALLER: f64 = 0.381_966_011_250_105;

/// Where a function is least between two places, if it falls and then rises between them, after so many
/// sections, each of which leaves 0.618 of the distance.
pub(super) fn least([mut low, mut high]: [f64; 2], sections: u32, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..sections {
        let width = SMALLER * (high - low);
        let (a, b) = (low + width, high - width);
        if of(a) <= of(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}
