//! Converts text in UTF-16 to UTF-8 while it is read.

use std::io::{self, Read};

/// Maximum number of bytes converted at a time.
const CHUNK: usize = 1 << 16;

/// The message for text that cannot be converted.
const NO_TEXT: &str = "it begins as UTF-16 text, but is not";

/// The bytes of a text: unchanged, or converted to UTF-8 if they begin with a byte-order mark of
/// UTF-16, as Windows programs write it.
pub(super) struct NarrowText<R> {
    inner: R,
    /// How two bytes form a code unit; `None` if the bytes are passed through.
    unit: Option<fn([u8; 2]) -> u16>,
    /// The converted text, and how much of it has been returned.
    turned: Vec<u8>,
    given: usize,
    /// Half a code unit, and the first code unit of a pair.
    half: Option<u8>,
    first: Option<u16>,
}

impl<R: Read> NarrowText<R> {
    /// Examines the first two bytes.
    pub(super) fn new(mut inner: R) -> io::Result<Self> {
        let mut turned = Vec::new();
        inner.by_ref().take(2).read_to_end(&mut turned)?;
        let unit: Option<fn([u8; 2]) -> u16> = match turned.as_slice() {
            [0xff, 0xfe] => Some(u16::from_le_bytes),
            [0xfe, 0xff] => Some(u16::from_be_bytes),
            _ => None,
        };
        if unit.is_some() {
            turned.clear();
        }
        Ok(Self { inner, unit, turned, given: 0, half: None, first: None })
    }

    /// Converts the next bytes; false at the end.
    fn turn(&mut self, unit: fn([u8; 2]) -> u16) -> io::Result<bool> {
        let no_text = || io::Error::new(io::ErrorKind::InvalidData, NO_TEXT);
        let mut bytes = Vec::with_capacity(CHUNK + 1);
        bytes.extend(self.half.take());
        let before = bytes.len();
        self.inner.by_ref().take(CHUNK as u64).read_to_end(&mut bytes)?;
        if bytes.len() == before {
            let is_whole = bytes.is_empty() && self.first.is_none();
            return if is_whole { Ok(false) } else { Err(no_text()) };
        }
        let (pairs, left) = bytes.as_chunks();
        self.half = left.first().copied();
        let mut units: Vec<u16> = self.first.take().into_iter().collect();
        units.extend(pairs.iter().map(|&pair| unit(pair)));
        if units.last().is_some_and(|last| (0xd800..0xdc00).contains(last)) {
            self.first = units.pop();
        }
        self.turned = String::from_utf16(&units).map_err(|_| no_text())?.into_bytes();
        self.given = 0;
        Ok(true)
    }
}

impl<R: Read> Read for NarrowText<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        loop {
            let rest = self.turned.get(self.given..).unwrap_or_default();
            if !rest.is_empty() {
                let count = rest.len().min(out.len());
                out[..count].copy_from_slice(&rest[..count]);
                self.given += count;
                return Ok(count);
            }
            match self.unit {
                None => return self.inner.read(out),
                Some(unit) => {
                    if !self.turn(unit)? {
                        return Ok(0);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> io::Result<String> {
        let mut text = String::new();
        NarrowText::new(bytes)?.read_to_string(&mut text)?;
        Ok(text)
    }

    #[test]
    fn both_orders_and_pairs_across_chunks() {
        // an odd number of code units, so that a pair straddles the end of a chunk
        let text = format!("t{}", "µ,😀\n".repeat(20_000));
        for of in [u16::to_le_bytes, u16::to_be_bytes] {
            let wide: Vec<u8> =
                std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(of).collect();
            assert!(read(&wide).unwrap() == text);
            // without half a code unit, and without half a pair
            for less in [1, 4] {
                assert!(read(&wide[..wide.len() - less]).is_err(), "{less}");
            }
        }
        assert_eq!(read("t,a\n".as_bytes()).unwrap(), "t,a\n");
        assert_eq!(read(b"").unwrap(), "");
        assert_eq!(read(b"1").unwrap(), "1");
        assert_eq!(read(b"\xff\xfe").unwrap(), "");
        assert!(read(b"\xff\xfe1").is_err());
        assert!(read(b"\xff\xfe\x00\xd8").is_err());
    }
}
