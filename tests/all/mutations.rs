//! Damaged files: whatever they say, reading and evaluating them ends with an answer or with
//! mistakes that have places, never with a panic.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use gumption::file::{ModelFile, Problems, check_text, read_text};
use gumption::propagate::{Control, evaluate, warnings};
use gumption::report;
use gumption::task::Trials;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::RngSeed;

use crate::support::{model_files, root};

/// Files to damage: the ready models and the smaller examples.
fn seeds() -> &'static [String] {
    static SEEDS: OnceLock<Vec<String>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let cases = std::fs::read_dir(root().join("tests/cases")).expect("the examples");
        let mut paths: Vec<_> =
            cases.map(|entry| entry.expect("an entry").path().join("model.json")).collect();
        paths.sort();
        paths.extend(model_files());
        paths.iter().filter_map(|path| std::fs::read_to_string(path).ok()).collect()
    })
}

/// Cases of the gap diagnosis to damage, with the folders of their data.
fn cases() -> &'static [(String, PathBuf)] {
    static CASES: OnceLock<Vec<(String, PathBuf)>> = OnceLock::new();
    CASES.get_or_init(|| {
        let folders = std::fs::read_dir(root().join("models/gap")).expect("the gap cases");
        let mut folders: Vec<PathBuf> =
            folders.map(|entry| entry.expect("an entry").path()).collect();
        folders.sort();
        let read = |folder: PathBuf| {
            let text = std::fs::read_to_string(folder.join("case.json")).ok()?;
            Some((text, folder))
        };
        folders.into_iter().filter_map(read).collect()
    })
}

/// Pieces to put in the place of others.
const PIECES: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "5e-324",
    "1e-300",
    "0.5",
    "1e999",
    "NaN",
    "null",
    "true",
    "\"\"",
    "\"x\"",
    "\"\\u0000\"",
    "\"1/0\"",
    "[]",
    "{}",
    "[[]]",
    "[1]",
    "{\"\": 1}",
    ",",
    ":",
    "{",
    "}",
    "[",
    "]",
    "\"",
    "\"unit\"",
    "\"m\"",
    "\"deg\"",
    "\"degC\"",
    "\"%\"",
    "\"m^999\"",
    "\"1e300 m\"",
    "\"distribution\"",
    "\"normal\"",
    "\"t\"",
    "\"constant\"",
    "\"rectangular\"",
    "\"triangular\"",
    "\"readings\"",
    "\"mean\"",
    "\"std\"",
    "\"half_width\"",
    "\"lower\"",
    "\"upper\"",
    "\"values\"",
    "\"dof\"",
    "\"expanded\"",
    "\"k\"",
    "\"p\"",
    "\"components\"",
    "\"correlations\"",
    "\"conditions\"",
    "\"file\"",
    "\"inputs\"",
    "\"equations\"",
    "\"outputs\"",
    "\"periodic\"",
    "\"per\"",
    "\"row\"",
    "\"type\"",
    "\"A\"",
    "\"10 % + 1e308\"",
    "\"1e308 %\"",
    "\"x^x^x\"",
    "\"-(-(-x))\"",
    "\"sqrt(-1)\"",
    "\"ä\u{1F600}\"",
    "\"allow_undefined\": 1,",
    "\"check_units\": false,",
    "\"coverage_factor\": 8,",
    "\"coverage_probability\": 1e-300,",
    "\"coverage_probability\": 0.9999999999999999,",
    "\"observations\"",
    "\"columns\"",
    "\"sim\"",
    "\"effects\"",
    "\"parameters\"",
    "\"overrides\"",
    "\"catalogue\": [\"offset\", \"low-pass\", \"amplitude-nonlinearity\"],",
    "\"prior\": {\"none\": 1, \"one\": 0, \"two\": 0, \"unexplained\": 0},",
    "\"f\"",
    "\"a_x\"",
];

/// The text in tokens: quoted texts, numbers and words, single signs, white space.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '_');
        let length = if first == '"' {
            rest.get(1..).and_then(|after| after.find('"')).map_or(rest.len(), |at| at + 2)
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if first.is_whitespace() {
            rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token.to_owned());
        rest = after;
    }
    tokens
}

/// One damage to a list of tokens.
#[derive(Clone, Debug)]
enum Damage {
    Delete(Index, usize),
    Insert(Index, &'static str),
    Replace(Index, &'static str),
    Number(Index, String),
    Repeat(Index, usize),
    Swap(Index, Index),
    Inside(Index, Index, char),
    Cut(Index),
}

fn finite() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("finite", |number| number.is_finite())
}

/// Numbers as they may stand in a file: extreme, or plain.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        select(PIECES[..11].to_vec()).prop_map(str::to_owned),
        finite().prop_map(|number| format!("{number:e}")),
        (-1000..1000i32).prop_map(|number| (f64::from(number) / 10.0).to_string()),
    ]
}

/// Formulas that parse.
fn formula() -> impl Strategy<Value = String> {
    let leaves = vec!["x", "t", "0", "1", "2.5", "1e308", "1e-308", "pi", "(-1)"];
    select(leaves).prop_map(str::to_owned).prop_recursive(6, 40, 2, |inner| {
        let one = vec![
            "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln",
            "log10", "sqrt", "cbrt", "abs", "kelvin", "-",
        ];
        let two = vec!["atan2", "min", "max", "hypot"];
        let infix = vec!["+", "-", "*", "/", "^", "<", ">=", "=="];
        prop_oneof![
            (select(one), inner.clone()).prop_map(|(f, a)| format!("{f}({a})")),
            (select(two), inner.clone(), inner.clone())
                .prop_map(|(f, a, b)| format!("{f}({a}, {b})")),
            (select(infix), inner.clone(), inner).prop_map(|(f, a, b)| format!("({a}) {f} ({b})")),
        ]
    })
}

fn damage() -> impl Strategy<Value = Damage> {
    let piece = || select(PIECES.to_vec());
    let at = any::<Index>;
    let sign = select(vec!['(', ')', '*', '-', '^', '0', '9', 'e', '/', ' ', '\\', ',', 'ß', '%']);
    prop_oneof![
        2 => (at(), 1..6usize).prop_map(|(at, count)| Damage::Delete(at, count)),
        2 => (at(), piece()).prop_map(|(at, piece)| Damage::Insert(at, piece)),
        4 => (at(), piece()).prop_map(|(at, piece)| Damage::Replace(at, piece)),
        8 => (at(), number()).prop_map(|(at, number)| Damage::Number(at, number)),
        2 => (at(), 1..40usize).prop_map(|(at, count)| Damage::Repeat(at, count)),
        2 => (at(), at()).prop_map(|(a, b)| Damage::Swap(a, b)),
        6 => (at(), at(), sign).prop_map(|(at, within, sign)| Damage::Inside(at, within, sign)),
        1 => at().prop_map(Damage::Cut),
    ]
}

impl Damage {
    fn apply(&self, tokens: &mut Vec<String>) {
        if tokens.is_empty() {
            return;
        }
        let n = tokens.len();
        match self {
            Self::Delete(at, count) => {
                let at = at.index(n);
                tokens.drain(at..(at + count).min(n));
            }
            Self::Insert(at, piece) => tokens.insert(at.index(n + 1), (*piece).to_owned()),
            Self::Replace(at, piece) => tokens[at.index(n)] = (*piece).to_owned(),
            Self::Number(at, number) => {
                let numbers: Vec<usize> =
                    (0..n).filter(|&i| tokens[i].parse::<f64>().is_ok()).collect();
                if !numbers.is_empty() {
                    tokens[numbers[at.index(numbers.len())]] = number.clone();
                }
            }
            Self::Repeat(at, count) => {
                let at = at.index(n);
                let run: Vec<String> = tokens[at..(at + count).min(n)].to_vec();
                tokens.splice(at..at, run);
            }
            Self::Swap(a, b) => tokens.swap(a.index(n), b.index(n)),
            Self::Inside(at, within, sign) => {
                let token = &mut tokens[at.index(n)];
                let places: Vec<usize> = token.char_indices().map(|(place, _)| place).collect();
                token.insert(places[within.index(places.len())], *sign);
            }
            Self::Cut(at) => tokens.truncate(at.index(n)),
        }
    }
}

/// Mistakes have places inside their text.
fn check_places(problems: &Problems) {
    assert!(!problems.0.is_empty(), "refused without a reason");
    for problem in &problems.0 {
        let (line, column) = problem.position();
        assert!(line > 0 && column > 0);
        assert!(problem.span.start <= problem.span.end, "{problem}");
        assert!(problem.source.text.get(problem.span.clone()).is_some(), "{problem}");
        assert!(!problem.fault.to_string().trim().is_empty());
        assert!(problem.fault.to_string().len() < 20_000, "a message without end");
    }
}

/// Evaluates with few trials and writes every report.
fn evaluate_and_report(mut file: ModelFile) {
    file.task.rows.truncate(3);
    file.task.settings.trials = match file.task.settings.trials {
        Trials::Fixed(trials) => Trials::Fixed(trials.min(300)),
        Trials::Adaptive => Trials::Fixed(300),
    };
    let control = Control { threads: 1, ..Control::default() };
    let evaluation = match evaluate(&file.task, &control) {
        Ok(evaluation) => evaluation,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let warnings = warnings(&file.task, &evaluation);
    let provenance = report::Provenance { model_sha256: String::new(), files: Vec::new() };
    let report = report::EvaluationReport {
        task: &file.task,
        evaluation: &evaluation,
        warnings: &warnings,
        provenance: &provenance,
    };
    assert!(!report::table(&report, &report::TableStyle::default()).is_empty());
    assert!(!report::csv(&report).is_empty());
    let json = report::json(&report);
    let parsed = serde_json::from_str::<serde_json::Value>(&json);
    assert!(parsed.is_ok(), "the answer is no JSON: {json}");
}

fn feed(text: &str) {
    match read_text("damaged", text, Path::new("no folder"), &[]) {
        Ok(file) => evaluate_and_report(file),
        Err(problems) => check_places(&problems),
    }
}

/// Always the same cases; `GUMPTION_MUTATIONS=SEED:CASES` makes others.
fn few_cases(cases: u32) -> ProptestConfig {
    let wanted = std::env::var("GUMPTION_MUTATIONS").ok();
    let wanted = wanted.as_deref().and_then(|text| {
        let (seed, cases) = text.split_once(':')?;
        Some((seed.parse().ok()?, cases.parse().ok()?))
    });
    let (seed, cases) = wanted.unwrap_or((1, cases));
    let rng_seed = RngSeed::Fixed(seed);
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(few_cases(400))]

    #[test]
    fn damaged_model_files_are_answered(
        seed in any::<Index>(),
        damages in prop::collection::vec(damage(), 1..5),
    ) {
        let mut tokens = tokens(seed.get(seeds()).as_str());
        for damage in &damages {
            damage.apply(&mut tokens);
        }
        feed(&tokens.concat());
    }

    /// Reading a case tries all of its effects at all of its data.
    #[test]
    fn damaged_cases_are_answered(
        case in any::<Index>(),
        damages in prop::collection::vec(damage(), 1..4),
    ) {
        let (text, folder) = case.get(cases());
        let mut tokens = tokens(text);
        for damage in &damages {
            damage.apply(&mut tokens);
        }
        let text = tokens.concat();
        for checked in [check_text("damaged", &text, folder), check_text("damaged", &text, Path::new("no"))] {
            if let Err(problems) = checked {
                check_places(&problems);
            }
        }
    }

    #[test]
    fn any_text_is_answered(text in any::<String>()) {
        feed(&text);
    }

    #[test]
    fn any_bytes_are_answered(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        feed(&String::from_utf8_lossy(&bytes));
    }

    /// Other numbers in right files: most of these are evaluated.
    #[test]
    fn other_numbers_in_right_files_are_answered(
        seed in any::<Index>(),
        numbers in prop::collection::vec((any::<Index>(), number()), 1..4),
    ) {
        let mut tokens = tokens(seed.get(seeds()).as_str());
        for (at, number) in &numbers {
            Damage::Number(*at, number.clone()).apply(&mut tokens);
        }
        feed(&tokens.concat());
    }

    #[test]
    fn any_formula_is_answered(formula in formula()) {
        feed(&format!(
            r#"{{"inputs": {{
                "x": {{"distribution": "normal", "mean": 0.5, "std": 1e-3}},
                "t": {{"unit": "degC", "distribution": "rectangular", "mean": 20, "half_width": 1}}}},
              "check_units": false, "allow_undefined": 1,
              "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        ));
    }

    #[test]
    fn any_signs_of_formulas_are_answered(
        signs in prop::collection::vec(
            select(vec![
                "x", "y", "t", "(", ")", "+", "-", "*", "/", "^", ",", "<", ">=", "==", "1", "0",
                "2.5", "1e308", "1e-308", "pi", "sin", "ln", "atan2", "max", "kelvin", " ",
            ]),
            0..25,
        ),
    ) {
        let formula = signs.concat();
        feed(&format!(
            r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 0.5, "std": 1e-3}}}},
              "equations": {{"y": "{formula}"}}, "outputs": {{"y": {{}}}}}}"#
        ));
    }

    #[test]
    fn any_numbers_are_answered(
        mean in finite(),
        width in finite(),
        dof in finite(),
        p in finite(),
        unit in select(vec!["m", "nm", "km^20", "Gm^-30", "1e300 m", "deg", "%", "degC"]),
        shape in select(vec!["normal\", \"std", "rectangular\", \"half_width", "t\", \"scale"]),
    ) {
        let (width, dof, p) = (width.abs(), dof.abs(), (p.abs() % 1.0).max(1e-300));
        feed(&format!(
            r#"{{"inputs": {{"x": {{"unit": "{unit}", "distribution": "{shape}": {width:e},
                "mean": {mean:e}, "dof": {dof:e}}}}},
              "check_units": false, "allow_undefined": 1, "coverage_probability": {p:e},
              "equations": {{"y": "x*x"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
        ));
    }
}

/// Files that once were answered badly, and extremes.
#[test]
fn extremes_are_answered() {
    let one = |input: &str, equation: &str| {
        feed(&format!(
            r#"{{"inputs": {{"x": {{"distribution": {input}}}}},
                "equations": {{"y": "{equation}"}}, "outputs": {{"y": {{}}}}}}"#
        ));
    };
    for input in [
        r#""normal", "mean": 1e308, "std": 1e308"#,
        r#""normal", "mean": 0, "std": 5e-324"#,
        r#""normal", "mean": 1, "std": 1e-300"#,
        r#""rectangular", "lower": -1.7e308, "upper": 1.7e308"#,
        r#""rectangular", "mean": 1, "half_width": 5e-324"#,
        r#""triangular", "lower": 0, "upper": 5e-324"#,
        r#""t", "mean": 0, "scale": 1, "dof": 1e-300"#,
        r#""t", "mean": 0, "scale": 1, "dof": 0.5"#,
        r#""t", "mean": 0, "scale": 1e-320, "dof": 1e300"#,
        r#""normal", "mean": 0, "std": 1, "dof": 1e-5"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 0.9999999999999999"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 1e-300"#,
        r#""normal", "mean": 0, "expanded": 1, "p": 0.95, "dof": 1e-3"#,
        r#""normal", "mean": 0, "expanded": 1, "k": 5e-324"#,
        r#""readings", "values": [1e308, -1e308]"#,
        r#""readings", "values": [1, 1.0000000000000002]"#,
        r#""readings", "values": [5e-324, 0]"#,
        r#""constant", "value": 1e308"#,
        r#""trapezoidal", "lower": -1.7e308, "upper": 1.7e308, "beta": 1"#,
        r#""trapezoidal", "lower": 0, "upper": 5e-324, "beta": 0"#,
        r#""curvilinear-trapezoid", "lower": 0, "upper": 1, "inexactness": 0.5"#,
        r#""curvilinear-trapezoid", "lower": 0, "upper": 1e308, "inexactness": 5e-324"#,
        r#""arcsine", "mean": 0, "half_width": 1.7e308"#,
        r#""exponential", "mean": 1.7e308"#,
        r#""exponential", "mean": 5e-324"#,
        r#""gamma", "shape": 1e-300, "rate": 1e300"#,
        r#""gamma", "shape": 1e300, "rate": 1e-300"#,
        r#""gamma", "shape": 1e300, "rate": 1e300"#,
        r#""lognormal", "mean": 1e300, "std": 5e-324"#,
        r#""lognormal", "mean": 5e-324, "std": 1e300"#,
        r#""beta", "alpha": 1e-300, "beta": 1e-300"#,
        r#""beta", "alpha": 1e300, "beta": 1e300"#,
        r#""beta", "alpha": 1e-300, "beta": 1e300, "lower": -1e308, "upper": 1e308"#,
        r#""log-uniform", "lower": 5e-324, "upper": 1.7e308"#,
        r#""log-uniform", "lower": 1, "upper": 1.0000000000000002"#,
        r#""poisson-count", "count": 0"#,
        r#""poisson-count", "count": 999999999999999"#,
        r#""samples", "values": [1e308, -1e308, 1e308]"#,
        r#""samples", "values": [5e-324]"#,
    ] {
        for equation in ["x", "x*x", "1/x", "exp(x)", "x - x", "x^x", "0*x", "x > 0", "1e308*x"] {
            one(input, equation);
        }
    }
}
