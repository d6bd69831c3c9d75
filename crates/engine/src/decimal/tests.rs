use proptest::prelude::*;

use super::*;

/// The rule in integers: `number` x 10^0 to a multiple of 10^`drop`, half away from zero.
fn by_integers(number: i128, drop: u32) -> i128 {
    let unit = 10_i128.pow(drop);
    let sign = number.signum();
    sign * ((2 * number.abs() + unit) / (2 * unit)) * unit
}

/// The number that a decimal text stands for.
fn read(coefficient: i128, position: i32) -> f64 {
    format!("{coefficient}e{position}").parse().unwrap()
}

/// `value` moved by so many of its last bits.
fn moved(value: f64, bits: i64) -> f64 {
    f64::from_bits(value.to_bits().checked_add_signed(bits).unwrap())
}

proptest! {
    /// Numbers of ten decimal digits, half of them a tie, moved by up to a hundred of their last
    /// bits (2.2e-14 of the number at most, where twelve digits allow 5e-13): the integers decide.
    #[test]
    fn rounding_is_that_of_integers(
        number in -9_999_999_999_i128..=9_999_999_999,
        drop in 1_u32..12,
        tie in any::<bool>(),
        power in -290..290_i32,
        bits in -100..=100_i64,
    ) {
        let unit = 10_i128.pow(drop);
        let number =
            if tie && drop < 10 { number / unit * unit + number.signum() * unit / 2 } else { number };
        prop_assume!(number != 0);
        let value = moved(read(number, power), bits);
        let position = power + drop as i32;
        let expected = by_integers(number, drop);
        let found = Decimal::shortest(value).unwrap().round(position, Direction::Nearest);
        prop_assert_eq!(found.value(), read(expected, power));
        prop_assert_eq!(found.position(), position);
        prop_assert_eq!(rounded(value, position).parse::<f64>().unwrap(), read(expected, power));

        let up = number.div_euclid(unit) + i128::from(number.rem_euclid(unit) > 0);
        let found = Decimal::shortest(value).unwrap().round(position, Direction::Up);
        prop_assert_eq!(found.value(), read(up * unit, power));
        let down = number.div_euclid(unit);
        let found = Decimal::shortest(value).unwrap().round(position, Direction::Down);
        prop_assert_eq!(found.value(), read(down * unit, power));
    }

    /// Kept digits up to the fifteenth: what is printed is within half a unit of the last digit and
    /// the 0.005 that the guard digits may move it by.
    #[test]
    fn what_is_printed_reads_back_within_half_a_unit(
        value in prop::num::f64::NORMAL,
        digits in 1_u32..=15,
    ) {
        let position = position(value, digits).unwrap();
        let found: f64 = significant(value, digits).parse().unwrap();
        let half: f64 = format!("5e{}", position - 1).parse().unwrap();
        let allowed = half * 1.0101 + 2.0 * f64::EPSILON * value.abs();
        prop_assert!((found - value).abs() <= allowed || found.is_infinite());
    }

    #[test]
    fn any_position_is_printed(value in any::<f64>(), position in any::<i32>()) {
        let text = rounded(value, position);
        prop_assert!(text == MISSING || text.parse::<f64>().is_ok(), "{}", text);
        prop_assert!(text.len() < 40, "{}", text);
    }

    #[test]
    fn the_shortest_digits_are_the_number(value in any::<f64>()) {
        match Decimal::shortest(value) {
            Some(decimal) => prop_assert_eq!(decimal.value(), value),
            None => prop_assert!(!value.is_finite()),
        }
    }
}

#[test]
fn half_goes_away_from_zero() {
    let cases = [
        (0.125, -2, "0.13"),
        (0.375, -2, "0.38"),
        (-0.125, -2, "-0.13"),
        // a little less than a tie in binary, ties as they are written
        (2.675, -2, "2.68"),
        (1.005, -2, "1.01"),
        (2.5, 0, "3"),
        (0.5, 0, "1"),
        (0.05, 0, "0"),
        (0.499_999, 0, "0"),
        (-0.6, 0, "-1"),
        (-0.4, 0, "0"),
        (4.0, 1, "0"),
        (5.0, 1, "10"),
        (50.0, 2, "100"),
        (49.0, 2, "0"),
        (99.5, 0, "100"),
        (9.996, -2, "10.00"),
        // computed: 0.3 and 0.125 but for the last bits
        (0.1 + 0.2, -2, "0.30"),
        (0.124_999_999_999_999_99, -2, "0.13"),
        (0.125_f64.sqrt() * 0.125_f64.sqrt(), -2, "0.13"),
        // which thirteen digits do not excuse
        (0.124_999_999_99, -2, "0.12"),
        // digits behind the twelfth are kept where they are asked for
        (9_192_631_770.123_45, -5, "9192631770.12345"),
        (1.000_000_123_456_78, -13, "1.0000001234568"),
    ];
    for (value, position, expected) in cases {
        assert_eq!(rounded(value, position), expected, "{value:?} {position}");
    }
}

#[test]
fn extremes_stay_readable() {
    assert_eq!(rounded(1e300, -12), "1.00000000000000e300");
    assert_eq!(rounded(0.0, -12), "0");
    assert_eq!(rounded(0.0, -2), "0.00");
    assert_eq!(rounded(-0.0, 3), "0");
    // the shortest text of the least number is 5e-324, its exact one 4.94...e-324
    assert_eq!(significant(5e-324, 2), "5.0e-324");
    assert_eq!(significant(2.225_073_858_507_201e-308, 3), "2.23e-308");
    assert_eq!(significant(f64::MAX, 3), "1.80e308");
    assert_eq!(significant(f64::MAX, 1), "2e308");
    assert_eq!(to_digits(f64::MAX, 1), f64::INFINITY);
    assert_eq!(exact(-1e-5), "-0.00001");
    assert_eq!(exact(-9e-6), "-9e-6");
    assert_eq!(exact(1e10), "1e10");
    assert_eq!(exact(9_999_999_999.0), "9999999999");
    assert_eq!(rounded(10_000_050.0, 1), "10000050");
    assert_eq!(exact(0.999_999_999_999_9), "1");
    assert_eq!(exact(-0.0), "0");
    assert_eq!(exact(f64::NAN), "-");
    assert_eq!(rounded(f64::NEG_INFINITY, -2), "-");
    assert_eq!(rounded(1.0, i32::MIN), "1.00000000000000");
    assert_eq!(rounded(1.0, i32::MAX), "0");
    assert_eq!(rounded(0.999_999_999_999_999_6, -17), "1.00000000000000");
    assert_eq!(position(0.0, 2), None);
    assert_eq!(position(f64::NAN, 2), None);
    assert_eq!(to_position(f64::INFINITY, 0), f64::INFINITY);
    assert_eq!(to_position(1234.5, 0), 1235.0);
}

#[test]
fn a_carry_moves_the_last_digit() {
    let cases = [
        (9.96, 2, "10"),
        (99.5, 2, "100"),
        (0.0995, 2, "0.10"),
        (0.9995, 3, "1.00"),
        (999.9, 1, "1000"),
        (9.95, 2, "10"),
        (9.949_999_999_999_999, 2, "10"),
        (9.949_999, 2, "9.9"),
        (1.249_999_999_999_999_9e-7, 2, "1.3e-7"),
        (9.999_999_999_999_99, 15, "9.99999999999999"),
        (9.999_999_999_999_998, 15, "10.0000000000000"),
    ];
    for (value, digits, expected) in cases {
        assert_eq!(significant(value, digits), expected, "{value:?} {digits}");
    }
}
