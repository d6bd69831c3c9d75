//! Frames of a WAV file: whole numbers as they stand in it, or floating-point numbers.

use std::io::Read;

use hound::{SampleFormat, WavReader};

use super::{BLOCK, ColumnName, Frames, Wanted, finite};

/// Frames of a WAV file.
pub(super) struct WavFrames<R> {
    reader: WavReader<R>,
    places: Vec<usize>,
    wanted: Vec<Wanted>,
    samples: u64,
}

impl<R: Read> WavFrames<R> {
    pub(super) fn new(reader: R, wanted: Vec<Wanted>) -> Result<Self, String> {
        let reader = WavReader::new(reader)
            .map_err(|error| format!("it is not a WAV file that this version reads: {error}"))?;
        let channels = usize::from(reader.spec().channels);
        let mut places = Vec::new();
        for wanted in &wanted {
            match &wanted.column {
                ColumnName::Number(number) if *number <= channels => places.push(number - 1),
                ColumnName::Number(number) => {
                    return Err(format!("it has {channels} channels, so no column {number}"));
                }
                ColumnName::Name(name) => {
                    return Err(format!(
                        "channels of a WAV file have no names, so there is no column `{name}`; give \
                         its number, from 1 to {channels}"
                    ));
                }
            }
        }
        Ok(Self { reader, places, wanted, samples: 0 })
    }
}

impl<R: Read> Frames for WavFrames<R> {
    fn rate(&self) -> Option<f64> {
        Some(f64::from(self.reader.spec().sample_rate))
    }

    fn whole(&self) -> bool {
        self.reader.spec().sample_format == SampleFormat::Int
    }

    fn read(&mut self, columns: &mut [Vec<f64>]) -> Result<(), String> {
        let channels = usize::from(self.reader.spec().channels);
        let mut frames = Vec::with_capacity(BLOCK * channels);
        let samples = self.samples;
        let broken = |error: hound::Error, read: usize| {
            let sample = samples + (read / channels.max(1)) as u64;
            format!("it breaks off after sample {sample}: {error}")
        };
        if self.whole() {
            for value in self.reader.samples::<i32>().take(BLOCK * channels) {
                frames.push(f64::from(value.map_err(|error| broken(error, frames.len()))?));
            }
        } else {
            for value in self.reader.samples::<f32>().take(BLOCK * channels) {
                frames.push(f64::from(value.map_err(|error| broken(error, frames.len()))?));
            }
        }
        of_frames(&frames, channels, (&self.places, &self.wanted), self.samples, columns)?;
        self.samples += (frames.len() / channels.max(1)) as u64;
        Ok(())
    }
}

/// The wanted columns of frames that stand one after the other; all values must be finite.
fn of_frames(
    frames: &[f64],
    channels: usize,
    (places, wanted): (&[usize], &[Wanted]),
    before: u64,
    columns: &mut [Vec<f64>],
) -> Result<(), String> {
    for (sample, frame) in (before + 1..).zip(frames.chunks_exact(channels.max(1))) {
        for ((column, at), wanted) in columns.iter_mut().zip(places).zip(wanted) {
            let value = frame.get(*at).copied().unwrap_or(f64::NAN);
            column.push(finite(value, sample, wanted)?);
        }
    }
    Ok(())
}
