//! A model whose named quantities effects can override: the model of the gap diagnosis.

use std::collections::{HashMap, HashSet, VecDeque};
use std::error::Error;
use std::fmt;

use gumption_engine::model::formula::{Formula, FormulaError, Scope, Typing};
use gumption_engine::model::typed::Typed;
use gumption_engine::model::{
    InputQuantity, Model, NumberForm, Output, Program, Quantity, Recorder, Traced, recorded_values,
    variables,
};
use gumption_engine::number::{ComplexNumber, Number};

/// What computes the outputs of a model.
#[derive(Clone, Debug)]
pub enum ModelForm {
    /// A typed model.
    Typed(Typed),
    /// Formulas in their order, each with the name of its quantity.
    Equations(Vec<(String, Formula)>),
    /// A simulator: each output is the condition of the same name, whose values are those of its runs.
    Simulated,
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
    /// What formulas compute with.
    pub numbers: NumberForm,
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

/// Why a case cannot be diagnosed: a model that cannot be recorded with the overrides of effects, or
/// data that are none.
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
    /// Data, priors or rows of a case that do not belong together or are no numbers.
    Case {
        /// What is wrong.
        reason: String,
    },
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
            Self::Case { reason } => f.write_str(reason),
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
        let results = self.record(&recorder, effects)?;
        let parameters: usize = effects.iter().map(|effect| effect.parameters.len()).sum();
        let variables = variables(&self.inputs, &self.conditions) + parameters;
        Ok(recorder.program(variables, &results))
    }

    /// For each output whether other operations compute it once the effect acts.
    ///
    /// # Errors
    /// As [`OverridableModel::program`].
    pub fn changed_by(&self, effect: &Effect) -> Result<Vec<bool>, OverrideError> {
        // equal operations on equal operands stand only once in what one recorder records
        let recorder = Recorder::default();
        let mut results = self.record(&recorder, &[])?;
        results.extend(self.record(&recorder, &[effect])?);
        let program = recorder.program(0, &results);
        let (without, with) = program.outputs.split_at(self.outputs.len());
        Ok(without.iter().zip(with).map(|(without, with)| without != with).collect())
    }

    /// The outputs with these effects, in their own units.
    fn record<'r>(
        &self,
        recorder: &'r Recorder,
        effects: &[&Effect],
    ) -> Result<Vec<Traced<'r>>, OverrideError> {
        let mut next = variables(&self.inputs, &self.conditions);
        let parameters = effects
            .iter()
            .map(|effect| {
                let named = effect.parameters.iter().map(|parameter| {
                    next += 1;
                    let value = recorder.variable(next - 1);
                    let value = self.numbers.taken(value, &parameter.unit);
                    (parameter.name.as_str(), ComplexNumber::real(value))
                });
                named.collect()
            })
            .collect();
        let given = recorded_values(recorder, &self.inputs, &self.conditions, self.numbers);
        let given = with_complex(given, &self.inputs, self.numbers);
        let outputs = Making::new(self, effects, parameters, given).results()?;
        let results = self
            .outputs
            .iter()
            .zip(outputs)
            .map(|(output, value)| {
                let Quantity { name, unit, .. } = &output.quantity;
                let is_given =
                    |name: &String| self.inputs.iter().any(|input| input.quantity.name == *name);
                // the phase of a complex quantity is computed here, in radians
                let is_phase = name.ends_with(".arg") && !is_given(name);
                let numbers = if is_phase { NumberForm::Coherent } else { self.numbers };
                numbers.given(value.re, unit, self.scope.get(name).unwrap_or(Typing::ANY))
            })
            .collect();
        Ok(results)
    }
}

/// A recorded value, which may be complex.
type Value<'r> = ComplexNumber<Traced<'r>>;

/// One recording: quantities are computed when they are asked for.
///
/// Which quantity needs which is followed with a list, not by recursion: a file may chain as many
/// equations as it likes, and the depth of a stack is not ours to choose.
struct Making<'s, 'r> {
    sim: &'s OverridableModel,
    effects: &'s [&'s Effect],
    parameters: Vec<HashMap<&'s str, Value<'r>>>,
    /// What the formulas of each effect know.
    scopes: Vec<Scope>,
    equations: HashMap<&'s str, &'s Formula>,
    outputs: HashSet<&'s str>,
    given: HashMap<String, Value<'r>>,
    typed: Option<Vec<Traced<'r>>>,
    made: HashMap<&'s str, Value<'r>>,
}

/// What a quantity becomes, one after the other.
enum QuantityStep<'s> {
    /// The value of an equation.
    Equation(&'s Formula),
    /// The typed model's output of this number.
    Typed(usize),
    /// The override of the effect of this number.
    Override(usize, &'s Formula),
}

/// A quantity that was begun.
struct Begun<'s, 'r> {
    name: &'s str,
    value: Option<Value<'r>>,
    steps: VecDeque<QuantityStep<'s>>,
    /// What the first of the steps still needs.
    needs: VecDeque<&'s str>,
}

impl<'s, 'r> Making<'s, 'r> {
    fn new(
        sim: &'s OverridableModel,
        effects: &'s [&'s Effect],
        parameters: Vec<HashMap<&'s str, Value<'r>>>,
        given: HashMap<String, Value<'r>>,
    ) -> Self {
        let mut equations = HashMap::new();
        if let ModelForm::Equations(all) = &sim.maker {
            for (name, formula) in all {
                // a name that stands twice is a mistake that readers report
                equations.entry(name.as_str()).or_insert(formula);
            }
        }
        let outputs = sim.outputs.iter().map(|output| output.quantity.name.as_str()).collect();
        let scopes = effects.iter().map(|effect| effect.scope(&sim.scope)).collect();
        let (typed, made) = (None, HashMap::new());
        Self { sim, effects, parameters, scopes, equations, outputs, given, typed, made }
    }

    /// The outputs with all effects, in SI units.
    fn results(&mut self) -> Result<Vec<Value<'r>>, OverrideError> {
        let mut current: HashMap<&str, Value<'r>> = HashMap::new();
        for output in &self.sim.outputs {
            let name = output.quantity.name.as_str();
            current.insert(name, self.output(name)?);
        }
        for (number, effect) in self.effects.iter().enumerate() {
            let before = current.clone();
            for (name, formula) in &effect.overrides {
                if !self.outputs.contains(name.as_str()) {
                    continue;
                }
                let mut values = HashMap::new();
                for (used, _) in formula.names() {
                    let parameter =
                        self.parameters.get(number).and_then(|parameter| parameter.get(used));
                    let value = match parameter.or_else(|| before.get(used)) {
                        Some(&value) => value,
                        None => self.quantity(used)?,
                    };
                    values.insert(used.to_owned(), value);
                }
                current.insert(name, self.record(formula, Some(number), &values)?);
            }
        }
        let named = |output: &Output| {
            let name = output.quantity.name.as_str();
            current.get(name).copied().ok_or_else(|| undefined(name))
        };
        self.sim.outputs.iter().map(named).collect()
    }

    /// An output: a quantity, or a part of a complex one.
    fn output(&mut self, name: &'s str) -> Result<Value<'r>, OverrideError> {
        let whole = name.rsplit_once('.').filter(|_| !self.given.contains_key(name));
        let Some((whole, part)) = whole else { return self.quantity(name) };
        let value = self.quantity(whole)?;
        Ok(match part {
            "re" => value.real_part(),
            "im" => value.imaginary_part(),
            "abs" => value.abs(),
            "arg" => value.argument(),
            _ => return Err(undefined(name)),
        })
    }

    /// A quantity as the formulas after it see it: with all overrides, but an output as the model
    /// computes it, since overrides of outputs act last.
    fn quantity(&mut self, name: &'s str) -> Result<Value<'r>, OverrideError> {
        if let Some(&value) = self.made.get(name) {
            return Ok(value);
        }
        let mut begun = vec![self.begin(name)?];
        let mut names = HashSet::from([name]);
        while let Some(last) = begun.last_mut() {
            if let Some(need) = last.needs.pop_front() {
                if self.made.contains_key(need) {
                    continue;
                }
                if !names.insert(need) {
                    let circle = begun.iter().map(|quantity| quantity.name);
                    let names = circle.skip_while(|name| *name != need).map(str::to_owned);
                    return Err(OverrideError::Circular { names: names.collect() });
                }
                let next = self.begin(need)?;
                begun.push(next);
            } else if let Some(step) = last.steps.pop_front() {
                let value = self.step(last, &step)?;
                last.value = Some(value);
                last.needs = self.needs(last.name, last.steps.front());
            } else if let Some(Begun { name, value, .. }) = begun.pop() {
                names.remove(name);
                self.made.insert(name, value.ok_or_else(|| undefined(name))?);
            }
        }
        self.made.get(name).copied().ok_or_else(|| undefined(name))
    }

    /// What a quantity is made of: a value or what computes it, then its overrides.
    fn begin(&self, name: &'s str) -> Result<Begun<'s, 'r>, OverrideError> {
        // a quantity of the model may be called i
        let hidden = name == IMAGINARY_UNIT && self.equations.contains_key(name);
        let value = self.given.get(name).copied().filter(|_| !hidden);
        let mut steps = VecDeque::new();
        if value.is_none() {
            steps.push_back(match &self.sim.maker {
                ModelForm::Equations(_) => {
                    QuantityStep::Equation(self.equations.get(name).ok_or_else(|| undefined(name))?)
                }
                ModelForm::Typed(typed) => {
                    QuantityStep::Typed(typed.output(name).ok_or_else(|| undefined(name))?.0)
                }
                ModelForm::Simulated => return Err(undefined(name)),
            });
        }
        if !self.outputs.contains(name) {
            for (number, effect) in self.effects.iter().enumerate() {
                let own = effect.overrides.iter().filter(|(overridden, _)| overridden == name);
                steps.extend(own.map(|(_, formula)| QuantityStep::Override(number, formula)));
            }
        }
        let needs = self.needs(name, steps.front());
        Ok(Begun { name, value, steps, needs })
    }

    /// The quantities that a step of a quantity needs.
    fn needs(&self, name: &'s str, step: Option<&QuantityStep<'s>>) -> VecDeque<&'s str> {
        match step {
            None => VecDeque::new(),
            Some(QuantityStep::Equation(formula)) => {
                formula.names().map(|(used, _)| used).collect()
            }
            Some(QuantityStep::Override(number, formula)) => {
                let parameters = self.parameters.get(*number);
                let own = |used: &str| {
                    used == name || parameters.is_some_and(|parameter| parameter.contains_key(used))
                };
                formula.names().map(|(used, _)| used).filter(|used| !own(used)).collect()
            }
            Some(QuantityStep::Typed(_)) if self.typed.is_some() => VecDeque::new(),
            Some(QuantityStep::Typed(_)) => self.typed_inputs().collect(),
        }
    }

    /// The inputs of the typed model that the file gives.
    fn typed_inputs(&self) -> impl Iterator<Item = &'static str> {
        let declared = match &self.sim.maker {
            ModelForm::Typed(typed) => typed.declaration.inputs,
            ModelForm::Equations(_) | ModelForm::Simulated => &[],
        };
        declared.iter().map(|input| input.name).filter(|name| self.given.contains_key(*name))
    }

    /// A quantity's value after a step, all that the step needs being made.
    fn step(
        &mut self,
        of: &Begun<'s, 'r>,
        step: &QuantityStep<'s>,
    ) -> Result<Value<'r>, OverrideError> {
        let made = |making: &Self, used: &str| {
            making.made.get(used).copied().ok_or_else(|| undefined(used))
        };
        match *step {
            QuantityStep::Equation(formula) => {
                let mut values = HashMap::new();
                for (used, _) in formula.names() {
                    values.insert(used.to_owned(), made(self, used)?);
                }
                self.record(formula, None, &values)
            }
            QuantityStep::Override(number, formula) => {
                let mut values = HashMap::new();
                for (used, _) in formula.names() {
                    let parameter =
                        self.parameters.get(number).and_then(|parameter| parameter.get(used));
                    let value = match parameter {
                        Some(&parameter) => parameter,
                        None if used == of.name => of.value.ok_or_else(|| undefined(used))?,
                        None => made(self, used)?,
                    };
                    values.insert(used.to_owned(), value);
                }
                self.record(formula, Some(number), &values)
            }
            QuantityStep::Typed(place) => {
                if let (None, ModelForm::Typed(typed)) = (&self.typed, &self.sim.maker) {
                    let inputs: HashSet<&str> = self.typed_inputs().collect();
                    let value = |name: &str| {
                        let made = inputs.get(name).and_then(|name| self.made.get(name));
                        made.map(|value| value.re)
                    };
                    self.typed = Some(typed.record_with(value));
                }
                let output = self.typed.as_ref().and_then(|outputs| outputs.get(place));
                output.copied().map(ComplexNumber::real).ok_or_else(|| undefined(of.name))
            }
        }
    }

    /// A formula's value, as the model knows names or as an effect does.
    fn record(
        &self,
        formula: &Formula,
        effect: Option<usize>,
        values: &HashMap<String, Value<'r>>,
    ) -> Result<Value<'r>, OverrideError> {
        let scope = effect.and_then(|number| self.scopes.get(number)).unwrap_or(&self.sim.scope);
        formula.evaluate(scope, values).map_err(OverrideError::Formula)
    }
}

/// The imaginary unit, in models that have complex quantities.
const IMAGINARY_UNIT: &str = "i";

/// The values of inputs and conditions, with the complex quantities that pairs of inputs are.
fn with_complex<'r>(
    given: Vec<(String, Traced<'r>)>,
    inputs: &[InputQuantity],
    form: NumberForm,
) -> HashMap<String, Value<'r>> {
    let radians = |name: &str, phase: Traced<'r>| {
        let input = inputs.iter().find(|input| input.quantity.name == name);
        let declared = input.filter(|_| form == NumberForm::Declared);
        declared.map_or(phase, |output| NumberForm::Coherent.taken(phase, &output.quantity.unit))
    };
    let mut values: HashMap<String, Value<'r>> = HashMap::new();
    let parts: HashMap<&str, Traced<'r>> =
        given.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    for (name, value) in &given {
        let Some((whole, part)) = name.rsplit_once('.') else { continue };
        let other = |part: &str| {
            let name = format!("{whole}.{part}");
            parts.get(name.as_str()).map(|value| (name, *value))
        };
        let complex = match part {
            "re" => other("im").map(|(_, im)| ComplexNumber::new(*value, im)),
            "abs" => other("arg")
                .map(|(name, phase)| ComplexNumber::polar(*value, radians(&name, phase))),
            _ => None,
        };
        if let Some(complex) = complex {
            values.insert(whole.to_owned(), complex);
        }
    }
    let unit = ComplexNumber::new(Traced::constant(0.0), Traced::constant(1.0));
    values.insert(IMAGINARY_UNIT.to_owned(), unit);
    values.extend(given.into_iter().map(|(name, value)| (name, ComplexNumber::real(value))));
    values
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
