//! The command line: arguments in, exit code out. One file for each subcommand.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod assumptions;
mod certificate;
mod check;
mod compare;
mod diagnostics;
mod diff;
mod exit;
mod gap;
mod gap_check;
mod help;
mod models;
mod new;
mod observe;
mod options;
mod output;
mod progress;
mod replacement;
mod run;
mod save;
mod schema;
mod signals;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use gumption_engine::model::typed::{Catalogue, CatalogueEntry};
use gumption_files::FileReader;

pub use exit::{Exit, Failure};
pub use verify::PublishedExamples;

/// Measurement uncertainty by the GUM and by Monte Carlo, side by side.
#[derive(Debug, Parser)]
#[command(name = "gumption", version, max_term_width = 100, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Evaluate a model file by GUM and by Monte Carlo and print its budget and intervals
    Run(run::Run),
    /// Test the Type B assumptions of a model file: which matter, which the readings contradict
    Assumptions(assumptions::Assumptions),
    /// Make a calibration certificate from a certificate file and its models
    Certificate(certificate::Certificate),
    /// Check a file and list all of its mistakes
    Check(check::Check),
    /// Compare results two by two (normalized errors), or those of many laboratories
    Compare(compare::Compare),
    /// Write a model file to start from: from options, or from answers to questions
    New(new::New),
    /// List the typed measurement models, or describe one
    Models(models::Models),
    /// Recompute the published examples on this machine, or compare its code paths
    Verify(verify::Verify),
    /// Say what changed between two model files or saved results, and what it did to U
    Diff(diff::Diff),
    /// Diagnose where measured data depart from a model, and which effect is missing
    Gap(gap::Gap),
    /// Check that diagnosis blindly at a case's own design: how far its answers can be trusted
    GapCheck(gap_check::GapCheck),
    /// Take amplitudes, phases and delays with their uncertainties from raw recordings
    Observe(observe::Observe),
    /// Print the JSON Schema of the files, for editors
    Schema(schema::Schema),
    /// Tell how a command is called, or what may stand in files and formulas
    Help(help::Help),
}

/// The command line with what it knows: typed measurements and published examples.
#[derive(Clone, Debug, Default)]
pub struct CommandLine {
    catalogue: Catalogue,
    published: PublishedExamples,
}

impl CommandLine {
    /// The command line with these typed measurements and published examples.
    pub fn new(catalogue: Catalogue, published: PublishedExamples) -> Self {
        Self { catalogue, published }
    }

    /// The same with one more measurement that files can name; it takes the place of one of the same
    /// name.
    #[must_use]
    pub fn with(self, entry: CatalogueEntry) -> Self {
        Self { catalogue: self.catalogue.with(entry), ..self }
    }

    /// The readers of files that may name the measurements.
    fn files(&self) -> FileReader<'_> {
        FileReader::new(&self.catalogue)
    }

    /// Runs with the arguments of the process: says what is wrong on standard error, and ends with
    /// 0 (done), 1 (the system is at fault), 2 (the arguments or files are), 3 (done, and the answer
    /// is "no" where `--fail` was given), or 130, 143 or 129 (interrupted, terminated, hung up).
    pub fn main(&self) -> ExitCode {
        signals::watch();
        let arguments = Arguments::parse();
        let result = match arguments.command {
            Command::Run(command) => command.execute(self),
            Command::Assumptions(command) => command.execute(self),
            Command::Certificate(command) => command.execute(self),
            Command::Check(command) => command.execute(self),
            Command::Compare(command) => command.execute(),
            Command::Models(command) => command.execute(self),
            Command::Verify(command) => command.execute(self),
            Command::Diff(command) => command.execute(self),
            Command::Gap(command) => command.execute(self),
            Command::GapCheck(command) => command.execute(self),
            Command::Observe(command) => command.execute(self),
            Command::Schema(command) => command.execute(),
            Command::Help(command) => command.execute(),
            Command::New(command) => command.execute(self),
        };
        match result {
            Ok(exit) => exit.code(),
            Err(failure) => failure.report(),
        }
    }
}
