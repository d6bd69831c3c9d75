//! The filter of the accumulation with AVX2 instructions: the compiler does not find that values are
//! moved together by a permutation. The same values in the same order as in the plain loop.
#![cfg(target_arch = "x86_64")]
#![allow(unsafe_code)]

use std::arch::x86_64::{
    __m256i, _CMP_GE_OQ, _CMP_LE_OQ, _CMP_LT_OQ, _mm256_and_pd, _mm256_castpd_ps,
    _mm256_castpd_si256, _mm256_castps_pd, _mm256_cmp_pd, _mm256_loadu_pd, _mm256_loadu_si256,
    _mm256_movemask_pd, _mm256_or_pd, _mm256_permutevar8x32_ps, _mm256_set1_pd,
    _mm256_setzero_si256, _mm256_storeu_pd, _mm256_storeu_si256, _mm256_sub_epi64,
};

use super::windows::Windows;

/// Values in a register.
const WIDTH: usize = 4;

/// For each set of kept values (a bit each) their halves first, in order; the others do not matter.
const TOGETHER: [[u32; 2 * WIDTH]; 1 << WIDTH] = {
    let mut together = [[0; 2 * WIDTH]; 1 << WIDTH];
    let mut set = 0;
    while set < together.len() {
        let (mut value, mut place) = (0, 0);
        while value < WIDTH {
            if set & (1 << value) != 0 {
                together[set][place] = 2 * value as u32;
                together[set][place + 1] = 2 * value as u32 + 1;
                place += 2;
            }
            value += 1;
        }
        set += 1;
    }
    together
};

/// The number of values of each set.
const COUNTS: [usize; 1 << WIDTH] = {
    let mut counts = [0; 1 << WIDTH];
    let mut set = 0;
    while set < counts.len() {
        counts[set] = set.count_ones() as usize;
        set += 1;
    }
    counts
};

/// Appends the values that the windows keep; returns how many lie below the window about the median.
///
/// # Safety
/// The machine has AVX2.
#[target_feature(enable = "avx2")]
pub(super) fn keep(block: &[f64], windows: &Windows, kept: &mut Vec<f64>) -> u64 {
    kept.reserve(block.len() + WIDTH);
    let low = _mm256_set1_pd(windows.low);
    let median = [_mm256_set1_pd(windows.median_low), _mm256_set1_pd(windows.median_high)];
    let high = _mm256_set1_pd(windows.high);
    let mut below = _mm256_setzero_si256();
    let out = kept.as_mut_ptr();
    let mut length = kept.len();
    let (chunks, rest) = block.as_chunks::<WIDTH>();
    for chunk in chunks {
        // SAFETY: the chunk has four values.
        let value = unsafe { _mm256_loadu_pd(chunk.as_ptr()) };
        let in_low = _mm256_cmp_pd::<_CMP_LE_OQ>(value, low);
        let from_median = _mm256_cmp_pd::<_CMP_GE_OQ>(value, median[0]);
        let in_median = _mm256_and_pd(from_median, _mm256_cmp_pd::<_CMP_LE_OQ>(value, median[1]));
        let in_high = _mm256_cmp_pd::<_CMP_GE_OQ>(value, high);
        let under = _mm256_cmp_pd::<_CMP_LT_OQ>(value, median[0]);
        // a lane of ones is minus one
        below = _mm256_sub_epi64(below, _mm256_castpd_si256(under));
        let keep = _mm256_or_pd(_mm256_or_pd(in_low, in_median), in_high);
        let set = _mm256_movemask_pd(keep) as usize;
        // SAFETY: eight indices stand there.
        let order = unsafe { _mm256_loadu_si256(TOGETHER[set].as_ptr().cast::<__m256i>()) };
        let together = _mm256_permutevar8x32_ps(_mm256_castpd_ps(value), order);
        // SAFETY: the room for a whole block and four more was reserved, and at most a block's values
        // are kept, so that four from `length` on are within the capacity.
        unsafe { _mm256_storeu_pd(out.add(length), _mm256_castps_pd(together)) };
        length += COUNTS[set];
    }
    // SAFETY: the values up to `length` were written above.
    unsafe { kept.set_len(length) };
    kept.extend(rest.iter().filter(|value| windows.keeps(**value)));
    let mut lanes = [0u64; WIDTH];
    // SAFETY: there are four lanes.
    unsafe { _mm256_storeu_si256(lanes.as_mut_ptr().cast::<__m256i>(), below) };
    let of_rest = rest.iter().filter(|value| **value < windows.median_low).count() as u64;
    lanes.iter().sum::<u64>() + of_rest
}
