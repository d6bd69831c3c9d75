//! The statistics of the diagnosis against exact values and independent computations.

mod discrepancy;
mod evidence;
mod likelihood;
mod next;
mod regions;

use nalgebra::{DMatrix, DVector};

use crate::Case;
use gumption_files::read_case;

/// A case from texts.
fn case(text: &str, data: &str) -> Case {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.json"), text).unwrap();
    std::fs::write(folder.path().join("data.csv"), data).unwrap();
    match read_case(&folder.path().join("case.json")) {
        Ok(file) => file.case,
        Err(problems) => panic!("{problems}"),
    }
}

/// A line through measured points with an offset and a slope as candidate effects.
pub(crate) fn line(inputs: &str, noise: bool) -> Case {
    let uncertainty = if noise { r#", "standard_uncertainty": "u""# } else { "" };
    let text = format!(
        r#"{{
        "inputs": {{{inputs}}},
        "conditions": {{"x": {{"unit": ""}}}},
        "equations": {{"y": "a + 0.5*x", "z": "a*x - x"}},
        "outputs": {{"y": {{"unit": ""}}, "z": {{"unit": ""}}}},
        "observations": {{"file": "data.csv", "columns": {{
            "y": {{"value": "y"{uncertainty}}}, "z": {{"value": "z"{uncertainty}}}}}}},
        "effects": {{
            "offset": {{"parameters": {{"o": {{"distribution": "normal", "mean": 0, "std": 0.4}}}},
                       "overrides": {{"y": "y + o"}}}},
            "slope": {{"parameters": {{"s": {{"distribution": "normal", "mean": 0.1, "std": 0.3}}}},
                      "overrides": {{"y": "y + s*x", "z": "z - s*x"}}}}
        }}}}"#
    );
    let data = "x,y,z,u\n0,1.12,0.03,0.1\n1,1.55,-0.08,0.1\n2,2.31,0.21,0.12\n3,2.64,0.1,0.1\n\
                4,3.18,0.31,0.2\n5,3.9,0.26,0.1\n";
    case(&text, data)
}

/// Logarithm of a normal density with a dense covariance matrix.
fn ln_normal(residuals: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    let root = covariance.clone().cholesky().unwrap();
    let half_ln_det: f64 = root.l().diagonal().map(f64::ln).sum();
    let square = residuals.dot(&root.solve(residuals));
    -0.5 * square - half_ln_det - residuals.len() as f64 * super::likelihood::HALF_LN_TWO_PI
}
