//! Which verdicts were given for which truths.

use std::collections::{BTreeMap, BTreeSet};

use super::label::Label;
use gumption_engine::number::largest_first;
use gumption_gap::check::{BlindCheckScores, BlindDraw};

/// With more labels than this, those of several effects are taken together.
const MOST: usize = 20;

/// A kind of wrong verdict.
#[derive(Clone, Debug)]
pub(super) struct Wrong {
    pub(super) truth: Label,
    pub(super) said: Label,
    /// How often it was given.
    pub(super) count: usize,
    /// How many draws had this truth.
    pub(super) of: usize,
}

/// The wrong verdicts, the most frequent kinds first.
pub(super) fn wrong(report: &BlindCheckScores) -> Vec<Wrong> {
    let (mut of, mut counts) = (BTreeMap::new(), BTreeMap::new());
    for one in &report.checked {
        *of.entry(Label::truth(one)).or_insert(0) += 1;
        if !one.right {
            *counts.entry((Label::truth(one), Label::said(one))).or_insert(0) += 1;
        }
    }
    let kind = |((truth, said), count)| {
        let of = of.get(&truth).copied().unwrap_or(0);
        Wrong { truth, said, count, of }
    };
    let mut wrong: Vec<Wrong> = counts.into_iter().map(kind).collect();
    largest_first(&mut wrong, |kind| kind.count as f64);
    wrong
}

/// All draws by truth and verdict.
#[derive(Clone, Debug)]
pub(super) struct Confused {
    /// What was true or said, in order.
    pub(super) labels: Vec<Label>,
    /// For each truth, the number of draws for each verdict.
    pub(super) counts: Vec<Vec<usize>>,
    /// Whether labels of several effects were taken together.
    pub(super) together: bool,
    /// Where they were: draws of several effects with a verdict of several, and how many of those
    /// verdicts named the right ones.
    pub(super) several: [usize; 2],
    /// Draws of a withheld effect whose verdict is another name, and predicts within the
    /// uncertainties.
    pub(super) as_good: usize,
}

impl Confused {
    pub(super) fn new(report: &BlindCheckScores) -> Self {
        let pair = |one: &BlindDraw| [Label::truth(one), Label::said(one)];
        let pairs: Vec<[Label; 2]> = report.checked.iter().map(pair).collect();
        let all: BTreeSet<&Label> = pairs.iter().flatten().collect();
        let together = all.len() > MOST;
        let several = pairs.iter().filter(|pair| {
            let is_several = |label: &Label| matches!(label, Label::Several(_));
            pair.iter().all(is_several)
        });
        let several: Vec<&[Label; 2]> = several.collect();
        let same = several.iter().filter(|[truth, said]| truth == said).count();
        let as_good = report.checked.iter().zip(&pairs);
        let as_good = as_good.filter(|(one, [truth, said])| one.right && truth != said).count();
        let several = [several.len(), same];
        let pairs: Vec<[Label; 2]> = if together {
            pairs.into_iter().map(|pair| pair.map(Label::together)).collect()
        } else {
            pairs
        };
        let labels: BTreeSet<Label> = pairs.iter().flatten().cloned().collect();
        let labels: Vec<Label> = labels.into_iter().collect();
        let mut counts = vec![vec![0; labels.len()]; labels.len()];
        for pair in &pairs {
            if let [Ok(truth), Ok(said)] = pair.each_ref().map(|label| labels.binary_search(label))
            {
                counts[truth][said] += 1;
            }
        }
        Self { labels, counts, together, several, as_good }
    }
}
