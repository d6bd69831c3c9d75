//! Files from strangers: what they may read, what messages quote of it, and what becomes of hostile
//! names in every format of every command.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::{command, root};

struct Folder(tempfile::TempDir);

/// What must not be seen.
const SECRET: &str = "f,password\n1,31337\n";

impl Folder {
    /// A folder `sub` with files that name others, and a secret beside it.
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        fs::create_dir(folder.path().join("sub")).unwrap();
        folder.write("secret.csv", SECRET);
        folder
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path().join(name), text).unwrap();
    }

    fn run(&self, arguments: &[&str]) -> Output {
        command().current_dir(self.path()).args(arguments).output().expect("the program runs")
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A model with a table of conditions.
fn with_table(name: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"distribution": "normal", "mean": 1, "std": 0.1}}}},
        "conditions": {{"file": "{name}"}}, "equations": {{"y": "x"}}, "outputs": {{"y": {{}}}}}}"#
    )
}

/// A model with samples.
fn with_samples(name: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"distribution": "samples", "file": "{name}"}}}},
        "equations": {{"y": "x"}}, "outputs": {{"y": {{}}}}}}"#
    )
}

#[test]
fn files_outside_of_the_folder_are_not_read() {
    let folder = Folder::new();
    let result = |name: &str| {
        format!(
            r#"{{"inputs": {{"x": {{"distribution": "result", "file": "{name}", "output": "y"}}}},
            "equations": {{"y": "x"}}, "outputs": {{"y": {{}}}}}}"#
        )
    };
    let matrix = |name: &str| {
        format!(
            r#"{{"inputs": {{"a": {{"mean": 1, "std": 1}}, "b": {{"mean": 1, "std": 1}}}},
            "correlation_matrix": {{"file": "{name}"}}, "equations": {{"y": "a+b"}},
            "outputs": {{"y": {{}}}}}}"#
        )
    };
    let certificate =
        |name: &str| format!(r#"{{"title": "t", "rows": [{{"model": "{name}", "output": "y"}}]}}"#);
    let case = |name: &str| {
        format!(
            r#"{{"inputs": {{"x": {{"mean": 1, "std": 1}}}}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{}}}}, "conditions": {{"f": {{}}}}, "catalogue": ["scale-factor"],
            "observations": {{"file": "{name}", "columns": {{"y": {{"value": "password",
            "standard_uncertainty": "f"}}}}}}}}"#
        )
    };
    let recipe = |name: &str| {
        format!(
            r#"{{"recordings": {{"r": {{"sampling_rate": 1000}}}},
            "channels": {{"c": {{"recording": "r", "column": 1, "unit": "V"}}}},
            "rows": [{{"files": {{"r": "{name}"}}, "frequency": 1}}]}}"#
        )
    };
    let absolute = folder.path().join("secret.csv").canonicalize().unwrap();
    let absolute = absolute.to_str().unwrap().to_owned();
    type Named<'f> = (&'f dyn Fn(&str) -> String, &'f str);
    let kinds: [Named<'_>; 7] = [
        (&with_table, "run"),
        (&with_samples, "run"),
        (&result, "run"),
        (&matrix, "assumptions"),
        (&certificate, "certificate"),
        (&case, "gap"),
        (&recipe, "observe"),
    ];
    for (file, name) in [
        "../secret.csv",
        "x/../../secret.csv",
        &absolute,
        "/etc/passwd",
        "/proc/self/environ",
        "../none.csv",
    ]
    .into_iter()
    .flat_map(|name| kinds.iter().map(move |kind| (kind, name)))
    {
        let (text, command) = (file.0(name), file.1);
        folder.write("sub/f.json", &text);
        for command in [command, "check"] {
            let refused = folder.run(&[command, "sub/f.json"]);
            let said = said(&refused);
            assert_eq!(refused.status.code(), Some(2), "{command} {text}: {said}");
            let expected = "is outside the folder of this file";
            assert!(said.contains(expected) && said.contains("--allow-path"), "{text}: {said}");
            for secret in ["31337", "password\n", "root:", "PATH="] {
                assert!(!said.contains(secret), "{text}: {said}");
            }
        }
    }
}

#[test]
fn an_allowed_folder_and_a_root_open_others() {
    let folder = Folder::new();
    folder.write("sub/m.json", &with_table("../secret.csv"));
    let code = |arguments: &[&str]| folder.run(arguments).status.code();
    assert_eq!(code(&["run", "sub/m.json", "--quiet"]), Some(2));
    assert_eq!(code(&["run", "sub/m.json", "--quiet", "--allow-path", "."]), Some(0));
    assert_eq!(code(&["run", "sub/m.json", "--quiet", "--allow-path", "sub"]), Some(2));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../secret.csv", folder.path().join("sub/link.csv")).unwrap();
        folder.write("sub/l.json", &with_table("link.csv"));
        assert_eq!(code(&["run", "sub/l.json", "--quiet"]), Some(2));
    }
    folder.write(".gumption-root", "");
    assert_eq!(code(&["run", "sub/m.json", "--quiet"]), Some(0));
    // the ready certificate takes models of the folder above its own
    let certificate = "models/certificates/three_axis_accelerometer.json";
    let done = command().current_dir(root()).args(["check", certificate]).output().unwrap();
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
}

/// A certificate for the customer has nothing attached that is not listed.
#[test]
fn what_is_attached_is_listed() {
    let folder = Folder::new();
    let text = fs::read_to_string(root().join("tests/readers/certificate.json")).unwrap();
    let mut file: serde_json::Value = serde_json::from_str(&text).unwrap();
    file["rows"] = serde_json::json!([{"model": "m.json", "output": "y"}]);
    file.as_object_mut().unwrap().remove("separate_inputs");
    folder.write("sub/c.json", &file.to_string());
    folder.write("sub/m.json", &with_table("../secret.csv"));
    let arguments = ["certificate", "sub/c.json", "--format", "dcc", "--trials", "0"];
    let refused = folder.run(&arguments);
    assert_eq!((refused.status.code(), refused.stdout.is_empty()), (Some(2), true));
    let done = folder.run(&[&arguments[..], &["--allow-path", "."]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    let expected =
        "note: attached to the certificate: result.json, certificate.json, m.json, ../secret.csv\n";
    assert!(said(&done).contains(expected), "{}", said(&done));
}

/// A file that is not of the expected kind is not shown.
#[test]
fn messages_quote_what_looks_like_the_expected_kind() {
    let folder = Folder::new();
    let passwd = "root:x:0:0:root:/root:/bin/bash\ndaemon:x:1:1:daemon:/usr/sbin:/usr/sbin/no\n";
    let environment = "HOME=/root\0TOKEN=hunter2\0";
    for (secret, text) in
        [("bash", passwd), ("hunter2", environment), ("BEGIN", "-----BEGIN KEY\n")]
    {
        folder.write("sub/s.csv", text);
        let files = [
            with_table("s.csv"),
            with_samples("s.csv"),
            r#"{"inputs": {"x": {"distribution": "result", "file": "s.csv", "output": "y"}},
                "equations": {"y": "x"}, "outputs": {"y": {}}}"#
                .to_owned(),
            r#"{"title": "t", "rows": [{"model": "s.csv", "output": "y"}]}"#.to_owned(),
        ];
        for file in files {
            folder.write("sub/f.json", &file);
            let refused = folder.run(&["check", "sub/f.json"]);
            assert_eq!(refused.status.code(), Some(2), "{file}");
            assert!(!said(&refused).contains(secret), "{file}: {}", said(&refused));
            assert!(said(&refused).starts_with("sub/f.json:"), "{file}: {}", said(&refused));
        }
    }
    // a mistake in a table of numbers is shown
    folder.write("sub/s.csv", "f,g\n1,2\n3,volt\n");
    folder.write("sub/f.json", &with_table("s.csv"));
    assert!(said(&folder.run(&["check", "sub/f.json"])).contains("volt"));
}

/// Texts that mean something to a terminal, a browser, a spreadsheet, LaTeX, Markdown or XML; one of
/// each beginning that a spreadsheet or a terminal obeys, the others behind them.
const HOSTILE: [&str; 3] = [
    "=HYPERLINK(\"http://x\",\"y\") <script>alert(1)</script>\"><img src=x onerror=alert(2)> | \
     ]]>&lt;&#60;b&#62;<!-- x --><?xml y?>&xxe;",
    "@SUM(1+1)*cmd|' /C calc'!A0 [c](javascript:alert(1)) ![x](http://x/y.png) `a` *b* | c \
     \\input{/etc/passwd} \\write18{ls} $x^2$ % & # _ ~ ^ { }",
    "\u{1b}]0;PWNED\u{7}\u{1b}[2J\u{9b}2J\u{202e}evil\u{200b}\u{1}",
];

/// What is not to be seen in a format.
fn is_harmless(format: &str, answer: &[u8], what: &str) {
    if format == "xlsx" {
        return is_harmless_workbook(answer, what);
    }
    let text = std::str::from_utf8(answer).expect(what);
    let obeyed = |c: char| {
        (c.is_control() && c != '\n')
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{feff}')
    };
    assert!(!text.contains(obeyed), "{what}: {:?}", text.find(obeyed).map(|at| &text[at..]));
    let escaped = |pattern: &str| {
        text.match_indices(pattern).all(|(at, _)| {
            let before = text[..at].bytes().rev().take_while(|byte| *byte == b'\\').count();
            before % 2 == 1
        })
    };
    match format {
        "html" => {
            for tag in ["<script>alert", "<img src=x", "<!-- x", "href=\"javascript"] {
                assert!(!text.contains(tag), "{what}: {tag}");
            }
        }
        "markdown" => {
            // what stands between fences is a listing
            let parts: Vec<&str> = text.split("\n```").step_by(2).collect();
            if parts.len() == 1 {
                for mark in ["<script", "<img", "](", "`a`", "*b*", "<b", "<!--"] {
                    assert!(escaped(mark), "{what}: {mark}");
                }
            }
        }
        "latex" => {
            for command in ["\\input{/etc", "\\write18{", "$x^2$"] {
                assert!(!text.contains(command), "{what}: {command}");
            }
        }
        "csv" => {
            let mut reader =
                csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(answer);
            for cell in reader.records().flat_map(|record| {
                record.expect(what).iter().map(str::to_owned).collect::<Vec<_>>()
            }) {
                assert!(!cell.starts_with(['=', '@', '\t', '\r']), "{what}: {cell}");
                let signed = cell.starts_with(['+', '-']);
                assert!(!signed || cell.parse::<f64>().is_ok(), "{what}: {cell}");
            }
        }
        "json" => {
            serde_json::from_str::<serde_json::Value>(text).expect(what);
        }
        "dcc" => {
            let read = roxmltree::Document::parse(text).expect(what);
            let added = |node: &roxmltree::Node<'_, '_>| {
                ["script", "img", "b"].contains(&node.tag_name().name())
            };
            assert!(!read.descendants().any(|node| added(&node)), "{what}");
        }
        _ => {}
    }
}

fn is_harmless_workbook(answer: &[u8], what: &str) {
    use calamine::{Reader, Xlsx};
    let mut book: Xlsx<_> = Xlsx::new(std::io::Cursor::new(answer)).expect(what);
    for sheet in book.sheet_names().clone() {
        let Ok(formulas) = book.worksheet_formula(&sheet) else { continue };
        for (_, _, formula) in formulas.used_cells() {
            for text in ["HYPERLINK", "cmd|", "SUM(1+1)"] {
                assert!(!formula.contains(text), "{what}: {formula}");
            }
        }
    }
}

/// Every format of every command with hostile titles, labels, names of components and groups, and
/// explanations: none of them is obeyed by what shows it.
#[test]
fn hostile_texts_are_harmless_in_every_format() {
    let read = |path: &str| -> serde_json::Value {
        let text = fs::read_to_string(root().join(path)).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    for text in HOSTILE {
        let folder = Folder::new();
        let write = |name: &str, value: &serde_json::Value| {
            folder.write(name, &value.to_string());
        };
        let model = serde_json::json!({
            "title": text, "source": text,
            "inputs": {
                "x": {"unit": "V", "mean": 5, "about": text, "group": text,
                      "components": [{"name": "calibration", "distribution": "normal",
                                      "std": 0.1, "about": text, "group": text}]},
                "r": {"unit": "ohm", "distribution": "rectangular", "mean": 2, "half_width": 0.1}},
            "equations": {"i": "x/r"}, "outputs": {"i": {"unit": "A", "about": text}}});
        write("m.json", &model);
        let checked = folder.run(&["check", "m.json"]);
        assert_eq!(checked.status.code(), Some(0), "{text:?}: {}", said(&checked));
        let mut certificate = read("tests/readers/certificate.json");
        for key in ["title", "environment"] {
            certificate[key] = text.into();
        }
        for (who, key) in [("device", "name"), ("customer", "name"), ("laboratory", "name")] {
            if certificate[who].is_object() {
                certificate[who][key] = text.into();
            } else if certificate[who].is_string() {
                certificate[who] = text.into();
            }
        }
        certificate.as_object_mut().unwrap().remove("separate_inputs");
        certificate["rows"] =
            serde_json::json!([{"model": "m.json", "output": "i", "label": text}]);
        write("c.json", &certificate);
        let mut case = read("models/gap/radius/case.json");
        for key in ["title", "source", "about"] {
            case[key] = text.into();
        }
        case["inputs"]["encoder_error"]["about"] = text.into();
        case["catalogue"] = serde_json::json!(["radius-offset", "scale-factor"]);
        write("g.json", &case);
        fs::copy(root().join("models/gap/radius/data.csv"), folder.path().join("data.csv"))
            .unwrap();
        let quoted = text.replace('"', "\"\"");
        folder.write("t.csv", &format!("label,x1,U1,x2,U2\n\"{quoted}\",1,0.1,1.5,0.1\n"));
        folder.write("l.csv", &format!("label,x,U\n\"{quoted}\",1,0.1\nb,1.5,0.1\nc,2,1\n"));
        folder.write("s.csv", "a\n0\n1\n0\n-1\n0\n1\n0\n-1\n0\n1\n0\n-1\n");
        let recipe = serde_json::json!({
            "title": text, "source": text, "trials": 20,
            "recordings": {"r": {"sampling_rate": 4}},
            "channels": {"a": {"recording": "r", "column": "a", "unit": "V"}},
            "rows": [{"files": {"r": "s.csv"}, "frequency": 1}]});
        write("o.json", &recipe);
        let few = ["--trials", "2000"];
        let kinds: [(&[&str], &[&str]); 10] = [
            (
                &["run", "m.json", few[0], few[1]],
                &["table", "json", "csv", "markdown", "latex", "html", "xlsx"],
            ),
            (
                &["certificate", "c.json", few[0], few[1]],
                &["table", "json", "csv", "markdown", "latex", "html", "xlsx", "dcc"],
            ),
            (&["compare", "t.csv"], &["table", "html", "markdown", "json", "csv"]),
            (&["compare", "l.csv"], &["table", "html", "markdown", "json", "csv"]),
            (&["gap", "g.json"], &["table", "html", "markdown", "json", "csv"]),
            (&["gap-check", "g.json", "--draws", "1"], &["table", "html", "json"]),
            (
                &["assumptions", "m.json", "--trials", "20000"],
                &["table", "html", "markdown", "json", "csv"],
            ),
            (&["diff", "m.json", "m.json"], &["table", "html", "markdown", "json"]),
            (&["observe", "o.json"], &["table", "html", "markdown", "json", "csv"]),
            (&["check", "m.json"], &["table", "json"]),
        ];
        for (arguments, formats) in kinds {
            for format in formats {
                let done = folder.run(&[arguments, &["--format", format]].concat());
                let what = format!("{arguments:?} {format} of {text:?}");
                assert_eq!(done.status.code(), Some(0), "{what}: {}", said(&done));
                is_harmless(format, &done.stdout, &what);
                let notes = said(&done);
                let obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
                assert!(!notes.contains(obeyed), "{what}: {notes:?}");
            }
        }
    }
}
