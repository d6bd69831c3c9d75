//! `gumption gap-check`
//!
//! Three separate steps: cases are written with their data, and the truths sealed beside them; each
//! case is read and diagnosed from its own folder alone; only then are the truths opened and scored.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};
use rayon::prelude::*;

use super::options::{self, Answer, Seed, Threads, Trust};
use super::signals::{self, Temporary};
use super::{CommandLine, Exit, Failure, progress, run};
use gumption_files::CaseFile;
use gumption_gap as gap;
use gumption_gap::check::{BlindCheckScores, BlindDraw, Truth, score, truth};
use gumption_report as report;

/// Check the diagnosis blindly at a case's own design.
#[derive(Debug, Args)]
pub(super) struct GapCheck {
    /// The case: its design, uncertainties and candidate effects are used, not its data
    case: PathBuf,
    /// Number of truths to draw
    #[arg(long, value_name = "N", default_value = "200", value_parser = draws)]
    draws: u64,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    answer: Answer<Format>,
    #[command(flatten)]
    seed: Seed,
    #[command(flatten)]
    threads: Threads,
    /// Keep the drawn cases and, in its folder `sealed`, their truths
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page of text for people
    Table,
    /// A page with figures for a browser and for print, in one file
    Html,
    /// The whole answer for programs
    Json,
}

fn draws(text: &str) -> Result<u64, String> {
    match text.parse::<u64>() {
        Ok(count @ 1..=100_000) => Ok(count),
        _ => Err("a whole number from 1 to 100000 is needed".to_owned()),
    }
}

impl GapCheck {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let file = self.trust.files(program).case(&self.case)?;
        let read = options::with_named(&self.case, file.files.iter().map(|(name, _)| name));
        let place = self.answer.open(&read)?;
        // from the first word on, an interrupt leaves nothing behind
        let stop = signals::stop_flag();
        self.answer.say(&file.warnings);
        let seed = self.seed.or(file.case.task.settings.seed);
        let kept;
        let folder: &Path = match &self.keep {
            Some(folder) => folder,
            None => {
                let made = tempfile::tempdir().map_err(|error| {
                    Failure::System(format!("cannot make a temporary folder: {error}"))
                })?;
                kept = Temporary::new(made.keep());
                kept.path()
            }
        };
        let scores = || self.scores(program, &file, folder, seed, &stop);
        let Some(scores) = self.threads.install(scores)?? else {
            return Ok(Exit::Interrupted);
        };
        let design = report::gap::check::CheckedDesign::of(&file.case);
        let answer = match self.answer.format {
            Format::Table => report::gap::check::table(&design, &scores),
            Format::Html => {
                let provenance = run::provenance(&file.source.text, &file.files);
                report::gap::check::html(&design, &scores, &provenance)
            }
            Format::Json => report::gap::check_json(&design.title, &scores),
        };
        place.write(&answer)?;
        Ok(Exit::Done)
    }

    /// The three steps in turn: truths and data, diagnoses, comparison; `None` if they were
    /// interrupted.
    fn scores(
        &self,
        program: &CommandLine,
        file: &CaseFile,
        folder: &Path,
        seed: u64,
        stop: &AtomicBool,
    ) -> Result<Option<BlindCheckScores>, Failure> {
        let noise = gap::noise(&file.case, seed).map_err(impossible)?;
        self.write(file, &noise, folder, seed)?;
        let Some(answers) = self.diagnose(program, folder, seed, stop)? else {
            return Ok(None);
        };
        let sim = gap::nominal(&file.case);
        let checked = answers
            .iter()
            .enumerate()
            .map(|(number, answer)| {
                let sealed = open(&folder.join("sealed").join(format!("{number:05}.json")))?;
                Ok(BlindDraw::new(&sealed, answer, &sim, &noise))
            })
            .collect::<Result<Vec<_>, Failure>>()?;
        Ok(Some(score(&file.case, checked, seed)))
    }

    /// Draws the truths: each case in a folder of its own, its truth in the folder `sealed`.
    fn write(
        &self,
        file: &CaseFile,
        noise: &[Vec<f64>],
        folder: &Path,
        seed: u64,
    ) -> Result<(), Failure> {
        let make = |path: &Path| {
            std::fs::create_dir_all(path).map_err(|error| {
                Failure::System(format!("cannot make the folder `{}`: {error}", path.display()))
            })
        };
        let sealed = folder.join("sealed");
        make(&sealed)?;
        (0..self.draws).into_par_iter().try_for_each(|number| {
            let (truth, measured) = truth(&file.case, noise, seed, number).map_err(impossible)?;
            let own = folder.join(format!("{number:05}"));
            make(&own)?;
            let withheld = (truth.kind == gap::check::TruthKind::Withheld)
                .then(|| truth.effects.first().map(|name| file.case.listed_name(name)))
                .flatten();
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
        })
    }

    /// Diagnoses every case from its own folder; `None` if it was interrupted.
    fn diagnose(
        &self,
        program: &CommandLine,
        folder: &Path,
        seed: u64,
        stop: &AtomicBool,
    ) -> Result<Option<Vec<gap::ModelSelection>>, Failure> {
        let bar = progress::counted(self.draws, "draws", self.answer.quiet);
        let answers: Result<Vec<Option<gap::ModelSelection>>, Failure> = (0..self.draws)
            .into_par_iter()
            .map(|number| {
                if stop.load(Ordering::Relaxed) {
                    return Ok(None);
                }
                let path = folder.join(format!("{number:05}")).join("case.json");
                let file = program.files().case(&path)?;
                let answer = gap::select_model(&file.case, seed).map_err(impossible)?;
                bar.inc(1);
                Ok(Some(answer))
            })
            .collect();
        bar.finish_and_clear();
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
