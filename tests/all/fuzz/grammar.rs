//! Model files made by the grammar: most of them are right, or nearly so.

use super::random::Random;
use super::tree::Tree;

/// Names of quantities.
pub(super) const NAMES: &[&str] = &["a", "b", "c", "tilt", "x_1", "μ"];

/// Units: mostly of a length or none.
pub(super) const UNITS: &[&str] = &[
    "m", "m", "mm", "1", "", "m^2", "s", "m/s^2", "deg", "degC", "K", "%", "ppm", "kg*m^-3", "V",
    "nm", "ohm", "'", "in", "dB", "Gm^9", "km^7/s^3", "fm",
];

/// Texts that are no units.
pub(super) const NO_UNITS: &[&str] =
    &["meter", "m//s", "km^20", "m^999", "mm^1/2", "1e300 m", "Gm^-30", "mK^", "ms-1"];

/// A unit.
pub(super) fn unit(random: &mut Random) -> &'static str {
    random.mostly(UNITS, NO_UNITS)
}

const FORMULA_UNARY: &[&str] = &[
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "log10",
    "sqrt", "cbrt", "abs", "-",
];
const FORMULA_BINARY: &[&str] = &["atan2", "min", "max", "hypot"];
const FORMULA_INFIX: &[&str] = &["+", "-", "*", "/", "^", "<", ">=", "==", "!=", "<="];
const FORMULA_LEAVES: &[&str] = &["0", "1", "2.5", "pi", "1e308", "1e-308", "1e3", "(-1)"];

/// A formula over some names.
pub(super) fn formula(random: &mut Random, names: &[String], depth: usize) -> String {
    if depth == 0 || random.chance(25) {
        if names.is_empty() || random.chance(15) {
            return random.mostly(FORMULA_LEAVES, &["e", "zz", "1,5"]).to_owned();
        }
        return names[random.below(names.len())].clone();
    }
    let inner = |random: &mut Random| formula(random, names, depth - 1);
    match random.below(10) {
        0..=2 => {
            let (function, a) =
                (random.mostly(FORMULA_UNARY, &["log", "sine", "kelvin"]), inner(random));
            format!("{function}({a})")
        }
        3 => {
            let (function, a, b) = (random.pick(FORMULA_BINARY), inner(random), inner(random));
            format!("{function}({a}, {b})")
        }
        // sums and products are what measurements are made of
        4..=7 => {
            let (sign, a, b) = (random.pick(&["+", "-", "*"]), inner(random), inner(random));
            format!("({a} {sign} {b})")
        }
        _ => {
            let (sign, a, b) = (random.pick(FORMULA_INFIX), inner(random), inner(random));
            format!("({a} {sign} {b})")
        }
    }
}

/// A width as laboratories write it.
pub(super) fn specification(random: &mut Random, unit: &str) -> String {
    let terms = random.between(1, 3);
    let term = |random: &mut Random| match random.below(40) {
        0..=9 => format!("{} %", random.positive()),
        10..=19 => format!("{} ppm", random.positive()),
        20..=24 => format!("{} % of {} {unit}", random.positive(), random.positive()),
        25..=34 => format!("{} {unit}", random.positive()),
        35..=38 => format!("{} % of reading", random.positive()),
        _ => random.pick(&["", "0 %", "-1 %", "1e400 %", "1 % of", "2 % + ", "nan %"]).to_owned(),
    };
    (0..terms).map(|_| term(random)).collect::<Vec<_>>().join(" + ")
}

/// The fields of a distribution, with its name.
pub(super) fn distribution(random: &mut Random, unit: &str) -> Vec<(&'static str, Tree)> {
    let number = |random: &mut Random| Tree::raw(random.number());
    let positive = |random: &mut Random| Tree::raw(random.positive());
    let width = |random: &mut Random| {
        if random.chance(20) {
            Tree::text(specification(random, unit))
        } else {
            Tree::raw(random.positive())
        }
    };
    let limits = |random: &mut Random, fields: &mut Vec<(&'static str, Tree)>| {
        if random.chance(50) {
            let mean = random.number();
            fields.push(("mean", Tree::raw(mean)));
            fields.push((random.pick(&["half_width", "semi_range"]), width(random)));
        } else {
            let lower = random.below(1000) as f64 / 100.0;
            let upper = lower + (1 + random.below(500)) as f64 / 100.0;
            fields.push(("lower", Tree::raw(lower.to_string())));
            fields.push(("upper", Tree::raw(upper.to_string())));
        }
    };
    let mut fields = Vec::new();
    let name = random.pick(DISTRIBUTIONS);
    fields.push(("distribution", Tree::text(name)));
    match name {
        "constant" => fields.push(("value", number(random))),
        "normal" | "gaussian" => {
            fields.push(("mean", number(random)));
            if random.chance(60) {
                fields.push(("std", width(random)));
            } else {
                fields.push(("expanded", width(random)));
                let key = random.pick(&["k", "p"]);
                let value = if key == "k" { "2" } else { random.pick(&["0.95", "0.9545", "1e-9"]) };
                fields.push((key, Tree::raw(value)));
            }
            if random.chance(30) {
                fields.push(("dof", positive(random)));
            }
        }
        "triangular" if random.chance(30) => {
            for (key, value) in [("lower", "0.5"), ("upper", "2.5")] {
                fields.push((key, Tree::raw(value)));
            }
            let mode = random.mostly(&["0.5", "0.500001", "1", "2", "2.5"], &["3"]);
            fields.push(("mode", Tree::raw(mode)));
        }
        "rectangular" | "uniform" | "arcsine" | "u-shaped" | "triangular" => {
            limits(random, &mut fields);
            if matches!(name, "rectangular" | "uniform") && random.chance(15) {
                fields.push(("dof", positive(random)));
            }
        }
        "trapezoidal" => {
            limits(random, &mut fields);
            let beta = random.mostly(&["0", "0.3", "1", "0.999999999999", "1e-300"], &["2"]);
            fields.push(("beta", Tree::raw(beta)));
        }
        "curvilinear-trapezoid" => {
            for (key, value) in [("lower", "-0.5"), ("upper", "2.5")] {
                fields.push((key, Tree::raw(value)));
            }
            let inexactness = random.mostly(&["0.001", "0.1", "1", "5e-324"], &["100"]);
            fields.push(("inexactness", Tree::raw(inexactness)));
        }
        "t" => {
            fields.push(("mean", number(random)));
            fields.push(("scale", width(random)));
            fields.push(("dof", positive(random)));
        }
        "readings" => {
            fields.push(("values", values(random)));
            if random.chance(30) {
                fields.push(("paired", Tree::raw("true")));
            }
        }
        "exponential" => fields.push(("mean", positive(random))),
        "gamma" => {
            fields.push(("shape", positive(random)));
            fields.push(("rate", positive(random)));
        }
        "lognormal" => {
            fields.push(("mean", positive(random)));
            fields.push(("std", width(random)));
        }
        "beta" => {
            fields.push(("alpha", positive(random)));
            fields.push(("beta", positive(random)));
            if random.chance(50) {
                for (key, value) in [("lower", "-0.5"), ("upper", "1e3")] {
                    fields.push((key, Tree::raw(value)));
                }
            }
        }
        "log-uniform" => {
            let lower = random.pick(&["5e-324", "1e-9", "0.5", "1"]);
            let upper = random.mostly(&["1.0000000000000002", "2", "1e308"], &["0"]);
            fields.extend([("lower", Tree::raw(lower)), ("upper", Tree::raw(upper))]);
        }
        "poisson-count" => {
            let count =
                random.mostly(&["0", "1", "7", "1000", "999999999999999"], &["1e15", "2.5"]);
            fields.push(("count", Tree::raw(count)));
        }
        "samples" if random.chance(50) => fields.push(("values", values(random))),
        "samples" => {
            let file = random.mostly(&["good.txt", "s.txt"], &["missing.txt", "."]);
            fields.push(("file", Tree::text(file)));
        }
        _ => {
            let file = random.mostly(&["good.result", "r.result"], &["m.json", "good.csv"]);
            fields.push(("file", Tree::text(file)));
            fields.push(("output", Tree::text(random.mostly(&["y", "z"], &["q"]))));
        }
    }
    fields
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

/// Readings or samples.
fn values(random: &mut Random) -> Tree {
    let count: usize = random.mostly(&["2", "5", "5", "9", "40"], &["0", "1"]).parse().unwrap();
    let plain = random.chance(90);
    Tree::list((0..count).map(|_| {
        let number = if plain { random.positive() } else { random.number() };
        Tree::raw(number)
    }))
}

/// An input.
pub(super) fn input(random: &mut Random, swept: bool) -> Tree {
    let unit = if random.chance(50) { "m" } else { unit(random) };
    let mut members = vec![("unit", Tree::text(unit))];
    if random.chance(15) {
        let component = |random: &mut Random, number: usize| {
            let name = if random.chance(99) { number } else { 0 };
            let name = format!("part{name}");
            let own = distribution(random, unit);
            Tree::object(std::iter::once(("name", Tree::text(name))).chain(own))
        };
        if random.chance(95) {
            members.push(("mean", Tree::raw(random.number())));
        }
        let count = random.between(1, 4);
        let components: Vec<Tree> = (0..count).map(|i| component(random, i)).collect();
        members.push(("components", Tree::List(components)));
    } else {
        members.extend(distribution(random, unit));
        if swept && random.chance(30) {
            let formula = formula(random, &["f".to_owned()], 2);
            if let Some((_, mean)) = members.iter_mut().find(|(key, _)| *key == "mean") {
                *mean = Tree::text(formula);
            }
        }
    }
    if swept && random.chance(20) {
        members.push(("per", Tree::text(random.mostly(&["row", "f"], &["g", "zz"]))));
    }
    if random.chance(10) {
        members.push(("type", Tree::text(random.mostly(&["A", "B"], &["C"]))));
    }
    if random.chance(10) {
        members.push(("group", Tree::text(random.pick(&["instrument", "", "=1+1"]))));
    }
    Tree::object(members)
}

/// Conditions: a grid or a table.
pub(super) fn conditions(random: &mut Random) -> Tree {
    if random.chance(30) {
        let file = random.mostly(&["good.csv", "t.csv"], &["missing.csv", "good.txt"]);
        let units = [("f", Tree::text("Hz")), ("g", Tree::text(unit(random)))];
        return Tree::object([("file", Tree::text(file)), ("units", Tree::object(units))]);
    }
    let count = random.between(1, 2);
    let axis = |random: &mut Random| {
        let values = random.between(1, 3);
        let values = Tree::list((0..values).map(|_| Tree::raw(random.number())));
        Tree::object([("unit", Tree::text(unit(random))), ("values", values)])
    };
    Tree::object(["f", "g"].into_iter().take(count).map(|name| (name, axis(random))))
}

/// A list of correlation coefficients.
pub(super) fn correlations(random: &mut Random, names: &[String]) -> Tree {
    let name = |random: &mut Random| {
        if names.is_empty() || random.chance(2) {
            Tree::text(random.pick(&["zz", "a/part0", "a/part1"]))
        } else {
            Tree::text(names[random.below(names.len())].clone())
        }
    };
    let count = random.between(1, 4);
    let coefficients = &["0.1", "0.5", "-0.5", "0.9", "-0.99", "1", "-1", "0", "0.333", "1e-9"];
    Tree::list((0..count).map(|_| {
        let (a, mut b) = (name(random), name(random));
        for _ in 0..5 {
            if a.render() == b.render() {
                b = name(random);
            }
        }
        Tree::list([a, b, Tree::raw(random.mostly(coefficients, &["1.1"]))])
    }))
}

/// A correlation matrix.
pub(super) fn matrix(random: &mut Random, names: &[String]) -> Tree {
    if random.chance(20) {
        return Tree::object([("file", Tree::text(random.pick(&["good.csv", "t.csv", "."])))]);
    }
    let n = names.len();
    let r = random.pick(&["0.5", "0.9", "-0.3", "1", "0.99999"]);
    let odd = random.chance(20);
    let rows = (0..n).map(|i| {
        Tree::list((0..n).map(|j| {
            Tree::raw(if i == j {
                "1"
            } else if odd && i > j {
                "0"
            } else {
                r
            })
        }))
    });
    let rows: Vec<Tree> = rows.collect();
    let names = Tree::list(names.iter().map(Tree::text));
    Tree::object([("names", names), ("values", Tree::List(rows))])
}

/// The settings of the Monte Carlo method.
pub(super) fn monte_carlo(random: &mut Random) -> Tree {
    let trials = match random.below(60) {
        0..=2 => Tree::text("adaptive"),
        3..=8 => Tree::raw("0"),
        9 => Tree::text("adaptiv"),
        10 => Tree::raw(random.number()),
        _ => Tree::raw(random.pick(&["2", "3", "10", "100", "300"])),
    };
    let mut members = vec![("trials", trials)];
    if random.chance(20) {
        members.push((
            "seed",
            Tree::raw(random.mostly(&["0", "18446744073709551615"], &["-1", "1.5"])),
        ));
    }
    if random.chance(20) {
        members.push(("digits", Tree::raw(random.mostly(&["1", "2", "3", "15"], &["16", "0"]))));
    }
    if random.chance(20) {
        members.push(("max_trials", Tree::raw(random.mostly(&["20000", "30000", "1e12"], &["1"]))));
    }
    if random.chance(20) {
        members.push(("rule", Tree::text(random.mostly(&["7.9", "stein"], &["stien", "7.10"]))));
    }
    Tree::object(members)
}

/// What an output may say beside its unit.
pub(super) fn output(random: &mut Random) -> Tree {
    let unit = if random.chance(60) { "1" } else { unit(random) };
    let mut members = vec![("unit", Tree::text(unit))];
    if random.chance(10) {
        members
            .push(("periodic", Tree::raw(random.mostly(&["360", "1", "1e-300", "1e308"], &["0"]))));
    }
    if random.chance(15) {
        let mut limits = Vec::new();
        for key in ["lower", "upper"] {
            if random.chance(80) {
                limits.push((key, Tree::raw(random.number())));
            }
        }
        members.push(("tolerance", Tree::object(limits)));
    }
    Tree::object(members)
}

/// A whole model file.
pub(super) fn model(random: &mut Random) -> Tree {
    let count = random.between(1, 5);
    let names: Vec<String> = NAMES.iter().take(count).map(|&name| name.to_owned()).collect();
    let swept = random.chance(25);
    let inputs = Tree::object(names.iter().map(|name| (name.clone(), input(random, swept))));
    let mut members = vec![("inputs", inputs)];
    let mut known = names.clone();
    if swept {
        members.push(("conditions", conditions(random)));
        known.push("f".to_owned());
    }
    if count > 1 && random.chance(30) {
        members.push(("correlations", correlations(random, &names)));
    } else if random.chance(10) {
        members.push(("correlation_matrix", matrix(random, &names)));
    }
    let mut equations = Vec::new();
    for name in ["y", "z", "w"].into_iter().take(random.between(1, 3)) {
        let depth = random.between(1, 4);
        equations.push((name, Tree::text(formula(random, &known, depth))));
        known.push(name.to_owned());
    }
    let outputs: Vec<(&str, Tree)> =
        equations.iter().map(|(name, _)| (*name, output(random))).collect();
    members.push(("equations", Tree::object(equations)));
    members.push(("outputs", Tree::object(outputs)));
    members.push(("monte_carlo", monte_carlo(random)));
    if random.chance(95) {
        members.push(("check_units", Tree::raw("false")));
    }
    if random.chance(70) {
        members.push(("allow_undefined", Tree::raw(random.mostly(&["1", "1", "0.5"], &["2"]))));
    }
    match random.below(10) {
        0 => {
            let p = random.mostly(&["0.5", "0.99", "0.9999999999999999", "1e-300"], &["95", "1"]);
            members.push(("coverage_probability", Tree::raw(p)));
        }
        1 => {
            let factor = random.mostly(&["2", "1", "3", "8", "1e-300"], &["8.5", "0"]);
            members.push(("coverage_factor", Tree::raw(factor)));
            if random.chance(50) {
                members.push(("coverage_factor_fixed", Tree::raw("true")));
            }
        }
        _ => {}
    }
    Tree::object(members)
}
