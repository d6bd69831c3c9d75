//! The fast Fourier transform of any length, with the same bits on every machine.
//!
//! Crates for it take the sines and cosines of their twiddle factors from the platform, whose last
//! digits differ from one C library, and one processor, to the next. Here they are
//! [`elementary`](gumption_engine::number::elementary)'s. The transform itself is Stockham's:
//! decimation in frequency by the factors of the length, each stage from one array into another, so
//! that no bits are to be reversed. Lengths with a prime factor above 13 are a convolution with a
//! chirp (Bluestein 1970, IEEE Transactions on Audio and Electroacoustics 18, 451), which is made by
//! transforms of a power of two.

use crate::Phasor;
use crate::phasor::at_turns;

/// The largest prime factor that is transformed by itself.
const MOST_RADIX: usize = 13;

/// Replaces values by the sums of `x_k` exp(-2 pi i j k / n), j = 0, ..., n - 1.
pub(crate) fn forward(values: &mut Vec<Phasor>) {
    let n = values.len();
    match factors(n) {
        Some(factors) => by_factors(values, &factors),
        None => by_chirp(values),
    }
}

/// Replaces values by the sums of `x_k` exp(2 pi i j k / n): n times the inverse of [`forward`].
pub(crate) fn inverse(values: &mut Vec<Phasor>) {
    conjugate(values);
    forward(values);
    conjugate(values);
}

fn conjugate(values: &mut [Phasor]) {
    values.iter_mut().for_each(|value| value.im = -value.im);
}

/// The factors of a length, fours first; none where one of them is too large.
fn factors(mut n: usize) -> Option<Vec<usize>> {
    let mut factors = Vec::new();
    for radix in [4, 2, 3, 5, 7, 11, MOST_RADIX] {
        while n > 1 && n.is_multiple_of(radix) {
            factors.push(radix);
            n /= radix;
        }
    }
    (n <= 1).then_some(factors)
}

/// exp(-2 pi i k / n) for k = 0, ..., n - 1.
fn roots(n: usize) -> Vec<Phasor> {
    let mut roots = vec![Phasor::new(1.0, 0.0); n];
    // a turn's two halves are mirror images; the first half's quotients are the more exact ones
    for k in 1..=n / 2 {
        let root = at_turns(k as f64 / n as f64);
        roots[n - k] = root;
        roots[k] = root.conj();
    }
    roots
}

fn by_factors(values: &mut Vec<Phasor>, factors: &[usize]) {
    let roots = roots(values.len());
    let mut other = vec![Phasor::new(0.0, 0.0); values.len()];
    // what is left of the length, and how many transforms of that length stand interleaved
    let (mut length, mut stride) = (values.len(), 1);
    for &radix in factors {
        match radix {
            2 => stage(values, &mut other, length, stride, &roots, |[a, b]| [a + b, a - b]),
            4 => stage(values, &mut other, length, stride, &roots, |[a, b, c, d]| {
                let (even, odd) = (a + c, b + d);
                let (turned, across) = (a - c, b - d);
                let across = Phasor::new(across.im, -across.re);
                [even + odd, turned + across, even - odd, turned - across]
            }),
            3 => stage::<3>(values, &mut other, length, stride, &roots, |a| small(a, &roots)),
            5 => stage::<5>(values, &mut other, length, stride, &roots, |a| small(a, &roots)),
            7 => stage::<7>(values, &mut other, length, stride, &roots, |a| small(a, &roots)),
            11 => stage::<11>(values, &mut other, length, stride, &roots, |a| small(a, &roots)),
            _ => stage::<MOST_RADIX>(values, &mut other, length, stride, &roots, |a| {
                small(a, &roots)
            }),
        }
        std::mem::swap(values, &mut other);
        length /= radix;
        stride *= radix;
    }
}

/// One stage: `R` values a part of the length apart are transformed, turned, and stand beside each
/// other in the other array.
#[inline(always)]
fn stage<const R: usize>(
    from: &[Phasor],
    to: &mut [Phasor],
    length: usize,
    stride: usize,
    roots: &[Phasor],
    transformed: impl Fn([Phasor; R]) -> [Phasor; R],
) {
    let part = length / R;
    for k in 0..part {
        let turns: [Phasor; R] = std::array::from_fn(|i| roots[k * i * stride]);
        for q in 0..stride {
            let found = transformed(std::array::from_fn(|j| from[q + stride * (k + j * part)]));
            for (i, (value, turn)) in found.into_iter().zip(turns).enumerate() {
                to[q + stride * (R * k + i)] = if i == 0 { value } else { value * turn };
            }
        }
    }
}

/// A transform of a small length by its definition.
#[inline(always)]
fn small<const R: usize>(values: [Phasor; R], roots: &[Phasor]) -> [Phasor; R] {
    let step = roots.len() / R;
    std::array::from_fn(|i| {
        let terms = values.iter().enumerate().skip(1);
        terms.fold(values[0], |sum, (j, value)| sum + value * roots[i * j % R * step])
    })
}

fn by_chirp(values: &mut [Phasor]) {
    let n = values.len();
    let length = (2 * n - 1).next_power_of_two();
    // exp(-pi i k^2 / n): the square is taken modulo 2 n, so that the angle stays exact
    let chirp: Vec<Phasor> = (0..n as u128)
        .map(|k| at_turns((k * k % (2 * n as u128)) as f64 / (2 * n) as f64).conj())
        .collect();
    let zero = Phasor::new(0.0, 0.0);
    let (mut signal, mut response) = (vec![zero; length], vec![zero; length]);
    for (k, (value, chirp)) in values.iter().zip(&chirp).enumerate() {
        signal[k] = value * chirp;
        response[k] = chirp.conj();
        response[(length - k) % length] = chirp.conj();
    }
    forward(&mut signal);
    forward(&mut response);
    signal.iter_mut().zip(&response).for_each(|(value, factor)| *value *= factor);
    inverse(&mut signal);
    for ((out, value), chirp) in values.iter_mut().zip(&signal).zip(&chirp) {
        *out = value * chirp / length as f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Noises;

    /// Every length up to 70 and some large ones, primes among them, against the definition at some
    /// of the frequencies. The values are of the size of 1, so that a sum is of the size of the root
    /// of n and its rounding some 1e-16 times that, for each of the log n stages.
    #[test]
    fn transforms_are_the_sums() {
        let mut noise = Noises::new("transform", 0);
        for n in (1..70_usize).chain([997, 1024, 1612, 5040, 6007, 14_641]) {
            let values: Vec<Phasor> =
                (0..n).map(|_| Phasor::new(noise.next(), noise.next())).collect();
            let mut found = values.clone();
            forward(&mut found);
            for j in (0..n).step_by(n.div_ceil(9)) {
                let mut sum = Phasor::new(0.0, 0.0);
                for (k, value) in values.iter().enumerate() {
                    sum += value * at_turns(-((j * k % n) as f64 / n as f64));
                }
                let miss = (found[j] - sum).norm_sqr().sqrt();
                assert!(miss < 1e-14 * n as f64, "{n}: {j}: {miss}");
            }
            inverse(&mut found);
            for (value, found) in values.iter().zip(&found) {
                let miss = (found / n as f64 - value).norm_sqr().sqrt();
                assert!(miss < 1e-14, "{n}: {miss}");
            }
        }
    }

    #[test]
    fn nothing_stays_nothing() {
        let mut none = Vec::new();
        forward(&mut none);
        inverse(&mut none);
        assert!(none.is_empty());
    }
}
