//! Why quantities cannot be drawn with the declared correlations.

use std::fmt;

use super::Correlation;

/// Maximum number of coefficients listed in a message.
const LISTED: usize = 12;

/// Why quantities with these correlations cannot be drawn.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CorrelationError {
    /// More dependent quantities than the limit: their matrix has a number for each pair.
    TooMany {
        /// Their number.
        count: usize,
        /// The largest possible number.
        most: usize,
    },
    /// The coefficients of these quantities contradict each other: their matrix is not positive
    /// semi-definite.
    Contradiction {
        /// The quantities.
        members: Vec<usize>,
        /// The lowest eigenvalue of their matrix.
        eigenvalue: f64,
        /// The nearest possible coefficients that differ from the declared ones.
        nearest: Vec<Correlation>,
        /// Number of decimals of the coefficients.
        decimals: usize,
    },
    /// Each pair of these quantities can have its coefficient, but a Gaussian copula cannot produce
    /// all of them together.
    BeyondCopula {
        /// The quantities.
        members: Vec<usize>,
        /// The nearest coefficients that the copula can produce, if they differ.
        nearest: Vec<Correlation>,
        /// Number of decimals of the coefficients.
        decimals: usize,
    },
    /// No joint distribution of the two quantities has this coefficient.
    OutOfReach {
        /// The declared coefficient.
        declared: Correlation,
        /// The lowest and the highest coefficient that is possible for them.
        attainable: [f64; 2],
    },
    /// A correlated quantity has no variance, so that the coefficient does not exist.
    NoVariance {
        /// The quantity.
        member: usize,
        /// The degrees of freedom with which it is drawn; infinite if they are not the reason.
        dof: f64,
    },
    /// A correlated quantity with unknown quantiles, which a copula cannot draw.
    NoQuantiles {
        /// The quantity.
        member: usize,
    },
    /// Paired readings whose number of partners differs from the declared one.
    Unpaired {
        /// The quantity.
        member: usize,
        /// Number of paired quantities with that number of readings.
        count: usize,
    },
    /// A coefficient is declared for a parameter of a calibration function, whose joint
    /// distribution follows from its fit.
    GivenByFit {
        /// The parameter.
        member: usize,
        /// The other quantity.
        other: usize,
    },
    /// A coefficient is declared for paired readings, whose joint distribution follows from their
    /// sample.
    GivenByReadings {
        /// The quantity with paired readings.
        member: usize,
        /// The other one.
        other: usize,
        /// Whether the other one is paired with it.
        paired: bool,
    },
}

impl CorrelationError {
    /// Whether the error concerns only trials: the law of propagation needs only the standard
    /// uncertainties of the quantities and the coefficient (JCGM 100, 5.2.2).
    pub fn is_of_trials(&self) -> bool {
        matches!(self, Self::NoVariance { .. } | Self::NoQuantiles { .. })
    }

    /// Whether a declared coefficient is involved in the error.
    pub fn concerns(&self, c: &Correlation) -> bool {
        let of = |member: usize| c.first == member || c.second == member;
        match self {
            Self::Contradiction { members, .. } | Self::BeyondCopula { members, .. } => {
                members.contains(&c.first) && members.contains(&c.second)
            }
            Self::OutOfReach { declared, .. } => of(declared.first) && of(declared.second),
            Self::NoVariance { member, .. } | Self::NoQuantiles { member } => of(*member),
            Self::GivenByReadings { member, other, .. } | Self::GivenByFit { member, other } => {
                of(*member) && of(*other)
            }
            Self::TooMany { .. } | Self::Unpaired { .. } => false,
        }
    }

    /// The sentence, with the names of the quantities.
    pub fn describe(&self, name: &dyn Fn(usize) -> String) -> String {
        let names =
            |members: &[usize]| members.iter().map(|&m| name(m)).collect::<Vec<_>>().join(", ");
        match self {
            Self::TooMany { count, most } => format!(
                "{count} quantities are correlated with each other; this version takes {most} at \
                 most"
            ),
            Self::Contradiction { members, eigenvalue, nearest, decimals } => format!(
                "the correlation coefficients of {} contradict each other: no quantities can have \
                 them all (their matrix is not positive semi-definite, its lowest eigenvalue is \
                 {eigenvalue:.2}); the nearest possible coefficients are {}",
                names(members),
                list(nearest, *decimals, name)
            ),
            Self::BeyondCopula { members, nearest, decimals } => format!(
                "a Gaussian copula cannot give {} these correlation coefficients all at once with \
                 their distributions; the nearest that it can give are {}",
                names(members),
                list(nearest, *decimals, name)
            ),
            Self::OutOfReach { declared, attainable: [least, most] } => format!(
                "the correlation coefficient of {} and {} is {}, but two quantities with their \
                 distributions can have one from {} to {} only",
                name(declared.first),
                name(declared.second),
                declared.coefficient,
                toward_zero(*least),
                toward_zero(*most)
            ),
            Self::NoVariance { member, dof } if dof.is_finite() => format!(
                "{} is drawn from a t distribution with {dof} degrees of freedom, which has no \
                 variance, so that a correlation coefficient of it does not exist",
                name(*member)
            ),
            Self::NoVariance { member, .. } => format!(
                "{} has no variance, so that a correlation coefficient of it does not exist",
                name(*member)
            ),
            Self::NoQuantiles { member } => format!(
                "{} is drawn by a function of its own whose quantiles are not known, so that it \
                 cannot be correlated; give them as well (`External::with_quantile`)",
                name(*member)
            ),
            Self::Unpaired { member, count } => format!(
                "{} has paired readings; the number of paired inputs with readings of equal \
                 length must be as it states, but it is {count}",
                name(*member)
            ),
            Self::GivenByFit { member, other } => format!(
                "{} is a parameter of a calibration function, whose fit gives its correlations, \
                 so that no correlation with {} can be declared",
                name(*member),
                name(*other)
            ),
            Self::GivenByReadings { member, other, paired: true } => format!(
                "the correlation of {} and {} is given twice: by their paired readings and by a \
                 declared coefficient; take one of them out",
                name(*member),
                name(*other)
            ),
            Self::GivenByReadings { member, other, paired: false } => format!(
                "{} is drawn together with the readings that it is paired with, so that it cannot \
                 have a declared correlation with {} as well",
                name(*member),
                name(*other)
            ),
        }
    }
}

/// `a`-`b` 0.83, `a`-`c` -0.38
fn list(coefficients: &[Correlation], decimals: usize, name: &dyn Fn(usize) -> String) -> String {
    let listed = coefficients.iter().take(LISTED).map(|c| {
        // no negative zero
        let r = if c.coefficient.abs() < 0.5 * unit(decimals) { 0.0 } else { c.coefficient };
        format!("{}-{} {r:.decimals$}", name(c.first), name(c.second))
    });
    let mut text = listed.collect::<Vec<_>>().join(", ");
    if coefficients.len() > LISTED {
        text.push_str(", and others");
    }
    text
}

/// One unit of the last decimal.
pub(super) fn unit(decimals: usize) -> f64 {
    (0..decimals).fold(1.0, |unit, _| unit / 10.0)
}

/// Four decimals, truncated, so that the printed limit can be used.
fn toward_zero(limit: f64) -> String {
    // a limit of 1 results from an integral as 1 up to rounding
    let cut = (limit.abs() * 1e4 + 1e-4).floor() / 1e4;
    format!("{}", cut.copysign(limit))
}

impl fmt::Display for CorrelationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.describe(&|member| format!("quantity {}", member + 1)))
    }
}

impl std::error::Error for CorrelationError {}
