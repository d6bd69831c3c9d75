//! A task from Rust, step by step.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::sync::Arc;

use super::check;
use super::{Coverage, ModelStatement, Row, Settings, Sharing, Task, TaskError, Trials, Variable};
use crate::distribution::{Correlation, Distribution, Input, Invalid};
use crate::model::formula::{Formula, ScaleMisfit, Scope, Typing, check_name};
use crate::model::typed::{Measurement, Typed};
use crate::model::{
    Capability, InputQuantity, Model, NumberForm, Output, Quantity, Recorder, Tolerance,
    recorded_values, variables,
};
use crate::propagate::Region;
use gumption_units::Unit;

/// Makes a [`Task`] of a typed measurement ([`Task::measurement`]) or of equations
/// ([`Task::builder`]), with conditions, correlations and settings. What is wrong is told by
/// [`TaskBuilder::build`].
///
/// ```
/// use gumption_engine::distribution::Input;
/// use gumption_engine::propagate::{Control, evaluate};
/// use gumption_engine::task::Task;
///
/// let task = Task::builder("calibration line")
///     .input("a", Input::normal(2.0, 0.01, "mV/K")?)
///     .input("b", Input::normal(0.5, 0.02, "mV")?)
///     .equation("V", "a * dT + b")
///     .output("V", "mV")
///     .conditions(&[("dT", "K")], [[0.0], [10.0]])
///     .correlate("a", "b", -0.5)
///     .trials(0)
///     .build()?;
/// let evaluation = evaluate(&task, &Control::default())?;
/// let last = evaluation.rows[1].outputs[0].gum.as_ref().ok_or("no derivative")?;
/// assert!((last.estimate - 20.5).abs() < 1e-12);
/// // (10 * 0.01)^2 + 0.02^2 - 2 * 0.5 * 0.1 * 0.02, up to rounding
/// assert!((last.standard_uncertainty - 0.0084_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[must_use = "a task is made by `build`"]
pub struct TaskBuilder {
    title: String,
    typed: Option<Typed>,
    inputs: Vec<GivenInput>,
    /// Input, name and distribution of what is added to it.
    components: Vec<(String, String, Input)>,
    equations: Vec<(String, String)>,
    check_units: bool,
    outputs: Vec<(String, String)>,
    tolerances: Vec<(String, Tolerance)>,
    requirements: Vec<(String, Requirement)>,
    /// Names of outputs that are covered together.
    regions: Vec<Vec<String>>,
    conditions: Vec<(String, String)>,
    /// The first of conditions that were given a second time.
    conditions_again: Option<String>,
    rows: Vec<Vec<f64>>,
    varying: Vec<(String, Varying)>,
    sharing: Vec<(String, Option<String>)>,
    correlations: Vec<(String, String, f64)>,
    settings: Settings,
}

/// An input as it was given.
#[derive(Debug)]
struct GivenInput {
    name: String,
    input: Input,
    /// Names and distributions of what is added to it.
    components: Vec<(String, Input)>,
}

/// What is asked of an output, or known of it, beside its tolerance.
#[derive(Debug)]
enum Requirement {
    Risk(f64),
    Prior(Arc<Distribution>),
    Capability(Capability),
}

impl Requirement {
    fn name(&self) -> &'static str {
        match self {
            Self::Risk(_) => "risk",
            Self::Prior(_) => "prior",
            Self::Capability(_) => "capability",
        }
    }

    /// Gives it to an output.
    fn give(&self, output: &mut Output) -> Result<(), TaskError> {
        let refuse =
            |reason| Err(TaskError::Requirement { of: output.quantity.name.clone(), reason });
        match self {
            Self::Risk(risk) if !(*risk > 0.0 && *risk < 0.5) => {
                refuse("has a risk that is not above 0 and below 0.5")
            }
            Self::Risk(_) | Self::Prior(_) if output.tolerance.is_none() => {
                refuse("has a risk or a prior, but no tolerance")
            }
            Self::Risk(risk) => {
                output.risk = Some(*risk);
                Ok(())
            }
            Self::Prior(prior) => {
                output.prior = Some(Arc::clone(prior));
                Ok(())
            }
            Self::Capability(Capability { relative, absolute, .. })
                if ![relative, absolute].iter().all(|part| **part >= 0.0 && part.is_finite()) =>
            {
                refuse("has a capability that is below 0 or no number")
            }
            Self::Capability(capability) => {
                output.capability = Some(*capability);
                Ok(())
            }
        }
    }
}

/// What is known of an input in a row, from the values of the conditions there.
enum Varying {
    /// Its estimate, as a formula of the conditions.
    Estimate(String),
    /// All of it.
    Whole(Box<PerRow>),
}

type PerRow = dyn Fn(&[f64]) -> Result<Distribution, Invalid> + Send + Sync;

impl fmt::Debug for Varying {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Estimate(formula) => f.debug_tuple("Estimate").field(formula).finish(),
            Self::Whole(_) => f.debug_tuple("Whole").finish_non_exhaustive(),
        }
    }
}

impl TaskBuilder {
    /// A task without anything.
    pub(super) fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            typed: None,
            inputs: Vec::new(),
            components: Vec::new(),
            equations: Vec::new(),
            check_units: true,
            outputs: Vec::new(),
            tolerances: Vec::new(),
            requirements: Vec::new(),
            regions: Vec::new(),
            conditions: Vec::new(),
            conditions_again: None,
            rows: Vec::new(),
            varying: Vec::new(),
            sharing: Vec::new(),
            correlations: Vec::new(),
            settings: Settings::default(),
        }
    }

    /// A task of a typed measurement with its inputs.
    pub(super) fn of<M: Measurement<Value = Input>>(measurement: M) -> Self {
        let typed = Typed::of::<M>();
        let values = measurement.into_values().into_iter();
        let inputs = typed.declaration.inputs.iter().zip(values).map(|(declared, mut input)| {
            if input.about.is_empty() {
                declared.about.trim().clone_into(&mut input.about);
            }
            GivenInput { name: declared.name.to_owned(), input, components: Vec::new() }
        });
        let inputs = inputs.collect();
        Self { typed: Some(typed), inputs, ..Self::new(typed.declaration.name) }
    }

    /// The title, for reports.
    pub fn title(self, title: &str) -> Self {
        Self { title: title.to_owned(), ..self }
    }

    /// An input quantity; of a typed measurement one that stands in place of the field of that name.
    pub fn input(mut self, name: &str, input: Input) -> Self {
        let typed = self.typed.is_some();
        match self.inputs.iter_mut().find(|given| typed && given.name == name) {
            Some(given) => given.input = input,
            None => {
                let (name, components) = (name.to_owned(), Vec::new());
                self.inputs.push(GivenInput { name, input, components });
            }
        }
        self
    }

    /// A further source of uncertainty of an input: a quantity that is added to it. In budgets it is
    /// called `input/component` and stands in the input's unit. It may be given in another unit of
    /// the same kind that has no zero of its own, such as a deviation in `K` of an input in `degC`;
    /// in one of another size a constant or a normal, rectangular, triangular, t or arc sine
    /// distribution.
    pub fn component(mut self, input: &str, component: &str, added: Input) -> Self {
        self.components.push((input.to_owned(), component.to_owned(), added));
        self
    }

    /// A quantity that a formula computes of inputs, conditions and the equations before. Formulas
    /// are as in model files: `4*m/(pi*d^2*h)`, every quantity in coherent SI units, and a number with
    /// a unit as `1.5 [mm]`.
    pub fn equation(mut self, name: &str, formula: &str) -> Self {
        self.equations.push((name.to_owned(), formula.to_owned()));
        self
    }

    /// Leaves the dimensions of formulas unchecked, for empirical ones: they compute with the numbers
    /// of the declared units, and nothing is converted.
    pub fn without_unit_check(self) -> Self {
        Self { check_units: false, ..self }
    }

    /// An output and the unit that it is given in. Without any, a typed measurement has all of its
    /// outputs, and equations have the quantity of the last one in its coherent unit.
    pub fn output(mut self, name: &str, unit: &str) -> Self {
        self.outputs.push((name.to_owned(), unit.to_owned()));
        self
    }

    /// The limits that a conforming value of an output lies within, in its unit.
    pub fn tolerance(mut self, output: &str, tolerance: Tolerance) -> Self {
        self.tolerances.push((output.to_owned(), tolerance));
        self
    }

    /// The risk of false acceptance that is wanted of an output with a tolerance, above 0 and below
    /// 0.5 (JCGM 106, 9.5); simple acceptance without one.
    pub fn risk(mut self, output: &str, risk: f64) -> Self {
        self.requirements.push((output.to_owned(), Requirement::Risk(risk)));
        self
    }

    /// What was known about the values of the items before measuring, in the output's unit: global
    /// risks (JCGM 106, 9) are computed with it.
    pub fn prior(mut self, output: &str, prior: impl Into<Distribution>) -> Self {
        self.requirements.push((output.to_owned(), Requirement::Prior(Arc::new(prior.into()))));
        self
    }

    /// The smallest expanded uncertainty that the laboratory may state of an output (CMC), in its
    /// unit.
    pub fn capability(mut self, output: &str, capability: Capability) -> Self {
        self.requirements.push((output.to_owned(), Requirement::Capability(capability)));
        self
    }

    /// A coverage region of two outputs or more together (JCGM 102), for the task's coverage
    /// probability.
    pub fn region(mut self, outputs: &[&str]) -> Self {
        self.regions.push(outputs.iter().map(|name| (*name).to_owned()).collect());
        self
    }

    /// The conditions by names and units, and their values row by row. Equations know them by their
    /// names. A typed measurement whose input has the name of a condition takes its value from it,
    /// provided that the input was given as a constant.
    pub fn conditions<R: Into<Vec<f64>>>(
        self,
        names: &[(&str, &str)],
        rows: impl IntoIterator<Item = R>,
    ) -> Self {
        let own = |(name, unit): &(&str, &str)| ((*name).to_owned(), (*unit).to_owned());
        let again = (!self.conditions.is_empty()).then(|| names.first()).flatten();
        let conditions_again = again.map(|(name, _)| (*name).to_owned()).or(self.conditions_again);
        Self {
            conditions_again,
            conditions: names.iter().map(own).collect(),
            rows: rows.into_iter().map(Into::into).collect(),
            ..self
        }
    }

    /// Moves an input's estimate to the value of a formula of the conditions, in the simplest case
    /// the name of one; its distribution keeps its shape.
    pub fn estimate(mut self, input: &str, formula: &str) -> Self {
        self.varying.push((input.to_owned(), Varying::Estimate(formula.to_owned())));
        self
    }

    /// What is known of an input in each row, by the values of the conditions there (all in their
    /// units, the distribution in the input's).
    pub fn distribution(
        mut self,
        input: &str,
        known: impl Fn(&[f64]) -> Result<Distribution, Invalid> + Send + Sync + 'static,
    ) -> Self {
        self.varying.push((input.to_owned(), Varying::Whole(Box::new(known))));
        self
    }

    /// Gives a variable (an input, or `input/component`) a value of its own in every row. Without
    /// it one unknown value holds for all rows.
    pub fn per_row(mut self, variable: &str) -> Self {
        self.sharing.push((variable.to_owned(), None));
        self
    }

    /// Gives a variable a value of its own for every value of a condition.
    pub fn per_condition(mut self, variable: &str, condition: &str) -> Self {
        self.sharing.push((variable.to_owned(), Some(condition.to_owned())));
        self
    }

    /// The correlation coefficient of two variables, from -1 to 1.
    pub fn correlate(mut self, first: &str, second: &str, coefficient: f64) -> Self {
        self.correlations.push((first.to_owned(), second.to_owned(), coefficient));
        self
    }

    /// All settings at once.
    pub fn settings(self, settings: Settings) -> Self {
        Self { settings, ..self }
    }

    /// The seed of the random streams.
    pub fn seed(mut self, seed: u64) -> Self {
        self.settings.seed = seed;
        self
    }

    /// The number of Monte Carlo trials (0 for the law of propagation alone), or
    /// [`Trials::Adaptive`].
    pub fn trials(mut self, trials: impl Into<Trials>) -> Self {
        self.settings.trials = trials.into();
        self
    }

    /// The coverage probability, or a [`Coverage`] by its factor.
    pub fn coverage(mut self, coverage: impl Into<Coverage>) -> Self {
        self.settings.coverage = coverage.into();
        self
    }

    /// The task.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn build(mut self) -> Result<Task, TaskError> {
        self.settings.check()?;
        self.check_once()?;
        for (name, component, added) in std::mem::take(&mut self.components) {
            let mut of = self.inputs.iter_mut().filter(|given| given.name == name);
            let given = of.next().ok_or_else(|| unknown("input", &name))?;
            given.components.push((component, in_unit_of(added, &given.name, &given.input.unit)?));
        }
        let conditions = self.condition_quantities()?;
        self.take_conditions(&conditions)?;
        self.check_names(&conditions)?;
        let inputs = self.input_quantities();
        let model = match self.typed {
            Some(typed) => self.typed_model(&typed, inputs, conditions)?,
            None => self.formula_model(inputs, conditions)?,
        };
        let variables = self.variables(&model)?;
        let regions = self.covered_together(&model.outputs)?;
        let correlations = self.correlations(&variables)?;
        let rows = self.known_rows(&model, &variables)?;
        let statement = match &self.typed {
            Some(typed) => ModelStatement::of_declaration(&typed.declaration),
            None => ModelStatement::of_formulas(self.equations),
        };
        let task = Task {
            title: self.title,
            statement,
            correlations,
            settings: self.settings,
            regions,
            ..Task::new(model, variables, rows)
        };
        task.check()?;
        for row in &task.rows {
            task.joint(row).map_err(|error| {
                let name = |v: usize| task.variables.get(v).map_or("", |v| v.name.as_str());
                let message = error.describe(&|v| format!("`{}`", name(v)));
                TaskError::Correlation { error, message }
            })?;
        }
        Ok(task)
    }

    /// The regions, by the numbers of their outputs.
    fn covered_together(&self, outputs: &[Output]) -> Result<Vec<Region>, TaskError> {
        let number = |name: &String| {
            let found = outputs.iter().position(|output| output.quantity.name == *name);
            found.ok_or_else(|| unknown("output", name))
        };
        let one = |names: &Vec<String>| {
            once("output of a region", names.iter())?;
            if names.len() < 2 {
                let range = "of two outputs or more";
                return Err(TaskError::Setting { name: "coverage region", range });
            }
            let outputs = names.iter().map(number).collect::<Result<_, _>>()?;
            Ok(Region { outputs, probability: None })
        };
        self.regions.iter().map(one).collect()
    }

    /// What can be given once is: of two, one would be lost.
    fn check_once(&self) -> Result<(), TaskError> {
        if let Some(of) = &self.conditions_again {
            return Err(TaskError::GivenTwice { what: "conditions", of: of.clone() });
        }
        once("output", self.outputs.iter().map(|(name, _)| name))?;
        for kind in ["risk", "prior", "capability"] {
            let of_kind = self.requirements.iter().filter(|(_, of)| of.name() == kind);
            once(kind, of_kind.map(|(name, _)| name))?;
        }
        once("tolerance", self.tolerances.iter().map(|(name, _)| name))?;
        once("estimate or distribution by the conditions", self.varying.iter().map(|(n, _)| n))?;
        once("rows of one value", self.sharing.iter().map(|(name, _)| name))
    }

    fn condition_quantities(&self) -> Result<Vec<Quantity>, TaskError> {
        let expected = self.conditions.len();
        let is_right =
            |row: &Vec<f64>| row.len() == expected && row.iter().all(|value| value.is_finite());
        if let Some(row) = self.rows.iter().position(|row| expected == 0 || !is_right(row)) {
            return Err(TaskError::Conditions { row, expected });
        }
        if self.rows.is_empty() && expected > 0 {
            return Err(TaskError::Conditions { row: 0, expected });
        }
        self.conditions.iter().map(|(name, unit)| quantity(name, unit)).collect()
    }

    /// Leaves out the constants of a typed measurement that conditions stand for.
    fn take_conditions(&mut self, conditions: &[Quantity]) -> Result<(), TaskError> {
        if self.typed.is_none() {
            return Ok(());
        }
        for condition in conditions {
            let is_it = |given: &GivenInput| given.name == condition.name;
            let Some(index) = self.inputs.iter().position(is_it) else { continue };
            if self.inputs[index].input.distribution.constant().is_none() {
                return Err(TaskError::NameTaken { name: condition.name.clone() });
            }
            self.inputs.remove(index);
        }
        Ok(())
    }

    fn check_names(&self, conditions: &[Quantity]) -> Result<(), TaskError> {
        let inputs = self.inputs.iter().map(|given| given.name.as_str());
        let conditions = conditions.iter().map(|condition| condition.name.as_str());
        let equations = self.equations.iter().map(|(name, _)| name.as_str());
        let mut taken = HashSet::new();
        for name in inputs.chain(conditions).chain(equations) {
            // the fields of a struct are what they are
            if self.typed.is_none() {
                check_name(name)
                    .map_err(|error| TaskError::Name { name: name.to_owned(), error })?;
            }
            if !taken.insert(name) {
                return Err(TaskError::NameTaken { name: name.to_owned() });
            }
        }
        Ok(())
    }

    fn input_quantities(&self) -> Vec<InputQuantity> {
        let one = |given: &GivenInput| {
            let Input { unit, about, .. } = given.input.clone();
            let quantity = Quantity { name: given.name.clone(), unit, about };
            InputQuantity { quantity, parts: 1 + given.components.len() }
        };
        self.inputs.iter().map(one).collect()
    }

    fn typed_model(
        &self,
        typed: &Typed,
        inputs: Vec<InputQuantity>,
        conditions: Vec<Quantity>,
    ) -> Result<Model, TaskError> {
        if let Some((name, _)) = self.equations.first() {
            return Err(TaskError::TypedEquations { name: name.clone() });
        }
        let given: HashMap<&str, &Unit> = inputs
            .iter()
            .map(|input| &input.quantity)
            .chain(&conditions)
            .map(|quantity| (quantity.name.as_str(), &quantity.unit))
            .collect();
        for input in &inputs {
            let name = &input.quantity.name;
            typed.input(name).ok_or_else(|| unknown("input", name))?;
        }
        for declared in typed.declaration.inputs {
            let expected = unit(declared.name, declared.unit)?;
            match given.get(declared.name) {
                Some(found) => declared_scale(declared.name, found, &expected)?,
                None if declared.default.is_none() => {
                    return Err(TaskError::Missing { input: declared.name.to_owned() });
                }
                _ => {}
            }
        }
        let of = typed.declaration.name;
        let declared =
            typed.outputs().map_err(|error| TaskError::Unit { of: of.to_owned(), error })?;
        let outputs = if self.outputs.is_empty() {
            declared
        } else {
            let one = |(name, text): &(String, String)| {
                let mut own = declared.iter().filter(|output| output.quantity.name == *name);
                let own = own.next().ok_or_else(|| unknown("output", name))?;
                let unit = unit(name, text)?;
                declared_scale(name, &unit, &own.quantity.unit)?;
                let factor = Unit::conversion_factor(&own.quantity.unit, &unit)
                    .map_err(|_| wrong_unit(name, &unit, &own.quantity.unit))?;
                let period = own.period.map(|period| period * factor);
                let quantity = Quantity { unit, ..own.quantity.clone() };
                Ok(Output { quantity, period, ..own.clone() })
            };
            self.outputs.iter().map(one).collect::<Result<_, _>>()?
        };
        let outputs = self.with_tolerances(outputs)?;
        Ok(typed.model_with(inputs, conditions, outputs))
    }

    fn formula_model(
        &self,
        inputs: Vec<InputQuantity>,
        conditions: Vec<Quantity>,
    ) -> Result<Model, TaskError> {
        let last = self.equations.last().ok_or(TaskError::NoModel)?;
        let mut scope = condition_scope(&conditions);
        for input in &inputs {
            scope.define(&input.quantity.name, Typing::in_unit(&input.quantity.unit));
        }
        if !self.check_units {
            for of in inputs.iter().map(|input| &input.quantity).chain(&conditions) {
                scope.declare(&of.name, of.unit.clone());
            }
        }
        for (name, _) in &self.equations {
            scope.announce(name);
        }
        let recorder = Recorder::default();
        let form = self.number_form();
        let given = recorded_values(&recorder, &inputs, &conditions, form).into_iter();
        let mut values: HashMap<String, _> = given.collect();
        for (name, text) in &self.equations {
            let formula = self.formula(name, text, &scope)?;
            scope.define(name, formula.1);
            let value = formula.0.record(&scope, &values).map_err(in_formula(name))?;
            values.insert(name.clone(), value);
        }
        let coherent = |name: &str| {
            let dimension = scope.get(name).and_then(|typing| typing.dimension);
            dimension.map_or_else(Unit::one, Unit::coherent)
        };
        let mut outputs = Vec::new();
        for (name, text) in &self.outputs {
            let unit = unit(name, text)?;
            let typing = scope.get(name).ok_or_else(|| unknown("output", name))?;
            if self.check_units && !typing.fits(unit.dimension()) {
                return Err(wrong_unit(name, &unit, &coherent(name)));
            }
            if self.check_units {
                typing.reported_in(&unit).map_err(wrong_scale(name, &unit))?;
            }
            let quantity = Quantity { name: name.clone(), unit, about: String::new() };
            outputs.push(Output::new(quantity));
        }
        if outputs.is_empty() {
            let (name, unit) = (last.0.clone(), coherent(&last.0));
            outputs.push(Output::new(Quantity { name, unit, about: String::new() }));
        }
        let outputs = self.with_tolerances(outputs)?;
        let results = outputs.iter().map(|output| {
            let Quantity { name, unit, .. } = &output.quantity;
            let value = values.get(name).copied().ok_or_else(|| unknown("output", name))?;
            Ok(form.given(value, unit, scope.get(name).unwrap_or(Typing::ANY)))
        });
        let results = results.collect::<Result<Vec<_>, TaskError>>()?;
        let program = recorder.program(variables(&inputs, &conditions), &results);
        Ok(Model { inputs, conditions, outputs, program })
    }

    fn number_form(&self) -> NumberForm {
        if self.check_units { NumberForm::Coherent } else { NumberForm::Declared }
    }

    /// A formula that was read and checked, and what its result is.
    fn formula(&self, of: &str, text: &str, scope: &Scope) -> Result<(Formula, Typing), TaskError> {
        let formula = Formula::parse(text).map_err(in_formula(of))?;
        let checked =
            if self.check_units { formula.check(scope) } else { formula.check_names(scope) };
        match checked {
            Ok(typing) => Ok((formula, typing)),
            // never an empty list
            Err(errors) => match errors.into_iter().next() {
                Some(error) => Err(in_formula(of)(error)),
                None => Ok((formula, Typing::ANY)),
            },
        }
    }

    fn with_tolerances(&self, mut outputs: Vec<Output>) -> Result<Vec<Output>, TaskError> {
        for (name, tolerance) in &self.tolerances {
            let mut of = outputs.iter_mut().filter(|output| output.quantity.name == *name);
            of.next().ok_or_else(|| unknown("output", name))?.tolerance = Some(*tolerance);
        }
        for (name, requirement) in &self.requirements {
            let mut of = outputs.iter_mut().filter(|output| output.quantity.name == *name);
            requirement.give(of.next().ok_or_else(|| unknown("output", name))?)?;
        }
        Ok(outputs)
    }

    fn variables(&self, model: &Model) -> Result<Vec<Variable>, TaskError> {
        let mut variables = Vec::new();
        for given in &self.inputs {
            // the constant that components are added to has no uncertainty of its own
            let shown =
                given.components.is_empty() || given.input.distribution.constant().is_none();
            variables.push(Variable { shown, ..variable(&given.name, &given.input) });
            variables.extend(
                given.components.iter().map(|(component, input)| {
                    variable(&format!("{}/{component}", given.name), input)
                }),
            );
        }
        let mut names = HashSet::new();
        if let Some(twice) = variables.iter().find(|v| !names.insert(v.name.as_str())) {
            return Err(TaskError::NameTaken { name: twice.name.clone() });
        }
        for (name, condition) in &self.sharing {
            let sharing = match condition {
                None => Sharing::Row,
                Some(condition) => {
                    let is_it = |quantity: &Quantity| quantity.name == *condition;
                    let index = model.conditions.iter().position(is_it);
                    Sharing::Condition(index.ok_or_else(|| unknown("condition", condition))?)
                }
            };
            let mut of = variables.iter_mut().filter(|variable| variable.name == *name);
            of.next().ok_or_else(|| unknown("input", name))?.sharing = sharing;
        }
        Ok(variables)
    }

    fn correlations(&self, variables: &[Variable]) -> Result<Vec<Correlation>, TaskError> {
        let mut found: Vec<Correlation> = Vec::new();
        for (a, b, coefficient) in &self.correlations {
            let index = |name: &str| {
                let index = variables.iter().position(|variable| variable.name == name);
                index.ok_or_else(|| unknown("input", name))
            };
            let (i, j) = (index(a)?, index(b)?);
            let (first, second) = (i.min(j), i.max(j));
            check::coefficient([a, b], *coefficient)?;
            let refuse = |reason: &'static str| {
                Err(TaskError::Coefficient { between: [a.clone(), b.clone()], reason })
            };
            if found.iter().any(|c| c.first == first && c.second == second) {
                return refuse("is given twice");
            } else if !variables[i].sharing.is_alike(&variables[j].sharing, &self.rows) {
                return refuse(
                    "would tie rows to each other: they have not their values in common over the \
                     same rows",
                );
            }
            found.push(Correlation { first, second, coefficient: *coefficient });
        }
        Ok(found)
    }

    /// What is known of the variables in every row.
    fn known_rows(&self, model: &Model, variables: &[Variable]) -> Result<Vec<Row>, TaskError> {
        let parts = self.inputs.iter().flat_map(|given| {
            let own = std::iter::once(&given.input);
            own.chain(given.components.iter().map(|(_, input)| input))
        });
        let usual: Arc<[Arc<Distribution>]> =
            parts.map(|input| Arc::new(input.distribution.clone())).collect();
        let none = vec![Vec::new()];
        let rows = if self.conditions.is_empty() { &none } else { &self.rows };
        let (scope, form) = (condition_scope(&model.conditions), self.number_form());
        let mut varying = Vec::new();
        for (name, of) in &self.varying {
            let index = variables.iter().position(|variable| variable.name == *name);
            let index = index.ok_or_else(|| unknown("input", name))?;
            let formula = match of {
                Varying::Estimate(text) => {
                    let (formula, typing) = self.formula(name, text, &scope)?;
                    let unit = &variables[index].unit;
                    if self.check_units && !typing.fits(unit.dimension()) {
                        let found = typing.dimension.map_or_else(Unit::one, Unit::coherent);
                        return Err(wrong_unit(name, &found, unit));
                    }
                    let shift = match self.check_units {
                        true => typing.shift_to(unit).map_err(wrong_scale(name, unit))?,
                        false => 0.0,
                    };
                    Some((formula, shift))
                }
                Varying::Whole(_) => None,
            };
            varying.push((index, of, formula));
        }
        let known = |(number, row): (usize, &Vec<f64>)| {
            let mut distributions: Vec<Arc<Distribution>> = usual.to_vec();
            for (index, of, formula) in &varying {
                let Variable { name, unit, .. } = &variables[*index];
                let moved = match (of, formula) {
                    (Varying::Whole(known), _) => known(row),
                    (Varying::Estimate(_), None) => continue,
                    (Varying::Estimate(_), Some((formula, shift))) => {
                        let values = model.conditions.iter().zip(row);
                        let values = values
                            .map(|(of, &value)| (of.name.clone(), form.number(value, &of.unit)))
                            .collect();
                        let value = formula.evaluate(&scope, &values).map_err(in_formula(name))?;
                        distributions[*index].moved_to(match form {
                            NumberForm::Coherent => unit.value_from_si(value + shift),
                            NumberForm::Declared => value,
                        })
                    }
                };
                let moved = moved.map_err(|error| TaskError::Distribution {
                    input: name.clone(),
                    row: number,
                    error,
                })?;
                distributions[*index] = Arc::new(moved);
            }
            let distributions =
                if varying.is_empty() { Arc::clone(&usual) } else { distributions.into() };
            Ok(Row { conditions: row.clone(), distributions })
        };
        rows.iter().enumerate().map(known).collect()
    }
}

/// The variable of an input, with one value for all rows.
fn variable(name: &str, input: &Input) -> Variable {
    Variable {
        evaluation: input.evaluation,
        group: input.group.clone(),
        about: input.about.clone(),
        ..Variable::new(name, input.unit.clone())
    }
}

/// A component in the unit of the input that it is added to.
fn in_unit_of(component: Input, input: &str, unit: &Unit) -> Result<Input, TaskError> {
    if component.unit.text() == unit.text() {
        return Ok(component);
    }
    // a temperature in degC is no difference, and periods are no angle
    let is_difference = component.unit.zero().is_none() && component.unit.turn() == unit.turn();
    let factor = Unit::conversion_factor(&component.unit, unit).ok().filter(|_| is_difference);
    let distribution = match factor {
        Some(1.0) => Some(component.distribution.clone()),
        factor => factor.and_then(|factor| component.distribution.times(factor)),
    };
    match distribution {
        Some(distribution) => Ok(Input { distribution, unit: unit.clone(), ..component }),
        None => {
            let [found, expected] = [&component.unit, unit].map(Unit::to_string);
            Err(TaskError::ComponentUnit { of: input.to_owned(), found, expected })
        }
    }
}

fn once<'n>(
    what: &'static str,
    mut names: impl Iterator<Item = &'n String>,
) -> Result<(), TaskError> {
    let mut known = HashSet::new();
    match names.find(|name| !known.insert(name.as_str())) {
        Some(name) => Err(TaskError::GivenTwice { what, of: name.clone() }),
        None => Ok(()),
    }
}

fn condition_scope(conditions: &[Quantity]) -> Scope {
    conditions.iter().map(|of| (of.name.as_str(), Typing::in_unit(&of.unit))).collect()
}

fn quantity(name: &str, text: &str) -> Result<Quantity, TaskError> {
    Ok(Quantity { name: name.to_owned(), unit: unit(name, text)?, about: String::new() })
}

fn unit(of: &str, text: &str) -> Result<Unit, TaskError> {
    Unit::parse(text).map_err(|error| TaskError::Unit { of: of.to_owned(), error })
}

fn wrong_unit(of: &str, found: &Unit, expected: &Unit) -> TaskError {
    let (found, expected) = (found.to_string(), expected.to_string());
    TaskError::WrongUnit { of: of.to_owned(), found, expected }
}

fn wrong_scale(of: &str, unit: &Unit) -> impl Fn(ScaleMisfit) -> TaskError {
    move |misfit| TaskError::WrongScale { of: of.to_owned(), unit: unit.to_string(), misfit }
}

/// Refuses a unit that a typed measurement's quantity cannot be given in: one of another dimension,
/// or of another scale than the declared one, as K of a Celsius temperature.
fn declared_scale(of: &str, found: &Unit, declared: &Unit) -> Result<(), TaskError> {
    if !declared.is_compatible(found) {
        return Err(wrong_unit(of, found, declared));
    }
    Typing::in_unit(declared).reported_in(found).map_err(wrong_scale(of, found))
}

fn unknown(kind: &'static str, name: &str) -> TaskError {
    TaskError::Unknown { name: name.to_owned(), kind }
}

fn in_formula(of: &str) -> impl Fn(crate::model::formula::FormulaError) -> TaskError {
    move |error| TaskError::Formula { of: of.to_owned(), error }
}
