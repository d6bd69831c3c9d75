//! Shares of the combined variance, added up by group and by type of evaluation.

use gumption_engine::distribution::EvaluationType;
use gumption_engine::number::smallest_first;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::task::Task;

/// Shares that are added up over the lines of the inputs; those of correlation coefficients belong
/// to no single input and are left out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subtotals<'a> {
    /// Groups in order of first appearance, then the inputs without one.
    pub(super) groups: Vec<(Option<&'a str>, f64)>,
    /// Type A and type B.
    pub(super) types: [(EvaluationType, f64); 2],
}

impl<'a> Subtotals<'a> {
    pub(crate) fn of(task: &'a Task, gum: &Gum) -> Self {
        let mut groups: Vec<(Option<&str>, f64)> = Vec::new();
        let mut types = [(EvaluationType::A, 0.0), (EvaluationType::B, 0.0)];
        for line in gum.budget() {
            let Some(variable) = task.variables.get(line.variable) else { continue };
            let group = variable.group.as_deref();
            match groups.iter_mut().find(|(name, _)| *name == group) {
                Some((_, share)) => *share += line.share,
                None => groups.push((group, line.share)),
            }
            for (_, share) in types.iter_mut().filter(|(kind, _)| *kind == variable.evaluation) {
                *share += line.share;
            }
        }
        smallest_first(&mut groups, |(name, _)| f64::from(name.is_none()));
        Self { groups, types }
    }
}
