//! Estimates that a sheet states in two parts: a nominal or an indicated value, and its correction (VIM,
//! 2.53). Their sum is the estimate.

use super::Budget;
use super::columns::{Column, Header, MEASURED, is_deviation, is_nominal, place_of, plain};
use super::grid::Cells;
use super::number::number_with_unit;
use super::rows::Row;
use super::symbol;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::number::Shortest;
use gumption_text::deviation_words::{CORRECTIONS, DEVIATIONS, ERRORS};

/// Measured values that may be corrected already.
const RESULTS: [&str; 16] = [
    "measured value",
    "measured",
    "measurement",
    "observed value",
    "messwert",
    "gemessener wert",
    "valeur mesurée",
    "x",
    "est",
    "est. value",
    "estimated value",
    "central value",
    "result",
    "amount",
    "ergebnis",
    "résultat",
];

/// The words at the head of corrections.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    CORRECTIONS.into_iter().chain(DEVIATIONS)
}

/// Two parts make an estimate to this share of the correction.
const SAME: f64 = 1e-6;

impl Header {
    /// A column of corrections is added to that of nominal or indicated values; beside one of estimates, which
    /// may have them already, it is asked.
    pub(super) fn corrections(&mut self, cells: &Cells) {
        let comma = cells.decimal_comma();
        let number = |line: usize, place: usize| {
            number_with_unit(cells.text(line, place).trim(), comma).map(|(value, _)| value)
        };
        let lines = self.line + 1..cells.lines();
        let changes = |place: usize| {
            lines.clone().any(|line| number(line, place).is_some_and(|value| value != 0.0))
        };
        let head = |header: &Self, place: usize| {
            let heading = header.heading(place);
            [plain(symbol::before_unit(heading)), plain(heading)]
        };
        let is_of = |header: &Self, place: usize, all: &[&str]| {
            // `Measured deviation`, but no permissible one
            let is_it = |words: &String, of: &str| {
                let before = words.strip_suffix(of).and_then(|before| before.strip_suffix(' '));
                let is_limit = |before: &str| {
                    ["max", "perm", "zul", "allow", "tol"]
                        .iter()
                        .any(|limit| before.contains(limit))
                };
                words == of || before.is_some_and(|before| !is_limit(before))
            };
            !is_deviation(header.heading(place))
                && head(header, place).iter().any(|words| all.iter().any(|of| is_it(words, of)))
        };
        let found: Vec<usize> =
            self.unknown.iter().copied().filter(|place| changes(*place)).collect();
        let found: Vec<usize> = found
            .into_iter()
            .filter(|place| {
                [&CORRECTIONS[..], &DEVIATIONS, &ERRORS].iter().any(|all| is_of(self, *place, all))
            })
            .collect();
        let Some(&place) = found.first() else { return };
        let heading = self.heading(place).trim().to_owned();
        if let Some(second) = found.get(1) {
            self.doubtful.push(format!(
                "the columns `{heading}` and `{}` may both be corrections of the estimates: write the \
                 corrected values into a column `Estimate`",
                self.heading(*second).trim()
            ));
            return;
        }
        let Some(own) = place_of(&self.columns, Column::Estimate) else {
            self.doubtful.push(format!(
                "the column `{heading}` has numbers, and no other one has estimates: head it `Estimate` if it \
                 has those of the rows, or write their values into such a column"
            ));
            return;
        };
        let own_words = plain(symbol::before_unit(self.heading(own)));
        let is_indicated =
            MEASURED.contains(&own_words.as_str()) && !RESULTS.contains(&own_words.as_str());
        let is_correction = is_of(self, place, &CORRECTIONS);
        let is_error = is_of(self, place, &ERRORS);
        if is_nominal(self.heading(own)) && !is_error || is_indicated && is_correction {
            self.unknown.retain(|of| *of != place);
            self.columns.push((place, Column::Correction));
            self.columns.sort_by_key(|(place, _)| *place);
            return;
        }
        // the estimate is the sum of another column and the correction
        let makes_estimates = |part: &usize| {
            lines.clone().all(|line| {
                let Some(correction) = number(line, place) else { return true };
                let sum = number(line, *part).map(|part| part + correction);
                let estimate = number(line, own);
                sum.zip(estimate).is_some_and(|(sum, estimate)| {
                    (sum - estimate).abs() <= SAME * correction.abs()
                })
            })
        };
        // an error is that of the estimate, or one that is still to be taken from it
        if is_error && !is_nominal(self.heading(own)) && !is_indicated {
            return;
        }
        if !self.unknown.iter().any(makes_estimates) {
            self.doubtful.push(format!(
                "the estimate can be `{0}` or its {1} `{heading}`: write the corrected values into a column \
                 `Estimate` and take `{heading}` away{2}",
                self.heading(own).trim(),
                if is_error { "sum or difference with" } else { "sum with" },
                match is_correction {
                    true => format!(
                        ", or head `{}` with what it is, `Nominal` or `Indication`",
                        self.heading(own).trim()
                    ),
                    false => String::new(),
                }
            ));
        }
    }
}

impl Budget<'_> {
    /// Adds the correction of a row to its nominal or indicated value.
    pub(super) fn corrected(
        &mut self,
        header: &Header,
        lenient: bool,
        row: &mut Row,
    ) -> Option<()> {
        let correction = self.in_unit(header, row.line, (Column::Correction, lenient), row)?;
        if correction == 0.0 {
            return None;
        }
        let part = row.estimate.unwrap_or(0.0);
        let sum = to_15_digits(part + correction);
        row.estimate = Some(sum);
        self.understood.push(format!(
            "line {}: the estimate is {} and the correction `{}`, {}",
            row.line + 1,
            Shortest(part),
            header.cell(self.cells, row.line, Column::Correction).trim(),
            Shortest(sum)
        ));
        Some(())
    }
}
