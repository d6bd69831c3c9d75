//! Notes on formulas: what is right by the rules and seldom meant, inputs that no formula uses, and
//! words that a new file has of them.

use std::collections::{HashMap, HashSet};

use super::model_checks::Quantities;
use super::model_reader::Equation;
use super::scopes::report_formula;
use gumption_engine::fact;
use gumption_engine::model::formula::{
    Factors, Formula, FormulaError, FormulaNote, KelvinKind, LevelReference, Numbers, Scope,
    TableCall, TableData, Typing, Use, ValueSource,
};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::task::Warning;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::is_value;
use gumption_text::{Collector, WIDTHS};
use gumption_units::{Dimension, Exponent, Turn, Unit};

/// Notes on the formulas of a file whose units are checked, and on the units of its outputs. Arguments
/// that can be in two units are reported.
pub(super) fn of_formulas(
    log: &Collector,
    equations: &[Equation<'_>],
    scope: &Scope,
    of: &Quantities,
) -> Vec<Warning> {
    let inputs = of.inputs.quantities.iter().map(|input| &input.quantity);
    let given = units_by_name(inputs.chain(&of.conditions.quantities));
    let results = units_by_name(of.outputs.outputs.iter().map(|output| &output.quantity));
    let mut numbers = KnownNumbers::new(&given, of, Some(scope));
    let mut found = Vec::new();
    // a quantity with a dimension has another error
    let is_share = |name: &str| {
        let dimension = scope.get(name).and_then(|typing| typing.dimension);
        dimension.is_none_or(|dimension| dimension.is_none())
    };
    for (name, member, formula) in equations {
        let Some(formula) = formula else { continue };
        let result = results.get(name.as_str()).copied().filter(|_| of.check_units);
        let known = |source: ValueSource<'_>| numbers.of(source);
        for error in formula.unstated_arguments(known) {
            member.iter().for_each(|member| report_formula(log, member, error.clone()));
        }
        let factors_of = |name: &str| numbers.factors.get(name).copied();
        let of_result = result.map_or(Use::Quantity, Use::Output);
        let (notes, factors) = formula.notes(known, factors_of, of_result);
        let is_length =
            scope.get(name).is_some_and(|typing| typing.dimension == Some(Dimension::LENGTH));
        let computed = formula.numbers(known).or(is_length.then_some(Numbers::Length));
        let computed = computed.filter(|_| of.check_units);
        for note in notes {
            match (member, result.filter(|_| note.is_error && is_share(name))) {
                (Some(member), Some(unit)) => refuse(log, member, formula, note, (name, unit)),
                _ => found.push(Warning::new(name, note.fact)),
            }
        }
        if let Some(computed) = computed {
            numbers.names.insert(name, computed);
        }
        if let Some(factors) = factors.filter(|_| of.check_units) {
            numbers.factors.insert(name, factors);
        }
    }
    found.extend(angles_of_turns(equations, of));
    found.extend(picohenries(of));
    if of.check_units {
        found.extend(celsius_as_kelvin(scope, &of.outputs.outputs));
        found.extend(
            of.outputs.outputs.iter().filter_map(|output| difference_in_degrees(scope, output)),
        );
        found.extend(of.outputs.outputs.iter().filter_map(|output| sum_of_levels(scope, output)));
        found.extend(of.outputs.outputs.iter().filter_map(|output| rate_of_turns(scope, output)));
        let in_nepers = |unit: &&Unit| !unit.level_exponent().is_zero() && unit.factor() != 1.0;
        if given.values().any(in_nepers) {
            found.extend(of.outputs.outputs.iter().filter_map(|output| decibels(scope, output)));
        }
        for (name, _, formula) in equations {
            let Some(formula) = formula else { continue };
            let unit_of = |name: &str| given.get(name).copied();
            let mut notes = formula.periods_as_radians(scope, unit_of);
            notes.extend(formula.torque_by_periods(unit_of));
            notes.extend(formula.level_of_other_kind(scope));
            found.extend(notes.into_iter().map(|note| Warning::new(name, note.fact)));
        }
        let by_name: ByName<'_> = equations
            .iter()
            .filter_map(|(name, _, formula)| Some((name.as_str(), formula.as_ref()?)))
            .collect();
        let counts_turns = given.values().any(|unit| unit.counts_revolutions());
        for output in &of.outputs.outputs {
            let terms = terms(&by_name, &output.quantity.name);
            for (name, formula, note) in converted_terms(&terms, &numbers, &output.quantity) {
                let member = equations.iter().find(|(of, ..)| of == name);
                let is_error = note.is_error && is_share(name);
                match member.and_then(|(_, member, _)| *member).filter(|_| is_error) {
                    Some(member) => {
                        let Quantity { name, unit, .. } = &output.quantity;
                        refuse(log, member, formula, note, (name, unit));
                    }
                    None => found.push(Warning::new(name, note.fact)),
                }
            }
            found.extend(angular_frequency(scope, &terms, &output.quantity.unit));
            if counts_turns {
                let radians = radians_of_turns(scope, output);
                found.extend(radians.or_else(|| displaced(scope, &terms, &output.quantity.unit)));
            }
        }
        drop_repeated(&mut found);
    }
    found
}

/// What the numbers of quantities, tables and calibration functions are in; nothing in a file whose
/// units are not checked.
struct KnownNumbers<'q> {
    names: HashMap<&'q str, Numbers<'q>>,
    /// What equations are products of.
    factors: HashMap<&'q str, Factors>,
    /// Where the tables are.
    scope: Option<&'q Scope>,
    is_checked: bool,
}

impl<'q> KnownNumbers<'q> {
    /// Of quantities that are given in these units.
    fn new(
        given: &HashMap<&'q str, &'q Unit>,
        of: &'q Quantities,
        scope: Option<&'q Scope>,
    ) -> Self {
        let is_checked = of.check_units;
        let mut names = HashMap::new();
        if is_checked {
            names.extend(given.iter().map(|(name, unit)| (*name, Numbers::Given(unit))));
            // formulas of conditions that have no unit are refused where it matters
            if scope.is_some() {
                let unstated = of.inputs.unstated.iter().chain(&of.conditions.unstated);
                names.extend(unstated.map(|name| (name.as_str(), Numbers::Unstated)));
            }
        }
        Self { names, factors: HashMap::new(), scope, is_checked }
    }

    fn of(&self, source: ValueSource<'_>) -> Option<Numbers<'q>> {
        let unstated =
            |is_stated: bool| (self.is_checked && !is_stated).then_some(Numbers::Unstated);
        match source {
            ValueSource::Name(name) => self.names.get(name).copied(),
            ValueSource::CurveX(curve) => unstated(curve.is_stated[0]),
            ValueSource::CurveY(curve) => unstated(curve.is_stated[1]),
            ValueSource::TableArgument(call) => unstated(self.table(call)?.is_stated[0]),
            ValueSource::TableValue(call) => {
                let table = self.table(call)?;
                let given = Numbers::Given(&table.units[1]);
                unstated(table.is_stated[1]).or(self.is_checked.then_some(given))
            }
        }
    }

    fn table(&self, call: &TableCall) -> Option<&'q TableData> {
        self.scope.and_then(|scope| scope.table(call)).flatten()
    }
}

/// Equations by their names.
type ByName<'e> = HashMap<&'e str, &'e Formula>;

/// The equations that a quantity is a sum, a small multiple or a choice of, its own first.
fn terms<'e>(by_name: &ByName<'e>, of: &'e str) -> Vec<(&'e str, &'e Formula)> {
    let mut known = HashSet::new();
    let mut found = Vec::new();
    let mut rest = vec![of];
    while let Some(name) = rest.pop() {
        if let Some(formula) = by_name.get(name).filter(|_| known.insert(name)) {
            found.push((name, *formula));
            rest.extend(formula.terms());
        }
    }
    found
}

/// Equations that convert to the unit of an output which they are terms of.
fn converted_terms<'e>(
    terms: &[(&'e str, &'e Formula)],
    numbers: &KnownNumbers<'_>,
    output: &Quantity,
) -> Vec<(&'e str, &'e Formula, FormulaNote)> {
    let what = fact!("result.named-output", name = &output.name);
    let known = |source: ValueSource<'_>| numbers.of(source);
    let intermediate = terms.iter().filter(|(name, _)| *name != output.name);
    let notes = intermediate.filter_map(|(name, formula)| {
        let factors_of = |name: &str| numbers.factors.get(name).copied();
        let note = formula.converted_to(known, factors_of, &output.unit, &what)?;
        Some((*name, *formula, note))
    });
    notes.collect()
}

/// Reports a share that is converted to the unit of an output twice.
fn refuse(
    log: &Collector,
    member: &Member,
    formula: &Formula,
    note: FormulaNote,
    (output, unit): (&str, &Unit),
) {
    let span = note.span;
    let formula = formula.text().get(span.clone()).unwrap_or_default().to_owned();
    let (output, unit) = (output.to_owned(), unit.to_string());
    report_formula(log, member, FormulaError::ConvertedTwice { formula, output, unit, span });
}

/// A term of an output in Hz that is an angular frequency.
fn angular_frequency(scope: &Scope, terms: &[(&str, &Formula)], unit: &Unit) -> Option<Warning> {
    if unit.turn() != Some(Turn::Periods) {
        return None;
    }
    terms.iter().find_map(|(name, formula)| {
        let note = formula.angular_frequency(scope)?;
        Some(Warning::new(*name, note.fact))
    })
}

/// What an output or a term of it multiplies by revolutions in radians: `Vg*n`, `pi*d*n`.
fn displaced(scope: &Scope, terms: &[(&str, &Formula)], unit: &Unit) -> Option<Warning> {
    // an impedance in N s/m is of an angular frequency
    let has_newton = unit.factors().iter().any(|factor| factor.base.to_string().ends_with('N'));
    if unit.counts_angle() || has_newton {
        return None;
    }
    terms.iter().find_map(|(name, formula)| {
        let note = formula.of_revolutions(scope)?;
        Some(Warning::new(*name, note.fact))
    })
}

/// Leaves one note of a kind about each quantity where several outputs have the same term.
fn drop_repeated(notes: &mut Vec<Warning>) {
    let mut told = HashSet::new();
    notes.retain(|note| {
        let is_of_result = matches!(
            note.code(),
            "result-converted-twice"
                | "quantity-converted-twice"
                | "radians-of-turns"
                | "radians-as-periods"
        );
        !is_of_result || told.insert((note.code(), note.place.clone()))
    });
}

/// Numbers of more than a turn that an angle is taken from: `cos(a)` of 30, which is in radians as it
/// has no unit.
fn angles_of_turns(equations: &[Equation<'_>], of: &Quantities) -> Vec<Warning> {
    let mut first = 0;
    let mut found = HashMap::new();
    for input in &of.inputs.quantities {
        let parts = first..first + input.parts;
        first = parts.end;
        if is_plain(&input.quantity.unit) {
            let estimates = parts.filter_map(|part| Some(of.inputs.known.get(part, 0)?.mean()));
            found.insert(input.quantity.name.as_str(), estimates.sum::<f64>());
        }
    }
    for (place, condition) in of.conditions.quantities.iter().enumerate() {
        let values = of.conditions.rows.iter().filter_map(|row| row.get(place).copied());
        let largest = values.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(largest) = largest.filter(|_| is_plain(&condition.unit)) {
            found.insert(condition.name.as_str(), largest);
        }
    }
    let mut told = HashSet::new();
    let angles =
        equations.iter().flat_map(|(_, _, formula)| formula.iter().flat_map(Formula::angles));
    angles
        .filter_map(|(function, name)| {
            let value = *found.get(name)?;
            if value.abs() <= std::f64::consts::TAU || !told.insert(name) {
                return None;
            }
            Some(Warning::new(name, fact!("angle-of-turns", function, name, angle = value)))
        })
        .collect()
}

/// Whether a unit is that of plain numbers.
fn is_plain(unit: &Unit) -> bool {
    unit.dimension().is_none() && unit.turn().is_none() && unit.factor() == 1.0
}

fn units_by_name<'q>(quantities: impl Iterator<Item = &'q Quantity>) -> HashMap<&'q str, &'q Unit> {
    quantities.map(|quantity| (quantity.name.as_str(), &quantity.unit)).collect()
}

/// Inputs that stand in no equation and are no output.
pub(super) fn unused_inputs(
    root: &Object<'_>,
    equations: &[Equation<'_>],
    outputs: &[Output],
) -> Vec<Warning> {
    let Some(Json::Object(inputs)) = root.get("inputs").map(|member| &member.value.value) else {
        return Vec::new();
    };
    // what an equation with a mistake uses is not known
    if equations.iter().any(|(_, _, formula)| formula.is_none()) {
        return Vec::new();
    }
    let formulas = equations.iter().filter_map(|(_, _, formula)| formula.as_ref());
    let mut used: HashSet<&str> = formulas.flat_map(Formula::names).map(|(name, _)| name).collect();
    used.extend(outputs.iter().map(|output| output.quantity.name.as_str()));
    let estimates = estimates(inputs);
    used.extend(estimates.iter().flat_map(Formula::names).map(|(name, _)| name));
    // what uses a part uses the whole
    let wholes: Vec<&str> = used.iter().filter_map(|name| Some(name.rsplit_once('.')?.0)).collect();
    used.extend(wholes);
    let unused = inputs.iter().filter(|member| !used.contains(member.key.as_str()));
    let names = unused.map(|member| &member.key);
    names.map(|name| Warning::new(name, fact!("unused-input", name))).collect()
}

/// The formulas of inputs' estimates, which may use inputs that are constants.
fn estimates(inputs: &[Member]) -> Vec<Formula> {
    let fields = inputs.iter().filter_map(|input| match &input.value.value {
        Json::Object(fields) => Some(fields),
        _ => None,
    });
    let estimates = fields.flatten().filter(|field| matches!(field.key.as_str(), "mean" | "value"));
    let formula = |field: &Member| match &field.value.value {
        Json::Text(text) => Formula::parse(text).ok(),
        _ => None,
    };
    estimates.filter_map(formula).collect()
}

/// Notes on formulas of conditions: of inputs' estimates and widths, and of tolerance limits.
pub(super) fn of_conditions(root: &Object<'_>, of: &Quantities) -> Vec<Warning> {
    if !of.check_units {
        return Vec::new();
    }
    let inputs = of.inputs.quantities.iter().map(|input| &input.quantity);
    let given = units_by_name(inputs.chain(&of.conditions.quantities));
    let numbers = KnownNumbers::new(&given, of, None);
    let mut found = Vec::new();
    let mut note = |name: &str, text: &str, usage: Use<'_>| {
        let formula = Some(text).filter(|text| !is_value(text));
        let formula = formula.and_then(|text| root.log.formula(text).ok());
        let notes =
            formula.map(|formula| formula.notes(|source| numbers.of(source), |_| None, usage).0);
        let notes = notes.into_iter().flatten();
        found.extend(notes.map(|note| Warning::new(name, note.fact)));
    };
    for input in members(root.get("inputs")) {
        let unit = given.get(input.key.as_str()).copied();
        for (text, key) in condition_formulas(members(Some(input))) {
            note(&input.key, text, use_of(key, unit));
        }
        let parts = members(Some(input)).iter().find(|field| field.key == "components");
        let Some(Json::List(parts)) = parts.map(|parts| &parts.value.value) else { continue };
        for part in parts {
            let Json::Object(fields) = &part.value else { continue };
            for (text, key) in condition_formulas(fields) {
                note(&input.key, text, use_of(key, unit));
            }
        }
    }
    for output in members(root.get("outputs")) {
        let tolerance = members(Some(output)).iter().find(|field| field.key == "tolerance");
        for limit in members(tolerance) {
            if let ("lower" | "upper", Json::Text(text)) = (limit.key.as_str(), &limit.value.value)
            {
                note(&output.key, text, Use::Quantity);
            }
        }
    }
    found
}

/// The texts of the fields of an input or a component that may be formulas of conditions, each with its
/// key.
fn condition_formulas(fields: &[Member]) -> impl Iterator<Item = (&str, &str)> {
    let keys = || ["mean", "value", "values"].into_iter().chain(WIDTHS);
    let fields = fields.iter().filter(move |field| keys().any(|key| key == field.key));
    fields.flat_map(|field| {
        let values = match &field.value.value {
            Json::List(values) => values.iter().map(|value| &value.value).collect(),
            value => vec![value],
        };
        let texts = values.into_iter().filter_map(|value| match value {
            Json::Text(text) => Some(text.as_str()),
            _ => None,
        });
        texts.map(|text| (text, field.key.as_str())).collect::<Vec<_>>()
    })
}

/// What a formula of conditions at a key of an input in that unit is for.
fn use_of<'u>(key: &str, unit: Option<&'u Unit>) -> Use<'u> {
    match unit {
        _ if WIDTHS.contains(&key) => Use::Width,
        Some(unit) => Use::Estimate(unit),
        None => Use::Quantity,
    }
}

/// The members of an object at a key; none of anything else.
fn members(of: Option<&Member>) -> &[Member] {
    match of.map(|member| &member.value.value) {
        Some(Json::Object(members)) => members,
        _ => &[],
    }
}

/// What earlier versions of `gumption new` wrote as the `about` of an input.
const PLACEHOLDER: &str = "where this is known from";

/// Inputs whose `about` still has the words of a new file: certificates print it.
pub(super) fn placeholders(of: &Quantities) -> Vec<Warning> {
    let named = of.inputs.quantities.iter().map(|input| &input.quantity);
    let left = named.filter(|quantity| quantity.about.trim() == PLACEHOLDER);
    let names = left.map(|quantity| &quantity.name);
    let note = |name| Warning::new(name, fact!("placeholder-about", name, about = PLACEHOLDER));
    names.map(note).collect()
}

/// Quantities in `pH`, which is a picohenry and may be meant as the measure of acidity.
fn picohenries(of: &Quantities) -> Option<Warning> {
    let inputs = of.inputs.quantities.iter().map(|input| &input.quantity);
    let mut all = inputs.chain(of.outputs.outputs.iter().map(|output| &output.quantity));
    let name = &all.find(|quantity| quantity.unit.text().trim() == "pH")?.name;
    Some(Warning::new(name, fact!("picohenry", name)))
}

/// The code of [`unused_inputs`].
pub(super) const UNUSED_INPUT: &str = "unused-input";

/// A level that is reported as a plain number, of inputs that are given in nepers.
fn decibels(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let is_level = !scope.get(name)?.level.is_zero();
    let is_told = is_level && is_plain(unit) && unit.level_exponent().is_zero();
    is_told.then(|| Warning::new(name, fact!("level-as-number", name)))
}

/// A result that adds levels above a reference, as 5 dBm and 2 dBm.
fn sum_of_levels(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let typing = scope.get(name)?;
    let adds = typing.zero.is_none() && typing.reference == LevelReference::Added;
    adds.then(|| Warning::new(name, fact!("sum-of-levels", name, unit)))
}

/// A result in revolutions per minute of which nothing tells that it counts angle.
fn rate_of_turns(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let typing = scope.get(name)?;
    let unknown = typing.turn.is_none()
        && !typing.has_turns
        && typing.dimension.is_some_and(|dimension| !dimension.is_none());
    let is_told = unit.counts_revolutions() && unknown && unit.turn().is_some();
    is_told.then(|| Warning::new(name, fact!("rate-of-turns", name)))
}

/// A result that counts angle, in a unit that counts nothing (`1/min`, `1`), of inputs in revolutions.
fn radians_of_turns(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let shown = if unit.text().is_empty() { "1" } else { unit.text() };
    let typing = scope.get(name)?;
    let is_rate =
        typing.dimension.is_some_and(|dimension| dimension.is_of_time() && !dimension.is_none());
    let counts_angle = typing.turn == Some(Turn::Angle) || typing.has_turns && is_rate;
    let counts_nothing = unit.turn() != Some(Turn::Angle) && unit.dimension().is_of_time();
    let fact = if counts_angle && counts_nothing {
        fact!("radians-of-turns", name, unit = shown)
    } else if is_per_turn(typing) && !unit.counts_angle() {
        fact!("radians-of-turns.inverse", name, unit = shown)
    } else {
        return None;
    };
    Some(Warning::new(name, fact))
}

/// Whether a quantity is per angle by an input in revolutions, and no torque, viscosity or damping, which
/// are so by their definitions: `v/n` may be a radius or the feed of a revolution, `P/n` is the torque of
/// the power P, and a rotational viscometer's `T*a/(2*pi*R^3*L*n)` is per rad/s.
fn is_per_turn(typing: Typing) -> bool {
    const BY_RADIANS: [Dimension; 3] = [
        Dimension::of([1, 2, -2, 0, 0, 0, 0]),
        Dimension::of([1, -1, -1, 0, 0, 0, 0]),
        Dimension::of([1, 2, -1, 0, 0, 0, 0]),
    ];
    let angle = typing.angle;
    angle.of_revolutions
        && angle.exponent == Exponent::integer(-1)
        && typing.dimension.is_some_and(|dimension| !BY_RADIANS.contains(&dimension))
}

/// Outputs in K of what a coefficient's unit makes a number of degrees: a temperature or a
/// difference.
fn celsius_as_kelvin(scope: &Scope, outputs: &[Output]) -> Vec<Warning> {
    outputs
        .iter()
        .map(|output| &output.quantity)
        .filter(|output| {
            let counts_degrees = scope.get(&output.name).is_some_and(Typing::counts_degrees);
            counts_degrees && !output.unit.is_celsius()
        })
        .map(|Quantity { name, unit, .. }| {
            Warning::new(name, fact!("celsius-as-kelvin", name, unit))
        })
        .collect()
}

/// An output in degC or degF that is a difference of two temperatures: `t - c` of an indication and its
/// correction, both in degC, is no corrected temperature.
fn difference_in_degrees(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let is_temperature = unit.zero().is_some() && unit.level_exponent().is_zero();
    let typing = scope.get(name).filter(|_| is_temperature)?;
    let is_difference = typing.zero.is_none() && typing.kelvin == KelvinKind::Difference;
    is_difference.then(|| Warning::new(name, fact!("difference-in-degrees", name, unit)))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::read_text;
    use gumption_engine::fact::{Argument, Fact};

    /// Notes of a file, each with what it is about.
    fn notes(text: &str) -> Vec<(&'static str, String, Fact)> {
        let file = read_text("m", text, Path::new(""), &[]).unwrap();
        file.warnings.into_iter().map(|note| (note.code(), note.place, note.fact)).collect()
    }

    /// The text of an argument that is one.
    fn text_of<'f>(fact: &'f Fact, argument: &str) -> Option<&'f str> {
        match fact.argument(argument)? {
            Argument::Text(text) | Argument::Number(text) => Some(text),
            _ => None,
        }
    }

    /// 0.1 rad beside degrees, in an estimate, a width and a limit; not where it says its unit.
    #[test]
    fn formulas_of_conditions_have_notes() {
        let of = |mean: &str, std: &str, upper: &str| {
            notes(&format!(
                r#"{{"conditions": {{"phi_nom": {{"unit": "deg", "values": [10, 20]}}}},
                "inputs": {{"phi": {{"unit": "deg", "distribution": "normal", "mean": "{mean}",
                "std": "{std}"}}}}, "equations": {{"p": "phi"}},
                "outputs": {{"p": {{"unit": "deg", "tolerance": {{"upper": "{upper}"}}}}}}}}"#
            ))
        };
        let found = of("phi_nom + 0.1", "0.001*phi_nom + 0.05", "phi_nom + 2");
        let all: Vec<_> = found.iter().map(|(code, name, _)| (*code, name.as_str())).collect();
        assert_eq!(all, [("bare-number", "phi"), ("bare-number", "phi"), ("bare-number", "p")]);
        assert_eq!(text_of(&found[0].2, "meant"), Some("0.1 [deg]"), "{found:?}");
        assert_eq!(of("phi_nom + 0.1 [deg]", "0.001*phi_nom + 0.05 [deg]", "30 deg"), []);
    }

    /// Readings, limits of a choice and the whole beside a share are numbers too; a hundredth of a
    /// condition is a width.
    #[test]
    fn numbers_in_estimates_and_widths() {
        let codes = |unit: &str, fields: &str| {
            let found = notes(&format!(
                r#"{{"conditions": {{"p": {{"unit": "{unit}", "values": [10, 20]}}}},
                "inputs": {{"x": {{"unit": "{unit}", {fields}}}}}, "equations": {{"y": "x"}},
                "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            ));
            found.into_iter().map(|(code, ..)| code).collect::<Vec<_>>()
        };
        let normal = |mean: &str, std: &str| {
            format!(r#""distribution": "normal", "mean": "{mean}", "std": "{std}""#)
        };
        let readings = r#""distribution": "readings", "values": ["p", "p + 0.1", "p - 0.1 [deg]"]"#;
        assert_eq!(codes("deg", readings), ["bare-number"]);
        for (unit, mean, std, wanted) in [
            ("deg", "p", "max(0.5, 0.01*p)", Some("bare-number")),
            ("deg", "p", "max(0.5 [deg], 0.01*p)", None),
            ("deg", "p", "max(1e-6, 0.01*p)", None),
            ("deg", "min(p, 1.5708)", "0.01*p", None),
            ("%", "p + 1", "0.01*p", Some("bare-number")),
            ("%", "1 - p", "0.01*p", None),
            ("%", "p", "0.01*p + 0.1 [%]", None),
            ("%", "p", "p/100", None),
            ("%", "p/100", "0.01*p", Some("share-converted-twice")),
        ] {
            let found = codes(unit, &normal(mean, std));
            assert_eq!(found, Vec::from_iter(wanted), "{mean}, {std} in {unit}");
        }
    }

    /// The factor that converts from the units of quantities to that of a value, which is converted already;
    /// not one of another size, of a coherent unit, or before a quantity of which no unit is known.
    #[test]
    fn factors_that_convert_units() {
        let of = |inputs: [(&str, &str); 3], equations: &str, unit: &str| {
            let input = |(name, unit): (&str, &str)| {
                format!(
                    r#""{name}": {{"unit": "{unit}", "distribution": "normal", "mean": 3, "std": 0.1}}"#
                )
            };
            let found = notes(&format!(
                r#"{{"inputs": {{{}}}, "equations": {{{equations}}},
                "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#,
                inputs.map(input).join(", ")
            ));
            let found = found.into_iter().filter(|(code, ..)| *code == "result-converted-twice");
            found.map(|(.., fact)| fact).collect::<Vec<_>>()
        };
        let masses = [("m", "mg"), ("V", "mL"), ("P", "1")];
        for (inputs, equations, unit, factor) in [
            (masses, r#""y": "1000*m*P/V""#, "mg/L", "1000"),
            (masses, r#""c": "1000*m*P/V", "y": "2*c""#, "mg/L", "1000"),
            (masses, r#""y": "m*1000*P/V - 2 [mg/L]""#, "mg/L", "1000"),
            ([("V", "mL"), ("t", "s"), ("k", "1")], r#""y": "60*k*V/t""#, "mL/min", "60"),
            ([("P", "W"), ("t", "h"), ("k", "1")], r#""y": "k*P*t/1000""#, "kWh", "0.001"),
            ([("x", "mmHg"), ("a", "1"), ("b", "1")], r#""y": "133.322*x*a*b""#, "Pa", "133.322"),
            ([("x", "m/s"), ("a", "1"), ("b", "1")], r#""y": "3.6*x*a*b""#, "km/h", "3.6"),
            ([("x", "V"), ("a", "1"), ("b", "1")], r#""y": "sqrt(x^2*a*b)*1e6""#, "uV", "1000000"),
        ] {
            let found = of(inputs, equations, unit);
            let factors: Vec<_> = found.iter().map(|fact| text_of(fact, "factor")).collect();
            assert_eq!(factors, [Some(factor)], "{equations}: {found:?}");
        }
        for (inputs, equations, unit) in [
            (masses, r#""y": "m*P/V""#, "mg/L"),
            (masses, r#""y": "10*m*P/V""#, "mg/L"),
            (masses, r#""y": "1000*m*P/V""#, "kg/m^3"),
            ([("P", "W"), ("t", "h"), ("k", "1")], r#""y": "k*P*t/3600""#, "kWh"),
            ([("x", "V"), ("a", "1"), ("b", "1")], r#""y": "1000*x*a*b""#, "V"),
            ([("x", "mV"), ("a", "1"), ("b", "1")], r#""y": "1000*x*a*b""#, "mV"),
            // a coefficient of a sum whose terms are in different units
            ([("x", "mm"), ("a", "m"), ("b", "1")], r#""y": "b*(x + 1000*a)""#, "mm"),
        ] {
            assert_eq!(of(inputs, equations, unit), [], "{equations}");
        }
    }

    /// The codes of a model's notes. Inputs and equations are written `m: g, V: mL` and `n = c*V; m = n*M`, of
    /// which the last equation is the output.
    fn codes_of(inputs: &str, equations: &str, unit: &str) -> Vec<&'static str> {
        let input = |text: &str| {
            let (name, unit) = text.split_once(": ").unwrap();
            format!(
                r#""{name}": {{"unit": "{unit}", "distribution": "normal", "mean": 20, "std": 0.1}}"#
            )
        };
        let equation = |text: &str| {
            let (name, formula) = text.split_once(" = ").unwrap();
            format!(r#""{name}": "{formula}""#)
        };
        let inputs: Vec<_> = inputs.split(", ").map(input).collect();
        let last = equations.rsplit("; ").next().unwrap();
        let output = last.split_once(" = ").unwrap().0;
        let equations: Vec<_> = equations.split("; ").map(equation).collect();
        let found = notes(&format!(
            r#"{{"inputs": {{{}}}, "equations": {{{}}}, "outputs": {{"{output}": {{"unit": "{unit}"}}}}}}"#,
            inputs.join(", "),
            equations.join(", ")
        ));
        found.into_iter().map(|(code, ..)| code).collect()
    }

    /// A conversion by hand, and the same without it: by a factor in one equation and units in another, beside
    /// a coefficient, of mass fractions, beside a share, in powers and roots.
    #[test]
    fn products_that_convert_units() {
        const RESULT: &str = "result-converted-twice";
        const QUANTITY: &str = "quantity-converted-twice";
        const SHARE: &str = "share-converted-twice";
        const RATE: &str = "rate-converted-twice";
        let shaft = "n: rpm, T: N*m";
        let solution = "m: g, P: %, M: g/mol, V: mL";
        let counts = "n: 1, t: min, eff: %";
        for (inputs, wrong, right, unit, code) in [
            ("c: mol/L, V: mL, M: g/mol", "n = c*V/1000; m = n*M", "n = c*V; m = n*M", "g", RESULT),
            ("d: mm, F: kN", "A = pi*d^2/4; s = 1000*F/A", "A = pi*d^2/4; s = F/A", "MPa", RESULT),
            (
                "d: mm, h: mm, m: g",
                "V = pi*d^2/4*h/1000; rho = m/V",
                "V = pi*d^2/4*h; rho = m/V",
                "g/cm^3",
                RESULT,
            ),
            ("v: km/h, m: g", "vs = v/3.6; E = m/1000*vs^2/2", "vs = v; E = m*vs^2/2", "J", RESULT),
            (
                "m: g, l: cm, g: m/s^2",
                "F = m/1000*g; M = F*l/100",
                "F = m*g; M = F*l",
                "N*m",
                RESULT,
            ),
            (
                "L: mm, a: ppm/K, t: degC",
                "y = L*(1 + a*1e-6*(t - 20 [degC]))",
                "y = L*(1 + a*(t - 20 [degC]))",
                "mm",
                QUANTITY,
            ),
            (
                "L: mm, a: um/(m*K), t: degC",
                "y = L*(1 + a*1e-6*(t - 20 [degC]))",
                "y = L*(1 + a*(t - 20 [degC]))",
                "mm",
                QUANTITY,
            ),
            (
                "R: ohm, tc: ppm/K, t: degC",
                "y = R*(1+tc*(t-20 [degC])/1e6)",
                "y = R*(1+tc*(t-20 [degC]))",
                "ohm",
                QUANTITY,
            ),
            (
                "R: ohm, dr: ppm/year, t: year",
                "y = R*(1+dr*t*1e-6)",
                "y = R*(1+dr*t)",
                "ohm",
                QUANTITY,
            ),
            ("R: ohm, dr: %/K, t: K", "y = R*(1+dr*t/100)", "y = R*(1+dr*t)", "ohm", QUANTITY),
            (
                "R: ohm, f: kHz, L: H",
                "y = sqrt(R^2 + (2*pi*f*1000*L)^2)",
                "y = sqrt(R^2 + (2*pi*f*L)^2)",
                "ohm",
                QUANTITY,
            ),
            ("a: mg, b: g", "y = a/b*1000", "y = a/b", "mg/kg", RESULT),
            ("a: mg, b: g", "y = a/b*1000", "y = a/b", "ppm", RESULT),
            ("a: mg, b: g", "y = a/b/10", "y = a/b", "%", RESULT),
            ("V: mL, c: mol/L, M: g/mol, m: g", "y = V*c*M/(10*m)", "y = V*c*M/m", "%", RESULT),
            ("c: ug/L, V: mL, m: g", "y = c*V/(m*1000)", "y = c*V/m", "mg/kg", RESULT),
            ("c: ug/L, V: mL, m: g", "y = c*V/1000/m", "y = c*V/m", "ug/g", RESULT),
            ("c: mg/L, V: mL, m: g", "y = c*V/m/10000", "y = c*V/m", "%", RESULT),
            ("x: mm, L: m", "y = x/L*1000", "y = x/L", "um/m", RESULT),
            (solution, "y = 1000*m*P/(M*V)", "y = m*P/(M*V)", "mol/L", RESULT),
            (solution, "y = m*P/(M*V/1000)", "y = m*P/(M*V)", "mol/L", RESULT),
            (solution, "y = m*P/100/(M*V)*1000", "y = m*P/(M*V)", "mol/L", RESULT),
            (counts, "y = n/(t*60*eff)", "y = n/(t*eff)", "Bq", RESULT),
            (counts, "y = n/(60*t)/(eff/100)", "y = n/t/eff", "Bq", RESULT),
            (counts, "y = n/(60*t)/eff", "y = n/t/eff", "Bq", RESULT),
            ("I: mA, R: ohm", "y = (I/1000)^2*R", "y = I^2*R", "W", RESULT),
            (
                "h: mm",
                "y = sqrt(2*9.81 [m/s^2]*h/1000)",
                "y = sqrt(2*9.81 [m/s^2]*h)",
                "m/s",
                RESULT,
            ),
            ("f: kHz, C: nF", "y = 1/(2*pi*f*1000*C*1e-9)", "y = 1/(2*pi*f*C)", "ohm", RESULT),
            (
                "L: mH, C: nF",
                "y = 1/(2*pi*sqrt(L*1e-3*C*1e-9))",
                "y = 1/(2*pi*sqrt(L*C))",
                "Hz",
                RESULT,
            ),
            (
                "k: N/mm, m: g",
                "y = sqrt(1000*k/(m/1000))/(2*pi)",
                "y = sqrt(k/m)/(2*pi)",
                "Hz",
                RESULT,
            ),
            (
                "p: hPa, V: L, t: degC",
                "y = p*100*V/1000/(8.314462618 [J/(mol K)]*kelvin(t))",
                "y = p*V/(8.314462618 [J/(mol K)]*kelvin(t))",
                "mol",
                RESULT,
            ),
            (
                "a: mm, b: mm",
                "y = sqrt((a/1000)^2 + (b/1000)^2)",
                "y = sqrt(a^2 + b^2)",
                "m",
                RESULT,
            ),
            ("a: mm, b: mm, t: s", "y = (a/1000 - b/1000)/t", "y = (a - b)/t", "m/s", RESULT),
            ("f: Hz, t: ms", "y = sin(2*pi*f*t/1000)", "y = sin(2*pi*f*t)", "1", QUANTITY),
            ("d: mm, l: mm", "y = pi*d^2*l/4000", "y = pi*d^2*l/4", "mL", RESULT),
            ("v: m/s, t: us", "y = v*t/2000", "y = v*t/2", "mm", RESULT),
            ("Q: L/min, A: mm^2", "y = Q/60000/(A*1e-6)", "y = Q/A", "m/s", RESULT),
            ("n: 1/min, T: N*m", "y = T*n/9550", "y = 2*pi*T*n", "kW", RESULT),
            (shaft, "y = 2*pi*n*T/60/1000", "y = n*T", "kW", RESULT),
            (shaft, "y = n/60*T", "y = n*T", "W", RESULT),
            (shaft, "y = 2*pi*n/60*T", "y = n*T", "W", RATE),
            ("n: rpm, R: m", "y = R*(2*pi*n/60)^2", "y = R*n^2", "m/s^2", RATE),
            ("n: rpm, R: m", "y = R*(n/60)^2", "y = R*n^2", "m/s^2", RESULT),
            ("T: %", "y = 2 - log10(T)", "y = -log10(T)", "1", SHARE),
            ("T: %", "y = -log10(T) + 2", "y = 2 + log10(T)", "1", SHARE),
        ] {
            assert_eq!(codes_of(inputs, wrong, unit), [code], "{wrong} in {unit}");
            assert_eq!(codes_of(inputs, right, unit), Vec::<&str>::new(), "{right} in {unit}");
        }
        // shares of a quantity, divisors of it, numbers of other units and ratios as numbers
        for (inputs, right, unit) in [
            ("L: mm, a: 1/K, t: degC", "y = L*(1 + a*1e-6*(t - 20 [degC]))", "mm"),
            ("a: mg, b: g", "y = a/b*1000", "1"),
            ("a: hPa, b: hPa", "y = 100*a/b", "1"),
            ("U: mV, k: 1", "y = U + 0.001*U*k", "mV"),
            ("U: mV, R: ohm", "y = 0.001*U/R", "mA"),
            ("x: mm", "y = x/1000", "um"),
            ("x: mm", "d = 0.001*x; y = x + d", "mm"),
            ("x: mm", "y = x/100", "mm"),
            ("n: 1, t: s", "y = n/(60*t)", "Bq"),
            ("d: mm, n: rpm", "y = pi*d*n/[rev]", "m/s"),
            ("c: mol/L, V: mL, M: g/mol", "n = c*V*1000; m = n*M/1000", "g"),
            ("T: 1", "y = 2 - log10(T)", "1"),
            ("x: 1", "y = 100*x + 0.02*x^2", "%"),
            ("a: mV, b: mV", "y = a + 0.001*b", "mV"),
        ] {
            assert_eq!(codes_of(inputs, right, unit), Vec::<&str>::new(), "{right} in {unit}");
        }
    }

    /// The whole of `2*pi*n/60` is quoted, as what is left without a part of it would be wrong.
    #[test]
    fn conversions_are_quoted_as_a_whole() {
        let of = |equation: &str| {
            let text = format!(
                r#"{{"inputs": {{"n": {{"unit": "rpm", "distribution": "normal", "mean": 9, "std": 1}},
                "T": {{"unit": "N*m", "distribution": "normal", "mean": 9, "std": 1}}}},
                "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{"unit": "W"}}}}}}"#
            );
            let found = notes(&text);
            assert_eq!(found.len(), 1, "{equation}: {found:?}");
            found[0].2.clone()
        };
        for (equation, quoted) in
            [("2*pi*n/60*T", "2*pi*n/60"), ("2*pi*n*T/60", "2*pi*n*T/60"), ("T*2*pi*n", "T*2*pi*n")]
        {
            assert_eq!(of(equation), fact!("rate-converted-twice", formula = quoted, unit = "rpm"));
        }
        let found = of("n/60*T");
        assert_eq!(text_of(&found, "factor"), Some("1/60"));
        let to = fact!("converted-to.coherent-unit", unit = "W");
        assert_eq!(found.argument("to"), Some(&to.into()));
    }

    /// A choice of plain numbers is one beside a share.
    #[test]
    fn choices_of_numbers_beside_shares() {
        for (equation, code) in [
            ("y = x + if(f > 100 [Hz], 0.1, 0.2)", Some("bare-number")),
            ("y = if(f > 100 [Hz], if(f > 200 [Hz], 5, 8), x)", Some("bare-number")),
            ("y = x + if(f > 100 [Hz], 0.1 [%], 0.2 [%])", None),
            ("y = x*if(f > 100 [Hz], 0.1, 0.2)", None),
        ] {
            assert_eq!(codes_of("x: %, f: Hz", equation, "%"), Vec::from_iter(code), "{equation}");
        }
    }

    /// Angular frequencies in Hz, torques times 1/min, levels with another factor; not their like with 2 pi,
    /// means of frequencies, frequencies of strings, energies times rates.
    #[test]
    fn radians_and_levels_that_no_unit_shows() {
        let codes = |inputs: [(&str, &str); 3], equations: &str, unit: &str| {
            let input = |(name, unit): (&str, &str)| {
                format!(
                    r#""{name}": {{"unit": "{unit}", "distribution": "normal", "mean": 3, "std": 0.1}}"#
                )
            };
            let found = notes(&format!(
                r#"{{"inputs": {{{}}}, "equations": {{{equations}}},
                "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#,
                inputs.map(input).join(", ")
            ));
            let codes = found.into_iter().map(|(code, ..)| code);
            codes.filter(|code| *code != "unused-input").collect::<Vec<_>>()
        };
        let spring = [("k", "N/m"), ("m", "kg"), ("z", "1")];
        let circuit = [("R", "kohm"), ("L", "mH"), ("C", "nF")];
        let string = [("F", "N"), ("q", "g/m"), ("L", "m")];
        let rates = [("f1", "Hz"), ("f2", "kHz"), ("t", "s")];
        let shaft = [("M", "N*m"), ("n", "1/min"), ("e", "%")];
        let pulses = [("E", "mJ"), ("f", "Hz"), ("e", "%")];
        let signals = [("a", "V"), ("b", "mV"), ("R", "ohm")];
        let powers = [("a", "W"), ("b", "mW"), ("R", "ohm")];
        let angular = ["radians-as-periods"].as_slice();
        let torque = ["periods-as-radians"].as_slice();
        let level = ["level-of-other-kind"].as_slice();
        for (inputs, equations, unit, wanted) in [
            (spring, r#""y": "sqrt(k/m)""#, "Hz", angular),
            (spring, r#""w": "sqrt(k/m)*sqrt(1 - (z/9)^2)", "y": "w""#, "kHz", angular),
            (spring, r#""w": "(k/m)^0.5", "y": "w/(2*pi)""#, "Hz", &[]),
            (spring, r#""y": "sqrt(k/m)/6.2832""#, "Hz", &[]),
            (spring, r#""y": "sqrt(k/m)/z""#, "Hz", &[]),
            (spring, r#""y": "sqrt(k/m)""#, "rad/s", &[]),
            (circuit, r#""y": "1/sqrt(L*C)""#, "kHz", angular),
            (circuit, r#""y": "1/(R*C)""#, "Hz", angular),
            (circuit, r#""y": "R/L""#, "Hz", angular),
            (circuit, r#""y": "1/(2*pi*R*C)""#, "Hz", &[]),
            (circuit, r#""y": "1.44/(R*C)""#, "Hz", &[]),
            (string, r#""y": "sqrt(F/q)/(2*L)""#, "Hz", &[]),
            (rates, r#""y": "sqrt(f1*f2)""#, "Hz", &[]),
            (rates, r#""y": "sqrt(2)/t""#, "Hz", &[]),
            (shaft, r#""y": "M*n""#, "W", torque),
            (shaft, r#""y": "e*M*n + 2 [W]""#, "W", torque),
            (shaft, r#""y": "2*pi*M*n""#, "W", &[]),
            ([("M", "N*m"), ("w", "1/s"), ("e", "%")], r#""y": "M*w""#, "W", &[]),
            (pulses, r#""y": "e*E*f""#, "W", &[]),
            (signals, r#""y": "10*log10(a/b)""#, "dB", level),
            (signals, r#""y": "-log10(a/b)*10""#, "dB", level),
            (signals, r#""y": "20*log10(a/b)""#, "dB", &[]),
            (signals, r#""y": "10*log10(a/b)*2""#, "dB", &[]),
            (signals, r#""y": "10*log10(a^2/R/1 [mW])""#, "dBm", &[]),
            (signals, r#""y": "10*log10(a*a/b^2)""#, "dB", &[]),
            (powers, r#""y": "20*log10(a/b)""#, "dB", level),
            (powers, r#""y": "10*log10(a/b)""#, "dB", &[]),
            (powers, r#""y": "20*log10(sqrt(a/b))""#, "dB", &[]),
        ] {
            assert_eq!(codes(inputs, equations, unit), wanted, "{equations} in {unit}");
        }
    }

    /// An estimate in mV of a condition in V.
    #[test]
    fn estimates_that_convert() {
        let codes = |mean: &str| {
            let found = notes(&format!(
                r#"{{"conditions": {{"U": {{"unit": "V", "values": [1, 2]}}}},
                "inputs": {{"a": {{"unit": "mV", "distribution": "normal", "mean": "{mean}", "std": 0.1}}}},
                "equations": {{"y": "a"}}, "outputs": {{"y": {{"unit": "mV"}}}}}}"#
            ));
            found.into_iter().map(|(code, ..)| code).collect::<Vec<_>>()
        };
        assert_eq!(codes("U*1000"), ["result-converted-twice"]);
        assert_eq!(codes("0.9*U"), Vec::<&str>::new());
    }

    /// 25 degC less a correction of 0.1 degC is 24.9 K, and not 24.9 degC.
    #[test]
    fn differences_that_are_reported_in_degrees() {
        let codes = |correction: &str, equation: &str, unit: &str| {
            let found = notes(&format!(
                r#"{{"inputs": {{"t": {{"unit": "degC", "distribution": "normal", "mean": 25, "std": 0.1}},
                "c": {{"unit": "{correction}", "distribution": "normal", "mean": 0.1, "std": 0.1}}}},
                "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            ));
            found.into_iter().map(|(code, ..)| code).collect::<Vec<_>>()
        };
        assert_eq!(codes("degC", "t - c", "degC"), ["difference-in-degrees"]);
        assert_eq!(codes("degC", "t - c", "degF"), ["difference-in-degrees"]);
        assert_eq!(codes("degC", "t - c", "K"), Vec::<&str>::new());
        assert_eq!(codes("K", "t - c", "degC"), Vec::<&str>::new());
        assert_eq!(codes("K", "t - c", "degF"), Vec::<&str>::new());
    }

    /// 1 %RH beside a share of the humidity, 2 beside a ratio in mV/V.
    #[test]
    fn numbers_beside_shares_and_ratios() {
        let width = |unit: &str, width: &str| {
            let found = notes(&format!(
                r#"{{"conditions": {{"h": {{"unit": "{unit}", "values": [50]}}}},
                "inputs": {{"a": {{"unit": "{unit}", "distribution": "rectangular", "mean": "h",
                "half_width": "{width}"}}}}, "equations": {{"y": "a"}},
                "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            ));
            found.into_iter().map(|(code, ..)| code).collect::<Vec<_>>()
        };
        for (unit, of, expected) in [
            ("%RH", "1 + 0.02*h", "bare-number"),
            ("%RH", "sqrt(1 + h^2)", "bare-number"),
            ("%", "max(1, 0.02*h)", "bare-number"),
            ("%", "max(0.5, 0.02*h)", "bare-number"),
            ("ppm", "1 + 0.02*h", "bare-number"),
            ("deg", "1 + 0.02*h", "bare-number"),
        ] {
            assert_eq!(width(unit, of), [expected], "{of} in {unit}");
        }
        for of in ["1 [%] + 0.02*h", "0.02*h", "h/100", "max(0.01, 0.02*h)"] {
            assert_eq!(width("%", of), Vec::<&str>::new(), "{of}");
        }
        let output = |unit: &str, equation: &str| {
            let found = notes(&format!(
                r#"{{"inputs": {{"a": {{"unit": "{unit}", "distribution": "normal", "mean": 2, "std": 0.1}}}},
                "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            ));
            found.into_iter().map(|(code, ..)| code).collect::<Vec<_>>()
        };
        for (unit, equation) in [
            ("mV/V", "a + 2"),
            ("um/m", "a - 5"),
            ("g/kg", "a + 2"),
            ("mV/V", "max(a, 2)"),
            ("%", "max(a, 0.5)"),
        ] {
            assert_eq!(output(unit, equation), ["bare-number"], "{equation} in {unit}");
        }
        for (unit, equation) in [
            ("g/kg", "a/(a + 0.622)"),
            ("mV/V", "1 + a"),
            ("mV/V", "a + 2 [mV/V]"),
            ("um/m", "max(a, 0)"),
            ("%", "min(a, 1)"),
        ] {
            assert_eq!(output(unit, equation), Vec::<&str>::new(), "{equation} in {unit}");
        }
    }

    /// Inputs, columns and calibration functions without a unit beside a quantity in degrees or per cent, or
    /// reported in them; not what says that it is plain, is converted, or is a factor.
    #[test]
    fn numbers_without_a_unit() {
        let folder = tempfile::tempdir().unwrap();
        let table = |heading: &str| format!("{heading}\n0,0.1\n2,0.3\n");
        std::fs::write(folder.path().join("t.csv"), table("t,c")).unwrap();
        std::fs::write(folder.path().join("u.csv"), table("t,c [deg]")).unwrap();
        let of = |equation: &str, unit: &str| {
            let text = format!(
                r#"{{"fits": {{"f": {{"x": {{"values": [0, 1, 2]}}, "y": {{"values": [0, 1, 2.1]}}}},
                "g": {{"x": {{"values": [0, 1, 2]}}, "y": {{"unit": "deg", "values": [0, 1, 2.1]}}}}}},
                "inputs": {{"a": {{"unit": "deg", "distribution": "normal", "mean": 3, "std": 0.1}},
                "p": {{"unit": "%", "distribution": "normal", "mean": 3, "std": 0.1}},
                "c": {{"distribution": "normal", "mean": 0.5, "std": 0.1}},
                "d": {{"distribution": "normal", "mean": 0.4, "std": 0.1}},
                "e": {{"unit": "1", "distribution": "normal", "mean": 0.5, "std": 0.1}}}},
                "equations": {{"b": "2*c", "y": "{equation}"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            );
            let file = read_text("m", &text, folder.path(), &[]).unwrap();
            let notes = file.warnings.into_iter().filter(|note| note.code() == "unit-left-out");
            notes.map(|note| note.fact).collect::<Vec<_>>()
        };
        for (equation, unit, said) in [
            ("a + c", "deg", [("formula", "c")].as_slice()),
            ("a - 2*c/3", "deg", &[("one", "57.2957795131"), ("unit", "deg"), ("beside", "a")]),
            ("a + b", "deg", &[("formula", "b")]),
            ("p + (c - d)", "%", &[("one", "100"), ("unit", "%"), ("beside", "p"), ("plain", "1")]),
            ("max(p, c)", "%", &[("formula", "c")]),
            ("if(a > c, 1, 2)", "1", &[("formula", "c")]),
            ("c", "deg", &[("unit", "deg"), ("plain", "rad")]),
            ("c - d", "ppm", &[("formula", "c - d")]),
            ("a + f(c)", "deg", &[("formula", "f(c)")]),
            ("a + inverse(g, a)", "deg", &[("formula", "inverse(g, a)")]),
            ("a + table(c, 't.csv')", "deg", &[("formula", "table(c, 't.csv')")]),
        ] {
            let found = of(equation, unit);
            let is_output = equation.starts_with('c');
            let key = if is_output { "unit-left-out.output" } else { "unit-left-out" };
            assert!(found.len() == 1 && found[0].key == key, "{equation}: {found:?}");
            for (argument, text) in said {
                assert_eq!(text_of(&found[0], argument), Some(*text), "{equation}: {found:?}");
            }
        }
        for (equation, unit) in [
            ("a + e", "deg"),
            ("e", "%"),
            ("a*c", "deg"),
            ("p*c + a*d", "%"),
            ("c/d", "%"),
            ("c - d", "1"),
            ("a + c*pi/180", "deg"),
            ("p + c/100", "%"),
            ("p + 1e-6*c", "%"),
            ("a + g(c)", "deg"),
            ("a + table(c, 'u.csv')", "deg"),
            ("1 - c", "%"),
        ] {
            assert_eq!(of(equation, unit), [], "{equation}");
        }
    }

    /// An angle or a share that is looked up where no unit is said can be one of two numbers.
    #[test]
    fn arguments_without_a_unit_are_refused_with_both_readings() {
        let folder = tempfile::tempdir().unwrap();
        let rows = "0,0\n90,1\n";
        for (name, heading) in
            [("n", "t,c"), ("d", "t [deg],c"), ("r", "t [rad],c"), ("o", "t [1],c")]
        {
            std::fs::write(folder.path().join(format!("{name}.csv")), format!("{heading}\n{rows}"))
                .unwrap();
        }
        let of = |equation: &str, keys: &str| {
            let text = format!(
                r#"{{{keys}"fits": {{"f": {{"x": {{"values": [0, 1, 9]}}, "y": {{"values": [0, 1, 9.1]}}}},
                "g": {{"x": {{"unit": "deg", "values": [0, 1, 9]}},
                "y": {{"unit": "%", "values": [0, 1, 9.1]}}}}}},
                "inputs": {{"a": {{"unit": "deg", "distribution": "normal", "mean": 3, "std": 0.1}},
                "p": {{"unit": "%", "distribution": "normal", "mean": 3, "std": 0.1}},
                "c": {{"distribution": "normal", "mean": 0.5, "std": 0.1}}}},
                "equations": {{"h": "a/2", "y": "{equation}"}}, "outputs": {{"y": {{"unit": "1"}}}}}}"#
            );
            let read = read_text("m", &text, folder.path(), &[]);
            read.map(|_| ()).map_err(|mistakes| mistakes.to_string())
        };
        for (equation, said) in [
            ("table(a, 'n.csv')", "the first column of `n.csv` has no unit"),
            ("table(a, 'n.csv', 't', 'c')", "`t [deg]` or `t [rad]`"),
            ("table(h, 'n.csv', 't', 'c')", "`h` is in deg, but `t` of `n.csv` has no unit"),
            ("table(atan(c), 'n.csv')", "`atan(c)` is in rad"),
            ("f(a)", "x of `f` has no unit: its numbers can be in `deg`, or in `rad`"),
            (
                "f(p)",
                "in `%`, or plain ones; state it there, `\"unit\": \"%\"` or `\"unit\": \"1\"`",
            ),
            ("inverse(f, p)", "y of `f` has no unit"),
        ] {
            let found = of(equation, "").unwrap_err();
            assert!(found.contains(said), "{equation}: {found}");
            // the numbers that are declared are taken
            of(equation, r#""check_units": false, "format": 2, "#).unwrap();
        }
        for equation in [
            "table(a, 'd.csv')",
            "table(a, 'r.csv')",
            "table(p, 'o.csv')",
            "table(a/1 [deg], 'n.csv')",
            "table(c, 'n.csv')",
            "f(c)",
            "g(a)",
            "inverse(g, p)",
        ] {
            of(equation, "").unwrap();
        }
    }

    /// A phase is in radians unless it says its unit.
    #[test]
    fn phases_of_more_than_a_turn() {
        let of = |phase: &str| {
            notes(&format!(
                r#"{{"inputs": {{"g": {{"complex": {{"modulus": "0.1(0.01)",
                "phase": {{"distribution": "normal", {phase}, "std": 0.5}}}}}}}},
                "equations": {{"y": "g"}}, "outputs": {{"y": {{"complex": "polar"}}}}}}"#
            ))
        };
        let codes = |phase: &str| of(phase).into_iter().map(|(code, ..)| code).collect::<Vec<_>>();
        assert_eq!(codes("\"mean\": 35"), ["angle-of-turns"]);
        assert!(codes("\"mean\": 1.5").is_empty());
        assert!(codes("\"unit\": \"deg\", \"mean\": 35").is_empty());
    }
}
