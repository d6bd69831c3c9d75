//! What the simulator of a case is run with.

use gumption_emulator::{SimulatorCase, SimulatorCondition, SimulatorQuantity};
use gumption_engine::model::Quantity;
use gumption_engine::task::Row;

use crate::Case;

/// The parameters, conditions and outputs of a case's simulator in some rows, such as those of the data
/// (`case.task.rows`); `None` of a case without one.
pub fn simulator_case(case: &Case, rows: &[Row]) -> Option<SimulatorCase> {
    let simulator = case.simulator.as_ref()?;
    let conditions = case.model.conditions.iter().enumerate();
    let (given, returned) = (conditions.clone(), conditions);
    let mut parameters: Vec<SimulatorQuantity> =
        case.model.inputs.iter().map(|input| quantity(&input.quantity)).collect();
    let mut effects: Vec<_> =
        case.candidates.iter().filter_map(|of| Some((of.simulator?, of))).collect();
    effects.sort_by_key(|(number, _)| *number);
    parameters.extend(effects.iter().flat_map(|(_, of)| of.effect.parameters.iter().map(quantity)));
    debug_assert!(parameters.iter().map(|parameter| &parameter.name).eq(simulator.space().names()));
    // behind the outputs stands the number of the row
    let outputs = case.described()..case.model.conditions.len().checked_sub(1)?;
    Some(SimulatorCase {
        parameters,
        conditions: given
            .take(case.measured())
            .map(|(place, condition)| SimulatorCondition {
                quantity: quantity(condition),
                values: rows.iter().map(|row| row.conditions[place]).collect(),
            })
            .collect(),
        outputs: returned
            .filter(|(place, _)| outputs.contains(place))
            .map(|(_, output)| quantity(output))
            .collect(),
        rows: rows.len(),
    })
}

fn quantity(of: &Quantity) -> SimulatorQuantity {
    SimulatorQuantity { name: of.name.clone(), unit: of.unit.to_string() }
}
