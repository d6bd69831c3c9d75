//! The forms that an unknown discrepancy may have: a small grammar of terms.

use super::output_sets::OutputSet;
use crate::data::Data;
use crate::{Case, HistoryKind};

/// Conditions with at most so many levels may have an effect by level.
const MOST_LEVELS: usize = 5;

/// What a discrepancy is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Nothing: a constant.
    Constant,
    /// A condition, smoothly.
    Condition(usize),
    /// A condition, with a value of its own at each level.
    Level(usize),
    /// What the model says.
    Sim,
    /// A condition together with one that follows from it in the order of the rows, smoothly.
    WithHistory(usize, usize),
    /// All conditions together but those that follow from the order of the rows, smoothly.
    Together,
}

/// One form of a discrepancy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// The observed outputs that it acts on.
    pub outputs: Vec<usize>,
    /// Whether it is a share of the model's value.
    pub relative: bool,
    /// Whether all outputs have the same function.
    pub common: bool,
    /// What it is a function of.
    pub of: Of,
}

impl Term {
    /// Whether it is a function of what follows from the order of the rows.
    pub(crate) fn is_of_history(&self, case: &Case) -> bool {
        match self.of {
            Of::Condition(c) | Of::Level(c) => case.history_of(c).is_some(),
            Of::WithHistory(..) => true,
            Of::Constant | Of::Sim | Of::Together => false,
        }
    }

    /// Whether the function has a length over which it varies.
    pub(crate) fn is_smooth(&self) -> bool {
        matches!(self.of, Of::Condition(_) | Of::Sim | Of::WithHistory(..) | Of::Together)
    }
}

/// All terms for a case in which these sets of outputs may depart, each with its weight.
pub(crate) fn terms(case: &Case, data: &Data, sets: &[OutputSet]) -> Vec<(Term, f64)> {
    let conditions: Vec<usize> =
        (0..case.described()).filter(|&condition| levels(case, data, condition) > 1).collect();
    let mut of = vec![Of::Constant];
    of.extend(conditions.iter().map(|&condition| Of::Condition(condition)));
    let few = |condition: &&usize| {
        let levels = levels(case, data, **condition);
        levels <= MOST_LEVELS && levels < data.rows()
    };
    of.extend(conditions.iter().filter(few).map(|&condition| Of::Level(condition)));
    of.extend(conditions.iter().filter_map(|&condition| {
        let history = case.history_of(condition)?;
        let shapes = [HistoryKind::Direction, HistoryKind::Extreme];
        shapes.contains(&history.kind).then_some(Of::WithHistory(history.of?, condition))
    }));
    of.push(Of::Sim);
    if conditions.iter().filter(|&&condition| condition < case.measured()).count() > 1 {
        of.push(Of::Together);
    }
    let varies = |output: usize| {
        let first = data.points[0].nominal[output];
        data.points.iter().any(|point| (point.nominal[output] - first).abs() > 1e-9 * first.abs())
    };
    let has_size = |output: usize| {
        data.points.iter().any(|point| point.nominal[output].abs() > f64::MIN_POSITIVE)
    };
    let unit = |output: usize| &case.model.outputs[data.outputs[output]].quantity.unit;
    let mut terms = Vec::new();
    for OutputSet { outputs, weight } in sets {
        for relative in [false, true] {
            if relative && !outputs.iter().all(|&output| has_size(output)) {
                continue;
            }
            for common in [true, false] {
                let alike =
                    outputs.windows(2).all(|pair| unit(pair[0]).is_compatible(unit(pair[1])));
                if common && !relative && !alike || !common && outputs.len() == 1 {
                    continue;
                }
                for &of in &of {
                    if of == Of::Sim && !outputs.iter().all(|&output| varies(output)) {
                        continue;
                    }
                    terms.push((Term { outputs: outputs.clone(), relative, common, of }, *weight));
                }
            }
        }
    }
    terms
}

/// Number of distinct values of a condition.
pub(crate) fn levels(case: &Case, data: &Data, condition: usize) -> usize {
    let mut values: Vec<u64> = data
        .ids
        .iter()
        .filter_map(|&id| case.task.rows[id].conditions.get(condition))
        .map(|value| value.to_bits())
        .collect();
    values.sort_unstable();
    values.dedup();
    values.len()
}
