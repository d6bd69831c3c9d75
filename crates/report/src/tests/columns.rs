//! Columns of the budget on request.

use std::path::Path;

use super::*;
use crate::{BudgetColumn, Shown, table};
use gumption_files::read_text;

/// One input of every kind of statement, in a file as laboratories write it.
const FILE: &str = r#"{
  "format": 1,
  "title": "Voltage at a temperature",
  "inputs": {
    "reading": {"unit": "mV", "distribution": "readings", "values": [5010.1, 5009.8, 5010.2, 5009.9], "about": "repeatability"},
    "certificate": {"unit": "mV", "distribution": "normal", "mean": 0.5, "expanded": 0.2, "k": 2, "group": "voltmeter", "about": "certificate of the voltmeter, k = 2"},
    "drift": {"unit": "mV", "distribution": "triangular", "mean": 0, "half_width": 0.3, "group": "voltmeter", "about": "since calibration"},
    "resolution": {"unit": "mV", "distribution": "rectangular", "lower": -0.05, "upper": 0.05, "group": "voltmeter"},
    "offset": {"unit": "mV", "distribution": "normal", "mean": 0, "expanded": "0.02 % of 1 V", "p": 0.95},
    "skew": {"unit": "mV", "distribution": "triangular", "lower": 0, "upper": 0.3, "mode": 0},
    "noise": {"unit": "mV", "distribution": "normal", "mean": 0, "std": 0.03},
    "temp": {"unit": "degC", "distribution": "rectangular", "mean": 23, "half_width": 2},
    "slope": {"unit": "mV/K", "distribution": "constant", "value": 0.05}
  },
  "equations": {"v": "reading + certificate + drift + resolution + offset + skew + noise + slope*(temp - 0 [degC])"},
  "outputs": {"v": {"unit": "mV"}},
  "monte_carlo": {"trials": 0}
}"#;

fn page(text: &str, columns: &[BudgetColumn]) -> String {
    let file = read_text("file", text, Path::new(""), &[]);
    let case = Case::new(file.unwrap_or_else(|problems| panic!("{problems:?}")).task);
    let page = table(&case.report(), &Shown { columns, ..full() });
    let widest = page.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    assert!(widest <= 100, "{widest} columns:\n{page}");
    page
}

/// The budget alone.
fn budget(columns: &[BudgetColumn]) -> String {
    let page = page(FILE, columns);
    let start = page.find("\nquantity     estimate").unwrap() + 1;
    let end = page.find("Subtotals").unwrap();
    page[start..end].to_owned()
}

#[test]
fn widths_and_divisors() {
    insta::assert_snapshot!(budget(&[BudgetColumn::Divisor, BudgetColumn::Width]), @"
    quantity     estimate  value ±  divisor  standard  unit  distri-      dof   sensi-  contri-  share
                                               uncer-        bution             tivity   bution   in %
                                               tainty
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    drift           0.00      0.3     2.449     0.12   mV    triangular     ∞  1.000      0.12    27.9
    offset          0.00      0.2     1.96      0.10   mV    normal         ∞  1.000      0.10    19.3
    certificate     0.50      0.2     2         0.10   mV    normal         ∞  1.000      0.10    18.6
    reading      5010.000     0.18    2         0.091  mV    readings       3  1.000      0.091   15.5
    skew            0.100     -       -         0.071  mV    triangular     ∞  1.000      0.071    9.3
    temp           23.0       2       1.732     1.2    degC  rectangular    ∞  0.05000    0.058    6.2
    noise           0.000     0.03    1         0.030  mV    normal         ∞  1.000      0.030    1.7
    resolution      0.000     0.05    1.732     0.029  mV    rectangular    ∞  1.000      0.029    1.5
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    v            5011.75                        0.23   mV    combined     125             0.23   100.0

    Sensitivity coefficients in mV per unit of the quantity, contributions in mV.

    Constants: slope = 0.05 mV/K.
    ");
}

#[test]
fn relative_figures() {
    insta::assert_snapshot!(budget(&[BudgetColumn::Relative]), @"
    quantity     estimate  standard    rela-  unit  distri-      dof   sensi-  contri-     of y  share
                             uncer-     tive        bution             tivity   bution     in %   in %
                             tainty     in %
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    drift           0.00      0.12    -       mV    triangular     ∞  1.000      0.12   0.0024    27.9
    offset          0.00      0.10    -       mV    normal         ∞  1.000      0.10   0.0020    19.3
    certificate     0.50      0.10   20       mV    normal         ∞  1.000      0.10   0.0020    18.6
    reading      5010.000     0.091   0.0018  mV    readings       3  1.000      0.091  0.0018    15.5
    skew            0.100     0.071  71       mV    triangular     ∞  1.000      0.071  0.0014     9.3
    temp           23.0       1.2     -       degC  rectangular    ∞  0.05000    0.058  0.0012     6.2
    noise           0.000     0.030   -       mV    normal         ∞  1.000      0.030  0.00060    1.7
    resolution      0.000     0.029   -       mV    rectangular    ∞  1.000      0.029  0.00058    1.5
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    v            5011.75      0.23    0.0046  mV    combined     125             0.23   0.0046   100.0

    Sensitivity coefficients in mV per unit of the quantity, contributions in mV; relative: standard
    uncertainty to the modulus of the estimate; of y: contribution to the modulus of v.

    Constants: slope = 0.05 mV/K.
    ");
}

#[test]
fn type_and_source() {
    insta::assert_snapshot!(budget(&[BudgetColumn::Type, BudgetColumn::About]), @"
    quantity     estimate  standard  unit  distri-      dof   sensi-  contri-  share  type
                             uncer-        bution             tivity   bution   in %
                             tainty
    ──────────────────────────────────────────────────────────────────────────────────────
    drift           0.00      0.12   mV    triangular     ∞  1.000      0.12    27.9  B
    offset          0.00      0.10   mV    normal         ∞  1.000      0.10    19.3  B
    certificate     0.50      0.10   mV    normal         ∞  1.000      0.10    18.6  B
    reading      5010.000     0.091  mV    readings       3  1.000      0.091   15.5  A
    skew            0.100     0.071  mV    triangular     ∞  1.000      0.071    9.3  B
    temp           23.0       1.2    degC  rectangular    ∞  0.05000    0.058    6.2  B
    noise           0.000     0.030  mV    normal         ∞  1.000      0.030    1.7  B
    resolution      0.000     0.029  mV    rectangular    ∞  1.000      0.029    1.5  B
    ──────────────────────────────────────────────────────────────────────────────────────
    v            5011.75      0.23   mV    combined     125             0.23   100.0

    quantity     source of
                 uncertainty
    ────────────────────────────────────────────────
    drift        since calibration
    offset
    certificate  certificate of the voltmeter, k = 2
    reading      repeatability
    skew
    temp
    noise
    resolution
    ────────────────────────────────────────────────
    v

    Sensitivity coefficients in mV per unit of the quantity, contributions in mV.

    Constants: slope = 0.05 mV/K.
    ");
}

/// What does not fit beside the budget stands below it.
#[test]
fn all_columns() {
    insta::assert_snapshot!(budget(&BudgetColumn::ALL), @"
    quantity     estimate  standard  unit  distri-      dof   sensi-  contri-  share  value ±  divisor
                             uncer-        bution             tivity   bution   in %
                             tainty
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    drift           0.00      0.12   mV    triangular     ∞  1.000      0.12    27.9     0.3     2.449
    offset          0.00      0.10   mV    normal         ∞  1.000      0.10    19.3     0.2     1.96
    certificate     0.50      0.10   mV    normal         ∞  1.000      0.10    18.6     0.2     2
    reading      5010.000     0.091  mV    readings       3  1.000      0.091   15.5     0.18    2
    skew            0.100     0.071  mV    triangular     ∞  1.000      0.071    9.3     -       -
    temp           23.0       1.2    degC  rectangular    ∞  0.05000    0.058    6.2     2       1.732
    noise           0.000     0.030  mV    normal         ∞  1.000      0.030    1.7     0.03    1
    resolution      0.000     0.029  mV    rectangular    ∞  1.000      0.029    1.5     0.05    1.732
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    v            5011.75      0.23   mV    combined     125             0.23   100.0

    quantity       rela-  type     of y  group      source of
                    tive           in %             uncertainty
                    in %
    ───────────────────────────────────────────────────────────────────────────────────
    drift         -       B     0.0024   voltmeter  since calibration
    offset        -       B     0.0020
    certificate  20       B     0.0020   voltmeter  certificate of the voltmeter, k = 2
    reading       0.0018  A     0.0018              repeatability
    skew         71       B     0.0014
    temp          -       B     0.0012
    noise         -       B     0.00060
    resolution    -       B     0.00058  voltmeter
    ───────────────────────────────────────────────────────────────────────────────────
    v             0.0046        0.0046

    Sensitivity coefficients in mV per unit of the quantity, contributions in mV; relative: standard
    uncertainty to the modulus of the estimate; of y: contribution to the modulus of v.

    Constants: slope = 0.05 mV/K.
    ");
}

#[test]
fn a_column_stays_in_the_table() {
    for column in BudgetColumn::ALL {
        let page = budget(&[column]);
        assert_eq!(page.matches("quantity ").count(), 1, "{column:?}\n{page}");
    }
    let case = Case::new(plane_at(35.0, 0));
    let columns = &[BudgetColumn::Divisor, BudgetColumn::Relative];
    let page = table(&case.report(), &Shown { columns, ..full() });
    let first = &page[page.find("\na_x in").unwrap()..page.find("\na_y in").unwrap()];
    assert_eq!(first.matches("quantity ").count(), 1, "{page}");
}

#[test]
fn a_correlation_has_no_cells_of_its_own() {
    let case = Case::new(correlated(0));
    let page = table(&case.report(), &Shown { columns: &BudgetColumn::ALL, ..full() });
    assert!(page.lines().any(|line| line.starts_with("r(a_ref, tilt)")), "{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 100), "{page}");
}

#[test]
fn names() {
    for column in BudgetColumn::ALL {
        assert_eq!(BudgetColumn::named(column.name()), Some(column));
    }
    assert_eq!(BudgetColumn::named("Divisor"), None);
}
