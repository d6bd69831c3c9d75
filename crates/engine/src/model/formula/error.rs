//! What can be wrong with a formula: the facts. The sentences stand in `message.rs`.

use std::error::Error;
use std::ops::Range;

pub use super::function::Arity;
use super::scale_fault::ScaleFault;
use gumption_units::{Dimension, UnitError};

/// What is wrong with a formula.
///
/// Places are half-open byte ranges of the formula's text, on character boundaries. `Display` says
/// it in one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FormulaError {
    /// A text without a formula in it.
    Empty,
    /// A text that is too long to be a formula.
    TooLong {
        /// Its length in bytes.
        length: usize,
        /// The largest allowed length in bytes.
        limit: usize,
    },
    /// Too many parentheses, calls, minus signs or powers inside each other.
    TooDeep {
        /// The first one too many.
        span: Range<usize>,
        /// The largest allowed depth.
        limit: usize,
    },
    /// A character that no formula has.
    UnexpectedCharacter {
        /// The character.
        found: char,
        /// Where it stands.
        span: Range<usize>,
        /// How that is written in a formula.
        hint: Option<&'static str>,
        /// What may be meant by it.
        suggestion: Option<String>,
    },
    /// A formula that stops too early.
    UnexpectedEnd {
        /// The place behind its last character; empty.
        span: Range<usize>,
        /// What should stand there, in words.
        expected: &'static str,
        /// The parenthesis that is still open.
        opened: Option<Range<usize>>,
    },
    /// Something that cannot stand where it does.
    UnexpectedToken {
        /// The text of it.
        found: String,
        /// Where it stands.
        span: Range<usize>,
        /// What could stand there, in words.
        expected: &'static str,
        /// How that is written in a formula.
        hint: Option<Box<str>>,
        /// What may be meant by it and what stands before it.
        suggestion: Option<String>,
    },
    /// A number that cannot be read.
    UnreadableNumber {
        /// The number as written.
        text: String,
        /// Where it stands.
        span: Range<usize>,
        /// What is wrong with it.
        fault: NumberFault,
        /// The number that may be meant.
        suggestion: Option<String>,
    },
    /// A second comparison of the same rank, as in `a < b < c`.
    ChainedComparison {
        /// The second comparison's sign.
        span: Range<usize>,
        /// The first one's.
        first: Range<usize>,
    },
    /// The name of a function without parentheses behind it.
    FunctionWithoutArguments {
        /// The function.
        name: String,
        /// Where it stands.
        span: Range<usize>,
        /// The call that may be meant.
        suggestion: String,
    },
    /// A name that nothing defines.
    UnknownName {
        /// The name as written.
        name: String,
        /// Where it stands first.
        span: Range<usize>,
        /// At most three names that may be meant.
        nearest: Vec<String>,
        /// The first names that are defined.
        known: Vec<String>,
    },
    /// A name that is defined only further down, or by this very formula.
    DefinedLater {
        /// The name.
        name: String,
        /// Where it stands first.
        span: Range<usize>,
    },
    /// A complex quantity where only real ones can be.
    Complex {
        /// What is wrong, as a sentence without a capital.
        reason: String,
        /// Where.
        span: Range<usize>,
    },
    /// A calibration function that is called in a wrong way.
    Curve {
        /// What is wrong, as a sentence without a capital.
        reason: String,
        /// Where.
        span: Range<usize>,
    },
    /// A call of a function that does not exist.
    UnknownFunction {
        /// The name as written.
        name: String,
        /// Where it stands.
        span: Range<usize>,
        /// At most three functions that may be meant, or what to write instead.
        nearest: Vec<String>,
    },
    /// A quantity that is called like a function.
    NotAFunction {
        /// The quantity.
        name: String,
        /// Where it stands.
        span: Range<usize>,
    },
    /// A call with too many or too few arguments.
    ArgumentCount {
        /// The function.
        function: &'static str,
        /// Where its name stands.
        span: Range<usize>,
        /// How many arguments it takes.
        expected: Arity,
        /// How many it was given.
        found: usize,
        /// The call that may be meant.
        suggestion: Option<String>,
    },
    /// Two quantities of different dimension that are added, subtracted, compared, or arguments of
    /// one function that takes its arguments together.
    MixedDimensions {
        /// The operator or function.
        operator: &'static str,
        /// Where it stands.
        span: Range<usize>,
        /// The two quantities, the left one first.
        operands: Box<[Operand; 2]>,
    },
    /// A function of plain numbers whose argument has a dimension.
    ArgumentNotPlain {
        /// The function.
        function: &'static str,
        /// Where its name stands.
        function_span: Range<usize>,
        /// The argument.
        argument: Box<Operand>,
    },
    /// `kelvin` or `celsius` of something other than a temperature.
    NotATemperature {
        /// The function.
        function: &'static str,
        /// Where the name of the function stands.
        function_span: Range<usize>,
        /// The argument.
        argument: Box<Operand>,
    },
    /// An exponent that has a dimension.
    ExponentNotPlain {
        /// The exponent.
        exponent: Box<Operand>,
    },
    /// A quantity with a dimension whose exponent is not a rational number written out.
    ExponentNotConstant {
        /// The quantity.
        base: Box<Operand>,
        /// The exponent's text.
        exponent: String,
        /// Where the exponent stands.
        span: Range<usize>,
    },
    /// A text in brackets that is no unit.
    BadUnit {
        /// What stands between the brackets.
        text: String,
        /// Where it stands, with the brackets.
        span: Range<usize>,
        /// What is wrong with it.
        error: Box<UnitError>,
    },
    /// A number with a unit that can be read in two ways.
    TwoReadings {
        /// The text.
        text: String,
        /// Where it stands.
        span: Range<usize>,
        /// The two ways to write what may be meant.
        readings: [String; 2],
    },
    /// A unit in brackets behind something that has a unit.
    NumberWithUnit {
        /// What stands before the unit.
        number: Box<Operand>,
        /// The unit.
        unit: String,
        /// Where both stand.
        span: Range<usize>,
    },
    /// Something that the scale of a quantity does not bear.
    Scale {
        /// What is wrong.
        fault: Box<ScaleFault>,
        /// Where.
        span: Range<usize>,
    },
    /// `table` with one column named and the other not.
    TableColumns {
        /// Where the call stands.
        span: Range<usize>,
    },
    /// A way of interpolation that there is not.
    TableMethod {
        /// The text.
        found: String,
        /// Where it stands.
        span: Range<usize>,
    },
    /// A part that depends on no name and has no finite value.
    ConstantUndefined {
        /// The part.
        part: String,
        /// Whether it is infinite, and not without any value.
        is_infinite: bool,
        /// Where it stands.
        span: Range<usize>,
    },
    /// A unit in brackets where units are not checked, which is another number than the quantities
    /// beside it.
    UncheckedUnit {
        /// The unit in brackets.
        found: String,
        /// A quantity of its dimension.
        name: String,
        /// The unit that this one is the number in.
        unit: String,
        /// Where the brackets, or the number with them, stand.
        span: Range<usize>,
    },
    /// A table in a formula that cannot read files.
    TableOutOfPlace {
        /// The file.
        file: String,
        /// Where the call stands.
        span: Range<usize>,
    },
    /// The abscissa of a table in a unit that it cannot be given in.
    TableArgument {
        /// The abscissa.
        argument: Box<Operand>,
        /// What the table's column is, in words.
        expected: String,
    },
    /// A share that is converted to the unit of an output, which converts it once more.
    ConvertedTwice {
        /// The part of the formula that converts.
        formula: String,
        /// The output whose unit converts as well.
        output: String,
        /// Its unit.
        unit: String,
        /// Where.
        span: Range<usize>,
    },
    /// An argument in a unit, where no unit is said of what it is looked up among.
    UnstatedUnit {
        /// What the two readings are, as a sentence without a capital.
        reason: String,
        /// The argument.
        span: Range<usize>,
    },
    /// Equations to solve inside of equations to solve.
    TooManySolves {
        /// The first one too many.
        span: Range<usize>,
        /// How deep they may be.
        limit: usize,
    },
    /// An unknown with the name of a quantity.
    UnknownIsDefined {
        /// The name.
        name: String,
        /// Where it stands.
        span: Range<usize>,
    },
    /// An unknown that the formula does not have.
    UnknownNotUsed {
        /// The name.
        name: String,
        /// Where it stands.
        span: Range<usize>,
    },
    /// A result whose dimension has exponents that are too large or too fine.
    DimensionOverflow {
        /// The text of the operation.
        text: String,
        /// Where the operation stands.
        span: Range<usize>,
    },
}

/// A part of a formula, and what it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Its text, shortened if it is long.
    pub text: String,
    /// Where it stands.
    pub span: Range<usize>,
    /// Its dimension.
    pub dimension: Dimension,
    /// Whether it is a number written out.
    pub is_number: bool,
    /// Whether it counts degrees Celsius from their zero.
    pub is_celsius: bool,
    /// The unit that its quantity is given in, where it is one alone.
    pub unit: Option<String>,
}

/// What is wrong with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NumberFault {
    /// A decimal comma.
    Comma,
    /// More than one decimal point.
    TwoPoints,
    /// Digits in groups: `1_000`.
    Grouped,
    /// Too large or too small for a number in double precision.
    OutOfRange,
}

impl FormulaError {
    /// Where the mistake is: a half-open byte range of the formula.
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::Empty => 0..0,
            Self::TooLong { length, .. } => 0..*length,
            Self::TooDeep { span, .. }
            | Self::UnexpectedCharacter { span, .. }
            | Self::UnexpectedEnd { span, .. }
            | Self::UnexpectedToken { span, .. }
            | Self::UnreadableNumber { span, .. }
            | Self::ChainedComparison { span, .. }
            | Self::FunctionWithoutArguments { span, .. }
            | Self::UnknownName { span, .. }
            | Self::DefinedLater { span, .. }
            | Self::UnknownFunction { span, .. }
            | Self::Curve { span, .. }
            | Self::Complex { span, .. }
            | Self::NotAFunction { span, .. }
            | Self::ArgumentCount { span, .. }
            | Self::MixedDimensions { span, .. }
            | Self::ExponentNotConstant { span, .. }
            | Self::BadUnit { span, .. }
            | Self::TwoReadings { span, .. }
            | Self::UnstatedUnit { span, .. }
            | Self::ConvertedTwice { span, .. }
            | Self::NumberWithUnit { span, .. }
            | Self::Scale { span, .. }
            | Self::TableColumns { span }
            | Self::TableMethod { span, .. }
            | Self::ConstantUndefined { span, .. }
            | Self::UncheckedUnit { span, .. }
            | Self::TableOutOfPlace { span, .. }
            | Self::TooManySolves { span, .. }
            | Self::UnknownIsDefined { span, .. }
            | Self::UnknownNotUsed { span, .. }
            | Self::DimensionOverflow { span, .. } => span.clone(),
            Self::ArgumentNotPlain { argument, .. } | Self::NotATemperature { argument, .. } => {
                argument.span.clone()
            }
            Self::ExponentNotPlain { exponent } => exponent.span.clone(),
            Self::TableArgument { argument, .. } => argument.span.clone(),
        }
    }

    /// Other places worth underlining, each with a few words on it: both operands of a sum of
    /// unlike quantities, the parenthesis that is still open.
    pub fn labels(&self) -> Vec<(Range<usize>, String)> {
        let of = |operand: &Operand| (operand.span.clone(), operand.dimension.describe());
        match self {
            Self::UnexpectedEnd { opened: Some(opened), .. } => {
                vec![(opened.clone(), "opened here".to_owned())]
            }
            Self::ChainedComparison { first, .. } => {
                vec![(first.clone(), "the first comparison".to_owned())]
            }
            Self::MixedDimensions { operands, .. } => operands.iter().map(of).collect(),
            Self::ArgumentNotPlain { argument, function_span, .. } => {
                vec![(function_span.clone(), "takes a plain number".to_owned()), of(argument)]
            }
            Self::NotATemperature { argument, function_span, .. } => {
                vec![(function_span.clone(), "takes a temperature".to_owned()), of(argument)]
            }
            Self::ExponentNotPlain { exponent } => vec![of(exponent)],
            Self::ExponentNotConstant { base, .. } => vec![of(base)],
            _ => Vec::new(),
        }
    }

    /// What may be meant, as text to write; possibly with what stands beside the place.
    pub fn suggestion(&self) -> Option<String> {
        match self {
            Self::UnexpectedCharacter { suggestion, .. }
            | Self::UnexpectedToken { suggestion, .. }
            | Self::UnreadableNumber { suggestion, .. }
            | Self::ArgumentCount { suggestion, .. } => suggestion.clone(),
            Self::FunctionWithoutArguments { suggestion, .. } => Some(suggestion.clone()),
            Self::UnknownName { nearest, .. } | Self::UnknownFunction { nearest, .. } => {
                nearest.first().cloned()
            }
            Self::NotAFunction { name, .. } => Some(format!("{name}*(")),
            Self::BadUnit { error, .. } => {
                error.suggestions().first().map(|unit| format!("[{unit}]"))
            }
            Self::TwoReadings { readings: [first, _], .. } => Some(first.clone()),
            Self::NumberWithUnit { number, unit, .. } => Some(format!("{}/[{unit}]", number.text)),
            Self::Scale { fault, .. } => fault.suggestion(),
            _ => None,
        }
    }

    /// Whether this is about dimensions, so that it does not matter where units are not checked.
    pub fn is_dimensional(&self) -> bool {
        matches!(
            self,
            Self::MixedDimensions { .. }
                | Self::ArgumentNotPlain { .. }
                | Self::UnstatedUnit { .. }
                | Self::ConvertedTwice { .. }
                | Self::NotATemperature { .. }
                | Self::ExponentNotPlain { .. }
                | Self::ExponentNotConstant { .. }
                | Self::DimensionOverflow { .. }
                | Self::NumberWithUnit { .. }
                | Self::TableArgument { .. }
                | Self::Scale { .. }
        )
    }
}

impl Error for FormulaError {}
