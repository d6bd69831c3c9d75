//! A step of a channel as a recipe has it.

use super::{Butterworth, Measured, Response};

/// A step of a channel, with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum ChannelStep {
    /// The mean is taken off.
    RemoveMean,
    /// The straight line of least squares is taken off.
    RemoveTrend,
    /// Only a whole number of periods of the recipe's frequency is kept, between zero crossings.
    WholePeriods,
    /// A Butterworth filter; what feels its start, or its end if it runs both ways, is cut off.
    Filter {
        /// The filter.
        filter: Butterworth,
        /// Whether amplitudes and phases are divided by its gain.
        correct: bool,
    },
    /// Derivatives or integrals by the spectrum.
    Derivative {
        /// How many derivatives; integrals are negative.
        order: i32,
        /// The highest frequency that is kept, in hertz; none: that of the multiples that are fitted.
        highest: Option<f64>,
        /// Units of the answer for one unit of the channel times s^-order.
        factor: f64,
    },
    /// The tangential or the radial acceleration of a sensor on a table whose angle is recorded.
    Rotation {
        /// Whether it is the radial one.
        radial: bool,
        /// Distance of the sensor from the axis, in metres.
        radius: Measured,
        /// The highest frequency of the angle that is kept, in hertz; none: that of the multiples
        /// that are fitted.
        highest: Option<f64>,
        /// Radians for one unit of the channel.
        radians: f64,
        /// Units of the answer for 1 m/s^2.
        factor: f64,
    },
    /// The signal is divided by a known response.
    Correct {
        /// What it came through.
        response: Response,
        /// The relative standard uncertainty of its gain.
        of_gain: f64,
        /// The standard uncertainty of its phase, in radians.
        of_phase: f64,
        /// The standard uncertainty of its delay, in seconds.
        of_delay: f64,
    },
    /// The delay against the reference by cross-correlation and by the cross-spectrum, and their
    /// agreement; the signal stays.
    Delay {
        /// Segments of the cross-spectrum; none: those of
        /// [`CrossSpectrum::of_signal`](crate::CrossSpectrum::of_signal).
        segments: Option<usize>,
    },
    /// The root mean square; the signal stays.
    Rms,
}

impl ChannelStep {
    /// Its name in files.
    pub fn name(&self) -> &'static str {
        use crate::Band;
        match self {
            Self::RemoveMean => "remove-mean",
            Self::RemoveTrend => "remove-trend",
            Self::WholePeriods => "whole-periods",
            Self::Filter { filter, .. } => match filter.band {
                Band::LowPass(_) => "low-pass",
                Band::HighPass(_) => "high-pass",
                Band::BandPass(..) => "band-pass",
            },
            Self::Derivative { order, .. } if *order < 0 => "integral",
            Self::Derivative { .. } => "derivative",
            Self::Rotation { radial: true, .. } => "radial",
            Self::Rotation { radial: false, .. } => "tangential",
            Self::Correct { .. } => "correct",
            Self::Delay { .. } => "delay",
            Self::Rms => "rms",
        }
    }

    /// Whether it looks at the reference channel.
    pub(super) fn takes_reference(&self) -> bool {
        matches!(self, Self::Correct { .. } | Self::Delay { .. })
    }

    /// Whether it cannot do without it.
    pub fn needs_reference(&self) -> bool {
        matches!(self, Self::Delay { .. })
    }

    /// Whether it changes amplitudes, phases or noise.
    pub(super) fn has_effect(&self) -> bool {
        matches!(
            self,
            Self::Filter { .. }
                | Self::Derivative { .. }
                | Self::Rotation { .. }
                | Self::Correct { .. }
        )
    }
}
