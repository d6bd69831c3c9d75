//! Notes on formulas: what is right by the rules and seldom meant, inputs that no formula uses, and
//! words that a new file has of them.

use std::collections::{HashMap, HashSet};

use super::json::{Json, Member};
use super::model_checks::Quantities;
use super::model_reader::Equation;
use super::object::Object;
use super::shapes;
use super::value_text::is_value;
use gumption_engine::model::formula::{Formula, LevelReference, Numbers, Scope, Typing, Use};
use gumption_engine::model::{Output, Quantity};
use gumption_engine::number::Shortest;
use gumption_engine::task::Warning;
use gumption_units::{Dimension, Exponent, Turn, Unit};

/// Notes on the formulas of a file whose units are checked, and on the units of its outputs.
pub(super) fn of_formulas(
    equations: &[Equation<'_>],
    scope: &Scope,
    of: &Quantities,
) -> Vec<Warning> {
    let inputs = of.inputs.quantities.iter().map(|input| &input.quantity);
    let given = units_by_name(inputs.chain(&of.conditions.quantities));
    let results = units_by_name(of.outputs.outputs.iter().map(|output| &output.quantity));
    let mut numbers = if of.check_units { numbers_of(&given) } else { HashMap::new() };
    let mut found = Vec::new();
    for (name, _, formula) in equations {
        let Some(formula) = formula else { continue };
        let result = results.get(name.as_str()).copied().filter(|_| of.check_units);
        let known = |name: &str| numbers.get(name).copied();
        let notes = formula.notes(known, result.map_or(Use::Quantity, Use::Output));
        let is_length = scope.get(name).is_some_and(|of| of.dimension == Some(Dimension::LENGTH));
        let computed = formula.numbers(known).or(is_length.then_some(Numbers::Length));
        let computed = computed.filter(|_| of.check_units);
        found.extend(notes.into_iter().map(|note| Warning::new(note.code, name, note.text)));
        if let Some(computed) = computed {
            numbers.insert(name, computed);
        }
    }
    found.extend(angles_of_turns(equations, of));
    found.extend(picohenries(of));
    if of.check_units {
        found.extend(celsius_as_kelvin(scope, &of.outputs.outputs));
        found.extend(of.outputs.outputs.iter().filter_map(|output| sum_of_levels(scope, output)));
        found.extend(of.outputs.outputs.iter().filter_map(|output| rate_of_turns(scope, output)));
        let in_nepers = |unit: &&Unit| !unit.level_exponent().is_zero() && unit.factor() != 1.0;
        if given.values().any(in_nepers) {
            found.extend(of.outputs.outputs.iter().filter_map(|output| decibels(scope, output)));
        }
        for (name, _, formula) in equations {
            let notes = formula.iter();
            let notes = notes.flat_map(|formula| {
                formula.periods_as_radians(scope, |name| given.get(name).copied())
            });
            found.extend(notes.map(|note| Warning::new(note.code, name, note.text)));
        }
        let by_name: ByName<'_> = equations
            .iter()
            .filter_map(|(name, _, formula)| Some((name.as_str(), formula.as_ref()?)))
            .collect();
        let counts_turns = given.values().any(|unit| unit.counts_revolutions());
        for output in &of.outputs.outputs {
            let terms = terms(&by_name, &output.quantity.name);
            found.extend(converted_terms(&terms, &numbers, &output.quantity));
            if counts_turns {
                let radians = radians_of_turns(scope, output);
                found.extend(radians.or_else(|| displaced(scope, &terms, &output.quantity.unit)));
            }
        }
        drop_repeated(&mut found);
    }
    found
}

/// What the numbers of names that are given in these units are in.
fn numbers_of<'q>(given: &HashMap<&'q str, &'q Unit>) -> HashMap<&'q str, Numbers<'q>> {
    given.iter().map(|(name, unit)| (*name, Numbers::Given(unit))).collect()
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
fn converted_terms(
    terms: &[(&str, &Formula)],
    numbers: &HashMap<&str, Numbers<'_>>,
    output: &Quantity,
) -> Vec<Warning> {
    let what = format!("the output `{}`", output.name);
    let known = |name: &str| numbers.get(name).copied();
    let intermediate = terms.iter().filter(|(name, _)| *name != output.name);
    let notes = intermediate.filter_map(|(name, formula)| {
        let note = formula.converted_to(known, &output.unit, &what)?;
        Some(Warning::new(note.code, *name, note.text))
    });
    notes.collect()
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
        Some(Warning::new(note.code, *name, note.text))
    })
}

/// Leaves one note of a kind about each quantity where several outputs have the same term.
fn drop_repeated(notes: &mut Vec<Warning>) {
    let mut told = HashSet::new();
    notes.retain(|note| {
        let is_of_result = matches!(note.code, "result-converted-twice" | "radians-of-turns");
        !is_of_result || told.insert((note.code, note.place.clone()))
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
            let shown = Shortest(value);
            let text = format!(
                "`{function}` takes `{name}` in radians, as it has no unit of angle, and {shown} rad are \
                 more than a turn; one in degrees says `\"unit\": \"deg\"`"
            );
            Some(Warning::new("angle-of-turns", name, text))
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
    unused
        .map(|member| {
            let text = format!(
                "no equation uses the input `{}`: it contributes nothing to any uncertainty",
                member.key
            );
            Warning::new(UNUSED_INPUT, &member.key, text)
        })
        .collect()
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
    let numbers = numbers_of(&given);
    let mut found = Vec::new();
    let mut note = |name: &str, text: &str, of: Use<'_>| {
        let formula = Some(text).filter(|text| !is_value(text));
        let formula = formula.and_then(|text| root.log.formula(text).ok());
        let notes = formula.map(|formula| formula.notes(|name| numbers.get(name).copied(), of));
        let notes = notes.into_iter().flatten();
        found.extend(notes.map(|note| Warning::new(note.code, name, note.text)));
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
    let keys = || ["mean", "value", "values"].into_iter().chain(shapes::WIDTHS);
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
        _ if shapes::WIDTHS.contains(&key) => Use::Width,
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
    left.map(|quantity| {
        let text = format!(
            "the `about` of `{}` still says \"{PLACEHOLDER}\", as a new file does, and certificates print \
             it: write from where it is known, or take the key out",
            quantity.name
        );
        Warning::new("placeholder-about", &quantity.name, text)
    })
    .collect()
}

/// Quantities in `pH`, which is a picohenry and may be meant as the measure of acidity.
fn picohenries(of: &Quantities) -> Option<Warning> {
    let inputs = of.inputs.quantities.iter().map(|input| &input.quantity);
    let mut all = inputs.chain(of.outputs.outputs.iter().map(|output| &output.quantity));
    all.find(|quantity| quantity.unit.text().trim() == "pH").map(|quantity| {
        let text = format!(
            "the unit `pH` of `{}` is the picohenry; a pH value is a number, with the unit `1`",
            quantity.name
        );
        Warning::new("picohenry", &quantity.name, text)
    })
}

/// The code of [`unused_inputs`].
pub(super) const UNUSED_INPUT: &str = "unused-input";

/// A level that is reported as a plain number, of inputs that are given in nepers.
fn decibels(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let is_level = !scope.get(name)?.level.is_zero();
    (is_level && is_plain(unit) && unit.level_exponent().is_zero()).then(|| {
        let text = format!(
            "`{name}` is a level, and is reported as its number of decibels, as formulas compute it; \
             report it in `dB` or in `Np`"
        );
        Warning::new("level-as-number", name, text)
    })
}

/// A result that adds levels above a reference, as 5 dBm and 2 dBm.
fn sum_of_levels(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let typing = scope.get(name)?;
    let adds = typing.zero.is_none() && typing.reference == LevelReference::Added;
    adds.then(|| {
        let text = format!(
            "`{name}` in {unit} adds levels above a reference, or multiplies one, so that it is above no \
             reference itself; the level of a sum of powers is `10*log10(10^(L1/10) + 10^(L2/10))`, \
             and gains are in dB"
        );
        Warning::new("sum-of-levels", name, text)
    })
}

/// A result in revolutions per minute of which nothing tells that it counts angle.
fn rate_of_turns(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let typing = scope.get(name)?;
    let unknown = typing.turn.is_none()
        && !typing.has_turns
        && typing.dimension.is_some_and(|of| !of.is_none());
    (unit.counts_revolutions() && unknown && unit.turn().is_some()).then(|| {
        let text = format!(
            "`{name}` is taken for an angular frequency, of which 2*pi radians are a revolution, as \
             nothing says that it counts revolutions; if it does, write `...*[rev]`, or give it in \
             `1/min`"
        );
        Warning::new("rate-of-turns", name, text)
    })
}

/// A result that counts angle, in a unit that counts nothing (`1/min`, `1`), of inputs in revolutions.
fn radians_of_turns(scope: &Scope, output: &Output) -> Option<Warning> {
    let Quantity { name, unit, .. } = &output.quantity;
    let shown = if unit.text().is_empty() { "1" } else { unit.text() };
    let typing = scope.get(name)?;
    let is_rate = typing.dimension.is_some_and(|of| of.is_of_time() && !of.is_none());
    let counts_angle = typing.turn == Some(Turn::Angle) || typing.has_turns && is_rate;
    let counts_nothing = unit.turn() != Some(Turn::Angle) && unit.dimension().is_of_time();
    let text = if counts_angle && counts_nothing {
        format!(
            "`{name}` counts angle and is reported in `{shown}` in radians, 2*pi for a revolution; if \
             revolutions are meant, write `.../[rev]`, or report it in rpm or rev"
        )
    } else if is_per_turn(typing) && !unit.counts_angle() {
        format!(
            "`{name}` is divided by what counts revolutions and is reported in `{shown}` per radian; if it \
             is meant per revolution, write `...*[rev]`"
        )
    } else {
        return None;
    };
    Some(Warning::new("radians-of-turns", name, text))
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
        && typing.dimension.is_some_and(|of| !BY_RADIANS.contains(&of))
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
        .map(|output| {
            let text = format!(
                "`{}` is a number of degrees Celsius by the unit of a coefficient, and is reported \
                 in {} as a difference; write kelvin(...) for a thermodynamic temperature, or \
                 report it in degC",
                output.name, output.unit
            );
            Warning::new("celsius-as-kelvin", &output.name, text)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::read_text;

    /// Notes of a file, each with what it is about.
    fn notes(text: &str) -> Vec<(&'static str, String, String)> {
        let file = read_text("m", text, Path::new(""), &[]).unwrap();
        file.warnings.into_iter().map(|note| (note.code, note.place, note.text)).collect()
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
        assert!(found[0].2.contains("0.1 [deg]"), "{}", found[0].2);
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
