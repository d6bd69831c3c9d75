//! Verdicts by simulation: sets of readings from fixed streams.

use super::*;
use gumption_engine::distribution::{
    Arcsine, Exponential, Rectangular, StudentT, Trapezoidal, Triangular,
};

/// Readings of a distribution, each set from a stream of its own.
fn readings(of: &Distribution, set: usize, count: usize) -> Vec<f64> {
    let mut uniform = [0.0; BLOCK];
    StreamKey::new(7, "population").block(set as u64).uniform(&mut uniform);
    uniform[..count].iter().map(|u| of.quantile(*u)).collect()
}

/// Verdicts on so many sets of 20 readings each.
fn verdicts(stated: &Distribution, population: &Distribution, sets: usize) -> Vec<EvidenceVerdict> {
    let stated = Arc::new(stated.clone());
    let of = |set| agreement(0, &stated, &readings(population, set, 20)).unwrap().verdict;
    (0..sets).map(of).collect()
}

fn share(verdicts: &[EvidenceVerdict], of: impl Fn(EvidenceVerdict) -> bool) -> f64 {
    verdicts.iter().filter(|verdict| of(**verdict)).count() as f64 / verdicts.len() as f64
}

/// A shape with half-widths (or standard deviations) 1, 2 and 1/2.
fn widths() -> Vec<[Distribution; 3]> {
    let sizes = [1.0, 2.0, 0.5];
    vec![
        sizes.map(|w| Rectangular::new(35.0, w).unwrap().into()),
        sizes.map(|w| Triangular::new(35.0, w).unwrap().into()),
        sizes.map(|w| Arcsine::new(35.0, w).unwrap().into()),
        sizes.map(|w| Trapezoidal::new(35.0, w, 0.5).unwrap().into()),
        sizes.map(|w| Normal::new(35.0, w).unwrap().into()),
    ]
}

/// Twenty readings of a population twice as wide are called too narrow in at least 90 % of 1000
/// sets, and no more than 5 % of the sets of the stated population get a verdict that they do not
/// deserve, whatever the verdict. The rates themselves are 98 % and more, and below 4 % (a normal
/// distribution: 2.5 % + 0.5 % + 1 % less what they share), 2 standard deviations of the count away.
#[test]
fn power_and_false_verdicts() {
    for [stated, wider, narrower] in widths() {
        let name = stated.name();
        let power = share(&verdicts(&stated, &wider, 1000), |v| v == EvidenceVerdict::TooNarrow);
        assert!(power >= 0.9, "{name} {power}");
        let wrong = share(&verdicts(&stated, &stated, 1000), |v| v != EvidenceVerdict::Consistent);
        assert!(wrong <= 0.05, "{name} {wrong}");
        // half as wide is seen in most sets as well
        let too_wide =
            share(&verdicts(&stated, &narrower, 1000), |v| v == EvidenceVerdict::TooWide);
        assert!(too_wide >= 0.6, "{name} {too_wide}");
    }
}

/// Shapes whose widths are compared with simulated sets, which takes long: no more than 6 % false
/// verdicts, where 4 % are expected, two standard deviations of a count of 16 in 400.
#[test]
fn simulated_widths() {
    let shapes: [Distribution; 2] =
        [StudentT::new(1.0, 2.0, 5.0).unwrap().into(), Exponential::new(3.0).unwrap().into()];
    for stated in shapes {
        let wrong = share(&verdicts(&stated, &stated, 400), |v| v != EvidenceVerdict::Consistent);
        assert!(wrong <= 0.06, "{} {wrong}", stated.name());
    }
}

/// The chi-squared distribution with 20 degrees of freedom has the quantiles 9.591 and 34.170 at
/// 2.5 % and 97.5 % (tables), to five digits.
#[test]
fn supported_standard_deviation() {
    let stated: Arc<Distribution> = Arc::new(Normal::new(1.0, 0.5).unwrap().into());
    // deviations of +-2: the root mean square is 2
    let values: Vec<f64> = (0..20).map(|i| if i % 2 == 0 { 3.0 } else { -1.0 }).collect();
    let found = agreement(3, &stated, &values).unwrap();
    assert_eq!((found.variable, found.readings, found.supported.parameter), (3, 20, "std"));
    assert!((found.supported.estimate - 2.0).abs() < 1e-12);
    let expected = [2.0 * (20.0f64 / 34.170).sqrt(), 2.0 * (20.0f64 / 9.591).sqrt()];
    for (got, expected) in found.supported.interval.iter().zip(expected) {
        assert!((got / expected - 1.0).abs() < 5e-5, "{got} {expected}");
    }
    assert_eq!(found.verdict, EvidenceVerdict::TooNarrow);
}

/// The largest of n deviations from a rectangle's middle is below t with probability t^n.
#[test]
fn supported_half_width() {
    let stated: Arc<Distribution> = Arc::new(Rectangular::new(35.0, 0.1).unwrap().into());
    let mut values = vec![35.0; 19];
    values.push(35.09);
    let found = agreement(0, &stated, &values).unwrap().supported;
    assert_eq!(found.parameter, "half_width");
    let expected = [0.09, 0.09 * 0.05f64.powf(-0.05)];
    assert!((found.interval[0] - expected[0]).abs() < 1e-12);
    assert!((found.interval[1] - expected[1]).abs() < 1e-12);
    assert!((found.estimate - 0.09 * 2f64.powf(0.05)).abs() < 1e-12);
}

#[test]
fn the_first_verdict_that_holds() {
    let stated: Arc<Distribution> = Arc::new(Rectangular::new(35.0, 0.1).unwrap().into());
    let verdict = |values: &[f64]| agreement(0, &stated, values).unwrap().verdict;
    assert_eq!(verdict(&[36.0, 34.0, 35.0, 35.0]), EvidenceVerdict::TooFew);
    let mut values: Vec<f64> = (0..12).map(|i| 34.905 + 0.0172 * f64::from(i)).collect();
    assert_eq!(verdict(&values), EvidenceVerdict::Consistent);
    // the limit itself is inside
    values.push(35.0 + 0.1);
    assert_eq!(verdict(&values), EvidenceVerdict::Consistent);
    values.push(35.1001);
    let found = agreement(0, &stated, &values).unwrap();
    assert_eq!((found.verdict, found.outside, found.p_value), (EvidenceVerdict::TooNarrow, 1, 0.0));
    // all near the limits: the width is right, the shape is not
    let ends: Vec<f64> = (0..20).map(|i| 35.0 + if i % 2 == 0 { 0.099 } else { -0.099 }).collect();
    assert_eq!(verdict(&ends), EvidenceVerdict::WrongShape);
    assert!(agreement(0, &stated, &[]).is_none());
}

/// Six readings about 0.021 of what is stated as 0 +- 0.01, and seven about 0.015 of a normal
/// distribution about 0.
#[test]
fn readings_together_off_the_centre_are_an_offset() {
    let stated = Arc::new(Rectangular::new(0.0, 0.01).unwrap().into());
    let readings = [0.021, 0.0208, 0.0213, 0.0209, 0.0211, 0.0212];
    let found = agreement(0, &stated, &readings).unwrap();
    assert_eq!(found.verdict, EvidenceVerdict::TooNarrow);
    let offset = found.offset.unwrap();
    // sum 0.1263, mean 0.02105; deviations in 1e-5: -5, -25, 25, -15, 5, 15; squares 1750; /5 = 350
    assert!((offset.mean - 0.02105).abs() < 1e-12, "{offset:?}");
    assert!((offset.standard_deviation - 1e-5 * 350_f64.sqrt()).abs() < 1e-12, "{offset:?}");
    let error = 1e-5 * (350.0_f64 / 6.0).sqrt();
    assert!((offset.standard_error - error).abs() < 1e-12, "{offset:?}");
    assert!((offset.difference() - 0.02105).abs() < 1e-12, "{offset:?}");

    let stated = Arc::new(Normal::new(0.0, 0.01).unwrap().into());
    let readings = [0.0150, 0.0152, 0.0148, 0.0151, 0.0149, 0.0150, 0.0150];
    let found = agreement(0, &stated, &readings).unwrap();
    assert_eq!(found.verdict, EvidenceVerdict::WrongShape);
    assert!((found.offset.unwrap().mean - 0.015).abs() < 1e-12);

    // what scatters about the centre, or as widely as it is off, is none
    let stated = Arc::new(Rectangular::new(0.0, 0.01).unwrap().into());
    for readings in
        [[-0.02, 0.021, 0.001, -0.004, 0.015, -0.013], [0.01, 0.03, 0.02, 0.005, 0.035, 0.02]]
    {
        let found = agreement(0, &stated, &readings).unwrap();
        assert_eq!((found.verdict, found.offset), (EvidenceVerdict::TooNarrow, None));
    }
    // nor what is consistent: the mean of five is off by 0.5 u
    let stated = Arc::new(Normal::new(0.0, 0.01).unwrap().into());
    let found = agreement(0, &stated, &[0.004, -0.009, 0.012, 0.007, 0.009]).unwrap();
    assert_eq!((found.verdict, found.offset), (EvidenceVerdict::Consistent, None));
}

/// Readings of exactly the stated distribution, as a display rounds them: of 400 sets of 20 each the
/// shape is blamed in one of a hundred, so in more than 5 % with a probability below 1e-8.
#[test]
fn rounded_readings_are_no_wrong_shape() {
    let arcsine = || Arcsine::new(35.0, 0.1).unwrap().into();
    let rectangular = || Rectangular::new(35.0, 0.1).unwrap().into();
    let triangular = || Triangular::new(35.0, 0.1).unwrap().into();
    for (stated, digit) in [
        (rectangular(), 0.01),
        (rectangular(), 0.05),
        (arcsine(), 0.01),
        (arcsine(), 1e-4),
        (arcsine(), 1e-6),
        (triangular(), 0.01),
    ] {
        let stated: Distribution = stated;
        let stated = Arc::new(stated);
        let blamed = (0..400).filter(|set| {
            let mut readings = readings(&stated, *set, 20);
            readings.iter_mut().for_each(|x| *x = (*x / digit).round() * digit);
            let found = agreement(0, &stated, &readings).unwrap();
            found.verdict == EvidenceVerdict::WrongShape
        });
        let blamed = blamed.count();
        assert!(blamed <= 20, "{digit}: {blamed}");
    }
    let limits = [35.02, 34.93, 35.06, 34.99, 34.96, 35.01, 35.10, 34.90, 35.04, 34.97];
    let found = agreement(0, &Arc::new(rectangular()), &limits).unwrap();
    assert_eq!(found.verdict, EvidenceVerdict::Consistent);
    assert!(found.p_value > 0.5);
}

#[test]
fn last_digits() {
    for (readings, expected) in [
        (vec![35.02, 34.9], 0.01),
        (vec![1200.0, 3400.0], 100.0),
        (vec![0.0, 0.5], 0.1),
        (vec![-1.25e-6, 3e-6], 1e-8),
        ((0..12).map(|i| 35.0 + 0.05 * f64::from(i * i)).collect(), 0.05),
    ] {
        let found = last_digit(&readings);
        assert!((found / expected - 1.0).abs() < 1e-12, "{readings:?}: {found}");
    }
    // of all digits hardly anything is left
    assert!(last_digit(&[1.234_567_890_123, 1.0]) < 2e-8);
}
