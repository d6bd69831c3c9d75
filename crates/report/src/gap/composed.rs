//! Effects that are composed where no candidate explains the gap.

use serde_json::{Value, json};

use super::digits::{self, probability, share};
use super::words::unit;
use crate::answer::{list, object};
use crate::number::with_uncertainty;
use crate::plain;
use gumption_gap::{
    ComposedEffect, ComposedParameter, ComposedPrior, ComposedTerm, DepartureKind, DepartureOver,
    Diagnosis,
};
use gumption_units::listed;

/// Composed effects that the page shows, at most.
const TOLD: usize = 4;

/// Composed effects below this probability are not shown on the page.
const WORTH_TELLING: f64 = 0.02;

/// The composed effects, most probable first. Each is an effect as cases have it, with more keys that
/// say what it is; the readers of cases know these.
pub(super) fn composed(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.composed.iter().map(effect))
}

fn effect(of: &ComposedEffect) -> Value {
    let first = of.terms.first();
    let quantities = |term: &ComposedTerm| term.quantities.join(", ");
    let terms = of.terms.iter().map(|term| {
        json!({
            "quantity": quantities(term),
            "kind": term.kind.name(),
            "over": term.over.name(),
            "form": term.form.name(),
        })
    });
    let estimate = |parameter: &ComposedParameter| {
        json!({
            "unit": parameter.unit,
            "estimate": parameter.estimate,
            "standard_uncertainty": parameter.standard_uncertainty,
        })
    };
    let parameters = of.parameters.iter();
    object([
        ("name", json!(of.name)),
        ("quantity", json!(first.map(quantities))),
        ("kind", json!(first.map(|term| term.kind.name()))),
        ("over", json!(first.and_then(|term| term.over.name()))),
        ("form", json!(first.map(|term| term.form.name()))),
        ("terms", list(terms)),
        ("beside", json!(of.beside)),
        ("overrides", object(of.overrides.iter().map(|(name, text)| (name.as_str(), json!(text))))),
        ("parameters", object(parameters.clone().map(|p| (p.name.as_str(), prior(p))))),
        ("estimates", object(parameters.map(|p| (p.name.as_str(), estimate(p))))),
        ("probability", json!(of.probability)),
        (
            "shrinks",
            json!({
                "rms_before": of.shrunk.rms_before,
                "rms_after": of.shrunk.rms_after,
                "removed_fraction": of.shrunk.removed_fraction,
            }),
        ),
        ("about", json!(format!("Composed, not from the list: {}", words(of)))),
    ])
}

/// A parameter as cases have it.
fn prior(of: &ComposedParameter) -> Value {
    let unit = &of.unit;
    match of.prior {
        ComposedPrior::Normal { mean, std } => {
            json!({"unit": unit, "distribution": "normal", "mean": mean, "std": std})
        }
        ComposedPrior::Rectangular { lower, upper } => {
            json!({"unit": unit, "distribution": "rectangular", "lower": lower, "upper": upper})
        }
        ComposedPrior::LogUniform { lower, upper } => {
            json!({"unit": unit, "distribution": "log-uniform", "lower": lower, "upper": upper})
        }
    }
}

/// A composed effect in words: what is added to which quantity.
fn words(of: &ComposedEffect) -> String {
    let term = |term: &ComposedTerm| {
        let quantities: Vec<String> = term.quantities.iter().map(|name| plain(name)).collect();
        let quantities = listed(&quantities, " and ");
        let kind = match term.kind {
            DepartureKind::Additive => format!("an addition to {quantities}"),
            DepartureKind::Proportional => format!("a share of {quantities}"),
        };
        let form = term.form.name();
        let article = if form == "exponential" { "an" } else { "a" };
        match &term.over {
            DepartureOver::Nothing => format!("{kind}, a constant"),
            DepartureOver::Value => format!("{kind}, {article} {form} over its own value"),
            DepartureOver::Condition(name) => {
                format!("{kind}, {article} {form} over {}", plain(name))
            }
            DepartureOver::AllConditions => format!("{kind}, {article} {form}"),
        }
    };
    let terms: Vec<String> = of.terms.iter().map(term).collect();
    let joint = if of.product { " times " } else { ", and " };
    let mut said = terms.join(joint);
    if !of.beside.is_empty() {
        let names: Vec<String> = of.beside.iter().map(|name| plain(name)).collect();
        said.push_str(&format!(", beside {}", listed(&names, " and ")));
    }
    said
}

/// The composed effects in sentences, those that are worth a line.
pub(super) fn sentences(diagnosis: &Diagnosis) -> Vec<String> {
    let worth = |of: &&ComposedEffect| of.probability >= WORTH_TELLING;
    diagnosis.composed.iter().filter(worth).take(TOLD).map(sentence).collect()
}

fn sentence(of: &ComposedEffect) -> String {
    let formulas: Vec<String> = of
        .overrides
        .iter()
        .map(|(name, text)| format!("{} becomes {}", plain(name), plain(text)))
        .collect();
    let parameter = |parameter: &ComposedParameter| {
        let (estimate, u) = with_uncertainty(
            parameter.estimate,
            parameter.standard_uncertainty,
            digits::UNCERTAINTY,
        );
        let unit = unit(&parameter.unit).map(|unit| format!(" {unit}")).unwrap_or_default();
        format!("{} = {estimate}{unit} with standard uncertainty {u}", plain(&parameter.name))
    };
    let parameters: Vec<String> = of.parameters.iter().map(parameter).collect();
    format!(
        "With probability {}: {}. {}, with {}. It removes a fraction {} of the gap (composed, not \
         from your list).",
        probability(of.probability),
        words(of),
        listed(&formulas, " and "),
        parameters.join(", "),
        share(of.shrunk.removed_fraction)
    )
}

/// What of the catalogue that ships with the program would explain the gap; `None` where nothing would.
pub(super) fn unlisted(diagnosis: &Diagnosis) -> Option<String> {
    let worth = diagnosis.unlisted.iter().filter(|of| of.probability >= WORTH_TELLING);
    let named: Vec<String> = worth
        .map(|of| format!("{} (probability {})", plain(&of.effect), probability(of.probability)))
        .collect();
    (!named.is_empty()).then(|| {
        format!(
            "Effects that ship with gumption, are not in the list, and would explain the gap \
             alone: {}. Add one by `\"catalogue\": [\"NAME\"]` in the case.",
            named.join(", ")
        )
    })
}

/// What can be done with the composed effects.
pub(super) const HOW_TO_USE: &str = "A composed effect can be copied from the JSON answer \
     (`composed`) into the case's `effects`; the next diagnosis then weighs it with the others. \
     It is a formula that these data suggest, not a cause: look for the cause on the bench.";
