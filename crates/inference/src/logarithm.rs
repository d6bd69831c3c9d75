//! Sums of numbers that are known by their logarithms, which may lie beyond the range of doubles.

use gumption_engine::number::elementary;

/// Half the logarithm of two pi: what a normal density has for each of its dimensions.
pub const HALF_LN_TWO_PI: f64 = 0.918_938_533_204_672_7;

/// The logarithm of the sum of two numbers given by their logarithms.
pub fn ln_add(a: f64, b: f64) -> f64 {
    let (most, least) = if a > b { (a, b) } else { (b, a) };
    if most == f64::NEG_INFINITY { most } else { most + libm::log1p(elementary::exp(least - most)) }
}

/// The logarithm of the sum of numbers given by their logarithms; minus infinity of none.
pub fn ln_sum(terms: impl Iterator<Item = f64> + Clone) -> f64 {
    let most = terms.clone().fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        return most;
    }
    most + elementary::ln(terms.map(|ln| elementary::exp(ln - most)).sum())
}
