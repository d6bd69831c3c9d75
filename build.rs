//! The published program (`profile.dist`) does not unwind, so that it is linked without the tables that
//! only unwinding and backtraces read: a megabyte of twelve. A panic is told with its place all the same.

#![allow(clippy::print_stdout)] // how a build script speaks to Cargo

use std::env;
use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=no-unwind-tables.ld");
    let out = env::var_os("OUT_DIR").unwrap_or_default();
    // target/PROFILE/build/gumption-HASH/out
    let profile = Path::new(&out).ancestors().nth(3).and_then(Path::file_name);
    let is_linux = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux");
    if is_linux && profile.is_some_and(|profile| profile == "dist") {
        let folder = env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
        println!("cargo::rustc-link-arg-bin=gumption=-Wl,-T,{folder}/no-unwind-tables.ld");
    }
}
