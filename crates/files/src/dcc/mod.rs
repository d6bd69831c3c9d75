//! A Digital Calibration Certificate as an input: value, uncertainty, coverage and distribution of a
//! quantity, or a table of it interpolated over a condition.

mod agreement;
mod chosen;
mod coverage;
mod definitions;
mod difference;
mod document;
mod intervals;
mod known;
mod law;
mod listing;
mod missing;
mod own;
mod quantities;
mod relative;
mod standing;

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use super::condition_values::ConditionValues;
use difference::TemperatureKind;
use document::Measured;
pub(super) use document::{Fault, parse, tag};
use gumption_engine::distribution::{
    Arcsine, Constant, Distribution, Invalid, Normal, Rectangular, Triangular,
};
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::number::{Shortest, smallest_first};
use gumption_text::named_shape::NamedShape;
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::{DiagnosticKind, Folder, Place, SourceText, bytes};
use gumption_units::Unit;
use known::{Interval, KnownValue, known};
pub(crate) use law::LAWS;
pub use listing::{CertificateListing, ListedPart, ListedQuantity, listing, listing_text};
use missing::QuantityRows;
pub(super) use own::Certified;
use own::OwnCertificate;
pub(super) use quantities::inputs;
use roxmltree::{Document, Node};
pub(crate) use standing::STATUSES;

/// The certificates that a model file names: name, text if it could be read, content.
#[derive(Debug, Default)]
pub(super) struct Certificates {
    read: HashMap<String, Option<Arc<SourceText>>>,
    /// Those that this program has made, by name.
    own: HashMap<String, Option<Arc<OwnCertificate>>>,
    /// Their content, by name.
    pub(super) files: Vec<(String, Vec<u8>)>,
}

impl Certificates {
    /// The text of a certificate; what cannot be read is reported where the file is named.
    fn text(&mut self, object: &Object<'_>, folder: Folder<'_>) -> Option<Arc<SourceText>> {
        let member = object.required("file")?;
        let name = object.text("file")?;
        if let Some(known) = self.read.get(name) {
            return known.clone();
        }
        let read = || {
            let unreadable = |message: String| {
                let message = format!("`{name}`: {message}");
                DiagnosticKind::Unreadable { message }
            };
            let bytes = folder.content(name, bytes::MOST)?;
            let text = bytes::text(&bytes).map_err(unreadable)?.into_owned();
            // without a byte-order mark
            let source = SourceText::new(folder.shown(name), &text);
            if !source.text.trim_start().starts_with('<') {
                return Err(unreadable("it is no XML".to_owned()));
            }
            Ok((source, bytes))
        };
        let found = match read() {
            Ok((text, bytes)) => {
                self.files.push((name.to_owned(), bytes));
                Some(text)
            }
            Err(kind) => {
                object.log.report(&member.value.span, kind);
                None
            }
        };
        self.read.insert(name.to_owned(), found.clone());
        found
    }
}

/// What an input takes from a certificate.
#[derive(Clone, Debug)]
pub(super) struct FromCertificate {
    /// The unit of the values.
    pub(super) unit: Unit,
    taken: Taken,
    source: Arc<SourceText>,
    span: Range<usize>,
    /// Its place in the certificate, as text.
    pub(super) place: String,
    /// Which result of a certificate of our own it is.
    pub(super) certified: Option<Certified>,
    /// Whether a standard uncertainty is that of a coverage interval, in place of U over k.
    pub(super) of_interval: bool,
    /// What the certificate calls a distribution that is not known here.
    pub(super) unknown_distribution: Option<String>,
    /// Whether it states no uncertainty, and is no nominal value.
    pub(super) is_without: bool,
    /// Whether a coverage interval is not symmetric about its value.
    pub(super) is_asymmetric: bool,
    /// Whether it is a difference of temperatures that the certificate gives in °C.
    pub(super) is_difference: bool,
    /// Whether it was found before an adjustment or a repair.
    pub(super) is_before: bool,
    temperature: TemperatureKind,
}

#[derive(Clone, Debug)]
enum Taken {
    /// One value, at this place of the lists.
    One(Box<Measured>, usize),
    /// Points of a table over a condition, in order.
    Table { condition: String, unit: Box<Unit>, points: Vec<TablePoint> },
}

/// A point of a table: abscissa, value, and what is known of it.
#[derive(Clone, Copy, Debug)]
struct TablePoint {
    x: f64,
    y: f64,
    known: KnownValue,
}

/// A table of a certificate: the unit of its abscissae, and points with abscissa, value and standard uncertainty.
pub(super) type CertifiedTable = (Unit, Vec<[f64; 3]>);

impl FromCertificate {
    /// The table over a condition, if one was asked for.
    pub(super) fn table(&self) -> Option<CertifiedTable> {
        let Taken::Table { unit, points, .. } = &self.taken else { return None };
        let points = points.iter().map(|point| [point.x, point.y, point.known.standard]);
        Some(((**unit).clone(), points.collect()))
    }

    /// What is to be borne in mind about it, as that of the quantity `name` from this file.
    pub(super) fn notes(&self, name: &str, file: &str) -> Vec<Fact> {
        let called = self.unknown_distribution.as_ref();
        let mut notes = Vec::new();
        notes.extend(self.of_interval.then(|| fact!("interval-uncertainty", name, file)));
        notes.extend(called.map(|called| fact!("certificate-distribution", name, file, called)));
        notes.extend(self.is_difference.then(|| fact!("certificate-difference", name, file)));
        notes.extend(self.is_without.then(|| fact!("certificate-exact", name, file)));
        notes.extend(self.is_before.then(|| fact!("certificate-before-adjustment", name, file)));
        notes.extend(self.is_asymmetric.then(|| fact!("certificate-asymmetric", name, file)));
        notes
    }
}

/// Reads what the object takes from a certificate; mistakes are reported, those of the certificate
/// at its element.
pub(super) fn read(
    object: &Object<'_>,
    folder: Folder<'_>,
    certificates: &mut Certificates,
) -> Option<FromCertificate> {
    let source = certificates.text(object, folder)?;
    let found = parsed(object, &source, &mut certificates.own);
    match found {
        Ok(found) => found,
        Err((span, reason)) => {
            let span = span.start..span.end.max(span.start);
            object.log.report_at(Place { source, span }, DiagnosticKind::Certificate { reason });
            None
        }
    }
}

/// Outside the fault of a certificate; inside `None` where the model file's has been reported.
fn parsed(
    object: &Object<'_>,
    source: &Arc<SourceText>,
    own: &mut HashMap<String, Option<Arc<OwnCertificate>>>,
) -> Result<Option<FromCertificate>, Fault> {
    let document = parse(&source.text)?;
    let all = document::quantities(&document);
    let Some(found) = chosen::quantities(object, &all) else { return Ok(None) };
    let measured: Vec<Measured> =
        found.iter().map(|node| document::measured(*node)).collect::<Result<_, _>>()?;
    let (chosen, mut measured) = intervals::left_out(found, measured, &all);
    if !chosen::is_one_table(object, &chosen, &measured, &all) {
        return Ok(None);
    }
    if !law::state(object, &mut measured)? {
        return Ok(None);
    }
    let Some(first) = measured.first() else { return Ok(None) };
    let (unit, span) = (first.unit.clone(), first.span.clone());
    if let Some(other) = measured.iter().find(|measured| measured.unit.text() != unit.text()) {
        let reason = "this quantity has another unit than the first one of its kind".to_owned();
        return Err((other.span.clone(), reason));
    }
    let temperature = temperature(object, &chosen, &measured)?;
    let is_difference = temperature == TemperatureKind::Difference && unit.is_celsius();
    let unit = temperature.unit(unit);
    if object.get("at").is_some() {
        for node in
            chosen.iter().filter(|_| measured.iter().all(|measured| measured.uncertainty.is_none()))
        {
            stated_elsewhere(own, source, &document, *node, 0)?;
        }
        let Some(table) = table(object, &chosen, &measured, &all)? else { return Ok(None) };
        let source = Arc::clone(source);
        let of_interval = measured.iter().any(|measured| measured.interval_taken(None).is_some());
        let is_asymmetric = measured.iter().any(|measured| {
            let mut intervals =
                (0..measured.values.len()).filter_map(|place| Interval::of(measured, place));
            intervals.any(Interval::is_asymmetric)
        });
        let is_exact = measured.iter().all(|measured| measured.uncertainty.is_none());
        let is_without = is_exact && !chosen.iter().all(|node| missing::is_nominal(*node));
        let unknown_distribution =
            measured.iter().find_map(|measured| measured.unknown_distribution(None));
        let numbers: Vec<String> = chosen.iter().map(|node| number(&all, *node)).collect();
        return Ok(Some(FromCertificate {
            unit,
            taken: table,
            source,
            span,
            place: format!("table of quantity {}", numbers.join(", ")),
            certified: None,
            of_interval,
            unknown_distribution,
            is_without,
            is_asymmetric,
            is_difference,
            is_before: standing::is_before(chosen[0]),
            temperature,
        }));
    }
    let count: usize = measured.iter().map(|measured| measured.values.len()).sum();
    let index = match object.get("index") {
        None if count == 1 => 0,
        None => {
            let reason = format!(
                "it has {count} values; say which by `index` (from 0), or `at` which condition the \
                 table is to be interpolated"
            );
            object.report(DiagnosticKind::Certificate { reason });
            return Ok(None);
        }
        Some(member) => {
            let Some(index) = object.whole("index", 0, 1 << 32) else { return Ok(None) };
            let index = index as usize;
            if index >= count {
                let reason = format!(
                    "there are {count} values, so that the index is from 0 to {}",
                    count - 1
                );
                object.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
                return Ok(None);
            }
            index
        }
    };
    let mut left = index;
    for (node, measured) in chosen.iter().zip(measured) {
        if left < measured.values.len() {
            let lacking = QuantityRows::new(&all).lacking(*node, &measured);
            if let Some(fault) = lacking.and_then(|lacking| lacking.fault(&measured, left)) {
                return Err(fault);
            }
            let is_without = !measured.is_uncertain(left) && !missing::is_nominal(*node);
            let certified = match is_without {
                true => stated_elsewhere(own, source, &document, *node, left)?,
                false => certified(own, source, &document, *node, left),
            };
            return Ok(Some(FromCertificate {
                unit,
                source: Arc::clone(source),
                span: measured.span.clone(),
                place: format!("quantity {}, value {left}", number(&all, *node)),
                certified,
                of_interval: measured.interval_taken(Some(left)).is_some(),
                unknown_distribution: measured.unknown_distribution(Some(left)),
                is_without,
                is_asymmetric: Interval::of(&measured, left).is_some_and(Interval::is_asymmetric),
                is_difference,
                is_before: standing::is_before(*node),
                temperature,
                taken: Taken::One(Box::new(measured), left),
            }));
        }
        left -= measured.values.len();
    }
    Ok(None)
}

/// The place of a quantity among all of the certificate, counted from 0.
fn number(all: &[Node<'_, '_>], node: Node<'_, '_>) -> String {
    all.iter().position(|other| *other == node).map_or(String::new(), |place| place.to_string())
}

/// Whether the quantities are temperatures or differences of temperatures.
///
/// # Errors
/// They are not the same, or not what the model file says.
fn temperature(
    object: &Object<'_>,
    chosen: &[Node<'_, '_>],
    measured: &[Measured],
) -> Result<TemperatureKind, Fault> {
    let stated = object.truth("difference");
    let mut found: Option<TemperatureKind> = None;
    for (node, measured) in chosen.iter().zip(measured) {
        let kind = difference::kind(*node, measured, stated)?;
        let known = found.get_or_insert_with(|| kind.clone());
        let is_difference = |kind: &TemperatureKind| *kind == TemperatureKind::Difference;
        if is_difference(known) != is_difference(&kind) {
            let reason = "of this quantity and the first one of its kind one is a difference of \
                          temperatures by its `refType` or its name: say by `difference` what they are"
                .to_owned();
            return Err((measured.span.clone(), reason));
        }
        if matches!(known, TemperatureKind::Value | TemperatureKind::NearZero(_))
            && kind != TemperatureKind::Value
        {
            *known = kind;
        }
    }
    Ok(found.unwrap_or(TemperatureKind::Value))
}

/// The result of a certificate of our own that a value is.
fn certified(
    own: &mut HashMap<String, Option<Arc<OwnCertificate>>>,
    source: &SourceText,
    document: &Document<'_>,
    node: Node<'_, '_>,
    place: usize,
) -> Option<Certified> {
    let own = own.entry(source.name.clone());
    let own = own.or_insert_with(|| OwnCertificate::of(document).map(Arc::new));
    own.as_ref()?.part(node, place)
}

/// As [`certified`], of a value without an uncertainty.
///
/// # Errors
/// It is a result of a certificate of our own, whose uncertainty stands in a text.
fn stated_elsewhere(
    own: &mut HashMap<String, Option<Arc<OwnCertificate>>>,
    source: &SourceText,
    document: &Document<'_>,
    node: Node<'_, '_>,
    place: usize,
) -> Result<Option<Certified>, Fault> {
    let Some(_) = certified(own, source, document, node, place) else { return Ok(None) };
    let reason = "the uncertainty of this result stands in the description of the certificate alone, as \
                  D-SI has no place for a coverage factor without a probability, or below 1: take the \
                  value with the U and k that are said there"
        .to_owned();
    Err((tag(node), reason))
}

/// The table over the condition that `at` names.
fn table<'d>(
    object: &Object<'_>,
    chosen: &[Node<'d, 'd>],
    measured: &[Measured],
    all: &[Node<'d, 'd>],
) -> Result<Option<Taken>, Fault> {
    let Some(condition) = object.text("at").map(str::to_owned) else { return Ok(None) };
    let mut points: Vec<TablePoint> = Vec::new();
    let are_exact =
        measured.iter().all(|measured| measured.uncertainty.is_none() && measured.unread.is_none());
    let mut rows = QuantityRows::new(all);
    let mut unit: Option<Unit> = None;
    // quantities beside each other have the same one beside them
    let parents: HashSet<_> =
        chosen.iter().map(|node| node.parent().map(|parent| parent.id())).collect();
    if parents.len() < chosen.len() {
        return Err(repeated(measured));
    }
    for (node, measured) in chosen.iter().zip(measured) {
        let Some(abscissa) = abscissa(object, *node, measured, &condition)? else {
            return Ok(None);
        };
        let own = unit.get_or_insert_with(|| abscissa.unit.clone()).clone();
        if own.text() != abscissa.unit.text() {
            let reason = "this quantity has another unit than that of the first point".to_owned();
            return Err((abscissa.span, reason));
        }
        let lacking = rows.lacking(*node, measured);
        for (place, (&x, &y)) in abscissa.values.iter().zip(&measured.values).enumerate() {
            let fault = |reason: String| (measured.span.clone(), reason);
            if let Some(fault) = lacking.as_ref().and_then(|lacking| lacking.fault(measured, place))
            {
                return Err(fault);
            }
            let known = match measured.is_uncertain(place) {
                true => known(measured, place)
                    .map_err(|reason| fault(format!("this quantity {reason}")))?,
                false if are_exact => KnownValue::EXACT,
                false => {
                    let others = "other points of the table";
                    return Err(fault(missing::without("this value", others)));
                }
            };
            points.push(TablePoint { x, y, known });
        }
    }
    smallest_first(&mut points, |point| point.x);
    if points.windows(2).any(|pair| pair[0].x == pair[1].x) {
        return Err(repeated(measured));
    }
    Ok(unit.map(|unit| Taken::Table { condition, unit: Box::new(unit), points }))
}

fn repeated(measured: &[Measured]) -> Fault {
    let span = measured.first().map_or(0..0, |measured| measured.span.clone());
    (span, "two points of this table have the same abscissa".to_owned())
}

/// The quantity that a table goes over: in the same list, equally many values; by the name of the
/// condition, else the reference or nominal value, else the only one.
fn abscissa<'d>(
    object: &Object<'_>,
    node: Node<'d, 'd>,
    of: &Measured,
    condition: &str,
) -> Result<Option<Measured>, Fault> {
    let beside = node.parent().into_iter().flat_map(|parent| parent.children());
    let beside =
        beside.filter(|sibling| sibling.tag_name().name() == "quantity" && *sibling != node);
    let beside: Vec<Node<'d, 'd>> = beside.collect();
    let among = |is_one: &dyn Fn(Node<'d, 'd>) -> bool| {
        let found: Vec<Node<'d, 'd>> =
            beside.iter().copied().filter(|sibling| is_one(*sibling)).collect();
        (!found.is_empty()).then_some(found)
    };
    let by_name = among(&|sibling| document::names(sibling).iter().any(|name| name == condition));
    let by_kind = || {
        ["basic_referenceValue", "basic_nominalValue"]
            .iter()
            .find_map(|kind| among(&|sibling| document::has_ref_type(sibling, kind)))
    };
    let only = || Some(beside.clone()).filter(|others| others.len() == 1);
    let Some(found) = by_name.or_else(by_kind).or_else(only) else {
        let reason = format!(
            "no quantity beside {} is the one to interpolate over: none is named `{condition}`, or \
             has the refType basic_referenceValue or basic_nominalValue",
            document::called(node)
        );
        let place = object.get("at").map_or(object.place(), |member| &member.value.span);
        object.log.report(place, DiagnosticKind::Certificate { reason });
        return Ok(None);
    };
    let read = || found.iter().map(|node| document::measured(*node));
    // one of several may be no number
    let mut read: Vec<Measured> = match read().filter_map(Result::ok).collect::<Vec<_>>() {
        none if none.is_empty() => read().collect::<Result<_, _>>()?,
        some => some,
    };
    // a list of something else, such as a single reference condition
    let is_whole = |one: &Measured| one.values.len() == of.values.len();
    if read.iter().any(is_whole) {
        read.retain(is_whole);
    }
    let mut read = read.into_iter();
    let Some(first) = read.next() else { return Ok(None) };
    if !is_whole(&first) {
        let reason = format!(
            "this quantity has {} values, the one over which it stands {}",
            first.values.len(),
            of.values.len()
        );
        return Err((first.span, reason));
    }
    for other in read {
        if let Some([one, another]) = agreement::contradiction(&first, &other) {
            let reason = format!(
                "the table of {} can be over this quantity or over another one beside it: one says {one}, \
                 this one {another}. Name the condition as one of them is named, or ask which is right",
                document::called(node)
            );
            return Err((other.span, reason));
        }
    }
    Ok(Some(first))
}

impl FromCertificate {
    /// The distribution in a row of the conditions, in the unit of the input.
    pub(super) fn distribution(
        &self,
        object: &Object<'_>,
        name: &str,
        unit: &Unit,
        at: Option<(&dyn ConditionValues, usize)>,
    ) -> Option<Distribution> {
        let factor = Unit::conversion_factor(&self.unit, unit);
        let factor = match factor.and_then(|by| Unit::convert(0.0, &self.unit, unit).map(|_| by)) {
            Ok(factor) => factor,
            Err(_) => {
                let diagnostic = DiagnosticKind::WrongDimension {
                    name: name.to_owned(),
                    found: unit.to_string(),
                    found_as: unit.describe(),
                    expected: self.unit.to_string(),
                    expected_as: self.unit.describe(),
                };
                let place = object.get("unit").map_or(object.place(), |member| &member.value.span);
                object.log.report(place, diagnostic);
                return None;
            }
        };
        if let Some(reason) = self.of_another_zero(unit) {
            let place = object.get("unit").map_or(object.place(), |member| &member.value.span);
            object.log.report(place, DiagnosticKind::Certificate { reason });
            return None;
        }
        let in_unit = |value: f64| Unit::convert(value, &self.unit, unit).unwrap_or(f64::NAN);
        let made = match &self.taken {
            Taken::One(of, place) => {
                let value = in_unit(of.values.get(*place).copied().unwrap_or(f64::NAN));
                match of.is_uncertain(*place) {
                    false => Constant::new(value).map(Into::into),
                    true => match known(of, *place) {
                        Ok(known) => shaped(value, known, factor),
                        Err(reason) => return self.fault(object, reason),
                    },
                }
            }
            Taken::Table { condition, unit: of, points } => {
                let (conditions, row) = at?;
                let x = self.condition(object, condition, of, conditions, row)?;
                let Some(TablePoint { y, known, .. }) = interpolated(points, x) else {
                    let ends = points.first().zip(points.last());
                    let (low, high) = ends.map_or((f64::NAN, f64::NAN), |(a, b)| (a.x, b.x));
                    let reason = format!(
                        "`{condition}` is {x} {of} in row {}, outside the certificate's range {low} \
                         to {high} {of}",
                        row + 1
                    );
                    let place = object.get("at").map_or(object.place(), |m| &m.value.span);
                    object.log.report(place, DiagnosticKind::Certificate { reason });
                    return None;
                };
                shaped(in_unit(y), known, factor)
            }
        };
        match made {
            Ok(distribution) => Some(distribution),
            Err(error) => self.fault(object, format!("makes no distribution: {error}")),
        }
    }

    /// Why values may not be given in a unit that counts from another zero: they are differences of
    /// temperatures, or may be.
    fn of_another_zero(&self, unit: &Unit) -> Option<String> {
        if self.unit.zero() == unit.zero() {
            return None;
        }
        match &self.temperature {
            TemperatureKind::Value => None,
            TemperatureKind::Difference => Some(format!(
                "the quantity of the certificate is a difference of temperatures, and {unit} counts from a \
                 zero: give it in K"
            )),
            TemperatureKind::Named(name) => Some(format!(
                "the quantity `{name}` of the certificate can be a temperature, whose zero is at another \
                 place in {unit} than in {}, or a difference of temperatures, which is the same in both: \
                 say which by `\"difference\": true` or `\"difference\": false`",
                self.unit
            )),
            TemperatureKind::NearZero(value) => Some(format!(
                "{} K of the certificate can be a difference of temperatures, or a temperature near absolute \
                 zero, which is another number in {unit}: say which by `\"difference\": true` or \
                 `\"difference\": false`",
                Shortest(*value)
            )),
        }
    }

    fn fault(&self, object: &Object<'_>, reason: String) -> Option<Distribution> {
        let reason = format!("this quantity {reason}");
        let place = Place { source: Arc::clone(&self.source), span: self.span.clone() };
        object.log.report_at(place, DiagnosticKind::Certificate { reason });
        None
    }

    /// The value of the condition in a row, in the unit of the table's abscissa.
    fn condition(
        &self,
        object: &Object<'_>,
        condition: &str,
        unit: &Unit,
        conditions: &dyn ConditionValues,
        row: usize,
    ) -> Option<f64> {
        let place = object.get("at").map_or(object.place(), |member| &member.value.span);
        let formula = object.log.formula(condition);
        let formula = formula.map_err(|error| DiagnosticKind::Formula { error });
        let formula = object.log.value(place, formula)?;
        if let Err(kinds) = conditions.check(&formula, unit, ValueOf::Quantity) {
            if row == 0 {
                kinds.into_iter().for_each(|kind| object.log.report(place, kind));
            }
            return None;
        }
        Some(conditions.value(&formula, row, unit, ValueOf::Quantity))
    }
}

/// The shape that a certificate states.
fn shaped(value: f64, known: KnownValue, factor: f64) -> Result<Distribution, Invalid> {
    let u = known.standard * factor;
    if u == 0.0 {
        return Constant::new(value).map(Into::into);
    }
    let named = match known.shape {
        Some(NamedShape::Known(name)) => name,
        _ => "",
    };
    match named {
        "rectangular" => Rectangular::new(value, u * 3.0_f64.sqrt()).map(Into::into),
        "triangular" => Triangular::new(value, u * 6.0_f64.sqrt()).map(Into::into),
        "arcsine" => Arcsine::new(value, u * 2.0_f64.sqrt()).map(Into::into),
        _ => Normal::with_dof(value, u, known.dof)
            .and_then(|normal| normal.stated_with(known.factor))
            .map(Into::into),
    }
}

/// On straight lines between the points, with the shape that both neighbours have; `None` outside. At a
/// point it is what is known there.
fn interpolated(points: &[TablePoint], x: f64) -> Option<TablePoint> {
    let [first, last] = [points.first()?, points.last()?];
    let slack = 1e-12 * (last.x - first.x);
    if !(x >= first.x - slack && x <= last.x + slack) {
        return None;
    }
    let x = x.clamp(first.x, last.x);
    let above = points.partition_point(|point| point.x < x);
    let b = points.get(above)?;
    let Some(a) = above.checked_sub(1).and_then(|below| points.get(below)) else { return Some(*b) };
    if b.x == x {
        return Some(*b);
    }
    let share = (x - a.x) / (b.x - a.x);
    let between = |a: f64, b: f64| a + share * (b - a);
    let known = KnownValue {
        standard: between(a.known.standard, b.known.standard),
        // the fewer degrees of freedom
        dof: a.known.dof.min(b.known.dof),
        shape: a.known.shape.filter(|shape| b.known.shape == Some(*shape)),
        factor: 1.0,
    };
    Some(TablePoint { x, y: between(a.y, b.y), known })
}

#[cfg(test)]
mod tests;
