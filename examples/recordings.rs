//! Makes the synthetic recordings of the benches in `models/recordings/`, the same at every call.
//!
//! ```text
//! cargo run --release --example recordings
//! ```
//!
//! Motions, sensors and filters are computed here from the figures that the papers print and from
//! those of [`truth`], apart from the models and cases that take the observations. What the papers do
//! not print is assumed, and said so in `models/recordings/README.md`.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result

use std::error::Error;
use std::f64::consts::{SQRT_2, TAU};
use std::io::Cursor;
use std::path::Path;

use hound::{SampleFormat, WavSpec, WavWriter};

pub(crate) mod generator;

use generator::{Phasor, SplitMix64, axes_on_the_plane};

/// What the recordings are made with: what an evaluation is to find.
pub(crate) mod truth {
    pub(crate) use super::generator::{OSCILLATIONS, SLIDE};

    /// The radius of the sensor, in metres: 170 mm within the calliper's resolution.
    pub(crate) const RADIUS: f64 = 0.170_01;
    /// What the encoder reads of an angle: within its 0.5 %.
    pub(crate) const ENCODER: f64 = 1.002;
    /// The sampling rate of the digital sensor, which says 1660 Hz of itself, in hertz.
    pub(crate) const RATE: f64 = 1612.0;
    /// Its sensitivities, tangential and radial, in D/(m/s^2); nominal are 417.9.
    pub(crate) const SENSITIVITY: [f64; 2] = [421.6, 416.9];
    /// Cut-off frequencies of IEPE sensor and amplifier in hertz (D'Emilia et al. 2019, section 3.1).
    pub(crate) const HIGH_PASS: [f64; 2] = [0.1, 0.3];
    /// What the vibrometer reads of a velocity, and its phase in degrees.
    pub(crate) const VIBROMETER: (f64, f64) = (1.003, -0.2);
    /// Reference acceleration of the inclined plane, RMS in m/s^2.
    pub(crate) const REFERENCE: f64 = 10.0;
    /// Spurious motion along x', y', z': RMS in m/s^2 and phase against the reference in degrees
    /// (values within 0.1 % to 10 % of the reference: Prato et al. 2020, section 5).
    pub(crate) const SPURIOUS: [(f64, f64); 3] = [(0.3, 120.0), (0.2, -60.0), (0.1, 5.0)];
    /// Tilt and rotation of the plane in degrees: 35 and 30 within the tolerance of 0.1.
    pub(crate) const ANGLES: [f64; 2] = [35.03, 29.96];
    /// Sensitivities of the sensor on the plane along x, y, z, in D/(m/s^2).
    pub(crate) const AXES: [f64; 3] = [419.2, 416.3, 421.8];
    /// The greatest acceleration of the shock in m/s^2, and its width in seconds.
    pub(crate) const SHOCK: [f64; 2] = [5000.0, 2e-4];
    /// The shock accelerometer: sensitivity in pC/(m/s^2), resonance in hertz, damping, delay in seconds.
    pub(crate) const PIEZO: [f64; 4] = [0.1275, 36e3, 0.025, 0.8e-6];
}

/// A recording of whole numbers of 16 bits, `frame` being the values at an instant in seconds. The
/// file says `stated` of its sampling rate.
fn wav<const N: usize>(
    stated: u32,
    rate: f64,
    seconds: f64,
    mut frame: impl FnMut(f64) -> [f64; N],
) -> Result<Vec<u8>, Box<dyn Error>> {
    let spec = WavSpec {
        channels: u16::try_from(N)?,
        sample_rate: stated,
        bits_per_sample: 16,
        sample_format: SampleFormat::Int,
    };
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WavWriter::new(&mut bytes, spec)?;
    for sample in 0..(rate * seconds).round() as u32 {
        for value in frame(f64::from(sample) / rate) {
            writer.write_sample(value.round().clamp(-32768.0, 32767.0) as i16)?;
        }
    }
    writer.finalize()?;
    Ok(bytes.into_inner())
}

/// The encoder of the rotating table: steps of 1/65536 turn, 1000 values a second.
fn encoder(seed: u64, hertz: f64, angle_pp: f64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = SplitMix64(seed);
    let start = TAU * noise.uniform();
    wav(1000, 1000.0, 10.0, |t| {
        let degrees = truth::ENCODER * angle_pp / 2.0 * (TAU * hertz * t + start).cos();
        [(degrees + noise.normal(0.004)) * 65536.0 / 360.0 + 40.0]
    })
}

/// The digital sensor on it: tangential acceleration r theta'' and radial acceleration r theta'^2.
fn digital_sensor(seed: u64, hertz: f64, angle_pp: f64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = SplitMix64(seed);
    let start = TAU * noise.uniform();
    let pulsation = TAU * hertz;
    let [tangential, radial] = truth::SENSITIVITY;
    wav(1660, truth::RATE, 10.0, |t| {
        let (sin, cos) = (pulsation * t + start).sin_cos();
        let amplitude = angle_pp.to_radians() / 2.0;
        let acceleration = -truth::RADIUS * amplitude * pulsation * pulsation * cos;
        let speed = -amplitude * pulsation * sin;
        [
            tangential * acceleration + 35.0 + noise.normal(7.0),
            radial * truth::RADIUS * speed * speed - 22.0 + noise.normal(7.0),
        ]
    })
}

/// Vibrometer (4 um/s a count) and IEPE chain (20 uV a count, 100 mV/(m/s^2)) on the slide.
fn slide(seed: u64, hertz: f64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = SplitMix64(seed);
    let start = TAU * noise.uniform();
    let acceleration = (0.5 * hertz).min(2.0);
    let (gain, phase) = truth::VIBROMETER;
    // how well the slide and the clamped sensor repeat from run to run
    let (gain, phase) = (gain * (1.0 + noise.normal(0.003)), phase + noise.normal(0.3));
    let velocity = gain * acceleration / (TAU * hertz) / 4e-6;
    let (mut output, mut lead) = (0.1 * acceleration / 20e-6, 0.0);
    for cut_off in truth::HIGH_PASS {
        output /= (cut_off / hertz).hypot(1.0);
        lead += (cut_off / hertz).atan();
    }
    wav(500, 500.0, (10.0 / hertz).max(10.0), |t| {
        let angle = TAU * hertz * t + start;
        // the velocity is a quarter of a period behind the acceleration
        [
            velocity * (angle + phase.to_radians()).sin() + noise.normal(3.0),
            output * (angle + lead).cos() + noise.normal(40.0) + 120.0,
        ]
    })
}

/// Motions along x', y', z' of the inclined plane, as phasors, RMS in m/s^2.
fn motions() -> [Phasor; 3] {
    let [x, y, z] = truth::SPURIOUS.map(|(amplitude, degrees)| Phasor::polar(amplitude, degrees));
    [x, y, z.plus(Phasor::ONE.scaled(truth::REFERENCE))]
}

/// What the axes of the sensor on the plane see of them.
pub(crate) fn on_the_plane() -> [Phasor; 3] {
    let [tilt, rotation] = truth::ANGLES;
    axes_on_the_plane(motions(), tilt, rotation)
}

/// Reference transducer, vibrometers along x', y', z' (all 1 mm/s^2 a count) and the digital sensor
/// on the plane, at 80 Hz.
fn plane(seed: u64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = SplitMix64(seed);
    let start = TAU * noise.uniform();
    let [x, y, z] = motions();
    let moved = [Phasor::ONE.scaled(truth::REFERENCE), x, y, z];
    let seen = on_the_plane();
    wav(4000, 4000.0, 2.0, |t| {
        let (sin, cos) = (TAU * 80.0 * t + start).sin_cos();
        let at = |of: Phasor| SQRT_2 * (of.re * cos - of.im * sin);
        let mut frame = [0.0; 7];
        for (value, of) in frame.iter_mut().zip(moved) {
            *value = at(of) / 1e-3 + noise.normal(5.0);
        }
        for (value, (of, sensitivity)) in frame[4..].iter_mut().zip(seen.iter().zip(truth::AXES)) {
            *value = sensitivity * at(*of) + noise.normal(7.0);
        }
        frame
    })
}

/// A shock, a squared half sine: the reference (0.2 m/s^2 a count) and the charge of an accelerometer (0.025 pC a count),
/// which rings at its resonance. Between steps of 1/32 sample the acceleration is taken as straight, for which a mass
/// on a damped spring has an exact solution.
fn shock(seed: u64) -> Result<Vec<u8>, Box<dyn Error>> {
    const STEPS: u32 = 32;
    let mut noise = SplitMix64(seed);
    let [peak, width] = truth::SHOCK;
    let [sensitivity, resonance, damping, delay] = truth::PIEZO;
    let acceleration = |t: f64| {
        let place = (t - 1e-3) / width;
        if (0.0..1.0).contains(&place) { peak * (TAU / 2.0 * place).sin().powi(2) } else { 0.0 }
    };
    let (rate, pulsation) = (5e5, TAU * resonance);
    let step = 1.0 / (rate * f64::from(STEPS));
    let (free, lost) = (pulsation * (1.0 - damping * damping).sqrt(), damping * pulsation);
    let (fall, (sin, cos)) = ((-lost * step).exp(), (free * step).sin_cos());
    let (mut deflection, mut speed, mut before) = (0.0, 0.0, 0.0);
    wav(500_000, rate, 4e-3, |t| {
        for part in 1..=STEPS {
            let now = acceleration(t + (f64::from(part) - f64::from(STEPS)) * step - delay);
            let slope = (now - before) / step;
            let lead = 2.0 * damping * slope / pulsation;
            let (z, own) = (deflection - before + lead, speed - slope);
            let swing = (own + lost * z) / free;
            let next = fall * (z * cos + swing * sin);
            speed = slope - lost * next + fall * free * (swing * cos - z * sin);
            deflection = now - lead + next;
            before = now;
        }
        let reference = acceleration(t) / 0.2 + noise.normal(10.0);
        [reference, sensitivity * deflection / 0.025 + noise.normal(10.0)]
    })
}

/// Files with their content.
type Files = Vec<(String, Vec<u8>)>;

/// The recordings: path in `models/recordings` and content.
pub(crate) fn recordings() -> Result<Files, Box<dyn Error>> {
    let mut made = Vec::new();
    for (seed, (hertz, angle)) in (1..).zip(truth::OSCILLATIONS) {
        made.push((format!("rotating_table/encoder_{hertz}hz.wav"), encoder(seed, hertz, angle)?));
        made.push((
            format!("rotating_table/sensor_{hertz}hz.wav"),
            digital_sensor(10 + seed, hertz, angle)?,
        ));
    }
    for (seed, hertz) in (21..).zip(truth::SLIDE) {
        made.push((format!("iepe_chain/slide_{hertz}hz.wav"), slide(seed, hertz)?));
    }
    made.push(("spurious_components/plane_80hz.wav".to_owned(), plane(41)?));
    made.push(("shock/shock.wav".to_owned(), shock(51)?));
    Ok(made)
}

/// Writes the recordings into `models/recordings`.
#[allow(dead_code, clippy::print_stdout)]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/recordings");
    for (name, bytes) in recordings()? {
        std::fs::write(folder.join(&name), bytes)?;
        println!("{name}");
    }
    Ok(())
}
