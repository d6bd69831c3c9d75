//! The functions against references of 25 digits: tests/data/quantiles.csv, which quantiles.py next
//! to it computes with mpmath from the exact double arguments.

use super::{beta, gamma, normal, student};

const ROWS: &str = include_str!("../../tests/data/quantiles.csv");

fn evaluate(function: &str, x: f64, second: f64, third: f64) -> f64 {
    match function {
        "normal_cdf" => normal::cdf(x),
        "normal_sf" => normal::sf(x),
        "normal_quantile" => normal::quantile(x),
        "normal_quantile_upper" => normal::quantile_upper(x),
        "student_cdf" => student::cdf(x, second),
        "student_sf" => student::sf(x, second),
        "student_quantile" => student::quantile(x, second),
        "student_factor" => student::two_sided_factor(x, second),
        "gamma_cdf" => gamma::cdf(x, second),
        "gamma_sf" => gamma::sf(x, second),
        "gamma_quantile" => gamma::quantile(x, second),
        "beta_cdf" => beta::cdf(x, second, third),
        "beta_sf" => beta::sf(x, second, third),
        "beta_quantile" => beta::quantile(x, second, third),
        _ => panic!("no function {function}"),
    }
}

/// The relative error to allow. The unit of rounding is 1.1e-16.
fn tolerance(function: &str, second: f64, third: f64, reference: f64) -> f64 {
    match function {
        // An error function or a rational approximation, each good to a unit or two in the last
        // place, and a few roundings.
        "normal_cdf" | "normal_sf" | "normal_quantile" | "normal_quantile_upper" => 1e-15,
        // The weight is the exponential of a rounded number of the size of the result's logarithm,
        // with two or three roundings of that size; sums and small factors add some 1e-15. The
        // complement beyond a mean far from the median costs a digit (beta, small shapes).
        "student_cdf" | "student_sf" | "gamma_cdf" | "gamma_sf" | "beta_cdf" | "beta_sf" => {
            1.5e-14 + 3e-16 * reference.max(f64::MIN_POSITIVE).ln().abs()
        }
        // A relative error e of the tail moves the quantile by at most e / dof in the tail and by e
        // at the center; e is some 5e-15 for probabilities down to 1e-12.
        "student_quantile" | "student_factor" => 5e-15 + 2e-15 / second,
        // Likewise e / shape at the lower end; the upper end is better conditioned. For small shapes
        // e grows with the logarithm of the probability, down to 1e-12.
        "gamma_quantile" => 5e-15 + 4e-15 / second,
        "beta_quantile" => 5e-15 + 8e-15 / second.min(third),
        _ => panic!("no function {function}"),
    }
}

#[test]
fn every_row_of_the_references() {
    let mut rows = 0;
    for row in ROWS.lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let number = |i: usize| fields[i].parse::<f64>().unwrap_or(f64::NAN);
        let (function, x, second, third) = (fields[0], number(1), number(2), number(3));
        let reference: f64 = fields[4].parse().expect("a reference");
        let value = evaluate(function, x, second, third);
        // A result near the smallest double may be off by one such step.
        let allowed =
            tolerance(function, second, third, reference) * reference.abs() + f64::from_bits(1);
        let error = (value - reference).abs();
        assert!(
            error <= allowed,
            "{row}\nvalue {value:e}, relative error {:e}, allowed {:e}",
            error / reference.abs(),
            allowed / reference.abs()
        );
        rows += 1;
    }
    assert!(rows > 300, "only {rows} rows");
}
