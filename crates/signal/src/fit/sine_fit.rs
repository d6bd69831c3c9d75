//! Least-squares fit of oscillations of known frequencies to evenly spaced values: the
//! three-parameter sine fit of IEEE Std 1057 (annex on sine-wave curve fits) and the sine
//! approximation of ISO 16063-11 (method 3), for any number of tones at once.
//!
//! Instants are counted from the middle of the record. Cosines and the constant are even there,
//! sines odd, so that the normal equations fall into two small well-conditioned systems whose
//! matrices are known in closed form. The remainders are fitted once more, which leaves the
//! rounding of the values themselves.

use std::error::Error;
use std::fmt;

use nalgebra::{DMatrix, DVector};

use crate::dirichlet::Kernel;
use crate::drift::{self, DriftProducts};
use crate::passes::{BLOCK, SampleSource};
use crate::turns::{Turns, oscillation};
use gumption_engine::number::{CodePath, Shortest};

/// The largest condition number of the normal equations: beyond it the tones cannot be told apart
/// (much less than a period, or two frequencies too near).
const WORST_CONDITION: f64 = 1e4;

/// An oscillation of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Cycles in a sample interval: the frequency over the sampling rate, above 0 and below 1/2.
    pub cycles: f64,
    /// Which fundamental it belongs to.
    pub fundamental: usize,
    /// Which multiple of the fundamental's frequency it is, 1 or more.
    pub multiple: u32,
    /// Whether nobody named it: an oscillation that was found in what the others leave. It counts as
    /// a fundamental after those that were named.
    pub beside: bool,
}

/// Why tones cannot be fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoFit {
    /// A tone is at or above half the sampling rate, or not above zero.
    Frequency {
        /// Its cycles in a sample interval.
        cycles: f64,
    },
    /// Fewer values than parameters, or tones that the record is too short to tell apart.
    TooShort,
}

impl fmt::Display for NoFit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frequency { cycles } => write!(
                f,
                "a tone has {} cycles in a sample interval, which must lie between 0 and 0.5",
                Shortest(*cycles)
            ),
            Self::TooShort => f.write_str(
                "the values are fewer than the parameters of the tones, or the record is too \
                 short to separate the tones",
            ),
        }
    }
}

impl Error for NoFit {}

/// The design of a fit: its tones at the samples of a record, without the values.
#[derive(Clone, Debug)]
pub struct ToneDesign {
    /// The tones.
    pub tones: Vec<Tone>,
    /// Samples of the record.
    pub samples: u64,
    /// The degree of the polynomial by which the level drifts; 0 where it is constant.
    pub drift: usize,
    steps: Vec<Turns>,
    products: DriftProducts,
    /// The inverse normal matrix of the constant, the cosines and the polynomials of even degree, in
    /// that order.
    pub(crate) even: DMatrix<f64>,
    /// The inverse normal matrix of the sines and the polynomials of odd degree.
    pub(crate) odd: DMatrix<f64>,
}

/// A constant and tones a cos + b sin, with phases counted from the middle of the record.
#[derive(Clone, Debug, PartialEq)]
pub struct ToneCoefficients {
    /// The constant.
    pub offset: f64,
    /// The factor of the cosine of each tone.
    pub cosines: Vec<f64>,
    /// The factor of the sine of each tone.
    pub sines: Vec<f64>,
    /// The factors of the Legendre polynomials of degrees 1, 2, ... by which the level drifts, over the
    /// record from -1 to 1.
    pub drift: Vec<f64>,
}

impl ToneDesign {
    /// Tones at `samples` evenly spaced values.
    ///
    /// # Errors
    /// [`NoFit`] where the tones have no unique fit.
    pub fn new(tones: Vec<Tone>, samples: u64) -> Result<Self, NoFit> {
        Self::with_drift(tones, samples, 0)
    }

    /// The same with a level that drifts by a polynomial of the degree `drift`.
    ///
    /// # Errors
    /// As [`ToneDesign::new`].
    pub fn with_drift(tones: Vec<Tone>, samples: u64, drift: usize) -> Result<Self, NoFit> {
        let wrong = tones.iter().find(|tone| !(tone.cycles > 0.0 && tone.cycles < 0.5));
        if let Some(tone) = wrong {
            return Err(NoFit::Frequency { cycles: tone.cycles });
        }
        if samples < 2 * tones.len() as u64 + drift as u64 + 2 {
            return Err(NoFit::TooShort);
        }
        let steps: Vec<Turns> = tones.iter().filter_map(|tone| Turns::new(tone.cycles)).collect();
        let count = steps.len();
        let sum = |turns: Turns| Kernel::new(turns, samples).cosines;
        let (even_size, odd_size) = (count + 1 + drift / 2, count + drift.div_ceil(2));
        let mut even = DMatrix::zeros(even_size, even_size);
        let mut odd = DMatrix::zeros(odd_size, odd_size);
        even[(0, 0)] = samples as f64;
        for (k, step) in steps.iter().enumerate() {
            even[(0, k + 1)] = sum(*step);
            even[(k + 1, 0)] = even[(0, k + 1)];
            for (l, other) in steps.iter().enumerate() {
                let (apart, together) = (sum(step.apart(*other)), sum(step.plus(*other)));
                even[(k + 1, l + 1)] = (apart + together) / 2.0;
                odd[(k, l)] = (apart - together) / 2.0;
            }
        }
        let products = DriftProducts::new(drift, &steps, samples);
        for (i, level) in products.level.iter().enumerate() {
            let (is_even, place) = place_of_degree(count, i + 1);
            let matrix = if is_even { &mut even } else { &mut odd };
            let mut both = |other: usize, product: f64| {
                matrix[(other, place)] = product;
                matrix[(place, other)] = product;
            };
            for (tone, products) in products.waves.iter().enumerate() {
                both(tone + usize::from(is_even), products[i]);
            }
            for j in (0..drift).filter(|j| (i + j) % 2 == 0) {
                both(place_of_degree(count, j + 1).1, products.own[(i, j)]);
            }
            if is_even {
                both(0, *level);
            }
        }
        let (even, odd) = (inverse(even), inverse(odd));
        match (even, odd) {
            (Some(even), Some(odd)) => {
                Ok(Self { tones, samples, drift, steps, products, even, odd })
            }
            _ => Err(NoFit::TooShort),
        }
    }

    /// Fits every channel of a recording.
    ///
    /// # Errors
    /// Where the recording cannot be read.
    pub fn fit<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
    ) -> Result<Vec<ToneCoefficients>, E> {
        let mut sums: Vec<ToneSums> = Vec::new();
        self.each(passes, |_, channels, waves| {
            sums.resize_with(channels.len(), || ToneSums::new(self));
            for (sums, values) in sums.iter_mut().zip(channels) {
                sums.add(values, waves);
            }
        })?;
        Ok(sums.iter().map(|sums| self.solve(sums)).collect())
    }

    /// Fits values in memory.
    pub(crate) fn fit_values(&self, values: &[f64]) -> ToneCoefficients {
        let mut sums = ToneSums::new(self);
        let mut waves = self.waves();
        for (block, values) in values.chunks(BLOCK).enumerate() {
            self.fill(&mut waves, (block * BLOCK) as u64, values.len());
            sums.add(values, &waves);
        }
        self.solve(&sums)
    }

    /// Goes through a recording with the waves of the tones at each block.
    pub(crate) fn each<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        mut each: impl FnMut(u64, &[&[f64]], &Waves),
    ) -> Result<(), E> {
        let mut waves = self.waves();
        passes.pass(&mut |first, channels| {
            let length = channels.first().map_or(0, |values| values.len()).min(BLOCK);
            self.fill(&mut waves, first, length);
            each(first, channels, &waves);
        })
    }

    /// How many coefficients a fit has: the constant, two for each tone, one for each degree of a drift.
    pub(crate) fn parameters(&self) -> usize {
        1 + 2 * self.tones.len() + self.drift
    }

    /// Room for the waves of a block.
    pub(crate) fn waves(&self) -> Waves {
        Waves::new(self.steps.len(), self.drift)
    }

    /// The waves at `length` samples from sample `first` on.
    pub(crate) fn fill(&self, waves: &mut Waves, first: u64, length: usize) {
        waves.fill(&self.steps, self.samples, first, length);
    }

    /// The variance of the factor of a polynomial, of degree 1 or more, for white noise of variance 1.
    pub(crate) fn variance_of_degree(&self, degree: usize) -> f64 {
        let (is_even, place) = place_of_degree(self.steps.len(), degree);
        let matrix = if is_even { &self.even } else { &self.odd };
        matrix[(place, place)]
    }

    /// The least-squares solution for sums of products.
    pub(crate) fn solve(&self, sums: &ToneSums) -> ToneCoefficients {
        let (even, odd) = self.to_middle(sums);
        let mut solution = self.coefficients(&(&self.even * even), &(&self.odd * odd));
        // the pilot was taken off every value
        solution.offset += sums.pilot.unwrap_or(0.0);
        solution
    }

    /// The coefficients that two solutions are, of what is even and of what is odd.
    fn coefficients(&self, even: &DVector<f64>, odd: &DVector<f64>) -> ToneCoefficients {
        let count = self.steps.len();
        let of_degree = |degree: usize| {
            let (is_even, place) = place_of_degree(count, degree);
            if is_even { even[place] } else { odd[place] }
        };
        ToneCoefficients {
            offset: even[0],
            cosines: even.iter().skip(1).take(count).copied().collect(),
            sines: odd.iter().take(count).copied().collect(),
            drift: (1..=self.drift).map(of_degree).collect(),
        }
    }

    /// The sums, which count phases from the first sample, turned to the middle: even and odd ones.
    fn to_middle(&self, sums: &ToneSums) -> (DVector<f64>, DVector<f64>) {
        let (mut even, mut odd) = self.zeros();
        even[0] = sums.values;
        for (k, step) in self.steps.iter().enumerate() {
            let (sin, cos) = step.to_middle(self.samples).sin_cos();
            even[k + 1] = sums.cosines[k] * cos + sums.sines[k] * sin;
            odd[k] = sums.sines[k] * cos - sums.cosines[k] * sin;
        }
        for (sum, degree) in sums.drift.iter().zip(1..) {
            let (is_even, place) = place_of_degree(self.steps.len(), degree);
            *(if is_even { &mut even[place] } else { &mut odd[place] }) = *sum;
        }
        (even, odd)
    }

    /// Right sides of the two systems.
    fn zeros(&self) -> (DVector<f64>, DVector<f64>) {
        (DVector::zeros(self.even.nrows()), DVector::zeros(self.odd.nrows()))
    }

    /// The factors of the tones with phases counted from the first sample.
    pub(crate) fn at_first(&self, fit: &ToneCoefficients) -> ToneCoefficients {
        let mut turned = fit.clone();
        for (k, step) in self.steps.iter().enumerate() {
            let (sin, cos) = step.to_middle(self.samples).sin_cos();
            let (a, b) = (fit.cosines[k], fit.sines[k]);
            turned.cosines[k] = a * cos - b * sin;
            turned.sines[k] = a * sin + b * cos;
        }
        turned
    }

    /// How the fit of a channel moves with the cycles of a fundamental: the fit at `cycles` that are
    /// too large by e is off by e times this (the negative of the projected derivative).
    pub(crate) fn slope(&self, fit: &ToneCoefficients, fundamental: usize) -> ToneCoefficients {
        let (even, odd) = self.derivative_products(fit, fundamental);
        self.coefficients(&-(&self.even * even), &-(&self.odd * odd))
    }

    /// The products of the constant and the waves with the derivative of a channel's fit by the
    /// cycles of a fundamental.
    pub(crate) fn derivative_products(
        &self,
        fit: &ToneCoefficients,
        fundamental: usize,
    ) -> (DVector<f64>, DVector<f64>) {
        let moment = |turns: Turns| Kernel::new(turns, self.samples).moments;
        let signed = |from: Turns, other: Turns| {
            let size = moment(from.apart(other));
            if from.value() < other.value() { -size } else { size }
        };
        let (mut even, mut odd) = self.zeros();
        for (k, (tone, step)) in self.tones.iter().zip(&self.steps).enumerate() {
            if tone.fundamental != fundamental {
                continue;
            }
            let speed = 2.0 * std::f64::consts::PI * f64::from(tone.multiple);
            let (a, b) = (-speed * fit.cosines[k], speed * fit.sines[k]);
            even[0] += a * moment(*step);
            for (l, other) in self.steps.iter().enumerate() {
                let together = moment(step.plus(*other));
                even[l + 1] += a * (together + signed(*step, *other)) / 2.0;
                odd[l] += b * (together + signed(*other, *step)) / 2.0;
            }
            for (moment, degree) in self.products.moments[k].iter().zip(1..) {
                let (is_even, place) = place_of_degree(self.steps.len(), degree);
                if is_even {
                    even[place] += a * moment;
                } else {
                    odd[place] += b * moment;
                }
            }
        }
        (even, odd)
    }
}

/// Whether a polynomial is even, and its place among the even or the odd coefficients of so many tones.
fn place_of_degree(tones: usize, degree: usize) -> (bool, usize) {
    (degree.is_multiple_of(2), tones + degree / 2)
}

/// The inverse of a normal matrix, if it is not near a singular one.
fn inverse(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    if matrix.is_empty() {
        return Some(matrix);
    }
    let largest = matrix.diagonal().max();
    let inverse = matrix.cholesky()?.inverse();
    (inverse.diagonal().max() * largest < WORST_CONDITION).then_some(inverse)
}

/// The tones at the samples of a block, with phases counted from the first sample of the record, and
/// the polynomials of a drift.
#[derive(Clone, Debug)]
pub(crate) struct Waves {
    pub(crate) cosines: Vec<Vec<f64>>,
    pub(crate) sines: Vec<Vec<f64>>,
    pub(crate) drift: Vec<Vec<f64>>,
}

impl Waves {
    pub(crate) fn new(tones: usize, degrees: usize) -> Self {
        let columns = |count| vec![Vec::new(); count];
        Self { cosines: columns(tones), sines: columns(tones), drift: columns(degrees) }
    }

    /// Those of a block of a record of so many samples.
    pub(crate) fn fill(&mut self, steps: &[Turns], samples: u64, first: u64, length: usize) {
        drift::fill(&mut self.drift, samples, first, length);
        for ((step, cos), sin) in steps.iter().zip(&mut self.cosines).zip(&mut self.sines) {
            cos.resize(length, 0.0);
            sin.resize(length, 0.0);
            oscillation(*step, first, cos, sin);
        }
    }
}

impl Waves {
    /// The values of a fit, whose phases count from the first sample, at the samples of the block.
    pub(crate) fn values(&self, at_first: &ToneCoefficients, length: usize) -> Vec<f64> {
        let mut values = vec![at_first.offset; length];
        let tones = at_first.cosines.iter().zip(&at_first.sines);
        for ((a, b), (cosines, sines)) in tones.zip(self.cosines.iter().zip(&self.sines)) {
            for (value, (cos, sin)) in values.iter_mut().zip(cosines.iter().zip(sines)) {
                *value += a * cos + b * sin;
            }
        }
        for (factor, column) in at_first.drift.iter().zip(&self.drift) {
            values.iter_mut().zip(column).for_each(|(value, drift)| *value += factor * drift);
        }
        values
    }
}

/// Sums of the values of a channel with the waves of the tones. The first value is taken off all, so
/// that a large constant costs no digits.
#[derive(Clone, Debug)]
pub(crate) struct ToneSums {
    pilot: Option<f64>,
    pub(crate) values: f64,
    pub(crate) cosines: Vec<f64>,
    pub(crate) sines: Vec<f64>,
    drift: Vec<f64>,
}

impl ToneSums {
    pub(crate) fn new(design: &ToneDesign) -> Self {
        let zeros = |count| vec![0.0; count];
        let (tones, drift) = (design.tones.len(), zeros(design.drift));
        Self { pilot: None, values: 0.0, cosines: zeros(tones), sines: zeros(tones), drift }
    }

    /// Sums of values from which nothing is taken off.
    pub(crate) fn plain(design: &ToneDesign) -> Self {
        Self { pilot: Some(0.0), ..Self::new(design) }
    }

    pub(crate) fn add(&mut self, values: &[f64], waves: &Waves) {
        let pilot = *self.pilot.get_or_insert_with(|| values.first().copied().unwrap_or(0.0));
        self.values += values.iter().map(|value| value - pilot).sum::<f64>();
        let sum = |wave: &[f64]| dot(values, wave, pilot);
        for (sums, wave) in self.cosines.iter_mut().zip(&waves.cosines) {
            *sums += sum(wave);
        }
        for (sums, wave) in self.sines.iter_mut().zip(&waves.sines) {
            *sums += sum(wave);
        }
        for (sums, column) in self.drift.iter_mut().zip(&waves.drift) {
            *sums += sum(column);
        }
    }
}

/// The sum of products in eight partial sums, always in the same order.
pub(crate) fn dot(values: &[f64], wave: &[f64], pilot: f64) -> f64 {
    CodePath::best().run(Dot { values, wave, pilot })
}

struct Dot<'a> {
    values: &'a [f64],
    wave: &'a [f64],
    pilot: f64,
}

impl gumption_engine::number::Kernel for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Self { values, wave, pilot } = self;
        let mut parts = [0.0; 8];
        let ((whole, rest), (waves, wave_rest)) = (values.as_chunks::<8>(), wave.as_chunks::<8>());
        let tail: f64 = rest.iter().zip(wave_rest).map(|(v, w)| (v - pilot) * w).sum();
        for (values, wave) in whole.iter().zip(waves) {
            for i in 0..8 {
                parts[i] += (values[i] - pilot) * wave[i];
            }
        }
        parts.iter().sum::<f64>() + tail
    }
}
