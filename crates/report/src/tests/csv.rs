//! Lines for spreadsheets.

use super::*;
use crate as report;

#[test]
fn one_line_for_each_output_and_row() {
    let text = report::csv(&sweep(&[0.0, 35.0], 2000).report());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 2 * 3);
    insta::assert_snapshot!(lines[0], @r"f,tilt,output,unit,gum_estimate,gum_standard_uncertainty,dof,coverage_factor,expanded_uncertainty,gum_low,gum_high,mc_trials,mc_estimate,mc_standard_uncertainty,mc_median,mc_symmetric_low,mc_symmetric_high,mc_shortest_low,mc_shortest_high,gum_valid,equation");
    assert!(lines[4].starts_with("80,35,a_x,m/s^2,5.7"), "{}", lines[4]);
    // u of a_y is zero at rotation 0, degrees of freedom are infinite
    assert!(lines.iter().all(|line| line.split(',').count() == 21));
}

#[test]
fn texts_are_no_formulas() {
    let mut case = Case::new(plane_at(35.0, 0));
    case.task.model.outputs[0].quantity.name = "=1+1, \"x\"".to_owned();
    let text = report::csv(&case.report());
    assert!(text.contains("\"'=1+1, \"\"x\"\"\","), "{text}");
}

#[test]
fn what_is_not_defined_is_empty() {
    let mut case = Case::new(plane_at(35.0, 0));
    case.evaluation.rows[0].outputs[0].gum = None;
    let text = report::csv(&case.report());
    assert_eq!(
        text.lines().nth(1),
        Some("a_x,m/s^2,,,,,,,,,,,,,,,,,abs(a_ref*sin(tilt)*cos(rotation))")
    );
    assert!(text.lines().nth(3).unwrap().ends_with(",,,,,,,,,,abs(a_ref*cos(tilt))"));
}
