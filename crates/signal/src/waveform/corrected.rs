//! The correction of a record, with budgets.

use super::errors::LineErrors;
use super::low_pass::{Cutoff, LowPass};
use super::quantity::{QuantityFound, WaveformQuantity, ascending};
use super::quiet::{self, QuietPart};
use super::response::{self, LineResponse};
use super::spectrum::Lines;
use super::trials::{self, WaveformTrials};
use super::truncation::{Missing, SpectrumBound, Truncation};
use crate::phasor::at_turns;
use crate::{Measured, Phasor, Signal};
use gumption_engine::number::elementary;

/// Cut-offs that are tried for the proposed one, evenly spaced on a logarithmic scale.
const TRIED: usize = 64;

/// The fewest samples of a record.
const FEWEST: usize = 16;

/// How a record is corrected.
#[derive(Clone, Debug)]
pub struct WaveformStep {
    /// What the signal came through.
    pub response: LineResponse,
    /// The factor from the record's values over the response to the unit of the answer.
    pub factor: f64,
    /// The low-pass; none: nothing is taken away.
    pub low_pass: Option<LowPass>,
    /// What is known of the part that it takes away.
    pub truncation: Truncation,
    /// The noise of the record.
    pub noise: QuietPart,
    /// The instants, in seconds, between which nothing happens: the mean of the record there is taken off.
    pub baseline: Option<[f64; 2]>,
    /// The delay of the channel beside that of the response, in seconds; it is taken off.
    pub delay: Measured,
    /// The relative standard uncertainty of the scale.
    pub of_scale: f64,
    /// The standard uncertainty of each value by what the record has beside the signal, whose course is unknown; in the
    /// unit of the answer.
    pub additional: f64,
    /// The relative standard uncertainty of the sampling rate.
    pub of_rate: f64,
    /// The figures that are asked for, with their names.
    pub quantities: Vec<(String, WaveformQuantity)>,
}

/// Where a standard uncertainty of a waveform is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WaveformSource {
    /// Noise of the record.
    Noise,
    /// The calibration of the response.
    Response,
    /// What a model of the response leaves of its points.
    Misfit,
    /// The delay of the channel.
    Delay,
    /// The scale of the channel.
    Scale,
    /// What the low-pass takes away.
    Truncation,
    /// What the record has beside the signal.
    Additional,
    /// The sampling rate.
    SamplingRate,
    /// The other channel of a ratio.
    OtherChannel,
}

/// A corrected record.
#[derive(Clone, Debug)]
pub struct Waveform {
    /// The corrected values.
    pub signal: Signal,
    /// Their standard uncertainties.
    pub standard_uncertainties: Vec<f64>,
    /// The root mean square over the record of what each source contributes.
    pub sources: Vec<(WaveformSource, f64)>,
    /// The cut-off of the low-pass, in hertz.
    pub cutoff: Option<f64>,
    /// The figures that were asked for.
    pub quantities: Vec<QuantityFound>,
    /// What trials say of the values; none without trials.
    pub trials: Option<WaveformTrials>,
    /// The last value less the first, over the standard uncertainty of the noise of that difference.
    pub step_at_ends: f64,
}

impl WaveformSource {
    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Noise => "noise",
            Self::Response => "response",
            Self::Misfit => "misfit",
            Self::Delay => "delay",
            Self::Scale => "scale",
            Self::Truncation => "truncation",
            Self::Additional => "additional",
            Self::SamplingRate => "sampling rate",
            Self::OtherChannel => "other channel",
        }
    }
}

/// A record's spectrum, and what it is multiplied by.
pub(super) struct Divided<'s> {
    pub(super) step: &'s WaveformStep,
    pub(super) lines: Lines,
    /// The spectrum of the record.
    pub(super) record: Vec<Phasor>,
    /// The gain of the low-pass times that of the delay.
    pub(super) passed: Vec<Phasor>,
    /// The spectral density of the noise at each line, as the variance of the white noise that has it everywhere.
    pub(super) densities: Vec<f64>,
    pub(super) start: f64,
    pub(super) rate: f64,
}

/// Corrects a record. The standard uncertainties are those of the law of propagation (JCGM 102, 6.2); `trials` draws
/// beside them have another spectrum each, divided by another response (7). `name` and `seed` choose the draws.
///
/// # Errors
/// A sentence on why it cannot be corrected.
pub fn corrected(
    step: &WaveformStep,
    signal: &Signal,
    (name, seed, trials): (&str, u64, u64),
) -> Result<Waveform, String> {
    if signal.values.len() < FEWEST {
        return Err(format!(
            "a record of {} samples has too few for a spectrum; {FEWEST} at least",
            signal.values.len()
        ));
    }
    if let Some(at) = signal.values.iter().position(|value| !value.is_finite()) {
        return Err(format!("sample {} is no finite number", at + 1));
    }
    let lines = Lines::of(signal);
    let at = step.response.at(&lines)?;
    let inverse: Vec<Phasor> = at.inverse.iter().map(|value| value * step.factor).collect();
    let mut densities = step.noise.densities(signal, &lines)?;
    let mut values = signal.values.clone();
    if let Some([from, to]) = step.baseline {
        let quiet = quiet::part(signal, from, to)?;
        let mean = quiet.iter().sum::<f64>() / quiet.len() as f64;
        values.iter_mut().for_each(|value| *value -= mean);
        // the error of that mean is one of the whole record: of its line at zero
        densities[0] *= 1.0 + lines.samples as f64 / quiet.len() as f64;
    }
    let record = lines.forward(&values);
    let unregularized: Vec<Phasor> = record.iter().zip(&inverse).map(|(y, h)| y * h).collect();
    let noise =
        |line: usize| (densities[line] * inverse[line].norm_sqr() * lines.samples as f64).sqrt();
    let bound = match (step.low_pass, step.truncation) {
        (Some(_), Truncation::Decay { from, power }) => {
            Some(SpectrumBound::of((from, power), &unregularized, noise, &lines)?)
        }
        _ => None,
    };
    let cutoff = match (step.low_pass, &bound) {
        (None, _) => None,
        (Some(LowPass { cutoff: Cutoff::Stated(hertz), .. }), _) => Some(hertz),
        (Some(low_pass), Some(bound)) => Some(proposed(low_pass, bound, noise, &lines)),
        (Some(_), None) => {
            return Err(
                "a low-pass can only be proposed where the truncation is bounded by the signal's spectrum: write \
                 `\"truncation\": {\"from\": ..., \"decay\": ...}`, or state the `cutoff`"
                    .to_owned(),
            );
        }
    };
    let gain = |line: usize| match (step.low_pass, cutoff) {
        (Some(low_pass), Some(cutoff)) => low_pass.gain(cutoff, lines.hertz(line)),
        _ => Phasor::new(1.0, 0.0),
    };
    let missing = match (&bound, step.truncation) {
        (Some(bound), _) => bound.missing(gain),
        (None, Truncation::Bound(size)) if step.low_pass.is_some() => Missing::AtInstants(size),
        _ => Missing::AtInstants(0.0),
    };
    let passed: Vec<Phasor> = (0..lines.count())
        .map(|line| gain(line) * at_turns(lines.hertz(line) * step.delay.value))
        .collect();
    let factors = || inverse.iter().zip(&passed).map(|(inverse, passed)| inverse * passed);
    let spectrum: Vec<Phasor> =
        record.iter().zip(factors()).map(|(y, factor)| y * factor).collect();
    let noise_of_lines: Vec<f64> = factors()
        .zip(&densities)
        .enumerate()
        .map(|(line, (factor, density))| {
            lines.weight(line) * density * factor.norm_sqr() / lines.samples as f64
        })
        .collect();
    let errors = [
        (WaveformSource::Response, at.errors),
        (WaveformSource::Misfit, at.misfit),
        (WaveformSource::Delay, response::of_delay(step.delay, &lines)),
        (WaveformSource::Scale, response::of_scale(step.of_scale, &lines)),
    ];
    let errors: Vec<(WaveformSource, LineErrors)> =
        errors.into_iter().filter(|(_, errors)| !errors.is_empty()).collect();
    let values = lines.inverse(spectrum.clone());
    let signal_found = Signal { values, rate: signal.rate, start: signal.start };
    let by_noise: f64 = noise_of_lines.iter().sum();
    let by_truncation = missing.size(&lines) / 3f64.sqrt();
    let additional = step.additional;
    let constant = by_noise + by_truncation * by_truncation + additional * additional;
    let mut variances = vec![constant; lines.samples];
    let mut sources = vec![(WaveformSource::Noise, by_noise.sqrt())];
    for (source, errors) in &errors {
        let of = errors.variances(&spectrum, &lines);
        let mean = of.iter().sum::<f64>() / lines.samples as f64;
        sources.push((*source, mean.sqrt()));
        variances.iter_mut().zip(of).for_each(|(sum, variance)| *sum += variance);
    }
    if by_truncation > 0.0 {
        sources.push((WaveformSource::Truncation, by_truncation));
    }
    let standard_uncertainties: Vec<f64> =
        variances.iter().map(|variance| variance.sqrt()).collect();
    let mut quantities = Vec::new();
    let (mut half_widths, mut additional_sizes) = (Vec::new(), Vec::new());
    for (name, quantity) in &step.quantities {
        let of = quantity.of(&signal_found)?;
        let mut sensitivity = vec![0.0; lines.samples];
        of.coefficients.iter().for_each(|(at, g)| sensitivity[*at] += g);
        let transformed: Vec<Phasor> =
            lines.forward(&sensitivity).iter().map(|value| value.conj()).collect();
        let by_noise: f64 =
            noise_of_lines.iter().zip(&transformed).map(|(v, g)| v * g.norm_sqr()).sum();
        let half_width = missing.change((&sensitivity, quantity.is_value()), &transformed, &lines);
        let mut contributions = vec![(WaveformSource::Noise, by_noise.sqrt())];
        contributions.extend(errors.iter().map(|(source, errors)| {
            (*source, errors.variance_of(&transformed, &spectrum, &lines).sqrt())
        }));
        if half_width > 0.0 {
            contributions.push((WaveformSource::Truncation, half_width / 3f64.sqrt()));
        }
        // at no instant more than at the others, and of an unknown course
        let size =
            if quantity.is_value() { 1.0 } else { sensitivity.iter().map(|g| g.abs()).sum() };
        if additional > 0.0 {
            contributions.push((WaveformSource::Additional, additional * size));
        }
        additional_sizes.push(size);
        let by_rate = of.per_rate.abs() * step.of_rate;
        if by_rate > 0.0 {
            contributions.push((WaveformSource::SamplingRate, by_rate));
        }
        half_widths.push(half_width);
        quantities.push(QuantityFound {
            name: name.clone(),
            quantity: *quantity,
            value: of.value,
            contributions,
            trials: Vec::new(),
            drawn: Vec::new(),
        });
    }
    let (start, rate) = (signal.start, signal.rate);
    let divided = Divided { step, lines, record, passed, densities, start, rate };
    let drawn = trials::run(
        &divided,
        (&signal_found, &standard_uncertainties),
        trials::Constant {
            missing: missing.size(&divided.lines),
            half_widths: &half_widths,
            additional_sizes: &additional_sizes,
        },
        (name, seed, trials),
    );
    let trials = drawn.map(|(found, values)| {
        for (of, drawn) in quantities.iter_mut().zip(values) {
            of.trials = ascending(&drawn);
            of.drawn = drawn;
        }
        found
    });
    let ends = signal.values.first().zip(signal.values.last());
    let of_record = divided.densities.iter().sum::<f64>() / divided.densities.len() as f64;
    let step_at_ends = ends.map_or(0.0, |(first, last)| (last - first).abs());
    Ok(Waveform {
        signal: signal_found,
        standard_uncertainties,
        sources,
        cutoff,
        quantities,
        trials,
        step_at_ends: if step_at_ends > 0.0 {
            step_at_ends / (2.0 * of_record).sqrt()
        } else {
            0.0
        },
    })
}

/// The cut-off at which the variances by noise and by truncation have the smallest sum.
fn proposed(
    low_pass: LowPass,
    bound: &SpectrumBound,
    noise: impl Fn(usize) -> f64,
    lines: &Lines,
) -> f64 {
    let [least, most] = [lines.hertz(4), lines.hertz(lines.count() - 1)];
    let step = elementary::ln(most / least) / TRIED as f64;
    let cost = |cutoff: f64| {
        let gain = |line: usize| low_pass.gain(cutoff, lines.hertz(line));
        let lost = bound.missing(gain).size(lines);
        let by_noise: f64 = (0..lines.count())
            .map(|line| {
                let size = noise(line) / lines.samples as f64;
                lines.weight(line) * gain(line).norm_sqr() * size * size
            })
            .sum();
        by_noise + lost * lost / 3.0
    };
    let cutoffs = (0..=TRIED).map(|i| least * elementary::exp(step * i as f64));
    let costs: Vec<(f64, f64)> = cutoffs.map(|cutoff| (cutoff, cost(cutoff))).collect();
    let best = costs.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or(most, |(cutoff, _)| *cutoff)
}
