//! The diagnosis of a simulator from runs that were made before, at whatever parameters.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

use gumption_emulator::{Focus, Plan, Run, RunKey, Runs, Scatter, Space, State, UnseenError};

use super::simulation::Simulation;
use super::simulator_runs::SimulatorRuns;
use super::{SimulatorDiagnosis, WHILE_RUN, refused, repeats};
use crate::diagnose::DiagnosisOptions;
use crate::{Case, OverrideError};

/// A constant parameter may be off by so much of itself, as of a table with fifteen digits.
const ROUNDING: f64 = 1e-9;

/// Diagnoses a case with runs of its simulator that were made before, and makes none. What effects act in a
/// run follows from its parameters. The runs that would tell more are those of
/// [`more`](SimulatorDiagnosis::more). `None` once `stop` is set.
///
/// # Errors
/// As [`diagnose`](super::diagnose); a run with another value of a parameter that is constant in the case.
pub fn diagnose_made(
    case: &Case,
    runs: Runs,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
    stop: &AtomicBool,
) -> Result<Option<SimulatorDiagnosis>, OverrideError> {
    case.check()?;
    let runs = SimulatorRuns::new(case, &case.task.rows, case.simulator_units(), runs)?;
    let space = runs.space.clone();
    let made = runs.runs.made();
    let count = made.len();
    // runs of one effect are learnt before those of two
    let mut by_effects: BTreeMap<(usize, Vec<usize>), Vec<RunKey>> = BTreeMap::new();
    for Run { parameters, repetition, .. } in made {
        check_constants(&space, parameters)?;
        let effects = space.acting(parameters);
        let key = RunKey { parameters: parameters.clone(), repetition: *repetition };
        by_effects.entry((effects.len(), effects)).or_default().push(key);
    }
    let (scatter, repeats) = scatter(case, &runs)?;
    let start = (Vec::new(), scatter);
    let mut simulation = Simulation::new(case, runs, start, options.seed, stop);
    let learn = |simulation: &mut Simulation<'_>, focuses: &BTreeMap<Vec<usize>, Focus>| {
        for ((_, effects), keys) in &by_effects {
            let kept = keys.iter().filter_map(|key| simulation.runs.kept(effects, key).transpose());
            let mut kept = kept.collect::<Result<Vec<_>, _>>()?;
            if let Some(focus) = focuses.get(effects) {
                let (first, held) = focus.parted(&space, effects, kept);
                simulation.emulator.learn(effects, &first, None);
                kept = held;
            }
            simulation.emulator.learn(effects, &kept, focuses.get(effects).cloned());
        }
        Ok::<_, OverrideError>(())
    };
    learn(&mut simulation, &BTreeMap::new())?;
    let singles = (0..space.effects()).map(|effect| vec![effect]);
    let pairs = (0..space.effects())
        .flat_map(|first| (first + 1..space.effects()).map(move |second| vec![first, second]));
    let all: Vec<Vec<usize>> = std::iter::once(Vec::new()).chain(singles).chain(pairs).collect();
    // where posteriors are says which runs tell the error there
    let states = simulation.inferred(all.clone())?.into_iter();
    let focuses = states.map(|state| {
        let focus = Focus::of(&space, &state.effects, &state.draws, &state.weights);
        (state.effects, focus)
    });
    let focuses = focuses.collect();
    simulation.forget();
    learn(&mut simulation, &focuses)?;
    let states = simulation.inferred(all)?;
    simulation.move_linear()?;
    let weighed = simulation.weighed(WHILE_RUN)?;
    if stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let error = |state: &State| simulation.emulator.unseen(&state.effects).map(UnseenError::norm);
    // single effects are to be known at their own best points before any is left out
    let singles = states.into_iter().filter(|state| state.effects.len() < 2);
    let singles = singles.filter(|of| !weighed.iter().any(|other| other.effects == of.effects));
    let singles: Vec<State> = singles.collect();
    let found = |states: Vec<State>| -> Vec<(State, Option<f64>)> {
        states.into_iter().map(|state| (state.clone(), error(&state))).collect()
    };
    let (ending, next) = Plan::of_made(&space, count, found(weighed), found(singles), options.seed);
    let more = next
        .iter()
        .flat_map(|batch| batch.scores.iter().map(|scores| space.values(&batch.effects, scores)));
    let more = more.collect();
    simulation.concluded(ending, more, repeats, options, progress).map(Some)
}

/// How the outputs of a noisy simulator scatter, from the runs that have their parameters in common with others,
/// and how many these are.
///
/// # Errors
/// A noisy simulator of which all runs have parameters of their own; one that is not noisy and does not repeat.
fn scatter(case: &Case, runs: &SimulatorRuns) -> Result<(Option<Scatter>, usize), OverrideError> {
    let mut repeats: Vec<Vec<Vec<f64>>> = Vec::new();
    for run in runs.runs.made().iter().filter(|run| run.repetition == 1) {
        let key = |repetition| RunKey { parameters: run.parameters.clone(), repetition };
        let made = 0..runs.runs.repetitions(&run.parameters);
        let succeeded = made.filter_map(|repetition| runs.outputs(&key(repetition)).transpose());
        let succeeded = succeeded.collect::<Result<Vec<_>, _>>()?;
        if let ([first, others @ ..], false) = (&succeeded[..], runs.is_noisy()) {
            let at = format!("at {}", runs.shown(&run.parameters));
            others.iter().try_for_each(|other| repeats::check(case, &at, first, other))?;
        }
        repeats.push(succeeded);
    }
    if !runs.is_noisy() {
        return Ok((None, 0));
    }
    let count = repeats.iter().map(Vec::len).sum();
    let repeats: Vec<Vec<&[f64]>> =
        repeats.iter().map(|of| of.iter().map(Vec::as_slice).collect()).collect();
    let scatter = Scatter::of(&repeats, case.simulated - 1).ok_or_else(|| {
        let reason = "the simulator is noisy, and no two runs have the same parameters; its scatter takes \
                      some that have";
        refused(reason.to_owned())
    })?;
    Ok((Some(scatter), count))
}

/// Checks that a run has the constants of the case.
fn check_constants(space: &Space, parameters: &[f64]) -> Result<(), OverrideError> {
    let Some(plain) = (parameters.len() == space.names().len()).then(|| space.values(&[], &[]))
    else {
        return Ok(());
    };
    let unknown = space.unknowns(&[]);
    let constants = (0..space.inputs()).filter(|place| !unknown.contains(place));
    for place in constants {
        let (found, constant) = (parameters[place], plain[place]);
        if (found - constant).abs() > ROUNDING * constant.abs() {
            let name = &space.names()[place];
            return Err(refused(format!(
                "a run was made with {name} = {found}, which is constant in the case: {constant}"
            )));
        }
    }
    Ok(())
}
