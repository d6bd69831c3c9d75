//! The quantities of a Digital Calibration Certificate, versions 2.4 to 3.3.
//!
//! Elements are told by their local names, because the versions differ in namespaces and in where
//! they put things. Only what is asked for is read, so that an element that this program does not
//! know, or that is damaged, matters where it is wanted.

use std::ops::Range;

use super::agreement;
use crate::implied_dof::last_digit;
use crate::named_shape::NamedShape;
use gumption_units::Unit;
use roxmltree::{Document, Node};

/// What is wrong, and where in the text.
pub(crate) type Fault = (Range<usize>, String);

/// The values of a quantity, with what is stated of their uncertainty.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Where the quantity stands.
    pub(super) span: Range<usize>,
    pub(super) unit: Unit,
    pub(super) values: Vec<f64>,
    /// What one in the last written digit of each value is.
    pub(super) last_digits: Vec<f64>,
    pub(super) uncertainty: Option<Stated>,
}

/// Uncertainties of the values, in their unit.
#[derive(Clone, Debug, Default)]
pub(super) struct Stated {
    pub(super) expanded: Option<Vec<f64>>,
    pub(super) standard: Option<Vec<f64>>,
    pub(super) factors: Option<Vec<f64>>,
    pub(super) probabilities: Option<Vec<f64>>,
    pub(super) distributions: Option<Vec<String>>,
    /// What one in the last written digit of each expanded uncertainty, factor and probability is.
    pub(super) last_digits: [Option<Vec<f64>>; 3],
    /// The standard uncertainties of values whose coverage intervals stand in a quantity of their own.
    pub(super) of_interval: Vec<Option<f64>>,
}

impl Measured {
    /// The standard uncertainty of a coverage interval that is taken for a value, or for any of them.
    pub(super) fn interval_taken(&self, place: Option<usize>) -> Option<f64> {
        let stated = self.uncertainty.as_ref().filter(|stated| stated.standard.is_none())?;
        let mut places = stated.of_interval.iter().enumerate();
        places.find_map(|(at, u)| u.filter(|_| place.is_none_or(|place| place == at)))
    }

    /// What the distribution of a value, or of any of them, is called where that is not known.
    pub(super) fn unknown_distribution(&self, place: Option<usize>) -> Option<String> {
        let called = self.uncertainty.as_ref()?.distributions.as_ref()?.iter().enumerate();
        let mut of_place = called.filter(|(at, _)| place.is_none_or(|place| place == *at));
        let unknown = |text: &str| NamedShape::of(text) == Some(NamedShape::Unknown);
        of_place.find(|(_, text)| unknown(text)).map(|(_, text)| text.clone())
    }
}

/// Reads a text as a certificate.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Fault> {
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let line: usize = text
            .split_inclusive('\n')
            .take((at.row as usize).saturating_sub(1))
            .map(str::len)
            .sum();
        let rest = text.get(line..).unwrap_or_default();
        let column = rest.char_indices().nth((at.col as usize).saturating_sub(1));
        let at = line + column.map_or(0, |(at, _)| at);
        (at..at, format!("it is no well-formed XML: {error}"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "digitalCalibrationCertificate" {
        let reason = format!(
            "it is no Digital Calibration Certificate: its root is `{}`, not \
             `digitalCalibrationCertificate`",
            root.tag_name().name()
        );
        return Err((tag(root), reason));
    }
    let version = root.attribute("schemaVersion").unwrap_or_default();
    let mut numbers = version.split('.').map(|part| part.trim().parse::<u32>().unwrap_or(0));
    let version_number = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if !((2, 4)..=(3, u32::MAX)).contains(&version_number) {
        let reason = format!("its schema version is `{version}`; 2.4 to 3.3 can be read");
        return Err((tag(root), reason));
    }
    Ok(document)
}

/// The start tag of an element.
pub(crate) fn tag(node: Node<'_, '_>) -> Range<usize> {
    let range = node.range();
    let text = node.document().input_text();
    let inside = text.get(range.clone()).unwrap_or_default();
    let length = inside.find('>').map_or(inside.len(), |at| at + 1);
    range.start..range.start + length
}

/// All quantities, in the order of the text.
pub(super) fn quantities<'d>(document: &'d Document<'d>) -> Vec<Node<'d, 'd>> {
    document.descendants().filter(|node| node.tag_name().name() == "quantity").collect()
}

/// Whether one of an element's reference types is this one.
pub(super) fn has_ref_type(node: Node<'_, '_>, wanted: &str) -> bool {
    node.attribute("refType").is_some_and(|all| all.split_whitespace().any(|of| of == wanted))
}

/// The names of a quantity, in all languages.
pub(super) fn names(node: Node<'_, '_>) -> Vec<String> {
    let named = node.children().filter(|child| child.tag_name().name() == "name");
    let contents = named.flat_map(|name| name.children()).filter(Node::is_element);
    let named = contents.map(|content| content_of(content).trim().to_owned());
    named.filter(|name| !name.is_empty()).collect()
}

/// The text of an element: comments stand between parts of it, and end none.
fn content_of(element: Node<'_, '_>) -> String {
    element.children().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

/// What a message calls a quantity.
pub(super) fn called(node: Node<'_, '_>) -> String {
    let id = node.attribute("id").map(|id| format!("id `{id}`"));
    let kind = node.attribute("refType").map(|kind| format!("ref_type `{kind}`"));
    id.or(kind).unwrap_or_else(|| "one without id and ref_type".to_owned())
}

/// Reads the values of a quantity.
pub(super) fn measured(quantity: Node<'_, '_>) -> Result<Measured, Fault> {
    let fault = |reason: &str| (tag(quantity), format!("this quantity {reason}"));
    let none = || fault("has no real value (`si:real`, `si:constant` or a list of such)");
    let all = of_list(quantity, &tag(quantity))?.ok_or_else(none)?;
    if all.values.is_empty() {
        return Err(fault("has no value"));
    }
    Ok(all)
}

/// Reads what an element holds, one value behind the other; `None` where it holds none. What is of data
/// about the measurement is no value.
fn of_list(list: Node<'_, '_>, span: &Range<usize>) -> Result<Option<Measured>, Fault> {
    let mut all: Option<Measured> = None;
    for part in list.children().filter(Node::is_element) {
        let Some(next) = of_part(part, span)? else { continue };
        match &mut all {
            None => all = Some(next),
            Some(all) if all.unit.text() == next.unit.text() => join(all, next),
            Some(_) => {
                return Err((tag(part), "the values of a list have different units".to_owned()));
            }
        }
    }
    Ok(all)
}

fn of_part(part: Node<'_, '_>, span: &Range<usize>) -> Result<Option<Measured>, Fault> {
    match part.tag_name().name() {
        "real" | "constant" | "realListXMLList" => of_holder(part, span.clone()).map(Some),
        "list" => of_list(part, span),
        "hybrid" => of_hybrid(part, span),
        _ => Ok(None),
    }
}

/// Reads a hybrid, which says the same in several units: the first part, or the first with an
/// uncertainty, where the others do not contradict it.
fn of_hybrid(hybrid: Node<'_, '_>, span: &Range<usize>) -> Result<Option<Measured>, Fault> {
    let mut found: Option<Measured> = None;
    for part in hybrid.children().filter(Node::is_element) {
        let next = match (&found, of_part(part, span)) {
            (_, Ok(None)) => continue,
            (_, Ok(Some(next))) => next,
            (None, Err(fault)) => return Err(fault),
            // hybrids are there for units that D-SI does not have
            (Some(_), Err(_)) => continue,
        };
        let Some(first) = &found else {
            found = Some(next);
            continue;
        };
        if let Some([one, other]) = agreement::contradiction(first, &next) {
            let reason = format!(
                "this hybrid says {one} and {other}, which are not the same: ask which is right"
            );
            return Err((tag(part), reason));
        }
        if first.uncertainty.is_none() && next.uncertainty.is_some() {
            found = Some(next);
        }
    }
    Ok(found)
}

fn join(all: &mut Measured, next: Measured) {
    all.values.extend(next.values);
    all.last_digits.extend(next.last_digits);
    let both = all.uncertainty.as_mut().zip(next.uncertainty);
    let Some((all, next)) = both else {
        all.uncertainty = None;
        return;
    };
    let numbers = |all: &mut Option<Vec<f64>>, next: Option<Vec<f64>>| match (all.as_mut(), next) {
        (Some(all), Some(next)) => all.extend(next),
        _ => *all = None,
    };
    numbers(&mut all.expanded, next.expanded);
    numbers(&mut all.standard, next.standard);
    numbers(&mut all.factors, next.factors);
    numbers(&mut all.probabilities, next.probabilities);
    for (all, next) in all.last_digits.iter_mut().zip(next.last_digits) {
        numbers(all, next);
    }
    match (all.distributions.as_mut(), next.distributions) {
        (Some(all), Some(next)) => all.extend(next),
        _ => all.distributions = None,
    }
}

/// Reads a `real`, a `constant` or a list in one element.
fn of_holder(holder: Node<'_, '_>, span: Range<usize>) -> Result<Measured, Fault> {
    let values = numbers(holder, &["value", "valueXMLList"], None)?
        .ok_or_else(|| (tag(holder), "this has no value".to_owned()))?;
    let units = texts(holder, &["unit", "unitXMLList"])?;
    let Some((element, units)) = units else {
        return Err((tag(holder), "this has no unit".to_owned()));
    };
    let written = units.first().map_or("", String::as_str);
    if units.iter().any(|unit| unit != written) {
        return Err((tag(element), "the values of a list have different units".to_owned()));
    }
    let unit = Unit::parse_dsi(written)
        .or_else(|| defined(holder, written))
        .ok_or_else(|| (element.range(), format!("`{written}` is no unit of D-SI")))?;
    let count = Some(values.len());
    let expanded = ["uncertainty", "valueExpandedMU", "uncertaintyXMLList"];
    let expanded = [&expanded[..], &["valueExpandedMUXMLList"]].concat();
    let standard = ["standardUnc", "valueStandardMU", "standardUncXMLList"];
    let standard = [&standard[..], &["valueStandardMUXMLList"]].concat();
    let factors = ["coverageFactor", "coverageFactorXMLList"];
    let probabilities = ["coverageProbability", "coverageProbabilityXMLList"];
    let last_digits = |names: &[&str]| -> Result<Option<Vec<f64>>, Fault> {
        let words = texts(holder, names)?.map(|(_, words)| words);
        let digits = |words: Vec<String>| words.iter().map(|word| last_digit(word)).collect();
        Ok(words.map(|words| spread(digits(words), Some(values.len()))))
    };
    let [of_values, of_expanded, of_factors, of_probabilities] =
        [&["value", "valueXMLList"][..], &expanded, &factors, &probabilities].map(last_digits);
    let stated = Stated {
        last_digits: [of_expanded?, of_factors?, of_probabilities?],
        expanded: numbers(holder, &expanded, count)?,
        standard: numbers(holder, &standard, count)?,
        factors: numbers(holder, &factors, count)?,
        probabilities: numbers(holder, &probabilities, count)?,
        distributions: distributions(holder, count)?,
        of_interval: Vec::new(),
    };
    let uncertain = stated.expanded.is_some() || stated.standard.is_some();
    let last_digits = of_values?.unwrap_or_default();
    Ok(Measured { span, unit, values, last_digits, uncertainty: uncertain.then_some(stated) })
}

/// A unit that D-SI does not have, `|tex`, by its definition in the quantity, `tex = 1e-6 kg m^-1`.
fn defined(holder: Node<'_, '_>, written: &str) -> Option<Unit> {
    let name = written.strip_prefix('|')?;
    let quantity = holder.ancestors().find(|of| of.tag_name().name() == "quantity")?;
    let definition = quantity.descendants().find(|of| of.tag_name().name() == "nonSIDefinition")?;
    let definition = content_of(definition);
    let (_, size) = definition.split_once('=')?;
    let size = Unit::parse(size.trim()).ok()?;
    // a product of units has no name of its own
    Some(Unit::defined(name, &size).unwrap_or(size))
}

/// One value for all, where a list has one.
fn spread<T: Clone>(all: Vec<T>, count: Option<usize>) -> Vec<T> {
    match (all.as_slice(), count) {
        ([one], Some(count)) => vec![one.clone(); count],
        _ => all,
    }
}

/// What the distributions of values are called: one name, which may have several words, or a list.
fn distributions(holder: Node<'_, '_>, count: Option<usize>) -> Result<Option<Vec<String>>, Fault> {
    let found = texts(holder, &["distribution", "distributionXMLList"])?;
    Ok(found.map(|(element, words)| match element.tag_name().name() {
        "distribution" => spread(vec![words.join(" ")], count),
        _ => spread(words, count),
    }))
}

/// The words of the element below with one of these names.
///
/// # Errors
/// Another one says something else, so that their order would decide; what is in it is no text alone.
fn texts<'d>(
    holder: Node<'d, 'd>,
    names: &[&str],
) -> Result<Option<(Node<'d, 'd>, Vec<String>)>, Fault> {
    let words = |element: Node<'d, 'd>| -> Vec<String> {
        content_of(element).split_whitespace().map(str::to_owned).collect()
    };
    let mut elements = holder.descendants().filter(|of| names.contains(&of.tag_name().name()));
    let Some(element) = elements.next() else { return Ok(None) };
    let found = words(element);
    if let Some(inside) = element.children().find(Node::is_element) {
        let (name, inner) = (element.tag_name().name(), inside.tag_name().name());
        return Err((tag(inside), format!("`{inner}` has no place in `{name}`, which is a text")));
    }
    let is_same = |a: &String, b: &String| {
        let both = a.parse::<f64>().ok().zip(b.parse::<f64>().ok());
        a == b || both.is_some_and(|(a, b)| a == b)
    };
    for other in elements {
        let again = words(other);
        let count = found.len().max(again.len());
        let both = [&found, &again].map(|words| spread(words.clone(), Some(count)));
        let are_same = both[0].len() == both[1].len()
            && both[0].iter().zip(&both[1]).all(|(a, b)| is_same(a, b));
        if !are_same {
            let shown = |words: &[String]| -> String { words.join(" ").chars().take(40).collect() };
            let reason = format!(
                "`{}` is `{}` and, here, `{}` of the same value: ask which is right",
                element.tag_name().name(),
                shown(&found),
                shown(&again)
            );
            return Err((other.range(), reason));
        }
    }
    Ok(Some((element, found)))
}

fn numbers(
    holder: Node<'_, '_>,
    names: &[&str],
    count: Option<usize>,
) -> Result<Option<Vec<f64>>, Fault> {
    let Some((element, words)) = texts(holder, names)? else { return Ok(None) };
    let name = element.tag_name().name();
    let number = |word: String| {
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            let shown: String = word.chars().take(40).collect();
            (element.range(), format!("`{shown}` in `{name}` is not a finite number"))
        })
    };
    let found: Vec<f64> = words.into_iter().map(number).collect::<Result<_, Fault>>()?;
    let found = spread(found, count);
    if found.is_empty() {
        return Err((element.range(), format!("`{name}` is empty")));
    }
    match count {
        Some(count) if found.len() != count => {
            let reason = format!("`{name}` has {} numbers for {count} values", found.len());
            Err((element.range(), reason))
        }
        _ => Ok(Some(found)),
    }
}
