//! Frames of a NumPy file: an array of samples, or of samples by channels.

use std::io::{ErrorKind, Read};

use super::npy_header::{NpyHeader, NpyNumber};
use super::{BLOCK, ColumnName, Frames, Wanted, finite};

/// The widest array, so that the buffer of a frame stays small (8 MiB) whatever a header claims.
const MOST_CHANNELS: u64 = 1 << 20;

/// Frames of a NumPy file.
#[derive(Debug)]
pub(super) struct NpyFrames<R> {
    reader: R,
    number: NpyNumber,
    /// The bytes of a frame.
    frame: Vec<u8>,
    /// The offsets of the wanted columns in a frame.
    offsets: Vec<usize>,
    wanted: Vec<Wanted>,
    /// The number of frames, and how many have been read.
    samples: u64,
    read: u64,
}

impl<R: Read> NpyFrames<R> {
    pub(super) fn new(mut reader: R, wanted: Vec<Wanted>) -> Result<Self, String> {
        let NpyHeader { number, fortran_order, shape } = NpyHeader::read(&mut reader)?;
        let (samples, channels) = match *shape.as_slice() {
            [samples] => (samples, 1),
            [samples, channels] if !fortran_order || channels == 1 => (samples, channels),
            [_, _] => {
                return Err("its array is in Fortran order, column by column; save it with \
                            `numpy.ascontiguousarray`"
                    .to_owned());
            }
            _ => {
                return Err(format!(
                    "its array has the shape {shape:?}, but must be samples, or samples by channels"
                ));
            }
        };
        if channels > MOST_CHANNELS {
            return Err(format!(
                "its array has {channels} columns; at most {MOST_CHANNELS} are read"
            ));
        }
        let channels = channels as usize;
        let column = |wanted: &Wanted| match &wanted.column {
            ColumnName::Number(number) if *number <= channels => Ok(number - 1),
            ColumnName::Number(number) => {
                Err(format!("its array has {channels} columns, so no column {number}"))
            }
            ColumnName::Name(name) => Err(format!(
                "columns of an array have no names, so there is no column `{name}`; give its \
                 number, from 1 to {channels}"
            )),
        };
        let offset = |wanted: &Wanted| column(wanted).map(|column| column * number.size());
        let offsets = wanted.iter().map(offset).collect::<Result<_, _>>()?;
        let frame = vec![0; channels * number.size()];
        Ok(Self { reader, number, frame, offsets, wanted, samples, read: 0 })
    }
}

impl<R: Read> Frames for NpyFrames<R> {
    fn whole(&self) -> bool {
        self.number.is_whole()
    }

    fn read(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String> {
        for _ in 0..BLOCK as u64 {
            if self.read == self.samples {
                break;
            }
            self.reader.read_exact(&mut self.frame).map_err(|error| match error.kind() {
                ErrorKind::UnexpectedEof => {
                    format!("it breaks off after sample {} of {}", self.read, self.samples)
                }
                _ => error.to_string(),
            })?;
            self.read += 1;
            for ((column, offset), wanted) in
                columns.iter_mut().zip(&self.offsets).zip(&self.wanted)
            {
                let value = self.number.value(self.frame.get(*offset..).unwrap_or(&[]));
                column.push(finite(value, self.read, wanted)?);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_units::Unit;

    /// A file of version 1.0.
    fn file(descr: &str, shape: &str, fortran: &str, data: &[u8]) -> Vec<u8> {
        let header =
            format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    fn column(number: usize) -> Wanted {
        Wanted {
            column: ColumnName::Number(number),
            channel: format!("c{number}"),
            unit: Unit::one(),
            becomes: Unit::one(),
        }
    }

    /// All blocks of the wanted columns.
    fn columns(bytes: &[u8], wanted: &[usize]) -> Result<Vec<Vec<f64>>, String> {
        let wanted: Vec<Wanted> = wanted.iter().copied().map(column).collect();
        let mut all = vec![Vec::new(); wanted.len()];
        let mut frames = NpyFrames::new(bytes, wanted)?;
        loop {
            let mut block = vec![Vec::new(); all.len()];
            frames.read(&mut block)?;
            if block.iter().all(Vec::is_empty) {
                return Ok(all);
            }
            assert!(block.iter().all(|column| column.len() <= BLOCK));
            all.iter_mut().zip(block).for_each(|(all, block)| all.extend(block));
        }
    }

    /// More than a block of frames with three columns; the third and the first are wanted.
    #[test]
    fn samples_by_channels() {
        let count = BLOCK + 3;
        let data: Vec<u8> = (0..3 * count as i32).flat_map(i32::to_be_bytes).collect();
        let bytes = file(">i4", &format!("({count}, 3)"), "False", &data);
        let found = columns(&bytes, &[3, 1]).unwrap();
        let expected = [2, 0].map(|c| (0..count).map(|i| (3 * i + c) as f64).collect::<Vec<_>>());
        assert_eq!(found, expected);
        let message = columns(&bytes, &[4]).unwrap_err();
        assert_eq!(message, "its array has 3 columns, so no column 4");
    }

    /// One column is the same in both orders; bytes after the array are ignored.
    #[test]
    fn one_channel() {
        let data: Vec<u8> = [0.5f32, -1.25, 7.0].iter().flat_map(|v| v.to_le_bytes()).collect();
        for (shape, order) in
            [("(2,)", "False"), ("(2,)", "True"), ("(2, 1)", "True"), ("(2, 1)", "False")]
        {
            let found = columns(&file("<f4", shape, order, &data), &[1]);
            assert_eq!(found, Ok(vec![vec![0.5, -1.25]]), "{shape} {order}");
        }
        assert_eq!(columns(&file("<f4", "(0,)", "False", &[]), &[1]), Ok(vec![Vec::new()]));
    }

    #[test]
    fn broken_arrays() {
        let nan: Vec<u8> = [1.0, f64::NAN].iter().flat_map(|v| v.to_le_bytes()).collect();
        for (bytes, message) in [
            (file("<f8", "(3,)", "False", &nan[..15]), "it breaks off after sample 1 of 3"),
            // 2^63 samples take no memory before they are read
            (
                file("|u1", "(9223372036854775808, 2)", "False", &[1, 2, 3]),
                "it breaks off after sample 1 of 9223372036854775808",
            ),
            (
                file("<f8", "(1, 9223372036854775808)", "False", &[]),
                "its array has 9223372036854775808 columns; at most 1048576 are read",
            ),
            (file("<f8", "(2, 0)", "False", &[]), "its array has 0 columns, so no column 1"),
            (
                file("<f8", "(1, 2)", "True", &[]),
                "its array is in Fortran order, column by column; save it with \
                 `numpy.ascontiguousarray`",
            ),
            (
                file("<f8", "()", "False", &[]),
                "its array has the shape [], but must be samples, or samples by channels",
            ),
            (
                file("<f8", "(2,)", "False", &nan),
                "sample 2, channel `c1`: NaN is not a finite number",
            ),
        ] {
            assert_eq!(columns(&bytes, &[1]).unwrap_err(), message);
        }
    }
}
