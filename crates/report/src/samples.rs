//! Trials as files for other programs: a line of text for each, or NumPy's binary form.

use std::fmt::Write;

/// The form of a file of trials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrialsForm {
    /// A header of the outputs' names, then one line for each trial; numbers in the shortest text
    /// that reads back as the same number.
    Csv,
    /// NumPy's format, version 1.0: a matrix of trials x outputs, little-endian double precision,
    /// row by row.
    Npy,
}

impl TrialsForm {
    /// The form that a file's extension names.
    pub fn of_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Csv),
            "npy" => Some(Self::Npy),
            _ => None,
        }
    }

    /// What stands before the trials.
    pub fn header(self, outputs: &[&str], trials: u64) -> Vec<u8> {
        match self {
            Self::Csv => format!("{}\n", outputs.join(",")).into_bytes(),
            Self::Npy => {
                let shape = (trials, outputs.len());
                let text =
                    format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape:?}, }}");
                // magic, version, length and text make a multiple of 64, with a newline at the end
                let padded = (10 + text.len() + 1).next_multiple_of(64) - 10;
                let mut header = b"\x93NUMPY\x01\x00".to_vec();
                header.extend((padded as u16).to_le_bytes());
                header.extend(text.bytes());
                header.resize(10 + padded - 1, b' ');
                header.push(b'\n');
                header
            }
        }
    }

    /// A block of trials; `block` has the values of each output.
    pub fn block(self, block: &[Vec<f64>]) -> Vec<u8> {
        let trials = block.first().map_or(0, Vec::len);
        let rows = (0..trials).map(|trial| block.iter().filter_map(move |v| v.get(trial)));
        match self {
            Self::Csv => {
                let mut text = String::new();
                for row in rows {
                    for (output, value) in row.enumerate() {
                        let comma = if output > 0 { "," } else { "" };
                        let _ = write!(text, "{comma}{value:?}");
                    }
                    text.push('\n');
                }
                text.into_bytes()
            }
            Self::Npy => rows.flatten().flat_map(|value| value.to_le_bytes()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The header as `numpy.lib.format` describes it: the array begins at a multiple of 64 bytes.
    #[test]
    fn the_header_of_numpy() {
        let header = TrialsForm::Npy.header(&["a", "b"], 1_000_000);
        assert_eq!(header.len() % 64, 0);
        assert_eq!(&header[..8], b"\x93NUMPY\x01\x00");
        assert_eq!(usize::from(u16::from_le_bytes([header[8], header[9]])), header.len() - 10);
        let text = String::from_utf8(header[10..].to_vec()).unwrap();
        let dict = "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000, 2), }";
        assert_eq!(text.trim_end(), dict);
        assert!(text.ends_with('\n'));
    }

    #[test]
    fn trials_are_rows() {
        let block = [vec![1.0, 1e-7], vec![0.1, -3e300]];
        assert_eq!(TrialsForm::Csv.block(&block), b"1.0,0.1\n1e-7,-3e300\n");
        assert_eq!(TrialsForm::Csv.header(&["a", "b"], 2), b"a,b\n");
        let bytes: Vec<u8> =
            [1.0, 0.1, 1e-7, -3e300f64].iter().flat_map(|v| v.to_le_bytes()).collect();
        assert_eq!(TrialsForm::Npy.block(&block), bytes);
    }
}
