//! The page for a terminal.

use super::{ObservationReport, sheets};
use crate::number::{exact, significant, with_uncertainty};
use crate::printed::on_terminal;
use crate::{Grid, table::width, wrapped};
use gumption_files::RecipeCondition;
use gumption_signal::{Amplitude, ChannelObservation};

/// The observations as a page of text: for each row and frequency the components of every channel, and
/// what is said of the channels as a whole.
pub fn table(observed: &ObservationReport<'_>) -> String {
    on_terminal(|| {
        let mut page = String::new();
        if let Some(title) = observed.title {
            page += &wrapped(title);
        }
        page += &wrapped(&method(observed));
        for (values, channels) in observed.lines() {
            page += &format!("\n{}\n\n", at(observed, values, channels));
            page += &Grid::of(&sheets::components(observed, channels)).render(width());
            page.push('\n');
            page += &Grid::of(&sheets::channels(observed, channels)).render(width());
            let made_of = sheets::made_of(observed, channels);
            if !made_of.is_empty() {
                page += &wrapped(&format!("u^2 of the amplitudes: {made_of}"));
            }
            page +=
                &findings(observed, channels).iter().map(|said| wrapped(said)).collect::<String>();
        }
        if !observed.warnings.is_empty() {
            page.push('\n');
            for said in crate::words::lines(observed.warnings) {
                page += &wrapped(&format!("Note: {said}."));
            }
        }
        page
    })
}

/// How the figures were found, and what they are.
pub(super) fn method(observed: &ObservationReport<'_>) -> String {
    let settings = observed.settings;
    let root = settings.reference.and_then(|place| settings.channels.get(place));
    let phases = match root {
        Some(channel) => format!("phases and delays against `{}`", channel.name),
        None => "phases at the recording's instant 0".to_owned(),
    };
    let method = match settings.method {
        gumption_signal::Method::SineFit => "sine fit",
        gumption_signal::Method::Fft => "Fourier transform of whole periods",
    };
    let amplitudes = amplitude_words(settings.amplitude);
    format!("{method}, {amplitudes}, {phases}; u: standard uncertainty")
}

/// Conditions and frequency of a line.
pub(super) fn at(
    observed: &ObservationReport<'_>,
    values: &[f64],
    channels: &[ChannelObservation],
) -> String {
    let mut at = with_units(observed.conditions, values);
    at.push(format!("{} = {} Hz", observed.frequency, exact(observed.hertz(channels).0)));
    at.join(", ")
}

/// Conditions with their values, each as `angle = 34 deg`.
pub(crate) fn with_units(conditions: &[RecipeCondition], values: &[f64]) -> Vec<String> {
    let said = conditions.iter().zip(values).map(|(of, value)| {
        let unit = if of.unit.text() == "1" { "" } else { of.unit.text() };
        format!("{} = {} {unit}", of.name, exact(*value)).trim_end().to_owned()
    });
    said.collect()
}

/// What else was found in the channels.
pub(super) fn findings(
    observed: &ObservationReport<'_>,
    channels: &[ChannelObservation],
) -> Vec<String> {
    let mut said = Vec::new();
    for of in channels {
        let channel = observed.settings.channels.get(of.channel);
        let name = channel.map_or("", |channel| channel.name.as_str());
        for finding in &of.findings {
            let unit = if finding.unit == "1" { "" } else { &finding.unit };
            let value = match finding.uncertainty {
                Some((u, _)) if u > 0.0 => {
                    let (value, u) = with_uncertainty(finding.value, u, 2);
                    format!("{value} {unit}, u = {u}")
                }
                _ => format!("{} {unit}", significant(finding.value, 6)),
            };
            let value = value.replace(" ,", ",");
            said.push(format!("`{name}`: {} {}", finding.name, value.trim_end()));
        }
    }
    said
}

/// What amplitudes are, in words.
fn amplitude_words(amplitude: Amplitude) -> &'static str {
    match amplitude {
        Amplitude::Peak => "peak amplitudes",
        Amplitude::Rms => "RMS amplitudes",
    }
}
