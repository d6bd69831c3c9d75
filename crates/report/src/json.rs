//! The answer for programs.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::EvaluationReport;
use super::answer::{in_order, pretty, write_pretty};
use super::fits::FitSide;
use super::json_inputs::{InputsSide, RowInputs, varying};
use super::regions::RegionSide;
use super::subtotals::Subtotals;
use super::table::comparison::is_four_to_one;
use super::table::sweep;
use gumption_engine::model::{GuardRule, Output};
use gumption_engine::propagate::DifferenceCause;
use gumption_engine::propagate::gum::{BudgetLine, CorrelationLine, Dof, Gum};
use gumption_engine::propagate::monte_carlo::{MonteCarlo, NumericalError};
use gumption_engine::propagate::{
    Accuracy, CapabilityStatement, Conformity, ConformityLevel, Evaluation, Noiseless,
    OutputEvaluation, RowEvaluation, SecondOrder, validate,
};
use gumption_engine::task::{Coverage, Task, Trials};

/// The answer as JSON, keys in a fixed order, numbers in the shortest text that reads back as the
/// same number, `null` for what is infinite or not defined. It ends in a newline.
///
/// The same evaluation gives the same bytes always.
pub fn json(report: &EvaluationReport<'_>) -> String {
    pretty(&EvaluationAnswer::of(report))
}

/// Writes what [`json`] gives, piece by piece: it may be much larger than the evaluation.
///
/// # Errors
/// Those of the writer.
pub fn write_json(report: &EvaluationReport<'_>, mut out: impl Write) -> io::Result<()> {
    write_pretty(&EvaluationAnswer::of(report), &mut out)?;
    out.write_all(b"\n")
}

#[derive(Serialize)]
struct EvaluationAnswer<'a> {
    gumption: &'static str,
    title: &'a str,
    coverage_probability: f64,
    #[serde(skip_serializing_if = "is_false")]
    stopped: bool,
    source: Option<&'a str>,
    model: Option<ModelSide<'a>>,
    #[serde(serialize_with = "in_order")]
    equations: &'a [(String, String)],
    inputs: InputsSide<'a>,
    #[serde(flatten)]
    results: EvaluationResults<'a>,
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    cmc_lines: Vec<(&'a str, LineSide<'a>)>,
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    fits: Vec<(&'a str, FitSide<'a>)>,
    warnings: Vec<crate::words::Note<'a>>,
    provenance: Origin<'a>,
}

/// A line that lies on or above U of all rows.
#[derive(Serialize)]
struct LineSide<'a> {
    over: &'a str,
    form: &'static str,
    a: f64,
    b: f64,
    /// Over all rows.
    mean_excess: f64,
}

impl<'a> LineSide<'a> {
    /// Those of all outputs that have one.
    fn all(task: &'a Task, rows: &[RowEvaluation]) -> Vec<(&'a str, Self)> {
        let one = |(place, output): (usize, &'a Output)| {
            let (asked, line, mean_excess) = sweep::capability_line(task, rows, place)?;
            let over = task.model.conditions.get(asked.condition)?.name.as_str();
            let form = if asked.is_quadratic { "Q" } else { "sum" };
            let side = Self { over, form, a: line.constant, b: line.slope, mean_excess };
            Some((output.quantity.name.as_str(), side))
        };
        task.model.outputs.iter().enumerate().filter_map(one).collect()
    }
}

/// The typed model that was evaluated.
#[derive(Serialize)]
struct ModelSide<'a> {
    name: &'a str,
    source: Option<&'a str>,
}

/// A text that is not empty.
fn given(text: &str) -> Option<&str> {
    Some(text.trim()).filter(|text| !text.is_empty())
}

#[derive(Serialize)]
#[serde(untagged)]
enum EvaluationResults<'a> {
    Single(Figures<'a>),
    Swept {
        #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
        condition_units: Vec<(&'a str, &'a str)>,
        rows: SweepRows<'a>,
    },
}

/// The rows of a sweep, made one by one.
struct SweepRows<'a> {
    task: &'a Task,
    evaluation: &'a Evaluation,
}

impl Serialize for SweepRows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { task, evaluation } = *self;
        let varying = varying(task);
        serializer.collect_seq(evaluation.rows.iter().enumerate().map(|(number, row)| {
            let names = task.model.conditions.iter().map(|condition| condition.name.as_str());
            let conditions = names.zip(row.conditions.iter().copied()).collect();
            let figures = Figures::of(task, row, evaluation.stopped);
            let inputs = RowInputs { task, row: number, varying: &varying };
            SweepRow { conditions, inputs, figures }
        }))
    }
}

#[derive(Serialize)]
struct SweepRow<'a> {
    #[serde(serialize_with = "in_order")]
    conditions: Vec<(&'a str, f64)>,
    #[serde(skip_serializing_if = "RowInputs::is_empty")]
    inputs: RowInputs<'a>,
    #[serde(flatten)]
    figures: Figures<'a>,
}

#[derive(Serialize)]
struct Figures<'a> {
    outputs: Outputs<'a>,
    output_correlations: Pairs<'a, f64>,
    /// Those of the coefficients; not there without trials.
    #[serde(skip_serializing_if = "Pairs::is_empty")]
    output_correlations_standard_error: Pairs<'a, Option<f64>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    regions: Vec<RegionSide<'a>>,
}

/// The outputs of a row, made one by one.
struct Outputs<'a> {
    task: &'a Task,
    row: &'a RowEvaluation,
    stopped: bool,
}

impl Serialize for Outputs<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { task, row, stopped } = *self;
        let outputs = task.model.outputs.iter().zip(&row.outputs);
        serializer.collect_map(outputs.map(|(output, evaluation)| {
            let noiseless = evaluation.noiseless.as_ref();
            let side = OutputSide {
                unit: output.quantity.unit.text(),
                gum: evaluation.gum.as_ref().map(|gum| GumSide::of(task, gum, evaluation)),
                monte_carlo: MonteCarloSide::of(task, row, evaluation, stopped),
                exact: noiseless.map(|found| found.as_deref().ok().map(NoiselessSide::of)),
                why: noiseless.and_then(|found| found.as_ref().err()).map(String::as_str),
                validation: Validation::of(evaluation, task.settings.statement_tolerance),
                conformity: evaluation
                    .conformity
                    .as_deref()
                    .map(|found| ConformitySide::of(found, task.settings.coverage)),
                cmc: evaluation.capability.as_deref().map(CmcSide::of),
            };
            (&output.quantity.name, side)
        }))
    }
}

/// A figure of each pair of outputs i < j: the correlation coefficients, or their errors.
struct Pairs<'a, T> {
    task: &'a Task,
    figures: &'a [T],
}

impl<T> Pairs<'_, T> {
    fn is_empty(&self) -> bool {
        self.figures.is_empty()
    }
}

impl<T: Copy + Serialize> Serialize for Pairs<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let names = || self.task.model.outputs.iter().map(|output| &output.quantity.name);
        let pairs = names().enumerate().flat_map(|(i, a)| names().skip(i + 1).map(move |b| (a, b)));
        serializer.collect_seq(pairs.zip(self.figures).map(|((a, b), figure)| (a, b, *figure)))
    }
}

#[derive(Serialize)]
struct OutputSide<'a> {
    unit: &'a str,
    gum: Option<GumSide<'a>>,
    monte_carlo: Option<MonteCarloSide>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Option<NoiselessSide<'a>>>,
    /// Why there are no figures without noise.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
    validation: Option<Validation>,
    #[serde(skip_serializing_if = "Option::is_none")]
    conformity: Option<ConformitySide>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cmc: Option<CmcSide>,
}

#[derive(Serialize)]
struct GumSide<'a> {
    estimate: f64,
    standard_uncertainty: f64,
    dof: Option<f64>,
    dof_status: &'static str,
    coverage_factor: Option<f64>,
    expanded_uncertainty: Option<f64>,
    interval: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_order: Option<SecondOrderSide<'a>>,
    budget: Lines<'a>,
    subtotals: Vec<Subtotal<'a>>,
}

/// The law of propagation with its terms of second order, where they tell something.
#[derive(Serialize)]
struct SecondOrderSide<'a> {
    standard_uncertainty: f64,
    /// Products that matter, with their contributions.
    products: Vec<(&'a str, &'a str, f64)>,
}

impl<'a> SecondOrderSide<'a> {
    fn of(task: &'a Task, second: &SecondOrder) -> Self {
        let name = |v: usize| task.variables.get(v).map_or("", |variable| &variable.name);
        let products = second.products.iter().map(|&(i, j, c)| (name(i), name(j), c));
        Self { standard_uncertainty: second.standard_uncertainty, products: products.collect() }
    }
}

/// The lines of a budget, made one by one.
struct Lines<'a> {
    task: &'a Task,
    gum: &'a Gum,
}

impl Serialize for Lines<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { task, gum } = *self;
        let inputs = gum.budget().filter_map(|line| InputLine::of(task, &line));
        let coefficients = gum.correlations().filter_map(|line| CoefficientLine::of(task, &line));
        serializer.collect_seq(
            inputs.map(BudgetItem::Input).chain(coefficients.map(BudgetItem::Coefficient)),
        )
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum BudgetItem<'a> {
    Input(InputLine<'a>),
    Coefficient(CoefficientLine<'a>),
}

#[derive(Serialize)]
struct InputLine<'a> {
    input: &'a str,
    estimate: f64,
    standard_uncertainty: f64,
    distribution: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    drawn_as: Option<&'static str>,
    r#type: &'static str,
    group: Option<&'a str>,
    dof: Option<f64>,
    sensitivity: f64,
    contribution: f64,
    share: f64,
}

#[derive(Serialize)]
struct CoefficientLine<'a> {
    /// Always null: the line belongs to two inputs.
    input: (),
    correlation: [&'a str; 2],
    coefficient: f64,
    /// Always null.
    contribution: (),
    share: f64,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Subtotal<'a> {
    Group { group: Option<&'a str>, share: f64 },
    Type { r#type: &'static str, share: f64 },
}

#[derive(Serialize)]
struct MonteCarloSide {
    trials: u64,
    seed: u64,
    #[serde(skip_serializing_if = "is_false")]
    stopped: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    undefined_share: Option<f64>,
    estimate: Option<f64>,
    standard_uncertainty: Option<f64>,
    median: f64,
    symmetric_interval: [f64; 2],
    shortest_interval: [f64; 2],
    shortest_exact: bool,
    shortest_unique: bool,
    skewness: Option<f64>,
    excess_kurtosis: Option<f64>,
    numerical_standard_error: ErrorSide,
    #[serde(skip_serializing_if = "Option::is_none")]
    adaptive: Option<AdaptiveSide>,
}

/// Figures without the noise of trials.
#[derive(Serialize)]
struct NoiselessSide<'a> {
    method: &'static str,
    estimate: Option<f64>,
    standard_uncertainty: Option<f64>,
    median: f64,
    symmetric_interval: [f64; 2],
    shortest_interval: Option<[f64; 2]>,
    shortest_unique: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    conformity_probability: Option<f64>,
    #[serde(flatten)]
    accuracy: AccuracySide<'a>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum AccuracySide<'a> {
    Exact {
        bound: f64,
    },
    Quasi {
        numerical_standard_error: ScatterSide,
        integrated_input: &'a str,
        points: u64,
        randomizations: u32,
    },
}

#[derive(Serialize)]
struct ScatterSide {
    estimate: Option<f64>,
    standard_uncertainty: Option<f64>,
    median: f64,
    symmetric_interval: [f64; 2],
    shortest_interval: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    conformity_probability: Option<f64>,
}

impl<'a> NoiselessSide<'a> {
    fn of(found: &'a Noiseless) -> Self {
        let (method, accuracy) = match &found.accuracy {
            Accuracy::Bound(bound) => ("exact", AccuracySide::Exact { bound: *bound }),
            Accuracy::Scatter(scatter) => {
                let numerical_standard_error = ScatterSide {
                    estimate: scatter.estimate,
                    standard_uncertainty: scatter.standard_uncertainty,
                    median: scatter.median,
                    symmetric_interval: scatter.symmetric_interval,
                    shortest_interval: scatter.shortest_interval,
                    conformity_probability: scatter.inside,
                };
                let accuracy = AccuracySide::Quasi {
                    numerical_standard_error,
                    integrated_input: &scatter.integrated,
                    points: scatter.points,
                    randomizations: scatter.randomizations,
                };
                ("quasi", accuracy)
            }
        };
        Self {
            method,
            estimate: found.estimate,
            standard_uncertainty: found.standard_uncertainty,
            median: found.median,
            symmetric_interval: found.symmetric_interval,
            shortest_interval: found.shortest_interval,
            shortest_unique: found.shortest_unique,
            conformity_probability: found.inside,
            accuracy,
        }
    }
}

#[derive(Serialize)]
struct ConformitySide {
    lower: Option<f64>,
    upper: Option<f64>,
    probability: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    probability_without_prior: Option<f64>,
    numerical_standard_error: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    stated_standard_uncertainty: Option<f64>,
    conforms: bool,
    /// By a non-binary rule: `pass`, `conditional pass`, `conditional fail` or `fail`.
    #[serde(skip_serializing_if = "Option::is_none")]
    statement: Option<&'static str>,
    specific_risk: Risks,
    #[serde(skip_serializing_if = "Option::is_none")]
    global_risk: Option<Risks>,
    #[serde(skip_serializing_if = "Option::is_none")]
    guard_band: Option<GuardBand>,
    /// The test uncertainty ratio, and whether it is that of the 4:1 rule.
    #[serde(skip_serializing_if = "Option::is_none")]
    tur: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    four_to_one: Option<bool>,
}

/// Risks of deciding wrongly; `null` for the decision that was not taken.
#[derive(Serialize)]
struct Risks {
    false_acceptance: Option<f64>,
    false_rejection: Option<f64>,
    /// The share of accepted items that does not conform.
    #[serde(skip_serializing_if = "Option::is_none")]
    conditional_false_acceptance: Option<f64>,
}

/// The guard band for a wanted risk, or in multiples of U; `null` where no value has so small a one.
#[derive(Serialize)]
struct GuardBand {
    #[serde(skip_serializing_if = "Option::is_none")]
    risk: Option<f64>,
    /// In expanded uncertainties.
    #[serde(skip_serializing_if = "Option::is_none")]
    factor: Option<f64>,
    /// The name of the rule.
    #[serde(skip_serializing_if = "Option::is_none")]
    rule: Option<&'static str>,
    width: Option<f64>,
    lower: Option<f64>,
    upper: Option<f64>,
}

/// What is decided about a tolerance, as answers have it.
pub(crate) fn decision_value(found: &Conformity, coverage: Coverage) -> serde_json::Value {
    serde_json::to_value(ConformitySide::of(found, coverage)).unwrap_or(serde_json::Value::Null)
}

impl ConformitySide {
    fn of(conformity: &Conformity, coverage: Coverage) -> Self {
        let ratio = conformity.test_uncertainty_ratio().filter(|_| coverage.is_about_95());
        let specific = conformity.specific_risk();
        let stated = conformity.states_conformity();
        let acceptance = conformity.acceptance;
        Self {
            lower: conformity.tolerance.lower,
            upper: conformity.tolerance.upper,
            probability: conformity.probability,
            probability_without_prior: conformity.without_prior,
            numerical_standard_error: conformity.numerical_standard_error,
            stated_standard_uncertainty: conformity.stated_uncertainty,
            conforms: conformity.conforms,
            statement: conformity.level.map(ConformityLevel::name),
            specific_risk: Risks {
                false_acceptance: stated.then_some(specific),
                false_rejection: (!stated).then_some(specific),
                conditional_false_acceptance: None,
            },
            global_risk: conformity.global.map(|risks| Risks {
                false_acceptance: Some(risks.false_acceptance),
                false_rejection: Some(risks.false_rejection),
                conditional_false_acceptance: (risks.acceptance > 0.0)
                    .then(|| risks.conditional_false_acceptance()),
            }),
            guard_band: conformity.is_guarded().then_some(GuardBand {
                risk: conformity.wanted_risk,
                factor: conformity.guard_factor,
                rule: conformity.guard_rule.map(GuardRule::name),
                width: conformity.guard_band,
                lower: acceptance.and_then(|limits| limits.lower),
                upper: acceptance.and_then(|limits| limits.upper),
            }),
            tur: ratio,
            four_to_one: ratio.map(is_four_to_one),
        }
    }
}

/// The laboratory's capability, and what may be stated.
#[derive(Serialize)]
struct CmcSide {
    cmc: f64,
    expanded_uncertainty: f64,
    raised: bool,
}

impl CmcSide {
    fn of(stated: &CapabilityStatement) -> Self {
        let CapabilityStatement { cmc, expanded_uncertainty, raised, .. } = *stated;
        Self { cmc, expanded_uncertainty, raised }
    }
}

/// The number of trials that was asked for.
#[derive(Serialize)]
#[serde(untagged)]
enum AskedTrials {
    Number(u64),
    Word(&'static str),
}

#[derive(Serialize)]
struct AdaptiveSide {
    rule: &'static str,
    block_trials: u64,
    blocks: u64,
    tolerance: f64,
    converged: bool,
}

#[derive(Serialize)]
struct ErrorSide {
    estimate: Option<f64>,
    standard_uncertainty: Option<f64>,
    median: f64,
    symmetric_interval: [f64; 2],
    shortest_interval: [f64; 2],
    skewness: Option<f64>,
    excess_kurtosis: Option<f64>,
}

#[derive(Serialize)]
struct Validation {
    digits: u32,
    tolerance: f64,
    d_low: f64,
    d_high: f64,
    gum_valid: Option<bool>,
    /// Why the interval is not validated.
    #[serde(skip_serializing_if = "Option::is_none")]
    cause: Option<&'static str>,
}

#[derive(Serialize)]
struct Origin<'a> {
    model_sha256: &'a str,
    seed: u64,
    trials: AskedTrials,
    #[serde(serialize_with = "in_order")]
    files: &'a [(String, String)],
}

impl<'a> EvaluationAnswer<'a> {
    fn of(report: &EvaluationReport<'a>) -> Self {
        let EvaluationReport { task, evaluation, warnings, provenance } = *report;
        let cmc_lines = LineSide::all(task, &evaluation.rows);
        let results = match evaluation.rows.first() {
            Some(row) if !task.swept => {
                EvaluationResults::Single(Figures::of(task, row, evaluation.stopped))
            }
            _ => EvaluationResults::Swept {
                condition_units: (task.model.conditions.iter())
                    .map(|condition| (condition.name.as_str(), condition.unit.text()))
                    .collect(),
                rows: SweepRows { task, evaluation },
            },
        };
        let trials = match evaluation.settings.trials {
            Trials::Fixed(trials) => AskedTrials::Number(trials),
            Trials::Adaptive => AskedTrials::Word("adaptive"),
        };
        Self {
            gumption: env!("CARGO_PKG_VERSION"),
            title: &task.title,
            coverage_probability: evaluation.coverage_probability,
            stopped: evaluation.stopped,
            source: given(&task.source),
            model: task
                .statement
                .name
                .as_deref()
                .map(|name| ModelSide { name, source: given(&task.statement.source) }),
            equations: &task.statement.equations,
            inputs: InputsSide { task },
            results,
            cmc_lines,
            fits: task.curves.iter().map(|c| (c.fit.name.as_str(), FitSide::of(c))).collect(),
            warnings: crate::words::notes(warnings),
            provenance: Origin {
                model_sha256: &provenance.model_sha256,
                seed: evaluation.settings.seed,
                trials,
                files: &provenance.files,
            },
        }
    }
}

impl<'a> Figures<'a> {
    fn of(task: &'a Task, row: &'a RowEvaluation, stopped: bool) -> Self {
        let outputs = Outputs { task, row, stopped };
        Self {
            outputs,
            output_correlations: Pairs { task, figures: &row.correlations },
            output_correlations_standard_error: Pairs { task, figures: &row.correlation_errors },
            regions: row.regions.iter().map(|region| RegionSide::of(task, region)).collect(),
        }
    }
}

impl<'a> GumSide<'a> {
    fn of(task: &'a Task, gum: &'a Gum, evaluation: &OutputEvaluation) -> Self {
        let (dof, dof_status) = match gum.dof {
            Dof::Finite(dof) => (Some(dof), "finite"),
            Dof::Infinite => (None, "infinite"),
            Dof::Undefined => (None, "undefined"),
        };
        let Subtotals { groups, types } = Subtotals::of(task, gum);
        let groups = groups.into_iter().map(|(group, share)| Subtotal::Group { group, share });
        let types = types.map(|(kind, share)| Subtotal::Type { r#type: kind.letter(), share });
        Self {
            estimate: gum.estimate,
            standard_uncertainty: gum.standard_uncertainty,
            dof,
            dof_status,
            coverage_factor: gum.coverage_factor,
            expanded_uncertainty: gum.expanded_uncertainty(),
            interval: gum.interval(),
            second_order: evaluation.second_order.as_ref().map(|of| SecondOrderSide::of(task, of)),
            budget: Lines { task, gum },
            subtotals: groups.chain(types).collect(),
        }
    }
}

impl<'a> InputLine<'a> {
    fn of(task: &'a Task, line: &BudgetLine) -> Option<Self> {
        let variable = task.variables.get(line.variable)?;
        Some(Self {
            input: &variable.name,
            estimate: line.estimate,
            standard_uncertainty: line.standard_uncertainty,
            distribution: line.distribution,
            drawn_as: line.drawn_as,
            r#type: variable.evaluation.letter(),
            group: variable.group.as_deref(),
            dof: line.dof.is_finite().then_some(line.dof),
            sensitivity: line.sensitivity,
            contribution: line.contribution,
            share: line.share,
        })
    }
}

impl<'a> CoefficientLine<'a> {
    fn of(task: &'a Task, line: &CorrelationLine) -> Option<Self> {
        let [a, b] = line.variables.map(|place| task.variables.get(place));
        Some(Self {
            input: (),
            correlation: [&a?.name, &b?.name],
            coefficient: line.coefficient,
            contribution: (),
            share: line.share,
        })
    }
}

impl MonteCarloSide {
    fn of(
        task: &Task,
        row: &RowEvaluation,
        output: &OutputEvaluation,
        stopped: bool,
    ) -> Option<Self> {
        let figures: &MonteCarlo = output.monte_carlo.as_deref()?;
        let undefined = row.undefined.as_ref();
        Some(Self {
            trials: figures.trials,
            seed: task.settings.seed,
            stopped,
            undefined_share: undefined
                .map(|left_out| left_out.count as f64 / left_out.trials as f64),
            estimate: figures.estimate,
            standard_uncertainty: figures.standard_uncertainty,
            median: figures.median,
            symmetric_interval: figures.symmetric_interval,
            shortest_interval: figures.shortest_interval,
            shortest_exact: figures.shortest_exact,
            shortest_unique: figures.shortest_unique,
            skewness: figures.skewness,
            excess_kurtosis: figures.excess_kurtosis,
            numerical_standard_error: ErrorSide::from(figures.errors),
            adaptive: figures.adaptive.map(|end| AdaptiveSide {
                rule: end.rule.name(),
                block_trials: end.block_trials,
                blocks: end.blocks,
                tolerance: end.tolerance,
                converged: end.converged,
            }),
        })
    }
}

impl From<NumericalError> for ErrorSide {
    fn from(errors: NumericalError) -> Self {
        let NumericalError {
            estimate,
            standard_uncertainty,
            median,
            symmetric_interval,
            shortest_interval,
            skewness,
            excess_kurtosis,
        } = errors;
        Self {
            estimate,
            standard_uncertainty,
            median,
            symmetric_interval,
            shortest_interval,
            skewness,
            excess_kurtosis,
        }
    }
}

impl Validation {
    fn of(evaluation: &OutputEvaluation, allowed: f64) -> Option<Self> {
        let validate::Validation { digits, tolerance, d_low, d_high, gum_valid } =
            evaluation.validation?;
        let cause = evaluation.difference_cause(allowed).map(DifferenceCause::name);
        Some(Self { digits, tolerance, d_low, d_high, gum_valid, cause })
    }
}

fn is_false(value: &bool) -> bool {
    !value
}
