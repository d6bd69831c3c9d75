//! The crates of the workspace know only those below them.

use std::fs;

use crate::support::root;

/// The crates from low to high.
const CRATES: [&str; 17] = [
    "units",
    "engine",
    "measurements",
    "signal",
    "columns",
    "emulator",
    "inference",
    "gap",
    "assumptions",
    "analysis",
    "text",
    "files",
    "foreign",
    "report",
    "live",
    "server",
    "command",
];

/// The crates of the workspace that stand in a section of a manifest, with the rest of their lines.
fn named(manifest: &str, section: &str) -> Vec<(String, String)> {
    let lines = manifest.lines().skip_while(|line| line.trim() != section).skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let ours = lines.filter_map(|line| line.strip_prefix("gumption-"));
    ours.map(|line| {
        let end = line.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(line.len());
        (line[..end].to_owned(), line[end..].to_owned())
    })
    .collect()
}

/// Cargo refuses circles only; this is the order itself. Tests may look up as well, but by path alone:
/// a development dependency with a version would have to be published before the crate that it tests.
#[test]
fn crates_know_only_those_below_them() {
    let mut found: Vec<String> = fs::read_dir(root().join("crates"))
        .expect("the folder of crates")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    found.sort();
    let mut known = CRATES.to_vec();
    known.sort_unstable();
    assert_eq!(found, known, "every crate has its position in the order");

    let mut edges = 0;
    for (position, name) in CRATES.into_iter().enumerate() {
        let path = root().join("crates").join(name).join("Cargo.toml");
        let manifest = fs::read_to_string(path).expect("a manifest");
        assert!(manifest.contains(&format!("name = \"gumption-{name}\"")), "{name}");
        for section in ["[dependencies]", "[build-dependencies]"] {
            for (other, _) in named(&manifest, section) {
                let below = CRATES[..position].contains(&other.as_str());
                assert!(
                    below,
                    "gumption-{name} depends on gumption-{other}, which is not below it"
                );
                edges += 1;
            }
        }
        for (other, how) in named(&manifest, "[dev-dependencies]") {
            assert!(how.contains("path"), "gumption-{name} is tested with gumption-{other}{how}");
        }
    }
    // the lines were found at all: every crate but the lowest stands on another
    assert!(edges >= CRATES.len() - 1, "{edges} dependencies");
}
