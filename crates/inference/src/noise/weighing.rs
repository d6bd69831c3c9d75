//! The hypotheses weighed with one noise model, and how the weighings count beside each other.

use std::sync::Arc;

use crate::discrepancy::Discrepancy;
use crate::latent::{AT_BOUND, EDGE, Role};
use crate::logarithm::ln_add;
use crate::noise::noise_model::NoiseModel;
use crate::noise::prior_widths::PriorWidths;
use crate::posterior::{Before, Posterior, WeighedHypothesis};
use crate::setup::Setup;
use gumption_engine::number::elementary;

/// The hypotheses weighed with one noise model.
#[derive(Debug)]
pub struct Weighing<'c> {
    /// How wide the priors of the effects' parameters are.
    pub widths: PriorWidths,
    /// The case with this noise.
    pub setup: Setup<'c>,
    /// The departures that are weighed beside the effects.
    pub discrepancy: Arc<Discrepancy>,
    /// The hypotheses, weighed.
    pub posterior: Posterior,
    /// Prior probability of the noise model, or of priors of other widths.
    pub(crate) prior: f64,
    /// Its posterior probability.
    pub probability: f64,
}

impl<'c> Weighing<'c> {
    /// What another weighing learns from this one.
    pub(crate) fn before(&self) -> Before<'_, 'c> {
        (&self.setup, &self.posterior)
    }

    /// Logarithm of the prior probability times the evidence.
    pub fn ln_weight(&self) -> f64 {
        elementary::ln(self.prior) + self.posterior.ln_evidence
    }

    /// Whether the leading hypothesis has a factor on stated uncertainties at the upper end of the usual
    /// ones.
    pub(crate) fn is_beyond_factors(&self) -> bool {
        let leading = self.posterior.leading();
        let Some(mode) = leading.and_then(|leading| leading.evidence.modes.first()) else {
            return false;
        };
        self.setup.roles.iter().zip(&mode.scores).any(|(role, score)| match role {
            Role::Noise { output, .. } => {
                self.setup.has_factor(*output) && *score > AT_BOUND * EDGE
            }
            _ => false,
        })
    }
}

/// The logarithm of prior probabilities times evidences, summed.
pub(crate) fn ln_total(weighings: &[Weighing<'_>]) -> f64 {
    weighings.iter().map(Weighing::ln_weight).fold(f64::NEG_INFINITY, ln_add)
}

/// An evidence with a larger standard error is that of draws far from the modes, which may stand at
/// the end of what is searched: what they leave is more than those draws do.
const FAR_DRAWS: f64 = 0.5;

/// The logarithm of the weight of a hypothesis with a noise that is not as stated, without what the
/// residuals at its best mode gain by that.
pub(crate) fn ln_weight_at_mode(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> f64 {
    let evidence = &hypothesis.evidence;
    let too_much = match evidence.modes.first() {
        Some(mode) if evidence.standard_error > FAR_DRAWS => {
            (evidence.ln_evidence - mode.ln_evidence()).max(0.0)
        }
        _ => 0.0,
    };
    hypothesis.ln_weight() - too_much + ln_explained_away(setup, hypothesis)
}

/// By how much the logarithm of the prior probability of a hypothesis rises if the noise is another.
fn ln_explained_away(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> f64 {
    let other = NoiseModel::other_than_stated(setup.case.prior);
    let (here, there) = (setup.prior(), other);
    let [here, there] = if hypothesis.effects.is_empty() {
        [here.none, there.none]
    } else {
        [here.one + here.two + here.three, there.one + there.two + there.three]
    };
    if here > 0.0 && there > 0.0 { elementary::ln(there / here) } else { 0.0 }
}

/// The place of the most probable weighing.
pub fn most_probable(weighings: &[Weighing<'_>]) -> usize {
    (0..weighings.len())
        .max_by(|&a, &b| weighings[a].probability.total_cmp(&weighings[b].probability))
        .unwrap_or(0)
}

/// How wide the priors are that are most probable.
pub fn most_probable_widths(weighings: &[Weighing<'_>]) -> PriorWidths {
    weighings[most_probable(weighings)].widths
}
