//! `gumption diff`

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{self, AnswerOptions, CoverageOption, Interactive, Threads, Trust};
use super::{CommandLine, Exit, Failure, signals};
use gumption_files as file;
use gumption_files::ModelOrResult;
use gumption_report as report;
use gumption_text::Diagnostics;

/// Show what changed between two model files or saved results, and how it changed U.
#[derive(Debug, Args)]
pub(super) struct Diff {
    /// The first file, a model or a file of `run --save`; - for standard input
    a: PathBuf,
    /// The second one
    b: PathBuf,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    answer: AnswerOptions<DiffFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    coverage: CoverageOption,
    #[command(flatten)]
    threads: Threads,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DiffFormat {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// A Markdown page, as GitHub shows it; with `--output` its figures are SVG files beside it
    Markdown,
    /// An HTML page, in one file
    Html,
}

impl Diff {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let standard = |path: &Path| path == Path::new("-");
        if standard(&self.a) && standard(&self.b) {
            return Err(Failure::Argument("only one of the files can be standard input".into()));
        }
        let (mut first, mut second) =
            match (self.read(program, &self.a)?, self.read(program, &self.b)?) {
                (Ok(first), Ok(second)) => (first, second),
                // the errors of both files together
                (first, second) => {
                    let found = [first.err(), second.err()].into_iter().flatten();
                    return Err(
                        Diagnostics(found.flat_map(|diagnostics| diagnostics.0).collect()).into()
                    );
                }
            };
        if self.coverage.is_given() {
            for file in [&mut first, &mut second] {
                let ModelOrResult::Model(model) = file else {
                    let name = file.name();
                    let message = format!(
                        "`{name}` is a saved result, whose coverage was fixed when it was saved; \
                         `--k` and `--coverage` are for model files"
                    );
                    return Err(Failure::Argument(message));
                };
                let settings = &mut model.task.settings;
                settings.coverage = self.coverage.or(settings.coverage);
            }
        }
        let mut names = named(&self.a, &first);
        names.extend(named(&self.b, &second));
        let place = self.answer.open(&names)?;
        let stop = signals::stop_flag();
        for file in [&first, &second] {
            if let ModelOrResult::Result(result) = file {
                self.answer.say(&result.warnings);
            }
        }
        let difference = file::difference(&first, &second, &self.threads.control(&stop))?;
        if stop.load(Ordering::Relaxed) {
            say("gumption: interrupted; there is no answer\n");
            return Ok(Exit::Interrupted);
        }
        let names = [&first, &second].map(ModelOrResult::name);
        let answer = || match self.answer.format {
            DiffFormat::Table => report::diff::table(names, &difference),
            DiffFormat::Json => report::diff::json(names, &difference),
            DiffFormat::Markdown => report::diff::markdown(names, &difference),
            DiffFormat::Html => page(report::diff::html(names, &difference)),
        };
        self.answer.write_page(place, answer)?;
        Ok(Exit::Done)
    }

    fn read(
        &self,
        program: &CommandLine,
        path: &Path,
    ) -> Result<Result<ModelOrResult, Diagnostics>, Failure> {
        let files = self.trust.files(program);
        let text = |text: &str| files.either_text("<stdin>", text, Path::new(""));
        options::given(path, text, |path| files.either(path))
    }
}

/// The paths of a file and of the files that it names.
fn named(path: &Path, file: &ModelOrResult) -> Vec<PathBuf> {
    let tables = match file {
        ModelOrResult::Model(model) => model.files.as_slice(),
        ModelOrResult::Result(_) => &[],
    };
    options::with_named(path, tables.iter().map(|(name, _)| name))
}
