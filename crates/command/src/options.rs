//! Options that several commands share.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::Failure;
use gumption_engine::task::{StoppingRule, Trials};
use gumption_files::bytes;
use gumption_report::Column;

/// The format of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// A page of text for people
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each output
    Csv,
}

/// The format of an answer that goes to people in many ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Page {
    /// A page of text for people
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each output
    Csv,
    /// A page as GitHub shows it
    Markdown,
    /// A LaTeX file for `article` with `booktabs` and `siunitx`
    Latex,
    /// A page with figures for a browser and for print, in one file
    Html,
    /// A workbook with the budget in live formulas
    Xlsx,
}

/// How the answer is given.
#[derive(Debug, Args)]
pub(super) struct Answer {
    /// Format of the answer
    #[arg(long, value_enum, default_value = "table")]
    pub(super) format: Format,
    /// Write the answer to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// No progress, notes or warnings on standard error
    #[arg(long)]
    pub(super) quiet: bool,
}

/// A number of threads; 0 means all.
pub(super) fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(count @ 1..=1024) => Ok(count),
        _ => Err("a whole number from 1 to 1024 is needed".to_owned()),
    }
}

/// A number of trials.
pub(super) fn trials(text: &str) -> Result<Trials, String> {
    const NEEDED: &str = "a whole number (0, or from 2 to 1e12) or `adaptive` is needed";
    if text == "adaptive" {
        return Ok(Trials::Adaptive);
    }
    let value: f64 = text.parse().map_err(|_| NEEDED.to_owned())?;
    if value.fract() == 0.0 && (0.0..=1e12).contains(&value) && value != 1.0 {
        Ok(Trials::Fixed(value as u64))
    } else {
        Err(NEEDED.to_owned())
    }
}

/// A size of memory: bytes, or with K, M, G (or KiB, MiB, GiB).
pub(super) fn memory(text: &str) -> Result<usize, String> {
    let needed = || "a size such as 64M, 512MiB or 1G is needed".to_owned();
    let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let number: usize = number.parse().map_err(|_| needed())?;
    let factor: usize = match unit.trim().trim_end_matches("iB").trim_end_matches('B') {
        "" => 1,
        "K" | "k" => 1 << 10,
        "M" => 1 << 20,
        "G" => 1 << 30,
        _ => return Err(needed()),
    };
    number
        .checked_mul(factor)
        .filter(|bytes| *bytes >= 1 << 20)
        .ok_or_else(|| "at least 1 MiB is needed for kept values".to_owned())
}

/// A further column of the budget, by its name.
pub(super) fn columns() -> impl TypedValueParser<Value = Column> {
    PossibleValuesParser::new(Column::ALL.map(Column::name))
        .try_map(|name| Column::named(&name).ok_or("there is no such column"))
}

/// When an adaptive run stops.
pub(super) fn rule() -> impl TypedValueParser<Value = StoppingRule> {
    PossibleValuesParser::new(StoppingRule::ALL.map(StoppingRule::name))
        .try_map(|name| StoppingRule::named(&name).ok_or("there is no such rule"))
}

/// A coverage probability.
pub(super) fn probability(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(p) if p > 0.0 && p < 1.0 => Ok(p),
        _ => Err("a probability between 0 and 1 is needed, such as 0.95".to_owned()),
    }
}

/// A replacement of an input.
pub(super) fn replacement(text: &str) -> Result<gumption_files::Override, String> {
    gumption_files::Override::parse(text)
        .ok_or_else(|| "NAME=VALUE or NAME.field=VALUE is needed".to_owned())
}

/// A model file's text: from a path, or from standard input for `-`.
pub(super) fn standard_input() -> Result<String, Failure> {
    let bytes = bytes::of(std::io::stdin(), bytes::MOST)
        .map_err(|message| Failure::Argument(format!("cannot read standard input: {message}")))?;
    String::from_utf8(bytes)
        .map_err(|_| Failure::Argument("standard input is not UTF-8 text".to_owned()))
}
