//! Adaptive runs: Stein's two-stage rule (Wuebbeler, Harris, Cox, Elster, Metrologia 47 (2010) 317)
//! beside JCGM 101, 7.9, and how often each meets the tolerance.

use std::path::Path;

use gumption::file;
use gumption::propagate::monte_carlo::MonteCarlo;
use gumption::propagate::validate::numerical_tolerance;
use gumption::propagate::{Control, EvaluationError, evaluate, for_each_block};
use gumption::task::{Coverage, StoppingRule, Task, Trials};

use crate::support::{announce, command};

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
const BLOCK: usize = 10_000;

/// Blocks of the first stage of Stein's rule, and the t quantile at 0.975 for one less (Student's
/// table: 2.2622).
const FIRST: usize = 10;
const T: f64 = 2.262_157_162_740_991_6;

/// Runs of each kind.
const RUNS: u64 = 1000;

fn task(text: &str) -> Task {
    let mut task = file::read_text("sum", text, Path::new(""), &[]).unwrap().task;
    task.settings.coverage = Coverage::Probability(0.95);
    task
}

fn run(task: &Task, rule: StoppingRule, seed: u64, digits: u32) -> MonteCarlo {
    let mut task = task.clone();
    task.settings.trials = Trials::Adaptive;
    task.settings.rule = rule;
    task.settings.seed = seed;
    task.settings.digits = digits;
    let control = Control::default().with_threads(1);
    let evaluation = evaluate(&task, &control).unwrap();
    *evaluation.rows[0].outputs[0].monte_carlo.clone().unwrap()
}

/// Estimate, standard uncertainty and ends, as errors.
fn errors(figures: &MonteCarlo) -> [f64; 4] {
    let [low, high] = figures.symmetric_interval;
    let u = figures.standard_uncertainty.unwrap();
    [figures.location(), u - U, low + END, high - END].map(f64::abs)
}

/// The first values of a task's output, from a run of as many trials.
fn values(task: &Task, count: usize) -> Vec<f64> {
    let mut task = task.clone();
    task.settings.trials = Trials::Fixed(count as u64);
    let control = Control::default();
    let evaluation = evaluate(&task, &control).unwrap();
    let mut values = Vec::new();
    for_each_block(&task, &evaluation, 0, &control, |block| {
        values.extend_from_slice(&block[0]);
        Ok::<(), EvaluationError>(())
    })
    .unwrap();
    values
}

/// Stein's number of blocks, h = max(floor(s^2 t^2 / delta^2) + 1, h_1) for the figure that scatters
/// most, recomputed from the trials themselves: the figures of the first ten blocks by sorting.
#[test]
fn the_two_stage_rule_takes_as_many_blocks_as_its_formula_says() {
    let task = task(NORMAL_SUM);
    for (seed, digits) in [(1, 2), (2, 2), (3, 3), (4, 1)] {
        let mut seeded = task.clone();
        seeded.settings.seed = seed;
        let stage: Vec<[f64; 4]> = values(&seeded, FIRST * BLOCK)
            .chunks(BLOCK)
            .map(|block| {
                let mut block = block.to_vec();
                block.sort_by(f64::total_cmp);
                let n = BLOCK as f64;
                let mean = block.iter().sum::<f64>() / n;
                let squares: f64 = block.iter().map(|v| (v - mean).powi(2)).sum();
                // q = 9500, r = 250 (JCGM 101, 7.7)
                [mean, (squares / (n - 1.0)).sqrt(), block[249], block[9749]]
            })
            .collect();
        let h = FIRST as f64;
        let variance = |i: usize| {
            let mean = stage.iter().map(|s| s[i]).sum::<f64>() / h;
            stage.iter().map(|s| (s[i] - mean).powi(2)).sum::<f64>() / (h - 1.0)
        };
        let largest = (0..4).map(variance).fold(0.0, f64::max);
        let tolerance = numerical_tolerance(U, digits);
        let needed = (largest * (T / tolerance).powi(2)).floor() as u64 + 1;
        let figures = run(&task, StoppingRule::Stein, seed, digits);
        let end = figures.adaptive.unwrap();
        assert_eq!((end.rule, end.converged), (StoppingRule::Stein, true));
        assert_eq!((end.block_trials, end.tolerance), (BLOCK as u64, tolerance));
        assert_eq!(end.blocks, needed.max(FIRST as u64), "seed {seed}, {digits} digits");
        assert_eq!(figures.trials, end.blocks * BLOCK as u64);
        // three digits take a thousand blocks, one digit the first stage
        assert_eq!(end.blocks == FIRST as u64, digits == 1 || needed <= FIRST as u64);
    }
}

/// The rule comes from the file or the command line, which beats it, and is told in every answer.
#[test]
fn the_rule_is_asked_for_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let text = NORMAL_SUM.replacen(
        '{',
        r#"{"monte_carlo": {"trials": "adaptive", "rule": "stein", "digits": 1},"#,
        1,
    );
    std::fs::write(folder.path().join("m.json"), &text).unwrap();
    let run = |options: &[&str]| {
        let mut command = command();
        command.current_dir(folder.path()).args(["run", "m.json"]).args(options);
        command.output().unwrap()
    };
    let json = |options: &[&str]| {
        let output = run(&[options, &["--format", "json"]].concat());
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        answer["outputs"]["y"]["monte_carlo"]["adaptive"].clone()
    };
    assert_eq!((&json(&[])["rule"], &json(&[])["blocks"]), (&"stein".into(), &10.into()));
    let by_clause = json(&["--rule", "7.9"]);
    assert_eq!((&by_clause["rule"], &by_clause["blocks"]), (&"7.9".into(), &2.into()));
    let page = String::from_utf8(run(&[]).stdout).unwrap();
    let said = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let sentence = "Stein's two-stage rule: by the scatter of the first 10 blocks 100 000 trials, 10 \
                    blocks of 10 000, are enough for all figures of all outputs, here to 0.5, each \
                    with a probability of 95 %";
    assert!(said.contains(sentence), "{page}");
    let page = String::from_utf8(run(&["--rule", "7.9"]).stdout).unwrap();
    assert!(page.contains("stable after 20 000 trials, 2 blocks"), "{page}");
    // not enough trials for the second stage
    let options = ["--digits", "3", "--max-trials", "200000"];
    let few = json(&options);
    assert_eq!((&few["blocks"], &few["converged"]), (&20.into(), &false.into()));
    let page = String::from_utf8(run(&options).stdout).unwrap();
    assert!(page.contains("more than 200 000 trials, 20 blocks of 10"), "{page}");
    // words that are no rule, and a rule without an adaptive run
    for (options, said) in [
        (&["--rule", "stien"][..], "a similar value exists: 'stein'"),
        (&["--rule", "stein", "--trials", "1000"], "add `--trials adaptive`"),
    ] {
        let output = run(options);
        assert_eq!(output.status.code(), Some(2));
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(error.contains(said), "{error}");
    }
}

/// At coverage probabilities next to 1 a block of 100/(1 - p) trials has more than may be made. The
/// run ends there, without a claim, and holds only what the tails need.
#[test]
fn blocks_larger_than_all_trials_are_not_made() {
    let mut task = task(NORMAL_SUM);
    task.settings.max_trials = 30_000;
    for rule in StoppingRule::ALL {
        for p in [0.9999, 0.999_999_999, 1.0 - 2f64.powi(-52)] {
            task.settings.coverage = Coverage::Probability(p);
            let figures = run(&task, rule, 1, 2);
            let end = figures.adaptive.unwrap();
            assert_eq!((figures.trials, end.blocks, end.converged), (30_000, 0, false));
            assert_eq!(end.tolerance, numerical_tolerance(U, 2));
            assert!(end.block_trials as f64 >= 99.9 / (1.0 - p));
        }
    }
    // ten blocks of a million trials, of which only the tails are held
    task.settings.max_trials = 1_000_000_000;
    task.settings.coverage = Coverage::Probability(0.9999);
    let end = run(&task, StoppingRule::Stein, 1, 1).adaptive.unwrap();
    assert_eq!((end.block_trials, end.blocks, end.converged), (1_000_000, 10, true));
}

/// Counts of runs with the ends, and with all figures, within the tolerance; and blocks.
#[derive(Default)]
struct Tally {
    ends: u64,
    all: u64,
    blocks: u64,
}

impl Tally {
    fn add(&mut self, figures: &MonteCarlo, tolerance: f64) {
        let met = errors(figures).map(|error| error <= tolerance);
        self.ends += u64::from(met[2] && met[3]);
        self.all += u64::from(met.iter().all(|met| *met));
        self.blocks += figures.adaptive.unwrap().blocks;
    }

    fn say(&self, rule: StoppingRule, digits: u32) {
        let share = |count: u64| 100.0 * count as f64 / RUNS as f64;
        announce(&format!(
            "digits {digits}, {}: ends within the tolerance in {:.1} %, all figures in {:.1} %, \
             {:.1} blocks",
            rule.name(),
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
    let task = task(NORMAL_SUM);
    for digits in [1, 2] {
        let tolerance = numerical_tolerance(U, digits);
        for rule in StoppingRule::ALL {
            let mut tally = Tally::default();
            for seed in 1..=RUNS {
                tally.add(&run(&task, rule, seed, digits), tolerance);
            }
            tally.say(rule, digits);
        }
    }
}
