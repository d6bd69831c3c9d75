//! Attacks on a running `gumption open`: from other sites in the same browser, from other users of
//! the machine, and from model files of strangers.

use std::fs;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::page_server::{PageServer, head, reply};

const MODEL: &str = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1}},
    "equations": {"y": "x*x"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 1000}}"#;

/// A folder `own` with a model, and a secret beside it.
fn place() -> (tempfile::TempDir, PageServer) {
    let place = tempfile::tempdir().unwrap();
    fs::create_dir_all(place.path().join("own/below")).unwrap();
    fs::write(place.path().join("own/m.json"), MODEL).unwrap();
    fs::write(place.path().join("secret.json"), "{\"secret\": 1}").unwrap();
    let server = PageServer::start(&place.path().join("own"));
    (place, server)
}

#[test]
fn it_listens_on_the_loopback_interface_alone() {
    let (_place, server) = place();
    // the port is free on every other address of the machine: all of 127/8 are this machine
    assert!(TcpStream::connect(("127.0.0.2", server.port)).is_err());
    assert!(TcpListener::bind(("127.0.0.2", server.port)).is_ok());
    assert!(TcpStream::connect(("::1", server.port)).is_err());
}

#[test]
fn other_hosts_are_refused() {
    let (_place, server) = place();
    let port = server.port;
    let with = |host: &str| {
        let origin = format!("http://{host}");
        server.ask("GET /api/hello", &server.own_but(&[("Host", host), ("Origin", &origin)]), None)
    };
    for host in [
        "evil.example".to_owned(),
        format!("evil.example:{port}"),
        format!("127.0.0.1.evil.example:{port}"),
        format!("127.0.0.2:{port}"),
        format!("0.0.0.0:{port}"),
        format!("127.1:{port}"),
        "127.0.0.1".to_owned(),
        format!("127.0.0.1:{}", port ^ 1),
        format!("localhost.:{port}"),
        format!("user@127.0.0.1:{port}"),
    ] {
        assert_eq!(with(&host).status, 403, "{host}");
    }
    assert_eq!(with(&format!("localhost:{port}")).status, 200);
    // none at all, and two of them
    assert_ne!(server.ask("GET /api/hello", &server.own_but(&[("Host", "")]), None).status, 200);
    let mut two = server.own();
    two.push(("Host".to_owned(), "evil.example".to_owned()));
    assert_ne!(server.ask("GET /api/hello", &two, None).status, 200);
    // the form for proxies
    let absolute = format!("GET http://evil.example:{port}/api/hello");
    assert_ne!(server.ask(&absolute, &server.own(), None).status, 200);
}

#[test]
fn other_sites_are_refused() {
    let (_place, server) = place();
    let port = server.port;
    let body = json!({"path": "m.json", "text": "{}", "version": null}).to_string();
    let with = |changed: &[(&str, &str)]| {
        server.ask("POST /api/open", &server.own_but(changed), Some(&body)).status
    };
    assert_eq!(with(&[]), 200);
    let origins = [
        "http://evil.example".to_owned(),
        format!("http://localhost:{port}"),
        format!("https://127.0.0.1:{port}"),
        format!("http://127.0.0.1:{}", port ^ 1),
        "null".to_owned(),
        "file://".to_owned(),
    ];
    for origin in &origins {
        assert_eq!(with(&[("Origin", origin)]), 403, "{origin}");
    }
    for site in ["cross-site", "same-site", "none", "x"] {
        assert_eq!(with(&[("Sec-Fetch-Site", site)]), 403, "{site}");
    }
    // forms and simple requests, which a browser sends without asking first
    assert_eq!(with(&[("X-Gumption", "")]), 403);
    assert_eq!(with(&[("Content-Type", "text/plain")]), 415);
    assert_eq!(with(&[("Content-Type", "application/x-www-form-urlencoded")]), 415);
    // asking first is refused as well
    let preflight = [
        ("Origin", "http://evil.example"),
        ("Access-Control-Request-Method", "POST"),
        ("Access-Control-Request-Headers", "x-gumption"),
    ];
    let reply = server.ask("OPTIONS /api/open", &server.own_but(&preflight), None);
    assert_eq!(reply.status, 403);
    assert!(!reply.head.to_ascii_lowercase().contains("access-control"), "{}", reply.head);
    // a link of another site, also to the page and with the token
    for path in ["/".to_owned(), format!("/?token={}", server.token)] {
        let headers = server.own_but(&[("Origin", ""), ("Sec-Fetch-Site", "cross-site")]);
        assert_eq!(server.ask(&format!("GET {path}"), &headers, None).status, 403, "{path}");
    }
}

#[test]
fn without_the_token_there_is_nothing() {
    let (_place, server) = place();
    let port = server.port;
    let wrong = "0".repeat(64);
    let short = server.token[..63].to_owned();
    let value = server.cookie.split_once('=').unwrap().1;
    let cookies = [
        String::new(),
        format!("gumption-{port}="),
        format!("gumption-{port}={wrong}"),
        format!("gumption-{port}={short}"),
        format!("gumption-{}={value}", port ^ 1),
        format!("gumption={value}"),
        // the address's token is not the cookie's
        format!("gumption-{port}={}", server.token),
    ];
    for cookie in &cookies {
        for request in
            ["GET /", "GET /assets/page.js", "GET /api/hello", "GET /api/events", "GET /no"]
        {
            let headers = server.own_but(&[("Cookie", cookie)]);
            assert_eq!(server.ask(request, &headers, None).status, 401, "{request} {cookie}");
        }
        let headers = server.own_but(&[("Cookie", cookie)]);
        assert_eq!(server.ask("POST /api/files", &headers, Some("{}")).status, 401, "{cookie}");
    }
    for query in ["token=", &format!("token={wrong}"), &format!("token={short}")] {
        let reply = server.get(&format!("/?{query}"));
        assert_eq!(reply.status, 401, "{query}");
        assert_eq!(reply.header("set-cookie"), None);
    }
    // the token opens the page, and nothing else
    let headers = server.own_but(&[("Cookie", "")]);
    let reply = server.ask(&format!("GET /api/hello?token={}", server.token), &headers, None);
    assert_eq!(reply.status, 401);
}

/// A browser sends the cookie to every port of the machine. Who has got it so can read the files of the
/// page, which are the same everywhere, and nothing of the folder; and nothing that he can read has the
/// secret that asking and writing needs.
#[test]
fn the_cookie_alone_asks_and_writes_nothing() {
    let (place, server) = place();
    let stolen = |request: &str, header: &str, body: Option<&str>| {
        server.ask(request, &server.own_but(&[("X-Gumption", header)]), body)
    };
    let value = server.cookie.split_once('=').unwrap().1.to_owned();
    let wish = json!({"path": "m.json", "text": "stolen", "version": null}).to_string();
    for header in ["", "1", &value, &server.token, &server.secret[1..]] {
        for path in ["files", "open", "save", "call/answer", "export", "page"] {
            let reply = stolen(&format!("POST /api/{path}"), header, Some(&wish));
            assert_eq!(reply.status, 403, "{path} {header}: {}", reply.text());
            assert!(reply.text().contains("has printed"), "{}", reply.text());
        }
        for path in ["/", "/assets/page.js", "/api/hello", &format!("/?token={value}")] {
            let reply = stolen(&format!("GET {path}"), header, None);
            let all = format!("{}{}", reply.head, reply.text());
            for secret in [&server.secret, &server.token] {
                assert!(!all.contains(secret.as_str()), "{path}");
            }
        }
    }
    assert_eq!(server.get(&format!("/?token={value}")).status, 401);
    assert_eq!(fs::read_to_string(place.path().join("own/m.json")).unwrap(), MODEL);
    assert_eq!(server.post("/api/open", &json!({"path": "m.json"})).status, 200);
}

#[test]
fn no_path_leads_out_of_the_folder() {
    let (place, server) = place();
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(place.path().join("secret.json"), place.path().join("own/link.json")).unwrap();
        symlink(place.path(), place.path().join("own/up")).unwrap();
        symlink(place.path().join("later.json"), place.path().join("own/later.json")).unwrap();
    }
    let absolute = place.path().join("secret.json").to_str().unwrap().to_owned();
    let mut paths = vec![
        "../secret.json",
        "below/../../secret.json",
        "./../secret.json",
        "..\\secret.json",
        "%2e%2e/secret.json",
        "below//../../secret.json",
        "/etc/passwd",
        "//etc/passwd",
        "C:\\secret.json",
        "C:secret.json",
        "\\\\127.0.0.1\\c$\\secret.json",
        "\\\\?\\C:\\secret.json",
        "m.json\0.txt",
        "m.json\n",
        "NUL",
        "con.json",
        "COM1.json",
        "m.json::$DATA",
        "m.json.",
        "m.json ",
        "",
        ".",
        "..",
        &absolute,
    ];
    if cfg!(unix) {
        paths.extend(["link.json", "up/secret.json", "later.json", "up/new.json"]);
    }
    for path in paths {
        let opened = server.post("/api/open", &json!({"path": path}));
        assert!([403, 404].contains(&opened.status), "{path}: {}", opened.text());
        assert!(!opened.text().contains("secret\\\""), "{path}");
        for wish in [json!(null), json!("0")] {
            let wish = json!({"path": path, "text": "stolen", "version": wish});
            let saved = server.post("/api/save", &wish);
            assert!([403, 404, 409].contains(&saved.status), "{path}: {}", saved.text());
            assert_ne!((path, saved.status), ("later.json", 409));
        }
        let wish = json!({"path": path, "text": "{}"});
        if !path.is_empty() && path != "%2e%2e/secret.json" {
            let page = server.post("/api/page", &wish);
            assert!([403, 404].contains(&page.status), "{path}: {}", page.text());
        }
    }
    // the address itself
    for path in ["/assets/../api/hello/../../m.json", "/assets/..%2f..%2fm.json", "/../m.json"] {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    // hidden files and programs are not written, although they are below the folder
    for path in [".profile", ".git/config.json", "below/.x.json", "run.sh", "m.json.exe"] {
        let wish = json!({"path": path, "text": "x", "version": null});
        assert_eq!(server.post("/api/save", &wish).status, 403, "{path}");
    }
    assert_eq!(fs::read_to_string(place.path().join("secret.json")).unwrap(), "{\"secret\": 1}");
    let left = fs::read_dir(place.path()).unwrap().count();
    assert_eq!(left, 2, "nothing beside the folder and the secret");
}

/// What a model names is looked for below its folder.
#[test]
fn a_model_names_no_file_elsewhere() {
    let (place, server) = place();
    fs::write(place.path().join("secret.csv"), "t\n12345.678\n").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("../secret.csv", place.path().join("own/link.csv")).unwrap();
    let absolute = place.path().join("secret.csv").to_str().unwrap().to_owned();
    for name in ["../secret.csv", "below/../../secret.csv", "link.csv", &absolute] {
        let model = json!({
            "inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1}},
            "conditions": {"file": name, "units": {"t": "1"}},
            "equations": {"y": "x*t"}, "outputs": {"y": {}}, "monte_carlo": {"trials": 0},
        });
        let wish = json!({"path": "m.json", "text": model.to_string(), "format": "json"});
        let reply = server.post("/api/export", &wish);
        assert_eq!(reply.status, 422, "{name}: {}", reply.text());
        assert!(!reply.text().contains("12345"), "{name}: {}", reply.text());
        let wish = json!({"text": model.to_string(), "name": "m.json"});
        for path in ["", "?path=m.json", "?path=below/m.json"] {
            let reply = server.post(&format!("/api/call/answer{path}"), &wish);
            assert!(!reply.text().contains("12345"), "{name}: {}", reply.text());
            assert_ne!(reply.json()["diagnostics"], json!([]), "{name}: {}", reply.text());
        }
        for path in ["../m.json", "/etc/m.json"] {
            let reply = server.post(&format!("/api/call/answer?path={path}"), &wish);
            assert_eq!(reply.status, 403, "{path}: {}", reply.text());
        }
    }
}

/// A body of 1 GB is cut off at its head; one that does not say its length, when it is too long.
#[test]
fn a_body_of_a_gigabyte_is_cut_off() {
    let (_place, server) = place();
    let mut stream = server.connect();
    stream
        .write_all(head("POST /api/call/answer", &server.own(), Some(1_000_000_000)).as_bytes())
        .unwrap();
    assert_eq!(reply(stream).status, 413);

    let mut stream = server.connect();
    let mut headers = server.own();
    headers.push(("Transfer-Encoding".to_owned(), "chunked".to_owned()));
    stream.write_all(head("POST /api/call/answer", &headers, None).as_bytes()).unwrap();
    let chunk = [format!("{:x}\r\n", 1 << 20).into_bytes(), vec![b' '; 1 << 20], b"\r\n".to_vec()];
    let chunk = chunk.concat();
    let mut sent = 0;
    while sent < 1000 && stream.write_all(&chunk).is_ok() {
        sent += 1;
    }
    assert!(sent < 100, "{sent} MB were taken");
    assert_eq!(server.get("/api/hello").status, 200);

    let long = "x".repeat(1 << 20);
    let reply = server.ask("GET /api/hello", &server.own_but(&[("X-Long", &long)]), None);
    assert!([431, 0].contains(&reply.status), "{}", reply.status);
}

#[test]
fn a_trillion_trials_are_refused() {
    let (_place, server) = place();
    let model = MODEL.replace("1000", "1000000000000");
    for (path, wish) in [
        ("/api/export", json!({"path": "m.json", "text": model, "format": "html"})),
        ("/api/page", json!({"path": "m.json", "text": model})),
    ] {
        let begun = Instant::now();
        let reply = server.post(path, &wish);
        assert_eq!(reply.status, 422, "{}", reply.text());
        assert!(reply.text().contains("the file states"), "{}", reply.text());
        assert!(begun.elapsed() < Duration::from_secs(60));
    }
    let wish =
        json!({"text": model, "name": "m.json", "trials": 1_000_000_000_000_u64, "full": true});
    let reply = server.post("/api/call/answer?path=m.json", &wish);
    // what is shown while one edits is as many as the page makes, and says how many that are
    assert_eq!(reply.status, 200);
    assert_eq!(reply.json()["diagnostics"], json!([]));
}

/// Exports that take minutes go on while others are answered, and end when those who asked have gone.
#[test]
fn slow_requests_block_nobody() {
    let (_place, server) = place();
    let slow = MODEL.replace("1000", "2000000000").replace("x*x", "sin(x)*exp(x)+cos(x)^3");
    let wish = json!({"path": "m.json", "text": slow, "format": "json"}).to_string();
    let ask = || {
        let mut stream = server.connect();
        let head = head("POST /api/export", &server.own(), Some(wish.len()));
        stream.write_all(head.as_bytes()).unwrap();
        stream.write_all(wish.as_bytes()).unwrap();
        stream
    };
    let waiting = [ask(), ask()];
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(server.post("/api/open", &json!({"path": "m.json"})).status, 200);
    drop(waiting);
    // both places are free again
    let quick = json!({"path": "m.json", "text": MODEL, "format": "csv"});
    assert_eq!(server.post("/api/export", &quick).status, 200);
}

/// A thousand connections that say nothing, or half a head, take nobody's place.
#[test]
fn a_thousand_connections_exhaust_nothing() {
    let (_place, server) = place();
    let mut held = Vec::new();
    for number in 0..1000 {
        let Ok(mut stream) = TcpStream::connect(("127.0.0.1", server.port)) else { break };
        if number % 2 == 0 {
            let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: ");
        }
        held.push(stream);
        if number % 100 == 99 {
            assert_eq!(server.get("/api/hello").status, 200, "after {number}");
        }
    }
    assert!(held.len() > 500, "{}", held.len());
    assert_eq!(server.get("/api/hello").status, 200);
    // the server closes them after some time by itself
    let mut last = held.pop().unwrap();
    last.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let mut bytes = Vec::new();
    assert!(last.read_to_end(&mut bytes).is_ok() || bytes.is_empty());
}

/// Everything that goes out forbids scripts and styles of others, guesses of its kind, and being
/// kept or shown within pages of others.
#[test]
fn every_answer_is_safe_to_be_shown() {
    let (_place, server) = place();
    let wish = json!({"path": "m.json", "text": MODEL, "format": "html"});
    let page = server.post("/api/page", &json!({"path": "m.json", "text": MODEL})).json();
    let page = format!("/{}", page["address"].as_str().unwrap());
    let replies = [
        server.get("/"),
        server.get("/api/hello"),
        server.get("/no"),
        server.get(&page),
        server.post("/api/files", &json!({})),
        server.post("/api/export", &wish),
        server.ask("GET /", &[], None),
        server.ask("GET /", &[("Host".to_owned(), server.host())], None),
    ];
    for reply in replies {
        if reply.head.starts_with("HTTP/1.1 400") {
            // a request that is none is not looked at
            continue;
        }
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("cache-control", "no-store"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-resource-policy", "same-origin"),
        ] {
            assert_eq!(reply.header(name), Some(value), "{}", reply.head);
        }
        let policy = reply.header("content-security-policy").unwrap();
        assert!(policy.contains("default-src 'none'") && policy.contains("frame-ancestors 'self'"));
        let scripts = policy.split(';').find(|part| part.trim().starts_with("script-src"));
        assert!(scripts.is_none_or(|of| !of.contains("unsafe-inline")), "{policy}");
    }
}

/// Whatever a model file says stands on pages as text.
#[test]
fn nothing_of_a_model_is_markup() {
    let (_place, server) = place();
    let evil = "<script>alert(1)</script><img src=x onerror=alert(1)>\"'><svg/onload=alert(1)>";
    let model = json!({
        "title": evil,
        "inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1, "source": evil}},
        "equations": {"y": "x*x"},
        "outputs": {"y": {"label": evil}},
        "monte_carlo": {"trials": 1000},
    });
    for model in [model.to_string(), model.to_string().replace("\"y\"", "\"<b>y\"")] {
        let reply = server.post("/api/page", &json!({"path": "m.json", "text": model}));
        let answer: Value = reply.json();
        let text = answer["html"].as_str().or(answer["error"].as_str()).unwrap().to_owned();
        if answer["html"].is_string() {
            for markup in ["<script", "<img", "<svg/", "onerror=alert(1)>\"'><"] {
                assert!(!text.contains(markup), "{markup}");
            }
            assert!(text.contains("&lt;script&gt;alert(1)"));
        } else {
            // mistakes are JSON, which no browser shows as a page
            assert_eq!(reply.header("content-type"), Some("application/json"));
        }
    }
    // a name of a download cannot write headers
    let wish = json!({"path": "a b.json", "text": MODEL, "format": "csv"});
    let reply = server.post("/api/export", &wish);
    assert!(reply.header("content-disposition").unwrap().contains("filename=\"a_b.csv\""));
}

/// A `.gumption-root` above the opened folder opens nothing: neither for answers nor for exports.
#[test]
fn what_lies_above_the_opened_folder_is_not_read() {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    fs::create_dir(at("own")).unwrap();
    fs::write(at(".gumption-root"), "").unwrap();
    fs::write(at("secret.csv"), "f\n1\n2\n").unwrap();
    let model = r#"{"inputs": {"a": {"unit": "m", "distribution": "normal", "mean": 1, "std": 0.1}},
        "conditions": {"file": "../secret.csv", "units": {"f": "Hz"}},
        "equations": {"v": "a*f"}, "outputs": {"v": {"unit": "m/s"}}}"#;
    fs::write(at("own/m.json"), model).unwrap();
    let server = PageServer::start(&at("own"));
    let asked =
        serde_json::json!({"path": "m.json", "text": model, "format": "csv", "name": "m.json"});
    for path in ["/api/export", "/api/page"] {
        let reply = server.post(path, &asked);
        assert_eq!(reply.status, 422, "{path}: {}", reply.text());
        assert!(reply.json()["diagnostics"][0]["message"].as_str().unwrap().contains("outside"));
    }
    let found = server.post("/api/call/answer?path=m.json", &asked).json();
    assert!(found["diagnostics"].to_string().contains("outside"), "{found}");
    // the file itself opens what belongs together
    let server = PageServer::start(&at("own/m.json"));
    let asked = json!({"path": "own/m.json", "text": model, "format": "csv"});
    assert_eq!(server.post("/api/export", &asked).status, 200);
}
