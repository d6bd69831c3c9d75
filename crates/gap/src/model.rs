//! A model whose named quantities effects can override: the model of the gap diagnosis.

use std::cell::RefCell;
use std::collections::HashMap;
use std::error::Error;
use std::fmt;

use gumption_engine::model::formula::{Formula, FormulaError, Scope, Typing};
use gumption_engine::model::typed::Typed;
use gumption_engine::model::{
    InputQuantity, Model, Output, Program, Quantity, Recorder, Traced, in_si, in_unit,
    recorded_values, variables,
};

/// What computes the outputs of a model.
#[derive(Clone, Debug)]
pub enum ModelForm {
    /// A typed model.
    Typed(Typed),
    /// Formulas in their order, each with the name of its quantity.
    Equations(Vec<(String, Formula)>),
}

/// A model that can be recorded anew with some of its quantities overridden.
#[derive(Clone, Debug)]
pub struct OverridableModel {
    /// The input quantities.
    pub inputs: Vec<InputQuantity>,
    /// The conditions of the measurement.
    pub conditions: Vec<Quantity>,
    /// The output quantities.
    pub outputs: Vec<Output>,
    /// What computes them.
    pub maker: ModelForm,
    /// What is known of every name.
    pub scope: Scope,
}

/// An effect that the model leaves out: quantities of the model that it changes, and its parameters.
#[derive(Clone, Debug)]
pub struct Effect {
    /// Its name.
    pub name: String,
    /// Its parameters; each hides a quantity of the model of the same name.
    pub parameters: Vec<Quantity>,
    /// Names of quantities and what they become. In a formula its own quantity's name means the
    /// value without this override; every other name is the quantity with all overrides, but in the
    /// override of an output the outputs are those before this effect.
    pub overrides: Vec<(String, Formula)>,
}

/// Why a model cannot be recorded with the overrides of effects.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum OverrideError {
    /// Quantities that need each other's results, in the order in which they do; the last needs the
    /// first.
    Circular {
        /// The quantities.
        names: Vec<String>,
    },
    /// Nothing computes a quantity that is used.
    Undefined {
        /// The quantity.
        name: String,
    },
    /// A formula has a mistake, which checking it tells as well.
    Formula(FormulaError),
}

impl fmt::Display for OverrideError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Circular { names } => {
                let circle = names.iter().chain(names.first()).map(|name| format!("`{name}`"));
                f.write_str(&circle.collect::<Vec<_>>().join(" needs "))
            }
            Self::Undefined { name } => write!(f, "nothing computes `{name}`"),
            Self::Formula(error) => error.fmt(f),
        }
    }
}

impl Error for OverrideError {}

impl OverridableModel {
    /// The model without any effect.
    ///
    /// # Errors
    /// As [`OverridableModel::program`].
    pub fn model(&self) -> Result<Model, OverrideError> {
        Ok(Model {
            program: self.program(&[])?,
            inputs: self.inputs.clone(),
            conditions: self.conditions.clone(),
            outputs: self.outputs.clone(),
        })
    }

    /// Whether a name is that of an output.
    pub fn is_output(&self, name: &str) -> bool {
        self.outputs.iter().any(|output| output.quantity.name == name)
    }

    /// The names that effects can override: inputs, quantities that formulas compute, outputs.
    pub fn overridable(&self) -> Vec<&str> {
        let mut names: Vec<&str> =
            self.inputs.iter().map(|input| input.quantity.name.as_str()).collect();
        if let ModelForm::Equations(equations) = &self.maker {
            names.extend(equations.iter().map(|(name, _)| name.as_str()));
        }
        for output in &self.outputs {
            if !names.contains(&output.quantity.name.as_str()) {
                names.push(&output.quantity.name);
            }
        }
        names
    }

    /// The program with these effects acting together, composed in their order. Its variables are
    /// the parts of the inputs, the conditions, then the effects' parameters, each in its own unit;
    /// its results are the outputs in their own units.
    ///
    /// # Errors
    /// Overrides that need each other's results, names that nothing computes, wrong formulas.
    pub fn program(&self, effects: &[&Effect]) -> Result<Program, OverrideError> {
        let recorder = Recorder::default();
        let first = variables(&self.inputs, &self.conditions);
        let mut next = first;
        let parameters = effects
            .iter()
            .map(|effect| {
                let named = effect.parameters.iter().map(|parameter| {
                    next += 1;
                    (parameter.name.as_str(), in_si(recorder.variable(next - 1), &parameter.unit))
                });
                named.collect()
            })
            .collect();
        let given = recorded_values(&recorder, &self.inputs, &self.conditions).into_iter();
        let making = Making {
            sim: self,
            effects,
            parameters,
            given: given.collect(),
            typed: RefCell::default(),
            made: RefCell::default(),
            open: RefCell::default(),
        };
        let outputs = making.outputs()?;
        let results: Vec<Traced<'_>> = self
            .outputs
            .iter()
            .zip(outputs)
            .map(|(output, value)| in_unit(value, &output.quantity.unit))
            .collect();
        Ok(recorder.program(next, &results))
    }
}

/// One recording: quantities are computed when they are asked for.
struct Making<'s, 'r> {
    sim: &'s OverridableModel,
    effects: &'s [&'s Effect],
    parameters: Vec<HashMap<&'s str, Traced<'r>>>,
    given: HashMap<String, Traced<'r>>,
    typed: RefCell<Option<Vec<Traced<'r>>>>,
    made: RefCell<HashMap<String, Traced<'r>>>,
    open: RefCell<Vec<String>>,
}

impl<'r> Making<'_, 'r> {
    /// The outputs with all effects, in SI units.
    fn outputs(&self) -> Result<Vec<Traced<'r>>, OverrideError> {
        let mut current: HashMap<&str, Traced<'r>> = HashMap::new();
        for output in &self.sim.outputs {
            let name = output.quantity.name.as_str();
            current.insert(name, self.quantity(name)?);
        }
        for (effect, parameters) in self.effects.iter().zip(&self.parameters) {
            let before = current.clone();
            for (name, formula) in &effect.overrides {
                if !self.sim.is_output(name) {
                    continue;
                }
                let value = self.formula(formula, effect, |used| {
                    let known = parameters.get(used).or_else(|| before.get(used)).copied();
                    known.map_or_else(|| self.quantity(used), Ok)
                })?;
                current.insert(name, value);
            }
        }
        let named = |output: &Output| {
            let name = output.quantity.name.as_str();
            current.get(name).copied().ok_or_else(|| undefined(name))
        };
        self.sim.outputs.iter().map(named).collect()
    }

    /// A quantity as the formulas after it see it: with all overrides, but an output as the model
    /// computes it, since overrides of outputs act last.
    fn quantity(&self, name: &str) -> Result<Traced<'r>, OverrideError> {
        if let Some(&value) = self.made.borrow().get(name) {
            return Ok(value);
        }
        let begun = self.open.borrow().iter().position(|open| open == name);
        if let Some(begun) = begun {
            let names = self.open.borrow().iter().skip(begun).cloned().collect();
            return Err(OverrideError::Circular { names });
        }
        self.open.borrow_mut().push(name.to_owned());
        let mut value = self.computed(name)?;
        if !self.sim.is_output(name) {
            for (effect, parameters) in self.effects.iter().zip(&self.parameters) {
                for (_, formula) in effect.overrides.iter().filter(|(of, _)| of == name) {
                    let before = value;
                    value = self.formula(formula, effect, |used| {
                        if let Some(&parameter) = parameters.get(used) {
                            Ok(parameter)
                        } else if used == name {
                            Ok(before)
                        } else {
                            self.quantity(used)
                        }
                    })?;
                }
            }
        }
        self.open.borrow_mut().pop();
        self.made.borrow_mut().insert(name.to_owned(), value);
        Ok(value)
    }

    /// A quantity from what it is computed of, before its own overrides.
    fn computed(&self, name: &str) -> Result<Traced<'r>, OverrideError> {
        if let Some(&value) = self.given.get(name) {
            return Ok(value);
        }
        match &self.sim.maker {
            ModelForm::Equations(equations) => {
                let Some((_, formula)) = equations.iter().find(|(of, _)| of == name) else {
                    return Err(undefined(name));
                };
                self.record(formula, &self.sim.scope, |used| self.quantity(used))
            }
            ModelForm::Typed(typed) => {
                let place = typed.output(name).map(|(place, _)| place);
                if self.typed.borrow().is_none() {
                    let mut values = HashMap::new();
                    for declared in typed.declaration.inputs {
                        if self.given.contains_key(declared.name) {
                            values.insert(declared.name, self.quantity(declared.name)?);
                        }
                    }
                    let outputs = typed.record_with(|name| values.get(name).copied());
                    *self.typed.borrow_mut() = Some(outputs);
                }
                let outputs = self.typed.borrow();
                let output = place.and_then(|place| outputs.as_ref()?.get(place).copied());
                output.ok_or_else(|| undefined(name))
            }
        }
    }

    /// An override's value.
    fn formula(
        &self,
        formula: &Formula,
        effect: &Effect,
        value: impl Fn(&str) -> Result<Traced<'r>, OverrideError>,
    ) -> Result<Traced<'r>, OverrideError> {
        self.record(formula, &effect.scope(&self.sim.scope), value)
    }

    fn record(
        &self,
        formula: &Formula,
        scope: &Scope,
        value: impl Fn(&str) -> Result<Traced<'r>, OverrideError>,
    ) -> Result<Traced<'r>, OverrideError> {
        let mut values = HashMap::new();
        for (used, _) in formula.names() {
            if !values.contains_key(used) {
                values.insert(used.to_owned(), value(used)?);
            }
        }
        formula.record(scope, &values).map_err(OverrideError::Formula)
    }
}

fn undefined(name: &str) -> OverrideError {
    OverrideError::Undefined { name: name.to_owned() }
}

impl Effect {
    /// What its formulas know: the model's names, its parameters in place of those of the same name.
    pub fn scope(&self, sim: &Scope) -> Scope {
        let mut scope = sim.clone();
        for parameter in &self.parameters {
            scope.define(parameter.name.as_str(), Typing::in_unit(&parameter.unit));
        }
        scope
    }
}
