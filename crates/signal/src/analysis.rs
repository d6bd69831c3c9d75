//! One time base analysed: frequencies, fits and residuals of its channels.

use std::rc::Rc;

use super::Measured;
use super::analysed::{Analysed, Fundamental, local};
use super::beside::{Accompanying, Besides, is_flanked};
use super::frequency::{self, NoFrequency};
use super::passes::{InMemorySamples, SampleSource, Selected, gathered};
use super::recipe::{Frequency, Method, RecipeSettings, TimeBase};
use super::refused::{MOST_HELD, Refused};
use super::residuals::{self, Residuals};
use super::sine_fit::{NoFit, Tone, ToneCoefficients, ToneDesign};
use super::spurious;
use super::through::Through;
use super::trace;
use super::whole_periods::whole_periods;
use gumption_engine::number::elementary;

/// Steps by which a stated frequency is brought to the recording's own at most; the error falls as
/// its square, so that two or three do.
const MOST_MOVES: u32 = 8;

/// Turns over the record to which it is brought.
const SETTLED: f64 = 1e-6;

/// The channels of one time base.
#[derive(Debug)]
pub(super) struct ChannelGroup<'g> {
    pub(super) settings: &'g RecipeSettings,
    pub(super) frequencies: &'g [Frequency],
    pub(super) base: TimeBase,
    pub(super) track: usize,
    pub(super) clock: usize,
    /// The channels, and the place of each among those of the passes.
    pub(super) channels: &'g [(usize, usize)],
    /// The steps that they went through, if these have an effect.
    pub(super) through: Option<&'g Through>,
    /// Whether figures are asked for.
    pub(super) traced: bool,
}

/// The tones of a recording, and for each channel their coefficients and what they leave.
pub(super) type FittedTones = (ToneDesign, Vec<ToneCoefficients>, Vec<Residuals>);

impl ChannelGroup<'_> {
    /// Analyses the channels.
    pub(super) fn analyse<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
    ) -> Result<Vec<Analysed>, Refused<E>> {
        let columns: Vec<usize> = self.channels.iter().map(|(_, column)| *column).collect();
        if self.settings.method == Method::Fft {
            self.check_length(passes.frames())?;
            let held = gathered(passes, &columns).map_err(Refused::Unreadable)?;
            return self.over_whole_periods(held);
        }
        let mut chosen = Selected { passes, columns: &columns };
        let fundamentals = self.fundamentals(&mut chosen)?;
        self.fitted(&mut chosen, self.base, fundamentals)
    }

    /// Whether tones are fitted at their frequencies, and not taken from bins.
    pub(super) fn is_fit(&self) -> bool {
        self.settings.method != Method::Fft
    }

    fn check_length<E>(&self, samples: u64) -> Result<(), Refused<E>> {
        if samples > MOST_HELD {
            return Err(Refused::TooLong { channel: self.lead().0, samples });
        }
        Ok(())
    }

    /// The channel that frequencies are estimated in: the reference, or else the first; and its
    /// place.
    fn lead(&self) -> (usize, usize) {
        let reference = self.channels.iter().position(|(c, _)| Some(*c) == self.settings.reference);
        let place = reference.unwrap_or(0);
        (self.channels.get(place).map_or(0, |(channel, _)| *channel), place)
    }

    /// The multiples of a frequency that are fitted, in order.
    fn multiples<E>(&self, cycles: f64) -> Result<Vec<u32>, Refused<E>> {
        let rate = self.base.rate.value;
        let below = |multiple: u32| cycles * f64::from(multiple) < 0.5;
        if let Some(multiple) = self.settings.components.iter().find(|n| !below(**n)) {
            let hertz = cycles * f64::from(*multiple) * rate;
            return Err(Refused::AboveNyquist { channel: self.lead().0, hertz, rate });
        }
        let mut multiples: Vec<u32> = (1..=self.settings.harmonics).filter(|n| below(*n)).collect();
        multiples.extend(&self.settings.components);
        multiples.push(1);
        multiples.sort_unstable();
        multiples.dedup();
        Ok(multiples)
    }

    fn fundamentals<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
    ) -> Result<Vec<Fundamental>, Refused<E>> {
        let rate = self.base.rate;
        let (channel, place) = self.lead();
        let mut found = Vec::new();
        for frequency in self.frequencies {
            let guess = frequency.hertz.map(|hertz| hertz / rate.value);
            if let Some(cycles) = guess {
                self.check_periods(cycles, passes.frames())?;
            }
            found.push(match (frequency.estimate, guess) {
                (false, Some(cycles)) => self.stated(frequency, cycles),
                _ => {
                    let mut lead = Selected { passes, columns: &[place] };
                    let multiples = self.multiples(guess.unwrap_or(0.01))?;
                    let estimate = frequency::estimate(&mut lead, guess, &multiples);
                    let estimate = estimate.map_err(|error| match error {
                        NoFrequency::Unreadable(error) => Refused::Unreadable(error),
                        NoFrequency::NotFound => Refused::NotFound { channel },
                        NoFrequency::NoFit(no) => self.refusal(no, passes.frames()),
                    })?;
                    self.check_periods(estimate.cycles, passes.frames())?;
                    // the noise is known with the fit of all channels
                    Fundamental {
                        of_estimate: estimate.variance.sqrt(),
                        ..self.stated(frequency, estimate.cycles)
                    }
                }
            });
        }
        Ok(found)
    }

    fn stated(&self, frequency: &Frequency, cycles: f64) -> Fundamental {
        let rate = self.base.rate;
        let known = !frequency.estimate && frequency.hertz.is_some();
        // a rate that was found from this very frequency: cycles that the recording has
        let first = self.frequencies.first().is_some_and(|first| first.hertz == frequency.hertz);
        let beside = self.base.beside_frequency.filter(|_| known && first);
        let relative = beside.unwrap_or(rate.standard_uncertainty) / rate.value;
        let hertz = Measured {
            value: cycles * rate.value,
            standard_uncertainty: if known { frequency.standard_uncertainty } else { 0.0 },
            degrees_of_freedom: f64::INFINITY,
        };
        Fundamental {
            cycles,
            turning: cycles,
            hertz,
            of_stated: if beside.is_some() { 0.0 } else { hertz.standard_uncertainty / rate.value },
            is_stated: known,
            of_estimate: 0.0,
            of_rate: if known { cycles * relative } else { 0.0 },
            of_cut: 0.0,
        }
    }

    fn check_periods<E>(&self, cycles: f64, samples: u64) -> Result<(), Refused<E>> {
        let (periods, hertz) = (cycles * samples as f64, cycles * self.base.rate.value);
        // a sample more or less is no part of a period that anybody cut off
        if periods + cycles < 1.0 {
            return Err(Refused::LessThanOnePeriod { channel: self.lead().0, hertz, periods });
        }
        Ok(())
    }

    fn refusal<E>(&self, no: NoFit, samples: u64) -> Refused<E> {
        let channel = self.lead().0;
        match no {
            NoFit::Frequency { cycles } => {
                let rate = self.base.rate.value;
                Refused::AboveNyquist { channel, hertz: cycles * rate, rate }
            }
            NoFit::TooShort => Refused::NotApart { channel, samples },
        }
    }

    /// The tones of all frequencies; a multiple that nobody asked for gives way to one of another
    /// frequency at the same place.
    fn tones<E>(
        &self,
        fundamentals: &[Fundamental],
        samples: u64,
        cycles: impl Fn(&Fundamental) -> f64,
    ) -> Result<Vec<Tone>, Refused<E>> {
        let mut tones: Vec<Tone> = Vec::new();
        for asked in [true, false] {
            for (fundamental, of) in fundamentals.iter().enumerate() {
                let cycles = cycles(of);
                for multiple in self.multiples(cycles)? {
                    let is_asked = multiple == 1 || self.settings.components.contains(&multiple);
                    let cycles = cycles * f64::from(multiple);
                    let near = |tone: &Tone| (tone.cycles - cycles).abs() * (samples as f64) < 0.5;
                    if is_asked == asked && (asked || !tones.iter().any(near)) {
                        tones.push(Tone { cycles, fundamental, multiple, beside: false });
                    }
                }
            }
        }
        Ok(tones)
    }

    fn fitted<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        base: TimeBase,
        mut fundamentals: Vec<Fundamental>,
    ) -> Result<Vec<Analysed>, Refused<E>> {
        let lead = self.lead().1;
        let ((mut design, mut fits, mut left), besides) =
            self.with_besides(passes, &mut fundamentals)?;
        if fundamentals.iter().any(|fundamental| fundamental.of_cut > 0.0) {
            // what a fit at the bins' frequencies leaves of the sine is no noise
            design = self.design(
                &fundamentals,
                passes.frames(),
                Accompanying::default(),
                |fundamental| fundamental.cycles,
            )?;
            fits = design.fit(passes).map_err(Refused::Unreadable)?;
        }
        if let Some(through) = self.through {
            for residuals in &mut left {
                let known = through.noise(&design, residuals, base.rate.value);
                residuals.known = Some(known);
            }
        }
        for (number, estimated) in fundamentals.iter_mut().enumerate() {
            if let Some(residuals) = left.get(lead).filter(|_| estimated.of_estimate > 0.0) {
                estimated.of_estimate *= noise_near(&design, residuals, number);
                if !estimated.is_stated {
                    let rate = base.rate;
                    let of_rate = estimated.hertz.value * rate.standard_uncertainty / rate.value;
                    estimated.hertz.standard_uncertainty =
                        elementary::hypot(estimated.of_estimate * rate.value, of_rate);
                }
            }
        }
        let mut traces = vec![None; self.channels.len()];
        if self.traced {
            let channels = self.channels.iter().map(|(channel, _)| *channel).zip(&fits);
            let channels: Vec<_> = channels.collect();
            let found = trace::traces(passes, base, &design, &fundamentals, &channels);
            traces = found.map_err(Refused::Unreadable)?.into_iter().map(Some).collect();
        }
        let design = Rc::new(design);
        let is_it = |left| besides.too_near && is_flanked(&design, left);
        let flanked: Vec<bool> = left.iter().map(is_it).collect();
        let is_any = flanked.contains(&true);
        let made = self.channels.iter().zip(fits).zip(left).zip(traces).zip(flanked);
        let analysed = made.map(|((((at, fit), residuals), trace), is_flanked)| {
            let spurious = spurious::found(&residuals.first);
            // frequencies are those of all channels, what is near to one may be in one of them
            let too_near = besides.too_near && (is_flanked || !is_any);
            let besides = Besides { too_near, ..besides.clone() };
            let stated = self.settings.channels.get(at.0).map_or(0.0, |channel| channel.resolution);
            // a step that is seen counts where it is coarser than the stated one
            let seen = residuals.lattice.filter(|step| *step > 1.5 * stated);
            Analysed {
                resolution: seen.unwrap_or(stated),
                rounding: None,
                channel: at.0,
                track: self.track,
                clock: self.clock,
                base,
                design: design.clone(),
                fit,
                residuals,
                fundamentals: fundamentals.clone(),
                spurious,
                besides,
                effects: self.through.map_or_else(Rc::default, |through| through.effects.clone()),
                trace,
            }
            .rounded()
        });
        Ok(analysed.collect())
    }

    /// The design of the tones of all frequencies and of what accompanies them.
    pub(super) fn design<E>(
        &self,
        fundamentals: &[Fundamental],
        samples: u64,
        with: Accompanying<'_>,
        cycles: impl Fn(&Fundamental) -> f64,
    ) -> Result<ToneDesign, Refused<E>> {
        let mut tones = self.tones(fundamentals, samples, cycles)?;
        tones.extend(with.tones.iter().zip(fundamentals.len()..).map(|(cycles, fundamental)| {
            Tone { cycles: *cycles, fundamental, multiple: 1, beside: true }
        }));
        ToneDesign::with_drift(tones, samples, with.drift).map_err(|no| self.refusal(no, samples))
    }

    /// The fits and what they leave at the frequencies that the recording has. A stated frequency is
    /// the recording's within its uncertainty (and the rate's): where the recording tells the cycles
    /// of a sample interval better than these do, they are moved to its own. What a fit beside them
    /// leaves of the sine would pass for noise.
    /// With what accompanies them an estimated frequency is estimated once more.
    pub(super) fn at_own_frequencies<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        fundamentals: &mut [Fundamental],
        with: Accompanying<'_>,
    ) -> Result<FittedTones, Refused<E>> {
        let samples = passes.frames();
        let lead = self.lead().1;
        let as_stated = fundamentals.to_vec();
        let within = |fundamental: &Fundamental| {
            elementary::hypot(fundamental.of_stated, fundamental.of_rate)
        };
        let again_estimated = |fundamental: &Fundamental| !fundamental.is_stated && !with.is_none();
        let mut may_move: Vec<bool> = as_stated
            .iter()
            .map(|fundamental| within(fundamental) > 0.0 || again_estimated(fundamental))
            .collect();
        let mut moves = 0;
        loop {
            let design =
                self.design(fundamentals, samples, with, |fundamental| fundamental.turning)?;
            let mut fits = design.fit(passes).map_err(Refused::Unreadable)?;
            let left = residuals::of(&design, passes, &mut fits).map_err(Refused::Unreadable)?;
            let Some(residuals) = left.get(lead) else { return Ok((design, fits, left)) };
            let mut again = false;
            for (number, tuned) in fundamentals.iter_mut().enumerate() {
                if !may_move[number] {
                    continue;
                }
                let Some((step, variance)) = residuals.cycles.get(number).copied() else {
                    continue;
                };
                if again_estimated(tuned) {
                    let most = 0.25 / samples as f64;
                    let step = if variance.is_finite() { step.clamp(-most, most) } else { 0.0 };
                    tuned.move_to(tuned.turning + step, variance);
                    tuned.hertz.value = tuned.turning * self.base.rate.value;
                    may_move[number] = moves < MOST_MOVES && step.abs() * samples as f64 > SETTLED;
                    again |= may_move[number];
                    continue;
                }
                let stated = as_stated[number];
                let within = within(&stated);
                let white = (variance * residuals.variance).sqrt();
                let off = tuned.turning + step - stated.turning;
                let told = 3.0 * white < within && off.abs() < 5.0 * within;
                if told && moves < MOST_MOVES && step.abs() * samples as f64 > SETTLED {
                    tuned.move_to(tuned.turning + step, variance);
                    again = true;
                    continue;
                }
                // noise near the oscillation is known when nothing of it is left there
                let own = variance.sqrt() * noise_near(&design, residuals, number);
                if told && 3.0 * own < within {
                    tuned.move_to(tuned.turning, variance);
                } else {
                    may_move[number] = false;
                    again |= tuned.turning != stated.turning;
                    *tuned = stated;
                }
            }
            moves += 1;
            if !again {
                return Ok((design, fits, left));
            }
        }
    }

    /// The bins of the discrete Fourier transform of a whole number of periods: over such a part a
    /// least-squares fit at the bins' frequencies is that transform.
    fn over_whole_periods<E>(
        &self,
        mut held: InMemorySamples,
    ) -> Result<Vec<Analysed>, Refused<E>> {
        let (channel, place) = self.lead();
        let mut fundamentals = self.fundamentals(&mut held.unfailing())?;
        let (Some(first), Some(values)) = (fundamentals.first_mut(), held.channels.get(place))
        else {
            return Ok(Vec::new());
        };
        let Some(part) = whole_periods(values, first.cycles) else {
            let (periods, hertz) = (first.cycles * values.len() as f64, first.hertz.value);
            return Err(Refused::LessThanOnePeriod { channel, hertz, periods });
        };
        let bin = f64::from(part.periods) / part.samples as f64;
        first.of_cut = (first.cycles - bin).abs();
        first.cycles = bin;
        for values in &mut held.channels {
            *values = values.get(part.first..part.first + part.samples).unwrap_or(&[]).to_vec();
        }
        let start = self.base.start + part.first as f64 / self.base.rate.value;
        fundamentals.truncate(1);
        self.fitted(&mut held.unfailing(), TimeBase { start, ..self.base }, fundamentals)
    }
}

/// The standard deviation of white noise as strong as a channel's is near a fundamental.
fn noise_near(design: &ToneDesign, residuals: &Residuals, fundamental: usize) -> f64 {
    let tone = |t: &Tone| t.fundamental == fundamental && t.multiple == 1;
    let tone = design.tones.iter().position(tone).unwrap_or(0);
    let [of_cosine, of_sine] = local(residuals, tone);
    (residuals.variance * f64::midpoint(of_cosine, of_sine)).sqrt()
}
