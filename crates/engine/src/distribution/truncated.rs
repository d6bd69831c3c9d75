//! Any distribution truncated at limits of the quantity.

use super::Distribution;
use super::shape::{Invalid, Shape, finite};
use super::stream::Stream;
use crate::number::{COLUMN, Column, elementary};
use crate::special::tails::moments;

/// The smallest accepted probability within the limits, as a share of the numbers of which it is the
/// difference: four digits of it are left.
const LEAST: f64 = 1e-12;

/// A distribution truncated to the range between two limits. Its estimate and its standard
/// uncertainty are those of the truncated distribution, by quadrature; degrees of freedom are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Truncated {
    base: Box<Distribution>,
    lower: f64,
    upper: f64,
    /// The probabilities of the base below the lower and above the upper limit.
    below: f64,
    above: f64,
    /// The probability between them.
    left: f64,
    mean: f64,
    std: f64,
}

impl Truncated {
    /// A distribution between two limits, one of which may be infinite.
    ///
    /// # Errors
    /// Limits that are not in order, or that leave a probability below 1e-12, of the tail if both limits
    /// lie in one whose quantiles are known; a distribution that cannot be truncated: one without
    /// quantiles, a saved result, a constant.
    pub fn cut(base: Distribution, lower: f64, upper: f64) -> Result<Distribution, Invalid> {
        if lower.is_nan() || upper.is_nan() || lower >= upper {
            return Err(Invalid::LimitsReversed { lower, upper });
        }
        let out_of_range = |value| {
            let range = "such that the quantity can lie between them";
            Err(Invalid::OutOfRange { parameter: "limits", value, range })
        };
        match &base {
            Distribution::Samples(samples) => {
                let kept = samples.values().iter().filter(|x| **x >= lower && **x <= upper);
                return super::Samples::new(kept.copied().collect()).map(Distribution::from);
            }
            Distribution::Constant(constant) => {
                let value = constant.mean();
                let within = value >= lower && value <= upper;
                return if within { Ok(base) } else { out_of_range(lower) };
            }
            _ if !base.has_quantiles() || base.saved().is_some() => {
                let (value, range) = (lower, "left out: this distribution cannot be cut off");
                return Err(Invalid::OutOfRange { parameter: "limits", value, range });
            }
            _ => {}
        }
        let open = [
            lower == f64::NEG_INFINITY && has_no_variance(|p| base.quantile(p)),
            upper == f64::INFINITY && has_no_variance(|q| base.quantile_upper(q)),
        ];
        if open.contains(&true) {
            let range = "above 2 where a side has no limit, else what is left has no standard \
                         uncertainty: give both limits, or more readings";
            return Err(Invalid::OutOfRange { parameter: "dof", value: base.dof(), range });
        }
        let below = share(lower, |p| base.quantile(p));
        let above = share(-upper, |q| -base.quantile_upper(q));
        // in a tail the difference of two small probabilities
        let (left, tail) = if below > 0.5 {
            let tail = share(-lower, |q| -base.quantile_upper(q));
            (tail - above, Some(tail).filter(|_| is_resolved(|q| base.quantile_upper(q))))
        } else if above > 0.5 {
            let tail = share(upper, |p| base.quantile(p));
            (tail - below, Some(tail).filter(|_| is_resolved(|p| base.quantile(p))))
        } else {
            (1.0 - below - above, None)
        };
        if left <= LEAST * tail.unwrap_or(1.0) {
            return out_of_range(lower);
        }
        let mut made =
            Self { base: Box::new(base), lower, upper, below, above, left, mean: 0.0, std: 0.0 };
        let centre = made.quantile(0.5);
        let (mean, variance) =
            moments(|p| made.quantile(p) - centre, |q| made.quantile_upper(q) - centre);
        made.mean = finite("limits", centre + mean)?;
        made.std = finite("limits", variance.sqrt())?;
        if made.std > 0.0 { Ok(made.into()) } else { out_of_range(lower) }
    }

    /// The distribution before truncation.
    pub fn base(&self) -> &Distribution {
        &self.base
    }

    /// The limits.
    pub fn limits(&self) -> [f64; 2] {
        [self.lower, self.upper]
    }
}

/// Whether a quantile function has values of its own far out in its tail.
fn is_resolved(quantile: impl Fn(f64) -> f64) -> bool {
    quantile(1e-300) != quantile(1e-20)
}

/// Whether a tail is as long as that of a t distribution with 2 degrees of freedom, whose quantiles
/// grow with the square root of 1/p: its second moment is infinite, and the result of a quadrature
/// depends on where it ends.
fn has_no_variance(quantile: impl Fn(f64) -> f64) -> bool {
    let [near, far] = [1e-100, 1e-200].map(|p| quantile(p).abs());
    far.is_infinite() || elementary::log10(far / near) / 100.0 > 0.5 - 1e-6
}

/// The probability below a value, from a quantile function.
fn share(value: f64, quantile: impl Fn(f64) -> f64) -> f64 {
    const HALVINGS: u32 = 140;
    let (mut low, mut high) = (f64::MIN_POSITIVE, 1.0 - 0.5 * f64::EPSILON);
    if value <= quantile(low) {
        return 0.0;
    }
    if value >= quantile(high) {
        return 1.0;
    }
    // in the logarithm while the bracket is wide, so that a small tail has digits
    for _ in 0..HALVINGS {
        let middle =
            if high > 4.0 * low { low.sqrt() * high.sqrt() } else { 0.5 * low + 0.5 * high };
        if quantile(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

impl Shape for Truncated {
    const NAME: &'static str = "truncated";

    fn name(&self) -> &'static str {
        match self.base.name() {
            "normal" => "truncated normal",
            "t" => "truncated t",
            "readings" => "truncated readings",
            "rectangular" => "truncated rectangular",
            "triangular" => "truncated triangular",
            _ => Self::NAME,
        }
    }

    fn mean(&self) -> f64 {
        self.mean
    }

    fn standard_uncertainty(&self) -> f64 {
        self.std
    }

    fn dof(&self) -> f64 {
        self.base.dof()
    }

    fn quantile(&self, p: f64) -> f64 {
        let x = if self.below + p * self.left <= 0.5 {
            self.base.quantile(self.below + p * self.left)
        } else {
            self.base.quantile_upper(self.above + (1.0 - p) * self.left)
        };
        x.clamp(self.lower, self.upper)
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        let x = if self.above + q * self.left <= 0.5 {
            self.base.quantile_upper(self.above + q * self.left)
        } else {
            self.base.quantile(self.below + (1.0 - q) * self.left)
        };
        x.clamp(self.lower, self.upper)
    }

    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        stream.uniform(&mut out.0);
        for i in 0..COLUMN {
            out.0[i] = self.quantile(out.0[i]);
        }
    }

    /// The limits move along.
    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.mean;
        let base = self.base.moved_to(self.base.mean() + shift)?;
        let made = Self::cut(base, self.lower + shift, self.upper + shift)?;
        match made {
            Distribution::Truncated(truncated) => Ok(truncated),
            _ => Err(Invalid::NotFinite { parameter: "estimate", value: estimate }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Normal, Rectangular, StudentT};
    use crate::special::normal;

    /// A normal distribution with expectation 0.02 and standard deviation 0.05, truncated at 0:
    /// with a = -0.4, the inverse Mills ratio l = phi(a)/(1 - Phi(a)), expectation mu + s l,
    /// variance s^2 (1 + a l - l^2) (Johnson, Kotz, Balakrishnan, 13.10). The quadrature leaves
    /// 1e-10.
    #[test]
    fn a_normal_that_is_not_negative() {
        let of = Truncated::cut(Normal::new(0.02, 0.05).unwrap().into(), 0.0, f64::INFINITY);
        let of = of.unwrap();
        let a = -0.4;
        let phi = libm::exp(-0.5 * a * a) / (2.0 * std::f64::consts::PI).sqrt();
        let mills = phi / normal::sf(a);
        assert!((of.mean() - (0.02 + 0.05 * mills)).abs() < 1e-11);
        let std = 0.05 * (1.0 + a * mills - mills * mills).sqrt();
        assert!((of.standard_uncertainty() - std).abs() < 1e-10 * std);
        assert_eq!(of.name(), "truncated normal");
        assert!(of.quantile(1e-15) >= 0.0);
        assert!((of.quantile(0.5) - of.quantile_upper(0.5)).abs() < 1e-15);
    }

    #[test]
    fn a_rectangular_stays_one() {
        let base = Rectangular::between(0.0, 4.0).unwrap();
        let of = Truncated::cut(base.into(), 1.0, 3.0).unwrap();
        assert!((of.mean() - 2.0).abs() < 1e-12);
        assert!((of.standard_uncertainty() - 1.0 / 3.0_f64.sqrt()).abs() < 1e-10);
    }

    /// Far out in the tail of a t distribution: the truncated distribution begins at the limit and
    /// has a Pareto tail; with 5 degrees of freedom the density is proportional to x^-6, so that
    /// the mean is 5/4 of the limit to within (5/limit^2).
    #[test]
    fn a_tail_alone() {
        let base = StudentT::new(0.0, 1.0, 5.0).unwrap();
        let of = Truncated::cut(base.into(), 50.0, f64::INFINITY).unwrap();
        assert!((of.mean() / 62.5 - 1.0).abs() < 5.0 / 2500.0);
        assert_eq!(of.dof(), 5.0);
    }

    /// Limits in the tail of a standard normal distribution, where less than 1e-15 of it lies; mpmath
    /// with 40 digits from (phi(a) - phi(b))/(Q(a) - Q(b)) and the like. The quadrature leaves 1e-10.
    #[test]
    fn limits_far_out_in_a_tail() {
        for (lower, upper, mean, std) in [
            (20.0, 30.0, 20.049_753_068_527_851, 0.049_631_256_432_334_69),
            (8.0, 9.0, 8.121_188_992_979_797, 0.118_947_647_235_024_76),
            (-9.0, -8.0, -8.121_188_992_979_797, 0.118_947_647_235_024_76),
        ] {
            let of = Truncated::cut(Normal::new(0.0, 1.0).unwrap().into(), lower, upper).unwrap();
            assert!((of.mean() - mean).abs() < 1e-10 * std, "{lower}: {}", of.mean());
            let u = of.standard_uncertainty();
            assert!((u / std - 1.0).abs() < 1e-9, "{lower}: {u}");
        }
    }

    /// The second moment of a t distribution with 2 degrees of freedom or fewer is infinite unless
    /// both sides are truncated.
    #[test]
    fn tails_without_a_variance() {
        for dof in [1.0, 1.7, 2.0] {
            let base = || Distribution::from(StudentT::new(0.1, 0.01, dof).unwrap());
            for (lower, upper) in [(0.0, f64::INFINITY), (f64::NEG_INFINITY, 0.2)] {
                let refused = Truncated::cut(base(), lower, upper).unwrap_err();
                assert!(refused.to_string().contains("give both limits"), "{refused}");
            }
            assert!(Truncated::cut(base(), 0.0, 0.2).is_ok());
        }
        let three = StudentT::new(0.1, 0.01, 2.1).unwrap();
        assert!(Truncated::cut(three.into(), 0.0, f64::INFINITY).is_ok());
        let lognormal = crate::distribution::Lognormal::new(1.0, 2.0).unwrap();
        assert!(Truncated::cut(lognormal.into(), 1.0, f64::INFINITY).is_ok());
    }

    #[test]
    fn limits_that_leave_nothing() {
        let normal = || Distribution::from(Normal::new(0.0, 1.0).unwrap());
        assert!(Truncated::cut(normal(), 40.0, 50.0).is_err());
        assert!(Truncated::cut(normal(), 0.0, 1e-13).is_err());
        let flat = Distribution::from(Rectangular::between(0.0, 1.0).unwrap());
        assert!(Truncated::cut(flat, 1.0 - 1e-14, 2.0).is_err());
        assert!(Truncated::cut(normal(), 2.0, 1.0).is_err());
        assert!(Truncated::cut(normal(), f64::NAN, 1.0).is_err());
        let moved = Truncated::cut(normal(), -1.0, 2.0).unwrap().moved_to(10.0).unwrap();
        assert!((moved.mean() - 10.0).abs() < 1e-12);
    }
}
