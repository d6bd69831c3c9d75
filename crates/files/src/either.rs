//! Files that may be model files or result files.

use std::path::Path;

use super::context::Context;
use super::model_file::{self, ModelFile};
use super::result::{self, ResultFile};
use gumption_engine::task::Warning;
use gumption_text::json::{self, Json};
use gumption_text::{Diagnostic, DiagnosticKind, Diagnostics, SourceText};

/// A model file or a result file that was read and found right.
#[derive(Debug)]
pub enum ModelOrResult {
    /// A model file.
    Model(Box<ModelFile>),
    /// A saved result.
    Result(ResultFile),
}

impl ModelOrResult {
    /// The name that messages use.
    pub fn name(&self) -> &str {
        match self {
            Self::Model(file) => &file.source.name,
            Self::Result(file) => &file.source.name,
        }
    }
}

/// Reads and checks a text: one with the key `result` is a saved result.
pub(super) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
) -> Result<ModelOrResult, Diagnostics> {
    let source = SourceText::new(name, text);
    let is_result = json::parse(&source).is_ok_and(|node| match &node.value {
        Json::Object(members) => members.iter().any(|member| member.key == "result"),
        _ => false,
    });
    Ok(if is_result {
        ModelOrResult::Result(result::read_text(files, name, text)?)
    } else {
        ModelOrResult::Model(Box::new(model_file::read_text(files, name, text, folder, &[])?))
    })
}

impl ModelOrResult {
    /// Notes on what was read.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Model(file) => &file.warnings,
            Self::Result(file) => &file.warnings,
        }
    }
}

impl ModelFile {
    /// A mistake at a key of the root, or at the file's beginning if it is not there.
    pub fn diagnostic_at(&self, key: &str, diagnostic: DiagnosticKind) -> Diagnostics {
        let member = json::parse(&self.source).ok().and_then(|node| match node.value {
            Json::Object(members) => members.into_iter().find(|member| member.key == key),
            _ => None,
        });
        let span = member.map_or(0..0, |member| member.key_span);
        Diagnostics(vec![Diagnostic { source: self.source.clone(), span, kind: diagnostic }])
    }
}
