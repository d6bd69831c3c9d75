//! Declared correlation coefficients.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use super::input_set::InputSet;
use super::keys;
use super::links;
use super::sharing;
use gumption_engine::decimal;
use gumption_engine::distribution::{Correlation, CorrelationError, Distribution, Fits};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::{Trials, Warning};
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Folder, table};
use gumption_units::nearest;

/// Reads `correlations` and `correlation_matrix` of the root object and checks that the quantities
/// can have them in each of the rows; the joint draws are kept in `fits`, and what is in the way of
/// trials alone is no mistake where there are none. Those of saved results come with them, with notes.
/// Tables that were read are added to `files`.
pub(super) fn read(
    root: &Object<'_>,
    inputs: &InputSet,
    rows: &ConditionRows<'_>,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
    fits: &Fits,
    trials: Trials,
) -> (Vec<Correlation>, Vec<Warning>) {
    let (found, mut warnings) = links::links(inputs);
    let place = |c: &Correlation| inputs.places.get(c.second).unwrap_or(root.place()).clone();
    let places = found.iter().map(place).collect();
    let shown = inputs.variables.iter().enumerate().filter(|(_, variable)| variable.shown);
    let by_name = shown.map(|(place, variable)| (variable.name.as_str(), place)).collect();
    let mut reader = CorrelationsReader {
        log: root.log,
        inputs,
        rows,
        by_name,
        found,
        pairs: HashSet::new(),
        in_matrix: vec![false; inputs.variables.len()],
        places,
        from_certificates: usize::MAX,
    };
    for (first, coefficient, place) in &inputs.pairs {
        reader.add(*first, first + 1, *coefficient, place);
    }
    if let Some(list) = root.list("correlations") {
        for node in list.iter().take_while(|_| !root.log.is_full()) {
            reader.triple(node);
        }
    }
    if let Some(member) = root.get("correlation_matrix") {
        reader.matrix(root.log, member, folder, files);
    }
    warnings.extend(reader.constants());
    reader.from_certificates = reader.found.len();
    warnings.extend(reader.certified());
    if reader.are_shared_alike(root) {
        warnings.extend(reader.check(root, fits, trials));
    }
    warnings.extend(reader.with_constants());
    (reader.found, warnings)
}

/// The rows of conditions.
pub(super) struct ConditionRows<'a> {
    /// Names of the conditions.
    pub(super) conditions: Vec<String>,
    /// Their values in every row.
    pub(super) rows: &'a [Vec<f64>],
}

struct CorrelationsReader<'a> {
    log: &'a Collector,
    inputs: &'a InputSet,
    rows: &'a ConditionRows<'a>,
    by_name: HashMap<&'a str, usize>,
    found: Vec<Correlation>,
    /// The pairs with a coefficient, apart from those of the matrix.
    pairs: HashSet<(usize, usize)>,
    /// The variables of the matrix, every two of which have one.
    in_matrix: Vec<bool>,
    places: Vec<Range<usize>>,
    /// From which of `found` on they are those of certificates.
    from_certificates: usize,
}

impl CorrelationsReader<'_> {
    /// Adds the coefficients between results of one certificate, where the file states no others.
    fn certified(&mut self) -> Option<Warning> {
        let certified = &self.inputs.certified;
        let mut kept: Vec<Fact> = Vec::new();
        for (place, (second, b, file)) in certified.iter().enumerate() {
            for (first, a, _) in
                certified.iter().take(place).filter(|(.., other_file)| other_file == file)
            {
                let pair = (self.by_name.get(first.as_str()), self.by_name.get(second.as_str()));
                let ((Some(&i), Some(&j)), Some(r)) = (pair, a.correlation(b)) else { continue };
                let pair = (i.min(j), i.max(j));
                if r == 0.0 || self.is_in_matrix(pair) || !self.pairs.insert(pair) {
                    continue;
                }
                let (first_index, second_index) = pair;
                self.found.push(Correlation {
                    first: first_index,
                    second: second_index,
                    coefficient: r,
                });
                self.places.push(self.inputs.places.get(second_index).cloned().unwrap_or(0..0));
                let coefficient = Argument::number(decimal::rounded(r, -3));
                kept.push(fact!("pair.certified", first, second, coefficient, file));
            }
        }
        let note =
            |kept| Warning::new("", fact!("certificate-correlation", pairs = links::some(kept)));
        (!kept.is_empty()).then(|| note(kept))
    }

    /// Adds the coefficients between measured constants, where the file states no others.
    fn constants(&mut self) -> Option<Warning> {
        let constants = &self.inputs.constants;
        let mut kept: Vec<Fact> = Vec::new();
        for (place, &(second, b)) in constants.iter().enumerate() {
            for &(first, a) in constants.iter().take(place) {
                let r = a.correlation(b);
                let pair = (first, second);
                if r == 0.0 || self.is_in_matrix(pair) || !self.pairs.insert(pair) {
                    continue;
                }
                self.found.push(Correlation { first, second, coefficient: r });
                self.places.push(self.inputs.places.get(second).cloned().unwrap_or(0..0));
                let [first, second] = [first, second].map(|variable| self.name(variable));
                let coefficient = Argument::number(decimal::rounded(r, -5));
                kept.push(fact!("pair.correlated", first, second, coefficient));
            }
        }
        let note = |kept| Warning::new("", fact!("codata-correlation", pairs = links::some(kept)));
        (!kept.is_empty()).then(|| note(kept))
    }

    /// Notes on coefficients of what has no uncertainty.
    fn with_constants(&self) -> Vec<Warning> {
        let constant = |place: &usize| !self.inputs.known.varies(*place);
        let name = |place: usize| self.inputs.variables.get(place).map(|v| v.name.as_str());
        let declared = self.found.iter().filter(|correlation| correlation.coefficient != 0.0);
        declared
            .filter_map(|correlation| {
                let place = [correlation.first, correlation.second].into_iter().find(constant)?;
                let (first, second, constant) =
                    (name(correlation.first)?, name(correlation.second)?, name(place)?);
                let fact = fact!("correlation-with-constant", first, second, constant);
                Some(Warning::new(constant, fact))
            })
            .collect()
    }

    fn triple(&mut self, node: &Node) {
        let Json::List(items) = &node.value else {
            return self.wrong(node);
        };
        let [first, second, coefficient] = items.as_slice() else {
            return self.wrong(node);
        };
        let (Json::Text(a), Json::Text(b), Some(r)) =
            (&first.value, &second.value, coefficient.number())
        else {
            return self.wrong(node);
        };
        let (a, b) = (self.variable(a, &first.span), self.variable(b, &second.span));
        if let (Some(a), Some(b)) = (a, b) {
            self.add(a, b, r, &coefficient.span);
        }
    }

    fn wrong(&self, node: &Node) {
        let reason = "a correlation is a list of two names and a coefficient, such as \
                      [\"a\", \"b\", 0.5]";
        self.log.report(&node.span, DiagnosticKind::Correlation { reason: reason.to_owned() });
    }

    fn variable(&self, name: &str, span: &Range<usize>) -> Option<usize> {
        // before the search of all names, which takes long where there are many coefficients
        if let Some(&place) = self.by_name.get(name) {
            return Some(place);
        }
        let shown = |place: &usize| self.inputs.variables.get(*place).is_some_and(|v| v.shown);
        let begins = format!("{name}/");
        let parts = self.inputs.variables.iter().filter(|v| v.name.starts_with(&begins));
        let parts: Vec<String> = parts.map(|v| format!("`{}`", v.name)).collect();
        if !parts.is_empty() {
            let reason = format!(
                "`{name}` has components, and a coefficient is one of them: {}",
                gumption_units::listed(&parts, " or ")
            );
            self.log.report(span, DiagnosticKind::Correlation { reason });
        } else {
            let names = (0..self.inputs.variables.len())
                .filter(shown)
                .filter_map(|v| self.inputs.variables.get(v).map(|v| v.name.as_str()));
            let nearest = nearest(name, names).map(str::to_owned);
            self.log.report(span, DiagnosticKind::NoSuchInput { name: name.to_owned(), nearest });
        }
        None
    }

    fn is_in_matrix(&self, (a, b): (usize, usize)) -> bool {
        self.in_matrix.get(a) == Some(&true) && self.in_matrix.get(b) == Some(&true)
    }

    fn add(&mut self, a: usize, b: usize, r: f64, span: &Range<usize>) {
        if let Some(mistake) = self.mistake(a, b, r) {
            self.log.report(span, mistake);
        } else {
            self.pairs.insert((a.min(b), a.max(b)));
            self.push(a, b, r, span);
        }
    }

    fn push(&mut self, a: usize, b: usize, coefficient: f64, span: &Range<usize>) {
        self.found.push(Correlation { first: a.min(b), second: a.max(b), coefficient });
        self.places.push(span.clone());
    }

    /// Why two variables cannot have this coefficient.
    fn mistake(&self, a: usize, b: usize, r: f64) -> Option<DiagnosticKind> {
        let name = |v: usize| self.inputs.variables.get(v).map_or("", |v| v.name.as_str());
        let reason = if !(-1.0..=1.0).contains(&r) {
            format!("the correlation coefficient is {r}, but must be from -1 to 1")
        } else if a == b {
            format!("`{}` is correlated with itself", name(a))
        } else if links::is_linked(self.inputs, a, b) {
            let (first, second) = (name(a).to_owned(), name(b).to_owned());
            return Some(DiagnosticKind::SavedCorrelation { first, second });
        } else if self.pairs.contains(&(a.min(b), a.max(b))) {
            format!("the correlation of `{}` and `{}` is given twice", name(a), name(b))
        } else {
            return None;
        };
        Some(DiagnosticKind::Correlation { reason })
    }

    fn matrix(
        &mut self,
        log: &Collector,
        member: &gumption_text::json::Member,
        folder: Folder<'_>,
        files: &mut Vec<(String, Vec<u8>)>,
    ) {
        let Some(object) =
            Object::new(log, "`correlation_matrix`", &member.value, &member.key_span)
        else {
            return;
        };
        keys::check(&object, keys::CORRELATION_MATRIX);
        let (names, values, spans) = if let Some(file) = object.text("file") {
            let place = object.get("file").map_or(object.place(), |m| &m.value.span).clone();
            let Some((table, bytes)) = table::read(log, folder, file, &place, None) else {
                return;
            };
            files.push((file.to_owned(), bytes));
            let spans = vec![place.clone(); table.columns.len()];
            (table.columns, table.rows, (spans, place))
        } else {
            let names = object.required("names").and_then(|_| object.list("names"));
            let values = object.required("values").and_then(|_| object.list("values"));
            let (Some(names), Some(values)) = (names, values) else {
                return;
            };
            let texts = names.iter().map(|n| match &n.value {
                Json::Text(text) => text.clone(),
                _ => String::new(),
            });
            let rows = values.iter().map(|row| match &row.value {
                Json::List(cells) => cells.iter().filter_map(Node::number).collect(),
                _ => Vec::new(),
            });
            let spans = names.iter().map(|n| n.span.clone()).collect();
            let place = object.get("values").map_or(object.place(), |m| &m.value.span).clone();
            (texts.collect(), rows.collect(), (spans, place))
        };
        self.entries(&names, &values, &spans.0, &spans.1);
    }

    fn entries(
        &mut self,
        names: &[String],
        values: &[Vec<f64>],
        spans: &[Range<usize>],
        place: &Range<usize>,
    ) {
        let n = names.len();
        let report =
            |reason: String| self.log.report(place, DiagnosticKind::Correlation { reason });
        if values.len() != n || values.iter().any(|row| row.len() != n) {
            return report(format!(
                "the correlation matrix of {n} names must be {n} rows of {n} numbers"
            ));
        }
        let entry =
            |i: usize, j: usize| values.get(i).and_then(|row| row.get(j)).copied().unwrap_or(0.0);
        for i in 0..n {
            if entry(i, i) != 1.0 {
                report(format!("the diagonal of the correlation matrix is 1, not {}", entry(i, i)));
                return;
            }
            for j in 0..i {
                if entry(i, j) != entry(j, i) {
                    let (a, b) = (entry(i, j), entry(j, i));
                    report(format!("the correlation matrix is not symmetric: {a} and {b}"));
                    return;
                }
            }
        }
        let places: Vec<Option<usize>> =
            names.iter().zip(spans).map(|(name, span)| self.variable(name, span)).collect();
        for (j, b) in places.iter().enumerate() {
            for (i, a) in places.iter().enumerate().take(j) {
                let (Some(a), Some(b)) = (*a, *b) else { continue };
                match self.mistake(a, b, entry(i, j)) {
                    Some(mistake) => self.log.report(place, mistake),
                    None => self.push(a, b, entry(i, j), place),
                }
            }
        }
        for variable in places.into_iter().flatten() {
            self.in_matrix[variable] = true;
        }
    }

    /// Whether correlated quantities have their values in common over the same rows.
    fn are_shared_alike(&self, root: &Object<'_>) -> bool {
        let coefficients = self.found.iter().zip(&self.places);
        let linked = links::pairs(self.inputs);
        let by_results: HashSet<(usize, usize)> = linked.iter().copied().collect();
        let declared = coefficients
            .map(|(c, place)| ((c.first, c.second), c.coefficient, place))
            .filter(|(pair, r, _)| *r != 0.0 && !by_results.contains(pair))
            .map(|(pair, _, place)| (pair, place, false));
        let place = |pair: (usize, usize)| self.inputs.places.get(pair.1).unwrap_or(root.place());
        let of_results = linked.iter().map(|&pair| (pair, place(pair), true));
        let ConditionRows { conditions, rows } = self.rows;
        let mut alike = true;
        for (pair, place, linked) in declared.chain(of_results) {
            let reason = sharing::contradiction(self.inputs, pair, linked, conditions, rows);
            if let Some(reason) = reason {
                self.log.report(place, DiagnosticKind::Correlation { reason });
                alike = false;
            }
        }
        alike
    }

    /// Whether the quantities can have these coefficients. Those of certificates, which the file does not
    /// state, become the nearest that they can have, with a note.
    fn check(&mut self, root: &Object<'_>, fits: &Fits, trials: Trials) -> Option<Warning> {
        if !self.inputs.known.is_complete(self.inputs.variables.len()) {
            return None;
        }
        let stated: Vec<f64> = self.found.iter().map(|c| c.coefficient).collect();
        // each turn moves a coefficient, none often
        let mut turns = 2 * self.found.len();
        loop {
            let errors = self.contradictions(fits, trials);
            if turns == 0 || errors.is_empty() || !errors.iter().all(|error| self.moves(error)) {
                errors.into_iter().for_each(|error| self.report(root, &error));
                break;
            }
            turns -= 1;
        }
        let moved: Vec<Fact> = self
            .found
            .iter()
            .zip(stated)
            .filter(|(c, stated)| c.coefficient != *stated)
            .map(|(c, stated)| {
                let [first, second] = [c.first, c.second].map(|v| self.name(v));
                let [from, to] =
                    [stated, c.coefficient].map(|r| Argument::number(decimal::rounded(r, -4)));
                fact!("pair.moved", first, second, from, to)
            })
            .collect();
        let note = |moved| {
            Warning::new("", fact!("certificate-correlation-moved", pairs = links::some(moved)))
        };
        (!moved.is_empty()).then(|| note(moved))
    }

    /// What contradicts the coefficients in some row.
    fn contradictions(&self, fits: &Fits, trials: Trials) -> Vec<CorrelationError> {
        let mut seen: Vec<CorrelationError> = Vec::new();
        let mut before: Option<Arc<[Arc<Distribution>]>> = None;
        for row in self.inputs.known.rows(self.rows.rows.len()) {
            if before.as_ref().is_some_and(|before| Arc::ptr_eq(before, &row)) {
                continue;
            }
            let joint = match trials {
                Trials::Fixed(0) => fits.of_propagation(&row, &self.found),
                _ => fits.joint(&row, &self.found),
            };
            before = Some(row);
            if let Err(error) = joint
                && !seen.contains(&error)
            {
                seen.push(error);
            }
        }
        seen
    }

    /// Moves the coefficients at fault to the nearest possible ones, where all are those of
    /// certificates.
    fn moves(&mut self, error: &CorrelationError) -> bool {
        let from = self.from_certificates;
        let mut concerned = self.found.iter().enumerate().filter(|(_, c)| error.concerns(c));
        if !concerned.all(|(place, _)| place >= from) {
            return false;
        }
        let nearest = match error {
            CorrelationError::OutOfReach { declared, attainable: [least, most] } => {
                let coefficient = declared.coefficient.clamp(*least, *most);
                vec![Correlation { coefficient, ..*declared }]
            }
            CorrelationError::Contradiction { nearest, .. }
            | CorrelationError::BeyondCopula { nearest, .. } => nearest.clone(),
            _ => return false,
        };
        let mut any = false;
        for to in nearest {
            let pair = (to.first.min(to.second), to.first.max(to.second));
            let own = self.found.iter_mut().skip(from);
            for c in own.filter(|c| (c.first.min(c.second), c.first.max(c.second)) == pair) {
                any |= c.coefficient != to.coefficient;
                c.coefficient = to.coefficient;
            }
        }
        any
    }

    /// Whether the coefficient is that of two saved results.
    fn is_of_results(&self, c: &Correlation) -> bool {
        links::is_linked(self.inputs, c.first, c.second)
    }

    fn name(&self, variable: usize) -> &str {
        self.inputs.variables.get(variable).map_or("", |v| v.name.as_str())
    }

    fn report(&self, root: &Object<'_>, error: &CorrelationError) {
        let concerned = self.found.iter().position(|c| error.concerns(c));
        let place = concerned.and_then(|p| self.places.get(p)).unwrap_or(root.place());
        let mut reason = error.describe(&|v| format!("`{}`", self.name(v)));
        if concerned.is_some_and(|place| place >= self.from_certificates) {
            reason +=
                "; the coefficient is the certificate's: state one in `correlations`, such as 0";
        }
        if error.is_of_trials() {
            reason += "; the law of propagation needs none of that: without trials (`\"monte_carlo\": \
                       {\"trials\": 0}`, or --trials 0) it takes the coefficient (JCGM 100, 5.2.2)";
        }
        if concerned.and_then(|p| self.found.get(p)).is_some_and(|c| self.is_of_results(c)) {
            reason += "; or evaluate what these saved results come from in one model";
        }
        self.log.report(place, DiagnosticKind::Correlation { reason });
    }
}
