//! Result files read, checked, and turned into distributions.

use std::cell::OnceCell;
use std::ops::Range;
use std::sync::Arc;

use serde_json::{Map, Value};

use super::check::{self, Mistakes};
use super::form::{DofStatus, FORMAT, InputForm, OutputForm, ResultForm};
use super::{seal, siblings};
use crate::context::Context;
use gumption_analysis::diff::ByTrials;
use gumption_engine::distribution::{
    Constant, Distribution, Occasion, Origin, Root, RootCorrelation, RootFigures, RootName, Saved,
    SavedResult, Scores,
};
use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_text::bytes::sha256;
use gumption_text::json::{self, Json, Node};
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText};
use gumption_units::Unit;

/// Changes that are listed, at most.
const MOST_CHANGES: usize = 10;

/// A result file that was read and found right.
#[derive(Clone, Debug)]
pub struct ResultFile {
    /// The title of the model that was evaluated.
    pub title: String,
    /// The coverage probability of its intervals; `None` if the file does not say.
    pub coverage_probability: Option<f64>,
    /// The outputs, in order.
    pub outputs: Vec<SavedOutput>,
    /// The inputs that the outputs go back to.
    pub inputs: Vec<Root>,
    /// Correlation coefficients between inputs.
    pub input_correlations: Vec<RootCorrelation>,
    /// SHA-256 of the model file that was evaluated, in hexadecimal.
    pub model: Arc<str>,
    /// The file's text.
    pub source: Arc<SourceText>,
    /// Notes on the file: that it has no digest, or was changed.
    pub warnings: Vec<Warning>,
}

/// An output of a result file.
#[derive(Clone, Debug)]
pub struct SavedOutput {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
    /// What is known of it: a saved result, or a constant.
    pub distribution: Distribution,
    /// The coverage factor k of its expanded uncertainty; `None` where that is not defined.
    pub coverage_factor: Option<f64>,
    /// Sensitivity coefficients to the file's inputs, in output unit per input unit; `None` where
    /// they are not finite.
    pub sensitivities: Option<Vec<f64>>,
    /// The interval of its trials beside that of the law of propagation; `None` where the file does not
    /// have it.
    pub by_trials: Option<ByTrials>,
}

/// Whether a file is a saved result: it says so itself.
pub(crate) fn is_meant(root: &Node) -> bool {
    let Json::Object(members) = &root.value else { return false };
    members.iter().any(|member| member.key == "result")
}

/// Reads and checks the text of a result file; `name` is used in messages.
pub(crate) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
) -> Result<ResultFile, Diagnostics> {
    let log = Collector::new(SourceText::new(name, text));
    // results are told apart by their content
    let (hash, tree) = (sha256(text.as_bytes()), OnceCell::new());
    let found = Reader { log: &log, hash, tree, accepted: files.changed_results }.read();
    log.finish(found)
}

struct Reader<'a> {
    log: &'a Collector,
    hash: String,
    /// The text with its places, for mistakes.
    tree: OnceCell<Option<Node>>,
    /// Whether a file that was changed is taken.
    accepted: bool,
}

/// The whole file's part of an origin.
struct Common {
    scores: Scores,
    known: Arc<[Root]>,
    correlations: Arc<[RootCorrelation]>,
    model: Arc<str>,
    /// Infinite where the file does not say.
    trials: f64,
}

impl Reader<'_> {
    fn read(&self) -> Option<ResultFile> {
        let text = &self.log.source.text;
        let content: Map<String, Value> = self.parsed(serde_json::from_str(text))?;
        if content.get("result") != Some(&Value::Bool(true)) {
            let file = self.log.source.name.clone();
            self.report("result", DiagnosticKind::NotResult { file });
            return None;
        }
        if let Some(found) = content.get("format").filter(|of| **of != FORMAT) {
            let found = found.as_str().map_or_else(|| found.to_string(), str::to_owned);
            self.report("format", DiagnosticKind::UnknownFormat { found });
            return None;
        }
        let (warnings, intact) = self.integrity(&content);
        drop(content);
        let form: serde_json::Result<ResultForm> = serde_json::from_str(text);
        // of what was changed it is said already
        let form = if self.log.is_clean() { self.parsed(form)? } else { form.ok()? };
        let mistakes = check::ranges(&form);
        if !mistakes.is_empty() {
            self.report_all(mistakes);
            return None;
        }
        let inputs: Vec<Root> = form.inputs.iter().map(root).collect();
        let name = |place: usize| inputs.get(place).map(|root| root.name.clone());
        let pairs = form.input_correlations.iter();
        let pairs = pairs.filter_map(|&(i, j, coefficient)| {
            Some(RootCorrelation { first: name(i)?, second: name(j)?, coefficient })
        });
        let trials = form.provenance.trials.filter(|trials| *trials > 0);
        let common = Common {
            scores: Scores {
                from: form.scores.from,
                step: form.scores.step,
                count: form.scores.count,
            },
            known: inputs.clone().into(),
            correlations: pairs.collect(),
            model: form.provenance.model_sha256.as_str().into(),
            trials: trials.map_or(f64::INFINITY, |trials| trials as f64),
        };
        let mut outputs = Vec::new();
        for (name, output) in &form.outputs {
            if !intact {
                self.report_all(check::consistency(&form, name, output));
            }
            outputs.extend(self.output(&form, name, output, &common));
        }
        siblings::tell_each_other(&mut outputs, &inputs, &common.correlations);
        self.log.is_clean().then(|| ResultFile {
            title: form.title,
            coverage_probability: form.coverage_probability,
            outputs,
            inputs,
            input_correlations: common.correlations.to_vec(),
            model: common.model,
            source: self.log.source.clone(),
            warnings,
        })
    }

    /// What was parsed; a mistake is reported where the parser met it.
    fn parsed<T>(&self, parsed: serde_json::Result<T>) -> Option<T> {
        let error = match parsed {
            Ok(parsed) => return Some(parsed),
            Err(error) => error,
        };
        let (span, kind) = json::mistake(&self.log.source, &error);
        let kind = match kind {
            DiagnosticKind::NotJson { message } if error.is_data() => {
                let message = message.replace("expected f64", "expected a number");
                let reason = format!("a saved result has something else here: {message}");
                DiagnosticKind::SavedEntry { reason }
            }
            other => other,
        };
        self.log.report(&span, kind);
        None
    }

    fn report_all(&self, mistakes: Mistakes) {
        mistakes.into_iter().for_each(|(part, kind)| self.report(&part, kind));
    }

    /// Reports a mistake where the keys lead that stand there with `/` between them; of what is not
    /// there, at the key of the last object that is.
    fn report(&self, part: &str, kind: DiagnosticKind) {
        let text = &self.log.source.text;
        let mut place = 0..text.find('\n').unwrap_or(text.len());
        let tree = self.tree.get_or_init(|| json::parse(&self.log.source).ok());
        let mut node = tree.as_ref();
        for key in part.split('/') {
            let found = node.and_then(|node| below(node, key));
            node = found.map(|(_, node)| node);
            place = found.map_or(place, |(key, _)| key.clone());
        }
        self.log.report(node.map_or(&place, |node| &node.span), kind);
    }

    /// Notes on the digest, and whether the file is as it was written.
    fn integrity(&self, content: &Map<String, Value>) -> (Vec<Warning>, bool) {
        let file = &self.log.source.name;
        let note = |fact| (vec![Warning::new(file, fact)], false);
        let Some(stated) = content.get(seal::DIGEST) else {
            return note(fact!("result-without-digest", file));
        };
        if *stated == seal::digest(content) {
            return (Vec::new(), true);
        }
        let mut changed = seal::changed(content);
        changed.truncate(MOST_CHANGES);
        if self.accepted {
            let parts: Vec<&String> = changed.iter().take(MOST_CHANGES).collect();
            let parts = (!parts.is_empty()).then(|| fact!("changed-parts", parts));
            return note(fact!("result-changed", file, parts));
        }
        if changed.is_empty() {
            self.report(seal::DIGEST, DiagnosticKind::SavedChanged { part: None });
        }
        for part in changed {
            self.report(&part, DiagnosticKind::SavedChanged { part: Some(part.clone()) });
        }
        (Vec::new(), true)
    }

    fn output(
        &self,
        form: &ResultForm,
        name: &str,
        output: &OutputForm,
        common: &Common,
    ) -> Option<SavedOutput> {
        let unit = self.log.unit(&output.unit).map_err(|error| {
            let kind = DiagnosticKind::Unit { unit: output.unit.clone(), error };
            self.report(&format!("outputs/{name}/unit"), kind);
        });
        let u = output.standard_uncertainty;
        let saved = Saved {
            estimate: output.estimate,
            standard_uncertainty: u,
            standard_deviation: match u {
                0.0 => 0.0,
                _ => output.standard_deviation.unwrap_or(f64::INFINITY),
            },
            dof: match output.dof_status {
                Some(DofStatus::Undefined) => f64::NAN,
                _ => output.dof.unwrap_or(f64::INFINITY),
            },
            drawn_dof: output.drawn_dof.unwrap_or(f64::INFINITY),
        };
        let worth = output.effective_trials.unwrap_or(f64::INFINITY).min(common.trials);
        let constant = u == 0.0 && output.quantiles.windows(2).all(|pair| pair[0] == pair[1]);
        let made = if constant {
            Constant::new(output.estimate).map(Distribution::from)
        } else {
            let origin =
                Origin { trials: worth, ..self.origin(form, name, output, &saved, common) };
            SavedResult::new(saved, common.scores, &output.quantiles, origin)
                .map(Distribution::from)
        };
        let made = made.map_err(|error| {
            let part = format!("outputs/{name}/{}", error.parameter());
            self.report(&part, DiagnosticKind::Distribution { name: name.to_owned(), error });
        });
        let by_trials = output.symmetric_interval.filter(|_| !constant);
        Some(SavedOutput {
            name: name.to_owned(),
            unit: unit.ok()?,
            distribution: made.ok()?,
            coverage_factor: output.coverage_factor,
            sensitivities: output.sensitivities.clone(),
            by_trials: by_trials.map(|ends| ByTrials::saved(output.interval, ends, u, worth)),
        })
    }

    fn origin(
        &self,
        form: &ResultForm,
        name: &str,
        output: &OutputForm,
        saved: &Saved,
        common: &Common,
    ) -> Origin {
        let u = saved.standard_uncertainty;
        let roots = match &output.sensitivities {
            Some(sensitivities) => {
                let roots = common.known.iter().zip(sensitivities).filter(|(_, c)| **c != 0.0);
                roots.map(|(root, c)| (root.clone(), c * root.standard_uncertainty / u)).collect()
            }
            None => {
                let figures = RootFigures {
                    estimate: saved.estimate,
                    standard_uncertainty: u,
                    dof: saved.dof,
                };
                let occasion = Occasion::default();
                let named = (self.hash.as_str().into(), name.into());
                let root = Root {
                    name: RootName::new(named, &occasion, &figures),
                    unit: output.unit.clone(),
                    distribution: "result".to_owned(),
                    estimate: saved.estimate,
                    standard_uncertainty: u,
                    standard_deviation: saved.standard_deviation,
                    dof: saved.dof,
                    occasion,
                };
                vec![(root, 1.0)]
            }
        };
        let sibling = |(a, b, r): &(String, String, Option<f64>)| match (a == name, b == name) {
            (true, false) => Some((b.clone(), (*r)?)),
            (false, true) => Some((a.clone(), (*r)?)),
            _ => None,
        };
        Origin {
            file: self.hash.as_str().into(),
            output: name.to_owned(),
            roots,
            linear: output.sensitivities.is_some(),
            correlations: common.correlations.clone(),
            known: common.known.clone(),
            siblings: form.output_correlations.iter().filter_map(sibling).collect(),
            model: common.model.clone(),
            trials: common.trials,
            seed: form.provenance.seed,
            // of the file from 1, here from 0
            ranks: output.ranks.as_ref().map(|ranks| ranks.iter().map(|rank| rank - 1).collect()),
        }
    }
}

/// What a key of an object or a place in a list leads to, behind the range of bytes to be shown where
/// nothing more is found in it.
fn below<'n>(node: &'n Node, key: &str) -> Option<(&'n Range<usize>, &'n Node)> {
    match &node.value {
        Json::Object(members) => {
            let member = members.iter().find(|member| member.key == key)?;
            Some((&member.key_span, &member.value))
        }
        Json::List(items) => {
            let item = items.get(key.parse::<usize>().ok()?)?;
            Some((&item.span, item))
        }
        _ => None,
    }
}

fn root(input: &InputForm) -> Root {
    let text = |of: &Option<String>| of.as_deref().map(Arc::from);
    let replaced = text(&input.replaced).unwrap_or_default();
    // nothing in files of older versions
    let occasion = Occasion {
        data: text(&input.data_sha256),
        row: text(&input.row),
        follows: input.follows_conditions.then_some(replaced),
        certified: text(&input.certified),
    };
    let figures = RootFigures {
        estimate: input.estimate,
        standard_uncertainty: input.standard_uncertainty,
        dof: input.dof.unwrap_or(f64::INFINITY),
    };
    let named = (input.model_sha256.as_str().into(), input.name.as_str().into());
    Root {
        name: RootName::new(named, &occasion, &figures),
        unit: input.unit.clone(),
        distribution: input.distribution.clone(),
        estimate: figures.estimate,
        standard_uncertainty: figures.standard_uncertainty,
        standard_deviation: input.standard_deviation.unwrap_or(f64::INFINITY),
        dof: figures.dof,
        occasion,
    }
}
