//! What is to be evaluated: a model, what is known about its inputs in every row of conditions,
//! and the settings of the evaluation. Files and typed measurements both become a [`Task`].

mod coverage;
mod evidence;
mod settings;
mod warning;

pub use coverage::Coverage;
pub use evidence::Evidence;
pub use settings::{Settings, StoppingRule, Trials};
pub use warning::Warning;

use std::sync::Arc;

use crate::distribution::{Correlation, Distribution, EvaluationType, Fits, Input};
use crate::model::typed::{Measurement, Typed};
use crate::model::{InputQuantity, Model, Output, Quantity};
use gumption_units::Unit;

/// One random variable of the model: an input quantity, or a component of one.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name, `quantity` or `quantity/component`.
    pub name: String,
    /// Unit of its values.
    pub unit: Unit,
    /// Type A or B.
    pub evaluation: EvaluationType,
    /// Group for subtotals.
    pub group: Option<String>,
    /// Source of uncertainty, in words.
    pub about: String,
    /// In which rows it has the same value.
    pub sharing: Sharing,
    /// Whether it has a line in the budget. The constant that components are added to has none.
    pub shown: bool,
}

/// In which rows of a sweep a variable has the same unknown value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// One value for all rows.
    All,
    /// A value of its own in every row.
    Row,
    /// One value for each value of the condition at this place.
    Condition(usize),
}

/// One row of conditions with what is known about the variables there.
#[derive(Clone, Debug)]
pub struct Row {
    /// Values of the conditions, in their units.
    pub conditions: Vec<f64>,
    /// The variables' distributions, in their units. Rows share what is the same in all of them.
    pub distributions: Arc<[Arc<Distribution>]>,
}

/// A model with everything that its evaluation needs.
#[derive(Clone, Debug)]
pub struct Task {
    /// Title, for reports.
    pub title: String,
    /// The model. Its program's variables are [`Task::variables`], then the conditions.
    pub model: Model,
    /// The random variables.
    pub variables: Vec<Variable>,
    /// Declared correlation coefficients between variables.
    pub correlations: Vec<Correlation>,
    /// The rows of conditions; a single row where nothing is swept.
    pub rows: Vec<Row>,
    /// Whether the rows come from declared conditions.
    pub swept: bool,
    /// How to evaluate.
    pub settings: Settings,
    /// The joint draws found so far.
    pub fits: Fits,
}

/// Why a typed measurement cannot be evaluated with the given inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongUnit {
    /// The input.
    pub input: String,
    /// Its unit as given.
    pub found: String,
    /// The unit of the measurement's declaration.
    pub declared: String,
}

impl std::fmt::Display for WrongUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { input, found, declared } = self;
        write!(f, "{input} is given in `{found}`, which cannot be converted to `{declared}`")
    }
}

impl std::error::Error for WrongUnit {}

impl Task {
    /// The evaluation of a typed measurement whose fields hold what is known about its inputs.
    ///
    /// # Errors
    /// An input whose unit has another dimension than the declared one.
    pub fn of<M: Measurement<Value = Input>>(
        measurement: M,
        settings: Settings,
    ) -> Result<Self, WrongUnit> {
        let typed = Typed::of::<M>();
        let mut quantities = Vec::new();
        let mut variables = Vec::new();
        let mut distributions = Vec::new();
        for (declared, input) in typed.declaration.inputs.iter().zip(measurement.into_values()) {
            let wrong = || WrongUnit {
                input: declared.name.to_owned(),
                found: input.unit.to_string(),
                declared: declared.unit.to_owned(),
            };
            let unit = Unit::parse(declared.unit).map_err(|_| wrong())?;
            if !unit.is_compatible(&input.unit) {
                return Err(wrong());
            }
            let about = if input.about.is_empty() { declared.about.trim() } else { &input.about };
            let quantity = Quantity {
                name: declared.name.to_owned(),
                unit: input.unit.clone(),
                about: about.to_owned(),
            };
            quantities.push(InputQuantity { quantity, parts: 1 });
            variables.push(Variable {
                name: declared.name.to_owned(),
                unit: input.unit,
                evaluation: input.evaluation,
                group: input.group,
                about: about.to_owned(),
                sharing: Sharing::All,
                shown: true,
            });
            distributions.push(Arc::new(input.distribution));
        }
        let outputs: Vec<Output> = typed.model().map(|model| model.outputs).unwrap_or_default();
        Ok(Self {
            title: typed.declaration.name.to_owned(),
            model: typed.model_with(quantities, Vec::new(), outputs),
            variables,
            correlations: Vec::new(),
            rows: vec![Row { conditions: Vec::new(), distributions: distributions.into() }],
            swept: false,
            settings,
            fits: Fits::default(),
        })
    }
}
