//! Random additive models with their exact figures, one JSON object a line, for
//! `tests/exact/bounds.py`, which computes the figures with 30 digits:
//! `cargo run -p gumption-engine --example exact_models -- COUNT`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)]

use gumption_engine::distribution::{
    Arcsine, CurvilinearTrapezoid, Distribution, Exponential, Gamma, Input, Normal, Rectangular,
    StudentT, Trapezoidal, Triangular,
};
use gumption_engine::propagate::{Accuracy, Control, evaluate};
use gumption_engine::task::{MethodChoice, Settings, Task, Trials};

/// A sequence of numbers in (0, 1) (Weyl's, mixed).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }
}

/// A distribution about 0, and its name and parameters.
fn drawn(numbers: &mut Numbers) -> Result<(Distribution, String), Box<dyn std::error::Error>> {
    // widths of a hundredth to one
    let w = 10f64.powf(-2.0 * numbers.next());
    let dof = (1.0 + 20.0 * numbers.next()).floor();
    let share = 0.05 + 0.9 * numbers.next();
    Ok(match (9.0 * numbers.next()) as u32 {
        0 => (Normal::new(0.0, w)?.into(), format!("[\"normal\", {w:?}]")),
        1 => (Rectangular::new(0.0, w)?.into(), format!("[\"rectangular\", {w:?}]")),
        2 => (StudentT::new(0.0, w, dof)?.into(), format!("[\"t\", {w:?}, {dof:?}]")),
        3 => (Arcsine::new(0.0, w)?.into(), format!("[\"arcsine\", {w:?}]")),
        4 => {
            (Trapezoidal::new(0.0, w, share)?.into(), format!("[\"trapezoid\", {w:?}, {share:?}]"))
        }
        5 => {
            let mode = -w + 2.0 * w * share;
            (
                Triangular::between(-w, w, Some(mode))?.into(),
                format!("[\"triangle\", {w:?}, {mode:?}]"),
            )
        }
        6 => {
            let d = w * share;
            (
                CurvilinearTrapezoid::new(-w, w, d)?.into(),
                format!("[\"curvilinear\", {w:?}, {d:?}]"),
            )
        }
        7 => (Gamma::new(dof, 1.0 / w)?.into(), format!("[\"gamma\", {dof:?}, {:?}]", 1.0 / w)),
        _ => (Exponential::new(w)?.into(), format!("[\"gamma\", 1.0, {:?}]", 1.0 / w)),
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count: u64 = std::env::args().nth(1).map_or(Ok(200), |text| text.parse())?;
    for model in 0..count {
        let mut numbers = Numbers(model * 1_000_003);
        let terms = 2 + (6.0 * numbers.next()) as usize;
        let mut settings =
            Settings::default().with_trials(Trials::Fixed(0)).with_coverage(0.95.into());
        settings.method = Some(MethodChoice::Exact);
        let mut builder = Task::builder("random").settings(settings);
        let mut said = Vec::new();
        let mut names = Vec::new();
        for i in 0..terms {
            let (distribution, parameters) = drawn(&mut numbers)?;
            let name = format!("x{i}");
            builder = builder.input(&name, Input::new(distribution, "1")?);
            names.push(name);
            said.push(parameters);
        }
        let task = builder.equation("y", &names.join(" + ")).output("y", "1").build()?;
        let found = evaluate(&task, &Control::default())?;
        let terms = said.join(", ");
        match &found.rows[0].outputs[0].noiseless {
            Some(Ok(exact)) => {
                let bound = match exact.accuracy {
                    Accuracy::Bound(bound) => bound,
                    Accuracy::Scatter(_) => f64::NAN,
                };
                let [low, high] = exact.symmetric_interval;
                println!(
                    "{{\"terms\": [{terms}], \"low\": {low:?}, \"median\": {:?}, \"high\": {high:?}, \"bound\": {bound:?}}}",
                    exact.median
                );
            }
            Some(Err(why)) => println!("{{\"terms\": [{terms}], \"why\": \"{why}\"}}"),
            None => {}
        }
    }
    Ok(())
}
