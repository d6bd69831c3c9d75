//! A new file that replaces another one once it is complete.
//!
//! On Linux it has no name until then (`O_TMPFILE`), so that nothing remains of it however the
//! process ends. Elsewhere, and on file systems without such files, it has a hidden name.

use std::fs::{File, Metadata};
use std::io::{self, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use super::output::folder_of;
use super::signals::{self, Temporary};

/// Bytes that are written and removed at once: if there is no room for them, the disk is full.
const PROBE: usize = 1 << 16;

/// Maximum number of links in a chain.
const MOST_LINKS: usize = 40;

/// A new file, and its final path.
#[derive(Debug)]
pub(super) struct Replacement {
    file: File,
    target: PathBuf,
    /// `None` for a file without a name.
    name: Option<Temporary>,
}

/// The target of a path, with links resolved, even if nothing exists there.
pub(super) fn target(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match std::fs::read_link(&path) {
            Ok(link) => path = folder_of(&path).join(link),
            Err(_) => break,
        }
    }
    path
}

impl Replacement {
    /// A new file at a path where none exists.
    pub(super) fn of_none(target: &Path) -> io::Result<Self> {
        let folder = folder_of(target);
        if !folder.exists() {
            let message = format!(
                "there is no folder `{}`",
                gumption_report::plain(&folder.display().to_string())
            );
            return Err(io::Error::new(ErrorKind::NotFound, message));
        }
        Self::new(target)?.with_room()
    }

    /// A file that replaces an existing one, with its mode and owner. `None` if the file must be
    /// written in place: it has several names, its folder takes no other file, or the new file
    /// would have another owner.
    pub(super) fn of(target: &Path, existing: &Metadata) -> io::Result<Option<Self>> {
        if names(existing) > 1 {
            return Ok(None);
        }
        let new = match Self::new(target) {
            Ok(new) => new,
            Err(error) if matches!(error.kind(), ErrorKind::PermissionDenied) => return Ok(None),
            Err(error) => return Err(error),
        };
        if !takes_over_owner(&new.file, existing) {
            return Ok(None);
        }
        new.file.set_permissions(existing.permissions())?;
        new.with_room().map(Some)
    }

    fn new(target: &Path) -> io::Result<Self> {
        if let Some(file) = nameless(folder_of(target))? {
            return Ok(Self { file, target: target.to_owned(), name: None });
        }
        for number in 0.. {
            let path = hidden(target, number);
            match File::create_new(&path) {
                Ok(file) => {
                    let name = Some(Temporary::new(path));
                    return Ok(Self { file, target: target.to_owned(), name });
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists && number < 1000 => {}
                Err(error) => return Err(error),
            }
        }
        Err(ErrorKind::AlreadyExists.into())
    }

    /// Checks that there is room on the disk.
    fn with_room(mut self) -> io::Result<Self> {
        self.file.write_all(&vec![0; PROBE])?;
        self.file.rewind()?;
        self.file.set_len(0)?;
        Ok(self)
    }

    pub(super) fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Gives the file its path.
    pub(super) fn persist(self) -> io::Result<()> {
        self.file.sync_all()?;
        let _whole = signals::whole();
        let name = match self.name {
            Some(name) => name,
            None => {
                // directly if no file exists; a link does not replace a file
                match link(&self.file, &self.target) {
                    Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                    other => return other,
                }
                let mut number = 0;
                loop {
                    let path = hidden(&self.target, number);
                    match link(&self.file, &path) {
                        Ok(()) => break Temporary::new(path),
                        Err(error) if error.kind() == ErrorKind::AlreadyExists && number < 1000 => {
                            number += 1;
                        }
                        Err(error) => return Err(error),
                    }
                }
            }
        };
        std::fs::rename(name.path(), &self.target)
    }
}

/// A hidden name next to the wanted one.
fn hidden(target: &Path, number: u32) -> PathBuf {
    folder_of(target).join(format!(".gumption-{}-{number}", std::process::id()))
}

/// A file without a name; `None` if the system does not support it.
#[cfg(target_os = "linux")]
fn nameless(folder: &Path) -> io::Result<Option<File>> {
    use std::os::unix::fs::OpenOptionsExt;

    use rustix::fs::OFlags;
    use rustix::io::Errno;

    let flags = i32::try_from(OFlags::TMPFILE.bits()).unwrap_or(0);
    let opened =
        std::fs::OpenOptions::new().write(true).mode(0o666).custom_flags(flags).open(folder);
    let none = [Errno::OPNOTSUPP, Errno::ISDIR, Errno::NOENT, Errno::INVAL];
    match opened {
        // it can get a name only through /proc
        Ok(file) => Ok(own_path(&file).exists().then_some(file)),
        Err(error) if Errno::from_io_error(&error).is_some_and(|e| none.contains(&e)) => Ok(None),
        Err(error) => Err(error),
    }
}

#[cfg(target_os = "linux")]
fn own_path(file: &File) -> PathBuf {
    use std::os::fd::AsRawFd;
    PathBuf::from(format!("/proc/self/fd/{}", file.as_raw_fd()))
}

#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    Ok(linkat(CWD, own_path(file), CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn nameless(_: &Path) -> io::Result<Option<File>> {
    Ok(None)
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

/// The number of names of a file.
#[cfg(unix)]
fn names(file: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    file.nlink()
}

#[cfg(not(unix))]
fn names(_: &Metadata) -> u64 {
    1
}

/// Gives a new file the owner and, if allowed, the group of another one.
#[cfg(unix)]
fn takes_over_owner(new: &File, old: &Metadata) -> bool {
    use std::os::unix::fs::{MetadataExt, fchown};
    let Ok(own) = new.metadata() else { return false };
    if own.gid() != old.gid() {
        // its group is changed if the owner may do so; otherwise the mode limits others
        let _ = fchown(new, None, Some(old.gid()));
    }
    own.uid() == old.uid() || fchown(new, Some(old.uid()), None).is_ok()
}

#[cfg(not(unix))]
fn takes_over_owner(_: &File, _: &Metadata) -> bool {
    true
}
