//! A run that is stopped hands back all trials that it counted, and figures that are theirs.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use gumption_engine::distribution::Input;
use gumption_engine::propagate::{Control, Evaluation, evaluate};
use gumption_engine::task::{Settings, StoppingRule, Task, Trials};

/// A standard normal quantity and its exponential, stopped once so many trials are reported; the
/// trials that were reported in the end.
fn stopped_at(trials: u64, memory: usize) -> (Evaluation, u64) {
    let task = Task::builder("stopped")
        .input("x", Input::normal(0.0, 1.0, "1").unwrap())
        .equation("e", "exp(x)")
        .output("x", "1")
        .output("e", "1")
        .coverage(0.95)
        .trials(40_000_000)
        .build()
        .unwrap();
    let (stop, counted) = (AtomicBool::new(false), AtomicU64::new(0));
    let advance = |more: u64| {
        if counted.fetch_add(more, Ordering::Relaxed) + more >= trials {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let control = Control::default().with_memory(memory).with_stop(&stop).with_progress(&advance);
    let evaluation = evaluate(&task, &control).unwrap();
    (evaluation, counted.into_inner())
}

#[test]
fn all_trials_that_were_counted_are_handed_back() {
    // in several passes, whose cells tell the order statistics, and with all values kept
    for (trials, memory) in [(300_000, 1 << 20), (3_000_000, 1 << 20), (300_000, 1 << 30)] {
        let (evaluation, counted) = stopped_at(trials, memory);
        assert!(evaluation.stopped);
        assert!(counted >= trials && counted < 40_000_000);
        for (output, expected) in evaluation.rows[0].outputs.iter().zip([
            // mean, u, and the ends of the symmetric and of the shortest interval of 95 %
            [0.0, 1.0, -1.959_964, 1.959_964, -1.959_964, 1.959_964],
            // of exp(x): exp(1/2), sqrt((e - 1) e), exp of the normal's; the shortest one solves
            // f(a) = f(b), F(b) - F(a) = 0.95
            [1.648_721, 2.161_197, 0.140_863, 7.099_071, 0.025_934, 5.186_792],
        ]) {
            let found = output.monte_carlo.as_deref().unwrap();
            assert_eq!(found.trials, counted);
            let errors = &found.errors;
            let figures = [
                (found.estimate.unwrap(), errors.estimate.unwrap()),
                (found.standard_uncertainty.unwrap(), errors.standard_uncertainty.unwrap()),
                (found.symmetric_interval[0], errors.symmetric_interval[0]),
                (found.symmetric_interval[1], errors.symmetric_interval[1]),
            ];
            for ((value, error), expected) in figures.into_iter().zip(expected) {
                // six standard errors: wrong once in five hundred million figures; the errors are
                // estimates themselves, of u of exp(x) within some percent
                assert!((value - expected).abs() <= 6.0 * error, "{value} {expected} {error}");
            }
            let [low, high] = found.shortest_interval;
            // no interval of 95 % is shorter; cells widen it by a thousandth of u at most, and the
            // trials scatter its length by far less than that of either end
            let (length, least) = (high - low, expected[5] - expected[4]);
            assert!((length - least).abs() <= 0.01 * least, "{length} {least}");
        }
    }
}

/// A search for the number of trials answers with those that are at hand, not with all that it made
/// once more.
#[test]
fn a_search_that_is_stopped_answers_at_once() {
    for (rule, memory) in [
        (StoppingRule::Clause79, 1 << 16),
        (StoppingRule::Clause79, 1 << 26),
        (StoppingRule::Stein, 1 << 16),
    ] {
        // five digits take some 10^12 trials, in blocks of 10^4
        let mut settings = Settings::default();
        settings.trials = Trials::Adaptive;
        settings.rule = rule;
        settings.digits = 5;
        settings.max_trials = 1 << 50;
        let task = Task::builder("stopped")
            .input("x", Input::normal(0.0, 1.0, "1").unwrap())
            .equation("y", "x^3")
            .output("y", "1")
            .settings(settings)
            .build()
            .unwrap();
        let stop = AtomicBool::new(false);
        let evaluation = std::thread::scope(|scope| {
            scope.spawn(|| {
                std::thread::sleep(Duration::from_millis(700));
                stop.store(true, Ordering::Relaxed);
            });
            let control = Control::default().with_memory(memory).with_stop(&stop);
            evaluate(&task, &control).unwrap()
        });
        assert!(evaluation.stopped);
        let found = evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
        // of 64 MB some 10^7 trials are kept; Stein's number of trials is known soon, and its trials are
        // then made as those of any run
        if rule == StoppingRule::Clause79 {
            assert!(found.trials <= if memory > 1 << 20 { 100_000_000 } else { 1_000_000 });
        }
        let adaptive = found.adaptive.unwrap();
        assert!(!adaptive.converged);
        assert_eq!(adaptive.blocks, found.trials / adaptive.block_trials);
        // E(x^6) is 15, known from n trials to 5 % where n is above 10^5; as few as 3 10^4 are made
        // on the slowest machine
        assert!((found.standard_uncertainty.unwrap() - 15.0_f64.sqrt()).abs() < 0.5);
    }
}
