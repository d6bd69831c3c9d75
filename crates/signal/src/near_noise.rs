//! Oscillations that noise alone may have made: their phase is hardly known, and their amplitude is too
//! large on average.

use super::budget::UncertaintySource;
use super::observation::ChannelObservation;
use super::recipe::RecipeSettings;
use super::run::{Note, short};
use gumption_engine::number::elementary;

/// The probability with which noise alone reaches an amplitude that is near it.
const OFTEN: f64 = 0.05;

/// The note on a channel whose oscillation of the frequency itself is near the noise; that a multiple is
/// not there is nothing to tell.
///
/// Cosine and sine part of a component that is not there are normal with the standard uncertainty u of
/// the amplitude: its square over u^2 has a chi-squared distribution with two degrees of freedom, and
/// the amplitude is r u or more with the probability exp(-r^2/2).
pub(super) fn note(settings: &RecipeSettings, of: &ChannelObservation) -> Option<Note> {
    let component = of.components.iter().find(|component| component.multiple == 1)?;
    let amplitude = &component.amplitude;
    let noise = amplitude.contributions.iter().find(|(of, _)| *of == UncertaintySource::Noise)?.1;
    let ratio = amplitude.measured.value.abs() / noise;
    let probability = elementary::exp(-0.5 * ratio * ratio);
    if probability.is_nan() || probability <= OFTEN {
        return None;
    }
    let text = format!(
        "`{}`: noise alone makes an amplitude as large as that at {} Hz in {} % of all records; the phase \
         there is hardly known, and the amplitude is too large on average",
        settings.channels[of.channel].name,
        short(component.frequency.value, 6),
        short(100.0 * probability, 2)
    );
    Some(("near-noise", of.channel, text))
}
