//! From stated widths to standard uncertainties.

use super::*;

/// JCGM 100, 4.3 and 4.4: the half-width over the divisor is the standard uncertainty.
#[test]
fn the_stated_width_over_its_divisor_is_the_standard_uncertainty() {
    let cases: [(Distribution, f64, f64); 7] = [
        (Rectangular::new(3.0, 0.5).unwrap().into(), 0.5, 3f64.sqrt()),
        (Triangular::between(2.0, 3.0, Some(2.5)).unwrap().into(), 0.5, 6f64.sqrt()),
        (Arcsine::new(3.0, 0.5).unwrap().into(), 0.5, 2f64.sqrt()),
        // a trapezoid is between the triangle and the rectangle
        (Trapezoidal::new(3.0, 0.5, 0.0).unwrap().into(), 0.5, 6f64.sqrt()),
        (Trapezoidal::new(3.0, 0.5, 1.0).unwrap().into(), 0.5, 3f64.sqrt()),
        (Normal::new(3.0, 0.1).unwrap().stated_with(2.5).unwrap().into(), 0.25, 2.5),
        (Normal::new(3.0, 0.1).unwrap().into(), 0.1, 1.0),
    ];
    for (distribution, width, expected) in cases {
        let divisor = distribution.divisor().unwrap();
        assert!((divisor - expected).abs() < 1e-15 * expected, "{distribution:?}");
        let u = distribution.standard_uncertainty();
        assert!((divisor * u - width).abs() < 1e-15, "{distribution:?}");
        assert_eq!(distribution.moved_to(7.0).unwrap().divisor(), Some(divisor));
    }
}

#[test]
fn limits_that_are_not_one_width_have_no_divisor() {
    let skew = Triangular::between(2.0, 3.0, Some(2.1)).unwrap();
    assert_eq!(Distribution::from(skew).divisor(), None);
    assert_eq!(Distribution::from(Constant::new(3.0).unwrap()).divisor(), None);
}
