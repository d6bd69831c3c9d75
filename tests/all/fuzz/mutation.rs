//! Changes of a file that know what stands where.

use super::grammar;
use super::random::Random;
use super::tree::Tree;

/// Keys of model files and result files.
const KEYS: &[&str] = &[
    "format",
    "title",
    "source",
    "about",
    "inputs",
    "correlations",
    "correlation_matrix",
    "conditions",
    "equations",
    "model",
    "outputs",
    "coverage_probability",
    "coverage_factor",
    "coverage_factor_fixed",
    "monte_carlo",
    "check_units",
    "allow_undefined",
    "observations",
    "effects",
    "unit",
    "distribution",
    "mean",
    "std",
    "expanded",
    "k",
    "p",
    "dof",
    "half_width",
    "semi_range",
    "lower",
    "upper",
    "mode",
    "beta",
    "alpha",
    "inexactness",
    "scale",
    "values",
    "paired",
    "shape",
    "rate",
    "count",
    "file",
    "output",
    "value",
    "components",
    "name",
    "type",
    "group",
    "per",
    "evidence",
    "periodic",
    "tolerance",
    "cmc",
    "cmc_floor",
    "prior",
    "trials",
    "seed",
    "digits",
    "max_trials",
    "rule",
    "names",
    "units",
    "result",
    "quantiles",
    "scores",
    "sensitivities",
    "standard_uncertainty",
    "estimate",
    "input_correlations",
    "provenance",
    "output_correlations",
    "from",
    "step",
    "model_sha256",
    "y",
    "a",
    "f",
];

const TEXTS: &[&str] = &[
    "",
    "x",
    "\u{0}",
    "1/0",
    "ä\u{1F600}",
    "10 % + 1e308",
    "x^x^x",
    "-(-(-a))",
    "sqrt(-1)",
    "row",
    "A",
    "good.csv",
    "good.txt",
    "good.result",
    "missing",
    "..",
    "inclined-plane",
    "pi",
    "sin",
    "adaptive",
    "7.9",
    "stein",
    "a b",
    "\u{202e}",
    "=cmd()",
    "`",
    "{}",
    "a/part0",
];

/// Changes a file once.
pub(super) fn mutate(random: &mut Random, file: &mut Tree) {
    match random.below(24) {
        0..=5 => number(random, file),
        6 => text(random, file),
        7 => unit(random, file),
        8..=9 => formula(random, file),
        10..=11 => input(random, file),
        12 => distribution(random, file),
        13 => {
            let names = file.get_mut("inputs").map(|inputs| inputs.keys()).unwrap_or_default();
            if random.chance(70) {
                let list = grammar::correlations(random, &names);
                file.put("correlations", list);
            } else {
                let matrix = grammar::matrix(random, &names);
                file.put("correlation_matrix", matrix);
            }
        }
        14 => {
            let conditions = grammar::conditions(random);
            file.put("conditions", conditions);
        }
        15 => {
            let settings = grammar::monte_carlo(random);
            file.put("monte_carlo", settings);
        }
        16 => {
            let output = grammar::output(random);
            inside(random, file, "outputs", |_, place| *place = output);
        }
        17 => members(random, file, |random, members| {
            let at = random.below(members.len());
            members.remove(at);
        }),
        18 => members(random, file, |random, members| {
            let member = members[random.below(members.len())].clone();
            let at = random.below(members.len() + 1);
            members.insert(at, member);
        }),
        19 => members(random, file, |random, members| {
            let at = random.below(members.len());
            members[at].0 = random.pick(KEYS).to_owned();
        }),
        20 => members(random, file, |random, members| {
            let value = scalar(random);
            let at = random.below(members.len() + 1);
            members.insert(at, (random.pick(KEYS).to_owned(), value));
        }),
        21 => misspelt(random, file),
        22 => {
            let size = file.size();
            let taken = file.at_mut(random.below(size)).map(|value| value.clone());
            let place = random.below(size);
            if let (Some(taken), Some(place)) = (taken, file.at_mut(place)) {
                *place = taken;
            }
        }
        _ => {
            let value = scalar(random);
            let size = file.size();
            if let Some(place) = file.at_mut(random.below(size)) {
                *place = match random.below(4) {
                    0 => Tree::list([place.clone()]),
                    1 => Tree::object([(random.pick(KEYS), place.clone())]),
                    _ => value,
                };
            }
        }
    }
}

/// Damages the text itself.
pub(super) fn damage(random: &mut Random, text: &mut String) {
    let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
    if places.is_empty() {
        return;
    }
    let at = places[random.below(places.len())];
    match random.below(4) {
        0 => text.truncate(at),
        1 => {
            text.remove(at);
        }
        _ => {
            let sign =
                random.pick(&["\"", "{", "}", "[", "]", ",", ":", "-", "e", "\\", "\u{feff}", "/"]);
            text.insert_str(at, sign);
        }
    }
}

fn scalar(random: &mut Random) -> Tree {
    match random.below(8) {
        0..=2 => Tree::raw(random.number()),
        3 => Tree::raw(random.pick(&["null", "true", "false", "{}", "[]", "[[]]", "{\"\": 1}"])),
        4 => Tree::text(random.pick(grammar::UNITS)),
        5 => Tree::text(random.pick(grammar::NO_UNITS)),
        _ => Tree::text(random.pick(TEXTS)),
    }
}

/// Some value that `is` what is wanted, or the first after a random place.
fn find<'t>(
    random: &mut Random,
    file: &'t mut Tree,
    is: impl Fn(&Tree) -> bool,
) -> Option<&'t mut Tree> {
    let size = file.size();
    let start = random.below(size);
    let number = (0..size)
        .map(|step| (start + step) % size)
        .find(|&n| file.at_mut(n).is_some_and(|t| is(t)))?;
    file.at_mut(number)
}

fn number(random: &mut Random, file: &mut Tree) {
    let number = random.number();
    if let Some(place) = find(random, file, |tree| matches!(tree, Tree::Raw(_))) {
        *place = Tree::raw(number);
    }
}

fn text(random: &mut Random, file: &mut Tree) {
    let text = random.pick(TEXTS);
    if let Some(place) = find(random, file, |tree| matches!(tree, Tree::Text(_))) {
        *place = Tree::text(text);
    }
}

/// Changes a random member of the object at `key` of the root.
fn inside(
    random: &mut Random,
    file: &mut Tree,
    key: &str,
    change: impl FnOnce(&mut Random, &mut Tree),
) {
    if let Some(Tree::Object(members)) = file.get_mut(key)
        && !members.is_empty()
    {
        let at = random.below(members.len());
        change(random, &mut members[at].1);
    }
}

/// Changes the members of a random object that has some.
fn members(
    random: &mut Random,
    file: &mut Tree,
    change: impl FnOnce(&mut Random, &mut Vec<(String, Tree)>),
) {
    let is = |tree: &Tree| matches!(tree, Tree::Object(members) if !members.is_empty());
    if let Some(Tree::Object(members)) = find(random, file, is) {
        change(random, members);
    }
}

fn unit(random: &mut Random, file: &mut Tree) {
    let unit = grammar::unit(random);
    let key = random.pick(&["inputs", "inputs", "outputs", "conditions"]);
    inside(random, file, key, |_, place| place.put("unit", Tree::text(unit)));
}

fn formula(random: &mut Random, file: &mut Tree) {
    let mut names: Vec<String> = Vec::new();
    for key in ["inputs", "conditions", "equations"] {
        names.extend(file.get_mut(key).map(|tree| tree.keys()).unwrap_or_default());
    }
    let depth = random.between(1, 5);
    let formula = Tree::text(grammar::formula(random, &names, depth));
    if random.chance(85) {
        inside(random, file, "equations", |_, place| *place = formula);
    } else {
        inside(random, file, "inputs", |_, place| place.put("mean", formula));
    }
}

fn input(random: &mut Random, file: &mut Tree) {
    let swept = file.get_mut("conditions").is_some();
    let input = grammar::input(random, swept);
    inside(random, file, "inputs", |_, place| *place = input);
}

/// Another distribution with its fields, the rest of the input as it was.
fn distribution(random: &mut Random, file: &mut Tree) {
    inside(random, file, "inputs", |random, place| {
        let fields = grammar::distribution(random, "m");
        if let Tree::Object(members) = place {
            let kept = ["unit", "about", "type", "group", "per"];
            members.retain(|(key, _)| kept.contains(&key.as_str()));
            members.extend(fields.into_iter().map(|(key, value)| (key.to_owned(), value)));
        }
    });
}

/// A letter of a key changed, left out or put twice.
fn misspelt(random: &mut Random, file: &mut Tree) {
    members(random, file, |random, members| {
        let at = random.below(members.len());
        let key = &mut members[at].0;
        let places: Vec<usize> = key.char_indices().map(|(at, _)| at).collect();
        let Some(&place) = places.get(random.below(places.len().max(1))) else {
            return;
        };
        match random.below(3) {
            0 => {
                key.remove(place);
            }
            1 => key.insert(place, 'q'),
            _ => {
                key.remove(place);
                key.insert(place, 'q');
            }
        }
    });
}
