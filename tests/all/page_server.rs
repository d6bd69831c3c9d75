//! A running `gumption open`, and a client that says exactly what it is told to.

use std::io::{BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{ChildStdout, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::process::{Child, first_line};
use crate::support::command;

/// How long a test waits for the server before it fails.
pub(crate) const PATIENCE: Duration = Duration::from_secs(120);

/// The server, ended when it is dropped.
pub(crate) struct PageServer {
    child: Child,
    _stdout: BufReader<ChildStdout>,
    pub(crate) port: u16,
    pub(crate) token: String,
    /// Name and value.
    pub(crate) cookie: String,
    /// The secret of the page.
    pub(crate) secret: String,
}

/// An answer as it came.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Reply {
    /// The first value of a header.
    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        let named = |line: &'_ &str| {
            line.split_once(':').is_some_and(|(of, _)| of.eq_ignore_ascii_case(name))
        };
        self.head.lines().find(named).and_then(|line| line.split_once(':')).map(|(_, v)| v.trim())
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|_| panic!("{}", self.text()))
    }
}

impl PageServer {
    pub(crate) fn start(path: &Path) -> Self {
        Self::with(path, &[])
    }

    pub(crate) fn with(path: &Path, arguments: &[&str]) -> Self {
        let mut program = command();
        program.arg("open").arg(path).arg("--no-browser").args(arguments);
        program.stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = program.spawn().expect("the program starts");
        let (line, stdout) = first_line(child.stdout.take().expect("its output"));
        let address = line.trim().strip_prefix("http://127.0.0.1:").expect("an address");
        let (port, token) = address.split_once("/?token=").expect("a token");
        let (port, token) = (port.parse().expect("a port"), token.to_owned());
        let (cookie, secret) = (String::new(), String::new());
        let mut server = Self { child, _stdout: stdout, port, token, cookie, secret };
        let welcome = server.welcome();
        let cookie = welcome.header("set-cookie").and_then(|cookie| cookie.split(';').next());
        server.cookie = cookie.expect("a cookie").to_owned();
        let page = welcome.header("location").and_then(|to| to.strip_prefix("/#"));
        server.secret = page.expect("a secret").to_owned();
        server
    }

    /// What the printed address is answered.
    pub(crate) fn welcome(&self) -> Reply {
        let headers = [("Host".to_owned(), self.host())];
        self.ask(&format!("GET /?token={}", self.token), &headers, None)
    }

    #[cfg(unix)]
    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits for its end, and gives its exit code.
    #[cfg(unix)]
    pub(crate) fn ended(mut self) -> Option<i32> {
        self.child.wait().expect("an end").code()
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time limit");
        stream.set_write_timeout(Some(PATIENCE)).expect("a time limit");
        stream
    }

    pub(crate) fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    /// The headers of the page's own requests.
    pub(crate) fn own(&self) -> Vec<(String, String)> {
        let host = self.host();
        [
            ("Host", host.clone()),
            ("Origin", format!("http://{host}")),
            ("Sec-Fetch-Site", "same-origin".to_owned()),
            ("Cookie", format!("other=1; {}", self.cookie)),
            ("X-Gumption", self.secret.clone()),
            ("Content-Type", "application/json".to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }

    /// The page's own headers with some in their place, or, with an empty value, without them.
    pub(crate) fn own_but(&self, changed: &[(&str, &str)]) -> Vec<(String, String)> {
        let mut headers = self.own();
        headers.retain(|(name, _)| !changed.iter().any(|(of, _)| of == name));
        let added = changed.iter().filter(|(_, value)| !value.is_empty());
        headers.extend(added.map(|(name, value)| ((*name).to_owned(), (*value).to_owned())));
        headers
    }

    /// A request with these headers.
    pub(crate) fn ask(
        &self,
        request: &str,
        headers: &[(String, String)],
        body: Option<&str>,
    ) -> Reply {
        let mut stream = self.connect();
        stream.write_all(head(request, headers, body.map(str::len)).as_bytes()).expect("sent");
        // who is refused early need not hear the rest
        let _ = stream.write_all(body.unwrap_or("").as_bytes());
        reply(stream)
    }

    pub(crate) fn get(&self, path: &str) -> Reply {
        self.ask(&format!("GET {path}"), &self.own(), None)
    }

    pub(crate) fn post(&self, path: &str, body: &Value) -> Reply {
        self.ask(&format!("POST {path}"), &self.own(), Some(&body.to_string()))
    }
}

impl Drop for PageServer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The head of a request that is the last one of its connection.
pub(crate) fn head(request: &str, headers: &[(String, String)], length: Option<usize>) -> String {
    let mut head = format!("{request} HTTP/1.1\r\nConnection: close\r\n");
    for (name, value) in headers {
        head += &format!("{name}: {value}\r\n");
    }
    if let Some(length) = length {
        head += &format!("Content-Length: {length}\r\n");
    }
    head + "\r\n"
}

/// What comes until the connection is closed.
pub(crate) fn reply(mut stream: TcpStream) -> Reply {
    let mut bytes = Vec::new();
    // a connection that is reset after the answer has given the answer
    let _ = stream.read_to_end(&mut bytes);
    let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap_or(bytes.len());
    let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    let rest = bytes.get(end + 4..).unwrap_or(&[]);
    let chunked = head.to_ascii_lowercase().contains("transfer-encoding: chunked");
    let body = if chunked { whole(rest) } else { rest.to_vec() };
    Reply { status, head, body }
}

/// The chunks of a body put together.
fn whole(mut rest: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    while let Some(end) = rest.windows(2).position(|two| two == b"\r\n") {
        let length = std::str::from_utf8(&rest[..end]).ok();
        let Some(length) = length.and_then(|text| usize::from_str_radix(text, 16).ok()) else {
            break;
        };
        let (from, to) = (end + 2, end + 2 + length);
        if length == 0 || to > rest.len() {
            break;
        }
        body.extend_from_slice(&rest[from..to]);
        rest = rest.get(to + 2..).unwrap_or(&[]);
    }
    body
}
