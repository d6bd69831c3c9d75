#!/usr/bin/env bash
# Builds the program behind the live page for a browser alone (wasm32-unknown-unknown), and writes it
# to a file.
#
#     page/build-wasm.sh [FILE]        (target/gumption.wasm unless given)
#
# A Rust toolchain of a distribution has no standard library for that target. Debian's security
# repository has a compiler with the library's source, from which cargo builds it; that is a switch of
# nightly compilers (RUSTC_BOOTSTRAP). Nothing else of the build depends on it. Where there are no such
# packages, this says so and ends with 3.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-target/gumption.wasm}
tools=$PWD/target/wasm-tools

unavailable() { echo "build-wasm: $*; the page for a browser alone is not built" >&2; exit 3; }

fetch() {
    command -v apt-get >/dev/null && command -v dpkg >/dev/null || unavailable "this is not Debian"
    local library packages
    library=$(apt-cache depends libstd-rust-web-dev 2>/dev/null | awk '/Depends: libstd-rust-web-/ { print $2; exit }')
    [ -n "$library" ] || unavailable "there is no package libstd-rust-web-dev"
    local lld
    lld=$(apt-cache pkgnames lld- 2>/dev/null | grep -E '^lld-[0-9]+$' | sort -t- -k2 -n | tail -1)
    [ -n "$lld" ] || unavailable "there is no package lld"
    packages=(rustc-web rust-web-src libstd-rust-web-dev "$library" "$lld" "libllvm${lld#lld-}")
    rm -rf "$tools" && mkdir -p "$tools/packages"
    (cd "$tools/packages" && apt-get download "${packages[@]}" >/dev/null 2>&1) ||
        unavailable "the packages ${packages[*]} cannot be downloaded"
    for package in "$tools"/packages/*.deb; do dpkg -x "$package" "$tools/root"; done
    rm -r "$tools/packages"
    touch "$tools/complete"
}

[ -e "$tools/complete" ] || fetch
root=$tools/root
library_path=$(dirname "$(find "$root/usr/lib" -name 'librustc_driver-*.so' | head -1)")
linker=$(find "$root/usr/bin" -name 'wasm-ld-*' | head -1)
export LD_LIBRARY_PATH=$library_path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
"$root/usr/bin/rustc" --version || unavailable "the compiler does not run"

# vector instructions are in every browser since 2023, and give the same bits
export RUSTC=$root/usr/bin/rustc RUSTC_BOOTSTRAP=1
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS='-C target-feature=+simd128'
# names of functions are three quarters of the file
cargo rustc --package gumption-browser --release -Z build-std=std,panic_abort \
    --target wasm32-unknown-unknown --target-dir target/wasm -- -C strip=symbols
mkdir -p "$(dirname "$out")"
cp target/wasm/wasm32-unknown-unknown/release/gumption_browser.wasm "$out"
echo "$out: $(stat -c %s "$out") bytes, $(gzip -9c "$out" | wc -c) compressed"
