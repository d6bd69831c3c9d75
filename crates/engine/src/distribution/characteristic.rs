//! Characteristic functions of the distributions that have one in closed form, with the data for an
//! inversion: a bound that never increases, and the distance of the quantity from its mean.

use std::f64::consts::{FRAC_2_PI, PI};

use super::Distribution;
use super::Samples;
use super::result::SavedResult;
use crate::number::elementary;
use crate::special::{self, legendre};

/// A complex number, as real and imaginary part.
pub(crate) type Complex = [f64; 2];

/// The product of two complex numbers.
#[inline(always)]
pub(crate) fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Probabilities below this are negligible.
pub(crate) const NEGLIGIBLE: f64 = 1e-17;

/// Degrees of freedom from which a t distribution is drawn as a normal distribution.
const AS_GOOD_AS_NORMAL: f64 = 1e9;

/// The characteristic function E exp(i t (X - mean)) of a distribution. If there is no mean, the
/// middle replaces it.
#[derive(Clone, Debug)]
pub(crate) enum Characteristic {
    Normal {
        std: f64,
    },
    Student(Student),
    /// A sum of two rectangular quantities of these half-widths, whose width is multiplied by a
    /// factor uniformly distributed within `share` of 1: rectangle, triangle, trapezoid, and all of
    /// them with an inexact width.
    Trapezoid {
        wide: f64,
        narrow: f64,
        share: f64,
    },
    /// Distances from the mode to the limits.
    Triangle {
        rise: f64,
        fall: f64,
    },
    Arcsine {
        half_width: f64,
    },
    Gamma {
        shape: f64,
        rate: f64,
    },
    /// Values minus their mean, and their probabilities.
    Points(Vec<[f64; 2]>),
}

/// A t distribution as normal ones of different widths: X = scale Z / sqrt(W), where nu W is chi-squared.
/// With W = e^v the density of v goes as exp(-nu/2 (e^v - 1 - v)), and the trapezoidal rule over v,
/// of an analytic function that vanishes at both ends, is exact to rounding.
#[derive(Clone, Debug)]
pub(crate) struct Student {
    scale: f64,
    dof: f64,
    /// e^-v / 2 and weight.
    nodes: Vec<[f64; 2]>,
}

impl Student {
    fn new(scale: f64, dof: f64) -> Self {
        let half = 0.5 * dof;
        // a strip of half-width pi/2 about the real axis: the error is e^(-pi^2/step)
        let step = f64::min(0.2, 0.6 / half.sqrt());
        let exponent = |v: f64| half * (libm::expm1(v) - v);
        let mut nodes = Vec::new();
        for direction in [-1.0, 1.0] {
            let mut k = if direction < 0.0 { 1.0 } else { 0.0 };
            loop {
                let v = direction * step * k;
                let weight = exponent(v);
                if weight > 41.0 {
                    break;
                }
                nodes.push([0.5 * elementary::exp(-v), elementary::exp(-weight)]);
                k += 1.0;
            }
        }
        let sum: f64 = nodes.iter().map(|[_, weight]| weight).sum();
        for node in &mut nodes {
            node[1] /= sum;
        }
        Self { scale, dof, nodes }
    }

    /// Degrees of freedom.
    pub(crate) fn dof(&self) -> f64 {
        self.dof
    }

    fn at(&self, t: f64) -> f64 {
        let square = (self.scale * t) * (self.scale * t);
        let term = |&[rate, weight]: &[f64; 2]| {
            let exponent = square * rate;
            if exponent > 60.0 { 0.0 } else { weight * elementary::exp(-exponent) }
        };
        self.nodes.iter().map(term).sum()
    }
}

/// The distance of a quantity from its mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reach {
    /// Never farther than this.
    Bounded(f64),
    /// The probability of a larger distance is negligible.
    Light(f64),
    /// So far that no grid can hold it; the number is its scale.
    Heavy(f64),
}

impl Characteristic {
    /// For a distribution; `None` if there is no closed form.
    pub(crate) fn of(distribution: &Distribution) -> Option<Self> {
        let student = |scale: f64, dof: f64| {
            if dof < AS_GOOD_AS_NORMAL {
                Self::Student(Student::new(scale, dof))
            } else {
                Self::Normal { std: scale }
            }
        };
        Some(match distribution {
            Distribution::Normal(_) | Distribution::StudentT(_) => {
                student(distribution.standard_uncertainty(), distribution.drawn_dof())
            }
            Distribution::Readings(readings) => {
                student(readings.drawn_scale(), distribution.drawn_dof())
            }
            Distribution::Rectangular(shape) => shape.characteristic(),
            Distribution::Triangular(shape) => return shape.characteristic(),
            Distribution::Trapezoidal(shape) => shape.characteristic(),
            Distribution::CurvilinearTrapezoid(shape) => shape.characteristic(),
            Distribution::Arcsine(_) => {
                Self::Arcsine { half_width: distribution.standard_uncertainty() * 2f64.sqrt() }
            }
            Distribution::Exponential(_) => {
                Self::Gamma { shape: 1.0, rate: 1.0 / distribution.mean() }
            }
            Distribution::Gamma(gamma) => gamma.characteristic(),
            Distribution::PoissonCount(_) => Self::Gamma { shape: distribution.mean(), rate: 1.0 },
            Distribution::Samples(samples) => Self::Points(points(samples)),
            Distribution::SavedResult(saved) => Self::Points(saved_points(saved)),
            _ => return None,
        })
    }

    /// For a multiple of a t quantity.
    pub(crate) fn student(scale: f64, dof: f64) -> Self {
        Self::Student(Student::new(scale, dof))
    }

    /// The value at t.
    pub(crate) fn at(&self, t: f64) -> Complex {
        match self {
            Self::Normal { std } => {
                let x = std * t;
                [elementary::exp(-0.5 * x * x), 0.0]
            }
            Self::Student(student) => [student.at(t), 0.0],
            Self::Trapezoid { wide, narrow, share } => [trapezoid(*wide, *narrow, *share, t), 0.0],
            Self::Triangle { rise, fall } => triangle(*rise, *fall, t),
            Self::Arcsine { half_width } => [libm::j0(half_width * t), 0.0],
            Self::Gamma { shape, rate } => gamma(*shape, t / rate),
            Self::Points(points) => {
                let mut sum = [0.0; 2];
                for &[value, weight] in points {
                    let (sin, cos) = elementary::sin_cos(t * value);
                    sum[0] += weight * cos;
                    sum[1] += weight * sin;
                }
                sum
            }
        }
    }

    /// An upper bound of the modulus at `t` > 0 and beyond.
    pub(crate) fn bound(&self, t: f64) -> f64 {
        match self {
            Self::Normal { .. } | Self::Student(_) => self.at(t)[0],
            Self::Trapezoid { wide, narrow, share } => {
                let least = (1.0 - share) * t;
                let of = |width: f64| f64::min(1.0, 1.0 / (width * least));
                let exact = of(*wide) * of(*narrow);
                // averaged over the widths of a rectangle, the sines cancel as well: by parts
                let averaged = 2.0 / (wide * least * share * wide * t);
                if *share > 0.0 && *narrow == 0.0 { exact.min(averaged) } else { exact }
            }
            Self::Triangle { rise, fall } => {
                let width = rise + fall;
                let straight = 4.0 / (rise * t) / (fall * t);
                let steep = 4.0 / (width * t) + 8.0 / (width * t).powi(2);
                f64::min(1.0, straight.min(steep))
            }
            Self::Arcsine { half_width } => f64::min(1.0, (FRAC_2_PI / (half_width * t)).sqrt()),
            Self::Gamma { shape, rate } => {
                let s = t / rate;
                elementary::exp(-0.5 * shape * libm::log1p(s * s))
            }
            Self::Points(_) => 1.0,
        }
    }

    /// The distance of the quantity from its mean.
    pub(crate) fn reach(&self) -> Reach {
        match self {
            Self::Normal { std } => Reach::Light(8.7 * std),
            Self::Student(student) => {
                let far = -special::student::quantile(NEGLIGIBLE, student.dof);
                if far < 30.0 {
                    Reach::Light(far * student.scale)
                } else {
                    Reach::Heavy(student.scale)
                }
            }
            Self::Trapezoid { wide, narrow, share } => {
                Reach::Bounded((wide + narrow) * (1.0 + share))
            }
            Self::Triangle { rise, fall } => {
                let mean = (fall - rise) / 3.0;
                Reach::Bounded(f64::max(rise + mean, fall - mean))
            }
            Self::Arcsine { half_width } => Reach::Bounded(*half_width),
            Self::Gamma { shape, rate } => {
                let high = special::gamma::quantile_upper(NEGLIGIBLE, *shape) - shape;
                Reach::Light(high.max((*shape).min(9.0 * shape.sqrt())) / rate)
            }
            Self::Points(points) => {
                Reach::Bounded(points.iter().map(|[value, _]| value.abs()).fold(0.0, f64::max))
            }
        }
    }

    /// The variance; infinite if it does not exist.
    pub(crate) fn variance(&self) -> f64 {
        match self {
            Self::Normal { std } => std * std,
            Self::Student(Student { scale, dof, .. }) if *dof > 2.0 => {
                scale * scale * (dof / (dof - 2.0))
            }
            Self::Student(_) => f64::INFINITY,
            Self::Trapezoid { wide, narrow, share } => {
                (wide * wide + narrow * narrow) / 3.0 * (1.0 + share * share / 3.0)
            }
            Self::Triangle { rise, fall } => (rise * rise + rise * fall + fall * fall) / 18.0,
            Self::Arcsine { half_width } => 0.5 * half_width * half_width,
            Self::Gamma { shape, rate } => shape / rate / rate,
            Self::Points(points) => {
                points.iter().map(|[value, weight]| weight * value * value).sum()
            }
        }
    }

    /// A measure of its width that always exists.
    pub(crate) fn width(&self) -> f64 {
        match self {
            Self::Student(student) => student.scale,
            other => other.variance().sqrt(),
        }
    }

    /// Whether the density is symmetric and decreases from the middle: then the density of any sum
    /// of such quantities does so too (Wintner 1938).
    pub(crate) fn is_symmetric_unimodal(&self) -> bool {
        matches!(self, Self::Normal { .. } | Self::Student(_) | Self::Trapezoid { .. })
    }

    /// Approximate cost of one value, in evaluations of an exponential or a sine.
    pub(crate) fn cost(&self) -> usize {
        match self {
            Self::Student(student) => student.nodes.len(),
            Self::Points(points) => points.len(),
            Self::Trapezoid { share, .. } if *share > 0.0 => 20,
            _ => 1,
        }
    }
}

/// sin(x)/x
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { elementary::sin(x) / x }
}

fn trapezoid(wide: f64, narrow: f64, share: f64, t: f64) -> f64 {
    let at = |factor: f64| {
        let second = if narrow == 0.0 { 1.0 } else { sinc(narrow * factor * t) };
        sinc(wide * factor * t) * second
    };
    if share == 0.0 {
        return at(1.0);
    }
    let (least, most) = (1.0 - share, 1.0 + share);
    let panels = ((wide + narrow) * t * (most - least) / 16.0).ceil().max(1.0);
    let width = (most - least) / panels;
    let mut sum = 0.0;
    for panel in 0..panels as usize {
        sum += legendre::integrate(least + panel as f64 * width, width, at);
    }
    sum / (most - least)
}

/// With h(x) = (1 + i x - e^(i x))/x^2, about the mode: 2 (rise h(-t rise) + fall h(t fall)) / (rise + fall).
fn triangle(rise: f64, fall: f64, t: f64) -> Complex {
    let h = |x: f64| {
        let half = 0.5 * sinc(0.5 * x) * sinc(0.5 * x);
        let odd = if x.abs() < 1.0 {
            // (x - sin x)/x^2
            let square = x * x;
            let mut sum = 1.0;
            for k in (2..=9_u8).rev() {
                let k = f64::from(k);
                sum = 1.0 - sum * square / ((2.0 * k) * (2.0 * k + 1.0));
            }
            x / 6.0 * sum
        } else {
            (x - elementary::sin(x)) / (x * x)
        };
        [half, odd]
    };
    let (low, high) = (h(t * rise), h(t * fall));
    let share = 2.0 / (rise + fall);
    let about_mode =
        [share * (rise * low[0] + fall * high[0]), share * (fall * high[1] - rise * low[1])];
    let (sin, cos) = elementary::sin_cos(-t * (fall - rise) / 3.0);
    product(about_mode, [cos, sin])
}

/// (1 - i s)^-shape e^(-i s shape)
fn gamma(shape: f64, s: f64) -> Complex {
    let modulus = elementary::exp(-0.5 * shape * libm::log1p(s * s));
    if modulus == 0.0 {
        return [0.0; 2];
    }
    let bend = if s.abs() < 0.1 {
        // atan(s) - s
        let square = s * s;
        let mut sum = 0.0;
        for k in (1..=9_u8).rev() {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sum = sum * square + sign / f64::from(2 * k + 1);
        }
        s * square * sum
    } else {
        elementary::atan(s) - s
    };
    let (sin, cos) = elementary::sin_cos(shape * bend);
    [modulus * cos, modulus * sin]
}

fn points(samples: &Samples) -> Vec<[f64; 2]> {
    let (values, n) = (samples.values(), samples.values().len() as f64);
    let origin = values[values.len() / 2];
    let offset = values.iter().map(|value| value - origin).sum::<f64>() / n;
    values.iter().map(|value| [value - origin - offset, 1.0 / n]).collect()
}

/// Points that represent the quantile function of a saved result: three in each of its cells, by
/// Gauss's rule, and the point masses at its ends.
fn saved_points(saved: &SavedResult) -> Vec<[f64; 2]> {
    const THREE: [[f64; 2]; 3] = [
        [0.112_701_665_379_258_31, 5.0 / 18.0],
        [0.5, 8.0 / 18.0],
        [0.887_298_334_620_741_69, 5.0 / 18.0],
    ];
    let scores = saved.scores();
    let end = scores.from + (scores.count - 1) as f64 * scores.step;
    let mean = saved.drawn_mean();
    let mut points = vec![
        [saved.at(scores.from) - mean, special::normal::cdf(scores.from)],
        [saved.at(end) - mean, special::normal::sf(end)],
    ];
    let scale = scores.step / (2.0 * PI).sqrt();
    for cell in 0..scores.count - 1 {
        for [place, weight] in THREE {
            let z = scores.from + (cell as f64 + place) * scores.step;
            let density = scale * elementary::exp(-0.5 * z * z);
            points.push([saved.at(z) - mean, weight * density]);
        }
    }
    points
}
