//! What reports of small evaluations look like.
mod columns;
mod csv;
mod histogram;
mod json;
mod pages;
mod saved;
mod table;
mod units;
mod workbook;

use super::{EvaluationReport, Extent, Provenance, Shown};
use gumption_engine::distribution::{Correlation, Input};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::{Control, Evaluation, evaluate};
use gumption_engine::task::{Coverage, Settings, Task, Trials, Warning};
use gumption_measurements::InclinedPlane;
use gumption_units::Unit;

/// An evaluation with what belongs to it.
struct Case {
    task: Task,
    evaluation: Evaluation,
    warnings: Vec<Warning>,
    provenance: Provenance,
}

impl Case {
    fn new(task: Task) -> Self {
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let provenance = Provenance {
            model_sha256: "0123".to_owned(),
            files: vec![("data.csv".to_owned(), "4567".to_owned())],
        };
        Self { task, evaluation, warnings: Vec::new(), provenance }
    }

    fn report(&self) -> EvaluationReport<'_> {
        let Self { task, evaluation, warnings, provenance } = self;
        EvaluationReport { task, evaluation, warnings, provenance }
    }

    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&super::json(&self.report())).unwrap()
    }
}

fn settings(trials: u64) -> Settings {
    let coverage = Coverage::Probability(0.95);
    Settings::default().with_trials(Trials::Fixed(trials)).with_coverage(coverage)
}

/// The inclined plane of the literature at a tilt.
fn plane_at(tilt: f64, trials: u64) -> Task {
    let plane = InclinedPlane {
        a_ref: Input::normal(10.0, 0.01, "m/s^2").unwrap(),
        tilt: Input::rectangular(tilt, 0.1, "deg").unwrap(),
        rotation: Input::constant(0.0, "deg").unwrap(),
    };
    Task::of(plane, settings(trials)).unwrap()
}

/// Everything on a text page.
fn full() -> Shown<'static> {
    Shown { extent: Extent::Full, ..Shown::default() }
}

/// Only the output along z.
fn only_z(mut case: Case) -> Case {
    case.task.model.outputs.drain(..2);
    for row in &mut case.evaluation.rows {
        row.outputs.drain(..2);
        row.correlations.clear();
        row.correlation_errors.clear();
    }
    case
}

/// Readings, a normal with degrees of freedom, groups.
fn grouped(trials: u64) -> Task {
    let readings = [10.01, 9.98, 10.02, 10.0, 9.99];
    let tilt = gumption_engine::distribution::Normal::with_dof(35.0, 0.05, 12.0).unwrap();
    let plane = InclinedPlane {
        a_ref: Input::readings(&readings, "m/s^2").unwrap().about("repeatability"),
        tilt: Input { group: Some("angles".to_owned()), ..Input::new(tilt, "deg").unwrap() },
        rotation: Input {
            group: Some("angles".to_owned()),
            ..Input::rectangular(30.0, 0.1, "deg").unwrap()
        },
    };
    Task::of(plane, settings(trials)).unwrap()
}

fn correlated(trials: u64) -> Task {
    let plane = InclinedPlane {
        a_ref: Input::normal(10.0, 0.01, "m/s^2").unwrap(),
        tilt: Input::normal(35.0, 0.1, "deg").unwrap(),
        rotation: Input::constant(0.0, "deg").unwrap(),
    };
    let mut task = Task::of(plane, settings(trials)).unwrap();
    task.correlations = vec![Correlation { first: 0, second: 1, coefficient: -0.6 }];
    task
}

/// Rows of a sweep over the tilt, at a frequency that stays.
fn sweep(tilts: &[f64], trials: u64) -> Case {
    let mut cases = tilts.iter().map(|&tilt| (tilt, Case::new(plane_at(tilt, trials))));
    let (tilt, mut all) = cases.next().unwrap();
    all.evaluation.rows[0].conditions = vec![80.0, tilt];
    for (tilt, mut case) in cases {
        case.evaluation.rows[0].conditions = vec![80.0, tilt];
        all.evaluation.rows.append(&mut case.evaluation.rows);
    }
    let quantity = |name: &str, unit: &str| Quantity {
        name: name.to_owned(),
        unit: Unit::parse(unit).unwrap(),
        about: String::new(),
    };
    all.task.model.conditions = vec![quantity("f", "Hz"), quantity("tilt", "deg")];
    all.task.model.program.variables += 2;
    all.task.rows[0].conditions = vec![80.0, tilt];
    all.task.swept = true;
    all
}
