//! A drift of what is left along the rows.
//!
//! A table of observations mostly has its rows in the order in which they were taken, but time is not
//! among its conditions. What changes slowly over a campaign (a warming bench, a wearing bearing) then
//! is no function of anything that a hypothesis knows, and looks like an offset with more noise.

use gumption_engine::linalg::dot;
use gumption_engine::special::{normal, student};
use gumption_inference::noise::remainder::Remainder;
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;

/// Fewer rows tell a drift from nothing else.
const LEAST_ROWS: usize = 10;

/// A slope as steep, or a correlation as large, as that of one in so many sets of residuals without a
/// drift is told.
const SELDOM: f64 = 1e4;

/// So much of the order of the rows, as a share of its variance, must be apart from the conditions: in
/// a single sweep nobody can tell time from the condition that is swept.
const APART: f64 = 0.25;

/// What is left by a hypothesis, if it drifts: the place of the output among the observed ones, and
/// by how many standard uncertainties of its noise it changes from the first row to the last.
pub(crate) fn drift(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Option<(usize, f64)> {
    let rows = setup.data.rows();
    if rows < LEAST_ROWS {
        return None;
    }
    let of_condition =
        |c: usize| -> Vec<f64> { (0..rows).map(|row| setup.row(row).conditions[c]).collect() };
    // the order, and what of it the conditions do not have
    let mut known: Vec<Vec<f64>> = vec![unit(vec![1.0; rows])?];
    let conditions = setup.case.set_conditions();
    known.extend(conditions.filter_map(|c| rest(of_condition(c), &[]).and_then(unit)));
    let known = orthonormal(known);
    let order: Vec<f64> = setup.data.ids.iter().map(|&id| id as f64).collect();
    let whole = rest(order.clone(), &known[..1])?;
    let order = rest(order, &known)?;
    let squares = dot(&order, &order);
    let dof = rows.checked_sub(known.len() + 1).filter(|dof| *dof > 0)? as f64;
    if squares < APART * dot(&whole, &whole) {
        return None;
    }
    let residuals = Remainder::of(setup, hypothesis).residuals;
    let outputs = setup.data.outputs.len();
    let span = setup.data.ids.last()?.abs_diff(*setup.data.ids.first()?) as f64;
    let of_output = |output: usize| {
        let own: Vec<f64> = residuals.iter().skip(output).step_by(outputs).copied().collect();
        let own = (own.len() == rows).then_some(own)?;
        let left = rest(own, &known)?;
        let slope = dot(&left, &order) / squares;
        let unexplained = (dot(&left, &left) - slope * slope * squares).max(0.0);
        let critical = student::two_sided_factor(1.0 - 1.0 / SELDOM, dof);
        let is_steep = slope * slope * squares * dof > critical * critical * unexplained;
        (is_steep && slope != 0.0).then_some((output, slope * span))
    };
    let found = (0..outputs).filter_map(of_output);
    found.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
}

/// What is left by a hypothesis, if neighbouring rows are alike more than in one of many sets of
/// independent residuals: the place of the output among the observed ones, and the coefficient of
/// correlation of neighbours, which has a standard deviation of 1/sqrt(n) by chance.
pub(crate) fn memory(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Option<(usize, f64)> {
    let rows = setup.data.rows();
    if rows < LEAST_ROWS {
        return None;
    }
    let residuals = Remainder::of(setup, hypothesis).residuals;
    let outputs = setup.data.outputs.len();
    let critical = normal::quantile(1.0 - 1.0 / SELDOM) / (rows as f64).sqrt();
    let of_output = |output: usize| {
        let own: Vec<f64> = residuals.iter().skip(output).step_by(outputs).copied().collect();
        let own = (own.len() == rows).then_some(own)?;
        let own = rest(own, &[unit(vec![1.0; rows])?])?;
        let products: f64 = own.windows(2).map(|pair| pair[0] * pair[1]).sum();
        let coefficient = products / dot(&own, &own);
        (coefficient > critical).then_some((output, coefficient))
    };
    let found = (0..outputs).filter_map(of_output);
    found.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// A vector less its parts along orthonormal ones; `None` where it is not finite.
fn rest(mut of: Vec<f64>, known: &[Vec<f64>]) -> Option<Vec<f64>> {
    // twice is enough for rounding
    for direction in known.iter().chain(known) {
        let along = dot(&of, direction);
        of.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
    }
    of.iter().all(|x| x.is_finite()).then_some(of)
}

/// A vector of length one in its direction; `None` for none.
fn unit(mut of: Vec<f64>) -> Option<Vec<f64>> {
    let length = dot(&of, &of).sqrt();
    of.iter_mut().for_each(|x| *x /= length);
    (length > 0.0).then_some(of)
}

/// Orthonormal vectors for unit ones; those that depend on the ones before are left out.
fn orthonormal(vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut known: Vec<Vec<f64>> = Vec::with_capacity(vectors.len());
    for vector in vectors {
        let Some(own) = rest(vector, &known) else { continue };
        if dot(&own, &own) > NEW
            && let Some(own) = unit(own)
        {
            known.push(own);
        }
    }
    known
}

/// A unit vector with less than this of its square apart from others is one of them but for rounding.
const NEW: f64 = 1e-12;
