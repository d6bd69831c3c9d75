//! Giving the answer: to standard output, or to a file that is there whole or not at all.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use super::Failure;

/// Writes the answer. A reader that closed the pipe has had enough; that is no failure.
pub(super) fn write(text: &str, file: Option<&Path>) -> Result<(), Failure> {
    write_with(file, |out| out.write_all(text.as_bytes()))
}

/// Lets `write` write the answer piece by piece.
pub(super) fn write_with(
    file: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    match file {
        Some(path) => write_parts(path, |file| {
            let mut out = BufWriter::new(file);
            write(&mut out).and_then(|()| out.flush()).map_err(|error| failed(path, &error))?;
            Ok(true)
        }),
        None => {
            let mut out = BufWriter::new(io::stdout().lock());
            match write(&mut out).and_then(|()| out.flush()) {
                Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                    Err(Failure::System(format!("cannot write the answer: {error}")))
                }
                _ => Ok(()),
            }
        }
    }
}

/// Writes a text to a file.
pub(super) fn write_file(text: &str, path: &Path) -> Result<(), Failure> {
    write_parts(path, |file| {
        put(file, path, text.as_bytes())?;
        Ok(true)
    })
}

/// Bytes into a file that is to become `path`.
pub(super) fn put(
    file: &mut (impl Write + ?Sized),
    path: &Path,
    bytes: &[u8],
) -> Result<(), Failure> {
    file.write_all(bytes).map_err(|error| failed(path, &error))
}

fn failed(path: &Path, error: &io::Error) -> Failure {
    Failure::System(format!("cannot write `{}`: {error}", path.display()))
}

/// Lets `write` fill a temporary file beside the wanted one, then renames it; if `write` gives
/// false, nothing is left.
pub(super) fn write_parts(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> Result<bool, Failure>,
) -> Result<(), Failure> {
    let failed = |error: io::Error| failed(path, &error);
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    // a device or a pipe cannot be renamed over
    if path.exists() && !path.is_file() {
        let mut file = std::fs::OpenOptions::new().write(true).open(path).map_err(failed)?;
        return write(&mut file).map(|_| ());
    }
    let mut file = tempfile::Builder::new()
        .prefix(".gumption-")
        .permissions_like_new_files()
        .tempfile_in(folder)
        .map_err(failed)?;
    if !write(file.as_file_mut())? {
        return Ok(());
    }
    file.as_file().sync_all().map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Temporary files are private by default; an answer is as readable as any new file.
trait PermissionsLikeNewFiles {
    fn permissions_like_new_files(&mut self) -> &mut Self;
}

impl PermissionsLikeNewFiles for tempfile::Builder<'_, '_> {
    #[cfg(unix)]
    fn permissions_like_new_files(&mut self) -> &mut Self {
        use std::os::unix::fs::PermissionsExt;
        // the process's mask is applied to this
        self.permissions(std::fs::Permissions::from_mode(0o666))
    }

    #[cfg(not(unix))]
    fn permissions_like_new_files(&mut self) -> &mut Self {
        self
    }
}
