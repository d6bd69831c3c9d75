//! Corrected records, as a page of text, JSON and CSV.

mod document;
mod figure;
mod values;

pub use values::{csv, json};

use super::{Provenance, document as look};
use gumption_engine::task::Warning;
use gumption_files::RecipeCondition;
use gumption_signal::{QuantityFound, RecipeSettings, Waveform, WaveformChannel, WaveformQuantity};

/// The coverage factor of a normal distribution for 95 %.
const FACTOR: f64 = 1.959_963_984_540_054;

/// Corrected records with what a report says about them.
#[derive(Clone, Debug)]
pub struct WaveformReport<'a> {
    /// The title, if the recipe has one.
    pub title: Option<&'a str>,
    /// What is the same for all rows.
    pub settings: &'a RecipeSettings,
    /// The channels whose waveforms these are.
    pub channels: &'a [WaveformChannel],
    /// The conditions.
    pub conditions: &'a [RecipeCondition],
    /// The rows: values of the conditions, and the waveform of each channel.
    pub rows: &'a [(Vec<f64>, Vec<Waveform>)],
    /// Warnings and notes.
    pub warnings: &'a [Warning],
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

/// A page of text.
pub fn table(found: &WaveformReport<'_>) -> String {
    look::text(|| document::of(found, true))
}

/// GitHub Flavored Markdown.
pub fn markdown(found: &WaveformReport<'_>) -> String {
    look::markdown(|| document::of(found, false))
}

/// One HTML file that needs nothing else.
pub fn html(found: &WaveformReport<'_>) -> String {
    look::html(|| document::of(found, false))
}

impl WaveformReport<'_> {
    /// The unit of a channel's waveform.
    fn unit(&self, channel: usize) -> &str {
        self.settings.channels.get(channel).map_or("1", |of| of.unit.text())
    }

    /// The unit of a figure of a channel.
    fn unit_of(&self, channel: usize, of: &QuantityFound) -> String {
        let whole = |unit: &str| match unit.chars().all(char::is_alphanumeric) {
            true => unit.to_owned(),
            false => format!("({unit})"),
        };
        let unit = self.unit(channel);
        match of.quantity {
            WaveformQuantity::Maximum | WaveformQuantity::Minimum => unit.to_owned(),
            WaveformQuantity::MaximumTime
            | WaveformQuantity::MinimumTime
            | WaveformQuantity::Duration { .. } => "s".to_owned(),
            WaveformQuantity::Integral { .. } if unit == "1" => "s".to_owned(),
            WaveformQuantity::SquaredIntegral { .. } if unit == "1" => "s".to_owned(),
            WaveformQuantity::Integral { .. } => format!("{}*s", whole(unit)),
            WaveformQuantity::SquaredIntegral { .. } => format!("{}^2*s", whole(unit)),
            WaveformQuantity::Ratio { channel: other } => match (unit, self.unit(other)) {
                (unit, other) if unit == other => "1".to_owned(),
                (unit, "1") => unit.to_owned(),
                (unit, other) => format!("{}/{}", whole(unit), whole(other)),
            },
        }
    }
}

/// The probabilistically symmetric interval of the trials for 95 %; none for fewer than 100.
fn interval_of_trials(of: &QuantityFound) -> Option<[f64; 2]> {
    let n = of.trials.len();
    of.of_trials().filter(|_| n >= 100)?;
    // JCGM 101, 7.7: q of the n values lie within
    let within = (0.95 * n as f64 + 0.5).floor() as usize;
    let first = (n - within).div_ceil(2);
    Some([
        *of.trials.get(first.saturating_sub(1))?,
        *of.trials.get(first.saturating_sub(1) + within)?,
    ])
}
