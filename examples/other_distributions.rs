//! Inputs with distributions of `rand_distr` and `statrs`: the pressure of a gust.
//!
//! The wind's speed has a Weibull distribution, the highest gust adds an increment that has a Gumbel
//! distribution. Draws are those of `rand_distr`; mean, standard deviation and quantiles are those of
//! `statrs`, and draws that do not follow them are refused.
//!
//! Run with `cargo run --release --example other_distributions` (a program of one's own takes the
//! feature `statrs` of gumption).
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stdout)]

use std::error::Error;

use gumption::distribution::{External, Input};
use gumption::propagate::{Control, Evaluation, evaluate};
use gumption::task::Task;
use rand_distr::Distribution;

/// Wind speed: scale 8 m/s, shape 2; increment of the gust: location 3 m/s, scale 1.2 m/s.
pub(crate) fn task(trials: u64) -> Result<Task, Box<dyn Error>> {
    let (drawn, law) =
        (rand_distr::Weibull::new(8.0, 2.0)?, statrs::distribution::Weibull::new(2.0, 8.0)?);
    let wind = External::of_law("weibull", law, move |random| drawn.sample(random))?;
    let (drawn, law) =
        (rand_distr::Gumbel::new(3.0, 1.2)?, statrs::distribution::Gumbel::new(3.0, 1.2)?);
    let gust = External::of_law("gumbel", law, move |random| drawn.sample(random))?;
    Ok(Task::builder("gust")
        .input("wind", Input::new(wind, "m/s")?)
        .input("gust", Input::new(gust, "m/s")?)
        .equation("v", "wind + gust")
        .output("v", "m/s")
        .coverage(0.95)
        .trials(trials)
        .build()?)
}

/// Mean, standard deviation and 95 % coverage interval of the speed in a gust, in m/s.
pub(crate) fn figures(evaluation: &Evaluation) -> Option<[f64; 4]> {
    let found = evaluation.rows.first()?.outputs.first()?.monte_carlo.as_deref()?;
    let [low, high] = found.symmetric_interval;
    Some([found.estimate?, found.standard_uncertainty?, low, high])
}

#[cfg_attr(test, allow(dead_code))]
fn main() -> Result<(), Box<dyn Error>> {
    let evaluation = evaluate(&task(1_000_000)?, &Control::default())?;
    let [mean, std, low, high] = figures(&evaluation).ok_or("no trials")?;
    println!("v = {mean:.3} m/s, u = {std:.3} m/s, from {low:.2} m/s to {high:.2} m/s");
    Ok(())
}
