//! A model file as a whole.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::bytes;
use super::condition_values::ConditionValues;
use super::conditions::{self, Conditions};
use super::inputs::{self, Inputs};
use super::json::{Json, Member, Node};
use super::object::Object;
use super::observations::Observations;
use super::outputs::{self, Outputs};
use super::problem::{Log, Problems};
use super::results::Results;
use super::size::Size;
use super::source::Source;
use super::table::{self, Table};
use super::{Fault, correlations, json, nearest, observations, settings};
use gumption_engine::distribution::Fits;
use gumption_engine::model::formula;
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::model::{InputQuantity, typed};
use gumption_engine::task::{Evidence, Row, Task, Warning};
use gumption_gap::{ModelBody, ObservedOutput, OverridableModel, OverrideError};
use gumption_measurements::{Entry, find};
use gumption_units::{Dimension, Unit};

/// A model file that was read and found right.
#[derive(Debug)]
pub struct ModelFile {
    /// The evaluation that it asks for.
    pub task: Task,
    /// Notes on what was read.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<Source>,
    /// The content of the tables that were read, by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// Where each output stands in the file, for messages of the evaluation.
    pub output_places: Vec<Range<usize>>,
    /// Readings that what is assumed about inputs can be tested against.
    pub evidence: Vec<Evidence>,
}

/// A replacement from the command line: `NAME=VALUE` or `NAME.field=VALUE`.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// The option's text.
    pub text: String,
    /// The input.
    pub input: String,
    /// The field, or none for the estimate.
    pub field: Option<String>,
    /// What to put there.
    pub value: String,
}

/// Replacements in the order of the command line.
pub type Overrides = Vec<Override>;

impl Override {
    /// Parses `NAME=VALUE` or `NAME.field=VALUE`; `None` if there is no `=` or no name.
    pub fn parse(text: &str) -> Option<Self> {
        let (name, value) = text.split_once('=')?;
        let (input, field) = match name.split_once('.') {
            Some((input, field)) => (input, Some(field.trim().to_owned())),
            None => (name, None),
        };
        let input = input.trim().to_owned();
        (!input.is_empty()).then(|| Self {
            text: text.to_owned(),
            input,
            field,
            value: value.trim().to_owned(),
        })
    }

    /// The value in `unit`: a number in it, or a number with a unit of its own.
    pub(super) fn value_in(&self, unit: &Unit) -> Result<f64, Fault> {
        let fault = |reason: String| Fault::Override { text: self.text.clone(), reason };
        if let Ok(value) = self.value.parse::<f64>() {
            if value.is_finite() {
                return Ok(value);
            }
            return Err(fault("the value must be a finite number".to_owned()));
        }
        let (number, text) = self.value.split_once(char::is_whitespace).ok_or_else(|| {
            fault("a number is needed, or one with a unit: \"35 deg\"".to_owned())
        })?;
        let number: f64 = number
            .parse()
            .ok()
            .filter(|n: &f64| n.is_finite())
            .ok_or_else(|| fault(format!("`{number}` is not a finite number")))?;
        let given = Unit::parse(text.trim()).map_err(|error| fault(error.to_string()))?;
        let factor = Unit::conversion_factor(&given, unit)
            .map_err(|_| fault(format!("`{given}` cannot be converted to `{unit}`")))?;
        Ok(number * factor)
    }
}

/// Reads and checks a model file.
///
/// # Errors
/// All mistakes of the file, in the order of their places.
pub fn read(path: &Path, overrides: &[Override]) -> Result<ModelFile, Problems> {
    read_file(path, overrides, None, |reader| reader.read())
}

/// Reads and checks a file; `read` makes what is wanted of it. `at` is a table of conditions in place
/// of those of the data.
pub(super) fn read_file<T>(
    path: &Path,
    overrides: &[Override],
    at: Option<&Path>,
    read: impl FnOnce(&ModelReader<'_>) -> Option<T>,
) -> Result<T, Problems> {
    let name = path.display().to_string();
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    match text_of(path) {
        Ok(text) => read_with(&name, &text, folder, (overrides, at), read),
        Err(message) => {
            let log = Log::new(Source::new(name, ""));
            log.report(&(0..0), Fault::Unreadable { message });
            Err(log.into_problems())
        }
    }
}

/// A file's text, or why there is none.
pub(super) fn text_of(path: &Path) -> Result<String, String> {
    let bytes = bytes::of_file(path, bytes::MOST)?;
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())
}

/// Reads and checks a model file's text; `name` is used in messages, and tables are looked for in
/// `folder`.
///
/// # Errors
/// All mistakes of the text, in the order of their places.
pub fn read_text(
    name: &str,
    text: &str,
    folder: &Path,
    overrides: &[Override],
) -> Result<ModelFile, Problems> {
    read_with(name, text, folder, (overrides, None), |reader| reader.read())
}

pub(super) fn read_with<T>(
    name: &str,
    text: &str,
    folder: &Path,
    (overrides, at): (&[Override], Option<&Path>),
    read: impl FnOnce(&ModelReader<'_>) -> Option<T>,
) -> Result<T, Problems> {
    let source = Source::new(name, text);
    let log = Log::new(source.clone());
    let file = match json::parse(&source) {
        Ok(mut node) => {
            override_fields(&log, &mut node, overrides);
            let whole = 0..source.text.find('\n').unwrap_or(source.text.len());
            Object::new(&log, "a model file", &node, &whole)
                .and_then(|root| read(&ModelReader { log: &log, root, folder, overrides, at }))
        }
        Err((span, fault)) => {
            log.report(&span, fault);
            None
        }
    };
    match file {
        Some(file) if log.is_clean() => Ok(file),
        _ => Err(log.into_problems()),
    }
}

/// Refuses a version of the file format that this program does not know.
pub(super) fn check_format(root: &Object<'_>) {
    if let Some(member) = root.get("format")
        && member.value.number() != Some(1.0)
    {
        let found = match &member.value.value {
            Json::Number(text) | Json::Text(text) => text.clone(),
            other => other.kind().to_owned(),
        };
        root.log.report(&member.value.span, Fault::UnknownFormat { found });
    }
}

/// Puts the values of `--set NAME.field=VALUE` into the tree.
fn override_fields(log: &Log, root: &mut Node, overrides: &[Override]) {
    let whole = root.span.start..root.span.start;
    for replaced in overrides {
        if override_condition(log, root, replaced) {
            continue;
        }
        let inputs = match &mut root.value {
            Json::Object(members) => members.iter_mut().find(|m| m.key == "inputs"),
            _ => None,
        };
        let inputs = match inputs.map(|m| &mut m.value.value) {
            Some(Json::Object(members)) => members,
            _ => return,
        };
        let names: Vec<String> = inputs.iter().map(|m| m.key.clone()).collect();
        let Some(input) = inputs.iter_mut().find(|m| m.key == replaced.input) else {
            let nearest = nearest(&replaced.input, names.iter().map(String::as_str));
            let reason = match nearest {
                Some(name) => format!("there is no input of that name; did you mean `{name}`?"),
                None => "there is no input of that name".to_owned(),
            };
            log.report(&whole, Fault::Override { text: replaced.text.clone(), reason });
            continue;
        };
        let (Some(field), Json::Object(fields)) = (&replaced.field, &mut input.value.value) else {
            continue;
        };
        let finite = replaced.value.parse::<f64>().is_ok_and(f64::is_finite);
        let value = if finite {
            Json::Number(replaced.value.clone())
        } else {
            Json::Text(replaced.value.clone())
        };
        match fields.iter_mut().find(|m| m.key == *field) {
            Some(member) => member.value.value = value,
            None => {
                let span = input.key_span.clone();
                fields.push(Member {
                    key: field.clone(),
                    key_span: span.clone(),
                    value: Node { span, value },
                });
            }
        }
    }
}

/// Puts one value in place of those of a condition of a grid; false if there is none of that name.
fn override_condition(log: &Log, root: &mut Node, replaced: &Override) -> bool {
    let Some((unit, values)) = condition_of_grid(root, &replaced.input) else {
        return false;
    };
    if replaced.field.is_some() {
        return false;
    }
    match replaced.value_in(&unit) {
        Ok(value) => {
            let span = values.span.clone();
            values.value = Json::List(vec![Node { span, value: Json::Number(value.to_string()) }]);
        }
        Err(fault) => log.report(&values.span, fault),
    }
    true
}

/// The values of a condition of a grid, and its unit.
fn condition_of_grid<'n>(root: &'n mut Node, name: &str) -> Option<(Unit, &'n mut Node)> {
    let condition = member_of(member_of(root, "conditions")?, name)?;
    let unit = match member_of(condition, "unit").map(|unit| &unit.value) {
        Some(Json::Text(text)) => Unit::parse(text).ok()?,
        _ => Unit::one(),
    };
    Some((unit, member_of(condition, "values")?))
}

fn member_of<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    match &mut node.value {
        Json::Object(members) => {
            members.iter_mut().find(|member| member.key == key).map(|member| &mut member.value)
        }
        _ => None,
    }
}

const KEYS: [&str; 21] = [
    "format",
    "title",
    "source",
    "about",
    "inputs",
    "correlations",
    "correlation_matrix",
    "conditions",
    "equations",
    "model",
    "outputs",
    "coverage_probability",
    "coverage_factor",
    "coverage_factor_fixed",
    "monte_carlo",
    "check_units",
    "allow_undefined",
    "observations",
    "effects",
    "catalogue",
    "prior",
];

/// What was found in a file.
pub(super) struct Found {
    pub(super) file: ModelFile,
    pub(super) sim: OverridableModel,
    /// What was measured of each output.
    pub(super) observed: Vec<Option<ObservedOutput>>,
    /// How many of the last conditions are columns of somebody else's simulation.
    pub(super) simulated: usize,
    /// The table of the data.
    pub(super) data: Option<Table>,
}

pub(super) struct ModelReader<'a> {
    pub(super) log: &'a Log,
    pub(super) root: Object<'a>,
    pub(super) folder: &'a Path,
    /// A table of conditions in place of those of the data.
    at: Option<&'a Path>,
    overrides: &'a [Override],
}

/// An equation: the quantity, where it stands unless it is a column of the data, and its formula if
/// that could be read.
type Equation<'a> = (String, Option<&'a Member>, Option<Formula>);

/// What computes the outputs.
enum Maker<'a> {
    Typed(Entry, &'a Range<usize>),
    Equations(Vec<Equation<'a>>),
}

impl<'a> ModelReader<'a> {
    fn read(&self) -> Option<ModelFile> {
        self.found().map(|found| found.file)
    }

    pub(super) fn found(&self) -> Option<Found> {
        let Self { log, root, .. } = self;
        root.check_keys(&KEYS);
        check_format(root);
        let title = root.text("title").unwrap_or("").to_owned();
        root.text("source");
        let check_units = root.truth("check_units").unwrap_or(true);
        let settings = settings::read(root);

        let observations =
            root.get("observations").map(|m| observations::read(log, m, self.folder));
        let unobserved = matches!(observations, Some(None));
        let mut observations = observations.flatten();
        let swept = root.get("conditions");
        let at = self.at.map(|path| {
            let name = path.display().to_string();
            table::read(log, Path::new(""), &name, &(0..0)).map(|(table, _)| table)
        });
        if matches!(at, Some(None)) {
            return None;
        }
        let at = at.flatten();
        let table = at.as_ref().or(observations.as_ref().map(|observations| &observations.table));
        let mut conditions = match (swept, table) {
            // without the data nothing is known of the rows
            (Some(_), None) if unobserved => Conditions { unreadable: true, ..Conditions::none() },
            (Some(member), table) => conditions::read(log, member, self.folder, table)
                .unwrap_or_else(|| Conditions { unreadable: true, ..Conditions::none() }),
            (None, Some(table)) => Conditions::rows_of(table),
            (None, None) => Conditions::none(),
        };
        let simulated = match &observations {
            Some(of) => self.simulated(of, table.unwrap_or(&of.table), &mut conditions),
            None => Vec::new(),
        };
        let maker = self.maker(&simulated);
        let results = Results::new(self.folder);
        let set = ConditionSet { conditions: &conditions, check_units };
        let inputs = match root.get("inputs") {
            Some(member) => inputs::read(log, member, &set, self.overrides, &results),
            // somebody else's simulation needs none
            None if self.names_simulation() => Some(Inputs::default()),
            None => root.required("inputs").and(None),
        };
        let outputs =
            root.required("outputs").and_then(|member| outputs::read(log, member, &results));
        let (inputs, outputs) = (inputs?, outputs.unwrap_or_default());
        self.names(&inputs, &conditions, &maker);
        let (rows, outputs_found) = (conditions.rows.len(), outputs.outputs.len());
        let size = Size { rows, outputs: outputs_found, variables: inputs.variables.len() };
        if let (Some(fault), Some(member)) = (size.fault(), root.get("outputs")) {
            log.report(&member.key_span, fault);
            return None;
        }
        if conditions.unreadable {
            // without the names of the conditions nothing can be said about formulas
            return None;
        }
        let mut files = std::mem::take(&mut conditions.files);
        if let Some(observations) = &mut observations {
            files.append(&mut observations.files);
        }
        files.extend(inputs.files.iter().cloned());
        files.extend(results.files.take());
        let swept_over = correlations::Rows {
            conditions: conditions.quantities.iter().map(|c| c.name.clone()).collect(),
            rows: &conditions.rows,
        };
        let fits = Fits::default();
        let (correlations, notes) =
            correlations::read(root, &inputs, &swept_over, self.folder, &mut files, &fits);
        let mut warnings = inputs.warnings.clone();
        warnings.extend(notes);
        let Outputs { mut outputs, places, unit_places, without_unit } = outputs;
        let unknown_units: HashSet<&str> =
            [&inputs.without_unit, &conditions.without_unit, &without_unit]
                .into_iter()
                .flatten()
                .map(String::as_str)
                .collect();
        let sim = match maker? {
            Maker::Typed(entry, place) => {
                for output in &mut outputs {
                    if let Some((_, declared)) = entry.typed.output(&output.quantity.name) {
                        fill_from_declaration(output, declared);
                    }
                }
                self.check_typed(
                    &entry,
                    place,
                    &inputs,
                    &conditions,
                    &outputs,
                    &places,
                    &unit_places,
                    &unknown_units,
                );
                if !log.is_clean() {
                    return None;
                }
                OverridableModel {
                    scope: typed_scope(&entry, &inputs, &conditions),
                    inputs: inputs.quantities,
                    conditions: conditions.quantities.clone(),
                    outputs,
                    maker: ModelBody::Typed(entry.typed),
                }
            }
            Maker::Equations(equations) => {
                let scope = self.check_equations(
                    &equations,
                    &inputs,
                    &conditions,
                    &unknown_units,
                    check_units,
                );
                self.check_formula_outputs(
                    &scope,
                    &outputs,
                    (&places, &unit_places),
                    &unknown_units,
                    check_units,
                );
                warnings.extend(celsius_as_kelvin(&scope, &outputs));
                if !log.is_clean() {
                    return None;
                }
                let equations = equations.into_iter();
                OverridableModel {
                    scope,
                    inputs: inputs.quantities,
                    conditions: conditions.quantities.clone(),
                    outputs,
                    maker: ModelBody::Equations(
                        equations.filter_map(|(name, _, formula)| Some((name, formula?))).collect(),
                    ),
                }
            }
        };
        if !inputs.known.is_complete(inputs.variables.len()) {
            return None;
        }
        let known = inputs.known.rows(conditions.rows.len());
        let rows = conditions
            .rows
            .into_iter()
            .zip(known)
            .map(|(conditions, distributions)| Row { conditions, distributions })
            .collect();
        let observed = self.observed(observations.as_ref(), &sim)?;
        let swept = swept.is_some() || observations.is_some();
        let not_recorded = |error: OverrideError| {
            self.root.report(Fault::Evaluation { message: error.to_string() });
        };
        let task = Task {
            title,
            model: sim.model().map_err(not_recorded).ok()?,
            variables: inputs.variables,
            correlations,
            rows,
            swept,
            settings,
            fits,
        };
        let source = log.source.clone();
        let evidence = inputs.evidence;
        let file = ModelFile { task, warnings, source, files, output_places: places, evidence };
        let data = observations.map(|observations| observations.table);
        Some(Found { file, sim, observed, simulated: simulated.len(), data })
    }

    /// What was measured of each output of the sim.
    fn observed(
        &self,
        observations: Option<&Observations>,
        sim: &OverridableModel,
    ) -> Option<Vec<Option<ObservedOutput>>> {
        let Some(observations) = observations else {
            return Some(vec![None; sim.outputs.len()]);
        };
        let mut clean = true;
        for column in &observations.columns {
            if !sim.is_output(&column.output) {
                let known: Arc<[String]> =
                    sim.outputs.iter().map(|output| output.quantity.name.clone()).collect();
                self.unknown_output(&column.output, &known, &column.place);
                clean = false;
            }
        }
        let of = |output: &gumption_engine::model::Output| {
            let named = |column: &&observations::Column| column.output == output.quantity.name;
            observations.columns.iter().find(named).map(|column| column.observed.clone())
        };
        clean.then(|| sim.outputs.iter().map(of).collect())
    }

    /// What computes the outputs; `simulated` are outputs with the column that holds them.
    fn maker(&self, simulated: &[(String, String)]) -> Option<Maker<'a>> {
        match (self.root.get("model"), self.root.get("equations")) {
            (Some(member), None) => {
                let name = self.root.text("model")?;
                if let Some(entry) = find(name) {
                    return Some(Maker::Typed(entry, &member.value.span));
                }
                let known = gumption_measurements::all();
                let nearest = nearest(name, known.iter().map(|e| e.typed.declaration.name));
                let fault = Fault::UnknownModel {
                    name: name.to_owned(),
                    nearest: nearest.map(str::to_owned),
                };
                self.log.report(&member.value.span, fault);
                None
            }
            (None, Some(member)) => {
                let object = Object::new(self.log, "`equations`", &member.value, &member.key_span)?;
                let mut equations = Vec::new();
                for member in object.members().iter().take_while(|_| !self.log.is_full()) {
                    let formula = match &member.value.value {
                        Json::Text(text) => Formula::parse(text)
                            .map_err(|error| report_formula(self.log, member, error))
                            .ok(),
                        other => {
                            let fault = Fault::WrongType {
                                what: format!("`{}`", member.key),
                                found: other.kind(),
                                expected: "a formula in quotes",
                            };
                            self.log.report(&member.value.span, fault);
                            None
                        }
                    };
                    equations.push((member.key.clone(), Some(member), formula));
                }
                equations.extend(of_columns(simulated));
                Some(Maker::Equations(equations))
            }
            (Some(_), Some(second)) => {
                self.log.report(&second.key_span, Fault::TwoModels);
                None
            }
            (None, None) if !simulated.is_empty() => {
                Some(Maker::Equations(of_columns(simulated).collect()))
            }
            (None, None) => {
                if !self.names_simulation() {
                    self.root.report(Fault::NoModel);
                }
                None
            }
        }
    }

    /// Names of all quantities: possible, and each used once.
    fn names(&self, inputs: &Inputs, conditions: &Conditions, maker: &Option<Maker<'a>>) {
        // names with the kind of quantity; a key that stands twice in one object is reported there
        let mut taken: HashMap<&str, usize> = HashMap::new();
        let inputs = inputs.quantities.iter().map(|q| q.quantity.name.as_str());
        let input_places = self.root.get("inputs").map(|m| match &m.value.value {
            Json::Object(members) => members.iter().map(|m| &m.key_span).collect(),
            _ => Vec::new(),
        });
        let mut named: Vec<(usize, &str, &Range<usize>)> = inputs
            .zip(input_places.unwrap_or_default())
            .map(|(name, place)| (0, name, place))
            .collect();
        let swept = conditions.quantities.iter().zip(&conditions.places);
        named.extend(swept.map(|(quantity, place)| (1, quantity.name.as_str(), place)));
        if let Some(Maker::Equations(equations)) = maker {
            let written = equations.iter().filter_map(|(_, member, _)| *member);
            named.extend(written.map(|m| (2, m.key.as_str(), &m.key_span)));
        }
        for (kind, name, place) in named {
            if let Err(error) = formula::check_name(name) {
                let (name, reason) = (name.to_owned(), error.to_string());
                self.log.report(place, Fault::BadName { name, reason });
            } else if taken.get(name).is_some_and(|&earlier| earlier != kind) {
                self.log.report(place, Fault::NameTaken { name: name.to_owned() });
            }
            taken.entry(name).or_insert(kind);
        }
    }

    #[allow(clippy::too_many_arguments)]
    fn check_typed(
        &self,
        entry: &Entry,
        place: &Range<usize>,
        inputs: &Inputs,
        conditions: &Conditions,
        outputs: &[gumption_engine::model::Output],
        output_places: &[Range<usize>],
        unit_places: &[Range<usize>],
        unknown_units: &HashSet<&str>,
    ) {
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
                self.check_unit(name, unit, first, place);
            } else if let Ok(declared) = Unit::parse(declared) {
                self.check_unit(name, unit, &declared, place);
            }
        };
        for (input, place) in inputs.quantities.iter().zip(&inputs.quantity_places) {
            let Quantity { name, unit } = Quantity::of(input);
            match entry.typed.input(name) {
                Some((_, declared)) => check(name, declared.unit, unit, place),
                None => {
                    let nearest = nearest(name, known.iter().map(String::as_str));
                    let fault = Fault::UnknownInput {
                        name: name.to_owned(),
                        model: model.clone(),
                        nearest: nearest.map(str::to_owned),
                        known: known.clone(),
                    };
                    self.log.report(place, fault);
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
                self.log.report(place, Fault::MissingInput { name, model: model.clone(), unit });
            }
        }
        let known: Arc<[String]> = declaration.outputs.iter().map(|o| o.name.to_owned()).collect();
        for ((output, place), unit_place) in outputs.iter().zip(output_places).zip(unit_places) {
            let name = &output.quantity.name;
            match entry.typed.output(name) {
                Some((_, declared)) => {
                    check(name, declared.unit, &output.quantity.unit, unit_place)
                }
                None => self.unknown_output(name, &known, place),
            }
        }
    }

    fn unknown_output(&self, name: &str, known: &Arc<[String]>, place: &Range<usize>) {
        let nearest = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
        let fault =
            Fault::UnknownOutput { name: name.to_owned(), nearest, known: Arc::clone(known) };
        self.log.report(place, fault);
    }

    fn check_unit(&self, name: &str, found: &Unit, expected: &Unit, place: &Range<usize>) {
        if !expected.is_compatible(found) {
            let shown = if expected.text().is_empty() { "1" } else { expected.text() };
            let fault = Fault::WrongDimension {
                name: name.to_owned(),
                found: found.to_string(),
                found_as: found.dimension().describe(),
                expected: shown.to_owned(),
                expected_as: expected.dimension().describe(),
            };
            self.log.report(place, fault);
        }
    }

    /// Checks the equations in order; gives what every name is.
    fn check_equations(
        &self,
        equations: &[Equation<'a>],
        inputs: &Inputs,
        conditions: &Conditions,
        unknown_units: &HashSet<&str>,
        check_units: bool,
    ) -> Scope {
        let mut scope = condition_scope(conditions);
        for input in &inputs.quantities {
            let Quantity { name, unit } = Quantity::of(input);
            let known = !unknown_units.contains(name);
            scope.define(name, if known { Typing::in_unit(unit) } else { Typing::ANY });
        }
        for (name, ..) in equations {
            scope.announce(name);
        }
        for (name, member, formula) in equations.iter().take_while(|_| !self.log.is_full()) {
            let result = match formula {
                Some(formula) if check_units => formula.check(&scope),
                Some(formula) => formula.check_names(&scope),
                None => Ok(Typing::ANY),
            };
            let typing = result.unwrap_or_else(|errors| {
                for error in errors {
                    if let Some(member) = member {
                        report_formula(self.log, member, error);
                    }
                }
                Typing::ANY
            });
            scope.define(name, typing);
        }
        scope
    }

    fn check_formula_outputs(
        &self,
        scope: &Scope,
        outputs: &[gumption_engine::model::Output],
        (places, unit_places): (&[Range<usize>], &[Range<usize>]),
        unknown_units: &HashSet<&str>,
        check_units: bool,
    ) {
        let known: Arc<[String]> = scope.names().map(str::to_owned).collect();
        for ((output, place), unit_place) in outputs.iter().zip(places).zip(unit_places) {
            let name = &output.quantity.name;
            let Some(typing) = scope.get(name) else {
                self.unknown_output(name, &known, place);
                continue;
            };
            let unit = &output.quantity.unit;
            let checked = check_units && !unknown_units.contains(name.as_str());
            if let Some(dimension) = typing.dimension.filter(|_| checked)
                && dimension != unit.dimension()
            {
                let fault = Fault::WrongDimension {
                    name: name.clone(),
                    found: unit.to_string(),
                    found_as: unit.dimension().describe(),
                    expected: coherent(dimension),
                    expected_as: dimension.describe(),
                };
                self.log.report(unit_place, fault);
            }
        }
    }
}

/// A coherent unit of a dimension, as text.
fn coherent(dimension: Dimension) -> String {
    Unit::coherent(dimension).to_string()
}

/// Name and unit of an input.
struct Quantity<'q> {
    name: &'q str,
    unit: &'q Unit,
}

impl<'q> Quantity<'q> {
    fn of(input: &'q InputQuantity) -> Self {
        Self { name: &input.quantity.name, unit: &input.quantity.unit }
    }
}

/// What a typed output says of itself where the file does not.
fn fill_from_declaration(
    output: &mut gumption_engine::model::Output,
    declared: &typed::DeclaredOutput,
) {
    if output.quantity.about.is_empty() {
        output.quantity.about = declared.about.trim().to_owned();
    }
    if let (None, Some(period), Ok(unit)) =
        (output.period, declared.period, Unit::parse(declared.unit))
    {
        let factor = Unit::conversion_factor(&unit, &output.quantity.unit);
        output.period = factor.ok().map(|factor| period * factor);
    }
}

/// Outputs in K of what is a number of degrees Celsius.
fn celsius_as_kelvin(scope: &Scope, outputs: &[gumption_engine::model::Output]) -> Vec<Warning> {
    outputs
        .iter()
        .map(|output| &output.quantity)
        .filter(|output| {
            let celsius = scope.get(&output.name).is_some_and(Typing::is_celsius);
            celsius && !output.unit.is_celsius()
        })
        .map(|output| {
            let text = format!(
                "`{}` comes from temperatures in degC, which formulas never shift, and is reported \
                 in {}; write kelvin(...) for a thermodynamic temperature, or report it in degC",
                output.name, output.unit
            );
            Warning::new("celsius-as-kelvin", &output.name, text)
        })
        .collect()
}

/// A formula's mistake at its place inside the JSON text.
pub(super) fn report_formula(log: &Log, member: &Member, error: formula::FormulaError) {
    let span = &member.value.span;
    let inner = error.span();
    let raw = log.source.text.get(span.start + 1..span.end.saturating_sub(1));
    let plain = raw.is_some_and(|raw| !raw.contains('\\'));
    // escapes in the JSON text would shift the place, so the whole text is underlined then
    let place = if plain {
        let start = (span.start + 1 + inner.start).min(span.end);
        start..(span.start + 1 + inner.end).clamp(start, span.end)
    } else {
        span.clone()
    };
    log.report(&place, Fault::Formula { error });
}

/// Outputs that are columns of the data, as equations.
fn of_columns<'a>(simulated: &[(String, String)]) -> impl Iterator<Item = Equation<'a>> {
    simulated.iter().map(|(output, column)| (output.clone(), None, Formula::parse(column).ok()))
}

/// What is known of the names of a typed model.
fn typed_scope(entry: &Entry, inputs: &Inputs, conditions: &Conditions) -> Scope {
    let mut scope = condition_scope(conditions);
    for input in &inputs.quantities {
        let Quantity { name, unit } = Quantity::of(input);
        scope.define(name, Typing::in_unit(unit));
    }
    for output in entry.typed.declaration.outputs {
        let unit = Unit::parse(output.unit).ok();
        scope.define(output.name, unit.map_or(Typing::ANY, |unit| Typing::in_unit(&unit)));
    }
    scope
}

fn condition_scope(conditions: &Conditions) -> Scope {
    let mut scope = Scope::default();
    for condition in &conditions.quantities {
        let known = !conditions.without_unit.contains(&condition.name);
        let typing = if known { Typing::in_unit(&condition.unit) } else { Typing::ANY };
        scope.define(&condition.name, typing);
    }
    scope
}

/// The conditions as estimates' formulas see them.
#[derive(Debug)]
struct ConditionSet<'c> {
    conditions: &'c Conditions,
    check_units: bool,
}

impl ConditionValues for ConditionSet<'_> {
    fn rows(&self) -> usize {
        self.conditions.rows.len()
    }

    fn check(&self, formula: &Formula, unit: &Unit) -> Result<(), Vec<Fault>> {
        if self.conditions.unreadable {
            return Ok(());
        }
        let scope = condition_scope(self.conditions);
        let result =
            if self.check_units { formula.check(&scope) } else { formula.check_names(&scope) };
        let faults = |errors: Vec<formula::FormulaError>| {
            errors.into_iter().map(|error| Fault::Formula { error }).collect::<Vec<_>>()
        };
        let typing = result.map_err(faults)?;
        match typing.dimension.filter(|_| self.check_units) {
            Some(dimension) if dimension != unit.dimension() => Err(vec![Fault::WrongDimension {
                name: "mean".to_owned(),
                found: coherent(dimension),
                found_as: dimension.describe(),
                expected: unit.to_string(),
                expected_as: unit.dimension().describe(),
            }]),
            _ => Ok(()),
        }
    }

    fn value(&self, formula: &Formula, row: usize) -> f64 {
        if self.conditions.unreadable {
            return 1.0;
        }
        let row = self.conditions.rows.get(row).map_or(&[][..], Vec::as_slice);
        let values: HashMap<String, f64> = self
            .conditions
            .quantities
            .iter()
            .zip(row)
            .map(|(quantity, &value)| (quantity.name.clone(), quantity.unit.to_si(value)))
            .collect();
        let scope = condition_scope(self.conditions);
        formula.evaluate(&scope, &values).unwrap_or(f64::NAN)
    }

    fn place(&self, name: &str) -> Option<usize> {
        if self.conditions.unreadable {
            return Some(0);
        }
        self.conditions.quantities.iter().position(|quantity| quantity.name == name)
    }

    fn names(&self) -> Vec<String> {
        self.conditions.quantities.iter().map(|quantity| quantity.name.clone()).collect()
    }
}

impl ModelFile {
    /// The place of an output in the file, for messages of the evaluation.
    pub fn output_place(&self, output: usize) -> (Arc<Source>, Range<usize>) {
        let span = self.output_places.get(output).cloned().unwrap_or(0..0);
        (self.source.clone(), span)
    }
}
