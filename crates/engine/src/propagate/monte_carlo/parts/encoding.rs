//! Numbers as bytes: what parts of a run are written in.
//!
//! Integers take seven bits to a byte, lowest first, the eighth bit saying that more follow (LEB128);
//! real numbers the eight bytes of their bits, lowest first. Whatever stands in the bytes, reading
//! them ends with a value or with [`Damaged`]: no length is believed before there are bytes for it.

use std::fmt;

/// Bytes that are not what they should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damaged {
    what: &'static str,
}

impl Damaged {
    pub(crate) fn new(what: &'static str) -> Self {
        Self { what }
    }

    /// An error unless something holds.
    pub(crate) fn unless(holds: bool, what: &'static str) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self { what }) }
    }
}

impl fmt::Display for Damaged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "it is damaged: {}", self.what)
    }
}

impl std::error::Error for Damaged {}

/// Bytes that are being written.
#[derive(Clone, Debug, Default)]
pub(crate) struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    pub(crate) fn number(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    pub(crate) fn real(&mut self, value: f64) {
        self.bytes.extend_from_slice(&value.to_bits().to_le_bytes());
    }

    pub(crate) fn reals(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.real(*value));
    }

    /// Real numbers and how many they are.
    pub(crate) fn list(&mut self, values: &[f64]) {
        self.number(values.len() as u64);
        self.reals(values);
    }

    pub(crate) fn flag(&mut self, value: bool) {
        self.bytes.push(u8::from(value));
    }

    /// A value that may be missing.
    pub(crate) fn option<T>(&mut self, value: Option<T>, write: impl FnOnce(&mut Self, T)) {
        self.flag(value.is_some());
        if let Some(value) = value {
            write(self, value);
        }
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// Bytes that are being read.
#[derive(Clone, Debug)]
pub(crate) struct ByteReader<'b> {
    rest: &'b [u8],
}

impl<'b> ByteReader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self { rest: bytes }
    }

    fn byte(&mut self) -> Result<u8, Damaged> {
        let (&first, rest) = self.rest.split_first().ok_or(Damaged::new("it ends too early"))?;
        self.rest = rest;
        Ok(first)
    }

    pub(crate) fn number(&mut self) -> Result<u64, Damaged> {
        let mut value = 0u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 0x7f);
            let placed = bits << shift;
            Damaged::unless(placed >> shift == bits, "a number is too large")?;
            value |= placed;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(Damaged::new("a number is too large"))
    }

    /// A number up to `most`.
    pub(crate) fn at_most(&mut self, most: u64, what: &'static str) -> Result<u64, Damaged> {
        let value = self.number()?;
        Damaged::unless(value <= most, what)?;
        Ok(value)
    }

    pub(crate) fn real(&mut self) -> Result<f64, Damaged> {
        let (bytes, rest) =
            self.rest.split_first_chunk().ok_or(Damaged::new("it ends too early"))?;
        self.rest = rest;
        Ok(f64::from_bits(u64::from_le_bytes(*bytes)))
    }

    pub(crate) fn finite(&mut self) -> Result<f64, Damaged> {
        let value = self.real()?;
        Damaged::unless(value.is_finite(), "a value is not finite")?;
        Ok(value)
    }

    pub(crate) fn reals<const N: usize>(&mut self) -> Result<[f64; N], Damaged> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.real()?;
        }
        Ok(values)
    }

    /// A list of real numbers, at most so many.
    pub(crate) fn list(&mut self, most: u64) -> Result<Vec<f64>, Damaged> {
        let count = self.at_most(most, "a list is too long")?;
        Damaged::unless(count <= self.rest.len() as u64 / 8, "it ends too early")?;
        (0..count).map(|_| self.real()).collect()
    }

    pub(crate) fn flag(&mut self) -> Result<bool, Damaged> {
        match self.byte()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged::new("neither yes nor no")),
        }
    }

    /// A value that may be missing.
    pub(crate) fn option<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Damaged>,
    ) -> Result<Option<T>, Damaged> {
        if self.flag()? { read(self).map(Some) } else { Ok(None) }
    }

    /// That nothing is left.
    pub(crate) fn end(self) -> Result<(), Damaged> {
        Damaged::unless(self.rest.is_empty(), "something follows its end")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back() {
        let numbers = [0, 1, 127, 128, 300, u64::from(u32::MAX), u64::MAX];
        let reals = [0.0, -0.0, 1.5, f64::NAN, f64::INFINITY, f64::MIN_POSITIVE];
        let mut out = Writer::default();
        numbers.iter().for_each(|number| out.number(*number));
        out.list(&reals);
        out.option(Some(3), Writer::number);
        out.option(None, Writer::number);
        let bytes = out.into_bytes();
        let mut from = ByteReader::new(&bytes);
        for number in numbers {
            assert_eq!(from.number(), Ok(number));
        }
        let list = from.list(6).unwrap();
        assert!(list.iter().zip(reals).all(|(a, b)| a.to_bits() == b.to_bits()));
        assert_eq!(from.option(ByteReader::number), Ok(Some(3)));
        assert_eq!(from.option(ByteReader::number), Ok(None));
        assert_eq!(from.end(), Ok(()));
    }

    /// Too large a number, a list that is longer than the bytes, and what ends early.
    #[test]
    fn what_is_no_number_is_told() {
        let damaged = |bytes: &[u8]| ByteReader::new(bytes).number().is_err();
        assert!(damaged(&[]) && damaged(&[0x80]) && damaged(&[0xff; 10]) && damaged(&[0xff; 9]));
        assert_eq!(ByteReader::new(&[&[0xff; 9][..], &[1]].concat()).number(), Ok(u64::MAX));
        let mut huge = Writer::default();
        huge.number(u64::MAX);
        let huge = huge.into_bytes();
        assert!(ByteReader::new(&huge).list(u64::MAX).is_err());
        assert!(ByteReader::new(&[2]).flag().is_err());
        assert!(ByteReader::new(&[0; 7]).real().is_err());
        assert!(ByteReader::new(&[0]).end().is_err());
    }
}
