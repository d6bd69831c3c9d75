//! `gumption import`

use std::path::PathBuf;

use clap::Args;

use super::exit::say_line;
use super::output::Place;
use super::{Exit, Failure, output};
use gumption_foreign::import_budget_sheet;

/// Make a model file of a budget in a spreadsheet (CSV, or the sheet of an XLSX file that holds one), or of a
/// suncal project (YAML).
///
/// Columns are recognized in English and German: quantity, estimate, unit, +-, distribution, divisor,
/// sensitivity coefficient, degrees of freedom. An equation on the sheet, such as `R = U/I`, is taken;
/// without one the model is the linear one of the sensitivity coefficients. What was found, and what
/// had to be guessed, is said on standard error.
#[derive(Debug, Args)]
pub(super) struct Import {
    /// The budget: a CSV, XLSX or YAML file
    file: PathBuf,
    /// The sheet of the workbook, where several hold a budget
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Write the model file here instead of to standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Do not say what was found and what was guessed
    #[arg(long)]
    quiet: bool,
}

impl Import {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let read = [self.file.clone()];
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], &read)?;
        let budget = import_budget_sheet(&self.file, self.sheet.as_deref())?;
        if !self.quiet {
            for said in &budget.understood {
                say_line(&format!("understood: {said}"));
            }
            for said in &budget.guessed {
                say_line(&format!("guessed: {said}"));
            }
        }
        file.map_or(Place::StandardOutput, Place::File).write(&budget.text)?;
        Ok(Exit::Done)
    }
}
