//! `gumption gap-check`
//!
//! Three separate steps: cases are written with their data, and the truths sealed beside them; each
//! case is read and diagnosed from its own folder alone; only then are the truths opened and scored.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{AnswerOptions, Case, Interactive, Seed, Threads};
use super::shared_draws::SharedCheck;
use super::signals::{self, Temporary};
use super::{CommandLine, Exit, Failure, output, parts, progress, run};
use gumption_engine::parallel;
use gumption_files::CaseFile;
use gumption_gap as gap;
use gumption_gap::check::{BlindDraw, CheckedNoise, Truth, score, truth};
use gumption_report as report;

/// Test the diagnosis on simulated data of a case (blind).
///
/// The test uses the case's design, uncertainties and candidate effects, not its data.
#[derive(Debug, Args)]
pub(super) struct GapCheck {
    #[command(flatten)]
    case: Case,
    /// Number of truths to draw
    #[arg(
        long, value_name = "N", default_value = "200", value_parser = draws,
        allow_negative_numbers = true
    )]
    draws: u64,
    /// The noise of the simulated data
    #[arg(long, value_enum, default_value_t)]
    noise: Noise,
    #[command(flatten)]
    answer: AnswerOptions<GapCheckFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    threads: Threads,
    /// Keep the simulated cases and, in the folder `sealed`, their truths
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
    /// Make only some of the draws, for `--parts`: those from A to B - 1 of the N, or the K-th of M
    /// parts
    #[arg(
        long, value_name = "A..B|K/M", value_parser = parts::blocks, requires = "partial",
        conflicts_with = "output"
    )]
    share: Option<parts::Blocks>,
    /// Write these draws to a file
    #[arg(long, value_name = "FILE", requires = "share")]
    partial: Option<PathBuf>,
    /// Read the draws from the files of `--partial` in a folder; the answer is the same as on one
    /// machine
    #[arg(long, value_name = "DIR", conflicts_with_all = ["share", "keep"])]
    parts: Option<PathBuf>,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum GapCheckFormat {
    /// A text page
    Table,
    /// An HTML page with figures, in one file
    Html,
    /// The whole answer for programs
    Json,
}

/// The noise of the simulated data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Noise {
    /// As it is stated
    #[default]
    AsStated,
    /// Drawn as well: as stated, uncertainties wrong by a factor, single outlying rows, correlated
    /// neighbours
    Uncertain,
}

impl From<Noise> for CheckedNoise {
    fn from(noise: Noise) -> Self {
        match noise {
            Noise::AsStated => Self::AsStated,
            Noise::Uncertain => Self::Uncertain,
        }
    }
}

fn draws(text: &str) -> Result<u64, String> {
    match text.parse::<u64>() {
        Ok(count @ 1..=100_000) => Ok(count),
        _ => Err("a whole number from 1 to 100000 is needed".to_owned()),
    }
}

impl GapCheck {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let file = self.case.read(program)?;
        let read = self.case.paths(&file);
        let place = self.answer.open(&read)?;
        let [partial] = output::open([("--partial", self.partial.as_deref())], &read)?;
        // from the first output on, an interrupt leaves nothing behind
        let stop = signals::stop_flag();
        self.answer.say(&file.warnings);
        let seed = self.seed.or(file.case.task.settings.seed);
        let range = match &self.share {
            Some(share) => share.of(self.draws, ("--share", "draws"))?,
            None => 0..self.draws,
        };
        let shared = || SharedCheck::new(&file, seed, self.draws, self.noise.into());
        let checked = match &self.parts {
            Some(folder) => Some(shared().together(folder)?),
            None => self.made(program, &file, seed, range.clone(), &stop)?,
        };
        let Some(checked) = checked else {
            say("gumption: interrupted; an incomplete test gives no answer\n");
            return Ok(Exit::Interrupted);
        };
        if let Some(partial) = partial {
            let content = shared().file(&range, checked)?;
            partial.write_with(|out| out.write_all(content.as_bytes()).map(|()| true))?;
            return Ok(Exit::Done);
        }
        let scores = self.threads.install(|| score(&file.case, checked, seed));
        let design = report::gap::check::CheckedDesign::of(&file.case, self.noise.into());
        let provenance = run::provenance(&file.source.text, &file.files);
        let answer = match self.answer.format {
            GapCheckFormat::Table => report::gap::check::table(&design, &scores, &provenance),
            GapCheckFormat::Html => page(report::gap::check::html(&design, &scores, &provenance)),
            GapCheckFormat::Json => report::gap::check_json(&design.title, design.noise, &scores),
        };
        place.write(&answer)?;
        Ok(Exit::Done)
    }

    /// Makes draws in a folder, which is kept or temporary; `None` if it was interrupted.
    fn made(
        &self,
        program: &CommandLine,
        file: &CaseFile,
        seed: u64,
        range: Range<u64>,
        stop: &AtomicBool,
    ) -> Result<Option<Vec<BlindDraw>>, Failure> {
        let kept;
        let folder: &Path = match &self.keep {
            Some(folder) => folder,
            None => {
                let made = tempfile::tempdir().map_err(|error| {
                    Failure::System(format!("cannot create a temporary folder: {error}"))
                })?;
                kept = Temporary::new(made.keep());
                kept.path()
            }
        };
        self.threads.install(|| self.checked(program, file, folder, (seed, range), stop))
    }

    /// The three steps in order: truths and data, diagnoses, comparison; `None` if they were
    /// interrupted.
    fn checked(
        &self,
        program: &CommandLine,
        file: &CaseFile,
        folder: &Path,
        (seed, range): (u64, Range<u64>),
        stop: &AtomicBool,
    ) -> Result<Option<Vec<BlindDraw>>, Failure> {
        let noise = gap::noise(&file.case, seed).map_err(impossible)?;
        self.write(file, &noise, folder, (seed, range.clone()))?;
        let Some(answers) = self.diagnose(program, folder, (seed, range.clone()), stop)? else {
            return Ok(None);
        };
        let sim = gap::nominal(&file.case);
        let checked = range.zip(&answers).map(|(number, answer)| {
            let sealed = open(&folder.join("sealed").join(format!("{number:05}.json")))?;
            Ok(BlindDraw::new(&sealed, answer, &sim, &noise))
        });
        checked.collect::<Result<Vec<_>, Failure>>().map(Some)
    }

    /// Draws the truths: each case in its own folder, its truth in the folder `sealed`.
    fn write(
        &self,
        file: &CaseFile,
        noise: &[Vec<f64>],
        folder: &Path,
        (seed, range): (u64, Range<u64>),
    ) -> Result<(), Failure> {
        let make = |path: &Path| {
            std::fs::create_dir_all(path).map_err(|error| {
                Failure::System(format!("cannot create the folder `{}`: {error}", path.display()))
            })
        };
        let sealed = folder.join("sealed");
        make(&sealed)?;
        let written = parallel::map(range, |number| {
            let drawn = truth(&file.case, noise, self.noise.into(), seed, number);
            let (truth, measured) = drawn.map_err(impossible)?;
            let own = folder.join(format!("{number:05}"));
            make(&own)?;
            let withheld = truth.withheld().map(|name| file.case.listed_name(name));
            let files = file.variant(&measured, withheld);
            for (name, bytes) in files.map_err(|error| Failure::Argument(error.0))? {
                let path = own.join(name);
                if let Some(parent) = path.parent() {
                    make(parent)?;
                }
                write(&path, &bytes)?;
            }
            let text = serde_json::to_vec_pretty(&truth)
                .map_err(|error| Failure::System(format!("cannot write a truth: {error}")))?;
            write(&sealed.join(format!("{number:05}.json")), &text)
        });
        written.into_iter().collect()
    }

    /// Diagnoses every case from its own folder; `None` if it was interrupted.
    fn diagnose(
        &self,
        program: &CommandLine,
        folder: &Path,
        (seed, range): (u64, Range<u64>),
        stop: &AtomicBool,
    ) -> Result<Option<Vec<gap::ModelSelection>>, Failure> {
        let bar = progress::counted(range.end - range.start, "draws", self.answer.quiet);
        let answers = parallel::map(range, |number| {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let path = folder.join(format!("{number:05}")).join("case.json");
            let file = program.files().case(&path)?;
            let answer = gap::select_model(&file.case, seed).map_err(impossible)?;
            bar.inc(1);
            Ok(Some(answer))
        });
        bar.finish_and_clear();
        let answers: Result<Vec<Option<gap::ModelSelection>>, Failure> =
            answers.into_iter().collect();
        Ok(answers?.into_iter().collect())
    }
}

/// Effects that cannot act on the model.
fn impossible(error: gap::OverrideError) -> Failure {
    Failure::System(error.to_string())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    std::fs::write(path, bytes)
        .map_err(|error| Failure::System(format!("cannot write `{}`: {error}", path.display())))
}

/// Opens a sealed truth.
fn open(path: &Path) -> Result<Truth, Failure> {
    let failed = |error: String| {
        Failure::System(format!("cannot read the truth `{}`: {error}", path.display()))
    };
    let bytes = std::fs::read(path).map_err(|error| failed(error.to_string()))?;
    serde_json::from_slice(&bytes).map_err(|error| failed(error.to_string()))
}
