//! Result files: what a later evaluation needs to take an output for an input.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use serde::Serialize;
use serde_json::ser::Serializer;

use super::EvaluationReport;
use super::answer::{ListsOnOneLine, in_memory};
use gumption_engine::distribution::{Occasion, Root, RootName, Scores};
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{
    Control, EvaluationError, Origins, OutputEvaluation, RowEvaluation, joint_ranks, linear,
    origins, quantiles_and_ranks,
};
use gumption_files::result::{
    DofStatus, InputForm, OutputForm, ProvenanceForm, ResultForm, ScoresForm,
};
use gumption_text::bytes::MOST;

/// The result file of an evaluation's first row. `quantiles` are those of each output's trials over
/// [`Scores::WRITTEN`], `ranks` those of each output in trials that stand for all of them. Numbers are
/// in the shortest text that reads back as the same number, `null` is for what is infinite or not
/// defined.
///
/// The same evaluation gives the same bytes always.
pub fn saved(
    report: &EvaluationReport<'_>,
    origins: &Origins,
    quantiles: &[Vec<f64>],
    ranks: &[Vec<u32>],
) -> String {
    let Some(row) = report.evaluation.rows.first() else {
        return String::new();
    };
    let form = form(report, row, origins, quantiles, ranks);
    in_memory(|bytes| {
        form.sealed()?.serialize(&mut Serializer::with_formatter(bytes, ListsOnOneLine::default()))
    }) + "\n"
}

/// Why there is no result file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SaveError {
    /// The task has several rows of conditions, or none.
    Rows,
    /// There are no trials.
    NoTrials,
    /// An output has no standard uncertainty by either method.
    NoUncertainty {
        /// Its name.
        output: String,
    },
    /// The result file would be larger than result files that are read.
    TooLarge {
        /// Outputs of the model.
        outputs: usize,
        /// Bytes that are read at most.
        most: u64,
    },
    /// The trials cannot be made again.
    Evaluation(EvaluationError),
}

impl fmt::Display for SaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rows => f.write_str(
                "a saved result has one result for each output, but the model has several rows of \
                 conditions; evaluate one row at a time",
            ),
            Self::NoTrials => {
                f.write_str("a saved result needs Monte Carlo trials, but their number is 0")
            }
            Self::NoUncertainty { output } => {
                write!(f, "`{output}` has no standard uncertainty by either method")
            }
            Self::TooLarge { outputs, most } => {
                let most = most / 1_000_000;
                write!(
                    f,
                    "the result of {outputs} outputs, with what they have in common, would be larger \
                     than the {most} MB of a saved result that is read again; keep fewer of them in \
                     the model's `outputs`"
                )
            }
            Self::Evaluation(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for SaveError {}

impl From<EvaluationError> for SaveError {
    fn from(error: EvaluationError) -> Self {
        Self::Evaluation(error)
    }
}

/// The result file of a finished run, whose trials are made again for it ([`saved`]); `None` if that
/// is stopped. `known` are the quantiles of each output at [`Scores::WRITTEN`], where they are known
/// already.
///
/// # Errors
/// [`SaveError`].
pub fn saved_result(
    report: &EvaluationReport<'_>,
    known: Option<&[Vec<f64>]>,
    control: &Control<'_>,
) -> Result<Option<String>, SaveError> {
    let EvaluationReport { task, evaluation, provenance, .. } = *report;
    let ([row], [evaluated]) = (&*task.rows, &*evaluation.rows) else {
        return Err(SaveError::Rows);
    };
    if evaluated.outputs.iter().any(|output| output.monte_carlo.is_none()) {
        return Err(SaveError::NoTrials);
    }
    for (output, found) in task.model.outputs.iter().zip(&evaluated.outputs) {
        let spread = found.monte_carlo.as_deref().and_then(|m| m.standard_uncertainty);
        if linear(found).is_none() && spread.is_none() {
            return Err(SaveError::NoUncertainty { output: output.quantity.name.clone() });
        }
    }
    let scores: Vec<f64> = Scores::WRITTEN.values().collect();
    let found = match known {
        Some(known) => {
            joint_ranks(task, evaluation, 0, control)?.map(|ranks| (known.to_vec(), ranks))
        }
        None => quantiles_and_ranks(task, evaluation, 0, &scores, control)?,
    };
    let Some((quantiles, ranks)) = found else { return Ok(None) };
    let gums: Vec<_> = evaluated.outputs.iter().map(linear).collect();
    let origins = origins(task, row, &gums, &provenance.model_sha256);
    let too_large = SaveError::TooLarge { outputs: evaluated.outputs.len(), most: MOST };
    let numbers = quantiles.iter().map(Vec::len).chain(ranks.iter().map(Vec::len));
    let numbers = numbers.chain(origins.sensitivities.iter().flatten().map(Vec::len));
    let numbers = numbers.sum::<usize>() + evaluated.correlations.len();
    // before it is made, as it may be many times as large; a number and its comma have two bytes at least
    if 2 * numbers as u64 > MOST {
        return Err(too_large);
    }
    let text = saved(report, &origins, &quantiles, &ranks);
    if text.len() as u64 > MOST { Err(too_large) } else { Ok(Some(text)) }
}

fn form(
    report: &EvaluationReport<'_>,
    row: &RowEvaluation,
    origins: &Origins,
    quantiles: &[Vec<f64>],
    ranks: &[Vec<u32>],
) -> ResultForm {
    let EvaluationReport { task, evaluation, provenance, .. } = *report;
    let names: Vec<&str> =
        task.model.outputs.iter().map(|output| output.quantity.name.as_str()).collect();
    let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
    // a single output varies with no other
    let together = ranks.iter().filter(|ranks| !ranks.is_empty()).count() > 1;
    let outputs = row.outputs.iter().enumerate().filter_map(|(place, output)| {
        let ranks = ranks.get(place).filter(|ranks| together && !ranks.is_empty());
        let form = OutputForm {
            unit: task.model.outputs.get(place)?.quantity.unit.text().to_owned(),
            quantiles: quantiles.get(place)?.clone(),
            ranks: ranks.cloned(),
            ..figures(output, origins.sensitivities.get(place)?.as_ref())?
        };
        Some(((*names.get(place)?).to_owned(), form))
    });
    let roots = origins.roots.iter().enumerate();
    let places: HashMap<&RootName, usize> = roots.map(|(at, root)| (&root.name, at)).collect();
    let place = |name: &RootName| places.get(name).copied();
    let coefficients = origins.correlations.iter();
    let coefficients =
        coefficients.filter_map(|c| Some((place(&c.first)?, place(&c.second)?, c.coefficient)));
    let Scores { from, step, count } = Scores::WRITTEN;
    let trials = row.outputs.iter().find_map(|output| output.monte_carlo.as_deref());
    let correlations = pairs.zip(&row.correlations);
    ResultForm {
        format: 1,
        result: true,
        gumption: env!("CARGO_PKG_VERSION").to_owned(),
        title: task.title.clone(),
        coverage_probability: Some(evaluation.coverage_probability),
        outputs: outputs.collect(),
        output_correlations: correlations
            .map(|((i, j), &r)| (names[i].to_owned(), names[j].to_owned(), finite(r)))
            .collect(),
        scores: ScoresForm { from, step, count },
        inputs: origins.roots.iter().map(input).collect(),
        input_correlations: coefficients.collect(),
        provenance: ProvenanceForm {
            model_sha256: provenance.model_sha256.clone(),
            seed: Some(evaluation.settings.seed),
            trials: Some(trials.map_or(0, |figures| figures.trials)),
            files: provenance.files.clone(),
        },
        sha256_of_parts: Vec::new(),
        sha256: None,
    }
}

fn input(root: &Root) -> InputForm {
    let text = |of: &Option<Arc<str>>| of.as_deref().map(str::to_owned);
    let Occasion { data, row, follows, certified } = &root.occasion;
    InputForm {
        model_sha256: root.name.model.to_string(),
        name: root.name.name.to_string(),
        unit: root.unit.clone(),
        distribution: root.distribution.clone(),
        estimate: root.estimate,
        standard_uncertainty: root.standard_uncertainty,
        standard_deviation: finite(root.standard_deviation),
        dof: finite(root.dof),
        data_sha256: text(data),
        certified: text(certified),
        row: text(row),
        follows_conditions: follows.is_some(),
        replaced: text(follows).filter(|text| !text.is_empty()),
    }
}

/// The figures of an output; without `sensitivities` those of its trials.
fn figures(output: &OutputEvaluation, sensitivities: Option<&Vec<f64>>) -> Option<OutputForm> {
    let figures: &MonteCarlo = output.monte_carlo.as_deref()?;
    let gum = output.gum.as_ref().filter(|_| sensitivities.is_some());
    let (dof, dof_status) = match gum.map(|gum| gum.dof) {
        Some(Dof::Finite(dof)) => (Some(dof), DofStatus::Finite),
        Some(Dof::Infinite) => (None, DofStatus::Infinite),
        None if output.drawn_dof.is_infinite() => (None, DofStatus::Infinite),
        Some(Dof::Undefined) | None => (None, DofStatus::Undefined),
    };
    let spread = figures.standard_uncertainty;
    let worth = output.inherited.as_ref().map(|of| of.effective_trials(figures.trials));
    Some(OutputForm {
        unit: String::new(),
        estimate: gum.map_or(figures.location(), |gum| gum.estimate),
        standard_uncertainty: gum.map(|gum| gum.standard_uncertainty).or(spread)?,
        dof,
        dof_status: Some(dof_status),
        coverage_factor: gum.and_then(|gum| gum.coverage_factor),
        expanded_uncertainty: gum.and_then(|gum| gum.expanded_uncertainty()),
        interval: gum.and_then(|gum| gum.interval()),
        standard_deviation: spread,
        drawn_dof: finite(output.drawn_dof),
        effective_trials: worth.map(|worth| worth.round().max(1.0)),
        symmetric_interval: Some(figures.symmetric_interval),
        shortest_interval: Some(figures.shortest_interval),
        sensitivities: sensitivities.cloned(),
        quantiles: Vec::new(),
        ranks: None,
    })
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
