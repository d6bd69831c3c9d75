//! Model files, tables, samples and saved results that are made and changed by the grammar, always
//! the same ones: whatever they say, reading and evaluating them ends with an answer that makes
//! sense or with mistakes that have places, never with a panic.
//!
//! `GUMPTION_FUZZ=SEED:CASES` makes others, and as many as are wanted.

mod answer;
mod folder;
mod grammar;
mod mutation;
mod random;
mod tree;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use folder::Folder;
use random::Random;
use tree::Tree;

use crate::support::{model_files, root};

/// Cases without a wish of the user: about a minute of a test build on two threads.
const CASES: u64 = 80_000;

/// Every so manieth case is given to the program itself, in a limited address space.
const PROGRAM: u64 = 400;

/// Seed and number of cases.
pub(crate) fn wanted(cases: u64) -> (u64, u64) {
    let wanted = std::env::var("GUMPTION_FUZZ").ok();
    let wanted = wanted.as_deref().and_then(|text| {
        let (seed, cases) = text.split_once(':')?;
        Some((seed.parse().ok()?, cases.parse().ok()?))
    });
    wanted.unwrap_or((1, cases))
}

/// Right files to change: the ready models, their forms in formulas, and the examples.
fn right_files() -> &'static [Tree] {
    static FILES: OnceLock<Vec<Tree>> = OnceLock::new();
    FILES.get_or_init(|| {
        let mut paths = model_files();
        for folder in ["models/formulas", "tests/cases"] {
            let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
            let mut found: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
            found.sort();
            paths.extend(found);
        }
        let files = paths
            .iter()
            .map(|path| if path.is_dir() { path.join("model.json") } else { path.clone() });
        let files = files.filter(|path| path.extension().is_some_and(|e| e == "json"));
        let texts = files.filter_map(|path| std::fs::read_to_string(path).ok());
        // the longest ones would take most of the time
        texts.filter(|text| text.len() < 20_000).map(|text| Tree::parse(&text)).collect()
    })
}

/// The text of a case; files that it names are changed in the folder.
fn case(random: &mut Random, folder: &Folder) -> String {
    let files = right_files();
    let mut file = if random.chance(45) {
        grammar::model(random)
    } else {
        files[random.below(files.len())].clone()
    };
    let times = *random.pick(&[&0usize, &1, &1, &1, &2, &2, &3, &6]);
    for _ in 0..times {
        mutation::mutate(random, &mut file);
    }
    if random.chance(15) {
        folder.change(random);
    }
    let mut text = file.render();
    if random.chance(5) {
        mutation::damage(random, &mut text);
    }
    text
}

#[test]
fn files_made_by_the_grammar_are_answered() {
    let (seed, cases) = wanted(CASES);
    let next = AtomicU64::new(0);
    let failed: Mutex<Vec<String>> = Mutex::default();
    let read = AtomicU64::new(0);
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let folder = Folder::new();
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= cases || failed.lock().unwrap().len() >= 5 {
                        break;
                    }
                    // every case finds the folder as it was, so that its number is all that counts
                    folder.restore();
                    let text = case(&mut Random::of(seed, number), &folder);
                    let program = number.is_multiple_of(PROGRAM);
                    let work = || {
                        if program {
                            answer::of_program(&text, &folder);
                        }
                        answer::of(&text, folder.path())
                    };
                    match catch_unwind(AssertUnwindSafe(work)) {
                        Ok(right) => {
                            read.fetch_add(u64::from(right), Ordering::Relaxed);
                        }
                        Err(panic) => {
                            let said = panic
                                .downcast_ref::<String>()
                                .map(String::as_str)
                                .or_else(|| panic.downcast_ref::<&str>().copied())
                                .unwrap_or("?");
                            let text = format!("case {seed}:{number}: {said}\n{text}\n");
                            failed.lock().unwrap().push(text);
                        }
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    // a grammar whose files are all refused would show little
    let read = read.into_inner();
    assert!(10 * read > cases || cases < 100, "{read} of {cases} files are right");
    crate::support::announce(&format!("fuzzing: {read} of {cases} files are right"));
}

/// One case by its number, for a closer look: `GUMPTION_FUZZ=SEED:NUMBER cargo test one_case --
/// --ignored --nocapture`.
#[test]
#[ignore = "for a closer look at a case"]
fn one_case() {
    let (seed, number) = wanted(0);
    let folder = Folder::new();
    let text = case(&mut Random::of(seed, number), &folder);
    println!("{text}");
    let right = answer::of(&text, folder.path());
    println!("{}", if right { "right" } else { "refused" });
    answer::of_program(&text, &folder);
}

/// The right files are right in the folder of the cases, so that what is found wrong in a case is
/// due to its changes.
#[test]
fn right_files_are_right() {
    let folder = Folder::new();
    let right = |file: &&Tree| {
        gumption::file::read_text("m", &file.render(), Path::new(folder.path()), &[]).is_ok()
    };
    let count = right_files().iter().filter(right).count();
    let wrong = right_files().len() - count;
    // the examples of wrong files are among them
    assert!(count > 100 && wrong <= 8, "{count} right, {wrong} wrong");
}
