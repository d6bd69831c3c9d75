//! Sums in lanes: a fixed order of additions that suits vectors of any width.

/// Number of lanes in sums, and of values compared at a time in searches.
pub(super) const LANES: usize = 16;

/// Calls `add` with the index of each of `count` values and its lane.
#[inline(always)]
pub(super) fn in_lanes(count: usize, mut add: impl FnMut(usize, usize)) {
    let whole = count / LANES * LANES;
    for first in (0..whole).step_by(LANES) {
        for lane in 0..LANES {
            add(first + lane, lane);
        }
    }
    for (lane, place) in (whole..count).enumerate() {
        add(place, lane);
    }
}

/// Sums of deviations from a reference and of their squares, with further values added.
#[inline(always)]
pub(super) fn with_deviations(
    [mut sums, mut squares]: [[f64; LANES]; 2],
    values: &[f64],
    reference: f64,
) -> [[f64; LANES]; 2] {
    let mut add = |lane: usize, value: f64| {
        let d = value - reference;
        sums[lane] += d;
        squares[lane] += d * d;
    };
    let (whole, rest) = values.as_chunks::<LANES>();
    for chunk in whole {
        for (lane, &value) in chunk.iter().enumerate() {
            add(lane, value);
        }
    }
    for (lane, &value) in rest.iter().enumerate() {
        add(lane, value);
    }
    [sums, squares]
}
