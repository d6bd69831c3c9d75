//! What a certificate's statements of uncertainty make known of one value: standard uncertainty, degrees
//! of freedom and shape.

use super::coverage::{self, WrittenNumber, limited, of_probability_alone};
use super::document::{Measured, StatedUncertainties, at};
use super::{agreement, intervals};
use gumption_engine::number::of_percent;
use gumption_text::implied_dof::Factor;
use gumption_text::named_shape::NamedShape;

/// What is known of one value.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownValue {
    pub(super) standard: f64,
    pub(super) dof: f64,
    pub(super) shape: Option<NamedShape>,
    /// What the expanded uncertainty was divided by.
    pub(super) factor: f64,
}

impl KnownValue {
    /// Of a value without an uncertainty.
    pub(super) const EXACT: Self =
        Self { standard: 0.0, dof: f64::INFINITY, shape: None, factor: 1.0 };
}

/// What is known of a value.
///
/// # Errors
/// What is wrong with it, as a sentence about the quantity.
pub(super) fn known(of: &Measured, place: usize) -> Result<KnownValue, String> {
    let none = || "has no uncertainty".to_owned();
    let stated = of.uncertainty.as_ref().ok_or_else(none)?;
    let shape = stated.called(place).and_then(NamedShape::of);
    let is_t = shape == Some(NamedShape::Student);
    let probability = at(&stated.probabilities, place);
    // a distribution with limits, or one of which nothing is known, may lie within U
    let is_bounded = matches!(shape, Some(NamedShape::Unknown)) || limited(shape, 1.0).is_some();
    if let Some(p) = probability
        && !(p > 0.0 && (p < 1.0 || p == 1.0 && is_bounded))
    {
        let whole = if is_bounded { ", or 1" } else { "" };
        let meant =
            of_percent(p).map_or_else(String::new, |p| format!("; {p} if it is in percent"));
        return Err(format!(
            "has a coverage probability of {p}, which must be between 0 and 1{whole}{meant}"
        ));
    }
    let stated_factor = at(&stated.factors, place);
    let digit = |all| at(all, place).unwrap_or(0.0);
    let digits = &stated.last_digits;
    let (of_expanded, of_factor) = (digit(&digits.expanded), digit(&digits.factors));
    let of_probability = digit(&digits.probabilities);
    let (expanded, standard) = (at(&stated.expanded, place), at(&stated.standard, place));
    let factor = match (stated_factor, probability) {
        (Some(k), Some(p)) if k > 0.0 => {
            let (k, p) = (WrittenNumber::new(k, of_factor), WrittenNumber::new(p, of_probability));
            coverage::factor(k, p, shape)?
        }
        (Some(k), None) if k > 0.0 => k,
        (Some(k), _) => return Err(format!("has a coverage factor of {k}, which must be above 0")),
        (None, Some(_)) if is_t && standard.is_none() => {
            return Err(
                "has an expanded uncertainty of a t distribution without a coverage factor, \
                        which alone says its degrees of freedom"
                    .to_owned(),
            );
        }
        (None, Some(p)) => of_probability_alone(shape, p),
        (None, None) => 1.0,
    };
    let (standard, factor) = match (standard, expanded) {
        (Some(u), Some(expanded))
            if stated_factor.is_some()
                && (expanded / factor - u).abs() > agreement::ROUNDED * u =>
        {
            (intervals::agreeing(u, expanded, factor, [of_expanded, of_factor])?, 1.0)
        }
        (Some(standard), _) => (standard, 1.0),
        (None, Some(_)) if stated_factor.is_none() && probability.is_none() => {
            let reason = "has an expanded uncertainty without a coverage factor or probability";
            return Err(reason.to_owned());
        }
        (None, Some(expanded)) => match at(&stated.of_interval, place) {
            Some(u) => (intervals::agreeing(u, expanded, factor, [of_expanded, of_factor])?, 1.0),
            None => (expanded / factor, factor),
        },
        (None, None) => return Err(none()),
    };
    if !(standard >= 0.0 && standard.is_finite()) {
        return Err(format!("has a standard uncertainty of {standard}"));
    }
    // a standard uncertainty that is stated has not been divided by the factor
    let divided = at(&stated.standard, place).is_none() && stated_factor == Some(factor);
    let dof = match probability {
        Some(p) if divided && (is_t || shape.is_none()) => {
            let stated = Factor::new(factor, of_factor);
            if is_t { stated.dof(p) } else { stated.dof_of_nothing_named(p, of_probability) }
        }
        Some(p) if at(&stated.standard, place).is_some() => {
            of_limits(of, stated, place, shape, p, of_probability)?
        }
        _ => f64::INFINITY,
    };
    Ok(KnownValue { standard, dof, shape, factor })
}

/// The degrees of freedom that a coverage interval symmetric about its value shows: half of it over the
/// standard uncertainty is a coverage factor.
///
/// # Errors
/// The interval cannot have that standard uncertainty and that probability.
fn of_limits(
    of: &Measured,
    stated: &StatedUncertainties,
    place: usize,
    shape: Option<NamedShape>,
    p: f64,
    of_probability: f64,
) -> Result<f64, String> {
    let Some(interval) = Interval::of(of, place) else { return Ok(f64::INFINITY) };
    let u = at(&stated.standard, place).unwrap_or(f64::NAN);
    if interval.low > interval.high {
        return Err(format!(
            "has a coverage interval from {} to {}, whose ends are in reverse order",
            interval.low, interval.high
        ));
    }
    if interval.is_asymmetric() || shape == Some(NamedShape::Unknown) {
        return Ok(f64::INFINITY);
    }
    let half = 0.5 * (interval.high - interval.low);
    let of_u = 0.5 * at(&stated.last_digits.standard, place).unwrap_or(0.0);
    let of_u = of_u.min(interval.rounding);
    let reach = 1.001 * interval.rounding + 1e-9 * half;
    let ends = [p - 0.5 * of_probability, p + 0.5 * of_probability];
    let most = if limited(shape, 1.0).is_some() { 1.0 } else { 1.0 - 1e-12 };
    let [low, high] = ends.map(|p| of_probability_alone(shape, p.clamp(1e-6, most)));
    let is_too_short = half + reach < low * (u - of_u);
    let is_too_long = half - reach > high * (u + of_u);
    let is_open = matches!(shape, None | Some(NamedShape::Student));
    if is_too_short || is_too_long && (!is_open || u == 0.0) {
        return Err(format!(
            "has a standard uncertainty of {u} and a coverage interval of ±{half} with the probability \
             {p}, which do not belong together: ask which is right"
        ));
    }
    if !is_open || !is_too_long {
        return Ok(f64::INFINITY);
    }
    let k = half / u;
    let rounding = 2.0 * (reach + of_u * k) / u;
    Ok(Factor::new(k, rounding).dof(p))
}

/// A coverage interval about a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    value: f64,
    low: f64,
    high: f64,
    /// What rounding may have taken from each of them.
    rounding: f64,
}

impl Interval {
    /// The coverage interval of a value, with its own uncertainty.
    pub(super) fn of(of: &Measured, place: usize) -> Option<Self> {
        let stated = of.uncertainty.as_ref()?;
        let [low, high] = stated.ends.each_ref().map(|all| at(all, place));
        let digits = stated.last_digits.ends.each_ref().map(|all| at(all, place));
        let own = of.last_digits.get(place).copied();
        // zeros at the end of some of them may not be written
        let digit = digits.into_iter().chain([own]).flatten().fold(f64::INFINITY, f64::min);
        let value = *of.values.get(place)?;
        Some(Self { value, low: low?, high: high?, rounding: 0.5 * digit })
    }

    /// Whether the value is not in the middle, by more than the digits leave open.
    pub(super) fn is_asymmetric(self) -> bool {
        let middle = 0.5 * (self.low + self.high);
        let reach = 2.002 * self.rounding + 1e-9 * (self.high - self.low).abs();
        (middle - self.value).abs() > reach
    }
}
