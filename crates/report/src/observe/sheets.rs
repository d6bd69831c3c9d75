//! The tables of observations.

use super::ObservationReport;
use crate::number::{exact, rounded, significant, with_uncertainty};
use crate::sheet::{Figure, Sheet};
use gumption_engine::number::largest_first;
use gumption_signal::{BudgetedValue, ChannelObservation, Measured, ToneComponent};

/// Significant digits of standard uncertainties.
const DIGITS: u32 = 2;

/// Components with their amplitude, phase and delay.
pub(super) fn components(
    observed: &ObservationReport<'_>,
    channels: &[ChannelObservation],
) -> Sheet {
    let rows: Vec<(&ChannelObservation, &ToneComponent)> =
        channels.iter().flat_map(|of| of.components.iter().map(move |c| (of, c))).collect();
    let channel = |of: &ChannelObservation| observed.settings.channels.get(of.channel);
    let mut sheet = Sheet::default();
    sheet.text(
        "channel",
        rows.iter().map(|(of, _)| channel(of).map_or(String::new(), |c| c.name.clone())),
    );
    pair(&mut sheet, ["frequency\n(Hz)", "u"], rows.iter().map(|(_, c)| Some(c.frequency)));
    pair(&mut sheet, ["amplitude", "u"], rows.iter().map(|(_, c)| Some(c.amplitude.measured)));
    sheet.units(
        "unit",
        rows.iter().map(|(of, _)| channel(of).map_or(String::new(), |c| c.unit.text().to_owned())),
    );
    let phase = format!("phase\n({})", observed.settings.phase.name());
    pair(&mut sheet, [&phase, "u"], rows.iter().map(|(_, c)| Some(c.phase.measured)));
    if rows.iter().any(|(_, c)| c.delay.is_some()) {
        let delays = rows.iter().map(|(_, c)| c.delay.as_ref().map(|delay| delay.measured));
        pair(&mut sheet, ["delay\n(s)", "u"], delays);
    }
    sheet
}

/// What is said of a channel as a whole.
pub(super) fn channels(observed: &ObservationReport<'_>, channels: &[ChannelObservation]) -> Sheet {
    let mut sheet = Sheet::default();
    let name = |of: &ChannelObservation| {
        observed.settings.channels.get(of.channel).map_or(String::new(), |c| c.name.clone())
    };
    let all = channels.iter();
    sheet.text("channel", all.clone().map(name));
    pair(&mut sheet, ["offset", "u"], all.clone().map(|of| Some(of.offset.measured)));
    // harmonics above the fundamental are those of a channel that is meant at another frequency
    let is_of_fundamental = |of: &ChannelObservation| {
        of.distortion.as_ref().is_none_or(|share| share.measured.value <= 1.0)
    };
    let distortion = |of: &ChannelObservation| {
        let share = of.distortion.as_ref().filter(|_| is_of_fundamental(of));
        share.map(|value| value.clone().times(100.0).measured)
    };
    let noise = |of: &ChannelObservation| {
        Some(of.signal_to_noise.measured).filter(|_| is_of_fundamental(of))
    };
    pair(&mut sheet, ["THD\n(%)", "u"], all.clone().map(distortion));
    pair(&mut sheet, ["SNR\n(dB)", "u"], all.clone().map(noise));
    let periods =
        |of: &ChannelObservation| Figure::of(of.periods.value, significant(of.periods.value, 5));
    sheet.figures("periods", all.clone().map(periods));
    let rate = |of: &ChannelObservation| Figure::of(of.rate.value, significant(of.rate.value, 7));
    sheet.figures("rate\n(Hz)", all.map(rate));
    sheet
}

/// A value and its standard uncertainty, rounded to match; without its column if there is none.
fn pair(sheet: &mut Sheet, headers: [&str; 2], of: impl Iterator<Item = Option<Measured>>) {
    let (values, uncertainties): (Vec<Figure>, Vec<Figure>) = of
        .map(|measured| {
            let Some(of) = measured.filter(|of| of.value.is_finite()) else {
                return (Figure::missing(), Figure::missing());
            };
            if of.standard_uncertainty == 0.0 {
                return (Figure::of(of.value, exact(of.value)), Figure::missing());
            }
            let (value, u) = with_uncertainty(of.value, of.standard_uncertainty, DIGITS);
            (Figure::of(of.value, value), Figure::of(of.standard_uncertainty, u))
        })
        .unzip();
    sheet.figures(headers[0], values);
    if uncertainties.iter().any(|figure| *figure != Figure::missing()) {
        sheet.figures(headers[1], uncertainties);
    }
}

/// Of every channel what the standard uncertainty of its largest amplitude is made of.
pub(super) fn made_of(observed: &ObservationReport<'_>, channels: &[ChannelObservation]) -> String {
    let of_channel = |of: &ChannelObservation| {
        let name = &observed.settings.channels.get(of.channel)?.name;
        let size = |c: &ToneComponent| c.amplitude.measured.value;
        let largest = of.components.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let sources = sources(&largest.amplitude);
        (!sources.is_empty()).then(|| format!("{name} {sources}"))
    };
    let parts: Vec<String> = channels.iter().filter_map(of_channel).collect();
    parts.join("; ")
}

/// The sources of an uncertainty with a share of a percent and more, the largest first.
fn sources(of: &BudgetedValue) -> String {
    shares(of.contributions.iter().map(|(source, u)| (source.name(), *u)))
}

/// Contributions to a standard uncertainty with a share of a percent and more of its square, the largest first.
pub(crate) fn shares<'n>(contributions: impl Iterator<Item = (&'n str, f64)> + Clone) -> String {
    let total: f64 = contributions.clone().map(|(_, u)| u * u).sum();
    let mut shares: Vec<(&str, f64)> = contributions
        .map(|(name, u)| (name, 100.0 * u * u / total))
        .filter(|(_, share)| *share >= 1.0)
        .collect();
    largest_first(&mut shares, |a| a.1);
    let words: Vec<String> =
        shares.iter().map(|(name, share)| format!("{name} {} %", rounded(*share, 0))).collect();
    words.join(", ")
}
