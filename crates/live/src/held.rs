//! Files in memory.

use gumption_text::FileSource;

/// Files in memory only, by their names in model files: files that were dropped onto a page without
/// a server.
#[derive(Clone, Debug, Default)]
pub struct HeldFiles(pub Vec<(String, Vec<u8>)>);

impl HeldFiles {
    /// The same files by the names that a text, and the model files among them, use: a dropped file
    /// has lost its folder.
    #[must_use]
    pub fn named_in(&self, text: &str) -> Self {
        Self(gumption_files::named_in(&self.0, text))
    }
}

impl FileSource for HeldFiles {
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String> {
        let plain = |name: &str| name.trim_start_matches("./").to_owned();
        let found = self.0.iter().find(|(held, _)| plain(held) == plain(name));
        let Some((_, bytes)) = found else {
            return Err("it is not there; drop it onto the page".to_owned());
        };
        if bytes.len() as u64 > most {
            let most = most / 1_000_000;
            return Err(format!("it is larger than {most} MB, the most that this version reads"));
        }
        Ok(bytes.clone())
    }
}
