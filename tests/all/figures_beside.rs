//! Figures as files beside Markdown and LaTeX pages.

use std::fs;
use std::path::Path;

use crate::support::{gumption, root};

const MODEL: &str = "models/inclined_plane.json";

/// Runs `run` in the folder of the project with few trials, with the page in another folder.
fn run(page: &Path, more: &[&str]) -> assert_cmd::assert::Assert {
    gumption().args(["run", MODEL, "--trials", "20000", "--output"]).arg(page).args(more).assert()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_markdown_page_shows_pictures_that_need_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    run(&folder.path().join("page.md"), &["--format", "markdown"]).success();
    let page = fs::read_to_string(folder.path().join("page.md")).unwrap();
    let figures: Vec<String> =
        names(folder.path()).into_iter().filter(|name| name != "page.md").collect();
    assert!(figures.len() >= 4, "{figures:?}");
    for number in 1..=figures.len() {
        let name = format!("page-{number}.svg");
        let shown = format!("![Figure {number}]({name})\n\n**Figure {number}.** ");
        assert!(page.contains(&shown), "{shown}");
        let figure = fs::read_to_string(folder.path().join(&name)).unwrap();
        let tree = roxmltree::Document::parse(&figure).unwrap();
        let root = tree.root_element();
        assert_eq!(root.attribute("width"), Some("720"));
        let has = |tag: &str| root.children().any(|child| child.tag_name().name() == tag);
        assert!(has("title") && has("style"), "{name}");
        // texts for a pointer are of pages
        assert!(!figure.contains("transparent"), "{name}");
    }
}

/// A PDF beside each `\includegraphics`; the text of a figure is text, not outlines.
#[test]
fn a_latex_page_includes_pdf_files() {
    let folder = tempfile::tempdir().unwrap();
    run(&folder.path().join("a page.tex"), &["--format", "latex"]).success();
    let page = fs::read_to_string(folder.path().join("a page.tex")).unwrap();
    assert!(page.contains("\\usepackage{graphicx}\n"));
    let included: Vec<&str> = page
        .split("\\includegraphics[width=\\linewidth]{")
        .skip(1)
        .map(|rest| rest.split_once('}').unwrap().0)
        .collect();
    assert!(included.len() >= 4);
    for (number, name) in (1..).zip(&included) {
        assert_eq!(*name, format!("a-page-{number}.pdf"));
        let figure = fs::read(folder.path().join(name)).unwrap();
        assert!(figure.starts_with(b"%PDF-"), "{name}");
        assert!(String::from_utf8_lossy(&figure).contains("DejaVuSans"), "{name}");
    }
    assert_eq!(names(folder.path()).len(), included.len() + 1);
}

/// Without a folder there are no figures, and a note says how to get them.
#[test]
fn standard_output_has_no_figures() {
    for format in ["markdown", "latex"] {
        let run = gumption().args(["run", MODEL, "--trials", "0", "--format", format]).assert();
        let output = run.success().get_output().clone();
        let [page, notes] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
        assert!(!page.contains("Figure 1") && !page.contains("includegraphics"), "{format}");
        let note = "note: without figures; `--output FILE` writes them beside FILE\n";
        assert_eq!(notes.matches(note).count(), 1, "{notes}");
    }
}

/// Neither an input nor another output is replaced by a figure, also under another name.
#[test]
fn no_figure_replaces_an_input() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("page-2.svg");
    fs::copy(root().join(MODEL), &model).unwrap();
    let page = folder.path().join("page.md");
    let refused = |model: &Path, more: &[&str]| {
        let run = gumption()
            .args(["run", "--format", "markdown", "--trials", "1000", "--output"])
            .args([&page, model])
            .args(more)
            .assert()
            .code(2);
        let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        assert!(message.contains("a figure beside"), "{message}");
        assert!(!page.exists());
    };
    refused(&model, &[]);
    let other = folder.path().join("model.json");
    fs::rename(&model, &other).unwrap();
    let saved = model.to_str().unwrap();
    refused(&other, &["--save", saved]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&other, folder.path().join("page-1.svg")).unwrap();
        refused(&other, &[]);
    }
}

/// If a figure cannot be written, neither the page nor another figure is.
#[cfg(unix)]
#[test]
fn a_page_is_written_with_all_its_figures_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.md");
    fs::write(&page, "old").unwrap();
    // no file can have the name of a folder
    fs::create_dir(folder.path().join("page-3.svg")).unwrap();
    let run = run(&page, &["--format", "markdown"]).failure();
    let message = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert!(message.contains("page-3.svg"), "{message}");
    assert_eq!(fs::read_to_string(&page).unwrap(), "old");
    assert_eq!(names(folder.path()), ["page-3.svg", "page.md"]);
}
