//! Fits against independent solutions of the same least-squares problem.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::simulated::Bench;
use crate::frequency::estimate;
use crate::{Tone, ToneDesign};

/// The residuals' design matrix by the standard library's functions, solved by singular values.
fn by_singular_values(values: &[f64], cycles: &[f64]) -> Vec<f64> {
    let rows = values.len();
    let middle = (rows as f64 - 1.0) / 2.0;
    let matrix = DMatrix::from_fn(rows, 2 * cycles.len() + 1, |i, j| {
        let angle = |k: usize| 2.0 * PI * cycles[k] * (i as f64 - middle);
        match j {
            0 => 1.0,
            j if j % 2 == 1 => angle(j / 2).cos(),
            j => angle(j / 2 - 1).sin(),
        }
    });
    let solution = matrix.svd(true, true).solve(&DVector::from_column_slice(values), 1e-14);
    solution.unwrap().iter().copied().collect()
}

#[test]
fn fits_are_those_of_the_singular_value_decomposition() {
    for (hertz, samples, offset) in [(10.3, 2000, 0.7), (10.07, 170, 9.81), (241.3, 1001, -3e4)] {
        let bench = Bench { hertz, samples, offset, ..Bench::default() };
        let mut held = bench.values(3);
        let cycles = [hertz / bench.rate, 2.0 * hertz / bench.rate, 0.3711];
        let tone = |(number, cycles): (usize, &f64)| Tone {
            cycles: *cycles,
            fundamental: number,
            multiple: 1,
            beside: false,
        };
        let design = ToneDesign::new(cycles.iter().enumerate().map(tone).collect(), samples as u64);
        let fit = design.unwrap().fit(&mut held).unwrap().swap_remove(0);
        let expected = by_singular_values(&held.channels[0], &cycles);
        // 1e-10 of a signal of size 1, as the issue asks; of an offset of 3e4 its own rounding
        let allowed = 1e-10 + 1e-14 * offset.abs();
        assert!((fit.offset - expected[0]).abs() < allowed, "{} {}", fit.offset, expected[0]);
        for k in 0..3 {
            let (a, b) = (fit.cosines[k], fit.sines[k]);
            let close = (a - expected[2 * k + 1]).hypot(b - expected[2 * k + 2]);
            assert!(close < 1e-10, "{hertz} {k}: {close}");
        }
    }
}

/// With a drift of the level: the factors against the normal equations of columns written out here, and
/// the slope along the frequency against fits at two frequencies.
#[test]
fn fits_with_a_drift_are_those_of_the_normal_equations() {
    let (samples, cycles) = (301_u64, [0.0113, 0.0371]);
    let fundamental = |cycles: [f64; 2]| -> Vec<Tone> {
        let tone = |(fundamental, cycles)| Tone { cycles, fundamental, multiple: 1, beside: false };
        (0..).zip(cycles).map(tone).collect()
    };
    let values: Vec<f64> = (0..samples)
        .map(|i| {
            let t = i as f64;
            let noise = (i * i * 7919 % 10007) as f64 / 10007.0 - 0.5;
            9.0 + (0.07 * t).cos() + 0.3 * (0.23 * t + 1.0).sin() + (-t / 90.0).exp() + 0.1 * noise
        })
        .collect();
    let rows = samples as usize;
    let columns = DMatrix::from_fn(rows, 8, |i, j| {
        let tau = i as f64 - 150.0;
        let x = 2.0 * tau / 301.0;
        let angle = |k: usize| 2.0 * PI * cycles[k] * tau;
        match j {
            0 => 1.0,
            1 => angle(0).cos(),
            2 => angle(0).sin(),
            3 => angle(1).cos(),
            4 => angle(1).sin(),
            5 => x,
            6 => (3.0 * x * x - 1.0) / 2.0,
            _ => (5.0 * x * x * x - 3.0 * x) / 2.0,
        }
    });
    let solved = columns.svd(true, true).solve(&DVector::from_column_slice(&values), 1e-14);
    let fitted = |cycles: [f64; 2]| {
        let design = ToneDesign::with_drift(fundamental(cycles), samples, 3).unwrap();
        let fit = design.fit_values(&values);
        (design, fit)
    };
    let (design, fit) = fitted(cycles);
    let flat = |fit: &crate::ToneCoefficients| {
        let tones = fit.cosines.iter().zip(&fit.sines).flat_map(|(a, b)| [*a, *b]);
        [fit.offset].into_iter().chain(tones).chain(fit.drift.iter().copied()).collect::<Vec<f64>>()
    };
    for (own, expected) in flat(&fit).iter().zip(solved.unwrap().iter()) {
        // as without a drift
        assert!((own - expected).abs() < 1e-10, "{own} {expected}");
    }
    // of a signal that is the fit itself the factors move as the slope says
    let made = |cycles: [f64; 2]| {
        let design = ToneDesign::with_drift(fundamental(cycles), samples, 3).unwrap();
        let mut waves = design.waves();
        design.fill(&mut waves, 0, rows);
        waves.values(&design.at_first(&fit), rows)
    };
    let step = 1e-7;
    let [up, down] = [step, -step].map(|step| {
        let values = made([cycles[0] - step, cycles[1]]);
        flat(&design.fit_values(&values))
    });
    let slope = flat(&design.slope(&fit, 0));
    for ((up, down), slope) in up.iter().zip(&down).zip(slope) {
        let differences = (up - down) / (2.0 * step);
        // rounding of 1e-14 over the step, and the third derivative: (2 pi 150)^3 step^2
        assert!((differences - slope).abs() < 1e-4, "{differences} {slope}");
    }
}

/// Three- and four-parameter fits against those of numpy and scipy (tests/data/sine_fits.csv says how
/// they were made).
#[test]
fn fits_are_those_of_scipy() {
    let text = include_str!("../../tests/data/sine_fits.csv");
    let mut checked = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let (cycles, samples) = (numbers[0], numbers[1] as u64);
        let value = |i: u64| {
            let angle = 2.0 * PI * cycles * i as f64;
            let noise = (i * i * 7919 % 10007) as f64 / 10007.0 - 0.5;
            let value = 0.7 + 1.25 * (angle + 0.4).cos() + 0.03 * (2.0 * angle - 1.0).cos();
            (1e5 * (value + 0.01 * noise)).round() / 1e5
        };
        let mut held = crate::InMemorySamples { channels: vec![(0..samples).map(value).collect()] };
        let found = estimate(&mut held, Some(cycles * 1.0001), &[1, 2]).unwrap();
        // double precision of phases over the record: 1e-10 of a period over all samples
        assert!((found.cycles - numbers[7]).abs() * (samples as f64) < 1e-10, "{line}");
        assert!((found.variance / numbers[13] - 1.0).abs() < 1e-6, "{line}");
        for (cycles, expected) in [(cycles, &numbers[2..7]), (found.cycles, &numbers[8..13])] {
            let tone = |multiple: u32| Tone {
                cycles: cycles * f64::from(multiple),
                fundamental: 0,
                multiple,
                beside: false,
            };
            let design = ToneDesign::new(vec![tone(1), tone(2)], samples).unwrap();
            let fit = design.fit(&mut held).unwrap().swap_remove(0);
            let own = [fit.offset, fit.cosines[0], fit.sines[0], fit.cosines[1], fit.sines[1]];
            for (own, expected) in own.iter().zip(expected) {
                // the 1e-10
                assert!((own - expected).abs() < 1e-10, "{own} {expected}: {line}");
            }
        }
        checked += 1;
    }
    assert_eq!(checked, 4);
}
