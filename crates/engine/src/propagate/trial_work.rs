//! What a trial costs, without measuring it: the number of trials that a run makes may not depend on
//! the machine.

use std::sync::Arc;

use crate::distribution::Distribution;
use crate::regression::Regression;
use crate::task::Task;

/// Operations of a plain model: with its draws and its share of the order statistics a trial of one
/// takes some 20 ns.
const PLAIN: u64 = 64;

/// How many trials of a plain model take as long as one of this task, roughly; at least 1.
pub(super) fn trial_work(task: &Task) -> u64 {
    let mut fits: Vec<&Arc<Regression>> = Vec::new();
    for distribution in task.rows.first().iter().flat_map(|row| row.distributions.iter()) {
        if let Distribution::Fitted(fitted) = &**distribution
            && !fitted.fit().is_linear()
            && !fits.iter().any(|fit| Arc::ptr_eq(fit, fitted.fit()))
        {
            fits.push(fitted.fit());
        }
    }
    let of_fits: u64 = fits.iter().map(|fit| fit.operations()).sum();
    let operations = task.model.program.operations() as u64 + of_fits;
    (operations / PLAIN).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Input;

    fn work(equation: &str) -> u64 {
        let task = Task::builder("work")
            .input("x", Input::normal(1.0, 0.1, "1").unwrap())
            .equation("y", equation)
            .output("y", "1")
            .build()
            .unwrap();
        trial_work(&task)
    }

    /// A product, a sine and a sum for each of 300 terms, but for the first sum.
    #[test]
    fn a_long_formula_counts_as_several_trials() {
        let terms: Vec<String> = (0..300).map(|term| format!("sin({term}.5*x)")).collect();
        assert_eq!(work("2*x + 1"), 1);
        assert_eq!(work(&terms.join(" + ")), (3 * 300 - 1) / PLAIN);
    }
}
