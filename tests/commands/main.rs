//! The commands `verify`, `schema` and `diff`, run as a user runs them.

mod diff;
mod schema;
mod verify;

use assert_cmd::Command;

/// The program, started in the root of the repository.
fn gumption() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gumption"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

/// Standard output of a run that must succeed.
fn output(arguments: &[&str]) -> String {
    let assert = gumption().args(arguments).assert().success();
    String::from_utf8(assert.get_output().stdout.clone()).unwrap()
}
