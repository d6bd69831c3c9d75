//! Changes of a file: those of its values, which know what stands where, and those of its text.

use serde_json::{Map, Value, json};

use super::choices::Choices;
use super::{grammar, keys};

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

/// Changes a value of the file, or several that belong together.
pub(super) fn mutate(choices: &mut Choices, file: &mut Value) {
    match choices.below(24) {
        0..=5 => {
            let number = choices.number();
            put(choices, file, number, |value| !value.is_string() && leaf(value));
        }
        6 => {
            let text = json!(choices.pick(TEXTS));
            put(choices, file, text, Value::is_string);
        }
        7 => {
            let unit = json!(grammar::unit(choices));
            let key = choices.pick(&["inputs", "inputs", "outputs", "conditions"]);
            if let Some(Value::Object(of)) = inside(choices, file, key) {
                of.insert("unit".to_owned(), unit);
            }
        }
        8..=9 => formula(choices, file),
        10..=11 => {
            let swept = file.get("conditions").is_some();
            let input = grammar::input(choices, swept);
            if let Some(of) = inside(choices, file, "inputs") {
                *of = input;
            }
        }
        // another distribution, the rest of the input as it was
        12 => {
            let fields = grammar::distribution(choices, "m");
            if let Some(Value::Object(input)) = inside(choices, file, "inputs") {
                let kept = ["unit", "about", "type", "group", "per"];
                input.retain(|key, _| kept.contains(&key.as_str()));
                input.extend(fields);
            }
        }
        13 => {
            let names = names(file, "inputs");
            let list = grammar::correlations(choices, &names);
            let matrix = grammar::matrix(choices, &names);
            if choices.chance(70) {
                set(file, "correlations", list);
            } else {
                set(file, "correlation_matrix", matrix);
            }
        }
        14 => set(file, "conditions", grammar::conditions(choices)),
        15 => set(file, "monte_carlo", grammar::monte_carlo(choices)),
        16 => {
            let output = grammar::output(choices);
            if let Some(of) = inside(choices, file, "outputs") {
                *of = output;
            }
        }
        17 => members(choices, file, |choices, members| {
            let index = choices.below(members.len());
            members.remove(index);
        }),
        18 => members(choices, file, |choices, members| {
            let index = choices.below(members.len());
            members[index].0 = choices.pick(keys());
        }),
        19..=20 => members(choices, file, |choices, members| {
            let index = choices.below(members.len() + 1);
            members.insert(index, (choices.pick(keys()), scalar(choices)));
        }),
        21 => members(choices, file, |choices, members| {
            let index = choices.below(members.len());
            misspell(choices, &mut members[index].0);
        }),
        22 => {
            let all = pointers(file, |_| true);
            let taken = file.pointer(&choices.pick(&all)).cloned().unwrap_or_default();
            put(choices, file, taken, |_| true);
        }
        _ => {
            let all = pointers(file, |_| true);
            if let Some(value) = file.pointer_mut(&choices.pick(&all)) {
                *value = match choices.below(4) {
                    0 => json!([value]),
                    1 => json!({choices.pick(keys()): value}),
                    _ => scalar(choices),
                };
            }
        }
    }
}

/// The addresses (JSON pointers) of the values that are what is wanted.
fn pointers(file: &Value, wanted: fn(&Value) -> bool) -> Vec<String> {
    fn walk(value: &Value, at: &str, wanted: fn(&Value) -> bool, found: &mut Vec<String>) {
        if wanted(value) {
            found.push(at.to_owned());
        }
        match value {
            Value::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    walk(item, &format!("{at}/{index}"), wanted, found);
                }
            }
            Value::Object(members) => {
                for (key, value) in members {
                    let key = key.replace('~', "~0").replace('/', "~1");
                    walk(value, &format!("{at}/{key}"), wanted, found);
                }
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    walk(file, "", wanted, &mut found);
    found
}

fn leaf(value: &Value) -> bool {
    !value.is_object() && !value.is_array()
}

/// A value in place of one that is what is wanted.
fn put(choices: &mut Choices, file: &mut Value, value: Value, wanted: fn(&Value) -> bool) {
    let found = pointers(file, wanted);
    if !found.is_empty()
        && let Some(old) = file.pointer_mut(&choices.pick(&found))
    {
        *old = value;
    }
}

fn set(file: &mut Value, key: &str, value: Value) {
    if let Value::Object(members) = file {
        members.insert(key.to_owned(), value);
    }
}

/// The keys of the object at `key` of the root.
fn names(file: &Value, key: &str) -> Vec<String> {
    let of = file.get(key).and_then(Value::as_object);
    of.into_iter().flat_map(Map::keys).cloned().collect()
}

/// A member of the object at `key` of the root.
fn inside<'f>(choices: &mut Choices, file: &'f mut Value, key: &str) -> Option<&'f mut Value> {
    let names = names(file, key);
    if names.is_empty() { None } else { file.get_mut(key)?.get_mut(choices.pick(&names)) }
}

/// Changes the members of an object that has some.
fn members(
    choices: &mut Choices,
    file: &mut Value,
    change: impl FnOnce(&mut Choices, &mut Vec<(String, Value)>),
) {
    let objects = pointers(file, |value| value.as_object().is_some_and(|of| !of.is_empty()));
    if !objects.is_empty()
        && let Some(Value::Object(object)) = file.pointer_mut(&choices.pick(&objects))
    {
        let mut members: Vec<_> = std::mem::take(object).into_iter().collect();
        change(choices, &mut members);
        *object = members.into_iter().collect();
    }
}

fn formula(choices: &mut Choices, file: &mut Value) {
    let known = ["inputs", "conditions", "equations"].map(|key| names(file, key)).concat();
    let depth = choices.between(1, 5);
    let formula = json!(grammar::formula(choices, &known, depth));
    if choices.chance(85) {
        if let Some(of) = inside(choices, file, "equations") {
            *of = formula;
        }
    } else if let Some(Value::Object(of)) = inside(choices, file, "inputs") {
        of.insert("mean".to_owned(), formula);
    }
}

fn scalar(choices: &mut Choices) -> Value {
    let others = [json!(null), json!(true), json!(false), json!({}), json!([]), json!([[]])];
    match choices.below(8) {
        0..=2 => choices.number(),
        3 => choices.pick(&others),
        4 => json!(grammar::unit(choices)),
        _ => json!(choices.pick(TEXTS)),
    }
}

/// A letter of a key left out, put in, or changed.
fn misspell(choices: &mut Choices, key: &mut String) {
    let Some((at, letter)) = key.char_indices().nth(choices.below(key.chars().count().max(1)))
    else {
        return;
    };
    let (end, with) = choices.pick(&[(at + letter.len_utf8(), ""), (at, "q")]);
    let end = if choices.chance(30) { at + letter.len_utf8() } else { end };
    key.replace_range(at..end, with);
}

/// The text in tokens: quoted texts, numbers and words, single signs, white space.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '_');
        let length = if first == '"' {
            rest.get(1..).and_then(|after| after.find('"')).map_or(rest.len(), |at| at + 2)
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if first.is_whitespace() {
            rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token.to_owned());
        rest = after;
    }
    tokens
}

/// What may stand where a token stood.
fn piece(choices: &mut Choices) -> String {
    match choices.below(4) {
        0 => choices.spelling(),
        1 => choices.pick(&[",", ":", "{", "}", "[", "]", "\"", "//", "\u{feff}"]).to_owned(),
        2 => json!(choices.pick(keys())).to_string(),
        _ => scalar(choices).to_string(),
    }
}

/// Damages the text itself so many times: it need not be JSON afterwards, and keys may stand twice.
pub(super) fn damage(choices: &mut Choices, text: &str, times: usize) -> String {
    let mut tokens = tokens(text);
    for _ in 0..times {
        if tokens.is_empty() {
            break;
        }
        let n = tokens.len();
        let at = choices.below(n);
        match choices.below(28) {
            0..=1 => drop(tokens.drain(at..(at + choices.between(1, 5)).min(n))),
            2..=3 => tokens.insert(at, piece(choices)),
            4..=7 => tokens[at] = piece(choices),
            8..=15 => {
                let is_number = |&index: &usize| tokens[index].parse::<f64>().is_ok();
                if let Some(index) = (at..n).chain(0..at).find(is_number) {
                    tokens[index] = choices.spelling();
                }
            }
            // a member twice, where its value is a single token
            16 => {
                let length = |start: usize| {
                    let is =
                        |index: usize, sign: &str| tokens.get(index).is_some_and(|t| t == sign);
                    let colon = is(start + 1, ":");
                    [4, 5].into_iter().find(|length| colon && is(start + length - 1, ","))
                };
                let found = (at..n).chain(0..at).find_map(|start| Some((start, length(start)?)));
                if let Some((start, length)) = found {
                    let member = tokens[start..start + length].to_vec();
                    tokens.splice(start..start, member);
                }
            }
            17..=18 => {
                let run = tokens[at..(at + choices.between(1, 39)).min(n)].to_vec();
                tokens.splice(at..at, run);
            }
            19..=20 => {
                let other = choices.below(n);
                tokens.swap(at, other);
            }
            21..=26 => {
                let signs = ["(", ")", "*", "-", "^", "0", "9", "e", "/", " ", "\\", ",", "ß", "%"];
                let token = &mut tokens[at];
                let indices: Vec<usize> = token.char_indices().map(|(index, _)| index).collect();
                token.insert_str(choices.pick(&indices), choices.pick(&signs));
            }
            _ => tokens.truncate(at),
        }
    }
    tokens.concat()
}
