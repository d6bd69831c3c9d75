//! `gumption observe`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::options::{self, AllowedFolders, AnswerOptions, Interactive, Seed};
use super::output::AnswerPlace;
use super::{CommandLine, Exit, Failure, run};
use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_files::{FileReader, RecipeFile};
use gumption_report::Provenance;
use gumption_report::observe::{self as report, ObservationReport};
use gumption_report::waveform::{self, WaveformReport};
use gumption_signal::{
    Observation, RecordTrace, Waveform, observe, observe_with_traces, waveform_notes, waveforms,
};

/// Determine amplitudes, phases and delays with their uncertainties from raw recordings.
#[derive(Debug, Args)]
pub(super) struct Observe {
    /// The recipe: recordings, channels and the quantities to determine; - for standard input
    recipe: PathBuf,
    #[command(flatten)]
    allowed: AllowedFolders,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    answer: AnswerOptions<ObserveFormat>,
    #[command(flatten)]
    interactive: Interactive,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ObserveFormat {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each row and frequency
    Csv,
    /// A Markdown page, as GitHub shows it; with `--output` its figures are SVG files beside it
    Markdown,
    /// An HTML page, in one file
    Html,
}

impl Observe {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let files = self.allowed.files(program);
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.recipe_text(name, text, folder)
        };
        let mut file = options::opened(files, &self.recipe, text, |path| files.recipe(path))??;
        let place = self.answer.open(&options::with_named(&self.recipe, file.named_files()))?;
        file.settings.seed = self.seed.or(file.settings.seed);
        let mut provenance = run::provenance(&file.source.text, &[]);
        provenance.files.extend(file.digests.iter().cloned());
        if !file.waveforms.is_empty() {
            return self.correct(&file, provenance, place, page);
        }
        let mut warnings: Vec<Warning> = Vec::new();
        let mut rows = Vec::new();
        let mut traces = Vec::new();
        for row in 0..file.rows.len() {
            let is_page =
                self.answer.format == ObserveFormat::Html || self.answer.has_figures_beside();
            let ObservedRow { observation, traces: seen, warnings: found, digests } =
                observed(&file, row, is_page)?;
            traces.push(seen);
            add_new(&mut warnings, found);
            add_new(&mut provenance.files, digests);
            rows.push((file.rows[row].conditions.clone(), observation));
        }
        let found = ObservationReport {
            title: file.title.as_deref(),
            settings: &file.settings,
            conditions: &file.conditions,
            frequency: &file.frequency,
            rows: &rows,
            traces: &traces,
            warnings: &warnings,
            provenance: &provenance,
        };
        let answer = || match self.answer.format {
            ObserveFormat::Table => report::table(&found),
            ObserveFormat::Json => report::json(&found),
            ObserveFormat::Csv => report::csv(&found),
            ObserveFormat::Markdown => report::markdown(&found),
            ObserveFormat::Html => page(report::html(&found)),
        };
        // a page on standard output contains the notes itself
        if self.answer.format != ObserveFormat::Table || self.answer.is_to_file() {
            self.answer.say(&warnings);
        }
        self.answer.write_page(place, answer)?;
        Ok(Exit::Done)
    }

    /// Corrects the records of a recipe of waveforms.
    fn correct(
        &self,
        file: &RecipeFile,
        mut provenance: Provenance,
        place: AnswerPlace,
        page: impl FnOnce(String) -> String,
    ) -> Result<Exit, Failure> {
        let mut warnings: Vec<Warning> = file.warnings.clone();
        let mut rows: Vec<(Vec<f64>, Vec<Waveform>)> = Vec::new();
        for row in 0..file.rows.len() {
            let mut opened = file.open(row)?;
            let drawn = (file.settings.seed, file.settings.trials);
            let found = waveforms(&file.waveforms, drawn, &mut opened.tracks)
                .map_err(|refused| file.refusal(row, &refused))?;
            let several = file.rows.len() > 1;
            for (channel, of) in file.waveforms.iter().zip(&found) {
                for fact in waveform_notes(channel, of) {
                    let warning = Warning::new(&channel.name, fact);
                    opened.warnings.push(match several {
                        true => warning.within(fact!("of-row", row = row + 1)),
                        false => warning,
                    });
                }
            }
            add_new(&mut warnings, opened.warnings);
            add_new(&mut provenance.files, opened.digests);
            rows.push((file.rows[row].conditions.clone(), found));
        }
        let found = WaveformReport {
            title: file.title.as_deref(),
            settings: &file.settings,
            channels: &file.waveforms,
            conditions: &file.conditions,
            rows: &rows,
            warnings: &warnings,
            provenance: &provenance,
        };
        let answer = || match self.answer.format {
            ObserveFormat::Table => waveform::table(&found),
            ObserveFormat::Json => waveform::json(&found),
            ObserveFormat::Csv => waveform::csv(&found),
            ObserveFormat::Markdown => waveform::markdown(&found),
            ObserveFormat::Html => page(waveform::html(&found)),
        };
        if self.answer.format != ObserveFormat::Table || self.answer.is_to_file() {
            self.answer.say(&warnings);
        }
        self.answer.write_page(place, answer)?;
        Ok(Exit::Done)
    }
}

/// Adds what is not among them.
fn add_new<T: PartialEq>(all: &mut Vec<T>, found: Vec<T>) {
    for one in found {
        if !all.contains(&one) {
            all.push(one);
        }
    }
}

/// The results of a row, with notes and the digests of its files.
struct ObservedRow {
    observation: Observation,
    /// Curves for figures, if there are figures.
    traces: Vec<RecordTrace>,
    warnings: Vec<Warning>,
    digests: Vec<(String, String)>,
}

fn observed(file: &RecipeFile, row: usize, traced: bool) -> Result<ObservedRow, Failure> {
    let mut opened = file.open(row)?;
    let frequencies = &file.rows[row].frequencies;
    let found = match traced {
        true => observe_with_traces(&opened.settings, frequencies, &mut opened.tracks),
        false => observe(&opened.settings, frequencies, &mut opened.tracks)
            .map(|observation| (observation, Vec::new())),
    };
    let (observation, traces) = found.map_err(|refused| file.refusal(row, &refused))?;
    let mut warnings = opened.warnings;
    let several = file.rows.len() > 1;
    for note in &observation.notes {
        let name = opened.settings.channels.get(note.channel).map_or("", |of| of.name.as_str());
        let warning = Warning::new(name, note.fact.clone());
        warnings.push(match several {
            true => warning.within(fact!("of-row", row = row + 1)),
            false => warning,
        });
    }
    Ok(ObservedRow { observation, traces, warnings, digests: opened.digests })
}
