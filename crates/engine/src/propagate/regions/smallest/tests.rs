//! Volumes against those that are known.

use super::*;
use crate::distribution::{BLOCK, StreamKey};

/// Trials of each case.
const TRIALS: usize = 1 << 15;

/// Uniform columns.
fn uniform(count: usize) -> Vec<Vec<f64>> {
    let column = |name: &str| {
        let key = StreamKey::new(3, name);
        let blocks = (0..TRIALS.div_ceil(BLOCK) as u64).map(|block| {
            let mut values = [0.0; BLOCK];
            key.block(block).uniform(&mut values);
            values
        });
        blocks.flatten().collect()
    };
    ["a", "b", "c", "d", "e"][..count].iter().map(|name| column(name)).collect()
}

fn normals(count: usize) -> Vec<Vec<f64>> {
    let scores = |column: Vec<f64>| column.into_iter().map(special::normal::quantile).collect();
    uniform(count).into_iter().map(scores).collect()
}

/// The smallest region of 95 % of these columns.
fn region(columns: &[Vec<f64>]) -> Result<SmallestRegion, String> {
    let deviations = |of: &Vec<f64>| -> Vec<f64> {
        let mean = of.iter().sum::<f64>() / of.len() as f64;
        of.iter().map(|x| x - mean).collect()
    };
    let deviations: Vec<Vec<f64>> = columns.iter().map(deviations).collect();
    let covariance =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / a.len() as f64;
    let mut root: Vec<f64> = Vec::new();
    for (i, a) in deviations.iter().enumerate() {
        root.extend(deviations[..=i].iter().map(|b| covariance(a, b)));
    }
    packed::cholesky(&mut root, 0.0).unwrap();
    let place = |trial: usize| {
        let mut place = TrialPlace::default();
        for (at, of) in place.iter_mut().zip(&deviations) {
            *at = of[trial];
        }
        packed::solve(&root, &mut place[..columns.len()]);
        place
    };
    let places: Vec<TrialPlace> = (0..columns[0].len()).map(place).collect();
    smallest(&places, &root, 0.95)
}

/// The first column, and from each further one and what was made before it the next.
fn chained(columns: &[Vec<f64>], next: impl Fn(f64, f64) -> f64) -> Vec<Vec<f64>> {
    let mut made = vec![columns[0].clone()];
    for own in &columns[1..] {
        let pairs = own.iter().zip(&made[made.len() - 1]);
        let column = pairs.map(|(own, before)| next(*own, *before)).collect();
        made.push(column);
    }
    made
}

/// Within four of its stated errors of the volume (the trials' share of the error is normal: once in
/// 16 000 seeds), and the error at most this share.
fn check(name: &str, columns: &[Vec<f64>], volume: f64, largest: f64) {
    let found = region(columns).unwrap();
    let off = (found.volume - volume) / found.error;
    assert!(off.abs() < 4.0, "{name}: {found:?} for {volume}");
    assert!(found.error < largest * volume, "{name}: {found:?} for {volume}");
}

/// The ball of radius r.
fn ball(order: usize, r: f64) -> f64 {
    use std::f64::consts::PI;
    let unit = [PI, 4.0 / 3.0 * PI, 0.5 * PI * PI][order - 2];
    unit * (0..order).fold(1.0, |power, _| power * r)
}

/// Normal outputs, also correlated ones and such that are bent by a map that keeps volumes, which makes
/// paraboloids of their ellipsoids: ball of the chi-squared quantile times the determinant.
fn normal_ones(order: usize) {
    let z = normals(order);
    let r = (2.0 * special::gamma::quantile(0.95, 0.5 * order as f64)).sqrt();
    check("normal", &z, ball(order, r), 0.05);
    let sums = chained(&z, |own, before| 0.5 * own - 2.0 * before);
    let bent = chained(&z, |own, before| own + 0.2 * before * before);
    let determinant = 0.5_f64.powi(order as i32 - 1);
    check("correlated", &sums, determinant * ball(order, r), 0.05);
    check("bent", &bent, ball(order, r), 0.1);
}

/// A multivariate t distribution with 5 degrees of freedom: ball of the radius sqrt(m F(m, 5)), from
/// scipy 1.16.
fn multivariate_t(order: usize) {
    let last = uniform(5).pop().unwrap();
    let factor = |u: f64| (2.0 * special::gamma::quantile(u, 2.5) / 5.0).sqrt();
    let factors: Vec<f64> = last.into_iter().map(factor).collect();
    let volume = [36.355_358_69, 273.842_163, 2_128.566_226][order - 2];
    let mut columns = normals(order);
    for column in &mut columns {
        column.iter_mut().zip(&factors).for_each(|(z, factor)| *z /= factor);
    }
    check("t", &columns, volume, 0.08);
}

/// Skew outputs: exponential ones, whose region is the simplex x + y + ... <= q with the quantile of a
/// gamma distribution and the volume q^m/m!, and sums of those, of the same volume; lognormal ones of
/// sigma 0.5, whose region is a ball of the logarithms (noncentral chi-squared quantile and quadrature
/// in scipy 1.16).
fn skew_ones(order: usize) {
    let exponential = [11.252_125_28, 41.591_080_15, 150.596_539_7][order - 2];
    let lognormal = [5.423_213_23, 14.342_831_85, 37.500_421_14][order - 2];
    let u = uniform(order);
    let made = |of: fn(f64) -> f64| -> Vec<Vec<f64>> {
        u.iter().map(|column| column.iter().map(|u| of(*u)).collect()).collect()
    };
    let x = made(|u| -crate::number::elementary::ln(u));
    check("exponential", &x, exponential, 0.1);
    let sums = chained(&x, |own, before| own + before);
    check("sums of exponentials", &sums, exponential, 0.1);
    let x = made(|u| exp(0.5 * special::normal::quantile(u)));
    check("lognormal", &x, lognormal, 0.06);
}

/// Uniform densities, of a box and of a skew one: 95 % of all of it.
fn uniform_ones(order: usize) {
    let u = uniform(order);
    check("box", &u, 0.95, 0.05);
    let skew = chained(&u, |own, before| own - before);
    check("skew box", &skew, 0.95, 0.08);
}

#[test]
fn two_outputs() {
    for study in [normal_ones, multivariate_t, skew_ones, uniform_ones] {
        study(2);
    }
}

#[test]
fn four_outputs_of_a_t_distribution() {
    multivariate_t(4);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn three_and_four_outputs() {
    multivariate_t(3);
    for study in [normal_ones, skew_ones, uniform_ones] {
        study(3);
        study(4);
    }
}

/// Outputs on a curved surface have no volume, single values no density, and few trials tell nothing.
#[test]
fn no_volume() {
    let z = normals(2);
    let product: Vec<f64> = z[0].iter().zip(&z[1]).map(|(a, b)| a * b).collect();
    let square: Vec<f64> = z[0].iter().map(|a| a * a).collect();
    let of = |columns: &[&Vec<f64>]| {
        region(&columns.iter().map(|of| (*of).clone()).collect::<Vec<_>>()).unwrap_err()
    };
    assert!(of(&[&z[0], &z[1], &product]).contains("curved surface"));
    assert!(of(&[&z[0], &square]).contains("curved surface"));
    let counts: Vec<f64> = z[0].iter().map(|z| (4.0 * z).round()).collect();
    assert!(of(&[&z[1], &counts]).contains("single values"));
    let few: Vec<Vec<f64>> = z.iter().map(|of| of[..4000].to_vec()).collect();
    assert!(of(&[&few[0], &few[1]]).contains("there are 4000, 200 of them outside"));
}
