//! Few directions that hold all of many rows: singular vectors.

use gumption_engine::linalg::{Eigen, add_multiple, dot};
use gumption_engine::number::largest_first;
use nalgebra::DMatrix;

/// Products of vectors know what is smaller than this share of the largest square only by their rounding.
const KNOWN: f64 = 1e-9;

/// The singular vectors of vectors of many rows, as few as leave little.
///
/// They are eigenvectors of the products of the vectors with each other, which square their sizes: what is
/// small beside the largest is looked for in what those found before leave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SingularVectors {
    /// Of length 1 and orthogonal to each other, the largest first.
    pub vectors: Vec<Vec<f64>>,
    /// The root mean square over the given vectors of what is along each, in their unit.
    pub sizes: Vec<f64>,
}

impl SingularVectors {
    /// Of vectors of one length, as many as leave at most `left` of them: the root mean square over the
    /// vectors of the norm of the remainder, above 0 and in their unit.
    pub fn of(given: &[Vec<f64>], left: f64) -> Self {
        let mut found = Self::default();
        let mut rest = given.to_vec();
        let count = given.len() as f64;
        let allowed = left * left * count;
        // each pass takes nine orders of the squares; doubles have no more than three times as many
        for _ in 0..4 {
            let products = DMatrix::from_fn(rest.len(), rest.len(), |i, j| {
                if j <= i { dot(&rest[i], &rest[j]) } else { 0.0 }
            });
            let products =
                DMatrix::from_fn(rest.len(), rest.len(), |i, j| products[(i.max(j), i.min(j))]);
            if products.trace() <= allowed {
                break;
            }
            let eigen = Eigen::of(&products);
            let mut pairs: Vec<(f64, &[f64])> = eigen.pairs().collect();
            largest_first(&mut pairs, |pair| pair.0);
            let largest = pairs[0].0;
            let mut remaining = products.trace();
            for (square, weights) in pairs {
                if remaining <= allowed || square <= KNOWN * largest {
                    break;
                }
                remaining -= square;
                found.add(&rest, weights, count);
            }
            rest = given.iter().map(|vector| found.remainder(vector)).collect();
        }
        found
    }

    /// Adds the direction of a sum of vectors.
    fn add(&mut self, of: &[Vec<f64>], weights: &[f64], count: f64) {
        let mut vector = vec![0.0; of[0].len()];
        for (weight, of) in weights.iter().zip(of) {
            add_multiple(&mut vector, *weight, of);
        }
        let size = dot(&vector, &vector).sqrt();
        // a second time, as rounding leaves something along the others
        vector = self.remainder(&self.remainder(&vector));
        let length = dot(&vector, &vector).sqrt();
        if length > 0.0 {
            vector.iter_mut().for_each(|entry| *entry /= length);
            self.vectors.push(vector);
            self.sizes.push(size / count.sqrt());
        }
    }

    /// Leaves out those along which the mean square is not above this.
    pub(crate) fn above(&mut self, square: f64) {
        let count = self.sizes.iter().take_while(|size| *size * *size > square).count();
        self.vectors.truncate(count);
        self.sizes.truncate(count);
    }

    /// How much of a vector is along each.
    pub fn coefficients(&self, vector: &[f64]) -> Vec<f64> {
        self.vectors.iter().map(|direction| dot(direction, vector)).collect()
    }

    /// What of a vector is along none.
    fn remainder(&self, vector: &[f64]) -> Vec<f64> {
        let mut rest = vector.to_vec();
        for direction in &self.vectors {
            let along = dot(direction, &rest);
            add_multiple(&mut rest, -along, direction);
        }
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cosines of n rows with sizes that fall by seven orders: each is found with its size, in the order
    /// of the sizes, and as many as the remainder needs.
    #[test]
    fn sizes_of_orthogonal_functions_are_found() {
        let n = 40;
        let cosine = |k: usize, i: usize| {
            let angle = std::f64::consts::PI * (i as f64 + 0.5) * k as f64 / n as f64;
            angle.cos() * (2.0 / n as f64).sqrt()
        };
        let sizes = [1e6, 3.0, 1.0, 0.1];
        // two given vectors for each function, of both signs: the mean square is half of the square
        let given: Vec<Vec<f64>> = (0..8)
            .map(|v| {
                let (k, sign) = (v / 2, if v % 2 == 0 { 2.0 } else { -2.0 });
                (0..n).map(|i| sign * sizes[k] * cosine(k + 1, i)).collect()
            })
            .collect();
        let found = SingularVectors::of(&given, 0.01);
        assert_eq!(found.vectors.len(), 4);
        for (k, (vector, size)) in found.vectors.iter().zip(&found.sizes).enumerate() {
            // a relative rounding of 1e-16 of the largest in the rest of the others
            assert!((size / sizes[k] - 1.0).abs() < 1e-8, "{k}: {size}");
            let along: f64 = (0..n).map(|i| vector[i] * cosine(k + 1, i)).sum();
            assert!((along.abs() - 1.0).abs() < 1e-12, "{k}: {along}");
        }
        assert_eq!(SingularVectors::of(&given, 0.2).vectors.len(), 3);
        assert_eq!(SingularVectors::of(&[vec![0.0; 5], vec![0.0; 5]], 0.1).vectors.len(), 0);
        assert_eq!(SingularVectors::of(&[], 0.1).vectors.len(), 0);
    }

    /// Vectors that nearly agree: directions stay orthogonal, and what is left is what is allowed.
    #[test]
    fn little_is_left() {
        let entry = |v: usize, i: usize| (0.3 + 1e-3 * v as f64 + 0.1 * i as f64).sin() * 1e3;
        let given: Vec<Vec<f64>> =
            (0..12).map(|v| (0..50).map(|i| entry(v, i)).collect()).collect();
        let found = SingularVectors::of(&given, 1e-6);
        assert_eq!(found.vectors.len(), 2, "a phase has two directions");
        for vector in &given {
            let rest = found.remainder(vector);
            assert!(dot(&rest, &rest).sqrt() < 1e-6);
        }
        assert!(dot(&found.vectors[0], &found.vectors[1]).abs() < 1e-14);
    }
}
