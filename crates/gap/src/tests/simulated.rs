//! A pendulum that loses energy, of which only a program is there: its gap from runs.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_emulator::{Parameter, Run, RunKey, Runs, SimulatorEffect, Space};
use gumption_engine::distribution::{Distribution, LogUniform, Normal, Rectangular, StreamKey};
use gumption_engine::model::formula::{Scope, Typing};
use gumption_engine::model::{InputQuantity, NumberForm, Output, Quantity};
use gumption_engine::special::normal;
use gumption_engine::task::{Row, Task, Variable};
use gumption_units::Unit;

use crate::simulated::{ParameterSet, SimulatorDiagnosis, design, diagnose, diagnose_made};
use crate::{
    Candidate, Case, DiagnosisOptions, Effect, HypothesisKind, ModelForm, ObservedOutput,
    OverridableModel, Prior, SimulatorModel, simulator_conditions,
};

const ROWS: usize = 250;

/// Standard uncertainty of an angle, in rad.
const U: f64 = 3e-4;

/// The length in m and the release angle in rad of the pendulum that was measured.
const LENGTH: f64 = 0.6195;
const RELEASE: f64 = 0.3995;

/// The budget of runs.
const RUNS: usize = 150;
const BUDGET: usize = RUNS;

/// The same of the noisy program.
const NOISY_RUNS: usize = 100;

/// A diagnosis that nobody stops.
static NEVER: AtomicBool = AtomicBool::new(false);

fn quantity(name: &str, unit: &str) -> Quantity {
    Quantity { name: name.to_owned(), unit: Unit::parse(unit).unwrap(), about: String::new() }
}

/// Angles of a pendulum every 0.1 s in mrad: length in m, release angle in rad, quadratic air drag and dry
/// friction of the pivot as a share of the weight's largest torque. Runge and Kutta's method of fourth order.
fn swing(rows: usize, [length, release, drag, pivot]: [f64; 4]) -> Vec<f64> {
    let gl = 9.80665 / length;
    let slope = |[angle, rate]: [f64; 2]| {
        let friction = drag * rate * rate.abs() + pivot * gl * (rate / 0.05).tanh();
        [rate, -gl * angle.sin() - friction]
    };
    let moved = |at: [f64; 2], by: [f64; 2], h: f64| [at[0] + h * by[0], at[1] + h * by[1]];
    let h = 0.05;
    let mut at = [release, 0.0];
    let mut angles = Vec::with_capacity(rows);
    for _ in 0..rows {
        for _ in 0..2 {
            let a = slope(at);
            let b = slope(moved(at, a, h / 2.0));
            let c = slope(moved(at, b, h / 2.0));
            let d = slope(moved(at, c, h));
            for i in 0..2 {
                at[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
        }
        angles.push(1e3 * at[0]);
    }
    angles
}

/// The program, which knows parameters by their names.
fn run(set: &ParameterSet) -> Result<Vec<f64>, String> {
    let value = |name: &str, absent: f64| {
        let place = set.names.iter().position(|known| known == name);
        place.map_or(absent, |place| set.values[place])
    };
    let [length, release, drag, pivot] =
        ["length", "release", "drag", "pivot"].map(|name| value(name, 0.0));
    Ok(swing(ROWS, [length, release, drag, pivot * value("load", 1.0)]))
}

/// The case of a pendulum of 0.6195 m with some drag and friction, and these of both on the list.
fn pendulum(drag: f64, pivot: f64, listed: &[&str]) -> Case {
    let inputs = [("length", "m", (0.62, 0.002)), ("release", "rad", (0.4, 0.001))];
    let known = inputs.map(|(_, _, (mean, std))| Normal::new(mean, std).unwrap().into());
    let known: Vec<Distribution> = known.into();
    let drags: Distribution = Rectangular::between(0.0, 0.03).unwrap().into();
    let friction = ("pivot", LogUniform::new(1e-5, 1e-2).unwrap().into());
    let effects: [(&str, Vec<(&str, Distribution)>); 3] = [
        ("air-drag", vec![("drag", drags)]),
        ("pivot-friction", vec![friction.clone()]),
        (
            PRODUCT,
            vec![
                friction,
                ("load", LogUniform::new(0.5, 2.0).unwrap().into()),
                ("idle", Rectangular::between(0.0, 1.0).unwrap().into()),
            ],
        ),
    ];
    let effects = effects.into_iter().filter(|(name, _)| listed.contains(name));
    let mut candidates = Vec::new();
    let mut of_simulator = Vec::new();
    for (number, (name, parameters)) in effects.enumerate() {
        let known = parameters.iter();
        let known =
            known.map(|(name, prior)| Parameter { name: (*name).into(), prior: prior.clone() });
        of_simulator.push(SimulatorEffect {
            name: name.to_owned(),
            parameters: known.collect(),
            neutral: vec![(0, 0.0)],
        });
        candidates.push(Candidate {
            effect: Effect {
                name: name.to_owned(),
                parameters: parameters.iter().map(|(name, _)| quantity(name, "1")).collect(),
                overrides: Vec::new(),
            },
            priors: parameters.into_iter().map(|(_, prior)| prior).collect(),
            about: String::new(),
            source: String::new(),
            simulator: Some(number),
        });
    }
    let parameters = inputs
        .iter()
        .zip(&known)
        .map(|((name, ..), prior)| Parameter { name: (*name).to_owned(), prior: prior.clone() });
    let space = Space::new(parameters.collect(), of_simulator).unwrap();
    let given = quantity("angle", "mrad");
    let mut conditions = vec![quantity("t", "s")];
    conditions.extend(simulator_conditions([given]));
    let names = inputs.map(|(name, unit, _)| (name, unit));
    let typed = names.into_iter().chain([("t", "s"), ("angle", "rad")]);
    let model = OverridableModel {
        inputs: names
            .map(|(name, unit)| InputQuantity { quantity: quantity(name, unit), parts: 1 })
            .into(),
        conditions,
        outputs: vec![Output::new(quantity("angle", "rad"))],
        maker: ModelForm::Simulated,
        scope: Scope::from_iter(
            typed.map(|(name, unit)| (name, Typing::in_unit(&Unit::parse(unit).unwrap()))),
        ),
        numbers: NumberForm::Coherent,
    };
    let mut uniforms = [0.0; 256];
    StreamKey::new(1, "noise").block(0).uniform(&mut uniforms);
    let noise = uniforms.into_iter().map(normal::quantile);
    let values: Vec<f64> = swing(ROWS, [LENGTH, RELEASE, drag, pivot])
        .into_iter()
        .zip(noise)
        .map(|(angle, noise)| 1e-3 * angle + U * noise)
        .collect();
    let known: Arc<[Arc<Distribution>]> = known.into_iter().map(Arc::new).collect();
    let row = |number: usize| Row {
        conditions: vec![0.1 * (number + 1) as f64, 1e3 * values[number], number as f64],
        distributions: Arc::clone(&known),
    };
    let variables = names.map(|(name, unit)| Variable::new(name, Unit::parse(unit).unwrap()));
    let task = Task::new(model.model().unwrap(), variables.into(), (0..ROWS).map(row).collect());
    Case {
        task,
        model,
        observed: vec![Some(ObservedOutput {
            values,
            last_digit: None,
            standard_uncertainties: Some(vec![U; ROWS]),
            simulation_uncertainties: None,
            simulation_covariance: None,
        })],
        simulated: 2,
        simulator: Some(Arc::new(SimulatorModel::new(space))),
        history: Vec::new(),
        reachable: Vec::new(),
        candidates,
        shipped: Vec::new(),
        replication: None,
        prior: Prior::DEFAULT,
    }
}

/// The diagnosis of a case, and how many runs were made for it.
fn diagnosed(case: &Case, kept: Runs) -> (SimulatorDiagnosis, usize) {
    let mut count = 0;
    let mut make = |sets: &[ParameterSet]| {
        count += sets.len();
        sets.iter().map(run).collect()
    };
    let options = DiagnosisOptions::new(1);
    let of = diagnose(case, &mut make, BUDGET, kept, options, &|_| {}, &NEVER).unwrap().unwrap();
    (of, count)
}

fn no_runs(case: &Case) -> Runs {
    Runs::new(case.simulator.as_ref().unwrap().space().names().to_vec())
}

/// Dry friction as the product of a coefficient and a load; what is idle does nothing.
const PRODUCT: &str = "loaded-pivot";

const BOTH: [&str; 2] = ["air-drag", "pivot-friction"];

/// Dry friction changes the angles by more than 1000 u in norm; the interval of its size holds the truth with
/// the probability 0.95, and within twice its width all but surely.
#[test]
fn the_loss_of_a_pendulum_is_named() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let (found, count) = diagnosed(&case, no_runs(&case));
    let verdict = &found.diagnosis.most_probable;
    assert_eq!(verdict.effects, ["pivot-friction"]);
    assert!(verdict.kind == HypothesisKind::Explained && verdict.probability > 0.8, "{verdict:?}");
    assert!(count <= RUNS && found.ending.open.is_empty(), "{count} {:?}", found.ending);
    assert_eq!(found.diagnosis.conditions.len(), 1);
    // the last runs are those of the simulator itself at the verdict: they leave the noise
    let last = found.last[0].result.as_ref().unwrap();
    let measured = &case.observed[0].as_ref().unwrap().values;
    let square: f64 =
        last.iter().zip(measured).map(|(a, b)| ((1e-3 * a - b) / U).powi(2)).sum::<f64>();
    // chi-square of 250 values, of which the runs know three parameters: 6 standard deviations are 134
    assert!((square - 250.0).abs() < 134.0, "{square}");
    // who kept the runs makes none again, and finds the same
    let runs = found.runs.clone();
    let (again, count) = diagnosed(&case, runs);
    assert_eq!(count, 0);
    assert_eq!(again.diagnosis.most_probable.probability, verdict.probability);
}

/// Both losses act, and together they change the angles by hundreds of u less than the sum of both.
#[test]
fn two_losses_of_a_pendulum_are_named() {
    let case = pendulum(0.012, 8e-4, &BOTH);
    let (found, _) = diagnosed(&case, no_runs(&case));
    let verdict = &found.diagnosis.most_probable;
    assert_eq!(verdict.effects, BOTH);
    assert!(verdict.probability > 0.8, "{verdict:?}");
}

/// Friction that ends the swings earlier than any drag does: the program at its best leaves a chi-square of
/// more than 800 000 for 250 values.
#[test]
fn a_loss_that_is_not_on_the_list_is_unexplained() {
    let case = pendulum(0.0, 3e-3, &["air-drag"]);
    let (found, _) = diagnosed(&case, no_runs(&case));
    let verdict = &found.diagnosis.most_probable;
    assert_eq!(verdict.kind, HypothesisKind::Unexplained, "{verdict:?}");
    assert!(verdict.probability > 0.8, "{verdict:?}");
}

#[test]
fn a_pendulum_without_losses_has_no_gap() {
    let case = pendulum(0.0, 0.0, &BOTH);
    let (found, _) = diagnosed(&case, no_runs(&case));
    let verdict = &found.diagnosis.most_probable;
    assert_eq!(verdict.kind, HypothesisKind::None, "{verdict:?}");
}

/// A program that fails says at which parameters.
#[test]
fn runs_that_fail_are_told_with_their_parameters() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let mut make = |sets: &[ParameterSet]| vec![Err("no licence".to_owned()); sets.len()];
    let options = DiagnosisOptions::new(1);
    let found = diagnose(&case, &mut make, BUDGET, no_runs(&case), options, &|_| {}, &NEVER);
    let said = found.unwrap_err().to_string();
    assert!(said.contains("no licence") && said.contains("length = 0.6"), "{said}");
    let mut few = |_: &[ParameterSet]| Vec::new();
    let found = diagnose(&case, &mut few, BUDGET, no_runs(&case), options, &|_| {}, &NEVER);
    assert!(found.unwrap_err().to_string().contains("0 came back"));
    let found = diagnose(&case, &mut few, 5, no_runs(&case), options, &|_| {}, &NEVER);
    assert!(found.unwrap_err().to_string().contains("times at least"));
}

/// A diagnosis that is stopped before the last run has no result.
#[test]
fn a_stop_while_runs_are_made_ends_the_diagnosis() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let stop = AtomicBool::new(false);
    let mut make = |_: &[ParameterSet]| {
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        Vec::new()
    };
    let options = DiagnosisOptions::new(1);
    let found = diagnose(&case, &mut make, BUDGET, no_runs(&case), options, &|_| {}, &stop);
    assert!(found.unwrap().is_none());
}

/// The pendulum with dry friction in the 25 s after those of the data: the angles are known better than one of
/// them is measured.
#[test]
fn a_corrected_pendulum_is_predicted_where_it_was_not_measured() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let (found, _) = diagnosed(&case, no_runs(&case));
    let row = |of: &Row| Row { conditions: vec![of.conditions[0] + 25.0], ..of.clone() };
    let rows: Vec<Row> = case.task.rows.iter().map(row).collect();
    let there = |parameters| swing(2 * ROWS, parameters).split_off(ROWS);
    let mut count = 0;
    let mut make = |sets: &[ParameterSet]| {
        count += sets.len();
        sets.iter().map(|set| Ok(there([0, 1, 2, 3].map(|place| set.values[place])))).collect()
    };
    let predicted = found.predict(rows, &mut make, 30, no_runs(&case)).unwrap();
    assert!(count <= 45, "{count}");
    assert_eq!(predicted.runs.made().len(), count);
    let truth = there([LENGTH, RELEASE, 0.0, 3e-4]);
    let rows = predicted.diagnosis.prediction.unwrap();
    assert_eq!((rows.len(), rows[0].conditions.len()), (ROWS, 1));
    for (row, truth) in rows.iter().zip(&truth) {
        let (value, u) = row.outputs[0];
        let error = (value - 1e-3 * truth) / u;
        // all rows depart together, by the errors of few parameters: four standard deviations
        assert!(error.abs() < 4.0 && u > 0.0 && u < U, "{error} {u}");
    }
}

/// A noisy program: to its angles normal numbers are added that follow from the number of the call, of so many u
/// and with a correlation coefficient of neighbours.
fn noisy(call: usize, set: &ParameterSet, scatter: f64, correlation: f64) -> Vec<f64> {
    let mut uniforms = [0.0; 256];
    StreamKey::new(7, "scatter").block(call as u64).uniform(&mut uniforms);
    let mut before = 0.0;
    let mut angles = run(set).unwrap();
    for (row, (angle, uniform)) in angles.iter_mut().zip(uniforms).enumerate() {
        let own = if row == 0 { 1.0 } else { (1.0 - correlation * correlation).sqrt() };
        before = correlation * before + own * normal::quantile(uniform);
        *angle += 1e3 * U * scatter * before;
    }
    angles
}

/// The diagnosis of a case by the noisy program, and how many runs were made for it.
fn diagnosed_noisy(case: &mut Case, scatter: f64) -> (SimulatorDiagnosis, usize) {
    let model = SimulatorModel::new(case.simulator.as_ref().unwrap().space().clone());
    case.simulator = Some(Arc::new(model.noisy(true)));
    let mut count = 0;
    let mut one = |set: &ParameterSet| {
        count += 1;
        Ok(noisy(count, set, scatter, 0.0))
    };
    let mut make = |sets: &[ParameterSet]| sets.iter().map(&mut one).collect();
    let options = DiagnosisOptions::new(1);
    let of = diagnose(case, &mut make, NOISY_RUNS, no_runs(case), options, &|_| {}, &NEVER);
    (of.unwrap().unwrap(), count)
}

/// How often a note with this key was given.
fn notes(of: &SimulatorDiagnosis, code: &str) -> usize {
    of.diagnosis.notes.iter().filter(|note| note.fact.key == code).count()
}

/// The program scatters by 0.3 u in each row: the friction is named, and its interval of 0.95, twice as wide as it
/// is, holds the truth. The scatter is known to 1/sqrt(2*3*250) = 2.6 %, of which four times are allowed.
#[test]
fn the_loss_of_a_noisy_pendulum_is_named() {
    let mut case = pendulum(0.0, 3e-4, &BOTH);
    let (found, count) = diagnosed_noisy(&mut case, 0.3);
    let verdict = &found.diagnosis.most_probable;
    assert_eq!(verdict.effects, ["pivot-friction"]);
    assert!(verdict.kind == HypothesisKind::Explained && verdict.probability > 0.8, "{verdict:?}");
    let pivot = &found.diagnosis.present[0].parameters[0];
    let [lower, upper] = pivot.interval;
    let half = 0.5 * (upper - lower);
    assert!((pivot.estimate - 3e-4).abs() < 2.0 * half && half < 1e-5, "{pivot:?}");
    let scatter = found.scatter.as_ref().unwrap().outputs()[0];
    assert!((scatter.deviation - 0.3).abs() < 0.1 * 0.3 && scatter.correlation == 0.0);
    assert_eq!(notes(&found, "simulator.scatter"), 1);
    assert!(count <= NOISY_RUNS && found.ending.runs == count, "{count} {:?}", found.ending);
    let repeats = found.runs.made().iter().filter(|run| run.repetition > 0).count();
    assert!(repeats >= 3, "{repeats}");
}

/// Data without a gap raise no alarm, though the program scatters as much as they do.
#[test]
fn a_noisy_pendulum_without_a_gap_raises_no_alarm() {
    let mut case = pendulum(0.0, 0.0, &BOTH);
    let (found, _) = diagnosed_noisy(&mut case, 1.0);
    let verdict = &found.diagnosis.most_probable;
    assert!(verdict.kind == HypothesisKind::None && verdict.probability > 0.8, "{verdict:?}");
}

/// A program that gives something else again is an error if it is not said to be noisy: 1 u in one row, and
/// none where the difference is below 0.05 u in norm.
#[test]
fn a_program_that_does_not_repeat_is_an_error() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let said = |difference: f64| {
        let mut count = 0;
        let mut one = |set: &ParameterSet| {
            let mut angles = run(set)?;
            angles[41] += 1e3 * U * difference * f64::from(count);
            // the second run is the repeat, and those after it are all alike
            count = if count == 0 { 1 } else { 0 };
            Ok(angles)
        };
        let mut make = |sets: &[ParameterSet]| sets.iter().map(&mut one).collect();
        let options = DiagnosisOptions::new(1);
        let budget = 60;
        diagnose(&case, &mut make, budget, no_runs(&case), options, &|_| {}, &NEVER)
            .map_err(|error| error.to_string())
    };
    let error = said(1.0).unwrap_err();
    for part in ["differ by 1.0 standard", "`angle` in row 42", "\"noisy\": true", "noisy=True"] {
        assert!(error.contains(part), "{error}");
    }
    let found = said(0.04).unwrap().unwrap();
    assert_eq!(notes(&found, "simulator.scatter"), 0);
}

/// The runs of a design with those of a program that scatters so much.
fn made_of_design(case: &Case, count: usize, scatter: f64) -> Runs {
    let names: Arc<[String]> = case.simulator.as_ref().unwrap().space().names().into();
    let mut kept = no_runs(case);
    let asked = design(case, count, 1).unwrap();
    for (call, RunKey { parameters, repetition }) in asked.into_iter().enumerate() {
        let set = ParameterSet { names: names.clone(), values: parameters.clone(), repetition };
        let result = Ok(noisy(call, &set, scatter, 0.0));
        kept.keep(Run { parameters, repetition, result }).unwrap();
    }
    kept
}

/// Runs of a design that were made elsewhere, and those that would tell more, until nothing is left open: what
/// the first ones name is open, and what the last ones name is right.
#[test]
fn a_diagnosis_takes_runs_that_were_made_before() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let mut kept = made_of_design(&case, 100, 0.0);
    let names: Arc<[String]> = case.simulator.as_ref().unwrap().space().names().into();
    for round in 0..6 {
        let options = DiagnosisOptions::new(1);
        let found = diagnose_made(&case, kept.clone(), options, &|_| {}, &NEVER).unwrap().unwrap();
        assert_eq!(found.ending.runs, kept.made().len());
        assert!(found.ending.open.is_empty() || !found.more.is_empty());
        println!(
            "{:?} {} {:?} {}",
            found.ending,
            found.more.len(),
            found.diagnosis.most_probable.effects,
            found.diagnosis.most_probable.probability
        );
        if found.more.is_empty() {
            assert_eq!(found.diagnosis.most_probable.effects, ["pivot-friction"]);
            assert!(round > 0);
            return;
        }
        for parameters in found.more.into_iter().filter(|of| found.runs.find(of).is_none()) {
            let set =
                ParameterSet { names: names.clone(), values: parameters.clone(), repetition: 0 };
            kept.keep(Run { parameters, repetition: 0, result: run(&set) }).unwrap();
        }
    }
    panic!("still open with {} runs", kept.made().len());
}

/// Of a program that is noisy some runs of a design have the same parameters, and show its scatter.
#[test]
fn runs_that_were_made_before_show_a_scatter() {
    let mut case = pendulum(0.0, 3e-4, &BOTH);
    let model = SimulatorModel::new(case.simulator.as_ref().unwrap().space().clone());
    case.simulator = Some(Arc::new(model.noisy(true)));
    let kept = made_of_design(&case, 40, 0.3);
    let options = DiagnosisOptions::new(1);
    let found = diagnose_made(&case, kept, options, &|_| {}, &NEVER).unwrap().unwrap();
    let scatter = found.scatter.unwrap().outputs()[0].deviation;
    // as above
    assert!((scatter - 0.3).abs() < 0.1 * 0.3, "{scatter:?}");
}

#[test]
fn runs_of_other_rows_are_refused() {
    let case = pendulum(0.0, 3e-4, &BOTH);
    let mut kept = no_runs(&case);
    let parameters = vec![0.62, 0.4, 0.0, 0.0];
    kept.keep(Run { parameters, repetition: 0, result: Ok(vec![0.0; ROWS - 1]) }).unwrap();
    let options = DiagnosisOptions::new(1);
    let found = diagnose_made(&case, kept, options, &|_| {}, &NEVER);
    assert!(found.unwrap_err().to_string().contains("has 249 values, and the data have 250"));
}

/// What is noted of parameters that the data do not tell, as text.
fn untold(case: &Case) -> Vec<String> {
    let (found, _) = diagnosed(case, no_runs(case));
    let notes = found.diagnosis.notes.iter().map(|note| format!("{:?}", note.fact));
    notes.filter(|fact| fact.contains(".untold") || fact.contains(".together")).collect()
}

/// The product of coefficient and load is known to about a hundredth, and each within a factor of four at best:
/// their logarithms have a correlation coefficient of about -0.999. Of what does nothing the prior stays.
#[test]
fn parameters_that_the_data_cannot_tell_are_noted() {
    let noted = untold(&pendulum(0.0, 3e-4, &["air-drag", PRODUCT]));
    let [idle, both] = &noted[..] else { panic!("{noted:?}") };
    assert!(idle.contains("loaded-pivot/idle") && !idle.contains("loaded-pivot/pivot"), "{idle}");
    assert!(both.contains("loaded-pivot/load") && both.contains("loaded-pivot/pivot"), "{both}");
    assert_eq!(untold(&pendulum(0.0, 3e-4, &BOTH)), [""; 0]);
}
