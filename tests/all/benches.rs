//! The model files that speed is measured with compute what they are said to compute.

use std::path::Path;

use gumption::file::{Override, read};
use gumption::propagate::gum::Dof;
use gumption::propagate::{Control, OutputEvaluation, evaluate};
use gumption::task::{Task, Trials};

use crate::support::root;

const TRIALS: u64 = 1_000_000;

fn task(file: &str, trials: u64) -> Task {
    let path = root().join(Path::new("benches/models")).join(file);
    let mut task = read(&path, &[]).unwrap_or_else(|e| panic!("{file}: {e}")).task;
    task.settings.trials = Trials::Fixed(trials);
    task.settings.coverage = 0.95.into();
    task
}

fn only_output(task: &Task) -> OutputEvaluation {
    let mut evaluation = evaluate(task, &Control::default()).unwrap();
    evaluation.rows.remove(0).outputs.remove(0)
}

/// Mean, standard uncertainty and symmetric 95 % interval within six numerical standard errors of
/// the run: four figures at a fixed seed, 1e-8 to fail by chance. The references' own errors are
/// below a fifth of these.
fn compare(file: &str, mean: f64, u: f64, interval: [f64; 2]) {
    let output = only_output(&task(file, TRIALS));
    let found = output.monte_carlo.unwrap();
    let errors = &found.errors;
    let near = |found: f64, right: f64, error: f64, what: &str| {
        assert!((found - right).abs() < 6.0 * error, "{file}: {what} {found}, not {right}");
    };
    near(found.location(), mean, errors.estimate.unwrap(), "mean");
    let u_error = errors.standard_uncertainty.unwrap();
    near(found.standard_uncertainty.unwrap(), u, u_error, "u");
    let ends = found.symmetric_interval.into_iter().zip(interval).zip(errors.symmetric_interval);
    for ((found, right), error) in ends {
        near(found, right, error, "end");
    }
}

/// W1, both forms, against 3.2e7 trials of benches/peers.py in numpy.
#[test]
fn the_plane() {
    for file in ["plane_typed.json", "plane_formula.json"] {
        compare(file, 5.247_086, 0.010_861_6, [5.226_062, 5.268_001]);
    }
}

/// W2 against JCGM 101, 9.2.3 (u exactly 2) with the end to more digits: 3.8794 is twice the root
/// of three times what the sum of four standard uniform numbers exceeds its mean by with 2.5 %, the
/// root of (4 - s)^4/24 = 0.025.
#[test]
fn the_sum() {
    let end = 2.0 * 3f64.sqrt() * (2.0 - (24.0 * 0.025f64).powf(0.25));
    assert!((end - 3.879).abs() < 5e-4);
    compare("sum_of_four.json", 0.0, 2.0, [-end, end]);
}

/// W4 against 3.2e7 trials of benches/peers.py in numpy; JCGM 101, 9.5.4 gives 838 nm and 36 nm.
#[test]
fn the_gauge_block() {
    compare("gauge_block.json", 837.990, 35.807, [767.654, 908.327]);
}

/// W3: equations (8) to (10) of the source written out here, at all 384 conditions of the table's
/// rule. The table's amplitudes have twelve digits.
#[test]
fn the_campaign() {
    let evaluation = evaluate(&task("campaign.json", 0), &Control::default()).unwrap();
    let mut rows = evaluation.rows.iter();
    for tilt in [15.0, 35.0, 55.0, 75.0] {
        for rotation in (0..8).map(|eighth| 45.0 * f64::from(eighth)) {
            for k in (0..12).map(f64::from) {
                let phases = [40.0 + 5.0 * k, -65.0 + 5.0 * k, 3.0];
                let amplitudes = [0.30, 0.20, 0.15].map(|a| a * (1.0 + k) / 6.0);
                let right = plane(f64::to_radians(tilt), rotation.to_radians(), amplitudes, phases);
                let outputs = &rows.next().unwrap().outputs;
                for (output, right) in outputs.iter().zip(right) {
                    let estimate = output.gum.as_ref().unwrap().estimate;
                    let what = format!("{tilt} {rotation} {k}: {estimate}, not {right}");
                    assert!((estimate - right).abs() < 1e-11, "{what}");
                }
            }
        }
    }
    assert!(rows.next().is_none());
}

fn plane(tilt: f64, rotation: f64, [x, y, z]: [f64; 3], phases: [f64; 3]) -> [f64; 3] {
    let phases = phases.map(f64::to_radians);
    let modulus = |reference: f64, terms: [f64; 3]| {
        let sum = |part: fn(f64) -> f64| -> f64 {
            terms.iter().zip(phases).map(|(term, phase)| term.abs() * part(phase)).sum()
        };
        (reference.abs() + sum(f64::cos)).hypot(sum(f64::sin))
    };
    let ((st, ct), (sr, cr)) = (tilt.sin_cos(), rotation.sin_cos());
    [
        modulus(10.0 * st * cr, [x * ct * cr, y * sr, z * st * cr]),
        modulus(10.0 * st * sr, [x * ct * sr, y * cr, z * st * sr]),
        modulus(10.0 * ct, [x * st, 0.0, z * ct]),
    ]
}

/// W5: a budget of the plane with four degrees of freedom for each phase, against GTC 1.5.1
/// (benches/peers.py), which computes in doubles too: 1e-12 leaves room for other orders of sums.
#[test]
fn a_budget() {
    let path = root().join("benches/models/plane_typed.json");
    let overrides = ["phase_x_syst", "phase_y_syst", "phase_z_syst"]
        .map(|phase| Override::parse(&format!("{phase}.dof=4")).unwrap());
    let mut task = read(&path, &overrides).unwrap_or_else(|e| panic!("{e}")).task;
    task.settings.trials = Trials::Fixed(0);
    let gum = only_output(&task).gum.unwrap();
    let near = |found: f64, right: f64| {
        assert!((found / right - 1.0).abs() < 1e-12, "{found}, not {right}");
    };
    near(gum.estimate, 5.247_257_068_542_094);
    near(gum.standard_uncertainty, 0.010_862_938_015_004_011);
    let Dof::Finite(dof) = gum.dof else { panic!("{:?}", gum.dof) };
    near(dof, 93.055_743_481_632_32);
}
