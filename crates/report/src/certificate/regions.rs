//! Coverage regions of results on the certificate (JCGM 102:2011, 6.5).

use super::CertificateReport;
use super::stated::{self, Stated};
use crate::regions::RegionSide;
use gumption_engine::propagate::{JointRegion, RegionEvaluation};
use serde_json::{Value, json};

/// A region with the rows of its outputs.
pub(super) struct Covered<'a> {
    pub(super) rows: Vec<Stated<'a>>,
    pub(super) region: &'a RegionEvaluation,
}

/// The regions whose outputs are all stated. If a row was raised to the laboratory's capability,
/// there is none: it would be narrower than the laboratory may state.
pub(super) fn covered<'a>(report: &CertificateReport<'a>) -> Vec<Covered<'a>> {
    let rows = stated::rows(report);
    let mut found: Vec<Covered<'a>> = Vec::new();
    for row in &rows {
        let of = report.issued.evaluations.get(row.line.evaluation);
        let regions = of.and_then(|of| of.rows.get(row.line.row)).map(|of| &of.regions);
        for region in regions.into_iter().flatten() {
            if found.iter().any(|known| std::ptr::eq(known.region, region)) {
                continue;
            }
            let stated = |output: &usize| {
                let same = |other: &&Stated<'a>| {
                    (other.line.evaluation, other.line.row, other.line.output)
                        == (row.line.evaluation, row.line.row, *output)
                };
                rows.iter().find(same).filter(|row| !row.is_raised()).copied()
            };
            let all: Option<Vec<Stated<'a>>> = region.outputs.iter().map(stated).collect();
            found.extend(all.map(|rows| Covered { rows, region }));
        }
    }
    found
}

impl Covered<'_> {
    /// The stated region: by the law of propagation unless the trials contradict it (JCGM 102:2011,
    /// clause 8).
    pub(super) fn joint(&self) -> Option<&JointRegion> {
        let trials = self.region.monte_carlo.as_ref().map(|found| &found.region);
        let refuted = self.region.validation.as_ref().is_some_and(|of| !of.gum_valid);
        if refuted { trials } else { self.region.gum.as_ref().or(trials) }
    }

    /// The region for programs.
    pub(super) fn json(&self) -> Value {
        let task = &self.rows.first().map(|row| &row.asked.task);
        let side = task.map(|task| serde_json::to_value(RegionSide::of(task, self.region)));
        let rows: Vec<u64> = self.rows.iter().map(|row| row.number as u64).collect();
        json!({"rows": rows, "region": side.and_then(Result::ok)})
    }
}
