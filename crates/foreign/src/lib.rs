//! Files of strangers: the uncertainty budgets of spreadsheets, which become model files, and tables of
//! results, which are compared.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod answer;
mod comparison;
mod import;
#[cfg(test)]
mod tests;

pub use comparison::{
    ComparisonOptions, ComparisonTable, ReadComparison, assigned_by, limit_of, read_comparison,
    read_comparison_text, sigma_by,
};
pub use import::{
    Coefficients, ImportOptions, ImportedBudget, Question, RefusedBudget, ShownColumn, ShownSheet,
    import_budget, import_budget_bytes, read_budget, sheet_names,
};
