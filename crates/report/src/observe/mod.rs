//! What was found in recordings, as a page of text, JSON and CSV.

mod csv;
mod document;
mod figures;
mod json;
mod sheets;
mod table;

pub use self::csv::csv;
pub(crate) use self::csv::heading;
pub use json::json;
pub(crate) use sheets::shares;
pub use table::table;
pub(crate) use table::with_units;

/// The observations in GitHub Flavored Markdown.
pub fn markdown(observed: &ObservationReport<'_>) -> String {
    look::markdown(|| document::of(observed))
}

/// The observations as one HTML file that needs nothing else.
pub fn html(observed: &ObservationReport<'_>) -> String {
    look::html(|| document::of(observed))
}

use super::{Provenance, document as look};
use gumption_engine::task::Warning;
use gumption_files::RecipeCondition;
use gumption_signal::{
    Amplitude, BudgetedValue, ChannelObservation, Observation, RecipeSettings, RecordTrace,
};

/// Observations with what a report says about them.
#[derive(Clone, Debug)]
pub struct ObservationReport<'a> {
    /// The title, if the recipe has one.
    pub title: Option<&'a str>,
    /// What is the same for all rows.
    pub settings: &'a RecipeSettings,
    /// The conditions.
    pub conditions: &'a [RecipeCondition],
    /// The name of the column of frequencies.
    pub frequency: &'a str,
    /// The rows: values of the conditions, and what was found.
    pub rows: &'a [(Vec<f64>, Observation)],
    /// For each row what figures show of its records, by channel; none at all where there are no
    /// figures.
    pub traces: &'a [Vec<RecordTrace>],
    /// Warnings and notes.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

/// A column of the answer: one figure of a channel.
pub(super) struct FigureColumn {
    /// Its name: `a_x_amplitude`, `a_x_amplitude_rms` where amplitudes are that, `a_x_phase_2`.
    pub(super) name: String,
    pub(super) unit: String,
    /// Value and standard uncertainty in each row; without the latter where none is known.
    pub(super) values: Vec<(f64, Option<f64>)>,
}

impl ObservationReport<'_> {
    /// One line for each row and frequency: the conditions, the frequency and the channels.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&[f64], &[ChannelObservation])> {
        self.rows.iter().flat_map(|(conditions, observation)| {
            observation.frequencies.iter().map(|channels| (&conditions[..], &channels[..]))
        })
    }

    /// The frequency of a line: that of the reference, or of the first channel.
    pub(super) fn hertz(&self, channels: &[ChannelObservation]) -> (f64, f64) {
        let of = |wanted: usize| channels.iter().find(|of| of.channel == wanted);
        let root = self.settings.reference.and_then(of).or_else(|| channels.first());
        let measured = root.map(|of| of.frequency);
        measured.map_or((f64::NAN, 0.0), |of| (of.value, of.standard_uncertainty))
    }

    /// All figures that every line has.
    pub(super) fn figures(&self) -> Vec<FigureColumn> {
        let mut figures = Vec::new();
        for (place, channel) in self.settings.channels.iter().enumerate() {
            let unit = channel.unit.text();
            let mut add = |name: String, unit: &str, of: &Take<'_>| {
                let values: Option<Vec<(f64, Option<f64>)>> = self
                    .lines()
                    .map(|(_, channels)| of(channels.iter().find(|c| c.channel == place)?))
                    .collect();
                let finite =
                    |values: &Vec<(f64, Option<f64>)>| values.iter().all(|(v, _)| v.is_finite());
                if let Some(values) = values.filter(finite) {
                    let name = format!("{}_{name}", channel.name);
                    figures.push(FigureColumn { name, unit: unit.to_owned(), values });
                }
            };
            let pair =
                |of: &BudgetedValue| (of.measured.value, Some(of.measured.standard_uncertainty));
            for (number, multiple) in self.settings.components.iter().enumerate() {
                let suffix = if *multiple == 1 { String::new() } else { format!("_{multiple}") };
                let phase = self.settings.phase.name();
                let amplitude = match self.settings.amplitude {
                    Amplitude::Peak => "amplitude",
                    Amplitude::Rms => "amplitude_rms",
                };
                add(format!("{amplitude}{suffix}"), unit, &|of| {
                    Some(pair(&of.components.get(number)?.amplitude))
                });
                // against itself the reference has none
                if *multiple == 1 && self.settings.reference == Some(place) {
                    continue;
                }
                add(format!("phase{suffix}"), phase, &|of| {
                    Some(pair(&of.components.get(number)?.phase))
                });
                add(format!("delay{suffix}"), "s", &|of| {
                    of.components.get(number)?.delay.as_ref().map(pair)
                });
            }
            add("offset".into(), unit, &|of| Some(pair(&of.offset)));
            add("thd".into(), "1", &|of| of.distortion.as_ref().map(pair));
            add("snr".into(), "dB", &|of| Some(pair(&of.signal_to_noise)));
            add("sinad".into(), "dB", &|of| Some(pair(&of.sinad)));
            add("periods".into(), "1", &|of| {
                Some((of.periods.value, Some(of.periods.standard_uncertainty)))
            });
            // what steps found, as far as all lines have it
            let found = self.lines().next().and_then(|(_, channels)| {
                Some(&channels.iter().find(|of| of.channel == place)?.findings)
            });
            for finding in found.into_iter().flatten() {
                let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
                add(finding.name.chars().map(plain).collect(), &finding.unit, &|of| {
                    let same = of.findings.iter().find(|other| other.name == finding.name)?;
                    Some((same.value, same.uncertainty.map(|(u, _)| u)))
                });
            }
        }
        figures
    }
}

type Take<'t> = dyn Fn(&ChannelObservation) -> Option<(f64, Option<f64>)> + 't;
