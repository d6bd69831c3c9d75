//! What a fit does not explain and a note names: tones stronger than the ones that the recipe asks
//! for, tones that are most of the residuals, and samples far beyond the rest.

use super::analysed::{Analysed, local, unit_text};
use super::beside::amplitude;
use super::note::{ChannelNote, in_unit, short};
use super::recipe::{Amplitude, RecipeSettings};
use super::spurious::{self, Spurious};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use std::f64::consts::TAU;

/// Turns over the record within which what is left is of the fitted tone itself.
const OF_TONE: f64 = 3.0;

/// Standard deviations above which a multiple is there.
const CLEAR: f64 = 8.0;

/// The share of the residuals' variance that a tone is most of.
const MOST_OF_RESIDUALS: f64 = 0.5;

/// The relative difference within which a frequency is another one in another unit.
const SAME: f64 = 0.01;

/// Samples that are named at most.
const NAMED: usize = 3;

/// Whether the level wanders, and the residuals are not those of a tone that is not fitted.
pub(super) fn level_wanders(of: &Analysed) -> bool {
    let walks = of.residuals.coloured.as_ref().is_some_and(|coloured| coloured.walks);
    walks && !spurious::is_level_still(&of.residuals.first, &of.spurious)
}

/// The notes about a channel.
pub(super) fn notes(settings: &RecipeSettings, of: &Analysed) -> Vec<ChannelNote> {
    let mut notes = Vec::new();
    notes.extend(tone(settings, of));
    notes.extend(samples(settings, of));
    notes
}

/// The strongest of the tones that the recipe asks for: its frequency in hertz, and its amplitude.
fn strongest_asked(settings: &RecipeSettings, of: &Analysed) -> Option<(f64, f64)> {
    let asked = |multiple: u32| multiple == 1 || settings.components.contains(&multiple);
    let tones = of.design.tones.iter().enumerate();
    let tones = tones.filter(|(_, tone)| !tone.beside && asked(tone.multiple));
    tones
        .map(|(place, tone)| (tone.cycles * of.base.rate.value, amplitude(&of.fit, place)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// A tone that is stronger than those that are asked for, or most of what they leave.
fn tone(settings: &RecipeSettings, of: &Analysed) -> Option<ChannelNote> {
    let name = &settings.channels[of.channel].name;
    let unit = unit_text(settings, of);
    let size = |amplitude: f64| {
        let amplitude = in_unit(amplitude, 3, &unit);
        match settings.amplitude {
            Amplitude::Rms => fact!("peak-amplitude", amplitude).into(),
            _ => amplitude,
        }
    };
    let (hertz, asked) = strongest_asked(settings, of)?;
    let rate = of.base.rate.value;
    let other_unit = |found: f64| {
        let other = |times: f64, unit: &str| {
            let is_same = (found * times / hertz - 1.0).abs() < SAME;
            let (number, hertz) = (short(hertz, 6), short(found, 4));
            is_same.then(|| fact!("frequency-in-other-unit", number, unit, hertz))
        };
        other(TAU, "rad/s").or_else(|| other(60.0, "rpm"))
    };
    let note = |fact: Fact| Some(ChannelNote { channel: of.channel, fact });
    // fitted as a multiple, or beside the tones that the recipe names
    let fitted = of.design.tones.iter().enumerate();
    let fitted = fitted.filter(|(_, tone)| {
        tone.beside || tone.multiple != 1 && !settings.components.contains(&tone.multiple)
    });
    let fitted = fitted.map(|(place, tone)| (place, tone, amplitude(&of.fit, place)));
    let fitted = fitted.max_by(|a, b| a.2.total_cmp(&b.2)).filter(|(place, _, found)| {
        let noise = local(&of.residuals, *place)[0].max(1.0) * of.residuals.variance;
        *found > asked && *found > CLEAR * (2.0 * noise / of.design.samples as f64).sqrt()
    });
    let left = left(of);
    if let Some((_, tone, found)) =
        fitted.filter(|fitted| left.is_none_or(|left| left.amplitude <= fitted.2))
    {
        let at = tone.cycles * rate;
        let (size, asked, other_unit) = (size(found), size(asked), other_unit(at));
        let (at, hertz) = (short(at, 6), short(hertz, 6));
        return note(match tone.beside {
            true => fact!("strong-tone.beside", name, size, at, asked, hertz, other_unit),
            false => {
                let multiple = tone.multiple;
                fact!("strong-tone", name, multiple, size, at, asked, hertz, other_unit)
            }
        });
    }
    let left = left?;
    let at = left.cycles * rate;
    if left.amplitude > asked {
        let (size, asked, other_unit) = (size(left.amplitude), size(asked), other_unit(at));
        let (at, hertz) = (short(at, 4), short(hertz, 6));
        return note(fact!("strong-tone.left", name, size, at, asked, hertz, other_unit));
    }
    let residuals = &of.residuals;
    let expected = residuals.known.as_ref().is_some_and(|known| known.factors.is_some());
    let share = left.amplitude * left.amplitude / 2.0 / residuals.variance;
    if !residuals.correlated || expected || share <= MOST_OF_RESIDUALS {
        return None;
    }
    let (size, at) = (size(left.amplitude), short(at, 4));
    let multiple = higher_multiple(settings, of, left);
    note(fact!("tone-in-residuals", name, size, at, multiple))
}

/// The strongest tone that is not fitted, unless it is what a fitted one leaves of itself.
fn left(of: &Analysed) -> Option<Spurious> {
    let count = of.residuals.first.len() as f64;
    let apart = |found: &Spurious| {
        let turns = |cycles: f64| (cycles - found.cycles).abs() * count;
        of.design.tones.iter().all(|tone| turns(tone.cycles) >= OF_TONE)
    };
    of.spurious
        .iter()
        .copied()
        .filter(|found| !found.fitted && apart(found))
        .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
}

/// That a tone is a multiple above those that are fitted.
fn higher_multiple(settings: &RecipeSettings, of: &Analysed, found: Spurious) -> Option<Fact> {
    let count = of.residuals.first.len() as f64;
    let multiple = of.fundamentals.iter().find_map(|fundamental| {
        let multiple = (found.cycles / fundamental.cycles).round();
        let apart = (multiple * fundamental.cycles - found.cycles).abs() * count;
        (multiple > f64::from(settings.harmonics) && apart < 1.5).then_some(multiple)
    });
    multiple.map(|multiple| fact!("higher-multiple", multiple, harmonics = settings.harmonics))
}

/// The few samples that are far beyond the rest.
fn samples(settings: &RecipeSettings, of: &Analysed) -> Option<ChannelNote> {
    let residuals = &of.residuals;
    let (few, deviation) = residuals.farthest.few(&residuals.first, of.resolution)?;
    let name = &settings.channels[of.channel].name;
    let unit = unit_text(settings, of);
    let named = few.iter().take(NAMED).map(|sample| {
        let at = of.base.start + sample.sample as f64 / of.base.rate.value;
        fact!("far-sample", value = in_unit(sample.value, 6, &unit), at = short(at, 8))
    });
    let samples: Vec<Fact> = named.collect();
    let count = few.len() - samples.len();
    let more = (count > 0).then(|| fact!("and-more", count));
    let far = few.first().map_or(0.0, |sample| sample.residual.abs() / deviation);
    let far = short(far, 2);
    let fact = match few.len() {
        1 => fact!("far-samples.one", name, samples, far),
        _ => fact!("far-samples", name, samples, more, far),
    };
    Some(ChannelNote { channel: of.channel, fact })
}
