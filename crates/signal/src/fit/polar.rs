//! Amplitude and phase of a fitted tone, and what each source of uncertainty does to them.

use std::f64::consts::PI;

use crate::Measured;
use crate::analysed::{Analysed, Fundamental, local, shares, speed};
use crate::budget::UncertaintySource;
use crate::phasor::{angle, modulus};
use crate::recipe::Channel;
use crate::spurious::leakage;
use gumption_engine::number::elementary::{atan2, exp, hypot};

/// A tone of a channel as A cos(2 pi f t + phi).
#[derive(Clone, Debug)]
pub(crate) struct Polar {
    /// Its place among the tones of the design.
    pub(crate) tone: usize,
    /// A, corrected for jitter.
    pub(crate) amplitude: f64,
    /// phi at the recording's instant 0, in radians, not wrapped.
    pub(crate) phase: f64,
    /// Standard uncertainties of A and, in radians, of phi from the channel's own noise and the like:
    /// those that no other channel shares.
    pub(crate) own: Vec<(UncertaintySource, f64, f64)>,
    /// Contributions of the channel's steps: source, to A and, in radians, to phi.
    pub(crate) steps: Vec<(UncertaintySource, f64, f64)>,
    /// The modulus of the gain that the factors of the fit are still to be divided by, as A is.
    pub(crate) gain: f64,
    /// The standard uncertainty of A from what it shares with others.
    pub(crate) shared: Vec<(UncertaintySource, f64)>,
    /// How phi moves with the cycles in a sample interval that the fit took, radians.
    pub(crate) slope: f64,
    /// The standard uncertainty of phi from the sampling rate, radians, with its sign.
    pub(crate) of_rate: f64,
    /// That from the instant of the record's middle, where instants of the samples tell it.
    pub(crate) of_instants: f64,
    /// Standard deviations of the fitted phasor along its own direction and across it, divided by the
    /// gain, from noise of all kinds.
    pub(crate) scatter: [f64; 2],
    /// The mean of the cosine over the jitter of the instants, which the fitted phasor lost.
    pub(crate) blur: f64,
    /// The fundamental that the tone belongs to.
    pub(crate) of: Fundamental,
}

/// The tone `multiple` of a fundamental; none if it is not fitted.
pub(crate) fn polar(
    analysed: &Analysed,
    channel: &Channel,
    fundamental: usize,
    multiple: u32,
) -> Option<Polar> {
    let Analysed { design, fit, residuals, base, .. } = analysed;
    let wanted =
        |tone: &crate::sine_fit::Tone| tone.fundamental == fundamental && tone.multiple == multiple;
    let tone = design.tones.iter().position(wanted)?;
    let of = *analysed.fundamentals.get(fundamental)?;
    let (a, b) = (fit.cosines[tone], fit.sines[tone]);
    let amplitude = hypot(a, b);
    let size = if amplitude > 0.0 { amplitude } else { f64::MIN_POSITIVE };
    let times = f64::from(multiple);
    let samples = design.samples as f64;

    // noise of all kinds: the part along the amplitude, and across it
    let [of_cosine, of_sine] = local(residuals, tone).map(|over| residuals.variance * over);
    let (va, vb) =
        (of_cosine * design.even[(tone + 1, tone + 1)], of_sine * design.odd[(tone, tone)]);
    let (ca, cb) = (a / size, b / size);
    let along = ca * ca * va + cb * cb * vb;
    let across = cb * cb * va + ca * ca * vb;
    let [quantization, jitter] = shares(analysed);
    let noise = (1.0 - quantization - jitter).max(0.0);
    // what rounding does, along and across, and the part of it that is noise
    let (rounded, scattered) = match (&residuals.known, &analysed.rounding) {
        (Some(known), _) => {
            let rounding = known.rounding.get(tone).copied().unwrap_or(0.0);
            // of many different values rounding moves the amplitude of a sine, not its phase
            let across = if multiple == 1 { 0.0 } else { rounding * rounding };
            ([rounding * rounding, across], quantization)
        }
        (None, Some(rounding)) => {
            let [aa, ab, bb] = rounding.tones.get(tone).copied().unwrap_or([0.0; 3]);
            let along = ca * ca * aa + 2.0 * ca * cb * ab + cb * cb * bb;
            let across = cb * cb * aa - 2.0 * ca * cb * ab + ca * ca * bb;
            // what repeats is no noise near the tone: where that was measured, it is not left out of
            // it once more
            let near = f64::midpoint(of_cosine, of_sine);
            let left_out = quantization * (1.0 - rounding.repeated);
            let measured = if near > 0.0 { rounding.scattered / near - noise } else { 0.0 };
            let scattered = measured.min(quantization).max(left_out);
            ([along.max(0.0), across.max(0.0)], scattered)
        }
        (None, None) => ([0.0; 2], quantization),
    };
    // the slope is steep where the sine is small: of the share of an even spread of jitter 1 - b/2
    // goes along and 1 + b/2 across, with b = exp(-(2 pi f s)^2) (a half and three halves of little
    // jitter), which are the sums of cos^2 and sin^2 with the variance of cos(2 pi f (t + s z))
    let blur = speed(analysed, tone) * base.jitter;
    let even = exp(-blur * blur);
    let (fore, aside) =
        if multiple == 1 { (1.0 - even / 2.0, 1.0 + even / 2.0) } else { (1.0, 1.0) };
    let leakage = leakage(&analysed.spurious, design.tones[tone].cycles, samples);
    let slope = design.slope(fit, fundamental);
    let (sa, sb) = (slope.cosines[tone], slope.sines[tone]);
    let phase_slope = (b * sa - a * sb) / (size * size);
    let cut = phase_slope * size * of.of_cut;
    // oscillations beside it, whose frequencies the recording tells no better than that
    let mut beside = [0.0; 2];
    for (number, oscillation) in analysed.besides.fitted.iter().enumerate() {
        let slope = design.slope(fit, analysed.fundamentals.len() + number);
        let (sa, sb) = (
            slope.cosines[tone] * oscillation.deviation,
            slope.sines[tone] * oscillation.deviation,
        );
        beside[0] += (ca * sa + cb * sb).powi(2);
        beside[1] += (ca * sb - cb * sa).powi(2);
    }
    let mut own: Vec<(UncertaintySource, f64, f64)> = Vec::new();
    let mut scatter = [0.0; 2];
    let mut add = |source, along: f64, across: f64| {
        own.push((source, along.sqrt(), across.sqrt() / size));
        scatter[0] += along;
        scatter[1] += across;
    };
    add(UncertaintySource::Noise, along * noise, across * noise);
    add(
        UncertaintySource::Quantization,
        along * scattered + rounded[0],
        across * scattered + rounded[1],
    );
    add(UncertaintySource::Jitter, along * jitter * fore, across * jitter * aside);
    let [fore, aside] = beside.map(|of_frequency| leakage * leakage + of_frequency);
    add(UncertaintySource::Leakage, fore, aside + cut * cut);

    // a fit at the wrong frequency: to first order by its slope; to second order the amplitude falls
    // as sin(x)/x with x = pi n N dc, whose x^2/6 has the rms value sqrt(3)/6 u(x)^2
    let amplitude_slope = ca * sa + cb * sb;
    let mistuned = |u: f64| {
        let x = PI * times * samples * u;
        hypot(amplitude_slope * u, amplitude * 3f64.sqrt() / 6.0 * x * x)
    };
    let to_middle = base.start * base.rate.value + (samples - 1.0) / 2.0;
    let shared = vec![
        (UncertaintySource::Frequency, hypot(mistuned(of.of_stated), mistuned(of.of_estimate))),
        (UncertaintySource::SamplingRate, mistuned(of.of_rate)),
        (UncertaintySource::Leakage, mistuned(of.of_cut)),
        (
            UncertaintySource::Scale,
            amplitude * channel.scale_uncertainty * analysed.effects.power_of_scale(),
        ),
    ];
    // the mean of cos over normal jitter s is less by exp(-(2 pi f s)^2/2), as is its scatter
    let kept = exp(-blur * blur / 2.0);
    let cycles = of.turning * times;
    // what the steps did, and what of it is still in the fit
    let frequency = Measured {
        value: of.hertz.value * times,
        standard_uncertainty: of.hertz.standard_uncertainty * times,
        ..of.hertz
    };
    let left = analysed.effects.left(frequency.value);
    let gain = modulus(left);
    let relative = base.rate.standard_uncertainty / base.rate.value;
    let mut steps = analysed.effects.contributions(frequency, relative);
    for (_, along, _) in &mut steps {
        *along *= amplitude / (gain * kept);
    }
    for (_, along, _) in &mut own {
        *along /= gain * kept;
    }
    let phi_slope = phase_slope - 2.0 * PI * times * to_middle;
    let (of_rate, of_instants) = match base.of_middle {
        None => (phi_slope * of.of_rate, 0.0),
        // from the middle to instant 0 it is a number of seconds that the rate has no part in, times the
        // frequency, which is known by the rate where it is not stated
        Some(u) => {
            let of_frequency = -2.0 * PI * of.cycles * times * to_middle * relative;
            let of_rate = if of.is_stated { phase_slope * of.of_rate } else { of_frequency };
            (of_rate, 2.0 * PI * of.hertz.value * times * u)
        }
    };
    Some(Polar {
        tone,
        steps,
        gain,
        amplitude: amplitude / (gain * kept),
        phase: atan2(-b, a) - angle(left) - 2.0 * PI * (cycles * to_middle).fract(),
        own,
        shared: shared.into_iter().map(|(source, u)| (source, u / (gain * kept))).collect(),
        slope: phi_slope,
        of_rate,
        of_instants,
        scatter: scatter.map(|square| square.sqrt() / gain),
        blur: kept,
        of,
    })
}
