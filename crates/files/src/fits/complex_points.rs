//! Complex ordinates of the points of a calibration function: modulus and phase of a response over
//! frequency, or real and imaginary part.

use super::super::keys;
use super::points::{self, Side, Tables};
use super::{FitReader, FitSet, matrix};
use gumption_engine::fact;
use gumption_engine::linalg::packed;
use gumption_engine::regression::{ComplexForm, ComplexSpread, Points, Spread};
use gumption_engine::task::Warning;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, Folder};
use gumption_units::{Turn, Unit};

/// The parts of a complex y by their keys, which are also the columns of a file unless it says others.
const PARTS: [&str; 4] = ["re", "im", "modulus", "phase"];

/// The points, their units, and whether the file says these.
type Found = (Points, (Unit, Unit), [bool; 2]);

/// Complex ordinates as the file states them; phases are in radians.
pub(crate) struct ComplexOrdinates {
    pub(crate) x: Side,
    pub(crate) form: ComplexForm,
    pub(crate) values: [Vec<f64>; 2],
    pub(crate) spread: ComplexSpread,
    /// The unit of modulus, or of both parts, and whether the file says it.
    pub(crate) unit: Unit,
    is_stated: bool,
}

/// The complex ordinates of an object that is no fit; files that were read and notes are added to those given.
pub(crate) fn complex_ordinates(
    of: &Object<'_>,
    (x, y): (&Member, &Member),
    folder: Folder<'_>,
    (files, warnings): (&mut Vec<(String, Vec<u8>)>, &mut Vec<Warning>),
) -> Option<ComplexOrdinates> {
    let Some((ordinates, complex)) = self::of(of.log, y) else {
        let reason = "a response has a complex y: `\"y\": {\"complex\": {\"modulus\": ..., \"phase\": ...}}`, or `re` \
                      and `im`"
            .to_owned();
        of.log.report(&y.value.span, DiagnosticKind::Recipe { reason });
        return None;
    };
    let mut set = FitSet::default();
    let mut reader = FitReader { object: *of, name: "response", folder, set: &mut set };
    let found = reader.ordinates(x, ordinates, complex);
    files.extend(set.files);
    warnings.extend(set.warnings);
    found
}

/// `y` as an object and its key `complex`, if it has this key.
pub(super) fn of<'a>(log: &'a Collector, y: &'a Member) -> Option<(Object<'a>, &'a Member)> {
    let Json::Object(members) = &y.value.value else { return None };
    let complex = members.iter().find(|member| member.key == "complex")?;
    Some((Object::new(log, "`y` of a fit", &y.value, &y.key_span)?, complex))
}

impl FitReader<'_, '_> {
    /// Points with a complex y.
    pub(super) fn complex_points(
        &mut self,
        x_member: &Member,
        y: Object<'_>,
        complex: &Member,
    ) -> Option<Found> {
        let of = self.ordinates(x_member, y, complex)?;
        let values = [of.values[0].as_slice(), &of.values[1]];
        let points = Points::complex(&of.x.values, of.form, values, of.spread);
        let points = points.map_err(|error| self.report(&error)).ok()?;
        Some((points, (of.x.unit, of.unit), [of.x.is_stated, of.is_stated]))
    }

    fn ordinates(
        &mut self,
        x_member: &Member,
        y: Object<'_>,
        complex: &Member,
    ) -> Option<ComplexOrdinates> {
        let log = self.object.log;
        keys::check(&y, keys::COMPLEX_ORDINATES);
        let of = Object::new(log, "`complex`", &complex.value, &complex.key_span)?;
        keys::check(&of, keys::COMPLEX_POINTS);
        let is_polar = of.get("modulus").is_some() || of.get("phase").is_some();
        let (form, [first_key, second_key], other) = match is_polar {
            true => (ComplexForm::Polar, ["modulus", "phase"], ["re", "im"]),
            false => (ComplexForm::Cartesian, ["re", "im"], ["modulus", "phase"]),
        };
        if let Some(second) = other.into_iter().find_map(|key| of.get(key)) {
            let reason = "has `re` and `im`, or `modulus` and `phase`, and not some of both";
            let (name, reason) = ("y".to_owned(), reason.to_owned());
            log.report(&second.key_span, DiagnosticKind::Complex { name, reason });
            return None;
        }
        let (first, second) = (of.required(first_key), of.required(second_key));
        let (first, second) = (first?, second?);
        let mut own = vec!["x"];
        own.extend(PARTS);
        let mut tables = Tables::of([x_member, complex], &own);
        let folder = self.folder;
        let mut read = |member, key, files: &mut _| {
            points::read(log, member, key, (folder, &mut tables), files)
        };
        let x = read(x_member, "x", &mut self.set.files);
        let of_first = read(first, first_key, &mut self.set.files);
        let of_second = read(second, second_key, &mut self.set.files);
        let (x, mut of_first, mut of_second) = (x?, of_first?, of_second?);
        self.note(&mut of_first);
        self.note(&mut of_second);
        let n = x.values.len();
        for (key, side) in [(first_key, &of_first), (second_key, &of_second)] {
            let found = side.values.len();
            if found != n {
                let reason =
                    format!("x has {n} values and {key} has {found}, but each point has both");
                self.fault(reason, self.object.place());
                return None;
            }
        }
        let uncertain = ["standard_uncertainty", "covariance"];
        let uncertain = Object::new(log, "`x` of a fit", &x_member.value, &x_member.key_span)
            .and_then(|x| uncertain.into_iter().find_map(|key| x.get(key)))
            .or(self.object.get("cross_covariance"));
        if let Some(member) = uncertain {
            let reason = "a fit of a complex y takes x as exact: leave this out, and add what it makes \
                          of y, the derivative times u(x), to the uncertainties of y";
            self.fault(reason.to_owned(), &member.key_span);
            return None;
        }
        self.check_units((first, &of_first), (second, &mut of_second), is_polar)?;
        if let Some(point) = of_first.values.iter().position(|m| is_polar && *m <= 0.0) {
            let reason = format!(
                "the modulus of point {} is {}, but must be positive",
                point + 1,
                of_first.values[point]
            );
            self.fault(reason, &first.key_span);
            return None;
        }
        let correlations = match of.get("correlation") {
            None => None,
            Some(member) => {
                let found = match &member.value.value {
                    Json::List(_) => of.numbers("correlation")?,
                    Json::Text(_) => {
                        let (folder, files) = (self.folder, &mut self.set.files);
                        points::numbers_beside(log, first, member, (folder, &mut tables), files)?
                    }
                    _ => vec![of.number("correlation")?; n],
                };
                self.check_correlations(member, &found, n)?;
                Some((member, found))
            }
        };
        let phase_factor = if is_polar { of_second.unit.factor() } else { 1.0 };
        scale(&mut of_second, phase_factor);
        let spread = match of.get("covariance") {
            None => self.spread([first, second], [&mut of_first, &mut of_second], correlations)?,
            Some(member) => {
                let has_own = |side: &Side| side.spread != Spread::None;
                if has_own(&of_first) || has_own(&of_second) || correlations.is_some() {
                    let reason = "`covariance` is of both parts; leave out the uncertainties of each \
                                  part and `correlation`, or leave out `covariance`";
                    self.fault(reason.to_owned(), &member.key_span);
                    return None;
                }
                let files = &mut self.set.files;
                let mut lower = matrix::covariance(log, member, 2 * n, self.folder, files)?;
                for i in n..2 * n {
                    for j in 0..=i {
                        let factor = if j < n { phase_factor } else { phase_factor * phase_factor };
                        lower[packed::triangle(i) + j] *= factor;
                    }
                }
                ComplexSpread::Joint(lower)
            }
        };
        Some(ComplexOrdinates {
            x,
            form,
            values: [of_first.values, of_second.values],
            spread,
            unit: of_first.unit,
            is_stated: of_first.is_stated,
        })
    }

    /// That modulus or real part have a unit that complex values can have, and the other part its own.
    fn check_units(
        &mut self,
        (first, of_first): (&Member, &Side),
        (second, of_second): (&Member, &mut Side),
        is_polar: bool,
    ) -> Option<()> {
        let unit = &of_first.unit;
        if !unit.level_exponent().is_zero() || unit.zero().is_some() {
            let key = &first.key;
            let reason = format!(
                "`{key}` is in {unit}, which is no unit of a complex value: convert it to a ratio or to \
                 a unit such as `mV/(m/s^2)`"
            );
            self.fault(reason, &first.key_span);
            return None;
        }
        if is_polar {
            if !of_second.is_stated {
                of_second.unit = Unit::parse("rad").unwrap_or_else(|_| Unit::one());
                let turned =
                    of_second.values.iter().find(|angle| angle.abs() > std::f64::consts::TAU);
                // without a unit it is in radians
                let fact = |angle| fact!("angle-of-turns.phase", name = self.name, angle);
                let note = turned.map(|angle| Warning::new(self.name, fact(*angle)));
                self.set.warnings.extend(note);
            }
            if of_second.unit.turn() != Some(Turn::Angle) || !of_second.unit.dimension().is_none() {
                let reason =
                    format!("the phase is in {}, but must be an angle: `deg`", of_second.unit);
                self.fault(reason, &second.key_span);
                return None;
            }
        } else if !of_second.is_stated {
            of_second.unit = unit.clone();
        } else if of_second.unit != *unit {
            let other = &of_second.unit;
            let reason = format!("`re` is in {unit} and `im` in {other}: give both in one unit");
            self.fault(reason, &second.key_span);
            return None;
        }
        Some(())
    }

    fn check_correlations(&self, member: &Member, found: &[f64], n: usize) -> Option<()> {
        let reason = match found.iter().position(|r| r.is_nan() || r.abs() >= 1.0) {
            _ if found.len() != n => {
                format!("there are {} correlation coefficients for {n} points", found.len())
            }
            Some(point) => format!(
                "the correlation coefficient of both parts of point {} is {}, but must lie between -1 \
                 and 1",
                point + 1,
                found[point]
            ),
            None => return Some(()),
        };
        self.fault(reason, &member.value.span);
        None
    }

    /// The uncertainties of both parts together.
    fn spread(
        &self,
        members: [&Member; 2],
        [first, second]: [&mut Side; 2],
        correlations: Option<(&Member, Vec<f64>)>,
    ) -> Option<ComplexSpread> {
        let n = first.values.len();
        let take = |side: &mut Side| std::mem::replace(&mut side.spread, Spread::None);
        let spreads = [take(first), take(second)];
        match &spreads {
            [Spread::None, Spread::None] => {
                let Some((member, _)) = correlations else { return Some(ComplexSpread::None) };
                let reason = "`correlation` needs the standard uncertainties of both parts";
                self.fault(reason.to_owned(), &member.key_span);
                return None;
            }
            [Spread::None, _] | [_, Spread::None] => {
                let [without, with] = match &spreads {
                    [Spread::None, _] => members,
                    _ => [members[1], members[0]],
                };
                let reason = format!(
                    "the uncertainties of `{}` are stated, but not the uncertainties of `{}`; state \
                     both, or neither",
                    with.key, without.key
                );
                self.fault(reason, &without.key_span);
                return None;
            }
            _ => {}
        }
        let r = correlations.map_or_else(|| vec![0.0; n], |(_, r)| r);
        let spreads = match spreads {
            [Spread::Each(first), Spread::Each(second)] => {
                let roots = |variances: Vec<f64>| variances.iter().map(|v| v.sqrt()).collect();
                return Some(ComplexSpread::Each([roots(first), roots(second)], r));
            }
            spreads => spreads,
        };
        let entry = |of: &Spread, i: usize, j: usize| match of {
            Spread::None => 0.0,
            Spread::Each(variances) => {
                if i == j {
                    variances[i]
                } else {
                    0.0
                }
            }
            Spread::Joint(lower) => lower[packed::triangle(i.max(j)) + i.min(j)],
        };
        let [a, b] = &spreads;
        let mut lower = Vec::with_capacity(packed::triangle(2 * n));
        for i in 0..2 * n {
            lower.extend((0..=i).map(|j| match (i.checked_sub(n), j.checked_sub(n)) {
                (Some(i), Some(j)) => entry(b, i, j),
                (Some(i), None) if i == j => r[i] * (entry(a, i, i) * entry(b, i, i)).sqrt(),
                (Some(_), None) => 0.0,
                _ => entry(a, i, j),
            }));
        }
        Some(ComplexSpread::Joint(lower))
    }
}

/// Values and uncertainties in a unit of which one of theirs is so many.
fn scale(side: &mut Side, factor: f64) {
    side.values.iter_mut().for_each(|value| *value *= factor);
    if let Spread::Each(squares) | Spread::Joint(squares) = &mut side.spread {
        squares.iter_mut().for_each(|square| *square *= factor * factor);
    }
}
