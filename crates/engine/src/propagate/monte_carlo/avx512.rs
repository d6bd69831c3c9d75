//! The inner loops of the accumulation with AVX-512 instructions: the compiler does not find compression, and
//! splits sums over lanes. The same operations in the same order as the plain loops, so the same bits.
#![cfg(target_arch = "x86_64")]
#![allow(unsafe_code)]

use std::arch::x86_64::{
    __m128i, __mmask8, _CMP_GE_OQ, _CMP_GT_OQ, _CMP_LE_OQ, _CMP_LT_OQ, _mm_storeu_si128,
    _mm512_add_pd, _mm512_castpd_si512, _mm512_cmp_pd_mask, _mm512_cvtepi64_epi16, _mm512_loadu_pd,
    _mm512_mask_blend_pd, _mm512_maskz_compress_pd, _mm512_maskz_loadu_pd, _mm512_max_pd,
    _mm512_min_pd, _mm512_mul_pd, _mm512_set1_pd, _mm512_setzero_pd, _mm512_storeu_pd,
    _mm512_sub_pd,
};

use super::bucket_partition::{BucketLayout, ROUND};
use super::plan::{Chunks, LANES, Products, Reference, TOGETHER};
use super::windows::Windows;

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
    let start = kept.len();
    let out = kept.as_mut_ptr();
    let mut length = start;
    let whole = block.len() / LANES * LANES;
    let mut first = 0;
    while first < block.len() {
        let lanes = if first < whole { __mmask8::MAX } else { (1 << (block.len() - whole)) - 1 };
        let value = if first < whole {
            // SAFETY: eight values from `first` on are within the block.
            unsafe { _mm512_loadu_pd(block.as_ptr().add(first)) }
        } else {
            // SAFETY: only lanes within the block are read.
            unsafe { _mm512_maskz_loadu_pd(lanes, block.as_ptr().add(first)) }
        };
        let in_low = _mm512_cmp_pd_mask::<_CMP_LE_OQ>(value, low);
        let in_median = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(value, median[0])
            & _mm512_cmp_pd_mask::<_CMP_LE_OQ>(value, median[1]);
        let in_high = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(value, high);
        let under = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(value, median[0]) & lanes;
        below += under.count_ones();
        let keep = (in_low | in_median | in_high) & lanes;
        // SAFETY: the room for a whole block and eight more was reserved, and at most a block's
        // values are kept, so that eight from `length` on are within the capacity.
        unsafe {
            _mm512_storeu_pd(out.add(length), _mm512_maskz_compress_pd(keep, value));
        }
        length += keep.count_ones() as usize;
        first += LANES;
    }
    // SAFETY: the values up to `length` were written above.
    unsafe { kept.set_len(length) };
    u64::from(below)
}

/// The bucket of each value, as many as there is room for.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,popcnt")]
pub(super) fn buckets(layout: &BucketLayout, values: &[f64], out: &mut [u16]) {
    let [tail_low, median, tail_high] = layout.regions;
    let (low, high) = (_mm512_set1_pd(layout.low), _mm512_set1_pd(layout.high));
    let (zero, round) = (_mm512_setzero_pd(), _mm512_set1_pd(ROUND));
    // of the three regions: where they begin, buckets to a unit, the last bucket, the first
    let from = [
        _mm512_set1_pd(tail_low.from),
        _mm512_set1_pd(median.from),
        _mm512_set1_pd(tail_high.from),
    ];
    let inverse = [
        _mm512_set1_pd(tail_low.inverse),
        _mm512_set1_pd(median.inverse),
        _mm512_set1_pd(tail_high.inverse),
    ];
    let more = [
        _mm512_set1_pd(tail_low.more),
        _mm512_set1_pd(median.more),
        _mm512_set1_pd(tail_high.more),
    ];
    let first = [
        _mm512_set1_pd(tail_low.first),
        _mm512_set1_pd(median.first),
        _mm512_set1_pd(tail_high.first),
    ];
    let (chunks, rest) = values.as_chunks::<LANES>();
    let (outs, last) = out.as_chunks_mut::<LANES>();
    for (chunk, out) in chunks.iter().zip(outs) {
        // SAFETY: the chunk has eight values.
        let value = unsafe { _mm512_loadu_pd(chunk.as_ptr()) };
        let in_low = _mm512_cmp_pd_mask::<_CMP_LE_OQ>(value, low);
        let in_median = _mm512_cmp_pd_mask::<_CMP_GT_OQ>(value, low)
            & _mm512_cmp_pd_mask::<_CMP_LT_OQ>(value, high);
        let start = _mm512_mask_blend_pd(in_low, from[2], from[0]);
        let start = _mm512_mask_blend_pd(in_median, start, from[1]);
        let by = _mm512_mask_blend_pd(in_low, inverse[2], inverse[0]);
        let by = _mm512_mask_blend_pd(in_median, by, inverse[1]);
        let most = _mm512_mask_blend_pd(in_low, more[2], more[0]);
        let most = _mm512_mask_blend_pd(in_median, most, more[1]);
        let begin = _mm512_mask_blend_pd(in_low, first[2], first[0]);
        let begin = _mm512_mask_blend_pd(in_median, begin, first[1]);
        // what is no number comes first, as in the plain loops
        let index = _mm512_max_pd(_mm512_mul_pd(_mm512_sub_pd(value, start), by), zero);
        let index = _mm512_min_pd(index, most);
        let place = _mm512_add_pd(_mm512_add_pd(index, begin), round);
        let place = _mm512_cvtepi64_epi16(_mm512_castpd_si512(place));
        // SAFETY: there is room for eight places of two bytes.
        unsafe { _mm_storeu_si128(out.as_mut_ptr().cast::<__m128i>(), place) };
    }
    for (value, out) in rest.iter().zip(last) {
        *out = layout.bucket(*value);
    }
}

/// For the powers 1 to 4 of the values' distances from the reference the sum in each lane.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,popcnt")]
pub(super) fn powers(chunks: &[[f64; LANES]], reference: Reference) -> [[f64; LANES]; 4] {
    let middle = _mm512_set1_pd(reference.middle);
    let inverse = _mm512_set1_pd(1.0 / reference.scale);
    let mut sums = [_mm512_setzero_pd(); 4];
    for chunk in chunks {
        // SAFETY: the chunk has eight values.
        let value = unsafe { _mm512_loadu_pd(chunk.as_ptr()) };
        let d = _mm512_mul_pd(_mm512_sub_pd(value, middle), inverse);
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

/// For each two outputs the sum of the products of their values in each lane.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,popcnt")]
pub(super) fn products(a: Chunks<'_>, b: Chunks<'_>) -> Products {
    let mut sums = [[_mm512_setzero_pd(); TOGETHER]; TOGETHER];
    for (((a0, a1), b0), b1) in a[0].iter().zip(a[1]).zip(b[0]).zip(b[1]) {
        for (sums, a) in sums.iter_mut().zip([a0, a1]) {
            // SAFETY: a chunk has eight values.
            let a = unsafe { _mm512_loadu_pd(a.as_ptr()) };
            for (sum, b) in sums.iter_mut().zip([b0, b1]) {
                // SAFETY: as above.
                let b = unsafe { _mm512_loadu_pd(b.as_ptr()) };
                *sum = _mm512_add_pd(*sum, _mm512_mul_pd(a, b));
            }
        }
    }
    let mut products = [[[0.0; LANES]; TOGETHER]; TOGETHER];
    for (products, sums) in products.iter_mut().zip(sums) {
        for (lanes, sum) in products.iter_mut().zip(sums) {
            // SAFETY: there are eight lanes.
            unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), sum) };
        }
    }
    products
}
