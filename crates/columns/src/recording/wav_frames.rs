//! Frames of a WAV file: integers as stored, or floating-point numbers.

use std::io::{Chain, Cursor, Read};

use hound::{SampleFormat, WavReader};

use gumption_engine::number::Shortest;

use super::{BLOCK, ColumnName, Frames, Wanted, finite};

/// Frames of a WAV file.
pub(super) struct WavFrames<R> {
    reader: WavReader<Chain<Cursor<Vec<u8>>, R>>,
    places: Vec<usize>,
    wanted: Vec<Wanted>,
    samples: u64,
}

/// Number of bytes in which the samples must begin.
const LONGEST_HEADER: u64 = 1 << 16;

/// Checks the header before the samples, and fills in the length of the samples if the program that
/// wrote the file to a pipe left it at 0 or at the largest number. Chunks without information about
/// the samples (`LIST`, `bext`) are removed, because the reader does not skip the padding byte of
/// odd chunks.
fn header(start: &mut Vec<u8>, size: Option<u64>) -> Result<(), String> {
    let number = |bytes: &[u8], at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
    };
    let half = |bytes: &[u8], at: usize| -> Option<u16> {
        Some(u16::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
    };
    if !start.starts_with(b"RIFF") || start.get(8..12) != Some(b"WAVE") {
        return Err(
            "it is not a WAV file: it does not begin with `RIFF`, a length and `WAVE`".into()
        );
    }
    let (mut at, mut frame, mut left_out) = (12, 0, 0);
    while let Some(length) = number(start, at + 4) {
        let inside = at + 8;
        match start.get(at..at + 4) {
            Some(b"fmt ") => {
                let bits = half(start, inside + 14).unwrap_or(0);
                // in the extensible form the kind is the beginning of a longer number
                let kind = match half(start, inside) {
                    Some(0xfffe) => half(start, inside + 24),
                    other => other,
                };
                if kind == Some(3) && bits != 32 {
                    return Err(format!(
                        "its samples are floating-point numbers of {bits} bits; of 32 bits they are \
                         read, and whole numbers of 8 to 32 bits"
                    ));
                }
                if number(start, inside + 4) == Some(0) {
                    return Err("its header states a sampling rate of 0 Hz".to_owned());
                }
                frame = u64::from(half(start, inside + 12).unwrap_or(0));
            }
            Some(b"data") => {
                let unknown = length == 0 || length >= u32::MAX - 64;
                if let Some(size) = size.filter(|_| unknown && frame > 0) {
                    let before = (inside + left_out) as u64;
                    let left = size.saturating_sub(before).min(u64::from(u32::MAX));
                    let left = (left / frame * frame) as u32;
                    if let Some(place) = start.get_mut(at + 4..inside) {
                        place.copy_from_slice(&left.to_le_bytes());
                    }
                }
                return Ok(());
            }
            _ => {}
        }
        // chunks begin at even places
        let next = inside + length as usize + (length % 2) as usize;
        if start.get(at..at + 4) != Some(b"fmt ") && next <= start.len() {
            start.drain(at..next);
            left_out += next - at;
        } else {
            at = next;
        }
    }
    Ok(())
}

impl<R: Read> WavFrames<R> {
    /// A file of `size` bytes, if the size is known.
    pub(super) fn new(
        mut reader: R,
        size: Option<u64>,
        wanted: Vec<Wanted>,
        ranges: &[Option<[f64; 2]>],
    ) -> Result<Self, String> {
        let mut start = Vec::new();
        let read = reader.by_ref().take(LONGEST_HEADER).read_to_end(&mut start);
        read.map_err(|error| error.to_string())?;
        header(&mut start, size)?;
        let reader = WavReader::new(Cursor::new(start).chain(reader))
            .map_err(|error| format!("it is not a WAV file that this version reads: {error}"))?;
        let spec = reader.spec();
        let channels = usize::from(spec.channels);
        // units that count digits, `D` and `LSB`, are plain numbers
        let is_quantity = |wanted: &&Wanted| {
            let unit = &wanted.unit;
            !unit.dimension().is_none() || unit.turn().is_some() || unit.factor() != 1.0
        };
        if let Some((place, wanted)) =
            wanted.iter().enumerate().find(|(_, wanted)| is_quantity(wanted))
            && spec.sample_format == SampleFormat::Int
        {
            let Wanted { channel, becomes, .. } = wanted;
            let bits = spec.bits_per_sample;
            let full = 1_u64 << bits.clamp(1, 64).saturating_sub(1);
            let of_range = ranges.get(place).copied().flatten().map(|[lower, upper]| {
                format!(
                    "; where its `range` is that of the converter in `{becomes}`, this is `\"scale\": \
                     {{\"value\": {}, \"unit\": \"{becomes}\"}}` without `bits`, and the range in raw \
                     values `\"range\": [-{full}, {}]`",
                    Shortest((upper - lower) / 2.0 / full as f64),
                    full - 1
                )
            });
            return Err(format!(
                "its samples are whole numbers of {bits} bits, and nothing says how many `{becomes}` one is: \
                 state the `scale` of `{channel}`, the value of full scale divided by {full}{}",
                of_range.unwrap_or_default()
            ));
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_units::Unit;

    fn chunk(name: &[u8; 4], content: &[u8]) -> Vec<u8> {
        let mut bytes = [&name[..], &(content.len() as u32).to_le_bytes(), content].concat();
        bytes.resize(bytes.len().next_multiple_of(2), 0);
        bytes
    }

    /// A WAV file with one channel of 16 bits at 1 kHz and with these chunks before its samples.
    fn file(before: &[u8], stated: Option<u32>) -> Vec<u8> {
        let format: Vec<u8> = [1u16, 1].iter().flat_map(|x| x.to_le_bytes()).collect();
        let rates: Vec<u8> = [1000u32, 2000].iter().flat_map(|x| x.to_le_bytes()).collect();
        let sizes: Vec<u8> = [2u16, 16].iter().flat_map(|x| x.to_le_bytes()).collect();
        let samples: Vec<u8> = [1i16, -2, 300].iter().flat_map(|x| x.to_le_bytes()).collect();
        let mut data = chunk(b"data", &samples);
        if let Some(stated) = stated {
            data[4..8].copy_from_slice(&stated.to_le_bytes());
        }
        let format = chunk(b"fmt ", &[format, rates, sizes].concat());
        let all = [b"WAVE".as_slice(), &format, before, &data].concat();
        [b"RIFF".as_slice(), &(all.len() as u32).to_le_bytes(), &all].concat()
    }

    fn read(bytes: &[u8]) -> Result<Vec<f64>, String> {
        read_in(bytes, Unit::one())
    }

    fn read_in(bytes: &[u8], unit: Unit) -> Result<Vec<f64>, String> {
        let wanted = Wanted {
            column: ColumnName::Number(1),
            channel: "a".to_owned(),
            becomes: unit.clone(),
            unit,
        };
        let mut frames = WavFrames::new(bytes, Some(bytes.len() as u64), vec![wanted], &[])?;
        let mut columns = vec![Vec::new()];
        frames.read(&mut columns)?;
        Ok(columns.remove(0))
    }

    /// 300 is not a voltage if the full scale is unknown.
    #[test]
    fn whole_numbers_need_a_scale() {
        let message = read_in(&file(&[], None), Unit::parse("V").unwrap()).unwrap_err();
        assert!(message.contains("how many `V`") && message.contains("32768"), "{message}");
        assert!(read_in(&file(&[], None), Unit::parse("D").unwrap()).is_ok());
    }

    /// Chunks of odd length have a padding byte, which is not part of the next chunk. Chunks after
    /// samples of unstated length do not count as samples.
    #[test]
    fn other_chunks_are_passed_over() {
        let odd = [chunk(b"LIST", b"abcde"), chunk(b"JUNK", b"x")].concat();
        for before in [Vec::new(), chunk(b"LIST", b"abcd"), odd] {
            for stated in [None, Some(0), Some(u32::MAX)] {
                let found = read(&file(&before, stated));
                assert_eq!(found, Ok(vec![1.0, -2.0, 300.0]), "{} {stated:?}", before.len());
            }
        }
    }
}
