//! Files of costs: what improvements of the inputs of a model cost, for plans.

use std::path::Path;

use super::keys::{self, COSTS_KEY};
use super::open::{check_format, open, read_root};
use gumption_analysis::plan::{Costs, Improvement, Offer};
use gumption_engine::distribution::Distribution;
use gumption_engine::task::Task;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::{DiagnosticKind, Diagnostics};
use gumption_units::{Unit, listed, nearest};

/// At most so many offers of an input.
const MOST_OFFERS: usize = 1000;

/// The most readings that can be planned.
const MOST_READINGS: u64 = 1_000_000_000;

/// A file of costs that was read and found right for a model.
#[derive(Clone, Debug, PartialEq)]
pub struct CostFile {
    /// The costs.
    pub costs: Costs,
    /// The file's text.
    pub text: String,
}

/// Reads and checks a file of the costs of a task's inputs.
///
/// # Errors
/// All mistakes of the file, in the order of their places.
pub fn read_costs(path: &Path, task: &Task) -> Result<CostFile, Diagnostics> {
    open(path, |name, text, _| read_costs_text(name, text, task))
}

/// Reads and checks the text of such a file; `name` is used in messages.
///
/// # Errors
/// All mistakes of the text, in the order of their places.
pub fn read_costs_text(name: &str, text: &str, task: &Task) -> Result<CostFile, Diagnostics> {
    let costs = read_root(name, text, "a file of costs", |root| Some(costs(root, Some(task))))?;
    Ok(CostFile { costs, text: text.to_owned() })
}

/// Checks a text as far as that goes without its model.
pub(super) fn check_text(name: &str, text: &str) -> Result<(), Diagnostics> {
    read_root(name, text, "a file of costs", |root| Some(costs(root, None))).map(|_| ())
}

/// Whether a text is meant as a file of costs.
pub(super) fn is_meant(root: &Node) -> bool {
    let Json::Object(members) = &root.value else { return false };
    members.iter().any(|member| member.key == COSTS_KEY)
}

fn costs(root: Object<'_>, task: Option<&Task>) -> Costs {
    keys::check(&root, keys::COSTS);
    check_format(&root, 1.0);
    root.text("title");
    let currency = root.text("currency").unwrap_or("").to_owned();
    let mut improvements = vec![None; task.map_or(0, |task| task.variables.len())];
    if let Some(member) = root.required(COSTS_KEY)
        && let Some(object) = Object::new(root.log, "`costs`", &member.value, &member.key_span)
    {
        for member in object.members() {
            let place = task.map(|task| variable(&object, member, task));
            let (unit, known) = match (task, place) {
                (Some(task), Some(Some(place))) => {
                    let row = task.rows.first();
                    let known = row.and_then(|row| row.distributions.get(place));
                    (task.variables.get(place).map(|v| &v.unit), known.map(|known| &**known))
                }
                _ => (None, None),
            };
            let found = improvement(&root, member, unit, known);
            if let Some(Some(place)) = place
                && let Some(slot) = improvements.get_mut(place)
            {
                *slot = found;
            }
        }
    }
    Costs::Stated { improvements, currency }
}

/// The variable of a member's name.
fn variable(object: &Object<'_>, member: &Member, task: &Task) -> Option<usize> {
    let shown = || task.variables.iter().filter(|variable| variable.shown);
    let place = task.variables.iter().position(|v| v.shown && v.name == member.key);
    if place.is_none() {
        // of a quantity that is made of components its first one
        let part = format!("{}/", member.key);
        let component = shown().find(|variable| variable.name.starts_with(&part));
        let names = shown().map(|variable| variable.name.as_str());
        let near = component
            .map(|component| component.name.as_str())
            .or_else(|| nearest(&member.key, names));
        let (name, nearest) = (member.key.clone(), near.map(str::to_owned));
        object.log.report(&member.key_span, DiagnosticKind::NoSuchInput { name, nearest });
    }
    place
}

/// What the improvement of an input costs; its unit and its distribution where the model is known.
fn improvement(
    root: &Object<'_>,
    member: &Member,
    unit: Option<&Unit>,
    known: Option<&Distribution>,
) -> Option<Improvement> {
    let log = root.log;
    let object = Object::new(log, "the costs of an input", &member.value, &member.key_span)?;
    keys::check(&object, keys::COST);
    let kinds = ["cost", "per_reading", "offers"];
    let given: Vec<&str> = kinds.into_iter().filter(|key| object.get(key).is_some()).collect();
    let [kind] = given.as_slice() else {
        let reason = format!(
            "one of `cost` (of any standard uncertainty), `per_reading` and `offers` is needed, and \
             here {}",
            if given.is_empty() {
                "is none".to_owned()
            } else {
                format!("are {}", listed(&given, " and "))
            }
        );
        object.report(DiagnosticKind::Cost { reason });
        return None;
    };
    for (key, with) in [("power", "cost"), ("least", "cost"), ("most", "per_reading")] {
        if let Some(member) = object.get(key).filter(|_| *kind != with) {
            log.report(&member.key_span, DiagnosticKind::OnlyWith { key, with });
        }
    }
    match *kind {
        "cost" => {
            let power = object.get("power").map_or(Some(1.0), |_| positive(&object, "power"));
            let least = object.get("least").map_or(Some(0.0), |_| width(&object, "least", unit));
            let power = power.filter(|power| {
                let small = *power <= 100.0;
                if !small {
                    out_of_range(&object, "power", *power, "at most 100");
                }
                small
            });
            let cost = positive(&object, "cost")?;
            Some(Improvement::Continuous { cost, power: power?, least: least? })
        }
        "per_reading" => {
            if known.is_some_and(|known| !matches!(known, Distribution::Readings(_))) {
                let reason = format!(
                    "`per_reading` is of readings, but `{}` is not evaluated from readings; give \
                     `cost` or `offers`",
                    member.key
                );
                object.report(DiagnosticKind::Cost { reason });
            }
            let most = match object.get("most") {
                Some(_) => object.whole("most", 2, MOST_READINGS)?,
                None => MOST_READINGS,
            };
            Some(Improvement::Readings { each: positive(&object, "per_reading")?, most })
        }
        _ => offers(&object, unit).map(Improvement::Offers),
    }
}

fn offers(object: &Object<'_>, unit: Option<&Unit>) -> Option<Vec<Offer>> {
    let list = object.list("offers")?;
    if list.is_empty() || list.len() > MOST_OFFERS {
        let found = list.len();
        object.report(if list.is_empty() {
            DiagnosticKind::Cost { reason: "`offers` is empty; leave the input out".to_owned() }
        } else {
            DiagnosticKind::TooMany { what: "offers", found, most: MOST_OFFERS }
        });
        return None;
    }
    let offer = |node: &Node| {
        let object = Object::new(object.log, "an offer", node, &node.span)?;
        keys::check(&object, keys::OFFER);
        object.required("standard_uncertainty")?;
        object.required("cost")?;
        let about = object.text("about").unwrap_or("").to_owned();
        let cost = object.number("cost").filter(|cost| {
            let right = *cost >= 0.0;
            if !right {
                out_of_range(&object, "cost", *cost, "zero or more");
            }
            right
        });
        let width = width(&object, "standard_uncertainty", unit).filter(|width| {
            let right = *width > 0.0;
            if !right {
                let (key, found) = ("standard_uncertainty".to_owned(), *width);
                object.report(DiagnosticKind::NotPositive { key, found });
            }
            right
        });
        let (standard_uncertainty, cost) = (width?, cost?);
        Some(Offer { standard_uncertainty, cost, about })
    };
    let found: Vec<Offer> = list.iter().filter_map(offer).collect();
    (found.len() == list.len()).then_some(found)
}

/// A width of zero or more, in a unit where that is known.
fn width(object: &Object<'_>, key: &str, unit: Option<&Unit>) -> Option<f64> {
    let member = object.get(key)?;
    let value = match (unit, &member.value.value) {
        // without the model nothing says what its unit has to be
        (None, Json::Text(_)) => return Some(1.0),
        (Some(unit), _) => object.value(key, unit, ValueOf::Difference)?,
        (None, _) => object.number(key)?,
    };
    if value < 0.0 {
        out_of_range(object, key, value, "zero or more");
        return None;
    }
    Some(value)
}

fn positive(object: &Object<'_>, key: &str) -> Option<f64> {
    let value = object.number(key)?;
    if value > 0.0 {
        return Some(value);
    }
    let place = object.get(key).map_or(object.place(), |member| &member.value.span);
    let (key, found) = (key.to_owned(), value);
    object.log.report(place, DiagnosticKind::NotPositive { key, found });
    None
}

fn out_of_range(object: &Object<'_>, key: &str, found: f64, range: &'static str) {
    let place = object.get(key).map_or(object.place(), |member| &member.value.span);
    let key = key.to_owned();
    object.log.report(place, DiagnosticKind::OutOfRange { key, found, range });
}
