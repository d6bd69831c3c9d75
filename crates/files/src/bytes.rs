//! The content of files, up to a size.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Bytes of a model file, a result file or a table, at most. What is read takes up to a dozen times
/// as much memory.
pub const MOST: u64 = 50_000_000;

/// Bytes of a file of samples, at most.
pub(super) const MOST_OF_SAMPLES: u64 = 200_000_000;

/// The content of a file of at most so many bytes, or why there is none. Of a larger one, or of a
/// device without an end, no more than that is read.
pub(super) fn of_file(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let file = File::open(path).map_err(|error| error.to_string())?;
    of(file, most)
}

/// All that a reader gives, up to so many bytes, or why not.
pub fn of(reader: impl Read, most: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    reader.take(most + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > most {
        let most = most / 1_000_000;
        return Err(format!("it is larger than {most} MB, which this version takes at most"));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_without_an_end_is_refused() {
        assert_eq!(of(&b"abc"[..], 3).unwrap(), b"abc");
        assert!(of(&b"abcd"[..], 3).is_err());
        let message = of(std::io::repeat(0), 2_000_000).unwrap_err();
        assert_eq!(message, "it is larger than 2 MB, which this version takes at most");
    }
}
