//! `gumption open` as the page uses it.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;

use serde_json::json;

use crate::page_server::{PageServer, head};
#[cfg(unix)]
use crate::process::{Command, ending};
use crate::support::{gumption, root};

const MODEL: &str = r#"{
  // what a comment says stays
  "title": "Length",
  "inputs": {"a": {"unit": "mm", "distribution": "normal", "mean": 1, "std": 0.1}},
  "conditions": {"file": "data/t.csv", "units": {"t": "mm"}},
  "equations": {"y": "a + t"}, "outputs": {"y": {"unit": "mm"}},
  "monte_carlo": {"trials": 1000}
}"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("data")).unwrap();
    fs::write(folder.path().join("data/t.csv"), "t\n1\n2\n").unwrap();
    fs::write(folder.path().join("m.json"), model()).unwrap();
    folder
}

/// The model without the comment, which JSON has not.
fn model() -> String {
    MODEL.replace("  // what a comment says stays\n", "")
}

#[test]
fn the_token_of_the_address_opens_the_page() {
    let folder = folder();
    let server = PageServer::start(folder.path());
    let reply = server.welcome();
    let page = format!("/#{}", server.secret);
    assert_eq!((reply.status, reply.header("location")), (303, Some(page.as_str())));
    let cookie = reply.header("set-cookie").unwrap();
    for needed in ["HttpOnly", "SameSite=Strict", "Path=/"] {
        assert!(cookie.contains(needed), "{cookie}");
    }
    let cookie = cookie.split(';').next().unwrap().to_owned();
    let headers = [("Host".to_owned(), server.host()), ("Cookie".to_owned(), cookie)];
    let hello = server.ask("GET /api/hello", &headers, None);
    assert_eq!(hello.status, 200, "{}", hello.text());
    assert_eq!(hello.json()["version"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn files_are_listed_opened_and_saved() {
    let folder = folder();
    let server = PageServer::with(&folder.path().join("m.json"), &["--lang", "de"]);
    assert_eq!(server.get("/api/hello").json()["lang"], "de");
    let files = server.post("/api/files", &json!({})).json();
    assert_eq!(files["open"], "m.json");
    let listed = &files["files"][0];
    assert_eq!((&listed["path"], &listed["kind"]), (&json!("m.json"), &json!("model")));
    assert_eq!(listed["title"], "Length");

    let opened = server.post("/api/open", &json!({"path": "m.json"})).json();
    assert_eq!(opened["text"], model());
    let changed = model().replace("\"Length\"", "\"Länge\"");
    let wish = json!({"path": "m.json", "text": changed, "version": opened["version"]});
    let saved = server.post("/api/save", &wish);
    assert_eq!(saved.status, 200, "{}", saved.text());
    assert_eq!(fs::read_to_string(folder.path().join("m.json")).unwrap(), changed);
    // the version that was seen first is gone
    let again = server.post("/api/save", &wish);
    assert_eq!(again.status, 409);
    assert_eq!(again.json()["text"], changed);
    assert_eq!(again.json()["version"], saved.json()["version"]);
    // a new file where none is, and only there
    let new = json!({"path": "data/new.json", "text": "{}", "version": null});
    assert_eq!(server.post("/api/save", &new).status, 200);
    assert_eq!(server.post("/api/save", &new).status, 409);
    // a file that was removed meanwhile
    let gone = json!({"path": "no.json", "text": "{}", "version": saved.json()["version"]});
    let gone = server.post("/api/save", &gone);
    assert_eq!((gone.status, &gone.json()["text"]), (409, &json!(null)));
}

#[cfg(unix)]
#[test]
fn a_saved_file_keeps_its_mode_and_a_link_its_target() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let file = folder.path().join("m.json");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("m.json", folder.path().join("link.json")).unwrap();
    let server = PageServer::start(folder.path());
    let version = server.post("/api/open", &json!({"path": "link.json"})).json();
    let wish = json!({"path": "link.json", "text": "{}", "version": version["version"]});
    assert_eq!(server.post("/api/save", &wish).status, 200);
    assert_eq!(fs::read_to_string(&file).unwrap(), "{}");
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(folder.path().join("link.json").symlink_metadata().unwrap().is_symlink());
}

/// Each of two servers saves over what it has seen last, a hundred times at once: every change that
/// was taken is in the file in the end.
#[test]
fn two_servers_on_one_folder_lose_no_change() {
    let folder = folder();
    fs::write(folder.path().join("n.json"), "").unwrap();
    let servers = [PageServer::start(folder.path()), PageServer::start(folder.path())];
    let add = |server: &PageServer, mark: char| {
        let mut taken = 0;
        while taken < 25 {
            let opened = server.post("/api/open", &json!({"path": "n.json"})).json();
            let text = format!("{}{mark}", opened["text"].as_str().unwrap());
            let wish = json!({"path": "n.json", "text": text, "version": opened["version"]});
            match server.post("/api/save", &wish).status {
                200 => taken += 1,
                409 => {}
                status => panic!("{status}"),
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| add(&servers[0], 'a'));
        scope.spawn(|| add(&servers[1], 'b'));
        scope.spawn(|| add(&servers[1], 'c'));
    });
    let text = fs::read_to_string(folder.path().join("n.json")).unwrap();
    for mark in ['a', 'b', 'c'] {
        assert_eq!(text.matches(mark).count(), 25, "{text}");
    }
    assert_eq!(names(folder.path()), ["data", "m.json", "n.json"]);
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_change_on_the_disk_is_told() {
    let folder = folder();
    let server = PageServer::start(folder.path());
    server.post("/api/open", &json!({"path": "m.json"}));
    let mut stream = server.connect();
    stream.write_all(head("GET /api/events", &server.own(), None).as_bytes()).unwrap();
    let mut lines = BufReader::new(stream).lines().map(Result::unwrap);
    assert!(lines.by_ref().any(|line| line == ": watching"));
    fs::write(folder.path().join("m.json"), "{}").unwrap();
    let event = lines.by_ref().find(|line| line.starts_with("event:")).unwrap();
    assert_eq!(event, "event: changed");
    let data = lines.next().unwrap();
    let data: serde_json::Value =
        serde_json::from_str(data.strip_prefix("data: ").unwrap()).unwrap();
    assert_eq!(data["path"], "m.json");
    let opened = server.post("/api/open", &json!({"path": "m.json"})).json();
    assert_eq!(data["version"], opened["version"]);
}

#[test]
fn exports_are_those_of_the_command_line() {
    let folder = folder();
    let server = PageServer::start(folder.path());
    let of_command = |format: &str| {
        let mut run = gumption();
        run.current_dir(folder.path()).args(["run", "m.json", "--format", format]);
        run.assert().success().get_output().stdout.clone()
    };
    for (format, name) in [("html", "m.html"), ("csv", "m.csv"), ("json", "m.json")] {
        let wish = json!({"path": "m.json", "text": model(), "format": format});
        let reply = server.post("/api/export", &wish);
        assert_eq!(reply.status, 200, "{}", reply.text());
        assert_eq!(reply.body, of_command(format), "{format}");
        let disposition = reply.header("content-disposition").unwrap();
        assert!(disposition.contains(&format!("attachment; filename=\"{name}\"")), "{disposition}");
    }
    let wish = json!({"path": "m.json", "text": model(), "format": "xlsx"});
    assert!(server.post("/api/export", &wish).body.starts_with(b"PK"));
    let one_row = model()
        .replace("\"conditions\": {\"file\": \"data/t.csv\", \"units\": {\"t\": \"mm\"}},", "")
        .replace("a + t", "2*a");
    let wish = json!({"path": "m.json", "text": one_row, "format": "result"});
    let saved = server.post("/api/export", &wish);
    assert_eq!(saved.json()["format"], 1, "{}", saved.text());

    // mistakes are told in the words of the command line, and at their place
    let wrong = model().replace("\"mm\", \"distribution\"", "\"mmm\", \"distribution\"");
    let wish = json!({"path": "m.json", "text": wrong, "format": "html"});
    let reply = server.post("/api/export", &wish);
    assert_eq!(reply.status, 422);
    assert!(reply.json()["error"].as_str().unwrap().contains("m.json:3:"), "{}", reply.text());
    let wish = json!({"path": "m.json", "text": model(), "format": "docx"});
    assert_eq!(server.post("/api/export", &wish).status, 400);
}

/// The call that follows the typing: a model as it stands on the page, with the table beside it.
#[test]
fn a_model_is_answered_while_it_is_edited() {
    let folder = folder();
    let server = PageServer::start(folder.path());
    let wish = json!({"text": model(), "name": "m.json"});
    let reply = server.post("/api/call/answer?path=m.json", &wish);
    assert_eq!(reply.status, 200, "{}", reply.text());
    assert_eq!(reply.json()["diagnostics"].as_array().map(Vec::len), Some(0), "{}", reply.text());
    let wrong = json!({"text": model().replace("a + t", "a + s"), "name": "m.json"});
    let reply = server.post("/api/call/answer?path=m.json", &wrong);
    assert_eq!(reply.status, 200, "{}", reply.text());
    assert!(!reply.json()["diagnostics"].as_array().unwrap().is_empty(), "{}", reply.text());
    // the same table from another folder
    let reply = server.post("/api/call/answer?path=data%2Fm.json", &wish);
    assert!(reply.text().contains("there is no such file"), "{}", reply.text());
    assert_eq!(server.post("/api/call/none", &json!({})).status, 404);
    assert_eq!(server.post("/api/call/answer", &json!([1])).status, 400);
}

/// A case, a certificate, a recipe and a table of results are shown as the pages of the reports, each
/// under a policy that lets it do nothing.
#[test]
fn pages_of_other_files_are_shown_in_a_sandbox() {
    let examples = [
        ("models/gap/sampling_rate", "case.json"),
        ("models", "certificates/three_axis_accelerometer.json"),
        ("models/examples", "results.csv"),
    ];
    for (folder, name) in examples {
        let folder = root().join(folder);
        let text = fs::read_to_string(folder.join(name)).expect(name);
        let server = PageServer::start(&folder);
        let reply = server.post("/api/page", &json!({"path": name, "text": text}));
        assert_eq!(reply.status, 200, "{name}: {}", reply.text());
        let answer = reply.json();
        let html = answer["html"].as_str().unwrap();
        assert!(html.starts_with("<!DOCTYPE html>"), "{name}");
        let shown = server.get(&format!("/{}", answer["address"].as_str().unwrap()));
        assert_eq!(shown.text(), html);
        // what a diagnosis proposes comes with its page
        assert_eq!(answer["answer"]["verdict"].is_object(), name == "case.json", "{name}");
        let policy = shown.header("content-security-policy").unwrap();
        // of the page's origin, which keeps its place, and without scripts
        assert!(policy.starts_with("sandbox allow-same-origin; default-src 'none';"), "{policy}");
        assert!(!policy.contains("script"), "{policy}");
    }
}

#[cfg(unix)]
#[test]
fn signals_end_it_cleanly() {
    for (name, _) in ending(&[("-INT", 0), ("-TERM", 0), ("-HUP", 0)]) {
        let folder = folder();
        let server = PageServer::start(folder.path());
        // also while a page listens
        let mut stream = server.connect();
        stream.write_all(head("GET /api/events", &server.own(), None).as_bytes()).unwrap();
        let kill = Command::new("kill").args([name, &server.id().to_string()]).status();
        assert!(kill.unwrap().success());
        assert_eq!(server.ended(), Some(0), "{name}");
        assert_eq!(names(folder.path()), ["data", "m.json"]);
    }
}

/// Well below the 50 MB that an idle server may have.
#[cfg(target_os = "linux")]
#[test]
fn an_idle_server_is_small_and_a_used_one_does_not_grow() {
    let folder = folder();
    let server = PageServer::start(folder.path());
    let memory = || {
        let status = fs::read_to_string(format!("/proc/{}/status", server.id())).unwrap();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
        line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() / 1024
    };
    let idle = memory();
    assert!(idle < 50, "{idle} MB");
    let wish = json!({"path": "m.json", "text": model(), "format": "html"});
    let work = |times: usize| {
        (0..times).for_each(|_| {
            assert_eq!(server.post("/api/export", &wish).status, 200);
        })
    };
    work(20);
    let before = memory();
    work(60);
    let after = memory();
    assert!(after < before + 16 && after < 150, "{idle}, {before} and {after} MB");
}

#[test]
fn what_cannot_be_opened_is_said() {
    let refused = |arguments: &[&str], code: i32| {
        let assert = gumption().arg("open").args(arguments).assert().code(code);
        String::from_utf8_lossy(&assert.get_output().stderr).into_owned()
    };
    let said = refused(&["no/such/file.json"], 2);
    assert!(said.contains("`no/such/file.json`: there is no folder `no`"), "{said}");
    let folder = folder();
    let server = PageServer::start(folder.path());
    let said = refused(&["models", "--no-browser", "--port", &server.port.to_string()], 1);
    assert!(said.contains("another program uses it"), "{said}");
    refused(&["--port", "65536"], 2);
    refused(&["--lang", "fr"], 2);
}
