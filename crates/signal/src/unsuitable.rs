//! Why a step cannot be taken on a signal.

use std::error::Error;
use std::fmt;

/// A signal, or a parameter of a step, that the step cannot work with.
#[derive(Clone, Debug, PartialEq)]
pub enum Unsuitable {
    /// The signal has too few values.
    TooShort {
        /// How many it has.
        samples: usize,
        /// How many the step needs.
        needed: usize,
    },
    /// A parameter lies outside its range.
    Outside {
        /// The parameter, with its unit in brackets where it has one.
        what: &'static str,
        /// What was found.
        found: f64,
        /// The limits, which do not belong to the range.
        between: [f64; 2],
    },
    /// A band-pass filter has its poles in pairs.
    OddPoles {
        /// How many were asked for.
        poles: usize,
    },
    /// Two signals are not values at the same instants.
    NotTogether {
        /// Number of values of each.
        samples: [usize; 2],
        /// Sampling rate of each, in hertz.
        rates: [f64; 2],
    },
    /// A signal has fewer whole periods than the segments of a cross-spectrum need, or these are
    /// fewer than 2.
    Segments {
        /// How many segments were asked for.
        segments: usize,
        /// Whole periods of the signal.
        periods: usize,
        /// Whole periods that a segment has at least.
        least: usize,
    },
    /// A value is not a finite number.
    NotFinite {
        /// Its place in the signal, counted from zero.
        sample: usize,
    },
    /// The signal has no component where the step looks for one.
    Silent {
        /// Where it was sought, in hertz.
        frequency: f64,
    },
    /// The greatest amplitude lies at an end of what was searched.
    AtTheEnd {
        /// The parameter, with its unit in brackets.
        what: &'static str,
        /// The end.
        end: f64,
    },
}

impl fmt::Display for Unsuitable {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort { samples, needed } => {
                write!(out, "{samples} values are too few: at least {needed} are needed")
            }
            Self::Outside { what, found, between: [low, high] } => {
                write!(out, "{what} is {found}, and must lie between {low} and {high}")
            }
            Self::OddPoles { poles } => {
                write!(out, "a band-pass filter has an even number of poles, not {poles}")
            }
            Self::NotTogether { samples, rates } => write!(
                out,
                "the signals are not sampled together: {} values at {} Hz and {} at {} Hz",
                samples[0], rates[0], samples[1], rates[1]
            ),
            Self::Segments { segments, .. } if *segments < 2 => write!(
                out,
                "a cross-spectrum has 2 segments or more, not {segments}: the coherence of one alone \
                 is 1, whatever the noise"
            ),
            Self::Segments { segments, periods, least } => {
                let each = if *least == 1 { "period" } else { "periods" };
                write!(
                    out,
                    "a cross-spectrum of {segments} segments takes {least} whole {each} for each, \
                     {} in all, and the signals have {periods} in common",
                    segments.saturating_mul(*least)
                )?;
                match periods / least {
                    0 | 1 if *least > 1 => out.write_str("; record more, or fit fewer harmonics"),
                    0 | 1 => out.write_str("; record more"),
                    most => write!(out, "; use at most {most} segments"),
                }
            }
            Self::NotFinite { sample } => write!(out, "value {sample} is not a finite number"),
            Self::Silent { frequency } => write!(out, "there is no component at {frequency} Hz"),
            Self::AtTheEnd { what, end } => {
                write!(out, "the greatest amplitude lies at the end of the search, {what} = {end}")
            }
        }
    }
}

impl Error for Unsuitable {}

/// A parameter within its range, the limits not included; NaN is outside.
pub(super) fn within(what: &'static str, found: f64, between: [f64; 2]) -> Result<f64, Unsuitable> {
    if found > between[0] && found < between[1] {
        Ok(found)
    } else {
        Err(Unsuitable::Outside { what, found, between })
    }
}
