//! Shortest intervals of exact and quasi-random figures against those of distribution functions that are
//! integrated over one input after the other, without characteristic functions and without points.

use crate::distribution::*;
use crate::propagate::evaluation::joint;
use crate::propagate::exact::{self, Accuracy, Noiseless, Problem, test_task as task};
use crate::propagate::quasi;
use crate::special::{self, legendre};
use crate::task::Task;

fn normal(mean: f64, std: f64) -> Distribution {
    Normal::new(mean, std).unwrap().into()
}

fn t(mean: f64, scale: f64, dof: f64) -> Distribution {
    StudentT::new(mean, scale, dof).unwrap().into()
}

fn rectangular(mean: f64, half: f64) -> Distribution {
    Rectangular::new(mean, half).unwrap().into()
}

fn arcsine(mean: f64, half: f64) -> Distribution {
    Arcsine::new(mean, half).unwrap().into()
}

fn gamma(shape: f64, rate: f64) -> Distribution {
    Gamma::new(shape, rate).unwrap().into()
}

fn triangular(lower: f64, mode: f64, upper: f64) -> Distribution {
    Triangular::between(lower, upper, Some(mode)).unwrap().into()
}

fn with<R>(task: &Task, of: impl FnOnce(&Problem<'_>) -> R) -> R {
    let row = &task.rows[0];
    let joint = joint(task, row).unwrap();
    of(&Problem { task, row, joint: &joint, output: 0, drawn_dof: f64::INFINITY })
}

fn exact_of(inputs: Vec<Distribution>, formula: &str, p: f64) -> Result<Noiseless, String> {
    with(&task(inputs, formula, p), exact::evaluate)
}

fn quasi_of(inputs: Vec<Distribution>, formula: &str, p: f64) -> Result<Noiseless, String> {
    with(&task(inputs, formula, p), quasi::evaluate)
}

fn bound(found: &Noiseless) -> f64 {
    match found.accuracy {
        Accuracy::Bound(bound) => bound,
        Accuracy::Scatter(_) => f64::NAN,
    }
}

fn length([low, high]: [f64; 2]) -> f64 {
    high - low
}

/// Values of a quantity and their weights: twenty points of Gauss in each of sixteen panels over the
/// probability, of which the outer ones are cut at two fifths again and again.
fn values(distribution: &Distribution) -> Vec<[f64; 2]> {
    let mut panels: Vec<[f64; 2]> = (1..15).map(|k| [f64::from(k) / 16.0, 1.0 / 16.0]).collect();
    let mut outer = 1.0 / 16.0;
    for _ in 0..28 {
        panels.push([0.4 * outer, 0.6 * outer]);
        panels.push([-outer, 0.6 * outer]);
        outer *= 0.4;
    }
    panels
        .into_iter()
        .flat_map(|[start, width]| legendre::nodes().map(|[x, w]| [start + width * x, width * w]))
        .map(|[p, weight]| {
            let upper = p < 0.0;
            [if upper { distribution.quantile_upper(-p) } else { distribution.quantile(p) }, weight]
        })
        .collect()
}

/// A quantity that is a shifted and scaled t with other weights: location, scale and weight of each part.
struct Mixture {
    parts: Vec<[f64; 3]>,
    dof: f64,
}

impl Mixture {
    fn at(&self, y: f64) -> [f64; 2] {
        let half = 0.5 * self.dof;
        let normal = self.dof.is_infinite();
        let constant = if normal {
            1.0 / std::f64::consts::TAU.sqrt()
        } else {
            libm::exp(libm::lgamma(half + 0.5) - libm::lgamma(half))
                / (self.dof * std::f64::consts::PI).sqrt()
        };
        let mut sums = [0.0; 2];
        for [location, scale, weight] in &self.parts {
            let z = (y - location) / scale;
            let (cdf, exponent) = if normal {
                (special::normal::cdf(z), -0.5 * z * z)
            } else {
                let log = libm::log1p(z * z / self.dof);
                (special::student::cdf(z, self.dof), -(half + 0.5) * log)
            };
            sums[0] += weight * cdf;
            sums[1] += weight * constant * libm::exp(exponent) / scale;
        }
        sums
    }

    /// By halvings until Newton's steps stay between.
    fn quantile(&self, p: f64, start: f64) -> f64 {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut y, mut far) = (start, 1.0);
        for _ in 0..200 {
            let [cdf, density] = self.at(y);
            if cdf < p {
                low = y
            } else {
                high = y
            }
            let newton = y + (p - cdf) / density;
            let next = match (low.is_finite(), high.is_finite()) {
                _ if newton > low && newton < high && (newton - y).abs() < far => newton,
                (true, true) => 0.5 * (low + high),
                _ => {
                    far *= 2.0;
                    y + far.copysign(p - cdf)
                }
            };
            if (next - y).abs() <= 1e-14 * (1.0 + y.abs()) {
                return next;
            }
            y = next;
        }
        y
    }

    fn interval(&self, below: f64, p: f64, starts: &mut [f64; 2]) -> ([f64; 2], f64) {
        *starts = [self.quantile(below, starts[0]), self.quantile(below + p, starts[1])];
        (*starts, self.at(starts[0])[1] - self.at(starts[1])[1])
    }

    /// The shortest of forty intervals, and halvings about it for the same density at both ends.
    fn shortest(&self, p: f64) -> [f64; 2] {
        let tail = 1.0 - p;
        let shares = [1e-6, 1e-4, 1e-3].into_iter().chain((1..40).map(|k| f64::from(k) / 40.0));
        let shares: Vec<f64> = shares.chain([0.999, 1.0 - 1e-4, 1.0 - 1e-6]).collect();
        let middle = self.quantile(0.5, 0.0);
        let mut starts = [middle; 2];
        let all: Vec<_> =
            shares.iter().map(|share| self.interval(share * tail, p, &mut starts)).collect();
        let best = (0..all.len()).min_by(|&a, &b| length(all[a].0).total_cmp(&length(all[b].0)));
        let best = best.unwrap();
        let mut low = shares[best.saturating_sub(1)];
        let mut high = shares[(best + 1).min(shares.len() - 1)];
        for _ in 0..46 {
            let share = 0.5 * (low + high);
            if self.interval(share * tail, p, &mut starts).1 < 0.0 {
                low = share
            } else {
                high = share
            }
        }
        self.interval(0.5 * (low + high) * tail, p, &mut starts).0
    }
}

/// Numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn new(number: u64) -> Self {
        Self(number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    /// A shape with a width of about `width`; kinks of its quantile function lie between panels.
    fn shape(&mut self, width: f64) -> Distribution {
        let share = (16.0 * self.next()).floor() / 16.0;
        match (8.0 * self.next()) as u32 {
            0 => normal(0.3, width),
            1 => rectangular(-0.2, width),
            2 => arcsine(0.1, width),
            3 => triangular(0.0, width * share, width),
            4 => gamma(1.0 + 5.0 * self.next(), 2.0 / width),
            5 => Exponential::new(0.5 * width).unwrap().into(),
            6 => Lognormal::new(width, width * (0.1 + self.next())).unwrap().into(),
            _ => t(0.0, 0.5 * width, 2.0 + (8.0 * self.next()).floor()),
        }
    }
}

/// A quantity with a t distribution of 1 to 12 degrees of freedom, one to three of them in every other
/// model, and one other shape that is narrower or wider by up to a factor of 20: as exact figures and
/// as a mixture.
fn readings_and_a_shape(number: u64) -> (Vec<Distribution>, Mixture) {
    let mut random = Random::new(number);
    let few = random.next() < 0.5;
    let dof = 1.0 + (if few { 3.0 } else { 12.0 } * random.next()).floor();
    let width = libm::exp(6.0 * (random.next() - 0.5));
    let other = random.shape(width);
    let parts = values(&other).into_iter().map(|[x, w]| [1.0 + x, 1.0, w]).collect();
    (vec![t(1.0, 1.0, dof), other], Mixture { parts, dof })
}

/// Sums of readings and one other shape: the shortest interval is never longer than the symmetric one, has
/// the probability it is for, and its ends are off by no more than is stated; 1e-9 of the length is what
/// the rule leaves that they are held against.
fn exact_study(models: u64) {
    let mut found = 0;
    for number in 0..models {
        let (inputs, mixture) = readings_and_a_shape(number);
        let p = [0.95, 0.9, 0.99, 0.9545][number as usize % 4];
        let text = format!("{number}: {inputs:?} {p}");
        let Ok(exact) = exact_of(inputs, "x0 + x1", p) else { continue };
        let shortest = exact.shortest_interval.unwrap_or_else(|| panic!("{text}: {exact:?}"));
        assert!(exact.shortest_unique, "{text}");
        assert!(length(shortest) <= length(exact.symmetric_interval), "{text}: {exact:?}");
        let right = mixture.shortest(p);
        let held = mixture.at(shortest[1])[0] - mixture.at(shortest[0])[0];
        assert!((held - p).abs() < 1e-10, "{text}: {held}");
        assert!(length(shortest) <= length(right) * (1.0 + 1e-11), "{text}: {exact:?} {right:?}");
        for (end, right) in shortest.into_iter().zip(right) {
            let allowed = bound(&exact) + 1e-9 * length(shortest);
            assert!((end - right).abs() <= allowed, "{text}: {exact:?} {right}");
        }
        found += 1;
    }
    assert!(10 * found > 9 * models, "{found} of {models}");
}

#[test]
fn exact_intervals_of_four_sums() {
    exact_study(4);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn exact_intervals_of_500_sums() {
    exact_study(500);
}

/// Inputs, a formula that is no sum of functions of them, and the distribution function: given x1 the output
/// is normal, or a t.
fn not_linear(number: u64) -> (Vec<Distribution>, &'static str, Mixture) {
    let mut random = Random::new(number);
    let width = 0.3 + random.next();
    let other = random.shape(width);
    let (mean, std) = (2.0 * random.next(), 0.2 + random.next());
    let (of_second, dof) = (0.1 + random.next(), 2.0 + (8.0 * random.next()).floor());
    type Given = fn(f64) -> [f64; 2];
    // what x0 is multiplied by, and what is added
    let (formula, factor_and_shift): (_, Given) = match (4.0 * random.next()) as u32 {
        0 => ("x0*x1", |x| [x, 0.0]),
        1 => ("x0*exp(x1/4) + sin(x1)", |x| [libm::exp(0.25 * x), libm::sin(x)]),
        2 => ("x0*(1 + x1^2) - x1", |x| [1.0 + x * x, -x]),
        _ => ("(x0 + x1)/(1 + x1^2)", |x| [1.0 / (1.0 + x * x), x / (1.0 + x * x)]),
    };
    let heavy = random.next() < 0.4 && formula != "x0*x1";
    let parts = |second: f64| {
        let part = |[x, weight]: [f64; 2]| {
            let [factor, shift] = factor_and_shift(x);
            let scale = libm::hypot(factor * std, second);
            [factor * mean + shift, scale, weight]
        };
        values(&other).into_iter().map(part).collect()
    };
    if heavy {
        let mixture = Mixture { parts: parts(0.0), dof };
        return (vec![t(mean, std, dof), other], formula, mixture);
    }
    let mixture = Mixture { parts: parts(of_second), dof: f64::INFINITY };
    let inputs = vec![normal(mean, std), other, normal(0.0, of_second)];
    let with_noise = match formula {
        "x0*x1" => "x0*x1 + x2",
        "x0*exp(x1/4) + sin(x1)" => "x0*exp(x1/4) + sin(x1) + x2",
        "x0*(1 + x1^2) - x1" => "x0*(1 + x1^2) - x1 + x2",
        _ => "(x0 + x1)/(1 + x1^2) + x2",
    };
    (inputs, with_noise, mixture)
}

/// Models that are no sums: the shortest interval is never longer than the symmetric one, has the probability
/// it is for within six standard errors of its ends, and its ends scatter about the right ones as their
/// standard errors say: the root mean square of the quotients, of 15 degrees of freedom, is 1.07.
fn quasi_study(models: u64) -> f64 {
    let mut squares = Vec::new();
    let mut refused = 0;
    for number in 0..models {
        let (inputs, formula, mixture) = not_linear(number);
        let p = [0.95, 0.9, 0.99, 0.9545][number as usize % 4];
        let text = format!("{number}: {formula} {inputs:?} {p}");
        let quasi = match quasi_of(inputs, formula, p) {
            Ok(quasi) => quasi,
            Err(why) => {
                println!("{text}: {why}");
                refused += 1;
                continue;
            }
        };
        let shortest = quasi.shortest_interval.unwrap_or_else(|| panic!("{text}: {quasi:?}"));
        assert!(quasi.shortest_unique, "{text}: {quasi:?}");
        assert!(length(shortest) <= length(quasi.symmetric_interval), "{text}: {quasi:?}");
        let right = mixture.shortest(p);
        let errors = quasi.scatter().unwrap().shortest_interval.unwrap();
        let at = shortest.map(|end| mixture.at(end));
        let allowed = errors[0] * at[0][1] + errors[1] * at[1][1] + 1e-6;
        assert!((at[1][0] - at[0][0] - p).abs() < 6.0 * allowed, "{text}: {quasi:?} {at:?}");
        for place in [0, 1] {
            let score = (shortest[place] - right[place]) / errors[place];
            if score.abs() > 4.0 {
                println!("{text}: {score:.2} {shortest:?} {right:?} {errors:?}");
            }
            squares.push(score * score);
        }
    }
    println!("{refused} of {models} refused");
    assert!(5 * refused < models, "{refused} of {models}");
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// With 24 quotients, of which the two of a model are correlated, the root mean square is within 0.6 of
/// 1.07 but once in some thousand seeds.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn quasi_intervals_of_twelve_models() {
    let root = quasi_study(12);
    assert!((0.5..1.7).contains(&root), "{root}");
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn quasi_intervals_of_500_models() {
    let root = quasi_study(500);
    println!("root mean square {root}");
    assert!((0.9..1.25).contains(&root), "{root}");
}

/// Sums whose shortest interval was far too long or not found; ends found by quadrature over one of the two
/// inputs (numpy, scipy: panels of 60 points of Gauss, 4000 of Chebyshev for arcsine) to 1e-10, those of the
/// triangular ones with 25 digits (mpmath).
#[test]
fn exact_intervals_that_were_wrong() {
    let readings = Readings::new(vec![1.0, 2.1, 1.7]).unwrap().into();
    let exponential = |mean: f64| Distribution::from(Exponential::new(mean).unwrap());
    let cases = [
        (vec![readings, arcsine(0.0, 0.16)], 0.9545, [0.132_972_420_251, 3.067_027_579_749]),
        (
            vec![triangular(0.0, 1.0, 2.0), gamma(2.0, 2.0)],
            0.95,
            [0.549_487_194_337, 3.636_773_799_388],
        ),
        (
            vec![triangular(0.0, 0.2, 2.0), exponential(0.5)],
            0.95,
            [0.141_421_356_237, 2.499_502_304_258],
        ),
        (vec![t(0.0, 0.2, 2.0), exponential(3.0)], 0.95, [-0.585_502_749_202, 9.537_048_924_963]),
        (
            vec![t(0.0, 0.3, 3.0), triangular(0.0, 1.0, 1.0)],
            0.95,
            [-0.392_338_167_691, 1.692_838_335_784],
        ),
        (vec![t(0.0, 0.05, 1.0), arcsine(0.0, 1.0)], 0.95, [-1.182_143_505_371, 1.182_143_505_371]),
    ];
    for (inputs, p, right) in cases {
        let text = format!("{inputs:?}");
        let found = exact_of(inputs, "x0 + x1", p).unwrap();
        assert!(found.shortest_unique, "{text}");
        let shortest = found.shortest_interval.unwrap_or_else(|| panic!("{text}: {found:?}"));
        assert!(length(shortest) <= length(found.symmetric_interval), "{text}");
        for (end, right) in shortest.into_iter().zip(right) {
            assert!((end - right).abs() < bound(&found) + 1e-9, "{text}: {found:?} {right}");
        }
    }
}

/// Where many intervals are as short, or two, the figures say so: of a rectangle and of trapezoids the
/// density is the same all over the middle, that of an arcsine quantity is the highest at both ends.
#[test]
fn shortest_intervals_that_are_not_unique() {
    let trapezoid = || Distribution::from(Trapezoidal::new(0.0, 1.0, 0.98).unwrap());
    let cases = [
        (vec![rectangular(1.0, 2.0), normal(0.0, 1e-6)], 3.8),
        (vec![rectangular(0.0, 1.0), rectangular(0.0, 1e-3)], 1.9),
        (vec![trapezoid()], 0.95 * 1.98),
        // to one side: 1 + cos(0.05 pi)
        (vec![arcsine(0.0, 1.0)], 1.987_688_340_595_138),
    ];
    for (inputs, right) in cases {
        let text = format!("{inputs:?}");
        let formula = if inputs.len() == 1 { "x0" } else { "x0 + x1" };
        let found = exact_of(inputs, formula, 0.95).unwrap();
        assert!(!found.shortest_unique, "{text}: {found:?}");
        let shortest = length(found.shortest_interval.unwrap());
        assert!((shortest - right).abs() < 1e-9, "{text}: {shortest}");
    }
    let narrow = normal(0.0, 0.01);
    let two = exact_of(vec![arcsine(0.0, 1.0), narrow], "x0 + x1", 0.9).unwrap();
    assert!(!two.shortest_unique, "{two:?}");
    assert!(length(two.shortest_interval.unwrap()) < length(two.symmetric_interval), "{two:?}");
}

/// The shortest interval begins where the values do: of an exponential quantity and of its square.
#[test]
fn shortest_intervals_from_where_the_values_begin() {
    let exponential = || Distribution::from(Exponential::new(1.0).unwrap());
    let high = -libm::log(0.05);
    let cases = [(vec![exponential()], "x0", high), (vec![exponential()], "x0^2", high * high)];
    for (inputs, formula, right) in cases {
        let found = exact_of(inputs, formula, 0.95).unwrap();
        let [low, high] = found.shortest_interval.unwrap();
        assert!(low.abs() < 1e-9 && (high - right).abs() < 1e-9, "{formula}: {found:?} {right}");
        assert!(found.shortest_unique, "{formula}");
    }
}

/// What was 1.4 % too long and held 95.22 %, and what was refused although the density is far from zero:
/// an input was asked for values beyond those for which the output is monotone in it. Ends by quadrature
/// over b and d, and over b and c (numpy, scipy: 60 points of Gauss in each of several panels).
#[test]
fn quasi_intervals_that_were_wrong() {
    let first = vec![normal(0.3, 1.0), rectangular(0.5, 1.0), normal(-0.2, 0.5), t(0.0, 0.4, 6.0)];
    let second = vec![normal(1.0, 0.1), rectangular(2.0, 0.5), normal(0.0, 0.2)];
    let cases = [
        (first, "x0*x1 + x2*x3", [-1.499_689_655_4, 2.072_506_740_5]),
        (second, "x0*x1 + sin(x2)*x1", [1.012_672_204_2, 3.063_841_099_6]),
    ];
    for (inputs, formula, right) in cases {
        let found = quasi_of(inputs, formula, 0.95).unwrap();
        assert!(found.shortest_unique, "{formula}");
        let shortest = found.shortest_interval.unwrap();
        assert!(length(shortest) <= length(found.symmetric_interval), "{formula}");
        // the length is flat about the least one
        assert!((length(shortest) / length(right) - 1.0).abs() < 5e-4, "{formula}: {shortest:?}");
        let errors = found.scatter().unwrap().shortest_interval.unwrap();
        for place in [0, 1] {
            let off = shortest[place] - right[place];
            assert!(off.abs() < 5.0 * errors[place], "{formula}: {off} {errors:?}");
            assert!(errors[place] < 0.01 * length(right), "{formula}: {errors:?}");
        }
    }
    // a flat density, and one that is highest where the values begin
    let flat = vec![rectangular(0.0, 1.0), rectangular(1.0, 1e-4)];
    let flat = quasi_of(flat, "x0*x1", 0.95).unwrap();
    assert!(!flat.shortest_unique && flat.shortest_interval == Some(flat.symmetric_interval));
    let squares =
        quasi_of(vec![normal(0.0, 1.0), normal(0.0, 1.0)], "x0*x0 + x1*x1", 0.95).unwrap();
    let errors = squares.scatter().unwrap().shortest_interval.unwrap();
    for ((end, right), error) in squares
        .shortest_interval
        .unwrap()
        .into_iter()
        .zip([0.0, -2.0 * libm::log(0.05)])
        .zip(errors)
    {
        assert!((end - right).abs() < 5.0 * error && error < 0.01, "{squares:?}");
    }
}
