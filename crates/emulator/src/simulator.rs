//! A simulator as a Rust value: parameters and conditions in, outputs out.

use std::ops::ControlFlow;

use sha2::{Digest, Sha256};

/// A quantity that a simulator is given or returns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SimulatorQuantity {
    /// Its name.
    pub name: String,
    /// Its unit, as the case states it; `1` for a number.
    pub unit: String,
}

/// A condition with its values at all rows of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatorCondition {
    /// Its name and unit.
    pub quantity: SimulatorQuantity,
    /// Its values in the order of the rows, in its unit.
    pub values: Vec<f64>,
}

/// What all runs of a simulator have in common. A simulator gets the conditions of all rows together and
/// in their order, because history lives in the rows.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatorCase {
    /// All parameters in their declared order: inputs, then those of each effect.
    pub parameters: Vec<SimulatorQuantity>,
    /// The conditions in their declared order.
    pub conditions: Vec<SimulatorCondition>,
    /// The outputs in their declared order.
    pub outputs: Vec<SimulatorQuantity>,
    /// Number of rows of the data.
    pub rows: usize,
}

impl SimulatorCase {
    /// The names of the parameters in their declared order.
    pub fn parameter_names(&self) -> Vec<String> {
        self.parameters.iter().map(|parameter| parameter.name.clone()).collect()
    }

    /// The names of the outputs in their declared order.
    pub fn output_names(&self) -> Vec<String> {
        self.outputs.iter().map(|output| output.name.clone()).collect()
    }

    /// Values of all parameters for a message: `length = 0.5 m, drag = 0.1 1/s`.
    pub fn shown(&self, values: &[f64]) -> String {
        let shown = self.parameters.iter().zip(values).map(|(parameter, value)| {
            let unit = Some(&parameter.unit).filter(|unit| *unit != "1");
            let unit = unit.map(|unit| format!(" {unit}")).unwrap_or_default();
            format!("{} = {value:?}{unit}", parameter.name)
        });
        shown.collect::<Vec<String>>().join(", ")
    }

    /// The hash of the case: SHA-256 of all names and units, and of the bits of the conditions, in 64
    /// hexadecimal digits. Runs with the same parameters belong together only if the hashes agree.
    pub fn hash(&self) -> String {
        let mut digest = Sha256::new();
        for count in [self.parameters.len(), self.outputs.len(), self.rows] {
            digest.update((count as u64).to_le_bytes());
        }
        let mut add = |quantity: &SimulatorQuantity, values: &[f64]| {
            for text in [&quantity.name, &quantity.unit] {
                digest.update((text.len() as u64).to_le_bytes());
                digest.update(text);
            }
            digest.update((values.len() as u64).to_le_bytes());
            for value in values {
                digest.update(value.to_bits().to_le_bytes());
            }
        };
        for quantity in self.parameters.iter().chain(&self.outputs) {
            add(quantity, &[]);
        }
        for condition in &self.conditions {
            add(&condition.quantity, &condition.values);
        }
        digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The result of a run: the values of all rows of the first output, then those of the second and so on,
/// each in its unit; or the reason of the failure.
pub type RunResult = Result<Vec<f64>, String>;

/// A program that returns outputs for parameters: a black box without derivatives, which returns the same
/// outputs for the same parameters.
///
/// A closure that makes one run is a simulator, whose runs follow one another. A type that can make several
/// runs at once implements the trait.
///
/// ```
/// use gumption_emulator::{Simulator, SimulatorCase, SimulatorCondition, SimulatorQuantity};
/// use std::ops::ControlFlow;
///
/// let quantity =
///     |name: &str, unit: &str| SimulatorQuantity { name: name.into(), unit: unit.into() };
/// let case = SimulatorCase {
///     parameters: vec![quantity("speed", "m/s"), quantity("start", "m")],
///     conditions: vec![SimulatorCondition {
///         quantity: quantity("t", "s"),
///         values: vec![0.0, 1.0, 2.0],
///     }],
///     outputs: vec![quantity("position", "m")],
///     rows: 3,
/// };
/// let simulator = |parameters: &[f64], case: &SimulatorCase| -> Result<Vec<f64>, String> {
///     let times = case.conditions[0].values.iter();
///     Ok(times.map(|t| parameters[1] + parameters[0] * t).collect())
/// };
/// let mut results = Vec::new();
/// simulator.run(&[vec![2.0, 0.5]], &case, &mut |index, result| {
///     results.push((index, result));
///     ControlFlow::Continue(())
/// });
/// assert_eq!(results, [(0, Ok(vec![0.5, 2.5, 4.5]))]);
/// ```
pub trait Simulator {
    /// Makes a run for each set of parameters, whose values are in the declared order of the case.
    ///
    /// Hands over each result with the index of its set as soon as the run ends, in any order, so that it
    /// can be kept before the next one ends. Ends early if `finished` breaks, or if the simulator was told
    /// to stop; the remaining sets then have no result.
    fn run(
        &self,
        batch: &[Vec<f64>],
        case: &SimulatorCase,
        finished: &mut dyn FnMut(usize, RunResult) -> ControlFlow<()>,
    );
}

impl<F: Fn(&[f64], &SimulatorCase) -> RunResult> Simulator for F {
    fn run(
        &self,
        batch: &[Vec<f64>],
        case: &SimulatorCase,
        finished: &mut dyn FnMut(usize, RunResult) -> ControlFlow<()>,
    ) {
        for (index, parameters) in batch.iter().enumerate() {
            if finished(index, self(parameters, case)).is_break() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case() -> SimulatorCase {
        let quantity =
            |name: &str, unit: &str| SimulatorQuantity { name: name.into(), unit: unit.into() };
        SimulatorCase {
            parameters: vec![quantity("length", "m"), quantity("drag", "1/s")],
            conditions: vec![SimulatorCondition {
                quantity: quantity("t", "s"),
                values: vec![0.0, 0.1],
            }],
            outputs: vec![quantity("angle", "mrad")],
            rows: 2,
        }
    }

    #[test]
    fn cases_that_differ_have_different_hashes() {
        let hash = case().hash();
        assert_eq!(hash.len(), 64);
        let mut others = vec![case(); 6];
        others[0].conditions[0].values[1] = 0.2;
        others[1].outputs[0].unit = "rad".to_owned();
        others[2].parameters.swap(0, 1);
        others[3].conditions[0].quantity.name = "time".to_owned();
        others[4].rows = 3;
        // the same letters in another division
        others[5].parameters[0] = SimulatorQuantity { name: "lengthm".into(), unit: "".into() };
        let mut hashes: Vec<String> = others.iter().map(SimulatorCase::hash).collect();
        hashes.push(hash.clone());
        hashes.sort();
        hashes.dedup();
        assert_eq!(hashes.len(), 7);
        assert_eq!(case().hash(), hash);
    }

    #[test]
    fn a_closure_ends_where_it_is_told() {
        let simulator = |parameters: &[f64], _: &SimulatorCase| -> RunResult {
            Ok(vec![parameters[0], parameters[1]])
        };
        let batch = [vec![1.0, 2.0], vec![3.0, 4.0], vec![5.0, 6.0]];
        let mut results = Vec::new();
        simulator.run(&batch, &case(), &mut |index, result| {
            results.push((index, result));
            if index == 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(results, [(0, Ok(vec![1.0, 2.0])), (1, Ok(vec![3.0, 4.0]))]);
    }
}
