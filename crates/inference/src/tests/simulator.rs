//! What is said of a simulator's outputs against the simulator itself.

use std::sync::Arc;

use gumption_emulator::{
    Emulator, Parameter, SimulatorEffect, SimulatorRun, Space, space_filling_scores,
};
use gumption_engine::distribution::{Rectangular, StreamKey};
use gumption_engine::number::elementary;
use gumption_engine::task::Sharing;

use super::cases::{candidate, case, normal, observed, quantity};
use crate::latent::Role;
use crate::predict;
use crate::setup::Setup;
use crate::simulator::LinearAt;
use crate::{Case, ModelForm, SimulatorModel, simulator_conditions};

const ROWS: usize = 12;

/// A decay from the input `a` at the rate `r`, in hundredths.
fn decay(a: f64, rate: f64) -> Vec<f64> {
    (0..ROWS).map(|n| 100.0 * a * elementary::exp(-rate * n as f64)).collect()
}

/// The decay measured with a standard uncertainty of 0.01, its rate an effect of the simulator, beside an
/// offset that a formula makes.
fn measured() -> Case {
    let values: Vec<f64> = decay(1.02, 0.03).iter().map(|value| value / 100.0).collect();
    let rate = Rectangular::between(0.0, 0.1).unwrap();
    let offset = candidate("offset", "o", normal(0.0, 0.4), &[("y", "y + o")]);
    let mut loss = candidate("loss", "r", rate.into(), &[]);
    loss.simulator = Some(0);
    let mut case = case(
        normal(1.0, 0.05),
        Sharing::All,
        &[("y", "a")],
        vec![observed(&values, Some(&[0.01; ROWS]))],
        vec![offset, loss],
    );
    let mut percent = quantity("y");
    percent.unit = gumption_units::Unit::parse("%").unwrap();
    case.model.conditions.extend(simulator_conditions([percent]));
    case.model.maker = ModelForm::Simulated;
    for (number, row) in case.task.rows.iter_mut().enumerate() {
        row.conditions.extend([100.0 * values[number], number as f64]);
    }
    case.task.model = case.model.model().unwrap();
    case.simulated = 2;
    let prior = |name: &str, prior| Parameter { name: name.to_owned(), prior };
    let inputs = vec![prior("a", normal(1.0, 0.05))];
    let loss = SimulatorEffect {
        name: "loss".to_owned(),
        parameters: vec![prior("r", rate.into())],
        neutral: vec![(0, 0.0)],
    };
    case.simulator = Some(Arc::new(SimulatorModel::new(Space::new(inputs, vec![loss]).unwrap())));
    assert_eq!(case.check(), Ok(()));
    case
}

/// The case after enough runs: the emulator is known within hundredths of u.
pub(crate) fn emulated(linear_at: Option<LinearAt>) -> Case {
    let case = measured();
    let space = case.simulator.as_ref().unwrap().space().clone();
    let units = case.simulator_units();
    // 0.01 is 1 in hundredths
    assert!(units.iter().all(|unit| (unit - 1.0).abs() < 1e-12));
    let mut emulator = Emulator::new(space.clone(), ROWS);
    for (effects, count) in [(vec![], 8), (vec![], 4), (vec![0], 40), (vec![0], 10)] {
        let key = StreamKey::new(count as u64, "runs");
        let scores = space_filling_scores(count, space.unknowns(&effects).len(), key);
        let runs = scores.into_iter().map(|scores| {
            let values = space.values(&effects, &scores);
            SimulatorRun { scores, outputs: decay(values[0], values[1]) }
        });
        emulator.learn(&effects, &runs.collect::<Vec<_>>(), None);
    }
    case.emulated(emulator, units, linear_at).unwrap()
}

/// The tolerance of a value is a twentieth of u, of a derivative what that is over half a standard deviation
/// of the input.
#[test]
fn values_and_derivatives_are_those_of_the_simulator() {
    let case = emulated(None);
    let (u, du) = (0.01 / 20.0, 0.01 / 20.0 / 0.025);
    for (number, row) in case.task.rows.iter().enumerate() {
        let (values, gradients) = case.gradients(&row.estimates());
        assert!((values[0] - 1.0).abs() < u, "{values:?}");
        assert!((gradients[0][0] - 1.0).abs() < du, "{gradients:?}");
        assert!((row.conditions[1] - 100.0).abs() < 100.0 * u);
        let mut moved = row.estimates();
        moved[0] = 1.07;
        assert!((case.evaluate(&moved)[0] - 1.07).abs() < u, "{number}");
    }
    let setup = Setup::new(&case);
    assert_eq!(setup.data.points.len(), ROWS);
    assert_eq!(setup.unknown_inputs, [0]);
    // the offset of a formula beside the loss of the simulator
    let likelihood = setup.likelihood(&[0, 1]);
    let map = |role: &Role| role.map().unwrap().clone();
    let maps: Vec<_> = likelihood.roles.iter().map(map).collect();
    for scores in [[0.3, -0.5, 0.9], [-1.0, 1.2, -1.4]] {
        let value = |place: usize| maps[place].value(scores[place]);
        let exact = decay(value(0), value(2));
        let found = predict::values(&setup, &[0, 1], &[scores.to_vec()], &setup.all_rows());
        for (found, exact) in found.iter().zip(&exact) {
            let exact = 0.01 * exact + value(1);
            assert!((found[0][0] - exact).abs() < u, "{} {exact}", found[0][0]);
        }
        // and in the likelihood: the covariance holds no more than a twentieth of u besides
        let columns = likelihood.columns(&[scores.to_vec()]);
        let ln = likelihood.log_likelihood(&columns, 1)[0];
        let residual = |row: usize| setup.data.values[0][row] - 0.01 * exact[row] - value(1);
        let chi2: f64 = (0..ROWS).map(|row| (residual(row) / 0.01).powi(2)).sum();
        let expected = -0.5 * chi2 - ROWS as f64 * (elementary::ln(0.01) + 0.918_938_533_204_672_7);
        assert!((ln / expected - 1.0).abs() < 0.02, "{ln} {expected}");
    }
}

/// What the emulator does not know stands in the covariance of its hypothesis and of no other.
#[test]
fn what_is_not_known_is_in_the_covariance() {
    let case = emulated(None);
    let setup = Setup::new(&case);
    let basis = |effects: &[usize]| setup.likelihood(effects).covariance.raw_basis.clone();
    let emulator = case.simulator.as_ref().unwrap().emulator().unwrap();
    let factor = &emulator.unseen(&[0]).unwrap().factor;
    let column = &basis(&[1])[0];
    for (row, value) in column.iter().enumerate() {
        let expected = 0.01 * factor.sizes[0] * factor.vectors[0][row];
        assert!((value - expected).abs() < 1e-15);
    }
    assert_eq!(basis(&[1]), basis(&[0, 1]));
    assert_eq!(basis(&[]).len(), emulator.unseen(&[]).unwrap().factor.sizes.len());
}
