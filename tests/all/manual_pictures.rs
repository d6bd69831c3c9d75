//! The pictures of the manual are figures of pages that the program makes.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::process::Command;
use crate::support::root;

/// The list of the pictures: the name of each, the command of its page, and the number of the figure on
/// that page.
const LIST: &str = "docs/pictures/pictures.json";

struct Picture {
    name: String,
    command: Vec<String>,
    figure: u64,
}

fn pictures() -> Vec<Picture> {
    let text = fs::read_to_string(root().join(LIST)).expect("the list of pictures");
    let list: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let texts = |value: &serde_json::Value| -> Vec<String> {
        let items = value.as_array().expect("a list").iter();
        items.map(|item| item.as_str().expect("a text").to_owned()).collect()
    };
    let of = |entry: &serde_json::Value| Picture {
        name: entry["picture"].as_str().expect("a name").to_owned(),
        command: texts(&entry["command"]),
        figure: entry["figure"].as_u64().expect("a number"),
    };
    list.as_array().expect("a list").iter().map(of).collect()
}

/// Makes the page of a command with its figures in a folder.
fn make(command: &[String], folder: &Path) {
    let made = Command::new(env!("CARGO_BIN_EXE_gumption"))
        .current_dir(root())
        .args(command)
        .args(["--quiet", "--format", "markdown", "--output"])
        .arg(folder.join("page.md"))
        .output()
        .expect("the program");
    assert!(made.status.success(), "{command:?}: {}", String::from_utf8_lossy(&made.stderr));
}

/// `GUMPTION_UPDATE=1 cargo test --test all manual_pictures` writes the pictures anew.
#[test]
fn pictures_are_made_by_the_program() {
    let pictures = pictures();
    let mut of_commands: BTreeMap<&[String], Vec<&Picture>> = BTreeMap::new();
    for picture in &pictures {
        of_commands.entry(&picture.command).or_default().push(picture);
    }
    let is_update = std::env::var_os("GUMPTION_UPDATE").is_some();
    for (command, pictures) in of_commands {
        let folder = tempfile::tempdir().expect("a folder");
        make(command, folder.path());
        for Picture { name, figure, .. } in pictures {
            let made = fs::read_to_string(folder.path().join(format!("page-{figure}.svg")));
            let made = made.unwrap_or_else(|_| panic!("{name}: no figure {figure} of {command:?}"));
            let path = root().join("docs/pictures").join(name);
            if is_update {
                fs::write(&path, &made).expect("written");
            }
            let committed = fs::read_to_string(&path).expect("a picture of the manual");
            assert!(committed == made, "{name} is of another version: GUMPTION_UPDATE=1");
        }
    }
}

/// Every drawn picture of the manual is in the list once, and pages show no others.
#[test]
fn every_picture_is_in_the_list_and_shown() {
    let listed: Vec<String> = pictures().into_iter().map(|picture| picture.name).collect();
    let names: BTreeSet<&str> = listed.iter().map(String::as_str).collect();
    assert_eq!(names.len(), listed.len(), "a picture is listed twice");
    let folder = fs::read_dir(root().join("docs/pictures")).expect("the pictures");
    let there = folder.map(|entry| entry.expect("an entry").file_name().into_string().unwrap());
    let drawn: BTreeSet<String> = there.filter(|name| name.ends_with(".svg")).collect();
    assert_eq!(drawn.iter().map(String::as_str).collect::<BTreeSet<_>>(), names);
    let pages = fs::read_dir(root().join("docs")).expect("the manual");
    let pages = pages.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file());
    let manual: String = pages.filter_map(|path| fs::read_to_string(path).ok()).collect();
    for name in names {
        assert!(manual.contains(&format!("](pictures/{name})")), "no page shows {name}");
    }
}
