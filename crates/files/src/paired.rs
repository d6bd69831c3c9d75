//! Readings that belong together: `"paired": true`.

use super::input_set::InputSet;
use gumption_engine::distribution::{Distribution, Readings};
use gumption_engine::task::Trials;
use gumption_text::{Collector, DiagnosticKind};

/// Makes ensembles of the paired readings, all those of equal length one. The variables must be
/// complete in every row; else a mistake has been reported already. Where the file wants trials their
/// joint distribution must have a covariance.
pub(super) fn apply(log: &Collector, inputs: &mut InputSet, trials: Trials) {
    if !inputs.known.is_complete(inputs.variables.len()) {
        return;
    }
    let length = |v: usize| match inputs.known.get(v, 0).map(|d| &**d) {
        Some(Distribution::Readings(readings)) => readings.values().len(),
        _ => 0,
    };
    let mut ensembles: Vec<(usize, Vec<usize>)> = Vec::new();
    for &variable in &inputs.paired {
        let length = length(variable);
        match ensembles.iter_mut().find(|(known, _)| *known == length) {
            Some((_, members)) => members.push(variable),
            None => ensembles.push((length, vec![variable])),
        }
    }
    for (length, members) in &ensembles {
        if *length == 0 {
            for place in members.iter().filter_map(|member| inputs.places.get(*member)) {
                let reason =
                    "paired readings are drawn together and can have no `limits`".to_owned();
                log.report(place, DiagnosticKind::Correlation { reason });
            }
            continue;
        }
        if let Some((variable, diagnostic)) = mistake(inputs, *length, members, trials) {
            if let Some(place) = inputs.places.get(variable) {
                log.report(place, diagnostic);
            }
            continue;
        }
        for &member in members {
            inputs.known.change(member, |distribution| {
                if let Distribution::Readings(readings) = distribution
                    && let Ok(paired) = readings.clone().paired(members.len())
                {
                    *readings = paired;
                }
            });
        }
    }
}

/// Why these variables, read `length` times each, cannot be an ensemble, and the one at diagnostic.
fn mistake(
    inputs: &InputSet,
    length: usize,
    members: &[usize],
    trials: Trials,
) -> Option<(usize, DiagnosticKind)> {
    let name = |v: usize| inputs.variables.get(v).map_or("", |variable| variable.name.as_str());
    let (&first, others) = members.split_first()?;
    if others.is_empty() {
        let reason = if inputs.paired.len() > 1 {
            format!(
                "`{}` has {length} paired readings, but no other paired readings are as many; \
                 readings that belong together are equally many",
                name(first)
            )
        } else {
            format!(
                "`{}` has the only paired readings; paired readings are two or more",
                name(first)
            )
        };
        return Some((first, DiagnosticKind::Correlation { reason }));
    }
    let sharing = |v: usize| inputs.variables.get(v).map(|variable| &variable.sharing);
    if let Some(&other) = others.iter().find(|&&other| sharing(other) != sharing(first)) {
        let reason = format!(
            "`{}` and `{}` have paired readings, but not the same `per`",
            name(first),
            name(other)
        );
        return Some((other, DiagnosticKind::Correlation { reason }));
    }
    let Distribution::Readings(readings) = &**inputs.known.get(first, 0)? else {
        return None;
    };
    let error = match Readings::clone(readings).paired(members.len()) {
        Ok(_) if trials == Trials::Fixed(0) => return None,
        Ok(paired) => paired.without_covariance()?,
        Err(error) => error,
    };
    Some((first, DiagnosticKind::Distribution { name: name(first).to_owned(), error }))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::{FileReader, read_text};
    use gumption_engine::fact;
    use gumption_engine::number::CodePath;
    use gumption_engine::propagate::gum::{Dof, Gum};
    use gumption_engine::propagate::{Control, Evaluation, evaluate, trial_hash, warnings};
    use gumption_engine::task::{Task, Trials, Warning};

    fn read(inputs: &str, rest: &str, equation: &str) -> Result<Task, String> {
        let text = format!(
            "{{\"inputs\": {{{inputs}}}, {rest} \"equations\": {{\"y\": \"{equation}\"}}, \
             \"outputs\": {{\"y\": {{\"unit\": \"1\"}}}}, \"monte_carlo\": {{\"trials\": 20000}}}}"
        );
        read_text("test", &text, Path::new(""), &[])
            .map(|file| file.task)
            .map_err(|diagnostics| diagnostics.to_string())
    }

    fn run(inputs: &str, rest: &str, equation: &str) -> (Evaluation, Vec<Warning>) {
        let task = read(inputs, rest, equation).unwrap();
        let evaluation = evaluate(&task, &Control::default()).unwrap();
        let said = warnings(&task, &evaluation);
        (evaluation, said)
    }

    fn gum(evaluation: &Evaluation) -> &Gum {
        evaluation.rows[0].outputs[0].gum.as_ref().unwrap()
    }

    fn readings(name: &str, values: &str) -> String {
        format!(
            "\"{name}\": {{\"distribution\": \"readings\", \"paired\": true, \"values\": [{values}]}}"
        )
    }

    /// Voltage and current of JCGM 100, table H.2.
    fn voltage_and_current() -> String {
        let v = readings("V", "5.007, 4.994, 5.005, 4.990, 4.999");
        let i = readings("I", "19.663e-3, 19.639e-3, 19.640e-3, 19.685e-3, 19.678e-3");
        format!("{v}, {i}")
    }

    /// JCGM 100, H.2: r(V, I) = -0.36, and the impedance |Z| = V/I = 254.26 ohm with u = 0.236 ohm
    /// (tables H.2 and H.3). The paired readings are one term, so that the degrees of freedom are
    /// those of the five impedances of approach 2 (table H.4), 4.
    #[test]
    fn impedance_of_the_guide() {
        let (evaluation, _) = run(&voltage_and_current(), "", "V/I");
        let gum = gum(&evaluation);
        assert!((gum.correlations().next().unwrap().coefficient + 0.36).abs() < 5e-3);
        assert!((gum.estimate - 254.26).abs() < 5e-3, "{}", gum.estimate);
        assert!((gum.standard_uncertainty - 0.236).abs() < 5e-4, "{}", gum.standard_uncertainty);
        assert!(matches!(gum.dof, Dof::Finite(dof) if (dof - 4.0).abs() < 1e-9), "{:?}", gum.dof);
        let shares: f64 = gum.budget().map(|line| line.share).sum();
        assert!((shares + gum.correlations().next().unwrap().share - 1.0).abs() < 1e-12);
        // n - N = 3 in the trials: no kurtosis, no standard error of the standard deviation
        assert_eq!(evaluation.rows[0].outputs[0].drawn_dof, 3.0);
    }

    /// JCGM 100, H.2 whole: five readings of three quantities, whose joint t distribution has two
    /// degrees of freedom and no covariance, by the law of propagation alone. Estimates and standard
    /// uncertainties of table H.3 to their last digit; that of X is 0.2956 with all digits, from
    /// which the table's 0.295 was cut.
    #[test]
    fn the_example_of_the_guide_without_trials() {
        let text = |trials: u32| {
            let phase = readings("phi", "1.0456, 1.0438, 1.0468, 1.0428, 1.0433");
            format!(
                "{{\"inputs\": {{{}, {phase}}}, \"equations\": {{\"R\": \"V/I*cos(phi)\", \
                 \"X\": \"V/I*sin(phi)\", \"Z\": \"V/I\"}}, \"outputs\": {{\"R\": {{}}, \"X\": {{}}, \
                 \"Z\": {{}}}}, \"monte_carlo\": {{\"trials\": {trials}}}}}",
                voltage_and_current()
            )
        };
        let read = |trials| read_text("test", &text(trials), Path::new(""), &[]);
        let refused = read(20_000).unwrap_err().to_string();
        assert!(refused.contains("at least 6 are needed"), "{refused}");
        // what the command line says beats the file
        let reader = FileReader::default().making(Some(Trials::Fixed(0)));
        assert!(reader.model_text("test", &text(20_000), Path::new(""), &[]).is_ok());
        let task = read(0).expect("a task").task;
        let evaluation = evaluate(&task, &Control::default()).expect("an evaluation");
        let published = [(127.732, 0.071), (219.847, 0.2956), (254.260, 0.236)];
        for (output, (estimate, u)) in evaluation.rows[0].outputs.iter().zip(published) {
            let gum = output.gum.as_ref().expect("figures");
            assert!((gum.estimate - estimate).abs() < 5.1e-4, "{}", gum.estimate);
            assert!((gum.standard_uncertainty - u).abs() < 5.1e-4, "{}", gum.standard_uncertainty);
            assert!(matches!(gum.dof, Dof::Finite(dof) if (dof - 4.0).abs() < 1e-9));
        }
    }

    /// Welch-Satterthwaite with the ensemble as one term u_1 of 4 degrees of freedom beside a
    /// contribution u_2 of 10: (u_1^2 + u_2^2)^2 / (u_1^4 / 4 + u_2^4 / 10).
    #[test]
    fn an_ensemble_is_one_term() {
        let other = "\"d\": {\"distribution\": \"normal\", \"mean\": 0, \"std\": 0.2, \"dof\": 10}";
        let (alone, _) = run(&voltage_and_current(), "", "V/I");
        let (both, _) = run(&format!("{}, {other}", voltage_and_current()), "", "V/I + d");
        let (a, b) = (gum(&alone).standard_uncertainty.powi(2), 0.04_f64);
        let exact = (a + b).powi(2) / (a * a / 4.0 + b * b / 10.0);
        let Dof::Finite(dof) = gum(&both).dof else {
            panic!("{:?}", gum(&both).dof);
        };
        assert!((dof / exact - 1.0).abs() < 1e-9, "{dof}, {exact}");
    }

    /// Readings that are the same leave nothing of their difference, and a declared r of -1 nothing of a
    /// sum; nor is that a model that is not linear.
    #[test]
    fn nothing_is_left_of_what_cancels() {
        let same = "5.007, 4.994, 5.005, 4.990, 4.999, 5.003, 5.001, 4.998";
        let paired = format!("{}, {}", readings("a", same), readings("b", same));
        let normal = "{\"distribution\": \"normal\", \"mean\": 1.1, \"std\": 0.3}";
        let opposite = format!("\"a\": {normal}, \"b\": {normal}");
        for (inputs, rest, equation) in [
            (paired.as_str(), "", "a - b"),
            (opposite.as_str(), "\"correlations\": [[\"a\", \"b\", -1]],", "a + b"),
        ] {
            let (evaluation, said) = run(inputs, rest, equation);
            assert_eq!(gum(&evaluation).standard_uncertainty, 0.0, "{equation}");
            assert!(said.iter().all(|warning| warning.code() != "non-linear"), "{said:?}");
        }
    }

    /// All pairs have a line, in order, also of three quantities and of a component.
    #[test]
    fn every_pair_has_a_line() {
        let component = "\"c\": {\"components\": [{\"name\": \"r\", \"distribution\": \"readings\", \
                         \"paired\": true, \"values\": [1, 2, 3, 2, 1, 4, 5]}]}";
        let inputs = format!(
            "{}, {}, {component}",
            readings("a", "1, 3, 2, 5, 4, 6, 2"),
            readings("b", "1, 1, 2, 0, 4, 1, 7")
        );
        let (evaluation, said) = run(&inputs, "", "a + b + c");
        let pairs: Vec<[usize; 2]> =
            gum(&evaluation).correlations().map(|line| line.variables).collect();
        // 2 is the constant that the component is added to
        assert_eq!(pairs, [[0, 1], [0, 3], [1, 3]]);
        assert!(said.iter().all(|warning| warning.code() != "gaussian-copula"));
    }

    #[test]
    fn wrong_pairs_are_refused() {
        let five = readings("a", "1, 2, 3, 5, 4");
        let other = "\"b\": {\"distribution\": \"normal\", \"mean\": 0, \"std\": 1}";
        let single = read(&format!("{five}, {other}"), "", "a + b").unwrap_err();
        assert!(single.contains("`a` has the only paired readings"), "{single}");
        let six = readings("b", "1, 2, 3, 5, 4, 6");
        let uneven = read(&format!("{five}, {six}"), "", "a + b").unwrap_err();
        assert!(uneven.contains("`a` has 5") && uneven.contains("`b` has 6"), "{uneven}");
        let four = format!("{}, {}", readings("a", "1, 2, 3, 5"), readings("b", "1, 2, 2, 1"));
        let few = read(&four, "", "a + b").unwrap_err();
        assert!(few.contains("at least 5"), "{few}");
        let both = format!("{five}, {}", readings("b", "1, 2, 2, 1, 4"));
        let declared = "\"correlations\": [[\"a\", \"b\", 0.5]],";
        let twice = read(&both, declared, "a + b").unwrap_err();
        assert!(twice.contains("`a` and `b` is given twice"), "{twice}");
        let third = format!("{both}, \"c\": {}", other.split_once(": ").unwrap().1);
        let declared = "\"correlations\": [[\"c\", \"b\", 0.5]],";
        let also = read(&third, declared, "a + b + c").unwrap_err();
        assert!(also.contains("`b` is drawn together with the readings"), "{also}");
    }

    /// The trials of copulas and paired readings are the same bits in every compiled form of the
    /// inner loop and on any number of threads.
    #[test]
    fn the_same_bits_on_every_path() {
        let inputs = format!(
            "{}, \"t\": {{\"distribution\": \"t\", \"mean\": 1, \"scale\": 0.1, \"dof\": 4}}, \
             \"s\": {{\"distribution\": \"triangular\", \"lower\": 0, \"upper\": 1, \"mode\": 0.9}}, \
             \"n\": {{\"distribution\": \"normal\", \"mean\": 1, \"std\": 0.1}}",
            voltage_and_current()
        );
        let declared = "\"correlations\": [[\"t\", \"s\", 0.5], [\"s\", \"n\", -0.8]],";
        let task = read(&inputs, declared, "V/I + t*s + n").unwrap();
        let hash = |path, threads| {
            let control = Control::default().with_path(path).with_threads(threads);
            trial_hash(&task, 20_000, &control).unwrap()
        };
        let first = hash(CodePath::BASELINE, 1);
        for path in CodePath::available() {
            assert_eq!([hash(path, 1), hash(path, 3)], [first; 2], "{}", path.name());
        }
    }

    /// The note names those that the copula draws, and no others.
    #[test]
    fn the_copula_is_noted() {
        let rectangular = "{\"distribution\": \"rectangular\", \"mean\": 0, \"half_width\": 1}";
        let inputs = format!("\"a\": {rectangular}, \"b\": {rectangular}, \"c\": {rectangular}");
        let declared = "\"correlations\": [[\"a\", \"c\", 0.5]],";
        let (evaluation, said) = run(&inputs, declared, "a + b + c");
        assert_eq!(evaluation.copula, [0, 2]);
        let note = said.iter().find(|w| w.code() == "gaussian-copula").unwrap();
        assert_eq!(note.fact, fact!("gaussian-copula", names = vec!["`a`", "`c`"]));
        let (_, said) = run(&inputs, "", "a + b + c");
        assert!(said.iter().all(|warning| warning.code() != "gaussian-copula"));
    }
}
