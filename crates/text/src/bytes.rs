//! Reads the content of files up to a maximum size, and what tells it from others.

use std::borrow::Cow;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use gumption_columns::read_failure;
use sha2::{Digest, Sha256};

/// Maximum size of a model file, a result file or a table, in bytes. Reading takes up to twelve
/// times as much memory.
pub const MOST: u64 = 50_000_000;

/// Maximum size of a file of samples, in bytes.
pub const MOST_OF_SAMPLES: u64 = 200_000_000;

/// The SHA-256 digest of bytes (FIPS 180-4), 64 hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The content of a file of at most `most` bytes, or why it cannot be read. Of a larger file or an
/// endless device, at most `most + 1` bytes are read.
pub fn of_file(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    // the system's message for a directory differs: access is denied on Windows
    if path.is_dir() {
        return Err(read_failure::FOLDER.to_owned());
    }
    let file = File::open(path).map_err(|error| read_failure::of_file(path, &error))?;
    of(file, most).map_err(|error| error.to_string())
}

/// Why there is no content.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReadError {
    /// The system cannot read it.
    Io(io::Error),
    /// The file is larger than the limit, in bytes.
    TooLarge {
        /// The most that are read.
        most: u64,
    },
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => f.write_str(&read_failure::in_words(error)),
            Self::TooLarge { most } => {
                let most = most / 1_000_000;
                write!(f, "it is larger than {most} MB, the most that this version reads")
            }
        }
    }
}

impl std::error::Error for ReadError {}

/// Reads everything that a reader gives, up to `most` bytes.
///
/// # Errors
/// The reader gives more bytes, or fails with a system error.
pub fn of(reader: impl Read, most: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    reader.take(most + 1).read_to_end(&mut bytes).map_err(ReadError::Io)?;
    if bytes.len() as u64 > most {
        return Err(ReadError::TooLarge { most });
    }
    Ok(bytes)
}

/// Whether a file is an OpenDocument archive: its first entry is its type, not compressed
/// (OpenDocument 1.3, part 2, 3.3).
fn is_open_document(bytes: &[u8]) -> bool {
    const TYPE: &[u8] = b"mimetypeapplication/vnd.oasis.opendocument";
    // the name of the first entry follows 30 bytes
    bytes.starts_with(b"PK\x03\x04") && bytes.get(30..).is_some_and(|rest| rest.starts_with(TYPE))
}

/// The text of a file: UTF-8, or UTF-16 with its byte-order mark, as Windows PowerShell writes it.
///
/// # Errors
/// A sentence that says which encoding is invalid.
pub fn text(bytes: &[u8]) -> Result<Cow<'_, str>, String> {
    type Unit = fn([u8; 2]) -> u16;
    let (rest, of): (&[u8], Unit) = match bytes {
        [0xff, 0xfe, rest @ ..] => (rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => (rest, u16::from_be_bytes),
        _ => {
            let text = std::str::from_utf8(bytes).map_err(|_| {
                if is_open_document(bytes) {
                    return "it is a workbook of the format .ods, or another OpenDocument file, which \
                            cannot be read: save it as .xlsx, or its sheet as .csv"
                        .to_owned();
                }
                // zip archives, and therefore workbooks, begin like this
                if bytes.starts_with(b"PK\x03\x04") {
                    return "it is a workbook, or another archive: `gumption import` makes a model file of a \
                            budget; of a table save the sheet as `CSV UTF-8`"
                        .to_owned();
                }
                "it is not UTF-8 text: save it as UTF-8, from a spreadsheet as `CSV UTF-8` or as a \
                 workbook"
                    .to_owned()
            });
            return text.map(Cow::Borrowed);
        }
    };
    let (units, left) = rest.as_chunks();
    let text = String::from_utf16(&units.iter().map(|&unit| of(unit)).collect::<Vec<u16>>());
    match text {
        Ok(text) if left.is_empty() => Ok(text.into()),
        _ => Err("it begins as UTF-16 text, but is not".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_both_widths_are_read() {
        let wide = |mark: u16, of: fn(u16) -> [u8; 2]| -> Vec<u8> {
            std::iter::once(mark).chain("aµ😀".encode_utf16()).flat_map(of).collect()
        };
        for bytes in [wide(0xfeff, u16::to_le_bytes), wide(0xfeff, u16::to_be_bytes), "aµ😀".into()]
        {
            assert_eq!(text(&bytes).unwrap(), "aµ😀");
        }
        assert!(text(b"\xff\xfea").unwrap_err().contains("UTF-16"));
        assert!(text(b"\xff\xfe\x00\xd8").unwrap_err().contains("UTF-16"));
        assert!(text(b"\x80").unwrap_err().contains("UTF-8"));
        let archive =
            |entry: &str| [b"PK\x03\x04".as_slice(), &[0xff; 26], entry.as_bytes()].concat();
        assert!(text(&archive("[Content_Types].xml")).unwrap_err().contains("gumption import"));
        let sheet = archive("mimetypeapplication/vnd.oasis.opendocument.spreadsheet");
        let said = text(&sheet).unwrap_err();
        assert!(said.contains(".ods") && !said.contains("gumption import"), "{said}");
    }

    #[test]
    fn a_file_without_an_end_is_refused() {
        assert_eq!(of(&b"abc"[..], 3).unwrap(), b"abc");
        assert!(of(&b"abcd"[..], 3).is_err());
        let message = of(io::repeat(0), 2_000_000).unwrap_err().to_string();
        assert_eq!(message, "it is larger than 2 MB, the most that this version reads");
    }

    #[test]
    fn a_folder_is_called_one() {
        assert_eq!(of_file(Path::new("."), 1).unwrap_err(), read_failure::FOLDER);
    }
}
