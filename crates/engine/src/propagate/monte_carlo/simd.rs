//! The inner loops of the accumulation with AVX-512 instructions: the compiler does not find compression, and
//! splits sums over lanes. The same operations in the same order as the plain loops, so the same bits.
#![cfg(target_arch = "x86_64")]
#![allow(unsafe_code)]

use std::arch::x86_64::{
    __mmask8, _CMP_GE_OQ, _CMP_LE_OQ, _CMP_LT_OQ, _mm512_add_pd, _mm512_cmp_pd_mask,
    _mm512_loadu_pd, _mm512_maskz_compress_pd, _mm512_maskz_loadu_pd, _mm512_maskz_sub_pd,
    _mm512_mul_pd, _mm512_set1_pd, _mm512_setzero_pd, _mm512_storeu_pd,
};

use super::plan::{LANES, Reference};
use super::windows::Windows;

/// The lanes of a chunk that hold a value.
fn lanes_of(chunk: &[f64]) -> __mmask8 {
    if chunk.len() == LANES { __mmask8::MAX } else { (1 << chunk.len()) - 1 }
}

/// Appends the values that the windows keep; returns how many lie below the window about the median.
///
/// # Safety
/// The machine has AVX-512 F, DQ, VL and BW, and POPCNT.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,popcnt")]
pub(super) fn keep(block: &[f64], windows: &Windows, kept: &mut Vec<f64>) -> u64 {
    kept.reserve(block.len() + LANES);
    let low = _mm512_set1_pd(windows.low);
    let median = [_mm512_set1_pd(windows.median_low), _mm512_set1_pd(windows.median_high)];
    let high = _mm512_set1_pd(windows.high);
    let mut below = 0;
    let mut length = kept.len();
    for chunk in block.chunks(LANES) {
        let lanes = lanes_of(chunk);
        // SAFETY: only lanes within the chunk are read.
        let value = unsafe { _mm512_maskz_loadu_pd(lanes, chunk.as_ptr()) };
        let in_low = _mm512_cmp_pd_mask::<_CMP_LE_OQ>(value, low);
        let in_median = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(value, median[0])
            & _mm512_cmp_pd_mask::<_CMP_LE_OQ>(value, median[1]);
        let in_high = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(value, high);
        let under = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(value, median[0]) & lanes;
        below += u64::from(under.count_ones());
        let keep = (in_low | in_median | in_high) & lanes;
        // SAFETY: the room for a whole block and eight more was reserved, and at most a block's
        // values are kept, so that eight from `length` on are within the capacity.
        unsafe {
            _mm512_storeu_pd(kept.as_mut_ptr().add(length), _mm512_maskz_compress_pd(keep, value));
        }
        length += keep.count_ones() as usize;
    }
    // SAFETY: the values up to `length` were written above.
    unsafe { kept.set_len(length) };
    below
}

/// For the powers 1 to 4 of the values' distances from the reference the sum in each lane.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,popcnt")]
pub(super) fn powers(values: &[f64], reference: Reference) -> [[f64; LANES]; 4] {
    let middle = _mm512_set1_pd(reference.middle);
    let inverse = _mm512_set1_pd(1.0 / reference.scale);
    let mut sums = [_mm512_setzero_pd(); 4];
    for chunk in values.chunks(LANES) {
        let d = if chunk.len() == LANES {
            // SAFETY: the chunk has eight values.
            let value = unsafe { _mm512_loadu_pd(chunk.as_ptr()) };
            _mm512_maskz_sub_pd(__mmask8::MAX, value, middle)
        } else {
            // SAFETY: only lanes within the chunk are read; the others add nothing.
            let value = unsafe { _mm512_maskz_loadu_pd(lanes_of(chunk), chunk.as_ptr()) };
            _mm512_maskz_sub_pd(lanes_of(chunk), value, middle)
        };
        let d = _mm512_mul_pd(d, inverse);
        let d2 = _mm512_mul_pd(d, d);
        let terms = [d, d2, _mm512_mul_pd(d2, d), _mm512_mul_pd(d2, d2)];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum = _mm512_add_pd(*sum, term);
        }
    }
    // no closures: they would not be compiled for these instructions
    let mut lanes = [[0.0; LANES]; 4];
    for (lanes, sum) in lanes.iter_mut().zip(sums) {
        // SAFETY: there are eight lanes.
        unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), sum) };
    }
    lanes
}
