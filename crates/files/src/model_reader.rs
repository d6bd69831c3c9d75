//! The reader of model files and of the cases that are model files with observations.
//!
//! `serde_json` alone decides whether a text is JSON, so that what is accepted here is what every other
//! program accepts. Its parts of the text give each key and value its span of bytes (`json.rs`).
//!
//! A mistake does not end the reading: it is reported at its span, the reader goes on with what is
//! left, and a file is accepted where nothing was reported. What depends on something unreadable is
//! skipped and not reported again (a quantity whose unit is wrong fits every dimension; formulas are
//! not checked where the names of conditions are not known), so that one mistake gives one
//! diagnostic. [`ModelReader::found`] therefore goes in stages, each of which needs what those before
//! it have found:
//!
//! 1. keys, title, settings;
//! 2. the data: the table of observations, and the rows of conditions;
//! 3. the quantities: what computes the outputs, inputs with what is known of them, outputs;
//! 4. what only all of them together tell: names, size, correlations;
//! 5. the model, checked against the quantities, and the task of all that.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::conditions::{self, Conditions};
use super::constant_inputs::ConstantInputs;
use super::context::Context;
use super::counted_twice;
use super::dates;
use super::fits::{self, FitSet};
use super::formula_notes;
use super::input_set::InputSet;
use super::interpolated;
use super::model_checks::{
    Quantities, check_equations, check_formula_outputs, check_names, check_typed,
    imaginary_unit_hidden, units_not_checked, unknown_output,
};
use super::model_file::ModelFile;
use super::observations::{self, Observations};
use super::occasions;
use super::open::{FileKind, check_format, read_changed_root, refuse_other_kind};
use super::output_limits;
use super::outputs::{self, Outputs};
use super::overrides::{self, Override};
use super::reading_columns::ReadingColumns;
use super::results::ResultFiles;
use super::scopes::{ConditionSet, condition_scope, number_form, report_formula, typed_scope};
use super::simulated::{names_simulation, simulated};
use super::size::Size;
use super::{correlations, history, inputs, keys, regions, settings, simulator};
use gumption_engine::distribution::{Correlation, Fits};
use gumption_engine::model::formula::{Formula, constants};
use gumption_engine::model::typed::{Catalogue, CatalogueEntry};
use gumption_engine::model::{Model, Output, Quantity, Tolerance, typed};
use gumption_engine::number::Shortest;
use gumption_engine::regression::CurveFunction;
use gumption_engine::task::{ModelStatement, Row, Settings, Task, Trials, Warning};
use gumption_gap::{History, ModelForm, ObservedOutput, OverridableModel};
use gumption_text::json::{Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::table::{self, Table};
use gumption_text::{Collector, DiagnosticKind, Diagnostics, Folder, column_heading, notation};
use gumption_units::Unit;
use gumption_units::nearest;

/// How a model file is to be read.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModelOptions<'a> {
    /// The typed measurements that the file may name.
    pub(super) files: Context<'a>,
    /// Values in place of those of the file.
    pub(super) overrides: &'a [Override],
    /// A table of conditions in place of those of the data.
    pub(super) at: Option<&'a Path>,
}

impl<'a> ModelOptions<'a> {
    /// Of a file as it is.
    pub(super) fn with(files: Context<'a>) -> Self {
        Self { files, overrides: &[], at: None }
    }
}

/// What was found in a file.
#[derive(Debug)]
pub(super) struct FoundModel {
    pub(super) file: ModelFile,
    pub(super) sim: OverridableModel,
    /// What was measured of each output.
    pub(super) observed: Vec<Option<ObservedOutput>>,
    /// How many of the last conditions are columns of somebody else's simulation.
    pub(super) simulated: usize,
    /// Conditions that follow from the order of the rows, with their places.
    pub(super) history: Vec<(usize, History)>,
    /// The place of the condition that says when each row was taken.
    pub(super) clock: Option<usize>,
    /// Between which values each condition can be set, where the file says so.
    pub(super) reachable: Vec<Option<[f64; 2]>>,
    /// The condition that tells devices or days apart.
    pub(super) replication: Option<String>,
    /// The table of the data.
    pub(super) data: Option<Table>,
}

/// A model file that is being read.
#[derive(Debug)]
pub(super) struct ModelReader<'a> {
    pub(super) root: Object<'a>,
    pub(super) folder: Folder<'a>,
    pub(super) options: ModelOptions<'a>,
}

/// An equation: the quantity, where it stands unless it is a column of the data, and its formula if
/// that could be read.
pub(super) type Equation<'a> = (String, Option<&'a Member>, Option<Formula>);

/// What computes the outputs.
#[derive(Debug)]
pub(super) enum ModelBody<'a> {
    Typed(&'a CatalogueEntry, &'a Range<usize>),
    Equations(Vec<Equation<'a>>),
    Simulator(simulator::Given),
}

impl ModelBody<'_> {
    /// What the pages state of it. An output that is a column of the data has no equation.
    fn statement(&self) -> ModelStatement {
        match self {
            Self::Typed(entry, _) => ModelStatement::of_declaration(&entry.typed.declaration),
            Self::Simulator(_) => ModelStatement::of_formulas(std::iter::empty()),
            Self::Equations(equations) => {
                let written = equations.iter().filter(|(_, member, _)| member.is_some());
                ModelStatement::of_formulas(written.filter_map(|(name, _, formula)| {
                    Some((name.clone(), formula.as_ref()?.text().to_owned()))
                }))
            }
        }
    }
}

/// Observations, conditions, and which outputs are columns of the data.
struct Data {
    observations: Option<Observations>,
    conditions: Conditions,
    /// Outputs with the column that holds them.
    simulated: Vec<(String, String)>,
}

/// Reads and checks a text; `read` makes what is wanted of it.
pub(super) fn read_with<T>(
    name: &str,
    text: &str,
    folder: &Path,
    options: ModelOptions<'_>,
    read: impl FnOnce(&ModelReader<'_>) -> Option<T>,
) -> Result<T, Diagnostics> {
    let change = |log: &Collector, root: &mut Node| {
        // replaced values may be in units of the file's own
        let start = root.span.start..root.span.start;
        if matches!(root.value, Json::Object(_))
            && let Some(root) = Object::new(log, "a model file", root, &start)
        {
            own_units(&root);
        }
        dates::apply(log, root);
        notation::apply(log, root);
        overrides::apply(log, root, options.overrides);
    };
    read_changed_root(name, text, "a model file", change, |root| {
        let folder = options.files.folder(folder);
        read(&ModelReader { root, folder, options })
    })
}

impl<'a> ModelReader<'a> {
    /// All that the file holds, unless it has mistakes.
    pub(super) fn found(&self) -> Option<FoundModel> {
        if let Some(member) = self.root.get("simulator") {
            let reason = "is run by `gumption gap` alone".to_owned();
            self.root.log.report(&member.key_span, DiagnosticKind::Simulator { reason });
            return None;
        }
        self.found_with(false)
    }

    /// The same with conditions that follow from the order of the rows.
    pub(super) fn found_with_history(&self) -> Option<FoundModel> {
        self.found_with(true)
    }

    fn found_with(&self, history: bool) -> Option<FoundModel> {
        let root = &self.root;
        if refuse_other_kind(root, FileKind::Model) {
            return None;
        }
        keys::check(root, keys::MODEL);
        check_format(root, 2.0);
        own_units(root);
        let title = root.text("title").unwrap_or("").to_owned();
        let source = root.text("source").unwrap_or("").to_owned();
        let check_units = self.check_units();
        let mut settings = settings::read(root);
        settings.method = settings::method(root);

        let Data { mut observations, conditions, simulated } = self.data(history)?;
        let fits = self.fits(check_units)?;
        let given = match root.get("simulator") {
            Some(member) => simulator::read(root, member).map(Some),
            None => Some(None),
        };
        let body = given.and_then(|given| self.body(&simulated, given, &fits.curves));
        let results = ResultFiles::new(self.folder, self.options.files).with_curves(&fits.curves);
        let trials = self.options.files.trials(settings.trials);
        let mut quantities =
            self.quantities(conditions, check_units, &body, &results, &fits, trials)?;

        let mut files = std::mem::take(&mut quantities.conditions.files);
        if let Some(observations) = &mut observations {
            files.append(&mut observations.files);
        }
        files.extend(quantities.inputs.files.iter().cloned());
        files.extend(results.files.take());
        files.append(&mut results.certificates.borrow_mut().files);
        files.extend(fits.files);
        let joint = Fits::default();
        let (correlations, notes) = self.correlations(&quantities, &mut files, &joint, trials);
        let mut warnings = dates::notes(root);
        warnings.extend(quantities.inputs.warnings.iter().cloned());
        warnings.extend(fits.warnings);
        warnings.extend(notes);
        warnings.extend(results.warnings.take());
        let body = body?;
        let statement = body.statement();
        let given = match &body {
            ModelBody::Simulator(given) => Some(given.clone()),
            ModelBody::Typed(..) | ModelBody::Equations(_) => None,
        };
        let mut sim = self.sim(body, &mut quantities, &mut warnings, &mut files)?;
        let regions = regions::read(root, &sim.outputs);
        if !root.log.is_clean() {
            return None;
        }
        let observed = self.observed(observations.as_ref(), &sim)?;
        let conditions = &mut quantities.conditions;
        let simulated = match &given {
            Some(given) => simulator::add_conditions(root, given, &observed, &mut sim, conditions)?,
            None => simulated.len(),
        };
        let new = self.options.files.readings;
        if let Some(new) = new.filter(|_| quantities.inputs.readings.file.is_some()) {
            new.file.add_to(root.log, &mut files);
        }
        let are_swept = !quantities.conditions.quantities.is_empty();
        occasions::tell(&mut quantities.inputs, &files, self.options.overrides, are_swept);

        let reachable = std::mem::take(&mut quantities.conditions.reachable);
        let history = (quantities.conditions.measured..)
            .zip(std::mem::take(&mut quantities.conditions.history));
        let (history, clock) = (history.collect(), quantities.conditions.clock);
        let swept = root.get("conditions").is_some() || observations.is_some();
        let output_places = std::mem::take(&mut quantities.outputs.places);
        let evidence = std::mem::take(&mut quantities.inputs.evidence);
        let readings = std::mem::take(&mut quantities.inputs.readings);
        let model = sim.model().map_err(|error| {
            root.report(DiagnosticKind::Evaluation { message: error.to_string() });
        });
        let curves = fits.curves;
        let fits = joint;
        let parts =
            TaskParts { title, source, statement, settings, fits, swept, correlations, curves };
        let mut task = task(parts, model.ok()?, quantities)?;
        task.regions = regions;
        warnings.extend(fits::extrapolation::notes(root.log, &sim, &task, &task.curves));
        warnings.extend(counted_twice::notes(&task));
        let source = root.log.source.clone();
        let file = ModelFile { task, warnings, source, files, output_places, evidence, readings };
        let (data, replication) = match observations {
            Some(observed) => (Some(observed.table), observed.replication.map(|(name, _)| name)),
            None => (None, None),
        };
        Some(FoundModel {
            file,
            sim,
            observed,
            simulated,
            history,
            clock,
            reachable,
            replication,
            data,
        })
    }

    /// Whether units are checked. Where formulas are built in, their quantities have units of their own.
    fn check_units(&self) -> bool {
        let checked = self.root.truth("check_units").unwrap_or(true);
        if let Some(member) = self.root.get("check_units").filter(|_| !checked)
            && self.root.get("model").is_some()
        {
            let diagnostic = DiagnosticKind::OnlyWith { key: "check_units", with: "equations" };
            self.root.log.report(&member.key_span, diagnostic);
        }
        checked
    }

    /// The calibration functions; `None` after a mistake in one, without which formulas mean nothing.
    fn fits(&self, check_units: bool) -> Option<FitSet> {
        let Some(member) = self.root.get("fits") else { return Some(FitSet::default()) };
        if let Some(model) = self.root.get("model") {
            let diagnostic = DiagnosticKind::OnlyWith { key: "fits", with: "equations" };
            self.root.log.report(&model.key_span, diagnostic);
            return None;
        }
        fits::read(self.root.log, member, self.folder, number_form(check_units))
    }

    /// The table of the data and the rows of conditions.
    fn data(&self, history: bool) -> Option<Data> {
        let (root, log) = (&self.root, self.root.log);
        // columns that nothing names may hold remarks
        let named = ["observations", "conditions"].into_iter().filter_map(|key| root.get(key));
        let named: Vec<&str> = named.flat_map(|member| member.value.texts()).collect();
        let observations =
            root.get("observations").map(|m| observations::read(log, m, self.folder, &named));
        let unobserved = matches!(observations, Some(None));
        let observations = observations.flatten();
        let at = match self.options.at {
            Some(path) => {
                let name = path.display().to_string();
                let folder = Folder::of_the_user().holding(self.options.files.held);
                Some(table::read(log, folder, &name, &(0..0), Some(&named))?.0)
            }
            None => None,
        };
        let table = at.as_ref().or(observations.as_ref().map(|observations| &observations.table));
        let unreadable = || Conditions { unreadable: true, ..Conditions::none() };
        let mut conditions = match (root.get("conditions"), table) {
            // without the data nothing is known of the rows
            (Some(_), None) if unobserved => unreadable(),
            (Some(member), table) => {
                conditions::read(log, member, self.folder, table).unwrap_or_else(unreadable)
            }
            (None, Some(table)) => Conditions::rows_of(table),
            (None, None) => Conditions::none(),
        };
        let of_rows = table
            .zip(observations.as_ref().and_then(|observations| observations.replication.as_ref()));
        if let Some((table, (name, place))) = of_rows {
            replication_column(log, &mut conditions, table, name, place);
        }
        if let Some(of) = observations.as_ref().filter(|_| history && !conditions.unreadable) {
            history::add(root, of, at.as_ref(), &mut conditions);
        }
        let simulated = match &observations {
            Some(of) => simulated(root, of, table.unwrap_or(&of.table), &mut conditions),
            None => Vec::new(),
        };
        Some(Data { observations, conditions, simulated })
    }

    /// Inputs and outputs, and that their names are right and their number can be served.
    fn quantities(
        &self,
        conditions: Conditions,
        check_units: bool,
        body: &Option<ModelBody<'a>>,
        results: &ResultFiles<'_>,
        fits: &FitSet,
        trials: Trials,
    ) -> Option<Quantities> {
        let (root, log) = (&self.root, self.root.log);
        let constants = root.get("inputs").map_or_else(ConstantInputs::default, |member| {
            ConstantInputs::read(log, member, self.options.overrides, check_units)
        });
        let of_inputs =
            ConditionSet { conditions: &conditions, check_units, constants: &constants };
        let none = ConstantInputs::default();
        let set = ConditionSet { constants: &none, ..of_inputs };
        let new = self.options.files.readings;
        let new = new.and_then(|new| ReadingColumns::read(log, new, &conditions));
        let mut inputs = match root.get("inputs") {
            Some(member) => {
                let (replaced, new) = (self.options.overrides, new.as_ref());
                inputs::read(log, member, &of_inputs, replaced, results, new, trials)
            }
            // somebody else's simulation needs none
            None if names_simulation(root) || root.get("fits").is_some() => {
                Some(InputSet::default())
            }
            None => root.required("inputs").and(None),
        };
        if let (Some(new), Some(inputs)) = (&new, &mut inputs) {
            new.finish(inputs, self.options.overrides);
        }
        let outputs =
            root.required("outputs").and_then(|member| outputs::read(log, member, results, &set));
        let (mut inputs, outputs) = (inputs?, outputs.unwrap_or_default());
        fits.add_to(log, &mut inputs);
        let quantities = Quantities { inputs, conditions, outputs, check_units };
        check_names(root, &quantities, body);
        let rows = quantities.conditions.rows.len();
        let size = Size {
            rows,
            outputs: quantities.outputs.outputs.len(),
            variables: quantities.inputs.variables.len(),
        };
        if let (Some(diagnostic), Some(member)) = (size.excess(), root.get("outputs")) {
            log.report(&member.key_span, diagnostic);
            return None;
        }
        // without the names of the conditions nothing can be said about formulas
        (!quantities.conditions.unreadable).then_some(quantities)
    }

    fn correlations(
        &self,
        of: &Quantities,
        files: &mut Vec<(String, Vec<u8>)>,
        fits: &Fits,
        trials: Trials,
    ) -> (Vec<Correlation>, Vec<Warning>) {
        let rows = correlations::ConditionRows {
            conditions: of.conditions.quantities.iter().map(|c| c.name.clone()).collect(),
            rows: &of.conditions.rows,
        };
        correlations::read(&self.root, &of.inputs, &rows, self.folder, files, fits, trials)
    }

    /// The model, checked against the quantities, which it takes over.
    fn sim(
        &self,
        body: ModelBody<'a>,
        of: &mut Quantities,
        warnings: &mut Vec<Warning>,
        files: &mut Vec<(String, Vec<u8>)>,
    ) -> Option<OverridableModel> {
        let log = self.root.log;
        warnings.extend(formula_notes::of_conditions(&self.root, of));
        let (scope, maker) = match body {
            ModelBody::Typed(entry, place) => {
                for output in &mut of.outputs.outputs {
                    if let Some((_, declared)) = entry.typed.output(&output.quantity.name) {
                        fill_from_declaration(output, declared);
                    }
                }
                check_typed(log, entry, place, of);
                refuse_one_limit(log, &of.outputs);
                let scope = typed_scope(entry, &of.inputs, &of.conditions);
                output_limits::of_temperatures(log, &scope, of);
                (scope, ModelForm::Typed(entry.typed))
            }
            ModelBody::Simulator(given) => {
                let outputs = (&of.outputs.outputs[..], &of.outputs.places[..]);
                if of.outputs.without_unit.is_empty() {
                    simulator::check_outputs(&self.root, &given, outputs, of.check_units);
                }
                let scope = condition_scope(&of.conditions, of.check_units);
                let scope = simulator::scope(scope, &of.inputs, &given);
                check_formula_outputs(log, &scope, of);
                refuse_one_limit(log, &of.outputs);
                (scope, ModelForm::Simulated)
            }
            ModelBody::Equations(equations) => {
                let form = number_form(of.check_units);
                let tables = interpolated::read(log, self.folder, &equations, form, files);
                warnings.extend(tables.notes);
                let scope = check_equations(log, &equations, of, tables.tables);
                check_formula_outputs(log, &scope, of);
                output_limits::of_temperatures(log, &scope, of);
                refuse_one_limit(log, &of.outputs);
                if !of.check_units {
                    warnings.push(units_not_checked(&self.root, of));
                }
                warnings.extend(imaginary_unit_hidden(of, &equations));
                warnings.extend(formula_notes::of_formulas(log, &equations, &scope, of));
                let outputs = &of.outputs.outputs;
                warnings.extend(formula_notes::unused_inputs(&self.root, &equations, outputs));
                warnings.extend(formula_notes::placeholders(of));
                let formulas =
                    equations.into_iter().filter_map(|(name, _, formula)| Some((name, formula?)));
                (scope, ModelForm::Equations(formulas.collect()))
            }
        };
        log.is_clean().then(|| OverridableModel {
            scope,
            inputs: std::mem::take(&mut of.inputs.quantities),
            conditions: of.conditions.quantities.clone(),
            outputs: std::mem::take(&mut of.outputs.outputs),
            maker,
            numbers: number_form(of.check_units),
        })
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
                unknown_output(self.root.log, &column.output, &known, &column.place);
                clean = false;
            }
            let own = sim.outputs.iter().find(|output| output.quantity.name == column.output);
            for (heading, place, kind) in &column.headings {
                clean &= own.is_none_or(|own| {
                    column_heading::check(
                        self.root.log,
                        place,
                        heading,
                        (&own.quantity.unit, *kind),
                    )
                });
            }
        }
        let mut all = Vec::with_capacity(sim.outputs.len());
        for output in &sim.outputs {
            let named =
                |column: &&observations::ObservedColumn| column.output == output.quantity.name;
            let column = observations.columns.iter().find(named);
            let observed =
                column.map(|column| column.in_unit(self.root.log, &output.quantity.unit));
            clean &= !matches!(observed, Some(None));
            all.push(observed.flatten());
        }
        clean.then_some(all)
    }

    /// What computes the outputs; `simulated` are outputs with the column that holds them.
    fn body(
        &self,
        simulated: &[(String, String)],
        given: Option<simulator::Given>,
        curves: &[Arc<CurveFunction>],
    ) -> Option<ModelBody<'a>> {
        if let Some(given) = given {
            return Some(ModelBody::Simulator(given));
        }
        match (self.root.get("model"), self.root.get("equations")) {
            (Some(member), None) => {
                let name = self.root.text("model")?;
                let catalogue = self.options.files.catalogue;
                let entry = typed_model(self.root.log, catalogue, name, &member.value.span)?;
                Some(ModelBody::Typed(entry, &member.value.span))
            }
            (None, Some(member)) => {
                let mut equations = equations(self.root.log, member, curves)?;
                equations.extend(of_columns(simulated));
                Some(ModelBody::Equations(equations))
            }
            (Some(_), Some(second)) => {
                self.root.log.report(&second.key_span, DiagnosticKind::TwoModels);
                None
            }
            (None, None) if !simulated.is_empty() => {
                Some(ModelBody::Equations(of_columns(simulated).collect()))
            }
            (None, None) => {
                if !names_simulation(&self.root) {
                    self.root.report(DiagnosticKind::NoModel);
                }
                None
            }
        }
    }
}

/// The typed model of a name.
fn typed_model<'c>(
    log: &Collector,
    catalogue: &'c Catalogue,
    name: &str,
    place: &Range<usize>,
) -> Option<&'c CatalogueEntry> {
    let found = catalogue.find(name);
    if found.is_none() {
        let nearest = nearest(name, catalogue.iter().map(CatalogueEntry::name));
        let (name, nearest) = (name.to_owned(), nearest.map(str::to_owned));
        log.report(place, DiagnosticKind::UnknownModel { name, nearest });
    }
    found
}

/// The equations of a file, in order.
fn equations<'a>(
    log: &'a Collector,
    member: &'a Member,
    curves: &[Arc<CurveFunction>],
) -> Option<Vec<Equation<'a>>> {
    let object = Object::new(log, "`equations`", &member.value, &member.key_span)?;
    let formula = |member: &Member| match &member.value.value {
        Json::Text(text) => {
            let parsed = log.formula_with(text, curves);
            parsed.map_err(|error| report_formula(log, member, error)).ok()
        }
        other => {
            let (what, found) = (format!("`{}`", member.key), other.kind());
            let expected = "a formula in quotes";
            log.report(&member.value.span, DiagnosticKind::WrongType { what, found, expected });
            None
        }
    };
    let members = object.members().iter().take_while(|_| !log.is_full());
    Some(members.map(|member| (member.key.clone(), Some(member), formula(member))).collect())
}

/// Outputs that are columns of the data, as equations.
fn of_columns<'a>(simulated: &[(String, String)]) -> impl Iterator<Item = Equation<'a>> {
    simulated.iter().map(|(output, column)| (output.clone(), None, Formula::parse(column).ok()))
}

/// What a typed output says of itself where the file does not.
fn fill_from_declaration(output: &mut Output, declared: &typed::DeclaredOutput) {
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

/// Refuses tolerances with one limit of outputs that come round: every value lies on either side of it.
fn refuse_one_limit(log: &Collector, outputs: &Outputs) {
    for (output, place, _) in outputs.each() {
        let missing = match output.tolerance {
            Some(Tolerance { lower: None, .. }) => "lower",
            Some(Tolerance { upper: None, .. }) => "upper",
            _ => continue,
        };
        if let Some(period) = output.period {
            let Quantity { name, unit, .. } = &output.quantity;
            let (name, turn) = (name.clone(), unit.after(&Shortest(period).to_string()));
            log.report(place, DiagnosticKind::OneLimitOfPeriod { name, missing, turn });
        }
    }
}

/// The column that tells devices or days apart as a condition, unless it is one already.
fn replication_column(
    log: &Collector,
    conditions: &mut Conditions,
    table: &Table,
    name: &str,
    place: &Range<usize>,
) {
    match conditions.quantities.iter().find(|condition| condition.name == name) {
        None => conditions.add_column(table, name, Unit::one(), place),
        Some(condition) if condition.unit == Unit::one() => {}
        Some(condition) => {
            let reason = format!(
                "the condition `{name}` has the unit `{}`, but what tells devices or days apart is a \
                 plain number; leave its unit out",
                condition.unit.text()
            );
            log.report(place, DiagnosticKind::Observation { reason });
        }
    }
}

/// What a task has beside model and quantities.
struct TaskParts {
    title: String,
    source: String,
    statement: ModelStatement,
    settings: Settings,
    fits: Fits,
    swept: bool,
    correlations: Vec<Correlation>,
    curves: Vec<Arc<CurveFunction>>,
}

/// The task; none where something is not known about a variable, which has been reported.
fn task(parts: TaskParts, model: Model, of: Quantities) -> Option<Task> {
    let TaskParts { title, source, statement, settings, fits, swept, correlations, curves } = parts;
    let Quantities { inputs, conditions, .. } = of;
    if !inputs.known.is_complete(inputs.variables.len()) {
        return None;
    }
    let known = inputs.known.rows(conditions.rows.len());
    let rows = conditions.rows.into_iter().zip(known);
    let rows = rows.map(|(conditions, distributions)| Row { conditions, distributions }).collect();
    let mut task = Task::new(model, inputs.variables, rows);
    (task.title, task.swept, task.settings) = (title, swept, settings);
    (task.source, task.statement) = (source, statement);
    (task.correlations, task.fits, task.curves) = (correlations, fits, curves);
    Some(task)
}

/// Reads `units`: units of the file's own, each with what it is in known ones.
fn own_units(root: &Object<'_>) {
    let Some(member) = root.get("units") else { return };
    let log = root.log;
    let Some(object) = Object::new(log, "`units`", &member.value, &member.key_span) else { return };
    for member in object.members() {
        let Some(text) = object.text(&member.key) else { continue };
        let unit = |error| DiagnosticKind::Unit { unit: text.to_owned(), error };
        let Some(definition) = log.value(&member.value.span, Unit::parse(text).map_err(unit))
        else {
            continue;
        };
        let constant = constants().find(|constant| constant.symbol == member.key);
        let unit = match constant {
            Some(constant) => Err(format!("in formulas `[{}]` is {}", member.key, constant.about)),
            None => Unit::defined(&member.key, &definition).map_err(str::to_owned),
        };
        match unit {
            Ok(unit) => log.define_unit(unit),
            Err(reason) => {
                let diagnostic = DiagnosticKind::BadName { name: member.key.clone(), reason };
                log.report(&member.key_span, diagnostic);
            }
        }
    }
}
