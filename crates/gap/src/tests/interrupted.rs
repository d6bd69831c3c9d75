//! What an interrupted diagnosis hands back.

use std::sync::atomic::AtomicBool;

use super::cases::line;
use crate::{DiagnosisOptions, diagnose_until};

/// Interrupted before it began, it still says what it knows, of the hypothesis that it has.
#[test]
fn what_is_known_is_handed_back() {
    let stop = AtomicBool::new(true);
    let options = DiagnosisOptions::new(1);
    let found = diagnose_until(&line(), None, options, &|_| {}, &stop).unwrap();
    assert!(found.interrupted);
    assert_eq!(found.notes[0].code(), "interrupted");
    let sum: f64 = found.hypotheses.iter().map(|h| h.probability).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    assert!(found.next.proposals.is_empty() && found.regions.is_empty());
    assert_eq!(found.shrinkage.blocks, 0);
    assert_eq!(found.rows.len(), 6);
}
