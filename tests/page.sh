#!/usr/bin/env bash
# The live page in a real browser: what it does, what axe-core says of it, how fast it is; pictures for
# reports/pages/.
#
# usage: tests/page.sh [FOLDER]          FOLDER is reports/pages unless given
#
# Needs Chromium (CHROMIUM names it), and Node with npm, which fetches playwright-core and axe-core into
# target/page. GUMPTION is the program; unless given it is built. PAGE_FILES=crates/live/page takes the
# page's files from there in place of the program's, so that they need not be compiled; ONLY names a
# part of the name of the tests to be run.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(realpath -m "${1:-reports/pages}")
work=$(realpath -m target/page)
export CHROMIUM="${CHROMIUM:-/usr/bin/chromium}"
for program in node npm "$CHROMIUM"; do
  if ! command -v "$program" > /dev/null; then
    echo "skipped: the tests of the live page need Node, npm and Chromium, and there is no $program"
    exit 0
  fi
done
if [ -z "${GUMPTION:-}" ]; then
  cargo build --quiet
  GUMPTION="${CARGO_TARGET_DIR:-target}/debug/gumption"
fi
GUMPTION=$(realpath "$GUMPTION")
mkdir -p "$folder" "$work"
cp tests/page/package.json "$work"
if ! { [ -d "$work/node_modules/playwright-core" ] && [ -d "$work/node_modules/axe-core" ]; }; then
  if ! (cd "$work" && npm install --silent --no-package-lock); then
    echo "skipped: npm cannot fetch playwright-core and axe-core"
    exit 0
  fi
fi
[ -z "${PAGE_FILES:-}" ] || PAGE_FILES=$(realpath "$PAGE_FILES")
export GUMPTION PAGE_FILES PAGE_MODULES="$work"
failed=0
node tests/page/tests.mjs "$PWD" "$folder" || failed=$?
# the pictures of README.md and of the manual
if [ "$folder" = "$PWD/reports/pages" ] && [ -z "${ONLY:-}" ]; then
  cp "$folder/live-first-screen.png" docs/pictures/live.png
  cp "$folder/live-conflict.png" docs/pictures/live-conflict.png
  cp "$folder/live-start.png" docs/pictures/live-start.png
fi
exit "$failed"
