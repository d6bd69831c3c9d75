//! Which conditions name a row of a sweep.

use std::collections::BTreeSet;

use super::figures::RowEvaluation;

/// The conditions that name rows, by their places: the first of those that vary that together tell
/// all rows apart, or all that vary where rows are alike. What was measured in every row may stand
/// among the conditions as well; it names nothing.
pub fn naming(rows: &[RowEvaluation]) -> Vec<usize> {
    let conditions: Vec<&[f64]> = rows.iter().map(|row| row.conditions.as_slice()).collect();
    of_conditions(&conditions)
}

fn of_conditions(rows: &[&[f64]]) -> Vec<usize> {
    let count = rows.first().map_or(0, |row| row.len());
    let bits = |row: &[f64], place: usize| row.get(place).map(|value| value.to_bits());
    let varying: Vec<usize> = (0..count)
        .filter(|&place| {
            let first = rows.first().and_then(|row| bits(row, place));
            rows.iter().any(|row| bits(row, place) != first)
        })
        .collect();
    let tells_apart = |count: usize| {
        let mut seen = BTreeSet::new();
        rows.iter().all(|row| {
            let name = varying.iter().take(count).map(|&place| bits(row, place));
            seen.insert(name.collect::<Vec<_>>())
        })
    };
    let count = (1..varying.len()).find(|&count| tells_apart(count)).unwrap_or(varying.len());
    varying.into_iter().take(count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_conditions_that_tell_rows_apart() {
        let of = of_conditions;
        assert_eq!(of(&[&[1.0, 5.0, 0.3], &[1.0, 6.0, 0.4]]), [1]);
        assert_eq!(of(&[&[1.0, 5.0, 0.3], &[1.0, 6.0, 0.4], &[2.0, 5.0, 0.4]]), [0, 1]);
        assert_eq!(of(&[&[1.0, 5.0], &[1.0, 5.0], &[1.0, 6.0]]), [1]);
        assert_eq!(of(&[&[1.0]]), [0; 0]);
    }
}
