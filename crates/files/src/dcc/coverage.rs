//! Coverage factors and coverage probabilities: which factor a distribution has, and whether a factor and
//! a probability that are stated together can belong together.

use gumption_engine::decimal::{Decimal, rounded};
use gumption_engine::number::elementary;
use gumption_engine::special::normal;
use gumption_engine::special::student::two_sided_factor;
use gumption_text::named_shape::NamedShape;

/// A number with half a unit of its last written digit.
#[derive(Clone, Copy, Debug)]
pub(super) struct WrittenNumber {
    value: f64,
    half_digit: f64,
}

impl WrittenNumber {
    /// A number; `last_digit` is what one in its last digit is.
    pub(super) fn new(value: f64, last_digit: f64) -> Self {
        Self { value, half_digit: 0.5 * last_digit }
    }

    /// The ends of what is written so.
    fn ends(self) -> [f64; 2] {
        [self.value - self.half_digit, self.value + self.half_digit]
    }
}

/// The coverage factor of a distribution with limits at a coverage probability; `None` for others.
///
/// With half-width a it is P(|x| < U) = U/a of the rectangular, 1 - (1 - U/a)^2 of the triangular, and
/// 2/pi asin(U/a) of the arcsine distribution, whose standard deviations are a over the roots of 3, 6 and 2.
pub(super) fn limited(shape: Option<NamedShape>, p: f64) -> Option<f64> {
    match shape? {
        NamedShape::Known("rectangular") => Some(3.0_f64.sqrt() * p),
        NamedShape::Known("triangular") => Some(6.0_f64.sqrt() * (1.0 - (1.0 - p).sqrt())),
        NamedShape::Known("arcsine") => {
            Some(2.0_f64.sqrt() * elementary::sin(0.5 * std::f64::consts::PI * p))
        }
        _ => None,
    }
}

/// The coverage factor that belongs to a coverage probability.
pub(super) fn of_probability_alone(shape: Option<NamedShape>, p: f64) -> f64 {
    limited(shape, p).unwrap_or_else(|| two_sided_factor(p, f64::INFINITY))
}

/// The distributions with limits, of which one that is not named may be.
const LIMITED: [NamedShape; 3] = [
    NamedShape::Known("rectangular"),
    NamedShape::Known("triangular"),
    NamedShape::Known("arcsine"),
];

/// A stated factor beside a stated probability.
///
/// # Errors
/// They cannot belong together, to the digits that they are written with.
pub(super) fn factor(
    k: WrittenNumber,
    p: WrittenNumber,
    shape: Option<NamedShape>,
) -> Result<f64, String> {
    let is_right = match shape {
        Some(NamedShape::Unknown) => true,
        // all of a distribution with limits can lie within U if its probability is 1
        _ if p.value == 1.0 => return within_limits(k, shape),
        Some(NamedShape::Student) => reaches(k, p),
        Some(shape) if limited(Some(shape), p.value).is_some() => is_of(k, p, Some(shape)),
        Some(_) => is_of(k, p, shape) || is_approximate(k, p),
        None => return of_nothing_named(k, p),
    };
    if is_right { Ok(k.value) } else { Err(contradiction(k, p, shape)) }
}

/// A factor beside a probability, where no distribution is named: that of a normal or of a t distribution.
///
/// # Errors
/// It is that of another one, or of several, or of none, to the digits of the factor.
fn of_nothing_named(k: WrittenNumber, p: WrittenNumber) -> Result<f64, String> {
    let exact = WrittenNumber { half_digit: 0.0, ..p };
    let is_normal = is_of(k, exact, None) || is_approximate(k, p);
    // a whole factor is chosen, and no quantile of a t distribution
    let is_t = !is_normal && k.value.fract() != 0.0 && k.value > factors(exact, None)[0];
    let limited = LIMITED.iter().filter(|shape| is_of(k, exact, Some(**shape)));
    let limited: Vec<&str> = limited.filter_map(|shape| shape.name()).collect();
    let open = [(is_normal, "normal"), (is_t, "t")];
    let open: Vec<&str> = open.into_iter().filter(|(is, _)| *is).map(|(_, name)| name).collect();
    if limited.is_empty() {
        return if open.is_empty() { Err(contradiction(k, p, None)) } else { Ok(k.value) };
    }
    let all: Vec<String> = open.iter().chain(&limited).map(|name| format!("`{name}`")).collect();
    let normal = match open.as_slice() {
        [] => format!("; a normal one has {}", rounded(of_probability_alone(None, p.value), -2)),
        _ => String::new(),
    };
    Err(format!(
        "has a coverage factor of {} and a coverage probability of {} and names no distribution: they are \
         those of a distribution {}{normal}. Say by `\"law\"` which it is, such as `\"law\": \"{}\"`, or ask",
        k.value,
        p.value,
        gumption_units::listed(&all, " or "),
        limited[0]
    ))
}

/// The factors of the probability of a distribution, from and to.
fn factors(p: WrittenNumber, shape: Option<NamedShape>) -> [f64; 2] {
    let most = if limited(shape, 1.0).is_some() { 1.0 } else { 1.0 - 1e-12 };
    p.ends().map(|p| of_probability_alone(shape, p.clamp(1e-6, most)))
}

/// The factors that are written so: a whole one is chosen, and not rounded.
fn stated(k: WrittenNumber) -> [f64; 2] {
    let tiny = 1e-9 * k.value;
    let [low, high] = if k.value.fract() == 0.0 { [k.value; 2] } else { k.ends() };
    [low - tiny, high + tiny]
}

/// Whether the factor is that of the probability, of a normal distribution where none is named.
fn is_of(k: WrittenNumber, p: WrittenNumber, shape: Option<NamedShape>) -> bool {
    let ([low, high], [least, most]) = (stated(k), factors(p, shape));
    high >= least && low <= most
}

/// Whether the factor is that of a t distribution, which is larger than that of a normal one, or as large.
fn reaches(k: WrittenNumber, p: WrittenNumber) -> bool {
    stated(k)[1] >= factors(p, None)[0] || is_approximate(k, p)
}

/// Whether a whole factor is beside the probability that a normal distribution has for it approximately:
/// 2 beside 95 % (EA-4/02 M:2022), 3 beside 99 %; within one unit of the last digit, and one per cent.
fn is_approximate(k: WrittenNumber, p: WrittenNumber) -> bool {
    const MOST: f64 = 0.01;
    let digit = Decimal::shortest(p.value)
        .map_or(0.0, |decimal| Decimal::new(1, decimal.position()).value());
    let covered = 1.0 - 2.0 * normal::sf(k.value);
    k.value.fract() == 0.0 && (covered - p.value).abs() <= digit.min(MOST)
}

/// A factor beside the probability 1, of a distribution with limits.
fn within_limits(k: WrittenNumber, shape: Option<NamedShape>) -> Result<f64, String> {
    match limited(shape, 1.0) {
        Some(least) if stated(k)[1] < least => Err(format!(
            "has a coverage factor of {} and a coverage probability of 1, while its distribution reaches \
             {least:.4} standard uncertainties: ask which is right",
            k.value
        )),
        _ => Ok(k.value),
    }
}

/// That factor and probability do not belong together, with the factor that does.
fn contradiction(k: WrittenNumber, p: WrittenNumber, shape: Option<NamedShape>) -> String {
    let (name, at_least) = match shape {
        Some(NamedShape::Known(name)) => (name, ""),
        Some(NamedShape::Student) => ("t", "at least "),
        Some(NamedShape::Unknown) | None => ("normal", ""),
    };
    let own = rounded(of_probability_alone(shape, p.value), -2);
    format!(
        "has a coverage factor of {} and a coverage probability of {}, which do not belong together: the \
         factor of a {name} distribution is {at_least}{own} at that probability; ask which is right",
        k.value, p.value
    )
}
