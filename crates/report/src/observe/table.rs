//! The page for a terminal.

use super::{ObservationReport, sheets};
use crate::number::{exact, significant, with_uncertainty};
use crate::{Grid, WIDTH, wrapped};
use gumption_signal::Amplitude;

/// The observations as a page of text: for each row and frequency the components of every channel, and
/// what is said of the channels as a whole.
pub fn table(observed: &ObservationReport<'_>) -> String {
    let settings = observed.settings;
    let mut page = String::new();
    if let Some(title) = observed.title {
        page += &wrapped(title);
    }
    let root = settings.reference.and_then(|place| settings.channels.get(place));
    let phases = match root {
        Some(channel) => format!("phases and delays against `{}`", channel.name),
        None => "phases at the recording's instant 0".to_owned(),
    };
    let method = match settings.method {
        gumption_signal::Method::SineFit => "sine fit",
        gumption_signal::Method::Fft => "Fourier transform of whole periods",
    };
    page += &wrapped(&format!(
        "{method}, {}, {phases}; u: standard uncertainty",
        amplitude_words(settings.amplitude)
    ));
    for (values, channels) in observed.lines() {
        let conditions = observed.conditions.iter().zip(values);
        let mut at: Vec<String> = conditions
            .map(|(of, value)| {
                let unit = if of.unit.text() == "1" { "" } else { of.unit.text() };
                format!("{} = {} {unit}", of.name, exact(*value)).trim_end().to_owned()
            })
            .collect();
        let hertz = observed.hertz(channels).0;
        at.push(format!("{} = {} Hz", observed.frequency, exact(hertz)));
        page += &format!("\n{}\n\n", at.join(", "));
        page += &Grid::of(&sheets::components(observed, channels)).render(WIDTH);
        page.push('\n');
        page += &Grid::of(&sheets::channels(observed, channels)).render(WIDTH);
        let made_of = sheets::made_of(observed, channels);
        if !made_of.is_empty() {
            page += &wrapped(&format!("u^2 of the amplitudes: {made_of}"));
        }
        for of in channels {
            for finding in &of.findings {
                let name = settings.channels.get(of.channel).map_or("", |c| c.name.as_str());
                let (estimate, u) = (finding.value.value, finding.value.standard_uncertainty);
                let unit = if finding.unit == "1" { "" } else { &finding.unit };
                let said = if u > 0.0 {
                    let (value, u) = with_uncertainty(estimate, u, 2);
                    format!("{value} {unit}, u = {u}")
                } else {
                    format!("{} {unit}", significant(estimate, 6))
                };
                let said = said.replace(" ,", ",");
                page += &wrapped(&format!("`{name}`: {} {}", finding.name, said.trim_end()));
            }
        }
    }
    if !observed.warnings.is_empty() {
        page.push('\n');
        for warning in observed.warnings {
            page += &wrapped(&format!("Note: {}.", warning.text.trim_end_matches('.')));
        }
    }
    page
}

/// What amplitudes are, in words.
fn amplitude_words(amplitude: Amplitude) -> &'static str {
    match amplitude {
        Amplitude::Peak => "peak amplitudes",
        Amplitude::Rms => "RMS amplitudes",
    }
}
