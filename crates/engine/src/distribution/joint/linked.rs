//! The dependence of a joint draw, for methods that integrate instead of drawing.

use super::{Joint, Member};

/// How quantities depend on each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dependence {
    /// Standard normal scores: the product of this packed lower triangular factor and independent
    /// ones.
    Scores(Vec<f64>),
    /// A multivariate t distribution with these degrees of freedom and this factor of its
    /// correlation matrix.
    Student(f64, Vec<f64>),
    /// Trials of a saved result, or fits of drawn points: known only by draws.
    Trials,
}

/// A set of dependent quantities.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linked {
    /// The quantities, in the order of the factor's rows.
    pub(crate) members: Vec<usize>,
    /// How.
    pub(crate) dependence: Dependence,
}

impl Joint {
    /// The sets of dependent quantities.
    pub(crate) fn linked(&self) -> Vec<Linked> {
        let groups = self.groups.iter().map(|group| Linked {
            members: group.members.iter().map(|member: &Member| member.index).collect(),
            dependence: match group.dof {
                None => Dependence::Scores(group.factor.clone()),
                Some(dof) => Dependence::Student(dof, group.factor.clone()),
            },
        });
        let sampled = self
            .rank_samples
            .iter()
            .map(|set| Linked { members: set.members.clone(), dependence: Dependence::Trials });
        let refitted = self
            .refits
            .iter()
            .map(|refit| Linked { members: refit.members.clone(), dependence: Dependence::Trials });
        groups.chain(sampled).chain(refitted).collect()
    }
}
