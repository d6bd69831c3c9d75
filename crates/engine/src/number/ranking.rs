//! Sorting by a number of each element: one compiled sort for all types, including indices and
//! counts, which are exact as numbers.

/// Sorts from the smallest number to the largest; equal ones keep their order. Numbers compare as
/// [`f64::total_cmp`] does.
///
/// ```
/// let mut words = ["ten", "two", "five"];
/// gumption_engine::number::smallest_first(&mut words, |word| word.len() as f64);
/// assert_eq!(words, ["ten", "two", "five"]);
/// ```
pub fn smallest_first<T>(items: &mut [T], number: impl FnMut(&T) -> f64) {
    let from = order(items.iter().map(number).collect());
    arrange(items, from);
}

/// Sorts from the largest number to the smallest; equal ones keep their order. Numbers compare as
/// [`f64::total_cmp`] does.
///
/// ```
/// let mut shares = [("tilt", 0.3), ("level", 0.6), ("drift", 0.3)];
/// gumption_engine::number::largest_first(&mut shares, |share| share.1);
/// assert_eq!(shares.map(|share| share.0), ["level", "tilt", "drift"]);
/// ```
pub fn largest_first<T>(items: &mut [T], mut number: impl FnMut(&T) -> f64) {
    // the total order of negated numbers is the reverse one
    let from = order(items.iter().map(|item| -number(item)).collect());
    arrange(items, from);
}

/// The indices of the numbers from the smallest to the largest.
fn order(numbers: Vec<f64>) -> Vec<usize> {
    let mut places: Vec<usize> = (0..numbers.len()).collect();
    places.sort_unstable_by(|&a, &b| numbers[a].total_cmp(&numbers[b]).then(a.cmp(&b)));
    places
}

/// Moves to each position the element at its entry of `from`, cycle by cycle.
fn arrange<T>(items: &mut [T], mut from: Vec<usize>) {
    for start in 0..items.len() {
        let mut at = start;
        while from[at] != start {
            let next = from[at];
            items.swap(at, next);
            from[at] = at;
            at = next;
        }
        from[at] = at;
    }
}

/// Sorts numbers from the smallest to the largest, as [`f64::total_cmp`] does. A single function,
/// so that crates that sort numbers do not each compile a copy.
///
/// ```
/// let mut values = [2.0, -1.0, 0.5];
/// gumption_engine::number::ascending(&mut values);
/// assert_eq!(values, [-1.0, 0.5, 2.0]);
/// ```
#[inline(never)]
pub fn ascending(values: &mut [f64]) {
    values.sort_unstable_by(f64::total_cmp);
}

/// Moves the number with this rank (from 0) to its sorted position; smaller ones are before it,
/// larger ones after it.
///
/// ```
/// let mut values = [2.0, -1.0, 0.5];
/// assert_eq!(gumption_engine::number::at_rank(&mut values, 1), 0.5);
/// assert_eq!(values, [-1.0, 0.5, 2.0]);
/// ```
///
/// # Panics
/// There is no such place.
#[inline(never)]
pub fn at_rank(values: &mut [f64], place: usize) -> f64 {
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// The median element; for an even number of elements the larger of the two in the middle; `None`
/// without numbers.
///
/// ```
/// use gumption_engine::number::median;
///
/// assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
/// assert_eq!(median(vec![3.0, 1.0, 2.0, 4.0]), Some(3.0));
/// ```
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    ascending(&mut values);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same as the standard library's stable sort, for numbers with many ties, infinities and
    /// zeros of both signs.
    #[test]
    fn the_order_is_that_of_a_stable_sort() {
        let special = [f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, f64::NAN, -f64::NAN];
        for count in 0..200_usize {
            let number = |i: usize| match (i * 7919 + count * 31) % 17 {
                kind if kind < special.len() => special[kind],
                kind => kind as f64,
            };
            let items: Vec<(usize, f64)> = (0..count).map(|i| (i, number(i))).collect();
            let places = |items: &[(usize, f64)]| items.iter().map(|item| item.0).collect();
            let (mut up, mut down) = (items.clone(), items.clone());
            smallest_first(&mut up, |item| item.1);
            largest_first(&mut down, |item| item.1);
            let (mut by, mut back) = (items.clone(), items);
            by.sort_by(|a, b| a.1.total_cmp(&b.1));
            back.sort_by(|a, b| b.1.total_cmp(&a.1));
            let expected: [Vec<usize>; 2] = [places(&by), places(&back)];
            assert_eq!([places(&up), places(&down)], expected, "{count}");
        }
    }

    /// One long cycle, as for a sorted table with a late row.
    #[test]
    fn the_last_of_a_million_goes_first() {
        let mut items: Vec<f64> = (1..1_000_000).map(f64::from).chain([0.0]).collect();
        smallest_first(&mut items, |item| *item);
        assert!(items.iter().zip(0..).all(|(item, place)| *item == f64::from(place)));
    }
}
