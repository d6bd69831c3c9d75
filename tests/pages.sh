#!/usr/bin/env bash
# Pictures of every kind of page for reports/pages/, what axe-core says of them, and terminal pages at
# 60, 80, 100 and 140 columns.
#
# usage: tests/pages.sh [FOLDER]          FOLDER is reports/pages unless given
#
# Needs Chromium, poppler-utils, tmux, and Node with npm, which fetches puppeteer-core and axe-core into
# target/pages. GUMPTION is the program; unless given it is built.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(realpath -m "${1:-reports/pages}")
work=$(realpath -m target/pages)
mkdir -p "$folder" "$work"

if [ -z "${GUMPTION:-}" ]; then
  cargo build --quiet
  GUMPTION="${CARGO_TARGET_DIR:-target}/debug/gumption"
fi
GUMPTION=$(realpath "$GUMPTION")
[ -d "$work/node_modules/axe-core" ] ||
  (cd "$work" && npm install --silent --no-package-lock puppeteer-core axe-core)

page() { # NAME COMMAND...
  local name=$1
  shift
  "$GUMPTION" "$@" --format html --quiet --output "$work/$name.html"
}
page run run models/inclined_plane.json --trials 200000
page sweep run models/three_axis_sensitivity.json --trials 20000
page outputs run models/sensitivity_matrix.json --trials 20000
page conformity run tests/cases/feat-tolerance-normal/model.json --trials 200000
page gap gap models/gap/lateral_motion/case.json
page observe observe models/recordings/rotating_table/recipe.json
page verify verify
page compare compare models/examples/results.csv
page proficiency compare models/examples/proficiency.csv --scheme iso13528
page diff diff models/examples/last_year.json models/examples/this_year.json
page assumptions assumptions models/spurious_component.json --trials 100000
page plan plan models/inclined_plane.json --target "U(a_x) <= 0.01 m/s^2"
page certificate certificate models/certificates/three_axis_accelerometer.json
page interactive run models/inclined_plane.json --trials 200000 --interactive

# the certificates of a laboratory, every sheet on A4
for file in models/certificates/*.json; do
  name=certificate-$(basename "$file" .json)
  [ "$name" != certificate-three_axis_accelerometer ] || continue
  page "$name" certificate "$file"
  "${CHROMIUM:-chromium}" --headless --no-sandbox --disable-gpu --no-pdf-header-footer \
    --print-to-pdf="$work/$name.pdf" "file://$work/$name.html" 2> /dev/null
  rm -f "$folder/$name"-?.png
  pdftoppm -r 60 -png "$work/$name.pdf" "$folder/$name"
done

# the picture of the manual
[ "$folder" != "$PWD/reports/pages" ] || cp "$folder/certificate-pressure_gauge-1.png" docs/pictures/certificate.png

for columns in 60 80 100 140; do
  session="pages-$$-$columns"
  tmux new-session -d -s "$session" -x "$columns" -y 120 \
    "$GUMPTION run models/inclined_plane.json --trials 100000 --quiet; sleep 60"
  for _ in $(seq 50); do
    sleep 0.2
    tmux capture-pane -p -t "$session" > "$folder/terminal-$columns.txt"
    ! grep -q 'a_z' "$folder/terminal-$columns.txt" || break
  done
  sleep 1
  tmux capture-pane -p -S -300 -t "$session" | sed -e :a -e '/^\n*$/{$d;N;ba' -e '}' \
    > "$folder/terminal-$columns.txt"
  tmux kill-session -t "$session"
done

# what a terminal of 30 lines shows after the first command of README.md
session="pages-$$-screen"
tmux new-session -d -s "$session" -x 80 -y 30 \
  "LANG=C.UTF-8 $GUMPTION run models/inclined_plane.json --quiet; sleep 60"
for _ in $(seq 50); do
  sleep 0.2
  tmux capture-pane -p -t "$session" > "$folder/terminal-80x30.txt"
  ! grep -q -- '--full' "$folder/terminal-80x30.txt" || break
done
tmux kill-session -t "$session"

cd "$work"
node "$OLDPWD/tests/pages/pages.mjs" "$folder" "$work"/{run,sweep,outputs,conformity,gap,observe,compare,diff,assumptions,verify,plan,certificate}.html
# the script under the page's own policy, with its picture
node "$OLDPWD/tests/pages/interactive.mjs" "$work"/{run,interactive}.html "$folder/interactive.png"
