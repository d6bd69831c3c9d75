//! From fits to the values of an answer, each with the contributions to its uncertainty.

use std::f64::consts::{LN_10, PI};

use super::Measured;
use super::analysed::{Analysed, shares};
use super::budget::{BudgetedValue, UncertaintySource};
use super::common_noise::correlation;
use super::observation::{ChannelObservation, ToneComponent};
use super::phasor::wrapped;
use super::polar::{Polar, polar};
use super::recipe::RecipeSettings;
use super::residuals::variance_of_power;
use super::surroundings::Finding;
use super::trials::{Scatter, scatter};
use super::unexplained::level_wanders;
use gumption_engine::number::elementary::{hypot, log10, sin_cos_turn};

/// The least gain of a filter at a multiple that counts as distortion.
const LEAST_GAIN: f64 = 1e-3;

/// What was found in a channel at one of the frequencies; `reference` is the analysis of the
/// reference channel where there is one.
pub(super) fn observed(
    settings: &RecipeSettings,
    analysed: &Analysed,
    reference: Option<&Analysed>,
    fundamental: usize,
    findings: Vec<Finding>,
) -> Option<ChannelObservation> {
    let channel = settings.channels.get(analysed.channel)?;
    let of = *analysed.fundamentals.get(fundamental)?;
    let tone = |multiple: u32| polar(analysed, channel, fundamental, multiple);
    let mut multiples: Vec<u32> = analysed
        .design
        .tones
        .iter()
        .filter(|tone| tone.fundamental == fundamental)
        .map(|tone| tone.multiple)
        .collect();
    multiples.sort_unstable();
    let tones: Vec<Polar> = multiples.iter().filter_map(|multiple| tone(*multiple)).collect();
    let first = tones.first()?;
    let drawn = (settings.trials > 0)
        .then(|| scatter(analysed, &channel.name, &tones, settings.seed, settings.trials));
    let residuals = &analysed.residuals;
    let noise_dof = residuals.noise_freedom();
    let root = reference.and_then(|reference| {
        let channel = settings.channels.get(reference.channel)?;
        Some((reference, polar(reference, channel, fundamental, 1)?))
    });
    let components = settings.components.iter().filter_map(|multiple| {
        let place = multiples.iter().position(|own| own == multiple)?;
        let polar = tones.get(place)?;
        let trials = drawn.as_ref().map(|drawn| (drawn.amplitudes[place], drawn.phases[place]));
        Some(component(settings, analysed, root.as_ref(), polar, *multiple, trials, noise_dof))
    });
    let periods = of.cycles * analysed.design.samples as f64;
    let relative =
        hypot(hypot(hypot(of.of_stated, of.of_estimate), of.of_rate), of.of_cut) / of.cycles;
    Some(ChannelObservation {
        channel: analysed.channel,
        frequency: of.hertz,
        components: components.collect(),
        offset: offset(settings, analysed, noise_dof),
        distortion: distortion(settings, analysed, &tones, drawn.as_ref(), noise_dof),
        signal_to_noise: ratio(analysed, &tones, false),
        sinad: ratio(analysed, &tones, true),
        periods: Measured {
            value: periods,
            standard_uncertainty: periods * relative,
            degrees_of_freedom: f64::INFINITY,
        },
        samples: analysed.design.samples,
        rate: analysed.base.rate,
        noise: residuals.variance.sqrt(),
        autocorrelation: (
            residuals.autocorrelation.first().copied().unwrap_or(0.0),
            residuals.correlated,
        ),
        spurious: analysed
            .fitted_besides()
            .chain(analysed.spurious.iter().copied())
            .filter(|s| s.amplitude > 1e-4 * first.amplitude)
            .collect(),
        findings,
    })
}

fn component(
    settings: &RecipeSettings,
    analysed: &Analysed,
    root: Option<&(&Analysed, Polar)>,
    polar: &Polar,
    multiple: u32,
    trials: Option<(f64, f64)>,
    noise_dof: f64,
) -> ToneComponent {
    let of = polar.of;
    let times = f64::from(multiple);
    let frequency = Measured {
        value: of.hertz.value * times,
        standard_uncertainty: of.hertz.standard_uncertainty * times,
        ..of.hertz
    };
    let mut amplitude: Vec<(UncertaintySource, f64)> = Vec::new();
    for (source, along, _) in &polar.own {
        join(&mut amplitude, *source, *along);
    }
    for (source, along, _) in &polar.steps {
        join(&mut amplitude, *source, *along);
    }
    for (source, u) in &polar.shared {
        join(&mut amplitude, *source, *u);
    }
    let mut amplitude = BudgetedValue::new(polar.amplitude, amplitude, noise_dof);
    if let Some((drawn, _)) = trials {
        // trials know noise and the frequency; the scale and the steps are added as they are
        let others = |(source, _): &&(UncertaintySource, f64)| {
            matches!(
                source,
                UncertaintySource::Scale
                    | UncertaintySource::Filter
                    | UncertaintySource::Derivative
                    | UncertaintySource::Radius
                    | UncertaintySource::Correction
            )
        };
        let rest: f64 = amplitude.contributions.iter().filter(others).map(|(_, u)| u * u).sum();
        amplitude = amplitude.checked((drawn * drawn + rest).sqrt(), settings.trials);
    }
    let is_root = root.is_some_and(|(reference, _)| reference.channel == analysed.channel);
    let own = if is_root && multiple == 1 {
        BudgetedValue::new(0.0, Vec::new(), noise_dof)
    } else {
        phase(
            analysed,
            root,
            polar,
            times,
            trials.map(|(_, drawn)| (drawn, settings.trials)),
            noise_dof,
        )
    };
    let delay = root.filter(|_| multiple == 1).map(|_| delay(&own, frequency));
    ToneComponent {
        multiple,
        frequency,
        amplitude: amplitude.times(settings.amplitude.factor()),
        phase: own.times(settings.phase.in_radian()),
        delay,
    }
}

/// Adds a contribution to those of its source.
fn join(contributions: &mut Vec<(UncertaintySource, f64)>, source: UncertaintySource, u: f64) {
    match contributions.iter_mut().find(|(known, _)| *known == source) {
        Some((_, known)) => *known = hypot(*known, u),
        None => contributions.push((source, u)),
    }
}

/// The phase in radians, less that of the reference times the multiple.
fn phase(
    analysed: &Analysed,
    root: Option<&(&Analysed, Polar)>,
    polar: &Polar,
    times: f64,
    trials: Option<(f64, u64)>,
    noise_dof: f64,
) -> BudgetedValue {
    let mut parts: Vec<(UncertaintySource, f64)> = Vec::new();
    for (source, _, across) in &polar.own {
        join(&mut parts, *source, *across);
    }
    let own: f64 = parts.iter().map(|(_, u)| u * u).sum();
    for (source, _, across) in &polar.steps {
        join(&mut parts, *source, *across);
    }
    let of = polar.of;
    let mut value = polar.phase;
    // what one unit of each error does: cycles from the estimate, hertz as stated, relative rate
    let (mut estimated, mut stated, mut clock) =
        ((polar.slope * of.of_estimate, 0.0), polar.slope * of.of_stated, (polar.of_rate, 0.0));
    let mut instants = (polar.of_instants, 0.0);
    // the part of this channel's own noise that is no noise of the difference
    let mut common = 0.0;
    if let Some((reference, root)) = root {
        value -= times * root.phase;
        for (source, _, across) in &root.own {
            join(&mut parts, *source, times * across);
        }
        let of = |polar: &Polar| {
            let noise = polar.own.iter().find(|(source, ..)| *source == UncertaintySource::Noise);
            noise.map_or(0.0, |(_, _, across)| *across)
        };
        let cycles = analysed.design.tones.get(polar.tone).map_or(0.0, |tone| tone.cycles);
        let (own, other) = (of(polar), of(root));
        let both = own * own + other * other;
        let correlation =
            (times == 1.0).then(|| correlation(analysed, reference, cycles)).flatten();
        if let Some(correlation) = correlation.filter(|_| both > 0.0) {
            let shared = 2.0 * correlation * own * other;
            common = shared * own * own / both;
            for (_, u) in parts.iter_mut().filter(|(source, _)| *source == UncertaintySource::Noise)
            {
                *u = (*u * *u - shared).max(0.0).sqrt();
            }
        }
        for (source, _, across) in &root.steps {
            join(&mut parts, *source, times * across);
        }
        // a tone of the same channel as the reference's shares none of its noise
        let slope = times * root.slope;
        let together = reference.track == analysed.track;
        let (e, of) = (slope * root.of.of_estimate, root.of);
        if together {
            estimated.0 -= e
        } else {
            estimated.1 = e
        }
        // a stated frequency is one and the same for all recordings
        stated -= slope * of.of_stated;
        let c = times * root.of_rate;
        if reference.clock == analysed.clock {
            clock.0 -= c
        } else {
            clock.1 = c
        }
        let i = times * root.of_instants;
        if together { instants.0 -= i } else { instants.1 = i }
    }
    join(&mut parts, UncertaintySource::Frequency, hypot(hypot(estimated.0, estimated.1), stated));
    join(&mut parts, UncertaintySource::SamplingRate, hypot(clock.0, clock.1));
    if analysed.base.of_middle.is_some() {
        join(&mut parts, UncertaintySource::Jitter, hypot(instants.0, instants.1));
    }
    let total = BudgetedValue::new(wrapped(value), parts, noise_dof);
    match trials {
        Some((drawn, count)) => {
            // the trials draw this channel's own noise, of which the part counts that the reference
            // does not have as well; everything else is as it is
            let u = total.measured.standard_uncertainty;
            let more = if own > 0.0 { drawn * drawn / own - 1.0 } else { 0.0 };
            total.checked((u * u + (own - common) * more).max(0.0).sqrt(), count)
        }
        None => total,
    }
}

fn delay(phase: &BudgetedValue, frequency: Measured) -> BudgetedValue {
    let speed = 2.0 * PI * frequency.value;
    let mut delay = phase.clone().times(1.0 / speed);
    delay.measured.value = 0.0 - delay.measured.value;
    delay
}

fn offset(settings: &RecipeSettings, analysed: &Analysed, noise_dof: f64) -> BudgetedValue {
    let residuals = &analysed.residuals;
    let scale = settings.channels.get(analysed.channel).map_or(0.0, |c| c.scale_uncertainty);
    // at zero frequency noise is as strong as a model of it says, or as steps make it of the noise
    // before them
    let white = residuals.variance * analysed.design.even[(0, 0)];
    let (noise, noise_dof) = match (&residuals.known, &residuals.coloured) {
        (Some(known), _) => (known.level, known.of_level.unwrap_or(noise_dof)),
        // beside a tone that is not fitted nothing wanders
        (None, Some(coloured)) if coloured.walks && !level_wanders(analysed) => {
            (coloured.still, noise_dof)
        }
        (None, Some(coloured)) => (coloured.level, coloured.freedom),
        // no model: as far as sixteen lags tell
        (None, None) if residuals.correlated => {
            let slow = 1.0 + 2.0 * residuals.autocorrelation.iter().sum::<f64>();
            (white * slow.max(0.1), noise_dof)
        }
        (None, None) => (white, residuals.degrees_of_freedom),
    };
    let value = analysed.fit.offset;
    let scale = scale * analysed.effects.power_of_scale();
    let [quantization, _] = shares(analysed);
    let (repeated, rounded) = analysed
        .rounding
        .as_ref()
        .map_or((0.0, 0.0), |rounding| (rounding.repeated, rounding.offset));
    let quantized = noise * quantization * (1.0 - repeated) + rounded;
    let mut parts = vec![
        (UncertaintySource::Noise, (noise * (1.0 - quantization)).sqrt()),
        (UncertaintySource::Quantization, quantized.sqrt()),
        (UncertaintySource::Scale, value.abs() * scale),
    ];
    // a fit at another frequency than the oscillation's takes some of it for a constant
    for (number, tone) in analysed.fundamentals.iter().enumerate() {
        let slope = analysed.design.slope(&analysed.fit, number).offset.abs();
        let tuned = hypot(tone.of_stated, tone.of_estimate);
        join(&mut parts, UncertaintySource::Frequency, slope * tuned);
        join(&mut parts, UncertaintySource::SamplingRate, slope * tone.of_rate);
        join(&mut parts, UncertaintySource::Leakage, slope * tone.of_cut);
    }
    // a level that drifts is at none of its values for long
    if analysed.design.drift > 0 {
        join(&mut parts, UncertaintySource::Drift, analysed.drift_power().sqrt());
    }
    // of an oscillation that is not fitted the mean over the record has a part, whatever its phase
    let samples = analysed.design.samples as f64;
    let unfitted = residuals.known.as_ref().map_or(&analysed.spurious, |known| &known.unfitted);
    for oscillation in unfitted
        .iter()
        .filter(|oscillation| !oscillation.fitted && oscillation.cycles * samples > 3.0)
    {
        let mean =
            oscillation.amplitude / (2.0 * samples * sin_cos_turn(oscillation.cycles / 2.0).0);
        join(&mut parts, UncertaintySource::Leakage, mean);
    }
    BudgetedValue::new(value, parts, noise_dof)
}

/// Total harmonic distortion, with the power that noise alone gives taken off.
fn distortion(
    settings: &RecipeSettings,
    analysed: &Analysed,
    tones: &[Polar],
    drawn: Option<&Scatter>,
    noise_dof: f64,
) -> Option<BudgetedValue> {
    let first = tones.first()?;
    let above: Vec<&Polar> = tones
        .iter()
        .filter(|polar| {
            let multiple = analysed.design.tones[polar.tone].multiple;
            multiple > 1 && multiple <= settings.harmonics && polar.gain >= LEAST_GAIN
        })
        .collect();
    // of a square the first multiple is nothing to compare with
    if above.is_empty() || analysed.effects.power_of_scale() > 1.0 {
        return None;
    }
    let noise = |polar: &Polar| polar.scatter.map(|s| s * s);
    let power: f64 = above
        .iter()
        .map(|polar| polar.amplitude * polar.amplitude - noise(polar).iter().sum::<f64>())
        .sum();
    let power = power.max(0.0);
    // the variance of a squared amplitude is 4 A^2 u^2 + 4 u^4
    let variance: f64 = above
        .iter()
        .map(|polar| {
            let u = noise(polar).iter().sum::<f64>() / 2.0;
            4.0 * u * (polar.amplitude * polar.amplitude - 2.0 * u).max(0.0) + 4.0 * u * u
        })
        .sum();
    let total = first.amplitude * first.amplitude;
    let (square, spread) = (power / total, variance.sqrt() / total);
    let value = square.sqrt();
    let u = (square + spread).sqrt() - value;
    // far from zero the root is straight; near it its upper end counts
    let u = if value > 0.0 { u.min(spread / (2.0 * value)) } else { u };
    let found = BudgetedValue::new(value, vec![(UncertaintySource::Noise, u)], noise_dof);
    Some(match drawn {
        Some(drawn) if value > 0.0 => found.checked(drawn.distortion, settings.trials),
        _ => found,
    })
}

/// The power of the fundamental over that of the residuals, and of its multiples if they count, in
/// decibels.
fn ratio(analysed: &Analysed, tones: &[Polar], with_multiples: bool) -> BudgetedValue {
    let residuals = &analysed.residuals;
    let amplitude = tones.first().map_or(0.0, |polar| polar.amplitude);
    let scatter = |polar: &Polar| polar.scatter.map(|s| s * s).iter().sum::<f64>() / 2.0;
    let power =
        |polar: &&Polar| (polar.amplitude * polar.amplitude / 2.0 - scatter(polar)).max(0.0);
    let above = tones.iter().skip(if with_multiples { 1 } else { tones.len() });
    let others: f64 = above.clone().map(|polar| power(&polar)).sum();
    // what oscillates beside the signal is no part of it, whether it is fitted or not
    let besides: f64 = analysed
        .fitted_besides()
        .map(|oscillation| oscillation.amplitude * oscillation.amplitude / 2.0)
        .sum();
    let noise = residuals.variance + besides + analysed.drift_power();
    let disturbance = noise + others;
    if disturbance <= 0.0 || amplitude <= 0.0 {
        return BudgetedValue::new(f64::INFINITY, Vec::new(), f64::INFINITY);
    }
    let value = 10.0 * log10(amplitude * amplitude / 2.0 / disturbance);
    let decibel = 10.0 / LN_10;
    let correlation: f64 = residuals.autocorrelation.iter().map(|r| r * r).sum();
    let spread = if residuals.correlated { 1.0 + 2.0 * correlation } else { 1.0 };
    let freedom = match &residuals.known {
        Some(known) => known.of_residuals,
        None => residuals.degrees_of_freedom / spread,
    };
    let of_noise = variance_of_power(residuals.kurtosis, freedom).sqrt() * noise / disturbance;
    // the variance of an amplitude, but for the scale, which all have in common
    let along = |polar: &Polar| {
        let own = polar.own.iter().map(|(_, u, _)| u * u).sum::<f64>();
        let shared = polar.shared.iter().filter(|(source, _)| *source != UncertaintySource::Scale);
        own + shared.map(|(_, u)| u * u).sum::<f64>()
    };
    let of_multiples: f64 =
        above.map(|polar| 2.0 * power(&polar) * along(polar)).sum::<f64>().sqrt() / disturbance;
    let first = tones.first().map_or(0.0, |polar| 2.0 * along(polar).sqrt() / amplitude);
    let u = decibel * hypot(hypot(of_noise, of_multiples), first);
    BudgetedValue::new(value, vec![(UncertaintySource::Noise, u)], residuals.degrees_of_freedom)
}
