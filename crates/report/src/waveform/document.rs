//! Corrected records as a document.

use super::{FACTOR, WaveformReport, figure, interval_of_trials};
use crate::document::{Block, Document};
use crate::number::{exact, significant, with_uncertainty};
use crate::observe::{shares, with_units};
use crate::plain;
use crate::printed::grouped;
use crate::sheet::{Figure, Sheet};
use gumption_signal::{
    Cutoff, LineResponse, LowPass, Truncation, Waveform, WaveformChannel, WaveformSource,
};

/// Rows whose figures a page shows, at most.
const MOST_FIGURES: usize = 40;

/// The whole document; `terminal`: without what needs a browser.
pub(super) fn of(found: &WaveformReport<'_>, terminal: bool) -> Document {
    let title = found.title.map(plain).filter(|title| !title.is_empty());
    let mut document = Document {
        title: title.unwrap_or_else(|| "Corrected signals".to_owned()),
        subtitle: vec![
            "values divided by the response, standard uncertainties by the law of propagation (JCGM 102, 6.2), trials \
             beside them (7)"
                .to_owned(),
        ],
        terminal,
        ..Document::default()
    };
    for (number, (values, waveforms)) in found.rows.iter().enumerate() {
        for (channel, of) in found.channels.iter().zip(waveforms) {
            let at = with_units(found.conditions, values);
            let at = if at.is_empty() { String::new() } else { format!(", {}", at.join(", ")) };
            document.section(plain(&format!("{}{at}", channel.name)));
            one(&mut document, found, channel, of);
            if number < MOST_FIGURES {
                document.picture(|| figure::of(found, channel, of), || None);
            }
        }
    }
    if !found.warnings.is_empty() {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(found.warnings)));
    }
    document.section("Reproducing this result");
    let digests = &found.provenance.files;
    let mut lines = vec![
        format!("gumption {}", env!("CARGO_PKG_VERSION")),
        format!("recipe, SHA-256: {}", found.provenance.model_sha256),
    ];
    lines
        .extend(digests.iter().map(|(name, digest)| format!("{}, SHA-256: {digest}", plain(name))));
    if !terminal {
        document.blocks.push(Block::List(lines));
    }
    document
}

/// What is said of one record.
fn one(
    document: &mut Document,
    found: &WaveformReport<'_>,
    channel: &WaveformChannel,
    of: &Waveform,
) {
    document.table(quantities(found, channel, of));
    if let Some(greatest) = of.standard_uncertainties.iter().copied().reduce(f64::max) {
        let least = of.standard_uncertainties.iter().copied().fold(greatest, f64::min);
        let unit = found.unit(channel.channel);
        let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
        document.text(format!(
            "{} samples at {} Hz. The standard uncertainty of a value is {}{unit} to {}{unit}; u^2, mean over the record: \
             {}. The band of 95 % at each instant is {} u wide to both sides{}.",
            grouped(of.signal.values.len() as u64),
            exact(of.signal.rate),
            significant(least, 2),
            significant(greatest, 2),
            made_of(&of.sources),
            significant(FACTOR, 3),
            of.trials.as_ref().map_or(String::new(), |trials| match trials.simultaneous_factor {
                Some(factor) => format!(
                    "; of {} trials 95 % lie wholly within {} u",
                    grouped(trials.count),
                    significant(factor, 3)
                ),
                None => format!("; {} trials are beside it", grouped(trials.count)),
            }),
        ));
    }
    document.text(method(channel, of, found.unit(channel.channel)));
}

/// The sources of a standard uncertainty with a share of a percent and more, the largest first.
fn made_of(contributions: &[(WaveformSource, f64)]) -> String {
    shares(contributions.iter().map(|(source, u)| (source.name(), *u)))
}

/// What was done with the record.
fn method(channel: &WaveformChannel, of: &Waveform, unit: &str) -> String {
    let step = &channel.step;
    let mut said = vec![match &step.response {
        LineResponse::Flat => "The record is divided by no response".to_owned(),
        LineResponse::Calibrated(of) => {
            format!("The record is divided by a response of {} points", of.frequencies.len())
        }
        LineResponse::Modelled(_) => "The record is divided by a fitted response".to_owned(),
    }];
    if step.delay.value != 0.0 {
        said.push(format!("a delay of {} s is taken off", exact(step.delay.value)));
    }
    if let (Some(LowPass { order, cutoff, delay }), Some(hertz)) = (step.low_pass, of.cutoff) {
        let proposed = if cutoff == Cutoff::Proposed {
            " (proposed: noise and truncation have the smallest variance together)"
        } else {
            ""
        };
        let phase = match delay {
            None => "without a shift of phase".to_owned(),
            Some(delay) => format!("less a delay of {} s", significant(delay, 4)),
        };
        let poles = if order == 1 { "1 pole".to_owned() } else { format!("{order} equal poles") };
        said.push(format!(
            "a low-pass of {poles}, {phase}, has its cut-off at {} Hz{proposed}",
            significant(hertz, 6)
        ));
        said.push(match step.truncation {
            Truncation::Nothing => "the recipe says that it takes nothing away".to_owned(),
            Truncation::Bound(size) => {
                let unit = if unit == "1" { "" } else { unit };
                format!("what it takes away is at most {} {unit}", significant(size, 4)).trim_end().to_owned()
            }
            Truncation::Decay { from, power } => format!(
                "what it takes away is bounded by a spectrum that falls with the power {} of the frequency from {} Hz on",
                exact(power),
                exact(from)
            ),
        });
    }
    format!("{}.", said.join("; "))
}

/// The figures with their uncertainties.
fn quantities(found: &WaveformReport<'_>, channel: &WaveformChannel, of: &Waveform) -> Sheet {
    let mut sheet = Sheet::default();
    if of.quantities.is_empty() {
        return sheet;
    }
    let all = || of.quantities.iter();
    sheet.text("quantity", all().map(|of| of.name.clone()));
    let (values, uncertainties): (Vec<Figure>, Vec<Figure>) = all()
        .map(|of| {
            let u = of.standard_uncertainty();
            let (value, text) = match u > 0.0 {
                true => with_uncertainty(of.value, u, 2),
                false => (significant(of.value, 6), String::new()),
            };
            (Figure::of(of.value, value), Figure::of(u, text))
        })
        .unzip();
    sheet.figures("value", values);
    sheet.figures("u", uncertainties);
    sheet.units("unit", all().map(|of| found.unit_of(channel.channel, of)));
    if all().any(|of| of.of_trials().is_some()) {
        sheet.figures(
            "u of the\ntrials",
            all().map(|of| Figure::rounded(of.of_trials().map(|[_, u]| u), |u| significant(u, 2))),
        );
        let interval = |of: &gumption_signal::QuantityFound| {
            let position = crate::number::position(of.standard_uncertainty(), 2);
            let text = |value| crate::number::to(value, position);
            interval_of_trials(of)
                .map_or(String::new(), |[a, b]| format!("{} to {}", text(a), text(b)))
        };
        sheet.text("95 % of the\ntrials", all().map(interval));
    }
    sheet.text("u^2", all().map(|of| made_of(&of.contributions)));
    sheet
}
