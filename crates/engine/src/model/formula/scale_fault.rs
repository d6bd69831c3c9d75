//! What can be wrong with the scales of a formula's quantities: zeros, levels, periods and angle.

use std::fmt;

use gumption_units::Zero;

/// Where a quantity stands that may not stand there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScaledPlace {
    /// A factor of a product.
    Product,
    /// Dividend or divisor.
    Quotient,
    /// Base of a power.
    Power,
    /// Argument of a function.
    Function(&'static str),
}

/// A mistake about scales; `text` is always the quantity as the formula has it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScaleFault {
    /// A Celsius temperature, or a level with a reference, that is no summand.
    ZeroOutOfPlace {
        /// The quantity.
        text: String,
        /// What its numbers count from.
        zero: Zero,
        /// Where it stands.
        place: ScaledPlace,
    },
    /// A sum of quantities with a zero whose factors add neither to 1 nor to 0.
    FactorsOfSum {
        /// The sum.
        text: String,
        /// What its quantities count from.
        zero: Zero,
        /// What the factors add to, as text.
        total: String,
    },
    /// Two quantities that count from different zeros, of which one may be absolute.
    DifferentZeros {
        /// The operator or function.
        operator: &'static str,
        /// The two quantities.
        texts: [String; 2],
        /// Their zeros.
        zeros: [Option<Zero>; 2],
    },
    /// `kelvin` or `celsius` of a difference.
    OfDifference {
        /// The function.
        function: &'static str,
        /// The difference.
        text: String,
    },
    /// 273.15 K added to a Celsius temperature, which is then one of 273.15 degC more.
    IcePointAdded {
        /// The Celsius temperature.
        text: String,
    },
    /// A temperature in K that is divided by the degree Celsius.
    KelvinPerCelsius {
        /// The temperature.
        text: String,
        /// The unit as written.
        unit: String,
    },
    /// A level and a plain number together.
    LevelAndNumber {
        /// The operator or function.
        operator: &'static str,
        /// The level.
        level: String,
        /// The number.
        number: String,
        /// Whether the number is one written out.
        is_literal: bool,
    },
    /// A level as the argument of a function.
    LevelInFunction {
        /// The function.
        function: &'static str,
        /// The level.
        text: String,
    },
    /// A level as an exponent, not divided by 10 or 20.
    LevelAsExponent {
        /// The level.
        text: String,
    },
    /// `10^(L/10)` of a level times one unit that is not its reference.
    OtherReference {
        /// The level.
        level: String,
        /// What it is above.
        zero: Zero,
        /// The quantity that is written in place of its reference.
        quantity: String,
    },
    /// Numbers of two levels together that are above different references.
    OtherReferences {
        /// The operator.
        operator: &'static str,
        /// The two numbers.
        texts: [String; 2],
        /// What they are above.
        zeros: [Zero; 2],
    },
    /// A rate of revolutions and one whose unit does not say what it counts together.
    RevolutionsAndRate {
        /// The operator or function.
        operator: &'static str,
        /// The rate of revolutions.
        revolutions: String,
        /// The other one.
        rate: String,
    },
    /// A quantity that counts periods and one that counts angle together.
    PeriodsAndAngle {
        /// The operator or function.
        operator: &'static str,
        /// The quantity that counts periods.
        periods: String,
        /// The quantity that counts angle.
        angle: String,
    },
}

/// What a quantity with that zero is, in words.
fn kind(zero: Zero) -> String {
    match zero {
        Zero::Celsius => "a Celsius temperature, whose zero is at 273.15 K".to_owned(),
        level => format!("a level in {}, which has a reference", level.unit()),
    }
}

/// What to write where a number is added or compared to a level.
fn as_level(number: &str, is_literal: bool) -> String {
    if is_literal {
        format!("write `{number} [dB]`, or take the logarithm of a ratio: `20*log10({number})`")
    } else {
        format!("take the logarithm of a ratio: `10*log10({number})` or `20*log10({number})`")
    }
}

/// Whether a text is a name.
fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// Whether a text is a level as it is, not one that is scaled already.
fn is_level_alone(text: &str) -> bool {
    !text.contains(['*', '/'])
}

/// The power or the voltage that a level is of.
fn above_reference(level: &str, zero: Zero) -> String {
    let divisor = zero.decibels_per_decade().unwrap_or_default();
    format!("10^({level}/{divisor})*1 [{}]", zero.reference().unwrap_or_default())
}

impl fmt::Display for ScaleFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ZeroOutOfPlace { text, zero: zero @ Zero::Celsius, place } => {
                write!(f, "`{text}` is {}; ", kind(*zero))?;
                match place {
                    ScaledPlace::Product => f.write_str("it is no factor of this product")?,
                    ScaledPlace::Quotient => f.write_str("it is no part of this quotient")?,
                    ScaledPlace::Power => f.write_str("it has no such power")?,
                    ScaledPlace::Function(name) => write!(f, "`{name}` does not take it")?,
                }
                if text.ends_with(']') && text.starts_with(|c: char| c.is_ascii_digit()) {
                    return f.write_str(
                        ". Write `(...) [degC]` for a number of degrees Celsius, a size in `K` where a \
                         difference is meant",
                    );
                }
                if !is_name(text) {
                    f.write_str(
                        ". Write `kelvin(t)` of a temperature t in it for the thermodynamic temperature, \
                         `t - t_ref` for a difference, `t/[degC]` for the number, or give the coefficient \
                         per degC, such as in `1/degC`",
                    )?;
                    return match text.contains("[K]") {
                        true => {
                            f.write_str("; the difference from a temperature has that in `[degC]`")
                        }
                        false => Ok(()),
                    };
                }
                write!(
                    f,
                    ". Write `kelvin({text})` for the thermodynamic temperature, `{text} - t_ref` \
                     for a difference, `{text}/[degC]` for the number, or give the coefficient \
                     per degC, such as in `1/degC`"
                )
            }
            Self::ZeroOutOfPlace { text, zero, .. } => write!(
                f,
                "`{text}` is {}; it is not allowed here. Write `10^({text}/10)*1 [mW]` or the \
                 like for the quantity itself, `{text} - L_ref` for a difference of levels",
                kind(*zero)
            ),
            Self::FactorsOfSum { text, zero, total } => {
                write!(
                    f,
                    "the factors of what is {} add to {total} in `{text}`; they must add to 1, \
                     for an average or a correction, or to 0, for a difference. ",
                    match zero {
                        Zero::Celsius => "in degC".to_owned(),
                        level => format!("in {}", level.unit()),
                    }
                )?;
                match zero {
                    Zero::Celsius => f.write_str(
                        "Write `kelvin(...)` for thermodynamic temperatures, give a correction in `K`, or \
                         compute with numbers of degrees Celsius, `t/[degC]`, as in \
                         `(0.3 + 0.005*t/[degC])*1 [K]`",
                    ),
                    _ => f.write_str("Give a correction in `dB`"),
                }
            }
            Self::DifferentZeros { operator, texts: [a, b], zeros: [x, y] } => {
                let words = |zero: &Option<Zero>| match zero {
                    Some(Zero::Celsius) => "a Celsius temperature".to_owned(),
                    Some(level) => format!("a level in {}", level.unit()),
                    None => "not".to_owned(),
                };
                match (x, y) {
                    (Some(Zero::Celsius), None) | (None, Some(Zero::Celsius)) => {
                        let (celsius, kelvin) = if x.is_some() { (a, b) } else { (b, a) };
                        write!(
                            f,
                            "`{celsius}` is a Celsius temperature and `{kelvin}` is one in K, \
                             which `{operator}` cannot take together; write `kelvin({celsius})` or \
                             `celsius({kelvin})`"
                        )
                    }
                    _ => write!(
                        f,
                        "`{a}` is {}, but `{b}` is {}; `{operator}` cannot take them together",
                        words(x),
                        words(y)
                    ),
                }
            }
            Self::IcePointAdded { text } => write!(
                f,
                "`{text}` is a Celsius temperature and stays one when kelvins are added; write \
                 `kelvin({text})` for the thermodynamic temperature"
            ),
            Self::OfDifference { function, text } => write!(
                f,
                "`{text}` is a difference of temperatures, which is in K already, so `{function}` \
                 of it has no meaning; write `{function}(t)` of a temperature, and give what is \
                 only a correction in `K`"
            ),
            Self::KelvinPerCelsius { text, unit } => write!(
                f,
                "`{text}` is in K; write `celsius({text})/[{unit}]` for the number of degrees of \
                 a temperature, or `{text}/[K]` for a difference"
            ),
            Self::LevelAndNumber { operator, level, number, is_literal } => write!(
                f,
                "`{level}` is a level in decibels, but `{number}` is a plain number; `{operator}` \
                 cannot take them together: {}",
                as_level(number, *is_literal)
            ),
            Self::LevelInFunction { function, text } if is_level_alone(text) => write!(
                f,
                "`{function}` needs a plain number, but `{text}` is a level; write \
                 `10^({text}/10)` for the ratio of powers, `10^({text}/20)` for the ratio of \
                 amplitudes, or `{text}/[dB]` for the number of decibels"
            ),
            // of `exp(L/20)`, an amplitude of base e, nothing can be proposed for the whole
            Self::LevelInFunction { function, text } => write!(
                f,
                "`{function}` needs a plain number, but `{text}` is a level; write `10^(L/10)` of \
                 a level L for the ratio of powers, `10^(L/20)` for the ratio of amplitudes, or \
                 `L/[dB]` for the number of decibels"
            ),
            Self::LevelAsExponent { text } => write!(
                f,
                "`{text}` is a level as an exponent; write `10^(L/10)` for a ratio of powers, \
                 `10^(L/20)` for one of amplitudes, or `.../[dB]` for the number of decibels"
            ),
            Self::OtherReference { level, zero, quantity } => write!(
                f,
                "`{level}` is a level in {}, so that this power of ten is not multiplied by `{quantity}`; \
                 write `{}`",
                zero.unit(),
                above_reference(level, *zero)
            ),
            Self::OtherReferences { operator, texts: [a, b], zeros } => {
                let [of_a, of_b] = zeros.map(|zero| zero.reference().unwrap_or_default());
                write!(
                    f,
                    "`{a}` is in {of_a} and `{b}` in {of_b}, which `{operator}` cannot combine: \
                     write `{a}*1 [{of_a}]` and `{b}*1 [{of_b}]`, or give both levels above one \
                     reference"
                )
            }
            Self::RevolutionsAndRate { operator, revolutions, rate } => write!(
                f,
                "`{revolutions}` counts revolutions, and the unit of `{rate}` does not state \
                 whether it counts revolutions or radians, so `{operator}` cannot combine them: \
                 give it in `rpm` or in `rad/s`"
            ),
            Self::PeriodsAndAngle { operator, periods, angle } => write!(
                f,
                "`{periods}` counts periods and `{angle}` counts angle; `{operator}` cannot take \
                 them together: write `2*pi*{periods}` or `{angle}/(2*pi)`"
            ),
        }
    }
}

impl ScaleFault {
    /// What to write instead, where one text serves.
    pub(super) fn suggestion(&self) -> Option<String> {
        match self {
            Self::ZeroOutOfPlace { text, zero: Zero::Celsius, .. } if is_name(text) => {
                Some(format!("kelvin({text})"))
            }
            Self::KelvinPerCelsius { text, unit } => Some(format!("celsius({text})/[{unit}]")),
            Self::LevelAndNumber { number, is_literal: true, .. } => Some(format!("{number} [dB]")),
            Self::LevelAndNumber { number, .. } => Some(format!("20*log10({number})")),
            Self::LevelInFunction { text, .. } if is_level_alone(text) => {
                Some(format!("10^({text}/20)"))
            }
            Self::OtherReference { level, zero, .. } => Some(above_reference(level, *zero)),
            _ => None,
        }
    }
}
