//! Proficiency tests by ISO 13528:2022: an assigned value, the standard deviation for proficiency
//! assessment, and scores of the participants.

use std::fmt;

use super::FACTOR;
use super::robust::{AlgorithmA, FirstScale, SortedValues};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::model::Tolerance;
use gumption_engine::number::Shortest;
use gumption_engine::number::elementary::hypot;

/// The ratio of the standard uncertainty of a robust average to s*/sqrt(p) (ISO 13528:2022, 7.7.3).
const OF_AVERAGE: f64 = 1.25;

/// The assigned value's uncertainty is negligible up to this fraction of the standard deviation for
/// proficiency assessment (ISO 13528:2022, 9.2.1).
const NEGLIGIBLE: f64 = 0.3;

/// Robust estimates of fewer results than this are not reliable (ISO 13528:2022, annex D.1).
const FEW: usize = 12;

/// The modulus of a score from which it gives a warning signal, and an action signal (ISO 13528:2022,
/// 9.4.2).
pub const LIMITS: [f64; 2] = [2.0, 3.0];

/// The result of a participant.
#[derive(Clone, Debug, PartialEq)]
pub struct Participant {
    /// Its name.
    pub label: String,
    /// Its value.
    pub value: f64,
    /// Its uncertainty, if it states one.
    pub uncertainty: Option<StatedUncertainty>,
}

/// The uncertainty that a participant states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedUncertainty {
    /// The expanded uncertainty U, above 0, in the unit of the value.
    pub expanded: f64,
    /// Its coverage factor k, above 0.
    pub factor: f64,
}

impl StatedUncertainty {
    /// The standard uncertainty U/k.
    pub fn standard(self) -> f64 {
        self.expanded / self.factor
    }
}

/// How the assigned value is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AssignedBy {
    /// The robust average of algorithm A (7.7 and C.3).
    AlgorithmA,
    /// The median of the results (C.2).
    Median,
    /// A stated value, in the unit of the results (7.3 to 7.6).
    Stated {
        /// The value.
        value: f64,
        /// Its standard uncertainty, at least 0, if it is known.
        standard_uncertainty: Option<f64>,
    },
}

impl AssignedBy {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::AlgorithmA => "algorithm-a",
            Self::Median => "median",
            Self::Stated { .. } => "stated",
        }
    }
}

/// How the standard deviation for proficiency assessment is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SigmaBy {
    /// The robust standard deviation of algorithm A (8.6 and C.3).
    AlgorithmA,
    /// The normalized interquartile range (8.6 and C.2.3).
    NormalizedIqr,
    /// A stated value above 0, in the unit of the results (8.2 to 8.5).
    Stated(f64),
    /// A fraction above 0 of the modulus of the assigned value.
    ShareOfAssigned(f64),
}

impl SigmaBy {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::AlgorithmA => "algorithm-a",
            Self::NormalizedIqr => "niqr",
            Self::Stated(_) | Self::ShareOfAssigned(_) => "stated",
        }
    }
}

/// What a score says of a result (ISO 13528:2022, 9.4.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// The modulus is at most 2.
    Satisfactory,
    /// The modulus is between 2 and 3.
    Warning,
    /// The modulus is at least 3.
    Action,
}

impl Signal {
    /// What z, z' or zeta says, apart from the rounding of binary fractions.
    pub fn of(score: f64) -> Self {
        let [warning, action] = LIMITS;
        if (Tolerance { lower: None, upper: Some(warning) }).holds(score.abs()) {
            Self::Satisfactory
        } else if (Tolerance { lower: Some(action), upper: None }).holds(score.abs()) {
            Self::Action
        } else {
            Self::Warning
        }
    }

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Satisfactory => "satisfactory",
            Self::Warning => "warning signal",
            Self::Action => "action signal",
        }
    }
}

/// Whether a normalized error is satisfactory: its modulus is at most 1, apart from the rounding of
/// binary fractions (ISO 13528:2022, 9.7).
pub fn is_satisfactory(normalized_error: f64) -> bool {
    Tolerance { lower: None, upper: Some(1.0) }.holds(normalized_error.abs())
}

/// The scores of a participant. Each one has the sign of the deviation, and is `None` if it is not
/// defined.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticipantScores {
    /// The participant's result.
    pub participant: Participant,
    /// The deviation from the assigned value.
    pub deviation: f64,
    /// z, the deviation over the standard deviation for proficiency assessment (9.4).
    pub z: Option<f64>,
    /// z', which includes the uncertainty of the assigned value (9.5).
    pub z_prime: Option<f64>,
    /// Zeta, the deviation over its standard uncertainty (9.6).
    pub zeta: Option<f64>,
    /// En, the deviation over its expanded uncertainty with k = 2 (9.7).
    pub normalized_error: Option<f64>,
}

/// The assigned value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssignedValue {
    /// The value.
    pub value: f64,
    /// Its standard uncertainty; `None` if it is not known.
    pub standard_uncertainty: Option<f64>,
    /// How it was chosen.
    pub by: AssignedBy,
}

/// The evaluation of a proficiency test.
#[derive(Clone, Debug, PartialEq)]
pub struct ProficiencyTest {
    /// The assigned value.
    pub assigned: AssignedValue,
    /// The standard deviation for proficiency assessment; 0 if the results do not scatter.
    pub sigma: f64,
    /// How it was chosen.
    pub sigma_by: SigmaBy,
    /// The scores, in the order of the participants.
    pub rows: Vec<ParticipantScores>,
    /// What is worth knowing.
    pub notes: Vec<Fact>,
}

impl ProficiencyTest {
    /// Whether the assigned value's uncertainty is too large for z, so that z' decides (9.2).
    pub fn is_by_z_prime(&self) -> bool {
        let is_large = |u: f64| u > NEGLIGIBLE * self.sigma;
        self.sigma > 0.0 && self.assigned.standard_uncertainty.is_some_and(is_large)
    }

    /// What the deciding score of a participant says: z', or z if the assigned value's uncertainty
    /// is negligible or not known. `None` without a score.
    pub fn signal(&self, row: &ParticipantScores) -> Option<Signal> {
        let score = if self.is_by_z_prime() { row.z_prime } else { row.z };
        score.map(Signal::of)
    }

    /// Whether no participant has an action signal, and all have a score.
    pub fn is_satisfied(&self) -> bool {
        self.rows.iter().all(|row| self.signal(row).is_some_and(|signal| signal != Signal::Action))
    }
}

/// Why there are no scores.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unscored {
    /// No participant.
    Nobody,
    /// Robust estimates of one result.
    OneResult,
    /// A result with a value or an uncertainty that is not valid.
    Result {
        /// The participant.
        label: String,
    },
    /// A stated number that is not valid.
    Stated {
        /// What it is.
        what: &'static str,
        /// What it must be.
        needed: &'static str,
        /// The number.
        found: f64,
    },
    /// Values whose range is infinite in double precision.
    Range,
    /// Algorithm A does not converge.
    NotConverged,
}

impl fmt::Display for Unscored {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nobody => f.write_str("a proficiency test needs at least one participant"),
            Self::OneResult => f.write_str(
                "one result gives no consensus value and no standard deviation: state both, \
                 `--assigned VALUE --sigma VALUE`",
            ),
            Self::Result { label } => write!(
                f,
                "the result of `{label}` must be a finite number, with an expanded uncertainty and a \
                 coverage factor above 0 if it states an uncertainty"
            ),
            Self::Stated { what, needed, found } => {
                write!(f, "{what} is {}, but must be {needed}", Shortest(*found))
            }
            Self::Range => f.write_str(
                "the results differ by more than double precision can represent: correct the largest \
                 or the smallest one",
            ),
            Self::NotConverged => f.write_str(
                "algorithm A does not converge for these results: choose other robust estimates, \
                 `--assigned median --sigma niqr`, or state the values",
            ),
        }
    }
}

impl std::error::Error for Unscored {}

/// Scores the participants. Without a choice, algorithm A gives the assigned value and the standard
/// deviation, which a note says.
///
/// # Errors
/// No participant; one participant and no stated values; invalid results or stated values; results
/// for which algorithm A does not converge.
pub fn score(
    participants: Vec<Participant>,
    assigned: Option<AssignedBy>,
    sigma: Option<SigmaBy>,
) -> Result<ProficiencyTest, Unscored> {
    if participants.is_empty() {
        return Err(Unscored::Nobody);
    }
    if let Some(wrong) = participants.iter().find(|participant| !is_valid(participant)) {
        return Err(Unscored::Result { label: wrong.label.clone() });
    }
    let mut notes = Vec::new();
    let by = assigned.unwrap_or(AssignedBy::AlgorithmA);
    let sigma_by = sigma.unwrap_or(SigmaBy::AlgorithmA);
    check_stated(by, sigma_by)?;
    let count = participants.len();
    let is_stated = matches!(by, AssignedBy::Stated { .. });
    let is_of_results =
        !is_stated || matches!(sigma_by, SigmaBy::AlgorithmA | SigmaBy::NormalizedIqr);
    if is_of_results && count < 2 {
        return Err(Unscored::OneResult);
    }
    let sorted = SortedValues::of(participants.iter().map(|participant| participant.value));
    let sorted = sorted.ok_or(Unscored::Range)?;
    let needs_algorithm = by == AssignedBy::AlgorithmA || sigma_by == SigmaBy::AlgorithmA;
    let robust =
        needs_algorithm.then(|| sorted.algorithm_a().ok_or(Unscored::NotConverged)).transpose()?;
    if assigned.is_none() {
        notes.push(fact!("assigned-value-chosen"));
    }
    if sigma.is_none() {
        notes.push(fact!("sigma-chosen"));
    }
    let assigned = assigned_value(by, &sorted, robust, count);
    let sigma = match sigma_by {
        SigmaBy::AlgorithmA => robust.map_or(f64::NAN, |robust| robust.standard_deviation),
        SigmaBy::NormalizedIqr => sorted.normalized_iqr(),
        SigmaBy::Stated(sigma) => sigma,
        SigmaBy::ShareOfAssigned(share) => share * assigned.value.abs(),
    };
    let of = assigned.standard_uncertainty;
    let rows = participants.into_iter().map(|participant| {
        let deviation = participant.value - assigned.value;
        let own = participant.uncertainty.map(StatedUncertainty::standard);
        let over =
            |width: Option<f64>| width.filter(|width| *width > 0.0).map(|width| deviation / width);
        let of_difference = own.zip(of).map(|(own, of)| hypot(own, of));
        ParticipantScores {
            deviation,
            z: over(Some(sigma)),
            z_prime: over(of.filter(|_| sigma > 0.0).map(|of| hypot(sigma, of))),
            zeta: over(of_difference),
            normalized_error: over(of_difference.map(|u| FACTOR * u)),
            participant,
        }
    });
    let rows = rows.collect();
    let mut test = ProficiencyTest { assigned, sigma, sigma_by, rows, notes };
    if is_of_results && count < FEW {
        test.notes.push(fact!("few-participants", count, least = FEW));
    }
    if robust.is_some_and(|robust| robust.first_scale == FirstScale::SampleDeviation) {
        test.notes.push(fact!("algorithm-a-first-scale"));
    }
    if sigma <= 0.0 {
        test.notes.push(match sigma_by {
            SigmaBy::ShareOfAssigned(_) => fact!("sigma-zero.share"),
            _ => fact!("sigma-zero"),
        });
    }
    match of {
        None => test.notes.push(fact!("assigned-value-without-uncertainty")),
        Some(of) if test.is_by_z_prime() => {
            let ratio = (of / sigma * 100.0).round() / 100.0;
            test.notes.push(fact!("assigned-uncertainty-large", ratio, limit = NEGLIGIBLE));
        }
        Some(_) => {}
    }
    Ok(test)
}

/// Whether a result has valid numbers.
fn is_valid(participant: &Participant) -> bool {
    let is_width = |width: f64| width > 0.0 && width.is_finite();
    participant.value.is_finite()
        && participant
            .uncertainty
            .is_none_or(|stated| is_width(stated.expanded) && is_width(stated.factor))
}

/// Checks the stated numbers.
fn check_stated(assigned: AssignedBy, sigma: SigmaBy) -> Result<(), Unscored> {
    if let AssignedBy::Stated { value, standard_uncertainty } = assigned {
        if !value.is_finite() {
            let (what, needed) = ("the assigned value", "a finite number");
            return Err(Unscored::Stated { what, needed, found: value });
        }
        if let Some(found) = standard_uncertainty.filter(|u| !(*u >= 0.0 && u.is_finite())) {
            let (what, needed) = ("the standard uncertainty of the assigned value", "at least 0");
            return Err(Unscored::Stated { what, needed, found });
        }
    }
    match sigma {
        SigmaBy::Stated(found) | SigmaBy::ShareOfAssigned(found)
            if !(found > 0.0 && found.is_finite()) =>
        {
            let what = "the standard deviation for proficiency assessment";
            Err(Unscored::Stated { what, needed: "above 0", found })
        }
        _ => Ok(()),
    }
}

/// The assigned value with its uncertainty: 1.25 s*/sqrt(p) for values of the results, with the
/// normalized interquartile range as s* of the median.
fn assigned_value(
    by: AssignedBy,
    sorted: &SortedValues,
    robust: Option<AlgorithmA>,
    count: usize,
) -> AssignedValue {
    let of_scale = |scale: f64| Some(OF_AVERAGE * scale / (count as f64).sqrt());
    let (value, standard_uncertainty) = match by {
        AssignedBy::AlgorithmA => robust.map_or((f64::NAN, None), |robust| {
            (robust.average, of_scale(robust.standard_deviation))
        }),
        AssignedBy::Median => (sorted.median(), of_scale(sorted.normalized_iqr())),
        AssignedBy::Stated { value, standard_uncertainty } => (value, standard_uncertainty),
    };
    AssignedValue { value, standard_uncertainty, by }
}

#[cfg(test)]
mod tests;
