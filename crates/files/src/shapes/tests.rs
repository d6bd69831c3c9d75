//! Every shape from the fields of a file.

use std::f64::consts::SQRT_2;
use std::path::Path;

use crate::keys::SHAPES;
use crate::{Override, read_text};
use gumption_engine::distribution::Distribution;

/// The distribution of an input with these fields, or all diagnostics as text.
fn read(fields: &str, set: &[&str]) -> Result<Distribution, String> {
    let text = format!(
        "{{\"inputs\": {{\"x\": {{{fields}}}}}, \"equations\": {{\"y\": \"x\"}}, \
         \"outputs\": {{\"y\": {{}}}}}}"
    );
    let overrides: Vec<Override> = set.iter().filter_map(|text| Override::parse(text)).collect();
    let file = read_text("m", &text, Path::new(""), &overrides).map_err(|p| p.to_string())?;
    Ok(file.task.rows[0].distributions[0].as_ref().clone())
}

/// Fields of an example of each shape, its estimate and standard uncertainty.
const EXAMPLES: [(&str, &str, f64, f64); 26] = [
    ("constant", "\"value\": 2", 2.0, 0.0),
    ("normal", "\"mean\": 2, \"std\": 0.5", 2.0, 0.5),
    ("rectangular", "\"mean\": 2, \"half_width\": 3", 2.0, 1.732_050_807_568_877_2),
    ("triangular", "\"lower\": 0, \"upper\": 6", 3.0, 1.224_744_871_391_589),
    ("trapezoidal", "\"lower\": 0, \"upper\": 6, \"beta\": 0.5", 3.0, 1.369_306_393_762_915_3),
    ("trapezoidal", "\"mean\": 3, \"half_width\": 3, \"beta\": 0", 3.0, 1.224_744_871_391_589),
    (
        "curvilinear-trapezoid",
        "\"lower\": -3, \"upper\": 3, \"inexactness\": 0.9",
        0.0,
        1.757_839_583_124_694_7,
    ),
    ("arcsine", "\"mean\": 3, \"half_width\": 2", 3.0, SQRT_2),
    ("u-shaped", "\"lower\": 1, \"upper\": 5", 3.0, SQRT_2),
    ("t", "\"mean\": 1, \"scale\": 2, \"dof\": 5", 1.0, 2.0),
    ("readings", "\"values\": [1, 3]", 2.0, 1.0),
    ("exponential", "\"mean\": 4", 4.0, 4.0),
    ("gamma", "\"shape\": 4, \"rate\": 2", 2.0, 1.0),
    ("lognormal", "\"mean\": 4, \"std\": \"10 %\"", 4.0, 0.4),
    ("beta", "\"alpha\": 1, \"beta\": 1", 0.5, 0.288_675_134_594_812_9),
    (
        "beta",
        "\"alpha\": 1, \"beta\": 1, \"lower\": -6, \"upper\": 6",
        0.0,
        3.464_101_615_137_754_6,
    ),
    ("log-uniform", "\"lower\": 1, \"upper\": 8", 3.366_288_428_740_914_7, 1.953_560_888_188_320_4),
    ("poisson-count", "\"count\": 3", 4.0, 2.0),
    ("split-normal", "\"mode\": 5, \"std_low\": 0.1, \"std_high\": 0.1", 5.0, 0.1),
    // Gamma(1 + 1/2) and sqrt(Gamma(2) - Gamma(1.5)^2)
    ("weibull", "\"shape\": 2, \"scale\": 1", 0.886_226_925_452_758, 0.463_251_375_176_104_2),
    // 1 + 2*0.5772156649015329 and 2*pi/sqrt(6)
    ("gumbel", "\"location\": 1, \"scale\": 2", 2.154_431_329_803_065_8, 2.565_099_660_323_728),
    // 5/4*2, and 2/4*sqrt(5/3)
    ("pareto", "\"shape\": 5, \"scale\": 2", 2.5, 0.645_497_224_367_902_8),
    ("chi-squared", "\"dof\": 8", 8.0, 4.0),
    ("binomial", "\"trials\": 100, \"probability\": 0.2", 20.0, 4.0),
    // 10*20/50, and sqrt(10*0.4*0.6*40/49)
    (
        "hypergeometric",
        "\"population\": 50, \"marked\": 20, \"draws\": 10",
        4.0,
        1.399_708_424_447_530_7,
    ),
    ("samples", "\"values\": [1, 2, 3, 6]", 3.0, 1.870_828_693_386_970_7),
];

#[test]
fn every_shape_is_read() {
    // those of files have their tests where these are read; moments of quantiles are less exact
    let elsewhere = ["result", "dcc", "codata", "quantiles"];
    for kind in SHAPES.iter().filter(|kind| !elsewhere.contains(&kind.name)) {
        assert!(EXAMPLES.iter().any(|(name, ..)| *name == kind.name), "{}", kind.name);
    }
    for (name, fields, mean, u) in EXAMPLES {
        let shape = read(&format!("\"distribution\": \"{name}\", {fields}"), &[]).unwrap();
        assert!((shape.mean() - mean).abs() < 1e-14, "{name}: {}", shape.mean());
        assert!((shape.standard_uncertainty() - u).abs() < 1e-14, "{name}: {shape:?}");
        let canonical = if name == "u-shaped" { "arcsine" } else { name };
        assert_eq!(shape.name(), canonical);
    }
}

#[test]
fn an_override_replaces_every_estimate() {
    for (name, fields, ..) in EXAMPLES {
        let fields = format!("\"distribution\": \"{name}\", {fields}");
        let shape = read(&fields, &["x=7"]).unwrap();
        assert!((shape.mean() - 7.0).abs() < 1e-14, "{name}: {}", shape.mean());
    }
    let count = "\"distribution\": \"poisson-count\", \"count\": 3";
    assert_eq!(read(count, &["x.count=8"]).unwrap().mean(), 9.0);
    assert!(read(count, &["x=0.5"]).unwrap_err().contains("count of events plus one"));
    let exponential = "\"distribution\": \"exponential\", \"mean\": 3";
    assert!(read(exponential, &["x=-1"]).unwrap_err().contains("above zero"));
}

#[test]
fn missing_and_impossible_fields_are_named() {
    for (fields, message) in [
        ("\"distribution\": \"gamma\", \"shape\": 2", "`rate`"),
        ("\"distribution\": \"gamma\", \"shape\": 2, \"rate\": -1", "rate is -1"),
        ("\"distribution\": \"beta\", \"beta\": 2", "`alpha`"),
        ("\"distribution\": \"trapezoidal\", \"mean\": 2, \"half_width\": 1", "`beta`"),
        (
            "\"distribution\": \"curvilinear-trapezoid\", \"lower\": 2, \"upper\": 3",
            "`inexactness`",
        ),
        ("\"distribution\": \"log-uniform\", \"lower\": 0, \"upper\": 3", "lower is 0"),
        ("\"distribution\": \"lognormal\", \"mean\": -1, \"std\": 1", "mean is -1"),
        ("\"distribution\": \"poisson-count\", \"count\": 2.5", "whole number"),
        ("\"distribution\": \"poisson-count\", \"count\": -1", "whole number"),
        ("\"distribution\": \"weibull\", \"shape\": 2", "`scale`"),
        ("\"distribution\": \"weibull\", \"shape\": -2, \"scale\": 1", "shape is -2"),
        ("\"distribution\": \"pareto\", \"shape\": 2, \"scale\": 1", "above 2"),
        ("\"distribution\": \"gumbel\", \"location\": 2, \"scale\": 0", "scale is 0"),
        ("\"distribution\": \"binomial\", \"trials\": 10, \"probability\": 1", "between 0 and 1"),
        ("\"distribution\": \"binomial\", \"trials\": 0, \"probability\": 0.5", "whole number"),
        (
            "\"distribution\": \"hypergeometric\", \"population\": 5, \"marked\": 6, \"draws\": 2",
            "at most the population",
        ),
        ("\"distribution\": \"samples\"", "no values"),
        ("\"distribution\": \"samples\", \"values\": [1]", "at least two samples"),
        ("\"distribution\": \"samples\", \"values\": [1], \"file\": \"a\"", "remove one"),
        ("\"distribution\": \"lognormall\", \"mean\": 1", "did you mean `lognormal`"),
        ("\"distribution\": \"zipf\", \"mean\": 1", "`poisson-count`"),
    ] {
        let error = read(fields, &[]).unwrap_err();
        assert!(error.contains(message), "{fields}: {error}");
    }
}

/// A component about which nothing else is said has the estimate 0; shapes that cannot are where
/// their fields put them.
#[test]
fn components_of_positive_shapes_keep_their_estimate() {
    let components = |fields: &str| {
        read(
            &format!(
                "\"mean\": 10, \"components\": [{{\"name\": \"a\", {fields}}}, {{\"name\": \"b\", \
                 \"distribution\": \"arcsine\", \"half_width\": 1}}]"
            ),
            &[],
        )
    };
    for (name, fields, ..) in EXAMPLES.iter().filter(|(name, ..)| *name != "readings") {
        let base = components(&format!("\"distribution\": \"{name}\", {fields}")).unwrap();
        assert_eq!(base.mean(), 10.0, "{name}");
    }
    assert!(components("\"distribution\": \"exponential\"").unwrap_err().contains("`mean`"));
}

/// A width that is a formula of conditions is that of each row, in the input's unit.
#[test]
fn widths_follow_conditions() {
    let text = r#"{"inputs": {
        "x": {"unit": "mm", "distribution": "normal", "mean": "a", "std": "u_a"},
        "y": {"unit": "mm", "mean": 5, "components": [
            {"name": "noise", "distribution": "rectangular", "half_width": "u_a*2 + 0*a"},
            {"name": "scale", "distribution": "normal", "std": "1 %"}]}},
        "conditions": {"a": {"unit": "m", "values": [1, 2]}, "u_a": {"unit": "um", "values": [3, 0]}},
        "equations": {"z": "x + y"}, "outputs": {"z": {"unit": "mm"}}}"#;
    let task = read_text("m", text, Path::new(""), &[]).unwrap().task;
    let u = |row: usize, of: usize| task.rows[row].distributions[of].standard_uncertainty();
    // u_a changes fastest: rows 0 and 2 have 3 um, 1 and 3 none; the base of y has no uncertainty
    for (row, micrometres) in [(0, 3.0), (1, 0.0), (2, 3.0), (3, 0.0)] {
        assert!((u(row, 0) - micrometres * 1e-3).abs() < 1e-15, "{row}");
        assert!((u(row, 2) - 2.0 * micrometres * 1e-3 / 3f64.sqrt()).abs() < 1e-15, "{row}");
        assert!((u(row, 3) - 0.05).abs() < 1e-15, "{row}");
    }
    assert!((task.rows[2].distributions[0].mean() - 2000.0).abs() < 1e-12);
}

/// Keys by names of other places are told once, and with what they are here.
#[test]
fn keys_by_other_names() {
    let said = |fields: &str| {
        let text = format!(
            r#"{{"inputs": {{"x": {{"unit": "mm", {fields}}}}}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{"unit": "mm"}}}}}}"#
        );
        read_text("m", &text, Path::new(""), &[]).unwrap_err()
    };
    for (fields, part) in [
        (r#""distribution": "rectangular", "mean": 1, "width": 0.1"#, "by its half"),
        (r#""distribution": "normal", "mean": 1, "U": 0.1, "k": 2"#, "`expanded`"),
        (r#""distribution": "normal", "mean": 1, "u": 0.1"#, "`std`"),
        (r#""distribution": "normal", "value": 1, "std": 0.1"#, "`mean`"),
        (r#""distribution": "normal", "mean": 1, "std": 0"#, "`constant`"),
        (r#""distribution": "rectangular", "mean": 1, "half_width": "0 um""#, "`constant`"),
    ] {
        let found = said(fields);
        assert_eq!(found.0.len(), 1, "{found}");
        assert!(found.to_string().contains(part), "{found}");
    }
    let width = said(r#""distribution": "rectangular", "mean": 1, "width": 0.1"#);
    assert_eq!(width.0[0].kind.suggestion(), None);
}

/// Limits on both sides, as drawings have them.
#[test]
fn a_half_width_with_its_sign() {
    let of = |fields: &str| {
        let text = format!(
            r#"{{"inputs": {{"x": {{"unit": "mm", "mean": 10, {fields}}}}}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{"unit": "mm"}}}}}}"#
        );
        read_text("m", &text, Path::new(""), &[])
            .map(|file| file.task.rows[0].distributions[0].standard_uncertainty())
    };
    let limits = of(r#""distribution": "rectangular", "half_width": "±(0.5 % + 10 um)""#).unwrap();
    assert!((limits - 0.06 / 3.0_f64.sqrt()).abs() < 1e-15);
    let u = of(r#""distribution": "normal", "expanded": "± 50 um", "k": 2"#).unwrap();
    assert!((u - 0.025).abs() < 1e-15);
    let wrong = of(r#""distribution": "normal", "std": "± 50 um""#).unwrap_err().to_string();
    assert!(wrong.contains("standard deviation"), "{wrong}");
}

/// Keys beside a width that its specification counts in, in the unit of the input or in another.
#[test]
fn specifications_with_the_keys_of_their_instrument() {
    let u = |fields: &str| {
        let text = format!(
            "{{'inputs': {{'x': {{'unit': 'V', 'mean': 5, 'distribution': {fields}}}}}, \
             'equations': {{'y': 'x'}}, 'outputs': {{'y': {{'unit': 'V'}}}}}}"
        );
        let file = read_text("m", &text.replace('\'', "\""), Path::new(""), &[]);
        let file = file.map_err(|faults| faults.to_string())?;
        Ok::<f64, String>(file.task.rows[0].distributions[0].standard_uncertainty())
    };
    let close = |found: Result<f64, String>, expected: f64| {
        let found = found.unwrap();
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    };
    let root3 = 3_f64.sqrt();
    let counts = "'rectangular', 'half_width': '±(0.02 % rdg + 2 counts)', 'resolution'";
    close(u(&format!("{counts}: '0.1 mV'")), 1.2e-3 / root3);
    close(u(&format!("{counts}: 1e-4")), 1.2e-3 / root3);
    close(u("'normal', 'std': '0.01 % FS', 'full_scale': '12 V'"), 1.2e-3);
    close(u("'normal', 'expanded': '0.01 % of range', 'k': 2, 'range': '10 V'"), 5e-4);
    close(u("'rectangular', 'half_width': 'greater of 0.1 % and 1 mV'"), 5e-3 / root3);
    close(u("'rectangular', 'half_width': '5×10⁻⁴ V'"), 5e-4 / root3);
    for (fields, said) in [
        ("'rectangular', 'half_width': '2 counts'", "the key `resolution`"),
        ("'normal', 'std': '0.1 % FS', 'range': 10", "the key `full_scale`"),
        ("'normal', 'std': 0.1, 'resolution': 0.1", "no width has them"),
        ("'rectangular', 'half_width': '1 mV', 'range': 10", "no width has them"),
        ("'normal', 'std': '2 counts', 'resolution': 0", "`resolution` is 0"),
        ("'normal', 'std': '2 counts', 'resolution': '1 K'", "`resolution`"),
    ] {
        let error = u(fields).unwrap_err();
        assert!(error.contains(said), "{fields}: {error}");
    }
}
