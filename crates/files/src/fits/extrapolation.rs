//! Calibration functions that are used outside of their points.

use std::sync::Arc;

use gumption_engine::decimal::to_digits;
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::model::formula::Typing;
use gumption_engine::model::{Output, Quantity};
use gumption_engine::number::{Shortest, elementary};
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::{Task, Warning};
use gumption_gap::{ModelForm, OverridableModel};
use gumption_text::Collector;

/// A curve may be used this share of the range of its points beyond them without a note.
const LITTLE: f64 = 0.1;

/// Digits of an abscissa in a note.
const DIGITS: u32 = 4;

/// The distance from zero over the range that more digits than these are given for.
const FARTHEST: f64 = 1e8;

/// A note for each calibration function that the equations use, at the estimates of some row, outside
/// of the range of its points: the one farthest out.
pub(crate) fn notes(
    log: &Collector,
    sim: &OverridableModel,
    task: &Task,
    curves: &[Arc<CurveFunction>],
) -> Vec<Warning> {
    let ModelForm::Equations(equations) = &sim.maker else { return Vec::new() };
    if curves.is_empty() {
        return Vec::new();
    }
    // the model with the abscissae as outputs
    let mut with = sim.clone();
    with.outputs.clear();
    let mut used = Vec::new();
    let mut added = Vec::new();
    for (curve, text) in equations.iter().flat_map(|(_, formula)| formula.curve_calls()) {
        let Ok(formula) = log.formula_with(text, curves) else { continue };
        let typing = formula.check_names(&sim.scope).unwrap_or(Typing::in_unit(&curve.x));
        // no formula can have such a name
        let name = format!("x of a curve, {}", used.len());
        with.scope.define(name.as_str(), typing);
        let quantity = Quantity { name: name.clone(), unit: curve.x.clone(), about: String::new() };
        with.outputs.push(Output::new(quantity));
        added.push((name, formula));
        used.push(curve);
    }
    if let ModelForm::Equations(all) = &mut with.maker {
        all.extend(added);
    }
    let Ok(program) = with.program(&[]) else { return Vec::new() };
    let mut farthest: Vec<Option<f64>> = vec![None; used.len()];
    for row in &task.rows {
        let known = row
            .distributions
            .iter()
            .map(|distribution| distribution.mean())
            .chain(row.conditions.iter().copied());
        let known: Vec<f64> = known.collect();
        for ((x, curve), farthest) in program.evaluate(&known).iter().zip(&used).zip(&mut farthest)
        {
            let beyond = beyond(curve, *x);
            if beyond > farthest.map_or(LITTLE, |x| self::beyond(curve, x)) {
                *farthest = Some(*x);
            }
        }
    }
    let mut notes: Vec<Warning> = Vec::new();
    for (curve, x) in used.into_iter().zip(farthest) {
        let name = curve.fit.name.as_str();
        let Some(x) = x.filter(|_| notes.iter().all(|note| note.place != name)) else { continue };
        let [low, high] = curve.fit.points.range();
        // digits of the range, where it is short beside its distance from zero, as of dates
        let far = low.abs().max(high.abs()).max(x.abs()) / (high - low);
        let digits = DIGITS + elementary::log10(far.clamp(1.0, FARTHEST)).ceil() as u32;
        let [x, low, high] = [x, low, high]
            .map(|x| Argument::Number(curve.x.after(&Shortest(to_digits(x, digits)).to_string())));
        notes.push(Warning::new(name, fact!("extrapolation.fit", name, x, low, high)));
    }
    notes
}

/// By which share of the range of its points a curve is used beyond them.
fn beyond(curve: &CurveFunction, x: f64) -> f64 {
    let [low, high] = curve.fit.points.range();
    (low - x).max(x - high) / (high - low)
}
