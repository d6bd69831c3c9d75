//! That formulas say what the search computes.

use std::collections::HashMap;

use crate::shape::{Function, Shape, Values};
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_units::Dimension;

/// Every function as numbers and as text, at several parameters, of positive values and of values of
/// either sign.
#[test]
fn formulas_are_the_functions() {
    let positive: Vec<f64> = (1..=12).map(|n| 0.5 * f64::from(n * n)).collect();
    let signed: Vec<f64> = (-6..=6).map(|n| 2.5 * f64::from(n)).collect();
    let mut seen = 0;
    for at in [positive, signed] {
        let values = Values::new(at.clone()).unwrap();
        for shape in Shape::all(&values) {
            for share in [0.13, 0.52, 0.87] {
                let shares = vec![share; shape.ranges.len()];
                let parameters = shape.parameters(&shares);
                let columns = shape.columns(&at, &parameters);
                let names: Vec<String> = (0..parameters.len()).map(|n| format!("p{n}")).collect();
                let text = shape.text("x", &names, "phase").unwrap();
                let formula = Formula::parse(&text).unwrap();
                let known = ["x", "phase"].into_iter().chain(names.iter().map(String::as_str));
                let scope = Scope::from_iter(known.map(|of| (of, Typing::of(Dimension::NONE))));
                formula.check(&scope).unwrap();
                for (n, x) in at.iter().enumerate() {
                    let phase = 0.3_f64;
                    let mut known: HashMap<String, f64> =
                        names.iter().cloned().zip(parameters.iter().copied()).collect();
                    known.insert("x".to_owned(), *x);
                    known.insert("phase".to_owned(), phase);
                    let written = formula.evaluate(&scope, &known).unwrap();
                    let computed = if shape.function == Function::Wave {
                        columns[0][n] * phase.cos() + columns[1][n] * phase.sin()
                    } else {
                        columns[0][n]
                    };
                    // the same operations in another order
                    let far = (written - computed).abs();
                    assert!(
                        far < 1e-12 * (1.0 + computed.abs()),
                        "{text} at {x}: {written} {computed}"
                    );
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 1000);
}
