//! What a fit does not explain and a note names: tones stronger than the ones that the recipe asks
//! for, tones that are most of the residuals, and samples far beyond the rest.

use super::analysed::{Analysed, local, unit_text};
use super::beside::amplitude;
use super::note::{Note, short};
use super::recipe::{Amplitude, RecipeSettings};
use super::spurious::{self, Spurious};
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
pub(super) fn notes(settings: &RecipeSettings, of: &Analysed) -> Vec<Note> {
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
fn tone(settings: &RecipeSettings, of: &Analysed) -> Option<Note> {
    let name = &settings.channels[of.channel].name;
    let unit = unit_text(settings, of);
    let peak = if settings.amplitude == Amplitude::Rms { " (peak)" } else { "" };
    let size = |amplitude: f64| format!("{}{unit}{peak}", short(amplitude, 3));
    let (hertz, asked) = strongest_asked(settings, of)?;
    let rate = of.base.rate.value;
    let question = |found: f64| {
        let other = |times: f64, words: &str| {
            let is_same = (found * times / hertz - 1.0).abs() < SAME;
            is_same.then(|| format!(" ({} {words} is {} Hz)", short(hertz, 6), short(found, 4)))
        };
        let other = other(TAU, "rad/s").or_else(|| other(60.0, "rpm")).unwrap_or_default();
        format!(
            "more than the {} at {} Hz; look at the frequency and the sampling rate{other}",
            size(asked),
            short(hertz, 6)
        )
    };
    let note = |text: String| Some(("strong-tone", of.channel, format!("`{name}`: {text}")));
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
        let what = if tone.beside {
            "a tone that the recipe does not name".to_owned()
        } else {
            format!(
                "the multiple {} of a frequency, which `components` does not name,",
                tone.multiple
            )
        };
        return note(format!(
            "{what} has an amplitude of {} at {} Hz, {}",
            size(found),
            short(at, 6),
            question(at)
        ));
    }
    let left = left?;
    let at = left.cycles * rate;
    if left.amplitude > asked {
        return note(format!(
            "a tone of {} at about {} Hz is in the residuals, {}",
            size(left.amplitude),
            short(at, 4),
            question(at)
        ));
    }
    let residuals = &of.residuals;
    let expected = residuals.known.as_ref().is_some_and(|known| known.factors.is_some());
    let share = left.amplitude * left.amplitude / 2.0 / residuals.variance;
    (residuals.correlated && !expected && share > MOST_OF_RESIDUALS).then(|| {
        let text = format!(
            "`{name}`: most of the residuals is a tone of {} at about {} Hz, which is not fitted and \
             counts as noise{}",
            size(left.amplitude),
            short(at, 4),
            of_higher_multiple(settings, of, left)
        );
        ("tone-in-residuals", of.channel, text)
    })
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
fn of_higher_multiple(settings: &RecipeSettings, of: &Analysed, found: Spurious) -> String {
    let count = of.residuals.first.len() as f64;
    let multiple = of.fundamentals.iter().find_map(|fundamental| {
        let multiple = (found.cycles / fundamental.cycles).round();
        let apart = (multiple * fundamental.cycles - found.cycles).abs() * count;
        (multiple > f64::from(settings.harmonics) && apart < 1.5).then_some(multiple)
    });
    multiple.map_or(String::new(), |multiple| {
        format!(
            ": the multiple {multiple} of the frequency, and `harmonics` is {}",
            settings.harmonics
        )
    })
}

/// The few samples that are far beyond the rest.
fn samples(settings: &RecipeSettings, of: &Analysed) -> Option<Note> {
    let residuals = &of.residuals;
    let (few, deviation) = residuals.farthest.few(&residuals.first, of.resolution)?;
    let name = &settings.channels[of.channel].name;
    let unit = unit_text(settings, of);
    let each = few.iter().take(NAMED).map(|sample| {
        let at = of.base.start + sample.sample as f64 / of.base.rate.value;
        format!("{}{unit} at {} s", short(sample.value, 6), short(at, 8))
    });
    let each = each.collect::<Vec<_>>().join(", ");
    let more = match few.len() - few.len().min(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let far = few.first().map_or(0.0, |sample| sample.residual.abs() / deviation);
    let text = format!(
        "`{name}`: {each}{more} {} far beyond the rest, up to {} robust standard deviations of the \
         residuals from the fit; if that is a spike or a number for a missing value, mend the \
         recording or leave that part out with `from` and `to`, as it counts like every other sample",
        if few.len() == 1 { "is" } else { "are" },
        short(far, 2)
    );
    Some(("far-samples", of.channel, text))
}
