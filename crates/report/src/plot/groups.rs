//! Points told apart by a second condition.

/// Groups have marks of their own, of which there are so many.
const MOST: usize = 5;

/// What the marks look like, in words.
const MARKS: [&str; MOST] = ["circle", "square", "triangle", "diamond", "cross"];

/// The groups that figures over one condition tell apart by another one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    /// What each group is, in words; none where there is nothing to tell apart.
    labels: Vec<String>,
    condition: usize,
    /// The greatest value of each group.
    ends: Vec<f64>,
}

impl Groups {
    /// Groups of neighbouring levels of a condition; `label` says what a group from one level to
    /// another is. `levels` are in order and not empty.
    pub(crate) fn of_levels(
        condition: usize,
        levels: &[f64],
        label: impl Fn(f64, f64) -> String,
    ) -> Self {
        let count = levels.len().min(MOST);
        let bounds: Vec<usize> = (0..=count).map(|n| n * levels.len() / count.max(1)).collect();
        let ends = bounds.windows(2).map(|pair| [levels[pair[0]], levels[pair[1] - 1]]);
        let (labels, ends) = ends.map(|[low, high]| (label(low, high), high)).unzip();
        Self { labels, condition, ends }
    }

    /// The group of a row with these conditions.
    pub(crate) fn of(&self, conditions: &[f64]) -> usize {
        let value = conditions.get(self.condition).copied().unwrap_or(f64::NAN);
        let last = self.ends.len().saturating_sub(1);
        self.ends.partition_point(|end| *end < value).min(last)
    }

    /// What the marks over a condition mean, as a sentence of a caption; empty where there is nothing
    /// to tell apart.
    pub(crate) fn caption(&self, over: &str) -> String {
        if self.labels.is_empty() {
            return String::new();
        }
        let parts = self.labels.iter().zip(MARKS).map(|(label, mark)| format!("{mark}: {label}"));
        format!(" Marks over {over}: {}.", parts.collect::<Vec<_>>().join(", "))
    }
}
