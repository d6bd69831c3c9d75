//! The part above the results: device, parties, dates.

use super::CertificateReport;
use super::words::{self, Words, beside};
use crate::answer::{list, object};
use crate::document::Head;
use crate::plain;
use crate::sheet::Sheet;
use gumption_analysis::certificate::contents::{Localized, Party, PerformanceLocation};
use serde_json::Value;

/// The title in the languages of the certificate.
pub(super) fn title(report: &CertificateReport<'_>) -> String {
    let languages = &report.certificate.languages;
    match &report.certificate.administrative.title {
        Some(title) if !title.is_empty() => plain(&title.all(languages).join(" / ")),
        _ => beside(languages, |w| w.title),
    }
}

/// Names with the stated items, without those in the head of the page; missing ones are left out.
pub(super) fn sheet(report: &CertificateReport<'_>) -> Sheet {
    let languages = &report.certificate.languages;
    let in_head: [fn(&Words) -> &'static str; 2] = [|w| w.laboratory, |w| w.accreditation];
    let in_head = in_head.map(|word| beside(languages, word));
    let has_head = head(report).is_some();
    let lines: Vec<(String, String)> = lines(report)
        .into_iter()
        .filter(|(name, _)| !has_head || !in_head.contains(name))
        .collect();
    let mut sheet = Sheet::default();
    sheet.text("", lines.iter().map(|(name, _)| name.clone()));
    sheet.text("", lines.iter().map(|(_, value)| value.clone()));
    sheet
}

/// Names and texts, in order.
pub(super) fn lines(report: &CertificateReport<'_>) -> Vec<(String, String)> {
    let certificate = report.certificate;
    let languages = certificate.languages.as_slice();
    let of = &certificate.administrative;
    let mut lines = Vec::new();
    let mut add = |word: fn(&Words) -> &'static str, text: Option<String>| {
        if let Some(text) = text.map(|text| plain(&text)).filter(|text| !text.is_empty()) {
            lines.push((beside(languages, word), text));
        }
    };
    let local = |text: &Localized| text.all(languages).join(" / ");
    add(|w| w.number, of.number.clone());
    if let Some(device) = &of.device {
        add(|w| w.device, Some(local(&device.name)));
        add(|w| w.manufacturer, device.manufacturer.clone());
        add(|w| w.model, device.model.clone());
        add(|w| w.condition, device.condition.as_ref().map(local));
        add(|w| w.serial_number, device.serial_number.clone());
        add(|w| w.customer_number, device.customer_number.clone());
    }
    add(|w| w.customer, of.customer.as_ref().map(party));
    add(|w| w.laboratory, of.laboratory.as_ref().map(party));
    add(|w| w.code, of.laboratory.as_ref().and_then(|l| l.code.clone()));
    add(|w| w.accreditation, certificate.letterhead.accreditation_number.clone());
    add(|w| w.responsible, of.responsible.clone());
    let period = of.calibrated.as_ref().map(|[first, last]| match first == last {
        true => first.clone(),
        false => {
            let texts = languages.iter().map(|language| {
                let period = words::of(*language).period;
                period.replace("{first}", first).replace("{last}", last)
            });
            texts.collect::<Vec<_>>().join(" / ")
        }
    });
    add(|w| w.received, of.received.clone());
    add(|w| w.calibrated, period);
    add(|w| w.issued, of.issued.clone());
    let place = PerformanceLocation::ALL.iter().position(|place| *place == of.place).unwrap_or(0);
    // a certificate with a number states the place of calibration (ISO/IEC 17025, 7.8.2.1 c)
    let stated = place > 0 || of.number.is_some();
    add(|w| w.place, stated.then(|| beside(languages, |w| w.places[place])));
    add(|w| w.environment, of.environment.as_ref().map(local));
    add(|w| w.method, of.method.as_ref().map(local));
    add(|w| w.traceability, of.traceability.as_ref().map(local));
    lines
}

/// The head of the first page, if the certificate has a letterhead.
pub(super) fn head(report: &CertificateReport<'_>) -> Option<Head> {
    let of = &report.certificate.letterhead;
    let languages = report.certificate.languages.as_slice();
    let has_picture = of.logo.is_some() || of.mark.is_some();
    let has_text = of.accreditation_number.is_some() || of.accreditation.is_some();
    if !has_picture && !has_text {
        return None;
    }
    let laboratory = report.certificate.administrative.laboratory.as_ref();
    let accreditation = beside(languages, |w| w.accreditation);
    let number = of.accreditation_number.as_ref().map(|number| match &of.accreditation {
        Some(_) => plain(number),
        None => format!("{accreditation} {}", plain(number)),
    });
    let text = of.accreditation.as_ref().map(|text| plain(&text.all(languages).join(" / ")));
    let name = laboratory.map(|party| plain(&party.name)).unwrap_or_default();
    Some(Head {
        logo: of.logo.clone(),
        lines: laboratory.map(address_block).unwrap_or_default(),
        mark: of.mark.clone(),
        below_mark: text.into_iter().chain(number).collect(),
        described: [name, accreditation],
    })
}

/// Name, street, city, and ways of contact, line by line.
fn address_block(party: &Party) -> Vec<String> {
    let contact: Vec<&str> =
        [&party.phone, &party.email].into_iter().flatten().map(String::as_str).collect();
    let address = party.address_lines().into_iter();
    let lines = std::iter::once(party.name.clone()).chain(address).chain([contact.join(", ")]);
    lines.map(|line| plain(&line)).filter(|line| !line.is_empty()).collect()
}

/// The same for programs, by the keys of the certificate file, whatever its languages.
pub(super) fn for_programs(report: &CertificateReport<'_>) -> Value {
    let of = &report.certificate.administrative;
    let text = |text: &Option<String>| text.as_deref().map(Value::from);
    let local = |text: Option<&Localized>| text.map(localized);
    let party = |party: &Party| {
        given([
            ("name", Some(party.name.as_str().into())),
            ("code", text(&party.code)),
            ("street", text(&party.street)),
            ("street_number", text(&party.street_number)),
            ("post_code", text(&party.post_code)),
            ("city", text(&party.city)),
            ("country", text(&party.country)),
            ("email", text(&party.email)),
            ("phone", text(&party.phone)),
        ])
    };
    let device = of.device.as_ref().map(|device| {
        given([
            ("name", Some(localized(&device.name))),
            ("manufacturer", text(&device.manufacturer)),
            ("model", text(&device.model)),
            ("condition", local(device.condition.as_ref())),
            ("serial_number", text(&device.serial_number)),
            ("customer_number", text(&device.customer_number)),
        ])
    });
    let days = |days: &[String; 2]| list(days.iter().map(|day| Value::from(day.as_str())));
    given([
        ("title", local(of.title.as_ref())),
        ("number", text(&of.number)),
        ("device", device),
        ("customer", of.customer.as_ref().map(party)),
        ("laboratory", of.laboratory.as_ref().map(party)),
        ("accreditation_number", text(&report.certificate.letterhead.accreditation_number)),
        ("responsible", text(&of.responsible)),
        ("receipt_date", text(&of.received)),
        ("calibration_date", of.calibrated.as_ref().map(days)),
        ("issue_date", text(&of.issued)),
        ("place", Some(of.place.name().into())),
        ("environment", local(of.environment.as_ref())),
        ("method", local(of.method.as_ref())),
        ("traceability", local(of.traceability.as_ref())),
    ])
}

/// What is there of these.
fn given<const N: usize>(members: [(&'static str, Option<Value>); N]) -> Value {
    object(members.into_iter().filter_map(|(key, value)| Some((key, value?))))
}

/// A text, or one for each language by its code.
fn localized(text: &Localized) -> Value {
    match text.texts.as_slice() {
        [(None, text)] => text.as_str().into(),
        texts => object(texts.iter().filter_map(|(language, text)| {
            Some(((*language)?.code(), Value::from(text.as_str())))
        })),
    }
}

/// Name, address and contact (ISO/IEC 17025, 7.8.2.1 b and e).
fn party(party: &Party) -> String {
    let contact = [&party.phone, &party.email].map(|way| way.clone().unwrap_or_default());
    let parts = [party.name.clone(), party.address()].into_iter().chain(contact);
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}
