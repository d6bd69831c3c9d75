//! What holds for every measurement of the catalogue, and the seeds' numbers.

use std::collections::HashSet;
use std::path::Path;

use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use serde_json::Value;

use super::catalogue;
use gumption_engine::model::typed::{CatalogueEntry, Measurement};
use gumption_engine::model::{InputQuantity, Model, Output, Quantity};
use gumption_units::Unit;

/// A random value of an input, in its declared unit, where the model is smooth: angles at least
/// 5 deg from the axes, where moduli of projections have their kinks.
fn draw(model: &str, input: &str, unit: &str, random: &mut Xoshiro256PlusPlus) -> f64 {
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    match (model, input) {
        // a sum that exceeds the reference: one solution, no change from one to the other
        ("spurious-component-modulus", "a_theor") => between(1.0, 5.0),
        ("spurious-component-modulus", "amplitude") => between(6.0, 9.0),
        // the modulus of a difference
        ("normalized-error", "x1") => between(5.0, 6.0),
        ("normalized-error", "r") => between(-0.5, 0.5),
        // directions of the axes away from the case's, where angles have their cuts
        ("gravity-rotation", "start") => between(0.0, 90.0),
        ("gravity-rotation", _) if unit == "deg" => between(-5.0, 5.0),
        _ => match unit {
            "m/s^2" => between(1.0, 10.0),
            "deg" => between(5.0, 85.0) + 90.0 * between(-2.0, 2.0).floor(),
            "Hz" => between(0.5, 20.0),
            "mm" => between(100.0, 200.0),
            "s" => between(0.0, 0.1),
            "D" => between(1000.0, 5000.0),
            "V" => between(0.01, 0.1),
            "%" => between(-5.0, 5.0),
            "1" => between(0.5, 3.0),
            _ => panic!("no values for {unit}"),
        },
    }
}

fn points(entry: &CatalogueEntry, seed: u64, count: usize) -> Vec<Vec<f64>> {
    let declaration = entry.typed.declaration;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut point = || {
        let inputs = declaration.inputs.iter();
        inputs.map(|i| draw(declaration.name, i.name, i.unit, &mut random)).collect()
    };
    (0..count).map(|_| point()).collect()
}

/// The derivative of `f` at 0 by central differences with the steps h, h/2, h/4 and two Richardson
/// extrapolations; what remains is of order h^6. Differences of a phase are taken within half a
/// turn.
fn richardson(f: impl Fn(f64) -> f64, h: f64, period: Option<f64>) -> f64 {
    let central = |h: f64| {
        let difference = f(h) - f(-h);
        let turns = period.map_or(0.0, |period| (difference / period).round() * period);
        (difference - turns) / (2.0 * h)
    };
    let (coarse, middle, fine) = (central(h), central(h / 2.0), central(h / 4.0));
    let (first, second) = ((4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0);
    (16.0 * second - first) / 15.0
}

/// Sensitivity coefficients from dual numbers against differences, in the unit u(y)/u(x_i) with
/// standard uncertainties of 1 % of the values. A step of 0.2 % of a value leaves (0.002)^6 of
/// truncation and 1e-16 / 0.002 of rounding, both far below 1e-8.
#[test]
fn derivatives_are_exact() {
    for entry in catalogue() {
        let name = entry.typed.declaration.name;
        let model = entry.typed.model().unwrap();
        for at in points(entry, 1, 20) {
            let (values, gradients) = model.program.gradients(&at);
            let u: Vec<f64> = at.iter().map(|x| 0.01 * x.abs().max(0.1)).collect();
            for (o, output) in model.outputs.iter().enumerate() {
                assert!(values[o].is_finite(), "{name}, {}: {at:?}", output.quantity.name);
                let terms = gradients[o].iter().zip(&u).map(|(c, u)| (c * u).powi(2));
                let combined = terms.sum::<f64>().sqrt();
                for (i, input) in model.inputs.iter().enumerate() {
                    let along = |step: f64| {
                        let mut moved = at.clone();
                        moved[i] += step;
                        model.program.evaluate(&moved)[o]
                    };
                    let expected = richardson(along, 0.2 * u[i], output.period);
                    let error = (gradients[o][i] - expected).abs() * u[i];
                    assert!(
                        error <= 1e-8 * combined,
                        "{name}, {} by {}: {} but {expected} at {at:?}",
                        output.quantity.name,
                        input.quantity.name,
                        gradients[o][i],
                    );
                }
            }
        }
    }
}

/// The function with plain numbers and the recorded operations are the same arithmetic.
#[test]
fn plain_numbers_and_recorded_operations_give_the_same_bits() {
    for entry in catalogue() {
        let declaration = entry.typed.declaration;
        let model = entry.typed.model().unwrap();
        let factor = |quantity: &Quantity| quantity.unit.factor();
        for at in points(entry, 2, 100) {
            let in_si: Vec<f64> = at
                .iter()
                .zip(&model.inputs)
                .map(|(x, input)| x * factor(&input.quantity))
                .collect();
            let plain = compute(declaration.name, &in_si);
            assert_eq!(plain.len(), model.outputs.len());
            let recorded = model.program.evaluate(&at);
            for ((plain, recorded), output) in plain.iter().zip(&recorded).zip(&model.outputs) {
                let plain = plain / factor(&output.quantity);
                assert_eq!(
                    plain.to_bits(),
                    recorded.to_bits(),
                    "{}, {}",
                    declaration.name,
                    output.quantity.name
                );
            }
        }
    }
}

/// The function itself, with plain numbers: the one place where types are named one by one.
fn compute(name: &str, inputs: &[f64]) -> Vec<f64> {
    use super::*;
    macro_rules! first_of {
        ($($measurement:ident),* $(,)?) => {
            $(if <$measurement<()> as Measurement>::DECLARATION.name == name {
                return <$measurement<()> as Measurement>::compute(inputs);
            })*
        };
    }
    first_of![
        AxisSensitivity,
        GravityRotation,
        InclinedPlane,
        InclinedPlaneSpurious,
        InclinedPlaneSpuriousVector,
        MeanOfRepetitions,
        MeasuringChain,
        NormalizedError,
        PhaseBudget,
        Projection45,
        RelativeSensitivity,
        RotatingTable,
        RotatingTableInstant,
        SeismicResponse,
        Sensitivity,
        SensitivityMatrix,
        SpuriousComponent,
        SpuriousComponentInverse,
        SpuriousComponentModulus,
        WaveInterference,
    ];
    panic!("{name} is not in this list");
}

#[test]
fn declarations_are_complete() {
    let mut names = HashSet::new();
    for entry in catalogue() {
        let declaration = entry.typed.declaration;
        assert!(names.insert(declaration.name), "{} twice", declaration.name);
        assert!(catalogue().find(declaration.name).is_some());
        assert!(!declaration.about.trim().is_empty() && !declaration.source.is_empty());
        let mut quantities = HashSet::new();
        for input in declaration.inputs {
            assert!(quantities.insert(input.name), "{}", input.name);
            assert!(!input.about.trim().is_empty(), "{}", input.name);
            assert!(Unit::parse(input.unit).is_ok(), "{}", input.unit);
        }
        for output in declaration.outputs {
            assert!(quantities.insert(output.name), "{}", output.name);
            assert!(!output.about.trim().is_empty() && !output.equation.is_empty());
            assert!(Unit::parse(output.unit).is_ok(), "{}", output.unit);
            let is_phase = output.name.starts_with("phase");
            assert_eq!(output.period, is_phase.then_some(360.0), "{}", output.name);
        }
        for name in entry.any_unit {
            assert!(quantities.contains(name), "{name}");
        }
    }
    assert!(catalogue().find("inclined_plane").is_none());
}

/// The ready file of a measurement.
fn template(name: &str) -> String {
    let file = format!("../../models/{}.json", name.replace('-', "_"));
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

/// What a ready file without conditions says: a model, estimates and standard uncertainties in the
/// file's units.
struct Ready {
    model: Model,
    estimates: Vec<f64>,
    u: Vec<f64>,
}

impl Ready {
    fn read(text: &str) -> Self {
        let file: Value = serde_json::from_str(text).unwrap();
        let typed = catalogue().find(file["model"].as_str().unwrap()).unwrap().typed;
        let quantity = |(name, value): (&String, &Value)| Quantity {
            name: name.clone(),
            unit: Unit::parse(value["unit"].as_str().unwrap()).unwrap(),
            about: String::new(),
        };
        let inputs = file["inputs"].as_object().unwrap();
        let mut estimates = Vec::new();
        let mut u = Vec::new();
        for input in inputs.values() {
            let number = |key: &str| input[key].as_f64().unwrap();
            let (estimate, deviation) = match input["distribution"].as_str().unwrap() {
                "constant" => (number("value"), 0.0),
                "normal" => (number("mean"), number("std")),
                "rectangular" => (number("mean"), number("half_width") / 3f64.sqrt()),
                "triangular" => (number("mean"), number("half_width") / 6f64.sqrt()),
                other => panic!("{other}"),
            };
            estimates.push(estimate);
            u.push(deviation);
        }
        let outputs = file["outputs"].as_object().unwrap().iter();
        let outputs = outputs.map(|output| Output::new(quantity(output)));
        let inputs =
            inputs.iter().map(|i| InputQuantity { quantity: quantity(i), parts: 1 }).collect();
        let model = typed.model_with(inputs, Vec::new(), outputs.collect());
        Self { model, estimates, u }
    }

    /// The same with other estimates.
    fn with(mut self, others: &[(&str, f64)]) -> Self {
        for &(name, estimate) in others {
            let place =
                self.model.inputs.iter().position(|input| input.quantity.name == name).unwrap();
            self.estimates[place] = estimate;
        }
        self
    }

    /// Estimate and combined standard uncertainty of each output, by the law of propagation.
    fn evaluate(&self) -> Vec<(f64, f64)> {
        let (values, gradients) = self.model.program.gradients(&self.estimates);
        let combined = gradients.iter().map(|gradient| {
            let terms = gradient.iter().zip(&self.u).map(|(c, u)| (c * u).powi(2));
            terms.sum::<f64>().sqrt()
        });
        values.into_iter().zip(combined).collect()
    }

    fn of(name: &str) -> Self {
        Self::read(&template(name))
    }
}

#[test]
fn ready_files_of_the_catalogue_evaluate() {
    for entry in catalogue() {
        let text = template(entry.name());
        let ready = Ready::read(&text);
        let file: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(file["model"], entry.typed.declaration.name);
        assert_eq!(file["format"], 1);
        println!("{}", entry.typed.declaration.name);
        for ((estimate, u), output) in ready.evaluate().into_iter().zip(&ready.model.outputs) {
            println!("  {} = {estimate} u {u}", output.quantity.name);
            assert!(estimate.is_finite() && u.is_finite(), "{}", output.quantity.name);
        }
    }
}

/// Every file of `models/`: inputs and outputs are those of the model it names, none that is
/// required is missing, units have the declared dimension, each input says where its uncertainty comes from, and each file of
/// conditions is there.
#[test]
fn ready_files_fit_their_models() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut count = 0;
    for file in std::fs::read_dir(&folder).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let file: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let Some(model) = file["model"].as_str() else { continue };
        let entry =
            catalogue().find(model).unwrap_or_else(|| panic!("{}: {model}", path.display()));
        let typed = entry.typed;
        let assert_unit = |name: &str, value: &Value, declared: &str| {
            let unit = Unit::parse(value["unit"].as_str().unwrap()).unwrap();
            let fits = unit.is_compatible(&Unit::parse(declared).unwrap());
            assert!(fits || entry.any_unit.contains(&name), "{}: {name}", path.display());
        };
        let mut given: Vec<String> = Vec::new();
        for (name, input) in file["inputs"].as_object().unwrap() {
            let Some((_, declared)) = typed.input(name) else {
                panic!("{}: {name}", path.display())
            };
            assert_unit(name, input, declared.unit);
            assert!(input["about"].is_string(), "{}: {name}", path.display());
            given.push(name.clone());
        }
        if let Some(table) = file["conditions"]["file"].as_str() {
            let table = std::fs::read_to_string(folder.join(table)).unwrap();
            let header = table.lines().find(|line| !line.starts_with('#')).unwrap();
            given.extend(header.split(',').map(str::to_owned));
        } else if let Some(conditions) = file["conditions"].as_object() {
            given.extend(conditions.keys().cloned());
        }
        for input in typed.declaration.inputs {
            let known = given.iter().any(|name| name == input.name);
            assert!(known || input.default.is_some(), "{}: {}", path.display(), input.name);
        }
        for (name, output) in file["outputs"].as_object().unwrap() {
            let Some((_, declared)) = typed.output(name) else {
                panic!("{}: {name}", path.display())
            };
            assert_unit(name, output, declared.unit);
        }
        count += 1;
    }
    assert!(count >= catalogue().len(), "{count} files");
}

/// A model's ready file, other estimates of inputs in it, and outputs with estimate and standard
/// uncertainty.
type Expected<'a> = (&'a str, &'a [(&'a str, f64)], &'a [(&'a str, f64, f64)]);

/// Estimates and standard uncertainties that were computed from the equations, written as formulas,
/// with 40 digits and differences: the measurements of the papers with the uncertainties of the
/// ready files; for the gravity field from rotation matrices and a design matrix with a column of
/// ones. The differences are good to 1e-6 of u.
#[test]
fn seeds_as_formulas_and_as_typed_models_agree() {
    let third = [("rotation", 210.0)];
    let cases: [Expected; 7] = [
        (
            "inclined-plane",
            &[],
            &[
                ("a_x", 4.967_317_648_921_541, 0.009_172_018_446_757_016),
                ("a_y", 2.867_882_181_755_230_2, 0.007_093_110_063_644_046),
                ("a_z", 8.191_520_442_889_917, 0.010_025_286_107_384_198),
            ],
        ),
        (
            "inclined-plane-spurious",
            &third,
            &[
                ("a_x", 4.961_440_168_510_467, 0.011_752_406_452_301_228),
                ("a_y", 2.921_906_935_233_948, 0.009_546_167_160_032_638),
                ("a_z", 8.188_576_606_653_069, 0.011_479_905_145_801_552),
            ],
        ),
        (
            "inclined-plane-spurious-vector",
            &third,
            &[
                ("a_x", 4.868_177_962_740_639, 0.011_862_234_387_290_49),
                ("a_y", 2.921_906_935_233_948, 0.009_546_167_160_032_638),
                ("a_z", 8.360_364_380_880_874, 0.011_307_061_183_689_352),
            ],
        ),
        // the vertical axis does not depend on the rotation
        (
            "inclined-plane-spurious",
            &[],
            &[("a_z", 8.188_576_606_653_069, 0.011_479_905_145_801_552)],
        ),
        (
            "rotating-table",
            &[],
            &[
                ("a_t", 49.782_299_781_148_05, 0.248_947_383_213_416_86),
                ("a_r_peak", 14.770_705_686_730_06, 0.147_712_380_699_300_32),
            ],
        ),
        (
            "measuring-chain",
            &[],
            &[
                ("gain", 95.307_277_555_572_61, 0.245_184_295_347_382_6),
                ("phase", 22.409_837_371_493_264, 0.529_174_326_617_697_1),
            ],
        ),
        (
            "gravity-rotation",
            &[],
            &[
                ("s_x", 418.281_419_930_885_19, 0.020_839_514_183_31),
                ("s_y", 417.135_096_715_554_43, 0.020_839_394_217_20),
                ("s_z", 421.676_240_747_256_41, 0.020_848_757_616_48),
                ("angle_xy", 90.073_410_412_337_114, 0.004_897_619_506_44),
                ("angle_yz", 90.110_931_088_662_907, 0.005_106_207_130_76),
                ("angle_zx", 90.067_957_673_927_911, 0.005_077_945_463_21),
                ("o_x", 37.933_333_333_333_333, 0.185_260_568_816_09),
                ("o_y", -20.733_333_333_333_33, 0.187_012_031_845_99),
                ("o_z", 63.708_333_333_333_333, 0.180_615_485_838_33),
                ("direction_xy", 0.546_582_228_524_608_2, 0.100_091_405_349_37),
                ("direction_xz", -0.145_293_685_264_555, 0.100_137_432_370_56),
                ("direction_yz", 0.718_685_764_303_767_2, 0.100_138_502_960_49),
                ("direction_yx", -0.618_176_258_181_241, 0.100_182_367_384_85),
                ("direction_zx", 0.085_232_125_509_984_1, 0.100_132_147_611_70),
                ("direction_zy", -0.828_703_974_638_712, 0.100_121_758_787_99),
            ],
        ),
    ];
    for (name, others, expected) in cases {
        let ready = Ready::of(name).with(others);
        let results = ready.evaluate();
        for &(output, estimate, u) in expected {
            let outputs = &ready.model.outputs;
            let place = outputs.iter().position(|o| o.quantity.name == output).unwrap();
            let (found, u_found) = results[place];
            assert!((found - estimate).abs() <= 1e-6 * u, "{name}, {output}: {found}");
            assert!((u_found / u - 1.0).abs() <= 1e-6, "{name}, {output}: {u_found}");
        }
    }
}
