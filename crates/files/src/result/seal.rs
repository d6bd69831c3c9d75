//! The digest that a saved result carries (ISO/IEC 17025:2017, 7.11.3: data are safeguarded against
//! tampering and loss).
//!
//! The digest covers the content of the file and not its bytes, so that another layout or key order
//! does not change it. Shortened digests of the parts tell what was changed, if that can be
//! determined; the whole digest covers them too.

use serde_json::{Map, Value};

use super::form::ResultForm;
use gumption_text::bytes::sha256;

/// The key of the digest of everything else in the file.
pub(crate) const DIGEST: &str = "sha256";

/// The key of the digests of its parts.
const PARTS: &str = "sha256_of_parts";

/// Hexadecimal digits of a part's digest.
const SHORT: usize = 16;

impl ResultForm {
    /// The same with the digests of what it says, of numbers as they will be read.
    ///
    /// # Errors
    /// None that can happen: all keys are texts.
    pub fn sealed(mut self) -> serde_json::Result<Self> {
        (self.sha256_of_parts, self.sha256) = (Vec::new(), None);
        let Value::Object(mut content) = serde_json::to_value(&self)? else { return Ok(self) };
        self.sha256_of_parts = parts(&content);
        let listed = self.sha256_of_parts.iter();
        let listed = listed.map(|(name, of)| (name.clone(), Value::from(of.as_str())));
        content.insert(PARTS.to_owned(), Value::Object(listed.collect()));
        self.sha256 = Some(digest(&content));
        Ok(self)
    }
}

/// The digest of an object without its own digest, in hexadecimal.
pub(crate) fn digest(content: &Map<String, Value>) -> String {
    let mut canonical = String::new();
    object(content.iter().filter(|(key, _)| *key != DIGEST).collect(), &mut canonical);
    sha256(canonical.as_bytes())
}

/// The parts of a saved result with their digests, each named by its keys separated by `/`: every
/// key of the root, every key of each entry of `outputs`, and each entry of `inputs`.
fn parts(content: &Map<String, Value>) -> Vec<(String, String)> {
    let mut all = Vec::new();
    let mut add = |name: String, value: &Value| {
        let mut canonical = String::new();
        write(value, &mut canonical);
        let mut digest = sha256(canonical.as_bytes());
        digest.truncate(SHORT);
        all.push((name, digest));
    };
    for (key, value) in content {
        match (key.as_str(), value) {
            (DIGEST | PARTS, _) => {}
            ("outputs", Value::Object(outputs)) => {
                for (name, output) in outputs {
                    match output {
                        Value::Object(fields) => fields
                            .iter()
                            .for_each(|(field, value)| add(format!("{key}/{name}/{field}"), value)),
                        other => add(format!("{key}/{name}"), other),
                    }
                }
            }
            ("inputs", Value::Array(inputs)) => inputs
                .iter()
                .enumerate()
                .for_each(|(number, input)| add(format!("{key}/{number}"), input)),
            _ => add(key.clone(), value),
        }
    }
    all
}

/// The parts whose digests do not match: changed, missing, or new.
pub(super) fn changed(content: &Map<String, Value>) -> Vec<String> {
    let Some(Value::Object(stated)) = content.get(PARTS) else { return Vec::new() };
    let found = parts(content);
    let differs = |(name, digest): &&(String, String)| {
        stated.get(name) != Some(&Value::from(digest.as_str()))
    };
    let mut names: Vec<String> =
        found.iter().filter(differs).map(|(name, _)| name.clone()).collect();
    let gone = stated.keys().filter(|name| !found.iter().any(|(other, _)| other == *name));
    names.extend(gone.cloned());
    names
}

/// A value as canonical text: keys in the order of their characters, numbers by their values.
fn write(value: &Value, out: &mut String) {
    match value {
        Value::Object(members) => object(members.iter().collect(), out),
        Value::Array(items) => {
            out.push('[');
            for item in items {
                write(item, out);
                out.push(',');
            }
            out.push(']');
        }
        Value::Number(number) => match (number.as_u64(), number.as_f64()) {
            (Some(whole), _) => *out += &whole.to_string(),
            (None, Some(value)) => *out += &canonical(value),
            (None, None) => *out += &number.to_string(),
        },
        // a quoted text with escapes
        other => *out += &other.to_string(),
    }
}

/// A number that is not written as an integer; 5.0 is 5.
fn canonical(value: f64) -> String {
    const WHOLE: f64 = 9_007_199_254_740_992.0;
    if value.fract() == 0.0 && value.abs() <= WHOLE {
        (value as i64).to_string()
    } else {
        format!("{value:e}")
    }
}

fn object(mut members: Vec<(&String, &Value)>, out: &mut String) {
    members.sort_by_key(|(key, _)| *key);
    out.push('{');
    for (key, value) in members {
        *out += &Value::from(key.as_str()).to_string();
        out.push(':');
        write(value, out);
        out.push(',');
    }
    out.push('}');
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Map<String, Value> {
        match serde_json::from_str(text).unwrap() {
            Value::Object(content) => content,
            other => panic!("{other}"),
        }
    }

    #[test]
    fn what_is_said_counts_and_not_how() {
        let first =
            read(r#"{"a": [1, 5.0, 1e-3, 18446744073709551615], "b": {"x": null, "y": "ä"}}"#);
        let same = read(r#"{"b":{"y":"\u00e4","x":null},"a":[1.0,5,0.001,18446744073709551615]}"#);
        assert_eq!(digest(&first), digest(&same));
        let own = read(
            r#"{"sha256": "x", "a": [1, 5, 0.001, 18446744073709551615],
            "b": {"x": null, "y": "ä"}}"#,
        );
        assert_eq!(digest(&first), digest(&own));
        for other in [
            r#"{"a": [1, 5, 0.001, 18446744073709551614], "b": {"x": null, "y": "ä"}}"#,
            r#"{"a": [5, 1, 0.001, 18446744073709551615], "b": {"x": null, "y": "ä"}}"#,
            r#"{"a": [1, 5, 0.001, 18446744073709551615], "b": {"x": 0, "y": "ä"}}"#,
            r#"{"a": [1, 5, 0.001, 18446744073709551615], "b": {"x": null, "y": "a"}}"#,
            r#"{"a": [1, 5, 0.001, 18446744073709551615], "b": {"x": null}}"#,
        ] {
            assert_ne!(digest(&first), digest(&read(other)), "{other}");
        }
    }

    /// The reference is another implementation: Python's `json` and `hashlib`.
    #[test]
    fn the_digest_is_what_others_compute() {
        let mut content = read(
            r#"{"format": 1,
            "result": true,
            "title": "A voltage",
            "outputs": {"y": {"unit": "V",
            "estimate": 5,
            "standard_uncertainty": 0.2,
            "standard_deviation": 0.2,
            "sensitivities": [2],
            "quantiles": [4, 5, 6]}},
            "scores": {"from": -5,
            "step": 5,
            "count": 3},
            "inputs": [{"model_sha256": "0",
            "name": "x",
            "estimate": 1,
            "standard_uncertainty": 0.1,
            "dof": null}],
            "provenance": {"model_sha256": "0"}}"#,
        );
        let listed = parts(&content).into_iter().map(|(name, of)| (name, Value::from(of)));
        let listed: Map<String, Value> = listed.collect();
        let expected = "e77105a187b67e83";
        assert_eq!(listed["outputs/y/quantiles"], expected);
        content.insert(PARTS.to_owned(), Value::Object(listed));
        let expected = "8f4d815447e27aa3179ad46e6dc9ee4f5685d41c0baad20f547527ba53f40b6b";
        assert_eq!(digest(&content), expected);
    }

    #[test]
    fn the_parts_that_were_changed_are_named() {
        let mut content = read(
            r#"{"title": "t", "outputs": {"y": {"estimate": 1, "unit": "V"}}, "inputs": [{"a": 1}, {"b": 2}]}"#,
        );
        let stated = parts(&content).into_iter().map(|(name, of)| (name, Value::from(of)));
        let stated: Map<String, Value> = stated.collect();
        content.insert(PARTS.to_owned(), Value::Object(stated));
        assert!(changed(&content).is_empty());
        content["outputs"]["y"]["estimate"] = 2.into();
        content["inputs"][1]["b"] = 3.into();
        content.insert("new".to_owned(), 1.into());
        content.remove("title");
        let mut found = changed(&content);
        found.sort();
        assert_eq!(found, ["inputs/1", "new", "outputs/y/estimate", "title"]);
    }
}
