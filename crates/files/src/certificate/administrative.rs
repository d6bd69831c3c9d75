//! Device, parties, dates and texts of a certificate.

use super::super::keys;
use super::{named, texts};
use gumption_analysis::certificate::contents::{
    AdministrativeData, Device, Language, Localized, NAME_OF_READINGS, Party, PerformanceLocation,
};
use gumption_text::DiagnosticKind;
use gumption_text::date::Day;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;

/// Reads what the certificate says beside its results; `None` after a mistake.
///
/// `readings` is the name of the file of readings, if there is one.
pub(super) fn read(root: &Object<'_>, readings: Option<&str>) -> Option<AdministrativeData> {
    let place = named(
        root,
        "place",
        PerformanceLocation::named,
        &PerformanceLocation::ALL.map(PerformanceLocation::name),
    );
    let remarks = match root.get("remarks").map(|member| &member.value.value) {
        Some(Json::List(_)) => {
            texts(root, "remarks").into_iter().map(|(text, _)| Localized::plain(text)).collect()
        }
        Some(_) => localized(root, "remarks").into_iter().collect(),
        None => Vec::new(),
    };
    let days = days(root);
    Some(AdministrativeData {
        title: localized(root, "title"),
        number: named_by(root, "number", readings),
        device: device(root, readings),
        customer: party(root, "customer"),
        laboratory: party(root, "laboratory"),
        responsible: owned(root, "responsible"),
        calibrated: days.calibrated,
        received: days.received,
        issued: days.issued,
        place: place.unwrap_or_default(),
        environment: localized(root, "environment"),
        method: localized(root, "method"),
        traceability: localized(root, "traceability"),
        remarks,
    })
}

/// A text; one without a letter says nothing.
pub(super) fn owned(object: &Object<'_>, key: &str) -> Option<String> {
    object.text(key).filter(|text| !text.trim().is_empty()).map(str::to_owned)
}

/// A text that may name the file of readings.
fn named_by(object: &Object<'_>, key: &str, readings: Option<&str>) -> Option<String> {
    let text = owned(object, key)?;
    let Some(name) = readings else { return Some(text) };
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    Some(text.replace(NAME_OF_READINGS, stem))
}

/// A text, or an object with a text for each language.
pub(super) fn localized(object: &Object<'_>, key: &str) -> Option<Localized> {
    let member = object.get(key)?;
    let Json::Object(_) = &member.value.value else {
        return object.text(key).map(Localized::plain);
    };
    let texts =
        Object::new(object.log, "a text in several languages", &member.value, &member.key_span)?;
    keys::check_names(&texts, &Language::ALL.map(Language::code));
    let found: Vec<(Option<Language>, String)> = Language::ALL
        .into_iter()
        .filter_map(|language| Some((Some(language), owned(&texts, language.code())?)))
        .collect();
    if found.is_empty() {
        object.log.report(&member.key_span, DiagnosticKind::NoValues { name: key.to_owned() });
        return None;
    }
    Some(Localized { texts: found })
}

/// A device: a text, or an object.
fn device(root: &Object<'_>, readings: Option<&str>) -> Option<Device> {
    let member = root.get("device")?;
    if let Json::Text(name) = &member.value.value {
        return Some(Device { name: Localized::plain(name.clone()), ..Device::default() });
    }
    let object = Object::new(root.log, "`device`", &member.value, &member.key_span)?;
    keys::check(&object, keys::DEVICE);
    object.required("name");
    Some(Device {
        name: localized(&object, "name")?,
        manufacturer: owned(&object, "manufacturer"),
        model: owned(&object, "model"),
        condition: localized(&object, "condition"),
        serial_number: named_by(&object, "serial_number", readings),
        customer_number: named_by(&object, "customer_number", readings),
    })
}

/// A laboratory or a customer: a text, or an object.
fn party(root: &Object<'_>, key: &'static str) -> Option<Party> {
    let member = root.get(key)?;
    if let Json::Text(name) = &member.value.value {
        return Some(Party { name: name.clone(), ..Party::default() });
    }
    let what = if key == "customer" { "`customer`" } else { "`laboratory`" };
    let object = Object::new(root.log, what, &member.value, &member.key_span)?;
    keys::check(&object, keys::PARTY);
    object.required("name");
    if let (Some(country), Some(member)) = (object.text("country"), object.get("country"))
        && !(country.len() == 2 && country.bytes().all(|c| c.is_ascii_uppercase()))
    {
        let reason = format!(
            "the country `{country}` is not a code of ISO 3166-1, two capital letters such as `IT`"
        );
        root.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
    }
    Some(Party {
        name: owned(&object, "name")?,
        code: owned(&object, "code"),
        street: owned(&object, "street"),
        street_number: owned(&object, "street_number"),
        post_code: owned(&object, "post_code"),
        city: owned(&object, "city"),
        country: owned(&object, "country"),
        email: owned(&object, "email"),
        phone: owned(&object, "phone"),
    })
}

/// The days of a certificate.
struct Days {
    received: Option<String>,
    calibrated: Option<[String; 2]>,
    issued: Option<String>,
}

/// The days of the certificate, in their order: a device is received, calibrated, and then its
/// certificate is issued. Two of them may be one day.
fn days(root: &Object<'_>) -> Days {
    let days = Days {
        received: date(root, "receipt_date"),
        calibrated: calibrated(root),
        issued: date(root, "issue_date"),
    };
    // days of the same form are in the order of their texts
    let refuse = |key: &str, reason: String| {
        let place = root.get(key).map_or(root.place(), |member| &member.value.span);
        root.log.report(place, DiagnosticKind::Certificate { reason });
    };
    let ends = days.calibrated.as_ref().map(|[first, last]| (first, last));
    match (&days.received, ends) {
        (Some(received), Some((first, _))) if received > first => refuse(
            "receipt_date",
            format!(
                "the device is received on {received} (`receipt_date`), after its calibration begins \
                 on {first} (`calibration_date`); a device is received on or before that day"
            ),
        ),
        (Some(received), _) => {
            if let Some(issued) = days.issued.as_ref().filter(|issued| received > *issued) {
                refuse(
                    "receipt_date",
                    format!(
                        "the device is received on {received} (`receipt_date`), after the certificate \
                         is issued on {issued} (`issue_date`); a device is received on or before that \
                         day"
                    ),
                );
            }
        }
        (None, _) => {}
    }
    if let (Some(issued), Some((_, last))) = (&days.issued, ends)
        && issued < last
    {
        refuse(
            "issue_date",
            format!(
                "the certificate is issued on {issued} (`issue_date`), before its calibration ends on \
                 {last} (`calibration_date`); a certificate is issued on that day or later"
            ),
        );
    }
    days
}

fn date(root: &Object<'_>, key: &'static str) -> Option<String> {
    let member = root.get(key)?;
    let text = root.text(key)?;
    checked_date(root, key, member, text)
}

/// One day, or the first and the last.
fn calibrated(root: &Object<'_>) -> Option<[String; 2]> {
    const KEY: &str = "calibration_date";
    let member = root.get(KEY)?;
    let days: Vec<String> = texts(root, KEY)
        .iter()
        .filter_map(|(text, _)| checked_date(root, KEY, member, text))
        .collect();
    match (days.as_slice(), &member.value.value) {
        ([day], _) => Some([day.clone(), day.clone()]),
        ([first, last], _) if first <= last => Some([first.clone(), last.clone()]),
        ([first, last], _) => {
            let reason = format!("the calibration ends on {last}, before it begins on {first}");
            root.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
            None
        }
        (_, Json::List(list)) if list.len() != 1 && list.len() != 2 => {
            let reason =
                "`calibration_date` is one day, or a list of the first and the last".to_owned();
            root.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
            None
        }
        _ => None,
    }
}

/// A day of the calendar as ISO 8601 writes it.
fn checked_date(
    root: &Object<'_>,
    key: &'static str,
    member: &Member,
    text: &str,
) -> Option<String> {
    if Day::parse(text).is_some() {
        return Some(text.to_owned());
    }
    root.log.report(&member.value.span, DiagnosticKind::NotDate { key, found: text.to_owned() });
    None
}
