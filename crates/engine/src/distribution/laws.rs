//! Distributions that are not in JCGM 101: drawn by `rand_distr`, with the moments and quantiles of
//! `statrs`.
//!
//! The random words come from the input's stream. The two crates apply logarithms and powers of the
//! platform to them, so that last digits may differ between platforms and between versions of the
//! crates.

use rand_distr::Distribution as _;
use statrs::distribution::ContinuousCDF;
use statrs::statistics::Distribution as Moments;

use super::External;
use super::shape::{Invalid, finite, positive};
use super::stream::StreamRng;

/// The largest number of trials, and the largest population: sums of doubles are exact only up to
/// such numbers.
const MOST_COUNTED: u64 = 1 << 40;

/// The error for parameters that a crate rejects although they passed the checks: they are too
/// large or too small.
fn refused(parameter: &'static str, value: f64) -> Invalid {
    Invalid::OutOfRange { parameter, value, range: "one that double precision can compute with" }
}

/// A whole number from 0 to `most`.
fn whole(
    parameter: &'static str,
    value: u64,
    most: u64,
    range: &'static str,
) -> Result<u64, Invalid> {
    if value <= most {
        Ok(value)
    } else {
        Err(Invalid::OutOfRange { parameter, value: value as f64, range })
    }
}

impl External {
    /// A Weibull distribution: `shape` > 0, `scale` > 0 in the unit of the quantity; the
    /// probability of values below the scale is 1 - 1/e.
    ///
    /// # Errors
    /// Parameters that are not positive, or a shape so small that the variance overflows.
    pub fn weibull(shape: f64, scale: f64) -> Result<Self, Invalid> {
        let (shape, scale) = (positive("shape", shape)?, positive("scale", scale)?);
        let refused = || refused("shape", shape);
        let law = statrs::distribution::Weibull::new(shape, 1.0).map_err(|_| refused())?;
        let drawn = rand_distr::Weibull::new(1.0, shape).map_err(|_| refused())?;
        Self::at("weibull", law, [0.0, scale], move |random| drawn.sample(random))
    }

    /// A Gumbel distribution of largest values: `location` is the mode, `scale` > 0, both in the unit of
    /// the quantity.
    ///
    /// # Errors
    /// A scale that is not above zero, parameters that are not finite.
    pub fn gumbel(location: f64, scale: f64) -> Result<Self, Invalid> {
        let (location, scale) = (finite("location", location)?, positive("scale", scale)?);
        let refused = || refused("scale", scale);
        let law = statrs::distribution::Gumbel::new(0.0, 1.0).map_err(|_| refused())?;
        let drawn = rand_distr::Gumbel::new(0.0, 1.0).map_err(|_| refused())?;
        Self::at("gumbel", law, [location, scale], move |random| drawn.sample(random))
    }

    /// A Pareto distribution: `scale` > 0, the smallest value, in the unit of the quantity; the
    /// probability of values above x is (scale/x)^shape.
    ///
    /// # Errors
    /// A scale that is not positive; a shape that is not above 2, for which there is no variance.
    pub fn pareto(shape: f64, scale: f64) -> Result<Self, Invalid> {
        let (shape, scale) = (positive("shape", shape)?, positive("scale", scale)?);
        if shape <= 2.0 {
            let range = "above 2, as there is no variance otherwise";
            return Err(Invalid::OutOfRange { parameter: "shape", value: shape, range });
        }
        let refused = || refused("shape", shape);
        let law = statrs::distribution::Pareto::new(1.0, shape).map_err(|_| refused())?;
        let drawn = rand_distr::Pareto::new(1.0, shape).map_err(|_| refused())?;
        Self::at("pareto", law, [0.0, scale], move |random| drawn.sample(random))
    }

    /// A chi-squared distribution of `dof` > 0 degrees of freedom.
    ///
    /// # Errors
    /// Degrees of freedom that are not above zero.
    pub fn chi_squared(dof: f64) -> Result<Self, Invalid> {
        let dof = positive("dof", dof)?;
        let law = statrs::distribution::ChiSquared::new(dof).map_err(|_| refused("dof", dof))?;
        let drawn = rand_distr::ChiSquared::new(dof).map_err(|_| refused("dof", dof))?;
        Self::at("chi-squared", law, [0.0, 1.0], move |random| drawn.sample(random))
    }

    /// The number of successes among `trials` (up to 2^40), each with the given `probability`,
    /// between 0 and 1. It cannot be correlated, because its quantiles are steps.
    ///
    /// # Errors
    /// A probability of 0 or 1 or outside this range, zero trials or too many.
    pub fn binomial(trials: u64, probability: f64) -> Result<Self, Invalid> {
        let whole = whole("trials", trials, MOST_COUNTED, "at most 2^40")?;
        if !(probability > 0.0 && probability < 1.0) {
            let range = "between 0 and 1";
            return Err(Invalid::OutOfRange {
                parameter: "probability",
                value: probability,
                range,
            });
        }
        let refused = || refused("probability", probability);
        let law = statrs::distribution::Binomial::new(probability, whole).map_err(|_| refused())?;
        let drawn = rand_distr::Binomial::new(whole, probability).map_err(|_| refused())?;
        Self::counted("binomial", &law, move |random| drawn.sample(random))
    }

    /// The number of marked items among `draws` from a `population` (up to 2^40) with `marked`
    /// marked ones, without replacement. It cannot be correlated, because its quantiles are steps.
    ///
    /// # Errors
    /// More marked items or draws than the population has; a number without uncertainty.
    pub fn hypergeometric(population: u64, marked: u64, draws: u64) -> Result<Self, Invalid> {
        let population = whole("population", population, MOST_COUNTED, "at most 2^40")?;
        let within = "at most the population";
        let marked = whole("marked", marked, population, within)?;
        let draws = whole("draws", draws, population, within)?;
        let refused = || refused("population", population as f64);
        let law = statrs::distribution::Hypergeometric::new(population, marked, draws);
        let law = law.map_err(|_| refused())?;
        let drawn = rand_distr::Hypergeometric::new(population, marked, draws);
        let drawn = drawn.map_err(|_| refused())?;
        Self::counted("hypergeometric", &law, move |random| drawn.sample(random))
    }

    /// A law with location 0 and scale 1, moved to a location and a scale.
    fn at<L>(
        name: &'static str,
        law: L,
        [location, scale]: [f64; 2],
        drawn: impl Fn(&mut StreamRng) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid>
    where
        L: ContinuousCDF<f64, f64> + Moments<f64> + Send + Sync + 'static,
    {
        let [mean, std] = moments(&law);
        let drawn = move |random: &mut StreamRng| location + scale * drawn(random);
        let made = Self::known(name, [location + scale * mean, scale * std], drawn)?;
        Ok(made.with_known_quantile(move |p| location + scale * law.inverse_cdf(p)))
    }

    /// A law of whole numbers.
    fn counted(
        name: &'static str,
        law: &impl Moments<f64>,
        drawn: impl Fn(&mut StreamRng) -> u64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid> {
        Self::known(name, moments(law), move |random| drawn(random) as f64)
    }
}

/// Mean and standard deviation.
fn moments(law: &impl Moments<f64>) -> [f64; 2] {
    let none = |moment: Option<f64>| moment.unwrap_or(f64::NAN);
    [none(law.mean()), none(law.variance()).sqrt()]
}
