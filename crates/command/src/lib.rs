//! The command line: arguments in, exit code out. One file for each subcommand.

mod assumptions;
mod certificate;
mod check;
mod compare;
mod diff;
mod exit;
mod gap;
mod gap_check;
mod models;
mod observe;
mod options;
mod output;
mod problems;
mod progress;
mod run;
mod save;
mod schema;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

pub use exit::{Exit, Failure};

/// Measurement uncertainty by the GUM and by Monte Carlo, side by side.
#[derive(Debug, Parser)]
#[command(name = "gumption", version, max_term_width = 100)]
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
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match arguments.command {
        Command::Run(command) => command.execute(),
        Command::Assumptions(command) => command.execute(),
        Command::Certificate(command) => command.execute(),
        Command::Check(command) => command.execute(),
        Command::Compare(command) => command.execute(),
        Command::Models(command) => command.execute(),
        Command::Verify(command) => command.execute(),
        Command::Diff(command) => command.execute(),
        Command::Gap(command) => command.execute(),
        Command::GapCheck(command) => command.execute(),
        Command::Observe(command) => command.execute(),
        Command::Schema(command) => command.execute(),
    };
    match result {
        Ok(exit) => exit.code(),
        Err(failure) => failure.report(),
    }
}
