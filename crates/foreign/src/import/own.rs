//! A workbook that this program has made: its model file stands in it, and the cells of its sheet of
//! inputs may have been changed.

use std::path::Path;

use serde_json::{Map, Value, json};

use super::ImportedBudget;
use super::number::number;
use gumption_engine::distribution::Distribution;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::Task;
use gumption_files::carried;
use gumption_files::read_text;
use gumption_text::DiagnosticKind;
use gumption_text::SourceText;
use gumption_text::workbook;
use gumption_text::{Collector, Diagnostics};

/// Cells differ where they differ by more than a spreadsheet's rounding.
const ROUNDING: f64 = 1e-12;

type SheetCells = Vec<Vec<String>>;

/// The model file of a workbook of ours with its changed cells; `None` for other files.
///
/// # Errors
/// What is wrong with the workbook, as a sentence about it.
#[allow(clippy::type_complexity)]
pub(super) fn of_workbook(
    path: &Path,
    content: &[u8],
) -> Result<Option<Result<ImportedBudget, Diagnostics>>, String> {
    // a workbook of somebody else carries no model
    let Ok(text) = carried::of_workbook(content.to_vec()) else { return Ok(None) };
    let inputs = workbook::rows_of(content.to_vec(), workbook::Sheet::Named("Inputs"))?;
    if inputs.is_empty() {
        return Ok(None);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = format!("{}, the model file on sheet About", path.display());
    let task = match read_text(&name, &text, folder, &[]) {
        Ok(file) => file.task,
        Err(diagnostics) => return Ok(Some(Err(diagnostics))),
    };
    let Ok(root) = serde_json::from_str::<Value>(&text) else { return Ok(None) };
    let log = Collector::new(SourceText::new(path.display().to_string(), ""));
    let mut reader =
        OwnBudgetReader { log: &log, task: &task, root, changed: Vec::new(), replaced: Vec::new() };
    reader.sheet(&inputs);
    let OwnBudgetReader { root, changed, replaced, .. } = reader;
    let made = if changed.is_empty() {
        Some(ImportedBudget { text, notes: vec![fact!("import.unchanged")] })
    } else {
        serde_json::to_string_pretty(&root).ok().map(|text| ImportedBudget {
            text: text + "\n",
            notes: changed.into_iter().chain(replaced).collect(),
        })
    };
    let made = log.finish(made).and_then(|made| {
        // what a cell holds may be no width or no probability
        read_text(&name, &made.text, folder, &[])?;
        Ok(made)
    });
    Ok(Some(made))
}

struct OwnBudgetReader<'a> {
    log: &'a Collector,
    task: &'a Task,
    root: Value,
    changed: Vec<Fact>,
    /// Inputs that have another shape now.
    replaced: Vec<Fact>,
}

impl OwnBudgetReader<'_> {
    fn fail(&self, line: usize, reason: &str) {
        let reason = format!("sheet Inputs, row {}: {reason}", line + 1);
        self.log.report(&(0..0), DiagnosticKind::Table { reason });
    }

    /// Compares the sheet with the model: a table of the quantities for each row of conditions.
    fn sheet(&mut self, sheet: &SheetCells) {
        // what was changed, with the table that it stands in
        let mut tables = 0;
        let mut first: Vec<(usize, [Option<f64>; 3])> = Vec::new();
        for (line, row) in sheet.iter().enumerate() {
            let cell = |place: usize| row.get(place).map_or("", |cell| cell.trim());
            let (name, kind) = (cell(0), cell(4));
            if name == "coverage probability" {
                self.probability(line, cell(1));
            } else if name == "quantity" && cell(1) == "estimate" {
                tables += 1;
            } else if kind == "correlation" {
                self.correlation(line, name, cell(1));
            } else if kind == "condition" {
                self.condition(line, name, cell(1), tables);
            } else if let Some(variable) = self.variable(name).filter(|_| tables > 0) {
                let Some(now) = self.cells(line, variable, tables - 1, row) else { continue };
                if tables == 1 {
                    first.push((variable, now));
                } else if first.iter().any(|(other, before)| *other == variable && *before != now) {
                    self.fail(
                        line,
                        &format!(
                            "`{name}` was changed for one row of conditions and not as in the first; \
                             change it in the model file"
                        ),
                    );
                }
            }
        }
        for (variable, now) in first {
            if now.iter().any(Option::is_some) {
                self.input(variable, now);
            }
        }
    }

    fn variable(&self, name: &str) -> Option<usize> {
        self.task.variables.iter().position(|variable| variable.name == name)
    }

    fn known(&self, variable: usize, row: usize) -> Option<&Distribution> {
        let row = self.task.rows.get(row)?;
        row.distributions.get(variable).map(|distribution| &**distribution)
    }

    /// Estimate, standard uncertainty and degrees of freedom, each where it was changed.
    fn cells(
        &self,
        line: usize,
        variable: usize,
        row: usize,
        cells: &[String],
    ) -> Option<[Option<f64>; 3]> {
        let known = self.known(variable, row)?;
        let before = [known.mean(), known.standard_uncertainty(), known.dof()];
        let mut now = [None; 3];
        for ((place, before), now) in [1, 2, 5].into_iter().zip(before).zip(&mut now) {
            let cell = cells.get(place).map_or("", |cell| cell.trim());
            let value = match cell {
                "∞" | "" if place == 5 => Some(f64::INFINITY),
                // a constant has no standard uncertainty
                "" | "0" if place == 2 && before == 0.0 => Some(0.0),
                text => number(text, true),
            };
            let Some(value) = value else {
                self.fail(line, &format!("`{cell}` is no number"));
                return None;
            };
            let near = || (value - before).abs() <= ROUNDING * before.abs();
            let same = value == before || before.is_finite() && near();
            *now = (!same).then_some(value);
        }
        Some(now)
    }

    /// Writes changed values of an input, or of a component, into the model.
    fn input(&mut self, variable: usize, [estimate, std, dof]: [Option<f64>; 3]) {
        let Some(known) = self.known(variable, 0).cloned() else { return };
        let name = self.task.variables[variable].name.clone();
        let unit = self.task.variables[variable].unit.text().trim().to_owned();
        let Some(object) = place(&mut self.root, &name) else {
            let reason = format!("`{name}` cannot be changed here; change it in the model file");
            return self.fail(0, &reason);
        };
        let name = name.as_str();
        self.changed.extend(
            estimate.map(|now| fact!("import.changed-estimate", name, now, before = known.mean())),
        );
        let before = known.standard_uncertainty();
        self.changed.extend(std.map(|now| fact!("import.changed-uncertainty", name, now, before)));
        self.changed
            .extend(dof.map(|now| fact!("import.changed-dof", name, now, before = known.dof())));
        let kept = estimate.is_none_or(|value| moved(object, value))
            && std.is_none_or(|value| widened(object, value, &known))
            && dof.is_none_or(|value| with_dof(object, value));
        if kept {
            return;
        }
        let mut normal = Map::new();
        for key in ["name", "unit"] {
            normal.extend(object.get(key).map(|value| (key.to_owned(), value.clone())));
        }
        if !normal.contains_key("name") && !unit.is_empty() {
            normal.entry("unit").or_insert_with(|| json!(unit));
        }
        normal.insert("distribution".to_owned(), json!("normal"));
        normal.insert("mean".to_owned(), json!(estimate.unwrap_or(known.mean())));
        normal.insert("std".to_owned(), json!(std.unwrap_or(known.standard_uncertainty())));
        let dof = dof.unwrap_or(known.dof());
        if dof.is_finite() {
            normal.insert("dof".to_owned(), json!(dof));
        }
        for key in ["about", "type", "group", "per"] {
            normal.extend(object.get(key).map(|value| (key.to_owned(), value.clone())));
        }
        self.replaced.push(fact!("import.normal-now", name, distribution = known.name()));
        *object = normal;
    }

    fn probability(&mut self, line: usize, cell: &str) {
        let before = self.task.settings.coverage.probability();
        let Some(now) = number(cell, true) else {
            return self.fail(line, &format!("`{cell}` is no number"));
        };
        // the sheet has the probability of a factor in four decimals
        if (now - before).abs() < 1e-4 {
            return;
        }
        if let Some(root) = self.root.as_object_mut() {
            root.remove("coverage_factor");
            root.remove("coverage_factor_fixed");
            root.insert("coverage_probability".to_owned(), json!(now));
        }
        let [now, before] = [now, before].map(|of| Argument::number(of.to_string()));
        self.changed.push(fact!("import.changed-probability", now, before));
    }

    fn condition(&self, line: usize, name: &str, cell: &str, table: usize) {
        let conditions = &self.task.model.conditions;
        let place = conditions.iter().position(|condition| condition.name == name);
        let before = place.and_then(|place| self.task.rows.get(table)?.conditions.get(place));
        let same = |before: &f64| {
            number(cell, true).is_some_and(|now| (now - before).abs() <= ROUNDING * before.abs())
        };
        if !before.is_some_and(same) {
            self.fail(line, &format!("the condition `{name}` is changed in the model file alone"));
        }
    }

    /// A coefficient `r(a, b)`.
    fn correlation(&mut self, line: usize, name: &str, cell: &str) {
        let inside = name.strip_prefix("r(").and_then(|name| name.strip_suffix(')'));
        let Some((a, b)) = inside.and_then(|names| names.split_once(", ")) else { return };
        let (Some(i), Some(j)) = (self.variable(a), self.variable(b)) else { return };
        let Some(now) = number(cell, true) else {
            return self.fail(line, &format!("`{cell}` is no number"));
        };
        let pair = (i.min(j), i.max(j));
        let known = self.task.correlations.iter().find(|c| (c.first, c.second) == pair);
        if known.is_some_and(|known| (known.coefficient - now).abs() <= ROUNDING) {
            return;
        }
        if set_coefficient(&mut self.root, a, b, now) {
            let coefficient = Argument::number(now.to_string());
            self.changed.push(fact!("import.changed-correlation", name, coefficient));
        } else if known.is_some() {
            let reason = format!("`{name}` is not stated in the model file, so change it there");
            self.fail(line, &reason);
        }
    }
}

/// The object of an input, or of a component `input/component`, in the model. One that is written as
/// a value becomes an object without keys.
fn place<'r>(root: &'r mut Value, name: &str) -> Option<&'r mut Map<String, Value>> {
    let inputs = root.get_mut("inputs")?.as_object_mut()?;
    if inputs.contains_key(name) {
        let of = inputs.get_mut(name)?;
        if !of.is_object() {
            *of = json!({});
        }
        return of.as_object_mut().filter(|fields| !fields.contains_key("components"));
    }
    let (input, component) = name.split_once('/')?;
    let components = inputs.get_mut(input)?.get_mut("components")?.as_array_mut()?;
    let of = components.iter_mut().find(|of| of.get("name").is_some_and(|n| n == component))?;
    of.as_object_mut()
}

/// Gives an input another estimate and leaves it its shape, where its keys allow that.
fn moved(object: &mut Map<String, Value>, estimate: f64) -> bool {
    for key in ["mean", "value"] {
        if object.contains_key(key) && (key == "mean" || object[key].is_number()) {
            object.insert(key.to_owned(), json!(estimate));
            return true;
        }
    }
    let limits =
        [object.get("lower"), object.get("upper")].map(|limit| limit.and_then(Value::as_f64));
    let [Some(lower), Some(upper)] = limits else { return false };
    if object.contains_key("mode") {
        return false;
    }
    let shift = estimate - 0.5 * (lower + upper);
    object.insert("lower".to_owned(), json!(lower + shift));
    object.insert("upper".to_owned(), json!(upper + shift));
    true
}

/// Gives an input another standard uncertainty and leaves it its shape, where its keys allow that.
fn widened(object: &mut Map<String, Value>, std: f64, of: &Distribution) -> bool {
    let width = std * of.divisor().unwrap_or(1.0);
    for (key, width) in [
        ("std", std),
        ("scale", std),
        ("expanded", width),
        ("half_width", width),
        ("semi_range", width),
    ] {
        if object.contains_key(key) {
            object.insert(key.to_owned(), json!(width));
            return true;
        }
    }
    let limits =
        [object.get("lower"), object.get("upper")].map(|limit| limit.and_then(Value::as_f64));
    let [Some(lower), Some(upper)] = limits else { return false };
    if object.contains_key("mode") {
        return false;
    }
    let middle = 0.5 * (lower + upper);
    object.insert("lower".to_owned(), json!(middle - width));
    object.insert("upper".to_owned(), json!(middle + width));
    true
}

/// Gives an input other degrees of freedom, where its shape takes them.
fn with_dof(object: &mut Map<String, Value>, dof: f64) -> bool {
    const TAKES: [&str; 6] =
        ["normal", "gaussian", "rectangular", "uniform", "triangular", "trapezoidal"];
    let shape = object.get("distribution").and_then(Value::as_str);
    if !shape.is_some_and(|shape| TAKES.contains(&shape)) {
        return false;
    }
    if dof.is_finite() {
        object.insert("dof".to_owned(), json!(dof));
    } else {
        object.remove("dof");
    }
    true
}

/// Sets a coefficient where the model states it.
fn set_coefficient(root: &mut Value, a: &str, b: &str, r: f64) -> bool {
    let is = |found: &Value, name: &str| found.as_str() == Some(name);
    let stated = root.get_mut("correlations").and_then(Value::as_array_mut);
    for triple in stated.into_iter().flatten().filter_map(Value::as_array_mut) {
        let [first, second, coefficient] = triple.as_mut_slice() else { continue };
        if is(first, a) && is(second, b) || is(first, b) && is(second, a) {
            *coefficient = json!(r);
            return true;
        }
    }
    let mut in_matrix = || {
        let matrix = root.get_mut("correlation_matrix")?;
        let names = matrix.get("names")?.as_array()?;
        let at = |name: &str| names.iter().position(|found| is(found, name));
        let (i, j) = (at(a)?, at(b)?);
        for (row, column) in [(i, j), (j, i)] {
            *matrix.get_mut("values")?.get_mut(row)?.get_mut(column)? = json!(r);
        }
        Some(())
    };
    in_matrix().is_some()
}
