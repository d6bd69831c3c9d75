//! Opening the browser.

use std::process::{Command, Stdio};

/// Opens an address in the user's browser.
///
/// # Errors
/// Why that was not tried, or failed at once.
pub(super) fn open(address: &str) -> Result<(), String> {
    let mut command = command(address)?;
    let name = command.get_program().to_string_lossy().into_owned();
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child =
        command.spawn().map_err(|error| format!("no browser was opened (`{name}`: {error})"))?;
    // it may live as long as the browser; only its end is waited for
    let wait = move || child.wait();
    let _ = std::thread::Builder::new().name("browser".to_owned()).spawn(wait);
    Ok(())
}

#[cfg(windows)]
#[allow(clippy::unnecessary_wraps)] // as on other systems
fn command(address: &str) -> Result<Command, String> {
    // not `cmd /c start`, which reads addresses as commands
    let mut command = Command::new("rundll32");
    command.args(["url.dll,FileProtocolHandler", address]);
    Ok(command)
}

#[cfg(target_os = "macos")]
#[allow(clippy::unnecessary_wraps)] // as on other systems
fn command(address: &str) -> Result<Command, String> {
    let mut command = Command::new("open");
    command.arg(address);
    Ok(command)
}

#[cfg(not(any(windows, target_os = "macos")))]
fn command(address: &str) -> Result<Command, String> {
    // without a display `xdg-open` starts a browser in the terminal of the server
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if !["DISPLAY", "WAYLAND_DISPLAY", "BROWSER"].into_iter().any(is_set) {
        return Err("there is no display to open a browser on".to_owned());
    }
    let mut command = Command::new("xdg-open");
    command.arg(address);
    Ok(command)
}
