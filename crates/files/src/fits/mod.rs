//! Calibration functions of a file: points, the curve that is fitted to them, and its parameters as
//! correlated inputs.

mod complex_points;
#[cfg(test)]
mod complex_tests;
pub(super) mod extrapolation;
mod form;
mod matrix;
mod parameter_units;
mod points;
#[cfg(test)]
mod tests;

use std::ops::Range;
use std::sync::Arc;

use super::input_set::InputSet;
use super::keys;
pub(super) use complex_points::{ComplexOrdinates, complex_ordinates};
use form::FitForm;
use gumption_engine::distribution::{Distribution, EvaluationType, Fitted};
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::model::formula::check_name;
use gumption_engine::model::{InputQuantity, NumberForm, Quantity};
use gumption_engine::regression::{
    Coordinate, Curve, CurveFunction, Points, Regression, RegressionError, choose_degree,
};
use gumption_engine::task::{Variable, Warning};
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::{Collector, DiagnosticKind, Folder};
use gumption_units::Unit;
use points::Tables;

/// At most so many calibration functions.
const MOST_FITS: usize = 1000;

/// The highest degree that `auto` tries.
const MOST_TRIED: usize = 6;

/// The relative rounding of the curve's standard uncertainty beyond which the coefficients of powers
/// are of no use.
const MOST_ROUNDING: f64 = 1e-7;

/// From so many points on a trial's own fit is worth no more than the joint normal distribution.
const MANY_POINTS: usize = 2000;

/// The calibration functions of a file.
#[derive(Debug, Default)]
pub(super) struct FitSet {
    pub(super) curves: Vec<Arc<CurveFunction>>,
    /// The key of each.
    pub(super) places: Vec<Range<usize>>,
    /// What each is, and its group.
    words: Vec<(String, Option<String>)>,
    /// The texts of each, the names of its files among them.
    texts: Vec<Vec<String>>,
    /// The content of the tables that were read, by name.
    pub(super) files: Vec<(String, Vec<u8>)>,
    pub(super) warnings: Vec<Warning>,
}

/// Reads `fits`; `None` after a mistake.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    folder: Folder<'_>,
    numbers: NumberForm,
) -> Option<FitSet> {
    let object = Object::new(log, "`fits`", &member.value, &member.key_span)?;
    let found = object.members().len();
    if found > MOST_FITS {
        object.report(DiagnosticKind::TooMany { what: "fits", found, most: MOST_FITS });
        return None;
    }
    let mut set = FitSet::default();
    for member in object.members() {
        if log.is_full() {
            break;
        }
        let object = Object::new(log, "a fit", &member.value, &member.key_span);
        let Some(object) = object else { continue };
        if let Err(error) = check_name(&member.key) {
            let (name, reason) = (member.key.clone(), error.to_string());
            log.report(&member.key_span, DiagnosticKind::BadName { name, reason });
            continue;
        }
        let mut reader = FitReader { object, name: &member.key, folder, set: &mut set };
        if let Some(curve) = reader.curve(numbers) {
            set.curves.push(Arc::new(curve));
            set.places.push(member.key_span.clone());
            let about = object.text("about").unwrap_or("").to_owned();
            set.words.push((about, object.text("group").map(str::to_owned)));
            set.texts.push(member.value.texts().into_iter().map(str::to_owned).collect());
        }
    }
    (set.curves.len() == found).then_some(set)
}

impl FitSet {
    /// Adds the parameters to the inputs: drawn together, with the coefficients of their fit.
    pub(super) fn add_to(&self, log: &Collector, inputs: &mut InputSet) {
        let words = self.words.iter().zip(&self.texts);
        for ((curve, place), ((about, group), texts)) in
            self.curves.iter().zip(&self.places).zip(words)
        {
            for (number, (name, unit)) in curve.parameters.iter().enumerate() {
                let variable = inputs.variables.len();
                let known = Fitted::new(&curve.fit, number)
                    .map_err(|error| DiagnosticKind::Distribution { name: name.clone(), error });
                let Some(known) = log.value(place, known) else { continue };
                let known = Distribution::from(known);
                let about = if about.is_empty() { String::new() } else { about.clone() };
                let quantity =
                    Quantity { name: name.clone(), unit: unit.clone(), about: about.clone() };
                inputs.quantities.push(InputQuantity { quantity, parts: 1 });
                inputs.quantity_places.push(place.clone());
                let mut of = Variable::new(name, unit.clone());
                of.evaluation = EvaluationType::of(&known);
                (of.about, of.group) = (about, group.clone());
                let files = self.files.iter().filter(|(name, _)| texts.contains(name));
                inputs.read_from.extend(files.map(|(name, _)| (variable, name.clone())));
                inputs.variables.push(of);
                inputs.places.push(place.clone());
                inputs.known.always(variable, known);
            }
        }
    }
}

struct FitReader<'a, 's> {
    object: Object<'a>,
    name: &'a str,
    folder: Folder<'a>,
    set: &'s mut FitSet,
}

impl FitReader<'_, '_> {
    fn curve(&mut self, numbers: NumberForm) -> Option<CurveFunction> {
        let object = self.object;
        keys::check(&object, keys::FIT);
        let form = FitForm::read(&object);
        let points = self.points();
        let estimated = match object.text("weights") {
            Some("estimated") => true,
            None | Some("stated") => false,
            Some(other) => {
                let diagnostic = DiagnosticKind::NotOneOf {
                    key: "weights".into(),
                    found: other.to_owned(),
                    allowed: vec!["stated".into(), "estimated".into()],
                };
                let place = object.get("weights").map_or(object.place(), |m| &m.value.span);
                object.log.report(place, diagnostic);
                return None;
            }
        };
        let (form, (points, (x, y), is_stated)) = (form?, points?);
        let points = Arc::new(if estimated { points.estimated() } else { points });
        let sides = (&x, &y, points.is_complex());
        let made = form.curve(&object, self.name, sides, points.range(), numbers)?;
        let origin = match object.get("origin") {
            None => 0.0,
            Some(_) => object.value("origin", &x, ValueOf::Quantity)?,
        };
        let (fitted, named) = match (&form, made) {
            (FitForm::Automatic, _) => {
                (choose_degree(self.name, origin, &points, MOST_TRIED), None)
            }
            (FitForm::Degree(degree), _) => {
                let curve = Curve::Polynomial { degree: *degree, origin };
                (Regression::of(self.name, &curve, &points, &[]), None)
            }
            (FitForm::Formula(..), Some(made)) => {
                let curve = Curve::Program(made.program);
                self.set.warnings.extend(made.note.map(|fact| Warning::new(self.name, fact)));
                let fitted = Regression::of(self.name, &curve, &points, &made.start);
                (fitted, Some(made.parameters))
            }
            (FitForm::Formula(..), None) => return None,
        };
        let fitted = fitted.map_err(|error| self.report(&error)).ok()?;
        let parameters = named.unwrap_or_else(|| {
            coefficients(&object.log.own_units(), self.name, fitted.count(), &x, &y)
        });
        let curve = self.function(fitted, (x, y), parameters, numbers)?;
        Some(curve.stating(is_stated))
    }

    fn function(
        &mut self,
        fitted: Regression,
        units: (Unit, Unit),
        parameters: Vec<(String, Unit)>,
        numbers: NumberForm,
    ) -> Option<CurveFunction> {
        if !fitted.has_scatter() {
            self.report(&RegressionError::NoScatter);
            return None;
        }
        if fitted.rounding() > MOST_ROUNDING {
            let [least, most] = fitted.points.range();
            let near = 0.5 * (least + most);
            let reason = format!(
                "x is so far from 0, compared with its range, that the coefficients of its powers \
                 lose their digits; let them count from a value within: \"origin\": {near}"
            );
            self.fault(reason, self.object.place());
            return None;
        }
        if !fitted.is_linear() && fitted.points.len() > MANY_POINTS {
            let reason = format!(
                "there are {} points, but a fit whose trials need fits of their own takes at most \
                 {}; state means of groups of points",
                fitted.points.count(),
                MANY_POINTS * fitted.points.count() / fitted.points.len()
            );
            self.fault(reason, self.object.place());
            return None;
        }
        if fitted.is_valid() == Some(false) {
            let name = self.name;
            let [chi2, limit] = [fitted.chi2, fitted.limit_of_chi2().unwrap_or(f64::NAN)]
                .map(|number| Argument::Number(format!("{number:.4}")));
            let fact = fact!("fit-not-valid", name, chi2, dof = fitted.dof, limit);
            self.set.warnings.push(Warning::new(name, fact));
        }
        let fit = Arc::new(fitted);
        Some(CurveFunction::new(fit, units, parameters, numbers))
    }

    /// The points, their units, and whether the file says these.
    fn points(&mut self) -> Option<(Points, (Unit, Unit), [bool; 2])> {
        let (x, y) = (self.object.required("x"), self.object.required("y"));
        let (x, y) = (x?, y?);
        if let Some((y, complex)) = complex_points::of(self.object.log, y) {
            return self.complex_points(x, y, complex);
        }
        let (mut tables, folder) = (Tables::of([x, y], &["x", "y"]), self.folder);
        let files = &mut self.set.files;
        let x = points::read(self.object.log, x, "x", (folder, &mut tables), files);
        let y = points::read(self.object.log, y, "y", (folder, &mut tables), files);
        let (x, mut y) = (x?, y?);
        self.note(&mut y);
        if x.values.len() != y.values.len() {
            let reason = format!(
                "x has {} values and y has {}, but each point has both",
                x.values.len(),
                y.values.len()
            );
            self.fault(reason, self.object.place());
            return None;
        }
        let n = x.values.len();
        let cross = match self.object.get("cross_covariance") {
            None => gumption_engine::regression::Cross::None,
            Some(member) => {
                matrix::cross(self.object.log, member, n, self.folder, &mut self.set.files)?
            }
        };
        let points =
            Points::new(x.values, y.values).with_x(x.spread).with_y(y.spread).with_cross(cross);
        Some((points, (x.unit, y.unit), [x.is_stated, y.is_stated]))
    }

    /// Adds the notes on a coordinate.
    fn note(&mut self, side: &mut points::Side) {
        let notes = std::mem::take(&mut side.notes);
        self.set.warnings.extend(notes.into_iter().map(|fact| Warning::new(self.name, fact)));
    }

    fn fault(&self, reason: String, place: &Range<usize>) {
        let name = self.name.to_owned();
        self.object.log.report(place, DiagnosticKind::Fit { name, reason });
    }

    /// What is wrong with the points, at the coordinate that it is about.
    fn report(&self, error: &RegressionError) {
        let coordinate = match error {
            RegressionError::Length { coordinate, .. }
            | RegressionError::NotFinite { coordinate, .. }
            | RegressionError::NoVariance { coordinate, .. } => Some(*coordinate),
            RegressionError::NotDefinite { coordinate, .. } => {
                Some(coordinate.unwrap_or(Coordinate::Both))
            }
            RegressionError::TooFewAbscissae { .. } => Some(Coordinate::X),
            _ => None,
        };
        let key = match coordinate {
            Some(Coordinate::X) => "x",
            Some(Coordinate::Y) => "y",
            Some(Coordinate::Both) => "cross_covariance",
            None => "",
        };
        let side = self.object.get(key);
        // within the coordinate what says it
        let inner = side.and_then(|side| match &side.value.value {
            Json::Object(members) => {
                let wanted: &[&str] = match error {
                    RegressionError::NoVariance { .. } | RegressionError::NotDefinite { .. } => {
                        &["standard_uncertainty", "covariance"]
                    }
                    _ => &["values", "column", "file"],
                };
                members.iter().find(|member| wanted.contains(&member.key.as_str()))
            }
            _ => None,
        });
        let place = inner.or(side).map_or(self.object.place(), |member| &member.key_span);
        self.fault(error.to_string(), place);
    }
}

/// The names of a polynomial's coefficients, a and on, with their units.
fn coefficients(own: &[Unit], name: &str, count: usize, x: &Unit, y: &Unit) -> Vec<(String, Unit)> {
    ('a'..='z')
        .take(count)
        .enumerate()
        .map(|(power, letter)| (format!("{name}.{letter}"), unit_of(own, x, y, power)))
        .collect()
}

/// The texts of both units, x such that it can be divided by.
fn texts_of(x: &Unit, y: &Unit) -> [String; 2] {
    let text = |unit: &Unit| {
        let text = unit.text().trim();
        if text.is_empty() { "1".to_owned() } else { text.to_owned() }
    };
    let (x, y) = (text(x), text(y));
    let plain = |text: &str| text.chars().all(|c| c.is_alphanumeric() || "%°℃Ωµ".contains(c));
    [if plain(&x) { x } else { format!("({x})") }, y]
}

/// The unit of a coefficient: y over a power of x, in which a degree Celsius is one of a difference.
fn unit_of(own: &[Unit], x: &Unit, y: &Unit, power: usize) -> Unit {
    let [x, y] = texts_of(x, y);
    let written = match (power, x.as_str(), y.as_str()) {
        (0, ..) => y.clone(),
        (_, "1", _) => y.clone(),
        (1, x, y) => format!("{y}/{x}"),
        (power, x, y) => format!("{y}/{x}^{power}"),
    };
    Unit::parse_among(&written, own).unwrap_or_else(|_| Unit::one())
}
