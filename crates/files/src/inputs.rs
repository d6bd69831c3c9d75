//! The inputs of a file: quantities, their variables, and what is known about them in each row.

use std::collections::HashSet;

use super::codata::MeasuredConstant;
use super::condition_values::{ConditionValues, ValuesOfRows};
use super::conditions::unit;
use super::dcc::FromCertificate;
use super::input_set::InputSet;
use super::instrument;
use super::keys::{self, FileShape};
use super::overrides::Override;
use super::paired;
use super::reading_columns::ReadingColumns;
use super::readings::{self, FileReadings};
use super::results::ResultFiles;
use super::samples;
use super::shapes::{self, Estimate, Fields};
use gumption_engine::decimal;
use gumption_engine::distribution::{Constant, Distribution, EvaluationType, Samples};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::model::{InputQuantity, Quantity};
use gumption_engine::number::Shortest;
use gumption_engine::task::{Evidence, Sharing, Trials, Variable, Warning};
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::{ValueOf, is_value};
use gumption_text::{Collector, DiagnosticKind, Folder, notation};
use gumption_units::Unit;
use serde_json::Value;

/// At most so many variables.
const MOST_VARIABLES: usize = 100_000;

/// Readings of less than this share of an estimate are deviations from it: also a decimal point that
/// slipped leaves a tenth.
const DEVIATIONS: f64 = 0.05;

/// Where a quantity's estimate comes from.
enum EstimateSource<'c> {
    Own,
    Fixed(f64),
    Formula(ValuesOfRows<'c>),
}

/// Reads `inputs`; saved results are looked up in `results`, and paths are relative to its folder.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    conditions: &dyn ConditionValues,
    overrides: &[Override],
    results: &ResultFiles<'_>,
    new: Option<&ReadingColumns<'_>>,
    trials: Trials,
) -> Option<InputSet> {
    let object = Object::new(log, "`inputs`", &member.value, &member.key_span)?;
    let found = object.members().len();
    if found > MOST_VARIABLES {
        object.report(DiagnosticKind::TooMany { what: "inputs", found, most: MOST_VARIABLES });
        return None;
    }
    let mut inputs = InputSet::default();
    for member in object.members() {
        if log.is_full() {
            break;
        }
        let Some(object) = Object::new(log, "an input", &member.value, &member.key_span) else {
            continue;
        };
        let moved = overrides.iter().rev().find(|o| o.input == member.key && o.field.is_none());
        let (name, folder) = (member.key.as_str(), results.folder);
        let inputs = &mut inputs;
        let (whole, certificate) = (None, None);
        let mut reader = InputReader {
            object,
            name,
            conditions,
            moved,
            folder,
            results,
            new,
            certificate,
            constant: None,
            inputs,
            whole,
        };
        match object.get("complex") {
            None => reader.input(),
            Some(complex) => reader.complex(complex, overrides),
        }
    }
    let found = inputs.variables.len();
    if found > MOST_VARIABLES {
        let what = "inputs and components";
        object.report(DiagnosticKind::TooMany { what, found, most: MOST_VARIABLES });
        return None;
    }
    paired::apply(log, &mut inputs, trials);
    Some(inputs)
}

struct InputReader<'a, 'i> {
    object: Object<'a>,
    name: &'a str,
    conditions: &'a dyn ConditionValues,
    moved: Option<&'a Override>,
    folder: Folder<'a>,
    results: &'a ResultFiles<'a>,
    /// Readings that replace those of the file.
    new: Option<&'a ReadingColumns<'a>>,
    /// What the input takes from a certificate.
    certificate: Option<FromCertificate>,
    /// The measured constant that the input is.
    constant: Option<&'static MeasuredConstant>,
    inputs: &'i mut InputSet,
    /// The unit of a part of a complex quantity, unless it says its own.
    whole: Option<Unit>,
}

impl<'a> InputReader<'a, '_> {
    fn input(&mut self) {
        let object = self.object;
        let is_certificate = self.is_of("dcc");
        if is_certificate && object.get("components").is_none() {
            self.certificate = self.results.of_certificate(&object);
            let certificate = self.certificate.clone();
            self.certified(self.name, &object, certificate.as_ref());
        }
        if self.is_of("codata") && object.get("components").is_none() {
            self.constant = MeasuredConstant::read(&object);
        }
        let unit = self.unit().unwrap_or_else(|| {
            self.inputs.without_unit.push(self.name.to_owned());
            Unit::one()
        });
        let quantity = Quantity {
            name: self.name.to_owned(),
            unit: unit.clone(),
            about: object.text("about").unwrap_or("").to_owned(),
        };
        let first = self.inputs.variables.len();
        if object.get("components").is_some() {
            self.components(&unit);
        } else {
            self.single(&unit);
        }
        let parts = (self.inputs.variables.len() - first).max(1);
        self.inputs.quantities.push(InputQuantity { quantity, parts });
        self.inputs.quantity_places.push(object.place().clone());
    }

    /// A complex quantity: two real ones, its real and imaginary part, or its modulus and phase.
    fn complex(&mut self, member: &'a Member, overrides: &'a [Override]) {
        let log = self.object.log;
        keys::check(&self.object, keys::COMPLEX_INPUT);
        if let Some(moved) = self.moved {
            let (text, name) = (moved.text.clone(), self.name);
            let reason = format!(
                "`{name}` is complex and has no estimate of its own; set one of its parts, as in \
                 `{name}.re=1`"
            );
            log.report(self.object.place(), DiagnosticKind::Override { text, reason });
        }
        let unit = unit(&self.object, "unit").unwrap_or_else(|| {
            self.inputs.without_unit.push(self.name.to_owned());
            Unit::one()
        });
        let what = "`complex`";
        let Some(object) = Object::new(log, what, &member.value, &member.key_span) else {
            return;
        };
        keys::check(&object, keys::COMPLEX);
        let polar = object.get("modulus").is_some() || object.get("phase").is_some();
        let (parts, other) = if polar {
            ([("modulus", "abs"), ("phase", "arg")], ["re", "im"])
        } else {
            ([("re", "re"), ("im", "im")], ["modulus", "phase"])
        };
        if let Some(second) = other.into_iter().find_map(|key| object.get(key)) {
            let reason = "has `re` and `im`, or `modulus` and `phase`, and not some of both";
            let (name, reason) = (self.name.to_owned(), reason.to_owned());
            log.report(&second.key_span, DiagnosticKind::Complex { name, reason });
            return;
        }
        let first = self.inputs.variables.len();
        for (key, suffix) in parts {
            let Some(part) = object.required(key) else { continue };
            let what = "a part of a complex quantity";
            let Some(part) = Object::new(log, what, &part.value, &part.key_span) else { continue };
            let radian = || Unit::parse("rad").unwrap_or_else(|_| Unit::one());
            let whole = Some(if key == "phase" { radian() } else { unit.clone() });
            let name = format!("{}.{suffix}", self.name);
            let is_part = |o: &&Override| {
                let field = o.field.as_deref();
                o.input == self.name && field.is_some_and(|field| field == key || field == suffix)
            };
            let moved = overrides.iter().rev().find(is_part);
            let (conditions, folder, results) = (self.conditions, self.folder, self.results);
            let new = self.new;
            let inputs = &mut *self.inputs;
            let known = inputs.quantities.len();
            let name = name.as_str();
            let mut reader = InputReader {
                certificate: None,
                constant: None,
                object: part,
                name,
                conditions,
                moved,
                folder,
                results,
                new,
                inputs,
                whole: whole.clone(),
            };
            reader.input();
            if key == "phase" && part.get("unit").is_none() {
                let turned = ["mean", "value"].into_iter().find_map(|key| {
                    let found = part.get(key)?.value.number()?;
                    (found.abs() > std::f64::consts::TAU).then_some(found)
                });
                // without a unit it is in radians
                let fact = |angle| fact!("angle-of-turns.phase", name, angle);
                let note = turned.map(|found| Warning::new(name, fact(found)));
                self.inputs.warnings.extend(note);
            }
            let own =
                self.inputs.quantities.get(known).map(|quantity| quantity.quantity.unit.clone());
            if let (Some(own), Some(whole)) = (own, whole)
                && !own.is_compatible(&whole)
            {
                let diagnostic = DiagnosticKind::WrongDimension {
                    name: name.to_owned(),
                    found: own.to_string(),
                    found_as: own.dimension().describe(),
                    expected: whole.to_string(),
                    expected_as: whole.dimension().describe(),
                };
                let place = part.get("unit").map_or(part.place(), |m| &m.value.span);
                log.report(place, diagnostic);
            }
        }
        let Some(member) = object.get("correlation") else { return };
        let Some(coefficient) = object.number("correlation") else { return };
        // of a part with components nothing tells which of them it is of
        if self.inputs.variables.len() != first + 2 {
            let reason = "has a `correlation` of parts of which one has components; declare it \
                          between components in `correlations`";
            let (name, reason) = (self.name.to_owned(), reason.to_owned());
            log.report(&member.key_span, DiagnosticKind::Complex { name, reason });
            return;
        }
        self.inputs.pairs.push((first, coefficient, member.value.span.clone()));
    }

    /// Whether the input has this distribution.
    fn is_of(&self, distribution: &str) -> bool {
        let member = self.object.get("distribution");
        member.is_some_and(
            |member| matches!(&member.value.value, Json::Text(name) if name == distribution),
        )
    }

    /// The unit as given; without one that of a saved result, or 1. Nothing where the text that the
    /// whole input is could not be read.
    fn unit(&mut self) -> Option<Unit> {
        let object = &self.object;
        let is_unread = object
            .get("distribution")
            .is_some_and(|made| object.log.has_mistake_at(&made.key_span));
        let (is_result, is_certificate) = (self.is_of("result"), self.is_of("dcc"));
        match object.get("unit") {
            None if is_unread => None,
            None if is_result => self.results.unit(object),
            None if self.whole.is_some() => self.whole.clone(),
            None if is_certificate => Some(self.certificate.as_ref()?.unit.clone()),
            None if self.is_of("codata") => Some(self.constant?.own_unit()),
            None => {
                self.inputs.unstated.push(self.name.to_owned());
                Some(Unit::one())
            }
            Some(_) => unit(object, "unit"),
        }
    }

    /// The estimate's source: the command line, a formula of the conditions, or the own fields.
    fn source(&self, key: &str, unit: &Unit) -> Option<EstimateSource<'a>> {
        if let Some(moved) = self.moved {
            let value = moved.value_of_file(unit, self.object.log);
            return self.object.log.value(self.object.place(), value).map(EstimateSource::Fixed);
        }
        let Some(member) = self.object.get(key) else {
            return Some(EstimateSource::Own);
        };
        let Json::Text(text) = &member.value.value else {
            return Some(EstimateSource::Own);
        };
        let log = self.object.log;
        if is_value(text) {
            let value = self.object.value(key, unit, ValueOf::Quantity);
            return value.map(EstimateSource::Fixed);
        }
        if notation::states_uncertainty(text) {
            let (key, whole) = (key.to_owned(), self.as_whole(text));
            log.report(&member.value.span, DiagnosticKind::NotAlone { key, whole });
            return None;
        }
        let formula = log.value(
            &member.value.span,
            log.formula(text).map_err(|error| DiagnosticKind::Formula { error }),
        )?;
        if let Err(kinds) = self.conditions.check(&formula, unit, ValueOf::Quantity) {
            for kind in kinds {
                log.report(&member.value.span, kind.of_key(key));
            }
            return None;
        }
        let values = self.conditions.values(&formula, unit, ValueOf::Quantity);
        Some(EstimateSource::Formula(values))
    }

    /// The input as a text instead of an object, if it can be one: a value with its uncertainty.
    fn as_whole(&self, text: &str) -> Option<String> {
        // parts of complex quantities are objects
        let is_part = self.whole.is_some();
        let unit = self.object.get("unit").and_then(|member| match &member.value.value {
            Json::Text(unit) => Some(unit.as_str()),
            _ => None,
        });
        let whole = notation::stated_in(text, unit.unwrap_or("")).filter(|_| !is_part)?;
        let [name, whole] = [self.name, &whole].map(|text| Value::from(text).to_string());
        Some(format!("{name}: {whole}"))
    }

    /// The estimate in a row, in the quantity's unit.
    fn estimate(&self, source: &EstimateSource<'_>, row: usize) -> Option<Estimate> {
        let value = match source {
            EstimateSource::Own => return Some(Estimate::Own),
            EstimateSource::Fixed(value) => *value,
            EstimateSource::Formula(values) => values(row),
        };
        if value.is_finite() {
            return Some(Estimate::Given(value));
        }
        let place = self.object.get("mean").or_else(|| self.object.get("value"));
        let place = place.map_or(self.object.place(), |member| &member.value.span);
        self.object
            .log
            .report(place, DiagnosticKind::EstimateUndefined { row: row + 1, found: value });
        None
    }

    /// An input with one distribution.
    fn single(&mut self, unit: &Unit) {
        let object = self.object;
        let Some(kind) = shapes::kind(&object) else {
            return self.variable(self.name.to_owned(), &object, None, None, unit);
        };
        let known: Vec<&str> = keys::INPUT.into_iter().chain(kind.fields.iter().copied()).collect();
        keys::check_names(&object, &known);
        instrument::check(&object, kind, unit);
        self.evidence(unit);
        let variable = self.inputs.variables.len();
        let read = self.readings_of_file(&object, &[self.name], unit, kind);
        let of_rows = read.as_ref().and_then(Option::as_ref);
        self.variable(self.name.to_owned(), &object, Some(kind), of_rows, unit);
        let key = if kind.name == "constant" { "value" } else { "mean" };
        let Some(source) = self.source(key, unit) else {
            return;
        };
        let samples = self.samples(&object, self.name, (unit, ValueOf::Quantity), kind);
        let Some(read) = read else { return };
        if kind.name == "dcc" && self.certificate.is_none() {
            return;
        }
        if kind.name == "codata" {
            let Some(constant) = self.constant else { return };
            self.inputs.constants.push((variable, constant));
        }
        let certificate = self.certificate.clone();
        let (results, conditions) = (self.results, self.conditions);
        // a formula has no estimate of its own that limits would belong to
        let is_formula = object.get(key).is_some_and(
            |member| matches!(&member.value.value, Json::Text(text) if !is_value(text)),
        );
        let replaces = self.moved.is_some() && !is_formula;
        let fields = |estimate, row| Fields {
            replaces,
            samples: samples.as_ref(),
            read: read.as_ref(),
            certificate: certificate.as_ref(),
            at: Some((conditions, row)),
            ..Fields::new(object, self.name, unit, estimate, results)
        };
        let has_share = shapes::has_share_beside_value(&object, kind, unit);
        let (mut zero_width, mut zero_share) = (Vec::new(), Vec::new());
        let mut drawn: Vec<Distribution> = Vec::new();
        let differs = matches!(source, EstimateSource::Formula(_))
            || shapes::has_width_of_row(&object, kind, unit, read.as_ref());
        for row in 0..if differs { self.conditions.rows() } else { 1 } {
            let estimate = self.estimate(&source, row);
            let Some(distribution) = estimate.and_then(|e| fields(e, row).distribution(kind))
            else {
                return;
            };
            if is_without_width(kind, &distribution) {
                zero_width.push(row + 1);
            }
            if has_share && distribution.mean() == 0.0 {
                zero_share.push(row + 1);
            }
            drawn.push(distribution);
        }
        if replaces && object.get("limits").is_some() {
            self.note_of_moved_limits();
        }
        let shared = if differs { None } else { drawn.first() };
        self.note_of_readings(&object, unit, self.name, kind, shared, read.as_ref());
        let same_elsewhere = !differs && self.conditions.rows() > 1;
        self.note_of_zero_width(self.name, &zero_width, same_elsewhere);
        if !zero_share.is_empty() {
            let (name, rows) = (self.name, self.in_rows(&zero_share, same_elsewhere));
            self.inputs.warnings.push(Warning::new(name, fact!("share-of-zero", name, rows)));
        }
        match drawn.pop() {
            Some(distribution) if !differs => self.inputs.known.always(variable, distribution),
            last => {
                drawn.extend(last);
                self.inputs.known.in_rows(variable, drawn);
            }
        }
    }

    /// Tells that limits move along with an estimate that replaces another one.
    fn note_of_moved_limits(&mut self) {
        let name = self.name;
        self.inputs.warnings.push(Warning::new(name, fact!("limits-moved", name)));
    }

    /// Tells in which rows (from 1) a width becomes 0.
    fn note_of_zero_width(&mut self, of: &str, rows: &[usize], same_elsewhere: bool) {
        if rows.is_empty() {
            return;
        }
        let fact = fact!("width-zero", of, rows = self.in_rows(rows, same_elsewhere));
        self.inputs.warnings.push(Warning::new(self.name, fact));
    }

    /// Which rows (from 1) of the conditions, if there are several.
    fn in_rows(&self, rows: &[usize], same_elsewhere: bool) -> Option<Fact> {
        let [row, more @ ..] = rows else { return None };
        let has_others = !more.is_empty() || same_elsewhere;
        (self.conditions.rows() > 1).then(|| match has_others {
            true => fact!("in-row.and-others", row = *row),
            false => fact!("in-row", row = *row),
        })
    }

    /// Readings that the distribution is to be tested against.
    fn evidence(&mut self, unit: &Unit) {
        let log = self.object.log;
        let Some(member) = self.object.get("evidence") else {
            return;
        };
        let object = Object::new(log, "`evidence`", &member.value, &member.key_span);
        let Some(object) = object else {
            return;
        };
        keys::check(&object, keys::READINGS);
        let name = format!("{}/evidence", self.name);
        let files = &mut self.inputs.files;
        let unit = (unit, ValueOf::Quantity);
        let read = samples::numbers(&object, &name, unit, self.folder, files);
        let Some((readings, place)) = read else { return };
        if readings.is_empty() {
            log.report(place, DiagnosticKind::NoValues { name });
            return;
        }
        let variable = self.inputs.variables.len();
        self.inputs.evidence.push(Evidence { variable, readings });
    }

    /// The samples of an input or component, if that is its shape.
    fn samples(
        &mut self,
        object: &Object<'_>,
        name: &str,
        unit: (&Unit, ValueOf),
        kind: &FileShape,
    ) -> Option<Samples> {
        if kind.name != "samples" {
            return None;
        }
        samples::read(object, name, unit, self.folder, &mut self.inputs.files)
    }

    /// The readings of a file, if that is where they are, or of the file of readings that replaces what
    /// the model says, where the columns have one of the names; outside `None` after a mistake.
    #[allow(clippy::option_option)]
    fn readings_of_file(
        &mut self,
        object: &Object<'_>,
        names: &[&str],
        unit: &Unit,
        kind: &FileShape,
    ) -> Option<Option<FileReadings>> {
        if kind.name != "readings" {
            return Some(None);
        }
        let replacing = self.new.and_then(|new| readings::replacing(new, object, names, unit));
        if let Some(read) = replacing {
            return read.map(Some);
        }
        let name = names.first().copied().unwrap_or_default();
        match readings::of_file(object, name, unit, self.folder, &mut self.inputs.files) {
            Some(read) => read.map(Some),
            None => {
                for key in ["column", "groups"] {
                    if let Some(member) = object.get(key) {
                        let diagnostic = DiagnosticKind::OnlyWith { key, with: "file" };
                        object.log.report(&member.key_span, diagnostic);
                        return None;
                    }
                }
                Some(None)
            }
        }
    }

    /// What is to be said of readings: groups, a drift, no scatter.
    fn note_of_readings(
        &mut self,
        object: &Object<'_>,
        unit: &Unit,
        name: &str,
        kind: &FileShape,
        drawn: Option<&Distribution>,
        read: Option<&FileReadings>,
    ) {
        if kind.name != "readings" {
            return;
        }
        let of_groups = read.and_then(|read| read.note.clone());
        let of_scatter = match drawn {
            Some(Distribution::Readings(readings)) => {
                readings::refuse_branches(object, readings.values(), unit, read);
                readings::dependence(name, readings.values())
            }
            Some(Distribution::Rectangular(_)) => Some(fact!("resolution-taken", name)),
            Some(Distribution::Constant(_)) => Some(fact!("no-scatter", name)),
            _ => None,
        };
        let notes = of_groups.into_iter().chain(of_scatter);
        self.inputs.warnings.extend(notes.map(|fact| Warning::new(name, fact)));
    }

    /// Notes that a variable is a result of a certificate of our own, and what is taken from one
    /// that states an uncertainty twice.
    fn certified(&mut self, name: &str, object: &Object<'_>, of: Option<&FromCertificate>) {
        let file = object.text("file").unwrap_or("");
        let Some(of) = of else { return };
        let notes = of.notes(name, file);
        self.inputs.warnings.extend(notes.into_iter().map(|fact| Warning::new(name, fact)));
        self.inputs.from_certificates.push((name.to_owned(), of.place.clone()));
        let certified = of.certified.clone();
        self.inputs.certified.extend(certified.map(|of| (name.to_owned(), of, file.to_owned())));
    }

    /// Adds a variable of the budget.
    fn variable(
        &mut self,
        name: String,
        object: &Object<'_>,
        kind: Option<&FileShape>,
        read: Option<&FileReadings>,
        unit: &Unit,
    ) {
        let is_type_a = kind.is_some_and(|kind| kind.name == "readings");
        if is_type_a {
            self.inputs.readings.inputs.push(name.clone());
            self.inputs.readings.columns.extend(readings::columns_of(object));
            if let Some(Json::Text(groups)) = object.get("groups").map(|member| &member.value.value)
            {
                self.inputs.readings.groups.push(groups.clone());
            }
        }
        if is_type_a && object.truth("paired") == Some(true) {
            self.inputs.paired.push(self.inputs.variables.len());
        }
        let evaluation = match object.text("type") {
            Some("A") => EvaluationType::A,
            Some("B") => EvaluationType::B,
            None if is_type_a => EvaluationType::A,
            None => EvaluationType::B,
            Some(other) => {
                let diagnostic = DiagnosticKind::NotOneOf {
                    key: "type".into(),
                    found: other.to_owned(),
                    allowed: vec!["A".into(), "B".into()],
                };
                let place = object.get("type").map_or(object.place(), |m| &m.value.span);
                object.log.report(place, diagnostic);
                EvaluationType::B
            }
        };
        let about = object.text("about").or_else(|| self.object.text("about")).unwrap_or("");
        let own_rows =
            is_type_a && readings::are_of_rows(object, read) && self.object.get("per").is_none();
        // every row has been read on its own, unless the file of readings says which were not
        let own = || read.and_then(|read| read.sharing.clone()).unwrap_or(Sharing::Row);
        let sharing = if own_rows { own() } else { self.sharing() };
        let mut variable = Variable::new(name, unit.clone());
        variable.evaluation = evaluation;
        let group = object.text("group").or_else(|| self.object.text("group"));
        variable.group = group.map(str::to_owned);
        variable.about = about.to_owned();
        variable.sharing = sharing;
        let replacing = read.and_then(|read| read.replacing.as_ref());
        let of_object = match object.get("file").map(|member| &member.value.value) {
            Some(Json::Text(file)) => Some(file),
            _ => None,
        };
        if let Some(file) = replacing.map(|(file, _)| file).or(of_object) {
            self.inputs.read_from.push((self.inputs.variables.len(), file.clone()));
        }
        if replacing.is_some() {
            self.inputs.replaced.push(variable.name.clone());
        }
        self.inputs.variables.push(variable);
        self.inputs.places.push(object.place().clone());
    }

    /// `per`: which rows share a value.
    fn sharing(&self) -> Sharing {
        match self.object.text("per") {
            None => Sharing::All,
            Some("row") => Sharing::Row,
            Some(name) => match self.conditions.place(name) {
                Some(place) => Sharing::Condition(place),
                None => {
                    let mut allowed = self.conditions.names();
                    allowed.push("row".to_owned());
                    let diagnostic = DiagnosticKind::NotOneOf {
                        key: "per".into(),
                        found: name.to_owned(),
                        allowed,
                    };
                    let place =
                        self.object.get("per").map_or(self.object.place(), |m| &m.value.span);
                    self.object.log.report(place, diagnostic);
                    Sharing::All
                }
            },
        }
    }

    /// An input that is the sum of an estimate and its components.
    fn components(&mut self, unit: &Unit) {
        let object = self.object;
        keys::check_names(&object, &keys::COMPOSED);
        // the estimate: a constant without a line of its own
        let first = self.inputs.variables.len();
        self.variable(self.name.to_owned(), &object, None, None, unit);
        if let Some(base) = self.inputs.variables.last_mut() {
            base.shown = false;
        }
        let parts = self.parts(unit);
        let source = self.source("mean", unit);
        let (Some(parts), Some(source)) = (parts, source) else {
            return;
        };
        let of_type_a: Vec<&WrittenComponent<'_>> =
            parts.iter().filter(|p| p.kind.name == "readings").collect();
        if of_type_a.len() > 1 {
            let reason = "is a second one of `readings`; at most one can be".to_owned();
            object.report(DiagnosticKind::Component { name: self.name.to_owned(), reason });
            return;
        }
        let own_mean = match (&source, object.get("mean")) {
            (EstimateSource::Own, Some(_)) => match object.number("mean") {
                Some(mean) => Some(mean),
                None => return,
            },
            (EstimateSource::Own, None) if !of_type_a.iter().any(|part| part.has_estimate()) => {
                object.report(DiagnosticKind::MissingKey {
                    key: "mean",
                    what: "an input with components",
                });
                return;
            }
            _ => None,
        };
        let conditions = self.conditions;
        let at = |row| (conditions, row);
        let (of_readings, scatter) = match of_type_a
            .first()
            .map(|part| part.distribution(unit, 0.0, self.results, at(0)))
        {
            Some(Some(distribution)) => (distribution.mean(), distribution.standard_uncertainty()),
            Some(None) => return,
            None => (0.0, 0.0),
        };
        let differs = matches!(source, EstimateSource::Formula(_))
            || parts.iter().any(|part| {
                shapes::has_width_of_row(&part.object, part.kind, unit, part.read.0.as_ref())
            });
        let mut drawn: Vec<Vec<Distribution>> = vec![Vec::new(); 1 + parts.len()];
        let mut totals: Vec<f64> = Vec::new();
        let mut zero_widths: Vec<Vec<usize>> = vec![Vec::new(); parts.len()];
        for row in 0..if differs { self.conditions.rows() } else { 1 } {
            let of_readings = match of_type_a.first() {
                Some(part)
                    if row > 0 && readings::are_of_rows(&part.object, part.read.0.as_ref()) =>
                {
                    match part.distribution(unit, 0.0, self.results, at(row)) {
                        Some(distribution) => distribution.mean(),
                        None => return,
                    }
                }
                _ => of_readings,
            };
            let total = match self.estimate(&source, row) {
                Some(Estimate::Own) => own_mean.unwrap_or(of_readings),
                Some(Estimate::Given(value)) => value,
                None => return,
            };
            totals.push(total);
            let of_parts: Option<Vec<Distribution>> = parts
                .iter()
                .map(|part| part.distribution(unit, total, self.results, at(row)))
                .collect();
            let base = Constant::new(total - of_readings).map_err(|error| {
                DiagnosticKind::Distribution { name: self.name.to_owned(), error }
            });
            let base = object.log.value(object.place(), base);
            let (Some(of_parts), Some(base)) = (of_parts, base) else {
                return;
            };
            for ((part, distribution), rows) in parts.iter().zip(&of_parts).zip(&mut zero_widths) {
                if is_without_width(part.kind, distribution) {
                    rows.push(row + 1);
                }
            }
            let row = std::iter::once(base.into()).chain(of_parts);
            drawn.iter_mut().zip(row).for_each(|(drawn, distribution)| drawn.push(distribution));
        }
        if let (Some(part), Some(&total)) = (of_type_a.first(), totals.first()) {
            self.note_of_mean(&part.full, [of_readings, scatter], total, unit);
        }
        let same_elsewhere = !differs && self.conditions.rows() > 1;
        for (part, rows) in parts.iter().zip(&zero_widths) {
            self.note_of_zero_width(&part.full, rows, same_elsewhere);
        }
        for (part, drawn) in parts.iter().zip(drawn.iter().skip(1)) {
            if part.kind.name != "readings"
                && let (Some(of_part), Some(&total)) = (drawn.first(), totals.first())
            {
                let own = [of_part.mean(), of_part.standard_uncertainty()];
                self.note_of_estimate(&part.full, own, total, unit);
            }
            if part.kind.name == "result"
                && let Some(saved) = part.saved(unit, self.results)
            {
                self.note_of_saved_estimate(&part.full, saved, unit);
            }
            let shared = if differs { None } else { drawn.first() };
            let read = part.read.0.as_ref();
            self.note_of_readings(&part.object, unit, &part.full, part.kind, shared, read);
        }
        for (part, mut drawn) in drawn.into_iter().enumerate() {
            match drawn.pop() {
                Some(distribution) if !differs => {
                    self.inputs.known.always(first + part, distribution);
                }
                last => {
                    drawn.extend(last);
                    self.inputs.known.in_rows(first + part, drawn);
                }
            }
        }
    }

    /// Tells of readings whose mean is far from the estimate of their input, of which only the scatter
    /// counts. Deviations from it are no readings of the quantity.
    fn note_of_mean(&mut self, part: &str, [mean, u]: [f64; 2], total: f64, unit: &Unit) {
        let are_of_quantity = mean.abs() > DEVIATIONS * total.abs();
        // to the digits that sums of readings have
        let apart = (mean - total).abs() > 3.0 * u + 1e-12 * total.abs();
        if !(are_of_quantity && apart) {
            return;
        }
        let (name, [mean, estimate]) = (self.name, [mean, total].map(|of| in_unit(of, unit)));
        let fact = fact!("readings-apart", part, mean, estimate, name);
        self.inputs.warnings.push(Warning::new(name, fact));
    }

    /// Tells of a component whose own estimate is not 0: it is added to that of its input.
    fn note_of_estimate(&mut self, part: &str, [own, u]: [f64; 2], total: f64, unit: &Unit) {
        if own.abs() <= ROUNDING_OF_LIMITS * u {
            return;
        }
        let name = self.name;
        let [own, total, sum] = [own, total, own + total].map(|of| in_unit(of, unit));
        let fact = fact!("component-estimate", own, part, total, name, sum);
        self.inputs.warnings.push(Warning::new(name, fact));
    }

    /// Tells of a component that is a saved result with an estimate: only how it varies counts.
    fn note_of_saved_estimate(&mut self, part: &str, saved: f64, unit: &Unit) {
        if saved == 0.0 {
            return;
        }
        let fact = fact!("component-result", part, estimate = in_unit(saved, unit));
        self.inputs.warnings.push(Warning::new(self.name, fact));
    }

    /// The components as written, each with a variable of its own; `None` if one is faulty.
    fn parts(&mut self, unit: &Unit) -> Option<Vec<WrittenComponent<'a>>> {
        let object = self.object;
        let list = object.list("components")?;
        if list.len() > MOST_VARIABLES {
            let (what, found) = ("components", list.len());
            object.report(DiagnosticKind::TooMany { what, found, most: MOST_VARIABLES });
            return None;
        }
        let quantity = self.name;
        let diagnostic =
            |reason: String| DiagnosticKind::Component { name: quantity.to_owned(), reason };
        if list.is_empty() {
            object.report(DiagnosticKind::NoValues { name: format!("{}/components", self.name) });
        }
        let mut parts: Vec<WrittenComponent<'a>> = Vec::new();
        let mut names: HashSet<String> = HashSet::new();
        for node in list {
            if object.log.is_full() {
                break;
            }
            let Some(component) = Object::new(object.log, "a component", node, &node.span) else {
                continue;
            };
            let Some(name) = component.text("name") else {
                if component.get("name").is_none() {
                    component.report(diagnostic("needs a `name`".to_owned()));
                }
                continue;
            };
            let full = format!("{}/{name}", self.name);
            if name.is_empty() || name.contains('/') {
                component.report(diagnostic(format!("cannot have the name `{name}`")));
            } else if !names.insert(full.clone()) {
                component.report(diagnostic(format!("has the name `{name}` of another one")));
            } else if let Some(kind) = shapes::kind(&component) {
                if kind.name == "codata" {
                    let reason = "is a measured constant, which is an input of its own".to_owned();
                    component.report(diagnostic(reason));
                    continue;
                }
                let known: Vec<&str> =
                    keys::COMPONENT.into_iter().chain(kind.fields.iter().copied()).collect();
                keys::check_names(&component, &known);
                instrument::check(&component, kind, unit);
                let samples = self.samples(&component, &full, (unit, ValueOf::Difference), kind);
                let names = [full.as_str(), quantity];
                let Some(read) = self.readings_of_file(&component, &names, unit, kind) else {
                    continue;
                };
                let beside_others = list.len() > 1;
                let mut certificate = None;
                if kind.name == "dcc" {
                    certificate = self.results.of_certificate(&component);
                    let Some(of) = &certificate else { continue };
                    self.certified(&full, &component, Some(of));
                }
                let object = component;
                let read = (read, certificate);
                parts.push(WrittenComponent { object, full, kind, samples, read, beside_others });
            }
        }
        for part in &parts {
            let read = part.read.0.as_ref();
            self.variable(part.full.clone(), &part.object, Some(part.kind), read, unit);
        }
        (parts.len() == list.len() && !list.is_empty()).then_some(parts)
    }
}

/// What the middle of two limits about 0 may be off 0, in standard uncertainties.
const ROUNDING_OF_LIMITS: f64 = 1e-12;

/// A component as written.
struct WrittenComponent<'a> {
    object: Object<'a>,
    full: String,
    kind: &'static FileShape,
    samples: Option<Samples>,
    /// Readings of a file, and what is taken from a certificate.
    read: (Option<FileReadings>, Option<FromCertificate>),
    beside_others: bool,
}

impl WrittenComponent<'_> {
    /// Its distribution where the quantity's estimate is `total`, of which a share may be its
    /// width. A component's own mean is 0 unless it is given.
    fn distribution(
        &self,
        unit: &Unit,
        total: f64,
        results: &ResultFiles<'_>,
        at: (&dyn ConditionValues, usize),
    ) -> Option<Distribution> {
        let own = !self.kind.is_about_zero()
            || ["mean", "value", "lower"].iter().any(|key| self.object.get(key).is_some());
        let estimate = if own { Estimate::Own } else { Estimate::Given(0.0) };
        Fields {
            share_of: Some(total),
            samples: self.samples.as_ref(),
            read: self.read.0.as_ref(),
            certificate: self.read.1.as_ref(),
            beside_others: self.beside_others,
            at: Some(at),
            ..Fields::new(self.object, &self.full, unit, estimate, results)
        }
        .distribution(self.kind)
    }

    /// Whether the component has an estimate of its own: readings that are only summarized may have
    /// none.
    fn has_estimate(&self) -> bool {
        self.object.get("n").is_none() || self.object.get("mean").is_some()
    }

    /// The estimate of the saved result that it is.
    fn saved(&self, unit: &Unit, results: &ResultFiles<'_>) -> Option<f64> {
        results.distribution(&self.object, &self.full, unit, true).map(|saved| saved.mean())
    }
}

/// Whether a distribution has lost the width that its shape has.
fn is_without_width(kind: &FileShape, distribution: &Distribution) -> bool {
    let has_none = ["constant", "result", "dcc", "readings"].contains(&kind.name);
    !has_none && distribution.constant().is_some()
}

/// A value as notes show it.
fn in_unit(value: f64, unit: &Unit) -> Argument {
    Argument::Number(unit.after(&Shortest(decimal::to_15_digits(value)).to_string()))
}
