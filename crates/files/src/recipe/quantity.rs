//! A value with its unit and, perhaps, its standard uncertainty.

use super::super::keys;
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_units::{Turn, Unit};

/// A value and its standard uncertainty, with the unit that they are in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) standard_uncertainty: f64,
    pub(super) unit: Unit,
}

impl Quantity {
    /// In coherent SI units.
    pub(super) fn si(&self) -> f64 {
        self.unit.to_si(self.value)
    }

    /// The standard uncertainty in coherent SI units.
    pub(super) fn si_uncertainty(&self) -> f64 {
        self.unit.to_si(self.standard_uncertainty)
    }
}

/// The quantity at `key`, a number in `default` or an object. Nothing where the key is not there or
/// after a mistake.
pub(super) fn quantity(object: &Object<'_>, key: &'static str, default: &str) -> Option<Quantity> {
    let member = object.get(key)?;
    let quantity = of_member(object, member, default)?;
    let expected = own_unit(default);
    same_dimension(object, member, &quantity.unit, &expected).then_some(quantity)
}

/// A unit that this program names itself.
#[expect(clippy::expect_used, reason = "all of them stand in the sources of this reader")]
pub(super) fn own_unit(text: &str) -> Unit {
    Unit::parse(text).expect("the units of recipes' keys can be read")
}

/// The quantity of a member, of any dimension.
pub(super) fn of_member(object: &Object<'_>, member: &Member, default: &str) -> Option<Quantity> {
    if let Some(value) = member.value.number() {
        let unit = own_unit(default);
        return Some(Quantity { value, standard_uncertainty: 0.0, unit });
    }
    if !matches!(member.value.value, Json::Object(_)) {
        let what = format!("`{}`", member.key);
        let expected = "a number, or an object with `value` and `unit`";
        let diagnostic =
            DiagnosticKind::WrongType { what, found: member.value.value.kind(), expected };
        object.log.report(&member.value.span, diagnostic);
        return None;
    }
    let inner = Object::new(object.log, "a quantity", &member.value, &member.key_span)?;
    keys::check(&inner, keys::QUANTITY);
    of_object(&inner, default)
}

/// The quantity that an object is, whose keys were checked.
pub(super) fn of_object(inner: &Object<'_>, default: &str) -> Option<Quantity> {
    inner.required("value")?;
    let value = inner.number("value")?;
    let unit = unit(inner, "unit", default)?;
    let standard_uncertainty = uncertainty(inner)?;
    Some(Quantity { value, standard_uncertainty, unit })
}

/// `standard_uncertainty`, zero where it is not there.
pub(super) fn uncertainty(inner: &Object<'_>) -> Option<f64> {
    let Some(member) = inner.get("standard_uncertainty") else { return Some(0.0) };
    let found = inner.number("standard_uncertainty")?;
    if found >= 0.0 {
        return Some(found);
    }
    let key = "standard_uncertainty".to_owned();
    inner
        .log
        .report(&member.value.span, DiagnosticKind::OutOfRange { key, found, range: "0 or above" });
    None
}

/// The unit at `key`.
pub(super) fn unit(object: &Object<'_>, key: &'static str, default: &str) -> Option<Unit> {
    let Some(member) = object.get(key) else { return Unit::parse(default).ok() };
    let text = object.text(key)?;
    let parsed = Unit::parse(text);
    let diagnostic = |error| DiagnosticKind::Unit { unit: text.to_owned(), error };
    object.log.value(&member.value.span, parsed.map_err(diagnostic))
}

/// Whether a unit has the dimension that is expected; a mistake where it has not, and where it counts
/// radians in place of periods: 1 rad/s is 1/(2 pi) Hz.
pub(super) fn same_dimension(
    object: &Object<'_>,
    member: &Member,
    found: &Unit,
    expected: &Unit,
) -> bool {
    let same = found.is_compatible(expected);
    if !same {
        let diagnostic = DiagnosticKind::WrongDimension {
            name: member.key.clone(),
            found: found.text().to_owned(),
            found_as: found.dimension().describe(),
            expected: expected.text().to_owned(),
            expected_as: expected.dimension().describe(),
        };
        object.log.report(&member.value.span, diagnostic);
        return false;
    }
    if (found.turn(), expected.turn()) == (Some(Turn::Angle), Some(Turn::Periods)) {
        let hertz = format!("{:.5e}", found.factor() / std::f64::consts::TAU);
        let reason = format!(
            "`{}` counts angle, but a frequency counts periods; write it in Hz: 1 {} is {} Hz",
            found.text(),
            found.text(),
            gumption_engine::number::Shortest(hertz.parse().unwrap_or(f64::NAN))
        );
        object.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
        return false;
    }
    if let Err(error) = Unit::conversion_factor(found, expected) {
        object.log.report(&member.value.span, DiagnosticKind::Recipe { reason: error.to_string() });
        return false;
    }
    true
}

/// A number above zero at `key`, already read.
pub(super) fn positive(object: &Object<'_>, key: &'static str, quantity: &Quantity) -> bool {
    let found = quantity.value;
    if found <= 0.0
        && let Some(member) = object.get(key)
    {
        object
            .log
            .report(&member.value.span, DiagnosticKind::NotPositive { key: key.into(), found });
    }
    found > 0.0
}
