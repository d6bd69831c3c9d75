//! The terms of second order of the law of propagation (JCGM 100, 5.1.2, note; example H.1.7).

use super::gum::GumRow;
use crate::task::{Row, Task};

/// The law of propagation with its terms of second order, for one output.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondOrder {
    /// The standard uncertainty with them.
    pub standard_uncertainty: f64,
    /// What products of two quantities contribute to it, |d2f/dx_i dx_j| u_i u_j, for those that
    /// matter: the indices of the variables and the contribution. The two are the same for a square,
    /// which contributes |d2f/dx_i^2| u_i^2/sqrt(2).
    pub products: Vec<(usize, usize, f64)>,
}

/// Distance from the estimates, in standard uncertainties, over which derivatives of sensitivity
/// coefficients are taken as differences.
const STEP: f64 = 1.0 / 64.0;

/// Over a quarter of the step they must be the same but for this share, or the model has a kink there.
const SMOOTH: f64 = 0.1;

/// Of more inputs that vary no terms of second order are computed.
const MOST_INPUTS: usize = 200;

/// Products that contribute this share of the variance, at least, matter.
const MATTERS: f64 = 0.01;

/// For each output of a row the law of propagation with its terms of second order. `None` where they
/// do not exist, or inputs are correlated, for which the formula of the Guide does not hold.
pub(super) fn second_order(task: &Task, row: &Row, first: &GumRow) -> Vec<Option<SecondOrder>> {
    let count = first.outputs.len();
    let varying: Vec<(usize, f64)> = row
        .distributions
        .iter()
        .map(|distribution| distribution.standard_uncertainty())
        .enumerate()
        .filter(|(_, u)| *u > 0.0)
        .collect();
    // differences of differences would tell little
    if first.is_correlated() || varying.len() > MOST_INPUTS || task.function.is_some() {
        return vec![None; count];
    }
    let coarse = at_step(task, row, first, &varying, STEP);
    let fine = at_step(task, row, first, &varying, 0.25 * STEP);
    let same = |a: &SecondOrder, b: &SecondOrder| {
        let (a, b) = (a.standard_uncertainty, b.standard_uncertainty);
        (a - b).abs() <= SMOOTH * a.max(b)
    };
    let pairs = coarse.into_iter().zip(fine);
    pairs
        .map(|(coarse, fine)| coarse.zip(fine).filter(|(a, b)| same(a, b)).map(|(a, _)| a))
        .collect()
}

fn at_step(
    task: &Task,
    row: &Row,
    first: &GumRow,
    varying: &[(usize, f64)],
    step: f64,
) -> Vec<Option<SecondOrder>> {
    let estimates = row.estimates();
    let slopes = |variable: usize, shift: f64| {
        let mut values = estimates.clone();
        values[variable] += shift;
        task.model.program.gradients(&values).1
    };
    let shifted: Vec<[Vec<Vec<f64>>; 2]> =
        varying.iter().map(|&(v, u)| [slopes(v, step * u), slopes(v, -step * u)]).collect();
    let of_output = |output: usize| {
        let own = first.gradient(output)?;
        let mut products = Vec::new();
        let (mut linear, mut second) = (0.0, 0.0);
        for (place, &(i, u_i)) in varying.iter().enumerate() {
            let contribution = own.get(i)? * u_i;
            linear += contribution * contribution;
            for (other, (&(_, _), [above, below])) in varying.iter().zip(&shifted).enumerate() {
                let [above, below] =
                    [above, below].map(|gradients| gradients.get(output)?.get(i).copied());
                let (above, below) = (above? * u_i, below? * u_i);
                // d2f/dx_i dx_j and d3f/dx_i dx_j^2, times u_i u_j and u_i u_j^2
                let mixed = (above - below) / (2.0 * step);
                let third = (above - 2.0 * contribution + below) / (step * step);
                second += 0.5 * mixed * mixed + contribution * third;
                if place <= other {
                    products.push((place, other, mixed.abs()));
                }
            }
        }
        let variance = linear + second;
        if !(variance.is_finite() && variance > 0.0) {
            return None;
        }
        // a square counts half, a product in both orders
        let part = |&(i, j, c): &(usize, usize, f64)| if i == j { 0.5 * c * c } else { c * c };
        products.retain(|product| part(product) > MATTERS * variance);
        let named = |(i, j, c): (usize, usize, f64)| {
            (varying[i].0, varying[j].0, if i == j { c / 2f64.sqrt() } else { c })
        };
        let products = products.into_iter().map(named).collect();
        Some(SecondOrder { standard_uncertainty: variance.sqrt(), products })
    };
    (0..first.outputs.len()).map(of_output).collect()
}
