//! The conditions of a row, by which the results of a run are found.

use super::{ComparisonReader, answer};
use gumption_text::column_heading;
use gumption_units::Unit;

/// A condition of the run that the table has a column for.
pub(super) struct Condition<'a> {
    name: &'a str,
    place: usize,
    /// The unit of the run's values, where the answer says it.
    declared: Option<Unit>,
    /// The unit that the heading states.
    heading: Option<Unit>,
}

impl ComparisonReader<'_> {
    /// The conditions of a run in the table's columns; `None` after a heading with a unit that is none
    /// of the condition.
    pub(super) fn conditions<'a>(&self, answer: &'a answer::Answer) -> Option<Vec<Condition<'a>>> {
        let mut found = Vec::new();
        let mut is_right = true;
        for name in answer.conditions() {
            let Some(place) = self.columns.condition(name) else { continue };
            let declared = answer.unit_of(name).and_then(|unit| self.numbers.log.unit(unit).ok());
            let heading = self.unit_of_heading(answer, name, place, declared.as_ref());
            is_right &= heading.is_some();
            let heading = heading.flatten();
            found.push(Condition { name, place, declared, heading });
        }
        is_right.then_some(found)
    }

    /// The unit of a condition's heading, none within where it has none; `None` after a mistake.
    fn unit_of_heading(
        &self,
        answer: &answer::Answer,
        name: &str,
        place: usize,
        declared: Option<&Unit>,
    ) -> Option<Option<Unit>> {
        let heading = self.heading(place);
        if heading == name {
            return Some(None);
        }
        let fail = |reason: String| {
            self.fail(reason);
            None
        };
        let unit = |text: &str| self.numbers.log.unit(text);
        if let Some((_, text)) = column_heading::enclosed(heading, '[', "]")
            && let Err(error) = unit(text)
        {
            return fail(format!("`{heading}`: `{text}` is no unit: {error}"));
        }
        let one = Unit::one();
        let stated =
            column_heading::stated(|text| unit(text).ok(), heading, declared.unwrap_or(&one));
        let Some((found, text)) = stated else { return Some(None) };
        match declared {
            Some(declared) if found.is_compatible(declared) => Some(Some(found)),
            Some(declared) => fail(format!(
                "`{heading}`: the condition `{name}` of the run is in `{declared}`, to which \
                    `{text}` cannot be converted"
            )),
            None => fail(self.without_unit(answer, name, heading)),
        }
    }

    /// That an answer does not say what a unit would be converted to.
    fn without_unit(&self, answer: &answer::Answer, name: &str, found: &str) -> String {
        format!(
            "`{found}` has a unit, and `{}` does not say that of the condition `{name}`, as answers of \
             earlier versions do not: run the model again, or write the values in its unit, below `{name}`",
            answer.name
        )
    }

    /// The values of the conditions in a row, in the units of the run.
    pub(super) fn at<'a>(
        &self,
        row: usize,
        answer: &answer::Answer,
        conditions: &[Condition<'a>],
    ) -> Option<Vec<(&'a str, f64)>> {
        let value = |condition: &Condition<'a>| {
            let Condition { name, place, declared, heading } = condition;
            let found = self.numbers.number(row, *place)?;
            let fail = |reason: String| {
                self.fail_at(self.numbers.table.place(row, *place), reason);
                None
            };
            let text = self.numbers.table.text(row, *place);
            let unit = match (&found.unit, heading) {
                (Some(own), Some(heading)) if own.text() != heading.text() => {
                    return fail(format!(
                        "`{text}` stands in a column whose heading says `{heading}`"
                    ));
                }
                (own, heading) => own.as_ref().or(heading.as_ref()),
            };
            match (unit, declared) {
                (None, _) => Some((*name, found.value)),
                (Some(unit), Some(declared)) => match Unit::convert(found.value, unit, declared) {
                    Ok(value) => Some((*name, value)),
                    Err(error) => fail(format!("row {}, condition `{name}`: {error}", row + 1)),
                },
                (Some(_), None) => fail(self.without_unit(answer, name, text)),
            }
        };
        conditions.iter().map(value).collect()
    }
}
