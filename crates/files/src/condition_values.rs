//! What estimates and widths of inputs see of the conditions.

use std::fmt::Debug;

use gumption_engine::model::formula::Formula;
use gumption_text::DiagnosticKind;
use gumption_units::Unit;

use gumption_text::value_text::ValueOf;

/// What a formula of conditions is in a row.
pub(super) type ValuesOfRows<'c> = Box<dyn Fn(usize) -> f64 + 'c>;

/// The conditions' values in one row, by name; and how formulas of them are checked.
pub(super) trait ConditionValues: Debug {
    /// The number of rows.
    fn rows(&self) -> usize;
    /// Whether a mistake among them, which is reported already, leaves them without values.
    fn are_unreadable(&self) -> bool;
    /// Checks a formula of conditions for an estimate or width in `unit`.
    fn check(&self, formula: &Formula, unit: &Unit, of: ValueOf)
    -> Result<(), Vec<DiagnosticKind>>;
    /// The formula's values in `unit`, each computed when it is asked for.
    fn values(&self, formula: &Formula, unit: &Unit, of: ValueOf) -> ValuesOfRows<'_>;
    /// The formula's value in `unit` in a row.
    fn value(&self, formula: &Formula, row: usize, unit: &Unit, of: ValueOf) -> f64 {
        self.values(formula, unit, of)(row)
    }
    /// The place of a condition of that name.
    fn place(&self, name: &str) -> Option<usize>;
    /// The names.
    fn names(&self) -> Vec<String>;
}
