//! Evidences of effects with a threshold, which are sums of exact normal densities: between two
//! conditions of the data the position of a step changes nothing.

use nalgebra::{DMatrix, DVector};

use super::cases::{case, formulas, normal, observed, quantity};
use super::ln_normal;
use crate::integral::evidence::EvidenceEstimate;
use crate::posterior::{Effort, singles};
use crate::setup::Setup;
use crate::{Candidate, Case, Effect};
use gumption_engine::distribution::{Distribution, Rectangular};
use gumption_engine::task::Sharing;

const ROWS: usize = 40;
const U: f64 = 0.05;

/// Values about 1 that rise by `height` from the row `first` on, and fall again by it from `last` on.
fn measured(height: f64, first: usize, last: usize) -> Vec<f64> {
    // some noise of the stated size: the fractional parts of multiples of the golden ratio
    let noise = |n: usize| U * 12f64.sqrt() * ((n as f64 * 0.618_033_988_75).fract() - 0.5);
    let step = |n: usize| if (first..last).contains(&n) { height } else { 0.0 };
    (0..ROWS).map(|n| 1.02 + step(n) + noise(n)).collect()
}

/// A constant with an effect `k` between the thresholds that its formula has; thresholds have
/// rectangular priors.
fn constant(values: &[f64], formula: &str, thresholds: &[(&str, f64, f64)]) -> Case {
    let rectangular = |&(_, lower, upper): &(&str, f64, f64)| -> Distribution {
        Rectangular::new(0.5 * (lower + upper), 0.5 * (upper - lower)).unwrap().into()
    };
    let names = std::iter::once("k").chain(thresholds.iter().map(|(name, ..)| *name));
    let effect = Effect {
        name: "step".to_owned(),
        parameters: names.map(quantity).collect(),
        overrides: formulas(&[("y", formula)]),
    };
    let priors = std::iter::once(normal(0.0, 1.0)).chain(thresholds.iter().map(rectangular));
    let candidate = Candidate {
        effect,
        priors: priors.collect(),
        about: String::new(),
        source: String::new(),
        simulator: None,
    };
    let measured = observed(values, Some(&[U; ROWS]));
    case(normal(1.0, 0.1), Sharing::All, &[("y", "a + 0*x")], vec![measured], vec![candidate])
}

/// The logarithm of the density of the data where the effect acts in the rows `acts`.
fn ln_density(values: &[f64], acts: impl Fn(usize) -> bool) -> f64 {
    let residuals = DVector::from_iterator(ROWS, values.iter().map(|y| y - 1.0));
    let acts: Vec<f64> = (0..ROWS).map(|n| if acts(n) { 1.0 } else { 0.0 }).collect();
    let covariance = DMatrix::from_fn(ROWS, ROWS, |i, j| {
        let noise = if i == j { U * U } else { 0.0 };
        noise + 0.1 * 0.1 + acts[i] * acts[j]
    });
    ln_normal(&residuals, &covariance)
}

/// The logarithm of the mean of exponentials.
fn ln_mean(terms: &[f64]) -> f64 {
    let most = terms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most + (terms.iter().map(|ln| (ln - most).exp()).sum::<f64>() / terms.len() as f64).ln()
}

/// The evidence as the diagnosis begins it, refined until it is known well.
fn evidence(case: &Case, seed: u64) -> EvidenceEstimate {
    let setup = Setup::new(case);
    let likelihood = setup.likelihood(&[0]);
    let single = singles(&setup, seed, Effort::FULL).into_iter().find(|h| h.effects == [0]);
    let mut evidence = single.unwrap().evidence;
    for _ in 0..8 {
        evidence.refine(&likelihood, 4);
    }
    evidence
}

/// Six standard errors; or a tenth, where a weak step may as well lie beyond the last row, a fortieth of
/// the prior in which its height may be anything: of that the draws have few, and of great weight. Seeds
/// are fixed, so that this fails always or never.
fn assert_near(found: &EvidenceEstimate, exact: f64, of: &str) {
    let error = found.standard_error;
    assert!(error < 0.1, "{of}: {error}");
    let off = (found.ln_evidence - exact).abs();
    assert!(off < (6.0 * error).max(0.1), "{of}: {} +- {error}, not {exact}", found.ln_evidence);
}

#[test]
fn evidences_of_steps_are_exact() {
    for (height, first) in [(0.8, 7), (0.8, 22), (-0.5, 31), (0.2, 13), (0.06, 25), (3.0, 39)] {
        let values = measured(height, first, ROWS);
        let formula = "y + k*if(x >= t, 1, 0)";
        // the effect begins in each of the rows 1 to 40 alike
        let case = constant(&values, formula, &[("t", 0.0, ROWS as f64)]);
        let begins: Vec<f64> =
            (1..=ROWS).map(|first| ln_density(&values, |n| n >= first)).collect();
        let exact = ln_mean(&begins);
        for seed in 1..4 {
            assert_near(&evidence(&case, seed), exact, &format!("{height} from {first}"));
        }
    }
}

/// Two thresholds, between which the effect acts: the exact evidence is a sum over the squares of a
/// grid.
#[test]
fn evidences_of_windows_are_exact() {
    for (height, first, last) in [(0.6, 10, 17), (-0.4, 25, 27), (1.5, 3, 30)] {
        let values = measured(height, first, last);
        let formula = "y + k*if(x >= s, if(x < e, 1, 0), 0)";
        let ends = [("s", 0.0, ROWS as f64), ("e", 0.0, ROWS as f64)];
        let case = constant(&values, formula, &ends);
        let windows: Vec<f64> = (1..=ROWS)
            .flat_map(|first| (1..=ROWS).map(move |last| (first, last)))
            .map(|(first, last)| ln_density(&values, |n| (first..last).contains(&n)))
            .collect();
        let exact = ln_mean(&windows);
        for seed in 1..4 {
            assert_near(&evidence(&case, seed), exact, &format!("{height} in {first}..{last}"));
        }
    }
}
