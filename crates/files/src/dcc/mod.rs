//! A Digital Calibration Certificate as an input: value, uncertainty, coverage and distribution of a
//! quantity, or a table of it interpolated over a condition.

mod agreement;
mod document;
mod intervals;
mod own;
mod quantities;

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use super::condition_values::ConditionValues;
use super::folder::Folder;
use super::implied_dof::Factor;
use super::named_shape::NamedShape;
use super::object::Object;
use super::source::{Place, SourceText};
use super::value_text::ValueOf;
use super::{DiagnosticKind, bytes};
pub(super) use document::{Fault, parse, tag};
use document::{Measured, Stated};
use gumption_engine::distribution::{
    Arcsine, Constant, Distribution, Invalid, Normal, Rectangular, Triangular,
};
use gumption_engine::number::smallest_first;
use gumption_engine::special;
use gumption_units::{Unit, nearest};
pub(super) use own::Certified;
use own::OwnCertificate;
pub(super) use quantities::inputs;
use roxmltree::Node;

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
            if !text.trim_start().starts_with('<') {
                return Err(unreadable("it is no XML".to_owned()));
            }
            Ok((SourceText::new(folder.shown(name), &text), bytes))
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
    /// Which result of a certificate of our own it is.
    pub(super) certified: Option<Certified>,
    /// Whether a standard uncertainty is that of a coverage interval, in place of U over k.
    pub(super) of_interval: bool,
    /// What the certificate calls a distribution that is not known here.
    pub(super) unknown_distribution: Option<String>,
}

#[derive(Clone, Debug)]
enum Taken {
    /// One value, at this place of the lists.
    One(Box<Measured>, usize),
    /// Points of a table over a condition, in order: abscissa, value, standard uncertainty, degrees
    /// of freedom. Between them is the shape that all of them have.
    Table { condition: String, unit: Box<Unit>, points: Vec<[f64; 4]>, shape: Option<NamedShape> },
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
    let Some(chosen) = chosen(object, &all) else { return Ok(None) };
    let measured: Vec<Measured> =
        chosen.iter().map(|node| document::measured(*node)).collect::<Result<_, _>>()?;
    let (chosen, measured) = intervals::left_out(chosen, measured, &all);
    let Some(first) = measured.first() else { return Ok(None) };
    let (unit, span) = (first.unit.clone(), first.span.clone());
    if let Some(other) = measured.iter().find(|of| of.unit.text() != unit.text()) {
        let reason = "this quantity has another unit than the first one of its kind".to_owned();
        return Err((other.span.clone(), reason));
    }
    if object.get("at").is_some() {
        let Some(table) = table(object, &chosen, &measured, &all)? else { return Ok(None) };
        let source = Arc::clone(source);
        let of_interval = measured.iter().any(|of| of.interval_taken(None).is_some());
        let unknown_distribution = measured.iter().find_map(|of| of.unknown_distribution(None));
        return Ok(Some(FromCertificate {
            unit,
            taken: table,
            source,
            span,
            certified: None,
            of_interval,
            unknown_distribution,
        }));
    }
    let count: usize = measured.iter().map(|of| of.values.len()).sum();
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
    for (node, of) in chosen.iter().zip(measured) {
        if left < of.values.len() {
            let (source, span) = (Arc::clone(source), of.span.clone());
            let of_interval = of.interval_taken(Some(left)).is_some();
            let unknown_distribution = of.unknown_distribution(Some(left));
            let taken = Taken::One(Box::new(of), left);
            let own = own.entry(source.name.clone());
            let own = own.or_insert_with(|| OwnCertificate::of(&document).map(Arc::new));
            let certified = own.as_ref().and_then(|own| own.part(*node, left));
            return Ok(Some(FromCertificate {
                unit,
                taken,
                source,
                span,
                certified,
                of_interval,
                unknown_distribution,
            }));
        }
        left -= of.values.len();
    }
    Ok(None)
}

/// The quantities that the object names; `None` where a mistake has been reported.
fn chosen<'d>(object: &Object<'_>, all: &[Node<'d, 'd>]) -> Option<Vec<Node<'d, 'd>>> {
    let report = |key: &str, reason: String| {
        let place = object.get(key).map_or(object.place(), |member| &member.value.span);
        object.log.report(place, DiagnosticKind::Certificate { reason });
        None
    };
    if let (Some(_), Some(second)) = (object.get("id"), object.get("ref_type")) {
        let diagnostic = DiagnosticKind::Exclusive { first: "id", second: "ref_type" };
        object.log.report(&second.key_span, diagnostic);
        return None;
    }
    let suggest = |wanted: &str, known: Vec<&str>| match nearest(wanted, known.iter().copied()) {
        Some(near) => format!("; did you mean `{near}`?"),
        None if known.is_empty() => String::new(),
        None => format!("; there are {}", known[..known.len().min(12)].join(", ")),
    };
    if let Some(member) = object.get("quantity") {
        let others = ["id", "ref_type"].into_iter().find(|key| object.get(key).is_some());
        if let Some(first) = others {
            let diagnostic = DiagnosticKind::Exclusive { first, second: "quantity" };
            object.log.report(&member.key_span, diagnostic);
            return None;
        }
        let place = object.whole("quantity", 0, 1 << 32)? as usize;
        let Some(one) = all.get(place) else {
            let reason = format!("the certificate has {} quantities, counted from 0", all.len());
            return report("quantity", reason);
        };
        return Some(vec![*one]);
    }
    if object.get("id").is_some() {
        let wanted = object.text("id")?;
        let has = |node: &&Node<'d, 'd>| {
            let mut inside = node.descendants();
            inside.any(|of| of.attribute("id") == Some(wanted))
        };
        let found: Vec<Node<'d, 'd>> = all.iter().filter(has).copied().collect();
        if found.is_empty() {
            let known = all.iter().filter_map(|node| node.attribute("id")).collect();
            let known = suggest(wanted, known);
            return report("id", format!("no quantity has the id `{wanted}`{known}"));
        }
        return Some(found);
    }
    if object.get("ref_type").is_some() {
        let wanted = object.text("ref_type")?;
        let has = |node: &&Node<'d, 'd>| {
            let mut around = node.ancestors().take(3);
            around.any(|of| document::has_ref_type(of, wanted))
        };
        let found: Vec<Node<'d, 'd>> = all.iter().filter(has).copied().collect();
        if found.is_empty() {
            let mut known: Vec<&str> =
                all.iter().filter_map(|node| node.attribute("refType")).collect();
            known.dedup();
            let known = suggest(wanted, known);
            return report("ref_type", format!("no quantity has the refType `{wanted}`{known}"));
        }
        return Some(found);
    }
    match all {
        [one] => Some(vec![*one]),
        _ => {
            let shown: Vec<String> = all.iter().take(8).map(|of| document::called(*of)).collect();
            let reason = format!(
                "the certificate has {} quantities; name one by its `id` or `ref_type`, or by its place as \
                 `quantity`, from 0: {}{}",
                all.len(),
                shown.join(", "),
                if all.len() > 8 { ", ..." } else { "" }
            );
            report("file", reason)
        }
    }
}

/// The table over the condition that `at` names.
fn table<'d>(
    object: &Object<'_>,
    chosen: &[Node<'d, 'd>],
    measured: &[Measured],
    all: &[Node<'d, 'd>],
) -> Result<Option<Taken>, Fault> {
    let Some(condition) = object.text("at").map(str::to_owned) else { return Ok(None) };
    let mut points: Vec<[f64; 4]> = Vec::new();
    let mut shapes: Vec<Option<NamedShape>> = Vec::new();
    let mut unit: Option<Unit> = None;
    for (node, of) in chosen.iter().zip(measured) {
        let Some(abscissa) = abscissa(object, *node, of, all, &condition)? else { return Ok(None) };
        let own = unit.get_or_insert_with(|| abscissa.unit.clone()).clone();
        if own.text() != abscissa.unit.text() {
            let reason = "this quantity has another unit than that of the first point".to_owned();
            return Err((abscissa.span, reason));
        }
        for (place, (&x, &y)) in abscissa.values.iter().zip(&of.values).enumerate() {
            let (u, dof) = match &of.uncertainty {
                None => (0.0, f64::INFINITY),
                Some(stated) => {
                    let known = known(stated, place).map_err(|reason| (of.span.clone(), reason))?;
                    shapes.push(known.shape);
                    (known.standard, known.dof)
                }
            };
            points.push([x, y, u, dof]);
        }
    }
    smallest_first(&mut points, |point| point[0]);
    if points.windows(2).any(|pair| pair[0][0] == pair[1][0]) {
        let span = measured.first().map_or(0..0, |of| of.span.clone());
        let reason = "two points of this table have the same abscissa".to_owned();
        return Err((span, reason));
    }
    let first = shapes.first().copied().flatten();
    let shape = first.filter(|_| shapes.iter().all(|shape| *shape == first));
    Ok(unit.map(|unit| Taken::Table { condition, unit: Box::new(unit), points, shape }))
}

/// The quantity that a table goes over: in the same list, equally many values; by the name of the
/// condition, else the reference or nominal value, else the only one.
fn abscissa<'d>(
    object: &Object<'_>,
    node: Node<'d, 'd>,
    of: &Measured,
    all: &[Node<'d, 'd>],
    condition: &str,
) -> Result<Option<Measured>, Fault> {
    let parent = node.parent();
    let beside: Vec<Node<'d, 'd>> =
        all.iter().filter(|other| other.parent() == parent && **other != node).copied().collect();
    let among = |is_one: &dyn Fn(Node<'d, 'd>) -> bool| {
        let found: Vec<Node<'d, 'd>> = beside.iter().copied().filter(|of| is_one(*of)).collect();
        (!found.is_empty()).then_some(found)
    };
    let by_name = among(&|of| document::names(of).iter().any(|name| name == condition));
    let by_kind = || {
        ["basic_referenceValue", "basic_nominalValue"]
            .iter()
            .find_map(|kind| among(&|of| document::has_ref_type(of, kind)))
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

/// What is known of one value.
struct Known {
    standard: f64,
    dof: f64,
    shape: Option<NamedShape>,
    /// What the expanded uncertainty was divided by.
    factor: f64,
}

fn known(stated: &Stated, place: usize) -> Result<Known, String> {
    let at = |all: &Option<Vec<f64>>| all.as_ref().and_then(|all| all.get(place)).copied();
    let texts = stated.distributions.as_ref();
    let shape = texts.and_then(|all| all.get(place)).and_then(|text| NamedShape::of(text));
    let is_t = shape == Some(NamedShape::Student);
    let probability = at(&stated.probabilities);
    if let Some(p) = probability
        && !(p > 0.0 && p < 1.0)
    {
        return Err(format!("has a coverage probability of {p}, which must be between 0 and 1"));
    }
    let normal = |p: f64| special::student::two_sided_factor(p, f64::INFINITY);
    let factor = match (at(&stated.factors), probability) {
        (Some(k), _) if k > 0.0 => k,
        (Some(k), _) => return Err(format!("has a coverage factor of {k}, which must be above 0")),
        (None, Some(p)) => normal(p),
        (None, None) => 1.0,
    };
    let last_digits = stated.last_digits.each_ref().map(|all| at(all).unwrap_or(0.0));
    let [of_expanded, of_factor, of_probability] = last_digits;
    let (standard, factor) = match (at(&stated.standard), at(&stated.expanded)) {
        (Some(u), Some(expanded))
            if at(&stated.factors).is_some()
                && (expanded / factor - u).abs() > agreement::ROUNDED * u =>
        {
            (intervals::agreeing(u, (expanded, factor), [of_expanded, of_factor])?, 1.0)
        }
        (Some(standard), _) => (standard, 1.0),
        (None, Some(_)) if stated.factors.is_none() && probability.is_none() => {
            let reason = "has an expanded uncertainty without a coverage factor or probability";
            return Err(reason.to_owned());
        }
        (None, Some(expanded)) => match stated.of_interval.get(place).copied().flatten() {
            Some(u) => (intervals::agreeing(u, (expanded, factor), [of_expanded, of_factor])?, 1.0),
            None => (expanded / factor, factor),
        },
        (None, None) => return Err("has no uncertainty".to_owned()),
    };
    if !(standard >= 0.0 && standard.is_finite()) {
        return Err(format!("has a standard uncertainty of {standard}"));
    }
    // a standard uncertainty that is stated has not been divided by the factor
    let divided = at(&stated.standard).is_none() && at(&stated.factors) == Some(factor);
    let dof = match probability {
        Some(p) if divided && (is_t || shape.is_none()) => {
            let stated = Factor::new(factor, of_factor);
            if is_t { stated.dof(p) } else { stated.dof_of_nothing_named(p, of_probability) }
        }
        _ => f64::INFINITY,
    };
    Ok(Known { standard, dof, shape, factor })
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
        let in_unit = |value: f64| Unit::convert(value, &self.unit, unit).unwrap_or(f64::NAN);
        let made = match &self.taken {
            Taken::One(of, place) => {
                let value = in_unit(of.values.get(*place).copied().unwrap_or(f64::NAN));
                match &of.uncertainty {
                    None => Constant::new(value).map(Into::into),
                    Some(stated) => match known(stated, *place) {
                        Ok(known) => shaped(value, known, factor),
                        Err(reason) => return self.fault(object, reason),
                    },
                }
            }
            Taken::Table { condition, unit: of, points, shape } => {
                let (conditions, row) = at?;
                let x = self.condition(object, condition, of, (conditions, row))?;
                let Some([_, y, u, dof]) = interpolated(points, x) else {
                    let ends = points.first().zip(points.last());
                    let (low, high) = ends.map_or((f64::NAN, f64::NAN), |(a, b)| (a[0], b[0]));
                    let reason = format!(
                        "`{condition}` is {x} {of} in row {}, outside the certificate's range {low} \
                         to {high} {of}",
                        row + 1
                    );
                    let place = object.get("at").map_or(object.place(), |m| &m.value.span);
                    object.log.report(place, DiagnosticKind::Certificate { reason });
                    return None;
                };
                let known = Known { standard: u, dof, shape: *shape, factor: 1.0 };
                shaped(in_unit(y), known, factor)
            }
        };
        match made {
            Ok(distribution) => Some(distribution),
            Err(error) => self.fault(object, format!("makes no distribution: {error}")),
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
        (conditions, row): (&dyn ConditionValues, usize),
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
fn shaped(value: f64, known: Known, factor: f64) -> Result<Distribution, Invalid> {
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

/// On straight lines between the points; `None` outside.
fn interpolated(points: &[[f64; 4]], x: f64) -> Option<[f64; 4]> {
    let [first, last] = [points.first()?, points.last()?];
    let slack = 1e-12 * (last[0] - first[0]);
    if !(x >= first[0] - slack && x <= last[0] + slack) {
        return None;
    }
    let above = points.partition_point(|point| point[0] <= x).clamp(1, points.len().max(2) - 1);
    let (a, b) = (points.get(above - 1)?, points.get(above).unwrap_or(first));
    if points.len() == 1 || x == a[0] {
        return Some(*a);
    }
    let share = (x - a[0]) / (b[0] - a[0]);
    let between = |which: usize| a[which] + share * (b[which] - a[which]);
    // the fewer degrees of freedom
    Some([x, between(1), between(2), a[3].min(b[3])])
}

#[cfg(test)]
mod tests;
