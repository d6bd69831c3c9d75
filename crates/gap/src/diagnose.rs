//! The whole diagnosis, step by step.

use std::sync::atomic::AtomicBool;

use super::diagnosis::{
    DescribedEffect, Diagnosis, DiagnosisNote, EstimatedNoise, Hypothesis, HypothesisKind,
    NamedQuantity, NextMeasurements, NoiseEstimate, OutputCorrelation, RowGap, SerialCorrelation,
    SettingError, SuspectValue,
};
use super::goodness_of_fit::{gap, plus_rows};
use super::known_gap::KnownGap;
use super::notes::notes;
use super::parameters::{equal_tails, parameters, present};
use super::periodic_residuals::{self, PeriodicResiduals};
use super::weighed::{Weighed, rival};
use super::weighed_noise::WeighedNoise;
use super::{next, prior_conflict, replication, shrink, strength};
use crate::{Candidate, Case, OverrideError};
use gumption_engine::decimal::significant;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::Formula;
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::task::Row;
use gumption_inference::latent::Role;
use gumption_inference::noise::noise_model::NoiseModel;
use gumption_inference::noise::prior_widths::{self, OtherPriors};
use gumption_inference::noise::shared_noise::Setting;
use gumption_inference::posterior::{Effort, Posterior, WeighedHypothesis};
use gumption_inference::scan;
use gumption_inference::setup::Setup;
use gumption_inference::shape::ComposedForm;

/// Rows of the data that are handed back, at most; of longer records every so many-th.
const MOST_ROWS: usize = 2000;

/// Data with a larger chi-square have so small a probability without a gap.
const UNLIKELY: f64 = 1e-3;

/// How a diagnosis is made.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct DiagnosisOptions {
    /// Seed of the random numbers.
    pub seed: u64,
}

impl DiagnosisOptions {
    /// Random numbers with this seed.
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }
}

/// Diagnoses a case; `at` are rows of conditions to predict at. `progress` is told the share that is
/// done.
///
/// # Errors
/// Effects that cannot act on the model; data, priors or rows that are none.
pub fn diagnose(
    case: &Case,
    at: Option<&[Row]>,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Diagnosis, OverrideError> {
    diagnosed_at(case, at, options, progress, None)
}

/// As [`diagnose`], until `stop` is set: then it hands back what is known so far, marked as
/// interrupted. Hypotheses that were not yet begun are missing, other noises and regions are not
/// looked for, and nothing is proposed.
///
/// # Errors
/// Effects that cannot act on the model; data, priors or rows that are none.
pub fn diagnose_until(
    case: &Case,
    at: Option<&[Row]>,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
    stop: &AtomicBool,
) -> Result<Diagnosis, OverrideError> {
    diagnosed_at(case, at, options, progress, Some(stop))
}

fn diagnosed_at(
    case: &Case,
    at: Option<&[Row]>,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
    stop: Option<&AtomicBool>,
) -> Result<Diagnosis, OverrideError> {
    case.check_rows(at.unwrap_or_default())?;
    let (mut diagnosis, known) = diagnosed(case, options, progress, stop)?;
    if let Some(at) = at {
        known.predict(&known.case, at, &mut diagnosis);
    }
    Ok(diagnosis)
}

/// The diagnosis, and what predictions need.
pub(crate) fn diagnosed(
    case: &Case,
    options: DiagnosisOptions,
    progress: &(dyn Fn(f64) + Sync),
    stop: Option<&AtomicBool>,
) -> Result<(Diagnosis, KnownGap), OverrideError> {
    case.check()?;
    if case.simulator.as_ref().is_some_and(|simulator| simulator.emulator().is_none()) {
        let reason = "the outputs are those of a simulator, which was not run".to_owned();
        return Err(OverrideError::Case { reason });
    }
    let seed = options.seed;
    let others = OtherPriors::of(case);
    let effort = Effort { stop, ..Effort::FULL };
    let weighed = Weighed::new(case, &others, seed, effort, &|share| progress(0.6 * share));
    let group = weighed.indistinguishable();
    let shares = weighed.shares();
    let verdict = weighed.most_probable(&group, &shares);
    let Weighed {
        wide_priors,
        prior_conflicts,
        departure,
        composed,
        compositions,
        unlisted,
        noise: weighed_noise,
        setup,
        discrepancy,
        posterior,
        best,
        explained,
        correction,
        variances,
        ..
    } = weighed;
    let winner = posterior.together(&posterior.hypotheses[best]);
    let with_rows = plus_rows(&setup, &variances);
    let regions =
        if effort.is_stopped() { Vec::new() } else { scan::regions(&setup, &with_rows, seed) };
    progress(0.7);
    let probability = case.coverage_probability();
    let (mut shrinkage, rows) =
        shrink::shrinkage(&setup, &discrepancy, &posterior, &correction, &variances, seed, stop);
    shrinkage.shares = shares;
    progress(0.85);
    let periodic = periodic_residuals::found(&rows, case.measured());
    // a wave that was composed says it already
    let is_composed = composed
        .first()
        .is_some_and(|effect| effect.terms.iter().any(|term| term.form == ComposedForm::Wave));
    let rivals = if explained {
        rival(&posterior, best, &group).map(|rival| [Some(best), Some(rival)])
    } else {
        Some([None, Some(best)])
    };
    // rows of a simulator belong together: one alone is no measurement of it
    let next = if effort.is_stopped() || case.simulator.is_some() {
        NextMeasurements { entropy: next::entropy_of(&posterior), ..NextMeasurements::default() }
    } else {
        next::next(&setup, &discrepancy, &posterior, &compositions, rivals, &variances, seed)
    };
    let interrupted = effort.is_stopped();
    progress(0.95);
    let noise = noise(&setup, &variances, &winner, (&weighed_noise, probability), &rows);
    let strength = match verdict.kind {
        HypothesisKind::None => Vec::new(),
        _ => strength::along(&setup, &rows),
    };
    let step = rows.len().div_ceil(MOST_ROWS).max(1);
    let rows = rows.into_iter().step_by(step).collect();
    let hypotheses = hypotheses(&setup, &posterior, probability);
    // the test is of the uncertainties as they are stated
    let gap = if setup.data.noise == NoiseModel::default() {
        gap(&setup, verdict.kind)
    } else {
        gap(&Setup::new(case), verdict.kind)
    };
    let mut notes = notes(&setup, &posterior, &verdict, &shrinkage, &gap, &noise, &winner);
    let mut note = |fact: Fact| notes.push(DiagnosisNote { fact });
    if let Some(found) = periodic.filter(|_| !is_composed) {
        note(periodic_note(case, &setup, found));
    }
    // where nothing is left to explain, an effect of another size has only noise to fit
    let is_explained =
        verdict.kind == HypothesisKind::None && gap.p_value.is_some_and(|p| p > UNLIKELY);
    let prior_conflicts = if is_explained { Vec::new() } else { prior_conflicts };
    prior_conflicts.iter().map(prior_conflict::note).for_each(&mut note);
    if wide_priors {
        prior_widths::note(&verdict.effects).into_iter().for_each(&mut note);
    }
    if interrupted {
        notes.insert(0, DiagnosisNote { fact: fact!("interrupted") });
    }
    let present = present(&setup, &posterior, probability);
    let replication = replication::report(&setup, &posterior, probability);
    progress(1.0);
    let named = |name: &str, unit: &gumption_units::Unit| NamedQuantity {
        name: name.to_owned(),
        unit: unit.text().to_owned(),
    };
    let diagnosis = Diagnosis {
        title: case.task.title.clone(),
        source: case.task.source.clone(),
        sim: case.task.statement.clone(),
        outputs: setup
            .data
            .outputs
            .iter()
            .map(|&output| &case.model.outputs[output].quantity)
            .map(|quantity| named(&quantity.name, &quantity.unit))
            .collect(),
        conditions: case.model.conditions.iter().map(|c| named(&c.name, &c.unit)).collect(),
        history: case.measured()..case.described(),
        gap,
        candidates: case.candidates.iter().map(described).collect(),
        interrupted,
        regions,
        strength,
        most_probable: verdict,
        hypotheses,
        shrinkage,
        next,
        prediction: None,
        row_count: setup.data.rows(),
        rows,
        noise,
        present,
        replication,
        simulator: None,
        prior_conflicts,
        departure,
        composed,
        unlisted,
        notes,
        probability,
        seed,
    };
    let shared = weighed_noise.shared(&setup, &variances);
    let known = KnownGap {
        case: setup.case.clone(),
        noise: setup.data.noise.clone(),
        discrepancy,
        posterior,
        compositions,
        shared,
    };
    Ok((diagnosis, known))
}

/// What is to be said of a sine in what the verdict leaves.
fn periodic_note(case: &Case, setup: &Setup<'_>, found: PeriodicResiduals) -> Fact {
    let PeriodicResiduals { output, condition, line } = found;
    let Quantity { name, unit, .. } = &case.model.outputs[setup.data.outputs[output]].quantity;
    let amplitude = Argument::Number(unit.after(&significant(line.amplitude, 2)));
    let percent = Argument::Number(format!("{:.0}", 100.0 * line.share));
    let period = significant(1.0 / line.frequency, 3);
    let Some(along) = condition.and_then(|condition| case.model.conditions.get(condition)) else {
        let period = Argument::Number(period);
        return fact!("periodic-residuals.rows", name, period, amplitude, percent);
    };
    let (condition, unit) = (&along.name, &along.unit);
    let divisor = match unit.text() {
        "" => period.clone(),
        _ => format!("{period} [{unit}]"),
    };
    let period = Argument::Number(unit.after(&period));
    fact!("periodic-residuals", name, condition, period, amplitude, percent, divisor)
}

/// A candidate in words.
fn described(candidate: &Candidate) -> DescribedEffect {
    let effect = &candidate.effect;
    let text = |(name, formula): &(String, Formula)| (name.clone(), formula.text().to_owned());
    let parameter = |quantity: &Quantity| {
        [quantity.name.clone(), quantity.unit.text().to_owned(), quantity.about.clone()]
    };
    DescribedEffect {
        name: effect.name.clone(),
        about: candidate.about.clone(),
        source: candidate.source.clone(),
        overrides: effect.overrides.iter().map(text).collect(),
        parameters: effect.parameters.iter().map(parameter).collect(),
    }
}

/// Number of parameters of effects.
fn parameter_count(setup: &Setup<'_>, effects: &[usize]) -> usize {
    effects.iter().map(|&effect| setup.case.candidates[effect].priors.len()).sum()
}

/// All hypotheses, most probable first.
pub(crate) fn hypotheses(
    setup: &Setup<'_>,
    posterior: &Posterior,
    probability: f64,
) -> Vec<Hypothesis> {
    let mut all: Vec<Hypothesis> = posterior
        .hypotheses
        .iter()
        .map(|alone| (alone.probability, posterior.together(alone)))
        .map(|(alone, hypothesis)| Hypothesis {
            effects: Some(setup.effect_names(&hypothesis.effects)),
            beside: hypothesis.probability > 2.0 * alone,
            prior: hypothesis.prior,
            probability: hypothesis.probability,
            log_evidence: hypothesis.evidence.ln_evidence,
            standard_error: hypothesis.evidence.standard_error,
            effective_sample_size: hypothesis.evidence.effective_sample_size,
            best_log_likelihood: hypothesis
                .evidence
                .modes
                .iter()
                .map(gumption_inference::integral::search::Mode::ln_likelihood)
                .fold(f64::NEG_INFINITY, f64::max),
            fitted: parameter_count(setup, &hypothesis.effects),
            parameters: parameters(setup, &hypothesis, probability),
        })
        .collect();
    all.push(Hypothesis {
        effects: None,
        beside: false,
        prior: posterior.prior,
        probability: posterior.probability,
        log_evidence: posterior.unexplained.ln_evidence,
        standard_error: 0.0,
        effective_sample_size: 0.0,
        best_log_likelihood: f64::NEG_INFINITY,
        fitted: 0,
        parameters: Vec::new(),
    });
    largest_first(&mut all, |a| a.probability);
    all
}

/// What the data say of the noise of every output; `of` are the noise over all hypotheses and the
/// coverage probability, `rows` all rows of the data.
fn noise(
    setup: &Setup<'_>,
    variances: &[f64],
    winner: &WeighedHypothesis,
    of: (&WeighedNoise, f64),
    rows: &[RowGap],
) -> Vec<NoiseEstimate> {
    let (weighed, coverage) = of;
    let data = &setup.data;
    let outputs = data.outputs.len();
    let stated = |output: usize| {
        let observed = setup.case.observed[data.outputs[output]].as_ref();
        observed.is_some_and(|observed| observed.standard_uncertainties.is_some())
    };
    (0..outputs)
        .map(|output| {
            let estimated =
                (!stated(output)).then(|| estimated_noise(setup, variances, winner, output));
            let factor = weighed.factor(output, coverage);
            let with_output = weighed
                .correlations
                .iter()
                .filter(|correlation| correlation.outputs.contains(&output));
            let correlations = with_output.map(|correlation| OutputCorrelation {
                other: if correlation.outputs[0] == output {
                    correlation.outputs[1]
                } else {
                    correlation.outputs[0]
                },
                estimate: correlation.draws.iter().map(|(r, weight)| r * weight).sum(),
                interval: equal_tails(&correlation.draws, coverage),
                probability: correlation.probability,
            });
            let correlations = correlations.collect();
            let own = weighed.suspects.iter().filter(|(suspect, _)| suspect.output == output);
            let mut suspects: Vec<SuspectValue> = own
                .filter_map(|&(suspect, probability)| {
                    let row = data.ids.iter().position(|&id| id == suspect.id)?;
                    let value = rows.get(row)?.outputs.get(output)?;
                    let u = value.u / data.noise.stretch(suspect.id, output);
                    Some(SuspectValue { row: suspect.id, probability, size: value.after / u })
                })
                .collect();
            largest_first(&mut suspects, |a| a.probability);
            let serial = weighed.serial.as_ref().map(|(probability, draws)| SerialCorrelation {
                estimate: draws.iter().map(|(r, weight)| r * weight).sum(),
                interval: equal_tails(draws, coverage),
                probability: *probability,
            });
            let settings = weighed.settings.get(output).and_then(Option::as_ref).map(|setting| {
                let estimate = setting.ratios.iter().map(|(ratio, weight)| ratio * weight).sum();
                SettingError {
                    condition: match setting.setting {
                        Setting::Condition(c) => {
                            setup.case.model.conditions.get(c).map(|known| known.name.clone())
                        }
                        Setting::All => None,
                    },
                    is_per_value: setting.setting.is_per_value(setup.case, data),
                    estimate,
                    interval: equal_tails(&setting.ratios, coverage),
                    standard_deviation: estimate * setting.typical,
                    probability: setting.probability,
                }
            });
            NoiseEstimate { output, estimated, factor, correlations, suspects, serial, settings }
        })
        .collect()
}

fn estimated_noise(
    setup: &Setup<'_>,
    variances: &[f64],
    winner: &WeighedHypothesis,
    output: usize,
) -> EstimatedNoise {
    let outputs = setup.data.outputs.len();
    let mode = winner.evidence.modes.first();
    let own: Vec<f64> = (output..variances.len())
        .step_by(outputs)
        .filter(|&value| setup.data.noise.stretch(setup.data.ids[value / outputs], output) == 1.0)
        .map(|value| variances[value])
        .collect();
    let ln: f64 =
        own.iter().map(|v| 0.5 * elementary::ln(*v)).sum::<f64>() / own.len().max(1) as f64;
    let power = setup.roles.iter().enumerate().find_map(|(place, role)| match role {
        Role::Power { output: of, map } if *of == output => {
            mode.and_then(|mode| mode.scores.get(place)).map(|score| map.value(*score))
        }
        _ => None,
    });
    EstimatedNoise { standard_uncertainty: elementary::exp(ln), power: power.unwrap_or(0.0) }
}
