//! Inputs with distributions of other crates: `examples/other_distributions.rs`.

use gumption::propagate::{Control, evaluate};

#[path = "../../examples/other_distributions.rs"]
mod program;

/// Mean, standard deviation, and the quantiles of 0.025 and 0.975 of the sum of a Weibull (shape 2,
/// scale 8) and a Gumbel quantity (location 3, scale 1.2). The moments are closed forms; the
/// quantiles are those of the convolution of scipy's distribution function and density
/// (scipy 1.17.1, integrate.quad to 1e-12).
const EXPECTED: [f64; 4] =
    [10.782_474_201_503_9, 4.012_882_081_350_6, 4.225_220_275_171, 19.632_999_501_635];

/// Standard errors of 1e6 trials: s/sqrt(n); s sqrt((3.2302 - 1) / 4 n) with the kurtosis of the
/// sum; sqrt(p (1 - p) / n) over the densities 0.027 419 and 0.011 230 at the quantiles.
const ERRORS: [f64; 4] = [0.00402, 0.00300, 0.00570, 0.0139];

/// Five standard errors leave a false failure in 4e5 seeds; the seed is fixed.
#[test]
fn a_sum_of_weibull_and_gumbel_has_the_moments_and_quantiles_of_scipy() {
    let control = Control::default().with_threads(2);
    let evaluation =
        evaluate(&program::task(1_000_000).expect("a task"), &control).expect("trials");
    let found = program::figures(&evaluation).expect("trials");
    for ((found, expected), error) in found.iter().zip(EXPECTED).zip(ERRORS) {
        assert!((found - expected).abs() < 5.0 * error, "{found}, not {expected}");
    }
    // the law of propagation has the moments of `statrs`, which are closed forms
    let gum = evaluation.rows[0].outputs[0].gum.as_ref().expect("a linear model");
    assert!((gum.estimate - EXPECTED[0]).abs() < 1e-9, "{}", gum.estimate);
    assert!((gum.standard_uncertainty - EXPECTED[1]).abs() < 1e-9, "{}", gum.standard_uncertainty);
}

/// The same trials whatever the number of threads and the code path.
#[test]
fn draws_of_other_crates_are_repeated() {
    let task = program::task(20_000).expect("a task");
    let on = |threads: usize, path| {
        let control = Control::default().with_threads(threads).with_path(path);
        program::figures(&evaluate(&task, &control).expect("trials"))
    };
    let first = on(1, gumption::number::CodePath::best());
    for path in gumption::number::CodePath::available() {
        assert_eq!(on(2, path), first, "{path:?}");
    }
}

/// With quantiles they can be correlated: r = 0.5 between both gives the sum
/// u^2 = u_1^2 + u_2^2 + 2 r u_1 u_2, in the trials to five standard errors of 0.3 %.
#[test]
fn distributions_of_other_crates_are_correlated() {
    let mut task = program::task(200_000).expect("a task");
    task.correlations.push(gumption::distribution::Correlation {
        first: 0,
        second: 1,
        coefficient: 0.5,
    });
    let control = Control::default().with_threads(2);
    let evaluation = evaluate(&task, &control).expect("trials");
    let [_, found, ..] = program::figures(&evaluation).expect("trials");
    let [a, b] = [0, 1].map(|i| task.rows[0].distributions[i].standard_uncertainty());
    let expected = (a * a + b * b + a * b).sqrt();
    assert!((found / expected - 1.0).abs() < 0.015, "{found} {expected}");
}
