//! What a plan is asked for, as it is typed: `U(y) <= 0.01 m/s^2`, and `reference/drift = 1 yr`.

use super::value_text::{ValueOf, converted, with_unit};
use super::width::number;
use gumption_analysis::plan::{Drift, DriftLaw, PlanTarget};
use gumption_engine::task::Task;
use gumption_units::nearest;

/// The form of a target, for messages.
const FORM: &str =
    "a target is written `U(y) <= 0.01 m/s^2` (or `u(y)` for the standard uncertainty)";

/// A target of an output of a task; a number without a unit is in the output's.
///
/// # Errors
/// Why it is none, in words: its form, an unknown output, another dimension, a value that is not
/// above zero.
pub fn read_target(text: &str, task: &Task) -> Result<PlanTarget, String> {
    let form = || format!("`{text}` is not a target; {FORM}");
    let (left, right) = text.split_once('<').ok_or_else(form)?;
    let right = right.strip_prefix('=').unwrap_or(right).trim();
    let left = left.trim();
    let (kind, rest) = left.split_once('(').ok_or_else(form)?;
    let expanded = match kind.trim() {
        "U" => true,
        "u" => false,
        _ => return Err(form()),
    };
    let name = rest.trim().strip_suffix(')').ok_or_else(form)?.trim();
    let names = || task.model.outputs.iter().map(|output| output.quantity.name.as_str());
    let output = names().position(|known| known == name).ok_or_else(|| {
        let known: Vec<&str> = names().take(20).collect();
        let near = nearest(name, names()).map(|near| format!("did you mean `{near}`? "));
        format!(
            "there is no output `{name}`; {}the outputs are {}",
            near.unwrap_or_default(),
            known.join(", ")
        )
    })?;
    let unit = task.model.outputs.get(output).map(|output| &output.quantity.unit);
    let unit = unit.ok_or_else(form)?;
    let most = match with_unit(right) {
        Some(value) => converted(value, unit, ValueOf::Difference, &[])
            .map_err(|error| format!("the target `{right}` of `{name}`: {error}"))?,
        None => match number(right) {
            Ok((value, "")) => value,
            _ => return Err(form()),
        },
    };
    if most > 0.0 && most.is_finite() {
        Ok(PlanTarget { output, expanded, most })
    } else {
        Err(format!("the target `{right}` of `{name}` must be above zero"))
    }
}

/// The drift of an input over a time, `NAME=TIME UNIT`, and the unit of the time as it is written.
///
/// # Errors
/// Why it is none, in words.
pub fn read_drift(text: &str, law: DriftLaw, task: &Task) -> Result<(Drift, String), String> {
    let form = || {
        format!(
            "`{text}` is not a drift; one is written `reference/drift=365 d`: the input or component \
             whose uncertainty is that of the drift over this time"
        )
    };
    let (name, time) = text.split_once('=').ok_or_else(form)?;
    let name = name.trim();
    let shown = || task.variables.iter().filter(|variable| variable.shown);
    let variable = task.variables.iter().position(|v| v.shown && v.name == name);
    let variable = variable.ok_or_else(|| {
        let part = format!("{name}/");
        let component = shown().find(|variable| variable.name.starts_with(&part));
        let names = shown().map(|variable| variable.name.as_str());
        let near = component.map(|of| of.name.as_str()).or_else(|| nearest(name, names));
        let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
        format!("there is no input or component `{name}`{near}")
    })?;
    let (stated, unit) = match with_unit(time.trim()) {
        Some((value, unit)) => (value, unit.trim().to_owned()),
        None => match number(time.trim()) {
            Ok((value, "")) => (value, String::new()),
            _ => return Err(form()),
        },
    };
    if stated > 0.0 && stated.is_finite() {
        Ok((Drift { variable, stated, law }, unit))
    } else {
        Err(format!("the time of the drift of `{name}` must be above zero"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::Input;

    fn task() -> Task {
        Task::builder("")
            .input("x", Input::normal(1.0, 0.1, "m").unwrap())
            .equation("length", "x")
            .output("length", "mm")
            .trials(0)
            .build()
            .unwrap()
    }

    #[test]
    fn targets() {
        let target = |text: &str| read_target(text, &task()).unwrap();
        let of = |most| PlanTarget { output: 0, expanded: true, most };
        assert_eq!(target("U(length) <= 0.01 m"), of(10.0));
        assert_eq!(target(" U( length )<0.5mm "), of(0.5));
        assert_eq!(target("U(length) <= 3"), of(3.0));
        assert_eq!(target("u(length) <= 2 mm"), PlanTarget { expanded: false, ..of(2.0) });
        let wrong = |text: &str| read_target(text, &task()).unwrap_err();
        assert!(wrong("U(lenght) <= 3").contains("did you mean `length`"));
        assert!(wrong("U(length) <= 3 s").contains("`3 s`"));
        assert!(wrong("U(length) <= 0").contains("above zero"));
        assert!(wrong("U(length) <= -1 mm").contains("above zero"));
        for form in [
            "",
            "U(length)",
            "U(length) = 3",
            "U(length <= 3",
            "V(length) < 3",
            "U(length) <= x",
            "U(length) < 3 4",
        ] {
            assert!(read_target(form, &task()).is_err(), "{form}");
        }
        assert!(wrong("length <= 3").contains("is written"));
    }

    #[test]
    fn drifts() {
        let (drift, unit) = read_drift("x = 365 d", DriftLaw::Linear, &task()).unwrap();
        assert_eq!((drift.variable, drift.stated, unit.as_str()), (0, 365.0, "d"));
        assert!(read_drift("y = 1 d", DriftLaw::Linear, &task()).unwrap_err().contains('y'));
        assert!(read_drift("x = 0 d", DriftLaw::Linear, &task()).is_err());
        assert!(read_drift("x", DriftLaw::Linear, &task()).is_err());
    }
}
