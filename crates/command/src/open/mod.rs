//! `gumption open`

mod answers;
mod browser;
mod files_of_page;
mod static_page;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::exit::say;
use super::surroundings::in_call;
use super::{CommandLine, Exit, Failure, internal_error, signals};
use answers::PageAnswers;
use gumption_columns::read_failure;
use gumption_report::plain;
use gumption_server::{LocalServer, OpenedFolder, RequestTimes, ServerOptions};

/// Edit a file or folder on a page in the browser, with results while you type.
///
/// A server on this machine (127.0.0.1) provides the page. It reads and writes only files of the
/// folder; the address contains a secret, so that other users and other sites have no access.
/// Ctrl-C ends it.
#[derive(Debug, Args)]
pub(super) struct Open {
    /// The file to show, whose folder is opened, or the folder
    #[arg(value_name = "FILE or FOLDER", default_value = ".")]
    path: PathBuf,
    /// Port of the server [default: a free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Print the address without opening the browser
    #[arg(long)]
    no_browser: bool,
    /// Language of the page [default: that of the browser]
    #[arg(long, value_name = "de|en", hide_possible_values = true)]
    lang: Option<Language>,
    /// Write the page as a folder of files that need no server, and exit
    #[arg(long = "static", value_name = "DIR", conflicts_with_all = ["port", "no_browser", "lang"])]
    folder: Option<PathBuf>,
    /// The program for that page, as built by `page/build-wasm.sh`
    #[arg(long, value_name = "FILE", requires = "folder")]
    wasm: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Language {
    De,
    En,
}

impl Language {
    fn tag(self) -> &'static str {
        match self {
            Self::De => "de",
            Self::En => "en",
        }
    }
}

impl Open {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        if let Some(folder) = &self.folder {
            return static_page::write(folder, self.wasm.as_deref());
        }
        if in_call(|_| ()).is_some() {
            let reason = "`open` runs until a signal ends it, and cannot be called as a function";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let folder = OpenedFolder::new(&self.path).map_err(|error| self.unopened(&error))?;
        let stop = signals::stop_flag();
        let server = LocalServer::bind(ServerOptions {
            port: self.port,
            folder,
            language: self.lang.map(Language::tag),
            answers: Arc::new(PageAnswers::new(program.clone())),
            times: RequestTimes::default(),
        });
        let server = server.map_err(|error| self.unbound(&error))?;
        print_line(&server.address())?;
        if !self.no_browser
            && let Err(reason) = browser::open(&server.launch_address())
        {
            say(&format!("note: {reason}; open the address in a browser\n"));
        }
        say("note: Ctrl-C ends the server\n");
        internal_error::leave_to_server();
        server.run(&stop).map_err(|error| Failure::System(format!("the server: {error}")))?;
        Ok(Exit::Done)
    }

    fn unopened(&self, error: &io::Error) -> Failure {
        let reason = read_failure::of_file(&self.path, error);
        Failure::Argument(format!("`{}`: {reason}", shown(&self.path)))
    }

    fn unbound(&self, error: &io::Error) -> Failure {
        let hint = match (self.port, error.kind()) {
            (0, _) => "",
            (_, io::ErrorKind::AddrInUse) => {
                "; another program uses it: without `--port` a free one is chosen"
            }
            (_, io::ErrorKind::PermissionDenied) => "; use a port from 1024 on",
            _ => "",
        };
        let port = if self.port == 0 { String::new() } else { format!(" {}", self.port) };
        Failure::System(format!("cannot use port{port} of 127.0.0.1: {error}{hint}"))
    }
}

fn shown(path: &Path) -> String {
    plain(&path.display().to_string())
}

/// Prints the address of the page, at once even if standard output is a pipe.
fn print_line(line: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let written = writeln!(out, "{line}").and_then(|()| out.flush());
    written.map_err(|error| Failure::System(format!("cannot print the address: {error}")))
}
