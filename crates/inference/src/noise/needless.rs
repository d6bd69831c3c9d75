//! Values that were taken to be off only because a departure without a name made them look so.
//!
//! Which values are off is looked for beside the hypotheses of the list. Where none of them explains
//! the data, a departure that does may need fewer: those that it does not need are taken out again.

use crate::noise::beside_departure::ln_departure;
use crate::noise::noise_model::Suspect;
use crate::noise::weighing::Weighing;

/// The probability of a departure, with the values that are off, from which on it is asked which of
/// them it needs.
const LEADS: f64 = 0.5;

/// The most probable set of values that are off without those that a departure without a name does
/// not need; `None` where it needs all of them, or where the set is known.
pub(crate) fn without_needless(weighings: &[Weighing<'_>]) -> Option<Vec<Suspect>> {
    let suspects = |weighing: &Weighing<'_>| weighing.setup.data.noise.suspects.clone();
    let own = weighings.iter().filter(|w| !w.setup.data.noise.suspects.is_empty());
    let best = own.max_by(|a, b| a.ln_weight().total_cmp(&b.ln_weight()))?;
    if best.posterior.departs() < LEADS {
        return None;
    }
    let mut needed = suspects(best);
    let mut ln = ln_departure(best, &needed);
    while needed.len() > 1 {
        let without = (0..needed.len()).map(|member| {
            let mut fewer = needed.clone();
            fewer.remove(member);
            (ln_departure(best, &fewer), fewer)
        });
        let Some((other, fewer)) = without.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if other < ln {
            break;
        }
        (ln, needed) = (other, fewer);
    }
    (!weighings.iter().any(|known| suspects(known) == needed)).then_some(needed)
}
