//! What formulas compute, directly and as recorded programs.

use std::collections::HashMap;

use super::*;
use crate::model::typed::Typed;
use crate::model::typed::example::Projection;
use crate::model::{NumberForm, Program, Recorder, in_unit, recorded_values, variables};
use crate::number::{Dual, Number};

fn constant(text: &str) -> f64 {
    let formula = Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    formula.evaluate(&Scope::new(), &HashMap::new()).unwrap()
}

#[test]
fn constants() {
    // exact in binary, or the same operation on the same numbers
    let table = [
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("(-2)^3", -8.0),
        ("(-2)^-3", -0.125),
        ("(-1)^63", -1.0),
        ("4^0.5", 2.0),
        ("4^(1/2)", 2.0),
        ("4^-0.5", 0.5),
        ("0^0", 1.0),
        ("2^65", 2.0 * f64::from(1 << 30) * f64::from(1 << 30) * 16.0),
        ("1 + 2*3 - 4/8", 6.5),
        ("10 - 4 - 3", 3.0),
        ("16/4/2", 2.0),
        ("pi", std::f64::consts::PI),
        ("π/2", std::f64::consts::FRAC_PI_2),
        ("sqrt(2)", std::f64::consts::SQRT_2),
        ("cbrt(-27)", -3.0),
        ("abs(-3)", 3.0),
        ("min(3, 1, 2)", 1.0),
        ("max(3, 1, 4, 2)", 4.0),
        ("hypot(3, 4)", 5.0),
        ("hypot(2, 3, 6)", 7.0),
        ("atan2(1, -1)", 0.75 * std::f64::consts::PI),
        ("ln(1) + log10(1000) + exp(0)", 4.0),
        ("sin(0) + cos(0) + tan(0)", 1.0),
        ("asin(1) - acos(0)", 0.0),
        ("sinh(0) + cosh(0) + tanh(0) + atan(0)", 1.0),
        ("1 < 2", 1.0),
        ("2 < 1", 0.0),
        ("2 > 1", 1.0),
        ("1 > 1", 0.0),
        ("1 >= 1", 1.0),
        ("1 <= 0", 0.0),
        ("1 == 1", 1.0),
        ("1 != 1", 0.0),
        ("(1 < 2)*(2 < 3)*7", 7.0),
        ("kelvin(0)", 273.15),
        ("kelvin(kelvin(0))", 273.15),
        ("2^kelvin(0)", Number::pow(2.0, 273.15)),
        ("1e-3*1E3", 1.0),
        ("1 < 2 and 2 < 3 or 1/0", 1.0),
        ("2 and not 3", 0.0),
        ("not 1 < 2", 0.0),
        ("0 or 5", 1.0),
        ("if(0, 1/0, 7)", 7.0),
        ("if(2 > 1, 7, sqrt(-1))", 7.0),
        ("[g_n]/[m]*[s]^2", 9.80665),
        ("solve(a^2 - 2, a, 0, 2)", std::f64::consts::SQRT_2),
    ];
    for (text, expected) in table {
        assert_eq!(constant(text), expected, "{text}");
    }
    assert!(constant("0/0").is_nan());
    assert!(constant("sqrt(-1)").is_nan());
}

#[test]
fn kelvin_adds_only_to_degrees_celsius() {
    let mut scope = scope();
    scope.define("alone", Typing::ANY);
    let values: HashMap<String, f64> =
        [("t", 20.0), ("t1", 10.0), ("dt", 2.0), ("alone", 1.0), ("n", 3.0)]
            .into_iter()
            .map(|(name, value)| (name.to_owned(), value))
            .collect();
    let table = [
        ("kelvin(t)", 20.0 + 273.15),
        ("kelvin(t + dt)", 22.0 + 273.15),
        ("kelvin((t + t1)/2)", 15.0 + 273.15),
        ("kelvin(t - t1)", 10.0 + 273.15),
        ("kelvin(dt)", 2.0),
        ("kelvin(kelvin(t) + dt)", 20.0 + 273.15 + 2.0),
        ("kelvin(t)*kelvin(dt)", (20.0 + 273.15) * 2.0),
        // where units are not checked
        ("kelvin(t + 5)", 25.0 + 273.15),
        ("kelvin(n)", 3.0 + 273.15),
        ("kelvin(20)", 20.0 + 273.15),
        ("kelvin(alone)", 1.0 + 273.15),
    ];
    for (text, expected) in table {
        let formula = Formula::parse(text).unwrap();
        assert_eq!(formula.evaluate(&scope, &values), Ok(expected), "{text}");
    }
}

#[test]
fn what_cannot_be_computed_is_an_error() {
    let evaluate = |text: &str| {
        Formula::parse(text).unwrap().evaluate::<f64>(&scope(), &HashMap::new()).unwrap_err()
    };
    assert_eq!(evaluate("1 + n").span(), 4..5);
    assert!(
        matches!(evaluate("titl"), FormulaError::UnknownName { nearest, .. } if nearest == ["tilt"])
    );
    assert!(matches!(evaluate("log(1)"), FormulaError::UnknownFunction { .. }));
    assert!(matches!(evaluate("sin(1, 2)"), FormulaError::ArgumentCount { found: 2, .. }));
    assert!(matches!(evaluate("2^sin()"), FormulaError::ArgumentCount { found: 0, .. }));
    assert!(matches!(evaluate("kelvin()"), FormulaError::ArgumentCount { found: 0, .. }));
}

/// Formulas of x, y and z that use every operation.
const FORMULAS: &[&str] = &[
    "x + y*z - x/y",
    "-x^2 + (-x)^3 - x^-2",
    "x^0.5 + y^(1/3) + z^y + 2^x + x^0 + x^1 + x^64 + x^70",
    "sin(x)*cos(y) + tan(z) - asin(x/9) + acos(y/9) - atan(z)",
    "atan2(x, y)*hypot(x, y, z) + sinh(x) - cosh(y) + tanh(z)",
    "exp(-x) + ln(y) + log10(z) + sqrt(x*y) + cbrt(z) + abs(x - y)",
    "min(x, y, z) + 2*max(x, y, z)",
    "(x < y) + 2*(x <= y) + 4*(x > y) + 8*(x >= y) + 16*(x == y) + 32*(x != y)",
    "kelvin(x) + pi*kelvin(kelvin(y))",
    "sin(x*y) + sin(x*y) + cos(x*y)",
    "floor(7*x) + ceil(y) + round(z) + mod(x, z) + mod(-y, x)",
    "expm1(x) + log1p(y) + asinh(z) + acosh(1 + x) + atanh(y/9) + erf(z) + gamma(x)",
    "if(x < y, sqrt(y - x), ln(x)) + if(x == y, 1/(x - y), y)*if(not (x < y) and z > 1, x, z)",
    "solve(q^3 + x*q - y, q, 0, 9) + z*solve(exp(-r) - r/x, r, 0 - z, 5*z)",
    "solve(solve(p^2 - q - y, p, 0, 99) - 1.5*z - x, q, 0 - y, 999)",
];

/// Values and derivatives of mpmath 1.3 (30 digits). libm is good to an ulp or two, its gamma function
/// to some tens: 5e-15 relative.
#[test]
fn functions_of_one_number_against_mpmath() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let table = [
        ("expm1(x)", 1e-7, 1.000_000_050_000_001_6e-7, 1.000_000_100_000_005),
        ("log1p(x)", 1e-7, 9.999_999_500_000_033e-8, 0.999_999_900_000_01),
        ("asinh(x)", 0.7, 0.652_666_566_082_355_8, 0.819_231_920_519_040_5),
        ("acosh(x)", 1.7, 1.123_230_982_587_295_9, 0.727_392_967_453_308),
        ("atanh(x)", 0.7, 0.867_300_527_694_053_1, 1.960_784_313_725_49),
        ("erf(x)", 0.7, 0.677_801_193_837_418_4, 0.691_274_860_410_538_6),
        ("gamma(x)", 4.3, 8.855_343_360_454_035, 11.847_145_839_698_407),
        ("gamma(x)", -1.5, 2.363_271_801_207_354_7, 1.661_750_260_668_596_5),
        ("floor(x)", -1.5, -2.0, 0.0),
        ("ceil(x)", -1.5, -1.0, 0.0),
        ("round(x)", -1.5, -2.0, 0.0),
        ("round(x)", 2.5, 3.0, 0.0),
        ("mod(x, 2*pi)", 7.0, 7.0 - 2.0 * std::f64::consts::PI, 1.0),
        ("mod(-7, x)", 4.0, 1.0, 2.0),
        ("mod(x, -4)", 7.0, -1.0, 1.0),
        ("if(x > 0, x, -x)", -3.0, 3.0, -1.0),
    ];
    for (text, x, value, slope) in table {
        let program = program(text, &scope);
        let (values, gradients) = program.gradients(&[x, 1.0, 1.0]);
        let close = |a: f64, b: f64| (a - b).abs() <= 5e-15 * b.abs();
        assert!(close(values[0], value), "{text}: {}", values[0]);
        assert!(close(gradients[0][0], slope), "{text}: slope {}", gradients[0][0]);
    }
}

/// What is not taken may be without a value, or steep, and nothing is heard of it.
#[test]
fn only_the_branch_that_is_taken_counts() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let of = program("if(x >= 0, sqrt(x), -sqrt(-x)) + 0*y", &scope);
    let (values, gradients) = of.gradients(&[-4.0, 1.0, 1.0]);
    assert_eq!((values[0], gradients[0][0]), (-2.0, 0.25));
    let (values, gradients) = of.gradients(&[4.0, 1.0, 1.0]);
    assert_eq!((values[0], gradients[0][0]), (2.0, 0.25));
    assert_eq!(of.first_undefined(&[-4.0, 1.0, 1.0]), None);
    // of the branch that is taken it is said where it has no value, not of the other
    let both = program("if(y > 0, ln(z), sqrt(x))", &scope);
    assert_eq!(both.first_undefined(&[-4.0, 1.0, -1.0]).as_deref(), Some("ln of -1"));
    assert_eq!(both.first_undefined(&[-4.0, -1.0, -1.0]).as_deref(), Some("sqrt of -4"));
    // infinitely steep at its end
    let steep = program("if(x > 0, sqrt(x), y)", &scope);
    assert_eq!(steep.gradients(&[0.0, 3.0, 1.0]).1[0], [0.0, 1.0, 0.0]);
    // a condition without a value is no decision
    assert!(program("if(sqrt(x), 1, 2)", &scope).evaluate(&[-1.0, 0.0, 0.0])[0].is_nan());
}

/// The measurand of an implicit equation: the derivatives are those of the explicit solution.
#[test]
fn implicit_equations() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    // w exp(w) = x: Lambert's function, W(1) = 0.567143290409783873 (mpmath), W' = W/(x (1 + W))
    let of = program("solve(w*exp(w) - x, w, 0, 2)", &scope);
    let (values, gradients) = of.gradients(&[1.0, 0.0, 0.0]);
    let w = 0.567_143_290_409_783_9;
    assert!((values[0] - w).abs() < 3e-16);
    assert!((gradients[0][0] - w / (1.0 + w)).abs() < 1e-15);
    // Callendar-Van Dusen below 0 degC (IEC 60751): 60.256 ohm is -100 degC
    let scope = Scope::from_iter([
        ("x", Typing::in_unit(&Unit::parse("ohm").unwrap())),
        ("y", Typing::NUMBER),
        ("z", Typing::NUMBER),
    ]);
    let formula = Formula::parse(
        "solve(100 [ohm]*(1 + 3.9083e-3*(t/[degC]) - 5.775e-7*(t/[degC])^2 \
         - 4.183e-12*(t/[degC] - 100)*(t/[degC])^3) - x, t, -200 [degC], 0 [degC])",
    )
    .unwrap();
    let typing = formula.check(&scope).unwrap();
    assert!(typing.is_celsius());
    let values = HashMap::from([("x".to_owned(), 60.256)]);
    let t: f64 = formula.evaluate(&scope, &values).unwrap();
    // the table of the standard gives whole milliohms: half of one is 1.3 mK
    assert!((t + 100.0).abs() < 2e-3, "{t}");
}

fn program(text: &str, scope: &Scope) -> Program {
    let recorder = Recorder::default();
    let values = ["x", "y", "z"].into_iter().zip(0..);
    let values = values.map(|(name, i)| (name.to_owned(), recorder.variable(i))).collect();
    let result = Formula::parse(text).unwrap().record(scope, &values).unwrap();
    recorder.program(3, &[result])
}

#[test]
fn programs_compute_what_formulas_do() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let points = [[1.5, 0.7, 2.5], [0.25, 3.0, 0.125], [1.0, 1.0, 1.0], [2.0, 8.0, 4.5]];
    for text in FORMULAS {
        let formula = Formula::parse(text).unwrap();
        let program = program(text, &scope);
        for point in points {
            let direct = |values: &HashMap<String, f64>| formula.evaluate(&scope, values).unwrap();
            let named = ["x", "y", "z"].map(str::to_owned).into_iter();
            let direct = direct(&named.clone().zip(point).collect());
            assert_eq!(program.evaluate(&point)[0].to_bits(), direct.to_bits(), "{text}");

            // the gradient: dual numbers straight through the formula
            let duals = std::array::from_fn::<_, 3, _>(|i| Dual::<3>::variable(point[i], i));
            let direct = formula.evaluate(&scope, &named.zip(duals).collect()).unwrap();
            assert_eq!(program.gradients(&point).1[0], direct.gradient, "{text}");
        }
    }
}

#[test]
fn gradients_of_powers() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let slope = |text: &str, x: f64| program(text, &scope).gradients(&[x, 1.0, 1.0]).1[0][0];
    assert_eq!(slope("x^2", -3.0), -6.0);
    assert_eq!(slope("x^3", 0.0), 0.0);
    assert_eq!(slope("x^0.5", 4.0), 0.25);
    assert_eq!(slope("x^-1", -2.0), -0.25);
    assert_eq!(slope("x^(4 - 2)", -3.0), -6.0);
    assert_eq!(slope("abs(x)", 0.0), 0.0);
    assert_eq!(slope("max(0, x)", 0.0), 0.0);
}

#[test]
fn parts_that_are_equal_are_recorded_once() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    // x y, its sine and cosine, two sums
    assert_eq!(program("sin(x*y) + sin(x*y) + cos(x*y)", &scope).operations(), 5);
    // constants take no operation
    assert_eq!(program("x*(2*pi/360)", &scope).operations(), 1);
}

#[test]
fn a_power_of_one_half_is_the_square_root() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let undefined = |text: &str| program(text, &scope).first_undefined(&[-4.0, 1.0, 1.0]);
    assert_eq!(undefined("x^(1/2)").as_deref(), Some("sqrt of -4"));
    assert_eq!(undefined("x^0.25").as_deref(), Some("-4 ^ 0.25"));
    assert_eq!(undefined("x^-3"), None);
}

/// What is undefined is named in short texts, however large or small its numbers.
#[test]
fn undefined_operations_are_named_in_short() {
    let scope = Scope::from_iter(["x", "y", "z"].map(|name| (name, Typing::NUMBER)));
    let undefined = |text: &str| program(text, &scope).first_undefined(&[1e308, -2.5e-9, 1.0]);
    assert_eq!(undefined("x*10").as_deref(), Some("1e308 * 10"));
    assert_eq!(undefined("sqrt(y)").as_deref(), Some("sqrt of -2.5e-9"));
    assert_eq!(undefined("x + (1.7e308 - z)").as_deref(), Some("1e308 + 1.7e308"));
}

/// The inclined plane as formulas is the typed measurement: the same program, so the same bits.
#[test]
fn formulas_of_the_inclined_plane_are_the_typed_model() {
    let typed = Typed::of::<Projection<f64>>().model().unwrap();
    let scope: Scope = typed
        .inputs
        .iter()
        .map(|input| (input.quantity.name.as_str(), Typing::in_unit(&input.quantity.unit)))
        .collect();
    let recorder = Recorder::default();
    let values =
        recorded_values(&recorder, &typed.inputs, &[], NumberForm::Coherent).into_iter().collect();
    let formulas = [
        "abs(a_ref*sin(tilt)*cos(rotation))",
        "abs(a_ref*sin(tilt)*sin(rotation))",
        "abs(a_ref*cos(tilt))",
    ];
    let results: Vec<_> = formulas
        .iter()
        .zip(&typed.outputs)
        .map(|(text, output)| {
            let formula = Formula::parse(text).unwrap();
            let typing = formula.check(&scope).unwrap();
            assert_eq!(typing.dimension, Some(output.quantity.unit.dimension()));
            in_unit(formula.record(&scope, &values).unwrap(), &output.quantity.unit, Typing::NUMBER)
        })
        .collect();
    let program = recorder.program(variables(&typed.inputs, &[]), &results);
    assert_eq!(program.operations(), typed.program.operations());
    for point in [[10.0, 35.0, 20.0], [9.81, 0.0, 90.0], [-3.5, 123.4, 271.0]] {
        let bits = |program: &Program| -> Vec<u64> {
            program.evaluate(&point).iter().map(|y: &f64| y.to_bits()).collect()
        };
        assert_eq!(bits(&program), bits(&typed.program));
        assert_eq!(program.gradients(&point), typed.program.gradients(&point));
    }
}

/// Parts that depend on nothing and have no value; of a formula with a branch that need not be taken
/// nothing is said.
#[test]
fn parts_without_a_value() {
    let scope = Scope::from_iter([("x", Typing::NUMBER)]);
    for (text, part) in [
        ("asin(2)*x", "`asin(2)` has no value"),
        ("x + 1/0", "`1/0` is infinite"),
        ("x*sqrt(1 - 3)", "`sqrt(1 - 3)` has no value"),
        ("x + log10(0)", "`log10(0)` is infinite"),
    ] {
        let errors = Formula::parse(text).unwrap().check(&scope).unwrap_err();
        assert!(errors[0].to_string().contains(part), "{}", errors[0]);
    }
    for text in ["if(x > 0, x, 1/0)", "x/0", "asin(x)", "1/3*x"] {
        assert!(Formula::parse(text).unwrap().check(&scope).is_ok(), "{text}");
    }
}
