//! Values without an uncertainty. A certificate may state exact ones; where others beside a value have an
//! uncertainty, it has one too, which stands somewhere else.

use std::collections::{HashMap, HashSet};

use roxmltree::{Node, NodeId};

use super::document::{self, Fault, Measured};

/// The quantities that are one in several rows: those of one reference type in one place, a list or the
/// lists in it, or those at the same place of lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct QuantityRow<'d> {
    around: NodeId,
    kind: Option<&'d str>,
    place: usize,
}

impl<'d> QuantityRow<'d> {
    /// That of a quantity, before which so many others stand in its element; `None` if it is no row of
    /// anything.
    fn of(node: Node<'d, 'd>, before: usize) -> Option<Self> {
        let parent = node.parent()?;
        let is_list = parent.tag_name().name() == "list";
        let around = if is_list { parent.parent()? } else { parent };
        let kind = node.attribute("refType");
        let place = match kind {
            Some(_) => 0,
            None if is_list => before,
            None => return None,
        };
        Some(Self { around: around.id(), kind, place })
    }
}

/// Which quantities of a certificate state uncertainties.
pub(super) struct QuantityRows<'a, 'd> {
    all: &'a [Node<'d, 'd>],
    /// Of nothing before it is asked for.
    stated: Option<StatedRows<'d>>,
}

/// What is known of the rows of a certificate.
#[derive(Default)]
struct StatedRows<'d> {
    /// The row of each quantity that is of one.
    rows: HashMap<NodeId, QuantityRow<'d>>,
    /// The units of those that state uncertainties, by row.
    units: HashMap<QuantityRow<'d>, HashSet<String>>,
}

impl<'a, 'd> QuantityRows<'a, 'd> {
    pub(super) fn new(all: &'a [Node<'d, 'd>]) -> Self {
        Self { all, stated: None }
    }

    /// Why values of a quantity without an uncertainty are not read as exact ones; `None` if they are, or
    /// there are none.
    pub(super) fn lacking(&mut self, node: Node<'d, 'd>, of: &Measured) -> Option<Lacking> {
        let mut places = 0..of.values.len();
        if places.clone().all(|place| of.is_uncertain(place)) {
            return None;
        }
        if let Some(fault) = &of.unread {
            return Some(Lacking::Unread(fault.clone()));
        }
        if places.any(|place| of.is_uncertain(place)) {
            return Some(Lacking::Beside("others of its list"));
        }
        let all = self.all;
        let stated = self.stated.get_or_insert_with(|| stated(all));
        let units = stated.units.get(stated.rows.get(&node.id())?)?;
        let is_missed = units.contains(of.unit.text());
        is_missed.then_some(Lacking::Beside("those of other rows"))
    }
}

fn stated<'d>(all: &[Node<'d, 'd>]) -> StatedRows<'d> {
    let mut found = StatedRows::default();
    let mut before: HashMap<Option<NodeId>, usize> = HashMap::new();
    for node in all {
        let before = before.entry(node.parent().map(|parent| parent.id())).or_default();
        let row = QuantityRow::of(*node, *before);
        *before += 1;
        let Some(row) = row else { continue };
        found.rows.insert(node.id(), row);
        if let Ok(of) = document::measured(*node)
            && of.uncertainty.is_some()
        {
            found.units.entry(row).or_default().insert(of.unit.text().to_owned());
        }
    }
    found
}

/// Why a value without an uncertainty is not read as an exact one.
#[derive(Clone, Debug)]
pub(super) enum Lacking {
    /// Something is stated, in a way that is not read.
    Unread(Fault),
    /// Others have one.
    Beside(&'static str),
}

impl Lacking {
    /// The fault of a value; `None` if it has an uncertainty.
    pub(super) fn fault(&self, of: &Measured, place: usize) -> Option<Fault> {
        if of.is_uncertain(place) {
            return None;
        }
        let which = match of.values.len() {
            1 => "this value".to_owned(),
            _ => format!("value {place} (from 0) of this quantity"),
        };
        Some(match self {
            Self::Unread(fault) => fault.clone(),
            Self::Beside(others) => (of.span.clone(), without(&which, others)),
        })
    }
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
