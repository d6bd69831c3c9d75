//! Two evaluations compared: what changed between them, and how much of the change of the expanded
//! uncertainty each change explains.
//!
//! # How the change is shared out
//!
//! The causes are the inputs (component by component), the declared correlations, the coverage and
//! the model. The part of a cause in the change of u^2, and in the change of k, is its Shapley
//! value: the change that it adds when the causes take effect one after the other, averaged over
//! all orders. If only standard uncertainties change, this is the change of the input's own
//! contribution (c u)^2 plus half the change of each of its correlation terms. The effect of
//! changed estimates on sensitivity coefficients, and joint effects of causes, are shared equally
//! among them. The part in the change of U = k u is then
//!
//! ```text
//! mean(k) * part(u^2) / (u_A + u_B) + mean(u) * part(k)
//! ```
//!
//! with the means of both files' values. These parts sum to U_B - U_A exactly, whatever the order
//! of the inputs in the files.
//!
//! If the law of propagation is not valid (JCGM 101, clause 8), this is not the change of the
//! stated result: the half-lengths of the trials' intervals are given in addition ([`add_trials`]).
//!
//! # Tasks and saved results
//!
//! If the model changed, inputs that only the first file has lose their uncertainty before the
//! model changes, and inputs that only the second file has get theirs after it; the average is
//! taken over changing the model first and changing it last.
//!
//! A saved result has no equations, but sensitivity coefficients: u^2 is a sum of contributions c u
//! and of their correlation terms ([`compare_linear`]). The part of an input is then that of its
//! whole contribution, whether its uncertainty or its sensitivity coefficient changed, and that of
//! its degrees of freedom. An input without sensitivity coefficients is listed if it changed,
//! because the outputs may depend on it by second-order terms. A task that is compared with a saved
//! result is evaluated and linearized in the same way ([`LinearResult::of_task`]).

mod attribution;
mod contributions;
mod linear;
mod mixture;
mod saved;
mod trials;

pub use linear::{LinearOutput, LinearResult, SeveralRows};
pub use saved::compare_linear;
pub use trials::{ByTrials, add_trials};

use std::collections::{HashMap, HashSet};

use attribution::shapley;
use gumption_engine::propagate::gum;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::task::{Row, Task};
use gumption_units::Unit;
use mixture::{Cause, Common, Mixture};

/// Relative changes of U below this are rounding.
const ROUNDING: f64 = 1e-14;

/// What differs between two evaluations.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Changes of the model, of conditions and settings, one sentence each.
    pub changes: Vec<String>,
    /// Whether rows of conditions are compared.
    pub swept: bool,
    /// One entry for each row of conditions that both have; a single one without conditions.
    pub rows: Vec<RowDifference>,
}

/// The outputs of a row that both files have.
#[derive(Clone, Debug, PartialEq)]
pub struct RowDifference {
    /// Names, values and units of the conditions.
    pub conditions: Vec<(String, f64, String)>,
    /// The outputs.
    pub outputs: Vec<OutputDifference>,
}

/// The change of an output's expanded uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputDifference {
    /// The output.
    pub name: String,
    /// The unit of the first file, used for all values.
    pub unit: String,
    /// U by the law of propagation in both files; `None` if it is not defined.
    pub expanded: [Option<f64>; 2],
    /// The results of the trials of both files; `None` without trials.
    pub by_trials: [Option<ByTrials>; 2],
    /// The inputs in the order of the files, then all other changes.
    pub parts: Vec<ChangePart>,
}

/// The cause of a part of the change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChangeCause {
    /// An input, or a component of one.
    Input(String),
    /// The declared correlation coefficients.
    Correlations,
    /// Coverage probability or factor.
    Coverage,
    /// The equations or the typed model.
    Model,
    /// The rest that the inputs of saved results do not explain.
    Rest,
}

/// A part of the change.
#[derive(Clone, Debug, PartialEq)]
pub struct ChangePart {
    /// Its cause.
    pub due: ChangeCause,
    /// The state of an input in both files; `None` if it is absent.
    pub states: [Option<InputState>; 2],
    /// Change of U; `None` if it is unknown.
    pub change: Option<f64>,
    /// Share of the change of U; `None` if U does not change.
    pub share: Option<f64>,
}

impl ChangePart {
    /// Whether the two files differ about the input.
    pub fn is_changed(&self) -> bool {
        !matches!(self.due, ChangeCause::Input(_)) || self.states[0] != self.states[1]
    }
}

/// The state of knowledge about an input.
#[derive(Clone, Debug, PartialEq)]
pub struct InputState {
    /// Estimate.
    pub estimate: f64,
    /// Standard uncertainty.
    pub standard_uncertainty: f64,
    /// Name of the distribution.
    pub distribution: String,
    /// Degrees of freedom.
    pub dof: f64,
    /// Unit of estimate and standard uncertainty.
    pub unit: String,
    /// Sensitivity coefficient of the output with respect to it, in output units per input unit, if
    /// the equations are unknown.
    pub sensitivity: Option<f64>,
}

/// One of the two tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    First,
    Second,
}

impl Side {
    fn index(self) -> usize {
        match self {
            Self::First => 0,
            Self::Second => 1,
        }
    }
}

/// Compares two tasks by the law of propagation; rows are compared if both tasks have the same
/// values of the same conditions. Besides inputs, only a different number of rows is listed,
/// because two programs cannot be compared in words: a caller that has the equations as text adds
/// its own list in front.
pub fn compare(first: &Task, second: &Task) -> Difference {
    let tasks = [first, second];
    let mut changes = Vec::new();
    let outputs = common_outputs(tasks);
    let pairs = pairs(tasks);
    let swept = tasks.iter().any(|task| task.swept);
    if swept && pairs.len() < tasks.iter().map(|task| task.rows.len()).max().unwrap_or(0) {
        changes.push(format!("{} rows of conditions are in both files", pairs.len()));
    }
    let empty = tasks.map(|task| {
        let mut empty = task.clone();
        empty.rows = Vec::new();
        empty
    });
    let rows = pairs.into_iter().map(|rows| compare_rows(tasks, &empty, rows, &outputs)).collect();
    Difference { changes, swept, rows }
}

/// Outputs of the same name in units of the same dimension.
fn common_outputs(tasks: [&Task; 2]) -> Vec<Common> {
    let [first, second] = tasks.map(|task| &task.model.outputs);
    let common = first.iter().enumerate().filter_map(|(index, output)| {
        let name = &output.quantity.name;
        let other = second.iter().position(|other| other.quantity.name == *name)?;
        let unit = &second.get(other)?.quantity.unit;
        let factor = Unit::conversion_factor(unit, &output.quantity.unit).ok()?;
        Some(Common { indices: [index, other], factor })
    });
    common.collect()
}

/// Rows with the same values of the same conditions.
fn pairs<'a>(tasks: [&'a Task; 2]) -> Vec<[&'a Row; 2]> {
    let [first, second] = tasks;
    let names = |task: &'a Task| {
        task.model.conditions.iter().map(|c| (c.name.as_str(), c.unit.text())).collect::<Vec<_>>()
    };
    if names(first) != names(second) {
        return Vec::new();
    }
    // rows mostly have the same index; otherwise the first row with the same values is taken
    let key = |row: &Row| -> Vec<u64> {
        row.conditions.iter().map(|value| (value + 0.0).to_bits()).collect()
    };
    let mut places: HashMap<Vec<u64>, &Row> = HashMap::new();
    for row in &second.rows {
        places.entry(key(row)).or_insert(row);
    }
    let found = first.rows.iter().enumerate().filter_map(|(index, row)| {
        let same = |other: &&Row| other.conditions == row.conditions;
        let other = second.rows.get(index).filter(same);
        Some([row, other.or_else(|| places.get(&key(row)).copied())?])
    });
    found.collect()
}

fn compare_rows(
    tasks: [&Task; 2],
    empty: &[Task; 2],
    rows: [&Row; 2],
    outputs: &[Common],
) -> RowDifference {
    let mixture = Mixture::new(tasks, empty, rows, outputs);
    let causes = mixture.causes();
    let parts = attribute(&mixture, &causes);
    let evaluated = [0, 1].map(|side| gum::evaluate(tasks[side], rows[side]).outputs);
    let gum = |side: usize, index: usize| evaluated[side].get(index).and_then(Option::as_ref);
    let compared = outputs.iter().enumerate().filter_map(|(number, output)| {
        let quantity = &tasks[0].model.outputs.get(output.indices[0])?.quantity;
        let gums = [0, 1].map(|side| gum(side, output.indices[side]));
        let parts = Attributed { causes: &causes, parts: &parts, number };
        Some(OutputDifference {
            name: quantity.name.clone(),
            unit: quantity.unit.text().to_owned(),
            expanded: expanded(gums, output.factor),
            by_trials: [None, None],
            parts: list(tasks, rows, gums, output.factor, parts),
        })
    });
    let conditions = tasks[0].model.conditions.iter().zip(&rows[0].conditions);
    RowDifference {
        conditions: conditions
            .map(|(c, &value)| (c.name.clone(), value, c.unit.text().to_owned()))
            .collect(),
        outputs: compared.collect(),
    }
}

/// U of both sides in the first one's unit.
fn expanded(gums: [Option<&Gum>; 2], factor: f64) -> [Option<f64>; 2] {
    let [first, second] = gums.map(|gum| gum.and_then(Gum::expanded_uncertainty));
    [first, second.map(|expanded| expanded * factor)]
}

/// The parts of u^2 and k for all outputs: one for each cause, and the last one for the model.
fn attribute(mixture: &Mixture<'_>, causes: &[Cause]) -> Vec<Vec<f64>> {
    let game = |model: Side, players: &[&Cause], before: &[&Cause]| {
        shapley(players.len(), &|marks: &[bool]| {
            let marked = players.iter().zip(marks).filter(|(_, mark)| **mark).map(|(c, _)| *c);
            let in_effect: Vec<&Cause> = before.iter().copied().chain(marked).collect();
            mixture.figures(model, &in_effect)
        })
    };
    let only = |wanted: fn(&Cause) -> bool| causes.iter().filter(|c| wanted(c)).collect::<Vec<_>>();
    let removed = only(|cause| matches!(cause, Cause::Removed(_)));
    let added = only(|cause| matches!(cause, Cause::Added(_)));
    let common = only(|cause| !matches!(cause, Cause::Removed(_) | Cause::Added(_)));
    let leaving = [common.as_slice(), &removed].concat();
    let entering = [common.as_slice(), &added].concat();

    let figures = mixture.figures(Side::First, &[]).len();
    let mut parts = vec![vec![0.0; figures]; causes.len() + 1];
    let mut add = |players: &[&Cause], shares: Vec<Vec<f64>>| {
        for (player, share) in players.iter().zip(shares) {
            let index = causes.iter().position(|cause| cause == *player);
            if let Some(part) = index.and_then(|index| parts.get_mut(index)) {
                part.iter_mut().zip(share).for_each(|(part, share)| *part += 0.5 * share);
            }
        }
    };
    // the model last: common inputs and removed ones, the model, added ones
    add(&leaving, game(Side::First, &leaving, &[]));
    add(&added, game(Side::Second, &added, &common));
    // the model first
    add(&removed, game(Side::First, &removed, &[]));
    add(&entering, game(Side::Second, &entering, &[]));
    let steps = [(leaving.as_slice(), common.as_slice()), (removed.as_slice(), &[])];
    for (before, after) in steps {
        let before = mixture.figures(Side::First, before);
        let after = mixture.figures(Side::Second, after);
        if let Some(model) = parts.last_mut() {
            for ((part, before), after) in model.iter_mut().zip(before).zip(after) {
                *part += 0.5 * (after - before);
            }
        }
    }
    parts
}

/// The parts of one output.
#[derive(Clone, Copy)]
struct Attributed<'a> {
    causes: &'a [Cause],
    parts: &'a [Vec<f64>],
    number: usize,
}

impl Attributed<'_> {
    /// Parts of u^2 and k for a cause, or for the model.
    fn of(&self, cause: Option<&Cause>) -> [f64; 2] {
        let index = match cause {
            Some(cause) => self.causes.iter().position(|known| known == cause),
            None => Some(self.causes.len()),
        };
        let part = index.and_then(|index| self.parts.get(index));
        let figure = |i: usize| part.and_then(|p| p.get(2 * self.number + i)).copied();
        [figure(0).unwrap_or(0.0), figure(1).unwrap_or(0.0)]
    }
}

/// The list of an output's parts.
fn list(
    tasks: [&Task; 2],
    rows: [&Row; 2],
    gums: [Option<&Gum>; 2],
    factor: f64,
    attributed: Attributed<'_>,
) -> Vec<ChangePart> {
    let scale = [1.0, factor];
    let u = [0, 1].map(|i| gums[i].map_or(f64::NAN, |gum| gum.standard_uncertainty * scale[i]));
    let k = gums.map(|gum| gum.and_then(|gum| gum.coverage_factor).unwrap_or(f64::NAN));
    let change = |cause: Option<&Cause>| change_of_expanded(u, k, attributed.of(cause));
    let places = tasks.map(|task| {
        let names = task.variables.iter().enumerate();
        names.map(|(place, v)| (v.name.as_str(), place)).collect::<HashMap<_, _>>()
    });
    let state = |side: usize, name: &str| {
        let index = *places[side].get(name)?;
        let distribution = rows[side].distributions.get(index)?;
        Some(InputState {
            estimate: distribution.mean(),
            standard_uncertainty: distribution.standard_uncertainty(),
            distribution: distribution.name().to_owned(),
            dof: distribution.dof(),
            unit: tasks[side].variables.get(index)?.unit.text().to_owned(),
            sensitivity: None,
        })
    };
    let named = attributed.causes.iter().filter_map(|cause| match cause {
        Cause::Moved(known) | Cause::Removed(known) | Cause::Added(known) => {
            Some((known.as_str(), cause))
        }
        Cause::Correlations | Cause::Coverage => None,
    });
    let causes: HashMap<&str, &Cause> = named.collect();
    let mut parts: Vec<ChangePart> = Vec::new();
    let mut listed = HashSet::new();
    for variable in tasks.iter().flat_map(|task| &task.variables) {
        let name = &variable.name;
        if listed.contains(name.as_str()) {
            continue;
        }
        let states = [state(0, name), state(1, name)];
        let cause = causes.get(name.as_str()).copied();
        // the estimate to which components are added has a line only if it changed
        if !variable.shown && cause.is_none() {
            continue;
        }
        let change = if cause.is_some() { change(cause) } else { Some(0.0) };
        listed.insert(name.as_str());
        parts.push(ChangePart {
            due: ChangeCause::Input(name.clone()),
            states,
            change,
            share: None,
        });
    }
    let others = [
        (Cause::Correlations, ChangeCause::Correlations),
        (Cause::Coverage, ChangeCause::Coverage),
    ];
    for (cause, due) in others {
        if attributed.causes.contains(&cause) {
            let change = change(Some(&cause));
            parts.push(ChangePart { due, states: [None, None], change, share: None });
        }
    }
    let rounding = ROUNDING * (k[0] * u[0]).max(k[1] * u[1]);
    let of_model = change(None);
    if of_model.is_none_or(|change| change.abs() > rounding) {
        parts.push(ChangePart {
            due: ChangeCause::Model,
            states: [None, None],
            change: of_model,
            share: None,
        });
    }
    share_out(&mut parts, rounding);
    parts
}

/// The part of the change of U = k u that corresponds to parts of the changes of u^2 and k; `None`
/// if one is not finite.
fn change_of_expanded(u: [f64; 2], k: [f64; 2], [of_variance, of_factor]: [f64; 2]) -> Option<f64> {
    let sum = u[0] + u[1];
    let of_u = if sum == 0.0 { 0.0 } else { of_variance / sum };
    let change = 0.5 * (k[0] + k[1]) * of_u + 0.5 * sum * of_factor;
    change.is_finite().then_some(change)
}

/// Shares of the sum of all changes, which is the change of U apart from rounding.
fn share_out(parts: &mut [ChangePart], rounding: f64) {
    let total: Option<f64> = parts.iter().map(|part| part.change).sum();
    let Some(total) = total.filter(|total| total.abs() > rounding) else {
        return;
    };
    for part in parts {
        // no negative zero
        part.share = part.change.map(|change| if change == 0.0 { 0.0 } else { change / total });
    }
}
