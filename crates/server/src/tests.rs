//! The server as a whole, with answers that take as long as a test wants.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::{
    Answers, EvaluatedPage, Exported, FileDescription, LocalServer, NamedFiles, OpenedFolder,
    Refusal, RequestTimes, ServedAsset, ServerOptions, TextOfFile,
};

/// Works until it is stopped, or, where the call says so, far longer.
struct Slow;

/// Longer than any test waits.
const FOR_EVER: Duration = Duration::from_secs(600);

fn until_stopped(stop: &Arc<AtomicBool>) {
    while !stop.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(1));
    }
}

impl Answers for Slow {
    fn version(&self) -> &str {
        "0"
    }

    fn assets(&self) -> &[ServedAsset] {
        &[]
    }

    fn call(
        &self,
        name: &str,
        _: &str,
        _: &NamedFiles<'_>,
        stop: &Arc<AtomicBool>,
    ) -> Result<String, Refusal> {
        match name {
            "deaf" => std::thread::sleep(Duration::from_secs(2)),
            "quick" => {}
            _ => until_stopped(stop),
        }
        Ok(format!("{{\"stopped\": {}}}", stop.load(Ordering::Relaxed)))
    }

    fn describe(&self, _: &str, _: &[u8]) -> FileDescription {
        FileDescription { kind: "model", title: None }
    }

    fn export(&self, _: &TextOfFile, _: &str, stop: &Arc<AtomicBool>) -> Result<Exported, Refusal> {
        until_stopped(stop);
        Err(Refusal::Stopped("it was stopped".to_owned()))
    }

    fn page(
        &self,
        _: &TextOfFile,
        _: &(dyn Fn(f64) + Sync),
        _: &Arc<AtomicBool>,
    ) -> Result<EvaluatedPage, Refusal> {
        Ok(EvaluatedPage { html: String::new(), answer: None })
    }

    fn replace(&self, _: &Path, _: &[u8]) -> io::Result<()> {
        Ok(())
    }
}

/// Head and body of the answer to a request.
fn answered(host: &str, request: &str) -> (String, String) {
    let mut stream = TcpStream::connect(host).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    (head.to_owned(), body.to_owned())
}

/// The status and the body of an answer to the page's own request.
fn asked(address: &str, path: &str, body: &str) -> (String, String) {
    let (host, query) = address.trim_start_matches("http://").split_once('/').unwrap();
    let first = format!("GET /{query} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
    let (welcome, _) = answered(host, &first);
    let header = |name: &str| welcome.lines().find_map(|line| line.strip_prefix(name)).unwrap();
    let (secret, cookie) = (header("location: /#"), header("set-cookie: "));
    let cookie = cookie.split(';').next().unwrap();
    let head = format!(
        "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nConnection: close\r\n\
         Cookie: {cookie}\r\nX-Gumption: {secret}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    );
    let (head, body) = answered(host, &head);
    (head.split(' ').nth(1).unwrap().to_owned(), body)
}

/// An answer that takes too long is what there is when its time is over; an export is refused then; work
/// that does not hear is given up; and others are answered meanwhile.
#[test]
fn requests_end_when_their_time_is_over() {
    let place = tempfile::tempdir().unwrap();
    let serve = |times: RequestTimes| {
        let folder = OpenedFolder::new(place.path()).unwrap();
        let answers = Arc::new(Slow);
        let server =
            LocalServer::bind(ServerOptions { port: 0, folder, language: None, answers, times });
        server.unwrap()
    };
    let short = Duration::from_millis(30);
    let times = RequestTimes { answer: short, export: FOR_EVER, grace: short };
    let stop = Arc::new(AtomicBool::new(false));
    let running = |server: LocalServer| {
        let (address, stop) = (server.address(), Arc::clone(&stop));
        (address, std::thread::spawn(move || server.run(&stop)))
    };
    let (address, thread) = running(serve(times));
    assert_eq!(
        asked(&address, "/api/call/slow", "{}"),
        ("200".into(), "{\"stopped\": true}".into())
    );
    assert_eq!(asked(&address, "/api/call/quick", "{}").1, "{\"stopped\": false}");
    let (status, said) = asked(&address, "/api/call/deaf", "{}");
    assert_eq!(status, "503");
    assert!(said.contains("it took too long and was stopped"), "{said}");
    // an export has a time of its own
    let (other, second) = running(serve(RequestTimes { export: short, grace: FOR_EVER, ..times }));
    let export = "{\"path\": null, \"text\": \"{}\", \"format\": \"json\"}";
    let (status, said) = asked(&other, "/api/export", export);
    assert_eq!((status.as_str(), said.as_str()), ("503", "{\"error\":\"it was stopped\"}"));
    let times = RequestTimes::default();
    assert_eq!((times.answer.as_secs(), times.export.as_secs()), (60, 300));
    stop.store(true, Ordering::Relaxed);
    for thread in [thread, second] {
        thread.join().unwrap().unwrap();
    }
}
