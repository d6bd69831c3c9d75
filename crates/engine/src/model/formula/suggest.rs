//! What may be meant by a name that is not known.

use super::function::Function;
use gumption_units::all_nearest;

/// Names of functions elsewhere, and what they are here; none where nothing corresponds.
const ELSEWHERE: &[(&str, &[&str])] = &[
    ("log", &["ln", "log10"]),
    ("lg", &["log10"]),
    ("lb", &["ln(x)/ln(2)"]),
    ("log2", &["ln(x)/ln(2)"]),
    ("exp10", &["10^x"]),
    ("exp2", &["2^x"]),
    ("pow", &["x^y"]),
    ("power", &["x^y"]),
    ("sqr", &["x^2", "sqrt"]),
    ("square", &["x^2"]),
    ("arcsin", &["asin"]),
    ("arccos", &["acos"]),
    ("arctan", &["atan"]),
    ("arctan2", &["atan2"]),
    ("arctg", &["atan"]),
    ("tg", &["tan"]),
    ("atn", &["atan"]),
    ("cot", &["1/tan(x)"]),
    ("ctg", &["1/tan(x)"]),
    ("sec", &["1/cos(x)"]),
    ("csc", &["1/sin(x)"]),
    ("fabs", &["abs"]),
    ("root", &["sqrt"]),
    ("radians", &["x*pi/180"]),
    ("rad", &["x*pi/180"]),
    ("degrees", &["x*180/pi"]),
    ("iif", &["if"]),
    ("where", &["if"]),
    ("fmod", &["mod"]),
    ("ceiling", &["ceil"]),
    ("int", &["floor"]),
    ("trunc", &["floor"]),
    ("rint", &["round"]),
    ("tgamma", &["gamma"]),
    ("erfc", &["1 - erf(x)"]),
    ("arsinh", &["asinh"]),
    ("arcosh", &["acosh"]),
    ("artanh", &["atanh"]),
    ("arcsinh", &["asinh"]),
    ("arccosh", &["acosh"]),
    ("arctanh", &["atanh"]),
    ("interp", &["table"]),
    ("lookup", &["table"]),
    ("and", &["a and b"]),
    ("or", &["a or b"]),
    ("average", &["mean"]),
    ("avg", &["mean"]),
    ("sign", &["(x > 0) - (x < 0)"]),
    ("sgn", &["(x > 0) - (x < 0)"]),
];

/// Functions that may be meant by a name, likeliest first, or what to write instead.
pub(super) fn functions(found: &str) -> Vec<String> {
    let lower = found.to_lowercase();
    match ELSEWHERE.iter().find(|(name, _)| *name == lower) {
        Some((_, here)) => owned(here),
        None => owned(&all_nearest(found, Function::all().map(Function::name))),
    }
}

/// Defined names and functions that may be meant by a name, likeliest first.
pub(super) fn names<'k>(found: &str, defined: impl Iterator<Item = &'k str>) -> Vec<String> {
    let functions = Function::all().map(|function| -> &'k str { function.name() });
    let near = all_nearest(found, defined.chain(["pi"]).chain(functions));
    // Euler's number is the one constant that other languages have and this one does not
    owned(if near.is_empty() && found == "e" { &["exp(1)"] } else { &near })
}

fn owned(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_of_other_languages() {
        assert_eq!(functions("log"), ["ln", "log10"]);
        assert_eq!(functions("arcsin"), ["asin"]);
        assert_eq!(functions("Sqrt"), ["sqrt"]);
        assert_eq!(functions("sine"), ["sin", "sinh"]);
        assert_eq!(functions("ArcTan"), ["atan"]);
        assert_eq!(functions("iif"), ["if"]);
    }
}
