//! Dual numbers: a value with its exact gradient, carried through every operation by the chain
//! rule. They give the sensitivity coefficients c_i of JCGM 100, 5.1.3, without finite differences.

use std::sync::Arc;

use super::{Binary, Number, Routine, Unary, derivative, number_operators, scalar};

/// A value and its partial derivatives with respect to `N` chosen inputs.
///
/// A model with more than `N` inputs is evaluated several times, `N` inputs at a time, so the type
/// stays small enough for registers.
///
/// At a kink the derivative follows JCGM use: for a modulus at 0 it is 0, for `min` and `max` at a
/// tie that of the first operand, for a comparison 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// The partial derivatives.
    pub gradient: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The independent variable number `index` in the gradient; beyond the gradient's length it
    /// is a constant.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut gradient = [0.0; N];
        if let Some(slope) = gradient.get_mut(index) {
            *slope = 1.0;
        }
        Self { value, gradient }
    }

    /// `value` with this gradient times `slope`.
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Self {
        let gradient = self.gradient.map(|g| derivative::chain(g, slope));
        Self { value, gradient }
    }

    #[inline(always)]
    fn chain_two(self, other: Self, value: f64, slope: f64, other_slope: f64) -> Self {
        let first = self.chain(value, slope);
        let second = other.chain(value, other_slope);
        Self { value, gradient: std::array::from_fn(|i| first.gradient[i] + second.gradient[i]) }
    }

    fn flat(value: f64) -> Self {
        Self { value, gradient: [0.0; N] }
    }
}

impl<const N: usize> Number for Dual<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::flat(value)
    }

    fn unary(self, operation: Unary) -> Self {
        let x = self.value;
        let y = scalar::unary(operation, x);
        self.chain(y, derivative::unary(operation, x, y))
    }

    fn binary(self, operation: Binary, other: Self) -> Self {
        let (x, y) = (self.value, other.value);
        let value = scalar::binary(operation, x, y);
        match operation {
            // the operand that is not taken has no effect, however steep it is
            Binary::Min if y < x => other.chain(value, 1.0),
            Binary::Max if y > x => other.chain(value, 1.0),
            Binary::Min | Binary::Max => self.chain(value, 1.0),
            // nor has a branch that is not taken
            Binary::When if x != 0.0 => other.chain(value, 1.0),
            Binary::Unless if x == 0.0 => other.chain(value, 1.0),
            Binary::When | Binary::Unless => Self::flat(value),
            _ if operation.is_flat() => Self::flat(value),
            _ => {
                let [by_x, by_y] = derivative::binary(operation, x, y, value);
                self.chain_two(other, value, by_x, by_y)
            }
        }
    }

    fn routine(routine: &Arc<dyn Routine>, operands: &[Self]) -> Self {
        let values: Vec<f64> = operands.iter().map(|operand| operand.value).collect();
        let value = routine.value(&values);
        let mut result = Self::flat(value);
        for (operand, slope) in operands.iter().zip(routine.slopes(&values, value)) {
            let part = operand.chain(value, slope);
            for (sum, part) in result.gradient.iter_mut().zip(part.gradient) {
                *sum += part;
            }
        }
        result
    }
}

number_operators!([const N: usize] Dual<N>);

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::{Dual64, DualNum};

    /// Every smooth operation against an independent implementation of dual numbers, at points
    /// away from kinks and poles. 1e-14 relative: both round a handful of operations.
    #[test]
    fn derivatives_agree_with_num_dual() {
        type Ours = fn(Dual<1>) -> Dual<1>;
        type Theirs = fn(Dual64) -> Dual64;
        let table: [(&str, f64, Ours, Theirs); 20] = [
            ("sqrt", 2.3, |x| x.sqrt(), |x| x.sqrt()),
            ("cbrt", 2.3, |x| x.cbrt(), |x| x.cbrt()),
            ("exp", 1.7, |x| x.exp(), |x| x.exp()),
            ("ln", 1.7, |x| x.ln(), |x| x.ln()),
            ("log10", 1.7, |x| x.log10(), |x| x.log10()),
            ("sin", 0.7, |x| x.sin(), |x| x.sin()),
            ("cos", 0.7, |x| x.cos(), |x| x.cos()),
            ("tan", 0.7, |x| x.tan(), |x| x.tan()),
            ("asin", 0.7, |x| x.asin(), |x| x.asin()),
            ("acos", 0.7, |x| x.acos(), |x| x.acos()),
            ("atan", 0.7, |x| x.atan(), |x| x.atan()),
            ("sinh", 0.7, |x| x.sinh(), |x| x.sinh()),
            ("cosh", 0.7, |x| x.cosh(), |x| x.cosh()),
            ("tanh", 0.7, |x| x.tanh(), |x| x.tanh()),
            ("abs", -0.7, |x| x.abs(), |x| -x),
            ("powi", 1.3, |x| x.powi(-5), |x| x.powi(-5)),
            ("pow", 1.3, |x| x.pow(Dual::constant(2.7)), |x| x.powf(2.7)),
            ("1/x - x", 1.3, |x| Dual::constant(1.0) / x - x, |x| x.recip() - x),
            ("atan2", 1.3, |x| x.atan2(x.square()), |x| x.atan2(x * x)),
            ("x^x", 1.3, |x| x.pow(x), |x| x.powd(x)),
        ];
        for (name, x, ours, theirs) in table {
            let a = ours(Dual::variable(x, 0));
            let b = theirs(Dual64::from(x).derivative());
            assert!((a.value - b.re).abs() <= 1e-14 * b.re.abs(), "{name}: value");
            let slope = a.gradient[0];
            assert!((slope - b.eps).abs() <= 1e-14 * b.eps.abs(), "{name}: {slope} {}", b.eps);
        }
    }

    #[test]
    fn kinks_follow_the_convention() {
        let x = Dual::<2>::variable(0.0, 0);
        let y = Dual::<2>::variable(0.0, 1);
        assert_eq!(x.abs().gradient, [0.0, 0.0]);
        assert_eq!(x.min(y).gradient, [1.0, 0.0]);
        assert_eq!(y.max(x).gradient, [0.0, 1.0]);
        // an infinite slope touches only the inputs that the root depends on
        assert_eq!((x.sqrt() + y).gradient[1], 1.0);
        assert!(x.sqrt().gradient[0].is_infinite());
        assert!(!x.hypot(y).gradient[0].is_finite());
    }
}
