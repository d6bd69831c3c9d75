//! The Gaussian copula: quantities with any distributions, drawn through joint standard normal ones
//! whose coefficients are fitted so that the quantities have the wanted coefficients.
//!
//! With x = g(z) in standard deviations from the mean, g = sum of c_k He_k(z) / sqrt(k!) in
//! Hermite's polynomials, two quantities whose normals have the coefficient r have the coefficient
//! sum of a_k b_k r^k (Mehler's formula; Lancaster, Biometrika 44, 1957). It rises with r from the
//! coefficient of antimonotone to that of comonotone quantities, which bound what any joint
//! distribution of the two can have (Hoeffding 1940; Frechet 1951). Such a fit is the NORTA method
//! (Cario and Nelson, Operations Research Letters 19, 1996).

use super::profile::Profile;

/// Maximum number of terms of Hermite's series, for profiles of up to 32 768 nodes.
const MOST_TERMS: usize = 512;

/// Maximum of nodes times terms: a profile in many pieces consists of many small steps, for which
/// few terms suffice.
const MOST_WORK: usize = 1 << 24;

/// The series ends when the rest of the variance is below this, and two successive coefficients
/// are negligible.
const COMPLETE: f64 = 1e-10;

/// A coefficient below this is negligible; every other one of a symmetric distribution is 0.
const NEGLIGIBLE: f64 = 1e-13;

/// Rounding by which a coefficient may lie beyond a limit.
const ROUNDING: f64 = 1e-9;

/// Steps of the search: the interval of r, 2 wide, shrinks to neighbouring doubles at 1.
const STEPS: usize = 56;

/// Data of one quantity for the fit.
#[derive(Clone, Copy, Debug)]
pub(super) enum Margin<'a> {
    /// Normal: the quantity is its own standard normal one.
    Normal,
    /// Any other.
    Shaped {
        profile: &'a Profile,
        /// Hermite's coefficients, from the first.
        terms: &'a [f64],
    },
}

/// The coefficients c_1, c_2, ... of a profile.
pub(super) fn hermite(profile: &Profile) -> Vec<f64> {
    // Hermite functions He_k(z) sqrt(phi(z) / k!) stay bounded; the other half of the density
    // multiplies the values
    let (mut points, mut factors, mut current) = (Vec::new(), Vec::new(), Vec::new());
    for (z, weight, value) in profile.pieces().iter().flat_map(|piece| piece.nodes()) {
        let root = super::profile::density(z).sqrt();
        points.push(z);
        factors.push(weight * root * value);
        current.push(root);
    }
    let mut before = vec![0.0; points.len()];
    let mut terms: Vec<f64> = Vec::new();
    let mut rest = profile.variance;
    for k in 0..MOST_TERMS.min(MOST_WORK / points.len().max(1)) {
        let (down, up) = ((k as f64).sqrt(), 1.0 / (k as f64 + 1.0).sqrt());
        let mut coefficient = 0.0;
        for i in 0..points.len() {
            let next = (points[i] * current[i] - down * before[i]) * up;
            before[i] = current[i];
            current[i] = next;
            coefficient += factors[i] * next;
        }
        terms.push(coefficient);
        rest -= coefficient * coefficient;
        let small = terms.iter().rev().take(2).all(|c| c.abs() < NEGLIGIBLE);
        if rest <= COMPLETE && small {
            break;
        }
    }
    terms
}

/// Two quantities, and the relation between their coefficient and that of their normal scores.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    terms: Vec<f64>,
    /// The coefficients of comonotone and antimonotone quantities.
    highest: f64,
    lowest: f64,
    /// What tails beyond the range of doubles may add to either.
    beyond: f64,
}

impl Pair {
    pub(super) fn new(a: &Margin<'_>, b: &Margin<'_>) -> Self {
        let of_normal = |linear: f64| Self {
            terms: vec![linear],
            highest: linear,
            lowest: -linear,
            beyond: 0.0,
        };
        match (a, b) {
            (Margin::Normal, Margin::Normal) => of_normal(1.0),
            (Margin::Normal, Margin::Shaped { terms, .. })
            | (Margin::Shaped { terms, .. }, Margin::Normal) => {
                of_normal(terms.first().copied().unwrap_or(1.0))
            }
            (
                Margin::Shaped { profile: a, terms: of_a },
                Margin::Shaped { profile: b, terms: of_b },
            ) => {
                let missing = |profile: &Profile| (1.0 - profile.variance).max(0.0);
                let beyond = (missing(a) * missing(b)).sqrt();
                Self {
                    terms: of_a.iter().zip(*of_b).map(|(c, d)| c * d).collect(),
                    highest: a.comonotone(b),
                    lowest: a.antimonotone(b),
                    beyond: if beyond > ROUNDING { beyond } else { 0.0 },
                }
            }
        }
    }

    /// The coefficients that are possible for the two quantities.
    pub(super) fn attainable(&self) -> [f64; 2] {
        let slack = self.beyond + ROUNDING;
        [(self.lowest - slack).max(-1.0), (self.highest + slack).min(1.0)]
    }

    /// The coefficient of the quantities if their normal scores have the coefficient `r`.
    pub(super) fn of_normals(&self, r: f64) -> f64 {
        let (mut power, mut sum, mut at_one) = (1.0, 0.0, 0.0);
        let sign = 1f64.copysign(r);
        let mut signs = 1.0;
        for term in &self.terms {
            power *= r;
            signs *= sign;
            sum += term * power;
            at_one += term * signs;
        }
        let limit = if r < 0.0 { self.lowest } else { self.highest };
        sum + (limit - at_one) * remainder(self.terms.len(), r.abs())
    }

    /// The coefficient of the normal scores for that of the quantities; `None` if it is not
    /// attainable.
    pub(super) fn fit(&self, coefficient: f64) -> Option<f64> {
        let [least, most] = self.attainable();
        if !(least..=most).contains(&coefficient) {
            return None;
        }
        if let [linear] = self.terms.as_slice() {
            return Some((coefficient / linear).clamp(-1.0, 1.0));
        }
        if coefficient == 0.0 {
            return Some(0.0);
        }
        // the search is on the half-axis of the coefficient
        let (mut near, mut far) = (0.0, 1f64.copysign(coefficient));
        if coefficient >= self.highest || coefficient <= self.lowest {
            return Some(far);
        }
        for _ in 0..STEPS {
            let middle: f64 = 0.5 * (near + far);
            if (self.of_normals(middle) < coefficient) == (coefficient > 0.0) {
                near = middle;
            } else {
                far = middle;
            }
        }
        Some(0.5 * (near + far))
    }
}

/// The rest of the series after `count` terms at `r` >= 0, as a fraction of its value at 1, if the
/// terms decrease as k^(-3/2), as those of a step do: with x = -count ln r, the integral from 1 of
/// exp(-x t) t^(-3/2) / 2. For smooth quantities the rest is zero here.
fn remainder(count: usize, r: f64) -> f64 {
    if r == 0.0 {
        return 0.0;
    }
    let x = (-(count as f64) * libm::log(r)).max(0.0);
    let rest = libm::exp(-x) - (std::f64::consts::PI * x).sqrt() * libm::erfc(x.sqrt());
    rest.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::special::{normal, student};

    fn standard_deviation(variance: f64) -> f64 {
        variance.sqrt()
    }

    fn rectangular() -> Profile {
        profile(0.0, 1.0 / 3f64.sqrt(), |z| {
            if z < 0.0 { 2.0 * normal::cdf(z) - 1.0 } else { 1.0 - 2.0 * normal::sf(z) }
        })
    }

    fn exponential() -> Profile {
        profile(1.0, 1.0, |z| {
            if z < 0.0 { -libm::log1p(-normal::cdf(z)) } else { -libm::log(normal::sf(z)) }
        })
    }

    fn lognormal(sigma: f64) -> Profile {
        let mean = libm::exp(0.5 * sigma * sigma);
        let std = mean * standard_deviation(libm::expm1(sigma * sigma));
        profile(mean, std, move |z| libm::exp(sigma * z))
    }

    fn t(dof: f64) -> Profile {
        profile(0.0, standard_deviation(dof / (dof - 2.0)), move |z| {
            let t = student::quantile(normal::cdf(-z.abs()), dof);
            if z < 0.0 { t } else { -t }
        })
    }

    fn sign() -> Profile {
        profile(0.0, 1.0, |z| if z < 0.0 { -1.0 } else { 1.0 })
    }

    fn profile(mean: f64, std: f64, value: impl Fn(f64) -> f64) -> Profile {
        Profile::new(mean, std, value).0
    }

    fn pair(a: &Profile, b: &Profile) -> Pair {
        let (of_a, of_b) = (hermite(a), hermite(b));
        let shaped = |profile, terms| Margin::Shaped { profile, terms };
        Pair::new(&shaped(a, &of_a), &shaped(b, &of_b))
    }

    const COEFFICIENTS: [f64; 9] = [-0.999, -0.9, -0.5, -0.01, 0.1, 0.5, 0.8, 0.99, 0.9999];

    /// Two rectangular quantities: (6 / pi) asin(r / 2) (Pearson 1907).
    #[test]
    fn rectangulars_have_their_closed_form() {
        let profile = rectangular();
        let pair = pair(&profile, &profile);
        for r in COEFFICIENTS {
            let exact = 6.0 / std::f64::consts::PI * libm::asin(0.5 * r);
            assert!((pair.of_normals(r) - exact).abs() < 1e-11, "{r}: {}", pair.of_normals(r));
            assert!((pair.fit(exact).unwrap() - r).abs() < 1e-10, "{r}");
        }
        assert_eq!(pair.fit(1.0), Some(1.0));
        assert_eq!(pair.fit(-1.0), Some(-1.0));
    }

    /// Two lognormal quantities: (exp(s t r) - 1) / sqrt((exp(s^2) - 1)(exp(t^2) - 1)), limits at r
    /// = 1, -1.
    #[test]
    fn lognormals_have_their_closed_form() {
        for (s, t) in [(0.1, 0.1), (0.7, 0.3), (1.0, 2.0), (2.5, 0.5)] {
            let (a, b) = (lognormal(s), lognormal(t));
            let pair = pair(&a, &b);
            let scale = standard_deviation(libm::expm1(s * s) * libm::expm1(t * t));
            for r in COEFFICIENTS {
                let exact = libm::expm1(s * t * r) / scale;
                let found = pair.of_normals(r);
                assert!((found - exact).abs() < 1e-10, "{s}, {t}, {r}: {found}, {exact}");
            }
            let [least, most] = pair.attainable();
            assert!(
                (most - (libm::expm1(s * t) / scale).min(1.0)).abs() < 2e-9,
                "{s}, {t}: {most}"
            );
            assert!((least - libm::expm1(-s * t) / scale).abs() < 2e-9, "{s}, {t}: {least}");
            assert!(pair.fit(most + 1e-6).is_none() && pair.fit(least - 1e-6).is_none());
        }
    }

    /// With a normal, the limit is the mean of z g(z): sqrt(3 / pi) for a rectangular quantity,
    /// 0.903197 for an exponential one (a 40-digit integral of z (-ln(1 - Phi(z))) phi(z)), and two
    /// exponentials have 1 and 1 - pi^2 / 6.
    #[test]
    fn limits_of_known_pairs() {
        let (rectangular, exponential) = (rectangular(), exponential());
        let with_normal = |profile: &Profile| {
            let terms = hermite(profile);
            Pair::new(&Margin::Normal, &Margin::Shaped { profile, terms: &terms }).attainable()
        };
        let exact = (3.0 / std::f64::consts::PI).sqrt();
        assert!((with_normal(&rectangular)[1] - exact).abs() < 2e-9);
        assert!((with_normal(&exponential)[1] - 0.903_197).abs() < 1e-6);
        let [least, most] = pair(&exponential, &exponential).attainable();
        assert!((most - 1.0).abs() < 2e-9, "{most}");
        assert!((least - (1.0 - std::f64::consts::PI.powi(2) / 6.0)).abs() < 2e-9, "{least}");
        assert_eq!(Pair::new(&Margin::Normal, &Margin::Normal).fit(0.3), Some(0.3));
    }

    /// Two signs: (2 / pi) asin(r) (Sheppard 1899), the slowest series. 1e-5 is the remaining error
    /// of the 512 terms after the correction for the rest.
    #[test]
    fn steps_have_their_closed_form() {
        let profile = sign();
        let pair = pair(&profile, &profile);
        for r in COEFFICIENTS {
            let exact = 2.0 / std::f64::consts::PI * libm::asin(r);
            let found = pair.of_normals(r);
            assert!((found - exact).abs() < 1e-5, "{r}: {found}, {exact}");
        }
    }

    /// A hundred thousand equal steps, as in an empirical distribution, equal a rectangular
    /// distribution to 1e-6.
    #[test]
    fn many_steps_are_nearly_smooth() {
        let steps = profile(0.0, 1.0 / 3f64.sqrt(), |z| {
            let n = 1e5;
            ((normal::cdf(z) * n).ceil().clamp(1.0, n) - 0.5) / n * 2.0 - 1.0
        });
        let pair = pair(&steps, &steps);
        for r in COEFFICIENTS {
            let exact = 6.0 / std::f64::consts::PI * libm::asin(0.5 * r);
            assert!((pair.of_normals(r) - exact).abs() < 1e-6, "{r}: {}", pair.of_normals(r));
        }
        assert!((pair.attainable()[1] - 1.0).abs() < 1e-6);
    }

    /// Heavy tails: two t quantities with the same degrees of freedom can have 1 and -1, and the
    /// coefficient is an odd, never decreasing function of that of the normal scores.
    #[test]
    fn heavy_tails_rise() {
        for dof in [2.02, 2.1, 3.0, 5.0, 30.0] {
            let profile = t(dof);
            let pair = pair(&profile, &profile);
            let [least, most] = pair.attainable();
            assert!((most - 1.0).abs() < 1e-8 && (least + 1.0).abs() < 1e-8, "{dof}: {most}");
            let mut last = -2.0;
            for i in -1000..=1000 {
                let found = pair.of_normals(f64::from(i) / 1000.0);
                assert!(found > last, "{dof} at {i}: {found} after {last}");
                last = found;
            }
            for coefficient in [-0.7, 0.2, 0.95] {
                let r = pair.fit(coefficient).unwrap();
                assert!((pair.of_normals(r) - coefficient).abs() < 1e-12, "{dof}, {coefficient}");
            }
        }
    }
}
