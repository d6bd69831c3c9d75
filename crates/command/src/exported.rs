//! Evaluates a text by the matching command, for programs that show or offer the answer.

use std::ffi::OsString;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::{CommandLine, Exit, Failure, GivenFile};
use gumption_engine::task::{Task, Trials};
use gumption_files::TextKind;
use gumption_text::Diagnostics;

/// Maximum number of trials over all rows while a user waits: minutes on a usual machine.
const MOST_TRIALS: u64 = 2_000_000_000;

/// An answer in a format, as a file.
#[derive(Clone, PartialEq, Eq)]
pub struct ExportedAnswer {
    /// The content.
    pub content: Vec<u8>,
    /// The media type.
    pub content_type: &'static str,
    /// The suggested file name.
    pub name: String,
}

impl fmt::Debug for ExportedAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ExportedAnswer({}, {} bytes)", self.name, self.content.len())
    }
}

/// Why there is no answer; the text is for the user.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum NotExported {
    /// There is no such format.
    Format(String),
    /// The text requests too much.
    Content(String),
    /// The errors of the text, or of a file that it names, each with its position.
    Mistakes(Diagnostics),
    /// It was stopped.
    Stopped(String),
    /// The system is at fault.
    System(String),
}

/// Formats by their names in the commands, with extension and media type.
const FORMATS: [(&str, &str, &str); 9] = [
    ("table", "txt", "text/plain; charset=utf-8"),
    ("json", "json", "application/json"),
    ("csv", "csv", "text/csv; charset=utf-8"),
    ("markdown", "md", "text/markdown; charset=utf-8"),
    ("latex", "tex", "application/x-tex; charset=utf-8"),
    ("html", "html", "text/html; charset=utf-8"),
    ("xlsx", "xlsx", "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"),
    ("dcc", "xml", "application/xml"),
    (RESULT, "result.json", "application/json"),
];

/// The format of a result file.
const RESULT: &str = "result";

/// The command that evaluates a text.
fn command_of(kind: TextKind) -> Result<&'static str, NotExported> {
    Ok(match kind {
        TextKind::Model => "run",
        TextKind::Case => "gap",
        TextKind::Certificate => "certificate",
        TextKind::Recipe => "observe",
        TextKind::Comparison => "compare",
        _ => {
            let message = "this file contains nothing to evaluate: it is not a model, a case, a \
                           certificate, a recipe or a table of results";
            return Err(NotExported::Content(message.to_owned()));
        }
    })
}

/// Nothing can be shown of work that was stopped.
pub(super) fn stopped_early() -> NotExported {
    let message = "it was stopped early: it takes longer than the page waits; use the command line, \
                   which has no limit";
    NotExported::Stopped(message.to_owned())
}

/// A file's name without folder and extension.
fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

impl CommandLine {
    /// A text evaluated by the matching command (`run`, `gap`, `certificate`, `observe`,
    /// `compare`), in one of the formats of that command, or as `result`, the file of `run --save`.
    /// `stop` acts like a signal.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn exported(
        &self,
        given: GivenFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<ExportedAnswer, NotExported> {
        let Some((_, extension, content_type)) = FORMATS.iter().find(|(name, ..)| *name == format)
        else {
            let names = FORMATS.map(|(name, ..)| name).join(", ");
            let message = format!("there is no format `{format}`; the formats are {names}");
            return Err(NotExported::Format(message));
        };
        // they need a clock and a disk
        if cfg!(target_family = "wasm") && ["xlsx", RESULT].contains(&format) {
            let message = format!(
                "the format `{format}` needs `gumption open` or the command line; the browser \
                 alone cannot write it"
            );
            return Err(NotExported::Format(message));
        }
        let kind = TextKind::of(&given.text);
        let command = command_of(kind)?;
        self.check_trials(&given, kind)?;
        let name = format!("{}.{extension}", stem(&given.name));
        let content = if format == RESULT {
            self.saved(given, command, stop)?
        } else {
            self.evaluated(given, &[command, "-", "--format", format], stop)?
        };
        Ok(ExportedAnswer { content, content_type, name })
    }

    /// The answer of a command about a text.
    fn evaluated(
        &self,
        given: GivenFile,
        arguments: &[&str],
        stop: &Arc<AtomicBool>,
    ) -> Result<Vec<u8>, NotExported> {
        let arguments: Vec<OsString> = arguments.iter().map(OsString::from).collect();
        let called = self.call(arguments, Some(given), Arc::clone(stop));
        let answered = called.map_err(|failure| match failure {
            Failure::System(_) => NotExported::System(failure.to_string()),
            Failure::Diagnostics(found) => NotExported::Mistakes(found),
            _ => NotExported::Content(failure.to_string()),
        })?;
        if answered.exit == Exit::Interrupted {
            return Err(stopped_early());
        }
        Ok(answered.answer)
    }

    /// The result file of a model.
    fn saved(
        &self,
        given: GivenFile,
        command: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Vec<u8>, NotExported> {
        let system = |error: std::io::Error| NotExported::System(error.to_string());
        let folder = tempfile::tempdir().map_err(system)?;
        let path = folder.path().join("result.json");
        let Some(name) = path.to_str() else {
            let message = "the folder for temporary files has a name that is not UTF-8";
            return Err(NotExported::System(message.to_owned()));
        };
        self.evaluated(given, &[command, "-", "--format", "json", "--save", name], stop)?;
        std::fs::read(&path).map_err(system)
    }

    /// Checks that the number of trials in a text is possible while a user waits.
    fn check_trials(&self, given: &GivenFile, kind: TextKind) -> Result<(), NotExported> {
        let GivenFile { name, text, folder, within, held } = given;
        let files = self.files().holding(held).within(within.as_deref());
        let of = |task: &Task| match task.settings.trials {
            Trials::Fixed(trials) => trials.saturating_mul(task.rows.len() as u64),
            Trials::Adaptive => 0,
        };
        // errors of a text are reported by the code that uses it
        let asked: u64 = match kind {
            TextKind::Model => {
                files.model_text(name, text, folder, &[]).map_or(0, |file| of(&file.task))
            }
            TextKind::Case => {
                files.case_text(name, text, folder).map_or(0, |file| of(&file.case.task))
            }
            TextKind::Certificate => files.certificate_text(name, text, folder).map_or(0, |file| {
                let tasks = file.certificate.evaluations.iter();
                tasks.map(|asked| of(&asked.task)).fold(0, u64::saturating_add)
            }),
            _ => 0,
        };
        if asked <= MOST_TRIALS {
            return Ok(());
        }
        Err(NotExported::Content(format!(
            "{name}: the file states {asked:.1e} trials, but the page makes at most {most:.0e}; \
             use fewer, or the command line",
            asked = asked as f64,
            most = MOST_TRIALS as f64,
        )))
    }
}
