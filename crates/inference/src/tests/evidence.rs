//! Evidences of models that are linear in everything unknown, which are exact normal densities.

use nalgebra::{DMatrix, DVector};

use super::cases::{formulas, line};
use super::ln_normal;
use crate::data::by_rows;
use crate::discrepancy::Discrepancy;
use crate::integral::evidence::EvidenceEstimate;
use crate::noise::noise_model::{Factor, NoiseModel};
use crate::posterior::{Before, Beginnings, Effort, posterior, singles, singles_again};
use crate::setup::Setup;
use crate::{Candidate, Effect};
use gumption_engine::distribution::StreamKey;

/// The exact evidence with effects: mean and covariance of the data before they are seen.
fn exact(effects: &[usize]) -> f64 {
    let case = line();
    let setup = Setup::new(&case);
    let mut residuals = DVector::from_vec(by_rows(&setup.data.nominal_residuals()));
    let u = [0.1f64, 0.1, 0.12, 0.1, 0.2, 0.1];
    let x = |value: usize| (value / 2) as f64;
    let mut columns: Vec<Vec<f64>> =
        vec![(0..12usize).map(|v| 0.3 * if v.is_multiple_of(2) { 1.0 } else { x(v) }).collect()];
    if effects.contains(&0) {
        columns.push((0..12usize).map(|v| if v.is_multiple_of(2) { 0.4 } else { 0.0 }).collect());
    }
    if effects.contains(&1) {
        let sign = |v: usize| if v.is_multiple_of(2) { 1.0 } else { -1.0 };
        columns.push((0..12).map(|v| 0.3 * sign(v) * x(v)).collect());
        // the prior mean of the slope is 0.1
        for v in 0..12 {
            residuals[v] -= 0.1 * sign(v) * x(v);
        }
    }
    let covariance = DMatrix::from_fn(12, 12, |i, j| {
        let noise = if i == j { u[i / 2] * u[i / 2] } else { 0.0 };
        noise + columns.iter().map(|column| column[i] * column[j]).sum::<f64>()
    });
    ln_normal(&residuals, &covariance)
}

#[test]
fn linear_evidences_are_exact() {
    let case = line();
    let setup = Setup::new(&case);
    for effects in [vec![], vec![0], vec![1], vec![0, 1]] {
        let likelihood = setup.likelihood(&effects);
        let mut evidence = EvidenceEstimate::begin(&likelihood, StreamKey::new(5, "test"), &[], 8);
        for _ in 0..6 {
            evidence.refine(&likelihood, 4);
        }
        let exact = exact(&effects);
        // five standard errors; the seed is fixed, so that this fails always or never
        assert!(evidence.standard_error < 0.02, "{}", evidence.standard_error);
        assert!(
            (evidence.ln_evidence - exact).abs() < 5.0 * evidence.standard_error,
            "{effects:?}: {} +- {}, exact {exact}",
            evidence.ln_evidence,
            evidence.standard_error
        );
    }
}

/// The evidence of an effect of known size is the density of the data about what it predicts.
#[test]
fn evidences_of_effects_of_known_size_are_exact() {
    let mut case = line();
    let offset = |name: &str, size: &str| {
        let formula = format!("y + {size}");
        let overrides = formulas(&[("y", &formula)]);
        let effect = Effect { name: name.to_owned(), parameters: Vec::new(), overrides };
        Candidate {
            effect,
            priors: Vec::new(),
            about: String::new(),
            source: String::new(),
            simulator: None,
        }
    };
    case.candidates.extend([offset("small", "0.1"), offset("large", "0.3")]);
    let setup = Setup::new(&case);
    let residuals = by_rows(&setup.data.nominal_residuals());
    for (number, size) in [(2, 0.1), (3, 0.3)] {
        let likelihood = setup.likelihood(&[number]);
        let mut evidence = EvidenceEstimate::begin(&likelihood, StreamKey::new(5, "test"), &[], 8);
        for _ in 0..6 {
            evidence.refine(&likelihood, 4);
        }
        let u = [0.1f64, 0.1, 0.12, 0.1, 0.2, 0.1];
        let of_y = |v: usize| v.is_multiple_of(2);
        let shifted =
            residuals.iter().enumerate().map(|(v, r)| if of_y(v) { r - size } else { *r });
        // the input `a` = 1 +- 0.3 acts on y as 1 and on z as x
        let slope = |v: usize| 0.3 * if of_y(v) { 1.0 } else { (v / 2) as f64 };
        let covariance = DMatrix::from_fn(12, 12, |i, j| {
            let noise = if i == j { u[i / 2] * u[i / 2] } else { 0.0 };
            noise + slope(i) * slope(j)
        });
        let exact = ln_normal(&DVector::from_iterator(12, shifted), &covariance);
        // five standard errors; the seed is fixed, so that this fails always or never
        assert!(evidence.standard_error < 0.02, "{}", evidence.standard_error);
        assert!(
            (evidence.ln_evidence - exact).abs() < 5.0 * evidence.standard_error + 1e-9,
            "{size}: {} +- {}, exact {exact}",
            evidence.ln_evidence,
            evidence.standard_error
        );
    }
}

/// Chains and what is drawn after them do not change the evidence.
#[test]
fn roaming_leaves_the_evidence_as_it_is() {
    let case = line();
    let setup = Setup::new(&case);
    let likelihood = setup.likelihood(&[0, 1]);
    let mut evidence = EvidenceEstimate::begin(&likelihood, StreamKey::new(6, "test"), &[], 8);
    evidence.sample_chains(&likelihood, 120);
    let exact = exact(&[0, 1]);
    assert!((evidence.ln_evidence - exact).abs() < 5.0 * evidence.standard_error + 1e-3);
    assert!(evidence.effective_sample_size > 200.0);
}

/// The probabilities are priors times evidences, and sum to one.
#[test]
fn probabilities_follow_from_exact_evidences() {
    let case = line();
    let setup = Setup::new(&case);
    let discrepancy = Discrepancy::new(&setup);
    let found = posterior(
        &setup,
        Beginnings { singles: singles(&setup, 1, Effort::FULL), pairs: case.pairs(), before: None },
        &discrepancy,
        1,
        Effort::FULL,
        f64::NEG_INFINITY,
        &|_| {},
    );
    let sum: f64 = found.hypotheses.iter().map(|h| h.probability).sum::<f64>() + found.probability;
    assert!((sum - 1.0).abs() < 1e-12);
    // relative to "none", whose prior is 0.15, one effect has 0.55/2 and the pair 0.15
    let weight = |effects: &[usize]| {
        let prior = match effects.len() {
            0 | 2 => 0.15,
            _ => 0.275,
        };
        prior * exact(effects).exp()
    };
    let none = found.hypotheses.iter().find(|h| h.effects.is_empty()).unwrap().probability;
    for hypothesis in &found.hypotheses {
        let ratio = hypothesis.probability / none;
        let wanted = weight(&hypothesis.effects) / weight(&[]);
        // five standard errors of two evidences, of 0.007 at most each
        assert!((ratio / wanted).ln().abs() < 0.05, "{:?} {ratio} {wanted}", hypothesis.effects);
    }
}

/// What is hopeless is not explored anew with another noise: its evidence is that about the modes that
/// it had before.
#[test]
fn hopeless_evidences_are_those_about_known_modes() {
    let case = line();
    let setup = Setup::new(&case);
    let weighed = |setup: &Setup<'_>, before: Option<Before<'_, '_>>, rivals: f64| {
        let singles = singles_again(setup, before, rivals, 1, Effort::FULL);
        let beginnings = Beginnings { singles, pairs: case.pairs(), before };
        let discrepancy = Discrepancy::new(setup);
        posterior(setup, beginnings, &discrepancy, 1, Effort::FULL, rivals, &|_| {})
    };
    let stated = weighed(&setup, None, f64::NEG_INFINITY);
    for noise in [
        NoiseModel { factor: Some(Factor::Usual), ..NoiseModel::default() },
        NoiseModel { serial: Some(0.6), ..NoiseModel::default() },
    ] {
        let other = setup.with_noise(noise.clone());
        let anew = weighed(&other, None, f64::NEG_INFINITY);
        // beside a rival that is this much more probable everything is hopeless
        let again = weighed(&other, Some((&setup, &stated)), 1000.0);
        for (anew, again) in anew.hypotheses.iter().zip(&again.hypotheses) {
            assert_eq!(anew.effects, again.effects);
            let few = again.evidence.columns.len();
            assert!(anew.effects.is_empty() || few == 2, "{:?}: {few}", anew.effects);
            let [anew, again] = [&anew.evidence, &again.evidence];
            // five standard errors, of 0.12 at most; the seed is fixed, so that this fails always or
            // never
            let error = anew.standard_error.hypot(again.standard_error);
            assert!(error < 0.12, "{noise:?} {error}");
            let apart = anew.ln_evidence - again.ln_evidence;
            assert!(apart.abs() < 5.0 * error + 1e-9, "{noise:?}: {apart} +- {error}");
        }
    }
}
