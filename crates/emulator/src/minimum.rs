//! The minimum of a smooth function within limits.

use gumption_engine::linalg::dot;

/// A step has to lower the function by this share of what its slope promises (Armijo).
const SHARE: f64 = 1e-4;

/// Halvings of a step at most.
const HALVINGS: usize = 20;

/// The search ends where no slope, within the limits, is above this.
const FLAT: f64 = 1e-4;

/// Where a function is least within [-limit, limit] of each variable, from `start` on: the method of
/// Broyden, Fletcher, Goldfarb and Shanno over the variables that are at no limit, or would leave it
/// (Nocedal and Wright, Numerical Optimization, 2006, chapters 6 and 16.7). `evaluate` gives value and
/// gradient; a value that is not finite is a step too far.
pub(crate) fn minimum(
    start: &[f64],
    limit: f64,
    steps: usize,
    mut evaluate: impl FnMut(&[f64]) -> (f64, Vec<f64>),
) -> Vec<f64> {
    let n = start.len();
    let mut at: Vec<f64> = start.iter().map(|x| x.clamp(-limit, limit)).collect();
    let (mut value, mut gradient) = evaluate(&at);
    let mut inverse = identity(n);
    let mut is_new = true;
    for _ in 0..steps {
        let is_free = |i: &usize| at[*i].abs() < limit || at[*i] * gradient[*i] > 0.0;
        let free: Vec<usize> = (0..n).filter(is_free).collect();
        if free.iter().all(|&i| gradient[i].abs() < FLAT) {
            break;
        }
        let mut direction = vec![0.0; n];
        for &i in &free {
            direction[i] = -free.iter().map(|&j| inverse[i][j] * gradient[j]).sum::<f64>();
        }
        if dot(&direction, &gradient) >= 0.0 {
            inverse = identity(n);
            is_new = true;
            for i in 0..n {
                direction[i] = if free.contains(&i) { -gradient[i] } else { 0.0 };
            }
        }
        let longest = direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        // without knowledge of the curvature the first step has length 1, and none is longer than 2
        let mut length = if is_new { 1.0 / longest.max(1.0) } else { (2.0 / longest).min(1.0) };
        let mut taken = None;
        for _ in 0..HALVINGS {
            let next: Vec<f64> = at
                .iter()
                .zip(&direction)
                .map(|(x, d)| (x + length * d).clamp(-limit, limit))
                .collect();
            let moved: Vec<f64> = next.iter().zip(&at).map(|(a, b)| a - b).collect();
            let (there, slope) = evaluate(&next);
            if there <= value + SHARE * dot(&moved, &gradient) {
                taken = Some((next, moved, there, slope));
                break;
            }
            length *= 0.5;
        }
        let Some((next, moved, there, slope)) = taken else { break };
        let turned: Vec<f64> = slope.iter().zip(&gradient).map(|(a, b)| a - b).collect();
        let curvature = dot(&moved, &turned);
        if curvature > 1e-10 * dot(&turned, &turned) {
            if is_new {
                let scale = curvature / dot(&turned, &turned);
                inverse.iter_mut().flatten().for_each(|entry| *entry *= scale);
                is_new = false;
            }
            update(&mut inverse, &moved, &turned, curvature);
        }
        let gained = value - there;
        (at, value, gradient) = (next, there, slope);
        if gained < 1e-9 * (1.0 + value.abs()) {
            break;
        }
    }
    at
}

fn identity(n: usize) -> Vec<Vec<f64>> {
    (0..n).map(|i| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect()).collect()
}

/// The inverse of the matrix of second derivatives after a step (Nocedal and Wright, equation 6.17).
fn update(inverse: &mut [Vec<f64>], moved: &[f64], turned: &[f64], curvature: f64) {
    let image: Vec<f64> = inverse.iter().map(|row| dot(row, turned)).collect();
    let square = (1.0 + dot(turned, &image) / curvature) / curvature;
    for (i, row) in inverse.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry += square * moved[i] * moved[j]
                - (image[i] * moved[j] + moved[i] * image[j]) / curvature;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley, whose minimum is at (1, 1): within the limits, and at the limit 0.5, where the
    /// least value for x = 0.5 is at y = 0.25. A slope below 1e-4 leaves 1e-3 of the way along the valley,
    /// whose curvature is 0.4.
    #[test]
    fn a_valley_is_followed_up_to_a_limit() {
        let valley = |p: &[f64]| {
            let (x, y) = (p[0], p[1]);
            let value = (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2);
            let slope = vec![-2.0 * (1.0 - x) - 400.0 * x * (y - x * x), 200.0 * (y - x * x)];
            (value, slope)
        };
        let found = minimum(&[-1.2, 1.0], 4.0, 100, valley);
        assert!((found[0] - 1.0).abs() < 1e-3 && (found[1] - 1.0).abs() < 2e-3, "{found:?}");
        let found = minimum(&[-0.4, 0.4], 0.5, 100, valley);
        assert!(found[0] == 0.5 && (found[1] - 0.25).abs() < 1e-5, "{found:?}");
    }

    /// The logarithm is no number below 0: steps there are too far. x - ln x is least at 1.
    #[test]
    fn steps_out_of_the_domain_are_shortened() {
        let found = minimum(&[0.1], 4.0, 50, |p| (p[0] - p[0].ln(), vec![1.0 - 1.0 / p[0]]));
        assert!((found[0] - 1.0).abs() < 1e-4, "{found:?}");
    }
}
