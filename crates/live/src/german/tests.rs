//! No English sentence is left on the German page.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gumption_text::FileSource;
use serde_json::{Value, json};

use super::texts::{Sentence, TEXTS};
use super::{RowNames, part};
use crate::Live;

/// The files beside a model.
#[derive(Debug)]
struct Beside(PathBuf);

impl FileSource for Beside {
    fn content(&self, name: &str, _: u64) -> Result<Vec<u8>, String> {
        fs::read(self.0.join(name)).map_err(|error| error.to_string())
    }
}

fn words_of(text: &str) -> impl Iterator<Item = String> + '_ {
    let words = text.split(|c: char| !c.is_alphabetic()).filter(|word| word.len() > 1);
    words.map(str::to_lowercase)
}

/// The sentences of all tables.
fn sentences() -> impl Iterator<Item = &'static Sentence> {
    [&TEXTS.sentences, &TEXTS.brief].into_iter().flatten()
}

/// Words that only English has: those of the tables' English sides that no German one uses.
fn english() -> BTreeSet<String> {
    let words = || [&TEXTS.words, &TEXTS.shapes, &TEXTS.between].into_iter().flatten();
    let german = words().map(|(_, german)| german).chain(sentences().map(|of| &of.german));
    let german: BTreeSet<String> = german.flat_map(|text| words_of(text)).collect();
    let english = words().map(|(english, _)| english).chain(sentences().flat_map(|of| &of.pieces));
    let english = english.flat_map(|text| words_of(text));
    // a few that every sentence of ours might have, should it stand in no table at all
    let usual = ["the", "of", "is", "are", "and", "with", "that", "from", "which", "by", "not"];
    let usual = usual.into_iter().map(str::to_owned);
    english.chain(usual).filter(|word| !german.contains(word)).collect()
}

/// The texts of markup one by one, and no part of a name in `<code>`.
fn texts(html: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut rest = html;
    while let Some((_, tag, inner, after)) = super::next_holder(rest) {
        rest = after;
        // what the file, or the measurement that it names, says of a quantity
        if tag.starts_with('h') {
            continue;
        }
        let mut text = String::new();
        let inner = inner.replace("<code>", "`").replace("</code>", "`");
        let mut is_tag = false;
        for c in inner.chars() {
            match c {
                '<' => is_tag = true,
                '>' => is_tag = false,
                c if !is_tag => text.push(c),
                _ => {}
            }
        }
        blocks.push(unquoted(&text));
    }
    blocks
}

/// A text without what stands between backticks.
fn unquoted(text: &str) -> String {
    text.split('`').step_by(2).collect()
}

/// What is left in English of an answer about a file.
fn left(answers: &[Value], file: &str, english: &BTreeSet<String>) -> Vec<String> {
    let own: BTreeSet<String> = words_of(file).collect();
    let mut said: Vec<String> = Vec::new();
    for answer in answers {
        for output in answer["results"].as_array().into_iter().flatten() {
            let parts = output["html"].as_object().unwrap().values();
            said.extend(parts.flat_map(|html| texts(html.as_str().unwrap())));
        }
        for html in ["together", "html"] {
            said.extend(texts(answer[html].as_str().unwrap_or("")));
        }
        let notes = answer["notes"].as_array().into_iter().flatten();
        said.extend(notes.map(|note| unquoted(note.as_str().unwrap())));
    }
    let is_left =
        |text: &String| words_of(text).any(|word| english.contains(&word) && !own.contains(&word));
    said.into_iter().filter(is_left).collect()
}

fn asked(name: &str, request: &Value, folder: &Path) -> Value {
    let live = Live::new(gumption_measurements::catalogue(), []);
    let files = Beside(folder.to_owned());
    let answer = live.call(name, &request.to_string(), &files, &Arc::default());
    serde_json::from_str(&answer.unwrap()).unwrap()
}

/// Model files below a folder of the repository.
fn models(below: &str) -> Vec<PathBuf> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(below)];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|of| of == "json") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// What the page says of all models, examples, published ones and worked cases.
#[test]
fn no_english_sentence_is_left_on_the_german_page() {
    let english = english();
    let mut all = Vec::new();
    let (mut answered, mut audited) = (0, 0);
    for path in [models("models"), models("tests/cases")].concat() {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let folder = path.parent().unwrap();
        let asks = json!({"text": text, "name": "m", "lang": "de", "trials": 5000});
        let found = asked("answer", &asks, folder);
        if found["results"].is_null() {
            continue;
        }
        answered += 1;
        let mut answers = vec![found];
        // the audit has few sentences, and takes long
        if path.to_string_lossy().contains("models/examples") && answered % 12 == 0 {
            answers.push(asked("audit", &asks, folder));
            audited += 1;
        }
        let found = left(&answers, &text, &english);
        all.extend(found.into_iter().map(|said| format!("{}: {said}", path.display())));
    }
    assert!(answered > 150 && audited > 2, "{answered} answered, {audited} audited");
    assert!(all.is_empty(), "{} are left:\n{}", all.len(), all.join("\n"));
}

/// What those files have no reason to say: rules of adaptive trials, methods without noise, decision
/// rules, capabilities, and what cannot be evaluated.
#[test]
fn rare_sentences_are_german_too() {
    let english = english();
    let model = |inputs: Value, formula: &str, output: Value, more: Value| {
        let mut file = json!({"format": 1, "inputs": inputs, "equations": {"y": formula}});
        file["outputs"] = json!({"y": output});
        for (key, value) in more.as_object().unwrap() {
            file[key] = value.clone();
        }
        file.to_string()
    };
    let normal = |mean: f64, std: f64| json!({"unit": "1", "distribution": "normal", "mean": mean, "std": std});
    let of_dof = |dof: f64| json!({"unit": "1", "distribution": "normal", "mean": 1, "std": 0.1, "dof": dof});
    let one = json!({"unit": "1"});
    let two = || json!({"a": normal(1.0, 0.1), "b": normal(2.0, 0.1)});
    let rectangular =
        json!({"unit": "1", "distribution": "rectangular", "mean": 1, "half_width": 0.1});
    let named_rule = |rule: &str, half: f64| {
        let prior = json!({"distribution": "normal", "mean": 3, "std": 0.2});
        let [lower, upper] = [3.0 - half, 3.0 + half];
        let tolerance = json!({"lower": lower, "upper": upper, "guard_band": rule, "prior": prior});
        model(two(), "a + b", json!({"unit": "1", "tolerance": tolerance}), json!({}))
    };
    let files = [
        model(
            two(),
            "a*b",
            one.clone(),
            json!({"monte_carlo": {"trials": "adaptive", "digits": 1}}),
        ),
        model(
            two(),
            "a*b",
            one.clone(),
            json!({"monte_carlo": {"trials": "adaptive", "digits": 1, "rule": "stein"}}),
        ),
        model(
            two(),
            "a*b",
            one.clone(),
            json!({"monte_carlo": {"trials": "adaptive", "digits": 4, "max_trials": 30000}}),
        ),
        model(
            two(),
            "a*b",
            one.clone(),
            json!({"monte_carlo": {"trials": "adaptive", "digits": 4, "max_trials": 30000, "rule": "stein"}}),
        ),
        model(two(), "a + b", one.clone(), json!({"method": "exact"})),
        model(two(), "a*b + sin(a*b)", one.clone(), json!({"method": "exact"})),
        model(two(), "a*b + sin(a*b)", one.clone(), json!({"method": "quasi"})),
        model(json!({"a": of_dof(3.0)}), "2*a", one.clone(), json!({"coverage_factor": 2})),
        model(json!({"a": of_dof(2.0)}), "2*a", one.clone(), json!({})),
        model(json!({"a": of_dof(1.0)}), "2*a", one.clone(), json!({})),
        model(
            json!({"a": of_dof(3.0), "b": of_dof(4.0)}),
            "a + b",
            one.clone(),
            json!({"correlations": [["a", "b", 0.5]]}),
        ),
        model(json!({"a": normal(0.0, 1.0)}), "1/a", one.clone(), json!({})),
        model(json!({"a": normal(0.0, 1.0)}), "a^2", one.clone(), json!({})),
        model(json!({"a": normal(0.01, 1.0)}), "1/a", one.clone(), json!({})),
        model(
            json!({"a": normal(0.5, 1.0)}),
            "sqrt(a)",
            one.clone(),
            json!({"monte_carlo": {"allow_undefined": 0.5}}),
        ),
        model(
            json!({"a": rectangular, "b": rectangular}),
            "a + b",
            one.clone(),
            json!({"correlations": [["a", "b", 0.5]]}),
        ),
        model(two(), "a + b", json!({"unit": "1", "cmc": 1}), json!({})),
        model(two(), "a + b", json!({"unit": "1", "cmc": {"value": 1, "raise": true}}), json!({})),
        model(two(), "a + b", json!({"unit": "1", "cmc": 0.1}), json!({})),
        model(two(), "a + b", json!({"unit": "1", "tolerance": {"lower": 2.5}}), json!({})),
        model(
            two(),
            "a + b",
            json!({"unit": "1", "cmc": 1, "cmc_floor": true, "tolerance": {"lower": 2.5}}),
            json!({}),
        ),
        model(two(), "a + b", json!({"unit": "1", "tolerance": {"upper": 2.9}}), json!({})),
        model(
            two(),
            "a + b",
            json!({"unit": "1", "tolerance": {"lower": 2.5, "upper": 3.2, "guard_band": 1}}),
            json!({}),
        ),
        model(
            two(),
            "a + b",
            json!({"unit": "1", "tolerance": {"upper": 2.9, "guard_band": 1, "statement": "non-binary"}}),
            json!({}),
        ),
        model(
            two(),
            "a + b + c",
            json!({"unit": "1", "tolerance": {"upper": 2.9, "guard_band": 1, "statement": "non-binary"}}),
            json!({"conditions": {"c": {"values": [0, 1]}}}),
        ),
        model(
            two(),
            "a + b",
            json!({"unit": "1", "tolerance": {"lower": 2.5, "upper": 3.2, "risk": 0.05}}),
            json!({}),
        ),
        named_rule("rss", 0.5),
        named_rule("rss", 0.1),
        named_rule("rp-10", 0.1),
        named_rule("dobbert", 6.0),
        model(two(), "a + b", one.clone(), json!({"check_units": false})),
        model(
            json!({"a": {"distribution": "normal", "mean": 1, "std": 0.1, "dof": 4}}),
            "a",
            one.clone(),
            json!({"coverage_factor": 2, "coverage_factor_fixed": true}),
        ),
        model(
            two(),
            "a + b",
            one.clone(),
            json!({"coverage_probability": 0.9999, "monte_carlo": {"trials": 10000}}),
        ),
        model(two(), "sin(100) + a + b", one, json!({})),
    ];
    let mut all = Vec::new();
    let mut said = 0;
    for text in &files {
        for full in [false, true] {
            let asks =
                json!({"text": text, "name": "m", "lang": "de", "trials": 20_000, "full": full});
            let found = asked("answer", &asks, Path::new(""));
            said += usize::from(!found["results"].is_null());
            all.extend(left(&[found], text, &english));
        }
    }
    assert!(said > 40, "{said} of {} have results", 2 * files.len());
    assert!(all.is_empty(), "{} are left:\n{}", all.len(), all.join("\n"));
}

/// A translation has every place that the sentence has, and no other.
#[test]
fn translations_have_the_places_of_their_sentences() {
    for sentence in sentences() {
        let (english, count) = (sentence.pieces.join("{}"), sentence.pieces.len() - 1);
        let places = sentence.german.split('{').skip(1).map(|place| {
            let digits = place.split(['}', ':', ';', '+']).next().unwrap();
            digits.parse::<usize>().unwrap()
        });
        let mut places: Vec<usize> = places.collect();
        places.sort_unstable();
        places.dedup();
        // the plural of a unit of figures is not needed in German
        let wanted = (0..count).filter(|place| !(english.contains("digit{}") && *place == 4));
        assert_eq!(places, wanted.collect::<Vec<_>>(), "{english}");
    }
}

#[test]
fn names_of_a_file_stay_and_words_of_a_report_do_not() {
    let html =
        "<tr><th scope=\"row\">density</th><td>normal</td></tr><svg><text>limits</text></svg>";
    let of_file = part(html, RowNames::OfFile);
    assert_eq!(of_file, html);
    let own = part(html, RowNames::OfReport);
    assert!(own.contains("Dichte") && own.contains("Grenzen"), "{own}");
    let markup = part(
        "<p>Tolerance from 1 to 2 m<sup>2</sup>: the estimate lies within, and the value conforms with a probability of 99.00 % (numerical standard error 0.1 %).</p>",
        RowNames::OfFile,
    );
    assert!(
        markup.starts_with("<p>Toleranz von 1 bis 2 m<sup>2</sup>: Der Schätzwert liegt innerhalb"),
        "{markup}"
    );
}
