use super::*;

#[test]
fn shares_of_what_and_digits_of_a_display() {
    let volt = Unit::parse("V").unwrap();
    let wrong = |text: &str| Width::specification(text, &volt, &[], None).unwrap_err();
    assert!(wrong("0.02 % of reading + 0.01 % of range").contains("such as `0.01 % of 10 V`"));
    for text in ["0.02 % of 20 V + 3 digits", "3 digit"] {
        assert!(wrong(text).contains("the size of a digit"), "{}", wrong(text));
    }
}

fn read(text: &str, unit: &str) -> Result<Width, String> {
    Width::specification(text, &Unit::parse(unit).unwrap(), &[], None)
}

#[test]
fn a_multimeter_specification() {
    let width = read("0.02 % + 0.005 % of 10 V + 2 uV", "V").unwrap();
    assert!((width.at(-5.0) - (0.001 + 0.0005 + 2e-6)).abs() < 1e-15);
    assert!((read("50 ppm of reading + 1e-3 mV", "V").unwrap().at(2.0) - 1.01e-4).abs() < 1e-15);
    let gauge = read("0.5 um + 5 um/m", "mm").unwrap();
    assert!((gauge.at(100.0) - (0.5e-3 + 0.5e-3)).abs() < 1e-15);
    let bridge = read("2 uV/V of reading + 1 uV/V of 10 V", "mV").unwrap();
    assert!((bridge.at(5.0) - (1e-5 + 1e-2)).abs() < 1e-15);
    assert!((read("3", "").unwrap().at(7.0) - 3.0).abs() < 1e-15);
    assert!((read("1e+1 mV", "V").unwrap().at(7.0) - 0.01).abs() < 1e-15);
}

/// Limits on both sides, and no other widths, may have `±`.
#[test]
fn plus_minus_before_limits() {
    for (text, expected) in
        [("±0.05 mm", "0.05 mm"), ("+/- 5", "5"), ("±(0.02 % + 2 uV)", "0.02 % + 2 uV"), ("1", "1")]
    {
        assert_eq!(without_plus_minus(text, "half_width").as_deref(), Ok(expected));
    }
    assert!(without_plus_minus("±0.05 mm", "std").unwrap_err().contains("`half_width`"));
}

/// A ratio such as 1 um/m counts as ppm; a ratio of another size does not.
#[test]
fn shares_of_ratios() {
    for (text, unit) in
        [("1 ppm", "umol/mol"), ("5 ppm", "uV/V"), ("2 ppb", "umol/mol"), ("1 %", "cg/g")]
    {
        let error = read(text, unit).unwrap_err();
        assert!(error.contains("is unclear"), "{text} {unit}: {error}");
        let of_reading = read(&format!("{text} of reading"), unit).unwrap();
        assert!(of_reading.is_relative_only(), "{text} {unit}");
    }
    assert!((read("5 ppm", "mV/V").unwrap().at(2.0) - 1e-5).abs() < 1e-18);
    assert!((read("0.1 %", "1").unwrap().at(0.5) - 5e-4).abs() < 1e-18);
}

/// For plain numbers too, a fraction with a divisor is a fraction, and a digit does not belong
/// to a display.
#[test]
fn shares_and_digits_of_plain_numbers() {
    for unit in ["mV/V", "1", "mm/m"] {
        for (text, expected) in [
            ("0.1 %/sqrt(3)", 2e-3 / 3_f64.sqrt()),
            ("50 ppm/2", 5e-5),
            ("0.1 %/2 of reading", 1e-3),
        ] {
            let width = read(text, unit).unwrap();
            assert!((width.at(2.0) - expected).abs() < 1e-15, "{text} of 2 {unit}");
        }
        assert!(read("1 digit", unit).unwrap_err().contains("the size of a digit"));
    }
    assert!(read("1 LSB", "deg").unwrap_err().contains("the size of a digit"));
    assert!(read("0.1 %/2", "%").unwrap_err().contains("of reading"));
    assert_eq!(read("3 count", "1").unwrap().at(7.0), 3.0);
    assert_eq!(read("3 um/m", "1").unwrap().at(7.0), 3e-6);
}

#[test]
fn what_cannot_be_read_is_explained() {
    assert!(read("0.05 % FS", "V").unwrap_err().contains("`0.05 % of 10 V`"));
    assert!(read("0.5 + 1 ppm of reading", "%").unwrap_err().contains("components"));
    assert!(read("0.02 % + 3", "V").unwrap_err().contains("no unit"));
    assert!(read("1 %", "degC").unwrap_err().contains("of reading"));
    assert!(read("2 s", "V").unwrap_err().contains("converted"));
    assert!(read("2 um/V", "m").unwrap_err().contains("converted"));
    assert!(read("2 mm/m", "degC").unwrap_err().contains("of reading"));
    assert!(read("", "V").unwrap_err().contains("empty"));
    assert!(read("0 %", "V").unwrap_err().contains("zero"));
    assert!(read("1 % + ", "V").unwrap_err().contains("empty"));
    assert!(read("-1 %", "V").is_err());
    assert!(read("1 furlong", "m").unwrap_err().contains("furlong"));
}

/// What the keys beside a width state.
fn of_display(resolution: f64, range: f64, full_scale: f64) -> Instrument {
    let [resolution, range, full_scale] = [resolution, range, full_scale].map(Some);
    Instrument { resolution, range, full_scale }
}

/// 5 V on a range of 10 V with a full scale of 12 V and counts of 0.1 mV.
#[test]
fn specifications_as_data_sheets_print_them() {
    let volt = Unit::parse("V").unwrap();
    let instrument = of_display(1e-4, 10.0, 12.0);
    for (text, expected) in [
        ("0.02 % rdg + 2 counts", 1e-3 + 2e-4),
        ("0.02% of rdg + 2 dgt", 1e-3 + 2e-4),
        ("0.02 % reading + 1 LSD", 1e-3 + 1e-4),
        ("(0.02 % rdg + 3 digits)", 1e-3 + 3e-4),
        ("0.05 % FS", 6e-3),
        ("0.05 % of full scale + 10 uV", 6e-3 + 1e-5),
        ("50 ppm rdg + 20 ppm range", 2.5e-4 + 2e-4),
        ("10 uV/V rdg + 5 uV/V of range", 5e-5 + 5e-5),
    ] {
        let width = Width::specification(text, &volt, &[], Some(&instrument)).unwrap();
        assert!((width.at(-5.0) - expected).abs() < 1e-15, "{text}: {}", width.at(-5.0));
    }
    let missing = |text: &str| {
        Width::specification(text, &volt, &[], Some(&Instrument::default())).unwrap_err()
    };
    assert!(missing("0.02 % rdg + 2 counts").contains("the key `resolution`"));
    assert!(missing("0.05 % FS").contains("the key `full_scale`"));
    let range = missing("0.05 % of range");
    assert!(range.contains("the key `range`") && range.contains("`0.05 % of 10 V`"), "{range}");
    // a count of a plain number, and a count of a display
    let one = Width::specification("3 counts", &Unit::one(), &[], Some(&instrument)).unwrap_err();
    assert!(one.contains("`3 digits`"), "{one}");
}

/// ISO notation of lengths: at 200 mm the square root of 100^2 + 300^2, in nm.
#[test]
fn square_roots_of_two_squares() {
    let expected = (1e4 + 9e4_f64).sqrt() * 1e-6;
    for text in [
        "Q[100; 1.5 L] nm, L in mm",
        "Q[100, 1.5L] nm (L in mm)",
        "Q[0.1; 1.5 L] µm, L in m",
        "Q[0.1 um; 1.5e-6 L]",
        "Q[0.1 um; 1.5×10⁻⁶ L]",
        "Q[100 nm; 1.5 um/m L]",
        "Q[100 nm; 1.5 ppm·L]",
        "Q[100; 1.5 D] nm, D in mm",
    ] {
        let width = read(text, "mm");
        let width = width.unwrap_or_else(|error| panic!("{text}: {error}"));
        assert!((width.at(200.0) - expected).abs() < 1e-18, "{text}: {}", width.at(200.0));
    }
    for (text, said) in [
        ("Q[100; 1.5 L] nm", "L in mm"),
        ("Q[100; 1.5 L]", "needs the unit"),
        ("Q[100; 1.5] nm, L in mm", "needs L"),
        ("Q[0,1; 1,5L] um, L in m", "point"),
        ("Q[0.1 um; 0.5 m L]", "not a ratio"),
        ("Q[0.1 um; 0.5 L], L in m", "needs the unit"),
        ("Q[1; 2; 3 L] nm, L in mm", "two parts"),
        ("Q[100; 1.5 L] nm, L in s", "converted"),
    ] {
        let error = read(text, "mm").unwrap_err();
        assert!(error.contains(said), "{text}: {error}");
    }
    assert!(read("Q[0.1 K; 0.01 L]", "degC").unwrap_err().contains("no share"));
}

/// Half a per cent is 0.02 mm at 4 mm.
#[test]
fn the_greater_of_two() {
    for text in [
        "greater of 0.5 % and 0.02 mm",
        "the greater of 0.5 % or 20 um",
        "max(0.5 %, 0.02 mm)",
        "0.5 % or 0.02 mm, whichever is greater",
    ] {
        let width = read(text, "mm").unwrap();
        assert!((width.at(2.0) - 0.02).abs() < 1e-15, "{text}");
        assert!((width.at(-10.0) - 0.05).abs() < 1e-15, "{text}");
    }
    assert!(is_combined("max(0.5 %, 0.02 mm)"));
    for formula in ["max(0.5, f)", "max(f, g)", "2*Q", "max(0.5, 2)"] {
        assert!(!is_combined(formula), "{formula}");
    }
}

/// Powers of ten as they are printed.
#[test]
fn numbers_as_printed() {
    for text in ["5×10⁻⁴ V", "5·10^-4 V", "5 x 10^-4 V", "5e-4 V", "5*10^-4 V", "5 × 10⁻⁴ V"]
    {
        assert_eq!(number(text), Ok((5e-4, "V")), "{text}");
    }
    assert_eq!(number("5×10⁻⁴"), Ok((5e-4, "")));
    assert_eq!(number("5*10^-4"), Ok((5.0, "*10^-4")));
    assert_eq!(number("5*10^-4*f"), Ok((5.0, "*10^-4*f")));
    assert_eq!(number("2e3×10^2 V"), Ok((2e3, "×10^2 V")));
    let width = read("2×10⁻⁶ V + 5 x 10^+1 uV", "V").unwrap();
    assert!((width.at(0.0) - 52e-6).abs() < 1e-18);
}
