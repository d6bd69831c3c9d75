//! Outputs of one saved result, drawn together as they varied in its trials.
//!
//! The file holds the ranks of its outputs in a sample of its trials. A draw takes one of these
//! trials, and for each output a probability within the interval of its rank there: an empirical
//! copula, whose margins are uniform whatever the trials, so that every output keeps its quantile
//! function. The dependence of outputs within an interval, whose width is one divided by the number
//! of ranks, is lost.

use std::sync::Arc;

use crate::distribution::{Distribution, Stream};
use crate::number::{COLUMN, Column};

/// Inputs that are outputs of one result file with ranks.
#[derive(Clone, Debug)]
pub(crate) struct RankSample {
    /// Indices of the inputs, in order.
    pub members: Vec<usize>,
    /// For each member, the index of its output.
    columns: Vec<usize>,
    /// The ranks of the outputs.
    ranks: Vec<Arc<[u32]>>,
}

/// The sets of inputs that are drawn together, by their first members.
pub(super) fn rank_samples(distributions: &[Arc<Distribution>]) -> Vec<RankSample> {
    let mut found: Vec<(&str, Vec<&str>, RankSample)> = Vec::new();
    for (index, distribution) in distributions.iter().enumerate() {
        let Some(origin) = distribution.saved().map(|saved| saved.origin()) else {
            continue;
        };
        let Some(ranks) = &origin.ranks else {
            continue;
        };
        let known = found.iter().position(|(file, ..)| **file == *origin.file);
        let at = known.unwrap_or_else(|| {
            let empty = RankSample { members: Vec::new(), columns: Vec::new(), ranks: Vec::new() };
            found.push((&origin.file, Vec::new(), empty));
            found.len() - 1
        });
        if let Some((_, outputs, set)) = found.get_mut(at) {
            let output = outputs.iter().position(|output| *output == origin.output);
            let column = output.unwrap_or_else(|| {
                outputs.push(&origin.output);
                set.ranks.push(Arc::clone(ranks));
                outputs.len() - 1
            });
            set.members.push(index);
            set.columns.push(column);
        }
    }
    found.into_iter().map(|(.., set)| set).filter(|set| set.members.len() > 1).collect()
}

impl RankSample {
    /// Number of trials in the file.
    pub(crate) fn trials(&self) -> usize {
        self.ranks.first().map_or(0, |ranks| ranks.len())
    }

    /// The same inputs, indexed among those at `varying` (in order) only; all of them are there.
    pub(super) fn among(&self, varying: &[usize]) -> Self {
        let index = |member: &usize| varying.binary_search(member).unwrap_or(*member);
        Self { members: self.members.iter().map(index).collect(), ..self.clone() }
    }

    /// Draws the next column of every member; `register[q]` is its destination. A function of its
    /// own, compiled once, as tables are looked up and not computed side by side.
    #[inline(never)]
    pub(super) fn draw(
        &self,
        distributions: &[Arc<Distribution>],
        streams: &mut [Stream],
        registers: &mut [Column],
        register: &[usize],
    ) {
        let count = self.trials();
        let mut trials = Column::ZERO;
        if let Some(stream) = self.members.first().and_then(|&first| streams.get_mut(first)) {
            stream.uniform(&mut trials.0);
        }
        let trials = trials.0.map(|u| ((u * count as f64) as usize).min(count - 1));
        let mut shares: Vec<Column> = vec![Column::ZERO; self.ranks.len()];
        let mut drawn = vec![false; self.ranks.len()];
        for (&member, &column) in self.members.iter().zip(&self.columns) {
            // an output that several inputs use has one value
            if !std::mem::replace(&mut drawn[column], true) {
                streams[member].uniform(&mut shares[column].0);
            }
            let Some(saved) = distributions[member].saved() else {
                continue;
            };
            let (ranks, shares) = (&self.ranks[column], &shares[column].0);
            let out = &mut registers[register[member]].0;
            for i in 0..COLUMN {
                out[i] = saved.in_rank(ranks[trials[i]], shares[i], count as u32);
            }
        }
    }
}
