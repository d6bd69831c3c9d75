//! `gumption import`

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use serde_json::Value;

use super::check::Mistake;
use super::exit::{say, say_line};
use super::options::Format;
use super::output::{AnswerPlace, Destination};
use super::{Exit, Failure, diagnostics, output};
use gumption_foreign::{
    Coefficients, ImportOptions, ImportedBudget, Question, RefusedBudget, import_budget,
};
use gumption_report::words::{Language, sentence};
use gumption_report::{budget_template, pretty};

/// Convert an uncertainty budget in a spreadsheet into a model file.
///
/// The budget is a table with a row of headings and a row for each quantity. Headings are
/// recognized in English, German, French and Spanish; `--column` sets the meaning of other columns.
/// An equation on the sheet, such as `R = U/I`, is the model; without one the result is the sum of
/// the quantities times their sensitivity coefficients. Missing or ambiguous information is an
/// error, which names the possible readings and the option that decides. A result on the sheet is
/// compared with the model: a difference is an error.
#[derive(Debug, Args)]
pub(super) struct Import {
    /// The budget: a CSV or XLSX file
    #[arg(required_unless_present = "template")]
    file: Option<PathBuf>,
    /// The sheet of the workbook, if several contain a budget
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Meaning of a column, given by letter, number or heading: estimate=C, U="Expanded", k=G,
    /// ignore=H
    #[arg(long, value_name = "NAME=COLUMN", value_parser = pair)]
    column: Vec<(String, String)>,
    /// The unit of a column of numbers: U=mV
    #[arg(long, value_name = "NAME=UNIT", value_parser = pair)]
    column_unit: Vec<(String, String)>,
    /// Meaning of a row, given by its number: result=12, ignore=13,14, heading=3, constant=7
    #[arg(long, value_name = "KIND=ROW", value_parser = pair)]
    row: Vec<(String, String)>,
    /// The unit of the result
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// The estimate of the result, if the sheet states none; `sum` for the sum of the products
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    estimate: Option<String>,
    /// The coverage factor of expanded uncertainties, if the sheet states none
    #[arg(long, value_name = "NUMBER", value_parser = factor)]
    k: Option<f64>,
    /// The distribution of rows that name none
    #[arg(long, value_name = "NAME")]
    distribution: Option<String>,
    /// Meaning of coefficients without units: in units of the result per unit of the quantity
    /// (units), plain numbers (ratios), or 1 if there is no column of them (one)
    #[arg(long, value_name = "KIND", value_parser = coefficients)]
    coefficients: Option<Coefficients>,
    /// The equation of the result, `R = U/I`, instead of the one on the sheet
    #[arg(long, value_name = "EQUATION")]
    equation: Option<String>,
    /// The equation is between the numbers in the units of the sheet
    #[arg(long)]
    numbers: bool,
    /// Save these options in FILE.columns.json next to the sheet, from which they are read the next
    /// time
    #[arg(long, conflicts_with = "template")]
    keep_columns: bool,
    /// Write an empty workbook to fill in, which can be imported without options
    #[arg(long, value_name = "FILE", conflicts_with_all = ["file", "output"])]
    template: Option<PathBuf>,
    /// Write the model file here instead of to standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The format of the answer: the model file (table), or json with notes and questions
    #[arg(long, value_enum, default_value_t = Format::Table, hide_possible_values = true, value_name = "table|json")]
    format: Format,
    /// Do not report how the sheet was read
    #[arg(long)]
    quiet: bool,
}

/// The answer for programs.
#[derive(Debug, Serialize)]
struct ImportAnswer<'a> {
    ok: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<Value>,
    notes: Vec<String>,
    errors: Vec<Mistake>,
    questions: &'a [Question],
}

fn pair(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as estimate=C")?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

fn factor(text: &str) -> Result<f64, String> {
    let known = text.parse::<f64>().ok().filter(|k| *k > 0.0 && k.is_finite());
    known.ok_or_else(|| "a coverage factor is a number above 0, such as 2".to_owned())
}

fn coefficients(text: &str) -> Result<Coefficients, String> {
    match text {
        "units" => Ok(Coefficients::Units),
        "ratios" => Ok(Coefficients::Ratios),
        "one" => Ok(Coefficients::One),
        _ => Err("it is units, ratios or one".to_owned()),
    }
}

/// The file next to a sheet that keeps the options for it.
fn kept_beside(sheet: &Path) -> PathBuf {
    let mut name = OsString::from(sheet);
    name.push(".columns.json");
    PathBuf::from(name)
}

impl Import {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        if let Some(template) = &self.template {
            let book = budget_template().map_err(|error| Failure::System(error.to_string()))?;
            let [file] = output::open([("--template", Some(template.as_path()))], &[])?;
            let place = file.map_or(AnswerPlace::StandardOutput, AnswerPlace::File);
            place.write_with(|out| out.write_all(&book))?;
            return Ok(Exit::Done);
        }
        let Some(sheet) = &self.file else {
            return Err(Failure::Argument("`import` needs a file".to_owned()));
        };
        if self.format == Format::Csv {
            return Err(Failure::Argument("`import` answers as table or json".into()));
        }
        let (options, used) = self.options(sheet)?;
        let read = [sheet.clone()];
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], &read)?;
        let result = import_budget(sheet, &options);
        if let Ok(ImportedBudget { notes, .. }) = &result
            && !self.quiet
        {
            let notes = notes.iter().map(|note| sentence(note, Language::English));
            used.iter().cloned().chain(notes).for_each(|note| say_line(&format!("note: {note}")));
        }
        let place = file.map_or(AnswerPlace::StandardOutput, AnswerPlace::File);
        match (result, self.format) {
            (Ok(made), Format::Json) => {
                let model = serde_json::from_str(&made.text).ok();
                let (errors, questions) = (Vec::new(), &[][..]);
                let notes = made.notes.iter().map(|note| sentence(note, Language::English));
                let notes = notes.collect();
                let answer = ImportAnswer { ok: true, model, notes, errors, questions };
                place.write(&pretty(&answer))?;
            }
            (Ok(made), _) => place.write(&made.text)?,
            (Err(refused), Format::Json) => return self.refused(place, &refused),
            (Err(RefusedBudget { diagnostics, .. }), _) => {
                return Err(Failure::Diagnostics(diagnostics));
            }
        }
        if self.keep_columns {
            let kept = kept_beside(sheet);
            AnswerPlace::File(Destination::open(&kept)?).write(&options.to_json())?;
        }
        Ok(Exit::Done)
    }

    /// The options, completed by those in the file next to the sheet, and a note about these.
    fn options(&self, sheet: &Path) -> Result<(ImportOptions, Option<String>), Failure> {
        let own = ImportOptions {
            sheet: self.sheet.clone(),
            columns: self.column.clone(),
            column_units: self.column_unit.clone(),
            rows: self.row.clone(),
            unit: self.unit.clone(),
            estimate: self.estimate.clone(),
            k: self.k,
            distribution: self.distribution.clone(),
            coefficients: self.coefficients,
            equation: self.equation.clone(),
            numbers: self.numbers,
        };
        let kept = kept_beside(sheet);
        let Ok(text) = std::fs::read_to_string(&kept) else { return Ok((own, None)) };
        let wrong = |error| Failure::Argument(format!("{}: {error}", kept.display()));
        let options = own.or(ImportOptions::from_json(&text).map_err(wrong)?);
        Ok((options, Some(format!("the options of `{}` are used", kept.display()))))
    }

    /// The errors and questions as an answer for programs.
    fn refused(&self, place: AnswerPlace, refused: &RefusedBudget) -> Result<Exit, Failure> {
        let errors = refused.diagnostics.0.iter().map(Mistake::from).collect();
        let questions = &refused.questions;
        let answer = ImportAnswer { ok: false, model: None, notes: Vec::new(), errors, questions };
        place.write(&pretty(&answer))?;
        if !self.quiet {
            say(&diagnostics::render(&refused.diagnostics, true));
        }
        Ok(Exit::Wrong)
    }
}
