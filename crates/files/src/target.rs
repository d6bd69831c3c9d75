//! What a plan is asked for, as it is typed: `U(y) <= 0.01 m/s^2`, and `reference/drift = 1 yr`.

use gumption_analysis::plan::{Drift, DriftLaw, PlanTarget};
use gumption_engine::number::Shortest;
use gumption_engine::task::Task;
use gumption_text::value_text::{
    ValueOf, bare_number, converted, decimal_comma, grouped_digits, is_comma, with_unit,
};
use gumption_text::width::{LinearWidth, NOT_A_SUM, Width, number, share};
use gumption_units::nearest;

/// The form of a target, for messages.
const FORM: &str = "a target is written `U(y) <= 0.01 m/s^2` or `U(y)/y <= 0.5 %` (or `u(y)` for the \
                    standard uncertainty)";

/// A target of an output of a task: a value, a number in the output's unit, a share of the estimate
/// (`U(y)/y <= 0.5 %`), or both as in a specification (`U(y) <= 0.1 % + 2 uV`).
///
/// # Errors
/// Why it is none, in words: its form, an unknown output, another dimension, a value that is not
/// above zero, a share of a temperature or a level.
pub fn read_target(text: &str, task: &Task) -> Result<PlanTarget, String> {
    let form = || format!("`{text}` is not a target; {FORM}");
    let (left, right) = text.split_once('<').ok_or_else(form)?;
    let right = right.strip_prefix('=').unwrap_or(right).trim();
    let (kind, rest) = left.trim().split_once('(').ok_or_else(form)?;
    let expanded = match kind.trim() {
        "U" => true,
        "u" => false,
        _ => return Err(form()),
    };
    let (name, divisor) = rest.rsplit_once(')').ok_or_else(form)?;
    let (name, divisor) = (name.trim(), divisor.trim());
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
    let target = PlanTarget { output, expanded, share: 0.0, most: 0.0 };
    let wrong = |reason: String| format!("the target `{right}` of `{name}`{reason}");
    let (first, behind) = number(right).map_err(|_| form())?;
    if is_comma(behind) {
        return Err(wrong(format!(": {}", decimal_comma(first, behind))));
    }
    if first.is_nan() || first <= 0.0 || first.is_infinite() {
        return Err(wrong(" must be above zero".to_owned()));
    }
    match divisor.strip_prefix('/').map(str::trim) {
        None if divisor.is_empty() => {}
        Some(of) if of.trim_matches('|').trim() == name => {
            if unit.is_celsius() || !unit.level_exponent().is_zero() {
                return Err(wrong(format!(
                    ": a share of a value in `{unit}` means nothing; state it in that unit"
                )));
            }
            let factor = match share(behind) {
                Some((factor, "")) => factor,
                _ if behind.is_empty() => 1.0,
                _ => return Err(form()),
            };
            return Ok(PlanTarget { share: first * factor, ..target });
        }
        _ => return Err(form()),
    }
    if behind.is_empty() {
        return Ok(PlanTarget { most: first, ..target });
    }
    if unit.dimension().is_none() {
        // a share in the unit of an output that is itself a share
        let value = with_unit(right).ok_or_else(form)?;
        let most = converted(value, unit, ValueOf::Difference, &[])
            .map_err(|error| wrong(format!(": {error}")))?;
        if !unit.is_relative() && share(behind).is_some() {
            let (of, most) = (kind.trim(), Shortest(most));
            return Err(wrong(format!(
                " can be {most} or a share of its value: write `{of}({name}) <= {most}` for the one, \
                 `{of}({name})/{name} <= {right}` for the other"
            )));
        }
        return Ok(PlanTarget { most, ..target });
    }
    let width = Width::specification(right, unit, &[], None);
    let width = width.map_err(|reason| wrong(format!(": {reason}")))?;
    let LinearWidth { relative, absolute } =
        width.sum().ok_or_else(|| wrong(format!(": {NOT_A_SUM}")))?;
    Ok(PlanTarget { share: relative, most: absolute, ..target })
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
        let near =
            component.map(|component| component.name.as_str()).or_else(|| nearest(name, names));
        let near = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
        format!("there is no input or component `{name}`{near}")
    })?;
    let time = time.trim();
    let stated = with_unit(time).or_else(|| Some((bare_number(time)?, "")));
    let (stated, unit) = stated.ok_or_else(form)?;
    let unit = unit.trim().to_owned();
    let wrong = |reason: String| format!("the time `{time}` of the drift of `{name}`{reason}");
    if is_comma(&unit) {
        return Err(wrong(format!(": {}", decimal_comma(stated, &unit))));
    }
    if let Some(reason) = grouped_digits(&unit) {
        return Err(wrong(format!(": {reason}")));
    }
    // any word does, as the answer only repeats it, but no part of the number
    if unit.contains(|c: char| c.is_numeric()) {
        return Err(wrong(format!(
            ": `{unit}` is no unit of time; write a number and a word, such as `365 d`"
        )));
    }
    if stated > 0.0 && stated.is_finite() {
        Ok((Drift { variable, stated, law }, unit))
    } else {
        Err(wrong(" must be above zero".to_owned()))
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
        let of = |most| PlanTarget { output: 0, expanded: true, share: 0.0, most };
        assert_eq!(target("U(length) <= 0.01 m"), of(10.0));
        assert_eq!(target(" U( length )<0.5mm "), of(0.5));
        assert_eq!(target("U(length) <= 3"), of(3.0));
        assert_eq!(target("u(length) <= 2 mm"), PlanTarget { expanded: false, ..of(2.0) });
        let of_share = |share| PlanTarget { share, ..of(0.0) };
        assert_eq!(target("U(length) <= 0.5 %"), of_share(0.005));
        assert_eq!(target("U(length)/length <= 0.5 %"), of_share(0.005));
        assert_eq!(target("u(length) / |length| <= 1e-3").share, 1e-3);
        // products of 50 and 1 um with their factors, right to an ulp
        let both = target("U(length) <= 50 ppm + 1 um");
        assert!((both.share - 5e-5).abs() < 1e-19 && (both.most - 1e-3).abs() < 1e-18);
        let wrong = |text: &str| read_target(text, &task()).unwrap_err();
        assert!(wrong("U(lenght) <= 3").contains("did you mean `length`"));
        assert!(wrong("U(length) <= 3 s").contains("`3 s`"));
        assert!(wrong("U(length) <= 0").contains("above zero"));
        assert!(wrong("U(length) <= 0,0006 m").contains("such as `0.0006`"));
        assert!(wrong("U(length) <= -1 mm").contains("above zero"));
        for form in [
            "",
            "U(length)",
            "U(length) = 3",
            "U(length <= 3",
            "V(length) < 3",
            "U(length) <= x",
            "U(length) < 3 4",
            "U(length)/width < 3 %",
            "U(length)/length < 3 mm",
            "U(length)*2 < 3 mm",
        ] {
            assert!(read_target(form, &task()).is_err(), "{form}");
        }
        assert!(wrong("length <= 3").contains("is written"));
        // of a plain number a per cent is of it, or 0.01
        let ratio = Task::builder("").input("x", Input::normal(10.0, 0.1, "1").unwrap());
        let ratio = ratio.equation("q", "x").output("q", "1").trials(0).build().unwrap();
        let message = read_target("U(q) <= 0.1 %", &ratio).unwrap_err();
        assert!(message.contains("`U(q) <= 0.001` for the one"), "{message}");
        assert!(message.contains("`U(q)/q <= 0.1 %` for the other"), "{message}");
        assert_eq!(read_target("U(q)/q <= 0.1 %", &ratio).unwrap(), of_share(0.001));
        assert_eq!(read_target("U(q) <= 0.001", &ratio).unwrap(), of(0.001));
    }

    #[test]
    fn drifts() {
        let (drift, unit) = read_drift("x = 365 d", DriftLaw::Linear, &task()).unwrap();
        assert_eq!((drift.variable, drift.stated, unit.as_str()), (0, 365.0, "d"));
        assert!(read_drift("y = 1 d", DriftLaw::Linear, &task()).unwrap_err().contains('y'));
        assert!(read_drift("x = 0 d", DriftLaw::Linear, &task()).is_err());
        assert!(read_drift("x", DriftLaw::Linear, &task()).is_err());
        let (drift, unit) = read_drift("x=1.5 months", DriftLaw::Linear, &task()).unwrap();
        assert_eq!((drift.stated, unit.as_str()), (1.5, "months"));
    }

    /// What goes on behind the number is no unit of it.
    #[test]
    fn times_of_drifts_have_one_number() {
        for (time, said) in [
            ("1,5 year", "such as `1.5`"),
            ("1,5", "such as `1.5`"),
            ("1,000 d", "can be 1.000 or 1000"),
            ("1 000 d", "without spaces"),
            ("1 1/2 yr", "write a decimal fraction"),
            ("1 d (2)", "no unit of time"),
        ] {
            let error = read_drift(&format!("x={time}"), DriftLaw::Linear, &task()).unwrap_err();
            assert!(error.contains(said) && error.contains(&format!("`{time}`")), "{error}");
        }
    }
}
