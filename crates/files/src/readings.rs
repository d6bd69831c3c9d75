//! Readings as laboratories have them: in the model file, in columns of the conditions' table, in a
//! file, in groups; and whether they look independent.

use std::collections::HashMap;
use std::sync::Arc;

use super::reading_columns::ReadingColumns;
use super::{keys, samples};
use gumption_engine::decimal::{self, to_15_digits};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::Shortest;
use gumption_engine::regression::{CurveFunction, Spread};
use gumption_engine::special;
use gumption_engine::task::Sharing;
use gumption_text::angle_branches::{branches, turn};
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::table::{self, Table};
use gumption_text::value_text::{ValueOf, is_value};
use gumption_text::{DiagnosticKind, Folder, Place, column_heading};
use gumption_units::{Unit, nearest};

/// Readings of a file, with what is to be said of them.
#[derive(Clone, Debug, Default)]
pub(super) struct FileReadings {
    /// The readings, or the means of the groups: of all rows of the conditions, or of each row.
    pub(super) lists: Vec<Vec<f64>>,
    /// Which rows share a value, where each row has readings.
    pub(super) sharing: Option<Sharing>,
    pub(super) note: Option<Fact>,
    /// The file that replaces what the model says, and the place of the readings in it.
    pub(super) replacing: Option<(String, Place)>,
}

impl FileReadings {
    /// The readings of all rows.
    fn of_all_rows(values: Vec<f64>, note: Option<Fact>) -> Self {
        Self { lists: vec![values], note, ..Self::default() }
    }

    /// The readings in a row.
    pub(super) fn in_row(&self, row: usize) -> &[f64] {
        self.lists.get(row).or(self.lists.first()).map_or(&[], Vec::as_slice)
    }
}

/// Whether every row of the conditions has readings of its own: those of a file, or else those of the
/// columns of the conditions' table that `values` names.
pub(super) fn are_of_rows(object: &Object<'_>, read: Option<&FileReadings>) -> bool {
    if let Some(read) = read {
        return read.lists.len() > 1;
    }
    let Some(Json::List(list)) = object.get("values").map(|member| &member.value.value) else {
        return false;
    };
    list.iter().any(is_formula)
}

/// The names in the formulas that `values` lists: columns of the conditions' table that are readings.
pub(super) fn columns_of(object: &Object<'_>) -> Vec<String> {
    let Some(Json::List(list)) = object.get("values").map(|member| &member.value.value) else {
        return Vec::new();
    };
    let texts = list.iter().filter(|node| is_formula(node)).filter_map(|node| match &node.value {
        Json::Text(text) => object.log.formula(text).ok(),
        _ => None,
    });
    texts
        .flat_map(|formula| formula.names().map(|(name, _)| name.to_owned()).collect::<Vec<_>>())
        .collect()
}

/// Whether a reading is a text that is no value.
pub(super) fn is_formula(node: &Node) -> bool {
    matches!(&node.value, Json::Text(text) if !is_value(text))
}

/// Reads the readings of the object's `file`, if it names one, and adds its content to `files`.
/// Outside `None` without a file, inside after a mistake.
#[allow(clippy::option_option)]
pub(super) fn of_file(
    object: &Object<'_>,
    name: &str,
    unit: &Unit,
    folder: Folder<'_>,
    files: &mut Vec<(String, Vec<u8>)>,
) -> Option<Option<FileReadings>> {
    let file = object.get("file")?;
    if object.get("column").is_none() && object.get("groups").is_none() {
        let unit = (unit, ValueOf::Quantity);
        let numbers = samples::numbers(object, name, unit, folder, files);
        return Some(numbers.map(|(values, _)| FileReadings::of_all_rows(values, None)));
    }
    if let Some(second) = object.get("values") {
        let diagnostic = DiagnosticKind::Exclusive { first: "file", second: "values" };
        object.log.report(&second.key_span, diagnostic);
        return Some(None);
    }
    let mut read = || {
        object.required("column")?;
        let path = object.text("file")?;
        let wanted: Vec<&str> =
            ["column", "groups"].into_iter().filter_map(|key| object.text(key)).collect();
        let (table, bytes) =
            table::read(object.log, folder, path, &file.value.span, Some(&wanted))?;
        if !files.iter().any(|(known, _)| known == path) {
            files.push((path.to_owned(), bytes));
        }
        let values = column(object, "column", &table)?;
        if let (Some(member), Some(column)) = (object.get("column"), object.text("column")) {
            let heading =
                table.column(column).map_or(column, |place| table.columns[place].as_str());
            let of = (unit, ValueOf::Quantity);
            column_heading::check(object.log, &member.value.span, heading, of).then_some(())?;
        }
        if object.get("groups").is_none() {
            return Some(FileReadings::of_all_rows(values, None));
        }
        let groups = column(object, "groups", &table)?;
        grouped(object, name, &values, &groups)
    };
    Some(read())
}

/// The readings of a file that replace those of the object, which has one of these names. Outside `None`
/// without such a column, inside after an error.
#[allow(clippy::option_option)]
pub(super) fn replacing(
    columns: &ReadingColumns<'_>,
    object: &Object<'_>,
    names: &[&str],
    unit: &Unit,
) -> Option<Option<FileReadings>> {
    let replaced = columns.of(names, unit)?;
    let name = names.first().copied().unwrap_or_default();
    let read = || {
        let read = replaced?;
        if object.get("groups").is_none() {
            return Some(read);
        }
        let labels = columns.labels(object.text("groups")?, name)?;
        let grouped = grouped(object, name, read.in_row(0), &labels)?;
        Some(FileReadings { lists: grouped.lists, note: grouped.note, ..read })
    };
    Some(read())
}

/// The numbers of the column that `key` names.
fn column(object: &Object<'_>, key: &'static str, table: &Table) -> Option<Vec<f64>> {
    let name = object.text(key)?;
    let Some(place) = table.column(name) else {
        let reason = table.no_column(name);
        let span = object.get(key).map_or(object.place(), |member| &member.value.span);
        object.log.report(span, DiagnosticKind::Table { reason });
        return None;
    };
    Some(table.rows.iter().filter_map(|row| row.get(place)).copied().collect())
}

/// The mean of each group, with the analysis of variance (JCGM 100, H.5).
fn grouped(
    object: &Object<'_>,
    name: &str,
    values: &[f64],
    labels: &[f64],
) -> Option<FileReadings> {
    let mut groups: Vec<(f64, Vec<f64>)> = Vec::new();
    let mut places: HashMap<u64, usize> = HashMap::new();
    for (&value, &label) in values.iter().zip(labels) {
        // the two zeros are one label
        let place = *places.entry((label + 0.0).to_bits()).or_insert(groups.len());
        match groups.get_mut(place) {
            Some((_, members)) => members.push(value),
            None => groups.push((label, vec![value])),
        }
    }
    let count = groups.len();
    if count < 2 {
        let reason = format!("`{name}` has {count} group of readings; a nested design needs two");
        let span = object.get("groups").map_or(object.place(), |member| &member.value.span);
        object.log.report(span, DiagnosticKind::Table { reason });
        return None;
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let squares =
        |values: &[f64], about: f64| values.iter().map(|x| (x - about).powi(2)).sum::<f64>();
    let means: Vec<f64> = groups.iter().map(|(_, members)| mean(members)).collect();
    let within: f64 =
        groups.iter().zip(&means).map(|((_, group), mean)| squares(group, *mean)).sum();
    let within_dof = (values.len() - count) as f64;
    let whole = mean(&means);
    let of_means = squares(&means, whole) / (count as f64 - 1.0);
    let shown = |x: f64, digits| Argument::Number(decimal::significant(x, digits));
    let sizes: Vec<usize> = groups.iter().map(|(_, members)| members.len()).collect();
    let size = sizes.first().copied().unwrap_or(0);
    let balanced = sizes.iter().all(|other| *other == size);
    let repeatability = (within / within_dof).sqrt();
    let within = (within_dof > 0.0 && repeatability > 0.0).then(|| {
        let between = if balanced {
            let ratio = size as f64 * of_means / (repeatability * repeatability);
            let between = (of_means - repeatability * repeatability / size as f64).max(0.0).sqrt();
            let p = f_upper(ratio, count as f64 - 1.0, within_dof);
            let (deviation, ratio) = (shown(between, 3), shown(ratio, 3));
            fact!("groups.between", deviation, ratio, probability = shown(p, 2))
        } else {
            fact!("groups.of-other-sizes")
        };
        fact!("groups.within", deviation = shown(repeatability, 3), between)
    });
    let note = fact!("nested-readings", name, groups = count, dof = count - 1, within);
    Some(FileReadings::of_all_rows(means, Some(note)))
}

/// The probability of a larger F with these degrees of freedom.
fn f_upper(f: f64, first: f64, second: f64) -> f64 {
    special::beta::cdf(second / (second + first * f), 0.5 * second, 0.5 * first)
}

/// Readings from which on a drift or an autocorrelation is looked for.
const LEAST_FOR_DRIFT: usize = 6;
const LEAST_FOR_AUTOCORRELATION: usize = 10;

/// What speaks against independent readings in the order in which they were taken: a drift (the t
/// test of the slope of a straight line, two-sided), or a positive autocorrelation (von Neumann's
/// ratio, by its normal approximation). Each finds something in one of 100 sets of independent normal
/// readings.
pub(super) fn dependence(name: &str, values: &[f64]) -> Option<Fact> {
    let n = values.len() as f64;
    if values.len() < LEAST_FOR_DRIFT {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let middle = 0.5 * (n - 1.0);
    let times = || (0..values.len()).map(|i| i as f64 - middle);
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    if squares <= 0.0 {
        return None;
    }
    let of_times: f64 = times().map(|t| t * t).sum();
    let slope = times().zip(values).map(|(t, x)| t * (x - mean)).sum::<f64>() / of_times;
    let left = (squares - slope * slope * of_times).max(0.0);
    let critical = special::student::two_sided_factor(0.99, n - 2.0);
    if slope * slope * of_times * (n - 2.0) > critical * critical * left {
        let change = Argument::Number(decimal::significant(slope * (n - 1.0), 3));
        return Some(fact!("dependent-readings.drift", name, count = values.len(), change));
    }
    if values.len() < LEAST_FOR_AUTOCORRELATION {
        return None;
    }
    let steps: f64 = values.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let score = (steps / squares - 2.0) / (4.0 * (n - 2.0) / (n * n - 1.0)).sqrt();
    let critical = special::normal::quantile(0.01);
    (score < critical).then(|| {
        let ratio = Argument::Number(decimal::significant(steps / squares, 3));
        fact!("dependent-readings", name, count = values.len(), ratio)
    })
}

/// Refuses readings of an angle on both sides of a turn, 359.9 deg and 0.1 deg, whose mean is far from all of
/// them.
pub(super) fn refuse_branches(
    object: &Object<'_>,
    values: &[f64],
    unit: &Unit,
    read: Option<&FileReadings>,
) {
    let Some(turn) = turn(unit) else { return };
    let Ok(added) = branches(values, turn) else { return };
    let moved = values.iter().zip(&added).find(|(_, turns)| **turns != 0.0);
    let (Some(first), Some((value, turns))) = (values.first(), moved) else { return };
    let found = unit.after(&Shortest(*value).to_string());
    let reason = format!(
        "it and the reading {} lie on both sides of a turn, and their mean is far from both; write it as {}",
        unit.after(&Shortest(*first).to_string()),
        unit.after(&Shortest(to_15_digits(value + turns * turn)).to_string())
    );
    let key = if object.get("file").is_some() { "file" } else { "values" };
    let place = object.get(key).map_or(object.place(), |member| &member.value.span);
    let kind = DiagnosticKind::Value { key: key.to_owned(), found, reason };
    match read.and_then(|read| read.replacing.as_ref()) {
        Some((_, place)) => object.log.report_at(place.clone(), kind),
        None => object.log.report(place, kind),
    }
}

/// What stands in place of the scatter of readings.
#[derive(Clone, Debug)]
pub(super) enum Pooled {
    /// A standard deviation of one reading with its degrees of freedom.
    Stated(f64, f64),
    /// The residuals of a calibration function.
    Residuals(Arc<CurveFunction>),
}

/// What stands in place of the scatter, which may come from one of the calibration functions. Outside
/// `None` after a mistake.
#[allow(clippy::option_option)]
pub(super) fn pooled(
    object: &Object<'_>,
    unit: &Unit,
    curves: &[Arc<CurveFunction>],
) -> Option<Option<Pooled>> {
    let Some(member) = object.get("pooled") else { return Some(None) };
    let pooled = Object::new(object.log, "`pooled`", &member.value, &member.key_span)?;
    keys::check(&pooled, keys::POOLED);
    if let Some(fit) = pooled.get("fit") {
        for second in ["std", "dof"] {
            if let Some(member) = pooled.get(second) {
                let diagnostic = DiagnosticKind::Exclusive { first: "fit", second };
                pooled.log.report(&member.key_span, diagnostic);
                return None;
            }
        }
        let name = pooled.text("fit")?;
        let reason = match curves.iter().find(|curve| curve.fit.name == name) {
            Some(curve) if curve.fit.factor.is_none() || curve.fit.points.of_y != Spread::None => {
                format!(
                    "the uncertainties of `{name}` are stated, so that its residuals give no scatter; state \
                 `std` and `dof`"
                )
            }
            Some(curve) if !curve.fit.is_linear() => format!(
                "`{name}` is not linear in its parameters and exact in x, so that its scatter is drawn \
                 with its points; state `std` and `dof`"
            ),
            Some(curve) => return Some(Some(Pooled::Residuals(Arc::clone(curve)))),
            None => match nearest(name, curves.iter().map(|curve| curve.fit.name.as_str())) {
                Some(near) => format!("there is no fit `{name}`; did you mean `{near}`?"),
                None => format!("there is no fit `{name}` in the file"),
            },
        };
        pooled.log.report(&fit.value.span, DiagnosticKind::Table { reason });
        return None;
    }
    pooled.required("std")?;
    pooled.required("dof")?;
    let positive = |key: &'static str, found: Option<f64>| {
        let found = found?;
        if found > 0.0 {
            return Some(found);
        }
        let span = pooled.get(key).map_or(pooled.place(), |member| &member.value.span);
        let key = key.to_owned();
        pooled.log.report(span, DiagnosticKind::NotPositive { key, found });
        None
    };
    let std = positive("std", pooled.value("std", unit, ValueOf::Difference));
    let dof = positive("dof", pooled.number("dof"));
    Some(Some(Pooled::Stated(std?, dof?)))
}

#[cfg(test)]
mod tests {
    use gumption_engine::number::elementary;

    use super::*;
    use crate::{ModelFile, read as read_model};
    use gumption_text::Diagnostics;

    /// A model of an input `x`, in a folder with these files.
    fn model(input: &str, more: &str, files: &[(&str, &str)]) -> Result<ModelFile, Diagnostics> {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in files {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        let text = format!(
            r#"{{"inputs": {{"x": {input}}}{more}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{"unit": "V"}}}}}}"#
        );
        std::fs::write(folder.path().join("m.json"), text).unwrap();
        read_model(&folder.path().join("m.json"), &[])
    }

    /// Estimate, standard uncertainty and degrees of freedom of the input in a row.
    fn known(file: &ModelFile, row: usize) -> [f64; 3] {
        let of = &file.task.rows[row].distributions[0];
        [of.mean(), of.standard_uncertainty(), of.dof()]
    }

    /// JCGM 100, H.5 (table H.9): ten days with five readings each, rebuilt to the published mean and
    /// standard deviation of each day by the pattern -2, -1, 0, 1, 2 over sqrt(2.5). Published:
    /// 10.000 097 V, 18 uV with 9 degrees of freedom, s_a 128 uV over s_b 85 uV, F = 2.25.
    #[test]
    fn nested_readings_of_the_guide() {
        const MEANS: [f64; 10] = [172., 116., 13., 144., 106., 31., 60., 125., 163., 41.];
        const DEVIATIONS: [f64; 10] = [60., 77., 111., 101., 67., 93., 80., 73., 88., 86.];
        let mut table = "day,v\n".to_owned();
        for (day, (mean, deviation)) in MEANS.iter().zip(DEVIATIONS).enumerate() {
            for step in -2..=2 {
                let offset = mean + deviation * f64::from(step) / 2.5_f64.sqrt();
                table.push_str(&format!("{},{:.12}\n", day + 1, 10.0 + 1e-6 * offset));
            }
        }
        let input = r#"{"unit": "V", "distribution": "readings", "file": "h5.csv", "column": "v",
            "groups": "day"}"#;
        let file = model(input, "", &[("h5.csv", &table)]).unwrap();
        let [mean, u, dof] = known(&file, 0);
        assert!((mean - 10.000_097).abs() < 0.5e-6, "{mean}");
        assert!((u - 18e-6).abs() < 0.5e-6 && dof == 9.0, "{u} {dof}");
        // published: 85 uV within days, 43 uV between them, F = 2.25 by rounded numbers
        let Some(Argument::Fact(within)) = file.warnings[0].fact.argument("within") else {
            panic!("{:?}", file.warnings);
        };
        assert_eq!(within.argument("deviation"), Some(&Argument::number("0.0000849")));
        let Some(Argument::Fact(between)) = within.argument("between") else {
            panic!("{within:?}");
        };
        assert_eq!(between.argument("deviation"), Some(&Argument::number("0.0000426")));
        assert_eq!(between.argument("ratio"), Some(&Argument::number("2.26")));
    }

    /// Columns of the conditions' table, and degrees of freedom by a formula.
    #[test]
    fn readings_in_columns_of_the_conditions() {
        let table = "f,r1,r2,r3,n\n10,1,2,3,3\n20,4,4,7,5\n";
        let conditions = r#", "conditions": {"file": "c.csv", "units": {"f": "Hz", "r1": "mV",
            "r2": "mV", "r3": "mV"}}"#;
        let input = r#"{"unit": "V", "distribution": "readings", "values": ["r1", "r2", "r3"]}"#;
        let file = model(input, conditions, &[("c.csv", table)]).unwrap();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
        let [first, second] = [known(&file, 0), known(&file, 1)];
        assert!(close(first[0], 2e-3) && close(first[1], 1e-3 / 3.0_f64.sqrt()));
        assert!(close(second[0], 5e-3) && close(second[1], 1e-3) && second[2] == 2.0);
        let input = r#"{"unit": "V", "distribution": "normal", "mean": 1, "std": 1, "dof": "n-1"}"#;
        let file = model(input, conditions, &[("c.csv", table)]).unwrap();
        assert_eq!([known(&file, 0)[2], known(&file, 1)[2]], [2.0, 4.0]);
        let wrong = r#"{"unit": "V", "distribution": "readings", "values": ["r1", "r9"]}"#;
        let error = model(wrong, conditions, &[("c.csv", table)]).unwrap_err().to_string();
        assert!(error.contains("`r9` is not defined"), "{error}");
        let wrong = r#"{"unit": "V", "distribution": "readings", "values": ["r1", "f"]}"#;
        let error = model(wrong, conditions, &[("c.csv", table)]).unwrap_err().to_string();
        assert!(error.contains("`values` has the unit `Hz`"), "{error}");
    }

    /// Three equal readings of a digital instrument: half a step over sqrt(3) (JCGM 100, F.2.2.1).
    #[test]
    fn resolution_and_pooled_scatter() {
        let of = |fields: &str| {
            let input = format!(r#"{{"unit": "V", "distribution": "readings", {fields}}}"#);
            known(&model(&input, "", &[]).unwrap(), 0)
        };
        let equal = of(r#""values": [1, 1, 1], "resolution": 0.1"#);
        assert_eq!(equal[0], 1.0);
        assert!((equal[1] - 0.05 / 3.0_f64.sqrt()).abs() < 1e-16 && equal[2].is_infinite());
        let scattered = of(r#""values": [1, 2, 3], "resolution": "100 mV""#);
        assert!((scattered[1] - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15 && scattered[2] == 2.0);
        // EA-4/02 S2: a pooled standard deviation of 25 mg of earlier readings, three readings
        let pooled = of(r#""values": [1, 2, 3], "pooled": {"std": 0.025, "dof": 30}"#);
        assert!((pooled[1] - 0.025 / 3.0_f64.sqrt()).abs() < 1e-16 && pooled[2] == 30.0);
        // JCGM 101, 6.4.9.4: sqrt((n - 1)/(n - 3)) s/sqrt(n)
        let bayesian = of(r#""values": [1, 2, 3, 4, 5], "evaluation": "bayesian""#);
        let expected = (2.5_f64 / 5.0).sqrt() * 2.0_f64.sqrt();
        assert!((bayesian[1] - expected).abs() < 1e-14 && bayesian[2].is_infinite());
        let components = r#"{"unit": "V", "components": [
            {"name": "rep", "distribution": "readings", "values": [1, 1, 1]},
            {"name": "res", "distribution": "rectangular", "half_width": 0.05}]}"#;
        let file = model(components, "", &[]).unwrap();
        assert_eq!(file.warnings[0].fact, fact!("no-scatter", name = "x/rep"));
        let alone = r#"{"unit": "V", "distribution": "readings", "values": [1, 1, 1]}"#;
        assert!(model(alone, "", &[]).unwrap_err().to_string().contains("no scatter"));
    }

    /// Mean, standard deviation of one reading and their number: JCGM 100, 4.4.3 prints 1.489 degC of
    /// twenty readings, u = 0.333 degC.
    #[test]
    fn readings_by_their_mean_scatter_and_number() {
        let of = |fields: &str| {
            let input = format!(r#"{{"unit": "V", "distribution": "readings", {fields}}}"#);
            model(&input, "", &[])
        };
        let stated = |fields: &str| known(&of(fields).unwrap(), 0);
        let u = 1.489 / 20_f64.sqrt();
        let guide = stated(r#""mean": 100.145, "s": 1.489, "n": 20"#);
        assert!(guide[0] == 100.145 && (guide[1] - u).abs() < 1e-15 && guide[2] == 19.0);
        assert_eq!(stated(r#""mean": "100.145 V", "s": "1489 mV", "n": 20"#)[2], 19.0);
        let pooled = stated(r#""mean": 2, "n": 3, "pooled": {"std": 0.025, "dof": 30}"#);
        assert!((pooled[1] - 0.025 / 3_f64.sqrt()).abs() < 1e-16 && pooled[2] == 30.0);
        let equal = stated(r#""mean": 2, "s": 0, "n": 3, "resolution": 0.1"#);
        assert!((equal[1] - 0.05 / 3_f64.sqrt()).abs() < 1e-16 && equal[2].is_infinite());
        for (fields, said) in [
            (r#""mean": 2, "s": 0.1"#, "`n`"),
            (r#""s": 0.1, "n": 3"#, "`mean`"),
            (r#""mean": 2, "n": 3"#, "`s`"),
            (r#""mean": 2, "s": 0.1, "n": 1"#, "readings"),
            (r#""mean": 2, "s": 0, "n": 3"#, "scatter"),
            (r#""values": [1, 2], "s": 0.1, "n": 3"#, "exclude"),
            (r#""mean": 2, "s": 0.1, "n": 3, "paired": true"#, "exclude"),
            (r#""mean": 2, "s": 0.1, "n": 3, "pooled": {"std": 1, "dof": 3}"#, "exclude"),
        ] {
            let error = of(fields).unwrap_err().to_string();
            assert!(error.contains(said), "{fields}: {error}");
        }
        let components = |more: &str| {
            let input = format!(
                r#"{{"unit": "V", {more} "components": [
                    {{"name": "rep", "distribution": "readings", "s": 0.3, "n": 9}},
                    {{"name": "res", "distribution": "rectangular", "half_width": 0.05}}]}}"#
            );
            model(&input, "", &[])
        };
        let file = components(r#""mean": 5,"#).unwrap();
        let of = &file.task.rows[0].distributions;
        assert_eq!([of[0].mean(), of[1].mean()], [5.0, 0.0]);
        assert!((of[1].standard_uncertainty() - 0.1).abs() < 1e-16 && of[1].dof() == 8.0);
        assert!(components("").unwrap_err().to_string().contains("`mean`"));
    }

    /// Inputs in one text, asymmetric ones, and limits.
    #[test]
    fn values_as_people_write_them() {
        let of = |input: &str| known(&model(input, "", &[]).unwrap(), 0);
        assert_eq!(of("\"5.0112(23) V\""), [5.0112, 0.0023, f64::INFINITY]);
        assert_eq!(of("\"5.0112 V ± 0.0046 V (k=2)\"")[1], 0.0023);
        let asymmetric = of("\"5 +0.2 -0.1 V\"");
        assert!((asymmetric[0] - 5.079_788_456_080_286_5).abs() < 1e-14);
        let milli = of(r#"{"unit": "V", "value": "5011.2(23) mV", "about": "reference"}"#);
        assert!((milli[0] - 5.0112).abs() < 1e-15 && (milli[1] - 0.0023).abs() < 1e-15);
        // half a normal: sqrt(2/pi)
        let half = of(
            r#"{"unit": "V", "distribution": "normal", "mean": 0, "std": 1, "limits": [0, null]}"#,
        );
        assert!((half[0] - (2.0 / std::f64::consts::PI).sqrt()).abs() < 1e-10);
        let quantiles =
            of(r#"{"unit": "V", "distribution": "quantiles", "probabilities": [0.025, 0.5, 0.975],
            "values": ["8.040036015459947 V", 10, 11.959963984540053]}"#);
        assert!((quantiles[0] - 10.0).abs() < 1e-9 && (quantiles[1] - 1.0).abs() < 1e-9);
        let error = model("\"5.0112 V ± 0.0046 V\"", "", &[]).unwrap_err().to_string();
        assert!(error.contains("state the coverage"), "{error}");
    }

    /// Twelve readings in a straight line, and a random walk.
    /// The mean of 359.9, 0.1, 0 and 359.8 deg is no 179.95 deg.
    #[test]
    fn readings_on_both_sides_of_a_turn_are_refused() {
        let of = |values: &str, unit: &str| {
            let text = format!(
                r#"{{"inputs": {{"x": {{"unit": "{unit}", "distribution": "readings", "values": {values}}}}},
                "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
            );
            crate::read_text("m", &text, std::path::Path::new(""), &[])
        };
        let message = of("[359.9, 0.1, 0.0, 359.8]", "deg").unwrap_err().to_string();
        assert!(message.contains("`0.1 deg` of `values`"), "{message}");
        assert!(message.contains("write it as 360.1 deg"), "{message}");
        for (values, unit) in
            [("[359.9, 360.1, 360.0]", "deg"), ("[10, 100, 179]", "deg"), ("[359.9, 0.1]", "V")]
        {
            assert!(of(values, unit).is_ok(), "{values} {unit}");
        }
    }

    #[test]
    fn drifting_readings_are_noticed() {
        let drift: Vec<f64> = (1..=12).map(|i| 1.0 + f64::from(i) / 1000.0).collect();
        let note = dependence("x", &drift).unwrap();
        let change = Argument::number("0.0110");
        let count = drift.len();
        assert_eq!(note, fact!("dependent-readings.drift", name = "x", count, change));
        let wave: Vec<f64> = (0..24).map(|i| elementary::sin(f64::from(i) * 0.5)).collect();
        assert_eq!(dependence("x", &wave).unwrap().key, "dependent-readings");
        let alternating: Vec<f64> = (0..12).map(|i| f64::from(i % 2)).collect();
        assert_eq!(dependence("x", &alternating), None);
        assert_eq!(dependence("x", &drift[..5]), None);
    }

    /// 4000 sets of 12 independent normal readings: each test finds 1 % of them (the approximation of
    /// von Neumann's ratio some 0.8 %), both together below 2 %. Five standard errors of 2 % are
    /// 1.1 %, so that the test fails in fewer than one of a million other seeds.
    #[test]
    fn independent_readings_are_seldom_suspected() {
        use gumption_engine::distribution::StreamKey;
        let mut suspected = 0;
        for set in 0..4000 {
            let mut uniforms = [0.0; 16];
            StreamKey::new(11, "readings").block(set).uniform(&mut uniforms);
            let readings: Vec<f64> =
                uniforms[..12].iter().map(|u| special::normal::quantile(*u)).collect();
            suspected += usize::from(dependence("x", &readings).is_some());
        }
        assert!((20..=124).contains(&suspected), "{suspected}");
    }

    /// F of 2.25 with 9 and 40 degrees of freedom: scipy.stats.f.sf gives 0.0383189 (JCGM 100, H.5.2.4
    /// has F = 2.25 between the points 2.12 of 5 % and 2.45 of 2.5 %).
    #[test]
    fn tails_of_f() {
        let p = f_upper(2.25, 9.0, 40.0);
        assert!((p - 0.038_318_870_739).abs() < 1e-11, "{p}");
    }
}
