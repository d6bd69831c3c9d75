//! The manual in `docs/`: its commands run, its files are valid, its tables are the program's, its
//! links lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

use crate::process::Command;
use crate::support::{output, root};

/// Pages whose commands are run in an empty folder, top to bottom.
const WALKED: [&str; 3] = ["tutorial.md", "model-files.md", "readings.md"];

/// The page of the reference that `python/reference` makes, and that tests of the package hold.
const PYTHON_NAMES: &str = "reference/python.md";

fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).expect("a page of the manual")
}

/// The blocks of code of a page: what stands behind the fence, and the code.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let inside = page.split("```").skip(1).step_by(2);
    inside.map(|block| block.split_once('\n').expect("a line behind the fence")).collect()
}

/// The pages of the table of contents.
fn contents() -> Vec<String> {
    let summary = page("SUMMARY.md");
    let links = summary.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    links.map(|(link, _)| link.to_owned()).collect()
}

/// A command as a shell runs it, with the program on the path.
pub(crate) fn shell(folder: &Path, line: &str) -> std::process::Output {
    let program = Path::new(env!("CARGO_BIN_EXE_gumption"));
    let mut paths = vec![program.parent().expect("its folder").to_path_buf()];
    paths.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let path = std::env::join_paths(paths).expect("a path");
    let mut command = Command::new("sh");
    command.args(["-c", line]).current_dir(folder).env("PATH", path);
    command.output().expect("a shell")
}

#[test]
fn commands_of_the_tutorial_run() {
    for name in WALKED {
        let folder = tempfile::tempdir().expect("a folder");
        let page = page(name);
        let mut run = 0;
        for (fence, code) in blocks(&page) {
            if let Some((_, file)) = fence.split_once("file=") {
                fs::write(folder.path().join(file.trim()), code).expect("written");
            }
            for line in code.lines().filter(|_| fence == "sh") {
                let said = shell(folder.path(), line);
                let error = String::from_utf8_lossy(&said.stderr);
                assert!(said.status.success(), "{name}: {line}\n{error}");
                run += 1;
            }
        }
        assert!(run >= 4, "{name}: {run} commands");
    }
}

/// The file that the tutorial shows is the one that its first command writes.
#[test]
fn the_tutorial_shows_what_it_writes() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = page("tutorial.md");
    let (_, code) = blocks(&page).into_iter().find(|(fence, _)| *fence == "sh").expect("commands");
    assert!(shell(folder.path(), code.lines().next().expect("a line")).status.success());
    let written = fs::read_to_string(folder.path().join("resistor.json")).expect("the file");
    let written: serde_json::Value = serde_json::from_str(&written).expect("JSON");
    let (_, shown) = blocks(&page).into_iter().find(|(fence, _)| *fence == "json").expect("shown");
    let shown: serde_json::Value = serde_json::from_str(&format!("{{{shown}}}")).expect("JSON");
    for (name, keys) in shown["inputs"].as_object().expect("inputs") {
        for (key, value) in keys.as_object().expect("keys") {
            assert_eq!(&written["inputs"][name][key], value, "{name}: {key}");
        }
    }
    assert_eq!(written["equations"], shown["equations"]);
    assert_eq!(written["outputs"], shown["outputs"]);
}

/// `GUMPTION_UPDATE=1 cargo test --test all manual` writes the pages of the reference anew.
#[test]
fn tables_are_made_by_the_program() {
    let pages = contents();
    let mut made = 0;
    let by_program = pages.iter().filter(|page| *page != PYTHON_NAMES);
    for name in by_program.filter_map(|page| page.strip_prefix("reference/")) {
        let topic = name.strip_suffix(".md").expect("a page");
        let told = output(&["help", topic, "--format", "markdown"]);
        let note = format!("<!-- made by: gumption help {topic} --format markdown -->\n\n");
        let path = root().join("docs/reference").join(name);
        if std::env::var_os("GUMPTION_UPDATE").is_some() {
            fs::create_dir_all(root().join("docs/reference")).expect("a folder");
            fs::write(&path, note.clone() + &told).expect("written");
        }
        let committed = fs::read_to_string(&path).expect("a page of the reference");
        assert!(committed == note + &told, "{name} is of another version: GUMPTION_UPDATE=1");
        made += 1;
    }
    assert_eq!(made, 9);
}

/// Every page is in the table of contents, and every link within the manual leads to a file.
#[test]
fn pages_and_links_are_there() {
    let docs = root().join("docs");
    let contents = contents();
    let mut found = vec![PathBuf::new()];
    let mut pages = Vec::new();
    while let Some(folder) = found.pop() {
        for entry in fs::read_dir(docs.join(&folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(&docs).expect("below").to_path_buf();
            match path.extension().and_then(|e| e.to_str()) {
                _ if path.is_dir() => found.push(name),
                Some("md") => pages.push(name),
                _ => {}
            }
        }
    }
    for name in &pages {
        let text = name.to_string_lossy().replace('\\', "/");
        assert!(text == "SUMMARY.md" || contents.contains(&text), "{text} is not in SUMMARY.md");
        let content = page(&text);
        for link in content.split("](").skip(1).filter_map(|rest| rest.split_once(')')) {
            let target = link.0.split('#').next().unwrap_or_default();
            if target.is_empty() || target.starts_with("http") {
                continue;
            }
            let from = docs.join(name);
            let path = from.parent().expect("a folder").join(target);
            assert!(path.exists(), "{text}: {target}");
        }
    }
    for name in contents {
        assert!(docs.join(&name).exists(), "{name}");
    }
}

/// Every command that a page shows is one that the program has.
#[test]
fn commands_exist() {
    let help = output(&["help"]);
    for name in contents() {
        let page = page(&name);
        for (fence, code) in blocks(&page) {
            let commands = code.lines().filter(|_| fence == "sh");
            for line in commands.filter_map(|line| line.strip_prefix("gumption ")) {
                let command = line.split_whitespace().next().expect("a command");
                assert!(help.contains(&format!("\n  {command} ")), "{name}: {command}");
            }
        }
    }
}

/// `new` without options asks, and takes the answers of a file as well.
#[test]
fn new_asks() {
    let folder = tempfile::tempdir().expect("a folder");
    let answers = "Power\npower = voltage^2/resistance\n\nmW\n5.01 V ± 0.02 V\n5.01 V ± 0.02 V (k=2)\n\
                   normall,mean=1\nreadings, values=99.8 100.1 100.0 99.9\nfurlong\nohm\n";
    fs::write(folder.path().join("answers"), answers).expect("written");
    let said = shell(folder.path(), "gumption new --output power.json < answers");
    let error = String::from_utf8_lossy(&said.stderr);
    assert!(said.status.success(), "{error}");
    assert!(error.contains("furlong") && error.contains("did you mean `normal`?"), "{error}");
    let page = shell(folder.path(), "gumption run power.json --trials 0");
    let page = String::from_utf8_lossy(&page.stdout);
    // 5.01^2/99.95 W
    assert!(page.contains("251."), "{page}");
    assert!(error.contains("state the coverage of the uncertainty"), "{error}");
    let text = fs::read_to_string(folder.path().join("power.json")).expect("the file");
    let file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(file["inputs"]["voltage"], "5.01 V ± 0.02 V (k=2)");
    assert_eq!(file["inputs"]["resistance"]["unit"], "ohm");
    let line =
        "gumption new --equation 'y = 2*a' --unit y=V --input 'a=5.0112(23) V' --output y.json";
    assert!(shell(folder.path(), line).status.success());
    let answer = shell(folder.path(), "gumption run y.json --trials 0 --format json");
    let answer: serde_json::Value = serde_json::from_slice(&answer.stdout).expect("JSON");
    // 2 x 5.0112(23)
    let u = answer["outputs"]["y"]["gum"]["standard_uncertainty"].as_f64().expect("u");
    assert!((u - 0.0046).abs() < 1e-12, "{u}");
    // an empty answer ends the questions
    for answers in ["T\\n\\n", "T\\ny = a\\n\\n\\n", "T\\ny = a\\n\\nV\\n\\n", "T\\ny = a\\n"] {
        let said = shell(folder.path(), &format!("printf '{answers}' | gumption new"));
        let error = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(2), "{answers}: {error}");
        assert!(error.contains("has no answer, so that no file is written"), "{answers}: {error}");
    }

    // what is not known stays blank and is told; nothing is made up
    let line = "gumption new --equation 'y = a*b' --input 'a=m,rectangular,mean=1,half_width=0.1' --output y.json";
    let said = shell(folder.path(), line);
    let error = String::from_utf8_lossy(&said.stderr);
    assert!(
        said.status.success() && error.contains("fill in `unit`, `mean` and `std` of `b`"),
        "{error}"
    );
    assert_eq!(shell(folder.path(), "gumption check y.json").status.code(), Some(2));

    for (line, said) in [
        ("gumption new --equation 'y = a*'", "y: "),
        ("gumption new --equation 'y'", "is not an equation"),
        ("gumption new --equation 'y = width' --input 'widht=m,normal'", "did you mean `width`?"),
        (
            "gumption new --equation 'y = a' --input 'a=m,normal,mean=1,sdt=2'",
            "did you mean `std`?",
        ),
        ("gumption new --equation 'y = a' --input 'a=m,normal,mean=1,std=-2'", "std"),
        ("gumption new < /dev/null", "has no answer"),
    ] {
        let found = shell(folder.path(), line);
        let error = String::from_utf8_lossy(&found.stderr);
        assert_eq!(found.status.code(), Some(2), "{line}");
        assert!(error.contains(said), "{line}: {error}");
    }
}

#[test]
fn examples_are_printed_and_run() {
    let list = output(&["models", "--examples"]);
    let folder = tempfile::tempdir().expect("a folder");
    let mut run = 0;
    for name in list.lines().filter_map(|line| line.split_whitespace().next()) {
        if name.contains('-') && !name.starts_with("Print") && list.contains(&format!("\n{name} "))
        {
            let line = format!(
                "gumption models --examples {name} --output e.json && gumption check e.json"
            );
            let said = shell(folder.path(), &line);
            assert!(said.status.success(), "{name}: {}", String::from_utf8_lossy(&said.stderr));
            run += 1;
        }
    }
    assert!(run >= 25, "{run} of\n{list}");
}

/// README's commands, in a copy of the files that they name; what asks, what goes on until it is
/// ended, what takes minutes and what a toolchain runs is left to other tests.
#[cfg(unix)]
#[test]
fn commands_of_the_first_page_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let linked = |name: &str| {
        std::os::unix::fs::symlink(root().join(name), folder.path().join(name)).expect("linked");
    };
    linked("models");
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let mut run = 0;
    for (_, code) in blocks(&readme).into_iter().filter(|(fence, _)| *fence == "sh") {
        let commands = ["gumption ", "mkdir "];
        for line in code.lines().filter(|line| commands.iter().any(|of| line.starts_with(of))) {
            let word = line.split_whitespace().nth(1).expect("a command");
            if ["new", "open", "gap", "gap-check"].contains(&word) {
                continue;
            }
            let said = shell(folder.path(), line);
            let error = String::from_utf8_lossy(&said.stderr);
            assert!(said.status.success(), "{line}\n{error}");
            run += 1;
        }
    }
    assert!(run >= 20, "{run} commands");
    // the file that the page shows is the one that it runs
    let power = fs::read_to_string(root().join("models/examples/power.json")).expect("the file");
    assert!(blocks(&readme).iter().any(|(fence, code)| *fence == "json" && *code == power));
}

/// The drift of a reference extrapolated, as the manual has it: numpy's line through the six values,
/// 3.5 years from the origin, its u with that of a further value by
/// s sqrt(1 + 1/n + (x - mean)^2/Sxx) with four degrees of freedom, and 0.25 in common.
#[test]
fn the_drift_of_the_manual_is_extrapolated() {
    let page = page("calibration-functions.md");
    let section = page.split("## Drift of a reference").nth(1).expect("the section");
    let (_, code) = blocks(section).into_iter().find(|(fence, _)| *fence == "json").expect("JSON");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("drift.json"), code).expect("written");
    let said = shell(folder.path(), "gumption run drift.json --format json --trials 0 --quiet");
    let answer: serde_json::Value = serde_json::from_slice(&said.stdout).expect("an answer");
    let found = |key: &str| answer["outputs"]["V"]["gum"][key].as_f64().expect("a number");
    let of_line: f64 = 0.329_578_855_848_220_44;
    let u = f64::hypot(of_line, 0.25);
    assert!((found("estimate") - (10.0 + 19.246_666_666_666_67e-6)).abs() < 1e-14);
    assert!((found("standard_uncertainty") / (1e-6 * u) - 1.0).abs() < 1e-9);
    let dof = 4.0 * u.powi(4) / of_line.powi(4);
    assert!((found("dof") / dof - 1.0).abs() < 1e-9);
}

/// The curve and a further reading on it, as the manual has them: the line through the four points by the
/// sums of squares, s sqrt(1/n + (x - mean)^2/Sxx) of the line and s sqrt(1 + 1/n + ...) of a reading.
#[test]
fn a_further_reading_of_the_manual() {
    let page = page("calibration-functions.md");
    let section = page.split("## A further reading on the line").nth(1).expect("the section");
    let (_, code) = blocks(section).into_iter().find(|(fence, _)| *fence == "json").expect("JSON");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("line.json"), code).expect("written");
    let said = shell(folder.path(), "gumption run line.json --format json --trials 0 --quiet");
    let answer: serde_json::Value = serde_json::from_slice(&said.stdout).expect("an answer");
    for (output, u) in [("curve", 0.101_242_283_656_582_9), ("reading", 0.226_384_628_453_435_35)] {
        let gum = &answer["outputs"][output]["gum"];
        let found = |key: &str| gum[key].as_f64().expect("a number");
        assert!((found("estimate") - 5.0).abs() < 1e-12, "{output}");
        assert!((found("standard_uncertainty") / u - 1.0).abs() < 1e-9, "{output}: {gum}");
        assert!((found("dof") - 2.0).abs() < 1e-9, "{output}");
    }
}

/// The sources of all crates, without their tests.
pub(crate) fn sources_of_crates() -> Vec<String> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(root().join("crates")).expect("the crates") {
        let source = entry.expect("an entry").path().join("src");
        if source.is_dir() {
            sources(&source, &mut texts);
        }
    }
    texts
}

/// The sources of a folder, without their tests.
fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if path.is_dir() {
            if !matches!(name.as_str(), "tests" | "german") {
                sources(&path, found);
            }
        } else if name.ends_with(".rs") && name != "tests.rs" {
            let text = fs::read_to_string(&path).expect("text");
            found.push(
                text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned(),
            );
        }
    }
}

/// The page of codes has every code of a note and of a mistake, and no other.
#[test]
fn codes_of_notes_and_mistakes_are_those_of_the_page() {
    let page = page("notes.md");
    let quoted =
        |of: &str| -> Vec<String> { of.split('`').skip(1).step_by(2).map(str::to_owned).collect() };
    let is_code = |of: &str| {
        !of.is_empty()
            && of.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    };
    let texts = sources_of_crates();
    // the sentences of notes, without the parts of sentences
    let words = root().join("crates/report/src/words/english.rs");
    let words = fs::read_to_string(words).expect("the sentences");
    let (words, _) = words.split_once("const PARTS").expect("the parts of sentences");
    let keys = words.split("\n    (\"").skip(1).filter_map(|entry| entry.split(['.', '"']).next());
    let mut codes: Vec<&str> = keys.collect();
    let kinds = texts.iter().filter(|text| text.contains("pub enum DiagnosticKind"));
    codes.extend(kinds.flat_map(|text| text.split("=> ").skip(1)).filter_map(|rest| {
        let (code, _) = rest.trim_start().strip_prefix('"')?.split_once('"')?;
        is_code(code).then_some(code)
    }));
    assert!(codes.len() > 120, "{codes:?}");
    let known = quoted(&page);
    let missing: Vec<&&str> =
        codes.iter().filter(|code| !known.iter().any(|known| known == *code)).collect();
    assert!(missing.is_empty(), "not on the page: {missing:?}");
    let (_, tables) = page.split_once("## Notes on how").expect("tables");
    for code in quoted(tables).iter().filter(|code| is_code(code) && code.contains('-')) {
        let is_given = codes.contains(&code.as_str());
        assert!(is_given || texts.concat().contains(&format!("\"{code}\"")), "{code} is no code");
    }
}
