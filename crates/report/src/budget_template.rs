//! A workbook to be filled in with a budget, which `gumption import` reads without a question.

use std::io;

use rust_xlsxwriter::XlsxError;

use crate::workbook::{Book, Look, failed};

/// The headings, each with what belongs below it.
const COLUMNS: [(&str, &str); 11] = [
    ("Symbol", "the name of the quantity in the equation"),
    ("Description", "what the quantity is"),
    ("Estimate", "its value"),
    ("Unit", "the unit of the estimate and of the uncertainty"),
    ("Uncertainty", "the half-width, the expanded or the standard uncertainty"),
    ("Distribution", "normal, rectangular, triangular or U-shaped"),
    (
        "Divisor",
        "of a normal distribution the coverage factor, or 1 of a standard uncertainty; else empty",
    ),
    ("Degrees of freedom", "empty where there are infinitely many"),
    ("Sensitivity coefficient", "where the sheet has no equation"),
    ("Unit of c_i", "the unit of the sensitivity coefficient, such as nm/K"),
    ("Remark", "where the number comes from"),
];

/// The template as the bytes of an XLSX file, with an example in place of the budget.
///
/// # Errors
/// The workbook cannot be made.
pub fn budget_template() -> io::Result<Vec<u8>> {
    made().map_err(failed)
}

fn made() -> Result<Vec<u8>, XlsxError> {
    let mut book = Book::new("Uncertainty budget")?;
    let mut leaf = book.leaf("Budget")?;
    leaf.title(0, "Uncertainty budget")?;
    leaf.text(1, 0, "Equation")?;
    leaf.text(1, 1, "R = V/I")?;
    leaf.headers(3, COLUMNS.iter().map(|(heading, _)| *heading))?;
    let rows = [
        ("V", "voltage", 5.0112, "V", Some((0.0046, "normal", Some(2.0))), "certificate"),
        ("I", "current", 0.01, "A", Some((0.00001, "rectangular", None)), "specification"),
        ("R", "resistance", 501.12, "ohm", None, ""),
    ];
    for (row, (symbol, description, estimate, unit, uncertainty, remark)) in (4..).zip(rows) {
        leaf.text(row, 0, symbol)?;
        leaf.text(row, 1, description)?;
        leaf.number((row, 2), estimate, None, Look::Input)?;
        leaf.text(row, 3, unit)?;
        if let Some((width, distribution, divisor)) = uncertainty {
            leaf.number((row, 4), width, None, Look::Input)?;
            leaf.text(row, 5, distribution)?;
            if let Some(divisor) = divisor {
                leaf.number((row, 6), divisor, None, Look::Input)?;
            }
        }
        leaf.text(row, 10, remark)?;
    }
    book.push(leaf)?;
    let mut leaf = book.leaf("How to fill in")?;
    let lines = [
        "Write the quantities into the rows of the sheet Budget in place of the example, and the title into its \
         first row.",
        "With an equation, write it behind the word `Equation`, with the symbols of the rows.",
        "Without one, take the line of the equation away and give each quantity its sensitivity coefficient.",
        "The last row states the result: its symbol, its estimate and its unit. They are compared with the model.",
    ];
    for (row, line) in (0..).zip(lines) {
        leaf.line(row, line)?;
    }
    for (row, (heading, content)) in (5..).zip(COLUMNS) {
        leaf.line(row, &format!("{heading} - {content}"))?;
    }
    book.push(leaf)?;
    book.bytes()
}
