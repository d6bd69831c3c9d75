//! A phase whose trials lie on both sides of the cut of the arctangent, where nothing says that it
//! comes round.

use std::f64::consts::PI;

use super::gum::Gum;
use super::monte_carlo::MonteCarlo;
use crate::decimal::significant;
use crate::fact;
use crate::fact::Argument;
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

/// How far their fourth moment may be: lumps that are cut are no whole distributions.
const FOURTH_OFF: f64 = 0.2;

/// Trials in two lumps, of which one lies beyond a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jump {
    /// The share of the trials that are not where the estimate is.
    away: f64,
    /// How far these are from the others, in the output's unit.
    size: f64,
    /// Whether that is a turn of an output that is an angle.
    is_turn: bool,
}

/// The jump of output `number` of a model, if its trials jump.
pub(super) fn jump(
    program: &Program,
    number: usize,
    output: &Output,
    gum: &Gum,
    trials: &MonteCarlo,
) -> Option<Jump> {
    if output.period.is_some() || !has_cut(program, *program.outputs.get(number)?) {
        return None;
    }
    let (spread, u) = (trials.standard_uncertainty?, gum.standard_uncertainty);
    let moved = trials.estimate? - gum.estimate;
    let count = trials.trials as f64;
    let is_seen = |away: f64, size: f64| {
        // a share p of the trials is away: their mean by p sizes, their variance larger by
        // p (1 - p) sizes squared; less than twice the standard uncertainty of the law of propagation is
        // not a jump
        let expected = (u * u + size * size * away * (1.0 - away)).sqrt();
        let is_one = away * count > LEAST && (LEAST_SHARE..1.0).contains(&away);
        is_one && expected >= 2.0 * u && (spread / expected - 1.0).abs() <= OFF
    };
    if let Some(turn) = turn(&output.quantity.unit) {
        let away = moved.abs() / turn;
        if is_seen(away, turn) {
            return Some(Jump { away, size: turn, is_turn: true });
        }
    }
    // of two lumps of any distance the mean and the variance tell it, and the fourth moment whether they
    // are two
    let more = spread * spread - u * u;
    let size = (more + moved * moved) / moved;
    let away = moved / size;
    let other = 1.0 - away;
    let fourth = away * other * (1.0 - 3.0 * away * other) * size.powi(4)
        + 6.0 * away * other * size * size * u * u
        + 3.0 * u.powi(4);
    let found = (trials.excess_kurtosis? + 3.0) * spread.powi(4);
    let is_two = (found / fourth - 1.0).abs() <= FOURTH_OFF;
    // lumps that are cut have their means nearer to each other than what is the same lies apart
    let [low, high] = trials.symmetric_interval;
    let apart = size.abs().max(high - low);
    (is_two && is_seen(away, size)).then_some(Jump { away, size: apart, is_turn: false })
}

impl Jump {
    /// The note about it.
    pub(super) fn note(&self, output: &Output) -> Warning {
        let Self { away, size, is_turn } = *self;
        let name = &output.quantity.name;
        let percent = 100.0 * away;
        let percent = Argument::Number(format!("{percent:.2} %"));
        let fact = match is_turn {
            true => fact!("phase-jumps", name, percent, turn = size),
            false => {
                let size = output.quantity.unit.after(&significant(size, 2));
                fact!("phase-jumps.apart", name, percent, size = Argument::Number(size))
            }
        };
        Warning::new(name, fact)
    }
}

/// Whether an output comes from an arctangent of two arguments, or from what is left of whole
/// multiples.
fn has_cut(program: &Program, output: usize) -> bool {
    let output = Some(output).filter(|&output| output < program.nodes.len());
    let needed = program.needed_by(&[], output);
    let cut = |node: &Node| matches!(node, Node::Binary(Binary::Atan2 | Binary::Modulo, ..));
    program.nodes.iter().zip(needed).any(|(node, needed)| needed && cut(node))
}

/// A turn in a unit of angles; none in another.
fn turn(unit: &Unit) -> Option<f64> {
    (unit.dimension() == Dimension::NONE).then(|| unit.from_si(2.0 * PI))
}
