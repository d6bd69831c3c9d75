//! The prior probabilities of the hypotheses of a case.

use super::keys;
use gumption_gap::Prior;
use gumption_text::DiagnosticKind;
use gumption_text::object::Object;

/// Reads `prior`: shares of probability that are scaled to sum to one.
pub(super) fn read(root: &Object<'_>) -> Option<Prior> {
    let Some(member) = root.get("prior") else {
        return Some(Prior::DEFAULT);
    };
    let object = Object::new(root.log, "`prior`", &member.value, &member.key_span)?;
    keys::check(&object, keys::PRIOR);
    let mut clean = true;
    let mut share = |key: &str, default: f64| {
        let Some(value) = object.number(key) else {
            clean &= object.get(key).is_none();
            return default;
        };
        if !(0.0..=1.0).contains(&value) {
            let place = object.get(key).map_or(object.place(), |member| &member.value.span);
            root.log.report(
                place,
                DiagnosticKind::NotProbability { key: key.to_owned(), found: value, below: 1.0 },
            );
            clean = false;
        }
        value
    };
    let default = Prior::DEFAULT;
    let mut prior = Prior {
        none: share("none", default.none),
        one: share("one", default.one),
        two: share("two", default.two),
        three: share("three", default.three),
        unexplained: share("unexplained", default.unexplained),
    };
    if !clean {
        return None;
    }
    let sum = prior.none + prior.one + prior.two + prior.three + prior.unexplained;
    if !(0.999..=1.001).contains(&sum) {
        // without the last bits of a sum of decimals
        let sum = (sum * 1e9).round() / 1e9;
        let reason = format!(
            "the prior probabilities of none, one, two, three and unexplained sum to {sum}, but must \
             sum to 1; those that are not given are {}, {}, {}, {} and {}",
            default.none, default.one, default.two, default.three, default.unexplained
        );
        root.log.report(&member.value.span, DiagnosticKind::Prior { reason });
        return None;
    }
    for share in
        [&mut prior.none, &mut prior.one, &mut prior.two, &mut prior.three, &mut prior.unexplained]
    {
        *share /= sum;
    }
    Some(prior)
}

/// Reports a prior of which no hypothesis with at most so many effects has any; `None` then.
pub(super) fn check_possible(root: &Object<'_>, prior: &Prior, effects: usize) -> Option<()> {
    if prior.is_possible(effects) {
        return Some(());
    }
    let place = root.get("prior").map_or(root.place(), |prior| &prior.value.span);
    let reason = format!(
        "no hypothesis has a prior probability above 0: the case has {effects} effects, and those \
         that have one need more"
    );
    root.log.report(place, DiagnosticKind::Prior { reason });
    None
}
