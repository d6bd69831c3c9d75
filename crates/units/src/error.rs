//! What can be wrong with the text of a unit.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use super::dimension::Dimension;
use super::listed::listed;

/// Why a text is not a unit.
///
/// Every variant carries the position (`span`, a half-open byte range inside the unit text, on
/// character boundaries), what was found there, and if possible what would be right. `Display` says
/// it in one sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnitError {
    /// A name that is neither a unit nor a prefix and a unit.
    UnknownUnit {
        /// The name as written.
        name: String,
        /// Its span.
        span: Range<usize>,
        /// At most three unit texts that may be meant, most likely first; each of them parses.
        nearest: Vec<String>,
    },
    /// A name that describes the quantity besides its unit: `barg`, `Vpp`, `Nm3`, `dB(A)`.
    QualifiedUnit {
        /// The name as written.
        name: String,
        /// Its span.
        span: Range<usize>,
        /// The unit: `bar`.
        unit: String,
        /// What the name says about the quantity: `a peak-to-peak value`.
        says: &'static str,
    },
    /// A prefix before a unit that takes none: `mdegC`, `kmin`, `mkg`.
    PrefixNotAllowed {
        /// The prefix as written.
        prefix: String,
        /// The unit after it.
        unit: String,
        /// The span of both.
        span: Range<usize>,
        /// What to write instead: `mK`, `1e-3*deg`.
        instead: String,
    },
    /// A character that is not allowed at its position.
    UnexpectedCharacter {
        /// The character.
        found: char,
        /// Its span.
        span: Range<usize>,
        /// What would be allowed there, in words.
        expected: &'static str,
        /// What the surrounding text may mean: `m^-3` for `m-3`.
        suggestion: Option<String>,
    },
    /// An operator, root or pair of parentheses without the unit or number that it applies to.
    MissingFactor {
        /// The operator as written: `/`, `()`.
        operator: String,
        /// Its span.
        span: Range<usize>,
        /// The side on which something is missing, or inside.
        side: MissingSide,
    },
    /// A parenthesis that is opened but not closed, or closed but not opened.
    UnbalancedParenthesis {
        /// `(` or `)`.
        found: char,
        /// Its span.
        span: Range<usize>,
    },
    /// An exponent that is not a whole number, a decimal number or a fraction in parentheses.
    ExponentNotANumber {
        /// The text found instead; empty if there is none.
        found: String,
        /// The span of that text; of the power operator if there is none.
        span: Range<usize>,
    },
    /// An exponent beyond the limits.
    ExponentTooLarge {
        /// The exponent, or the whole power if only the resulting dimension is out of range.
        found: String,
        /// Its span.
        span: Range<usize>,
        /// The largest allowed exponent, in absolute value; for a denominator
        /// [`Unit::MAX_EXPONENT`](super::Unit::MAX_EXPONENT).
        limit: u32,
    },
    /// A whole exponent followed by a division by a small number, as in `Hz^1/2`: half a hertz, or
    /// its square root?
    AmbiguousPower {
        /// The exponent and the division.
        span: Range<usize>,
        /// The same as a fraction: `Hz^(1/2)`.
        as_root: String,
        /// The same as a division: `(Hz^1)/2`.
        as_quotient: String,
    },
    /// A product written with a space or a dot after a quotient, as in `J/kg K`: joule per kilogram
    /// and kelvin, or kelvin times joule per kilogram? Or a space inside a symbol, as in `° C`:
    /// degree Celsius, or degree times coulomb?
    AmbiguousProduct {
        /// The ambiguous text.
        found: String,
        /// Its span.
        span: Range<usize>,
        /// The more likely reading: `J/(kg K)`, `degC`.
        likelier: String,
        /// The other one: `(J/kg) K`, `deg*C`.
        other: String,
    },
    /// A number or a fraction in parentheses after a unit without an operator, as in `V (23)`,
    /// `ohm (0.1 %)`: an uncertainty, a coverage, or a factor?
    NumberInParentheses {
        /// The parentheses with their content.
        found: String,
        /// Their span.
        span: Range<usize>,
    },
    /// A factor that is zero, or too large or too small for an `f64`.
    FactorOutOfRange {
        /// What has that factor.
        span: Range<usize>,
    },
    /// A text that is too long to be a unit.
    TooLong {
        /// Its length in bytes.
        length: usize,
        /// The largest allowed length in bytes.
        limit: usize,
    },
    /// Too many parentheses or roots inside each other.
    NestedTooDeep {
        /// The first one beyond the limit.
        span: Range<usize>,
        /// The largest allowed depth.
        limit: usize,
    },
}

/// The side of an operator on which its unit or number is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MissingSide {
    /// Before it.
    Before,
    /// After it.
    After,
    /// Inside it, for a pair of parentheses.
    Inside,
}

impl UnitError {
    /// Where in the unit text the error lies: a half-open byte range on character boundaries.
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::UnknownUnit { span, .. }
            | Self::QualifiedUnit { span, .. }
            | Self::PrefixNotAllowed { span, .. }
            | Self::UnexpectedCharacter { span, .. }
            | Self::MissingFactor { span, .. }
            | Self::UnbalancedParenthesis { span, .. }
            | Self::ExponentNotANumber { span, .. }
            | Self::ExponentTooLarge { span, .. }
            | Self::AmbiguousPower { span, .. }
            | Self::AmbiguousProduct { span, .. }
            | Self::NumberInParentheses { span, .. }
            | Self::FactorOutOfRange { span }
            | Self::NestedTooDeep { span, .. } => span.clone(),
            Self::TooLong { length, .. } => 0..*length,
        }
    }

    /// Unit texts that may be meant, most likely first; possibly none.
    pub fn suggestions(&self) -> Vec<&str> {
        match self {
            Self::UnknownUnit { nearest, .. } => nearest.iter().map(String::as_str).collect(),
            Self::QualifiedUnit { unit, .. } => vec![unit],
            Self::PrefixNotAllowed { instead, .. } => vec![instead],
            Self::UnexpectedCharacter { suggestion, .. } => {
                suggestion.iter().map(String::as_str).collect()
            }
            Self::AmbiguousPower { as_root, as_quotient, .. } => vec![as_root, as_quotient],
            Self::AmbiguousProduct { likelier, other, .. } => vec![likelier, other],
            _ => Vec::new(),
        }
    }

    /// The same error, found in `text`. Its suggestions are the whole text with the wrong part
    /// corrected: `kg/m^3` for `kg/m3`, for which [`suggestions`](Self::suggestions) says `m^3`.
    #[must_use]
    pub fn in_whole(&self, text: &str) -> Self {
        let whole = |span: &Range<usize>, part: &str| {
            let (Some(before), Some(behind)) = (text.get(..span.start), text.get(span.end..))
            else {
                return part.to_owned();
            };
            let is_divisor = before.trim_end().ends_with('/');
            let is_power = behind.trim_start().starts_with(['^', '*']);
            let is_product = part.contains(['*', '/']);
            let is_joined =
                is_divisor && is_product || is_power && (is_product || part.contains('^'));
            let whole = if is_joined {
                format!("{before}({part}){behind}")
            } else {
                format!("{before}{part}{behind}")
            };
            // `m3` among other unknown names
            if super::Unit::parse(&whole).is_ok() { whole } else { part.to_owned() }
        };
        let mut error = self.clone();
        match &mut error {
            Self::UnknownUnit { span, nearest, .. } => {
                nearest.iter_mut().for_each(|near| *near = whole(span, near));
            }
            Self::QualifiedUnit { span, unit, .. } => *unit = whole(span, unit),
            Self::PrefixNotAllowed { span, instead, .. } => *instead = whole(span, instead),
            _ => {}
        }
        error
    }
}

impl Error for UnitError {}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownUnit { name, nearest, .. } if nearest.is_empty() => write!(
                f,
                "`{name}` is not a known unit; write units like `mm`, `kg*m^-3` or `m/s^2`"
            ),
            Self::UnknownUnit { name, nearest, .. } => {
                write!(f, "`{name}` is not a known unit; did you mean {}?", alternatives(nearest))
            }
            Self::QualifiedUnit { name, unit, says, .. } => write!(
                f,
                "`{name}` says more than a unit may: it is {says}; write `{unit}`, and put the \
                 rest into the name of the quantity"
            ),
            Self::PrefixNotAllowed { prefix, unit, instead, .. } => {
                write!(f, "`{unit}` does not take the prefix `{prefix}`; write `{instead}`")
            }
            Self::UnexpectedCharacter { found, expected, suggestion, .. } => {
                write!(f, "`{}` is not allowed here; expected {expected}", ShownChar(*found))?;
                match suggestion {
                    Some(suggestion) => write!(f, "; did you mean `{suggestion}`?"),
                    None => Ok(()),
                }
            }
            Self::MissingFactor { operator, side: MissingSide::Before, .. } => {
                write!(f, "`{operator}` needs a unit or a number before it, such as `1{operator}`")
            }
            Self::MissingFactor { operator, side: MissingSide::After, .. } => {
                write!(f, "`{operator}` needs a unit or a number after it")
            }
            Self::MissingFactor { operator, side: MissingSide::Inside, .. } => {
                write!(f, "`{operator}` needs a unit or a number between the parentheses")
            }
            Self::UnbalancedParenthesis { found: ')', .. } => {
                f.write_str("`)` closes a parenthesis that was not opened; remove it or add `(`")
            }
            Self::UnbalancedParenthesis { found, .. } => {
                write!(f, "`{found}` opens a parenthesis that is not closed; add `)`")
            }
            Self::ExponentNotANumber { found, .. } if found.is_empty() => {
                f.write_str("the exponent is missing; write it like `^2`, `^-3` or `^(1/2)`")
            }
            Self::ExponentNotANumber { found, .. } => {
                write!(f, "`{found}` is not an exponent; write it like `^2`, `^-3` or `^(1/2)`")
            }
            Self::ExponentTooLarge { found, limit, .. } => write!(
                f,
                "`{found}` is too large an exponent or too fine a fraction; the exponent may be \
                 from -{limit} to {limit}, its denominator at most {MAX_EXPONENT}"
            ),
            Self::AmbiguousPower { as_root, as_quotient, .. } => write!(
                f,
                "a power followed by a division by a number can be read in two ways; write \
                 `{as_root}` or `{as_quotient}`"
            ),
            Self::AmbiguousProduct { found, likelier, other, .. } => {
                write!(f, "`{found}` can be read in two ways; write `{likelier}` or `{other}`")
            }
            Self::NumberInParentheses { found, .. } => write!(
                f,
                "`{found}` after a unit can be an uncertainty, a coverage, or a factor: write an \
                 uncertainty before the unit, `5.0112(23) V`, or after the value, `5.0112 V ± \
                 0.0046 V (k=2)`, and a factor with its sign, as in `V*2`"
            ),
            Self::FactorOutOfRange { .. } => f.write_str(
                "the factor of this unit is zero, or too large or too small to calculate with; it \
                 must be a positive number from about 1e-307 to 1e308",
            ),
            Self::TooLong { length, limit } => {
                write!(f, "a unit of {length} bytes is too long; at most {limit} are allowed")
            }
            Self::NestedTooDeep { limit, .. } => {
                write!(f, "too many parentheses or roots are nested; at most {limit} are allowed")
            }
        }
    }
}

/// The largest exponent of a unit, in absolute value, and the largest denominator of an exponent.
pub(super) const MAX_EXPONENT: u32 = 24;

/// "`a`", "`a` or `b`", "`a`, `b` or `c`".
fn alternatives(texts: &[String]) -> String {
    let quoted: Vec<String> = texts.iter().map(|text| format!("`{text}`")).collect();
    listed(&quoted, " or ")
}

/// A character in a message: quotes are unchanged, control characters are escaped.
struct ShownChar(char);

impl fmt::Display for ShownChar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            '\'' | '"' | '\\' => write!(f, "{}", self.0),
            c => write!(f, "{}", c.escape_debug()),
        }
    }
}

/// Two units of different dimension, between which no conversion exists.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct IncompatibleUnits {
    /// The text of the unit to convert from.
    pub from: Box<str>,
    /// Its dimension.
    pub from_dimension: Dimension,
    /// What it measures, in words.
    pub from_is: Box<str>,
    /// The text of the unit to convert to.
    pub to: Box<str>,
    /// Its dimension.
    pub to_dimension: Dimension,
    /// What that measures, in words.
    pub to_is: Box<str>,
}

impl Error for IncompatibleUnits {}

impl fmt::Display for IncompatibleUnits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` measures {}, and `{}` {}; one cannot be converted to the other",
            self.from, self.from_is, self.to, self.to_is
        )
    }
}
