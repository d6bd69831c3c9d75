//! Where a quantity of a certificate stands, and whether it was found before or after an adjustment.

use roxmltree::Node;

use super::document::{BLANKS, content_of, names};

/// What `dcc:status` may be (DCC 3.2.1, `conditionType`).
pub(crate) const STATUSES: [&str; 4] =
    ["beforeAdjustment", "afterAdjustment", "beforeRepair", "afterRepair"];

/// Elements that hold quantities of one kind.
const PLACES: [&str; 6] = [
    "results",
    "influenceConditions",
    "measuringEquipments",
    "usedMethods",
    "measurementMetaData",
    "statements",
];

/// What a quantity belongs to within a place.
const PARTS: [&str; 6] =
    ["result", "influenceCondition", "measuringEquipment", "usedMethod", "metaData", "statement"];

fn is(node: Node<'_, '_>, name: &str) -> bool {
    node.tag_name().name() == name
}

/// What an element says of itself before and behind what it holds, of which there may be very much.
fn about<'d>(node: Node<'d, 'd>) -> impl Iterator<Item = Node<'d, 'd>> {
    let is_content = |node: &Node<'d, 'd>| {
        let name = node.tag_name().name();
        ["quantity", "list", "data", "measurementResult"].contains(&name) || PARTS.contains(&name)
    };
    let before = node.children().take_while(move |child| !is_content(child));
    before.chain(node.children().rev().take_while(move |child| !is_content(child)))
}

/// The element around a quantity that says what it is: `results`, `influenceConditions` and the like; the
/// nearest one, as a quantity may have conditions of its own.
pub(super) fn place<'d>(node: Node<'d, 'd>) -> Option<&'d str> {
    let around = node.ancestors().map(|ancestor| ancestor.tag_name().name());
    around.into_iter().find(|name| PLACES.contains(name))
}

/// Whether a quantity is a result of the calibration, and not a condition or the like.
pub(super) fn is_result<'d>(node: Node<'d, 'd>) -> bool {
    place(node) == Some("results")
}

/// The result, the influence condition or the like that a quantity is of.
pub(super) fn part<'d>(node: Node<'d, 'd>) -> Option<Node<'d, 'd>> {
    node.ancestors().find(|ancestor| PARTS.contains(&ancestor.tag_name().name()))
}

/// Before or after what a quantity was measured: by the status of what it stands in, by conditions of its
/// own or of its list that have no other content, or by a reference type.
pub(super) fn status<'d>(node: Node<'d, 'd>) -> Option<String> {
    node.ancestors().find_map(|ancestor| {
        let typed = || {
            let kinds = ancestor.attribute("refType")?.split(BLANKS);
            let mut kinds = kinds.filter_map(|kind| kind.rsplit('_').next());
            kinds.find_map(known)
        };
        stated(ancestor).or_else(|| of_conditions(ancestor)).or_else(typed)
    })
}

/// Whether a quantity was found before an adjustment or a repair.
pub(super) fn is_before<'d>(node: Node<'d, 'd>) -> bool {
    status(node).is_some_and(|status| status.starts_with("before"))
}

fn known(text: &str) -> Option<String> {
    let known = STATUSES.into_iter().find(|known| known.eq_ignore_ascii_case(text));
    known.map(str::to_owned)
}

/// The status of an element itself, as it is written where it is none of those that there are.
fn stated<'d>(node: Node<'d, 'd>) -> Option<String> {
    let text = content_of(about(node).find(|around| is(*around, "status"))?);
    let text = text.trim();
    (!text.is_empty()).then(|| known(text).unwrap_or_else(|| text.to_owned()))
}

/// The status of conditions of a quantity or a list, which hold no quantities themselves.
fn of_conditions<'d>(node: Node<'d, 'd>) -> Option<String> {
    if !is(node, "quantity") && !is(node, "list") {
        return None;
    }
    let conditions = about(node).filter(|around| is(*around, "influenceConditions"));
    let conditions = conditions.flat_map(|list| list.children());
    let is_bare =
        |node: &Node<'d, 'd>| !node.descendants().any(|descendant| is(descendant, "quantity"));
    conditions.filter(is_bare).find_map(stated)
}

/// What the elements around a quantity are called: their ids, reference types and names, the inner ones
/// first.
pub(super) fn around<'d>(node: Node<'d, 'd>) -> Vec<String> {
    let of_one = |node: Node<'d, 'd>| {
        let id = node.attribute("id").map(str::to_owned);
        let kinds = node.attribute("refType").unwrap_or_default().split(BLANKS);
        let kinds = kinds.filter(|kind| !kind.is_empty()).map(str::to_owned);
        id.into_iter().chain(names(node)).chain(kinds).collect::<Vec<_>>()
    };
    node.ancestors().skip(1).filter(Node::is_element).flat_map(of_one).collect()
}
