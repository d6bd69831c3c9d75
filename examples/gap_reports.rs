//! Diagnoses the practice cases and the published data sets, and writes how that went to `reports/`.
//!
//! `cargo run --release --example gap_reports` from the project's folder.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use gumption::file::read_case;
use gumption::gap::{Diagnosis, DiagnosisOptions, Hypothesis, HypothesisKind, diagnose};
use serde_json::Value;

fn main() -> Result<(), Box<dyn Error>> {
    std::fs::write("reports/gap-blind.md", blind(Path::new("tests/blind"))?)?;
    std::fs::write("reports/gap-real.md", real(Path::new("tests/real"))?)?;
    Ok(())
}

/// The cases in a folder, in order.
fn cases(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut cases: Vec<PathBuf> = std::fs::read_dir(folder)?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.join("case.json").is_file())
        .collect();
    cases.sort();
    Ok(cases)
}

fn diagnosed(folder: &Path) -> Result<Diagnosis, Box<dyn Error>> {
    let file = read_case(&folder.join("case.json"))?;
    let options = DiagnosisOptions::new(file.case.task.settings.seed);
    Ok(diagnose(&file.case, None, options, &|_| {})?)
}

fn truth(folder: &Path) -> Result<Value, Box<dyn Error>> {
    Ok(serde_json::from_str(&std::fs::read_to_string(folder.join("truth.json"))?)?)
}

fn label(effects: &[String]) -> String {
    if effects.is_empty() {
        return "none".to_owned();
    }
    let mut sorted = effects.to_vec();
    sorted.sort();
    sorted.join(" + ")
}

fn name(hypothesis: &Hypothesis) -> String {
    hypothesis.effects.as_deref().map_or_else(|| "unexplained".to_owned(), label)
}

fn said(diagnosis: &Diagnosis) -> String {
    match diagnosis.most_probable.kind {
        HypothesisKind::Unexplained => "unexplained".to_owned(),
        _ => label(&diagnosis.most_probable.effects),
    }
}

/// Verdicts on the practice cases beside their truths.
fn blind(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut rows = String::new();
    let mut kinds: Vec<(String, usize, usize)> = Vec::new();
    let (mut ln, mut brier, mut held, mut intervals, mut count) =
        (0.0, 0.0, 0usize, 0usize, 0usize);
    for case in cases(folder)? {
        let diagnosis = diagnosed(&case)?;
        let truth = truth(&case)?;
        let kind = truth["kind"].as_str().unwrap_or_default().to_owned();
        let effects: Vec<String> = serde_json::from_value(truth["effects"].clone())?;
        let wanted = if kind == "outside" { "unexplained".to_owned() } else { label(&effects) };
        let said = said(&diagnosis);
        let right = said == wanted;
        let of_truth = diagnosis.hypotheses.iter().find(|h| name(h) == wanted);
        let p = of_truth.map_or(0.0, |h| h.probability);
        ln += p.max(1e-6).ln();
        brier += diagnosis
            .hypotheses
            .iter()
            .map(|h| (h.probability - f64::from(u8::from(name(h) == wanted))).powi(2))
            .sum::<f64>();
        count += 1;
        if right && kind != "outside" {
            for parameter in of_truth.into_iter().flat_map(|h| &h.parameters) {
                let Some(value) = truth["parameters"][&parameter.name].as_f64() else { continue };
                let factor = gumption::unit::Unit::parse(&parameter.unit)?.factor();
                let [lower, upper] = parameter.interval.map(|end| end * factor);
                intervals += 1;
                held += usize::from(lower <= value && value <= upper);
            }
        }
        match kinds.iter_mut().find(|(known, ..)| *known == kind) {
            Some((_, right_ones, all)) => {
                *right_ones += usize::from(right);
                *all += 1;
            }
            None => kinds.push((kind.clone(), usize::from(right), 1)),
        }
        let number = case.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let shrinkage = &diagnosis.shrinkage.all;
        writeln!(
            rows,
            "| {number} | {} | {wanted} | {said} | {:.3} | {p:.3} | {:.2} | {:.2} | {} |",
            truth["family"].as_str().unwrap_or_default(),
            diagnosis.most_probable.probability,
            shrinkage.rms_before,
            shrinkage.rms_after,
            if right { "" } else { "x" },
        )?;
    }
    let right: usize = kinds.iter().map(|(_, right, _)| right).sum();
    let n = count.max(1) as f64;
    let mut page = String::from(
        "# The gap diagnosis on forty practice cases\n\n\
         Written by `cargo run --release --example gap_reports` from `tests/blind`. Data are \
         synthetic; truths are opened after the verdicts.\n\n",
    );
    writeln!(page, "| kind | right | of |\n|---|---|---|")?;
    kinds.sort();
    for (kind, right, all) in &kinds {
        writeln!(page, "| {kind} | {right} | {all} |")?;
    }
    writeln!(page, "| all | {right} | {count} |\n")?;
    writeln!(
        page,
        "Mean logarithm of the probability of the truth: {:.3}. Brier score: {:.3}. Intervals of \
         95 % that hold the true parameter: {held} of {intervals}.\n",
        ln / n,
        brier / n
    )?;
    page.push_str(
        "| case | bench | truth | verdict | its probability | probability of the truth | rms before \
         in u | after | wrong |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    page.push_str(&rows);
    Ok(page)
}

/// Verdicts on published data beside what a best fit would say.
fn real(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut page = String::from(
        "# The gap diagnosis on published data\n\n\
         Written by `cargo run --release --example gap_reports` from `tests/real`, where the sources \
         are. Beside the verdict stand the hypothesis of the best fit (largest likelihood: what the \
         least chi-square names) and that of the least BIC (-2 ln L + k ln n): the best fit always \
         prefers the more flexible hypothesis, and neither knows the answer \"unexplained\".\n\n\
         | data | historical answer | verdict | probability | best fit | least BIC |\n\
         |---|---|---|---|---|---|\n",
    );
    let mut why = String::new();
    for case in cases(folder)? {
        let diagnosis = diagnosed(&case)?;
        let truth = truth(&case)?;
        let wanted = match truth["effects"].as_array() {
            None => "unexplained".to_owned(),
            Some(names) => label(
                &names.iter().filter_map(|n| n.as_str().map(str::to_owned)).collect::<Vec<_>>(),
            ),
        };
        let values = diagnosis.rows.iter().map(|row| row.outputs.len()).sum::<usize>() as f64;
        let named: Vec<&Hypothesis> =
            diagnosis.hypotheses.iter().filter(|h| h.effects.is_some()).collect();
        let best = |score: &dyn Fn(&Hypothesis) -> f64| {
            let first = named.iter().max_by(|a, b| score(a).total_cmp(&score(b)));
            first.map(|h| name(h)).unwrap_or_default()
        };
        let title = case.file_name().unwrap_or_default().to_string_lossy().into_owned();
        writeln!(
            page,
            "| {title} | {wanted} | {} | {:.3} | {} | {} |",
            said(&diagnosis),
            diagnosis.most_probable.probability,
            best(&|h| h.best_log_likelihood),
            best(&|h| 2.0 * h.best_log_likelihood - h.fitted as f64 * values.ln()),
        )?;
        let text = |key: &str| truth[key].as_str().unwrap_or_default().to_owned();
        writeln!(why, "- **{title}**: {} Source: {}.", text("why"), text("source"))?;
    }
    writeln!(page)?;
    page.push_str(&why);
    Ok(page)
}
