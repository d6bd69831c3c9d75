//! Saved results as inputs: the files that `gumption run --save` writes, read and checked.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use super::conditions::unit;
use super::json::{self, Json, Node};
use super::nearest::nearest;
use super::object::Object;
use super::problem::{Log, Problems};
use super::source::{Place, Source};
use super::{Fault, bytes};
use crate::distribution::{
    Constant, Distribution, Origin, Root, RootCorrelation, RootName, Saved, SavedResult, Scores,
};
use crate::unit::Unit;

/// At most so many quantiles of an output.
const MOST_QUANTILES: u64 = 1_000_001;

/// An output of a result file.
#[derive(Clone, Debug)]
struct SavedOutput {
    name: String,
    unit: Unit,
    distribution: Distribution,
}

/// The result files that a model file names, each read once.
#[derive(Debug)]
pub(super) struct Results<'a> {
    pub(super) folder: &'a Path,
    read: RefCell<HashMap<String, Option<Arc<Vec<SavedOutput>>>>>,
    /// The content of the files, by name.
    pub(super) files: RefCell<Vec<(String, Vec<u8>)>>,
}

impl<'a> Results<'a> {
    /// Paths are relative to `folder`.
    pub(super) fn new(folder: &'a Path) -> Self {
        Self { folder, read: RefCell::default(), files: RefCell::default() }
    }

    /// The unit of the result that an input names, for an input without a unit of its own.
    pub(super) fn unit(&self, input: &Object<'_>) -> Option<Unit> {
        Some(self.output(input)?.unit)
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
        let Some(factor) = factor.filter(|f| f.is_finite() && *f > 0.0) else {
            let fault = Fault::WrongDimension {
                name: name.to_owned(),
                found: unit.to_string(),
                found_as: unit.dimension().describe(),
                expected: output.unit.to_string(),
                expected_as: output.unit.dimension().describe(),
            };
            input.log.report(place, fault);
            return None;
        };
        if output.unit.is_celsius() != unit.is_celsius() && !component {
            let (found, saved) = (unit.to_string(), output.unit.to_string());
            input.log.report(place, Fault::SavedCelsius { name: output.name, found, saved });
            return None;
        }
        if factor == 1.0 {
            return Some(output.distribution);
        }
        let converted = match &output.distribution {
            Distribution::SavedResult(saved) => saved.scaled(factor).map(Distribution::from),
            other => other.moved_to(factor * other.mean()),
        };
        let fault = |error| Fault::Distribution { name: name.to_owned(), error };
        input.log.value(place, converted.map_err(fault))
    }

    /// The output that `file` and `output` of an input name.
    fn output(&self, input: &Object<'_>) -> Option<SavedOutput> {
        let (file, output) = (input.required("file"), input.required("output"));
        let (file, output) = (file?, output?);
        let (name, wanted) = (input.text("file")?, input.text("output")?);
        let known = self.read.borrow().get(name).cloned();
        let outputs = match known {
            Some(outputs) => outputs?,
            None => {
                let outputs = self.load(input.log, name, &file.value).map(Arc::new);
                self.read.borrow_mut().insert(name.to_owned(), outputs.clone());
                outputs?
            }
        };
        let found = outputs.iter().find(|output| output.name == wanted).cloned();
        if found.is_none() {
            let names = outputs.iter().map(|output| output.name.as_str());
            let fault = Fault::NoSuchResult {
                file: name.to_owned(),
                name: wanted.to_owned(),
                nearest: nearest(wanted, names.clone()).map(str::to_owned),
                known: names.map(str::to_owned).collect(),
            };
            input.log.report(&output.value.span, fault);
        }
        found
    }

    /// Reads a file; its mistakes are reported with their places in it.
    fn load(&self, log: &Log, name: &str, place: &Node) -> Option<Vec<SavedOutput>> {
        let unreadable = |message: String| {
            let message = format!("`{name}`: {message}");
            log.report(&place.span, Fault::Unreadable { message });
            None
        };
        let bytes = match bytes::of_file(&self.folder.join(name), bytes::MOST) {
            Ok(bytes) => bytes,
            Err(message) => return unreadable(message),
        };
        let Ok(text) = std::str::from_utf8(&bytes) else {
            return unreadable("it is not UTF-8 text".to_owned());
        };
        match parse(name, text, &sha256(&bytes)) {
            Ok(outputs) => {
                self.files.borrow_mut().push((name.to_owned(), bytes));
                Some(outputs)
            }
            Err(Problems(problems)) => {
                for problem in problems {
                    let place = Place { source: problem.source, span: problem.span };
                    log.report_at(place, problem.fault);
                }
                None
            }
        }
    }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Reads the text of a result file; `hash` is its SHA-256.
fn parse(name: &str, text: &str, hash: &str) -> Result<Vec<SavedOutput>, Problems> {
    let source = Source::new(name, text);
    let log = Log::new(source.clone());
    let outputs = match json::parse(&source) {
        Ok(node) => {
            let whole = 0..source.text.find('\n').unwrap_or(source.text.len());
            Object::new(&log, "a result file", &node, &whole)
                .and_then(|root| Reader { log: &log, root, hash }.outputs())
        }
        Err((span, fault)) => {
            log.report(&span, fault);
            None
        }
    };
    match outputs {
        Some(outputs) if log.is_clean() => Ok(outputs),
        _ => Err(log.into_problems()),
    }
}

struct Reader<'a> {
    log: &'a Log,
    root: Object<'a>,
    hash: &'a str,
}

/// The whole file's part of an origin.
struct Common {
    scores: Scores,
    roots: Vec<Root>,
    correlations: Arc<[RootCorrelation]>,
    siblings: Vec<(String, String, f64)>,
    model: Arc<str>,
}

impl<'a> Reader<'a> {
    fn outputs(&self) -> Option<Vec<SavedOutput>> {
        let root = &self.root;
        if root.truth("result") != Some(true) {
            if self.log.is_clean() {
                let file = self.log.source.name.clone();
                let place = root.get("result").map_or(root.place(), |member| &member.value.span);
                self.log.report(place, Fault::NotResult { file });
            }
            return None;
        }
        let format = root.required("format")?;
        if format.value.number() != Some(1.0) {
            let found = match &format.value.value {
                Json::Number(text) | Json::Text(text) => text.clone(),
                other => other.kind().to_owned(),
            };
            self.log.report(&format.value.span, Fault::UnknownFormat { found });
            return None;
        }
        let member = root.required("outputs")?;
        let common = self.common()?;
        let object = Object::new(self.log, "`outputs`", &member.value, &member.key_span)?;
        let found: Vec<SavedOutput> = object
            .members()
            .iter()
            .filter_map(|member| {
                let what = "an output of a result file";
                let object = Object::new(self.log, what, &member.value, &member.key_span)?;
                self.output(&member.key, &object, &common)
            })
            .collect();
        self.log.is_clean().then_some(found)
    }

    fn common(&self) -> Option<Common> {
        let root = &self.root;
        let origin = root.required("provenance")?;
        let origin = Object::new(self.log, "`provenance`", &origin.value, &origin.key_span)?;
        origin.required("model_sha256")?;
        let model: Arc<str> = origin.text("model_sha256")?.into();
        let scores = root.required("scores")?;
        let scores = Object::new(self.log, "`scores`", &scores.value, &scores.key_span)?;
        for key in ["from", "step", "count"] {
            scores.required(key);
        }
        let step = scores.number("step");
        if let (Some(step), Some(member)) = (step.filter(|s| *s <= 0.0), scores.get("step")) {
            let fault = Fault::NotPositive { key: "step".into(), found: step };
            self.log.report(&member.value.span, fault);
        }
        let count = scores.whole("count", 2, MOST_QUANTILES);
        let from = scores.number("from");
        let roots = self.roots();
        let (from, step, count, roots) = (from?, step?, count?, roots?);
        Some(Common {
            scores: Scores { from, step, count: count as usize },
            correlations: self.root_correlations(&roots).into(),
            siblings: self.siblings(),
            roots,
            model,
        })
    }

    fn roots(&self) -> Option<Vec<Root>> {
        self.root.required("inputs")?;
        let list = self.root.list("inputs")?;
        let mut roots = Vec::with_capacity(list.len());
        for node in list {
            let object = Object::new(self.log, "an input of a result file", node, &node.span)?;
            for key in ["model_sha256", "name", "estimate", "standard_uncertainty"] {
                object.required(key);
            }
            let name = RootName {
                model: object.text("model_sha256")?.into(),
                name: object.text("name")?.into(),
            };
            roots.push(Root {
                name,
                unit: object.text("unit").unwrap_or("").to_owned(),
                distribution: object.text("distribution").unwrap_or("").to_owned(),
                estimate: object.number("estimate")?,
                standard_uncertainty: positive(&object, "standard_uncertainty")?,
                standard_deviation: or_infinite(&object, "standard_deviation"),
                dof: or_infinite(&object, "dof"),
            });
        }
        Some(roots)
    }

    /// `[[i, j, r], …]` of places in `inputs`, counted from 0.
    fn root_correlations(&self, roots: &[Root]) -> Vec<RootCorrelation> {
        let list = self.root.list("input_correlations").unwrap_or_default();
        let mut found = Vec::new();
        for node in list {
            let numbers: Option<Vec<f64>> = match &node.value {
                Json::List(items) => items.iter().map(Node::number).collect(),
                _ => None,
            };
            let place = |x: f64| {
                let known = x.fract() == 0.0 && x >= 0.0 && x < roots.len() as f64;
                known.then(|| roots[x as usize].name.clone())
            };
            let entry = numbers.as_deref().and_then(|numbers| match *numbers {
                [i, j, coefficient] if (-1.0..=1.0).contains(&coefficient) && i != j => {
                    Some(RootCorrelation { first: place(i)?, second: place(j)?, coefficient })
                }
                _ => None,
            });
            if entry.is_none() {
                let reason = "two places in `inputs`, counted from 0, and a coefficient from -1 \
                              to 1 are needed here";
                self.log.report(&node.span, Fault::SavedEntry { reason });
            }
            found.extend(entry);
        }
        found
    }

    /// `[["a", "b", r], …]`; a coefficient that does not exist is null.
    fn siblings(&self) -> Vec<(String, String, f64)> {
        let list = self.root.list("output_correlations").unwrap_or_default();
        let mut found = Vec::new();
        for node in list {
            let entry = match &node.value {
                Json::List(items) => match items.as_slice() {
                    [first, second, r] => match (&first.value, &second.value, &r.value) {
                        (Json::Text(_), Json::Text(_), Json::Null) => continue,
                        (Json::Text(a), Json::Text(b), Json::Number(_)) => r
                            .number()
                            .filter(|r| (-1.0..=1.0).contains(r))
                            .map(|r| (a.clone(), b.clone(), r)),
                        _ => None,
                    },
                    _ => None,
                },
                _ => None,
            };
            if entry.is_none() {
                let reason = "two names of outputs and a coefficient from -1 to 1 are needed here";
                self.log.report(&node.span, Fault::SavedEntry { reason });
            }
            found.extend(entry);
        }
        found
    }

    fn output(&self, name: &str, object: &Object<'a>, common: &Common) -> Option<SavedOutput> {
        for key in ["unit", "estimate", "standard_uncertainty", "quantiles"] {
            object.required(key);
        }
        let unit = unit(object, "unit");
        let estimate = object.number("estimate");
        let u = object.number("standard_uncertainty");
        let dof = match object.text("dof_status") {
            Some("undefined") => f64::NAN,
            _ => or_infinite(object, "dof"),
        };
        let quantiles = object.numbers("quantiles");
        let (unit, estimate, u, quantiles) = (unit?, estimate?, u?, quantiles?);
        let place = object.get("quantiles").map_or(object.place(), |member| &member.value.span);
        let constant = u == 0.0 && quantiles.windows(2).all(|pair| pair[0] == pair[1]);
        let sensitivities = self.sensitivities(object, common.roots.len())?;
        let saved = Saved {
            estimate,
            standard_uncertainty: u,
            standard_deviation: match u {
                0.0 => 0.0,
                _ => or_infinite(object, "standard_deviation"),
            },
            dof,
            drawn_dof: or_infinite(object, "drawn_dof"),
        };
        let made = if constant {
            Constant::new(estimate).map(Distribution::from)
        } else {
            let origin = self.origin(name, unit.text(), &saved, sensitivities, common);
            SavedResult::new(saved, common.scores, &quantiles, origin).map(Distribution::from)
        };
        let made = made.map_err(|error| {
            let place = object.get(error.parameter()).map_or(place, |member| &member.value.span);
            self.log.report(place, Fault::Distribution { name: name.to_owned(), error });
        });
        Some(SavedOutput { name: name.to_owned(), unit, distribution: made.ok()? })
    }

    /// The sensitivity coefficients in the order of `inputs`; inside, `None` for null.
    #[allow(clippy::option_option)]
    fn sensitivities(&self, object: &Object<'a>, inputs: usize) -> Option<Option<Vec<f64>>> {
        let member = object.required("sensitivities")?;
        if member.value.value == Json::Null {
            return Some(None);
        }
        let numbers = object.numbers("sensitivities")?;
        if numbers.len() != inputs {
            let reason = "as many sensitivity coefficients as `inputs` are needed here";
            self.log.report(&member.value.span, Fault::SavedEntry { reason });
            return None;
        }
        Some(Some(numbers))
    }

    fn origin(
        &self,
        name: &str,
        unit: &str,
        saved: &Saved,
        sensitivities: Option<Vec<f64>>,
        common: &Common,
    ) -> Origin {
        let linear = sensitivities.is_some();
        let roots = match sensitivities {
            Some(sensitivities) => {
                let weights = common.roots.iter().zip(sensitivities).filter(|(_, c)| *c != 0.0);
                let weight = |root: &Root, c: f64| {
                    c * root.standard_uncertainty / saved.standard_uncertainty
                };
                weights.map(|(root, c)| (root.clone(), weight(root, c))).collect()
            }
            None => {
                let root = Root {
                    name: RootName { model: self.hash.into(), name: name.into() },
                    unit: unit.to_owned(),
                    distribution: "result".to_owned(),
                    estimate: saved.estimate,
                    standard_uncertainty: saved.standard_uncertainty,
                    standard_deviation: saved.standard_deviation,
                    dof: saved.dof,
                };
                vec![(root, 1.0)]
            }
        };
        let sibling = |(a, b, r): &(String, String, f64)| match (a == name, b == name) {
            (true, false) => Some((b.clone(), *r)),
            (false, true) => Some((a.clone(), *r)),
            _ => None,
        };
        Origin {
            file: self.hash.into(),
            output: name.to_owned(),
            roots,
            linear,
            correlations: common.correlations.clone(),
            siblings: common.siblings.iter().filter_map(sibling).collect(),
            model: common.model.clone(),
        }
    }
}

/// A number above zero.
fn positive(object: &Object<'_>, key: &str) -> Option<f64> {
    let found = object.number(key)?;
    if found > 0.0 {
        return Some(found);
    }
    let place = object.get(key).map_or(object.place(), |member| &member.value.span);
    object.log.report(place, Fault::NotPositive { key: key.to_owned(), found });
    None
}

/// A number above zero; null or nothing for infinite.
fn or_infinite(object: &Object<'_>, key: &str) -> f64 {
    match object.get(key).map(|member| &member.value.value) {
        None | Some(Json::Null) => f64::INFINITY,
        Some(_) => positive(object, key).unwrap_or(f64::INFINITY),
    }
}
