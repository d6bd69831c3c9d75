//! Recordings: CSV, WAV and NumPy files as streams of blocks, checked sample by sample.

mod csv_frames;
mod npy_frames;
mod npy_header;
mod preamble;
mod scan;
mod stamps;
mod wav_frames;
mod wide_text;

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use crate::read_failure;
use gumption_engine::fact::Fact;
use gumption_engine::task::Warning;
use gumption_signal::{BLOCK, BlockVisitor, InMemorySamples, Measured, SampleSource, in_blocks};
use gumption_units::Unit;

/// Maximum number of values held in memory, over all channels of a recording (256 MiB); a longer
/// recording is read again for each pass.
const MOST_IN_MEMORY: u64 = 1 << 25;

/// A matrix from the bytes of a NumPy file, row by row.
///
/// # Errors
/// A sentence about the problem, without a capital.
pub fn npy_matrix(bytes: &[u8]) -> Result<(usize, usize, Vec<f64>), String> {
    npy_numbers(bytes, |shape| match *shape {
        [rows, columns] => Ok([rows, columns]),
        _ => Err(format!("it has {} dimensions; a matrix has two", shape.len())),
    })
}

/// The number of columns of the array in a NumPy file, 1 for a plain list, and its numbers row by
/// row.
///
/// # Errors
/// A sentence about the problem, without a capital.
pub fn npy_columns(bytes: &[u8]) -> Result<(usize, Vec<f64>), String> {
    let found = npy_numbers(bytes, |shape| match *shape {
        [rows] => Ok([rows, 1]),
        [rows, columns] => Ok([rows, columns]),
        _ => Err(format!(
            "its array has the shape {shape:?}, but must be samples, or samples by columns"
        )),
    });
    found.map(|(_, columns, numbers)| (columns, numbers))
}

/// Rows, columns and values, row by row, of an array with up to two dimensions.
fn npy_numbers(
    mut bytes: &[u8],
    matrix: impl Fn(&[u64]) -> Result<[u64; 2], String>,
) -> Result<(usize, usize, Vec<f64>), String> {
    let header = npy_header::NpyHeader::read(&mut bytes)?;
    let [rows, columns] = matrix(&header.shape)?;
    let size = header.number.size();
    let count = rows.checked_mul(columns).and_then(|count| usize::try_from(count).ok());
    let count = count.filter(|count| count.checked_mul(size) == Some(bytes.len()));
    let Some(count) = count.filter(|count| *count > 0) else {
        return Err(format!(
            "it has {} bytes after its header, not {rows} x {columns} numbers",
            bytes.len()
        ));
    };
    let (rows, columns) = (rows as usize, columns as usize);
    let stored: Vec<f64> =
        bytes.chunks_exact(size).map(|bytes| header.number.value(bytes)).collect();
    if let Some(place) = stored.iter().position(|value| !value.is_finite()) {
        return Err(format!("its number {} is not finite", place + 1));
    }
    if !header.fortran_order {
        return Ok((rows, columns, stored));
    }
    let turned = (0..count).map(|place| stored[place % columns * rows + place / columns]);
    Ok((rows, columns, turned.collect()))
}

/// A column of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ColumnName {
    /// By its name in the header.
    Name(String),
    /// By its number, from 1.
    Number(usize),
}

/// A wanted column, and the channel for which it is read.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The column.
    pub column: ColumnName,
    /// The name of the channel, in messages.
    pub channel: String,
    /// The unit in which its values are read; its heading may not contradict it. 1 for counts.
    pub unit: Unit,
    /// The unit of the converted values; the same for values that are not scaled.
    pub becomes: Unit,
}

/// The name for the column of instants in messages.
const THE_TIME: &str = "the time";

impl Wanted {
    /// Whether it is the column of instants.
    fn is_time(&self) -> bool {
        self.channel == THE_TIME
    }
}

/// How the raw values of a channel are converted, and where they saturate.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// The raw value that means zero.
    pub zero: f64,
    /// Units of the channel for one raw unit.
    pub gain: f64,
    /// The limits of raw values.
    pub range: Option<[f64; 2]>,
}

/// How to read a recording.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Its bytes.
    pub bytes: Bytes,
    /// The name in messages.
    pub name: String,
    /// The columns, and the conversions of their values.
    pub channels: Vec<(Wanted, Conversion)>,
    /// The column of instants, and its unit.
    pub time: Option<(ColumnName, Unit)>,
    /// The sampling rate in hertz that the recipe states.
    pub rate: Option<Measured>,
    /// Whether that rate is only the start of a search.
    pub searched: bool,
    /// The beginning of the used part, in seconds.
    pub from: Option<f64>,
    /// Where it ends, in seconds.
    pub to: Option<f64>,
    /// The lowest frequency in the recipe, in hertz.
    pub slowest: Option<f64>,
}

/// A recording that was read once and passed the checks.
#[derive(Debug)]
pub struct Recording {
    reading: Reading,
    /// The first used frame, and the number of used frames.
    first: u64,
    frames: u64,
    held: Option<InMemorySamples>,
    /// The sampling rate, in hertz.
    pub rate: Measured,
    /// The instant of the first used frame, in seconds.
    pub start: f64,
    /// The standard uncertainty of the instant in the middle of the record, in seconds, if the file
    /// has a column of instants.
    pub of_middle: Option<f64>,
    /// SHA-256 of the file, in hexadecimal.
    pub digest: String,
    /// The step between values, if the file holds whole numbers.
    pub whole: bool,
    /// What the user must be told about it.
    pub warnings: Vec<Warning>,
}

/// A source of frames: raw values of the wanted columns, the column of instants last if there is one.
trait Frames {
    /// The sampling rate that the file states, in hertz.
    fn rate(&self) -> Option<f64> {
        None
    }

    /// Whether the values are integers of an integer format.
    fn whole(&self) -> bool {
        false
    }

    /// The lines above the samples that are skipped, of the file of that name.
    fn passed_by(&self, _name: &str) -> Option<Fact> {
        None
    }

    /// Reads up to [`BLOCK`] frames into the empty columns; none at the end.
    fn read(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String>;
}

/// Reads a recording completely and checks it.
///
/// # Errors
/// A sentence with line or sample, and channel.
pub fn open(reading: Reading) -> Result<Recording, String> {
    scan::scan(reading)
}

impl Reading {
    /// The columns to read.
    fn wanted(&self) -> Vec<Wanted> {
        let time = self.time.iter().map(|(column, unit)| Wanted {
            column: column.clone(),
            channel: THE_TIME.to_owned(),
            unit: unit.clone(),
            becomes: unit.clone(),
        });
        self.channels.iter().map(|(wanted, _)| wanted.clone()).chain(time).collect()
    }

    fn frames<'r>(&self, reader: impl Read + 'r) -> Result<Box<dyn Frames + 'r>, String> {
        let wanted = self.wanted();
        let extension = Path::new(&self.name).extension().and_then(|e| e.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "wav" | "wave" => {
                let ranges: Vec<_> = self.channels.iter().map(|(_, of)| of.range).collect();
                let size = self.bytes.size();
                Ok(Box::new(wav_frames::WavFrames::new(reader, size, wanted, &ranges)?))
            }
            "npy" => Ok(Box::new(npy_frames::NpyFrames::new(reader, wanted)?)),
            _ => Ok(Box::new(csv_frames::CsvFrames::new(reader, wanted)?)),
        }
    }
}

impl SampleSource for Recording {
    type Error = String;

    fn frames(&self) -> u64 {
        self.frames
    }

    // every sample was checked when the recording was opened
    fn is_checked(&self) -> bool {
        true
    }

    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), String> {
        if let Some(held) = &self.held {
            in_blocks(&held.channels, each);
            return Ok(());
        }
        let file = self.reading.bytes.opened()?;
        let mut frames = self.reading.frames(io::BufReader::with_capacity(1 << 20, file))?;
        let count = self.reading.wanted().len();
        let mut columns = vec![Vec::with_capacity(BLOCK); count];
        let mut waiting: Vec<Vec<f64>> = vec![Vec::new(); self.reading.channels.len()];
        let (mut at, mut given) = (0u64, 0u64);
        loop {
            columns.iter_mut().for_each(Vec::clear);
            frames.read(&mut columns)?;
            let length = columns.first().map_or(0, Vec::len) as u64;
            let from = self.first.saturating_sub(at).min(length) as usize;
            let to = (self.first + self.frames).saturating_sub(at).min(length) as usize;
            for ((values, (_, conversion)), raw) in
                waiting.iter_mut().zip(&self.reading.channels).zip(&columns)
            {
                let used = raw.get(from..to).unwrap_or(&[]);
                values.extend(used.iter().map(|raw| conversion.of(*raw)));
            }
            at += length;
            let done = length == 0 || at >= self.first + self.frames;
            let ready = waiting.first().map_or(0, Vec::len);
            let give = if done { ready } else { ready / BLOCK * BLOCK };
            // blocks begin at the same frames as those of a recording held in memory
            for start in (0..give).step_by(BLOCK) {
                let end = (start + BLOCK).min(give);
                let block: Vec<&[f64]> =
                    waiting.iter().map(|values| values.get(start..end).unwrap_or(&[])).collect();
                each(given, &block);
                given += (end - start) as u64;
            }
            waiting.iter_mut().for_each(|values| {
                values.drain(..give);
            });
            if done {
                return if given == self.frames {
                    Ok(())
                } else {
                    Err("it became shorter while it was read".to_owned())
                };
            }
        }
    }
}

impl Conversion {
    fn of(&self, raw: f64) -> f64 {
        (raw - self.zero) * self.gain
    }
}

/// The source of a recording's bytes.
#[derive(Clone, Debug)]
pub enum Bytes {
    /// On the disk.
    OnDisk(PathBuf),
    /// In memory.
    Held(Arc<[u8]>),
}

impl Bytes {
    /// Their number, if it is known.
    fn size(&self) -> Option<u64> {
        match self {
            Self::OnDisk(path) => {
                std::fs::metadata(path).ok().filter(|of| of.is_file()).map(|of| of.len())
            }
            Self::Held(bytes) => Some(bytes.len() as u64),
        }
    }

    /// A reader from the beginning.
    fn opened(&self) -> Result<Box<dyn Read + '_>, String> {
        let path = match self {
            Self::OnDisk(path) => path,
            Self::Held(bytes) => return Ok(Box::new(&**bytes)),
        };
        let file = File::open(path).map_err(|error| read_failure::of_file(path, &error))?;
        match file.metadata() {
            Ok(data) if data.is_dir() => Err(read_failure::FOLDER.to_owned()),
            _ => Ok(Box::new(file)),
        }
    }
}

/// A reader that computes the digest of the bytes it reads.
struct Digesting<R> {
    inner: R,
    digest: Rc<RefCell<Sha256>>,
}

impl<R: Read> Read for Digesting<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(bytes)?;
        self.digest.borrow_mut().update(bytes.get(..count).unwrap_or(&[]));
        Ok(count)
    }
}

/// The value of a sample if it is finite; samples count from 1.
fn finite(value: f64, sample: u64, wanted: &Wanted) -> Result<f64, String> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(format!("{}: {value} is not a finite number", place(sample, &wanted.channel)))
}

/// "sample 12, channel `a`"; samples count from 1.
fn place(sample: u64, channel: &str) -> String {
    if channel == THE_TIME {
        format!("sample {sample}, the time")
    } else {
        format!("sample {sample}, channel `{channel}`")
    }
}
