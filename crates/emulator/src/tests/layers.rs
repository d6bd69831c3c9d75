//! Layers and their sum, of simulators whose outputs are known in closed form.

use gumption_engine::distribution::{Distribution, LogUniform, Normal, Rectangular, StreamKey};

use crate::{
    Emulator, Focus, Parameter, SimulatorEffect, SimulatorRun, Space, space_filling_scores,
};

/// Rows of the simulators here.
const ROWS: usize = 40;

fn parameter(name: &str, prior: impl Into<Distribution>) -> Parameter {
    Parameter { name: name.to_owned(), prior: prior.into() }
}

/// An input and two effects: a size, and a size with a rate.
fn space() -> Space {
    let effect = |name: &str, parameters, neutral| SimulatorEffect {
        name: name.to_owned(),
        parameters,
        neutral,
    };
    let offset = parameter("offset", Rectangular::between(0.0, 2.0).unwrap());
    let size = parameter("size", Rectangular::between(0.0, 1.0).unwrap());
    let rate = parameter("rate", LogUniform::new(0.3, 3.0).unwrap());
    Space::new(
        vec![parameter("gain", Normal::new(10.0, 1.0).unwrap())],
        vec![
            effect("offset", vec![offset], vec![(0, 0.0)]),
            effect("decay", vec![size, rate], vec![(0, 0.0)]),
        ],
    )
    .unwrap()
}

/// Gain times time with an offset: linear in both. The decay multiplies the whole.
fn outputs(values: &[f64]) -> Vec<f64> {
    let [gain, offset, size, rate] = values else { panic!("{values:?}") };
    (0..ROWS)
        .map(|row| {
            let t = row as f64 / ROWS as f64;
            (gain * t + 5.0 * offset * (1.0 - t)) * (1.0 - size + size * (-rate * t).exp())
        })
        .collect()
}

fn run(space: &Space, effects: &[usize], scores: &[f64]) -> SimulatorRun {
    SimulatorRun { scores: scores.to_vec(), outputs: outputs(&space.values(effects, scores)) }
}

fn runs(space: &Space, effects: &[usize], count: usize, name: &str) -> Vec<SimulatorRun> {
    let unknowns = space.unknowns(effects).len();
    let scores = space_filling_scores(count, unknowns, StreamKey::new(1, name));
    scores.iter().map(|scores| run(space, effects, scores)).collect()
}

fn learnt() -> Emulator {
    let space = space();
    let mut emulator = Emulator::new(space.clone(), ROWS);
    for (effects, count) in [(&[][..], 8), (&[0], 14), (&[1], 40)] {
        emulator.learn(effects, &runs(&space, effects, count, "start"), None);
    }
    emulator
}

/// The largest error of a row at space-filling points.
fn error(emulator: &Emulator, effects: &[usize]) -> f64 {
    let space = emulator.space();
    let unseen = runs(space, effects, 20, "unseen");
    let errors = unseen.iter().flat_map(|run| {
        let values = emulator.values(effects, &space.at_scores(effects, &run.scores));
        values.into_iter().zip(&run.outputs).map(|(a, b)| (a - b).abs()).collect::<Vec<_>>()
    });
    errors.fold(0.0, f64::max)
}

/// What is linear has one direction for each parameter. The plain simulator's trend is exact but for the
/// rounding and the ridge of the fit; the offset's correction has no trend, and reaches 10 u: of it 1e-2 is
/// left.
#[test]
fn a_linear_simulator_is_known_from_few_runs() {
    let emulator = learnt();
    assert_eq!(emulator.correction(&[]).unwrap().everywhere().vectors(), 1);
    assert_eq!(emulator.correction(&[0]).unwrap().everywhere().vectors(), 1);
    assert!(error(&emulator, &[]) < 1e-7, "{}", error(&emulator, &[]));
    assert!(error(&emulator, &[0]) < 0.1, "{}", error(&emulator, &[0]));
    let point = emulator.space().at_values(&[0], &[10.5, 0.7]);
    let there = emulator.predict(&[0], &point);
    for row in 0..ROWS {
        let t = row as f64 / ROWS as f64;
        assert!((there.gradient[0][row] - t).abs() < 0.03, "{row}");
        assert!((there.gradient[1][row] - 5.0 * (1.0 - t)).abs() < 0.1, "{row}");
    }
}

/// A run that was learnt from is given back: 0.1 u in norm are left by the singular vectors.
#[test]
fn runs_are_given_back() {
    let emulator = learnt();
    let space = emulator.space();
    for run in runs(space, &[1], 40, "start") {
        let values = emulator.values(&[1], &space.at_scores(&[1], &run.scores));
        let square: f64 = values.iter().zip(&run.outputs).map(|(a, b)| (a - b).powi(2)).sum();
        assert!(square.sqrt() < 0.5, "{square}");
    }
}

/// Without an effect there is no correction: at its neutral value, at any input and rate, less than a
/// twentieth of what it is at the other end.
#[test]
fn a_correction_vanishes_where_its_effect_does() {
    let emulator = learnt();
    let space = emulator.space();
    for (gain, rate) in [(9.0, 0.5), (10.4, 1.0), (11.0, 2.5)] {
        let with = |size| emulator.values(&[1], &space.at_values(&[1], &[gain, size, rate]))[20];
        let without = emulator.values(&[], &space.at_values(&[], &[gain]))[20];
        let (none, all) = (with(0.0) - without, with(1.0) - without);
        assert!(none.abs() < 0.05 * all.abs(), "{none} {all}");
    }
}

/// The posterior about a point, with a width in normal scores.
fn focus(space: &Space, effects: &[usize], at: &[f64], width: f64) -> (Vec<Vec<f64>>, Focus) {
    let mut draws = space_filling_scores(40, at.len(), StreamKey::new(2, "posterior"));
    for draw in &mut draws {
        draw.iter_mut().zip(at).for_each(|(z, at)| *z = at + width * *z);
    }
    let focus = Focus::of(space, effects, &draws, &[1.0 / 40.0; 40]);
    (draws, focus)
}

/// A pair is known by superposition; what that leaves is told as the error on its first runs, and learnt.
/// Near a narrow posterior some rounds of runs leave less and less.
#[test]
fn an_interaction_is_learnt_where_the_posterior_is() {
    let mut emulator = learnt();
    let space = space();
    let both = [0, 1];
    let (draws, focus) = focus(&space, &both, &[0.3, 0.5, 0.2, -0.4], 0.1);
    assert!(focus.is_narrow());
    let mut errors = Vec::new();
    for draws in draws.chunks(8) {
        let runs: Vec<SimulatorRun> = draws.iter().map(|z| run(&space, &both, z)).collect();
        let learnt = emulator.learn(&both, &runs, Some(focus.clone()));
        errors.push(learnt.unseen.unwrap().norm());
        assert_eq!(emulator.unseen(&both).unwrap().norm(), errors[errors.len() - 1]);
    }
    assert!(emulator.correction(&both).unwrap().near().is_some());
    // the offset's decay, of half a unit in each of 40 rows; then a twentieth of it and less
    assert!(errors[0] > 1.0 && errors[1..].iter().all(|error| *error < 0.1), "{errors:?}");
}

/// A posterior as wide as the prior in one parameter of its effects is not narrow.
#[test]
fn a_wide_posterior_needs_all_runs() {
    let space = space();
    let (mut draws, narrow) = focus(&space, &[1], &[0.0, 0.0, 0.0], 0.2);
    assert!(narrow.is_narrow());
    draws.iter_mut().for_each(|draw| draw[2] *= 4.0);
    assert!(!Focus::of(&space, &[1], &draws, &[1.0 / 40.0; 40]).is_narrow());
    // of inputs alone nothing is to be forgotten
    assert!(!focus(&space, &[], &[0.0], 0.1).1.is_narrow());
}

/// Differences over 1e-3 have an error of 2e-7 times the third derivative, which is of the order of 10, and a
/// rounding of 1e-16 times the sum of the weights, some millions, over 1e-3. By value the slopes are those by
/// score over that of the value.
#[test]
fn gradients_are_those_of_the_values() {
    let mut emulator = learnt();
    let space = space();
    let both = [0, 1];
    let at = [0.3, 0.5, 0.2, -0.4];
    for width in [1.0, 0.1] {
        let (draws, focus) = focus(&space, &both, &at, width);
        let runs: Vec<SimulatorRun> = draws.iter().map(|z| run(&space, &both, z)).collect();
        emulator.learn(&both, &runs, Some(focus));
        assert_eq!(emulator.correction(&both).unwrap().near().is_some(), width < 0.3);
        let there = emulator.predict(&both, &space.at_scores(&both, &at));
        assert_eq!(there.values, emulator.values(&both, &space.at_scores(&both, &at)));
        let places = space.unknowns(&both);
        let values = space.values(&both, &at);
        let values: Vec<f64> = places.iter().map(|&place| values[place]).collect();
        let by_value = emulator.predict(&both, &space.at_values(&both, &values));
        for unknown in 0..4 {
            let moved = |step: f64| {
                let mut moved = at;
                moved[unknown] += step;
                let value = space.values(&both, &moved)[places[unknown]];
                (value, emulator.values(&both, &space.at_scores(&both, &moved)))
            };
            let ((above, high), (below, low)) = (moved(1e-3), moved(-1e-3));
            for row in 0..ROWS {
                let slope = there.gradient[unknown][row];
                let difference = (high[row] - low[row]) / 2e-3;
                assert!((slope - difference).abs() < 1e-5, "{unknown} {slope} {difference}");
                let by_value = by_value.gradient[unknown][row] * (above - below) / 2e-3;
                assert!((slope - by_value).abs() < 1e-5 * (1.0 + slope.abs()), "{by_value}");
            }
        }
    }
}

/// Where the local layer passes into the one that knows the prior, between 3 and 4 standard deviations of the
/// runs from their middle, slopes are those of the values as well. The third derivative of the passage, 10^4,
/// times what the layers differ by, 0.1, leaves 2e-6 in differences over 1e-4, and rounding as much.
#[test]
fn one_layer_passes_into_the_other_smoothly() {
    let mut emulator = learnt();
    let space = space();
    let at = [0.3, 0.5, -0.4];
    let (draws, focus) = focus(&space, &[1], &at, 0.1);
    let runs: Vec<SimulatorRun> = draws.iter().map(|z| run(&space, &[1], z)).collect();
    emulator.learn(&[1], &runs, Some(focus));
    let near = emulator.correction(&[1]).unwrap().near().unwrap();
    let mut met = 0;
    for step in 0..40 {
        let shifted = |by: f64| [at[0], at[1] + 0.02 * f64::from(step) + by, at[2]];
        let point = space.at_scores(&[1], &shifted(0.0));
        let share = near.share(&point).0;
        met += usize::from(share > 0.0 && share < 1.0);
        let slopes = &emulator.predict(&[1], &point).gradient[1];
        let values = |by| emulator.values(&[1], &space.at_scores(&[1], &shifted(by)));
        for (slope, (high, low)) in slopes.iter().zip(values(1e-4).iter().zip(values(-1e-4))) {
            let difference = (high - low) / 2e-4;
            assert!((slope - difference).abs() < 1e-5, "{step} {slope} {difference}");
        }
    }
    assert!(met > 2, "{met} points of the passage");
}

#[test]
fn runs_far_from_the_data_or_without_numbers_are_left_out() {
    let space = space();
    let mut emulator = learnt();
    let mut runs = runs(&space, &[0], 3, "more");
    runs[0].outputs[3] = f64::NAN;
    runs[1].outputs[0] = 1e6;
    let learnt = emulator.learn(&[0], &runs, None);
    assert_eq!((learnt.left_out, learnt.unseen.unwrap().norms.len()), (2, 1));
    // of an effect that was never run nothing was known
    let first = Emulator::new(space.clone(), ROWS).learn(&[0], &runs, None);
    assert_eq!((first.left_out, first.unseen), (2, None));
}
