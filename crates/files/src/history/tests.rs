//! Conditions of the order of the rows as they are derived, and effects of what came before by name.

use std::path::Path;

use super::super::{CaseFile, FileReader};
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::elementary;
use gumption_engine::special::normal;
use gumption_gap::{
    ComposedEffect, ComposedPrior, Diagnosis, DiagnosisOptions, HypothesisKind, diagnose,
};

/// A load cell of 0.2 mV/V and kg, with rows of load, reading and more columns.
const CELL: &str = r#"{
    "inputs": {"s": {"distribution": "normal", "mean": 0.2, "std": 0.0002}},
    "conditions": {"m": {"unit": "kg"}},
    "equations": {"y": "s*m/[kg]"},
    "outputs": {"y": {"unit": "1"}},
    "check_units": true,"#;

/// A load cell's case in a folder; `more` are further keys of `observations`, `keys` of the case.
fn cell(folder: &Path, data: &str, more: &str, keys: &str) -> CaseFile {
    std::fs::write(folder.join("data.csv"), data).unwrap();
    let observations = format!(
        r#""observations": {{"file": "data.csv", {more} "columns":
            {{"y": {{"value": "y", "standard_uncertainty": 0.001}}}}}}"#
    );
    let text = format!("{CELL} {observations} {keys}}}");
    FileReader::default().case_text("case.json", &text, folder).unwrap()
}

/// The names of the conditions, and the values of one of them.
fn conditions(case: &CaseFile) -> Vec<&str> {
    case.case.model.conditions.iter().map(|condition| condition.name.as_str()).collect()
}

fn values(case: &CaseFile, name: &str) -> Vec<f64> {
    let place = conditions(case).iter().position(|known| *known == name).unwrap();
    case.case.task.rows.iter().map(|row| row.conditions[place]).collect()
}

/// A table of loads with the readings of a cell that follows its sim but for some digits.
fn table(loads: &[f64]) -> String {
    let noise = [0.0003, -0.0011, 0.0007, 0.0001, -0.0004];
    let rows = loads.iter().enumerate();
    let row = |(n, m): (usize, &f64)| format!("{m},{:.4}\n", 0.2 * m + noise[n % noise.len()]);
    format!("m,y\n{}", rows.map(row).collect::<String>())
}

#[test]
fn a_loop_has_a_direction_and_a_sweep_has_none() {
    let folder = tempfile::tempdir().unwrap();
    let up: Vec<f64> = (0..=12).map(f64::from).collect();
    let swept = cell(folder.path(), &table(&up), "", "");
    assert_eq!(conditions(&swept), ["m"]);
    // sorted by the load, each twice
    let twice: Vec<f64> = up.iter().flat_map(|m| [*m, *m]).collect();
    assert_eq!(conditions(&cell(folder.path(), &table(&twice), "", "")), ["m"]);

    let down = up.iter().rev().skip(1);
    let there_and_back: Vec<f64> = up.iter().chain(down).copied().collect();
    let case = cell(folder.path(), &table(&there_and_back), "", "");
    let known = conditions(&case);
    assert_eq!(known[..2], ["m", "direction(m)"]);
    // the value before and the last extreme say no more than the direction does
    assert!(!known.contains(&"previous(m)") && !known.contains(&"extreme(m)"), "{known:?}");
    let direction = values(&case, "direction(m)");
    assert_eq!(direction[0], 0.0);
    assert!(direction[1..13].iter().all(|d| *d == 1.0));
    assert!(direction[13..].iter().all(|d| *d == -1.0));

    // twice up and down, each load read twice: readings that follow each other are one visit
    let again: Vec<f64> = loops().iter().flat_map(|m| [*m, *m]).collect();
    let repetition = values(&cell(folder.path(), &table(&again), "", ""), "repetition");
    assert_eq!([0, 10, 11, 30, 50, 70].map(|row| repetition[row]), [1.0, 1.0, 1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn what_came_before_is_counted_in_time_and_in_the_units_of_conditions() {
    let folder = tempfile::tempdir().unwrap();
    // each load is read three times, ten seconds apart
    let loads = [5.0, 2.0, 8.0, 1.0, 9.0, 3.0, 7.0, 5.0, 6.0, 2.0];
    let rows = loads.iter().flat_map(|m| [m; 3]).enumerate();
    let row = |(n, m): (usize, &f64)| {
        format!("{},{m},{:.4}\n", 10 * n + 50, 0.2 * m + 0.001 * f64::from(n as u32 % 3))
    };
    let data = format!("t [s],m,y\n{}", rows.map(row).collect::<String>());
    let case = cell(folder.path(), &data, r#""time": "t","#, "");
    let units = |name: &str| {
        let known = case.case.model.conditions.iter().find(|condition| condition.name == name);
        known.map(|condition| condition.unit.text().to_owned())
    };
    assert_eq!(units("since(m)").as_deref(), Some("s"));
    assert_eq!(units("previous(m)").as_deref(), Some("kg"));
    assert_eq!(units("t").as_deref(), Some("s"));
    assert_eq!(values(&case, "since(m)")[..6], [0.0, 10.0, 20.0, 0.0, 10.0, 20.0]);
    assert_eq!(values(&case, "previous(m)")[..7], [5.0, 5.0, 5.0, 5.0, 2.0, 2.0, 2.0]);
    assert_eq!(values(&case, "t")[..2], [50.0, 60.0]);
    // two loads that come back say no more than the time does
    assert!(!conditions(&case).contains(&"repetition"));

    // rows to predict at begin a series of their own
    let at = folder.path().join("at.csv");
    std::fs::write(&at, "t,m\n0,4\n5,4\n9,6\n").unwrap();
    let text = std::fs::read_to_string(folder.path().join("data.csv")).unwrap();
    assert!(text.starts_with("t [s]"));
    let case_text = format!(
        "{CELL} {}}}",
        r#""observations": {"file": "data.csv", "time": "t", "columns": {"y": {"value": "y"}}}"#
    );
    let read = FileReader::default();
    let there = read.case_text_at("case.json", &case_text, folder.path(), &at).unwrap();
    let places: Vec<usize> = ["since(m)", "previous(m)"]
        .iter()
        .map(|name| conditions(&case).iter().position(|known| known == name).unwrap())
        .collect();
    let of = |place: usize| there.iter().map(|row| row.conditions[place]).collect::<Vec<f64>>();
    assert_eq!(of(places[0]), [0.0, 5.0, 0.0]);
    assert_eq!(of(places[1]), [4.0, 4.0, 4.0]);
    std::fs::write(&at, "m\n4\n6\n").unwrap();
    let without = read.case_text_at("case.json", &case_text, folder.path(), &at).unwrap_err();
    assert!(without.to_string().contains("no column `t`"), "{without}");
}

#[test]
fn the_order_may_stand_in_a_column() {
    let folder = tempfile::tempdir().unwrap();
    // the file is sorted by load; the column says how it was taken
    let mut rows: Vec<(f64, usize)> = (0..10).map(|n| (n as f64, n)).collect();
    rows.extend((0..10).map(|n| (n as f64, 19 - n)));
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let row = |(m, n): &(f64, usize)| format!("{n},{m},{:.4}\n", 0.2 * m);
    let data = format!("run,m,y\n{}", rows.iter().map(row).collect::<String>());
    let case = cell(folder.path(), &data, r#""order": "run","#, "");
    let expected: Vec<f64> = rows
        .iter()
        .map(|(_, n)| match n {
            0 => 0.0,
            1..10 => 1.0,
            // the highest load twice
            10 => 1.0,
            _ => -1.0,
        })
        .collect();
    assert_eq!(values(&case, "direction(m)"), expected);
    assert_eq!(conditions(&cell(folder.path(), &data, "", "")), ["m"]);
}

/// Independent standard normal numbers.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut stream = StreamKey::new(seed, "history/test").block(0);
    let mut left: Vec<f64> = Vec::new();
    move || {
        left.pop().unwrap_or_else(|| {
            let mut uniform = [0.0; 64];
            stream.uniform(&mut uniform);
            left = uniform.iter().map(|p| normal::quantile(*p)).collect();
            left.pop().unwrap_or_default()
        })
    }
}

/// Readings of loads with noise of 0.001 and what `effect` adds in each row.
fn readings(loads: &[f64], seed: u64, effect: impl Fn(usize) -> f64) -> String {
    let mut noise = noise(seed);
    let rows = loads.iter().enumerate();
    let mut row =
        |(n, m): (usize, &f64)| format!("{n},{m},{:.5}\n", 0.2 * m + effect(n) + 0.001 * noise());
    let rows: String = rows.map(&mut row).collect();
    format!("run,m,y\n{rows}")
}

fn diagnosed(case: &CaseFile) -> Diagnosis {
    diagnose(&case.case, None, DiagnosisOptions::new(1), &|_| ()).unwrap()
}

/// A composed effect as a case has it.
fn as_it_stands(of: &ComposedEffect) -> String {
    let prior = |prior: &ComposedPrior| match prior {
        ComposedPrior::Normal { mean, std } => {
            format!(r#""distribution": "normal", "mean": {mean:?}, "std": {std:?}"#)
        }
        ComposedPrior::Rectangular { lower, upper } => {
            format!(r#""distribution": "rectangular", "lower": {lower:?}, "upper": {upper:?}"#)
        }
        ComposedPrior::LogUniform { lower, upper } => {
            format!(r#""distribution": "log-uniform", "lower": {lower:?}, "upper": {upper:?}"#)
        }
    };
    let parameters: Vec<String> = of
        .parameters
        .iter()
        .map(|of| format!(r#""{}": {{"unit": "{}", {}}}"#, of.name, of.unit, prior(&of.prior)))
        .collect();
    let overrides: Vec<String> =
        of.overrides.iter().map(|(name, text)| format!("{name:?}: {text:?}")).collect();
    format!(
        r#"{{"parameters": {{{}}}, "overrides": {{{}}}}}"#,
        parameters.join(", "),
        overrides.join(", ")
    )
}

/// Up, down, up, down in steps of 1 kg.
fn loops() -> Vec<f64> {
    let leg = |n: u32| if (n / 10).is_multiple_of(2) { n % 10 } else { 10 - n % 10 };
    (0..=40).map(|n| f64::from(leg(n))).collect()
}

const FIVE: &str = r#", "catalogue": ["hysteresis", "creep", "warm-up", "memory", "drift"]"#;

/// A loop of ten standard uncertainties that is skewed by 30 %, with columns of load and reading only,
/// and a candidate that is a nonlinearity.
#[test]
fn a_loop_is_hysteresis_without_a_column_that_says_so() {
    let loads = loops();
    let direction: Vec<f64> = (0..loads.len())
        .map(|n| if n > 0 && loads[n] > loads[n - 1] { 1.0 } else { -1.0 })
        .collect();
    let effect = |n: usize| {
        let x = loads[n] / 10.0;
        0.01 * direction[n] * 4.0 * x * (1.0 - x) * (1.0 + 0.3 * (2.0 * x - 1.0))
    };
    let folder = tempfile::tempdir().unwrap();
    let nonlinear = r#", "effects": {"nonlinearity": {"parameters": {"q": {"unit": "1",
        "distribution": "normal", "mean": 0, "std": 0.02}}, "overrides": {"y": "y + q*(m/(10 [kg]))^3"}}}"#;
    let case = cell(folder.path(), &readings(&loads, 7, effect), "", nonlinear);
    let found = diagnosed(&case);
    assert_eq!(found.most_probable.kind, HypothesisKind::Unexplained);
    // with the non-linearity or without it
    let departs: f64 = found.departure.iter().map(|form| form.probability).sum();
    assert!(departs > 0.99, "{departs}");
    // both names of it: of the catalogue and composed
    let unlisted = found.unlisted.first().unwrap();
    assert_eq!(unlisted.effect, "hysteresis");
    let composed = found.composed.first().unwrap();
    assert!(composed.name.contains("hysteresis"), "{}", composed.name);
    assert!(composed.overrides[0].1.contains("direction(m)"), "{:?}", composed.overrides);
    // what is handed over is an effect as it stands
    let keys = format!(r#", "effects": {{"composed": {}}}"#, as_it_stands(composed));
    let again = cell(folder.path(), &readings(&loads, 7, effect), "", &keys);
    assert_eq!(again.case.candidates.len(), 1);
    let named = |over: &gumption_gap::DepartureOver| format!("{over:?}").contains("direction(m)");
    assert!(named(&found.departure.first().unwrap().over));
}

/// Each effect of what came before, made with a fixed seed and eight standard uncertainties large, is
/// told from the four others.
#[test]
fn effects_of_what_came_before_have_names() {
    let sweeps = loops();
    let mixed = [
        3.0, 4.0, 1.0, 6.0, 7.0, 2.0, 1.0, 1.0, 0.0, 6.0, 8.0, 4.0, 0.0, 3.0, 8.0, 8.0, 5.0, 4.0,
        2.0, 1.0, 4.0, 3.0, 0.0, 10.0, 4.0, 4.0, 3.0, 2.0, 4.0, 4.0, 10.0, 5.0, 1.0, 9.0, 5.0,
        10.0, 6.0, 8.0, 3.0, 2.0,
    ];
    let held: Vec<f64> =
        [2.0, 9.0, 5.0, 10.0, 1.0, 6.0, 3.0, 8.0].iter().flat_map(|m| [*m; 6]).collect();
    let rising = |n: usize| if n > 0 && sweeps[n] > sweeps[n - 1] { 1.0 } else { -1.0 };
    let hysteresis = |n: usize| {
        let x = sweeps[n] / 10.0;
        0.008 * rising(n) * 4.0 * x * (1.0 - x)
    };
    let creep = |n: usize| {
        let since = (n % 6) as f64;
        0.006 * 0.2 * held[n] * (1.0 - elementary::exp(-since / 2.0))
    };
    let warm_up = |n: usize| 0.012 * elementary::exp(-(n as f64) / 8.0);
    let memory = |n: usize| 0.0012 * mixed[n.saturating_sub(1)];
    let drift = |n: usize| 0.008 * n as f64 / 40.0;
    /// The name of an effect, the loads of the rows, and the effect on each row.
    type Acting<'a> = (&'a str, &'a [f64], &'a dyn Fn(usize) -> f64);
    let cases: [Acting<'_>; 5] = [
        ("hysteresis", &sweeps, &hysteresis),
        ("creep", &held, &creep),
        ("warm-up", &sweeps, &warm_up),
        ("memory", &mixed, &memory),
        ("drift", &sweeps, &drift),
    ];
    for (name, loads, effect) in cases {
        let folder = tempfile::tempdir().unwrap();
        let case = cell(folder.path(), &readings(loads, 3, effect), r#""order": "run","#, FIVE);
        let found = diagnosed(&case);
        let said = &found.most_probable;
        assert_eq!(said.effects, [name], "{:?} {}", said.effects, said.probability);
        assert!(said.probability > 0.7, "{name}: {}", said.probability);
        // of a list without it the composer names it
        let listed: Vec<String> = ["hysteresis", "creep", "warm-up", "memory", "drift"]
            .iter()
            .filter(|of| **of != name)
            .map(|of| format!("{of:?}"))
            .collect();
        let keys = format!(r#", "catalogue": [{}]"#, listed.join(", "));
        let case = cell(folder.path(), &readings(loads, 3, effect), r#""order": "run","#, &keys);
        let found = diagnosed(&case);
        let composed: Vec<&str> = found.composed.iter().map(|of| of.name.as_str()).collect();
        let of_list = found.unlisted.iter().any(|of| of.effect == name);
        assert!(
            of_list || composed.first().is_some_and(|of| of.contains(name)),
            "{name}: {composed:?}"
        );
    }
}
