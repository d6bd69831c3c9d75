//! The definition of the command line with its help: options in groups, commands in groups, and
//! examples.

mod command_groups;
mod examples;
mod heading;
mod option_groups;
#[cfg(test)]
mod tests;

use std::ffi::OsString;

use clap::{CommandFactory, FromArgMatches};

use super::Arguments;
use heading::heading;
pub(super) use option_groups::REST;

/// The whole command line, for help, completions and man pages.
pub(super) fn definition() -> clap::Command {
    let program = Arguments::command();
    let groups = command_groups::text(&program);
    program
        .help_template(format!(
            "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{{before-help}}{}{{options}}\
             {{after-help}}",
            heading("Options")
        ))
        .before_help(groups)
        .mut_subcommands(|command| examples::added_to(option_groups::arranged(command)))
}

/// The parsed arguments; the first one is the name of the program.
///
/// # Errors
/// The message about wrong arguments, or the text of `--help` or `--version`.
pub(super) fn parsed(
    arguments: impl IntoIterator<Item = OsString>,
) -> Result<Arguments, clap::Error> {
    let mut program = definition();
    let matches = program.try_get_matches_from_mut(arguments)?;
    Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut program))
}
