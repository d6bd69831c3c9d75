//! Values without an uncertainty. A certificate may state exact ones; where others beside a value have an
//! uncertainty, it has one too, which stands somewhere else.

use roxmltree::Node;

use super::document::{self, Fault, Measured};

/// Why a value without an uncertainty is not read as an exact one; `None` for one that is, and for one
/// with an uncertainty.
pub(super) fn refused<'d>(
    node: Node<'d, 'd>,
    of: &Measured,
    place: usize,
    all: &[Node<'d, 'd>],
) -> Option<Fault> {
    if of.is_uncertain(place) {
        return None;
    }
    if of.unread.is_some() {
        return of.unread.clone();
    }
    let beside = (0..of.values.len()).any(|other| of.is_uncertain(other));
    let which = match of.values.len() {
        1 => "this value".to_owned(),
        _ => format!("value {place} (from 0) of this quantity"),
    };
    let others = if beside { "others of its list" } else { "the same quantity of other rows" };
    let is_missed = beside || rows(node, all).into_iter().any(|row| is_stated(row, of));
    is_missed.then(|| (of.span.clone(), without(&which, others)))
}

/// What is to be said of a value without an uncertainty beside others that have one.
pub(super) fn without(which: &str, others: &str) -> String {
    format!(
        "{which} has no uncertainty, while {others} have one: it would count as exact. State it in the \
         certificate, or write the value with its uncertainty in the model file"
    )
}

/// Whether values without an uncertainty are exact beyond doubt.
pub(super) fn is_nominal(node: Node<'_, '_>) -> bool {
    document::has_ref_type(node, "basic_nominalValue")
}

/// Whether a quantity in the same unit states an uncertainty.
fn is_stated(row: Node<'_, '_>, of: &Measured) -> bool {
    let read = document::measured(row);
    read.is_ok_and(|row| row.uncertainty.is_some() && row.unit.text() == of.unit.text())
}

/// The same quantity in other rows: of one reference type in one list, or in the same place of lists
/// beside that of a quantity.
fn rows<'d>(node: Node<'d, 'd>, all: &[Node<'d, 'd>]) -> Vec<Node<'d, 'd>> {
    let is_list = |of: Node<'d, 'd>| of.tag_name().name() == "list";
    let kind = |of: Node<'d, 'd>| of.attribute("refType");
    let place = |of: Node<'d, 'd>| {
        let before = of.prev_siblings().skip(1);
        before.filter(|of| of.tag_name().name() == "quantity").count()
    };
    let around =
        |of: Node<'d, 'd>| of.parent().filter(|of| is_list(*of)).and_then(|of| of.parent());
    let is_row = |other: Node<'d, 'd>| {
        let in_list = other.parent() == node.parent() && kind(node).is_some();
        let in_row = around(node).is_some()
            && around(other) == around(node)
            && other.parent() != node.parent()
            && (kind(node).is_some() || place(other) == place(node));
        other != node && kind(other) == kind(node) && (in_list || in_row)
    };
    all.iter().copied().filter(|other| is_row(*other)).collect()
}
