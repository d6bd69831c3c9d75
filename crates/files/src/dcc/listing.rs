//! What a certificate holds, quantity by quantity.

use std::path::Path;

use roxmltree::Node;
use serde::Serialize;
use serde_json::{Value, json};

use super::document::{Measured, measured, names, parse, quantities};
use super::{difference, standing};
use crate::open;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText};

/// The quantities of a Digital Calibration Certificate, in the order of its text.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CertificateListing {
    /// All of them, those of conditions and of the equipment too.
    pub results: Vec<ListedQuantity>,
}

/// A quantity of a certificate.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ListedQuantity {
    /// Its place among all quantities, from 0.
    pub quantity: usize,
    /// Its reference types, as they are written: between blanks.
    pub ref_type: Option<String>,
    /// Its id.
    pub id: Option<String>,
    /// Its name, in the first language.
    pub name: Option<String>,
    /// The unit of the values; `None` where they are not read.
    pub unit: Option<String>,
    /// The values in that unit; empty where they are not read.
    pub values: Vec<f64>,
    /// Before or after what it was measured, such as `beforeAdjustment`.
    pub status: Option<String>,
    /// The element that it stands in: `results`, `influenceConditions`, `measuringEquipments`,
    /// `usedMethods`, `measurementMetaData` or `statements`.
    pub place: Option<String>,
    /// The result, influence condition or the like that it is of.
    pub part: Option<ListedPart>,
    /// The input of a model file that takes it; of several values the first one. `None` where it is not
    /// read.
    pub input: Option<Value>,
    /// Why it is not read.
    pub unread: Option<String>,
}

/// What a quantity is of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ListedPart {
    /// Its id.
    pub id: Option<String>,
    /// Its name, in the first language.
    pub name: Option<String>,
}

/// Lists the quantities of a Digital Calibration Certificate (XML).
///
/// # Errors
/// A file that cannot be read, or is none.
pub fn listing(path: &Path) -> Result<CertificateListing, Diagnostics> {
    open::open(path, |name, text, _| listing_text(name, text))
}

/// As [`listing`], of a text that messages and inputs call `name`.
///
/// # Errors
/// It is no certificate that is read.
pub fn listing_text(name: &str, text: &str) -> Result<CertificateListing, Diagnostics> {
    let source = SourceText::new(name.to_owned(), text);
    let log = Collector::new(source.clone());
    let fault = match parse(&source.text) {
        Ok(document) => {
            let all = quantities(&document);
            let listed = all.iter().enumerate().map(|(place, node)| of(*node, place, name));
            return Ok(CertificateListing { results: listed.collect() });
        }
        Err(fault) => fault,
    };
    let (span, reason) = fault;
    log.report(&span, DiagnosticKind::Certificate { reason });
    Err(log.into_diagnostics())
}

fn of<'d>(node: Node<'d, 'd>, place: usize, file: &str) -> ListedQuantity {
    let attribute = |node: Node<'d, 'd>, name: &str| node.attribute(name).map(str::to_owned);
    let name = |node: Node<'d, 'd>| names(node).into_iter().next();
    let read = measured(node);
    let unit = |measured: &Measured| match difference::kind(node, measured, None) {
        Ok(kind) => kind.unit(measured.unit.clone()).text().to_owned(),
        Err(_) => measured.unit.text().to_owned(),
    };
    let input = |measured: &Measured| {
        let mut input = json!({ "distribution": "dcc", "file": file, "quantity": place });
        if measured.values.len() > 1 {
            input["index"] = json!(0);
        }
        input
    };
    ListedQuantity {
        quantity: place,
        ref_type: attribute(node, "refType"),
        id: attribute(node, "id"),
        name: name(node),
        unit: read.as_ref().ok().map(unit),
        status: standing::status(node),
        place: standing::place(node).map(str::to_owned),
        part: standing::part(node)
            .map(|part| ListedPart { id: attribute(part, "id"), name: name(part) }),
        input: read.as_ref().ok().map(input),
        unread: read.as_ref().err().map(|(_, reason)| reason.clone()),
        values: read.map(|read| read.values).unwrap_or_default(),
    }
}
