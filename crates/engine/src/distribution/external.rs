//! Distributions from other crates: `rand_distr`, `statrs`, or a user's function.

use std::fmt;
use std::sync::Arc;

use super::shape::{Invalid, Shape, finite, positive};
use super::stream::{Stream, StreamRng};
use crate::number::{COLUMN, Column};

/// Number of draws compared with the stated parameters.
const COMPARED: usize = 1 << 14;

/// Largest allowed deviation of the draws' mean and variance from the stated ones, in standard
/// errors.
const MOST_ERRORS: f64 = 20.0;

/// Kurtosis of draws above which their variance does not determine that of the distribution.
const LONG_TAILS: f64 = 50.0;

type Draw = dyn Fn(&mut StreamRng) -> f64 + Send + Sync;
type Quantile = dyn Fn(f64) -> f64 + Send + Sync;

/// A distribution that another crate draws from, with its mean and its standard deviation.
///
/// ```
/// use gumption_engine::distribution::{External, Input};
/// use rand_distr::{Distribution, Gumbel};
///
/// // location 10, scale 2: mean 10 + 2 * 0.577216 (Euler's constant), standard deviation
/// // 2 pi / sqrt(6)
/// let gumbel = Gumbel::new(10.0, 2.0)?;
/// let highest = External::new("gumbel", 11.154_431_329_803, 2.565_099_660_324, move |random| {
///     gumbel.sample(random)
/// })?;
/// let highest = highest.with_quantile(|p| 10.0 - 2.0 * (-p.ln()).ln())?;
/// let level = Input::new(highest, "m")?;
/// assert_eq!(level.distribution.name(), "gumbel");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Trials are drawn from the stream of the input, so they are repeatable like all others. The
/// random words are the same everywhere; the values depend on the version of the crate that draws.
/// Without [`External::with_quantile`] such an input cannot be correlated, and pages do not show
/// its density.
#[derive(Clone)]
pub struct External {
    name: &'static str,
    mean: f64,
    std: f64,
    /// Offset added to the drawn values.
    shift: f64,
    draw: Arc<Draw>,
    quantile: Option<Arc<Quantile>>,
}

impl External {
    /// A distribution with this name (for budgets), mean and standard deviation (> 0, finite), and
    /// the function that draws a value. The same words must give the same value.
    ///
    /// # Errors
    /// The mean or the standard deviation is not finite, or the standard deviation is not positive;
    /// draws are not finite, or their mean is not the stated one: 16,384 draws are made, whose mean
    /// may deviate by 0.16 standard deviations, 20 times its standard error. Their variance may
    /// also deviate by at most 20 times its standard error (22 % for a normal distribution), unless
    /// the tails are too long to determine it (a kurtosis above 50).
    pub fn new(
        name: &'static str,
        mean: f64,
        std: f64,
        draw: impl Fn(&mut StreamRng) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid> {
        let made = Self::known(name, [mean, std], draw)?;
        // relative to the stated mean, so that a large one does not cost digits
        let count = COMPARED as f64;
        let offsets: Vec<f64> = made.compared()?.into_iter().map(|value| value - mean).collect();
        let offset = offsets.iter().sum::<f64>() / count;
        let found = mean + offset;
        if (found - mean).abs() > MOST_ERRORS * std / count.sqrt() {
            return Err(Invalid::NotOfDraws { parameter: "mean", stated: mean, found });
        }
        // in units of the stated standard deviation, whose square may overflow
        let squares = offsets.iter().map(|value| {
            let z = (value - offset) / std;
            z * z
        });
        let variance = squares.clone().sum::<f64>() / count;
        let kurtosis = squares.map(|z| z * z).sum::<f64>() / (count * variance * variance);
        let error = ((kurtosis - 1.0) / count).sqrt() * variance.max(1.0);
        let misses = kurtosis <= LONG_TAILS && (variance - 1.0).abs() > MOST_ERRORS * error;
        // equal draws have no kurtosis
        if misses || variance == 0.0 {
            let found = std * variance.sqrt();
            return Err(Invalid::NotOfDraws { parameter: "std", stated: std, found });
        }
        Ok(made)
    }

    /// The same with its quantile function: the value below which a drawn value lies with
    /// probability p, 0 < p < 1. Correlated inputs are drawn through it, and pages show the
    /// corresponding density.
    ///
    /// # Errors
    /// Quartiles or a median that are not finite, or that do not divide 16,384 draws correctly to
    /// within 10 times the standard error of the fraction.
    pub fn with_quantile(
        self,
        quantile: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid> {
        let drawn = self.compared()?;
        for p in [0.25, 0.5, 0.75] {
            let value = finite("quantile", quantile(p))?;
            let below = drawn.iter().filter(|drawn| **drawn <= value).count();
            let found = below as f64 / COMPARED as f64;
            if (found - p).abs() > 10.0 * (p * (1.0 - p) / COMPARED as f64).sqrt() {
                return Err(Invalid::NotOfDraws { parameter: "quantile", stated: p, found });
            }
        }
        Ok(self.with_known_quantile(quantile))
    }

    /// The same for a distribution whose draws are known to have this mean and standard deviation.
    pub(super) fn known(
        name: &'static str,
        [mean, std]: [f64; 2],
        draw: impl Fn(&mut StreamRng) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid> {
        let (mean, std) = (finite("mean", mean)?, positive("std", std)?);
        Ok(Self { name, mean, std, shift: 0.0, draw: Arc::new(draw), quantile: None })
    }

    /// With a quantile function that is known to match the draws.
    pub(super) fn with_known_quantile(
        self,
        quantile: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { quantile: Some(Arc::new(quantile)), ..self }
    }

    /// A distribution of `rand_distr` (`drawn`) with mean, standard deviation and quantiles of the
    /// matching distribution of `statrs` (`law`). The parameters of the two crates are not always
    /// in the same order; draws that do not follow the law are an error.
    ///
    /// # Errors
    /// The errors of [`External::new`] and [`External::with_quantile`]; a law without mean or
    /// standard deviation.
    pub fn of_law<L>(
        name: &'static str,
        law: L,
        drawn: impl Fn(&mut StreamRng) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, Invalid>
    where
        L: statrs::distribution::ContinuousCDF<f64, f64>
            + statrs::statistics::Distribution<f64>
            + Send
            + Sync
            + 'static,
    {
        let [mean, std] = [law.mean(), law.std_dev()].map(|moment| moment.unwrap_or(f64::NAN));
        Self::new(name, mean, std, drawn)?.with_quantile(move |p| law.inverse_cdf(p))
    }

    /// Whether its quantiles are known.
    pub fn has_quantiles(&self) -> bool {
        self.quantile.is_some()
    }

    /// Values of a fixed stream.
    fn compared(&self) -> Result<Vec<f64>, Invalid> {
        let mut random = StreamRng::new(1, "external");
        (0..COMPARED).map(|_| finite("draw", self.shift + (self.draw)(&mut random))).collect()
    }
}

impl fmt::Debug for External {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, mean, std, shift, .. } = self;
        f.debug_struct("External")
            .field("name", name)
            .field("mean", mean)
            .field("std", std)
            .field("shift", shift)
            .finish_non_exhaustive()
    }
}

/// Clones are equal unless one of them is moved; two functions cannot be compared.
impl PartialEq for External {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.draw, &other.draw) && self.mean == other.mean
    }
}

impl Shape for External {
    const NAME: &'static str = "external";

    fn name(&self) -> &'static str {
        self.name
    }

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    /// NaN if it is not known.
    fn quantile(&self, p: f64) -> f64 {
        self.quantile.as_ref().map_or(f64::NAN, |quantile| self.shift + quantile(p))
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        let mut random = StreamRng::of(stream.clone());
        for i in 0..COLUMN {
            out.0[i] = self.shift + (self.draw)(&mut random);
        }
        *stream = random.into_stream();
    }

    /// All values are shifted.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let mean = finite("estimate", estimate)?;
        Ok(Self { mean, shift: self.shift + (mean - self.mean), ..self.clone() })
    }
}
