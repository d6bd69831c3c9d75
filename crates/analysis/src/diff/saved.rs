//! Compares saved results with each other, or with tasks.

use super::contributions::{Cause, OutputFigures, parts};
use super::linear::{LinearOutput, LinearResult, Matched, matched};
use super::{
    ChangeCause, ChangePart, Difference, InputState, OutputDifference, ROUNDING, RowDifference,
    change_of_expanded, share_out,
};
use gumption_engine::number::smallest_first;
use gumption_units::Unit;

/// Sensitivity coefficients whose relative difference is below this are equal apart from rounding.
const EQUAL: f64 = 1e-12;

/// Compares two results to first order in their original inputs; exactly known inputs are not in
/// saved results and take no part.
pub fn compare_linear(first: &LinearResult, second: &LinearResult) -> Difference {
    let sides = [first, second];
    let inputs = matched(sides);
    let correlations = [0, 1].map(|side| indexed(sides[side], &inputs, side));
    let mut changes = Vec::new();
    let mut outputs = Vec::new();
    for first in &sides[0].outputs {
        let Some(second) = sides[1].outputs.iter().find(|other| other.name == first.name) else {
            changes.push(format!("output `{}` removed", first.name));
            continue;
        };
        let (from, to) = (first.unit.text(), second.unit.text());
        let Ok(factor) = Unit::conversion_factor(&second.unit, &first.unit) else {
            changes.push(format!("output `{}`: from `{from}` to `{to}`", first.name));
            continue;
        };
        if from != to {
            changes.push(format!("output `{}`: from `{from}` to `{to}`", first.name));
        }
        let pair = Pair { sides, outputs: [first, second], factor, inputs: &inputs };
        changes.extend(pair.changed_sensitivities());
        outputs.push(pair.difference(&correlations));
    }
    let is_new = |name: &str| sides[0].outputs.iter().all(|output| output.name != name);
    let added = sides[1].outputs.iter().filter(|output| is_new(&output.name));
    changes.extend(added.map(|output| format!("output `{}` added", output.name)));
    let probability = [0, 1].map(|side| sides[side].outputs.first().and_then(|o| o.probability));
    if let [Some(from), Some(to)] = probability
        && from != to
    {
        changes.push(format!("`coverage_probability`: from {from} to {to}"));
    }
    changes.extend(changed_correlations(&inputs, &correlations));
    let rows = vec![RowDifference { conditions: Vec::new(), outputs }];
    Difference { changes, swept: false, rows }
}

/// The coefficients of one side by the indices in the common list, in order.
fn indexed(side: &LinearResult, inputs: &[Matched], which: usize) -> Vec<(usize, usize, f64)> {
    let index = |own: usize| inputs.iter().position(|input| input.indices[which] == Some(own));
    // an input that no output depends on is present for other results, and changes nothing here
    let counts = |own: usize| side.outputs.iter().any(|output| output.sensitivity(own) != 0.0);
    let known = side.correlations.iter().filter(|(i, j, r)| *r != 0.0 && counts(*i) && counts(*j));
    let indexed = known.filter_map(|&(i, j, r)| {
        let (i, j) = (index(i)?, index(j)?);
        Some((i.min(j), i.max(j), r))
    });
    let mut indexed: Vec<_> = indexed.collect();
    smallest_first(&mut indexed, |(_, j, _)| *j as f64);
    smallest_first(&mut indexed, |(i, ..)| *i as f64);
    indexed
}

fn changed_correlations(
    inputs: &[Matched],
    correlations: &[Vec<(usize, usize, f64)>; 2],
) -> Vec<String> {
    let of = |side: usize, pair: (usize, usize)| {
        let known = correlations[side].iter().find(|(i, j, _)| (*i, *j) == pair);
        known.map_or(0.0, |(.., r)| *r)
    };
    let mut pairs: Vec<(usize, usize)> =
        correlations.iter().flatten().map(|&(i, j, _)| (i, j)).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let label = |index: usize| inputs.get(index).map_or("", |input| input.label.as_str());
    let changed = pairs.into_iter().filter(|pair| of(0, *pair) != of(1, *pair));
    changed
        .map(|pair| {
            let (from, to) = (of(0, pair), of(1, pair));
            let (a, b) = (label(pair.0), label(pair.1));
            format!("correlation of `{a}` and `{b}`: from {from} to {to}")
        })
        .collect()
}

/// An output of both sides.
struct Pair<'a> {
    sides: [&'a LinearResult; 2],
    outputs: [&'a LinearOutput; 2],
    /// Conversion factor from the second unit to the first.
    factor: f64,
    inputs: &'a [Matched],
}

impl Pair<'_> {
    /// The output's sensitivity coefficient for an input of the common list, in the side's own
    /// units.
    fn sensitivity(&self, side: usize, input: &Matched) -> f64 {
        input.indices[side].map_or(0.0, |index| self.outputs[side].sensitivity(index))
    }

    fn scale(&self, side: usize) -> f64 {
        if side == 0 { 1.0 } else { self.factor }
    }

    /// A sentence about changed sensitivity coefficients, whose effect is counted with their
    /// inputs.
    fn changed_sensitivities(&self) -> Option<String> {
        let changed = |input: &&Matched| {
            let [Some(a), Some(b)] = input.indices else {
                return false;
            };
            let unit = |side: usize, index: usize| {
                self.sides[side].inputs.get(index).and_then(|root| Unit::parse(&root.unit).ok())
            };
            let units = unit(0, a).zip(unit(1, b));
            let per = units.and_then(|(a, b)| Unit::conversion_factor(&a, &b).ok());
            let from = self.sensitivity(0, input);
            let to = self.sensitivity(1, input) * self.factor * per.unwrap_or(1.0);
            (from - to).abs() > EQUAL * from.abs().max(to.abs())
        };
        let names: Vec<String> =
            self.inputs.iter().filter(changed).map(|i| format!("`{}`", i.label)).collect();
        (!names.is_empty()).then(|| {
            format!(
                "output `{}`: other sensitivity coefficients to {}; what that does to U is counted \
                 with these inputs",
                self.outputs[0].name,
                names.join(", ")
            )
        })
    }

    /// Whether an own input may affect this output although its sensitivity coefficient is zero: it
    /// is zero for all outputs, on both sides.
    fn may_act(&self, input: &Matched) -> bool {
        (0..2).all(|side| {
            let own_side = self.sides[side];
            input.indices[side].is_none_or(|index| {
                own_side.is_own(index)
                    && own_side.outputs.iter().all(|output| output.sensitivity(index) == 0.0)
            })
        })
    }

    fn known(&self, side: usize, correlations: &[(usize, usize, f64)]) -> Option<OutputFigures> {
        let output = self.outputs[side];
        let root = |input: &Matched| self.sides[side].inputs.get(input.indices[side]?);
        let contribution = |input: &Matched| {
            let u = root(input).map_or(0.0, |root| root.standard_uncertainty);
            self.sensitivity(side, input) * u * self.scale(side)
        };
        Some(OutputFigures {
            standard_uncertainty: output.standard_uncertainty * self.scale(side),
            coverage_factor: output.coverage_factor?,
            dof: output.dof,
            probability: output.probability,
            contributions: self.inputs.iter().map(contribution).collect(),
            input_dof: self
                .inputs
                .iter()
                .map(|input| root(input).map_or(f64::INFINITY, |root| root.dof))
                .collect(),
            correlations: correlations.to_vec(),
        })
    }

    fn state(&self, side: usize, input: &Matched) -> Option<InputState> {
        let root = self.sides[side].inputs.get(input.indices[side]?)?;
        Some(InputState {
            estimate: root.estimate,
            standard_uncertainty: root.standard_uncertainty,
            distribution: root.distribution.clone(),
            dof: root.dof,
            unit: root.unit.clone(),
            sensitivity: Some(self.sensitivity(side, input)),
        })
    }

    fn difference(&self, correlations: &[Vec<(usize, usize, f64)>; 2]) -> OutputDifference {
        let known = [0, 1].map(|side| self.known(side, &correlations[side]));
        let expanded = known
            .each_ref()
            .map(|side| side.as_ref().map(|s| s.coverage_factor * s.standard_uncertainty));
        let attributed = match &known {
            [Some(first), Some(second)] => Some(parts([first, second])),
            _ => None,
        };
        let figure = |figure_of: fn(&OutputFigures) -> f64| {
            known.each_ref().map(|s| s.as_ref().map_or(f64::NAN, figure_of))
        };
        let (u, k) = (figure(|s| s.standard_uncertainty), figure(|s| s.coverage_factor));
        let part =
            |cause: Cause| attributed.iter().flatten().find(|(attributed, _)| *attributed == cause);
        let change = |part: [f64; 2]| change_of_expanded(u, k, part);
        let mut list: Vec<ChangePart> = Vec::new();
        for (index, input) in self.inputs.iter().enumerate() {
            let states = [self.state(0, input), self.state(1, input)];
            // an input on which this output does not depend, on either side
            let is_apart = (0..2).all(|side| self.sensitivity(side, input) == 0.0);
            if is_apart && !(states[0] != states[1] && self.may_act(input)) {
                continue;
            }
            let change = match part(Cause::Input(index)) {
                Some((_, part)) => change(*part),
                None if attributed.is_none() && states[0] != states[1] => None,
                None => Some(0.0),
            };
            list.push(ChangePart {
                due: ChangeCause::Input(input.label.clone()),
                states,
                change,
                share: None,
            });
        }
        let others = [
            (Cause::Correlations, ChangeCause::Correlations),
            (Cause::Coverage, ChangeCause::Coverage),
            (Cause::Rest, ChangeCause::Rest),
        ];
        let rounding = ROUNDING * (k[0] * u[0]).max(k[1] * u[1]);
        for (cause, due) in others {
            let Some((_, part)) = part(cause) else {
                continue;
            };
            let change = change(*part);
            if due != ChangeCause::Rest || change.is_none_or(|change| change.abs() > rounding) {
                list.push(ChangePart { due, states: [None, None], change, share: None });
            }
        }
        share_out(&mut list, rounding);
        OutputDifference {
            name: self.outputs[0].name.clone(),
            unit: self.outputs[0].unit.text().to_owned(),
            expanded,
            by_trials: [0, 1]
                .map(|side| Some(self.outputs[side].by_trials?.scaled(self.scale(side)))),
            parts: list,
        }
    }
}
