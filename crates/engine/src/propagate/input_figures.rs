//! What is known about whole input quantities, those made of components among them.

use std::ops::Range;
use std::sync::Arc;

use super::gum::{Dof, Gum, effective};
use crate::distribution::{Correlation, Distribution};
use crate::model::InputQuantity;
use crate::task::{Row, Task};

/// What is known about an input quantity in a row of conditions, in its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct InputFigures {
    /// Its variables in the task: one, or those of its components.
    pub variables: Range<usize>,
    /// Whether it is the sum of components, which have lines of their own in a budget.
    pub composed: bool,
    /// Its estimate.
    pub estimate: f64,
    /// Its standard uncertainty; that of components combined, with their correlation.
    pub standard_uncertainty: f64,
    /// Degrees of freedom of that; of components the effective ones (JCGM 100, G.2b).
    pub dof: Dof,
}

impl InputFigures {
    /// Those of all inputs of a task in a row.
    pub fn of_row(task: &Task, row: &Row) -> Vec<Self> {
        let composed = task.model.inputs.iter().any(|input| input.parts > 1);
        let links =
            if composed { effective(&task.correlations, &row.distributions) } else { Vec::new() };
        all(task, &row.distributions, &links)
    }

    /// Those of the inputs of an evaluated row.
    pub fn of_gum(task: &Task, gum: &Gum) -> Vec<Self> {
        all(task, &gum.inputs, gum.links())
    }
}

fn all(
    task: &Task,
    distributions: &[Arc<Distribution>],
    links: &[Correlation],
) -> Vec<InputFigures> {
    let mut first = 0;
    let one = |input: &InputQuantity| {
        let variables = first..(first + input.parts).min(distributions.len());
        first = variables.end;
        let own = task.variables.get(variables.start).map(|variable| &variable.name);
        let composed = input.parts > 1 || own != Some(&input.quantity.name);
        figures(variables, composed, distributions, links)
    };
    task.model.inputs.iter().map(one).collect()
}

/// The sum of some variables.
fn figures(
    variables: Range<usize>,
    composed: bool,
    distributions: &[Arc<Distribution>],
    links: &[Correlation],
) -> InputFigures {
    let parts = distributions.get(variables.clone()).unwrap_or_default();
    let estimate = parts.iter().map(|part| part.mean()).sum();
    let own: Vec<f64> = parts.iter().map(|part| part.standard_uncertainty()).collect();
    if let ([part], [u]) = (parts, own.as_slice()) {
        let dof = known_dof(part.dof());
        return InputFigures { variables, composed, estimate, standard_uncertainty: *u, dof };
    }
    // in the largest one, so that no square over- or underflows
    let largest = own.iter().fold(0.0_f64, |most, &u| most.max(u));
    let share = |variable: usize| {
        let u = variable.checked_sub(variables.start).and_then(|part| own.get(part));
        u.filter(|_| largest > 0.0).map_or(0.0, |u| u / largest)
    };
    let inside: Vec<&Correlation> = links
        .iter()
        .filter(|link| variables.contains(&link.first) && variables.contains(&link.second))
        .collect();
    let squares: f64 = variables.clone().map(|variable| share(variable).powi(2)).sum();
    let products: f64 = inside
        .iter()
        .map(|link| 2.0 * link.coefficient * share(link.first) * share(link.second))
        .sum();
    let relative = (squares + products).max(0.0).sqrt();
    let estimated = |variable: usize| {
        distributions.get(variable).is_some_and(|d| !d.dof().is_infinite()) && share(variable) > 0.0
    };
    let linked = inside.iter().any(|link| estimated(link.first) || estimated(link.second));
    let dof = if linked {
        Dof::Undefined
    } else {
        let terms = variables.clone().zip(parts).filter(|(variable, _)| estimated(*variable));
        let sum: f64 =
            terms.map(|(variable, part)| (share(variable) / relative).powi(4) / part.dof()).sum();
        known_dof(1.0 / sum)
    };
    let standard_uncertainty = largest * relative;
    InputFigures { variables, composed, estimate, standard_uncertainty, dof }
}

fn known_dof(dof: f64) -> Dof {
    match dof {
        dof if dof.is_nan() => Dof::Undefined,
        dof if dof.is_infinite() => Dof::Infinite,
        dof => Dof::Finite(dof),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Input;
    use crate::propagate::gum;

    /// A temperature of a reading, its calibration and a resolution.
    fn task() -> Task {
        Task::builder("")
            .input("t", Input::constant(23.0, "degC").unwrap())
            .component("t", "rep", Input::readings(&[-0.1, 0.0, 0.1, 0.0], "degC").unwrap())
            .component("t", "cal", Input::normal(0.0, 0.04, "degC").unwrap())
            .input("gain", Input::normal(2.0, 0.01, "1").unwrap())
            .equation("y", "gain*(t/[degC])")
            .output("y", "1")
            .trials(0)
            .build()
            .unwrap()
    }

    #[test]
    fn a_quantity_of_components_has_their_sum_and_combined_uncertainty() {
        let task = task();
        let [t, gain] = InputFigures::of_row(&task, &task.rows[0]).try_into().unwrap();
        // s = sqrt(0.02/3), u_rep = s/2 = sqrt(0.02/12); u^2 = 0.02/12 + 0.04^2
        let (rep, u) = ((0.02_f64 / 12.0).sqrt(), (0.02_f64 / 12.0 + 0.0016).sqrt());
        assert!(t.composed && !gain.composed);
        assert_eq!(t.estimate, 23.0);
        assert!((t.standard_uncertainty - u).abs() < 1e-15);
        // Welch-Satterthwaite with the readings' 3 degrees of freedom
        let expected = 3.0 * (u / rep).powi(4);
        assert!(matches!(t.dof, Dof::Finite(dof) if (dof - expected).abs() < 1e-9));
        assert_eq!((gain.estimate, gain.standard_uncertainty), (2.0, 0.01));
        assert_eq!(gain.dof, Dof::Infinite);
    }

    #[test]
    fn correlated_components_count_with_their_correlation() {
        let mut task = task();
        let place = |name: &str| task.variables.iter().position(|v| v.name == name).unwrap();
        let (first, second) = (place("t/rep"), place("t/cal"));
        task.correlations = vec![Correlation { first, second, coefficient: 1.0 }];
        let row = &task.rows[0];
        let t = &InputFigures::of_row(&task, row)[0];
        // fully correlated uncertainties add
        let sum = (0.02_f64 / 12.0).sqrt() + 0.04;
        assert!((t.standard_uncertainty - sum).abs() < 1e-15);
        assert_eq!(t.dof, Dof::Undefined);
        let evaluated = gum::evaluate(&task, row);
        assert_eq!(&InputFigures::of_gum(&task, evaluated.outputs[0].as_ref().unwrap())[0], t);
    }
}
