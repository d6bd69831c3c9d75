//! Units that D-SI does not have, `|tex`, and their definitions in the certificate,
//! `tex = 1e-6 kg m^-1` (`dcc:nonSIDefinition`).

use gumption_units::Unit;
use roxmltree::Node;

use super::document::{Fault, content_of};
use gumption_text::implied_dof::last_digit;

/// Sizes that are computed differ by no more than this share of them.
const COMPUTED: f64 = 1e-9;

/// A unit as it is written in an element; `None` for one that nobody knows.
///
/// # Errors
/// The certificate defines it, and not as it is known here, not in one way, or not readably.
pub(super) fn unit(element: Node<'_, '_>, written: &str) -> Result<Option<Unit>, Fault> {
    let known = Unit::parse_dsi(written);
    if written.starts_with('\\') {
        return Ok(known);
    }
    let name = written.strip_prefix('|').unwrap_or(written).trim();
    let mut found: Option<Definition> = None;
    for node in around(element) {
        let text = content_of(node);
        let fault = |reason: String| (node.range(), reason);
        let Some(definition) = Definition::read(&text, name) else { continue };
        let next = match (definition, &known) {
            (Ok(next), _) => next,
            // words about a unit that is known
            (Err(_), Some(_)) => continue,
            (Err(reason), None) => return Err(fault(reason)),
        };
        let before = found.as_ref().map(|before| (before, "another definition of it says"));
        let as_known = known.clone().map(|unit| Definition { unit, rounding: 0.0 });
        let beside = before.or_else(|| Some((as_known.as_ref()?, "it is known as")));
        if let Some((other, is)) = beside
            && !next.is(other)
        {
            let size = |unit: &Unit| format!("{} of {}", unit.describe(), unit.factor());
            return Err(fault(format!(
                "`{}` makes `{name}` {} in SI units, and {is} {}: `|{name}` can be read in two ways, ask \
                 which is right",
                text.trim(),
                size(&next.unit),
                size(&other.unit)
            )));
        }
        found.get_or_insert(next);
    }
    Ok(known.or_else(|| {
        let Definition { unit: size, .. } = found?;
        // a product of units has no name of its own
        Some(Unit::defined(name, &size).unwrap_or(size))
    }))
}

/// Why a unit is not known.
pub(super) fn unknown(element: Node<'_, '_>, written: &str) -> String {
    let name = written.strip_prefix('|').unwrap_or(written).trim();
    match around(element).first() {
        Some(definition) if !written.starts_with('\\') => format!(
            "`{written}` is no unit of D-SI, and `{}` does not define it: `{name} = NUMBER UNIT` would",
            content_of(*definition).trim()
        ),
        _ => format!("`{written}` is no unit of D-SI"),
    }
}

/// The definitions that hold for an element: those of its quantity, of the results around it, and of the
/// statements of the certificate.
fn around<'d>(element: Node<'d, 'd>) -> Vec<Node<'d, 'd>> {
    let is = |node: &Node<'d, 'd>, name: &str| node.tag_name().name() == name;
    let inside = |node: Node<'d, 'd>| {
        node.descendants().filter(move |descendant| is(descendant, "nonSIDefinition"))
    };
    let about = |node: Node<'d, 'd>| {
        let about = node.children().filter(move |child| is(child, "measurementMetaData"));
        about.flat_map(inside)
    };
    let quantity = element.ancestors().find(|ancestor| is(ancestor, "quantity"));
    let outer = element.ancestors().filter(|ancestor| !is(ancestor, "quantity")).flat_map(about);
    let root = element.document().root_element();
    let administrative = root.children().filter(|child| is(child, "administrativeData"));
    let statements = administrative
        .flat_map(|section| section.children())
        .filter(|section| is(section, "statements"));
    quantity.into_iter().flat_map(inside).chain(outer).chain(statements.flat_map(inside)).collect()
}

/// What a unit is said to be.
struct Definition {
    unit: Unit,
    /// What rounding to the written digits may have taken, as a share.
    rounding: f64,
}

impl Definition {
    /// What a text says of a unit: `100 foo = 3 m`; `None` if it is about something else.
    fn read(text: &str, name: &str) -> Option<Result<Self, String>> {
        let (left, right) = text.split_once('=')?;
        let (number, defined) = counted(left);
        if !is_name(defined, name) {
            return None;
        }
        let (size, _) = counted(right);
        let rounding = match size.map(|size| (size.parse::<f64>(), last_digit(size))) {
            Some((Ok(value), digit)) if value != 0.0 => (0.5 * digit / value).abs(),
            _ => 0.0,
        };
        let unit = unit_of(right, number);
        Some(unit.map(|unit| Self { unit, rounding }).ok_or_else(|| {
            format!(
                "`{}` is no definition of a unit that can be read: `{name} = NUMBER UNIT` is, such as \
                 `{name} = 0.3048 m`",
                text.trim()
            )
        }))
    }

    /// Whether both say the same, to their digits.
    fn is(&self, other: &Self) -> bool {
        let (one, another) = (&self.unit, &other.unit);
        one.dimension() == another.dimension()
            && one.level_exponent() == another.level_exponent()
            && (one.factor() / another.factor() - 1.0).abs()
                <= 1.001 * (self.rounding + other.rounding) + COMPUTED
    }
}

/// A number before a text, and the text behind it.
fn counted(text: &str) -> (Option<&str>, &str) {
    let text = text.trim();
    let end = text.find(|c: char| c.is_whitespace() || c == '\\').unwrap_or(text.len());
    match text.split_at_checked(end) {
        Some((number, rest)) if number.parse::<f64>().is_ok() => (Some(number), rest.trim()),
        _ => (None, text),
    }
}

fn is_name(text: &str, name: &str) -> bool {
    let both = [text, name].map(|text| Unit::parse(text).ok().map(|unit| unit.normal_text()));
    !text.is_empty() && (text == name || both[0].is_some() && both[0] == both[1])
}

/// A size such as `3 m` or `3\metre`, over a number.
fn unit_of(size: &str, over: Option<&str>) -> Option<Unit> {
    let size = match counted(size) {
        (Some(number), of) if of.starts_with('\\') => {
            Unit::parse(&format!("{number} {}", Unit::parse_dsi(of)?.normal_text())).ok()?
        }
        _ => Unit::parse_dsi(size)?,
    };
    let of_one = match over {
        None => size,
        Some(number) => Unit::parse(&format!("({})/{number}", size.text())).ok()?,
    };
    (of_one.factor() > 0.0 && of_one.factor().is_finite()).then_some(of_one)
}
