//! The facts that crates give, held against their sentences.

use std::collections::BTreeMap;
use std::fs;

use crate::manual::sources_of_crates;
use crate::support::root;

/// The key and the names of the arguments of each `fact!` of a source, in alphabetical order.
fn facts(source: &str) -> Vec<(String, Vec<String>)> {
    let code: String = source.lines().filter(|line| !line.trim().starts_with("//")).collect();
    let calls = code.split("fact!(").skip(1);
    calls.filter_map(key_and_arguments).collect()
}

fn key_and_arguments(call: &str) -> Option<(String, Vec<String>)> {
    let (key, rest) = call.trim_start().strip_prefix('"')?.split_once('"')?;
    let mut names = Vec::new();
    let (mut depth, mut is_text, mut item) = (0, false, String::new());
    for c in rest.chars() {
        match c {
            '"' => is_text = !is_text,
            _ if is_text => {}
            '(' | '[' | '{' => depth += 1,
            ')' if depth == 0 => break,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => names.push(std::mem::take(&mut item)),
            _ => {}
        }
        if depth == 0 && c != ',' {
            item.push(c);
        }
    }
    names.push(item);
    let name = |item: &String| item.split('=').next().unwrap_or("").trim().to_owned();
    let mut names: Vec<String> = names.iter().map(name).filter(|name| !name.is_empty()).collect();
    names.sort();
    Some((key.to_owned(), names))
}

/// The keys of a language with the names in braces.
fn sentences(language: &str) -> BTreeMap<String, Vec<String>> {
    let path = root().join("crates/report/src/words").join(language);
    let text = fs::read_to_string(path).expect("the sentences");
    let text = text.replace("\\\"", "");
    let mut found = BTreeMap::new();
    let mut quoted = text.split('"').skip(1).step_by(2);
    while let (Some(key), Some(sentence)) = (quoted.next(), quoted.next()) {
        let places = sentence.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0));
        let mut places: Vec<String> = places.map(str::to_owned).collect();
        places.sort();
        places.dedup();
        found.insert(key.to_owned(), places);
    }
    found
}

#[test]
fn every_fact_has_its_sentence_and_every_sentence_its_fact() {
    let texts = sources_of_crates();
    let english = sentences("english.rs");
    let mut used: BTreeMap<&str, usize> = english.keys().map(|key| (key.as_str(), 0)).collect();
    let all: Vec<(String, Vec<String>)> = texts.iter().flat_map(|text| facts(text)).collect();
    assert!(all.len() > 60, "{all:?}");
    for (key, arguments) in &all {
        let places = english.get(key).unwrap_or_else(|| panic!("no sentence of `{key}`"));
        assert_eq!(places, arguments, "the arguments of `{key}`");
        used.entry(key).and_modify(|count| *count += 1);
    }
    let unused: Vec<&str> = used.into_iter().filter(|(_, n)| *n == 0).map(|(key, _)| key).collect();
    assert!(unused.is_empty(), "facts that nothing gives: {unused:?}");
}
