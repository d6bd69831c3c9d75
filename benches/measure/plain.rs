//! A fixed plain loop that speed is measured against: the inclined plane drawn by rand_distr,
//! computed by the standard library's functions trial by trial, all values sorted. What a careful
//! programmer writes in an afternoon.

use std::hint::black_box;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use rand_distr::Normal;

/// Trials of one call; never to be changed, for the recorded ratios stand on it.
pub const TRIALS: usize = 200_000;

/// Values about a centre: a normal or a rectangular distribution.
#[derive(Clone, Copy, Debug)]
struct About(f64, f64);

impl About {
    #[allow(clippy::unwrap_used)] // the standard deviations are constants
    fn normal(self, generator: &mut Xoshiro256PlusPlus) -> f64 {
        generator.sample(Normal::new(self.0, self.1).unwrap())
    }

    fn rectangular(self, generator: &mut Xoshiro256PlusPlus) -> f64 {
        generator.random_range(self.0 - self.1..self.0 + self.1)
    }
}

fn trial(generator: &mut Xoshiro256PlusPlus) -> f64 {
    let degree = 1f64.to_radians();
    let a_ref = About(10.0, 0.01).normal(generator);
    let tilt = About(35.0 * degree, 0.1 * degree).rectangular(generator);
    let rotation = About(30.0 * degree, 0.1 * degree).rectangular(generator);
    let [x, y, z] = [0.3, 0.2, 0.15].map(|a| About(a, 0.0025).rectangular(generator));
    let [p, q, r] = [40.0, -65.0, 3.0].map(|a| About(a * degree, 2.0 * degree).normal(generator));
    let x = (x * tilt.cos() * rotation.cos()).abs();
    let y = (y * rotation.sin()).abs();
    let z = (z * tilt.sin() * rotation.cos()).abs();
    let reference = (a_ref * tilt.sin() * rotation.cos()).abs();
    let re = reference + x * p.cos() + y * q.cos() + z * r.cos();
    let im = x * p.sin() + y * q.sin() + z * r.sin();
    (re * re + im * im).sqrt()
}

/// The loop's figures and the published ones (mean, standard uncertainty, symmetric interval) of
/// the same measurement agree within six standard errors: of the mean u/sqrt(n), of an end about
/// 2.7 times that, as of any 2.5 % quantile of a nearly normal distribution.
pub fn is_right() -> bool {
    let [mean, u, low, high, ..] = run();
    let error = 0.010862 / (TRIALS as f64).sqrt();
    let near = |found: f64, right: f64, errors: f64| (found - right).abs() < errors * error;
    near(mean, 5.247_087, 6.0)
        && near(u, 0.010_862, 6.0)
        && near(low, 5.226_06, 16.0)
        && near(high, 5.268, 16.0)
}

/// Mean, standard uncertainty, and the ends of the symmetric and of the shortest 95 % interval.
pub fn run() -> [f64; 6] {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut values: Vec<f64> = (0..TRIALS).map(|_| trial(&mut generator)).collect();
    let mean = values.iter().sum::<f64>() / TRIALS as f64;
    let squares = values.iter().map(|y| (y - mean) * (y - mean)).sum::<f64>();
    values.sort_unstable_by(f64::total_cmp);
    let q = TRIALS * 95 / 100;
    let r = (TRIALS - q) / 2;
    let length = |&start: &usize| values[start + q] - values[start];
    let shortest = (0..TRIALS - q).min_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(0);
    black_box([
        mean,
        (squares / (TRIALS - 1) as f64).sqrt(),
        values[r - 1],
        values[r + q - 1],
        values[shortest],
        values[shortest + q],
    ])
}
