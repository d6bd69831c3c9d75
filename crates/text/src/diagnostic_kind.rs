//! What can be wrong with a user's file: the facts, and the sentence that reports them.

use std::fmt;
use std::sync::Arc;

use super::other_names::other_name;
use super::value_text::with_point;
use gumption_columns::{gravity, heading::OtherUnit};
use gumption_engine::distribution::Invalid;
use gumption_engine::model::formula::{FormulaError, ScaleMisfit};
use gumption_engine::number::{Shortest, of_percent};
use gumption_units::UnitError;
use gumption_units::nearest;

/// The keys of an input that are widths; a width is never 0.
pub const WIDTHS: [&str; 6] = ["std", "expanded", "scale", "half_width", "semi_range", "s"];

/// An error, without its place.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DiagnosticKind {
    /// The file cannot be read.
    Unreadable {
        /// The reason, as a sentence about the file.
        message: String,
    },
    /// A file that may not be read because it lies outside the folder of the file that names it.
    Outside {
        /// Its name, as it is written.
        name: String,
    },
    /// The file has no content.
    Empty,
    /// The text is not JSON.
    NotJson {
        /// The message of the system or the parser.
        message: String,
    },
    /// JSON has no NaN and no infinity.
    NotFiniteInJson,
    /// A number beyond double precision.
    NumberTooLarge,
    /// A value of another type.
    WrongType {
        /// The object concerned, in words.
        what: String,
        /// The value found.
        found: &'static str,
        /// The expected value.
        expected: &'static str,
    },
    /// A value with its uncertainty as a key of an input that has other keys.
    NotAlone {
        /// The key.
        key: String,
        /// The whole input as a text, if there is one that says the same.
        whole: Option<String>,
    },
    /// A key that does not exist here.
    UnknownKey {
        /// The key.
        key: String,
        /// The object concerned, in words.
        what: &'static str,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
        /// The objects of this kind of file that have such a key, in words.
        homes: Vec<&'static str>,
        /// The known names.
        known: Vec<&'static str>,
    },
    /// The same key twice.
    DuplicateKey {
        /// The key.
        key: String,
    },
    /// A required key is not there.
    MissingKey {
        /// The key.
        key: &'static str,
        /// The object concerned, in words.
        what: &'static str,
    },
    /// An input or a component without a distribution.
    NoDistribution {
        /// The object concerned, in words.
        what: &'static str,
        /// The distributions that have all of the object's keys; empty if it has no key of a
        /// distribution.
        fitting: Vec<&'static str>,
    },
    /// A version of the file format that this program does not know.
    UnknownFormat {
        /// The value found.
        found: String,
    },
    /// A file of another kind than the command reads.
    WrongFile {
        /// What it is, in words.
        what: &'static str,
        /// The command that reads it.
        command: &'static str,
    },
    /// Neither a typed model nor equations.
    NoModel,
    /// Both a typed model and equations.
    TwoModels,
    /// No typed model of that name.
    UnknownModel {
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
    },
    /// The typed model has no such input.
    UnknownInput {
        /// The name that is concerned.
        name: String,
        /// The typed model.
        model: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
        /// The known names.
        known: Vec<String>,
    },
    /// The typed model has no such output, or no equation defines it.
    UnknownOutput {
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
        /// The known names.
        known: Arc<[String]>,
    },
    /// The typed model needs an input that is not there.
    MissingInput {
        /// The name that is concerned.
        name: String,
        /// The typed model.
        model: String,
        /// The unit.
        unit: String,
        /// The inputs that the model has.
        known: Vec<String>,
    },
    /// A name that cannot be used.
    BadName {
        /// The name that is concerned.
        name: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// The same name for two quantities.
    NameTaken {
        /// The name that is concerned.
        name: String,
    },
    /// A name that is not that of an input.
    NoSuchInput {
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
    },
    /// A unit that does not parse.
    Unit {
        /// The unit.
        unit: String,
        /// A description of the problem.
        error: UnitError,
    },
    /// A unit of another dimension than the quantity.
    WrongDimension {
        /// The name that is concerned.
        name: String,
        /// The value found.
        found: String,
        /// The quantity that the found unit measures.
        found_as: String,
        /// The quantity that is needed.
        expected_as: String,
        /// The expected value.
        expected: String,
    },
    /// A unit of the right dimension whose scale does not suit the quantity.
    WrongScale {
        /// The name that is concerned.
        name: String,
        /// The unit.
        unit: String,
        /// Why it does not fit.
        misfit: ScaleMisfit,
    },
    /// A value with a unit that cannot be read or converted.
    Value {
        /// The key.
        key: String,
        /// The value found.
        found: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// No distribution of that name.
    UnknownDistribution {
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
        /// The known names.
        known: Vec<&'static str>,
    },
    /// Invalid parameters.
    Distribution {
        /// The name that is concerned.
        name: String,
        /// A description of the problem.
        error: Invalid,
    },
    /// Two keys that exclude each other.
    Exclusive {
        /// The first of the two.
        first: &'static str,
        /// The second of the two.
        second: &'static str,
    },
    /// `expanded` without `k` or `p`.
    NoCoverage {
        /// The name that is concerned.
        name: String,
    },
    /// A key that needs another key, which is missing.
    OnlyWith {
        /// The key.
        key: &'static str,
        /// The missing key.
        with: &'static str,
    },
    /// A probability outside its range.
    NotProbability {
        /// The key.
        key: String,
        /// The value found.
        found: f64,
        /// The upper end of the range from 0.
        below: f64,
    },
    /// A number that must be positive.
    NotPositive {
        /// The key.
        key: String,
        /// The value found.
        found: f64,
    },
    /// Not a whole number, or out of range.
    NotWhole {
        /// The key.
        key: String,
        /// The value found.
        found: String,
        /// The least that is allowed.
        least: u64,
        /// The most that is allowed.
        most: u64,
    },
    /// Not a number of trials.
    NotTrials {
        /// The value found.
        found: String,
        /// The most that is allowed.
        most: u64,
    },
    /// A number out of its range.
    OutOfRange {
        /// The key.
        key: String,
        /// The value found.
        found: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// A value that must be one of a few.
    NotOneOf {
        /// The key.
        key: String,
        /// The value found.
        found: String,
        /// The values that are allowed.
        allowed: Vec<String>,
    },
    /// A width that does not parse.
    Width {
        /// The name that is concerned.
        name: String,
        /// The value found.
        found: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A tolerance with only one limit for a periodic output.
    OneLimitOfPeriod {
        /// The output.
        name: String,
        /// The missing limit.
        missing: &'static str,
        /// A turn, with its unit.
        turn: String,
    },
    /// A component without a name, or with the name of another.
    Component {
        /// The name that is concerned.
        name: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A formula's error.
    Formula {
        /// A description of the problem.
        error: FormulaError,
    },
    /// An estimate's formula with an input that is not known exactly.
    EstimateOfInput {
        /// The input.
        name: String,
    },
    /// A name in the formula of a value that may use conditions and constants, of which there are none.
    NothingToUse {
        /// The name in the formula.
        name: String,
    },
    /// An estimate's formula with a constant that is a formula of more than constants.
    EstimateOfFormula {
        /// The constant.
        name: String,
    },
    /// An estimate's formula that gives no finite number.
    EstimateUndefined {
        /// The row, from 1.
        row: usize,
        /// The value found.
        found: f64,
    },
    /// A condition or list without values.
    NoValues {
        /// The name that is concerned.
        name: String,
    },
    /// A range of a condition that is not two increasing values.
    ConditionRange {
        /// The condition.
        name: String,
        /// The value found.
        found: Vec<f64>,
    },
    /// A condition that has no values of its own and no table to take them from.
    NoTable {
        /// The name that is concerned.
        name: String,
    },
    /// A table's cell that is empty or not a number.
    Cell {
        /// The row, from 1.
        row: usize,
        /// The column.
        column: String,
        /// The value found.
        found: String,
    },
    /// A table's row with another number of cells than the header.
    ShortRow {
        /// The row, from 1.
        row: usize,
        /// The value found.
        found: usize,
        /// The expected value.
        expected: usize,
    },
    /// A line of a file of samples that is not a number.
    Sample {
        /// The value found.
        found: String,
    },
    /// A column whose heading has another unit than its values are read in.
    ColumnUnit(OtherUnit),
    /// A table without rows, or a bad header.
    Table {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A coefficient out of range, of unknown or equal quantities.
    Correlation {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A calibration function that cannot be fitted, or points that cannot be read.
    Fit {
        /// The function, or the coordinate.
        name: String,
        /// Why, as a sentence without a capital.
        reason: String,
    },
    /// A complex quantity that is not written as one, or that is not allowed here.
    Complex {
        /// The quantity.
        name: String,
        /// Why, as the rest of the sentence.
        reason: String,
    },
    /// A coverage region that cannot be computed.
    Region {
        /// Why, as a sentence without a capital.
        reason: String,
    },
    /// Too many rows, inputs, nodes.
    TooMany {
        /// The object concerned, in words.
        what: &'static str,
        /// The value found.
        found: usize,
        /// The most that is allowed.
        most: usize,
    },
    /// A saved result that was changed since it was written.
    SavedChanged {
        /// The keys that lead to the changed part; `None` if that is unknown.
        part: Option<String>,
    },
    /// A file that `--save` did not write.
    NotResult {
        /// The file.
        file: String,
    },
    /// A result file has no such output.
    NoSuchResult {
        /// The file.
        file: String,
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
        /// The known names.
        known: Vec<String>,
    },
    /// A list of a result file whose entries do not fit.
    SavedEntry {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A saved result and an input whose units have different zeros: degC and K, degC and degF, dBm
    /// and dBW.
    SavedZero {
        /// The name that is concerned.
        name: String,
        /// The value found.
        found: String,
        /// The unit of the saved result.
        saved: String,
    },
    /// A declared correlation coefficient between inputs whose saved results already have one.
    SavedCorrelation {
        /// The first of the two.
        first: String,
        /// The second of the two.
        second: String,
    },
    /// More errors than are listed.
    MoreMistakes {
        /// The most that is allowed.
        most: usize,
    },
    /// A model file with several rows of conditions, to be compared with a saved result.
    SeveralRows {
        /// The number of rows.
        rows: usize,
    },
    /// Values with which the evaluation cannot continue.
    Evaluation {
        /// The message of the system or the parser.
        message: String,
    },
    /// The catalogue has no effect of that name.
    UnknownEffect {
        /// The name that is concerned.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<String>,
    },
    /// An effect that cannot act on the sim.
    Effect {
        /// The name that is concerned.
        name: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// Observations without information about the sim, or observations that contradict each other.
    Observation {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A simulator that does not fit the file.
    Simulator {
        /// What is wrong, as a part of the sentence.
        reason: String,
    },
    /// The cost of improving an input, in an invalid form.
    Cost {
        /// Why, as a sentence without a capital.
        reason: String,
    },
    /// Prior probabilities that do not sum to one.
    Prior {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// Something in a certificate file that does not fit.
    Certificate {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// Not a day of the calendar.
    NotDate {
        /// The key.
        key: &'static str,
        /// The value found.
        found: String,
    },
    /// A recipe whose parts do not fit.
    Recipe {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// A recording that cannot be used, with its line or sample and channel.
    Recording {
        /// Why, as a part of the sentence.
        reason: String,
    },
    /// An override of the command line that does not fit.
    Override {
        /// The replacement as it is written.
        text: String,
        /// Why, as a part of the sentence.
        reason: String,
    },
}

impl DiagnosticKind {
    /// A short fixed identifier of this kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "unreadable",
            Self::Outside { .. } => "outside",
            Self::Empty => "empty",
            Self::NotJson { .. } => "not-json",
            Self::NotFiniteInJson => "not-finite",
            Self::NumberTooLarge => "number-too-large",
            Self::WrongType { .. } | Self::NotAlone { .. } => "wrong-type",
            Self::UnknownKey { .. } => "unknown-key",
            Self::DuplicateKey { .. } => "duplicate-key",
            Self::MissingKey { .. } | Self::NoDistribution { .. } => "missing-key",
            Self::UnknownFormat { .. } => "unknown-format",
            Self::NoModel => "no-model",
            Self::TwoModels => "two-models",
            Self::UnknownModel { .. } => "unknown-model",
            Self::UnknownInput { .. } => "unknown-input",
            Self::UnknownOutput { .. } => "unknown-output",
            Self::MissingInput { .. } => "missing-input",
            Self::BadName { .. } => "bad-name",
            Self::NameTaken { .. } => "name-taken",
            Self::NoSuchInput { .. } => "no-such-input",
            Self::Unit { .. } => "bad-unit",
            Self::WrongDimension { .. } => "wrong-dimension",
            Self::WrongScale { .. } => "wrong-scale",
            Self::WrongFile { .. } => "wrong-file",
            Self::Value { .. } => "bad-value",
            Self::UnknownDistribution { .. } => "unknown-distribution",
            Self::Distribution { .. } => "bad-distribution",
            Self::Exclusive { .. } => "exclusive-keys",
            Self::NoCoverage { .. } => "no-coverage",
            Self::OnlyWith { .. } => "only-with",
            Self::NotProbability { .. } => "not-a-probability",
            Self::NotPositive { .. } => "not-positive",
            Self::NotWhole { .. } => "not-whole",
            Self::NotTrials { .. } => "bad-trials",
            Self::OutOfRange { .. } => "out-of-range",
            Self::NotOneOf { .. } => "not-one-of",
            Self::Width { .. } => "bad-width",
            Self::OneLimitOfPeriod { .. } => "one-limit-of-period",
            Self::Component { .. } => "bad-component",
            Self::Formula { .. } => "bad-formula",
            Self::EstimateOfInput { .. } => "estimate-of-input",
            Self::NothingToUse { .. } => "bad-formula",
            Self::EstimateOfFormula { .. } => "estimate-of-formula",
            Self::EstimateUndefined { .. } => "estimate-undefined",
            Self::NoValues { .. } => "no-values",
            Self::ConditionRange { .. } => "bad-range",
            Self::NoTable { .. } => "no-table",
            Self::Cell { .. } => "bad-cell",
            Self::ShortRow { .. } => "short-row",
            Self::Sample { .. } => "bad-sample",
            Self::ColumnUnit(_) => "column-unit",
            Self::Table { .. } => "bad-table",
            Self::Correlation { .. } => "bad-correlation",
            Self::Complex { .. } => "bad-complex",
            Self::Fit { .. } => "bad-fit",
            Self::Region { .. } => "bad-region",
            Self::TooMany { .. } => "too-many",
            Self::MoreMistakes { .. } => "more-mistakes",
            Self::SavedChanged { .. } => "changed-result",
            Self::NotResult { .. } => "not-a-result",
            Self::NoSuchResult { .. } => "no-such-result",
            Self::SavedEntry { .. } => "bad-result",
            Self::SavedZero { .. } => "celsius-result",
            Self::SavedCorrelation { .. } => "correlated-results",
            Self::SeveralRows { .. } => "several-rows",
            Self::Evaluation { .. } => "evaluation",
            Self::UnknownEffect { .. } => "unknown-effect",
            Self::Effect { .. } => "bad-effect",
            Self::Observation { .. } => "bad-observations",
            Self::Simulator { .. } => "bad-simulator",
            Self::Cost { .. } => "bad-cost",
            Self::Prior { .. } => "bad-prior",
            Self::Certificate { .. } => "bad-certificate",
            Self::NotDate { .. } => "not-a-date",
            Self::Recipe { .. } => "bad-recipe",
            Self::Recording { .. } => "bad-recording",
            Self::Override { .. } => "bad-override",
        }
    }

    /// The same error for the value of another key.
    #[must_use]
    pub fn of_key(mut self, of: &str) -> Self {
        if let Self::WrongDimension { name, .. }
        | Self::WrongScale { name, .. }
        | Self::Value { key: name, .. } = &mut self
        {
            of.clone_into(name);
        }
        self
    }

    /// What to write instead, if that is known.
    pub fn suggestion(&self) -> Option<String> {
        match self {
            Self::UnknownKey { key, known, .. }
                if other_name(key, known).is_some_and(|other| !other.is_same) =>
            {
                None
            }
            Self::UnknownKey { nearest, .. }
            | Self::UnknownModel { nearest, .. }
            | Self::UnknownInput { nearest, .. }
            | Self::UnknownOutput { nearest, .. }
            | Self::UnknownEffect { nearest, .. }
            | Self::NoSuchInput { nearest, .. }
            | Self::NoSuchResult { nearest, .. }
            | Self::UnknownDistribution { nearest, .. } => nearest.clone(),
            Self::NotOneOf { found, allowed, .. } => {
                nearest(found, allowed.iter().map(String::as_str)).map(str::to_owned)
            }
            Self::Unit { unit, error } => {
                error.in_whole(unit).suggestions().first().map(|s| (*s).to_owned())
            }
            Self::Formula { error } => error.suggestion(),
            Self::NotProbability { found, .. } => {
                of_percent(*found).map(|meant| Shortest(meant).to_string())
            }
            _ => None,
        }
    }
}

/// `a`, `b`, `c`
fn list<S: AsRef<str>>(names: &[S]) -> String {
    let quoted = names.iter().map(|n| format!("`{}`", n.as_ref()));
    let mut list = quoted.take(LONGEST_LIST).collect::<Vec<_>>().join(", ");
    if names.len() > LONGEST_LIST {
        list.push_str(&format!(" and {} more", names.len() - LONGEST_LIST));
    }
    list
}

/// The maximum number of names listed in a message.
const LONGEST_LIST: usize = 30;

/// How the program treats an uncertainty of 0.
pub(crate) const WITHOUT_UNCERTAINTY: &str = "; a quantity without an uncertainty has the distribution `constant`, and a component without \
     one is left out";

/// "1 cell", "2 cells"
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// "; did you mean `x`?" or the list of what there is.
fn hint(nearest: Option<&String>, known: &str) -> String {
    if nearest.is_some() { meant(nearest) } else { format!("; there are {known}") }
}

/// The nearest known name, if there is one.
fn meant(nearest: Option<&String>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

impl fmt::Display for DiagnosticKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { message } => f.write_str(message),
            Self::Outside { name } => write!(
                f,
                "`{name}` is outside the folder of this file; a file may name only files below its \
                 own folder"
            ),
            Self::Empty => f.write_str(
                "the file is empty; a model file is a JSON object with `inputs`, `outputs` and \
                 `equations` or `model`",
            ),
            Self::NotJson { message } => write!(f, "this is not JSON: {message}"),
            Self::NotFiniteInJson => {
                f.write_str("NaN and infinity are not JSON numbers; write a finite number")
            }
            Self::NumberTooLarge => {
                f.write_str("this number is larger than any in double precision (1.8e308)")
            }
            Self::WrongType { what, found, expected } => match *found {
                // as a field of a form that is not filled in
                "null" => write!(f, "{what} is empty (null), but must be {expected}"),
                _ => write!(f, "{what} is {found}, but must be {expected}"),
            },
            Self::NotAlone { key, whole } => {
                write!(
                    f,
                    "`{key}` is a value with its uncertainty, but must be the estimate alone"
                )?;
                match whole {
                    Some(whole) => write!(f, "; write `{whole}` instead of the object"),
                    None => Ok(()),
                }
            }
            Self::UnknownKey { key, what, nearest, homes, known } => {
                write!(f, "unknown key `{key}` in {what}")?;
                if let Some(other) = other_name(key, known) {
                    return write!(f, "; {}", other.said);
                }
                if homes.is_empty() || nearest.is_some() {
                    f.write_str(&hint(nearest.as_ref(), &list(known)))?;
                }
                if homes.is_empty() {
                    return Ok(());
                }
                let begin = if nearest.is_some() { " It" } else { "; it" };
                write!(f, "{begin} is a key of {}", homes.join(" and of "))
            }
            Self::DuplicateKey { key } => write!(f, "the key `{key}` occurs twice; remove one"),
            Self::MissingKey { key, what } => write!(f, "{what} needs the key `{key}`"),
            Self::NoDistribution { what, fitting } => {
                write!(f, "{what} needs the key `distribution`")?;
                match fitting.as_slice() {
                    [] => f.write_str(", such as `\"distribution\": \"rectangular\"`"),
                    [only] => write!(f, "; its keys are those of `\"distribution\": \"{only}\"`"),
                    several => write!(f, "; its keys are those of {}", list(several)),
                }
            }
            Self::UnknownFormat { found } => {
                write!(
                    f,
                    "file format {found} is not known; this version reads `\"format\": 1` and `2`"
                )
            }
            Self::WrongFile { what, command } => {
                write!(f, "this is {what}, which `{command}` reads")
            }
            Self::NoModel => f.write_str(
                "a model file needs `equations` (formulas) or `model` (the name of a typed model)",
            ),
            Self::TwoModels => {
                f.write_str("a model file has either `equations` or `model`, not both; remove one")
            }
            Self::UnknownModel { name, nearest } => {
                write!(f, "there is no typed model `{name}`{}", meant(nearest.as_ref()))
            }
            Self::UnknownInput { name, model, nearest, known } => write!(
                f,
                "the model `{model}` has no input `{name}`{}{}",
                hint(nearest.as_ref(), &list(known)),
                nearest
                    .as_ref()
                    .map_or_else(String::new, |_| format!(" There are {}", list(known)))
            ),
            Self::UnknownOutput { name, nearest, known } => {
                write!(
                    f,
                    "nothing computes an output `{name}`{}",
                    hint(nearest.as_ref(), &list(known))
                )
            }
            Self::MissingInput { name, model, unit, known } => write!(
                f,
                "the model `{model}` needs the input `{name}` (unit `{unit}`), which is missing; \
                 its inputs are {}",
                list(known)
            ),
            Self::BadName { name, reason } => write!(f, "`{name}` cannot be a name: {reason}"),
            Self::NameTaken { name } => {
                write!(f, "the name `{name}` is already used for another quantity of this file")
            }
            Self::NoSuchInput { name, nearest } => {
                write!(f, "there is no input `{name}` in this file")?;
                match nearest {
                    Some(near) => write!(f, "; did you mean `{near}`?"),
                    None => f.write_str("; a component is named `input/component`"),
                }
            }
            Self::Unit { unit, error } => {
                write!(f, "the unit `{unit}` cannot be read: {}", error.in_whole(unit))
            }
            // levels and ratios have the same dimension
            Self::WrongDimension { name, found, found_as, expected, expected_as }
                if found_as == expected_as && (found.contains("dB") || found.contains("Np")) =>
            {
                write!(
                    f,
                    "`{name}` has the unit `{found}`, but must be {expected_as} such as \
                     `{expected}`; for a level L in dB the ratio of amplitudes is 10^(L/20), the \
                     ratio of powers 10^(L/10)"
                )
            }
            Self::WrongDimension { name, found, found_as, expected, expected_as } => write!(
                f,
                "`{name}` has the unit `{found}`, {found_as}, but must be {expected_as}, such as \
                 `{expected}`{}",
                gravity::hint_of(found, expected)
            ),
            Self::WrongScale { name, unit, misfit } => {
                write!(f, "`{name}` cannot be given in `{unit}`: it {misfit}")
            }
            Self::Value { key, found, reason } => {
                write!(f, "the value `{found}` of `{key}` cannot be used: {reason}")
            }
            Self::UnknownDistribution { name, nearest, known } => {
                write!(
                    f,
                    "there is no distribution `{name}`{}",
                    hint(nearest.as_ref(), &list(known))
                )
            }
            Self::Distribution { name, error } => write!(f, "`{name}`: {error}"),
            Self::Exclusive { first, second } => {
                write!(f, "`{first}` and `{second}` exclude each other; remove one")
            }
            Self::NoCoverage { name } => write!(
                f,
                "`{name}` gives an expanded uncertainty, which needs its coverage factor `k` or its \
                 coverage probability `p`"
            ),
            Self::OnlyWith { key, with } => {
                write!(f, "`{key}` needs the key `{with}`, which is missing")
            }
            Self::NotProbability { key, found, below } => {
                let (number, below) = (Shortest(*found), Shortest(*below));
                write!(f, "`{key}` is {number}, but must be a probability between 0 and {below}")?;
                let meant = of_percent(*found).map(Shortest);
                meant.map_or(Ok(()), |meant| write!(f, "; did you mean {meant}?"))
            }
            Self::NotPositive { key, found } => {
                write!(f, "`{key}` is {}, but must be above zero", Shortest(*found))?;
                let is_none = *found == 0.0 && WIDTHS.contains(&key.as_str());
                if is_none { f.write_str(WITHOUT_UNCERTAINTY) } else { Ok(()) }
            }
            Self::NotWhole { key, found, least, most } => {
                write!(f, "`{key}` is {found}, but must be a whole number from {least} to {most}")
            }
            Self::NotTrials { found, most } => write!(
                f,
                "{found} is not a number of trials; a whole number from 2 to {most} is, or 0 for an \
                 evaluation by the law of propagation alone"
            ),
            Self::OutOfRange { key, found, range } => {
                write!(f, "`{key}` is {}, but must be {range}", Shortest(*found))
            }
            Self::NotOneOf { key, found, allowed } => {
                write!(f, "`{key}` is `{found}`, but must be one of {}", list(allowed))
            }
            Self::Width { name, found, reason } => {
                write!(f, "`{name}`: the width `{found}` cannot be read: {reason}")
            }
            Self::OneLimitOfPeriod { name, missing, turn } => write!(
                f,
                "the `tolerance` of `{name}` also needs `{missing}`: its values repeat after \
                 {turn} (`periodic`), so that a single limit does not divide them"
            ),
            Self::Component { name, reason } => write!(f, "a component of `{name}` {reason}"),
            Self::Formula { error } => error.fmt(f),
            Self::EstimateOfInput { name } => write!(
                f,
                "`{name}` has an uncertainty, but an estimate may depend only on conditions, \
                 constants, and inputs with the distribution `constant`; write the formula with \
                 `{name}` as one of the `equations`"
            ),
            Self::NothingToUse { name } => write!(
                f,
                "`{name}` is not defined; a formula here may use conditions and constants, and there \
                 are none yet"
            ),
            Self::EstimateOfFormula { name } => write!(
                f,
                "`{name}` is itself a formula of more than constants; write that formula here \
                 instead, or a formula with `{name}` as one of the `equations`"
            ),
            Self::EstimateUndefined { row, found } => {
                write!(f, "this estimate is {found} in row {row} of the conditions")
            }
            Self::NoValues { name } => write!(f, "`{name}` has no values; at least one is needed"),
            Self::ConditionRange { name, found } => {
                let found: Vec<String> = found.iter().map(|v| Shortest(*v).to_string()).collect();
                write!(
                    f,
                    "the range of the condition `{name}` is [{}], but must be two values, the lower \
                     one first: `[1, 500]`",
                    found.join(", ")
                )
            }
            Self::NoTable { name } => write!(
                f,
                "the condition `{name}` has no `values`; it would name a column of observations, \
                 but the file has none"
            ),
            Self::Cell { row, column, found } if found.is_empty() => {
                write!(f, "row {row}, column `{column}`: the cell is empty; a number is needed")
            }
            Self::Cell { row, column, found } => {
                write!(f, "row {row}, column `{column}`: `{found}` is not a finite number")
            }
            Self::ShortRow { row, found, expected } => {
                let (found, expected) = (counted(*found, "cell"), counted(*expected, "name"));
                write!(f, "row {row} has {found}, but the header has {expected}")
            }
            Self::Sample { found } => {
                if let Some(point) = with_point(found) {
                    return write!(
                        f,
                        "`{found}` is not a number: write a decimal fraction with a point, \
                         `{point}`"
                    );
                }
                write!(
                    f,
                    "`{found}` is not a finite number; a file of samples has one number on each \
                     line, and `#` before remarks"
                )
            }
            Self::ColumnUnit(found) => found.fmt(f),
            Self::Table { reason }
            | Self::Cost { reason }
            | Self::Observation { reason }
            | Self::Prior { reason } => f.write_str(reason),
            Self::Simulator { reason } => write!(f, "the simulator {reason}"),
            Self::UnknownEffect { name, nearest } => {
                write!(f, "the catalogue has no effect `{name}`{}", meant(nearest.as_ref()))
            }
            Self::Effect { name, reason } => write!(f, "the effect `{name}` {reason}"),
            Self::Correlation { reason } => f.write_str(reason),
            Self::Fit { name, reason } => write!(f, "`{name}`: {reason}"),
            Self::Region { reason } => f.write_str(reason),
            Self::Complex { name, reason } => write!(f, "`{name}` {reason}"),
            // more than can be counted, or more than were counted
            Self::TooMany { what, found: usize::MAX, most } => {
                write!(f, "there are more than {most} {what}, the most that this version reads")
            }
            Self::TooMany { what, found, most } => {
                write!(f, "there are {found} {what}; this version reads at most {most}")
            }
            Self::SavedChanged { part: Some(part) } => {
                write!(f, "`{part}` was changed after the result was saved; save it again")
            }
            Self::SavedChanged { part: None } => f.write_str(
                "this result was changed after it was saved, but not in a part that can be named; \
                 save it again",
            ),
            Self::NotResult { file } => {
                write!(f, "`{file}` is not a saved result (`\"result\": true` is missing)")
            }
            Self::NoSuchResult { file, name, nearest, known } => {
                let hint = hint(nearest.as_ref(), &list(known));
                write!(f, "the saved result `{file}` has no output `{name}`{hint}")
            }
            Self::SavedEntry { reason } => f.write_str(reason),
            Self::SavedZero { name, found, saved } => write!(
                f,
                "the saved result `{name}` is in `{saved}`, the input in `{found}`; these units \
                 have different zeros, and a saved result is never shifted; use the unit of the \
                 result"
            ),
            Self::SavedCorrelation { first, second } => write!(
                f,
                "the correlation of `{first}` and `{second}` follows from their saved results; \
                 remove the declared coefficient"
            ),
            Self::MoreMistakes { most } => {
                write!(f, "there are more errors; the first {most} are listed")
            }
            Self::SeveralRows { rows } => write!(
                f,
                "this file has {rows} rows of conditions, but a saved result has one row; compare \
                 it with a file that has only this row"
            ),
            Self::Evaluation { message } => f.write_str(message),
            Self::Certificate { reason } | Self::Recipe { reason } | Self::Recording { reason } => {
                f.write_str(reason)
            }
            Self::NotDate { key, found } => {
                write!(f, "`{key}` is `{found}`, but must be a day such as 2026-03-02")
            }
            Self::Override { text, reason } => write!(f, "the replacement `{text}`: {reason}"),
        }
    }
}
