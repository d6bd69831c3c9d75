//! Projects of suncal (Sandia National Laboratories): the first calculation of an uncertainty in the
//! YAML file that it saves.

use std::path::Path;
use std::rc::Rc;

use serde_json::{Map, Value, json};

use super::yaml::{Node, Yaml, read};
use super::{ImportedBudget, columns, pint};
use gumption_engine::model::formula::check_name;
use gumption_engine::special::{normal, student};
use gumption_files::read_text;
use gumption_text::{Collector, DiagnosticKind, Diagnostics, SourceText};
use gumption_units::Unit;

/// The model file of a project.
///
/// # Errors
/// A text that is no YAML, no project, or has what a model file cannot say; all at once.
pub(super) fn of_project(path: &Path, text: &str) -> Result<ImportedBudget, Diagnostics> {
    let log = Collector::new(SourceText::new(path.display().to_string(), text));
    let mut project = Project { log: &log, understood: Vec::new(), guessed: Vec::new() };
    let root = match read(text) {
        Ok(root) => root,
        Err((span, reason)) => {
            let reason = format!("this is not YAML: {reason}");
            log.report(&span, DiagnosticKind::Table { reason });
            return Err(log.into_diagnostics());
        }
    };
    let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let made = project.model(&root, &title.unwrap_or_default());
    let (understood, guessed) = (project.understood, project.guessed);
    log.finish(made.map(|text| ImportedBudget { text, understood, guessed }))
}

struct Project<'a> {
    log: &'a Collector,
    understood: Vec<String>,
    guessed: Vec<String>,
}

/// An input of the calculation.
struct Quantity {
    name: String,
    unit: String,
    about: String,
    estimate: f64,
    /// What its uncertainty is made of: distributions with their keys, without the estimate.
    parts: Vec<Part>,
}

/// One part of an uncertainty.
struct Part {
    name: String,
    about: String,
    keys: Map<String, Value>,
    /// Whether the estimate follows from it: readings.
    is_readings: bool,
    /// Standard uncertainty and degrees of freedom, where they can be said.
    std: f64,
    dof: f64,
}

/// A formula and its result.
struct Function {
    name: String,
    formula: String,
    keys: Map<String, Value>,
}

impl Project<'_> {
    fn fail(&self, node: &Node, reason: impl Into<String>) {
        self.log.report(&node.span, DiagnosticKind::Table { reason: reason.into() });
    }

    fn model(&mut self, root: &Rc<Node>, file: &str) -> Option<String> {
        let all: Vec<Rc<Node>> = match &root.value {
            Yaml::List(entries) => entries.clone(),
            _ => vec![root.clone()],
        };
        let mode =
            |of: &Node| of.get("mode").and_then(Node::text).unwrap_or("uncertainty").to_owned();
        let evaluates = |of: &Node| {
            matches!(mode(of).as_str(), "uncertainty" | "wizard") && of.get("functions").is_some()
        };
        let Some(of) = all.iter().find(|of| evaluates(of)) else {
            self.fail(
                root,
                "this is no project of suncal with a calculation of an uncertainty: none of its \
                 entries has `functions` and the mode `uncertainty`",
            );
            return None;
        };
        let named = |of: &Node| of.get("name").and_then(Node::text).unwrap_or("?").to_owned();
        self.understood.push(format!("the calculation `{}` of a suncal project", named(of)));
        for other in all.iter().filter(|other| !Rc::ptr_eq(other, of)) {
            let (name, mode) = (named(other), mode(other));
            self.guessed.push(format!("`{name}` ({mode}) of the project is not taken"));
        }
        let functions: Vec<Function> = of
            .get("functions")
            .map_or(&[][..], Node::entries)
            .iter()
            .filter_map(|node| self.function(node))
            .collect();
        let mut quantities: Vec<Quantity> = of
            .get("inputs")
            .map_or(&[][..], Node::entries)
            .iter()
            .filter_map(|node| self.quantity(node))
            .collect();
        let correlations = self.correlations(of, &mut quantities);
        if functions.is_empty() && self.log.is_clean() {
            self.fail(of, "the calculation has no `functions`");
        }
        if !self.log.is_clean() {
            return None;
        }
        if of.get("unitdefs").is_some() {
            self.guessed.push("units of the project's own (`unitdefs`) are not taken".to_owned());
        }
        let title = [of.get("description"), of.get("desc"), of.get("name")]
            .into_iter()
            .flatten()
            .find_map(|node| node.text().filter(|text| !text.trim().is_empty()));
        let mut monte_carlo = Map::new();
        for (ours, theirs) in [("trials", "samples"), ("seed", "seed")] {
            let number =
                of.get(theirs).and_then(Node::text).and_then(|text| text.parse::<u64>().ok());
            if let Some(number) = number.filter(|number| *number > 0) {
                monte_carlo.insert(ours.to_owned(), number.into());
            }
        }
        let document = Document {
            title: title.unwrap_or(file),
            quantities: &quantities,
            functions: &functions,
            correlations,
            monte_carlo,
        };
        self.checked(of, &document)
    }

    /// The model as it passes: as it stands, with thermodynamic temperatures, or without a check of
    /// units.
    fn checked(&mut self, of: &Node, document: &Document<'_>) -> Option<String> {
        let passes = |text: &str| read_text("the model", text, Path::new(""), &[]);
        let plain = document.text(true, &[]);
        let Err(first) = passes(&plain) else { return Some(plain) };
        let celsius: Vec<&str> = document
            .quantities
            .iter()
            .filter(|of| of.unit == "degC")
            .map(|of| of.name.as_str())
            .collect();
        if !celsius.is_empty() {
            let kelvin = document.text(true, &celsius);
            if passes(&kelvin).is_ok() {
                self.guessed.push(format!(
                    "in the equations {} stand as thermodynamic temperatures (`kelvin`), which \
                     suncal converts to by itself",
                    celsius.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
                ));
                return Some(kelvin);
            }
        }
        let reason = first.0.first().map(|fault| fault.kind.to_string()).unwrap_or_default();
        let unchecked = document.text(false, &[]);
        match passes(&unchecked) {
            Ok(_) => {
                self.guessed.push(format!(
                    "units are not checked, and the equations take the numbers in the inputs' units, \
                     because they do not pass: {reason}"
                ));
                Some(unchecked)
            }
            Err(faults) => {
                let reasons: Vec<String> =
                    faults.0.iter().take(5).map(|fault| fault.kind.to_string()).collect();
                self.fail(of, format!("the model of it has mistakes: {}", reasons.join("; ")));
                None
            }
        }
    }

    fn function(&mut self, node: &Rc<Node>) -> Option<Function> {
        let Some(expression) = node.get("expr").and_then(Node::text) else {
            self.fail(node, "a function has no `expr`");
            return None;
        };
        let (name, formula) = expression.split_once('=').unwrap_or(("", expression));
        let name = match node.get("name").and_then(Node::text) {
            Some(name) => name.trim(),
            None => name.trim(),
        };
        if formula.contains('=') || expression.contains(';') {
            self.fail(
                node,
                format!(
                    "`{expression}` is an equation that is to be solved, which is not taken; a model \
                     file has `solve` for it"
                ),
            );
            return None;
        }
        self.check(node, name)?;
        let mut keys = Map::new();
        if let Some(unit) = node.get("units") {
            keys.insert("unit".to_owned(), self.unit(unit)?.into());
        }
        if let Some(about) = node.get("desc").and_then(Node::text).filter(|text| !text.is_empty()) {
            keys.insert("about".to_owned(), about.into());
        }
        if let Some(limits) = node.get("tolerance") {
            self.tolerance(name, limits, &mut keys);
        }
        Some(Function { name: name.to_owned(), formula: translated(formula), keys })
    }

    fn tolerance(&mut self, name: &str, limits: &Node, keys: &mut Map<String, Value>) {
        let unit = |of: Option<&Value>| of.and_then(Value::as_str).map(str::to_owned);
        let own = limits.get("units").and_then(Node::text).and_then(pint::unit);
        let output = unit(keys.get("unit")).unwrap_or_else(|| "1".to_owned());
        let own = own.unwrap_or_else(|| output.clone());
        let mut tolerance = Map::new();
        for (ours, theirs) in [("lower", "low"), ("upper", "high")] {
            let text = limits.get(theirs).and_then(Node::text).unwrap_or_default();
            let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
            if let Some(number) = number {
                let value =
                    if own == output { json!(number) } else { json!(format!("{number} {own}")) };
                tolerance.insert(ours.to_owned(), value);
            }
        }
        if tolerance.is_empty() {
            self.guessed.push(format!("`{name}`: its tolerance has no limits and is not taken"));
        } else {
            keys.insert("tolerance".to_owned(), Value::Object(tolerance));
        }
    }

    fn check(&self, node: &Node, name: &str) -> Option<()> {
        let Err(reason) = check_name(name) else { return Some(()) };
        self.fail(node, format!("`{name}` cannot be a name in a model file: {reason}"));
        None
    }

    fn unit(&mut self, node: &Node) -> Option<String> {
        let text = node.text().unwrap_or_default();
        let found = pint::unit(text);
        if found.is_none() {
            self.fail(node, format!("`{text}` is no unit that is known here"));
        }
        found
    }

    fn quantity(&mut self, node: &Rc<Node>) -> Option<Quantity> {
        let Some(name) = node.get("name").and_then(Node::text) else {
            self.fail(node, "an input has no `name`");
            return None;
        };
        self.check(node, name)?;
        let unit = match node.get("units") {
            Some(unit) => self.unit(unit)?,
            None => "1".to_owned(),
        };
        let about = node.get("desc").and_then(Node::text).unwrap_or_default().to_owned();
        let mut parts: Vec<Part> = Vec::new();
        let mut estimate = match node.get("mean") {
            Some(mean) => Some(self.plain(mean)?),
            None => None,
        };
        if let Some(readings) = node.get("typea") {
            let (mean, part) = self.readings(node, readings, name)?;
            estimate = Some(mean);
            parts.extend(part);
        }
        let Some(estimate) = estimate else {
            self.fail(node, format!("the input `{name}` has neither `mean` nor `typea`"));
            return None;
        };
        if let Some(stated) = node.get("typea_uncert").filter(|_| parts.is_empty()) {
            let std = self.plain(stated)?;
            if std > 0.0 {
                parts.push(Part::normal("Type A", std, f64::INFINITY));
            }
        }
        for uncertainty in node.get("uncerts").map_or(&[][..], Node::entries) {
            parts.push(self.part(uncertainty, (estimate, &unit))?);
        }
        distinct(&mut parts);
        Some(Quantity { name: name.to_owned(), unit, about, estimate, parts })
    }

    /// Readings of an input: their mean, and the part of its uncertainty; none of a single one.
    fn readings(
        &mut self,
        node: &Node,
        readings: &Node,
        name: &str,
    ) -> Option<(f64, Option<Part>)> {
        if readings.entries().iter().any(|entry| matches!(entry.value, Yaml::List(_))) {
            self.fail(
                readings,
                format!(
                    "the readings of `{name}` are in groups, which is not taken; a model file has \
                     `readings` with `file` and `groups` for them"
                ),
            );
            return None;
        }
        let mut values: Vec<f64> = Vec::new();
        for entry in readings.entries() {
            values.push(self.plain(entry)?);
        }
        if values.is_empty() {
            values.push(self.plain(readings)?);
        }
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        if values.len() < 2 {
            return Some((mean, None));
        }
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let means = match node.get("numnewmeas") {
            Some(number) => self.plain(number)?,
            None => count,
        };
        if means <= 0.0 {
            self.fail(node, format!("`{name}`: `numnewmeas` is not above 0"));
            return None;
        }
        if values.len() > 50 && node.get("autocorrelate").and_then(Node::text) != Some("false") {
            self.guessed.push(format!(
                "`{name}`: an allowance for readings that follow each other is not taken; a note of \
                 the evaluation says whether they do"
            ));
        }
        let std = (variance / means).sqrt();
        if means != count {
            self.guessed.push(format!(
                "`{name}`: the scatter of {count} readings counts as that of a mean of {means}"
            ));
            return Some((mean, Some(Part::normal("Type A", std, count - 1.0))));
        }
        let mut keys = Map::new();
        keys.insert("distribution".to_owned(), "readings".into());
        keys.insert("values".to_owned(), json!(values));
        let (name, about) = ("Type A".to_owned(), String::new());
        let part = Part { name, about, keys, is_readings: true, std, dof: count - 1.0 };
        Some((mean, Some(part)))
    }

    /// A Type B component.
    fn part(&mut self, node: &Rc<Node>, (estimate, unit): (f64, &str)) -> Option<Part> {
        let name = node.get("name").and_then(Node::text).unwrap_or("Type B").to_owned();
        let about = node.get("desc").and_then(Node::text).unwrap_or_default().to_owned();
        let own = match node.get("units") {
            Some(own) => Some(self.unit(own)?).filter(|own| !is_difference_of(own, unit)),
            None => None,
        };
        // shares are of the estimate in the component's unit
        let factor = |text: &str| Unit::parse(text).map(|unit| unit.factor()).ok();
        let scale =
            own.as_deref().and_then(|own| Some(factor(unit)? / factor(own)?)).unwrap_or(1.0);
        let nominal = (estimate * scale).abs();
        let kind = node.get("dist").and_then(Node::text).unwrap_or("normal").to_owned();
        let amount = |project: &Self, key: &str| match node.get(key) {
            Some(value) => project.amount(value, nominal).map(Some),
            None => Some(None),
        };
        let dof = match node.get("degf").or_else(|| node.get("df")) {
            Some(dof) => self.plain(dof)?,
            None => f64::INFINITY,
        };
        let put = |distribution: &str, key: &str, value: f64| {
            let value = match &own {
                Some(own) => json!(format!("{value} {own}")),
                None => json!(value),
            };
            let mut keys = Map::new();
            keys.insert("distribution".to_owned(), distribution.into());
            keys.insert(key.to_owned(), value);
            keys
        };
        let (std, mut keys) = match kind.as_str() {
            "normal" | "gaussian" | "norm" | "t" => {
                let stated = amount(self, "unc")?;
                let std = match (stated, amount(self, "conf")?, amount(self, "k")?) {
                    (Some(unc), Some(conf), _) => unc / factor_of(conf, &kind, dof),
                    (Some(unc), None, k) => unc / k.unwrap_or(1.0),
                    (None, ..) => match amount(self, "std")? {
                        Some(std) => std,
                        None => amount(self, "scale")?.unwrap_or(1.0),
                    },
                };
                if kind == "t" {
                    self.guessed.push(format!(
                        "`{name}`: a t distribution is taken for a standard uncertainty with degrees \
                         of freedom"
                    ));
                }
                (std, put("normal", "std", std))
            }
            "uniform" | "triangular" | "arcsine" | "resolution" => {
                let a = amount(self, "a")?.unwrap_or(1.0);
                let half = if kind == "resolution" { a / 2.0 } else { a };
                let (shape, square): (_, f64) = match kind.as_str() {
                    "triangular" => ("triangular", 6.0),
                    "arcsine" => ("arcsine", 2.0),
                    _ => ("rectangular", 3.0),
                };
                (half / square.sqrt(), put(shape, "half_width", half))
            }
            "expon" | "poisson" => {
                let std = if kind == "expon" {
                    1.0 / amount(self, "lambda")?.unwrap_or(1.0)
                } else {
                    amount(self, "v")?.unwrap_or(1.0).sqrt()
                };
                self.guessed.push(format!(
                    "`{name}`: the distribution `{kind}` is taken for a normal one of the same \
                     standard uncertainty"
                ));
                (std, put("normal", "std", std))
            }
            _ => {
                self.fail(
                    node,
                    format!(
                        "`{name}`: the distribution `{kind}` is not taken; normal, t, uniform, \
                         triangular, arcsine, resolution, expon and poisson are"
                    ),
                );
                return None;
            }
        };
        if !(std > 0.0 && std.is_finite()) {
            self.fail(node, format!("`{name}`: its width is not above 0"));
            return None;
        }
        if dof.is_finite() && dof < 1e6 {
            match keys.get("distribution").and_then(Value::as_str) {
                Some("normal" | "rectangular" | "triangular") => {
                    keys.insert("dof".to_owned(), json!(dof));
                }
                _ => self.guessed.push(format!("`{name}`: its degrees of freedom are not taken")),
            }
        }
        Some(Part { name, about, keys, is_readings: false, std: std / scale, dof })
    }

    fn plain(&self, node: &Node) -> Option<f64> {
        self.amount(node, f64::NAN)
    }

    /// A number, or a share of the estimate or of a range: `0.1%`, `0.5%range(10)`, `20 ppm`.
    fn amount(&self, node: &Node, nominal: f64) -> Option<f64> {
        let text = node.text().unwrap_or_default().trim();
        let text = if node.tag.is_some() { text.split(' ').next().unwrap_or(text) } else { text };
        if matches!(text.to_lowercase().as_str(), ".inf" | "inf" | "+.inf" | "infinity") {
            return Some(f64::INFINITY);
        }
        let term = |term: &str| {
            let term = term.trim();
            let shares = [("%", 1e-2), ("ppm", 1e-6), ("ppb", 1e-9)];
            let share = shares.into_iter().find_map(|(sign, size)| {
                let (number, rest) = term.split_once(sign)?;
                let of = match rest.trim().strip_prefix("range(") {
                    Some(range) => range.trim_end().strip_suffix(')')?.trim().parse().ok()?,
                    None if rest.trim().is_empty() => nominal,
                    None => return None,
                };
                Some(number.trim().parse::<f64>().ok()? * size * of)
            });
            share.or_else(|| term.parse::<f64>().ok()).filter(|number| number.is_finite())
        };
        let whole = term(text).or_else(|| text.split('+').map(term).sum());
        if whole.is_none() {
            self.fail(
                node,
                format!("`{text}` is no number and no share such as `0.1%` or `20 ppm`"),
            );
        }
        whole
    }

    /// The correlations; inputs of several parts become normal ones for them.
    fn correlations(&mut self, of: &Node, quantities: &mut [Quantity]) -> Vec<Value> {
        let mut found = Vec::new();
        for entry in of.get("correlations").map_or(&[][..], Node::entries) {
            let name = |key: &str| entry.get(key).and_then(Node::text).map(str::to_owned);
            let coefficient = entry.get("cor").and_then(|node| self.plain(node));
            let (Some(a), Some(b), Some(r)) = (name("var1"), name("var2"), coefficient) else {
                self.fail(entry, "a correlation has `var1`, `var2` and `cor`");
                continue;
            };
            for name in [&a, &b] {
                let Some(quantity) = quantities.iter_mut().find(|of| of.name == *name) else {
                    self.fail(entry, format!("there is no input `{name}`"));
                    continue;
                };
                if quantity.parts.len() > 1 || quantity.parts.iter().any(|part| part.is_readings) {
                    quantity.parts = vec![combined(&quantity.parts)];
                    self.guessed.push(format!(
                        "`{name}`: because it is correlated, its components are taken together as \
                         one normal quantity"
                    ));
                }
            }
            found.push(json!([a, b, r]));
        }
        found
    }
}

/// The coverage factor of a level of confidence, in per cent or as a number.
fn factor_of(confidence: f64, kind: &str, dof: f64) -> f64 {
    let p = if confidence > 1.0 { confidence / 100.0 } else { confidence };
    let upper = f64::midpoint(1.0, p);
    if kind == "t" && dof.is_finite() {
        student::quantile(upper, dof)
    } else {
        normal::quantile(upper)
    }
}

/// Whether two units are of one size: a width of `K` of a temperature in `degC` needs no unit.
fn is_difference_of(own: &str, unit: &str) -> bool {
    match (Unit::parse(own), Unit::parse(unit)) {
        (Ok(own), Ok(unit)) => own.dimension() == unit.dimension() && own.factor() == unit.factor(),
        _ => own == unit,
    }
}

/// Components have names of their own.
fn distinct(parts: &mut [Part]) {
    for place in 0..parts.len() {
        let name = columns::identifier(&parts[place].name);
        let name = if check_name(&name).is_err() { format!("part_{}", place + 1) } else { name };
        let mut own = name.clone();
        let mut number = 2;
        while parts[..place].iter().any(|part| part.name == own) {
            own = format!("{name}_{number}");
            number += 1;
        }
        if parts[place].about.is_empty() && parts[place].name != own {
            parts[place].about = std::mem::take(&mut parts[place].name);
        }
        parts[place].name = own;
    }
}

/// All parts as one, with the degrees of freedom of Welch and Satterthwaite.
fn combined(parts: &[Part]) -> Part {
    let square: f64 = parts.iter().map(|part| part.std * part.std).sum();
    let fourth: f64 = parts.iter().map(|part| part.std.powi(4) / part.dof).sum();
    Part::normal("combined", square.sqrt(), square * square / fourth)
}

impl Part {
    fn normal(name: &str, std: f64, dof: f64) -> Self {
        let mut keys = Map::new();
        keys.insert("distribution".to_owned(), "normal".into());
        keys.insert("std".to_owned(), json!(std));
        if dof.is_finite() && dof < 1e6 {
            keys.insert("dof".to_owned(), json!(dof));
        }
        let (name, about) = (name.to_owned(), String::new());
        Self { name, about, keys, is_readings: false, std, dof }
    }
}

impl Quantity {
    fn value(&self) -> Value {
        let mut input = Map::new();
        if self.unit != "1" {
            input.insert("unit".to_owned(), self.unit.as_str().into());
        }
        match self.parts.as_slice() {
            [] => {
                input.insert("distribution".to_owned(), "constant".into());
                input.insert("value".to_owned(), json!(self.estimate));
            }
            [part] => {
                input.extend(part.keys.clone());
                if !part.is_readings {
                    input.insert("mean".to_owned(), json!(self.estimate));
                }
            }
            parts => {
                // readings bring their mean with them
                let mean =
                    if parts.iter().any(|part| part.is_readings) { 0.0 } else { self.estimate };
                if mean != 0.0 {
                    input.insert("mean".to_owned(), json!(mean));
                }
                let parts = parts.iter().map(|part| {
                    let mut keys = Map::new();
                    keys.insert("name".to_owned(), part.name.as_str().into());
                    if !part.about.is_empty() {
                        keys.insert("about".to_owned(), part.about.as_str().into());
                    }
                    keys.extend(part.keys.clone());
                    Value::Object(keys)
                });
                input.insert("components".to_owned(), Value::Array(parts.collect()));
            }
        }
        if !self.about.is_empty() {
            input.insert("about".to_owned(), self.about.as_str().into());
        }
        Value::Object(input)
    }
}

/// A formula as suncal writes it in our notation.
fn translated(formula: &str) -> String {
    let mut text = String::new();
    let mut rest = formula.trim();
    while let Some(first) = rest.chars().next() {
        if let Some(after) = rest.strip_prefix("**") {
            text.push('^');
            rest = after;
        } else if let Some(after) = rest.strip_prefix('[')
            && let Some(end) = after.find(']')
        {
            // a constant with its unit
            text.push_str(&constant(&after[..end]));
            rest = &after[end + 1..];
        } else if first.is_alphabetic() || first == '_' {
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            let (word, after) = rest.split_at(end);
            text.push_str(match (word, after.trim_start().starts_with('(')) {
                ("log", true) => "ln",
                ("arcsin", true) => "asin",
                ("arccos", true) => "acos",
                ("arctan", true) => "atan",
                ("Abs", true) => "abs",
                ("e" | "E", false) => "exp(1)",
                _ => word,
            });
            rest = after;
        } else if first.is_ascii_digit() || first == '.' {
            // the e of an exponent is no word
            let plain = |c: char| !(c.is_ascii_digit() || c == '.');
            let mut end = rest.find(plain).unwrap_or(rest.len());
            let tail = &rest[end..];
            if let Some(exponent) = tail.strip_prefix(['e', 'E']) {
                let signed = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
                let digits = signed.find(|c: char| !c.is_ascii_digit()).unwrap_or(signed.len());
                if digits > 0 {
                    end += 1 + (exponent.len() - signed.len()) + digits;
                }
            }
            text.push_str(&rest[..end]);
            rest = &rest[end..];
        } else {
            text.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    text
}

/// `360 deg` as `(360 [deg])`.
fn constant(text: &str) -> String {
    let end = text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let number = number.trim().trim_end_matches('*').trim();
    let unit = pint::unit(unit).unwrap_or_else(|| unit.trim().to_owned());
    match (number, unit.as_str()) {
        ("", unit) => format!("[{unit}]"),
        (number, "" | "1") => number.to_owned(),
        (number, unit) => format!("({number} [{unit}])"),
    }
}

/// The model file.
struct Document<'a> {
    title: &'a str,
    quantities: &'a [Quantity],
    functions: &'a [Function],
    correlations: Vec<Value>,
    monte_carlo: Map<String, Value>,
}

impl Document<'_> {
    /// As text; names of `kelvin` are thermodynamic temperatures in the formulas.
    fn text(&self, checked: bool, kelvin: &[&str]) -> String {
        let mut members = vec![("format", json!(2)), ("title", json!(self.title))];
        if !checked {
            members.push(("check_units", json!(false)));
        }
        let mut lines: Vec<String> =
            members.iter().map(|(key, value)| format!("  {}: {value}", json!(key))).collect();
        let group = |key: &str, of: Vec<(&str, Value)>| {
            let inner: Vec<String> =
                of.iter().map(|(name, value)| format!("    {}: {value}", json!(name))).collect();
            format!("  {}: {{\n{}\n  }}", json!(key), inner.join(",\n"))
        };
        let inputs = self.quantities.iter().map(|of| (of.name.as_str(), of.value()));
        lines.push(group("inputs", inputs.collect()));
        if !self.correlations.is_empty() {
            lines.push(format!("  \"correlations\": {}", json!(self.correlations)));
        }
        let equations = self.functions.iter().map(|of| {
            let formula =
                kelvin.iter().fold(of.formula.clone(), |text, name| in_kelvin(&text, name));
            (of.name.as_str(), formula.into())
        });
        lines.push(group("equations", equations.collect()));
        let outputs =
            self.functions.iter().map(|of| (of.name.as_str(), Value::Object(of.keys.clone())));
        lines.push(group("outputs", outputs.collect()));
        if !self.monte_carlo.is_empty() {
            lines.push(format!("  \"monte_carlo\": {}", json!(self.monte_carlo)));
        }
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

/// Every use of a name as that of its thermodynamic temperature.
fn in_kelvin(formula: &str, name: &str) -> String {
    let mut text = String::new();
    let mut rest = formula;
    while let Some(at) = rest.find(name) {
        let is_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
        let (before, after) = (&rest[..at], &rest[at + name.len()..]);
        text.push_str(before);
        let whole = !is_word(text.chars().next_back()) && !is_word(after.chars().next());
        if whole {
            text.push_str(&format!("kelvin({name})"));
        } else {
            text.push_str(name);
        }
        rest = after;
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::propagate::{Control, evaluate};

    fn import(text: &str) -> Result<ImportedBudget, Diagnostics> {
        of_project(Path::new("project.yaml"), text)
    }

    /// Estimate and standard uncertainty of the first output.
    fn evaluated(budget: &ImportedBudget) -> (f64, f64) {
        let file = read_text("m", &budget.text, Path::new(""), &[]);
        let mut task = file.unwrap_or_else(|faults| panic!("{}\n{faults}", budget.text)).task;
        task.settings.trials = gumption_engine::task::Trials::Fixed(0);
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let gum = evaluation.rows[0].outputs[0].gum.clone().unwrap();
        (gum.estimate, gum.standard_uncertainty)
    }

    #[test]
    fn formulas_in_our_notation() {
        for (theirs, ours) in [
            ("a**2*sqrt(b)", "a^2*sqrt(b)"),
            ("log(x)/log10(y) + arctan(z)", "ln(x)/log10(y) + atan(z)"),
            ("2.5e-3*e*x", "2.5e-3*exp(1)*x"),
            ("phi/[360 deg]", "phi/(360 [deg])"),
            ("t*[1 meter/second]", "t*(1 [m/s])"),
            ("1.5E+2*E1", "1.5E+2*E1"),
        ] {
            assert_eq!(translated(theirs), ours);
        }
        assert_eq!(in_kelvin("T*aT/T2 + T", "T"), "kelvin(T)*aT/T2 + kelvin(T)");
    }

    /// A flow by a Pitot tube as a project, its temperature in degC: 57.480 m/s with u = 0.622 m/s,
    /// which suncal 1.7.1 computes of the same numbers.
    #[test]
    fn a_project_with_units() {
        let text = "\
- name: Pitot tube
  mode: uncertainty
  samples: 1000000
  seed: 3
  description: Air speed
  functions:
  - {name: v, expr: v = sqrt(2*D*R*T/p), units: meter / second, desc: speed, tolerance: null}
  inputs:
  - name: D
    mean: 1.993
    units: kilopascal
    uncerts:
    - {name: u, desc: gauge, degf: .inf, dist: normal, unc: 0.025, k: 2, units: kilopascal}
  - {name: R, mean: 287.058, units: joule / kelvin / kilogram, uncerts: [{name: u, dist: normal, std: 0.003}]}
  - {name: T, mean: 19.65, units: degree_Celsius, uncerts: [{name: u, dist: normal, std: 0.2, units: delta_degree_Celsius}]}
  - {name: p, mean: 101.4, units: kilopascal, uncerts: [{name: u, dist: normal, std: 2.1}]}
- {name: risk of it, mode: risk}
";
        let budget = import(text).unwrap();
        let (v, u) = evaluated(&budget);
        assert!((v - 57.480).abs() < 5e-4 && (u - 0.622).abs() < 5e-4, "{v} {u}");
        assert!(budget.guessed.iter().any(|said| said.contains("`T` stand as")));
        assert!(budget.guessed.iter().any(|said| said.contains("risk of it")));
        assert!(budget.text.contains(r#""trials":1000000"#), "{}", budget.text);
    }

    /// u^2 = s^2/5 + 0.05^2/3 + (0.1 % of 10.02)^2 + (0.5 % of 10)^2/4, s the scatter of the readings;
    /// b is correlated with a by 0.5, y = a + 2 b.
    #[test]
    fn readings_components_and_correlations() {
        let readings = [10.0, 10.1, 9.9, 10.05, 10.05];
        let project = |correlations: &str| {
            format!(
                "name: sum\nfunctions:\n- {{name: y, expr: a + 2*b}}\ninputs:\n- name: a\n  typea: \
                 {readings:?}\n  uncerts:\n  - {{name: step, dist: resolution, a: 0.1}}\n  - {{name: \
                 spec, dist: normal, unc: 0.1%, k: 1}}\n  - {{name: spec, dist: normal, unc: \
                 0.5%range(10), conf: 95.449973610364}}\n- {{name: b, mean: 3, uncerts: [{{dist: \
                 normal, std: 0.2, degf: 7}}]}}\n{correlations}"
            )
        };
        let mean = readings.iter().sum::<f64>() / 5.0;
        let scatter = readings.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 4.0;
        let square = scatter / 5.0 + 0.0025 / 3.0 + (0.001 * mean).powi(2) + 0.025 * 0.025;
        let budget = import(&project("")).unwrap();
        let (y, u) = evaluated(&budget);
        assert!((y - mean - 6.0).abs() < 1e-12, "{}", budget.text);
        assert!((u * u - square - 0.16).abs() < 1e-9, "{u}");
        let budget = import(&project("correlations: [{var1: a, var2: b, cor: '0.5000'}]")).unwrap();
        let (_, u) = evaluated(&budget);
        let expected = square + 0.16 + 2.0 * 0.5 * square.sqrt() * 0.4;
        assert!((u * u - expected).abs() < 1e-9, "{u}");
        assert!(budget.guessed.iter().any(|said| said.contains("taken together")));
    }

    #[test]
    fn what_is_no_project_or_not_taken() {
        let of = |input: &str, expression: &str| {
            format!(
                "- functions: [{{name: f, expr: {expression}}}]\n  inputs: [{{name: x, {input}}}]\n"
            )
        };
        for (text, part) in [
            (String::new(), "not YAML"),
            ("a: 'b".to_owned(), "not YAML"),
            ("- 1\n- 2\n".to_owned(), "no project of suncal"),
            ("- {mode: risk}\n".to_owned(), "no project of suncal"),
            (of("mean: one", "x"), "`one` is no number"),
            (of("units: V", "x"), "neither `mean` nor `typea`"),
            (of("mean: 1, units: smoot", "x"), "no unit that is known"),
            (of("mean: 1, uncerts: [{dist: gamma, a: 1}]", "x"), "`gamma` is not taken"),
            (of("mean: 1, uncerts: [{std: 0}]", "x"), "not above 0"),
            (of("mean: 1, uncerts: [{std: 2 %% 3}]", "x"), "no share"),
            (of("mean: 1, typea: [[1, 2], [3, 4]]", "x"), "in groups"),
            (of("mean: 1", "x + y"), "mistakes"),
            (of("mean: 1", "'x*f = 0; f'"), "to be solved"),
            (of("mean: 1", "'x = = 2'"), "to be solved"),
        ] {
            let error = import(&text).unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
