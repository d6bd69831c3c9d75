//! Robust averages and standard deviations of ISO 13528:2022, annex C: they hardly change with a few
//! outlying results.

/// The factor between the median absolute deviation and the standard deviation of a normal
/// distribution (ISO 13528:2022, C.3.1).
const OF_MEDIAN_DEVIATION: f64 = 1.483;

/// The factor between the interquartile range and the standard deviation of a normal distribution
/// (ISO 13528:2022, C.2.3).
const OF_QUARTILES: f64 = 0.7413;

/// Results farther than this many standard deviations from the average are moved to that distance
/// (ISO 13528:2022, C.3.1).
const WINSORIZED_AT: f64 = 1.5;

/// The factor that makes the standard deviation of moved results that of a normal distribution
/// (ISO 13528:2022, C.3.1).
const OF_WINSORIZED: f64 = 1.134;

/// Maximum number of iterations. Each one divides the distance from the limit by about 3 for results
/// of a normal distribution; 10 000 are enough for a division by 1.003.
const MOST_ITERATIONS: usize = 10_000;

/// The iteration ends at changes below this fraction of the standard deviation. The standard ends it
/// where the third significant digit does not change; nine digits more make the result independent of
/// the first values.
const CONVERGED: f64 = 1e-12;

/// The standard deviation tends to 0 once it is below this fraction of the smallest deviation from
/// the median: all results but the equal ones are then moved, and each iteration multiplies it by one
/// factor.
const VANISHED: f64 = 1e-6;

/// What algorithm A started with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstScale {
    /// The median absolute deviation.
    MedianDeviation,
    /// The sample standard deviation, because more than half of the results are equal and the median
    /// absolute deviation is 0 (ISO 13528:2022, C.3.1, note).
    SampleDeviation,
}

/// The robust average x* and standard deviation s* of algorithm A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlgorithmA {
    /// x*, in the unit of the values.
    pub average: f64,
    /// s*, in the unit of the values; 0 if it tends to 0, as for equal values.
    pub standard_deviation: f64,
    /// What the iteration started with.
    pub first_scale: FirstScale,
}

/// Values in order of size.
#[derive(Clone, Debug)]
pub struct SortedValues(Vec<f64>);

impl SortedValues {
    /// The values, of which there must be one at least; all must be finite, and so must their
    /// range. `None` otherwise.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_unstable_by(f64::total_cmp);
        let range = values.last()? - values.first()?;
        (range.is_finite() && values.iter().all(|value| value.is_finite())).then_some(Self(values))
    }

    /// The quantile for a probability by linear interpolation between the values, which are those
    /// for 0, 1/(p - 1), ..., 1 (the rule of spreadsheets, R and NumPy).
    fn quantile(&self, probability: f64) -> f64 {
        let position = (self.0.len() - 1) as f64 * probability;
        let (lower, upper) = (position.floor() as usize, position.ceil() as usize);
        let [a, b] = [lower, upper].map(|place| self.0.get(place).copied().unwrap_or(f64::NAN));
        a + (position - position.floor()) * (b - a)
    }

    /// The median.
    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// The normalized interquartile range, 0.7413 (Q3 - Q1) (ISO 13528:2022, C.2.3). The quartiles
    /// are interpolated linearly between the values.
    pub fn normalized_iqr(&self) -> f64 {
        OF_QUARTILES * (self.quantile(0.75) - self.quantile(0.25))
    }

    /// Algorithm A (ISO 13528:2022, C.3.1); `None` for fewer than two values, and if the iteration
    /// does not converge.
    pub fn algorithm_a(&self) -> Option<AlgorithmA> {
        let median = self.median();
        let deviations: Vec<f64> = self.0.iter().map(|value| value - median).collect();
        let moduli = || deviations.iter().map(|deviation| deviation.abs());
        let largest = moduli().fold(0.0, f64::max);
        if deviations.len() < 2 {
            return None;
        }
        if largest == 0.0 {
            let first_scale = FirstScale::MedianDeviation;
            return Some(AlgorithmA { average: median, standard_deviation: 0.0, first_scale });
        }
        // relative to the largest one, so that no square is infinite or 0
        let relative: Vec<f64> = deviations.iter().map(|deviation| deviation / largest).collect();
        let of_median = Self::of(relative.iter().map(|value| value.abs()))?.median();
        let (first_scale, scale) = if of_median > 0.0 {
            (FirstScale::MedianDeviation, OF_MEDIAN_DEVIATION * of_median)
        } else {
            (FirstScale::SampleDeviation, moments(&relative, f64::INFINITY, 0.0).1)
        };
        let least = relative.iter().map(|value| value.abs()).filter(|value| *value > 0.0);
        let least = least.fold(f64::INFINITY, f64::min);
        let (average, scale) = converged(&relative, scale, VANISHED * least)?;
        Some(AlgorithmA {
            average: median + largest * average,
            standard_deviation: largest * scale,
            first_scale,
        })
    }
}

/// The limit of the iteration about 0 with the first scale; its scale is 0 once it is below
/// `vanished`. `None` without convergence.
fn converged(values: &[f64], first: f64, vanished: f64) -> Option<(f64, f64)> {
    let (mut average, mut scale) = (0.0, first);
    for _ in 0..MOST_ITERATIONS {
        let (next, deviation) = moments(values, WINSORIZED_AT * scale, average);
        let next_scale = OF_WINSORIZED * deviation;
        let tolerance = CONVERGED * scale;
        let is_same =
            (next - average).abs() <= tolerance && (next_scale - scale).abs() <= tolerance;
        (average, scale) = (next, next_scale);
        if scale < vanished {
            return Some((0.0, 0.0));
        }
        if is_same {
            return Some((average, scale));
        }
    }
    None
}

/// Mean and sample standard deviation of the values after those farther than `distance` from `centre`
/// are moved to that distance.
fn moments(values: &[f64], distance: f64, centre: f64) -> (f64, f64) {
    let moved = || values.iter().map(|value| value.clamp(centre - distance, centre + distance));
    let mean = moved().sum::<f64>() / values.len() as f64;
    let squares: f64 = moved().map(|value| (value - mean).powi(2)).sum();
    (mean, (squares / (values.len() - 1) as f64).sqrt())
}
