//! How the figures settle with the number of trials, for pictures. As with [`Histogram`] the first
//! trials are made again by runs of their own, so that a run without a picture costs nothing, and the
//! figures of one with it are the same bits.
//!
//! [`Histogram`]: super::Histogram

use super::block::RowTrials;
use super::figures::MonteCarlo;
use super::request::Request;
use super::run::run;
use crate::propagate::Control;

/// The fewest trials that are looked at: of fewer the ends of most intervals are the extremes.
const FIRST: u64 = 1000;

/// The most: they settle with the root of their number, and more take time.
const LAST: u64 = 10_000_000;

/// The numbers of trials that are looked at of so many in all: 1, 2 and 5 times powers of ten.
fn stages(count: u64) -> impl Iterator<Item = u64> {
    let decades = (0..).map_while(|power| FIRST.checked_mul(10_u64.checked_pow(power)?));
    let all = decades.flat_map(|decade| [1, 2, 5].map(|digit| decade.saturating_mul(digit)));
    // the run itself is the last one
    all.take_while(move |stage| *stage < count && *stage <= LAST)
}

/// For each output the figures of the first 1000, 2000, 5000, ... trials of `request`, without those of
/// all of them. `None` if the run is stopped.
pub(crate) fn settling(
    trials: &mut RowTrials,
    request: Request<'_>,
    control: &Control<'_>,
) -> Option<Vec<Vec<MonteCarlo>>> {
    let mut outputs = vec![Vec::new(); trials.outputs()];
    let quiet = Control { progress: None, ..*control };
    for stage in stages(request.trials) {
        let finished = run(trials, Request { trials: stage, ..request }, &quiet);
        if finished.stopped {
            return None;
        }
        // none where every trial so far is undefined
        for (output, figures) in outputs.iter_mut().zip(finished.outputs) {
            output.push(figures);
        }
    }
    Some(outputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_round_and_end_before_the_run() {
        let of = |count| stages(count).collect::<Vec<u64>>();
        assert_eq!(of(1000), [0; 0]);
        assert_eq!(of(20_000), [1000, 2000, 5000, 10_000]);
        assert_eq!(of(u64::MAX).last(), Some(&LAST));
        // all of them together take less time than the run, or little in any case
        for count in [3000, 100_000, 1_000_000, 9_999_999] {
            assert!(of(count).iter().sum::<u64>() <= 2 * count);
        }
        assert!(of(u64::MAX).iter().sum::<u64>() < 2 * LAST);
    }
}
