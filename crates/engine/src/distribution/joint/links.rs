//! Which quantities coefficients link.

use std::collections::BTreeMap;

use super::Correlation;

/// The sets of quantities that coefficients link, each in order.
pub(crate) fn connected(correlations: &[Correlation]) -> Vec<Vec<usize>> {
    let last = correlations.iter().map(|c| c.first.max(c.second)).max();
    // each quantity points to an earlier one of its set, the first of a set to itself
    let mut earlier: Vec<usize> = (0..last.map_or(0, |last| last + 1)).collect();
    for c in correlations {
        let (a, b) = (first(&mut earlier, c.first), first(&mut earlier, c.second));
        let (low, high) = (a.min(b), a.max(b));
        if let Some(pointer) = earlier.get_mut(high) {
            *pointer = low;
        }
    }
    let mut sets: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for index in 0..earlier.len() {
        sets.entry(first(&mut earlier, index)).or_default().push(index);
    }
    sets.into_values().filter(|set| set.len() > 1).collect()
}

/// The first quantity of a set; visited paths are shortened.
fn first(earlier: &mut [usize], index: usize) -> usize {
    let mut at = index;
    while let Some(&next) = earlier.get(at).filter(|&&next| next != at) {
        earlier[at] = earlier.get(next).copied().unwrap_or(next);
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_joined_by_later_coefficients() {
        let sets = |pairs: &[(usize, usize)]| {
            let declared = |&(first, second)| Correlation { first, second, coefficient: 0.5 };
            connected(&pairs.iter().map(declared).collect::<Vec<_>>())
        };
        assert_eq!(sets(&[(0, 3), (5, 4)]), [vec![0, 3], vec![4, 5]]);
        assert_eq!(sets(&[(0, 3), (5, 4), (3, 4)]), [vec![0, 3, 4, 5]]);
        assert_eq!(sets(&[(6, 5), (5, 4), (4, 3), (9, 8), (3, 9)]), [vec![3, 4, 5, 6, 8, 9]]);
        assert!(sets(&[]).is_empty());
    }
}
