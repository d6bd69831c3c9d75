//! One line for each variant of the evaluation, in full precision, for spreadsheets.

use super::AuditReport;
use crate::csv::{number, of_records, text};
use gumption_assumptions::{VariantChange, VariantFigures};

const COLUMNS: [&str; 10] = [
    "output",
    "unit",
    "input",
    "variant",
    "kept",
    "standard_uncertainty",
    "low",
    "high",
    "change_of_half_length",
    "numerical_standard_error",
];

/// The variants as comma-separated values: a header, for each output the baseline, then for each
/// input its other shapes, its width halved and doubled. An empty cell stands for what is not
/// defined.
pub fn csv(report: &AuditReport<'_>) -> String {
    let task = report.task;
    let conditions = task.model.conditions.iter().filter(|_| task.swept);
    let names = conditions.map(|condition| text(&condition.name));
    let mut records: Vec<Vec<String>> = vec![names.chain(COLUMNS.map(str::to_owned)).collect()];
    for row in &report.audit.rows {
        let at = row.conditions.iter().filter(|_| task.swept).map(|value| number(Some(*value)));
        let at: Vec<String> = at.collect();
        for (output, of) in task.model.outputs.iter().zip(&row.outputs) {
            let mut record = |of_input: [&str; 3],
                              figures: Option<&VariantFigures>,
                              moved: Option<&VariantChange>| {
                let quantity = &output.quantity;
                let mut cells = at.clone();
                cells.extend([text(&quantity.name), text(quantity.unit.text())]);
                cells.extend(of_input.map(text));
                let interval = figures.map(|figures| figures.symmetric_interval);
                cells.extend([
                    number(figures.and_then(|figures| figures.standard_uncertainty)),
                    number(interval.map(|[low, _]| low)),
                    number(interval.map(|[_, high]| high)),
                    number(moved.and_then(|moved| moved.change)),
                    number(moved.and_then(|moved| moved.error)),
                ]);
                records.push(cells);
            };
            record(["", "baseline", ""], Some(&of.baseline), None);
            for input in &of.inputs {
                let name = report.name(input.variable);
                for other in &input.alternatives {
                    let what = [name, other.distribution.name(), other.kept.name()];
                    record(what, other.moved.figures.as_ref(), Some(&other.moved));
                }
                for (width, of) in [("halved", &input.halved), ("doubled", &input.doubled)] {
                    if let Some(of) = of {
                        record([name, width, ""], of.figures.as_ref(), Some(of));
                    }
                }
            }
        }
    }
    of_records(|writer| records.iter().try_for_each(|record| writer.write_record(record)))
}
