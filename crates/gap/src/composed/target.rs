//! The quantities that a composed departure may act on, and what that does to the data.

use crate::diagnosis::DepartureKind;
use crate::{Case, OverridableModel};
use gumption_engine::model::formula::Formula;
use gumption_engine::model::{NumberForm, Output, Program, Quantity};
use gumption_engine::task::Row;
use gumption_inference::discrepancy::OutputSet;
use gumption_inference::model::{Effect, ModelForm};
use gumption_inference::setup::Setup;
use gumption_units::{Unit, Zero};

/// At most so many quantities that equations compute are looked at.
const MOST_QUANTITIES: usize = 24;

/// A quantity of the sim, or outputs that depart alike.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// The name of the quantity, or those of the outputs.
    pub(super) names: Vec<String>,
    /// Places among the observed outputs; none of an intermediate quantity.
    pub(super) outputs: Vec<usize>,
    /// The unit that a departure which is added is given in.
    pub(super) unit: Unit,
    /// Its prior weight, over that of a single output.
    pub(super) weight: f64,
    /// Whether one departure can be added to all of them.
    pub(super) addable: bool,
    /// Of an intermediate quantity: the model with what is added to it as its last variable, and the
    /// quantity's value.
    programs: Option<(Program, Program)>,
}

/// What a departure of a target does in rows.
#[derive(Clone, Debug)]
pub(super) struct Response {
    /// By value (row by row, outputs fastest) the derivative by what is added.
    pub(super) additive: Vec<f64>,
    /// By value the derivative by a share of the target.
    pub(super) proportional: Vec<f64>,
    /// By row the target's own value, in its unit; `None` of several outputs.
    pub(super) value: Option<Vec<f64>>,
}

impl Response {
    pub(super) fn of(&self, kind: DepartureKind) -> &[f64] {
        match kind {
            DepartureKind::Additive => &self.additive,
            DepartureKind::Proportional => &self.proportional,
        }
    }
}

/// A name that no quantity of the sim has.
pub(super) fn fresh(sim: &OverridableModel, wanted: &str) -> String {
    let taken = |name: &str| {
        sim.scope.get(name).is_some() || sim.inputs.iter().any(|i| i.quantity.name == name)
    };
    let names = std::iter::once(wanted.to_owned()).chain((2..).map(|n| format!("{wanted}_{n}")));
    let mut free = names.filter(|name| !taken(name));
    free.next().unwrap_or_default()
}

/// The unit in which differences of quantities in this unit are.
pub(super) fn of_differences(unit: &Unit) -> Unit {
    match unit.zero() {
        None => unit.clone(),
        Some(Zero::Celsius) => Unit::parse("K").unwrap_or_else(|_| Unit::one()),
        Some(_) => Unit::parse("dB").unwrap_or_else(|_| Unit::one()),
    }
}

/// All targets: observed outputs, sets of them, quantities that equations compute.
pub(super) fn targets(setup: &Setup<'_>) -> Vec<Target> {
    let (case, data) = (setup.case, &setup.data);
    let quantity = |output: usize| &case.model.outputs[data.outputs[output]].quantity;
    let of_outputs = OutputSet::all(data).into_iter().map(|OutputSet { outputs, weight }| {
        let first = quantity(outputs[0]);
        Target {
            names: outputs.iter().map(|&output| quantity(output).name.clone()).collect(),
            addable: outputs
                .iter()
                .all(|&output| quantity(output).unit.text() == first.unit.text()),
            unit: first.unit.clone(),
            programs: None,
            weight,
            outputs,
        }
    });
    of_outputs.chain(quantities(case)).collect()
}

/// The quantities that equations compute and that are no outputs.
fn quantities(case: &Case) -> Vec<Target> {
    let sim = &case.model;
    let ModelForm::Equations(equations) = &sim.maker else { return Vec::new() };
    let inner = equations.iter().filter(|(name, _)| !sim.is_output(name));
    inner.take(MOST_QUANTITIES).filter_map(|(name, _)| inner_quantity(sim, name)).collect()
}

fn inner_quantity(sim: &OverridableModel, name: &str) -> Option<Target> {
    let typing = sim.scope.get(name)?;
    let unit = match sim.numbers {
        NumberForm::Declared => Unit::one(),
        NumberForm::Coherent => {
            let dimension = typing.dimension?;
            let usual = Unit::parse(&dimension.usual_unit()).ok();
            let usual = usual.filter(|unit| unit.factor() == 1.0 && unit.dimension() == dimension);
            if typing.is_celsius() {
                Unit::parse("degC").ok()?
            } else {
                usual.unwrap_or_else(|| Unit::coherent(dimension))
            }
        }
    };
    let parameter = fresh(sim, "k");
    let formula = Formula::parse(&format!("{name} + {parameter}")).ok()?;
    let probe = Effect {
        name: "probe".to_owned(),
        parameters: vec![Quantity {
            name: parameter,
            unit: of_differences(&unit),
            about: String::new(),
        }],
        overrides: vec![(name.to_owned(), formula)],
    };
    let with_shift = sim.program(&[&probe]).ok()?;
    let own = Quantity { name: name.to_owned(), unit: unit.clone(), about: String::new() };
    let value = OverridableModel { outputs: vec![Output::new(own)], ..sim.clone() };
    let value = value.program(&[]).ok()?;
    Some(Target {
        names: vec![name.to_owned()],
        outputs: Vec::new(),
        weight: 1.0,
        unit,
        addable: true,
        programs: Some((with_shift, value)),
    })
}

impl Target {
    /// What departures do in the rows of the data.
    pub(super) fn in_data(&self, setup: &Setup<'_>) -> Response {
        let data = &setup.data;
        let rows: Vec<Row> = data
            .points
            .iter()
            .map(|point| {
                let first = point.rows.first().copied().unwrap_or(0);
                setup.case.task.rows[data.ids[first]].clone()
            })
            .collect();
        let nominal: Vec<Vec<f64>> =
            data.points.iter().map(|point| point.tangent.touching.clone()).collect();
        let at_points = self.response(setup, &rows, &nominal);
        let outputs = data.outputs.len();
        let spread = |values: &[f64]| -> Vec<f64> {
            let of =
                |&point: &usize| values[point * outputs..(point + 1) * outputs].iter().copied();
            data.point_of.iter().flat_map(of).collect()
        };
        Response {
            additive: spread(&at_points.additive),
            proportional: spread(&at_points.proportional),
            // by point, as the functions are
            value: at_points.value,
        }
    }

    /// What departures do in rows, of which `nominal` is what the model says of the observed outputs.
    pub(super) fn response(
        &self,
        setup: &Setup<'_>,
        rows: &[Row],
        nominal: &[Vec<f64>],
    ) -> Response {
        let outputs = setup.data.outputs.len();
        let mut response = Response {
            additive: vec![0.0; rows.len() * outputs],
            proportional: vec![0.0; rows.len() * outputs],
            value: None,
        };
        match &self.programs {
            None => {
                for (row, sims) in nominal.iter().enumerate() {
                    for &output in &self.outputs {
                        response.additive[row * outputs + output] = 1.0;
                        response.proportional[row * outputs + output] = sims[output];
                    }
                }
                if let [output] = self.outputs[..] {
                    response.value = Some(nominal.iter().map(|sims| sims[output]).collect());
                }
            }
            Some((with_shift, value)) => {
                let mut values = Vec::with_capacity(rows.len());
                for (row, of) in rows.iter().enumerate() {
                    let mut variables = of.estimates();
                    let (own, _) = value.gradients(&variables);
                    let own = own.first().copied().unwrap_or(f64::NAN);
                    values.push(own);
                    let shift = variables.len();
                    variables.push(0.0);
                    let (_, gradients) = with_shift.gradients(&variables);
                    for (n, &output) in setup.data.outputs.iter().enumerate() {
                        let slope = gradients[output][shift];
                        response.additive[row * outputs + n] = slope;
                        response.proportional[row * outputs + n] = slope * own;
                    }
                }
                response.value = Some(values);
            }
        }
        response
    }
}
