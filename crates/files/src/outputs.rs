//! The outputs of a file.

use std::ops::Range;
use std::sync::Arc;

use super::conditions::unit;
use super::instrument;
use super::keys;
use super::output_limits::{self, LimitFormula};
use super::results::ResultFiles;
use super::scopes::ConditionSet;
use super::shapes::{self, Estimate, Fields};
use gumption_engine::distribution::{Distribution, Invalid};
use gumption_engine::model::{
    CapabilityLine, FollowingConditions, GuardRule, OfConditions, Output, Quantity, Tolerance,
};
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::other_names::other_name;
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::Unit;

/// Outputs with their places.
#[derive(Debug, Default)]
pub(super) struct Outputs {
    pub outputs: Vec<Output>,
    pub(super) places: Vec<Range<usize>>,
    /// Where each output's unit stands.
    pub(super) unit_places: Vec<Range<usize>>,
    /// Names of those whose unit could not be read.
    pub(super) without_unit: Vec<String>,
    /// Names of complex ones.
    pub(super) complex: Vec<String>,
    /// Limits of temperatures that are formulas, each with the place of its output.
    pub(super) limits: Vec<(usize, LimitFormula)>,
}

impl Outputs {
    /// The two real outputs of a complex quantity.
    fn complex(&mut self, object: &Object<'_>, member: &Member, complex: &Member) {
        let log = object.log;
        let polar = match object.text("complex") {
            Some("re-im") => false,
            Some("polar") => true,
            Some(other) => {
                let diagnostic = DiagnosticKind::NotOneOf {
                    key: "complex".into(),
                    found: other.to_owned(),
                    allowed: vec!["re-im".into(), "polar".into()],
                };
                log.report(&complex.value.span, diagnostic);
                return;
            }
            None => return,
        };
        for key in ["periodic", "tolerance", "cmc", "cmc_floor", "cmc_line"] {
            if let Some(second) = object.get(key) {
                let reason = format!(
                    "is complex, and `{key}` is of a real output; give its part, such as \
                     abs({0}), an equation and an output of its own",
                    member.key
                );
                let name = member.key.clone();
                log.report(&second.key_span, DiagnosticKind::Complex { name, reason });
            }
        }
        let whole = unit(object, "unit").unwrap_or_else(Unit::one);
        let radian = || Unit::parse("rad").unwrap_or_else(|_| Unit::one());
        let phase = match object.get("phase_unit") {
            None => radian(),
            Some(_) => unit(object, "phase_unit").unwrap_or_else(radian),
        };
        let parts = if polar {
            [("abs", &whole), ("arg", &phase)]
        } else {
            [("re", &whole), ("im", &whole)]
        };
        for (part, unit) in parts {
            let mut output = Output::new(Quantity {
                name: format!("{}.{part}", member.key),
                unit: unit.clone(),
                about: object.text("about").unwrap_or("").to_owned(),
            });
            if part == "arg" {
                // values on the branch within half a turn of the estimate
                output.period = Some(unit.from_si(std::f64::consts::TAU));
            }
            let place = object.get("unit").map_or(&member.key_span, |m| &m.value.span);
            let phase_place = object.get("phase_unit").map(|m| &m.value.span);
            let place = phase_place.filter(|_| part == "arg").unwrap_or(place);
            self.outputs.push(output);
            self.places.push(member.key_span.clone());
            self.unit_places.push(place.clone());
        }
        self.complex.push(member.key.clone());
    }

    /// The outputs with the places of their names and units.
    pub(super) fn each(&self) -> impl Iterator<Item = (&Output, &Range<usize>, &Range<usize>)> {
        let places = self.places.iter().zip(&self.unit_places);
        self.outputs.iter().zip(places).map(|(output, (place, unit))| (output, place, unit))
    }
}

/// Reads `outputs`.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    results: &ResultFiles<'_>,
    set: &ConditionSet<'_>,
) -> Option<Outputs> {
    let object = Object::new(log, "`outputs`", &member.value, &member.key_span)?;
    if object.members().is_empty() {
        object.report(DiagnosticKind::NoValues { name: "outputs".into() });
    }
    let mut outputs = Outputs::default();
    for member in object.members().iter().take_while(|_| !log.is_full()) {
        let Some(object) = Object::new(log, "an output", &member.value, &member.key_span) else {
            continue;
        };
        keys::check(&object, keys::OUTPUT);
        if let Some(complex) = object.get("complex") {
            outputs.complex(&object, member, complex);
            continue;
        }
        if let Some(phase) = object.get("phase_unit") {
            let diagnostic = DiagnosticKind::OnlyWith { key: "phase_unit", with: "complex" };
            log.report(&phase.key_span, diagnostic);
        }
        let unit = unit(&object, "unit").unwrap_or_else(|| {
            outputs.without_unit.push(member.key.clone());
            Unit::one()
        });
        let period = object.value("periodic", &unit, ValueOf::Difference);
        if let (Some(period), Some(member)) = (period, object.get("periodic"))
            && period <= 0.0
        {
            let diagnostic = DiagnosticKind::NotPositive { key: "periodic".into(), found: period };
            log.report(&member.value.span, diagnostic);
        }
        let capability = output_limits::capability(&object, &member.key, &unit, set);
        let capability_line = capability_line(&object, set);
        let decision = Decision::read(&object, &unit, results, set);
        let quantity = Quantity {
            name: member.key.clone(),
            unit,
            about: object.text("about").unwrap_or("").to_owned(),
        };
        let unit_place = object.get("unit").map_or(&member.key_span, |m| &m.value.span);
        let Decision {
            guard_factor,
            non_binary,
            guard_rule,
            specification,
            agreed,
            tolerance,
            prior,
            risk,
            lower,
            upper,
            limits,
        } = decision;
        let place = outputs.outputs.len();
        outputs.limits.extend(limits.into_iter().map(|limit| (place, limit)));
        let mut output = Output::new(quantity);
        let (capability, of_rows) = capability.unzip();
        let following = FollowingConditions { lower, upper, capability: of_rows.flatten() };
        let FollowingConditions { lower, upper, capability: of_rows } = &following;
        let follows = lower.is_some() || upper.is_some() || of_rows.is_some();
        output.following = follows.then(|| Arc::new(following));
        (output.period, output.capability) = (period, capability);
        output.capability_line = capability_line;
        (output.tolerance, output.prior, output.risk) = (tolerance, prior, risk);
        (output.guard_factor, output.guard_rule) = (guard_factor, guard_rule);
        output.non_binary = non_binary;
        (output.specification, output.rule_agreed) = (specification, agreed);
        outputs.outputs.push(output);
        outputs.places.push(member.key_span.clone());
        outputs.unit_places.push(unit_place.clone());
    }
    Some(outputs)
}

/// The line over a condition that is to be fitted to U of the rows.
fn capability_line(output: &Object<'_>, set: &ConditionSet<'_>) -> Option<CapabilityLine> {
    let member = output.get("cmc_line")?;
    let object = Object::new(output.log, "`cmc_line`", &member.value, &member.key_span)?;
    keys::check(&object, keys::CMC_LINE);
    let (over, form) = (object.required("over")?, object.required("form")?);
    let allowed = |key: &str, member: &Member, found: &str, allowed: Vec<String>| {
        let (key, found) = (key.to_owned(), found.to_owned());
        object.log.report(&member.value.span, DiagnosticKind::NotOneOf { key, found, allowed });
    };
    let name = object.text("over")?;
    let quantities = &set.conditions.quantities;
    let condition = quantities.iter().position(|quantity| quantity.name == name);
    let Some(condition) = condition else {
        let names = quantities.iter().map(|quantity| quantity.name.clone()).collect();
        allowed("over", over, name, names);
        return None;
    };
    let found = object.text("form")?;
    if !["Q", "sum"].contains(&found) {
        allowed("form", form, found, vec!["Q".to_owned(), "sum".to_owned()]);
        return None;
    }
    let digits = match object.get("digits") {
        None => 2.0,
        Some(_) => object.number("digits")?,
    };
    if !(1.0..=6.0).contains(&digits) || digits.fract() != 0.0 {
        let place = object.get("digits").map_or(object.place(), |digits| &digits.value.span);
        let (key, range) = ("digits".to_owned(), "a whole number from 1 to 6");
        object.log.report(place, DiagnosticKind::OutOfRange { key, found: digits, range });
        return None;
    }
    Some(CapabilityLine { condition, is_quadratic: found == "Q", digits: digits as u32 })
}

/// What is to be decided about an output.
#[derive(Debug, Default)]
struct Decision {
    tolerance: Option<Tolerance>,
    prior: Option<Arc<Distribution>>,
    risk: Option<f64>,
    guard_factor: Option<f64>,
    non_binary: bool,
    guard_rule: Option<GuardRule>,
    specification: Option<Arc<str>>,
    agreed: bool,
    lower: Option<OfConditions>,
    upper: Option<OfConditions>,
    /// Of a temperature the formulas of these.
    limits: Vec<LimitFormula>,
}

/// Shapes that a prior cannot have: it is about many items.
const NO_PRIORS: [&str; 5] = ["constant", "readings", "samples", "result", "codata"];

impl Decision {
    fn read(
        output: &Object<'_>,
        unit: &Unit,
        results: &ResultFiles<'_>,
        set: &ConditionSet<'_>,
    ) -> Self {
        let Some(member) = output.get("tolerance") else {
            return Self::default();
        };
        let object = Object::new(output.log, "`tolerance`", &member.value, &member.key_span);
        let Some(object) = object else {
            return Self::default();
        };
        keys::check(&object, keys::TOLERANCE);
        let risk = object.number("risk");
        if let (Some(risk), Some(member)) = (risk, object.get("risk"))
            && !(risk > 0.0 && risk < 0.5)
        {
            let (key, found, below) = ("risk".into(), risk, 0.5);
            let diagnostic = DiagnosticKind::NotProbability { key, found, below };
            object.log.report(&member.value.span, diagnostic);
        }
        let (guard_factor, guard_rule) = guard_band(&object);
        let non_binary = is_non_binary(&object);
        let specification = object.text("specification").map(Arc::from);
        let agreed = object.truth("agreed").unwrap_or(false);
        let prior = prior(&object, unit, results).map(Arc::new);
        let mut limits = Vec::new();
        let ends = ["lower", "upper"].map(|key| {
            let member = object.get(key)?;
            let formula = output_limits::formula(&object, member)?;
            limits.extend(LimitFormula::of(key, member, &formula, unit, set));
            let of = ValueOf::Quantity;
            Some(output_limits::following(&object, key, member, formula, of, unit, set))
        });
        let [lower, upper] = ends;
        let is_wrong = |end: &Option<Option<OfConditions>>| matches!(end, Some(None));
        if is_wrong(&lower) || is_wrong(&upper) {
            return Self::default();
        }
        let ends = [lower.flatten(), upper.flatten()];
        let tolerance = tolerance(&object, unit, &ends, set);
        let [lower, upper] = ends;
        Self {
            tolerance,
            prior,
            risk,
            guard_factor,
            non_binary,
            guard_rule,
            specification,
            agreed,
            lower,
            upper,
            limits,
        }
    }
}

/// The guard band, which is a decision rule of its own beside a wanted risk: in multiples of U, or a
/// rule with a name.
fn guard_band(tolerance: &Object<'_>) -> (Option<f64>, Option<GuardRule>) {
    let Some(member) = tolerance.get("guard_band") else { return (None, None) };
    if tolerance.get("risk").is_some() {
        let diagnostic = DiagnosticKind::Exclusive { first: "risk", second: "guard_band" };
        tolerance.log.report(&member.key_span, diagnostic);
        return (None, None);
    }
    match &member.value.value {
        Json::Text(name) => (None, guard_rule(tolerance, member, name)),
        _ => (guard_factor(tolerance, member), None),
    }
}

/// The rule of a name, which needs both limits.
fn guard_rule(tolerance: &Object<'_>, member: &Member, name: &str) -> Option<GuardRule> {
    let names = GuardRule::ALL.map(|rule| format!("\"{}\"", rule.name())).join(", ");
    let report = |reason: String| {
        let (key, found) = ("guard_band".to_owned(), name.to_owned());
        tolerance.log.report(&member.value.span, DiagnosticKind::Value { key, found, reason });
    };
    let Some(rule) = GuardRule::named(name) else {
        report(format!("it is a number r, for a guard band of r U, or one of {names}"));
        return None;
    };
    let is_there = |key: &&str| {
        tolerance.get(key).is_some_and(|member| !matches!(member.value.value, Json::Null))
    };
    if let Some(missing) = ["lower", "upper"].iter().find(|key| !is_there(key)) {
        report(format!(
            "the rule is for two limits, and `{missing}` is not there; for one limit write a number r, \
             or `risk`"
        ));
        return None;
    }
    Some(rule)
}

/// The guard band in multiples of U.
fn guard_factor(tolerance: &Object<'_>, member: &Member) -> Option<f64> {
    let found = tolerance.number("guard_band")?;
    if !(found > 0.0 && found.is_finite()) {
        let (key, range) = ("guard_band".into(), "above 0, in multiples of U");
        let diagnostic = DiagnosticKind::OutOfRange { key, found, range };
        tolerance.log.report(&member.value.span, diagnostic);
        return None;
    }
    Some(found)
}

/// Whether the statement of conformity has four levels, which need a guard band.
fn is_non_binary(tolerance: &Object<'_>) -> bool {
    const STATEMENTS: [&str; 2] = ["binary", "non-binary"];
    let Some(member) = tolerance.get("statement") else { return false };
    let Some(found) = tolerance.text("statement") else { return false };
    if !STATEMENTS.contains(&found) {
        let (key, found) = ("statement".into(), found.to_owned());
        let allowed = STATEMENTS.map(str::to_owned).to_vec();
        tolerance.log.report(&member.value.span, DiagnosticKind::NotOneOf { key, found, allowed });
        return false;
    }
    let non_binary = found == STATEMENTS[1];
    if non_binary && tolerance.get("guard_band").is_none() {
        let (key, with) = ("\"statement\": \"non-binary\"", "guard_band");
        tolerance.log.report(&member.key_span, DiagnosticKind::OnlyWith { key, with });
    }
    non_binary
}

/// What was known about the items before measuring.
fn prior(tolerance: &Object<'_>, unit: &Unit, results: &ResultFiles<'_>) -> Option<Distribution> {
    let member = tolerance.get("prior")?;
    let object = Object::new(tolerance.log, "`prior`", &member.value, &member.key_span)?;
    let kind = shapes::kind(&object)?;
    if NO_PRIORS.contains(&kind.name) {
        let allowed = keys::SHAPES.iter().map(|kind| kind.name);
        let diagnostic = DiagnosticKind::NotOneOf {
            key: "distribution".into(),
            found: kind.name.to_owned(),
            allowed: allowed.filter(|name| !NO_PRIORS.contains(name)).map(str::to_owned).collect(),
        };
        let place = object.get("distribution").map_or(object.place(), |m| &m.value.span);
        object.log.report(place, diagnostic);
        return None;
    }
    let mut known = vec!["distribution", "about"];
    known.extend(kind.fields);
    keys::check_names(&object, &known);
    instrument::check(&object, kind, unit);
    Fields::new(object, "prior", unit, Estimate::Own, results).distribution(kind)
}

/// The tolerance limits of an output, in the first row where they follow the conditions.
fn tolerance(
    object: &Object<'_>,
    unit: &Unit,
    ends: &[Option<OfConditions>; 2],
    set: &ConditionSet<'_>,
) -> Option<Tolerance> {
    let first = set.conditions.rows.first().map_or(&[][..], Vec::as_slice);
    // null stands for a limit that is not there
    let limit = |key: &str, conditions: &Option<OfConditions>| match object
        .get(key)
        .map(|m| &m.value.value)
    {
        None | Some(Json::Null) => None,
        Some(_) => match conditions {
            Some(conditions) => Some(conditions.at(first)),
            None => object.value(key, unit, ValueOf::Either),
        },
    };
    let (lower, upper) = (limit("lower", &ends[0]), limit("upper", &ends[1]));
    if ends.iter().any(Option::is_some) {
        let own =
            |limit: Option<f64>, conditions: &Option<OfConditions>, row: &[f64]| match conditions {
                Some(conditions) => Some(conditions.at(row)),
                None => limit,
            };
        for (row, conditions) in set.conditions.rows.iter().enumerate() {
            let [lower, upper] =
                [own(lower, &ends[0], conditions), own(upper, &ends[1], conditions)];
            let name = || format!("tolerance in row {} of the conditions", row + 1);
            for (parameter, limit) in [("lower", lower), ("upper", upper)] {
                if let Some(value) = limit.filter(|limit| !limit.is_finite()) {
                    let error = Invalid::NotFinite { parameter, value };
                    object.report(DiagnosticKind::Distribution { name: name(), error });
                    return None;
                }
            }
            if let (Some(lower), Some(upper)) = (lower, upper)
                && lower >= upper
            {
                let error = Invalid::LimitsReversed { lower, upper };
                object.report(DiagnosticKind::Distribution { name: name(), error });
                return None;
            }
        }
    }
    match (lower, upper) {
        (None, None) => {
            let is_there = |key: &&str| {
                object.get(key).is_some_and(|member| !matches!(member.value.value, Json::Null))
            };
            // what could not be read has been reported, as have other names of the limits
            let limits = ["lower", "upper"];
            let is_other = |member: &Member| other_name(&member.key, &limits).is_some();
            let is_told = object.members().iter().any(is_other);
            if !is_told && !limits.iter().any(is_there) {
                object.report(DiagnosticKind::NoValues { name: "tolerance".into() });
            }
            None
        }
        (Some(lower), Some(upper)) if lower >= upper => {
            let error = Invalid::LimitsReversed { lower, upper };
            object.report(DiagnosticKind::Distribution { name: "tolerance".into(), error });
            None
        }
        _ => Some(Tolerance { lower, upper }),
    }
}
