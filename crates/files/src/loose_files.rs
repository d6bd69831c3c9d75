//! Files that have lost their folders: attached to a certificate, or dropped onto a page.

/// The files, and again by the names with folders that a text, and those of them that are JSON, have for
/// them. Where several files of one name differ, none of them is what is meant.
#[must_use]
pub fn named_in(files: &[(String, Vec<u8>)], text: &str) -> Vec<(String, Vec<u8>)> {
    let own = files.iter().filter(|(name, _)| name.ends_with(".json"));
    let own = own.filter_map(|(_, bytes)| std::str::from_utf8(bytes).ok());
    let said = own.chain([text]).flat_map(|text| text.split('"'));
    let mut all = files.to_vec();
    for name in said.filter(|said| said.contains('/') && said.len() < 1024) {
        let last = name.rsplit('/').next().unwrap_or(name);
        if all.iter().any(|(known, _)| known == name) {
            continue;
        }
        let mut found = files.iter().filter(|(held, _)| held == last).map(|(_, bytes)| bytes);
        if let Some(bytes) = found.next()
            && found.all(|other| other == bytes)
        {
            all.push((name.to_owned(), bytes.clone()));
        }
    }
    all
}
