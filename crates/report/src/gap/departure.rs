//! What is known of a departure that no candidate effect makes.

use serde_json::{Value, json};

use super::digits::{condition, probability};
use super::words::unit;
use crate::answer::list;
use crate::number::significant;
use crate::plain;
use gumption_gap::{
    DepartureForm, DepartureKind, DepartureOver, DepartureShape, Diagnosis, LeftBeside,
    NamedQuantity,
};
use gumption_units::listed;

/// Forms that the page tells, at most.
const TOLD: usize = 5;

/// Forms below this probability are not told on the page.
const WORTH_TELLING: f64 = 0.02;

/// The forms, most probable first.
pub(super) fn departure(diagnosis: &Diagnosis) -> Value {
    list(diagnosis.departure.iter().map(|form| {
        json!({
            "outputs": form.outputs,
            "kind": form.kind.name(),
            "common": form.common,
            "over": form.over.name(),
            "shape": form.shape.name(),
            "at": at(form.shape),
            "scale": form.scale,
            "scale_is_factor": form.logarithmic,
            "scale_unit": form.scale_unit,
            "size": form.size,
            "size_unit": form.unit,
            "beside": form.beside,
            "probability": form.probability,
            "words": words(form, &diagnosis.conditions),
        })
    }))
}

/// What is left beside the effects of the verdict; null where nothing is.
pub(super) fn beside(diagnosis: &Diagnosis) -> Value {
    let Some(left) = &diagnosis.most_probable.beside else { return Value::Null };
    json!({
        "probability": left.probability,
        "outputs": left.form.outputs,
        "kind": left.form.kind.name(),
        "over": left.form.over.name(),
        "shape": left.form.shape.name(),
        "at": at(left.form.shape),
        "size": left.form.size,
        "size_unit": left.form.unit,
        "words": words(&left.form, &diagnosis.conditions),
        "share_of_gap": left.share_of_gap,
    })
}

/// What is left beside the effects of the verdict, in words.
pub(super) fn left_beside(diagnosis: &Diagnosis, left: &LeftBeside) -> String {
    words(&DepartureForm { beside: Vec::new(), ..left.form.clone() }, &diagnosis.conditions)
}

fn at(shape: DepartureShape) -> Option<f64> {
    match shape {
        DepartureShape::Step { at, .. }
        | DepartureShape::Peak { at }
        | DepartureShape::Dip { at } => Some(at),
        _ => None,
    }
}

/// The forms in sentences, those that are worth a line.
pub(super) fn sentences(diagnosis: &Diagnosis) -> Vec<String> {
    let worth = |form: &&DepartureForm| form.probability >= WORTH_TELLING;
    let told = diagnosis.departure.iter().filter(worth).take(TOLD);
    told.map(|form| {
        format!(
            "With probability {}: {}.",
            probability(form.probability),
            words(form, &diagnosis.conditions)
        )
    })
    .collect()
}

/// A form in words: which outputs, added or a share of the sim, of what, how large.
fn words(form: &DepartureForm, conditions: &[NamedQuantity]) -> String {
    let outputs: Vec<String> = form.outputs.iter().map(|name| plain(name)).collect();
    let all = listed(&outputs, " and ");
    let with_unit = |number: String, text: &str| match unit(text) {
        Some(unit) => format!("{number} {unit}"),
        None => number,
    };
    let kind = match form.kind {
        DepartureKind::Additive => "an added term".to_owned(),
        DepartureKind::Proportional => "a share of the sim".to_owned(),
    };
    let (what, place_unit) = match &form.over {
        DepartureOver::Condition(name) => {
            let known = conditions.iter().find(|condition| condition.name == *name);
            (plain(name), known.map_or("", |condition| condition.unit.as_str()))
        }
        _ => ("the sim's own value".to_owned(), form.scale_unit.as_str()),
    };
    let place = |at: f64| with_unit(condition(at), place_unit);
    let function = match (&form.over, form.shape) {
        (_, DepartureShape::Settings) => return error_of_settings(form, &outputs, &what),
        (DepartureOver::Nothing, _) => "the same in all conditions".to_owned(),
        (DepartureOver::AllConditions, _) => "varying with several conditions together".to_owned(),
        (_, DepartureShape::Levels | DepartureShape::Constant) => {
            format!("with a value of its own at each level of {what}")
        }
        (_, DepartureShape::Rising) => format!("rising with {what}"),
        (_, DepartureShape::Falling) => format!("falling with {what}"),
        (_, DepartureShape::Step { at, up }) => {
            let turn = if up { "up" } else { "down" };
            format!("stepping {turn} over {what} near {}", place(at))
        }
        (_, DepartureShape::Peak { at }) => {
            format!("with a maximum over {what} near {}", place(at))
        }
        (_, DepartureShape::Dip { at }) => format!("with a minimum over {what} near {}", place(at)),
        (_, DepartureShape::Loop) => {
            format!("varying differently with the condition for each {what}")
        }
        (_, DepartureShape::Varying) => format!("varying with {what} more than once up or down"),
    };
    let mut said = format!("{all} departs by {kind}, {function}");
    if outputs.len() > 1 {
        said = said.replacen("departs", "depart", 1);
        said.push_str(if form.common {
            ", the same in all of them"
        } else {
            ", different in each"
        });
    }
    if let Some(scale) = form.scale {
        let number = significant(scale, 2);
        if form.logarithmic {
            said.push_str(&format!(", over a factor of {number} of it"));
        } else {
            let scale = with_unit(number, &form.scale_unit);
            said.push_str(&format!(", over a length of {scale}"));
        }
    }
    let size = match form.kind {
        DepartureKind::Additive => with_unit(significant(form.size, 2), &form.unit),
        DepartureKind::Proportional => format!("{} %", significant(100.0 * form.size, 2)),
    };
    said.push_str(&format!("; root mean square {size}"));
    if !form.beside.is_empty() {
        let names: Vec<String> = form.beside.iter().map(|name| plain(name)).collect();
        said.push_str(&format!(", beside {}", listed(&names, " and ")));
    }
    said
}

/// An error of each setting, with its standard deviation for the first output.
fn error_of_settings(form: &DepartureForm, outputs: &[String], condition: &str) -> String {
    let what = match form.over {
        DepartureOver::Condition(_) => condition,
        _ => "the conditions",
    };
    let size = significant(form.size, 2);
    let size = unit(&form.unit).map_or(size.clone(), |unit| format!("{size} {unit}"));
    let all = listed(outputs, " and ");
    match outputs {
        [first, _, ..] => format!(
            "{all} each have an error of their own for every setting of {what}, constant until \
             the next setting; standard deviation for {first}: {size}"
        ),
        _ => format!(
            "{all} has an error for every setting of {what}, constant until the next setting; \
             standard deviation {size}"
        ),
    }
}
