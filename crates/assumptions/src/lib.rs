//! The audit of Type B assumptions: which shapes and widths matter, and which ones readings
//! contradict.
//!
//! Every variant of the evaluation uses the same random numbers (`sampler`): a quantity's value is
//! the quantile at the probability of its standard normal score, whatever its shape. Correlated
//! quantities keep the dependence of their scores (a Gaussian copula) when one of them gets another
//! shape.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances
#![deny(unsafe_code)]

mod alternatives;
mod anderson_darling;
mod evidence;
mod lanes;
mod sampler;
mod sobol;
mod spread;
#[cfg(test)]
mod tests;
mod width_change;

use std::collections::HashSet;
use std::sync::Arc;

use gumption_engine::fact;
use gumption_engine::parallel;

pub use alternatives::Kept;
pub use evidence::{EvidenceOffset, EvidenceTest, EvidenceVerdict, SupportedWidth, agreement};
pub use sobol::Sobol;

use gumption_engine::distribution::{Distribution, EvaluationType, FromScore};
use gumption_engine::propagate::{Control, EvaluationError, gum, in_pool};
use gumption_engine::task::{Evidence, Row, Task, Warning};
use sampler::{Change, Sampler};
use spread::Spread;
use width_change::WidthSearch;

/// The request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Number of trials of every variant, at least 20 000.
    pub trials: u64,
    /// Allowed relative change of the expanded uncertainty (half the length of the coverage
    /// interval), above 0.
    pub allowed: f64,
}

/// The audit of a task.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The request.
    pub question: Question,
    /// The coverage probability of the intervals.
    pub coverage_probability: f64,
    /// One entry for each row of conditions.
    pub rows: Vec<RowAudit>,
    /// The tests of readings, one for each input with evidence.
    pub evidence: Vec<EvidenceTest>,
    /// Notes.
    pub warnings: Vec<Warning>,
}

/// The audit of one row.
#[derive(Clone, Debug)]
pub struct RowAudit {
    /// Values of the conditions.
    pub conditions: Vec<f64>,
    /// One entry for each output.
    pub outputs: Vec<OutputAudit>,
}

/// The audit of one output.
#[derive(Clone, Debug)]
pub struct OutputAudit {
    /// The results with all distributions as stated.
    pub baseline: VariantFigures,
    /// One entry for each line of the budget, in order.
    pub inputs: Vec<InputAudit>,
    /// Sobol indices of quantities that are drawn together, with their indices in the task.
    pub sets: Vec<(Vec<usize>, Option<Sobol>)>,
}

/// Standard uncertainty and coverage interval of one variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariantFigures {
    /// Standard deviation of the trials; `None` if the distribution has none.
    pub standard_uncertainty: Option<f64>,
    /// Probabilistically symmetric coverage interval.
    pub symmetric_interval: [f64; 2],
}

/// The assumption about one input, and its effect.
#[derive(Clone, Debug)]
pub struct InputAudit {
    /// Index of the variable in the task.
    pub variable: usize,
    /// The stated distribution.
    pub distribution: Arc<Distribution>,
    /// Share of the combined variance by the law of propagation; `None` if it is not defined.
    pub share: Option<f64>,
    /// Its Sobol indices; `None` for a quantity that is drawn together with others.
    pub sobol: Option<Sobol>,
    /// Other shapes; empty for a Type A input or a constant.
    pub alternatives: Vec<Alternative>,
    /// The variant in which it is known exactly; `None` for a constant.
    pub removed: Option<VariantChange>,
    /// The variant with half the width; `None` as for the alternatives.
    pub halved: Option<VariantChange>,
    /// The width doubled.
    pub doubled: Option<VariantChange>,
    /// The relative changes of the width that the output tolerates, from -1 (no width) to infinity.
    pub allowed: Option<[f64; 2]>,
}

/// Another shape.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The distribution.
    pub distribution: Distribution,
    /// What it shares with the stated distribution.
    pub kept: Kept,
    /// What it does.
    pub moved: VariantChange,
}

/// The difference between a variant and the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariantChange {
    /// The variant's results; `None` if some of its trials are not finite.
    pub figures: Option<VariantFigures>,
    /// Relative change of half the length of the interval; `None` if the baseline's length is zero.
    pub change: Option<f64>,
    /// Numerical standard error of the change, from the scatter of batches. For changes far below
    /// 0.1 %, where no trials of a batch change their order, it is too small.
    pub error: Option<f64>,
}

/// Smaller changes count as none.
const SMALLEST: f64 = 5e-4;

impl VariantChange {
    /// Whether the change is significant: at least 0.05 %, and more than twice its numerical
    /// standard error.
    pub fn is_seen(&self) -> bool {
        let error = self.error.unwrap_or(0.0);
        self.change.is_some_and(|change| change.abs() > (2.0 * error).max(SMALLEST))
    }
}

impl InputAudit {
    /// The other shape with the largest significant change; `None` without one.
    pub fn most_different(&self) -> Option<&Alternative> {
        let seen = self.alternatives.iter().filter(|other| other.moved.is_seen());
        seen.max_by(|a, b| {
            let [a, b] = [a, b].map(|other| other.moved.change.unwrap_or(0.0).abs());
            a.total_cmp(&b)
        })
    }
}

/// Audits every row of a task; `None` if stopped.
///
/// # Errors
/// Correlations that cannot be drawn; more undefined trials than the settings allow.
pub fn audit(
    task: &Task,
    evidence: &[Evidence],
    question: Question,
    control: &Control<'_>,
) -> Result<Option<Audit>, EvaluationError> {
    in_pool(task, control, || {
        let mut warnings = Vec::new();
        let mut rows = Vec::with_capacity(task.rows.len());
        for row in &task.rows {
            match (Auditor { task, row, question, control }).row(&mut warnings)? {
                Some(audit) => rows.push(audit),
                None => return Ok(None),
            }
        }
        let agreements =
            evidence.iter().filter_map(|evidence| agree(task, evidence, &mut warnings)).collect();
        let mut told = HashSet::new();
        warnings.retain(|warning: &Warning| told.insert(warning.fact.clone()));
        Ok(Some(Audit {
            question,
            coverage_probability: task.settings.coverage.probability(),
            rows,
            evidence: agreements,
            warnings,
        }))
    })?
}

/// The number of trials in the audit of a task.
pub fn trials_to_make(task: &Task, question: Question) -> u64 {
    let row = |row: &Row| {
        let variants = row.distributions.iter().zip(&task.variables).map(|(known, variable)| {
            let changed = changed(variable.evaluation, known);
            let other = if changed { alternatives::alternatives(known).len() + 2 } else { 0 };
            other + usize::from(known.constant().is_none())
        });
        let trials = question.trials.saturating_mul(variants.sum::<usize>() as u64 + 1);
        let varying = row.distributions.iter().filter(|known| known.constant().is_none());
        trials.saturating_add(sobol::evaluations(varying.count()))
    };
    task.rows.iter().map(row).fold(0, u64::saturating_add)
}

/// Whether the input has an assumption that can be varied.
fn changed(evaluation: EvaluationType, known: &Distribution) -> bool {
    evaluation == EvaluationType::B && known.constant().is_none()
}

/// Tests the readings of one input against the distribution in the first row.
fn agree(task: &Task, evidence: &Evidence, warnings: &mut Vec<Warning>) -> Option<EvidenceTest> {
    let name = task.variables.get(evidence.variable).map_or("", |v| v.name.as_str());
    let first = task.rows.first()?.distributions.get(evidence.variable)?;
    let evaluation = task.variables.get(evidence.variable)?.evaluation;
    if !changed(evaluation, first) {
        let fact = match first.constant() {
            Some(_) => fact!("evidence-unused.constant", name),
            None => fact!("evidence-unused", name),
        };
        warnings.push(Warning::new(name, fact));
        return None;
    }
    let differs = |row: &Row| row.distributions.get(evidence.variable) != Some(first);
    if task.rows.iter().any(differs) {
        warnings.push(Warning::new(name, fact!("evidence-first-row", name)));
    }
    agreement(evidence.variable, first, &evidence.readings)
}

/// The audit of one row in progress.
#[derive(Clone, Copy)]
struct Auditor<'a> {
    task: &'a Task,
    row: &'a Row,
    question: Question,
    control: &'a Control<'a>,
}

/// A variant to evaluate: its variable, and the fewest degrees of freedom of the drawn quantities.
struct Variant {
    place: usize,
    change: Change,
    drawn_dof: f64,
}

/// The results of one quantity's variants, in order.
type Moves = Vec<Vec<VariantChange>>;

impl Auditor<'_> {
    fn row(&self, warnings: &mut Vec<Warning>) -> Result<Option<RowAudit>, EvaluationError> {
        let Self { task, row, question, control } = *self;
        let gum = gum::evaluate(task, row);
        let sampler = Sampler::new(task, row, &gum)?;
        let others: Vec<Vec<(Kept, Distribution)>> = (0..sampler.variables.len())
            .map(|place| match self.stated(&sampler, place) {
                Some(stated) if sampler.has_scores(place) => alternatives::alternatives(stated),
                _ => Vec::new(),
            })
            .collect();
        let mut variants = Vec::new();
        for (place, others) in others.iter().enumerate() {
            let known = &row.distributions[sampler.variables[place]];
            let change = Change::Width { place, mean: known.mean(), factor: 0.0 };
            variants.push(Variant { place, change, drawn_dof: f64::INFINITY });
            let Some(stated) = self.stated(&sampler, place) else {
                continue;
            };
            for (_, other) in others {
                let change = Change::Shape(place, FromScore::of(&Arc::new(other.clone())));
                variants.push(Variant { place, change, drawn_dof: other.drawn_dof() });
            }
            for factor in [0.5, 2.0] {
                let change = Change::Width { place, mean: stated.mean(), factor };
                variants.push(Variant { place, change, drawn_dof: stated.drawn_dof() });
            }
        }
        let Some((baseline, moves)) = self.moves(&sampler, &variants, warnings)? else {
            return Ok(None);
        };
        let linked = sampler.linked();
        let (sets, alone) = factors(&sampler, &linked);
        let Some(indices) = sobol::indices(&sampler, &sets, control) else {
            return Ok(None);
        };
        let probability = task.settings.coverage.probability();
        let widths =
            WidthSearch::new(&sampler, question.trials, probability, question.allowed, control);
        let allowed_of = |place| match self.stated(&sampler, place) {
            Some(stated) if !control.is_stopped() => widths.allowed(place, stated.mean(), control),
            _ => Vec::new(),
        };
        let allowed: Vec<Vec<Option<[f64; 2]>>> =
            parallel::map(0..sampler.variables.len(), allowed_of);
        if control.is_stopped() {
            return Ok(None);
        }
        self.note_links(&sampler, &linked, &others, warnings);
        let reach = task.model.program.reach();
        let outputs = (0..sampler.outputs()).map(|output| {
            let finite = self.fewest_dof(&reach, output, None) > 2.0;
            let index = |set: Option<usize>| {
                set.and_then(|set| indices.get(output)?.get(set).copied().flatten())
                    .filter(|_| finite)
            };
            let gum = gum.outputs.get(output).and_then(Option::as_ref);
            let shown = task.variables.iter().enumerate().filter(|(_, variable)| variable.shown);
            let inputs = shown.map(|(variable, _)| {
                let place = sampler.variables.binary_search(&variable).ok();
                let own = |place: usize| {
                    let first = variants.iter().position(|variant| variant.place == place)?;
                    let count = variants.iter().filter(|variant| variant.place == place).count();
                    moves.get(output)?.get(first..first + count)
                };
                let own = place.and_then(own).unwrap_or_default();
                let (removed, own) = own.split_first().map_or((None, own), |(a, b)| (Some(*a), b));
                let shapes = place.and_then(|place| others.get(place));
                let shapes = shapes.map_or(&[][..], Vec::as_slice);
                let alternatives = shapes.iter().zip(own).map(|((kept, distribution), moved)| {
                    Alternative { distribution: distribution.clone(), kept: *kept, moved: *moved }
                });
                let widths = own.get(shapes.len()..).unwrap_or_default();
                let reached = reach.get(output).and_then(|reach| reach.get(variable));
                let sobol = match place.filter(|_| reached == Some(&true)) {
                    // a constant, or no output depends on it
                    None => Some(Sobol { first: 0.0, total: 0.0, standard_error: [0.0; 2] }),
                    Some(place) => index(alone.get(place).copied().flatten()),
                };
                InputAudit {
                    variable,
                    distribution: Arc::clone(&row.distributions[variable]),
                    share: gum.and_then(|gum| {
                        gum.budget().find(|line| line.variable == variable).map(|line| line.share)
                    }),
                    sobol: sobol.filter(|_| finite),
                    alternatives: alternatives.collect(),
                    removed,
                    halved: widths.first().copied(),
                    doubled: widths.get(1).copied(),
                    allowed: place
                        .and_then(|place| allowed.get(place)?.get(output).copied().flatten()),
                }
            });
            let inputs = inputs.collect();
            let sets = sets.iter().enumerate().skip(sets.len() - linked.len()).map(|(s, set)| {
                (set.iter().map(|&place| sampler.variables[place]).collect(), index(Some(s)))
            });
            OutputAudit { baseline: baseline[output], inputs, sets: sets.collect() }
        });
        let outputs = outputs.collect();
        Ok(Some(RowAudit { conditions: row.conditions.clone(), outputs }))
    }

    /// The stated distribution of the quantity at an index, if it is an assumption.
    fn stated(&self, sampler: &Sampler, place: usize) -> Option<&Arc<Distribution>> {
        let variable = *sampler.variables.get(place)?;
        let known = self.row.distributions.get(variable)?;
        changed(self.task.variables.get(variable)?.evaluation, known).then_some(known)
    }

    /// The fewest degrees of freedom among the quantities on which an output depends, if one
    /// variable is drawn with others than stated.
    fn fewest_dof(&self, reach: &[Vec<bool>], output: usize, other: Option<(usize, f64)>) -> f64 {
        let reached = reach.get(output).map_or(&[][..], Vec::as_slice);
        let known = self.row.distributions.iter().enumerate().zip(reached);
        known
            .filter(|(_, reached)| **reached)
            .map(|((variable, known), _)| match other {
                Some((changed, dof)) if changed == variable => dof,
                _ => known.drawn_dof(),
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The baseline of each output, and the result of every variant for it; `None` if stopped.
    fn moves(
        &self,
        sampler: &Sampler,
        variants: &[Variant],
        warnings: &mut Vec<Warning>,
    ) -> Result<Option<(Vec<VariantFigures>, Moves)>, EvaluationError> {
        let Self { task, question, control, .. } = *self;
        let probability = task.settings.coverage.probability();
        let reach = task.model.program.reach();
        let outputs = sampler.outputs();
        let figures = |spread: &Spread, dof: f64| VariantFigures {
            standard_uncertainty: (dof > 2.0).then_some(spread.std),
            symmetric_interval: spread.interval,
        };
        // variants of a quantity on which nothing depends equal the baseline
        let made: Vec<&Variant> =
            variants.iter().filter(|variant| sampler.is_used(variant.place)).collect();
        let at_a_time = (control.memory / spread::bytes(sampler, question.trials).max(1)).max(2);
        let mut baseline: Vec<Spread> = Vec::new();
        let mut spreads = Vec::with_capacity(made.len());
        let groups: Vec<&[&Variant]> =
            if made.is_empty() { vec![&[]] } else { made.chunks(at_a_time - 1).collect() };
        for group in groups {
            let changes: Vec<Change> = std::iter::once(Change::None)
                .chain(group.iter().map(|variant| variant.change.clone()))
                .collect();
            let trials = question.trials;
            let found = spread::spreads(sampler, &changes, trials, probability, control);
            let Some(mut found) = found else {
                return Ok(None);
            };
            spreads.extend(found.drain(1..));
            baseline = found.pop().unwrap_or_default();
        }
        let undefined = baseline.first().map_or(0.0, |spread| spread.undefined);
        if undefined > task.settings.allowed_undefined || undefined >= 1.0 {
            return Err(EvaluationError::NotFinite { share: undefined });
        }
        let stated = (0..outputs)
            .map(|output| figures(&baseline[output], self.fewest_dof(&reach, output, None)));
        let stated: Vec<VariantFigures> = stated.collect();
        let mut spreads = spreads.into_iter();
        let mut moves: Moves = vec![Vec::with_capacity(variants.len()); outputs];
        for variant in variants {
            let own = if sampler.is_used(variant.place) { spreads.next() } else { None };
            let variable = sampler.variables[variant.place];
            if let Some(own) = own.as_ref().and_then(|own| own.first())
                && own.undefined > task.settings.allowed_undefined
            {
                let name = &task.variables[variable].name;
                warnings.push(Warning::new(name, fact!("variant-undefined", name)));
            }
            for (output, moves) in moves.iter_mut().enumerate() {
                let base = &baseline[output];
                let spread = own.as_ref().and_then(|own| own.get(output)).unwrap_or(base);
                let dof = self.fewest_dof(&reach, output, Some((variable, variant.drawn_dof)));
                let defined = spread.undefined <= task.settings.allowed_undefined;
                let [change, error] = match spread.change(base) {
                    Some(found) if defined => found.map(|x| x.is_finite().then_some(x)),
                    _ => [None; 2],
                };
                let figures = defined.then(|| figures(spread, dof));
                moves.push(VariantChange { figures, change, error });
            }
        }
        Ok(Some((stated, moves)))
    }

    /// Warnings about quantities that are drawn together.
    fn note_links(
        &self,
        sampler: &Sampler,
        linked: &[Vec<usize>],
        others: &[Vec<(Kept, Distribution)>],
        warnings: &mut Vec<Warning>,
    ) {
        for set in linked {
            let name = |place: &usize| {
                let variable = self.task.variables.get(sampler.variables[*place]);
                format!("`{}`", variable.map_or("", |v| v.name.as_str()))
            };
            let names: Vec<String> = set.iter().map(name).collect();
            let is_kept = |place: &usize| others.get(*place).is_some_and(|of| !of.is_empty());
            let place = names.join(", ");
            let fact = match set.iter().any(is_kept) {
                true => fact!("drawn-together.ranks", names),
                false => fact!("drawn-together", names),
            };
            warnings.push(Warning::new(place, fact));
        }
    }
}

/// The sets of quantities whose indices are estimated, with those drawn together last, and for each
/// quantity the index of its own set.
fn factors(sampler: &Sampler, linked: &[Vec<usize>]) -> (Vec<Vec<usize>>, Vec<Option<usize>>) {
    let mut sets: Vec<Vec<usize>> = Vec::new();
    let mut alone = vec![None; sampler.variables.len()];
    for (place, alone) in alone.iter_mut().enumerate() {
        if !linked.iter().any(|set| set.contains(&place)) {
            *alone = Some(sets.len());
            sets.push(vec![place]);
        }
    }
    sets.extend(linked.iter().cloned());
    (sets, alone)
}
