//! Whether the standard deviation of the trials says that the model is not linear over the
//! uncertainties of its inputs.
//!
//! Of inputs of up to four degrees of freedom the standard deviation of trials has no standard error:
//! single trials far out in the tails carry it, and it is another one with another seed. What is stated
//! must not hang on it where the formula itself, or its terms of second order, say better.

use super::exact::Problem;
use super::figures::{NOTEWORTHY, scatter_of_few};
use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use super::second_order::SecondOrder;
use crate::model::{Node, Program};
use crate::number::{Binary, Unary};

/// Whether the trials' standard deviation is noteworthily another one than that of a linear model.
pub(super) fn differs_from_linear(gum: &Gum, figures: &MonteCarlo) -> bool {
    let Some(u) = figures.standard_uncertainty else {
        return false;
    };
    let drawn = gum.drawn_uncertainty();
    let noteworthy = NOTEWORTHY * gum.standard_uncertainty;
    let few = 3.0 * scatter_of_few(drawn, figures.trials);
    if few.is_finite() && (u - drawn).abs() <= few {
        return false;
    }
    match figures.errors.standard_uncertainty {
        Some(error) => (u - drawn).abs() > f64::max(3.0 * error, noteworthy),
        // of few degrees of freedom it settles slowly, and of up to 3, which have no skewness, so
        // slowly that it may still be anywhere below, down to what the GUM says, or a little below
        // that where the GUM has the same
        None if figures.skewness.is_some() => (u - drawn).abs() > 0.03 * drawn,
        None => {
            let least = f64::min(gum.standard_uncertainty - noteworthy, 0.97 * drawn);
            u > 1.03 * drawn || u < least
        }
    }
}

/// Whether it is so because the model is not linear: not where the formula is a sum of its inputs times
/// constants, and, where the standard deviation of the trials settles slowly, not where a smooth formula
/// has no terms of second order that count.
pub(super) fn is_nonlinear(
    problem: &Problem<'_>,
    gum: &Gum,
    figures: &MonteCarlo,
    second: Option<&SecondOrder>,
) -> bool {
    if !differs_from_linear(gum, figures) || problem.is_linear() {
        return false;
    }
    let u = gum.standard_uncertainty;
    let is_flat = |second: &SecondOrder| {
        (second.standard_uncertainty - u).abs() <= NOTEWORTHY * u && second.products.is_empty()
    };
    let settles = figures.errors.standard_uncertainty.is_some();
    let program = &problem.task.model.program;
    settles
        || !second.is_some_and(is_flat)
        || !program.outputs.get(problem.output).is_some_and(|output| is_smooth(program, *output))
}

/// Whether nothing that a node is computed from has a jump or a kink, as far as that is known.
fn is_smooth(program: &Program, node: usize) -> bool {
    let is_smooth = |node: &Node| match node {
        Node::Variable(_) | Node::Constant(_) => true,
        Node::Unary(of, _) => !matches!(of, Unary::Abs | Unary::Floor | Unary::Ceil | Unary::Round),
        Node::Binary(of, ..) => matches!(
            of,
            Binary::Add
                | Binary::Subtract
                | Binary::Multiply
                | Binary::Divide
                | Binary::Power
                | Binary::Hypot
        ),
        Node::Routine(_) => false,
    };
    let needed = program.needed_by(&[], [node]);
    program.nodes.iter().zip(needed).all(|(node, needed)| !needed || is_smooth(node))
}
