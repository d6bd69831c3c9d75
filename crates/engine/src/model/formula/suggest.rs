//! What may be meant by a name that is not known.

use super::function::Function;

/// The most suggestions given.
const MOST: usize = 3;

/// The longest name that is compared, in characters.
const LONGEST: usize = 64;

/// The largest distance of a name that is still suggested.
const FARTHEST: usize = 3;

/// Names of functions elsewhere, and what they are here; none where nothing corresponds.
const ELSEWHERE: &[(&str, &[&str])] = &[
    ("log", &["ln", "log10"]),
    ("lg", &["log10"]),
    ("lb", &["ln(x)/ln(2)"]),
    ("log2", &["ln(x)/ln(2)"]),
    ("log1p", &["ln(1 + x)"]),
    ("expm1", &["exp(x) - 1"]),
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
    ("if", &["(x > 0)*y"]),
    ("average", &["(x + y)/2"]),
    ("mean", &["(x + y)/2"]),
    ("sum", &["x + y"]),
    ("floor", &[]),
    ("ceil", &[]),
    ("round", &[]),
    ("sign", &["(x > 0) - (x < 0)"]),
    ("sgn", &["(x > 0) - (x < 0)"]),
];

/// Functions that may be meant by a name, likeliest first, or what to write instead.
pub(super) fn functions(found: &str) -> Vec<String> {
    let lower = found.to_lowercase();
    match ELSEWHERE.iter().find(|(name, _)| *name == lower) {
        Some((_, here)) => here.iter().map(|text| (*text).to_owned()).collect(),
        None => nearest(found, Function::all().map(Function::name)),
    }
}

/// Defined names and functions that may be meant by a name, likeliest first.
pub(super) fn names<'k>(found: &str, defined: impl Iterator<Item = &'k str>) -> Vec<String> {
    let functions = Function::all().map(|function| -> &'k str { function.name() });
    let near = nearest(found, defined.chain(["pi"]).chain(functions));
    // Euler's number is the one constant that other languages have and this one does not
    if near.is_empty() && found == "e" { vec!["exp(1)".to_owned()] } else { near }
}

/// The known names nearest to `found`: all those at the least distance, if that is small enough for
/// the length of the name. Case does not count, a swap of neighbours counts once.
fn nearest<'k>(found: &str, known: impl Iterator<Item = &'k str>) -> Vec<String> {
    let wanted = plain(found);
    let length = wanted.chars().count();
    if length > LONGEST {
        return Vec::new();
    }
    let mut least = ((length + 1) / 3).min(FARTHEST);
    let mut near: Vec<String> = Vec::new();
    for name in known {
        let candidate = plain(name);
        let count = candidate.chars().count();
        if count.abs_diff(length) > least || near.iter().any(|n| n == name) {
            continue;
        }
        let distance = strsim::damerau_levenshtein(&wanted, &candidate);
        if distance < least {
            near.clear();
            least = distance;
        }
        if distance == least && distance < count && near.len() < MOST {
            near.push(name.to_owned());
        }
    }
    near
}

/// A name in small letters, and the micro sign as the Greek letter that looks the same.
fn plain(name: &str) -> String {
    name.to_lowercase().replace('µ', "μ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_names() {
        let known = ["voltage", "a_ref", "t1", "t2", "m", "μ", "T0"];
        let names = |found: &str| nearest(found, known.into_iter());
        assert_eq!(names("voltge"), ["voltage"]);
        assert_eq!(names("VOLTAGE"), ["voltage"]);
        assert_eq!(names("aref"), ["a_ref"]);
        assert_eq!(names("t0"), ["T0"]);
        assert_eq!(names("t3"), ["t1", "t2", "T0"]);
        assert_eq!(names("M"), ["m"]);
        assert_eq!(names("µ"), ["μ"]);
        assert!(names("x").is_empty());
        assert!(names("current").is_empty());
        assert!(names(&"voltage".repeat(10_000)).is_empty());
    }

    #[test]
    fn functions_of_other_languages() {
        assert_eq!(functions("log"), ["ln", "log10"]);
        assert_eq!(functions("arcsin"), ["asin"]);
        assert_eq!(functions("Sqrt"), ["sqrt"]);
        assert_eq!(functions("sine"), ["sin", "sinh"]);
        assert_eq!(functions("ArcTan"), ["atan"]);
        assert!(functions("floor").is_empty());
    }
}
