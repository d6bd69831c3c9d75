//! Writes the answer to standard output, or to a file, completely or not at all.
//!
//! Files are opened before the computation, so that a missing folder or a full disk is reported at
//! once, and so that no input file is overwritten. A new file has no name until it is complete
//! ([`Replacement`]); then it replaces the old one.

use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::replacement::{Replacement, target};
use super::surroundings::in_call;
use super::{Failure, paint, signals};
use gumption_columns::read_failure;

/// The destination of an answer.
#[derive(Debug)]
pub(super) enum AnswerPlace {
    /// To standard output.
    StandardOutput,
    /// A text page to standard output, formatted for a terminal.
    Page,
    /// To a file.
    File(Destination),
}

impl AnswerPlace {
    /// Writes the answer. A closed pipe is not an error: the reader has had enough.
    pub(super) fn write(self, text: &str) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(text.as_bytes()))
    }

    /// Lets `write` write the answer piece by piece.
    pub(super) fn write_with(
        self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        match self {
            Self::File(file) => file.write_with(|out| write(out).map(|()| true)),
            Self::Page if in_call(|_| ()).is_none() && paint::is_wanted() => {
                let mut bytes = Vec::new();
                write(&mut bytes)
                    .and_then(|()| io::stdout().lock().write_all(painted(bytes).as_bytes()))
                    .or_else(unless_closed)
            }
            Self::StandardOutput | Self::Page => {
                // outside the borrow: `write` may print something
                let mut bytes = Vec::new();
                if in_call(|_| ()).is_some() {
                    write(&mut bytes).map_err(|error| {
                        Failure::System(format!("cannot write the answer: {error}"))
                    })?;
                    in_call(|call| call.answer.append(&mut bytes));
                    return Ok(());
                }
                let mut out = BufWriter::new(io::stdout().lock());
                write(&mut out).and_then(|()| out.flush()).or_else(unless_closed)
            }
        }
    }
}

/// The page with colours; bytes that are not text stay unchanged.
fn painted(bytes: Vec<u8>) -> String {
    match String::from_utf8(bytes) {
        Ok(page) => paint::painted(&page),
        Err(error) => String::from_utf8_lossy(error.as_bytes()).into_owned(),
    }
}

/// Ignores a closed pipe: the reader has had enough.
fn unless_closed(error: io::Error) -> Result<(), Failure> {
    match error.kind() {
        ErrorKind::BrokenPipe => Ok(()),
        _ => Err(Failure::System(format!("cannot write the answer: {error}"))),
    }
}

/// An output file, opened before the computation.
#[derive(Debug)]
pub(super) struct Destination {
    path: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    /// A new file that replaces the existing one.
    Replacement(Replacement),
    /// A device or a pipe, or a file that cannot be replaced: one with several names, or in a
    /// folder that takes no other file.
    InPlace(File),
}

/// An option that names a file, and the file.
pub(super) type FileOption<'a> = (&'static str, Option<&'a Path>);

/// The file of an `--output`; `None` for `-`, which is standard output.
pub(super) fn to_file(asked: Option<&Path>) -> Option<&Path> {
    asked.filter(|path| !is_standard(path))
}

fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Opens the requested files; `read` are the files from which the answer is computed.
///
/// # Errors
/// A file would be written twice, or is an input, or cannot be written.
pub(super) fn open<const N: usize>(
    asked: [FileOption<'_>; N],
    read: &[PathBuf],
) -> Result<[Option<Destination>; N], Failure> {
    check(&asked, read)?;
    let mut opened = [const { None }; N];
    for (place, (_, path)) in opened.iter_mut().zip(asked) {
        *place = path.map(Destination::open).transpose()?;
    }
    Ok(opened)
}

/// Checks that every file is written only once, and no input is overwritten.
fn check(asked: &[FileOption<'_>], read: &[PathBuf]) -> Result<(), Failure> {
    let wanted: Vec<(&str, &Path, Identity)> = asked
        .iter()
        .filter_map(|&(option, path)| Some((option, path?, Identity::of(path?)?)))
        .collect();
    if let Some((option, ..)) = wanted.iter().find(|(_, path, _)| is_standard(path)) {
        let reason = format!(
            "`{option} -`: only the answer goes to standard output; name a file (`./-` for a file \
             called `-`)"
        );
        return Err(Failure::Argument(reason));
    }
    for (number, (option, path, identity)) in wanted.iter().enumerate() {
        let shown = shown(path);
        if read.iter().filter_map(|read| Identity::of(read)).any(|read| read == *identity) {
            let reason = format!(
                "`{option} {shown}` would overwrite an input of the answer; name another file"
            );
            return Err(Failure::Argument(reason));
        }
        if let Some((other, ..)) = wanted.iter().take(number).find(|(.., of)| of == identity) {
            let reason = format!("`{other}` and `{option}` would both write `{shown}`");
            return Err(Failure::Argument(reason));
        }
    }
    Ok(())
}

/// Identifies a file, whatever it is called.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Identity {
    /// Device and number of a file on Unix.
    #[cfg(unix)]
    Node(u64, u64),
    /// The path, links followed.
    Path(PathBuf),
}

impl Identity {
    /// `None` for devices, which may be written several times.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let Ok(found) = std::fs::metadata(path) else {
            let target = target(path);
            let folder = folder_of(&target).canonicalize().ok()?;
            return Some(Self::Path(folder.join(target.file_name()?)));
        };
        #[cfg(unix)]
        {
            use std::os::unix::fs::{FileTypeExt, MetadataExt};
            let kind = found.file_type();
            let is_device = kind.is_char_device() || kind.is_block_device();
            (!is_device).then(|| Self::Node(found.dev(), found.ino()))
        }
        #[cfg(not(unix))]
        if found.is_file() { path.canonicalize().ok().map(Self::Path) } else { None }
    }
}

/// The folder that contains a file.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

impl Destination {
    /// Opens a file whose name the program chooses.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let sink = Sink::open(path).map_err(|error| not_opened(path, &error))?;
        Ok(Self { path: path.to_owned(), sink })
    }

    /// The path, as it was given.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is a file, or else a device or a pipe.
    pub(super) fn is_regular(&self) -> bool {
        match &self.sink {
            Sink::Replacement(_) => true,
            Sink::InPlace(file) => file.metadata().is_ok_and(|found| found.is_file()),
        }
    }

    /// Lets `write` write the content; if it returns false or fails, the file stays unchanged.
    pub(super) fn write_with(
        self,
        write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<bool>,
    ) -> Result<(), Failure> {
        let Self { path, sink } = self;
        let written = match sink {
            Sink::InPlace(file) => in_place(file, write),
            Sink::Replacement(mut new) => {
                let mut out = BufWriter::new(new.file());
                let done = write(&mut out).and_then(|done| out.flush().map(|()| done));
                drop(out);
                done.and_then(|done| if done { new.persist() } else { Ok(()) })
            }
        };
        written.map_err(|error| failed(&path, read_failure::in_words(&error)))
    }
}

/// Overwrites the content of a file, or writes to a device or a pipe.
fn in_place(
    file: File,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<bool>,
) -> io::Result<()> {
    let _whole = signals::whole();
    let is_file = file.metadata().is_ok_and(|found| found.is_file());
    if is_file {
        file.set_len(0)?;
    }
    let mut out = BufWriter::new(&file);
    let written = write(&mut out).and_then(|_| out.flush());
    drop(out);
    match written {
        Err(error) if !is_file && error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Ok(()) if is_file => file.sync_all(),
        other => other,
    }
}

impl Sink {
    fn open(path: &Path) -> io::Result<Self> {
        let in_place = || OpenOptions::new().write(true).open(path);
        #[cfg(windows)]
        if is_device(path) {
            return in_place().map(Self::InPlace);
        }
        let existing = match std::fs::metadata(path) {
            Ok(existing) => existing,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Replacement::of_none(&target(path)).map(Self::Replacement);
            }
            Err(error) => return Err(error),
        };
        if !existing.is_file() {
            return in_place().map(Self::InPlace);
        }
        // a read-only file stays unchanged, whatever the system would allow
        if existing.permissions().readonly() {
            return Err(io::Error::new(ErrorKind::PermissionDenied, "the file is read-only"));
        }
        let old = in_place()?;
        Ok(match Replacement::of(&path.canonicalize()?, &existing)? {
            Some(new) => Self::Replacement(new),
            None => Self::InPlace(old),
        })
    }
}

/// Whether a name is that of the console or of the null device, which have no metadata.
#[cfg(windows)]
fn is_device(path: &Path) -> bool {
    ["NUL", "CON"].iter().any(|device| path.as_os_str().eq_ignore_ascii_case(device))
}

/// A name as messages show it.
pub(super) fn shown(path: &Path) -> String {
    gumption_report::plain(&path.display().to_string())
}

fn failed(path: &Path, error: impl fmt::Display) -> Failure {
    Failure::System(not_written(path, error))
}

fn not_written(path: &Path, error: impl fmt::Display) -> String {
    format!("cannot write `{}`: {error}", shown(path))
}

/// Why a file could not be opened: a missing folder is an error of the argument.
fn not_opened(path: &Path, error: &io::Error) -> Failure {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory | ErrorKind::IsADirectory => {
            Failure::Argument(not_written(path, read_failure::of_file(path, error)))
        }
        _ => failed(path, read_failure::of_file(path, error)),
    }
}
