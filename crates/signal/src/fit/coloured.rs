//! Noise with a memory in a record that is too short, or at a frequency too low, to see it in parts:
//! an autoregressive moving-average process of order (1, 1), of which first-order low-passed noise,
//! a random walk, both with white noise on top, and means of either are cases.
//!
//! Its parameters are those of the greatest restricted likelihood, which allows for what the fit of
//! the constant and the tones takes out of the residuals (D. A. Harville, J. Am. Stat. Assoc. 72
//! (1977) 320). The likelihood is that of the innovations (P. J. Brockwell, R. A. Davis, Time Series:
//! Theory and Methods, 2nd ed., 5.3); the variance of a fitted constant or factor is then that of the
//! weighted sum of values that it is.

use nalgebra::{DMatrix, DVector};

use super::dirichlet::sum_of_cosines;
use super::drift;
use super::residuals::{LAGS, NOT_WHITE};
use super::sine_fit::ToneDesign;
use crate::Phasor;
use crate::phasor::at_turns;
use crate::turns::{Turns, oscillation};
use gumption_engine::number::elementary::{ln, sin_cos_turn, tanh};

/// Values that a model is fitted to at most; longer records give means of so many samples.
pub(crate) const HELD: u64 = 4096;

/// Means of a record that stand for it where no model of its values does.
const MEANS: usize = 64;

/// By how much the restricted log-likelihood of a process that comes back to its mean must be above
/// that of a random walk for half of this difference: a walk passes for such a process in one record
/// in a hundred (simulated, with a constant in the fit), one whose memory is a thirtieth of the
/// record hardly ever for a walk.
const COMES_BACK: f64 = 6.0;

/// The difference of twice the log-likelihood from which a moving average is worth its parameter.
const WORTH: f64 = 6.0;

/// Turns over the record up to which noise is looked at for whether it grows like 1/f.
const SLOW: usize = 32;

/// By how much the log-likelihood of noise of 1/f must be above that of a process that fits: less than
/// exp(-3) by chance, and one record in a hundred (simulated).
const FLICKERS: f64 = 3.0;

/// By how much it must be above that of even noise where no process fits, and may be below that of the
/// process of the means.
const WITHOUT_FIT: f64 = 2.0;

/// The record against whose mean the level of 1/f noise is counted, over the record's own length.
const LONGER: f64 = 10.0;

/// Values less parameters from which on sixteen coefficients of autocorrelation tell noise of the
/// coefficient [`MATTERS`] in nine records of ten.
const TELLS: usize = 256;

/// The coefficient of first order from which on noise with a memory matters: near zero frequency it is
/// by a factor of sqrt(1.4/0.6) = 1.5 stronger than white noise of the same variance.
const MATTERS: f64 = 0.4;

/// Twice the log-likelihood of a memory over that of white noise, beyond which one white record in a
/// thousand is, and one in twenty: half of chi-squared with one degree of freedom.
const TOLD: f64 = 9.55;
const SUSPECTED: f64 = 2.71;

/// What a record that is too short for its autocorrelation tells of a memory of its noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Memory {
    /// It has none that matters, or the record is long.
    None,
    /// One that matters cannot be excluded, with 95 %, but none is seen.
    Open,
    /// The noise may have one: one white record in twenty looks so.
    Suspected,
    /// The noise has one: one white record in a thousand looks so.
    Told,
}

/// Residuals of a record: values, or means of as many successive ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    values: Vec<f64>,
    /// Samples of each mean.
    every: u64,
    sum: f64,
    filled: u64,
}

/// What a model says of the fit of a channel.
#[derive(Clone, Debug)]
pub(crate) struct Coloured {
    /// The variance of the constant.
    pub(crate) level: f64,
    /// The variances of the factors of the cosine and the sine of each tone; none where the model does
    /// not fit and the record has periods enough to do without it.
    pub(crate) tones: Option<Vec<[f64; 2]>>,
    /// The variances of the factors of the polynomials of a drift; none where the record is too short for
    /// them.
    pub(crate) drift: Vec<f64>,
    /// Degrees of freedom of these.
    pub(crate) freedom: f64,
    /// Whether the innovations that the model leaves are white.
    pub(crate) fits: bool,
    /// Whether the noise wanders off and does not come back within the record: its level is then
    /// counted from the record's first value.
    pub(crate) walks: bool,
    /// Whether it grows towards the lowest frequencies of the record as the process does not: its level
    /// is then counted from that of a record of [`LONGER`] times the length.
    pub(crate) flickers: bool,
    /// The variance of the constant if the means of [`MEANS`] parts scatter about it.
    pub(crate) still: f64,
    /// The process that comes nearest.
    process: Process,
    /// Samples of each value that it is a process of.
    pub(crate) every: u64,
}

/// An ARMA(1, 1) process x = rho x' + e + theta e' of innovations e.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Process {
    rho: f64,
    theta: f64,
    /// Variance of the innovations.
    variance: f64,
    /// It starts from nothing at the first value instead of having gone on for ever.
    walks: bool,
}

impl Coloured {
    /// What the process leaves of residuals: errors of prediction from the values before. The first
    /// value, which nothing predicts, has none.
    pub(crate) fn innovations(&self, residuals: &[f64]) -> Vec<f64> {
        let Process { rho, theta, .. } = self.process;
        let mut error = 0.0;
        let predicted = residuals.windows(2).map(|pair| {
            error = pair[1] - rho * pair[0] - theta * error;
            error
        });
        predicted.collect()
    }

    /// The process over its innovations at so many cycles from one value to the next.
    pub(crate) fn response(&self, cycles: f64) -> Phasor {
        self.process.response(cycles)
    }

    /// The spectral density at so many cycles in a sample interval, as the variance of the white noise
    /// that has it everywhere; beyond what means of several samples show, that at their end.
    pub(crate) fn density(&self, cycles: f64) -> f64 {
        let every = self.every as f64;
        every * self.process.density((cycles * every).min(0.5))
    }

    /// The variances of the tones' factors over those that white noise of a variance gives.
    pub(crate) fn over_white(&self, design: &ToneDesign, variance: f64) -> Option<Vec<[f64; 2]>> {
        let of = |(tone, [cosine, sine]): (usize, &[f64; 2])| {
            let (even, odd) = (design.even[(tone + 1, tone + 1)], design.odd[(tone, tone)]);
            [cosine / (variance * even), sine / (variance * odd)]
        };
        let tones = self.tones.as_ref()?;
        Some(tones.iter().enumerate().map(of).collect())
    }
}

impl Series {
    pub(crate) fn new(samples: u64) -> Self {
        Self { every: samples.div_ceil(HELD).max(1), ..Self::default() }
    }

    pub(crate) fn add(&mut self, residuals: &[f64]) {
        if self.every == 1 {
            self.values.extend_from_slice(residuals);
            return;
        }
        for value in residuals {
            self.sum += value;
            self.filled += 1;
            if self.filled == self.every {
                self.values.push(self.sum / self.every as f64);
                (self.sum, self.filled) = (0.0, 0);
            }
        }
    }

    /// Whether means over long parts scatter more than those of white noise of this variance do: of
    /// one white record in a thousand.
    pub(crate) fn wanders(&self, variance: f64) -> bool {
        let (means, length) = self.means();
        if means.len() < 8 {
            return false;
        }
        let freedom = means.len() as f64 - 1.0;
        let mean = means.iter().sum::<f64>() / means.len() as f64;
        let squares: f64 = means.iter().map(|m| (m - mean) * (m - mean)).sum();
        // the quantile of chi-squared by Wilson and Hilferty's cube
        let part = 2.0 / (9.0 * freedom);
        let cube = 1.0 - part + 3.09 * part.sqrt();
        squares * length > variance * freedom * cube * cube * cube
    }

    /// Whether values go steadily up or down or bend over the record more than white noise of this
    /// variance does.
    pub(crate) fn drifts(&self, variance: f64) -> bool {
        let deviation = (variance / self.every as f64).sqrt();
        deviation > 0.0 && drift::clearest(&self.values, deviation) > drift::CLEAR
    }

    /// Up to [`MEANS`] means of successive values, and the samples of each.
    fn means(&self) -> (Vec<f64>, f64) {
        let length = self.values.len().div_ceil(MEANS).max(1);
        let whole = self.values.chunks_exact(length);
        let means = whole.map(|part| part.iter().sum::<f64>() / length as f64).collect();
        (means, length as f64 * self.every as f64)
    }

    /// What a short record tells of a memory of first order, by the restricted likelihood: the
    /// autocorrelation of what a fit of many parameters leaves is too low.
    pub(crate) fn memory(&self, design: &ToneDesign) -> Memory {
        let parameters = design.parameters();
        if self.values.len() >= parameters + TELLS {
            return Memory::None;
        }
        if self.values.len() < parameters + 5 {
            return Memory::Open;
        }
        let mut columns = vec![vec![1.0; self.values.len()]];
        columns.extend(self.waves(design).0);
        let columns = columns.iter().map(Vec::as_slice).chain([self.values.as_slice()]);
        let fitted = Fitted { columns: columns.collect() };
        let products = Products::of(&fitted);
        let at = |rho: f64| products.likelihood(&fitted, rho);
        let found = along(|place| at(tanh(place)), reach(&fitted));
        let (Some(white), Some((place, best)), Some(matters)) = (at(0.0), found, at(MATTERS))
        else {
            return Memory::None;
        };
        let more = if place > 0.0 { white.value - best.value } else { 0.0 };
        let excluded = tanh(place) < MATTERS && matters.value - best.value > SUSPECTED;
        match more {
            TOLD.. => Memory::Told,
            SUSPECTED.. => Memory::Suspected,
            _ if excluded => Memory::None,
            _ => Memory::Open,
        }
    }

    /// The variances of what a fit found; none where the record is too short for any model. Of a
    /// record of `many` periods the tones take too little out of the noise to count.
    pub(crate) fn coloured(&self, design: &ToneDesign, many: bool) -> Option<Coloured> {
        let count = self.values.len();
        let constant = vec![1.0; count];
        let (columns, seen) = self.waves(design);
        let level = |count| [vec![vec![1.0; count]], drift::columns(design.drift, count)].concat();
        let whole = Regression { columns: [vec![constant], columns].concat() };
        let short = Regression { columns: level(count) };
        let (process, fits) = if many { &short } else { &whole }.process(&self.values)?;
        let nearest = process;
        let mut slow_values = None;
        let (mut process, mut freedom) = (process, process.freedom(count));
        let variance = |weights: &[f64]| process.variance_of(weights);
        let mut of_level = variance(&whole.weights(0)?);
        let mut tones = None;
        let of_drift = |regression: &Regression, process: &Process| -> Option<Vec<f64>> {
            let places = regression.columns.len() - design.drift..regression.columns.len();
            places.map(|place| Some(process.variance_of(&regression.weights(place)?))).collect()
        };
        let mut drift = if fits { of_drift(&whole, &process)? } else { Vec::new() };
        if fits || !many {
            let places = seen.then_some(0..design.tones.len());
            tones = places.and_then(|mut places| {
                places.try_fold(Vec::new(), |mut tones, tone| {
                    let [even, odd] = [1, 2].map(|part| whole.weights(2 * tone + part));
                    tones.push([variance(&even?), variance(&odd?)]);
                    Some(tones)
                })
            });
        }
        if !fits {
            // hum and the like: the means of long parts know nothing of it
            let (means, _) = self.means();
            let slow = Regression { columns: level(means.len()) };
            if let Some((of_means, _)) = slow.process(&means).filter(|_| means.len() >= 8) {
                of_level = of_means.variance_of(&slow.weights(0)?);
                drift = of_drift(&slow, &of_means)?;
                freedom = of_means.freedom(means.len());
                process = of_means;
                slow_values = Some(means);
            }
        }
        let flicker = (!process.walks)
            .then(|| process.flicker(slow_values.as_deref().unwrap_or(&self.values), design, fits))
            .flatten();
        if let Some((of_flicker, bins)) = flicker.filter(|(level, _)| *level > of_level) {
            (of_level, freedom) = (of_flicker, bins);
        }
        let flickers = flicker.is_some();
        let (means, _) = self.means();
        let still =
            means.iter().map(|mean| mean * mean).sum::<f64>() / (means.len() as f64).powi(2);
        let (walks, every) = (process.walks, self.every);
        Some(Coloured {
            level: of_level,
            tones,
            drift,
            freedom,
            fits,
            walks,
            flickers,
            still,
            process: nearest,
            every,
        })
    }

    /// Cosine and sine of the tones as the values have them, then the polynomials of a drift, and
    /// whether the values have the tones: means of much of a period have little of it.
    fn waves(&self, design: &ToneDesign) -> (Vec<Vec<f64>>, bool) {
        let (count, every) = (self.values.len(), self.every as f64);
        let middle = (count as f64 - 1.0) / 2.0;
        let mut columns = Vec::new();
        let mut seen = true;
        for tone in &design.tones {
            if self.every > 1 && tone.cycles * every > 0.25 {
                seen = false;
                continue;
            }
            let kept = sum_of_cosines(tone.cycles, self.every) / every;
            let waves = (0..count).map(|i| {
                let turns = tone.cycles * every * (i as f64 - middle);
                let (sin, cos) = sin_cos_turn(turns - turns.floor());
                (cos * kept, sin * kept)
            });
            let (cosines, sines) = waves.unzip();
            columns.extend([cosines, sines]);
        }
        columns.extend(drift::columns(design.drift, count));
        (columns, seen)
    }
}

/// A design.
struct Regression {
    columns: Vec<Vec<f64>>,
}

/// Its columns and, last, the values that are fitted.
struct Fitted<'f> {
    columns: Vec<&'f [f64]>,
}

/// The restricted likelihood of a process, but for constants.
#[derive(Clone, Copy)]
struct Likelihood {
    /// Minus twice its logarithm.
    value: f64,
    /// Variance of the innovations.
    variance: f64,
}

impl Regression {
    /// The weights of the values in a coefficient of the ordinary least-squares fit.
    fn weights(&self, coefficient: usize) -> Option<Vec<f64>> {
        let design = &self.columns;
        let count = design.len();
        let products = DMatrix::from_fn(count, count, |i, j| dot(&design[i], &design[j]));
        let unit = DVector::from_fn(count, |i, _| f64::from(u8::from(i == coefficient)));
        let solved = products.cholesky()?.solve(&unit);
        let value = |i: usize| design.iter().zip(solved.iter()).map(|(x, s)| x[i] * s).sum();
        Some((0..design.first().map_or(0, Vec::len)).map(value).collect())
    }

    /// The likeliest process of what the design leaves of values, and whether its innovations are
    /// white.
    fn process(&self, values: &[f64]) -> Option<(Process, bool)> {
        let design = self.columns.iter().map(Vec::as_slice);
        Fitted { columns: design.chain([values]).collect() }.process()
    }
}

impl Fitted<'_> {
    fn length(&self) -> usize {
        self.columns.first().map_or(0, |column| column.len())
    }

    /// The likeliest process, and whether its innovations are white.
    fn process(&self) -> Option<(Process, bool)> {
        if self.length() < self.columns.len() + 4 {
            return None;
        }
        let products = Products::of(self);
        let (first, of_first) = along(|place| products.likelihood(self, tanh(place)), reach(self))?;
        let edge = tanh(reach(self).1);
        let mut best =
            Process { rho: tanh(first), theta: 0.0, variance: of_first.variance, walks: false };
        let mut value = of_first.value;
        let mut walk = products.likelihood(self, edge)?;
        let mut walk_theta = 0.0;
        if !self.is_white(best)
            && let Some((rho, theta, found)) = self.moving_average()
            && found.value < value - WORTH
        {
            best = Process { rho, theta, variance: found.variance, walks: false };
            value = found.value;
            let of = |place: f64| self.likelihood(edge, tanh(place));
            if let Some((place, found)) = along(of, (-4.0, 3.0)) {
                (walk, walk_theta) = (found, tanh(place));
            }
        }
        if best.rho > 0.0 && walk.value < value + COMES_BACK {
            best = Process { rho: 1.0, theta: walk_theta, variance: walk.variance, walks: true };
        }
        Some((best, self.is_white(best)))
    }

    /// The likeliest ARMA(1, 1) process by a look over a grid and ever smaller steps from its best.
    fn moving_average(&self) -> Option<(f64, f64, Likelihood)> {
        let edge = reach(self).1;
        let at =
            |[rho, theta]: [f64; 2]| self.likelihood(tanh(rho.clamp(-edge, edge)), tanh(theta));
        let mut best: Option<([f64; 2], Likelihood)> = None;
        let better = |place: [f64; 2], best: &mut Option<([f64; 2], Likelihood)>| {
            let Some(found) = at(place) else { return false };
            if best.is_none_or(|(_, known)| found.value < known.value) {
                *best = Some((place, found));
                return true;
            }
            false
        };
        for rho in [-1.2, 0.8, 2.0, 3.5] {
            for theta in [-3.0, -1.5, -0.5, 0.5, 1.5] {
                // a process whose two parts cancel is white
                if rho + theta != 0.0 {
                    better([rho, theta], &mut best);
                }
            }
        }
        let mut step = 0.5;
        while step > 0.01 {
            let ([rho, theta], _) = best?;
            let around = [
                [rho + step, theta],
                [rho - step, theta],
                [rho, theta + step],
                [rho, theta - step],
                [rho + step, theta - step],
                [rho - step, theta + step],
            ];
            if !around.into_iter().any(|place| better(place, &mut best)) {
                step /= 2.0;
            }
        }
        let ([rho, theta], found) = best?;
        Some((tanh(rho.clamp(-edge, edge)), tanh(theta), found))
    }

    fn likelihood(&self, rho: f64, theta: f64) -> Option<Likelihood> {
        let (white, logarithms) = self.innovations(rho, theta);
        let count = white.len();
        let products =
            DMatrix::from_fn(
                count,
                count,
                |i, j| {
                    if i >= j { dot(&white[i], &white[j]) } else { 0.0 }
                },
            );
        likelihood(products, logarithms, self.length())
    }

    /// Columns less their best predictions from the values before, over the prediction's relative
    /// standard deviation; and the sum of the logarithms of these variances.
    fn innovations(&self, rho: f64, theta: f64) -> (Vec<Vec<f64>>, f64) {
        let mut relative = (1.0 + 2.0 * theta * rho + theta * theta) / (1.0 - rho * rho);
        let mut logarithms = 0.0;
        // the variance settles to that of the innovations, 1
        let mut start = Vec::new();
        while start.len() < self.length() && (relative - 1.0).abs() > 1e-15 {
            start.push(relative);
            logarithms += ln(relative);
            relative = 1.0 + theta * theta - theta * theta / relative;
        }
        // each value waits for the one before it: several columns go side by side
        let mut out: Vec<Vec<f64>> = self.columns.iter().map(|column| column.to_vec()).collect();
        for side_by_side in out.chunks_mut(4) {
            match side_by_side {
                [a, b, c, d] => innovate([a, b, c, d], &start, rho, theta),
                [a, b, c] => innovate([a, b, c], &start, rho, theta),
                [a, b] => innovate([a, b], &start, rho, theta),
                fewer => fewer.iter_mut().for_each(|a| innovate([a], &start, rho, theta)),
            }
        }
        (out, logarithms)
    }

    /// Whether the innovations that a process leaves are white as far as [`LAGS`] lags show it.
    fn is_white(&self, process: Process) -> bool {
        let edge = tanh(reach(self).1);
        let rho = process.rho.min(edge);
        let (mut white, _) = self.innovations(rho, process.theta);
        let Some(mut rest) = white.pop() else { return true };
        let count = white.len();
        let products = DMatrix::from_fn(count, count, |i, j| dot(&white[i], &white[j]));
        let right = DVector::from_fn(count, |i, _| dot(&white[i], &rest));
        let Some(solved) = products.cholesky().map(|inverse| inverse.solve(&right)) else {
            return false;
        };
        for (column, factor) in white.iter().zip(solved.iter()) {
            rest.iter_mut().zip(column).for_each(|(rest, x)| *rest -= factor * x);
        }
        let power = dot(&rest, &rest);
        let lag = |lag: usize| {
            let r = dot(&rest[lag.min(rest.len())..], &rest) / power;
            r * r
        };
        // the tones that were taken out leave correlations of their own
        let taken = 1.0 + count as f64 / 8.0;
        rest.len() as f64 * (1..=LAGS).map(lag).sum::<f64>() < NOT_WHITE * taken
    }
}

/// Values become their errors of prediction; `start` has the relative variances that differ from 1.
fn innovate<const N: usize>(columns: [&mut [f64]; N], start: &[f64], rho: f64, theta: f64) {
    let length = columns.iter().map(|column| column.len()).min().unwrap_or(0);
    let columns = columns.map(|column| &mut column[..length]);
    let early = start.len().min(length);
    let mut predicted = [0.0; N];
    for (i, relative) in start[..early].iter().enumerate() {
        for k in 0..N {
            let (value, error) = (columns[k][i], columns[k][i] - predicted[k]);
            columns[k][i] = error / relative.sqrt();
            predicted[k] = rho * value + theta * error / relative;
        }
    }
    #[expect(clippy::needless_range_loop, reason = "a place in each of the columns")]
    for i in early..length {
        for k in 0..N {
            let (value, error) = (columns[k][i], columns[k][i] - predicted[k]);
            columns[k][i] = error;
            predicted[k] = rho * value + theta * error;
        }
    }
}

/// Between which hyperbolic arcs of the coefficient the likeliest is looked for: up to a memory of a
/// thousand records.
fn reach(regression: &Fitted<'_>) -> (f64, f64) {
    let most = 0.5 * ln(2000.0 * regression.length() as f64);
    (-most, most)
}

/// Minus twice the restricted log-likelihood of the lower triangle of products of whitened columns,
/// the values last, and the sum of the logarithms of the innovations' relative variances.
fn likelihood(products: DMatrix<f64>, logarithms: f64, length: usize) -> Option<Likelihood> {
    let parameters = products.nrows() - 1;
    let factor = products.cholesky()?.unpack();
    let diagonal = factor.diagonal();
    let of_design: f64 = diagonal.iter().take(parameters).map(|d| 2.0 * ln(*d)).sum();
    let squares = diagonal[parameters] * diagonal[parameters];
    let freedom = (length - parameters) as f64;
    let value = freedom * ln(squares) + logarithms + of_design;
    value.is_finite().then_some(Likelihood { value, variance: squares / freedom })
}

/// Sums of products of all columns, of which those of the innovations of any autoregression of order
/// one are made.
struct Products {
    /// Of the first values.
    first: DMatrix<f64>,
    /// Of successive differences, of values with the following differences, and of values but the
    /// last.
    steps: [DMatrix<f64>; 3],
}

impl Products {
    fn of(regression: &Fitted<'_>) -> Self {
        let columns = &regression.columns;
        let count = columns.len();
        let differences: Vec<Vec<f64>> = columns
            .iter()
            .map(|column| column.windows(2).map(|pair| pair[1] - pair[0]).collect())
            .collect();
        let before = |i: usize| &columns[i][..columns[i].len() - 1];
        let over = |entry: &dyn Fn(usize, usize) -> f64| DMatrix::from_fn(count, count, entry);
        Self {
            first: over(&|i, j| columns[i][0] * columns[j][0]),
            steps: [
                over(&|i, j| dot(&differences[i], &differences[j])),
                over(&|i, j| dot(before(i), &differences[j]) + dot(before(j), &differences[i])),
                over(&|i, j| dot(before(i), before(j))),
            ],
        }
    }

    fn likelihood(&self, regression: &Fitted<'_>, rho: f64) -> Option<Likelihood> {
        let back = 1.0 - rho;
        let [differences, mixed, before] = &self.steps;
        let start = back * (1.0 + rho);
        let products = &self.first * start + differences + mixed * back + before * (back * back);
        likelihood(products, -ln(start), regression.length())
    }
}

impl Process {
    /// The variance of a weighted sum of successive values.
    fn variance_of(&self, weights: &[f64]) -> f64 {
        let follows = self.rho + self.theta;
        let (mut later, mut sum) = (0.0, 0.0);
        for weight in weights.iter().rev() {
            let share = weight + follows * later;
            sum += share * share;
            later = weight + self.rho * later;
        }
        if !self.walks {
            let before = follows * later;
            sum += before * before / (1.0 - self.rho * self.rho);
        }
        sum * self.variance
    }

    /// The variance of the mean of values whose noise grows like 1/f towards low frequencies, where it
    /// does and this process does not, and its degrees of freedom.
    ///
    /// Whittle's likelihood (P. J. Brockwell, R. A. Davis, Time Series: Theory and Methods, 2nd ed.,
    /// 10.8) of the lowest bins of the spectrum, those near a fitted tone left out. Noise of 1/f has
    /// no level of its own: its variance is that of the frequencies between the lowest of this record
    /// and of one [`LONGER`] times as long.
    fn flicker(&self, values: &[f64], design: &ToneDesign, fits: bool) -> Option<(f64, f64)> {
        let count = values.len() as f64;
        let is_free = |bin: &usize| {
            let apart = |cycles: f64| (cycles * design.samples as f64 - *bin as f64).abs();
            design.tones.iter().all(|tone| apart(tone.cycles) > 1.5)
        };
        // polynomials take half a turn out of the noise with each degree
        let lowest = 1 + design.drift.div_ceil(2);
        let bins: Vec<usize> = (lowest..=SLOW.min(values.len() / 4)).filter(is_free).collect();
        let power = |bin: &usize| {
            let step = Turns::new(*bin as f64 / count)?;
            let (mut cos, mut sin) = (vec![0.0; values.len()], vec![0.0; values.len()]);
            oscillation(step, 0, &mut cos, &mut sin);
            let (re, im) = (dot(values, &cos), dot(values, &sin));
            Some((re * re + im * im) / count)
        };
        let powers: Vec<f64> = bins.iter().map(power).collect::<Option<_>>()?;
        let growth = bins.iter().zip(&powers).map(|(bin, power)| *bin as f64 * power).sum::<f64>()
            / bins.len() as f64;
        let of = |expected: f64, power: f64| ln(expected) + power / expected;
        let even = powers.iter().sum::<f64>() / bins.len() as f64;
        let sum = |expected: &dyn Fn(f64) -> f64| {
            let each = bins.iter().zip(&powers);
            each.map(|(bin, power)| of(expected(*bin as f64), *power)).sum::<f64>()
        };
        let of_flicker = sum(&|bin| growth / bin);
        let better = sum(&|bin| self.density(bin / count)) - of_flicker;
        let over_even = sum(&|_| even) - of_flicker;
        let variance = 2.0 * growth * ln(LONGER) / count;
        let grows = if fits {
            better > FLICKERS && over_even > 0.0
        } else {
            better > -WITHOUT_FIT && over_even > WITHOUT_FIT
        };
        (bins.len() > 2 && grows).then_some((variance, 2.0 * bins.len() as f64))
    }

    /// The power at so many cycles from one value to the next, over that of white noise of variance 1.
    fn density(&self, cycles: f64) -> f64 {
        self.variance * self.response(cycles).norm_sqr()
    }

    /// The values over the innovations, at so many cycles from one to the next.
    fn response(&self, cycles: f64) -> Phasor {
        let before = at_turns(-cycles);
        (before * self.theta + 1.0) / (1.0 - before * self.rho)
    }

    /// Degrees of freedom of such a variance at low frequencies: that of the innovations has as many
    /// as there are values, the coefficient of autoregression the variance (1 - rho^2) over that.
    fn freedom(&self, values: usize) -> f64 {
        let values = values as f64;
        if self.walks {
            return values - 1.0;
        }
        1.0 / (1.0 / values + 2.0 * (1.0 + self.rho) / (values * (1.0 - self.rho)))
    }
}

/// The place between two where a function is least, by a look every quarter and golden sections.
fn along(
    likelihood: impl Fn(f64) -> Option<Likelihood>,
    (from, to): (f64, f64),
) -> Option<(f64, Likelihood)> {
    let steps = (4.0 * (to - from)).ceil() as u32;
    let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps);
    let found = (0..=steps).filter_map(|step| Some((step, likelihood(at(step))?)));
    let (step, mut best) = found.min_by(|a, b| a.1.value.total_cmp(&b.1.value))?;
    let mut place = at(step);
    let (mut low, mut high) = (at(step.saturating_sub(1)), at((step + 1).min(steps)));
    let section = (3.0 - 5f64.sqrt()) / 2.0;
    while high - low > 1e-3 {
        let [left, right] = [low + section * (high - low), high - section * (high - low)];
        let [of_left, of_right] = [likelihood(left)?, likelihood(right)?];
        if of_left.value < of_right.value {
            high = right;
        } else {
            low = left;
        }
        for (x, found) in [(left, of_left), (right, of_right)] {
            if found.value < best.value {
                (place, best) = (x, found);
            }
        }
    }
    Some((place, best))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    super::sine_fit::dot(a, &b[..a.len().min(b.len())], 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::simulated::normals;

    /// A record of white noise, of a walk, of noise with a memory.
    fn process(seed: u64, rho: f64, count: usize) -> Vec<f64> {
        let noise = normals(seed, "process", count + 1);
        let mut last = if rho < 1.0 { noise[count] / (1.0 - rho * rho).sqrt() } else { 0.0 };
        noise[..count]
            .iter()
            .map(|new| {
                last = rho * last + new;
                last
            })
            .collect()
    }

    /// Noise whose power grows like 1/f, the first values of four times as many, and white noise of a
    /// share of its power on top.
    fn flicker(seed: u64, count: usize, white: f64) -> Vec<f64> {
        let mut spectrum = crate::transform::forward(&normals(seed, "flicker", 4 * count));
        for (bin, value) in spectrum.iter_mut().enumerate().take(2 * count + 1) {
            *value /= (bin.max(1) as f64 / count as f64).sqrt();
        }
        let rest = normals(seed, "white", count);
        let grown = crate::transform::inverse(spectrum);
        grown.iter().zip(&rest).map(|(grown, rest)| grown + white * rest).collect()
    }

    /// What 75 values, 1.3 periods with five multiples, tell of white noise: 50 of 1000 records are
    /// suspected and 1 is told (21 to 79 and up to 6 with a probability of 1 - 1e-4). Of a coefficient
    /// of 0.8 all but one in a hundred are at least suspected, by simulation outside of this program,
    /// and of 0.5 all but 8 in a hundred (up to 20 of 100 with a probability of 1 - 1e-4).
    #[test]
    fn short_records_tell_a_memory() {
        let tones = (1..=5).map(|multiple| crate::sine_fit::Tone {
            cycles: 0.0173 * f64::from(multiple),
            fundamental: 0,
            multiple,
            beside: false,
        });
        let design = ToneDesign::new(tones.collect(), 75).unwrap();
        let memory = |values: Vec<f64>| {
            let mut series = Series::new(75);
            series.add(&values);
            series.memory(&design)
        };
        let counts = |records: u64, rho: f64| {
            let found: Vec<Memory> =
                (0..records).map(|seed| memory(process(seed, rho, 75))).collect();
            [Memory::Suspected, Memory::Told]
                .map(|wanted| found.iter().filter(|found| **found == wanted).count())
        };
        let [suspected, told] = counts(1000, 0.0);
        assert!((21..=79).contains(&(suspected + told)) && told <= 6, "{suspected} {told}");
        for (rho, least) in [(0.5, 80), (0.8, 95)] {
            let [suspected, told] = counts(100, rho);
            assert!(suspected + told >= least, "{rho}: {suspected} {told}");
        }
    }

    fn residuals(hertz: f64, values: &[f64]) -> (Option<Coloured>, f64) {
        let tone =
            |cycles| crate::sine_fit::Tone { cycles, fundamental: 0, multiple: 1, beside: false };
        let tones = vec![tone(hertz / 1000.0), tone(hertz / 500.0), tone(hertz / 333.3)];
        let design = ToneDesign::new(tones, values.len() as u64).unwrap();
        let mut passes = crate::InMemorySamples { channels: vec![values.to_vec()] };
        let mut fits = design.fit(&mut passes).unwrap();
        let of = crate::residuals::of(&design, &mut passes, &mut fits).unwrap().remove(0);
        (of.coloured, fits[0].offset)
    }

    /// Noise of 1/f is told in more than half of 40 records, and of first order or white with a hum in
    /// one of a hundred: 3 of 40 have a probability of 8e-3 each, 4 one of 8e-4. Its offset's error
    /// is that of the frequencies that the record lacks, down to a fourth of its lowest, and counted
    /// down to a tenth: a score below 1, that of 20 records below 1.5.
    #[test]
    fn noise_of_1_over_f_is_told() {
        for (n, least) in [(900, 28), (4000, 14)] {
            let mut squares = Vec::new();
            for seed in 0..40 {
                let (found, offset) = residuals(5.0, &flicker(seed, n, 0.0));
                let found = found.unwrap();
                if found.flickers {
                    squares.push(offset * offset / found.level);
                }
            }
            let score = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
            println!("{n}: {} of 40, score {score:.2}", squares.len());
            assert!(squares.len() >= least, "{n}: {}", squares.len());
            assert!((0.4..1.5).contains(&score), "{n}: {score}");
            let hum = |seed: u64| {
                let noise = normals(seed, "hum", n);
                let turns = |i: usize| 0.05003 * i as f64 + seed as f64 * 0.618;
                noise.iter().enumerate().map(|(i, x)| 3.0 * at_turns(turns(i)).re + x).collect()
            };
            let first = |rho: f64| move |seed| process(seed, rho, n);
            let others: [&dyn Fn(u64) -> Vec<f64>; 3] = [&hum, &first(0.5), &first(0.9)];
            for other in others {
                let told = (0..40).filter(|seed| {
                    residuals(5.0, &other(*seed)).0.is_some_and(|found| found.flickers)
                });
                assert!(told.count() <= 3);
            }
        }
    }

    #[test]
    #[ignore = "calibration"]
    fn flickers() {
        let report = |about: &str, make: &dyn Fn(u64) -> Vec<f64>, hertz: f64| {
            let (mut said, mut walks, mut none) = (0, 0, 0);
            let (mut squares, mut of) = ([0.0; 2], [0.0; 2]);
            for seed in 0..200 {
                let (found, offset) = residuals(hertz, &make(seed));
                let Some(found) = found else {
                    none += 1;
                    continue;
                };
                said += u32::from(found.flickers);
                walks += u32::from(found.walks);
                if !found.walks {
                    let which = usize::from(found.flickers);
                    squares[which] += offset * offset / found.level;
                    of[which] += 1.0;
                }
            }
            let [plain, grown] = [0, 1].map(|i| (squares[i] / of[i]).sqrt());
            println!(
                "{about:24} {said:4} 1/f ({grown:.2}), {walks:4} walk, {none:4} none, else {plain:.2}"
            );
        };
        for (n, hertz) in [(900, 5.0), (2000, 5.0), (4000, 5.0)] {
            report(&format!("1/f {n}"), &|seed| flicker(seed, n, 0.0), hertz);
            report(&format!("1/f + white {n}"), &|seed| flicker(seed, n, 3.0), hertz);
            for rho in [0.5, 0.9, 0.97, 0.99, 0.995, -0.9] {
                report(&format!("AR {rho} {n}"), &|seed| process(seed, rho, n), hertz);
            }
            let hum = |seed| {
                let noise = normals(seed, "hum", n);
                let turns = |i: usize| 0.05003 * i as f64 + seed as f64 * 0.618;
                noise.iter().enumerate().map(|(i, x)| 3.0 * at_turns(turns(i)).re + x).collect()
            };
            report(&format!("hum {n}"), &hum, hertz);
            let both = |seed| {
                let (walk, rest) = (process(seed, 0.98, n), normals(seed, "more", n));
                walk.iter().zip(&rest).map(|(x, y)| x + 5.0 * y).collect()
            };
            report(&format!("AR 0.98 + white {n}"), &both, hertz);
        }
    }

    #[test]
    #[ignore = "calibration"]
    fn walks() {
        for kappa in [0.0, 3.0, 10.0, 20.0, 31.5, 60.0] {
            let n = 3150;
            let mut differences: Vec<f64> = (0..1000)
                .map(|seed| {
                    let values = process(seed, 1.0 - kappa / n as f64, n);
                    let ones = vec![1.0; n];
                    let r = Fitted { columns: vec![&ones, &values] };
                    let products = Products::of(&r);
                    let of = |place: f64| products.likelihood(&r, tanh(place));
                    let best = along(of, reach(&r)).unwrap().1.value;
                    of(reach(&r).1).unwrap().value - best
                })
                .collect();
            differences.sort_unstable_by(f64::total_cmp);
            let at = |p: f64| differences[(p * 999.0) as usize];
            println!(
                "{kappa}: {:.2} {:.2} {:.2} {:.2} {:.2} {:.2}",
                at(0.01),
                at(0.05),
                at(0.5),
                at(0.9),
                at(0.95),
                at(0.99)
            );
        }
    }
}
