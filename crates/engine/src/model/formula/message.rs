//! What is wrong with a formula, in sentences.

use std::fmt;
use std::ops::Range;

use super::error::{FormulaError, NumberFault, Operand};
use super::function::Function;
use super::name::{ShownChar, is_name, looks_of};
use gumption_units::Dimension;

/// The longest part of a formula that a message quotes, in characters.
const LONGEST_QUOTE: usize = 40;

/// A part of a formula for a message: on one line, and its middle left out if it is long.
pub(super) fn excerpt(text: &str, span: Range<usize>) -> String {
    let part = text.get(span).unwrap_or_default().trim();
    let one_line = |c: char| if c.is_whitespace() || c.is_control() { ' ' } else { c };
    let count = part.chars().take(100 * LONGEST_QUOTE).count();
    if count <= LONGEST_QUOTE {
        return part.chars().map(one_line).collect();
    }
    let half = LONGEST_QUOTE / 2 - 1;
    let mut end: Vec<char> = part.chars().rev().take(half).collect();
    end.reverse();
    part.chars().take(half).chain(['…']).chain(end).map(one_line).collect()
}

/// Tells a name from one that looks like it: the first letter in which they differ.
fn alike(f: &mut fmt::Formatter<'_>, name: &str, other: &str) -> fmt::Result {
    let pairs = name.chars().zip(other.chars());
    let Some((own, its)) = pairs.into_iter().find(|(own, its)| own != its) else { return Ok(()) };
    let script = |letter: char| match letter {
        'A'..='Z' | 'a'..='z' => "Latin ",
        '\u{370}'..='\u{3ff}' => "Greek ",
        '\u{400}'..='\u{4ff}' => "Cyrillic ",
        _ => "",
    };
    let [own, its] =
        [own, its].map(|of| format!("the {}letter U+{:04X}", script(of), u32::from(of)));
    write!(
        f,
        ": it has {own} where `{}`, which looks like it, has {its}; write both alike",
        short(other)
    )
}

/// A name for a message.
fn short(name: &str) -> String {
    excerpt(name, 0..name.len())
}

/// "`a`", "`a` or `b`", "`a`, `b` or `c`", or the same with another last word.
fn listed(texts: &[String], last_word: &str) -> String {
    let quoted: Vec<String> = texts.iter().map(|text| format!("`{}`", short(text))).collect();
    gumption_units::listed(&quoted, last_word)
}

/// "; hint" and "; did you mean `suggestion`?", as far as there are such.
fn more(f: &mut fmt::Formatter<'_>, hint: Option<&str>, suggestion: Option<&str>) -> fmt::Result {
    if let Some(hint) = hint {
        write!(f, "; {hint}")?;
    }
    match suggestion {
        Some(suggestion) if hint.is_none_or(|hint| !hint.contains(&format!("`{suggestion}`"))) => {
            write!(f, "; did you mean `{suggestion}`?")
        }
        _ => Ok(()),
    }
}

impl fmt::Display for Operand {
    /// "`height` is a length (m)".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {}", self.text, self.dimension.describe())
    }
}

/// The number that a product begins with: `0.004` of `0.004*(t - t0)`.
fn leading_number(text: &str) -> Option<&str> {
    let (number, _) = text.split_once('*')?;
    let number = number.trim_end();
    number.parse::<f64>().is_ok().then_some(number)
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the formula is empty"),
            Self::TooLong { length, limit } => write!(
                f,
                "a text of {length} bytes is too long for a formula; at most {limit} are allowed"
            ),
            Self::TooDeep { limit, .. } => write!(
                f,
                "there are more than {limit} parentheses, functions, signs or powers inside each \
                 other; give a part of the formula a name of its own"
            ),
            Self::UnexpectedCharacter { found, hint, suggestion, .. } => {
                write!(f, "`{}` has no meaning in a formula", ShownChar(*found))?;
                more(f, *hint, suggestion.as_deref())
            }
            Self::UnexpectedEnd { expected, opened, .. } => {
                write!(f, "the formula ends where {expected} is expected")?;
                match opened {
                    Some(_) => f.write_str("; a parenthesis is still open"),
                    None => Ok(()),
                }
            }
            Self::UnexpectedToken { found, expected, hint, suggestion, .. } => {
                write!(f, "`{found}` is not allowed here; expected {expected}")?;
                more(f, hint.as_deref(), suggestion.as_deref())
            }
            Self::UnreadableNumber { text, fault, suggestion, .. } => {
                write!(f, "`{}` is not a number that can be read: ", short(text))?;
                f.write_str(match fault {
                    NumberFault::Comma => "a decimal fraction is written with a point",
                    NumberFault::TwoPoints => "it has more than one decimal point",
                    NumberFault::Grouped => "digits are written without anything between them",
                    NumberFault::OutOfRange => {
                        "it is too large or too small for double precision (about 1e-308 to 1e308)"
                    }
                })?;
                more(f, None, suggestion.as_deref())
            }
            Self::ChainedComparison { .. } => f.write_str(
                "comparisons cannot be joined like this; that both hold is their product, such as \
                 `(a < b)*(b < c)`",
            ),
            Self::FunctionWithoutArguments { name, suggestion, .. } => write!(
                f,
                "`{name}` is a function and needs its argument in parentheses: `{suggestion}`"
            ),
            Self::UnknownName { name, nearest, known, .. } => {
                write!(f, "`{}` is not defined", short(name))?;
                let mut others = nearest.iter().chain(known);
                if let Some(other) = others.find(|other| looks_of(other) == looks_of(name)) {
                    return alike(f, name, other);
                }
                match (nearest.is_empty(), known.is_empty()) {
                    (false, _) => write!(f, "; did you mean {}?", listed(nearest, " or ")),
                    (true, false) => write!(f, "; names here are {}", listed(known, " and ")),
                    (true, true) => f.write_str("; no names are defined here"),
                }
            }
            Self::DefinedLater { name, .. } => write!(
                f,
                "`{}` is not defined yet; a formula may use inputs, conditions and the \
                 quantities above it",
                short(name)
            ),
            Self::Curve { reason, .. }
            | Self::Complex { reason, .. }
            | Self::UnstatedUnit { reason, .. } => f.write_str(reason),
            Self::ConvertedTwice { formula, output, unit, .. } => write!(
                f,
                "`{formula}` converts to {unit}, and so does the output `{output}` in {unit} once more: \
                 formulas compute shares as plain numbers; leave the factor out, or give the output \
                 without a unit; a factor that is no conversion is an input of its own"
            ),
            Self::UnknownFunction { name, nearest, .. } => {
                write!(f, "there is no function `{}`", short(name))?;
                if nearest.is_empty() {
                    let all: Vec<&str> = Function::all().map(Function::name).collect();
                    write!(f, "; the functions are {}", all.join(", "))
                } else {
                    write!(f, "; did you mean {}?", listed(nearest, " or "))
                }
            }
            Self::NotAFunction { name, .. } => {
                let name = short(name);
                write!(
                    f,
                    "`{name}` is a quantity and not a function; a product is written `{name}*(...)`"
                )
            }
            Self::ArgumentCount { function, expected, found, suggestion, .. } => {
                write!(f, "`{function}` takes {}, not {found}", expected.describe())?;
                more(f, None, suggestion.as_deref())
            }
            Self::MixedDimensions { operator, operands, .. } => {
                let [left, right] = operands.as_ref();
                let right_kind = right.dimension.describe();
                write!(f, "{left}, but `{}` is {right_kind}; {}", right.text, joined(operator))?;
                if left.is_number != right.is_number {
                    let number = if left.is_number { left } else { right };
                    let other = if left.is_number { right } else { left };
                    if number.text.starts_with("273.1") && other.dimension == Dimension::TEMPERATURE
                    {
                        return write!(
                            f,
                            " (the thermodynamic temperature of a Celsius temperature `{0}` is \
                             `kelvin({0})`)",
                            other.text
                        );
                    }
                    // a factor of a quantity beside the 1 is per unit of it
                    if number.text == "1"
                        && let Some(factor) = leading_number(&other.text)
                    {
                        let unit = match (other.is_celsius, &other.unit) {
                            (false, Some(unit)) if other.dimension != Dimension::TEMPERATURE => {
                                unit.clone()
                            }
                            _ => other.dimension.usual_unit(),
                        };
                        let unit = if unit.contains(['*', '/', ' ', '^']) {
                            format!("({unit})")
                        } else {
                            unit
                        };
                        return write!(
                            f,
                            " (a number other than 0 in a formula has no unit; write one behind the factor, \
                             such as `{factor} [1/{unit}]`)"
                        );
                    }
                    let given = other.unit.as_deref().unwrap_or("degC");
                    let unit = match (other.is_celsius, *operator) {
                        // two Celsius temperatures have no sum
                        (true, "+") => "K".to_owned(),
                        (true, _) => given.to_owned(),
                        (false, _) => {
                            other.unit.clone().unwrap_or_else(|| other.dimension.usual_unit())
                        }
                    };
                    write!(
                        f,
                        " (a number other than 0 in a formula has no unit; write one behind it, \
                         such as `{} [{unit}]`",
                        number.text,
                    )?;
                    match (other.is_celsius, is_name(&other.text)) {
                        (true, true) => {
                            write!(
                                f,
                                ", or take the number of the other, `{}/[{given}]`",
                                other.text
                            )?;
                        }
                        // a width that grows with the temperature, IEC 60751
                        (true, false) => f.write_str(
                            ", or compute with numbers: the number of degrees Celsius is \
                             `t/[degC]`, as in `(0.3 + 0.005*t/[degC])*1 [K]`",
                        )?,
                        _ => {}
                    }
                    if other.is_celsius && given.ends_with('F') {
                        f.write_str(
                            "; units are converted where an input is read and an output is reported, and \
                             a formula that converts from degF leaves it out",
                        )?;
                    }
                    f.write_str(")")?;
                }
                if left.text.contains("[h]") || right.text.contains("[h]") {
                    f.write_str(" (`[h]` is the Planck constant; the hour is `[hour]`)")?;
                }
                Ok(())
            }
            Self::ArgumentNotPlain { function, argument, .. } => {
                let kind = if matches!(*function, "sin" | "cos" | "tan") {
                    "an angle or another plain number"
                } else {
                    "a plain number"
                };
                write!(f, "`{function}` needs {kind}, but {argument}")
            }
            Self::NotATemperature { function, argument, .. } => {
                write!(f, "`{function}` needs a temperature, but {argument}")
            }
            Self::ExponentNotPlain { exponent } => {
                write!(f, "an exponent must be a plain number, but {exponent}")
            }
            Self::ExponentNotConstant { base, exponent, .. } => write!(
                f,
                "{base}, so its exponent must be a number written out, such as `2` or `(1/2)`, \
                 not `{exponent}`"
            ),
            Self::BadUnit { text, error, .. } => {
                write!(f, "`[{}]` is no unit: {error}", short(text))?;
                match text.contains(['+', '-', '(']) {
                    true => {
                        f.write_str(" (write parts of a formula in parentheses, units in `[]`)")
                    }
                    false => Ok(()),
                }
            }
            Self::TwoReadings { text, readings: [first, second], .. } => {
                write!(f, "`{text}` can be read in two ways; write `{first}` or `{second}`")
            }
            Self::NumberWithUnit { number, unit, .. } => write!(
                f,
                "`{}` is {} already, and a unit in brackets follows a plain number; the number of \
                 {unit} is `{}/[{unit}]`",
                number.text,
                number.dimension.describe(),
                number.text
            ),
            Self::Scale { fault, .. } => fault.fmt(f),
            Self::TableColumns { .. } => f.write_str(
                "`table` needs both columns or none: table(x, 'file.csv', 'x column', 'y column')",
            ),
            Self::TableMethod { found, .. } => write!(
                f,
                "`{}` is no way of interpolation; there are `linear` and `cubic`",
                short(found)
            ),
            Self::ConstantUndefined { part, is_infinite: true, .. } => {
                write!(f, "`{part}` is infinite, whatever the inputs")
            }
            Self::ConstantUndefined { part, .. } => {
                write!(f, "`{part}` has no value, whatever the inputs")
            }
            Self::UncheckedUnit { found, name, unit, .. } => write!(
                f,
                "units are not checked here: `{}` is the number in `{}`, but `[{}]` one of coherent SI \
                 units; write the number alone, or divide a name by the unit, `{}/[{}]`, in parentheses \
                 behind a factor",
                short(name),
                short(unit),
                short(found),
                short(name),
                short(found)
            ),
            Self::TableOutOfPlace { file, .. } => write!(
                f,
                "the table of `{}` cannot be read here; tables are only in the equations of a \
                 model file",
                short(file)
            ),
            Self::TableArgument { argument, expected } => {
                write!(f, "{argument}, but {expected}")
            }
            Self::TooManySolves { limit, .. } => write!(
                f,
                "there are more than {limit} equations to solve inside each other; give a part of \
                 the formula a name of its own"
            ),
            Self::UnknownIsDefined { name, .. } => write!(
                f,
                "`{}` is a quantity of the file already; the unknown of `solve` needs a name of \
                 its own",
                short(name)
            ),
            Self::UnknownNotUsed { name, .. } => write!(
                f,
                "the unknown `{}` does not occur in the formula that is to be 0",
                short(name)
            ),
            Self::DimensionOverflow { text, .. } => write!(
                f,
                "the dimension of `{text}` is out of range: its exponents are too large or too \
                 fine"
            ),
        }
    }
}

/// What an operator or function cannot do with quantities of different dimension.
fn joined(operator: &str) -> String {
    match operator {
        "+" => "they cannot be added".to_owned(),
        "-" => "one cannot be subtracted from the other".to_owned(),
        "<" | "<=" | ">" | ">=" | "==" | "!=" => "they cannot be compared".to_owned(),
        function => format!("`{function}` needs quantities of the same dimension"),
    }
}
