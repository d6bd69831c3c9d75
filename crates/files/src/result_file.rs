//! Result files: what `gumption run --save` writes, read and checked.

use std::ops::Range;
use std::sync::Arc;

use serde_json::{Map, Value};

use super::conditions::unit;
use super::context::Context;
use super::open::{check_format, read_root};
use super::result_consistency::{self, StatedOutput};
use super::result_outputs;
use gumption_analysis::diff::ByTrials;
use gumption_analysis::integrity;
use gumption_engine::distribution::{
    Constant, Distribution, Occasion, Origin, Root, RootCorrelation, RootFigures, RootName, Saved,
    SavedResult, Scores,
};
use gumption_engine::fact;
use gumption_engine::task::Warning;
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText};
use gumption_units::Unit;

/// At most so many quantiles of an output.
const MOST_QUANTILES: u64 = 1_000_001;

/// At most so many ranks of an output.
const MOST_RANKS: usize = 1_000_000;

/// At most so many trials behind a result.
const MOST_TRIALS: u64 = 1_000_000_000_000;

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
pub(super) fn is_meant(root: &Node) -> bool {
    let Json::Object(members) = &root.value else { return false };
    members.iter().any(|member| member.key == "result")
}

/// Reads and checks the text of a result file; `name` is used in messages.
pub(super) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
) -> Result<ResultFile, Diagnostics> {
    // results are told apart by their content
    let hash = integrity::sha256(text.as_bytes());
    read_root(name, text, "a result file", |root| {
        let accepted = files.changed_results;
        Reader { log: root.log, root, hash: &hash, accepted }.read()
    })
}

struct Reader<'a> {
    log: &'a Collector,
    root: Object<'a>,
    hash: &'a str,
    /// Whether a file that was changed is taken.
    accepted: bool,
}

/// The whole file's part of an origin.
struct Common {
    scores: Scores,
    roots: Vec<Root>,
    /// The same, for the origins of all outputs.
    known: Arc<[Root]>,
    correlations: Arc<[RootCorrelation]>,
    siblings: Vec<(String, String, f64)>,
    model: Arc<str>,
    /// Infinite where the file does not say.
    trials: f64,
    seed: Option<u64>,
}

impl<'a> Reader<'a> {
    fn read(&self) -> Option<ResultFile> {
        let root = &self.root;
        if root.truth("result") != Some(true) {
            if self.log.is_clean() {
                let file = self.log.source.name.clone();
                let place = root.get("result").map_or(root.place(), |member| &member.value.span);
                self.log.report(place, DiagnosticKind::NotResult { file });
            }
            return None;
        }
        root.needed("format")?;
        if !check_format(root, 1.0) {
            return None;
        }
        let member = root.needed("outputs")?;
        root.text("gumption");
        let title = root.text("title").unwrap_or("").to_owned();
        let (warnings, intact) = self.integrity();
        let coverage_probability = self.coverage_probability();
        let common = self.common()?;
        let object = Object::new(self.log, "`outputs`", &member.value, &member.key_span)?;
        self.check_ranks(&object);
        let mut found: Vec<SavedOutput> = object
            .members()
            .iter()
            .filter_map(|member| {
                let what = "an output of a result file";
                let object = Object::new(self.log, what, &member.value, &member.key_span)?;
                self.output(&member.key, &object, &common, intact)
            })
            .collect();
        result_outputs::tell_each_other(&mut found, &common.roots, &common.correlations);
        self.log.is_clean().then(|| ResultFile {
            title,
            coverage_probability,
            outputs: found,
            inputs: common.roots,
            input_correlations: common.correlations.to_vec(),
            model: common.model,
            source: self.log.source.clone(),
            warnings,
        })
    }

    /// Notes on the digest, and whether the file is as it was written.
    fn integrity(&self) -> (Vec<Warning>, bool) {
        if let Some(parts) = self.root.get(integrity::PARTS)
            && let Some(parts) =
                Object::new(self.log, "`sha256_of_parts`", &parts.value, &parts.key_span)
        {
            for member in parts.members() {
                parts.text(&member.key);
            }
        }
        let file = &self.log.source.name;
        let note = |fact| (vec![Warning::new(file, fact)], false);
        let Some(stated) = self.root.get(integrity::DIGEST) else {
            return note(fact!("result-without-digest", file));
        };
        // it is JSON, and its root an object: this was read before
        let Ok(content) = serde_json::from_str::<Map<String, Value>>(&self.log.source.text) else {
            self.log.report(&stated.key_span, DiagnosticKind::SavedChanged { part: None });
            return (Vec::new(), true);
        };
        let found = integrity::digest(&content);
        if stated.value.value == Json::Text(found) {
            return (Vec::new(), true);
        }
        let changed = integrity::changed(&content);
        if self.accepted {
            let parts: Vec<&String> = changed.iter().take(MOST_CHANGES).collect();
            let parts = (!parts.is_empty()).then(|| fact!("changed-parts", parts));
            return note(fact!("result-changed", file, parts));
        }
        for part in changed.iter().take(MOST_CHANGES) {
            let place = self.place_of(part).unwrap_or(&stated.key_span);
            let part = Some(part.clone());
            self.log.report(place, DiagnosticKind::SavedChanged { part });
        }
        if changed.is_empty() {
            self.log.report(&stated.key_span, DiagnosticKind::SavedChanged { part: None });
        }
        (Vec::new(), true)
    }

    /// Where a part stands, by the keys that lead to it; `None` of one that is gone.
    fn place_of(&self, part: &str) -> Option<&Range<usize>> {
        let mut keys = part.split('/');
        let mut node = &self.root.get(keys.next()?)?.value;
        for key in keys {
            node = match &node.value {
                Json::Object(members) => &members.iter().find(|member| member.key == key)?.value,
                Json::List(items) => items.get(key.parse::<usize>().ok()?)?,
                _ => return None,
            };
        }
        Some(&node.span)
    }

    /// Whether all outputs that have ranks have as many.
    fn check_ranks(&self, outputs: &Object<'a>) {
        let mut first = None;
        for member in outputs.members() {
            let Json::Object(members) = &member.value.value else {
                continue;
            };
            let Some(ranks) = members.iter().find(|member| member.key == "ranks") else {
                continue;
            };
            if let Json::List(list) = &ranks.value.value
                && *first.get_or_insert(list.len()) != list.len()
            {
                let reason = "all outputs of a file have as many ranks, those of the same trials";
                self.log.report(&ranks.value.span, DiagnosticKind::SavedEntry { reason });
            }
        }
    }

    /// The ranks of an output: each whole number from 1 to their count once, here counted from 0.
    fn ranks(&self, object: &Object<'a>) -> Option<Arc<[u32]>> {
        let member = object.get("ranks")?;
        let list = object.numbers("ranks")?;
        let mut seen = vec![false; list.len()];
        let ranks = list.iter().map(|&rank| {
            let place = rank - 1.0;
            let fits = rank.fract() == 0.0 && place >= 0.0 && place < list.len() as f64;
            let seen = seen.get_mut(place as usize).filter(|_| fits)?;
            (!std::mem::replace(seen, true)).then_some(place as u32)
        });
        let ranks: Option<Vec<u32>> = ranks.collect();
        if ranks.is_none() || list.len() < 2 || list.len() > MOST_RANKS {
            let reason = "ranks are each whole number from 1 to their count once, two to a million";
            self.log.report(&member.value.span, DiagnosticKind::SavedEntry { reason });
            return None;
        }
        ranks.map(Arc::from)
    }

    fn coverage_probability(&self) -> Option<f64> {
        let key = "coverage_probability";
        let found = self.root.number(key)?;
        if found <= 0.0 || found >= 1.0 {
            let place = self.root.get(key).map_or(self.root.place(), |member| &member.value.span);
            self.log.report(place, DiagnosticKind::NotProbability { key: key.to_owned(), found });
        }
        Some(found)
    }

    fn common(&self) -> Option<Common> {
        let root = &self.root;
        let origin = root.needed("provenance")?;
        let origin = Object::new(self.log, "`provenance`", &origin.value, &origin.key_span)?;
        origin.needed("model_sha256")?;
        let model: Arc<str> = origin.text("model_sha256")?.into();
        let seed = origin.get("seed").and_then(|_| origin.whole("seed", 0, u64::MAX));
        let trials = origin.get("trials").and_then(|_| origin.whole("trials", 0, MOST_TRIALS));
        let trials = trials.filter(|trials| *trials > 0).map_or(f64::INFINITY, |of| of as f64);
        if let Some(files) = origin.get("files") {
            let files = Object::new(self.log, "`files`", &files.value, &files.key_span)?;
            for member in files.members() {
                files.text(&member.key);
            }
        }
        let scores = root.needed("scores")?;
        let scores = Object::new(self.log, "`scores`", &scores.value, &scores.key_span)?;
        for key in ["from", "step", "count"] {
            scores.needed(key);
        }
        let step = scores.number("step");
        if let (Some(step), Some(member)) = (step.filter(|s| *s <= 0.0), scores.get("step")) {
            let diagnostic = DiagnosticKind::NotPositive { key: "step".into(), found: step };
            self.log.report(&member.value.span, diagnostic);
        }
        let count = scores.whole("count", 2, MOST_QUANTILES);
        let from = scores.number("from");
        let roots = self.roots();
        let (from, step, count, roots) = (from?, step?, count?, roots?);
        Some(Common {
            scores: Scores { from, step, count: count as usize },
            correlations: self.root_correlations(&roots).into(),
            siblings: self.siblings(),
            known: roots.clone().into(),
            roots,
            model,
            trials,
            seed,
        })
    }

    fn roots(&self) -> Option<Vec<Root>> {
        self.root.needed("inputs")?;
        let list = self.root.list("inputs")?;
        let mut roots = Vec::with_capacity(list.len());
        for node in list {
            let object = Object::new(self.log, "an input of a result file", node, &node.span)?;
            for key in ["model_sha256", "name", "estimate", "standard_uncertainty"] {
                object.needed(key);
            }
            let named = (object.text("model_sha256")?.into(), object.text("name")?.into());
            let figures = RootFigures {
                estimate: object.number("estimate")?,
                standard_uncertainty: positive(&object, "standard_uncertainty")?,
                dof: or_infinite(&object, "dof"),
            };
            let occasion = occasion(&object);
            roots.push(Root {
                name: RootName::new(named, &occasion, &figures),
                unit: object.text("unit").unwrap_or("").to_owned(),
                distribution: object.text("distribution").unwrap_or("").to_owned(),
                estimate: figures.estimate,
                standard_uncertainty: figures.standard_uncertainty,
                standard_deviation: or_infinite(&object, "standard_deviation"),
                dof: figures.dof,
                occasion,
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
                self.log.report(&node.span, DiagnosticKind::SavedEntry { reason });
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
                self.log.report(&node.span, DiagnosticKind::SavedEntry { reason });
            }
            found.extend(entry);
        }
        found
    }

    fn output(
        &self,
        name: &str,
        object: &Object<'a>,
        common: &Common,
        intact: bool,
    ) -> Option<SavedOutput> {
        for key in ["unit", "estimate", "standard_uncertainty", "quantiles"] {
            object.needed(key);
        }
        let unit = unit(object, "unit");
        let estimate = object.number("estimate");
        let u = object.number("standard_uncertainty");
        let dof = or_infinite(object, "dof");
        let dof = if self.is_undefined(object) { f64::NAN } else { dof };
        // for people and other programs; here they are only checked
        if object.get("expanded_uncertainty").is_some_and(|m| m.value.value != Json::Null) {
            object.number("expanded_uncertainty");
        }
        let [interval, symmetric, _] =
            [("interval", true), ("symmetric_interval", false), ("shortest_interval", false)]
                .map(|(key, nullable)| self.interval(object, key, nullable));
        let quantiles = object.numbers("quantiles");
        let (unit, estimate, u, quantiles) = (unit?, estimate?, u?, quantiles?);
        let place = object.get("quantiles").map_or(object.place(), |member| &member.value.span);
        let constant = u == 0.0 && quantiles.windows(2).all(|pair| pair[0] == pair[1]);
        let sensitivities = self.sensitivities(object, common.roots.len())?;
        let ranks = self.ranks(object);
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
        if !intact {
            result_consistency::check(
                object,
                &StatedOutput {
                    estimate,
                    standard_uncertainty: u,
                    standard_deviation: saved.standard_deviation,
                    quantiles: &quantiles,
                    scores: common.scores,
                    sensitivities: sensitivities.as_deref(),
                    roots: &common.roots,
                    correlations: &common.correlations,
                },
            );
        }
        let worth = object.get("effective_trials");
        let worth = worth.and_then(|_| positive(object, "effective_trials"));
        let worth = worth.unwrap_or(f64::INFINITY).min(common.trials);
        let made = if constant {
            Constant::new(estimate).map(Distribution::from)
        } else {
            let origin = self.origin(name, unit.text(), &saved, sensitivities.as_deref(), common);
            let origin = Origin { ranks, trials: worth, ..origin };
            SavedResult::new(saved, common.scores, &quantiles, origin).map(Distribution::from)
        };
        let made = made.map_err(|error| {
            let place = object.get(error.parameter()).map_or(place, |member| &member.value.span);
            self.log.report(place, DiagnosticKind::Distribution { name: name.to_owned(), error });
        });
        let by_trials = symmetric.filter(|_| !constant);
        let by_trials = by_trials.map(|ends| ByTrials::saved(interval, ends, u, worth));
        Some(SavedOutput {
            by_trials,
            name: name.to_owned(),
            unit,
            distribution: made.ok()?,
            coverage_factor: optional(object, "coverage_factor"),
            sensitivities,
        })
    }

    /// Whether the degrees of freedom are said to be undefined.
    fn is_undefined(&self, object: &Object<'a>) -> bool {
        const ALLOWED: [&str; 3] = ["finite", "infinite", "undefined"];
        let status = object.text("dof_status");
        if let (Some(member), Some(found)) = (object.get("dof_status"), status)
            && !ALLOWED.contains(&found)
        {
            let (key, found) = ("dof_status".to_owned(), found.to_owned());
            let allowed = ALLOWED.map(str::to_owned).to_vec();
            self.log.report(&member.value.span, DiagnosticKind::NotOneOf { key, found, allowed });
        }
        status == Some("undefined")
    }

    /// The ends of an interval, where the file has it.
    fn interval(&self, object: &Object<'a>, key: &str, nullable: bool) -> Option<[f64; 2]> {
        let member = object.get(key)?;
        if nullable && member.value.value == Json::Null {
            return None;
        }
        let ends = <[f64; 2]>::try_from(object.numbers(key)?).ok();
        if ends.is_none() {
            let reason = "two ends of an interval are needed here";
            self.log.report(&member.value.span, DiagnosticKind::SavedEntry { reason });
        }
        ends
    }

    /// The sensitivity coefficients in the order of `inputs`; inside, `None` for null.
    #[allow(clippy::option_option)]
    fn sensitivities(&self, object: &Object<'a>, inputs: usize) -> Option<Option<Vec<f64>>> {
        let member = object.needed("sensitivities")?;
        if member.value.value == Json::Null {
            return Some(None);
        }
        let numbers = object.numbers("sensitivities")?;
        if numbers.len() != inputs {
            let reason = "as many sensitivity coefficients as `inputs` are needed here";
            self.log.report(&member.value.span, DiagnosticKind::SavedEntry { reason });
            return None;
        }
        Some(Some(numbers))
    }

    fn origin(
        &self,
        name: &str,
        unit: &str,
        saved: &Saved,
        sensitivities: Option<&[f64]>,
        common: &Common,
    ) -> Origin {
        let linear = sensitivities.is_some();
        let roots = match sensitivities {
            Some(sensitivities) => {
                let weights = common.roots.iter().zip(sensitivities).filter(|(_, c)| **c != 0.0);
                let weight = |root: &Root, c: f64| {
                    c * root.standard_uncertainty / saved.standard_uncertainty
                };
                weights.map(|(root, &c)| (root.clone(), weight(root, c))).collect()
            }
            None => {
                let figures = RootFigures {
                    estimate: saved.estimate,
                    standard_uncertainty: saved.standard_uncertainty,
                    dof: saved.dof,
                };
                let occasion = Occasion::default();
                let named = (self.hash.into(), name.into());
                let root = Root {
                    name: RootName::new(named, &occasion, &figures),
                    unit: unit.to_owned(),
                    distribution: "result".to_owned(),
                    estimate: saved.estimate,
                    standard_uncertainty: saved.standard_uncertainty,
                    standard_deviation: saved.standard_deviation,
                    dof: saved.dof,
                    occasion,
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
            known: common.known.clone(),
            siblings: common.siblings.iter().filter_map(sibling).collect(),
            model: common.model.clone(),
            trials: common.trials,
            seed: common.seed,
            ranks: None,
        }
    }
}

/// What tells an input of the file from its namesakes; nothing in those of older versions.
fn occasion(object: &Object<'_>) -> Occasion {
    let text = |key: &str| object.text(key).map(Arc::from);
    let replaced = text("replaced").unwrap_or_default();
    let follows = object.truth("follows_conditions") == Some(true);
    Occasion {
        data: text("data_sha256"),
        row: text("row"),
        follows: follows.then_some(replaced),
        certified: text("certified"),
    }
}

/// A number above zero.
fn positive(object: &Object<'_>, key: &str) -> Option<f64> {
    let found = object.number(key)?;
    if found > 0.0 {
        return Some(found);
    }
    let place = object.get(key).map_or(object.place(), |member| &member.value.span);
    object.log.report(place, DiagnosticKind::NotPositive { key: key.to_owned(), found });
    None
}

/// A number above zero; `None` for null or nothing.
fn optional(object: &Object<'_>, key: &str) -> Option<f64> {
    object.get(key).filter(|member| member.value.value != Json::Null)?;
    positive(object, key)
}

/// A number above zero; null or nothing for infinite.
fn or_infinite(object: &Object<'_>, key: &str) -> f64 {
    match object.get(key).map(|member| &member.value.value) {
        None | Some(Json::Null) => f64::INFINITY,
        Some(_) => positive(object, key).unwrap_or(f64::INFINITY),
    }
}
