//! Coverage intervals that stand in a quantity of their own: the values again, of all results or of
//! some, with their standard uncertainties (`si:coverageInterval`). D-SI has no place for them beside an
//! expanded uncertainty. They are no further values, and their standard uncertainties have digits that
//! are lost in U and k, which are rounded.

use std::collections::{HashMap, HashSet};

use gumption_units::Unit;
use roxmltree::{Node, NodeId};

use super::document::{self, Measured};

/// Whether a quantity states coverage intervals.
pub(super) fn is_interval(node: Node<'_, '_>) -> bool {
    node.descendants()
        .any(|descendant| descendant.tag_name().name().starts_with("coverageInterval"))
}

/// The quantities without those that repeat values of another of them with coverage intervals; the
/// others know the standard uncertainties of intervals in their list.
pub(super) fn left_out<'d>(
    chosen: Vec<Node<'d, 'd>>,
    measured: Vec<Measured>,
    all: &[Node<'d, 'd>],
) -> (Vec<Node<'d, 'd>>, Vec<Measured>) {
    let list = |node: Node<'d, 'd>| node.parent().map(|parent| parent.id());
    // by their lists, as there may be very many
    let mut intervals: HashMap<Option<NodeId>, Vec<Node<'d, 'd>>> = HashMap::new();
    for interval in all.iter().filter(|node| is_interval(**node)) {
        intervals.entry(list(*interval)).or_default().push(*interval);
    }
    if intervals.is_empty() {
        return (chosen, measured);
    }
    let all: HashSet<NodeId> = intervals.values().flatten().map(|node| node.id()).collect();
    let mut others: HashMap<Option<NodeId>, Vec<&Measured>> = HashMap::new();
    for (node, measured) in
        chosen.iter().zip(&measured).filter(|(node, _)| !all.contains(&node.id()))
    {
        others.entry(list(*node)).or_default().push(measured);
    }
    let repeats = |(node, measured): (&Node<'d, 'd>, &Measured)| {
        let beside = others.get(&list(*node)).filter(|_| all.contains(&node.id()));
        beside.is_some_and(|beside| beside.iter().any(|values| places(measured, values).is_some()))
    };
    let kept: Vec<bool> = chosen.iter().zip(&measured).map(|pair| !repeats(pair)).collect();
    let pairs = chosen.into_iter().zip(measured).zip(kept);
    pairs
        .filter(|(_, kept)| *kept)
        .map(|((node, mut measured), _)| {
            if !all.contains(&node.id()) {
                beside(&mut measured, intervals.get(&list(node)).map_or(&[], Vec::as_slice));
            }
            (node, measured)
        })
        .unzip()
}

/// Takes the standard uncertainties of the intervals in the list of a quantity.
fn beside(of: &mut Measured, intervals: &[Node<'_, '_>]) {
    for interval in intervals {
        // a damaged one matters where it is wanted
        let Ok(interval) = document::measured(*interval) else { continue };
        let Some(places) = places(&interval, of) else { continue };
        let standard = interval.uncertainty.map(|stated| stated.standard);
        let Some(stated) = of.uncertainty.as_mut() else { continue };
        stated.of_interval.resize(of.values.len(), None);
        for (place, u) in places.into_iter().zip(standard.unwrap_or_default()) {
            if let Some(slot) = place.and_then(|place| stated.of_interval.get_mut(place))
                && u.is_some()
            {
                *slot = u;
            }
        }
    }
}

/// For each value of the intervals its place among those of a quantity, in the same order; `None` where
/// two places are possible. `None` for all if they are not values of it.
fn places(interval: &Measured, of: &Measured) -> Option<Vec<Option<usize>>> {
    if !same(&interval.unit, &of.unit) {
        return None;
    }
    let distribution = |measured: &Measured, place: usize| -> Option<String> {
        measured.uncertainty.as_ref()?.called(place).map(str::to_owned)
    };
    let is_it = |own: usize, place: usize| {
        let (a, b) = (distribution(interval, own), distribution(of, place));
        interval.values.get(own) == of.values.get(place) && (a.is_none() || b.is_none() || a == b)
    };
    // the first possible places, and the last ones
    let mut next = 0..of.values.len();
    let first = (0..interval.values.len()).map(|own| next.find(|place| is_it(own, *place)));
    let first: Vec<usize> = first.collect::<Option<_>>()?;
    let mut next = (0..of.values.len()).rev();
    let last = (0..interval.values.len()).rev().map(|own| next.find(|place| is_it(own, *place)));
    let last: Vec<usize> = last.collect::<Option<_>>()?;
    let both = first.into_iter().zip(last.into_iter().rev());
    Some(both.map(|(first, last)| (first == last).then_some(first)).collect())
}

fn same(a: &Unit, b: &Unit) -> bool {
    a.text() == b.text()
}

/// The standard uncertainty of an interval, where U over k is the same but for the rounding of both to
/// their last written digit: of U to the nearest or up, of k to the nearest.
pub(super) fn agreeing(
    u: f64,
    expanded: f64,
    factor: f64,
    [of_expanded, of_factor]: [f64; 2],
) -> Result<f64, String> {
    if (expanded - factor * u).abs() <= 1.001 * (of_expanded + 0.5 * u * of_factor) {
        return Ok(u);
    }
    Err(format!(
        "states two standard uncertainties for one value: {u} as such, and U/k = \
         {expanded}/{factor}; ask which is right, and state the value as a normal distribution"
    ))
}
