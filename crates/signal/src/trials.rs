//! The check by Monte Carlo: amplitudes, phases and distortion of fits whose phasors are drawn with
//! the recording's own noise, along and across each with its own contributions (the factors of a
//! linear fit are normal whatever the record's length, so drawing them is drawing recordings).

use std::f64::consts::PI;

use super::analysed::Analysed;
use super::normals::Normals;
use super::phasor::wrapped;
use super::polar::Polar;
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::elementary::{atan2, hypot, sin};

/// Root mean square errors over the trials.
#[derive(Clone, Debug)]
pub(super) struct Scatter {
    /// Of the amplitude of each tone, peak.
    pub(super) amplitudes: Vec<f64>,
    /// Of the phase of each tone, about the middle of the record, in radians.
    pub(super) phases: Vec<f64>,
    /// Of the distortion.
    pub(super) distortion: f64,
}

/// Draws `trials` fits of one channel; `tones[0]` is the fundamental, the others are its multiples.
pub(super) fn scatter(
    analysed: &Analysed,
    name: &str,
    tones: &[Polar],
    seed: u64,
    trials: u64,
) -> Scatter {
    let count = tones.len();
    let mut scatter =
        Scatter { amplitudes: vec![0.0; count], phases: vec![0.0; count], distortion: 0.0 };
    let Some(first) = tones.first() else { return scatter };
    let fit = &analysed.fit;
    let mut normals = Normals::new(StreamKey::new(seed, name));
    let samples = analysed.design.samples as f64;
    let of = |tones: &mut dyn Iterator<Item = (f64, f64)>| {
        let sum: f64 = tones.map(|(square, noise)| square - noise).sum();
        if sum > 0.0 { sum.sqrt() } else { 0.0 }
    };
    let noise = |polar: &Polar| {
        let [a, b] = polar.scatter;
        a * a + b * b
    };
    let plain =
        |polar: &Polar| (fit.cosines[polar.tone] / polar.gain, fit.sines[polar.tone] / polar.gain);
    let square = |(a, b): (f64, f64)| a * a + b * b;
    let harmonics = || tones.iter().filter(|polar| analysed.design.tones[polar.tone].multiple > 1);
    let size = square(plain(first)).sqrt();
    let stated = of(&mut harmonics().map(|p| (square(plain(p)), noise(p)))) / size;
    let detuned = hypot(hypot(first.of.of_stated, first.of.of_estimate), first.of.of_rate);
    let centres: Vec<Centre> = tones
        .iter()
        .map(|polar| {
            let (a, b) = plain(polar);
            let size = hypot(a, b);
            Centre {
                factors: (a, b),
                size,
                phase: atan2(-b, a),
                direction: if size > 0.0 { (a / size, b / size) } else { (1.0, 0.0) },
                multiple: f64::from(analysed.design.tones[polar.tone].multiple),
                noise: noise(polar),
            }
        })
        .collect();
    let mut drawn = vec![(0.0, 0.0); count];
    for _ in 0..trials {
        let detuned = detuned * normals.next();
        for ((polar, centre), drawn) in tones.iter().zip(&centres).zip(&mut drawn) {
            let (a, b) = centre.factors;
            let x = PI * centre.multiple * samples * detuned;
            let fall = if x.abs() > 1e-6 { sin(x) / x } else { 1.0 };
            let (ca, cb) = centre.direction;
            let [along, across] = polar.scatter;
            let (fore, aside) = (along * normals.next(), across * normals.next());
            *drawn = (a * fall + ca * fore - cb * aside, b * fall + cb * fore + ca * aside);
        }
        for (number, ((polar, centre), factors)) in
            tones.iter().zip(&centres).zip(&drawn).enumerate()
        {
            let amplitude = (hypot(factors.0, factors.1) - centre.size) / polar.blur;
            let phase = wrapped(atan2(-factors.1, factors.0) - centre.phase);
            scatter.amplitudes[number] += amplitude * amplitude;
            scatter.phases[number] += phase * phase;
        }
        let pairs = centres.iter().zip(&drawn);
        let mut multiples = pairs
            .filter(|(centre, _)| centre.multiple > 1.0)
            .map(|(centre, factors)| (square(*factors), centre.noise));
        let main = drawn.first().map_or(size, |factors| square(*factors).sqrt());
        let error = of(&mut multiples) / main - stated;
        scatter.distortion += error * error;
    }
    let root = |sum: &mut f64| *sum = (*sum / trials.max(1) as f64).sqrt();
    scatter.amplitudes.iter_mut().chain(&mut scatter.phases).for_each(root);
    root(&mut scatter.distortion);
    scatter
}

/// A tone as it was fitted, about which the trials lie.
struct Centre {
    /// Of cosine and sine, without the gain.
    factors: (f64, f64),
    size: f64,
    phase: f64,
    direction: (f64, f64),
    multiple: f64,
    /// The square of the noise's size.
    noise: f64,
}
