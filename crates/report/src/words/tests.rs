//! Both languages say the same facts.

use super::{ENGLISH, GERMAN, english, german};

/// The names in braces, in alphabetical order.
fn places(sentence: &str) -> Vec<&str> {
    let mut found: Vec<&str> =
        sentence.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[test]
fn both_languages_have_the_same_keys_and_arguments() {
    for (key, said) in ENGLISH.iter() {
        let german = GERMAN.get(key).unwrap_or_else(|| panic!("`{key}` has no German sentence"));
        assert_eq!(places(said), places(german), "{key}");
        let stops = [said, german].map(|said| said.ends_with('.') && !said.ends_with("..."));
        assert_eq!(stops, [false; 2], "{key} ends with a full stop");
    }
    assert_eq!(ENGLISH.len(), GERMAN.len());
}

#[test]
fn every_key_stands_once() {
    for rooms in [english::ROOMS, german::ROOMS] {
        let mut keys: Vec<&str> =
            rooms.iter().flat_map(|r| r.iter().map(|(key, _)| *key)).collect();
        keys.sort_unstable();
        let twice: Vec<&[&str]> = keys.windows(2).filter(|pair| pair[0] == pair[1]).collect();
        assert!(twice.is_empty(), "{twice:?}");
    }
}
