//! The reference tells of everything that files and formulas may have.

use gumption_engine::model::formula;
use gumption_files::{FileReader, schema};

use super::distributions::uncertainty;
use super::functions::about;
use super::{Topic, markdown, table};

#[test]
fn every_function_and_distribution_is_told() {
    for (name, _) in formula::functions() {
        assert!(about(name).is_some(), "{name}");
    }
    for shape in schema::distributions() {
        assert!(uncertainty(shape.name).is_some(), "{}", shape.name);
    }
}

/// The stated standard uncertainty is that of the distribution: the formula of the table with
/// numbers for its keys, read as a model, against an input with the same numbers.
#[test]
fn uncertainties_are_those_of_the_distributions() {
    let examples = [
        ("rectangular", r#""mean": 5, "half_width": 0.3"#, "half_width = 0.3"),
        ("triangular", r#""mean": 5, "half_width": 0.3"#, "half_width = 0.3"),
        (
            "trapezoidal",
            r#""mean": 5, "half_width": 0.3, "beta": 0.4"#,
            "half_width = 0.3, beta = 0.4",
        ),
        (
            "curvilinear-trapezoid",
            r#""lower": 4, "upper": 6, "inexactness": 0.3"#,
            "lower = 4, upper = 6, inexactness = 0.3",
        ),
        ("arcsine", r#""mean": 5, "half_width": 0.3"#, "half_width = 0.3"),
        ("t", r#""mean": 5, "scale": 0.3, "dof": 5"#, "scale = 0.3"),
        ("exponential", r#""mean": 5"#, "mean = 5"),
        ("gamma", r#""shape": 3, "rate": 2"#, "shape = 3, rate = 2"),
        ("lognormal", r#""mean": 5, "std": 0.3"#, "std = 0.3"),
        (
            "beta",
            r#""alpha": 2, "beta": 3, "lower": 1, "upper": 4"#,
            "alpha = 2, beta = 3, lower = 1, upper = 4",
        ),
        ("log-uniform", r#""lower": 2, "upper": 7"#, "lower = 2, upper = 7"),
        ("poisson-count", r#""count": 8"#, "count = 8"),
    ];
    for (name, keys, numbers) in examples {
        let mut stated = uncertainty(name).unwrap().0.to_owned();
        for number in numbers.split(", ") {
            let (key, value) = number.split_once(" = ").unwrap();
            stated = stated.replace(key, &format!("({value})"));
        }
        let model = format!(
            r#"{{"inputs": {{"x": {{"unit": "1", "distribution": "{name}", {keys}}},
                             "zero": {{"unit": "1", "distribution": "normal", "mean": 0, "std": 1}}}},
                "equations": {{"y": "x", "u": "{stated} + 0*zero"}},
                "outputs": {{"y": {{"unit": "1"}}, "u": {{"unit": "1"}}}}}}"#
        );
        let folder = std::env::temp_dir();
        let read = FileReader::default().model_text("x.json", &model, &folder, &[]);
        let task = read.unwrap_or_else(|e| panic!("{name}: {e:?}")).task;
        let row = &task.rows[0];
        let own = row.distributions[0].standard_uncertainty();
        let told = gumption_engine::propagate::gum::evaluate(&task, row).outputs[1]
            .as_ref()
            .unwrap()
            .estimate;
        // both are a handful of roundings
        assert!((own / told - 1.0).abs() < 1e-12, "{name}: {own} is not {told}");
    }
}

#[test]
fn every_key_of_the_schema_is_told() {
    let told: String = Topic::ALL.into_iter().map(markdown).collect();
    let schema = schema::value();
    let mut keys = 0;
    for (name, node) in schema["$defs"].as_object().unwrap() {
        for key in node["properties"].as_object().into_iter().flatten().map(|(key, _)| key) {
            assert!(told.contains(&format!("`{key}`")), "{name}: {key}");
            keys += 1;
        }
    }
    assert!(keys > 300);
}

#[test]
fn pages_fit_a_terminal() {
    for topic in Topic::ALL {
        let page = table(topic);
        // examples stand as they are
        let widest = page.lines().filter(|line| !line.trim_start().starts_with('"'));
        assert!(widest.map(|line| line.chars().count()).max() <= Some(100), "{}", topic.name());
    }
}
