//! `gumption models`

mod effects;
mod examples;

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use comfy_table::{ContentArrangement, Table, presets};

use super::options::Format;
use super::output::AnswerPlace;
use super::{CommandLine, Exit, Failure, did_you_mean, output};
use gumption_engine::model::typed::{Catalogue, CatalogueEntry};
use gumption_units::all_nearest;

/// List the typed measurement models, or describe one.
#[derive(Debug, Args)]
pub(super) struct Models {
    /// A model to describe; with --effects the effect, with --examples the example
    name: Option<String>,
    /// Print a model file for it, ready to fill in
    #[arg(long, requires = "name")]
    template: bool,
    /// List the effects that a gap case can name in its `catalogue`
    #[arg(long, conflicts_with = "template")]
    effects: bool,
    /// List the published measurements included in the program, or print the model file of one
    #[arg(long, conflicts_with_all = ["template", "effects"])]
    examples: bool,
    /// Format of the answer; json with --effects only
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// Write the answer to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Models {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], &[])?;
        let text = match &self.name {
            name if self.effects => {
                let listing = effects::named(name.as_deref())?;
                match self.format {
                    Format::Table => effects::page(&listing),
                    Format::Json => gumption_report::pretty(&listing),
                    Format::Csv => {
                        let message = "`models --effects` answers as table or json";
                        return Err(Failure::Argument(message.into()));
                    }
                }
            }
            _ if self.format != Format::Table => {
                let message = "`models` answers as table; in json with --effects only";
                return Err(Failure::Argument(message.into()));
            }
            name if self.examples => examples::named(&program.published, name.as_deref())?,
            None => list(&program.catalogue),
            Some(name) => match program.catalogue.find(name) {
                Some(entry) if self.template => match entry.template {
                    Some(template) => template.to_owned(),
                    None => {
                        let message = format!("there is no template of `{name}`");
                        return Err(Failure::Argument(message));
                    }
                },
                Some(entry) => describe(entry),
                None => return Err(unknown(&program.catalogue, name)),
            },
        };
        file.map_or(AnswerPlace::StandardOutput, AnswerPlace::File).write(&text)?;
        Ok(Exit::Done)
    }
}

fn unknown(catalogue: &Catalogue, name: &str) -> Failure {
    let near = all_nearest(name, catalogue.iter().map(CatalogueEntry::name));
    let hint = did_you_mean(&near).unwrap_or_else(|| "`gumption models` lists them".to_owned());
    Failure::Argument(format!("there is no typed model `{name}`; {hint}"))
}

/// A doc text for a page: without indentation, and links as their text.
fn plain(about: &str) -> String {
    let lines: Vec<&str> = about.trim().lines().map(str::trim).collect();
    let mut text = String::new();
    let whole = lines.join("\n");
    let mut rest = whole.as_str();
    while let Some((before, after)) = rest.split_once("[`") {
        text.push_str(before);
        let (name, after) = after.split_once("`]").unwrap_or((after, ""));
        text.push_str(name);
        let target = after.strip_prefix('(').and_then(|target| target.split_once(')'));
        rest = target.map_or(after, |(_, after)| after);
    }
    text.push_str(rest);
    text.replace('`', "")
}

/// The first paragraph of a doc text, on one line.
fn headline(about: &str) -> String {
    one_line(plain(about).split("\n\n").next().unwrap_or(""))
}

/// A table as text, without blanks at the ends of lines.
fn render(table: &Table) -> String {
    table.to_string().lines().map(|line| line.trim_end().to_owned() + "\n").collect()
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
    wrapped_to(paragraph, 100)
}

/// On lines of at most `longest` characters, unless a word is longer.
fn wrapped_to(paragraph: &str, longest: usize) -> String {
    let mut text = String::new();
    let mut width = 0;
    for word in one_line(paragraph).split(' ') {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > longest {
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

fn list(catalogue: &Catalogue) -> String {
    let mut table = plain_table();
    for entry in catalogue {
        let declaration = entry.typed.declaration;
        table.add_row([declaration.name.to_owned(), headline(declaration.about)]);
    }
    render(&table)
}

fn describe(entry: &CatalogueEntry) -> String {
    let declaration = entry.typed.declaration;
    let mut text = format!("{}\n\n", declaration.name);
    for paragraph in plain(declaration.about).split("\n\n") {
        let _ = writeln!(text, "{}\n", wrapped(paragraph));
    }
    let _ = writeln!(text, "{}\n", wrapped(&format!("Source: {}", declaration.source)));
    let mut inputs = plain_table();
    inputs.set_header(["input", "unit", "default", "description"]);
    for input in declaration.inputs {
        let default = match input.default {
            None => "required".to_owned(),
            Some(value) if value.is_infinite() => "absent".to_owned(),
            Some(value) => value.to_string(),
        };
        let unit = unit(input.unit, entry.any_unit.contains(&input.name));
        inputs.add_row([input.name.to_owned(), unit, default, one_line(&plain(input.about))]);
    }
    let _ = writeln!(text, "{}", render(&inputs));
    let mut outputs = plain_table();
    outputs.set_header(["output", "unit", "equation", "description"]);
    for output in declaration.outputs {
        let mut unit = unit(output.unit, entry.any_unit.contains(&output.name));
        if let Some(period) = output.period {
            let _ = write!(unit, ", periodic {period}");
        }
        let about = one_line(&plain(output.about));
        outputs.add_row([output.name.to_owned(), unit, output.equation.to_owned(), about]);
    }
    let _ = writeln!(text, "{}", render(&outputs));
    if entry.template.is_some() {
        let name = declaration.name;
        let _ = writeln!(text, "A file to start from: gumption models {name} --template");
    }
    text
}

fn unit(declared: &str, any: bool) -> String {
    if any { "any".to_owned() } else { declared.to_owned() }
}
