//! The middle of some values, which a few outlying ones do not move.

/// The median, of an even number of values the upper of the two in the middle; `None` without any.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
