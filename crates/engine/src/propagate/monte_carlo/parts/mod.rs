//! One row's run cut into parts that are made anywhere and put together.
//!
//! A run is a few passes over the trials ([`super::run`], [`super::several_pass`]). What a pass counts
//! is a function of the passes before it, and each is a sum over chunks of the trials; so a pass can
//! be shared out, what its parts found is put together, and the next pass, or the answer, is made of
//! that. All decisions are those of a run on one machine, taken by the same functions, and so are the
//! figures, to the bit.

mod encoding;
mod written;

use std::collections::BTreeMap;
use std::ops::Range;

pub use encoding::Damaged;
pub(crate) use encoding::{ByteReader, Writer};

use super::accumulate::Accumulated;
use super::block::RowTrials;
use super::figures::Finished;
use super::passes::{Look, Pass, Stretch, kept_budget, stretch};
use super::pilot::{KEEP_ALL_MARGIN, plans};
use super::plan::Plan;
use super::quantiles::{QuantilePasses, are_held, quantile_plans};
use super::request::Request;
use super::run::{accumulate_chunks, chunks_of, finish, kept_bytes, scatters, sums_of};
use super::several_pass::Passes;
use super::shortest_scatter::ShortestScatter;
use super::totals::Totals;
use crate::propagate::Control;

/// A pass over the trials of a row: what is to be counted.
#[derive(Clone, Debug)]
pub(crate) struct RowPass {
    /// Number of trials of the run that it belongs to.
    pub(crate) trials: u64,
    /// How much wider than usual the windows are.
    margin: f64,
    /// How the shortest intervals scatter, where narrower windows told it already.
    scatters: Vec<Option<ShortestScatter>>,
    step: RowStep,
}

/// What a pass is for.
#[derive(Clone, Debug)]
enum RowStep {
    /// The figures of a run that holds its tails.
    Tails,
    /// The figures of one that counts in cells.
    Cells(Box<Passes>),
    /// The quantiles of a run whose figures are there.
    Quantiles(Box<Finished>, Box<QuantilePasses>),
}

/// What a pass gave in the end.
#[derive(Debug)]
pub(crate) enum RowOutcome {
    /// The figures, and the quantiles if they were looked for.
    Finished(Box<Finished>, Option<Vec<Vec<f64>>>),
    /// The next pass.
    Next(Box<RowPass>),
}

/// What a part of a pass found.
#[derive(Clone, Debug)]
pub(crate) struct RowPart(Made);

#[derive(Clone, Debug)]
enum Made {
    /// The chunks of a run that holds its tails.
    Tails(Vec<Accumulated>),
    /// Counts in cells.
    Cells(Box<Stretch>),
}

/// A pass, and what is known beforehand to each part of it.
#[derive(Debug)]
pub(crate) struct Prepared<'a> {
    trials: RowTrials,
    probability: f64,
    moment_order: Vec<f64>,
    control: Control<'a>,
    pass: RowPass,
    plans: Vec<Plan>,
}

impl RowPass {
    /// The first pass of a run.
    pub(crate) fn first(trials: &RowTrials, request: Request<'_>, control: &Control<'_>) -> Self {
        Self::with_margin(trials, request, control, 1.0, vec![None; trials.outputs()])
    }

    fn with_margin(
        trials: &RowTrials,
        request: Request<'_>,
        control: &Control<'_>,
        margin: f64,
        scatters: Vec<Option<ShortestScatter>>,
    ) -> Self {
        let plans = plans(trials, request, control, margin);
        let step = if kept_bytes(&plans, request) > control.memory {
            RowStep::Cells(Box::new(Passes::new(request, &plans)))
        } else {
            RowStep::Tails
        };
        Self { trials: request.trials, margin, scatters, step }
    }

    /// The pass as bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        out.number(self.trials);
        out.real(self.margin);
        for scatter in &self.scatters {
            out.option(scatter.as_ref(), |out, scatter| scatter.write(out));
        }
        match &self.step {
            RowStep::Tails => out.number(0),
            RowStep::Cells(passes) => {
                out.number(1);
                passes.write(out);
            }
            RowStep::Quantiles(finished, passes) => {
                out.number(2);
                finished.write(out);
                passes.write(out);
            }
        }
    }

    /// A pass over a row with so many outputs and varying inputs, with the scores of the quantiles
    /// that may be looked for.
    ///
    /// # Errors
    /// Bytes that are no such pass.
    pub(crate) fn read(
        from: &mut ByteReader<'_>,
        outputs: usize,
        inputs: usize,
        scores: usize,
    ) -> Result<Self, Damaged> {
        let trials = from.number()?;
        let margin = from.real()?;
        let usual = (1.0..=4.0 * KEEP_ALL_MARGIN).contains(&margin);
        Damaged::unless(usual && trials > 0, "windows that no run has")?;
        let scatters = (0..outputs).map(|_| from.option(ShortestScatter::read));
        let scatters = scatters.collect::<Result<_, _>>()?;
        let step = match from.at_most(2, "there is no such pass")? {
            0 => RowStep::Tails,
            1 => RowStep::Cells(Box::new(Passes::read(from, outputs, trials)?)),
            _ => {
                let finished = Finished::read(from, outputs, inputs)?;
                let passes = QuantilePasses::read(from, outputs, scores)?;
                RowStep::Quantiles(Box::new(finished), Box::new(passes))
            }
        };
        Ok(Self { trials, margin, scatters, step })
    }
}

impl<'a> Prepared<'a> {
    /// Of a row's run with this coverage; `moment_order` as in [`Request`].
    pub(crate) fn new(
        trials: RowTrials,
        probability: f64,
        moment_order: Vec<f64>,
        control: Control<'a>,
        pass: RowPass,
    ) -> Self {
        let request = Request { trials: pass.trials, probability, moment_order: &moment_order };
        let plans = plans(&trials, request, &control, pass.margin);
        Self { trials, probability, moment_order, control, pass, plans }
    }

    fn request(&self) -> Request<'_> {
        let (trials, probability) = (self.pass.trials, self.probability);
        Request { trials, probability, moment_order: &self.moment_order }
    }

    /// What a pass in cells looks at.
    fn look(&self) -> Option<Look<'_>> {
        match &self.pass.step {
            RowStep::Tails => None,
            RowStep::Cells(passes) => Some(passes.look(self.request(), &self.plans)),
            RowStep::Quantiles(_, passes) => Some(passes.look(self.pass.trials, &self.plans)),
        }
    }

    /// How many chunks the pass has.
    pub(crate) fn chunks(&self) -> u64 {
        self.look().map_or_else(|| chunks_of(self.pass.trials), |look| look.chunks())
    }

    /// Makes some of the chunks; `None` if the run was stopped.
    pub(crate) fn part(&self, chunks: Range<u64>) -> Option<RowPart> {
        let Self { trials, control, plans, .. } = self;
        let part = match self.look() {
            Some(look) => Made::Cells(Box::new(stretch(trials, look, chunks, control))),
            None => {
                let (chunks, count) =
                    (chunks.start as usize..chunks.end as usize, self.pass.trials);
                Made::Tails(accumulate_chunks(trials, count, chunks, plans, control))
            }
        };
        (!control.is_stopped()).then_some(RowPart(part))
    }

    /// A part as bytes.
    pub(crate) fn write(&self, part: &RowPart, out: &mut Writer) {
        match (&part.0, self.look()) {
            (Made::Tails(chunks), _) => chunks.iter().for_each(|chunk| chunk.write(out)),
            (Made::Cells(found), Some(look)) => found.write(&look, out),
            // a part of another pass
            (Made::Cells(_), None) => {}
        }
    }

    /// The part of some chunks.
    ///
    /// # Errors
    /// Bytes that are no such part.
    pub(crate) fn read(
        &self,
        from: &mut ByteReader<'_>,
        chunks: Range<u64>,
    ) -> Result<RowPart, Damaged> {
        let chunk = |number| Accumulated::read(from, &self.plans, number, self.pass.trials);
        Ok(RowPart(match self.look() {
            None => Made::Tails(chunks.map(chunk).collect::<Result<_, _>>()?),
            Some(look) => Made::Cells(Box::new(Stretch::read(from, &look, &chunks)?)),
        }))
    }

    /// Nothing put together yet.
    pub(crate) fn gather(&self) -> Gathered {
        Gathered(match self.look() {
            None => Together::Tails(BTreeMap::new()),
            Some(look) => Together::Cells(Box::new(Pass::empty(look))),
        })
    }

    /// The figures, or the next pass. Quantiles are at these scores.
    pub(crate) fn finish(&mut self, gathered: Gathered, scores: &[f64]) -> RowOutcome {
        let Self { trials, probability, moment_order, control, pass, plans } = self;
        let request = Request { trials: pass.trials, probability: *probability, moment_order };
        let budget = kept_budget(plans, control);
        let next =
            |pass: &RowPass, step| RowOutcome::Next(Box::new(RowPass { step, ..pass.clone() }));
        match (gathered.0, std::mem::replace(&mut pass.step, RowStep::Tails)) {
            (Together::Cells(mut made), RowStep::Cells(mut passes)) => {
                made.totals.close();
                if !passes.take(*made, request, plans, budget) {
                    return next(pass, RowStep::Cells(passes));
                }
                let scatters = scatters(trials, request, control, plans);
                let finished = passes.finish(trials, request, control, plans, &scatters);
                RowOutcome::Finished(Box::new(finished.unwrap_or_default()), None)
            }
            (Together::Cells(made), RowStep::Quantiles(finished, mut passes)) => {
                if !passes.take(*made, scores, plans, budget) {
                    return next(pass, RowStep::Quantiles(finished, passes));
                }
                RowOutcome::Finished(finished, passes.quantiles())
            }
            (Together::Tails(parts), _) => {
                let mut chunks: Vec<Accumulated> = parts.into_values().flatten().collect();
                let mut totals = Totals::new(chunks.len() as u64);
                for (number, chunk) in (0..).zip(&mut chunks) {
                    totals.take_chunk(number, sums_of(chunk));
                }
                totals.close();
                let scatters = &mut pass.scatters;
                match finish(trials, request, control, plans, chunks, &totals, scatters) {
                    Some(finished) => RowOutcome::Finished(Box::new(finished), None),
                    // a tail came out short: wider windows
                    None => {
                        let (margin, scatters) = (4.0 * pass.margin, pass.scatters.clone());
                        let wider =
                            RowPass::with_margin(trials, request, control, margin, scatters);
                        RowOutcome::Next(Box::new(wider))
                    }
                }
            }
            // there are no parts of another pass among these
            (Together::Cells(_), RowStep::Tails) => RowOutcome::Finished(Box::default(), None),
        }
    }

    /// The passes for the quantiles of all trials, where these are not held to take them.
    pub(crate) fn quantiles(&self, finished: &Finished) -> Option<RowPass> {
        let Self { trials, control, pass, .. } = self;
        let count = pass.trials;
        if finished.trials == 0 || are_held(count, trials.outputs(), control.memory) {
            return None;
        }
        let passes = QuantilePasses::new(&quantile_plans(trials, count, control));
        let step = RowStep::Quantiles(Box::new(finished.clone()), Box::new(passes));
        Some(RowPass { step, ..pass.clone() })
    }

    /// The trials.
    pub(crate) fn trials(&self) -> &RowTrials {
        &self.trials
    }

    /// The fewest degrees of freedom of the t distributions that each output depends on.
    pub(crate) fn moment_order(&self) -> &[f64] {
        &self.moment_order
    }
}

/// What the parts of a pass found, put together as they come.
#[derive(Debug)]
pub(crate) struct Gathered(Together);

#[derive(Debug)]
enum Together {
    /// By the number of its first chunk each part.
    Tails(BTreeMap<u64, Vec<Accumulated>>),
    Cells(Box<Pass>),
}

impl Gathered {
    /// Puts in the part that begins with a chunk.
    pub(crate) fn add(&mut self, first: u64, part: RowPart) {
        match (&mut self.0, part.0) {
            (Together::Tails(parts), Made::Tails(chunks)) => {
                // an empty one may begin where the next one does
                parts.entry(first).or_default().extend(chunks);
            }
            (Together::Cells(pass), Made::Cells(found)) => pass.take(*found),
            // parts are read as those of this pass
            _ => {}
        }
    }
}

/// The chunks that belong to some of `of` places, where all chunks are spread evenly over these: a
/// part makes those that begin in its range.
pub(crate) fn share(range: &Range<u64>, of: u64, chunks: u64) -> Range<u64> {
    let first = |place: u64| {
        let product = u128::from(place.min(of)) * u128::from(chunks);
        product.div_ceil(u128::from(of.max(1))) as u64
    };
    first(range.start)..first(range.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every chunk belongs to one range, however the places are cut, also where there are more places
    /// than chunks, or more chunks than places.
    #[test]
    fn every_chunk_belongs_to_one_range() {
        for (of, chunks) in [(977, 32), (1, 1), (5, 100), (100, 5), (976_563, 15_259)] {
            for step in [1, 3, 7, 300, 1_000_000] {
                let mut next = 0;
                for start in (0..of).step_by(step) {
                    let own = share(&(start..(start + step as u64).min(of)), of, chunks);
                    assert_eq!(own.start, next);
                    next = own.end;
                }
                assert_eq!(next, chunks, "{of} {chunks} {step}");
            }
        }
        let huge = share(&(0..u64::MAX), u64::MAX, 1 << 60);
        assert_eq!(huge, 0..1 << 60);
    }
}
