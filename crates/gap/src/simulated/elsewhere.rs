//! Predictions of a simulator in other rows than those of the data.

use gumption_emulator::{Batch, PosteriorEmulator, Runs, State, space_filling_scores};
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::elementary;
use gumption_engine::task::Row;

use super::simulator_runs::SimulatorRuns;
use super::weighed_states::weighed_states;
use super::{MakeRuns, SimulatorDiagnosis, refused, without_simulated};
use crate::OverrideError;
use crate::diagnosis::{Diagnosis, DiagnosisNote};

/// Runs for predictions in other rows if no number is given.
pub const PREDICTION_RUNS: usize = 40;

/// Effects of less than this probability count in no prediction: their runs would cost more than they tell.
const WORTH_RUNS: f64 = 0.01;

/// Predictions in other rows than those of the data.
#[derive(Clone, Debug)]
pub struct Predictions {
    /// The diagnosis with its [`prediction`](Diagnosis::prediction).
    pub diagnosis: Diagnosis,
    /// The runs that were made in these rows, those that were kept as well.
    pub runs: Runs,
}

impl SimulatorDiagnosis {
    /// The corrected simulator in rows of conditions, with its uncertainty: averaged over all hypotheses that
    /// are probable, and over what the data say of their parameters. `make` makes about `budget` runs of the
    /// simulator with the conditions of these rows, at draws of the posteriors; `kept` are runs that were made
    /// there before. All rows belong to one run, since history lives in the rows.
    ///
    /// # Errors
    /// Kept runs of other parameters; rows that are none of the case; no run of a hypothesis succeeded.
    pub fn predict(
        &self,
        rows: Vec<Row>,
        make: &mut MakeRuns<'_>,
        budget: usize,
        kept: Runs,
    ) -> Result<Predictions, OverrideError> {
        let case = &self.known.case;
        let units = case.units_elsewhere().into_iter();
        let units: Vec<f64> = units.flat_map(|unit| vec![unit; rows.len()]).collect();
        let mut runs = SimulatorRuns::new(case, &rows, units, kept)?;
        let batches = self.batches(&runs, budget);
        let mut emulator = PosteriorEmulator::new(runs.space.clone(), runs.units.len())
            .with_scatter(self.scatter.clone());
        for (batch, made) in runs.made(batches, make)? {
            if made.is_empty() {
                let failed = runs.failed().map(|(at, why)| format!(": {at}: {why}"));
                return Err(refused(format!(
                    "no run of the simulator succeeded in the rows of the prediction{}",
                    failed.unwrap_or_default()
                )));
            }
            if let Some(focus) = &batch.focus {
                emulator.learn(&batch.effects, &made, focus);
            }
        }
        let elsewhere = case.elsewhere(emulator, rows);
        let (elsewhere, rows) =
            elsewhere.ok_or_else(|| refused("the rows are none of the simulator".to_owned()))?;
        elsewhere.check_rows(&rows)?;
        let mut diagnosis = self.diagnosis.clone();
        self.known.predict(&elsewhere, &rows, &mut diagnosis);
        without_simulated(&mut diagnosis, elsewhere.described());
        diagnosis.notes.extend(runs.failed_note().map(|fact| DiagnosisNote { fact }));
        Ok(Predictions { diagnosis, runs: runs.runs })
    }

    /// The runs: draws of the posterior of each list of the simulator's effects, as many as its share of the
    /// probability and enough for a plane through them; of the plain simulator its estimates as well, and where
    /// a departure counts, points about them.
    fn batches(&self, runs: &SimulatorRuns, budget: usize) -> Vec<Batch> {
        let (known, space) = (&self.known, &runs.space);
        let setup = known.setup(&known.case);
        let seed = self.diagnosis.seed;
        let mut batches = Vec::new();
        let mut plain = None;
        for state in weighed_states(&setup, &known.posterior, WORTH_RUNS) {
            let effects = &state.effects;
            let least = space.unknowns(effects).len() + 2;
            let share = elementary::exp(state.score);
            let count = ((share * budget as f64).round() as usize).max(least);
            let key = StreamKey::new(seed, &format!("emulator/elsewhere/{effects:?}"));
            let batch = state.batch(space, count, key, 0);
            if effects.is_empty() { plain = Some(batch) } else { batches.push(batch) }
        }
        let departs = known.posterior.departs();
        batches.push(about_estimates(runs, plain, departs >= WORTH_RUNS, seed));
        batches
    }
}

/// Runs of the plain simulator: those at its posterior, where it has one that counts, and at the estimates;
/// with points about the estimates where a departure counts, which takes the slopes there.
fn about_estimates(
    runs: &SimulatorRuns,
    posterior: Option<Batch>,
    departs: bool,
    seed: u64,
) -> Batch {
    let unknowns = runs.space.unknowns(&[]).len();
    let mut scores = vec![vec![0.0; unknowns]];
    if departs {
        let key = StreamKey::new(seed, "emulator/elsewhere/estimates");
        scores.extend(space_filling_scores(2 * unknowns, unknowns, key));
    }
    match posterior {
        Some(mut batch) => {
            batch.scores.extend(scores);
            batch
        }
        None => {
            let state = State {
                effects: Vec::new(),
                score: 0.0,
                mode: scores[0].clone(),
                weights: vec![1.0 / scores.len() as f64; scores.len()],
                draws: scores,
            };
            state.batch(&runs.space, state.draws.len() + 1, StreamKey::new(seed, ""), 0)
        }
    }
}
