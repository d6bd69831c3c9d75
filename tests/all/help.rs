//! The help on commands: its examples run, the scripts of shells complete, and the man pages have no
//! warnings.

use std::fs;
use std::path::Path;

use crate::manual::shell;
use crate::process::Command;
use crate::support::{command, file_name, output, root};

/// The names of all commands, from the help on the program.
fn commands() -> Vec<String> {
    let help = output(&["--help"]);
    let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
    let names = lines.filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase()));
    names.filter_map(|line| Some(line.split_whitespace().next()?.to_owned())).collect()
}

/// The lines of the examples of a command, from its help.
fn examples(command: &str) -> Vec<String> {
    let help = output(&[command, "--help"]);
    let (_, examples) = help.split_once("\nExamples").expect("examples");
    let lines = examples.lines().filter_map(|line| line.strip_prefix("    "));
    lines.map(str::to_owned).collect()
}

/// Whether a program is on this machine.
fn is_there(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|said| said.status.success())
}

/// All examples run in one folder with the files of the repository, in the order of the help.
#[cfg(unix)]
#[test]
fn examples_run() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["models", "reports"] {
        std::os::unix::fs::symlink(root().join(name), folder.path().join(name)).expect("linked");
    }
    let commands = commands();
    assert!(commands.len() >= 20, "{commands:?}");
    for command in &commands {
        let lines = examples(command);
        assert!(lines.len() >= 2, "{command}: {lines:?}");
        // what runs until it is ended is tested with its server
        for line in lines.iter().filter(|line| !line.starts_with("gumption open ")) {
            if line.starts_with("man ") && !is_there("man") {
                continue;
            }
            let said = shell(folder.path(), line);
            let error = String::from_utf8_lossy(&said.stderr);
            assert!(said.status.success(), "{line}\n{error}");
        }
    }
}

/// The examples of `open` open a file and a folder that exist.
#[cfg(feature = "open")]
#[test]
fn examples_of_open_name_files_of_the_repository() {
    let lines = examples("open");
    assert_eq!(lines.len(), 2);
    for line in lines {
        let mut words: Vec<&str> = line.split_whitespace().skip(1).collect();
        assert!(root().join(words[1]).exists(), "{line}");
        // the arguments are right, up to one that does not exist
        words[1] = "no-such-file.json";
        let said = command().args(&words).output().expect("the program runs");
        let error = String::from_utf8_lossy(&said.stderr);
        assert!(error.contains("`no-such-file.json`: there is no such file"), "{line}\n{error}");
    }
}

/// A script of bash proposes the commands that begin with `r`.
#[test]
fn scripts_complete_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    let checks: [(&str, &[&str]); 4] = [
        ("bash", &["bash", "-n"]),
        ("zsh", &["zsh", "-n"]),
        ("fish", &["fish", "--no-execute"]),
        ("powershell", &["pwsh", "-NoProfile", "-File"]),
    ];
    for (name, check) in checks {
        let script = output(&["completions", name]);
        let path = folder.path().join(format!("gumption.{name}.ps1"));
        fs::write(&path, &script).expect("written");
        assert!(script.contains("gap-check"), "{name}");
        if is_there(check[0]) {
            let parsed = Command::new(check[0]).args(&check[1..]).arg(&path).output();
            let parsed = parsed.expect("the shell runs");
            let error = String::from_utf8_lossy(&parsed.stderr);
            assert!(parsed.status.success() && error.is_empty(), "{name}: {error}");
        }
    }
    if !is_there("bash") {
        return;
    }
    for (words, wanted) in [
        ("gumption r", "readings run"),
        ("gumption run --form", "--format"),
        ("gumption run --format ht", "html"),
    ] {
        let line = format!(
            "source gumption.bash.ps1; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); \
             _gumption gumption \"${{COMP_WORDS[COMP_CWORD]}}\" \"${{COMP_WORDS[COMP_CWORD-1]}}\"; \
             printf '%s\\n' \"${{COMPREPLY[@]}}\""
        );
        let said = Command::new("bash").args(["-c", &line]).current_dir(folder.path()).output();
        let said = said.expect("bash runs");
        let mut found: Vec<String> =
            String::from_utf8_lossy(&said.stdout).split_whitespace().map(str::to_owned).collect();
        found.sort();
        assert_eq!(found.join(" "), wanted, "{words}: {}", String::from_utf8_lossy(&said.stderr));
    }
}

/// A page for each command, without warnings where there is a formatter.
#[test]
fn man_pages_are_written_for_each_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().to_str().expect("UTF-8");
    assert_eq!(output(&["man", place]), "");
    let entries = fs::read_dir(folder.path()).expect("a folder");
    let mut pages: Vec<String> =
        entries.map(|entry| file_name(&entry.expect("an entry").path())).collect();
    let mut expected: Vec<String> =
        commands().iter().map(|name| format!("gumption-{name}.1")).collect();
    expected.push("gumption.1".to_owned());
    pages.sort();
    expected.sort();
    assert_eq!(pages, expected);
    let formatter = ["groff", "mandoc"].into_iter().find(|program| is_there(program));
    for page in formatter
        .map(|program| (program, &pages))
        .into_iter()
        .flat_map(|(program, pages)| pages.iter().map(move |page| (program, page)))
    {
        let (program, page) = page;
        let arguments: &[&str] = match program {
            "groff" => &["-k", "-Kutf8", "-man", "-ww", "-z", "-Tutf8"],
            _ => &["-T", "lint", "-W", "warning"],
        };
        let said = Command::new(program).args(arguments).arg(folder.path().join(page)).output();
        let said = said.expect("the formatter runs");
        let warnings = String::from_utf8_lossy(&said.stderr);
        assert!(said.status.success() && warnings.is_empty(), "{page}: {warnings}");
    }
    let run = fs::read_to_string(folder.path().join("gumption-run.1")).expect("the page");
    assert!(run.contains("gumption-run 1") && run.contains("Monte Carlo"), "{run}");
    // the folder must exist
    let nowhere = folder.path().join("none");
    let said = command().arg("man").arg(&nowhere).output().expect("the program runs");
    assert_eq!(said.status.code(), Some(2));
    assert!(!Path::new(&nowhere).exists());
}
