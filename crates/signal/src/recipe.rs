//! A recipe: what is to be taken from which channels.

use super::Measured;
use super::channel_step::ChannelStep;
use gumption_units::Unit;

/// How amplitudes and phases are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Least-squares fit of sines (IEEE Std 1057, ISO 16063-11).
    #[default]
    SineFit,
    /// Fourier transform over a whole number of periods between zero crossings.
    Fft,
}

/// What is called the amplitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Amplitude {
    /// A of A cos(2 pi f t + phi).
    #[default]
    Peak,
    /// A over the square root of 2.
    Rms,
}

/// The unit of phases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PhaseUnit {
    /// Degrees.
    #[default]
    Degree,
    /// Radians.
    Radian,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::SineFit, Self::Fft];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::SineFit => "sine-fit",
            Self::Fft => "fft",
        }
    }
}

impl Amplitude {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Peak, Self::Rms];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Peak => "peak",
            Self::Rms => "rms",
        }
    }

    /// What a peak value is multiplied by.
    pub fn factor(self) -> f64 {
        match self {
            Self::Peak => 1.0,
            Self::Rms => std::f64::consts::FRAC_1_SQRT_2,
        }
    }
}

impl PhaseUnit {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Degree, Self::Radian];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Degree => "deg",
            Self::Radian => "rad",
        }
    }

    /// How many of them are a radian.
    pub fn in_radian(self) -> f64 {
        match self {
            Self::Degree => 180.0 / std::f64::consts::PI,
            Self::Radian => 1.0,
        }
    }
}

/// The frequency of an excitation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// Its value in hertz, or a first guess; none where it is to be found in the recording.
    pub hertz: Option<f64>,
    /// Its standard uncertainty, in hertz.
    pub standard_uncertainty: f64,
    /// Whether it is estimated from the recording (four-parameter fit).
    pub estimate: bool,
}

/// The instants of a recording's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeBase {
    /// The sampling rate, in hertz.
    pub rate: Measured,
    /// The instant of the first value, in seconds.
    pub start: f64,
    /// The rms deviation of instants from even spacing, in seconds.
    pub jitter: f64,
    /// The part of the rate's standard uncertainty that is not the recipe's own frequency's, where
    /// the rate was found from an oscillation of that frequency: both go together then.
    pub beside_frequency: Option<f64>,
    /// The standard uncertainty of the instant in the middle of the record, in seconds, where instants of
    /// the samples tell it; none where the first instant is given and the others follow by the rate.
    pub of_middle: Option<f64>,
}

/// The search for a recording's sampling rate: that at which an oscillation of known frequency is
/// strongest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelRateSearch {
    /// The channel that has the oscillation.
    pub channel: usize,
    /// Its frequency, in hertz; none: the recipe's first.
    pub frequency: Option<Measured>,
    /// The least and the greatest rate that come into question, in hertz.
    pub between: [f64; 2],
    /// The step of the first look, in hertz.
    pub step: f64,
}

/// A channel: values of a quantity in a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The name.
    pub name: String,
    /// The unit of its values after the steps.
    pub unit: Unit,
    /// The standard uncertainty of its scale, relative, before the steps.
    pub scale_uncertainty: f64,
    /// The resolution of its values before the steps, in their unit; 0 where it is not known.
    pub resolution: f64,
    /// What is done with it before amplitudes are taken.
    pub steps: Vec<ChannelStep>,
}

/// What is the same for all rows of a recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct RecipeSettings {
    /// The channels.
    pub channels: Vec<Channel>,
    /// The channel that phases are counted from.
    pub reference: Option<usize>,
    /// The multiples of the frequency that are given, each 1 or more.
    pub components: Vec<u32>,
    /// The highest multiple that counts as distortion.
    pub harmonics: u32,
    /// The method.
    pub method: Method,
    /// What is called the amplitude.
    pub amplitude: Amplitude,
    /// The unit of phases.
    pub phase: PhaseUnit,
    /// Trials of the check by Monte Carlo; 0 for none.
    pub trials: u64,
    /// The seed of their random numbers.
    pub seed: u64,
}
