//! The relative uncertainty of a quantity (`dcc:relativeUncertainty`): the expanded uncertainty over the
//! size of the value, stated once more. The good practice has it beside an expanded uncertainty, as it has
//! no coverage factor of its own; nothing says what it is where it stands alone.

use gumption_engine::number::Shortest;
use gumption_units::Unit;
use roxmltree::Node;

use super::document::{self, Fault, Measured, at, tag};

/// Compares the relative uncertainty of a quantity, if it has one, with that of its values.
///
/// # Errors
/// The two are not the same to their digits.
pub(super) fn compare(quantity: Node<'_, '_>, all: &mut Measured) -> Result<(), Fault> {
    let named = |node: &Node<'_, '_>| node.tag_name().name() == "relativeUncertainty";
    let Some(relative) = quantity.children().find(named) else { return Ok(()) };
    let count = all.values.len();
    let read = shares(relative, count)?;
    for (place, share) in read.into_iter().enumerate() {
        let [value, digit] =
            [&all.values, &all.last_digits].map(|numbers| numbers.get(place).copied());
        let (value, digit) = (value.unwrap_or(f64::NAN), digit.unwrap_or(0.0));
        let Some(stated) = all.uncertainty.as_ref().filter(|_| value != 0.0) else { continue };
        let digits = &stated.last_digits;
        let widths = [
            (at(&stated.expanded, place), at(&digits.expanded, place)),
            (at(&stated.standard, place), at(&digits.standard, place)),
        ];
        let is_same = |width: f64, of_width: f64| {
            let rounding = share.digit * value.abs() + of_width + share.value * 0.5 * digit;
            (share.value * value.abs() - width).abs() <= 1.001 * rounding + 1e-12 * width
        };
        let mut known = widths.iter().filter_map(|(width, digit)| Some(((*width)?, (*digit)?)));
        let Some((width, _)) = known.clone().next() else { continue };
        if !known.any(|(width, digit)| is_same(width, digit)) {
            let said = |value: f64| Shortest(value).to_string();
            let reason = format!(
                "this relative uncertainty is {} of the value {}, whose uncertainty is stated as {}: ask \
                 which is right",
                said(share.value),
                all.unit.after(&said(value)),
                all.unit.after(&said(width)),
            );
            return Err((tag(relative), reason));
        }
    }
    let reason = "this quantity states a relative uncertainty alone (`dcc:relativeUncertainty`), which \
                  says no coverage factor: an `si:expandedUnc` with factor and probability is to stand \
                  with the value"
        .to_owned();
    all.unread = all.unread.take().or(Some((tag(relative), reason)));
    Ok(())
}

/// A relative uncertainty as a number, and what one in its last digit is.
struct Share {
    value: f64,
    digit: f64,
}

/// The relative uncertainty of each value.
fn shares(relative: Node<'_, '_>, count: usize) -> Result<Vec<Share>, Fault> {
    let holder = relative.children().find(Node::is_element);
    let holder = holder.ok_or_else(|| (tag(relative), "this has no value".to_owned()))?;
    let read = document::of_holder(holder, tag(relative))?;
    let Ok(factor) = Unit::conversion_factor(&read.unit, &Unit::one()) else {
        let reason = format!("a relative uncertainty has no unit `{}`", read.unit);
        return Err((tag(relative), reason));
    };
    let shares = read.values.iter().zip(&read.last_digits);
    let shares = shares.map(|(value, digit)| [value * factor, digit * factor]);
    let shares = document::spread(shares.collect(), Some(count));
    if shares.len() != count {
        let reason =
            format!("there are {} relative uncertainties for {count} values", shares.len());
        return Err((tag(relative), reason));
    }
    Ok(shares.into_iter().map(|[value, digit]| Share { value, digit }).collect())
}
