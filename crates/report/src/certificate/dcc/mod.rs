//! The certificate as a Digital Calibration Certificate (DCC) of the Physikalisch-Technische
//! Bundesanstalt, version 3.2.1 or 3.1.2, with numbers and units in D-SI.
//!
//! Each output is one result with a list of quantities over its rows: conditions and nominal
//! values, the measured values with their expanded uncertainties, and for rows whose distribution
//! is not normal their coverage intervals. The source files of the certificate and its JSON answer
//! are attached as bytes.

mod people;
mod regions;
mod results;
mod statements;
pub(super) mod unit;
mod view;
mod xml;

use super::CertificateReport;
use super::words::localized;
use gumption_analysis::certificate::contents::{Certificate, Localized};
use people::contact;
pub use view::dcc_stylesheet;
use xml::Xml;

/// Required keys of the certificate file that are missing for a DCC.
pub type Needed = Vec<&'static str>;

/// The items that a DCC needs and the certificate file lacks; empty if it is complete.
pub fn needed(certificate: &Certificate) -> Needed {
    let of = &certificate.administrative;
    let mut missing = Vec::new();
    let mut need = |key: &'static str, there: bool| {
        if !there {
            missing.push(key);
        }
    };
    need("number", of.number.is_some());
    match &of.device {
        None => need("device", false),
        Some(device) => {
            need("device.manufacturer", device.manufacturer.is_some());
            let numbered = device.serial_number.is_some() || device.customer_number.is_some();
            need("device.serial_number", numbered);
        }
    }
    match &of.customer {
        None => need("customer", false),
        Some(party) => {
            need("customer.email", party.email.is_some());
            need("customer.city", party.city.is_some());
        }
    }
    match &of.laboratory {
        None => need("laboratory", false),
        Some(party) => {
            need("laboratory.email", party.email.is_some());
            need("laboratory.city", party.city.is_some());
            need("laboratory.country", party.country.is_some());
        }
    }
    need("responsible", of.responsible.is_some());
    need("calibration_date", of.calibrated.is_some());
    missing
}

/// A version of the digital certificate's schema.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DccVersion {
    /// 3.2.1, with the date of issue among the data of the certificate.
    #[default]
    V3_2_1,
    /// 3.1.2, for software that cannot read newer versions.
    V3_1_2,
}

impl DccVersion {
    /// The versions that can be written, the newest first.
    pub const ALL: [Self; 2] = [Self::V3_2_1, Self::V3_1_2];

    /// The number of the version.
    pub fn number(self) -> &'static str {
        match self {
            Self::V3_2_1 => "3.2.1",
            Self::V3_1_2 => "3.1.2",
        }
    }
}

/// The certificate as XML, valid against the schema of that version if nothing is
/// [`needed`]. It ends in a newline.
pub fn dcc(report: &CertificateReport<'_>, version: DccVersion) -> String {
    let number = version.number();
    let schema = format!("https://ptb.de/dcc https://ptb.de/dcc/v{number}/dcc.xsd");
    let languages = report.certificate.languages.as_slice();
    let mut xml = Xml::new();
    let root = [
        ("xmlns:dcc", "https://ptb.de/dcc"),
        ("xmlns:si", "https://ptb.de/si"),
        ("xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"),
        ("xsi:schemaLocation", schema.as_str()),
        ("schemaVersion", number),
    ];
    xml.within("dcc:digitalCalibrationCertificate", &root, |xml| {
        xml.element("dcc:administrativeData", |xml| administrative(xml, report, version));
        xml.element("dcc:measurementResults", |xml| results::write(xml, report, languages));
    });
    xml.finish()
}

/// The certificate with the name of the file next to it that contains its stylesheet
/// ([`dcc_stylesheet`]).
pub fn with_stylesheet(certificate: &str, file: &str) -> String {
    // as a URL, in which no name can end the attribute
    let address: String = file
        .bytes()
        .map(|byte| match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
                char::from(byte).to_string()
            }
            _ => format!("%{byte:02X}"),
        })
        .collect();
    let asked = format!("<?xml-stylesheet type=\"text/xsl\" href=\"{address}\"?>");
    match certificate.split_once("?>\n") {
        Some((declaration, rest)) => format!("{declaration}?>\n{asked}\n{rest}"),
        None => certificate.to_owned(),
    }
}

fn administrative(xml: &mut Xml, report: &CertificateReport<'_>, version: DccVersion) {
    let languages = report.certificate.languages.as_slice();
    let of = &report.certificate.administrative;
    xml.element("dcc:dccSoftware", software);
    xml.element("dcc:coreData", |xml| {
        let country = of.laboratory.as_ref().and_then(|party| party.country.as_deref());
        xml.leaf("dcc:countryCodeISO3166_1", country.unwrap_or_default());
        for language in languages {
            xml.leaf("dcc:usedLangCodeISO639_1", language.code());
        }
        let first = languages.first().map_or("en", |language| language.code());
        xml.leaf("dcc:mandatoryLangCodeISO639_1", first);
        xml.leaf("dcc:uniqueIdentifier", of.number.as_deref().unwrap_or_default());
        if let Some(day) = &of.received {
            xml.leaf("dcc:receiptDate", day);
        }
        if let Some([first, last]) = &of.calibrated {
            xml.leaf("dcc:beginPerformanceDate", first);
            xml.leaf("dcc:endPerformanceDate", last);
        }
        xml.leaf("dcc:performanceLocation", of.place.name());
        // the older schema has no element for it
        if let (DccVersion::V3_2_1, Some(day)) = (version, &of.issued) {
            xml.leaf("dcc:issueDate", day);
        }
    });
    xml.element("dcc:items", |xml| xml.element("dcc:item", |xml| people::item(xml, of, languages)));
    let logo = report.certificate.letterhead.logo.as_ref();
    xml.element("dcc:calibrationLaboratory", |xml| {
        if let Some(party) = &of.laboratory {
            if let Some(code) = &party.code {
                xml.leaf("dcc:calibrationLaboratoryCode", code);
            }
            xml.element("dcc:contact", |xml| contact(xml, party, logo, languages));
        }
    });
    xml.element("dcc:respPersons", |xml| {
        xml.element("dcc:respPerson", |xml| {
            let name = Localized::plain(of.responsible.clone().unwrap_or_default());
            xml.element("dcc:person", |xml| xml.text("dcc:name", &name, languages));
            xml.leaf("dcc:mainSigner", "true");
        });
    });
    if let Some(party) = &of.customer {
        xml.element("dcc:customer", |xml| contact(xml, party, None, languages));
    }
    xml.element("dcc:statements", |xml| statements::write(xml, report, languages));
}

/// This program.
fn software(xml: &mut Xml) {
    xml.element("dcc:software", |xml| {
        xml.element("dcc:name", |xml| xml.leaf("dcc:content", "gumption"));
        xml.leaf("dcc:release", &format!("v{}", env!("CARGO_PKG_VERSION")));
        xml.leaf("dcc:type", "application");
    });
}

/// The title, in each language its own.
fn title(report: &CertificateReport<'_>) -> Localized {
    let Certificate { administrative, languages, .. } = report.certificate;
    let given = administrative.title.clone().filter(|title| !title.is_empty());
    given.unwrap_or_else(|| localized(languages, |w| w.title))
}
