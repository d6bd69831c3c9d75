//! `gumption help`

use clap::{Args, ValueEnum};

use super::definition::definition;
use super::output::AnswerPlace;
use super::{Exit, Failure};
use gumption_report::reference::{self, Topic};
use gumption_units::nearest;

/// Help on commands, file keys, distributions, functions and units.
#[derive(Debug, Args)]
pub(super) struct Help {
    /// A command, or one of model, distributions, functions, units, case, certificate-file, recipe,
    /// costs, saved-result
    topic: Option<String>,
    /// Format of help on files and formulas
    #[arg(long, value_enum, default_value = "table")]
    format: ReferenceFormat,
}

/// A format of the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReferenceFormat {
    /// A text page
    Table,
    /// A Markdown page, as GitHub shows it
    Markdown,
}

impl Help {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let text = match &self.topic {
            None => overview(),
            Some(name) => match Topic::ALL.into_iter().find(|topic| topic.name() == name) {
                Some(topic) if self.format == ReferenceFormat::Markdown => {
                    reference::markdown(topic)
                }
                Some(topic) => reference::table(topic),
                None => of_command(name)?,
            },
        };
        AnswerPlace::StandardOutput.write(&text)?;
        Ok(Exit::Done)
    }
}

/// The commands, and the other topics below them.
fn overview() -> String {
    let mut text = definition().render_long_help().to_string();
    text += "\nHelp on files and formulas, by `gumption help TOPIC`:\n";
    for topic in Topic::ALL {
        text += &format!("  {:<16}  {}\n", topic.name(), topic.about());
    }
    text
}

fn of_command(name: &str) -> Result<String, Failure> {
    let mut program = definition();
    program.build();
    if let Some(command) = program.find_subcommand_mut(name) {
        return Ok(command.render_long_help().to_string());
    }
    let topics = Topic::ALL.iter().map(|topic| topic.name());
    let commands = program.get_subcommands().map(clap::Command::get_name);
    let near = nearest(name, commands.chain(topics));
    let hint = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`gumption help` lists all topics".to_owned(),
    };
    Err(Failure::Argument(format!("there is no help on `{name}`; {hint}")))
}
