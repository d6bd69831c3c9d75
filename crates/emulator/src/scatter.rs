//! How the outputs of a simulator scatter from run to run at the same parameters.

/// The correlation of neighbouring rows counts beyond this many of its standard deviations.
const SIGNIFICANT: f64 = 3.0;

/// The greatest size of a correlation.
const MOST_CORRELATED: f64 = 0.999;

/// How the outputs of a noisy simulator scatter about their means: normal, the same for all parameters and
/// all rows of an output, and independent from row to row unless repeats show that neighbouring rows are
/// correlated. The correlation of two rows is then the power of that of neighbours (an autoregressive process of
/// first order).
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    outputs: Vec<OutputScatter>,
}

/// The scatter of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputScatter {
    /// The standard deviation of a value, in u.
    pub deviation: f64,
    /// The correlation coefficient of neighbouring rows; 0 where repeats do not show one.
    pub correlation: f64,
}

impl Scatter {
    /// Of repeats: for each set of parameters that was run more than once the values of all rows of each run, in
    /// u and output after output. `None` without any, or where they do not have the same number of rows for each
    /// of so many outputs.
    pub fn of(repeats: &[Vec<&[f64]>], outputs: usize) -> Option<Self> {
        let repeats: Vec<&Vec<&[f64]>> = repeats.iter().filter(|runs| runs.len() > 1).collect();
        let values = repeats.first()?.first()?.len();
        let rows = values.checked_div(outputs).filter(|rows| *rows > 0)?;
        let fits = |runs: &&Vec<&[f64]>| runs.iter().all(|run| run.len() == rows * outputs);
        if !repeats.iter().all(fits) {
            return None;
        }
        let residuals: Vec<Vec<f64>> = repeats.iter().flat_map(|runs| residuals(runs)).collect();
        // each set of parameters has a mean of its own
        let known = residuals.len() - repeats.len();
        let of = |output: usize| {
            let own = residuals.iter().map(|run| &run[output * rows..(output + 1) * rows]);
            OutputScatter::of(own.collect(), known)
        };
        Some(Self { outputs: (0..outputs).map(of).collect() })
    }

    /// The scatter of each output.
    pub fn outputs(&self) -> &[OutputScatter] {
        &self.outputs
    }

    /// The variance of what the scatter has along a direction of all rows, in u².
    pub(crate) fn along(&self, direction: &[f64]) -> f64 {
        let rows = direction.len() / self.outputs.len();
        let parts = direction.chunks(rows.max(1)).zip(&self.outputs);
        parts.map(|(part, output)| output.along(part)).sum()
    }

    /// What it typically has along a direction, in u: the root mean square over the outputs of a deviation, times the
    /// root of the values that count as one where they are correlated.
    pub(crate) fn size(&self) -> f64 {
        let squares = self.outputs.iter().map(|output| output.variance() * output.together());
        (squares.sum::<f64>() / self.outputs.len() as f64).sqrt()
    }

    /// The sum of the variances of so many values, in u².
    pub(crate) fn total(&self, values: usize) -> f64 {
        self.sum(values, OutputScatter::variance)
    }

    /// The largest mean square along any direction that the scatter alone gives so many runs of so many values,
    /// in u²: the edge of Marchenko and Pastur (Math. USSR Sb. 1 (1967) 457), for as many independent values as
    /// the correlated ones are worth.
    pub(crate) fn edge(&self, values: usize, runs: usize) -> f64 {
        let total = self.total(values);
        if total == 0.0 {
            return 0.0;
        }
        let squares =
            self.sum(values, |output| output.variance() * output.variance() * output.together());
        let independent = total * total / squares;
        let factor = 1.0 + (independent / runs as f64).sqrt();
        total / independent * factor * factor
    }

    fn sum(&self, values: usize, of: impl Fn(&OutputScatter) -> f64) -> f64 {
        let rows = values as f64 / self.outputs.len() as f64;
        rows * self.outputs.iter().map(of).sum::<f64>()
    }

    /// The standard deviation of so many values, in u, after the mean of so many runs.
    pub(crate) fn of_mean(&self, values: usize, runs: usize) -> Vec<f64> {
        let rows = values / self.outputs.len();
        let of = |output: &OutputScatter| vec![output.deviation / (runs as f64).sqrt(); rows];
        self.outputs.iter().flat_map(of).collect()
    }
}

impl OutputScatter {
    /// Of the residuals of all rows of some runs, which have so many degrees of freedom for each row.
    fn of(residuals: Vec<&[f64]>, degrees: usize) -> Self {
        let rows = residuals[0].len();
        let squares: f64 = residuals.iter().flat_map(|run| run.iter()).map(|r| r * r).sum();
        let pairs = residuals.iter().flat_map(|run| run.windows(2));
        let products: f64 = pairs.map(|pair| pair[0] * pair[1]).sum();
        let correlation = if squares > 0.0 { products / squares } else { 0.0 };
        // of independent values the coefficient has the variance of one over their number
        let deviation = 1.0 / ((degrees * rows) as f64).sqrt();
        let is_shown = correlation.abs() > SIGNIFICANT * deviation;
        Self {
            deviation: (squares / (degrees * rows) as f64).sqrt(),
            correlation: if is_shown {
                correlation.clamp(-MOST_CORRELATED, MOST_CORRELATED)
            } else {
                0.0
            },
        }
    }

    /// How many of many correlated values count as one, by the sum of the squares of their correlations.
    fn together(&self) -> f64 {
        let square = self.correlation * self.correlation;
        (1.0 + square) / (1.0 - square)
    }

    fn variance(&self) -> f64 {
        self.deviation * self.deviation
    }

    /// The variance along a direction of its rows.
    fn along(&self, direction: &[f64]) -> f64 {
        let mut sum = 0.0;
        let mut before = 0.0;
        for entry in direction {
            before *= self.correlation;
            sum += entry * (entry + 2.0 * before);
            before += entry;
        }
        self.variance() * sum
    }
}

/// What runs at the same parameters depart from their mean by.
fn residuals(runs: &[&[f64]]) -> Vec<Vec<f64>> {
    let mean = |row: usize| runs.iter().map(|run| run[row]).sum::<f64>() / runs.len() as f64;
    let mean: Vec<f64> = (0..runs[0].len()).map(mean).collect();
    runs.iter().map(|run| run.iter().zip(&mean).map(|(a, b)| a - b).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uniforms::Uniforms;
    use gumption_engine::distribution::StreamKey;
    use gumption_engine::special::normal;

    /// Runs of two outputs of 400 rows: white with the deviation 0.3, and 0.2 with the correlation 0.8 of
    /// neighbours.
    fn runs(count: usize) -> Vec<Vec<f64>> {
        let mut random = Uniforms::new(StreamKey::new(1, "scatter"), 0);
        let mut next = || normal::quantile(random.next());
        let mut run = || {
            let white: Vec<f64> = (0..400).map(|row| row as f64 + 0.3 * next()).collect();
            let mut at = 0.2 * next();
            let rows = (0..400).map(|_| {
                let value = at;
                at = 0.8 * at + 0.2 * 0.6 * next();
                value
            });
            white.into_iter().chain(rows.collect::<Vec<_>>()).collect()
        };
        (0..count).map(|_| run()).collect()
    }

    /// Of four runs the deviation has a relative standard error of 1/sqrt(2*3*400) = 0.02, three times that with
    /// the correlation, which has one of 0.6/sqrt(1200) = 0.017. Four of each are allowed.
    #[test]
    fn deviations_and_correlations_are_found() {
        let runs = runs(4);
        let of = Scatter::of(&[runs.iter().map(Vec::as_slice).collect()], 2).unwrap();
        let [white, correlated] = of.outputs() else { panic!("{of:?}") };
        assert!((white.deviation - 0.3).abs() < 0.3 * 0.08 && white.correlation == 0.0, "{of:?}");
        assert!((correlated.deviation - 0.2).abs() < 0.2 * 0.25, "{of:?}");
        assert!((correlated.correlation - 0.8).abs() < 0.07, "{of:?}");
        assert_eq!(Scatter::of(&[vec![&runs[0]]], 2), None);
        assert_eq!(Scatter::of(&[vec![&runs[0], &runs[1][1..]]], 2), None);
    }

    /// The variance along directions is that of the covariance matrix, of 3 rows by hand.
    #[test]
    fn the_variance_along_a_direction_is_that_of_the_matrix() {
        let output = OutputScatter { deviation: 2.0, correlation: 0.5 };
        let of = Scatter { outputs: vec![output] };
        // 1 + 4 + 9 + 2*(0.5*2 + 0.25*3 + 0.5*6) = 23.5
        assert!((of.along(&[1.0, 2.0, 3.0]) - 4.0 * 23.5).abs() < 1e-12);
        assert_eq!(of.total(3), 12.0);
        assert_eq!(of.of_mean(2, 4), [1.0, 1.0]);
    }

    /// No direction of 20 runs of white noise has more than the edge by much: its standard deviation is
    /// of the order of the edge over 2 n^(2/3), some per cent (Johnstone, Ann. Stat. 29 (2001) 295).
    #[test]
    fn white_noise_stays_below_the_edge() {
        let runs = runs(20);
        let white = runs.iter().map(|run| {
            let row = |(row, value): (usize, &f64)| (value - row as f64) / 0.3;
            run[..400].iter().enumerate().map(row).collect()
        });
        let white: Vec<Vec<f64>> = white.collect();
        let of = Scatter { outputs: vec![OutputScatter { deviation: 1.0, correlation: 0.0 }] };
        let largest = crate::SingularVectors::of(&white, 0.1).sizes[0].powi(2);
        let edge = of.edge(400, 20);
        assert!((largest / edge - 1.0).abs() < 0.1, "{largest} {edge}");
    }
}
