//! Rows of the data told apart by a second condition.

use super::{digits, residuals, words};
use gumption_gap::Diagnosis;

/// Groups have marks of their own, of which there are so many.
const MOST: usize = 5;

/// The groups of rows that figures over one condition tell apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups {
    /// What each group is, in words; none where there is nothing to tell apart.
    pub(super) labels: Vec<String>,
    condition: usize,
    /// The greatest value of each group.
    ends: Vec<f64>,
}

impl Groups {
    /// For figures over a condition, or over the number of the row.
    pub(super) fn new(diagnosis: &Diagnosis, over: residuals::Over) -> Self {
        let others = residuals::varying(diagnosis).into_iter();
        let others = others.filter(|&other| over != residuals::Over::Condition(other));
        let levels = |condition: usize| residuals::levels(diagnosis, condition);
        // the one with the fewest levels; of equals the first
        let Some(condition) = others.min_by_key(|&other| levels(other).len()) else {
            return Self::default();
        };
        let levels = levels(condition);
        let named = &diagnosis.conditions[condition];
        let count = levels.len().min(MOST);
        let bounds: Vec<usize> = (0..=count).map(|n| n * levels.len() / count).collect();
        let (mut labels, mut ends) = (Vec::new(), Vec::new());
        for pair in bounds.windows(2) {
            let (low, high) = (levels[pair[0]], levels[pair[1] - 1]);
            let name = crate::plain(&named.name);
            let text = |value: f64| digits::condition(value);
            labels.push(if low == high {
                format!("{name} = {}", words::in_unit(&text(low), named))
            } else {
                format!("{name} {} to {}", text(low), words::in_unit(&text(high), named))
            });
            ends.push(high);
        }
        Self { labels, condition, ends }
    }

    /// The sentences for all panels of a figure.
    pub(super) fn captions<'g>(
        diagnosis: &Diagnosis,
        panels: impl Iterator<Item = (residuals::Over, &'g Self)>,
    ) -> String {
        let caption = |(over, groups): (residuals::Over, &Self)| match over {
            residuals::Over::Condition(place) => {
                groups.caption(&crate::plain(&diagnosis.conditions[place].name))
            }
            residuals::Over::Row => groups.caption(&over.in_sentence(diagnosis)),
        };
        panels.map(caption).collect()
    }

    /// The group of a row with these conditions.
    pub(super) fn of(&self, conditions: &[f64]) -> usize {
        let value = conditions.get(self.condition).copied().unwrap_or(f64::NAN);
        let last = self.ends.len().saturating_sub(1);
        self.ends.partition_point(|end| *end < value).min(last)
    }

    /// What the marks over a condition mean, as a sentence of a caption.
    pub(super) fn caption(&self, over: &str) -> String {
        if self.labels.is_empty() {
            return String::new();
        }
        let names = ["circle", "square", "triangle", "diamond", "cross"];
        let parts = self.labels.iter().zip(names).map(|(label, name)| format!("{name}: {label}"));
        format!(" Marks over {over}: {}.", parts.collect::<Vec<_>>().join(", "))
    }
}
