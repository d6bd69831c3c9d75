//! What signals leave: an answer from the trials that were made, and no file that is not whole.
#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

use serde_json::Value;

use crate::process::{Child, Command, ending, until};
use crate::support::command;

const MODEL: &str = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1}},
    "equations": {"y": "x*x"}, "outputs": {"y": {}}}"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.json"), MODEL).unwrap();
    folder
}

fn start(folder: &Path, arguments: &[&str]) -> Child {
    let mut program = command();
    program.current_dir(folder).args(arguments);
    program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

fn signal(child: &Child, name: &str) {
    let kill = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(kill.expect("`kill` runs").success());
}

/// Waits until the first trials are made: processor time says so whatever else the machine does (on
/// Linux; elsewhere by the clock).
fn wait_for_trials(child: &Child) {
    // hundredths of a second, of user and system: the fields behind the name in brackets
    let used = || {
        let found = fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
        let fields = found.rsplit_once(')')?.1.split_whitespace();
        let ticks: Vec<u64> =
            fields.skip(11).take(2).map_while(|field| field.parse().ok()).collect();
        Some(ticks.iter().sum::<u64>())
    };
    if !cfg!(target_os = "linux") {
        return std::thread::sleep(Duration::from_secs(3));
    }
    until("half a second of work", || used().is_none_or(|ticks| ticks >= 50));
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

/// The file without a name that a process writes in a folder, once it has so many bytes (on Linux).
fn nameless(child: &Child, folder: &Path, bytes: u64) -> Option<PathBuf> {
    let open = fs::read_dir(format!("/proc/{}/fd", child.id())).ok()?;
    let folder = folder.canonicalize().ok()?;
    open.flatten().map(|entry| entry.path()).find(|path| {
        fs::read_link(path).is_ok_and(|target| target.starts_with(&folder))
            && fs::metadata(path).is_ok_and(|found| found.len() >= bytes)
    })
}

/// Each of the three in the format and file that were asked for, marked, with exit codes as shells
/// have them.
#[test]
fn a_signal_gives_the_answer_of_the_trials_so_far() {
    for (name, code) in ending(&[("-INT", 130), ("-TERM", 143), ("-HUP", 129)]) {
        let folder = folder();
        let arguments = ["run", "m.json", "--trials", "1e12", "--format", "json"];
        let outputs = ["--output", "a.json", "--save", "r.json", "--samples", "s.csv"];
        let child = start(folder.path(), &[&arguments[..], &outputs].concat());
        wait_for_trials(&child);
        signal(&child, name);
        let done = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(code), "{name}: {said}");
        assert!(done.stdout.is_empty(), "{name}");
        for left in ["r.json", "s.csv"] {
            assert!(said.contains(&format!("`{left}` is not written")), "{said}");
        }
        assert_eq!(names(folder.path()), ["a.json", "m.json"]);
        let answer = fs::read_to_string(folder.path().join("a.json")).unwrap();
        let answer: Value = serde_json::from_str(&answer).unwrap();
        assert_eq!(answer["stopped"], true);
        let trials = &answer["outputs"]["y"]["monte_carlo"];
        assert_eq!(trials["stopped"], true);
        assert!(trials["trials"].as_u64().unwrap() > 0);
        // u of x^2 is sqrt(4 0.1^2 + 2 0.1^4) = 0.2005; a thousand trials scatter by 2 %
        assert!((trials["standard_uncertainty"].as_f64().unwrap() - 0.2005).abs() < 0.02);
    }
}

#[test]
fn every_format_is_marked() {
    for (format, mark) in [
        ("table", "stopped after"),
        ("csv", "stopped after"),
        ("markdown", "stopped after"),
        ("latex", "stopped after"),
        ("html", "stopped after"),
        ("xlsx", ""),
    ] {
        let folder = folder();
        let arguments = ["run", "m.json", "--trials", "1e12", "--format", format];
        let child = start(folder.path(), &[&arguments[..], &["--output", "a"]].concat());
        wait_for_trials(&child);
        signal(&child, "-TERM");
        let done = child.wait_with_output().unwrap();
        assert_eq!(done.status.code(), Some(143), "{format}");
        assert!(done.stdout.is_empty(), "{format}");
        let answer = fs::read(folder.path().join("a")).expect("the file is written");
        assert!(String::from_utf8_lossy(&answer).contains(mark), "{format}");
        assert!(answer.len() > 100, "{format}");
    }
}

/// In the middle of a large file: the old one stays, whatever the signal.
#[test]
fn a_signal_while_writing_leaves_the_old_file() {
    for (name, code) in [("-INT", Some(130)), ("-TERM", Some(143)), ("-KILL", None)] {
        let folder = folder();
        fs::write(folder.path().join("s.csv"), "old").unwrap();
        let arguments = ["run", "m.json", "--trials", "2e7", "--samples", "s.csv", "--quiet"];
        let mut child = start(folder.path(), &arguments);
        if cfg!(target_os = "linux") {
            until("a file without a name", || {
                assert!(child.try_wait().unwrap().is_none(), "it ended before");
                nameless(&child, folder.path(), 1_000_000).is_some()
            });
        }
        signal(&child, name);
        let done = child.wait_with_output().unwrap();
        assert_eq!(done.status.code(), code, "{name}");
        if cfg!(target_os = "linux") || code.is_some() {
            assert_eq!(names(folder.path()), ["m.json", "s.csv"], "{name}");
        }
        assert_eq!(fs::read_to_string(folder.path().join("s.csv")).unwrap(), "old", "{name}");
        if code.is_some() {
            // all trials were made: their answer is complete
            let answer = String::from_utf8_lossy(&done.stdout).into_owned();
            assert!(answer.contains("clause 8") && !answer.contains("stopped after"), "{name}");
        }
    }
}

/// Commands without an answer to hand back end at once, and leave nothing.
#[test]
fn other_commands_end_at_once() {
    let folder = folder();
    let arguments = ["assumptions", "m.json", "--trials", "1e9", "--output", "a.txt"];
    let child = start(folder.path(), &arguments);
    std::thread::sleep(Duration::from_millis(1500));
    let (name, code) = ending(&[("-HUP", 129), ("-TERM", 143)])[0];
    signal(&child, name);
    let done = child.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(code));
    assert_eq!(names(folder.path()), ["m.json"]);
}

/// `nohup` has SIGHUP ignored, which is a wish: the run goes on, until another signal comes. On Linux,
/// where a program can tell.
#[cfg(target_os = "linux")]
#[test]
fn a_hangup_that_was_to_be_ignored_is() {
    let folder = folder();
    let mut shell = Command::new("sh");
    shell.current_dir(folder.path()).args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]);
    shell.arg(command().get_program()).args(["run", "m.json", "--trials", "1e12"]);
    let mut child = shell.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_trials(&child);
    signal(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "it ended");
    signal(&child, "-TERM");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(143));
}
