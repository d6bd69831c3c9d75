//! `gumption schema`

use std::path::PathBuf;

use clap::Args;

use super::output::AnswerPlace;
use super::{Exit, Failure, output};
use gumption_files::schema;

/// Print the JSON Schema of the files, for editors.
#[derive(Debug, Args)]
pub(super) struct Schema {
    /// Write the schema to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Schema {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], &[])?;
        file.map_or(AnswerPlace::StandardOutput, AnswerPlace::File).write(&schema::text())?;
        Ok(Exit::Done)
    }
}
