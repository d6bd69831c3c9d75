//! Budgets as laboratories keep them: ordinary ones come in, and odd ones are read right or refused.

use super::*;
use gumption_files::read_text;

mod ordinary;
mod refusals;

/// Options as the command line has them: `U=C`, `row result=5`, `k=2`.
fn options(said: &[&str]) -> ImportOptions {
    let mut options = ImportOptions::default();
    for said in said {
        let (kind, rest) = said.split_once(' ').unwrap_or((said, ""));
        let pair = || {
            let (name, value) = rest.split_once('=').unwrap();
            (name.to_owned(), value.to_owned())
        };
        match kind {
            "column" => options.columns.push(pair()),
            "column-unit" => options.column_units.push(pair()),
            "row" => options.rows.push(pair()),
            "unit" => options.unit = Some(rest.to_owned()),
            "estimate" => options.estimate = Some(rest.to_owned()),
            "k" => options.k = rest.parse().ok(),
            "distribution" => options.distribution = Some(rest.to_owned()),
            "equation" => options.equation = Some(rest.to_owned()),
            "numbers" => options.numbers = true,
            "coefficients" => {
                options.coefficients = Some(match rest {
                    "units" => Coefficients::Units,
                    "ratios" => Coefficients::Ratios,
                    _ => Coefficients::One,
                });
            }
            _ => panic!("{said}"),
        }
    }
    options
}

fn import(text: &str, said: &[&str]) -> Result<ImportedBudget, RefusedBudget> {
    import_budget_bytes(Path::new("b.csv"), text.as_bytes().to_vec(), &options(said))
}

/// Estimate, standard uncertainty and unit of the result of a model file.
fn result(budget: &ImportedBudget) -> (f64, f64, String) {
    // as a model file, and not only as this module reads it
    read_text("m", &budget.text, Path::new(""), &[])
        .unwrap_or_else(|faults| panic!("{}\n{faults}", budget.text));
    let (gum, unit) = model::result_of(&budget.text).unwrap();
    (gum.estimate, gum.standard_uncertainty, unit.text().to_owned())
}

/// Whether two numbers are the same but for roundings of conversions and roots.
fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}
