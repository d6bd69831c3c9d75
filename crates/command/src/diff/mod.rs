//! `gumption diff`

mod page;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::{Exit, Failure, options, output};
use gumption_files as file;
use gumption_files::{ModelOrResult, Problems};

/// Compare two model files, two saved results, or one with the other.
#[derive(Debug, Args)]
pub(super) struct Diff {
    /// The first file, a model or what `run --save` wrote; - for standard input
    a: PathBuf,
    /// The second one
    b: PathBuf,
    /// Format of the answer
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// Write the answer to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Nothing on standard error but mistakes
    #[arg(long)]
    quiet: bool,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page of text for people
    Table,
    /// The whole answer for programs
    Json,
}

impl Diff {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let standard = |path: &Path| path == Path::new("-");
        if standard(&self.a) && standard(&self.b) {
            return Err(Failure::Argument("only one of the files can be standard input".into()));
        }
        let (first, second) = match (read(&self.a)?, read(&self.b)?) {
            (Ok(first), Ok(second)) => (first, second),
            // the mistakes of both at once
            (first, second) => {
                let found = [first.err(), second.err()].into_iter().flatten();
                return Err(Problems(found.flat_map(|problems| problems.0).collect()).into());
            }
        };
        let difference = file::difference(&first, &second)?;
        let names = [&first, &second].map(ModelOrResult::name);
        let answer = match self.format {
            Format::Table => page::table(names, &difference),
            Format::Json => page::json(names, &difference),
        };
        output::write(&answer, self.output.as_deref())?;
        Ok(Exit::Done)
    }
}

fn read(path: &Path) -> Result<Result<ModelOrResult, Problems>, Failure> {
    Ok(if path == Path::new("-") {
        file::read_either_text("<stdin>", &options::standard_input()?, Path::new(""))
    } else {
        file::read_either(path)
    })
}
