//! The page as a folder of files for any web server.

use std::io;
use std::path::Path;

use super::files_of_page;
use super::shown;
use crate::exit::say;
use crate::output::Destination;
use crate::{Exit, Failure};
use gumption_text::bytes;

/// The path of the program in the folder.
const PROGRAM: &str = "assets/gumption.wasm";

/// The first bytes of a WebAssembly program.
const MAGIC: &[u8] = b"\0asm";

/// The largest accepted program, in bytes.
const MOST: u64 = 256 << 20;

/// Writes the files of the page, and the program if it is given.
pub(super) fn write(folder: &Path, wasm: Option<&Path>) -> Result<Exit, Failure> {
    let wasm = wasm.map(program).transpose()?;
    let failed = |error: io::Error| {
        Failure::System(format!("cannot create the folder `{}`: {error}", shown(folder)))
    };
    std::fs::create_dir_all(folder.join("assets")).map_err(failed)?;
    for asset in files_of_page::all() {
        let path = match asset.name {
            "index.html" => folder.join(asset.name),
            name => folder.join("assets").join(name),
        };
        put(&path, asset.content)?;
    }
    let place = folder.join(PROGRAM);
    match wasm {
        Some(content) => put(&place, &content)?,
        None if place.is_file() => {}
        None => say(&format!(
            "note: `{}` is missing, and the page cannot compute without it: `page/build-wasm.sh` \
             makes it where there is a compiler for it, and `--wasm FILE` takes it\n",
            shown(&place)
        )),
    }
    Ok(Exit::Done)
}

fn put(path: &Path, content: &[u8]) -> Result<(), Failure> {
    Destination::open(path)?.write_with(|out| out.write_all(content).map(|()| true))
}

/// The program for the page.
fn program(path: &Path) -> Result<Vec<u8>, Failure> {
    let refuse = |reason: &str| Failure::Argument(format!("`--wasm {}`: {reason}", shown(path)));
    let content = bytes::of_file(path, MOST).map_err(|reason| refuse(&reason))?;
    if !content.starts_with(MAGIC) {
        return Err(refuse("it is not a WebAssembly module"));
    }
    Ok(content)
}
