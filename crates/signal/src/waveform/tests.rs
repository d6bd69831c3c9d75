//! Corrected records whose truth is known.

use std::sync::Arc;

use super::*;
use crate::tests::simulated::normals;
use crate::{Measured, Phasor, Signal};
use spectrum::Lines;

/// The seismic transducer of ISO 16063-43: S0/(1 - (f/f0)^2 + 2 i damping f/f0).
#[derive(Debug)]
struct Seismic([f64; 3]);

fn seismic(hertz: f64, [s0, f0, damping]: [f64; 3]) -> Phasor {
    let of = hertz / f0;
    Phasor::new(s0, 0.0) / Phasor::new(1.0 - of * of, 2.0 * damping * of)
}

impl ResponseModel for Seismic {
    fn value(&self, hertz: f64, parameters: &[f64]) -> Phasor {
        seismic(hertz, [parameters[0], parameters[1], parameters[2]])
    }

    fn gradient(&self, hertz: f64) -> Vec<Phasor> {
        let [s0, f0, damping] = self.0;
        let (of, value) = (hertz / f0, seismic(hertz, self.0));
        let per = -value * value / s0;
        vec![
            value / s0,
            per * Phasor::new(2.0 * of * of / f0, -2.0 * damping * of / f0),
            per * Phasor::new(0.0, 2.0 * of),
        ]
    }
}

const TRUTH: [f64; 3] = [2.0, 3000.0, 0.05];

/// A shock of 1 ms: a squared half sine, whose spectrum falls with the third power of the frequency.
fn shock(rate: f64, samples: usize) -> Vec<f64> {
    let value = |i: usize| {
        let t = (i as f64 / rate - 0.004) / 1e-3;
        if (0.0..1.0).contains(&t) { (std::f64::consts::PI * t).sin().powi(2) } else { 0.0 }
    };
    (0..samples).map(value).collect()
}

/// A signal as it comes out of a response and a delay.
fn through(values: &[f64], rate: f64, response: impl Fn(f64) -> Phasor, delay: f64) -> Vec<f64> {
    let lines = Lines { samples: values.len(), spacing: rate / values.len() as f64 };
    let mut spectrum = lines.forward(values);
    for (line, value) in spectrum.iter_mut().enumerate() {
        let hertz = lines.hertz(line);
        *value *= response(hertz) * crate::phasor::at_turns(-hertz * delay);
    }
    lines.inverse(spectrum)
}

fn modelled(estimates: [f64; 3], u: [f64; 3]) -> LineResponse {
    let covariance = (0..9).map(|i| if i % 4 == 0 { u[i / 4] * u[i / 4] } else { 0.0 }).collect();
    LineResponse::Modelled(ModelledResponse {
        model: Arc::new(Seismic(estimates)),
        estimates: estimates.to_vec(),
        covariance,
        misfit: None,
    })
}

fn step(response: LineResponse) -> WaveformStep {
    WaveformStep {
        response,
        factor: 1.0,
        low_pass: None,
        truncation: Truncation::Nothing,
        noise: QuietPart::Stated(0.0),
        baseline: None,
        delay: Measured {
            value: 0.0,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        },
        of_scale: 0.0,
        of_rate: 0.0,
        additional: 0.0,
        quantities: Vec::new(),
    }
}

/// What a known response did is undone; rounding of two transforms of values up to some hundreds.
#[test]
fn a_known_response_is_undone() {
    let rate = 50_000.0;
    for samples in [999, 1000] {
        let truth = shock(rate, samples);
        let values = through(&truth, rate, |f| seismic(f, TRUTH), 3e-5);
        let mut of = step(modelled(TRUTH, [0.0; 3]));
        of.delay.value = 3e-5;
        let signal = Signal { values, rate, start: 0.0 };
        let found = corrected(&of, &signal, ("a", 1, 0)).unwrap();
        for (line, (x, truth)) in found.signal.values.iter().zip(&truth).enumerate() {
            // the line at half the rate loses its imaginary part to the delay
            assert!((x - truth).abs() < 1e-6, "{line}: {x} {truth}");
        }
    }
}

/// 300 records with errors of their own in noise, three parameters, delay and scale. At four instants, for the greatest
/// value and its time, the errors have the standard deviation that is stated: its estimate scatters by 1/sqrt(600) =
/// 4.1 %, and four of these in one of 6 figures have a probability of 4e-4. The trials have the same standard
/// uncertainties: of 2000, each within 1.6 %, four of them, and 2 % for what is not linear.
#[test]
fn standard_uncertainties_are_right() {
    let (rate, samples, records) = (50_000.0, 1000, 300);
    let truth = shock(rate, samples);
    let u = [0.01, 15.0, 0.002];
    let (of_noise, of_delay, of_scale) = (0.0002, 2e-6, 0.004);
    let low_pass = LowPass { cutoff: Cutoff::Stated(4000.0), order: 4, delay: None };
    // what the low-pass leaves of the truth: truncation is not under test here
    let lines = Lines { samples, spacing: rate / samples as f64 };
    let mut spectrum = lines.forward(&truth);
    for (line, value) in spectrum.iter_mut().enumerate() {
        *value *= low_pass.gain(4000.0, lines.hertz(line));
    }
    let kept = Signal { values: lines.inverse(spectrum), rate, start: 0.0 };
    let quantities = [WaveformQuantity::Maximum, WaveformQuantity::MaximumTime];
    let instants = [100, 215, 225, 240];
    let mut squares = [0.0; 6];
    let (mut stated, mut drawn) = ([0.0; 6], [0.0; 6]);
    for record in 0..records {
        let z = normals(7, &format!("record {record}"), samples + 5);
        let wrong = [0, 1, 2].map(|i| TRUTH[i] + u[i] * z[i]);
        let values = through(&truth, rate, |f| seismic(f, wrong), of_delay * z[3]);
        let scale = 1.0 + of_scale * z[4];
        let noisy = values.iter().zip(&z[5..]).map(|(y, z)| y * scale + of_noise * z);
        let signal = Signal { values: noisy.collect(), rate, start: 0.0 };
        let of = WaveformStep {
            low_pass: Some(low_pass),
            noise: QuietPart::Stated(of_noise),
            delay: Measured {
                value: 0.0,
                standard_uncertainty: of_delay,
                degrees_of_freedom: f64::INFINITY,
            },
            of_scale,
            quantities: quantities.iter().map(|of| (of.name().to_owned(), *of)).collect(),
            ..step(modelled(TRUTH, u))
        };
        let trials = if record == 0 { 2000 } else { 0 };
        let found = corrected(&of, &signal, ("a", 1, trials)).unwrap();
        let expected = |quantity: WaveformQuantity| quantity.of(&kept).unwrap().value;
        let errors = instants.map(|at| found.signal.values[at] - kept.values[at]);
        let figures = [0, 1].map(|i| found.quantities[i].value - expected(quantities[i]));
        for (sum, error) in squares.iter_mut().zip(errors.into_iter().chain(figures)) {
            *sum += error * error;
        }
        if record == 0 {
            let of_values = instants.map(|at| found.standard_uncertainties[at]);
            let of_figures = [0, 1].map(|i| found.quantities[i].standard_uncertainty());
            let all = of_values.into_iter().chain(of_figures);
            stated.iter_mut().zip(all).for_each(|(stated, u)| *stated = u);
            let trials = found.trials.unwrap();
            let of_values = instants.map(|at| trials.standard_uncertainties[at]);
            let of_figures = [0, 1].map(|i| {
                let values = &found.quantities[i].trials;
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                let sum: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
                (sum / (values.len() - 1) as f64).sqrt()
            });
            let all = of_values.into_iter().chain(of_figures);
            drawn.iter_mut().zip(all).for_each(|(drawn, u)| *drawn = u);
            let factor = trials.simultaneous_factor.unwrap();
            // between one instant's 1.96 and that of 1000 independent ones, 4.05
            assert!((2.5..4.2).contains(&factor), "{factor}");
        }
    }
    for i in 0..6 {
        let ratio = (squares[i] / f64::from(records)).sqrt() / stated[i];
        assert!((ratio - 1.0).abs() < 0.165, "{i}: {ratio}");
        assert!((drawn[i] / stated[i] - 1.0).abs() < 0.085, "{i}: {} {}", drawn[i], stated[i]);
    }
}

/// Points of a calibration: an error that they have in common is that of the scale, and a held point is one error of
/// many lines and not many errors. By hand: a constant of one, with two points of which the second, held above,
/// is wrong by u relatively, changes what lies above it by u.
#[test]
fn errors_of_points_go_together() {
    let rate = 1000.0;
    let values: Vec<f64> =
        (0..1000).map(|i| (0.2 * std::f64::consts::TAU * f64::from(i)).cos()).collect();
    let signal = Signal { values, rate, start: 0.0 };
    let mut of = CalibratedResponse {
        frequencies: vec![50.0, 100.0],
        coordinates: Coordinates::Polar,
        values: vec![[4.0, 0.0], [4.0, 0.0]],
        errors: vec![PointError { first: 1, changes: vec![[0.04, 0.0]] }],
        shared: Errors::OfPoints,
        beyond: [None, None],
    };
    let refused = corrected(&step(LineResponse::Calibrated(of.clone())), &signal, ("a", 1, 0));
    assert!(refused.unwrap_err().contains("\"below\": \"hold\""));
    of.beyond = [Some(Beyond::Hold); 2];
    let found = |of: &CalibratedResponse| {
        corrected(&step(LineResponse::Calibrated(of.clone())), &signal, ("a", 1, 0)).unwrap()
    };
    // the line at 200 Hz, of amplitude 1/4, is wrong by 1 %
    let u = found(&of).standard_uncertainties;
    for (at, u) in u.iter().enumerate() {
        let x = 0.25 * (0.2 * std::f64::consts::TAU * at as f64).cos();
        assert!((u - 0.01 * x.abs()).abs() < 1e-9, "{at}: {u} {x}");
    }
    // one line alone is the same error either way: its phase has no error
    of.shared = Errors::OfLines;
    let apart = found(&of).standard_uncertainties;
    assert!(u.iter().zip(&apart).all(|(u, apart)| (u - apart).abs() < 1e-9));
    // cut: nothing is left
    of.beyond = [Some(Beyond::Hold), Some(Beyond::Cut)];
    assert!(found(&of).signal.values.iter().all(|x| x.abs() < 1e-12));
}

/// A pulse whose spectrum is known: the low-pass takes no more away than the bound says, and the proposed cut-off is
/// the one with the least sum among its neighbours.
#[test]
fn truncation_is_bounded() {
    let (rate, samples) = (50_000.0, 2000);
    let truth = shock(rate, samples);
    let noise = normals(5, "truncation", samples);
    for cutoff in [Cutoff::Stated(1500.0), Cutoff::Proposed] {
        let values = truth.iter().zip(&noise).map(|(x, z)| x + 0.02 * z).collect();
        let signal = Signal { values, rate, start: 0.0 };
        let of = WaveformStep {
            low_pass: Some(LowPass { cutoff, order: 2, delay: None }),
            truncation: Truncation::Decay { from: 1000.0, power: 3.0 },
            noise: QuietPart::Stated(0.02),
            ..step(LineResponse::Flat)
        };
        let found = corrected(&of, &signal, ("a", 1, 0)).unwrap();
        let of_source = |source| found.sources.iter().find(|of| of.0 == source).unwrap().1;
        let bound = 3f64.sqrt() * of_source(WaveformSource::Truncation);
        let by_noise = of_source(WaveformSource::Noise);
        let errors = found.signal.values.iter().zip(&truth).map(|(x, truth)| (x - truth).abs());
        let most = errors.fold(0.0, f64::max);
        assert!(most < bound + 5.0 * by_noise && most > 0.05 * bound, "{most} {bound} {by_noise}");
        if cutoff == Cutoff::Proposed {
            let hertz = found.cutoff.unwrap();
            let cost = |hertz| {
                let low_pass = LowPass { cutoff: Cutoff::Stated(hertz), order: 2, delay: None };
                let of = WaveformStep { low_pass: Some(low_pass), ..of.clone() };
                corrected(&of, &signal, ("a", 1, 0)).unwrap().standard_uncertainties[0]
            };
            assert!(
                cost(hertz) <= cost(1.2 * hertz) && cost(hertz) <= cost(hertz / 1.2),
                "{hertz}"
            );
        }
    }
}

/// A baseline of 100 white values: the integral over the whole record of 1000 has the variance of the sum of its noise
/// and of 1000 times the error of the mean of the first 100, which are part of the record: by hand, with unit variance
/// the sum over the 900 others less 9 times that over the 100: 900 + 81*100. The stated one takes both as independent:
/// 1000 + 1000^2/100, larger by 22 %.
#[test]
fn a_baseline_is_taken_off_with_its_error() {
    let rate = 1000.0;
    let noise = normals(9, "baseline", 1000);
    let values = noise.iter().map(|z| 5.0 + 0.1 * z).collect();
    let signal = Signal { values, rate, start: 0.0 };
    let of = WaveformStep {
        noise: QuietPart::Stated(0.1),
        baseline: Some([0.0, 0.099]),
        quantities: vec![("sum".to_owned(), WaveformQuantity::Integral { between: None })],
        ..step(LineResponse::Flat)
    };
    let found = corrected(&of, &signal, ("a", 1, 1000)).unwrap();
    let mean = signal.values[..100].iter().sum::<f64>() / 100.0;
    assert!((found.signal.values[500] - (signal.values[500] - mean)).abs() < 1e-12);
    let u = found.quantities[0].standard_uncertainty();
    // the trapezoids leave half of both ends out: 998.5 of 1000
    let expected = 0.1 * (998.5 + 999.0_f64 * 999.0 / 100.0).sqrt() / rate;
    assert!((u / expected - 1.0).abs() < 1e-3, "{u} {expected}");
    // 1000 trials: 2.2 %, four of these
    let drawn = &found.quantities[0].trials;
    let centre = drawn.iter().sum::<f64>() / 1000.0;
    let spread = (drawn.iter().map(|v| (v - centre) * (v - centre)).sum::<f64>() / 999.0).sqrt();
    assert!((spread / u - 1.0).abs() < 0.09, "{spread} {u}");
}
