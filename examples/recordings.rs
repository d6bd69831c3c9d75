//! Makes the synthetic recordings of the benches in `models/recordings/`, the same at every call.
//!
//! ```text
//! cargo run --release --example recordings
//! ```
//!
//! Motions, sensors and filters are computed here from the figures that the papers print and from
//! those of [`truth`], apart from the models and cases that take the observations. What the papers do
//! not print is assumed, and said so in `models/recordings/README.md`.

use std::error::Error;
use std::f64::consts::{SQRT_2, TAU};
use std::io::Cursor;
use std::path::Path;

use hound::{SampleFormat, WavSpec, WavWriter};

/// What the recordings are made with: what an evaluation is to find.
pub(crate) mod truth {
    /// Frequency of the rotating table in hertz and its oscillation angle from end to end in degrees
    /// (Chiominto et al. 2024, section 3.4.1).
    pub(crate) const TABLE: [(f64, f64); 3] = [(5.0, 34.0), (8.0, 13.0), (10.0, 8.5)];
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
    /// Frequencies of the slide, in hertz.
    pub(crate) const SLIDE: [f64; 12] =
        [0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 10.0, 15.0, 20.0];
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
}

/// Independent random numbers: SplitMix64 (Steele, Lea, Flood 2014) and the method of Box and Muller.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        deviation * radius * (TAU * self.uniform()).cos()
    }
}

/// An amplitude with a phase in degrees, as real and imaginary part.
fn phasor(amplitude: f64, degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [amplitude * cos, amplitude * sin]
}

fn combined(a: [f64; 2], of_a: f64, b: [f64; 2], of_b: f64) -> [f64; 2] {
    [of_a * a[0] + of_b * b[0], of_a * a[1] + of_b * b[1]]
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
    let mut noise = Noise(seed);
    let start = TAU * noise.uniform();
    wav(1000, 1000.0, 10.0, |t| {
        let degrees = truth::ENCODER * angle_pp / 2.0 * (TAU * hertz * t + start).cos();
        [(degrees + noise.normal(0.004)) * 65536.0 / 360.0 + 40.0]
    })
}

/// The digital sensor on it: tangential acceleration r theta'' and radial acceleration r theta'^2.
fn digital_sensor(seed: u64, hertz: f64, angle_pp: f64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = Noise(seed);
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
    let mut noise = Noise(seed);
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

/// What the axes of the sensor on the inclined plane see, as phasors, RMS in m/s^2: motion along x',
/// y', z' turned by tilt and rotation (Prato et al. 2020, eqs (1)-(3), with signs).
pub(crate) fn on_the_plane() -> [[f64; 2]; 3] {
    let [x, y, z] = truth::SPURIOUS.map(|(amplitude, degrees)| phasor(amplitude, degrees));
    let z = [z[0] + truth::REFERENCE, z[1]];
    let [(sin, cos), (sin_turn, cos_turn)] = truth::ANGLES.map(|a| a.to_radians().sin_cos());
    let down = combined(z, sin, x, cos);
    [
        combined(down, cos_turn, y, -sin_turn),
        combined(down, sin_turn, y, cos_turn),
        combined(z, cos, x, -sin),
    ]
}

/// Reference transducer, vibrometers along x', y', z' (all 1 mm/s^2 a count) and the digital sensor
/// on the plane, at 80 Hz.
fn plane(seed: u64) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut noise = Noise(seed);
    let start = TAU * noise.uniform();
    let [x, y, z] = truth::SPURIOUS.map(|(amplitude, degrees)| phasor(amplitude, degrees));
    let reference = [truth::REFERENCE, 0.0];
    let moved = [reference, x, y, [z[0] + truth::REFERENCE, z[1]]];
    let seen = on_the_plane();
    wav(4000, 4000.0, 2.0, |t| {
        let (sin, cos) = (TAU * 80.0 * t + start).sin_cos();
        let at = |of: [f64; 2]| SQRT_2 * (of[0] * cos - of[1] * sin);
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

/// Files with their content.
type Files = Vec<(String, Vec<u8>)>;

/// The recordings: path in `models/recordings` and content.
pub(crate) fn recordings() -> Result<Files, Box<dyn Error>> {
    let mut made = Vec::new();
    for (seed, (hertz, angle)) in (1..).zip(truth::TABLE) {
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
