//! What a user should know about an evaluation that is given all the same.

use super::evaluation::{Evaluation, OutputEvaluation, RowEvaluation};
use super::gum::Dof;
use super::monte_carlo::Adaptive;
use crate::task::{Task, Trials, Warning};

/// A difference of the two standard uncertainties below this is not worth a note.
const NOTEWORTHY: f64 = 0.01;

/// The warnings and notes of an evaluation, in the order of rows and outputs; each code stands once
/// for an output, at the first row that it concerns.
pub fn warnings(task: &Task, evaluation: &Evaluation) -> Vec<Warning> {
    let mut found: Vec<Warning> = Vec::new();
    let needed = 1e4 / (1.0 - evaluation.coverage_probability);
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
    for row in &evaluation.rows {
        if let Some(undefined) = &row.undefined {
            let (count, all) = (undefined.count, undefined.trials);
            let text = format!("{count} of {all} trials are not finite and were left out");
            push(&mut found, Warning::new("undefined-trials", "", text));
        }
        for (output, evaluated) in task.model.outputs.iter().zip(&row.outputs) {
            of_output(task, &output.quantity.name, row, evaluated, &mut found);
        }
    }
    found
}

/// Which inputs were drawn by a copula, and where that could not be exact.
fn copula(task: &Task, evaluation: &Evaluation, found: &mut Vec<Warning>) {
    if evaluation.copula.is_empty() {
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

fn push(found: &mut Vec<Warning>, warning: Warning) {
    let known = |w: &Warning| w.code == warning.code && w.place == warning.place;
    if !found.iter().any(known) {
        found.push(warning);
    }
}

fn of_output(
    task: &Task,
    name: &str,
    row: &RowEvaluation,
    output: &OutputEvaluation,
    found: &mut Vec<Warning>,
) {
    let at = if row.conditions.is_empty() {
        String::new()
    } else {
        let values: Vec<String> = task
            .model
            .conditions
            .iter()
            .zip(&row.conditions)
            .map(|(c, value)| format!("{} = {value} {}", c.name, c.unit).trim_end().to_owned())
            .collect();
        format!(" at {}", values.join(", "))
    };
    let Some(gum) = &output.gum else {
        let text = format!(
            "`{name}`{at}: the estimate or a sensitivity coefficient is not finite at the inputs' \
             estimates, so there is no GUM evaluation"
        );
        return push(found, Warning::new("gum-undefined", name, text));
    };
    if gum.dof == Dof::Undefined {
        let way = match gum.coverage_factor {
            Some(k) => format!("the factor k = {k} of the file is used as it stands"),
            None => {
                "the Monte Carlo interval is the way, or a `coverage_factor` in the file".into()
            }
        };
        let text = format!(
            "`{name}`{at}: correlated inputs have finite degrees of freedom, for which the \
             Welch-Satterthwaite formula does not hold; {way}"
        );
        push(found, Warning::new("gum-dof-undefined", name, text));
    }
    let Some(monte_carlo) = &output.monte_carlo else {
        return;
    };
    if let Some(Adaptive { converged: false, tolerance, .. }) = monte_carlo.adaptive {
        let text = format!(
            "`{name}`{at}: after {} trials the figures are not yet stable to the tolerance \
             {tolerance}; the numerical standard errors say how far they are",
            monte_carlo.trials
        );
        push(found, Warning::new("not-converged", name, text));
    }
    if output.drawn_dof <= 2.0 {
        let text = format!(
            "`{name}`{at}: an input is drawn from a t distribution with {} degrees of freedom, which \
             has no variance, so the trials have no standard uncertainty; the coverage intervals \
             stand",
            output.drawn_dof
        );
        push(found, Warning::new("no-variance", name, text));
    } else if let (true, Some(u)) = (output.drawn_dof.is_finite(), monte_carlo.standard_uncertainty)
    {
        let error = monte_carlo.errors.standard_uncertainty.unwrap_or(0.0);
        let difference = u - gum.standard_uncertainty;
        if difference > NOTEWORTHY * gum.standard_uncertainty && difference > 3.0 * error {
            let text = format!(
                "`{name}`{at}: the Monte Carlo standard uncertainty is {:.0} % above that of the GUM \
                 because an input has few degrees of freedom ({}): its trials follow a t \
                 distribution, whose standard deviation is sqrt(dof/(dof - 2)) times the standard \
                 uncertainty. Neither is wrong; the GUM allows for it in the coverage factor",
                100.0 * difference / gum.standard_uncertainty,
                output.drawn_dof
            );
            push(found, Warning::new("few-dof", name, text));
        }
    }
}
