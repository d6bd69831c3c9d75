//! The generator's lanes in the machine's vector registers, because the compiler would split them
//! otherwise. Integer arithmetic, so the bits are the same as in plain loops.
#![cfg(target_arch = "x86_64")]
#![allow(unsafe_code)]

use std::arch::x86_64::{
    __m256i, __m512i, _mm256_add_epi64, _mm256_castsi256_pd, _mm256_loadu_si256, _mm256_or_si256,
    _mm256_set1_epi64x, _mm256_set1_pd, _mm256_setzero_si256, _mm256_slli_epi64, _mm256_srli_epi64,
    _mm256_storeu_pd, _mm256_storeu_si256, _mm256_sub_pd, _mm256_xor_si256, _mm512_add_epi64,
    _mm512_castsi512_pd, _mm512_loadu_si512, _mm512_or_si512, _mm512_rol_epi64, _mm512_set1_epi64,
    _mm512_set1_pd, _mm512_setzero_si512, _mm512_slli_epi64, _mm512_srli_epi64, _mm512_storeu_pd,
    _mm512_storeu_si512, _mm512_sub_pd, _mm512_xor_si512,
};

use super::{LANES, ONE, SHIFT};

/// Lanes in a 256-bit register.
const HALF: usize = LANES / 2;

/// Fills `out`, whose length is a multiple of eight, with uniform numbers.
///
/// # Safety
/// The machine has AVX-512 F, DQ, VL and BW.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
pub(super) fn fill_avx512(state: &mut [[u64; LANES]; 4], out: &mut [f64]) {
    // no closures: they would not be compiled for these instructions
    let mut words = [_mm512_setzero_si512(); 4];
    for (register, word) in words.iter_mut().zip(state.iter()) {
        // SAFETY: every word of the state has eight lanes.
        *register = unsafe { _mm512_loadu_si512(word.as_ptr().cast::<__m512i>()) };
    }
    let [mut s0, mut s1, mut s2, mut s3] = words;
    let one = _mm512_set1_epi64(ONE as i64);
    let shift = _mm512_set1_pd(SHIFT);
    for chunk in out.chunks_exact_mut(LANES) {
        let sum = _mm512_add_epi64(s0, s3);
        let bits = _mm512_add_epi64(_mm512_rol_epi64::<23>(sum), s0);
        let t = _mm512_slli_epi64::<17>(s1);
        s2 = _mm512_xor_si512(s2, s0);
        s3 = _mm512_xor_si512(s3, s1);
        s1 = _mm512_xor_si512(s1, s2);
        s0 = _mm512_xor_si512(s0, s3);
        s2 = _mm512_xor_si512(s2, t);
        s3 = _mm512_rol_epi64::<45>(s3);
        let mantissa = _mm512_or_si512(_mm512_srli_epi64::<12>(bits), one);
        let value = _mm512_sub_pd(_mm512_castsi512_pd(mantissa), shift);
        // SAFETY: the chunk has eight numbers.
        unsafe { _mm512_storeu_pd(chunk.as_mut_ptr(), value) };
    }
    for (word, lanes) in state.iter_mut().zip([s0, s1, s2, s3]) {
        // SAFETY: every word of the state has eight lanes.
        unsafe { _mm512_storeu_si512(word.as_mut_ptr().cast::<__m512i>(), lanes) };
    }
}

/// The same four lanes at a time.
///
/// # Safety
/// The machine has AVX2.
#[target_feature(enable = "avx2")]
pub(super) fn fill_avx2(state: &mut [[u64; LANES]; 4], out: &mut [f64]) {
    for first in [0, HALF] {
        let mut words = [_mm256_setzero_si256(); 4];
        for (register, word) in words.iter_mut().zip(state.iter()) {
            // SAFETY: four lanes from 0 or 4 on are within the eight of a word.
            *register = unsafe { _mm256_loadu_si256(word.as_ptr().add(first).cast::<__m256i>()) };
        }
        let [mut s0, mut s1, mut s2, mut s3] = words;
        let one = _mm256_set1_epi64x(ONE as i64);
        let shift = _mm256_set1_pd(SHIFT);
        for chunk in out.chunks_exact_mut(LANES) {
            let sum = _mm256_add_epi64(s0, s3);
            let turned =
                _mm256_or_si256(_mm256_slli_epi64::<23>(sum), _mm256_srli_epi64::<41>(sum));
            let bits = _mm256_add_epi64(turned, s0);
            let t = _mm256_slli_epi64::<17>(s1);
            s2 = _mm256_xor_si256(s2, s0);
            s3 = _mm256_xor_si256(s3, s1);
            s1 = _mm256_xor_si256(s1, s2);
            s0 = _mm256_xor_si256(s0, s3);
            s2 = _mm256_xor_si256(s2, t);
            s3 = _mm256_or_si256(_mm256_slli_epi64::<45>(s3), _mm256_srli_epi64::<19>(s3));
            let mantissa = _mm256_or_si256(_mm256_srli_epi64::<12>(bits), one);
            let value = _mm256_sub_pd(_mm256_castsi256_pd(mantissa), shift);
            // SAFETY: the chunk has eight numbers, four from 0 or 4 on.
            unsafe { _mm256_storeu_pd(chunk.as_mut_ptr().add(first), value) };
        }
        for (word, lanes) in state.iter_mut().zip([s0, s1, s2, s3]) {
            // SAFETY: as for loading.
            unsafe { _mm256_storeu_si256(word.as_mut_ptr().add(first).cast::<__m256i>(), lanes) };
        }
    }
}
