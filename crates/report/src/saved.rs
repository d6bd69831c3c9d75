//! Result files: what a later evaluation needs to take an output for an input.

use std::collections::HashMap;
use std::fmt;
use std::io;

use serde::Serialize;
use serde_json::Value;
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};

use super::EvaluationReport;
use super::answer::{in_memory, in_order};
use gumption_analysis::integrity;
use gumption_engine::distribution::{RootName, Scores};
use gumption_engine::propagate::gum::Dof;
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{
    Control, EvaluationError, Origins, OutputEvaluation, RowEvaluation, joint_ranks, linear,
    origins, quantiles_and_ranks,
};
use gumption_engine::task::Task;
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
    let mut file = File::of(report, row, origins, quantiles, ranks);
    // numbers as they will be read
    if let Ok(Value::Object(mut content)) = serde_json::to_value(&file) {
        let parts = integrity::parts(&content);
        let listed = parts.iter().map(|(name, of)| (name.clone(), Value::from(of.as_str())));
        content.insert(integrity::PARTS.to_owned(), Value::Object(listed.collect()));
        file.sha256 = Some(integrity::digest(&content));
        file.sha256_of_parts = parts;
    }
    let written = |bytes: &mut Vec<u8>| {
        file.serialize(&mut Serializer::with_formatter(bytes, Layout::default()))
    };
    in_memory(written) + "\n"
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
        let spread = found.monte_carlo.as_ref().and_then(|m| m.standard_uncertainty);
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

#[derive(Serialize)]
struct File<'a> {
    format: u32,
    /// Always true: what tells a result file.
    result: bool,
    gumption: &'static str,
    title: &'a str,
    coverage_probability: f64,
    #[serde(serialize_with = "in_order")]
    outputs: Vec<(&'a str, Output<'a>)>,
    output_correlations: Vec<(&'a str, &'a str, f64)>,
    /// Entry k of `quantiles` belongs to the probability Phi(from + k step).
    scores: ScoresSide,
    /// The inputs that `sensitivities` are to, in order.
    inputs: Vec<Input<'a>>,
    /// Places in `inputs`, counted from 0, and a coefficient.
    input_correlations: Vec<(usize, usize, f64)>,
    provenance: Origin<'a>,
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    sha256_of_parts: Vec<(String, String)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sha256: Option<String>,
}

#[derive(Serialize)]
struct ScoresSide {
    from: f64,
    step: f64,
    count: usize,
}

#[derive(Serialize)]
struct Output<'a> {
    unit: &'a str,
    estimate: f64,
    standard_uncertainty: f64,
    dof: Option<f64>,
    dof_status: &'static str,
    coverage_factor: Option<f64>,
    expanded_uncertainty: Option<f64>,
    interval: Option<[f64; 2]>,
    /// Standard deviation of the trials.
    standard_deviation: Option<f64>,
    /// The fewest degrees of freedom of a t distribution that the trials depend on.
    drawn_dof: Option<f64>,
    /// Trials that the figures are worth, where saved results of limited ones went in.
    #[serde(skip_serializing_if = "Option::is_none")]
    effective_trials: Option<f64>,
    symmetric_interval: [f64; 2],
    shortest_interval: [f64; 2],
    sensitivities: Option<&'a [f64]>,
    quantiles: &'a [f64],
    /// Entry i of all outputs is of the same trial.
    #[serde(skip_serializing_if = "<[u32]>::is_empty")]
    ranks: &'a [u32],
}

#[derive(Serialize)]
struct Input<'a> {
    model_sha256: &'a str,
    name: &'a str,
    unit: &'a str,
    distribution: &'a str,
    estimate: f64,
    standard_uncertainty: f64,
    /// Standard deviation of the drawn values.
    standard_deviation: Option<f64>,
    dof: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data_sha256: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    row: Option<&'a str>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    follows_conditions: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    replaced: Option<&'a str>,
}

#[derive(Serialize)]
struct Origin<'a> {
    model_sha256: &'a str,
    seed: u64,
    trials: u64,
    #[serde(serialize_with = "in_order")]
    files: &'a [(String, String)],
}

impl<'a> File<'a> {
    fn of(
        report: &EvaluationReport<'a>,
        row: &'a RowEvaluation,
        origins: &'a Origins,
        quantiles: &'a [Vec<f64>],
        ranks: &'a [Vec<u32>],
    ) -> Self {
        let EvaluationReport { task, evaluation, provenance, .. } = *report;
        let names: Vec<&str> =
            task.model.outputs.iter().map(|output| output.quantity.name.as_str()).collect();
        let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
        let found = row.outputs.iter().enumerate().filter_map(|(place, output)| {
            let sensitivities = origins.sensitivities.get(place)?.as_deref();
            // a single output varies with no other
            let ranks =
                ranks.get(place).filter(|_| ranks.iter().filter(|r| !r.is_empty()).count() > 1);
            let ranks = ranks.map_or(&[][..], Vec::as_slice);
            let tables = (quantiles.get(place)?.as_slice(), ranks);
            let side = Output::of(task, place, output, sensitivities, tables)?;
            Some((*names.get(place)?, side))
        });
        let roots = origins.roots.iter().enumerate();
        let places: HashMap<&RootName, usize> = roots.map(|(at, root)| (&root.name, at)).collect();
        let place = |name: &RootName| places.get(name).copied();
        let coefficients = origins.correlations.iter();
        let coefficients =
            coefficients.filter_map(|c| Some((place(&c.first)?, place(&c.second)?, c.coefficient)));
        let Scores { from, step, count } = Scores::WRITTEN;
        let trials = row.outputs.iter().find_map(|output| output.monte_carlo.as_ref());
        Self {
            format: 1,
            result: true,
            gumption: env!("CARGO_PKG_VERSION"),
            title: &task.title,
            coverage_probability: evaluation.coverage_probability,
            outputs: found.collect(),
            output_correlations: pairs
                .zip(&row.correlations)
                .map(|((i, j), &r)| (names[i], names[j], r))
                .collect(),
            scores: ScoresSide { from, step, count },
            inputs: origins
                .roots
                .iter()
                .map(|root| Input {
                    model_sha256: &root.name.model,
                    name: &root.name.name,
                    unit: &root.unit,
                    distribution: &root.distribution,
                    estimate: root.estimate,
                    standard_uncertainty: root.standard_uncertainty,
                    standard_deviation: finite(root.standard_deviation),
                    dof: finite(root.dof),
                    data_sha256: root.occasion.data.as_deref(),
                    certified: root.occasion.certified.as_deref(),
                    row: root.occasion.row.as_deref(),
                    follows_conditions: root.occasion.follows.is_some(),
                    replaced: root.occasion.follows.as_deref().filter(|text| !text.is_empty()),
                })
                .collect(),
            input_correlations: coefficients.collect(),
            provenance: Origin {
                model_sha256: &provenance.model_sha256,
                seed: evaluation.settings.seed,
                trials: trials.map_or(0, |figures| figures.trials),
                files: &provenance.files,
            },
            sha256_of_parts: Vec::new(),
            sha256: None,
        }
    }
}

impl<'a> Output<'a> {
    fn of(
        task: &'a Task,
        place: usize,
        output: &OutputEvaluation,
        sensitivities: Option<&'a [f64]>,
        (quantiles, ranks): (&'a [f64], &'a [u32]),
    ) -> Option<Self> {
        let figures: &MonteCarlo = output.monte_carlo.as_ref()?;
        // without sensitivities, the figures of the trials
        let gum = output.gum.as_ref().filter(|_| sensitivities.is_some());
        let (dof, dof_status) = match gum.map(|gum| gum.dof) {
            Some(Dof::Finite(dof)) => (Some(dof), "finite"),
            Some(Dof::Infinite) => (None, "infinite"),
            None if output.drawn_dof.is_infinite() => (None, "infinite"),
            Some(Dof::Undefined) | None => (None, "undefined"),
        };
        let spread = figures.standard_uncertainty;
        Some(Self {
            unit: task.model.outputs.get(place)?.quantity.unit.text(),
            estimate: gum.map_or(figures.location(), |gum| gum.estimate),
            standard_uncertainty: gum.map(|gum| gum.standard_uncertainty).or(spread)?,
            dof,
            dof_status,
            coverage_factor: gum.and_then(|gum| gum.coverage_factor),
            expanded_uncertainty: gum.and_then(|gum| gum.expanded_uncertainty()),
            interval: gum.and_then(|gum| gum.interval()),
            standard_deviation: spread,
            drawn_dof: finite(output.drawn_dof),
            effective_trials: output
                .inherited
                .as_ref()
                .map(|inherited| inherited.effective_trials(figures.trials).round().max(1.0)),
            symmetric_interval: figures.symmetric_interval,
            shortest_interval: figures.shortest_interval,
            sensitivities,
            quantiles,
            ranks,
        })
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Objects over several lines, lists on one.
#[derive(Default)]
struct Layout(PrettyFormatter<'static>);

impl Formatter for Layout {
    fn begin_array_value<W: ?Sized + io::Write>(
        &mut self,
        w: &mut W,
        first: bool,
    ) -> io::Result<()> {
        w.write_all(if first { b"" } else { b", " })
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, w: &mut W) -> io::Result<()> {
        self.0.begin_object(w)
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, w: &mut W) -> io::Result<()> {
        self.0.end_object(w)
    }

    fn begin_object_key<W: ?Sized + io::Write>(
        &mut self,
        w: &mut W,
        first: bool,
    ) -> io::Result<()> {
        self.0.begin_object_key(w, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, w: &mut W) -> io::Result<()> {
        self.0.begin_object_value(w)
    }

    fn end_object_value<W: ?Sized + io::Write>(&mut self, w: &mut W) -> io::Result<()> {
        self.0.end_object_value(w)
    }
}
