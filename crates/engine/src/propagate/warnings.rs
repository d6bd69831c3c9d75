//! What a user should know about an evaluation that is given all the same.

use std::collections::HashMap;

use super::agreement::DifferenceCause;
use super::figures::{
    CapabilityStatement, Evaluation, FEW_ROWS, NOTEWORTHY, OutputEvaluation, RowEvaluation,
    scatter_of_few,
};
use super::gum::{BudgetLine, Dof, Gum};
use super::inherited_note;
use super::monte_carlo::{Adaptive, MonteCarlo};
use super::rounding;
use super::second_order::SecondOrder;
use super::statement::{Basis, Stated};
use crate::decimal::{significant, to_digits};
use crate::fact;
use crate::fact::{Argument, Fact};
use crate::model::Output;
use crate::number::Shortest;
use crate::task::{Coverage, StatementMethod, Task, Trials, Warning};

/// Outputs of saved results that cancel are worth a note from this share of the standard uncertainty
/// on.
const CANCELLED: f64 = 0.005;

/// The warnings and notes of an evaluation, in the order of rows and outputs; each code stands once
/// for an output, at the first row that it concerns.
pub fn warnings(task: &Task, evaluation: &Evaluation) -> Vec<Warning> {
    let mut found: Vec<Warning> = Vec::new();
    // without the digits that 1 - p has lost
    let needed = format!("{:.5e}", 1e4 / (1.0 - evaluation.coverage_probability));
    let needed: f64 = needed.parse().unwrap_or(f64::INFINITY);
    if let Trials::Fixed(trials @ 1..) = task.settings.trials
        && (trials as f64) < needed * (1.0 - 1e-9)
    {
        let probability = evaluation.coverage_probability;
        let needed = Argument::number(format!("{needed:.0}"));
        found.push(Warning::new("", fact!("few-trials", trials, probability, needed)));
    }
    if evaluation.rounded_correlations {
        found.push(Warning::new("", fact!("correlations-rounded")));
    }
    copula(task, evaluation, &mut found);
    let named = named(task, &evaluation.rows);
    // one more pass over the program costs little beside trials, but not beside bare budgets
    let is_looked_at = task.settings.trials != Trials::Fixed(0) || task.rows.len() <= FEW_ROWS;
    for (place, row) in evaluation.rows.iter().enumerate() {
        let row_of_task = task.rows.get(place).filter(|_| is_looked_at && task.function.is_none());
        let vanishing =
            row_of_task.map(|values| task.model.program.underflows(&values.estimates()));
        let vanishing = vanishing.unwrap_or_default();
        if let Some(undefined) = &row.undefined {
            let (count, trials) = (undefined.count, undefined.trials);
            push(&mut found, Warning::new("", fact!("undefined-trials", count, trials)));
        }
        for (number, (output, evaluated)) in task.model.outputs.iter().zip(&row.outputs).enumerate()
        {
            let jumps = evaluated.jump.is_some();
            evaluated.jump.iter().for_each(|jump| push(&mut found, jump.note(output)));
            let name = &output.quantity.name;
            let rounded = of_rounded_correlations(name, evaluated)
                .filter(|_| evaluation.rounded_correlations);
            let is_told = jumps || rounded.is_some();
            rounded.into_iter().for_each(|note| push(&mut found, note));
            of_output(task, &named, name, is_told, row, evaluated, &mut found);
            of_noiseless(&output.quantity.name, evaluated, &mut found);
            if evaluated.inherited.is_some() {
                let at = at(task, &named, row);
                let inherited = inherited_note::note(task, output, at, evaluated);
                inherited.into_iter().for_each(|note| push(&mut found, note));
            }
            if place == 0 {
                of_capability(output, number, &evaluation.rows, task, &mut found);
            }
            if is_looked_at {
                let coarse =
                    evaluated.gum.as_ref().and_then(|gum| rounding::note(output, task, gum));
                let vanishes = vanishing.get(number).copied().unwrap_or_default();
                let vanishes = vanishes.then(|| rounding::underflow(name));
                coarse.into_iter().chain(vanishes).for_each(|note| push(&mut found, note));
            }
            if task.model.outputs.len() > 1 {
                of_correlations(name, jumps, evaluated, &mut found);
            }
            let decided = evaluated.conformity.as_deref();
            if task.settings.trials == Trials::Fixed(0)
                && decided.is_some_and(|decided| decided.stated_uncertainty.is_none())
            {
                push(&mut found, conformity_by_propagation(name));
            }
        }
    }
    found
}

/// Conditions up to which a note names all of them.
const MOST_NAMED: usize = 3;

/// Significant digits of conditions in a note.
const NAMED_DIGITS: u32 = 6;

/// The conditions that notes name a row by.
fn named(task: &Task, rows: &[RowEvaluation]) -> Vec<usize> {
    let count = task.model.conditions.len();
    let naming = if count > MOST_NAMED { super::naming(rows) } else { Vec::new() };
    if naming.is_empty() { (0..count).collect() } else { naming }
}

/// Which inputs were drawn by a copula, and where that could not be exact.
fn copula(task: &Task, evaluation: &Evaluation, found: &mut Vec<Warning>) {
    if evaluation.copula.is_empty() || task.settings.trials == Trials::Fixed(0) {
        return;
    }
    let names: Vec<String> = evaluation
        .copula
        .iter()
        .filter_map(|&v| task.variables.get(v).map(|v| format!("`{}`", v.name)))
        .collect();
    found.push(Warning::new("", fact!("gaussian-copula", names)));
    if evaluation.copula_adjusted > 0.0 {
        let of_results =
            task.rows.iter().flat_map(|row| row.distributions.iter()).any(|d| d.saved().is_some());
        let difference = Argument::number(format!("{:.1e}", evaluation.copula_adjusted));
        let fact = match of_results {
            true => fact!("copula-adjusted.results", difference),
            false => fact!("copula-adjusted", difference),
        };
        found.push(Warning::new("", fact));
    }
}

/// Numerical standard errors that a figure of the trials may be from the one without noise: beyond it a
/// figure of a normal scatter is once in 16,000.
const BEYOND: f64 = 4.0;

/// Whether a figure of the trials is too far from the one without noise.
fn of_noiseless(name: &str, evaluated: &OutputEvaluation, found: &mut Vec<Warning>) {
    let (Some(Ok(noiseless)), Some(trials)) = (&evaluated.noiseless, &evaluated.monte_carlo) else {
        return;
    };
    let errors = &trials.errors;
    let own = noiseless.scatter();
    let mut figures = vec![
        (
            fact!("figure.estimate"),
            trials.estimate,
            noiseless.estimate,
            errors.estimate,
            own.and_then(|own| own.estimate),
        ),
        (
            fact!("figure.standard-uncertainty"),
            trials.standard_uncertainty,
            noiseless.standard_uncertainty,
            errors.standard_uncertainty,
            own.and_then(|own| own.standard_uncertainty),
        ),
        (
            fact!("figure.median"),
            Some(trials.median),
            Some(noiseless.median),
            Some(errors.median),
            own.map(|own| own.median),
        ),
        (
            fact!("figure.inside"),
            Some(trials.inside),
            noiseless.inside,
            noiseless.inside.map(|inside| (inside * (1.0 - inside) / trials.trials as f64).sqrt()),
            own.and_then(|own| own.inside),
        ),
    ];
    let both_unique = trials.shortest_unique && noiseless.shortest_unique;
    let symmetric = [fact!("figure.symmetric-lower"), fact!("figure.symmetric-upper")];
    let ends = [fact!("figure.shortest-lower"), fact!("figure.shortest-upper")];
    for (place, (symmetric, end)) in symmetric.into_iter().zip(ends).enumerate() {
        figures.push((
            symmetric,
            Some(trials.symmetric_interval[place]),
            Some(noiseless.symmetric_interval[place]),
            Some(errors.symmetric_interval[place]),
            own.map(|own| own.symmetric_interval[place]),
        ));
        let shortest = noiseless.shortest_interval.filter(|_| both_unique);
        figures.push((
            end,
            Some(trials.shortest_interval[place]),
            shortest.map(|ends| ends[place]),
            Some(errors.shortest_interval[place]),
            own.and_then(|own| Some(own.shortest_interval?[place])),
        ));
    }
    let far = figures.into_iter().filter_map(|(figure, trials, exact, error, own)| {
        let (trials, exact) = trials.zip(exact)?;
        let error = crate::number::elementary::hypot(error?, own.unwrap_or(0.0));
        let count = (trials - exact).abs() / error;
        let count = (error > 0.0 && count > BEYOND).then(|| format!("{count:.1}"))?;
        Some(fact!("moved", figure, by = Argument::Number(count)))
    });
    let far: Vec<Fact> = far.collect();
    if !far.is_empty() {
        push(found, Warning::new(name, fact!("trials-off", name, errors = BEYOND, far)));
    }
}

fn push(found: &mut Vec<Warning>, warning: Warning) {
    let known = |w: &Warning| w.code() == warning.code() && w.place == warning.place;
    if !found.iter().any(known) {
        found.push(warning);
    }
}

/// A variance that declared coefficients leave nothing of, where they are possible only within their
/// rounding.
fn of_rounded_correlations(name: &str, output: &OutputEvaluation) -> Option<Warning> {
    let drawn = output.monte_carlo.as_deref()?.standard_uncertainty?;
    let gum = output.gum.as_ref()?;
    let rounding = ROUNDING * gum.largest_contribution();
    let is_lost = gum.standard_uncertainty == 0.0 && drawn > rounding;
    is_lost.then(|| Warning::new(name, fact!("correlations-rounded.output", name)))
}

/// Whether expanded uncertainties of an output, by its number, are below the laboratory's capability.
fn of_capability(
    output: &Output,
    number: usize,
    rows: &[RowEvaluation],
    task: &Task,
    found: &mut Vec<Warning>,
) {
    let stated = |row: &RowEvaluation| row.outputs.get(number)?.capability.as_deref().copied();
    let below: Vec<CapabilityStatement> =
        rows.iter().filter_map(stated).filter(|stated| stated.below).collect();
    let Some(first) = below.first() else { return };
    let (name, unit) = (&output.quantity.name, &output.quantity.unit);
    let cmc = Argument::Number(unit.after(&first.cmc_text()));
    let (count, of) = (below.len(), rows.len());
    let fact = match (rows, first.raised) {
        ([_], true) => {
            let expanded = first.rounded(task.settings.digits).map(|expanded| expanded.to_string());
            let expanded = Argument::Number(unit.after(&expanded.unwrap_or_default()));
            fact!("raised-to-cmc", name, cmc, expanded)
        }
        ([_], false) => {
            let expanded = unit.after(&significant(first.expanded_uncertainty, 3));
            fact!("below-cmc", name, cmc, expanded = Argument::Number(expanded))
        }
        (_, true) => fact!("raised-to-cmc.rows", name, count, of),
        (_, false) => fact!("below-cmc.rows", name, count, of),
    };
    push(found, Warning::new(name, fact));
}

/// The conditions of a row, where there are any.
fn at(task: &Task, named: &[usize], row: &RowEvaluation) -> Option<Fact> {
    let conditions = task.model.conditions.iter().zip(&row.conditions).enumerate();
    let shown = conditions.filter(|(place, _)| named.contains(place)).map(|(_, (c, &value))| {
        let value = Shortest(to_digits(value, NAMED_DIGITS)).to_string();
        fact!("condition", name = &c.name, value = Argument::Number(c.unit.after(&value)))
    });
    let conditions: Vec<Fact> = shown.collect();
    (!row.conditions.is_empty()).then(|| fact!("at", conditions))
}

fn of_output(
    task: &Task,
    named: &[usize],
    name: &str,
    is_told: bool,
    row: &RowEvaluation,
    output: &OutputEvaluation,
    found: &mut Vec<Warning>,
) {
    let at = || at(task, named, row);
    let Some(gum) = &output.gum else {
        let at = at();
        push(found, Warning::new(name, fact!("gum-undefined", name, at = at.clone())));
        if let Some(monte_carlo) = &output.monte_carlo {
            of_extremes(name, &at, monte_carlo, found);
            of_heavy_tails(name, &at, output, monte_carlo, found);
        }
        return;
    };
    if gum.dof == Dof::Undefined {
        let fact = match gum.coverage_factor {
            Some(k) => fact!("gum-dof-undefined.stated", name, at = at(), k),
            None => fact!("gum-dof-undefined", name, at = at()),
        };
        push(found, Warning::new(name, fact));
    }
    let Some(monte_carlo) = &output.monte_carlo else {
        if let Some(second) = &output.second_order {
            let second = second_order(task, gum, second);
            let fact = fact!("non-linear.second-order", name, at = at(), second);
            push(found, Warning::new(name, fact));
        }
        return;
    };
    let at = at();
    of_extremes(name, &at, monte_carlo, found);
    of_heavy_tails(name, &at, output, monte_carlo, found);
    let spread = monte_carlo.standard_uncertainty.unwrap_or(gum.standard_uncertainty);
    of_results(name, &at, row, gum, spread, found);
    if let Some(Adaptive { converged: false, tolerance, .. }) = monte_carlo.adaptive
        && !monte_carlo.heavy_tailed
    {
        let trials = monte_carlo.trials;
        let fact = fact!("not-converged", name, at = at.clone(), trials, tolerance);
        push(found, Warning::new(name, fact));
    }
    if output.drawn_dof <= 2.0 {
        let dof = output.drawn_dof;
        let at = at.clone();
        let fact = match (dof > 1.0, monte_carlo.estimate.is_some()) {
            (true, true) => fact!("no-variance", name, at, dof),
            (true, false) => fact!("no-variance.of-model", name, at, dof),
            (false, _) if dof == 1.0 => fact!("no-variance.one", name, at, dof),
            (false, _) => fact!("no-variance.no-expectation", name, at, dof),
        };
        push(found, Warning::new(name, fact));
    } else if !is_told {
        of_difference(task, name, at, row, output, found);
    }
}

/// What rounding leaves of contributions that cancel, in the largest of them.
const ROUNDING: f64 = 1e-13;

/// Which method the stated uncertainty comes from where clause 8 does not validate the interval of the
/// law of propagation, and why: for those who state results, one note for each output and cause.
pub fn statement_notes(task: &Task, evaluation: &Evaluation) -> Vec<Warning> {
    let named = named(task, &evaluation.rows);
    let mut found: Vec<Warning> = Vec::new();
    for row in &evaluation.rows {
        for (output, evaluated) in task.model.outputs.iter().zip(&row.outputs) {
            let name = &output.quantity.name;
            let fact = of_statement(task, name, at(task, &named, row), evaluated);
            let is_told = |fact: &Fact| {
                found.iter().any(|note| note.place == *name && note.fact.key == fact.key)
            };
            if let Some(fact) = fact.filter(|fact| !is_told(fact)) {
                found.push(Warning::new(name, fact));
            }
        }
    }
    found
}

fn of_statement(
    task: &Task,
    name: &str,
    at: Option<Fact>,
    output: &OutputEvaluation,
) -> Option<Fact> {
    let settings = &task.settings;
    let cause = output.difference_cause(settings.statement_tolerance)?;
    let (agreement, stated) = (output.agreement?, Stated::of(output, settings)?);
    let percent = |share: f64| Argument::number(significant(100.0 * share, 2));
    let (difference, allowed) =
        (percent(agreement.difference), percent(settings.statement_tolerance));
    Some(match (settings.statement, stated.basis == Basis::Shortest, cause) {
        (StatementMethod::Gum, ..) => fact!("stated-by.gum", name, at),
        (StatementMethod::MonteCarlo, ..) => fact!("stated-by.monte-carlo", name, at),
        (StatementMethod::Auto, false, DifferenceCause::DegreesOfFreedom) => {
            fact!("stated-by.few-dof", name, at, difference)
        }
        (StatementMethod::Auto, false, DifferenceCause::Shape) => {
            fact!("stated-by.near", name, at, difference, allowed)
        }
        (StatementMethod::Auto, true, _) if agreement.at_infinite_dof => {
            fact!("stated-by.shape-few-dof", name, at, difference, allowed)
        }
        (StatementMethod::Auto, true, _) => {
            fact!("stated-by.shape", name, at, difference, allowed)
        }
    })
}

/// Why the standard uncertainties of the two methods differ: few degrees of freedom, a model that is
/// not linear, or both.
fn of_difference(
    task: &Task,
    name: &str,
    at: Option<Fact>,
    row: &RowEvaluation,
    output: &OutputEvaluation,
    found: &mut Vec<Warning>,
) {
    let (Some(gum), Some(monte_carlo)) = (&output.gum, &output.monte_carlo) else {
        return;
    };
    let Some(u) = monte_carlo.standard_uncertainty else {
        return;
    };
    let (linear, drawn) = (gum.standard_uncertainty, gum.drawn_by_dof());
    let own = monte_carlo.errors.standard_uncertainty.unwrap_or(0.0);
    let error = own.max(scatter_of_few(linear, monte_carlo.trials));
    // contributions that cancel leave rounding alone
    let rounding = ROUNDING * gum.largest_contribution();
    let rounding = rounding.max(4.0 * f64::EPSILON * gum.estimate.abs());
    if (u - linear).abs() <= f64::max(NOTEWORTHY * linear, 3.0 * error).max(rounding) {
        return;
    }
    let percent =
        |from: f64| Argument::Number(format!("{:.0} %", 100.0 * (from / linear - 1.0).abs()));
    // what is not finite without such a distribution left the range of double precision
    let has_t = output.drawn_dof.is_finite() || drawn.is_finite();
    let by_dof = drawn > (1.0 + NOTEWORTHY) * linear && has_t;
    let alone = match drawn.is_finite() {
        true => percent(drawn),
        false => fact!("beyond-bounds").into(),
    };
    let difference = match (linear > 0.0, u > linear) {
        (true, true) => fact!("difference.above", percent = percent(u)),
        (true, false) => fact!("difference.below", percent = percent(u)),
        (false, _) => fact!("difference.from-zero"),
    };
    if output.nonlinear != Some(true) {
        if by_dof {
            let is_allowed_for = !matches!(gum.dof, Dof::Undefined)
                && !matches!(task.settings.coverage, Coverage::Factor { fixed: true, .. });
            let conclusion = match (is_allowed_for, output.drawn_dof.is_finite()) {
                (false, _) => fact!("few-dof-not-allowed-for"),
                (true, true) => fact!("few-dof-allowed-for"),
                (true, false) => fact!("few-dof-long-tails"),
            };
            let dof = fewest(output);
            let fact = fact!("few-dof", name, at, difference, dof, alone, conclusion);
            push(found, Warning::new(name, fact));
        } else if (gum.drawn_uncertainty() / linear - 1.0).abs() > NOTEWORTHY {
            let name_of = |v: usize| Some(format!("`{}`", task.variables.get(v)?.name));
            let results: Vec<String> = gum.bent_results().filter_map(name_of).collect();
            let fact = fact!("non-linear.results", name, at, difference, results);
            push(found, Warning::new(name, fact));
        }
        return;
    }
    // what a copula or the ranks of a result change is said elsewhere
    if !row.copula_changes.is_empty() || !row.jointly_drawn.is_empty() {
        return;
    }
    let few_dof = by_dof.then(|| fact!("non-linear-few-dof", dof = fewest(output), alone));
    let second = output.second_order.as_ref().map(|second| second_order(task, gum, second));
    let second = second.map(|said| fact!("non-linear-terms", said));
    push(found, Warning::new(name, fact!("non-linear", name, at, difference, few_dof, second)));
}

/// The fewest degrees of freedom of what is drawn as a t, in brackets.
fn fewest(output: &OutputEvaluation) -> Option<Fact> {
    let dof = output.drawn_dof;
    dof.is_finite().then(|| fact!("in-brackets", dof))
}

/// What the terms of second order of the law of propagation make of it, and which products matter
/// though nothing is seen of them at the estimates.
fn second_order(task: &Task, gum: &Gum, second: &SecondOrder) -> Fact {
    let number = |value: f64| Argument::Number(significant(value, task.settings.digits.max(2)));
    let name = |v: usize| task.variables.get(v).map_or("", |variable| variable.name.as_str());
    let lines: HashMap<usize, BudgetLine> =
        gum.budget().map(|line| (line.variable, line)).collect();
    let contribution = |v: usize| lines.get(&v).map_or(0.0, |line| line.contribution);
    let product = |&(i, j, c): &(usize, usize, f64)| {
        let product = match i == j {
            true => fact!("squared", name = name(i)),
            false => fact!("times", first = name(i), second = name(j)),
        };
        let contribution_of = contribution(i).max(contribution(j));
        match contribution_of < 0.1 * c {
            true => fact!("contributes.hidden", product, contribution = number(c)),
            false => fact!("contributes", product, contribution = number(c)),
        }
    };
    let products: Vec<Fact> = second.products.iter().map(product).collect();
    let products = (!products.is_empty()).then(|| fact!("second-order-products", products));
    let with_terms = number(second.standard_uncertainty);
    fact!("second-order", with_terms, linear = number(gum.standard_uncertainty), products)
}

/// Correlation coefficients of an output of which the trials have none.
fn of_correlations(
    name: &str,
    jumps: bool,
    evaluated: &OutputEvaluation,
    found: &mut Vec<Warning>,
) {
    if evaluated
        .monte_carlo
        .as_ref()
        .is_none_or(|figures| figures.standard_uncertainty.is_some() && !jumps)
    {
        return;
    }
    let fact = match &evaluated.gum {
        Some(_) => fact!("correlations-by-propagation", name),
        None => fact!("correlations-by-propagation.none", name),
    };
    push(found, Warning::new(name, fact));
}

/// A decision without trials.
fn conformity_by_propagation(name: &str) -> Warning {
    Warning::new(name, fact!("conformity-by-propagation", name))
}

/// Trials without a variance, though every input that is drawn as a t has one.
fn of_heavy_tails(
    name: &str,
    at: &Option<Fact>,
    output: &OutputEvaluation,
    figures: &MonteCarlo,
    found: &mut Vec<Warning>,
) {
    if figures.standard_uncertainty.is_some() || figures.trials < 2 || output.drawn_dof <= 2.0 {
        return;
    }
    let missing = match figures.estimate {
        Some(_) => fact!("no-deviation"),
        None => fact!("no-moments"),
    };
    let value = match output.gum {
        Some(_) => fact!("value-by-propagation"),
        None => fact!("value-is-median"),
    };
    push(found, Warning::new(name, fact!("heavy-tails", name, at = at.clone(), missing, value)));
}

/// Intervals from the least to the greatest trial.
fn of_extremes(name: &str, at: &Option<Fact>, figures: &MonteCarlo, found: &mut Vec<Warning>) {
    if figures.errors.symmetric_interval.iter().any(|error| error.is_nan()) {
        let trials = figures.trials;
        let fact = fact!("interval-of-extremes", name, at = at.clone(), trials);
        push(found, Warning::new(name, fact));
    }
}

/// Where outputs of saved results nearly cancel, so that what is known of how they vary together
/// does not do; and what a copula that does not give their coefficients makes of it.
fn of_results(
    name: &str,
    at: &Option<Fact>,
    row: &RowEvaluation,
    gum: &Gum,
    spread: f64,
    found: &mut Vec<Warning>,
) {
    if row.jointly_drawn.is_empty() && row.copula_changes.is_empty() {
        return;
    }
    let lines: HashMap<usize, BudgetLine> =
        gum.budget().map(|line| (line.variable, line)).collect();
    let line = |v: usize| lines.get(&v);
    for set in &row.jointly_drawn {
        let contributions = set.variables.iter().filter_map(|&v| line(v)).map(|l| l.contribution);
        let largest = contributions.fold(0.0, f64::max);
        // ranks of so many trials leave less than this of what should cancel
        let left = largest / (set.trials as f64).sqrt();
        if 0.5 * left.powi(2) > CANCELLED * spread.powi(2) {
            let at = at.clone();
            let left = Argument::Number(format!("{left:.1e}"));
            let spread = Argument::Number(format!("{spread:.1e}"));
            let fact = fact!("result-cancellation", name, at, trials = set.trials, left, spread);
            push(found, Warning::new(name, fact));
        }
    }
    let change: f64 = row
        .copula_changes
        .iter()
        .filter_map(|(c, drawn)| {
            let (a, b) = (line(c.first)?, line(c.second)?);
            let signed = |l: &BudgetLine| l.contribution.copysign(l.sensitivity);
            Some(2.0 * (drawn - c.coefficient) * signed(a) * signed(b))
        })
        .sum();
    let variance = gum.standard_uncertainty.powi(2);
    let drawn = (variance + change).max(0.0).sqrt();
    let relative = drawn / gum.standard_uncertainty - 1.0;
    if relative.abs() > NOTEWORTHY {
        let drawn = Argument::Number(format!("{drawn:.2e}"));
        let linear = Argument::Number(format!("{:.2e}", gum.standard_uncertainty));
        let fact = fact!("copula-effect", name, at = at.clone(), drawn, linear);
        push(found, Warning::new(name, fact));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Gamma, Normal};
    use crate::model::Tolerance;
    use crate::propagate::exact::test_task;
    use crate::task::MethodChoice;

    /// Each figure of the trials that is moved by ten of its numerical standard errors is named, and none
    /// else; with its own seed none is.
    #[test]
    fn every_figure_is_compared_with_that_without_noise() {
        let inputs =
            vec![Gamma::new(3.0, 1.0).unwrap().into(), Normal::new(0.0, 1.0).unwrap().into()];
        let mut task = test_task(inputs, "x0 + x1", 0.95);
        task.settings.trials = 20_000.into();
        task.settings.method = Some(MethodChoice::Exact);
        task.model.outputs[0].tolerance = Some(Tolerance { lower: Some(0.0), upper: Some(6.0) });
        let run = crate::propagate::evaluate(&task, &Default::default()).unwrap();
        let output = run.rows[0].outputs[0].clone();
        let said = |output: &OutputEvaluation| {
            let mut found = Vec::new();
            of_noiseless("y", output, &mut found);
            found.first().and_then(|warning| match warning.fact.arguments.last() {
                Some(("far", Argument::List(far))) => Some(far.clone()),
                _ => None,
            })
        };
        assert_eq!(said(&output), None);
        type Change = fn(&mut MonteCarlo);
        let moved: [(&str, Change); 8] = [
            ("figure.estimate", |outcome| *outcome.estimate.as_mut().unwrap() += 0.2),
            ("figure.standard-uncertainty", |outcome| {
                *outcome.standard_uncertainty.as_mut().unwrap() += 0.2
            }),
            ("figure.median", |outcome| outcome.median += 0.2),
            ("figure.symmetric-lower", |outcome| outcome.symmetric_interval[0] += 0.5),
            ("figure.symmetric-upper", |outcome| outcome.symmetric_interval[1] += 0.9),
            ("figure.shortest-lower", |outcome| outcome.shortest_interval[0] -= 1.5),
            ("figure.shortest-upper", |outcome| outcome.shortest_interval[1] += 1.5),
            ("figure.inside", |outcome| outcome.inside -= 0.03),
        ];
        for (name, moved) in moved {
            let mut output = output.clone();
            moved(output.monte_carlo.as_mut().unwrap());
            let far = said(&output).unwrap_or_default();
            let [Argument::Fact(moved)] = &far[..] else { panic!("{name}: {far:?}") };
            let figure = Argument::from(Fact { key: name, arguments: Vec::new() });
            assert_eq!(moved.arguments[0], ("figure", figure));
        }
    }
}
