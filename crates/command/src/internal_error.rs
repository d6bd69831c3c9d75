//! A panic is an error of the program itself. The message names the place in the sources, temporary
//! files are removed, and the exit code is 1.

use std::sync::atomic::{AtomicBool, Ordering};

use super::exit::say;
use super::signals;

/// The exit code of failures of the system and of the program.
const INTERNAL: i32 = 1;

/// Whether the process continues after a caught panic.
static SURVIVED: AtomicBool = AtomicBool::new(false);

/// Ends the process at a panic in any thread.
pub(super) fn watch() {
    let tell = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        tell(panic);
        // the published program does not unwind (`profile.dist`): nothing can catch a panic there
        if cfg!(panic = "unwind") && SURVIVED.load(Ordering::Relaxed) {
            return;
        }
        say("error: this is an error of the program, not of your files; please report the lines \
             above with the command and its files\n");
        signals::end(INTERNAL);
    }));
}

/// Leaves panics to a server, which answers that the work failed, and continues.
pub(super) fn leave_to_server() {
    SURVIVED.store(true, Ordering::Relaxed);
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::super::signals::Temporary;

    const CHILD: &str = "GUMPTION_TEST_OF_A_PANIC";

    /// The test starts itself as a child process, which panics in another thread while a temporary
    /// file exists.
    #[test]
    fn a_panic_ends_with_1_and_leaves_no_file() {
        if let Some(path) = std::env::var_os(CHILD) {
            super::watch();
            std::fs::write(&path, "half").unwrap();
            let _temporary = Temporary::new(path.into());
            let _ = std::thread::spawn(|| panic!("on purpose")).join();
            unreachable!("the process has ended");
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("half");
        let mut child = Command::new(std::env::current_exe().unwrap());
        let name = "internal_error::tests::a_panic_ends_with_1_and_leaves_no_file";
        let ended =
            child.args(["--exact", name, "--nocapture"]).env(CHILD, &path).output().unwrap();
        let told = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!(ended.status.code(), Some(1), "{told}");
        assert!(told.contains("on purpose") && told.contains("error of the program"), "{told}");
        assert!(!path.exists());
    }
}
