//! `gumption models --examples`: the published measurements that the program carries, to start from.

use gumption_units::nearest;
use serde::Deserialize;

use super::super::{Failure, PublishedExamples};
use super::one_line;

/// What a list tells of an example.
#[derive(Deserialize)]
struct Sourced {
    source: String,
}

/// The list of examples, or the model file of one.
///
/// # Errors
/// A name that no example has.
pub(super) fn named(published: &PublishedExamples, name: Option<&str>) -> Result<String, Failure> {
    let Some(name) = name else { return list(published) };
    match published.cases.iter().find(|(of, ..)| *of == name) {
        Some((_, model, _)) => Ok((*model).to_owned()),
        None => {
            let hint = match nearest(name, published.cases.iter().map(|(of, ..)| *of)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`gumption models --examples` lists them".to_owned(),
            };
            Err(Failure::Argument(format!("there is no example `{name}`; {hint}")))
        }
    }
}

fn list(published: &PublishedExamples) -> Result<String, Failure> {
    let mut text = String::from("Published measurements, each as a model file to start from:\n\n");
    let widest = published.cases.iter().map(|(name, ..)| name.len()).max().unwrap_or(0);
    for (name, _, expected) in published.cases {
        let of: Sourced = serde_json::from_str(expected)
            .map_err(|error| Failure::System(format!("{name}: {error}")))?;
        text += &format!("{name:<widest$}  {}\n", one_line(&of.source));
    }
    Ok(text + "\n`gumption models --examples NAME` prints one, `--output FILE` writes it.\n")
}
