//! Plans against what can be computed by hand.

use super::*;
use gumption_engine::distribution::Input;
use gumption_engine::propagate::Control;
use gumption_engine::task::{Coverage, Task};

/// The factor is kept at 2, so that U = 2 u whatever the degrees of freedom.
const FIXED: Coverage = Coverage::Factor { factor: 2.0, fixed: true };

/// y = a + b with u = 3 and 4: u(y) = 5, U = 10.
fn sum() -> Task {
    Task::builder("")
        .input("a", Input::normal(100.0, 3.0, "mm").unwrap())
        .input("b", Input::normal(50.0, 4.0, "mm").unwrap())
        .equation("y", "a + b")
        .output("y", "mm")
        .coverage(FIXED)
        .trials(0)
        .build()
        .unwrap()
}

fn question(most: f64) -> PlanQuestion {
    let target = PlanTarget { output: 0, expanded: true, share: 0.0, most };
    PlanQuestion { target, costs: Costs::Equal, drift: None }
}

fn planned(task: &Task, question: &PlanQuestion) -> Plan {
    plan(task, question, &Control::default()).unwrap()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} and {expected}");
}

fn stated(improvements: Vec<Option<Improvement>>) -> Costs {
    Costs::Stated { improvements, currency: "EUR".to_owned() }
}

/// With U <= 7 u(y)^2 is to be 12.25: b alone sqrt(12.25 - 9), a alone not, since 16 is more. The
/// tolerance is some ulp of the bisection.
#[test]
fn one_input_alone() {
    let found = planned(&sum(), &question(7.0));
    near(found.figure, 10.0, 1e-14);
    assert_eq!(found.inputs[0].needed, None);
    near(found.inputs[1].needed.unwrap(), 3.25f64.sqrt(), 1e-13);
    let found = planned(&sum(), &question(9.0));
    near(found.inputs[0].needed.unwrap(), 4.25f64.sqrt(), 1e-13);
    near(found.inputs[1].needed.unwrap(), 11.25f64.sqrt(), 1e-13);
    // the target may be of the standard uncertainty
    let target = PlanTarget { output: 0, expanded: false, share: 0.0, most: 4.5 };
    let found = planned(&sum(), &PlanQuestion { target, ..question(1.0) });
    near(found.inputs[0].needed.unwrap(), 4.25f64.sqrt(), 1e-13);
    assert!(found.missed_rows.is_empty() && found.check.is_none());
}

/// A share of the estimate, 150: 6 % of it are 9, and 4 % with 3 more as well. An estimate of 0 has no
/// share.
#[test]
fn a_share_of_the_estimate() {
    let absolute = planned(&sum(), &question(9.0));
    for (share, most) in [(0.06, 0.0), (0.04, 3.0)] {
        let target = PlanTarget { output: 0, expanded: true, share, most };
        let found = planned(&sum(), &PlanQuestion { target, ..question(1.0) });
        near(found.limit, 9.0, 1e-14);
        let (of_share, of_value) = (found.inputs[0].needed, absolute.inputs[0].needed);
        near(of_share.unwrap(), of_value.unwrap(), 1e-13);
    }
    let zero = Task::builder("")
        .input("a", Input::normal(0.0, 3.0, "mm").unwrap())
        .equation("y", "a")
        .output("y", "mm")
        .trials(0)
        .build()
        .unwrap();
    let target = PlanTarget { output: 0, expanded: true, share: 0.06, most: 0.0 };
    let asked = PlanQuestion { target, ..question(1.0) };
    assert_eq!(plan(&zero, &asked, &Control::default()).unwrap_err(), NoPlan::NoEstimate);
}

/// Of y = a f + b at f = 1 and 10 with U = 2 sqrt(9 f^2 + 16), 10 and 60.5: 10 is 6.7 % of 150 and 60.5
/// is 5.8 % of 1050, so that the first row is planned for 5 %, and the second for a value.
#[test]
fn the_row_furthest_above_its_target_is_planned() {
    let task = Task::builder("")
        .input("a", Input::normal(100.0, 3.0, "mm").unwrap())
        .input("b", Input::normal(50.0, 4.0, "mm").unwrap())
        .conditions(&[("f", "1")], [[1.0], [10.0]])
        .equation("y", "a*f + b")
        .output("y", "mm")
        .coverage(FIXED)
        .trials(0)
        .build()
        .unwrap();
    let of = |share, most| {
        let target = PlanTarget { output: 0, expanded: true, share, most };
        planned(&task, &PlanQuestion { target, ..question(1.0) })
    };
    let found = of(0.05, 0.0);
    assert_eq!(found.row, 0);
    near(found.limit, 7.5, 1e-14);
    assert_eq!(of(0.0, 9.5).row, 1);
}

/// Costs u0/u - 1 each: the gradient 3/a^2 : 4/b^2 is to be a : b, so a^3 : b^3 = 3 : 4.
#[test]
fn the_cheapest_of_two() {
    let found = planned(&sum(), &question(7.0)).cheapest.unwrap();
    let scale = (12.25 / (3f64.powf(2.0 / 3.0) + 4f64.powf(2.0 / 3.0))).sqrt();
    near(found.inputs[0].to, scale * 3f64.cbrt(), 1e-12);
    near(found.inputs[1].to, scale * 4f64.cbrt(), 1e-12);
    let cost = 3.0 / found.inputs[0].to + 4.0 / found.inputs[1].to - 2.0;
    near(found.cost, cost, 1e-12);
    near(found.gum.expanded_uncertainty().unwrap(), 7.0, 1e-12);
    // an input that costs nearly nothing carries all, down to the least that can be had
    let of = |cost, least| Some(Improvement::Continuous { cost, power: 2.0, least });
    let costs = stated(vec![of(1.0, 0.0), of(1e-9, 1.9)]);
    let found = planned(&sum(), &PlanQuestion { costs, ..question(7.0) }).cheapest.unwrap();
    assert_eq!(found.inputs[1].to, 1.9);
    near(found.inputs[0].to, (12.25f64 - 1.9 * 1.9).sqrt(), 1e-12);
}

/// With r = 0.5 u(y)^2 = a^2 + 4 a + 16; for a alone the root of a^2 + 4 a + 16 = R. The cheapest
/// plan is that of a scan over the boundary.
#[test]
fn correlated_inputs() {
    let task = Task::builder("")
        .input("a", Input::normal(100.0, 3.0, "mm").unwrap())
        .input("b", Input::normal(50.0, 4.0, "mm").unwrap())
        .equation("y", "a + b")
        .output("y", "mm")
        .correlate("a", "b", 0.5)
        .coverage(FIXED)
        .trials(0)
        .build()
        .unwrap();
    let (most, squared) = (11.0, 30.25);
    let found = planned(&task, &question(most));
    near(found.inputs[0].needed.unwrap(), (4.0 + squared - 16.0f64).sqrt() - 2.0, 1e-12);
    let found = found.cheapest.unwrap();
    let cost = |a: f64| {
        let b = (squared - 0.75 * a * a).sqrt() - 0.5 * a;
        3.0 / a + 4.0 / b - 2.0
    };
    let best = (1..30_000).map(|i| cost(1e-4 * f64::from(i))).fold(f64::INFINITY, f64::min);
    // the scan's own error is of second order in its step
    near(found.cost, best, 1e-7);
    near(found.gum.expanded_uncertainty().unwrap(), most, 1e-12);
}

/// Four readings with s = 2: u = 2/sqrt(n); with k = 2 U <= 1 needs 16 of them.
#[test]
fn numbers_of_readings() {
    let s = 2.0 / (20.0f64 / 3.0).sqrt();
    let values = [-3.0, -1.0, 1.0, 3.0].map(|v| 10.0 + v * s);
    let task = |coverage: Coverage| {
        Task::builder("")
            .input("x", Input::readings(&values, "V").unwrap())
            .equation("y", "x")
            .output("y", "V")
            .coverage(coverage)
            .trials(0)
            .build()
            .unwrap()
    };
    // a little above 1, as 2 s/sqrt(16) may round to above
    let found = planned(&task(FIXED), &question(1.0 + 1e-12));
    let need = &found.inputs[0];
    assert_eq!((need.readings, need.readings_needed), (Some(4), Some(16)));
    near(need.needed.unwrap(), 0.5, 1e-11);
    let cheapest = found.cheapest.unwrap();
    assert_eq!(cheapest.inputs[0].readings, Some(16));
    // three times as many in addition cost 1
    near(cheapest.cost, 1.0, 1e-12);
    // with t at n - 1: 18 readings have k = 2.16 (17 degrees of freedom, 95.45 %), 2.16 * 2/sqrt(18) = 1.02;
    // 19 have 2.15 and 0.987
    let found = planned(&task(Coverage::Usual), &question(1.0));
    assert_eq!(found.inputs[0].readings_needed, Some(19));
    assert_eq!(found.cheapest.unwrap().inputs[0].readings, Some(19));
    // more than can be taken
    let costs = stated(vec![Some(Improvement::Readings { each: 2.0, most: 18 })]);
    let error =
        plan(&task(Coverage::Usual), &PlanQuestion { costs, ..question(1.0) }, &Control::default());
    assert!(matches!(error, Err(NoPlan::Unreachable(least)) if least > 1.0 && least < 1.05));
}

/// Readings beside an input of any amount: no other number of readings, with the other input as large
/// as it may then be, costs less.
#[test]
fn readings_and_a_width_together() {
    let values = [9.0, 10.0, 11.0, 10.0, 10.0];
    let task = Task::builder("")
        .input("x", Input::readings(&values, "V").unwrap())
        .input("b", Input::normal(0.0, 0.4, "V").unwrap())
        .equation("y", "x + b")
        .output("y", "V")
        .coverage(FIXED)
        .trials(0)
        .build()
        .unwrap();
    let (each, scale, most) = (3.0, 20.0, 0.5);
    let costs = stated(vec![
        Some(Improvement::Readings { each, most: 200 }),
        Some(Improvement::Continuous { cost: scale, power: 1.0, least: 0.0 }),
    ]);
    let found = planned(&task, &PlanQuestion { costs, ..question(most) }).cheapest.unwrap();
    // s^2 = 0.5
    let cost = |n: u32| {
        let left: f64 = 0.0625 - 0.5 / f64::from(n);
        each * f64::from(n - 5)
            + if left > 0.0 { scale * (0.4 / left.sqrt() - 1.0) } else { f64::INFINITY }
    };
    let (best, least) = (5..200)
        .map(|n| (n, cost(n)))
        .fold((0, f64::INFINITY), |best, of| if of.1 < best.1 { of } else { best });
    assert_eq!(found.inputs[0].readings, Some(u64::from(best)));
    near(found.cost, least, 1e-9);
}

/// Of two offers the dear one alone, or the cheap one with the other input's: what is cheaper in sum.
#[test]
fn offers() {
    let offer =
        |u, cost: f64| Offer { standard_uncertainty: u, cost, about: format!("for {cost}") };
    let costs = stated(vec![
        Some(Improvement::Offers(vec![offer(2.0, 100.0), offer(0.5, 1000.0)])),
        Some(Improvement::Offers(vec![offer(2.5, 300.0), offer(1.0, 1500.0)])),
    ]);
    // 2^2 + 2.5^2 = 10.25, so U = 6.40; 3^2 + 2.5^2 gives 7.81
    let found = planned(&sum(), &PlanQuestion { costs, ..question(7.0) }).cheapest.unwrap();
    assert_eq!(found.cost, 400.0);
    assert_eq!(found.inputs[0].offer.as_deref(), Some("for 100"));
    assert_eq!((found.inputs[0].to, found.inputs[1].to), (2.0, 2.5));
    // of two that are as good the cheaper one is named, as it is counted
    let costs = stated(vec![
        Some(Improvement::Offers(vec![offer(2.0, 150.0), offer(2.0, 100.0)])),
        Some(Improvement::Offers(vec![offer(2.5, 300.0)])),
    ]);
    let found = planned(&sum(), &PlanQuestion { costs, ..question(7.0) }).cheapest.unwrap();
    assert_eq!(found.cost, 400.0);
    assert_eq!(found.inputs[0].offer.as_deref(), Some("for 100"));
    assert_eq!(found.inputs.iter().map(|of| of.cost).sum::<f64>(), 400.0);
}

/// u(b) = 4 is that of a drift over one year; 3.25 is left of the variance, so sqrt(3.25)/4 of a year
/// if it is steady, and the square of that if it is a random walk.
#[test]
fn calibration_intervals() {
    for (law, expected) in
        [(DriftLaw::Linear, 3.25f64.sqrt() / 4.0), (DriftLaw::RandomWalk, 3.25 / 16.0)]
    {
        let drift = Some(Drift { variable: 1, stated: 1.0, law });
        let found = planned(&sum(), &PlanQuestion { drift, ..question(7.0) }).interval.unwrap();
        near(found.longest.unwrap(), expected, 1e-12);
        near(found.standard_uncertainty.unwrap(), 3.25f64.sqrt(), 1e-12);
        // a target that is met leaves room: u(y)^2 = 36, so 27 for the drift
        let found = planned(&sum(), &PlanQuestion { drift, ..question(12.0) });
        assert!(found.cheapest.is_none());
        let ratio = 27f64.sqrt() / 4.0;
        let expected = if law == DriftLaw::Linear { ratio } else { ratio * ratio };
        near(found.interval.unwrap().longest.unwrap(), expected, 1e-12);
        // U of a alone is 6
        let found = planned(&sum(), &PlanQuestion { drift, ..question(5.0) }).interval.unwrap();
        assert_eq!(found.longest, Some(0.0));
    }
}

#[test]
fn no_plan() {
    let error = |question: &PlanQuestion| plan(&sum(), question, &Control::default()).unwrap_err();
    assert!(matches!(error(&question(11.0)), NoPlan::Met(now) if (now - 10.0).abs() < 1e-12));
    let of = |least| Some(Improvement::Continuous { cost: 1.0, power: 1.0, least });
    let costs = stated(vec![of(1.0), None]);
    let found = error(&PlanQuestion { costs, ..question(7.0) });
    // 1 + 16
    assert!(
        matches!(found, NoPlan::Unreachable(least) if (least - 2.0 * 17f64.sqrt()).abs() < 1e-12)
    );
    let many = (0..50).map(|i| Offer {
        standard_uncertainty: 3.0,
        cost: f64::from(i),
        about: String::new(),
    });
    let many = Some(Improvement::Offers(many.collect()));
    let costs = stated(vec![many.clone(), many]);
    let found = error(&PlanQuestion { costs, ..question(7.0) });
    assert_eq!(found, NoPlan::TooManyOffers { found: 2601, most: 2000 });
}

/// The trials of a linear model of normal inputs have the same U, within five of their standard
/// errors (false failure 6e-7), and the widths of the plan, not those of the file.
#[test]
fn the_check_draws_the_plan() {
    let mut task = sum();
    task.settings.trials = Trials::Fixed(200_000);
    task.settings.coverage = Coverage::Usual;
    let check = planned(&task, &question(7.0)).check.unwrap();
    let (figure, error) = (check.figure.unwrap(), check.numerical_standard_error.unwrap());
    assert!((figure - 7.0).abs() < 5.0 * error && error < 0.05, "{check:?}");
    assert!(check.stood_in.is_empty() && check.trials == 200_000);
}

/// A sweep is planned at the row with the largest U, and tried in the others.
#[test]
fn the_worst_row_of_a_sweep() {
    let task = Task::builder("")
        .input("a", Input::normal(1.0, 0.1, "mm").unwrap())
        .input("b", Input::normal(1.0, 0.1, "mm").unwrap())
        .equation("y", "a*f + b")
        .output("y", "mm")
        .conditions(&[("f", "1")], [[1.0], [3.0], [2.0]])
        .coverage(FIXED)
        .trials(0)
        .build()
        .unwrap();
    let found = planned(&task, &question(0.5));
    assert_eq!(found.row, 1);
    // 9 a^2 + 0.01 = 0.0625
    near(found.inputs[0].needed.unwrap(), (0.0525f64 / 9.0).sqrt(), 1e-13);
    assert!(found.missed_rows.is_empty());
}
