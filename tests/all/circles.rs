//! Files of a crate that know each other in a circle.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::support::root;

/// The files of the largest circle of each crate, at most. A number may fall; before one rises, look for
/// the type that stands above what uses it.
const LARGEST: [(&str, usize); 17] = [
    ("units", 4),
    ("engine", 4),
    ("measurements", 1),
    ("signal", 6),
    ("columns", 1),
    ("emulator", 1),
    ("inference", 3),
    ("gap", 5),
    ("assumptions", 1),
    ("analysis", 4),
    ("text", 5),
    ("files", 7),
    ("foreign", 15),
    ("report", 3),
    ("live", 1),
    ("server", 5),
    ("command", 4),
];

/// A module, as the names from the root of its crate.
type Module = Vec<String>;

/// A path of code, segment by segment.
type Segments = Vec<String>;

/// What a file says of others.
#[derive(Default)]
struct File {
    /// The names that its `use` items bring, with their paths.
    names: BTreeMap<String, Segments>,
    /// All paths of `use` items, and those in code, that begin with `crate` or `super`.
    paths: Vec<Segments>,
    /// The modules that it declares.
    children: Vec<String>,
}

/// The text without comments, and with empty literals.
fn code(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut out, mut i) = (String::new(), 0);
    while i < chars.len() {
        let before = i.checked_sub(1).map_or(' ', at);
        let hashes = (i + 1..).take_while(|&j| at(j) == '#').count();
        if at(i) == '/' && at(i + 1) == '/' {
            while i < chars.len() && at(i) != '\n' {
                i += 1;
            }
        } else if at(i) == '/' && at(i + 1) == '*' {
            let mut depth = 0;
            loop {
                match (at(i), at(i + 1)) {
                    ('/', '*') => (depth, i) = (depth + 1, i + 2),
                    ('*', '/') => (depth, i) = (depth - 1, i + 2),
                    _ => i += 1,
                }
                if depth == 0 || i >= chars.len() {
                    break;
                }
            }
        } else if at(i) == 'r' && !is_word(before) | (before == 'b') && at(i + 1 + hashes) == '"' {
            i += hashes + 2;
            while i < chars.len() && !(at(i) == '"' && (1..=hashes).all(|j| at(i + j) == '#')) {
                i += 1;
            }
            i += hashes + 1;
        } else if at(i) == '"' || at(i) == '\'' && (at(i + 1) == '\\' || at(i + 2) == '\'') {
            let end = at(i);
            i += 1;
            while i < chars.len() && at(i) != end {
                i += if at(i) == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else {
            out.push(at(i));
            i += 1;
        }
    }
    out
}

/// The code without the items of tests.
fn without_tests(code: &str) -> String {
    let (mut out, mut rest) = (String::new(), code);
    while let Some(start) = rest.find("#[cfg(test)]") {
        out.push_str(&rest[..start]);
        rest = &rest[start..];
        let (mut braces, mut others, mut end) = (0, 0, rest.len());
        for (at, c) in rest.char_indices() {
            match c {
                '(' | '[' => others += 1,
                ')' | ']' => others -= 1,
                '{' => braces += 1,
                '}' => braces -= 1,
                _ => {}
            }
            if braces == 0 && (c == '}' || c == ';' && others == 0) {
                end = at + 1;
                break;
            }
        }
        rest = &rest[end..];
    }
    out + rest
}

/// The paths of a `use` item, each with the name that it brings.
fn expanded(before: &[String], tree: &str, found: &mut Vec<(Segments, String)>) {
    let tree = tree.trim();
    if let Some((head, inner)) = tree.split_once('{') {
        let head = head.split("::").map(str::trim).filter(|s| !s.is_empty()).map(str::to_owned);
        let before: Segments = before.iter().cloned().chain(head).collect();
        let inner = inner.rsplit_once('}').map_or(inner, |(inner, _)| inner);
        let (mut depth, mut start) = (0, 0);
        for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expanded(&before, &inner[start..at], found);
                    start = at + 1;
                }
                _ => {}
            }
        }
    } else if !tree.is_empty() {
        let (path, name) = tree.split_once(" as ").map_or((tree, None), |(p, n)| (p, Some(n)));
        let own = path.split("::").map(|s| s.trim().to_owned()).filter(|s| s != "self");
        let path: Segments = before.iter().cloned().chain(own).collect();
        let name = name.or(path.last().map(String::as_str)).unwrap_or_default();
        found.push((path.clone(), name.trim().to_owned()));
    }
}

impl File {
    fn of(text: &str) -> Self {
        let code = without_tests(&code(text));
        let mut file = Self::default();
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let mut rest = code.as_str();
        while let Some(start) = rest.find(is_word) {
            rest = &rest[start..];
            let end = rest.find(|c| !is_word(c) && c != ':').unwrap_or(rest.len());
            let word = rest[..end].trim_end_matches(':');
            let after = rest[end..].trim_start();
            let until = |c: char| after.split_once(c).map_or("", |(item, _)| item);
            if word == "use" && rest[end..].starts_with(' ') {
                let mut found = Vec::new();
                expanded(&[], until(';'), &mut found);
                file.paths.extend(found.iter().map(|(path, _)| path.clone()));
                file.names.extend(found.into_iter().map(|(path, name)| (name, path)));
                rest = after.get(until(';').len()..).unwrap_or("");
                continue;
            }
            if word == "mod" && until(';').chars().all(is_word) {
                file.children.push(until(';').to_owned());
            }
            file.paths.push(word.split("::").map(str::to_owned).collect());
            rest = &rest[end..];
        }
        file.paths.retain(|path| path.len() > 1 && ["crate", "super"].contains(&path[0].as_str()));
        file
    }
}

/// The files of a crate by their modules, read by `source` from the names of their modules.
fn files(source: &dyn Fn(&[String]) -> Option<String>) -> BTreeMap<Module, File> {
    let mut files = BTreeMap::new();
    let mut open: Vec<Module> = vec![Vec::new()];
    while let Some(module) = open.pop() {
        let file = File::of(&source(&module).unwrap_or_else(|| panic!("no file of {module:?}")));
        let child = |name: &String| [module.as_slice(), std::slice::from_ref(name)].concat();
        open.extend(file.children.iter().map(child));
        files.insert(module, file);
    }
    files
}

/// The module in which what a path of a module names is written down.
fn home(files: &BTreeMap<Module, File>, from: &[String], path: &[String]) -> Option<Module> {
    // a name that is handed on in a circle ends somewhere
    fn step(
        files: &BTreeMap<Module, File>,
        from: &[String],
        path: &[String],
        left: usize,
    ) -> Option<Module> {
        let ups = path.iter().take_while(|segment| *segment == "super").count();
        let (mut at, mut rest) = match path.first()?.as_str() {
            "crate" => (Vec::new(), &path[1..]),
            "super" => (from[..from.len().checked_sub(ups)?].to_vec(), &path[ups..]),
            "self" => (from.to_vec(), &path[1..]),
            first => {
                let file = files.get(from)?;
                let is_own = file.names.contains_key(first) || file.children.contains(&path[0]);
                if !is_own {
                    return None;
                }
                (from.to_vec(), path)
            }
        };
        while let Some((first, behind)) = rest.split_first() {
            let below = [at.as_slice(), std::slice::from_ref(first)].concat();
            if files.contains_key(&below) {
                (at, rest) = (below, behind);
                continue;
            }
            let named = files.get(&at).and_then(|file| file.names.get(first));
            let handed = named
                .filter(|_| left > 0)
                .and_then(|named| step(files, &at, &[named.as_slice(), behind].concat(), left - 1));
            return Some(handed.unwrap_or(at));
        }
        Some(at)
    }
    step(files, from, path, 8)
}

/// The modules of the largest circle: each is reached from each other of them.
fn largest_circle(files: &BTreeMap<Module, File>) -> Vec<Module> {
    let arrows = |module: &Module| -> BTreeSet<Module> {
        let paths = files[module].paths.iter();
        paths.filter_map(|path| home(files, module, path)).filter(|to| to != module).collect()
    };
    let arrows: BTreeMap<&Module, BTreeSet<Module>> =
        files.keys().map(|module| (module, arrows(module))).collect();
    let reached = |from: &Module| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(at) = open.pop() {
            open.extend(arrows[at].iter().filter(|to| seen.insert((*to).clone())));
        }
        seen
    };
    let reach: BTreeMap<&Module, BTreeSet<Module>> =
        files.keys().map(|module| (module, reached(module))).collect();
    let circle = |of: &&Module| -> Vec<Module> {
        let back = |to: &&Module| reach[*to].contains(*of);
        let mut all: Vec<Module> = reach[*of].iter().filter(back).cloned().collect();
        if all.is_empty() {
            all.push((**of).clone());
        }
        all
    };
    files.keys().map(|module| circle(&module)).max_by_key(Vec::len).unwrap_or_default()
}

/// The source of a module of a crate.
fn source_of(src: &Path, module: &[String]) -> Option<String> {
    let place = module.iter().fold(src.to_owned(), |place, name| place.join(name));
    let alone = if module.is_empty() { src.join("lib.rs") } else { place.with_extension("rs") };
    fs::read_to_string(alone).or_else(|_| fs::read_to_string(place.join("mod.rs"))).ok()
}

/// Method: an arrow leads from a file to another one of its crate that a path in it names, in a `use`
/// item or in code, tests and comments left out. Only paths that begin with `crate` or `super` count: a
/// module may know what it holds. What a module hands on by a `use` of its own is named where it is
/// written down, so that a name at the root of a crate hides nothing. A circle is a set of files each of
/// which is reached from each other one along arrows.
#[test]
fn circles_of_files_are_small() {
    let mut names: Vec<&str> = LARGEST.iter().map(|(name, _)| *name).collect();
    names.sort_unstable();
    let crates = fs::read_dir(root().join("crates")).expect("the folder of crates");
    let mut found: Vec<String> = crates
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    found.sort();
    assert_eq!(found, names, "every crate has its number");
    let mut count = 0;
    for (name, most) in LARGEST {
        let src = root().join("crates").join(name).join("src");
        let files = files(&|module| source_of(&src, module));
        count += files.len();
        let circle = largest_circle(&files);
        let circle: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
        assert!(circle.len() <= most, "{name}, {} files: {}", circle.len(), circle.join(", "));
    }
    assert!(count > 700, "{count} files");
}

/// Two files that know each other, one of them by a name at the root, in braces; one beside them that
/// only tests, comments and texts bring into the circle.
#[test]
fn a_circle_is_found() {
    let source = |module: &[String]| {
        let text = match module.join("::").as_str() {
            "" => "mod a;\nmod c;\npub use a::{b::B, A};\n",
            "a" => "pub mod b;\npub struct A;\n// crate::c::C\n",
            "a::b" => "use crate::c::{self, C};\npub struct B(&'static str);\n",
            "c" => {
                "pub struct C;\nconst TEXT: &str = \"super::a::A\";\nfn of(_: &crate::B) {}\n\
                 #[cfg(test)]\nmod tests {\n    use crate::A;\n}\n"
            }
            _ => return None,
        };
        Some(text.to_owned())
    };
    let files = files(&source);
    assert_eq!(files.len(), 4);
    assert_eq!(
        largest_circle(&files),
        [vec!["a".to_owned(), "b".to_owned()], vec!["c".to_owned()]]
    );
}
