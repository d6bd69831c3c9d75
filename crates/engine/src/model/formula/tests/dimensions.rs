//! Dimensions and degrees Celsius through every operator and function.

use super::*;
use gumption_units::Dimension;

/// Formulas, and the coherent unit of their result; `any` where every dimension fits.
const RIGHT: &[(&str, &str)] = &[
    ("1", "1"),
    ("pi", "1"),
    ("0", "any"),
    ("-0", "any"),
    ("0.0", "any"),
    ("0e5", "any"),
    ("n*k", "1"),
    ("l", "m"),
    ("-l", "m"),
    ("l + d", "m"),
    ("l - 2*d", "m"),
    ("l*d", "m^2"),
    ("l/s", "m s^-1"),
    ("l/s + v", "m s^-1"),
    ("1/s + f", "s^-1"),
    ("f*s + n + 1", "1"),
    ("m*a*l", "kg m^2 s^-2"),
    ("u*i", "kg m^2 s^-3"),
    ("u/i", "kg m^2 s^-3 A^-2"),
    ("v^2/l + a", "m s^-2"),
    ("a*sin(tilt)", "m s^-2"),
    ("a*cos(tilt + θ) - a", "m s^-2"),
    ("2*pi*f*s", "1"),
    ("sin(2*pi*f*s)", "1"),
    ("(2*pi*f)^2*l - a", "m s^-2"),
    ("l^2", "m^2"),
    ("l^-2", "m^-2"),
    ("l^0", "1"),
    ("l^0 + 1", "1"),
    ("l^(1/2)*l^0.5", "m"),
    ("l^(1/3)*l^(2/3) + d", "m"),
    ("l^(2 - 1) + d", "m"),
    ("l^2^2", "m^4"),
    ("(l*l)^-0.5", "m^-1"),
    ("sqrt(l*d)", "m"),
    ("sqrt(l^2 + d^2) + l", "m"),
    ("sqrt(f)", "s^(-1/2)"),
    ("en*sqrt(f) + u", "kg m^2 s^-3 A^-1"),
    ("cbrt(l^2*d)", "m"),
    ("abs(-l)", "m"),
    ("min(l, d)", "m"),
    ("max(0, l)", "m"),
    ("max(l, 0, d)", "m"),
    ("max(0, 0)", "any"),
    ("hypot(l, d)", "m"),
    ("hypot(l, d, 2*l)", "m"),
    ("atan2(l, d)", "1"),
    ("atan2(0, l)", "1"),
    ("atan(l/d)", "1"),
    ("asin(l/d) + acos(n) + tan(tilt)", "1"),
    ("sinh(n) + cosh(n) + tanh(n)", "1"),
    ("exp(-s*f)", "1"),
    ("ln(l/d) + log10(k)", "1"),
    ("l > d", "1"),
    ("l > 0", "1"),
    ("0 <= s", "1"),
    ("(l >= 0)*l + (l < 0)*d", "m"),
    ("l == d", "1"),
    ("(l != d) + 1", "1"),
    ("0*f", "any"),
    ("0*f + l", "m"),
    ("l + 0", "m"),
    ("-0 - l", "m"),
    ("0/s", "any"),
    ("sin(0*l)", "1"),
    ("sqrt(0)*l", "any"),
    ("2^n", "1"),
    ("n^n", "1"),
    ("n^0.333", "1"),
    ("n^pi", "1"),
    ("(l/d)^n", "1"),
    ("l^(1/1.8)", "m^(5/9)"),
    ("2^0", "1"),
    ("t + dt", "K"),
    ("t - t1", "K"),
    ("l*(1 + (t - t1)/dt)", "m"),
    ("kelvin(t)^4*sigma", "kg s^-3"),
    ("5 [mm]", "m"),
    ("u/[mV]", "1"),
    ("3*[rev]*f", "s^-1"),
    ("n [deg] + tilt", "1"),
    ("(n + 1) [mm/s] + v", "m s^-1"),
    ("[h]*f/[e]", "kg m^2 s^-3 A^-1"),
    ("s/[hour] + 1", "1"),
    ("[k_B]*[N_A]*kelvin(t)", "kg m^2 s^-2 mol^-1"),
    ("m*[c]^2", "kg m^2 s^-2"),
    ("kelvin(0)", "K"),
    ("bad + l", "m"),
    ("bad*l", "any"),
    ("sin(bad) + bad^l^0", "1"),
];

/// Formulas whose dimensions do not fit, and the part that is pointed at.
const WRONG: &[(&str, &str)] = &[
    ("l + 1", "+"),
    ("1 - l", "-"),
    ("l + s", "+"),
    ("l*s + l/s", "+"),
    ("v + a*s^2", "+"),
    ("f + 1/f", "+"),
    ("l > 5", ">"),
    ("l == s", "=="),
    ("l <= v", "<="),
    ("min(l, 1)", "min"),
    ("max(0, l, s)", "max"),
    ("hypot(l, v)", "hypot"),
    ("atan2(l, 1)", "atan2"),
    ("cos(l)", "l"),
    ("tan(s)", "s"),
    ("asin(v)", "v"),
    ("acos(l/s)", "l/s"),
    ("atan(f)", "f"),
    ("sinh(m)", "m"),
    ("cosh(m)", "m"),
    ("tanh(m)", "m"),
    ("exp(-l)", "-l"),
    ("ln(u)", "u"),
    ("log10(u*i)", "u*i"),
    ("sqrt(l) + d", "+"),
    ("cbrt(l^3) + d^3", "+"),
    ("abs(l) + 1", "+"),
    ("(l > 0) + l", "+"),
    ("2^s", "s"),
    ("l^s", "s"),
    ("l^n", "n"),
    ("l^(n/n)", "n/n"),
    ("l^sqrt(4)", "sqrt(4)"),
    ("l^(2^0.5)", "2^0.5"),
    ("kelvin(f)", "f"),
    ("t > 20", ">"),
    ("t + 273.15", "+"),
    ("kelvin(t + 5)", "+"),
    ("l + 1e-300", "+"),
    ("en + u", "+"),
];

#[test]
fn formulas_whose_dimensions_fit() {
    for (text, unit) in RIGHT {
        let formula = Formula::parse(text).unwrap();
        let typing = formula.check(&scope()).unwrap_or_else(|errors| panic!("{text}: {errors:?}"));
        let dimension = typing.dimension.map_or("any".to_owned(), |d| d.to_string());
        assert_eq!(dimension, *unit, "{text}");
        assert_eq!(formula.check_names(&scope()), Ok(typing), "{text}");
    }
}

#[test]
fn formulas_whose_dimensions_do_not_fit() {
    for (text, part) in WRONG {
        let error = mistake(text);
        assert!(error.is_dimensional(), "{text}: {error}");
        assert_eq!(&text[error.span()], *part, "{text}");
        assert!(Formula::parse(text).unwrap().check_names(&scope()).is_ok(), "{text}");
    }
}

#[test]
fn typings() {
    assert!(Typing::ANY.fits(Dimension::MASS));
    assert!(Typing::of(Dimension::MASS).fits(Dimension::MASS));
    assert!(!Typing::NUMBER.fits(Dimension::MASS));
    let mut scope = Scope::new();
    scope.announce("y");
    scope.define("x", Typing::NUMBER);
    scope.define("y", Typing::ANY);
    scope.define("x", Typing::of(Dimension::TIME));
    scope.announce("x");
    assert_eq!(scope.names().collect::<Vec<_>>(), ["x", "y"]);
    assert_eq!(scope.get("x"), Some(Typing::of(Dimension::TIME)));
    assert_eq!(scope.get("z"), None);
    assert!(Formula::parse("x*y").unwrap().check(&scope).is_ok());
}
