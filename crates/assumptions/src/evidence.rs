//! Tests whether readings agree with the stated distribution of a quantity.
//!
//! The stated distribution is tested including its centre: readings that scatter about another
//! value contradict it just as readings that scatter too widely.

use super::alternatives::limits;
use super::anderson_darling::{p_value, statistic};
use gumption_engine::distribution::{BLOCK, Distribution, FromScore, Normal, StreamKey};
use gumption_engine::number::{COLUMN, Column, ascending};
use gumption_engine::special;
use std::sync::Arc;

/// The result of testing readings against a stated distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct EvidenceTest {
    /// Index of the variable in the task.
    pub variable: usize,
    /// Number of readings.
    pub readings: usize,
    /// Probability that readings from the stated distribution deviate from it at least as much as
    /// these (Anderson-Darling).
    pub p_value: f64,
    /// The width that the readings support.
    pub supported: SupportedWidth,
    /// Number of readings outside the stated limits.
    pub outside: usize,
    /// The verdict.
    pub verdict: EvidenceVerdict,
    /// The offset, if readings that contradict the stated distribution lie close together away from
    /// its centre.
    pub offset: Option<EvidenceOffset>,
}

/// Readings that scatter little about a value other than the stated centre: a systematic effect
/// that should be corrected (JCGM 100, 3.2.4), not a wrong width or shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvidenceOffset {
    /// The mean of the readings, in the variable's unit.
    pub mean: f64,
    /// The stated centre.
    pub stated: f64,
    /// The readings' own standard deviation.
    pub standard_deviation: f64,
    /// The standard deviation of their mean, s/sqrt(n), with n - 1 degrees of freedom.
    pub standard_error: f64,
}

impl EvidenceOffset {
    /// Confidence level of an offset (t test, two-sided).
    pub const LEVEL: f64 = 0.99;

    /// The mean minus the stated centre.
    pub fn difference(&self) -> f64 {
        self.mean - self.stated
    }

    /// The offset of readings from `stated`, if it is significant and much larger than their
    /// scatter.
    fn of(stated: f64, readings: &[f64]) -> Option<Self> {
        let n = readings.len() as f64;
        // relative to the first reading, so that no digits are lost
        let first = *readings.first()?;
        let mean = first + readings.iter().map(|x| x - first).sum::<f64>() / n;
        let squares: f64 = readings.iter().map(|x| (x - mean).powi(2)).sum();
        let standard_deviation = (squares / (n - 1.0)).sqrt();
        let standard_error = standard_deviation / n.sqrt();
        let found = Self { mean, stated, standard_deviation, standard_error };
        let off = found.difference().abs();
        let critical = special::student::two_sided_factor(Self::LEVEL, n - 1.0);
        let is_offset = off > critical * standard_error && off > MUCH_LARGER * standard_deviation;
        is_offset.then_some(found)
    }
}

/// The width that readings support for a distribution with the stated shape and centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportedWidth {
    /// The parameter of the width: `half_width`, `std` or `scale`.
    pub parameter: &'static str,
    /// The stated one.
    pub stated: f64,
    /// Estimate, in the variable's unit: the width for which half of such sets of readings would
    /// extend farther; for a normal distribution the root mean square deviation.
    pub estimate: f64,
    /// 95 % confidence interval.
    pub interval: [f64; 2],
}

/// The verdict about a stated distribution; the first one that holds is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvidenceVerdict {
    /// Fewer than five readings.
    TooFew,
    /// A reading lies outside the stated limits, or the supported interval lies entirely above the
    /// stated width.
    TooNarrow,
    /// The supported interval lies entirely below the stated width, at 99.5 % instead of 97.5 %.
    TooWide,
    /// The p-value is below 0.01.
    WrongShape,
    /// None of these.
    Consistent,
}

impl EvidenceVerdict {
    /// The words of the answer.
    pub fn words(self) -> &'static str {
        match self {
            Self::TooFew => "too few readings to tell",
            Self::TooNarrow => "too narrow",
            Self::TooWide => "too wide",
            Self::WrongShape => "wrong shape",
            Self::Consistent => "consistent",
        }
    }
}

/// Readings that tell something.
const FEWEST: usize = 5;

/// Probability outside each end of the supported interval.
const TAIL: f64 = 0.025;

/// The false positive rate of "too wide". All false verdicts together must be rarer than one in
/// twenty, and one in forty is reserved for the verdicts that matter most.
const TOO_WIDE: f64 = 0.005;

/// p-values below this contradict the shape.
const WRONG_SHAPE: f64 = 0.01;

/// An offset is reported if it exceeds the standard deviation of the readings by this factor: after
/// a correction the remaining width is negligible.
const MUCH_LARGER: f64 = 3.0;

/// Rounding within which a reading is not outside a limit, in half-widths.
const ROUNDING: f64 = 1e-9;

/// Number of simulated sets for shapes whose widths have no tabulated distribution, and limit for
/// the total number of draws.
const SETS: usize = 4000;
const DRAWS: usize = 4_000_000;

/// Tests readings against a distribution; `None` for one without a width, or without readings.
pub fn agreement(
    variable: usize,
    stated: &Arc<Distribution>,
    readings: &[f64],
) -> Option<EvidenceTest> {
    let stated = &population(stated);
    if readings.is_empty() || stated.constant().is_some() {
        return None;
    }
    let outside = outside(stated, readings);
    let mut sorted = readings.to_vec();
    ascending(&mut sorted);
    let probabilities = of_rounded(stated, &sorted);
    let p_value =
        if outside > 0 { 0.0 } else { p_value(statistic(&probabilities), readings.len()) };
    let (parameter, width) = parameter(stated);
    let factors = factors(stated, readings);
    let supported = SupportedWidth {
        parameter,
        stated: width,
        estimate: width * factors.estimate,
        interval: factors.interval.map(|factor| width * factor),
    };
    let verdict = if readings.len() < FEWEST {
        EvidenceVerdict::TooFew
    } else if outside > 0 || factors.interval[0] > 1.0 + ROUNDING {
        EvidenceVerdict::TooNarrow
    } else if factors.surely_below < 1.0 {
        EvidenceVerdict::TooWide
    } else if p_value < WRONG_SHAPE {
        EvidenceVerdict::WrongShape
    } else {
        EvidenceVerdict::Consistent
    };
    let contradicted = !matches!(verdict, EvidenceVerdict::Consistent | EvidenceVerdict::TooFew);
    let offset = EvidenceOffset::of(stated.mean(), readings).filter(|_| contradicted);
    let readings = readings.len();
    Some(EvidenceTest { variable, readings, p_value, supported, outside, verdict, offset })
}

/// The distribution of the population: degrees of freedom describe how well the width of a normal
/// distribution is known, and are not part of it.
fn population(stated: &Arc<Distribution>) -> Arc<Distribution> {
    match &**stated {
        Distribution::Normal(_) => {
            let normal = Normal::new(stated.mean(), stated.standard_uncertainty());
            normal.map_or_else(|_| Arc::clone(stated), |normal| Arc::new(normal.into()))
        }
        _ => Arc::clone(stated),
    }
}

/// The parameter of the width, and its value.
fn parameter(stated: &Distribution) -> (&'static str, f64) {
    match stated {
        Distribution::Normal(_) | Distribution::Readings(_) => {
            ("std", stated.standard_uncertainty())
        }
        Distribution::StudentT(_) => ("scale", stated.standard_uncertainty()),
        _ => match stated.divisor() {
            Some(divisor) => ("half_width", divisor * stated.standard_uncertainty()),
            None => ("std", stated.standard_deviation()),
        },
    }
}

/// Number of readings outside the support of the stated distribution.
fn outside(stated: &Distribution, readings: &[f64]) -> usize {
    let positive = matches!(
        stated,
        Distribution::Exponential(_)
            | Distribution::Gamma(_)
            | Distribution::Lognormal(_)
            | Distribution::PoissonCount(_)
    );
    let limits = limits(stated).or_else(|| positive.then_some([0.0, f64::INFINITY]));
    let Some([low, high]) = limits else {
        return 0;
    };
    let slack = if high.is_finite() { ROUNDING * (0.5 * high - 0.5 * low) } else { 0.0 };
    readings.iter().filter(|x| **x < low - slack || **x > high + slack).count()
}

/// The probabilities below and above readings in ascending order. A reading rounded to a digit may
/// have been anything within half of that digit. Equal readings are therefore spread evenly over
/// the corresponding probability, so that neither a reading at a limit nor a display with few steps
/// contradicts the distribution.
fn of_rounded(stated: &Distribution, sorted: &[f64]) -> Vec<[f64; 2]> {
    let half = 0.5 * last_digit(sorted);
    let equal = sorted.chunk_by(|a, b| b - a < half);
    let spread = equal.flat_map(|equal| {
        let ends = [equal[0] - half, equal[equal.len() - 1] + half];
        let [[below, not_below], [not_above, above]] = ends.map(|end| probabilities(stated, end));
        let count = equal.len() as f64;
        (0..equal.len()).map(move |i| {
            let share = (i as f64 + 0.5) / count;
            [below + share * (not_above - below), above + (1.0 - share) * (not_below - above)]
        })
    });
    spread.collect()
}

/// Number of readings that are not all even by chance.
const MANY: usize = 10;

/// One unit of the last decimal digit of readings: the largest power of ten of which all are
/// multiples, to the digits that sums of readings have. For many readings also 2 or 5 times that
/// power, the steps of displays.
fn last_digit(readings: &[f64]) -> f64 {
    let is_multiple = |digit: f64| {
        readings.iter().all(|x| {
            let number = x / digit;
            (number - number.round()).abs() <= 1e-9 * number.abs()
        })
    };
    let largest = readings.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let first = if largest > 0.0 { libm::log10(largest).floor() } else { 0.0 };
    let digits = (0..10).map(|place| libm::exp10(first - f64::from(place)));
    let steps: &[f64] = if readings.len() < MANY { &[1.0] } else { &[5.0, 2.0, 1.0] };
    let digits = digits.flat_map(|digit| steps.iter().map(move |step| step * digit));
    digits.into_iter().find(|digit| is_multiple(*digit)).unwrap_or(0.0)
}

/// The probabilities below and above a value.
fn probabilities(stated: &Distribution, value: f64) -> [f64; 2] {
    let z = stated.score_of(value);
    [special::normal::cdf(z), special::normal::sf(z)]
}

/// Widths that readings support, relative to the stated one.
struct Factors {
    estimate: f64,
    interval: [f64; 2],
    /// The upper end at 99.5 %.
    surely_below: f64,
}

fn factors(stated: &Arc<Distribution>, readings: &[f64]) -> Factors {
    let n = readings.len() as f64;
    match &**stated {
        Distribution::Normal(_) => {
            let squares: f64 = readings.iter().map(|x| (x - stated.mean()).powi(2)).sum();
            let squares = squares / stated.standard_uncertainty().powi(2);
            // the sum of squares is chi-squared with n degrees of freedom
            let at = |q: f64| (squares / (2.0 * special::gamma::quantile(q, 0.5 * n))).sqrt();
            Factors {
                estimate: (squares / n).sqrt(),
                interval: [at(1.0 - TAIL), at(TAIL)],
                surely_below: at(TOO_WIDE),
            }
        }
        Distribution::Rectangular(_)
        | Distribution::Trapezoidal(_)
        | Distribution::CurvilinearTrapezoid(_)
        | Distribution::Arcsine(_) => largest_deviation(stated, readings),
        Distribution::Triangular(_) if stated.divisor().is_some() => {
            largest_deviation(stated, readings)
        }
        _ => mean_deviation(stated, readings),
    }
}

/// For a symmetric shape between limits, from the largest deviation from the middle. It cannot
/// exceed the half-width, so it is the lower end; the upper end leaves out 5 %.
fn largest_deviation(stated: &Distribution, readings: &[f64]) -> Factors {
    let middle = stated.mean();
    let reach = stated.quantile_upper(f64::MIN_POSITIVE) - middle;
    let largest = readings.iter().map(|x| (x - middle).abs()).fold(0.0, f64::max) / reach;
    // the largest of n deviations is below t with probability F(t)^n, F(t) = 1 - 2 P(above t)
    let at = |q: f64| {
        let above = -0.5 * libm::expm1(libm::log(q) / readings.len() as f64);
        largest * reach / (stated.quantile_upper(above) - middle)
    };
    Factors { estimate: at(0.5), interval: [largest, at(2.0 * TAIL)], surely_below: at(TOO_WIDE) }
}

/// For any other shape, from the mean deviation from the mean, compared with that of simulated
/// sets.
fn mean_deviation(stated: &Arc<Distribution>, readings: &[f64]) -> Factors {
    let mean = stated.mean();
    let n = readings.len();
    let found = readings.iter().map(|x| (x - mean).abs()).sum::<f64>() / n as f64;
    let sets = (DRAWS / n.max(1)).clamp(200, SETS);
    let mut simulated = simulated_deviations(stated, n, sets);
    ascending(&mut simulated);
    let at = |q: f64| {
        let place = ((q * sets as f64) as usize).min(sets - 1);
        found / simulated.get(place).copied().unwrap_or(f64::NAN)
    };
    Factors { estimate: at(0.5), interval: [at(1.0 - TAIL), at(TAIL)], surely_below: at(TOO_WIDE) }
}

/// The mean deviations of sets of n readings drawn from the stated distribution, always the same
/// ones.
fn simulated_deviations(stated: &Arc<Distribution>, n: usize, sets: usize) -> Vec<f64> {
    let key = StreamKey::new(1, "simulated readings");
    let from_score = FromScore::of(stated);
    let mean = stated.mean();
    let mut found = Vec::with_capacity(sets);
    let (mut scores, mut values) = (Column::ZERO, Column::ZERO);
    let (mut sum, mut count) = (0.0, 0);
    for block in 0.. {
        let mut stream = key.block(block);
        for _ in 0..BLOCK / COLUMN {
            Normal::standard_draw(&mut stream, &mut scores);
            from_score.values(&scores, &mut values);
            for value in values.0 {
                sum += (value - mean).abs();
                count += 1;
                if count == n {
                    found.push(sum / n as f64);
                    (sum, count) = (0.0, 0);
                    if found.len() == sets {
                        return found;
                    }
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests;
