//! What accompanies the oscillations that a recipe names: others, and a drift of the level, found in
//! what a fit leaves, and fitted with it.
//!
//! What leaks from an oscillation that is not fitted into one that is depends on phases that a budget
//! can only take for unknown. Fitted with the others it leaks nothing, and the uncertainty that is
//! left is that of the joint fit, its frequency's included.

use super::analysed::Fundamental;
use super::analysis::{ChannelGroup, FittedTones};
use super::drift;
use super::passes::SampleSource;
use super::refused::Refused;
use super::residuals::{KEPT, Remainder, Residuals};
use super::sine_fit::{ToneCoefficients, ToneDesign};
use super::spurious::{self, MOST};
use gumption_engine::number::elementary::hypot;
use gumption_engine::number::largest_first;

/// Records of so many samples at most are looked through: the spectrum of the first residuals tells
/// a frequency to less than a quarter of a turn over them.
const LONGEST: u64 = 16 * KEPT as u64;

/// Searches for further oscillations, each beside those that were found before.
const ROUNDS: usize = 3;

/// Steps to their frequencies at most, in each round.
const MOST_STEPS: usize = 25;

/// Turns that named and further oscillations take in being brought to their frequencies: what one
/// leaves to the other falls to a hundredth with each.
const MOST_TURNS: usize = 4;

/// Turns over the record to which a frequency is brought, and a step at most.
const SETTLED: f64 = 1e-4;
const LARGEST_STEP: f64 = 0.25;

/// Turns over the record within which two oscillations are one to this record.
pub(super) const APART: f64 = 1.0;

/// The least amplitude over its standard deviation of what counts as an oscillation: of white noise one
/// in 270 000 bins has that.
const CLEAR: f64 = 5.0;

/// Turns over the record from a fitted frequency at which the search for one beside it begins at least.
const NEAREST_START: f64 = 1.5;

/// Turns over the record on both sides of a fitted frequency within which two oscillations are one
/// that grows, fades or wanders.
const SIDEBANDS: f64 = 3.0;

/// The highest multiple of a frequency that distortion is taken to make. The multiples of a low
/// frequency, folded at half the sampling rate, are nearly everywhere: 50 Hz is next to the 97th of
/// 20.1 Hz at 2000 samples a second.
const DISTORTION: u32 = 20;

/// By how much a drift may multiply the variance of what is asked for.
const MOST_COST: f64 = 2.0;

/// The highest that rounding is, each by less than a step.
const ROUNDING: u32 = 199;

/// An oscillation that no one named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UnnamedOscillation {
    /// Cycles in a sample interval.
    pub(super) cycles: f64,
    /// Their standard deviation.
    pub(super) deviation: f64,
    /// Its amplitude over that one's standard deviation in white noise, in the channel where it is
    /// clearest.
    clear: f64,
}

/// What is fitted together with the named oscillations.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Accompanying<'a> {
    /// Cycles in a sample interval of other oscillations.
    pub(super) tones: &'a [f64],
    /// The degree of a polynomial.
    pub(super) drift: usize,
}

impl Accompanying<'_> {
    /// Whether there is nothing.
    pub(super) fn is_none(&self) -> bool {
        self.tones.is_empty() && self.drift == 0
    }
}

/// What was found beside the named oscillations.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Besides {
    /// Those that are fitted.
    pub(super) fitted: Vec<UnnamedOscillation>,
    /// Whether there is one that is too near to a named one to be told from it.
    pub(super) too_near: bool,
}

impl ChannelGroup<'_> {
    /// The fits at the frequencies that the recording has, with what oscillates beside them.
    pub(super) fn with_besides<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        fundamentals: &mut Vec<Fundamental>,
    ) -> Result<(FittedTones, Besides), Refused<E>> {
        let as_stated = fundamentals.clone();
        let mut best = self.at_own_frequencies(passes, fundamentals, Accompanying::default())?;
        let mut besides = Besides::default();
        let samples = passes.frames();
        if !self.is_fit() || samples > LONGEST {
            return Ok((best, besides));
        }
        let mut drift = 0;
        if let Some((of, fits)) = self.with_drift(passes, &as_stated, &best, &[])? {
            (drift, *fundamentals, best) = (fits.0.drift, of, fits);
        }
        for _ in 0..ROUNDS {
            let known: Vec<f64> =
                besides.fitted.iter().map(|oscillation| oscillation.cycles).collect();
            let new = candidates(&best, samples, &known);
            if new.is_empty() {
                break;
            }
            let all: Vec<f64> = known.into_iter().chain(new).collect();
            let Some(mut tuned) = self.tuned(passes, fundamentals, all, drift)? else {
                besides.too_near = true;
                break;
            };
            tuned.retain(|oscillation| oscillation.clear > CLEAR);
            let before = tuned.len();
            let named: Vec<f64> = self.named(&best.0).map(|(_, tone)| tone.cycles).collect();
            keep_apart(&mut tuned, &named, samples);
            besides.too_near |= tuned.len() < before;
            let is_more = tuned.len() > besides.fitted.len();
            if tuned.len() == besides.fitted.len() {
                break;
            }
            let mut moved = fundamentals.clone();
            let Some(fits) = self.settled_together(passes, &mut moved, &mut tuned, drift)? else {
                besides.too_near = true;
                break;
            };
            *fundamentals = moved;
            (best, besides.fitted) = (fits, tuned);
            if !is_more {
                break;
            }
        }
        // a slow oscillation looks like a drift as long as it is not fitted, and hides one
        let tones: Vec<f64> = besides.fitted.iter().map(|oscillation| oscillation.cycles).collect();
        if !tones.is_empty()
            && let Some((of, fits)) = self.with_drift(passes, &as_stated, &best, &tones)?
        {
            (*fundamentals, best) = (of, fits);
        }
        Ok((best, besides))
    }

    /// The fits with a drift of the level where there is one, and the frequencies that they have; none
    /// where the level drifts no more than noise does, or the record is too short to tell a drift from
    /// the oscillations.
    fn with_drift<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        as_stated: &[Fundamental],
        before: &FittedTones,
        tones: &[f64],
    ) -> Result<Option<(Vec<Fundamental>, FittedTones)>, Refused<E>> {
        let (design, _, left) = before;
        if design.drift == 0 && !left.iter().any(|residuals| residuals.drifts) {
            return Ok(None);
        }
        let of = |drift: usize| {
            let with = Accompanying { tones, drift };
            self.design::<E>(as_stated, passes.frames(), with, |fundamental| fundamental.turning)
                .ok()
        };
        let plain = of(0);
        let costs = |design: &ToneDesign| {
            plain.as_ref().is_none_or(|plain| self.is_much_less_known(design, plain))
        };
        let is_told = |degree: &usize| of(*degree).is_some_and(|design| !costs(&design));
        let mut degree = (1..=drift::MOST_DEGREES).take_while(is_told).count();
        while degree > 0 {
            let mut moved = as_stated.to_vec();
            let with = Accompanying { tones, drift: degree };
            let Ok(fits) = self.at_own_frequencies(passes, &mut moved, with) else { break };
            let each = fits.1.iter().zip(&fits.2);
            let each = each.map(|(fit, left)| clear_degree(&fits.0, fit, left));
            let clear = each.max().unwrap_or(0);
            if clear == degree {
                return Ok(Some((moved, fits)));
            }
            degree = clear;
        }
        if design.drift == 0 {
            return Ok(None);
        }
        let mut moved = as_stated.to_vec();
        let fits = self.at_own_frequencies(passes, &mut moved, Accompanying { tones, drift: 0 })?;
        Ok(Some((moved, fits)))
    }

    /// Whether a drift makes the factors of a named oscillation much less known than they are in
    /// another design of the same tones.
    fn is_much_less_known(&self, with: &ToneDesign, other: &ToneDesign) -> bool {
        self.named(with).any(|(place, _)| {
            let even = |design: &ToneDesign| design.even[(place + 1, place + 1)];
            let odd = |design: &ToneDesign| design.odd[(place, place)];
            even(with) > MOST_COST * even(other) || odd(with) > MOST_COST * odd(other)
        })
    }

    /// The fits at the frequencies that the recording has, those of what oscillates beside the named
    /// ones among them; none where they cannot be told apart. As each was brought to its frequency
    /// while the other still leaked into it, they take turns until neither moves.
    fn settled_together<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        fundamentals: &mut [Fundamental],
        tuned: &mut Vec<UnnamedOscillation>,
        drift: usize,
    ) -> Result<Option<FittedTones>, Refused<E>> {
        let samples = passes.frames() as f64;
        let mut turns = 0;
        loop {
            let before: Vec<f64> =
                fundamentals.iter().map(|fundamental| fundamental.turning).collect();
            let cycles: Vec<f64> = tuned.iter().map(|oscillation| oscillation.cycles).collect();
            let with = Accompanying { tones: &cycles, drift };
            let Ok(fits) = self.at_own_frequencies(passes, fundamentals, with) else {
                return Ok(None);
            };
            let moves =
                |tuned: (&Fundamental, f64)| (tuned.0.turning - tuned.1).abs() * samples > SETTLED;
            turns += 1;
            if turns == MOST_TURNS || !fundamentals.iter().zip(before).any(moves) {
                return Ok(Some(fits));
            }
            let Some(again) = self.tuned(passes, fundamentals, cycles, drift)? else {
                return Ok(None);
            };
            *tuned = again;
        }
    }

    /// The tones of a design that the recipe names, with their places.
    pub(super) fn named<'d>(
        &self,
        design: &'d ToneDesign,
    ) -> impl Iterator<Item = (usize, &'d super::sine_fit::Tone)> {
        let count = self.frequencies.len();
        design.tones.iter().enumerate().filter(move |(_, tone)| tone.fundamental < count)
    }

    /// Brings the cycles of oscillations to those at which the fits leave least; none where they
    /// cannot be told apart.
    fn tuned<E>(
        &self,
        passes: &mut dyn SampleSource<Error = E>,
        fundamentals: &[Fundamental],
        cycles: Vec<f64>,
        drift: usize,
    ) -> Result<Option<Vec<UnnamedOscillation>>, Refused<E>> {
        let samples = passes.frames();
        let mut all: Vec<UnnamedOscillation> = cycles
            .into_iter()
            .map(|cycles| UnnamedOscillation { cycles, deviation: 0.0, clear: 0.0 })
            .collect();
        for _ in 0..MOST_STEPS {
            let cycles: Vec<f64> = all.iter().map(|oscillation| oscillation.cycles).collect();
            let with = Accompanying { tones: &cycles, drift };
            let design = match self
                .design::<E>(fundamentals, samples, with, |fundamental| fundamental.turning)
            {
                Ok(design) => design,
                Err(_) => return Ok(None),
            };
            let mut fits = design.fit(passes).map_err(Refused::Unreadable)?;
            let left = super::residuals::remainders(&design, passes, &mut fits)
                .map_err(Refused::Unreadable)?;
            let mut largest = 0.0_f64;
            for (number, oscillation) in all.iter_mut().enumerate() {
                let (step, deviation) = step(&left, fundamentals.len() + number);
                oscillation.deviation = deviation;
                let place = design.tones.iter().position(|tone| {
                    tone.beside && tone.fundamental == fundamentals.len() + number
                });
                oscillation.clear =
                    place.map_or(0.0, |tone| clearness(&design, &fits, &left, tone));
                let most = LARGEST_STEP / samples as f64;
                let step = if step.is_finite() { step.clamp(-most, most) } else { 0.0 };
                oscillation.cycles += step;
                largest = largest.max(step.abs() * samples as f64);
            }
            if all.iter().any(|oscillation| !(oscillation.cycles > 0.0 && oscillation.cycles < 0.5))
            {
                return Ok(None);
            }
            if largest < SETTLED {
                break;
            }
        }
        Ok(Some(all))
    }
}

/// The highest degree of a drift that stands out of the noise of a channel.
pub(super) fn clear_degree(design: &ToneDesign, fit: &ToneCoefficients, left: &Residuals) -> usize {
    // what is left has no more than higher degrees would tell of noise that grows towards zero frequency:
    // a walk's power is that of the next degree times the square of their ratio
    let growth = |degree: usize| ((drift::MOST_DEGREES + 1) as f64 / degree as f64).powi(2);
    let noise = |degree: usize| {
        let modelled =
            left.coloured.as_ref().and_then(|coloured| coloured.drift.get(degree - 1).copied());
        let modelled = modelled.map(|variance| variance * growth(degree));
        modelled.unwrap_or_else(|| left.variance * design.variance_of_degree(degree))
    };
    let is_clear =
        |degree: &usize| fit.drift[degree - 1].abs() > drift::CLEAR * noise(*degree).sqrt();
    (1..=fit.drift.len()).rev().find(is_clear).unwrap_or(0)
}

/// The amplitude of a tone over its standard deviation in white noise, in the channel where it is
/// clearest.
fn clearness(
    design: &ToneDesign,
    fits: &[ToneCoefficients],
    left: &[Remainder],
    tone: usize,
) -> f64 {
    let variance = f64::midpoint(design.even[(tone + 1, tone + 1)], design.odd[(tone, tone)]);
    let of = |(fit, left): (&ToneCoefficients, &Remainder)| {
        amplitude(fit, tone) / (variance * left.variance).sqrt()
    };
    fits.iter().zip(left).map(of).fold(0.0, f64::max)
}

/// By how much the cycles of an oscillation should be larger, of all channels together, and the
/// standard deviation of that.
fn step(left: &[Remainder], number: usize) -> (f64, f64) {
    let (mut weights, mut sum) = (0.0, 0.0);
    for residuals in left {
        let Some((step, variance)) = residuals.cycles.get(number) else { continue };
        let weight = 1.0 / (variance * residuals.variance);
        if weight.is_finite() {
            weights += weight;
            sum += weight * step;
        }
    }
    if weights > 0.0 { (sum / weights, weights.sqrt().recip()) } else { (0.0, f64::INFINITY) }
}

/// Oscillations that stand out of what fits leave in any of the channels, the clearest first. Of what
/// lies within some turns of a fitted frequency only the clearest: a fit beside an oscillation leaves
/// a hump on either side.
fn candidates(of: &FittedTones, samples: u64, known: &[f64]) -> Vec<f64> {
    let (design, _, left) = of;
    let mut found: Vec<(f64, f64, u32)> = Vec::new();
    for residuals in left {
        let deviation = residuals.variance.sqrt();
        for oscillation in spurious::lines(&residuals.first) {
            let may_be_rounding =
                residuals.lattice.is_some_and(|step| oscillation.amplitude < step);
            let most = if may_be_rounding { ROUNDING } else { DISTORTION };
            found.push((oscillation.amplitude / deviation, oscillation.cycles, most));
        }
    }
    largest_first(&mut found, |a| a.0);
    let samples = samples as f64;
    let mut new: Vec<f64> = Vec::new();
    let mut flanked = vec![false; design.tones.len()];
    for (_, cycles, most) in found {
        let apart = |other: f64| (cycles - other).abs() * samples;
        if new.iter().chain(known).any(|other| apart(*other) < 2.0) {
            continue;
        }
        let near = design.tones.iter().position(|tone| apart(tone.cycles) < SIDEBANDS);
        let start = match near {
            Some(tone) => {
                if std::mem::replace(&mut flanked[tone], true) {
                    continue;
                }
                let from = design.tones[tone].cycles;
                let away = f64::max(apart(from), NEAREST_START) / samples;
                from + if cycles < from { -away } else { away }
            }
            None if is_multiple(design, cycles, most) => continue,
            None => cycles,
        };
        if new.len() + known.len() < MOST {
            new.push(start);
        }
    }
    new
}

/// Whether an oscillation is a multiple, up to `most`, of one that is fitted: distortion, which is said of
/// the signal and not beside it.
fn is_multiple(design: &ToneDesign, cycles: f64, most: u32) -> bool {
    let samples = design.samples as f64;
    let apart = |other: f64| (cycles - other).abs() * samples;
    let folded = |cycles: f64| {
        let turn = cycles.fract();
        if turn > 0.5 { 1.0 - turn } else { turn }
    };
    design.tones.iter().filter(|tone| tone.multiple == 1).any(|tone| {
        (2..=most).any(|multiple| apart(folded(f64::from(multiple) * tone.cycles)) < 1.5)
    })
}

/// Whether something oscillates within some turns over the record of a frequency that is named.
pub(super) fn is_flanked(design: &ToneDesign, left: &Residuals) -> bool {
    let samples = design.samples as f64;
    let named = || design.tones.iter().filter(|tone| !tone.beside);
    spurious::lines(&left.first)
        .iter()
        .any(|line| named().any(|tone| (line.cycles - tone.cycles).abs() * samples < SIDEBANDS))
}

/// Takes out what is too near to a named oscillation, and what lies on both sides of one.
fn keep_apart(all: &mut Vec<UnnamedOscillation>, named: &[f64], samples: u64) {
    let samples = samples as f64;
    let from = |oscillation: &UnnamedOscillation, tone: f64| (oscillation.cycles - tone) * samples;
    let both_sides = |tone: f64, all: &[UnnamedOscillation]| {
        let near = |sign: f64| {
            all.iter()
                .any(|oscillation| (0.0..SIDEBANDS).contains(&(sign * from(oscillation, tone))))
        };
        near(1.0) && near(-1.0)
    };
    let modulated: Vec<f64> = named.iter().copied().filter(|tone| both_sides(*tone, all)).collect();
    all.retain(|oscillation| {
        let alone = named.iter().all(|tone| from(oscillation, *tone).abs() >= APART);
        let beside = modulated.iter().all(|tone| from(oscillation, *tone).abs() >= SIDEBANDS);
        alone && beside && oscillation.deviation * samples < APART / 4.0
    });
    let mut kept: Vec<UnnamedOscillation> = Vec::new();
    for oscillation in all.drain(..) {
        if kept.iter().all(|other| (oscillation.cycles - other.cycles).abs() * samples >= APART) {
            kept.push(oscillation);
        }
    }
    *all = kept;
}

/// The peak amplitude of a tone of a fit.
pub(super) fn amplitude(fit: &ToneCoefficients, tone: usize) -> f64 {
    hypot(
        fit.cosines.get(tone).copied().unwrap_or(0.0),
        fit.sines.get(tone).copied().unwrap_or(0.0),
    )
}
