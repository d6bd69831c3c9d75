//! The defining constants of the SI, which formulas name in brackets.

use gumption_units::Dimension;

/// A defining constant of the SI; its value is exact (SI Brochure, 9th ed., table 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DefiningConstant {
    /// The speed of light in vacuum.
    LightSpeed,
    /// The Planck constant.
    Planck,
    /// The elementary charge.
    ElementaryCharge,
    /// The Boltzmann constant.
    Boltzmann,
    /// The Avogadro constant.
    Avogadro,
}

impl DefiningConstant {
    const ALL: [Self; 5] =
        [Self::LightSpeed, Self::Planck, Self::ElementaryCharge, Self::Boltzmann, Self::Avogadro];

    /// The constant with that symbol.
    pub(super) fn named(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|constant| constant.symbol() == symbol)
    }

    /// The symbol.
    pub(super) fn symbol(self) -> &'static str {
        match self {
            Self::LightSpeed => "c",
            Self::Planck => "h",
            Self::ElementaryCharge => "e",
            Self::Boltzmann => "k_B",
            Self::Avogadro => "N_A",
        }
    }

    /// The value in coherent SI units.
    pub(super) fn value(self) -> f64 {
        match self {
            Self::LightSpeed => 299_792_458.0,
            Self::Planck => 6.626_070_15e-34,
            Self::ElementaryCharge => 1.602_176_634e-19,
            Self::Boltzmann => 1.380_649e-23,
            Self::Avogadro => 6.022_140_76e23,
        }
    }

    /// The dimension.
    pub(super) fn dimension(self) -> Dimension {
        Dimension::of(match self {
            Self::LightSpeed => [0, 1, -1, 0, 0, 0, 0],
            Self::Planck => [1, 2, -1, 0, 0, 0, 0],
            Self::ElementaryCharge => [0, 0, 1, 1, 0, 0, 0],
            Self::Boltzmann => [1, 2, -2, 0, -1, 0, 0],
            Self::Avogadro => [0, 0, 0, 0, 0, -1, 0],
        })
    }
}

/// A constant that formulas name in brackets.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct ExactConstant {
    /// Its symbol, without the brackets.
    pub symbol: &'static str,
    /// Its exact value in the coherent SI unit of its dimension.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// What it is.
    pub about: &'static str,
}

/// The defining constants of the SI (SI Brochure, 9th ed., table 1).
pub fn constants() -> impl Iterator<Item = ExactConstant> {
    DefiningConstant::ALL.into_iter().map(|constant| ExactConstant {
        symbol: constant.symbol(),
        value: constant.value(),
        dimension: constant.dimension(),
        about: match constant {
            DefiningConstant::LightSpeed => "the speed of light in vacuum",
            DefiningConstant::Planck => "the Planck constant",
            DefiningConstant::ElementaryCharge => "the elementary charge",
            DefiningConstant::Boltzmann => "the Boltzmann constant",
            DefiningConstant::Avogadro => "the Avogadro constant",
        },
    })
}
