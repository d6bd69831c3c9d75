//! The response of a waveform: points of a calibration, or a fit of a model file.

use std::sync::Arc;

use super::RecipeFiles;
use crate::fits::{ComplexOrdinates, complex_ordinates};
use crate::{keys, model_file};
use gumption_engine::linalg::{Eigen, packed};
use gumption_engine::regression::{ComplexForm, ComplexSpread, Regression};
use gumption_signal::{
    Beyond, CalibratedResponse, Coordinates, Errors, LineResponse, ModelledResponse, Phasor,
    PointError, ResponseModel,
};
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::{DiagnosticKind, Place};
use gumption_units::{Turn, Unit};

/// The response, and its unit.
pub(super) fn read(
    of: &Object<'_>,
    member: &Member,
    files: &mut RecipeFiles<'_>,
) -> Option<(LineResponse, Unit)> {
    if matches!(member.value.value, Json::List(_)) {
        let reason = "a list of points without uncertainties is for the step `correct`; a waveform takes `\"response\": \
                      {\"x\": ..., \"y\": {\"complex\": ...}}`, or `{\"model\": \"sensor.json\", \"fit\": \"sensor\"}`";
        of.log.report(&member.value.span, DiagnosticKind::Recipe { reason: reason.to_owned() });
        return None;
    }
    let inner = Object::new(of.log, "`response`", &member.value, &member.key_span)?;
    keys::check(&inner, keys::RESPONSE);
    match (inner.get("model"), inner.get("x").or(inner.get("y"))) {
        (Some(_), Some(second)) => {
            let diagnostic = DiagnosticKind::Exclusive { first: "model", second: "x" };
            of.log.report(&second.key_span, diagnostic);
            None
        }
        (Some(member), None) => modelled(&inner, member, files),
        (None, _) => calibrated(&inner, files),
    }
}

/// One of two words at a key; nothing where it is not there, and outside after a mistake.
#[expect(clippy::option_option, reason = "outside `None` after a mistake")]
fn word<T: Copy>(of: &Object<'_>, key: &'static str, words: [(&str, T); 2]) -> Option<Option<T>> {
    let Some(member) = of.get(key) else { return Some(None) };
    let found = of.text(key)?;
    let known = words.iter().find(|(word, _)| *word == found);
    if known.is_none() {
        let allowed = words.map(|(word, _)| word.to_owned()).to_vec();
        let diagnostic =
            DiagnosticKind::NotOneOf { key: key.into(), found: found.to_owned(), allowed };
        of.log.report(&member.value.span, diagnostic);
    }
    known.map(|(_, value)| Some(*value))
}

/// A response known at some frequencies.
fn calibrated(of: &Object<'_>, files: &mut RecipeFiles<'_>) -> Option<(LineResponse, Unit)> {
    let (x, y) = (of.required("x"), of.required("y"));
    let (x, y) = (x?, y?);
    let found =
        complex_ordinates(of, (x, y), files.folder, (&mut files.read, &mut files.warnings))?;
    let fault = |reason: String| of.log.report(&x.value.span, DiagnosticKind::Recipe { reason });
    let hertz = Unit::parse("Hz").ok()?;
    if !found.x.unit.is_compatible(&hertz) || found.x.unit.turn() == Some(Turn::Angle) {
        fault(format!(
            "the frequencies of a response are in Hz, kHz, ..., not in {}",
            found.x.unit
        ));
        return None;
    }
    let frequencies: Vec<f64> = found.x.values.iter().map(|f| found.x.unit.to_si(*f)).collect();
    let rises = frequencies.windows(2).all(|pair| pair[0] < pair[1]);
    if !rises || frequencies.first().is_some_and(|first| *first < 0.0) {
        fault("the frequencies of a response begin at 0 or above and rise".to_owned());
        return None;
    }
    let errors = errors(of, &found)?;
    let shared = word(of, "shared", [("points", Errors::OfPoints), ("lines", Errors::OfLines)])?;
    let ends = [("hold", Beyond::Hold), ("cut", Beyond::Cut)];
    let beyond = [word(of, "below", ends)?, word(of, "above", ends)?];
    let [first, second] = &found.values;
    let response = CalibratedResponse {
        frequencies,
        coordinates: match found.form {
            ComplexForm::Polar => Coordinates::Polar,
            ComplexForm::Cartesian => Coordinates::Cartesian,
        },
        values: first.iter().zip(second).map(|(a, b)| [*a, *b]).collect(),
        errors,
        shared: shared.unwrap_or_default(),
        beyond,
    };
    Some((LineResponse::Calibrated(response), found.unit))
}

/// Independent errors that have the covariances of the points.
fn errors(of: &Object<'_>, found: &ComplexOrdinates) -> Option<Vec<PointError>> {
    let member = of.get("correlation");
    let common = match member {
        Some(_) => of.number("correlation")?,
        None => 0.0,
    };
    if !(0.0..=1.0).contains(&common) {
        let (key, range) = ("correlation".to_owned(), "0 to 1");
        let diagnostic = DiagnosticKind::OutOfRange { key, found: common, range };
        of.log.report(&member?.value.span, diagnostic);
        return None;
    }
    match &found.spread {
        ComplexSpread::None => {
            let reason = "the response needs the standard uncertainties of both parts; where one is negligible \
                          state a very small one, such as 1e-9"
                .to_owned();
            of.log.report(&of.get("y")?.key_span, DiagnosticKind::Recipe { reason });
            None
        }
        ComplexSpread::Each([u_first, u_second], r) => {
            let own = (1.0 - common).sqrt();
            let mut errors = Vec::new();
            for (first, ((a, b), r)) in u_first.iter().zip(u_second).zip(r).enumerate() {
                let rest = b * (1.0 - r * r).max(0.0).sqrt();
                for change in [[own * a, own * r * b], [0.0, own * rest]] {
                    if change != [0.0, 0.0] {
                        errors.push(PointError { first, changes: vec![change] });
                    }
                }
            }
            // what all points have in common: one error of the first parts, which the second follow as each point's
            // own correlation says, and one of the second parts alone
            if common > 0.0 {
                let share = common.sqrt();
                let all = || u_first.iter().zip(u_second).zip(r);
                let first = all().map(|((a, b), r)| [share * a, share * r * b]).collect();
                let second = all()
                    .map(|((_, b), r)| [0.0, share * b * (1.0 - r * r).max(0.0).sqrt()])
                    .collect();
                errors.push(PointError { first: 0, changes: first });
                errors.push(PointError { first: 0, changes: second });
            }
            Some(errors)
        }
        ComplexSpread::Joint(lower) => {
            if let Some(member) = member {
                let reason = "the covariance matrix says already how points go together; leave out `correlation`";
                let diagnostic = DiagnosticKind::Recipe { reason: reason.to_owned() };
                of.log.report(&member.key_span, diagnostic);
                return None;
            }
            let n = found.values[0].len();
            let eigen = Eigen::of(&packed::to_symmetric(lower));
            let largest = eigen.values.iter().copied().fold(0.0, f64::max);
            if eigen.values.iter().any(|value| *value < -1e-9 * largest) {
                let reason =
                    "the covariance matrix of the response has a negative eigenvalue".to_owned();
                of.log.report(&of.get("y")?.key_span, DiagnosticKind::Recipe { reason });
                return None;
            }
            let roots = eigen.pairs().filter(|(value, _)| *value > 1e-15 * largest);
            let errors = roots.map(|(value, vector)| {
                let root = value.sqrt();
                let change = |i: usize| [root * vector[i], root * vector[n + i]];
                PointError { first: 0, changes: (0..n).map(change).collect() }
            });
            Some(errors.collect())
        }
    }
}

/// A fitted response, with what it leaves of its points.
fn modelled(
    of: &Object<'_>,
    member: &Member,
    files: &mut RecipeFiles<'_>,
) -> Option<(LineResponse, Unit)> {
    for key in ["correlation", "shared", "below", "above"] {
        if let Some(other) = of.get(key) {
            let reason = format!(
                "`{key}` belongs to points; a fit has its parameters' covariances at all frequencies"
            );
            of.log.report(&other.key_span, DiagnosticKind::Recipe { reason });
            return None;
        }
    }
    let name = of.text("model")?;
    let place = &member.value.span;
    let file = match model_file::named(files.context, files.folder, name, &[]) {
        Ok(Ok(file)) => file,
        Ok(Err(diagnostics)) => {
            for found in diagnostics.0 {
                of.log.report_at(Place { source: found.source, span: found.span }, found.kind);
            }
            return None;
        }
        Err(kind) => {
            of.log.report(place, kind);
            return None;
        }
    };
    let fit = of.required("fit")?;
    let wanted = of.text("fit")?;
    let curves = &file.task.curves;
    let Some(curve) = curves.iter().find(|curve| curve.fit.name == wanted) else {
        let known: Vec<String> =
            curves.iter().map(|curve| format!("`{}`", curve.fit.name)).collect();
        let reason = match known.is_empty() {
            true => format!("`{name}` has no `fits`"),
            false => format!("`{name}` has no fit `{wanted}`; its fits are {}", known.join(", ")),
        };
        of.log.report(&fit.value.span, DiagnosticKind::Recipe { reason });
        return None;
    };
    let hertz = Unit::parse("Hz").ok()?;
    let is_frequency = curve.x.is_compatible(&hertz) && curve.x.turn() != Some(Turn::Angle);
    if !curve.fit.curve.is_complex() || !is_frequency {
        let reason = format!(
            "the fit `{wanted}` is no response: it needs a complex y over frequencies in Hz, kHz, ... as x"
        );
        of.log.report(&fit.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    files.warnings.extend(file.warnings.iter().filter(|of| of.code() == "fit-not-valid").cloned());
    files.read.push((name.to_owned(), file.source.text.clone().into_bytes()));
    let regression = Arc::clone(&curve.fit);
    let covariance = regression.covariance_matrix().to_vec();
    let misfit = misfit(&regression, &curve.x);
    let model = FittedResponse { fit: Arc::clone(&regression), in_hertz: curve.x.clone() };
    let response = ModelledResponse {
        model: Arc::new(model),
        estimates: regression.estimates.clone(),
        covariance,
        misfit,
    };
    Some((LineResponse::Modelled(response), curve.y.clone()))
}

/// A fit of a complex y over frequency.
#[derive(Debug)]
struct FittedResponse {
    fit: Arc<Regression>,
    /// The unit of its frequencies.
    in_hertz: Unit,
}

impl ResponseModel for FittedResponse {
    fn value(&self, hertz: f64, parameters: &[f64]) -> Phasor {
        let [re, im] = self.fit.complex_value(self.in_hertz.from_si(hertz), parameters);
        Phasor::new(re, im)
    }

    fn gradient(&self, hertz: f64) -> Vec<Phasor> {
        let (_, gradient) = self.fit.complex_gradient(self.in_hertz.from_si(hertz));
        gradient.into_iter().map(|[re, im]| Phasor::new(re, im)).collect()
    }
}

/// What a fit leaves of its points beyond their uncertainties, as relative errors of modulus and phase, each with one
/// standard uncertainty at all points: the mean square of the residuals less that of the standard uncertainties. Where the
/// uncertainties are only relative to each other, the residuals are in the parameters already.
fn misfit(fit: &Regression, x: &Unit) -> Option<CalibratedResponse> {
    if fit.factor.is_some() {
        return None;
    }
    let residuals = fit.complex_residuals();
    let n = residuals.len() as f64;
    let excess = [0, 1].map(|part| {
        let sum: f64 = residuals
            .iter()
            .map(|of| {
                let stated = of.covariance.map_or(0.0, |matrix| matrix[part][part]);
                of.relative[part] * of.relative[part] - stated
            })
            .sum();
        (sum / n).max(0.0).sqrt()
    });
    if excess == [0.0, 0.0] {
        return None;
    }
    let mut frequencies: Vec<f64> = residuals.iter().map(|of| x.to_si(of.x)).collect();
    gumption_engine::number::ascending(&mut frequencies);
    frequencies.dedup();
    Some(CalibratedResponse::about_one(frequencies, excess))
}
