//! Models that other files carry: the workbook of an evaluation, which has the model file on its sheet
//! `About`, and the Digital Calibration Certificate of this program, to which the model files and the
//! files that they name are attached. Of any other certificate the quantities are a model.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use roxmltree::Node;
use serde_json::{Map, Value, json};

use super::dcc;
use super::loose_files::named_in;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText, bytes, workbook};

/// A model that another file carries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CarriedModel {
    /// What it is called in that file.
    pub name: String,
    /// The model file.
    pub text: String,
    /// The files that it names, by their names as it has them.
    pub files: Vec<(String, Vec<u8>)>,
}

/// The models that a workbook (XLSX) or a Digital Calibration Certificate (XML) carries.
///
/// # Errors
/// A file that cannot be read, is neither, or carries none.
pub fn carried_models(path: &Path) -> Result<Vec<CarriedModel>, Diagnostics> {
    let name = path.display().to_string();
    let refused = |text: &str, span, kind| {
        let log = Collector::new(SourceText::new(name.clone(), text));
        log.report(&span, kind);
        Err(log.into_diagnostics())
    };
    let unreadable = |message: String| DiagnosticKind::Unreadable { message };
    let content = match bytes::of_file(path, bytes::MOST) {
        Ok(content) => content,
        Err(message) => return refused("", 0..0, unreadable(message)),
    };
    if content.starts_with(b"PK") {
        return match of_workbook(content) {
            Ok(text) => Ok(vec![CarriedModel { name, text, files: Vec::new() }]),
            Err(message) => refused("", 0..0, unreadable(message)),
        };
    }
    let text = match bytes::text(&content) {
        Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
        Err(message) => return refused("", 0..0, unreadable(message)),
    };
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match of_certificate(&file, &text, &content) {
        Ok(models) => Ok(models),
        Err((span, reason)) => refused(&text, span, DiagnosticKind::Certificate { reason }),
    }
}

/// The model file on a workbook's last sheet.
pub fn of_workbook(content: Vec<u8>) -> Result<String, String> {
    let rows = workbook::rows_of(content, workbook::Sheet::Last)?;
    let first = |row: &Vec<String>| row.first().cloned().unwrap_or_default();
    let mut lines = rows.iter().map(first).skip_while(|line| line != "The model file");
    if lines.next().is_none() {
        return Err(
            "the workbook carries no model: its last sheet has no line `The model file`; a \
                    budget in a spreadsheet becomes one by `gumption import`"
                .to_owned(),
        );
    }
    Ok(lines.map(|line| line + "\n").collect())
}

/// The attached models of a certificate, or else that of its quantities.
fn of_certificate(file: &str, text: &str, content: &[u8]) -> Result<Vec<CarriedModel>, dcc::Fault> {
    let document = dcc::parse(text)?;
    let attached: Vec<(String, Vec<u8>)> = document
        .descendants()
        .filter(|node| node.tag_name().name() == "byteData")
        .filter_map(attachment)
        .collect();
    let is_model = |bytes: &[u8]| {
        let found: Option<Map<String, Value>> = serde_json::from_slice(bytes).ok();
        found.is_some_and(|fields| {
            fields.contains_key("inputs")
                && fields.contains_key("outputs")
                && !fields.contains_key("gumption")
        })
    };
    // what a model names follows it, and has no folder any more
    let starts: Vec<usize> = (0..attached.len()).filter(|&n| is_model(&attached[n].1)).collect();
    let ends = starts.iter().copied().skip(1).chain([attached.len()]);
    let models: Vec<CarriedModel> = starts
        .iter()
        .zip(ends)
        .filter_map(|(&start, end)| {
            let (name, bytes) = &attached[start];
            let text = String::from_utf8(bytes.clone()).ok()?;
            let mut files = named_in(&attached[start..end], &text);
            files.extend(attached[..start].iter().chain(&attached[end..]).cloned());
            let files = named_in(&files, &text);
            Some(CarriedModel { name: name.clone(), text, files })
        })
        .collect();
    if !models.is_empty() {
        return Ok(models);
    }
    let inputs = dcc::inputs(&document, file);
    if inputs.is_empty() {
        let root = document.root_element();
        return Err((dcc::tag(root), "it has no quantity that can be read".to_owned()));
    }
    let outputs: Map<String, Value> =
        inputs.iter().map(|(name, unit, _)| (name.clone(), json!({ "unit": unit }))).collect();
    let inputs: Map<String, Value> =
        inputs.into_iter().map(|(name, _, input)| (name, input)).collect();
    let model = json!({
        "format": 1,
        "title": format!("Quantities of {file}"),
        "inputs": inputs,
        "equations": {},
        "outputs": outputs,
    });
    let files = vec![(file.to_owned(), content.to_owned())];
    Ok(vec![CarriedModel { name: file.to_owned(), text: format!("{model:#}\n"), files }])
}

/// Name and content of what is attached; the description has the path of a file of another folder.
pub(super) fn attachment(node: Node<'_, '_>) -> Option<(String, Vec<u8>)> {
    let child = |name: &str| node.children().find(|child| child.tag_name().name() == name);
    let data = child("dataBase64")?.text()?;
    let data: String = data.split_whitespace().collect();
    let content = STANDARD.decode(data).ok()?;
    let path = child("description")
        .and_then(|description| description.children().find(Node::is_element))
        .and_then(|element| element.text());
    let name = path.or_else(|| child("fileName").and_then(|name| name.text()))?;
    Some((name.trim().to_owned(), content))
}
