//! The command line as a value.

use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use gumption_command::{Answered, Failure, GivenFile};
use gumption_engine::model::typed::{CatalogueEntry, Measurement};
use gumption_files::FileReader;

use crate::{published, templates};

/// The command line `gumption` with the built-in measurements, to which a program of one's own adds
/// its own: files then name them, and every command and format has them.
///
/// ```no_run
#[doc = include_str!("../examples/own_program.rs")]
/// ```
#[derive(Clone, Debug)]
pub struct Application(gumption_command::CommandLine);

impl Default for Application {
    fn default() -> Self {
        Self::new()
    }
}

impl Application {
    /// The command line with the built-in measurements.
    pub fn new() -> Self {
        let catalogue = templates::catalogue().clone();
        Self(gumption_command::CommandLine::new(catalogue, published::EXAMPLES))
    }

    /// The same with one more measurement; `template` is a model file of it, which `models NAME
    /// --template` prints. A measurement of the name of another takes its place.
    #[must_use]
    pub fn measurement<M: Measurement>(self, template: &'static str) -> Self {
        self.with(CatalogueEntry::of::<M>().template(template))
    }

    /// The same with one more measurement as an entry of the catalogue, which may leave units free
    /// ([`CatalogueEntry::any_unit`]).
    #[must_use]
    pub fn with(self, entry: CatalogueEntry) -> Self {
        Self(self.0.with(entry))
    }

    /// What is behind it, for programs that show its answers themselves.
    pub fn command_line(&self) -> &gumption_command::CommandLine {
        &self.0
    }

    /// The readers of files that may name its measurements.
    pub fn files(&self) -> FileReader<'_> {
        self.0.files()
    }

    /// Runs a command as a function, without the process's streams and signals; see
    /// [`CommandLine::call`](gumption_command::CommandLine::call). `input` stands for `-`, and `stop`
    /// does what a signal does.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// use gumption::Application;
    ///
    /// let arguments = ["run", "models/inclined_plane.json", "--trials", "0", "--format", "csv"];
    /// let answered = Application::new()
    ///     .call(arguments.map(Into::into), None, Default::default())
    ///     .map_err(|failure| failure.to_string())?;
    /// assert_eq!(String::from_utf8(answered.answer)?.lines().count(), 4);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// What the program would say on standard error with the exit codes 1 and 2.
    pub fn call(
        &self,
        arguments: impl IntoIterator<Item = OsString>,
        input: Option<GivenFile>,
        stop: Arc<AtomicBool>,
    ) -> Result<Answered, Failure> {
        self.0.call(arguments, input, stop)
    }

    /// As [`Application::main`] with these arguments, the first of which is the program's name.
    pub fn main_of(&self, arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
        self.0.main_of(arguments)
    }

    /// Runs with the arguments of the process; what it prints goes to standard output and standard
    /// error. The exit code is 0 when all is done, 1 if the system is at fault, 2 if arguments or
    /// files are, 3 if the answer is "no" where `--fail` was given, 130 if it was interrupted.
    pub fn main(&self) -> ExitCode {
        self.0.main()
    }
}
