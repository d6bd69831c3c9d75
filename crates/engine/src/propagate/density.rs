//! The density that the law of propagation gives an output.

use std::f64::consts::PI;

use super::gum::{Dof, Gum};
use crate::number::elementary;

impl Gum {
    /// The density at a value, in 1/unit of the output, of the distribution that the coverage
    /// factor is taken from: normal, or the t of the effective degrees of freedom, about the
    /// estimate with the standard uncertainty for its scale (JCGM 100, G.3). `None` where the output
    /// does not vary or its degrees of freedom are undefined.
    pub fn density(&self, value: f64) -> Option<f64> {
        let z = (value - self.estimate) / self.standard_uncertainty;
        let shape = match self.dof {
            Dof::Infinite => elementary::exp(-0.5 * z * z) / (2.0 * PI).sqrt(),
            Dof::Finite(dof) => {
                let scale = libm::lgamma(0.5 * (dof + 1.0)) - libm::lgamma(0.5 * dof);
                let power = -0.5 * (dof + 1.0) * libm::log1p(z * z / dof);
                elementary::exp(scale + power) / (PI * dof).sqrt()
            }
            Dof::Undefined => return None,
        };
        let density = shape / self.standard_uncertainty;
        density.is_finite().then_some(density)
    }
}

#[cfg(test)]
mod tests {
    use crate::distribution::Input;
    use crate::model::typed::example::Projection;
    use crate::propagate::{Control, evaluate};
    use crate::task::{Settings, Task, Trials};

    /// The density at the estimate of a_ref alone: 1/(sqrt(2 pi) u) of a normal quantity, and
    /// Gamma(5/2)/(sqrt(4 pi) Gamma(2)) / u = 0.375/u of a t with 4 degrees of freedom. A rounding
    /// of a few operations.
    #[test]
    fn at_the_estimate_it_is_known() {
        let of = |a_ref: Input| {
            let plane = Projection {
                a_ref,
                tilt: Input::constant(90.0, "deg").unwrap(),
                rotation: Input::constant(0.0, "deg").unwrap(),
            };
            let settings = Settings { trials: Trials::Fixed(0), ..Settings::default() };
            let task = Task::of(plane, settings).unwrap();
            let evaluation = evaluate(&task, &Control::default()).unwrap();
            evaluation.rows[0].outputs[0].gum.clone().unwrap()
        };
        let normal = of(Input::normal(10.0, 0.01, "m/s^2").unwrap());
        let peak = normal.density(normal.estimate).unwrap();
        assert!((peak / 39.894_228_040_143_27 - 1.0).abs() < 1e-13);
        // e^(-1/2) of the peak one standard uncertainty away
        let beside = normal.density(normal.estimate + normal.standard_uncertainty).unwrap();
        assert!((beside / peak - (-0.5_f64).exp()).abs() < 1e-12);
        let t = of(Input::readings(&[10.01, 9.98, 10.02, 10.0, 9.99], "m/s^2").unwrap());
        let peak = t.density(t.estimate).unwrap();
        assert!((peak * t.standard_uncertainty / 0.375 - 1.0).abs() < 1e-13);
    }
}
