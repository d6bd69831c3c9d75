//! However a unit is spelled, it is one unit in a Digital Calibration Certificate and in LaTeX.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::certificate::dcc_unit;
use crate::document::Declared;
use gumption_units::{FactorBase, Unit};

/// Spellings of a symbol or prefix, and its name in D-SI if it has one. Written down here again so
/// that the test knows the names from elsewhere than the code.
type Named = (&'static [&'static str], Option<&'static str>);

const PREFIXES: &[Named] = &[
    (&[""], Some("")),
    (&["m"], Some("milli")),
    (&["k"], Some("kilo")),
    (&["u", "µ", "μ"], Some("micro")),
    (&["da"], Some("deca")),
    (&["Q"], None),
];

/// Symbols that take a prefix.
const PREFIXED: &[Named] = &[
    (&["m"], Some("metre")),
    (&["s"], Some("second")),
    (&["V"], Some("volt")),
    (&["Pa"], Some("pascal")),
    (&["Hz"], Some("hertz")),
    (&["ohm", "Ω", "\u{2126}"], Some("ohm")),
    (&["L", "l"], Some("litre")),
    (&["g_n"], None),
    (&["bar"], None),
];

/// Symbols that take none.
const BARE: &[Named] = &[
    (&["degC", "°C", "℃"], Some("degreecelsius")),
    (&["deg", "°"], Some("degree")),
    (&["arcmin", "'", "′"], Some("arcminute")),
    (&["min"], Some("minute")),
    (&["%"], Some("percent")),
    (&["D"], None),
    (&["psi"], None),
];

/// Signs of a product.
const TIMES: [&str; 8] = ["*", "·", "⋅", "×", ".", " ", " * ", " · "];

/// A factor to be spelled: spellings, name in D-SI, exponent in halves.
#[derive(Clone, Debug)]
struct Wanted {
    prefix: &'static Named,
    symbol: &'static Named,
    halves: i32,
}

fn wanted() -> impl Strategy<Value = Wanted> {
    let prefixed = (prop::sample::select(PREFIXES), prop::sample::select(PREFIXED));
    let bare = prop::sample::select(BARE).prop_map(|symbol| (PREFIXES[0], symbol));
    // whole exponents mostly
    let halves = prop_oneof![
        6 => prop::sample::select(&[-6, -4, -2, 2, 4, 6][..]),
        1 => prop::sample::select(&[-3, -1, 1, 3][..]),
    ];
    (prop_oneof![3 => prefixed, 1 => bare], halves).prop_map(|((prefix, symbol), halves)| Wanted {
        prefix: Box::leak(Box::new(prefix)),
        symbol: Box::leak(Box::new(symbol)),
        halves,
    })
}

/// Choices, one byte each; all of them the first when the bytes are used up.
struct Choices<'b>(std::slice::Iter<'b, u8>);

impl Choices<'_> {
    fn below(&mut self, n: usize) -> usize {
        usize::from(self.0.next().copied().unwrap_or(0)) % n
    }

    fn of<T: Clone>(&mut self, options: &[T]) -> T {
        options[self.below(options.len())].clone()
    }

    /// A product of these factors with their exponents multiplied by `numerator / denominator`.
    fn product(&mut self, factors: &[Wanted], power: (i32, i32), depth: usize) -> String {
        let mut text = String::new();
        let mut rest = factors;
        let mut divided = false;
        while !rest.is_empty() {
            // a group of some of them, or one alone
            let grouped = depth < 3 && self.below(3) == 1;
            let (some, others) =
                rest.split_at(if grouped { 1 + self.below(rest.len()) } else { 1 });
            rest = others;
            let divide = self.below(2) == 1;
            let sign = if divide { -1 } else { 1 };
            let operator = match (text.is_empty(), divide) {
                (true, true) => "1/",
                (true, false) => "",
                (false, true) => self.of(&["/", " / "]),
                // behind a quotient a space and a dot are refused
                (false, false) if divided => "*",
                // `V (%)` is refused
                (false, false) if grouped && some.len() == 1 => "*",
                (false, false) => self.of(&TIMES),
            };
            divided |= divide;
            text += operator;
            if grouped {
                let (outer, inner) =
                    self.of(&[((1, 1), (1, 1)), ((2, 1), (1, 2)), ((1, 2), (2, 1))]);
                let inner = (power.0 * inner.0 * sign, power.1 * inner.1);
                let inside = self.product(some, inner, depth + 1);
                text += &self.raised(&format!("({inside})"), outer);
            } else {
                let name = self.of(some[0].prefix.0).to_owned() + self.of(some[0].symbol.0);
                text += &self.raised(&name, (some[0].halves * power.0 * sign, 2 * power.1));
            }
        }
        text
    }

    /// A name or a group to a power.
    fn raised(&mut self, base: &str, (numerator, denominator): (i32, i32)) -> String {
        let divisor = (1..=denominator).rev().find(|d| numerator % d == 0 && denominator % d == 0);
        let divisor = divisor.expect("1 divides");
        let (n, d) = (numerator / divisor, denominator / divisor);
        if (n, d) == (1, 1) && self.below(4) > 0 {
            return base.to_owned();
        }
        let spaced = self.of(&["", " "]);
        if d == 1 {
            let sign = self.of(&["^", "**"]);
            let raised: String = n.to_string().chars().map(superscript).collect();
            return match self.below(4) {
                0 => format!("{base}{sign}{n}"),
                1 => format!("{base}{spaced}{sign}{spaced}({n})"),
                2 => format!("{base}^({}/2)", 2 * n),
                _ => format!("{base}{raised}"),
            };
        }
        match self.below(3) {
            1 if (n, d) == (1, 2) => format!("√{base}"),
            2 if (n, d) == (1, 2) && !base.starts_with('(') => format!("sqrt({base})"),
            1 if d == 2 || d == 4 => format!("{base}^{}", f64::from(n) / f64::from(d)),
            _ => format!("{base}^({n}/{d})"),
        }
    }
}

fn superscript(c: char) -> char {
    match c.to_digit(10) {
        Some(digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize).expect("a digit"),
        None => '⁻',
    }
}

/// What D-SI says, from the names above.
fn in_dsi(factors: &[Wanted]) -> Option<String> {
    let factor = |factor: &Wanted| {
        let (prefix, name) = (factor.prefix.1?, factor.symbol.1?);
        let prefix = if prefix.is_empty() { String::new() } else { format!("\\{prefix}") };
        match (factor.halves % 2, factor.halves / 2) {
            (0, 1) => Some(format!("{prefix}\\{name}")),
            (0, power) => Some(format!("{prefix}\\{name}\\tothe{{{power}}}")),
            _ => None,
        }
    };
    factors.iter().map(factor).collect()
}

/// The unit in LaTeX with what it declares.
fn in_latex(text: &str) -> (String, Vec<String>) {
    let mut declared = Declared::default();
    (declared.unit(text), declared.lines())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1_000,
        rng_seed: RngSeed::Fixed(14),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_spelling_is_one_unit(
        factors in prop::collection::vec(wanted(), 1..5),
        choices in prop::collection::vec(any::<u8>(), 0..60),
    ) {
        let plain = Choices([].iter()).product(&factors, (1, 1), 0);
        let spelled = Choices(choices.iter()).product(&factors, (1, 1), 0);
        prop_assume!(spelled.len() <= Unit::MAX_LENGTH);
        let unit = |text: &str| Unit::parse(text).map_err(|e| TestCaseError::fail(format!("{text}: {e}")));
        let (one, other) = (unit(&plain)?, unit(&spelled)?);
        prop_assert_eq!(one.factors(), other.factors(), "{} and {}", plain, spelled);
        prop_assert_eq!(one.factors().len(), factors.len(), "{}", spelled);
        for (factor, wanted) in other.factors().iter().zip(&factors) {
            prop_assert_eq!(factor.exponent.to_f64(), 0.5 * f64::from(wanted.halves));
            let FactorBase::Named { symbol, .. } = factor.base else {
                return Err(TestCaseError::fail("a number"));
            };
            prop_assert_eq!(symbol.name(), wanted.symbol.0[0]);
        }
        let dcc = dcc_unit(&other);
        prop_assert_eq!(&dcc_unit(&one), &dcc, "{} and {}", plain, spelled);
        match in_dsi(&factors) {
            Some(expected) => prop_assert_eq!(expected, dcc, "{}", spelled),
            None => prop_assert!(dcc.starts_with('|'), "{}: {}", spelled, dcc),
        }
        prop_assert_eq!(in_latex(&plain), in_latex(&spelled), "{} and {}", plain, spelled);
    }
}

#[test]
fn spellings_that_were_once_lost() {
    let same: [(&[&str], &str, &str); 6] = [
        (
            &["m/s^2", "m/s²", "m·s⁻²", "m s^-2", "m*s**-2", "m/(s^(1/2))^4"],
            r"\metre\second\tothe{-2}",
            r"\unit{\metre\per\second\squared}",
        ),
        (&["m^2", "m**2", "m^(2)", "m²"], r"\metre\tothe{2}", r"\unit{\metre\squared}"),
        (
            &["mV/(m/s^2)", "mV/(m/s²)", "mV·m⁻¹·s²", "mV/m*s^2"],
            r"\milli\volt\metre\tothe{-1}\second\tothe{2}",
            r"\unit{\milli\volt\per\metre\second\squared}",
        ),
        (
            &["kg*m^-3", "kg·m⁻³", "kg/m³"],
            r"\kilogram\metre\tothe{-3}",
            r"\unit{\kilo\gram\per\metre\cubed}",
        ),
        (
            &["nV/√Hz", "nV/Hz^(1/2)", "nV/sqrt(Hz)", "nV*Hz^-0.5"],
            "|nV/Hz^(1/2)",
            r"\unit{\nano\volt\hertz\tothe{-1/2}}",
        ),
        (
            &["D/(m/s^2)", "D/(m/s²)", "D m^-1 s^2"],
            "|D·s^2/m",
            r"\unit{\gumptionD\per\metre\second\squared}",
        ),
    ];
    for (spellings, dcc, latex) in same {
        for spelling in spellings {
            let unit = Unit::parse(spelling).unwrap();
            assert_eq!(dcc_unit(&unit), dcc, "{spelling}");
            assert_eq!(in_latex(spelling).0, latex, "{spelling}");
        }
    }
}
