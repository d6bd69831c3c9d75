//! What is said where the two methods differ, and runs that go on until clause 8 is decided.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;

use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::propagate::{
    Control, Evaluation, OutputEvaluation, Stated, evaluate, warnings,
};
use gumption_engine::task::{Coverage, Task, Trials};
use gumption_files as file;

fn task(text: &str) -> Task {
    file::read_text("m.json", text, Path::new(""), &[]).unwrap().task
}

/// The evaluation with a number of trials, and its notes with their codes.
fn run(text: &str, trials: u64) -> (Evaluation, Vec<(&'static str, Fact)>) {
    let mut task = task(text);
    task.settings.trials = Trials::Fixed(trials);
    task.settings.decide_up_to = 0;
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    let notes = warnings(&task, &evaluation).into_iter().map(|note| (note.code(), note.fact));
    let notes = notes.collect();
    (evaluation, notes)
}

/// The parts of a fact, itself among them.
fn parts(fact: &Fact) -> Vec<&Fact> {
    fn within<'f>(argument: &'f Argument, found: &mut Vec<&'f Fact>) {
        match argument {
            Argument::Fact(fact) => found.extend(parts(fact)),
            Argument::List(list) => list.iter().for_each(|part| within(part, found)),
            _ => {}
        }
    }
    let mut found = vec![fact];
    fact.arguments.iter().for_each(|(_, argument)| within(argument, &mut found));
    found
}

fn first(evaluation: &Evaluation) -> &OutputEvaluation {
    &evaluation.rows[0].outputs[0]
}

fn product(dof: &str) -> String {
    format!(
        r#"{{"inputs": {{
            "a": {{"distribution": "normal", "mean": 1, "std": 0.5}},
            "b": {{"distribution": "normal", "mean": 1, "std": 0.5}},
            "c": {{"distribution": "normal", "mean": 0, "std": 0.05 {dof}}}}},
            "equations": {{"y": "a*b + c"}}, "outputs": {{"y": {{}}}}}}"#
    )
}

/// The 6 % by which the trials of a product lie above the law of propagation are the product's, also
/// where an input with half a per cent of the variance has five degrees of freedom. By hand:
/// u^2 = 0.25 + 0.25 + 0.0025 and with the term of second order 0.0625 more.
#[test]
fn the_product_is_blamed_and_not_the_degrees_of_freedom() {
    for dof in ["", r#", "dof": 5"#] {
        let (evaluation, notes) = run(&product(dof), 200_000);
        let codes: Vec<&str> = notes.iter().map(|note| note.0).collect();
        assert!(codes.contains(&"non-linear") && !codes.contains(&"few-dof"), "{notes:?}");
        let second = first(&evaluation).second_order.as_ref().unwrap();
        let expected: f64 = 0.5025 + 0.0625;
        assert!((second.standard_uncertainty - expected.sqrt()).abs() < 1e-9, "{second:?}");
        let [(0, 1, contribution)] = second.products[..] else { panic!("{second:?}") };
        assert!((contribution - 0.25).abs() < 1e-9);
    }
}

/// Where degrees of freedom are all that there is, they are named, and no second order.
#[test]
fn degrees_of_freedom_are_blamed_where_they_explain_it() {
    let text = r#"{"inputs": {"a": {"distribution": "normal", "mean": 1, "std": 0.5, "dof": 6}},
        "equations": {"y": "2*a"}, "outputs": {"y": {}}}"#;
    let (evaluation, notes) = run(text, 200_000);
    assert_eq!(notes.iter().filter(|note| note.0 == "few-dof").count(), 1, "{notes:?}");
    assert!(first(&evaluation).second_order.is_none());
    // sqrt(6/4)
    let drawn = first(&evaluation).gum.as_ref().unwrap().drawn_uncertainty();
    assert!((drawn - 1.5f64.sqrt()).abs() < 1e-12);
}

/// EA-4/02, S4: the gauge block. The difference of the expansion coefficients and that of the
/// temperature from 20 degC are both zero, so the law of propagation sees nothing of their product,
/// which contributes 11.8 nm: 34.4 nm without and 36.4 nm with it, as the publication states.
#[test]
fn the_gauge_block_of_ea_4_02() {
    let text = r#"{"inputs": {
        "l_S": {"unit": "mm", "distribution": "normal", "mean": 50.00002, "std": 15e-6},
        "drift": {"unit": "nm", "distribution": "triangular", "mean": 0, "half_width": 42.4264},
        "dl": {"unit": "nm", "distribution": "normal", "mean": -94, "std": 5.37},
        "comparator": {"unit": "nm", "distribution": "rectangular", "mean": 0, "half_width": 32},
        "dt": {"unit": "K", "distribution": "rectangular", "mean": 0, "half_width": 0.05},
        "dalpha": {"unit": "1/K", "distribution": "triangular", "mean": 0, "half_width": 2e-6},
        "dT": {"unit": "K", "distribution": "rectangular", "mean": 0, "half_width": 0.5},
        "centre": {"unit": "nm", "distribution": "rectangular", "mean": 0, "half_width": 6.7},
        "L": {"unit": "mm", "distribution": "constant", "value": 50},
        "alpha": {"unit": "1/K", "distribution": "constant", "value": 11.5e-6}},
        "equations": {"l_X": "l_S + drift + dl + comparator - L*(alpha*dt + dalpha*dT) - centre"},
        "outputs": {"l_X": {"unit": "nm"}}}"#;
    for trials in [0, 200_000] {
        let (evaluation, notes) = run(text, trials);
        let found = first(&evaluation);
        let u = found.gum.as_ref().unwrap().standard_uncertainty;
        assert!((u - 34.4).abs() < 0.1, "{u}");
        let second = found.second_order.as_ref().unwrap();
        assert!((second.standard_uncertainty - 36.4).abs() < 0.1, "{second:?}");
        let [(5, 6, contribution)] = second.products[..] else { panic!("{second:?}") };
        assert!((contribution - 11.8).abs() < 0.05);
        let said = notes.iter().find(|note| note.0 == "non-linear").unwrap();
        let product = fact!("times", first = "dalpha", second = "dT");
        let is_hidden = |part: &&Fact| {
            part.key == "contributes.hidden"
                && part.argument("product") == Some(&product.clone().into())
        };
        assert_eq!(parts(&said.1).iter().filter(|part| is_hidden(part)).count(), 1, "{said:?}");
    }
}

/// A kink has no second derivative, and no term of second order is made up for it.
#[test]
fn kinks_have_no_second_order() {
    let text = r#"{"inputs": {"a": {"distribution": "normal", "mean": 0, "std": 1},
        "b": {"distribution": "normal", "mean": 0, "std": 0.3}},
        "equations": {"y": "abs(a) + b"}, "outputs": {"y": {}}}"#;
    for trials in [0, 100_000] {
        assert!(first(&run(text, trials).0).second_order.is_none());
    }
}

/// Two readings are a t with one degree of freedom, which has no expectation: no estimate, where it
/// was 1.5, 2.3 or 2.9 by seed. Three have one, and no standard deviation. Either way the output lies at
/// the mean of the readings, and its trials alone tell their median.
#[test]
fn two_readings_have_no_expectation() {
    for (values, mean, estimate) in [("1, 2", 1.5, false), ("1, 2, 4", 7.0 / 3.0, true)] {
        let text = format!(
            r#"{{"inputs": {{"a": {{"distribution": "readings", "values": [{values}]}}}},
            "equations": {{"y": "a"}}, "outputs": {{"y": {{}}}}}}"#
        );
        let (evaluation, notes) = run(&text, 100_000);
        let figures = first(&evaluation).monte_carlo.as_deref().unwrap();
        assert_eq!(figures.estimate.is_some(), estimate);
        assert_eq!((figures.standard_uncertainty, figures.errors.estimate), (None, None));
        assert_eq!(figures.location(), figures.median);
        let (located, error) = first(&evaluation).located().unwrap();
        assert!((located - mean).abs() < 1e-15 && error == 0.0, "{located} {error}");
        assert!(notes.iter().any(|note| note.0 == "no-variance"));
    }
}

/// Without a word about coverage, k is 2 exactly, at a probability of 0.9545.
#[test]
fn the_usual_factor_is_two() {
    let text = r#"{"inputs": {"a": {"distribution": "normal", "mean": 1, "std": 0.5}},
        "equations": {"y": "a"}, "outputs": {"y": {}}}"#;
    let mut task = task(text);
    task.settings.trials = Trials::Fixed(0);
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    let gum = first(&evaluation).gum.as_ref().unwrap();
    assert_eq!((gum.coverage_factor, gum.expanded_uncertainty()), (Some(2.0), Some(1.0)));
    assert_eq!(evaluation.coverage_probability, 0.9545);
    // 3 for K = 3, and the t factor at 0.95 where that is asked for
    task.settings.coverage = Coverage::Factor { factor: 3.0, fixed: false };
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    assert_eq!(first(&evaluation).gum.as_ref().unwrap().coverage_factor, Some(3.0));
}

/// A run that may go on does so, fourfold each time, until clause 8 is decided or the limit is
/// reached, and its figures are those of a run of that many trials. One that is decided stays as it
/// is.
#[test]
fn clause_8_is_decided() {
    let text = r#"{"inputs": {"a": {"distribution": "normal", "mean": 1, "std": 0.06},
        "b": {"distribution": "rectangular", "mean": 0, "half_width": 0.06}},
        "equations": {"y": "a + b"}, "outputs": {"y": {}}}"#;
    let mut task = task(text);
    let (start, limit) = (1_000_000, 16_000_000);
    let mut went_on = 0;
    for seed in 1..=4 {
        task.settings.seed = seed;
        task.settings.trials = Trials::Fixed(start);
        task.settings.decide_up_to = limit;
        let found = evaluate(&task, &Control::default()).unwrap();
        let trials = first(&found).monte_carlo.as_deref().unwrap().trials;
        assert_eq!(found.settings.trials, Trials::Fixed(trials));
        let verdict = |task: &mut Task, trials: u64| {
            task.settings.trials = Trials::Fixed(trials);
            task.settings.decide_up_to = 0;
            let evaluation = evaluate(task, &Control::default()).unwrap();
            (first(&evaluation).validation.unwrap().gum_valid, format!("{:?}", evaluation.rows))
        };
        let (last, rows) = verdict(&mut task, trials);
        assert!(last.is_some() || trials == limit, "seed {seed}: {trials}");
        assert_eq!(rows, format!("{:?}", found.rows));
        if trials > start {
            went_on += 1;
            assert_eq!(verdict(&mut task, trials / 4).0, None);
        }
    }
    assert!(went_on > 0);
}

/// The standard deviation of trials of a t distribution of three degrees of freedom is another one with
/// each seed; of a sum, and of a smooth product without noteworthy curvature, it is no sign of a model
/// that is not linear, and what an agreed factor states does not move with it.
#[test]
fn few_degrees_of_freedom_are_no_curvature() {
    let text = |formula: &str| {
        format!(
            r#"{{"coverage_factor": 2, "coverage_factor_fixed": true, "inputs": {{
            "x": {{"distribution": "readings", "values": [10.0, 10.1, 9.9, 10.3]}},
            "b": {{"distribution": "normal", "mean": 1, "std": 0.01}}}},
            "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        )
    };
    for formula in ["x + b", "2*(x - b)/3", "x*b"] {
        let mut stated = Vec::new();
        for seed in 1..=12 {
            let mut task = task(&text(formula));
            (task.settings.trials, task.settings.seed) = (Trials::Fixed(100_000), seed);
            let evaluation = evaluate(&task, &Control::default()).unwrap();
            let notes = warnings(&task, &evaluation);
            assert!(notes.iter().all(|note| note.code() != "non-linear"), "{formula} {notes:?}");
            let found = Stated::of(first(&evaluation), &task.settings).unwrap();
            stated.push(found.expanded_uncertainty);
        }
        assert!(stated.iter().all(|u| *u == stated[0]), "{formula} {stated:?}");
    }
    // a product of which the other factor is as good as zero bends, whatever the seed says
    let bent = r#"{"inputs": {
        "x": {"distribution": "readings", "values": [-0.1, 0.0, 0.05, 0.05]},
        "b": {"distribution": "normal", "mean": 0, "std": 1}},
        "equations": {"y": "x*b + x"}, "outputs": {"y": {}}}"#;
    let (_, notes) = run(bent, 100_000);
    assert!(notes.iter().any(|note| note.0 == "non-linear"), "{notes:?}");
}

/// Phases near the cut, times a factor, in another unit or as what is left of whole multiples: half of
/// the trials lie a period away, and the law of propagation is what is stated.
#[test]
fn trials_on_both_sides_of_a_cut() {
    let text = |formula: &str, unit: &str| {
        format!(
            r#"{{"inputs": {{
            "x": {{"distribution": "normal", "mean": -1, "std": 0.05}},
            "y": {{"distribution": "normal", "mean": 0.001, "std": 0.05}},
            "a": {{"unit": "deg", "distribution": "normal", "mean": 359.99, "std": 0.05}},
            "b": {{"unit": "mm", "distribution": "normal", "mean": 10.2, "std": 0.5}},
            "f": "10 Hz"}},
            "equations": {{"p": "{formula}"}}, "outputs": {{"p": {{"unit": "{unit}"}}}}}}"#
        )
    };
    // what lies on the other side: a turn, 1/f, two turns, half a turn
    for (formula, unit, away) in [
        ("atan2(y, x)", "deg", None),
        ("-atan2(y, x)/(2*pi*f)", "ms", Some("100 ms")),
        ("2*atan2(y, x)", "rad", Some("13 rad")),
        ("atan2(y, x)/2", "rad", Some("3.1 rad")),
        ("mod(a, 360 [deg])", "deg", None),
        // a third of the trials beyond the cut
        ("mod(b, 10 [mm])", "mm", Some(" mm")),
    ] {
        let (evaluation, notes) = run(&text(formula, unit), 100_000);
        let note = notes.iter().find(|note| note.0 == "phase-jumps").map(|note| &note.1);
        let is_right = match (note.and_then(|fact| fact.argument("size")), away) {
            (Some(Argument::Number(size)), Some(away)) => size.ends_with(away),
            (None, None) => note.is_some_and(|fact| fact.key == "phase-jumps"),
            _ => false,
        };
        assert!(is_right, "{formula} {notes:?}");
        assert!(notes.iter().all(|note| note.0 != "non-linear"), "{formula} {notes:?}");
        let found = first(&evaluation);
        let gum = found.gum.as_ref().unwrap();
        let stated = Stated::of(found, &task(&text(formula, unit)).settings).unwrap();
        assert_eq!(
            (stated.value, stated.standard_uncertainty),
            (gum.estimate, gum.standard_uncertainty)
        );
    }
    // a turn from the cut, and a modulus that bends: no jump
    let away = text("atan2(y, -x)", "deg");
    assert!(run(&away, 100_000).1.iter().all(|note| note.0 != "phase-jumps"));
}

/// Without trials the estimate is all there is: where it has none the operation is named, as trials do,
/// and conditions too; a branch that is not taken is no reason.
#[test]
fn estimates_that_are_not_there() {
    let message = |formula: &str| {
        let text = format!(
            r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 2, "std": 0.1}}}},
            "conditions": {{"c": {{"values": [1, 3]}}}},
            "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        );
        let mut task = task(&text);
        task.settings.trials = Trials::Fixed(0);
        evaluate(&task, &Control::default()).map(|_| ()).map_err(|error| error.to_string())
    };
    let sqrt = message("sqrt(x - c)").unwrap_err();
    assert!(sqrt.contains("sqrt of -1, at x = 2, c = 3"), "{sqrt}");
    let root = message("solve(u^2 + x + c, u, 0, 5)").unwrap_err();
    assert!(root.contains("no finite value at the estimates") && root.contains("solve"), "{root}");
    let constant = message("if(x > 1, x, 1/0) + if(c > 2, 1/0, 0)").unwrap_err();
    assert!(constant.contains("depends on no input and is infinite"), "{constant}");
    assert_eq!(message("if(x > 1, x, 1/0)"), Ok(()));
}

/// What has no moments is stated by its median and its interval, whose factor does not move with the
/// few trials far out.
#[test]
fn quotients_by_what_may_be_zero() {
    let text = r#"{"inputs": {"z": {"distribution": "normal", "mean": 1, "std": 0.3}},
        "equations": {"y": "1/z"}, "outputs": {"y": {}}}"#;
    let mut found = Vec::new();
    for seed in 1..=4 {
        let mut task = task(text);
        (task.settings.trials, task.settings.seed) = (Trials::Fixed(200_000), seed);
        task.settings.decide_up_to = 0;
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let stated = Stated::of(first(&evaluation), &task.settings).unwrap();
        found.push((stated.value, stated.coverage_factor));
    }
    for (value, factor) in &found {
        // the median of 1/z is 1; its standard error is 0.3 sqrt(pi/2)/sqrt(200 000) = 0.0008, and the
        // interval's end is known to about 1 %
        assert!((value - 1.0).abs() < 0.004, "{found:?}");
        assert!((factor / found[0].1 - 1.0).abs() < 0.05, "{found:?}");
    }
}
