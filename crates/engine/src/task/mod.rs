//! What is to be evaluated: a model, what is known about its inputs in every row of conditions,
//! and the settings of the evaluation. Files and typed measurements both become a [`Task`].

mod builder;
mod check;
mod coverage;
mod error;
mod evidence;
mod function;
mod settings;
mod sharing;
mod statement;
#[cfg(test)]
mod tests;
mod warning;

pub use builder::TaskBuilder;
pub use coverage::Coverage;
pub use error::TaskError;
pub use evidence::Evidence;
pub use function::ColumnFunction;
pub(crate) use function::differences;
pub use settings::{
    MethodChoice, Settings, SettingsChanges, StatementMethod, StoppingRule, Trials,
};
pub use sharing::Sharing;
pub use statement::ModelStatement;
pub use warning::Warning;

use std::sync::Arc;

use crate::distribution::{
    Correlation, CorrelationError, Distribution, EvaluationType, Fits, Input, Joint, Occasion,
};
use crate::model::Model;
use crate::model::typed::Measurement;
use crate::propagate::Region;
use crate::regression::CurveFunction;
use gumption_units::Unit;

/// One random variable of the model: an input quantity, or a component of one.
#[derive(Clone, Debug)]
#[non_exhaustive]
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
    /// What tells it from itself in another evaluation of the same file; its row follows from
    /// [`Variable::sharing`].
    pub occasion: Occasion,
}

/// One row of conditions with what is known about the variables there.
#[derive(Clone, Debug)]
pub struct Row {
    /// Values of the conditions, in their units.
    pub conditions: Vec<f64>,
    /// The variables' distributions, in their units. Rows share what is the same in all of them.
    pub distributions: Arc<[Arc<Distribution>]>,
}

impl Row {
    /// The values of a program's variables at the estimates: those of the inputs, then the conditions.
    pub fn estimates(&self) -> Vec<f64> {
        let inputs = self.distributions.iter().map(|distribution| distribution.mean());
        inputs.chain(self.conditions.iter().copied()).collect()
    }
}

/// A model with everything that its evaluation needs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Task {
    /// Title, for reports.
    pub title: String,
    /// The document that the measurement follows, for reports.
    pub source: String,
    /// The equations in words, for reports.
    pub statement: ModelStatement,
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
    /// The calibration functions that its formulas call.
    pub curves: Vec<Arc<CurveFunction>>,
    /// The outputs that are covered together.
    pub regions: Vec<Region>,
    /// What computes the outputs in place of the model's program, where it cannot be recorded.
    pub function: Option<Arc<dyn ColumnFunction>>,
}

impl Variable {
    /// A variable in a unit, evaluated by other means than readings (Type B), with one value for all
    /// rows and shown in budgets.
    pub fn new(name: impl Into<String>, unit: Unit) -> Self {
        Self {
            name: name.into(),
            unit,
            evaluation: EvaluationType::B,
            group: None,
            about: String::new(),
            sharing: Sharing::All,
            shown: true,
            occasion: Occasion::default(),
        }
    }
}

impl Task {
    /// The evaluation of a model whose program's variables are these, then the conditions, in these
    /// rows: without a title and correlations, with the usual settings.
    pub fn new(model: Model, variables: Vec<Variable>, rows: Vec<Row>) -> Self {
        Self {
            title: String::new(),
            source: String::new(),
            statement: ModelStatement::default(),
            swept: !model.conditions.is_empty(),
            model,
            variables,
            correlations: Vec::new(),
            rows,
            settings: Settings::default(),
            fits: Fits::default(),
            curves: Vec::new(),
            regions: Vec::new(),
            function: None,
        }
    }

    /// How the quantities of a row are drawn together, if there are trials.
    pub(crate) fn joint(&self, row: &Row) -> Result<Arc<Joint>, CorrelationError> {
        match self.settings.trials {
            Trials::Fixed(0) => self.fits.of_propagation(&row.distributions, &self.correlations),
            _ => self.fits.joint(&row.distributions, &self.correlations),
        }
    }

    /// A task of equations, step by step.
    pub fn builder(title: &str) -> TaskBuilder {
        TaskBuilder::new(title)
    }

    /// A task of a typed measurement whose fields hold what is known about its inputs, step by
    /// step.
    pub fn measurement<M: Measurement<Value = Input>>(measurement: M) -> TaskBuilder {
        TaskBuilder::of(measurement)
    }

    /// The evaluation of a typed measurement whose fields hold what is known about its inputs.
    ///
    /// # Errors
    /// An input whose unit has another dimension than the declared one.
    pub fn of<M: Measurement<Value = Input>>(
        measurement: M,
        settings: Settings,
    ) -> Result<Self, TaskError> {
        Self::measurement(measurement).settings(settings).build()
    }
}
