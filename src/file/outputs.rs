//! The outputs of a file.

use std::ops::Range;

use super::Fault;
use super::conditions::unit;
use super::json::{Json, Member};
use super::object::Object;
use super::problem::Log;
use crate::distribution::Invalid;
use crate::model::{Output, Quantity, Tolerance};
use crate::unit::Unit;

/// Outputs with their places.
#[derive(Debug, Default)]
pub(super) struct Outputs {
    pub(super) outputs: Vec<Output>,
    pub(super) places: Vec<Range<usize>>,
    /// Where each output's unit stands.
    pub(super) unit_places: Vec<Range<usize>>,
    /// Names of those whose unit could not be read.
    pub(super) without_unit: Vec<String>,
}

/// Reads `outputs`.
pub(super) fn read(log: &Log, member: &Member) -> Option<Outputs> {
    let object = Object::new(log, "`outputs`", &member.value, &member.key_span)?;
    if object.members().is_empty() {
        object.report(Fault::NoValues { name: "outputs".into() });
    }
    let mut outputs = Outputs::default();
    for member in object.members().iter().take_while(|_| !log.is_full()) {
        let Some(object) = Object::new(log, "an output", &member.value, &member.key_span) else {
            continue;
        };
        object.check_keys(&["unit", "about", "periodic", "tolerance", "cmc", "cmc_floor"]);
        for key in ["cmc", "cmc_floor"] {
            if let Some(member) = object.get(key) {
                let what = format!("`{key}` of an output");
                log.report(&member.key_span, Fault::NotBuilt { what });
            }
        }
        let period = object.number("periodic");
        if let (Some(period), Some(member)) = (period, object.get("periodic"))
            && period <= 0.0
        {
            let fault = Fault::NotPositive { key: "periodic".into(), found: period };
            log.report(&member.value.span, fault);
        }
        let quantity = Quantity {
            name: member.key.clone(),
            unit: unit(&object, "unit").unwrap_or_else(|| {
                outputs.without_unit.push(member.key.clone());
                Unit::one()
            }),
            about: object.text("about").unwrap_or("").to_owned(),
        };
        let unit_place = object.get("unit").map_or(&member.key_span, |m| &m.value.span);
        let tolerance = tolerance(&object);
        outputs.outputs.push(Output { quantity, period, tolerance });
        outputs.places.push(member.key_span.clone());
        outputs.unit_places.push(unit_place.clone());
    }
    Some(outputs)
}

/// The tolerance limits of an output.
fn tolerance(output: &Object<'_>) -> Option<Tolerance> {
    let member = output.get("tolerance")?;
    let object = Object::new(output.log, "`tolerance`", &member.value, &member.key_span)?;
    object.check_keys(&["lower", "upper", "prior"]);
    if let Some(prior) = object.get("prior") {
        let what = "the global risk that `prior` is for".to_owned();
        object.log.report(&prior.key_span, Fault::NotBuilt { what });
    }
    // null stands for a limit that is not there
    let limit = |key: &str| match object.get(key).map(|m| &m.value.value) {
        None | Some(Json::Null) => None,
        Some(_) => object.number(key),
    };
    let (lower, upper) = (limit("lower"), limit("upper"));
    match (lower, upper) {
        (None, None) => {
            object.report(Fault::NoValues { name: "tolerance".into() });
            None
        }
        (Some(lower), Some(upper)) if lower >= upper => {
            let error = Invalid::LimitsReversed { lower, upper };
            object.report(Fault::Distribution { name: "tolerance".into(), error });
            None
        }
        _ => Some(Tolerance { lower, upper }),
    }
}
