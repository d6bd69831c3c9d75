//! What a user should know about an evaluation that is given all the same.

use std::collections::HashMap;

use super::figures::{
    CapabilityStatement, Evaluation, FEW_ROWS, NOTEWORTHY, OutputEvaluation, RowEvaluation,
    scatter_of_few,
};
use super::gum::{BudgetLine, Dof, Gum};
use super::inherited_note;
use super::monte_carlo::{Adaptive, MonteCarlo};
use super::rounding;
use super::second_order::SecondOrder;
use crate::decimal::{significant, to_digits};
use crate::model::Output;
use crate::number::Shortest;
use crate::task::{Coverage, Task, Trials, Warning};

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
        found.push(Warning::new(
            "few-trials",
            "",
            format!(
                "{trials} trials are few for a coverage probability of {}: JCGM 101, 7.2.2 advises \
                 at least {needed:.0}",
                evaluation.coverage_probability
            ),
        ));
    }
    if evaluation.rounded_correlations {
        found.push(Warning::new(
            "correlations-rounded",
            "",
            "the declared correlation coefficients are possible only within their rounding; the \
             nearest possible ones are used in the trials",
        ));
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
            let (count, all) = (undefined.count, undefined.trials);
            let text = format!("{count} of {all} trials are not finite and were left out");
            push(&mut found, Warning::new("undefined-trials", "", text));
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
                let place_of_row = at(task, &named, row);
                let inherited = inherited_note::note(task, output, &place_of_row, evaluated);
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
    let text = format!(
        "{} are drawn by a Gaussian copula, fitted so that they have their distributions and the \
         declared correlation coefficients; the coefficients do not say more about their joint \
         distribution, so this is an assumption",
        names.join(", ")
    );
    found.push(Warning::new("gaussian-copula", "", text));
    if evaluation.copula_adjusted > 0.0 {
        let of_results =
            task.rows.iter().flat_map(|row| row.distributions.iter()).any(|d| d.saved().is_some());
        let text = if of_results {
            format!(
                "a Gaussian copula gives the correlation coefficients of these saved results only \
                 nearly; in the trials they differ by up to {:.1e}. Where outputs of one result \
                 nearly cancel, evaluate the whole in one model",
                evaluation.copula_adjusted
            )
        } else {
            format!(
                "a Gaussian copula gives the declared correlation coefficients only within their \
                 rounding; in the trials they differ by up to {:.1e}",
                evaluation.copula_adjusted
            )
        };
        found.push(Warning::new("copula-adjusted", "", text));
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
    let of =
        |figure: &str, trials, exact, error, own| (figure.to_owned(), trials, exact, error, own);
    let mut figures = vec![
        of(
            "estimate",
            trials.estimate,
            noiseless.estimate,
            errors.estimate,
            own.and_then(|own| own.estimate),
        ),
        of(
            "standard uncertainty",
            trials.standard_uncertainty,
            noiseless.standard_uncertainty,
            errors.standard_uncertainty,
            own.and_then(|own| own.standard_uncertainty),
        ),
        of(
            "median",
            Some(trials.median),
            Some(noiseless.median),
            Some(errors.median),
            own.map(|own| own.median),
        ),
        of(
            "probability within the tolerance",
            Some(trials.inside),
            noiseless.inside,
            noiseless.inside.map(|inside| (inside * (1.0 - inside) / trials.trials as f64).sqrt()),
            own.and_then(|own| own.inside),
        ),
    ];
    let both_unique = trials.shortest_unique && noiseless.shortest_unique;
    for (place, end) in ["lower", "upper"].into_iter().enumerate() {
        figures.push(of(
            &format!("{end} end of the symmetric interval"),
            Some(trials.symmetric_interval[place]),
            Some(noiseless.symmetric_interval[place]),
            Some(errors.symmetric_interval[place]),
            own.map(|own| own.symmetric_interval[place]),
        ));
        let shortest = noiseless.shortest_interval.filter(|_| both_unique);
        figures.push(of(
            &format!("{end} end of the shortest interval"),
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
        (error > 0.0 && count > BEYOND).then(|| format!("its {figure} by {count:.1}"))
    });
    let far: Vec<String> = far.collect();
    if !far.is_empty() {
        let text = format!(
            "`{name}`: figures of the trials are farther from those without their noise than {BEYOND} \
             numerical standard errors: {}",
            far.join(", ")
        );
        push(found, Warning::new("trials-off", name, text));
    }
}

fn push(found: &mut Vec<Warning>, warning: Warning) {
    let known = |w: &Warning| w.code == warning.code && w.place == warning.place;
    if !found.iter().any(known) {
        found.push(warning);
    }
}

/// A variance that declared coefficients leave nothing of, where they are possible only within their
/// rounding.
fn of_rounded_correlations(name: &str, output: &OutputEvaluation) -> Option<Warning> {
    let drawn = output.monte_carlo.as_ref()?.standard_uncertainty?;
    let gum = output.gum.as_ref()?;
    let rounding = ROUNDING * gum.largest_contribution();
    let is_lost = gum.standard_uncertainty == 0.0 && drawn > rounding;
    is_lost.then(|| {
        let text = format!(
            "`{name}`: the declared correlation coefficients leave no variance by the law of \
             propagation, or one below zero, and the nearest possible ones do; take the Monte Carlo \
             figures, or state the coefficients with more digits"
        );
        Warning::new("correlations-rounded", name, text)
    })
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
    let code = if first.raised { "raised-to-cmc" } else { "below-cmc" };
    let cmc = unit.after(&first.cmc_text());
    let text = match (rows, first.raised) {
        ([_], true) => {
            let expanded = first.rounded(task.settings.digits).map(|expanded| expanded.to_string());
            let expanded = unit.after(&expanded.unwrap_or_default());
            format!(
                "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) of {cmc} \
                 and raised to it: {expanded} is to be stated"
            )
        }
        ([_], false) => {
            let expanded = unit.after(&significant(first.expanded_uncertainty, 3));
            format!(
                "the expanded uncertainty of `{name}` is {expanded}, below the laboratory's capability \
                 (CMC) of {cmc}, and must not be stated (ILAC-P14)"
            )
        }
        (_, true) => format!(
            "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) in {} of {} \
             rows, and raised to it there",
            below.len(),
            rows.len()
        ),
        (_, false) => format!(
            "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) in {} of {} \
             rows, and must not be stated there (ILAC-P14)",
            below.len(),
            rows.len()
        ),
    };
    push(found, Warning::new(code, name.as_str(), text));
}

/// Where a row is, in words.
fn at(task: &Task, named: &[usize], row: &RowEvaluation) -> String {
    if row.conditions.is_empty() {
        String::new()
    } else {
        let values: Vec<String> = task
            .model
            .conditions
            .iter()
            .zip(&row.conditions)
            .enumerate()
            .filter(|(place, _)| named.contains(place))
            .map(|(_, (c, &value))| {
                let value = Shortest(to_digits(value, NAMED_DIGITS));
                format!("{} = {}", c.name, c.unit.after(&value.to_string()))
            })
            .collect();
        format!(" at {}", values.join(", "))
    }
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
    let at = at(task, named, row);
    let Some(gum) = &output.gum else {
        let text = format!(
            "`{name}`{at}: the estimate or a sensitivity coefficient is not finite at the inputs' \
             estimates, so there is no GUM evaluation"
        );
        push(found, Warning::new("gum-undefined", name, text));
        if let Some(monte_carlo) = &output.monte_carlo {
            of_extremes(name, &at, monte_carlo, found);
            of_heavy_tails(name, &at, output, monte_carlo, found);
        }
        return;
    };
    if gum.dof == Dof::Undefined {
        let way = match gum.coverage_factor {
            Some(k) => format!("the stated factor k = {k} is used as it stands"),
            None => "the Monte Carlo interval is the way, or a stated `coverage_factor`".into(),
        };
        let text = format!(
            "`{name}`{at}: correlated inputs have finite degrees of freedom, for which the \
             Welch-Satterthwaite formula does not hold; {way}"
        );
        push(found, Warning::new("gum-dof-undefined", name, text));
    }
    let Some(monte_carlo) = &output.monte_carlo else {
        if let Some(second) = &output.second_order {
            let said = second_order_text(task, gum, second);
            push(found, Warning::new("non-linear", name, format!("`{name}`{at}: {said}")));
        }
        return;
    };
    of_extremes(name, &at, monte_carlo, found);
    of_heavy_tails(name, &at, output, monte_carlo, found);
    let spread = monte_carlo.standard_uncertainty.unwrap_or(gum.standard_uncertainty);
    of_results(name, &at, row, gum, spread, found);
    if let Some(Adaptive { converged: false, tolerance, .. }) = monte_carlo.adaptive
        && !monte_carlo.heavy_tailed
    {
        let text = format!(
            "`{name}`{at}: after {} trials the figures are not yet stable to the tolerance \
             {tolerance}; the numerical standard errors say how far they are",
            monte_carlo.trials
        );
        push(found, Warning::new("not-converged", name, text));
    }
    if output.drawn_dof <= 2.0 {
        let text = format!(
            "`{name}`{at}: an input is drawn from a t distribution with {} {} of freedom, which \
             has no {}{}, so the trials have no {}; the coverage intervals stand, and the value is the \
             estimate by the law of propagation",
            output.drawn_dof,
            if output.drawn_dof == 1.0 { "degree" } else { "degrees" },
            if output.drawn_dof > 1.0 { "variance" } else { "expectation and no variance" },
            if output.drawn_dof > 1.0 && monte_carlo.estimate.is_none() {
                ", and through this model no expectation"
            } else {
                ""
            },
            if monte_carlo.estimate.is_some() {
                "standard uncertainty"
            } else {
                "estimate and no standard uncertainty"
            }
        );
        push(found, Warning::new("no-variance", name, text));
    } else if !is_told {
        of_difference(task, name, &at, row, output, found);
    }
}

/// What rounding leaves of contributions that cancel, in the largest of them.
const ROUNDING: f64 = 1e-13;

/// Why the standard uncertainties of the two methods differ: few degrees of freedom, a model that is
/// not linear, or both.
fn of_difference(
    task: &Task,
    name: &str,
    at: &str,
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
    let percent = |from: f64| format!("{:.0} %", 100.0 * (from / linear - 1.0).abs());
    // what is not finite without such a distribution left the range of double precision
    let has_t = output.drawn_dof.is_finite() || drawn.is_finite();
    let by_dof = drawn > (1.0 + NOTEWORTHY) * linear && has_t;
    let alone = || if drawn.is_finite() { percent(drawn) } else { "beyond all bounds".to_owned() };
    let side = if u > linear { "above" } else { "below" };
    let difference = if linear > 0.0 {
        format!("is {} {side} that of the GUM", percent(u))
    } else {
        "is not zero as that of the GUM is".to_owned()
    };
    if output.nonlinear != Some(true) {
        if by_dof {
            let text = format!(
                "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because standard \
                 uncertainties of inputs have few degrees of freedom{}: what is drawn for them has \
                 a larger standard deviation, which alone makes {}. {}",
                fewest(output),
                alone(),
                if matches!(gum.dof, Dof::Undefined)
                    || matches!(task.settings.coverage, Coverage::Factor { fixed: true, .. })
                {
                    "Neither is wrong; no coverage factor of the GUM allows for it here"
                } else if output.drawn_dof.is_finite() {
                    "Neither is wrong; the GUM allows for it in the coverage factor"
                } else {
                    "The GUM allows for it in its coverage factor, that of a t distribution, whose \
                     long tails these inputs do not have"
                }
            );
            push(found, Warning::new("few-dof", name, text));
        } else if (gum.drawn_uncertainty() / linear - 1.0).abs() > NOTEWORTHY {
            let text = of_bent_results(task, name, at, &difference, gum);
            push(found, Warning::new("non-linear", name, text));
        }
        return;
    }
    // what a copula or the ranks of a result change is said elsewhere
    if !row.copula_changes.is_empty() || !row.jointly_drawn.is_empty() {
        return;
    }
    let mut text = format!(
        "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because the model is not \
         linear over the uncertainties of its inputs"
    );
    if by_dof {
        text += &format!(
            "; few degrees of freedom{} alone would bring it {} above",
            fewest(output),
            alone()
        );
    }
    if let Some(second) = &output.second_order {
        text += "; ";
        text += &second_order_text(task, gum, second);
    }
    push(found, Warning::new("non-linear", name, text + ". Take the Monte Carlo figures"));
}

/// That saved results come from models that are not linear.
fn of_bent_results(task: &Task, name: &str, at: &str, difference: &str, gum: &Gum) -> String {
    let of = |v: usize| task.variables.get(v).map(|variable| format!("`{}`", variable.name));
    let results: Vec<String> = gum.bent_results().filter_map(of).collect();
    format!(
        "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because of saved results \
         whose trials have another standard deviation than their standard uncertainty ({}), as their \
         models are not linear. Take the Monte Carlo figures",
        results.join(", ")
    )
}

/// The fewest degrees of freedom of what is drawn as a t, in brackets.
fn fewest(output: &OutputEvaluation) -> String {
    let dof = output.drawn_dof;
    if dof.is_finite() { format!(" ({})", Shortest(dof)) } else { String::new() }
}

/// What the terms of second order of the law of propagation make of it, and which products matter
/// though nothing is seen of them at the estimates.
pub fn second_order_text(task: &Task, gum: &Gum, second: &SecondOrder) -> String {
    let number = |value: f64| significant(value, task.settings.digits.max(2));
    let mut text = format!(
        "with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives {} \
         instead of {}",
        number(second.standard_uncertainty),
        number(gum.standard_uncertainty)
    );
    let name = |v: usize| task.variables.get(v).map_or("", |variable| variable.name.as_str());
    let lines: HashMap<usize, BudgetLine> =
        gum.budget().map(|line| (line.variable, line)).collect();
    let contribution = |v: usize| lines.get(&v).map_or(0.0, |line| line.contribution);
    let products: Vec<String> = second
        .products
        .iter()
        .map(|&(i, j, c)| {
            let product = if i == j {
                format!("`{}` squared", name(i))
            } else {
                format!("`{}` times `{}`", name(i), name(j))
            };
            let hidden = contribution(i).max(contribution(j)) < 0.1 * c;
            let seen =
                if hidden { ", though their sensitivity coefficients vanish here" } else { "" };
            format!("{product} contributes {}{seen}", number(c))
        })
        .collect();
    if !products.is_empty() {
        text += &format!("; {}", products.join(", "));
    }
    text
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
    let text = match &evaluated.gum {
        Some(_) => format!(
            "`{name}`: its trials have no standard deviation that means something, so its correlation \
             coefficients are those of the law of propagation"
        ),
        None => format!(
            "`{name}`: its trials have no standard deviation that means something, and there is no GUM \
             evaluation, so it has no correlation coefficients"
        ),
    };
    push(found, Warning::new("correlations-by-propagation", name, text));
}

/// A decision without trials.
fn conformity_by_propagation(name: &str) -> Warning {
    let text = format!(
        "`{name}`: without trials it is decided about its tolerance by the law of propagation, as of a \
         normal or t distribution (JCGM 106, 7.2); trials show whether that holds"
    );
    Warning::new("conformity-by-propagation", name, text)
}

/// Trials without a variance, though every input that is drawn as a t has one.
fn of_heavy_tails(
    name: &str,
    at: &str,
    output: &OutputEvaluation,
    figures: &MonteCarlo,
    found: &mut Vec<Warning>,
) {
    if figures.standard_uncertainty.is_some() || figures.trials < 2 || output.drawn_dof <= 2.0 {
        return;
    }
    let missing = match figures.estimate {
        Some(_) => "no standard deviation",
        None => "no expectation and no standard deviation",
    };
    let value = match output.gum {
        Some(_) => "the value is the estimate by the law of propagation",
        None => "the value is the median",
    };
    let text = format!(
        "`{name}`{at}: trials far out, of which a run has few or none, carry its moments, so that trials \
         tell {missing} (JCGM 101, 3.6, note 1); median and coverage intervals stand, and {value}"
    );
    push(found, Warning::new("heavy-tails", name, text));
}

/// Intervals from the least to the greatest trial.
fn of_extremes(name: &str, at: &str, figures: &MonteCarlo, found: &mut Vec<Warning>) {
    if figures.errors.symmetric_interval.iter().any(|error| error.is_nan()) {
        let text = format!(
            "`{name}`{at}: {} trials are so few for this coverage probability that the Monte Carlo \
             interval is that of the extreme ones, which has no numerical standard error; clause 8 \
             is left undecided",
            figures.trials
        );
        push(found, Warning::new("interval-of-extremes", name, text));
    }
}

/// Where outputs of saved results nearly cancel, so that what is known of how they vary together
/// does not do; and what a copula that does not give their coefficients makes of it.
fn of_results(
    name: &str,
    at: &str,
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
            let text = format!(
                "`{name}`{at}: outputs of a saved result nearly cancel, and the {} trials that the \
                 result holds tell how they vary together to about {left:.1e} only, of a standard \
                 uncertainty of {spread:.1e} in the trials here; evaluate the whole in one model",
                set.trials
            );
            push(found, Warning::new("result-cancellation", name, text));
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
        let text = format!(
            "`{name}`{at}: with the correlation coefficients that the Gaussian copula gives in place \
             of those of the inputs, its standard uncertainty in the trials is about {drawn:.2e}, \
             not {:.2e}",
            gum.standard_uncertainty
        );
        push(found, Warning::new("copula-effect", name, text));
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
            found.first().map(|warning| warning.text.clone())
        };
        assert_eq!(said(&output), None);
        type Change = fn(&mut MonteCarlo);
        let moved: [(&str, Change); 8] = [
            ("its estimate by", |outcome| *outcome.estimate.as_mut().unwrap() += 0.2),
            ("its standard uncertainty by", |outcome| {
                *outcome.standard_uncertainty.as_mut().unwrap() += 0.2
            }),
            ("its median by", |outcome| outcome.median += 0.2),
            ("its lower end of the symmetric", |outcome| outcome.symmetric_interval[0] += 0.5),
            ("its upper end of the symmetric", |outcome| outcome.symmetric_interval[1] += 0.9),
            ("its lower end of the shortest", |outcome| outcome.shortest_interval[0] -= 1.5),
            ("its upper end of the shortest", |outcome| outcome.shortest_interval[1] += 1.5),
            ("its probability within the tolerance", |outcome| outcome.inside -= 0.03),
        ];
        for (name, moved) in moved {
            let mut output = output.clone();
            moved(output.monte_carlo.as_mut().unwrap());
            let text = said(&output).unwrap_or_default();
            let listed = text.rsplit_once("errors: ").map_or("", |(_, listed)| listed);
            assert!(listed.starts_with(name) && !listed.contains(", "), "{name}: {text}");
        }
    }
}
