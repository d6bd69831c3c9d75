//! What a diagnosis says.

use std::ops::Range;

use super::composed::ComposedEffect;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::task::ModelStatement;
use gumption_inference::noise::{noise_model, shared_noise};
use gumption_inference::scan::GapRegion;

/// The answer of the gap diagnosis.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// Title of the case.
    pub title: String,
    /// The document that the measurement follows; empty where the case names none.
    pub source: String,
    /// The sim's model and its equations.
    pub sim: ModelStatement,
    /// The observed outputs with their units.
    pub outputs: Vec<NamedQuantity>,
    /// The conditions with their units.
    pub conditions: Vec<NamedQuantity>,
    /// The places of those that follow from the order of the rows.
    pub history: Range<usize>,
    /// Whether there is a gap.
    pub gap: GapTest,
    /// The candidate effects, in the order of the case.
    pub candidates: Vec<DescribedEffect>,
    /// Whether it was interrupted, so that it holds what was known then.
    pub interrupted: bool,
    /// Where it lies, most surprising region first.
    pub regions: Vec<GapRegion>,
    /// How strong it is along each condition, for each output; empty without a gap.
    pub strength: Vec<GapStrength>,
    /// The hypothesis of highest posterior probability.
    pub most_probable: MostProbable,
    /// All hypotheses, most probable first.
    pub hypotheses: Vec<Hypothesis>,
    /// How far the gap shrinks.
    pub shrinkage: Shrinkage,
    /// What to measure next.
    pub next: NextMeasurements,
    /// Corrected predictions at conditions that were asked for.
    pub prediction: Option<Vec<Predicted>>,
    /// How many rows of data there are.
    pub row_count: usize,
    /// The data row by row, before and after; of very many rows some, evenly spread.
    pub rows: Vec<RowGap>,
    /// What the data say of the noise of each observed output.
    pub noise: Vec<NoiseEstimate>,
    /// For each candidate effect the probability that it is part of the truth, most probable first.
    pub present: Vec<PresentEffect>,
    /// Sizes of effects in each group of rows, where the case says which belong together.
    pub replication: Option<ReplicatedEffects>,
    /// How the sim was run, where it is a simulator.
    pub simulator: Option<SimulatorReport>,
    /// Effects whose priors the data contradict, most probable first.
    pub prior_conflicts: Vec<PriorConflict>,
    /// What is known of a departure that no candidate makes, by itself or beside some of them, most
    /// probable form first; empty where that has at most the probability 0.05.
    pub departure: Vec<DepartureForm>,
    /// Effects that would explain it, composed and not from the list, most probable first; empty where
    /// that has at most the probability 0.05.
    pub composed: Vec<ComposedEffect>,
    /// Effects that ship with the program and are not listed, and that would explain it, most probable
    /// first.
    pub unlisted: Vec<UnlistedEffect>,
    /// What to bear in mind.
    pub notes: Vec<DiagnosisNote>,
    /// Coverage probability of all intervals.
    pub probability: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// A quantity's name and unit.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedQuantity {
    /// Name.
    pub name: String,
    /// Unit as written; empty for a plain number.
    pub unit: String,
}

/// How a simulator was run, and how well its outputs are known.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatorReport {
    /// How many runs were used.
    pub runs: usize,
    /// How many of all runs failed.
    pub failed: usize,
    /// The error of what is taken for the outputs at the verdict's posterior, on runs that were not known: the
    /// root mean square of its norm over all rows, in standard uncertainties of the data. `None` where it was
    /// not run there.
    pub error: Option<f64>,
    /// The simulator itself at the verdict; `None` where nothing is named, or that run failed.
    pub at_verdict: Option<RunAtVerdict>,
}

/// A run of a simulator at the most probable parameters of the verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct RunAtVerdict {
    /// The parameters of the simulator with their values, each in its unit.
    pub parameters: Vec<(NamedQuantity, f64)>,
    /// What is taken for the outputs is off by so much: the norm over all rows, in standard uncertainties of the
    /// data.
    pub error: f64,
    /// The root mean square of what the data depart from the run by, in their standard uncertainties. `None` where
    /// formulas change the outputs.
    pub residual: Option<f64>,
}

/// A candidate effect in words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct DescribedEffect {
    /// Name.
    pub name: String,
    /// What it is.
    pub about: String,
    /// Where it comes from.
    pub source: String,
    /// The quantities that it overrides, each with its formula.
    pub overrides: Vec<(String, String)>,
    /// Its parameters: name, unit, what it is.
    pub parameters: Vec<[String; 3]>,
}

impl DescribedEffect {
    /// Of a name, with nothing said of it.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }
}

/// Whether the data depart from the model by more than the stated uncertainties explain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapTest {
    /// Whether the verdict is another than "none".
    pub present: bool,
    /// The probability of residuals as large as these without a gap, by the chi-square test of all
    /// residuals together; `None` where the noise is estimated from them and there are no repeats.
    pub p_value: Option<f64>,
    /// Squared length of the residuals in the metric of their covariance.
    pub chi2: f64,
    /// Degrees of freedom.
    pub dof: f64,
}

/// How strong the gap of an output is along a condition.
#[derive(Clone, Debug, PartialEq)]
pub struct GapStrength {
    /// Place of the output.
    pub output: usize,
    /// Place of the condition.
    pub condition: usize,
    /// Parts of the condition's values, in order.
    pub parts: Vec<StrengthPart>,
}

/// A part of a condition's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrengthPart {
    /// Its least and largest value, in the condition's unit.
    pub range: [f64; 2],
    /// Share of the excess of the output's squared residuals that lies here.
    pub share_of_gap: f64,
    /// Mean of the residuals over their standard uncertainties.
    pub mean_z: f64,
}

/// An effect of the shipped catalogue that the case does not list.
#[derive(Clone, Debug)]
pub struct UnlistedEffect {
    /// Its name in the catalogue.
    pub effect: String,
    /// Posterior probability beside what "unexplained" is otherwise, all of the catalogue together
    /// being as probable beforehand.
    pub probability: f64,
    /// Its parameters.
    pub parameters: Vec<EffectParameter>,
}

/// What kind of answer the verdict is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HypothesisKind {
    /// There is no gap.
    None,
    /// Effects of the catalogue explain the gap.
    Explained,
    /// There is a gap that no effect of the catalogue explains.
    Unexplained,
}

impl HypothesisKind {
    /// The word that files have.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Explained => "explained",
            Self::Unexplained => "unexplained",
        }
    }
}

/// The most probable hypothesis and those that these data cannot tell from it.
#[derive(Clone, Debug)]
pub struct MostProbable {
    /// What kind of answer it is.
    pub kind: HypothesisKind,
    /// The effects named.
    pub effects: Vec<String>,
    /// Whether the named effect has a size that contradicts its prior.
    pub prior_conflict: bool,
    /// Posterior probability of exactly these, with something without a name beside them or not.
    pub probability: f64,
    /// What is left beside the effects, where it is more probable that something is than not.
    pub beside: Option<LeftBeside>,
    /// The verdict and its look-alikes, each a list of effects.
    pub indistinguishable: Vec<Vec<String>>,
    /// The sum of their probabilities.
    pub indistinguishable_probability: f64,
}

/// A departure that none of the list makes, beside the effects of the verdict.
#[derive(Clone, Debug)]
pub struct LeftBeside {
    /// Posterior probability that these effects act and something else does beside them.
    pub probability: f64,
    /// Its most probable form.
    pub form: DepartureForm,
    /// Its share of the gap's mean square.
    pub share_of_gap: f64,
}

/// A hypothesis with its posterior probability.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    /// The effects that act; `None` for "unexplained".
    pub effects: Option<Vec<String>>,
    /// Prior probability.
    pub prior: f64,
    /// Whether it is more probable that a departure which none of the list makes acts beside the effects
    /// than that none does.
    pub beside: bool,
    /// Posterior probability, with such a departure or without.
    pub probability: f64,
    /// Natural logarithm of the evidence (density of the data in the outputs' units).
    pub log_evidence: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Effective number of draws.
    pub effective_sample_size: f64,
    /// Largest logarithm of the likelihood that was found: what a best fit would rank by.
    pub best_log_likelihood: f64,
    /// Number of parameters of the effects.
    pub fitted: usize,
    /// The effects' parameters.
    pub parameters: Vec<EffectParameter>,
}

/// A parameter of an effect after the data.
#[derive(Clone, Debug)]
pub struct EffectParameter {
    /// `effect/parameter`.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Its value in the draw whose prediction is nearest to the mean prediction.
    pub estimate: f64,
    /// Standard deviation of the posterior.
    pub standard_uncertainty: f64,
    /// Coverage interval with equal tails, widened to hold the estimate where it would not.
    pub interval: [f64; 2],
}

/// How far the gap shrinks with the verdict's correction, on data that were not used to fit it.
#[derive(Clone, Debug)]
pub struct Shrinkage {
    /// All outputs together, in standard uncertainties of the data.
    pub all: Shrunk,
    /// Each output, in its unit.
    pub outputs: Vec<Shrunk>,
    /// Coverage interval of the root mean square gap after.
    pub rms_after_interval: [f64; 2],
    /// Posterior expectation of the fraction removed, at the case's conditions.
    pub claimed_fraction: f64,
    /// Whether the gap is large enough (3 standard uncertainties) for a fraction to mean something.
    pub meaningful: bool,
    /// What makes how much of the gap, first what makes most of it; the noise last. Empty where there is
    /// none.
    pub shares: Vec<GapShare>,
    /// Chi-square per degree of freedom before and after.
    pub chi2_per_dof: [f64; 2],
    /// Share of values with |En| at most 1, before and after.
    pub within: [f64; 2],
    /// Gain in the logarithm of the predictive density of data that were left out.
    pub log_density_gain: f64,
    /// How many blocks of conditions were left out in turn; 0 where that was interrupted or where there
    /// is one row only, so that what is after the correction is of the fit to all data.
    pub blocks: usize,
    /// How many values were measured.
    pub values: usize,
}

/// By how much the mean square of the residuals (in standard uncertainties, the inputs at what the data say
/// of them) falls once a part of the verdict is taken out of the data, after those before it.
#[derive(Clone, Debug, PartialEq)]
pub struct GapShare {
    /// Which part.
    pub what: GapPart,
    /// That fall over the mean square with none taken out; for the noise what is left. They sum to 1.
    pub share_of_gap: f64,
}

/// A part of the gap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GapPart {
    /// An effect of the list.
    Effect(String),
    /// A departure that none of them makes.
    Departure,
    /// What is left.
    Noise,
}

impl GapPart {
    /// The effect's name, `departure` or `noise`.
    pub fn name(&self) -> &str {
        match self {
            Self::Effect(name) => name,
            Self::Departure => "departure",
            Self::Noise => "noise",
        }
    }
}

/// Root mean squares before and after a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shrunk {
    /// Of the residuals against the model.
    pub rms_before: f64,
    /// Of the residuals against the corrected model, fitted without the block of each value.
    pub rms_after: f64,
    /// Of the noise alone.
    pub noise_floor: f64,
    /// Fraction of the removable gap that was removed.
    pub removed_fraction: f64,
}

/// What to measure next, and what no measurement can tell.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct NextMeasurements {
    /// Entropy of the posterior probabilities of all hypotheses, in nats: how much there is left to
    /// learn. Composed departures count each for itself.
    pub entropy: f64,
    /// How many composed departures, which are parts of "unexplained", count.
    pub composed: usize,
    /// The verdict and its strongest rival, each a list of effects or `None` for "unexplained"; `None`
    /// where the verdict has no rival.
    pub separates: Option<[Option<Vec<String>>; 2]>,
    /// Measurements, best first.
    pub proposals: Vec<ProposedMeasurement>,
    /// Groups of hypotheses that are the same function of the conditions in the whole reachable
    /// range, so that no measurement of these outputs can tell them apart.
    pub equivalent: Vec<Vec<Vec<String>>>,
    /// Conditions, as places, of which it is not known between which values they can be set: of them
    /// the values of the data count as what can be reached.
    pub without_range: Vec<usize>,
}

/// A measurement that may be worth making.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ProposedMeasurement {
    /// What is to be measured.
    pub kind: ProposalKind,
    /// How often.
    pub count: usize,
    /// By how much the entropy of the posterior probabilities is expected to fall, in nats.
    pub expected_entropy_loss: f64,
    /// After how many of these measurements odds of 20 to 1 for the truth, be it the verdict or its
    /// rival, are as likely as not; `None` where no number of them reaches that.
    pub count_for_20_to_1: Option<usize>,
}

impl ProposedMeasurement {
    /// Once, of which nothing is expected yet.
    pub fn new(kind: ProposalKind) -> Self {
        Self { kind, count: 1, expected_entropy_loss: 0.0, count_for_20_to_1: None }
    }
}

/// What is to be measured. Conditions are in their units.
#[derive(Clone, Debug, PartialEq)]
pub enum ProposalKind {
    /// One row more at conditions among those of the data or between them.
    Row {
        /// Values of the conditions.
        conditions: Vec<f64>,
    },
    /// Several rows at conditions among those of the data or between them.
    Repeats {
        /// Values of the conditions.
        conditions: Vec<f64>,
    },
    /// Rows at reachable conditions that lie outside of those of the data.
    Outside {
        /// Values of the conditions.
        conditions: Vec<f64>,
    },
    /// A calibration of an input.
    Input {
        /// The input, with its unit.
        input: NamedQuantity,
        /// The standard uncertainty that it is to reach, a fifth of what is stated.
        standard_uncertainty: f64,
        /// What is stated.
        stated: f64,
    },
    /// Rows of an output of the model that was not measured.
    Output {
        /// The output, with its unit.
        output: NamedQuantity,
        /// Values of the conditions.
        conditions: Vec<f64>,
        /// The standard uncertainty of one value that is assumed.
        standard_uncertainty: f64,
    },
}

impl ProposalKind {
    /// The word that files have.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Row { .. } => "row",
            Self::Repeats { .. } => "repeats",
            Self::Outside { .. } => "outside",
            Self::Input { .. } => "input",
            Self::Output { .. } => "output",
        }
    }

    /// The conditions, if it has any.
    pub fn conditions(&self) -> Option<&[f64]> {
        match self {
            Self::Row { conditions }
            | Self::Repeats { conditions }
            | Self::Outside { conditions }
            | Self::Output { conditions, .. } => Some(conditions),
            Self::Input { .. } => None,
        }
    }
}

/// A corrected prediction.
#[derive(Clone, Debug)]
pub struct Predicted {
    /// Values of the conditions, in their units.
    pub conditions: Vec<f64>,
    /// For each observed output value and standard uncertainty, in its unit; not numbers where what is
    /// probable has no value.
    pub outputs: Vec<(f64, f64)>,
    /// For each observed output what the model says without a correction.
    pub model: Vec<f64>,
}

/// One row of the data.
#[derive(Clone, Debug)]
pub struct RowGap {
    /// Values of the conditions, in their units.
    pub conditions: Vec<f64>,
    /// For each observed output.
    pub outputs: Vec<ValueGap>,
}

/// One measured value beside the model, before and after the correction, in the output's unit.
#[derive(Clone, Copy, Debug)]
pub struct ValueGap {
    /// Measured value.
    pub measured: f64,
    /// Its standard uncertainty (noise).
    pub u: f64,
    /// Measured value less the model.
    pub before: f64,
    /// Standard uncertainty of that residual: noise and inputs.
    pub u_before: f64,
    /// The validation standard uncertainty (ASME V&V 20-2009, 1): that of the residual before the
    /// correction with the stated uncertainties of the measured value and of the sim, and the inputs;
    /// where none are stated, with the estimated noise.
    pub u_validation: f64,
    /// Measured value less the corrected model that was fitted without its block.
    pub after: f64,
    /// Standard uncertainty of that residual: noise and what was fitted.
    pub u_after: f64,
    /// Measured value less the corrected model that was fitted to all data.
    pub left: f64,
    /// Standard uncertainty of what that corrected model says.
    pub u_corrected: f64,
}

impl ValueGap {
    /// What the sim says.
    pub fn sim(&self) -> f64 {
        self.measured - self.before
    }

    /// The comparison error E = S - D of the sim (ASME V&V 20-2009, 1).
    pub fn comparison_error(&self) -> f64 {
        -self.before
    }

    /// What the corrected sim says; where data were wrapped into a turn, on the side of the measured
    /// value.
    pub fn corrected(&self) -> f64 {
        self.measured - self.left
    }
}

/// What the data say of the noise of an output.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct NoiseEstimate {
    /// Index of the output.
    pub output: usize,
    /// The noise where no uncertainties are stated.
    pub estimated: Option<EstimatedNoise>,
    /// What stated uncertainties are to be multiplied by.
    pub factor: Option<UncertaintyFactor>,
    /// Correlations with the noise of other outputs of the same row.
    pub correlations: Vec<OutputCorrelation>,
    /// Values that may be off, most probable first.
    pub suspects: Vec<SuspectValue>,
    /// Noise that neighbouring rows share.
    pub serial: Option<SerialCorrelation>,
    /// An error that the rows of each setting share.
    pub settings: Option<SettingError>,
}

impl NoiseEstimate {
    /// Of the output with this index, with nothing known of it.
    pub fn new(output: usize) -> Self {
        Self {
            output,
            estimated: None,
            factor: None,
            correlations: Vec::new(),
            suspects: Vec::new(),
            serial: None,
            settings: None,
        }
    }
}

/// Noise that is estimated from the data.
#[derive(Clone, Copy, Debug)]
pub struct EstimatedNoise {
    /// Standard deviation at the model's typical size, in the output's unit.
    pub standard_uncertainty: f64,
    /// Power of the model's size that it grows with: 0 constant, 1 proportional.
    pub power: f64,
}

/// A factor on the stated uncertainties of an output (the Birge ratio, where nothing else is
/// unknown).
#[derive(Clone, Copy, Debug)]
pub struct UncertaintyFactor {
    /// Posterior geometric mean, given that they are off.
    pub estimate: f64,
    /// Coverage interval with equal tails, given that they are off.
    pub interval: [f64; 2],
    /// Probability that they are off, by any factor.
    pub probability: f64,
}

impl UncertaintyFactor {
    /// The factors that are weighed.
    pub const LIMITS: [f64; 2] = noise_model::FAR_FACTORS;

    /// Whether the estimate is as near to a limit as to be decided by it.
    pub fn is_at_limit(&self) -> bool {
        const NEAR: f64 = 1.15;
        let [least, most] = Self::LIMITS;
        self.estimate < least * NEAR || self.estimate * NEAR > most
    }
}

/// The coefficient of correlation of the noise of two outputs of a row.
#[derive(Clone, Copy, Debug)]
pub struct OutputCorrelation {
    /// Index of the other output.
    pub other: usize,
    /// Posterior expectation, given that there is one.
    pub estimate: f64,
    /// Coverage interval with equal tails, given that there is one.
    pub interval: [f64; 2],
    /// Probability that there is one.
    pub probability: f64,
}

/// The coefficient of correlation of the noise of neighbouring rows, in the order of the data.
#[derive(Clone, Copy, Debug)]
pub struct SerialCorrelation {
    /// Posterior expectation, given that there is one.
    pub estimate: f64,
    /// Coverage interval with equal tails, given that there is one.
    pub interval: [f64; 2],
    /// Probability that there is one.
    pub probability: f64,
}

/// An error of each setting, the same in all its rows (JCGM 100, H.5): rows that follow each other with
/// the same value of a condition, or of all of them.
#[derive(Clone, Debug)]
pub struct SettingError {
    /// The condition that is set; `None` for all together.
    pub condition: Option<String>,
    /// Whether each of its values was set once, so that an input with a value for each says the same.
    pub is_per_value: bool,
    /// Its standard deviation in standard uncertainties of a reading, stated or as they are within the
    /// settings: the posterior expectation, given that there is one.
    pub estimate: f64,
    /// Coverage interval with equal tails, given that there is one.
    pub interval: [f64; 2],
    /// The standard deviation in the output's unit.
    pub standard_deviation: f64,
    /// Probability that there is one.
    pub probability: f64,
}

impl SettingError {
    /// The standard deviations that are weighed, in standard uncertainties of a reading.
    pub const LIMITS: [f64; 2] = shared_noise::LIMITS;

    /// Whether the estimate is beyond what is weighed.
    pub fn is_at_limit(&self) -> bool {
        self.estimate > Self::LIMITS[1]
    }
}

/// A measured value that may be off.
#[derive(Clone, Copy, Debug)]
pub struct SuspectValue {
    /// Row of the data, from 0.
    pub row: usize,
    /// Probability that it is off.
    pub probability: f64,
    /// How far it is from what the others let expect, in its standard uncertainties.
    pub size: f64,
}

/// An effect of the list that explains the data with a size that its prior all but excludes.
#[derive(Clone, Debug)]
pub struct PriorConflict {
    /// Name of the effect.
    pub effect: String,
    /// Names of all effects that act together then, itself among them.
    pub effects: Vec<String>,
    /// The parameter, with what the data say of it.
    pub parameter: EffectParameter,
    /// How far the estimate is from the prior: in its standard deviations, or for a bounded prior the
    /// distance beyond the bound in widths of the prior (of its logarithm, if log-uniform).
    pub prior_distance: f64,
    /// Whether the distance is beyond the bound of a bounded prior.
    pub bounded: bool,
    /// How many times wider than stated the priors are with which these effects explain the data.
    pub widened: f64,
    /// Probability that these effects, with wider priors, are the truth.
    pub probability: f64,
}

impl PriorConflict {
    /// What the distance is counted in and from.
    pub fn counted_in(&self) -> Fact {
        if self.bounded { fact!("widths-beyond-bound") } else { fact!("deviations-from-mean") }
    }
}

/// Whether an effect is part of the truth, whatever else is.
#[derive(Clone, Debug)]
pub struct PresentEffect {
    /// Name of the effect.
    pub effect: String,
    /// The sum of the probabilities of the hypotheses that it is part of.
    pub probability: f64,
    /// Its parameters over all of these.
    pub parameters: Vec<EffectParameter>,
}

/// Sizes of effects in each group of rows: for each device or day.
#[derive(Clone, Debug)]
pub struct ReplicatedEffects {
    /// The condition that tells the groups apart.
    pub condition: NamedQuantity,
    /// Its values.
    pub groups: Vec<f64>,
    /// The effects, most probable first.
    pub effects: Vec<ReplicatedEffect>,
}

/// The first parameter of an effect in each group.
#[derive(Clone, Debug)]
pub struct ReplicatedEffect {
    /// Name of the effect.
    pub effect: String,
    /// Probability that it is there with one size for all groups.
    pub probability_shared: f64,
    /// Probability that it is there with a size of each group's own.
    pub probability_own: f64,
    /// Whether the groups differ by ratios: then the spread is that of the logarithm.
    pub by_ratios: bool,
    /// Its size in each group, over all hypotheses that it is part of.
    pub sizes: Vec<EffectParameter>,
    /// Standard deviation of the sizes between groups, if each has its own.
    pub spread: Option<EffectParameter>,
}

/// A form of a departure that no candidate makes.
#[derive(Clone, Debug)]
pub struct DepartureForm {
    /// The outputs that it acts on.
    pub outputs: Vec<String>,
    /// Whether it is added or a share of the sim.
    pub kind: DepartureKind,
    /// Whether all of these outputs have the same function.
    pub common: bool,
    /// What it is a function of.
    pub over: DepartureOver,
    /// What it looks like, for the first of the outputs.
    pub shape: DepartureShape,
    /// The length over which it varies, in the unit of what it is a function of; where that is placed
    /// by its logarithm, the factor. `None` where there is none.
    pub scale: Option<f64>,
    /// Whether the scale is a factor.
    pub logarithmic: bool,
    /// Unit of the scale.
    pub scale_unit: String,
    /// Root mean square of the departure over the conditions of the data, in `unit`; a share of the
    /// sim where it is proportional.
    pub size: f64,
    /// Unit of the size; empty for a share.
    pub unit: String,
    /// The effects of the list that act beside it.
    pub beside: Vec<String>,
    /// Posterior probability; over all forms they sum to that of a departure.
    pub probability: f64,
}

/// Whether a departure is added to a quantity or proportional to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepartureKind {
    /// Added.
    Additive,
    /// A share of the quantity.
    Proportional,
}

impl DepartureKind {
    /// The word that files have.
    pub fn name(self) -> &'static str {
        match self {
            Self::Additive => "additive",
            Self::Proportional => "proportional",
        }
    }
}

/// What a departure is a function of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum DepartureOver {
    /// Nothing: it is constant.
    Nothing,
    /// The condition of that name.
    Condition(String),
    /// The sim's own value of the quantity.
    Value,
    /// All conditions together.
    AllConditions,
}

impl DepartureOver {
    /// It in one word: the condition's name, `value` or `conditions`; `None` where it is constant.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Nothing => None,
            Self::Condition(name) => Some(name),
            Self::Value => Some("value"),
            Self::AllConditions => Some("conditions"),
        }
    }
}

/// What a departure looks like over what it is a function of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepartureShape {
    /// The same everywhere.
    Constant,
    /// A value of its own at each level of the condition.
    Levels,
    /// An error of its own each time that the condition was set, in all readings until the next.
    Settings,
    /// It rises from end to end.
    Rising,
    /// It falls from end to end.
    Falling,
    /// Nearly all of its change lies at one place.
    Step {
        /// The place.
        at: f64,
        /// Whether it rises there.
        up: bool,
    },
    /// It has one maximum within.
    Peak {
        /// The place.
        at: f64,
    },
    /// It has one minimum within.
    Dip {
        /// The place.
        at: f64,
    },
    /// A function of a condition that depends on what follows from the order of the rows.
    Loop,
    /// Anything else.
    Varying,
}

impl DepartureShape {
    /// The word that files have.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Levels => "levels",
            Self::Settings => "settings",
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::Step { .. } => "step",
            Self::Peak { .. } => "peak",
            Self::Dip { .. } => "dip",
            Self::Loop => "loop",
            Self::Varying => "varying",
        }
    }
}

/// Something to bear in mind when the answer is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiagnosisNote {
    /// What was found.
    pub fact: Fact,
}

impl DiagnosisNote {
    /// A short fixed name, such as `far-input`.
    pub fn code(&self) -> &'static str {
        self.fact.code()
    }
}
