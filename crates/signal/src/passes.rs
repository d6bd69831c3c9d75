//! Going through the channels of a recording, block by block, as often as a step needs.

use std::convert::Infallible;
use std::marker::PhantomData;

/// Frames of a block at most: a block of some channels fits the cache.
pub const BLOCK: usize = 4096;

/// What is called with each block: the number of its first frame, and the values of each channel.
pub type BlockVisitor<'e> = dyn FnMut(u64, &[&[f64]]) + 'e;

/// Channels on one time base that can be gone through again and again in blocks of at most
/// [`BLOCK`] frames, always the same.
pub trait SampleSource {
    /// Why values cannot be had.
    type Error;

    /// Frames (values of each channel) in all.
    fn frames(&self) -> u64;

    /// Whether it is known that every value is a finite number and that every channel has a value in
    /// each frame. [`observe`](super::observe) looks through the values of all others once.
    fn is_checked(&self) -> bool {
        false
    }

    /// Goes through all frames, in order.
    ///
    /// # Errors
    /// Where the values cannot be read (again).
    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), Self::Error>;
}

/// Channels held in memory, of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InMemorySamples {
    /// The values of each channel.
    pub channels: Vec<Vec<f64>>,
}

impl SampleSource for InMemorySamples {
    type Error = Infallible;

    fn frames(&self) -> u64 {
        longest(&self.channels) as u64
    }

    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), Infallible> {
        in_blocks(&self.channels, each);
        Ok(())
    }
}

/// The values of one channel in memory.
#[derive(Debug)]
pub(super) struct ChannelValues<'v>(pub(super) &'v [f64]);

impl SampleSource for ChannelValues<'_> {
    type Error = Infallible;

    fn frames(&self) -> u64 {
        self.0.len() as u64
    }

    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), Infallible> {
        for (number, block) in self.0.chunks(BLOCK).enumerate() {
            each((number * BLOCK) as u64, &[block]);
        }
        Ok(())
    }
}

/// Goes through channels in memory in blocks.
pub fn in_blocks(channels: &[Vec<f64>], each: &mut BlockVisitor<'_>) {
    let frames = longest(channels);
    for first in (0..frames).step_by(BLOCK) {
        let end = (first + BLOCK).min(frames);
        let part = |values: &Vec<f64>| first.min(values.len())..end.min(values.len());
        let block: Vec<&[f64]> = channels.iter().map(|values| &values[part(values)]).collect();
        each(first as u64, &block);
    }
}

/// Values of the longest channel.
fn longest(channels: &[Vec<f64>]) -> usize {
    channels.iter().map(Vec::len).max().unwrap_or(0)
}

impl InMemorySamples {
    /// The same where reading may fail elsewhere: one source for both.
    pub(super) fn unfailing<E>(&self) -> Unfailing<'_, E> {
        Unfailing { samples: self, error: PhantomData }
    }
}

/// Channels in memory among sources whose reading may fail.
#[derive(Debug)]
pub(super) struct Unfailing<'s, E> {
    samples: &'s InMemorySamples,
    error: PhantomData<E>,
}

impl<E> SampleSource for Unfailing<'_, E> {
    type Error = E;

    fn frames(&self) -> u64 {
        self.samples.frames()
    }

    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), E> {
        in_blocks(&self.samples.channels, each);
        Ok(())
    }
}

/// Some of the channels of a recording.
pub(super) struct Selected<'p, E> {
    pub(super) passes: &'p mut dyn SampleSource<Error = E>,
    /// Which channels, by their places.
    pub(super) columns: &'p [usize],
}

impl<E> SampleSource for Selected<'_, E> {
    type Error = E;

    fn frames(&self) -> u64 {
        self.passes.frames()
    }

    fn is_checked(&self) -> bool {
        self.passes.is_checked()
    }

    fn pass(&mut self, each: &mut BlockVisitor<'_>) -> Result<(), E> {
        let columns = self.columns;
        self.passes.pass(&mut |first, channels| {
            let chosen: Vec<&[f64]> =
                columns.iter().map(|at| channels.get(*at).copied().unwrap_or(&[])).collect();
            each(first, &chosen);
        })
    }
}

/// The values of some channels, in memory.
pub(super) fn gathered<E>(
    passes: &mut dyn SampleSource<Error = E>,
    columns: &[usize],
) -> Result<InMemorySamples, E> {
    let mut channels = vec![Vec::new(); columns.len()];
    Selected { passes, columns }.pass(&mut |_, values| {
        for (channel, values) in channels.iter_mut().zip(values) {
            channel.extend_from_slice(values);
        }
    })?;
    Ok(InMemorySamples { channels })
}
