//! The calls: those of the live page, and those that a server would answer.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gumption::Application;
use gumption_command::{ExportedAnswer, GivenFile, NotExported};
use gumption_files::TextKind;
use gumption_live::{FileDescription, HeldFiles, LiveError};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// Why there is no answer.
pub(crate) enum Fault {
    /// The request.
    Request(String),
    /// The text, or a file that it names: the mistakes as the page lists them.
    Mistakes(Value, String),
    /// The program.
    Program(String),
}

/// A text with its name.
#[derive(Deserialize)]
struct Text {
    text: String,
    name: String,
    #[serde(default)]
    format: String,
}

/// A number of trials.
#[derive(Deserialize)]
struct Compared {
    #[serde(default)]
    trials: Option<u64>,
}

impl Fault {
    /// The status of the answer, and the answer.
    pub(crate) fn told(&self) -> (u32, String) {
        match self {
            Self::Request(message) => (1, json!({ "error": message }).to_string()),
            Self::Mistakes(list, message) => {
                (1, json!({ "error": message, "diagnostics": list }).to_string())
            }
            Self::Program(message) => (2, json!({ "error": message }).to_string()),
        }
    }
}

fn asked<T: DeserializeOwned>(request: &str) -> Result<T, Fault> {
    serde_json::from_str(request).map_err(|why| Fault::Request(format!("the request: {why}")))
}

/// The answer to a call.
pub(crate) fn answer(
    name: &str,
    request: &str,
    held: &[(String, Vec<u8>)],
) -> Result<String, Fault> {
    let program = Application::new();
    match name {
        "hello" => Ok(json!({ "version": env!("CARGO_PKG_VERSION"), "lang": null }).to_string()),
        // the files that were handed over, as a server lists those of its folder
        "files" => {
            let listed = held.iter().map(|(path, content)| {
                let FileDescription { kind, title } = FileDescription::of(path, content);
                json!({ "path": path, "kind": kind, "title": title })
            });
            let files: Vec<Value> = listed.collect();
            Ok(json!({ "root": "", "files": files, "open": null, "more": false }).to_string())
        }
        // the published values, recomputed here
        "verify" => command(&program, &["verify", "--format", "json", "--quiet"]),
        // the hash over all trials, to be compared with `gumption verify --paths`
        "paths" => {
            let Compared { trials } = asked(request)?;
            let trials = trials.unwrap_or(1_000_000).to_string();
            let said = command(&program, &["verify", "--paths", "--trials", &trials])?;
            let paths: Vec<Value> = said
                .lines()
                .filter_map(|line| line.split_once(' '))
                .map(|(path, hash)| json!({ "path": path, "hash": hash.trim() }))
                .take(1)
                .collect();
            Ok(json!({ "paths": paths, "text": said }).to_string())
        }
        "export" => {
            let Text { text, name, format } = asked(request)?;
            let ExportedAnswer { content, content_type, name } =
                exported(&program, text, name, &format, held)?;
            let base64 = STANDARD.encode(content);
            Ok(json!({ "base64": base64, "contentType": content_type, "name": name }).to_string())
        }
        "page" => {
            let Text { text, name, .. } = asked(request)?;
            page(&program, text, name, held)
        }
        other => {
            // the request holds the text, in which quotes are escaped
            let files = HeldFiles(held.to_vec()).named_in(&request.replace('\\', ""));
            let stop = Arc::new(AtomicBool::new(false));
            let called = program.command_line().live().call(other, request, &files, &stop);
            called.map_err(|error| match error {
                LiveError::Internal(message) => Fault::Program(message),
                other => Fault::Request(other.to_string()),
            })
        }
    }
}

/// What a command prints.
fn command(program: &Application, arguments: &[&str]) -> Result<String, Fault> {
    let answered = program
        .call(arguments.iter().map(Into::into), None, Arc::default())
        .map_err(|failure| Fault::Program(failure.to_string()))?;
    String::from_utf8(answered.answer).map_err(|error| Fault::Program(error.to_string()))
}

fn exported(
    program: &Application,
    text: String,
    name: String,
    format: &str,
    held: &[(String, Vec<u8>)],
) -> Result<ExportedAnswer, Fault> {
    let given = given(text, name, held);
    let own = given.text.clone();
    let made = program.command_line().exported(given, format, &Arc::default());
    made.map_err(|why| fault(why, &own))
}

/// The page of a text; that of a case with the answer for programs.
fn page(
    program: &Application,
    text: String,
    name: String,
    held: &[(String, Vec<u8>)],
) -> Result<String, Fault> {
    if TextKind::of(&text) == TextKind::Case {
        let given = given(text, name, held);
        let found = program.command_line().diagnosed(&given, &|_| {}, &Arc::default());
        let found = found.map_err(|why| fault(why, &given.text))?;
        let answer: Value =
            serde_json::from_str(&found.json).map_err(|error| Fault::Program(error.to_string()))?;
        return Ok(json!({ "html": found.html, "answer": answer }).to_string());
    }
    let page = exported(program, text, name, "html", held)?;
    Ok(json!({ "html": String::from_utf8_lossy(&page.content) }).to_string())
}

fn given(text: String, name: String, held: &[(String, Vec<u8>)]) -> GivenFile {
    let held = HeldFiles(held.to_vec()).named_in(&text).0;
    GivenFile { name, text, held, ..GivenFile::default() }
}

fn fault(why: NotExported, text: &str) -> Fault {
    match why {
        NotExported::Mistakes(found) => {
            let message = found.0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
            Fault::Mistakes(gumption_live::mistakes(text, &found), message)
        }
        NotExported::System(message) => Fault::Program(message),
        NotExported::Format(message)
        | NotExported::Content(message)
        | NotExported::Stopped(message) => Fault::Request(message),
        _ => Fault::Program("nothing was exported".to_owned()),
    }
}
