//! Coverage regions of several outputs.

mod figure;
mod json;
mod words;

pub(crate) use json::RegionSide;

use super::document::Document;
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::Task;

/// A section for each coverage region of a row.
pub(crate) fn sections(document: &mut Document, task: &Task, row: &RowEvaluation) {
    for region in &row.regions {
        let names: Vec<String> = words::names(task, region);
        document.section(format!("Coverage region of {}", names.join(", ")));
        document.table(words::sheet(region));
        for said in words::sentences(task, region) {
            document.text(said);
        }
        document.figure(figure::draw(task, region));
    }
}
