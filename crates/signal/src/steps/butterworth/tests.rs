use std::f64::consts::TAU;

use super::*;
use crate::phasor::{angle, modulus};
use crate::study::{SETTINGS, Setting, study};
use crate::{Harmonics, Periodic};

fn signal(rate: f64, values: Vec<f64>) -> Signal {
    Signal { values, rate, start: 0.0 }
}

fn sine(rate: f64, n: usize, f: f64) -> Signal {
    signal(rate, (0..n).map(|k| 9.8 + (TAU * f * k as f64 / rate).cos()).collect())
}

fn known(value: f64, standard_uncertainty: f64) -> Measured {
    Measured { value, standard_uncertainty, degrees_of_freedom: f64::INFINITY }
}

/// Outputs and responses against scipy. Its second-order sections of the narrow bands lose digits
/// (poles at 1 - 1e-3 and closer: 1e-16 / 1e-6), hence 1e-9.
#[test]
fn filters_are_scipys() {
    let table = include_str!("../../../tests/data/butterworth.csv");
    let mut seen = 0;
    for line in table.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = fields[1..].iter().map(|text| text.parse().unwrap()).collect();
        let band = match fields[0] {
            "low" => Band::LowPass(numbers[1]),
            "high" => Band::HighPass(numbers[1]),
            _ => Band::BandPass(numbers[1], numbers[2]),
        };
        let filter = Butterworth { band, poles: numbers[0] as usize, both_ways: false }
            .at(numbers[3])
            .unwrap();
        let mut values: Vec<f64> =
            (0..401).map(|k| (0.7 * f64::from(k)).sin() + 0.3 * f64::from(k % 7)).collect();
        filter.run(&mut values, 0.0);
        for (i, k) in [1, 10, 100, 400].into_iter().enumerate() {
            assert!((values[k] - numbers[4 + i]).abs() < 1e-9, "{line}: y{k} = {}", values[k]);
        }
        for (i, f) in [3.0, 5.0, 20.0, 90.0].into_iter().enumerate() {
            let expected = Phasor::new(numbers[8 + 2 * i], numbers[9 + 2 * i]);
            let found = filter.response(f);
            assert!(modulus(found - expected) < 1e-9, "{line}: {f} Hz: {found}");
        }
        seen += 1;
    }
    assert_eq!(seen, 7);
}

/// The gain of a low-pass filter is 1 / sqrt(1 + (tan / tan)^(2 n)) in closed form, and at the
/// corner 1/sqrt(2), half of it both ways. A hundred thousandth of the rate costs no digits.
#[test]
fn gain_in_closed_form() {
    for (corner, rate) in [(40.0, 1612.0), (0.1, 50_000.0)] {
        let filter = Butterworth { band: Band::LowPass(corner), poles: 6, both_ways: false };
        let at = filter.at(rate).unwrap();
        for f in [0.1 * corner, 0.7 * corner, corner, 3.0 * corner] {
            let ratio = (PI * f / rate).tan() / (PI * corner / rate).tan();
            let expected = 1.0 / (1.0 + ratio.powi(12)).sqrt();
            assert!((modulus(at.response(f)) / expected - 1.0).abs() < 1e-13);
        }
        let both = Butterworth { both_ways: true, ..filter }.at(rate).unwrap();
        assert!((both.response(corner).re - 0.5).abs() < 1e-13);
        assert_eq!(both.response(corner).im, 0.0);
    }
}

/// A filtered sine has the stated gain and phase from the stated number of values on, within the
/// tolerance; before, the start is felt. Its offset passes.
#[test]
fn filtered_sine_settles_within_the_tolerance() {
    for (band, poles) in [
        (Band::LowPass(40.0), 6),
        (Band::LowPass(8.0), 3),
        (Band::BandPass(4.0, 12.0), 4),
        (Band::HighPass(0.5), 2),
    ] {
        for both_ways in [false, true] {
            let filter = Butterworth { band, poles, both_ways }.at(1612.0).unwrap();
            let done = filter.apply(&sine(1612.0, 30_000, 8.3), 1e-6);
            let h = filter.response(8.3);
            let offset = 9.8 * filter.response(0.0).re;
            let error = |k: usize| {
                let (sin, cos) = (TAU * 8.3 * k as f64 / 1612.0).sin_cos();
                (done.signal.values[k] - offset - h.re * cos + h.im * sin).abs()
            };
            let settled = done.settling..30_000 - done.unsettling;
            // the signal lies up to 1 about its mean; 1e-9 of rounding
            let worst = settled.map(error).fold(0.0, f64::max);
            assert!(worst < 2e-6, "{band:?} {both_ways}: {worst:e} after {}", done.settling);
            assert!((0..done.settling / 2).map(error).fold(0.0, f64::max) > 1e-6);
            assert_eq!(done.settled().unwrap().start, done.settling as f64 / 1612.0);
        }
    }
}

/// The noise's variance after a filter is the integral of its squared gain over the frequency.
/// A sum of 20 000 evenly spaced frequencies of a periodic smooth function is exact to 1e-12.
#[test]
fn noise_gain_is_the_integral_of_the_squared_response() {
    for both_ways in [false, true] {
        let filter = Butterworth { band: Band::BandPass(30.0, 60.0), poles: 4, both_ways };
        let filter = filter.at(1612.0).unwrap();
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|j| filter.response(806.0 * (f64::from(j) + 0.5) / f64::from(n)).norm_sqr())
            .sum();
        let noise = filter.noise();
        assert!((noise.power / (sum / f64::from(n)) - 1.0).abs() < 1e-10, "{noise:?}");
        let squares: f64 = (0..n)
            .map(|j| filter.response(806.0 * (f64::from(j) + 0.5) / f64::from(n)).norm_sqr())
            .map(|square| square * square)
            .sum();
        assert!((noise.fourth / (squares / f64::from(n)) - 1.0).abs() < 1e-10, "{noise:?}");
        assert_eq!(noise.level, 0.0);
    }
    // the source's filter: close to the analogue noise bandwidth, pi/12 / sin(pi/12) * 40 Hz
    let low = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: false };
    let low = low.at(1612.0).unwrap();
    let analogue = 40.0 * (PI / 12.0) / (PI / 12.0).sin() / 806.0;
    // the bilinear transform narrows the skirt by about (pi 40/1612)^2
    assert!((low.noise().power / analogue - 1.0).abs() < 0.01);
    let factor = low.noise().factor(low.response(5.0));
    assert!((factor - (1.0 / analogue).sqrt()).abs() < 0.03, "{factor}");
}

/// Gain's and phase's uncertainties against differences of the response, one part in 1e5 apart.
#[test]
fn passage_carries_the_frequencys_uncertainty() {
    for (band, poles) in
        [(Band::LowPass(40.0), 5), (Band::HighPass(3.0), 3), (Band::BandPass(4.0, 9.0), 6)]
    {
        let filter = Butterworth { band, poles, both_ways: false }.at(1612.0).unwrap();
        let passage = filter.passage(known(8.0, 8e-5), 0.0);
        let (up, down) = (filter.response(8.0 + 8e-5), filter.response(8.0 - 8e-5));
        let gain = (modulus(up) - modulus(down)).abs() / 2.0;
        let phase = angle(up / down).abs() / 2.0;
        // second order: (1e-5 times poles)^2 relative
        assert!((passage.gain.standard_uncertainty - gain).abs() < 1e-6 * gain + 1e-14);
        assert!((passage.phase.standard_uncertainty - phase).abs() < 1e-6 * phase + 1e-14);
        // a rate that is off moves the corners: the same, seen from the filter
        let rate = filter.passage(known(8.0, 0.0), 1e-5);
        assert!((rate.gain.standard_uncertainty - passage.gain.standard_uncertainty).abs() < 1e-15);
    }
    let both = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: true };
    let passage = both.at(1612.0).unwrap().passage(known(35.0, 0.1), 0.0);
    assert_eq!(passage.phase.standard_uncertainty, 0.0);
    let edges = [35.1, 34.9].map(|f| both.at(1612.0).unwrap().response(f).re);
    let gain = (edges[0] - edges[1]).abs() / 2.0;
    assert!((passage.gain.standard_uncertainty / gain - 1.0).abs() < 1e-3);
}

#[test]
fn impossible_filters_are_refused() {
    let at = |band, poles| Butterworth { band, poles, both_ways: false }.at(100.0).unwrap_err();
    assert_eq!(
        at(Band::LowPass(50.0), 2).to_string(),
        "the corner frequency (Hz) is 50, and must lie between 0 and 50"
    );
    assert_eq!(at(Band::BandPass(1.0, 2.0), 3), Unsuitable::OddPoles { poles: 3 });
    assert!(matches!(at(Band::BandPass(3.0, 2.0), 4), Unsuitable::Outside { found: 3.0, .. }));
    assert!(matches!(at(Band::LowPass(f64::NAN), 2), Unsuitable::Outside { .. }));
    assert!(matches!(at(Band::LowPass(1.0), 0), Unsuitable::Outside { .. }));
}

/// The amplitude before the filter from a sine fit after it: divided by the gain, its uncertainty
/// multiplied by the noise's factor.
fn judge(setting: Setting, filter: Butterworth, recordings: usize) {
    let harmonics = Harmonics { frequency: setting.frequency, count: 1 };
    let filter = filter.at(setting.rate).unwrap();
    let response = filter.response(setting.frequency);
    let (first, gain) = (filter.settling(1e-7), filter.noise());
    let ends = if filter.both_ways { 2 * first } else { first };
    let (factor, freedom) = gain.of_fit(response, setting.samples().saturating_sub(ends));
    if freedom < 40.0 {
        // of so few degrees of freedom 3 u are not 99 %
        return;
    }
    study("filter", recordings, |noise| {
        let phase = 6.0 * noise.uniform();
        let signal = setting.record(noise, setting.sine(phase));
        let settled = filter.apply(&signal, 1e-7).settled().unwrap();
        let fitted = Periodic::fit(&settled, harmonics).unwrap();
        let gain = modulus(response);
        let mut part = fitted.in_noise(|_| factor, freedom).parts[0];
        // what rounding distorts goes through the filter as the sine does
        let before = Periodic::fit(&signal, harmonics).unwrap().rounded_to(setting.step());
        part.rounding = before.parts[0].rounding * gain;
        let found = part.amplitude();
        let before = Measured {
            value: found.value / gain,
            standard_uncertainty: found.standard_uncertainty / gain,
            ..found
        };
        (before, 1.0)
    })
    .is_right(&format!("amplitude through {:?}", filter.sections.len()), Some(setting));
}

const SOURCE: Butterworth = Butterworth { band: Band::LowPass(40.0), poles: 6, both_ways: false };

#[test]
fn uncertainty_is_right_quick() {
    judge(SETTINGS[2], SOURCE, 200);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn uncertainty_is_right() {
    for setting in SETTINGS {
        judge(setting, SOURCE, 1000);
        let f = setting.frequency;
        let band = Band::BandPass(0.5 * f, 2.0 * f);
        judge(setting, Butterworth { band, poles: 4, both_ways: true }, 1000);
    }
}
