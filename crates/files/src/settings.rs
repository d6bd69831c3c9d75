//! Coverage and Monte Carlo settings of a file.

use super::coverage_slips;
use super::keys;
use gumption_engine::task::{
    Coverage, MethodChoice, Settings, StatementMethod, StoppingRule, Trials,
};
use gumption_text::DiagnosticKind;
use gumption_text::json::Json;
use gumption_text::object::{Object, whole_number};

/// At most so many trials.
pub(super) const MOST_TRIALS: u64 = 1_000_000_000_000;

/// Up to so many trials a run goes on of itself where clause 8 is undecided, if nobody said how many to
/// make.
const DECIDE_UP_TO: u64 = 64_000_000;

/// Reads the settings of the root object; what is not there has its default.
pub(super) fn read(root: &Object<'_>) -> Settings {
    let mut settings = Settings::default();
    settings.decide_up_to = DECIDE_UP_TO;
    if let Some(coverage) = coverage(root) {
        settings.coverage = coverage;
    }
    settings.statement = statement(root).unwrap_or(settings.statement);
    settings.statement_tolerance =
        statement_tolerance(root).unwrap_or(settings.statement_tolerance);
    if let Some(member) = root.get("allow_undefined")
        && let Some(share) = root.number("allow_undefined")
    {
        if (0.0..=1.0).contains(&share) {
            settings.allowed_undefined = share;
        } else {
            let diagnostic = DiagnosticKind::NotProbability {
                key: "allow_undefined".into(),
                found: share,
                below: 1.0,
            };
            root.log.report(&member.value.span, diagnostic);
        }
    }
    if let Some(digits) = root.whole("shown_digits", 1, 15) {
        settings.shown_digits = u32::try_from(digits).ok();
    }
    let Some(member) = root.get("monte_carlo") else {
        return settings;
    };
    let Some(object) = Object::new(root.log, "`monte_carlo`", &member.value, &member.key_span)
    else {
        return settings;
    };
    keys::check(&object, keys::MONTE_CARLO);
    if let Some(trials) = trials(&object) {
        settings.trials = trials;
        settings.decide_up_to = 0;
    }
    if let Some(rule) = rule(&object) {
        settings.rule = rule;
    }
    if let Some(seed) = object.whole("seed", 0, u64::MAX) {
        settings.seed = seed;
    }
    if let Some(digits) = object.whole("digits", 1, 15) {
        settings = settings.with_digits(u32::try_from(digits).unwrap_or(2));
    }
    if let Some(most) = object.whole("max_trials", 20_000, MOST_TRIALS) {
        settings.max_trials = most;
    }
    settings
}

fn trials(object: &Object<'_>) -> Option<Trials> {
    let member = object.get("trials")?;
    match &member.value.value {
        Json::Text(text) if text == "adaptive" => Some(Trials::Adaptive),
        Json::Text(text) => {
            let diagnostic = DiagnosticKind::NotOneOf {
                key: "trials".into(),
                found: text.clone(),
                allowed: vec!["adaptive".into(), "a whole number such as 1000000".into()],
            };
            object.log.report(&member.value.span, diagnostic);
            None
        }
        Json::Number(text) => {
            let count = whole_number(text).filter(|&n| n != 1 && n <= MOST_TRIALS);
            if count.is_none() {
                let diagnostic =
                    DiagnosticKind::NotTrials { found: text.to_string(), most: MOST_TRIALS };
                object.log.report(&member.value.span, diagnostic);
            }
            count.map(Trials::Fixed)
        }
        _ => {
            object.number("trials");
            None
        }
    }
}

/// A value by its name, if the key is there.
pub(super) fn named<T>(
    object: &Object<'_>,
    key: &'static str,
    find: impl Fn(&str) -> Option<T>,
    allowed: &[&str],
) -> Option<T> {
    let name = object.text(key)?;
    let found = find(name);
    if let (None, Some(member)) = (&found, object.get(key)) {
        let allowed = allowed.iter().map(|name| (*name).to_owned()).collect();
        let diagnostic =
            DiagnosticKind::NotOneOf { key: key.into(), found: name.to_owned(), allowed };
        object.log.report(&member.value.span, diagnostic);
    }
    found
}

/// Which figures without noise are wanted, if a model file says so.
pub(super) fn method(root: &Object<'_>) -> Option<MethodChoice> {
    named(root, "method", MethodChoice::named, &MethodChoice::ALL.map(MethodChoice::name))
}

/// When an adaptive run stops.
fn rule(object: &Object<'_>) -> Option<StoppingRule> {
    named(object, "rule", StoppingRule::named, &StoppingRule::ALL.map(StoppingRule::name))
}

/// Which method gives the stated uncertainty, if the object says so.
pub(super) fn statement(object: &Object<'_>) -> Option<StatementMethod> {
    let names = StatementMethod::ALL.map(StatementMethod::name);
    named(object, "statement", StatementMethod::named, &names)
}

/// The difference of an endpoint relative to U up to which the law of propagation is stated, if the
/// object says so.
pub(super) fn statement_tolerance(root: &Object<'_>) -> Option<f64> {
    const KEY: &str = "statement_tolerance";
    let member = root.get(KEY)?;
    let found = root.number(KEY)?;
    if found > 0.0 && found < 1.0 {
        return Some(found);
    }
    let range = "above 0 and below 1, such as 0.05";
    let diagnostic = DiagnosticKind::OutOfRange { key: KEY.to_owned(), found, range };
    root.log.report(&member.value.span, diagnostic);
    None
}

/// The coverage that a root object asks for, if it does.
pub(super) fn coverage(root: &Object<'_>) -> Option<Coverage> {
    let fixed = root.truth("coverage_factor_fixed").unwrap_or(false);
    if let (Some(member), None) = (root.get("coverage_factor_fixed"), root.get("coverage_factor")) {
        let diagnostic = DiagnosticKind::MissingKey { key: "coverage_factor", what: "the file" };
        root.log.report(&member.key_span, diagnostic);
        return None;
    }
    match (root.get("coverage_probability"), root.get("coverage_factor")) {
        (Some(_), Some(second)) => {
            let diagnostic = DiagnosticKind::Exclusive {
                first: "coverage_probability",
                second: "coverage_factor",
            };
            root.log.report(&second.key_span, diagnostic);
            None
        }
        (Some(member), None) => {
            let found = root.number("coverage_probability")?;
            let key = "coverage_probability".to_owned();
            let diagnostic = match coverage_slips::of_probability(found) {
                Some(range) => DiagnosticKind::OutOfRange { key, found, range },
                None if found > 0.0 && found < 1.0 => return Some(Coverage::Probability(found)),
                None => DiagnosticKind::NotProbability { key, found, below: 1.0 },
            };
            root.log.report(&member.value.span, diagnostic);
            None
        }
        (None, Some(member)) => {
            let found = root.number("coverage_factor")?;
            let range = match coverage_slips::of_factor_of_results(found) {
                Some(range) => range,
                // beyond 8 the probability is 1 in double precision
                None if found > 0.0 && found <= 8.0 => {
                    return Some(Coverage::Factor { factor: found, fixed });
                }
                None => "above 0 and at most 8",
            };
            let key = "coverage_factor".to_owned();
            root.log.report(&member.value.span, DiagnosticKind::OutOfRange { key, found, range });
            None
        }
        (None, None) => None,
    }
}
