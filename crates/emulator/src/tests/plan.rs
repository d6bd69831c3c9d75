//! The order of the runs, with an inference that is made up.

use gumption_engine::distribution::{Normal, Rectangular};

use crate::{
    Batch, Emulator, Ending, Parameter, Plan, SimulatorEffect, SimulatorRun, Space, State, Step,
};

/// One input and so many effects of one parameter.
fn space(effects: usize) -> Space {
    let effect = |number: usize| SimulatorEffect {
        name: format!("effect {number}"),
        parameters: vec![Parameter {
            name: format!("size {number}"),
            prior: Rectangular::between(0.0, 1.0).unwrap().into(),
        }],
        neutral: vec![(0, 0.0)],
    };
    let prior = Normal::new(1.0, 0.1).unwrap().into();
    let input = Parameter { name: "x".to_owned(), prior };
    Space::new(vec![input], (0..effects).map(effect).collect()).unwrap()
}

/// A plan that was followed: all batches, and all hypotheses that were asked for, in their order.
struct Followed {
    batches: Vec<Batch>,
    asked: Vec<Vec<Vec<usize>>>,
    ending: Ending,
}

/// Follows a plan, with posteriors of ten draws, with an emulator of two rows that errs by `error` in the first of them, by the hypothesis
/// and the number of its rounds; `score` is what the inference finds.
fn follow(
    space: &Space,
    budget: usize,
    score: impl Fn(&[usize]) -> f64,
    error: impl Fn(&[usize], usize) -> f64,
) -> Followed {
    let mut plan = Plan::new(space.clone(), budget, 1).unwrap();
    let (mut batches, mut asked, mut states) = (Vec::<Batch>::new(), Vec::new(), Vec::new());
    let state = |effects: &Vec<usize>, score: f64| {
        let mode = vec![0.25; 1 + effects.len()];
        let draws = (0..10).map(|n| vec![0.1 * f64::from(n); mode.len()]).collect();
        State { effects: effects.clone(), score, mode, draws, weights: vec![0.1; 10] }
    };
    let ends = 0..space.effects();
    let pairs = ends.clone().flat_map(|a| (0..a).map(move |b| vec![b, a]));
    let all: Vec<Vec<usize>> =
        std::iter::once(vec![]).chain(ends.clone().map(|a| vec![a])).chain(pairs).collect();
    let sum: f64 = all.iter().map(|effects| score(effects).exp()).sum();
    loop {
        match plan.next(std::mem::take(&mut states)) {
            Step::Run(more) => {
                for batch in more {
                    let rounds = batches.iter().filter(|of| of.effects == batch.effects);
                    let rounds = rounds.filter(|of| of.focus.is_some()).count();
                    // an emulator that knows zeros, and runs that are off by the error
                    let mut emulator = Emulator::new(space.clone(), 2);
                    let runs = |output: f64| -> Vec<SimulatorRun> {
                        let scores = batch.scores.iter().cloned();
                        let run = |scores| SimulatorRun { scores, outputs: vec![output, 0.0] };
                        scores.map(run).collect()
                    };
                    emulator.learn(&batch.effects, &runs(0.0), None);
                    let off = error(&batch.effects, rounds);
                    let learnt = emulator.learn(&batch.effects, &runs(off), None);
                    plan.learnt(&batch, learnt.unseen.as_ref());
                    batches.push(batch);
                }
                let made: usize = batches.iter().map(|batch| batch.scores.len()).sum();
                assert_eq!(plan.used(), made);
                assert!(made <= budget, "{made} runs");
            }
            Step::Infer(hypotheses) => {
                states = hypotheses.iter().map(|effects| state(effects, score(effects))).collect();
                asked.push(hypotheses);
            }
            Step::Weigh => {
                let weighed = |effects| state(effects, score(effects) - sum.ln());
                states = all.iter().map(weighed).collect();
            }
            Step::Done(ending) => return Followed { batches, asked, ending },
        }
    }
}

fn hypotheses(of: &[Batch]) -> Vec<Vec<usize>> {
    of.iter().map(|batch| batch.effects.clone()).collect()
}

/// A third of 150 runs is the start: 8 of the plain simulator, 14 of each effect, two thirds of them first.
/// Then each single effect is run at its mode although it is far from the best, all pairs are asked for and run
/// at their modes as well, and the ones near the best are run until they are known. The last runs are at draws
/// of what is reported, the pair with a probability of 0.993.
#[test]
fn a_plan_that_converges() {
    let pair = [0, 2];
    let score = |effects: &[usize]| match effects {
        [0, 2] => 0.0,
        [0] => -5.0,
        _ => -50.0,
    };
    let error = |_: &[usize], round: usize| [5.0, 0.4, 0.1, 0.01][round.min(3)];
    let Followed { batches, asked, ending } = follow(&space(3), 150, score, error);
    let sizes: Vec<usize> = batches[..8].iter().map(|batch| batch.scores.len()).collect();
    assert_eq!(sizes, [5, 3, 9, 5, 9, 5, 9, 5]);
    assert!(batches[..8].iter().all(|batch| batch.focus.is_none()));
    let first = &batches[8..12];
    assert_eq!(hypotheses(first), [vec![], vec![0], vec![1], vec![2]]);
    // no run twice: draws are those of the posterior
    let batch = batches.iter().find(|batch| batch.effects == pair).unwrap();
    let places: std::collections::BTreeSet<u64> =
        batch.scores.iter().map(|scores| scores[0].to_bits()).collect();
    assert_eq!(places.len(), batch.scores.len());
    assert!(first.iter().all(|batch| batch.scores.len() == 2 && batch.scores[0][0] == 0.25));
    assert!(asked.contains(&vec![vec![0, 1], vec![0, 2], vec![1, 2]]), "{asked:?}");
    let sizes = |effects: &[usize]| -> Vec<usize> {
        let own = batches.iter().filter(|batch| batch.effects == effects);
        own.map(|batch| batch.scores.len()).collect()
    };
    assert_eq!(sizes(&pair), [8, 8, 8], "two rounds and the last runs");
    assert_eq!((sizes(&[0, 1]), sizes(&[1, 2])), (vec![2], vec![2]));
    assert_eq!(batches[batches.len() - 1].effects, pair);
    assert_eq!(ending.open, []);
    assert_eq!(ending.runs, batches.iter().map(|batch| batch.scores.len()).sum::<usize>());
}

/// An error that never falls: pairs are let in all the same, the budget is used up to the last run, a tenth of
/// it at draws of what is reported, and what is open is said.
#[test]
fn a_budget_that_ends_first() {
    let score = |effects: &[usize]| -(effects.len() as f64);
    let Followed { batches, asked, ending } = follow(&space(3), 150, score, |_, _| 3.0);
    assert_eq!(ending.runs, 150);
    let pairs = asked.iter().position(|asked| asked.contains(&vec![0, 1])).unwrap();
    assert!(pairs <= 6, "{pairs}");
    assert_eq!(hypotheses(&batches[batches.len() - 1..]), [Vec::<usize>::new()]);
    assert_eq!(ending.open[0].effects, Vec::<usize>::new());
    assert_eq!(ending.open[0].error, Some(3.0));
    // ln(0.5/3)/ln(sqrt(1/2)) is 5.2: six rounds of four
    assert_eq!(ending.open[0].runs, 24);
}

/// An error where the posterior is once all hypotheses are weighed, and none where it was before: they are
/// weighed again, and what was known is run no more until the last runs.
#[test]
fn what_is_reported_is_weighed_again_where_it_was_not_known() {
    let score = |effects: &[usize]| if effects.len() == 1 { 0.0 } else { -50.0 };
    // the two runs at the best points, one round, and then what is reported
    let error = |effects: &[usize], round: usize| match (effects, round) {
        ([0], 2) => 7.0,
        (_, 0) => 5.0,
        _ => 0.1,
    };
    let Followed { batches, ending, .. } = follow(&space(2), 150, score, error);
    let sizes = |effects: &[usize]| -> Vec<usize> {
        let own = batches.iter().filter(|batch| batch.effects == effects);
        own.filter(|batch| batch.focus.is_some()).map(|batch| batch.scores.len()).collect()
    };
    assert_eq!(sizes(&[0]), [2, 6, 6, 6]);
    assert_eq!(sizes(&[1]), [2, 6, 6]);
    assert_eq!(ending.open, []);
}

/// A simulator that does not know effects: its own error at its posterior, then the last runs.
#[test]
fn a_simulator_without_effects() {
    let Followed { batches, ending, .. } = follow(&space(0), 20, |_| 0.0, |_, _| 0.1);
    let sizes: Vec<usize> = batches.iter().map(|batch| batch.scores.len()).collect();
    assert_eq!((&sizes[..], ending.open), (&[5, 3, 2, 4][..], vec![]));
}

#[test]
fn a_budget_below_the_start_is_refused() {
    // 8 of the plain simulator at the start and 2 at its mode, 6 and 2 of each effect, and 4
    let error = Plan::new(space(3), 37, 1).unwrap_err();
    assert_eq!(error.to_string(), "the simulator has to be run 38 times at least");
    assert!(Plan::new(space(3), 38, 1).is_ok());
    follow(&space(3), 38, |_| 0.0, |_, _| 0.1);
}

/// A plan fills the space with a third of its budget.
#[test]
fn runs_that_fill_the_space_are_those_of_a_start() {
    let Step::Run(start) = Plan::new(space(2), 300, 1).unwrap().next(Vec::new()) else {
        panic!("a plan begins with runs")
    };
    assert_eq!(Plan::filling(&space(2), 100, 1), Ok(start));
    // 8 of the plain simulator, 6 of each effect
    let least = Plan::filling(&space(2), 20, 1).unwrap();
    assert_eq!(least.iter().map(|batch| batch.scores.len()).sum::<usize>(), 20);
    let error = Plan::filling(&space(2), 19, 1).unwrap_err();
    assert_eq!(error.to_string(), "the simulator has to be run 20 times at least");
}

/// The same seed gives the same runs, another one others.
#[test]
fn a_plan_follows_from_its_seed() {
    let start = |seed| match Plan::new(space(2), 100, seed).unwrap().next(Vec::new()) {
        Step::Run(batches) => batches,
        other => panic!("{other:?}"),
    };
    assert_eq!(start(1), start(1));
    assert_ne!(start(1), start(2));
}
