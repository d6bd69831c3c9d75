//! Code paths by name.

use gumption::number::CodePath;

/// The path of that name.
///
/// # Errors
/// A name that no path of this machine has.
pub fn path(name: &str) -> Result<CodePath, String> {
    let available = CodePath::available();
    available.iter().copied().find(|path| path.name() == name).ok_or_else(|| {
        let names: Vec<&str> = available.iter().map(|path| path.name()).collect();
        format!("`{name}` is no code path of this machine; it has {}", names.join(", "))
    })
}
