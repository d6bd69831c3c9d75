//! The discrete Fourier transform of real signals.

use crate::{Phasor, fft};

/// The values' transform: sum of `x_k` exp(-2 pi i j k / n) for j = 0, ..., n - 1.
pub(crate) fn forward(values: &[f64]) -> Vec<Phasor> {
    let mut spectrum: Vec<Phasor> = values.iter().map(|&x| Phasor::new(x, 0.0)).collect();
    fft::forward(&mut spectrum);
    spectrum
}

/// The real signal of a spectrum of which only the bins up to half the rate count.
pub(crate) fn inverse(mut spectrum: Vec<Phasor>) -> Vec<f64> {
    let n = spectrum.len();
    for j in 1..n.div_ceil(2) {
        spectrum[n - j] = spectrum[j].conj();
    }
    if n.is_multiple_of(2) && n > 0 {
        spectrum[n / 2].im = 0.0;
    }
    fft::inverse(&mut spectrum);
    spectrum.iter().map(|z| z.re / n as f64).collect()
}
