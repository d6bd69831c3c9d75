//! Which quantities an input names, and whether they are one table.
//!
//! A certificate may have several tables of one kind: of two sensors, or before and after an adjustment,
//! which ISO/IEC 17025, 7.8.4.1 d has reported apart. What stands in different tables is never put
//! together; where a model file could mean several, it is asked which.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use gumption_units::nearest;
use roxmltree::{Node, NodeId};

use super::document::{self, Measured, names};
use super::standing::{self, STATUSES};
use gumption_text::DiagnosticKind;
use gumption_text::json::Json;
use gumption_text::object::{Object, whole_number};

/// Tables and quantities that a message lists, at most.
const SHOWN: usize = 8;

/// A mistake at one of the object's keys, or at the object where it has none of them.
fn report(object: &Object<'_>, keys: &[&str], reason: String) {
    let member = keys.iter().find_map(|key| object.get(key));
    let place = member.map_or(object.place(), |member| &member.value.span);
    object.log.report(place, DiagnosticKind::Certificate { reason });
}

/// The quantities that the object names; `None` where a mistake has been reported.
pub(super) fn quantities<'d>(
    object: &Object<'_>,
    all: &[Node<'d, 'd>],
) -> Option<Vec<Node<'d, 'd>>> {
    let pairs = [
        ("id", "ref_type"),
        ("id", "quantity"),
        ("ref_type", "quantity"),
        ("within", "quantity"),
        ("status", "quantity"),
    ];
    for (first, second) in pairs {
        if let (Some(_), Some(member)) = (object.get(first), object.get(second)) {
            object.log.report(&member.key_span, DiagnosticKind::Exclusive { first, second });
            return None;
        }
    }
    if object.get("quantity").is_some() {
        return of_places(object, all);
    }
    let mut found = match (object.get("id"), object.get("ref_type")) {
        (Some(_), _) => of_id(object, all)?,
        (_, Some(_)) => of_ref_type(object, all)?,
        _ => all.to_vec(),
    };
    if object.get("within").is_some() {
        let wanted = object.text("within")?;
        let around = |node: &Node<'d, 'd>| standing::around(*node);
        let known: HashSet<String> = found.iter().flat_map(around).collect();
        found.retain(|node| around(node).iter().any(|name| name == wanted));
        if found.is_empty() {
            let mut known: Vec<&str> = known.iter().map(String::as_str).collect();
            known.sort_unstable();
            let known = suggested(wanted, &known);
            let reason = format!("nothing around these quantities is called `{wanted}`{known}");
            report(object, &["within"], reason);
            return None;
        }
    }
    if let Some(member) = object.get("status") {
        let wanted = object.text("status")?;
        if !STATUSES.contains(&wanted) {
            let (key, found) = ("status".into(), wanted.to_owned());
            let allowed = STATUSES.map(str::to_owned).to_vec();
            let diagnostic = DiagnosticKind::NotOneOf { key, found, allowed };
            object.log.report(&member.value.span, diagnostic);
            return None;
        }
        let status = |node: &Node<'d, 'd>| standing::status(*node);
        let known: HashSet<String> = found.iter().filter_map(status).collect();
        found.retain(|node| status(node).is_some_and(|status| status == wanted));
        if found.is_empty() {
            let mut known: Vec<&str> = known.iter().map(String::as_str).collect();
            known.sort_unstable();
            let known = match known.is_empty() {
                true => "; none of them says a status".to_owned(),
                false => format!("; there are {}", known.join(", ")),
            };
            let reason = format!("none of these quantities has the status `{wanted}`{known}");
            report(object, &["status"], reason);
            return None;
        }
    }
    let is_named =
        ["id", "ref_type", "within", "status"].iter().any(|key| object.get(key).is_some());
    if !is_named && all.len() != 1 {
        let shown: Vec<String> =
            all.iter().take(SHOWN).map(|node| document::called(*node)).collect();
        let reason = format!(
            "the certificate has {} quantities, which `gumption dcc` lists; name one by its `id` or \
             `ref_type`, or by its place as `quantity`, from 0: {}{}",
            all.len(),
            shown.join(", "),
            if all.len() > SHOWN { ", ..." } else { "" }
        );
        report(object, &["file"], reason);
        return None;
    }
    // results go before conditions, limits and the like
    if found.iter().any(|node| standing::is_result(*node)) {
        found.retain(|node| standing::is_result(*node));
    }
    Some(found)
}

/// What may have been meant, as the end of a sentence.
fn suggested(wanted: &str, known: &[&str]) -> String {
    match nearest(wanted, known.iter().copied()) {
        Some(near) => format!("; did you mean `{near}`?"),
        None if known.is_empty() => String::new(),
        None => format!("; there are {}", known[..known.len().min(12)].join(", ")),
    }
}

/// Those at a place, or at several, among all of the certificate.
fn of_places<'d>(object: &Object<'_>, all: &[Node<'d, 'd>]) -> Option<Vec<Node<'d, 'd>>> {
    let member = object.get("quantity")?;
    let wrong = |span: &Range<usize>, reason: String| {
        object.log.report(span, DiagnosticKind::Certificate { reason });
    };
    let Json::List(list) = &member.value.value else {
        let place = object.whole("quantity", 0, 1 << 32)? as usize;
        let one = all.get(place);
        if one.is_none() {
            wrong(&member.value.span, beyond(all));
        }
        return one.map(|one| vec![*one]);
    };
    let mut found = Vec::new();
    for node in list {
        let place = match &node.value {
            Json::Number(text) => whole_number(text),
            _ => None,
        };
        match place.and_then(|place| all.get(usize::try_from(place).ok()?)) {
            Some(one) if found.contains(one) => {
                wrong(&node.span, "this quantity is named twice".to_owned());
                return None;
            }
            Some(one) => found.push(*one),
            None => {
                wrong(&node.span, beyond(all));
                return None;
            }
        }
    }
    if found.is_empty() {
        wrong(&member.value.span, "it names no quantity".to_owned());
        return None;
    }
    Some(found)
}

fn beyond(all: &[Node<'_, '_>]) -> String {
    format!("the certificate has {} quantities, counted from 0", all.len())
}

/// Those of an `id`, their own or that of what is in them.
fn of_id<'d>(object: &Object<'_>, all: &[Node<'d, 'd>]) -> Option<Vec<Node<'d, 'd>>> {
    let wanted = object.text("id")?;
    let is_it = |node: &Node<'d, 'd>| node.attribute("id") == Some(wanted);
    let is_quantity = |node: &Node<'d, 'd>| node.tag_name().name() == "quantity";
    let mut found: Vec<Node<'d, 'd>> = all.iter().filter(|node| is_it(node)).copied().collect();
    if found.is_empty() {
        // quantities may stand in each other
        let root = all.first().map(|node| node.document().root_element());
        let inside = root.into_iter().flat_map(|root| root.descendants()).filter(is_it);
        found = inside.filter_map(|inner| inner.ancestors().find(is_quantity)).collect();
        found.dedup();
    }
    if found.is_empty() {
        let known: Vec<&str> = all.iter().filter_map(|node| node.attribute("id")).collect();
        let known = suggested(wanted, &known);
        report(object, &["id"], format!("no quantity has the id `{wanted}`{known}"));
        return None;
    }
    Some(found)
}

/// Those of a reference type, their own or that of their list or of their data.
fn of_ref_type<'d>(object: &Object<'_>, all: &[Node<'d, 'd>]) -> Option<Vec<Node<'d, 'd>>> {
    let wanted = object.text("ref_type")?;
    let has = |node: &&Node<'d, 'd>| {
        let mut around = node.ancestors().take(3);
        around.any(|outer| document::has_ref_type(outer, wanted))
    };
    let found: Vec<Node<'d, 'd>> = all.iter().filter(has).copied().collect();
    if found.is_empty() {
        let mut known: Vec<&str> =
            all.iter().filter_map(|node| node.attribute("refType")).collect();
        known.dedup();
        let known = suggested(wanted, &known);
        report(object, &["ref_type"], format!("no quantity has the refType `{wanted}`{known}"));
        return None;
    }
    Some(found)
}

/// What the quantities of one table have in common. A quantity of several values is a table; those of one
/// value each are one where they stand beside each other, or each in a row of its own: a list without
/// others of them, which is called as the other rows are; or each in a result of its own.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct QuantityTable<'d> {
    around: NodeId,
    /// What a row and its quantity are called.
    row: Option<(Option<&'d str>, Vec<String>)>,
    status: Option<String>,
}

impl<'d> QuantityTable<'d> {
    /// That of a quantity; `beside` is how many quantities of one value each element has.
    fn of(node: Node<'d, 'd>, of: &Measured, beside: &HashMap<NodeId, usize>) -> Self {
        let status = standing::status(node);
        let parent = node.parent().filter(|_| of.values.len() == 1);
        let Some(parent) = parent else { return Self { around: node.id(), row: None, status } };
        let is_row = parent.tag_name().name() == "list" && beside.get(&parent.id()) == Some(&1);
        match parent.parent().filter(|_| is_row) {
            Some(rows) => {
                let called = names(parent).into_iter().chain(names(node)).collect();
                let row = Some((parent.attribute("refType"), called));
                Self { around: rows.id(), row, status }
            }
            None => Self { around: parent.id(), row: None, status },
        }
    }
}

/// Whether results of one value each are the rows of one table.
fn are_rows(
    tables: &[(Option<String>, Vec<usize>)],
    chosen: &[Node<'_, '_>],
    measured: &[Measured],
) -> bool {
    let part = |number: usize| standing::part(chosen[number]).map(|part| part.id());
    let parts: HashSet<Option<NodeId>> =
        tables.iter().filter_map(|(_, members)| members.first().map(|one| part(*one))).collect();
    let of = tables.first().and_then(|(status, _)| status.as_ref());
    parts.len() == tables.len()
        && tables.iter().all(|(status, members)| {
            status.as_ref() == of
                && matches!(&members[..], [one] if measured[*one].values.len() == 1)
        })
}

/// Whether the chosen quantities are one table; otherwise after a mistake. Those that the object lists by
/// their places are, unless some were found before and others after an adjustment.
pub(super) fn is_one_table<'d>(
    object: &Object<'_>,
    chosen: &[Node<'d, 'd>],
    measured: &[Measured],
    all: &[Node<'d, 'd>],
) -> bool {
    if object.get("quantity").is_some() {
        let of: HashSet<Option<String>> =
            chosen.iter().map(|node| standing::status(*node)).collect();
        if of.len() > 1 {
            let said =
                |status: &Option<String>| format!("`{}`", status.as_deref().unwrap_or("no status"));
            let mut of: Vec<String> = of.iter().map(said).collect();
            of.sort_unstable();
            let reason = format!(
                "these quantities are no table: they are of {}",
                gumption_units::listed(&of, " and ")
            );
            report(object, &["quantity"], reason);
            return false;
        }
        return true;
    }
    let mut beside: HashMap<NodeId, usize> = HashMap::new();
    for (node, _) in chosen.iter().zip(measured).filter(|(_, measured)| measured.values.len() == 1)
    {
        *beside.entry(node.parent().map_or(node.id(), |parent| parent.id())).or_default() += 1;
    }
    let mut places: HashMap<QuantityTable<'_>, usize> = HashMap::new();
    let mut tables: Vec<(Option<String>, Vec<usize>)> = Vec::new();
    for (number, (node, measured)) in chosen.iter().zip(measured).enumerate() {
        let table = QuantityTable::of(*node, measured, &beside);
        let status = table.status.clone();
        let place = *places.entry(table).or_insert(tables.len());
        match tables.get_mut(place) {
            Some((_, members)) => members.push(number),
            None => tables.push((status, vec![number])),
        }
    }
    if tables.len() < 2 || are_rows(&tables, chosen, measured) {
        return true;
    }
    // how many tables have this around them
    let mut known: HashMap<String, usize> = HashMap::new();
    for (status, members) in &tables {
        let around = members.first().map(|number| standing::around(chosen[*number]));
        let names: HashSet<String> = around.into_iter().flatten().collect();
        names.into_iter().for_each(|name| *known.entry(name).or_default() += 1);
        if let Some(status) = status {
            // never the name of an element
            *known.entry(format!("\0{status}")).or_default() += 1;
        }
    }
    let is_only = |name: &str| known.get(name) == Some(&1);
    let said = tables.iter().take(SHOWN).map(|(status, members)| {
        let nodes: Vec<Node<'d, 'd>> = members.iter().map(|number| chosen[*number]).collect();
        let count: usize = members.iter().map(|number| measured[*number].values.len()).sum();
        let node = nodes[0];
        let around = standing::around(node);
        let key = match status.as_ref().filter(|status| is_only(&format!("\0{status}"))) {
            Some(status) => format!("`\"status\": \"{status}\"`"),
            None => match around.iter().find(|name| is_only(name)) {
                Some(name) => format!("`\"within\": {}`", serde_json::Value::from(name.as_str())),
                None => {
                    let numbers = nodes.iter().take(SHOWN).map(|node| super::number(all, *node));
                    let numbers: Vec<String> = numbers.collect();
                    match numbers.as_slice() {
                        [one] => format!("`\"quantity\": {one}`"),
                        _ if nodes.len() > SHOWN => {
                            format!("`\"quantity\": [{}, ...]`", numbers.join(", "))
                        }
                        _ => format!("`\"quantity\": [{}]`", numbers.join(", ")),
                    }
                }
            },
        };
        let part = standing::part(node).and_then(|part| names(part).into_iter().next());
        let part = part.map_or_else(String::new, |name| format!(" of `{name}`"));
        let status = status.as_ref().map_or_else(String::new, |status| format!(", {status}"));
        let place = standing::place(node).unwrap_or("certificate");
        format!(
            "{count} value{}{part} ({place}{status}) by {key}",
            if count == 1 { "" } else { "s" }
        )
    });
    let said: Vec<String> = said.collect();
    let more = match tables.len() {
        count if count > SHOWN => format!("; and {} more", count - SHOWN),
        _ => String::new(),
    };
    let reason = format!(
        "there are {} tables that this can be, which are never put together: {}{more}. Say which; quantities \
         of one value each become a table by a list of their places, `\"quantity\": [1, 2]`",
        tables.len(),
        said.join("; ")
    );
    report(object, &["ref_type", "id", "within", "status"], reason);
    false
}
