//! No text makes the formula language panic, hang or point outside of the text.

use std::collections::HashMap;

use super::*;

/// A linear congruential generator (Knuth's MMIX constants), of which the high bits are used.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % limit
    }

    fn pick<'p>(&mut self, pieces: &[&'p str]) -> &'p str {
        pieces[self.below(pieces.len())]
    }
}

const PIECES: &[&str] = &[
    "n",
    "l",
    "s",
    "t",
    "dt",
    "bad",
    "below",
    "θ",
    "tilt",
    "titl",
    "x₀",
    "pi",
    "π",
    "_",
    "e",
    "sin",
    "cos",
    "atan2",
    "max",
    "hypot",
    "kelvin",
    "sqrt",
    "solve(",
    "table(",
    "if(",
    "mod(",
    "and",
    "or",
    "not",
    "'",
    "\"a.csv\"",
    "'x'",
    "log",
    "sin(",
    "max(",
    "kelvin(",
    "0",
    "1",
    "2",
    "0.5",
    ".5",
    "2.",
    "1e3",
    "1e-3",
    "1,5",
    "1.2.3",
    "1e999",
    "1_000",
    "e5",
    "+",
    "-",
    "*",
    "/",
    "^",
    "**",
    "·",
    "−",
    "<",
    "<=",
    ">",
    "==",
    "!=",
    "≤",
    "=",
    "!",
    "(",
    ")",
    "((",
    "))",
    ",",
    ", ",
    " ",
    "\n",
    "\u{a0}",
    "²",
    "%",
    "|",
    "√",
    "°",
    "\u{0}",
    "\u{200b}",
    "😀",
    "é",
    "e\u{301}",
    "\"",
    "\\",
    ";",
    "[",
    "]",
    "}",
    "٣",
    "Ⅷ",
    "[mm]",
    "[degC]",
    "[degF]",
    "[dB]",
    "[h]",
    "[rev]",
    "[m^2",
    "[furlong]",
    " [K]",
    "celsius(",
    "log10(",
    "20*",
];

/// Everything that can be done with a text; the places of all mistakes lie inside of it.
fn exercise(text: &str, scope: &Scope, values: &HashMap<String, f64>) -> bool {
    let look = |error: &FormulaError| {
        assert!(text.get(error.span()).is_some(), "{text:?}: {error:?}");
        for (span, _) in error.labels() {
            assert!(text.get(span).is_some(), "{text:?}: {error:?}");
        }
        assert!(!error.to_string().is_empty());
        let _ = error.suggestion();
    };
    let formula = match Formula::parse(text) {
        Ok(formula) => formula,
        Err(error) => {
            look(&error);
            return false;
        }
    };
    let checked = formula.check(scope);
    if let Err(errors) = &checked {
        assert!(!errors.is_empty());
        errors.iter().for_each(look);
    }
    let named = formula.check_names(scope);
    if let Err(errors) = &named {
        errors.iter().for_each(look);
    }
    let value = formula.evaluate(scope, values);
    // what has been checked can be computed
    let is_undefined =
        |error: &FormulaError| matches!(error, FormulaError::ConstantUndefined { .. });
    let has_value = match &named {
        Ok(_) => true,
        // that no number is finite is no reason not to compute one
        Err(errors) => errors.iter().all(is_undefined),
    };
    assert_eq!(has_value, value.is_ok(), "{text:?}");
    assert!(checked.is_err() || named == checked, "{text:?}");
    true
}

fn surroundings() -> (Scope, HashMap<String, f64>) {
    let scope = scope();
    let values = scope.names().map(|name| (name.to_owned(), 1.5)).collect();
    (scope, values)
}

#[test]
fn random_pieces() {
    let (scope, values) = surroundings();
    let mut random = Random(1);
    let mut read = 0;
    for _ in 0..40_000 {
        let text: String = (0..random.below(12)).map(|_| random.pick(PIECES)).collect();
        read += usize::from(exercise(&text, &scope, &values));
    }
    assert!(read > 1000, "{read}");
}

#[test]
fn random_characters() {
    let (scope, values) = surroundings();
    let mut random = Random(2);
    for _ in 0..10_000 {
        let text: String = (0..random.below(30))
            .filter_map(|_| char::from_u32(random.below(0x3000) as u32))
            .collect();
        exercise(&text, &scope, &values);
    }
}

/// A formula that follows the grammar.
fn sentence(random: &mut Random, depth: usize) -> String {
    if depth == 0 {
        return random
            .pick(&[
                "n", "l", "s", "t", "dt", "0", "1", "2", "0.5", "pi", "titl", "5 [degC]", "[K]",
            ])
            .into();
    }
    let mut part = || {
        let depth = random.below(depth);
        sentence(random, depth)
    };
    let (x, y) = (part(), part());
    match random.below(8) {
        0 => format!("-{x}"),
        1 => format!("({x})"),
        2 => format!("{}({x})", random.pick(&["sin", "sqrt", "abs", "kelvin", "celsius", "log10"])),
        3 => format!("{}({x}, {y})", random.pick(&["max", "atan2", "hypot", "min", "sin"])),
        4 => format!("({x} {} {y})", random.pick(&["<", ">=", "==", "!="])),
        5 => format!("({x})^{}", random.pick(&["2", "-1", "0.5", "n", "(1/3)", "2^3"])),
        _ => format!("({x}) {} ({y})", random.pick(&["+", "-", "*", "/"])),
    }
}

#[test]
fn random_sentences() {
    let (scope, values) = surroundings();
    let mut random = Random(3);
    for _ in 0..10_000 {
        let depth = random.below(12);
        let text = sentence(&mut random, depth);
        assert!(exercise(&text, &scope, &values), "{text}");
    }
}

#[test]
fn deep_and_long_texts() {
    let (scope, values) = surroundings();
    let mut random = Random(4);
    for _ in 0..60 {
        let piece: String = (0..1 + random.below(4)).map(|_| random.pick(PIECES)).collect();
        let times = random.below(99_000 / piece.len().max(1));
        exercise(&piece.repeat(times), &scope, &values);
    }
    for piece in PIECES {
        exercise(&piece.repeat(99_999 / piece.len()), &scope, &values);
    }
    // kelvin of kelvin of …, and as many unknown names and mistakes as fit
    let nested = format!("{}t{}", "kelvin(".repeat(99), ")".repeat(99));
    assert!(exercise(&nested, &scope, &values));
    let names: String = (0..12_000).map(|i| format!("q{i}+")).collect();
    assert!(exercise(&format!("{names}1"), &scope, &values));
    assert!(exercise(&vec!["(l + s)"; 9_000].join(" * "), &scope, &values));
    assert!(exercise(&vec!["l"; 45_000].join("*"), &scope, &values));
}
