//! Saved results as inputs: the outputs of result files that a model file names.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

use super::context::Context;
use super::dcc::{self, Certificates, FromCertificate};
use super::open::is_no_object;
use super::result::{self, ResultFile, SavedOutput};
use gumption_engine::distribution::Distribution;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::Warning;
use gumption_text::json::Node;
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, Folder, Place, bytes};
use gumption_units::Unit;
use gumption_units::nearest;

/// The result files that a model file names, each read once.
#[derive(Debug)]
pub(super) struct ResultFiles<'a> {
    pub(super) folder: Folder<'a>,
    context: Context<'a>,
    read: RefCell<HashMap<String, Option<Arc<ResultFile>>>>,
    /// The content of the files, by name.
    pub(super) files: RefCell<Vec<(String, Vec<u8>)>>,
    /// The certificates that it names.
    pub(super) certificates: RefCell<Certificates>,
    /// What is to be known of the files.
    pub(super) warnings: RefCell<Vec<Warning>>,
    /// The calibration functions of the model file, whose scatter readings may have.
    pub(super) curves: Vec<Arc<CurveFunction>>,
}

impl<'a> ResultFiles<'a> {
    /// Paths are relative to `folder`.
    pub(crate) fn new(folder: Folder<'a>, context: Context<'a>) -> Self {
        let (read, files, certificates, curves) = Default::default();
        let warnings = RefCell::default();
        Self { folder, context, read, files, certificates, warnings, curves }
    }

    /// These calibration functions are in the file.
    pub(super) fn with_curves(self, curves: &[Arc<CurveFunction>]) -> Self {
        Self { curves: curves.to_vec(), ..self }
    }

    /// The unit of the result that an input names, for an input without a unit of its own.
    pub(super) fn unit(&self, input: &Object<'_>) -> Option<Unit> {
        Some(self.output(input)?.unit)
    }

    /// What an input takes from a certificate.
    pub(super) fn of_certificate(&self, input: &Object<'_>) -> Option<FromCertificate> {
        dcc::read(input, self.folder, &mut self.certificates.borrow_mut())
    }

    /// The distribution of the result that an input names, in `unit`. A component is a difference,
    /// for which degrees Celsius and kelvins are the same.
    pub(super) fn distribution(
        &self,
        input: &Object<'_>,
        name: &str,
        unit: &Unit,
        component: bool,
    ) -> Option<Distribution> {
        let output = self.output(input)?;
        let place = input.get("unit").or_else(|| input.get("output"));
        let place = place.map_or(input.place(), |member| &member.value.span);
        let factor = Unit::conversion_factor(&output.unit, unit).ok();
        // the value that the zero of the result's unit has in the input's
        let zero = Unit::convert(0.0, &output.unit, unit).ok();
        let factor = factor.filter(|f| f.is_finite() && *f > 0.0);
        let (Some(factor), Some(zero)) = (factor, zero) else {
            let diagnostic = DiagnosticKind::WrongDimension {
                name: name.to_owned(),
                found: unit.to_string(),
                found_as: unit.describe(),
                expected: output.unit.to_string(),
                expected_as: output.unit.describe(),
            };
            input.log.report(place, diagnostic);
            return None;
        };
        if zero != 0.0 && !component {
            let (found, saved) = (unit.to_string(), output.unit.to_string());
            let diagnostic = DiagnosticKind::SavedZero { name: output.name, found, saved };
            input.log.report(place, diagnostic);
            return None;
        }
        if factor == 1.0 {
            return Some(output.distribution);
        }
        let converted = match &output.distribution {
            Distribution::SavedResult(saved) => saved.scaled(factor).map(Distribution::from),
            other => other.moved_to(factor * other.mean()),
        };
        let diagnostic = |error| DiagnosticKind::Distribution { name: name.to_owned(), error };
        input.log.value(place, converted.map_err(diagnostic))
    }

    /// The output that `file` and `output` of an input name.
    fn output(&self, input: &Object<'_>) -> Option<SavedOutput> {
        let (file, output) = (input.required("file"), input.required("output"));
        let (file, output) = (file?, output?);
        let (name, wanted) = (input.text("file")?, input.text("output")?);
        let known = self.read.borrow().get(name).cloned();
        let result = match known {
            Some(result) => result?,
            None => {
                let result = self.load(input.log, name, &file.value).map(Arc::new);
                self.read.borrow_mut().insert(name.to_owned(), result.clone());
                result?
            }
        };
        let found = result.outputs.iter().find(|output| output.name == wanted).cloned();
        if found.is_none() {
            let names = result.outputs.iter().map(|output| output.name.as_str());
            let diagnostic = DiagnosticKind::NoSuchResult {
                file: name.to_owned(),
                name: wanted.to_owned(),
                nearest: nearest(wanted, names.clone()).map(str::to_owned),
                known: names.map(str::to_owned).collect(),
            };
            input.log.report(&output.value.span, diagnostic);
        }
        found
    }

    /// Reads a file; its mistakes are reported with their places in it.
    fn load(&self, log: &Collector, name: &str, place: &Node) -> Option<ResultFile> {
        let unreadable = |message: String| {
            let message = format!("`{name}`: {message}");
            log.report(&place.span, DiagnosticKind::Unreadable { message });
            None
        };
        let bytes = match self.folder.content(name, bytes::MOST) {
            Ok(bytes) => bytes,
            Err(kind) => {
                log.report(&place.span, kind);
                return None;
            }
        };
        let text = match bytes::text(&bytes) {
            Ok(text) => text,
            Err(message) => return unreadable(message),
        };
        if let Some(message) = is_no_object(&text) {
            return unreadable(message);
        }
        let read = result::read_text(self.context, name, &text);
        drop(text);
        match read {
            Ok(result) => {
                self.warnings.borrow_mut().extend(result.warnings.iter().cloned());
                self.files.borrow_mut().push((name.to_owned(), bytes));
                Some(result)
            }
            Err(Diagnostics(diagnostics)) => {
                for diagnostic in diagnostics {
                    let place = Place { source: diagnostic.source, span: diagnostic.span };
                    log.report_at(place, diagnostic.kind);
                }
                None
            }
        }
    }
}
