//! The device, and the contact persons.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::xml::Xml;
use crate::certificate::file_name;
use crate::certificate::words::{self, Words, localized};
use gumption_analysis::certificate::contents::{
    AdministrativeData, Language, Localized, Party, Picture,
};

/// The device that was calibrated.
pub(super) fn item(xml: &mut Xml, of: &AdministrativeData, languages: &[Language]) {
    let Some(device) = &of.device else { return };
    xml.text("dcc:name", &device.name, languages);
    if let Some(condition) = &device.condition {
        let said = |language: &Language| {
            let word = words::of(*language).condition;
            (Some(*language), format!("{word}: {}", condition.get(*language)))
        };
        let about = Localized { texts: languages.iter().map(said).collect() };
        xml.text("dcc:description", &about, languages);
    }
    let manufacturer = Localized::plain(device.manufacturer.clone().unwrap_or_default());
    xml.element("dcc:manufacturer", |xml| xml.text("dcc:name", &manufacturer, languages));
    if let Some(model) = &device.model {
        xml.leaf("dcc:model", model);
    }
    let serial: fn(&Words) -> &'static str = |w| w.serial_number;
    let customers: fn(&Words) -> &'static str = |w| w.customer_number;
    let numbers = [
        ("manufacturer", &device.serial_number, serial),
        ("customer", &device.customer_number, customers),
    ];
    xml.element("dcc:identifications", |xml| {
        for (issuer, number, name) in numbers {
            let Some(number) = number else { continue };
            xml.element("dcc:identification", |xml| {
                xml.leaf("dcc:issuer", issuer);
                xml.leaf("dcc:value", number);
                xml.text("dcc:name", &localized(languages, name), languages);
            });
        }
    });
}

/// A laboratory or a customer.
pub(super) fn contact(
    xml: &mut Xml,
    party: &Party,
    logo: Option<&Picture>,
    languages: &[Language],
) {
    xml.text("dcc:name", &Localized::plain(party.name.clone()), languages);
    xml.leaf("dcc:eMail", party.email.as_deref().unwrap_or_default());
    if let Some(phone) = &party.phone {
        xml.leaf("dcc:phone", phone);
    }
    let parts = [
        ("dcc:city", &party.city),
        ("dcc:countryCode", &party.country),
        ("dcc:postCode", &party.post_code),
        ("dcc:street", &party.street),
        ("dcc:streetNo", &party.street_number),
    ];
    xml.element("dcc:location", |xml| {
        for (name, part) in parts {
            if let Some(part) = part {
                xml.leaf(name, part);
            }
        }
    });
    if let Some(logo) = logo {
        xml.element("dcc:descriptionData", |xml| {
            xml.leaf("dcc:fileName", file_name(&logo.name));
            xml.leaf("dcc:mimeType", logo.format.media_type());
            xml.leaf("dcc:dataBase64", &STANDARD.encode(&logo.bytes));
        });
    }
}
