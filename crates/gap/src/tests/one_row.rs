//! Data of a single row, of which nothing can be left out.

use super::cases::{candidate, case, normal, observed};
use crate::{DiagnosisOptions, diagnose};
use gumption_engine::task::Sharing;

/// One value, 20 standard uncertainties off: an effect explains it, and what shrinks is of the fit to
/// all data.
#[test]
fn one_row_is_diagnosed_without_blocks() {
    let one = case(
        normal(1.0, 0.01),
        Sharing::All,
        &[("y", "a + 0.5*x")],
        vec![observed(&[3.0], Some(&[0.1]))],
        vec![
            candidate("offset", "o", normal(0.0, 2.0), &[("y", "y + o")]),
            candidate("slope", "s", normal(0.0, 0.05), &[("y", "y + s*x")]),
        ],
    );
    let found = diagnose(&one, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
    assert_eq!(found.rows.len(), 1);
    assert_eq!(found.shrinkage.blocks, 0);
    assert!(found.shrinkage.all.rms_after < found.shrinkage.all.rms_before);
    let sum: f64 = found.hypotheses.iter().map(|h| h.probability).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    assert!(!found.interrupted);
}
