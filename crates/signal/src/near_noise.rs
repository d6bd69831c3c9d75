//! Components that noise alone may have made: their phase is hardly known, and their amplitude is too
//! large on average.

use super::budget::UncertaintySource;
use super::observation::{ChannelObservation, ToneComponent};
use super::recipe::RecipeSettings;
use super::run::{Note, short};
use gumption_engine::number::elementary;

/// The probability with which noise alone reaches an amplitude that is near it.
const OFTEN: f64 = 0.05;

/// The note on a channel with components near the noise at one frequency.
///
/// Cosine and sine part of a component that is not there are normal with the standard uncertainty u of
/// the amplitude: its square over u^2 has a chi-squared distribution with two degrees of freedom, and
/// the amplitude is r u or more with the probability exp(-r^2/2).
pub(super) fn note(settings: &RecipeSettings, of: &ChannelObservation) -> Option<Note> {
    let near: Vec<String> = of.components.iter().filter_map(described).collect();
    if near.is_empty() {
        return None;
    }
    let text = format!(
        "`{}`: noise alone makes amplitudes as large as {}; the phase there is hardly known, and the \
         amplitude is too large on average",
        settings.channels[of.channel].name,
        near.join(", ")
    );
    Some(("near-noise", of.channel, text))
}

/// A component near the noise in words.
fn described(component: &ToneComponent) -> Option<String> {
    let amplitude = &component.amplitude;
    let noise = amplitude.contributions.iter().find(|(of, _)| *of == UncertaintySource::Noise)?.1;
    let ratio = amplitude.measured.value.abs() / noise;
    let probability = elementary::exp(-0.5 * ratio * ratio);
    (probability > OFTEN).then(|| {
        let hertz = short(component.frequency.value, 6);
        format!("that at {hertz} Hz in {} % of all records", short(100.0 * probability, 2))
    })
}
