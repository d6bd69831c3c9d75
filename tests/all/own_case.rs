//! A gap case, a coverage region, a shape and a calibration line of a program's own, made in memory
//! with what the crate `gumption` has.

use std::sync::Arc;

use gumption::calibration::{Curve, Points, Regression, Spread};
use gumption::distribution::{Distribution, Input, Normal, Quantiles, SplitNormal, Truncated};
use gumption::gap::{
    Candidate, Case, DiagnosisOptions, Effect, ModelForm, ObservedOutput, OverridableModel, Prior,
    diagnose,
};
use gumption::model::formula::{Formula, Scope, Typing};
use gumption::model::{InputQuantity, NumberForm, Output, Quantity};
use gumption::propagate::{Control, evaluate};
use gumption::task::{Row, Task, Variable};
use gumption::unit::Unit;

fn quantity(name: &str, unit: &str) -> Quantity {
    Quantity { name: name.to_owned(), unit: Unit::parse(unit).unwrap(), about: String::new() }
}

/// Voltages of a divider that the model has without an offset of 20 mV, which is 10 standard
/// uncertainties of each of twelve values.
#[test]
fn a_gap_case_of_data_in_memory() {
    let (input, condition) = (quantity("g", "1"), quantity("V", "V"));
    let names = [("g", "1"), ("V", "V"), ("y", "V")];
    let typed = names.map(|(name, unit)| (name, Typing::in_unit(&Unit::parse(unit).unwrap())));
    let model = OverridableModel {
        inputs: vec![InputQuantity { quantity: input, parts: 1 }],
        conditions: vec![condition],
        outputs: vec![Output::new(quantity("y", "V"))],
        maker: ModelForm::Equations(vec![("y".to_owned(), Formula::parse("g*V").unwrap())]),
        scope: Scope::from_iter(typed),
        numbers: NumberForm::Coherent,
    };
    let known: Arc<[Arc<Distribution>]> =
        Arc::new([Arc::new(Normal::new(0.5, 1e-4).unwrap().into())]);
    let volts: Vec<f64> = (1..=12).map(f64::from).collect();
    let rows = volts
        .iter()
        .map(|volt| Row { conditions: vec![*volt], distributions: Arc::clone(&known) })
        .collect();
    let task = Task::new(model.model().unwrap(), vec![Variable::new("g", Unit::one())], rows);
    let effect = |name: &str, parameter: &str, unit: &str, becomes: &str| Effect {
        name: name.to_owned(),
        parameters: vec![quantity(parameter, unit)],
        overrides: vec![("y".to_owned(), Formula::parse(becomes).unwrap())],
    };
    let candidate = |effect, std| Candidate {
        effect,
        priors: vec![Normal::new(0.0, std).unwrap().into()],
        about: String::new(),
        source: String::new(),
        simulator: None,
    };
    let noise = [1.0, -1.0, 0.5, -0.5];
    let values = volts.iter().zip(noise.iter().cycle());
    let case = Case {
        task,
        model,
        observed: vec![Some(ObservedOutput {
            values: values.map(|(volt, noise)| 0.5 * volt + 0.02 + 0.002 * noise).collect(),
            last_digit: None,
            standard_uncertainties: Some(vec![0.002; 12]),
            simulation_uncertainties: None,
            simulation_covariance: None,
        })],
        simulated: 0,
        simulator: None,
        history: Vec::new(),
        reachable: Vec::new(),
        candidates: vec![
            candidate(effect("offset", "o", "V", "y + o"), 0.05),
            candidate(effect("quadratic", "q", "1/V", "y + q*V^2"), 0.001),
        ],
        shipped: Vec::new(),
        replication: None,
        prior: Prior::DEFAULT,
    };
    let found = diagnose(&case, None, DiagnosisOptions::new(1), &|_| ()).unwrap();
    assert!(found.gap.present);
    assert_eq!(found.most_probable.effects, ["offset"]);
}

/// sum and difference of two equal inputs are independent: k_p^2 = -2 ln(1 - p) of chi-squared with
/// two degrees of freedom.
#[test]
fn a_coverage_region_of_a_task() {
    let input = || Input::new(Normal::new(1.0, 0.1).unwrap(), "V").unwrap();
    let task = Task::builder("both")
        .input("a", input())
        .input("b", input())
        .equation("s", "a + b")
        .equation("d", "a - b")
        .output("s", "V")
        .output("d", "V")
        .region(&["s", "d"])
        .coverage(0.95)
        .trials(0)
        .build()
        .unwrap();
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    let region = evaluation.rows[0].regions[0].gum.as_ref().unwrap();
    let k = (-2.0 * 0.05_f64.ln()).sqrt();
    assert!((region.ellipsoid_k.unwrap() - k).abs() < 1e-9);
}

/// The shapes that files have: the median of a normal distribution cut at its mean is its quantile of
/// 0.75, 0.674490 standard deviations above.
#[test]
fn shapes_that_files_have() {
    let cut = Truncated::cut(Normal::new(0.0, 1.0).unwrap().into(), 0.0, f64::INFINITY).unwrap();
    assert!((cut.quantile(0.5) - 0.674_489_750_196_082).abs() < 1e-9);
    let split: Distribution = SplitNormal::new(1.0, 0.1, 0.1).unwrap().into();
    assert!((split.mean() - 1.0).abs() < 1e-12);
    let stated: Distribution = Quantiles::new(&[0.0, 0.5, 1.0], &[1.0, 2.0, 3.0]).unwrap().into();
    assert!((stated.quantile(0.25) - 1.5).abs() < 1e-12);
}

/// ISO/TS 28037:2010, clause 6: the line through six points of equal weights.
#[test]
fn a_calibration_line() {
    let y = vec![3.3, 5.6, 7.1, 9.3, 10.7, 12.1];
    let x = (1..=6).map(f64::from).collect();
    let points = Points::new(x, y).with_y(Spread::Each(vec![0.5; 6]));
    let line = Regression::of("line", &Curve::polynomial(1), &Arc::new(points), &[]).unwrap();
    assert!((line.estimate(0) - 1.867).abs() < 5e-4 && (line.estimate(1) - 1.757).abs() < 5e-4);
}
