//! `gumption models --examples`: the published measurements that the program carries, to start from.

use gumption_units::nearest;
use serde::Deserialize;

use super::super::{Failure, PublishedExamples};
use super::{one_line, plain_table, render};

/// What a list tells of a model file.
#[derive(Deserialize)]
struct Titled {
    #[serde(default)]
    title: String,
    #[serde(default)]
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
    let mut table = plain_table();
    table.set_header(["example", "measurement", "source"]);
    for (name, model, _) in published.cases {
        let of: Titled = serde_json::from_str(model)
            .map_err(|error| Failure::System(format!("{name}: {error}")))?;
        table.add_row([(*name).to_owned(), one_line(&of.title), one_line(&of.source)]);
    }
    Ok(render(&table)
        + "\nPrint one with `gumption models --examples NAME`, write it with `--output FILE`.\n")
}
