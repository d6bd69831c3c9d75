//! `gumption man`

use std::path::PathBuf;

use clap::Args;
use clap_mangen::Man;

use super::definition::definition;
use super::output::Destination;
use super::{Exit, Failure};
use gumption_report::plain;

/// Write the man pages of all commands to a folder.
///
/// The pages are gumption.1, and one page for each command, such as gumption-run.1. In a folder man1
/// below a folder of $MANPATH, such as ~/.local/share/man/man1, `man gumption-run` finds them.
#[derive(Debug, Args)]
pub(super) struct ManPages {
    /// The folder, which must exist
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl ManPages {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        if !self.folder.is_dir() {
            let name = plain(&self.folder.display().to_string());
            return Err(Failure::Argument(format!("there is no folder `{name}`; make it first")));
        }
        let mut program = definition();
        // gives the commands their options of the whole program, and their full names
        program.build();
        let commands: Vec<clap::Command> = program.get_subcommands().cloned().collect();
        for command in std::iter::once(program).chain(commands) {
            let page = Man::new(command);
            let path = self.folder.join(page.get_filename());
            Destination::open(&path)?.write_with(|mut out| page.render(&mut out).map(|()| true))?;
        }
        Ok(Exit::Done)
    }
}
