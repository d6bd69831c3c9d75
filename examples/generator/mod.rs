//! What the programs that make synthetic data share: random numbers, phasors and what the papers
//! print of their test plans.

// each program uses a part of it
#![allow(dead_code)]

use std::f64::consts::TAU;

/// Frequencies of the rotating table in hertz with its oscillation angles from end to end in
/// degrees (Chiominto et al. 2024, section 3.4.1).
pub(crate) const OSCILLATIONS: [(f64, f64); 3] = [(5.0, 34.0), (8.0, 13.0), (10.0, 8.5)];

/// Frequencies of the slide, in hertz (D'Emilia et al. 2019).
pub(crate) const SLIDE: [f64; 12] = [0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0, 15.0, 20.0];

/// Independent random bits that are the same on every machine and in every version: SplitMix64
/// (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub(crate) struct SplitMix64(pub(crate) u64);

impl SplitMix64 {
    /// The next 64 bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 * 2f64.powi(-53)
    }

    /// Normal about zero, by the method of Box and Muller.
    pub(crate) fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        deviation * radius * (TAU * self.uniform()).cos()
    }

    /// Within limits about zero.
    pub(crate) fn within(&mut self, half_width: f64) -> f64 {
        half_width * (2.0 * self.uniform() - 1.0)
    }
}

/// A complex number: an amplitude with a phase, or a response.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phasor {
    pub(crate) re: f64,
    pub(crate) im: f64,
}

impl Phasor {
    pub(crate) const ZERO: Self = Self { re: 0.0, im: 0.0 };
    pub(crate) const ONE: Self = Self { re: 1.0, im: 0.0 };

    pub(crate) fn polar(amplitude: f64, degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Self { re: amplitude * cos, im: amplitude * sin }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }

    pub(crate) fn times(self, other: Self) -> Self {
        let re = self.re * other.re - self.im * other.im;
        Self { re, im: self.re * other.im + self.im * other.re }
    }

    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { re: factor * self.re, im: factor * self.im }
    }

    pub(crate) fn inverse(self) -> Self {
        let square = self.re * self.re + self.im * self.im;
        Self { re: self.re / square, im: -self.im / square }
    }

    pub(crate) fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }

    pub(crate) fn degrees(self) -> f64 {
        self.im.atan2(self.re).to_degrees()
    }
}

/// Motions along x', y', z' of an inclined plane as the axes of a sensor see them that is turned by
/// a tilt and a rotation in degrees (Prato et al. 2020, eqs (1)-(3), with signs).
pub(crate) fn axes_on_the_plane([x, y, z]: [Phasor; 3], tilt: f64, rotation: f64) -> [Phasor; 3] {
    let (sin, cos) = tilt.to_radians().sin_cos();
    let (sin_turn, cos_turn) = rotation.to_radians().sin_cos();
    let down = z.scaled(sin).plus(x.scaled(cos));
    [
        down.scaled(cos_turn).plus(y.scaled(-sin_turn)),
        down.scaled(sin_turn).plus(y.scaled(cos_turn)),
        z.scaled(cos).plus(x.scaled(-sin)),
    ]
}
