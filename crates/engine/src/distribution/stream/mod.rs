//! Random streams by block.
//!
//! The state of block `b` of the stream of a named quantity under seed `s` is a hash of (s, name,
//! b), and the block's numbers follow from it. So any thread can compute any block, a block can be
//! computed again, and adding or reordering inputs does not change the draws of the others.
//!
//! The generator is xoshiro256++ (Blackman and Vigna, 2021) in eight lanes side by side; the
//! finalizer of splitmix64 (Steele, Lea, Flood, 2014) spreads the states. All of it is integer
//! arithmetic and therefore the same on every machine.

#![allow(unsafe_code)] // instructions of a path that the machine has

mod rng;
#[cfg(target_arch = "x86_64")]
mod simd;

pub use rng::StreamRng;

use crate::number::CodePath;
#[cfg(target_arch = "x86_64")]
use crate::number::Instructions;

/// Trials in a block: the granularity of random access. A multiple of a column's length.
pub const BLOCK: usize = 1024;

const LANES: usize = 8;

/// The bits of 1.0, whose mantissa is replaced by the generator's bits.
const ONE: u64 = 0x3ff0_0000_0000_0000;

/// 1 - 2^-53: moves the mantissa's [1, 2) to the middle of its cells on (0, 1).
const SHIFT: f64 = 0.999_999_999_999_999_9;

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The identity of a random stream: the seed of the run and the name of the quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamKey(u64);

impl StreamKey {
    /// The stream of a quantity of this name under a seed.
    pub fn new(seed: u64, name: &str) -> Self {
        Self(mix(seed.wrapping_add(GOLDEN) ^ mix(hash(name))))
    }

    /// The stream's numbers for one block.
    pub fn block(self, block: u64) -> Stream {
        self.block_on(CodePath::best(), block)
    }

    /// The same, computed on a code path.
    pub(crate) fn block_on(self, path: CodePath, block: u64) -> Stream {
        Stream::new(mix(self.0 ^ mix(block.wrapping_add(GOLDEN))), path)
    }
}

/// FNV-1a over the bytes of a name.
fn hash(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The finalizer of splitmix64: every bit of the input reaches every bit of the output.
#[inline(always)]
pub(crate) fn mix(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A running generator.
#[derive(Clone, Debug)]
pub struct Stream {
    state: [[u64; LANES]; 4],
    path: CodePath,
}

impl Stream {
    #[inline(always)]
    fn new(key: u64, path: CodePath) -> Self {
        let mut state = [[0; LANES]; 4];
        let mut counter = key;
        for word in &mut state {
            for lane in word {
                counter = counter.wrapping_add(GOLDEN);
                *lane = mix(counter);
            }
        }
        Self { state, path }
    }

    /// The code path that the numbers are computed on.
    pub(super) fn path(&self) -> CodePath {
        self.path
    }

    #[inline(always)]
    fn next(&mut self) -> [u64; LANES] {
        let [s0, s1, s2, s3] = &mut self.state;
        let mut out = [0; LANES];
        for i in 0..LANES {
            out[i] = s0[i].wrapping_add(s3[i]).rotate_left(23).wrapping_add(s0[i]);
            let t = s1[i] << 17;
            s2[i] ^= s0[i];
            s3[i] ^= s1[i];
            s1[i] ^= s2[i];
            s0[i] ^= s3[i];
            s2[i] ^= t;
            s3[i] = s3[i].rotate_left(45);
        }
        out
    }

    /// Fills `out` with numbers uniform on the open interval (0, 1): the odd multiples of 2^-53,
    /// so 0 and 1 never occur and u and 1 - u are equally likely. `N` is a multiple of eight.
    #[inline(always)]
    pub fn uniform<const N: usize>(&mut self, out: &mut [f64; N]) {
        self.fill(out);
    }

    /// As [`Stream::uniform`]. Called, not inlined: callers are compiled for each code path, and
    /// often draw in many places; a call costs nothing compared with a column of numbers.
    #[inline(never)]
    fn fill(&mut self, out: &mut [f64]) {
        #[cfg(target_arch = "x86_64")]
        match self.path.instructions() {
            // SAFETY: the machine has the instructions of a path.
            Instructions::Avx512 => return unsafe { simd::fill_avx512(&mut self.state, out) },
            // SAFETY: as above.
            Instructions::Avx2 => return unsafe { simd::fill_avx2(&mut self.state, out) },
            Instructions::Baseline => {}
        }
        for chunk in out.chunks_exact_mut(LANES) {
            let bits = self.next();
            for i in 0..LANES {
                chunk[i] = f64::from_bits((bits[i] >> 12) | ONE) - SHIFT;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draw(seed: u64, name: &str, block: u64) -> [f64; BLOCK] {
        let mut out = [0.0; BLOCK];
        StreamKey::new(seed, name).block(block).uniform(&mut out);
        out
    }

    #[test]
    fn uniforms_stay_inside_the_open_interval() {
        let half = 0.5 / (1u64 << 52) as f64;
        let shift = 1.0 - half;
        assert_eq!(shift, SHIFT);
        assert_eq!(f64::from_bits(ONE) - shift, half);
        assert_eq!(f64::from_bits(ONE | ((1 << 52) - 1)) - shift, 1.0 - half);
        for u in draw(1, "x", 0) {
            assert!(u > 0.0 && u < 1.0);
        }
    }

    #[test]
    fn a_block_is_a_function_of_seed_name_and_number() {
        assert_eq!(draw(1, "tilt", 7), draw(1, "tilt", 7));
        assert_ne!(draw(1, "tilt", 7), draw(1, "tilt", 8));
        assert_ne!(draw(1, "tilt", 7), draw(2, "tilt", 7));
        assert_ne!(draw(1, "tilt", 7), draw(1, "tilt/resolution", 7));
    }

    /// The lanes reproduce the reference code: its first outputs from the state 1, 2, 3, 4 are
    /// published with it (Blackman and Vigna, xoshiro256plusplus.c, and the tests of the crate
    /// `rand_xoshiro`).
    #[test]
    fn lanes_follow_the_reference_generator() {
        let mut stream = Stream {
            state: [[1; LANES], [2; LANES], [3; LANES], [4; LANES]],
            path: CodePath::BASELINE,
        };
        let reference: [u64; 5] = [
            41_943_041,
            58_720_359,
            3_588_806_011_781_223,
            3_591_011_842_654_386,
            9_228_616_714_210_784_205,
        ];
        for expected in reference {
            assert_eq!(stream.next(), [expected; LANES]);
        }
    }

    #[test]
    fn paths_give_the_same_numbers() {
        let on = |path: CodePath| {
            let mut stream = StreamKey::new(7, "x").block_on(path, 3);
            let (mut first, mut second) = ([0.0; 64], [0.0; 128]);
            stream.uniform(&mut first);
            stream.uniform(&mut second);
            [&first[..], &second[..]].concat()
        };
        let baseline = on(CodePath::BASELINE);
        for path in CodePath::available() {
            assert_eq!(on(path), baseline, "{path:?}");
        }
    }

    /// Neighbouring blocks, seeds and names are uncorrelated: each coefficient over 1e5 numbers has
    /// a standard deviation of 0.0032; five of them leave a false failure rate of 6e-7 a pair.
    #[test]
    #[cfg_attr(miri, ignore = "many numbers, and no unsafe code that the other tests do not run")]
    fn neighbours_are_uncorrelated() {
        let series = |seed: u64, name: &str, first: u64| -> Vec<f64> {
            (0..100).flat_map(|b| draw(seed, name, first + b)).map(|u| u - 0.5).collect()
        };
        let base = series(1, "a", 0);
        for other in [series(2, "a", 0), series(1, "b", 0), series(1, "a", 1), series(1, "a", 100)]
        {
            let products: f64 = base.iter().zip(&other).map(|(x, y)| x * y).sum();
            let correlation = 12.0 * products / base.len() as f64;
            assert!(correlation.abs() < 5.0 / (base.len() as f64).sqrt(), "{correlation}");
        }
    }
}
