//! The evaluation of a task: both methods, every row, side by side.

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::Control;
use super::agreement::{self, Agreement};
use super::branch;
use super::conformity::{Conformity, ErrorLaw};
use super::evaluation_error::{EvaluationError, LinearResult, named_values};
use super::exact::{self, Noiseless};
use super::figures::{
    CapabilityStatement, Evaluation, FEW_ROWS, JointlyDrawn, NOTEWORTHY, OutputEvaluation,
    RowEvaluation,
};
use super::gum::{self, Dof, Gum, GumRow};
use super::inherited::Inherited;
use super::moment_order::moment_orders;
use super::monte_carlo::{self, AdaptiveSearch, MonteCarlo, Request, Undefined};
use super::nonlinearity;
use super::regions::regions;
use super::second_order::second_order;
use super::statement::Stated;
use super::trial_work::trial_work;
use super::validate::{Validation, validate};
use super::{quasi, rounding};
use crate::distribution::{BLOCK, Distribution, Joint};
use crate::model::{Output, Program};
use crate::number::{COLUMN, Column};
use crate::parallel;
use crate::task::{MethodChoice, Row, Settings, Task, Trials};

/// The joint draw of a row.
pub fn joint(task: &Task, row: &Row) -> Result<Arc<Joint>, EvaluationError> {
    let joint = task.fits.joint(&row.distributions, &task.correlations);
    joint.map_err(|error| EvaluationError::correlation(task, error))
}

/// Evaluates every row of a task by the law of propagation and by the Monte Carlo method, on all
/// threads at once.
///
/// ```
/// use gumption_engine::distribution::Input;
/// use gumption_measurements::InclinedPlane;
/// use gumption_engine::propagate::{Control, evaluate};
/// use gumption_engine::task::{Settings, Task};
///
/// let plane = InclinedPlane {
///     a_ref: Input::normal(10.0, 0.01, "m/s^2")?,
///     tilt: Input::rectangular(35.0, 0.1, "deg")?,
///     rotation: Input::constant(0.0, "deg")?,
/// };
/// let evaluation = evaluate(&Task::of(plane, Settings::default())?, &Control::default())?;
/// let a_z = &evaluation.rows[0].outputs[2];
/// // a_ref cos(35 deg) = 8.19152 m/s^2
/// assert!((a_z.gum.as_ref().unwrap().estimate - 8.191_52).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A task that does not hold together ([`Task::check`]); contradictory correlations; more undefined
/// trials than the settings allow.
pub fn evaluate(task: &Task, control: &Control<'_>) -> Result<Evaluation, EvaluationError> {
    in_pool(task, control, || evaluate_rows(task, control, &|_| None))?
}

/// The figures of a row's trials, where they are known already.
pub(super) type KnownTrials<'k> = &'k (dyn Fn(usize) -> Option<monte_carlo::Finished> + Sync);

/// Memory for the columns of all threads. Only models of tens of thousands of inputs or hundreds of
/// outputs need so much on a machine of many cores.
const MOST_COLUMNS: usize = 256 << 20;

/// Runs `work` in the caller's thread pool (rayon's global one, unless the call comes from another),
/// or, where the control asks for a number of threads, in a pool of that many, which is kept for the
/// next call. Either way there are no more threads than have room for the columns of the task; where
/// the system gives none, the calling thread does the work ([`parallel::refused`]).
///
/// # Errors
/// A task that does not hold together.
pub fn in_pool<R: Send>(
    task: &Task,
    control: &Control<'_>,
    work: impl FnOnce() -> R + Send,
) -> Result<R, EvaluationError> {
    task.check().map_err(|error| EvaluationError::Task(Box::new(error)))?;
    if is_brief(task) {
        return Ok(work());
    }
    let program = &task.model.program;
    let columns = size_of::<Column>() * (program.variables() + program.operations())
        + size_of::<[f64; BLOCK]>() * program.outputs();
    let room = (MOST_COLUMNS / columns.max(1)).max(1);
    // in a pool of the caller's from here on, or in the global one
    let pool = parallel::pool(control.threads.min(room));
    if control.threads == 0 && rayon::current_num_threads() > room {
        return Ok(parallel::pool(room).install(work));
    }
    Ok(pool.install(work))
}

/// Whether a task takes no longer than waking another thread does: one row of a few outputs by the law of
/// propagation. The calling thread evaluates it, and no other.
pub fn is_brief(task: &Task) -> bool {
    let settings = &task.settings;
    task.rows.len() == 1
        && (settings.trials, settings.method) == (Trials::Fixed(0), None)
        && task.model.outputs.len() < gum::MANY_OUTPUTS
        && task.model.program.operations() < MOST_BRIEF_OPERATIONS
}

/// With as many operations a budget takes some hundred microseconds.
const MOST_BRIEF_OPERATIONS: usize = 1000;

/// Among how many rows at most the memory for kept values is divided.
pub(super) const ROWS_AT_A_TIME: usize = 16;

/// How the rows of a task share the memory; how is a matter of the task alone, so that no figure
/// depends on the number of threads.
pub(super) fn of_one_row<'c>(task: &Task, control: &Control<'c>) -> Control<'c> {
    let memory = control.memory / task.rows.len().clamp(1, ROWS_AT_A_TIME);
    Control { memory, ..*control }
}

/// Evaluates all rows, with the figures of trials that are known and those of others.
pub(super) fn evaluate_rows(
    task: &Task,
    control: &Control<'_>,
    known: KnownTrials<'_>,
) -> Result<Evaluation, EvaluationError> {
    let reaches = reach(&task.model.program, task.variables.len());
    let gum = gum::GumRows::of(task);
    let control = &of_one_row(task, control);
    let notes = Mutex::new(Notes::default());
    // every row has its slot from the start: a million of them are not to be held twice
    let mut rows: Vec<Option<Result<RowEvaluation, EvaluationError>>> = Vec::new();
    rows.resize_with(task.rows.len(), || None);
    let of_row = |row| Some(evaluate_row(task, row, &reaches, control, known, &notes));
    if let ([row], [slot]) = (task.rows.as_slice(), rows.as_mut_slice()) {
        // no hand-over to the threads of the pool, which takes longer than a budget: trials go there
        let mut linear = gum.evaluate_all(std::slice::from_ref(row), control.path);
        *slot = linear.pop().and_then(|linear| of_row(LinearRow { number: 0, row, linear }));
    } else {
        rows.par_chunks_mut(COLUMN).zip(task.rows.par_chunks(COLUMN)).enumerate().for_each(
            |(chunk, (slots, rows))| {
                let linear = gum.evaluate_all(rows, control.path);
                let rows = rows.par_iter().zip(linear).enumerate();
                slots.par_iter_mut().zip(rows).for_each(|(slot, (number, (row, linear)))| {
                    let number = chunk * COLUMN + number;
                    *slot = of_row(LinearRow { number, row, linear });
                });
            },
        );
    }
    // the first row that failed, whichever was ready first
    let rows = rows.into_iter().map_while(|row| row).collect::<Result<Vec<_>, _>>()?;
    let notes = notes.into_inner().unwrap_or_else(PoisonError::into_inner);
    let mut settings = task.settings;
    // one row's number of trials is that with which its figures come out again
    if let ([row], Trials::Fixed(asked)) = (rows.as_slice(), settings.trials)
        && !notes.stopped
    {
        settings.trials = Trials::Fixed(row.made().unwrap_or(asked).max(asked));
    }
    Ok(Evaluation {
        coverage_probability: task.settings.coverage.probability(),
        settings,
        rows,
        rounded_correlations: notes.rounded,
        copula: notes.copula.into_iter().collect(),
        copula_adjusted: notes.adjusted,
        stopped: notes.stopped,
    })
}

/// What the rows say of the whole.
#[derive(Debug, Default)]
struct Notes {
    rounded: bool,
    copula: BTreeSet<usize>,
    adjusted: f64,
    stopped: bool,
}

impl Notes {
    fn add(&mut self, joint: &Joint, stopped: bool) {
        self.rounded |= joint.rounded;
        self.copula.extend(&joint.copula);
        self.adjusted = self.adjusted.max(joint.adjusted);
        self.stopped |= stopped;
    }
}

/// Trials that a guard band is taken from, at most.
const GUARDING: u64 = 1 << 20;

/// The wanted risk, the limits and the figures of an output whose guard band is that of its trials: for a
/// specific risk, where the law of propagation may not be trusted.
fn guarded<'f>(
    output: &Output,
    found: &'f OutputEvaluation,
) -> Option<(f64, [f64; 2], &'f MonteCarlo)> {
    let figures = found.monte_carlo.as_deref()?;
    let (limits, risk) = (output.tolerance?.ends(), output.risk?);
    (output.prior.is_none() && found.trusted().is_none()).then_some((risk, limits, figures))
}

/// A row of the task, with its evaluation by the law of propagation.
struct LinearRow<'r> {
    number: usize,
    row: &'r Row,
    linear: GumRow,
}

fn evaluate_row(
    task: &Task,
    LinearRow { number, row, mut linear }: LinearRow<'_>,
    reaches: &[Vec<bool>],
    control: &Control<'_>,
    known: KnownTrials<'_>,
    notes: &Mutex<Notes>,
) -> Result<RowEvaluation, EvaluationError> {
    let joint = task.joint(row).map_err(|error| EvaluationError::correlation(task, error))?;
    let mut gums = std::mem::take(&mut linear.outputs);
    let drawn_dof = drawn_dof(reaches, row);
    let mut result = RowEvaluation {
        conditions: row.conditions.clone(),
        outputs: Vec::with_capacity(gums.len()),
        correlations: Vec::new(),
        correlation_errors: Vec::new(),
        regions: Vec::new(),
        undefined: None,
        jointly_drawn: joint
            .rank_samples()
            .iter()
            .map(|set| JointlyDrawn { variables: set.members.clone(), trials: set.trials() })
            .collect(),
        copula_changes: Arc::clone(&joint.changes),
    };
    let mut figures: Vec<Option<MonteCarlo>> = vec![None; gums.len()];
    let mut stopped = false;
    if task.settings.trials == Trials::Fixed(0) {
        have_estimates(task, number, row, &linear.estimates)?;
    } else {
        paired_have_covariance(task, row)?;
        rounding::check(task, number, &gums)?;
        let finished = known(number).unwrap_or_else(|| {
            let mut trials = monte_carlo::RowTrials::new(task, row, &linear.estimates, &joint);
            let moment_order = moment_orders(task, row, reaches, &linear);
            decided(task, &mut trials, &gums, &moment_order, control)
        });
        stopped = finished.stopped;
        if let Some(undefined) = finished.undefined {
            if undefined.count as f64 > task.settings.allowed_undefined * undefined.trials as f64 {
                let by_law = by_law(task, &linear.estimates, &gums);
                return Err(explain(task, (number, row), undefined, by_law));
            }
            result.undefined = Some(Box::new(undefined));
        }
        if finished.trials > 0 {
            figures = finished.outputs.into_iter().map(Some).collect();
            result.correlations = finished.correlations;
            result.correlation_errors = finished.correlation_errors;
        }
    }
    let constant = rounding::constant(task, row, &gums, &figures);
    settle(&constant, &linear.estimates, &mut figures, &mut result);
    let inherited = inherited(task, row, reaches, &gums, &mut figures);
    if !result.correlations.is_empty() {
        correlations_by_law(task, &gums, &figures, &linear, &mut result);
    }
    if figures.iter().all(Option::is_none) {
        result.correlations = linear.correlations();
    }
    notes.lock().unwrap_or_else(PoisonError::into_inner).add(&joint, stopped);
    let by_product = (task.rows.len() <= FEW_ROWS).then_some(());
    let asks = gums.iter().zip(&figures).any(|(gum, figures)| {
        gum.as_ref().is_some_and(|gum| match figures {
            Some(figures) => nonlinearity::differs_from_linear(gum, figures),
            None => by_product.is_some(),
        })
    });
    let mut second = vec![None; gums.len()];
    if asks {
        linear.outputs = std::mem::take(&mut gums);
        second = second_order(task, row, &linear);
        gums = std::mem::take(&mut linear.outputs);
    }
    let validations = validations(task, &gums, &figures);
    let at_infinite_dof = of_few_dof(&gums, &validations)
        .and_then(|gums| agreement::at_infinite_dof(task, row, &linear.estimates, &gums, control));
    let evaluated = gums.into_iter().zip(figures).zip(drawn_dof).zip(&task.model.outputs);
    let evaluated = evaluated.zip(second).zip(inherited).enumerate();
    let again = OnceCell::new();
    for (number, (of_output, inherited)) in evaluated {
        let ((((gum, monte_carlo), drawn_dof), output), second_order) = of_output;
        let monte_carlo = monte_carlo.map(Box::new);
        let problem = exact::Problem { task, row, joint: &joint, output: number, drawn_dof };
        let nonlinear = gum.as_ref().zip(monte_carlo.as_deref()).map(|(gum, figures)| {
            nonlinearity::is_nonlinear(&problem, gum, figures, second_order.as_ref())
        });
        let both = gum.as_ref().zip(monte_carlo.as_deref());
        let jump = both.and_then(|(gum, figures)| {
            branch::jump(&task.model.program, number, output, gum, figures)
        });
        // only where there is something to say
        let second_order = second_order.filter(|second| {
            gum.as_ref().is_some_and(|gum| {
                let u = gum.standard_uncertainty;
                nonlinear != Some(false) && (second.standard_uncertainty - u).abs() > NOTEWORTHY * u
            })
        });
        let validation = validations[number];
        // where the law of propagation holds beyond doubt, nobody states other figures
        let needed = !validation
            .zip(monte_carlo.as_deref())
            .is_some_and(|(validation, figures)| is_clearly_valid(&validation, figures));
        let noiseless = noiseless(&problem, needed);
        let is_open = validation.is_some_and(|validation| validation.gum_valid != Some(true));
        let agreement = gum.as_ref().zip(monte_carlo.as_deref()).filter(|_| is_open).and_then(
            |(gum, figures)| match (gum.dof, &at_infinite_dof) {
                (Dof::Infinite, _) | (_, None) => {
                    let noiseless = noiseless.as_ref().and_then(|found| found.as_deref().ok());
                    Agreement::as_drawn(gum, figures, noiseless, &task.settings)
                }
                (_, Some(found)) => found[number],
            },
        );
        let mut found = OutputEvaluation {
            gum,
            monte_carlo,
            second_order: second_order.map(Box::new),
            noiseless,
            inherited: inherited.map(Box::new),
            nonlinear,
            jump: jump.map(Box::new),
            validation,
            agreement,
            capability: None,
            conformity: None,
            drawn_dof,
            guard_band_of_trials: None,
        };
        let output = output.at(&row.conditions);
        found.guard_band_of_trials =
            guarded(&output, &found).and_then(|(risk, limits, figures)| {
                let values = again.get_or_init(|| {
                    let trials = monte_carlo::RowTrials::new(task, row, &linear.estimates, &joint);
                    let room = control.memory / (2 * size_of::<f64>() * trials.outputs().max(1));
                    let count = figures.trials.min(GUARDING).min(room as u64);
                    monte_carlo::collected(&trials, count, control)
                });
                let values = values.as_ref()?.get(number)?.clone();
                let law = ErrorLaw::of_trials(values, found.located()?.0);
                Some(law.guard_band(risk, limits))
            });
        found.capability = capability_beside(&output, &found, &task.settings).map(Box::new);
        found.conformity = Conformity::decided(&output, &found, &task.settings).map(Box::new);
        result.outputs.push(found);
    }
    if !task.regions.is_empty() {
        let trials = monte_carlo::RowTrials::new(task, row, &linear.estimates, &joint);
        result.regions = regions(task, &result, &linear, &trials, control)?;
    }
    Ok(result)
}

/// The comparison of clause 8 for each output.
fn validations(
    task: &Task,
    gums: &[Option<Gum>],
    figures: &[Option<MonteCarlo>],
) -> Vec<Option<Validation>> {
    let digits = task.settings.digits;
    let both = gums.iter().zip(figures);
    both.map(|(gum, figures)| validate(gum.as_ref()?, figures.as_ref()?, digits)).collect()
}

/// The law of propagation of the outputs with finite degrees of freedom whose interval clause 8 does
/// not validate; `None` where there are none.
fn of_few_dof<'g>(
    gums: &'g [Option<Gum>],
    validations: &[Option<Validation>],
) -> Option<Vec<Option<&'g Gum>>> {
    let is_open = |validation: &Validation| validation.gum_valid != Some(true);
    let open = gums.iter().zip(validations).map(|(gum, validation)| {
        let gum = gum.as_ref().filter(|gum| gum.dof != Dof::Infinite)?;
        validation.filter(is_open).map(|_| gum)
    });
    let open: Vec<Option<&Gum>> = open.collect();
    open.iter().any(Option::is_some).then_some(open)
}

/// Takes away what rounding shows of outputs that do not vary: their figures are those of their value at
/// the estimates of the inputs, and they are correlated with none.
fn settle(
    constant: &[bool],
    estimates: &[f64],
    figures: &mut [Option<MonteCarlo>],
    result: &mut RowEvaluation,
) {
    if !constant.contains(&true) {
        return;
    }
    for ((figures, constant), estimate) in figures.iter_mut().zip(constant).zip(estimates) {
        if let Some(figures) = figures.as_mut().filter(|_| *constant) {
            figures.settle(*estimate);
        }
    }
    let count = constant.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let of_constant = pairs.map(|(i, j)| constant[i] || constant[j]).enumerate();
    for (place, _) in of_constant.filter(|(_, of_constant)| *of_constant) {
        if let Some(coefficient) = result.correlations.get_mut(place) {
            *coefficient = f64::NAN;
        }
        if let Some(error) = result.correlation_errors.get_mut(place) {
            *error = None;
        }
    }
}

/// What each output inherits from saved results of limited trials, which is added to the numerical
/// standard errors of its own.
fn inherited(
    task: &Task,
    row: &Row,
    reaches: &[Vec<bool>],
    gums: &[Option<Gum>],
    figures: &mut [Option<MonteCarlo>],
) -> Vec<Option<Inherited>> {
    let probability = task.settings.coverage.probability();
    let outputs = gums.iter().zip(figures).zip(reaches);
    let of_output =
        |((gum, figures), reached): ((&Option<Gum>, &mut Option<MonteCarlo>), &Vec<bool>)| {
            let found = Inherited::of(row, gum.as_ref(), figures.as_ref(), reached, probability);
            if let (Some(found), Some(figures)) = (&found, figures) {
                found.add_to(&mut figures.errors, figures.trials);
            }
            found
        };
    outputs.map(of_output).collect()
}

/// Refuses trials of paired readings whose joint distribution has no covariance.
pub(super) fn paired_have_covariance(task: &Task, row: &Row) -> Result<(), EvaluationError> {
    for (variable, distribution) in task.variables.iter().zip(row.distributions.iter()) {
        if let Distribution::Readings(readings) = &**distribution
            && let Some(error) = readings.without_covariance()
        {
            return Err(EvaluationError::Paired { variable: variable.name.clone(), error });
        }
    }
    Ok(())
}

/// Takes the correlation coefficients of outputs whose trials have none, as their standard deviation is
/// no standard uncertainty, from the law of propagation.
fn correlations_by_law(
    task: &Task,
    gums: &[Option<Gum>],
    figures: &[Option<MonteCarlo>],
    linear: &GumRow,
    result: &mut RowEvaluation,
) {
    let program = &task.model.program;
    let outputs = task.model.outputs.iter().enumerate().zip(gums).zip(figures);
    let scatter: Vec<bool> = outputs
        .map(|(((number, output), gum), figures)| {
            let Some(figures) = figures else { return true };
            let jumps = |gum| branch::jump(program, number, output, gum, figures).is_some();
            figures.standard_uncertainty.is_some() && !gum.as_ref().is_some_and(jumps)
        })
        .collect();
    let of_law = if scatter.contains(&false) { linear.correlations() } else { return };
    let count = scatter.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let coefficients = result.correlations.iter_mut().zip(of_law);
    for (place, ((i, j), (coefficient, of_law))) in pairs.zip(coefficients).enumerate() {
        if scatter[i] && scatter[j] {
            continue;
        }
        *coefficient = if gums[i].is_some() && gums[j].is_some() { of_law } else { f64::NAN };
        if let Some(error) = result.correlation_errors.get_mut(place) {
            *error = None;
        }
    }
}

/// Trials of a row from which on exact figures cost next to nothing beside them, and rows up to which
/// they cost little in any case.
const MANY_TRIALS: u64 = 100_000;
const FEW_EXACT_ROWS: usize = 100;

/// Numerical standard errors beyond which the verdict of clause 8 is that of any seed: normal scatter
/// is so far out once in 500 million times.
const BEYOND_DOUBT: f64 = 6.0;

/// Whether the GUM interval would be found valid with any seed.
fn is_clearly_valid(validation: &Validation, figures: &MonteCarlo) -> bool {
    let differences = [validation.d_low, validation.d_high];
    differences.iter().zip(figures.errors.symmetric_interval).all(|(difference, error)| {
        // a comparison with what is not a number is no proof
        difference + BEYOND_DOUBT * error < validation.tolerance
    })
}

/// The figures of an output without the noise of trials, as far as they are asked for; `needed` is
/// whether dear ones are worth it where nobody asked for them alone.
fn noiseless(problem: &exact::Problem<'_>, needed: bool) -> Option<Result<Box<Noiseless>, String>> {
    let task = problem.task;
    let settings = &task.settings;
    let wanted = settings.method.filter(|wanted| *wanted != MethodChoice::MonteCarlo)?;
    if wanted == MethodChoice::Auto {
        let dear = match settings.trials {
            Trials::Fixed(0) => true,
            Trials::Fixed(trials) => {
                let many_rows = task.rows.len() > FEW_EXACT_ROWS && !settings.quasi_otherwise;
                trials < MANY_TRIALS && many_rows
            }
            Trials::Adaptive => false,
        };
        if dear {
            return None;
        }
    }
    if task.function.is_some() {
        return Some(Err("the model's function is not recorded".to_owned()));
    }
    if problem.joint.undrawn {
        let reason = "correlation coefficients of inputs without a variance do not determine \
                      their joint distribution";
        return Some(Err(reason.to_owned()));
    }
    // a t distribution may have none
    let is_large = |distribution: &Arc<Distribution>| {
        (LARGE..f64::INFINITY).contains(&distribution.standard_uncertainty())
    };
    if problem.row.distributions.iter().any(is_large) {
        return Some(Err(
            "the square of a standard uncertainty is beyond double precision".to_owned()
        ));
    }
    let found = match wanted {
        MethodChoice::Quasi => quasi::evaluate(problem),
        MethodChoice::Auto if settings.quasi_otherwise && needed => {
            exact::evaluate(problem).or_else(|_| quasi::evaluate(problem))
        }
        _ => exact::evaluate(problem),
    };
    Some(found.map(Box::new))
}

/// A standard uncertainty whose square, summed up over inputs, may leave the range of double precision.
const LARGE: f64 = 1e150;

/// How many times as many trials are made where clause 8 is undecided.
const FURTHER: u64 = 4;

/// The Monte Carlo run of a row, and runs of more trials while clause 8 is undecided.
pub(super) fn decided(
    task: &Task,
    trials: &mut monte_carlo::RowTrials,
    gums: &[Option<Gum>],
    moment_order: &[f64],
    control: &Control<'_>,
) -> monte_carlo::Finished {
    let probability = task.settings.coverage.probability();
    let mut finished = run(task, trials, gums, moment_order, control);
    let mut count = Settings::USUAL_TRIALS;
    while let Some(further) = goes_on(task, gums, &finished, count)
        && !control.is_stopped()
    {
        count = further;
        let request = Request { trials: count, probability, moment_order };
        let more = monte_carlo::run(trials, request, &Control { progress: None, ..*control });
        // what was counted before is whole
        if more.stopped {
            finished.stopped = true;
            break;
        }
        finished = more;
    }
    finished
}

/// With how many trials a run of `count` of them goes on, because clause 8 is undecided.
pub(super) fn goes_on(
    task: &Task,
    gums: &[Option<Gum>],
    finished: &monte_carlo::Finished,
    count: u64,
) -> Option<u64> {
    let settings = &task.settings;
    // what is kept of the trials grows with the outputs as well
    let of_a_trial = trial_work(task).max(task.model.outputs.len() as u64);
    let most = settings.decide_up_to / of_a_trial / task.rows.len().max(1) as u64;
    let further = count.saturating_mul(FURTHER);
    if settings.trials != Trials::Fixed(Settings::USUAL_TRIALS) || further > most {
        return None;
    }
    let pairs = gums.iter().zip(&finished.outputs);
    let is_open = pairs
        .filter_map(|(gum, figures)| validate(gum.as_ref()?, figures, settings.digits))
        .any(|validation| validation.gum_valid.is_none());
    is_open.then_some(further)
}

/// The Monte Carlo run of a row, of a fixed or an adaptive number of trials.
fn run(
    task: &Task,
    trials: &mut monte_carlo::RowTrials,
    gums: &[Option<Gum>],
    moment_order: &[f64],
    control: &Control<'_>,
) -> monte_carlo::Finished {
    let settings = &task.settings;
    let probability = settings.coverage.probability();
    if let Trials::Fixed(count) = settings.trials {
        let request = Request { trials: count, probability, moment_order };
        return monte_carlo::run(trials, request, control);
    }
    let gum: Vec<f64> =
        gums.iter().map(|gum| gum.as_ref().map_or(0.0, |g| g.standard_uncertainty)).collect();
    let search = AdaptiveSearch {
        rule: settings.rule,
        probability,
        digits: settings.digits,
        strictness: if settings.for_validation { 5.0 } else { 1.0 },
        most: settings.max_trials,
        moment_order,
        gum: &gum,
    };
    let (count, ends) = monte_carlo::find_trials(trials, search, control);
    let request = Request { trials: count, probability, moment_order };
    // a search that was stopped still hands back the figures of the trials that it made
    let stopped = control.is_stopped();
    let control =
        if stopped { Control { stop: None, progress: None, ..*control } } else { *control };
    let mut finished = monte_carlo::run(trials, request, &control);
    finished.stopped |= stopped;
    for (figures, end) in finished.outputs.iter_mut().zip(ends) {
        // figures that do not exist agree between blocks by chance at most
        let converged = end.converged && !figures.heavy_tailed && !finished.stopped;
        let made = figures.trials / end.block_trials;
        let blocks = if finished.stopped { end.blocks.min(made) } else { end.blocks };
        figures.adaptive = Some(monte_carlo::Adaptive { converged, blocks, ..end });
    }
    finished
}

/// For each output the fewest degrees of freedom among the t distributions that it depends on.
fn drawn_dof(reaches: &[Vec<bool>], row: &Row) -> Vec<f64> {
    reaches.iter().map(|reach| fewest_dof(reach, row)).collect()
}

/// For each output, the variables that it depends on.
pub(super) fn reach(program: &Program, variables: usize) -> Vec<Vec<bool>> {
    program
        .reach()
        .into_iter()
        .map(|mut reach| {
            reach.truncate(variables);
            reach
        })
        .collect()
}

fn fewest_dof(reach: &[bool], row: &Row) -> f64 {
    row.distributions
        .iter()
        .zip(reach)
        .filter(|(_, reached)| **reached)
        .map(|(distribution, _)| distribution.drawn_dof())
        .fold(f64::INFINITY, f64::min)
}

/// What the law of propagation gives for each output; empty if an estimate is not finite.
fn by_law(task: &Task, estimates: &[f64], gums: &[Option<Gum>]) -> Vec<LinearResult> {
    if estimates.iter().any(|estimate| !estimate.is_finite()) {
        return Vec::new();
    }
    let outputs = task.model.outputs.iter().zip(estimates).zip(gums);
    let result = |((output, estimate), gum): ((&Output, &f64), &Option<Gum>)| LinearResult {
        name: output.quantity.name.clone(),
        unit: output.quantity.unit.to_string(),
        estimate: gum.as_ref().map_or(*estimate, |gum| gum.estimate),
        standard_uncertainty: gum.as_ref().map(|gum| gum.standard_uncertainty),
    };
    outputs.map(result).collect()
}

/// Names the first undefined trial's inputs and operation.
fn explain(
    task: &Task,
    (number, row): (usize, &Row),
    undefined: Undefined,
    by_law: Vec<LinearResult>,
) -> EvaluationError {
    let mut drawn = undefined.first.iter().copied();
    let mut inputs = Vec::new();
    let mut values = Vec::with_capacity(task.model.program.variables());
    for (variable, distribution) in task.variables.iter().zip(row.distributions.iter()) {
        let value = distribution.constant().or_else(|| {
            let value = drawn.next()?;
            inputs.push((variable.name.clone(), value));
            Some(value)
        });
        values.push(value.unwrap_or(f64::NAN));
    }
    values.extend(&row.conditions);
    inputs.extend(swept(task, row));
    let operation = task.model.program.first_undefined(&values);
    EvaluationError::Undefined { row: number, undefined, inputs, operation, by_law }
}

/// Names and values of the conditions of a row, where there are several rows.
fn swept(task: &Task, row: &Row) -> impl Iterator<Item = (String, f64)> {
    let conditions = task.model.conditions.iter().zip(&row.conditions);
    let conditions = conditions.filter(|_| task.rows.len() > 1);
    conditions.map(|(condition, value)| (condition.name.clone(), *value))
}

/// What may be stated of an output, as certificates do; `None` without a capability, or an expanded
/// uncertainty.
fn capability_beside(
    output: &Output,
    figures: &OutputEvaluation,
    settings: &Settings,
) -> Option<CapabilityStatement> {
    let capability = output.capability.as_ref()?;
    let found = Stated::of(figures, settings)?;
    Some(CapabilityStatement::of(
        capability,
        found.value,
        found.expanded_uncertainty,
        settings.coverage,
    ))
}

/// Whether outputs have values at the inputs' estimates, which without trials are all there is.
fn have_estimates(
    task: &Task,
    number: usize,
    row: &Row,
    estimates: &[f64],
) -> Result<(), EvaluationError> {
    if task.settings.allowed_undefined > 0.0 {
        return Ok(());
    }
    let Some(output) = estimates.iter().position(|estimate| !estimate.is_finite()) else {
        return Ok(());
    };
    let values = row.estimates();
    let name = task.model.outputs.get(output).map_or("", |output| output.quantity.name.as_str());
    let varies = |place: &usize| {
        row.distributions.get(*place).is_some_and(|distribution| distribution.constant().is_none())
    };
    let inputs = task.variables.iter().zip(&values).enumerate();
    let inputs = inputs.filter(|(place, _)| varies(place));
    let mut at: Vec<(String, f64)> =
        inputs.map(|(_, (variable, value))| (variable.name.clone(), *value)).collect();
    at.extend(swept(task, row));
    let operation = task.model.program.first_undefined(&values).filter(|_| task.function.is_none());
    let operation = operation.map_or_else(String::new, |operation| format!(": {operation}"));
    let message = format!(
        "`{name}` has no finite value at the estimates of the inputs{operation}{}",
        named_values(&at)
    );
    Err(EvaluationError::NoEstimate { row: number, output, message })
}

/// The hash over the bits of all trials of all rows: whether two machines, code paths or numbers of
/// threads give the same trials.
///
/// # Errors
/// Correlations that cannot be drawn.
pub fn trial_hash(task: &Task, trials: u64, control: &Control<'_>) -> Result<u64, EvaluationError> {
    in_pool(task, control, || {
        let mut hash = 0u64;
        for row in &task.rows {
            let estimates = gum::evaluate(task, row).estimates;
            let made = monte_carlo::RowTrials::new(task, row, &estimates, &joint(task, row)?);
            hash = hash.rotate_left(1) ^ monte_carlo::hash_trials(&made, trials, control.path);
        }
        Ok(hash)
    })?
}
