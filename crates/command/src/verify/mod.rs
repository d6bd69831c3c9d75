//! `gumption verify`: the published examples recomputed (ISO/IEC 17025, 7.11), and with `--paths`
//! this machine's code paths compared.

mod examples;
mod paths;
mod recompute;

use std::sync::atomic::Ordering;

use clap::{Args, ValueEnum};

use super::options::{AnswerOptions, Interactive, Threads};
use super::{CommandLine, Exit, Failure, progress, signals};
pub use examples::PublishedExamples;
use gumption_analysis::verification::{PublishedVerdict, RecomputedExample};
use gumption_report::verification;
use recompute::Machine;

/// Recompute the published examples on this machine, or compare its code paths.
#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Instead, run every code path of this machine and print the hash over all trials of each
    #[arg(long, conflicts_with_all = ["format", "output"])]
    paths: bool,
    #[command(flatten)]
    compared: paths::Paths,
    #[command(flatten)]
    answer: AnswerOptions<VerifyFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    threads: Threads,
    /// Exit with code 3 if a value differs, or with --paths a hash
    #[arg(long)]
    fail: bool,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum VerifyFormat {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each published value
    Csv,
    /// A Markdown page for the records, as GitHub shows it
    Markdown,
    /// An HTML page for the records, in one file
    Html,
}

impl Verify {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let threads = self.threads.count();
        if self.paths {
            return self.compared.execute(program, threads, self.fail);
        }
        let place = self.answer.open(&[])?;
        let stop = signals::stop_flag();
        let examples = program.published.with_values().map_err(Failure::System)?;
        let bar = progress::counted(examples.len() as u64, "examples", self.answer.quiet);
        let machine = Machine { threads, stop: &stop };
        let mut found: Vec<RecomputedExample> = Vec::new();
        for example in examples {
            let recomputed = recompute::recompute(example, machine);
            if stop.load(Ordering::Relaxed) {
                break;
            }
            found.push(recomputed);
            bar.inc(1);
        }
        bar.finish_and_clear();
        let answer = match self.answer.format {
            VerifyFormat::Table => verification::table(&found),
            VerifyFormat::Json => verification::json(&found),
            VerifyFormat::Csv => verification::csv(&found),
            VerifyFormat::Markdown => verification::markdown(&found),
            VerifyFormat::Html => page(verification::html(&found)),
        };
        place.write(&answer)?;
        if stop.load(Ordering::Relaxed) {
            return Ok(Exit::Interrupted);
        }
        let differs =
            found.iter().flat_map(|e| &e.rows).any(|row| row.verdict == PublishedVerdict::Diff);
        Ok(if differs && self.fail { Exit::No } else { Exit::Done })
    }
}
