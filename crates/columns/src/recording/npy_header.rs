//! The header of a NumPy file.
//!
//! Such a file is the bytes `\x93NUMPY`, a version, the header's length, and as the header a Python
//! dictionary of exactly `descr`, `fortran_order` and `shape` (numpy.lib.format, versions 1.0 to
//! 3.0, which differ in the width of the length and in the header's encoding only). Reading this one
//! dictionary needs no reader of Python literals.

use std::io::Read;

/// The longest accepted header, in bytes; the header of an array of plain numbers has about 118.
const LONGEST: u64 = 1 << 16;

/// The description of the array in a header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NpyHeader {
    pub(super) number: NpyNumber,
    /// Whether the first index varies fastest.
    pub(super) fortran_order: bool,
    pub(super) shape: Vec<u64>,
}

/// How a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NpyNumber {
    kind: ElementType,
    big_endian: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ElementType {
    F16,
    F32,
    F64,
    I8,
    I16,
    I32,
    I64,
    U8,
    U16,
    U32,
    U64,
}

impl NpyNumber {
    /// Parses a type string such as `<f8`; `None` for types that are not supported.
    fn parse(text: &str) -> Option<Self> {
        let (order, kind) = text.split_at_checked(1)?;
        let kind = match kind {
            "f2" => ElementType::F16,
            "f4" => ElementType::F32,
            "f8" => ElementType::F64,
            "i1" => ElementType::I8,
            "i2" => ElementType::I16,
            "i4" => ElementType::I32,
            "i8" => ElementType::I64,
            "u1" => ElementType::U8,
            "u2" => ElementType::U16,
            "u4" => ElementType::U32,
            "u8" => ElementType::U64,
            _ => return None,
        };
        let number = Self { kind, big_endian: order == ">" };
        let known = matches!(order, "<" | ">") || order == "|" && number.size() == 1;
        known.then_some(number)
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self.kind {
            ElementType::I8 | ElementType::U8 => 1,
            ElementType::F16 | ElementType::I16 | ElementType::U16 => 2,
            ElementType::F32 | ElementType::I32 | ElementType::U32 => 4,
            ElementType::F64 | ElementType::I64 | ElementType::U64 => 8,
        }
    }

    /// Whether it is an integer format.
    pub(super) fn is_whole(self) -> bool {
        !matches!(self.kind, ElementType::F16 | ElementType::F32 | ElementType::F64)
    }

    /// The number at the start of the bytes; NaN if there are too few bytes.
    pub(super) fn value(self, bytes: &[u8]) -> f64 {
        macro_rules! of {
            ($kind:ty) => {
                bytes.first_chunk().map(|&bytes| {
                    if self.big_endian {
                        <$kind>::from_be_bytes(bytes) as f64
                    } else {
                        <$kind>::from_le_bytes(bytes) as f64
                    }
                })
            };
        }
        let value = match self.kind {
            ElementType::F16 => of!(u16).map(half),
            ElementType::F32 => of!(f32),
            ElementType::F64 => of!(f64),
            ElementType::I8 => of!(i8),
            ElementType::I16 => of!(i16),
            ElementType::I32 => of!(i32),
            ElementType::I64 => of!(i64),
            ElementType::U8 => of!(u8),
            ElementType::U16 => of!(u16),
            ElementType::U32 => of!(u32),
            ElementType::U64 => of!(u64),
        };
        value.unwrap_or(f64::NAN)
    }
}

/// The number with these 16 bits (IEEE 754, binary16), given as an integer.
fn half(bits: f64) -> f64 {
    let bits = bits as u16;
    let (exponent, fraction) = (bits >> 10 & 0x1f, f64::from(bits & 0x3ff));
    let size = match exponent {
        // subnormal: steps of 2^-24
        0 => fraction / 16_777_216.0,
        0x1f if fraction == 0.0 => f64::INFINITY,
        0x1f => f64::NAN,
        _ => (1.0 + fraction / 1024.0) * f64::powi(2.0, i32::from(exponent) - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

impl NpyHeader {
    /// Reads a header; afterwards the reader is at the first number of the array.
    ///
    /// # Errors
    /// A sentence on what is wrong with the header.
    pub(super) fn read(reader: &mut impl Read) -> Result<Self, String> {
        let broken = |error: std::io::Error| format!("it breaks off in its header: {error}");
        let mut start = [0; 8];
        if reader.read_exact(&mut start).is_err() || !start.starts_with(b"\x93NUMPY") {
            return Err("it is not a NumPy file: it does not begin with `\\x93NUMPY`".to_owned());
        }
        let length = match [start[6], start[7]] {
            [1, 0] => {
                let mut length = [0; 2];
                reader.read_exact(&mut length).map_err(broken)?;
                u64::from(u16::from_le_bytes(length))
            }
            [2 | 3, 0] => {
                let mut length = [0; 4];
                reader.read_exact(&mut length).map_err(broken)?;
                u64::from(u32::from_le_bytes(length))
            }
            [major, minor] => {
                return Err(format!(
                    "it is a NumPy file of version {major}.{minor}; this program reads 1.0, 2.0 \
                     and 3.0"
                ));
            }
        };
        if length > LONGEST {
            return Err(format!("its header has {length} bytes; at most {LONGEST} are read"));
        }
        let mut header = vec![0; length as usize];
        reader.read_exact(&mut header).map_err(broken)?;
        let text = String::from_utf8(header)
            .map_err(|_| "its header is not text in UTF-8 or ASCII".to_owned())?;
        Self::parse(&text)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let wrong = |what: &str| format!("its header is not one of NumPy: {what}");
        let inside = text.trim().strip_prefix('{').and_then(|text| text.strip_suffix('}'));
        let inside = inside.ok_or_else(|| wrong("it is not a dictionary in braces"))?;
        let (mut descr, mut order, mut shape) = (None, None, None);
        for entry in items(inside) {
            let key = quoted(entry).ok_or_else(|| wrong("a key is not text in quotes"))?;
            let value = entry.get(key.len() + 2..).unwrap_or("").trim_start().strip_prefix(':');
            let value = value.ok_or_else(|| wrong("a key has no value"))?.trim();
            let entry = match key {
                "descr" => &mut descr,
                "fortran_order" => &mut order,
                "shape" => &mut shape,
                _ => {
                    return Err(wrong("it has another key than `descr`, `fortran_order`, `shape`"));
                }
            };
            *entry = Some(value);
        }
        let (Some(descr), Some(order), Some(shape)) = (descr, order, shape) else {
            return Err(wrong("one of `descr`, `fortran_order` and `shape` is missing"));
        };
        let fortran_order = match order {
            "True" => true,
            "False" => false,
            _ => return Err(wrong("`fortran_order` is neither True nor False")),
        };
        let shape = shape_of(shape).ok_or_else(|| {
            wrong("`shape` is not a tuple of whole numbers from 0 to 18446744073709551615")
        })?;
        let Some(name) = quoted(descr).filter(|name| name.len() + 2 == descr.len()) else {
            return Err("its array has records, but must have plain numbers".to_owned());
        };
        let number = NpyNumber::parse(name).ok_or_else(|| {
            format!(
                "its array has the type `{name}`, but must be of whole or floating-point numbers of \
                 at most 64 bits"
            )
        })?;
        Ok(Self { number, fortran_order, shape })
    }
}

/// The quoted text at the start of a text. NumPy writes no escapes in the keys and types that are
/// read here.
fn quoted(text: &str) -> Option<&str> {
    let quote = text.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    text.get(1..)?.split_once(quote).map(|(inside, _)| inside)
}

/// The items between commas outside brackets and quotes, without empty items.
fn items(text: &str) -> Vec<&str> {
    let (mut depth, mut quote, mut start, mut found) = (0usize, None, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') => quote = Some(c),
            (None, '(' | '[' | '{') => depth += 1,
            (None, ')' | ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                found.push(&text[start..at]);
                start = at + 1;
            }
            (None, _) => {}
        }
    }
    found.push(&text[start..]);
    found.into_iter().map(str::trim).filter(|item| !item.is_empty()).collect()
}

fn shape_of(text: &str) -> Option<Vec<u64>> {
    let inside = text.strip_prefix('(')?.strip_suffix(')')?;
    // Python 2 wrote integers with an L
    items(inside).into_iter().map(|item| item.trim_end_matches('L').parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of a file of this version whose header states this length.
    fn file(version: u8, length: usize, header: &str) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY".to_vec();
        bytes.extend([version, 0]);
        match version {
            1 => bytes.extend((length as u16).to_le_bytes()),
            _ => bytes.extend((length as u32).to_le_bytes()),
        }
        bytes.extend(header.as_bytes());
        bytes
    }

    fn read(version: u8, header: &str) -> Result<NpyHeader, String> {
        NpyHeader::read(&mut file(version, header.len(), header).as_slice())
    }

    fn number(text: &str) -> NpyNumber {
        NpyNumber::parse(text).unwrap()
    }

    /// As `numpy.save` of NumPy 1.26 writes it, and the same for the other versions.
    #[test]
    fn all_versions() {
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (30001, 2), }      \n";
        let expected =
            NpyHeader { number: number("<f8"), fortran_order: false, shape: vec![30_001, 2] };
        for version in 1..=3 {
            assert_eq!(read(version, header), Ok(expected.clone()));
        }
        // the reader is after the header
        let bytes = [file(2, header.len(), header), vec![7, 8]].concat();
        let mut rest = bytes.as_slice();
        NpyHeader::read(&mut rest).unwrap();
        assert_eq!(rest, [7, 8]);
        let message = read(4, header).unwrap_err();
        assert!(message.contains("version 4.0"), "{message}");
    }

    /// Other spellings that Python accepts: other quotes, another order, no spaces, Python 2's
    /// integers.
    #[test]
    fn spellings() {
        let expected = NpyHeader { number: number(">i2"), fortran_order: true, shape: vec![5] };
        for header in [
            "{'shape':(5,),'fortran_order':True,'descr':'>i2'}",
            "{\"shape\" : ( 5L , ), \"descr\": \">i2\", \"fortran_order\": True,}\n",
        ] {
            assert_eq!(read(1, header).as_ref(), Ok(&expected), "{header}");
        }
        let scalar = read(1, "{'descr': '|u1', 'fortran_order': False, 'shape': ()}").unwrap();
        assert!(scalar.shape.is_empty());
    }

    #[test]
    fn hostile_headers() {
        let header = |descr: &str, shape: &str| {
            read(1, &format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}}}"))
        };
        for (found, part) in [
            (header("'|O'", "(3,)"), "the type `|O`"),
            (header("'<U7'", "(3,)"), "the type `<U7`"),
            (header("'|f8'", "(3,)"), "the type `|f8`"),
            (header("'<c16'", "(3,)"), "the type `<c16`"),
            (header("'é8'", "(3,)"), "the type `é8`"),
            (header("[('a', '<f8'), ('b', '<i4', (2, 3))]", "(3,)"), "has records"),
            (header("'<f8'", "(-3,)"), "`shape`"),
            (header("'<f8'", "(99999999999999999999,)"), "`shape`"),
            (header("'<f8'", "(2.5,)"), "`shape`"),
            (header("'<f8'", "3"), "`shape`"),
            (header("'<f8'", "(3,"), "`shape`"),
            (header("'<f8", "(3,)"), "missing"),
            (read(1, "{'descr': '<f8', 'shape': (3,)}"), "missing"),
            (read(1, "{'descr': '<f8', 'fortran_order': 0, 'shape': (3,)}"), "neither True"),
            (read(1, "{'descr' '<f8'}"), "has no value"),
            (read(1, "{descr: '<f8'}"), "not text in quotes"),
            (read(1, "{'colour': '<f8'}"), "another key"),
            (read(1, "['descr']"), "not a dictionary"),
            (read(1, ""), "not a dictionary"),
            (NpyHeader::read(&mut file(1, 500, "{'descr'").as_slice()), "breaks off in its header"),
            (NpyHeader::read(&mut file(2, 0xffff_ffff, "{").as_slice()), "4294967295 bytes"),
            (NpyHeader::read(&mut file(3, 7, "{\0\0\0\0\0\0").as_slice()), "not a dictionary"),
            (NpyHeader::read(&mut b"\x93NUMPY\x01\x00".as_slice()), "breaks off in its header"),
            (NpyHeader::read(&mut b"\x93NUM".as_slice()), "not a NumPy file"),
            (NpyHeader::read(&mut b"PK\x03\x04 an archive".as_slice()), "not a NumPy file"),
        ] {
            let message = found.unwrap_err();
            assert!(message.contains(part), "{message} should contain {part}");
        }
    }

    /// Every type in both byte orders.
    #[test]
    fn numbers() {
        let same = |kind: &str, little: &[u8], value: f64| {
            let big: Vec<u8> = little.iter().rev().copied().collect();
            assert_eq!(number(&format!("<{kind}")).value(little), value, "{kind}");
            assert_eq!(number(&format!(">{kind}")).value(&big), value, "{kind}");
            assert_eq!(number(&format!("<{kind}")).size(), little.len(), "{kind}");
        };
        same("f8", &(-0.1f64).to_le_bytes(), -0.1);
        same("f4", &2.5f32.to_le_bytes(), 2.5);
        same("i1", &[0xfe], -2.0);
        same("i2", &[0x00, 0x80], -32768.0);
        same("i4", &[0x01, 0, 0, 0x80], -2_147_483_647.0);
        same("i8", &[1, 0, 0, 0, 0, 0, 0, 0], 1.0);
        same("u1", &[0xfe], 254.0);
        same("u2", &[0x00, 0x80], 32768.0);
        same("u4", &[0xff, 0xff, 0xff, 0xff], 4_294_967_295.0);
    }
}
