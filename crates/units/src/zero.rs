//! Zeros of scales: temperatures in degrees Celsius or Fahrenheit, and levels with a reference.

use super::{Dimension, Unit};

/// The zero of the Celsius scale in K (SI Brochure, 9th ed., 2.3.1).
const CELSIUS_ZERO: f64 = 273.15;

/// The zero of a scale, from which a number in a unit counts.
///
/// A quantity in `degC` or `degF` is a Celsius temperature: 20 degC is not twice 10 degC. In
/// formulas both are numbers of degrees Celsius. A level with a reference, such as one in `dBm`, is
/// a number of decibels above that reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Zero {
    /// 273.15 K.
    Celsius,
    /// 1 mW: `dBm`.
    Milliwatt,
    /// 1 W: `dBW`.
    Watt,
    /// 1 V: `dBV`.
    Volt,
    /// 1 mV: `dBmV`.
    Millivolt,
    /// 1 uV: `dBuV`.
    Microvolt,
    /// The full scale of a converter: `dBFS`.
    FullScale,
    /// The carrier: `dBc`.
    Carrier,
    /// An isotropic antenna: `dBi`.
    Isotropic,
}

impl Zero {
    /// The unit whose numbers count from it: `degC`, `dBm`.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Celsius => "degC",
            Self::Milliwatt => "dBm",
            Self::Watt => "dBW",
            Self::Volt => "dBV",
            Self::Millivolt => "dBmV",
            Self::Microvolt => "dBuV",
            Self::FullScale => "dBFS",
            Self::Carrier => "dBc",
            Self::Isotropic => "dBi",
        }
    }

    /// The unit of power or voltage to which a level refers: `mW` for `dBm`. `None` if the
    /// reference is neither: the full scale of a converter, a carrier.
    pub const fn reference(self) -> Option<&'static str> {
        match self {
            Self::Milliwatt => Some("mW"),
            Self::Watt => Some("W"),
            Self::Volt => Some("V"),
            Self::Millivolt => Some("mV"),
            Self::Microvolt => Some("uV"),
            Self::Celsius | Self::FullScale | Self::Carrier | Self::Isotropic => None,
        }
    }

    /// The increase of a level in dB for a tenfold quantity: 10 for powers, 20 for voltages. `None`
    /// if the reference is neither.
    pub const fn decibels_per_decade(self) -> Option<u32> {
        match self {
            Self::Milliwatt | Self::Watt => Some(10),
            Self::Volt | Self::Millivolt | Self::Microvolt => Some(20),
            Self::Celsius | Self::FullScale | Self::Carrier | Self::Isotropic => None,
        }
    }

    /// The reference that equals a power or a voltage in coherent SI units, apart from rounding:
    /// 0.001 W is the reference of `dBm`. `None` for every other quantity.
    pub fn above(dimension: Dimension, value: f64) -> Option<Self> {
        [Self::Milliwatt, Self::Watt, Self::Volt, Self::Millivolt, Self::Microvolt]
            .into_iter()
            .find(|zero| {
                let of = zero.reference().and_then(|text| Unit::parse(text).ok());
                of.is_some_and(|of| {
                    of.dimension() == dimension && (value / of.factor() - 1.0).abs() < 1e-12
                })
            })
    }

    /// Its height above the absolute zero of its kind of quantity: in K, or in dB above 1 W or 1 V.
    fn height(self) -> f64 {
        match self {
            Self::Celsius => CELSIUS_ZERO,
            Self::Milliwatt => -30.0,
            Self::Millivolt => -60.0,
            Self::Microvolt => -120.0,
            Self::Watt | Self::Volt | Self::FullScale | Self::Carrier | Self::Isotropic => 0.0,
        }
    }

    /// A zero of each kind of quantity.
    fn kind(self) -> Self {
        match self {
            Self::Milliwatt | Self::Watt => Self::Watt,
            Self::Millivolt | Self::Microvolt | Self::Volt => Self::Volt,
            other => other,
        }
    }

    /// The number to add to a value that counts from `from` so that it counts from `to`: 273.15
    /// from Celsius to thermodynamic temperatures (`None`), -30 from dBm to dBW. In kelvins or
    /// decibels; `None` if the two scales differ by more than their zero.
    pub fn shift(from: Option<Self>, to: Option<Self>) -> Option<f64> {
        match (from, to) {
            (a, b) if a == b => Some(0.0),
            (Some(Self::Celsius), None) => Some(CELSIUS_ZERO),
            (None, Some(Self::Celsius)) => Some(-CELSIUS_ZERO),
            (Some(a), Some(b)) if a.kind() == b.kind() => Some(a.height() - b.height()),
            _ => None,
        }
    }
}

/// What a plain number, or a number per time, counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Turn {
    /// Periods: in Hz.
    Periods,
    /// Angle: in rad, deg, rev, rad/s, rpm.
    Angle,
}
