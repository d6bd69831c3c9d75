//! What a file is, for the lists of the page.

use gumption_files::TextKind;

/// The kind of a file, and its title.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileDescription {
    /// A word for the kind, such as `model`.
    pub kind: &'static str,
    /// The title in the file.
    pub title: Option<String>,
}

impl FileDescription {
    /// The description of a file with this name and content.
    pub fn of(name: &str, content: &[u8]) -> Self {
        if is_picture(name) {
            return Self { kind: "picture", title: None };
        }
        let text = String::from_utf8_lossy(content);
        let title = serde_json::from_str::<serde_json::Value>(&text).ok();
        let title = title.and_then(|root| root.get("title")?.as_str().map(str::to_owned));
        Self { kind: TextKind::of(&text).name(), title }
    }
}

/// Whether a file is a picture as a letterhead may have it, by its extension.
fn is_picture(name: &str) -> bool {
    let extension = name.rsplit_once('.').map(|(_, of)| of.to_ascii_lowercase());
    matches!(extension.as_deref(), Some("png" | "svg"))
}
