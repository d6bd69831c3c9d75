//! Calibration functions, complex quantities and regions from file to result.

use std::path::Path;

use crate::read_text;
use gumption_engine::number::CodePath;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::{Control, Evaluation, evaluate, trial_hash};
use gumption_engine::task::Task;

fn read(text: &str) -> Task {
    match read_text("test", text, Path::new(""), &[]) {
        Ok(file) => file.task,
        Err(diagnostics) => panic!("{diagnostics}"),
    }
}

fn run(text: &str) -> Evaluation {
    evaluate(&read(text), &Control::default()).unwrap()
}

fn gum(evaluation: &Evaluation, output: usize) -> &Gum {
    evaluation.rows[0].outputs[output].gum.as_ref().unwrap()
}

fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} {expected}");
}

/// A calibration of five standards, read three times, with nothing stated: GTC 1.5.1,
/// `type_a.line_fit` and (0.0714 - a)/b, to the rounding of the sums.
const LINE: &str = r#"{
  "fits": {"cal": {
    "x": {"unit": "mg/L", "values": [0, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.5, 0.5, 0.5, 0.7, 0.7, 0.7, 0.9, 0.9]},
    "y": {"values": [0.001, 0.028, 0.029, 0.029, 0.084, 0.083, 0.081, 0.135, 0.131, 0.133, 0.180, 0.181, 0.183, 0.215, 0.230]}}},
  "inputs": {"A": {"distribution": "constant", "value": 0.0714}},
  "equations": {"c0": "inverse(cal, A)", "a": "cal.a", "b": "cal.b", "back": "cal(c0)"},
  "outputs": {"c0": {"unit": "ug/L"}, "a": {}, "b": {"unit": "L/mg"}, "back": {}},
  "monte_carlo": {"trials": 100000}
}"#;

#[test]
fn a_line_without_stated_uncertainties_is_that_of_gtc() {
    let evaluation = run(LINE);
    let expected = [
        (264.244_962_051_818_85, 5.966_444_051_962_448),
        (0.006_048_543_689_320_404, 0.002_303_155_169_607_570_5),
        (0.247_313_915_857_605_18, 0.004_383_980_941_561_965_5),
    ];
    for (output, (estimate, uncertainty)) in expected.into_iter().enumerate() {
        let gum = gum(&evaluation, output);
        near(gum.estimate, estimate, 1e-12);
        near(gum.standard_uncertainty, uncertainty, 1e-11);
        assert!(matches!(gum.dof, Dof::Finite(dof) if (dof - 13.0).abs() < 1e-9), "{:?}", gum.dof);
        // a multivariate t with 13 degrees of freedom: u is larger by sqrt(13/11), in 100,000 trials
        // to 0.3 %; five standard errors
        let trials = evaluation.rows[0].outputs[output].monte_carlo.as_deref().unwrap();
        let ratio = trials.standard_uncertainty.unwrap() / uncertainty;
        assert!((ratio / (13.0_f64 / 11.0).sqrt() - 1.0).abs() < 0.015, "{output} {ratio}");
    }
    // the curve at its inverse is the value again, in every trial
    let back = evaluation.rows[0].outputs[3].monte_carlo.as_deref().unwrap();
    assert!((back.estimate.unwrap() - 0.0714).abs() < 1e-12);
    assert!(back.standard_uncertainty.unwrap() < 1e-12);
}

/// Parabola and formula: forward and inverse meet, and the derivatives of the inverse are those of the
/// implicit function.
#[test]
fn inverses_of_curves() {
    let points = r#""x": {"unit": "degC", "values": [0, 20, 40, 60, 80, 100]},
        "y": {"unit": "ohm", "values": [100.01, 107.80, 115.53, 123.24, 130.91, 138.49], "standard_uncertainty": 0.02}"#;
    for form in [
        r#""form": "polynomial", "degree": 2"#.to_owned(),
        r#""form": "polynomial", "degree": "auto""#.to_owned(),
        r#""form": "r*(1 + a*(x/[degC]) + b*(x/[degC])^2)", "start": {"r": "100 ohm", "a": 0.004, "b": 0}"#
            .to_owned(),
    ] {
        let text = format!(
            r#"{{"fits": {{"q": {{{form}, {points}}}}},
              "inputs": {{"R": {{"unit": "mohm", "distribution": "normal", "mean": 110000, "std": 5}}}},
              "equations": {{"t": "inverse(q, R)", "back": "q(t) - R"}},
              "outputs": {{"t": {{"unit": "degC"}}, "back": {{"unit": "ohm"}}}},
              "monte_carlo": {{"trials": 20000}}}}"#
        );
        let evaluation = run(&text);
        let (t, back) = (gum(&evaluation, 0), gum(&evaluation, 1));
        assert!(back.estimate.abs() < 1e-9, "{form} {}", back.estimate);
        assert!(back.standard_uncertainty < 1e-8, "{form} {}", back.standard_uncertainty);
        // a linear model here: u of the trials is that of the law, to 0.5 % in 20,000 trials
        let trials = evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
        near(trials.standard_uncertainty.unwrap(), t.standard_uncertainty, 0.025);
        let back = evaluation.rows[0].outputs[1].monte_carlo.as_deref().unwrap();
        assert!(back.standard_uncertainty.unwrap() < 1e-8, "{form}");
    }
}

/// Trials of fits are the same bits on every path and on any number of threads.
#[test]
fn fits_of_trials_have_the_same_bits_everywhere() {
    let uncertain = LINE
        .replace("0.9, 0.9]}", r#"0.9, 0.9], "standard_uncertainty": 0.005}"#)
        .replace("0.215, 0.230]}", r#"0.215, 0.230], "standard_uncertainty": 0.002}"#);
    for text in [LINE, &uncertain] {
        let task = read(text);
        let hash = |path, threads| {
            let control = Control::default().with_path(path).with_threads(threads);
            trial_hash(&task, 5000, &control).unwrap()
        };
        let first = hash(CodePath::BASELINE, 1);
        for path in CodePath::available() {
            assert_eq!([hash(path, 1), hash(path, 3)], [first; 2], "{}", path.name());
        }
    }
}

/// GTC 1.5.1, `ucomplex`: z l^2/(1 - 0.1 i z) and the root of l in polar form.
#[test]
fn complex_quantities_are_those_of_gtc() {
    let evaluation = run(r#"{"inputs": {
          "z": {"complex": {"re": {"distribution": "normal", "mean": 0.012, "std": 0.005},
                            "im": {"distribution": "normal", "mean": -0.004, "std": 0.005},
                            "correlation": 0.3}},
          "l": {"complex": {"modulus": {"distribution": "normal", "mean": 0.98, "std": 0.002},
                            "phase": {"unit": "deg", "distribution": "rectangular", "mean": 35, "half_width": 0.5}}}},
          "equations": {"g": "z*l^2/(1 - 0.1*i*z)", "r": "sqrt(l)", "one": "re(conj(l)*l)/abs(l)^2"},
          "outputs": {"g": {"complex": "re-im"}, "r": {"complex": "polar", "phase_unit": "deg"}, "one": {}},
          "monte_carlo": {"trials": 0}}"#);
    let expected = [
        (0.007_543_219_733_758_203, 0.004_321_806_928_216_755),
        (0.009_528_728_288_429_43, 0.005_247_054_472_167_302),
        (0.989_949_493_661_166_5, 0.001_010_152_544_552_210_9),
        (17.5, 0.144_337_567_297_406_5),
    ];
    for (output, (estimate, uncertainty)) in expected.into_iter().enumerate() {
        near(gum(&evaluation, output).estimate, estimate, 1e-13);
        near(gum(&evaluation, output).standard_uncertainty, uncertainty, 1e-12);
    }
    near(evaluation.rows[0].correlations[0], -0.235_272_220_799_659_15, 1e-12);
    assert!((gum(&evaluation, 4).estimate - 1.0).abs() < 1e-15);
    assert!(gum(&evaluation, 4).standard_uncertainty < 1e-16);
}

/// y1 = x1 + x3 and y2 = x2 + x3 of standard normal quantities (as JCGM 102, 9.2): U has 2 and 1,
/// k_p = sqrt(chi2_0.95(2)) = 2.4477, the box needs 2.2121 (the normal distribution function of two
/// quantities with r = 0.5, SciPy), Bonferroni 2.2414, and the ellipse has the area
/// pi k_p^2 sqrt(3) = 32.602. Of 200,000 trials the factors have numerical standard errors of 0.006, and
/// the mesh costs a few parts in a hundred of the area.
#[test]
fn a_region_of_two_outputs() {
    let normal = r#"{"distribution": "normal", "mean": 0, "std": 1}"#;
    let evaluation = run(&format!(
        r#"{{"inputs": {{"x1": {normal}, "x2": {normal}, "x3": {normal}}},
          "equations": {{"y1": "x1 + x3", "y2": "x2 + x3"}},
          "outputs": {{"y1": {{}}, "y2": {{}}}},
          "regions": [{{"outputs": ["y1", "y2"], "probability": 0.95}}],
          "monte_carlo": {{"trials": 200000, "digits": 1}}}}"#
    ));
    let region = &evaluation.rows[0].regions[0];
    let gum = region.gum.as_ref().unwrap();
    for (found, expected) in gum.covariance.iter().zip([2.0, 1.0, 1.0, 2.0]) {
        near(*found, expected, 1e-12);
    }
    near(gum.ellipsoid_k.unwrap(), 2.447_746_830_680_816, 1e-12);
    near(gum.box_k.unwrap(), 2.241_402_727_604_945, 1e-12);
    let found = region.monte_carlo.as_ref().unwrap();
    let error = found.ellipsoid_error.unwrap();
    assert!(error < 0.02 && found.box_error < 0.02, "{error} {}", found.box_error);
    assert!((found.region.ellipsoid_k.unwrap() - 2.447_746_8).abs() < 5.0 * error);
    assert!((found.region.box_k.unwrap() - 2.212_127_7).abs() < 5.0 * found.box_error);
    near(found.smallest.as_ref().unwrap().volume, 32.601_943_76, 0.04);
    assert!(region.validation.as_ref().unwrap().gum_valid);
}

/// Readings with the scatter of a calibration line: QUAM A5 by GTC 1.5.1, `line_fit` and `x_from_y` of
/// two readings, and what is refused.
#[test]
fn readings_with_the_scatter_of_a_line() {
    let of = |pooled: &str, more: &str| {
        format!(
            r#"{{"inputs": {{"x": {{"unit": "1", "distribution": "readings", "values": [0.0712, 0.0716],
            "pooled": {pooled}}}}}, "fits": {{"line": {{
            "x": {{"values": [0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.5, 0.5, 0.5, 0.7, 0.7, 0.7, 0.9, 0.9, 0.9]}},
            "y": {{"values": [0.028, 0.029, 0.029, 0.084, 0.083, 0.081, 0.135, 0.131, 0.133, 0.180, 0.181,
            0.183, 0.215, 0.230, 0.216]{more}}}}}}}, "equations": {{"c": "inverse(line, x)"}},
            "outputs": {{"c": {{"unit": "1"}}}}, "monte_carlo": {{"trials": 100000}}}}"#
        )
    };
    let evaluation = run(&of(r#"{"fit": "line"}"#, ""));
    let c = gum(&evaluation, 0);
    near(c.estimate, 0.260_165_975_103_734_3, 1e-12);
    near(c.standard_uncertainty, 0.017_844_611_125_583_134, 1e-11);
    assert!(matches!(c.dof, Dof::Finite(dof) if (dof - 13.0).abs() < 1e-9), "{:?}", c.dof);
    // one t with 13 degrees of freedom, but for the little bending of 1/b: five standard errors of
    // 0.3 % and 0.5 % for the bending
    let trials = evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
    let ratio = trials.standard_uncertainty.unwrap() / c.standard_uncertainty;
    assert!((ratio / (13.0_f64 / 11.0).sqrt() - 1.0).abs() < 0.02, "{ratio}");
    for (pooled, more, said) in [
        (r#"{"fit": "lime"}"#, "", "did you mean `line`?"),
        (r#"{"fit": "line", "dof": 3}"#, "", "`fit`"),
        (r#"{"fit": "line"}"#, r#", "standard_uncertainty": 0.002"#, "are stated"),
        (r#"{"dof": 3}"#, "", "needs the key `std`"),
    ] {
        let error =
            read_text("test", &of(pooled, more), Path::new(""), &[]).unwrap_err().to_string();
        assert!(error.contains(said), "{pooled}: {error}");
    }
}

/// The unknown of `solve` may have the name of the equation that it stands in, and a width may be a
/// formula of numbers: x = 2 of x^3 = 8, u = 3/sqrt(4)/(3 x^2).
#[test]
fn an_equation_of_its_own_name() {
    let evaluation =
        run(r#"{"inputs": {"q": {"distribution": "normal", "mean": 8, "std": "3/sqrt(4)"}},
        "equations": {"x": "solve(x^3 - q, x, 0, 9)", "y": "2*x"}, "outputs": {"x": {}, "y": {}},
        "monte_carlo": {"trials": 0}}"#);
    near(gum(&evaluation, 0).estimate, 2.0, 1e-14);
    near(gum(&evaluation, 0).standard_uncertainty, 0.125, 1e-12);
    near(gum(&evaluation, 1).estimate, 4.0, 1e-14);
}

/// Parts of a complex quantity in place of their own: estimates and fields.
#[test]
fn parts_of_complex_inputs_are_replaced() {
    let text = r#"{"inputs": {"Z": {"unit": "ohm", "complex": {
        "re": {"distribution": "normal", "mean": 50, "std": 0.1},
        "im": {"distribution": "normal", "mean": 2, "std": 0.1}}},
        "S": {"complex": {"modulus": {"distribution": "normal", "mean": 1, "std": 0.1},
        "phase": {"unit": "deg", "distribution": "normal", "mean": 10, "std": 1}}}},
        "equations": {"r": "re(Z)", "p": "arg(S)"}, "outputs": {"r": {"unit": "ohm"},
        "p": {"unit": "deg"}}, "monte_carlo": {"trials": 0}}"#;
    let of = |set: &[&str]| {
        let set: Vec<_> = set.iter().map(|text| crate::Override::parse(text).unwrap()).collect();
        read_text("test", text, Path::new(""), &set)
    };
    let task = of(&["Z.re=0.055 kohm", "Z.re.std=0.3", "S.arg=20"]).unwrap().task;
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    near(gum(&evaluation, 0).estimate, 55.0, 1e-14);
    near(gum(&evaluation, 0).standard_uncertainty, 0.3, 1e-14);
    near(gum(&evaluation, 1).estimate, 20.0, 1e-13);
    for (set, said) in [
        ("Z=55", "as in `Z.re=1`"),
        ("Z.rr=55", "has no part `rr`"),
        ("Z.modulus=55", "has no part `modulus`"),
        ("Z.rr.std=55", "has no part `rr`"),
    ] {
        let error = of(&[set]).unwrap_err().to_string();
        assert!(error.contains(said), "{set}: {error}");
    }
}

/// JCGM 102, 9.3, polar coordinates of x1 = 0.010 and x2 = 0, both with u = 0.010: by the law of
/// propagation u(y1) = 0.010 and u(y2) = 1 rad, uncorrelated, k_p = 2.45 and k_q = 2.24; by the trials
/// y1 follows Rice's distribution, whose moments 0.015486 and 0.007758 (from Bessel functions) hold to
/// five standard errors of 100,000 trials.
#[test]
fn polar_coordinates_of_the_supplement() {
    let evaluation =
        run(r#"{"inputs": {"x1": {"distribution": "normal", "mean": 0.010, "std": 0.010},
        "x2": {"distribution": "normal", "mean": 0, "std": 0.010}},
        "equations": {"y1": "hypot(x1, x2)", "y2": "atan2(x2, x1)"},
        "outputs": {"y1": {}, "y2": {"unit": "rad"}},
        "regions": [{"outputs": ["y1", "y2"], "probability": 0.95}],
        "monte_carlo": {"trials": 100000}}"#);
    near(gum(&evaluation, 0).standard_uncertainty, 0.010, 1e-12);
    near(gum(&evaluation, 1).standard_uncertainty, 1.0, 1e-12);
    let trials = evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
    let mean = trials.estimate.unwrap();
    assert!((mean - 0.015_486).abs() < 1.3e-4, "{mean}");
    let u = trials.standard_uncertainty.unwrap();
    assert!((u - 0.007_758).abs() < 1e-4, "{u}");
    let region = &evaluation.rows[0].regions[0];
    let linear = region.gum.as_ref().unwrap();
    // the root of the chi-squared quantile with two degrees of freedom, -2 ln 0.05; Bonferroni
    near(linear.ellipsoid_k.unwrap(), 2.447_746_830_680_816, 1e-12);
    near(linear.box_k.unwrap(), 2.241_402_727_604_947, 1e-9);
}

/// JCGM 102, 9.4, resistance and reactance of the means of JCGM 100, H.2: R = 127.732(71) ohm,
/// X = 219.847(295) ohm, Z = 254.260(236) ohm with r(R, X) = -0.588, r(R, Z) = -0.485 and
/// r(X, Z) = 0.993. The covariance matrix of all three is singular (Z^2 = R^2 + X^2), so that only the
/// two of them have an ellipse, of the area pi k_p^2 sqrt(det U) = 0.3197 ohm^2, which the volume of
/// the trials' smallest region meets to a few parts in a hundred.
#[test]
fn resistance_and_reactance_of_the_supplement() {
    let evaluation = run(r#"{"inputs": {
        "v": {"unit": "V", "distribution": "normal", "mean": 4.999, "std": 0.00320936},
        "i": {"unit": "mA", "distribution": "normal", "mean": 19.661, "std": 0.00947101},
        "phi": {"unit": "rad", "distribution": "normal", "mean": 1.04446, "std": 0.0007520638}},
        "correlations": [["v", "i", -0.355311], ["v", "phi", 0.857624], ["i", "phi", -0.645111]],
        "equations": {"r": "v/i*cos(phi)", "x": "v/i*sin(phi)", "z": "v/i"},
        "outputs": {"r": {"unit": "ohm"}, "x": {"unit": "ohm"}, "z": {"unit": "ohm"}},
        "regions": [{"outputs": ["r", "x"], "probability": 0.95},
                    {"outputs": ["r", "x", "z"], "probability": 0.95}],
        "monte_carlo": {"trials": 200000}}"#);
    let expected = [(127.732, 0.071), (219.847, 0.295), (254.260, 0.236)];
    for (output, (estimate, u)) in expected.into_iter().enumerate() {
        let gum = gum(&evaluation, output);
        assert!(
            (gum.estimate - estimate).abs() < 6e-4 && (gum.standard_uncertainty - u).abs() < 7e-4
        );
    }
    let [two, three] = evaluation.rows[0].regions.as_slice() else { panic!("two regions") };
    let linear = three.gum.as_ref().unwrap();
    let of = |a: usize, b: usize| linear.covariance[3 * a + b];
    for (a, b, r) in [(0, 1, -0.588), (0, 2, -0.485), (1, 2, 0.993)] {
        assert!((of(a, b) / (of(a, a) * of(b, b)).sqrt() - r).abs() < 6e-4);
    }
    assert!(linear.ellipsoid_k.is_none());
    near(two.gum.as_ref().unwrap().ellipsoid_k.unwrap(), 2.447_746_830_680_816, 1e-12);
    let found = two.monte_carlo.as_ref().unwrap();
    near(found.smallest.as_ref().unwrap().volume, 0.3197, 0.04);
    assert!(two.validation.as_ref().unwrap().gum_valid);
}

/// Numbers alone in `start` are in the units that follow from those of x and y; the figures are those of
/// the same file with units, but for rounding. Where several sets of units fit, none does.
#[test]
fn units_of_parameters_follow() {
    let text = |form: &str, start: &str, unit: &str| {
        format!(
            r#"{{"fits": {{"line": {{"form": "{form}", "start": {start},
              "x": {{"unit": "kN", "values": [0.5, 1, 2, 3, 4, 6]}},
              "y": {{"unit": "mV/V", "standard_uncertainty": 0.001,
                "values": [2.1685, 1.9095, 1.5521, 1.3345, 1.2032, 1.0745]}}}}}},
              "inputs": {{"F": {{"unit": "N", "distribution": "normal", "mean": 2500, "std": 2}}}},
              "equations": {{"y": "line(F)", "p": "line.c"}}, "outputs": {{"y": {{"unit": "mV/V"}},
              "p": {{"unit": "{unit}"}}}}, "monte_carlo": {{"trials": 0}}}}"#
        )
    };
    let form = "a + b*exp(-x/c)";
    let bare = run(&text(form, r#"{"a": 1, "b": 1.5, "c": 2}"#, "kN"));
    let stated = r#"{"a": "1 mV/V", "b": "1.5 mV/V", "c": "2 kN"}"#;
    let stated = run(&text(form, stated, "kN"));
    for output in 0..2 {
        let (a, b) = (gum(&bare, output), gum(&stated, output));
        near(a.estimate, b.estimate, 1e-7);
        near(a.standard_uncertainty, b.standard_uncertainty, 1e-6);
    }
    let of = |form: &str, start: &str, unit: &str| {
        let file = read_text("t", &text(form, start, unit), Path::new(""), &[]);
        let file = file.unwrap_or_else(|error| panic!("{form}: {error}"));
        file.warnings.iter().map(|warning| warning.code()).collect::<Vec<_>>()
    };
    assert!(of(form, r#"{"a": 1, "b": 1.5, "c": 2}"#, "N").is_empty());
    for (b, said) in [("1,5 mV/V", "such as `1.5`"), ("1 500 mV/V", "without spaces")] {
        let start = format!(r#"{{"a": "1 mV/V", "b": "{b}", "c": "2 kN"}}"#);
        let error = read_text("t", &text(form, &start, "kN"), Path::new(""), &[]).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
    }
    // a power that is fitted has no unit of its own, and neither has its factor
    assert!(of("b*x^c", r#"{"b": 1.9, "c": -0.3}"#, "1").contains(&"fit-units-not-checked"));
}

/// A log of a voltmeter with the time and remarks beside the columns that the fit names: what a fit does not name
/// need not be numbers. The points are on a line.
#[test]
fn columns_that_a_fit_does_not_name_may_hold_anything() {
    let log = "time,U [V],remark,p [bar],u\n\
               2026-03-01 08:00,1.0,warm,10,0.1\n\
               2026-03-01 08:05,2.0,,20,0.1\n\
               2026-03-01 08:10,3.0,door open,30,0.1\n";
    let held = [("log.csv".to_owned(), log.as_bytes().to_vec())];
    let text = r#"{
      "fits": {"cal": {
        "x": {"file": "log.csv", "column": "U", "unit": "V"},
        "y": {"file": "log.csv", "column": "p", "unit": "bar", "standard_uncertainty": "u"}}},
      "inputs": {"U": {"unit": "V", "distribution": "constant", "value": 2.5}},
      "equations": {"p": "cal(U)"},
      "outputs": {"p": {"unit": "bar"}},
      "monte_carlo": {"trials": 0}
    }"#;
    let read = |text: &str| {
        let files = crate::FileReader::default().holding(&held);
        files.model_text("test", text, Path::new(""), &[])
    };
    let task = read(text).unwrap().task;
    let evaluation = evaluate(&task, &Control::default()).unwrap();
    // a few roundings
    near(gum(&evaluation, 0).estimate, 25.0, 1e-13);
    let wrong = read(&text.replace("\"column\": \"p\"", "\"column\": \"remark\"")).unwrap_err();
    assert!(wrong.to_string().contains("`remark`"), "{wrong}");
}

/// A model of a line over dates, with more keys of x, the values of y and an input.
fn over_dates(root: &str, x: &str, day: &str) -> String {
    format!(
        r#"{{{root} "fits": {{"line": {{"x": {{{x}}},
            "y": {{"unit": "uV", "values": [10, 13.66, 17.31], "standard_uncertainty": 0.1}}}}}},
        "inputs": {{"day": {day}}}, "equations": {{"V": "line(day)"}},
        "outputs": {{"V": {{"unit": "uV"}}}}, "monte_carlo": {{"trials": 0}}}}"#
    )
}

/// Three calibrations in consecutive years, the first of which begins before a leap day: 0, 366 and 731
/// days after 2023-07-01, with a drift of 0.01 uV a day without rounding; 1096 days are three years of
/// which one has a leap day.
#[test]
fn a_line_over_dates() {
    let origin = r#""date_origin": "2023-07-01","#;
    let dates = r#""values": ["2023-07-01", "2024-07-01", "2025-07-01"]"#;
    let in_days = format!(r#""unit": "d", {dates}"#);
    let value = |text: &str| {
        let evaluation = run(text);
        gum(&evaluation, 0).estimate
    };
    let used = r#"{"unit": "d", "value": "2026-07-01"}"#;
    near(value(&over_dates(origin, &in_days, used)), 10.0 + 10.96, 1e-12);
    near(value(&over_dates(origin, &in_days, "\"2026-07-01\"")), 10.0 + 10.96, 1e-12);
    near(value(&over_dates(origin, &in_days, r#"{"unit": "d", "value": 1096}"#)), 20.96, 1e-12);
    let earlier = r#""date_origin": "2020-01-01","#;
    near(value(&over_dates(earlier, &in_days, used)), 20.96, 1e-11);
    let in_years = format!(r#""unit": "year", {dates}"#);
    near(value(&over_dates(origin, &in_years, used)), 20.96, 1e-12);
    let moved = crate::Override::parse("day=2024-06-30").unwrap();
    let file =
        read_text("t", &over_dates(origin, &in_days, used), Path::new(""), &[moved]).unwrap();
    near(gum(&evaluate(&file.task, &Control::default()).unwrap(), 0).estimate, 13.65, 1e-12);
    assert_eq!(file.warnings[0].code(), "date-origin");

    let folder = tempfile::tempdir().unwrap();
    let table = "when,note\n2023-07-01,new\n2024-07-01,\n2025-07-01,used\n";
    std::fs::write(folder.path().join("c.csv"), table).unwrap();
    let of_table = r#""unit": "d", "file": "c.csv", "column": "when""#;
    let file = read_text("t", &over_dates(origin, of_table, used), folder.path(), &[]).unwrap();
    near(gum(&evaluate(&file.task, &Control::default()).unwrap(), 0).estimate, 20.96, 1e-12);
    let refused = |text: &str| read_text("t", text, folder.path(), &[]).unwrap_err().to_string();
    for (text, said) in [
        (over_dates("", &in_days, used), "\"date_origin\""),
        (over_dates("", of_table, "3"), "\"date_origin\""),
        (over_dates(r#""date_origin": "2023-02-29","#, &in_days, used), "must be a day"),
        (over_dates(origin, &format!(r#""unit": "kN", {dates}"#), used), "kN"),
        (over_dates(origin, &of_table.replace("\"d\"", "\"kN\""), "3"), "numbers of days"),
    ] {
        let error = refused(&text);
        assert!(error.contains(said), "{said}: {error}");
    }
}

/// A number given as text is a start value, as where other values are read.
#[test]
fn a_start_value_may_be_a_text() {
    let of = |start: &str| {
        run(&format!(
            r#"{{"fits": {{"f": {{"form": "a*exp(-b*x)", "start": {{"a": {start}, "b": "0.5"}},
                "x": {{"values": [0, 1, 2, 3]}},
                "y": {{"values": [2, 1.2, 0.75, 0.44], "standard_uncertainty": 0.01}}}}}},
            "equations": {{"y": "f(1.5)"}}, "outputs": {{"y": {{}}}}, "monte_carlo": {{"trials": 0}}}}"#
        ))
    };
    assert_eq!(gum(&of("\"3\""), 0).estimate, gum(&of("3"), 0).estimate);
}

/// A sine of degrees with plain numbers: `sin(x [deg])`, and without the unit the message says so.
#[test]
fn a_sine_of_degrees_with_plain_numbers() {
    let of = |form: &str| {
        format!(
            r#"{{"fits": {{"f": {{"form": "{form}", "start": {{"a": 0, "b": 1}},
                "x": {{"unit": "deg", "values": [0, 30, 90, 150]}},
                "y": {{"values": [0.5, 1.5, 2.5, 1.5], "standard_uncertainty": 0.01}}}}}},
            "equations": {{"y": "f(30 [deg])"}}, "outputs": {{"y": {{}}}},
            "monte_carlo": {{"trials": 0}}}}"#
        )
    };
    // 0.5 + 2 sin(x) goes through all points
    near(gum(&run(&of("a + b*sin(x [deg])")), 0).estimate, 1.5, 1e-9);
    let error = read_text("t", &of("a + b*sin(x)"), Path::new(""), &[]).unwrap_err().to_string();
    assert!(error.contains("`sin(x [deg])`"), "{error}");
}
