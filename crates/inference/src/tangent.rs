//! The model as it is linear in its inputs.
//!
//! Departures that no candidate makes are weighed with the inputs as if these acted linearly: about the
//! estimates, unless another point is known. A simulated trajectory bends: one standard uncertainty of a length
//! moves the swings of a pendulum by a tenth of a turn, and what it does to second order is then more than the
//! noise. There the model is linear about the inputs that are most probable beside the departure.

use gumption_engine::task::Row;

use crate::Case;
use crate::latent::Role;
use crate::simulator::LinearAt;

/// The outputs of a model in a row as linear functions of the inputs.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// What the model says at the inputs at which it is linear.
    pub touching: Vec<f64>,
    /// What the linear functions say at the estimates.
    pub at_estimates: Vec<f64>,
    /// Partial derivatives of each output with respect to the variables.
    pub gradients: Vec<Vec<f64>>,
}

impl Tangent {
    /// Some of the outputs.
    pub(crate) fn of_outputs(&self, outputs: &[usize]) -> Self {
        let some = |of: &[f64]| outputs.iter().map(|&output| of[output]).collect();
        Self {
            touching: some(&self.touching),
            at_estimates: some(&self.at_estimates),
            gradients: outputs.iter().map(|&output| self.gradients[output].clone()).collect(),
        }
    }
}

impl Case {
    /// The model in a row as linear functions of the inputs.
    pub fn tangent(&self, row: &Row) -> Tangent {
        let estimates = row.estimates();
        let mut at = estimates.clone();
        if let Some(linear) = self.linear_at() {
            at[..linear.values.len()].copy_from_slice(&linear.values);
        }
        let (touching, gradients) = self.gradients(&at);
        let inputs = row.distributions.len();
        let linear = |(value, gradient): (&f64, &Vec<f64>)| {
            let moves = gradient.iter().zip(estimates.iter().zip(&at)).take(inputs);
            let moved = moves.filter(|(_, (to, from))| to != from);
            value + moved.map(|(slope, (to, from))| slope * (to - from)).sum::<f64>()
        };
        let at_estimates = touching.iter().zip(&gradients).map(linear).collect();
        Tangent { touching, at_estimates, gradients }
    }

    /// Whether the model is linear about the estimates of its inputs.
    pub(crate) fn is_linear_at_estimates(&self) -> bool {
        self.linear_at().is_none()
    }

    fn linear_at(&self) -> Option<&LinearAt> {
        self.simulator.as_ref()?.linear_at.as_ref()
    }

    /// The scores of the unknown quantities of a setup at the inputs at which the model is linear: those of
    /// the noise are 0.
    pub(crate) fn linear_scores(&self, roles: &[Role]) -> Vec<f64> {
        let known = self.linear_at().map_or(&[][..], |at| &at.scores);
        let score = |role: &Role| match role {
            Role::Variable { place, .. } => {
                known.iter().find(|(of, _)| of == place).map_or(0.0, |(_, score)| *score)
            }
            Role::Noise { .. } | Role::Power { .. } => 0.0,
        };
        roles.iter().map(score).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Setup;
    use crate::tests::simulator::emulated;

    /// Of a simulator that is its input a, which is 1.00 with a standard uncertainty of 0.05, and linear at 1.04:
    /// there it touches, and at the estimate it is the same, as it is linear everywhere. The emulator is off by
    /// less than 0.0005.
    #[test]
    fn a_tangent_touches_where_it_is_told() {
        let at = LinearAt { values: vec![1.04], scores: vec![(0, 0.8)] };
        let case = emulated(Some(at));
        let setup = Setup::new(&case);
        assert_eq!(case.linear_scores(&setup.roles), [0.8]);
        for point in &setup.data.points {
            assert!((point.nominal[0] - 1.0).abs() < 5e-4, "{point:?}");
            assert!((point.tangent.touching[0] - 1.04).abs() < 5e-4, "{point:?}");
            assert!((point.tangent.at_estimates[0] - 1.0).abs() < 5e-4, "{point:?}");
        }
        let (linear, nominal) = (setup.data.linear_residuals(), setup.data.nominal_residuals());
        let mut both = linear[0].iter().zip(&nominal[0]);
        assert!(both.all(|(linear, nominal)| (linear - nominal).abs() < 5e-4));
    }
}
