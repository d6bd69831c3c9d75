//! Evaluations that are larger than what is served: an answer has a line for each input of each
//! output in each row of conditions.

use gumption_text::DiagnosticKind;

/// Outputs at most. Every pair of them has a correlation coefficient.
const MOST_OUTPUTS: usize = 3000;

/// Outputs times rows of conditions at most; each takes about a kilobyte.
const MOST_RESULTS: usize = 1_000_000;

/// Outputs times inputs times rows of conditions at most; each takes about 16 bytes, and a line of
/// the answer.
const MOST_LINES: usize = 10_000_000;

/// Pairs of outputs times rows of conditions at most; each takes 8 bytes, and a line of the answer.
const MOST_PAIRS: usize = 10_000_000;

/// How large an evaluation is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub(super) rows: usize,
    pub outputs: usize,
    pub variables: usize,
}

impl Size {
    /// What is too large, if something is.
    pub(super) fn excess(self) -> Option<DiagnosticKind> {
        let Self { rows, outputs, variables } = self;
        let results = rows.saturating_mul(outputs);
        let pairs = outputs.saturating_mul(outputs.saturating_sub(1)) / 2;
        let limits = [
            ("outputs", outputs, MOST_OUTPUTS),
            ("results (rows of conditions times outputs)", results, MOST_RESULTS),
            (
                "lines of budgets (rows of conditions times outputs times inputs and components)",
                results.saturating_mul(variables),
                MOST_LINES,
            ),
            (
                "correlation coefficients of outputs (rows of conditions times pairs of outputs)",
                pairs.saturating_mul(rows),
                MOST_PAIRS,
            ),
        ];
        let (what, found, most) = limits.into_iter().find(|(_, found, most)| found > most)?;
        Some(DiagnosticKind::TooMany { what, found, most })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_is_named() {
        let diagnostic = |rows, outputs, variables| Size { rows, outputs, variables }.excess();
        assert_eq!(diagnostic(1_000_000, 1, 10), None);
        assert_eq!(diagnostic(1, 3000, 3000), None);
        assert_eq!(diagnostic(1, 1, 100_000), None);
        let what = |rows, outputs, variables| match diagnostic(rows, outputs, variables) {
            Some(DiagnosticKind::TooMany { what, found, .. }) => {
                (what.split(' ').next().unwrap(), found)
            }
            other => panic!("{other:?}"),
        };
        assert_eq!(what(1, 3001, 1), ("outputs", 3001));
        assert_eq!(what(500_001, 2, 1), ("results", 1_000_002));
        assert_eq!(what(1_000_000, 1, 11), ("lines", 11_000_000));
        assert_eq!(what(1000, 200, 1), ("correlation", 19_900_000));
        assert_eq!(what(usize::MAX, 3000, 3).1, usize::MAX);
    }
}
