//! Independent errors of a spectrum, each of which changes some lines together.

use std::ops::Range;

use super::spectrum::Lines;
use crate::{Phasor, fft};

/// Lines up to which products of a change are summed one by one.
const FEW: usize = 48;

/// Errors of a response that are independent of each other: what each changes, relative to the response, if it is one
/// standard uncertainty.
#[derive(Clone, Debug, Default)]
pub(super) struct LineErrors {
    changes: Vec<Phasor>,
    /// The first line of each error, and where its changes stand.
    spans: Vec<(usize, Range<usize>)>,
}

impl LineErrors {
    /// Adds an error that changes lines from `first` on.
    pub(super) fn push(&mut self, first: usize, changes: impl IntoIterator<Item = Phasor>) {
        let start = self.changes.len();
        self.changes.extend(changes);
        self.spans.push((first, start..self.changes.len()));
    }

    /// The errors: first line, and changes from there on.
    pub(super) fn each(&self) -> impl Iterator<Item = (usize, &[Phasor])> {
        self.spans
            .iter()
            .filter_map(|(first, span)| Some((*first, self.changes.get(span.clone())?)))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The covariance of real and imaginary part at each line.
    pub(super) fn covariances(&self, lines: &Lines) -> Vec<[f64; 3]> {
        let mut found = vec![[0.0; 3]; lines.count()];
        for (first, changes) in self.each() {
            for (sum, change) in found.iter_mut().skip(first).zip(changes) {
                sum[0] += change.re * change.re;
                sum[1] += change.re * change.im;
                sum[2] += change.im * change.im;
            }
        }
        found
    }

    /// The same errors, but at each line independent of all other lines.
    pub(super) fn of_lines(&self, lines: &Lines) -> Self {
        let mut apart = Self::default();
        for (line, [re, both, im]) in self.covariances(lines).into_iter().enumerate() {
            let of_re = re.sqrt();
            let common = if of_re > 0.0 { both / of_re } else { 0.0 };
            let rest = (im - common * common).max(0.0).sqrt();
            apart.push(line, [Phasor::new(of_re, common)]);
            apart.push(line, [Phasor::new(0.0, rest)]);
        }
        apart
    }

    /// What one standard uncertainty of an error adds to the signal whose lines are `spectrum`: the coefficients b of
    /// Re(sum of b exp(2 pi i k n/N)).
    fn effect<'a>(
        (first, changes): (usize, &'a [Phasor]),
        spectrum: &'a [Phasor],
        lines: &'a Lines,
    ) -> impl Iterator<Item = Phasor> + 'a {
        let of = spectrum.iter().enumerate().skip(first).zip(changes);
        of.map(|((line, value), change)| {
            let change = if lines.is_real(line) { Phasor::new(change.re, 0.0) } else { *change };
            -(value * change) * (lines.weight(line) / lines.samples as f64)
        })
    }

    /// The variance at each instant that the errors give to the signal with the lines `spectrum`.
    ///
    /// The square of Re b(n) is (|b(n)|^2 + Re b(n)^2)/2, and both are spectra of products of the coefficients of b,
    /// as many as an error changes lines. They are added up for all errors before one inverse transform.
    pub(super) fn variances(&self, spectrum: &[Phasor], lines: &Lines) -> Vec<f64> {
        let n = lines.samples;
        let zero = Phasor::new(0.0, 0.0);
        let mut products = vec![zero; n];
        let mut direct = vec![0.0; n];
        for error in self.each() {
            let (first, length) = (error.0, error.1.len());
            let mut effect: Vec<Phasor> = Self::effect(error, spectrum, lines).collect();
            if length <= FEW {
                for (k, b) in effect.iter().enumerate() {
                    for (l, c) in effect.iter().enumerate() {
                        products[(n + k - l) % n] += b * c.conj();
                        products[(2 * first + k + l) % n] += b * c;
                    }
                }
            } else if 4 * length > n {
                effect.splice(0..0, std::iter::repeat_n(zero, first));
                effect.resize(n, zero);
                fft::inverse(&mut effect);
                direct.iter_mut().zip(&effect).for_each(|(sum, b)| *sum += b.re * b.re);
            } else {
                // b over a shorter period, which all differences and sums of its lines fit
                let period = (2 * length).next_power_of_two();
                effect.resize(period, zero);
                fft::inverse(&mut effect);
                let scale = 1.0 / period as f64;
                let mut moduli: Vec<Phasor> =
                    effect.iter().map(|b| Phasor::new(b.norm_sqr() * scale, 0.0)).collect();
                let mut squares: Vec<Phasor> = effect.iter().map(|b| b * b * scale).collect();
                fft::forward(&mut moduli);
                fft::forward(&mut squares);
                for (apart, product) in moduli.into_iter().enumerate() {
                    let at = if apart < length { apart } else { n + apart - period };
                    products[at % n] += product;
                }
                for (sum, product) in squares.into_iter().enumerate() {
                    products[(2 * first + sum) % n] += product;
                }
            }
        }
        fft::inverse(&mut products);
        direct.iter().zip(&products).map(|(sum, p)| (sum + 0.5 * p.re).max(0.0)).collect()
    }

    /// The variance of a figure with the sensitivity coefficients g(n) to the signal's values, of which `sensitivity`
    /// are the sums of g(n) exp(2 pi i k n/N).
    pub(super) fn variance_of(
        &self,
        sensitivity: &[Phasor],
        spectrum: &[Phasor],
        lines: &Lines,
    ) -> f64 {
        let effects = self.each().map(|error| {
            let of = Self::effect(error, spectrum, lines).zip(sensitivity.iter().skip(error.0));
            let change: f64 = of.map(|(b, g)| (b * g).re).sum();
            change * change
        });
        effects.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::simulated::normals;

    /// Against the definition, error by error and instant by instant, for short, middle and long errors, odd and even
    /// records. Rounding of sums of some hundred products of the size of one.
    #[test]
    fn variances_are_sums_of_squares() {
        for samples in [600_usize, 601] {
            let lines = Lines { samples, spacing: 1.0 };
            let count = lines.count();
            let z = normals(1, "errors", 8 * count);
            let phasor = |i: usize| Phasor::new(z[2 * i], z[2 * i + 1]);
            let mut spectrum: Vec<Phasor> = (0..count).map(phasor).collect();
            spectrum[0].im = 0.0;
            if samples % 2 == 0 {
                spectrum[count - 1].im = 0.0;
            }
            let mut errors = LineErrors::default();
            for (first, length) in
                [(0, 5), (count - 7, 7), (30, 100), (count - 140, 140), (0, count)]
            {
                errors.push(first, (0..length).map(|i| phasor(count + i)));
            }
            let mut sensitivity = vec![0.0; samples];
            sensitivity[17] = 1.5;
            sensitivity[400] = -0.5;
            let mut expected = vec![0.0; samples];
            let mut of_figure = 0.0;
            for (first, changes) in errors.each() {
                let mut changed = vec![Phasor::new(0.0, 0.0); count];
                for (i, change) in changes.iter().enumerate() {
                    changed[first + i] = -spectrum[first + i] * change;
                }
                changed[0].im = 0.0;
                let effect = lines.inverse(changed);
                expected.iter_mut().zip(&effect).for_each(|(sum, b)| *sum += b * b);
                let change: f64 = effect.iter().zip(&sensitivity).map(|(b, g)| b * g).sum();
                of_figure += change * change;
            }
            let found = errors.variances(&spectrum, &lines);
            let largest = expected.iter().copied().fold(0.0, f64::max);
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-12 * largest, "{found} {expected}");
            }
            let transformed: Vec<Phasor> =
                lines.forward(&sensitivity).iter().map(|g| g.conj()).collect();
            let found = errors.variance_of(&transformed, &spectrum, &lines);
            assert!((found / of_figure - 1.0).abs() < 1e-10, "{found} {of_figure}");
        }
    }
}
