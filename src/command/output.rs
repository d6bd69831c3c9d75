//! Giving the answer: to standard output, or to a file that is there whole or not at all.

use std::io::{ErrorKind, Write};
use std::path::Path;

use super::Failure;

/// Writes the answer. A reader that closed the pipe has had enough; that is no failure.
pub(super) fn write(text: &str, file: Option<&Path>) -> Result<(), Failure> {
    match file {
        Some(path) => write_file(text, path),
        None => {
            let mut out = std::io::stdout().lock();
            match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
                Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                    Err(Failure::System(format!("cannot write the answer: {error}")))
                }
                _ => Ok(()),
            }
        }
    }
}

/// Writes a temporary file beside the wanted one, then renames it.
fn write_file(text: &str, path: &Path) -> Result<(), Failure> {
    let failed = |error: std::io::Error| {
        Failure::System(format!("cannot write `{}`: {error}", path.display()))
    };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    // a device or a pipe cannot be renamed over
    if path.exists() && !path.is_file() {
        return std::fs::write(path, text).map_err(failed);
    }
    let mut file = tempfile::Builder::new()
        .prefix(".gumption-")
        .permissions_like_new_files()
        .tempfile_in(folder)
        .map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
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
