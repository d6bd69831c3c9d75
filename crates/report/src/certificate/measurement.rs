//! The measurement behind the results: its equations, and the estimates of its input quantities with
//! their standard uncertainties (EA-4/02, chapter 6).

use super::words::{Words, beside, stacked};
use super::{CertificateReport, file_name};
use crate::document::Document;
use crate::number::{exact, with_uncertainty};
use crate::plain;
use crate::sheet::{Kind, Sheet};
use crate::statement;
use gumption_analysis::certificate::contents::Asked;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::{Evaluation, InputFigures};

/// Input quantities that a certificate states of a model at most: a paper for a customer is no budget.
const MOST_QUANTITIES: usize = 40;

/// A section about the measurement of every model file.
pub(super) fn sections(document: &mut Document, report: &CertificateReport<'_>) {
    let languages = report.certificate.languages.as_slice();
    let header = |word: fn(&Words) -> &'static str| stacked(languages, word);
    let mut begun = false;
    for (number, model) in report.models.iter().enumerate() {
        let asked = report.certificate.evaluations.iter().zip(&report.issued.evaluations);
        let asked: Vec<(&Asked, &Evaluation)> =
            asked.filter(|(asked, _)| asked.file == number).collect();
        let Some((first, _)) = asked.first() else { continue };
        let task = &first.task;
        let equations = statement::equations(task);
        let quantities = quantities(&asked);
        if equations.is_empty() && quantities.is_empty() {
            continue;
        }
        if !begun {
            document.section(beside(languages, |w| w.measurement));
            begun = true;
        }
        if report.models.len() > 1 {
            let named =
                format!("{}: {}", beside(languages, |w| w.model_file), file_name(model.name));
            document.text(plain(&named));
        }
        if !equations.is_empty() {
            let mut sheet = Sheet::default();
            sheet.text(&header(|w| w.quantity), equations.iter().map(|(name, _)| name.clone()));
            let texts = equations.into_iter().map(|(_, text)| text);
            sheet.push(&header(|w| w.equation), texts, Kind::Equations);
            document.table(sheet);
        }
        statement::left_out(task).into_iter().for_each(|said| document.sentence(&said));
        if quantities.is_empty() {
            continue;
        }
        let by_row = beside(languages, |w| w.by_row);
        let digits = report.certificate.digits;
        let texts = quantities.iter().map(|(_, known)| match known {
            Some([estimate, u]) if *u > 0.0 => with_uncertainty(*estimate, *u, digits),
            Some([estimate, _]) => (exact(*estimate), "0".to_owned()),
            None => (by_row.clone(), by_row.clone()),
        });
        let (estimates, uncertainties): (Vec<String>, Vec<String>) = texts.unzip();
        let mut sheet = Sheet::default();
        sheet.text(&header(|w| w.quantity), quantities.iter().map(|(of, _)| plain(&of.name)));
        sheet.numbers(&header(|w| w.value), estimates);
        sheet.numbers(&header(|w| w.standard), uncertainties);
        sheet.units(&header(|w| w.unit), quantities.iter().map(|(of, _)| plain(of.unit.text())));
        document.table(sheet);
    }
}

/// The input quantities with estimate and standard uncertainty; without them where they differ
/// between rows. None where there are very many.
fn quantities<'a>(asked: &[(&'a Asked, &Evaluation)]) -> Vec<(&'a Quantity, Option<[f64; 2]>)> {
    let mut found: Vec<(&Quantity, Option<[f64; 2]>)> = Vec::new();
    for (asked, evaluation) in asked {
        let rows = evaluation.rows.iter();
        for gum in rows.filter_map(|row| row.outputs.iter().find_map(|output| output.gum.as_ref()))
        {
            let figures = InputFigures::of_gum(&asked.task, gum);
            for (input, figures) in asked.task.model.inputs.iter().zip(figures) {
                let own = [figures.estimate, figures.standard_uncertainty];
                match found.iter_mut().find(|(of, _)| of.name == input.quantity.name) {
                    Some((_, known)) => *known = known.filter(|known| *known == own),
                    None => found.push((&input.quantity, Some(own))),
                }
            }
            if found.len() > MOST_QUANTITIES {
                return Vec::new();
            }
        }
    }
    found
}
