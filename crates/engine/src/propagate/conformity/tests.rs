use super::*;
use crate::distribution::{Distribution, Exponential, Gamma, Input, Normal, Rectangular};
use crate::propagate::{Control, evaluate};
use crate::special;

/// An independent quadrature: the trapezoidal rule over the values themselves, with the prior's
/// density written out. With steps of u/200 over the whole prior its error is below 1e-8 for smooth
/// densities; at the tolerance limits the ends of the pieces are nodes.
fn by_values(
    density: impl Fn(f64) -> f64,
    support: [f64; 2],
    u: f64,
    limits: [f64; 2],
    acceptance: [f64; 2],
) -> [f64; 2] {
    let accepted = |value: f64| {
        special::normal::cdf((acceptance[1] - value) / u)
            - special::normal::cdf((acceptance[0] - value) / u)
    };
    let piece = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| {
        if to <= from {
            return 0.0;
        }
        let n = ((to - from) / (u / 200.0)).ceil() as usize;
        let h = (to - from) / n as f64;
        let inner: f64 = (1..n).map(|i| f(from + h * i as f64)).sum();
        h * (0.5 * (f(from) + f(to)) + inner)
    };
    let [low, high] = [limits[0].max(support[0]), limits[1].min(support[1])];
    let out = |x: f64| density(x) * accepted(x);
    let inside = |x: f64| density(x) * (1.0 - accepted(x));
    [piece(support[0], low, &out) + piece(high, support[1], &out), piece(low, high, &inside)]
}

fn check(
    prior: &Distribution,
    density: impl Fn(f64) -> f64,
    support: [f64; 2],
    u: f64,
    limits: [f64; 2],
) {
    for width in [0.0, 0.7 * u] {
        let acceptance = [limits[0] + width, limits[1] - width];
        let found = Inspection::new(prior, StudentLaw::normal(u), limits).risks(acceptance);
        let expected = by_values(&density, support, u, limits, acceptance);
        assert!((found.false_acceptance - expected[0]).abs() < 1e-6, "{found:?} {expected:?}");
        assert!((found.false_rejection - expected[1]).abs() < 1e-6, "{found:?} {expected:?}");
    }
}

/// To 1e-6 against the quadrature over values: a normal, a rectangular and a gamma prior, two limits
/// and one.
#[test]
fn global_risks_by_another_quadrature() {
    let normal: Distribution = Normal::new(1500.0, 0.12).unwrap().into();
    let of_normal = |x: f64| {
        (-0.5 * ((x - 1500.0) / 0.12f64).powi(2)).exp()
            / (0.12 * (2.0 * std::f64::consts::PI).sqrt())
    };
    check(&normal, of_normal, [1498.9, 1501.1], 0.04, [1499.8, 1500.2]);
    check(&normal, of_normal, [1498.9, 1501.1], 0.04, [f64::NEG_INFINITY, 1500.2]);
    let rectangle: Distribution = Rectangular::new(10.0, 1.5).unwrap().into();
    check(&rectangle, |_| 1.0 / 3.0, [8.5, 11.5], 0.2, [9.0, 11.2]);
    let gamma: Distribution = Gamma::new(4.0, 4.0).unwrap().into();
    let of_gamma = |x: f64| 256.0 / 6.0 * x.powi(3) * (-4.0 * x).exp();
    check(&gamma, of_gamma, [0.0, 12.0], 0.25, [f64::NEG_INFINITY, 2.0]);
}

/// The ball bearings of JCGM 106, 9.5.4: a gamma prior of mean 1 um and standard deviation 0.5 um,
/// at most 2 um, u = 0.25 um. Of the items 4 % do not conform; the values for a measured motion of at
/// least 0 are those that Suncal (Sandia National Laboratories) computes for its example: 0.042 380
/// and 0.008 019 112.
#[test]
fn ball_bearings() {
    let prior: Distribution = Gamma::new(4.0, 4.0).unwrap().into();
    let out = special::normal::sf(prior.score_of(2.0));
    assert!((out - 0.042_380_111_99).abs() < 1e-10, "{out}");
    let of = Inspection::new(&prior, StudentLaw::normal(0.25), [0.0, 2.0]);
    let risks = of.risks([0.0, 2.0]);
    assert!((risks.false_acceptance - 0.008_019_111_884).abs() < 1e-8, "{risks:?}");
    // at most 0.1 % false acceptance: an upper acceptance limit of 1.67 um
    let of = Inspection::new(&prior, StudentLaw::normal(0.25), [f64::NEG_INFINITY, 2.0]);
    let width = of.guard_band(0.001).unwrap();
    let guarded = of.risks([f64::NEG_INFINITY, 2.0 - width]);
    assert!((guarded.false_acceptance - 0.001).abs() < 1e-9 && (2.0 - width - 1.67).abs() < 0.005);
    assert_eq!(of.guard_band(0.5), Some(0.0));
}

/// One limit, 5 %: w = 1.64 u (JCGM 106, 8.3.2; the quantile is 1.644 854). Two limits far apart make
/// no difference; near ones make w wider; where the middle itself is too uncertain nothing is
/// accepted.
#[test]
fn guard_bands_for_a_specific_risk() {
    let one = ErrorLaw::normal(2.0).guard_band(0.05, [f64::NEG_INFINITY, 10.0]).unwrap();
    assert!((one - 2.0 * 1.644_853_626_95).abs() < 1e-7, "{one}");
    let far = ErrorLaw::normal(2.0).guard_band(0.05, [-90.0, 10.0]).unwrap();
    assert!((far - one).abs() < 1e-7);
    let near = ErrorLaw::normal(2.0).guard_band(0.05, [2.0, 10.0]).unwrap();
    assert!(near > one + 1e-4 && near < 4.0, "{near}");
    let risk = special::normal::sf(near / 2.0) + special::normal::sf((8.0 - near) / 2.0);
    assert!((risk - 0.05).abs() < 1e-8);
    assert_eq!(ErrorLaw::normal(2.0).guard_band(0.05, [7.0, 10.0]), None);
}

/// The posterior of a normal prior and a normal error is normal (JCGM 106, 6.3, example): mean
/// (x0/u0^2 + y/u^2) of the weights' sum, to 1e-9 also where the value lies 40 standard uncertainties
/// from the prior and where the measurement says next to nothing.
#[test]
fn the_posterior_of_a_normal_prior() {
    let (x0, u0) = (10.0, 0.4);
    let prior: Distribution = Normal::new(x0, u0).unwrap().into();
    for (y, u) in [(10.3, 0.2), (9.0, 0.4), (26.0, 0.4), (10.0, 50.0), (10.1, 0.001)] {
        let weights = [1.0 / (u0 * u0), 1.0 / (u * u)];
        let variance = 1.0 / (weights[0] + weights[1]);
        let mean = (x0 * weights[0] + y * weights[1]) * variance;
        let limits = [mean - 0.7 * variance.sqrt(), mean + 1.1 * variance.sqrt()];
        let expected = special::normal::cdf(1.1) - special::normal::cdf(-0.7);
        let found = Inspection::new(&prior, StudentLaw::normal(u), limits).conformance(y);
        // beyond the scores that are integrated over there is nothing of the prior
        let limit = if y > 20.0 { 1.0 } else { 1e-8 };
        assert!((found - expected).abs() < limit, "{y}, {u}: {found} {expected}");
        assert!((0.0..=1.0).contains(&found));
    }
}

/// A bearing of JCGM 106's gamma prior that was measured as 1.9 um with u = 0.25 um conforms to 2 um
/// with 84.01 % (quadrature over values by another program; and by the rule below), where the share of
/// the measurement's own distribution is Phi(0.4) = 65.54 %.
#[test]
fn the_posterior_of_a_ball_bearing() {
    let prior: Distribution = Gamma::new(4.0, 4.0).unwrap().into();
    let of = Inspection::new(&prior, StudentLaw::normal(0.25), [f64::NEG_INFINITY, 2.0]);
    let found = of.conformance(1.9);
    assert!((found - 0.8401).abs() < 5e-5, "{found}");
    let density =
        |x: f64| x.powi(3) * (-4.0 * x).exp() * (-0.5 * ((1.9 - x) / 0.25f64).powi(2)).exp();
    let sum = |from: f64, to: f64| {
        let n = 100_000;
        let h = (to - from) / f64::from(n);
        (0..n).map(|i| h * density(from + h * (f64::from(i) + 0.5))).sum::<f64>()
    };
    let expected = sum(0.0, 2.0) / (sum(0.0, 2.0) + sum(2.0, 6.0));
    assert!((found - expected).abs() < 1e-7, "{found} {expected}");
}

/// Limits of a phase hold modulo a turn: of 359.8 deg with u = 0.1 deg and limits of 1 deg about 0 it is
/// Phi(12) - Phi(-8), of 179.5 deg with 1 deg between -182 deg and -179 deg Phi(1.5) - Phi(-1.5), and of
/// limits about half a turn away the sum of Phi((210 deg + n 360 deg)/u) - Phi((150 deg + n 360 deg)/u)
/// over whole n (erf of the C library). By the law of propagation to 1e-9; trials to four of their
/// standard errors, false in one of 16 000 seeds for each.
#[test]
fn limits_of_phases() {
    let cases = [
        (359.8, 0.1, [-1.0, 1.0], 1.0 - 6.7e-16),
        (179.5, 1.0, [-182.0, -179.0], 0.866_385_597_462_284),
        (0.0, 60.0, [150.0, 210.0], 0.011_954_072_493_481),
    ];
    for (mean, u, [lower, upper], expected) in cases {
        for trials in [0, 100_000] {
            let tolerance = Tolerance { lower: Some(lower), upper: Some(upper) };
            let mut task = crate::task::Task::builder("a phase")
                .input("a", Input::normal(mean, u, "deg").unwrap())
                .equation("y", "a")
                .output("y", "deg")
                .tolerance("y", tolerance)
                .trials(trials)
                .build()
                .unwrap();
            task.model.outputs[0].period = Some(360.0);
            let evaluation = evaluate(&task, &Control::default()).unwrap();
            let figures = &evaluation.rows[0].outputs[0];
            let output = &task.model.outputs[0];
            let found = Conformity::evaluated(output, figures, &task.settings).unwrap();
            let error = 4.0 * found.numerical_standard_error + 1e-9;
            assert!((found.probability - expected).abs() <= error, "{mean}, {trials}: {found:?}");
            assert_eq!(found.conforms, expected > 0.5, "{found:?}");
            assert_eq!(found.tolerance, tolerance);
        }
    }
}

/// An estimate at the limit itself is decided upon with the value that is stated, 10, whatever the seed:
/// the mean of the trials lies beyond the limit for half of the seeds.
#[test]
fn no_seed_decides() {
    let tolerance = Tolerance { lower: Some(9.8), upper: Some(10.0) };
    let decided = |seed: u64| {
        let task = crate::task::Task::builder("at the limit")
            .input("a", Input::normal(10.25, 0.1, "V").unwrap())
            .input("b", Input::normal(-0.25, 0.05, "V").unwrap())
            .equation("y", "a + b")
            .output("y", "V")
            .tolerance("y", tolerance)
            .trials(20_000)
            .seed(seed)
            .build()
            .unwrap();
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let figures = &evaluation.rows[0].outputs[0];
        let found = Conformity::evaluated(&task.model.outputs[0], figures, &task.settings);
        found.map(|found| (found.conforms, found.estimate))
    };
    for seed in 1..8 {
        assert_eq!(decided(seed), Some((true, 10.0)), "{seed}");
    }
}

/// Errors of few degrees of freedom have the t distribution of the law of propagation: with a prior that
/// says nothing the posterior is the measurement's own (of t with 3 degrees of freedom F(3.2) is
/// known in closed form), and otherwise that of Bayes' theorem by the midpoint rule.
#[test]
fn the_posterior_of_few_degrees_of_freedom() {
    let t3 = StudentLaw { scale: 0.1, dof: 3.0 };
    let flat: Distribution = Normal::new(1.0, 1e5).unwrap().into();
    let found = Inspection::new(&flat, t3, [f64::NEG_INFINITY, 1.32]).conformance(1.0);
    // F(x) = 1/2 + (atan s + s/(1 + s^2))/pi with s = x/sqrt(3)
    let s = 3.2 / 3.0_f64.sqrt();
    let expected = 0.5 + (s.atan() + s / (1.0 + s * s)) / std::f64::consts::PI;
    assert!((found - expected).abs() < 1e-5, "{found} {expected}");

    let prior: Distribution = Normal::new(1.0, 0.3).unwrap().into();
    let found = Inspection::new(&prior, t3, [f64::NEG_INFINITY, 1.5]).conformance(1.0);
    let density = |x: f64| {
        (-0.5 * ((x - 1.0) / 0.3f64).powi(2)).exp()
            / (1.0 + ((1.0 - x) / 0.1).powi(2) / 3.0).powi(2)
    };
    let sum = |from: f64, to: f64| {
        let n = 200_000;
        let h = (to - from) / f64::from(n);
        (0..n).map(|i| h * density(from + h * (f64::from(i) + 0.5))).sum::<f64>()
    };
    let expected = sum(-1.5, 1.5) / (sum(-1.5, 1.5) + sum(1.5, 3.5));
    assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    assert!((1.0 - found) > 1e-4, "a normal law would have 6.8e-8");
}

/// An exponential quantity of mean 1 lies beyond 4 with e^-4 = 0.018: no value within three of its
/// standard uncertainties of both limits has a specific risk of 0.01, whatever a normal law would say.
#[test]
fn no_guard_band_is_small_enough_for_the_trials() {
    let of_task = |risk: f64| {
        let task = crate::task::Task::builder("one-sided")
            .input("a", Input::new(Exponential::new(1.0).unwrap(), "1").unwrap())
            .equation("y", "a")
            .output("y", "1")
            .tolerance("y", Tolerance { lower: Some(-2.0), upper: Some(4.0) })
            .risk("y", risk)
            .trials(100_000)
            .build()
            .unwrap();
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let figures = &evaluation.rows[0].outputs[0];
        Conformity::evaluated(&task.model.outputs[0], figures, &task.settings).unwrap()
    };
    let found = of_task(0.01);
    assert_eq!((found.guard_band, found.acceptance, found.conforms), (None, None, false));
    // at 4 - w the risk is P(a - 1 > w) = exp(-1 - w): of 0.05 w is 1.996, with 1e5 trials to 0.014 (se
    // sqrt(0.05 0.95/1e5)/0.05); five of them are exceeded once in two million seeds
    let found = of_task(0.05).guard_band.unwrap();
    assert!((found - 1.996).abs() < 0.07, "{found}");
}

/// The widths of the named rules in units of T at TUR = 2, 1 and 5 by hand: RSS 1 - sqrt(3)/2; RP-10 a
/// quarter at 2:1 and nothing above 4:1; Dobbert 0.281 645/2 (his table has M = 0.28 at 2:1). An U above
/// T has no RSS guard band.
#[test]
fn named_guard_bands_by_hand() {
    let width = |rule: GuardRule, ratio: f64| rule.width(3.0, 3.0 / ratio).map(|width| width / 3.0);
    let near = |found: Option<f64>, expected: f64| {
        assert!((found.unwrap() - expected).abs() < 1e-6, "{found:?} {expected}");
    };
    near(width(GuardRule::Rss, 2.0), 0.133_974_6);
    near(width(GuardRule::Rss, 1.0), 1.0);
    assert_eq!(width(GuardRule::Rss, 0.99), None);
    near(width(GuardRule::Rp10, 2.0), 0.25);
    near(width(GuardRule::Rp10, 5.0), 0.0);
    near(width(GuardRule::Dobbert, 2.0), 0.140_822_7);
    near(width(GuardRule::Dobbert, 5.0), 0.0);
}

/// What Dobbert's rule is made for: the global risk of false acceptance is at most 2 % whatever the normal
/// distribution of the items, and is so closely (the fit of M is within a tenth of the risk), for U of
/// k = 2 and every TUR from 0.8 on; without the guard band it is up to 7 %. By quadrature over the items
/// above the upper limit; steps of u/200.
#[test]
fn dobberts_guard_band_holds_two_per_cent() {
    for ratio in [0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 4.5, 5.0, 10.0] {
        let (u, half) = (1.0, 2.0 * ratio);
        let accepted = half - GuardRule::Dobbert.width(half, 2.0 * u).expect("a guard band");
        let risk = |spread: f64| {
            let density = |x: f64| {
                (-0.5 * (x / spread).powi(2)).exp() / (spread * (2.0 * std::f64::consts::PI).sqrt())
            };
            let ends = [-half - 9.0 * u, half + 9.0 * u];
            by_values(density, ends, u, [-half, half], [-accepted, accepted])[0]
        };
        let worst = (1..=120).map(|step| risk(0.05 * half * f64::from(step))).fold(0.0, f64::max);
        assert!(worst <= 0.02, "{ratio}: {worst}");
        if ratio < 4.6 {
            assert!(worst > 0.018, "{ratio}: {worst}");
        }
    }
}

/// The conditional risk against items and measurements that are drawn: of 200 000 accepted ones the share
/// that does not conform, within five standard errors (a false failure once in a million).
#[test]
fn the_conditional_risk_by_drawing() {
    let prior: Distribution = Normal::new(0.0, 1.0).unwrap().into();
    let (limits, acceptance, u) = ([-2.0, 2.0], [-1.8, 1.8], 0.4);
    let found = Inspection::new(&prior, StudentLaw::normal(u), limits).risks(acceptance);
    let mut state = 66_u64;
    let mut score = || {
        // a linear congruential generator (Knuth, MMIX), its upper 53 bits
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        special::normal::quantile(((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
    };
    let (mut accepted, mut wrong) = (0_u32, 0_u32);
    while accepted < 200_000 {
        let item = score();
        let measured = item + u * score();
        if measured.abs() <= acceptance[1] {
            accepted += 1;
            wrong += u32::from(item.abs() > limits[1]);
        }
    }
    let share = f64::from(wrong) / f64::from(accepted);
    let error = (share / f64::from(accepted)).sqrt();
    let expected = found.conditional_false_acceptance();
    assert!((share - expected).abs() < 5.0 * error, "{share} {expected} {error}");
}
