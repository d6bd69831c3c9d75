//! Tolerance limits and capabilities of outputs: numbers, specifications, or formulas of the conditions,
//! which every row of a sweep has others of.

use std::ops::Range;
use std::sync::Arc;

use super::condition_values::ConditionValues;
use super::constant_inputs::ConstantInputs;
use super::model_checks::Quantities;
use super::scopes::ConditionSet;
use gumption_engine::model::formula::{Formula, KelvinKind, Scope, Typing};
use gumption_engine::model::{Capability, OfConditions, Quantity};
use gumption_engine::number::Shortest;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::width::{self, LinearWidth, NOT_A_SUM, Width};
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::Unit;

/// A capability, and what of it follows the conditions.
pub(super) type CapabilityOfRows = (Capability, Option<OfConditions>);

/// The formula of conditions that a text is: one with names, which no value with a unit can be read as.
pub(super) fn formula(object: &Object<'_>, member: &Member) -> Option<Formula> {
    let Json::Text(text) = &member.value.value else { return None };
    object.log.formula(text).ok().filter(|formula| formula.names().next().is_some())
}

/// The figure that a formula of conditions is in the output's unit; its mistakes are reported.
pub(super) fn following(
    object: &Object<'_>,
    key: &str,
    member: &Member,
    formula: Formula,
    of: ValueOf,
    unit: &Unit,
    set: &ConditionSet<'_>,
) -> Option<OfConditions> {
    if set.are_unreadable() {
        return None;
    }
    if let Err(kinds) = set.check(&formula, unit, of) {
        for kind in kinds {
            object.log.report(&member.value.span, kind.of_key(key));
        }
        return None;
    }
    Some(figure(&formula, of, unit, set))
}

/// What a formula of conditions gives in a unit.
fn figure(formula: &Formula, of: ValueOf, unit: &Unit, set: &ConditionSet<'_>) -> OfConditions {
    let set = ConditionSet { constants: &ConstantInputs::default(), ..*set };
    let compiled = set.compiled(formula, unit, of);
    OfConditions::new(move |conditions| compiled.at(conditions))
}

/// A limit of an output in degC or degF that is a formula of conditions: a temperature, or a difference of
/// temperatures, as the output is, which only its equation tells.
#[derive(Debug)]
pub(super) struct LimitFormula {
    key: &'static str,
    place: Range<usize>,
    formula: String,
    /// What the formula itself is: a temperature or a difference of two; none where it may be both.
    is_difference: Option<bool>,
    /// The limit as a difference, in the output's unit.
    difference: OfConditions,
}

impl LimitFormula {
    /// Of an output that counts from a zero and whose units are checked.
    pub(super) fn of(
        key: &'static str,
        member: &Member,
        formula: &Formula,
        unit: &Unit,
        set: &ConditionSet<'_>,
    ) -> Option<Self> {
        let is_temperature = unit.zero().is_some() && unit.level_exponent().is_zero();
        if !(is_temperature && set.check_units) {
            return None;
        }
        let typing = set.typing(formula)?;
        Some(Self {
            key,
            place: member.value.span.clone(),
            formula: formula.text().to_owned(),
            is_difference: is_difference(typing),
            difference: figure(formula, ValueOf::Difference, unit, set),
        })
    }
}

/// Whether a quantity in K is a difference of temperatures, or a temperature; none where it may be both.
fn is_difference(typing: Typing) -> Option<bool> {
    match typing.kelvin {
        _ if typing.zero.is_some() => Some(false),
        KelvinKind::Difference => Some(true),
        KelvinKind::Thermodynamic => Some(false),
        KelvinKind::Either => None,
    }
}

/// Takes the limits of temperatures as what their outputs are, from what is known of the equations: those of
/// a difference are differences, those of a temperature are temperatures. One of the other kind is refused.
pub(super) fn of_temperatures(log: &Collector, scope: &Scope, of: &mut Quantities) {
    let first = of.conditions.rows.first().map_or(&[][..], Vec::as_slice);
    for (place, limit) in &of.outputs.limits {
        let Some(output) = of.outputs.outputs.get_mut(*place) else { continue };
        let name = &output.quantity.name;
        let Some(typing) = scope.get(name) else { continue };
        let own = is_difference(typing);
        let refused = match (own, limit.is_difference) {
            (Some(false), Some(true)) => Some("a difference of temperatures"),
            // as of a number in K
            (Some(false), None) if typing.zero.is_some() => Some("in K, and may be a difference"),
            (Some(true), Some(false)) => Some("a temperature"),
            _ => None,
        };
        if let Some(what) = refused {
            let unit = &output.quantity.unit;
            let its =
                if own == Some(true) { "a difference of temperatures" } else { "a temperature" };
            let reason = format!("it is {what}, and `{name}` is {its} in `{unit}`");
            let (key, found) = (limit.key.to_owned(), limit.formula.clone());
            log.report(&limit.place, DiagnosticKind::Value { key, found, reason });
        } else if own != Some(false) && limit.is_difference != Some(false) {
            let figure = limit.difference.at(first);
            let mut following = output.following.as_deref().cloned().unwrap_or_default();
            let is_lower = limit.key == "lower";
            let end = if is_lower { &mut following.lower } else { &mut following.upper };
            *end = Some(limit.difference.clone());
            output.following = Some(Arc::new(following));
            if let Some(tolerance) = &mut output.tolerance {
                let end = if is_lower { &mut tolerance.lower } else { &mut tolerance.upper };
                *end = Some(figure);
            }
        }
    }
}

/// The laboratory's capability for an output, which is where the keys stand; `name` is for messages.
pub(super) fn capability(
    output: &Object<'_>,
    name: &str,
    unit: &Unit,
    set: &ConditionSet<'_>,
) -> Option<CapabilityOfRows> {
    let floor = output.truth("cmc_floor").unwrap_or(false);
    let Some(member) = output.get("cmc") else {
        if let Some(floor) = output.get("cmc_floor") {
            let diagnostic = DiagnosticKind::OnlyWith { key: "cmc_floor", with: "cmc" };
            output.log.report(&floor.key_span, diagnostic);
        }
        return None;
    };
    let (relative, absolute, following) = parts(output, name, member, unit, set)?;
    let capability = Capability { relative, absolute, floor };
    let Some(following) = following else { return Some((capability, None)) };
    for (row, conditions) in set.conditions.rows.iter().enumerate() {
        let found = following.at(conditions);
        if !(found.is_finite() && (found > 0.0 || found == 0.0 && relative > 0.0)) {
            let reason = format!(
                "it is {} in row {} of the conditions, but must be above 0",
                Shortest(found),
                row + 1
            );
            output.log.report(&member.value.span, wrong(name, member, reason));
            return None;
        }
    }
    let first = set.conditions.rows.first().map_or(absolute, |row| following.at(row));
    Some((Capability { absolute: first, ..capability }, Some(following)))
}

/// The share of the estimate, the rest, and in place of the rest what follows the conditions.
fn parts(
    output: &Object<'_>,
    name: &str,
    member: &Member,
    unit: &Unit,
    set: &ConditionSet<'_>,
) -> Option<(f64, f64, Option<OfConditions>)> {
    let log = output.log;
    if let Json::Text(text) = &member.value.value
        && let Some((shares, others)) = shares_of_conditions(text, set)
    {
        let mut width = LinearWidth::default();
        if !others.is_empty() {
            let read = Width::specification(&others.join(" + "), unit, &log.own_units(), None);
            let read = read.and_then(|width| width.sum().ok_or_else(|| NOT_A_SUM.to_owned()));
            let read = read.map_err(|reason| wrong(name, member, reason));
            width = log.value(&member.value.span, read)?;
            refuse_bare_share(output, name, member, &others, unit, width, set)?;
        }
        let mut all: Vec<(f64, OfConditions)> = Vec::new();
        for (share, condition) in shares {
            let formula = log.formula(condition).ok()?;
            let of = ValueOf::Difference;
            all.push((share, following(output, "cmc", member, formula, of, unit, set)?));
        }
        let absolute = width.absolute;
        let sum = move |values: &[f64]| {
            absolute
                + all.iter().map(|(share, formula)| share * formula.at(values).abs()).sum::<f64>()
        };
        return Some((width.relative, absolute, Some(OfConditions::new(sum))));
    }
    let formula = formula(output, member)
        .filter(|_| Width::read(log, &member.value, name, "cmc", unit, None).is_err());
    if let Some(formula) = formula {
        let of = ValueOf::Difference;
        let following = following(output, "cmc", member, formula, of, unit, set)?;
        return Some((0.0, 0.0, Some(following)));
    }
    let width = Width::read(log, &member.value, name, "cmc", unit, None)
        .and_then(|width| width.sum().ok_or_else(|| wrong(name, member, NOT_A_SUM.to_owned())));
    let width = log.value(&member.value.span, width)?;
    if let Json::Text(text) = &member.value.value {
        refuse_bare_share(output, name, member, &width::terms(text), unit, width, set)?;
    }
    Some((width.relative, width.absolute, None))
}

/// Shares, each with the name of its condition.
type Shares<'t> = Vec<(f64, &'t str)>;

/// Shares of conditions, `0.01 % of p`, each with the name, and the other terms of a specification;
/// `None` where no term is a share of a condition.
fn shares_of_conditions<'t>(
    text: &'t str,
    set: &ConditionSet<'_>,
) -> Option<(Shares<'t>, Vec<&'t str>)> {
    let known = |name: &str| set.conditions.quantities.iter().any(|quantity| quantity.name == name);
    let share = |term: &'t str| {
        let (value, rest) = width::number(term).ok()?;
        let (factor, of) = width::share(rest)?;
        (value >= 0.0 && value.is_finite() && known(of)).then_some((value * factor, of))
    };
    let (mut shares, mut others) = (Vec::new(), Vec::new());
    for term in width::terms(text) {
        match share(term) {
            Some(share) => shares.push(share),
            None => others.push(term),
        }
    }
    (!shares.is_empty()).then_some((shares, others))
}

/// A share of which nobody says what it is of, where a condition has the output's unit: an error of
/// indication beside the pressure at which it was found. Nothing is read in two ways.
fn refuse_bare_share(
    output: &Object<'_>,
    name: &str,
    member: &Member,
    terms: &[&str],
    unit: &Unit,
    width: LinearWidth,
    set: &ConditionSet<'_>,
) -> Option<()> {
    let is_bare = |term: &&&str| width::is_bare_share(term);
    let Some(term) = terms.iter().find(is_bare).filter(|_| width.relative > 0.0) else {
        return Some(());
    };
    let alike = |quantity: &&Quantity| {
        !unit.dimension().is_none() && quantity.unit.dimension() == unit.dimension()
    };
    let Some(condition) = set.conditions.quantities.iter().find(alike) else { return Some(()) };
    let condition = &condition.name;
    let reason = format!(
        "`{term}` could be of the value of `{name}` or of the condition `{condition}`, which is in the \
         same unit: write `{term} of reading` for the value of `{name}`, or `{term} of {condition}`"
    );
    output.log.report(&member.value.span, wrong(name, member, reason));
    None
}

fn wrong(name: &str, member: &Member, reason: String) -> DiagnosticKind {
    let found = match &member.value.value {
        Json::Text(text) => text.clone(),
        other => other.kind().to_owned(),
    };
    DiagnosticKind::Width { name: name.to_owned(), found, reason }
}
