//! A recipe file: which channels of which recordings, and what is taken from them.

mod channels;
mod column;
mod quantity;
mod recordings;
mod rows;
mod steps;
mod waveform;

use std::ops::Range;
use std::sync::Arc;

use super::context::Context;
use super::keys;
use super::open::{FileKind, check_format, read_root, refuse_other_kind};
use channels::ChannelFile;
use gumption_columns::recording::{self, Recording};
use gumption_engine::model::formula;
use gumption_engine::task::Warning;
use gumption_signal::{
    Amplitude, ChannelRateSearch, ChannelRecording, Frequency, Method, PhaseUnit, RecipeSettings,
    Refused, TimeBase, WaveformChannel,
};
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, Folder, SourceText};
use gumption_units::Unit;
use gumption_units::nearest;
use recordings::RecordingFile;
use waveform::RecipeFiles;

/// The highest multiple of a frequency.
const MOST_MULTIPLE: u64 = 50;

/// A condition of the recordings: a column of the answer.
#[derive(Clone, Debug, PartialEq)]
pub struct RecipeCondition {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
}

/// A row of a recipe: recordings that were made together.
#[derive(Clone, Debug)]
pub struct RecipeRow {
    /// The frequencies, in hertz.
    pub frequencies: Vec<Frequency>,
    /// The values of the conditions, in their units.
    pub conditions: Vec<f64>,
    /// The file of each recording, and where it is named.
    files: Vec<(String, Range<usize>)>,
    /// The part that is used of each recording, in seconds.
    parts: Vec<[Option<f64>; 2]>,
    /// Where the frequency stands.
    frequency_place: Range<usize>,
}

/// A recipe file that was read and found right; its recordings are not read yet.
#[derive(Debug)]
pub struct RecipeFile {
    /// The title, if it has one.
    pub title: Option<String>,
    /// What is the same for all rows.
    pub settings: RecipeSettings,
    /// The conditions.
    pub conditions: Vec<RecipeCondition>,
    /// The name of the column of frequencies.
    pub frequency: String,
    /// The rows.
    pub rows: Vec<RecipeRow>,
    /// The channels whose answers are waveforms: those of the recipe, or none.
    pub waveforms: Vec<WaveformChannel>,
    /// The digest of each file of responses, by its name.
    pub digests: Vec<(String, String)>,
    /// What to bear in mind about the responses.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<SourceText>,
    recordings: Vec<RecordingFile>,
    searches: Vec<Option<ChannelRateSearch>>,
    channels: Vec<ChannelFile>,
}

/// The recordings of a row, opened.
#[derive(Debug)]
pub struct OpenedRow {
    /// What is the same for all rows, with the resolution that the files have.
    pub settings: RecipeSettings,
    /// The recordings with their channels.
    pub tracks: Vec<ChannelRecording<Recording>>,
    /// The digest of each file, by its name.
    pub digests: Vec<(String, String)>,
    /// What to bear in mind about the recordings.
    pub warnings: Vec<Warning>,
    /// Which recordings the tracks are.
    of: Vec<usize>,
}

/// Reads and checks a recipe's text; its recordings are looked for in `folder`.
///
/// # Errors
/// All mistakes of the text.
pub(super) fn read_text(
    name: &str,
    text: &str,
    (context, folder): (Context<'_>, Folder<'_>),
) -> Result<RecipeFile, Diagnostics> {
    read_root(name, text, "a recipe", |root| recipe(&root, context, folder))
}

/// Whether a text is meant as a recipe.
pub(super) fn is_meant(root: &Node) -> bool {
    let Json::Object(members) = &root.value else { return false };
    members.iter().any(|member| member.key == keys::RECIPE_KEY)
}

/// Reads a recipe and all of its recordings.
///
/// # Errors
/// All mistakes of the text, or the first of each row's recordings.
pub(super) fn check_text(
    name: &str,
    text: &str,
    (context, folder): (Context<'_>, Folder<'_>),
) -> Result<(), Diagnostics> {
    let file = read_text(name, text, (context, folder))?;
    let mut diagnostics = Vec::new();
    for row in 0..file.rows.len() {
        if let Err(found) = file.open(row) {
            diagnostics.extend(found.0);
        }
    }
    if diagnostics.is_empty() { Ok(()) } else { Err(Diagnostics(diagnostics)) }
}

fn recipe(root: &Object<'_>, context: Context<'_>, folder: Folder<'_>) -> Option<RecipeFile> {
    if refuse_other_kind(root, FileKind::Recipe) {
        return None;
    }
    keys::check(root, keys::RECIPE);
    check_format(root, 1.0);
    let title = root.text("title").map(str::to_owned);
    root.text("source");
    // what names recordings or channels is held against the names, whatever else is wrong with them
    let recordings = recordings::read(root, folder)?;
    let mut files = RecipeFiles { context, folder, read: Vec::new(), warnings: Vec::new() };
    let channels = channels::read(root, &recordings, &mut files);
    let has_frequency = channels.as_ref().map(|all| all.iter().all(|of| of.waveform.is_none()));
    let reference = reference(root);
    let method = named(root, "method", &Method::ALL, Method::name);
    let amplitude = named(root, "amplitude", &Amplitude::ALL, Amplitude::name);
    let phase = named(root, "phase_unit", &PhaseUnit::ALL, PhaseUnit::name);
    let components = components(root);
    let harmonics = root.whole("harmonics", 1, MOST_MULTIPLE).unwrap_or(5);
    let trials = root.whole("trials", 0, 1_000_000).unwrap_or(2000);
    let seed = root.whole("seed", 0, u64::MAX).unwrap_or(1);
    let of_rows = (method == Some(Method::Fft), has_frequency);
    let (rows, conditions, frequency) = rows::read(root, &recordings, of_rows)?;
    let channels = channels?;
    let waveforms = waveform::resolved(root, &channels)?;
    let searches = recordings.iter().enumerate().map(|(number, recording)| {
        recording.search.as_ref().and_then(|search| search.resolved(root.log, number, &channels))
    });
    let searches = searches.collect();
    check_references(root.log, &channels, reference?);
    let settings = RecipeSettings {
        channels: channels.iter().map(|file| file.channel.clone()).collect(),
        reference: reference?,
        components: components?,
        harmonics: u32::try_from(harmonics).unwrap_or(1),
        method: method?,
        amplitude: amplitude?,
        phase: phase?,
        trials,
        seed,
    };
    let source = root.log.source.clone();
    Some(RecipeFile {
        title,
        settings,
        conditions,
        frequency,
        rows,
        waveforms,
        digests: files
            .read
            .iter()
            .map(|(name, bytes)| (name.clone(), gumption_text::bytes::sha256(bytes)))
            .collect(),
        warnings: files.warnings,
        source,
        recordings,
        searches,
        channels,
    })
}

/// One of a few names; the default where the key is not there, nothing after a mistake.
fn named<T: Copy + Default>(
    root: &Object<'_>,
    key: &'static str,
    all: &[T],
    name: impl Fn(T) -> &'static str,
) -> Option<T> {
    let Some(member) = root.get(key) else { return Some(T::default()) };
    let text = root.text(key)?;
    let found = all.iter().copied().find(|value| name(*value) == text);
    if found.is_none() {
        let allowed = all.iter().map(|value| name(*value).to_owned()).collect();
        let diagnostic =
            DiagnosticKind::NotOneOf { key: key.into(), found: text.to_owned(), allowed };
        root.log.report(&member.value.span, diagnostic);
    }
    found
}

/// The multiples of the frequency, each once, in order; the first alone unless given.
fn components(root: &Object<'_>) -> Option<Vec<u32>> {
    let Some(member) = root.get("components") else { return Some(vec![1]) };
    let list = root.numbers("components")?;
    let whole =
        |number: &f64| number.fract() == 0.0 && (1.0..=MOST_MULTIPLE as f64).contains(number);
    if let Some(found) = list.iter().find(|number| !whole(number)) {
        let found = gumption_engine::number::Shortest(*found).to_string();
        let key = "components".to_owned();
        let diagnostic = DiagnosticKind::NotWhole { key, found, least: 1, most: MOST_MULTIPLE };
        root.log.report(&member.value.span, diagnostic);
        return None;
    }
    let mut multiples: Vec<u32> = list.iter().map(|number| *number as u32).collect();
    multiples.sort_unstable();
    multiples.dedup();
    if multiples.is_empty() {
        root.log.report(&member.key_span, DiagnosticKind::NoValues { name: "components".into() });
        return None;
    }
    Some(multiples)
}

/// The reference channel; none where the key is not there. It is looked for among the names of the
/// channels, so that a mistake within one of these is not a missing channel as well.
fn reference(root: &Object<'_>) -> Option<Option<usize>> {
    let Some(member) = root.get("reference") else { return Some(None) };
    let Json::Object(channels) = &root.get("channels")?.value.value else { return None };
    let name = root.text("reference")?;
    let place = channels.iter().position(|channel| channel.key == name);
    if place.is_none() {
        let known = channels.iter().map(|channel| channel.key.as_str());
        let reason = match nearest(name, known) {
            Some(near) => format!("there is no channel `{name}`; did you mean `{near}`?"),
            None => format!("there is no channel `{name}`"),
        };
        root.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
    }
    place.map(Some)
}

/// Steps that need a reference have one, and it is another channel.
fn check_references(log: &Collector, channels: &[ChannelFile], reference: Option<usize>) {
    for (number, file) in channels.iter().enumerate() {
        for (step, place) in file.channel.steps.iter().zip(&file.step_places) {
            let reason = match reference {
                _ if !step.needs_reference() => continue,
                None => format!("the step `{}` needs a `reference`", step.name()),
                Some(reference) if reference == number => format!(
                    "the step `{}` compares a channel with the reference; this is the reference",
                    step.name()
                ),
                Some(_) => continue,
            };
            log.report(place, DiagnosticKind::Recipe { reason });
        }
    }
}

/// A name of a channel, recording or condition.
fn check_name(log: &Collector, name: &str, place: &Range<usize>) {
    if let Err(error) = formula::check_name(name) {
        let (name, reason) = (name.to_owned(), error.to_string());
        log.report(place, DiagnosticKind::BadName { name, reason });
    }
}

impl RecipeFile {
    /// The names of the recordings' files, as the recipe has them.
    pub fn named_files(&self) -> impl Iterator<Item = &String> {
        self.rows.iter().flat_map(|row| row.files.iter().map(|(name, _)| name))
    }

    /// Reads the recordings of a row through, and checks every sample.
    ///
    /// # Errors
    /// The first mistake of each recording, with line or sample and channel.
    pub fn open(&self, row: usize) -> Result<OpenedRow, Diagnostics> {
        let log = Collector::new(self.source.clone());
        let mut opened = OpenedRow {
            settings: self.settings.clone(),
            tracks: Vec::new(),
            digests: Vec::new(),
            warnings: Vec::new(),
            of: Vec::new(),
        };
        let Some(of_row) = self.rows.get(row) else { return Ok(opened) };
        for (number, file) in self.recordings.iter().enumerate() {
            let (Some((name, place)), Some([from, to])) =
                (of_row.files.get(number), of_row.parts.get(number))
            else {
                continue;
            };
            let channels: Vec<usize> = (0..self.channels.len())
                .filter(|c| self.channels[*c].recording == number)
                .collect();
            if channels.is_empty() {
                continue;
            }
            let of = |channel: &usize| self.channels[*channel].wanted();
            let slowest = of_row.frequencies.iter().filter_map(|f| f.hertz).min_by(f64::total_cmp);
            let bytes = match file.bytes(name) {
                Ok(bytes) => bytes,
                Err(outside) => {
                    log.report(place, outside);
                    continue;
                }
            };
            let channels_of_file = channels.iter().map(of).collect();
            let reading = file.reading(bytes, name, channels_of_file, slowest, *from, *to);
            match recording::open(reading) {
                Ok(recording) => {
                    for channel in &channels {
                        let gain = self.channels[*channel].gain;
                        let channel_settings = &mut opened.settings.channels[*channel];
                        // values of an integer format are steps of 1 unless the recipe knows better
                        if recording.whole && channel_settings.resolution == 0.0 {
                            channel_settings.resolution = gain.abs();
                        }
                    }
                    opened.warnings.extend(recording.warnings.iter().cloned());
                    let in_grams =
                        channels.iter().map(|channel| self.channels[*channel].in_grams());
                    opened.warnings.extend(in_grams.flatten());
                    opened.digests.push((name.clone(), recording.digest.clone()));
                    let base = TimeBase {
                        rate: recording.rate,
                        start: recording.start,
                        jitter: file.jitter,
                        beside_frequency: None,
                        of_middle: recording.of_middle,
                    };
                    let search = self.searches.get(number).copied().flatten();
                    opened.tracks.push(ChannelRecording {
                        passes: recording,
                        base,
                        channels,
                        search,
                    });
                    opened.of.push(number);
                }
                Err(reason) => {
                    let reason = format!("`{name}`: {reason}");
                    log.report(place, DiagnosticKind::Recording { reason });
                }
            }
        }
        if log.is_clean() { Ok(opened) } else { Err(log.into_diagnostics()) }
    }

    /// Why a row has no observation, as a mistake with its place.
    pub fn refusal(&self, row: usize, refused: &Refused<String>) -> Diagnostics {
        let log = Collector::new(self.source.clone());
        let of_row = self.rows.get(row);
        let file = |channel: usize| {
            let recording = self.channels.get(channel).map_or(0, |file| file.recording);
            of_row.and_then(|row| row.files.get(recording)).map_or("", |(name, _)| name.as_str())
        };
        let name = |channel: usize| {
            self.channels.get(channel).map_or("", |channel| channel.channel.name.as_str())
        };
        let place = |channel: usize| format!("`{}`, channel `{}`", file(channel), name(channel));
        let own = self.channels.get(refused.channel().unwrap_or(0));
        let mut span = of_row.map_or(0..0, |row| row.frequency_place.clone());
        // products and quotients of what the recipe says: without the rounding of the last digits
        let shortest = |value: f64| {
            gumption_engine::number::Shortest(format!("{value:.11e}").parse().unwrap_or(value))
        };
        let reason = match refused {
            Refused::Unreadable(reason) => reason.clone(),
            Refused::AboveNyquist { channel, hertz, rate } => format!(
                "{}: a component at {} Hz is not below half the sampling rate of {} Hz",
                place(*channel),
                shortest(*hertz),
                shortest(*rate)
            ),
            Refused::LessThanOnePeriod { channel, hertz, periods } => {
                let (place, hertz) = (place(*channel), shortest(*hertz));
                let has = format!("{place}: the recording has {periods:.3} periods of {hertz} Hz");
                match *periods {
                    ..1.0 => format!("{has}; one at least is needed"),
                    // those of `fft`
                    ..2.5 => format!(
                        "{has}, and no whole one between two crossings of its mean upwards, which the \
                         method `fft` needs; record two and a half, or leave out `\"method\": \"fft\"`"
                    ),
                    _ => format!(
                        "{has}, but its crossings of the mean upwards are not whole periods of {hertz} \
                         Hz apart: noise, a drift or another oscillation is too strong for the method \
                         `fft`; leave out `\"method\": \"fft\"`, or state the frequency that it has"
                    ),
                }
            }
            Refused::NotApart { channel, samples } => format!(
                "{}: {samples} samples are too few, or too short a time, to separate the \
                 frequencies and their multiples",
                place(*channel)
            ),
            Refused::NotFound { channel } => format!(
                "{}: there is no oscillation whose frequency could be estimated",
                place(*channel)
            ),
            Refused::Step { channel, step, reason } => {
                if let Some(of) = own.and_then(|own| own.step_places.get(*step)) {
                    span = of.clone();
                }
                format!("{}: {reason}", place(*channel))
            }
            Refused::Rate { channel, reason } => {
                let recording = own.and_then(|own| self.recordings.get(own.recording));
                if let Some(search) = recording.and_then(|recording| recording.search.as_ref()) {
                    span = search.place.clone();
                }
                format!("{}: {reason}", place(*channel))
            }
            Refused::TooLong { channel, samples } => {
                if let Some(of) = own {
                    span = of.place.clone();
                }
                format!(
                    "{}: {samples} samples are more than the {} that are held in memory for steps and \
                     for the method `fft`; take a part with `from` and `to`",
                    place(*channel),
                    gumption_signal::MOST_HELD
                )
            }
            // what the reader has refused already
            _ => refused.to_string(),
        };
        log.report(&span, DiagnosticKind::Recording { reason });
        log.into_diagnostics()
    }
}
