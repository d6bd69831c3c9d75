//! Every mistake, with its place and its sentence.

use super::*;

/// Formula, the part that is pointed at, sentence, suggestion.
const TABLE: &[(&str, &str, &str, Option<&str>)] = &[
    ("", "", "the formula is empty", None),
    ("  ", "", "the formula is empty", None),
    // characters
    (
        "a = b",
        "=",
        "`=` has no meaning in a formula; a comparison is written `==`, and a formula is only the right-hand side",
        Some("=="),
    ),
    ("a =< b", "=", "`=` has no meaning in a formula; did you mean `<=`?", Some("<=")),
    ("a => b", "=", "`=` has no meaning in a formula; did you mean `>=`?", Some(">=")),
    ("a ÷ 2", "÷", "`÷` has no meaning in a formula; did you mean `/`?", Some("/")),
    ("a – b", "–", "`–` has no meaning in a formula; did you mean `-`?", Some("-")),
    ("x⁻¹", "⁻", "`⁻` has no meaning in a formula; did you mean `^-1`?", Some("^-1")),
    ("x²", "²", "`²` has no meaning in a formula; did you mean `^2`?", Some("^2")),
    ("x₀", "₀", "`₀` has no meaning in a formula; did you mean `_0`?", Some("_0")),
    ("5 % of x", "%", "`%` has no meaning in a formula; 5 % is written `0.05` or `5 [%]`", None),
    ("|x|", "|", "`|` has no meaning in a formula; the modulus of x is written `abs(x)`", None),
    ("√2", "√", "`√` has no meaning in a formula; the square root of x is written `sqrt(x)`", None),
    ("{1}", "{", "`{` has no meaning in a formula; parentheses are `(` and `)`", Some("(")),
    (
        "max(1; 2)",
        ";",
        "`;` has no meaning in a formula; arguments are separated by `,`",
        Some(","),
    ),
    (
        "1 + .",
        ".",
        "`.` has no meaning in a formula; a decimal fraction has digits beside its point, such as `0.5`",
        None,
    ),
    (
        "!x",
        "!",
        "`!` has no meaning in a formula; a comparison for different values is written `!=`",
        Some("!="),
    ),
    (
        "35°",
        "°",
        "`°` has no meaning in a formula; an angle of 30 degrees is written `30 [deg]`",
        None,
    ),
    ("x \u{200b}", "\u{200b}", "`\\u{200b}` has no meaning in a formula", None),
    (
        "\"x\"",
        "\"x\"",
        "`\"x\"` is not allowed here; expected a number, a name, a function or `(`",
        None,
    ),
    (
        "1 + \"x",
        "\"",
        "`\"` has no meaning in a formula; the quote at the end of this text is missing",
        None,
    ),
    (
        "n < 1 && n > 0",
        "&",
        "`&` has no meaning in a formula; that two comparisons both hold is written `and`",
        Some("and"),
    ),
    ("if(n > 0, 1)", "if", "`if` takes three arguments, not 2", None),
    (
        "if(n > 0, l, s)",
        "if",
        "`l` is a length (m), but `s` is a time (s); `if` needs quantities of the same dimension",
        None,
    ),
    ("if(l, 1, 2)", "l", "`if` needs a plain number, but `l` is a length (m)", None),
    ("n and l", "l", "`and` needs a plain number, but `l` is a length (m)", None),
    ("round(l)", "l", "`round` needs a plain number, but `l` is a length (m)", None),
    (
        "mod(l, s)",
        "mod",
        "`l` is a length (m), but `s` is a time (s); `mod` needs quantities of the same dimension",
        None,
    ),
    ("table(n)", "table", "`table` takes two to five arguments, not 1", None),
    (
        "table(n, 'f.csv', 'x')",
        "table(n, 'f.csv', 'x')",
        "`table` needs both columns or none: table(x, 'file.csv', 'x column', 'y column')",
        None,
    ),
    (
        "table(n, 'f.csv', 'x', 'y', 'spline')",
        "'spline'",
        "`spline` is no way of interpolation; there are `linear` and `cubic`",
        None,
    ),
    (
        "table(n, f)",
        "f",
        "`f` is not allowed here; expected a text in quotes: table(x, 'file.csv', 'x column', 'y column', 'linear')",
        None,
    ),
    (
        "table(n, 'f.csv')",
        "table(n, 'f.csv')",
        "the table of `f.csv` cannot be read here; tables are only in the equations of a model file",
        None,
    ),
    (
        "solve(q - 1, n, 0, 1)",
        "n",
        "`n` is a quantity of the file already; the unknown of `solve` needs a name of its own",
        None,
    ),
    (
        "solve(n - 1, q, 0, 1)",
        "q",
        "the unknown `q` does not occur in the formula that is to be 0",
        None,
    ),
    (
        "solve(q - 1, q, 0)",
        ")",
        "`)` is not allowed here; expected `,`, as in solve(formula, unknown, from, to)",
        None,
    ),
    (
        "solve(q - l, q, 0, 1 [s])",
        "-",
        "`q` is a time (s), but `l` is a length (m); one cannot be subtracted from the other",
        None,
    ),
    (
        "solve(solve(solve(a - 1, a, 0, 2) - b, b, 0, 2) - c, c, 0, 2)",
        "solve",
        "there are more than 2 equations to solve inside each other; give a part of the formula a name of its own",
        None,
    ),
    // tokens
    (
        "1 2",
        "2",
        "`2` is not allowed here; expected an operator or the end of the formula; two numbers need an operator between them",
        None,
    ),
    (
        "2x",
        "x",
        "`x` is not allowed here; expected an operator or the end of the formula; a product is written with `*`; did you mean `2*x`?",
        Some("2*x"),
    ),
    (
        "2e",
        "e",
        "`e` is not allowed here; expected an operator or the end of the formula; a product is written with `*`; did you mean `2*e`?",
        Some("2*e"),
    ),
    (
        "2(n)",
        "(",
        "`(` is not allowed here; expected an operator or the end of the formula; a product is written with `*`; did you mean `2*(`?",
        Some("2*("),
    ),
    (
        "(n)(n)",
        "(",
        "`(` is not allowed here; expected an operator or the end of the formula; a product is written with `*`; did you mean `)*(`?",
        Some(")*("),
    ),
    (
        "pi n",
        "n",
        "`n` is not allowed here; expected an operator or the end of the formula; a product is written with `*`; did you mean `pi*n`?",
        Some("pi*n"),
    ),
    (
        "(n n)",
        "n",
        "`n` is not allowed here; expected an operator or `)`; a product is written with `*`; did you mean `n*n`?",
        Some("n*n"),
    ),
    (
        "sin(n n)",
        "n",
        "`n` is not allowed here; expected an operator, `,` or `)`; a product is written with `*`; did you mean `n*n`?",
        Some("n*n"),
    ),
    (
        "n)",
        ")",
        "`)` is not allowed here; expected an operator or the end of the formula; this parenthesis closes nothing; remove it or add `(`",
        None,
    ),
    ("n, n", ",", "`,` is not allowed here; expected an operator or the end of the formula", None),
    ("()", ")", "`)` is not allowed here; expected a number, a name, a function or `(`", None),
    ("max(n,)", ")", "`)` is not allowed here; expected a number, a name, a function or `(`", None),
    ("n + * n", "*", "`*` is not allowed here; expected a number, a name, a function or `(`", None),
    ("*n", "*", "`*` is not allowed here; expected a number, a name, a function or `(`", None),
    (
        "n <> 1",
        ">",
        "`>` is not allowed here; expected a number, a name, a function or `(`; did you mean `!=`?",
        Some("!="),
    ),
    // ends
    ("n +", "", "the formula ends where a number, a name, a function or `(` is expected", None),
    (
        "(n + 1",
        "",
        "the formula ends where an operator or `)` is expected; a parenthesis is still open",
        None,
    ),
    (
        "sin(n",
        "",
        "the formula ends where an operator, `,` or `)` is expected; a parenthesis is still open",
        None,
    ),
    (
        "sin(",
        "",
        "the formula ends where a number, a name, a function or `(` is expected; a parenthesis is still open",
        None,
    ),
    // numbers
    (
        "1,5",
        "1,5",
        "`1,5` is not a number that can be read: a decimal fraction is written with a point; did you mean `1.5`?",
        Some("1.5"),
    ),
    (
        "n*(2,25 + 1)",
        "2,25",
        "`2,25` is not a number that can be read: a decimal fraction is written with a point; did you mean `2.25`?",
        Some("2.25"),
    ),
    (
        "1.000,5",
        "1.000,5",
        "`1.000,5` is not a number that can be read: a decimal fraction is written with a point",
        None,
    ),
    (
        "1.2.3",
        "1.2.3",
        "`1.2.3` is not a number that can be read: it has more than one decimal point",
        None,
    ),
    (
        "1e5.5",
        "1e5.5",
        "`1e5.5` is not a number that can be read: it has more than one decimal point",
        None,
    ),
    (
        "1_000_000.5",
        "1_000_000",
        "`1_000_000` is not a number that can be read: digits are written without anything between them; did you mean `1000000`?",
        Some("1000000"),
    ),
    (
        "1e400",
        "1e400",
        "`1e400` is not a number that can be read: it is too large or too small for double precision (about 1e-308 to 1e308)",
        None,
    ),
    (
        "2e-400",
        "2e-400",
        "`2e-400` is not a number that can be read: it is too large or too small for double precision (about 1e-308 to 1e308)",
        None,
    ),
    // comparisons
    (
        "1 < n < 2",
        "<",
        "comparisons cannot be joined like this; that both hold is their product, such as `(a < b)*(b < c)`",
        None,
    ),
    (
        "n == n >= n",
        ">=",
        "comparisons cannot be joined like this; that both hold is their product, such as `(a < b)*(b < c)`",
        None,
    ),
    // functions
    (
        "sin + 1",
        "sin",
        "`sin` is a function and needs its argument in parentheses: `sin(x)`",
        Some("sin(x)"),
    ),
    (
        "1 + cos tilt",
        "cos",
        "`cos` is a function and needs its argument in parentheses: `cos(tilt)`",
        Some("cos(tilt)"),
    ),
    (
        "max",
        "max",
        "`max` is a function and needs its argument in parentheses: `max(x, y)`",
        Some("max(x, y)"),
    ),
    ("log(n)", "log", "there is no function `log`; did you mean `ln` or `log10`?", Some("ln")),
    ("arctan(n)", "arctan", "there is no function `arctan`; did you mean `atan`?", Some("atan")),
    ("Sin(n)", "Sin", "there is no function `Sin`; did you mean `sin`?", Some("sin")),
    ("sqrrt(n)", "sqrrt", "there is no function `sqrrt`; did you mean `sqrt`?", Some("sqrt")),
    (
        "bessel(n)",
        "bessel",
        "there is no function `bessel`; the functions are sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, log10, sqrt, cbrt, abs, min, max, hypot, sum, mean, kelvin, celsius, re, im, arg, conj, floor, ceil, round, mod, expm1, log1p, asinh, acosh, atanh, erf, gamma, if, table, solve",
        None,
    ),
    (
        "n(l + 1)",
        "n",
        "`n` is a quantity and not a function; a product is written `n*(...)`",
        Some("n*("),
    ),
    ("sin()", "sin", "`sin` takes one argument, not 0", None),
    (
        "sin(1,5)",
        "sin",
        "`sin` takes one argument, not 2; did you mean `sin(1.5)`?",
        Some("sin(1.5)"),
    ),
    ("sin(n, n)", "sin", "`sin` takes one argument, not 2", None),
    ("atan2(n, n, n)", "atan2", "`atan2` takes two arguments, not 3", None),
    ("hypot(n)", "hypot", "`hypot` takes two or more arguments, not 1", None),
    // names
    ("2*titl", "titl", "`titl` is not defined; did you mean `tilt`?", Some("tilt")),
    ("N + 1", "N", "`N` is not defined; did you mean `n`?", Some("n")),
    ("PI*2", "PI", "`PI` is not defined; did you mean `pi`?", Some("pi")),
    ("2*e", "e", "`e` is not defined; did you mean `exp(1)`?", Some("exp(1)")),
    (
        "2*\u{430}",
        "\u{430}",
        "`\u{430}` is not defined: it has the Cyrillic letter U+0430 where `a`, which looks like it, has \
         the Latin letter U+0061; write both alike",
        None,
    ),
    (
        "2 + voltage",
        "voltage",
        "`voltage` is not defined; names here are `n`, `k`, `l`, `d`, `s`, `f`, `v`, `a`, `m`, `u`, `i` and `tilt`",
        None,
    ),
    (
        "2*below",
        "below",
        "`below` is not defined yet; a formula may use inputs, conditions and the quantities above it",
        None,
    ),
    // dimensions
    ("l + s", "+", "`l` is a length (m), but `s` is a time (s); they cannot be added", None),
    (
        "d*2 - (s*3)",
        "-",
        "`d*2` is a length (m), but `s*3` is a time (s); one cannot be subtracted from the other",
        None,
    ),
    (
        "l > 1",
        ">",
        "`l` is a length (m), but `1` is a plain number; they cannot be compared (a number other than 0 in a formula has no unit; write one behind it, such as `1 [m]`)",
        None,
    ),
    (
        "max(l, 0, s)",
        "max",
        "`l` is a length (m), but `s` is a time (s); `max` needs quantities of the same dimension",
        None,
    ),
    (
        "atan2(l, s)",
        "atan2",
        "`l` is a length (m), but `s` is a time (s); `atan2` needs quantities of the same dimension",
        None,
    ),
    (
        "l + m*v^2 + s*(a + a + a + a + a + a + a + a + a)",
        "+",
        "`l` is a length (m), but `m*v^2` is an energy or a torque (kg m^2 s^-2); they cannot be added",
        None,
    ),
    (
        "sin(2*l)",
        "2*l",
        "`sin` needs an angle or another plain number, but `2*l` is a length (m)",
        None,
    ),
    ("exp(dt)", "dt", "`exp` needs a plain number, but `dt` is a temperature (K)", None),
    ("kelvin(l)", "l", "`kelvin` needs a temperature, but `l` is a length (m)", None),
    ("kelvin(20)", "20", "`kelvin` needs a temperature, but `20` is a plain number", None),
    ("2^l", "l", "an exponent must be a plain number, but `l` is a length (m)", None),
    (
        "l^n",
        "n",
        "`l` is a length (m), so its exponent must be a number written out, such as `2` or `(1/2)`, not `n`",
        None,
    ),
    (
        "l^pi",
        "pi",
        "`l` is a length (m), so its exponent must be a number written out, such as `2` or `(1/2)`, not `pi`",
        None,
    ),
    (
        "l^9999*l^30000",
        "l^9999*l^30000",
        "the dimension of `l^9999*l^30000` is out of range: its exponents are too large or too fine",
        None,
    ),
    (
        "l^(1/99999)",
        "l^(1/99999)",
        "the dimension of `l^(1/99999)` is out of range: its exponents are too large or too fine",
        None,
    ),
];

#[test]
fn every_mistake_has_its_place_and_sentence() {
    for (text, part, message, suggestion) in TABLE {
        // the place of a formula with several mistakes is that of the first
        let error = mistakes(text).into_iter().next().unwrap_or_else(|| panic!("{text}: right"));
        assert_eq!(error.to_string(), *message, "{text}");
        assert_eq!(text.get(error.span()), Some(*part), "{text}: {:?}", error.span());
        assert_eq!(error.suggestion().as_deref(), *suggestion, "{text}");
        for (span, words) in error.labels() {
            assert!(text.get(span).is_some_and(|part| !part.is_empty()), "{text}: {words}");
        }
    }
}

/// A number without a unit is proposed in that of the quantity beside it.
#[test]
fn units_of_quantities_are_proposed() {
    let mut scope = Scope::new();
    let bar = Unit::parse("bar").expect("a unit");
    scope.define("p", Typing::in_unit(&bar));
    scope.give("p", bar);
    for (text, proposed) in [
        ("p + 0.01", "`0.01 [bar]`"),
        ("3 - 2*p/5", "`3 [bar]`"),
        ("-(p - p) > 1", "`1 [bar]`"),
        ("p*p + 2", "`2 [kg^2 m^-2 s^-4]`"),
        ("abs(p) + 2", "`2 [Pa]`"),
    ] {
        let formula = Formula::parse(text).expect(text);
        let mistakes = formula.check(&scope).expect_err(text);
        assert!(mistakes[0].to_string().contains(proposed), "{text}: {}", mistakes[0]);
    }
}

#[test]
fn ends_lie_behind_the_last_token() {
    assert_eq!(mistake("n +  ").span(), 3..3);
    assert_eq!(mistake("(n  \n").span(), 2..2);
    assert_eq!(mistake("(n").labels(), [(0..1, "opened here".to_owned())]);
    assert_eq!(mistake("(n + (2*n").labels(), [(5..6, "opened here".to_owned())]);
}

#[test]
fn both_operands_are_labelled() {
    let labels = mistake("(l + n*d) - 3*s").labels();
    assert_eq!(labels, [(1..8, "a length (m)".to_owned()), (12..15, "a time (s)".to_owned())]);
    assert_eq!(mistake("1 < n < 2").labels(), [(2..3, "the first comparison".to_owned())]);
    assert_eq!(
        mistake("sin(l)").labels(),
        [(0..3, "takes a plain number".to_owned()), (4..5, "a length (m)".to_owned())]
    );
    assert_eq!(
        mistake("kelvin(l)").labels(),
        [(0..6, "takes a temperature".to_owned()), (7..8, "a length (m)".to_owned())]
    );
    assert_eq!(mistake("(l*l)^n").labels(), [(1..4, "an area (m^2)".to_owned())]);
}

#[test]
fn all_mistakes_are_collected() {
    let spans = |text: &str| -> Vec<_> {
        mistakes(text).iter().map(|error| text[error.span()].to_owned()).collect()
    };
    assert_eq!(spans("titl + b0 + sen(n) + l + sin(l)"), ["titl", "b0", "sen", "+", "l"]);
    // a name is reported once, and nothing follows from it
    assert_eq!(spans("q1 + l + q1*s - sin(q1)^l + max(q1, s)"), ["q1", "l", "+"]);
}

#[test]
fn mistakes_and_their_sentences_are_limited() {
    let text = (0..9000).map(|i| format!("xyz_{i}")).collect::<Vec<_>>().join("+");
    assert_eq!(mistakes(&text).len(), 50);
    let long = "q".repeat(90_000);
    for text in [long.clone(), format!("{long}(1)"), "9".repeat(90_000), format!("l + {long}*s")] {
        assert!(mistakes(&text)[0].to_string().chars().count() < 400, "{:.20}", text);
    }
    let sum = vec!["l"; 20_000].join(" + ");
    let message = mistake(&format!("s - ({sum})")).to_string();
    assert!(
        message.contains("but `l + l + l + l + l +…+ l + l + l + l + l` is a length"),
        "{message}"
    );
    assert!(message.chars().count() < 200);
}

#[test]
fn names_alone() {
    let names = |text: &str| Formula::parse(text).unwrap().check_names(&scope());
    assert_eq!(names("l + s").unwrap(), Typing::ANY);
    assert_eq!(names("sin(l)*m").unwrap().dimension, Some(gumption_units::Dimension::MASS));
    assert_eq!(names("l^n + 3").unwrap().dimension, Some(gumption_units::Dimension::NONE));
    let errors = names("l + s + titl + sin(1, 2) + l(3)").unwrap_err();
    assert_eq!(errors.len(), 3);
    assert!(errors.iter().all(|error| !error.is_dimensional()));
    assert!(mistakes("l + s").iter().all(FormulaError::is_dimensional));
}
