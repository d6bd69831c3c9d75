//! Quasi-random figures against exact ones, and their standard errors against their scatter.

use super::*;
use crate::distribution::{Distribution, Normal, Rectangular, StudentT};
use crate::propagate::evaluation::joint;
use crate::propagate::exact::{self, test_task as task};
use crate::task::Task;

fn quasi_of(task: &Task, seed: u64, log2: u32) -> Result<Noiseless, String> {
    let row = &task.rows[0];
    let joint = joint(task, row).unwrap();
    let drawn_dof = f64::INFINITY;
    evaluate_with(&Problem { task, row, joint: &joint, output: 0, drawn_dof }, seed, log2)
}

fn exact_of(task: &Task) -> Noiseless {
    let row = &task.rows[0];
    let joint = joint(task, row).unwrap();
    let drawn_dof = f64::INFINITY;
    exact::evaluate(&Problem { task, row, joint: &joint, output: 0, drawn_dof }).unwrap()
}

fn sum() -> Task {
    let inputs: Vec<Distribution> = vec![
        Rectangular::new(2.0, 1.0).unwrap().into(),
        Normal::new(0.0, 0.4).unwrap().into(),
        StudentT::new(1.0, 0.3, 9.0).unwrap().into(),
        Rectangular::new(0.0, 0.5).unwrap().into(),
    ];
    task(inputs, "2*x0 - x1 + x2 + x3", 0.95)
}

/// Over 60 seeds of scramblings the figures scatter about the exact ones as their standard errors say:
/// the root mean square of the quotients, each with 15 degrees of freedom, is 1.07 and scatters by 0.1
/// (false failure: below one in a hundred thousand).
#[test]
fn standard_errors_are_honest() {
    let task = sum();
    let exact = exact_of(&task);
    let mut squares = [0.0; 4];
    let seeds = 60;
    for seed in 0..seeds {
        let found = quasi_of(&task, seed * 1000, 8).unwrap();
        let errors = found.scatter().unwrap();
        let quotients = [
            (found.median - exact.median) / errors.median,
            (found.symmetric_interval[0] - exact.symmetric_interval[0])
                / errors.symmetric_interval[0],
            (found.symmetric_interval[1] - exact.symmetric_interval[1])
                / errors.symmetric_interval[1],
            (found.estimate.unwrap() - exact.estimate.unwrap()) / errors.estimate.unwrap(),
        ];
        for (sum, quotient) in squares.iter_mut().zip(quotients) {
            *sum += quotient * quotient;
        }
    }
    for sum in squares {
        let root = (sum / seeds as f64).sqrt();
        assert!((0.6..1.55).contains(&root), "{root}");
    }
}

/// The same over 500 seeds; the ratio of scatter and standard error is within 0.9 and 1.1.
#[test]
#[ignore = "500 evaluations"]
fn standard_errors_are_honest_over_500_seeds() {
    let task = sum();
    let found: Vec<Noiseless> =
        (0..500).map(|seed| quasi_of(&task, seed * 1000, 10).unwrap()).collect();
    for end in [0, 1] {
        let [_, error] = mean(found.iter().map(|f| f.symmetric_interval[end]));
        let scatter = error * 500f64.sqrt();
        let squares = found.iter().map(|f| f.scatter().unwrap().symmetric_interval[end].powi(2));
        let stated = (squares.sum::<f64>() / 500.0).sqrt();
        println!("end {end}: ratio {}", stated / scatter);
        assert!((0.9..1.1).contains(&(stated / scatter)), "{}", stated / scatter);
    }
}

/// A product that is no sum: within five standard errors of the exact figures.
#[test]
fn products() {
    let inputs: Vec<Distribution> = vec![
        Normal::new(10.0, 0.5).unwrap().into(),
        Normal::new(5.0, 0.1).unwrap().into(),
        Rectangular::new(2.0, 0.1).unwrap().into(),
    ];
    let task = task(inputs, "x0*x1/x2 + 3", 0.95);
    let (exact, found) = (exact_of(&task), quasi_of(&task, 1, 10).unwrap());
    let errors = found.scatter().unwrap();
    for end in [0, 1] {
        let off = found.symmetric_interval[end] - exact.symmetric_interval[end];
        assert!(off.abs() < 5.0 * errors.symmetric_interval[end], "{off}");
    }
}

/// Where no input has a monotone effect there are no such figures, and the reason is told.
#[test]
fn without_a_monotone_input() {
    let inputs: Vec<Distribution> = vec![Normal::new(0.0, 1.0).unwrap().into(); 2];
    let why = quasi_of(&task(inputs, "x0*x0 + x1*x1", 0.95), 1, 8).unwrap_err();
    assert!(why.contains("monotone"), "{why}");
}
