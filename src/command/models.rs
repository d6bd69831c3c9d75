//! `gumption models`

use std::fmt::Write;

use clap::Args;
use comfy_table::{ContentArrangement, Table, presets};

use super::{Exit, Failure, output};
use crate::file::nearest;
use crate::model::typed::{self, Entry};

/// List the typed models or describe one.
#[derive(Debug, Args)]
pub(super) struct Models {
    /// A model to describe
    name: Option<String>,
    /// Print a model file of it, ready to fill in
    #[arg(long, requires = "name")]
    template: bool,
}

impl Models {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let text = match &self.name {
            None => list(&typed::all()),
            Some(name) => match typed::find(name) {
                Some(entry) if self.template => entry.example.to_owned(),
                Some(entry) => describe(&entry),
                None => return Err(unknown(name)),
            },
        };
        output::write(&text, None)?;
        Ok(Exit::Done)
    }
}

fn unknown(name: &str) -> Failure {
    let known = typed::all();
    let hint = match nearest(name, known.iter().map(|e| e.typed.declaration.name)) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`gumption models` lists those that there are".to_owned(),
    };
    Failure::Argument(format!("there is no typed model `{name}`; {hint}"))
}

/// The first sentence or line of a doc text.
fn headline(about: &str) -> &str {
    about.trim().split("\n\n").next().unwrap_or("").trim()
}

fn plain_table() -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(100);
    table
}

/// On one line, and links of the documentation as names.
fn one_line(text: &str) -> String {
    let plain = text.replace("[`", "`").replace("`]", "`");
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// On lines of at most 100 characters.
fn wrapped(paragraph: &str) -> String {
    let mut text = String::new();
    let mut width = 0;
    for word in one_line(paragraph).split(' ') {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > 100 {
            text.push('\n');
            width = 0;
        } else if width > 0 {
            text.push(' ');
            width += 1;
        }
        text.push_str(word);
        width += length;
    }
    text
}

fn list(entries: &[Entry]) -> String {
    let mut table = plain_table();
    for entry in entries {
        let declaration = entry.typed.declaration;
        table.add_row([declaration.name.to_owned(), one_line(headline(declaration.about))]);
    }
    format!("{table}\n")
}

fn describe(entry: &Entry) -> String {
    let declaration = entry.typed.declaration;
    let mut text = format!("{}\n\n", declaration.name);
    for paragraph in declaration.about.trim().split("\n\n") {
        let _ = writeln!(text, "{}\n", wrapped(paragraph));
    }
    let _ = writeln!(text, "{}\n", wrapped(&format!("Source: {}", declaration.source)));
    let mut inputs = plain_table();
    inputs.set_header(["input", "unit", "default", "what it is"]);
    for input in declaration.inputs {
        let default = match input.default {
            None => "required".to_owned(),
            Some(value) if value.is_infinite() => "absent".to_owned(),
            Some(value) => value.to_string(),
        };
        let unit = unit(input.unit, entry.any_unit.contains(&input.name));
        inputs.add_row([input.name.to_owned(), unit, default, one_line(input.about)]);
    }
    let _ = writeln!(text, "{inputs}\n");
    let mut outputs = plain_table();
    outputs.set_header(["output", "unit", "equation", "what it is"]);
    for output in declaration.outputs {
        let mut unit = unit(output.unit, entry.any_unit.contains(&output.name));
        if let Some(period) = output.period {
            let _ = write!(unit, ", periodic {period}");
        }
        let about = one_line(output.about);
        outputs.add_row([output.name.to_owned(), unit, output.equation.to_owned(), about]);
    }
    let _ = writeln!(text, "{outputs}\n");
    let _ = writeln!(text, "A file to start from: gumption models {} --template", declaration.name);
    text
}

fn unit(declared: &str, any: bool) -> String {
    if any { "any".to_owned() } else { declared.to_owned() }
}
