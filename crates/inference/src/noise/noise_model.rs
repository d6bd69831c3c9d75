//! What the noise of the data may be, other than stated.
//!
//! The commonest causes of a gap on a bench are no effects at all: uncertainties that are stated too
//! small, and a row that is wrong. A diagnosis that takes the stated noise for certain explains them
//! by whatever effect or discrepancy comes nearest. What the noise is therefore belongs to every
//! hypothesis: as stated, or with the uncertainties of each output multiplied by an unknown factor
//! (Birge 1932, Physical Review 40, 207), or with noise that the outputs of a row, neighbouring rows or
//! those of one setting share, or with single values off by many standard uncertainties.
//! Probabilities of effects are summed over it.

use crate::latent::{Map, Role};
use crate::noise::common_noise::CommonNoise;
use crate::noise::shared_noise::SharedNoise;
use crate::{Case, Prior};
use gumption_engine::number::elementary;

/// The factor on stated uncertainties is log-uniform between these.
pub(crate) const FACTORS: [f64; 2] = [0.25, 10.0];
/// The same where the data speak for more than that: a unit that was mistaken.
pub const FAR_FACTORS: [f64; 2] = [0.25, 1000.0];

/// Prior probability that the noise and the priors are as they are stated. It and those of all else
/// count relative to each other; what was not tried takes nothing from them.
const PRIOR_AS_STATED: f64 = 0.35;

/// Prior probability that stated uncertainties are off by a factor.
const PRIOR_FACTOR: f64 = 0.2;

/// Prior probability that they are off by one that may be beyond the usual ones.
const PRIOR_FAR_FACTOR: f64 = 0.01;

/// Prior probability that at least one value is off.
const PRIOR_SUSPECT: f64 = 0.15;

/// Prior probability that there is one more, once there is one.
const PRIOR_ANOTHER: f64 = 0.3;

/// Prior probability that neighbouring rows share noise.
const PRIOR_SERIAL: f64 = 0.25;

/// Prior probability that the rows of a setting share an error.
const PRIOR_SHARED: f64 = 0.1;

/// Prior probability that the outputs of a row share noise.
const PRIOR_COMMON: f64 = 0.1;

/// The prior odds of no gap are multiplied by this where the noise is not as stated. A diagnosis is
/// asked for where data depart; noise that is not as stated is a reason for that, after which there
/// is less need of an effect. With the usual priors no gap is then as probable as all else together.
const EXPLAINED_AWAY: f64 = 6.0;

/// Coefficients of correlation that are tried for it, equally probable beforehand.
pub(crate) const SERIAL: [f64; 4] = [0.3, 0.6, 0.8, 0.92];

/// The sizes of what is wrong with a value that is off, in standard uncertainties, with their prior
/// probabilities: mostly a reading that went wrong a little; a digit or the decimal point that was
/// typed wrong is off by any number of standard uncertainties.
pub(crate) const SUSPECT_SIZES: [(f64, f64); 6] =
    [(1e1, 0.9), (1e2, 0.02), (1e3, 0.02), (1e4, 0.02), (1e5, 0.02), (1e6, 0.02)];

/// A value that still is off by more than this, in standard uncertainties with what is wrong with it
/// included, is off by more than its size says.
pub(crate) const STILL_OFF: f64 = 3.0;

/// Values that are off, at most.
pub(crate) const MOST_SUSPECTS: usize = 5;

/// A value is suspected, or other priors are tried, where that may come to have this posterior
/// probability.
pub(crate) const WORTH_TRYING: f64 = 0.02;

/// A measured value that may be off: a row of the case and an observed output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Suspect {
    /// Its row, by the identity that copies of data share.
    pub id: usize,
    /// The observed output.
    pub output: usize,
    /// Place of the size of what is wrong with it.
    pub(crate) size: usize,
}

impl Suspect {
    /// Whether it is this value.
    pub fn is_of(&self, id: usize, output: usize) -> bool {
        (self.id, self.output) == (id, output)
    }

    /// The size of what is wrong with it, in standard uncertainties, and its prior probability.
    pub(crate) fn size(&self) -> (f64, f64) {
        SUSPECT_SIZES[self.size]
    }
}

/// A noise that the data may have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseModel {
    /// By which unknown factor stated uncertainties are multiplied, if they are.
    pub(crate) factor: Option<Factor>,
    /// The values that are off.
    pub suspects: Vec<Suspect>,
    /// The coefficient of correlation of the noise of neighbouring rows.
    pub serial: Option<f64>,
    /// The error that the rows of each setting share.
    pub shared: Option<SharedNoise>,
    /// The noise that the outputs of a row share.
    pub common: Option<CommonNoise>,
}

/// An unknown factor on stated uncertainties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// As stated uncertainties are off now and then.
    Usual,
    /// As of a unit that was mistaken.
    Far,
}

impl Factor {
    /// Its bounds.
    pub fn limits(self) -> [f64; 2] {
        match self {
            Self::Usual => FACTORS,
            Self::Far => FAR_FACTORS,
        }
    }

    /// What is known beforehand of its logarithm for an output.
    pub(crate) fn role(self, output: usize) -> Role {
        let [lower, upper] = self.limits();
        let map =
            Map::Uniform { lower: elementary::ln(lower), width: elementary::ln(upper / lower) };
        Role::Noise { output, map }
    }

    /// Its prior probability.
    fn prior(self) -> f64 {
        match self {
            Self::Usual => PRIOR_FACTOR,
            Self::Far => PRIOR_FAR_FACTOR,
        }
    }
}

/// A kind of noise that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnNoise {
    /// As it is stated.
    AsStated,
    /// Stated uncertainties are off by a factor.
    Factor,
    /// Neighbouring rows are correlated by this coefficient.
    Serial(f64),
    /// Single values are off.
    Off,
}

impl NoiseModel {
    /// Stated uncertainties with an unknown factor.
    pub(crate) fn with_factor(factor: Factor) -> Self {
        Self { factor: Some(factor), ..Self::default() }
    }

    /// With these values off.
    pub(crate) fn with_suspects(suspects: Vec<Suspect>) -> Self {
        Self { suspects, ..Self::default() }
    }

    /// With noise that neighbouring rows share in part.
    pub(crate) fn with_serial(coefficient: f64) -> Self {
        Self { serial: Some(coefficient), ..Self::default() }
    }

    /// With an error that the rows of each setting share.
    pub(crate) fn with_shared(noise: SharedNoise) -> Self {
        Self { shared: Some(noise), ..Self::default() }
    }

    /// With noise that the outputs of a row share.
    pub(crate) fn with_common(noise: CommonNoise) -> Self {
        Self { common: Some(noise), ..Self::default() }
    }

    /// What a value's standard uncertainty is multiplied by: a suspect is off by a normal quantity of
    /// its own.
    pub fn stretch(&self, id: usize, output: usize) -> f64 {
        let suspect = self.suspects.iter().find(|suspect| suspect.is_of(id, output));
        suspect.map_or(1.0, |suspect| elementary::hypot(1.0, suspect.size().0))
    }

    /// The prior probabilities of a case's hypotheses with it. Where no uncertainties are stated nobody
    /// has seen that the data depart by more than they should, and the noise is not as stated either.
    pub fn hypotheses(&self, case: &Case) -> Prior {
        let mut observed = case.observed.iter().flatten();
        let is_stated = observed.any(|output| output.standard_uncertainties.is_some());
        if is_stated && *self == Self::default() {
            case.prior
        } else {
            Self::other_than_stated(case.prior)
        }
    }

    /// The prior probabilities of hypotheses with a noise that is not as stated, from those with the
    /// noise as stated.
    pub fn other_than_stated(stated: Prior) -> Prior {
        let total = 1.0 + (EXPLAINED_AWAY - 1.0) * stated.none;
        let Prior { none, one, two, three, unexplained } = stated;
        Prior {
            none: EXPLAINED_AWAY * none / total,
            one: one / total,
            two: two / total,
            three: three / total,
            unexplained: unexplained / total,
        }
    }

    /// The noise at a uniform number between 0 and 1, from the prior probabilities of those that are
    /// weighed with data that state uncertainties or do not.
    pub fn drawn(stated: bool, uniform: f64) -> DrawnNoise {
        let as_stated = Self::default().prior(0);
        let [factor, serial] = if stated { [PRIOR_FACTOR, PRIOR_SERIAL] } else { [0.0; 2] };
        let place = uniform * (as_stated + factor + serial + PRIOR_SUSPECT);
        if place < as_stated {
            DrawnNoise::AsStated
        } else if place < as_stated + factor {
            DrawnNoise::Factor
        } else if place < as_stated + factor + serial {
            let share = (place - as_stated - factor) / serial;
            DrawnNoise::Serial(
                SERIAL[((share * SERIAL.len() as f64) as usize).min(SERIAL.len() - 1)],
            )
        } else {
            DrawnNoise::Off
        }
    }

    /// How many values are off, at most, and the probability that there is one more.
    pub fn suspects() -> (usize, f64) {
        (MOST_SUSPECTS, PRIOR_ANOTHER)
    }

    /// The size of what is wrong with a value that is off, in standard uncertainties, at a uniform
    /// number between 0 and 1.
    pub fn suspect_size(uniform: f64) -> f64 {
        let mut below = 0.0;
        let mut sizes = SUSPECT_SIZES.iter().map(|(size, prior)| {
            below += prior;
            (size, below)
        });
        sizes.find(|(_, below)| uniform < *below).map_or(SUSPECT_SIZES[0].0, |(size, _)| *size)
    }

    /// Its prior probability, for data of so many values.
    pub(crate) fn prior(&self, values: usize) -> f64 {
        if let Some(factor) = self.factor {
            return factor.prior();
        }
        if self.serial.is_some() {
            return PRIOR_SERIAL / SERIAL.len() as f64;
        }
        if let Some(shared) = &self.shared {
            return PRIOR_SHARED * shared.prior();
        }
        if let Some(common) = &self.common {
            return PRIOR_COMMON * common.share;
        }
        let mut prior = match self.suspects.len() {
            0 => return PRIOR_AS_STATED,
            _ => PRIOR_SUSPECT,
        };
        for more in 0..self.suspects.len() {
            // one of the sets of so many values
            prior *= (more + 1) as f64 / values.saturating_sub(more).max(1) as f64;
            prior *= if more == 0 { 1.0 - PRIOR_ANOTHER } else { PRIOR_ANOTHER };
        }
        self.suspects.iter().fold(prior, |prior, suspect| prior * suspect.size().1)
    }
}

/// The coefficient of correlation of two rows, the later one second.
pub(crate) fn lag(coefficient: f64, before: usize, here: usize) -> f64 {
    let gap = here.saturating_sub(before).max(1);
    (1..gap).fold(coefficient, |lag, _| lag * coefficient)
}
