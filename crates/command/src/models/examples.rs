//! `gumption models --examples`: published measurements included in the program, as starting
//! points.

use gumption_units::nearest;
use serde::Deserialize;

use super::super::{Failure, PublishedExamples};
use super::one_line;

/// An example in a list.
#[derive(Deserialize)]
struct Sourced {
    #[serde(default)]
    title: String,
    #[serde(default)]
    source: Option<String>,
}

/// The list of examples, or the model file of one.
///
/// # Errors
/// No example has this name.
pub(super) fn named(published: &PublishedExamples, name: Option<&str>) -> Result<String, Failure> {
    let Some(name) = name else { return list(published) };
    let models = published.starting_points();
    match models.clone().find(|(of, _)| *of == name) {
        Some((_, model)) => Ok(model.to_owned()),
        None => {
            let hint = match nearest(name, models.map(|(of, _)| of)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`gumption models --examples` lists them".to_owned(),
            };
            Err(Failure::Argument(format!("there is no example `{name}`; {hint}")))
        }
    }
}

fn list(published: &PublishedExamples) -> Result<String, Failure> {
    let mut text = String::from("Published measurements, each as a model file to start from:\n\n");
    let widest = published.starting_points().map(|(name, _)| name.len()).max().unwrap_or(0);
    let values = published.with_values().map_err(Failure::System)?;
    for (name, _) in published.cases {
        let of = values.iter().find(|example| example.name == *name);
        let source = of.map_or("", |example| &example.source);
        text += &format!("{name:<widest$}  {}\n", one_line(source));
    }
    if !published.more.is_empty() {
        text += "\nMeasurements from their raw data, and budgets of a laboratory's daily work:\n\n";
    }
    for (name, model) in published.more {
        let Sourced { title, source } = serde_json::from_str(model)
            .map_err(|error| Failure::System(format!("{name}: {error}")))?;
        let source = source.map_or_else(String::new, |source| format!(" ({})", one_line(&source)));
        text += &format!("{name:<widest$}  {}{source}\n", one_line(&title));
    }
    Ok(text + "\n`gumption models --examples NAME` prints one, `--output FILE` writes it.\n")
}
