//! A simulator of one's own: the pendulum of `models/simulators/pendulum` as a Rust function, and its gap.
//!
//! ```sh
//! cargo run --release --example own_simulator
//! ```
#![allow(clippy::disallowed_methods)] // the simulator's own functions

use std::error::Error;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use gumption::gap::DiagnosisOptions;
use gumption::gap::simulated::{ParameterSet, Runs, SimulatorDiagnosis, diagnose, simulator_case};

/// The longest step in s.
const STEP: f64 = 0.0125;

/// What the pendulum is run with, in the order of the case: inputs, then parameters of effects.
struct Pendulum {
    length: f64,
    g: f64,
    release: f64,
    viscous: f64,
    quadratic: f64,
    coulomb: f64,
}

impl Pendulum {
    /// The rates of the angle in rad and of its rate in rad/s.
    fn slopes(&self, [angle, rate]: [f64; 2]) -> [f64; 2] {
        let friction = self.viscous * rate
            + self.quadratic * rate * rate.abs()
            + self.coulomb * (rate / 0.005).tanh();
        [rate, -self.g / self.length * angle.sin() - friction]
    }

    /// Angles in mrad at times in s, by Runge and Kutta's method of fourth order.
    fn swing(&self, times: &[f64]) -> Vec<f64> {
        let moved = |at: [f64; 2], by: [f64; 2], h: f64| [at[0] + h * by[0], at[1] + h * by[1]];
        let (mut at, mut time) = ([self.release, 0.0], 0.0);
        let mut angles = Vec::with_capacity(times.len());
        for &row in times {
            let steps = ((row - time) / STEP - 1e-6).ceil().max(0.0);
            let h = (row - time) / steps.max(1.0);
            for _ in 0..steps as usize {
                let a = self.slopes(at);
                let b = self.slopes(moved(at, a, h / 2.0));
                let c = self.slopes(moved(at, b, h / 2.0));
                let d = self.slopes(moved(at, c, h));
                for i in 0..2 {
                    at[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
                }
            }
            time = row;
            angles.push(1e3 * at[0]);
        }
        angles
    }
}

/// One run: all parameters of the case, and the times of its rows.
fn run(set: &ParameterSet, times: &[f64]) -> Result<Vec<f64>, String> {
    let [length, g, release, viscous, quadratic, coulomb] = set.values[..] else {
        return Err(format!("the parameters are {}", set.names.join(", ")));
    };
    Ok(Pendulum { length, g, release, viscous, quadratic, coulomb }.swing(times))
}

/// The diagnosis of the measured swing, with at most 300 runs.
pub(crate) fn diagnosed() -> Result<SimulatorDiagnosis, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/simulators/pendulum");
    let case = gumption::file::read_case(&folder.join("case.json"))?.case;
    let given = simulator_case(&case, &case.task.rows).ok_or("the case has no simulator")?;
    let times = &given.conditions[0].values;
    // sets of parameters may be run at once, on threads or on other machines
    let mut make = |sets: &[ParameterSet]| sets.iter().map(|set| run(set, times)).collect();
    let kept = Runs::new(given.parameter_names());
    let never = AtomicBool::new(false);
    let found = diagnose(&case, &mut make, 300, kept, DiagnosisOptions::new(1), &|_| (), &never)?;
    Ok(found.ok_or("interrupted")?)
}

#[allow(dead_code, clippy::print_stdout)]
fn main() -> Result<(), Box<dyn Error>> {
    let found = diagnosed()?;
    let verdict = &found.diagnosis.most_probable;
    println!("{} with probability {:.3}", verdict.effects.join(" + "), verdict.probability);
    for parameter in found.diagnosis.hypotheses.iter().take(1).flat_map(|best| &best.parameters) {
        let [low, high] = parameter.interval;
        println!("{} = {:.4}, from {low:.4} to {high:.4}", parameter.name, parameter.estimate);
    }
    println!("{} runs", found.ending.runs);
    Ok(())
}
