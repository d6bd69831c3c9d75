//! How many times smaller the variance of interval ends is with quasi-random points than with as many
//! trials: `cargo run --release -p gumption-engine --example quasi_variance`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)]

use gumption_engine::distribution::{Arcsine, Distribution, Input, Normal, Rectangular, StudentT};
use gumption_engine::propagate::{Accuracy, Control, evaluate};
use gumption_engine::task::{MethodChoice, Settings, Task, Trials};

/// Points of all randomizations together.
const POINTS: u64 = 1 << 16;

/// Runs whose scatter is the variance of the trials.
const RUNS: u64 = 100;

type Made = Result<Distribution, Box<dyn std::error::Error>>;

fn rectangular(mean: f64, half_width: f64) -> Made {
    Ok(Rectangular::new(mean, half_width)?.into())
}

fn normal(mean: f64, std: f64) -> Made {
    Ok(Normal::new(mean, std)?.into())
}

fn t(mean: f64, scale: f64, dof: f64) -> Made {
    Ok(StudentT::new(mean, scale, dof)?.into())
}

fn task(
    inputs: Vec<(&str, Made)>,
    equations: &[(&str, &str)],
) -> Result<Task, Box<dyn std::error::Error>> {
    let mut settings =
        Settings::default().with_trials(Trials::Fixed(POINTS)).with_coverage(0.95.into());
    settings.method = Some(MethodChoice::Quasi);
    let mut builder = Task::builder("variance").settings(settings);
    for (name, distribution) in inputs {
        builder = builder.input(name, Input::new(distribution?, "1")?);
    }
    for (name, formula) in equations {
        builder = builder.equation(name, formula);
    }
    Ok(builder.output("y", "1").build()?)
}

/// Acceleration on an inclined plane with spurious components (Prato, Mazzoleni, Schiavi 2020).
fn inclined_plane() -> Result<Task, Box<dyn std::error::Error>> {
    let degree = std::f64::consts::PI / 180.0;
    let inputs = vec![
        ("a", normal(10.0, 0.01)),
        ("tilt", rectangular(35.0 * degree, 0.1 * degree)),
        ("turn", rectangular(30.0 * degree, 0.1 * degree)),
        ("ax", rectangular(0.3, 0.0025)),
        ("ay", rectangular(0.2, 0.0025)),
        ("az", rectangular(0.1, 0.0025)),
        ("px", t(120.0 * degree, 2.0 * degree, 4.0)),
        ("py", t(-60.0 * degree, 2.0 * degree, 4.0)),
        ("pz", t(5.0 * degree, 2.0 * degree, 4.0)),
    ];
    let equations = [
        ("r", "abs(a*sin(tilt)*cos(turn))"),
        ("x", "abs(ax*cos(tilt)*cos(turn))"),
        ("v", "abs(ay*sin(turn))"),
        ("z", "abs(az*sin(tilt)*cos(turn))"),
        ("re", "r + x*cos(px) + v*cos(py) + z*cos(pz)"),
        ("im", "x*sin(px) + v*sin(py) + z*sin(pz)"),
        ("y", "hypot(re, im)"),
    ];
    task(inputs, &equations)
}

/// The gauge block of JCGM 101, 9.5, in nanometres.
fn gauge_block() -> Result<Task, Box<dyn std::error::Error>> {
    let inputs = vec![
        ("ls", t(50_000_623.0, 25.0, 18.0)),
        ("D", t(215.0, 6.0, 24.0)),
        ("d1", t(0.0, 4.0, 5.0)),
        ("d2", t(0.0, 7.0, 8.0)),
        ("as", rectangular(11.5e-6, 2e-6)),
        ("t0", normal(-0.1, 0.2)),
        ("Delta", Ok(Arcsine::new(0.0, 0.5)?.into())),
        ("da", rectangular(0.0, 1e-6)),
        ("dt", rectangular(0.0, 0.05)),
    ];
    let length = "(ls*(1 + as*(t0 + Delta + dt)) + D + d1 + d2)/(1 + (as + da)*(t0 + Delta))";
    task(inputs, &[("y", length)])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (name, mut task) in [("inclined plane", inclined_plane()?), ("gauge block", gauge_block()?)]
    {
        let control = Control::default();
        let quasi = evaluate(&task, &control)?;
        let Some(Ok(quasi)) = &quasi.rows[0].outputs[0].noiseless else {
            return Err("no quasi-random figures".into());
        };
        let Accuracy::Scatter(scatter) = &quasi.accuracy else {
            return Err("no standard errors".into());
        };
        task.settings.method = Some(MethodChoice::MonteCarlo);
        let mut ends = Vec::new();
        for seed in 0..RUNS {
            task.settings.seed = seed;
            let run = evaluate(&task, &control)?;
            ends.extend(
                run.rows[0].outputs[0].monte_carlo.as_deref().map(|m| m.symmetric_interval),
            );
        }
        for (end, which) in ["lower", "upper"].into_iter().enumerate() {
            let n = ends.len() as f64;
            let mean = ends.iter().map(|e| e[end]).sum::<f64>() / n;
            let variance = ends.iter().map(|e| (e[end] - mean).powi(2)).sum::<f64>() / (n - 1.0);
            let own = scatter.symmetric_interval[end];
            println!(
                "{name}, {which} end, {POINTS} points: trials {:.2e}, quasi-random {own:.2e}, variance {:.0} times smaller",
                variance.sqrt(),
                variance / (own * own)
            );
        }
    }
    Ok(())
}
