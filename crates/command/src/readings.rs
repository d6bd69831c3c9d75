//! `gumption readings`

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use clap::Args;

use super::options::{AllowedFolders, opened};
use super::output::{self, AnswerPlace};
use super::{CommandLine, Exit, Failure, options};
use gumption_files::{FileReader, ModelFile};
use gumption_units::Unit;

/// Write the heading of a file of readings for a model file.
///
/// The columns are the inputs whose distribution is `readings`, with their units. Where the model has
/// conditions, each of its points has a line with the values of the conditions. Fill in the readings, and
/// give the file to `gumption run MODEL --readings FILE`.
#[derive(Debug, Args)]
pub(super) struct Readings {
    /// Write the heading for this model file; - for standard input
    #[arg(long, value_name = "MODEL", required = true)]
    template: PathBuf,
    #[command(flatten)]
    folders: AllowedFolders,
    /// Number of empty lines, for each point of the conditions [default: 1 for each point, else none]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    lines: Option<u32>,
    /// Write to FILE instead of standard output (- for standard output)
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Readings {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.model_text(name, text, folder, &[])
        };
        let files = self.folders.files(program);
        let file = opened(files, &self.template, text, |path| files.model(path, &[]))??;
        let asked = ("--output", output::to_file(self.output.as_deref()));
        let read = options::with_named(&self.template, file.files.iter().map(|(name, _)| name));
        let [output] = output::open([asked], &read)?;
        let output = output.map_or(AnswerPlace::StandardOutput, AnswerPlace::File);
        output.write(&self.table(&file)?)?;
        Ok(Exit::Done)
    }

    fn table(&self, file: &ModelFile) -> Result<String, Failure> {
        let readings = &file.readings;
        if readings.inputs.is_empty() {
            return Err(Failure::Argument(format!(
                "`{}` has no inputs with readings",
                file.source.name
            )));
        }
        let model = &file.task.model;
        let conditions: Vec<usize> = (0..model.conditions.len())
            .filter(|place| !readings.columns.contains(&model.conditions[*place].name))
            .collect();
        // a component of readings has the name of its input
        let inputs = readings.inputs.iter().filter_map(|name| {
            let own = name.split_once('/').map_or(name.as_str(), |(input, _)| input);
            let quantity = model.inputs.iter().find(|input| input.quantity.name == own)?;
            Some(heading(own, &quantity.quantity.unit))
        });
        let of_conditions = conditions.iter().map(|place| {
            let condition = &model.conditions[*place];
            heading(&condition.name, &condition.unit)
        });
        let groups: BTreeSet<&String> = readings.groups.iter().collect();
        let columns = readings.inputs.len() + groups.len();
        let groups = groups.into_iter().cloned();
        let headings: Vec<String> = of_conditions.chain(groups).chain(inputs).collect();
        let empty = ",".repeat(columns - 1);
        let mut text = headings.join(",") + "\n";
        let (mut points, mut known) = (Vec::new(), HashSet::new());
        for row in &file.task.rows {
            let values = conditions.iter().map(|place| row.conditions[*place].to_string());
            let point: Vec<String> = values.collect();
            if known.insert(point.clone()) {
                points.push(point);
            }
        }
        let lines = self.lines.unwrap_or(u32::from(!conditions.is_empty()));
        for point in points {
            for _ in 0..lines {
                let between = if point.is_empty() { "" } else { "," };
                text += &format!("{}{between}{empty}\n", point.join(","));
            }
        }
        Ok(text)
    }
}

/// A heading with the unit, which a plain number does not have.
fn heading(name: &str, unit: &Unit) -> String {
    match unit.text() {
        "" | "1" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    }
}
