//! The form of a calibration function: a polynomial of some degree, or a formula.

use std::collections::HashMap;

use super::super::scopes::report_formula;
use super::parameter_units;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::model::formula::{Formula, Scope, Typing, check_name};
use gumption_engine::model::{NumberForm, Program, Recorder, Traced};
use gumption_engine::number::{ComplexNumber, Number};
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::{
    ValueOf, bare_number, converted, decimal_comma, grouped_digits, is_comma, with_unit,
};
use gumption_units::{Turn, Unit};

/// The variable of a formula.
const VARIABLE: &str = "x";

/// The imaginary unit of a formula, unless a parameter has this name.
pub(super) const IMAGINARY_UNIT: &str = "i";

/// The highest degree.
const MOST_DEGREE: f64 = 20.0;

/// The form as written.
pub(super) enum FitForm<'a> {
    /// A polynomial of a degree; a straight line is one of degree 1.
    Degree(usize),
    /// A polynomial of the degree that the points ask for.
    Automatic,
    /// A formula of x and parameters, with its place.
    Formula(Formula, &'a Member),
}

/// A formula as a program of x and its parameters.
pub(super) struct Made {
    pub(super) program: Program,
    /// The parameters, `line.a`, with their units.
    pub(super) parameters: Vec<(String, Unit)>,
    /// Values near them.
    pub(super) start: Vec<f64>,
    /// What is to be known of their units.
    pub(super) note: Option<Fact>,
}

impl<'a> FitForm<'a> {
    pub(super) fn read(fit: &Object<'a>) -> Option<Self> {
        let written = fit.get("form");
        let text = match written {
            Some(_) => fit.text("form")?,
            None if fit.get("degree").is_some() => "polynomial",
            None => "straight-line",
        };
        match (text, fit.get("degree")) {
            ("straight-line", None) => Some(Self::Degree(1)),
            ("polynomial", Some(member)) => degree(fit, member),
            ("polynomial", None) => {
                fit.report(DiagnosticKind::MissingKey { key: "degree", what: "a polynomial" });
                None
            }
            (_, Some(member)) => {
                let diagnostic =
                    DiagnosticKind::OnlyWith { key: "degree", with: "\"form\": \"polynomial\"" };
                fit.log.report(&member.key_span, diagnostic);
                None
            }
            (text, None) => {
                let member = written?;
                let formula = fit.log.formula(text);
                match formula {
                    Ok(formula) => Some(Self::Formula(formula, member)),
                    Err(error) => {
                        report_formula(fit.log, member, error);
                        None
                    }
                }
            }
        }
    }

    /// The program of a formula; nothing of a polynomial. Outside `None` after a mistake. `is_complex`
    /// says whether y is.
    #[allow(clippy::option_option)]
    pub(super) fn curve(
        &self,
        fit: &Object<'_>,
        fit_name: &str,
        (x, y, is_complex): (&Unit, &Unit, bool),
        range: [f64; 2],
        numbers: NumberForm,
    ) -> Option<Option<Made>> {
        let Self::Formula(formula, member) = self else {
            if is_complex {
                let form = if matches!(self, Self::Degree(1)) {
                    "a straight line"
                } else {
                    "a polynomial"
                };
                one_is_complex(fit, fit_name, format!("the form is {form}, which is real"));
                return None;
            }
            if let Some(start) = fit.get("start") {
                let diagnostic =
                    DiagnosticKind::OnlyWith { key: "start", with: "a formula as \"form\"" };
                fit.log.report(&start.key_span, diagnostic);
                return None;
            }
            return Some(None);
        };
        let mut start = Start::read(fit, formula, member)?;
        // parameters without any unit are those of an empirical formula
        let checked = numbers == NumberForm::Coherent && start.has_units;
        let form = if checked { numbers } else { NumberForm::Declared };
        let mut scope = Scope::new();
        scope.define(VARIABLE, Typing::in_unit(x));
        for (name, unit, _) in &start.parameters {
            scope.define(name, if checked { Typing::in_unit(unit) } else { Typing::ANY });
        }
        let has_imaginary_unit = start.define_imaginary_unit(formula, &mut scope);
        let found = if checked { formula.check(&scope) } else { formula.check_names(&scope) };
        let typing = match found {
            Ok(typing) => typing,
            Err(errors) => {
                errors.into_iter().for_each(|error| report_formula(fit.log, member, error));
                return None;
            }
        };
        match (formula.is_complex(&scope), is_complex) {
            (true, false) => {
                let form = formula.text();
                let reason = format!(
                    "the form `{form}` is complex, but y is real: give y as {{\"complex\": {{\"modulus\": \
                     ..., \"phase\": ...}}}} (or `re`, `im`), take a part of the form with abs, arg, re or \
                     im, or, where `i` is a parameter, give its value in `start`"
                );
                let name = fit_name.to_owned();
                fit.log.report(&member.value.span, DiagnosticKind::Fit { name, reason });
                return None;
            }
            (false, true) => {
                let form = format!("the form `{}` is real", formula.text());
                one_is_complex(fit, fit_name, form);
                return None;
            }
            _ => {}
        }
        let name = || "y".to_owned();
        if let Some(dimension) = typing.dimension.filter(|_| checked)
            && dimension != y.dimension()
        {
            let diagnostic = DiagnosticKind::WrongDimension {
                name: name(),
                found: y.to_string(),
                found_as: y.dimension().describe(),
                expected: super::super::scopes::coherent(dimension),
                expected_as: dimension.describe(),
            };
            fit.log.report(&member.value.span, diagnostic);
            return None;
        }
        if let Err(misfit) = typing.reported_in(y)
            && checked
        {
            let diagnostic =
                DiagnosticKind::WrongScale { name: name(), unit: y.to_string(), misfit };
            fit.log.report(&member.value.span, diagnostic);
            return None;
        }
        let recorder = Recorder::default();
        let units = std::iter::once((VARIABLE, x))
            .chain(start.parameters.iter().map(|(name, unit, _)| (name.as_str(), unit)));
        let mut values: HashMap<String, ComplexNumber<Traced<'_>>> = units
            .enumerate()
            .map(|(number, (name, unit))| {
                let value = form.taken(recorder.variable(number), unit);
                (name.to_owned(), ComplexNumber::real(value))
            })
            .collect();
        if has_imaginary_unit {
            values.insert(IMAGINARY_UNIT.to_owned(), imaginary_unit());
        }
        let outputs: Vec<Traced<'_>> = match formula.evaluate(&scope, &values) {
            Ok(value) => {
                let parts = std::iter::once(value.re).chain(value.im.filter(|_| is_complex));
                parts.map(|part| form.given(part, y, typing)).collect()
            }
            Err(error) => {
                report_formula(fit.log, member, error);
                return None;
            }
        };
        let program = recorder.program(1 + start.parameters.len(), &outputs);
        // numbers alone are in units that follow from those of x and y
        let empirical = numbers == NumberForm::Coherent && !start.has_units;
        let inferred = empirical
            .then(|| parameter_units::inferred(fit.log, formula, x, y, range, &start.parameters))
            .flatten();
        let is_unchecked = empirical && inferred.is_none();
        let is_of_radians = x.turn() == Some(Turn::Angle) && x.dimension().is_none();
        let angle = formula.angles().find(|(_, name)| *name == VARIABLE);
        if let Some((function, _)) =
            angle.filter(|_| is_unchecked && is_of_radians && x.factor() != 1.0)
        {
            let reason = format!(
                "`{function}` takes radians, and x is computed with in {x}: write `{function}(x [{x}])`, or \
                 give the parameters of `start` with units, such as `\"1 V\"`, by which x is an angle"
            );
            let (key, found) = ("form".to_owned(), formula.text().to_owned());
            fit.log.report(&member.value.span, DiagnosticKind::Value { key, found, reason });
            return None;
        }
        let note = is_unchecked.then(|| fact!("fit-units-not-checked", name = fit_name, x, y));
        let note = note.filter(|_| !x.factors().is_empty() || !y.factors().is_empty());
        for ((_, unit, _), inferred) in
            start.parameters.iter_mut().zip(inferred.into_iter().flatten())
        {
            *unit = inferred;
        }
        let (mut parameters, mut values) = (Vec::new(), Vec::new());
        for (name, unit, value) in start.parameters {
            parameters.push((format!("{fit_name}.{name}"), unit));
            values.push(value);
        }
        Some(Some(Made { program, parameters, start: values, note }))
    }
}

fn degree<'a>(fit: &Object<'a>, member: &'a Member) -> Option<FitForm<'a>> {
    match &member.value.value {
        Json::Text(text) if text == "auto" => return Some(FitForm::Automatic),
        Json::Text(text) => {
            let diagnostic = DiagnosticKind::NotOneOf {
                key: "degree".into(),
                found: text.clone(),
                allowed: vec!["auto".into(), "a whole number".into()],
            };
            fit.log.report(&member.value.span, diagnostic);
            return None;
        }
        _ => {}
    }
    let found = fit.number("degree")?;
    if found.fract() != 0.0 || !(1.0..=MOST_DEGREE).contains(&found) {
        let range = "a whole number from 1 to 20";
        let diagnostic = DiagnosticKind::OutOfRange { key: "degree".into(), found, range };
        fit.log.report(&member.value.span, diagnostic);
        return None;
    }
    Some(FitForm::Degree(found as usize))
}

/// Values near the parameters of a formula.
struct Start {
    parameters: Vec<(String, Unit, f64)>,
    has_units: bool,
}

impl Start {
    fn read(fit: &Object<'_>, formula: &Formula, form: &Member) -> Option<Self> {
        let log = fit.log;
        let Some(member) = fit.get("start") else {
            let diagnostic =
                DiagnosticKind::MissingKey { key: "start", what: "a fit with a formula" };
            log.report(&form.key_span, diagnostic);
            return None;
        };
        let object = Object::new(log, "`start`", &member.value, &member.key_span)?;
        let used: Vec<&str> = formula.names().map(|(name, _)| name).collect();
        let (mut parameters, mut has_units) = (Vec::new(), false);
        for member in object.members() {
            let name = &member.key;
            let reason = match check_name(name) {
                Err(error) => Some(error.to_string()),
                Ok(()) if name == VARIABLE => Some("it is that of the variable".to_owned()),
                Ok(()) if !used.contains(&name.as_str()) => {
                    Some("the formula has no parameter of that name".to_owned())
                }
                Ok(()) => None,
            };
            if let Some(reason) = reason {
                let name = name.clone();
                log.report(&member.key_span, DiagnosticKind::BadName { name, reason });
                return None;
            }
            let (unit, value) = match &member.value.value {
                Json::Text(text) if bare_number(text).is_none() => {
                    let read = with_unit(text).ok_or_else(|| DiagnosticKind::Value {
                        key: name.clone(),
                        found: text.clone(),
                        reason: "a number with a unit is needed, such as `2 kN`".to_owned(),
                    });
                    let (number, unit) = log.value(&member.value.span, read)?;
                    // what goes on behind the number is no unit
                    let goes_on = match is_comma(unit) {
                        true => Some(decimal_comma(number, unit)),
                        false => grouped_digits(unit),
                    };
                    if let Some(reason) = goes_on {
                        let (key, found) = (name.clone(), text.clone());
                        let wrong = DiagnosticKind::Value { key, found, reason };
                        log.report(&member.value.span, wrong);
                        return None;
                    }
                    let parsed = log
                        .unit(unit)
                        .map_err(|error| DiagnosticKind::Unit { unit: unit.to_owned(), error });
                    let unit = log.value(&member.value.span, parsed)?;
                    has_units = true;
                    let value =
                        with_unit(text).map(|read| converted(read, &unit, ValueOf::Quantity, &[]));
                    (unit, value.and_then(Result::ok)?)
                }
                _ => (Unit::one(), object.value(name, &Unit::one(), ValueOf::Quantity)?),
            };
            parameters.push((name.clone(), unit, value));
        }
        if let Some((name, span)) = formula.names().find(|(name, _)| {
            ![VARIABLE, IMAGINARY_UNIT].contains(name)
                && !parameters.iter().any(|(p, ..)| p == name)
        }) {
            let reason = format!(
                "`{name}` is neither `x` nor a parameter: each parameter has a value in `start`"
            );
            let error = gumption_engine::model::formula::FormulaError::Curve { reason, span };
            report_formula(log, form, error);
            return None;
        }
        if parameters.is_empty() {
            member_has_none(fit, form);
            return None;
        }
        Some(Self { parameters, has_units })
    }

    /// Makes `i` the imaginary unit, unless it is a parameter; returns whether the formula has it.
    fn define_imaginary_unit(&self, formula: &Formula, scope: &mut Scope) -> bool {
        let is_named = formula.names().any(|(name, _)| name == IMAGINARY_UNIT);
        let is_unit = is_named && self.parameters.iter().all(|(name, ..)| name != IMAGINARY_UNIT);
        if is_unit {
            define_imaginary_unit(scope);
        }
        is_unit
    }
}

pub(super) fn define_imaginary_unit(scope: &mut Scope) {
    scope.define(IMAGINARY_UNIT, Typing::NUMBER);
    scope.define_complex(IMAGINARY_UNIT);
}

/// The imaginary unit.
pub(super) fn imaginary_unit<T: Number>() -> ComplexNumber<T> {
    ComplexNumber::new(T::constant(0.0), T::constant(1.0))
}

/// That y is complex and the form is not.
fn one_is_complex(fit: &Object<'_>, name: &str, form: String) {
    let reason = format!(
        "y is complex, but {form}: write a complex formula as `form`, such as \"S0/(1 - (x/f0)^2 + \
         2*i*damping*x/f0)\", or fit one part of y as a real y"
    );
    let place = fit.get("form").map_or(fit.place(), |form| &form.value.span);
    fit.log.report(place, DiagnosticKind::Fit { name: name.to_owned(), reason });
}

fn member_has_none(fit: &Object<'_>, form: &Member) {
    let diagnostic = DiagnosticKind::NoValues { name: "start".into() };
    fit.log.report(&form.key_span, diagnostic);
}
