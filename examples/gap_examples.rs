//! Makes the synthetic data of the gap cases in `models/gap/`, the same at every call.
//!
//! ```text
//! cargo run --release --example gap_examples
//! ```
//!
//! What is measured is computed here with complex numbers, apart from the formulas of the cases and
//! of the catalogue, from the figures that the papers print. What the papers do not print (noise,
//! repetitions, some parameters) is assumed, and said so in `models/gap/README.md`.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

mod generator;

use generator::{OSCILLATIONS, Phasor, SLIDE, SplitMix64, axes_on_the_plane};

/// 1 / (1 - x^2 + i x / q), the response of one degree of freedom at x times its resonance.
fn resonance(x: f64, q: f64) -> Phasor {
    Phasor { re: 1.0 - x * x, im: x / q }.inverse()
}

/// 1 / (1 - i cut-off / f)
fn high_pass(f: f64, cut_off: f64) -> Phasor {
    Phasor { re: 1.0, im: -cut_off / f }.inverse()
}

/// 1 / (1 + i f / cut-off)
fn low_pass(f: f64, cut_off: f64) -> Phasor {
    Phasor { re: 1.0, im: f / cut_off }.inverse()
}

/// A table as text: seven significant digits, which is far below any noise here.
struct Table(String);

impl Table {
    fn new(header: &str) -> Self {
        Self(format!("# synthetic, made by examples/gap_examples.rs\n{header}\n"))
    }

    fn row(&mut self, values: &[f64]) {
        let cells: Vec<String> = values
            .iter()
            .map(|&value| {
                let digits = if value == 0.0 { 0 } else { 6 - value.abs().log10().floor() as i32 };
                let rounded: f64 =
                    format!("{value:.*}", digits.clamp(0, 12) as usize).parse().unwrap_or(value);
                rounded.to_string()
            })
            .collect();
        let _ = writeln!(self.0, "{}", cells.join(","));
    }
}

/// Inclined planes at the four tilts of Prato et al. and a rotation of 30 deg; `motion` gives the
/// motions along x' and z' relative to the reference.
fn planes(seed: u64, frequencies: &[f64], motion: impl Fn(f64) -> (Phasor, Phasor)) -> String {
    let mut noise = SplitMix64(seed);
    let u = 0.01;
    let reference = 10.0 + noise.normal(0.01);
    let (tilt_error, turn_error) = (noise.within(0.1), noise.within(0.1));
    let mut table = Table::new("f,tilt,rotation,a_x,a_y,a_z,u");
    for &f in frequencies {
        for tilt in [15.0, 35.0, 55.0, 75.0] {
            let rotation = 30.0;
            let (x, z) = motion(f);
            let (x, z) = (x.scaled(reference), z.scaled(reference));
            let motions = [x, Phasor::ZERO, z];
            let axes = axes_on_the_plane(motions, tilt + tilt_error, rotation + turn_error);
            let [a_x, a_y, a_z] = axes.map(|axis| axis.modulus() + noise.normal(u));
            table.row(&[f, tilt, rotation, a_x, a_y, a_z, u]);
        }
    }
    table.0
}

/// The test plan of Chiominto et al., ten repetitions of each configuration at each radius. The
/// scatter is the paper's 0.3 % of tangential and 1 % of radial accelerations. `seen` is the share of
/// an amplitude at a frequency that is read.
fn oscillation(seed: u64, radii: &[f64], offset: f64, seen: impl Fn(f64) -> f64) -> String {
    let mut noise = SplitMix64(seed);
    let radius_error = noise.within(0.025);
    let encoder_error = noise.normal(0.005);
    let mut table = Table::new("frequency,angle_pp,radius,a_t,u_a_t,a_r,u_a_r");
    for &radius in radii {
        for (f, angle) in OSCILLATIONS {
            let r = (radius + radius_error + offset) / 1000.0;
            let pulsation = TAU * f;
            let speed = pulsation * angle.to_radians() / 2.0 * (1.0 + encoder_error);
            let (a_t, a_r) = (pulsation * r * speed, r * speed * speed / 2.0);
            let (u_t, u_r) = (0.003 * a_t, 0.01 * a_r);
            for _ in 0..10 {
                let read_t = a_t * seen(f) + noise.normal(u_t);
                let read_r = a_r * seen(2.0 * f) + noise.normal(u_r);
                table.row(&[f, angle, radius, read_t, u_t, read_r, u_r]);
            }
        }
    }
    table.0
}

/// The modulus of the mean of a phasor that turns by `slip` times its frequency over a record.
fn read_beside_the_line(f: f64, slip: f64) -> f64 {
    let steps = 1000;
    let sum = (0..steps).fold(Phasor::ZERO, |sum, step| {
        let turned = 360.0 * f * slip * (f64::from(step) + 0.5) / f64::from(steps);
        sum.plus(Phasor::polar(1.0, turned))
    });
    sum.modulus() / f64::from(steps)
}

/// Amplitude and phase of a chain over the frequencies of D'Emilia et al., three times each.
fn chain(seed: u64, response: impl Fn(f64) -> Phasor) -> String {
    let mut noise = SplitMix64(seed);
    let (gain, phase) = (1.0 + noise.normal(0.005), noise.normal(0.3));
    let (u_s, u_phi) = (0.005, 0.5);
    let mut table = Table::new("f,s,u_s,phi,u_phi");
    for f in SLIDE {
        let out = response(f).times(Phasor::polar(gain, phase));
        for _ in 0..3 {
            let (s, phi) = (out.modulus() + noise.normal(u_s), out.degrees() + noise.normal(u_phi));
            table.row(&[f, s, u_s, phi, u_phi]);
        }
    }
    table.0
}

/// Two periods of 0.5 Hz: what the vibrometer says, and an accelerometer that leads by 15 deg with
/// 15 % less amplitude. Its noise is such that the RMS difference falls by a quarter once amplitude
/// and phase are corrected: with a gap of g and noise of n, n = 3/4 sqrt(g^2 + n^2).
fn signal(seed: u64) -> String {
    let mut noise = SplitMix64(seed);
    let (f, amplitude) = (0.5, 0.25);
    let lead = Phasor::polar(0.85, 15.0);
    let gap = lead.plus(Phasor::ONE.scaled(-1.0)).modulus() * amplitude / 2f64.sqrt();
    let deviation = gap * (9.0f64 / 7.0).sqrt();
    let mut table = Table::new("t,velocity,acc_ldv,acc_nominal,u");
    for sample in 0..500 {
        let t = f64::from(sample) * 0.008;
        let (sin, cos) = (TAU * f * t).sin_cos();
        let velocity = -amplitude * cos / (TAU * f) + noise.normal(1e-4);
        let acceleration = amplitude * sin + noise.normal(1e-3);
        let led = amplitude * (sin * lead.re + cos * lead.im);
        table.row(&[t, velocity, acceleration, led + noise.normal(deviation), deviation]);
    }
    table.0
}

/// The tables: path in `models/gap` and content.
pub(crate) fn tables() -> Vec<(&'static str, String)> {
    let low = [5.0, 10.0, 20.0, 40.0, 60.0, 70.0, 80.0, 90.0, 100.0, 125.0, 160.0, 315.0, 1000.0];
    let high = [5.0, 20.0, 80.0, 315.0, 630.0, 1000.0, 1600.0, 2000.0, 2500.0, 3000.0];
    let none = Phasor::ZERO;
    // 3 % of the reference at 80 Hz, a quality factor of 6
    let lateral = |f: f64| {
        (resonance(f / 80.0, 6.0).scaled(0.03 / 6.0).times(Phasor::polar(1.0, 60.0)), Phasor::ONE)
    };
    let mode = |f: f64| (none, resonance(f / 9000.0, 20.0));
    // 0.05 % of 40 s
    let slip = 0.02;
    vec![
        ("lateral_motion/data.csv", planes(1, &low, lateral)),
        ("plane_resonance/data.csv", planes(2, &high, mode)),
        (
            "sampling_rate/data.csv",
            oscillation(3, &[170.0], 0.0, |f| read_beside_the_line(f, slip)),
        ),
        ("radius/data.csv", oscillation(4, &[145.0, 170.0], -3.0, |_| 1.0)),
        ("amplifier_0.3_hz/data.csv", chain(5, |f| high_pass(f, 0.1).times(high_pass(f, 0.3)))),
        ("amplifier_3_hz/data.csv", chain(6, |f| high_pass(f, 0.1).times(high_pass(f, 3.0)))),
        ("ac_coupling/data.csv", chain(7, |f| high_pass(f, 0.5))),
        ("mems_low_pass/data.csv", chain(8, |f| low_pass(f, 65.0))),
        ("iepe_signal/data.csv", signal(9)),
    ]
}

/// Writes the tables into `models/gap`.
#[allow(dead_code, clippy::print_stdout)]
fn main() -> std::io::Result<()> {
    debug_assert!(
        (read_beside_the_line(10.0, 0.012) - (0.12 * PI).sin() / (0.12 * PI)).abs() < 1e-6
    );
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/gap");
    for (name, text) in tables() {
        std::fs::write(folder.join(name), text)?;
        println!("{name}");
    }
    Ok(())
}
