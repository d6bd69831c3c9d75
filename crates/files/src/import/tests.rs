//! Budgets as laboratories keep them: ordinary ones come in, and odd ones are read right or refused.

use super::*;
use crate::reader::read_text;

mod ordinary;
mod refusals;

/// Options as the command line has them: `U=C`, `row result=5`, `k=2`.
fn options(said: &[&str]) -> ImportOptions {
    let mut options = ImportOptions::default();
    for said in said {
        let (kind, rest) = said.split_once(' ').unwrap_or((said, ""));
        let pair = || {
            let (name, value) = rest.split_once('=').unwrap();
            (name.to_owned(), value.to_owned())
        };
        match kind {
            "column" => options.columns.push(pair()),
            "column-unit" => options.column_units.push(pair()),
            "row" => options.rows.push(pair()),
            "unit" => options.unit = Some(rest.to_owned()),
            "estimate" => options.estimate = Some(rest.to_owned()),
            "k" => options.k = rest.parse().ok(),
            "distribution" => options.distribution = Some(rest.to_owned()),
            "equation" => options.equation = Some(rest.to_owned()),
            "numbers" => options.numbers = true,
            "coefficients" => {
                options.coefficients = Some(match rest {
                    "units" => Coefficients::Units,
                    "ratios" => Coefficients::Ratios,
                    _ => Coefficients::One,
                });
            }
            _ => panic!("{said}"),
        }
    }
    options
}

fn import(text: &str, said: &[&str]) -> Result<ImportedBudget, RefusedBudget> {
    import_budget_bytes(Path::new("b.csv"), text.as_bytes().to_vec(), &options(said))
}

/// Estimate, standard uncertainty and unit of the result of a model file.
fn result(budget: &ImportedBudget) -> (f64, f64, String) {
    // as a model file, and not only as this module reads it
    read_text("m", &budget.text, Path::new(""), &[])
        .unwrap_or_else(|faults| panic!("{}\n{faults}", budget.text));
    let (gum, unit) = model::result_of(&budget.text).unwrap();
    (gum.estimate, gum.standard_uncertainty, unit.text().to_owned())
}

/// Whether two numbers are the same but for roundings of conversions and roots.
fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

#[test]
#[ignore]
fn corpus() {
    let mut out = String::new();
    let mut counts = [0; 4];
    let mut json = Vec::new();
    let Ok(folder) = std::fs::read_dir("/tmp/corpus") else { return };
    let mut paths: Vec<_> = folder.map(|e| e.unwrap().path()).filter(|p| p.extension().is_some_and(|e| e == "csv" || e == "xlsx")).collect();
    paths.sort();
    let sets: [&[&str]; 3] = [&[], &["coefficients one", "k 2"], &["estimate sum", "coefficients units"]];
    for (path, set) in paths.iter().flat_map(|p| sets.iter().map(move |s| (p, *s))) {
        let old = std::fs::read_to_string(path.with_extension("old")).unwrap();
        let content = std::fs::read(&path).unwrap();
        if content.len() > 3000 && !set.is_empty() { continue; }
        let begin = std::time::Instant::now();
        let made = import_budget_bytes(&path, content.clone(), &options(set));
        if begin.elapsed().as_secs_f64() > 1.0 { eprintln!("SLOW {} {:?} {}", path.display(), begin.elapsed(), content.len()); }
        let text = String::from_utf8_lossy(&content).into_owned();
        let first = old.lines().next().unwrap_or("").to_owned();
        match made {
            Err(refused) => {
                let kind = if first.starts_with("ok") { 1 } else { 0 };
                counts[kind] += 1;
                let messages: Vec<String> = refused.diagnostics.0.iter().map(|d| d.kind.to_string()).collect();
                if set.is_empty() { json.push(serde_json::json!({"text": text, "old": first, "messages": messages, "is_csv": path.extension().unwrap() == "csv"})); }
                if kind == 1 && set.is_empty() { out += &format!("=== REFUSED-NOW {}\n{}\n--- {}\n{}\n", path.display(), text.chars().take(600).collect::<String>(), first, refused.diagnostics.0.iter().map(|d| d.kind.to_string()).collect::<Vec<_>>().join("\n  ")); }
            }
            Ok(made) => {
                let (estimate, u, unit) = result(&made);
                let cells: Vec<&str> = first.split('\t').collect();
                let is_it = cells.len() >= 4 && is_same(estimate, cells[1].parse().unwrap()) && is_same(u, cells[2].parse().unwrap()) && unit == cells[3];
                counts[if is_it { 2 } else { 3 }] += 1;
                if !is_it { out += &format!("=== DIFFERENT {set:?} {}\n{}\n--- old {}\n--- new {estimate:e} {u:e} {unit}\n{}", path.display(), text.chars().take(900).collect::<String>(), old.chars().take(700).collect::<String>(), made.text); }
            }
        }
    }
    let mut seed = 12345_u64;
    let mut next = || { seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); (seed >> 33) as usize };
    for path in paths.iter().filter(|p| p.extension().unwrap() == "csv") {
        let text: Vec<char> = String::from_utf8_lossy(&std::fs::read(path).unwrap()).chars().take(3000).collect();
        if text.is_empty() || text.len() > 1000 { continue; }
        for round in 0..1 {
            let mut t = text.clone();
            for _ in 0..1 + next() % 4 {
                let (a, b) = (next() % t.len(), next() % t.len());
                match next() % 4 { 0 => { t.remove(a); } 1 => { let c = t[b]; t.insert(a, c); } 2 => { let c = [';', ',', '\n', '±', '(', '%', '²', '=', '√', ' ', '\t', '"', '-', '9', 'µ', 'U', ':', '/'][b % 18]; t.insert(a, c); } _ => t.swap(a, b) }
                if t.is_empty() { break; }
            }
            let t: String = t.into_iter().collect();
            let _ = import(&t, sets[round % sets.len()]);
        }
    }
    std::fs::write("/tmp/corpus.json", serde_json::to_string(&json).unwrap()).unwrap();
    std::fs::write("/tmp/corpus.txt", format!("refused both {} refused now {} same {} different {}\n{out}", counts[0], counts[1], counts[2], counts[3])).unwrap();
}
