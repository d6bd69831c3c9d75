//! Model functions that no program is recorded of.

use std::fmt;

/// A model's function where it cannot be recorded as a program: a call of another program or of
/// another language. It is evaluated for many sets of values at a time.
///
/// A task that has one ([`Task::function`](super::Task::function)) is evaluated by it: the trials are
/// those that a program would have got, and sensitivity coefficients are central differences
/// (JCGM 100, 5.1.3, note 2), refined once. The model's program then only says how many variables
/// and outputs there are.
///
/// The same values must give the same results, as trials may be computed more than once.
///
/// ```
/// use std::sync::Arc;
/// use gumption_engine::distribution::Input;
/// use gumption_engine::propagate::{Control, evaluate};
/// use gumption_engine::task::{ColumnFunction, Task};
///
/// #[derive(Debug)]
/// struct Product;
///
/// impl ColumnFunction for Product {
///     fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]) {
///         for (i, out) in outputs[0].iter_mut().enumerate() {
///             *out = variables[0][i] * variables[1][i];
///         }
///     }
/// }
///
/// let mut task = Task::builder("from elsewhere")
///     .input("a", Input::normal(2.0, 0.1, "1")?)
///     .input("b", Input::normal(3.0, 0.1, "1")?)
///     .equation("y", "a + b")
///     .trials(10_000)
///     .build()?;
/// task.function = Some(Arc::new(Product));
/// let evaluation = evaluate(&task, &Control::default())?;
/// let gum = evaluation.rows[0].outputs[0].gum.as_ref().ok_or("no derivative")?;
/// assert_eq!(gum.estimate, 6.0);
/// // u^2 = (3 * 0.1)^2 + (2 * 0.1)^2; differences of a product are exact but for rounding
/// assert!((gum.standard_uncertainty - 0.13_f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait ColumnFunction: fmt::Debug + Send + Sync {
    /// Fills the outputs, each in its unit, one entry for each set of values. `variables` are the
    /// task's variables, then the conditions, each in its own unit; all columns have the same length.
    /// What is not defined is NaN.
    fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]);
}

/// How far apart, in standard uncertainties, the values of the wider difference are.
const STEP: f64 = 0.25;

/// The outputs at `values` and their derivatives by the first `varying.len()` variables: central
/// differences over a quarter and an eighth of each standard uncertainty, put together so that the
/// error of third order falls out (Richardson). By what does not vary the derivative is 0.
pub(crate) fn differences(
    function: &dyn ColumnFunction,
    values: &[f64],
    uncertainties: &[f64],
    outputs: usize,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut sets: Vec<Vec<f64>> = values.iter().map(|&value| vec![value]).collect();
    // of what does not vary no derivative is needed
    let varying: Vec<(usize, f64)> =
        uncertainties.iter().copied().enumerate().filter(|&(_, u)| u > 0.0).collect();
    let shifts = [1.0, -1.0, 0.5, -0.5];
    for &(variable, u) in &varying {
        for shift in shifts {
            for (v, set) in sets.iter_mut().enumerate() {
                set.push(values[v] + if v == variable { shift * STEP * u } else { 0.0 });
            }
        }
    }
    let count = sets.first().map_or(1, Vec::len);
    let mut found = vec![vec![f64::NAN; count]; outputs];
    function.evaluate(&sets, &mut found);
    let estimates = found.iter().map(|column| column.first().copied().unwrap_or(f64::NAN));
    let estimates: Vec<f64> = estimates.collect();
    let gradients = found.iter().map(|column| {
        let mut gradient = vec![0.0; values.len()];
        for (place, &(variable, _)) in varying.iter().enumerate() {
            let first = 1 + shifts.len() * place;
            let at = |number: usize| column.get(first + number).copied().unwrap_or(f64::NAN);
            // as the values were, not as they were meant to be
            let moved = |number: usize| sets[variable][first + number];
            let wide = (at(0) - at(1)) / (moved(0) - moved(1));
            let narrow = (at(2) - at(3)) / (moved(2) - moved(3));
            gradient[variable] = (4.0 * narrow - wide) / 3.0;
        }
        gradient
    });
    (estimates, gradients.collect())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::distribution::Input;
    use crate::propagate::{Control, evaluate, trial_hash};
    use crate::task::Task;

    #[derive(Debug)]
    struct Sine;

    impl ColumnFunction for Sine {
        fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]) {
            for (out, &x) in outputs[0].iter_mut().zip(&variables[0]) {
                *out = crate::number::elementary::sin(x);
            }
        }
    }

    #[derive(Debug)]
    struct Ratio;

    impl ColumnFunction for Ratio {
        fn evaluate(&self, variables: &[Vec<f64>], outputs: &mut [Vec<f64>]) {
            for (i, out) in outputs[0].iter_mut().enumerate() {
                *out = variables[0][i] / variables[1][i] * variables[2][i];
            }
        }
    }

    #[test]
    fn its_trials_are_those_of_a_program() {
        let task = Task::builder("ratio")
            .input("a", Input::normal(2.0, 0.1, "1").unwrap())
            .input("b", Input::rectangular(3.0, 0.1, "1").unwrap())
            .input("c", Input::constant(0.7, "1").unwrap())
            .equation("y", "a / b * c")
            .trials(20_000)
            .build()
            .unwrap();
        let called = Task { function: Some(Arc::new(Ratio)), ..task.clone() };
        let hash = |task: &Task| trial_hash(task, 20_000, &Control::default()).unwrap();
        assert_eq!(hash(&called), hash(&task));
        let figures = |task: &Task| {
            let evaluation = evaluate(task, &Control::default()).unwrap();
            evaluation.rows[0].outputs[0].clone()
        };
        let (called, recorded) = (figures(&called), figures(&task));
        assert_eq!(called.monte_carlo, recorded.monte_carlo);
        let [called, recorded] = [called, recorded].map(|of| of.gum.unwrap());
        assert_eq!(called.estimate, recorded.estimate);
        // differences of fourth order over a quarter of u: their error is far below 1e-9
        let ratio = called.standard_uncertainty / recorded.standard_uncertainty;
        assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    }

    /// The error of the two differences together is h^4 f'''''/480 with h half the distance of the
    /// wider ones, here 0.025^4/480 = 8e-10 of the derivative.
    #[test]
    fn differences_are_of_fourth_order() {
        let (values, slopes) = differences(&Sine, &[0.7], &[0.1], 1);
        assert_eq!(values[0], crate::number::elementary::sin(0.7));
        assert!((slopes[0][0] / libm::cos(0.7) - 1.0).abs() < 2e-9, "{slopes:?}");
        assert_eq!(differences(&Sine, &[0.7], &[0.0], 1).1[0][0], 0.0);
    }
}
