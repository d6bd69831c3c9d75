//! The inner loops of the accumulation with AVX2 instructions: the compiler does not find that values are
//! moved together by a permutation, and splits sums over lanes. The same operations in the same order as
//! the plain loops, so the same bits.
#![cfg(target_arch = "x86_64")]
#![allow(unsafe_code)]

use std::arch::x86_64::{
    __m256d, __m256i, _CMP_GE_OQ, _CMP_LE_OQ, _CMP_LT_OQ, _mm256_add_pd, _mm256_and_pd,
    _mm256_castpd_ps, _mm256_castpd_si256, _mm256_castps_pd, _mm256_cmp_pd, _mm256_loadu_pd,
    _mm256_loadu_si256, _mm256_movemask_pd, _mm256_mul_pd, _mm256_or_pd, _mm256_permutevar8x32_ps,
    _mm256_set1_pd, _mm256_setzero_pd, _mm256_setzero_si256, _mm256_storeu_pd, _mm256_storeu_si256,
    _mm256_sub_epi64, _mm256_sub_pd,
};

use super::plan::{Chunks, LANES, Products, Reference, TOGETHER};
use super::windows::Windows;

/// Values in a register.
const WIDTH: usize = 4;

/// Registers of all lanes of a sum.
const REGISTERS: usize = LANES / WIDTH;

/// For each set of kept values (a bit each) their halves first, in order; the others do not matter.
const KEPT_FIRST: [[u32; 2 * WIDTH]; 1 << WIDTH] = {
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
        let order = unsafe { _mm256_loadu_si256(KEPT_FIRST[set].as_ptr().cast::<__m256i>()) };
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

/// For the powers 1 to 4 of the values' distances from the reference the sum in each lane.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx2")]
pub(super) fn powers(chunks: &[[f64; LANES]], reference: Reference) -> [[f64; LANES]; 4] {
    let middle = _mm256_set1_pd(reference.middle);
    let inverse = _mm256_set1_pd(1.0 / reference.scale);
    let mut sums: [[__m256d; 4]; REGISTERS] = [[_mm256_setzero_pd(); 4]; REGISTERS];
    for chunk in chunks {
        for (register, sums) in sums.iter_mut().enumerate() {
            // SAFETY: the chunk has as many values as the registers together.
            let value = unsafe { _mm256_loadu_pd(chunk.as_ptr().add(register * WIDTH)) };
            let d = _mm256_mul_pd(_mm256_sub_pd(value, middle), inverse);
            let d2 = _mm256_mul_pd(d, d);
            let terms = [d, d2, _mm256_mul_pd(d2, d), _mm256_mul_pd(d2, d2)];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum = _mm256_add_pd(*sum, term);
            }
        }
    }
    let mut lanes = [[0.0; LANES]; 4];
    for (register, sums) in sums.iter().enumerate() {
        for (lanes, sum) in lanes.iter_mut().zip(sums) {
            let to = lanes[register * WIDTH..].as_mut_ptr();
            // SAFETY: the lanes have as many places as the registers together.
            unsafe { _mm256_storeu_pd(to, *sum) };
        }
    }
    lanes
}

/// For each two outputs the sum of the products of their values in each lane.
///
/// # Safety
/// As [`keep`].
#[target_feature(enable = "avx2")]
pub(super) fn products(a: Chunks<'_>, b: Chunks<'_>) -> Products {
    let mut sums = [[[_mm256_setzero_pd(); REGISTERS]; TOGETHER]; TOGETHER];
    for (((a0, a1), b0), b1) in a[0].iter().zip(a[1]).zip(b[0]).zip(b[1]) {
        for (sums, a) in sums.iter_mut().zip([a0, a1]) {
            for (sums, b) in sums.iter_mut().zip([b0, b1]) {
                for (register, sum) in sums.iter_mut().enumerate() {
                    // SAFETY: a chunk has as many values as the registers together.
                    let [a, b] = unsafe {
                        [
                            _mm256_loadu_pd(a.as_ptr().add(register * WIDTH)),
                            _mm256_loadu_pd(b.as_ptr().add(register * WIDTH)),
                        ]
                    };
                    *sum = _mm256_add_pd(*sum, _mm256_mul_pd(a, b));
                }
            }
        }
    }
    let mut products = [[[0.0; LANES]; TOGETHER]; TOGETHER];
    for (products, sums) in products.iter_mut().zip(sums) {
        for (lanes, sums) in products.iter_mut().zip(sums) {
            for (to, sum) in lanes.chunks_exact_mut(WIDTH).zip(sums) {
                // SAFETY: the part has as many places as the register.
                unsafe { _mm256_storeu_pd(to.as_mut_ptr(), sum) };
            }
        }
    }
    products
}
