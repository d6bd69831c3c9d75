//! What only all quantities of a file together tell: names that stand for two things, quantities
//! that a model does not have, units that do not fit.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use super::conditions::Conditions;
use super::input_set::InputSet;
use super::model_reader::{Equation, ModelBody};
use super::outputs::Outputs;
use super::scopes::{coherent, condition_scope, give_units, report_formula};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::{
    Formula, KelvinKind, LevelReference, Scope, TableCall, TableData, Typing, check_name, looks_of,
};
use gumption_engine::model::typed::CatalogueEntry;
use gumption_engine::task::Warning;
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::Unit;
use gumption_units::nearest;

/// At most so many quantities are named in a note.
const MOST_SHOWN: usize = 8;

/// The quantities of a file.
#[derive(Debug)]
pub(super) struct Quantities {
    pub(super) inputs: InputSet,
    pub(super) conditions: Conditions,
    pub(super) outputs: Outputs,
    /// Whether equations are checked for their dimensions.
    pub(super) check_units: bool,
}

impl Quantities {
    /// Names of those whose unit could not be read.
    fn unknown_units(&self) -> HashSet<&str> {
        let Self { inputs, conditions, outputs, .. } = self;
        let lists = [&inputs.without_unit, &conditions.without_unit, &outputs.without_unit];
        lists.into_iter().flatten().map(String::as_str).collect()
    }
}

/// Names of all quantities: possible, and each used once.
pub(super) fn check_names(root: &Object<'_>, of: &Quantities, body: &Option<ModelBody<'_>>) {
    let Quantities { inputs, conditions, .. } = of;
    // names with the kind of quantity; a key that stands twice in one object is reported there
    let mut taken: HashMap<&str, usize> = HashMap::new();
    // an input that was read has its own name, or names of parts
    let own = inputs.quantities.iter().map(|quantity| quantity.quantity.name.as_str());
    let read: HashSet<&str> = own
        .flat_map(|own| [Some(own), own.rsplit_once('.').map(|(whole, _)| whole)])
        .flatten()
        .collect();
    let mut named: Vec<(usize, &str, &Range<usize>)> = match root.get("inputs") {
        Some(Member { value: Node { value: Json::Object(members), .. }, .. }) => members
            .iter()
            .filter(|member| read.contains(member.key.as_str()))
            .map(|member| (0, member.key.as_str(), &member.key_span))
            .collect(),
        _ => Vec::new(),
    };
    let swept = conditions.quantities.iter().zip(&conditions.places).enumerate();
    let swept = swept.filter(|(number, _)| !conditions.is_history(*number));
    named.extend(swept.map(|(_, (quantity, place))| (1, quantity.name.as_str(), place)));
    if let Some(ModelBody::Equations(equations)) = body {
        let written = equations.iter().filter_map(|(_, member, _)| *member);
        named.extend(written.map(|m| (2, m.key.as_str(), &m.key_span)));
    }
    if let Some(Json::Object(members)) = root.get("fits").map(|m| &m.value.value) {
        named.extend(members.iter().map(|m| (3, m.key.as_str(), &m.key_span)));
    }
    let mut looks: HashMap<String, &str> = HashMap::new();
    for (kind, name, place) in named {
        let alike = *looks.entry(looks_of(name)).or_insert(name);
        if alike != name {
            let codes = |name: &str| {
                let codes = name.chars().filter(|c| !c.is_ascii());
                codes.map(|c| format!("U+{:04X}", u32::from(c))).collect::<Vec<_>>().join(", ")
            };
            let which = match [codes(alike), codes(name)] {
                [first, second] if first.is_empty() => format!("it has {second}"),
                [first, second] if second.is_empty() => format!("that has {first}"),
                [first, second] => format!("{first} there, {second} here"),
            };
            let reason =
                format!("it looks like `{alike}`, but is another name ({which}); write both alike");
            root.log.report(place, DiagnosticKind::BadName { name: name.to_owned(), reason });
        }
        if let Err(error) = check_name(name) {
            let (name, reason) = (name.to_owned(), error.to_string());
            root.log.report(place, DiagnosticKind::BadName { name, reason });
        } else if taken.get(name).is_some_and(|&earlier| earlier != kind) {
            root.log.report(place, DiagnosticKind::NameTaken { name: name.to_owned() });
        }
        taken.entry(name).or_insert(kind);
    }
}

/// Checks that a typed model has the quantities, all of those that it needs, and units that fit.
pub(super) fn check_typed(
    log: &Collector,
    entry: &CatalogueEntry,
    place: &Range<usize>,
    of: &Quantities,
) {
    let Quantities { inputs, conditions, outputs, .. } = of;
    let unknown_units = of.unknown_units();
    let declaration = entry.typed.declaration;
    let model = declaration.name.to_owned();
    let known: Vec<String> = declaration.inputs.iter().map(|i| i.name.to_owned()).collect();
    let mut free: Option<(String, Unit)> = None;
    let mut check = |name: &str, declared: &str, unit: &Unit, place: &Range<usize>| {
        if unknown_units.contains(name) {
            return;
        }
        if entry.any_unit.contains(&name) {
            let (_, first) = free.get_or_insert_with(|| (name.to_owned(), unit.clone()));
            check_unit(log, name, unit, first, place);
        } else if let Ok(declared) = Unit::parse(declared) {
            check_unit(log, name, unit, &declared, place);
        }
    };
    for (input, place) in inputs.quantities.iter().zip(&inputs.quantity_places) {
        let Quantity { name, unit, .. } = &input.quantity;
        match entry.typed.input(name) {
            Some((_, declared)) => check(name, declared.unit, unit, place),
            None => {
                let nearest = nearest(name, known.iter().map(String::as_str));
                let diagnostic = DiagnosticKind::UnknownInput {
                    name: name.to_owned(),
                    model: model.clone(),
                    nearest: nearest.map(str::to_owned),
                    known: known.clone(),
                };
                log.report(place, diagnostic);
            }
        }
    }
    for (condition, place) in conditions.quantities.iter().zip(&conditions.places) {
        if let Some((_, declared)) = entry.typed.input(&condition.name) {
            check(&condition.name, declared.unit, &condition.unit, place);
        }
    }
    for declared in declaration.inputs {
        let given = inputs.quantities.iter().any(|q| q.quantity.name == declared.name)
            || conditions.quantities.iter().any(|q| q.name == declared.name);
        if !given && declared.default.is_none() {
            let (name, unit) = (declared.name.to_owned(), declared.unit.to_owned());
            let (model, known) = (model.clone(), known.clone());
            log.report(place, DiagnosticKind::MissingInput { name, model, unit, known });
        }
    }
    let known: Arc<[String]> = declaration.outputs.iter().map(|o| o.name.to_owned()).collect();
    for (output, place, unit_place) in outputs.each() {
        let name = &output.quantity.name;
        match entry.typed.output(name) {
            Some((_, declared)) => check(name, declared.unit, &output.quantity.unit, unit_place),
            None => unknown_output(log, name, &known, place),
        }
    }
}

pub(super) fn unknown_output(
    log: &Collector,
    name: &str,
    known: &Arc<[String]>,
    place: &Range<usize>,
) {
    let nearest = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
    let diagnostic =
        DiagnosticKind::UnknownOutput { name: name.to_owned(), nearest, known: Arc::clone(known) };
    log.report(place, diagnostic);
}

fn check_unit(log: &Collector, name: &str, found: &Unit, expected: &Unit, place: &Range<usize>) {
    if expected.is_compatible(found) {
        if let Err(misfit) = Typing::in_unit(expected).reported_in(found) {
            let (name, unit) = (name.to_owned(), found.to_string());
            log.report(place, DiagnosticKind::WrongScale { name, unit, misfit });
        }
    } else {
        let shown = if expected.text().is_empty() { "1" } else { expected.text() };
        let diagnostic = DiagnosticKind::WrongDimension {
            name: name.to_owned(),
            found: found.to_string(),
            found_as: found.describe(),
            expected: shown.to_owned(),
            expected_as: expected.describe(),
        };
        log.report(place, diagnostic);
    }
}

/// Checks the equations in order; gives what every name is.
pub(super) fn check_equations(
    log: &Collector,
    equations: &[Equation<'_>],
    of: &Quantities,
    tables: Vec<(TableCall, Option<TableData>)>,
) -> Scope {
    let Quantities { inputs, conditions, check_units, .. } = of;
    let unknown_units = of.unknown_units();
    let mut scope = condition_scope(conditions, *check_units);
    give_units(&mut scope, conditions);
    for (call, data) in tables {
        scope.define_table(call, data);
    }
    let thermodynamic = thermodynamic(inputs);
    for input in &inputs.quantities {
        let Quantity { name, unit, .. } = &input.quantity;
        let known = !unknown_units.contains(name.as_str());
        let typing = if known { Typing::in_unit(unit) } else { Typing::ANY };
        scope.define(
            name,
            if thermodynamic.contains(name.as_str()) { kelvin(typing) } else { typing },
        );
        scope.give(name, unit.clone());
        if known && !check_units {
            scope.declare(name, unit.clone());
        }
    }
    for (name, ..) in equations {
        scope.announce(name);
    }
    define_complex(&mut scope, of, equations);
    for (name, member, formula) in equations.iter().take_while(|_| !log.is_full()) {
        let result = match formula {
            Some(formula) if *check_units => formula.check(&scope),
            Some(formula) => formula.check_names(&scope),
            None => Ok(Typing::ANY),
        };
        let typing = result.unwrap_or_else(|errors| {
            for error in errors {
                if let Some(member) = member {
                    report_formula(log, member, error);
                }
            }
            Typing::ANY
        });
        if let Some(formula) = formula
            && formula.is_complex(&scope)
        {
            scope.define_complex(name);
        }
        scope.define(name, typing);
    }
    scope
}

/// Inputs in K that are larger than this are thermodynamic temperatures, and no corrections of others.
const THERMODYNAMIC: f64 = 200.0;

/// The inputs in K that are thermodynamic temperatures, by their estimates: what is so large corrects no
/// Celsius temperature, so that `t - T0` would be one of -270 degC.
fn thermodynamic(inputs: &InputSet) -> HashSet<&str> {
    let is_so =
        |place: usize| inputs.known.get(place, 0).is_some_and(|known| known.mean() > THERMODYNAMIC);
    let in_kelvin =
        inputs.variables.iter().enumerate().filter(|(_, variable)| *variable.unit.text() == *"K");
    in_kelvin
        .filter(|(place, _)| is_so(*place))
        .map(|(_, variable)| variable.name.as_str())
        .collect()
}

fn kelvin(mut typing: Typing) -> Typing {
    typing.kelvin = KelvinKind::Thermodynamic;
    typing
}

/// Complex quantities that are pairs of inputs, and the imaginary unit where formulas name it.
fn define_complex(scope: &mut Scope, of: &Quantities, equations: &[Equation<'_>]) {
    for (whole, unit) in complex_inputs(of) {
        scope.define(whole, Typing::in_unit(unit));
        scope.define_complex(whole);
    }
    if names_imaginary_unit(equations) && !is_quantity(IMAGINARY_UNIT, of, equations) {
        scope.define(IMAGINARY_UNIT, Typing::NUMBER);
        scope.define_complex(IMAGINARY_UNIT);
    }
}

/// The names and units of complex inputs.
fn complex_inputs(of: &Quantities) -> impl Iterator<Item = (&str, &Unit)> {
    let names = || of.inputs.quantities.iter().map(|input| &input.quantity);
    names().filter_map(move |Quantity { name, unit, .. }| {
        let (whole, part) = name.rsplit_once('.')?;
        let other = match part {
            "re" => "im",
            "abs" => "arg",
            _ => return None,
        };
        let other = format!("{whole}.{other}");
        names().any(|quantity| quantity.name == other).then_some((whole, unit))
    })
}

fn has_complex(of: &Quantities) -> bool {
    !of.outputs.complex.is_empty() || complex_inputs(of).next().is_some()
}

/// Whether a name is that of an input, an equation or a condition.
fn is_quantity(name: &str, of: &Quantities, equations: &[Equation<'_>]) -> bool {
    of.inputs.quantities.iter().any(|input| input.quantity.name == name)
        || equations.iter().any(|(equation, ..)| equation == name)
        || of.conditions.quantities.iter().any(|quantity| quantity.name == name)
}

/// That formulas of complex quantities take `i` for a quantity, and not for the imaginary unit.
pub(super) fn imaginary_unit_hidden(
    of: &Quantities,
    equations: &[Equation<'_>],
) -> Option<Warning> {
    let is_hidden = has_complex(of)
        && is_quantity(IMAGINARY_UNIT, of, equations)
        && names_imaginary_unit(equations);
    is_hidden.then(|| Warning::new(IMAGINARY_UNIT, fact!("imaginary-unit")))
}

/// Whether a formula has the name of the imaginary unit in it.
fn names_imaginary_unit(equations: &[Equation<'_>]) -> bool {
    let mut formulas = equations.iter().filter_map(|(_, _, formula)| formula.as_ref());
    formulas.any(|formula: &Formula| formula.names().any(|(name, _)| name == IMAGINARY_UNIT))
}

/// The name of the imaginary unit.
const IMAGINARY_UNIT: &str = "i";

/// Checks that every output has an equation, whose unit fits.
pub(super) fn check_formula_outputs(log: &Collector, scope: &Scope, of: &Quantities) {
    let Quantities { outputs, check_units, .. } = of;
    let unknown_units = of.unknown_units();
    let known: Arc<[String]> = scope.names().map(str::to_owned).collect();
    for (output, place, unit_place) in outputs.each() {
        let name = &output.quantity.name;
        // a part of a complex output
        let whole =
            name.rsplit_once('.').filter(|(whole, _)| outputs.complex.iter().any(|c| c == whole));
        let found = match whole {
            Some((whole, "arg")) => scope.get(whole).map(|_| Typing::NUMBER),
            Some((whole, _)) => scope.get(whole),
            None => scope.get(name),
        };
        let Some(typing) = found else {
            let whole = whole.map_or(name.as_str(), |(whole, _)| whole);
            unknown_output(log, whole, &known, place);
            continue;
        };
        if whole.is_none() && scope.is_complex(name) {
            // in a file that says nothing of complex quantities somebody may have meant another one
            let why = match has_complex(of) {
                true => "is complex",
                false => "is complex, as `i` is the imaginary unit where no quantity has this name",
            };
            let reason =
                format!("{why}; say how it is reported: \"complex\": \"re-im\" or \"polar\"");
            let name = name.clone();
            log.report(place, DiagnosticKind::Complex { name, reason });
            continue;
        }
        let unit = &output.quantity.unit;
        let checked = *check_units && !unknown_units.contains(name.as_str());
        if let Some(dimension) = typing.dimension.filter(|_| checked)
            && dimension != unit.dimension()
        {
            let mut expected_as = dimension.describe();
            if dimension.is_none() {
                // of an empirical formula
                expected_as += &match typing.reference {
                    LevelReference::Above(zero) => format!(
                        " (`...*1 [{}]` makes what a level in {} is of)",
                        zero.reference().unwrap_or_default(),
                        zero.unit(),
                    ),
                    _ => format!(" (`(...) [{unit}]` makes one of its number)"),
                };
            }
            let diagnostic = DiagnosticKind::WrongDimension {
                name: name.clone(),
                found: unit.to_string(),
                found_as: unit.dimension().describe(),
                // a Celsius temperature is none in K
                expected: typing
                    .zero
                    .map_or_else(|| coherent(dimension), |zero| zero.unit().to_owned()),
                expected_as,
            };
            log.report(unit_place, diagnostic);
        } else if let Err(misfit) = typing.reported_in(unit)
            && checked
        {
            let (name, unit) = (name.clone(), unit.to_string());
            log.report(unit_place, DiagnosticKind::WrongScale { name, unit, misfit });
        }
    }
}

/// What is to be said where units are not checked: that formulas compute with the numbers as they
/// are declared, which earlier versions converted to coherent SI.
pub(super) fn units_not_checked(root: &Object<'_>, of: &Quantities) -> Warning {
    let Quantities { inputs, conditions, outputs, .. } = of;
    let inputs = inputs.quantities.iter().map(|input| &input.quantity);
    let outputs = outputs.outputs.iter().map(|output| &output.quantity);
    let quantities: Vec<&Quantity> = inputs.chain(&conditions.quantities).chain(outputs).collect();
    let converted = |quantity: &&&Quantity| quantity.unit.factor() != 1.0;
    let shown: Vec<Fact> = quantities
        .iter()
        .filter(|quantity| !quantity.unit.factors().is_empty())
        .take(MOST_SHOWN)
        .map(|Quantity { name, unit, .. }| fact!("quantity-in-unit", name, unit))
        .collect();
    let more = (quantities.len() > shown.len()).then(|| fact!("more-quantities"));
    let numbers = match shown.is_empty() {
        true => fact!("units-not-checked.plain"),
        false => fact!("units-not-checked", quantities = shown, more),
    };
    let is_new = root.get("format").is_some_and(|member| member.value.number() == Some(2.0));
    let fact = match quantities.iter().find(converted).filter(|_| !is_new) {
        Some(Quantity { name, unit, .. }) => {
            fact!("units-not-checked-changed", numbers, name, unit)
        }
        None => numbers,
    };
    Warning::new("check_units", fact)
}
