//! The noise of a channel after its steps, from what it was before them and what they did to it.

use std::rc::Rc;

use super::Signal;
use super::analysed::{Analysed, local, shares};
use super::coloured::Memory;
use super::effects::{Coloured, Effects, StepEffect};
use super::known_noise::{KnownNoise, NoiseSource, SeenBefore};
use super::note::ChannelNote;
use super::passes::ChannelValues;
use super::periodic::{HarmonicNoise, Harmonics};
use super::quantization::amplitude_error;
use super::residuals::{Residuals, parts};
use super::sine_fit::{Tone, ToneDesign};
use super::spurious::{Spurious, lines};
use super::transform;
use super::unexplained::level_wanders;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};

/// Bins on each side of a line that have its power.
const OF_LINE: f64 = 2.5;

/// Steps that a channel went through.
#[derive(Clone, Debug)]
pub(super) struct Through {
    pub(super) effects: Rc<Effects>,
    /// The channel just before the first of them that has an effect.
    pub(super) before: Analysed,
}

/// Noise before and after the steps.
struct Passed {
    before: Coloured,
    after: Coloured,
}

impl Passed {
    /// How strong the noise near a frequency is after the steps over what it was before them.
    fn gain(&self, place: usize) -> Option<f64> {
        let (before, after) = (self.before.densities.get(place)?, self.after.densities.get(place)?);
        let gain = after / before;
        gain.is_finite().then_some(gain)
    }
}

impl Through {
    /// The noise after the steps. Where it was white before them it is theirs; where it was not, it
    /// is measured after them, or that of the process before them, or taken as even over what the
    /// steps let pass.
    pub(super) fn noise(&self, design: &ToneDesign, after: &Residuals, rate: f64) -> KnownNoise {
        let before = &self.before.residuals;
        let frequencies: Vec<f64> =
            [0.0].into_iter().chain(design.tones.iter().map(|tone| tone.cycles * rate)).collect();
        let white = self.effects.coloured(&|_| 1.0, design.samples, rate, &frequencies);
        let process = self.process(design.samples, rate, &frequencies);
        let (source, factors, freedom) = self.near_tones(design, after, &white, process.as_ref());
        let (level, of_level) = self.level(design, after, &white, process.as_ref());
        let (_, tones) = white.densities.split_first().unwrap_or((&1.0, &[]));
        let passes = !self.squares() && self.effects.power_gain(0.0) > 0.0;
        KnownNoise {
            source,
            factors,
            freedom,
            level,
            of_level,
            of_residuals: self.freedom(design, after, &white, process.as_ref()),
            shares: shares(&self.before),
            rounding: self.rounding(tones),
            unfitted: self.unfitted(rate),
            before: SeenBefore {
                memory: before.memory,
                coefficient: before.autocorrelation.first().copied().unwrap_or(0.0),
                wanders: passes && level_wanders(&self.before),
                flickers: passes
                    && before.coloured.as_ref().is_some_and(|coloured| coloured.flickers),
            },
        }
    }

    /// Whether the noise at zero is that at another frequency before the steps.
    fn squares(&self) -> bool {
        let squares = |effect: &StepEffect| matches!(effect, StepEffect::Squared { .. });
        self.effects.0.iter().any(squares)
    }

    /// The noise of the process that the residuals before the steps have, where one fits.
    fn process(&self, samples: u64, rate: f64, frequencies: &[f64]) -> Option<Passed> {
        let process = self.before.residuals.coloured.as_ref().filter(|process| process.fits)?;
        let density = |hertz: f64| process.density(hertz / rate);
        let of = |effects: &Effects| effects.coloured(&density, samples, rate, frequencies);
        Some(Passed { before: of(&Effects::default()), after: of(&self.effects) })
    }

    /// A variance before the steps over that of the residuals after them.
    fn over(after: &Residuals, white: &Coloured, variance: f64) -> f64 {
        let over = if after.variance > 0.0 { variance / after.variance } else { 1.0 / white.power };
        if over.is_finite() { over } else { 1.0 }
    }

    /// Where the noise near the tones is known from, the factors of their variances, and the degrees
    /// of freedom of these.
    fn near_tones(
        &self,
        design: &ToneDesign,
        after: &Residuals,
        white: &Coloured,
        process: Option<&Passed>,
    ) -> (NoiseSource, Option<Vec<[f64; 2]>>, f64) {
        let before = &self.before.residuals;
        let all = |factor: f64| {
            let tones = white.densities.iter().skip(1);
            Some(tones.map(|density| [factor * density; 2]).collect())
        };
        if !before.correlated {
            let factor = Self::over(after, white, before.variance);
            return (NoiseSource::White, all(factor), before.degrees_of_freedom);
        }
        let few = parts(design).is_none();
        let by_process = process.filter(|_| few || !after.is_measured());
        if let Some(factors) =
            by_process.and_then(|process| self.by_process(design, after, process))
        {
            let freedom = before.coloured.as_ref().map_or(1.0, |coloured| coloured.freedom);
            return (NoiseSource::Process, Some(factors), freedom);
        }
        if before.is_measured() && after.is_measured() {
            return (NoiseSource::Measured, None, 0.0);
        }
        let even = 1.0 / white.power.max(f64::MIN_POSITIVE);
        (NoiseSource::Even, all(even), (white.freedom - 3.0).max(1.0))
    }

    /// The factors of the tones' variances, from the process before the steps.
    fn by_process(
        &self,
        design: &ToneDesign,
        after: &Residuals,
        passed: &Passed,
    ) -> Option<Vec<[f64; 2]>> {
        let before = &self.before;
        let local = before.residuals.local.as_ref()?;
        if after.variance <= 0.0 {
            return None;
        }
        let of = |(place, tone): (usize, &Tone)| {
            let same = |other: &Tone| {
                (other.fundamental, other.multiple, other.beside)
                    == (tone.fundamental, tone.multiple, tone.beside)
            };
            let known = before.design.tones.iter().position(same);
            let known = known.and_then(|known| Some((*local.get(known)?, passed.gain(place + 1)?)));
            Some(match known {
                Some((factors, gain)) => {
                    factors.map(|factor| factor * gain * before.residuals.variance / after.variance)
                }
                None => [passed.after.densities.get(place + 1)? / after.variance; 2],
            })
        };
        design.tones.iter().enumerate().map(of).collect()
    }

    /// The variance of the constant, and its degrees of freedom where they are not those of the noise
    /// near the tones.
    fn level(
        &self,
        design: &ToneDesign,
        after: &Residuals,
        white: &Coloured,
        process: Option<&Passed>,
    ) -> (f64, Option<f64>) {
        let before = &self.before.residuals;
        let zero = white.densities.first().copied().unwrap_or(1.0);
        let even = design.even[(0, 0)];
        let of_white =
            |variance: f64| after.variance * even * (Self::over(after, white, variance) * zero);
        let Some(coloured) = &before.coloured else {
            let slow = 1.0 + 2.0 * before.autocorrelation.iter().sum::<f64>();
            let slow = if before.correlated { slow.max(0.1) } else { 1.0 };
            return (of_white(before.variance * slow), None);
        };
        if self.squares() {
            // the noise at zero is that about the frequency of the velocity
            let level = process.and_then(|process| process.after.densities.first());
            return match level.filter(|level| level.is_finite()) {
                Some(level) => (level * even, Some(coloured.freedom)),
                None => (of_white(before.variance), None),
            };
        }
        let passes = self.effects.power_gain(0.0);
        if coloured.walks && passes > 0.0 {
            // beside a tone that is not fitted nothing wanders
            let still = !level_wanders(&self.before);
            let level = if still { coloured.still } else { coloured.level };
            return (level * passes, (!still).then_some(coloured.freedom));
        }
        let shorter = even / self.before.design.even[(0, 0)];
        let gain = match process {
            Some(of) if coloured.walks => {
                let level = of.after.densities.first().map_or(0.0, |level| level * even);
                return (level, Some(coloured.freedom));
            }
            Some(of) => of.gain(0).unwrap_or(zero),
            None => zero,
        };
        (coloured.level * shorter * gain, Some(coloured.freedom))
    }

    /// The degrees of freedom of the residuals' variance after the steps.
    fn freedom(
        &self,
        design: &ToneDesign,
        after: &Residuals,
        white: &Coloured,
        process: Option<&Passed>,
    ) -> f64 {
        let before = &self.before.residuals;
        let fitted = design.parameters() as f64;
        let every = before.coloured.as_ref().map_or(0, |coloured| coloured.every);
        let freedom = match process {
            _ if !before.correlated => white.freedom - fitted,
            Some(of) if every == 1 => of.after.freedom - fitted,
            _ => freedom_of_first(design, after),
        };
        freedom.max(1.0)
    }

    /// What rounding does to the amplitudes of tones near which the steps have these gains of power.
    fn rounding(&self, gains: &[f64]) -> Vec<f64> {
        let resolution = self.before.resolution;
        let strongest = self.before.strongest().max(resolution);
        let rounding = if resolution > 0.0 {
            amplitude_error(resolution, strongest, self.before.noise_before_rounding())
        } else {
            0.0
        };
        // the record's own instants, where they fall on few phases
        let own = |tone: usize| {
            let of = self.before.rounding.as_ref().and_then(|rounding| rounding.tones.get(tone));
            of.map_or(0.0, |[a, _, b]| f64::midpoint(*a, *b).sqrt())
        };
        let tones = gains.iter().enumerate();
        tones.map(|(tone, gain)| rounding.max(own(tone)) * gain.sqrt()).collect()
    }

    /// The oscillations before the steps that are not fitted, as these leave them.
    fn unfitted(&self, rate: f64) -> Vec<Spurious> {
        let unfitted = self
            .before
            .spurious
            .iter()
            .filter(|oscillation| !oscillation.fitted && !self.squares());
        let after = unfitted.map(|oscillation| Spurious {
            amplitude: oscillation.amplitude
                * self.effects.power_gain(oscillation.cycles * rate).sqrt(),
            ..*oscillation
        });
        after.collect()
    }
}

/// The note on a channel whose noise was not white before its steps and is not measured after them.
pub(super) fn note(name: &str, of: &Analysed) -> Option<ChannelNote> {
    let known = of.residuals.known.as_ref()?;
    let SeenBefore { memory, coefficient, .. } = known.before;
    let note = |fact: Fact| Some(ChannelNote { channel: of.channel, fact });
    let way = match known.source {
        NoiseSource::White if memory == Memory::Open => {
            return note(fact!("short-record.white-before-steps", name));
        }
        NoiseSource::Measured | NoiseSource::White => return None,
        NoiseSource::Process => fact!("noise-of-process.before-steps"),
        NoiseSource::Even => fact!("noise-even"),
    };
    let coefficient = Argument::Number(format!("{coefficient:.2}"));
    note(match memory {
        Memory::Suspected => fact!("short-record.before-steps", name, coefficient, way),
        _ => fact!("correlated-residuals.before-steps", name, coefficient, way),
    })
}

/// The noise near the harmonics of a signal that went through steps, or of a plain one; none where it
/// is white.
pub(super) fn noise_of(
    signal: &Signal,
    harmonics: Harmonics,
    through: Option<&Through>,
) -> Option<HarmonicNoise> {
    let design = harmonics.design(signal.rate, signal.values.len()).ok()?;
    let mut passes = ChannelValues(&signal.values);
    let Ok(mut fits) = design.fit(&mut passes);
    let Ok(mut left) = super::residuals::of(&design, &mut passes, &mut fits);
    let mut residuals = left.pop()?;
    residuals.known = through.map(|through| through.noise(&design, &residuals, signal.rate));
    if residuals.known.is_none() && !residuals.correlated {
        return None;
    }
    let of_residuals = match &residuals.known {
        Some(known) => known.of_residuals,
        None => freedom_of_residuals(&design, &residuals),
    };
    Some(HarmonicNoise {
        factors: (0..design.tones.len()).map(|tone| local(&residuals, tone)).collect(),
        freedom: residuals.noise_freedom(),
        of_residuals,
    })
}

/// The degrees of freedom of the variance of correlated residuals of a plain signal.
fn freedom_of_residuals(design: &ToneDesign, residuals: &Residuals) -> f64 {
    let fitted = design.parameters() as f64;
    let coloured = residuals.coloured.as_ref();
    let freedom = match coloured.filter(|process| process.fits && process.every == 1) {
        Some(process) => {
            let none = Effects::default();
            none.coloured(&|cycles| process.density(cycles), design.samples, 1.0, &[]).freedom
                - fitted
        }
        None => freedom_of_first(design, residuals),
    };
    freedom.max(1.0)
}

/// The same by the spectrum of the first residuals.
fn freedom_of_first(design: &ToneDesign, residuals: &Residuals) -> f64 {
    let share = design.samples as f64 / residuals.first.len().max(1) as f64;
    freedom_of_variance(&residuals.first) * share
}

/// The degrees of freedom of the variance of values of any colour. The powers of the bins of a spectrum
/// scatter independently, each with a standard deviation of its own mean, of which half the square of
/// the power is an estimate. Lines do not scatter.
fn freedom_of_variance(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let half = values.len() / 2;
    let spectrum = transform::forward(values);
    let powers: Vec<f64> =
        spectrum.iter().take(half + 1).skip(1).map(|bin| bin.norm_sqr()).collect();
    let lines = lines(values);
    let in_line = |bin: usize| {
        lines.iter().any(|line| (line.cycles * count - (bin + 1) as f64).abs() < OF_LINE)
    };
    let sum: f64 = powers.iter().sum();
    let squares: f64 =
        powers.iter().enumerate().filter(|(bin, _)| !in_line(*bin)).map(|(_, p)| p * p).sum();
    if squares > 0.0 { (4.0 * sum * sum / squares).min(count) } else { count }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::simulated::normals;

    /// White noise has as many degrees of freedom as values, an autoregression with the coefficient r
    /// that number over 1 + 2 r^2/(1 - r^2), with a line beside it or without. The estimate of 20 000
    /// values has a standard deviation of sqrt(5/10000) = 2 % for white noise, and of 5 % for 0.8; four of
    /// them.
    #[test]
    fn the_freedom_of_a_variance_is_that_of_the_colour() {
        let white = normals(1, "freedom", 20_000);
        let of = freedom_of_variance(&white) / 20_000.0;
        assert!((of - 1.0).abs() < 0.09, "{of}");
        let mut last = 0.0;
        let red: Vec<f64> = white
            .iter()
            .map(|new| {
                last = 0.8 * last + new;
                last
            })
            .collect();
        let expected = 1.0 / (1.0 + 2.0 * 0.64 / 0.36);
        let of = freedom_of_variance(&red) / 20_000.0;
        assert!((of / expected - 1.0).abs() < 0.2, "{of} {expected}");
        // a line of 100 times the power of white noise does not scatter: its power counts, squared
        let line = |i: usize| 200f64.sqrt() * crate::phasor::at_turns(0.1 * i as f64).re;
        let with: Vec<f64> = white.iter().enumerate().map(|(i, x)| x + line(i)).collect();
        assert!(freedom_of_variance(&with) >= 20_000.0);
    }
}
