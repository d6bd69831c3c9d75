//! A phase whose trials lie on both sides of the cut of the arctangent, where nothing says that it
//! comes round.

use std::f64::consts::PI;

use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use crate::model::{Node, Output, Program};
use crate::number::Binary;
use crate::task::Warning;
use gumption_units::{Dimension, Unit};

/// Trials beyond the cut that are worth a note, and their least share.
const LEAST: f64 = 10.0;
const LEAST_SHARE: f64 = 1e-5;

/// How far mean and standard deviation of the trials may be from those of two lumps a turn apart,
/// relative to the standard deviation.
const OFF: f64 = 0.1;

/// The note about output `number` of a model, if its trials jump by a turn.
pub(super) fn note(
    program: &Program,
    (number, output): (usize, &Output),
    gum: &Gum,
    trials: &MonteCarlo,
) -> Option<Warning> {
    let unit = &output.quantity.unit;
    if output.period.is_some() || !has_cut(program, *program.outputs.get(number)?) {
        return None;
    }
    let turn = turn(unit)?;
    let spread = trials.standard_uncertainty?;
    // a share p of the trials is a turn away: their mean by p turns, their variance larger by
    // p (1 - p) turns squared
    let away = (trials.estimate? - gum.estimate).abs() / turn;
    let u = gum.standard_uncertainty;
    let expected = (u * u + turn * turn * away * (1.0 - away)).sqrt();
    let few = away * trials.trials as f64 <= LEAST || away < LEAST_SHARE;
    // less than twice the standard uncertainty of the law of propagation is not a jump
    if few || away >= 1.0 || expected < 2.0 * u || (spread / expected - 1.0).abs() > OFF {
        return None;
    }
    let name = &output.quantity.name;
    let text = format!(
        "`{name}`: {:.2} % of the trials lie a turn away from the others, beyond the cut of the \
         arctangent, so that mean, standard deviation and interval of the trials mean nothing; \
         write `\"periodic\": {turn}` at the output, which takes its values within half a turn of \
         the estimate",
        100.0 * away
    );
    Some(Warning::new("phase-jumps", name.as_str(), text))
}

/// Whether an output comes from an arctangent of two arguments.
fn has_cut(program: &Program, output: usize) -> bool {
    let output = Some(output).filter(|&output| output < program.nodes.len());
    let needed = program.needed_by(&[], output);
    let cut = |node: &Node| matches!(node, Node::Binary(Binary::Atan2, ..));
    program.nodes.iter().zip(needed).any(|(node, needed)| needed && cut(node))
}

/// A turn in a unit of angles; none in another.
fn turn(unit: &Unit) -> Option<f64> {
    (unit.dimension() == Dimension::NONE).then(|| unit.from_si(2.0 * PI))
}
