//! Runs of a simulator that were made, none of them twice: repetitions have numbers.

use std::collections::HashMap;
use std::error::Error;
use std::fmt;

use sha2::{Digest, Sha256};

use crate::simulator::RunResult;

/// The hash of a run's parameters: SHA-256 of the bits of their values in declared order, each number the
/// lowest byte first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RunHash([u8; 32]);

impl RunHash {
    /// Of the values of all parameters in their declared order.
    pub fn of(parameters: &[f64]) -> Self {
        let mut digest = Sha256::new();
        for value in parameters {
            digest.update(value.to_bits().to_le_bytes());
        }
        Self(digest.finalize().into())
    }
}

/// In 64 hexadecimal digits.
impl fmt::Display for RunHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// What tells a run from all others.
#[derive(Clone, Debug, PartialEq)]
pub struct RunKey {
    /// The values of all parameters in their declared order, each in its unit.
    pub parameters: Vec<f64>,
    /// How many runs with these parameters come before it: 0, unless the simulator is run again to see how its
    /// outputs scatter.
    pub repetition: usize,
}

/// The first run with these parameters.
impl From<Vec<f64>> for RunKey {
    fn from(parameters: Vec<f64>) -> Self {
        Self { parameters, repetition: 0 }
    }
}

/// A run of a simulator.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The values of all parameters in their declared order, each in its unit.
    pub parameters: Vec<f64>,
    /// How many runs with these parameters come before it.
    pub repetition: usize,
    /// The outputs of all rows, finite and each in its unit, or why there are none.
    pub result: RunResult,
}

/// Why a run is not kept.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RunsError {
    /// There is one of the same parameters and number of repetition.
    Twice(Vec<f64>),
    /// So many parameters, in place of as many as there are names.
    Parameters(usize),
    /// So many rows, in place of those of the runs before.
    Rows {
        /// Of this run.
        found: usize,
        /// Of those before.
        expected: usize,
    },
    /// A parameter that is no finite number.
    NotFinite(String),
}

impl fmt::Display for RunsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Twice(parameters) => write!(f, "there is a run at {parameters:?} already"),
            Self::Parameters(found) => write!(f, "{found} values do not fit the parameters"),
            Self::Rows { found, expected } => {
                write!(f, "the run has {found} rows, those before it {expected}")
            }
            Self::NotFinite(name) => write!(f, "`{name}` is no finite number"),
        }
    }
}

impl Error for RunsError {}

/// All runs that were made, failed ones as well, in their order and by the hash of their parameters and the number
/// of the repetition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    names: Vec<String>,
    rows: Option<usize>,
    made: Vec<Run>,
    places: HashMap<(RunHash, usize), usize>,
}

impl Runs {
    /// No runs yet, of a simulator whose parameters have these names.
    pub fn new(names: Vec<String>) -> Self {
        Self { names, ..Self::default() }
    }

    /// The names of the parameters in their declared order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// All runs, in the order in which they were kept.
    pub fn made(&self) -> &[Run] {
        &self.made
    }

    /// The first run with these parameters, to the bit, if it was made.
    pub fn find(&self, parameters: &[f64]) -> Option<&Run> {
        self.find_repetition(parameters, 0)
    }

    /// The run with these parameters, to the bit, and this number of repetition, if it was made.
    pub fn find_repetition(&self, parameters: &[f64], repetition: usize) -> Option<&Run> {
        let key = (RunHash::of(parameters), repetition);
        self.places.get(&key).map(|&place| &self.made[place])
    }

    /// How many runs with these parameters, to the bit, were made.
    pub fn repetitions(&self, parameters: &[f64]) -> usize {
        let is_made = |repetition: &usize| self.find_repetition(parameters, *repetition).is_some();
        (0..).take_while(is_made).count()
    }

    /// Keeps a run. One with an output that is no finite number has failed.
    ///
    /// # Errors
    /// A repetition that was made before; parameters that do not fit the names; a number of rows that differs.
    pub fn keep(&mut self, mut run: Run) -> Result<&Run, RunsError> {
        if run.parameters.len() != self.names.len() {
            return Err(RunsError::Parameters(run.parameters.len()));
        }
        if let Some(place) = run.parameters.iter().position(|value| !value.is_finite()) {
            return Err(RunsError::NotFinite(self.names[place].clone()));
        }
        if let Ok(outputs) = &run.result {
            let found = outputs.len();
            match self.rows {
                Some(expected) if expected != found => {
                    return Err(RunsError::Rows { found, expected });
                }
                _ => self.rows = Some(found),
            }
            if let Some(row) = outputs.iter().position(|output| !output.is_finite()) {
                run.result = Err(format!("output {} is {}", row + 1, outputs[row]));
            }
        }
        let key = (RunHash::of(&run.parameters), run.repetition);
        if self.places.contains_key(&key) {
            return Err(RunsError::Twice(run.parameters));
        }
        self.places.insert(key, self.made.len());
        self.made.push(run);
        Ok(&self.made[self.made.len() - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs() -> Runs {
        Runs::new(vec!["length".to_owned(), "drag".to_owned()])
    }

    fn run(parameters: [f64; 2], outputs: &[f64]) -> Run {
        Run { parameters: parameters.to_vec(), repetition: 0, result: Ok(outputs.to_vec()) }
    }

    /// The hash of 1 and 2 as computed by Python: `hashlib.sha256(struct.pack("<2d", 1, 2))`.
    #[test]
    fn hashes_are_those_of_the_bits() {
        let hash = "dc91ce9a50ddc828740aa26743716897fdb2bb64f1db662fe263a59be56145ae";
        assert_eq!(RunHash::of(&[1.0, 2.0]).to_string(), hash);
        assert_ne!(RunHash::of(&[2.0, 1.0]).to_string(), hash);
    }

    #[test]
    fn no_run_is_kept_twice() {
        let mut runs = runs();
        runs.keep(run([0.5, 0.0], &[1.0, 2.0])).unwrap();
        let error = runs.keep(run([0.5, 0.0], &[1.0, 3.0])).unwrap_err();
        assert_eq!(error, RunsError::Twice(vec![0.5, 0.0]));
        assert_eq!(runs.find(&[0.5, 0.0]).unwrap().result, Ok(vec![1.0, 2.0]));
        assert_eq!(runs.find(&[0.5 + f64::EPSILON, 0.0]), None);
        let error = runs.keep(run([0.6, 0.0], &[1.0])).unwrap_err();
        assert_eq!(error, RunsError::Rows { found: 1, expected: 2 });
        let error = runs.keep(run([f64::NAN, 0.0], &[1.0, 2.0])).unwrap_err();
        assert_eq!(error, RunsError::NotFinite("length".to_owned()));
        assert_eq!(runs.made().len(), 1);
        // but a repetition is another run
        let again = Run { repetition: 1, ..run([0.5, 0.0], &[1.0, 3.0]) };
        runs.keep(again.clone()).unwrap();
        assert_eq!(runs.find_repetition(&[0.5, 0.0], 1), Some(&again));
        assert_eq!([runs.repetitions(&[0.5, 0.0]), runs.repetitions(&[0.4, 0.0])], [2, 0]);
        assert_eq!(runs.find(&[0.5, 0.0]).unwrap().result, Ok(vec![1.0, 2.0]));
        assert_eq!(runs.keep(again).unwrap_err(), RunsError::Twice(vec![0.5, 0.0]));
    }

    #[test]
    fn outputs_that_are_no_numbers_are_failures() {
        let mut runs = runs();
        let kept = runs.keep(run([0.5, 0.1], &[1.0, f64::INFINITY])).unwrap();
        assert_eq!(kept.result, Err("output 2 is inf".to_owned()));
    }
}
