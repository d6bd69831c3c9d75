//! Files that commands write: nothing that is read is written over, nothing that was computed is
//! lost, and what stood there keeps what it had beside its content.

use std::fs;
use std::path::Path;
#[cfg(unix)]
use std::process::Output;

#[cfg(unix)]
use crate::process::Command;
use crate::support::{command, root};

const MODEL: &str = r#"{"inputs": {"x": {"distribution": "samples", "file": "x.csv"}},
    "equations": {"y": "2*x"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 20000}}"#;

const SAMPLES: &str = "1\n2\n3\n";

/// More trials than anybody waits for: what is refused is refused before they are made.
const FOREVER: &str = "1e12";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("m.json"), MODEL).unwrap();
        fs::write(folder.path().join("x.csv"), SAMPLES).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn run(&self, arguments: &[&str]) -> Output {
        command().current_dir(self.path()).args(arguments).output().expect("the program runs")
    }

    /// The names of all files.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).unwrap();
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let mut names: Vec<String> =
            entries.map(|entry| name(entry).into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).unwrap()
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn no_output_replaces_what_is_read() {
    let folder = Folder::new();
    fs::create_dir(folder.path().join("below")).unwrap();
    fs::hard_link(folder.path().join("m.json"), folder.path().join("twin.json")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("m.json", folder.path().join("link.json")).unwrap();
    let names = folder.names();
    for output in [
        &["--output", "m.json"][..],
        &["--output", "./below/../m.json"],
        &["--output", "twin.json"],
        &["--output", "x.csv"],
        &["--save", "m.json"],
        &["--samples", "x.csv"],
        &["--save", "new.json", "--output", "new.json"],
        &["--save", "new.csv", "--samples", "below/../new.csv"],
        #[cfg(unix)]
        &["--output", "link.json"],
    ] {
        let refused = folder.run(&[&["run", "m.json", "--trials", FOREVER], output].concat());
        assert_eq!(refused.status.code(), Some(2), "{output:?}: {}", said(&refused));
        assert!(refused.stdout.is_empty() && said(&refused).lines().count() == 1, "{output:?}");
        assert!(said(&refused).contains("would"), "{}", said(&refused));
        assert_eq!(folder.names(), names);
    }
    assert_eq!((folder.text("m.json").as_str(), folder.text("x.csv").as_str()), (MODEL, SAMPLES));
    // what nobody keeps may be written as often as one likes
    let twice = ["run", "m.json", "--output", "/dev/null", "--save", "/dev/null"];
    if cfg!(unix) {
        assert_eq!(folder.run(&twice).status.code(), Some(0));
    }
}

#[test]
fn every_command_knows_what_it_reads() {
    let folder = Folder::new();
    fs::write(folder.path().join("t.csv"), "label,x1,U1,x2,U2\na,1,1,2,1\n").unwrap();
    let certificate = r#"{"title": "t", "rows": [{"model": "m.json", "output": "y"}]}"#;
    fs::write(folder.path().join("c.json"), certificate).unwrap();
    let case = root().join("models/gap/radius");
    for name in ["case.json", "data.csv"] {
        fs::copy(case.join(name), folder.path().join(name)).unwrap();
    }
    for arguments in [
        ["compare", "t.csv", "--output", "t.csv"],
        ["certificate", "c.json", "--output", "c.json"],
        ["certificate", "c.json", "--output", "m.json"],
        ["certificate", "c.json", "--output", "x.csv"],
        ["assumptions", "m.json", "--output", "x.csv"],
        ["gap", "case.json", "--output", "data.csv"],
        ["gap-check", "case.json", "--output", "case.json"],
        ["check", "m.json", "--output", "m.json"],
    ] {
        let refused = folder.run(&arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}: {}", said(&refused));
        assert!(said(&refused).contains("would overwrite"), "{arguments:?}: {}", said(&refused));
    }
    let refused = folder.run(&["diff", "m.json", "m.json", "--output", "m.json"]);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    assert_eq!((folder.text("m.json").as_str(), folder.text("x.csv").as_str()), (MODEL, SAMPLES));
}

/// Told before the trials are made, which would take days.
#[test]
fn what_cannot_be_written_is_told_at_once() {
    let folder = Folder::new();
    for option in ["--output", "--save", "--samples"] {
        let arguments = ["run", "m.json", "--trials", FOREVER, option, "none/x.csv"];
        let refused = folder.run(&arguments);
        assert_eq!(refused.status.code(), Some(2), "{option}: {}", said(&refused));
        let expected = "gumption: cannot write `none/x.csv`: there is no folder `none`\n";
        assert_eq!(said(&refused), expected);
        let arguments = ["run", "m.json", "--trials", FOREVER, option, "x.csv/x.csv"];
        assert_eq!(folder.run(&arguments).status.code(), Some(2), "{option}");
    }
    assert_eq!(folder.names(), ["m.json", "x.csv"]);
}

/// The program with files of at most so many blocks of 512 bytes: the system's word for more is
/// another, but a full disk is the same to a program.
#[cfg(unix)]
fn with_blocks(folder: &Folder, blocks: u32, arguments: &[&str]) -> Output {
    let mut shell = Command::new("sh");
    let script = format!("trap '' XFSZ; ulimit -f {blocks} && exec \"$0\" \"$@\"");
    shell.args(["-c", &script]).arg(command().get_program()).args(arguments);
    shell.current_dir(folder.path()).output().expect("the program runs")
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_told_at_once_and_keeps_what_was_there() {
    let folder = Folder::new();
    fs::write(folder.path().join("old.txt"), "old").unwrap();
    for name in ["old.txt", "new.txt"] {
        let arguments = ["run", "m.json", "--trials", FOREVER, "--output", name];
        let refused = with_blocks(&folder, 0, &arguments);
        assert_eq!(refused.status.code(), Some(1), "{}", said(&refused));
        assert!(said(&refused).contains(&format!("cannot write `{name}`")), "{}", said(&refused));
    }
    assert_eq!(folder.names(), ["m.json", "old.txt", "x.csv"]);
    assert_eq!(folder.text("old.txt"), "old");
}

/// The trials are the largest of three files, and the only one without room.
#[cfg(unix)]
#[test]
fn one_file_without_room_costs_no_other() {
    let folder = Folder::new();
    fs::write(folder.path().join("trials.csv"), "old").unwrap();
    let outputs = ["--save", "r.json", "--samples", "trials.csv", "--quiet"];
    let arguments = [&["run", "m.json", "--trials", "500000"][..], &outputs].concat();
    // 1000 blocks are 512 000 bytes
    let done = with_blocks(&folder, 1000, &arguments);
    assert_eq!(done.status.code(), Some(1), "{}", said(&done));
    assert!(said(&done).contains("cannot write `trials.csv`"), "{}", said(&done));
    assert!(String::from_utf8_lossy(&done.stdout).contains("clause 8"));
    assert_eq!(folder.names(), ["m.json", "r.json", "trials.csv", "x.csv"]);
    assert_eq!(folder.text("trials.csv"), "old");
    // a device that is full says so only when it is written to
    if Path::new("/dev/full").exists() {
        let arguments = ["run", "m.json", "--save", "/dev/full", "--output", "a.txt"];
        let done = folder.run(&arguments);
        assert_eq!(done.status.code(), Some(1));
        assert!(folder.text("a.txt").contains("clause 8"));
    }
}

#[cfg(unix)]
#[test]
fn a_replaced_file_keeps_its_mode_and_its_links() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    let folder = Folder::new();
    let at = |name: &str| folder.path().join(name);
    let mode = |name: &str| fs::metadata(at(name)).unwrap().permissions().mode() & 0o777;
    let write = |name: &str| {
        let done = folder.run(&["run", "m.json", "--quiet", "--output", name]);
        assert_eq!(done.status.code(), Some(0), "{name}: {}", said(&done));
        assert!(folder.text(name).contains("clause 8"), "{name}");
    };
    for (name, bits) in [("private.txt", 0o600), ("common.txt", 0o664)] {
        fs::write(at(name), "old").unwrap();
        fs::set_permissions(at(name), fs::Permissions::from_mode(bits)).unwrap();
        write(name);
        assert_eq!(mode(name), bits, "{name}");
    }
    fs::write(at("target.txt"), "old").unwrap();
    symlink("target.txt", at("link.txt")).unwrap();
    symlink("none.txt", at("dangling.txt")).unwrap();
    fs::write(at("one.txt"), "old").unwrap();
    fs::hard_link(at("one.txt"), at("other.txt")).unwrap();
    for name in ["link.txt", "dangling.txt", "one.txt"] {
        write(name);
    }
    for link in ["link.txt", "dangling.txt"] {
        assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
    }
    assert_eq!(folder.text("target.txt"), folder.text("link.txt"));
    assert_eq!(folder.text("none.txt"), folder.text("dangling.txt"));
    assert_eq!(folder.text("one.txt"), folder.text("other.txt"));
    assert_eq!(fs::metadata(at("one.txt")).unwrap().nlink(), 2);
    // a certificate that was issued, say; whoever is root could write it
    fs::write(at("issued.txt"), "old").unwrap();
    fs::set_permissions(at("issued.txt"), fs::Permissions::from_mode(0o444)).unwrap();
    let refused = folder.run(&["run", "m.json", "--trials", FOREVER, "--output", "issued.txt"]);
    assert_eq!(refused.status.code(), Some(1), "{}", said(&refused));
    assert!(said(&refused).contains("read-only"), "{}", said(&refused));
    assert_eq!((folder.text("issued.txt").as_str(), mode("issued.txt")), ("old", 0o444));
    // a file may be writable where its folder is not
    fs::create_dir(at("closed")).unwrap();
    fs::write(at("closed/old.txt"), "a longer text than what comes").unwrap();
    fs::set_permissions(at("closed"), fs::Permissions::from_mode(0o555)).unwrap();
    write("closed/old.txt");
    fs::set_permissions(at("closed"), fs::Permissions::from_mode(0o755)).unwrap();
    assert!(!folder.names().iter().any(|name| name.starts_with(".gumption")));
}

/// A log on a full disk costs the log.
#[cfg(unix)]
#[test]
fn standard_error_that_cannot_be_written_costs_nothing() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = Folder::new();
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for (arguments, code) in [
        // with a note about few trials
        (&["run", "m.json", "--trials", "10000", "--output", "a.txt"][..], 0),
        (&["run", "none.json"], 2),
        (&["run", "m.json", "--output", "none/a.txt"], 2),
        (&["check", "none.json"], 2),
    ] {
        let mut program = command();
        let program = program.current_dir(folder.path()).args(arguments).stderr(full());
        assert_eq!(program.status().unwrap().code(), Some(code), "{arguments:?}");
    }
    assert!(folder.text("a.txt").contains("clause 8"));
}

/// Raw names would be obeyed by the terminal.
#[cfg(unix)]
#[test]
fn names_of_files_reach_the_terminal_without_escape_sequences() {
    let folder = Folder::new();
    let name = "a\u{1b}]0;PWNED\u{7}\u{202e}.json";
    fs::write(folder.path().join(name), MODEL).unwrap();
    fs::write(folder.path().join("b\u{1b}[2J.json"), "{").unwrap();
    fs::write(folder.path().join("c\u{9b}2J.csv"), "label,x1,U1,x2,U2\n\u{1b}[2J,1,1,2,1\n")
        .unwrap();
    for arguments in [
        &["check", name][..],
        &["run", name, "--output", "none/\u{1b}[2J"],
        &["run", name, "--output", name],
        &["check", "b\u{1b}[2J.json"],
        &["check", "b\u{1b}[2J.json", "--format", "json"],
        &["run", "none\u{1b}[2J.json"],
        &["compare", "c\u{9b}2J.csv", "--format", "csv"],
        &["compare", "c\u{9b}2J.csv", "--format", "csv", "--correlations", "\u{1b}[2J"],
        &["run", "m.json", "--set", "\u{1b}[2J=1"],
        &["run", "m.json", "--set", "x=\u{1b}[2J", "--set", "x=1"],
        &["models", "\u{1b}[2J"],
    ] {
        let output = folder.run(arguments);
        for text in [&output.stdout, &output.stderr] {
            let text = String::from_utf8_lossy(text).into_owned();
            let raw = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
            assert!(!text.contains(raw), "{arguments:?}: {text:?}");
        }
    }
}
