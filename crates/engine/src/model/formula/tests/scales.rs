//! Celsius temperatures, levels, periods and angle through formulas.

use std::collections::HashMap;

use super::super::{KelvinKind, ScaleMisfit};
use super::*;
use gumption_units::Zero;

/// Quantities with scales of their own, by name and unit.
fn quantities() -> Scope {
    let units = [
        ("n", "1"),
        ("l", "m"),
        ("time", "s"),
        ("p", "hPa"),
        ("t", "degC"),
        ("t1", "degC"),
        ("tf", "degF"),
        ("T", "K"),
        ("dT", "K"),
        ("A", "1/degC"),
        ("B", "1/degC^2"),
        ("c", "ppm/degC"),
        ("S", "uV/degC"),
        ("alpha", "1/K"),
        ("R0", "ohm"),
        ("R", "ohm"),
        ("gas", "J/(kg*K)"),
        ("e", "uV"),
        ("L", "dB"),
        ("L1", "dB"),
        ("P1", "dBm"),
        ("P2", "dBm"),
        ("U1", "dBV"),
        ("loss", "dB/m"),
        ("u", "V"),
        ("u0", "V"),
        ("f", "Hz"),
        ("speed", "rpm"),
        ("omega", "rad/s"),
        ("phi", "deg"),
    ];
    let typing = |unit: &str| Typing::in_unit(&Unit::parse(unit).unwrap());
    units.into_iter().map(|(name, unit)| (name, typing(unit))).collect()
}

fn checked(text: &str) -> Result<Typing, Vec<FormulaError>> {
    Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}")).check(&quantities())
}

/// Formulas with Celsius temperatures that are right, and the unit that their results are given in.
const RIGHT: &[(&str, &str)] = &[
    ("t", "degC"),
    ("(t + t1)/2", "degC"),
    ("0.25*t + 0.75*t1", "degC"),
    ("t/3 + 2*t1/3", "degC"),
    ("t - t1", "K"),
    ("t - t1", "degC"),
    ("t + dT", "degC"),
    ("t - dT + 0.5*(t1 - t)", "degC"),
    ("kelvin(t)", "K"),
    ("kelvin((t + t1)/2)", "K"),
    ("celsius(T)", "degC"),
    ("celsius(kelvin(t) + dT)", "degC"),
    ("t/[degC]", "1"),
    ("0.061*t/[degC]", "1"),
    ("t + 5 [K]", "degC"),
    ("t - 20 [degC]", "K"),
    ("(t > 20 [degC])*l", "m"),
    ("(t > 0)*l", "m"),
    ("R0*(1 + A*t + B*t^2)", "ohm"),
    ("R0*(1 + A*t + B*t*t1)", "ohm"),
    ("R0*(1 + alpha*(t - 20 [degC]))", "ohm"),
    ("l*(1 + c*(t - t1))", "m"),
    ("S*t + e", "uV"),
    ("l*t*A", "m"),
    ("A*(t + t1)", "1"),
    ("(A + B*t)*t", "1"),
    ("(R/R0 - 1)/A", "degC"),
    ("(R/R0 - 1)/A - t", "K"),
    ("kelvin((R/R0 - 1)/A)", "K"),
    ("t + e/S", "degC"),
    ("p/(gas*kelvin(t))", "kg/m^3"),
    ("max(t, t1)", "degC"),
    ("-5 [degC] + dT", "degC"),
    ("n [degC] - t", "K"),
    ("t - t1 + T", "K"),
    ("dT - t + t1", "K"),
    ("kelvin(t) - kelvin(t1)", "degC"),
    ("kelvin(tf)", "K"),
    ("tf - t", "K"),
    ("tf", "degC"),
    ("t", "degF"),
    ("tf/[degF]", "1"),
    ("t/[degF]", "1"),
    ("(t - t1)/[K]", "1"),
    ("exp(0.061*t/[degC])*p", "hPa"),
    ("0*t", "degC"),
    ("mean(t, t1, tf)", "degC"),
    ("sum(t, -1*t1)", "K"),
];

/// Formulas with Celsius temperatures that are wrong, the part that is pointed at, and a part of
/// what is said.
const WRONG: &[(&str, &str, &str)] = &[
    ("p/(gas*t)", "gas*t", "kelvin(t)"),
    ("sqrt(2*p*gas*t)", "2*p*gas*t", "kelvin(t)"),
    ("alpha*t", "alpha*t", "coefficient per degC"),
    ("n*t", "n*t", "t - t_ref"),
    ("2*t", "2*t", "add to 2"),
    ("t + t1", "t + t1", "add to 2"),
    ("t/3 + t1/3", "t/3 + t1/3", "add to 0.666667"),
    ("-t", "-t", "add to -1"),
    ("t^2", "t^2", "kelvin(t)"),
    ("t*t1", "t*t1", "kelvin(t)"),
    ("t/t1", "t/t1", "quotient"),
    ("1/t", "1/t", "quotient"),
    ("l/t*A", "l/t", "quotient"),
    ("R0*(1 + A*t + B*t^3)", "+", "cannot be added"),
    ("1 [K^3] + t^3", "t^3", "no such power"),
    ("t + 273.15", "+", "`kelvin(t)`"),
    ("sqrt(t)", "t", "`sqrt` does not take it"),
    ("exp(t)", "t", "`exp` does not take it"),
    ("abs(t)", "t", "`abs` does not take it"),
    ("hypot(t, t1)", "t", "`hypot` does not take it"),
    ("T - t", "T - t", "kelvin(...)"),
    ("kelvin(t) - t1", "-", "kelvin(t1)"),
    ("t + kelvin(t1)", "+", "kelvin(t)"),
    ("kelvin(t - t1)", "t - t1", "difference"),
    ("celsius(t - t1)", "t - t1", "difference"),
    ("t > T", ">", "kelvin(t)"),
    ("max(t, T)", "max", "kelvin(t)"),
    ("t + 5 [degC]", "t + 5 [degC]", "in `K`"),
    ("T/[degC]", "T", "celsius(T)/[degC]"),
    ("kelvin(t)/[degC]", "kelvin(t)", "celsius(kelvin(t))/[degC]"),
    ("t/[K]", "t/[K]", "t/[degC]"),
    ("0.061*t", "0.061*t", "add to 0.061"),
    ("(t > t1)*t", "(t > t1)*t", "product"),
    ("c*(t - t1)*t", "c*(t - t1)*t", "product"),
    ("l*t + l*dT", "l*t", "product"),
    ("2*tf", "2*tf", "add to 2"),
    ("t^n", "n", "exponent"),
];

#[test]
fn celsius_temperatures_that_are_right() {
    assert!(RIGHT.len() >= 40);
    for (text, unit) in RIGHT {
        let typing = checked(text).unwrap_or_else(|errors| panic!("{text}: {}", errors[0]));
        let unit = Unit::parse(unit).unwrap();
        assert!(typing.fits(unit.dimension()), "{text}");
        assert_eq!(typing.reported_in(&unit), Ok(()), "{text} in {unit}");
        assert_eq!(Formula::parse(text).unwrap().check_names(&quantities()), Ok(typing), "{text}");
    }
}

#[test]
fn celsius_temperatures_that_are_wrong() {
    assert!(WRONG.len() >= 30);
    for (text, part, said) in WRONG {
        let errors = checked(text).expect_err(text);
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        let error = &errors[0];
        assert!(error.is_dimensional(), "{text}");
        assert_eq!(&text[error.span()], *part, "{text}");
        assert!(error.to_string().contains(said), "{text}: {error}");
    }
}

#[test]
fn results_that_their_unit_does_not_fit() {
    let misfit = |text: &str, unit: &str| {
        let typing = checked(text).unwrap_or_else(|errors| panic!("{text}: {}", errors[0]));
        typing.reported_in(&Unit::parse(unit).unwrap()).err()
    };
    let kelvin = |thermodynamic| Some(ScaleMisfit::KelvinInCelsius { thermodynamic });
    assert_eq!(misfit("t", "K"), Some(ScaleMisfit::CelsiusInKelvin));
    assert_eq!(misfit("(t + t1)/2", "mK"), Some(ScaleMisfit::CelsiusInKelvin));
    assert_eq!(misfit("celsius(T)", "K"), Some(ScaleMisfit::CelsiusInKelvin));
    assert_eq!(misfit("kelvin(t)", "degC"), kelvin(true));
    assert_eq!(misfit("T", "degC"), kelvin(false));
    assert_eq!(misfit("1/alpha", "degC"), kelvin(false));
    assert_eq!(misfit("u/u0", "dB"), Some(ScaleMisfit::RatioAsLevel));
    assert_eq!(misfit("20*log10(u/u0)", "dB"), None);
    assert_eq!(misfit("20*log10(u/u0)", "Np"), None);
    assert_eq!(misfit("10*n*log10(u/u0)", "dB"), None);
    assert_eq!(misfit("10*log10(u/u0)*log10(u/u0)", "dB"), None);
    assert_eq!(misfit("3*n*log10(u/u0)", "dB"), Some(ScaleMisfit::RatioAsLevel));
    assert_eq!(misfit("20*log10(u/u0)", "1"), None);
    assert_eq!(misfit("L", "%"), Some(ScaleMisfit::LevelAsRatio));
    assert_eq!(misfit("n [dB]", "dB"), None);
    assert_eq!(misfit("10*log10(u*u/(50 [ohm])/1 [mW])", "dBm"), None);
    assert!(matches!(misfit("P1", "dB"), Some(ScaleMisfit::OtherReference { .. })));
    assert!(matches!(misfit("P1", "dBV"), Some(ScaleMisfit::OtherReference { .. })));
    assert_eq!(misfit("P1 - P2", "dB"), None);
    assert_eq!(misfit("P1 + L", "dBm"), None);
    assert_eq!(misfit("P1 + L", "dBW"), None);
    assert_eq!(misfit("loss", "dB/km"), None);
    let turns =
        |text: &str, unit: &str| matches!(misfit(text, unit), Some(ScaleMisfit::Turns { .. }));
    assert!(turns("speed", "Hz"));
    assert!(turns("n*speed", "Hz"));
    assert!(turns("3*speed", "kHz"));
    assert!(turns("phi/time", "Hz"));
    assert!(turns("f", "rad/s"));
    assert!(turns("f", "rpm"));
    assert!(turns("f*time", "deg"));
    assert!(turns("360*f*time", "deg"));
    assert!(turns("sqrt(speed^2)", "Hz"));
    assert!(turns("speed^2/speed", "Hz"));
    assert!(turns("sqrt(speed^2 + (2*speed)^2)", "Hz"));
    assert!(turns("1/(2/speed)", "Hz"));
    // 1 over 60 rpm is 1 s for a revolution and 0.159 s for a radian
    let ambiguous = |text: &str, unit: &str| {
        matches!(misfit(text, unit), Some(ScaleMisfit::PowerOfRevolutions { .. }))
    };
    assert!(ambiguous("1/speed", "s"));
    assert!(ambiguous("60/speed", "s"));
    assert!(ambiguous("speed^2", "1/s^2"));
    assert!(ambiguous("sqrt(1/speed)", "s^(1/2)"));
    for (text, unit) in [
        ("speed/(2*pi)", "Hz"),
        ("speed/[rev]", "Hz"),
        ("2*pi*f", "rad/s"),
        ("f*[rev]", "rpm"),
        ("2*pi*f*time", "deg"),
        ("speed", "rad/s"),
        ("f", "1/s"),
        ("n/time", "rpm"),
        ("f*time", "1"),
        ("phi/(2*pi*f)", "s"),
        ("1 [rev]/speed", "s"),
        ("1 [rad]/speed", "s"),
        ("2*pi/speed", "s"),
        ("1/(speed/(2*pi))", "s"),
        ("1/speed*2*pi", "s"),
        ("1/speed", "s/rev"),
        ("1/omega", "s"),
        ("phi/speed", "s"),
        ("phi*(1/speed)", "s"),
        ("n/speed", "s"),
        ("speed^2", "rad^2/s^2"),
    ] {
        assert_eq!(misfit(text, unit), None, "{text} in {unit}");
    }
}

/// A level above a power or a voltage is that of the formula's reference, and a ratio is above none.
#[test]
fn levels_name_their_reference() {
    let misfit = |text: &str, unit: &str| {
        let typing = checked(text).unwrap_or_else(|errors| panic!("{text}: {}", errors[0]));
        typing.reported_in(&Unit::parse(unit).unwrap()).err()
    };
    for (text, unit) in [
        ("10*log10(u^2/R/2 [mW])", "dBm"),
        ("10*log10(u^2/R/(2*[mW]))", "dBm"),
        ("20*log10(u/0.7746 [V])", "dBV"),
        ("10*log10(u/1 [V])", "dBV"),
        ("20*log10(u^2/R/1 [mW])", "dBm"),
        ("20*log10(p/20 [uPa])", "dBV"),
        ("20*log10(u/0.7746 [V]) + L", "dBV"),
    ] {
        let found = misfit(text, unit);
        let is_right = matches!(found, Some(ScaleMisfit::ReferenceOfNoUnit { .. }));
        assert!(is_right, "{text} in {unit}: {found:?}");
        assert_eq!(misfit(text, "dB"), None, "{text}");
    }
    for (text, unit) in [
        ("20*log10(u/u0)", "dBm"),
        ("20*log10(u/u0)", "dBV"),
        ("10*log10(u*u/(u0*u0))", "dBW"),
        ("L", "dBm"),
        ("L + L1", "dBm"),
        ("n*L", "dBuV"),
        ("loss*l", "dBm"),
        ("3 [dB]", "dBm"),
        ("P1 - P2", "dBm"),
        ("10*log10(u/[V]) - 10*log10(u0/[V])", "dBm"),
        ("20*log10(u/[V]) - 20*log10(u0/[V])", "dBV"),
        ("P1 - 10*log10(u^2/R/[mW])", "dBm"),
    ] {
        let found = misfit(text, unit);
        let is_right = matches!(found, Some(ScaleMisfit::RatioAboveReference { .. }));
        assert!(is_right, "{text} in {unit}: {found:?}");
        assert_eq!(misfit(text, "dB"), None, "{text}");
    }
    for (text, unit) in [
        ("10*log10(u^2/R/[mW])", "dBm"),
        ("10*log10(u^2/R/0.001 [W])", "dBm"),
        ("10*log10(abs(u^2/R)/[mW])", "dBm"),
        ("10*log10(u^2/(R*1 [mW]))", "dBm"),
        ("20*log10(u/sqrt(50 [ohm]*1 [mW]))", "dBm"),
        ("10*log10(u^2/1 [V^2])", "dBV"),
        ("20*log10(u/1e-6 [V])", "dBuV"),
        ("20*log10(u/[uV]) + L", "dBuV"),
        ("10*log10(n)", "dBm"),
        ("0 [dBm] + L", "dBm"),
        ("P1 + 20*log10(u/u0)", "dBm"),
        ("(10*log10(u^2/R/[mW]) + P1)/2", "dBm"),
        // the reference of these is not a unit's
        ("20*log10(u/u0)", "dBFS"),
        ("20*log10(u/2.5 [V])", "dBFS"),
        ("L", "dBi"),
        ("20*log10(u/u0)", "dBc"),
    ] {
        assert_eq!(misfit(text, unit), None, "{text} in {unit}");
    }
    // also of a ratio that has a name of its own
    let ratio = checked("u/u0").unwrap();
    let scope = Scope::from_iter([("ratio", ratio)]);
    let level = Formula::parse("20*log10(ratio)").unwrap().check(&scope).unwrap();
    let said = level.reported_in(&Unit::parse("dBV").unwrap()).unwrap_err().to_string();
    assert!(said.contains("above 1 V") && said.contains("20*log10(V/1 [V])"), "{said}");
}

#[test]
fn levels_and_turns_that_do_not_go_together() {
    let table = [
        ("L + 3", "+", "3 [dB]"),
        ("L - u/u0", "-", "20*log10(u/u0)"),
        ("n > L", ">", "plain number"),
        ("exp(L)", "L", "10^(L/20)"),
        ("sin(L)", "L", "is a level"),
        ("10^L", "L", "10^(L/10)"),
        ("2^(L/20)", "L/20", "10^(L/20)"),
        ("10^(L*L/20)", "L*L/20", "10^(L/20)"),
        ("20*log10(L)", "L", "is a level"),
        ("f + omega", "+", "2*pi*f"),
        ("speed - f", "-", "speed/(2*pi)"),
        ("max(f, omega)", "max", "counts periods"),
        ("P1 + L > U1", ">", "dBV"),
        ("P1 - U1", "-", "dBm"),
        ("f/[rpm]", "f/[rpm]", "2*pi*f"),
        ("f/(3000 [rpm])", "f/(3000 [rpm])", "2*pi*f"),
        ("speed/[Hz]", "speed/[Hz]", "speed/(2*pi)"),
        ("speed - 100 [1/min]", "-", "counts revolutions"),
        ("exp(L/20)", "L/20", "`10^(L/10)` of a level L"),
        ("10^(P1/10)*1 [W]", "10^(P1/10)*1 [W]", "`10^(P1/10)*1 [mW]`"),
        ("[V]*10^(0.1*U1)", "[V]*10^(0.1*U1)", "`10^(U1/20)*1 [V]`"),
        ("10^(U1/20)*1 [mV]", "10^(U1/20)*1 [mV]", "`10^(U1/20)*1 [V]`"),
        ("10^(P1/20)*1 [mW]", "10^(P1/20)*1 [mW]", "`10^(P1/10)*1 [mW]`"),
        ("10^(P1/10) + 10^(U1/20)", "10^(P1/10)", "`10^(P1/10)*1 [mW]` and `10^(U1/20)*1 [V]`"),
    ];
    for (text, part, said) in table {
        let errors = checked(text).expect_err(text);
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        assert_eq!(&text[errors[0].span()], part, "{text}");
        assert!(errors[0].to_string().contains(said), "{text}: {}", errors[0]);
    }
    for right in [
        "L + L1",
        "(L + L1)/2",
        "n*L",
        "-L",
        "abs(L)",
        "max(L, L1, 0)",
        "loss*l + L",
        "L + 3 [dB]",
        "u*10^(L/20)",
        "10^(-L/10)",
        "10^(-(L - L1)/20)",
        "10^(0.05*L)",
        "exp(L/[Np])",
        "L/L1",
        "10^((P1 + L)/10)*1 [mW]",
        "-20*log10(u/u0) + L",
        "log10(u/u0)*20",
        "L + 10*n*log10(u/u0)",
        "n*10*log10(u/u0) + L",
        "L - (10*n)*(log10(u/u0)/n)",
        "L + 20*(n*log10(u/u0))",
        "L + -20/n*log10(u/u0)",
        "(P1 + P2)/2",
        "f*[rev]/[rpm]",
        "f/[1/s]",
        "speed/[rad/s]",
        "omega/f",
        "10^(P1/10)*0.001 [W]",
        "10^(P1/10)*2 [W]",
        "10^((P1 - 30 [dB])/10)*1 [W]",
        "speed/[rpm] - 3000",
        "f/(360 [1/rev])",
        "10^(P1/20)*1 [V]",
        "10*log10(10^(P1/10) + 10^(P2/10))",
        "10*log10(10^(P1/10)*10^(L/10) + 10^(P2/10))",
        "10^(U1/10)*1 [V^2]",
        "10^(L/10)*1 [W]",
    ] {
        assert!(checked(right).is_ok(), "{right}: {:?}", checked(right));
    }
}

/// Values of 20 degC, 10 degC, 68 degF and the like, as formulas compute with them.
fn value(text: &str) -> f64 {
    let values: HashMap<String, f64> = [
        ("t", 20.0),
        ("t1", 10.0),
        ("tf", 20.0),
        ("T", 293.15),
        ("dT", 2.0),
        ("L", 40.0),
        ("f", 50.0),
        ("n", 3.0),
        ("time", 0.25),
    ]
    .into_iter()
    .map(|(name, value)| (name.to_owned(), value))
    .collect();
    Formula::parse(text).unwrap().evaluate(&quantities(), &values).unwrap()
}

#[test]
fn values_of_units_in_brackets() {
    for (text, right) in [
        ("t/[degC]", 20.0),
        ("t/[degF]", 68.0),
        ("(t - t1)/[degF]", 18.0),
        ("tf/[degC]", 20.0),
        ("68 [degF]/[degC]", 20.0),
        ("-40 [degF]/[degC]", -40.0),
        ("(n + 209) [degF]/[degC]", 100.0),
        ("kelvin(-5 [degC])", 268.15),
        ("celsius(T)", 20.0),
        ("celsius(T)/[degF]", 68.0),
        ("celsius(kelvin(t))", 20.0),
        ("celsius(5 [degC])", 5.0),
        ("1.5 [mm]", 1.5e-3),
        ("n [km/h]", 3.0 / 3.6),
        ("10^(L/20)", 100.0),
        ("L/[Np]", 40.0 / 8.685889638065037),
        ("2 [Np]/[dB]", 2.0 * 8.685889638065037),
        ("f*[rev]", 100.0 * std::f64::consts::PI),
        ("[rev]/[deg]", 360.0),
        ("time/[hour]", 0.25 / 3600.0),
        // products and quotients of the exact values, in double precision
        ("mean(n, 4, 5)", 4.0),
        ("2*sum(n, 4)^2/mean(1, 2)", 2.0 * 49.0 / 1.5),
        ("[h]*[c]", 6.62607015e-34 * 299792458.0),
        ("[k_B]*[N_A]", 1.380649e-23 * 6.02214076e23),
        ("2*[e]/[h]", 2.0 * 1.602176634e-19 / 6.62607015e-34),
    ] {
        let found = value(text);
        // a few roundings of numbers up to 300
        assert!((found - right).abs() <= 1e-13 * right.abs().max(1e-30), "{text}: {found}");
    }
}

#[test]
fn brackets_that_are_wrong() {
    let said = |text: &str| match Formula::parse(text) {
        Err(error) => (text[error.span()].to_owned(), error.to_string()),
        Ok(formula) => {
            let error = formula.check(&quantities()).unwrap_err().remove(0);
            (text[error.span()].to_owned(), error.to_string())
        }
    };
    for (text, part, words) in [
        ("5 [h]", "5 [h]", "`5 [hour]` or `5*[h]`"),
        ("1.5 [mm]^2", "1.5 [mm]", "`1.5 [(mm)^2]` or `(1.5 [mm])^2`"),
        ("5 [furlong]", "[furlong]", "is not a known unit"),
        ("n*[l + 1]", "[l + 1]", "parentheses"),
        ("l [mm]", "l [mm]", "`l/[mm]`"),
        ("L [dB]", "L [dB]", "`L/[dB]`"),
        ("2*[]", "[]", "is not allowed here"),
        ("3 [c]", "3 [c]", "`3*[c]`"),
        ("l/[h] + l", "+", "length"),
        ("n*[mm", "[", "write a unit between"),
    ] {
        let (found, message) = said(text);
        assert_eq!(found, part, "{text}: {message}");
        assert!(message.contains(words), "{text}: {message}");
    }
}

#[test]
fn estimates_are_shifted_to_the_zero_of_their_unit() {
    let shift =
        |text: &str, unit: &str| checked(text).unwrap().shift_to(&Unit::parse(unit).unwrap());
    assert_eq!(shift("t", "K"), Ok(273.15));
    assert_eq!(shift("T", "degC"), Ok(-273.15));
    assert_eq!(shift("kelvin(t)", "degC"), Ok(-273.15));
    assert_eq!(shift("t - t1", "degC"), Ok(0.0));
    assert_eq!(shift("t - t1", "K"), Ok(0.0));
    assert_eq!(shift("t", "degC"), Ok(0.0));
    assert_eq!(shift("P1", "dBW"), Ok(-30.0));
    assert_eq!(shift("u/u0", "dB"), Err(ScaleMisfit::RatioAsLevel));
    let typing = checked("t - t1").unwrap();
    assert_eq!((typing.zero, typing.kelvin), (None, KelvinKind::Difference));
    assert_eq!(checked("t + dT").unwrap().zero, Some(Zero::Celsius));
}
