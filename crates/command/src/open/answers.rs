//! Answers for the live page: the commands, called as functions.

use std::io;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use super::files_of_page;
use crate::diagnostics::render as rendered;
use crate::output::Destination;
use crate::{CommandLine, ExportedAnswer, GivenFile, NotExported};
use gumption_engine::parallel::Pool;
use gumption_files::TextKind;
use gumption_live::LiveError;
use gumption_server::{
    Answers, EvaluatedPage, Exported, FileDescription, NamedFiles, Refusal, ServedAsset, TextOfFile,
};
use gumption_text::FileSource;

/// Maximum number of idle thread pools that are kept.
const KEPT_POOLS: usize = 2;

/// The answers of this program.
pub(super) struct PageAnswers {
    program: CommandLine,
    assets: Vec<ServedAsset>,
    pools: Mutex<Vec<Pool>>,
}

impl PageAnswers {
    pub(super) fn new(program: CommandLine) -> Self {
        Self { program, assets: files_of_page::all(), pools: Mutex::default() }
    }

    /// Runs work in a thread pool of its own: in a shared one, the jobs of short work would wait
    /// for those of long work.
    fn in_own_pool<R: Send>(
        &self,
        work: impl FnOnce() -> Result<R, Refusal> + Send,
    ) -> Result<R, Refusal> {
        let pools = || self.pools.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = pools().pop();
        let pool = kept.unwrap_or_else(|| Pool::new(0));
        let done = pool.install(work);
        let mut pools = pools();
        if pools.len() < KEPT_POOLS {
            pools.push(pool);
        }
        done
    }

    /// A text in a format of the matching command.
    fn exported(
        &self,
        file: &TextOfFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<ExportedAnswer, Refusal> {
        self.in_own_pool(|| {
            let made = self.program.exported(given(file), format, stop);
            made.map_err(|why| refused(why, &file.text))
        })
    }
}

/// A text of the page as a command takes it.
fn given(file: &TextOfFile) -> GivenFile {
    let TextOfFile { path, text, folder, root } = file.clone();
    GivenFile { name: path, text, folder, within: Some(root), ..GivenFile::default() }
}

fn refused(why: NotExported, text: &str) -> Refusal {
    match why {
        NotExported::Format(message) => Refusal::Request(message),
        NotExported::Content(message) => Refusal::Content(message),
        NotExported::Stopped(message) => Refusal::Stopped(message),
        NotExported::Mistakes(found) => Refusal::Mistakes {
            message: rendered(&found, false),
            list: gumption_live::mistakes(text, &found),
        },
        NotExported::System(message) => Refusal::Internal(message),
    }
}

/// The files that a text of the page names, for its readers.
#[derive(Debug)]
struct Named<'a>(&'a NamedFiles<'a>);

impl FileSource for Named<'_> {
    fn content(&self, name: &str, most: u64) -> Result<Vec<u8>, String> {
        self.0.content(name, most).map_err(|error| error.to_string())
    }
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

    fn describe(&self, name: &str, content: &[u8]) -> FileDescription {
        let gumption_live::FileDescription { kind, title } =
            gumption_live::FileDescription::of(name, content);
        FileDescription { kind, title }
    }

    fn export(
        &self,
        file: &TextOfFile,
        format: &str,
        stop: &Arc<AtomicBool>,
    ) -> Result<Exported, Refusal> {
        let ExportedAnswer { content, content_type, name } = self.exported(file, format, stop)?;
        Ok(Exported { content, content_type, name })
    }

    fn page(
        &self,
        file: &TextOfFile,
        told: &(dyn Fn(f64) + Sync),
        stop: &Arc<AtomicBool>,
    ) -> Result<EvaluatedPage, Refusal> {
        if TextKind::of(&file.text) == TextKind::Case {
            let found = self.in_own_pool(|| {
                let made = self.program.diagnosed(&given(file), told, stop);
                made.map_err(|why| refused(why, &file.text))
            })?;
            return Ok(EvaluatedPage { html: found.html, answer: Some(found.json) });
        }
        let page = self.exported(file, "html", stop)?;
        let html = String::from_utf8(page.content);
        let html = html.map_err(|error| Refusal::Internal(error.to_string()))?;
        Ok(EvaluatedPage { html, answer: None })
    }

    fn replace(&self, path: &Path, content: &[u8]) -> io::Result<()> {
        let written = Destination::open(path)
            .and_then(|file| file.write_with(|out| out.write_all(content).map(|()| true)));
        written.map_err(|failure| io::Error::other(failure.to_string()))
    }
}
