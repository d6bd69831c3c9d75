use super::super::{BLOCK, Normal, Readings, Rectangular, StreamKey, StudentT, Triangular};
use super::*;
use crate::number::{COLUMN, Column};

fn correlation(first: usize, second: usize, coefficient: f64) -> Correlation {
    Correlation { first, second, coefficient }
}

/// `blocks` blocks of draws of each quantity.
fn draws(
    distributions: &[Distribution],
    joint: &Arc<Joint>,
    seed: u64,
    blocks: u64,
) -> Vec<Vec<f64>> {
    let n = distributions.len();
    let keys: Vec<StreamKey> =
        (0..n).map(|i| StreamKey::new(seed, &format!("quantity {i}"))).collect();
    let register: Vec<usize> = (0..n).collect();
    let mut registers = vec![Column::ZERO; n];
    let mut values = vec![Vec::new(); n];
    let varying = Varying::all(distributions, joint);
    for block in 0..blocks {
        let mut draws = Draws::new(&varying, &keys, crate::number::CodePath::best(), block);
        for _ in 0..BLOCK / COLUMN {
            draws.column(&mut registers, &register, &vec![true; n]);
            for (values, column) in values.iter_mut().zip(&registers) {
                values.extend(column.0);
            }
        }
    }
    values
}

/// The mean of a product and its standard error.
fn product(a: &[f64], b: &[f64]) -> (f64, f64) {
    let n = a.len() as f64;
    let mean = a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>() / n;
    let square = a.iter().zip(b).map(|(x, y)| (x * y - mean).powi(2)).sum::<f64>() / n;
    (mean, (square / n).sqrt())
}

/// The values less the distribution's mean, in its standard deviations.
fn standardized(values: &[f64], distribution: &Distribution) -> Vec<f64> {
    let (mean, std) = (distribution.mean(), distribution.standard_deviation());
    values.iter().map(|v| (v - mean) / std).collect()
}

fn rectangular() -> Distribution {
    Rectangular::new(5.0, 0.25).unwrap().into()
}

fn triangular(mode: f64) -> Distribution {
    Triangular::between(0.0, 1.0, Some(mode)).unwrap().into()
}

fn normal() -> Distribution {
    Normal::new(-2.0, 3.0).unwrap().into()
}

fn t(dof: f64) -> Distribution {
    StudentT::new(1e3, 0.1, dof).unwrap().into()
}

fn readings(values: &[f64]) -> Readings {
    Readings::new(values.to_vec()).unwrap()
}

/// Twelve pairs of shapes, at 1,024,000 draws each, have the declared coefficient. The mean of the
/// product of the standardized quantities is compared, whose standard error comes from the draws;
/// five of them leave a false failure rate of 6e-7 a pair, 7e-6 for all.
#[test]
fn drawn_coefficients_are_the_declared_ones() {
    let certificate: Distribution = Normal::with_dof(10.0, 0.1, 12.0).unwrap().into();
    let measured: Distribution =
        readings(&[1.0, 4.0, 2.0, 8.0, 5.0, 7.0, 1.5, 2.5, 3.5, 6.0, 6.5, 0.5, 4.5]).into();
    let pairs = [
        (rectangular(), rectangular(), 0.8),
        (rectangular(), rectangular(), -0.99),
        (rectangular(), normal(), 0.97),
        (rectangular(), triangular(0.5), -0.6),
        (triangular(0.5), normal(), 0.8),
        (triangular(0.1), triangular(0.9), 0.9),
        (triangular(0.0), triangular(0.0), -0.8),
        (t(9.0), normal(), 0.5),
        (t(9.0), rectangular(), -0.9),
        (t(30.0), t(10.0), 0.95),
        (certificate.clone(), triangular(1.0), 0.3),
        (measured, certificate, -0.7),
    ];
    for (number, (a, b, coefficient)) in pairs.into_iter().enumerate() {
        let both = [a, b];
        let joint = Joint::new(&both, &[correlation(0, 1, coefficient)]).unwrap();
        assert_eq!(joint.copula, [0, 1]);
        let values = draws(&both, &joint, number as u64, 300);
        let [x, y] = [0, 1].map(|q| standardized(&values[q], &both[q]));
        let (drawn, error) = product(&x, &y);
        assert!(
            (drawn - coefficient).abs() < 5.0 * error,
            "{} and {}: {drawn} not {coefficient}, error {error}",
            both[0].name(),
            both[1].name()
        );
        // each keeps its own distribution: Kolmogorov-Smirnov, 3e-6 a quantity
        for (mut values, distribution) in values.into_iter().zip(&both) {
            values.sort_unstable_by(f64::total_cmp);
            let n = values.len() as f64;
            let distance = (1..1000)
                .map(|i| {
                    let p = f64::from(i) / 1000.0;
                    let quantile = distribution.quantile(p);
                    (values.partition_point(|&v| v <= quantile) as f64 / n - p).abs()
                })
                .fold(0.0, f64::max);
            assert!(distance * n.sqrt() < 2.6, "{}: {distance}", distribution.name());
        }
    }
}

/// Coefficients 1 and -1 of two quantities of the same shape make them multiples of each other.
#[test]
fn full_correlation_is_exact() {
    for (coefficient, sign) in [(1.0, 1.0), (-1.0, -1.0)] {
        let both = [rectangular(), Rectangular::new(0.0, 2.0).unwrap().into()];
        let joint = Joint::new(&both, &[correlation(0, 1, coefficient)]).unwrap();
        let values = draws(&both, &joint, 1, 10);
        let [x, y] = [0, 1].map(|q| standardized(&values[q], &both[q]));
        let worst = x.iter().zip(&y).map(|(x, y)| (x - sign * y).abs()).fold(0.0, f64::max);
        // the rounding of values about 5 in standard deviations of 0.14
        assert!(worst < 1e-13, "{worst}");
    }
}

/// A coefficient that no two quantities of the shapes can have is refused with the range: for a
/// rectangular and a normal quantity sqrt(3 / pi) = 0.97720..., and whatever is printed is accepted.
#[test]
fn coefficients_out_of_reach_are_refused() {
    let both = [rectangular(), normal()];
    let error = Joint::new(&both, &[correlation(0, 1, 0.98)]).unwrap_err();
    let text = error.describe(&|q| ["a", "b"][q].to_owned());
    assert!(text.contains("a and b is 0.98") && text.contains("-0.9772 to 0.9772"), "{text}");
    assert!(Joint::new(&both, &[correlation(0, 1, 0.9772)]).is_ok());
    assert!(Joint::new(&both, &[correlation(0, 1, -0.978)]).is_err());
    let skew = [triangular(0.0), triangular(1.0)];
    assert!(matches!(
        Joint::new(&skew, &[correlation(0, 1, 1.0)]),
        Err(CorrelationError::OutOfReach { attainable: [least, most], .. })
            if (0.8..0.95).contains(&most) && least == -1.0
    ));
}

#[test]
fn quantities_without_variance_are_refused() {
    for dof in [0.5, 1.0, 2.0] {
        let both = [normal(), Normal::with_dof(0.0, 1.0, dof).unwrap().into()];
        let error = Joint::new(&both, &[correlation(0, 1, 0.1)]).unwrap_err();
        assert_eq!(error, CorrelationError::NoVariance { member: 1, dof });
        assert!(error.to_string().contains(&format!("{dof} degrees of freedom")), "{error}");
        assert!(Joint::new(&both, &[correlation(0, 1, 0.0)]).is_ok());
    }
    let both = [normal(), Normal::with_dof(0.0, 1.0, 2.1).unwrap().into()];
    assert!(Joint::new(&both, &[correlation(0, 1, 0.1)]).is_ok());
}

/// A contradiction names those that make it and offers the nearest possible coefficients, which are
/// accepted as they are printed.
#[test]
fn contradictions_offer_the_nearest_possible_coefficients() {
    let four: Vec<Distribution> = (0..4).map(|_| normal()).collect();
    let name = |q: usize| ["a", "b", "c", "d"][q].to_owned();
    let [ab, ac, bc] = [0.9, 0.9, -0.5].map(|r| move |a, b| correlation(a, b, r));
    let declared = [ab(0, 2), ac(0, 3), bc(2, 3), correlation(0, 1, 0.1)];
    let error = Joint::new(&four, &declared).unwrap_err();
    let CorrelationError::Contradiction { members, nearest, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!(members, &[0, 2, 3]);
    let text = error.describe(&name);
    assert!(text.contains("of a, c, d contradict") && text.contains("a-c 0."), "{text}");
    // printed with two decimals
    let rounded = |r: f64| (r * 100.0).round() / 100.0;
    let mut possible = declared.to_vec();
    for near in nearest {
        let same = |c: &&mut Correlation| (c.first, c.second) == (near.first, near.second);
        match possible.iter_mut().find(same) {
            Some(c) => c.coefficient = rounded(near.coefficient),
            None => possible.push(correlation(near.first, near.second, rounded(near.coefficient))),
        }
    }
    assert!(Joint::new(&four, &possible).is_ok(), "{possible:?}");
}

/// What rounding to the printed decimals explains is accepted and said; what it does not is not.
/// 0.9, 0.9 and 0.62 is the limit of what is possible.
#[test]
fn only_rounding_is_forgiven() {
    let three: Vec<Distribution> = (0..3).map(|_| normal()).collect();
    let joint = |bc: f64| {
        let declared = [correlation(0, 1, 0.9), correlation(0, 2, 0.9), correlation(1, 2, bc)];
        Joint::new(&three, &declared)
    };
    assert!(!joint(0.63).unwrap().rounded);
    assert!(joint(0.61).unwrap().rounded);
    assert!(joint(0.5).is_err());
    // with three decimals less is rounding
    assert!(joint(0.619).unwrap().rounded);
    assert!(joint(0.612).is_err());
}

/// Three rectangular quantities of which each pair can have its coefficient: fitted, the normals'
/// matrix is at its limit before theirs is. -0.5 thrice is the limit for any three quantities, and
/// a Gaussian copula reaches (6 / pi) asin(-1 / 4) = -0.4826 only.
#[test]
fn what_a_copula_cannot_give_is_refused() {
    let three: Vec<Distribution> = (0..3).map(|_| rectangular()).collect();
    let joint = |r: f64| {
        let declared = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| correlation(a, b, r));
        Joint::new(&three, &declared)
    };
    assert_eq!(joint(-0.48).unwrap().adjusted, 0.0);
    let near = joint(-0.485).unwrap_err();
    assert!(near.to_string().contains("quantity 1-quantity 2 -0.483"), "{near}");
    let adjusted = joint(-0.483).unwrap().adjusted;
    // 0.483 - 0.482584
    assert!((adjusted - 0.000_416).abs() < 1e-6, "{adjusted}");
    assert!(matches!(joint(-0.5), Err(CorrelationError::BeyondCopula { .. })));
}

fn ensemble() -> Vec<Distribution> {
    let values = [
        [5.1, 5.4, 4.9, 5.6, 5.0, 5.3, 4.8, 5.5, 5.2, 5.7, 4.7, 5.0],
        [3.0, 3.2, 2.9, 3.1, 3.0, 3.3, 2.8, 3.2, 3.0, 3.4, 2.9, 2.9],
        [7.0, 6.1, 7.2, 6.5, 7.4, 6.0, 7.1, 6.2, 6.9, 6.3, 6.8, 7.5],
    ];
    values.iter().map(|v| readings(v).paired(3).unwrap().into()).collect()
}

/// Moments of the multivariate t of JCGM 102, 5.3, at 1,024,000 draws: covariance
/// (n - N)/(n - N - 2) S/n with the divisor n - N in S, and the mean of x^2 y^2 of a spherical t,
/// which tells it from a copula: nu^2 / ((nu - 2)(nu - 4)) uncorrelated, against the product of the
/// variances. With n - N = 9 the eighth moments exist, so the standard errors do; five of them
/// leave 6e-7 a figure, 1e-5 for all.
#[test]
fn paired_readings_are_a_multivariate_t() {
    let distributions = ensemble();
    let joint = Joint::new(&distributions, &[]).unwrap();
    let values = draws(&distributions, &joint, 5, 1000);
    let (n, dof) = (12.0, 9.0);
    let samples: Vec<&[f64]> = distributions
        .iter()
        .map(|d| match d {
            Distribution::Readings(readings) => readings.values(),
            _ => &[],
        })
        .collect();
    let centred = |values: &[f64], mean: f64| values.iter().map(|v| v - mean).collect::<Vec<_>>();
    let (mut whitened, mut variances) = (Vec::new(), Vec::new());
    for i in 0..3 {
        for j in 0..=i {
            let mean = |q: usize| distributions[q].mean();
            let (a, b) = (centred(samples[i], mean(i)), centred(samples[j], mean(j)));
            let exact = a.iter().zip(&b).map(|(x, y)| x * y).sum::<f64>() / (dof - 2.0) / n;
            let (x, y) = (centred(&values[i], mean(i)), centred(&values[j], mean(j)));
            let (found, error) = product(&x, &y);
            assert!((found - exact).abs() < 5.0 * error, "{i}, {j}: {found} not {exact}");
            if i == j {
                whitened.push(x);
                variances.push(exact);
            }
        }
        let deviation = distributions[i].standard_deviation();
        assert!((deviation * deviation / variances[i] - 1.0).abs() < 1e-12);
    }
    // the second less its regression on the first is uncorrelated with it
    let (x, y) = (&whitened[0], &whitened[1]);
    let r = joint.groups[0].factor[packed::triangle(1)];
    let slope = r * (variances[1] / variances[0]).sqrt();
    let rest: Vec<f64> = y.iter().zip(x).map(|(y, x)| (y - slope * x).powi(2)).collect();
    let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
    let (found, error) = product(&squares, &rest);
    let scale = (dof - 2.0) / (dof - 4.0);
    let exact = variances[0] * variances[1] * (1.0 - r * r) * scale;
    assert!((found - exact).abs() < 5.0 * error, "{found} not {exact}, error {error}");
}

#[test]
fn paired_readings_that_cannot_be_are_refused() {
    let short = readings(&[1.0, 2.0, 3.0, 5.0]);
    assert!(!short.clone().paired(2).unwrap().have_covariance());
    let text = short.clone().paired(4).unwrap_err().to_string();
    assert!(text.contains("at least 7"), "{text}");
    let longer = readings(&[1.0, 2.0, 3.0, 5.0, 4.0]).paired(2).unwrap();
    assert!(longer.have_covariance());
    let alone = [Distribution::from(longer.clone()), short.into()];
    assert!(matches!(
        Joint::new(&alone, &[]),
        Err(CorrelationError::Unpaired { member: 0, count: 1 })
    ));
    let mut three = vec![Distribution::from(longer.clone()), longer.into(), normal()];
    assert!(Joint::new(&three, &[]).is_ok());
    assert!(matches!(
        Joint::new(&three, &[correlation(0, 1, 0.5)]),
        Err(CorrelationError::GivenByReadings { paired: true, .. })
    ));
    assert!(matches!(
        Joint::new(&three, &[correlation(1, 2, 0.5)]),
        Err(CorrelationError::GivenByReadings { member: 1, other: 2, paired: false })
    ));
    three.remove(1);
    assert!(matches!(Joint::new(&three, &[]), Err(CorrelationError::Unpaired { .. })));
}

/// Readings that are exact multiples of each other are drawn so.
#[test]
fn fully_correlated_readings_stay_together() {
    let values = [1.0, 2.0, 4.0, 8.0, 3.0, 5.0];
    let doubled: Vec<f64> = values.iter().map(|v| 2.0 * v).collect();
    let both: Vec<Distribution> =
        [&values[..], &doubled].iter().map(|v| readings(v).paired(2).unwrap().into()).collect();
    let joint = Joint::new(&both, &[]).unwrap();
    let drawn = draws(&both, &joint, 1, 10);
    for (x, y) in drawn[0].iter().zip(&drawn[1]) {
        assert!((2.0 * x - y).abs() < 1e-7 * (1.0 + y.abs()), "{x}, {y}");
    }
}

/// Rows share the fit when their linked quantities are the same.
#[test]
fn rows_share_fits() {
    let shared = |shape: Distribution| Arc::new(shape);
    let row = |at: f64| {
        let shapes: [Distribution; 3] =
            [Rectangular::new(at, 0.1 * at).unwrap().into(), t(at + 3.0), normal()];
        shapes.map(shared)
    };
    let fits = Fits::default();
    let joint = |row: &[Arc<Distribution>], last: f64| {
        let declared = [correlation(0, 2, 0.5), correlation(1, 2, last)];
        fits.joint(row, &declared).unwrap()
    };
    let first = joint(&row(1.0), 0.0);
    // location and width do not matter, nor does a quantity that nothing is said of
    let mut moved = row(1.0);
    moved[0] = shared(Rectangular::new(-3.0, 0.2).unwrap().into());
    moved[2] = shared(Normal::new(7.0, 0.5).unwrap().into());
    assert!(Arc::ptr_eq(&first, &joint(&moved, 0.0)));
    // other degrees of freedom do, and other coefficients; what was found is kept
    let second = joint(&row(2.0), 0.0);
    assert!(!Arc::ptr_eq(&first, &second));
    assert!(Arc::ptr_eq(&first, &joint(&row(1.0), 0.0)));
    assert!(!Arc::ptr_eq(&first, &joint(&row(1.0), 0.1)));
}

/// Among many quantities one coefficient that is quite wrong is not taken for rounding, and the
/// quantities at fault are named: with 0.3 to everybody else and 0.3 between those, two quantities
/// can have coefficients from 2 0.3^2 n/(1 + 0.3 (n - 1)) - 1 on, n = 38 being the others. A matrix
/// of rounded coefficients of rank 3 is accepted.
#[test]
fn many_quantities_may_have_rounded_coefficients_but_not_a_wrong_one() {
    let n = 40;
    let quantities: Vec<Distribution> = (0..n).map(|_| normal()).collect();
    let all = |r: &dyn Fn(usize, usize) -> f64| -> Vec<Correlation> {
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        pairs.map(|(i, j)| correlation(i, j, r(i, j))).collect()
    };
    let others = (n - 2) as f64;
    let least = 2.0 * 0.09 * others / (1.0 + 0.3 * (others - 1.0)) - 1.0;
    let with = |odd: f64| {
        let coefficient = |i, j| if (i, j) == (0, 1) { odd } else { 0.3 };
        Joint::new(&quantities, &all(&coefficient))
    };
    assert!(!with(least + 1e-3).unwrap().rounded);
    let error = with(least - 0.1).unwrap_err();
    let CorrelationError::Contradiction { members, nearest, .. } = &error else {
        panic!("{error}");
    };
    assert!(members.starts_with(&[0, 1]) && members.len() > 10, "{members:?}");
    assert_eq!((nearest[0].first, nearest[0].second), (0, 1));
    let vector = |i: usize| [1.0, (i as f64).sin(), (1.7 * i as f64).cos()];
    let product = |i, j| vector(i).iter().zip(vector(j)).map(|(a, b)| a * b).sum::<f64>();
    let rounded = |i, j| {
        let r: f64 = product(i, j) / (product(i, i) * product(j, j)).sqrt();
        (100.0 * r).round() / 100.0
    };
    assert!(Joint::new(&quantities, &all(&rounded)).unwrap().rounded);
}
