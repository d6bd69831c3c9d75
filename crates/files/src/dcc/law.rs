//! What a model file says of the distribution of values for which a certificate names none that is known.

use super::Fault;
use super::document::Measured;
use gumption_text::DiagnosticKind;
use gumption_text::named_shape::NamedShape;
use gumption_text::object::Object;

/// The distributions that it may say.
pub(crate) const LAWS: [&str; 5] = ["normal", "t", "rectangular", "triangular", "arcsine"];

/// Gives the values the distribution that the object says, if it says one; whether it could be read.
///
/// # Errors
/// The certificate names another distribution.
pub(super) fn state(object: &Object<'_>, measured: &mut [Measured]) -> Result<bool, Fault> {
    let Some(member) = object.get("law") else { return Ok(true) };
    let Some(found) = object.text("law") else { return Ok(false) };
    let Some(law) = LAWS.iter().find(|law| **law == found) else {
        let allowed = LAWS.map(str::to_owned).to_vec();
        let diagnostic =
            DiagnosticKind::NotOneOf { key: "law".into(), found: found.to_owned(), allowed };
        object.log.report(&member.value.span, diagnostic);
        return Ok(false);
    };
    if measured.iter().all(|measured| measured.uncertainty.is_none()) {
        let reason =
            "the certificate states no uncertainty here, of which `law` could be the distribution";
        let reason = reason.to_owned();
        object.log.report(&member.key_span, DiagnosticKind::Certificate { reason });
        return Ok(false);
    }
    for measured in measured {
        let count = measured.values.len();
        let Some(stated) = &mut measured.uncertainty else { continue };
        stated.distributions.resize(count, String::new());
        for called in &mut stated.distributions {
            let named = NamedShape::of(called).and_then(NamedShape::name);
            if let Some(named) = named.filter(|named| named != law) {
                let reason = format!(
                    "the distribution of this quantity is called `{called}` ({named}), and the model file \
                     says `\"law\": \"{law}\"`: leave it out, or ask which is right"
                );
                return Err((measured.span.clone(), reason));
            }
            (*law).clone_into(called);
        }
    }
    Ok(true)
}
