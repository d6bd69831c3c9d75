//! A step's uncertainty by Monte Carlo over a recording's own noise.
//!
//! The recording's model (what was fitted, or any signal without noise) gets new noise like the
//! residuals again and again, the step runs on each, and its results scatter as they do from
//! recording to recording. For steps whose law of propagation is not exact, and to check those whose
//! is. It knows of the noise what the residuals say; a wrong model stays wrong.
//!
//! Source: JCGM 101:2008, 7; for blocks H. R. Künsch, Ann. Statist. 17 (1989) 1217.

use gumption_engine::parallel;

use crate::Signal;
use gumption_engine::distribution::{Normal, Stream, StreamKey};
use gumption_engine::number::{COLUMN, Column};

/// What of the residuals the new noise keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Colour {
    /// The variance: independent normal noise.
    White,
    /// The variance and the autocorrelation up to so many values: a normal autoregressive process
    /// of this order (Yule and Walker's equations). For noise with a smooth spectrum; a sharp filter
    /// needs an order of about the length of its impulse response.
    Autoregressive(usize),
    /// Blocks of so many successive residuals, drawn with replacement: any distribution, and the
    /// autocorrelation as far as it is short against the block. It leaves out about the
    /// autocorrelation's length over the block's of the variance of slow results.
    Blocks(usize),
}

/// How the noise is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resimulation {
    /// Number of simulated recordings; at least 2. A standard deviation from n of them has a relative
    /// standard deviation of 1 / sqrt(2 n).
    pub trials: usize,
    /// Seed of the random numbers. The same seed gives the same answer on any number of threads.
    pub seed: u64,
    /// What of the residuals is kept.
    pub colour: Colour,
    /// Number of parameters that were fitted to the recording: the noise's variance is the sum of
    /// the squared residuals over values less parameters.
    pub parameters: usize,
}

/// How a step's results scatter.
#[derive(Clone, Debug, PartialEq)]
pub struct ResimulatedScatter {
    /// Mean of each result. Its distance from the result of the model without noise is the bias
    /// that noise causes.
    pub mean: Vec<f64>,
    /// Covariance of the results, row by row.
    pub covariance: Vec<Vec<f64>>,
    /// Trials on which the step failed; they are left out.
    pub failed: usize,
}

impl ResimulatedScatter {
    /// The standard deviation of a result.
    pub fn standard_deviation(&self, result: usize) -> f64 {
        self.covariance[result][result].sqrt()
    }
}

impl Resimulation {
    /// Runs a step on the model with new noise. `residuals` are what the model leaves of the
    /// recording, `step` gives as many results each time, or none where it cannot be done.
    ///
    /// Gives nothing where fewer than two trials succeed.
    pub fn run(
        &self,
        model: &Signal,
        residuals: &[f64],
        step: impl Fn(&Signal) -> Option<Vec<f64>> + Sync,
    ) -> Option<ResimulatedScatter> {
        let source = UncertaintySource::of(residuals, self.colour, self.parameters);
        let key = StreamKey::new(self.seed, "observe/resimulation");
        let results: Vec<Option<Vec<f64>>> = parallel::map(0..self.trials as u64, |trial| {
            let mut signal = model.clone();
            source.add(&mut signal.values, key.block(trial));
            step(&signal)
        });
        let failed = results.iter().filter(|result| result.is_none()).count();
        let results: Vec<Vec<f64>> = results.into_iter().flatten().collect();
        let (n, first) = (results.len(), results.first()?);
        if n < 2 {
            return None;
        }
        // about the first, so that close results lose no digits
        let width = first.len();
        let mean: Vec<f64> = (0..width)
            .map(|i| first[i] + results.iter().map(|r| r[i] - first[i]).sum::<f64>() / n as f64)
            .collect();
        let covariance = (0..width)
            .map(|i| {
                (0..width)
                    .map(|j| {
                        let products = results.iter().map(|r| (r[i] - mean[i]) * (r[j] - mean[j]));
                        products.sum::<f64>() / (n - 1) as f64
                    })
                    .collect()
            })
            .collect();
        Some(ResimulatedScatter { mean, covariance, failed })
    }
}

/// Where noise comes from.
enum UncertaintySource {
    /// Normal: standard deviation of the innovations and coefficients of the values before; and how
    /// many values pass until the start is forgotten.
    Normal {
        sigma: f64,
        coefficients: Vec<f64>,
        before: usize,
    },
    Blocks {
        residuals: Vec<f64>,
        length: usize,
    },
}

impl UncertaintySource {
    fn of(residuals: &[f64], colour: Colour, parameters: usize) -> Self {
        let n = residuals.len().max(1) as f64;
        let lost = (n / (n - parameters as f64).max(1.0)).sqrt();
        match colour {
            Colour::White => {
                let power = residuals.iter().map(|e| e * e).sum::<f64>() / n;
                Self::Normal { sigma: power.sqrt() * lost, coefficients: Vec::new(), before: 0 }
            }
            Colour::Autoregressive(order) => {
                let (coefficients, power) = yule_walker(residuals, order);
                let before = 50 * (coefficients.len() + 20);
                Self::Normal { sigma: power.sqrt() * lost, coefficients, before }
            }
            Colour::Blocks(length) => Self::Blocks {
                residuals: residuals.iter().map(|e| e * lost).collect(),
                length: length.clamp(1, residuals.len().max(1)),
            },
        }
    }

    fn add(&self, values: &mut [f64], mut stream: Stream) {
        match self {
            Self::Normal { sigma, coefficients, before } => {
                let order = coefficients.len();
                let mut noise = normals(&mut stream, values.len() + before);
                for k in 0..noise.len() {
                    let past: f64 =
                        (0..order.min(k)).map(|i| coefficients[i] * noise[k - 1 - i]).sum();
                    noise[k] = sigma * noise[k] + past;
                }
                for (value, e) in values.iter_mut().zip(&noise[*before..]) {
                    *value += e;
                }
            }
            Self::Blocks { residuals, length } if !residuals.is_empty() => {
                let n = residuals.len();
                for block in values.chunks_mut(*length) {
                    let mut drawn = [0.0; 8];
                    stream.uniform(&mut drawn);
                    // below n, as the number drawn is below one
                    let first = (drawn[0] * n as f64) as usize;
                    for (i, value) in block.iter_mut().enumerate() {
                        *value += residuals[(first + i) % n];
                    }
                }
            }
            Self::Blocks { .. } => {}
        }
    }
}

fn normals(stream: &mut Stream, count: usize) -> Vec<f64> {
    let mut numbers = Vec::with_capacity(count + COLUMN);
    let mut column = Column([0.0; COLUMN]);
    while numbers.len() < count {
        Normal::standard_draw(stream, &mut column);
        numbers.extend_from_slice(&column.0);
    }
    numbers.truncate(count);
    numbers
}

/// Coefficients of an autoregressive process and the variance of its innovations, by Levinson and
/// Durbin's recursion from the (biased, so that the process is stable) autocovariances.
fn yule_walker(residuals: &[f64], order: usize) -> (Vec<f64>, f64) {
    let n = residuals.len();
    let order = order.min(n.saturating_sub(1));
    let covariance: Vec<f64> = (0..=order)
        .map(|lag| {
            let pairs = residuals.iter().zip(&residuals[lag.min(n)..]);
            pairs.map(|(a, b)| a * b).sum::<f64>() / n.max(1) as f64
        })
        .collect();
    let (mut coefficients, mut power) = (Vec::<f64>::new(), covariance[0]);
    for m in 1..=order {
        if power <= 0.0 {
            break;
        }
        let past: f64 =
            coefficients.iter().enumerate().map(|(i, c)| c * covariance[m - 1 - i]).sum();
        let reflection = (covariance[m] - past) / power;
        let turned: Vec<f64> = coefficients.iter().rev().copied().collect();
        for (c, r) in coefficients.iter_mut().zip(turned) {
            *c -= reflection * r;
        }
        coefficients.push(reflection);
        power *= 1.0 - reflection * reflection;
    }
    (coefficients, power.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Noises, SETTINGS, Setting};
    use crate::{
        Band, Butterworth, CrossCorrelation, Harmonics, Measured, Noise, Periodic, RateSearch,
        sampling_rate,
    };

    fn exactly(value: f64) -> Measured {
        Measured { value, standard_uncertainty: 0.0, degrees_of_freedom: f64::INFINITY }
    }

    /// A recording, its fit, and the model without noise.
    fn fitted(setting: Setting, seed: u64) -> (Signal, Periodic, Signal) {
        let mut noise = Noises::new("resimulated", seed);
        let signal = setting.record(&mut noise, setting.sine(0.7));
        let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
        let fit = Periodic::fit(&signal, harmonics).unwrap();
        let left = fit.without(&signal);
        let values = signal.values.iter().zip(&left).map(|(x, e)| x - e).collect();
        let model = Signal { values, ..signal };
        (signal, fit, model)
    }

    const MANY: Resimulation =
        Resimulation { trials: 1000, seed: 11, colour: Colour::White, parameters: 3 };

    /// The law of propagation against the simulation: sampling rate, amplitude, phase. 1,000 trials
    /// give a standard deviation to 2.2 %; four of them and 1 % for the fit's own variance (for
    /// White both take the same).
    #[test]
    fn propagation_and_resimulation_agree() {
        let setting = SETTINGS[0];
        let (signal, fit, model) = fitted(setting, 1);
        let search = RateSearch {
            frequency: exactly(setting.frequency),
            between: [1200.0, 2200.0],
            step: 1.0,
            noise: Noise::White,
        };
        let rate = sampling_rate(&signal, &search).unwrap().rate.standard_uncertainty;
        let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
        let [a, p] = [fit.parts[0].amplitude(), fit.parts[0].phase()];
        let run = |colour| {
            let step = |signal: &Signal| {
                let part = Periodic::fit(signal, harmonics).ok()?.parts[0];
                let rate = sampling_rate(signal, &search).ok()?.rate.value;
                Some(vec![part.amplitude().value, part.phase().value, rate])
            };
            let left = fit.without(&signal);
            Resimulation { colour, trials: 600, ..MANY }.run(&model, &left, step).unwrap()
        };
        let white = run(Colour::White);
        assert_eq!(white.failed, 0);
        let expected = [a.standard_uncertainty, p.standard_uncertainty, rate];
        for (i, u) in expected.into_iter().enumerate() {
            // 600 trials: 2.9 %, four of them
            let ratio = white.standard_deviation(i) / u;
            assert!((ratio - 1.0).abs() < 0.12, "result {i}: {ratio}");
        }
        // white noise has no memory for blocks or a process to keep
        for colour in [Colour::Blocks(20), Colour::Autoregressive(4)] {
            let other = run(colour);
            // the residuals' own density at the frequency is less sure than their variance
            let ratio = other.standard_deviation(0) / a.standard_uncertainty;
            assert!((ratio - 1.0).abs() < 0.3, "{colour:?}: {ratio}");
        }
    }

    /// The delay of noisy sines against its law of propagation; noise in the channel only.
    #[test]
    fn delay_and_resimulation_agree() {
        let (signal, fit, model) = fitted(SETTINGS[2], 2);
        let clean = model.clone();
        let correlation = CrossCorrelation::Periodic(Harmonics { frequency: 10.0, count: 1 });
        let u = correlation.of(&clean, &signal).unwrap().delay.standard_uncertainty;
        let step = |signal: &Signal| Some(vec![correlation.of(&clean, signal).ok()?.delay.value]);
        let scatter =
            Resimulation { trials: 400, ..MANY }.run(&model, &fit.without(&signal), step).unwrap();
        // 400 trials: 3.5 %, four of them
        assert!((scatter.standard_deviation(0) / u - 1.0).abs() < 0.15);
    }

    /// After the source's filter the residuals are not white: u from them is a fourth of the right
    /// one. The filter's factor, the density near the frequency, and the simulation with a process
    /// or with blocks that keep the autocorrelation say the same. The density has 64 degrees of
    /// freedom (9 %), the simulation 3 %, blocks of 200 of a correlation of about 20 lose 10 %, and a
    /// process of order 30 follows the filter's edge roughly.
    #[test]
    fn filtered_noise_has_one_uncertainty() {
        let setting = Setting { rate: 1612.0, frequency: 5.0, periods: 100.0, snr: 40.0, bits: 24 };
        let mut noise = Noises::new("filtered", 3);
        let signal = setting.record(&mut noise, setting.sine(0.7));
        let filter = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: false };
        let filter = filter.at(1612.0).unwrap();
        let signal = filter.apply(&signal, 1e-6).settled().unwrap();
        let harmonics = Harmonics { frequency: 5.0, count: 1 };
        let fit = Periodic::fit(&signal, harmonics).unwrap();
        let white = fit.parts[0].amplitude().standard_uncertainty;
        let factor = filter.noise().factor(filter.response(5.0));
        assert!(factor > 4.0 && factor < 5.0);
        let right = setting.sigma() * (2.0 / signal.values.len() as f64).sqrt();
        assert!((factor * white / right - 1.0).abs() < 0.1, "{}", factor * white / right);
        let near = Noise::Near(32).of(fit.clone(), &signal).parts[0].amplitude();
        assert!((near.standard_uncertainty / right - 1.0).abs() < 0.36, "{near:?}");
        let left = fit.without(&signal);
        let values = signal.values.iter().zip(&left).map(|(x, e)| x - e).collect();
        let model = Signal { values, ..signal };
        let step = |signal: &Signal| {
            Some(vec![Periodic::fit(signal, harmonics).ok()?.parts[0].amplitude().value])
        };
        for colour in [Colour::Autoregressive(30), Colour::Blocks(200)] {
            let run = Resimulation { trials: 400, colour, ..MANY };
            let ratio = run.run(&model, &left, step).unwrap().standard_deviation(0) / right;
            assert!((ratio - 1.0).abs() < 0.35, "{colour:?}: {ratio}");
        }
    }

    /// The coefficients of a known process, 1.2 and -0.5, from 40 000 values: their standard
    /// deviations are sqrt((1 - 0.25) / n) = 0.0043; four of them.
    #[test]
    fn autoregressive_process_is_recovered() {
        let mut noise = Noises::new("process", 0);
        let mut values = vec![0.0, 0.0];
        for k in 2..40_000 {
            values.push(1.2 * values[k - 1] - 0.5 * values[k - 2] + noise.next());
        }
        let (coefficients, power) = yule_walker(&values, 2);
        assert!((coefficients[0] - 1.2).abs() < 0.018, "{coefficients:?}");
        assert!((coefficients[1] + 0.5).abs() < 0.018);
        assert!((power - 1.0).abs() < 0.03);
        assert_eq!(yule_walker(&[0.0; 9], 3), (Vec::new(), 0.0));
    }

    /// The same seed gives the same bits, whatever the number of threads.
    #[test]
    fn seed_decides_the_answer() {
        let (signal, fit, model) = fitted(SETTINGS[6], 4);
        let left = fit.without(&signal);
        let run = |seed, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let step = |signal: &Signal| Some(vec![signal.values.iter().sum()]);
            let how = Resimulation { seed, trials: 20, colour: Colour::Blocks(7), ..MANY };
            pool.install(|| how.run(&model, &left, step).unwrap())
        };
        assert_eq!(run(1, 1), run(1, 2));
        assert_ne!(run(1, 1), run(2, 1));
        let never = MANY.run(&model, &left, |_| None);
        assert_eq!(never, None);
    }
}
