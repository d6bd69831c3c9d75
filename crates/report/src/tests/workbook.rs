//! Workbooks: formulas with cached values that are those of the JSON answer.

use std::io::Cursor;

use calamine::{Data, Range, Reader, Xlsx};
use serde_json::Value;

use super::*;
use crate::{Shown, xlsx};

struct Book {
    values: Vec<(String, Range<Data>)>,
    formulas: Vec<(String, Range<String>)>,
}

impl Book {
    fn of(case: &Case) -> Self {
        let shown = Shown { model: "{}\n", ..Shown::default() };
        let bytes = xlsx(&case.report(), &shown).unwrap();
        // no date of today: the same again is the same bytes
        assert_eq!(bytes, xlsx(&case.report(), &shown).unwrap());
        let mut book = Xlsx::new(Cursor::new(bytes)).unwrap();
        let names = book.sheet_names();
        let values = names.iter().map(|n| (n.clone(), book.worksheet_range(n).unwrap()));
        let values = values.collect();
        let formulas = names.iter().map(|n| (n.clone(), book.worksheet_formula(n).unwrap()));
        Self { formulas: formulas.collect(), values }
    }

    fn names(&self) -> Vec<&str> {
        self.values.iter().map(|(name, _)| name.as_str()).collect()
    }

    fn sheet(&self, name: &str) -> &Range<Data> {
        let found = self.values.iter().find(|(known, _)| known == name);
        found.map_or_else(|| panic!("{name} in {:?}", self.names()), |(_, range)| range)
    }

    fn formula(&self, name: &str, at: (u32, u32)) -> String {
        let (_, range) = self.formulas.iter().find(|(known, _)| known == name).unwrap();
        range.get_value(at).cloned().unwrap_or_default()
    }

    /// The place of the first cell with a text in the first column, from a row on.
    fn row(&self, name: &str, from: u32, text: &str) -> u32 {
        let sheet = self.sheet(name);
        let (last, _) = sheet.end().unwrap();
        (from..=last)
            .find(|&row| sheet.get_value((row, 0)).is_some_and(|cell| cell == text))
            .unwrap_or_else(|| panic!("{text} in {name}"))
    }

    /// The value of a cell, which is a number to the last bit, and its formula.
    fn assert(&self, name: &str, at: (u32, u32), wanted: &Value) -> String {
        let cell = self.sheet(name).get_value(at).unwrap();
        match wanted.as_f64() {
            Some(wanted) => {
                let found = match cell {
                    Data::Float(found) => *found,
                    Data::Int(found) => *found as f64,
                    other => panic!("{name} {at:?}: {other:?} for {wanted}"),
                };
                assert_eq!(found.to_bits(), wanted.to_bits(), "{name} {at:?}: {found} {wanted}");
            }
            None => {
                let texts = ["∞", "-", "undefined"];
                assert!(texts.iter().any(|text| *cell == **text), "{name} {at:?}: {cell:?}");
            }
        }
        self.formula(name, at)
    }
}

/// A budget against the JSON answer; the formulas of its lines and figures.
fn assert_budget(book: &Book, gum: &Value, output: &str) -> Vec<String> {
    let name = format!("Budget {output}");
    let mut formulas = Vec::new();
    for line in gum["budget"].as_array().unwrap() {
        let label = match line["input"].as_str() {
            Some(input) => input.to_owned(),
            None => {
                let pair = &line["correlation"];
                format!("r({}, {})", pair[0].as_str().unwrap(), pair[1].as_str().unwrap())
            }
        };
        let at = book.row(&name, 3, &label);
        if line["input"].is_null() {
            formulas.push(book.assert(&name, (at, 1), &line["coefficient"]));
        } else {
            formulas.push(book.assert(&name, (at, 1), &line["estimate"]));
            formulas.push(book.assert(&name, (at, 2), &line["standard_uncertainty"]));
            formulas.push(book.assert(&name, (at, 5), &line["dof"]));
            formulas.push(book.assert(&name, (at, 6), &line["sensitivity"]));
            formulas.push(book.assert(&name, (at, 7), &line["contribution"]));
        }
        formulas.push(book.assert(&name, (at, 8), &line["share"]));
    }
    let figures = [
        ("estimate y", gum["estimate"].clone()),
        ("combined standard uncertainty u", gum["standard_uncertainty"].clone()),
        ("effective degrees of freedom", gum["dof"].clone()),
        ("coverage factor k", gum["coverage_factor"].clone()),
        ("expanded uncertainty U", gum["expanded_uncertainty"].clone()),
        ("coverage interval, from", gum["interval"][0].clone()),
        ("coverage interval, to", gum["interval"][1].clone()),
    ];
    for (label, value) in figures {
        let at = book.row(&name, 3, label);
        formulas.push(book.assert(&name, (at, 1), &value));
    }
    formulas
}

#[test]
fn budgets_are_live_and_hold_the_numbers_of_the_json() {
    for case in [Case::new(plane_at(35.0, 2000)), Case::new(grouped(0)), Case::new(correlated(0))] {
        let book = Book::of(&case);
        let names = [
            "Results",
            "Inputs",
            "Budget a_x",
            "Budget a_y",
            "Budget a_z",
            "Correlations",
            "Measurement",
            "Model",
            "About",
        ];
        assert_eq!(book.names(), names);
        let answer = case.json();
        book.assert("Correlations", (3, 1), &answer["output_correlations"][0][2]);
        for (number, output) in ["a_x", "a_y", "a_z"].into_iter().enumerate() {
            let gum = &answer["outputs"][output]["gum"];
            let formulas = assert_budget(&book, gum, output);
            let last = &formulas[formulas.len() - 7..];
            assert!(last[0].starts_with("Model!") || last[0].starts_with("'Model'!"), "{last:?}");
            assert!(last[1].starts_with("SQRT(MAX(0,SUMSQ($H$"), "{last:?}");
            assert_eq!(last[1].contains("+SUM($J$"), case.task.correlations.len() == 1);
            assert!(last[2].is_empty() == (gum["dof_status"] == "undefined"), "{last:?}");
            assert!(last[3].contains("T.INV.2T(1-") && last[3].contains("NORM.S.INV("), "{last:?}");
            assert!(last[4].contains('*') && last[5].contains('-') && last[6].contains('+'));
            let (input, sensitivity) = (&formulas[0], &formulas[3]);
            assert!(input.contains("Inputs") && sensitivity.contains("Model"), "{formulas:?}");
            // the results refer to the budgets
            let at = 1 + number as u32;
            let expanded = book.assert("Results", (9, at), &gum["expanded_uncertainty"]);
            assert!(expanded.contains(&format!("Budget {output}")), "{expanded}");
            let trials = &answer["outputs"][output]["monte_carlo"];
            if trials.is_object() {
                book.assert("Results", (13, at), &trials["estimate"]);
                book.assert("Results", (19, at), &trials["shortest_interval"][1]);
            }
        }
    }
}

#[test]
fn every_row_of_conditions_has_its_budget() {
    let mut case = sweep(&[15.0, 35.0], 0);
    let (mut second, frequency) = (case.task.rows[0].clone(), 80.0);
    case.task.rows[0].conditions = vec![frequency, 15.0];
    second.conditions = vec![frequency, 35.0];
    second.distributions = plane_at(35.0, 0).rows[0].distributions.clone();
    case.task.rows.push(second);
    let book = Book::of(&case);
    let rows = case.json();
    let mut from = 3;
    for (number, row) in rows["rows"].as_array().unwrap().iter().enumerate() {
        let gum = &row["outputs"]["a_x"]["gum"];
        let at = book.row("Budget a_x", from, "expanded uncertainty U");
        book.assert("Budget a_x", (at, 1), &gum["expanded_uncertainty"]);
        book.assert("Results", (4 + 3 * number as u32, 8), &gum["expanded_uncertainty"]);
        from = at + 1;
    }
}

#[test]
fn undefined_degrees_of_freedom_have_no_expanded_uncertainty() {
    let mut case = Case::new(grouped(0));
    case.task.correlations = vec![Correlation { first: 0, second: 1, coefficient: 0.3 }];
    let case = Case::new(case.task);
    let book = Book::of(&case);
    let gum = &case.json()["outputs"]["a_x"]["gum"];
    assert_eq!(gum["dof_status"], "undefined");
    assert_budget(&book, gum, "a_x");
}

/// Figures that formulas do not follow are marked by one, on every worksheet that has them: it counts the
/// cells of the inputs that differ from what stood in them.
#[test]
fn figures_of_changed_inputs_are_marked() {
    let case = Case::new(plane_at(35.0, 2000));
    let book = Book::of(&case);
    let at = book.row("Inputs", 4, "a_ref");
    let reference = &case.task.rows[0].distributions[0];
    let own = book.formula("Inputs", (at, 11));
    for known in [reference.mean(), reference.standard_uncertainty()] {
        assert!(own.contains(&format!("-({known:?})")), "{own}");
    }
    let all = book.formula("Inputs", (3, 11));
    assert!(all.starts_with("SUM($L$6:$L$") && all.contains("-(0.95)"), "{all}");
    let figures = book.row("Budget a_x", 3, "estimate y");
    for (name, place) in
        [("Results", (2, 0)), ("Budget a_x", (figures - 1, 4)), ("Correlations", (1, 0))]
    {
        let marked = book.formula(name, place);
        let said = ": inputs were changed: not of these inputs\"";
        assert!(marked.contains("$L$4>0") && marked.contains(said), "{name}: {marked}");
    }
}
