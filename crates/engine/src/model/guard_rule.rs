//! Guard bands that have names: functions of half of the tolerance T and of the expanded uncertainty U
//! for approximately 95 %, so that a value is accepted up to A = T - w on either side of the middle.

use crate::number::elementary;

/// A guard band with a name. All of them need two tolerance limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuardRule {
    /// A = sqrt(T^2 - U^2), the root difference of squares (Deaver, Guardbanding with confidence, NCSL
    /// 1994).
    Rss,
    /// A = 1.25 T - U where U is above a quarter of T, and A = T otherwise (NCSL RP-10, as in Deaver 1994).
    Rp10,
    /// A = T - M U with M = 1.04 - exp(0.38 ln(T/U) - 0.54), and A = T where M is below 0: a global risk
    /// of false acceptance of at most 2 % whatever items come (Dobbert, NCSL International 2008;
    /// ANSI/NCSL Z540.3 handbook, method 6).
    Dobbert,
}

impl GuardRule {
    /// All rules.
    pub const ALL: [Self; 3] = [Self::Rss, Self::Rp10, Self::Dobbert];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rss => "rss",
            Self::Rp10 => "rp-10",
            Self::Dobbert => "dobbert",
        }
    }

    /// The name in texts.
    pub fn title(self) -> &'static str {
        match self {
            Self::Rss => "RSS",
            Self::Rp10 => "NCSL RP-10",
            Self::Dobbert => "Dobbert, ANSI/NCSL Z540.3 method 6",
        }
    }

    /// The width w as a formula of T and U, as texts have it.
    pub fn formula(self) -> &'static str {
        match self {
            Self::Rss => "T - sqrt(T^2 - U^2)",
            Self::Rp10 => "U - T/4",
            Self::Dobbert => "U (1.04 - exp(0.38 ln(T/U) - 0.54))",
        }
    }

    /// The rule with that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// The width of the guard band for half of a tolerance and an expanded uncertainty; `None` where the
    /// rule has none, which accepts no value.
    pub fn width(self, half_tolerance: f64, expanded: f64) -> Option<f64> {
        let (t, u) = (half_tolerance, expanded);
        let width = match self {
            // without the loss of digits of T - sqrt(T^2 - U^2)
            Self::Rss => u * u / (t + ((t - u) * (t + u)).sqrt()),
            Self::Rp10 => u - 0.25 * t,
            Self::Dobbert => u * (1.04 - libm::exp(0.38 * elementary::ln(t / u) - 0.54)),
        };
        (!width.is_nan()).then(|| width.max(0.0))
    }
}
