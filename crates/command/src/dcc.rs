//! `gumption dcc`

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

use super::options::{self, Answer, Format};
use super::{Exit, Failure};
use gumption_files::{CertificateListing, ListedQuantity};
use gumption_report::{on_one_line, plain, pretty};

/// List the contents of a digital calibration certificate, and how a model file uses them.
///
/// Each quantity has its index, from 0, its id, `refType` and name, the unit and the number of its
/// values, the element that contains it, and its status before or after an adjustment. Below it is
/// the input of a model file that uses it: the first of several values; `"at": "CONDITION"` instead
/// of `"index"` interpolates them over a condition.
#[derive(Debug, Args)]
pub(super) struct Dcc {
    /// The certificate (XML); - for standard input
    file: PathBuf,
    #[command(flatten)]
    answer: Answer<Format>,
}

impl Dcc {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let place = self.answer.open(std::slice::from_ref(&self.file))?;
        let text = |text: &str| gumption_files::certificate_listing_text("<stdin>", text);
        let listing = options::given(&self.file, text, gumption_files::certificate_listing)??;
        let answer = match self.answer.format {
            Format::Json => pretty(&listing),
            Format::Table => page(&listing),
            Format::Csv => {
                return Err(Failure::Argument("`dcc` answers as table or json".into()));
            }
        };
        place.write(&answer)?;
        Ok(Exit::Done)
    }
}

/// The quantities, grouped by the elements that contain them.
fn page(listing: &CertificateListing) -> String {
    let mut text = String::new();
    let mut before = None;
    for of in &listing.results {
        let heading = heading(of);
        if before.as_ref() != Some(&heading) {
            let gap = if text.is_empty() { "" } else { "\n" };
            let _ = writeln!(text, "{gap}{}", plain(&heading));
            before = Some(heading);
        }
        let _ = writeln!(text, "{:>4}  {}", of.quantity, plain(&described(of)));
        let below = match (&of.input, &of.unread) {
            (Some(input), _) => on_one_line(input),
            (None, reason) => format!("not read: {}", plain(reason.as_deref().unwrap_or_default())),
        };
        let _ = writeln!(text, "      {below}");
    }
    if text.is_empty() {
        text.push_str("the certificate holds no quantity\n");
    }
    text
}

/// What a quantity is of.
fn heading(of: &ListedQuantity) -> String {
    let part = of.part.as_ref();
    let name = part.and_then(|part| part.name.clone().or_else(|| part.id.clone()));
    let place = of.place.as_deref().unwrap_or("certificate");
    let around: Vec<&str> = [Some(place), of.status.as_deref()].into_iter().flatten().collect();
    match name {
        Some(name) => format!("{name} ({})", around.join(", ")),
        None => around.join(", "),
    }
}

/// The kind of a quantity, and the number of its values.
fn described(of: &ListedQuantity) -> String {
    let id = of.id.as_ref().map(|id| format!("id {id}"));
    let kind = of.ref_type.as_ref().map(|kind| format!("ref_type {kind}"));
    let values = of.unit.as_ref().map(|unit| {
        let count = of.values.len();
        let unit = if unit.is_empty() { "1" } else { unit };
        format!("{count} value{} in {unit}", if count == 1 { "" } else { "s" })
    });
    let parts: Vec<String> = [of.name.clone(), id, kind, values].into_iter().flatten().collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const CERTIFICATE: &str = r#"<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc"
        xmlns:si="https://ptb.de/si" schemaVersion="3.2.1"><dcc:measurementResults><dcc:measurementResult>
        <dcc:influenceConditions><dcc:influenceCondition><dcc:name><dcc:content>Found</dcc:content></dcc:name>
        <dcc:status>beforeAdjustment</dcc:status><dcc:data><dcc:quantity id="a"><si:real><si:value>3</si:value>
        <si:unit>\kelvin</si:unit></si:real></dcc:quantity></dcc:data></dcc:influenceCondition>
        </dcc:influenceConditions><dcc:results><dcc:result><dcc:name><dcc:content>Left</dcc:content></dcc:name>
        <dcc:data><dcc:list><dcc:quantity refType="basic_measuredValue"><dcc:name><dcc:content>T</dcc:content>
        </dcc:name><si:realListXMLList><si:valueXMLList>1 2</si:valueXMLList><si:unitXMLList>\kelvin
        </si:unitXMLList></si:realListXMLList></dcc:quantity><dcc:quantity><dcc:noQuantity/></dcc:quantity>
        </dcc:list></dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>
        </dcc:digitalCalibrationCertificate>"#;

    #[test]
    fn the_page_has_each_quantity_with_its_input() {
        let listing = gumption_files::certificate_listing_text("c\u{1b}.xml", CERTIFICATE).unwrap();
        let page = page(&listing);
        let lines: Vec<&str> = page.lines().collect();
        assert_eq!(lines[0], "Found (influenceConditions, beforeAdjustment)");
        assert_eq!(lines[1], "   0  id a, 1 value in K");
        assert_eq!(lines[2].trim(), r#"{"distribution":"dcc","file":"c\u001b.xml","quantity":0}"#);
        assert_eq!(lines[4], "Left (results)");
        assert_eq!(lines[5], "   1  T, ref_type basic_measuredValue, 2 values in K");
        assert_eq!(
            lines[6].trim(),
            r#"{"distribution":"dcc","file":"c\u001b.xml","quantity":1,"index":0}"#
        );
        assert!(lines[8].trim().starts_with("not read: "), "{page}");
        let json: serde_json::Value = serde_json::from_str(&pretty(&listing)).unwrap();
        let [first, second, third] = [0, 1, 2].map(|place| &json["results"][place]);
        assert_eq!(first["status"], "beforeAdjustment");
        assert_eq!([&first["place"], &second["place"]], ["influenceConditions", "results"]);
        assert_eq!(second["values"], serde_json::json!([1.0, 2.0]));
        assert_eq!(
            [&second["unit"], &second["name"], &third["unit"]],
            [&serde_json::json!("K"), &serde_json::json!("T"), &serde_json::Value::Null]
        );
    }
}
