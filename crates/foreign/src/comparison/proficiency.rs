//! The participants of a proficiency test, and the numbers that are stated for it.

use std::collections::HashSet;

use super::check::TableKind;
use super::headings::{self, Role};
use super::numbers::Number;
use super::stated::USUAL_FACTOR;
use super::{ComparisonReader, ComparisonTable, InUnits, branches};
use gumption_analysis::compare::proficiency::StatedUncertainty;
use gumption_analysis::compare::{AssignedBy, Participant, SigmaBy, StatedResult};
use gumption_text::DiagnosticKind;
use gumption_text::share::{Share, two_meanings};
use gumption_text::value_text::{
    ValueOf, bare_number, converted, decimal_comma, is_comma, with_unit,
};
use gumption_units::{Unit, nearest};

/// A participant's result in the unit of the comparison.
struct ReadResult {
    stated: StatedResult,
    has_uncertainty: bool,
}

impl ComparisonReader<'_> {
    /// The participants of a proficiency test.
    pub(super) fn proficiency_test(&mut self) -> Option<ComparisonTable> {
        self.check_columns(TableKind::Proficiency)?;
        let label = self.columns.place(Role::Label)?;
        let mut wanted = None;
        let (mut names, mut known): (Vec<String>, HashSet<String>) = Default::default();
        let mut results: Vec<ReadResult> = Vec::new();
        for row in self.rows() {
            let Some(name) = self.label(row, label) else { continue };
            let place = self.numbers.table.place(row, label);
            if headings::is_reference(&name) {
                let reason = format!(
                    "`{name}` can be the assigned value, or a participant: take the row out and state \
                     the former, `--assigned VALUE --assigned-u U`, or give the latter the name of its \
                     laboratory"
                );
                self.fail_at(place, reason);
                continue;
            }
            if self.is_without_result(row, &name) {
                continue;
            }
            let Some(result) = self.participant(row, &mut wanted) else { continue };
            if !known.insert(name.clone()) {
                let reason = format!("the participant `{name}` stands here a second time");
                self.fail_at(place, reason);
            }
            names.push(name);
            results.push(result);
        }
        let unit: Option<Unit> = wanted.flatten();
        let named = names.iter().zip(&mut results);
        let mut named: Vec<branches::Named<'_>> =
            named.map(|(name, result)| (name.clone(), &mut result.stated)).collect();
        if let Err(reason) = self.on_one_branch(&mut named, unit.as_ref()) {
            self.fail(reason);
        }
        // all have one unit
        self.units = vec![unit.map(|unit| unit.to_string()).unwrap_or_default()];
        let participant = |(label, ReadResult { stated, has_uncertainty }): (String, _)| {
            let StatedResult { value, expanded, factor, .. } = stated;
            let uncertainty = has_uncertainty.then_some(StatedUncertainty { expanded, factor });
            Participant { label, value, uncertainty }
        };
        let participants = names.into_iter().zip(results).map(participant);
        Some(ComparisonTable::Proficiency(participants.collect()))
    }

    /// The result of a row in the unit of the first one; `None` after an error.
    fn participant(&mut self, row: usize, wanted: &mut Option<Option<Unit>>) -> Option<ReadResult> {
        let x = self.columns.place(Role::Value(0))?;
        let roles = [Role::Expanded(0), Role::Standard(0)];
        let mut widths = roles.into_iter().filter_map(|role| self.columns.place(role));
        let has_uncertainty = widths.any(|place| !self.numbers.is_empty(row, place));
        let result = if has_uncertainty {
            self.stated(row, 0)?
        } else {
            let value = self.in_unit(row, x)?;
            let none =
                Number { value: 0.0, printed: 0.0, half_unit: 0.0, unit: value.unit.clone() };
            let stated = StatedResult::new(value.value, 0.0, USUAL_FACTOR);
            InUnits { value, uncertainty: none, stated, column: x, of_run: None }
        };
        let place = self.numbers.table.place(row, result.column);
        let unit = wanted.get_or_insert(result.value.unit.clone()).clone();
        let stated = self.converted(row, result, unit.as_ref())?;
        if has_uncertainty && stated.expanded == 0.0 {
            let kind = DiagnosticKind::NotPositive { key: "U".into(), found: 0.0 };
            self.numbers.log.report_at(place, kind);
            return None;
        }
        Some(ReadResult { stated, has_uncertainty })
    }
}

/// How the assigned value is chosen, from texts such as `algorithm-a`, `median` and `10.5 mg`, and the
/// standard uncertainty of a stated value, in `unit`, that of the results.
///
/// # Errors
/// What is wrong, as a sentence that begins with the option.
pub fn assigned_by(
    text: Option<&str>,
    uncertainty: Option<&str>,
    unit: Option<&Unit>,
) -> Result<Option<AssignedBy>, String> {
    let named = [AssignedBy::AlgorithmA, AssignedBy::Median];
    let chosen = text.and_then(|text| named.into_iter().find(|by| by.name() == text));
    let Some(text) = text.filter(|_| chosen.is_none()) else {
        return match uncertainty {
            Some(_) => Err("`--assigned-u` is the standard uncertainty of a stated value: write \
                            `--assigned VALUE` with it, since that of an average follows from the \
                            results"
                .to_owned()),
            None => Ok(chosen),
        };
    };
    let value = stated(text, unit, ValueOf::Quantity)
        .map_err(|reason| of_option("--assigned", text, named.map(AssignedBy::name), &reason))?;
    let standard_uncertainty = match uncertainty {
        Some(text) => Some(match width(text, unit) {
            Ok(StatedWidth::Own(u)) => u,
            Ok(StatedWidth::Share(share)) => share * value.abs(),
            Err(reason) => return Err(format!("`--assigned-u {text}`: {reason}")),
        }),
        None => None,
    };
    Ok(Some(AssignedBy::Stated { value, standard_uncertainty }))
}

/// How the standard deviation for proficiency assessment is chosen, from texts such as
/// `algorithm-a`, `niqr`, `0.2 mg` and `5 %`, which is a fraction of the assigned value unless the
/// results have that unit.
///
/// # Errors
/// As [`assigned_by`].
pub fn sigma_by(text: Option<&str>, unit: Option<&Unit>) -> Result<Option<SigmaBy>, String> {
    let Some(text) = text else { return Ok(None) };
    let named = [SigmaBy::AlgorithmA, SigmaBy::NormalizedIqr];
    if let Some(by) = named.into_iter().find(|by| by.name() == text) {
        return Ok(Some(by));
    }
    match width(text, unit) {
        Ok(StatedWidth::Own(sigma)) => Ok(Some(SigmaBy::Stated(sigma))),
        Ok(StatedWidth::Share(share)) => Ok(Some(SigmaBy::ShareOfAssigned(share))),
        Err(reason) => Err(of_option("--sigma", text, named.map(SigmaBy::name), &reason)),
    }
}

/// The message about an option that is neither a name nor a value.
fn of_option(option: &str, text: &str, names: [&str; 2], reason: &str) -> String {
    let near = nearest(text, names).map(|name| format!("; did you mean `{name}`?"));
    let [first, second] = names;
    format!(
        "`{option} {text}`: {reason}; the option takes `{first}`, `{second}` or a value in the unit of \
         the results{}",
        near.unwrap_or_default()
    )
}

/// A width that is stated.
enum StatedWidth {
    /// In the unit of the results.
    Own(f64),
    /// As a fraction of the assigned value.
    Share(f64),
}

/// A width in the unit of the results, or a fraction.
fn width(text: &str, unit: Option<&Unit>) -> Result<StatedWidth, String> {
    if let Some((value, behind)) = with_unit(text)
        && let Ok(own) = Unit::parse(behind)
    {
        match Share::of(&own, unit) {
            Share::Own => {}
            // nothing is known of the results' unit, and they may be numbers
            Share::OfValue if unit.is_none() => return Err(two_meanings(own.text(), "1")),
            Share::OfValue => return Ok(StatedWidth::Share(value * own.factor())),
            Share::Doubtful => {
                return Err(two_meanings(own.text(), unit.map_or("1", Unit::text)));
            }
        }
    }
    stated(text, unit, ValueOf::Difference).map(StatedWidth::Own)
}

/// A number, or a value with a unit, in the unit of the results.
fn stated(text: &str, unit: Option<&Unit>, of: ValueOf) -> Result<f64, String> {
    if let Some(value) = bare_number(text) {
        return Ok(value);
    }
    match (with_unit(text), unit) {
        (Some(value), Some(unit)) => converted(value, unit, of, &[]),
        (Some((value, behind)), None) if is_comma(behind) => Err(decimal_comma(value, behind)),
        (Some(_), None) => {
            Err("the results have no unit to convert it to; write the unit into the \
                                heading of the results, or the number alone"
                .to_owned())
        }
        (None, _) => Err("it is no number".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volt() -> Option<Unit> {
        Some(Unit::parse("V").unwrap())
    }

    #[test]
    fn stated_values_have_the_unit_of_the_results() {
        let assigned = |text, u| assigned_by(Some(text), u, volt().as_ref());
        let by = |value, standard_uncertainty| {
            Ok(Some(AssignedBy::Stated { value, standard_uncertainty }))
        };
        assert_eq!(assigned("10.5", None), by(10.5, None));
        assert_eq!(assigned("10500 mV", Some("125 mV")), by(10.5, Some(0.125)));
        assert_eq!(assigned("-8", Some("0.5 %")), by(-8.0, Some(0.04)));
        assert_eq!(assigned("median", None), Ok(Some(AssignedBy::Median)));
        let sigma = |text| sigma_by(Some(text), volt().as_ref());
        assert_eq!(sigma("250 mV"), Ok(Some(SigmaBy::Stated(0.25))));
        assert_eq!(sigma("5 %"), Ok(Some(SigmaBy::ShareOfAssigned(0.05))));
        assert_eq!(sigma("niqr"), Ok(Some(SigmaBy::NormalizedIqr)));
        assert_eq!(sigma_by(None, None), Ok(None));
    }

    #[test]
    fn what_can_mean_two_things_is_an_error() {
        let percent = Unit::parse("%").unwrap();
        assert_eq!(sigma_by(Some("5 %"), Some(&percent)), Ok(Some(SigmaBy::Stated(5.0))));
        let said = |text, unit: Option<&Unit>| sigma_by(Some(text), unit).unwrap_err();
        let one = Unit::one();
        assert!(said("5 %", Some(&one)).contains("can be a share of the value"));
        assert!(said("5 mV", None).contains("have no unit to convert it to"));
        assert!(said("nique", None).contains("did you mean `niqr`?"));
        assert!(said("0,5", None).contains("`0.5`"));
        assert!(said("5 s", volt().as_ref()).contains("`--sigma 5 s`: "));
        let said = assigned_by(Some("median"), Some("0.1"), None).unwrap_err();
        assert!(said.contains("`--assigned VALUE`"));
        assert!(assigned_by(None, Some("0.1"), None).is_err());
    }

    /// 20 degC in K is a temperature, and a width of 2 degC is 2 K.
    #[test]
    fn temperatures_have_a_zero() {
        let kelvin = Unit::parse("K").unwrap();
        let found = assigned_by(Some("20 degC"), Some("2 degC"), Some(&kelvin));
        let (value, standard_uncertainty) = (293.15, Some(2.0));
        assert_eq!(found, Ok(Some(AssignedBy::Stated { value, standard_uncertainty })));
    }
}
