#!/usr/bin/env bash
# The page for a browser alone: the module is built where there is a compiler for it, recomputes all
# published values, and has the hash over all trials of `gumption verify --paths`; in node, and in
# Chromium as the folder of files that `gumption open --static` writes.
#
#     tests/page-static.sh [PROGRAM]        (target/release/gumption unless given)
#
# It ends with 3 where there is nothing to build or run it with.
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-target/release/gumption}")
wasm=target/gumption.wasm
command -v node >/dev/null || { echo "page-static: there is no node; skipped" >&2; exit 3; }
page/build-wasm.sh "$wasm"
hash=$("$program" verify --paths | awk '$1 == "baseline" { print $2 }')
[ -n "$hash" ] || { echo "page-static: $program has no hash" >&2; exit 1; }
node page/try-wasm.mjs "$wasm" "$hash" models/examples/published/gum-h1-end-gauge.json

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" open --static "$folder" --wasm "$wasm"
for file in index.html assets/page.js assets/style.css assets/gumption.wasm; do
    [ -s "$folder/$file" ] || { echo "page-static: $file is missing" >&2; exit 1; }
done
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
[ -n "$chromium" ] || { echo "page-static: there is no Chromium; tried in node alone" >&2; exit 0; }
node page/try-static.mjs "$folder" "$hash" "$chromium"
