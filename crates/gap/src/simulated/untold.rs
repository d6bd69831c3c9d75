//! Parameters of a simulator that the data do not tell, although it was run with many values of them.

use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::COLUMN;
use gumption_inference::latent::Role;
use gumption_inference::posterior::WeighedHypothesis;
use gumption_inference::setup::Setup;

/// A posterior standard deviation from this share of the prior's on tells nothing of a parameter.
const AS_WIDE: f64 = 0.9;

/// Of two parameters with a posterior correlation coefficient from this one on only a combination is known.
const TOGETHER: f64 = 0.99;

/// Parameters of effects that are after the data as unknown as before, and pairs of parameters or inputs of
/// which only a combination is known, if a hypothesis is true.
///
/// Both are of scores, whose prior standard deviation is 1. An input that stays as it was is usual, and no
/// pair with another quantity.
pub(crate) fn facts(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Vec<Fact> {
    if setup.case.simulator.is_none() || !hypothesis.evidence.has_draws() {
        return Vec::new();
    }
    let scores = Scores::of(setup, hypothesis);
    let first = scores.quantities.partition_point(|quantity| quantity.place < setup.roles.len());
    let parameters = first..scores.quantities.len();
    let wide = parameters.filter(|&one| scores.covariance[one][one] > AS_WIDE * AS_WIDE);
    let names: Vec<String> = wide.map(|one| scores.named(one)).collect();
    let mut facts = Vec::new();
    if !names.is_empty() {
        facts.push(fact!("simulator.untold", names));
    }
    for one in 0..scores.quantities.len() {
        for other in 0..one {
            let coefficient = scores.correlation(one, other);
            if coefficient.abs() > TOGETHER {
                let (first, second) = (scores.named(other), scores.named(one));
                let coefficient = Argument::Number(format!("{coefficient:.3}"));
                facts.push(fact!("simulator.together", first, second, coefficient));
            }
        }
    }
    facts
}

/// An unknown quantity that all rows share.
struct Shared {
    /// Its place among the unknown quantities.
    place: usize,
    name: String,
}

/// What the draws of a hypothesis say of the scores of the quantities that all rows share.
struct Scores {
    /// Inputs, then parameters of effects.
    quantities: Vec<Shared>,
    covariance: Vec<Vec<f64>>,
}

impl Scores {
    fn of(setup: &Setup<'_>, hypothesis: &WeighedHypothesis) -> Self {
        let likelihood = setup.likelihood(&hypothesis.effects);
        let quantities = quantities(setup, &hypothesis.effects, &likelihood.roles);
        let evidence = &hypothesis.evidence;
        let mut means = vec![0.0; quantities.len()];
        let mut squares = vec![vec![0.0; quantities.len()]; quantities.len()];
        for (columns, weights) in evidence.columns.iter().zip(evidence.weights.chunks(COLUMN)) {
            let columns = likelihood.mixed(columns);
            for (lane, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
                let score = |of: &Shared| columns[of.place].0[lane];
                for (one, mean) in means.iter_mut().enumerate() {
                    let own = score(&quantities[one]);
                    *mean += weight * own;
                    for (other, square) in squares[one].iter_mut().enumerate() {
                        *square += weight * own * score(&quantities[other]);
                    }
                }
            }
        }
        for (one, row) in squares.iter_mut().enumerate() {
            for (square, mean) in row.iter_mut().zip(&means) {
                *square -= means[one] * mean;
            }
        }
        Self { quantities, covariance: squares }
    }

    fn named(&self, one: usize) -> String {
        format!("`{}`", self.quantities[one].name)
    }

    fn correlation(&self, one: usize, other: usize) -> f64 {
        let variances = self.covariance[one][one] * self.covariance[other][other];
        if variances > 0.0 { self.covariance[one][other] / variances.sqrt() } else { 0.0 }
    }
}

/// Inputs that all rows share, and the parameters of effects.
fn quantities(setup: &Setup<'_>, effects: &[usize], roles: &[Role]) -> Vec<Shared> {
    let variables = &setup.case.task.variables;
    let inputs = roles.iter().take(setup.roles.len()).enumerate();
    let inputs = inputs.filter_map(|(place, role)| match role {
        Role::Variable { place: variable, maps } if maps.len() == 1 => {
            Some(Shared { place, name: variables.get(*variable)?.name.clone() })
        }
        _ => None,
    });
    let parameters = effects.iter().flat_map(|&effect| {
        let of = &setup.case.candidates[effect].effect;
        let places = setup.parameters(effects, effect).zip(&of.parameters);
        places.map(|(place, quantity)| Shared {
            place,
            name: format!("{}/{}", of.name, quantity.name),
        })
    });
    inputs.chain(parameters).collect()
}
