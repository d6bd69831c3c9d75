//! What the page is answered: by the commands that there are, called as functions.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use super::files_of_page;
use crate::output::Destination;
use crate::{Answered, CommandLine, Exit, Failure, GivenFile};
use gumption_engine::task::{Task, Trials};
use gumption_files::{FileSource, TextKind};
use gumption_live::LiveError;
use gumption_server::{
    Answers, Exported, FileDescription, NamedFiles, Refusal, ServedAsset, TextOfFile,
};

/// Trials in all rows that an export makes, at most: minutes on a usual machine.
const MOST_TRIALS: u64 = 2_000_000_000;

/// Idle pools of threads that are kept for later, at most.
const KEPT_POOLS: usize = 2;

/// The answers of this program.
pub(super) struct PageAnswers {
    program: CommandLine,
    assets: Vec<ServedAsset>,
    pools: Mutex<Vec<rayon::ThreadPool>>,
}

impl PageAnswers {
    pub(super) fn new(program: CommandLine) -> Self {
        Self { program, assets: files_of_page::all(), pools: Mutex::default() }
    }

    /// Does work in a pool of threads that nobody else works in: within one, the jobs of a short piece
    /// of work would come after those of a long one.
    fn in_own_pool<R: Send>(
        &self,
        work: impl FnOnce() -> Result<R, Refusal> + Send,
    ) -> Result<R, Refusal> {
        let pools = || self.pools.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = pools().pop();
        let pool = match kept {
            Some(pool) => pool,
            None => rayon::ThreadPoolBuilder::new()
                .build()
                .map_err(|error| Refusal::Internal(format!("cannot start threads: {error}")))?,
        };
        let done = pool.install(work);
        let mut pools = pools();
        if pools.len() < KEPT_POOLS {
            pools.push(pool);
        }
        done
    }

    /// A command about a text.
    fn command(
        &self,
        file: &TextOfFile,
        arguments: &[&str],
        stop: &Arc<AtomicBool>,
    ) -> Result<Answered, Refusal> {
        let TextOfFile { path, text, folder } = file.clone();
        let given = GivenFile { name: path, text, folder, held: Vec::new() };
        let arguments: Vec<OsString> = arguments.iter().map(OsString::from).collect();
        let answered = self.in_own_pool(|| {
            let called = self.program.call(arguments, Some(given), Arc::clone(stop));
            called.map_err(|failure| match failure {
                Failure::System(_) => Refusal::Internal(failure.to_string()),
                _ => Refusal::Content(failure.to_string()),
            })
        })?;
        if answered.exit == Exit::Interrupted {
            let message = "it was stopped before it was done: it takes longer than the page waits, \
                           and not on the command line";
            return Err(Refusal::Stopped(message.to_owned()));
        }
        Ok(answered)
    }

    /// Whether the trials that a text asks for can be made while somebody waits.
    fn check_trials(&self, file: &TextOfFile, kind: TextKind) -> Result<(), Refusal> {
        let TextOfFile { path, text, folder } = file;
        let files = self.program.files();
        let task = |task: &Task| match task.settings.trials {
            Trials::Fixed(trials) => trials.saturating_mul(task.rows.len() as u64),
            Trials::Adaptive => 0,
        };
        // the mistakes of a text are told by what is done with it
        let asked: u64 = match kind {
            TextKind::Model => {
                files.model_text(path, text, folder, &[]).map_or(0, |file| task(&file.task))
            }
            TextKind::Case => {
                files.case_text(path, text, folder).map_or(0, |file| task(&file.case.task))
            }
            TextKind::Certificate => files.certificate_text(path, text, folder).map_or(0, |file| {
                let tasks = file.certificate.evaluations.iter();
                tasks.map(|asked| task(&asked.task)).fold(0, u64::saturating_add)
            }),
            _ => 0,
        };
        if asked <= MOST_TRIALS {
            return Ok(());
        }
        Err(Refusal::Content(format!(
            "{path}: {asked:.1e} trials are asked for, and the page makes at most {most:.0e}; take \
             fewer, or use the command line",
            asked = asked as f64,
            most = MOST_TRIALS as f64,
        )))
    }
}

/// The command that evaluates a text.
fn command_of(kind: TextKind) -> Result<&'static str, Refusal> {
    Ok(match kind {
        TextKind::Model => "run",
        TextKind::Case => "gap",
        TextKind::Certificate => "certificate",
        TextKind::Recipe => "observe",
        TextKind::Comparison => "compare",
        _ => {
            let message = "there is nothing to be evaluated in this file: it is neither a model nor a \
                           case, a certificate, a recipe or a table of results";
            return Err(Refusal::Content(message.to_owned()));
        }
    })
}

/// The files that a text of the page names, for its readers.
#[derive(Debug)]
struct Named<'a>(&'a NamedFiles<'a>);

impl FileSource for Named<'_> {
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String> {
        self.0.content(name, most).map_err(|error| error.to_string())
    }
}

/// Formats by the commands' names for them, with extension and media type.
const FORMATS: [(&str, &str, &str); 9] = [
    ("table", "txt", "text/plain; charset=utf-8"),
    ("json", "json", "application/json"),
    ("csv", "csv", "text/csv; charset=utf-8"),
    ("markdown", "md", "text/markdown; charset=utf-8"),
    ("latex", "tex", "application/x-tex; charset=utf-8"),
    ("html", "html", "text/html; charset=utf-8"),
    ("xlsx", "xlsx", "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"),
    ("dcc", "xml", "application/xml"),
    ("result", "result.json", "application/json"),
];

/// A file's name without folder and extension.
fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

impl Answers for PageAnswers {
    fn version(&self) -> &str {
        env!("CARGO_PKG_VERSION")
    }

    fn assets(&self) -> &[ServedAsset] {
        &self.assets
    }

    fn call(
        &self,
        name: &str,
        request: &str,
        files: &NamedFiles<'_>,
        stop: &Arc<AtomicBool>,
    ) -> Result<String, Refusal> {
        self.in_own_pool(|| {
            let called = self.program.live().call(name, request, &Named(files), stop);
            called.map_err(|error| {
                let message = error.to_string();
                match error {
                    LiveError::Unknown(_) => Refusal::Unknown(message),
                    LiveError::Request(_) => Refusal::Request(message),
                    _ => Refusal::Internal(message),
                }
            })
        })
    }

    fn describe(&self, _name: &str, content: &[u8]) -> FileDescription {
        let text = String::from_utf8_lossy(content);
        let title = serde_json::from_str::<serde_json::Value>(&text).ok();
        let title = title.and_then(|root| root.get("title")?.as_str().map(str::to_owned));
        FileDescription { kind: TextKind::of(&text).name(), title }
    }

    fn export(
        &self,
        file: &TextOfFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Exported, Refusal> {
        let Some((_, extension, content_type)) = FORMATS.iter().find(|(name, ..)| *name == format)
        else {
            let names = FORMATS.map(|(name, ..)| name).join(", ");
            let message = format!("there is no format `{format}`; there are {names}");
            return Err(Refusal::Request(message));
        };
        let kind = TextKind::of(&file.text);
        let command = command_of(kind)?;
        self.check_trials(file, kind)?;
        let content = if format == "result" {
            self.saved_result(file, command, stop)?
        } else {
            self.command(file, &[command, "-", "--format", format], stop)?.answer
        };
        let name = format!("{}.{extension}", stem(&file.path));
        Ok(Exported { content, content_type, name })
    }

    fn page(&self, file: &TextOfFile, stop: &Arc<AtomicBool>) -> Result<String, Refusal> {
        let kind = TextKind::of(&file.text);
        let command = command_of(kind)?;
        self.check_trials(file, kind)?;
        let answered = self.command(file, &[command, "-", "--format", "html"], stop)?;
        String::from_utf8(answered.answer).map_err(|error| Refusal::Internal(error.to_string()))
    }

    fn replace(&self, path: &Path, content: &[u8]) -> io::Result<()> {
        let written = Destination::open(path)
            .and_then(|file| file.write_with(|out| out.write_all(content).map(|()| true)));
        written.map_err(|failure| io::Error::other(failure.to_string()))
    }
}

impl PageAnswers {
    /// The result file of a model.
    fn saved_result(
        &self,
        file: &TextOfFile,
        command: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Vec<u8>, Refusal> {
        let internal = |error: io::Error| Refusal::Internal(error.to_string());
        let folder = tempfile::tempdir().map_err(internal)?;
        let path = folder.path().join("result.json");
        let Some(name) = path.to_str() else {
            let message = "the folder for temporary files has a name that is not UTF-8";
            return Err(Refusal::Internal(message.to_owned()));
        };
        self.command(file, &[command, "-", "--format", "json", "--save", name], stop)?;
        std::fs::read(&path).map_err(internal)
    }
}
