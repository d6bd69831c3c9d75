//! Sobol points with Owen's nested scrambling (SIAM J. Numer. Anal. 34 (1997) 1884), in 64 bits.
//!
//! Each bit of a coordinate is turned over or not by a hash of the bits before it. Of a net of 2^m points
//! no two agree in more than m bits of a coordinate, so that what follows these is a random number of
//! the point's own. A hash of 64 bits decides about six levels of the tree of bits at once.

use super::directions::DIRECTIONS;
use crate::distribution::stream::mix;

/// Bits of a coordinate that are scrambled in the tree; nets have at most 2^24 points.
const TREE: u32 = 24;

/// Levels of the tree that one hash decides about.
const LEVELS: u32 = 6;

/// A hash of two numbers.
#[inline(always)]
fn hash(a: u64, b: u64) -> u64 {
    mix(mix(a ^ 0x9e37_79b9_7f4a_7c15).wrapping_add(b.wrapping_mul(0xd6e8_feb8_6659_fd93)))
}

/// The direction numbers of a dimension, the highest bit first.
fn directions(dimension: usize) -> [u32; 32] {
    let mut v = [0; 32];
    let Some(&(polynomial, initial)) = dimension.checked_sub(1).and_then(|d| DIRECTIONS.get(d))
    else {
        for (i, v) in v.iter_mut().enumerate() {
            *v = 1 << (31 - i);
        }
        return v;
    };
    let degree = initial.len();
    for i in 0..32 {
        v[i] = if i < degree {
            initial[i] << (31 - i)
        } else {
            let mut next = v[i - degree] ^ (v[i - degree] >> degree);
            for k in 1..degree {
                if polynomial >> (degree - k) & 1 == 1 {
                    next ^= v[i - k];
                }
            }
            next
        };
    }
    v
}

/// One coordinate of a net of Sobol points with Owen's nested scrambling. Dimensions beyond 128 have
/// random numbers.
#[derive(Clone, Debug)]
pub struct NetCoordinate {
    /// `None` beyond the dimensions of the table, where numbers are random.
    directions: Option<[u32; 32]>,
    seed: u64,
}

impl NetCoordinate {
    /// The coordinate of a dimension (from 0) in a randomization.
    pub fn new(dimension: usize, seed: u64) -> Self {
        let known = dimension <= DIRECTIONS.len();
        Self {
            directions: known.then(|| directions(dimension)),
            seed: hash(seed, dimension as u64 + 1),
        }
    }

    /// The coordinate of a point (from 0), in (0, 1).
    pub fn at(&self, point: u32) -> f64 {
        let bits = match &self.directions {
            Some(directions) => self.scrambled(sobol(directions, point)),
            None => hash(self.seed, u64::from(point)),
        };
        ((bits >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
    }

    fn scrambled(&self, x: u32) -> u64 {
        let tree = x >> (32 - TREE);
        let mut turned = 0u32;
        for level in (0..TREE).step_by(LEVELS as usize) {
            let before = tree.checked_shr(TREE - level).unwrap_or(0);
            // the prefix with a one in front tells its length
            let coins = hash(self.seed, u64::from(before | 1 << level));
            // nodes of the subtree in the order of a heap, from 1
            let mut node = 1u32;
            for within in 0..LEVELS {
                let bit = tree >> (TREE - 1 - level - within) & 1;
                let coin = (coins >> node & 1) as u32;
                turned = turned << 1 | (bit ^ coin);
                node = node << 1 | bit;
            }
        }
        let rest = hash(self.seed ^ 0x5851_f42d_4c95_7f2d, u64::from(tree | 1 << TREE));
        u64::from(turned) << (64 - TREE) | rest >> TREE
    }
}

fn sobol(directions: &[u32; 32], point: u32) -> u32 {
    let mut x = 0;
    let mut left = point;
    while left != 0 {
        x ^= directions[left.trailing_zeros() as usize];
        left &= left - 1;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first points that Joe and Kuo's own program prints, which are in the order of Gray's code.
    #[test]
    fn first_points() {
        let at = |dimension: usize| {
            let directions = directions(dimension);
            let gray = (0..8u32).map(|i| i ^ (i >> 1));
            gray.map(|i| f64::from(sobol(&directions, i)) / 4_294_967_296.0).collect::<Vec<_>>()
        };
        assert_eq!(at(0), [0.0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125]);
        assert_eq!(at(1), [0.0, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625]);
        assert_eq!(at(2), [0.0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375]);
    }

    /// Scrambling keeps a net a net: each of 2^m intervals of every coordinate has one point, and of the
    /// first two coordinates each elementary box of volume 2^-m.
    #[test]
    fn scrambled_nets_are_nets() {
        for seed in 0..20 {
            let m = 8;
            for dimension in [0, 1, 5, 60, 127] {
                let coordinate = NetCoordinate::new(dimension, seed);
                let mut hit = vec![0; 1 << m];
                for i in 0..1 << m {
                    hit[(coordinate.at(i) * f64::from(1 << m)) as usize] += 1;
                }
                assert!(hit.iter().all(|&hits| hits == 1), "{seed}, {dimension}");
            }
            let (x, y) = (NetCoordinate::new(0, seed), NetCoordinate::new(1, seed));
            for cut in 0..=m {
                let mut hit = vec![0; 1 << m];
                for i in 0..1 << m {
                    let column = (x.at(i) * f64::from(1 << cut)) as usize;
                    let row = (y.at(i) * f64::from(1 << (m - cut))) as usize;
                    hit[column << (m - cut) | row] += 1;
                }
                assert!(hit.iter().all(|&hits| hits == 1), "{seed}, {cut}");
            }
        }
    }

    /// Over many seeds the first point is uniform: the mean of 4096 is within five of its standard
    /// errors (false failure: one in two millions).
    #[test]
    fn every_point_is_uniform() {
        let n = 4096.0;
        for point in [0, 1, 100] {
            let mean = (0..4096).map(|seed| NetCoordinate::new(3, seed).at(point)).sum::<f64>() / n;
            assert!((mean - 0.5).abs() < 5.0 / (12.0 * n).sqrt(), "{point}: {mean}");
        }
    }
}
