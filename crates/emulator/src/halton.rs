//! Points that fill a space: those of Halton with randomly permuted digits (Owen, A randomized Halton
//! algorithm in R, arXiv:1706.02808, 2017). Unlike a net they fill it evenly with any number of points.

use gumption_engine::distribution::StreamKey;
use gumption_engine::special::normal;

use crate::uniforms::Uniforms;

/// Space-filling points leave so much of the prior probability out at each end of a parameter.
const TAIL: f64 = 2e-3;

/// So many points in so many dimensions that fill the unit cube evenly; each coordinate is in (0, 1). One
/// coordinate is a function of the key, its dimension and the number of the point.
fn points(count: usize, dimensions: usize, key: StreamKey) -> Vec<Vec<f64>> {
    let mut points = vec![Vec::with_capacity(dimensions); count];
    let mut base = 1;
    for dimension in 0..dimensions {
        base = next_prime(base);
        let mut random = Uniforms::new(key, dimension as u64);
        let mut values = vec![0.0; count];
        let mut scale = 1.0;
        let mut power = 1;
        // digits below the last bit of the sum change nothing
        while scale > 0.5 * f64::EPSILON {
            scale /= base as f64;
            let digits = permutation(base, &mut random);
            for (number, value) in values.iter_mut().enumerate() {
                // digits beyond the number's own are its zeros, permuted as well
                *value += scale * digits[number / power % base] as f64;
            }
            power = power.saturating_mul(base);
        }
        for (point, value) in points.iter_mut().zip(values) {
            point.push((value + 0.5 * scale).min(1.0 - f64::EPSILON));
        }
    }
    points
}

/// Normal scores of points that fill the priors of so many parameters, but for the outermost 0.2 % at each
/// end. The first n of more points are the n points: what is filled stays filled.
///
/// ```
/// use gumption_emulator::space_filling_scores;
/// use gumption_engine::distribution::StreamKey;
///
/// let scores = space_filling_scores(30, 2, StreamKey::new(1, "start"));
/// assert_eq!(scores.iter().filter(|point| point[0] < 0.0).count(), 15);
/// ```
pub fn space_filling_scores(count: usize, dimensions: usize, key: StreamKey) -> Vec<Vec<f64>> {
    let mut scores = points(count, dimensions, key);
    for score in scores.iter_mut().flatten() {
        *score = normal::quantile(score.clamp(TAIL, 1.0 - TAIL));
    }
    scores
}

/// The digits of a base in random order (Fisher and Yates).
fn permutation(base: usize, random: &mut Uniforms) -> Vec<usize> {
    let mut digits: Vec<usize> = (0..base).collect();
    for last in (1..base).rev() {
        let chosen = (random.next() * (last + 1) as f64) as usize;
        digits.swap(last, chosen.min(last));
    }
    digits
}

fn next_prime(after: usize) -> usize {
    let is_prime = |n: usize| (2..).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
    (after + 1..).find(|&n| is_prime(n)).unwrap_or(after)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of base^k points each of as many equal cells of a coordinate holds one.
    #[test]
    fn each_cell_of_a_coordinate_holds_one_point() {
        let all = points(125, 3, StreamKey::new(7, "points"));
        for (dimension, count) in [(0, 64), (1, 81), (2, 125)] {
            let mut held = vec![0; count];
            for point in &all[..count] {
                assert!(point[dimension] > 0.0 && point[dimension] < 1.0);
                held[(point[dimension] * count as f64) as usize] += 1;
            }
            assert!(held.iter().all(|&held| held == 1), "{dimension}: {held:?}");
        }
    }

    /// Late dimensions, whose plain points lie on a line, fill the square: the correlation of 20 points has
    /// a standard deviation of 1/sqrt(19) = 0.23 where they are independent; plain points have above 0.9.
    #[test]
    fn late_dimensions_are_not_on_a_line() {
        let all = points(20, 12, StreamKey::new(1, "points"));
        let product: f64 = all.iter().map(|p| (p[10] - 0.5) * (p[11] - 0.5)).sum();
        assert!((12.0 * product / 20.0).abs() < 0.7, "{product}");
        assert_eq!(all, points(20, 12, StreamKey::new(1, "points")));
        assert_ne!(all, points(20, 12, StreamKey::new(2, "points")));
    }
}
