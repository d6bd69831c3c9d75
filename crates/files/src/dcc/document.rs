//! The quantities of a Digital Calibration Certificate, versions 2.4 to 3.3.
//!
//! Elements are told by their local names, because the versions differ in namespaces and in where
//! they put things. Only what is asked for is read, so that an element that this program does not
//! know, or that is damaged, matters where it is wanted.

use std::ops::Range;

use super::{agreement, definitions, relative};
use gumption_text::implied_dof::last_digit;
use gumption_text::named_shape::NamedShape;
use gumption_text::xml_limits;
use gumption_units::Unit;
use roxmltree::{Document, Node};

/// What is wrong, and where in the text.
pub(crate) type Fault = (Range<usize>, String);

/// How deep lists and hybrids may stand in each other.
const DEEPEST: usize = 64;

/// Blanks of XML; a space that does not break stands within a word.
pub(super) const BLANKS: [char; 4] = [' ', '\t', '\n', '\r'];

/// A number for each value; none where nothing is stated of it, or of all behind the end.
pub(super) type NumberColumn = Vec<Option<f64>>;

/// The number of a value.
pub(super) fn at(column: &NumberColumn, place: usize) -> Option<f64> {
    column.get(place).copied().flatten()
}

/// The values of a quantity, with what is stated of their uncertainty.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Where the quantity stands.
    pub(super) span: Range<usize>,
    pub(super) unit: Unit,
    pub(super) values: Vec<f64>,
    /// What one in the last written digit of each value is.
    pub(super) last_digits: Vec<f64>,
    pub(super) uncertainty: Option<StatedUncertainties>,
    /// What is stated of their uncertainty in a way that is not read; it matters where a value has no
    /// other one.
    pub(super) unread: Option<Fault>,
    /// Whether it is a difference of temperatures by the parts of a hybrid: 0.1 °C and 0.1 K.
    pub(super) is_difference: bool,
}

/// Uncertainties of the values, in their unit.
#[derive(Clone, Debug, Default)]
pub(super) struct StatedUncertainties {
    pub(super) expanded: NumberColumn,
    pub(super) standard: NumberColumn,
    pub(super) factors: NumberColumn,
    pub(super) probabilities: NumberColumn,
    /// The ends of coverage intervals.
    pub(super) ends: [NumberColumn; 2],
    /// What the distributions are called; empty where nothing is said.
    pub(super) distributions: Vec<String>,
    /// What one in the last written digit of these is.
    pub(super) last_digits: LastDigits,
    /// The standard uncertainties of values whose coverage intervals stand in a quantity of their own.
    pub(super) of_interval: NumberColumn,
}

/// What one in the last written digit is.
#[derive(Clone, Debug, Default)]
pub(super) struct LastDigits {
    pub(super) expanded: NumberColumn,
    pub(super) standard: NumberColumn,
    pub(super) factors: NumberColumn,
    pub(super) probabilities: NumberColumn,
    pub(super) ends: [NumberColumn; 2],
}

impl StatedUncertainties {
    fn columns(&mut self) -> [&mut NumberColumn; 13] {
        let digits = &mut self.last_digits;
        let [low, high] = &mut self.ends;
        let [of_low, of_high] = &mut digits.ends;
        [
            &mut self.expanded,
            &mut self.standard,
            &mut self.factors,
            &mut self.probabilities,
            low,
            high,
            &mut self.of_interval,
            &mut digits.expanded,
            &mut digits.standard,
            &mut digits.factors,
            &mut digits.probabilities,
            of_low,
            of_high,
        ]
    }

    /// What the distribution of a value is called.
    pub(super) fn called(&self, place: usize) -> Option<&str> {
        self.distributions.get(place).map(String::as_str).filter(|text| !text.is_empty())
    }

    /// Adds what is stated of further values, behind so many.
    fn join(&mut self, mut next: Self, [count, further]: [usize; 2]) {
        for (all, next) in self.columns().into_iter().zip(next.columns()) {
            if all.is_empty() && next.is_empty() {
                continue;
            }
            all.resize(count, None);
            all.append(next);
            all.resize(count + further, None);
        }
        self.distributions.resize(count, String::new());
        self.distributions.append(&mut next.distributions);
    }
}

impl Measured {
    /// Whether something is stated of the uncertainty of a value.
    pub(super) fn is_uncertain(&self, place: usize) -> bool {
        let stated = self.uncertainty.as_ref();
        stated.is_some_and(|stated| {
            at(&stated.expanded, place).or(at(&stated.standard, place)).is_some()
        })
    }

    /// The standard uncertainty of a coverage interval that is taken for a value, or for any of them.
    pub(super) fn interval_taken(&self, place: Option<usize>) -> Option<f64> {
        let stated = self.uncertainty.as_ref()?;
        let mut places = stated.of_interval.iter().enumerate();
        places.find_map(|(number, u)| {
            u.filter(|_| place.is_none_or(|place| place == number))
                .filter(|_| at(&stated.standard, number).is_none())
        })
    }

    /// What the distribution of a value, or of any of them, is called where that is not known.
    pub(super) fn unknown_distribution(&self, place: Option<usize>) -> Option<String> {
        let called = self.uncertainty.as_ref()?.distributions.iter().enumerate();
        let mut of_place = called.filter(|(at, _)| place.is_none_or(|place| place == *at));
        let unknown = |text: &str| NamedShape::of(text) == Some(NamedShape::Unknown);
        of_place.find(|(_, text)| unknown(text)).map(|(_, text)| text.clone())
    }
}

/// Reads a text as a certificate.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Fault> {
    xml_limits::check(text).map_err(|excess| (excess.at..excess.at, excess.reason))?;
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
    node.attribute("refType")
        .is_some_and(|all| all.split(BLANKS).any(|reference| reference == wanted))
}

/// The names of an element, in all languages; they stand before what it holds, which may be very much.
pub(super) fn names(node: Node<'_, '_>) -> Vec<String> {
    let is_content = |node: &Node<'_, '_>| ["quantity", "list"].contains(&node.tag_name().name());
    let before = node.children().take_while(|child| !is_content(child));
    let named = before.filter(|child| child.tag_name().name() == "name");
    let contents = named.flat_map(|name| name.children()).filter(Node::is_element);
    let named = contents.map(|content| content_of(content).trim().to_owned());
    named.filter(|name| !name.is_empty()).collect()
}

/// The text of an element: comments stand between parts of it, and end none.
pub(super) fn content_of(element: Node<'_, '_>) -> String {
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
    let mut all = of_list(quantity, &tag(quantity), 0)?.ok_or_else(none)?;
    if all.values.is_empty() {
        return Err(fault("has no value"));
    }
    relative::compare(quantity, &mut all)?;
    Ok(all)
}

/// Reads what an element holds, one value behind the other; `None` where it holds none. What is of data
/// about the measurement is no value.
fn of_list(
    list: Node<'_, '_>,
    span: &Range<usize>,
    depth: usize,
) -> Result<Option<Measured>, Fault> {
    let mut all: Option<Measured> = None;
    let mut unread = None;
    for part in list.children().filter(Node::is_element) {
        let Some(next) = of_part(part, span, depth)? else {
            let is_of_list = list.tag_name().name() != "quantity" && !is_of_each(part);
            unread = unread.or_else(|| unread_in(part).filter(|_| is_of_list));
            continue;
        };
        match &mut all {
            None => all = Some(next),
            Some(all) if all.unit.text() == next.unit.text() => join(all, next),
            Some(_) => {
                return Err((tag(part), "the values of a list have different units".to_owned()));
            }
        }
    }
    if let Some(all) = &mut all {
        all.unread = all.unread.take().or(unread);
    }
    Ok(all)
}

fn of_part(
    part: Node<'_, '_>,
    span: &Range<usize>,
    depth: usize,
) -> Result<Option<Measured>, Fault> {
    if depth > DEEPEST {
        let reason = format!(
            "lists and hybrids stand in each other more than {DEEPEST} deep here, which is the most \
             that is read"
        );
        return Err((tag(part), reason));
    }
    match part.tag_name().name() {
        "real" | "constant" | "realListXMLList" => of_holder(part, span.clone()).map(Some),
        "list" | "realList" => of_list(part, span, depth + 1),
        "hybrid" => of_hybrid(part, span, depth + 1),
        _ => Ok(None),
    }
}

/// Reads a hybrid, which says the same in several units: the first part, or the first with an
/// uncertainty, where the others do not contradict it. Parts in units that are not known are passed by,
/// as hybrids are there for units that D-SI does not have.
fn of_hybrid(
    hybrid: Node<'_, '_>,
    span: &Range<usize>,
    depth: usize,
) -> Result<Option<Measured>, Fault> {
    let mut found: Option<Measured> = None;
    let mut unknown: Option<Fault> = None;
    for part in hybrid.children().filter(Node::is_element) {
        let next = match of_part(part, span, depth) {
            Ok(None) => continue,
            Ok(Some(next)) => next,
            Err(fault) if has_unknown_unit(part) => {
                unknown.get_or_insert(fault);
                continue;
            }
            Err(fault) => return Err(fault),
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
        let is_difference = first.is_difference || agreement::is_difference([first, &next]);
        if first.uncertainty.is_none() && next.uncertainty.is_some() {
            found = Some(next);
        }
        if let Some(found) = &mut found {
            found.is_difference = is_difference;
        }
    }
    match (found, unknown) {
        (None, Some(fault)) => Err(fault),
        (found, _) => Ok(found),
    }
}

/// Whether a part of a hybrid has a unit that is not known.
fn has_unknown_unit(part: Node<'_, '_>) -> bool {
    let units =
        part.descendants().filter(|descendant| UNITS.contains(&descendant.tag_name().name()));
    let is_unknown = |element: Node<'_, '_>| {
        let written = content_of(element);
        let written = written.trim_matches(BLANKS);
        let is_one = !element.tag_name().name().ends_with("XMLList");
        let mut words = written.split(BLANKS).filter(|word| !word.is_empty());
        let not = |unit: &str| matches!(definitions::unit(element, unit), Ok(None));
        if is_one { not(written) } else { words.any(not) }
    };
    units.into_iter().any(is_unknown)
}

fn join(all: &mut Measured, next: Measured) {
    let counts = [all.values.len(), next.values.len()];
    all.values.extend(next.values);
    all.last_digits.extend(next.last_digits);
    all.unread = all.unread.take().or(next.unread);
    all.is_difference |= next.is_difference;
    if all.uncertainty.is_some() || next.uncertainty.is_some() {
        let stated = all.uncertainty.get_or_insert_default();
        stated.join(next.uncertainty.unwrap_or_default(), counts);
    }
}

const VALUES: [&str; 2] = ["value", "valueXMLList"];
const UNITS: [&str; 3] = ["unit", "unitXMLList", "listUnit"];
/// The uncertainty that the values of a list have which state none of their own.
const OF_EACH: [&str; 2] = ["listUnivariateUnc", "globalUnivariateUnc"];

/// Whether an element of a list holds for each of its values.
fn is_of_each(element: Node<'_, '_>) -> bool {
    OF_EACH.contains(&element.tag_name().name())
}

/// Reads a `real`, a `constant` or a list in one element.
pub(super) fn of_holder(holder: Node<'_, '_>, span: Range<usize>) -> Result<Measured, Fault> {
    let values = numbers(holder, &VALUES, None)?
        .ok_or_else(|| (tag(holder), "this has no value".to_owned()))?;
    let unit = unit_of(holder)?;
    let count = values.len();
    lists_of(holder, count)?;
    let uncertain = uncertainty_of(holder);
    let of_constant = holder.tag_name().name() == "constant"
        && !holder.descendants().any(|descendant| descendant.tag_name().name() == "expandedUnc");
    let mut expanded = vec!["valueExpandedMU", "uncertaintyXMLList", "valueExpandedMUXMLList"];
    let mut standard =
        vec!["standardUnc", "valueStandardMU", "standardUncXMLList", "valueStandardMUXMLList"];
    // that of a constant is its standard deviation, says D-SI
    if of_constant {
        standard.push("uncertainty")
    } else {
        expanded.push("uncertainty")
    }
    let column = |names: &[&str]| -> Result<[NumberColumn; 2], Fault> {
        let Some(numbers) = numbers(uncertain, names, Some(count))? else {
            return Ok([Vec::new(), Vec::new()]);
        };
        let digits = last_digits(uncertain, names, count)?;
        Ok([numbers, digits].map(|all| all.into_iter().map(Some).collect()))
    };
    let [expanded, of_expanded] = column(&expanded)?;
    let [standard, of_standard] = column(&standard)?;
    let [factors, of_factors] = column(&["coverageFactor", "coverageFactorXMLList"])?;
    let [probabilities, of_probabilities] =
        column(&["coverageProbability", "coverageProbabilityXMLList"])?;
    let [low, of_low] = column(&["intervalMin", "intervalMinXMLList"])?;
    let [high, of_high] = column(&["intervalMax", "intervalMaxXMLList"])?;
    let is_uncertain = !expanded.is_empty() || !standard.is_empty();
    let stated = StatedUncertainties {
        expanded,
        standard,
        factors,
        probabilities,
        ends: [low, high],
        distributions: distributions(uncertain, count)?,
        last_digits: LastDigits {
            expanded: of_expanded,
            standard: of_standard,
            factors: of_factors,
            probabilities: of_probabilities,
            ends: [of_low, of_high],
        },
        of_interval: Vec::new(),
    };
    Ok(Measured {
        span,
        unit,
        last_digits: last_digits(holder, &VALUES, count)?,
        values,
        uncertainty: is_uncertain.then_some(stated),
        unread: if is_uncertain { None } else { unread_in(uncertain) },
        is_difference: false,
    })
}

/// Whether each list in an element has as many entries as there are values, or one for all of them: a blank
/// within a number, `2 850`, makes two of it, and nothing else tells.
///
/// # Errors
/// The list that has another length.
fn lists_of(holder: Node<'_, '_>, count: usize) -> Result<(), Fault> {
    let lists = holder.descendants().filter(|descendant| {
        is_list(*descendant) && descendant.children().all(|child| child.is_text())
    });
    for list in lists {
        let text = content_of(list);
        let entries = text.split(BLANKS).filter(|word| !word.is_empty()).count();
        if entries > 1 && entries != count {
            let name = list.tag_name().name();
            let reason = format!(
                "`{name}` has {entries} entries for {count} value{}: one for each or one for all is to \
                 stand here, and no blank within a number",
                if count == 1 { "" } else { "s" }
            );
            return Err((tag(list), reason));
        }
    }
    Ok(())
}

/// The element of this name in the list of a value.
fn in_list_of<'d>(holder: Node<'d, 'd>, names: &[&str]) -> Option<Node<'d, 'd>> {
    let list = holder
        .parent()
        .filter(|parent| ["list", "realList"].contains(&parent.tag_name().name()))?;
    list.children().find(|child| names.contains(&child.tag_name().name()))
}

/// The unit of values, or that of their list.
fn unit_of(holder: Node<'_, '_>) -> Result<Unit, Fault> {
    let own = texts(holder, &UNITS)?;
    let shared = match in_list_of(holder, &["listUnit"]) {
        Some(element) => texts_of([element].into_iter())?,
        None => None,
    };
    let Some((element, units)) = own.clone().or(shared.clone()) else {
        return Err((tag(holder), "this has no unit".to_owned()));
    };
    let written = units.first().map_or("", String::as_str);
    let differs =
        |(_, units): &(Node<'_, '_>, Vec<String>)| units.iter().any(|unit| unit != written);
    if let Some((element, _)) = [own, shared].into_iter().flatten().find(differs) {
        return Err((tag(element), "the values of a list have different units".to_owned()));
    }
    definitions::unit(element, written)?
        .ok_or_else(|| (element.range(), definitions::unknown(element, written)))
}

/// Where the uncertainty of values stands: in their element, or for all values of their list.
fn uncertainty_of<'d>(holder: Node<'d, 'd>) -> Node<'d, 'd> {
    if unread_in(holder).is_some() {
        return holder;
    }
    in_list_of(holder, &OF_EACH).unwrap_or(holder)
}

/// A statement of uncertainty in an element, as something that is not read.
fn unread_in(element: Node<'_, '_>) -> Option<Fault> {
    let is_uncertainty = |node: &Node<'_, '_>| {
        let name = node.tag_name().name().to_lowercase();
        let name = name.strip_suffix("xmllist").unwrap_or(&name);
        name.contains("uncertainty")
            || name == "coverageinterval"
            || ["unc", "mu", "region"].iter().any(|end| name.ends_with(end))
    };
    let found = element.descendants().find(is_uncertainty)?;
    let reason = format!(
        "the uncertainty of this quantity is stated as `{}` here, which is not read: \
         `si:expandedUnc` or `si:coverageInterval` can be, or their lists",
        found.tag_name().name()
    );
    Some((tag(found), reason))
}

/// One value for all, where a list has one.
pub(super) fn spread<T: Clone>(all: Vec<T>, count: Option<usize>) -> Vec<T> {
    match (all.as_slice(), count) {
        ([one], Some(count)) => vec![one.clone(); count],
        _ => all,
    }
}

/// What the distributions of values are called: one name, which may have several words, or a list;
/// empty where nothing is said.
fn distributions(holder: Node<'_, '_>, count: usize) -> Result<Vec<String>, Fault> {
    let Some((element, words)) = texts(holder, &["distribution", "distributionXMLList"])? else {
        return Ok(vec![String::new(); count]);
    };
    let words = if is_list(element) { words } else { vec![words.join(" ")] };
    if words.is_empty() {
        return Ok(vec![String::new(); count]);
    }
    let found = spread(words, Some(count));
    if found.len() != count {
        let name = element.tag_name().name();
        let reason = format!("`{name}` has {} names for {count} values", found.len());
        return Err((element.range(), reason));
    }
    Ok(found)
}

/// What one in the last written digit of numbers is.
fn last_digits(holder: Node<'_, '_>, names: &[&str], count: usize) -> Result<Vec<f64>, Fault> {
    let words = texts(holder, names)?.map_or_else(Vec::new, |(_, words)| words);
    Ok(spread(words.iter().map(|word| last_digit(word)).collect(), Some(count)))
}

/// Whether an element holds a list of words.
fn is_list(element: Node<'_, '_>) -> bool {
    element.tag_name().name().ends_with("XMLList")
}

/// An element and the words in it.
type Words<'d> = (Node<'d, 'd>, Vec<String>);

/// The words of the element below with one of these names.
///
/// # Errors
/// Another one says something else, so that their order would decide; what is in it is no text alone, or
/// several words where one is to stand.
fn texts<'d>(holder: Node<'d, 'd>, names: &[&str]) -> Result<Option<Words<'d>>, Fault> {
    texts_of(
        holder.descendants().filter(|descendant| names.contains(&descendant.tag_name().name())),
    )
}

fn texts_of<'d>(
    mut elements: impl Iterator<Item = Node<'d, 'd>>,
) -> Result<Option<Words<'d>>, Fault> {
    let words = |element: Node<'d, 'd>| -> Vec<String> {
        let text = content_of(element);
        text.split(BLANKS).filter(|word| !word.is_empty()).map(str::to_owned).collect()
    };
    let shown = |words: &[String]| -> String { words.join(" ").chars().take(40).collect() };
    let Some(element) = elements.next() else { return Ok(None) };
    let name = element.tag_name().name();
    let found = words(element);
    if let Some(inside) = element.children().find(Node::is_element) {
        let inner = inside.tag_name().name();
        return Err((tag(inside), format!("`{inner}` has no place in `{name}`, which is a text")));
    }
    if found.len() > 1 && !is_list(element) && name != "distribution" {
        let reason = format!(
            "`{name}` is `{}`, which is more than one word; one is to stand here, a number without \
             blanks for example",
            shown(&found)
        );
        return Err((element.range(), reason));
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
            let reason = format!(
                "`{name}` is `{}` and, here, `{}` of the same value: ask which is right",
                shown(&found),
                shown(&again)
            );
            return Err((other.range(), reason));
        }
    }
    Ok(Some((element, found)))
}

/// The numbers of the element below with one of these names, so many of them if that is known.
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
