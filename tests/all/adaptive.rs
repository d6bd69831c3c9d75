//! How often an adaptive run (JCGM 101, 7.9) meets its tolerance, against Stein's two-stage rule
//! (Wuebbeler, Harris, Cox, Elster, Metrologia 47 (2010) 317).

use std::path::Path;

use gumption::file;
use gumption::propagate::monte_carlo::MonteCarlo;
use gumption::propagate::validate::numerical_tolerance;
use gumption::propagate::{Control, evaluate};
use gumption::task::{Task, Trials};

use crate::support::announce;

/// JCGM 101, 9.2.2: u = 2, ends of the interval at -3.92 and 3.92.
const NORMAL_SUM: &str = r#"{
  "inputs": {
    "a": {"distribution": "normal", "mean": 0, "std": 1},
    "b": {"distribution": "normal", "mean": 0, "std": 1},
    "c": {"distribution": "normal", "mean": 0, "std": 1},
    "d": {"distribution": "normal", "mean": 0, "std": 1}
  },
  "equations": {"y": "a + b + c + d"},
  "outputs": {"y": {}}
}"#;

const U: f64 = 2.0;
const END: f64 = 2.0 * 1.959_963_984_540_054;

/// Trials in a block of the procedure at a coverage probability of 0.95.
const BLOCK: u64 = 10_000;

/// Runs of each kind.
const RUNS: u64 = 1000;

/// Blocks of the first stage, and the t quantile at 0.975 for one less.
const STAGES: [(u64, f64); 3] = [(5, 2.776_445), (10, 2.262_157), (20, 2.093_024)];

fn run(task: &Task, trials: Trials, seed: u64, digits: u32) -> MonteCarlo {
    let mut task = task.clone();
    task.settings.trials = trials;
    task.settings.seed = seed;
    task.settings.digits = digits;
    let control = Control { threads: 1, ..Control::default() };
    let evaluation = evaluate(&task, &control).unwrap();
    evaluation.rows[0].outputs[0].monte_carlo.clone().unwrap()
}

/// Estimate, standard uncertainty and ends, as errors.
fn errors(figures: &MonteCarlo) -> [f64; 4] {
    let [low, high] = figures.symmetric_interval;
    let u = figures.standard_uncertainty.unwrap();
    [figures.estimate, u - U, low + END, high - END].map(f64::abs)
}

/// Counts of runs with the ends, and with all figures, within the tolerance; and blocks.
#[derive(Default)]
struct Tally {
    ends: u64,
    all: u64,
    blocks: u64,
}

impl Tally {
    fn add(&mut self, figures: &MonteCarlo, tolerance: f64, blocks: u64) {
        let met = errors(figures).map(|error| error <= tolerance);
        self.ends += u64::from(met[2] && met[3]);
        self.all += u64::from(met.iter().all(|met| *met));
        self.blocks += blocks;
    }

    fn say(&self, rule: &str, digits: u32) {
        let share = |count: u64| 100.0 * count as f64 / RUNS as f64;
        announce(&format!(
            "digits {digits}, {rule}: ends within the tolerance in {:.1} %, all figures in {:.1} \
             %, {:.1} blocks",
            share(self.ends),
            share(self.all),
            self.blocks as f64 / RUNS as f64,
        ));
    }
}

/// The numbers of the comparison in the documentation; nothing is asserted.
#[test]
#[ignore = "a measurement that takes minutes"]
fn share_of_runs_that_meet_the_tolerance() {
    let file = file::read_text("sum", NORMAL_SUM, Path::new(""), &[]).unwrap();
    for digits in [1, 2] {
        let tolerance = numerical_tolerance(U, digits);
        let mut tally = Tally::default();
        for seed in 1..=RUNS {
            let figures = run(&file.task, Trials::Adaptive, seed, digits);
            let blocks = figures.adaptive.unwrap().blocks;
            tally.add(&figures, tolerance, blocks);
        }
        tally.say("JCGM 101, 7.9", digits);
        for (first, t) in STAGES {
            let mut tally = Tally::default();
            for seed in 1..=RUNS {
                // the blocks of the first stage have seeds of their own
                let stage: Vec<[f64; 4]> = (0..first)
                    .map(|block| {
                        let seed = 1_000_000 + 1000 * seed + block;
                        let figures = run(&file.task, Trials::Fixed(BLOCK), seed, digits);
                        let [low, high] = figures.symmetric_interval;
                        [figures.estimate, figures.standard_uncertainty.unwrap(), low, high]
                    })
                    .collect();
                let n = first as f64;
                let largest = (0..4)
                    .map(|i| {
                        let mean = stage.iter().map(|s| s[i]).sum::<f64>() / n;
                        stage.iter().map(|s| (s[i] - mean).powi(2)).sum::<f64>() / (n - 1.0)
                    })
                    .fold(0.0, f64::max);
                // so many that the t interval of every figure is within the tolerance
                let blocks = (largest * (t / tolerance).powi(2)).floor() as u64 + 1;
                let blocks = blocks.max(first);
                let figures = run(&file.task, Trials::Fixed(blocks * BLOCK), seed, digits);
                tally.add(&figures, tolerance, blocks);
            }
            tally.say(&format!("two stages, {first} blocks first"), digits);
        }
    }
}
