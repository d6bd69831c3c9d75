//! Model files made by the grammar: most of them are right, or nearly so.

use serde_json::{Map, Value, json};

use super::choices::Choices;

/// Names of quantities.
pub(super) const NAMES: &[&str] = &["a", "b", "c", "tilt", "x_1", "μ"];

/// Units: mostly of a length or none.
const UNITS: &[&str] = &[
    "m", "m", "mm", "1", "", "m^2", "s", "m/s^2", "deg", "degC", "K", "%", "ppm", "kg*m^-3", "V",
    "nm", "ohm", "'", "in", "dB", "Gm^9", "km^7/s^3", "fm",
];

/// Texts that are no units.
const NO_UNITS: &[&str] =
    &["meter", "m//s", "km^20", "m^999", "mm^1/2", "1e300 m", "Gm^-30", "mK^", "ms-1"];

/// A unit.
pub(super) fn unit(choices: &mut Choices) -> &'static str {
    choices.mostly(UNITS, NO_UNITS)
}

const UNARY: &[&str] = &[
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "log10",
    "sqrt", "cbrt", "abs", "-",
];
const BINARY: &[&str] = &["atan2", "min", "max", "hypot"];
const INFIX: &[&str] = &["+", "-", "*", "/", "^", "<", ">=", "==", "!=", "<="];
const LEAVES: &[&str] = &["0", "1", "2.5", "pi", "1e308", "1e-308", "1e3", "(-1)"];

/// A formula over some names.
pub(super) fn formula(choices: &mut Choices, names: &[String], depth: usize) -> String {
    if depth == 0 || choices.chance(25) {
        if names.is_empty() || choices.chance(15) {
            return choices.mostly(LEAVES, &["e", "zz", "1,5"]).to_owned();
        }
        return choices.pick(names);
    }
    let kind = choices.below(10);
    let a = formula(choices, names, depth - 1);
    if kind < 3 {
        return format!("{}({a})", choices.mostly(UNARY, &["log", "sine", "kelvin"]));
    }
    let b = formula(choices, names, depth - 1);
    match kind {
        3 => format!("{}({a}, {b})", choices.pick(BINARY)),
        // sums and products are what measurements are made of
        4..=7 => format!("({a} {} {b})", choices.pick(&["+", "-", "*"])),
        _ => format!("({a} {} {b})", choices.pick(INFIX)),
    }
}

/// Signs and words of formulas in any order.
pub(super) fn signs(choices: &mut Choices) -> String {
    let other = ["x", "t", "(", ")", ",", "1", "0", "2.5", "kelvin", " "];
    let lists = [UNARY, BINARY, INFIX, LEAVES, &other, &other, &other];
    let count = choices.below(25);
    let sign = |choices: &mut Choices| {
        let list = choices.pick(&lists);
        choices.pick(list)
    };
    (0..count).map(|_| sign(choices)).collect()
}

/// A width as laboratories write it.
fn specification(choices: &mut Choices, unit: &str) -> String {
    let wrong = ["", "0 %", "-1 %", "1e400 %", "1 % of", "2 % + ", "nan %"];
    let term = |choices: &mut Choices| {
        let (a, b) = (choices.positive(), choices.positive());
        match choices.below(40) {
            0..=9 => format!("{a} %"),
            10..=19 => format!("{a} ppm"),
            20..=24 => format!("{a} % of {b} {unit}"),
            25..=34 => format!("{a} {unit}"),
            35..=38 => format!("{a} % of reading"),
            _ => choices.pick(&wrong).to_owned(),
        }
    };
    let terms: Vec<String> = (0..choices.between(1, 3)).map(|_| term(choices)).collect();
    terms.join(" + ")
}

fn width(choices: &mut Choices, unit: &str) -> Value {
    if choices.chance(20) { json!(specification(choices, unit)) } else { choices.positive() }
}

/// The limits of a distribution that has some.
fn limits(choices: &mut Choices, unit: &str) -> Value {
    if choices.chance(50) {
        let key = choices.pick(&["half_width", "semi_range"]);
        return json!({"mean": choices.number(), key: width(choices, unit)});
    }
    let lower = choices.below(1000) as f64 / 100.0;
    json!({"lower": lower, "upper": lower + (1 + choices.below(500)) as f64 / 100.0})
}

/// Readings or samples.
fn values(choices: &mut Choices) -> Value {
    let count = choices.mostly(&[2, 5, 5, 9, 40], &[0, 1]);
    let plain = choices.chance(90);
    (0..count).map(|_| if plain { choices.positive() } else { choices.number() }).collect()
}

/// The fields of a distribution, with its name.
pub(super) fn distribution(choices: &mut Choices, unit: &str) -> Map<String, Value> {
    let name = choices.pick(DISTRIBUTIONS);
    let mut fields = match name {
        "constant" => json!({"value": choices.number()}),
        "normal" | "gaussian" => {
            let (mean, width) = (choices.number(), width(choices, unit));
            match choices.below(5) {
                0..=2 => json!({"mean": mean, "std": width}),
                3 => json!({"mean": mean, "expanded": width, "k": 2}),
                _ => {
                    json!({"mean": mean, "expanded": width, "p": choices.pick(&[0.95, 0.9545, 1e-9])})
                }
            }
        }
        "triangular" if choices.chance(30) => {
            let mode = choices.mostly(&[0.5, 0.500_001, 1.0, 2.0, 2.5], &[3.0]);
            json!({"lower": 0.5, "upper": 2.5, "mode": mode})
        }
        "rectangular" | "uniform" | "arcsine" | "u-shaped" | "triangular" | "trapezoidal" => {
            limits(choices, unit)
        }
        "curvilinear-trapezoid" => {
            let inexactness = choices.mostly(&[0.001, 0.1, 1.0, 5e-324], &[100.0]);
            json!({"lower": -0.5, "upper": 2.5, "inexactness": inexactness})
        }
        "t" => {
            let dof = choices.positive();
            json!({"mean": choices.number(), "scale": width(choices, unit), "dof": dof})
        }
        "readings" if choices.chance(30) => json!({"values": values(choices), "paired": true}),
        "exponential" => json!({"mean": choices.positive()}),
        "gamma" => json!({"shape": choices.positive(), "rate": choices.positive()}),
        "lognormal" => json!({"mean": choices.positive(), "std": width(choices, unit)}),
        "beta" => json!({"alpha": choices.positive(), "beta": choices.positive()}),
        "log-uniform" => {
            let lower = choices.pick(&[5e-324, 1e-9, 0.5, 1.0]);
            let upper = choices.mostly(&[1.000_000_000_000_000_2, 2.0, 1e308], &[0.0]);
            json!({"lower": lower, "upper": upper})
        }
        "poisson-count" => {
            let right = [0, 1, 7, 1000, 999_999_999_999_999u64].map(Value::from);
            json!({"count": choices.mostly(&right, &[json!(1e15), json!(2.5)])})
        }
        "samples" if choices.chance(50) => {
            json!({"file": choices.mostly(&["good.txt", "s.txt"], &["missing.txt", "."])})
        }
        "result" => {
            let file = choices.mostly(&["good.result", "r.result"], &["m.json", "good.csv"]);
            json!({"file": file, "output": choices.mostly(&["y", "z"], &["q"])})
        }
        _ => json!({"values": values(choices)}),
    };
    match name {
        "normal" | "gaussian" if choices.chance(30) => fields["dof"] = choices.positive(),
        "rectangular" | "uniform" if choices.chance(15) => fields["dof"] = choices.positive(),
        "trapezoidal" => {
            fields["beta"] = json!(choices.mostly(&[0.0, 0.3, 1.0, 1.0 - 1e-12, 1e-300], &[2.0]));
        }
        "beta" if choices.chance(50) => {
            (fields["lower"], fields["upper"]) = (json!(-0.5), json!(1e3));
        }
        _ => {}
    }
    fields["distribution"] = json!(name);
    members(fields)
}

/// The members of what was made as an object.
fn members(object: Value) -> Map<String, Value> {
    match object {
        Value::Object(members) => members,
        _ => unreachable!("made as an object"),
    }
}

/// The names of all distributions.
pub(super) const DISTRIBUTIONS: &[&str] = &[
    "constant",
    "normal",
    "gaussian",
    "rectangular",
    "uniform",
    "triangular",
    "trapezoidal",
    "curvilinear-trapezoid",
    "arcsine",
    "u-shaped",
    "t",
    "readings",
    "exponential",
    "gamma",
    "lognormal",
    "beta",
    "log-uniform",
    "poisson-count",
    "samples",
    "result",
];

/// An input.
pub(super) fn input(choices: &mut Choices, swept: bool) -> Value {
    let unit = if choices.chance(50) { "m" } else { unit(choices) };
    let mut input = json!({"unit": unit});
    if choices.chance(15) {
        let count = choices.between(1, 4);
        let component = |number: usize| {
            let mut component = distribution(choices, unit);
            let number = if choices.chance(99) { number } else { 0 };
            component.insert("name".to_owned(), json!(format!("part{number}")));
            Value::Object(component)
        };
        input["components"] = (0..count).map(component).collect();
        if choices.chance(95) {
            input["mean"] = choices.number();
        }
    } else {
        for (key, value) in distribution(choices, unit) {
            input[key] = value;
        }
        if swept && choices.chance(30) && input.get("mean").is_some() {
            input["mean"] = json!(formula(choices, &["f".to_owned()], 2));
        }
    }
    if swept && choices.chance(20) {
        input["per"] = json!(choices.mostly(&["row", "f"], &["g", "zz"]));
    }
    if choices.chance(10) {
        input["type"] = json!(choices.mostly(&["A", "B"], &["C"]));
    }
    if choices.chance(10) {
        input["group"] = json!(choices.pick(&["instrument", "", "=1+1"]));
    }
    input
}

/// Conditions: a grid or a table.
pub(super) fn conditions(choices: &mut Choices) -> Value {
    if choices.chance(30) {
        let file = choices.mostly(&["good.csv", "t.csv"], &["missing.csv", "good.txt"]);
        return json!({"file": file, "units": {"f": "Hz", "g": unit(choices)}});
    }
    let axis = |choices: &mut Choices| {
        let values: Value = (0..choices.between(1, 3)).map(|_| choices.number()).collect();
        json!({"unit": unit(choices), "values": values})
    };
    let mut grid = json!({"f": axis(choices)});
    if choices.chance(50) {
        grid["g"] = axis(choices);
    }
    grid
}

/// A list of correlation coefficients.
pub(super) fn correlations(choices: &mut Choices, names: &[String]) -> Value {
    let coefficients = [0.1, 0.5, -0.5, 0.9, -0.99, 1.0, -1.0, 0.0, 0.333, 1e-9];
    let name = |choices: &mut Choices| {
        if names.is_empty() || choices.chance(2) {
            choices.pick(&["zz", "a/part0", "a/part1"]).to_owned()
        } else {
            choices.pick(names)
        }
    };
    let row = |choices: &mut Choices| {
        let (a, mut b) = (name(choices), name(choices));
        for _ in 0..5 {
            if a == b {
                b = name(choices);
            }
        }
        json!([a, b, choices.mostly(&coefficients, &[1.1])])
    };
    (0..choices.between(1, 4)).map(|_| row(choices)).collect()
}

/// A correlation matrix.
pub(super) fn matrix(choices: &mut Choices, names: &[String]) -> Value {
    if choices.chance(20) {
        return json!({"file": choices.pick(&["good.csv", "t.csv", "."])});
    }
    let r = choices.pick(&[0.5, 0.9, -0.3, 1.0, 0.99999]);
    let below = if choices.chance(20) { 0.0 } else { r };
    let n = names.len();
    let row = |i: usize| -> Value {
        (0..n)
            .map(|j| {
                if i == j {
                    1.0
                } else if i > j {
                    below
                } else {
                    r
                }
            })
            .collect()
    };
    json!({"names": names, "values": (0..n).map(row).collect::<Value>()})
}

/// The settings of the Monte Carlo method.
pub(super) fn monte_carlo(choices: &mut Choices) -> Value {
    let trials = match choices.below(60) {
        0..=2 => json!("adaptive"),
        3..=8 => json!(0),
        9 => json!("adaptiv"),
        10 => choices.number(),
        _ => json!(choices.pick(&[2, 3, 10, 100, 300])),
    };
    let mut settings = json!({"trials": trials});
    if choices.chance(20) {
        let right = [json!(0), json!(u64::MAX)];
        settings["seed"] = choices.mostly(&right, &[json!(-1), json!(1.5)]);
    }
    if choices.chance(20) {
        settings["digits"] = json!(choices.mostly(&[1, 2, 3, 15], &[16, 0]));
    }
    if choices.chance(20) {
        settings["max_trials"] = json!(choices.mostly(&[20_000.0, 30_000.0, 1e12], &[1.0]));
    }
    if choices.chance(20) {
        settings["rule"] = json!(choices.mostly(&["7.9", "stein"], &["stien", "7.10"]));
    }
    settings
}

/// What an output may say beside its unit.
pub(super) fn output(choices: &mut Choices) -> Value {
    let unit = if choices.chance(60) { "1" } else { unit(choices) };
    let mut output = json!({"unit": unit});
    if choices.chance(10) {
        output["periodic"] = json!(choices.mostly(&[360.0, 1.0, 1e-300, 1e308], &[0.0]));
    }
    if choices.chance(15) {
        output["tolerance"] = json!({});
        for key in ["lower", "upper"] {
            if choices.chance(80) {
                output["tolerance"][key] = choices.number();
            }
        }
    }
    output
}

/// A whole model file.
pub(super) fn model(choices: &mut Choices) -> Value {
    let count = choices.between(1, 5);
    let mut known: Vec<String> = NAMES[..count].iter().map(|&name| name.to_owned()).collect();
    let names = known.clone();
    let swept = choices.chance(25);
    let mut model = json!({"inputs": {}, "equations": {}, "outputs": {}});
    for name in &names {
        model["inputs"][name] = input(choices, swept);
    }
    if swept {
        model["conditions"] = conditions(choices);
        known.push("f".to_owned());
    }
    if count > 1 && choices.chance(30) {
        model["correlations"] = correlations(choices, &names);
    } else if choices.chance(10) {
        model["correlation_matrix"] = matrix(choices, &names);
    }
    for name in ["y", "z", "w"].into_iter().take(choices.between(1, 3)) {
        let depth = choices.between(1, 4);
        model["equations"][name] = json!(formula(choices, &known, depth));
        model["outputs"][name] = output(choices);
        known.push(name.to_owned());
    }
    model["monte_carlo"] = monte_carlo(choices);
    if choices.chance(95) {
        model["check_units"] = json!(false);
    }
    if choices.chance(70) {
        model["allow_undefined"] = json!(choices.mostly(&[1.0, 1.0, 0.5], &[2.0]));
    }
    match choices.below(10) {
        0 => {
            let right = [0.5, 0.99, 0.999_999_999_999_999_9, 1e-300];
            model["coverage_probability"] = json!(choices.mostly(&right, &[95.0, 1.0]));
        }
        1 => {
            let factor = choices.mostly(&[2.0, 1.0, 3.0, 8.0, 1e-300], &[8.5, 0.0]);
            model["coverage_factor"] = json!(factor);
            if choices.chance(50) {
                model["coverage_factor_fixed"] = json!(true);
            }
        }
        _ => {}
    }
    model
}
