//! The operators, functions and constants of formulas.

use gumption_engine::model::formula;
use gumption_files::{MEASURED, MeasuredConstant};

use crate::document::Document;
use crate::sheet::Sheet;

/// The description of a function, in a line.
pub(super) fn about(name: &str) -> Option<&'static str> {
    Some(match name {
        "sin" | "cos" | "tan" => "of an angle, in radians or with its unit",
        "asin" | "acos" | "atan" => "the angle, in radians",
        "atan2" => "`atan2(y, x)`: the angle of the point (x, y), from -pi to pi",
        "sinh" | "cosh" | "tanh" => "hyperbolic, of a plain number",
        "exp" => "e to a power that is a plain number",
        "ln" => "natural logarithm of a plain number above 0",
        "log10" => "logarithm to base 10 of a plain number above 0; `10*log10(x)` is a level",
        "sqrt" => "square root; of the unit as well",
        "cbrt" => "cube root; of the unit as well",
        "abs" => "absolute value",
        "min" => "the least of its arguments",
        "max" => "the greatest of its arguments",
        "hypot" => "the root of the sum of the squares of its arguments",
        "sum" => "the sum of its arguments",
        "mean" => "the mean of its arguments",
        "kelvin" => "the thermodynamic temperature of a Celsius temperature",
        "celsius" => "the Celsius temperature of a thermodynamic one",
        "re" => "the real part of a complex quantity",
        "im" => "its imaginary part",
        "arg" => "its phase, from -pi to pi",
        "conj" => "its conjugate",
        "floor" => "the largest whole number not above; `floor(x/[mm])*1 [mm]`",
        "ceil" => "the smallest whole number not below",
        "round" => "the nearest whole number, halves away from 0",
        "mod" => "`mod(x, y)`: what is left of x after whole y, with the sign of y",
        "expm1" => "exp(x) - 1, exact near 0",
        "log1p" => "ln(1 + x), exact near 0",
        "asinh" | "acosh" | "atanh" => "inverse hyperbolic, of a plain number",
        "erf" => "the error function",
        "gamma" => "the gamma function",
        "if" => "`if(c, a, b)`: a where c is not 0, else b; the other may be undefined",
        "table" => "`table(x, 'f.csv', 'x', 'y', 'linear')`, or `cubic`: between points",
        "solve" => "`solve(f, x, from, to)`: the x at which the formula f is 0",
        _ => return None,
    })
}

/// Operators in the order of precedence, the highest first.
const OPERATORS: [(&str, &str); 10] = [
    ("x^n", "power; from right to left, `2^3^2` is `2^(3^2)`"),
    ("-x", "negative; `-x^2` is `-(x^2)`"),
    ("x*y, x/y", "product and quotient, from left to right"),
    ("x + y, x - y", "sum and difference, of one dimension"),
    ("x < y, x <= y, x == y, x != y", "1 where it holds, else 0; `>` and `>=` too"),
    ("not x", "1 where x is 0, else 0"),
    ("x and y, x or y", "both, or one of them, is not 0; `and` binds tighter"),
    ("1.5 [mm]", "a number of units"),
    ("p/[hPa]", "how many of a unit"),
    ("pi", "the number"),
];

pub(super) fn document() -> Document {
    let mut document =
        Document { title: "Operators, functions, constants".to_owned(), ..Document::default() };
    document.text(
        "Formulas compute in coherent SI units; dimensions are checked through them. Names are \
         those of inputs, conditions and the equations above.",
    );
    document.section("Operators");
    let mut sheet = Sheet::default();
    sheet.text("written", OPERATORS.iter().map(|(written, _)| format!("`{written}`")));
    sheet.text("meaning", OPERATORS.iter().map(|(_, meaning)| (*meaning).to_owned()));
    document.table(sheet);
    document.section("Functions");
    let functions: Vec<_> = formula::functions().collect();
    let mut sheet = Sheet::default();
    sheet.text("function", functions.iter().map(|(name, _)| format!("`{name}`")));
    sheet.text("takes", functions.iter().map(|(_, arity)| arity.describe().to_owned()));
    let gives = |(name, _): &(&str, _)| about(name).unwrap_or_default().to_owned();
    sheet.text("gives", functions.iter().map(gives));
    document.table(sheet);
    document.section("Constants");
    document.text("The defining constants of the SI, exact (SI Brochure, 9th ed., table 1).");
    let constants: Vec<_> = formula::constants().collect();
    let mut sheet = Sheet::default();
    sheet.text("written", constants.iter().map(|of| format!("`[{}]`", of.symbol)));
    sheet.text("value", constants.iter().map(|of| format!("{:e}", of.value)));
    sheet.text("unit", constants.iter().map(|of| of.dimension.usual_unit()));
    sheet.text("is", constants.iter().map(|of| of.about.to_owned()));
    document.table(sheet);
    document.section("Measured constants");
    document.text(
        "Inputs with the values, uncertainties and correlations of CODATA 2022 \
         (physics.nist.gov/constants): `\"m_e\": {\"distribution\": \"codata\", \"constant\": \"electron \
         mass\"}`. The correlation coefficients of all that a file has come by themselves; \
         `correlations` states others. Without `unit` it is that of the table.",
    );
    let mut sheet = Sheet::default();
    sheet.text("constant", MEASURED.iter().map(|of| format!("`{}`", of.name)));
    sheet.text("or", MEASURED.iter().map(|of| format!("`{}`", of.symbol)));
    sheet.text("value", MEASURED.iter().map(|of| format!("{:e}", of.value)));
    let u = |of: &MeasuredConstant| of.relative_uncertainty() * of.value;
    sheet.text("u", MEASURED.iter().map(|of| format!("{:.1e}", u(of))));
    sheet.text("unit", MEASURED.iter().map(|of| of.unit.to_owned()));
    document.table(sheet);
    document
}
