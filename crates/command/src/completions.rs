//! `gumption completions`

use clap::Args;
use clap_complete::Shell;

use super::definition::definition;
use super::output::AnswerPlace;
use super::{Exit, Failure};

/// Print a script that completes commands and options in a shell.
///
/// bash: add `source <(gumption completions bash)` to ~/.bashrc.
///
/// zsh: write the script to a file `_gumption` in a folder of $fpath.
///
/// fish: write it to ~/.config/fish/completions/gumption.fish.
///
/// PowerShell: add `gumption completions powershell | Out-String | Invoke-Expression` to $PROFILE.
#[derive(Debug, Args)]
pub(super) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let mut program = definition();
        let name = program.get_name().to_owned();
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, name, &mut script);
        AnswerPlace::StandardOutput.write_with(|out| out.write_all(&script))?;
        Ok(Exit::Done)
    }
}
