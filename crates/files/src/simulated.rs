//! Outputs that are columns of the data: somebody else's simulation.

use super::conditions::Conditions;
use super::observations::Observations;
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::table::Table;
use gumption_units::Unit;

/// Columns of somebody else's simulation: each becomes a condition, and the output is that.
pub(super) fn simulated(
    root: &Object<'_>,
    observations: &Observations,
    table: &Table,
    conditions: &mut Conditions,
) -> Vec<(String, String)> {
    let mut simulated: Vec<(String, String)> = Vec::new();
    let outputs = root.get("outputs").map(|member| &member.value);
    for column in &observations.columns {
        let Some(name) = &column.simulated else { continue };
        let output = &column.output;
        let elsewhere = if root.get("model").is_some() {
            Some(("the typed model", "take `model` or `sim` out"))
        } else if has_equation(root, output) {
            Some(("its equation", "take one of them out"))
        } else {
            None
        };
        if let Some((other, remedy)) = elsewhere {
            let reason = format!(
                "`{output}` cannot come both from {other} and from the column `{name}`; {remedy}"
            );
            root.log.report(&column.place, DiagnosticKind::Observation { reason });
            continue;
        }
        simulated.push((output.clone(), name.clone()));
        if conditions.quantities.iter().any(|condition| condition.name == *name) {
            // a column that two outputs name has been reported
            if simulated.iter().filter(|(_, known)| known == name).count() == 1 {
                let reason = format!(
                    "the column `{name}` is a condition already; as a simulation of `{output}` \
                     it can be read by its name, so take it out of `conditions`"
                );
                root.log.report(&column.place, DiagnosticKind::Observation { reason });
            }
            continue;
        }
        // of the data it is known; rows to predict at may be without it
        if table.column(name).is_none() {
            let reason = format!("for the simulation of `{output}` {}", table.no_column(name));
            root.log.report(&column.place, DiagnosticKind::Observation { reason });
            continue;
        }
        let unit = match outputs.map(|node| &node.value) {
            Some(Json::Object(members)) => members
                .iter()
                .find(|member| member.key == column.output)
                .and_then(|member| {
                    Object::new(root.log, "an output", &member.value, &member.key_span)
                })
                .and_then(|object| object.text("unit").and_then(|unit| root.log.unit(unit).ok())),
            _ => None,
        };
        conditions.add_column(table, name, unit.unwrap_or_else(Unit::one), &column.place);
    }
    simulated
}

/// Whether the observations name a column with somebody else's simulation, be it right or not.
pub(super) fn names_simulation(root: &Object<'_>) -> bool {
    let observations = root.get("observations").map(|member| &member.value);
    let columns = observations.map_or(&[][..], members).iter().find(|m| m.key == "columns");
    let columns = columns.map_or(&[][..], |member| members(&member.value));
    columns.iter().any(|column| members(&column.value).iter().any(|m| m.key == "sim"))
}

/// Whether an equation computes the quantity.
fn has_equation(root: &Object<'_>, name: &str) -> bool {
    let equations = root.get("equations").map_or(&[][..], |m| members(&m.value));
    equations.iter().any(|member| member.key == name)
}

/// The members of an object; none of anything else.
fn members(node: &Node) -> &[Member] {
    match &node.value {
        Json::Object(members) => members,
        _ => &[],
    }
}
