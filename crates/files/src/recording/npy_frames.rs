//! Frames of a NumPy file: an array of samples, or of samples by channels.

use std::io::{self, Read};

use npyz::{DType, Deserialize, NpyFile, Order, TypeChar};

use super::wav_frames::of_frames;
use super::{BLOCK, ColumnName, Frames, Wanted};

type Values<'r> = Box<dyn Iterator<Item = io::Result<f64>> + 'r>;

/// Frames of a NumPy file.
pub(super) struct NpyFrames<'r> {
    values: Values<'r>,
    channels: usize,
    whole: bool,
    places: Vec<usize>,
    wanted: Vec<Wanted>,
    samples: u64,
}

impl<'r> NpyFrames<'r> {
    pub(super) fn new(reader: impl Read + 'r, wanted: Vec<Wanted>) -> Result<Self, String> {
        let file =
            NpyFile::new(reader).map_err(|error| format!("it is not a NumPy file: {error}"))?;
        let channels = match *file.shape() {
            [_] => 1,
            [_, channels] if file.order() == Order::C || channels == 1 => channels as usize,
            [_, _] => {
                return Err("its array lies in Fortran order, column by column; save it with \
                            `numpy.ascontiguousarray`"
                    .to_owned());
            }
            _ => {
                let shape = file.shape();
                return Err(format!(
                    "its array has the shape {shape:?}, but must be samples, or samples by channels"
                ));
            }
        };
        let dtype = file.dtype();
        let DType::Plain(kind) = &dtype else {
            return Err(format!("its array has the type {dtype:?}, but must be of plain numbers"));
        };
        let (letter, size) = (kind.type_char(), kind.size_field());
        let whole = matches!(letter, TypeChar::Int | TypeChar::Uint);
        let values: Option<Values<'r>> = match (letter, size) {
            (TypeChar::Float, 8) => of(file, |value: f64| value),
            (TypeChar::Float, 4) => of(file, |value: f32| value.into()),
            (TypeChar::Int, 1) => of(file, |value: i8| value.into()),
            (TypeChar::Int, 2) => of(file, |value: i16| value.into()),
            (TypeChar::Int, 4) => of(file, |value: i32| value.into()),
            (TypeChar::Int, 8) => of(file, |value: i64| value as f64),
            (TypeChar::Uint, 1) => of(file, |value: u8| value.into()),
            (TypeChar::Uint, 2) => of(file, |value: u16| value.into()),
            (TypeChar::Uint, 4) => of(file, |value: u32| value.into()),
            _ => None,
        };
        let values = values.ok_or_else(|| {
            format!(
                "its array has the type `{kind}`, but must be of whole or floating-point numbers"
            )
        })?;
        let mut places = Vec::new();
        for wanted in &wanted {
            match &wanted.column {
                ColumnName::Number(number) if *number <= channels => places.push(number - 1),
                ColumnName::Number(number) => {
                    return Err(format!("its array has {channels} columns, so no column {number}"));
                }
                ColumnName::Name(name) => {
                    return Err(format!(
                        "columns of an array have no names, so there is no column `{name}`; give its \
                         number, from 1 to {channels}"
                    ));
                }
            }
        }
        Ok(Self { values, channels, whole, places, wanted, samples: 0 })
    }
}

/// The elements as numbers of double precision.
fn of<'r, T: Deserialize + 'r>(
    file: NpyFile<impl Read + 'r>,
    number: impl Fn(T) -> f64 + 'r,
) -> Option<Values<'r>> {
    let data = file.data::<T>().ok()?;
    Some(Box::new(data.map(move |value| value.map(&number))))
}

impl Frames for NpyFrames<'_> {
    fn whole(&self) -> bool {
        self.whole
    }

    fn read(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String> {
        let sample = self.samples;
        let mut frames: Vec<f64> = Vec::with_capacity(BLOCK * self.channels);
        for value in self.values.by_ref().take(BLOCK * self.channels) {
            frames.push(value.map_err(|error| {
                let sample = sample + (frames.len() / self.channels.max(1)) as u64;
                format!("it breaks off after sample {sample}: {error}")
            })?);
        }
        of_frames(&frames, self.channels, (&self.places, &self.wanted), sample, columns)?;
        self.samples += (frames.len() / self.channels.max(1)) as u64;
        Ok(())
    }
}
