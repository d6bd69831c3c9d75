//! Points that are distinguished by a second condition.

/// The number of different marks for groups.
const MOST: usize = 5;

/// The marks in words.
const MARKS: [&str; MOST] = ["circle", "square", "triangle", "diamond", "cross"];

/// The groups that plots over one condition distinguish by another one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    /// The label of each group; empty if there is only one.
    labels: Vec<String>,
    condition: usize,
    /// The largest value of each group.
    ends: Vec<f64>,
}

impl Groups {
    /// Groups of neighbouring levels of a condition; `label` describes a group from one level to
    /// another. `levels` are in order and not empty.
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

    /// The meaning of the marks over a condition, as a sentence of a caption; empty if there is
    /// only one group.
    pub(crate) fn caption(&self, over: &str) -> String {
        if self.labels.is_empty() {
            return String::new();
        }
        let parts = self.labels.iter().zip(MARKS).map(|(label, mark)| format!("{mark}: {label}"));
        format!(" Marks over {over}: {}.", parts.collect::<Vec<_>>().join(", "))
    }
}
