//! Why a row of a recipe has no observation.

use std::error::Error;
use std::fmt;

use gumption_engine::number::Shortest;

/// Values of one channel that are held in memory at most (1 GiB): what a channel with steps, or of
/// a recipe with the method [`Fft`](super::Method::Fft), may have.
pub const MOST_HELD: u64 = 1 << 27;

/// Why a row has no observation. Channels are named by their places in the recipe, which count
/// from 0.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refused<E> {
    /// A recording cannot be read.
    Unreadable(E),
    /// A component at or above half the sampling rate; frequency and rate in hertz.
    AboveNyquist {
        /// The channel.
        channel: usize,
        /// The component's frequency.
        hertz: f64,
        /// The sampling rate.
        rate: f64,
    },
    /// Less than one period of a frequency, or none between two crossings for bins.
    LessThanOnePeriod {
        /// The channel.
        channel: usize,
        /// The frequency, in hertz.
        hertz: f64,
        /// The part of a period that there is.
        periods: f64,
    },
    /// Two components that the record is too short to tell apart, or fewer values than parameters.
    NotApart {
        /// The channel.
        channel: usize,
        /// Values of the record.
        samples: u64,
    },
    /// No oscillation where the frequency is to be estimated.
    NotFound {
        /// The channel.
        channel: usize,
    },
    /// A step cannot be done.
    Step {
        /// The channel.
        channel: usize,
        /// The number of the step, from 0.
        step: usize,
        /// Why.
        reason: String,
    },
    /// The sampling rate cannot be found.
    Rate {
        /// The channel that it was looked for in.
        channel: usize,
        /// Why.
        reason: String,
    },
    /// More values than are held in memory for a step or the Fourier transform.
    TooLong {
        /// The channel.
        channel: usize,
        /// Its values.
        samples: u64,
    },
    /// A number of the recipe, of a frequency or of a time base that is out of its range.
    OutOfRange {
        /// What it is, with its unit in brackets where it has one.
        what: &'static str,
        /// The number.
        found: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The place of a channel that the recipe does not have.
    UnknownChannel {
        /// The place.
        channel: usize,
        /// How many channels the recipe has.
        channels: usize,
    },
    /// A channel that two recordings hold, or one of them twice.
    ChannelTwice {
        /// The channel.
        channel: usize,
    },
    /// The reference is in none of the recordings.
    ReferenceMissing {
        /// The reference.
        channel: usize,
    },
    /// The reference has no oscillation at a frequency, so that it has no phase.
    ReferenceSilent {
        /// The reference.
        channel: usize,
        /// The frequency, in hertz.
        hertz: f64,
    },
    /// A channel that has not as many values as the recording has instants.
    Unequal {
        /// The channel.
        channel: usize,
        /// Its values.
        samples: u64,
        /// The instants of the recording: the values of its first channel.
        expected: u64,
    },
    /// A value that is not a finite number.
    NotFinite {
        /// The channel.
        channel: usize,
        /// The number of the sample, from 0.
        sample: u64,
    },
}

impl<E> Refused<E> {
    /// The channel, where it is about one.
    pub fn channel(&self) -> Option<usize> {
        match self {
            Self::Unreadable(_) | Self::OutOfRange { .. } => None,
            Self::AboveNyquist { channel, .. }
            | Self::LessThanOnePeriod { channel, .. }
            | Self::NotApart { channel, .. }
            | Self::NotFound { channel }
            | Self::Step { channel, .. }
            | Self::Rate { channel, .. }
            | Self::TooLong { channel, .. }
            | Self::UnknownChannel { channel, .. }
            | Self::ChannelTwice { channel }
            | Self::ReferenceMissing { channel }
            | Self::ReferenceSilent { channel, .. }
            | Self::Unequal { channel, .. }
            | Self::NotFinite { channel, .. } => Some(*channel),
        }
    }
}

impl<E: fmt::Display> fmt::Display for Refused<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(channel) = self.channel() {
            write!(f, "channel {channel}: ")?;
        }
        match self {
            Self::Unreadable(error) => error.fmt(f),
            Self::AboveNyquist { hertz, rate, .. } => write!(
                f,
                "a component at {} Hz is not below half the sampling rate of {} Hz",
                Shortest(*hertz),
                Shortest(*rate)
            ),
            Self::LessThanOnePeriod { hertz, periods, .. } if *periods < 1.0 => write!(
                f,
                "the recording has {periods:.3} periods of {} Hz; one at least is needed",
                Shortest(*hertz)
            ),
            Self::LessThanOnePeriod { hertz, periods, .. } => write!(
                f,
                "the recording has {periods:.3} periods of {} Hz, but no whole ones between \
                 crossings of its mean upwards, which the Fourier transform needs",
                Shortest(*hertz)
            ),
            Self::NotApart { samples, .. } => write!(
                f,
                "{samples} samples are too few, or too short a time, to separate the frequencies \
                 and their multiples"
            ),
            Self::NotFound { .. } => {
                f.write_str("there is no oscillation whose frequency could be estimated")
            }
            Self::Step { step, reason, .. } => write!(f, "step {step}: {reason}"),
            Self::Rate { reason, .. } => f.write_str(reason),
            Self::TooLong { samples, .. } => write!(
                f,
                "{samples} samples are more than the {MOST_HELD} that are held in memory for steps \
                 and for the Fourier transform"
            ),
            Self::OutOfRange { what, found, range } => {
                write!(f, "the {what} is {}, and must be {range}", Shortest(*found))
            }
            Self::UnknownChannel { channels, .. } => {
                write!(f, "the recipe has {channels} channels, whose places count from 0")
            }
            Self::ChannelTwice { .. } => f.write_str("the recordings hold it twice"),
            Self::ReferenceMissing { .. } => {
                f.write_str("no recording holds this channel, which phases are counted from")
            }
            Self::ReferenceSilent { hertz, .. } => write!(
                f,
                "it does not oscillate at {} Hz, so that phases cannot be counted from it",
                Shortest(*hertz)
            ),
            Self::Unequal { samples, expected, .. } => {
                write!(f, "it has {samples} values, and the recording has {expected} instants")
            }
            Self::NotFinite { sample, .. } => {
                write!(f, "the value of sample {sample} is not a finite number")
            }
        }
    }
}

impl<E: Error> Error for Refused<E> {}
