//! What values that are off do to an evidence.

use nalgebra::{DMatrix, DVector};

use super::cases::{candidate, case, normal, observed};
use crate::noise::influence::Influence;
use crate::posterior::{self, Effort};
use crate::setup::Setup;
use gumption_engine::task::Sharing;

/// A line of twelve points y = a + 0.5 x with a known to 0.3 and uncertainties of 0.1.
#[test]
fn gains_are_those_of_normal_densities() {
    let off = |n: usize| [0.0, 1.5, 0.0, 0.0, -1.2, 0.1][n % 6] + 0.05 * (n % 3) as f64;
    let values: Vec<f64> = (0..12).map(|n| 1.0 + 0.5 * n as f64 + off(n)).collect();
    let case = case(
        normal(1.0, 0.3),
        Sharing::All,
        &[("y", "a + 0.5*x")],
        vec![observed(&values, Some(&[0.1; 12]))],
        vec![candidate("offset", "o", normal(0.0, 0.4), &[("y", "y + o")])],
    );
    let setup = Setup::new(&case);
    let none = posterior::singles(&setup, 1, Effort::FULL).remove(0);
    let influence = Influence::of(&setup, &none).unwrap();
    let residuals = DVector::from_fn(12, |n, _| off(n));
    // variances of the values, and of a, which all share; sizes of 10 and 100 uncertainties
    let ln_density = |off: &[(usize, usize)]| {
        let covariance = DMatrix::from_fn(12, 12, |i, j| {
            let size = off.iter().find(|of| of.0 == i).map_or(0.0, |of| [1.0, 10.0][of.1]);
            0.09 + if i == j { 0.01 + size * size } else { 0.0 }
        });
        let root = covariance.cholesky().unwrap();
        -0.5 * residuals.dot(&root.solve(&residuals)) - root.l().diagonal().map(f64::ln).sum()
    };
    let sets: [&[(usize, usize)]; 4] =
        [&[], &[(1, 0)], &[(1, 0), (4, 1)], &[(4, 0), (7, 0), (10, 1)]];
    for off in sets {
        let with = influence.with(off);
        let gain = ln_density(off) - ln_density(&[]);
        // the mode is found to 1e-4 in its cost, 0.014 standard deviations of a: 1 % of a gain
        assert!((with.gain() - gain).abs() < 0.01 * (1.0 + gain.abs()), "{off:?} {gain}");
        for size in [0, 1] {
            let more: Vec<_> = off.iter().copied().chain([(2, size)]).collect();
            let gain = ln_density(&more) - ln_density(off);
            let found = with.more(2)[size];
            assert!(
                (found - gain).abs() < 0.01 * (1.0 + gain.abs()),
                "{off:?} {size}: {found} {gain}"
            );
        }
    }
}
