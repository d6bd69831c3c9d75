//! The note that saved results of few trials matter.

use super::figures::OutputEvaluation;
use super::inherited::{Inherited, Variances};
use super::validate::numerical_tolerance;
use crate::decimal::significant;
use crate::fact;
use crate::fact::{Argument, Fact};
use crate::model::Output;
use crate::task::{Task, Warning};

/// So many times the error of its own trials, what a figure inherits is what is wrong with it.
const BEYOND_OWN: f64 = 2.0;

/// How many saved results a note names.
const NAMED: usize = 4;

/// Tells where saved results of few trials leave figures of an output less certain than their digits say:
/// twice the inherited standard error is beyond the numerical tolerance (JCGM 101, 7.9.4), and more trials
/// of the run itself would not help.
pub(super) fn note(
    task: &Task,
    output: &Output,
    at: Option<Fact>,
    found: &OutputEvaluation,
) -> Option<Warning> {
    let inherited = found.inherited.as_deref()?;
    let Variances { estimate, standard_uncertainty, end, .. } = inherited.variances;
    let figures = found.monte_carlo.as_deref();
    let spread = figures.and_then(|figures| figures.standard_uncertainty);
    let u = spread.or_else(|| Some(found.gum.as_ref()?.standard_uncertainty))?;
    let errors: Vec<(Fact, f64)> = match figures {
        Some(figures) => {
            let trials = figures.trials as f64;
            // the errors have both in them
            let part = |error: f64, variance: f64| {
                let inherited = trials * variance;
                let is_own = inherited.sqrt() <= BEYOND_OWN;
                if is_own { 0.0 } else { error * (inherited / (1.0 + inherited)).sqrt() }
            };
            let of = &figures.errors;
            let [low, high] = of.symmetric_interval.map(|error| part(error, end));
            vec![
                (fact!("figure.estimate"), of.estimate.map_or(0.0, |error| part(error, estimate))),
                (
                    fact!("figure.standard-uncertainty"),
                    of.standard_uncertainty.map_or(0.0, |error| part(error, standard_uncertainty)),
                ),
                (fact!("figure.symmetric-lower"), low),
                (fact!("figure.symmetric-upper"), high),
            ]
        }
        // those of a normal distribution
        None => vec![
            (fact!("figure.estimate"), u * estimate.sqrt()),
            (fact!("figure.standard-uncertainty"), u * (0.5 * standard_uncertainty).sqrt()),
        ],
    };
    let tolerance = numerical_tolerance(u, task.settings.digits);
    if errors.iter().all(|(_, error)| error.is_nan() || 2.0 * error <= tolerance) {
        return None;
    }
    let unit = &output.quantity.unit;
    let errors = errors.into_iter().filter(|(_, error)| *error > 0.0);
    let moved = |(figure, error): (Fact, f64)| {
        let error = unit.after(&significant(error, 1));
        fact!("moved", figure, by = Argument::Number(error))
    };
    let errors: Vec<Fact> = errors.map(moved).collect();
    let name = &output.quantity.name;
    let results = results(task, inherited);
    Some(Warning::new(name, fact!("result-few-trials", name, at, results, errors)))
}

/// The saved results with their numbers of trials, those of the fewest first.
fn results(task: &Task, inherited: &Inherited) -> Vec<String> {
    let mut results = inherited.results.clone();
    results.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let name = |v: usize| task.variables.get(v).map_or("", |variable| variable.name.as_str());
    let listed = results.iter().take(NAMED);
    let mut listed: Vec<String> =
        listed.map(|(v, trials)| format!("`{}`: {trials:.0}", name(*v))).collect();
    if results.len() > NAMED {
        listed.push("...".to_owned());
    }
    listed
}
