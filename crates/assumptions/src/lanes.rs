//! Sums in lanes: a fixed order of additions that vectors of any width can follow.

/// Sums are taken in so many lanes, and values sought among so many at a time.
pub(super) const LANES: usize = 16;

/// Calls `add` with the place of each of so many values and the lane that it belongs to.
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

/// Sums of deviations from a reference and of their squares, with those of more values.
#[inline(always)]
pub(super) fn with_deviations(
    [mut sums, mut squares]: [[f64; LANES]; 2],
    values: &[f64],
    reference: f64,
) -> [[f64; LANES]; 2] {
    in_lanes(values.len(), |place, lane| {
        let d = values[place] - reference;
        sums[lane] += d;
        squares[lane] += d * d;
    });
    [sums, squares]
}
