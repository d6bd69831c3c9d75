//! The running draw of the quantities of a row.

use std::sync::Arc;

use super::rank_sample::RankSample;
use super::{Joint, JointGroup, paired};
use crate::distribution::{Distribution, Stream, StreamKey, normal};
use crate::linalg::packed;
use crate::number::{CodePath, Column, Kernel};
use crate::regression::Refit;

/// The quantities of a row with an uncertainty, and the joint draw of the dependent ones.
#[derive(Debug)]
pub struct Varying {
    distributions: Vec<Arc<Distribution>>,
    joint: Arc<Joint>,
    /// The members of the joint draw's groups with their distributions in this row.
    members: Vec<Vec<Member>>,
    /// Outputs of saved results.
    rank_samples: Vec<RankSample>,
    /// Parameters of fits.
    refits: Vec<Refit>,
    in_group: Vec<bool>,
}

/// A quantity of a group: its index among those with an uncertainty, and the conversion of drawn
/// values.
#[derive(Clone, Copy, Debug)]
struct Member {
    index: usize,
    location: f64,
    scale: f64,
}

impl Varying {
    /// The quantities at `varying` (in order) of a row; all members of groups are among them.
    pub fn new(row: &[Arc<Distribution>], varying: &[usize], joint: &Arc<Joint>) -> Self {
        let distributions: Vec<Arc<Distribution>> =
            varying.iter().filter_map(|&v| row.get(v).cloned()).collect();
        let mut in_group = vec![false; distributions.len()];
        let members = joint.groups.iter().map(|group| {
            let members = group.members.iter().filter_map(|member| {
                let index = varying.binary_search(&member.index).ok()?;
                let [location, scale] = member.placed(distributions.get(index)?);
                *in_group.get_mut(index)? = true;
                Some(Member { index, location, scale })
            });
            members.collect()
        });
        let members = members.collect();
        let rank_samples: Vec<RankSample> =
            joint.rank_samples.iter().map(|set| set.among(varying)).collect();
        let refits: Vec<Refit> = joint.refits.iter().map(|set| set.among(varying)).collect();
        let refitted = refits.iter().flat_map(|set| &set.members);
        for &index in rank_samples.iter().flat_map(|set| &set.members).chain(refitted) {
            if let Some(is) = in_group.get_mut(index) {
                *is = true;
            }
        }
        let joint = Arc::clone(joint);
        Self { distributions, joint, members, rank_samples, refits, in_group }
    }

    /// All of these quantities.
    #[cfg(test)]
    pub(crate) fn all(distributions: &[Distribution], joint: &Arc<Joint>) -> Self {
        let shared: Vec<Arc<Distribution>> = distributions.iter().cloned().map(Arc::new).collect();
        let varying: Vec<usize> = (0..shared.len()).collect();
        Self::new(&shared, &varying, joint)
    }

    /// Their number.
    pub(crate) fn len(&self) -> usize {
        self.distributions.len()
    }

    /// Their distributions.
    pub fn distributions(&self) -> &[Arc<Distribution>] {
        &self.distributions
    }

    /// For each quantity whether [`Draws::scores_on`] gives values instead of scores: paired
    /// readings, and outputs of a saved result that are drawn together.
    pub fn without_scores(&self) -> Vec<bool> {
        let mut without = vec![false; self.len()];
        let groups = self.joint.groups.iter().zip(&self.members);
        let paired = groups.filter(|(group, _)| group.dof.is_some());
        let paired = paired.flat_map(|(_, members)| members.iter().map(|m| m.index));
        let sampled = self.rank_samples.iter().flat_map(|set| set.members.iter().copied());
        let refitted = self.refits.iter().flat_map(|set| set.members.iter().copied());
        for index in paired.chain(sampled).chain(refitted) {
            without[index] = true;
        }
        without
    }

    /// The sets of quantities that are drawn together.
    pub fn linked(&self) -> Vec<Vec<usize>> {
        let groups = self.members.iter().map(|set| set.iter().map(|m| m.index).collect());
        let sampled = self.rank_samples.iter().map(|set| set.members.clone());
        let refitted = self.refits.iter().map(|set| set.members.clone());
        groups.chain(sampled).chain(refitted).collect()
    }
}

struct ScoresKernel<'k, 'a> {
    draws: &'k mut Draws<'a>,
    independent: Independent,
    registers: &'k mut [Column],
    register: &'k [usize],
}

impl Kernel for ScoresKernel<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.draws.scores(self.independent, self.registers, self.register);
    }
}

/// Where the independent standard normal numbers of quantities come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Independent {
    /// They are drawn.
    Drawn,
    /// They are there already.
    Given,
}

/// The running draw of a set of quantities through one block.
#[derive(Debug)]
pub struct Draws<'a> {
    varying: &'a Varying,
    streams: Vec<Stream>,
}

impl<'a> Draws<'a> {
    /// The draws of block `block` on a code path; `keys` are the streams of the quantities.
    pub fn new(varying: &'a Varying, keys: &[StreamKey], path: CodePath, block: u64) -> Self {
        Self { varying, streams: keys.iter().map(|key| key.block_on(path, block)).collect() }
    }

    /// Draws the next column of every quantity that is `used`; `register[q]` is its destination.
    #[inline(always)]
    pub(crate) fn column(&mut self, registers: &mut [Column], register: &[usize], used: &[bool]) {
        let varying = self.varying;
        for (q, distribution) in varying.distributions.iter().enumerate() {
            if used[q] && !varying.in_group[q] {
                distribution.draw(&mut self.streams[q], &mut registers[register[q]]);
            }
        }
        for (group, members) in varying.joint.groups.iter().zip(&varying.members) {
            if members.iter().any(|m| used[m.index]) {
                self.independent(group, members, registers, register);
                mix(group, members, false, registers, register);
            }
        }
        for set in &varying.rank_samples {
            if set.members.iter().any(|&m| used[m]) {
                set.draw(&varying.distributions, &mut self.streams, registers, register);
            }
        }
        for set in &varying.refits {
            if set.members.iter().any(|&m| used[m]) {
                set.draw(&mut self.streams, registers, register);
            }
        }
    }

    /// Draws the next column of standard normal scores of every quantity, with the dependence of
    /// the quantities; values for those of [`Varying::without_scores`]. `register[q]` is the
    /// destination for quantity `q`.
    #[inline(never)]
    pub fn scores_on(&mut self, path: CodePath, registers: &mut [Column], register: &[usize]) {
        let independent = Independent::Drawn;
        path.run(ScoresKernel { draws: self, independent, registers, register });
    }

    /// The same from independent standard normal numbers, which the destinations of the quantities
    /// with scores hold; values of the others are drawn.
    #[inline(never)]
    pub fn scores_from_on(&mut self, path: CodePath, registers: &mut [Column], register: &[usize]) {
        let independent = Independent::Given;
        path.run(ScoresKernel { draws: self, independent, registers, register });
    }

    #[inline(always)]
    fn scores(&mut self, independent: Independent, registers: &mut [Column], register: &[usize]) {
        let varying = self.varying;
        for q in 0..varying.len() {
            if independent == Independent::Drawn && !varying.in_group[q] {
                normal::draw(0.0, 1.0, &mut self.streams[q], &mut registers[register[q]]);
            }
        }
        for (group, members) in varying.joint.groups.iter().zip(&varying.members) {
            if independent == Independent::Drawn || group.dof.is_some() {
                self.independent(group, members, registers, register);
            }
            mix(group, members, group.dof.is_none(), registers, register);
        }
        for set in &varying.rank_samples {
            set.draw(&varying.distributions, &mut self.streams, registers, register);
        }
        for set in &varying.refits {
            set.draw(&mut self.streams, registers, register);
        }
    }

    /// Independent standard normal quantities of a group, or a spherical t distribution.
    #[inline(always)]
    fn independent(
        &mut self,
        group: &JointGroup,
        members: &[Member],
        registers: &mut [Column],
        register: &[usize],
    ) {
        if let Some(dof) = group.dof {
            let indices = members.iter().map(|m| m.index);
            paired::draw_spherical(dof, indices, &mut self.streams, registers, register);
        } else {
            for m in group.independent.iter().filter_map(|&of| members.get(of)) {
                let out = &mut registers[register[m.index]];
                normal::draw(0.0, 1.0, &mut self.streams[m.index], out);
            }
        }
    }
}

/// Mixes the independent quantities of a group by its factor, from the last row upwards, so that
/// every row finds the columns above it unmixed. With `scores` the mixed normal ones are not
/// converted.
#[inline(always)]
fn mix(
    group: &JointGroup,
    members: &[Member],
    scores: bool,
    registers: &mut [Column],
    register: &[usize],
) {
    let shapes = group.members.iter().zip(packed::rows(&group.factor));
    for (of_row, (member, (shape, row))) in members.iter().zip(shapes).enumerate().rev() {
        let mut sum = Column::ZERO;
        for &of in group.independent.iter().take_while(|of| **of <= of_row) {
            let (weight, z) = (row[of], &registers[register[members[of].index]].0);
            for (sum, z) in sum.0.iter_mut().zip(z) {
                *sum += weight * z;
            }
        }
        let out = &mut registers[register[member.index]].0;
        if scores {
            *out = sum.0;
            continue;
        }
        if let Some(table) = shape.table() {
            let z = sum.clone();
            table.values(&z.0, &mut sum.0);
        }
        for (out, sum) in out.iter_mut().zip(&sum.0) {
            *out = member.location + member.scale * sum;
        }
    }
}
