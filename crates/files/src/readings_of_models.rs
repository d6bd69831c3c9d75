//! One file of readings for the model files of a certificate.

use super::model_readings::ModelReadings;
use super::reading_columns::why_not;
use super::readings_file::ReadingsFile;
use gumption_engine::task::Task;
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::listed;

/// A model file of a certificate with what it has taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModelOfReadings<'m> {
    /// The name of the file.
    pub(super) name: &'m str,
    pub(super) task: &'m Task,
    pub(super) readings: &'m ModelReadings,
}

/// Reports columns that no model has taken, and columns that more than one could mean.
pub(super) fn check(log: &Collector, file: &ReadingsFile, models: &[ModelOfReadings<'_>]) {
    for (index, heading) in file.table.columns().iter().enumerate() {
        if let Some(reason) = reason(heading, models) {
            log.report_at(file.table.heading(index), DiagnosticKind::Table { reason });
        }
    }
}

fn reason(heading: &str, models: &[ModelOfReadings<'_>]) -> Option<String> {
    let models_with = |list: fn(&ModelReadings) -> &[String]| {
        models.iter().filter(move |model| list(model.readings).iter().any(|known| known == heading))
    };
    let with_readings: Vec<String> =
        models_with(|readings| &readings.taken).map(|model| format!("`{}`", model.name)).collect();
    let with_condition: Vec<&str> =
        models_with(|readings| &readings.conditions).map(|model| model.name).collect();
    if let [first, _, ..] = with_readings.as_slice() {
        let example = format!("{}:{heading}", first.trim_matches('`'));
        let both = listed(&with_readings, " and ");
        return Some(format!(
            "`{heading}` is an input of {both}; write the name of the model file before it, as in `{example}`"
        ));
    }
    if with_condition.is_empty() {
        return with_readings.is_empty().then(|| unknown(heading, models));
    }
    // its lines would be those of one point
    let without = models
        .iter()
        .find(|model| !model.readings.taken.is_empty() && !with_condition.contains(&model.name))?;
    Some(format!(
        "`{heading}` is a condition of `{}` and not of `{}`, which has the readings `{}`; nothing says to \
         which of its lines they belong",
        with_condition.first()?,
        without.name,
        without.readings.taken.first()?
    ))
}

/// Why no model has a place for a column.
fn unknown(heading: &str, models: &[ModelOfReadings<'_>]) -> String {
    let (own, text) = match heading.rsplit_once(':') {
        Some((model, text)) => (Some(model.trim()), text),
        None => (None, heading),
    };
    if let Some(own) = own.filter(|own| models.iter().all(|model| model.name != *own)) {
        let names: Vec<String> = models.iter().map(|model| format!("`{}`", model.name)).collect();
        return format!("the certificate has no model file `{own}`; it has {}", names.join(", "));
    }
    let models: Vec<&ModelOfReadings<'_>> =
        models.iter().filter(|model| own.is_none_or(|own| own == model.name)).collect();
    let name = gumption_text::column_heading::bare(text);
    let is_input = models.iter().any(|model| {
        model.task.model.inputs.iter().any(|input| input.quantity.name == name)
            || model.task.variables.iter().any(|variable| variable.name == name)
    });
    let inputs: Vec<String> =
        models.iter().flat_map(|model| model.readings.inputs.iter().cloned()).collect();
    let conditions = models.iter().flat_map(|model| &model.task.model.conditions);
    let conditions: Vec<String> = conditions.map(|condition| condition.name.clone()).collect();
    why_not(name, is_input, &inputs, &conditions)
}
