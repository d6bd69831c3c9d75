//! The parts of a Butterworth filter.
//!
//! The prototype's n poles lie on the unit circle's left half, evenly spaced: -cos(a) +- i sin(a)
//! with a = pi j / (2 n) and j = 1, 3, ... for an even, j = 2, 4, ... and the pole -1 for an odd n.
//! Source: A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, appendix B.

use super::section::{FilterSection, Tap, cos_of};
use super::{Phasor, phasor};

/// The dampings 2 cos(a) of the pairs of poles, and whether there is a single pole.
fn prototype(poles: usize) -> (Vec<f64>, bool) {
    let single = poles % 2 == 1;
    let first = if single { 2 } else { 1 };
    ((0..poles / 2).map(|i| 2.0 * cos_of(first + 2 * i, poles)).collect(), single)
}

fn one_sided(poles: usize, w: f64, tap: Tap) -> Vec<FilterSection> {
    let (pairs, single) = prototype(poles);
    let mut sections: Vec<_> =
        pairs.into_iter().map(|k| FilterSection::Second { w, k, tap }).collect();
    if single {
        sections.push(FilterSection::First { w, tap });
    }
    sections
}

pub(super) fn low_pass(poles: usize, w: f64) -> Vec<FilterSection> {
    one_sided(poles, w, Tap::Low)
}

pub(super) fn high_pass(poles: usize, w: f64) -> Vec<FilterSection> {
    one_sided(poles, w, Tap::High)
}

/// A band-pass filter with `half` poles at each edge, and the factor that makes its gain one in
/// the middle of the band.
///
/// Each pole p of the prototype becomes the two roots of s^2 - width p s + centre^2.
pub(super) fn band_pass(half: usize, [low, high]: [f64; 2]) -> (Vec<FilterSection>, f64) {
    let (width, centre_squared) = (high - low, low * high);
    let (pairs, single) = prototype(half);
    let mut sections = Vec::with_capacity(half);
    for k in pairs {
        // (s^2 - width p s + c)(s^2 - width p* s + c) = (s^2 + a s + w^2)(s^2 + a' s + w'^2),
        // a = -2 Re(root), w^2 = |root|^2 of one root of the first factor, and w^2 w'^2 = c^2
        let p = Phasor::new(-k / 2.0, (1.0 - k * k / 4.0).max(0.0).sqrt());
        let half_width = p * (width / 2.0);
        let root = square_root(half_width * half_width - centre_squared);
        for r in [half_width + root, half_width - root] {
            sections.push(FilterSection::of_poles(-2.0 * r.re, r.norm_sqr(), Tap::Band));
        }
    }
    if single {
        sections.push(FilterSection::of_poles(width, centre_squared, Tap::Band));
    }
    let centre = Phasor::new(0.0, centre_squared.sqrt());
    let gain: Phasor = sections.iter().map(|part| part.response(centre)).product();
    let scale = 1.0 / phasor::modulus(gain);
    (sections, scale)
}

/// The root with a real part of zero or more.
fn square_root(z: Phasor) -> Phasor {
    let modulus = phasor::modulus(z);
    let re = f64::midpoint(modulus, z.re).max(0.0).sqrt();
    let im = f64::midpoint(modulus, -z.re).max(0.0).sqrt();
    Phasor::new(re, if z.im < 0.0 { -im } else { im })
}
