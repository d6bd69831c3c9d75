//! What a fit leaves: its size, whether it is white, and how strong it is near each tone.

use crate::coloured::{Coloured, Memory, Series};
use crate::known_noise::KnownNoise;
use crate::lattice;
use crate::outlying::Farthest;
use crate::passes::SampleSource;
use crate::sine_fit::{ToneCoefficients, ToneDesign, ToneSums, Waves, dot};

/// Lags at which the autocorrelation of residuals is looked at.
pub(crate) const LAGS: usize = 16;

/// The 99.9 % quantile of chi-squared with [`LAGS`] degrees of freedom: the residuals of one white
/// record in a thousand are taken as correlated.
pub(crate) const NOT_WHITE: f64 = 39.252;

/// Parts of a record in which the noise near a tone is measured, at most and at least.
const MOST_PARTS: u64 = 64;
const LEAST_PARTS: u64 = 8;

/// Residuals that are kept for their spectrum.
pub(crate) const KEPT: usize = 1 << 16;

/// The residuals of one channel.
#[derive(Clone, Debug)]
pub(crate) struct Residuals {
    /// Their variance, with the degrees of freedom of the fit as divisor, in the channel's unit
    /// squared.
    pub(crate) variance: f64,
    /// Values less parameters.
    pub(crate) degrees_of_freedom: f64,
    /// Their kurtosis.
    pub(crate) kurtosis: f64,
    /// The autocorrelation coefficients at lags 1, 2, ...
    pub(crate) autocorrelation: Vec<f64>,
    /// Whether they are correlated beyond what white noise shows, or may be in a short record.
    pub(crate) correlated: bool,
    /// What a short record tells of a memory of the noise.
    pub(crate) memory: Memory,
    /// The variance of the cosine's and the sine's factor of each tone over that which white noise of
    /// the same variance gives; none where neither parts of the record nor a model of the noise tell.
    pub(crate) local: Option<Vec<[f64; 2]>>,
    /// The parts of the record that `local` comes from; 0 if it comes from a model.
    pub(crate) parts: u64,
    /// What a model of the noise says, where it is not white.
    pub(crate) coloured: Option<Coloured>,
    /// By how much the cycles in a sample interval of a fundamental should be larger, and the
    /// variance of that for residuals of variance 1.
    pub(crate) cycles: Vec<(f64, f64)>,
    /// The first residuals.
    pub(crate) first: Vec<f64>,
    /// Those farthest from zero.
    pub(crate) farthest: Farthest,
    /// The step that the values are multiples of, where there is one that counts beside the noise.
    pub(crate) lattice: Option<f64>,
    /// Whether they go steadily up or down or bend over the record, beyond what white noise does.
    pub(crate) drifts: bool,
    /// What is known of the noise otherwise, after steps that change it.
    pub(crate) known: Option<KnownNoise>,
}

/// Of what a fit leaves, the variance and where the frequencies should go.
#[derive(Clone, Debug)]
pub(crate) struct Remainder {
    /// As in [`Residuals`].
    pub(crate) variance: f64,
    degrees_of_freedom: f64,
    /// As in [`Residuals`].
    pub(crate) cycles: Vec<(f64, f64)>,
}

impl Residuals {
    /// Whether the noise near the tones is known from parts of the record or from a model that fits.
    pub(crate) fn is_measured(&self) -> bool {
        self.parts > 0 || self.coloured.as_ref().is_some_and(|coloured| coloured.fits)
    }

    /// Degrees of freedom of the noise near the tones.
    pub(crate) fn noise_freedom(&self) -> f64 {
        match (&self.known, &self.local) {
            (Some(KnownNoise { factors: Some(_), freedom, .. }), _) => *freedom,
            (_, Some(_)) if self.correlated => match &self.coloured {
                Some(coloured) if self.parts == 0 => coloured.freedom,
                _ => 2.0 * (self.parts as f64 - 1.0),
            },
            _ => self.degrees_of_freedom,
        }
    }
}

/// The kurtosis of residuals, the mean of the fourth powers over the square of the mean square, times
/// (n + 1)/(n - 1), so that it is 3 on average for normal ones; 3 where there are none.
pub(crate) fn kurtosis(residuals: &[f64]) -> f64 {
    let count = residuals.len() as f64;
    let square = residuals.iter().map(|e| e * e).sum::<f64>() / count;
    let fourth =
        residuals.iter().map(|e| e * e / square).map(|square| square * square).sum::<f64>() / count;
    let found = fourth * (count + 1.0) / (count - 1.0);
    if found.is_finite() { found } else { 3.0 }
}

/// The relative variance of the power of noise that is found with so many degrees of freedom,
/// (kurtosis - 1)/freedom: 2/freedom where it is normal. Exact for many values of white noise and of
/// noise with a memory of first order, whatever its distribution.
///
/// Source: H. Cramér, Mathematical Methods of Statistics (1946), 27.4 (variance of the variance of a
/// sample).
pub(crate) fn variance_of_power(kurtosis: f64, freedom: f64) -> f64 {
    (kurtosis - 1.0).max(0.0) / freedom
}

/// The residuals of every channel; the fits are refined by what the residuals still have of the
/// tones.
pub(crate) fn of<E>(
    design: &ToneDesign,
    passes: &mut dyn SampleSource<Error = E>,
    fits: &mut [ToneCoefficients],
) -> Result<Vec<Residuals>, E> {
    let gathered = gathered(design, passes, fits)?;
    let of = |(gathered, fit): (Gathered, &mut ToneCoefficients)| gathered.residuals(design, fit);
    Ok(gathered.into_iter().zip(fits).map(of).collect())
}

/// The same without a look at what the noise is, for steps on the way to the frequencies.
pub(crate) fn remainders<E>(
    design: &ToneDesign,
    passes: &mut dyn SampleSource<Error = E>,
    fits: &mut [ToneCoefficients],
) -> Result<Vec<Remainder>, E> {
    let gathered = gathered(design, passes, fits)?;
    let of = |(gathered, fit): (&Gathered, &mut ToneCoefficients)| gathered.remainder(design, fit);
    Ok(gathered.iter().zip(fits).map(of).collect())
}

fn gathered<E>(
    design: &ToneDesign,
    passes: &mut dyn SampleSource<Error = E>,
    fits: &[ToneCoefficients],
) -> Result<Vec<Gathered>, E> {
    let fundamentals = design.tones.iter().map(|tone| tone.fundamental + 1).max().unwrap_or(0);
    let parts = parts(design);
    let mut gathered: Vec<Gathered> =
        fits.iter().map(|fit| Gathered::new(design, fit, fundamentals, parts)).collect();
    design.each(passes, |first, channels, waves| {
        for (gathered, values) in gathered.iter_mut().zip(channels) {
            gathered.add(design, first, values, waves);
        }
    })?;
    Ok(gathered)
}

/// Into how many parts a record is cut: each has a whole period of every fundamental at least.
pub(crate) fn parts(design: &ToneDesign) -> Option<u64> {
    let named = design.tones.iter().filter(|tone| !tone.beside);
    let slowest = named.map(|tone| tone.cycles).fold(f64::INFINITY, f64::min);
    let periods = (slowest * design.samples as f64).floor();
    let parts = (periods as u64).min(MOST_PARTS).min(design.samples / 16);
    (periods.is_finite() && parts >= LEAST_PARTS).then_some(parts)
}

/// What is summed up on the way.
struct Gathered {
    at_first: ToneCoefficients,
    /// Sums of the residuals with the tones.
    sums: ToneSums,
    squares: f64,
    products: [f64; LAGS],
    /// The last residuals of the block before.
    last: Vec<f64>,
    /// Sums with the tones in the present part, and what the finished parts had: their count, sums
    /// and sums of squares for each tone.
    part: Option<Harmonic>,
    /// For each fundamental: sums of residual times derivative, and of the derivative's square.
    derivatives: Vec<(f64, f64)>,
    first: Vec<f64>,
    farthest: Farthest,
    /// The first values.
    values: Vec<f64>,
    series: Series,
}

struct Harmonic {
    length: u64,
    filled: u64,
    count: u64,
    now: Vec<(f64, f64)>,
    squares: Vec<f64>,
}

impl Gathered {
    fn new(
        design: &ToneDesign,
        fit: &ToneCoefficients,
        fundamentals: usize,
        parts: Option<u64>,
    ) -> Self {
        let tones = design.tones.len();
        Self {
            at_first: design.at_first(fit),
            sums: ToneSums::plain(design),
            squares: 0.0,
            products: [0.0; LAGS],
            last: Vec::new(),
            part: parts.map(|parts| Harmonic {
                length: design.samples / parts,
                filled: 0,
                count: 0,
                now: vec![(0.0, 0.0); tones],
                squares: vec![0.0; tones],
            }),
            derivatives: vec![(0.0, 0.0); fundamentals],
            first: Vec::new(),
            farthest: Farthest::default(),
            values: Vec::new(),
            series: Series::new(design.samples),
        }
    }

    fn add(&mut self, design: &ToneDesign, first: u64, values: &[f64], waves: &Waves) {
        let mut residuals: Vec<f64> =
            values.iter().map(|value| value - self.at_first.offset).collect();
        let mut slopes = vec![vec![0.0; values.len()]; self.derivatives.len()];
        for (k, tone) in design.tones.iter().enumerate() {
            let (a, b) = (self.at_first.cosines[k], self.at_first.sines[k]);
            let speed = 2.0 * std::f64::consts::PI * f64::from(tone.multiple);
            let slope = &mut slopes[tone.fundamental];
            let waves = waves.cosines[k].iter().zip(&waves.sines[k]);
            for ((residual, slope), (cos, sin)) in residuals.iter_mut().zip(slope).zip(waves) {
                *residual -= a * cos + b * sin;
                *slope += speed * (b * cos - a * sin);
            }
        }
        for (factor, column) in self.at_first.drift.iter().zip(&waves.drift) {
            residuals.iter_mut().zip(column).for_each(|(left, drift)| *left -= factor * drift);
        }
        let middle = (design.samples as f64 - 1.0) / 2.0;
        for (sums, slope) in self.derivatives.iter_mut().zip(&slopes) {
            for (i, (slope, residual)) in slope.iter().zip(&residuals).enumerate() {
                let derivative = slope * ((first + i as u64) as f64 - middle);
                sums.0 += derivative * residual;
                sums.1 += derivative * derivative;
            }
        }
        self.sums.add(&residuals, waves);
        self.squares += dot(&residuals, &residuals, 0.0);
        self.correlate(&residuals);
        if let Some(part) = &mut self.part {
            part.add(&residuals, waves);
        }
        let room = KEPT.saturating_sub(self.first.len()).min(residuals.len());
        self.first.extend_from_slice(&residuals[..room]);
        self.farthest.add(first, values, &residuals);
        self.series.add(&residuals);
        let room = lattice::LOOKED_AT.saturating_sub(self.values.len()).min(values.len());
        self.values.extend_from_slice(&values[..room]);
    }

    fn correlate(&mut self, residuals: &[f64]) {
        let before = self.last.len();
        let mut joined = std::mem::take(&mut self.last);
        joined.extend_from_slice(residuals);
        for (lag, product) in self.products.iter_mut().enumerate() {
            let lag = lag + 1;
            let from = before.max(lag);
            if let (Some(late), Some(early)) = (
                joined.get(from..),
                joined.get(from - lag..joined.len().saturating_sub(lag).max(from - lag)),
            ) {
                *product += dot(late, early, 0.0);
            }
        }
        let keep = joined.len().saturating_sub(LAGS);
        self.last = joined.split_off(keep);
    }

    fn remainder(&self, design: &ToneDesign, fit: &mut ToneCoefficients) -> Remainder {
        // one step of refinement: what the residuals still have of the constant and the tones
        let rest = design.solve(&self.sums);
        fit.offset += rest.offset;
        for (value, rest) in fit.cosines.iter_mut().zip(&rest.cosines) {
            *value += rest;
        }
        for (value, rest) in fit.sines.iter_mut().zip(&rest.sines) {
            *value += rest;
        }
        for (value, rest) in fit.drift.iter_mut().zip(&rest.drift) {
            *value += rest;
        }
        let degrees_of_freedom = design.samples as f64 - design.parameters() as f64;
        let cycles = self.derivatives.iter().enumerate();
        let cycles = cycles.map(|(fundamental, (product, square))| {
            let (even, odd) = design.derivative_products(fit, fundamental);
            let explained = even.dot(&(&design.even * &even)) + odd.dot(&(&design.odd * &odd));
            let left = square - explained;
            if left > 0.0 { (product / left, 1.0 / left) } else { (0.0, f64::INFINITY) }
        });
        Remainder {
            variance: self.squares / degrees_of_freedom,
            degrees_of_freedom,
            cycles: cycles.collect(),
        }
    }

    fn residuals(self, design: &ToneDesign, fit: &mut ToneCoefficients) -> Residuals {
        let Remainder { variance, degrees_of_freedom, cycles } = self.remainder(design, fit);
        let samples = design.samples as f64;
        let power = if self.squares > 0.0 { self.squares } else { 1.0 };
        let autocorrelation: Vec<f64> = self.products.iter().map(|p| p / power).collect();
        let statistic = samples * autocorrelation.iter().map(|r| r * r).sum::<f64>();
        let by_lags = statistic > NOT_WHITE;
        let memory = match self.series.memory(design) {
            _ if by_lags => Memory::None,
            memory => memory,
        };
        let correlated = by_lags || matches!(memory, Memory::Suspected | Memory::Told);
        let mut parts = self.part.as_ref().map_or(0, |part| part.count);
        let coloured = (correlated || self.series.wanders(variance))
            .then(|| self.series.coloured(design, parts > 0))
            .flatten();
        let modelled = coloured.as_ref().and_then(|coloured| coloured.over_white(design, variance));
        let local = match (modelled, self.part) {
            (Some(modelled), _) => {
                parts = 0;
                Some(modelled)
            }
            (None, part) => {
                part.map(|part| part.local(variance).into_iter().map(|f| [f, f]).collect())
            }
        };
        Residuals {
            variance,
            degrees_of_freedom,
            kurtosis: kurtosis(&self.first),
            correlated,
            memory,
            parts,
            local,
            coloured,
            cycles,
            autocorrelation,
            first: self.first,
            farthest: self.farthest,
            lattice: lattice::step(&self.values, variance.sqrt()),
            drifts: self.series.drifts(variance),
            known: None,
        }
    }
}

impl Harmonic {
    fn add(&mut self, residuals: &[f64], waves: &Waves) {
        let mut from = 0;
        while from < residuals.len() {
            let room = (self.length - self.filled) as usize;
            let end = (from + room).min(residuals.len());
            let piece = residuals.get(from..end).unwrap_or(&[]);
            let sum = |wave: &[f64]| dot(piece, wave.get(from..end).unwrap_or(&[]), 0.0);
            for (k, (re, im)) in self.now.iter_mut().enumerate() {
                *re += sum(&waves.cosines[k]);
                *im += sum(&waves.sines[k]);
            }
            self.filled += (end - from) as u64;
            from = end;
            if self.filled == self.length {
                for ((re, im), squares) in self.now.iter_mut().zip(&mut self.squares) {
                    *squares += *re * *re + *im * *im;
                    (*re, *im) = (0.0, 0.0);
                }
                self.filled = 0;
                self.count += 1;
            }
        }
    }

    /// Noise power at each tone over that of white noise: the scatter of the sums of the parts. Of
    /// white noise a sum has the variance length x variance; all sums of a record add up to zero,
    /// which costs one of them.
    fn local(&self, variance: f64) -> Vec<f64> {
        let expected = variance * self.length as f64 * (self.count as f64 - 1.0);
        self.squares.iter().map(|s| if expected > 0.0 { s / expected } else { 1.0 }).collect()
    }
}
