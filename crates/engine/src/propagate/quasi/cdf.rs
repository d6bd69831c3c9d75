//! The distribution function of the quantity that is integrated exactly.

use std::f64::consts::PI;

use crate::distribution::Distribution;
use crate::number::elementary;
use crate::special;

/// A distribution function and its density.
pub(super) struct Cdf {
    location: f64,
    scale: f64,
    shape: CdfShape,
}

enum CdfShape {
    /// A tabulated symmetric distribution.
    Table(CdfTable),
    /// From -1 to 1.
    Rectangular,
    /// A triangle about 0 from minus the first to the second.
    Triangular(f64, f64),
    Arcsine,
    Lognormal,
    /// exp of a rectangular quantity.
    LogUniform,
    Exponential,
}

/// Distribution function and density over equal steps, with the cubic polynomial that has both at each
/// step: exact to 1e-11.
struct CdfTable {
    cells: Vec<[f64; 2]>,
    end: f64,
    tail: Box<dyn Fn(f64) -> [f64; 2] + Send + Sync>,
}

/// Steps in a scale.
const STEPS: f64 = 128.0;

impl CdfTable {
    fn new(end: f64, at: impl Fn(f64) -> [f64; 2] + Send + Sync + 'static) -> Self {
        let count = (2.0 * end * STEPS) as usize;
        let cells = (0..=count).map(|k| at(-end + k as f64 / STEPS)).collect();
        Self { cells, end, tail: Box::new(at) }
    }

    fn at(&self, x: f64) -> [f64; 2] {
        let position = (x + self.end) * STEPS;
        let cell = position as usize;
        if position.is_nan() || position < 0.0 || cell + 1 >= self.cells.len() {
            return (self.tail)(x);
        }
        let [a, b] = [self.cells[cell], self.cells[cell + 1]];
        let s = position - cell as f64;
        let step = 1.0 / STEPS;
        let rise = b[0] - a[0];
        let (from, to) = (step * a[1] - rise, rise - step * b[1]);
        let cdf = a[0] + s * rise + s * (1.0 - s) * ((1.0 - s) * from + s * to);
        let slope =
            rise + (1.0 - 2.0 * s) * ((1.0 - s) * from + s * to) + s * (1.0 - s) * (to - from);
        [cdf, slope * STEPS]
    }
}

fn normal(x: f64) -> [f64; 2] {
    [special::normal::cdf(x), elementary::exp(-0.5 * x * x) / (2.0 * PI).sqrt()]
}

impl Cdf {
    /// That of a distribution; `None` where it is not among those that are integrated.
    pub(super) fn of(distribution: &Distribution) -> Option<Self> {
        let mean = distribution.mean();
        let u = distribution.standard_uncertainty();
        let student = |scale: f64, dof: f64| {
            if dof >= 1e9 {
                return Self {
                    location: mean,
                    scale,
                    shape: CdfShape::Table(CdfTable::new(9.0, normal)),
                };
            }
            let half = 0.5 * dof;
            let constant = libm::lgamma(half + 0.5) - libm::lgamma(half);
            let constant = elementary::exp(constant) / (dof * PI).sqrt();
            let at = move |x: f64| {
                let density = elementary::exp(-(half + 0.5) * libm::log1p(x * x / dof));
                [special::student::cdf(x, dof), constant * density]
            };
            Self { location: mean, scale, shape: CdfShape::Table(CdfTable::new(20.0, at)) }
        };
        Some(match distribution {
            Distribution::Normal(_) | Distribution::StudentT(_) => {
                student(u, distribution.drawn_dof())
            }
            Distribution::Readings(readings) => {
                student(readings.drawn_scale(), distribution.drawn_dof())
            }
            Distribution::Rectangular(shape) if shape.dof_is_infinite() => {
                Self { location: mean, scale: u * 3f64.sqrt(), shape: CdfShape::Rectangular }
            }
            Distribution::Triangular(shape) => {
                let [rise, fall] = shape.exact_sides()?;
                let mode = mean - (fall - rise) / 3.0;
                Self { location: mode, scale: 1.0, shape: CdfShape::Triangular(rise, fall) }
            }
            Distribution::Arcsine(_) => {
                Self { location: mean, scale: u * 2f64.sqrt(), shape: CdfShape::Arcsine }
            }
            Distribution::Lognormal(shape) => {
                let [location, scale] = shape.of_logarithm();
                Self { location, scale, shape: CdfShape::Lognormal }
            }
            Distribution::LogUniform(_) => {
                let ends = [distribution.quantile(1e-300), distribution.quantile_upper(1e-300)];
                let [low, high] = ends.map(elementary::ln);
                Self {
                    location: 0.5 * (low + high),
                    scale: 0.5 * (high - low),
                    shape: CdfShape::LogUniform,
                }
            }
            Distribution::Exponential(_) => {
                Self { location: 0.0, scale: mean, shape: CdfShape::Exponential }
            }
            _ => return None,
        })
    }

    /// The probability of values up to `x`, and the density there.
    pub(super) fn at(&self, x: f64) -> [f64; 2] {
        let Self { location, scale, ref shape, .. } = *self;
        let s = (x - location) / scale;
        let of = |[cdf, density]: [f64; 2]| [cdf, density / scale];
        let uniform = |s: f64| {
            if s <= -1.0 {
                [0.0, 0.0]
            } else if s >= 1.0 {
                [1.0, 0.0]
            } else {
                [0.5 * (s + 1.0), 0.5]
            }
        };
        match shape {
            CdfShape::Table(table) => of(table.at(s)),
            CdfShape::Rectangular => of(uniform(s)),
            CdfShape::Triangular(rise, fall) => {
                let width = rise + fall;
                if s <= -rise {
                    [0.0, 0.0]
                } else if s >= *fall {
                    [1.0, 0.0]
                } else if s < 0.0 {
                    let from = s + rise;
                    [from * from / (width * rise), 2.0 * from / (width * rise)]
                } else {
                    let left = fall - s;
                    [1.0 - left * left / (width * fall), 2.0 * left / (width * fall)]
                }
            }
            CdfShape::Arcsine => {
                if s <= -1.0 {
                    [0.0, 0.0]
                } else if s >= 1.0 {
                    [1.0, 0.0]
                } else {
                    let root = ((1.0 - s) * (1.0 + s)).sqrt();
                    of([0.5 + elementary::asin(s) / PI, 1.0 / (PI * root)])
                }
            }
            CdfShape::Lognormal if x > 0.0 => {
                let [cdf, density] = normal((elementary::ln(x) - location) / scale);
                [cdf, density / (scale * x)]
            }
            CdfShape::LogUniform if x > 0.0 => {
                let [cdf, density] = uniform((elementary::ln(x) - location) / scale);
                [cdf, density / (scale * x)]
            }
            CdfShape::Exponential if s > 0.0 => {
                let left = elementary::exp(-s);
                of([-libm::expm1(-s), left])
            }
            CdfShape::Lognormal | CdfShape::LogUniform | CdfShape::Exponential => [0.0, 0.0],
        }
    }
}
