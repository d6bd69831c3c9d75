//! The commands in groups, for the help on the program.

use super::heading::heading;

/// The groups, and the names of their commands.
pub(super) const GROUPS: [(&str, &[&str]); 5] = [
    ("Write a model file", &["new", "open", "models", "import", "readings"]),
    ("Evaluate", &["check", "run", "merge", "assumptions", "plan"]),
    ("Report and compare results", &["certificate", "dcc", "compare", "diff"]),
    ("Work with measured data", &["observe", "gap", "gap-check"]),
    ("Learn and verify", &["help", "verify", "schema", "completions", "man"]),
];

/// The group of the commands that are in no other.
pub(super) const OTHERS: &str = "Further commands";

/// Columns between the margin and the description of a command.
const INDENT: usize = 15;

/// Columns of the text.
const WIDTH: usize = 100;

/// All commands of the program in groups, each with its description.
pub(super) fn text(program: &clap::Command) -> String {
    let groups = GROUPS.iter().map(|(title, names)| {
        let commands = names.iter().filter_map(|name| program.find_subcommand(name));
        (*title, commands.collect::<Vec<_>>())
    });
    let is_grouped = |name: &str| GROUPS.iter().any(|(_, names)| names.contains(&name));
    let others = program.get_subcommands().filter(|command| !is_grouped(command.get_name()));
    let mut text = String::new();
    for (title, commands) in groups.chain([(OTHERS, others.collect())]) {
        if commands.is_empty() {
            continue;
        }
        text += &heading(title);
        commands.into_iter().for_each(|command| text += &line(command));
        text.push('\n');
    }
    text
}

/// A command and its description; further lines of the description stand below its first line.
fn line(command: &clap::Command) -> String {
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let mut text = format!("  {:<width$}", command.get_name(), width = INDENT - 2);
    let mut column = INDENT;
    for (number, word) in about.split_whitespace().enumerate() {
        let length = word.chars().count();
        if number > 0 && column + 1 + length > WIDTH {
            text += &format!("\n{:INDENT$}", "");
            column = INDENT;
        } else if number > 0 {
            text.push(' ');
            column += 1;
        }
        text += word;
        column += length;
    }
    text.push('\n');
    text
}
