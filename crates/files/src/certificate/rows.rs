//! The rows of a certificate, and the models that they ask for.

use std::collections::BTreeMap;
use std::ops::Range;

use super::super::conditions::{Conditions, is_same};
use super::super::constant_inputs::ConstantInputs;
use super::super::context::Context;
use super::super::keys;
use super::super::model_file::{self, ModelFile};
use super::super::model_readings::ModelReadings;
use super::super::output_limits;
use super::super::overrides::Override;
use super::super::readings_of_models::{self, ModelOfReadings};
use super::super::scopes::ConditionSet;
use super::super::settings;
use super::administrative::localized;
use super::layout::{self, OpenTable};
use super::{Asking, CertifiedModel};
use crate::open::is_no_object;
use gumption_analysis::certificate::contents::{Asked, LayoutTable, Line, StatedFunction};
use gumption_engine::model::{Capability, Quantity};
use gumption_engine::task::{Task, Warning};
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::value_text::{ValueOf, converts_alike, either_temperature};
use gumption_text::{Collector, Diagnostic, DiagnosticKind, Folder, Place};
use gumption_units::Unit;
use gumption_units::nearest;

/// At most so many rows: their correlations are a matrix.
const MOST_ROWS: usize = 1000;

/// What the rows ask for.
#[derive(Debug)]
pub(super) struct Read {
    pub(super) evaluations: Vec<Asked>,
    pub(super) lines: Vec<Line>,
    pub(super) functions: Vec<StatedFunction>,
    pub(super) models: Vec<CertifiedModel>,
    pub(super) warnings: Vec<Warning>,
    pub(super) places: Vec<Range<usize>>,
}

/// Rows that are being read.
pub(super) struct CertificateRows<'a> {
    log: &'a Collector,
    /// What reads the model files, and where these are looked for.
    files_in: (Context<'a>, Folder<'a>),
    /// The names of the tables.
    tables: Vec<Option<String>>,
    asking: Asking,
    /// The model files without replacements, by name; `None` after a mistake.
    files: BTreeMap<String, Option<usize>>,
    models: Vec<(CertifiedModel, Task)>,
    /// The readings of each model.
    readings: Vec<ModelReadings>,
    evaluations: Vec<Asked>,
    lines: Vec<Line>,
    functions: Vec<StatedFunction>,
    warnings: Vec<Warning>,
    places: Vec<Range<usize>>,
}

impl<'a> CertificateRows<'a> {
    pub(super) fn new(
        log: &'a Collector,
        files_in: (Context<'a>, Folder<'a>),
        tables: Vec<Option<String>>,
        asking: Asking,
    ) -> Self {
        Self {
            log,
            files_in,
            tables,
            asking,
            files: BTreeMap::new(),
            models: Vec::new(),
            readings: Vec::new(),
            evaluations: Vec::new(),
            lines: Vec::new(),
            functions: Vec::new(),
            warnings: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Reads all rows; one with several rows of conditions becomes as many.
    pub(super) fn read(&mut self, list: &'a [Node]) {
        for node in list {
            if self.log.is_full() {
                return;
            }
            self.row(node);
            if self.lines.len() > MOST_ROWS {
                let diagnostic = DiagnosticKind::TooMany {
                    what: "rows of a certificate",
                    found: self.lines.len(),
                    most: MOST_ROWS,
                };
                self.log.report(&node.span, diagnostic);
                return;
            }
        }
    }

    /// Reads a calibration function that is stated.
    pub(super) fn function(&mut self, node: &'a Node) {
        let mut read = || {
            let of = Object::new(self.log, "a function", node, &node.span)?;
            keys::check(&of, keys::CERTIFICATE_FUNCTION);
            let (model, fit) = (of.required("model"), of.required("fit"));
            let (model, fit) = (model?, fit?);
            let (name, wanted) = (of.text("model")?, of.text("fit")?);
            let label = localized(&of, "label");
            let file = self.file(name, model)?;
            let task = &self.models[file].1;
            let Some(curve) = task.curves.iter().find(|curve| curve.fit.name == wanted) else {
                let known = task.curves.iter().map(|curve| curve.fit.name.as_str());
                let reason = match (nearest(wanted, known), task.curves.is_empty()) {
                    (Some(near), _) => {
                        format!("`{name}` has no fit `{wanted}`; did you mean `{near}`?")
                    }
                    (None, true) => format!("`{name}` has no fits"),
                    (None, false) => format!("`{name}` has no fit `{wanted}`"),
                };
                self.log.report(&fit.value.span, DiagnosticKind::Certificate { reason });
                return None;
            };
            if curve.fit.is_complex() {
                let reason = format!(
                    "`{wanted}` is complex, and a certificate states real functions; state outputs of \
                     the model, such as its modulus at each frequency, as rows"
                );
                self.log.report(&fit.value.span, DiagnosticKind::Certificate { reason });
                return None;
            }
            let mut settings = task.settings;
            self.asking.apply(&mut settings);
            Some(StatedFunction { file, curve: curve.clone(), coverage: settings.coverage, label })
        };
        let function = read();
        self.functions.extend(function);
    }

    fn row(&mut self, node: &'a Node) -> Option<()> {
        let row = Object::new(self.log, "a row", node, &node.span)?;
        keys::check(&row, keys::CERTIFICATE_ROW);
        let model = row.required("model");
        let output = row.required("output");
        let name = model.and_then(|_| row.text("model"));
        let (model, name) = (model?, name?);
        let wanted = output.and_then(|_| row.text("output"));
        let file = self.file(name, model)?;
        let known: Vec<String> =
            self.models[file].1.model.outputs.iter().map(|o| o.quantity.name.clone()).collect();
        let (output, wanted) = (output?, wanted?);
        let Some(place) = known.iter().position(|name| name == wanted) else {
            let nearest = nearest(wanted, known.iter().map(String::as_str)).map(str::to_owned);
            let diagnostic = DiagnosticKind::UnknownOutput {
                name: wanted.to_owned(),
                nearest,
                known: known.into(),
            };
            self.log.report(&output.value.span, diagnostic);
            return None;
        };
        let table = layout::chosen(&row, &self.tables)?;
        let (evaluation, rows) = self.evaluation(&row, file, name)?;
        let quantity = self.evaluations[evaluation].task.model.outputs[place].clone();
        let unit = &quantity.quantity.unit;
        let task = &self.evaluations[evaluation].task;
        let conditions = Conditions {
            quantities: task.model.conditions.clone(),
            rows: rows
                .iter()
                .filter_map(|at| task.rows.get(*at))
                .map(|row| row.conditions.clone())
                .collect(),
            ..Conditions::default()
        };
        let constants = ConstantInputs::default();
        let set =
            ConditionSet { conditions: &conditions, check_units: true, constants: &constants };
        let own = output_limits::capability(&row, wanted, unit, &set);
        let label = localized(&row, "label");
        let nominal = row.get("nominal");
        let with_unit = nominal
            .and_then(|member| row.value_of("nominal", &member.value, unit, ValueOf::Either));
        for (at, conditions) in rows.into_iter().zip(&conditions.rows) {
            let capability = match &own {
                Some((capability, following)) => {
                    let following = following.as_ref().map(|following| following.at(conditions));
                    Some(Capability {
                        absolute: following.unwrap_or(capability.absolute),
                        ..*capability
                    })
                }
                None => quantity.at(conditions).capability,
            };
            let nominal = match (with_unit, nominal) {
                (Some(value), _) => Some(value?),
                (None, Some(member)) => Some(self.nominal(member, evaluation, at, unit)?),
                (None, None) => None,
            };
            let label = label.clone();
            self.lines.push(Line {
                evaluation,
                row: at,
                output: place,
                table,
                label,
                nominal,
                capability,
            });
            self.places.push(node.span.clone());
        }
        Some(())
    }

    /// The place of a model file among those of the certificate.
    fn file(&mut self, name: &str, member: &Member) -> Option<usize> {
        if let Some(known) = self.files.get(name) {
            return *known;
        }
        let found = self.model(name, member, &[]).map(|file| {
            for warning in &file.warnings {
                self.warnings.push(Warning { place: name.to_owned(), ..warning.clone() });
            }
            let ModelFile { task, source, files, readings, .. } = file;
            self.readings.push(readings);
            self.models.push((CertifiedModel { name: name.to_owned(), source, files }, task));
            self.models.len() - 1
        });
        self.files.insert(name.to_owned(), found);
        found
    }

    /// A model file with replacements; mistakes of the replacements are reported at `member`.
    fn model(&self, name: &str, member: &Member, overrides: &[Override]) -> Option<ModelFile> {
        let (files, folder) = self.files_in;
        let found = match model_file::named(files, folder, name, overrides) {
            Ok(found) => found,
            Err(reason) => {
                self.log.report(&member.value.span, reason);
                return None;
            }
        };
        let diagnostics = match found {
            Ok(file) => return Some(file),
            Err(diagnostics) => diagnostics,
        };
        for diagnostic in diagnostics.0 {
            let here = &member.value.span;
            // a table that the model names is no JSON anyway
            let is_model = diagnostic.source.name == self.files_in.1.shown(name);
            if let Some(message) = is_no_object(&diagnostic.source.text).filter(|_| is_model) {
                let message = format!("`{name}`: {message}");
                self.log.report(here, DiagnosticKind::Unreadable { message });
                return None;
            }
            match diagnostic.kind {
                DiagnosticKind::Unreadable { message } => {
                    let message = format!("`{name}`: {message}");
                    self.log.report(here, DiagnosticKind::Unreadable { message });
                }
                DiagnosticKind::Override { text, reason } => {
                    let reason = format!("`{text}`: {reason}");
                    self.log.report(here, DiagnosticKind::Certificate { reason });
                }
                kind => {
                    let Diagnostic { source, span, .. } = diagnostic;
                    self.log.report_at(Place { source, span }, kind);
                }
            }
        }
        None
    }

    /// The evaluation that a row asks for, and its rows of conditions.
    fn evaluation(
        &mut self,
        row: &Object<'a>,
        file: usize,
        name: &str,
    ) -> Option<(usize, Vec<usize>)> {
        let mut set = Vec::new();
        let mut chosen = Vec::new();
        let member = row.get("set");
        if let Some(member) = member {
            let object = Object::new(self.log, "`set`", &member.value, &member.key_span)?;
            for entry in object.members() {
                let value = match (entry.value.value.written(), &entry.value.value) {
                    (Some(text), _) => text.to_owned(),
                    (None, other) => {
                        let what = format!("`{}`", entry.key);
                        let expected = "a number, or a number with a unit in quotes";
                        let diagnostic =
                            DiagnosticKind::WrongType { what, found: other.kind(), expected };
                        self.log.report(&entry.value.span, diagnostic);
                        return None;
                    }
                };
                let plain = &self.models[file].1;
                match self.condition(plain, entry, &value)? {
                    Some(condition) => chosen.push(condition),
                    None => set.push((entry.key.clone(), value)),
                }
            }
        }
        let statement = settings::statement(row).or(self.asking.statement);
        let statement = statement.unwrap_or(self.models[file].1.settings.statement);
        let same = |asked: &Asked| {
            let asked_statement = asked.task.settings.statement;
            asked.file == file && asked.set == set && asked_statement == statement
        };
        let evaluation = match self.evaluations.iter().position(same) {
            Some(evaluation) => evaluation,
            None => {
                let overrides: Vec<Override> = set
                    .iter()
                    .filter_map(|(name, value)| Override::parse(&format!("{name}={value}")))
                    .collect();
                let mut task = match (overrides.as_slice(), member) {
                    ([], _) | (_, None) => self.models[file].1.clone(),
                    (overrides, Some(member)) => self.model(name, member, overrides)?.task,
                };
                self.asking.apply(&mut task.settings);
                task.settings.statement = statement;
                self.evaluations.push(Asked { model: name.to_owned(), file, set, task });
                self.evaluations.len() - 1
            }
        };
        let task = &self.evaluations[evaluation].task;
        let holds = |row: &usize| {
            let conditions = &task.rows[*row].conditions;
            chosen.iter().all(|(place, value)| is_same(conditions[*place], *value))
        };
        let rows: Vec<usize> = (0..task.rows.len()).filter(holds).collect();
        if rows.is_empty() {
            let reason =
                "no row of the model's conditions has all of these values at once".to_owned();
            let place = member.map_or(row.place(), |member| &member.value.span);
            self.log.report(place, DiagnosticKind::Certificate { reason });
            return None;
        }
        Some((evaluation, rows))
    }

    /// The condition that an entry of `set` chooses, with its value, if the model has rows with that
    /// value; nothing if something is to be replaced; `None` after a mistake.
    fn condition(&self, task: &Task, entry: &Member, value: &str) -> Option<Option<(usize, f64)>> {
        let named = |condition: &Quantity| condition.name == entry.key;
        let Some(place) = task.model.conditions.iter().position(named) else {
            return Some(None);
        };
        let (input, value) = (entry.key.clone(), value.to_owned());
        let text = format!("{input}={value}");
        let wanted = Override { text, input, field: None, value };
        let found = match wanted.value_in(&task.model.conditions[place].unit, &[]) {
            Ok(found) => found,
            Err(DiagnosticKind::Override { text, reason }) => {
                let reason = format!("`{text}`: {reason}");
                self.log.report(&entry.value.span, DiagnosticKind::Certificate { reason });
                return None;
            }
            Err(diagnostic) => {
                self.log.report(&entry.value.span, diagnostic);
                return None;
            }
        };
        let known = task.rows.iter().any(|row| is_same(row.conditions[place], found));
        Some(known.then_some((place, found)))
    }

    /// A nominal value in the output's unit: a number, or the name of a condition or an input.
    fn nominal(&self, member: &Member, evaluation: usize, row: usize, unit: &Unit) -> Option<f64> {
        let refuse = |reason: String| {
            self.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
            None
        };
        let name = match &member.value.value {
            Json::Number(text) => return text.parse().ok(),
            Json::Text(name) => name,
            other => {
                let what = "`nominal`".to_owned();
                let expected = "a number, a text with a number and its unit, or the name of a \
                                condition or an input";
                let diagnostic = DiagnosticKind::WrongType { what, found: other.kind(), expected };
                self.log.report(&member.value.span, diagnostic);
                return None;
            }
        };
        let Some((value, of)) = self.evaluations[evaluation].value(row, name) else {
            return refuse(format!(
                "there is no condition and no input `{name}` to take the nominal value from"
            ));
        };
        match Unit::convert(value, of, unit) {
            // the temperature at which an error in K was found is a column of its own
            Ok(_) if !converts_alike(of, unit) => refuse(format!(
                "the nominal value `{name}` is in `{of}`, and {}; the conditions of a row are shown by \
                 `\"conditions\"` at the root",
                either_temperature(unit)
            )),
            Ok(value) => Some(value),
            Err(_) => refuse(format!(
                "the nominal value `{name}` is in `{of}`, which cannot be converted to `{unit}`"
            )),
        }
    }

    /// Whether some model has a condition of that name.
    pub(super) fn check_condition(&self, name: &str, span: &Range<usize>) {
        let conditions = |task: &Task| -> Vec<String> {
            task.model.conditions.iter().map(|condition| condition.name.clone()).collect()
        };
        let known: Vec<String> =
            self.models.iter().flat_map(|(_, task)| conditions(task)).collect();
        if !self.models.is_empty() && !known.iter().any(|known| known == name) {
            let near = nearest(name, known.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            let reason = format!("no model of this certificate has a condition `{name}`{near}");
            self.log.report(span, DiagnosticKind::Certificate { reason });
        }
    }

    /// Whether some model has an input or a component of that name.
    pub(super) fn check_input(&self, name: &str, span: &Range<usize>) {
        let quantities = |task: &'_ Task| -> Vec<String> {
            let inputs = task.model.inputs.iter().map(|input| input.quantity.name.clone());
            inputs.chain(task.variables.iter().map(|variable| variable.name.clone())).collect()
        };
        let known: Vec<String> =
            self.models.iter().flat_map(|(_, task)| quantities(task)).collect();
        if !known.is_empty() && !known.iter().any(|known| known == name) {
            let nearest = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
            self.log.report(span, DiagnosticKind::NoSuchInput { name: name.to_owned(), nearest });
        }
    }

    /// The columns of the tables; none where an error was reported.
    pub(super) fn layout(&self, tables: Vec<OpenTable<'_>>) -> Vec<LayoutTable> {
        match self.log.is_clean() {
            true => layout::layout(tables, &self.lines, &self.evaluations),
            false => Vec::new(),
        }
    }

    /// Reports columns of a file of readings that belong to no model, or to more than one.
    fn check_readings(&self) {
        let Some(new) = self.files_in.0.readings else { return };
        // of a model with errors nothing is known
        if self.files.values().any(Option::is_none) {
            return;
        }
        let mut models = Vec::new();
        for ((model, task), readings) in self.models.iter().zip(&self.readings) {
            models.push(ModelOfReadings { name: &model.name, task, readings });
        }
        readings_of_models::check(self.log, new.file, &models);
    }

    /// What was read, with only those rows of conditions that are asked for; `None` after a mistake.
    pub(super) fn finish(mut self) -> Option<Read> {
        self.check_readings();
        if !self.log.is_clean() {
            return None;
        }
        for (number, asked) in self.evaluations.iter_mut().enumerate() {
            let mut lines: Vec<&mut Line> =
                self.lines.iter_mut().filter(|line| line.evaluation == number).collect();
            let mut used: Vec<usize> = lines.iter().map(|line| line.row).collect();
            used.sort_unstable();
            used.dedup();
            for line in &mut lines {
                line.row = used.partition_point(|row| *row < line.row);
            }
            let rows = std::mem::take(&mut asked.task.rows);
            let kept = rows.into_iter().enumerate().filter(|(row, _)| used.contains(row));
            asked.task.rows = kept.map(|(_, row)| row).collect();
        }
        let Self { models, evaluations, lines, functions, warnings, places, .. } = self;
        let models = models.into_iter().map(|(model, _)| model).collect();
        Some(Read { evaluations, lines, functions, models, warnings, places })
    }
}
