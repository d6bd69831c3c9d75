//! One line for each input, in full precision, for spreadsheets.

use super::PlanReport;
use crate::csv::{number, of_records, text};

/// The inputs as comma-separated values: the present uncertainty of each, the one required of it
/// alone, and the one in the cheapest plan.
pub fn csv(report: &PlanReport<'_>) -> String {
    let count = |value: Option<u64>| value.map(|value| value.to_string()).unwrap_or_default();
    of_records(|writer| {
        writer.write_record([
            "input",
            "unit",
            "standard_uncertainty",
            "needed",
            "readings",
            "readings_needed",
            "planned",
            "planned_readings",
            "cost",
        ])?;
        report.plan.inputs.iter().try_for_each(|need| {
            let planned =
                report.plan.cheapest.as_ref().and_then(|plan| {
                    plan.inputs.iter().find(|input| input.variable == need.variable)
                });
            writer.write_record([
                text(report.name(need.variable)),
                text(report.unit(need.variable)),
                number(Some(need.standard_uncertainty)),
                number(need.needed),
                count(need.readings),
                count(need.readings_needed),
                number(planned.map(|of| of.to)),
                count(planned.and_then(|of| of.readings)),
                number(planned.map(|of| of.cost)),
            ])
        })
    })
}
