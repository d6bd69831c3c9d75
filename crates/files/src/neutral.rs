//! `neutral`: at which values of its parameters an effect of a simulator is absent.

use gumption_engine::distribution::Distribution;
use gumption_engine::model::Quantity;
use gumption_gap::is_whole_turn;
use gumption_text::DiagnosticKind;
use gumption_text::json::Member;
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;

/// What makes an effect of the simulator absent: places of its parameters with values; `None` after a
/// mistake. Where one parameter alone can do so and the file does not say, it is 0 of that one: an angle of the
/// whole turn cannot, since 0 is a direction like any other.
pub(super) fn read(
    effect: &Object<'_>,
    parameters: &[(&Quantity, &Distribution)],
    diagnostic: impl Fn(&str) -> DiagnosticKind,
) -> Option<Vec<(usize, f64)>> {
    let Some(member) = effect.get("neutral") else {
        let can = |(quantity, prior): &(&Quantity, &Distribution)| {
            parameters.len() == 1 || !is_whole_turn(prior, &quantity.unit)
        };
        let able: Vec<usize> = (0..parameters.len()).filter(|&p| can(&parameters[p])).collect();
        return match (&able[..], parameters) {
            ([place], _) => Some(vec![(*place, 0.0)]),
            (_, []) => {
                effect.report(diagnostic(
                    "has no parameter, and the simulator can only do what a parameter lets it",
                ));
                None
            }
            (_, [(first, _), ..]) => {
                let reason = format!(
                    "has {} parameters; say which of them make it absent, and at what values: \
                     `\"neutral\": {{\"{}\": 0}}`, the others being its shape",
                    parameters.len(),
                    first.name
                );
                effect.report(diagnostic(&reason));
                None
            }
        };
    };
    let object = Object::new(effect.log, "`neutral`", &member.value, &member.key_span)?;
    if object.members().is_empty() {
        object.report(diagnostic("names no parameter that makes it absent"));
        return None;
    }
    let value = |member: &Member| {
        let Some(place) = parameters.iter().position(|(p, _)| p.name == member.key) else {
            let reason = format!("has no parameter `{}` that could make it absent", member.key);
            effect.log.report(&member.key_span, diagnostic(&reason));
            return None;
        };
        let unit = &parameters[place].0.unit;
        Some((place, object.value(&member.key, unit, ValueOf::Quantity)?))
    };
    object.members().iter().map(value).collect::<Vec<_>>().into_iter().collect()
}
