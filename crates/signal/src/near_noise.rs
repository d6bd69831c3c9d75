//! Oscillations that noise alone may have made: their phase is hardly known, and their amplitude is too
//! large on average.

use super::budget::UncertaintySource;
use super::note::{ChannelNote, short};
use super::observation::{ChannelObservation, ToneComponent};
use super::recipe::RecipeSettings;
use gumption_engine::fact;
use gumption_engine::number::elementary;

/// The probability with which noise alone reaches an amplitude that is near it.
const OFTEN: f64 = 0.05;

/// The note on a channel in which none of the components that are asked for stands out of the noise, the
/// first of them told; where one does the others are not there, which is nothing to tell.
pub(super) fn note(settings: &RecipeSettings, of: &ChannelObservation) -> Option<ChannelNote> {
    let by_noise: Vec<f64> = of.components.iter().filter_map(probability).collect();
    if by_noise.len() < of.components.len() || by_noise.iter().any(|by_noise| *by_noise <= OFTEN) {
        return None;
    }
    let (component, by_noise) = of.components.iter().zip(by_noise).next()?;
    let fact = fact!(
        "near-noise",
        name = &settings.channels[of.channel].name,
        frequency = short(component.frequency.value, 6),
        percent = short(100.0 * by_noise, 2),
    );
    Some(ChannelNote { channel: of.channel, fact })
}

/// The probability with which noise alone makes an amplitude as large as that of a component; `None`
/// without noise.
///
/// Cosine and sine part of a component that is not there are normal with the standard uncertainty u of
/// the amplitude: its square over u^2 has a chi-squared distribution with two degrees of freedom, and
/// the amplitude is r u or more with the probability exp(-r^2/2).
fn probability(component: &ToneComponent) -> Option<f64> {
    let amplitude = &component.amplitude;
    let noise =
        amplitude.contributions.iter().find(|(source, _)| *source == UncertaintySource::Noise)?.1;
    let ratio = amplitude.measured.value.abs() / noise;
    Some(elementary::exp(-0.5 * ratio * ratio))
}
